"""Energies from bodies, springs and dampers, against sympy, numbers and the forces of the same parts."""

from __future__ import annotations

import numpy as np
import pytest
import sympy as sm
from sympy.physics import mechanics as me

import engdyn as ed

t = me.dynamicsymbols._t
theta, psi, x, yb = me.dynamicsymbols("theta psi x yb")
m, l, a, b, k, c, g, free, A, C = sm.symbols("m l a b k c g l_0 A C", positive=True)


def scene():
    """A bar on a base that moves up and down, a point on the bar, a wall."""
    N, B = me.ReferenceFrame("N"), me.ReferenceFrame("B")
    O = me.Point("O")
    O.set_vel(N, 0)
    B.orient_axis(N, theta, N.z)
    base = O.locatenew("base", yb * N.y)
    G = base.locatenew("G", l / 2 * B.x)
    tip = base.locatenew("tip", l * B.x)
    wall = O.locatenew("wall", a * N.x + b * N.y)
    bar = me.RigidBody("bar", G, B, m, (me.inertia(B, 0, 0, m * l**2 / 12), G))
    return N, B, O, base, G, tip, wall, bar


def number(expr, seed=3):
    """An expression at a reproducible state; the same names have the same numbers everywhere."""
    source = np.random.default_rng(seed)
    drawn = {s: source.uniform(0.4, 1.6) for s in (m, l, a, b, k, c, g, free, A, C)}
    rates = {q.diff(t): source.uniform(-2, 2) for q in (theta, psi, x, yb)}
    places = {q: source.uniform(-1.2, 1.2) for q in (theta, psi, x, yb)}
    return float(sm.sympify(expr).subs(rates).subs(places).subs(drawn))


def test_kinetic_energy_is_that_of_sympy():
    N, *_, tip, wall, bar = scene()
    bead = me.Particle("bead", tip, 2 * m)
    ours = ed.kinetic_energy([bar, bead], N)
    tip.set_vel(N, tip.pos_from(wall).dt(N))
    bar.masscenter.set_vel(N, bar.masscenter.pos_from(wall).dt(N))
    for seed in range(4):
        assert number(ours, seed) == pytest.approx(number(me.kinetic_energy(N, bar, bead), seed), rel=1e-12)
    assert ours.has(yb.diff(t))  # the base moves: absolute velocities
    assert ed.kinetic_energy(ed.FreeBody(bar), N) == ed.kinetic_energy(bar, N)


def test_kinetic_energy_of_a_ball_in_euler_angles():
    """½ A (θ' ² + φ' ² sin²θ) + ½ C (ψ' + φ' cosθ)² (any book on gyroscopes)."""
    phi = me.dynamicsymbols("phi")
    N, B = me.ReferenceFrame("N"), me.ReferenceFrame("B")
    B.orient_body_fixed(N, (phi, theta, psi), "ZXZ")
    O = me.Point("O")
    O.set_vel(N, 0)
    ball = me.RigidBody("ball", O, B, m, (me.inertia(B, A, A, C), O))
    T = ed.kinetic_energy(ball, N)
    p, n, s = (q.diff(t) for q in (phi, theta, psi))
    expected = A * (n**2 + p**2 * sm.sin(theta) ** 2) / 2 + C * (s + p * sm.cos(theta)) ** 2 / 2
    assert sm.expand(sm.expand(T - expected).subs(sm.sin(theta) ** 2, 1 - sm.cos(theta) ** 2)) == 0
    assert not T.xreplace({s: 0}).has(psi)  # the spin angle itself does not matter


def test_gravity_and_its_datum():
    N, _, O, _, _, tip, wall, bar = scene()
    bodies = [bar, me.Particle("bead", tip, 2 * m)]
    V = ed.gravity_potential(bodies, -g * N.y, O)
    expected = m * g * (yb + l / 2 * sm.sin(theta)) + 2 * m * g * (yb + l * sm.sin(theta))
    assert sm.expand(V - expected) == 0
    assert sm.expand(ed.gravity_potential(bodies, -g * N.y, wall) - V) == -3 * m * g * b
    assert ed.gravity_potential(bar, -g * N.z, O) == 0


