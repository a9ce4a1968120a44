"""Verdicts: right answers in any form, wrong ones with a true hint, junk without an error."""

from __future__ import annotations

import math
import subprocess
import sys
import time

import numpy as np
import pint
import pytest
import sympy as sm
from sympy.physics.mechanics import dynamicsymbols

import engdyn as ed
from engdyn.course.case import Setup
from engdyn.course.checking import check
from engdyn.course.judging_equations import Equations
from engdyn.course.judging_expressions import Expression
from engdyn.course.judging_sets import RootSet
from engdyn.course.registry import exercise, exercises
from engdyn.course.verdict import Verdict, not_yet, right, unanswered
from engdyn.errors import EngdynError

t = sm.Symbol("t")
m, M_c, l, k, Omega, g = sm.symbols("m M_c l k Omega g")
COSINE = ((m + M_c) * g + 2 * k * l) / (2 * k * l + m * l * Omega**2)

# Verdicts


def test_a_verdict_is_truthy_only_when_right():
    assert right()
    assert not not_yet("Look again.")
    assert not unanswered()
    assert not unanswered().answered
    assert not_yet("Look again.").answered


def test_a_verdict_speaks_plainly_and_escapes_what_it_shows():
    verdict = Verdict(False, True, "<script>alert(1)</script>", "4.3")
    assert repr(verdict) == "Exercise 4.3: not right yet. <script>alert(1)</script>"
    assert "<script>" not in verdict._repr_html_()
    assert "&lt;script&gt;" in verdict._repr_html_()
    assert "right" in right("Fine.")._repr_html_()


@pytest.mark.parametrize("answer", [..., [...], (1, ...), [..., ...]], ids=repr)
def test_three_dots_are_no_answer(answer):
    verdict = check("4.3", answer)
    assert not verdict.answered
    assert not verdict.right


@pytest.mark.parametrize(("id", "near"), [("4.33", "4.3"), ("4.3 x", "4.3"), ("", "4."), ("9.9", "."), ("4,3", "4.3")])
def test_an_unknown_exercise_is_named_with_its_nearest(id, near):
    with pytest.raises(EngdynError, match=r"no exercise.*nearest is") as caught:
        check(id, 1.0)
    assert near in str(caught.value)


@pytest.mark.parametrize("id", [4.3, None, 43, ["4.3"]])
def test_an_id_that_is_no_text_is_refused(id):
    with pytest.raises(EngdynError, match="id is text"):
        check(id, 1.0)


def test_the_public_names():
    code = (
        "import engdyn as ed, sys; assert 'sympy' not in sys.modules; "
        "assert not ed.course.check('4.3', ...).answered; assert isinstance(ed.course.check('4.3', 1), ed.course.Verdict); "
        "assert ed.course.exercise('4.7') in ed.course.exercises(); assert ed.course.variant('4.7')['c_x'] == 0"
    )
    subprocess.run([sys.executable, "-c", code], check=True)


# Expressions

RIGHT_COSINES = [
    COSINE,
    "((m+M_c)*g+2*k*l)/(2*k*l+m*l*Omega^2)",
    "(g*(m + M_c)/l + 2*k)/(2*k + m*Omega**2)",
    "1 - (m*l*Omega^2 - (m + M_c)*g)/(2*k*l + m*l*Omega^2)",
    "(2*k*l + g*m + g*M_c)*(2*k*l + m*l*Omega**2)^(-1)",
    "((m+M_c)*g/(2*k*l) + 1)/(1 + m*Omega**2/(2*k))",
    "-((m+M_c)*g+2*k*l)/(-2*k*l-m*l*Omega^2)",
    "(m+M_c)*g/(2*k*l+m*l*Omega^2) + 2*k/(2*k+m*Omega^2)",
    "0.5*((m+M_c)*g+2*k*l)/(k*l+0.5*m*l*Omega^2)",
    sm.expand(COSINE),
    sm.factor(COSINE),
    sm.apart(COSINE, k),
    COSINE.subs({s: sm.Symbol(s.name, positive=True) for s in COSINE.free_symbols}),
    COSINE.subs(m, sm.Symbol("m", integer=True)),
    "cos(atan(sqrt(((2*k*l+m*l*Omega^2)/((m+M_c)*g+2*k*l))^2 - 1)))",
    "sin(asin(1))*((m+M_c)*g+2*k*l)/(2*k*l+m*l*Omega^2)",
]
RIGHT_SPEEDS = [
    "sqrt((m+M_c)*g/(m*l))",
    "sqrt(g/l)*sqrt(1+M_c/m)",
    "sqrt(g/l*(1+M_c/m))",
    "((m+M_c)*g/(m*l))^0.5",
    "sqrt((m+M_c)*g)/sqrt(m*l)",
    "(m+M_c)*g/sqrt(m*l*g*(m+M_c))",
    "exp(log((m+M_c)*g/(m*l))/2)",
    "abs(-sqrt((m+M_c)*g/(m*l)))",
    "1.41421356237309505*sqrt((m+M_c)*g/(2*m*l))",
]


