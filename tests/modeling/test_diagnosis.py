"""The mistakes of chapters 1 to 3, made by a student on real systems: the wrong term is named, and nothing else."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

import pytest
import sympy as sm
from sympy.physics.mechanics import dynamicsymbols

import engdyn as ed

t = dynamicsymbols._t
sin, cos, pi = sm.sin, sm.cos, sm.pi
HALF, TWO = Fraction(1, 2), Fraction(2)


@dataclass
class Mistake:
    """What a student derived, what is right, and what has to be said of it."""

    student: ed.EquationsOfMotion
    right: ed.EquationsOfMotion
    told: list[tuple]  # (coordinate, kind, term, factor)
    remark: str


def residuals(eom: ed.EquationsOfMotion) -> list[sm.Expr]:
    return list(eom.mass_matrix * sm.Matrix([u.diff(t) for u in eom.speeds]) - eom.forcing)


def by_hand(rows: list[sm.Expr], coordinates: list[sm.Expr]) -> ed.EquationsOfMotion:
    return ed.EquationsOfMotion.from_residuals(rows, coordinates)


# S07: trolley and swinging container


class Crane:
    system = ed.systems.load("S07")
    x, theta = (c.symbol for c in system.coordinates)
    M_t, m, J_G, L, c_x, c_h, g = (
        next(p.symbol for p in ed.systems.load("S07").parameters if p.name == name)
        for name in ("M_t", "m", "J_G", "L", "c_x", "c_h", "g")
    )
    q = [x, theta]
    x_d, theta_d, x_dd, theta_dd = x.diff(t), theta.diff(t), x.diff(t, 2), theta.diff(t, 2)
    F, W = (i.symbol for i in system.inputs)
    rows = [
        (M_t + m) * x_dd + m * L * (cos(theta) * theta_dd - sin(theta) * theta_d**2) + c_x * x_d - F - W,
        (J_G + m * L**2) * theta_dd
        + m * L * cos(theta) * x_dd
        + m * g * L * sin(theta)
        + c_h * theta_d
        - W * L * cos(theta),
    ]


def crane(row: int, change: sm.Expr) -> ed.EquationsOfMotion:
    rows = list(Crane.rows)
    rows[row] += change
    return by_hand(rows, Crane.q)


def moment_about_the_accelerating_hinge():
    """ΣM_A = J_A θ'', the hinge A of the trolley taken for a fixed point."""
    C = Crane
    lost = C.m * C.L * cos(C.theta) * C.x_dd
    return Mistake(
        crane(1, -lost),
        C.system.newton(),
        [("theta", "missing", lost, None)],
        "moment balance about an accelerating point: the term m r_PG × a_P",
    )


def kinetic_energy_with_relative_velocity():
    """T of the container with its velocity as seen from the trolley."""
    C = Crane
    relative = C.M_t * C.x_d**2 / 2 + C.m * (C.x_d**2 + C.L**2 * C.theta_d**2) / 2 + C.J_G * C.theta_d**2 / 2
    s = C.system
    student = ed.lagrange(relative, s.potential_energy, C.q, s.dissipation, s.generalized_forces)
    lost = C.m * C.L * cos(C.theta)
    return Mistake(
        student,
        s.lagrange(),
        [
            ("x", "missing", lost * C.theta_dd, None),
            ("x", "missing", -C.m * C.L * sin(C.theta) * C.theta_d**2, None),
            ("theta", "missing", lost * C.x_dd, None),
        ],
        "relative velocities in T",
    )


def height_measured_downwards():
    C, s = Crane, Crane.system
    student = ed.lagrange(s.kinetic_energy, -s.potential_energy, C.q, s.dissipation, s.generalized_forces)
    term = C.m * C.g * C.L * sin(C.theta)
    return Mistake(student, s.newton(), [("theta", "sign", term, Fraction(-1))], "gravity acts the other way")


def weight_in_potential_and_force():
    C = Crane
    weight = C.m * C.g * C.L * sin(C.theta)
    return Mistake(
        crane(1, weight), C.system.newton(), [("theta", "factor", weight, TWO)], "gravity counted twice"
    )


def parallel_axis_forgotten():
    C = Crane
    lost = C.m * C.L**2 * C.theta_dd
    return Mistake(
        crane(1, -lost), C.system.lagrange(), [("theta", "missing", lost, None)], "parallel-axis term"
    )


def hinge_force_on_the_trolley_forgotten():
    """Newton for the trolley alone, without what the container does to it (the wind's part included)."""
    C = Crane
    lost = [C.m * C.x_dd, C.m * C.L * cos(C.theta) * C.theta_dd, -C.m * C.L * sin(C.theta) * C.theta_d**2]
    return Mistake(
        crane(0, -sm.Add(*lost)),
        C.system.newton(),
        [("x", "missing", term, None) for term in lost],
        "nothing with m is left in this equation",
    )


def sine_of_degrees():
    C = Crane
    term = C.m * C.g * C.L * sin(C.theta)
    wrong = term.subs(C.theta, pi * C.theta / 180)
    return Mistake(
        crane(1, wrong - term), C.system.newton(), [("theta", "changed", term, None)], "degrees and radians"
    )


def couple_per_degree():
    """A rate in deg/s with a damping constant in N m s/rad."""
    C = Crane
    term = C.c_h * C.theta_d
    return Mistake(
        crane(1, (180 / pi - 1) * term),
        C.system.newton(),
        [("theta", "factor", term, 180 / pi)],
        "degrees and radians",
    )


def mass_for_weight():
    C = Crane
    number = Fraction(100, 981)
    right = [row.subs(C.g, sm.Rational(981, 100)) for row in C.rows]
    term = C.m * sm.Rational(981, 100) * C.L * sin(C.theta)
    wrong = [right[0], right[1] + (sm.Rational(100, 981) - 1) * term]
    return Mistake(
        by_hand(wrong, C.q), by_hand(right, C.q), [("theta", "factor", term, number)], "a mass and a weight"
    )


def sine_for_cosine():
    C = Crane
    term = C.m * C.L * cos(C.theta) * C.x_dd
    wrong = C.m * C.L * sin(C.theta) * C.x_dd
    return Mistake(
        crane(1, wrong - term), C.system.newton(), [("theta", "changed", term, None)], "sine and cosine"
    )


def lever_arm_forgotten():
    C = Crane
    term = C.m * C.g * C.L * sin(C.theta)
    return Mistake(
        crane(1, term / C.L - term),
        C.system.newton(),
        [("theta", "changed", term, None)],
        "a factor L is missing",
    )


def centripetal_sign():
    C = Crane
    term = -C.m * C.L * sin(C.theta) * C.theta_d**2
    return Mistake(
        crane(0, -2 * term), C.system.newton(), [("x", "sign", term, Fraction(-1))], "centripetal term"
    )


def rate_not_squared():
    C = Crane
    term = -C.m * C.L * sin(C.theta) * C.theta_d**2
    return Mistake(
        crane(0, term / C.theta_d - term),
        C.system.newton(),
        [("x", "changed", term, None)],
        "a factor theta' is missing",
    )


# W7: bar hinged to a slider on an inclined guide


def moment_about_the_slider():
    system = ed.systems.load("W7")
    s, theta = (c.symbol for c in system.coordinates)
    values = {p.name: p.symbol for p in system.parameters}
    m, l, gamma = values["m"], values["l"], values["gamma"]
    rows = residuals(system.lagrange())
    lost = m * l / 2 * cos(theta - gamma) * s.diff(t, 2)
    return Mistake(
        by_hand([rows[0], 3 * (rows[1] - lost) / (m * l**2)], [s, theta]),
        system.newton(),
        [("theta", "missing", lost, None)],
        "m r_PG × a_P",
    )


def sum_for_difference_of_angles():
    system = ed.systems.load("W7")
    s, theta = (c.symbol for c in system.coordinates)
    values = {p.name: p.symbol for p in system.parameters}
    m, l, gamma = values["m"], values["l"], values["gamma"]
    rows = residuals(system.lagrange())
    term = m * l / 2 * cos(theta - gamma) * s.diff(t, 2)
    wrong = m * l / 2 * cos(theta + gamma) * s.diff(t, 2)
    return Mistake(
        by_hand([rows[0], rows[1] - term + wrong], [s, theta]),
        system.newton(),
        [("theta", "changed", term, None)],
        "the sum of the angles stands where their difference belongs",
    )


# S03 and S23: Rayleigh's function


def rayleigh_without_one_half():
    """D = power of the dampers, for the whole governor."""
    system = ed.systems.load("S03")
    q = [c.symbol for c in system.coordinates]
    student = ed.lagrange(
        system.kinetic_energy,
        system.potential_energy,
        q,
        2 * system.dissipation,
        system.generalized_forces,
    )
    term = system.dissipation.diff(q[0].diff(t))
    return Mistake(student, system.newton(), [("theta", "factor", term, TWO)], "half the dissipated power")


def governor_centrifugal_half():
    system = ed.systems.load("S03")
    (theta,) = (c.symbol for c in system.coordinates)
    values = {p.name: p.symbol for p in system.parameters}
    drive = next(f for f in system.lagrange().inputs if f.func.__name__ == "drive")
    m, l = values["m"], values["l"]
    term = -2 * m * l**2 * drive.diff(t) ** 2 * sin(theta) * cos(theta)
    (row,) = residuals(system.lagrange())
    return Mistake(
        by_hand([row - term / 2], [theta]),
        system.newton(),
        [("theta", "factor", term, HALF)],
        "half as large",
    )


def half_car_damper_at_its_lever_arm():
    """The rate at the front damper taken as that of the mass center: its lever arm is left out."""
    system = ed.systems.load("S23")
    q = [c.symbol for c in system.coordinates]
    rows = residuals(system.lagrange())
    D = sm.expand(system.dissipation)
    y, theta = q[0], q[1]
    damper = next(p.symbol for p in system.parameters if p.name.startswith("c_"))
    lost = D.diff(y.diff(t)).coeff(theta.diff(t)).coeff(damper) * damper * theta.diff(t)
    return Mistake(
        by_hand([rows[0] - lost, *rows[1:]], q),
        system.newton(),
        [(y.func.__name__, "missing", lost, None)],
        "lever arm",
    )


# A pendulum on a base whose motion is prescribed


class Base:
    theta, x_b = dynamicsymbols("theta x_b")
    m, l, g, c, J = sm.symbols("m l g c J_G", positive=True)
    q = [theta]
    base = m * l * cos(theta) * x_b.diff(t, 2)
    row = (J + m * l**2) * theta.diff(t, 2) + base + m * g * l * sin(theta) + c * theta.diff(t)
    right = ed.lagrange(
        m
        * (x_b.diff(t) ** 2 + 2 * x_b.diff(t) * l * cos(theta) * theta.diff(t) + l**2 * theta.diff(t) ** 2)
        / 2
        + J * theta.diff(t) ** 2 / 2,
        -m * g * l * cos(theta),
        [theta],
        c * theta.diff(t) ** 2 / 2,
    )


def relative_kinetic_energy_on_a_moving_base():
    B = Base
    relative = (B.J + B.m * B.l**2) * B.theta.diff(t) ** 2 / 2
    student = ed.lagrange(relative, -B.m * B.g * B.l * cos(B.theta), B.q, B.c * B.theta.diff(t) ** 2 / 2)
    return Mistake(student, B.right, [("theta", "missing", B.base, None)], "relative velocities in T")


def sign_of_the_base_term():
    B = Base
    return Mistake(
        by_hand([B.row - 2 * B.base], B.q),
        B.right,
        [("theta", "sign", B.base, Fraction(-1))],
        "base acceleration x_b'' has its sign reversed",
    )


def parallel_axis_twice():
    B = Base
    extra = B.m * B.l**2 * B.theta.diff(t, 2)
    right = by_hand([B.row.subs(B.J, sm.Symbol("J_O", positive=True)) - extra], B.q)
    student = by_hand([B.row.subs(B.J, sm.Symbol("J_O", positive=True))], B.q)
    return Mistake(student, right, [("theta", "extra", extra, None)], "parallel-axis term")


# A turntable (angle theta) with a carriage (s) in a slot at the offset e, held by a spring of free length s_0


class Turntable:
    theta, s, M = dynamicsymbols("theta s M")
    J, m, e, k, c, s_0 = sm.symbols("J m e k c s_0", positive=True)
    q = [theta, s]
    theta_d, s_d = theta.diff(t), s.diff(t)
    theta_dd, s_dd = theta.diff(t, 2), s.diff(t, 2)
    T = J * theta_d**2 / 2 + m * ((s_d - e * theta_d) ** 2 + (s * theta_d) ** 2) / 2
    V = k * (s - s_0) ** 2 / 2
    D = c * s_d**2 / 2
    right = ed.lagrange(T, V, q, D, {theta: M})
    rows = residuals(right)


def coriolis_without_two():
    C = Turntable
    term = 2 * C.m * C.s * C.s_d * C.theta_d
    return Mistake(
        by_hand([C.rows[0] - term / 2, C.rows[1]], C.q),
        C.right,
        [("theta", "factor", term, HALF)],
        "the Coriolis term 2 ω v has lost its factor 2",
    )


def coriolis_without_two_and_scaled():
    C = Turntable
    term = 2 * C.m * C.s * C.s_d * C.theta_d
    scaled = (C.rows[0] - term / 2) / (C.J + C.m * C.s**2)
    return Mistake(
        by_hand([C.rows[1] / C.m, scaled], C.q),
        C.right,
        [("theta", "factor", term, HALF)],
        "the Coriolis term 2 ω v has lost its factor 2",
    )


def coriolis_missing():
    C = Turntable
    term = 2 * C.m * C.s * C.s_d * C.theta_d
    return Mistake(
        by_hand([C.rows[0] - term, C.rows[1]], C.q),
        C.right,
        [("theta", "missing", term, None)],
        "Coriolis term 2 ω v is missing",
    )


def offset_of_the_slot_forgotten():
    """Velocity of the carriage along the slot s' in place of s' − e θ'."""
    C = Turntable
    student = ed.lagrange(C.T.subs(C.e, 0), C.V, C.q, C.D, {C.theta: C.M})
    return Mistake(
        student,
        C.right,
        [
            ("theta", "missing", C.m * C.e**2 * C.theta_dd, None),
            ("theta", "missing", -C.m * C.e * C.s_dd, None),
            ("s", "missing", -C.m * C.e * C.theta_dd, None),
        ],
        "e occurs nowhere in your equations: a distance or an offset left out",
    )


def spring_without_free_length():
    C = Turntable
    student = ed.lagrange(C.T, C.k * C.s**2 / 2, C.q, C.D, {C.theta: C.M})
    return Mistake(
        student, C.right, [("s", "missing", -C.k * C.s_0, None)], "the free length s_0 of the spring"
    )


def oblique_spring_without_free_length():
    x, F = dynamicsymbols("x F")
    m, k, h, L_0 = sm.symbols("m k h L_0", positive=True)
    length, T = sm.sqrt(x**2 + h**2), m * x.diff(t) ** 2 / 2
    right = ed.lagrange(T, k * (length - L_0) ** 2 / 2, [x], 0, {x: F})
    student = ed.lagrange(T, k * length**2 / 2, [x], 0, {x: F})
    return Mistake(
        student, right, [("x", "missing", -k * L_0 * x / length, None)], "the free length L_0 of the spring"
    )


def constant_speed_of_the_table():
    """A particle in a plane that turns with the constant speed Omega: 2 m Omega x' without the 2."""
    x, y = dynamicsymbols("x y")
    m, k, W = sm.symbols("m k Omega", positive=True)
    T = m * ((x.diff(t) - W * y) ** 2 + (y.diff(t) + W * x) ** 2) / 2
    right = ed.lagrange(T, k * (x**2 + y**2) / 2, [x, y])
    rows, term = residuals(right), -2 * m * W * y.diff(t)
    return Mistake(
        by_hand([rows[0] - term / 2, rows[1]], [x, y]),
        right,
        [("x", "factor", term, HALF)],
        "the Coriolis term 2 ω v has lost its factor 2",
    )


# Double pendulum, Ziegler's column, friction, two masses


def double_pendulum_with_the_sum_of_angles():
    a, b = dynamicsymbols("theta1 theta2")
    m1, m2, l1, l2, g = sm.symbols("m1 m2 l1 l2 g", positive=True)
    a_d, b_d = a.diff(t), b.diff(t)

    def derived(angle: sm.Expr) -> ed.EquationsOfMotion:
        T = (m1 + m2) * l1**2 * a_d**2 / 2 + m2 * l2**2 * b_d**2 / 2 + m2 * l1 * l2 * cos(angle) * a_d * b_d
        return ed.lagrange(T, -(m1 + m2) * g * l1 * cos(a) - m2 * g * l2 * cos(b), [a, b])

    C = m2 * l1 * l2
    return Mistake(
        derived(a + b),
        derived(a - b),
        [
            ("theta1", "changed", C * cos(a - b) * b.diff(t, 2), None),
            ("theta1", "changed", C * sin(a - b) * b_d**2, None),
            ("theta2", "changed", C * cos(a - b) * a.diff(t, 2), None),
            ("theta2", "changed", -C * sin(a - b) * a_d**2, None),
        ],
        "the sum of the angles stands where their difference belongs",
    )


def follower_force_with_a_potential():
    a, b = dynamicsymbols("theta1 theta2")
    m, l, k, P = sm.symbols("m l k P", positive=True)
    a_d, b_d = a.diff(t), b.diff(t)
    T = m * l**2 * (2 * a_d**2 + b_d**2 + 2 * cos(a - b) * a_d * b_d) / 2
    V = k * (a**2 + (b - a) ** 2) / 2
    right = ed.lagrange(T, V, [a, b], 0, {a: P * l * sin(a - b)})
    student = ed.lagrange(T, V + P * l * (cos(a) + cos(b)), [a, b])
    return Mistake(
        student,
        right,
        [
            ("theta1", "changed", -P * l * sin(a - b), None),
            ("theta2", "extra", -P * l * sin(b), None),
        ],
        "P has a potential in your equations",
    )


def normal_force_assumed():
    """A block pulled obliquely: N = m g − F sin(alpha), not m g."""
    x, F = dynamicsymbols("x F")
    m, g, mu, alpha = sm.symbols("m g mu alpha", positive=True)
    slip = sm.sign(x.diff(t))
    row = m * x.diff(t, 2) + mu * (m * g - F * sin(alpha)) * slip - F * cos(alpha)
    lost = -mu * F * sin(alpha) * slip
    return Mistake(
        by_hand([row - lost], [x]), by_hand([row], [x]), [("x", "missing", lost, None)], "N = m g assumed"
    )


def normal_force_on_a_curved_guide():
    """A bead on a circular wire: N = m g cos(theta) + m r theta'^2."""
    theta = dynamicsymbols("theta")
    m, g, mu, r = sm.symbols("m g mu_k r", positive=True)
    slip = sm.sign(theta.diff(t))
    row = (
        m * r * theta.diff(t, 2)
        + m * g * sin(theta)
        + mu * m * (g * cos(theta) + r * theta.diff(t) ** 2) * slip
    )
    lost = mu * m * r * theta.diff(t) * sm.Abs(theta.diff(t))
    return Mistake(
        by_hand([row - lost], [theta]),
        by_hand([row], [theta]),
        [("theta", "missing", lost, None)],
        "N = m g assumed",
    )


def reaction_on_the_second_mass_forgotten():
    x, y = dynamicsymbols("x y")
    m1, m2, k1, k2, c = sm.symbols("m1 m2 k1 k2 c", positive=True)
    rows = [
        m1 * x.diff(t, 2) + k1 * x + k2 * (x - y) + c * x.diff(t),
        m2 * y.diff(t, 2) + k2 * (y - x) + c * y.diff(t),
    ]
    lost = k2 * (y - x)
    return Mistake(
        by_hand([rows[0], rows[1] - lost], [x, y]),
        by_hand(rows, [x, y]),
        [("y", "missing", lost, None)],
        "was the reaction on this body forgotten",
    )


def stiffness_of_the_other_spring():
    x, y = dynamicsymbols("x y")
    m1, m2, k1, k2 = sm.symbols("m1 m2 k1 k2", positive=True)
    rows = [m1 * x.diff(t, 2) + k1 * x + k2 * (x - y), m2 * y.diff(t, 2) + k2 * (y - x)]
    return Mistake(
        by_hand([m1 * x.diff(t, 2) + k1 * x + k2 * x - k1 * y, rows[1]], [x, y]),
        by_hand(rows, [x, y]),
        [("x", "changed", -k2 * y, None)],
        "k1 stands where k2 belongs",
    )


MISTAKES = [
    value
    for value in list(globals().values())
    if callable(value) and getattr(value, "__module__", "") == __name__ and not isinstance(value, type)
    if value not in (residuals, by_hand, crane)
]


@pytest.mark.parametrize("make", MISTAKES, ids=lambda make: make.__name__)
def test_the_wrong_term_is_named_and_no_other(make):
    case = make()
    proof = ed.prove_equal(case.student, case.right)
    assert proof.verdict == "refuted"
    told = [(d.coordinate, d.kind, d.factor) for d in proof.differences]
    assert told == [(coordinate, kind, factor) for coordinate, kind, _, factor in case.told], proof
    for difference, (_, _, term, _) in zip(proof.differences, case.told, strict=True):
        assert sm.expand(sm.expand_trig(difference.term - term)) == 0, (difference, term)
    assert any(case.remark in d.remark for d in proof.differences), proof
    assert str(proof.differences[0]) in repr(proof)


# More systems: what is changed in the energies, the loads or a row, and what has to be said where


class Slip:
    """A system of the catalogue, and a student who derives it with something else in one place."""

    def __init__(self, key: str):
        self.system = ed.systems.load(key)
        self.q = [c.symbol for c in self.system.coordinates]
        self.p = {p.name: p.symbol for p in self.system.parameters}
        self.inputs = {f.func.__name__: f for f in self.system.lagrange().inputs}

    def energies(self, T=0, V=0, D=0, Q=None) -> ed.EquationsOfMotion:
        """Lagrange's equations with something added to T, V and D, and loads replaced."""
        s, loads = self.system, self.system.generalized_forces
        T, V, D = s.kinetic_energy + T, s.potential_energy + V, s.dissipation + D
        return ed.lagrange(T, V, self.q, D, loads if Q is None else Q)

    def row(self, **changes: sm.Expr) -> ed.EquationsOfMotion:
        """The right equations with something added to those of some coordinates."""
        rows = residuals(self.system.lagrange())
        return by_hand(
            [r + changes.get(q.func.__name__, 0) for r, q in zip(rows, self.q, strict=True)], self.q
        )


def hip_inertia_with_the_speed_of_g(s):
    b, p = s.q[1], s.p
    return s.energies(T=p["m_2"] * p["a_2"] ** 2 * b.diff(t) ** 2 / 2)


def hip_spring_to_the_ground(s):
    a, b = s.q
    return s.energies(V=s.p["k_h"] * (b**2 - (b - a) ** 2) / 2)


def hip_damper_to_the_ground(s):
    a, b = s.q
    return s.energies(D=s.p["c_h"] * (b.diff(t) ** 2 - (b.diff(t) - a.diff(t)) ** 2) / 2)


def motor_without_its_work_on_the_shell(s):
    return s.energies(Q={s.q[1]: s.inputs["tau"]})


def pendulum_rate_in_the_wrong_sense(s):
    x, theta = s.q
    return s.energies(D=-2 * s.p["c_a"] * theta.diff(t) * x.diff(t) / s.p["R"])


def angle_not_from_the_slope(s):
    (x, theta), p = s.q, s.p
    wrong, right = cos(theta), cos(theta - p["beta"])
    return s.energies(T=p["m"] * p["l"] * (wrong - right) * x.diff(t) * theta.diff(t))


def lift_arm_without_its_cosine(s):
    y, alpha = s.q
    Q = s.system.generalized_forces
    return s.energies(Q={y: Q[y], alpha: sm.cancel(Q[alpha] / cos(alpha))})


def spin_of_the_rotor_for_that_of_its_axes(s):
    (alpha, beta), extra = s.q, s.p["A"] * s.p["Omega"] * cos(s.q[1])
    return s.row(alpha=-extra * beta.diff(t), beta=extra * alpha.diff(t))


def spin_of_the_top_for_that_of_its_axes(s):
    phi, theta, psi = s.q
    return s.row(theta=-s.p["A"] * sin(theta) * phi.diff(t) * psi.diff(t))


def gyro_couple_on_the_ship_turned(s):
    theta = s.q[1]
    return s.row(phi=-2 * s.p["C_r"] * s.p["w_s"] * cos(theta) * theta.diff(t))


def steady_turning_taken_for_granted(s):
    drive, alpha, beta = s.inputs["drive"], *s.q
    m, L, R = s.p["m"], s.p["L"], s.p["R"]
    return s.row(alpha=m * L * (L * sin(beta) + R * sin(alpha) * sin(beta)) * drive.diff(t, 2))


def two_springs_without_free_length(s):
    (y,), p = s.q, s.p
    length = sm.sqrt(p["b"] ** 2 + y**2)
    return s.energies(V=p["k"] * (length**2 - (length - p["L_0"]) ** 2))


def centrifugal_force_in_v_as_well(s):
    (theta,), drive = s.q, s.inputs["drive"]
    return s.energies(V=-s.p["m"] * s.p["l"] ** 2 * sin(theta) ** 2 * drive.diff(t) ** 2)


def half_the_speed_of_the_collar(s):
    (theta,), p = s.q, s.p
    return s.energies(T=-sm.Rational(3, 2) * p["M_c"] * p["l"] ** 2 * sin(theta) ** 2 * theta.diff(t) ** 2)


def floor_at_rest_under_the_damper(s):
    y, base = s.q[0].diff(t), s.inputs["yb"].diff(t)
    return s.energies(D=s.p["c_1"] * (y**2 - (y - base) ** 2) / 2)


def instrument_relative_to_the_platform(s):
    a, b = (q.diff(t) for q in s.q)
    return s.energies(T=s.p["m_2"] * ((b - a) ** 2 - b**2) / 2)


def roll_relative_to_the_wedge(s):
    return s.row(s=-s.p["m"] * cos(s.p["beta"]) * s.q[0].diff(t, 2))


def roll_that_only_slides(s):
    return s.energies(T=-s.p["m"] * s.q[1].diff(t) ** 2 / 4)


def wind_on_the_trolley_only(s):
    return s.energies(Q={s.q[0]: s.inputs["F"] + s.inputs["W"]})


def rear_axle_in_front(s):
    system, b = s.system, s.p["b"]
    V, D = (e.subs(b, -b) for e in (system.potential_energy, system.dissipation))
    return s.energies(V=V - system.potential_energy, D=D - system.dissipation)


def weight_in_one_equation_left_out(s):
    (alpha, beta), p = s.q, s.p
    return s.row(alpha=p["m"] * p["g"] * p["l"] * sin(alpha) * cos(beta))


def wind_from_the_other_side_in_one_equation(s):
    return s.row(theta2=2 * s.p["L"] * s.inputs["F"] * cos(s.q[1]))


@pytest.mark.parametrize(
    ("key", "derive", "told"),
    [
        (
            "S08",
            hip_inertia_with_the_speed_of_g,
            [("theta2", "factor", "parallel-axis term m d² counted twice")],
        ),
        (
            "S08",
            hip_spring_to_the_ground,
            [
                ("theta1", "missing", "nothing with k_h is left"),
                ("theta2", "missing", "spring k_h is incomplete: the displacement theta1"),
            ],
        ),
        (
            "S08",
            hip_damper_to_the_ground,
            [
                ("theta1", "missing", "nothing with c_h is left"),
                ("theta1", "missing", "nothing with c_h is left"),
                ("theta2", "missing", "the rate theta1' of its other end"),
            ],
        ),
        (
            "S09",
            motor_without_its_work_on_the_shell,
            [("x", "missing", "tau stands in another equation only")],
        ),
        (
            "S09",
            pendulum_rate_in_the_wrong_sense,
            [("x", "sign", "the part with theta'"), ("theta", "sign", "the part with x'")],
        ),
        (
            "S09",
            angle_not_from_the_slope,
            [
                ("x", "changed", "cos(theta) stands where cos(beta - theta) belongs"),
                ("x", "changed", "sin(theta) stands where sin(beta - theta) belongs"),
                ("theta", "changed", "cos(theta) stands where cos(beta - theta) belongs"),
            ],
        ),
        ("S12", lift_arm_without_its_cosine, [("alpha", "changed", "a factor cos(alpha) is missing")] * 3),
        (
            "S15",
            spin_of_the_rotor_for_that_of_its_axes,
            [(q, "extra", "(C - A) stands where C belongs") for q in ("alpha", "beta")],
        ),
        ("W5", spin_of_the_top_for_that_of_its_axes, [("theta", "extra", "(C - A) stands where C belongs")]),
        (
            "S16",
            gyro_couple_on_the_ship_turned,
            [("phi", "sign", "its partner elsewhere has the other sign")],
        ),
        (
            "S17",
            steady_turning_taken_for_granted,
            [("alpha", "missing", "the Euler term α × r with drive''")],
        ),
        ("S02", two_springs_without_free_length, [("y", "missing", "the free length L_0 of the spring")]),
        (
            "S03",
            centrifugal_force_in_v_as_well,
            [("theta", "factor", "a centrifugal force in T and once more")],
        ),
        ("S03", half_the_speed_of_the_collar, [("theta", "factor", "half the speed, squared")] * 2),
        ("S10", floor_at_rest_under_the_damper, [("y1", "missing", "the rate yb' of its other end")]),
        (
            "S10",
            instrument_relative_to_the_platform,
            [
                ("y1", "extra", ""),
                ("y1", "extra", "y2'' has no place in this equation"),
                ("y2", "extra", "y1'' has no place in this equation"),
            ],
        ),
        (
            "W3",
            roll_relative_to_the_wedge,
            [("s", "missing", "a relative acceleration taken for the absolute")],
        ),
        ("W3", roll_that_only_slides, [("s", "factor", "the rotation of a rolling cylinder left out")]),
        ("S15", weight_in_one_equation_left_out, [("alpha", "missing", "")]),  # no reaction on a body
        ("S11", wind_from_the_other_side_in_one_equation, [("theta2", "sign", "")]),  # no length turned
        ("S07", wind_on_the_trolley_only, [("theta", "missing", "W stands in another equation only")]),
    ],
    ids=lambda value: getattr(value, "__name__", None),
)
def test_slips_on_the_systems_of_the_catalogue(key, derive, told):
    slip = Slip(key)
    proof = ed.prove_equal(derive(slip), slip.system.newton())
    assert proof.verdict == "refuted"
    assert [(d.coordinate, d.kind) for d in proof.differences] == [entry[:2] for entry in told], proof
    for difference, (*_, remark) in zip(proof.differences, told, strict=True):
        assert remark in difference.remark, difference
        assert bool(remark) == bool(difference.remark), difference


def test_a_length_counted_the_other_way():
    """Every term with an odd power of b turned, in the four rows of the half car that know b."""
    slip = Slip("S23")
    proof = ed.prove_equal(rear_axle_in_front(slip), slip.system.newton())
    assert proof.verdict == "refuted"
    assert len({d.coordinate for d in proof.differences}) >= 3
    assert {d.kind for d in proof.differences} == {"sign"}
    assert all("an odd power of b has its sign reversed" in d.remark for d in proof.differences), proof


def test_two_conventions_for_products_of_inertia():
    """A body with I_xz turned about the vertical and about its own x axis, with the product of the other sign."""
    u, w = dynamicsymbols("u w")
    J_x, J_y, J_z, I_xz = sm.symbols("J_x J_y J_z I_xz", positive=True)
    omega = sm.Matrix([w.diff(t), u.diff(t) * sin(w), u.diff(t) * cos(w)])

    def derived(product: sm.Expr) -> ed.EquationsOfMotion:
        tensor = sm.Matrix([[J_x, 0, product], [0, J_y, 0], [product, 0, J_z]])
        return ed.lagrange((omega.T * tensor * omega)[0] / 2, 0, [u, w])

    proof = ed.prove_equal(derived(-I_xz), derived(I_xz))
    assert [d.kind for d in proof.differences] == ["sign"] * 3
    assert all("two conventions for products of inertia" in d.remark for d in proof.differences), proof


# No remark where the form of the term does not call for it


def system_rows(key: str) -> tuple[list[sm.Expr], list[sm.Expr]]:
    system = ed.systems.load(key)
    return [sm.expand(row) for row in residuals(system.lagrange())], [c.symbol for c in system.coordinates]


def order(term: sm.Expr) -> tuple[int, int]:
    """Accelerations and rates in a term."""
    found = [0, 0]
    for factor in sm.Mul.make_args(term):
        base, power = factor.as_base_exp()
        if base.is_Derivative:
            found[2 - base.variable_count[0][1]] += int(power)
    return found[0], found[1]


@pytest.mark.parametrize("key", ["S03", "S07", "S23", "W7"])
def test_remarks_keep_to_the_form_of_the_term(key):
    """Every term of every equation left out, turned, doubled, halved, tripled: no word of another mistake."""
    rows, q = system_rows(key)
    right = by_hand(rows, q)
    for number, row in enumerate(rows):
        for term in sm.Add.make_args(row):
            for factor in (0, -1, 2, HALF, 3):
                wrong = list(rows)
                wrong[number] += (sm.Rational(*Fraction(factor).as_integer_ratio()) - 1) * term
                if factor == 0 and order(term)[0] and _alone(term, rows):
                    continue  # its coordinate has no other inertia: no equations of motion would be left
                for found in ed.prove_equal(by_hand(wrong, q), right).differences:
                    assert found.equation == number + 1
                    assert_fits(found, order(term))


def _alone(term: sm.Expr, rows: list[sm.Expr]) -> bool:
    (acceleration,) = (d for d in term.atoms(sm.Derivative) if d.variable_count[0][1] == 2)
    return sum(other.has(acceleration) for row in rows for other in sm.Add.make_args(row)) == 1


def assert_fits(found, motion: tuple[int, int]) -> None:
    said = found.remark
    assert ("Coriolis" in said) <= (motion == (0, 2))
    assert ("centripetal" in said) <= (motion == (0, 2))
    assert ("damper" in said or "Rayleigh" in said) <= (motion == (0, 1))
    assert ("base acceleration" in said or "parallel-axis" in said) <= (motion == (1, 0))
    assert ("gravity" in said) <= (
        motion == (0, 0) and sm.Symbol("g") in {sm.Symbol(s.name) for s in found.term.free_symbols}
    )
    assert "free length" not in said
    assert "friction" not in said
    assert "potential in your equations" not in said
    assert "degrees" not in said
    if found.factor == 3:
        assert said == ""


def test_a_table_for_students():
    """Equation, your term, what it should be, remark: as HTML with mathematics."""
    case = coriolis_without_two()
    html = ed.prove_equal(case.student, case.right)._repr_html_()
    for heading in ("equation", "your term", "should be", "remark"):
        assert f">{heading}</th>" in html
    assert "refuted" in html
    assert r"\dot{s}" in html
    assert "lost its factor 2" in html
    assert html.count("<tr>") == 2
    missing = moment_about_the_accelerating_hinge()
    assert ">missing</td>" in ed.prove_equal(missing.student, missing.right)._repr_html_()
    assert "proved" in ed.prove_equal(missing.right, missing.right)._repr_html_()
    assert "<table" not in ed.prove_equal(missing.right, missing.right)._repr_html_()
