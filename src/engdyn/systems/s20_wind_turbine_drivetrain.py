"""S20 Drive train of a wind turbine: four inertias, two elastic shafts and a gear stage."""

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
    Parameter("J_r", "kg m^2", 2900000.0, "rotor inertia"),
    Parameter("J_1", "kg m^2", 500.0, "gear wheel inertia (low-speed side)"),
    Parameter("J_2", "kg m^2", 3.0, "pinion inertia"),
    Parameter("J_g", "kg m^2", 60.0, "generator inertia"),
    Parameter("N", "-", 80.0, "gear ratio"),
    Parameter("K_s", "N m/rad", 100000000.0, "low-speed shaft stiffness", "nonnegative"),
    Parameter("C_s", "N m s/rad", 400000.0, "low-speed shaft damping", "nonnegative"),
    Parameter("K_h", "N m/rad", 200000.0, "high-speed shaft stiffness", "nonnegative"),
    Parameter("C_h", "N m s/rad", 20.0, "high-speed shaft damping", "nonnegative"),
    Parameter("B", "N m s/rad", 3000.0, "generator slope", "nonnegative"),
    Parameter("w_0", "rad/s", 157.08, "no-load generator speed", "any"),
    Parameter("rho", "kg/m^3", 1.225, "air density"),
    Parameter("R", "m", 35.0, "rotor radius"),
    Parameter("v", "m/s", 11.0, "wind speed", "any"),
    Parameter("q_0", "-", -0.03, "torque coefficient", "any"),
    Parameter("q_1", "-", 0.0425, "torque coefficient", "any"),
    Parameter("q_2", "-", -0.0042, "torque coefficient", "any"),
)
J_r, J_1, J_2, J_g, N, K_s, C_s, K_h, C_h, B, w_0, rho, R, v, q_0, q_1, q_2 = (p.symbol for p in PARAMETERS)

tr, tb, tg, T_w, T_e = dynamicsymbols("tr tb tg T_w T_e")
tr_d, tb_d, tg_d = dynamicsymbols("tr tb tg", 1)
F_z, W_y, W_z, P_y, P_z = sm.symbols("F_z W_y W_z P_y P_z")
r_p = sm.Symbol("r_p", positive=True)
"""Pitch radius of the pinion: the tooth force depends on it, the motion does not."""

ground = ReferenceFrame("N")  # X along the shafts from the rotor to the generator, Z up
rotor_axes, wheel_axes, pinion_axes, generator_axes = (ReferenceFrame(name) for name in "RWPG")
rotor_axes.orient_axis(ground, tr, ground.x)
wheel_axes.orient_axis(ground, tb / N, ground.x)
pinion_axes.orient_axis(ground, -tb, ground.x)  # the high-speed shaft turns the other way
generator_axes.orient_axis(ground, -tg, ground.x)

# v*(v*q + ...) for v**2*(q + .../v): the same, and defined when the wind is calm
aerodynamic = rho * sm.pi * R**3 / 2 * (q_0 * v**2 + q_1 * tr_d * R * v + q_2 * (tr_d * R) ** 2)


def _turning(name: str, center: Point, axes: ReferenceFrame, J: sm.Symbol) -> RigidBody:
    """A balanced body; whatever its mass, its bearings alone feel it, as its center stays where it is."""
    return RigidBody(name, center, axes, 0, (inertia(axes, J, 0, 0), center))


