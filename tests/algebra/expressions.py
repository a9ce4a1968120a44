"""Expressions for the tests of the algebra, and their values to 40 digits, computed by mpmath."""

from __future__ import annotations

import random
from collections.abc import Sequence

import mpmath
import sympy as sm
from hypothesis import strategies as st
from sympy.physics.mechanics import dynamicsymbols

from engdyn.algebra.conversion import Converter
from engdyn.algebra.ring import Element

x, y = dynamicsymbols("x y")
a, b = sm.symbols("a b", positive=True)
k = sm.Symbol("k", real=True)
t = dynamicsymbols._t
VARIABLES = (x, y, a, b, k)
KEYS = [("function", x, 0), ("function", y, 0), *(("symbol", s) for s in (a, b, k))]


def elements(*expressions: sm.Expr) -> list[Element]:
    """The expressions as elements of one ring."""
    converter = Converter([*expressions, *VARIABLES])
    return [converter.convert(e) for e in expressions]


def is_zero(expression: sm.Expr) -> bool:
    """The verdict of the ring on an expression."""
    return elements(expression)[0].is_zero()


def points(count: int, seed: int = 1) -> list[tuple[mpmath.mpf, ...]]:
    """Values of x, y, a, b, k: a and b positive, the others of both signs."""
    source = random.Random(seed)
    return [
        tuple(
            mpmath.mpf(source.randint(1, 10**6)) / 400_009 * (1 if i in (2, 3) else source.choice((-1, 1)))
            for i in range(5)
        )
        for _ in range(count)
    ]


def values(expression: sm.Expr, at: Sequence[tuple[mpmath.mpf, ...]]) -> list[mpmath.mpf | mpmath.mpc]:
    """Values of an expression to 40 digits."""
    with mpmath.workdps(40):
        return [_value(expression, dict(zip(VARIABLES, point, strict=True))) for point in at]


def _value(expression: sm.Expr, known: dict[sm.Expr, mpmath.mpf]) -> mpmath.mpf | mpmath.mpc:
    """mpmath's own functions, applied from the leaves up; values found are kept in `known`."""
    if expression not in known:
        if expression.is_Rational:
            known[expression] = mpmath.mpf(expression.p) / expression.q
        elif expression.is_Float:
            known[expression] = mpmath.mpf(str(expression))
        elif expression is sm.S.Pi or expression is sm.E:
            known[expression] = +(mpmath.pi if expression is sm.S.Pi else mpmath.e)
        else:
            known[expression] = _operation(expression)(*(_value(e, known) for e in expression.args))
    return known[expression]


def _operation(expression: sm.Expr):
    if expression.is_Add:
        return lambda *parts: mpmath.fsum(parts)
    if expression.is_Mul:
        return lambda *parts: mpmath.fprod(parts)
    if expression.is_Pow:
        return mpmath.power
    return {"Abs": mpmath.fabs}.get(type(expression).__name__) or getattr(mpmath, type(expression).__name__)


def agree(left: sm.Expr, right: sm.Expr, digits: int = 30, count: int = 4) -> bool:
    """Whether two expressions have the same values at a few points, where these are real."""
    with mpmath.workdps(40):
        pairs = list(zip(values(left, points(count)), values(right, points(count)), strict=True))
        real = [(p, q) for p, q in pairs if abs(mpmath.im(p)) < 1e-30 and abs(mpmath.im(q)) < 1e-30]
        assert real, f"no point where {left} is real"
        return all(abs(p - q) <= mpmath.mpf(10) ** -digits * (1 + abs(p) + abs(q)) for p, q in real)


def has_slope(derivative: sm.Expr, expression: sm.Expr, digits: int = 12) -> bool:
    """Whether an expression is the slope of another along x: compared with differences of 40-digit values."""
    at = points(3)
    with mpmath.workdps(40):
        step = mpmath.mpf(10) ** -12
        shifted = [[(p[0] + sign * step, *p[1:]) for p in at] for sign in (1, -1)]
        above, below = (values(expression, some) for some in shifted)
        slopes = [(p - q) / (2 * step) for p, q in zip(above, below, strict=True)]
        found = values(derivative, at)
        return all(
            abs(p - q) <= mpmath.mpf(10) ** -digits * (1 + abs(q)) for p, q in zip(found, slopes, strict=True)
        )


# Random expressions

rationals = st.fractions(min_value=-4, max_value=4, max_denominator=6).map(
    lambda f: sm.Rational(f.numerator, f.denominator)
)
angles = st.builds(
    lambda i, j, n, d, phase: (i * x + j * y) * sm.Rational(n, d) + phase * sm.pi / 6,
    st.integers(-2, 2),
    st.integers(-2, 2),
    st.integers(1, 2),
    st.sampled_from([1, 2]),
    st.integers(-3, 3),
)
waves = st.builds(lambda function, angle: function(angle), st.sampled_from([sm.sin, sm.cos]), angles)
terms = st.builds(
    lambda number, factors, symbols: sm.Mul(number, *factors, *symbols),
    rationals,
    st.lists(waves, max_size=2),
    st.lists(st.sampled_from([a, b, k, x]), max_size=2),
)
short = st.builds(
    lambda number, symbol, function, i, j, more: number * symbol * function(i * x + j * y) + more,
    rationals,
    st.sampled_from([a, b, k, x]),
    st.sampled_from([sm.sin, sm.cos]),
    st.integers(-2, 2),
    st.sampled_from([0, 1, -1, sm.Rational(1, 2)]),
    st.sampled_from([0, 1, y, sm.sin(y), sm.cos(x) ** 2]),
)


def extend(inner: st.SearchStrategy) -> st.SearchStrategy:
    """Sums, products and functions of expressions; all are real and finite everywhere."""
    return st.one_of(
        st.builds(lambda p, q: p + q, inner, inner),
        st.builds(lambda p, q: p * q, inner, inner),
        inner.map(lambda p: sm.sqrt(1 + p**2)),
        inner.map(lambda p: 1 / (2 + sm.cos(x) + p**2)),
        inner.map(sm.atan),
        inner.map(lambda p: sm.tanh(p)),
        inner.map(lambda p: sm.exp(sm.sin(x) - sm.cos(y)) * p),
        inner.map(lambda p: sm.Abs(p + 3)),
        inner.map(lambda p: sm.log(1 + a + p**2)),
    )


functions = st.recursive(short, extend, max_leaves=3)
