"""Exercise 4.7: the container behind an accelerating trolley (S07)."""

from __future__ import annotations

from engdyn.course.case import Case, Setup
from engdyn.course.judging_choices import Choice
from engdyn.course.judging_numbers import Number
from engdyn.systems.library import load

__all__ = ["CRANE", "CRANE_ANGLE", "CRANE_STORY"]

DRIVE = 3700.0  # N


def crane_angle(case: Case) -> float:
    """The angle at which the container hangs below the trolley while that accelerates."""
    return min((float(e.q[1]) for e in case.system.equilibria(case.values, F=DRIVE)), key=abs)


CRANE = Setup(lambda: load("S07"), ("M_t", "m", "L", "J_G"), {"c_x": 0.0})

CRANE_ANGLE = Number(
    crane_angle,
    unit="rad",
    wrong=[
        (
            f"atan({DRIVE}/((M_t + m)*g))",
            "Only the sign is wrong. The trolley accelerates to the right and the container lags behind; "
            "theta counts "
            "counter-clockwise.",
        ),
        (
            f"-180/pi*atan({DRIVE}/((M_t + m)*g))",
            "These are degrees. Give radians, or write the unit: '... deg'.",
        ),
        (
            f"-atan({DRIVE}/(M_t*g))",
            "The force accelerates the trolley and the container together, not the trolley alone.",
        ),
        (f"-atan({DRIVE}/(m*g))", "The force accelerates the trolley as well, not only the container."),
        (
            f"-{DRIVE}/((M_t + m)*g)",
            "The tangent was taken for the angle (right for small angles only), or digits were lost: "
            "keep four.",
        ),
        (
            f"-asin({DRIVE}/((M_t + m)*g))",
            "Weight and inertia force are the two legs of the right triangle, so their ratio is a "
            "tangent, not a sine.",
        ),
        (
            "0",
            "That would be steady speed, the end of the story when c_x > 0. Here nothing brakes the "
            "trolley: it accelerates.",
        ),
        (
            f"pi - atan({DRIVE}/((M_t + m)*g))",
            "The container stands on its head above the trolley. That is an equilibrium, but not the "
            "hanging one.",
        ),
    ],
    remark="L and J_G do not matter: the container does not turn.",
)

CRANE_STORY = Choice(
    "b",
    {
        "a": (
            "The crane cannot accelerate for ever: what the trolley damper takes grows with the speed "
            "until it equals F."
        ),
        "c": "Write the equation of theta at constant speed: is there anything left in it but the weight?",
        "d": "At rest the damper exerts no force, so the drive force would be without an opponent.",
    },
    1,
    {
        2: (
            "The trolley damper is fixed to trolley and rail. It acts on the container only by way of an "
            "acceleration."
        ),
        3: (
            "The hinge damper ends the swing, but it cannot choose where: at rest its moment is zero at "
            "any angle."
        ),
    },
    remark=(
        "With c_x = 0 the neutral coordinate x has a constant acceleration, with c_x > 0 a constant speed."
    ),
)
