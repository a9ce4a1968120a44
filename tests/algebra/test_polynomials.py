"""Both polynomial backends do the same; which one is at work."""

from __future__ import annotations

import importlib.util
from fractions import Fraction
from math import prod

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from engdyn.algebra import polynomials as module

CLASSES = [module.SympyPolynomials] + ([module.FlintPolynomials] if importlib.util.find_spec("flint") else [])

numbers = st.fractions(min_value=-5, max_value=5, max_denominator=7)
dictionaries = st.dictionaries(st.tuples(*[st.integers(0, 3)] * 3), numbers.filter(bool), max_size=5)
POINT = (Fraction(2, 3), Fraction(-5, 7), Fraction(11, 13))


def value(terms, point=POINT) -> Fraction:
    return sum((c * prod(x**e for x, e in zip(point, es, strict=True)) for es, c in terms), Fraction(0))


@pytest.fixture(params=CLASSES, ids=lambda c: c.__name__)
def ring(request):
    return request.param(3)


@settings(max_examples=60)
@given(data=st.tuples(dictionaries, dictionaries, dictionaries))
@pytest.mark.parametrize("kind", CLASSES, ids=lambda c: c.__name__)
def test_arithmetic_on_values(kind, data):
    ps = kind(3)
    p, q, d = (ps.from_terms(terms) for terms in data)
    vp, vq, vd = (value(terms.items()) for terms in data)
    assert value(ps.terms(p)) == vp
    assert value(ps.terms(p * q - d)) == vp * vq - vd
    assert ps.is_zero(p - p)
    assert ps.is_zero(p) == (not data[0])
    if data[0] and data[1]:
        assert ps.degrees(p * q) == tuple(map(sum, zip(ps.degrees(p), ps.degrees(q), strict=True)))
    if data[1] and data[2]:
        common = ps.gcd(p * d, q * d)
        assert ps.is_zero(ps.remainder(common, d))
        assert ps.leading_coefficient(common) == 1
        assert value(ps.terms(ps.quotient(p * d, d))) == vp


@settings(max_examples=60)
@given(data=st.tuples(dictionaries, dictionaries))
@pytest.mark.parametrize("kind", CLASSES, ids=lambda c: c.__name__)
def test_factors_multiply_to_the_polynomial(kind, data):
    ps = kind(3)
    p, q = (ps.from_terms(terms) for terms in data)
    if data[0] and data[1]:
        content, factors = ps.factor(p * p * q)
        product = ps.constant(content)
        for factor, multiplicity in factors:
            product = product * factor**multiplicity
        assert product == p * p * q


def test_monic_factors_of_a_cosine_are_found_as_they_stand(ring):
    c = ring.gens[1]
    _, factors = ring.factor((c - ring.one) * (c + ring.one) * ring.constant(-3))
    assert [multiplicity for _, multiplicity in factors] == [1, 1]
    assert all(any(f == wanted for f, _ in factors) for wanted in (c - ring.one, c + ring.one))


def test_derivative_division_specialization(ring):
    g0, g1, g2 = ring.gens
    p = g0 * g0 * g1 + ring.constant(Fraction(1, 2)) * g2
    assert ring.derivative(p, 0) == ring.constant(2) * g0 * g1
    assert ring.remainder(p, g0 * g0 - ring.one) == g1 + ring.constant(Fraction(1, 2)) * g2
    assert ring.specialize(p, {0: Fraction(3), 2: Fraction(4)}) == ring.constant(9) * g1 + ring.constant(2)
    assert ring.leading_coefficient(ring.zero) == 0
    assert ring.is_constant(ring.constant(7))
    assert not ring.is_constant(g1)


def test_transfer_moves_generators(ring):
    larger = type(ring)(5)
    g0, g1, g2 = ring.gens
    moved = ring.transfer(g0 * g0 - g1 * g2, larger, [4, 1, 1])
    h = larger.gens
    assert moved == h[4] * h[4] - h[1] * h[1]
    same = ring.transfer(g0 - g1, ring, [1, 0, 2])
    assert same == g1 - g0


@pytest.mark.parametrize(("wanted", "expected"), [("sympy", "sympy"), ("SYMPY", "sympy"), ("", None)])
def test_the_environment_chooses_the_backend(monkeypatch, wanted, expected):
    monkeypatch.setenv("ENGDYN_BACKEND", wanted)
    assert module.backend_name() == (expected or ("flint" if importlib.util.find_spec("flint") else "sympy"))
    assert type(module.polynomials(2)).__name__.lower().startswith(module.backend_name())


def test_without_flint_the_rings_of_sympy_are_used(monkeypatch):
    monkeypatch.delenv("ENGDYN_BACKEND", raising=False)
    monkeypatch.setitem(__import__("sys").modules, "flint", None)
    assert module.backend_name() == "sympy"


@settings(max_examples=40)
@given(terms=dictionaries)
@pytest.mark.parametrize("kind", CLASSES, ids=lambda c: c.__name__)
def test_sparse_terms_and_values(kind, terms):
    ps = kind(3)
    p = ps.from_terms(terms)
    sparse = ps.sparse(p)
    assert ps.from_sparse(sparse) == p
    assert all(e > 0 for exponents, _ in sparse for _, e in exponents)
    assert value((tuple(dict(pairs).get(i, 0) for i in range(3)), c) for pairs, c in sparse) == value(
        ps.terms(p)
    )
    point = [ps.rational(x.numerator, x.denominator) for x in POINT]
    found = ps.value(p, point)
    assert (
        Fraction(int(found.numerator), int(found.denominator)) == value(terms.items()) if terms else not found
    )
