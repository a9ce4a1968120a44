"""W15 Load hanging from the mast of an accelerating lift truck: constant acceleration in section 4.3."""

from __future__ import annotations

from math import cos, pi, sin

import sympy as sm
from sympy.physics.mechanics import Force, Particle, Point, ReferenceFrame, dynamicsymbols

from engdyn import shapes as sh
from engdyn.modeling.newton import FreeBody
from engdyn.quantities import Coordinate, Input, Parameter
from engdyn.system import System

PARAMETERS = (
    Parameter("m", "kg", 250.0, "load mass"),
    Parameter("l", "m", 1.6, "chain length"),
    Parameter("a", "m/s^2", 2.0, "acceleration of the truck", "any", (-6.0, 6.0)),
    Parameter("c", "N m s/rad", 60.0, "damping of the swing", "nonnegative"),
    Parameter("g", "m/s^2", 9.81, "gravity", "any"),
)
m, l, a, c, g = (p.symbol for p in PARAMETERS)

theta, xb = dynamicsymbols("theta xb")
theta_d, xb_d = dynamicsymbols("theta xb", 1)
S = sm.Symbol("S")
t = dynamicsymbols._t

ground = ReferenceFrame("N")  # X in the direction of travel, Y up
chain = ReferenceFrame("B")
chain.orient_axis(ground, theta, ground.z)


def free_bodies() -> list[FreeBody]:
    """The load, cut from the chain; the damping couple acts as a shear force through the chain."""
    start = Point("O")
    start.set_vel(ground, 0)
    mast = start.locatenew("A", xb * ground.x)
    load = mast.locatenew("P", -l * chain.y)
    return [
        FreeBody(
            Particle("load", load, m),
            applied=[Force(load, -m * g * ground.y), Force(load, -c * theta_d / l * chain.x)],
            reactions=[Force(load, S * chain.y)],
        )
    ]


def shapes(q: list[float], values: dict[str, float]) -> list:
    """Side view in the truck's frame, the suspension at the origin."""
    angle, length = q[0], values["l"]
    load = (length * sin(angle), -length * cos(angle))
    floor, back = -1.45 * length, -1.05 * length
    return [
        sh.Ground((back - 0.35 * length, floor), (0.95 * length, floor)),
        sh.Polygon(
            (
                (back - 0.25 * length, floor + 0.12 * length),
                (back + 0.35 * length, floor + 0.12 * length),
                (back + 0.35 * length, floor + 0.55 * length),
                (back - 0.25 * length, floor + 0.4 * length),
            )
        ),
        sh.Disc((back - 0.1 * length, floor + 0.1 * length), 0.1 * length),
        sh.Disc((back + 0.25 * length, floor + 0.1 * length), 0.1 * length),
        sh.Link((back + 0.4 * length, floor + 0.12 * length), (back + 0.4 * length, 0.12 * length)),
        sh.Link((back + 0.4 * length, 0.12 * length), (0.0, 0.12 * length)),
        sh.Link((0.0, 0.12 * length), (0.0, 0.0)),
        sh.CenterLine((0.0, 0.0), (0.0, -0.8 * length)),
        sh.Link((0.0, 0.0), load, "$l$"),
        sh.Pin((0.0, 0.0)),
        sh.Box(load, (0.26 * length, 0.2 * length), angle=angle, label="$m$"),
        sh.AngleArrow((0.0, 0.0), 0.5 * length, -pi / 2, angle - pi / 2, r"$\theta$"),
        sh.ForceArrow(
            (back - 0.05 * length, floor + 0.75 * length),
            (back + 0.3 * length, floor + 0.75 * length),
            r"$\ddot x_b = a$",
            role="coordinate",
        ),
        sh.GravityArrow((0.75 * length, -0.2 * length), (0.75 * length, -0.45 * length), "$g$"),
    ]


def build() -> System:
    """The load on the lift truck as a System."""
    v_x, v_y = xb_d + l * sm.cos(theta) * theta_d, l * sm.sin(theta) * theta_d
    return System(
        key="lift_truck",
        title="Load hanging from an accelerating lift truck",
        field="worked example",
        description=(
            "A load (particle, mass m) hangs on a chain of length l from the mast of a lift truck that "
            "drives to the right with the constant acceleration a; theta is the angle of the chain from "
            "the downward vertical, counter-clockwise, so that a positive angle swings the load forward. c "
            "damps the swing."
        ),
        coordinates=(
            Coordinate(theta, "rad", "chain angle from the downward vertical, forward", (-pi, pi), "angle"),
        ),
        parameters=PARAMETERS,
        inputs=(Input(xb, "m", "position of the truck", "prescribed motion", (a * t**2 / 2, a * t, a)),),
        kinetic_energy=m * (v_x**2 + v_y**2) / 2,
        potential_energy=-m * g * l * sm.cos(theta),
        dissipation=c * theta_d**2 / 2,
        frame=ground,
        free_bodies=free_bodies,
        unknowns=(S,),
        shapes=shapes,
    )
