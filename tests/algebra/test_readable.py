"""Formulas come back in the form people write them."""

from __future__ import annotations

from fractions import Fraction

import pytest
import sympy as sm

from algebra.expressions import a, agree, b, elements, k, t, x, y
from engdyn.algebra import polynomials as backend
from engdyn.algebra.readable import ONE, ZERO, make_power, make_product, make_sum, to_sympy, tree

sin, cos = sm.sin, sm.cos


@pytest.fixture(params=["flint", "sympy"])
def chosen(request, monkeypatch):
    if request.param == "flint":
        pytest.importorskip("flint")
    monkeypatch.setattr(backend, "backend_name", lambda: request.param)


@pytest.mark.parametrize(
    ("given", "restored"),
    [
        (cos(x) * cos(y) + sin(x) * sin(y), cos(x - y)),
        (sin(x) * cos(y) - cos(x) * sin(y), sin(x - y)),
        (a * b * (cos(x) * cos(y) - sin(x) * sin(y)), a * b * cos(x + y)),
        (1 - cos(x) ** 2, sin(x) ** 2),
        (k * (1 - cos(x) ** 2) ** 2, k * sin(x) ** 4),
        (a + b * sin(x) ** 2, a + b * sin(x) ** 2),
        (2 * sin(x) * cos(x), 2 * sin(x) * cos(x)),
        (cos(x) ** 2 - sin(x) ** 2, cos(2 * x)),
        ((a + b) ** 2 * x.diff(t, 2), (a + b) ** 2 * x.diff(t, 2)),
        (a * cos(x) * x.diff(t) ** 2 - a * b * y.diff(t), a * cos(x) * x.diff(t) ** 2 - a * b * y.diff(t)),
        (sm.tan(x), sin(x) / cos(x)),
        (1 / sin(x) - sin(x), cos(x) ** 2 / sin(x)),
        (a * sin(x) / (1 - cos(x) ** 2), a / sin(x)),
        (sm.sqrt(a**2 + x**2) ** 3, (a**2 + x**2) * sm.sqrt(a**2 + x**2)),
        (sm.Abs(-x) * a, a * sm.Abs(x)),
        (sm.Rational(3, 4) - sm.Rational(3, 4), sm.Integer(0)),
        (0.25 * x, x / 4),
    ],
    ids=str,
)
def test_forms_are_restored(chosen, given, restored):
    (element,) = elements(given)
    assert to_sympy(tree(element)) == restored


def test_rates_are_collected_with_factored_coefficients():
    (element,) = elements(
        (a * x.diff(t) + b * x.diff(t)) * y.diff(t) * cos(x) + k * a**2 + 2 * k * a * b + k * b**2
    )
    shown = to_sympy(tree(element))
    assert shown == (a + b) * cos(x) * x.diff(t) * y.diff(t) + k * (a + b) ** 2


def test_long_and_high_polynomials_are_left_as_they_are():
    """Factoring a polynomial of thousands of terms, or expanding cos^60 in angles, would take minutes."""
    long = sm.Add(*(sm.Rational(i + 1, 7) * x ** (i % 30) * cos(x) ** (i // 30) for i in range(1500)))
    (element,) = elements(long)
    assert agree(to_sympy(tree(element)), long, digits=15)


def test_nodes_are_normalized():
    two, half, g = ("number", Fraction(2)), ("number", Fraction(1, 2)), ("generator", ("symbol", a))
    assert make_product([two, g, half]) == g
    assert make_product([g, ZERO]) == ZERO
    assert make_product([]) == ONE
    assert make_sum([ZERO, g, ZERO]) == g
    assert make_sum([]) == ZERO
    assert make_power(make_power(g, 2), 3) == ("power", g, 6)
    assert make_power(half, -2) == ("number", Fraction(4))
