"""The two backends of ball arithmetic: the same primitives on ``flint.arb`` and on mpmath's intervals."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

__all__ = ["ArbBalls", "IntervalBalls", "integer_power"]


def integer_power(x: Any, n: int, square: Callable[[Any], Any]) -> Any:
    """Return x^n by repeated squaring, which keeps even powers from reaching below zero."""
    if n < 0:
        return 1 / integer_power(x, -n, square)
    if n < 2:
        return x if n else x * 0 + 1
    half = square(integer_power(x, n // 2, square))
    return half * x if n % 2 else half


class ArbBalls:
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


class IntervalBalls:
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
            return integer_power(base, exponent, self.square)
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
