"""Ball arithmetic: enclosure against exact fractions and 60-digit values, on both backends."""

from __future__ import annotations

import importlib.util
import math
import random
import sys
from decimal import Decimal
from fractions import Fraction

import mpmath
import numpy as np
import pytest
import sympy as sm
from hypothesis import given, settings
from hypothesis import strategies as st

from engdyn.errors import EngdynError

BACKENDS = ["flint", "sympy"] if importlib.util.find_spec("flint") else ["sympy"]


def load_balls(backend: str):
    """A private copy of the module that reads ENGDYN_BACKEND anew."""
    spec = importlib.util.find_spec("engdyn.algebra.balls")
    module = importlib.util.module_from_spec(spec)
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("ENGDYN_BACKEND", backend)
        spec.loader.exec_module(module)
    return module


MODULES = {backend: load_balls(backend) for backend in BACKENDS}


@pytest.fixture(params=BACKENDS)
def balls(request):
    return MODULES[request.param]


def encloses(balls, b, value: Fraction | mpmath.mpf) -> bool:
    """Whether a number known exactly, or to 60 digits, lies within the float bounds of a ball."""
    if isinstance(value, Fraction):
        return Fraction(balls.lower(b)) <= value <= Fraction(balls.upper(b))
    with mpmath.workdps(60):
        return mpmath.mpf(balls.lower(b)) <= value <= mpmath.mpf(balls.upper(b))


# name, function of mpmath, range of arguments where it is defined
FUNCTIONS = [
    ("sin", mpmath.sin, -50.0, 50.0),
    ("cos", mpmath.cos, -50.0, 50.0),
    ("tan", mpmath.tan, -1.5, 1.5),
    ("sqrt", mpmath.sqrt, 0.0, 1e6),
    ("exp", mpmath.exp, -30.0, 30.0),
    ("log", mpmath.log, 1e-6, 1e6),
    ("sinh", mpmath.sinh, -20.0, 20.0),
    ("cosh", mpmath.cosh, -20.0, 20.0),
    ("tanh", mpmath.tanh, -40.0, 40.0),
    ("asin", mpmath.asin, -1.0, 1.0),
    ("acos", mpmath.acos, -1.0, 1.0),
    ("atan", mpmath.atan, -1e3, 1e3),
    ("square", lambda x: x * x, -1e3, 1e3),
    ("fabs", mpmath.fabs, -1e3, 1e3),
]
IDS = [row[0] for row in FUNCTIONS]


@pytest.mark.parametrize(("name", "exact", "least", "greatest"), FUNCTIONS, ids=IDS)
def test_functions_enclose_every_value_on_the_ball(balls, name, exact, least, greatest):
    source = random.Random(name)
    for _ in range(150):
        width = (greatest - least) * 10.0 ** source.uniform(-14, 0)
        low = source.uniform(least, max(least, greatest - width))
        high = min(greatest, low + width)
        result = balls.NAMESPACE[name](balls.ball(low, high))
        if not balls.is_finite(result):  # a radius rounded up may reach beyond the edge of the domain
            assert min(low - least, greatest - high) <= 1e-8 * (high - low)
            continue
        for point in (low, high, *(source.uniform(low, high) for _ in range(8))):
            with mpmath.workdps(60):
                assert encloses(balls, result, exact(mpmath.mpf(min(max(point, low), high))))


@pytest.mark.parametrize(("name", "exact", "least", "greatest"), FUNCTIONS, ids=IDS)
def test_functions_are_tight_on_exact_numbers_and_on_narrow_balls(balls, name, exact, least, greatest):
    source = random.Random(name)
    for _ in range(40):
        point = source.uniform(0.9 * least + 0.1 * greatest, 0.1 * least + 0.9 * greatest)
        function = balls.NAMESPACE[name]
        with mpmath.workdps(60):
            value, slope = exact(mpmath.mpf(point)), mpmath.diff(exact, mpmath.mpf(point))
        at_point = function(balls.ball(point))
        assert balls.width(at_point) <= 5e-15 * max(abs(float(value)), 0.1)
        around = function(balls.ball(point - 1e-9, point + 1e-9))
        steep = abs(float(value if name == "cosh" else slope))  # arb bounds the slope of cosh by exp
        assert balls.width(around) <= 4e-9 * steep + 1e-14 * max(1.0, abs(float(value)))


