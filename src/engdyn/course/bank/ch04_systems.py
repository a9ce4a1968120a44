"""Two small systems of chapter 4's own: a desk lamp on a spring, and a magnet that pulls its armature."""

from __future__ import annotations

from math import cos, pi, sin

import sympy as sm
from sympy.physics.vector import dynamicsymbols

from engdyn import shapes as sh
from engdyn.system import Coordinate, Parameter, System

__all__ = ["desk_lamp", "holding_magnet"]


def desk_lamp() -> System:
    """Exercise 4.14: an arm that a spring of finite free length holds against the weight of its head."""
    parameters = (
        Parameter("m", "kg", 0.6, "mass of the head"),
        Parameter("l", "m", 0.5, "hinge O to head"),
        Parameter("h", "m", 0.3, "height of the anchor A above O"),
        Parameter("d", "m", 0.12, "hinge O to spring eye B on the arm"),
        Parameter("L_0", "m", 0.1, "free length of the spring"),
        Parameter("k", "N/m", 140.0, "spring stiffness"),
        Parameter("c", "N m s/rad", 0.05, "hinge damping", "nonnegative"),
        Parameter("g", "m/s^2", 9.81, "gravity", "any"),
    )
    m, l, h, d, L_0, k, c, g = (p.symbol for p in parameters)
    theta = dynamicsymbols("theta")
    rate = theta.diff(dynamicsymbols._t)
    length = sm.sqrt(h**2 + d**2 - 2 * h * d * sm.cos(theta))
    return System(
        key="desk_lamp",
        title="Desk lamp with a spring",
        description=(
            "The arm of a desk lamp turns about the hinge O. It carries the head, a particle of mass m, at the distance l; the "
            "arm itself is light. A spring (stiffness k, free length L_0) joins the anchor A, at the height h above O, "
            "to the eye B of the arm at the distance d from O. theta is the angle of the arm from the upward vertical, "
            "counter-clockwise positive; c damps the hinge. Gravity acts downward; arm and post pass each other."
        ),
        coordinates=(Coordinate(theta, "rad", "angle of the arm from the upward vertical, counter-clockwise", (-pi, pi)),),
        parameters=parameters,
        kinetic_energy=m * l**2 * rate**2 / 2,
        potential_energy=m * g * l * sm.cos(theta) + k * (length - L_0) ** 2 / 2,
        dissipation=c * rate**2 / 2,
        shapes=_draw_lamp,
    )


def _draw_lamp(q: list[float], values: dict[str, float]) -> list:
    """Post, arm with head, spring."""
    (theta,), (l, h, d) = q, (values[name] for name in ("l", "h", "d"))
    along = (-sin(theta), cos(theta))  # from the hinge to the head
    head, eye, anchor = (l * along[0], l * along[1]), (d * along[0], d * along[1]), (0.0, h)
    side = (cos(theta), sin(theta))
    return [
        sh.CenterLine((0.0, 0.0), (0.0, 1.15 * l)),
        sh.Support((0.0, 0.0)),
        sh.Link((0.0, 0.0), head),
        sh.Spring(anchor, eye, "$k, L_0$"),
        sh.Pin((0.0, 0.0)),
        sh.Label((0.0, 0.0), "$O, c$", (1.0, -0.3)),
        sh.Pin(anchor),
        sh.Label(anchor, "$A$", (1.0, 0.0)),
        sh.Pin(eye),
        sh.Label(eye, "$B$", side),
        sh.Particle(head, "$m$"),
        sh.Dimension((0.0, 0.0), head, "$l$", 0.16 * l),
        sh.Dimension((0.0, 0.0), eye, "$d$", -0.1 * l),
        sh.Dimension((0.0, h), (0.0, 0.0), "$h$", 0.3 * l),
        sh.AngleArrow((0.0, 0.0), 0.85 * l, pi / 2, pi / 2 + theta, r"$\theta$"),
        sh.GravityArrow((0.7 * l, l), (0.7 * l, 0.75 * l), "$g$"),
    ]


def holding_magnet() -> System:
    """Exercise 4.15: an armature on a spring, attracted the stronger the nearer it comes."""
    parameters = (
        Parameter("m", "kg", 0.15, "mass of the armature"),
        Parameter("k", "N/m", 800.0, "spring stiffness"),
        Parameter("c", "N s/m", 2.0, "damping", "nonnegative"),
        Parameter("d", "m", 0.012, "air gap with the spring relaxed"),
        Parameter("C", "N m^2/A^2", 4.0e-5, "strength of the magnet"),
        Parameter("i", "A", 1.9, "coil current", "any"),
    )
    m, k, c, d, C, i = (p.symbol for p in parameters)
    x = dynamicsymbols("x")
    rate = x.diff(dynamicsymbols._t)
    return System(
        key="holding_magnet",
        title="Holding magnet and its armature",
        description=(
            "An armature of mass m slides without friction on a horizontal guide. A spring k, relaxed at x = 0, and a damper c "
            "join it to the frame on its left. A magnet on its right, across an air gap that is d wide at x = 0, "
            "attracts it with the force C*i^2/gap^2, where i is the coil current. x is the travel of the armature "
            "towards the magnet. The guide is horizontal, so gravity plays no part."
        ),
        coordinates=(Coordinate(x, "m", "travel of the armature towards the magnet", (0.0, 0.01), "length"),),
        parameters=parameters,
        kinetic_energy=m * rate**2 / 2,
        potential_energy=k * x**2 / 2 - C * i**2 / (d - x),
        dissipation=c * rate**2 / 2,
        shapes=_draw_magnet,
    )


def _draw_magnet(q: list[float], values: dict[str, float]) -> list:
    """Wall with spring and damper, armature on its guide, magnet."""
    (x,), d = q, values["d"]
    wall, width, height = -2.4 * d, 0.5 * d, 1.1 * d
    face = x + 0.0  # right face of the armature; it starts at 0, the magnet's face is at d
    left, middle = face - width, face - width / 2
    return [
        sh.Ground((wall, -0.7 * d), (wall, 0.8 * d)),
        sh.Ground((1.7 * d, -0.6 * d), (wall, -0.6 * d)),
        sh.Spring((wall, 0.28 * d), (left, 0.28 * d), "$k$"),
        sh.Damper((wall, -0.25 * d), (left, -0.25 * d), "$c$"),
        sh.Box((middle, 0.0), (width, height), 0.0, "$m$"),
        sh.Box((1.3 * d, 0.0), (0.6 * d, height), 0.0, "$C, i$", role="ground"),
        sh.CenterLine((0.0, 0.55 * d), (0.0, 1.1 * d)),
        sh.CoordinateArrow((0.0, 0.75 * d), (face, 0.75 * d), "$x$", (1.0, 0.0)),
        sh.Dimension((0.0, 1.0 * d), (d, 1.0 * d), "$d$", 0.1 * d),
        sh.CenterLine((d, 0.55 * d), (d, 1.3 * d)),
    ]
