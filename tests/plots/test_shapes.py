"""Shapes are checked data."""

from __future__ import annotations

import dataclasses
import math

import numpy as np
import pytest

from engdyn import EngdynError, shapes
from engdyn.plots import arrows  # noqa: F401  (registers arrows with trace)
from engdyn.plots.pen import Pen
from engdyn.plots.projection import View
from engdyn.plots.symbols import trace

KINDS = [getattr(shapes, name) for name in shapes.__all__ if name not in ("ROLES", "Shape")]

SAMPLE = {
    "start": (0.0, 0.0),
    "end": (1.0, 2.0),
    "center": (1.0, -1.0),
    "radius": 0.5,
    "point": (3.0, 4.0),
    "origin": (0.0, 1.0),
    "points": ((0.0, 0.0), (1.0, 0.0), (1.0, 1.0)),
    "size": (2.0, 1.0),
    "text": "$m$",
}


def sample(kind, **changes):
    """One shape of a kind; for arcs, start and end are angles."""
    names = [f.name for f in dataclasses.fields(kind)]
    chosen = {name: SAMPLE[name] for name in names if name in SAMPLE}
    if "center" in names and "start" in names:
        chosen |= {"start": 0.2, "end": 1.4}
    return kind(**{**chosen, **changes})


def traced(shape, unit=0.01):
    pen = Pen(unit, View())
    trace(shape, pen)
    return pen


@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: kind.__name__)
def test_every_shape_is_immutable_hashable_data_and_can_be_drawn(kind):
    shape = sample(kind)
    assert shape == sample(kind)
    assert len({shape, sample(kind)}) == 1
    with pytest.raises(dataclasses.FrozenInstanceError):
        shape.role = "body"
    pen = traced(shape)
    if kind is shapes.Label:
        assert [words.text for words in pen.texts] == ["$m$"]
    else:
        assert len(pen.points()) > 1
    assert np.all(np.isfinite(pen.points()))


@pytest.mark.parametrize("kind", [k for k in KINDS if "label" in [f.name for f in dataclasses.fields(k)]])
def test_every_label_is_written_exactly_once(kind):
    assert [words.text for words in traced(sample(kind, label="$q$")).texts] == ["$q$"]
    assert traced(sample(kind)).texts == []


@pytest.mark.parametrize(
    "kind",
    [
        k
        for k in KINDS
        if {"start", "end"} <= {f.name for f in dataclasses.fields(k)} and k is not shapes.Wheel
    ],
)
def test_a_shape_of_no_length_still_draws_finite_lines(kind):
    here = 0.7 if "center" in [f.name for f in dataclasses.fields(kind)] else (1.0, 1.0)
    assert np.all(np.isfinite(traced(sample(kind, start=here, end=here)).points()))


@pytest.mark.parametrize(
    ("point", "message"),
    [
        ((1.0,), r"2 .plane. or 3 .space."),
        ((1.0, 2.0, 3.0, 4.0), r"2 .plane. or 3 .space."),
        ("ab", "no point"),
        (None, "no point"),
        ((math.nan, 0.0), "not finite"),
        ((0.0, math.inf), "not finite"),
    ],
)
def test_what_is_no_point_is_refused_by_name(point, message):
    if point is None:
        point = object()
    with pytest.raises(EngdynError, match=rf"Pin\.point.*{message}"):
        shapes.Pin(point)


def test_numbers_texts_and_roles_are_checked():
    with pytest.raises(EngdynError, match=r"Disc\.radius"):
        shapes.Disc((0, 0), math.nan)
    with pytest.raises(EngdynError, match=r"Support.label is 3.1.*by name"):
        shapes.Support((0, 0), math.pi)
    with pytest.raises(EngdynError, match=r"Link\.role 'rod' is unknown; choose from body, link"):
        shapes.Link((0, 0), (1, 0), role="rod")
    with pytest.raises(EngdynError, match="at least two points"):
        shapes.Curve([(0, 0)])


def test_points_become_tuples_of_floats():
    link = shapes.Link(np.array([1, 2]), [3, 4, 5])
    assert link.start == (1.0, 2.0)
    assert link.end == (3.0, 4.0, 5.0)
    assert all(type(x) is float for x in (*link.start, *link.end))


def test_what_is_no_shape_cannot_be_drawn():
    with pytest.raises(EngdynError, match="list of shapes"):
        traced("a spring")


# How they look


def test_spring_runs_from_end_to_end_with_its_coils_and_width():
    pen = traced(shapes.Spring((0, 0), (0, 2), coils=4, width=0.3))
    (line,) = pen.lines
    assert line.points[0] == pytest.approx([0, 0])
    assert line.points[-1] == pytest.approx([0, 2])
    assert np.ptp(line.points[:, 0]) == pytest.approx(0.3)
    crossings = np.count_nonzero(np.diff(np.sign(line.points[np.abs(line.points[:, 0]) > 1e-9, 0])))
    assert crossings == 7  # four coils: eight flanks, seven crossings of the axis