@pytest.mark.parametrize("answer", RIGHT_COSINES, ids=lambda a: str(a)[:60])
def test_right_cosines_in_any_form(answer):
    assert check("4.3", answer)
    assert check("4.3", answer, "ab123")


@pytest.mark.parametrize("answer", RIGHT_SPEEDS)
def test_right_speeds_in_any_form(answer):
    assert check("4.3b", answer)


@pytest.mark.parametrize(
    ("id", "answer", "words"),
    [
        ("4.3", -COSINE, "Only the sign"),
        ("4.3", 2 * COSINE, "factor 2: is something counted twice"),
        ("4.3", COSINE / 2, "factor 2: is one of two equal parts"),
        ("4.3", 3 * COSINE / 5, "right but for a constant factor"),
        ("4.3", 1.0001 * COSINE, "constant factor"),
        ("4.3", 180 / sm.pi * COSINE, "degrees and radians"),
        ("4.3", 1 / COSINE, "reciprocal"),
        ("4.3", COSINE**2, "square of"),
        ("4.3", sm.sqrt(COSINE), "square root of"),
        ("4.3", COSINE.subs(k, 200), "put in no numbers"),
        ("4.3", 0.716, "put in no numbers"),
        ("4.3", COSINE.subs(g, 10), "Check the units"),
        ("4.3", "((m+M_c)*g+2*k)/(2*k*l+m*l*Omega**2)", "2*k [kg s^-2]"),
        ("4.3", COSINE.subs(Omega, sm.sqrt(Omega)), "Check the units"),
        ("4.3", "((m+M_c)*g+3*k*l)/(3*k*l+m*l*Omega**2)", "right for k = 0"),
        ("4.3", "((m-M_c)*g+2*k*l)/(2*k*l+m*l*Omega**2)", "right for M_c = 0"),
        ("4.3", COSINE + sm.Symbol("c_p") / (m * l**2 * Omega), "does not depend on c_p"),
        ("4.3", "(m+M_c)*g/(m*g)", "does not depend on l, k, Omega and g"),
        ("4.3", "cos(theta)", "still contains theta"),
        ("4.3", dynamicsymbols("theta"), "still contains theta"),
        ("4.3", "sqrt(1 - 4*k/(k + m*Omega^2))", "no real value"),
        ("4.3b", "sqrt((m+M_c)*g/(m*l))/(2*pi)", "2 pi: hertz"),
        ("4.3b", "60/(2*pi)*sqrt((m+M_c)*g/(m*l))", "revolutions per minute"),
        ("4.3b", "-sqrt((m+M_c)*g/(m*l))", "Only the sign"),
        ("4.3b", "sqrt((m+M_c)*g/m)", "Check the units"),
        ("4.3b", "1.41421*sqrt((m+M_c)*g/(2*m*l))", "constant factor"),
        ("4.13b", "atan(asin(0.1))*m_s*g/(k_f*a)", "does not depend on b, m_f, m_r"),
        ("4.14c", "m*g*l*(h-d)/(h*d*(h-d-L_0)) + 1e-6*k", "does not depend on k"),
        ("4.15c", "sqrt(4*k*d^3/(27*C)*(1 + 0.001*sin(1)))", "constant factor"),
    ],
    ids=lambda item: str(item)[:40],
)
def test_wrong_but_close_expressions_get_a_true_hint(id, answer, words):
    verdict = check(id, answer)
    assert verdict.answered
    assert not verdict.right
    assert words in verdict.hint


def test_close_expressions_are_called_close():
    pitch = exercise("4.13b").solution()
    for almost in (sm.sin(pitch), sm.tan(pitch), sm.atan(pitch)):
        verdict = check("4.13b", almost)
        assert not verdict
        assert "close to the right one" in verdict.hint


