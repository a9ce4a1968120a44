"""S16 Rolling ship with a passive gyro stabilizer: two very different bodies, coupled by angular momentum."""

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
    Parameter("I_s", "kg m^2", 400000.0, "ship roll inertia, added water included"),
    Parameter("W", "N", 882900.0, "displacement weight"),
    Parameter("GM", "m", 0.8, "metacentric height"),
    Parameter("m_g", "kg", 800.0, "gimbal and rotor mass"),
    Parameter("h", "m", 0.1, "gimbal mass center below O"),
    Parameter("A_x", "kg m^2", 85.0, "inertia about the gimbal's x axis"),
    Parameter("A_y", "kg m^2", 80.0, "inertia about the gimbal's y axis"),
    Parameter("C_g", "kg m^2", 25.0, "gimbal frame about its z axis"),
    Parameter("C_r", "kg m^2", 60.0, "rotor axial inertia"),
    Parameter("w_s", "rad/s", 550.0, "spin rate", "any"),
    Parameter("c_r", "N m s/rad", 25000.0, "hull roll damping", "nonnegative"),
    Parameter("c_t", "N m s/rad", 5000.0, "gimbal brake", "nonnegative"),
    Parameter("g", "m/s^2", 9.81, "gravity", "any"),
)
I_s, W, GM, m_g, h, A_x, A_y, C_g, C_r, w_s, c_r, c_t, g = (p.symbol for p in PARAMETERS)

phi, theta, M_w = dynamicsymbols("phi theta M_w")
phi_d, theta_d = dynamicsymbols("phi theta", 1)
O_x, O_y, O_z, L_y, L_z = sm.symbols("O_x O_y O_z L_y L_z")  # roll axis on the ship
G_x, G_y, G_z, B_x, B_z = sm.symbols("G_x G_y G_z B_x B_z")  # ship on the gimbal
R_x, R_y, R_s = sm.symbols("R_x R_y R_s")  # gimbal on the rotor: bearings and motor
UNKNOWNS = (O_x, O_y, O_z, L_y, L_z, G_x, G_y, G_z, B_x, B_z, R_x, R_y, R_s)

ground = ReferenceFrame("N")  # X forward, Y to port, Z up
ship_axes = ReferenceFrame("S")  # roll about X
ship_axes.orient_axis(ground, phi, ground.x)
gimbal_axes = ReferenceFrame("G")  # turns about the ship's y axis
gimbal_axes.orient_axis(ship_axes, theta, ship_axes.y)
rotor_axes = ReferenceFrame("R")  # spins as well
rotor_axes.orient_axis(gimbal_axes, w_s * dynamicsymbols._t, gimbal_axes.z)


def free_bodies() -> list[FreeBody]:
    """Ship, gimbal frame and rotor.

    The data give mass and transverse inertia of frame and rotor together: here the frame has them, and the
    rotor its axial inertia alone. The couples of bearings and motor between these two follow the data.
    """
    pivot = Point("O")
    pivot.set_vel(ground, 0)
    center = pivot.locatenew("G", -h * gimbal_axes.z)
    force = G_x * ship_axes.x + G_y * ship_axes.y + G_z * ship_axes.z
    couple = B_x * ship_axes.x + B_z * ship_axes.z
    brake = -c_t * theta_d * ship_axes.y
    spindle = R_x * gimbal_axes.x + R_y * gimbal_axes.y + R_s * gimbal_axes.z

    # The mass of the ship, whatever it is, is carried by the axis about which it rolls.
    ship = FreeBody(
        RigidBody("ship", pivot, ship_axes, 0, (inertia(ship_axes, I_s, 0, 0), pivot)),
        applied=[
            Torque(ship_axes, -W * GM * sm.sin(phi) * ground.x),
            Torque(ship_axes, -c_r * phi_d * ground.x),
            Torque(ship_axes, M_w * ground.x),
            Torque(ship_axes, -brake),
        ],
        reactions=[
            Force(pivot, O_x * ground.x + O_y * ground.y + O_z * ground.z),
            Torque(ship_axes, L_y * ground.y + L_z * ground.z),
            Force(pivot, -force),
            Torque(ship_axes, -couple),
        ],
    )
    own = inertia(gimbal_axes, A_x - m_g * h**2, A_y - m_g * h**2, C_g)
    gimbal = FreeBody(
        RigidBody("gimbal", center, gimbal_axes, m_g, (own, center)),
        applied=[Force(center, -m_g * g * ground.z), Torque(gimbal_axes, brake)],
        reactions=[Force(pivot, force), Torque(gimbal_axes, couple), Torque(gimbal_axes, -spindle)],
    )
    rotor = FreeBody(
        RigidBody("rotor", pivot, rotor_axes, 0, (inertia(gimbal_axes, 0, 0, C_r), pivot)),
        reactions=[Torque(rotor_axes, spindle)],
    )
    return [ship, gimbal, rotor]


