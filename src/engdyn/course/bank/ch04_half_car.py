"""Exercise 4.13: loads and pitch of a half car (S23) at rest."""

from __future__ import annotations

import sympy as sm

from engdyn.course.case import Setup
from engdyn.course.judging_expressions import Expression
from engdyn.course.statics import linear_solution, small_angle, steady_residuals
from engdyn.system import System
from engdyn.systems.library import load

__all__ = ["HALF_CAR", "PITCH", "TIRE_LOAD"]


def half_car_at_rest(system: System) -> dict[sm.Expr, sm.Expr]:
    """Coordinates of the half car at rest, for small pitch."""
    symbols = [c.symbol for c in system.coordinates]
    theta = symbols[1]
    return linear_solution([small_angle(row, theta) for row in steady_residuals(system)], symbols)


def front_tire_load(system: System) -> sm.Expr:
    """Force of the road on the front tire, upward."""
    height = {c.name: c.symbol for c in system.coordinates}["zf"]
    stiffness = {p.name: p.symbol for p in system.parameters}["k_tf"]
    return sm.cancel(-stiffness * half_car_at_rest(system)[height])


def pitch_at_rest(system: System) -> sm.Expr:
    """Pitch angle of the half car at rest, nose up."""
    return sm.cancel(half_car_at_rest(system)[system.coordinates[1].symbol])


HALF_CAR = Setup(lambda: load("S23"), ("m_s", "a", "b", "m_f", "m_r", "k_f", "k_r", "k_tf", "k_tr"))

TIRE_LOAD = Expression(
    front_tire_load,
    unit="N",
    wrong=[
        (
            "m_s*g*a/(a + b) + m_f*g",
            "The lever is the wrong one: take moments about the rear axle. The nearer axle carries more "
            "of the body.",
        ),
        (
            "m_s*g*b/(a + b)",
            "That is the force in the suspension. The tire also carries what is below the suspension.",
        ),
        (
            "m_s*g*a/(a + b)",
            "The lever is the wrong one, and the tire also carries what is below the suspension.",
        ),
        ("m_s*g/2 + m_f*g", "The body's weight is shared in halves only if G lies midway between the axles."),
        (
            "(m_s + m_f + m_r)*g*b/(a + b)",
            "The wheels' weights do not pass through the body: each goes straight into its own tire.",
        ),
        (
            "k_f/(k_f + k_r)*m_s*g + m_f*g",
            "Stiffness does not share the load here: the body tilts until the moments about G vanish. Use "
            "statics alone.",
        ),
        ("m_s*g*b/(a + b) - m_f*g", "The weight of the wheel presses on the tire too: check its sign."),
    ],
    remark="No stiffness in it: the structure is statically determinate, so loads come before deflections.",
)

PITCH = Expression(
    pitch_at_rest,
    unit="rad",
    also=[
        "asin((m_s*g*a/(a + b)*(1/k_r + 1/k_tr) + m_r*g/k_tr - m_s*g*b/(a + b)*(1/k_f + 1/k_tf) - "
        "m_f*g/k_tf)/(a + b))"
    ],
    wrong=[
        (
            "-(m_s*g*a/(a + b)*(1/k_r + 1/k_tr) + m_r*g/k_tr - m_s*g*b/(a + b)*(1/k_f + 1/k_tf) - "
            "m_f*g/k_tf)/(a + b)",
            "Only the sign is wrong: theta is positive nose up, so a deeper sag in front makes it negative.",
        ),
        (
            "m_s*g*(a/k_r - b/k_f)/(a + b)**2",
            "The tires are left out: they deflect as well, in series with the springs.",
        ),
        (
            "m_s*g*(a*(1/k_r + 1/k_tr) - b*(1/k_f + 1/k_tf))/(a + b)**2",
            "The wheels' own weights are left out: they press on the tires too.",
        ),
        (
            "(m_s*g*b/(a + b)*(1/k_r + 1/k_tr) + m_r*g/k_tr - m_s*g*a/(a + b)*(1/k_f + 1/k_tf) - "
            "m_f*g/k_tf)/(a + b)",
            "The two loads are exchanged: the axle nearer to G carries more.",
        ),
        (
            "m_s*g*(a/(k_r + k_tr) - b/(k_f + k_tf))/(a + b)**2",
            "Spring and tire stand on top of each other: their deflections add, not their stiffnesses.",
        ),
        (
            "(m_s*g/2*(1/k_r + 1/k_tr) + m_r*g/k_tr - m_s*g/2*(1/k_f + 1/k_tf) - m_f*g/k_tf)/(a + b)",
            "The weight of the body is not shared in halves: G is nearer to one axle.",
        ),
        (
            "(m_s*g*a/(a + b)*(1/k_r + 1/k_tr) + m_r*g/k_tr + m_s*g*b/(a + b)*(1/k_f + 1/k_tf) + "
            "m_f*g/k_tf)/(a + b)",
            "The sags were added. A car that sags equally at both ends does not pitch: take the difference.",
        ),
    ],
    remark="z follows from one sag and this angle; no simultaneous equations were needed.",
)
