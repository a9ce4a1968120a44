"""W2 Three-axis telescopic manipulator: yaw, elevation and extension, the worked example of section 1.5."""

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
    Parameter("h", "m", 0.6, "height of the shoulder"),
    Parameter("m_c", "kg", 40.0, "column mass"),
    Parameter("J_c", "kg m^2", 0.9, "moment of inertia of the column about its axis"),
    Parameter("m_b", "kg", 18.0, "boom mass"),
    Parameter("a", "m", 0.4, "shoulder to the mass center of the boom"),
    Parameter("J_b", "kg m^2", 1.1, "transverse moment of inertia of the boom about its mass center"),
    Parameter("m", "kg", 6.0, "load at the tip"),
    Parameter("g", "m/s^2", 9.81, "gravity", "any"),
)
h, m_c, J_c, m_b, a, J_b, m, g = (p.symbol for p in PARAMETERS)

psi, beta, r = dynamicsymbols("psi beta r")
psi_d, beta_d, r_d = dynamicsymbols("psi beta r", 1)
M_psi, M_beta, F = dynamicsymbols("M_psi M_beta F")
G_x, G_y, G_z, C_x, C_y = sm.symbols("G_x G_y G_z C_x C_y")  # of the ground on the column
S_x, S_y, S_z, D_x, D_z = sm.symbols("S_x S_y S_z D_x D_z")  # of the column on the boom
T_y, T_z = sm.symbols("T_y T_z")  # of the boom on the load

ground = ReferenceFrame("N")  # Z up
column_axes = ReferenceFrame("A")  # X below the boom, Z up
column_axes.orient_axis(ground, psi, ground.z)
boom_axes = ReferenceFrame("B")  # X along the boom
boom_axes.orient_axis(column_axes, -beta, column_axes.y)


def free_bodies() -> list[FreeBody]:
    """Column, boom and load, cut at the bearing, at the shoulder and at the telescope."""
    foot = Point("O")
    foot.set_vel(ground, 0)
    shoulder = foot.locatenew("S", h * ground.z)
    center = shoulder.locatenew("G", a * boom_axes.x)
    tip = shoulder.locatenew("P", r * boom_axes.x)
    hold = S_x * column_axes.x + S_y * column_axes.y + S_z * column_axes.z
    twist = D_x * column_axes.x + D_z * column_axes.z
    raise_ = -M_beta * column_axes.y  # beta counts about -y
    push, carry = F * boom_axes.x, T_y * boom_axes.y + T_z * boom_axes.z
    column = FreeBody(
        RigidBody("column", foot, column_axes, m_c, (inertia(column_axes, 0, 0, J_c), foot)),
        applied=[
            Force(foot, -m_c * g * ground.z),
            Torque(column_axes, M_psi * ground.z),
            Torque(column_axes, -raise_),
        ],
        reactions=[
            Force(foot, G_x * column_axes.x + G_y * column_axes.y + G_z * column_axes.z),
            Torque(column_axes, C_x * column_axes.x + C_y * column_axes.y),
            Force(shoulder, -hold),
            Torque(column_axes, -twist),
        ],
    )
    boom = FreeBody(
        RigidBody("boom", center, boom_axes, m_b, (inertia(boom_axes, 0, J_b, J_b), center)),
        applied=[Force(center, -m_b * g * ground.z), Torque(boom_axes, raise_), Force(tip, -push)],
        reactions=[Force(shoulder, hold), Torque(boom_axes, twist), Force(tip, -carry)],
    )
    load = FreeBody(
        Particle("load", tip, m),
        applied=[Force(tip, -m * g * ground.z), Force(tip, push)],
        reactions=[Force(tip, carry)],
    )
    return [column, boom, load]


