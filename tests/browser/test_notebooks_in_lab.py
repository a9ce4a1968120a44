"""What a student does on the first day, in a real browser: open, run, move a slider, open an exercise."""

from __future__ import annotations

import nbformat
import pytest
from nbformat.v4 import new_code_cell, new_notebook

from engdyn.course import execution

pytestmark = pytest.mark.browser

SLIDER_AND_PICTURE = """import io
import ipywidgets as widgets
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

figure = Figure(figsize=(3, 2))
canvas = FigureCanvasAgg(figure)
line, = figure.add_subplot().plot([0, 1], [0, 1])
slider = widgets.FloatSlider(value=0.5, min=0.0, max=1.0, step=0.1)
picture = widgets.Image(format="png")

def draw(change=None):
    line.set_ydata([0, slider.value])
    buffer = io.BytesIO()
    canvas.print_png(buffer)
    picture.value = buffer.getvalue()

slider.observe(draw, "value")
draw()
widgets.VBox([slider, picture])"""


def _put(lab, name, *sources):
    path = lab.root / "tests" / name
    notebook = new_notebook(cells=[new_code_cell(source) for source in sources])
    notebook.metadata["kernelspec"] = execution.KERNELSPEC
    nbformat.write(notebook, path)
    return f"tests/{name}"


def test_the_session_sees_a_slider_change_a_picture(lab_page):
    lab_page.open(_put(lab_page.lab, "slider.ipynb", "x = 1", SLIDER_AND_PICTURE, ""))
    lab_page.run_all()
    assert lab_page.errors() == []
    start, moved, _ = lab_page.step_first_slider("ArrowRight")
    assert moved != start
    _, back, _ = lab_page.step_first_slider("ArrowLeft")
    assert back == start


def test_the_session_sees_an_error(lab_page):
    lab_page.open(
        _put(lab_page.lab, "error.ipynb", "x = 1", "raise ValueError('seen by the student')", "y = 2")
    )
    lab_page.run_all()
    error, stopped = lab_page.errors()
    assert "seen by the student" in error
    assert stopped == "code cell 3 did not run"


def test_chapter_4_runs_and_its_slider_moves_the_picture(lab_page):
    lab_page.open("notebooks/04_equilibrium.ipynb")
    lab_page.run_all()
    assert lab_page.errors() == []
    before, after, _ = lab_page.step_first_slider()
    assert after != before
    assert lab_page.foreign_hosts == set()


@pytest.mark.parametrize(
    "name",
    [
        "01_kinematics",
        "02_newton",
        "03_lagrange",
        "05_stability",
        "06_mode_shapes",
        "A_representative_systems",
        "B_inertia",
    ],
)
def test_it_runs_from_top_to_bottom(lab_page, name):
    lab_page.open(f"notebooks/{name}.ipynb")
    lab_page.run_all()
    assert lab_page.errors() == []
    assert lab_page.foreign_hosts == set()


def test_an_unanswered_exercise_opens_and_runs(lab_page):
    name = sorted(path.name for path in (lab_page.lab.root / "exercises").glob("04_*.ipynb"))[0]
    lab_page.open(f"exercises/{name}")
    lab_page.run_all()
    assert lab_page.errors() == []
