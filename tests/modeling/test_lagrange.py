"""Lagrange's equations: energies in, equations out, and what energies must not contain."""

from __future__ import annotations

import numpy as np
import pytest
import sympy as sm
from scipy.integrate import solve_ivp
from sympy.physics.mechanics import dynamicsymbols

import engdyn as ed

t = dynamicsymbols._t
x, y, theta, psi, F, v, yb = dynamicsymbols("x y theta psi F v yb")
m, M, l, g, k, c, J, a, b = sm.symbols("m M l g k c J a b", positive=True)
sin, cos = sm.sin, sm.cos
x_d, y_d, theta_d, psi_d = (q.diff(t) for q in (x, y, theta, psi))

EULER_LAGRANGE = {
    "elliptic pendulum": (
        m * (x_d**2 + 2 * l * cos(theta) * x_d * theta_d + l**2 * theta_d**2) / 2 + M * x_d**2 / 2,
        -m * g * l * cos(theta) + k * x**2 / 2,
        [x, theta],
        c * x_d**2 / 2,
        {x: F},
    ),
    "moving base": (
        m * (y_d + yb.diff(t)) ** 2 / 2,
        k * y**2 / 2 + m * g * (y + yb),
        [y],
        c * y_d**2 / 2,
        {},
    ),
    "explicit time": (m * (x_d + a * sin(b * t)) ** 2 * sm.exp(-c * t) / 2, k * x * t, [x], 0, {}),
    "root": (m * x_d**2 / 2, k * (sm.sqrt(a**2 + x**2) - b) ** 2, [x], 0, {x: -c * sm.Abs(x_d) * x_d}),
    "quartic dissipation": (m * x_d**2 / 2, 0, [x], c * x_d**4 / 4, {}),
    "velocity-dependent force": (
        J * psi_d**2 * (1 + sin(psi) ** 2) / 2,
        0,
        [psi],
        0,
        {psi: -c * sm.atan(psi_d / (1 + psi**2))},
    ),
}


@pytest.mark.parametrize("name", EULER_LAGRANGE)
def test_equations_are_those_of_the_definition(name):
    """d/dt dT/dq' - dT/dq + dV/dq + dD/dq' - Q by sympy, evaluated at random states."""
    T, V, q, D, Q = EULER_LAGRANGE[name]
    eom = ed.lagrange(T, V, q, D, Q)
    residual = [
        (
            T.diff(e.diff(t)).diff(t)
            - T.diff(e)
            + sm.sympify(V).diff(e)
            + sm.sympify(D).diff(e.diff(t))
            - Q.get(e, 0)
        )
        for e in q
    ]
    source = np.random.default_rng(11)
    values = {p.name: source.uniform(0.5, 2.0) for p in eom.parameters}
    for _ in range(5):
        at, u, now = source.uniform(-1, 1, len(q)), source.uniform(-2, 2, len(q)), source.uniform(0, 2)
        inputs = {w.func.__name__: tuple(source.uniform(-1, 1, 3)) for w in eom.inputs}
        acc = eom.accelerations(at, u, values, inputs, now)
        steps = [
            dict(zip([e.diff(t, 2) for e in q], acc, strict=True)),
            dict(zip([e.diff(t) for e in q], u, strict=True)),
        ]
        steps[0] |= {w.diff(t, 2): inputs[w.func.__name__][2] for w in eom.inputs}
        steps[1] |= {w.diff(t): inputs[w.func.__name__][1] for w in eom.inputs}
        steps += [dict(zip(q, at, strict=True)) | {w: inputs[w.func.__name__][0] for w in eom.inputs}]
        steps += [{p: values[p.name] for p in eom.parameters} | {t: now}]
        for row in residual:
            for known in steps:
                row = row.subs(known)
            assert abs(row.evalf()) < 1e-9


def test_mass_matrix_and_forcing_read_well():
    pendulum = ed.lagrange(m * l**2 * theta_d**2 / 2, -m * g * l * cos(theta), [theta])
    assert pendulum.mass_matrix == sm.Matrix([[m * l**2]])
    assert pendulum.forcing == sm.Matrix([-m * g * l * sin(theta)])
    assert pendulum.kinematics == sm.Matrix([theta_d])
    assert [p.name for p in pendulum.parameters] == ["g", "l", "m"]
    assert repr(pendulum) == "EquationsOfMotion(theta; 1 equation, from Lagrange)"
    assert "theta" in pendulum._repr_latex_()


# Constraints

ROLLING = {
    "T": m * (x_d**2 + y_d**2) / 2 + J * psi_d**2 / 2,
    "constraint": x_d * sin(psi) - y_d * cos(psi),
}