@pytest.mark.parametrize("name", ["sin", "cos", "square", "fabs", "cosh", "tanh"])
def test_the_extreme_values_on_a_wide_ball_are_found(balls, name):
    function = balls.NAMESPACE[name]
    wide = function(balls.ball(-0.5, 2.0))
    low, high = {
        "sin": (math.sin(-0.5), 1.0),
        "cos": (math.cos(2.0), 1.0),
        "square": (0.0, 4.0),
        "fabs": (0.0, 2.0),
        "cosh": (1.0, math.cosh(2.0)),
        "tanh": (math.tanh(-0.5), math.tanh(2.0)),
    }[name]
    assert balls.lower(wide) <= low + 1e-15  # low and high are rounded
    assert high - 1e-15 <= balls.upper(wide)
    if name in ("square", "fabs"):
        assert balls.lower(wide) == 0.0
    assert balls.width(wide) <= 1.7 * (high - low)


def test_the_square_of_a_wide_ball_beside_zero_is_tight(balls):
    wide = balls.NAMESPACE["square"](balls.ball(-2.25, -0.25))
    assert balls.lower(wide) == pytest.approx(0.0625, abs=1e-8)
    assert balls.upper(wide) == pytest.approx(5.0625, abs=1e-7)


def test_exp_where_mpmath_itself_rounds_inward(balls):
    """At this exact binary fraction mpmath 1.3's interval exp misses the true value by its last bit."""
    point = 3893924827815215 / 2**50
    with mpmath.workdps(80):
        assert encloses(balls, balls.NAMESPACE["exp"](balls.ball(point)), mpmath.exp(mpmath.mpf(point)))


numbers = st.fractions(min_value=-1000, max_value=1000, max_denominator=10**6)
shares = st.fractions(min_value=0, max_value=1, max_denominator=1000)


@pytest.mark.parametrize("backend", BACKENDS)
@settings(max_examples=150, deadline=None)
@given(a=numbers, b=numbers, c=numbers, d=numbers, s=shares, t=shares)
def test_arithmetic_encloses_the_exact_result_at_every_point(backend, a, b, c, d, s, t):
    balls = MODULES[backend]
    (a, b), (c, d) = sorted((a, b)), sorted((c, d))
    x, y = balls.ball(a, b), balls.ball(c, d)
    p, q = a + s * (b - a), c + t * (d - c)
    assert encloses(balls, x + y, p + q)
    assert encloses(balls, x - y, p - q)
    assert encloses(balls, x * y, p * q)
    assert encloses(balls, 3 * x - 0.5 + y * 2.0, 3 * p - Fraction(1, 2) + 2 * q)
    quotient = x / y
    assert balls.is_finite(quotient) <= (not c <= 0 <= d)
    if balls.is_finite(quotient):
        assert encloses(balls, quotient, p / q)
    for n in (0, 1, 2, 3, 4, 5, 7):
        assert encloses(balls, balls.NAMESPACE["power"](x, n), p**n)
    inverse = balls.NAMESPACE["power"](y, -3)
    assert balls.is_finite(inverse) <= (not c <= 0 <= d)
    if balls.is_finite(inverse):
        assert encloses(balls, inverse, Fraction(1) / q**3)
    both = balls.hull(x, y)
    assert encloses(balls, both, p)
    assert encloses(balls, both, q)
    common = balls.intersection(x, y)
    if max(a, c) <= min(b, d):
        assert encloses(balls, common, max(a, c))
        assert encloses(balls, common, min(b, d))
    if max(a, c) > min(b, d) + Fraction(1, 1000):
        assert common is None


