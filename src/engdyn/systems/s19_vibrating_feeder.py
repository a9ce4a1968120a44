"""S19 Vibrating feeder: a trough on rubber mounts, shaken by a turning eccentric mass."""

from __future__ import annotations

from collections.abc import Mapping
from math import cos, sin
from typing import Any

import sympy as sm
from sympy.physics.mechanics import (
    Force,
    Particle,
    Point,
    ReferenceFrame,
    RigidBody,
    dynamicsymbols,
    inertia,
)

from engdyn import shapes as sh
from engdyn.modeling.newton import FreeBody
from engdyn.quantities import Coordinate, Input, Parameter
from engdyn.system import System

PARAMETERS = (
    Parameter("m", "kg", 280.0, "trough mass"),
    Parameter("J", "kg m^2", 60.0, "trough inertia about its mass center"),
    Parameter("a", "m", 0.7, "mass center to mount 1"),
    Parameter("b", "m", 0.9, "mass center to mount 2"),
    Parameter("h", "m", 0.25, "mounts below the mass center"),
    Parameter("k_v", "N/m", 90000.0, "vertical stiffness of mount 1", "nonnegative"),
    Parameter("k_v2", "N/m", 60000.0, "vertical stiffness of mount 2", "nonnegative"),
    Parameter("k_h", "N/m", 30000.0, "horizontal stiffness of each mount", "nonnegative"),
    Parameter("c_v", "N s/m", 400.0, "vertical damping of each mount", "nonnegative"),
    Parameter("c_h", "N s/m", 150.0, "horizontal damping of each mount", "nonnegative"),
    Parameter("m_u", "kg", 10.0, "eccentric mass"),
    Parameter("r_u", "m", 0.08, "eccentric radius", "nonnegative"),
    Parameter("Omega", "rad/s", 100.0, "exciter speed", "any"),
    Parameter("e_x", "m", 0.2, "exciter ahead of the mass center", "any"),
    Parameter("e_y", "m", 0.3, "exciter above the mass center", "any"),
    Parameter("g", "m/s^2", 9.81, "gravity", "any"),
)
m, J, a, b, h, k_v, k_v2, k_h, c_v, c_h, m_u, r_u, Omega, e_x, e_y, g = (p.symbol for p in PARAMETERS)

x, y, phi, F_m, drive = dynamicsymbols("x y phi F_m drive")
x_d, y_d, phi_d, drive_d = dynamicsymbols("x y phi drive", 1)
B_x, B_y = sm.symbols("B_x B_y")

ground = ReferenceFrame("N")  # X right, Y up
trough_axes = ReferenceFrame("B")
trough_axes.orient_axis(ground, phi, ground.z)

# Displacements of the two mounted points from their unloaded places
sine, cosine = sm.sin(phi), sm.cos(phi)
right_1, up_1 = x - a * cosine + h * sine + a, y - a * sine - h * cosine + h
right_2, up_2 = x + b * cosine + h * sine - b, y + b * sine - h * cosine + h
right_1_d, up_1_d = x_d + (a * sine + h * cosine) * phi_d, y_d + (-a * cosine + h * sine) * phi_d
right_2_d, up_2_d = x_d + (-b * sine + h * cosine) * phi_d, y_d + (b * cosine + h * sine) * phi_d


def free_bodies() -> list[FreeBody]:
    """Trough and eccentric mass, cut at the bearing of the exciter."""
    origin = Point("O")
    origin.set_vel(ground, 0)
    center = origin.locatenew("G", x * ground.x + y * ground.y)
    mount_1 = center.locatenew("P_1", -a * trough_axes.x - h * trough_axes.y)
    mount_2 = center.locatenew("P_2", b * trough_axes.x - h * trough_axes.y)
    bearing = center.locatenew("E", e_x * trough_axes.x + e_y * trough_axes.y)
    place = bearing.locatenew("U", r_u * (sm.cos(drive) * ground.x + sm.sin(drive) * ground.y))
    bearing_force = B_x * ground.x + B_y * ground.y  # of the trough on the eccentric mass

    trough = FreeBody(
        RigidBody("trough", center, trough_axes, m, (inertia(trough_axes, 0, 0, J), center)),
        applied=[
            Force(center, -m * g * ground.y),
            Force(center, F_m * ground.y),
            Force(mount_1, -k_h * right_1 * ground.x),
            Force(mount_1, -c_h * right_1_d * ground.x),
            Force(mount_1, -k_v * up_1 * ground.y),
            Force(mount_1, -c_v * up_1_d * ground.y),
            Force(mount_2, -k_h * right_2 * ground.x),
            Force(mount_2, -c_h * right_2_d * ground.x),
            Force(mount_2, -k_v2 * up_2 * ground.y),
            Force(mount_2, -c_v * up_2_d * ground.y),
        ],
        reactions=[Force(bearing, -bearing_force)],
    )
    eccentric = FreeBody(
        Particle("eccentric mass", place, m_u),
        applied=[Force(place, -m_u * g * ground.y)],
        reactions=[Force(place, bearing_force)],
    )
    return [eccentric, trough]


