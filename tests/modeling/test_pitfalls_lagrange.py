"""Pitfalls 1, 7, 8 and 9 of Lagrange's method: each wrong treatment is refuted, and named."""

from __future__ import annotations

import numpy as np
import pytest
import sympy as sm
from scipy.integrate import solve_ivp
from sympy.physics import mechanics as me

import engdyn as ed

t = me.dynamicsymbols._t
x, y, theta, psi, xb = me.dynamicsymbols("x y theta psi x_b")
x_d, y_d, theta_d, psi_d, xb_d = (q.diff(t) for q in (x, y, theta, psi, xb))
m, l, g, k, c, c_i, J, a, P = sm.symbols("m l g k c c_i J a P", positive=True)
sin, cos = sm.sin, sm.cos


# 1  T written with velocities relative to a moving frame


def base_excited_pendulum():
    """Particles, points and frames of a pendulum whose pivot is moved along x."""
    N, B, O = me.ReferenceFrame("N"), me.ReferenceFrame("B"), me.Point("O")
    B.orient_axis(N, theta, N.z)
    O.set_vel(N, 0)
    pivot = O.locatenew("pivot", xb * N.x)
    bob = me.Particle("bob", pivot.locatenew("G", -l * B.y), m)
    return N, O, bob


def test_relative_velocity_loses_the_base_and_is_named():
    N, O, bob = base_excited_pendulum()
    V = ed.gravity_potential(bob, -g * N.y, O)
    right = ed.lagrange(ed.kinetic_energy(bob, N), V, [theta])
    relative = m * l**2 * theta_d**2 / 2  # as the moving pivot sees it
    wrong = ed.lagrange(relative, V, [theta])
    proof = ed.prove_equal(wrong, right)
    assert proof.verdict == "refuted"
    (difference,) = proof.differences
    assert difference.kind == "missing"
    assert sm.expand(difference.term - m * l * cos(theta) * xb.diff(t, 2)) == 0
    assert "base acceleration x_b'' is missing: relative velocities in T" in difference.remark
    tension = sm.Symbol("S")
    rod = me.ReferenceFrame("B")
    rod.orient_axis(N, theta, N.z)
    weight, pull = me.Force(bob.point, -m * g * N.y), me.Force(bob.point, tension * rod.y)
    assert ed.prove_equal(ed.newton_euler([ed.FreeBody(bob, [weight], [pull])], [theta], N, [tension]), right)


# 7  A nonholonomic constraint put into T before differentiating


def test_a_constraint_substituted_into_t_gives_another_equation():
    """A sledge whose mass center is ahead of the blade: v along, psi' about the vertical."""
    N, B, O = me.ReferenceFrame("N"), me.ReferenceFrame("B"), me.Point("O")
    B.orient_axis(N, psi, N.z)
    O.set_vel(N, 0)
    blade = O.locatenew("blade", x * N.x + y * N.y)
    G = blade.locatenew("G", a * B.x)
    sledge = me.RigidBody("sledge", G, B, m, (me.inertia(B, 0, 0, J), G))
    T = ed.kinetic_energy(sledge, N)
    constraint = y_d * cos(psi) - x_d * sin(psi)
    right = ed.lagrange(T, 0, [x, y, psi], constraints=[constraint], speeds=[x_d, psi_d])
    S = sm.Symbol("S")
    body = ed.FreeBody(sledge, reactions=[me.Force(blade, S * B.y)])
    newton = ed.newton_euler([body], [x, y, psi], N, [S], constraints=[constraint], speeds=[x_d, psi_d])
    assert ed.prove_equal(newton, right)
    reduced = ed.lagrange(T.subs(y_d, x_d * sm.tan(psi)), 0, [x, psi])
    multiplied = ed.EquationsOfMotion.from_residuals(
        list(right.mass_matrix * sm.Matrix([x.diff(t, 2), psi.diff(t, 2)]) - right.forcing), [x, psi]
    )
    proof = ed.prove_equal(reduced, multiplied)
    assert proof.verdict == "refuted"
    assert proof.differences
    values = {"m": 2.0, "J": 0.7, "a": 0.4}
    f = right.function(values)
    run = solve_ivp(f, (0, 3), [0, 0, 0.2, 1.0, 1.1], rtol=1e-11, atol=1e-13)
    rates = np.array([f(0, state)[:3] for state in run.y.T])
    drift = rates[:, 1] * np.cos(run.y[2]) - rates[:, 0] * np.sin(run.y[2])
    assert np.max(np.abs(drift)) < 1e-12


# 8  Follower forces


def column():
    """Two bars with a force that follows the second one (H. Ziegler, Ing.-Arch. 20, 1952)."""
    N, A, B, O = (*(me.ReferenceFrame(name) for name in "NAB"), me.Point("O"))
    A.orient_axis(N, theta, N.z)
    B.orient_axis(N, psi, N.z)
    O.set_vel(N, 0)
    joint = O.locatenew("joint", l * A.x)
    tip = joint.locatenew("tip", l * B.x)
    masses = [me.Particle("lower", joint, 2 * m), me.Particle("upper", tip, m)]
    T = ed.kinetic_energy(masses, N)
    V = k * theta**2 / 2 + k * (psi - theta) ** 2 / 2
    return T, V, ed.generalized_forces(me.Force(tip, -P * B.x), [theta, psi], N)


def test_a_follower_force_has_no_potential():
    _, _, Q = column()
    assert sm.expand_trig(Q[theta].diff(psi) - Q[psi].diff(theta)) != 0
    with pytest.raises(ed.EngdynError, match=r"no potential: dQ_theta/dpsi = .*, but dQ_psi/dtheta = 0"):
        ed.potential_of(Q, [theta, psi])


