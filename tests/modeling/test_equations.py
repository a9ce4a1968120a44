"""Equations of motion as numbers: residuals read, accelerations computed, bad input refused."""

from __future__ import annotations

import math

import numpy as np
import pytest
import sympy as sm
from sympy.physics.mechanics import dynamicsymbols

import engdyn as ed

t = dynamicsymbols._t
x, y, F, yb = dynamicsymbols("x y F yb")
m, k, c = sm.symbols("m k c", positive=True)
x_d, x_dd, y_dd = x.diff(t), x.diff(t, 2), y.diff(t, 2)
from_residuals = ed.EquationsOfMotion.from_residuals
VALUES = {"m": 2.0, "k": 3.0, "c": 0.5}


@pytest.fixture(scope="module")
def oscillator():
    return from_residuals([m * x_dd + c * x_d + k * (x - yb) - F], [x])


def test_residuals_may_be_equations_numbers_of_any_order_and_form(oscillator):
    as_equality = from_residuals([sm.Eq(m * x_dd, F - c * x_d - k * (x - yb))], [x])
    single = from_residuals(m * x_dd + c * x_d + k * (x - yb) - F, [x])
    scaled = from_residuals([(x_dd + c / m * x_d + k / m * (x - yb) - F / m) * sm.cos(x)], [x])
    for eom in (as_equality, single, scaled):
        assert ed.prove_equal(eom, oscillator)
    assert oscillator.mass_matrix == sm.Matrix([[m]])
    assert [w.func.__name__ for w in oscillator.inputs] == ["F", "yb"]
    assert [p.name for p in oscillator.parameters] == ["c", "k", "m"]
    assert oscillator.origin == "residuals"


@pytest.mark.parametrize(
    ("equations", "coordinates", "message"),
    [
        ([m * x_dd], [x, y], "1 equations for 2 coordinates"),
        ([m * x_dd + k, m * y_dd], [x], "2 equations for 1 coordinates"),
        ([m * x_dd**2 + k * x], [x], "not linear in the accelerations"),
        ([m * sm.Abs(x_dd) + k * x], [x], "not linear in the accelerations"),
        ([m * sm.sin(x_dd) + k * x], [x], "not linear in the accelerations"),
        ([m * x_dd * y_dd + k * x, y_dd], [x, y], "not linear in the accelerations"),
        ([m * x_dd + k * x.diff(t, 3)], [x], "order 3"),
        ([k * x], [x], "singular mass matrix: no equation contains the acceleration"),
        (["m*a"], [x], "not an equation"),
        ([sm.true], [x], "not an equation"),
    ],
)
def test_what_is_no_equation_of_motion(equations, coordinates, message):
    with pytest.raises(ed.EngdynError, match=message):
        from_residuals(equations, coordinates)


def test_accelerations_are_newtons(oscillator):
    found = oscillator.accelerations([0.3], [-0.2], VALUES, {"F": 1.5, "yb": (0.1, 9.0, 9.0)})
    np.testing.assert_allclose(found, [(1.5 + 0.5 * 0.2 - 3.0 * 0.2) / 2.0])


