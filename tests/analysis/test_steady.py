"""Steady motions: constant rates and accelerations, free inputs, coordinates that move together."""

from __future__ import annotations

import math
from math import pi

import numpy as np
import pytest
import sympy as sm

import engdyn as ed
from analysis import small_systems as small
from analysis.checks import (
    is_steady,
)

CRANE = ed.systems.load(7)
EOM = CRANE.equations


def crane(**more):
    values = CRANE.values(**more.pop("values", {}))
    return values, ed.equilibria(EOM, values, CRANE.bounds, **more)


# ---------------------------------------------------------------- the crane in all its steady motions


def test_at_rest_the_trolley_may_stand_anywhere():
    values, answer = crane()
    assert answer.neutral == ("x",)
    assert [e.q.tolist() for e in answer] == [[0.0, 0.0], [0.0, pi]]
    assert not any(e.speeds.any() or e.accelerations.any() for e in answer)
    for x in (-3.0, 7.5):
        for e in answer:
            still = EOM.accelerations([x, e.q[1]], [0.0, 0.0], values)
            np.testing.assert_allclose(still, 0.0, atol=1e-14)


def test_a_constant_force_gives_a_constant_acceleration_without_resistance():
    _, answer = crane(values={"c_x": 0.0}, inputs={"F": 3700.0})
    np.testing.assert_allclose([e.q[1] for e in answer], [-0.10159, 3.04001], atol=5e-6)
    assert [e.accelerations.tolist() for e in answer] == [[1.0, 0.0]] * 2
    assert all(is_steady(EOM, e) for e in answer)


def test_a_constant_force_gives_a_constant_speed_against_resistance():
    _, answer = crane(inputs={"F": 3700.0})
    assert [e.speeds[0] for e in answer] == [3700.0 / 400.0] * 2
    assert [e.q[1] for e in answer] == [0.0, pi]
    assert all(is_steady(EOM, e) for e in answer)


def test_prescribed_acceleration_with_the_force_solved_for():
    _, answer = crane(values={"c_x": 0.0}, accelerations={"x": 1.0}, free=["F"])
    np.testing.assert_allclose([e.inputs["F"] for e in answer], [3700.0, 3700.0], rtol=1e-12)
    np.testing.assert_allclose([e.q[1] for e in answer], [-0.10159, 3.04001], atol=5e-6)


def test_prescribed_acceleration_with_the_force_that_belongs_to_it():
    _, answer = crane(values={"c_x": 0.0}, accelerations={"x": 1.0}, inputs={"F": 3700.0})
    np.testing.assert_allclose([e.q[1] for e in answer], [-0.10159, 3.04001], atol=5e-6)
    # 0.1 and 3700 * 0.1 do not match to the last digit: rounding of what is given is not an obstacle
    _, answer = crane(values={"c_x": 0.0}, accelerations={"x": 0.1}, inputs={"F": 3700.0 * 0.1})
    assert len(answer) == 2


def test_a_free_force_may_follow_the_resistance_of_an_accelerating_trolley():
    _, answer = crane(accelerations={"x": 1.0}, free="F")
    np.testing.assert_allclose([e.q[1] for e in answer], [-0.10159, 3.04001], atol=5e-6)


def test_a_steady_speed_in_the_wind_and_standing_in_the_wind():
    tilt = math.atan2(5000.0, 2500.0 * 9.81)
    _, running = crane(inputs={"W": 5000.0})
    np.testing.assert_allclose([e.q[1] for e in running], [tilt - pi, tilt], atol=1e-12)
    assert [e.speeds[0] for e in running] == [12.5, 12.5]
    _, held = crane(inputs={"W": 5000.0}, rates={"x": 0.0}, free=["F"])
    np.testing.assert_allclose([e.q[1] for e in held], [tilt - pi, tilt], atol=1e-12)
    np.testing.assert_allclose([e.inputs["F"] for e in held], [-5000.0, -5000.0], rtol=1e-12)


def test_a_motion_that_no_force_keeps_up_is_no_equilibrium_and_says_why():
    _, answer = crane(values={"c_x": 0.0}, accelerations={"x": 1.0})
    assert len(answer) == 0
    assert answer.certified
    assert "equation 1 reads 3700 = 0" in answer.explanation
    assert answer.explanation in repr(answer)
    _, answer = crane(rates={"x": 2.0})
    assert "equation 1 reads 800 = 0" in answer.explanation


def test_the_measure_of_an_unsatisfied_equation_is_that_equation():
    """A large number elsewhere must not hide a small force that nothing balances."""
    x, y = small.coordinates("x y")
    k, P = small.symbols("k P")
    eom = ed.lagrange((x.diff() ** 2 + y.diff() ** 2) / 2, k * y**2 / 2 - P * x, [x, y])
    answer = ed.equilibria(eom, {"k": 1e11, "P": 0.01}, rates={"x": 0.0})
    assert len(answer) == 0
    assert "-0.01 = 0" in answer.explanation


