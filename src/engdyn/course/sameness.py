"""Are two expressions the same?  Exact where the algebra decides, else to 45 digits at many points.

The difference of two expressions is brought into the normal form of the trigonometric ring: zero means
the same, and for expressions without roots, magnitudes and further functions anything else means
different. Roots that depend on each other (``sqrt(a*b)`` and ``sqrt(a)*sqrt(b)``) and inverse functions are
beyond that normal form; only then does agreement to 45 digits at two dozen points count as the same.
"""

from __future__ import annotations

import random
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from itertools import count, islice
from math import comb, lcm
from typing import Any

import sympy as sm
from sympy.physics.vector import dynamicsymbols

from engdyn.algebra.conversion import Converter
from engdyn.algebra.scan import RECIPROCAL, angle_terms, half_power
from engdyn.course.evaluation import NoValueError, evaluate, real
from engdyn.errors import EngdynError
from engdyn.system import System

__all__ = ["Points", "cost", "same"]

#: Largest estimated number of terms of a normal form, and largest multiple of an angle, worth computing.
TERMS, MULTIPLE = 3000, 24
#: Points tried for agreement, how many must have a value, and how close the values must be.
ATTEMPTS, ENOUGH, CLOSE, ROUNDED = 60, 24, 1e-45, 1e-9


class Points:
    """Points near the values of an exercise at which expressions are compared; the same in every run.

    Parameters
    ----------
    system : System
        Gives parameters, coordinates and inputs.
    values : mapping of str to float
        Parameters around which points are drawn, within ±20 %.
    accepted : callable, optional
        Whether a set of parameters belongs to the exercise; others are left out.
    """

    def __init__(
        self,
        system: System,
        values: Mapping[str, float],
        accepted: Callable[[dict[str, float]], bool] = lambda values: True,
    ):
        self.values, self._accepted = dict(values), accepted
        t = dynamicsymbols._t
        self._parameters = {p.symbol: p.name for p in system.parameters}
        self._moving = [
            (
                [moving.symbol.diff(t, order) if order else moving.symbol for order in (0, 1, 2)],
                _bounds(moving),
            )
            for moving in (*system.coordinates, *system.inputs)
        ]
        self._drawn: list[dict[sm.Expr, Any]] = []
        self._source = random.Random(20)

    def __iter__(self) -> Iterator[dict[sm.Expr, Any]]:
        """Points without end: symbol → 200-bit number."""
        for at in count():
            if at == len(self._drawn):
                self._drawn.append(self._draw())
            yield self._drawn[at]

    def take(self, number: int) -> list[dict[sm.Expr, Any]]:
        """The first points."""
        return list(islice(self, number))

    def here(self) -> dict[sm.Expr, Any]:
        """The parameters alone, at the values of the exercise."""
        return {symbol: real(self.values[name]) for symbol, name in self._parameters.items()}

    def _draw(self) -> dict[sm.Expr, Any]:
        uniform, values = self._source.uniform, self._near()
        for _ in range(50):
            if self._accepted(values):
                break
            values = self._near()
        point = {symbol: real(values[name]) for symbol, name in self._parameters.items()}
        for (place, rate, acceleration), (low, high) in self._moving:
            point[place] = real(low + (high - low) * uniform(0.15, 0.85))
            point[rate], point[acceleration] = real(uniform(-2.0, 2.0)), real(uniform(-2.0, 2.0))
        return point

    def _near(self) -> dict[str, float]:
        uniform = self._source.uniform
        return {
            name: value * uniform(0.8, 1.2) if value else uniform(0.1, 1.0)
            for name, value in self.values.items()
        }


def _bounds(moving: Any) -> tuple[float, float]:
    """Where a coordinate or an input is drawn."""
    return getattr(moving, "bounds", None) or (-2.0, 2.0)


