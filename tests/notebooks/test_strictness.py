"""The notebook tests of this project notice what they are there to notice."""

from __future__ import annotations

import subprocess
import sys

import pytest
from nbformat.v4 import new_code_cell, new_notebook

from engdyn.course import execution

SOURCES = [
    "print(1 + 1)",
    "object()",
    "import ipywidgets as widgets\n"
    "widgets.VBox([widgets.FloatSlider(value=0.5), widgets.Image(value=b'\\x89PNG' * 50)])",
]


@pytest.fixture(scope="module")
def built(tmp_path_factory):
    """A notebook with an address and a widget in its outputs, built as those of the course are."""
    folder = tmp_path_factory.mktemp("strict")
    notebook = new_notebook(cells=[new_code_cell(source, id=f"c{k}") for k, source in enumerate(SOURCES)])
    return execution.execute(notebook, folder), folder


def _nbval(checkout, folder, name):
    options = ["-n0", "-p", "no:cacheprovider", f"--nbval-sanitize-with={checkout}/tests/nbval.cfg"]
    command = [sys.executable, "-m", "pytest", "-q", "-c", str(checkout / "pyproject.toml"), *options]
    run = subprocess.run(
        [*command, str(folder / name)], cwd=checkout, capture_output=True, text=True, check=False
    )
    return run.stdout


def test_a_built_notebook_passes_and_a_changed_output_does_not(checkout, built):
    notebook, folder = built
    execution.write_notebook(notebook, folder / "same.ipynb")
    assert "3 passed" in _nbval(checkout, folder, "same.ipynb")

    notebook.cells[0].outputs[0].text = "3\n"
    notebook.cells[2].outputs[0].data["text/plain"] = "VBox()"
    execution.write_notebook(notebook, folder / "changed.ipynb")
    report = _nbval(checkout, folder, "changed.ipynb")
    assert "2 failed, 1 passed" in report
    assert "Cell outputs differ" in report
