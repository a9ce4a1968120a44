"""W6 Front wheel of a bicycle as a gyroscope: the worked example of section 2.14."""

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
    Parameter("m", "kg", 1.5, "mass of the wheel"),
    Parameter("R", "m", 0.34, "radius of the wheel"),
    Parameter("A", "kg m^2", 0.065, "moment of inertia of the wheel about a diameter"),
    Parameter("C", "kg m^2", 0.13, "moment of inertia of the wheel about its axle"),
    Parameter("v", "m/s", 6.0, "road speed", "any"),
    Parameter("c", "N m s/rad", 0.05, "damping of the steering head", "nonnegative"),
    Parameter("g", "m/s^2", 9.81, "gravity", "any"),
)
m, R, A, C, v, c, g = (p.symbol for p in PARAMETERS)

delta, T, lean, yaw, spin = dynamicsymbols("delta T lean yaw spin")
delta_d, lean_d, yaw_d, spin_d = dynamicsymbols("delta lean yaw spin", 1)
H_x, H_y, H_z, L, D = sm.symbols("H_x H_y H_z L D")

ground = ReferenceFrame("N")  # X forward, Y to the left, Z up
heading = ReferenceFrame("Y")  # turns with the bicycle
heading.orient_axis(ground, yaw, ground.z)
frame_axes = ReferenceFrame("F")  # leans as well
frame_axes.orient_axis(heading, lean, heading.x)
fork = ReferenceFrame("S")  # is steered as well: Y along the axle
fork.orient_axis(frame_axes, delta, frame_axes.z)
wheel_axes = ReferenceFrame("W")  # spins as well
wheel_axes.orient_axis(fork, spin, fork.y)


def free_bodies() -> list[FreeBody]:
    """The wheel, cut from the fork, which holds the hub and transmits couples across the steering axis."""
    hub = Point("G")
    hub.set_vel(ground, 0)
    force = H_x * ground.x + H_y * ground.y + H_z * ground.z
    return [
        FreeBody(
            RigidBody("wheel", hub, wheel_axes, m, (inertia(fork, A, C, A), hub)),
            applied=[Force(hub, -m * g * ground.z), Torque(wheel_axes, (T - c * delta_d) * fork.z)],
            reactions=[Force(hub, force), Torque(wheel_axes, L * fork.x + D * fork.y)],
        )
    ]


def _wheel(hub: np.ndarray, ahead: np.ndarray, up: np.ndarray, radius: float) -> list:
    """Tire, rim, spokes and hub."""
    turn = np.linspace(0.0, 2 * pi, 73)[:, None]
    circle = np.cos(turn) * ahead + np.sin(turn) * up
    rims = [hub + share * radius * circle for share in (1.0, 0.93)]
    spokes = [hub + radius * np.outer((0.08, 0.93), spoke) for spoke in circle[:-1:6]]
    return [
        *(sh.Curve(tuple(map(tuple, rim)), role="body") for rim in rims),
        *(sh.Curve(tuple(map(tuple, spoke)), role="reference") for spoke in spokes),
        sh.Disc(tuple(hub), 0.08 * radius, x_axis=tuple(ahead), y_axis=tuple(up)),
    ]


def _prescribed(hub: np.ndarray, ahead: np.ndarray, radius: float) -> list:
    """Arrows of the motions kept up from outside: spin, lean and yaw."""
    forward, left, up = map(tuple, np.eye(3))
    before = tuple(hub + 2.0 * radius * np.array(forward))
    down, right = (0.0, 0.0, -1.0), (0.0, -1.0, 0.0)
    spin = sh.MomentArrow(
        tuple(hub), 0.6 * radius, 1.2 * pi, 1.75 * pi, "$v/R$", tuple(ahead), down, role="reference"
    )
    lean = sh.MomentArrow(before, 0.4 * radius, 0.95 * pi, 0.05 * pi, "$lean$", right, up, role="reference")
    turn = sh.MomentArrow((0.0, 0.0, 0.0), 1.35 * radius, -0.7, 0.1, "$yaw$", forward, left, role="reference")
    return [spin, lean, turn]


