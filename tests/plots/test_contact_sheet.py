"""The contact sheet: every system once, in order, whole and apart from the others."""

from __future__ import annotations

import numpy as np
import pytest

import engdyn as ed
from engdyn.errors import EngdynError

CATALOGUE = [f"S{number:02d}" for number in range(1, 24)]


@pytest.fixture(scope="module")
def sheet():
    return ed.plots.contact_sheet()


def ink(figure):
    """Where something is drawn, as a matrix of the pixels of the figure."""
    figure.canvas.draw()
    return np.asarray(figure.canvas.buffer_rgba())[..., :3].min(axis=-1) < 250


def test_the_sheet_shows_the_catalogue_in_order(sheet):
    assert [ax.get_title()[:3] for ax in sheet.axes] == CATALOGUE


def test_every_drawing_and_title_stays_in_its_place(sheet):
    pixels = ink(sheet)
    rows, columns = 6, 4
    height, width = pixels.shape[0] / rows, pixels.shape[1] / columns
    for place in range(rows * columns):
        row, column = divmod(place, columns)
        top, left = round(row * height), round(column * width)
        cell = pixels[top : round((row + 1) * height), left : round((column + 1) * width)]
        assert cell.any() == (place < len(CATALOGUE))
        rim = np.concatenate([cell[0], cell[-1], cell[:, 0], cell[:, -1]])
        assert not rim.any(), f"place {place}: something is cut off, or reaches into the next drawing"


def test_labels_and_dimensions_come_on_request():
    bare, labeled = (ed.plots.contact_sheet(["S10"], labels=wish) for wish in (False, True))
    written = [{text.get_text() for text in figure.axes[0].texts} for figure in (bare, labeled)]
    assert written[0] == set()
    assert {"$m_1$", "$k_1$", "$c_1$", "$y_1$", "$F$"} <= written[1]


def test_columns_are_never_more_than_drawings():
    figure = ed.plots.contact_sheet([7, ed.systems.load(23)], columns=9)
    assert len({ax.get_position().x0 for ax in figure.axes}) == 2
    assert figure.axes[-1].get_position().x1 == pytest.approx(1.0)


def test_the_sheet_tells_in_words_what_it_shows(sheet):
    assert ed.plots.alt(sheet).startswith("23 drawings, 4 in a row. S01: Crank press")


@pytest.mark.parametrize(
    ("systems", "columns", "told"),
    [
        ([], 4, "no systems to draw"),
        ("S07", 4, "list of systems"),
        ([7], 0, "one column or more"),
        ([7], 1.5, "whole number"),
        ([7], True, "whole number"),
        (["S99"], 4, "S99"),
    ],
)
def test_what_is_no_sheet_is_refused(systems, columns, told):
    with pytest.raises(EngdynError, match=told):
        ed.plots.contact_sheet(systems, columns)
