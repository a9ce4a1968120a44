"""Small systems for the tests of the analyses; numbered ones are defined as in the catalogue."""

from __future__ import annotations

from math import pi

import sympy as sm
from sympy.physics.mechanics import dynamicsymbols

from analysis.machines import car_and_trailer, castor, drive_train, drum_robot, turntable
from analysis.oracle import Case, T, coordinates, distinct, of_catalogue, symbols

__all__ = [
    "T",
    "bar_on_slider",
    "car_and_trailer",
    "carousel",
    "castor",
    "coordinates",
    "distinct",
    "drive_train",
    "drum_robot",
    "elastic_pendulum",
    "follower_mast",
    "hoop",
    "isolator",
    "normal_form",
    "of_catalogue",
    "pendulum",
    "seismometer",
    "ship",
    "snap_through",
    "sprung_double_pendulum",
    "symbols",
    "turntable",
    "two_wells",
    "windy_pendulum",
]


def pendulum() -> Case:
    (theta,) = coordinates("theta")
    m, l, g, c = symbols("m l g c")
    kinetic = m * l**2 * theta.diff() ** 2 / 2
    numbers = {"m": 1.3, "l": 0.8, "g": 9.81, "c": 0.2}
    return Case(
        "W10 pendulum", [theta], kinetic, -m * g * l * sm.cos(theta), numbers, {}, c * theta.diff() ** 2 / 2
    )


def windy_pendulum() -> Case:
    (theta,) = coordinates("theta")
    m, l, g, c, W = symbols("m l g c W")
    potential = -m * g * l * sm.cos(theta) - W * l * sm.sin(theta)
    numbers = {"m": 1.3, "l": 0.8, "g": 9.81, "c": 0.2, "W": 7.0}
    kinetic = m * l**2 * theta.diff() ** 2 / 2
    return Case("pendulum in the wind", [theta], kinetic, potential, numbers, {}, c * theta.diff() ** 2 / 2)


def hoop() -> Case:
    """A bead on a hoop that turns about its vertical diameter."""
    (theta,) = coordinates("theta")
    m, R, g, c, Omega = symbols("m R g c Omega")
    kinetic = m * R**2 * (theta.diff() ** 2 + Omega**2 * sm.sin(theta) ** 2) / 2
    numbers = {"m": 0.4, "R": 0.3, "g": 9.81, "c": 0.05, "Omega": 8.0}
    return Case(
        "bead on a hoop", [theta], kinetic, -m * g * R * sm.cos(theta), numbers, {}, c * theta.diff() ** 2 / 2
    )


def snap_through() -> Case:
    (y,) = coordinates("y")
    m, b, L_0, k, c, g, P = symbols("m b L_0 k c g P")
    potential = k * (sm.sqrt(b**2 + y**2) - L_0) ** 2 + m * g * y - P * y
    numbers = {"m": 0.05, "b": 0.03, "L_0": 0.0325, "k": 4000.0, "c": 0.8, "g": 9.81, "P": 0.0}
    kinetic = m * y.diff() ** 2 / 2
    return Case(
        "S02 snap-through", [y], kinetic, potential, numbers, {"y": (-0.05, 0.05)}, c * y.diff() ** 2 / 2
    )


def seismometer() -> Case:
    (theta,) = coordinates("theta")
    m, l, J_G, k_f, c_e, g = symbols("m l J_G k_f c_e g")
    xb, M_c = dynamicsymbols("xb M_c")
    kinetic = (
        m
        * ((xb.diff() - l * sm.cos(theta) * theta.diff()) ** 2 + (l * sm.sin(theta) * theta.diff()) ** 2)
        / 2
    )
    kinetic += J_G * theta.diff() ** 2 / 2
    potential = m * g * l * sm.cos(theta) + k_f * theta**2 / 2
    numbers = {"m": 0.5, "l": 0.2, "J_G": 0.002, "k_f": 0.9, "c_e": 0.05, "g": 9.81}
    damping = c_e * theta.diff() ** 2 / 2
    return Case(
        "S04 seismometer", [theta], kinetic, potential, numbers, {"theta": (-pi, pi)}, damping, {theta: M_c}
    )


