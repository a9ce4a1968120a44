"""S22 Gravity-gradient satellite in a circular orbit: which attitudes does it keep?"""

from __future__ import annotations

from collections.abc import Mapping
from math import pi
from typing import Any

import numpy as np
import sympy as sm
from sympy.physics.mechanics import Point, ReferenceFrame, RigidBody, Torque, dynamicsymbols, inertia

from engdyn import shapes as sh
from engdyn.errors import EngdynError
from engdyn.modeling.equations import EquationsOfMotion
from engdyn.modeling.newton import FreeBody, newton_euler
from engdyn.quantities import Coordinate, Input, Parameter
from engdyn.system import System
from engdyn.systems.attitudes import AttitudeSystem, matrix_321

PARAMETERS = (
    Parameter("J_1", "kg m^2", 80.0, "roll inertia"),
    Parameter("J_2", "kg m^2", 90.0, "pitch inertia"),
    Parameter("J_3", "kg m^2", 20.0, "yaw inertia"),
    Parameter("n", "rad/s", 0.0011, "orbit rate", "any"),
    Parameter("c", "N m s/rad", 0.004, "damper constant", "nonnegative"),
)
J_1, J_2, J_3, n, c = (p.symbol for p in PARAMETERS)

psi, theta, phi, tau_1, tau_2, tau_3 = dynamicsymbols("psi theta phi tau_1 tau_2 tau_3")
psi_d, theta_d, phi_d = dynamicsymbols("psi theta phi", 1)

ground = ReferenceFrame("N")
orbit = ReferenceFrame("O")  # X forward, Y against the orbit's normal, Z towards the Earth's center
orbit.orient_axis(ground, -n * dynamicsymbols._t, ground.y)
body_axes = ReferenceFrame("B")
body_axes.orient_body_fixed(orbit, (psi, theta, phi), "ZYX")


def free_bodies(axes: ReferenceFrame = body_axes) -> list[FreeBody]:
    """The satellite. Its mass center keeps to the orbit; neither that motion nor the mass matters here."""
    center = Point("G")
    center.set_vel(ground, 0)
    principal = inertia(axes, J_1, J_2, J_3)
    satellite = FreeBody(
        RigidBody("satellite", center, axes, 0, (principal, center)),
        applied=[
            Torque(axes, 3 * n**2 * orbit.z.cross(principal.dot(orbit.z))),
            Torque(axes, -c * axes.ang_vel_in(orbit)),
            Torque(axes, tau_1 * axes.x),
            Torque(axes, tau_2 * axes.y),
            Torque(axes, tau_3 * axes.z),
        ],
    )
    return [satellite]


def charts() -> tuple[EquationsOfMotion, EquationsOfMotion]:
    """Euler's equations about the body axes, with the angles 3-2-1 and with the angles 2-3-1.

    The second angles do not fail where pitch is 90 degrees; the speeds of both are the relative rates about
    the body axes, in which every attitude has the same simple mass matrix.
    """
    w_1, w_2, w_3 = speeds = dynamicsymbols("w_1 w_2 w_3")
    turning = {theta: w_2 * sm.cos(phi) - w_3 * sm.sin(phi)}
    turning[psi] = (w_2 * sm.sin(phi) + w_3 * sm.cos(phi)) / sm.cos(theta)
    turning[phi] = w_1 + turning[psi] * sm.sin(theta)
    first = newton_euler(free_bodies(), (psi, theta, phi), ground, (), speeds=speeds, kinematics=turning)

    pitch, yaw, roll = angles = dynamicsymbols("theta_2 psi_2 phi_2")
    axes = ReferenceFrame("B2")
    axes.orient_body_fixed(orbit, angles, "YZX")
    turning = {yaw: w_2 * sm.sin(roll) + w_3 * sm.cos(roll)}
    turning[pitch] = (w_2 * sm.cos(roll) - w_3 * sm.sin(roll)) / sm.cos(yaw)
    turning[roll] = w_1 - turning[pitch] * sm.sin(yaw)
    return first, newton_euler(free_bodies(axes), angles, ground, (), speeds=speeds, kinematics=turning)


def steady(values: Mapping[str, float], inputs: Mapping[str, Any]) -> dict[str, Any]:
    """At rest in the orbital frame; refused where turning about some axis leaves every equilibrium one."""
    moments = [values[name] for name in ("J_1", "J_2", "J_3")]
    if not any(inputs.values()) and (values["n"] == 0 or len(set(moments)) < 3):
        raise EngdynError(
            f"the attitudes of equilibrium are not isolated with n = {values['n']:g} rad/s and the moments of "
            f"inertia {', '.join(f'{x:g}' for x in moments)} kg m^2: give an orbit rate and three different ones"
        )
    return {}


