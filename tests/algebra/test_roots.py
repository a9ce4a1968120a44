"""Roots, magnitudes and calls: one generator for one function, positive factors in front."""

from __future__ import annotations

import sympy as sm

from algebra.expressions import a, agree, b, elements, k, x, y
from engdyn.algebra.readable import to_sympy, tree


def generators(*expressions: sm.Expr) -> int:
    """How many roots, magnitudes and calls the ring of some expressions really uses."""
    ring = elements(*expressions)[0].ring
    return sum(d.kind in ("root", "magnitude", "call") for d in ring.definitions.values())


def test_equal_functions_share_a_generator():
    assert generators(sm.sqrt(x**2 + 2 * x + 1), sm.Abs(x + 1), sm.Abs(-2 * x - 2)) == 1
    assert generators(sm.sqrt(4 * x), sm.sqrt(9 * x * a**2), 1 / sm.sqrt(x)) == 1
    assert generators(sm.tanh(sm.sin(2 * x)), sm.tanh(2 * sm.sin(x) * sm.cos(x))) == 1
    assert generators(sm.sqrt(x), sm.sqrt(y), sm.Abs(x)) == 3
    assert generators(sm.tanh(x), sm.atan(x)) == 2


def test_positive_factors_stand_before_the_root():
    (root,) = elements(sm.sqrt(12 * a**3 * x * (1 + k**2), evaluate=False))
    assert to_sympy(tree(root)) == 2 * a * sm.sqrt(3 * a * x * (1 + k**2))


def test_factors_of_unknown_sign_stay_inside():
    under, before, square = elements(sm.sqrt(k**2 * (1 + x**2)), k * sm.sqrt(1 + x**2), k**2 * (1 + x**2))
    assert not under.equals(before)
    assert (under * under).equals(square)
    assert (before * before).equals(square)


def test_a_quotient_under_the_root_keeps_its_sign():
    expression = sm.sqrt(x / (y - 2))
    element, quotient = elements(expression, x / (y - 2))
    assert (element * element).equals(quotient)
    both_negative = {x: -3, y: 1}
    assert abs(to_sympy(tree(element)).subs(both_negative).evalf() - sm.sqrt(3).evalf()) < 1e-12


def test_a_magnitude_of_a_quotient():
    expression = sm.Abs((x + b) / (y * a))
    (element,) = elements(expression)
    assert agree(to_sympy(tree(element)), expression)
