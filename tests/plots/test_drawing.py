"""Drawings: equal scales, readable labels, honest words."""

from __future__ import annotations

import itertools
import math
import subprocess
import sys

import matplotlib
import numpy as np
import pytest
from matplotlib.figure import Figure

import engdyn as ed
from engdyn import shapes
from engdyn.plots.drawing import Layer, draw_layers, drawing_axes, shown_pose
from engdyn.plots.look import COLORS, style

POSES = [
    (3, [0.77269]),
    (3, [0.0]),
    (3, [-1.2]),
    (7, [0.0, 0.0]),
    (7, [2.0, 0.45]),
    (7, [-4.0, 2.6]),
    (23, [0.0, 0.0, 0.0, 0.0]),
    (23, [-0.2155, -0.0154, -0.0259, -0.0193]),
    (23, [0.05, 0.12, 0.04, -0.05]),
]


def boxes(ax):
    """Extents of all texts in pixels, without the empty rim."""
    renderer = ax.figure.canvas.get_renderer()
    return [text.get_window_extent(renderer) for text in ax.texts]


@pytest.mark.parametrize(("number", "q"), POSES)
def test_labels_neither_overlap_nor_leave_the_picture(number, q):
    ax = ed.plots.draw(ed.systems.load(number), q)
    ax.figure.canvas.draw()
    frame, extents = ax.figure.bbox, boxes(ax)
    assert len(extents) >= 10
    for extent in extents:
        assert frame.x0 <= extent.x0
        assert extent.x1 <= frame.x1
        assert frame.y0 <= extent.y0
        assert extent.y1 <= frame.y1
    for a, b in itertools.combinations(extents, 2):
        assert not a.overlaps(b), (a, b)


@pytest.mark.parametrize(("number", "q"), POSES)
def test_nothing_is_cut_off_and_scales_are_equal(number, q):
    ax = ed.plots.draw(ed.systems.load(number), q)
    ax.figure.canvas.draw()
    for collection in ax.collections:
        for path in collection.get_paths():
            low, high = path.vertices.min(axis=0), path.vertices.max(axis=0)
            assert ax.get_xlim()[0] < low[0]
            assert high[0] < ax.get_xlim()[1]
            assert ax.get_ylim()[0] < low[1]
            assert high[1] < ax.get_ylim()[1]
    one_meter = np.diff(ax.transData.transform([(0, 0), (1, 1)]), axis=0)[0]
    assert one_meter[0] == pytest.approx(one_meter[1])


def test_a_system_is_drawn_without_pyplot_and_without_trace():
    # Reading the setting "backend" would itself import pyplot.
    code = (
        "import sys, matplotlib\n"
        "settings = lambda: {k: matplotlib.rcParams[k] for k in matplotlib.rcParams if k != 'backend'}\n"
        "before = settings()\n"
        "import engdyn as ed; ax = ed.plots.draw(ed.systems.load(7)); ed.plots.alt(ax)\n"
        "assert settings() == before\n"
        "assert 'matplotlib.pyplot' not in sys.modules"
    )
    subprocess.run([sys.executable, "-c", code], check=True)


def test_draws_into_given_axes():
    ax = Figure().add_subplot()
    assert ed.plots.draw(ed.systems.load(7), ax=ax) is ax
    assert len(ax.collections) > 4


def test_words_tell_the_pose():
    ax = ed.plots.draw(ed.systems.load(7), [2.0, -0.1])
    assert ed.plots.alt(ax) == (
        "Drawing of Gantry crane: trolley and hanging container at x = 2 m, theta = −0.1 rad (−5.7°)."
    )


def test_a_faint_pose_has_no_labels_and_joins_the_picture():
    crane = ed.systems.load(7)
    ax = ed.plots.draw(crane, [0.0, 0.3])
    texts, limits = len(ax.texts), ax.get_xlim()
    ed.plots.draw(crane, [12.0, -0.3], ax=ax, faint=True)
    assert len(ax.texts) == texts
    assert ax.get_xlim()[0] <= limits[0]
    assert ax.get_xlim()[1] > 12.0
    assert "Faint drawing" in ed.plots.alt(ax)
    assert "x = 12 m" in ed.plots.alt(ax)