UP, RIGHT = (0.0, 1.0), (1.0, 0.0)


def shapes(q: list[float], values: dict[str, float]) -> list:
    """Side view, the unloaded mass center at (0, 0); the outline of the trough is a fraction of a + b."""
    x, y, phi = q
    a, b, h, r_u = (values[name] for name in ("a", "b", "h", "r_u"))
    e_x, e_y, u = values["e_x"], values["e_y"], values["a"] + values["b"]

    def body(along: float, up: float) -> tuple[float, float]:
        return (x + along * cos(phi) - up * sin(phi), y + along * sin(phi) + up * cos(phi))

    G, E, top = body(0.0, 0.0), body(e_x, e_y), max(0.13 * u, 0.1 * u - h)
    trough = [(-a, -h), (b, -h), (b + 0.07 * u, top), (-a - 0.04 * u, top)]
    pedestal = [(e_x - 0.09 * u, 0.6 * top), (e_x + 0.09 * u, 0.6 * top), (e_x, e_y)]
    low, high = -h - 0.035 * u, max(e_y, top) + 0.38 * u
    return [
        *_mount(body(-a, -h), (-a, -h), u, -1.0, "k_v"),
        *_mount(body(b, -h), (b, -h), u, 1.0, "k_{v2}"),
        sh.Polygon([body(*point) for point in pedestal]),
        sh.Polygon([body(*point) for point in trough]),
        sh.Pin(body(-a, -h)),
        sh.Pin(body(b, -h)),
        sh.Label(body(0.72 * b, -0.5 * h), "$m,\\ J$"),
        *_exciter(E, r_u, u),
        sh.CenterLine(body(-0.3 * u, 0.0), body(0.42 * u, 0.0), role="coordinate"),
        sh.CenterLine(G, (G[0] + 0.42 * u, G[1]), role="coordinate"),
        sh.AngleArrow(G, 0.37 * u, 0.0, phi, r"$\phi$"),
        sh.CenterOfMass(G, "$G$"),
        sh.Dimension(body(-a, low), body(0.0, low), "$a$"),
        sh.Dimension(body(0.0, low), body(b, low), "$b$"),
        sh.CenterLine(G, body(0.0, low - 0.03 * u), role="parameter"),
        sh.Dimension(body(-0.24 * u, -h), body(-0.24 * u, 0.0), "$h$"),
        sh.Dimension(body(0.0, e_y), E, "$e_x$", offset=0.16 * u),
        sh.Dimension(G, body(0.0, e_y), "$e_y$", offset=0.09 * u),
        sh.ForceArrow(G, (G[0], G[1] + 0.22 * u), "$F_m$"),
        sh.CoordinateArrow((0.0, high), (x, high), "$x$", positive=RIGHT),
        sh.CoordinateArrow((-a - 0.52 * u, 0.0), (-a - 0.52 * u, y), "$y$", positive=UP),
        sh.GravityArrow((b + 0.3 * u, high), (b + 0.3 * u, high - 0.18 * u), "$g$"),
    ]


def _exciter(E: tuple, r_u: float, u: float) -> list:
    """The eccentric mass, somewhere on its way."""
    mass = (E[0] + r_u * cos(0.9), E[1] + r_u * sin(0.9))
    ring = max(1.25 * r_u, 0.035 * u)
    return [
        sh.Disc(E, ring),
        sh.CenterLine(E, (E[0] + 2.6 * ring, E[1])),
        sh.Link(E, mass, role="joint"),
        sh.Particle(mass),
        sh.MomentArrow(E, 1.7 * ring, 0.0, 0.9, r"$\Omega t$", role="reference"),
        sh.Label(mass, "$m_u,\\ r_u$", (1.0, 1.0)),
        sh.Pin(E),
    ]


