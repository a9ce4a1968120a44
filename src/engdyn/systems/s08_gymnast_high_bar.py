"""S08 Gymnast on the high bar: two segments with a stiff hip."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from math import cos, pi, sin
from typing import Any

import sympy as sm
from sympy.physics.mechanics import (
    Force,
    Point,
    ReferenceFrame,
    RigidBody,
    Torque,
    dynamicsymbols,
    inertia,
)

from engdyn import shapes as sh
from engdyn.modeling.newton import FreeBody
from engdyn.quantities import Coordinate, Input, Parameter
from engdyn.system import System

PARAMETERS = (
    Parameter("m_1", "kg", 42.0, "mass of trunk and arms"),
    Parameter("L_1", "m", 1.3, "bar to hip"),
    Parameter("a_1", "m", 0.75, "bar to mass center of segment 1"),
    Parameter("J_1", "kg m^2", 5.0, "inertia of segment 1 about its mass center"),
    Parameter("m_2", "kg", 23.0, "mass of the legs"),
    Parameter("a_2", "m", 0.4, "hip to mass center of the legs"),
    Parameter("J_2", "kg m^2", 1.6, "inertia of the legs about their mass center"),
    Parameter("k_h", "N m/rad", 60.0, "hip stiffness", "nonnegative"),
    Parameter("c_b", "N m s/rad", 4.0, "grip damping", "nonnegative"),
    Parameter("c_h", "N m s/rad", 6.0, "hip damping", "nonnegative"),
    Parameter("g", "m/s^2", 9.81, "gravity", "any"),
)
m_1, L_1, a_1, J_1, m_2, a_2, J_2, k_h, c_b, c_h, g = (p.symbol for p in PARAMETERS)

theta1, theta2, M_h = dynamicsymbols("theta1 theta2 M_h")
theta1_d, theta2_d = dynamicsymbols("theta1 theta2", 1)
B_x, B_y, H_x, H_y = sm.symbols("B_x B_y H_x H_y")

ground = ReferenceFrame("N")  # X right, Y up
trunk_axes = ReferenceFrame("A")  # -Y from the bar to the hip
trunk_axes.orient_axis(ground, theta1, ground.z)
leg_axes = ReferenceFrame("B")  # -Y from the hip to the feet
leg_axes.orient_axis(ground, theta2, ground.z)


def free_bodies() -> list[FreeBody]:
    """Trunk with arms and legs, cut at the bar and at the hip."""
    bar = Point("O")
    bar.set_vel(ground, 0)
    center_1 = bar.locatenew("G_1", -a_1 * trunk_axes.y)
    hip = bar.locatenew("H", -L_1 * trunk_axes.y)
    center_2 = hip.locatenew("G_2", -a_2 * leg_axes.y)
    hip_force = H_x * ground.x + H_y * ground.y  # of the trunk on the legs
    spring = -k_h * (theta2 - theta1) * ground.z  # these three on the legs
    damper = -c_h * (theta2_d - theta1_d) * ground.z
    muscle = M_h * ground.z

    trunk = FreeBody(
        RigidBody("trunk and arms", center_1, trunk_axes, m_1, (inertia(trunk_axes, 0, 0, J_1), center_1)),
        applied=[
            Force(center_1, -m_1 * g * ground.y),
            Torque(trunk_axes, -c_b * theta1_d * ground.z),
            Torque(trunk_axes, -spring),
            Torque(trunk_axes, -damper),
            Torque(trunk_axes, -muscle),
        ],
        reactions=[Force(bar, B_x * ground.x + B_y * ground.y), Force(hip, -hip_force)],
    )
    legs = FreeBody(
        RigidBody("legs", center_2, leg_axes, m_2, (inertia(leg_axes, 0, 0, J_2), center_2)),
        applied=[
            Force(center_2, -m_2 * g * ground.y),
            Torque(leg_axes, spring),
            Torque(leg_axes, damper),
            Torque(leg_axes, muscle),
        ],
        reactions=[Force(hip, hip_force)],
    )
    return [trunk, legs]


def shapes(q: list[float], values: dict[str, float]) -> list:
    """Side view, the bar at the origin; the widths of the body are fractions of L_1."""
    theta1, theta2 = q
    L, a_2 = values["L_1"], values["a_2"]
    bar = (0.0, 0.0)
    trunk = partial(_along, bar, theta1)
    hip, G_1 = trunk(L), trunk(values["a_1"])
    legs = partial(_along, hip, theta2)
    down_1, down_2 = theta1 - pi / 2, theta2 - pi / 2
    side = L if theta1 >= 0.0 else -L
    bend = L if theta2 >= theta1 else -L  # the couples stand where the hip opens
    aside = 0.85 * bend / L
    return [
        sh.CenterLine(bar, (0.0, -0.6 * L)),
        sh.CenterLine(hip, (hip[0], hip[1] - 0.7 * L)),
        sh.CenterLine(hip, trunk(1.5 * L)),
        *_body(trunk, legs, L, a_2),
        sh.CenterOfMass(G_1, "$G_1$"),
        sh.CenterOfMass(legs(a_2), "$G_2$"),
        sh.Label(trunk(0.75 * L, -0.08 * side), "$m_1,\\ J_1$", (-side, 0.0)),
        sh.TorsionalDamper(hip, 0.38 * L, down_1, down_2, "$c_h$"),
        sh.Label(legs(1.6 * a_2, 0.05 * bend), "$m_2,\\ J_2$", (bend, 0.3 * L)),
        sh.TorsionalDamper(bar, 0.24 * L, -pi / 2, down_1, "$c_b$"),
        sh.TorsionalSpring(hip, 0.065 * L, down_1, down_2),
        sh.Label(trunk(0.98 * L, 0.09 * bend), "$k_h$", (bend, 0.0)),
        sh.AngleArrow(bar, 0.5 * L, -pi / 2, down_1, r"$\theta_1$"),
        sh.AngleArrow(hip, 0.62 * L, -pi / 2, down_2, r"$\theta_2$"),
        sh.MomentArrow(hip, 0.22 * L, down_1 + pi + aside + 0.45, down_1 + pi + aside - 0.45, "$M_h$"),
        sh.MomentArrow(hip, 0.22 * L, down_2 - aside - 0.45, down_2 - aside + 0.45, "$M_h$"),
        sh.Dimension(bar, hip, "$L_1$", offset=0.48 * side),
        sh.Dimension(bar, G_1, "$a_1$", offset=0.28 * side),
        sh.Dimension(hip, legs(a_2), "$a_2$", offset=0.24 * bend),
        sh.Support(bar, "$O$", angle=pi / 2),
        sh.Pin(hip),
        sh.GravityArrow((1.05 * side, 0.0), (1.05 * side, -0.25 * L), "$g$"),
    ]


def _along(start: tuple[float, float], angle: float, down: float, across: float = 0.0) -> tuple[float, float]:
    """Point of a segment that hangs from ``start`` at an angle from the vertical."""
    x, y = down * sin(angle) + across * cos(angle), -down * cos(angle) + across * sin(angle)
    return (start[0] + x, start[1] + y)


def _body(trunk: Callable, legs: Callable, L: float, a_2: float) -> list:
    """Outlines of arms and trunk, of the legs, and the head."""
    upper = [(0.0, 0.022), (0.4, 0.035), (0.44, 0.1), (0.85, 0.07), (1.0, 0.085), (1.05, 0.03)]
    lower = [(-0.07 * L, 0.03 * L), (0.0, 0.08 * L), (2.0 * a_2, 0.03 * L)]
    upper = [(L * x, L * y) for x, y in upper]
    outlines = [
        [segment(x, y) for x, y in half] + [segment(x, -y) for x, y in reversed(half)]
        for segment, half in ((legs, lower), (trunk, upper))
    ]
    return [*map(sh.Polygon, outlines), sh.Disc(trunk(0.32 * L), 0.085 * L)]


def region(q: Sequence[float], values: Mapping[str, float]) -> bool:
    """A turn of the trunk without its lower end, and at most half a turn in the hip."""
    return q[0] > -pi + 1e-9 and abs(q[1] - q[0]) < pi + 1e-9


def _energies() -> dict[str, Any]:
    """Energies, dissipation and generalized forces."""
    between = 2 * L_1 * a_2 * sm.cos(theta1 - theta2) * theta1_d * theta2_d
    return {
        "kinetic_energy": (
            (J_1 + m_1 * a_1**2) * theta1_d**2 / 2
            + J_2 * theta2_d**2 / 2
            + m_2 * (L_1**2 * theta1_d**2 + a_2**2 * theta2_d**2 + between) / 2
        ),
        "potential_energy": (
            -m_1 * g * a_1 * sm.cos(theta1)
            - m_2 * g * (L_1 * sm.cos(theta1) + a_2 * sm.cos(theta2))
            + k_h * (theta2 - theta1) ** 2 / 2
        ),
        "dissipation": c_b * theta1_d**2 / 2 + c_h * (theta2_d - theta1_d) ** 2 / 2,
        "generalized_forces": {theta1: -M_h, theta2: M_h},
    }


def build() -> System:
    """The gymnast as a System."""
    return System(
        number=8,
        key="gymnast_high_bar",
        title="Gymnast on the high bar (two segments with hip stiffness)",
        field="sport, biomechanics",
        description=(
            "Two rigid segments in a vertical plane stand for the body of a gymnast. Segment 1, arms and "
            "trunk (mass m_1, inertia J_1), hangs from the fixed bar O; the hip is at the distance L_1 from "
            "O, the mass center at a_1. Segment 2, the legs (m_2, J_2), is hinged at the hip; its mass "
            "center is at a_2 from there. Inertias are about the mass centers. theta1 and theta2 are the "
            "absolute angles of the segments from the downward vertical, counter-clockwise. A torsional "
            "spring k_h, relaxed when the body is straight, and damping c_h act at the hip, c_b damps the "
            "grip. The muscle torque M_h acts counter-clockwise on the legs and clockwise on the trunk. "
            "Gravity acts down."
        ),
        measured="angles by motion capture and the force on the bar: record of giant swings",
        coordinates=(
            Coordinate(
                theta1, "rad", "trunk angle from the downward vertical, counter-clockwise", (-pi, pi), "angle"
            ),
            Coordinate(
                theta2,
                "rad",
                "leg angle from the downward vertical, counter-clockwise",
                (-2 * pi, 2 * pi),
                "angle",
            ),
        ),
        parameters=PARAMETERS,
        inputs=(Input(M_h, "N m", "hip torque, counter-clockwise on the legs", "couple"),),
        **_energies(),
        frame=ground,
        free_bodies=free_bodies,
        unknowns=(B_x, B_y, H_x, H_y),
        region=region,
        shapes=shapes,
        pose=(0.35, 0.8),
    )