def bar_on_slider() -> Case:
    s, theta = coordinates("s theta")
    m, m_s, l, gamma, k, c, c_h, g = symbols("m m_s l gamma k c c_h g")
    v_x = s.diff() * sm.cos(gamma) + l / 2 * sm.cos(theta) * theta.diff()
    v_y = s.diff() * sm.sin(gamma) + l / 2 * sm.sin(theta) * theta.diff()
    kinetic = m_s * s.diff() ** 2 / 2 + m * (v_x**2 + v_y**2) / 2 + m * l**2 / 12 * theta.diff() ** 2 / 2
    potential = k * s**2 / 2 + (m + m_s) * g * s * sm.sin(gamma) - m * g * l / 2 * sm.cos(theta)
    numbers = {"m": 3.0, "m_s": 1.0, "l": 0.6, "gamma": pi / 6, "k": 400.0, "c": 4.0, "c_h": 0.15, "g": 9.81}
    damping = c * s.diff() ** 2 / 2 + c_h * theta.diff() ** 2 / 2
    return Case("W7 bar on slider", [s, theta], kinetic, potential, numbers, {"s": (-1.0, 1.0)}, damping)


def two_wells() -> Case:
    x, y = coordinates("x y")
    a, b = symbols("a b")
    potential = (x**2 - 1) ** 2 / 4 + b * (y**2 - 1) ** 2 / 4 + a * x * y
    region = {"x": (-2.0, 2.0), "y": (-2.0, 2.0)}
    kinetic = (x.diff() ** 2 + y.diff() ** 2) / 2
    damping = (x.diff() ** 2 + y.diff() ** 2) / 20
    return Case("two wells", [x, y], kinetic, potential, {"a": 0.1, "b": 1.0}, region, damping)


def elastic_pendulum() -> Case:
    r, theta = coordinates("r theta")
    m, k, L_0, g, W = symbols("m k L_0 g W")
    kinetic = m * (r.diff() ** 2 + (r * theta.diff()) ** 2) / 2
    potential = k * (r - L_0) ** 2 / 2 - m * g * r * sm.cos(theta) - W * r * sm.sin(theta)
    numbers = {"m": 1.1, "k": 90.0, "L_0": 0.5, "g": 9.81, "W": 3.0}
    damping = (r.diff() ** 2 + theta.diff() ** 2) / 10
    return Case("elastic pendulum", [r, theta], kinetic, potential, numbers, {"r": (0.1, 2.0)}, damping)


def sprung_double_pendulum() -> Case:
    theta1, theta2 = coordinates("theta1 theta2")
    m_1, m_2, L, k_1, k_2, g = symbols("m_1 m_2 L k_1 k_2 g")
    w_1, w_2 = theta1.diff(), theta2.diff()
    kinetic = (m_1 + m_2) * L**2 * w_1**2 / 2 + m_2 * L**2 * (
        w_2**2 / 2 + sm.cos(theta1 - theta2) * w_1 * w_2
    )
    potential = (m_1 + m_2) * g * L * sm.cos(theta1) + m_2 * g * L * sm.cos(theta2)
    potential += k_1 * theta1**2 / 2 + k_2 * (theta2 - theta1) ** 2 / 2
    numbers = {"m_1": 1.0, "m_2": 1.5, "L": 0.5, "k_1": 6.0, "k_2": 4.0, "g": 9.81}
    region = {"theta1": (-3.0, 3.0), "theta2": (-3.5, 3.5)}
    damping = (w_1**2 + (w_2 - w_1) ** 2) / 10
    return Case("inverted double pendulum", [theta1, theta2], kinetic, potential, numbers, region, damping)


def isolator() -> Case:
    y1, y2 = coordinates("y1 y2")
    m_1, m_2, k_1, k_2, k_3, c_1, c_2, g = symbols("m_1 m_2 k_1 k_2 k_3 c_1 c_2 g")
    yb, F = dynamicsymbols("yb F")
    kinetic = (m_1 * y1.diff() ** 2 + m_2 * y2.diff() ** 2) / 2
    potential = k_1 * (y1 - yb) ** 2 / 2 + k_2 * (y2 - y1) ** 2 / 2 + k_3 * (y2 - y1) ** 4 / 4
    potential += (m_1 * y1 + m_2 * y2) * g
    damping = c_1 * (y1.diff() - yb.diff()) ** 2 / 2 + c_2 * (y2.diff() - y1.diff()) ** 2 / 2
    numbers = {
        "m_1": 150.0,
        "m_2": 400.0,
        "k_1": 6e5,
        "k_2": 3e5,
        "k_3": 3e8,
        "c_1": 3e3,
        "c_2": 500.0,
        "g": 9.81,
    }
    region = {"y1": (-0.1, 0.1), "y2": (-0.1, 0.1)}
    return Case("S10 isolator", [y1, y2], kinetic, potential, numbers, region, damping, {y2: F})


