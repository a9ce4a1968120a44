"""What `equilibria` refuses, with a message that helps."""

from __future__ import annotations

import math

import numpy as np
import pytest
import sympy as sm

import engdyn as ed
from analysis import small_systems as small


@pytest.mark.parametrize(
    ("bounds", "message"),
    [
        ({"theta": (1.0, -1.0)}, "reversed"),
        ({"theta": (1.0, 1.0)}, "reversed"),
        ({"theta": (math.nan, 1.0)}, "finite"),
        ({"theta": (0.0, math.inf)}, "finite"),
        ({"theta": None}, r"give \(lower, upper\)"),
        ({"theta": 3.0}, r"give \(lower, upper\)"),
        ({"theta": ("a", "b")}, r"give \(lower, upper\)"),
        ({"thta": (-1.0, 1.0)}, "the coordinates are theta"),
    ],
)
def test_bad_bounds_are_refused(bounds, message):
    case = small.pendulum()
    with pytest.raises(ed.EngdynError, match=message):
        ed.equilibria(case.eom, case.values, bounds)


def test_missing_bounds_are_asked_for_by_name():
    case = small.sprung_double_pendulum()
    with pytest.raises(
        ed.EngdynError, match=r"bounds for theta2 to engdyn.equilibria: bounds=\{'theta2': \(lower, upper\)\}"
    ):
        ed.equilibria(case.eom, case.values, {"theta1": (-2.0, 2.0)})


@pytest.mark.parametrize("change", [{"g": math.nan}, {"g": math.inf}, {"g": "9.81 m"}, {"g": None}])
def test_bad_values_are_refused(change):
    case = small.pendulum()
    with pytest.raises(ed.EngdynError, match="parameter g"):
        ed.equilibria(case.eom, {**case.values, **change})


def test_missing_values_unknown_inputs_and_other_things_are_refused():
    case = small.isolator()
    with pytest.raises(ed.EngdynError, match="lacks the parameters k_1, k_2"):
        ed.equilibria(
            case.eom, {k: v for k, v in case.values.items() if k not in ("k_1", "k_2")}, case.bounds
        )
    with pytest.raises(ed.EngdynError, match="unknown input 'G'"):
        ed.equilibria(case.eom, case.values, case.bounds, inputs={"G": 1.0})
    with pytest.raises(ed.EngdynError, match="give EquationsOfMotion"):
        ed.equilibria(ed.systems.load(7), {})
    with pytest.raises(ed.EngdynError, match="values must map"):
        ed.equilibria(case.eom, [1.0], case.bounds)


def test_time_in_the_equations_is_refused():
    (x,) = small.coordinates("x")
    m, k, F_0, w = small.symbols("m k F_0 w")
    driven = ed.lagrange(m * x.diff() ** 2 / 2, k * x**2 / 2, [x], forces={x: F_0 * sm.cos(w * small.T)})
    values = {"m": 1.0, "k": 2.0, "F_0": 3.0, "w": 4.0}
    with pytest.raises(ed.EngdynError, match="contain time explicitly"):
        ed.equilibria(driven, values, {"x": (-1.0, 1.0)})
    still = ed.equilibria(driven, {**values, "F_0": 0.0})
    assert [e.q[0] for e in still] == [0.0]


def test_an_undefined_equation_decides_nothing():
    """√(x) is not defined left of zero: that part stays undecided, the root right of it is found."""
    (x,) = small.coordinates("x")
    eom = ed.lagrange(x.diff() ** 2 / 2, x - sm.Rational(4, 3) * x ** sm.Rational(3, 2), [x])
    answer = ed.equilibria(eom, {}, {"x": (-0.5, 1.0)})
    assert not answer.certified
    np.testing.assert_allclose([e.q[0] for e in answer], [0.25], atol=1e-12)


@pytest.mark.parametrize("argument", ["bounds", "inputs", "rates", "accelerations"])
@pytest.mark.parametrize("wrong", ["x", [1.0, 2.0], np.ones(3)])
def test_what_has_names_is_a_mapping(argument, wrong):
    bar = ed.systems.load("W7")
    with pytest.raises(ed.EngdynError, match=f"{argument} is .*: give a mapping"):
        ed.equilibria(bar.equations, bar.values(), **{argument: wrong})
    with pytest.raises(ed.EngdynError, match="values is 'x': give a mapping"):
        ed.continue_equilibria(bar.equations, "x", "k", (1.0, 2.0))
