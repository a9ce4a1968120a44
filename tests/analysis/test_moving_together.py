"""Steady motions of coordinates that move together: trains, drive trains, free rotors."""

from __future__ import annotations

from math import pi

import numpy as np
import pytest
import sympy as sm

import engdyn as ed
from analysis import small_systems as small
from analysis.checks import (
    is_steady,
)


def train(resistance, fixed=False):
    """Three cars in a row, pulled in front."""
    x1, x2, x3 = small.coordinates("x1 x2 x3")
    m, k, c, l = small.symbols("m k c l")
    F = sm.Function("F")(small.T)
    kinetic = m * (x1.diff() ** 2 + x2.diff() ** 2 + 2 * x3.diff() ** 2) / 2
    potential = k * ((x1 - x2) ** 2 + (x2 - x3 - l) ** 2) / 2 + int(fixed) * k * x1**2
    eom = ed.lagrange(kinetic, potential, [x1, x2, x3], c * x3.diff() ** 2 / 2, {x1: F})
    return eom, {"m": 2.0, "k": 100.0, "c": resistance, "l": 0.5}


def test_a_train_accelerates_as_a_whole():
    eom, values = train(0.0)
    (e,) = ed.equilibria(eom, values, inputs={"F": 8.0})
    np.testing.assert_allclose(e.accelerations, [1.0, 1.0, 1.0], rtol=1e-14)
    np.testing.assert_allclose(e.q, [0.0, -0.06, -0.6], rtol=1e-12)  # 6 N and 4 N in the couplings
    assert is_steady(eom, e)


def test_a_train_reaches_a_speed_as_a_whole():
    eom, values = train(4.0)
    answer = ed.equilibria(eom, values, inputs={"F": 8.0})
    assert answer.neutral == ("x1",)
    (e,) = answer
    np.testing.assert_allclose(e.speeds, [2.0, 2.0, 2.0], rtol=1e-14)
    np.testing.assert_allclose(e.q, [0.0, -0.08, -0.66], rtol=1e-12)  # 8 N in both couplings
    assert is_steady(eom, e)


def test_prescribing_one_rate_prescribes_those_of_the_coupled_cars():
    eom, values = train(4.0)
    (e,) = ed.equilibria(eom, values, rates={"x2": 3.0}, free=["F"])
    np.testing.assert_allclose([*e.speeds, e.inputs["F"]], [3.0, 3.0, 3.0, 12.0], rtol=1e-14)
    with pytest.raises(ed.EngdynError, match="not steady"):
        ed.equilibria(eom, values, rates={"x2": 3.0, "x1": 2.0}, free=["F"])


def test_a_fixed_train_is_an_ordinary_equilibrium():
    eom, values = train(4.0, fixed=True)
    answer = ed.equilibria(eom, values, inputs={"F": 8.0})
    assert answer.neutral == ()
    np.testing.assert_allclose(answer[0].q, [0.04, 0.04, -0.46], rtol=1e-12)


def test_drive_train_in_steady_operation():
    """S20: all shafts turn together; the torque balance is a quadratic in the rotor speed."""
    case = small.drive_train()
    v = case.values
    answer = ed.equilibria(case.eom, v, case.bounds)
    assert answer.neutral == ("tr",)
    wind = v["rho"] * pi * v["R"] ** 3 * v["v"] ** 2 / 2
    ratio = v["R"] / v["v"]
    brake = v["B"] * v["N"]
    quadratic = [
        wind * v["q_2"] * ratio**2,
        wind * v["q_1"] * ratio - brake * v["N"],
        wind * v["q_0"] + brake * v["w_0"],
    ]
    rates = [x.real for x in np.roots(quadratic) if -5.0 <= x.real <= 10.0]
    assert len(answer) == len(rates) == 1
    (e,) = answer
    np.testing.assert_allclose(e.speeds, np.array([1.0, 80.0, 80.0]) * rates[0], rtol=1e-12)
    torque = v["B"] * (e.speeds[2] - v["w_0"])
    np.testing.assert_allclose(e.q[2] - e.q[1], -torque / v["K_h"], rtol=1e-9)
    np.testing.assert_allclose(e.q[1] / v["N"], -torque * v["N"] / v["K_s"], rtol=1e-9)
    assert is_steady(case.eom, e)


def test_rotors_on_a_common_shaft_without_a_drive_stand_still_or_need_a_rate():
    theta1, theta2 = small.coordinates("theta1 theta2")
    J, k = small.symbols("J k")
    kinetic = J * (theta1.diff() ** 2 + 3 * theta2.diff() ** 2) / 2
    eom = ed.lagrange(kinetic, k * (1 - sm.cos(theta1 - theta2)), [theta1, theta2])
    answer = ed.equilibria(eom, {"J": 1.0, "k": 2.0})
    assert [e.q.tolist() for e in answer] == [[0.0, 0.0], [0.0, pi]]
    assert all(e.accelerations.tolist() == [0.0, 0.0] for e in answer)


def test_a_nonholonomic_system_runs_straight():
    case = small.castor()
    (e,) = ed.equilibria(case.eom, case.values, case.bounds)
    assert e.q.tolist() == [0.0, 0.0]
    assert e.speeds.tolist() == [0.0]