def free_bodies() -> list[FreeBody]:
    """Rotor, wheel, pinion and generator, cut at the shafts, at the teeth and at the bearings of the gears."""
    hub, wheel_center = Point("A"), Point("W")
    hub.set_vel(ground, 0)
    wheel_center.set_vel(ground, 0)
    pinion_center = wheel_center.locatenew("P", (N + 1) * r_p * ground.z)
    pinion_center.set_vel(ground, 0)
    far = pinion_center.locatenew("D", 2 * r_p * ground.x)
    far.set_vel(ground, 0)
    pitch = wheel_center.locatenew("C", N * r_p * ground.z)
    low = (K_s * (tr - tb / N) * ground.x, C_s * (tr_d - tb_d / N) * ground.x)  # on the wheel
    high = (-K_h * (tb - tg) * ground.x, -C_h * (tb_d - tg_d) * ground.x)  # on the generator
    tooth = -F_z * ground.y  # of the wheel on the pinion; positive when the wind drives

    rotor = FreeBody(
        _turning("rotor", hub, rotor_axes, J_r),
        applied=[
            Torque(rotor_axes, aerodynamic * ground.x),
            Torque(rotor_axes, T_w * ground.x),
            *(Torque(rotor_axes, -part) for part in low),
        ],
    )
    wheel = FreeBody(
        _turning("wheel", wheel_center, wheel_axes, J_1),
        applied=[Torque(wheel_axes, part) for part in low],
        reactions=[Force(pitch, -tooth), Force(wheel_center, W_y * ground.y + W_z * ground.z)],
    )
    pinion = FreeBody(
        _turning("pinion", pinion_center, pinion_axes, J_2),
        applied=[Torque(pinion_axes, -part) for part in high],
        reactions=[Force(pitch, tooth), Force(pinion_center, P_y * ground.y + P_z * ground.z)],
    )
    generator = FreeBody(
        _turning("generator", far, generator_axes, J_g),
        applied=[
            *(Torque(generator_axes, part) for part in high),
            Torque(generator_axes, B * (tg_d - w_0) * ground.x),
            Torque(generator_axes, -T_e * ground.x),
        ],
    )
    return [rotor, wheel, pinion, generator]


def shapes(q: list[float], values: dict[str, float]) -> list:
    """Side view with the hub at (0, 0): the rotor to scale, all else sized by it; gears are not to scale."""
    R = values["R"]
    tr, tb, tg = q
    wheel, pinion = 0.42 * R, 0.14 * R
    high = wheel + pinion  # height of the high-speed shaft
    at_wheel, at_generator = 1.08 * R, 2.4 * R
    spinner = [(-0.12, 0.0), (-0.06, 0.08), (0.1, 0.08), (0.1, -0.08), (-0.06, -0.08)]
    around = {"x_axis": (0.0, 1.0), "y_axis": (0.35, 0.0)}  # a turn from the top to the reader
    return [
        *(_blade(R, tr + i * 2.0 * pi / 3.0) for i in range(3)),
        *_shaft(0.0, 0.1 * R, at_wheel, R, "s"),
        *_shaft(high, at_wheel, at_generator, R, "h"),
        sh.Polygon([(R * x, R * z) for x, z in spinner]),
        *_drum(at_wheel, 0.0, 0.12 * R, wheel, tb / values["N"]),
        *_drum(at_wheel, high, 0.16 * R, pinion, -tb),
        *_drum(at_generator, high, 0.5 * R, 0.2 * R, -tg),
        sh.Label((0.03 * R, -0.35 * R), "$J_r$", (1.0, 0.0)),
        sh.Label((at_wheel - 0.06 * R, -0.6 * wheel), "$J_1$", (-1.0, 0.0)),
        sh.Label((at_wheel - 0.08 * R, high), "$J_2$", (-1.0, 1.0)),
        sh.Label((at_wheel - 0.08 * R, wheel), "$N$", (-1.0, 0.0)),
        sh.Label((at_generator, high - 0.2 * R), "$J_g,\\ B,\\ w_0$", (0.0, -1.0)),
        sh.Dimension((0.0, 0.0), (0.0, R), "$R$", offset=0.2 * R),
        sh.VectorArrow((-1.0 * R, 0.75 * R), (-0.5 * R, 0.75 * R), "$v,\\ \\rho$"),
        sh.VectorArrow((-1.0 * R, -0.7 * R), (-0.5 * R, -0.7 * R)),
        sh.Label((-0.03 * R, -0.42 * R), "$q_0,\\ q_1,\\ q_2$", (-1.0, 0.0)),
        sh.MomentArrow((-0.5 * R, 0.0), 0.24 * R, -0.3, pi, "$T_w$", **around),
        sh.AngleArrow((0.22 * R, 0.0), 0.24 * R, -0.3, pi, "$t_r$", **around),
        sh.AngleArrow((at_wheel + 0.2 * R, high), 0.24 * R, pi, -0.3, "$t_b$", **around),
        sh.AngleArrow((at_generator - 0.42 * R, high), 0.24 * R, pi, -0.3, "$t_g$", **around),
        sh.MomentArrow((at_generator + 0.4 * R, high), 0.24 * R, pi, -0.3, "$T_e$", **around),
    ]


