"""S09 Drum robot: a shell that rolls on a slope, driven by a pendulum inside."""

from __future__ import annotations

from collections.abc import Mapping
from math import cos, pi, sin
from typing import Any

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
    Parameter("M_d", "kg", 6.0, "shell mass"),
    Parameter("R", "m", 0.2, "shell radius"),
    Parameter("J_d", "kg m^2", 0.2, "shell inertia about the axle"),
    Parameter("m", "kg", 8.0, "pendulum mass"),
    Parameter("l", "m", 0.12, "axle to pendulum mass center"),
    Parameter("J_p", "kg m^2", 0.05, "pendulum inertia about its mass center"),
    Parameter("beta", "rad", 0.05, "slope angle", "any"),
    Parameter("c_a", "N m s/rad", 0.06, "axle damping", "nonnegative"),
    Parameter("g", "m/s^2", 9.81, "gravity", "any"),
)
M_d, R, J_d, m, l, J_p, beta, c_a, g = (p.symbol for p in PARAMETERS)

x, theta, tau = dynamicsymbols("x theta tau")
x_d, theta_d = dynamicsymbols("x theta", 1)
N_c, F_f, A_x, A_y = sm.symbols("N_c F_f A_x A_y")

ground = ReferenceFrame("N")  # X right, Y up
slope = ReferenceFrame("S")  # X up the slope
slope.orient_axis(ground, beta, ground.z)
shell_axes = ReferenceFrame("D")  # rolls: uphill means clockwise
shell_axes.orient_axis(ground, -x / R, ground.z)
pendulum_axes = ReferenceFrame("P")  # -Y from the axle to the mass center
pendulum_axes.orient_axis(ground, theta, ground.z)


def free_bodies() -> list[FreeBody]:
    """Shell and pendulum, cut at the axle and at the ground."""
    origin = Point("O")
    origin.set_vel(ground, 0)
    axle = origin.locatenew("A", x * slope.x)
    contact = axle.locatenew("C", -R * slope.y)
    center = axle.locatenew("G", -l * pendulum_axes.y)
    axle_force = A_x * slope.x + A_y * slope.y  # of the shell on the pendulum
    motor = tau * ground.z  # these two on the pendulum
    damper = -c_a * (theta_d + x_d / R) * ground.z

    shell = FreeBody(
        RigidBody("shell", axle, shell_axes, M_d, (inertia(shell_axes, 0, 0, J_d), axle)),
        applied=[
            Force(axle, -M_d * g * ground.y),
            Torque(shell_axes, -motor),
            Torque(shell_axes, -damper),
        ],
        reactions=[Force(contact, N_c * slope.y), Force(contact, F_f * slope.x), Force(axle, -axle_force)],
    )
    pendulum = FreeBody(
        RigidBody("pendulum", center, pendulum_axes, m, (inertia(pendulum_axes, 0, 0, J_p), center)),
        applied=[
            Force(center, -m * g * ground.y),
            Torque(pendulum_axes, motor),
            Torque(pendulum_axes, damper),
        ],
        reactions=[Force(axle, axle_force)],
    )
    return [shell, pendulum]


def steady(values: Mapping[str, float], inputs: Mapping[str, Any]) -> dict[str, Any]:
    """At rest on the slope, held by a torque that is solved for; with a torque given, steady rolling."""
    return {} if "tau" in inputs else {"rates": {"x": 0.0}, "free": ["tau"]}


