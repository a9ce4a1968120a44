"""S14 Jeffcott rotor in rotating coordinates: unbalance, and damping that drives a whirl."""

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
    Parameter("m", "kg", 12.0, "disc mass"),
    Parameter("k", "N/m", 1.2e6, "shaft stiffness", "nonnegative"),
    Parameter("epsilon", "m", 5e-5, "eccentricity", "any"),
    Parameter("c_e", "N s/m", 240.0, "external damping", "nonnegative"),
    Parameter("c_i", "N s/m", 160.0, "internal damping", "nonnegative"),
    Parameter("Omega", "rad/s", 450.0, "shaft speed", "any"),
)
m, k, epsilon, c_e, c_i, Omega = (p.symbol for p in PARAMETERS)

xi, eta, F_x, F_y, drive = dynamicsymbols("xi eta F_x F_y drive")
xi_d, eta_d, drive_d = dynamicsymbols("xi eta drive", 1)
M_d = sm.Symbol("M_d")

ground = ReferenceFrame("N")  # X and Y in the plane of the disc
shaft_axes = ReferenceFrame("R")  # turns with the shaft; X from W to the mass center
shaft_axes.orient_axis(ground, drive, ground.z)


def free_bodies() -> list[FreeBody]:
    """The disc, its place and its speed through the air written in fixed axes.

    The couple M_d of the shaft keeps the disc turning. It holds the moments of the forces about G; the disc's
    own moment of inertia, felt in a run-up alone, is left out.
    """
    bearing = Point("O")
    bearing.set_vel(ground, 0)
    x = xi * sm.cos(drive) - eta * sm.sin(drive)
    y = xi * sm.sin(drive) + eta * sm.cos(drive)
    pierced = bearing.locatenew("W", x * ground.x + y * ground.y)
    center = pierced.locatenew("G", epsilon * shaft_axes.x)
    through_air = x.diff(dynamicsymbols._t) * ground.x + y.diff(dynamicsymbols._t) * ground.y
    in_shaft = xi_d * shaft_axes.x + eta_d * shaft_axes.y  # as seen by the turning shaft
    disc = FreeBody(
        RigidBody("disc", center, shaft_axes, m, (inertia(shaft_axes, 0, 0, 0), center)),
        applied=[
            Force(pierced, -k * (x * ground.x + y * ground.y)),
            Force(pierced, -c_e * through_air),
            Force(pierced, -c_i * in_shaft),
            Force(center, F_x * ground.x),
            Force(center, F_y * ground.y),
        ],
        reactions=[Torque(shaft_axes, M_d * ground.z)],
    )
    return [disc]


def shapes(q: list[float], values: dict[str, float]) -> list:
    """Seen along the shaft, greatly enlarged; beside it the shaft in its bearings, not to scale."""
    xi, eta, epsilon = q[0], q[1], values["epsilon"]
    u = max(1.4 * abs(epsilon), 3e-5)
    drive, rim = 0.45, 3.0 * u

    def turned(x: float, y: float) -> tuple[float, float]:
        return (x * cos(drive) - y * sin(drive), x * sin(drive) + y * cos(drive))

    W, G, O = turned(xi, eta), turned(xi + epsilon, eta), (0.0, 0.0)
    reach = 5.2 * u
    return [
        sh.Disc(W, rim),
        sh.Label((W[0] + 0.7 * rim * cos(2.2), W[1] + 0.7 * rim * sin(2.2)), "$m$", (0.0, 0.0)),
        sh.CenterLine(O, (reach, 0.0), "$X$", arrow=True),
        sh.CenterLine(O, (0.0, reach), "$Y$", arrow=True),
        sh.CenterLine(O, turned(reach, 0.0), "$x'$", arrow=True),
        sh.CenterLine(O, turned(0.0, reach), "$y'$", arrow=True),
        sh.MomentArrow(O, 4.4 * u, 0.0, drive, r"$\Omega\,t$", role="reference"),
        sh.CoordinateArrow(O, turned(xi, 0.0), r"$\xi$", positive=turned(1.0, 0.0)),
        sh.CoordinateArrow(turned(xi, 0.0), W, r"$\eta$", positive=turned(0.0, 1.0)),
        sh.Dimension(W, G, r"$\epsilon$", offset=0.9 * u),
        sh.Pin(O, "$O$"),
        sh.Pin(W, "$W$"),
        sh.CenterOfMass(G, "$G$"),
        sh.ForceArrow(G, (G[0] + 1.3 * u, G[1]), "$F_x$"),
        sh.ForceArrow(G, (G[0], G[1] + 1.3 * u), "$F_y$"),
        *_side_view(-7.2 * u, u),
    ]


