"""S07 Gantry crane: a trolley on a rail and a container that swings below it."""

from __future__ import annotations

from math import cos, pi, sin

import sympy as sm
from sympy.physics.mechanics import (
    Force,
    Particle,
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
    Parameter("M_t", "kg", 1200.0, "trolley mass"),
    Parameter("m", "kg", 2500.0, "container mass"),
    Parameter("L", "m", 9.0, "hinge to container mass center"),
    Parameter("J_G", "kg m^2", 3000.0, "container inertia about its mass center"),
    Parameter("c_x", "N s/m", 400.0, "trolley damping", "nonnegative"),
    Parameter("c_h", "N m s/rad", 4000.0, "hinge damping", "nonnegative"),
    Parameter("g", "m/s^2", 9.81, "gravity", "any"),
)
M_t, m, L, J_G, c_x, c_h, g = (p.symbol for p in PARAMETERS)

x, theta = dynamicsymbols("x theta")
x_d, theta_d = dynamicsymbols("x theta", 1)
F, W = dynamicsymbols("F W")
H_x, H_y, N_r = sm.symbols("H_x H_y N_r")

ground = ReferenceFrame("N")  # X right, Y up
spreader = ReferenceFrame("B")  # -Y of it points from the hinge to the container
spreader.orient_axis(ground, theta, ground.z)


def free_bodies() -> list[FreeBody]:
    """Trolley and container, cut at the hinge and at the rail."""
    origin = Point("O")
    origin.set_vel(ground, 0)
    hinge = origin.locatenew("A", x * ground.x)
    center = hinge.locatenew("G", -L * spreader.y)
    hinge_force = H_x * ground.x + H_y * ground.y  # of the trolley on the spreader

    trolley = FreeBody(
        Particle("trolley", hinge, M_t),
        applied=[
            Force(hinge, F * ground.x),
            Force(hinge, -c_x * x_d * ground.x),
            Force(hinge, -M_t * g * ground.y),
        ],
        reactions=[Force(hinge, -hinge_force), Force(hinge, N_r * ground.y)],
    )
    container = FreeBody(
        RigidBody("container", center, spreader, m, (inertia(spreader, 0, 0, J_G), center)),
        applied=[
            Force(center, W * ground.x),
            Force(center, -m * g * ground.y),
            Torque(spreader, -c_h * theta_d * ground.z),
        ],
        reactions=[Force(hinge, hinge_force)],
    )
    return [trolley, container]


def shapes(q: list[float], values: dict[str, float]) -> list:
    """Side view, hinge at (x, 0); trolley and container sizes are fractions of the spreader length."""
    x, theta, L = q[0], q[1], values["L"]
    hinge = (x, 0.0)
    center = (x + L * sin(theta), -L * cos(theta))
    rail = -0.075 * L
    left, right = min(0.0, x) - 0.75 * L, max(0.0, x) + 0.65 * L
    across, along = 0.24 * L, 0.13 * L
    # The wind pushes the face on the right, whichever that is.
    reach = across if cos(theta) >= 0.0 else -across
    side = (center[0] + reach * cos(theta), center[1] + reach * sin(theta))
    return [
        sh.Ground((left, rail), (right, rail)),
        sh.Ground((left, 0.14 * L), (left, rail)),
        sh.Damper((left, 0.0), (x - 0.16 * L, 0.0), "$c_x$", width=0.06 * L),
        sh.Box((x, 0.0), (0.32 * L, 0.1 * L), label=""),
        sh.Disc((x - 0.1 * L, rail + 0.03 * L), 0.03 * L),
        sh.Disc((x + 0.1 * L, rail + 0.03 * L), 0.03 * L),
        sh.Label((x - 0.11 * L, 0.05 * L), "$M_t$", (-1.0, 1.0)),
        sh.CenterLine(hinge, (x, -0.75 * L)),
        sh.Link(hinge, center),
        sh.Box(center, (2.0 * across, 2.0 * along), angle=theta),
        sh.Label((center[0] - 0.12 * L * cos(theta), center[1] - 0.12 * L * sin(theta)), "$m,\\ J_G$"),
        sh.CenterOfMass(center, "$G$"),
        sh.TorsionalDamper(hinge, 0.2 * L, -pi / 2, theta - pi / 2, "$c_h$"),
        sh.Pin(hinge),
        sh.AngleArrow(hinge, 0.45 * L, -pi / 2, theta - pi / 2, r"$\theta$"),
        sh.CoordinateArrow((0.0, 0.22 * L), (x, 0.22 * L), "$x$"),
        sh.Dimension(hinge, center, "$L$", offset=-0.44 * L),
        sh.ForceArrow((x + 0.16 * L, 0.0), (x + 0.42 * L, 0.0), "$F$"),
        sh.ForceArrow(side, (side[0] + 0.26 * L, side[1]), "$W$"),
        sh.GravityArrow((left + 0.1 * L, -0.4 * L), (left + 0.1 * L, -0.65 * L), "$g$"),
    ]


def build() -> System:
    """The gantry crane as a System."""
    v_x = x_d + L * sm.cos(theta) * theta_d  # of the container's mass center
    v_y = L * sm.sin(theta) * theta_d
    return System(
        number=7,
        key="gantry_crane",
        title="Gantry crane: trolley and hanging container",
        field="cranes",
        description=(
            "A trolley (mass M_t) runs on a horizontal rail, x positive to the right. A container (mass m, "
            "inertia J_G about its mass center) hangs below it on a rigid, massless spreader of length L "
            "from the hinge on the trolley to the container's mass center; spreader and container swing as "
            "one body. theta is the swing angle from the downward vertical, counter-clockwise positive. A "
            "drive force F acts on the trolley, a wind force W on the container, both to the right; c_x "
            "damps the trolley, c_h the hinge. Gravity acts downward."
        ),
        measured="trolley encoder and swing-angle camera: free swing after a stop, response to wind",
        coordinates=(
            Coordinate(x, "m", "trolley position, positive to the right", None, "ignorable"),
            Coordinate(
                theta, "rad", "swing angle from the downward vertical, counter-clockwise", (-pi, pi), "angle"
            ),
        ),
        parameters=PARAMETERS,
        inputs=(
            Input(F, "N", "drive force on the trolley, positive to the right"),
            Input(W, "N", "wind force on the container, positive to the right"),
        ),
        kinetic_energy=M_t * x_d**2 / 2 + m * (v_x**2 + v_y**2) / 2 + J_G * theta_d**2 / 2,
        potential_energy=-m * g * L * sm.cos(theta),
        dissipation=c_x * x_d**2 / 2 + c_h * theta_d**2 / 2,
        generalized_forces={x: F + W, theta: W * L * sm.cos(theta)},
        frame=ground,
        free_bodies=free_bodies,
        unknowns=(H_x, H_y, N_r),
        shapes=shapes,
    )