def shapes(q: list[float], values: dict[str, float]) -> list:
    """Side view, the axle at the origin for x = 0; sizes are fractions of the shell radius."""
    x, theta, R, l, beta = q[0], q[1], values["R"], values["l"], values["beta"]

    def on_slope(along: float, across: float) -> tuple[float, float]:
        return (along * cos(beta) - across * sin(beta), along * sin(beta) + across * cos(beta))

    def around(radius: float, angle: float, across: float = 0.0) -> tuple[float, float]:
        x, y = radius * cos(angle) - across * sin(angle), radius * sin(angle) + across * cos(angle)
        return (axle[0] + x, axle[1] + y)

    axle, foot = on_slope(x, 0.0), on_slope(min(x, 0.0) - 1.7 * R, -R)
    down = theta - pi / 2
    G, start, end = around(l, down), on_slope(0.0, 1.25 * R), on_slope(x, 1.25 * R)
    rod = [(0.0, 0.05 * R), (l, 0.05 * R), (l, -0.05 * R), (0.0, -0.05 * R)]
    return [
        sh.Ground(foot, on_slope(max(x, 0.0) + 1.9 * R, -R)),
        sh.CenterLine(foot, (foot[0] + 3.4 * R, foot[1])),
        sh.MomentArrow(foot, 3.2 * R, 0.0, beta, r"$\beta$", role="parameter"),
        sh.Disc(axle, R, angle=-x / R + 0.6 * pi),
        sh.Label(around(0.78 * R, beta + 0.3 * pi), "$M_d,\\ J_d$"),
        sh.Polygon([around(along, down, across) for along, across in rod]),
        sh.Disc(G, 0.13 * R),
        sh.CenterOfMass(G, "$G$"),
        sh.Label(around(l, down, 0.1 * R), "$m,\\ J_p$", (1.0, -0.2)),
        sh.CenterLine(axle, (axle[0], axle[1] - 0.95 * R), role="coordinate"),
        sh.AngleArrow(axle, 0.75 * R, -pi / 2, down, r"$\theta$"),
        sh.TorsionalDamper(axle, 0.32 * R, down, down + 1.5, "$c_a$"),
        sh.MomentArrow(axle, 0.2 * R, down + 3.8, down + 5.6, r"$\tau$"),
        sh.MomentArrow(axle, 0.72 * R, 0.35, -0.35, r"$\tau$"),
        sh.Dimension(axle, around(R, beta + 0.82 * pi), "$R$"),
        sh.Dimension(axle, G, "$l$", offset=-0.4 * R),
        sh.Pin(axle),
        sh.CoordinateArrow(start, end, "$x$", positive=on_slope(1.0, 0.0)),
        sh.GravityArrow((foot[0] + 0.1 * R, 0.9 * R), (foot[0] + 0.1 * R, 0.4 * R), "$g$"),
    ]


def build() -> System:
    """The drum robot as a System."""
    v_x = x_d * sm.cos(beta) + l * sm.cos(theta) * theta_d  # of the pendulum's mass center
    v_y = x_d * sm.sin(beta) + l * sm.sin(theta) * theta_d
    return System(
        number=9,
        key="rolling_drum_robot",
        title="Drum robot: rolling shell driven by an internal pendulum on a slope",
        field="robotics",
        description=(
            "A cylindrical shell (mass M_d, radius R, inertia J_d about its axle) rolls without slip on a "
            "plane that rises to the right at the angle beta; x is the travel of the axle up the slope. A "
            "pendulum (mass m, inertia J_p about its mass center) hangs on the axle, its mass center at the "
            "distance l; theta is its absolute angle from the downward vertical, counter-clockwise. A motor "
            "in the pendulum drives the shell: its torque tau acts counter-clockwise on the pendulum and "
            "clockwise on the shell, so that a positive torque drives the robot uphill. Damping c_a acts in "
            "the axle on the relative rate theta' + x'/R, as the shell turns at -x'/R. Gravity acts down."
        ),
        measured="wheel encoder and inertial sensor of the pendulum: start-up, frequency of rocking",
        coordinates=(
            Coordinate(x, "m", "travel of the axle up the slope", None, "ignorable"),
            Coordinate(
                theta,
                "rad",
                "pendulum angle from the downward vertical, counter-clockwise",
                (-pi, pi),
                "angle",
            ),
        ),
        parameters=PARAMETERS,
        inputs=(Input(tau, "N m", "motor torque, counter-clockwise on the pendulum", "couple"),),
        kinetic_energy=((M_d + J_d / R**2) * x_d**2 / 2 + m * (v_x**2 + v_y**2) / 2 + J_p * theta_d**2 / 2),
        potential_energy=(M_d + m) * g * x * sm.sin(beta) - m * g * l * sm.cos(theta),
        dissipation=c_a * (theta_d + x_d / R) ** 2 / 2,
        generalized_forces={x: tau / R, theta: tau},
        frame=ground,
        free_bodies=free_bodies,
        unknowns=(N_c, F_f, A_x, A_y),
        steady=steady,
        shapes=shapes,
    )