def test_faint_is_pale_and_behind():
    crane = ed.systems.load(7)
    ax = ed.plots.draw(crane, [0.0, 0.3], faint=True)
    assert all(np.all(c.get_edgecolor()[:, 3] < 0.5) for c in ax.collections)
    assert all(c.get_zorder() < 0 for c in ax.collections)


def test_labels_can_be_left_out():
    assert not ed.plots.draw(ed.systems.load(3), labels=False).texts


def test_values_change_the_geometry():
    crane = ed.systems.load(7)
    spans = [np.ptp(ed.plots.draw(crane, [0.0, 0.0], {"L": L}).get_ylim()) for L in (9.0, 18.0)]
    assert spans[1] == pytest.approx(2 * spans[0], rel=0.05)


@pytest.mark.parametrize(
    ("q", "message"),
    [
        ([0.0], "coordinates x, theta"),
        ([0.0, math.nan], "not finite"),
        ([[0.0, 1.0]], "coordinates x, theta"),
    ],
)
def test_what_is_no_pose_is_refused(q, message):
    with pytest.raises(ed.EngdynError, match=message):
        ed.plots.draw(ed.systems.load(7), q)


def test_unknown_parameter_is_refused():
    with pytest.raises(ed.ParameterError, match="unknown parameter 'length'"):
        ed.plots.draw(ed.systems.load(7), values={"length": 3.0})


def test_default_pose_shows_the_angles():
    assert shown_pose(ed.systems.load(7)) == pytest.approx([0.0, 0.45])


def test_a_body_hides_the_rod_behind_it_from_the_labels():
    # A label centered on a body stays there although a rod runs behind the body, but not if it runs in front.
    body = shapes.Box((0, 0), (4, 2), label="$m$")
    rod = shapes.Link((-6, 0), (6, 0))
    layers = [Layer([body, rod])]
    ax = drawing_axes(layers)
    draw_layers(ax, layers)
    assert ax.texts[0].get_position() == pytest.approx((0.0, 0.0), abs=1e-9)
    layers = [Layer([body, shapes.CenterLine((-6, 0), (6, 0), role="coordinate")])]
    ax = drawing_axes(layers)
    draw_layers(ax, layers)
    assert abs(ax.texts[0].get_position()[1]) > 0.1


def test_a_drawing_in_space_is_projected():
    tip = (1.0, 2.0, 3.0)
    layers = [Layer([shapes.Link((0, 0, 0), tip), shapes.Box((0, 0, 0), (1, 1, 1))])]
    ax = drawing_axes(layers, ed.plots.View(azimuth=0.0, elevation=0.0))
    draw_layers(ax, layers, view=ed.plots.View(azimuth=0.0, elevation=0.0))
    ends = [path.vertices[-1] for c in ax.collections for path in c.get_paths() if len(path.vertices) == 2]
    assert any(end == pytest.approx([2.0, 3.0]) for end in ends)
    # All six faces are there; the nearest is drawn last.
    faces = [path.vertices for c in ax.collections for path in c.get_paths() if len(path.vertices) == 5]
    assert len(faces) == 6


def contrast(color):
    """Contrast ratio on white, as the Web Content Accessibility Guidelines (W3C, 2018) define it."""
    rgb = np.array(matplotlib.colors.to_rgb(color))
    linear = np.where(rgb <= 0.03928, rgb / 12.92, ((rgb + 0.055) / 1.055) ** 2.4)
    return 1.05 / (linear @ [0.2126, 0.7152, 0.0722] + 0.05)


@pytest.mark.parametrize("role", shapes.ROLES)
def test_every_role_has_a_color_that_is_readable_as_text(role):
    assert contrast(COLORS[role]) >= 4.5


def settings():
    return {name: matplotlib.rcParams[name] for name in matplotlib.rcParams if name != "backend"}


def test_style_is_left_as_found_even_after_an_error():
    before = settings()

    def fail_inside():
        with style():
            assert settings() != before
            raise RuntimeError("inside")

    with pytest.raises(RuntimeError, match="inside"):
        fail_inside()
    assert settings() == before