def shapes(q: list[float], values: dict[str, float]) -> list:
    """In space, o1 to the right and o3 down to the Earth; a box with these moments of inertia, without mass."""
    psi, theta, phi = q
    orbital = np.array([[1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, -1.0]])  # rows o1, o2, o3
    axes = (orbital.T @ matrix_321(q)).T  # rows: the body axes
    yawed, pitched = orbital.T @ matrix_321([psi, 0, 0]), orbital.T @ matrix_321([psi, theta, 0])
    J = np.array([values["J_1"], values["J_2"], values["J_3"]])
    sides = np.sqrt(np.maximum(J.sum() - 2 * J, 0.02 * J.sum()))
    sides /= 0.6 * sides.max()  # the longest is 1.67 m in the picture, whatever the satellite
    long = 1.75
    at = tuple
    G, arc = at(np.zeros(3)), np.linspace(-0.3, 0.3, 31)[:, None]
    path = 9.0 * (np.sin(arc) * orbital[0] + (1.0 - np.cos(arc)) * orbital[2])
    found: list = [sh.Curve(tuple(map(at, path)), role="reference")]
    for i, axis in enumerate(orbital, 1):
        found.append(sh.CenterLine(G, at(long * axis), f"$o_{i}$", arrow=True, role="ground"))
    found.append(sh.Box(G, at(sides), axes=tuple(map(at, axes))))
    for i, axis in enumerate(axes, 1):
        others = {"x_axis": at(axes[i % 3]), "y_axis": at(axes[(i + 1) % 3])}
        found.append(sh.VectorArrow(G, at(1.3 * axis), f"${i},\\ J_{i}$", role="position"))
        found.append(sh.MomentArrow(at(1.15 * axis), 0.22, -0.7 * pi, 0.8 * pi, rf"$\tau_{i}$", **others))
    found += [
        sh.Label(at(1.9 * orbital[2]), r"$\mathrm{to\ Earth}$", (-1.0, 0.0), role="reference"),
        sh.AngleArrow(G, 1.6, 0.0, psi, r"$\psi$", at(orbital[0]), at(orbital[1])),
        sh.CenterLine(G, at(1.7 * yawed[:, 0])),
        sh.AngleArrow(G, 1.6, 0.0, theta, r"$\theta$", at(yawed[:, 0]), at(-orbital[2])),
        sh.CenterLine(G, at(1.4 * axes[0])),
        sh.CenterLine(G, at(1.7 * yawed[:, 1])),
        sh.AngleArrow(G, 1.5, 0.0, phi, r"$\phi$", at(yawed[:, 1]), at(pitched[:, 2])),
        sh.MomentArrow(
            at(2.4 * orbital[2]), 0.4, 0.0, 1.5, "$n$", at(-orbital[2]), at(orbital[0]), role="reference"
        ),
        sh.TorsionalDamper(G, 1.3, 0.0, psi, "$c$", at(orbital[0]), at(orbital[1]), role="reference"),
    ]
    return found


def kinetic_energy() -> sm.Expr:
    """From the angular velocity about the body axes, the orbit rate included."""
    s_1, c_1, s_2, c_2 = sm.sin(psi), sm.cos(psi), sm.sin(theta), sm.cos(theta)
    s_3, c_3 = sm.sin(phi), sm.cos(phi)
    about_1 = phi_d - psi_d * s_2 - n * c_2 * s_1
    about_2 = theta_d * c_3 + psi_d * s_3 * c_2 - n * (c_3 * c_1 + s_3 * s_2 * s_1)
    about_3 = -theta_d * s_3 + psi_d * c_3 * c_2 - n * (-s_3 * c_1 + c_3 * s_2 * s_1)
    return (J_1 * about_1**2 + J_2 * about_2**2 + J_3 * about_3**2) / 2


def build() -> System:
    """The satellite as a System."""
    s_2, c_2, s_3, c_3 = sm.sin(theta), sm.cos(theta), sm.sin(phi), sm.cos(phi)
    controls = enumerate((tau_1, tau_2, tau_3), 1)
    return AttitudeSystem(
        charts=charts,
        number=22,
        key="gravity_gradient_satellite",
        title="Gravity-gradient satellite in a circular orbit",
        field="aerospace",
        description=(
            "A rigid satellite with the principal moments of inertia J_1, J_2, J_3 about its body axes 1, 2, "
            "3 moves on a circular orbit at the orbit rate n. The orbital frame has o1 forward, o3 towards "
            "the Earth's center, o2 against the normal of the orbit; it turns at -n about o2. From it the "
            "attitude follows by the yaw psi about 3, the pitch theta about the new 2 and the roll phi about "
            "the new 1. Gravity acts through its gradient alone, with the torque 3 n^2 o3 x (J o3). A damper "
            "gives the torque -c times the angular velocity relative to the orbital frame, control the "
            "torques tau_1, tau_2, tau_3 about the body axes."
        ),
        measured="three gyros and a magnetometer in libration: frequencies below 1 mHz, long records",
        coordinates=(
            Coordinate(psi, "rad", "yaw about axis 3", (-pi, pi), "angle"),
            Coordinate(theta, "rad", "pitch about the turned axis 2", (-pi / 2, pi / 2), "angle"),
            Coordinate(phi, "rad", "roll about the turned axis 1", (-pi, pi), "angle"),
        ),
        parameters=PARAMETERS,
        inputs=tuple(Input(tau, "N m", f"control torque, axis {i}", "couple") for i, tau in controls),
        kinetic_energy=kinetic_energy(),
        potential_energy=3 * n**2 / 2 * (J_1 * s_2**2 + J_2 * (s_3 * c_2) ** 2 + J_3 * (c_3 * c_2) ** 2),
        dissipation=c * (psi_d**2 + theta_d**2 + phi_d**2 - 2 * phi_d * psi_d * s_2) / 2,
        generalized_forces={
            psi: -tau_1 * s_2 + tau_2 * s_3 * c_2 + tau_3 * c_3 * c_2,
            theta: tau_2 * c_3 - tau_3 * s_3,
            phi: tau_1,
        },
        frame=ground,
        free_bodies=free_bodies,
        steady=steady,
        shapes=shapes,
        pose=(0.5, 0.4, 0.35),
    )
