"""S05 Bobsleigh in a banked bend: how high does the sled climb at constant speed?"""

from __future__ import annotations

from math import cos, pi, sin

import sympy as sm
from sympy.physics.mechanics import Force, Particle, Point, ReferenceFrame, dynamicsymbols

from engdyn import shapes as sh
from engdyn.modeling.newton import FreeBody
from engdyn.quantities import Coordinate, Input, Parameter
from engdyn.system import System

PARAMETERS = (
    Parameter("m", "kg", 630.0, "sled and crew"),
    Parameter("v", "m/s", 35.0, "speed on the center line", "any"),
    Parameter("R", "m", 30.0, "bend radius"),
    Parameter("rho", "m", 3.0, "channel radius"),
    Parameter("c", "N s/m", 600.0, "lateral damping", "nonnegative"),
    Parameter("g", "m/s^2", 9.81, "gravity", "any"),
)
m, v, R, rho, c, g = (p.symbol for p in PARAMETERS)

phi, F_s = dynamicsymbols("phi F_s")
phi_d = dynamicsymbols("phi", 1)
N_i, P_t = sm.symbols("N_i P_t")

ground = ReferenceFrame("N")  # Z up along the axis of the bend
bend = ReferenceFrame("E")  # turns with the sled; X outward, Y along the track
bend.orient_axis(ground, v / R * dynamicsymbols._t, ground.z)
ice = ReferenceFrame(
    "I"
)  # X across the channel, in which phi grows; Z toward the center of the cross-section
ice.orient_axis(bend, -phi, bend.y)


def free_bodies() -> list[FreeBody]:
    """The sled: ice, drive along the track, weight, steering and friction across the channel."""
    axis = Point("O")
    axis.set_vel(ground, 0)
    place = axis.locatenew("P", R * bend.x - rho * ice.z)
    sled = FreeBody(
        Particle("sled", place, m),
        applied=[
            Force(place, -m * g * ground.z),
            Force(place, F_s * ice.x),
            Force(place, -c * rho * phi_d * ice.x),
        ],
        reactions=[Force(place, N_i * ice.z), Force(place, P_t * ice.y)],
    )
    return [sled]


def shapes(q: list[float], values: dict[str, float]) -> list:
    """Cross-section of the channel, its center at the origin; a far axis of the bend is drawn nearer."""
    phi, rho = q[0], values["rho"]
    axis = -min(values["R"], 2.1 * rho)
    thick, ice, level = 1.22 * rho, 1.08 * rho, 0.75 * rho

    def at(radius: float, angle: float) -> tuple[float, float]:
        return (radius * sin(angle), -radius * cos(angle))

    turns = [(-0.66 + 0.02 * i) * pi for i in range(67)]
    channel = [at(ice, a) for a in turns] + [at(thick, a) for a in reversed(turns)]
    sled, along, stop = at(rho, phi), (cos(phi), sin(phi)), phi - 0.62
    tip = (at(0.95 * rho, phi)[0] + 0.2 * rho * along[0], at(0.95 * rho, phi)[1] + 0.2 * rho * along[1])
    gap = [
        (0.5 * axis + 0.05 * rho * a, level + 0.05 * rho * b) for a, b in ((-1, -1), (0, 1), (0, -1), (1, 1))
    ]
    broken = [sh.Curve(gap, role="parameter")] if -axis < values["R"] else []
    return [
        sh.Polygon(channel, role="ground"),
        sh.CenterLine((axis, -1.2 * rho), (axis, 1.2 * rho)),
        sh.MomentArrow(
            (axis, 1.0 * rho), 0.2 * rho, 0.75 * pi, 2.25 * pi, "$v/R$", y_axis=(0.0, 0.4), role="reference"
        ),
        sh.CenterLine((0.0, 0.0), at(0.9 * rho, 0.0)),
        sh.Box(sled, (0.4 * rho, 0.15 * rho), angle=phi),
        sh.CenterOfMass(sled),
        sh.Label(at(0.86 * rho, phi), "$m$", at(-1.0, phi)),
        sh.Link(at(ice, stop), at(0.97 * rho, stop), role="damper"),
        sh.TorsionalDamper((0.0, 0.0), rho, stop - pi / 2, phi - 0.2 - pi / 2),
        sh.Label(at(0.9 * rho, 0.5 * (stop + phi - 0.2)), "$c$", at(-1.0, 0.5 * (stop + phi - 0.2))),
        sh.Dimension((0.0, 0.0), at(0.925 * rho, phi), r"$\rho$"),
        sh.AngleArrow((0.0, 0.0), 0.5 * rho, -pi / 2, phi - pi / 2, r"$\phi$"),
        sh.Pin((0.0, 0.0)),
        sh.Dimension((axis, level), (0.0, level), "$R$"),
        *broken,
        sh.CenterLine((0.0, level + 0.1 * rho), (0.0, 0.0)),
        sh.ForceArrow(tip, (tip[0] + 0.33 * rho * along[0], tip[1] + 0.33 * rho * along[1]), "$F_s$"),
        sh.Label(at(1.4 * rho, phi), r"$\otimes\ v$", role="reference"),
        sh.GravityArrow((axis + 0.35 * rho, -0.4 * rho), (axis + 0.35 * rho, -0.85 * rho), "$g$"),
    ]


def build() -> System:
    """The bobsleigh in the bend as a System."""
    around = v / R * (R + rho * sm.sin(phi))  # speed along the track
    return System(
        number=5,
        key="bobsleigh_bend",
        title="Bobsleigh in a banked bend at constant speed",
        field="sport",
        description=(
            "The bottom of an ice channel is a horizontal circle; its cross-section is an arc of radius "
            "rho whose center runs round a fixed vertical axis at the distance R. The sled (particle, mass "
            "m) goes round the bend at the constant rate v/R. phi is its place in the cross-section: zero "
            "at the bottom, positive up the outer wall, so that its distance from the axis is "
            "R + rho sin(phi) and its height -rho cos(phi). Friction of the runners is viscous, c times "
            "the speed across the channel; the steering force F_s acts across the channel, positive "
            "outward and up. Gravity acts down."
        ),
        measured="crew accelerometer: load on entry, in the bend and on exit",
        coordinates=(
            Coordinate(phi, "rad", "place in the cross-section, up the outer wall", (-pi, pi), "angle"),
        ),
        parameters=PARAMETERS,
        inputs=(Input(F_s, "N", "steering force across the channel, outward and up"),),
        kinetic_energy=m * ((rho * phi_d) ** 2 + around**2) / 2,
        potential_energy=-m * g * rho * sm.cos(phi),
        dissipation=c * (rho * phi_d) ** 2 / 2,
        generalized_forces={phi: F_s * rho},
        frame=ground,
        free_bodies=free_bodies,
        unknowns=(N_i, P_t),
        shapes=shapes,
    )
