"""W10 Simple pendulum: the worked example of sections 4.1, 8.2 and 8.5."""

from __future__ import annotations

from math import cos, pi, sin

import sympy as sm
from sympy.physics.mechanics import Force, Particle, Point, ReferenceFrame, dynamicsymbols

from engdyn import shapes as sh
from engdyn.modeling.newton import FreeBody
from engdyn.quantities import Coordinate, Parameter
from engdyn.system import System

PARAMETERS = (
    Parameter("m", "kg", 0.5, "bob mass"),
    Parameter("l", "m", 0.8, "length"),
    Parameter("g", "m/s^2", 9.81, "gravity", "any"),
)
m, l, g = (p.symbol for p in PARAMETERS)

theta = dynamicsymbols("theta")
theta_d = dynamicsymbols("theta", 1)
S = sm.Symbol("S")

ground = ReferenceFrame("N")  # X right, Y up
rod = ReferenceFrame("B")
rod.orient_axis(ground, theta, ground.z)


def free_bodies() -> list[FreeBody]:
    """The bob, cut from the rod."""
    pivot = Point("O")
    pivot.set_vel(ground, 0)
    bob = pivot.locatenew("P", -l * rod.y)
    return [
        FreeBody(
            Particle("bob", bob, m),
            applied=[Force(bob, -m * g * ground.y)],
            reactions=[Force(bob, S * rod.y)],
        )
    ]


def shapes(q: list[float], values: dict[str, float]) -> list:
    """Front view, pivot at the origin."""
    angle, length = q[0], values["l"]
    bob = (length * sin(angle), -length * cos(angle))
    return [
        sh.Ground((0.25 * length, 0.0), (-0.25 * length, 0.0)),
        sh.CenterLine((0.0, 0.0), (0.0, -0.75 * length)),
        sh.Link((0.0, 0.0), bob, "$l$"),
        sh.Pin((0.0, 0.0)),
        sh.Disc(bob, 0.08 * length, label="$m$"),
        sh.AngleArrow((0.0, 0.0), 0.5 * length, -pi / 2, angle - pi / 2, r"$\theta$"),
        sh.GravityArrow((-0.55 * length, -0.25 * length), (-0.55 * length, -0.5 * length), "$g$"),
    ]


def build() -> System:
    """The pendulum as a System."""
    return System(
        key="pendulum",
        title="Simple pendulum",
        field="worked example",
        description=(
            "A bob (particle, mass m) hangs from a fixed pivot on a light rod of length l; theta is the "
            "angle of the rod from the downward vertical, counter-clockwise. Nothing damps it."
        ),
        coordinates=(Coordinate(theta, "rad", "rod angle from the downward vertical", (-pi, pi), "angle"),),
        parameters=PARAMETERS,
        kinetic_energy=m * l**2 * theta_d**2 / 2,
        potential_energy=-m * g * l * sm.cos(theta),
        frame=ground,
        free_bodies=free_bodies,
        unknowns=(S,),
        shapes=shapes,
    )