# A potential energy is right up to a constant

POTENTIAL = Expression(
    lambda system: system.potential_energy,
    unit="J",
    of=("theta",),
    up_to_constant=True,
    wrong=[("m*g*L*cos(theta)", "Gravity acts down: V must be lowest where the container hangs.")],
)
CRANE = Setup(lambda: ed.systems.load("S07"))


@pytest.mark.parametrize(
    ("answer", "words"),
    [
        ("-m*g*L*cos(theta)", None),
        ("m*g*L*(1 - cos(theta))", None),
        ("2*m*g*L*sin(theta/2)^2 + M_t*g*L", None),
        ("m*g*L*cos(theta)", "Gravity acts down"),
        ("2*m*g*L*(1 - cos(theta))", "factor 2"),
        ("m*g*L*theta^2/2", "small angles only"),
        ("m*L*(1 - cos(theta))", "Check the units"),
        ("m*g*L*theta_d", "still contains theta_d"),
    ],
)
def test_a_potential_energy_is_judged_up_to_a_constant(answer, words):
    verdict = POTENTIAL.judge(answer, CRANE.case("0.1"))
    assert verdict.right == (words is None)
    assert words is None or words in verdict.hint


# Numbers

ANGLE = -math.atan(3700 / (3700 * 9.81))


@pytest.mark.parametrize(
    "answer",
    [
        *(ANGLE, ANGLE * 1.0009, ANGLE * 0.9991, -0.1016, np.float64(ANGLE), np.array(ANGLE), np.array([ANGLE])),
        *(sm.Float(ANGLE), sm.atan(sm.Rational(-1000, 9810)), "-0.101586", "−0.101586", "-1.01586e-1", " -.101586 "),
        *("-0.101586 rad", "-5.8204 deg", "-5.8204°", "-101.586 mrad", "-349.2 arcmin", "-101.586e-3rad"),
        *("-atan(3700/((M_t + m)*g))", "-atan(1/9.81)", "asin(-0.101411)"),
        pint.UnitRegistry().Quantity(-5.8204, "degree"),
    ],
    ids=repr,
)
def test_right_numbers_in_any_form(answer):
    assert check("4.7", answer)


@pytest.mark.parametrize(
    ("answer", "words"),
    [
        (ANGLE * 1.0011, "close"),
        (ANGLE * 0.9989, "close"),
        (ANGLE * 1.015, "close"),
        (2 * ANGLE, "too large by the factor 2"),
        (ANGLE / 2, "too small by the factor 2"),
        (-2 * ANGLE, "factor 2 and its sign is wrong"),
        (ANGLE * math.pi / 180, "degrees"),
        (ANGLE * 2 * math.pi, "2 pi"),
        (ANGLE / 2 / math.pi, "2 pi"),
        (1000 * ANGLE, "power of ten"),
        (-ANGLE / 10, "power of ten, and its sign is wrong"),
        (-math.atan(0.1), "g rounded to 10"),
        (-0.5, "too large in magnitude"),
        (-0.03, "too small in magnitude"),
        (0.5, "wrong sign, and its magnitude"),
        ("-0,1016", "decimal point"),
        ("-0.1016 m", "not a unit"),
        ("-0.1016 rad/s", "not a unit"),
        ("-0.1016 furlong", "not a unit"),
        ("-0.1016 rad deg kg", "not a unit"),
        (float("nan"), "not a finite number"),
        ("1e999 rad", "not a finite number"),
        (True, "type bool"),
        (1j, "type complex"),
    ],
)
def test_wrong_but_close_numbers_get_a_true_hint(answer, words):
    verdict = check("4.7", answer)
    assert verdict.answered
    assert not verdict.right
    assert words in verdict.hint


def test_the_default_numbers_are_recognized():
    verdict = check("4.7", ANGLE, "ab123")
    assert not verdict
    assert "default parameters" in verdict.hint


