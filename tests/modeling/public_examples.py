"""Textbook systems that nobody here chose: worked examples of sympy's mechanics, modeled anew."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
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
from modeling.third_opinion import Model, chain, heavy_top

t = dynamicsymbols._t
sin, cos = sm.sin, sm.cos
g = sm.Symbol("g", positive=True)


@dataclass
class Linkage(Model):
    """A model with closed loops: the coordinates have to fit each other."""

    closure: Callable[[list[float], dict[str, float]], list[float]] | None = None


def fixed(frame: ReferenceFrame, name: str = "O") -> Point:
    point = Point(name)
    point.set_vel(frame, 0)
    return point


def double_pendulum_of_particles() -> Model:
    """Two particles on massless rods."""
    a, b = dynamicsymbols("q1 q2")
    m1, m2, l1, l2 = sm.symbols("m1 m2 l1 l2", positive=True)
    S1, S2 = sm.symbols("S1 S2")
    N, A, B = ReferenceFrame("N"), ReferenceFrame("A"), ReferenceFrame("B")
    A.orient_axis(N, a, N.z)
    B.orient_axis(N, b, N.z)
    P = fixed(N).locatenew("P", l1 * A.x)
    Q = P.locatenew("Q", l2 * B.x)
    first = ed.FreeBody(
        Particle("first", P, m1), [Force(P, m1 * g * N.x)], [Force(P, -S1 * A.x), Force(P, S2 * B.x)]
    )
    second = ed.FreeBody(Particle("second", Q, m2), [Force(Q, m2 * g * N.x)], [Force(Q, -S2 * B.x)])
    a_d, b_d = a.diff(t), b.diff(t)
    T = (m1 + m2) * (l1 * a_d) ** 2 / 2 + m2 * (l2 * b_d) ** 2 / 2 + m2 * l1 * l2 * cos(a - b) * a_d * b_d
    V = -(m1 + m2) * g * l1 * cos(a) - m2 * g * l2 * cos(b)
    return Model([a, b], T, V, [first, second], N, [S1, S2])


def blocks_on_springs() -> Model:
    """A block on a spring and a damper that carries another one the same way."""
    x, y, F = dynamicsymbols("x y F")
    m, M, k1, k2, c1, c2 = sm.symbols("m M k1 k2 c1 c2", positive=True)
    N = ReferenceFrame("N")
    O = fixed(N)
    P, Q = O.locatenew("P", x * N.x), O.locatenew("Q", (x + y) * N.x)
    coupling = (k2 * y + c2 * y.diff(t)) * N.x
    lower = ed.FreeBody(
        Particle("lower", P, M),
        [Force(P, -(k1 * x + c1 * x.diff(t)) * N.x), Force(P, coupling), Force(P, M * g * N.x)],
    )
    upper = ed.FreeBody(Particle("upper", Q, m), [Force(Q, -coupling), Force(Q, (F + m * g) * N.x)])
    T = M * x.diff(t) ** 2 / 2 + m * (x.diff(t) + y.diff(t)) ** 2 / 2
    V = k1 * x**2 / 2 + k2 * y**2 / 2 - M * g * x - m * g * (x + y)
    D = c1 * x.diff(t) ** 2 / 2 + c2 * y.diff(t) ** 2 / 2
    return Model([x, y], T, V, [lower, upper], N, [], D, {x: F, y: F})


def particle_in_rotating_tube() -> Model:
    """A particle on a spring in a smooth tube that a torque turns in a vertical plane."""
    theta, r, M = dynamicsymbols("theta r M")
    m, J, k, r_0 = sm.symbols("m J k r_0", positive=True)
    O_x, O_y, S = sm.symbols("O_x O_y S")
    N, A = ReferenceFrame("N"), ReferenceFrame("A")
    A.orient_axis(N, theta, N.z)
    O = fixed(N)
    P = O.locatenew("P", r * A.x)
    pull = -k * (r - r_0) * A.x
    tube = ed.FreeBody(
        RigidBody("tube", O, A, sm.Symbol("m_t", positive=True), (inertia(A, 0, 0, J), O)),
        [Torque(A, M * N.z), Force(O, -pull)],
        [Force(O, O_x * N.x + O_y * N.y), Force(P, -S * A.y)],
    )
    particle = ed.FreeBody(
        Particle("particle", P, m), [Force(P, pull), Force(P, -m * g * N.y)], [Force(P, S * A.y)]
    )
    T = J * theta.diff(t) ** 2 / 2 + m * (r.diff(t) ** 2 + (r * theta.diff(t)) ** 2) / 2
    V = m * g * r * sin(theta) + k * (r - r_0) ** 2 / 2
    return Model([theta, r], T, V, [tube, particle], N, [O_x, O_y, S], forces={theta: M})


def chaotic_pendulum() -> Model:
    """A plate that turns freely about the rod of a pendulum."""
    theta, phi = dynamicsymbols("theta phi")
    m_r, m_p, l_r, l_p, J_r, J_x, J_y, J_z = sm.symbols("m_r m_p l_r l_p J_r J_x J_y J_z", positive=True)
    hinge, plate_force = sm.symbols("O_x O_y O_z"), sm.symbols("P_x P_y P_z")
    M_x, M_z, K_x, K_y = sm.symbols("M_x M_z K_x K_y")
    N, A, B = ReferenceFrame("N"), ReferenceFrame("A"), ReferenceFrame("B")
    A.orient_axis(N, theta, N.y)
    B.orient_axis(A, phi, A.z)
    O = fixed(N)
    G, P = O.locatenew("G", l_r * A.z), O.locatenew("P", l_p * A.z)
    at_O, at_P = (sum((s * e for s, e in zip(f, A, strict=True)), 0 * A.x) for f in (hinge, plate_force))
    couple = K_x * A.x + K_y * A.y
    rod = ed.FreeBody(
        RigidBody("rod", G, A, m_r, (inertia(A, J_r, J_r, 0), G)),
        [Force(G, m_r * g * N.z)],
        [Force(O, at_O), Torque(A, M_x * A.x + M_z * A.z), Force(P, -at_P), Torque(A, -couple)],
    )
    plate = ed.FreeBody(
        RigidBody("plate", P, B, m_p, (inertia(B, J_x, J_y, J_z), P)),
        [Force(P, m_p * g * N.z)],
        [Force(P, at_P), Torque(B, couple)],
    )
    a, b = theta.diff(t), phi.diff(t)
    T = (m_r * l_r**2 + J_r + m_p * l_p**2) * a**2 / 2
    T += (J_x * (a * sin(phi)) ** 2 + J_y * (a * cos(phi)) ** 2 + J_z * b**2) / 2
    V = -(m_r * l_r + m_p * l_p) * g * cos(theta)
    return Model([theta, phi], T, V, [rod, plate], N, [*hinge, *plate_force, M_x, M_z, K_x, K_y])


def slider_crank() -> Linkage:
    """Crank, connecting rod and slider with all three coordinates kept; the loop closed by its velocities."""
    theta, phi, x, M = dynamicsymbols("theta phi x M")
    r, l, a, b, J_c, J_r, m_c, m_r, m_s = sm.symbols("r l a b J_c J_r m_c m_r m_s", positive=True)
    names = sm.symbols("O_x O_y A_x A_y B_x B_y W")
    O_x, O_y, A_x, A_y, B_x, B_y, W = names
    N, C, R = ReferenceFrame("N"), ReferenceFrame("C"), ReferenceFrame("R")
    C.orient_axis(N, theta, N.z)
    R.orient_axis(N, -phi, N.z)
    O = fixed(N)
    A, G_c = O.locatenew("A", r * C.x), O.locatenew("G_c", a * C.x)
    G_r, B, S = A.locatenew("G_r", b * R.x), A.locatenew("B", l * R.x), O.locatenew("S", x * N.x)
    at_A, at_B = A_x * N.x + A_y * N.y, B_x * N.x + B_y * N.y
    bodies = [
        ed.FreeBody(
            RigidBody("crank", G_c, C, m_c, (inertia(C, 0, 0, J_c), G_c)),
            [Force(G_c, -m_c * g * N.y), Torque(C, M * N.z)],
            [Force(O, O_x * N.x + O_y * N.y), Force(A, -at_A)],
        ),
        ed.FreeBody(
            RigidBody("rod", G_r, R, m_r, (inertia(R, 0, 0, J_r), G_r)),
            [Force(G_r, -m_r * g * N.y)],
            [Force(A, at_A), Force(B, -at_B)],
        ),
        ed.FreeBody(
            Particle("slider", S, m_s), [Force(S, -m_s * g * N.y)], [Force(S, at_B), Force(S, W * N.y)]
        ),
    ]
    a_d, p_d = theta.diff(t), phi.diff(t)
    v = [-r * sin(theta) * a_d - b * sin(phi) * p_d, r * cos(theta) * a_d - b * cos(phi) * p_d]
    T = (J_c + m_c * a**2) * a_d**2 / 2 + J_r * p_d**2 / 2 + m_s * x.diff(t) ** 2 / 2
    T += m_r * (v[0] ** 2 + v[1] ** 2) / 2
    V = m_c * g * a * sin(theta) + m_r * g * (r * sin(theta) - b * sin(phi))
    loop = [r * cos(theta) + l * cos(phi) - x, r * sin(theta) - l * sin(phi)]

    def closure(q: list[float], p: dict[str, float]) -> list[float]:
        angle = np.arcsin(p["r"] / p["l"] * np.sin(q[0]))
        return [q[0], angle, p["r"] * np.cos(q[0]) + p["l"] * np.cos(angle)]

    return Linkage(
        [theta, phi, x],
        T,
        V,
        bodies,
        N,
        list(names),
        forces={theta: M},
        constraints=[e.diff(t) for e in loop],
        ranges={"r": (0.3, 0.6), "l": (1.0, 1.5)},
        closure=closure,
    )


def four_bar() -> Linkage:
    """Three bars pinned to each other and to the ground: two loop equations, one degree of freedom."""
    q = list(dynamicsymbols("q1:4"))
    lengths, masses = sm.symbols("l1:4", positive=True), sm.symbols("m1:4", positive=True)
    d = sm.Symbol("d", positive=True)
    names = sm.symbols("O_x O_y A_x A_y B_x B_y C_x C_y")
    N = ReferenceFrame("N")
    O = fixed(N)
    C = O.locatenew("C", d * N.x)
    C.set_vel(N, 0)
    bars = [ReferenceFrame(f"B{i}") for i in (1, 2, 3)]
    for bar, angle in zip(bars, q, strict=True):
        bar.orient_axis(N, angle, N.z)
    at = [names[i] * N.x + names[i + 1] * N.y for i in (0, 2, 4, 6)]
    starts = [O, O.locatenew("A", lengths[0] * bars[0].x), C]
    ends = [
        s.locatenew(f"E{i}", l * bar.x)
        for i, (s, l, bar) in enumerate(zip(starts, lengths, bars, strict=True))
    ]
    reactions = [
        [Force(O, at[0]), Force(ends[0], -at[1])],
        [Force(starts[1], at[1]), Force(ends[1], -at[2])],
        [Force(C, at[3]), Force(ends[2], at[2])],
    ]
    bodies, T, V = [], sm.S.Zero, sm.S.Zero
    origin = [(0, 0), (lengths[0] * cos(q[0]), lengths[0] * sin(q[0])), (d, 0)]
    for i, (bar, l, m, angle) in enumerate(zip(bars, lengths, masses, q, strict=True)):
        G = starts[i].locatenew(f"G{i}", l / 2 * bar.x)
        body = RigidBody(f"bar {i + 1}", G, bar, m, (inertia(bar, 0, 0, m * l**2 / 12), G))
        bodies.append(ed.FreeBody(body, [Force(G, -m * g * N.y)], reactions[i]))
        x, y = origin[i][0] + l / 2 * cos(angle), origin[i][1] + l / 2 * sin(angle)
        T += m * (sm.diff(x, t) ** 2 + sm.diff(y, t) ** 2) / 2 + m * l**2 / 12 * angle.diff(t) ** 2 / 2
        V += m * g * y
    l1, l2, l3 = lengths
    loop = [f(q[0]) * l1 + f(q[1]) * l2 - f(q[2]) * l3 - shift for f, shift in ((cos, d), (sin, 0))]

    def closure(start: list[float], p: dict[str, float]) -> list[float]:
        """The third angle puts the end at the height of C; the distance d follows."""
        height = p["l1"] * np.sin(start[0]) + p["l2"] * np.sin(start[1])
        return [start[0], start[1], np.pi - np.arcsin(height / p["l3"])]

    ranges = {"l1": (0.3, 0.5), "l2": (0.4, 0.6), "l3": (1.2, 1.5)}
    return Linkage(
        q, T, V, bodies, N, list(names), constraints=[e.diff(t) for e in loop], ranges=ranges, closure=closure
    )


def rolling_disc() -> Model:
    """A thin disc that rolls without slip, its contact point (x, y) among the coordinates: two velocity constraints."""
    x, y, yaw, lean, spin = dynamicsymbols("x y psi theta phi")
    m, r, I, J = sm.symbols("m r I J", positive=True)
    R = sm.symbols("R_x R_y R_z")
    N, Y, L, D = (ReferenceFrame(name) for name in "NYLD")
    Y.orient_axis(N, yaw, N.z)
    L.orient_axis(Y, lean, Y.x)
    D.orient_axis(L, spin, L.y)
    contact = fixed(N).locatenew("P", x * N.x + y * N.y)
    G = contact.locatenew("G", r * L.z)
    disc = RigidBody("disc", G, D, m, (inertia(L, I, J, I), G))
    support = R[0] * Y.x + R[1] * Y.y + R[2] * N.z
    free = ed.FreeBody(disc, [Force(G, -m * g * N.z)], [Force(contact, support)])
    slip = (x.diff(t) * N.x + y.diff(t) * N.y + (r * L.z).dt(N)) - D.ang_vel_in(N).cross(r * L.z)
    v = x.diff(t) * N.x + y.diff(t) * N.y + (r * L.z).dt(N)
    w = [D.ang_vel_in(N).dot(e) for e in L]
    T = m * v.dot(v) / 2 + (I * w[0] ** 2 + J * w[1] ** 2 + I * w[2] ** 2) / 2
    return Model(
        [yaw, lean, spin, x, y],
        T,
        m * g * r * cos(lean),
        [free],
        N,
        list(R),
        constraints=[slip.dot(Y.x), slip.dot(Y.y)],
    )


def disc_in_its_own_rates(own: bool) -> tuple[ed.EquationsOfMotion, dict]:
    """The disc without its contact point: yaw, lean and spin, speeds u = ω in the axes of the lean frame, or rates.

    Returns the equations and what KanesMethod needs of the same model.
    """
    q, u = dynamicsymbols("psi theta phi"), dynamicsymbols("u1:4")
    q_d = [e.diff(t) for e in q]
    m, r, I, J = sm.symbols("m r I J", positive=True)
    R = sm.symbols("R_x R_y R_z")
    N, Y, L, D = (ReferenceFrame(name) for name in "NYLD")
    Y.orient_axis(N, q[0], N.z)
    L.orient_axis(Y, q[1], Y.x)
    D.orient_axis(L, q[2], L.y)
    rates = {
        q[0]: u[2] / cos(q[1]),
        q[1]: u[0],
        q[2]: u[1] - u[2] * sm.tan(q[1]),
    }
    if own:
        L.set_ang_vel(N, u[0] * L.x + u[2] * sm.tan(q[1]) * L.y + u[2] * L.z)
        D.set_ang_vel(N, u[0] * L.x + u[1] * L.y + u[2] * L.z)
    G = Point("G")
    P = G.locatenew("P", -r * L.z)
    P.set_vel(N, 0)
    G.v2pt_theory(P, N, D)
    disc = RigidBody("disc", G, D, m, (inertia(L, I, J, I), G))
    support = R[0] * Y.x + R[1] * Y.y + R[2] * N.z
    free = ed.FreeBody(disc, [Force(G, -m * g * N.z)], [Force(P, support)])
    described = {"speeds": u, "kinematics": rates} if own else {}
    eom = ed.newton_euler([free], q, N, list(R), **described)
    kinematic = [rate - e for e, rate in zip(q_d, (rates[e] for e in q), strict=True)]
    return eom, {"frame": N, "q": q, "u": u, "kinematic": kinematic, "body": disc, "loads": free.applied}


def sleigh() -> Model:
    """A plate on a knife edge at a distance from its mass center: it slides along the edge only."""
    x, y, psi, F, M = dynamicsymbols("x y psi F M")
    m, J, a = sm.symbols("m J a", positive=True)
    S = sm.Symbol("S")
    N, A = ReferenceFrame("N"), ReferenceFrame("A")
    A.orient_axis(N, psi, N.z)
    P = fixed(N).locatenew("P", x * N.x + y * N.y)
    G = P.locatenew("G", a * A.x)
    plate = RigidBody("plate", G, A, m, (inertia(A, 0, 0, J), G))
    free = ed.FreeBody(plate, [Force(P, F * A.x), Torque(A, M * N.z)], [Force(P, S * A.y)])
    p_d = psi.diff(t)
    v = [x.diff(t) - a * sin(psi) * p_d, y.diff(t) + a * cos(psi) * p_d]
    T = m * (v[0] ** 2 + v[1] ** 2) / 2 + J * p_d**2 / 2
    edge = -x.diff(t) * sin(psi) + y.diff(t) * cos(psi)
    return Model(
        [x, y, psi],
        T,
        0,
        [free],
        N,
        [S],
        forces={x: F * cos(psi), y: F * sin(psi), psi: M},
        constraints=[edge],
    )


EXAMPLES = {
    "double pendulum": double_pendulum_of_particles,
    "cart and pendulum": lambda: chain(1, cart=True),
    "blocks on springs": blocks_on_springs,
    "particle in a rotating tube": particle_in_rotating_tube,
    "chaotic pendulum": chaotic_pendulum,
    "spinning top": heavy_top,
    "slider-crank": slider_crank,
    "four-bar linkage": four_bar,
    "rolling disc": rolling_disc,
    "knife edge": sleigh,
}
