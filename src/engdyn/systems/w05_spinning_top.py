"""W5 Heavy symmetric top: the worked example of sections 2.14 and 4.4."""

from __future__ import annotations

from math import cos, pi, sin, sqrt

import numpy as np
import sympy as sm
from sympy.physics.mechanics import Force, Point, ReferenceFrame, RigidBody, dynamicsymbols, inertia

from engdyn import shapes as sh
from engdyn.modeling.newton import FreeBody
from engdyn.quantities import Coordinate, Parameter
from engdyn.system import System

PARAMETERS = (
    Parameter("m", "kg", 0.15, "mass"),
    Parameter("l", "m", 0.05, "distance of the mass center from the tip"),
    Parameter("A", "kg m^2", 4.2e-4, "transverse moment of inertia about the tip"),
    Parameter("C", "kg m^2", 9.2e-5, "axial moment of inertia"),
    Parameter("g", "m/s^2", 9.81, "gravity", "any"),
    Parameter("p", "rad/s", 4.2, "rate of precession in the steady motion looked for", "any"),
    Parameter("n", "rad/s", 200.0, "rate of spin in the steady motion looked for", "any"),
)
m, l, A, C, g = (p.symbol for p in PARAMETERS[:5])

phi, theta, psi = dynamicsymbols("phi theta psi")
phi_d, theta_d, psi_d = dynamicsymbols("phi theta psi", 1)
O_x, O_y, O_z = sm.symbols("O_x O_y O_z")

ground = ReferenceFrame("N")  # Z up
nodal = ReferenceFrame("D")  # precesses and nutates: X along the line of nodes, Z along the axis of the top
nodal.orient_body_fixed(ground, (phi, theta, 0), "ZXZ")
top_axes = ReferenceFrame("B")  # spins as well
top_axes.orient_axis(nodal, psi, nodal.z)

#: From where the outline of the top is seen: the direction of the eye in the usual view of a drawing.
EYE = np.array([cos(pi / 9) * cos(pi / 3), -cos(pi / 9) * sin(pi / 3), sin(pi / 9)])


def free_bodies() -> list[FreeBody]:
    """The top alone, its tip held by the floor."""
    tip = Point("O")
    tip.set_vel(ground, 0)
    center = tip.locatenew("G", l * nodal.z)
    central = inertia(top_axes, A - m * l**2, A - m * l**2, C)
    support = O_x * ground.x + O_y * ground.y + O_z * ground.z
    return [
        FreeBody(
            RigidBody("top", center, top_axes, m, (central, center)),
            applied=[Force(center, -m * g * ground.z)],
            reactions=[Force(tip, support)],
        )
    ]


def shapes(q: list[float], values: dict[str, float]) -> list:
    """In space, tip at the origin; the disc has the mass and the axial moment, a radius on it shows the spin."""
    phi, theta, psi = q
    length, radius = values["l"], sqrt(2 * values["C"] / values["m"])
    forward, side, up = np.eye(3)
    node = cos(phi) * forward + sin(phi) * side
    lean = sin(phi) * forward - cos(phi) * side  # horizontal, to where the axis leans
    axis, across = cos(theta) * up + sin(theta) * lean, cos(theta) * -lean + sin(theta) * up
    center, tip, end = length * axis, (0.0, 0.0, 0.0), 1.9 * length
    rim = np.cross(axis, EYE)
    rim *= radius / np.linalg.norm(rim)

    def upper(along: float) -> tuple[float, ...]:
        return tuple(along * axis)

    plane = {"x_axis": tuple(node), "y_axis": tuple(across)}
    return [
        sh.CenterLine(tip, tuple(end * up)),
        sh.CenterLine(tuple(end * up), tuple(1.2 * end * up), "$Z$", arrow=True),
        sh.CenterLine(tip, tuple(end * forward), "$X$", arrow=True),
        sh.CenterLine(tip, tuple(end * node)),
        sh.Polygon((tip, tuple(0.9 * center + rim), tuple(0.9 * center - rim))),
        sh.Disc(upper(0.9 * length), radius, **plane),
        sh.Disc(upper(1.1 * length), radius, angle=psi, **plane),
        sh.CenterLine(upper(1.1 * length), tuple(1.1 * center + 1.35 * radius * node), role="joint"),
        sh.Curve((upper(1.1 * length), upper(end)), role="joint"),
        sh.Label(upper(end), "$m,\\ l,\\ A,\\ C$", (1.0, 0.2)),
        sh.Support(tip, "$O$"),
        sh.AngleArrow(tip, 0.85 * end, 0.0, phi, r"$\phi$", tuple(forward), tuple(side)),
        sh.AngleArrow(tip, 1.1 * end, 0.0, theta, r"$\theta$", tuple(up), tuple(lean)),
        sh.AngleArrow(upper(1.1 * length), 1.2 * radius, 0.0, psi, r"$\psi$", **plane),
        sh.GravityArrow(
            tuple(end * (0.9 * up - 0.6 * forward)), tuple(end * (0.55 * up - 0.6 * forward)), "$g$"
        ),
    ]


def steady(values: dict[str, float], inputs: dict) -> dict:
    """Steady precession: both rates are prescribed, the nutation that goes with them is looked for."""
    return {"rates": {"phi": values["p"], "psi": values["n"]}}


def build() -> System:
    """The top as a System."""
    axial = psi_d + phi_d * sm.cos(theta)
    return System(
        key="spinning_top",
        title="Heavy symmetric top",
        field="worked example",
        description=(
            "A symmetric top (mass m) turns about its tip O, which stays in place; the mass center is on the axis at "
            "the distance l from O. A is the moment of inertia about any transverse axis through O, C the axial one. "
            "From the fixed axes (Z up) the attitude follows by the precession phi about Z, the nutation theta about "
            "the turned x axis, and the spin psi about the axis of the top."
        ),
        coordinates=(
            Coordinate(phi, "rad", "precession about the vertical", None, "ignorable"),
            Coordinate(
                theta, "rad", "nutation: angle of the axis from the upward vertical", (0.05, pi - 0.05)
            ),
            Coordinate(psi, "rad", "spin about the axis of the top", None, "ignorable"),
        ),
        parameters=PARAMETERS,
        kinetic_energy=A * (theta_d**2 + phi_d**2 * sm.sin(theta) ** 2) / 2 + C * axial**2 / 2,
        potential_energy=m * g * l * sm.cos(theta),
        frame=ground,
        free_bodies=free_bodies,
        unknowns=(O_x, O_y, O_z),
        shapes=shapes,
        pose=(1.3, 0.5, 0.9),
        steady=steady,
    )