def shapes(q: list[float], values: dict[str, float]) -> list:
    """View in space with the foot of the column at the origin; thicknesses are fractions of the lengths."""
    yaw, lift, reach = q
    h, a = values["h"], values["a"]
    out, side = (cos(yaw), sin(yaw), 0.0), (-sin(yaw), cos(yaw), 0.0)
    along = (cos(lift) * out[0], cos(lift) * out[1], sin(lift))
    normal = (-sin(lift) * out[0], -sin(lift) * out[1], cos(lift))
    shoulder = (0.0, 0.0, h)

    def on_boom(x: float, z: float = 0.0) -> tuple[float, ...]:
        return tuple(s + x * u + z * n for s, u, n in zip(shoulder, along, normal, strict=True))

    tube = 0.12 * h
    level = tuple(s + 0.75 * reach * u for s, u in zip(shoulder, out, strict=True))
    return [
        sh.Polygon(
            tuple((x * h, y * h, 0.0) for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))), role="ground"
        ),
        sh.CenterLine((0.0, 0.0, 0.0), (1.5 * h, 0.0, 0.0)),
        sh.CenterLine((0.0, 0.0, 0.0), tuple(1.5 * h * u for u in out)),
        sh.Box((0.0, 0.0, 0.47 * h), (0.26 * h, 0.26 * h, 0.94 * h), axes=(out, side, (0.0, 0.0, 1.0))),
        sh.Label((0.13 * h, 0.0, 0.6 * h), "$m_c,\\ J_c$", (1.0, 0.0)),
        sh.CenterLine(shoulder, level),
        sh.Link(on_boom(0.0), on_boom(reach)),
        sh.Box(on_boom(a), (1.6 * a, tube, tube), axes=(along, side, normal)),
        sh.Label(on_boom(a, 0.5 * tube), "$m_b,\\ J_b$", (-1.0, 1.0)),
        sh.CenterOfMass(on_boom(a)),
        sh.Dimension(on_boom(0.0), on_boom(a), "$a$", offset=0.35 * h),
        sh.Particle(on_boom(reach), "$m$"),
        sh.Pin(shoulder),
        sh.Dimension((0.0, 0.0, 0.0), shoulder, "$h$", offset=0.55 * h),
        sh.AngleArrow((0.0, 0.0, 0.0), 1.2 * h, 0.0, yaw, r"$\psi$", (1.0, 0.0, 0.0), (0.0, 1.0, 0.0)),
        sh.AngleArrow(shoulder, 0.6 * reach, 0.0, lift, r"$\beta$", out, (0.0, 0.0, 1.0)),
        sh.CoordinateArrow(on_boom(0.0, -0.3 * h), on_boom(reach, -0.3 * h), "$r$", positive=along),
        sh.MomentArrow(
            (0.0, 0.0, 0.15 * h), 0.3 * h, -0.8 * pi, 0.55 * pi, r"$M_\psi$", (1.0, 0.0, 0.0), (0.0, 1.0, 0.0)
        ),
        sh.MomentArrow(shoulder, 0.3 * h, 0.6 * pi, 1.5 * pi, r"$M_\beta$", out, (0.0, 0.0, 1.0)),
        sh.ForceArrow(on_boom(reach), on_boom(reach + 0.45 * h), "$F$"),
        sh.GravityArrow((-h, -h, 1.6 * h), (-h, -h, 1.2 * h), "$g$"),
    ]


def build() -> System:
    """The manipulator as a System."""
    boom_inertia = J_b + m_b * a**2
    sweep = (boom_inertia + m * r**2) * sm.cos(beta) ** 2
    return System(
        key="manipulator",
        title="Three-axis telescopic manipulator",
        field="worked example",
        description=(
            "A column turns about its vertical axis by the yaw angle psi. A slender boom (mass m_b, mass "
            "center at the distance a, transverse moment of inertia J_b) is hinged to it at the shoulder, "
            "at the height h on the axis; its elevation beta counts upward from the horizontal. A telescope "
            "carries a load (mass m, a particle) at the distance r from the shoulder. The drives: torque "
            "M_psi of the ground on the column, torque M_beta of the column on the boom, force F of the "
            "boom on the load."
        ),
        coordinates=(
            Coordinate(psi, "rad", "yaw of the column, counter-clockwise from above", None, "ignorable"),
            Coordinate(beta, "rad", "elevation of the boom above the horizontal", (-1.4, 1.4), "angle"),
            Coordinate(r, "m", "distance of the load from the shoulder", (0.5, 2.0), "length"),
        ),
        parameters=PARAMETERS,
        inputs=(
            Input(M_psi, "N m", "yaw drive, of the ground on the column", "couple"),
            Input(M_beta, "N m", "elevation drive, of the column on the boom, upward", "couple"),
            Input(F, "N", "extension drive, of the boom on the load, outward"),
        ),
        kinetic_energy=(J_c + sweep) * psi_d**2 / 2
        + (boom_inertia + m * r**2) * beta_d**2 / 2
        + m * r_d**2 / 2,
        potential_energy=(m_b * a + m * r) * g * sm.sin(beta),
        generalized_forces={psi: M_psi, beta: M_beta, r: F},
        frame=ground,
        free_bodies=free_bodies,
        unknowns=(G_x, G_y, G_z, C_x, C_y, S_x, S_y, S_z, D_x, D_z, T_y, T_z),
        shapes=shapes,
    )
