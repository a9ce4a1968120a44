"""Exercise 4.3: how far and when a flyball governor (S03) opens."""

from __future__ import annotations

from math import pi

import sympy as sm

from engdyn.course.case import Setup
from engdyn.course.judging_expressions import Expression
from engdyn.course.judging_sets import RootSet
from engdyn.course.statics import steady_residuals
from engdyn.system import System
from engdyn.systems.library import load

__all__ = ["GOVERNOR", "GOVERNOR_COSINE", "GOVERNOR_ROOTS", "GOVERNOR_SPEED"]


def governor_factor(system: System) -> sm.Poly:
    """The equilibrium equation without its factor sin(theta), as a polynomial in cos(theta)."""
    theta = system.coordinates[0].symbol
    sine, cosine = sm.symbols("sine cosine")
    (residual,) = steady_residuals(system)
    row = sm.expand(residual).xreplace({sm.sin(theta): sine, sm.cos(theta): cosine})
    return sm.Poly(sm.cancel(row / sine), cosine)


def governor_cosine(system: System) -> sm.Expr:
    """cos(theta) in the raised position."""
    slope, constant = governor_factor(system).all_coeffs()
    return sm.cancel(-constant / slope)


def governor_critical_speed(system: System) -> sm.Expr:
    """The speed at which cos(theta) of the raised position reaches 1."""
    (Omega,) = (p.symbol for p in system.parameters if p.name == "Omega")
    at_bottom = sm.Poly(governor_factor(system).eval(1), Omega)
    return sm.sqrt(sm.cancel(-at_bottom.nth(0) / at_bottom.nth(2)))


def governor_is_raised(values: dict[str, float]) -> bool:
    """Well above the critical speed, and the balls not near the top of their range."""
    lift = values["m"] * values["l"] * values["Omega"] ** 2
    return lift > 1.1 * (values["m"] + values["M_c"]) * values["g"]


GOVERNOR = Setup(lambda: load("S03"), ("m", "M_c", "l", "k", "Omega"), accepted=governor_is_raised)

GOVERNOR_COSINE = Expression(
    governor_cosine,
    unit="1",
    wrong=[
        ("1", "That is theta = 0, the root of the factor sin(theta). Asked for is the other factor's."),
        (
            "acos(((m + M_c)*g + 2*k*l)/(2*k*l + m*l*Omega**2))",
            "You give the angle itself. Asked for is its cosine: leave out the last step.",
        ),
        (
            "(2*(m + M_c)*g + k*l)/(k*l + 2*m*l*Omega**2)",
            "The spring is stretched by the travel of the collar, and the collar moves twice as far as a "
            "ball does downward.",
        ),
        (
            "((m + M_c)*g + k*l)/(k*l + m*l*Omega**2)",
            "The spring force is right, its lever is not: when theta grows, the collar rises by "
            "2*l*sin(theta) per radian.",
        ),
        (
            "((2*m + M_c)*g + 4*k*l)/(4*k*l + 2*m*l*Omega**2)",
            "The collar hangs at the depth of two links below P, so its weight has twice the lever of a "
            "ball's weight.",
        ),
        (
            "(m*g + 2*k*l)/(2*k*l + m*l*Omega**2)",
            "The weight of the collar is left out; the links hand it on to the balls.",
        ),
        (
            "((m + 2*M_c)*g + 4*k*l)/(4*k*l + m*l*Omega**2)",
            "Only one ball is counted, but both carry the same collar and the same spring.",
        ),
        (
            "((m + M_c)*g + 2*k*l)/(2*k*l - m*l*Omega**2)",
            "The term with Omega has the wrong sign: turning faster must lift the balls. In L = T - V it "
            "enters through T.",
        ),
        (
            "((m + M_c)*g + 2*k*l)/(2*k*l + 2*m*l*Omega**2)",
            "The effect of the rotation is counted twice: it belongs to T, or to an effective potential, "
            "not to both.",
        ),
        ("(m + M_c)*g/(m*l*Omega**2)", "The spring is left out; this is a governor without one."),
    ],
    remark="Below the critical speed this would exceed 1: then the raised position does not exist.",
)

GOVERNOR_SPEED = Expression(
    governor_critical_speed,
    unit="rad/s",
    wrong=[
        ("(m + M_c)*g/(m*l)", "That is the square of the speed: check the unit."),
        ("sqrt(g/l)", "That is a ball alone on its arm. Here two balls also have to lift the collar."),
        (
            "sqrt(((m + M_c)*g + 2*k*l)/(m*l))",
            "The spring cannot matter yet: it is relaxed at theta = 0, and its moment is of third order "
            "in theta there.",
        ),
        (
            "sqrt((2*m + M_c)*g/(2*m*l))",
            "The weight of the collar has too small a lever: the collar travels twice as far as a ball.",
        ),
        ("sqrt((m + 2*M_c)*g/(m*l))", "One ball alone would have to lift the whole collar: count both."),
        ("sqrt((m + M_c)*g/(2*m*l))", "The rotation is counted twice, once in T and once in V."),
    ],
    remark="The spring decides how far the governor opens, not when it begins to.",
)

GOVERNOR_ROOTS = RootSet(
    lambda case: [e.q[0] for e in case.system.equilibria(case.values)],
    unit="rad",
    wrong=[
        (
            lambda case, roots: [x for x in roots if abs(x) > 1e-6],
            "The root theta = 0 is lost: dividing by sin(theta) is allowed only where it is not zero. "
            "Factor instead.",
        ),
        (
            lambda case, roots: [x for x in roots if x > -1e-6],
            "The mirror image is lost: a cosine belongs to two angles, and the exercise admits negative "
            "ones.",
        ),
        (
            lambda case, roots: [max(roots)],
            "Two roots are lost: the one of the factor you divided by, and the mirror image that acos "
            "does not return.",
        ),
        (
            lambda case, roots: [0.0],
            "The balls can also stay out: you kept the factor sin(theta) alone. Your speed is above the "
            "critical one.",
        ),
    ],
    region=lambda case: (-pi / 2, pi / 2),
    remark="All three are equilibria; chapter 5 decides which of them the governor can keep.",
)