def test_spring_between_two_points():
    N, _, _, _, _, tip, wall, _ = scene()
    V = ed.spring_potential(k, wall, tip, free)
    vector = tip.pos_from(wall)
    length = sm.sqrt(sum(vector.dot(axis) ** 2 for axis in (N.x, N.y, N.z)))
    assert number(V) == pytest.approx(number(k * (length - free) ** 2 / 2), rel=1e-12)
    assert number(ed.spring_potential(k, wall, tip, 0)) == pytest.approx(number(k * length**2 / 2), rel=1e-12)
    O, axis = me.Point("O"), me.ReferenceFrame("E")
    straight = ed.spring_potential(k, O, O.locatenew("P", (a + x) * axis.x), a)
    assert straight == k * (sm.Abs(a + x) - a) ** 2 / 2


def test_spring_force_is_minus_the_gradient():
    N, _, _, _, _, tip, wall, _ = scene()
    vector = tip.pos_from(wall)
    length = vector.magnitude()
    pull = -k * (length - free) * vector / length
    Q = ed.generalized_forces([me.Force(tip, pull)], [theta], N)[theta]
    V = ed.spring_potential(k, wall, tip, free)
    assert number(Q) == pytest.approx(number(-V.diff(theta)), rel=1e-12)


def test_damper_in_any_direction():
    """D = ½ c (rate of the length)², the rate by sympy's own derivative of the distance."""
    N, _, _, _, _, tip, wall, _ = scene()
    D = ed.damper_dissipation(c, wall, tip, N)
    rate = tip.pos_from(wall).magnitude().diff(t)
    for seed in range(4):
        assert number(D, seed) == pytest.approx(number(c * rate.doit() ** 2 / 2, seed), rel=1e-12)
    vector = tip.pos_from(wall)
    force = -c * rate * vector / vector.magnitude()
    Q = ed.generalized_forces([me.Force(tip, force)], [theta], N)[theta]
    assert number(Q) == pytest.approx(number(-D.diff(theta.diff(t))), rel=1e-12)


def test_damper_along_a_guide_has_no_root():
    N, O = me.ReferenceFrame("N"), me.Point("O")
    E = me.ReferenceFrame("E")
    E.orient_axis(N, a, N.z)
    block = O.locatenew("A", x * E.x)
    assert ed.damper_dissipation(c, O, block, N) == c * x.diff(t) ** 2 / 2


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda s: ed.kinetic_energy([3], s[0]), "3 is not a body"),
        (lambda s: ed.kinetic_energy([], s[0]), "no bodies"),
        (lambda s: ed.kinetic_energy(s[-1], "N"), "frame is 'N'"),
        (lambda s: ed.kinetic_energy(s[-1], me.ReferenceFrame("M")), "unknown"),
        (lambda s: ed.gravity_potential(s[-1], -g, s[2]), "give a vector"),
        (lambda s: ed.gravity_potential(s[-1], -g * s[1].y, s[2]), "B, which turns"),
        (lambda s: ed.gravity_potential(s[-1], -g * s[0].y, s[3]), "datum base moves"),
        (lambda s: ed.gravity_potential(s[-1], -g * s[0].y, me.Point("far")), "not placed from far"),
        (lambda s: ed.spring_potential(k, s[2], s[2], 0), "two different points"),
        (lambda s: ed.spring_potential("k", s[6], s[5], 0), "not text"),
        (lambda s: ed.spring_potential(k, s[6], me.Point("far"), 0), "not placed from"),
        (lambda s: ed.damper_dissipation(c, s[3], s[5], s[0]), "does not change"),
        (lambda s: ed.damper_dissipation(c, s[6], s[5], None), "frame is None"),
    ],
)
def test_what_makes_no_sense_is_refused(call, message):
    with pytest.raises(ed.EngdynError, match=message):
        call(scene())


def test_a_spring_must_say_its_free_length():
    *_, tip, wall, _ = scene()
    with pytest.raises(TypeError, match="free_length"):
        ed.spring_potential(k, wall, tip)
