"""W8 Rigid rod on two springs: the worked example of sections 6.2 to 6.5."""

from __future__ import annotations

from math import cos, pi, sin

import sympy as sm
from sympy.physics.mechanics import Force, Point, ReferenceFrame, RigidBody, dynamicsymbols, inertia

from engdyn import shapes as sh
from engdyn.modeling.newton import FreeBody
from engdyn.quantities import Coordinate, Input, Parameter
from engdyn.system import System

PARAMETERS = (
    Parameter("m", "kg", 20.0, "rod mass"),
    Parameter("L", "m", 2.0, "rod length"),
    Parameter("a_1", "m", 0.8, "mass center to left spring", "nonnegative", (0.0, 1.0)),
    Parameter("a_2", "m", 0.6, "mass center to right spring", "nonnegative", (0.0, 1.0)),
    Parameter("k_1", "N/m", 8000.0, "left spring", "nonnegative"),
    Parameter("k_2", "N/m", 12000.0, "right spring", "nonnegative"),
    Parameter("c_1", "N s/m", 40.0, "left damper", "nonnegative", (0.0, 200.0)),
    Parameter("c_2", "N s/m", 0.0, "right damper", "nonnegative", (0.0, 200.0)),
)
m, L, a_1, a_2, k_1, k_2, c_1, c_2 = (p.symbol for p in PARAMETERS)

y, theta, F = dynamicsymbols("y theta F")
y_d, theta_d = dynamicsymbols("y theta", 1)

ground = ReferenceFrame("N")  # X right, Y up
rod = ReferenceFrame("B")  # X along the rod
rod.orient_axis(ground, theta, ground.z)

J = m * L**2 / 12
stretch_1, stretch_2 = y - a_1 * sm.sin(theta), y + a_2 * sm.sin(theta)
rate_1, rate_2 = y_d - a_1 * sm.cos(theta) * theta_d, y_d + a_2 * sm.cos(theta) * theta_d


def free_bodies() -> list[FreeBody]:
    """The rod; its weight and the preloads that carry it cancel in every position."""
    origin = Point("O")
    origin.set_vel(ground, 0)
    center = origin.locatenew("G", y * ground.y)
    left, right = center.locatenew("P_1", -a_1 * rod.x), center.locatenew("P_2", a_2 * rod.x)
    return [
        FreeBody(
            RigidBody("rod", center, rod, m, (inertia(rod, 0, 0, J), center)),
            applied=[
                Force(left, -(k_1 * stretch_1 + c_1 * rate_1) * ground.y),
                Force(right, -(k_2 * stretch_2 + c_2 * rate_2) * ground.y),
                Force(center, F * ground.y),
            ],
        )
    ]


def shapes(q: list[float], values: dict[str, float]) -> list:
    """Front view, G above the origin; the springs are 0.3 L long at rest."""
    rise, angle, length = q[0], q[1], values["L"]
    level, thick = 0.3 * length, 0.035 * length
    center = (0.0, level + rise)

    def on_rod(along: float, across: float = 0.0) -> tuple[float, float]:
        return (
            along * cos(angle) - across * sin(angle),
            center[1] + along * sin(angle) + across * cos(angle),
        )

    supports = []
    for place, number in ((-values["a_1"], 1), (values["a_2"], 2)):
        top = on_rod(place, -thick / 2)
        outward = 1.0 if place > 0 else -1.0
        beside, middle = top[0] - 0.09 * length * outward, place - 0.04 * length * outward
        foot = on_rod(place - 0.09 * length * outward, -thick / 2)
        supports += [
            sh.Ground((middle - 0.12 * length, 0.0), (middle + 0.12 * length, 0.0)),
            sh.Spring((top[0], 0.0), top, width=0.05 * length),
            sh.Label((top[0] + 0.04 * length * outward, level / 2), f"$k_{number}$", (outward, 0.0)),
        ]
        if values[f"c_{number}"] > 0:
            supports += [
                sh.Damper((beside, 0.0), (beside, foot[1]), width=0.045 * length),
                sh.Label((beside - 0.035 * length * outward, level / 2), f"$c_{number}$", (-outward, 0.0)),
            ]
    below = -0.07 * length
    return [
        *supports,
        sh.Box(center, (length, thick), angle=angle),
        sh.CenterOfMass(center, "$G$"),
        sh.Label(on_rod(-0.24 * length, thick / 2), "$m,\\ L$", (0.0, 1.0)),
        sh.CenterLine((0.0, level), (0.62 * length, level), role="coordinate"),
        sh.CoordinateArrow((0.56 * length, level), (0.56 * length, level + rise), "$y$", positive=(0.0, 1.0)),
        sh.AngleArrow(center, 0.44 * length, 0.0, angle, r"$\theta$"),
        sh.Dimension((-values["a_1"], below), (0.0, below), "$a_1$"),
        sh.Dimension((0.0, below), (values["a_2"], below), "$a_2$"),
        sh.ForceArrow((0.0, center[1] + thick / 2), (0.0, center[1] + 0.16 * length), "$F$"),
    ]


def build() -> System:
    """The rod on its springs as a System."""
    return System(
        key="rod_on_springs",
        title="Rigid rod on two springs",
        field="worked example",
        description=(
            "A uniform rod (mass m, length L) lies level on two vertical springs, k_1 at the distance a_1 to "
            "the left of its mass center G and k_2 at a_2 to the right, each with a damper beside it (c_1, "
            "c_2; the right one is missing at first). G moves up and down: y is its displacement, positive up, "
            "and theta the angle of the rod, counter-clockwise, both from rest. All springs act vertically, and "
            "their preloads carry the weight, so that gravity drops out. A force F pushes G up."
        ),
        coordinates=(
            Coordinate(y, "m", "displacement of G, up", (-0.3, 0.3), "length"),
            Coordinate(theta, "rad", "angle of the rod, counter-clockwise", (-pi / 4, pi / 4), "angle"),
        ),
        parameters=PARAMETERS,
        inputs=(Input(F, "N", "force on G, positive up"),),
        kinetic_energy=m * y_d**2 / 2 + J * theta_d**2 / 2,
        potential_energy=k_1 * stretch_1**2 / 2 + k_2 * stretch_2**2 / 2,
        dissipation=c_1 * rate_1**2 / 2 + c_2 * rate_2**2 / 2,
        generalized_forces={y: F},
        frame=ground,
        free_bodies=free_bodies,
        shapes=shapes,
        pose=(0.08, 0.1),
    )
