"""S11 Mast with a tip thruster: a force that follows the link it pushes on has no potential."""

from __future__ import annotations

from math import cos, pi, sin

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
    Parameter("m_1", "kg", 2.0, "joint mass"),
    Parameter("m_2", "kg", 1.0, "tip mass"),
    Parameter("L", "m", 0.5, "link length"),
    Parameter("k_1", "N m/rad", 20.0, "root spring", "nonnegative"),
    Parameter("k_2", "N m/rad", 20.0, "joint spring", "nonnegative"),
    Parameter("c_1", "N m s/rad", 0.1, "root damper", "nonnegative"),
    Parameter("c_2", "N m s/rad", 0.1, "joint damper", "nonnegative"),
    Parameter("P", "N", 50.0, "thrust", "any"),
)
m_1, m_2, L, k_1, k_2, c_1, c_2, P = (p.symbol for p in PARAMETERS)

theta1, theta2, F = dynamicsymbols("theta1 theta2 F")
theta1_d, theta2_d = dynamicsymbols("theta1 theta2", 1)
O_x, O_y, A_x, A_y = sm.symbols("O_x O_y A_x A_y")

ground = ReferenceFrame("N")  # X along the straight mast, Y to the left of it, seen from above
link_1 = ReferenceFrame("A")  # X from the root to the joint
link_1.orient_axis(ground, theta1, ground.z)
link_2 = ReferenceFrame("B")  # X from the joint to the tip
link_2.orient_axis(ground, theta2, ground.z)


def free_bodies() -> list[FreeBody]:
    """Each link with the point mass at its end; the links themselves have no mass."""
    root = Point("O")
    root.set_vel(ground, 0)
    joint = root.locatenew("A", L * link_1.x)
    tip = joint.locatenew("B", L * link_2.x)
    joint_force = A_x * ground.x + A_y * ground.y  # these three of the first link on the second
    spring = -k_2 * (theta2 - theta1) * ground.z
    damper = -c_2 * (theta2_d - theta1_d) * ground.z

    lower = FreeBody(
        RigidBody("link 1", joint, link_1, m_1, (inertia(link_1, 0, 0, 0), joint)),
        applied=[
            Torque(link_1, -k_1 * theta1 * ground.z),
            Torque(link_1, -c_1 * theta1_d * ground.z),
            Torque(link_1, -spring),
            Torque(link_1, -damper),
        ],
        reactions=[Force(root, O_x * ground.x + O_y * ground.y), Force(joint, -joint_force)],
    )
    upper = FreeBody(
        RigidBody("link 2", tip, link_2, m_2, (inertia(link_2, 0, 0, 0), tip)),
        applied=[
            Torque(link_2, spring),
            Torque(link_2, damper),
            Force(tip, -P * link_2.x),
            Force(tip, F * ground.y),
        ],
        reactions=[Force(joint, joint_force)],
    )
    return [lower, upper]