def test_a_potential_for_it_is_another_system():
    """V = P · (shortening of the column) belongs to a force of fixed direction."""
    T, V, Q = column()
    right = ed.lagrange(T, V, [theta, psi], 0, Q)
    shortening = P * l * (cos(theta) + cos(psi))
    proof = ed.prove_equal(ed.lagrange(T, V + shortening, [theta, psi]), right)
    assert proof.verdict == "refuted"
    assert proof.differences


def test_its_stiffness_is_not_symmetrized_and_the_column_flutters():
    """Critical force of Ziegler's column without damping: P l/k = 7/2 − √2."""
    T, V, Q = column()
    eom = ed.lagrange(T, V, [theta, psi], 0, Q)
    values, critical = {"m": 1.3, "l": 0.5, "k": 20.0}, (3.5 - np.sqrt(2)) * 20.0 / 0.5
    verdicts = []
    for force in (0.999 * critical, 1.001 * critical):
        state = ed.equilibria(eom, {**values, "P": force}, bounds={"theta": (-0.2, 0.2), "psi": (-0.2, 0.2)})[
            0
        ]
        linear = ed.linearize(eom, state)
        stiffness = np.asarray(linear.stiffness, dtype=float)
        assert stiffness[0, 1] == pytest.approx(-20.0 + force * 0.5)
        assert stiffness[1, 0] == pytest.approx(-20.0)
        verdicts.append(ed.stability(linear).verdict)
    assert verdicts == ["marginal", "unstable (flutter)"]
    assert np.linalg.det(stiffness) > 0  # the static criterion sees nothing


# 9  Rayleigh's function


def moving_wall(D):
    """A block on a spring to ground, and a damper to a wall that is moved."""
    return ed.lagrange(m * x_d**2 / 2, k * x**2 / 2, [x], D)


def test_the_factor_one_half_and_the_relative_rate():
    N, O = me.ReferenceFrame("N"), me.Point("O")
    O.set_vel(N, 0)
    wall, block = O.locatenew("wall", xb * N.x), O.locatenew("block", (x + l) * N.x)
    D = ed.damper_dissipation(c, wall, block, N)
    S = sm.Symbol("S")
    right = moving_wall(D)
    forces = [me.Force(block, -k * x * N.x), me.Force(block, -c * (x_d - xb_d) * N.x)]
    newton = ed.newton_euler([ed.FreeBody(me.Particle("block", block, m), forces)], [x], N, [])
    assert S not in right.parameters
    assert ed.prove_equal(right, newton)
    (twice,) = ed.prove_equal(moving_wall(2 * D), newton).differences[:1]
    assert (twice.kind, twice.factor) == ("factor", 2)
    (absolute,) = ed.prove_equal(moving_wall(c * x_d**2 / 2), newton).differences
    assert absolute.kind == "missing"
    assert sm.expand(absolute.term + c * xb_d) == 0


def test_energy_balance_along_a_run():
    """dE/dt + 2D − ΣQ q' = 0: the integral of the power is the change of the energy."""
    bar = ed.systems.load("W7")
    q = [coordinate.symbol for coordinate in bar.coordinates]
    push = sm.Symbol("F", positive=True)
    Q = {q[1]: push * cos(q[1])}
    eom = ed.lagrange(bar.kinetic_energy, bar.potential_energy, q, bar.dissipation, Q)
    values = bar.values() | {"F": 2.5}
    parameters = {p.symbol: p.default for p in bar.parameters} | {push: 2.5}
    rates = [e.diff(t) for e in q]
    places = sm.symbols("q1 q2 u1 u2")
    swap = dict(zip([*rates, *q], [*places[2:], *places[:2]], strict=True))

    def number(expr):
        return sm.lambdify(places, expr.xreplace(swap).subs(parameters), "numpy")

    energy, D = number(bar.kinetic_energy + bar.potential_energy), number(bar.dissipation)
    power = number(sum(force * e.diff(t) for e, force in Q.items()))
    f = eom.function(values)

    def with_work(time, state):
        return [*f(time, state[:4]), 2 * D(*state[:4]) - power(*state[:4])]

    run = solve_ivp(with_work, (0, 4), [0.1, 1.2, 0.3, -2.0, 0.0], rtol=1e-11, atol=1e-12)
    E = energy(*run.y[:4])
    assert np.ptp(E) > 1.0
    np.testing.assert_allclose(E - E[0] + run.y[4], 0, atol=1e-8)
    wrong = solve_ivp(
        lambda s, z: [*f(s, z[:4]), D(*z[:4]) - power(*z[:4])], (0, 4), [0.1, 1.2, 0.3, -2.0, 0.0]
    )
    assert np.max(np.abs(energy(*wrong.y[:4]) - E[0] + wrong.y[4])) > 0.1  # D is half the power


def test_coulomb_friction_is_no_rayleigh_function():
    """Its power is Q q' = −F |q'|, not 2D: as a force it is right, with D = F |q'| the equation is right, 2D not."""
    friction = -P * sm.Abs(x_d) / x_d
    force = ed.lagrange(m * x_d**2 / 2, 0, [x], 0, {x: friction})
    first_order = ed.lagrange(m * x_d**2 / 2, 0, [x], P * sm.Abs(x_d))
    assert ed.prove_equal(force, first_order)
    quadratic = ed.lagrange(m * x_d**2 / 2, 0, [x], P * sm.Abs(x_d) / 2)
    assert ed.prove_equal(quadratic, force).verdict == "refuted"
