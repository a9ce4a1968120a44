"""S13 Trailing castor on a flexible carriage: rolling without side slip, and shimmy in a band of speeds."""

from __future__ import annotations

from collections.abc import Mapping
from math import cos, pi, sin
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
    Parameter("m_p", "kg", 3.0, "carriage mass"),
    Parameter("m", "kg", 8.0, "castor and wheel mass"),
    Parameter("J_G", "kg m^2", 0.12, "castor yaw inertia about its mass center"),
    Parameter("a", "m", 0.1, "trail: king-pin to wheel center"),
    Parameter("b", "m", 0.07, "king-pin to mass center of the castor"),
    Parameter("k_y", "N/m", 60000.0, "lateral stiffness", "nonnegative"),
    Parameter("c_y", "N s/m", 150.0, "lateral damping", "nonnegative"),
    Parameter("k_p", "N m/rad", 0.0, "centering stiffness", "nonnegative"),
    Parameter("c_p", "N m s/rad", 2.0, "shimmy damper", "nonnegative"),
    Parameter("v", "m/s", 2.0, "speed", "any"),
)
m_p, m, J_G, a, b, k_y, c_y, k_p, c_p, v = (p.symbol for p in PARAMETERS)

y, psi, F, M = dynamicsymbols("y psi F M")
y_d, psi_d = dynamicsymbols("y psi", 1)
P_x, P_y, X_v, lam = sm.symbols("P_x P_y X_v lam")

ground = ReferenceFrame("N")  # seen from above, X forward, Y to the left
castor_axes = ReferenceFrame("C")  # -X from the king-pin to the wheel, Y along the axle
castor_axes.orient_axis(ground, psi, ground.z)


def free_bodies() -> list[FreeBody]:
    """Carriage and castor; the ground holds the wheel with the side force lam along the axle."""
    passing = Point("O")  # goes along with the vehicle
    passing.set_vel(ground, v * ground.x)
    king_pin = passing.locatenew("P", y * ground.y)
    wheel = king_pin.locatenew("C", -a * castor_axes.x)
    center = king_pin.locatenew("G", -b * castor_axes.x)
    pin_force = P_x * ground.x + P_y * ground.y  # of the carriage on the castor

    carriage = FreeBody(
        Particle("carriage", king_pin, m_p),
        applied=[
            Force(king_pin, -k_y * y * ground.y),
            Force(king_pin, -c_y * y_d * ground.y),
            Force(king_pin, F * ground.y),
        ],
        reactions=[Force(king_pin, -pin_force), Force(king_pin, X_v * ground.x)],
    )
    castor = FreeBody(
        RigidBody("castor", center, castor_axes, m, (inertia(castor_axes, 0, 0, J_G), center)),
        applied=[
            Torque(castor_axes, -k_p * psi * ground.z),
            Torque(castor_axes, -c_p * psi_d * ground.z),
            Torque(castor_axes, M * ground.z),
        ],
        reactions=[Force(king_pin, pin_force), Force(wheel, lam * castor_axes.y)],
    )
    return [carriage, castor]


def steady(values: Mapping[str, float], inputs: Mapping[str, Any]) -> dict[str, Any]:
    """Running straight; a carriage without spring is held by a side force, which is solved for."""
    return {} if values["k_y"] or "F" in inputs else {"rates": {"y": 0.0}, "free": ["F"]}