@pytest.mark.parametrize(
    ("more", "message"),
    [
        ({"free": ["F"]}, r"1 equation for 2 unknowns \(theta, x_d\): prescribe"),
        ({"free": ["F", "W"], "rates": {"x": 2.0}}, r"1 equation for 2 unknowns \(theta, F\)"),
        ({"rates": {"theta": 1.0}}, r"\(theta_d\) is not steady"),
        ({"accelerations": {"theta": 1.0}}, r"is not steady"),
        ({"accelerations": {"x": 1.0}, "inputs": {"F": 3700.0}}, r"\(x_dd\) is not steady: equation 1"),
        ({"free": ["Q"]}, "the equations have F, W"),
        ({"rates": {"z": 1.0}}, "the coordinates are x, theta"),
        ({"rates": {"x": math.nan}}, "finite"),
        ({"accelerations": {"x": "fast"}}, "finite"),
    ],
)
def test_what_is_not_steady_or_not_determined_is_refused(more, message):
    with pytest.raises(ed.EngdynError, match=message):
        crane(**more)


def test_more_equations_than_unknowns_are_refused():
    """Two forces that both depend on x, while y is held: one input has to be free."""
    x, y = small.coordinates("x y")
    (k,) = small.symbols("k")
    f = sm.Function("f")(small.T)
    kinetic = (x.diff() ** 2 + y.diff() ** 2) / 2
    linear = ed.lagrange(kinetic, k * x**2 / 2, [x, y], forces={x: f, y: f - k * x})
    held = {"rates": {"y": 0.0}, "inputs": {"f": 1.0}}
    (e,) = ed.equilibria(linear, {"k": 2.0}, {"x": (-1.0, 1.0)}, **held)  # both say x = f/k
    assert e.q.tolist() == [0.5, 0.0]
    cubic = ed.lagrange(kinetic, k * x**4 / 2, [x, y], forces={x: f, y: f - k * x**2})
    with pytest.raises(ed.EngdynError, match=r"2 equations for 1 unknown \(x\): name an input in free"):
        ed.equilibria(cubic, {"k": 2.0}, {"x": (-1.0, 1.0)}, **held)
    freed = ed.equilibria(cubic, {"k": 2.0}, {"x": (-1.0, 1.0)}, rates={"y": 0.0}, free=["f"])
    assert any(np.allclose([*e.q, e.inputs["f"]], [0.5, 0.0, 0.5]) for e in freed)


def test_numpy_numbers_are_numbers():
    for number in (np.float64(2.0), np.float32(2.0), np.int64(2)):
        _, answer = crane(rates={"x": number}, free=["F"])
        np.testing.assert_allclose([e.inputs["F"] for e in answer], [800.0, 800.0], rtol=1e-12)


# ---------------------------------------------------------------- ignorable coordinates


def test_turntable_at_its_reference_rate():
    """S06: k (s − s_0) = m s Ω², the offset has no influence; M = c_t Ω holds the rate."""
    case = small.turntable()
    v, Omega = case.values, 12.0
    s = v["k"] * v["s_0"] / (v["k"] - v["m"] * Omega**2)
    answer = ed.equilibria(case.eom, v, case.bounds, rates={"theta": Omega}, free=["M"])
    assert answer.neutral == ("theta",)
    (e,) = answer
    np.testing.assert_allclose([e.q[1], e.inputs["M"]], [s, v["c_t"] * Omega], rtol=1e-12)
    assert is_steady(case.eom, e)


def test_turntable_with_a_given_torque_finds_its_rate():
    case = small.turntable()
    bounds = {**case.bounds, "theta_d": (0.0, 20.0)}
    (e,) = ed.equilibria(case.eom, case.values, bounds, inputs={"M": 0.6})
    np.testing.assert_allclose(e.speeds, [12.0, 0.0], rtol=1e-12)
    assert is_steady(case.eom, e)


def test_turntable_without_drive_and_friction_keeps_any_rate():
    case = small.turntable()
    values = {**case.values, "c_t": 0.0}
    for rate in (0.0, 5.0, 20.0):
        (e,) = ed.equilibria(case.eom, values, case.bounds, rates={"theta": rate})
        np.testing.assert_allclose(e.q[1], 375.0 / (1500.0 - 2.0 * rate**2), rtol=1e-12)
        assert is_steady(case.eom, e)