def same(a: sm.Expr, b: sm.Expr, points: Points) -> bool:
    """Whether two expressions are equal wherever the exercise lives.

    Parameters
    ----------
    a, b : sympy.Expr
        In the symbols of the exercise's system.
    points : Points
        Where they are compared if the algebra cannot decide.
    """
    difference = sm.Add(a, sm.Mul(-1, b))
    if cost(difference) <= TERMS:
        try:
            converter = Converter([difference])
            if converter.convert(difference).is_zero():
                return True
            if not any(d.kind in ("root", "magnitude", "call") for d in converter.ring.definitions.values()):
                return _rounded(a) and agree(a, b, points, ROUNDED)
        except (EngdynError, ArithmeticError):
            pass  # outside the ring: the points decide
    return agree(a, b, points, ROUNDED if _rounded(a) else CLOSE)


def _rounded(expr: sm.Expr) -> bool:
    """Whether an expression contains decimals of many digits: a rounded 1/3, say."""
    return any(len(repr(float(number))) > 8 for number in expr.atoms(sm.Float))


def agree(a: sm.Expr, b: sm.Expr, points: Points, tolerance: float, enough: int = ENOUGH) -> bool:
    """Whether two expressions have the same values, within a share of their scale, at enough points."""
    for found, (x, y, scale) in enumerate(value_pairs(a, b, islice(points, ATTEMPTS)), start=1):
        if abs(x - y) > tolerance * scale:
            return False
        if found == enough:
            return True
    return False


def value_pairs(
    a: sm.Expr, b: sm.Expr, points: Iterable[Mapping[sm.Expr, Any]]
) -> Iterator[tuple[Any, Any, Any]]:
    """Values of two expressions and their common scale, at the points where `b` has one.

    A point at which `b` has a value and `a` has not yields a difference as large as the scale.
    """
    for point in points:
        try:
            y, scale_b = evaluate(b, point)
        except NoValueError:
            continue
        try:
            x, scale_a = evaluate(a, point)
        except NoValueError:
            x, scale_a = y + 1 + abs(y), 1 + abs(y)
        yield x, y, max(scale_a, scale_b)


def cost(expr: sm.Expr) -> float:
    """Estimate from above of the number of terms in the normal form of an expression."""
    above, below = _cost(expr, {})
    return above + below


def _cost(expr: sm.Basic, known: dict) -> tuple[float, float]:
    """Estimated terms of numerator and denominator."""
    if expr not in known:
        known[expr] = tuple(min(c, 1e9) for c in _terms(expr, known))
    return known[expr]


def _terms(expr: sm.Basic, known: dict) -> tuple[float, float]:
    parts: Sequence[tuple[float, float]]
    if expr.is_Add:
        parts = [_cost(a, known) for a in expr.args]
        below = _product(d for _, d in parts)
        return sum(n * below / d for n, d in parts), below
    if expr.is_Mul:
        parts = [_cost(a, known) for a in expr.args]
        return _product(n for n, _ in parts), _product(d for _, d in parts)
    if isinstance(expr, sm.Pow) and (expr.exp.is_Integer or half_power(expr)):
        power = abs(int(2 * expr.exp)) if half_power(expr) else abs(int(expr.exp))
        above, below = (comb(min(int(c), 10**4) + power - 1, power) for c in _cost(expr.base, known))
        return (above, below) if expr.exp > 0 else (below, above)
    if isinstance(expr, (sm.sin, sm.cos, *RECIPROCAL)):
        pair = _angle_terms(expr.args[0], known)
        return (pair, pair) if isinstance(expr, tuple(RECIPROCAL)) else (pair, 1.0)
    if expr.args and isinstance(expr, sm.Function | sm.Pow) and not hasattr(expr, "name"):
        return _product(n * d for n, d in (_cost(a, known) for a in expr.args)), 1.0
    return 1.0, 1.0


def _angle_terms(angle: sm.Expr, known: dict) -> float:
    """Estimated terms of the sine of an angle, infinite where its multiples are too high."""
    if angle.is_Add and sum(_cost(angle, known)) > 50:
        return 1e9
    multiples = angle_terms(angle)
    whole = lcm(*(factor.denominator for _, factor in multiples))
    if whole > MULTIPLE or any(abs(factor) * whole > MULTIPLE for _, factor in multiples):
        return 1e9
    return _product(
        2.0 * (float(abs(factor) * whole) + 1) * sum(_cost(base, known)) for base, factor in multiples
    )


def _product(numbers: Iterable[float]) -> float:
    total = 1.0
    for number in numbers:
        total *= number
    return total
