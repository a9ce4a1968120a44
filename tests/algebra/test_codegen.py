"""Generated code: values of random expressions on four kinds of numbers, and what it may contain."""

from __future__ import annotations

import ast
import importlib.util
import math

import mpmath
import numpy as np
import pytest
import sympy as sm
from hypothesis import given, settings

from algebra.expressions import KEYS, a, b, elements, functions, k, points, values, x, y
from engdyn.algebra import balls
from engdyn.algebra.codegen import FUNCTIONS, compile_elements, source
from engdyn.algebra.conversion import Converter
from engdyn.errors import EngdynError, OutsideRingError

AT = points(3, seed=7)

FIXED = [
    sm.sqrt(1 + x**2) * sm.exp(-a * x) + sm.atan2(y, 2 + sm.cos(x)),
    sm.Abs(x - y) * sm.sign(x + k) + sm.tanh(x) / (1 + x**2) ** 3,
    sm.asin(sm.sin(x) / 2) - sm.acos(sm.cos(y) / 3) + sm.log(1 + a * b),
    sm.sinh(x / 3) * sm.cosh(y / 3) * sm.pi + sm.E * k,
    (2 + sm.sin(x)) ** sm.Rational(4, 3) * sm.cos(x / 2 - y) ** 5 + sm.Rational(1, 3),
    sm.sin(x + sm.pi / 7) / sm.sqrt(a + b) + (a + b) ** -4,
]


def reference(expression: sm.Expr) -> list[float]:
    return [float(v) for v in values(expression, AT)]


def close(found, expected) -> bool:
    return np.allclose(np.array(found, dtype=float), expected, rtol=1e-11, atol=1e-11)


@settings(max_examples=35)
@given(functions)
def test_random_expressions_on_floats_arrays_and_balls(expression):
    parts, expected = elements(expression), reference(expression)
    function = compile_elements(parts, KEYS)
    assert close([function(*map(float, p))[0] for p in AT], expected)
    columns = np.array([[float(v) for v in p] for p in AT]).T
    (stacked,) = compile_elements(parts, KEYS, "numpy")(*columns)
    assert close(np.broadcast_to(stacked, 3), expected)
    enclosing = compile_elements(parts, KEYS, "balls")
    for point, exact in zip(AT, values(expression, AT), strict=True):
        (found,) = enclosing(*(balls.ball(float(v)) for v in point))
        assert balls.is_finite(found)
        assert (
            balls.lower(found) - 1e-12 * (1 + abs(exact))
            <= exact
            <= balls.upper(found) + 1e-12 * (1 + abs(exact))
        )
        assert balls.width(found) < 1e-9 * (1 + abs(float(exact)))


@pytest.mark.parametrize("target", ["math", "numpy", "numba"])
def test_all_functions_on_all_targets(target):
    if target == "numba" and importlib.util.find_spec("numba") is None:
        pytest.skip("numba is not installed")
    function = compile_elements(elements(*FIXED), KEYS, target)
    expected = np.array([reference(e) for e in FIXED])
    found = np.array([function(*map(float, p)) for p in AT]).T
    assert close(found, expected)


def test_balls_enclose_the_exact_values():
    function = compile_elements(elements(*FIXED), KEYS, "balls")
    exact_points = [tuple(mpmath.mpf(float(v)) for v in p) for p in AT]
    for point, *exact in zip(exact_points, *(values(e, exact_points) for e in FIXED), strict=True):
        for found, value in zip(function(*(balls.ball(float(v)) for v in point)), exact, strict=True):
            assert mpmath.mpf(balls.lower(found)) <= value <= mpmath.mpf(balls.upper(found))


def test_plain_numbers_in_place_of_balls_are_enclosed_not_misread():
    """Handed to the C library unchecked, a float gave garbage or ended the process."""
    function = compile_elements(elements(*FIXED), KEYS, "balls")
    for point in AT:
        plain = [float(v) for v in point]
        for found, expected in zip(function(*plain), function(*map(balls.ball, plain)), strict=True):
            assert balls.contains_zero(found - expected)
            assert balls.width(found) < 1e-9 * (1 + abs(balls.midpoint(found)))


def test_wide_balls_enclose_every_value_inside():
    function = compile_elements(elements(*FIXED), KEYS, "balls")
    plain = compile_elements(elements(*FIXED), KEYS)
    for point in AT:
        centers = [float(v) for v in point]
        wide = function(*(balls.ball(v - 1e-3, v + 1e-3) for v in centers))
        for shift in (-0.9e-3, 0.0, 0.4e-3):
            for found, value in zip(wide, plain(*(v + shift for v in centers)), strict=True):
                assert not balls.is_finite(found) or balls.lower(found) <= value <= balls.upper(found)


def test_constants_are_exact_in_ball_arithmetic():
    (third,) = compile_elements(elements(sm.Rational(1, 3) + 0 * x), [], "balls")()
    assert balls.lower(third) < balls.upper(third)
    assert balls.lower(third) <= 1 / 3 <= balls.upper(third)


def test_common_subexpressions_are_computed_once():
    text = source(elements(sm.sin(x) * sm.exp(sm.sin(x)), sm.sin(x) + sm.exp(sm.sin(x))), KEYS)
    assert text.count("sin(") == 1
    assert text.count("exp(") == 1


def test_the_text_holds_nothing_but_numbers_names_of_its_own_and_listed_functions():
    evil = sm.Symbol("__import__('os').system('true')")
    strange = sm.Symbol("lambda")
    expressions = [evil * sm.sin(strange * x) + sm.sqrt(1 + evil**2)]
    converter = Converter(expressions)
    keys = [("symbol", evil), ("symbol", strange), ("function", x, 0)]
    text = source([converter.convert(e) for e in expressions], keys)
    names = {node.id for node in ast.walk(ast.parse(text)) if isinstance(node, ast.Name)}
    allowed = {"sin", "cos", "pi", *FUNCTIONS.values()}
    assert {n for n in names if n not in allowed and not (n[0] in "xtk" and n[1:].isdigit())} == set()
    function = compile_elements([converter.convert(e) for e in expressions], keys)
    assert function(2.0, 3.0, 0.5)[0] == pytest.approx(2 * math.sin(1.5) + math.sqrt(5))


def test_long_sums_compile():
    many = sm.Add(*(sm.Rational(i + 1, 7) * x ** (i % 60) * sm.cos(x) ** (i // 60) for i in range(3000)))
    (value,) = compile_elements(elements(many), KEYS)(0.3, 0.0, 0.0, 0.0, 0.0)
    exact = values(many, [(mpmath.mpf(0.3), *[mpmath.mpf(0)] * 4)])[0]
    assert value == pytest.approx(float(exact), rel=1e-10)


def test_what_has_no_value_is_an_error():
    with pytest.raises(OutsideRingError, match="Heaviside"):
        compile_elements(elements(sm.Heaviside(x) * y), KEYS)
    with pytest.raises(OutsideRingError, match="numerical value"):
        compile_elements(elements(a * x), [("symbol", a)])
    with pytest.raises(OutsideRingError):
        compile_elements(elements(sm.Piecewise((x, x > 0), (0, True))), KEYS, "balls")
    with pytest.raises(EngdynError, match="unknown target"):
        compile_elements(elements(x), KEYS, "fortran")
    with pytest.raises(EngdynError, match="too large"):
        compile_elements(elements(10**400 * x), KEYS)
