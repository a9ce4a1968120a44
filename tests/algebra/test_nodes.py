"""Expressions put together by hand are the ones that sympy itself would make."""

from __future__ import annotations

from fractions import Fraction

import pytest
import sympy as sm
from hypothesis import given, settings
from hypothesis import strategies as st
from sympy.physics.mechanics import dynamicsymbols

from algebra.expressions import a, b, elements, k, t, x, y
from engdyn.algebra.nodes import make_power, make_product, make_sum, to_sympy
from engdyn.algebra.readable import expression
from engdyn.algebra.scan import key_to_sympy

generators = st.sampled_from(
    [("generator", ("symbol", s)) for s in (a, b, k)]
    + [("generator", ("function", q, order)) for q in (x, y) for order in (0, 1, 2)]
)
factors = st.sampled_from([-2, -1, 1, 2, Fraction(1, 2), Fraction(-3, 2)])
angles = st.lists(
    st.tuples(st.sampled_from([x, y, k, sm.pi, k * t, x * y, sm.asin(k)]), factors),
    min_size=1,
    max_size=3,
    unique_by=lambda term: term[0],
).map(tuple)
numbers = factors.map(lambda f: ("number", f))
leaves = st.one_of(generators, numbers, st.tuples(st.sampled_from(["cos", "sin"]), angles))
nodes = st.recursive(
    leaves,
    lambda inner: st.one_of(
        st.lists(inner, min_size=1, max_size=4).map(make_sum),
        st.lists(inner, min_size=1, max_size=5).map(make_product),
        st.builds(make_power, inner, st.integers(1, 3)),
    ),
    max_leaves=8,
)


def evaluated(node):
    """The same tree built by sympy's own constructors alone."""
    kind = node[0]
    if kind == "number":
        return sm.Rational(node[1].numerator, node[1].denominator)
    if kind == "generator":
        return key_to_sympy(node[1])
    if kind in ("cos", "sin"):
        angle = sm.Add(*(sm.Rational(f.numerator, f.denominator) * base for base, f in node[1]))
        return sm.cos(angle) if kind == "cos" else sm.sin(angle)
    if kind == "power":
        return evaluated(node[1]) ** node[2]
    return (sm.Add if kind == "sum" else sm.Mul)(*map(evaluated, node[1]))


@settings(max_examples=300)
@given(nodes)
def test_trees_become_what_sympy_makes_of_them(node):
    found, expected = to_sympy(node), evaluated(node)
    assert found == expected
    assert hash(found) == hash(expected)
    assert sm.srepr(found) == sm.srepr(expected)


@given(st.lists(nodes, min_size=2, max_size=4))
def test_remembered_expressions_are_the_same(some):
    known = {}
    assert [to_sympy(node, known) for node in [*some, *some]] == [evaluated(node) for node in [*some, *some]]


@pytest.mark.parametrize("order", [0, 1, 2, 3])
def test_derivatives_are_those_of_sympy(order):
    q = dynamicsymbols("q")
    found, expected = key_to_sympy(("function", q, order)), q.diff(t, order) if order else q
    assert found == expected
    assert hash(found) == hash(expected)
    assert found.args == expected.args
    assert found.assumptions0 == expected.assumptions0
    assert (found * k).diff(t) == (expected * k).diff(t)


def test_expressions_of_one_ring_share_their_parts():
    one, two = elements(a * sm.cos(x - y) * x.diff(t), b * sm.cos(y - x))
    (first,) = expression(one).atoms(sm.cos)
    (second,) = expression(two).atoms(sm.cos)
    assert first is second
    assert expression(one) is not expression(two)
    assert one.node is not None