def test_a_knife_edge_keeps_to_its_constraint():
    """Chaplygin's sledge without offset: straight on or in circles, energy and constraint kept."""
    eom = ed.lagrange(ROLLING["T"], 0, [x, y, psi], constraints=[ROLLING["constraint"]], speeds=[x_d, psi_d])
    assert eom.speeds == (x_d, psi_d)
    values = {"m": 2.0, "J": 0.7}
    f = eom.function(values)
    run = solve_ivp(f, (0, 1.0), [0, 0, 0.2, 1.0, 0.9], rtol=1e-10, atol=1e-12)
    rates = np.array([f(0, state)[:3] for state in run.y.T])
    off = rates[:, 0] * np.sin(run.y[2]) - rates[:, 1] * np.cos(run.y[2])
    energy = values["m"] * (rates[:, 0] ** 2 + rates[:, 1] ** 2) / 2 + values["J"] * rates[:, 2] ** 2 / 2
    assert np.max(np.abs(off)) < 1e-12
    np.testing.assert_allclose(energy, energy[0], rtol=1e-8)
    np.testing.assert_allclose(rates[:, 2], 0.9, rtol=1e-9)


def test_substituting_the_constraint_into_t_is_another_system():
    """Pitfall 7: a nonholonomic constraint must not be put into T before differentiating."""
    right = ed.lagrange(
        ROLLING["T"], 0, [x, y, psi], constraints=[ROLLING["constraint"]], speeds=[x_d, psi_d]
    )
    reduced = ROLLING["T"].subs(y_d, x_d * sm.tan(psi))
    wrong = ed.lagrange(reduced, 0, [x, psi])
    values = {"m": 2.0, "J": 0.7}
    correct = right.accelerations([0, 0, 0.4], [1.0, 0.8], values)
    other = wrong.accelerations([0, 0.4], [1.0, 0.8], values)
    assert abs(correct[1]) < 1e-12
    assert abs(other[1]) > 0.1


def test_the_first_rates_that_can_be_independent_are_chosen():
    eom = ed.lagrange(ROLLING["T"], 0, [x, y, psi], constraints=[ROLLING["constraint"]])
    assert eom.speeds == (x_d, psi_d)
    fixed_x = ed.lagrange(ROLLING["T"], 0, [x, y, psi], constraints=[x_d, ROLLING["constraint"]])
    assert fixed_x.speeds == (psi_d,)


def test_prescribed_motion_in_a_constraint_brings_its_acceleration():
    """psi' = (y' cos - v sin)/a with a speed v(t): the equation contains v'."""
    T = m * y_d**2 / 2 + J * psi_d**2 / 2
    eom = ed.lagrange(T, 0, [y, psi], constraints=[y_d * cos(psi) - v * sin(psi) - a * psi_d])
    values = {"m": 1.0, "J": 2.0, "a": 0.5}
    state, rate = [0.0, 0.3], 0.7
    base, more = (eom.accelerations(state, [rate], values, {"v": (3.0, rise, 0.0)})[0] for rise in (0.0, 1.0))
    s, co = np.sin(0.3), np.cos(0.3)
    inertia = 1.0 + 2.0 * co**2 / 0.25  # reduced mass m + J (cos/a)^2
    assert more - base == pytest.approx(2.0 * (co / 0.5) * (s / 0.5) / inertia, rel=1e-12)


def test_dependent_rates_inside_functions_are_replaced():
    """Dry friction in a rate that the constraint fixes: |psi'| must become |(y' cos - k sin)/a|."""
    T = m * y_d**2 / 2 + J * psi_d**2 / 2
    constraint = [y_d * cos(psi) - k * sin(psi) - a * psi_d]
    rate = (y_d * cos(psi) - k * sin(psi)) / a
    whole = ed.lagrange(T, 0, [y, psi], 0, {psi: -c * psi_d * sm.Abs(psi_d)}, constraint)
    spelled = ed.lagrange(T, 0, [y, psi], 0, {psi: -c * rate * sm.Abs(rate)}, constraint)
    assert ed.prove_equal(whole, spelled)
    values = {"m": 1.0, "J": 2.0, "a": 0.5, "k": 1.5, "c": 0.8}
    np.testing.assert_allclose(
        whole.accelerations([0, 0.3], [0.7], values), spelled.accelerations([0, 0.3], [0.7], values)
    )
    drag = ed.lagrange(T, 0, [y, psi], c * sm.Abs(psi_d) ** 3 / 3, None, constraint)
    assert ed.prove_equal(drag, whole)


