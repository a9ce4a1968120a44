"""Formulas as MathML, in the notation of mechanics; numbers, angles and units in a report."""

from __future__ import annotations

import re
from xml.etree import ElementTree

import numpy as np
import pytest
import sympy as sm
from sympy.physics.mechanics import ReferenceFrame, dynamicsymbols

from engdyn.course.mathml import equation, formula, vector
from engdyn.course.report_tables import number, part_of_pi, unit


def content(text):
    """Letters of a formula, spaces and invisible operators left out."""
    letters = "".join(
        ElementTree.fromstring(re.search(r"<math.*</math>", text, re.DOTALL).group()).itertext()
    )
    return re.sub("[\\s\u2061\u2062]", "", letters)


def test_formulas_in_the_notation_of_mechanics():
    theta, zf = dynamicsymbols("theta zf")
    m, M_c = sm.symbols("m M_c")
    assert content(formula(m * theta.diff() ** 2 * sm.sin(theta) ** 2)) == "msin2θθ˙2"
    assert content(formula(-M_c * theta.diff(dynamicsymbols._t, 2))) == "−Mcθ¨"
    assert content(formula(zf.diff())) == "z˙f"
    assert content(formula(sm.cos(theta - zf))) == "cos(θ−zf)"
    assert "<msub><mover" in formula(zf.diff())
    assert 'alttext="\\dot{\\theta}"' in formula(theta.diff())
    assert "Derivative" not in formula(theta.diff(dynamicsymbols._t, 2))


def test_capital_inputs_stay_capital():
    assert content(formula(dynamicsymbols("F"))) == "F"
    assert content(formula(dynamicsymbols("T_w"))) == "Tw"


def test_long_sums_go_on_in_the_next_line():
    terms = sm.Add(*(sm.Symbol(f"a_{i}") * sm.Symbol(f"b_{i}") ** 2 for i in range(40)))
    root = ElementTree.fromstring(re.search(r"<math.*</math>", equation(sm.Symbol("y"), terms)).group())
    rows = root.findall(".//mtr")
    assert len(rows) >= 3
    assert all(len(row.findall("mtd")) == 3 for row in rows)
    assert content(equation(sm.Symbol("y"), terms)).count("+") == 39
    assert content(equation(sm.Symbol("y"), -terms)).count("−") == 40


def test_vectors_carry_their_frame():
    A, N = ReferenceFrame("A"), ReferenceFrame("N")
    m, g, T = sm.symbols("m g T")
    assert content(vector(-m * g * N.y)) == "−gmn^y"
    assert content(vector(T * A.x + (m - g) * N.z)) in ("Ta^x+(−g+m)n^z", "Ta^x−(g−m)n^z")
    assert content(vector(0 * N.x)) == "0"


@pytest.mark.parametrize(
    ("value", "expected"),
    [
        (0.0, "0"),
        (1e-15, "0"),
        (9.81, "9.81"),
        (-0.5, "−0.5"),
        (36297.0, "36297"),
        (0.0001234567, "0.0001235"),
        (1234567.8, "1234568"),
        (1e9, "1e+09"),
        (1e-6, "1e−06"),
        (9.99999, "10"),
        (200.0, "200"),
    ],
)
def test_numbers(value, expected):
    assert number(value) == expected


def test_angles_and_units():
    shown = [part_of_pi(x) for x in (np.pi, -np.pi / 2, 1.5, 0.0, 2 * np.pi / 3)]
    assert shown == ["π", "−π/2", "1.5", "0", "2π/3"]
    assert [unit(u) for u in ("m/s^2", "-", "", "N m s/rad")] == ["m/s<sup>2</sup>", "–", "–", "N m s/rad"]
