"""Machines in steady motion, a nonholonomic one among them; definitions of the catalogue."""

from __future__ import annotations

from math import pi

import sympy as sm
from sympy.physics.mechanics import dynamicsymbols

from analysis.oracle import Case, coordinates, symbols


def turntable() -> Case:
    """S06, steady motion at the reference rate, held by the motor."""
    theta, s = coordinates("theta s")
    J, m, e, k, s_0, c_s, c_t = symbols("J m e k s_0 c_s c_t")
    M, F = dynamicsymbols("M F")
    kinetic = (
        J * theta.diff() ** 2 / 2 + m * ((s.diff() - e * theta.diff()) ** 2 + (s * theta.diff()) ** 2) / 2
    )
    damping = c_t * theta.diff() ** 2 / 2 + c_s * s.diff() ** 2 / 2
    numbers = {"J": 0.8, "m": 2.0, "e": 0.05, "k": 1500.0, "s_0": 0.25, "c_s": 8.0, "c_t": 0.05}
    potential = k * (s - s_0) ** 2 / 2
    region = {"s": (0.0, 1.0)}
    return Case("S06 turntable", [theta, s], kinetic, potential, numbers, region, damping, {theta: M, s: F})


def drum_robot() -> Case:
    """S09, on a slope."""
    x, theta = coordinates("x theta")
    M_d, R, J_d, m, l, J_p, beta, c_a, g = symbols("M_d R J_d m l J_p beta c_a g")
    tau = dynamicsymbols("tau")
    v, w = x.diff(), theta.diff()
    across = v * sm.cos(beta) + l * sm.cos(theta) * w
    upward = v * sm.sin(beta) + l * sm.sin(theta) * w
    kinetic = (M_d + J_d / R**2) * v**2 / 2 + m * (across**2 + upward**2) / 2 + J_p * w**2 / 2
    potential = (M_d + m) * g * x * sm.sin(beta) - m * g * l * sm.cos(theta)
    numbers = {
        "M_d": 6.0,
        "R": 0.2,
        "J_d": 0.2,
        "m": 8.0,
        "l": 0.12,
        "J_p": 0.05,
        "beta": 0.05,
        "c_a": 0.06,
        "g": 9.81,
    }
    damping = c_a * (w + v / R) ** 2 / 2
    return Case("S09 drum", [x, theta], kinetic, potential, numbers, {}, damping, {x: tau / R, theta: tau})


def castor() -> Case:
    """S13, rolling without side slip."""
    y, psi = coordinates("y psi")
    m_p, m, J_G, a, b, k_y, c_y, k_p, c_p, v = symbols("m_p m J_G a b k_y c_y k_p c_p v")
    F, M = dynamicsymbols("F M")
    w = psi.diff()
    kinetic = m_p * (v**2 + y.diff() ** 2) / 2 + J_G * w**2 / 2
    kinetic += m * ((v + b * sm.sin(psi) * w) ** 2 + (y.diff() - b * sm.cos(psi) * w) ** 2) / 2
    potential = k_y * y**2 / 2 + k_p * psi**2 / 2
    damping = c_y * y.diff() ** 2 / 2 + c_p * w**2 / 2
    numbers = {"m_p": 3.0, "m": 8.0, "J_G": 0.12, "a": 0.1, "b": 0.07, "k_y": 6e4, "c_y": 150.0, "k_p": 0.0}
    numbers |= {"c_p": 2.0, "v": 2.0}
    rolling = y.diff() * sm.cos(psi) - v * sm.sin(psi) - a * w
    region = {"y": (-0.05, 0.05), "psi": (-pi / 2, pi / 2)}
    forces = {y: F, psi: M}
    return Case("S13 castor", [y, psi], kinetic, potential, numbers, region, damping, forces, [rolling])


