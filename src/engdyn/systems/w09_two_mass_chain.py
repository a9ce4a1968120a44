"""W9 Chain of two masses: the worked example of chapters 7 and 9."""

from __future__ import annotations

from sympy.physics.mechanics import Force, Particle, Point, ReferenceFrame, dynamicsymbols

from engdyn import shapes as sh
from engdyn.modeling.newton import FreeBody
from engdyn.quantities import Coordinate, Input, Parameter
from engdyn.system import System

PARAMETERS = (
    Parameter("m_1", "kg", 2.0, "first mass"),
    Parameter("m_2", "kg", 1.0, "second mass", span=(0.2, 4.0)),
    Parameter("k_1", "N/m", 800.0, "spring to the wall", "nonnegative"),
    Parameter("k_2", "N/m", 300.0, "spring between the masses", "nonnegative"),
    Parameter("c_1", "N s/m", 4.0, "damper to the wall", "nonnegative", (0.0, 20.0)),
    Parameter("c_2", "N s/m", 1.5, "damper between the masses", "nonnegative", (0.0, 20.0)),
)
m_1, m_2, k_1, k_2, c_1, c_2 = (p.symbol for p in PARAMETERS)

x1, x2, xb, F = dynamicsymbols("x1 x2 xb F")
x1_d, x2_d, xb_d = dynamicsymbols("x1 x2 xb", 1)

ground = ReferenceFrame("N")  # X along the chain, away from the wall


def free_bodies() -> list[FreeBody]:
    """Both masses; what is between them pulls on each."""
    origin = Point("O")
    origin.set_vel(ground, 0)
    first, second = origin.locatenew("P_1", x1 * ground.x), origin.locatenew("P_2", x2 * ground.x)
    pull = (k_2 * (x2 - x1) + c_2 * (x2_d - x1_d)) * ground.x  # of the second on the first
    return [
        FreeBody(
            Particle("first mass", first, m_1),
            applied=[
                Force(first, -(k_1 * (x1 - xb) + c_1 * (x1_d - xb_d)) * ground.x),
                Force(first, pull),
                Force(first, F * ground.x),
            ],
        ),
        FreeBody(Particle("second mass", second, m_2), applied=[Force(second, -pull)]),
    ]


RIGHT = (1.0, 0.0)


def shapes(q: list[float], values: dict[str, float]) -> list:
    """Side view; relaxed springs are 0.4 m long, so that centimeters can be seen."""
    gap, width, height = 0.4, 0.28, 0.32
    left, right = gap + q[0], 2 * gap + width + q[1]  # left faces
    spring, damper, above, top = 0.5 * height, 0.17 * height, 1.25 * height, 0.9 * height
    drawn: list = [
        sh.Ground((0.0, 1.4 * height), (0.0, 0.0)),
        sh.Ground((0.0, 0.0), (2 * gap + 2 * width + 0.3, 0.0)),
    ]
    for number, start, end in ((1, 0.0, left), (2, left + width, right)):
        drawn += [
            sh.Spring((start, spring), (end, spring), f"$k_{number}$", width=0.07),
            sh.Damper((start, damper), (end, damper), width=0.06),
            sh.Label(((start + end) / 2, 0.02), f"$c_{number}$", (0.0, -1.0)),
        ]
    return [
        *drawn,
        sh.Box((left + width / 2, height / 2), (width, height), label="$m_1$"),
        sh.Box((right + width / 2, height / 2), (width, height), label="$m_2$"),
        sh.CenterLine((gap, height), (gap, 1.45 * height), role="coordinate"),
        sh.CoordinateArrow((gap, above), (left, above), "$x_1$", positive=RIGHT),
        sh.CenterLine((2 * gap + width, height), (2 * gap + width, 1.45 * height), role="coordinate"),
        sh.CoordinateArrow((2 * gap + width, above), (right, above), "$x_2$", positive=RIGHT),
        sh.ForceArrow((left + width, top), (left + width + 0.14, top), "$F$"),
        sh.ForceArrow((-0.2, spring), (-0.04, spring), "$x_b$"),
    ]


def build() -> System:
    """The chain as a System."""
    return System(
        key="two_mass_chain",
        title="Chain of two masses",
        field="worked example",
        description=(
            "Two masses slide on a smooth floor. A spring k_1 and a damper c_1 connect the first (m_1) to a "
            "wall, a spring k_2 and a damper c_2 the second (m_2) to the first. x1 and x2 are their "
            "displacements away from the wall, from where the springs are relaxed. A force F acts on the first "
            "mass, away from the wall; the wall may move, by xb in the same direction."
        ),
        coordinates=(
            Coordinate(x1, "m", "displacement of the first mass", (-0.2, 0.2), "length"),
            Coordinate(x2, "m", "displacement of the second mass", (-0.2, 0.2), "length"),
        ),
        parameters=PARAMETERS,
        inputs=(
            Input(F, "N", "force on the first mass, away from the wall"),
            Input(xb, "m", "displacement of the wall, toward the masses", "prescribed motion"),
        ),
        kinetic_energy=m_1 * x1_d**2 / 2 + m_2 * x2_d**2 / 2,
        potential_energy=k_1 * (x1 - xb) ** 2 / 2 + k_2 * (x2 - x1) ** 2 / 2,
        dissipation=c_1 * (x1_d - xb_d) ** 2 / 2 + c_2 * (x2_d - x1_d) ** 2 / 2,
        generalized_forces={x1: F},
        frame=ground,
        free_bodies=free_bodies,
        shapes=shapes,
        pose=(0.06, 0.1),
    )
