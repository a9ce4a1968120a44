"""S02 Snap-through switch: a mass between two springs that are too long for the gap, on a moving base."""

from __future__ import annotations

import sympy as sm
from sympy.physics.mechanics import Force, Particle, Point, ReferenceFrame, dynamicsymbols

from engdyn import shapes as sh
from engdyn.modeling.newton import FreeBody
from engdyn.quantities import Coordinate, Input, Parameter
from engdyn.system import System

PARAMETERS = (
    Parameter("m", "kg", 0.05, "mass"),
    Parameter("b", "m", 0.03, "half span"),
    Parameter("L_0", "m", 0.0325, "relaxed length of a spring"),
    Parameter("k", "N/m", 4000.0, "stiffness of each spring", "nonnegative"),
    Parameter("c", "N s/m", 0.8, "damping", "nonnegative"),
    Parameter("g", "m/s^2", 9.81, "gravity", "any"),
)
m, b, L_0, k, c, g = (p.symbol for p in PARAMETERS)

y, yb, F = dynamicsymbols("y yb F")
y_d, yb_d = dynamicsymbols("y yb", 1)
N_g = sm.Symbol("N_g")

ground = ReferenceFrame("N")  # X right, Y up


def free_bodies() -> list[FreeBody]:
    """The mass: two springs along their axes, dashpot, weight and the guide, which pushes sideways."""
    origin = Point("O")
    origin.set_vel(ground, 0)
    base = origin.locatenew("C", yb * ground.y)  # halfway between the base points
    place = base.locatenew("P", y * ground.y)
    length = sm.sqrt(b**2 + y**2)
    tension = k * (length - L_0)
    to_left = (-b * ground.x - y * ground.y) / length  # from the mass to the left base point
    to_right = (b * ground.x - y * ground.y) / length
    mass = FreeBody(
        Particle("mass", place, m),
        applied=[
            Force(place, tension * to_left),
            Force(place, tension * to_right),
            Force(place, -c * y_d * ground.y),
            Force(place, -m * g * ground.y),
            Force(place, F * ground.y),
        ],
        reactions=[Force(place, N_g * ground.x)],
    )
    return [mass]


UP = (0.0, 1.0)


def shapes(q: list[float], values: dict[str, float]) -> list:
    """Side view of the base with its spring points at height 0; sizes are fractions of the half span."""
    y, b = q[0], values["b"]
    rod, floor, foot = 1.35 * b, -1.5 * b, -1.75 * b
    half, under = 0.16 * b, y - 0.16 * b
    left, right, away = (-b, 0.0), (b, 0.0), 1.0 if y >= 0.0 else -1.0
    base = [(-1.3 * b, foot), (1.3 * b, foot), (1.3 * b, 0.0), (b, 0.0), (b, floor), (-b, floor)]
    base += [(-b, 0.0), (-1.3 * b, 0.0)]
    return [
        sh.Polygon(base, role="ground"),
        sh.Link((0.0, floor), (0.0, rod)),
        sh.Spring(left, (-half, y), coils=6, width=0.15 * b),
        sh.Spring(right, (half, y), coils=6, width=0.15 * b),
        sh.Label((-0.55 * b, 0.5 * y), "$k,\\ L_0$", (0.0, away)),
        sh.Label((0.55 * b, 0.5 * y), "$k,\\ L_0$", (0.0, away)),
        sh.Damper((-0.09 * b, floor), (-0.09 * b, under), width=0.12 * b),
        sh.Label((-0.17 * b, 0.5 * (floor + under)), "$c$", (-1.0, 0.0)),
        sh.Box((0.0, y), (2.0 * half, 2.0 * half), label="$m$"),
        sh.Pin(left),
        sh.Pin(right),
        sh.CenterLine(left, (1.3 * b, 0.0), role="coordinate"),
        sh.CoordinateArrow((1.15 * b, 0.0), (1.15 * b, y), "$y$", positive=UP),
        sh.ForceArrow((-0.09 * b, y + half), (-0.09 * b, y + half + 0.5 * b), "$F$"),
        sh.ForceArrow((0.5 * b, foot - 0.42 * b), (0.5 * b, foot), "$y_b$"),
        sh.Dimension((-b, foot - 0.2 * b), (0.0, foot - 0.2 * b), "$b$"),
        sh.CenterLine((-b, foot - 0.3 * b), left),
        sh.CenterLine((0.0, foot - 0.3 * b), (0.0, floor)),
        sh.GravityArrow((-1.15 * b, 1.2 * b), (-1.15 * b, 0.75 * b), "$g$"),
    ]


def build() -> System:
    """The snap-through switch as a System."""
    return System(
        number=2,
        key="snap_through_switch",
        title="Snap-through switch on a moving base",
        field="microsystems, shallow trusses",
        description=(
            "A small mass m slides without friction in a vertical guide, midway between two points of the "
            "base that are 2 b apart. Two equal springs (stiffness k, relaxed length L_0) join these points "
            "to the mass; longer than the half span b, they hold it above or below the middle and let it "
            "snap from one side to the other. y is the height of the mass above the base points, positive "
            "up; a dashpot c acts between mass and base. The base moves vertically by yb, an actuation force "
            "F acts on the mass, both positive up. Gravity acts down."
        ),
        measured="base accelerometer and relative displacement: random vibration with jumps between the wells",
        coordinates=(
            Coordinate(y, "m", "height of the mass above the base points, up", (-0.05, 0.05), "length"),
        ),
        parameters=PARAMETERS,
        inputs=(
            Input(F, "N", "actuation force on the mass, positive up"),
            Input(yb, "m", "displacement of the base, positive up", "prescribed motion"),
        ),
        kinetic_energy=m * (y_d + yb_d) ** 2 / 2,
        potential_energy=k * (sm.sqrt(b**2 + y**2) - L_0) ** 2 + m * g * (y + yb),
        dissipation=c * y_d**2 / 2,
        generalized_forces={y: F},
        frame=ground,
        free_bodies=free_bodies,
        unknowns=(N_g,),
        shapes=shapes,
        pose=(0.012,),
    )
