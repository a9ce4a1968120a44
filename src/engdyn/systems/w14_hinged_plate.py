"""W14 Plate hinged to an eccentric rotating arm: the steady motion of section 4.3."""

from __future__ import annotations

from math import cos, pi, sin

import sympy as sm
from sympy.physics.mechanics import Force, Point, ReferenceFrame, RigidBody, Torque, dynamicsymbols, inertia

from engdyn import shapes as sh
from engdyn.modeling.newton import FreeBody
from engdyn.quantities import Coordinate, Input, Parameter
from engdyn.system import System

PARAMETERS = (
    Parameter("m", "kg", 1.5, "plate mass"),
    Parameter("b", "m", 0.4, "plate length, hinge to free edge"),
    Parameter("w", "m", 0.2, "plate width along the hinge"),
    Parameter("e", "m", 0.02, "offset of the hinge from the axis", "any", (-0.08, 0.08)),
    Parameter("Omega", "rad/s", 9.0, "speed of rotation", "any"),
    Parameter("c", "N m s/rad", 0.12, "hinge damping", "nonnegative"),
    Parameter("g", "m/s^2", 9.81, "gravity", "any"),
)
m, b, w, e, Omega, c, g = (p.symbol for p in PARAMETERS)

phi, drive = dynamicsymbols("phi drive")
phi_d, drive_d = dynamicsymbols("phi drive", 1)
H_r, H_t, H_z, C_r, C_z = sm.symbols("H_r H_t H_z C_r C_z")

ground = ReferenceFrame("N")  # Z up along the axis of rotation
arm = ReferenceFrame("A")  # X along the arm, Y in the direction of travel
arm.orient_axis(ground, drive, ground.z)
plate_axes = ReferenceFrame("B")  # -Z from the hinge to the free edge
plate_axes.orient_axis(arm, -phi, arm.y)


def free_bodies() -> list[FreeBody]:
    """The plate alone: three hinge forces and two hinge couples keep it on the arm."""
    axis = Point("O")
    axis.set_vel(ground, 0)
    hinge = axis.locatenew("A", e * arm.x)
    center = hinge.locatenew("G", -b / 2 * plate_axes.z)
    tensor = inertia(plate_axes, m * (b**2 + w**2) / 12, m * b**2 / 12, m * w**2 / 12)
    plate = FreeBody(
        RigidBody("plate", center, plate_axes, m, (tensor, center)),
        applied=[Force(center, -m * g * ground.z), Torque(plate_axes, c * phi_d * arm.y)],
        reactions=[
            Force(hinge, H_r * arm.x + H_t * arm.y + H_z * arm.z),
            Torque(plate_axes, C_r * arm.x + C_z * arm.z),
        ],
    )
    return [plate]


def shapes(q: list[float], values: dict[str, float]) -> list:
    """View along the hinge, the axis of rotation upright."""
    angle, length, offset = q[0], values["b"], values["e"]
    hinge = (offset, 0.0)
    edge = (offset + length * sin(angle), -length * cos(angle))
    middle = ((hinge[0] + edge[0]) / 2, (hinge[1] + edge[1]) / 2)
    top = 0.45 * length
    return [
        sh.CenterLine((0.0, top), (0.0, -1.15 * length)),
        sh.Link((0.0, top), (0.0, 0.0)),
        sh.Link((0.0, 0.0), hinge),
        sh.MomentArrow(
            (0.0, 0.8 * top),
            0.13 * length,
            0.75 * pi,
            2.25 * pi,
            r"$\Omega$",
            y_axis=(0.0, 0.4),
            role="reference",
        ),
        sh.CenterLine(hinge, (offset, -0.7 * length)),
        sh.Box(middle, (0.05 * length, length), angle=angle),
        sh.CenterOfMass(middle),
        sh.Label(edge, "$m,\\ b$", (1.0, -1.0)),
        sh.Pin(hinge),
        sh.Dimension((0.0, 0.0), hinge, "$e$", offset=0.14 * length),
        sh.AngleArrow(hinge, 0.5 * length, -pi / 2, angle - pi / 2, r"$\phi$"),
        sh.GravityArrow((-0.6 * length, -0.1 * length), (-0.6 * length, -0.35 * length), "$g$"),
    ]


def build() -> System:
    """The rotating plate as a System."""
    about_hinge = m * b**2 / 3
    travel = (
        m * e**2 + m * e * b * sm.sin(phi) + about_hinge * sm.sin(phi) ** 2 + m * w**2 / 12
    )  # inertia about the axis
    return System(
        key="hinged_plate",
        title="Plate hinged to an eccentric rotating arm",
        field="worked example",
        description=(
            "A vertical shaft turns at the rate Omega and carries a short arm. A thin uniform plate (mass "
            "m, length b, width w) hangs from a hinge at the end of the arm, at the distance e from the "
            "axis; the hinge is horizontal and square to the arm. phi is the angle of the plate from the "
            "downward vertical, positive outward. c damps the hinge."
        ),
        coordinates=(
            Coordinate(phi, "rad", "plate angle from the downward vertical, outward", (-pi, pi), "angle"),
        ),
        parameters=PARAMETERS,
        inputs=(
            Input(drive, "rad", "arm angle", "drive angle", (Omega * dynamicsymbols._t, Omega, sm.S.Zero)),
        ),
        kinetic_energy=about_hinge * phi_d**2 / 2 + travel * drive_d**2 / 2,
        potential_energy=-m * g * b / 2 * sm.cos(phi),
        dissipation=c * phi_d**2 / 2,
        frame=ground,
        free_bodies=free_bodies,
        unknowns=(H_r, H_t, H_z, C_r, C_z),
        shapes=shapes,
    )
