"""Pictures of chapter 2: what is drawn where, and honest errors."""

from __future__ import annotations

import math

import numpy as np
import pytest

import engdyn as ed
from engdyn import shapes
from engdyn.plots import gyro_pictures

X = np.linspace(0.0, 1.0, 11)


def drawn(monkeypatch, call, *args, **kwargs):
    """The shapes that a picture hands to `sketch`, and its words."""
    found = {}

    def catch(drawing, words, ax=None, *, view=None, labels=True, letters=17.0):
        found["shapes"], found["words"] = list(drawing), words

    monkeypatch.setattr(gyro_pictures, "sketch", catch)
    call(*args, **kwargs)
    return found["shapes"], found["words"]


def arrow(drawing, label):
    (found,) = [s for s in drawing if isinstance(s, shapes.VectorArrow) and s.label == label]
    return np.subtract(found.end, found.start)


def along(vector, other):
    return np.allclose(np.cross(vector, other), 0.0, atol=1e-12) and np.dot(vector, other) > 0


# Curves and regions


def test_curves_show_their_data_labels_and_marks():
    ax = ed.plots.curves(
        {"a": (X, X**2), "b": (X, -X)}, "x [m]", "y [N]", "two curves", points={"p": ([0.5], [0.2])}
    )
    first, second, mark = ax.get_lines()
    assert np.array_equal(first.get_ydata(), X**2)
    assert np.array_equal(second.get_ydata(), -X)
    assert first.get_linestyle() != second.get_linestyle()
    assert mark.get_xydata().tolist() == [[0.5, 0.2]]
    assert [text.get_text() for text in ax.get_legend().get_texts()] == ["a", "b", "p"]
    assert (ax.get_xlabel(), ax.get_ylabel(), ed.plots.alt(ax)) == ("x [m]", "y [N]", "two curves")


def test_a_single_curve_has_no_legend_and_a_path_has_equal_scales():
    ax = ed.plots.curves({"path": (X, X)}, "x", "y", "a path", equal=True)
    ax.figure.canvas.draw()
    assert ax.get_legend() is None
    one = np.diff(ax.transData.transform([(0, 0), (1, 1)]), axis=0)[0]
    assert one[0] == pytest.approx(one[1])


@pytest.mark.parametrize(
    ("lines", "words", "message"),
    [
        ({}, "w", "nothing to plot"),
        ({"a": (X, X[:-1])}, "w", "equal length"),
        ({"a": (X, np.full(11, np.nan))}, "w", "not finite"),
        ({"a": (X, X)}, " ", "cannot see"),
    ],
)
def test_curves_refuse_what_is_no_curve(lines, words, message):
    with pytest.raises(ed.EngdynError, match=message):
        ed.plots.curves(lines, "x", "y", words)


def test_a_name_stands_inside_its_region():
    y = np.linspace(0.0, 2.0, 41)
    values = X[None, :] + y[:, None]
    ax = ed.plots.regions(X, y, values, [1.0, 2.0], ["low", "middle", "high"], "x", "y", "a map")
    assert [text.get_text() for text in ax.texts] == ["low", "middle", "high"]
    for text, (least, most) in zip(ax.texts, ((0, 1), (1, 2), (2, 3)), strict=True):
        assert least <= sum(text.get_position()) <= most
    assert ed.plots.alt(ax) == "a map"


def test_a_region_that_does_not_occur_has_no_name():
    ax = ed.plots.regions(X, X, np.zeros((11, 11)), [1.0], ["all", "none"], "x", "y", "a map")
    assert [text.get_text() for text in ax.texts] == ["all"]


@pytest.mark.parametrize(
    ("values", "levels", "names", "message"),
    [
        (np.zeros((3, 11)), [1.0], ["a", "b"], "one finite"),
        (np.full((11, 11), np.inf), [1.0], ["a", "b"], "one finite"),
        (np.zeros((11, 11)), [1.0], ["a"], "need 2 names"),
        (np.zeros((11, 11)), [2.0, 1.0], ["a", "b", "c"], "rising"),
    ],
)
def test_regions_refuse_what_does_not_fit(values, levels, names, message):
    with pytest.raises(ed.EngdynError, match=message):
        ed.plots.regions(X, X, values, levels, names, "x", "y", "w")


# Spinning bodies


@pytest.mark.parametrize(("nutation", "azimuth"), [(0.5, -0.2), (math.pi / 2, 1.0), (2.2, 4.0)])
def test_the_top_obeys_the_right_hand_rule(monkeypatch, nutation, azimuth):
    drawing, words = drawn(monkeypatch, ed.plots.gyroscope, nutation, azimuth)
    H, M, weight, precession = (arrow(drawing, label) for label in ("$H$", "$M$", "$m\\,g$", r"$\Omega$"))
    (disc, *_) = [s for s in drawing if isinstance(s, shapes.Disc) and s.role == "body"]
    assert along(M, np.cross(disc.center, weight))  # the moment of the weight about O
    assert along(np.cross(precession, H), M)  # M = Omega x H
    assert along(arrow(drawing, r"$M\,\mathrm{d}t$"), M)
    (turn,) = [s for s in drawing if isinstance(s, shapes.MomentArrow)]
    assert along(np.cross(turn.x_axis, turn.y_axis) * (turn.end - turn.start), H)
    assert f"{math.degrees(nutation):.0f}°" in words