def _mount(point: tuple, relaxed: tuple, u: float, outward: float, stiffness: str) -> list:
    """A rubber mount as two pairs of spring and damper; ``outward`` is -1 on the left, +1 on the right."""
    wall, floor = relaxed[0] + 0.42 * outward * u, relaxed[1] - 0.4 * u
    side, foot = point[0] + 0.08 * outward * u, point[1] - 0.07 * u
    off = 0.055 * u
    inner, outer = point[0] - outward * off, point[0] + outward * off
    above, below = point[1] + off, point[1] - off
    up, down = relaxed[1] + 0.26 * u, relaxed[1] - 0.26 * u
    half = 0.2 * u
    return [
        sh.Ground((wall, up), (wall, down)) if outward > 0 else sh.Ground((wall, down), (wall, up)),
        sh.Ground((relaxed[0] - half, floor), (relaxed[0] + half, floor)),
        sh.Link(point, (side, point[1])),
        sh.Link((side, below), (side, above)),
        sh.Spring((wall, above), (side, above), coils=4, width=0.06 * u),
        sh.Label((0.5 * (wall + side), above + 0.04 * u), "$k_h$", UP),
        sh.Damper((wall, below), (side, below), width=0.055 * u),
        sh.Label((0.5 * (wall + side), below - 0.03 * u), "$c_h$", (0.0, -1.0)),
        sh.Link(point, (point[0], foot)),
        sh.Link((inner, foot), (outer, foot)),
        sh.Spring((inner, floor), (inner, foot), coils=4, width=0.06 * u),
        sh.Label((inner - 0.04 * outward * u, 0.5 * (floor + foot)), f"${stiffness}$", (-outward, 0.0)),
        sh.Damper((outer, floor), (outer, foot), width=0.055 * u),
        sh.Label((outer + 0.03 * outward * u, 0.4 * floor + 0.6 * foot), "$c_v$", (outward, 0.0)),
    ]


def steady(values: Mapping[str, float], inputs: Mapping[str, Any]) -> dict[str, Any]:
    """Mean positions, in which the weight that turns averages out: those with the exciter at rest."""
    return {"inputs": {"drive": (0.0, 0.0, 0.0)}}


def _energies() -> dict[str, Any]:
    """Energies, dissipation and generalized forces."""
    v_x = x_d - (e_x * sine + e_y * cosine) * phi_d - r_u * drive_d * sm.sin(drive)  # of the eccentric mass
    v_y = y_d + (e_x * cosine - e_y * sine) * phi_d + r_u * drive_d * sm.cos(drive)
    height = y + e_x * sine + e_y * cosine + r_u * sm.sin(drive)
    return {
        "kinetic_energy": m * (x_d**2 + y_d**2) / 2 + J * phi_d**2 / 2 + m_u * (v_x**2 + v_y**2) / 2,
        "potential_energy": (
            (m * y + m_u * height) * g
            + k_h * (right_1**2 + right_2**2) / 2
            + k_v * up_1**2 / 2
            + k_v2 * up_2**2 / 2
        ),
        "dissipation": c_h * (right_1_d**2 + right_2_d**2) / 2 + c_v * (up_1_d**2 + up_2_d**2) / 2,
        "generalized_forces": {y: F_m},
    }


def build() -> System:
    """The feeder as a System."""
    turning = (Omega * dynamicsymbols._t, Omega, sm.S.Zero)
    return System(
        number=19,
        key="vibrating_feeder",
        title="Vibrating feeder on rubber mounts with an unbalance exciter",
        field="process machines",
        description=(
            "A rigid trough (mass m, inertia J about its mass center G) moves in its vertical plane: G is "
            "displaced by x to the right and by y upward from the unloaded position, phi turns the trough "
            "counter-clockwise. Two rubber mounts hold it at the body points (-a, -h) and (b, -h), counted "
            "from G. Each resists the horizontal displacement of its point with stiffness k_h and damping "
            "c_h and the vertical one with damping c_v and stiffness k_v (mount 1) or k_v2 (mount 2). In "
            "the body point E = (e_x, e_y) turns the eccentric mass m_u at the radius r_u; its angle from "
            "X, Omega t, is absolute, so no couple of its drive acts on the trough. Gravity acts down on "
            "both masses. A material load F_m acts at G, positive up. The mean position is that in which "
            "the turning weight averages out."
        ),
        measured="four accelerometers on the trough: operating deflection shape, run-down through resonances",
        coordinates=(
            Coordinate(x, "m", "displacement of G to the right", (-0.1, 0.1), "length"),
            Coordinate(y, "m", "displacement of G, up", (-0.1, 0.1), "length"),
            Coordinate(phi, "rad", "rotation of the trough, counter-clockwise", (-1.5, 1.5), "angle"),
        ),
        parameters=PARAMETERS,
        inputs=(
            Input(F_m, "N", "material load at the mass center, positive up"),
            Input(drive, "rad", "angle of the eccentric mass from X", "drive angle", turning),
        ),
        **_energies(),
        frame=ground,
        free_bodies=free_bodies,
        unknowns=(B_x, B_y),
        steady=steady,
        shapes=shapes,
        pose=(0.06, 0.07, 0.1),
    )