def car_and_trailer() -> Case:
    """S18, straight running."""
    y, psi, theta = coordinates("y psi theta")
    m_1, J_1, a, b, h, m_2, J_2, e, d = symbols("m_1 J_1 a b h m_2 J_2 e d")
    C_1, C_2, C_3, c_h, v = symbols("C_1 C_2 C_3 c_h v")
    delta, F_w = dynamicsymbols("delta F_w")
    sp, cp, st, ct = sm.sin(psi), sm.cos(psi), sm.sin(theta), sm.cos(theta)
    y_d, psi_d, theta_d = y.diff(), psi.diff(), theta.diff()
    across, along = y_d * cp - v * sp, v * cp + y_d * sp
    front = -C_1 * (sm.atan((across + a * psi_d) / along) - delta)
    rear = -C_2 * sm.atan((across - b * psi_d) / along)
    side = y_d * ct - v * st - h * sm.cos(psi - theta) * psi_d - d * theta_d
    axle = -C_3 * sm.atan(side / (v * ct + y_d * st + h * sm.sin(psi - theta) * psi_d))
    kinetic = m_1 * (v**2 + y_d**2) / 2 + J_1 * psi_d**2 / 2 + J_2 * theta_d**2 / 2
    kinetic += m_2 * (v + h * sp * psi_d + e * st * theta_d) ** 2 / 2
    kinetic += m_2 * (y_d - h * cp * psi_d - e * ct * theta_d) ** 2 / 2
    forces = {
        y: (front + rear) * cp + axle * ct + F_w,
        psi: a * front - b * rear - h * axle * sm.cos(psi - theta) - h * F_w * cp,
        theta: -d * axle - e * F_w * ct,
    }
    numbers = {
        "m_1": 1500.0,
        "J_1": 2500.0,
        "a": 1.2,
        "b": 1.4,
        "h": 2.3,
        "m_2": 1000.0,
        "J_2": 1800.0,
        "e": 2.9,
    }
    numbers |= {"d": 3.0, "C_1": 8e4, "C_2": 9e4, "C_3": 6e4, "c_h": 200.0, "v": 22.0}
    damping = c_h * (theta_d - psi_d) ** 2 / 2
    return Case("S18 car and trailer", [y, psi, theta], kinetic, sm.S.Zero, numbers, {}, damping, forces)


def drive_train() -> Case:
    """S20, wind turbine with a gear stage."""
    tr, tb, tg = coordinates("tr tb tg")
    J_r, J_1, J_2, J_g, N, K_s, C_s, K_h, C_h, B, w_0 = symbols("J_r J_1 J_2 J_g N K_s C_s K_h C_h B w_0")
    rho, R, v, q_0, q_1, q_2 = symbols("rho R v q_0 q_1 q_2")
    T_w, T_e = dynamicsymbols("T_w T_e")
    a, b, c = tr.diff(), tb.diff(), tg.diff()
    speed_ratio = a * R / v
    wind = rho * sm.pi * R**3 * v**2 / 2 * (q_0 + q_1 * speed_ratio + q_2 * speed_ratio**2)
    kinetic = J_r * a**2 / 2 + (J_2 + J_1 / N**2) * b**2 / 2 + J_g * c**2 / 2
    potential = K_s * (tr - tb / N) ** 2 / 2 + K_h * (tb - tg) ** 2 / 2
    damping = C_s * (a - b / N) ** 2 / 2 + C_h * (b - c) ** 2 / 2
    numbers = {
        "J_r": 2.9e6,
        "J_1": 500.0,
        "J_2": 3.0,
        "J_g": 60.0,
        "N": 80.0,
        "K_s": 1e8,
        "C_s": 4e5,
        "K_h": 2e5,
    }
    numbers |= {"C_h": 20.0, "B": 3000.0, "w_0": 157.08, "rho": 1.225, "R": 35.0, "v": 11.0}
    numbers |= {"q_0": -0.03, "q_1": 0.0425, "q_2": -0.0042}
    forces = {tr: wind + T_w, tg: -B * (c - w_0) + T_e}
    region = {"tr_d": (-5.0, 10.0)}
    return Case("S20 drive train", [tr, tb, tg], kinetic, potential, numbers, region, damping, forces)
