"""W16 Bead on a parabolic wire: the worked example that opens chapter 3 (W6b of the plan)."""

from __future__ import annotations

import sympy as sm
from sympy.physics.mechanics import Force, Particle, Point, ReferenceFrame, dynamicsymbols

from engdyn import shapes as sh
from engdyn.modeling.newton import FreeBody
from engdyn.quantities import Coordinate, Parameter
from engdyn.system import System

PARAMETERS = (
    Parameter("m", "kg", 0.05, "mass of the bead"),
    Parameter("p", "1/m", 0.8, "shape of the wire, y = p x²"),
    Parameter("g", "m/s^2", 9.81, "gravity", "any"),
)
m, p, g = (parameter.symbol for parameter in PARAMETERS)

x = dynamicsymbols("x")
x_d = dynamicsymbols("x", 1)
N_w = sm.Symbol("N_w")

ground = ReferenceFrame("N")  # X right, Y up
upward = ReferenceFrame("U")  # X up, Y left: the vertical balance comes first, in which N_w never drops out
upward.orient_axis(ground, sm.pi / 2, ground.z)


def free_bodies() -> list[FreeBody]:
    """The bead; the smooth wire pushes square to itself, on the side of the hollow where N_w > 0."""
    origin = Point("O")
    origin.set_vel(ground, 0)
    place = origin.locatenew("P", x * ground.x + p * x**2 * ground.y)
    slope = 2 * p * x
    normal = (upward.x + slope * upward.y) / sm.sqrt(1 + slope**2)
    return [
        FreeBody(
            Particle("bead", place, m),
            applied=[Force(place, -m * g * ground.y)],
            reactions=[Force(place, N_w * normal)],
        )
    ]


def shapes(q: list[float], values: dict[str, float]) -> list:
    """The wire from the front, with the bead where it is."""
    position, bend = q[0], values["p"]
    reach = max(0.8 / bend, 1.25 * abs(position))
    wire = tuple((reach * k / 40, bend * (reach * k / 40) ** 2) for k in range(-40, 41))
    bead, top = (position, bend * position**2), bend * reach**2
    return [
        sh.CenterLine((-1.1 * reach, 0.0), (1.15 * reach, 0.0), "$x$", arrow=True),
        sh.CenterLine((0.0, -0.08 * top), (0.0, 1.15 * top), "$y$", arrow=True),
        sh.Curve(wire, role="ground"),
        sh.Label(wire[8], "$y=p\\,x^2$", (1.0, 0.6)),
        sh.Disc(bead, 0.045 * reach),
        sh.Label(bead, "$m$", (1.0, -0.6)),
        sh.CoordinateArrow((0.0, -0.14 * top), (position, -0.14 * top), "$x$"),
        sh.GravityArrow((0.4 * reach, 1.05 * top), (0.4 * reach, 0.75 * top), "$g$"),
    ]


def build() -> System:
    """The bead on the wire as a System."""
    y_d = 2 * p * x * x_d
    return System(
        key="bead_on_wire",
        title="Bead on a parabolic wire",
        field="worked example",
        description=(
            "A bead of mass m slides without friction on a rigid wire bent to the parabola y = p x² in a "
            "vertical plane; x is its horizontal distance from the lowest point. The wire's force N_w is "
            "square to the wire and does no work."
        ),
        coordinates=(Coordinate(x, "m", "horizontal place of the bead", (-1.0, 1.0), "length"),),
        parameters=PARAMETERS,
        kinetic_energy=m * (x_d**2 + y_d**2) / 2,
        potential_energy=m * g * p * x**2,
        frame=ground,
        free_bodies=free_bodies,
        unknowns=(N_w,),
        shapes=shapes,
    )