def shapes(q: list[float], values: dict[str, float]) -> list:
    """In space, O at the origin: the gimbal, drawn large, before a cross-section of the hull."""
    phi, theta = q
    h, GM = values["h"], values["GM"]
    u = max(GM, 4.0 * h)
    turned = 0.44  # of the ship in the picture: it shows more of its bow
    X, Y, Z = np.array([[cos(turned), -sin(turned), 0.0], [sin(turned), cos(turned), 0.0], [0.0, 0.0, 1.0]])
    y, up = cos(phi) * Y + sin(phi) * Z, cos(phi) * Z - sin(phi) * Y  # axes of the ship
    aft, port, at, origin = -0.9 * u * X, 2.6 * u * Y, tuple, (0.0, 0.0, 0.0)
    return [
        *_hull(u, GM, aft, y, up),
        sh.CenterLine(at(aft - port), at(aft + port)),
        sh.VectorArrow(at(aft - 0.1 * u * up), at(aft - 0.1 * u * up - 0.8 * u * Z), "$W$", role="force"),
        sh.CenterLine(origin, at(2.2 * u * X), "$X$", arrow=True),
        sh.CenterLine(origin, at(1.9 * u * Z), "$Z$", arrow=True),
        sh.CenterLine(origin, at(1.75 * u * up)),
        sh.CenterLine(at(-1.6 * u * y), at(1.6 * u * y), "$y'$", arrow=True),
        *(sh.Link(at(s * 0.72 * u * y), at(s * 0.95 * u * y)) for s in (-1, 1)),
        *(sh.Link(at(s * 0.95 * u * y), at(s * 0.95 * u * y + aft)) for s in (-1, 1)),
        *_gyro(u, h, theta, X, y, up),
        sh.AngleArrow(origin, 1.6 * u, 0.0, phi, r"$\phi$", at(Z), at(-Y)),
        sh.MomentArrow(at(1.7 * u * X), 0.3 * u, -0.7 * pi, 0.8 * pi, "$M_w$", at(Y), at(Z)),
        sh.GravityArrow(at(aft + port + 0.9 * u * Z), at(aft + port + 0.4 * u * Z), "$g$"),
    ]


def _hull(u: float, GM: float, aft: np.ndarray, y: np.ndarray, up: np.ndarray) -> list:
    """A cross-section with its mass center and its metacenter."""
    half = [(1.6, 1.2), (1.55, -0.3), (1.35, -0.75), (0.8, -1.0), (0.0, -1.05)]
    section = half + [(-across, above) for across, above in reversed(half[:-1])]
    G, M, aside = aft - 0.1 * u * up, aft + (GM - 0.1 * u) * up, 0.3 * u * y
    return [
        sh.Polygon(tuple(tuple(aft + u * (a * y + b * up)) for a, b in section), role="ground"),
        sh.Label(tuple(aft - 1.1 * u * y + 0.6 * u * up), "$I_s,\\ c_r$"),
        sh.Curve((tuple(G), tuple(M)), role="parameter"),
        sh.CenterOfMass(tuple(G)),
        sh.Pin(tuple(M), role="parameter"),
        sh.Dimension(tuple(G + aside), tuple(M + aside), "$G_M$"),
    ]


