"""W1 Collar in a slotted arm that turns in a vertical plane: the worked example of chapters 1 and 2."""

from __future__ import annotations

from math import cos, pi, sin

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

from engdyn import shapes as sh
from engdyn.modeling.newton import FreeBody
from engdyn.quantities import Coordinate, Input, Parameter
from engdyn.system import System

PARAMETERS = (
    Parameter("m", "kg", 0.5, "collar mass"),
    Parameter("m_a", "kg", 1.2, "arm mass"),
    Parameter("a", "m", 0.25, "pivot to the mass center of the arm"),
    Parameter("J_O", "kg m^2", 0.1, "moment of inertia of the arm about the pivot"),
    Parameter("k", "N/m", 60.0, "spring between pivot and collar", "nonnegative"),
    Parameter("l_0", "m", 0.25, "free length of the spring"),
    Parameter("c", "N s/m", 0.8, "damping between collar and slot", "nonnegative"),
    Parameter("g", "m/s^2", 9.81, "gravity", "any"),
)
m, m_a, a, J_O, k, l_0, c, g = (p.symbol for p in PARAMETERS)

theta, r, M = dynamicsymbols("theta r M")
theta_d, r_d = dynamicsymbols("theta r", 1)
N_c, O_x, O_y = sm.symbols("N_c O_x O_y")

ground = ReferenceFrame("N")  # X right, Y up
arm_axes = ReferenceFrame("A")  # X along the arm, away from the pivot
arm_axes.orient_axis(ground, theta, ground.z)


def free_bodies() -> list[FreeBody]:
    """Collar and arm, cut at the slot and at the pivot; spring and damper pull at both."""
    pivot = Point("O")
    pivot.set_vel(ground, 0)
    collar_point = pivot.locatenew("P", r * arm_axes.x)
    center = pivot.locatenew("G", a * arm_axes.x)
    spring = -k * (r - l_0) * arm_axes.x  # on the collar
    drag = -c * r_d * arm_axes.x
    normal = N_c * arm_axes.y  # of the slot on the collar
    collar = FreeBody(
        Particle("collar", collar_point, m),
        applied=[
            Force(collar_point, spring),
            Force(collar_point, drag),
            Force(collar_point, -m * g * ground.y),
        ],
        reactions=[Force(collar_point, normal)],
    )
    arm = FreeBody(
        RigidBody("arm", center, arm_axes, m_a, (inertia(arm_axes, 0, 0, J_O), pivot)),
        applied=[
            Force(center, -m_a * g * ground.y),
            Force(pivot, -spring),
            Force(collar_point, -drag),
            Torque(arm_axes, M * ground.z),
        ],
        reactions=[Force(collar_point, -normal), Force(pivot, O_x * ground.x + O_y * ground.y)],
    )
    return [collar, arm]


def shapes(q: list[float], values: dict[str, float]) -> list:
    """Side view with the pivot at the origin; the arm is drawn twice as long as the way to its mass center."""
    angle, distance, a = q[0], q[1], values["a"]
    length, width = max(2.0 * a, 1.2 * distance), 0.2 * a
    along, across = (cos(angle), sin(angle)), (-sin(angle), cos(angle))

    def on_arm(x: float, y: float = 0.0) -> tuple[float, float]:
        return (x * along[0] + y * across[0], x * along[1] + y * across[1])

    slot = (0.16 * length, 0.93 * length)
    middle, half = 0.5 * (slot[0] + slot[1]), 0.55 * width
    rails = [
        sh.Box(on_arm(middle, side * 0.36 * width), (slot[1] - slot[0], 0.28 * width), angle=angle)
        for side in (-1.0, 1.0)
    ]
    return [
        sh.Support((0.0, 0.0), "$O$"),
        sh.CenterLine((0.0, 0.0), (1.15 * length, 0.0)),
        *rails,
        sh.Box(on_arm(0.5 * (slot[0] - half)), (slot[0] + half, 0.5 * width), angle=angle),
        sh.Box(on_arm(slot[1] + 0.035 * length), (0.07 * length, width), angle=angle),
        sh.Spring(on_arm(slot[0]), on_arm(max(distance - half, slot[0] + 0.1 * half)), width=0.3 * width),
        sh.Label(on_arm(0.5 * (slot[0] + distance), 0.6 * width), "$k,\\ l_0$", across),
        sh.Box(on_arm(distance), (2.0 * half, 0.8 * width), angle=angle),
        sh.Label(on_arm(distance, -0.5 * width), "$m,\\ c$", (-across[0], -across[1])),
        sh.Label(on_arm(0.97 * length, -0.5 * width), "$m_a,\\ J_O$", (-across[0], -across[1])),
        sh.CenterOfMass(on_arm(a)),
        sh.Dimension((0.0, 0.0), on_arm(a), "$a$", offset=-1.3 * width),
        sh.Pin((0.0, 0.0)),
        sh.AngleArrow((0.0, 0.0), 1.08 * length, 0.0, angle, r"$\theta$"),
        sh.CoordinateArrow(on_arm(0.0, 1.5 * width), on_arm(distance, 1.5 * width), "$r$", positive=along),
        sh.MomentArrow((0.0, 0.0), width, 0.6 * pi, 1.3 * pi, "$M$"),
        sh.GravityArrow((-0.35 * length, 0.35 * length), (-0.35 * length, 0.1 * length), "$g$"),
    ]


def build() -> System:
    """The collar in the arm as a System."""
    return System(
        key="collar_in_arm",
        title="Collar in a slotted arm in a vertical plane",
        field="worked example",
        description=(
            "An arm (mass m_a, moment of inertia J_O about the pivot O, mass center at the distance a) turns "
            "in a vertical plane; theta is its angle above the horizontal, counter-clockwise. A collar (mass "
            "m, a particle) slides in a slot along the arm at the distance r from O, held by a spring k of "
            "free length l_0 between pivot and collar; c damps the sliding. M is the torque of the drive on "
            "the arm."
        ),
        coordinates=(
            Coordinate(theta, "rad", "arm angle above the horizontal, counter-clockwise", (-pi, pi), "angle"),
            Coordinate(r, "m", "distance of the collar from the pivot", (0.05, 0.6), "length"),
        ),
        parameters=PARAMETERS,
        inputs=(Input(M, "N m", "drive torque on the arm, counter-clockwise", "couple"),),
        kinetic_energy=J_O * theta_d**2 / 2 + m * (r_d**2 + r**2 * theta_d**2) / 2,
        potential_energy=k * (r - l_0) ** 2 / 2 + (m * r + m_a * a) * g * sm.sin(theta),
        dissipation=c * r_d**2 / 2,
        generalized_forces={theta: M},
        frame=ground,
        free_bodies=free_bodies,
        unknowns=(N_c, O_x, O_y),
        shapes=shapes,
    )