# What is refused


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: ed.lagrange(m * x_d**2 / 2, k * x_d, [x]), "potential energy contains a rate"),
        (lambda: ed.lagrange(m * x_d**2 / 2 + m * x * x.diff(t, 2), 0, [x]), "contains an acceleration"),
        (lambda: ed.lagrange(m * x_d**2 / 2, 0, [x], c * x.diff(t, 2) ** 2), "contains an acceleration"),
        (lambda: ed.lagrange(m * x_d**2 / 2, 0, [x], 0, {y: F}), "not among the coordinates"),
        (lambda: ed.lagrange(m * x_d**2 / 2, 0, [x, y]), "no equation contains the acceleration of"),
        (lambda: ed.lagrange(m * x_d**2 / 2, 0, [x], 0, {x: -c * x.diff(t, 2) ** 2}), "not linear"),
        (lambda: ed.lagrange(m * x_d**2 / 2, 0, [x], 0, {x: -c * x.diff(t, 3)}), "order 3"),
        (lambda: ed.lagrange("m", 0, [x]), "kinetic energy"),
        (lambda: ed.lagrange(m * x_d**2 / 2, None, [x]), "potential energy"),
        (lambda: ed.lagrange(m * x_d**2 / 2, 0, x), "must be a list"),
        (lambda: ed.lagrange(m * x_d**2 / 2, 0, [x], speeds=[y_d]), "without constraints the speeds"),
        (
            lambda: ed.lagrange(ROLLING["T"], 0, [x, y, psi], constraints=[x_d * y_d]),
            "not linear in the rates",
        ),
        (
            lambda: ed.lagrange(ROLLING["T"], 0, [x, y, psi], constraints=[sm.Abs(x_d) - y_d]),
            "not linear in the rates",
        ),
        (lambda: ed.lagrange(ROLLING["T"], 0, [x, y, psi], constraints=[x - y]), "fix only 0 rates"),
        (lambda: ed.lagrange(ROLLING["T"], 0, [x, y, psi], constraints=[x_d, 2 * x_d]), "fix only 1 rates"),
        (
            lambda: ed.lagrange(ROLLING["T"], 0, [x, y, psi], constraints=[x_d], speeds=[x_d, psi_d]),
            "not independent",
        ),
        (
            lambda: ed.lagrange(ROLLING["T"], 0, [x, y, psi], constraints=[x_d], speeds=[psi_d]),
            "1 speeds for 3 coordinates under 1 velocity constraints: give 2",
        ),
        (
            lambda: ed.lagrange(ROLLING["T"], 0, [x, y, psi], constraints=[x_d], speeds=[v, psi_d]),
            "not the rate of a coordinate",
        ),
        (
            lambda: ed.lagrange(ROLLING["T"], 0, [x, y, psi], constraints=[x_d, y_d, psi_d]),
            "nothing is left that can move",
        ),
    ],
)
def test_energies_and_constraints_that_make_no_sense(call, message):
    with pytest.raises(ed.EngdynError, match=message):
        call()


def test_gravity_in_v_and_in_q_is_named():
    weight = -m * g * l * sin(theta)
    with pytest.raises(ed.EngdynError, match=r"gravity is counted twice") as caught:
        ed.lagrange(m * l**2 * theta_d**2 / 2, -m * g * l * cos(theta), [theta], 0, {theta: weight + F})
    assert "theta" in str(caught.value)
    assert "g*l*m*sin(theta(t))" in str(caught.value)
    with pytest.raises(ed.EngdynError, match="this force is counted twice"):
        ed.lagrange(m * x_d**2 / 2, k * x**2 / 2, [x], 0, {x: -k * x})
    opposite = ed.lagrange(m * x_d**2 / 2, k * x**2 / 2, [x], 0, {x: k * x})  # a compensated spring is none
    assert opposite.forcing == sm.Matrix([0])


def test_a_function_without_known_derivative_is_refused_not_dropped():
    with pytest.raises(ed.OutsideRingError, match="cannot be differentiated"):
        ed.lagrange(m * x_d**2 / 2, k * sm.floor(x), [x])
    step = ed.lagrange(m * x_d**2 / 2, 0, [x], 0, {x: -k * sm.Heaviside(x)})
    assert step.forcing[0].has(sm.Heaviside)
    with pytest.raises(ed.OutsideRingError, match="Heaviside"):
        step.accelerations([1.0], [0.0], {"m": 1.0, "k": 1.0})


def test_a_circulatory_force_may_repeat_what_the_potential_couples():
    """K = [[4, 1], [0, 4]]: half of the coupling is in V, the other half of row 1 is a force."""
    q1, q2 = dynamicsymbols("q1 q2")
    kinetic = (q1.diff() ** 2 + q2.diff() ** 2) / 2
    potential = (4 * q1**2 + q1 * q2 + 4 * q2**2) / 2
    eom = ed.lagrange(kinetic, potential, [q1, q2], forces={q1: -q2 / 2, q2: q1 / 2})
    assert list(eom.forcing) == [-4 * q1 - q2, -4 * q2]