def _gyro(u: float, h: float, theta: float, X: np.ndarray, y: np.ndarray, up: np.ndarray) -> list:
    """Frame and rotor of the gimbal, turned by theta about y."""
    x, axis = cos(theta) * X - sin(theta) * up, cos(theta) * up + sin(theta) * X
    end, thick, at, origin = 0.72 * u * axis, 0.09 * u * axis, tuple, (0.0, 0.0, 0.0)
    turn = np.linspace(0.0, 2 * pi, 61)[:, None]
    plane = {"x_axis": tuple(x), "y_axis": tuple(y)}
    about_y = {"x_axis": tuple(up), "y_axis": tuple(X)}
    return [
        sh.CenterLine(origin, at(1.3 * u * axis), "$z''$", arrow=True),
        sh.Curve(tuple(map(tuple, 0.72 * u * (np.cos(turn) * y + np.sin(turn) * axis))), role="link"),
        sh.Label(at(-end), "$m_g,\\ A_x,\\ A_y,\\ C_g$", (0.6, -1.0)),
        sh.Link(at(-end), at(end)),
        sh.Disc(at(-thick), 0.5 * u, **plane),
        sh.Disc(at(thick), 0.5 * u, **plane),
        sh.Curve((at(thick), at(end)), role="joint"),
        sh.Label(at(0.4 * u * x), "$C_r$"),
        sh.CenterOfMass(at(-h * axis)),
        sh.Dimension(origin, at(-h * axis), "$h$", offset=0.55 * u),
        sh.MomentArrow(at(0.5 * u * axis), 0.2 * u, -0.9 * pi, 0.5 * pi, "$w_s$", **plane, role="reference"),
        sh.AngleArrow(origin, 1.15 * u, 0.0, theta, r"$\theta$", **about_y),
        sh.TorsionalDamper(at(0.85 * u * y), 0.2 * u, -pi / 2, theta + pi / 2, "$c_t$", **about_y),
    ]


def build() -> System:
    """The ship with its stabilizer as a System."""
    about_z = phi_d * sm.sin(theta)  # of the gimbal frame
    return System(
        number=16,
        key="ship_gyro_stabilizer",
        title="Ship roll with a passive gyro stabilizer",
        field="marine",
        description=(
            "A ship (inertia I_s) rolls by phi about a fixed longitudinal axis X, positive with the "
            "starboard side down (X forward, Y to port, Z up). A gimbal frame turns by theta about the "
            "ship's transverse axis through the point O of the roll axis. It carries a rotor that spins at "
            "the constant rate w_s about the gimbal's z axis, vertical in the upright position. The gimbal "
            "is a pendulum: its mass center, the rotor included (mass m_g), hangs h below O. Its moments of "
            "inertia about O are A_x and A_y (rotor included), C_g about z (frame alone); C_r is the axial "
            "one of the rotor. Buoyancy rights the ship with the moment W GM sin(phi). The hull damps the "
            "roll (c_r), a brake damps the gimbal (c_t). Waves act with the moment M_w about X."
        ),
        measured="roll gyro and gimbal encoder in a seaway, stabilizer on and off: spectra and coherence",
        coordinates=(
            Coordinate(phi, "rad", "roll, starboard down", (-pi, pi), "angle"),
            Coordinate(theta, "rad", "gimbal angle about the ship's y axis", (-pi, pi), "angle"),
        ),
        parameters=PARAMETERS,
        inputs=(Input(M_w, "N m", "wave moment about X", "couple"),),
        kinetic_energy=(
            I_s * phi_d**2 / 2
            + A_x * (phi_d * sm.cos(theta)) ** 2 / 2
            + A_y * theta_d**2 / 2
            + C_g * about_z**2 / 2
            + C_r * (w_s + about_z) ** 2 / 2
        ),
        potential_energy=-W * GM * sm.cos(phi) - m_g * g * h * sm.cos(phi) * sm.cos(theta),
        dissipation=c_r * phi_d**2 / 2 + c_t * theta_d**2 / 2,
        generalized_forces={phi: M_w},
        frame=ground,
        free_bodies=free_bodies,
        unknowns=UNKNOWNS,
        shapes=shapes,
        pose=(0.3, 0.4),
    )
