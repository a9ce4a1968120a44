"""Numbers, symbols and poses in words."""

from __future__ import annotations

import math

import pytest
from sympy.physics.vector import dynamicsymbols

import engdyn as ed
from engdyn.plots.axes import coordinate_range, index_of, split
from engdyn.plots.words import number, pose, quantity, symbol, with_unit


@pytest.mark.parametrize(
    ("value", "text"),
    [(0.0, "0"), (1e-17, "0"), (-1e-17, "0"), (1234.5678, "1235"), (-0.25, "−0.25"), (1e-5, "1e−05")],
)
def test_numbers(value, text):
    assert number(value) == text


def test_angles_are_told_in_degrees_too():
    assert quantity("theta", math.pi, "rad") == "theta = 3.142 rad (180.0°)"
    assert quantity("theta", 0.0, "rad") == "theta = 0 rad"
    assert quantity("N", 80.0, "-") == "N = 80"


def test_pose_names_every_coordinate():
    crane = ed.systems.load("S07")
    assert pose(crane.coordinates, [2.0, -0.1]) == "x = 2 m, theta = −0.1 rad (−5.7°)"


def test_symbols_are_mathtext():
    crane, car = ed.systems.load("S07"), ed.systems.load("S23")
    assert symbol(crane.coordinates[1]) == r"$\theta$"
    assert symbol(crane.parameters[0]) == "$M_{t}$"
    assert symbol(car.coordinates[2]) == "$z_{f}$"
    assert with_unit("$V$", "J") == "$V$ [J]"
    assert with_unit("$N$", "-") == "$N$ [1]"


def test_greek_names_are_not_split():
    assert symbol(ed.Coordinate(dynamicsymbols("xi"), "m", "position")) == r"$\xi$"


def test_ranges_hold_what_is_shown():
    angle = ed.Coordinate(dynamicsymbols("theta"), "rad", "angle", (-1.0, 1.0))
    assert coordinate_range(angle) == (-1.0, 1.0)
    assert coordinate_range(angle, [2.0]) == (-1.0, 2.0)
    free = ed.Coordinate(dynamicsymbols("theta"), "rad", "angle")
    assert coordinate_range(free) == (-math.pi, math.pi)
    length = ed.Coordinate(dynamicsymbols("x"), "m", "position", None, "ignorable")
    assert coordinate_range(length) == (-1.0, 1.0)
    assert coordinate_range(length, [4.0]) == (-6.0, 6.0)


def test_unknown_coordinate_is_named_with_the_known_ones():
    with pytest.raises(ed.EngdynError, match="no coordinate 'phi'; choose one of x, theta"):
        index_of(ed.systems.load("S07"), "phi")


def test_runs_of_a_mask_join():
    import numpy as np

    assert split(np.array([True, True, False, False, True])) == [slice(0, 3), slice(2, 5), slice(4, 5)]
    assert split(np.array([False])) == [slice(0, 1)]
