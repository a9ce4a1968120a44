"""Angular momentum and moment balances: a rigid body against the particles that it consists of."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
import sympy as sm
from sympy.physics.mechanics import (
    Force,
    Particle,
    Point,
    ReferenceFrame,
    RigidBody,
    Torque,
    dynamicsymbols,
    inertia,
)

import engdyn as ed

t = dynamicsymbols._t
N, B = ReferenceFrame("N"), ReferenceFrame("B")
q1, q2, q3, x, y, z = dynamicsymbols("q1 q2 q3 x y z")
B.orient_body_fixed(N, (q1, q2, q3), "ZXZ")
O, G, A, F = Point("O"), Point("G"), Point("A"), Point("F")
O.set_vel(N, 0)
G.set_pos(O, x * N.x + y * N.y + z * N.z)
A.set_pos(G, 0.3 * B.x - 0.2 * B.y + 0.5 * B.z)  # a point of the body
F.set_pos(O, sm.sin(t) * N.x + t**2 / 3 * N.y - N.z)  # a point of its own

# A body of four particles, and the rigid body with the same mass, mass center and tensor.
MASSES = np.array([1.0, 2.0, 0.5, 1.5])
PLACES = np.array([[0.4, 0.1, -0.3], [-0.2, 0.3, 0.1], [0.5, -0.6, 0.2], [0.0, 0.0, 0.0]])
PLACES = PLACES - MASSES @ PLACES / MASSES.sum()
I_G = ed.inertia_tensor(MASSES, PLACES)
TENSOR = inertia(B, I_G[0, 0], I_G[1, 1], I_G[2, 2], I_G[0, 1], I_G[1, 2], I_G[0, 2])
BODY = RigidBody("body", G, B, MASSES.sum(), (TENSOR, G))
#: A motion in which everything moves and nothing is small.
MOTION = {
    q1: 0.3 + 1.1 * t,
    q2: 0.9 + 0.4 * sm.sin(2 * t),
    q3: -0.5 + 2 * t - t**2,
    x: sm.cos(t),
    y: t**3,
    z: 1 - t / 2,
}
INSTANT = 0.37


@cache
def known(at):
    """Numbers for the coordinates and their first two derivatives at an instant."""
    found = {q.diff(t, k): motion.diff(t, k).subs(t, at) for k in (2, 1) for q, motion in MOTION.items()}
    return found | {q: motion.subs(t, at) for q, motion in MOTION.items()} | {t: sm.Float(at)}


def number(vector, at=INSTANT):
    """Components in N of a vector, in the motion above."""
    total = np.zeros(3)
    for matrix, frame in vector.args:
        components = np.array([float(e.xreplace(known(at))) for e in matrix])
        rotation = np.eye(3) if frame is N else np.array(N.dcm(frame).xreplace(known(at)), dtype=float)
        total += rotation @ components
    return total


def particle_places(at):
    """Places of the four particles, shape (4, 3), from the rotation matrix alone."""
    rotation = np.array(N.dcm(B).xreplace(known(at)), dtype=float)
    return number(G.pos_from(O), at) + PLACES @ rotation.T


def difference(function, order, at=INSTANT, h=2e-3):
    """First or second derivative by central differences of sixth order."""
    weights = {1: [-1, 9, -45, 0, 45, -9, 1], 2: [2, -27, 270, -490, 270, -27, 2]}[order]
    scale = {1: 60 * h, 2: 180 * h**2}[order]
    return sum(w * function(at + k * h) for k, w in zip(range(-3, 4), weights, strict=True)) / scale


@pytest.mark.parametrize("point", [O, G, A, F], ids=str)
def test_angular_momentum_is_that_of_the_particles(point):
    where, velocity = particle_places(INSTANT), difference(particle_places, 1)
    expected = (MASSES[:, None] * np.cross(where - number(point.pos_from(O)), velocity)).sum(axis=0)
    found = ed.angular_momentum(BODY, point, N)
    np.testing.assert_allclose(number(found), expected, rtol=1e-9, atol=1e-9)
    assert [frame for _, frame in found.args] == [B]
    np.testing.assert_allclose(number(BODY.angular_momentum(point, N)), expected, rtol=1e-9, atol=1e-9)


def test_bodies_in_a_list_add_up():
    ball = Particle("ball", F, 0.7)
    total = ed.angular_momentum([BODY, ball, ed.FreeBody(ball)], O, N)
    assert {frame for _, frame in total.args} == {N}
    expected = number(ed.angular_momentum(BODY, O, N)) + 2 * number(ed.angular_momentum(ball, O, N))
    np.testing.assert_allclose(number(total), expected, rtol=1e-12)
    speed = difference(lambda at: number(F.pos_from(O), at), 1)
    own = 0.7 * np.cross(number(F.pos_from(O)), speed)
    np.testing.assert_allclose(number(ed.angular_momentum(ball, O, N)), own, rtol=1e-9)


@pytest.mark.parametrize(
    ("point", "kind"),
    [(O, "fixed point"), (G, "mass center"), (A, "accelerating point"), (F, "accelerating point")],
    ids=str,
)
@pytest.mark.parametrize("axes", [None, N], ids=["own axes", "fixed axes"])
def test_moment_balance_is_that_of_the_particles_about_any_point(point, kind, axes):
    balance = ed.moment_balance(ed.FreeBody(BODY), point, N, axes=axes)
    assert balance.kind == kind
    arms = particle_places(INSTANT) - number(point.pos_from(O))
    expected = (MASSES[:, None] * np.cross(arms, difference(particle_places, 2))).sum(axis=0)
    np.testing.assert_allclose(number(balance.rate_of_change + balance.extra), expected, rtol=1e-7, atol=1e-7)
    rate = difference(lambda at: number(balance.angular_momentum, at), 1)
    np.testing.assert_allclose(number(balance.rate_of_change), rate, rtol=1e-9, atol=1e-9)
    frame = axes or B
    turning = frame.ang_vel_in(N).cross(balance.angular_momentum) if frame is not N else 0 * N.x
    np.testing.assert_allclose(number(balance.turning), number(turning), rtol=1e-9, atol=1e-9)
    along = sum((e * axis for e, axis in zip(balance.equation, frame, strict=True)), 0 * N.x)
    np.testing.assert_allclose(number(along), expected, rtol=1e-7, atol=1e-7)
    if kind == "accelerating point":
        own = difference(lambda at: number(point.pos_from(O), at), 2)
        extra = MASSES.sum() * np.cross(number(G.pos_from(point)), own)
        assert np.linalg.norm(extra) > 0.1
        np.testing.assert_allclose(number(balance.extra), extra, rtol=1e-7)
    else:
        assert balance.extra == 0


def test_moments_of_forces_and_couples_about_the_point():
    P, Q, c = dynamicsymbols("P Q c")
    loads = [Force(A, P * N.x), Torque(B, c * B.z)]
    balance = ed.moment_balance(ed.FreeBody(BODY, loads, [Force(G, Q * N.y)]), F, N)
    at = {P: 2.0, Q: -3.0, c: 0.4}
    moments = number(balance.moments.subs(at))
    arms = [number(point.pos_from(F)) for point in (A, G)]
    expected = np.cross(arms[0], [2.0, 0, 0]) + np.cross(arms[1], [0, -3.0, 0]) + 0.4 * number(B.z)
    np.testing.assert_allclose(moments, expected, rtol=1e-9)
    terms = balance.rate_of_change + balance.extra - balance.moments
    along = sum((e * axis for e, axis in zip(balance.equation, B, strict=True)), 0 * N.x)
    np.testing.assert_allclose(number(along.subs(at)), number(terms.subs(at)), rtol=1e-9)


def test_a_point_in_uniform_motion_is_as_good_as_a_fixed_one():
    rolling = Point("R")
    rolling.set_pos(O, 3 * t * N.x + N.y)
    balance = ed.moment_balance(ed.FreeBody(BODY), rolling, N)
    assert (balance.kind, balance.extra) == ("fixed point", 0)


def test_a_particle_about_a_fixed_and_an_accelerating_point():
    theta, (l, m, g) = dynamicsymbols("theta"), sm.symbols("l m g")
    rod, pivot = ReferenceFrame("R"), Point("pivot")
    rod.orient_axis(N, theta, N.z)
    pivot.set_vel(N, x.diff(t) * N.x)  # a velocity that was set, not derived from a place
    bob = pivot.locatenew("bob", -l * rod.y)
    body = ed.FreeBody(
        Particle("bob", bob, m), [Force(bob, -m * g * N.y)], [Force(bob, sm.Symbol("S") * rod.y)]
    )
    balance = ed.moment_balance(body, pivot, N)
    assert balance.kind == "accelerating point"
    eom = ed.EquationsOfMotion.from_residuals([balance.equation[2]], [theta])
    expected = m * l**2 * theta.diff(t, 2) + m * l * sm.cos(theta) * x.diff(t, 2) + m * g * l * sm.sin(theta)
    assert ed.prove_equal(eom, ed.EquationsOfMotion.from_residuals([expected], [theta]))


def test_representations_name_the_terms():
    about_a, about_g = (ed.moment_balance(ed.FreeBody(BODY), point, N) for point in (A, G))
    assert repr(about_a) == "MomentBalance(body about A, accelerating point)"
    assert r"\mathbf{r}_{AG} \times m\,\mathbf{a}_{A}" in about_a._repr_latex_()
    assert r"\times" not in about_g._repr_latex_()


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: ed.moment_balance(BODY, G, N), "not a FreeBody"),
        (lambda: ed.moment_balance(ed.FreeBody(BODY), Point("lost"), N), "not placed"),
        (lambda: ed.moment_balance(ed.FreeBody(BODY), G, "N"), "inertial ReferenceFrame"),
        (
            lambda: ed.moment_balance(ed.FreeBody(Particle("p", F, 1), [Torque(B, B.z)]), O, N),
            "particles do not turn",
        ),
        (
            lambda: ed.moment_balance(ed.FreeBody(BODY, [Force(Point("lost"), N.x)]), G, N),
            "not placed",
        ),
        (lambda: ed.angular_momentum("body", G, N), "neither a Particle nor a RigidBody"),
        (lambda: ed.angular_momentum(BODY, Point("lost"), N), "not placed"),
        (lambda: ed.angular_momentum(BODY, G, ReferenceFrame("M")), "unknown|not oriented"),
    ],
)
def test_what_cannot_be_balanced_is_said(make, message):
    with pytest.raises(ed.EngdynError, match=message):
        make()