def test_stacked_states_have_stacked_accelerations():
    eom = from_residuals([m * x_dd + k * sm.sin(x - y), (m + c * x**2) * y_dd + k * y], [x, y])
    source = np.random.default_rng(2)
    q, u = source.normal(size=(4, 3, 2)), source.normal(size=(4, 3, 2))
    stacked = eom.accelerations(q, u, VALUES)
    assert stacked.shape == (4, 3, 2)
    for index in np.ndindex(4, 3):
        np.testing.assert_allclose(stacked[index], eom.accelerations(q[index], u[index], VALUES), rtol=1e-13)
    assert eom.accelerations(q, u[0, 0], VALUES).shape == (4, 3, 2)
    assert eom.accelerations(q[0, 0], u, VALUES).shape == (4, 3, 2)
    assert eom.accelerations(np.zeros((0, 2)), np.zeros((0, 2)), VALUES).shape == (0, 2)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (([0.0, 1.0], [0.0], VALUES), "q has shape"),
        ((0.0, [0.0], VALUES), "q has shape"),
        (([0.0], [], VALUES), "u has shape"),
        (([math.nan], [0.0], VALUES), "q contains values that are not finite"),
        (([0.0], [math.inf], VALUES), "u contains values that are not finite"),
        ((["a"], [0.0], VALUES), "must be arrays of numbers"),
        (([1j], [0.0], VALUES), "must be arrays of numbers"),
        ((np.zeros((3, 1)), np.zeros((2, 1)), VALUES), "do not go together"),
        (([0.0], [0.0], {"m": 1.0}), "lacks the parameters c, k"),
        (([0.0], [0.0], None), "must map parameter names"),
        (([0.0], [0.0], {**VALUES, "m": "2 kg"}), "parameter m is '2 kg'"),
        (([0.0], [0.0], {**VALUES, "m": math.nan}), "parameter m is nan"),
        (([0.0], [0.0], {**VALUES, "m": 0.0}), "singular mass matrix"),
        (([0.0], [0.0], VALUES, {"G": 1.0}), "unknown input 'G': the equations have F, yb"),
        (([0.0], [0.0], VALUES, {"F": (1.0, 2.0)}), "input F has 2 entries"),
        (([0.0], [0.0], VALUES, {"F": math.inf}), "input F is inf"),
        (([0.0], [0.0], VALUES, {"F": None}), "input F is None"),
        (([0.0], [0.0], VALUES, {"F": "up"}), "input F"),
        (([0.0], [0.0], VALUES, [1.0]), "inputs must map"),
        (([0.0], [0.0], VALUES, None, None), "time t is None"),
        (([0.0], [0.0], VALUES, None, math.nan), "time t is nan"),
    ],
)
def test_bad_numbers_are_refused(oscillator, arguments, message):
    with pytest.raises(ed.EngdynError, match=message):
        oscillator.accelerations(*arguments)


@pytest.mark.parametrize(
    ("force", "state"),
    [
        (k / x, 0.0),
        (k * sm.sqrt(1 - x), 2.0),
        (k * sm.exp(x), 1e4),
        (k * x ** sm.Rational(1, 3), -1.0),
        (k * sm.log(x), 0.0),
    ],
    ids=str,
)
def test_states_without_a_value_are_errors_everywhere(force, state):
    eom = from_residuals([m * x_dd + force], [x])
    with pytest.raises(ed.EngdynError, match="not finite"):
        eom.accelerations([state], [0.0], VALUES)
    with pytest.raises(ed.EngdynError, match="no finite value at t = 2 s"):
        eom.function(VALUES)(2.0, [state, 0.0])


def test_tons_beside_grams_are_not_singular():
    eom = from_residuals([m * x_dd + k * x, c * y_dd + k * y], [x, y])
    found = eom.accelerations([1.0, 1.0], [0.0, 0.0], {"m": 1e9, "k": 1.0, "c": 1e-9})
    np.testing.assert_allclose(found, [-1e-9, -1e9])
    close = from_residuals([x_dd + y_dd + k * x, x_dd + (1 + c) * y_dd + k * y], [x, y])
    with pytest.raises(ed.EngdynError, match="singular mass matrix"):
        close.accelerations([1.0, 1.0], [0.0, 0.0], {"k": 1.0, "c": 1e-16})


def test_a_singular_state_is_named_by_both_ways_to_numbers():
    eom = from_residuals([m * sm.sin(x) * x_dd + k], [x])
    assert eom.accelerations([0.1], [0.0], VALUES)[0] == pytest.approx(-3.0 / (2.0 * math.sin(0.1)))
    with pytest.raises(ed.EngdynError, match="singular mass matrix"):
        eom.accelerations([0.0], [0.0], VALUES)
    with pytest.raises(ed.EngdynError, match="singular mass matrix at t = 0 s"):
        eom.function(VALUES)(0.0, [0.0, 0.0])