def test_dashpot_keeps_a_cylinder_of_three_widths_when_pulled_out():
    short, long = (traced(shapes.Damper((0, 0), (length, 0), width=0.1)) for length in (0.2, 10.0))
    cylinder = [np.ptp(pen.lines[1].points[:, 0]) for pen in (short, long)]
    assert cylinder[1] == pytest.approx(0.3)
    assert cylinder[0] < 0.2
    for pen, length in ((short, 0.2), (long, 10.0)):
        assert pen.lines[0].points[0] == pytest.approx([0, 0])
        assert pen.lines[-1].points[-1] == pytest.approx([length, 0])


def test_arrow_heads_point_where_they_should():
    pen = traced(shapes.ForceArrow((0, 0), (3, 4)))
    (head,) = pen.areas
    assert head.points[0] == pytest.approx([3, 4])
    back = head.points[[1, 3]].mean(axis=0)
    assert np.cross([*(head.points[0] - back), 0], [3, 4, 0])[2] == pytest.approx(0, abs=1e-12)
    # The line stops inside the head: a thick line would blunt the tip.
    assert np.linalg.norm(pen.lines[-1].points[-1] - [3, 4]) > 0.05


def test_moment_arrow_ends_at_its_angle_tangentially():
    pen = traced(shapes.MomentArrow((1, 1), 2.0, 0.0, math.pi / 2), unit=0.001)
    tip, back = pen.areas[0].points[0], pen.areas[0].points[[1, 3]].mean(axis=0)
    assert tip == pytest.approx([1, 3])
    along = (tip - back) / np.linalg.norm(tip - back)
    assert along == pytest.approx([-1, 0], abs=0.05)  # the arc is a polygon with steps of 0.05 rad


@pytest.mark.parametrize(("length", "shown"), [(0.5, 0.5), (-0.5, -0.5), (0.0, 0.3), (0.1, 0.3)])
def test_a_coordinate_too_small_to_see_shows_its_positive_sense(length, shown):
    pen = traced(shapes.CoordinateArrow((0, 0), (length, 0)), unit=0.01)
    assert pen.areas[0].points[0] == pytest.approx([shown, 0.0])


@pytest.mark.parametrize(
    ("angle", "positive", "sense"), [(0.8, 1, 1), (-0.8, 1, -1), (0.0, 1, 1), (0.0, -1, -1)]
)
def test_angle_arrow_turns_the_right_way(angle, positive, sense):
    pen = traced(shapes.AngleArrow((0, 0), 1.0, 0.0, angle, positive=positive), unit=0.01)
    tip = pen.areas[0].points[0]
    assert np.sign(tip[1]) == sense
    assert np.hypot(*tip) == pytest.approx(1.0)
    if angle:
        assert math.atan2(tip[1], tip[0]) == pytest.approx(angle)


@pytest.mark.parametrize(("end", "side"), [((1, 0), -1), ((-1, 0), 1)])
def test_ground_is_hatched_on_the_right_hand_side(end, side):
    surface, *strokes = traced(shapes.Ground((0, 0), end), unit=0.01).lines
    assert surface.points == pytest.approx(np.array([(0, 0), end]))
    assert len(strokes) > 5
    assert all(np.sign(stroke.points[1, 1]) == side for stroke in strokes)


def test_tire_is_flattened_at_the_road():
    tire, hub = traced(shapes.Wheel((0, 0.27), 0.3, flat=0.0)).areas
    assert tire.points[:, 1].min() == 0.0
    assert tire.points[:, 1].max() == pytest.approx(0.57)
    assert hub.points[:, 1].min() > 0.0


def test_dimension_is_set_off_to_the_left():
    pen = traced(shapes.Dimension((0, 0), (2, 0), "$a$", offset=0.5))
    assert pen.lines[-1].points == pytest.approx(np.array([(0, 0.5), (2, 0.5)]))
    tips = sorted(area.points[0].tolist() for area in pen.areas)
    assert tips == [pytest.approx([0, 0.5]), pytest.approx([2, 0.5])]


def test_a_particle_in_front_of_a_plate_is_not_hidden():
    view = View(0.0, 0.0)  # the eye stands on the X axis
    pen = Pen(0.01, view)
    trace(shapes.Polygon(((1.0, -1.0, -1.0), (1.0, 1.0, -1.0), (1.0, 0.0, 1.0))), pen)
    for x in (0.5, 1.5):
        trace(shapes.Particle((x, 0.0, 0.0)), pen)
    plate, behind, before = pen.areas
    assert behind.depth < plate.depth < before.depth


@pytest.mark.parametrize("end", [0.8, -0.8])
def test_a_torsional_damper_looks_after_a_full_turn_as_before(end):
    drawn = []
    for turned in (end, end + math.copysign(4.0 * math.pi, end)):
        pen = Pen(1e-3, View())
        trace(shapes.TorsionalDamper((0.0, 0.0), 0.1, 0.0, turned, "$c$"), pen)
        drawn.append(np.vstack([pen.points(), pen.texts[0].anchors]))
    assert drawn[1] == pytest.approx(drawn[0], abs=1e-12)