def _blade(R: float, angle: float) -> sh.Polygon:
    """A blade, seen from the side."""
    root, tip = 0.06 * R * cos(angle), R * cos(angle)
    return sh.Polygon([(-0.03 * R, root), (0.03 * R, root), (0.015 * R, tip), (-0.015 * R, tip)])


def _drum(x: float, height: float, width: float, radius: float, angle: float) -> list:
    """A wheel, seen from the side, with marks that show how it turns."""
    marks = (angle + i * 2.0 * pi / 3.0 for i in range(3))
    levels = [height + radius * cos(mark) for mark in marks if sin(mark) > 0.15]
    lines = [sh.Link((x - width / 2, z), (x + width / 2, z), role="joint") for z in levels]
    return [sh.Box((x, height), (width, 2.0 * radius)), *lines]


def _shaft(height: float, start: float, end: float, R: float, name: str) -> list:
    """An elastic shaft: spring and damper, side by side, between two flanges."""
    low, high = height - 0.08 * R, height + 0.08 * R
    first, last = start + 0.34 * (end - start), start + 0.62 * (end - start)
    return [
        sh.Link((start, height), (first, height)),
        sh.Link((first, low), (first, high)),
        sh.Spring((first, high), (last, high), f"$K_{name}$", width=0.08 * R),
        sh.Damper((first, low), (last, low), f"$C_{name}$", width=0.07 * R),
        sh.Link((last, low), (last, high)),
        sh.Link((last, height), (end, height)),
    ]


def steady(values: Mapping[str, float], inputs: Mapping[str, Any]) -> dict[str, Any]:
    """All rates constant, tr' = tg'/N and tb' = tg', with tg' between -400 and 800 rad/s."""
    return {"bounds": {"tr_d": (-400.0 / values["N"], 800.0 / values["N"])}}


def build() -> System:
    """The drive train as a System."""
    return System(
        number=20,
        key="wind_turbine_drivetrain",
        title="Wind-turbine drive train with gear stage",
        field="energy, machines",
        description=(
            "The rotor (inertia J_r, angle tr) of a wind turbine drives a gear wheel (J_1) through the "
            "low-speed shaft (K_s, C_s). The wheel meshes with a pinion (J_2, angle tb) that turns N times "
            "as fast in the opposite sense and drives the generator (J_g, angle tg) through the high-speed "
            "shaft (K_h, C_h). Every angle is positive in the running direction of its shaft, so the wheel "
            "turns by tb/N. The wind of speed v exerts the torque rho pi R^3 v^2/2 times q_0 + q_1 lam + "
            "q_2 lam^2 on the rotor of radius R, with the tip-speed ratio lam = tr' R/v; the generator "
            "brakes with B (tg' - w_0). T_w is a torque ripple on the rotor, T_e a torque of the grid on "
            "the generator, both positive in the running direction. All bodies are balanced and their "
            "shafts horizontal, so gravity does not act. In steady operation all rates are constant."
        ),
        measured="torque of a shaft and encoder of the generator in an emergency stop: torsional ring-down",
        coordinates=(
            Coordinate(tr, "rad", "rotor angle, in the running direction", None, "ignorable"),
            Coordinate(tb, "rad", "pinion angle, in the running direction", None, "angle"),
            Coordinate(tg, "rad", "generator angle, in the running direction", None, "angle"),
        ),
        parameters=PARAMETERS,
        inputs=(
            Input(T_w, "N m", "torque ripple on the rotor, in the running direction", "couple"),
            Input(T_e, "N m", "grid torque on the generator, in the running direction", "couple"),
        ),
        kinetic_energy=J_r * tr_d**2 / 2 + (J_2 + J_1 / N**2) * tb_d**2 / 2 + J_g * tg_d**2 / 2,
        potential_energy=K_s * (tr - tb / N) ** 2 / 2 + K_h * (tb - tg) ** 2 / 2,
        dissipation=C_s * (tr_d - tb_d / N) ** 2 / 2 + C_h * (tb_d - tg_d) ** 2 / 2,
        generalized_forces={tr: aerodynamic + T_w, tg: -B * (tg_d - w_0) + T_e},
        frame=ground,
        free_bodies=free_bodies,
        unknowns=(F_z, W_y, W_z, P_y, P_z),
        steady=steady,
        shapes=shapes,
        pose=(0.0, 0.35, 0.35),
    )
