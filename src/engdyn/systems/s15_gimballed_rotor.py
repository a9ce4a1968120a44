"""S15 Upright centrifuge rotor on a gimbal: gyroscopic splitting and gyroscopic stabilization."""

from __future__ import annotations

from math import cos, pi, sin

import numpy as np
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
    Parameter("m", "kg", 5.0, "rotor mass"),
    Parameter("l", "m", 0.15, "O to mass center"),
    Parameter("A", "kg m^2", 0.12, "transverse inertia about O"),
    Parameter("C", "kg m^2", 0.18, "axial inertia"),
    Parameter("k_a", "N m/rad", 60.0, "gimbal spring on alpha", "nonnegative"),
    Parameter("k_b", "N m/rad", 60.0, "gimbal spring on beta", "nonnegative"),
    Parameter("c_a", "N m s/rad", 0.3, "gimbal damping on alpha", "nonnegative"),
    Parameter("c_b", "N m s/rad", 0.3, "gimbal damping on beta", "nonnegative"),
    Parameter("Omega", "rad/s", 20.0, "spin rate", "any"),
    Parameter("g", "m/s^2", 9.81, "gravity", "any"),
)
m, l, A, C, k_a, k_b, c_a, c_b, Omega, g = (p.symbol for p in PARAMETERS)

alpha, beta, M_x, M_y = dynamicsymbols("alpha beta M_x M_y")
alpha_d, beta_d = dynamicsymbols("alpha beta", 1)
O_x, O_y, O_z, lam = sm.symbols("O_x O_y O_z lam")

ground = ReferenceFrame("N")  # Z up
ring_axes = ReferenceFrame("R")  # the outer ring of the gimbal turns about X
ring_axes.orient_axis(ground, alpha, ground.x)
shaft_axes = ReferenceFrame("S")  # the housing turns about the axis y of the ring; Z along the shaft
shaft_axes.orient_axis(ring_axes, beta, ring_axes.y)
rotor_axes = ReferenceFrame("D")  # spins as well
rotor_axes.orient_axis(shaft_axes, Omega * dynamicsymbols._t, shaft_axes.z)


def free_bodies() -> list[FreeBody]:
    """Rotor and massless housing in one; the motor is inside, the gimbal outside.

    Angular momentum is written in the axes of the shaft, in which the moments of inertia of the spinning
    rotor do not change.
    """
    pivot = Point("O")
    pivot.set_vel(ground, 0)
    center = pivot.locatenew("G", l * shaft_axes.z)
    transverse = A - m * l**2  # about G
    rotor = FreeBody(
        RigidBody("rotor", center, rotor_axes, m, (inertia(shaft_axes, transverse, transverse, C), center)),
        applied=[
            Force(center, -m * g * ground.z),
            Torque(shaft_axes, -k_a * alpha * ground.x),
            Torque(shaft_axes, -c_a * alpha_d * ground.x),
            Torque(shaft_axes, -k_b * beta * ring_axes.y),
            Torque(shaft_axes, -c_b * beta_d * ring_axes.y),
            Torque(shaft_axes, M_x * ground.x),
            Torque(shaft_axes, M_y * ground.y),
        ],
        reactions=[
            Force(pivot, O_x * ground.x + O_y * ground.y + O_z * ground.z),
            Torque(shaft_axes, lam * ring_axes.z),  # about X × y', about which the gimbal cannot turn
        ],
    )
    return [rotor]


def shapes(q: list[float], values: dict[str, float]) -> list:
    """In space, O at the origin; the rotor drawn narrow, without its housing."""
    alpha, beta = q
    length = values["l"]
    radius, ring, end = 0.6 * length, 0.85 * length, 1.6 * length
    X, Y, Z = np.eye(3)
    y, z = cos(alpha) * Y + sin(alpha) * Z, cos(alpha) * Z - sin(alpha) * Y  # axes of the ring
    x, shaft = cos(beta) * X - sin(beta) * z, cos(beta) * z + sin(beta) * X  # of the housing
    at, origin, plane = tuple, (0.0, 0.0, 0.0), {"x_axis": tuple(x), "y_axis": tuple(y)}
    center, tip, thick = length * shaft, end * shaft, 0.07 * radius * shaft
    return [
        sh.CenterLine(at(-1.9 * ring * X), at(2.1 * ring * X), "$X$", arrow=True),
        sh.CenterLine(origin, at(1.9 * ring * Y), "$Y$", arrow=True),
        sh.CenterLine(origin, at(1.1 * end * Z), "$Z$", arrow=True),
        sh.CenterLine(origin, at(1.1 * end * z)),
        sh.CenterLine(origin, at(1.12 * tip), "$z''$", arrow=True),
        *_gimbal(ring, alpha, beta),
        sh.Link(origin, at(center)),
        sh.Disc(at(center - thick), radius, **plane),
        sh.Disc(at(center + thick), radius, **plane),
        sh.Curve((at(center + thick), at(tip)), role="joint"),
        sh.Label(at(center + 0.75 * radius * y), "$m,\\ A,\\ C$", (1.0, 0.5)),
        sh.Dimension(origin, at(center), "$l$", offset=0.0),
        sh.MomentArrow(
            at(0.9 * tip), 0.3 * radius, -0.9 * pi, 0.5 * pi, r"$\Omega$", **plane, role="reference"
        ),
        sh.AngleArrow(origin, 0.95 * end, 0.0, alpha, r"$\alpha$", at(Z), at(-Y)),
        sh.AngleArrow(origin, 0.8 * end, 0.0, beta, r"$\beta$", at(z), at(X)),
        sh.Pin(origin, "$O$"),
        sh.GravityArrow(at(end * (0.9 * Z - X)), at(end * (0.55 * Z - X)), "$g$"),
    ]


