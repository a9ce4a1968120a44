"""Exercise 4.14: the arm of a desk lamp, held by a spring against the weight of its head."""

from __future__ import annotations

from math import cos, pi, sin

import sympy as sm
from sympy.physics.vector import dynamicsymbols

from engdyn import shapes as sh
from engdyn.course.case import Setup
from engdyn.course.judging_equations import Equations
from engdyn.course.judging_expressions import Expression
from engdyn.course.judging_sets import RootSet
from engdyn.course.statics import steady_residuals
from engdyn.system import Coordinate, Parameter, System

__all__ = ["LAMP", "LAMP_EQUATION", "LAMP_ROOTS", "LAMP_STIFFNESS", "desk_lamp"]


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
            "The arm of a desk lamp turns about the hinge O. It carries the head, a particle of mass m, "
            "at the distance l; the "
            "arm itself is light. A spring (stiffness k, free length L_0) joins the anchor A, at the "
            "height h above O, "
            "to the eye B of the arm at the distance d from O. theta is the angle of the arm from the "
            "upward vertical, "
            "counter-clockwise positive; c damps the hinge. Gravity acts downward; arm and post pass each "
            "other."
        ),
        coordinates=(
            Coordinate(
                theta, "rad", "angle of the arm from the upward vertical, counter-clockwise", (-pi, pi)
            ),
        ),
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


def tilted_cosine(values: dict[str, float]) -> float:
    """cos(theta) of the tilted equilibria; beyond ±1 where there are none."""
    m, l, h, d, L_0, k, g = (values[name] for name in ("m", "l", "h", "d", "L_0", "k", "g"))
    free = 1 - m * g * l / (k * h * d)
    length = L_0 / free if free > 0 else 10 * (h + d)
    return (h**2 + d**2 - length**2) / (2 * h * d)


def lamp_stiffness(system: System) -> sm.Expr:
    """The stiffness at which the slope of the residual at theta = 0 vanishes."""
    theta = system.coordinates[0].symbol
    (k,) = (p.symbol for p in system.parameters if p.name == "k")
    (residual,) = steady_residuals(system)
    angle = sm.Dummy("angle", real=True)
    slope = residual.xreplace({theta: angle}).diff(angle).xreplace({angle: sm.S.Zero})
    # the roots that remain are those of the square (h - d)**2: taking the factor out makes them abs(h - d)
    slope = slope.replace(
        lambda e: isinstance(e, sm.Pow) and e.base.is_Add, lambda e: sm.factor(e.base) ** e.exp
    )
    slope = sm.expand(slope)
    return sm.factor_terms(-slope.coeff(k, 0) / slope.coeff(k, 1))


LAMP = Setup(desk_lamp, ("m", "l", "k"), accepted=lambda values: abs(tilted_cosine(values)) < 0.9)

_GRAVITY, _SPRING = "m*g*l*sin(theta)", "k*h*d*sin(theta)*(1 - L_0/sqrt(h**2 + d**2 - 2*h*d*cos(theta)))"
_MOTION = "m*l**2*theta_dd + c*theta_d"

LAMP_EQUATION = Equations(
    wrong=[
        (
            [f"{_MOTION} + {_GRAVITY} + {_SPRING}"],
            "The weight has the wrong sign: theta counts from the upward vertical, where the weight "
            "overturns the arm.",
        ),
        (
            [f"{_MOTION} - {_GRAVITY} - {_SPRING}"],
            "The spring has the wrong sign: it pulls the eye B back towards the anchor, against theta.",
        ),
        (
            [f"{_MOTION} - {_GRAVITY} + k*h*d*sin(theta)"],
            "The free length L_0 is left out: the force is the stiffness times the extension, not times "
            "the whole length.",
        ),
        (
            [f"{_MOTION} - {_GRAVITY} + k*d*sin(theta)*(sqrt(h**2 + d**2 - 2*h*d*cos(theta)) - L_0)"],
            "The spring is taken as vertical. Its moment about O is the force times the distance of O "
            "from the line AB.",
        ),
        (
            [f"{_MOTION} - {_GRAVITY} - k*h*d*sin(theta)*(1 - L_0/sqrt(h**2 + d**2 + 2*h*d*cos(theta)))"],
            "The cosine rule has the wrong sign: at theta = 0 eye and anchor are nearest, a distance h - "
            "d apart.",
        ),
        (
            [f"{_MOTION} - {_GRAVITY} + 2*({_SPRING})"],
            "The spring moment is twice too large: its energy is one half of stiffness times extension "
            "squared.",
        ),
        (
            [f"m*l**2*theta_dd - c*theta_d - {_GRAVITY} + {_SPRING}"],
            "The damper feeds energy in: on the left side its moment goes with theta_d, not against it.",
        ),
        ([f"m*l**2*theta_dd - {_GRAVITY} + {_SPRING}"], "The hinge damper is left out."),
    ],
    remark="Nothing was linearized: the same equation serves for every equilibrium.",
)

LAMP_ROOTS = RootSet(
    lambda case: [e.q[0] for e in case.system.equilibria(case.values)],
    unit="rad",
    wrong=[
        (
            lambda case, roots: [x for x in roots if abs(sin(x)) > 1e-6],
            "The upright and the hanging position are lost: they are the roots of sin(theta), which was "
            "divided out.",
        ),
        (
            lambda case, roots: [x for x in roots if abs(sin(x)) < 1e-6],
            "Only the factor sin(theta) is solved. The other factor fixes the length of the spring, and "
            "with it the angle.",
        ),
        (
            lambda case, roots: [x for x in roots if x > -1e-6],
            "The mirror image is lost: the lamp can lean to the right as well, and acos returns one angle "
            "only.",
        ),
        (
            lambda case, roots: [x for x in roots if abs(x) < 3.0],
            "sin(theta) has a second root in the region: the arm can hang straight down.",
        ),
        (
            lambda case, roots: [x for x in roots if abs(x) > 1e-6],
            "The upright position is missing: is it not an equilibrium of its own, stable or not?",
        ),
        (
            lambda case, roots: [x for x in roots if 1e-6 < x < 3.0],
            "One root out of several: both roots of sin(theta) and the lean to the other side are missing.",
        ),
    ],
    region=lambda case: (-pi, pi),
    remark=(
        "The length of the spring is the same in both tilted positions; mind that nothing is said of "
        "stability yet."
    ),
)

LAMP_STIFFNESS = Expression(
    lamp_stiffness,
    unit="N/m",
    wrong=[
        (
            "m*g*l/(h*d)",
            "That is the stiffness for a spring without free length, which would balance the lamp at "
            "every angle.",
        ),
        (
            "m*g*l*(h + d)/(h*d*(h + d - L_0))",
            "There the tilted positions merge with the hanging one. Take the upright one: how long is the "
            "spring then?",
        ),
        (
            "m*g*l/(d*(h - d - L_0))",
            "The lever of the spring is not d: near the upright position it is the distance of O from the "
            "line AB.",
        ),
        ("m*g/(h - d - L_0)", "These are forces along the arm. Compare moments about O for a small angle."),
        (
            "m*g*l*(h - d)/(h*d*(h - d + L_0))",
            "The free length shortens the extension: check its sign.",
        ),
        (
            "m*g*l*sqrt(h**2 + d**2)/(h*d*(sqrt(h**2 + d**2) - L_0))",
            "The spring has that length when the arm is level, not in the upright position.",
        ),
    ],
    remark="A spring stiffer than this holds the lamp upright.",
)