# Equations of motion

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
    "(J_G + m*L^2)*theta_dd + m*L*cos(theta)*x_dd + c_h*theta_d + m*g*L*sin(theta) - W*L*cos(theta) == 0".replace("==", "="),
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
        ([TROLLEY, SWING - 2 * mm * g * L * sm.sin(theta)], "Equation 2: a weight term (with g) has the wrong sign"),
        ([TROLLEY, SWING + mm * g * L * sm.sin(theta)], "Equation 2: a weight term (with g) has a wrong constant"),
        ([TROLLEY, SWING - c_h * theta.diff()], "a term with rates (a damper?) is missing"),
        ([TROLLEY + mm * L * theta.diff() ** 2 * sm.sin(theta), SWING], "squares or products of rates is missing"),
        ([TROLLEY, SWING + mm * L * x.diff() * theta.diff()], "squares or products of rates stands there"),
        ([TROLLEY, SWING.subs(sm.sin(theta), theta).subs(sm.cos(theta), 1)], "not right yet"),
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


# Sets of roots

ROOTS = exercise("4.14b").solution()


@pytest.mark.parametrize(
    "answer",
    [
        *(ROOTS, ROOTS[::-1], list(ROOTS), set(ROOTS), np.array(ROOTS), iter(ROOTS)),
        [root + 2 * math.pi for root in ROOTS],
        [0, -math.pi, ROOTS[0], ROOTS[2] + 5e-4],
        ["0", "180 deg", f"{math.degrees(ROOTS[2])} deg", f"{math.degrees(ROOTS[0])} deg"],
        f"0, pi, {ROOTS[0]:.5f}, {ROOTS[2]:.5f}",
        f"[0, pi, {ROOTS[0]:.5f}, {ROOTS[2]:.5f}]",
    ],
    ids=lambda a: f"{type(a).__name__}-{str(a)[:30]}",
)
def test_roots_count_in_any_order_and_modulo_a_turn(answer):
    assert check("4.14b", answer)


@pytest.mark.parametrize(
    ("id", "answer", "words"),
    [
        ("4.14b", [*ROOTS, -math.pi], "listed twice"),
        ("4.14b", [0], "but there are more"),
        ("4.14b", [*ROOTS, 1.0], "1 should not be"),
        ("4.14b", [0, math.pi, 0.7, -0.7], "Wrong: 0.7, -0.7"),
        ("4.14b", [0, math.pi, 0.7], "their number is not right"),
        ("4.14b", [1, 2, -1, -2], "number of angles is right, but none"),
        ("4.14b", [1.0], "there are more"),
        ("4.14b", [0.1, 0.2, 0.3, 0.4, 0.5], "there are fewer"),
        ("4.14b", [math.degrees(x) for x in ROOTS], "These are degrees"),
        ("4.14b", [x + 0.004 for x in ROOTS], "more digits"),
        ("4.14b", [], "list is empty"),
        ("4.14b", range(10**12), "more than 64 roots"),
        ("4.3c", [0, 2.0], "outside the region"),
        ("4.15b", [1.702, 6.877], "power of ten"),
        ("4.15b", [-0.001702, -0.006877], "All signs are wrong"),
        ("4.15b", ["1.702 kg", "6.877 mm"], "not a unit"),
    ],
    ids=lambda item: str(item)[:30],
)
def test_wrong_sets_get_a_true_hint(id, answer, words):
    verdict = check(id, answer)
    assert not verdict.right
    assert words in verdict.hint


def test_a_set_of_equilibria_found_with_an_own_equation_is_an_answer():
    lamp = exercise("4.14").system
    own = ed.EquationsOfMotion.from_residuals(list(exercise("4.14").solution()), [lamp.coordinates[0].symbol])
    assert check("4.14b", ed.equilibria(own, lamp.values(), bounds={"theta": (-3, 3.2)}))


def test_the_same_root_twice_in_a_truth_counts_once():
    question = RootSet(lambda case: [math.pi, -math.pi, 0.0, 2 * math.pi], unit="rad")
    assert question.solution(CRANE.case("0.1")) == (0.0, math.pi)


# Choices


@pytest.mark.parametrize("answer", ["b1", "B1", "b 1", "(b1)", "b, 1", ("b", 1), ["b", "1"]], ids=repr)
def test_a_choice_may_be_written_freely(answer):
    assert check("4.7b", answer)


def test_a_statement_needs_its_reason():
    assert "Add the number of the reason" in check("4.7b", "b").hint
    assert check("4.7b", "a1").hint == check("4.7b", "a").hint
    assert "letters a, b, c, d" in check("4.7b", "e").hint
    assert "reason, 1, 2, 3" in check("4.7b", "b7").hint


# Junk