def test_powers_of_a_ball_centered_on_zero(balls):
    """The case in which the operator ** of arb gives up."""
    x, power = balls.ball(-1.0, 1.0), balls.NAMESPACE["power"]
    assert balls.lower(power(x, 4)) == 0.0
    assert balls.upper(power(x, 4)) == pytest.approx(1.0, abs=1e-6)
    assert balls.lower(power(x, 3)) == pytest.approx(-1.0, abs=1e-6)
    assert balls.upper(power(x, 3)) == pytest.approx(1.0, abs=1e-6)


def test_powers_with_an_exponent_that_is_no_integer(balls):
    third, base = balls.ball(Fraction(1, 3)), balls.ball(2.0, 3.0)
    with mpmath.workdps(60):
        for exact in (mpmath.mpf(2), mpmath.mpf("2.5"), mpmath.mpf(3)):
            assert encloses(balls, base**third, mpmath.cbrt(exact))
            assert encloses(balls, 2.0**base, 2**exact)
            assert encloses(balls, base**2, exact**2)
    assert balls.width(base**third) < 0.25
    assert not balls.is_finite(balls.ball(-1.0, 2.0) ** third)


def test_what_is_undefined_somewhere_is_not_finite_and_stays_so(balls):
    n, ball = balls.NAMESPACE, balls.ball
    through_zero = ball(-1.0, 2.0)
    undefined = [
        1 / through_zero,
        through_zero / through_zero,
        1.0 / ball(0.0),
        n["sqrt"](through_zero),
        n["sqrt"](ball(-2.0, -1.0)),
        n["log"](through_zero),
        n["log"](ball(0.0)),
        n["tan"](ball(1.0, 2.0)),
        n["asin"](ball(0.5, 1.5)),
        n["acos"](ball(-2.0, 0.0)),
        n["sign"](through_zero),
        n["atan2"](through_zero, ball(-2.0, -1.0)),
        n["atan2"](through_zero, through_zero),
        n["power"](through_zero, -2),
        n["exp"](n["exp"](n["exp"](ball(0.0, 1000.0)))),
        ball(0.0, math.inf),
    ]
    for b in undefined:
        functions = [n[name] for name in IDS if name not in ("tanh", "sin", "cos", "atan")] + [n["sign"]]
        results = [-b, b * 0, b + 1, 1 / b, b**2, b**3, abs(b), 1 / (1 + n["square"](b)), 1 / (1 + abs(b))]
        for result in (b, *results, *(f(b) for f in functions)):
            assert not balls.is_finite(result)
            assert balls.contains_zero(result)
            assert balls.lower(result) == -math.inf
            assert balls.upper(result) == math.inf
    for b in undefined[:14]:  # undefined, not merely large: even bounded functions of it decide nothing
        for name in ("sin", "cos", "atan", "tanh"):
            assert not balls.is_finite(n[name](b))


def test_square_roots_at_a_bound_that_is_exactly_zero(balls):
    root = balls.NAMESPACE["sqrt"](balls.ball(0.0, 4.0))
    assert balls.is_finite(root)
    assert balls.lower(root) == 0.0
    assert 2.0 <= balls.upper(root) < 2.5
    assert balls.upper(-balls.ball(0.0, 4.0)) == 0.0


@pytest.mark.parametrize(("y", "x"), [(1, 2), (1, -2), (-1, -2), (-1, 2), (1, 0), (-3, 0), (0, 5)])
def test_atan2_in_every_quadrant(balls, y, x):
    spread = balls.ball(-0.125, 0.125)
    result = balls.NAMESPACE["atan2"](y + spread, x + spread)
    corners = [math.atan2(y + a, x + b) for a in (-0.125, 0.0, 0.125) for b in (-0.125, 0.0, 0.125)]
    assert balls.lower(result) <= min(corners)
    assert max(corners) <= balls.upper(result)
    assert balls.width(result) <= 1.2 * (max(corners) - min(corners))


def test_sign_of_balls_beside_zero(balls):
    sign = balls.NAMESPACE["sign"]
    assert balls.midpoint(sign(balls.ball(1e-6, 2.0))) == 1.0
    assert balls.midpoint(sign(balls.ball(-3.0, -1e-6))) == -1.0