def _side_view(x: float, u: float) -> list:
    """The bent shaft in its bearings, the disc at mid-span, the air as a dashpot."""
    bent = [(x + 0.55 * u * cos(0.1 * pi * i / 2), 0.32 * u * i) for i in range(-10, 11)]
    disc, ends = (x + 0.55 * u, 0.0), [(x, 3.2 * u * side) for side in (-1, 1)]
    return [
        sh.CenterLine((x, -3.9 * u), (x, 4.2 * u)),
        sh.Curve(bent, role="link"),
        sh.Box(disc, (2.3 * u, 0.42 * u)),
        sh.Label((x + 0.35 * u, 1.6 * u), "$k,\\ c_i$", (1.0, 0.0)),
        *(
            sh.Box((x + d * 0.3 * u, end[1]), (0.22 * u, 0.5 * u), role="ground")
            for end in ends
            for d in (-1, 1)
        ),
        sh.Ground((x - 2.3 * u, -0.6 * u), (x - 2.3 * u, 0.6 * u)),
        sh.Damper((x - 2.3 * u, 0.0), (disc[0] - 1.15 * u, 0.0), "$c_e$"),
        sh.MomentArrow(
            (x, 3.85 * u), 0.45 * u, 0.75 * pi, 2.25 * pi, r"$\Omega$", y_axis=(0.0, 0.4), role="reference"
        ),
    ]


def build() -> System:
    """The rotor as a System."""
    air = (xi_d - drive_d * eta) ** 2 + (eta_d + drive_d * xi) ** 2  # square of the speed of W
    return System(
        number=14,
        key="jeffcott_rotor",
        title="Vertical-shaft Jeffcott rotor with unbalance and internal damping",
        field="rotors",
        description=(
            "A disc (mass m) sits at mid-span of a light, vertical, elastic shaft that turns at the constant "
            "speed Omega. The axis of the shaft pierces the disc at W; the mass center G is off it by the "
            "eccentricity epsilon. In axes that turn with the shaft about the line of the bearings, W is at "
            "(xi, eta) and G at (xi + epsilon, eta). The shaft pulls W back with the stiffness k in every "
            "direction. External damping c_e (air) acts on the absolute velocity of W; internal damping c_i "
            "(the bending shaft) acts on its velocity relative to the turning axes. A force (F_x, F_y) in fixed "
            "directions can push the disc. M_d is the couple with which the shaft drives it."
        ),
        measured="two proximity probes and a key-phasor in a run-up: orbit, amplitude and phase, full spectrum",
        coordinates=(
            Coordinate(xi, "m", "W along the turning axis through G", (-1e-3, 1e-3), "length"),
            Coordinate(eta, "m", "W across it, in the sense of rotation", (-1e-3, 1e-3), "length"),
        ),
        parameters=PARAMETERS,
        inputs=(
            Input(F_x, "N", "force on the disc along the fixed axis X"),
            Input(F_y, "N", "force on the disc along the fixed axis Y"),
            Input(drive, "rad", "shaft angle", "drive angle", (Omega * dynamicsymbols._t, Omega, 0)),
        ),
        kinetic_energy=m * ((xi_d - drive_d * eta) ** 2 + (eta_d + drive_d * (xi + epsilon)) ** 2) / 2,
        potential_energy=k * (xi**2 + eta**2) / 2,
        dissipation=c_e * air / 2 + c_i * (xi_d**2 + eta_d**2) / 2,
        generalized_forces={
            xi: F_x * sm.cos(drive) + F_y * sm.sin(drive),
            eta: -F_x * sm.sin(drive) + F_y * sm.cos(drive),
        },
        frame=ground,
        free_bodies=free_bodies,
        unknowns=(M_d,),
        shapes=shapes,
        pose=(1.4e-4, 1.1e-4),
    )