def shapes(q: list[float], values: dict[str, float]) -> list:
    """In space, the bicycle upright and heading along X; the wheel stands on the road at the origin."""
    delta, radius = q[0], values["R"]
    forward, left, up = np.eye(3)
    ahead, axle = cos(delta) * forward + sin(delta) * left, cos(delta) * left - sin(delta) * forward
    hub, head, bar = radius * up, 2.35 * radius * up, 2.75 * radius * up
    flat = {"x_axis": tuple(forward), "y_axis": tuple(left)}

    def line(start: np.ndarray, end: np.ndarray) -> dict:
        return {"start": tuple(start), "end": tuple(end)}

    def across(middle: np.ndarray, half: float) -> list[np.ndarray]:
        return [middle - half * radius * axle, middle + half * radius * axle]

    blades, crown = across(hub, 0.16), across(head, 0.16)
    rods = [blades, crown, *zip(blades, crown, strict=True), (head, bar), across(bar, 1.1)]
    return [
        sh.Ground(**line(-1.5 * radius * forward, 2.6 * radius * forward)),
        *_wheel(hub, ahead, up, radius),
        *(sh.Link(**line(*rod)) for rod in rods),
        sh.CenterLine(**line(bar, bar + 0.9 * radius * up)),
        sh.CenterLine(**line(hub, hub + 2.4 * radius * forward), label="$X$", arrow=True),
        sh.CenterLine(**line(bar, bar + 1.3 * radius * forward)),
        sh.CenterLine(**line(bar, bar + 1.3 * radius * ahead), role="joint"),
        sh.AngleArrow(tuple(bar), 1.15 * radius, 0.0, delta, r"$\delta$", **flat),
        sh.MomentArrow(tuple(bar + 0.55 * radius * up), 0.28 * radius, -0.6 * pi, 0.7 * pi, "$T$", **flat),
        *_prescribed(hub, ahead, radius),
        sh.Label(tuple(hub - 0.75 * radius * (forward + up)), "$m,\\ R,\\ A,\\ C$", (-1.0, -0.3)),
        sh.Label(tuple(head), "$c$", (-1.0, 0.0)),
        sh.GravityArrow(
            **line(hub + radius * (1.4 * up - 1.5 * forward), hub + radius * (0.8 * up - 1.5 * forward)),
            label="$g$",
        ),
    ]


def build() -> System:
    """The wheel as a System."""
    about_x = yaw_d * sm.sin(lean) * sm.sin(delta) + lean_d * sm.cos(delta)
    about_axle = spin_d - lean_d * sm.sin(delta) + yaw_d * sm.sin(lean) * sm.cos(delta)
    about_steering = delta_d + yaw_d * sm.cos(lean)
    return System(
        key="bicycle_wheel",
        title="Front wheel of a bicycle as a gyroscope",
        field="worked example",
        description=(
            "The front wheel (mass m, radius R, C about the axle, A about a diameter) spins in its fork as the road "
            "speed v demands. The bicycle yaws by yaw (to the left) and leans by lean (to the right), both prescribed; "
            "in the bicycle the fork is steered by delta about its upright axis, to the left, with the couple T of the "
            "rider's hands and the damping c. Only moments about the hub are asked for: its own motion does not "
            "matter and is left out. L is the couple of the fork about its forward axis, D that about the axle."
        ),
        coordinates=(Coordinate(delta, "rad", "steering angle, to the left", (-pi / 2, pi / 2), "angle"),),
        parameters=PARAMETERS,
        inputs=(
            Input(T, "N m", "couple of the hands, to the left", "couple"),
            Input(lean, "rad", "lean of the bicycle, to the right", "prescribed motion"),
            Input(yaw, "rad", "heading of the bicycle, to the left", "prescribed motion"),
            Input(
                spin,
                "rad",
                "angle of the wheel in the fork",
                "drive angle",
                (v / R * dynamicsymbols._t, v / R, 0),
            ),
        ),
        kinetic_energy=A * (about_x**2 + about_steering**2) / 2 + C * about_axle**2 / 2,
        potential_energy=sm.S.Zero,
        dissipation=c * delta_d**2 / 2,
        generalized_forces={delta: T},
        frame=ground,
        free_bodies=free_bodies,
        unknowns=(H_x, H_y, H_z, L, D),
        shapes=shapes,
    )