def test_pi_is_enclosed(balls):
    with mpmath.workdps(60):
        assert encloses(balls, balls.NAMESPACE["pi"], +mpmath.pi)
    assert balls.width(balls.NAMESPACE["pi"] + 0) < 1e-14


def test_a_float_is_exact_a_fraction_is_enclosed(balls):
    for exact in (0.1, -3.75, 1e300, 5e-324, 0.0, 7, np.float64(0.1), np.int64(7), sm.Integer(7), True):
        assert balls.lower(balls.ball(exact)) == float(exact) == balls.upper(balls.ball(exact))
    for value in (Fraction(1, 3), Decimal("0.1"), sm.Rational(1, 3), 10**40 + 1):
        b = balls.ball(value)
        assert encloses(balls, b, Fraction(str(value)) if not isinstance(value, Decimal) else Fraction(value))
        assert 0.0 < balls.width(b) <= 1e-15 * abs(float(value))
        assert balls.midpoint(b) == pytest.approx(float(value), rel=1e-15)
    pair = balls.ball(Fraction(1, 3), Fraction(2, 3))
    assert encloses(balls, pair, Fraction(1, 3))
    assert encloses(balls, pair, Fraction(2, 3))


@settings(max_examples=100, deadline=None)
@given(a=st.floats(allow_nan=False, allow_infinity=False), b=st.floats(allow_nan=False, allow_infinity=False))
def test_a_ball_between_any_two_floats_encloses_both(a, b):
    low, high = sorted((a, b))
    for balls in MODULES.values():
        pair = balls.ball(low, high)
        assert balls.lower(pair) <= low
        assert high <= balls.upper(pair)
        assert Fraction(high) - Fraction(low) <= balls.width(pair)


def test_plain_numbers_are_never_rounded_on_the_way(balls):
    n = balls.NAMESPACE
    assert encloses(balls, n["square"](0.1), Fraction(0.1) ** 2)
    assert encloses(balls, n["power"](0.1, 3), Fraction(0.1) ** 3)
    assert encloses(balls, n["power"](3, -1), Fraction(1, 3))
    assert encloses(balls, n["atan2"](1.0, balls.ball(2.0)), mpmath.atan(mpmath.mpf(1) / 2))
    with mpmath.workdps(60):
        assert encloses(balls, n["sqrt"](2), mpmath.sqrt(2))
        assert encloses(balls, n["sin"](Fraction(1, 3)), mpmath.sin(mpmath.mpf(1) / 3))


@pytest.mark.parametrize("bad", [math.nan, "1.5", None, 1j, Decimal("NaN"), [1.0]])
def test_what_is_no_number_is_refused(balls, bad):
    with pytest.raises(EngdynError, match="has no ball"):
        balls.ball(bad)


def test_exchanged_bounds_are_refused(balls):
    with pytest.raises(EngdynError, match="exceeds the upper"):
        balls.ball(2.0, 1.0)
    with pytest.raises(EngdynError, match="exceeds the upper"):
        balls.ball(Fraction(1, 2), Fraction(1, 3))


def test_the_environment_chooses_the_backend(monkeypatch):
    assert {backend: module.BACKEND for backend, module in MODULES.items()} == {b: b for b in BACKENDS}
    with pytest.raises(EngdynError, match="no backend"):
        load_balls("fortran")
    monkeypatch.setattr(
        importlib.util,
        "find_spec",
        lambda name, find=importlib.util.find_spec: None if name == "flint" else find(name),
    )
    monkeypatch.setitem(sys.modules, "flint", None)
    assert load_balls("").BACKEND == "sympy"
    with pytest.raises(EngdynError, match="python-flint"):
        load_balls("flint")


def test_the_private_interval_context_leaves_mpmath_alone():
    assert "sympy" in MODULES
    before = mpmath.iv.mpf([1, 2]) / mpmath.iv.mpf([0, 1])
    assert before.b == mpmath.inf  # mpmath's own division still answers as mpmath does
    assert float(before.a.a) == 1.0