def test_the_state_derivative_is_q_dot_and_u_dot(oscillator):
    f = oscillator.function(VALUES)
    np.testing.assert_allclose(f(0.0, [0.3, -0.2]), [-0.2, (0.1 - 0.9) / 2.0])
    np.testing.assert_allclose(f(0.0, np.array([0.3, -0.2]), {"F": 4.0}), [-0.2, (4.0 + 0.1 - 0.9) / 2.0])
    with pytest.raises(ed.EngdynError, match="holds 3 values"):
        f(0.0, [0.0, 0.0, 0.0])
    with pytest.raises(ed.EngdynError, match="no finite value"):
        f(0.0, [math.nan, 0.0])
    with pytest.raises(ed.EngdynError, match="lacks the parameters"):
        oscillator.function({})


# Inputs of the catalogue: prescribed motions and drives


def test_a_prescribed_motion_is_a_value_with_its_rate_and_acceleration():
    car = ed.systems.load("S23")
    v = car.values()
    for eom in (car.newton(), car.lagrange()):
        rest = eom.accelerations(np.zeros(4), np.zeros(4), v)
        raised = eom.accelerations(np.zeros(4), np.zeros(4), v, {"yf": (0.02, 5.0, 7.0), "F_z": 100.0})
        np.testing.assert_allclose(
            raised - rest, [100.0 / v["m_s"], 0.0, v["k_tf"] * 0.02 / v["m_f"], 0.0], atol=1e-12
        )
        np.testing.assert_allclose(rest, -v["g"] * np.array([1, 0, 1, 1]), atol=1e-12)


def test_the_drive_of_the_governor_turns_by_default_and_as_told():
    governor = ed.systems.load("S03")
    eom, v = governor.lagrange(), governor.values()
    assert "Omega" in [p.name for p in eom.parameters]
    state = [0.5], [0.3]
    default = eom.accelerations(*state, v, t=3.0)
    same = eom.accelerations(*state, v, {"drive": (54.0, 18.0, 0.0)})
    slower = eom.accelerations(*state, v, {"drive": (54.0, 9.0, 5.0)})
    assert default == pytest.approx(same)
    s, co = math.sin(0.5), math.cos(0.5)
    inertia = 2 * v["m"] * v["l"] ** 2 + 4 * v["M_c"] * v["l"] ** 2 * s**2
    push = 2 * v["m"] * v["l"] ** 2 * s * co
    assert default - slower == pytest.approx(push * (18.0**2 - 9.0**2) / inertia)
    np.testing.assert_allclose(eom.function(v)(0.0, [0.5, 0.3])[1], default[0])
    standing = eom.accelerations(*state, {**v, "Omega": 0.0})
    assert default - standing == pytest.approx(push * 18.0**2 / inertia)


def test_a_drive_that_speeds_up_acts_through_the_azimuthal_reaction_alone():
    governor = ed.systems.load("S03")
    N_a = next(x for x in governor.unknowns if x.name == "N_a")
    drive = next(i.symbol for i in governor.inputs if i.name == "drive")
    symbol = {p.name: p.symbol for p in governor.parameters}
    theta = governor.coordinates[0].symbol
    rest = governor.newton().reactions[N_a].coeff(drive.diff(t, 2))
    assert rest == symbol["m"] * symbol["l"] * sm.sin(theta)
    assert not governor.newton().forcing.has(drive.diff(t, 2))


def test_constants_of_mathematics_have_their_values():
    eom = from_residuals([m * x_dd + sm.E * k * x + sm.pi * c + sm.sin(x + sm.pi / 7)], [x])
    assert [p.name for p in eom.parameters] == ["c", "k", "m"]
    expected = -(math.e * 3.0 * 0.4 + math.pi * 0.5 + math.sin(0.4 + math.pi / 7)) / 2.0
    assert eom.accelerations([0.4], [0.0], VALUES)[0] == pytest.approx(expected, rel=1e-14)


@pytest.mark.parametrize("given", ["123", b"123", {"value": 1.0, "rate": 0.0, "acceleration": 0.0}, object()])
def test_an_input_is_a_number_or_three(given):
    crane = ed.systems.load("S07")
    with pytest.raises(ed.EngdynError, match=r"input F is .*: give a number or"):
        crane.equations.accelerations([0.0, 0.0], [0.0, 0.0], crane.values(), {"F": given})
