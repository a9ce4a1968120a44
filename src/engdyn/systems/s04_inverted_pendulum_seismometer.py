"""S04 Inverted-pendulum seismometer: gravity nearly cancels the flexure that holds the pendulum upright."""

from __future__ import annotations

from math import cos, pi, sin

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
    Parameter("m", "kg", 0.5, "pendulum mass"),
    Parameter("l", "m", 0.2, "hinge to mass center"),
    Parameter("J_G", "kg m^2", 0.002, "inertia about the mass center"),
    Parameter("k_f", "N m/rad", 1.06, "flexure stiffness", "nonnegative"),
    Parameter("c_e", "N m s/rad", 0.05, "eddy-current damping", "nonnegative"),
    Parameter("g", "m/s^2", 9.81, "gravity", "any"),
)
m, l, J_G, k_f, c_e, g = (p.symbol for p in PARAMETERS)

theta, xb, M_c = dynamicsymbols("theta xb M_c")
theta_d, xb_d = dynamicsymbols("theta xb", 1)
H_x, H_y = sm.symbols("H_x H_y")

ground = ReferenceFrame("N")  # X right, Y up
pendulum_axes = ReferenceFrame("B")  # Y from the hinge to the mass center
pendulum_axes.orient_axis(ground, theta, ground.z)


def free_bodies() -> list[FreeBody]:
    """The pendulum, cut at the hinge, which moves with the ground."""
    origin = Point("O")
    origin.set_vel(ground, 0)
    hinge = origin.locatenew("A", xb * ground.x)
    center = hinge.locatenew("G", l * pendulum_axes.y)
    pendulum = FreeBody(
        RigidBody("pendulum", center, pendulum_axes, m, (inertia(pendulum_axes, 0, 0, J_G), center)),
        applied=[
            Force(center, -m * g * ground.y),
            Torque(pendulum_axes, -k_f * theta * ground.z),
            Torque(pendulum_axes, -c_e * theta_d * ground.z),
            Torque(pendulum_axes, M_c * ground.z),
        ],
        reactions=[Force(hinge, H_x * ground.x + H_y * ground.y)],
    )
    return [pendulum]


def shapes(q: list[float], values: dict[str, float]) -> list:
    """Side view with the hinge at the origin; sizes are fractions of the length l."""
    theta, l = q[0], values["l"]

    def body(along: float, across: float) -> tuple[float, float]:
        return (-along * sin(theta) + across * cos(theta), along * cos(theta) + across * sin(theta))

    center, floor, plate = body(l, 0.0), -0.62 * l, -0.42 * l
    stem = 0.045 * l
    rod = [(0.0, stem), (0.7 * l, stem), (0.7 * l, -stem), (0.0, -stem)]
    bob = 0.3 * l
    upright = theta + pi / 2
    turn = 1.0 if theta >= 0.0 else -1.0
    frame = [(-0.6 * l, floor), (0.6 * l, floor), (0.6 * l, plate), (0.1 * l, plate), (0.03 * l, 0.0)]
    frame += [(-0.03 * l, 0.0), (-0.1 * l, plate), (-0.6 * l, plate)]
    return [
        sh.Ground((-0.95 * l, floor), (0.95 * l, floor)),
        sh.Polygon(frame, role="ground"),
        sh.CenterLine((0.0, 0.0), (0.0, 1.35 * l)),
        sh.Polygon([body(*point) for point in rod]),
        sh.Disc(center, bob),
        sh.CenterOfMass(center, "$G$"),
        sh.Label(body(l - 0.5 * bob, 0.0), "$m,\\ J_G$"),
        sh.TorsionalSpring((0.0, 0.0), 0.13 * l, -pi / 2, upright),
        sh.Label((-0.13 * l * turn, -0.06 * l), "$k_f$", (-turn, -0.2)),
        sh.TorsionalDamper((0.0, 0.0), 0.38 * l, pi / 2, upright, "$c_e$"),
        sh.AngleArrow((0.0, 0.0), 0.6 * l, pi / 2, upright, r"$\theta$"),
        sh.MomentArrow(center, 1.4 * bob, theta + 0.28 * pi, theta + 0.72 * pi, "$M_c$"),
        sh.Dimension((0.0, 0.0), center, "$l$", offset=0.5 * l * turn),
        sh.Pin((0.0, 0.0)),
        sh.ForceArrow((0.6 * l, 0.5 * (floor + plate)), (1.0 * l, 0.5 * (floor + plate)), "$x_b$"),
        sh.GravityArrow((0.85 * l * turn, 0.5 * l), (0.85 * l * turn, 0.2 * l), "$g$"),
    ]


def build() -> System:
    """The seismometer as a System."""
    v_x = xb_d - l * sm.cos(theta) * theta_d  # of the mass center
    v_y = -l * sm.sin(theta) * theta_d
    return System(
        number=4,
        key="inverted_pendulum_seismometer",
        title="Long-period inverted-pendulum seismometer",
        field="measurement",
        description=(
            "The frame of an instrument moves horizontally with the ground, xb positive to the right. A "
            "rigid pendulum (mass m, inertia J_G about its mass center G) stands upside down on a flexure "
            "hinge of the frame; G is at the distance l from the hinge. The flexure is a torsional spring "
            "k_f, an eddy-current damper c_e acts on the rotation relative to the frame. theta is the tilt "
            "from the upward vertical, counter-clockwise positive: G moves to the left. Gravity, acting "
            "down, nearly cancels the flexure, so that the period is long. A calibration coil exerts the "
            "couple M_c, counter-clockwise."
        ),
        measured="ground acceleration and relative angle: transfer function of the sensor",
        coordinates=(
            Coordinate(theta, "rad", "tilt from the upward vertical, counter-clockwise", (-pi, pi), "angle"),
        ),
        parameters=PARAMETERS,
        inputs=(
            Input(M_c, "N m", "couple of the calibration coil, counter-clockwise", "couple"),
            Input(xb, "m", "displacement of the ground, positive to the right", "prescribed motion"),
        ),
        kinetic_energy=m * (v_x**2 + v_y**2) / 2 + J_G * theta_d**2 / 2,
        potential_energy=m * g * l * sm.cos(theta) + k_f * theta**2 / 2,
        dissipation=c_e * theta_d**2 / 2,
        generalized_forces={theta: M_c},
        frame=ground,
        free_bodies=free_bodies,
        unknowns=(H_x, H_y),
        shapes=shapes,
    )
