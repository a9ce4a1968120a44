"""Expressions and numbers: right in any form, wrong ones with a hint that is true."""

from __future__ import annotations

import math

import numpy as np
import pint
import pytest
import sympy as sm
from sympy.physics.mechanics import dynamicsymbols

import engdyn as ed
from engdyn.course.case import Setup
from engdyn.course.checking import check
from engdyn.course.judging_expressions import Expression
from engdyn.course.registry import exercise

m, M_c, l, k, Omega, g = sm.symbols("m M_c l k Omega g")
COSINE = ((m + M_c) * g + 2 * k * l) / (2 * k * l + m * l * Omega**2)

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
        *(
            ANGLE,
            ANGLE * 1.0009,
            ANGLE * 0.9991,
            -0.1016,
            np.float64(ANGLE),
            np.array(ANGLE),
            np.array([ANGLE]),
        ),
        *(
            sm.Float(ANGLE),
            sm.atan(sm.Rational(-1000, 9810)),
            "-0.101586",
            "−0.101586",
            "-1.01586e-1",
            " -.101586 ",
        ),
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