class Hostile:
    """Raises whatever is asked of it."""

    def __getattr__(self, name):
        raise RuntimeError(name)

    def __eq__(self, other):
        raise RuntimeError("eq")

    __hash__ = None

    def __iter__(self):
        raise OSError("iter")

    def __float__(self):
        raise MemoryError


def nested(depth):
    found: list = []
    for _ in range(depth):
        found = [found]
    return found


def deep_expression():
    found = sm.Symbol("m")
    for _ in range(300):
        found = sm.sin(found, evaluate=False)
    return found


def doubling_expression():
    """A small graph that is an enormous tree."""
    found = sm.Symbol("m")
    for _ in range(60):
        found = sm.Add(sm.sin(found, evaluate=False), sm.cos(found, evaluate=False), evaluate=False)
    return found


JUNK = {
    "none": None,
    "true": True,
    "nan": float("nan"),
    "infinity": float("inf"),
    "complex": 1 + 2j,
    "huge integer": 10**100_000,
    "bytes": b"m*g",
    "empty": "",
    "blank": "   ",
    "prose": "I do not know",
    "import": "__import__('os').system('echo hacked')",
    "lambda": "(lambda: 1)()",
    "attribute": "m.__class__.__mro__",
    "null": "m\x00g",
    "tower": "9**9**9**9",
    "tower with unit": "9**9**9 rad",
    "long": "m+" * 100_000 + "m",
    "deep": "(" * 5000 + "m" + ")" * 5000,
    "equals": "a=b=c",
    "spaces": "1" + " " * 50_000 + "!",
    "units": "1 " + "m " * 5000,
    "list": [1, 2, 3],
    "texts": ["a", None, {}],
    "nested": nested(2000),
    "dict": {"answer": 1},
    "set": {1, 2},
    "array": np.zeros((3, 3)),
    "object array": np.array([None, "a"], dtype=object),
    "nan array": np.full(4, np.nan),
    "generator": (n for n in iter(int, 1)),
    "range": range(10**15),
    "function": lambda: 1,
    "class": Hostile,
    "hostile": Hostile(),
    "module": sys,
    "sympy nan": sm.nan,
    "sympy infinity": sm.oo,
    "imaginary": sm.I,
    "matrix": sm.Matrix([[1, 2], [3, 4]]),
    "true equation": sm.Eq(1, 1),
    "relation": sm.Symbol("m") < 3,
    "integral": sm.Integral(sm.exp(-sm.Symbol("m") ** 2), (sm.Symbol("m"), 0, 1)),
    "series": sm.Sum(1 / sm.Symbol("m"), (sm.Symbol("m"), 1, 10**9)),
    "piecewise": sm.Piecewise((1, sm.Symbol("m") > 0), (2, True)),
    "unknown function": sm.Function("f")(sm.Symbol("m")),
    "high derivative": dynamicsymbols("theta").diff(t, 7),
    "deep expression": deep_expression(),
    "doubling expression": doubling_expression(),
    "wide powers": (sm.Symbol("m") + sm.Symbol("l") + sm.Symbol("k") + sm.Symbol("g")) ** 60,
    "hidden tower": sm.Symbol("m") + sm.Pow(9, sm.Pow(9, 9, evaluate=False), evaluate=False),
    "fine angle": sm.sin(sm.Rational(123456789, 10**9) * sm.Symbol("k") / sm.Symbol("k") * 7),
    "many roots": sum(sm.sqrt(sm.Symbol("m") + n * sm.Symbol("l")) for n in range(40)),
    "huge values": np.array([1e308, -1e308]),
    "quantity": pint.UnitRegistry().Quantity([1, 2], "rad"),
    "equations of another system": ed.systems.load("S07").newton(),
    "system": ed.systems.load("S03"),
}


@pytest.mark.parametrize("item", exercises(), ids=lambda item: item.id)
def test_junk_is_wrong_at_once_and_without_an_error(item):
    item.solution()
    check(item.id, 0.123)  # whatever is derived once is derived here
    for name, junk in JUNK.items():
        start = time.perf_counter()
        verdict = check(item.id, junk)
        elapsed = time.perf_counter() - start
        assert not verdict.right, name
        assert verdict.answered, name
        assert verdict.hint.strip(), name
        assert len(verdict.hint) <= 600, name
        assert elapsed < 1.0, (name, elapsed)
        assert "Traceback" not in verdict.hint
        repr(verdict), verdict._repr_html_()
