"""Sympy expressions into the ring and back: the same function, and the same element."""

from __future__ import annotations

from fractions import Fraction

import pytest
import sympy as sm
from hypothesis import given, settings

from algebra.expressions import a, agree, b, elements, functions, k, short, t, x, y
from engdyn.algebra.conversion import Converter
from engdyn.algebra.readable import to_sympy, tree
from engdyn.algebra.scan import angle_terms, as_fraction, exact_phase
from engdyn.errors import OutsideRingError


@settings(max_examples=35)
@given(functions)
def test_there_and_back_is_the_same(expression):
    (element,) = elements(expression)
    back = to_sympy(tree(element))
    assert agree(back, expression, digits=25)
    first, second = elements(expression, back)
    assert first.equals(second)


@settings(max_examples=40)
@given(short, short)
def test_readable_forms_keep_products_and_quotients(p, q):
    expression = p * q / (3 + sm.cos(x) ** 2)
    assert agree(to_sympy(tree(elements(expression)[0])), expression)


def test_rates_are_replaced_where_kinematics_say_so():
    rate = {("function", x, 1): k * sm.sin(y)}
    expression = a * x.diff(t) ** 2 + sm.cos(x)
    converter = Converter([expression, k * sm.sin(y)], substitutions=rate)
    assert ("function", x, 1) not in converter.ring.index
    assert agree(to_sympy(tree(converter.convert(expression))), a * k**2 * sm.sin(y) ** 2 + sm.cos(x))


def test_derivatives_are_carried_out():
    converter = Converter([expression := sm.Derivative(x**2 * sm.sin(y), t)])
    expected = 2 * x * x.diff(t) * sm.sin(y) + x**2 * sm.cos(y) * y.diff(t)
    other = Converter([expected])
    assert {*converter.ring.keys} >= {*other.ring.keys}
    assert to_sympy(tree(converter.convert(expression))) == to_sympy(tree(other.convert(expected)))


@pytest.mark.parametrize(
    ("angle", "expected"),
    [
        (2 * x - y / 3, {x: 2, y: Fraction(-1, 3)}),
        (a * (x - 2), {a * x: 1, a: -2}),
        ((x + y) / (2 * b), {x / b: Fraction(1, 2), y / b: Fraction(1, 2)}),
        (x + sm.pi / 3, {x: 1, sm.pi: Fraction(1, 3)}),
        (0.5 * x + 1, {x: Fraction(1, 2), sm.S.One: 1}),
        (x - x, {}),
    ],
)
def test_angles_are_sums_of_base_angles(angle, expected):
    assert dict(angle_terms(angle)) == expected


@pytest.mark.parametrize(
    ("number", "expected"),
    [
        (sm.Float(0.1), Fraction(1, 10)),
        (sm.Float(1e-300), Fraction(1, 10**300)),
        (sm.Float(9.81), Fraction(981, 100)),
        (sm.Float(0.1 + 0.2), Fraction(30000000000000004, 10**17)),
        (sm.Float("0.1", 40), Fraction(1, 10)),
        (sm.Float("1.0000000000000000000000000001", 40), 1 + Fraction(1, 10**28)),
        (sm.Rational(-22, 7), Fraction(-22, 7)),
        (sm.Integer(-3), Fraction(-3)),
    ],
)
def test_numbers_are_the_rationals_people_mean(number, expected):
    assert as_fraction(number) == expected


@pytest.mark.parametrize("number", [sm.oo, -sm.oo, sm.nan])
def test_numbers_without_value(number):
    with pytest.raises(OutsideRingError, match="finite"):
        as_fraction(number)


def test_phases_have_exact_values_where_square_roots_do():
    for n in (1, 2, 3, 4, 5, 6, 8, 12):
        cosine, sine = exact_phase(Fraction(2, n))
        assert abs(cosine.evalf() - sm.cos(2 * sm.pi / n).evalf()) < 1e-14
        assert abs(sine.evalf() - sm.sin(2 * sm.pi / n).evalf()) < 1e-14
    assert exact_phase(Fraction(1, 7)) is None
    assert exact_phase(Fraction(4, 9)) is None


def test_one_base_angle_serves_all_its_multiples():
    ring = Converter([sm.cos(3 * x) + sm.sin(x / 2) + sm.cos(x / 3 - 2 * y)]).ring
    assert {key[1:] for key in ring.keys if key[0] == "sine"} == {(x, 6), (y, 1)}
