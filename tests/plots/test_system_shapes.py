"""Drawings take their geometry from the parameters of the model."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import engdyn as ed
from engdyn import shapes
from engdyn.plots.drawing import shown_pose
from engdyn.plots.words import symbol

S03, S07, S23 = (ed.systems.load(number) for number in (3, 7, 23))
ANGLE = st.floats(-math.pi, math.pi)
LENGTH = st.floats(0.05, 20.0)


def of(kind, drawn):
    return [shape for shape in drawn if isinstance(shape, kind)]


def texts(drawn):
    return [getattr(shape, "label", "") or getattr(shape, "text", "") for shape in drawn]


@pytest.mark.parametrize("system", [S03, S07, S23], ids=repr)
def test_a_drawing_names_what_the_model_holds(system):
    drawn = system.shapes(shown_pose(system), system.values())
    words = (
        " ".join(texts(drawn)).replace("$", " ").replace(",", " ").replace("{", "").replace("}", "").split()
    )
    for parameter in system.parameters:
        plain = symbol(parameter).strip("$").replace("{", "").replace("}", "")
        assert plain in words, parameter.name
    coordinates = of((shapes.CoordinateArrow, shapes.AngleArrow), drawn)
    assert len(coordinates) == len(system.coordinates)
    shown = {shape.label.strip("$").replace("{", "").replace("}", "") for shape in coordinates}
    assert shown == {symbol(c).strip("$").replace("{", "").replace("}", "") for c in system.coordinates}
    assert of(shapes.GravityArrow, drawn)


@pytest.mark.parametrize("system", [S03, S07, S23], ids=repr)
def test_every_force_and_prescribed_motion_has_an_arrow(system):
    drawn = system.shapes(shown_pose(system), system.values())
    arrows = {shape.label.strip("$") for shape in of((shapes.ForceArrow, shapes.MomentArrow), drawn)}
    wanted = {
        symbol(i).strip("$").replace("{", "").replace("}", "")
        for i in system.inputs
        if i.kind != "drive angle"
    }
    assert wanted <= {label.replace("{", "").replace("}", "") for label in arrows}


# S03 flyball governor


@given(st.floats(-1.5, 1.5), LENGTH)
def test_governor_arms_and_links_have_the_length_l(theta, l):
    drawn = S03.shapes([theta], S03.values(l=l))
    balls = np.array([disc.center for disc in of(shapes.Disc, drawn)])
    (collar,) = (np.array(box.center) for box in of(shapes.Box, drawn))
    assert np.hypot(*balls.T) == pytest.approx([l, l])
    assert np.hypot(*(balls - collar).T) == pytest.approx([l, l])
    assert collar == pytest.approx([0.0, -2.0 * l * math.cos(theta)])
    # The first ball is the one that theta counts outward: the arms cross for negative angles.
    assert balls[0] == pytest.approx([l * math.sin(theta), -l * math.cos(theta)])
    assert balls[1] == pytest.approx([-l * math.sin(theta), -l * math.cos(theta)])


def test_governor_spring_joins_the_pin_and_the_collar():
    drawn = S03.shapes([0.6], S03.values())
    (spring,), (collar,) = of(shapes.Spring, drawn), of(shapes.Box, drawn)
    assert (spring.start, spring.end) == ((0.0, 0.0), collar.center)
    length = math.dist(spring.start, spring.end)
    # Relaxed at theta = 0, compressed by 2 l (1 - cos(theta)), as in the potential energy.
    assert 2 * 0.25 - length == pytest.approx(2 * 0.25 * (1 - math.cos(0.6)))


def test_governor_force_pushes_the_collar_up():
    drawn = S03.shapes([0.6], S03.values())
    (force,) = (arrow for arrow in of(shapes.ForceArrow, drawn) if arrow.label == "$F$")
    assert force.end[0] == force.start[0]
    assert force.end[1] > force.start[1]


# S07 gantry crane


@given(st.floats(-30, 30), ANGLE, LENGTH)
def test_crane_container_hangs_at_the_length_L_below_the_hinge(x, theta, L):
    drawn = S07.shapes([x, theta], S07.values(L=L))
    trolley, container = of(shapes.Box, drawn)
    assert trolley.center == pytest.approx((x, 0.0))
    assert container.center == pytest.approx((x + L * math.sin(theta), -L * math.cos(theta)))
    assert container.angle == theta
    (mass_center,) = of(shapes.CenterOfMass, drawn)
    assert mass_center.point == container.center
    (spreader,) = of(shapes.Link, drawn)
    assert math.dist(spreader.start, spreader.end) == pytest.approx(L)


@given(ANGLE)
def test_crane_forces_point_to_the_right(theta):
    for arrow in of(shapes.ForceArrow, S07.shapes([1.0, theta], S07.values())):
        assert arrow.end[0] > arrow.start[0]
        assert arrow.end[1] == arrow.start[1]


def test_crane_angle_is_counted_from_the_downward_vertical():
    (angle,) = of(shapes.AngleArrow, S07.shapes([0.0, 0.4], S07.values()))
    assert (angle.start, angle.end) == (-math.pi / 2, 0.4 - math.pi / 2)
    assert angle.label == r"$\theta$"


# S23 half-car


def pins(q, **values):
    front, rear = of(shapes.Pin, S23.shapes(q, S23.values(**values)))
    return np.array(front.point), np.array(rear.point)


SMALL = st.floats(-0.4, 0.4)


@given(SMALL, st.floats(-1.4, 1.4), SMALL, SMALL, st.floats(0.2, 4.0), st.floats(0.2, 4.0))
def test_half_car_attachments_rise_as_the_model_says(z, theta, zf, zr, a, b):
    front, rear = pins([z, theta, zf, zr], a=a, b=b)
    front_0, rear_0 = pins([0, 0, 0, 0], a=a, b=b)
    assert front[1] - front_0[1] == pytest.approx(z + a * math.sin(theta))
    assert rear[1] - rear_0[1] == pytest.approx(z - b * math.sin(theta))
    assert math.dist(front, rear) == pytest.approx(a + b)


@given(SMALL, st.floats(-1.0, 1.0), SMALL, SMALL)
def test_half_car_suspensions_are_vertical_and_stand_on_the_wheels(z, theta, zf, zr):
    drawn = S23.shapes([z, theta, zf, zr], S23.values())
    at_rest = S23.shapes([0, 0, 0, 0], S23.values())
    for now, before in zip(of(shapes.Spring, drawn), of(shapes.Spring, at_rest), strict=True):
        assert now.start[0] == now.end[0]
        assert before.start[0] == before.end[0]
    rises = [
        now.center[1] - before.center[1]
        for now, before in zip(of(shapes.Wheel, drawn), of(shapes.Wheel, at_rest), strict=True)
    ]
    assert rises == pytest.approx([zf, zr])
    feet = [
        now.start[1] - before.start[1]
        for now, before in zip(of(shapes.Spring, drawn), of(shapes.Spring, at_rest), strict=True)
    ]
    assert feet == pytest.approx([zf, zr])


def test_half_car_wheels_touch_the_road_when_the_tires_are_relaxed():
    for wheel in of(shapes.Wheel, S23.shapes([0, 0, 0, 0], S23.values())):
        assert wheel.center[1] == pytest.approx(wheel.radius)
        assert wheel.flat == 0.0
