"""Equations of motion: proved equal in any form, told apart without giving the right term away."""

from __future__ import annotations

import pytest
import sympy as sm
from sympy.physics.mechanics import dynamicsymbols

import engdyn as ed
from engdyn.course.case import Setup
from engdyn.course.checking import check
from engdyn.course.judging_equations import Equations
from engdyn.course.verdict import not_yet
from engdyn.errors import EngdynError

CRANE = Setup(lambda: ed.systems.load("S07"))
t, g = sm.symbols("t g")
x, theta = dynamicsymbols("x theta")
M_t, mm, L, J_G, c_x, c_h = sm.symbols("M_t m L J_G c_x c_h")
F, W = dynamicsymbols("F W")
TROLLEY = (
    (M_t + mm) * x.diff(t, 2)
    + mm * L * (theta.diff(t, 2) * sm.cos(theta) - theta.diff() ** 2 * sm.sin(theta))
    + c_x * x.diff()
    - F
    - W
)
SWING = (
    (J_G + mm * L**2) * theta.diff(t, 2)
    + mm * L * sm.cos(theta) * x.diff(t, 2)
    + c_h * theta.diff()
    + mm * g * L * sm.sin(theta)
    - W * L * sm.cos(theta)
)
MOTION = Equations(
    wrong=[
        (
            [
                "(M_t + m)*x_dd + m*L*(theta_dd*cos(theta) - theta_d^2*sin(theta)) + c_x*x_d = F + W",
                "J_G*theta_dd + m*L*cos(theta)*x_dd + c_h*theta_d + m*g*L*sin(theta) = W*L*cos(theta)",
            ],
            "The hinge moves: the moment about it needs the container's own inertia at the distance L too.",
        )
    ]
)
CRANE_TEXT = [
    "(M_t + m)*x_dd = F + W - c_x*x_d - m*L*(theta_dd*cos(theta) - theta_d^2*sin(theta))",
    "(J_G + m*L^2)*theta_dd + m*L*cos(theta)*x_dd + c_h*theta_d + m*g*L*sin(theta) = W*L*cos(theta)",
]


@pytest.mark.parametrize(
    "answer",
    [
        [TROLLEY, SWING],
        (SWING, TROLLEY),
        [-2 * SWING, TROLLEY / (M_t + mm)],
        [TROLLEY + SWING / L, SWING],
        [sm.Eq(TROLLEY + F, F), SWING / mm],
        sm.Matrix([TROLLEY, SWING]),
        sm.ImmutableMatrix([TROLLEY, SWING]),
        CRANE_TEXT,
        ed.EquationsOfMotion.from_residuals([TROLLEY, SWING], [x, theta]),
        ed.systems.load("S07").newton(),
    ],
    ids=lambda a: str(a)[:40],
)
def test_right_equations_in_any_form(answer):
    assert MOTION.judge(answer, CRANE.case("0.1"))


@pytest.mark.parametrize(
    ("answer", "words"),
    [
        ([TROLLEY, SWING - mm * L**2 * theta.diff(t, 2)], "The hinge moves"),
        ([TROLLEY + 2 * F, SWING], "Equation 1: a term with the input F has the wrong sign"),
        (
            [TROLLEY, SWING - 2 * mm * g * L * sm.sin(theta)],
            "Equation 2: a weight term (with g) has the wrong sign",
        ),
        (
            [TROLLEY, SWING + mm * g * L * sm.sin(theta)],
            "Equation 2: a weight term (with g) has a wrong constant",
        ),
        ([TROLLEY, SWING - c_h * theta.diff()], "a term with rates (a damper?) is missing"),
        (
            [TROLLEY + mm * L * theta.diff() ** 2 * sm.sin(theta), SWING],
            "squares or products of rates is missing",
        ),
        ([TROLLEY, SWING + mm * L * x.diff() * theta.diff()], "squares or products of rates stands there"),
        ([TROLLEY, SWING.subs(sm.sin(theta), theta).subs(sm.cos(theta), 1)], "small angles only"),
        ([TROLLEY, SWING + mm * g * sm.sin(theta)], "Check the units"),
        ([TROLLEY, TROLLEY], "ingular"),
        ([TROLLEY], "fewer equations"),
        ([TROLLEY, SWING, SWING], "more equations"),
        ([c_x * x.diff() - F, c_h * theta.diff()], "No equation contains the acceleration x_dd"),
        ([TROLLEY**2, SWING], "accelerations"),
    ],
    ids=lambda item: str(item)[-50:],
)
def test_wrong_equations_are_told_apart_without_the_right_term(answer, words):
    case = CRANE.case("0.1")
    try:
        verdict = MOTION.judge(answer, case)
    except EngdynError as error:  # what `check` turns into a hint
        verdict = not_yet(str(error))
    assert not verdict.right
    assert words in repr(verdict)
    assert "m*g*L" not in verdict.hint
    assert "sin(" not in verdict.hint or "units" in verdict.hint


def test_a_drive_angle_may_be_written_as_its_speed():
    governor = Setup(lambda: ed.systems.load("S03"))
    text = (
        "(2*m*l^2 + 4*M_c*l^2*sin(theta)^2)*theta_dd + 4*M_c*l^2*sin(theta)*cos(theta)*theta_d^2"
        " - 2*m*l^2*Omega^2*sin(theta)*cos(theta) + 2*(m + M_c)*g*l*sin(theta)"
        " + 4*k*l^2*(1 - cos(theta))*sin(theta) + (c_p + 4*c_c*l^2*sin(theta)^2)*theta_d = 2*F*l*sin(theta)"
    )
    question, case = Equations(), governor.case("0.2")
    assert question.judge(text, case)
    assert question.judge(text.replace("Omega^2", "drive_d^2"), case)
    assert question.judge(ed.systems.load("S03").newton(), case)
    wrong = question.judge(text.replace("Omega^2", "2*Omega^2"), case)
    assert not wrong
    assert "constant factor" in wrong.hint


def test_equations_right_for_small_angles_are_called_so():
    small = "m*l**2*theta_dd + c*theta_d - m*g*l*theta + k*h*d*theta*(1 - L_0/(h - d))"
    assert "small angles only" in check("4.14", small).hint


def test_a_part_that_is_wrong_is_named_by_its_symbols():
    verdict = check("4.15", "m*x_dd + c*x_d + k*x = C*i^2/(d - x)^2*x/d")
    assert "terms with C and i" in verdict.hint
    assert "d - x" not in verdict.hint
    assert "inertia" in check("4.15", "2*m*x_dd + c*x_d + k*x = C*i^2/(d - x)^2").hint