def _gimbal(ring: float, alpha: float, beta: float) -> list:
    """The ring in its bearings, springs and dampers at both axes, and the moments that act from outside."""
    X, Y, Z = np.eye(3)
    y, at, small = cos(alpha) * Y + sin(alpha) * Z, tuple, 0.2 * ring
    turn = np.linspace(0.0, 2 * pi, 61)[:, None]
    about_x = {"x_axis": tuple(Y), "y_axis": tuple(Z)}
    about_y = {"x_axis": tuple(Z), "y_axis": tuple(X)}
    return [
        *(sh.Link(at(s * ring * X), at(s * 1.3 * ring * X)) for s in (-1, 1)),
        *(sh.Support(at(s * 1.3 * ring * X)) for s in (-1, 1)),
        sh.Curve(tuple(map(tuple, ring * (np.cos(turn) * X + np.sin(turn) * y)))),
        sh.Link(at(-ring * y), at(ring * y)),
        sh.Pin(at(-ring * y)),  # the other one is behind the rotor
        sh.TorsionalSpring(at(-1.12 * ring * X), small, -pi / 2, pi / 2 + alpha, "$k_a$", **about_x),
        sh.TorsionalDamper(at(1.12 * ring * X), small, -pi / 2, pi / 2 + alpha, "$c_a$", **about_x),
        sh.TorsionalSpring(at(-0.8 * ring * y), small, -pi / 2, beta, "$k_b$", **about_y),
        sh.TorsionalDamper(at(-0.45 * ring * y), small, -pi / 2, beta, "$c_b$", **about_y),
        sh.MomentArrow(at(1.8 * ring * X), 1.1 * small, -0.7 * pi, 0.8 * pi, "$M_x$", **about_x),
        sh.MomentArrow(at(1.6 * ring * Y), 1.1 * small, -0.7 * pi, 0.8 * pi, "$M_y$", **about_y),
    ]


def build() -> System:
    """The rotor as a System."""
    axial = Omega + alpha_d * sm.sin(beta)
    return System(
        number=15,
        key="gimballed_rotor",
        title="Upright gimballed centrifuge rotor",
        field="rotors",
        description=(
            "A symmetric rotor (mass m) spins in a massless housing at the constant rate Omega, kept by a "
            "motor, about a light shaft that stands upright on a gimbal at the fixed point O. From the "
            "fixed axes (Z up) the shaft follows by the rotation alpha about X and then beta about the "
            "turned y axis. The mass center is on the shaft at the distance l above O; A is the moment of "
            "inertia about any transverse axis through O, C the axial one. The gimbal has springs k_a, k_b "
            "and dampers c_a, c_b on its two angles. Gravity acts down and tips the rotor over. A moment "
            "(M_x, M_y) about the fixed axes X and Y acts on the housing, as a rotating dynamic unbalance "
            "would. lam is the couple of the gimbal about the axis it cannot turn about."
        ),
        measured="two tilt sensors in a run-up: waterfall diagram with forward and backward branches",
        coordinates=(
            Coordinate(alpha, "rad", "rotation about X", (-1.5, 1.5), "angle"),
            Coordinate(beta, "rad", "rotation about the turned y axis", (-1.5, 1.5), "angle"),
        ),
        parameters=PARAMETERS,
        inputs=(
            Input(M_x, "N m", "moment about the fixed axis X", "couple"),
            Input(M_y, "N m", "moment about the fixed axis Y", "couple"),
        ),
        kinetic_energy=A * ((alpha_d * sm.cos(beta)) ** 2 + beta_d**2) / 2 + C * axial**2 / 2,
        potential_energy=(m * g * l * sm.cos(alpha) * sm.cos(beta) + k_a * alpha**2 / 2 + k_b * beta**2 / 2),
        dissipation=c_a * alpha_d**2 / 2 + c_b * beta_d**2 / 2,
        generalized_forces={alpha: M_x, beta: M_y * sm.cos(alpha)},
        frame=ground,
        free_bodies=free_bodies,
        unknowns=(O_x, O_y, O_z, lam),
        shapes=shapes,
        pose=(0.35, 0.4),
    )
