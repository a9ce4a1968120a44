"""Generalized forces by virtual work: hand results, Kane's active forces, workless reactions."""

from __future__ import annotations

import numpy as np
import pytest
import sympy as sm
from sympy.physics import mechanics as me

import engdyn as ed

t = me.dynamicsymbols._t
theta, psi, x = me.dynamicsymbols("theta psi x")
theta_d, psi_d, x_d = (q.diff(t) for q in (theta, psi, x))
F, M, l, a, m, g, R, k, c, J, alpha = sm.symbols("F M l a m g R k c J alpha", positive=True)


def two_bars():
    N, A, B = (me.ReferenceFrame(name) for name in "NAB")
    A.orient_axis(N, theta, N.z)
    B.orient_axis(N, psi, N.z)
    O = me.Point("O")
    O.set_vel(N, 0)
    elbow = O.locatenew("elbow", l * A.x)
    tip = elbow.locatenew("tip", a * B.x)
    return N, A, B, elbow, tip


def test_dead_and_follower_force_by_hand():
    N, _, B, _, tip = two_bars()
    dead = ed.generalized_forces([me.Force(tip, F * N.y)], [theta, psi], N)
    assert dead == {theta: F * l * sm.cos(theta), psi: F * a * sm.cos(psi)}
    follower = ed.generalized_forces(me.Force(tip, -F * B.x), [theta, psi], N)
    assert sm.expand_trig(follower[theta] + F * l * sm.sin(psi - theta)) == 0
    assert follower[psi] == 0  # along the second bar: its turning does no work


def test_torque_between_two_bars_acts_on_the_difference():
    N, A, B, *_ = two_bars()
    Q = ed.generalized_forces([me.Torque(A, -M * N.z), me.Torque(B, M * N.z)], [theta, psi], N)
    assert list(Q.items()) == [(theta, -M), (psi, M)]


@pytest.mark.parametrize("seed", range(3))
def test_kanes_active_forces_are_the_same(seed):
    """sympy's KanesMethod with u = q' computes the same quantities on another way."""
    source = np.random.default_rng(seed)
    u1, u2 = me.dynamicsymbols("u1 u2")

    def scene(first, second):
        N, A, B, elbow, tip = two_bars()
        return (N, A, B, elbow, tip), [
            me.Force(tip, F * B.y - k * first * N.x),
            me.Force(elbow, -m * g * N.y + c * sm.cos(psi) * A.y),
            me.Torque(B, (M - c * second) * N.z),
        ]

    (N, A, B, elbow, tip), loads = scene(u1, u2)
    A.set_ang_vel(N, u1 * N.z)
    B.set_ang_vel(N, u2 * N.z)
    elbow.set_vel(N, l * u1 * A.y)
    tip.set_vel(N, l * u1 * A.y + a * u2 * B.y)
    kane = me.KanesMethod(N, [theta, psi], [u1, u2], kd_eqs=[theta_d - u1, psi_d - u2])
    fr, _ = kane.kanes_equations([me.Particle("p", tip, m)], loads)
    (frame, *_), own = scene(theta_d, psi_d)
    ours = ed.generalized_forces(own, [theta, psi], frame)
    state = dict(zip([theta_d, psi_d, theta, psi], source.uniform(-1, 1, 4), strict=True))
    numbers = dict(zip([F, M, l, a, m, g, k, c], source.uniform(0.5, 2, 8), strict=True))
    for row, q in zip(fr, [theta, psi], strict=True):
        expected = row.subs({u1: theta_d, u2: psi_d}).subs(state).subs(numbers)
        assert float(ours[q].subs(state).subs(numbers)) == pytest.approx(float(expected), rel=1e-12)


def test_workless_reactions_drop_out_when_both_bodies_are_given():
    bar = ed.systems.load("W7")
    coordinates = [c.symbol for c in bar.coordinates]
    bodies = bar.free_bodies()
    both = ed.generalized_forces(bodies, coordinates, bar.frame)
    unknown = {s for Q in both.values() for s in Q.free_symbols} & set(bar.unknowns)
    assert not unknown
    V, D = bar.potential_energy, bar.dissipation
    for q in coordinates:
        assert sm.expand(both[q] + V.diff(q) + D.diff(q.diff(t))) == 0
    alone = ed.generalized_forces(bodies[:1], coordinates, bar.frame)
    assert {s.name for Q in alone.values() for s in Q.free_symbols} >= {"H_x", "H_y"}


def test_the_force_on_a_rolling_body_acts_on_its_material_point():
    """Static friction at the contact point does no work; the geometric point would say it did."""
    N, B = me.ReferenceFrame("N"), me.ReferenceFrame("B")
    B.orient_axis(N, -x / R, N.z)
    O = me.Point("O")
    O.set_vel(N, 0)
    G = O.locatenew("G", x * N.x + R * N.y)
    contact = G.locatenew("C", -R * N.y)
    disc = me.RigidBody("disc", G, B, m, (me.inertia(B, 0, 0, J), G))
    body = ed.FreeBody(disc, applied=[me.Torque(B, -M * N.z)], reactions=[me.Force(contact, F * N.x)])
    assert ed.generalized_forces([body], [x], N) == {x: M / R}
    assert ed.generalized_forces([me.Force(contact, F * N.x)], [x], N) == {x: F}  # a point that slides along


def test_a_spring_force_stays_short():
    N, _, _, elbow, _ = two_bars()
    wall = me.Point("wall")
    elbow.set_pos(wall, l * sm.cos(theta) * N.x + l * sm.sin(theta) * N.y - a * N.x)
    vector = elbow.pos_from(wall)
    length = sm.sqrt(vector.dot(vector))
    Q = ed.generalized_forces([me.Force(elbow, -k * (length - R) * vector / length)], [theta], N)[theta]
    expected = -k * a * l * sm.sin(theta) * (1 - R / sm.sqrt(a**2 + l**2 - 2 * a * l * sm.cos(theta)))
    assert sm.expand(Q - expected) == 0


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: ed.generalized_forces([3], [theta], me.ReferenceFrame("N")), "3 is no load"),
        (lambda: ed.generalized_forces([], [theta], "N"), "frame is 'N'"),
        (lambda: ed.generalized_forces([], theta, me.ReferenceFrame("N")), "must be a list"),
        (
            lambda: ed.generalized_forces(
                [me.Force(me.Point("P"), F * me.ReferenceFrame("K").x)], [x], me.ReferenceFrame("N")
            ),
            "velocity of P in frame N is unknown",
        ),
        (
            lambda: ed.generalized_forces(
                me.Torque(me.ReferenceFrame("B"), F * me.ReferenceFrame("B").x), [x], me.ReferenceFrame("N")
            ),
            "not oriented",
        ),
    ],
)
def test_what_makes_no_sense_is_refused(call, message):
    with pytest.raises(ed.EngdynError, match=message):
        call()


def test_particles_do_not_turn():
    N, A, _, elbow, _ = two_bars()
    body = ed.FreeBody(me.Particle("p", elbow, m), applied=[me.Torque(A, M * N.z)])
    with pytest.raises(ed.EngdynError, match="particles do not turn"):
        ed.generalized_forces(body, [theta], N)