def test_an_unknown_rate_without_bounds_is_asked_for():
    case = small.turntable()
    values = {**case.values, "c_t": 0.0}
    with pytest.raises(ed.EngdynError, match=r"1 equation for 2 unknowns \(s, theta_d\): prescribe a rate"):
        ed.equilibria(case.eom, values, case.bounds)
    theta, s = small.coordinates("theta s")
    fan = ed.lagrange((theta.diff() ** 2 + s.diff() ** 2) / 2, s**2, [theta, s], theta.diff() ** 4)
    with pytest.raises(ed.EngdynError, match=r"bounds for theta_d.*rates=\{'theta': number\}"):
        ed.equilibria(fan, {})


def test_drum_robot_held_on_the_slope():
    """S09: the torque that holds it is part of the solution; sin θ = τ/(m g l)."""
    case = small.drum_robot()
    v = case.values
    answer = ed.equilibria(case.eom, v, rates={"x": 0.0}, free=["tau"])
    torque = (v["M_d"] + v["m"]) * v["g"] * math.sin(v["beta"]) * v["R"]
    hanging = math.asin(torque / (v["m"] * v["g"] * v["l"]))
    assert answer.neutral == ("x",)
    np.testing.assert_allclose([e.q[1] for e in answer], [hanging, pi - hanging], rtol=1e-10)
    np.testing.assert_allclose([e.inputs["tau"] for e in answer], [torque] * 2, rtol=1e-12)


def test_drum_robot_on_too_steep_a_slope_has_no_equilibrium():
    case = small.drum_robot()
    answer = ed.equilibria(case.eom, {**case.values, "beta": 0.5}, rates={"x": 0.0}, free=["tau"])
    assert len(answer) == 0
    assert answer.certified


def test_steady_precession_of_a_heavy_top():
    """C n ψ' = m g l + A ψ'² cos ϑ for a top with spin about its axis (n = φ' + ψ' cos ϑ), two rates."""
    psi, theta, phi = small.coordinates("psi theta phi")
    A, C, m, g, l = small.symbols("A C m g l")
    kinetic = A * (theta.diff() ** 2 + (psi.diff() * sm.sin(theta)) ** 2) / 2
    kinetic += C * (phi.diff() + psi.diff() * sm.cos(theta)) ** 2 / 2
    eom = ed.lagrange(kinetic, m * g * l * sm.cos(theta), [psi, theta, phi])
    values = {"A": 0.012, "C": 0.005, "m": 1.5, "g": 9.81, "l": 0.05}
    slow = 2.0
    for e in ed.equilibria(eom, values, {"theta": (0.1, 3.0)}, rates={"psi": slow, "phi": 70.0}):
        spin = 70.0 + slow * math.cos(e.q[1])
        balance = values["C"] * spin * slow - values["A"] * slow**2 * math.cos(e.q[1])
        np.testing.assert_allclose(balance, 1.5 * 9.81 * 0.05, rtol=1e-10)
        assert is_steady(eom, e)


# ---------------------------------------------------------------- expressions in the parameters


def test_what_is_prescribed_may_be_an_expression_in_the_parameters():
    """The crane pulled with F = a (M_t + m) without resistance accelerates with a, whatever the masses."""
    named = {p.name: p.symbol for p in CRANE.parameters}
    pull = 0.7 * (named["M_t"] + named["m"])
    options = {"values": {"c_x": 0.0, "m": 800.0}, "inputs": {"F": pull}}
    values, answer = crane(**options)
    assert all(e.inputs["F"] == pytest.approx(0.7 * (values["M_t"] + 800.0)) for e in answer)
    np.testing.assert_allclose([e.accelerations[0] for e in answer], [0.7, 0.7])
    _, same = crane(**options, accelerations={"x": 0.07 * named["g"] / sm.Float("0.981")})
    np.testing.assert_allclose([e.q for e in same], [e.q for e in answer])
    with pytest.raises(ed.EngdynError, match=r"inputs\['F'\] is F_0.*expression in parameters with values"):
        crane(inputs={"F": sm.Symbol("F_0")})
    with pytest.raises(ed.EngdynError, match=r"rates\['x'\]"):
        crane(rates={"x": sm.sqrt(-named["m"])})


def test_inputs_and_accelerations_follow_the_parameter_along_a_branch():
    named = {p.name: p.symbol for p in CRANE.parameters}
    values = CRANE.values(c_x=0)
    for given in (
        {"inputs": {"F": named["m"] ** 2 / 100}},
        {"accelerations": {"x": named["m"] ** 2 / 100 / (named["M_t"] + named["m"])}, "free": ["F"]},
    ):
        found = ed.continue_equilibria(CRANE.equations, values, "m", (200.0, 3000.0), **given)
        assert len(found) == 2
        for branch in found:
            gain = branch.parameter**2 / 100 / (values["M_t"] + branch.parameter)
            np.testing.assert_allclose(np.tan(branch.q[:, 1]), -gain / values["g"], rtol=1e-9)