def test_the_top_on_a_post_stands_above_the_floor(monkeypatch):
    drawing, _ = drawn(monkeypatch, ed.plots.gyroscope, 1.0, post=1.5)
    (floor,) = [s for s in drawing if s.role == "ground"]
    assert floor.center[2] == -1.5
    assert any(isinstance(s, shapes.Link) and s.start == floor.center for s in drawing)


@pytest.mark.parametrize(
    "wrong", [{"nutation": 0.0}, {"nutation": math.nan}, {"post": -1.0}, {"azimuth": math.inf}]
)
def test_the_top_refuses_poses_that_do_not_exist(wrong):
    with pytest.raises(ed.EngdynError, match="gyroscope"):
        ed.plots.gyroscope(**wrong)


@pytest.mark.parametrize(("lean", "steer"), [(0.0, 0.0), (0.3, 0.0), (0.0, 0.4), (0.35, 0.2)])
def test_the_wheel_of_the_bicycle_spins_as_it_rolls(monkeypatch, lean, steer):
    drawing, _ = drawn(monkeypatch, ed.plots.bicycle, lean, steer)
    H = arrow(drawing, "$H$")
    front = max(
        (s for s in drawing if isinstance(s, shapes.Curve)), key=lambda s: len(s.points) + s.points[0][0]
    )
    rim = np.array(front.points)
    hub = rim[:-1].mean(axis=0)
    assert np.allclose(np.linalg.norm(rim - hub, axis=1), 0.34)
    assert np.allclose((rim - hub) @ H, 0.0, atol=1e-12)  # H is square to the wheel
    top = rim[np.argmax(rim[:, 2])] - hub
    assert np.cross(H, top)[0] > 0  # the top of the wheel runs forward
    if lean:
        assert hub[1] < 0  # to the right
    if steer:
        assert H[0] > 0  # the axle's left end comes forward
    assert np.allclose(np.linalg.norm(hub), 0.34)


def test_bicycle_refuses_impossible_angles():
    with pytest.raises(ed.EngdynError, match="right angle"):
        ed.plots.bicycle(lean=2.0)


def test_cones_keep_the_angles_of_their_vectors(monkeypatch):
    axis, omega, momentum = (0.5, 0.0, 1.0), (0.1, 0.0, 1.0), (0.0, 0.0, 3.0)
    drawing, words = drawn(monkeypatch, ed.plots.precession_cones, axis, omega, momentum)
    rims = [s for s in drawing if isinstance(s, shapes.Curve) and len(s.points) == 121]
    for rim, vector in zip(rims, (axis, omega), strict=True):
        points = np.array(rim.points)
        cosines = points[:, 2] / np.linalg.norm(points, axis=1)
        assert np.allclose(cosines, vector[2] / np.linalg.norm(vector))
    assert "26.6°" in words
    assert "5.7°" in words
    with pytest.raises(ed.EngdynError, match="omega"):
        ed.plots.precession_cones(axis, (0, 0, 0), momentum)


def test_the_outline_of_a_spheroid_is_its_silhouette():
    n, view = np.array([0.6, 0.0, 0.8]), ed.plots.View(0.7, 0.4)
    outline = gyro_pictures._outline(n, 0.5, 1.2, view)
    rng = np.random.default_rng(3)
    sphere = rng.normal(size=(20000, 3))
    sphere /= np.linalg.norm(sphere, axis=1)[:, None]
    body = 0.5 * sphere + (1.2 - 0.5) * (sphere @ n)[:, None] * n
    shown = view.project(body)
    for angle in np.linspace(0, math.pi, 7):
        way = np.array([math.cos(angle), math.sin(angle)])
        assert np.max(shown @ way) == pytest.approx(np.max(outline @ way), rel=5e-3)


def test_paths_on_a_sphere_are_shown_on_the_near_side_only(monkeypatch):
    angles = np.linspace(0.0, 2.0 * math.pi, 400)
    equator = 5.0 * np.column_stack([np.cos(angles), np.sin(angles), 0 * angles])
    view = ed.plots.View(0.5, 0.3)
    drawing, _ = drawn(monkeypatch, ed.plots.sphere_paths, [equator], ["x", "y", "z"], "w", view)
    shown = np.vstack([s.points for s in drawing if isinstance(s, shapes.Curve)])
    assert np.allclose(np.linalg.norm(shown, axis=1), 1.0)
    assert np.all(shown @ view.axes[2] > 0)
    assert abs(len(shown) - 200) <= 2
    with pytest.raises(ed.EngdynError, match="path 1"):
        ed.plots.sphere_paths([np.zeros((3, 3))], ["x", "y", "z"], "w")


@pytest.mark.parametrize(
    "call",
    [
        lambda: ed.plots.gyroscope(),
        lambda: ed.plots.bicycle(0.2, 0.1),
        lambda: ed.plots.precession_cones((0.4, 0, 1), (0.1, 0, 1), (0, 0, 1)),
        lambda: ed.plots.sphere_paths([np.eye(3)], ["x", "y", "z"], "three directions"),
    ],
)
def test_labels_stay_inside_the_picture(call):
    ax = call()
    ax.figure.canvas.draw()
    frame = ax.figure.bbox
    for text in ax.texts:
        extent = text.get_window_extent()
        assert frame.x0 <= extent.x0 <= extent.x1 <= frame.x1
        assert frame.y0 <= extent.y0 <= extent.y1 <= frame.y1
    assert len(ed.plots.alt(ax)) > 10
