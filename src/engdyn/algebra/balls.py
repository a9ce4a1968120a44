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


def _integer_power(x: Any, n: int, square: Callable[[Any], Any]) -> Any:
    if n < 0:
        return 1 / _integer_power(x, -n, square)
    if n < 2:
        return x if n else x * 0 + 1
    half = square(_integer_power(x, n // 2, square))
    return half * x if n % 2 else half


class _ArbBalls:
    """Primitives on ``flint.arb``: a 53-bit midpoint with a 30-bit radius, computed in C."""

    def __init__(self) -> None:
        import flint

        self.arb, self.fmpq = flint.arb, flint.fmpq
        self.undefined = flint.arb.nan()
        with flint.ctx.workprec(512):  # callers may raise the working precision
            self.pi = flint.arb.pi()
        names = ("sqrt", "exp", "log", "sin", "cos", "tan", "sinh", "cosh", "asin", "acos", "atan")
        self.functions = {name: getattr(flint.arb, name) for name in names}
        self.functions |= {"square": self.square, "fabs": self.fabs, "tanh": self.tanh}

    def is_ball(self, x: Any) -> bool:
        return type(x) is self.arb

    def rational(self, numerator: int, denominator: int) -> Any:
        return self.arb(self.fmpq(numerator, denominator))

    def between(self, low: float, high: float) -> Any:
        if low == high:
            return self.arb(low)
        middle = 0.5 * low + 0.5 * high
        radius = math.nextafter(max(high - middle, middle - low), math.inf)
        if low == 0.0 or high == 0.0:  # keep the bound exactly zero, so that a root stays defined
            return self._from_zero(radius) if low == 0.0 else -self._from_zero(radius)
        return self.arb(middle, radius)

    def _from_zero(self, radius: Any) -> Any:
        """Return an enclosure of [0, 2 radius] with lower bound exactly zero (the radius is rounded up)."""
        symmetric = self.arb(0, radius)
        return symmetric + symmetric.rad()

    def lower(self, x: Any) -> float:
        bound = x.lower()
        value = float(bound)
        if bound >= value:
            return value
        return math.nextafter(value, -math.inf) if value > -math.inf else -math.inf

    def midpoint(self, x: Any) -> float:
        return float(x.mid())

    def is_finite(self, x: Any) -> bool:
        return x.is_finite()

    def excludes_zero(self, x: Any) -> bool:
        return x != 0

    def tanh(self, x: Any) -> Any:
        if x.rad() < 0.25:
            return x.tanh()
        return x.lower().tanh().union(x.upper().tanh())  # arb loses wide balls

    def fabs(self, x: Any) -> Any:
        absolute = self.arb.__abs__(x)
        return absolute if x != 0 or not x.is_finite() else self._from_zero(x.abs_upper() / 2)

    def square(self, x: Any) -> Any:
        product = self.arb.__mul__(x, x)  # a plain number is refused here, never squared with rounding
        if product > 0 or not product.is_finite():
            return product
        if x != 0:  # a wide ball: (m + r)^2 ranges over m^2 + r^2 +- 2 m r
            middle, radius = x.mid(), x.rad()
            return middle * middle + radius * radius + self.arb(0, 2 * abs(middle) * radius)
        return self._from_zero(product.abs_upper() / 2)


class _IntervalBalls:
    """Primitives on mpmath's intervals: pairs of 53-bit bounds, computed in Python.

    mpmath rounds its elementary functions almost, but not always, outward; so each bound is computed with
    90 bits, moved outward by 2^-75 of its size and then rounded outward. What overflows or is undefined
    becomes the whole line; quotients, powers and functions of the whole line are the whole line.
    """

    # name, end points of the domain (kept where neither time nor memory explodes)
    domains = (
        ("exp", -1e6, 1e6),
        ("sinh", -1e6, 1e6),
        ("cosh", -1e6, 1e6),
        ("log", 5e-324, 1e300),
        ("sqrt", 0.0, 1e300),
        ("tanh", -1e300, 1e300),
        ("atan", -1e300, 1e300),
        ("asin", -1.0, 1.0),
        ("acos", -1.0, 1.0),
    )

    def __init__(self) -> None:
        from mpmath import libmp
        from mpmath.ctx_iv import MPIntervalContext

        self.lib, context = libmp, MPIntervalContext()
        self.make, self.type = context.make_mpf, context.mpf  # a class of this private context alone
        self.undefined, self.pi = self.make((libmp.fninf, libmp.finf)), +context.pi
        divide, divide_into = self.type.__truediv__, self.type.__rtruediv__
        self.type.__truediv__ = lambda x, y: self._finite(divide(x, y), x, y)
        self.type.__rtruediv__ = lambda x, y: self._finite(divide_into(x, y), x, y)
        self.type.__pow__ = lambda x, exponent: self._raise(x, exponent)
        self.type.__rpow__ = lambda x, base: self._raise(base, x)
        self.type.__abs__ = lambda x: self.fabs(x)
        self.functions = {name: getattr(self, name) for name in ("sin", "cos", "tan", "square", "fabs")}
        for name, low, high in self.domains:
            self.functions[name] = self._on_domain(name, libmp.from_float(low), libmp.from_float(high))

    def is_ball(self, x: Any) -> bool:
        return type(x) is self.type

    def _finite(self, result: Any, *operands: Any) -> Any:
        """Return the result, or the whole line where it or an operand is unbounded."""
        bounded = all(self.is_finite(x) for x in (result, *operands) if self.is_ball(x))
        return result if bounded else self.undefined

    def _raise(self, base: Any, exponent: Any) -> Any:
        base = self.type(base)
        if isinstance(exponent, int):
            return _integer_power(base, exponent, self.square)
        return self.functions["exp"](self.functions["log"](base) * exponent)

    def _on_domain(self, name: str, least: Any, greatest: Any) -> Callable[[Any], Any]:
        """Return an elementary function that is monotonic (or even, cosh) on its domain, undefined beyond."""
        function = getattr(self.lib, f"mpf_{name}")

        def bound(x: Any, upward: bool) -> Any:
            value = function(x, 90)
            pad = 1 if bool(value[0]) != upward else -1  # value[0] is the sign bit
            factor = self.lib.from_man_exp((1 << 75) + pad, -75)
            return self.lib.mpf_mul(value, factor, 53, "c" if upward else "f")

        def enclosed(x: Any) -> Any:
            low, high = self.fabs(x)._mpi_ if name == "cosh" else x._mpi_
            if not (self.lib.mpf_le(least, low) and self.lib.mpf_le(high, greatest)):
                return self.undefined
            low, high = (high, low) if name == "acos" else (low, high)
            return self.make((bound(low, False), bound(high, True)))

        return enclosed

    def rational(self, numerator: int, denominator: int) -> Any:
        return self.make(tuple(self.lib.from_rational(numerator, denominator, 53, down) for down in "fc"))

    def between(self, low: float, high: float) -> Any:
        return self.make((self.lib.from_float(low), self.lib.from_float(high)))

    def lower(self, x: Any) -> float:
        bound = x._mpi_[0]
        value = self.lib.to_float(bound)
        exact = self.lib.mpf_ge(bound, self.lib.from_float(value))
        return value if exact else math.nextafter(value, -math.inf)

    def midpoint(self, x: Any) -> float:
        return self.lib.to_float(self.lib.mpi_mid(x._mpi_, 53))

    def is_finite(self, x: Any) -> bool:
        return x._mpi_[0] != self.lib.fninf and x._mpi_[1] != self.lib.finf

    def excludes_zero(self, x: Any) -> bool:
        return self.lib.mpf_sign(x._mpi_[0]) > 0 or self.lib.mpf_sign(x._mpi_[1]) < 0

    def fabs(self, x: Any) -> Any:
        return self._finite(self.make(self.lib.mpi_abs(x._mpi_, 53)), x)

    def square(self, x: Any) -> Any:
        return self._finite(self.make(self.lib.libmpi.mpi_square(x._mpi_, 53)), x)

    def cos(self, x: Any) -> Any:
        return self._circular(x)[0]

    def sin(self, x: Any) -> Any:
        return self._circular(x)[1]

    def _circular(self, x: Any) -> tuple[Any, Any]:
        """Return cosine and sine: [-1, 1] for numbers so large that reducing them would take too long."""
        if not self.is_finite(x):
            return self.undefined, self.undefined
        if max(bound[2] + bound[3] for bound in x._mpi_) > 1000:  # binary exponents
            return self.between(-1.0, 1.0), self.between(-1.0, 1.0)
        cosine, sine = self.lib.libmpi.mpi_cos_sin(x._mpi_, 53)  # pads its results itself
        return self.make(cosine), self.make(sine)

    def tan(self, x: Any) -> Any:
        if not self.excludes_zero(self.cos(x)):
            return self.undefined
        ends = [self._circular(self.make((bound, bound))) for bound in x._mpi_]  # rising between its poles
        return self.make(((ends[0][1] / ends[0][0])._mpi_[0], (ends[1][1] / ends[1][0])._mpi_[1]))


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
    return _integer_power(_number(x), n, _backend.square)


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
    """Let a function of balls take plain numbers as well."""

    def lifted(*arguments: Any) -> Any:
        try:
            return function(*arguments)
        except (TypeError, AttributeError):
            return function(*map(_number, arguments))

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

_backend: Any = _ArbBalls() if BACKEND == "flint" else _IntervalBalls()

NAMESPACE: dict[str, Any] = {name: _of_numbers(function) for name, function in _backend.functions.items()}
"""What generated code may call on balls: elementary functions, ``square power fabs sign atan2``, ``pi``."""
NAMESPACE |= {"sign": _of_numbers(sign), "atan2": _of_numbers(atan2), "power": power, "pi": _backend.pi}
