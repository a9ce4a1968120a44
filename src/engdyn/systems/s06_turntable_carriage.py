"""S06 Turntable with a carriage in an offset slot: a moving frame with every acceleration term."""

from __future__ import annotations

from collections.abc import Mapping
from math import cos, hypot, pi, sin
from typing import Any

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
    Parameter("J", "kg m^2", 0.8, "table inertia"),
    Parameter("m", "kg", 2.0, "carriage mass"),
    Parameter("e", "m", 0.05, "slot offset", "any"),
    Parameter("k", "N/m", 1500.0, "spring", "nonnegative"),
    Parameter("s_0", "m", 0.25, "relaxed position", "any"),
    Parameter("c_s", "N s/m", 8.0, "slot damping", "nonnegative"),
    Parameter("c_t", "N m s/rad", 0.05, "bearing damping", "nonnegative"),
    Parameter("Omega", "rad/s", 12.0, "nominal rate of the steady motion", "any"),
)
J, m, e, k, s_0, c_s, c_t, Omega = (p.symbol for p in PARAMETERS)

theta, s, M, F = dynamicsymbols("theta s M F")
theta_d, s_d = dynamicsymbols("theta s", 1)
N_s, O_x, O_y = sm.symbols("N_s O_x O_y")

ground = ReferenceFrame("N")  # seen from above, X and Y in the plane of the table
table_axes = ReferenceFrame("T")  # X along the slot
table_axes.orient_axis(ground, theta, ground.z)


def free_bodies() -> list[FreeBody]:
    """Table and carriage; whatever acts between them acts in the slot, at the lever e from O."""
    bearing = Point("O")
    bearing.set_vel(ground, 0)
    place = bearing.locatenew("P", s * table_axes.x + e * table_axes.y)
    spring = -k * (s - s_0) * table_axes.x  # all three on the carriage
    damper = -c_s * s_d * table_axes.x
    actuator = F * table_axes.x

    carriage = FreeBody(
        Particle("carriage", place, m),
        applied=[Force(place, spring), Force(place, damper), Force(place, actuator)],
        reactions=[Force(place, N_s * table_axes.y)],
    )
    # The center of the table stays where it is: whatever its mass, the bearing alone feels it.
    table = FreeBody(
        RigidBody("table", bearing, table_axes, 0, (inertia(table_axes, 0, 0, J), bearing)),
        applied=[
            Torque(table_axes, M * ground.z),
            Torque(table_axes, -c_t * theta_d * ground.z),
            Force(place, -spring),
            Force(place, -damper),
            Force(place, -actuator),
        ],
        reactions=[
            Force(place, -N_s * table_axes.y),
            Force(bearing, O_x * table_axes.x + O_y * table_axes.y),
        ],
    )
    return [carriage, table]


def steady(values: Mapping[str, float], inputs: Mapping[str, Any]) -> dict[str, Any]:
    """The table turns at the rate Omega, held by a torque that is solved for; or at the rate M leads to."""
    if "M" not in inputs:
        return {"rates": {"theta": values["Omega"]}, "free": ["M"]}
    # Without friction in the bearing a given torque does not determine the rate.
    return {} if values["c_t"] else {"rates": {"theta": values["Omega"]}}


