"""The derivation term by term, the multipliers, and the check of the kinetic energy."""

from __future__ import annotations

import pytest
import sympy as sm
from sympy.physics import mechanics as me

import engdyn as ed

t = me.dynamicsymbols._t
x, y, theta, psi, phi, F, yb = me.dynamicsymbols("x y theta psi phi F y_b")
x_d, y_d, theta_d, psi_d, phi_d = (q.diff(t) for q in (x, y, theta, psi, phi))
m, M, l, g, k, c, J, J_d, R, a = sm.symbols("m M l g k c J J_d R a", positive=True)
sin, cos = sm.sin, sm.cos
LAMBDA = sm.Symbol("lambda_1"), sm.Symbol("lambda_2")


def on_a_cart():
    """A pendulum on a cart on a moving base; every term occurs."""
    v = (x_d + l * cos(theta) * theta_d, yb.diff(t) + l * sin(theta) * theta_d)
    T = M * x_d**2 / 2 + m * (v[0] ** 2 + v[1] ** 2) / 2
    V = k * x**2 / 2 - m * g * l * cos(theta) + m * g * yb
    D = c * x_d**2 / 2
    return ed.lagrange(T, V, [x, theta], D, {x: F}, steps=True), T, V, D


def same(a_, b_):
    """Equality of two expressions, as an identity in sines and cosines."""
    difference = sm.expand(sm.expand_trig(a_ - b_))
    return sm.expand(difference.subs(sin(theta) ** 2, 1 - cos(theta) ** 2)) == 0


def test_every_term_is_that_of_the_definition():
    steps, T, V, D = on_a_cart()
    for i, q in enumerate((x, theta)):
        rate = q.diff(t)
        assert same(steps.momenta[i], T.diff(rate))
        assert same(steps.momentum_rates[i], T.diff(rate).diff(t))
        assert same(steps.kinetic_gradient[i], T.diff(q))
        assert same(steps.potential_gradient[i], V.diff(q))
        assert same(steps.dissipation_gradient[i], D.diff(rate))
        assert steps.forces[i] == {x: F, theta: 0}[q]
        residual = T.diff(rate).diff(t) - T.diff(q) + V.diff(q) + D.diff(rate) - steps.forces[i]
        assert same(steps.residuals[i], residual)
    assert (steps.kinetic, steps.potential, steps.dissipation) == (T, V, D)
    assert steps.constraint_forces == sm.zeros(2, 1)
    assert steps.multipliers == {}


def test_the_steps_lead_to_the_equations():
    steps, T, V, D = on_a_cart()
    own = ed.EquationsOfMotion.from_residuals(list(steps.residuals), [x, theta])
    assert ed.prove_equal(own, steps.equations_of_motion)
    assert ed.prove_equal(ed.lagrange(T, V, [x, theta], D, {x: F}), steps.equations_of_motion)
    assert repr(steps) == "LagrangeSteps(x, theta; from kinetic to equations_of_motion)"
    text = steps._repr_latex_()
    assert text.count(r"\partial") >= 8
    assert r"\lambda" not in text


# Multipliers


def numbers(eom, q, u, values):
    """A function that evaluates expressions at a state, accelerations included."""
    parameters = {p: values[p.name] for p in (m, M, l, g, k, c, J, J_d, R, a) if p.name in values}
    places, speeds = dict(zip(eom.coordinates, q, strict=True)), dict(zip(eom.speeds, u, strict=True))
    udot = eom.accelerations(q, u, values)
    known = {s.diff(t): value for s, value in zip(eom.speeds, udot, strict=True)}
    rates = eom.kinematics.subs(speeds).subs(places).subs(parameters)
    known_rates = {e.diff(t): rate for e, rate in zip(eom.coordinates, rates, strict=True)}
    return lambda e: float(e.subs(known).subs(known_rates).subs(places).subs(parameters))


def sledge():
    """Chaplygin's sledge: the mass center is ahead of the blade, which gives way lengthwise only."""
    N, B, O = me.ReferenceFrame("N"), me.ReferenceFrame("B"), me.Point("O")
    B.orient_axis(N, psi, N.z)
    O.set_vel(N, 0)
    blade = O.locatenew("blade", x * N.x + y * N.y)
    G = blade.locatenew("G", a * B.x)
    body = me.RigidBody("sledge", G, B, m, (me.inertia(B, 0, 0, J), G))
    T = ed.kinetic_energy(body, N)
    constraint = -x_d * sin(psi) + y_d * cos(psi)  # the speed across, along B.y
    return N, B, blade, body, T, constraint


def test_the_multiplier_is_the_side_force_of_newton():
    N, B, blade, body, T, constraint = sledge()
    S = sm.Symbol("S")
    q, kept = [x, y, psi], [x_d, psi_d]
    newton = ed.newton_euler(
        [ed.FreeBody(body, reactions=[me.Force(blade, S * B.y)])],
        q,
        N,
        [S],
        constraints=[constraint],
        speeds=kept,
    )
    lagrange = ed.lagrange(T, 0, q, constraints=[constraint], speeds=kept)
    assert ed.prove_equal(newton, lagrange)
    values = {"m": 2.0, "J": 0.7, "a": 0.4}
    at = numbers(lagrange, [0.1, -0.3, 0.6], [0.8, -1.3], values)
    side, multiplier = at(newton.reactions[S]), at(lagrange.reactions[LAMBDA[0]])
    assert abs(side) > 0.5
    assert multiplier == pytest.approx(side, rel=1e-12)
    forces = ed.lagrange(T, 0, q, constraints=[constraint], speeds=kept, steps=True).constraint_forces
    assert forces == sm.Matrix([-LAMBDA[0] * sin(psi), LAMBDA[0] * cos(psi), 0])