def follower_mast() -> Case:
    theta1, theta2 = coordinates("theta1 theta2")
    m_1, m_2, L, k_1, k_2, c_1, c_2, P = symbols("m_1 m_2 L k_1 k_2 c_1 c_2 P")
    F = dynamicsymbols("F")
    w_1, w_2 = theta1.diff(), theta2.diff()
    kinetic = (m_1 + m_2) * L**2 * w_1**2 / 2 + m_2 * L**2 * (
        w_2**2 / 2 + sm.cos(theta1 - theta2) * w_1 * w_2
    )
    potential = k_1 * theta1**2 / 2 + k_2 * (theta2 - theta1) ** 2 / 2
    damping = c_1 * w_1**2 / 2 + c_2 * (w_2 - w_1) ** 2 / 2
    forces = {
        theta1: P * L * sm.sin(theta1 - theta2) + F * L * sm.cos(theta1),
        theta2: F * L * sm.cos(theta2),
    }
    numbers = {"m_1": 2.0, "m_2": 1.0, "L": 0.5, "k_1": 20.0, "k_2": 20.0, "c_1": 0.1, "c_2": 0.1, "P": 50.0}
    region = {"theta1": (-pi / 2, pi / 2), "theta2": (-pi / 2, pi / 2)}
    return Case("S11 mast", [theta1, theta2], kinetic, potential, numbers, region, damping, forces)


def carousel() -> Case:
    """S17, the arm at constant rate."""
    alpha, beta = coordinates("alpha beta")
    m, R, L, Omega, c, g = symbols("m R L Omega c g")
    ca, sa, cb, sb = sm.cos(alpha), sm.sin(alpha), sm.cos(beta), sm.sin(beta)
    a, b = alpha.diff(), beta.diff()
    kinetic = m * ((L * ca * a - Omega * L * ca * sb) ** 2 + (L * (sa * cb * a + ca * sb * b)) ** 2) / 2
    kinetic += m * (L * (ca * cb * b - sa * sb * a) + Omega * (R + L * sa)) ** 2 / 2
    damping = c * L**2 * (a**2 + ca**2 * b**2) / 2
    numbers = {"m": 90.0, "R": 5.0, "L": 4.0, "Omega": 1.1, "c": 12.0, "g": 9.81}
    region = {"alpha": (-pi / 2, pi / 2), "beta": (-pi, pi)}
    return Case("S17 carousel", [alpha, beta], kinetic, -m * g * L * ca * cb, numbers, region, damping)


def ship() -> Case:
    """S16, ship roll with a gyro stabilizer."""
    phi, theta = coordinates("phi theta")
    I_s, W, GM, m_g, h, A_x, A_y, C_g, C_r, w_s, c_r, c_t, g = symbols(
        "I_s W GM m_g h A_x A_y C_g C_r w_s c_r c_t g"
    )
    roll, tilt = phi.diff(), theta.diff()
    kinetic = I_s * roll**2 / 2 + A_x * (roll * sm.cos(theta)) ** 2 / 2 + A_y * tilt**2 / 2
    kinetic += C_g * (roll * sm.sin(theta)) ** 2 / 2 + C_r * (w_s + roll * sm.sin(theta)) ** 2 / 2
    potential = -W * GM * sm.cos(phi) - m_g * g * h * sm.cos(phi) * sm.cos(theta)
    numbers = {
        "I_s": 4e5,
        "W": 882900.0,
        "GM": 0.8,
        "m_g": 800.0,
        "h": 0.1,
        "A_x": 85.0,
        "A_y": 80.0,
        "C_g": 25.0,
    }
    numbers |= {"C_r": 60.0, "w_s": 550.0, "c_r": 25000.0, "c_t": 5000.0, "g": 9.81}
    damping = c_r * roll**2 / 2 + c_t * tilt**2 / 2
    region = {"phi": (-pi, pi), "theta": (-pi, pi)}
    return Case("S16 ship", [phi, theta], kinetic, potential, numbers, region, damping)


def normal_form(potential: sm.Expr, name: str, **values: float) -> Case:
    """A particle on a line, ẍ + ẋ/10 + dV/dx = 0."""
    (x,) = coordinates("x")
    return Case(name, [x], x.diff() ** 2 / 2, potential, dict(values), {"x": (-2.0, 2.0)}, x.diff() ** 2 / 20)