def shapes(q: list[float], values: dict[str, float]) -> list:
    """View from above; the vehicle stands still in the picture. Sizes are fractions of the trail."""
    y, psi, a, b = q[0], q[1], values["a"], values["b"]
    u = max(a, b)

    def behind(along: float, across: float = 0.0) -> tuple[float, float]:
        return (-along * cos(psi) - across * sin(psi), y - along * sin(psi) + across * cos(psi))

    pin, wheel, G = (0.0, y), behind(a), behind(b)
    side, half = 1.55 * u, 0.17 * u
    fork = [behind(0.0, 0.09 * u), behind(a, 0.05 * u), behind(a, -0.05 * u), behind(0.0, -0.09 * u)]
    line = 0.95 * u
    return [
        sh.CenterLine((-1.9 * u, 0.0), (1.75 * u, 0.0), "$X$", arrow=True),
        sh.Ground((0.35 * u, side), (-0.35 * u, side)),
        sh.Ground((-0.35 * u, -side), (0.35 * u, -side)),
        sh.Spring((0.0, side), (0.0, y + half), "$k_y$", coils=6),
        sh.Damper((0.0, -side), (0.0, y - half), "$c_y$"),
        sh.Box(pin, (2.6 * half, 2.0 * half)),
        sh.Label((1.3 * half, y + half), "$m_p$", (1.0, 1.0)),
        sh.Box(wheel, (0.62 * u, 0.2 * u), angle=psi, role="ground"),
        sh.Polygon(fork),
        sh.CenterLine(behind(0.0), behind(1.75 * u)),
        sh.CenterLine(pin, (-1.6 * u, y)),
        sh.CenterOfMass(G),
        sh.Label(behind(a + 0.2 * u, 0.1 * u), "$m,\\ J_G$", (-sin(psi), cos(psi))),
        sh.Dimension(pin, wheel, "$a$", offset=0.55 * u),
        sh.Dimension(pin, G, "$b$", offset=-0.3 * u),
        sh.AngleArrow(pin, 1.5 * u, pi, pi + psi, r"$\psi$"),
        sh.TorsionalSpring(pin, 0.3 * u, psi + pi, pi / 2, "$k_p$"),
        sh.TorsionalDamper(pin, 0.3 * u, -pi / 2, psi - pi, "$c_p$"),
        sh.Pin(pin),
        sh.Label((1.3 * half, y), "$P$", (1.0, 0.4), "reference"),
        sh.CoordinateArrow((line, 0.0), (line, y), "$y$", positive=(0.0, 1.0)),
        sh.CenterLine((1.3 * half, y), (line + 0.1 * u, y)),
        sh.ForceArrow((1.0 * half, y + half), (1.0 * half, y + half + 0.55 * u), "$F$"),
        sh.MomentArrow(pin, 0.62 * u, -0.4 * pi, -0.12 * pi, "$M$"),
        sh.VectorArrow((0.8 * u, -0.75 * u), (1.45 * u, -0.75 * u), "$v$"),
        sh.Label(wheel, "$C$", (sin(psi), -cos(psi)), role="reference"),
    ]


def build() -> System:
    """The castor as a System."""
    forward, sideways = v + b * sm.sin(psi) * psi_d, y_d - b * sm.cos(psi) * psi_d  # of its mass center
    return System(
        number=13,
        key="castor_shimmy",
        title="Trailing castor with flexible king-pin: shimmy of a nose wheel",
        field="vehicles, aerospace",
        description=(
            "Seen from above, a vehicle moves along +X at the constant speed v. The carriage of its king-pin "
            "P (mass m_p) can move sideways by y, positive to the left, held by a spring k_y and a damper "
            "c_y. The castor (mass m, inertia J_G about its mass center) turns about the vertical axis "
            "through P by psi, counter-clockwise, and trails: the wheel center C lies behind P at the "
            "distance a, the mass center G at the distance b. The wheel rolls without side slip: C does not "
            "move along the axle, y' cos(psi) - v sin(psi) - a psi' = 0, which cannot be integrated. A "
            "centering spring k_p and a shimmy damper c_p act at the king-pin. Gravity is normal to the "
            "plane. A side force F acts on the carriage, a couple M on the castor; lam is the side force of "
            "the ground on the tire, X_v the force that keeps the speed."
        ),
        measured="lateral acceleration of a castor on a treadmill while the belt speed is swept",
        coordinates=(
            Coordinate(y, "m", "carriage, to the left", (-0.05, 0.05), "length"),
            Coordinate(psi, "rad", "castor angle, counter-clockwise from above", (-pi / 2, pi / 2), "angle"),
        ),
        parameters=PARAMETERS,
        inputs=(
            Input(F, "N", "side force on the carriage, to the left"),
            Input(M, "N m", "disturbing couple on the castor, counter-clockwise", "couple"),
        ),
        kinetic_energy=m_p * (v**2 + y_d**2) / 2 + m * (forward**2 + sideways**2) / 2 + J_G * psi_d**2 / 2,
        potential_energy=k_y * y**2 / 2 + k_p * psi**2 / 2,
        dissipation=c_y * y_d**2 / 2 + c_p * psi_d**2 / 2,
        generalized_forces={y: F, psi: M},
        constraints=(y_d * sm.cos(psi) - v * sm.sin(psi) - a * psi_d,),
        frame=ground,
        free_bodies=free_bodies,
        unknowns=(P_x, P_y, X_v, lam),
        steady=steady,
        shapes=shapes,
        pose=(0.03, 0.35),
    )