def test_the_multiplier_of_sympy_is_the_same():
    """LagrangesMethod has the opposite sign convention: its multipliers are −λ."""
    *_, T, constraint = sledge()
    q = [x, y, psi]
    ours = ed.lagrange(T, 0, q, constraints=[constraint], speeds=[x_d, psi_d])
    method = me.LagrangesMethod(T, q, nonhol_coneqs=[constraint])
    method.form_lagranges_equations()
    values, place, u = {m: 2.0, J: 0.7, a: 0.4}, [0.1, -0.3, 0.6], [0.8, -1.3]
    rates = {x_d: u[0], y_d: u[0] * float(sm.tan(place[2])), psi_d: u[1]}
    point = {**dict(zip(q, place, strict=True)), **rates, **values}
    theirs = method.solve_multipliers(op_point=point)
    at = numbers(ours, place, u, {s.name: x for s, x in values.items()})
    assert at(ours.reactions[LAMBDA[0]]) == pytest.approx(-float(*theirs.values()), rel=1e-9)


def rolling_disc():
    """A disc that stays upright, rolls by phi in the heading psi, pushed along by a couple."""
    N, A, B, O = me.ReferenceFrame("N"), me.ReferenceFrame("A"), me.ReferenceFrame("B"), me.Point("O")
    A.orient_axis(N, psi, N.z)
    B.orient_axis(A, phi, A.y)
    O.set_vel(N, 0)
    G = O.locatenew("G", x * N.x + y * N.y + R * N.z)
    disc = me.RigidBody("disc", G, B, m, (me.inertia(B, J_d, J, J_d), G))
    return N, A, G, disc, [x_d - R * phi_d * cos(psi), y_d - R * phi_d * sin(psi)]


def test_the_multipliers_of_a_rolling_disc_are_the_forces_at_its_contact():
    N, A, G, disc, constraints = rolling_disc()
    F_x, F_y, F_z, M_x = sm.symbols("F_x F_y F_z M_x")
    contact = G.locatenew("C", -R * N.z)
    couple = k * sin(phi)
    body = ed.FreeBody(
        disc,
        applied=[me.Force(G, -m * g * N.z), me.Torque(disc.frame, couple * A.y)],
        reactions=[me.Force(contact, F_x * N.x + F_y * N.y + F_z * N.z), me.Torque(disc.frame, M_x * A.x)],
    )
    q, kept = [x, y, psi, phi], [psi_d, phi_d]
    newton = ed.newton_euler([body], q, N, [F_x, F_y, F_z, M_x], constraints=constraints, speeds=kept)
    T = ed.kinetic_energy(disc, N)
    lagrange = ed.lagrange(T, 0, q, 0, {phi: couple}, constraints, speeds=kept)
    assert ed.prove_equal(newton, lagrange)
    values = {"m": 2.0, "J": 0.09, "J_d": 0.045, "R": 0.3, "k": 1.7, "g": 9.81}
    at = numbers(lagrange, [0.2, 0.4, 0.7, 0.9], [1.2, 5.0], values)
    for force, multiplier in zip((F_x, F_y), LAMBDA, strict=True):
        value = at(newton.reactions[force])
        assert abs(value) > 0.01
        assert at(lagrange.reactions[multiplier]) == pytest.approx(value, rel=1e-12)


def test_prescribed_motion_enters_the_multiplier():
    """A blade on a table that moves: hand result λ = m (ÿ across)."""
    v = me.dynamicsymbols("v")
    eom = ed.lagrange(m * (x_d**2 + y_d**2) / 2, 0, [x, y], constraints=[y_d - v])
    assert sm.expand(eom.reactions[LAMBDA[0]] - m * v.diff(t)) == 0


# Kinetic energies that cannot be


@pytest.mark.parametrize(
    ("kinetic", "q", "word"),
    [
        (-m * x_d**2 / 2, [x], "not positive definite: at all"),
        (m * (x_d + y_d) ** 2 / 2, [x, y], "singular"),
        (M * x_d**2 / 2 - m * y_d**2 / 2, [x, y], "not positive definite: at all"),
        ((M - m) * x_d**2 / 2, [x], "depends: positive definite at"),
        (m * l**2 * (cos(theta) - 2) * theta_d**2 / 2, [theta], "not positive definite: at all"),
    ],
)
def test_a_kinetic_energy_that_is_not_positive_is_named(kinetic, q, word):
    with pytest.warns(ed.EngdynWarning, match=f"not positive for every motion .{word}"):
        ed.lagrange(kinetic, 0, q, steps=True)


def test_the_verdict_has_a_witness_and_takes_numbers():
    form = ed.standard_form(ed.lagrange((M - m) * x_d**2 / 2, 0, [x]))
    verdict = form.definiteness()
    assert verdict.verdict == "depends"
    assert verdict.witness["M"] < verdict.witness["m"]
    assert form.definiteness({"m": 1.0, "M": 3.0})
    light = form.definiteness({"m": 3.0, "M": 1.0})
    assert (light.verdict, light.witness) == ("not positive definite", {"M": 1.0, "m": 3.0})
    number = ed.standard_form(ed.lagrange(x_d**2 + x_d * y_d + y_d**2, 0, [x, y]))
    assert repr(number.definiteness()) == "positive definite: exactly"
