"""Ball arithmetic: numbers known to lie between two bounds, every rounding error accounted for.

A *ball* encloses a real number, or all values a quantity takes on a box. It can prove that something is not
zero; it never claims more than it can prove. One small interface stands in front of two backends:

- ``flint.arb`` (python-flint, compiled), used where it is installed;
- mpmath's real intervals in a private context (pure Python, some ten times slower).

The environment variable ``ENGDYN_BACKEND`` (``flint`` or ``sympy``), read at import, overrules the choice.
Balls support ``+ - * /`` with balls, ints and floats (a float is taken as exact); the functions in
`NAMESPACE` are what generated code may call. **Write an integer power as** ``power(x, n)`` **or**
``square(x)``: the operator ``**`` of ``arb`` gives up (non-finite) on a wide ball whose midpoint is zero.

What is not defined and continuous on the whole ball (a root reaching below zero, a division by a ball that
contains zero, a sign that changes) is a non-finite ball. It stays non-finite in everything computed from it,
so it decides nothing, and no operation on balls raises.

Course section 4.2. Sources: F. Johansson, "Arb: efficient arbitrary-precision midpoint-radius interval
arithmetic", IEEE Trans. Computers 66 (2017); R. E. Moore, R. B. Kearfott and M. J. Cloud, *Introduction to
Interval Analysis*, SIAM (2009).
"""

from __future__ import annotations

import importlib.util
import math
import os
from collections.abc import Callable
from decimal import Decimal
from numbers import Rational
from typing import Any

from engdyn.algebra.ball_backends import ArbBalls, IntervalBalls, integer_power
from engdyn.errors import EngdynError

__all__ = [
    "BACKEND",
    "NAMESPACE",
    "ball",
    "contains_zero",
    "hull",
    "intersection",
    "is_finite",
    "lower",
    "midpoint",
    "upper",
    "width",
]


def ball(lower: Any, upper: Any = None) -> Any:
    """Return a ball that encloses one number, or everything between two numbers.

    Parameters
    ----------
    lower, upper : float, int, Fraction, Decimal, any exact rational, or ball
        The bounds; `upper` may be left out. A float is taken as exact, a fraction or decimal is enclosed.

    Raises
    ------
    EngdynError
        When a bound is NaN or not a number, or `lower` exceeds `upper`.
    """
    if upper is None:
        return _number(lower)
    if isinstance(lower, float) and isinstance(upper, float) and -math.inf < lower <= upper < math.inf:
        return _backend.between(lower, upper)
    low, high = _number(lower), _number(upper)
    if _backend.lower(low - high) > 0.0:
        raise EngdynError(f"ball({lower!r}, {upper!r}): the lower bound exceeds the upper; exchange them.")
    return hull(low, high)


def _number(value: Any) -> Any:
    """Return the ball of one number: itself, exact, or a tight enclosure."""
    if _backend.is_ball(value):
        return value
    if isinstance(value, float) and not math.isnan(value):
        return _backend.between(float(value), float(value)) if math.isfinite(value) else _backend.undefined
    if isinstance(value, Rational):
        return _backend.rational(int(value.numerator), int(value.denominator))
    if isinstance(value, Decimal) and value.is_finite():
        return _backend.rational(*value.as_integer_ratio())
    raise EngdynError(
        f"{value!r} has no ball: give a number that is not NaN (float, int, Fraction, Decimal)."
    )


def lower(b: Any) -> float:
    """Return the lower bound as a float, rounded down (-inf where the ball is not finite)."""
    return _backend.lower(b)


def upper(b: Any) -> float:
    """Return the upper bound as a float, rounded up (inf where the ball is not finite)."""
    return -_backend.lower(-b)


def midpoint(b: Any) -> float:
    """Return a float near the middle (not finite where the ball is not): a good guess, never a bound."""
    return _backend.midpoint(b)


def width(b: Any) -> float:
    """Return upper minus lower bound as a float, rounded up."""
    low, high = lower(b), upper(b)
    return math.nextafter(high - low, math.inf) if high > low else 0.0


def is_finite(b: Any) -> bool:
    """Return whether both bounds are finite; a ball that is not decides nothing."""
    return _backend.is_finite(b)


def contains_zero(b: Any) -> bool:
    """Return False only when zero is proved to lie outside the ball."""
    return not _backend.excludes_zero(b)


def hull(a: Any, b: Any) -> Any:
    """Return a ball that encloses both balls."""
    low, high = min(lower(a), lower(b)), max(upper(a), upper(b))
    return _backend.between(low, high) if -math.inf < low <= high < math.inf else _backend.undefined


def intersection(a: Any, b: Any) -> Any:
    """Return a ball that encloses what both balls have in common, None when that is proved to be nothing."""
    low, high = max(lower(a), lower(b)), min(upper(a), upper(b))
    if low > high:
        return None
    return _backend.between(low, high) if -math.inf < low <= high < math.inf else _backend.undefined


def power(x: Any, n: int) -> Any:
    """Return x^n for an integer n; an even power of a ball through zero is not negative."""
    return integer_power(_number(x), n, _backend.square)


def sign(x: Any) -> Any:
    """Return -1 or 1; where the sign is not certain the function may jump, so the ball is not finite."""
    return _backend.undefined if contains_zero(x) else ball(1 if lower(x) > 0.0 else -1)


def atan2(y: Any, x: Any) -> Any:
    """Return the angle of (x, y) in (-pi, pi]; not finite where the ball meets the cut y = 0, x <= 0."""
    arctangent = NAMESPACE["atan"]
    if lower(x) > 0.0:
        return arctangent(y / x)
    return _backend.undefined if contains_zero(y) else sign(y) * _backend.pi / 2 - arctangent(x / y)


def _of_numbers(function: Callable[..., Any]) -> Callable[..., Any]:
    """Let a function of balls take plain numbers as well.

    The methods of ``arb`` do not check what they are given: a float is read as if it were a ball, with
    wrong results or a crash.
    """
    is_ball = _backend.is_ball

    def lifted(*arguments: Any) -> Any:
        for x in arguments:
            if not is_ball(x):
                return function(*map(_number, arguments))
        return function(*arguments)

    return lifted


def _choose_backend() -> str:
    """Return the backend the environment asks for, ``flint`` by default where it is installed."""
    wanted = os.environ.get("ENGDYN_BACKEND", "")
    installed = importlib.util.find_spec("flint") is not None
    if wanted not in ("", "flint", "sympy"):
        raise EngdynError(
            f"ENGDYN_BACKEND={wanted!r} is no backend: set it to 'flint' or 'sympy', or unset it."
        )
    if wanted == "flint" and not installed:
        raise EngdynError(
            "ENGDYN_BACKEND='flint' needs python-flint, which is missing: install it or unset it."
        )
    return wanted or ("flint" if installed else "sympy")


BACKEND = _choose_backend()
"""Name of the backend in use: ``"flint"`` or ``"sympy"``."""

_backend: Any = ArbBalls() if BACKEND == "flint" else IntervalBalls()

NAMESPACE: dict[str, Any] = {name: _of_numbers(function) for name, function in _backend.functions.items()}
"""What generated code may call on balls: elementary functions, ``square power fabs sign atan2``, ``pi``."""
NAMESPACE |= {"sign": _of_numbers(sign), "atan2": _of_numbers(atan2), "power": power, "pi": _backend.pi}