def shapes(q: list[float], values: dict[str, float]) -> list:
    """View from above, bearing O at the origin; sizes are fractions of the larger of s_0 and e."""
    theta, s, e, s_0 = q[0], q[1], values["e"], values["s_0"]
    O, u = (0.0, 0.0), max(abs(s_0), 2.0 * abs(e), 1e-3)
    rim = max(2.1 * u, hypot(s, e) + 0.45 * u)

    def on_table(x: float, y: float) -> tuple[float, float]:
        return (x * cos(theta) - y * sin(theta), x * sin(theta) + y * cos(theta))

    def slot(x: float, y: float = 0.0) -> tuple[float, float]:
        return on_table(x, e + y)

    half, wide = 0.17 * u, 0.11 * u
    start, end = min(-0.8 * u, s - 0.8 * u), (rim**2 - (abs(e) + wide) ** 2) ** 0.5 - 0.05 * u
    circle = [(rim * cos(i * pi / 60), rim * sin(i * pi / 60)) for i in range(121)]
    rails = [slot(end, -wide), slot(start, -wide), slot(start, wide), slot(end, wide), slot(end, -wide)]
    return [
        sh.Curve(circle, role="body"),
        sh.Curve(rails),
        sh.Spring(slot(start), slot(s - half), coils=7, width=0.14 * u),
        sh.Damper(slot(end), slot(s + half), width=0.13 * u),
        sh.Label(slot(0.5 * (start + s - half), wide), "$k$", on_table(0.0, 1.0)),
        sh.Label(slot(0.5 * (end + s + half), -wide), "$c_s$", on_table(0.0, -1.0)),
        sh.Box(slot(s), (2.0 * half, 2.6 * half), angle=theta, label="$m$"),
        sh.ForceArrow(slot(s + half, 1.2 * half), slot(s + half + 0.5 * u, 1.2 * half), "$F$"),
        sh.CenterLine(O, (1.2 * rim, 0.0), "$X$", arrow=True),
        sh.CenterLine(on_table(start - 0.4 * u, 0.0), on_table(1.2 * rim, 0.0), "$x'$", arrow=True),
        sh.CenterLine(on_table(0.0, -0.25 * u), on_table(0.0, 1.15 * rim), "$y'$", arrow=True),
        sh.AngleArrow(O, 1.08 * rim, 0.0, theta, r"$\theta$"),
        sh.TorsionalDamper(O, 0.6 * u, 0.0, theta, "$c_t$"),
        sh.CoordinateArrow(slot(0.0, 0.55 * u), slot(s, 0.55 * u), "$s$", positive=on_table(1.0, 0.0)),
        sh.Dimension(slot(0.0, 0.95 * u), slot(s_0, 0.95 * u), "$s_0$"),
        sh.CenterLine(slot(start), slot(start - 0.4 * u)),
        sh.Dimension(on_table(start - 0.25 * u, 0.0), slot(start - 0.25 * u), "$e$"),
        sh.Label(on_table(0.2 * rim, -0.75 * rim), "$J$"),
        sh.MomentArrow(O, 0.42 * u, theta + 1.15 * pi, theta + 1.7 * pi, "$M$"),
        sh.MomentArrow(O, 0.72 * rim, theta + 1.15 * pi, theta + 1.35 * pi, r"$\Omega$", role="reference"),
        sh.Pin(O),
        sh.Label(on_table(-0.1 * u, -0.08 * u), "$O$", on_table(-0.7, -1.0), "reference"),
    ]


def build() -> System:
    """The turntable as a System."""
    return System(
        number=6,
        key="turntable_carriage",
        title="Pick-and-place turntable with an offset radial carriage",
        field="robotics, machines",
        description=(
            "A turntable (inertia J about its vertical axis through the fixed point O) has a straight slot, "
            "parallel to the axis x' of the table at the offset e along y'. A carriage (particle, mass m) "
            "slides in it; s is its position along x', counted from O. theta is the angle of the table, "
            "counter-clockwise from the fixed axis X as seen from above. A spring k between table and "
            "carriage is relaxed at s = s_0; c_s damps the slot, c_t the bearing. A motor turns the table "
            "with the torque M, an actuator between table and carriage pushes the carriage outward with "
            "the force F. Gravity does not act in the plane. In the steady motion the table turns at the "
            "constant rate Omega, held by M = c_t Omega."
        ),
        measured="tachometer of the table and position of the carriage: ring-down after a pick, orders",
        coordinates=(
            Coordinate(theta, "rad", "table angle, counter-clockwise from above", None, "ignorable"),
            Coordinate(s, "m", "position of the carriage along the slot, outward", (0.0, 1.0), "length"),
        ),
        parameters=PARAMETERS,
        inputs=(
            Input(M, "N m", "motor torque on the table, counter-clockwise", "couple"),
            Input(F, "N", "actuator force on the carriage, outward"),
        ),
        kinetic_energy=J * theta_d**2 / 2 + m * ((s_d - e * theta_d) ** 2 + (s * theta_d) ** 2) / 2,
        potential_energy=k * (s - s_0) ** 2 / 2,
        dissipation=c_t * theta_d**2 / 2 + c_s * s_d**2 / 2,
        generalized_forces={theta: M, s: F},
        frame=ground,
        free_bodies=free_bodies,
        unknowns=(N_s, O_x, O_y),
        steady=steady,
        shapes=shapes,
        pose=(0.45, 0.31),
    )