def shapes(q: list[float], values: dict[str, float]) -> list:
    """View from above with the root at the origin; the masses' sizes are fractions of the link length."""
    theta1, theta2, L = q[0], q[1], values["L"]

    def beyond(start: tuple[float, float], angle: float, along: float, left: float = 0.0) -> tuple:
        x, y = along * cos(angle) - left * sin(angle), along * sin(angle) + left * cos(angle)
        return (start[0] + x, start[1] + y)

    root = (0.0, 0.0)
    joint = beyond(root, theta1, L)
    tip = beyond(joint, theta2, L)
    nozzle = [(0.0, 0.035), (0.11, 0.035), (0.22, 0.09), (0.22, -0.09), (0.11, -0.035), (0.0, -0.035)]
    side = L if theta1 >= 0.0 else -L
    return [
        sh.Ground((0.0, -0.3 * L), (0.0, 0.3 * L)),
        sh.CenterLine(root, (1.5 * L, 0.0), arrow=True),
        sh.Label((1.45 * L, 0.0), "$X$", (0.0, -theta1 or -1.0), "reference"),
        sh.CenterLine(joint, (joint[0] + 0.75 * L, joint[1])),
        sh.CenterLine(joint, beyond(joint, theta1, 0.55 * L)),
        sh.Link(root, joint),
        sh.Link(joint, tip),
        sh.Disc(joint, 0.09 * L),
        sh.Label(beyond(joint, theta1, 0.0, 0.1 * L), "$m_1$", beyond(root, theta1, -0.3, 1.0)),
        sh.Label(beyond(tip, theta2, 0.0, 0.09 * L), "$m_2$", beyond(root, theta2, 0.0, 1.0)),
        sh.Polygon([beyond(tip, theta2, L * x, L * y) for x, y in nozzle]),
        sh.Disc(tip, 0.08 * L),
        sh.TorsionalSpring(root, 0.1 * L, 0.0, theta1),
        sh.Label((0.03 * L, -0.1 * side), "$k_1$", (1.0, -0.8 * side)),
        sh.TorsionalDamper(root, 0.35 * L, 0.0, theta1, "$c_1$"),
        sh.TorsionalSpring(joint, 0.07 * L, theta1, theta2),
        sh.Label(beyond(joint, theta1, 0.0, -0.1 * L), "$k_2$", beyond(root, theta1, 0.2, -1.0)),
        sh.TorsionalDamper(joint, 0.32 * L, theta1, theta2, "$c_2$"),
        sh.AngleArrow(root, 0.72 * L, 0.0, theta1, r"$\theta_1$"),
        sh.AngleArrow(joint, 0.6 * L, 0.0, theta2, r"$\theta_2$"),
        sh.Label(beyond(root, theta1, 0.58 * L), "$L$", beyond(root, theta1, 0.0, 1.0)),
        sh.Dimension(joint, tip, "$L$", offset=0.26 * L if theta2 >= theta1 else -0.26 * L),
        sh.ForceArrow(beyond(tip, theta2, 0.62 * L), beyond(tip, theta2, 0.27 * L), "$P$"),
        sh.ForceArrow((tip[0], tip[1] - 0.36 * L), (tip[0], tip[1] - 0.08 * L), "$F$"),
        sh.Pin(root, "$O$"),
        sh.Pin(joint),
    ]


def build() -> System:
    """The mast as a System."""
    coupling = m_2 * L**2 * sm.cos(theta1 - theta2) * theta1_d * theta2_d
    return System(
        number=11,
        key="follower_force_mast",
        title="Two-link mast with a tip thruster (follower force)",
        field="aerospace, stability",
        description=(
            "A mast of two rigid, massless links, each of length L, lies on a horizontal air-bearing table "
            "and is anchored at O along X. A point mass m_1 sits at the joint between the links, m_2 at "
            "the tip. Torsional springs, k_1 at the root and k_2 at the joint, are relaxed when the mast "
            "is straight; the dampers c_1 and c_2 act in parallel with them. theta1 and theta2 are the "
            "absolute angles of the links from X, counter-clockwise. A thruster at the tip pushes with "
            "the constant force P along the second link, from the tip toward the joint, wherever the link "
            "points. A disturbance F acts on the tip along the fixed direction Y."
        ),
        measured="gyros on both links while the thrust rises in steps: damping over thrust, onset of flutter",
        coordinates=(
            Coordinate(theta1, "rad", "first link from X, counter-clockwise", (-pi / 2, pi / 2), "angle"),
            Coordinate(theta2, "rad", "second link from X, counter-clockwise", (-pi / 2, pi / 2), "angle"),
        ),
        parameters=PARAMETERS,
        inputs=(Input(F, "N", "disturbance at the tip, along the fixed direction Y"),),
        kinetic_energy=(m_1 + m_2) * L**2 * theta1_d**2 / 2 + m_2 * L**2 * theta2_d**2 / 2 + coupling,
        potential_energy=k_1 * theta1**2 / 2 + k_2 * (theta2 - theta1) ** 2 / 2,
        dissipation=c_1 * theta1_d**2 / 2 + c_2 * (theta2_d - theta1_d) ** 2 / 2,
        generalized_forces={
            theta1: P * L * sm.sin(theta1 - theta2) + F * L * sm.cos(theta1),
            theta2: F * L * sm.cos(theta2),
        },
        frame=ground,
        free_bodies=free_bodies,
        unknowns=(O_x, O_y, A_x, A_y),
        shapes=shapes,
        pose=(0.35, 0.9),
    )
