"""Pictures come with words."""

from __future__ import annotations

import base64
import io

import pytest
from IPython.core.displaypub import CapturingDisplayPublisher
from IPython.core.interactiveshell import InteractiveShell
from matplotlib.figure import Figure
from PIL import Image

import engdyn as ed
from engdyn.plots.alternative import bundle, describe, png


@pytest.fixture
def published(monkeypatch):
    """What reaches the notebook."""
    shell = InteractiveShell.instance()
    publisher = CapturingDisplayPublisher()
    monkeypatch.setattr(shell, "display_pub", publisher)
    yield publisher.outputs
    InteractiveShell.clear_instance()


def picture():
    ax = Figure(figsize=(4, 3)).add_subplot()
    ax.plot([0, 1], [2, 3])
    return ax


def test_words_of_a_figure_are_those_of_its_axes():
    figure = Figure()
    left, right, bar = figure.subplots(1, 3)
    bar.set_ylabel("height [m]")  # of a color bar, say: the words know it
    describe(left, "A line rises from 2 to 3.")
    describe(right, "A line falls.")
    assert ed.plots.alt(left) == "A line rises from 2 to 3."
    assert ed.plots.alt(figure) == "A line rises from 2 to 3. A line falls."


def test_words_are_replaced_unless_added():
    ax = picture()
    describe(ax, "First.")
    describe(ax, "Second.", add=True)
    assert ed.plots.alt(ax) == "First. Second."
    describe(ax, "Third.")
    assert ed.plots.alt(ax) == "Third."


def test_axes_of_other_origin_tell_title_and_labels():
    ax = picture()
    ax.set_title("Swing")
    ax.set_xlabel("time [s]")
    ax.set_ylabel("angle [rad]")
    assert ed.plots.alt(ax) == "Swing time [s]. angle [rad]."


@pytest.mark.parametrize("function", [ed.plots.alt, ed.plots.show, png])
def test_what_is_no_picture_is_refused(function):
    with pytest.raises(ed.EngdynError, match="neither matplotlib Axes nor Figure"):
        function([1, 2, 3])


def test_png_has_the_wanted_size_and_is_the_same_every_time():
    ax = picture()
    first = png(ax, dpi=90)
    assert Image.open(io.BytesIO(first)).size == (360, 270)
    assert png(ax, dpi=90) == first


def test_show_displays_picture_and_words(published):
    ax = picture()
    describe(ax, "A line rises from 2 to 3.")
    ed.plots.show(ax)
    (output,) = published
    assert output["data"]["text/plain"] == "A line rises from 2 to 3."
    assert Image.open(io.BytesIO(base64.b64decode(output["data"]["image/png"]))).size == (360, 270)
    assert output["metadata"] == {"image/png": {"alt": "A line rises from 2 to 3."}}


def test_show_closes_figures_of_pyplot(published):
    plt = pytest.importorskip("matplotlib.pyplot")
    plt.switch_backend("agg")
    figure, ax = plt.subplots()
    other = plt.figure()
    ed.plots.show(ax)
    assert not plt.fignum_exists(figure.number)
    assert plt.fignum_exists(other.number)


def test_words_do_not_keep_figures_alive():
    import gc
    import weakref

    ax = picture()
    describe(ax, "A line.")
    gone = weakref.ref(ax)
    del ax
    gc.collect()
    assert gone() is None


def test_bundle_of_a_drawing_is_ready_for_a_notebook():
    data, metadata = bundle(ed.plots.draw(ed.systems.load(3), [0.5]))
    assert set(data) == {"image/png", "text/plain"}
    assert data["text/plain"].endswith("at theta = 0.5 rad (28.6°).")
    assert metadata["image/png"]["alt"] == data["text/plain"]
