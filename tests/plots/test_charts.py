"""Flow charts: arrows run from edge to edge of their boxes."""

from __future__ import annotations

import numpy as np
import pytest
from matplotlib.text import Annotation

import engdyn as ed

BOXES = {
    "start": ("Start", (0, 0)),
    "wide": ("A box with a\nlong second line of text", (0, 1)),
    "closed": ("Does it close?", (1, 1)),
}


def chart(*arrows):
    ax = ed.plots.flow_chart(BOXES, arrows)
    ax.figure.canvas.draw()
    texts = {t.get_text(): t for t in ax.texts if not isinstance(t, Annotation)}
    return ax, texts, [t for t in ax.texts if isinstance(t, Annotation)]


def test_arrows_start_and_end_at_the_edges_of_their_boxes():
    _, texts, arrows = chart(("start", "wide"), ("wide", "closed"))
    boxes = [texts[text].get_bbox_patch().get_window_extent() for text, _ in BOXES.values()]
    for arrow, (tail, head) in zip(arrows, [boxes[:2], boxes[1:]], strict=True):
        line = arrow.arrow_patch.get_path().vertices
        line = arrow.arrow_patch.get_transform().transform(line)
        for box in (tail, head):
            inside = (line > box.min + 1).all(axis=1) & (line < box.max - 1).all(axis=1)
            assert not inside.any()
        gaps = [
            np.abs(np.array([e.x0, e.x1, e.y0, e.y1])[:, None] - line.T[[0, 0, 1, 1]]).min()
            for e in (tail, head)
        ]
        assert max(gaps) < 6  # pixels


def test_a_question_is_a_decision_and_its_arrows_have_labels():
    ax, texts, _ = chart(("wide", "closed", "yes"))
    looks = {text.split("\n")[0]: texts[text].get_bbox_patch().get_boxstyle() for text, _ in BOXES.values()}
    assert type(looks["Does it close?"]).__name__ == "Round"
    assert type(looks["Start"]).__name__ == "Square"
    x, y = texts["yes"].get_position()
    assert 0 < x < 1
    assert y < 1  # above the arrow: rows count downward
    assert "A box with a long second line of text → Does it close?" in ed.plots.alt(ax)


def test_an_arrow_to_nowhere_is_an_error():
    with pytest.raises(ed.EngdynError, match="names the box 'end'; there are start, wide, closed"):
        ed.plots.flow_chart(BOXES, [("start", "end")])
