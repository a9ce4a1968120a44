"""Second pass: sympy expressions become elements of a trigonometric ring.

Angles may be any rational combination of base angles: their sines and cosines are expanded by
angle addition, so that ``cos(a - b)`` and ``cos(a)*cos(b) + sin(a)*sin(b)`` are one element.
Floats enter as the rational of their shortest decimal (0.1 is 1/10).
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from fractions import Fraction

import sympy as sm

from engdyn.algebra.expressions import as_expression
from engdyn.algebra.ring import Definition, Element, Ring, add_angles
from engdyn.algebra.roots import define_call, define_magnitude, define_root
from engdyn.algebra.scan import (
    RECIPROCAL,
    Key,
    Scan,
    angle_terms,
    as_fraction,
    derivative_key,
    exact_phase,
    half_power,
    independent_atoms,
    is_opaque,
    slopes,
)

__all__ = ["Converter"]


class Converter:
    """A ring made for a set of expressions, and the translation into it.

    Parameters
    ----------
    expressions : iterable of sympy.Expr
        Everything that will be converted; anything outside raises ``OutsideRingError``.
    extra : iterable of tuple
        Keys of further independent generators (accelerations, say).
    substitutions : dict, optional
        Key of a time derivative → the expression that stands in its place (kinematics q̇ = G u + g).
    moving : iterable of sympy.Expr
        Those of the expressions that will be differentiated by time: their dynamicsymbols that are not
        among `extra` get generators for two further derivatives.
    last : sequence of tuple
        Keys that come after all others, reaction unknowns for example: rings that differ in them alone
        agree in all other generators.
    room : int
        Generators to keep in reserve, see :class:`Ring`.
    """

    def __init__(
        self,
        expressions: Iterable[sm.Expr],
        extra: Iterable[Key] = (),
        substitutions: dict[Key, sm.Expr] | None = None,
        moving: Iterable[sm.Expr] = (),
        last: Sequence[Key] = (),
        room: int = 0,
    ):
        self._substitutions = substitutions or {}
        scan = Scan(self._substitutions)
        first = list(dict.fromkeys(extra))
        scan.read(e if isinstance(e, sm.Basic) else as_expression(e) for e in moving)
        first += scan.prescribed({key[1] for key in first})
        scan.read(e if isinstance(e, sm.Basic) else as_expression(e) for e in expressions)
        self.ring = Ring(scan.keys(first, last), room)
        self._divisors = scan.divisors
        self._known: dict[sm.Basic, Element] = {}
        self._dependent: dict[Key, Element] = {}
        for base, divisor in scan.divisors.items():
            self.ring.define_angle(base, divisor)
        for key in scan.dependent:
            self._define(key)
        self._fill_slopes(scan.dependent)
        for base, divisor in scan.divisors.items():
            self.ring.set_angle(base, divisor, self.convert(base) * Fraction(1, divisor))

    def convert(self, expr: sm.Expr) -> Element:
        """The ring element of an expression whose generators the ring has."""
        found = self._known.get(expr)
        if found is None:
            found = self._known[expr] = self._translate(expr)
        return found

    def _translate(self, expr: sm.Basic) -> Element:
        if not isinstance(expr, sm.Basic):
            return self.convert(as_expression(expr))
        if expr.is_Add:
            total = self.convert(expr.args[0])
            for term in expr.args[1:]:
                total = total + self.convert(term)
            return total
        if expr.is_Mul:
            product = self.convert(expr.args[0])
            for factor in expr.args[1:]:
                product = product * self.convert(factor)
            return product
        if expr.is_Number:
            return self.ring.constant(as_fraction(expr))
        if expr.is_Symbol or expr is sm.S.Pi:
            return self.ring.generator(("symbol", expr))
        if expr.is_Pow and isinstance(expr.exp, sm.Integer):
            return self.convert(expr.base) ** int(expr.exp)
        return self._translate_function(expr)

    def _translate_function(self, expr: sm.Basic) -> Element:
        key = derivative_key(expr)
        if key is not None:
            if key in self._substitutions:
                return self.convert(self._substitutions[key])
            return self.ring.generator(key)
        if isinstance(expr, sm.cos):
            return self._angle(expr.args[0])[0]
        if isinstance(expr, sm.sin):
            return self._angle(expr.args[0])[1]
        if type(expr) in RECIPROCAL:
            c, s = self._angle(expr.args[0])
            return {
                sm.tan: lambda: s / c,
                sm.cot: lambda: c / s,
                sm.sec: lambda: 1 / c,
                sm.csc: lambda: 1 / s,
            }[type(expr)]()
        if isinstance(expr, sm.Derivative):
            return self.convert(expr.doit())
        if half_power(expr):
            return self._root(expr.base) ** int(2 * expr.exp)
        if isinstance(expr, sm.Abs):
            return self._dependent["magnitude", expr.args[0]]
        if isinstance(expr, sm.sign):
            return self._dependent["magnitude", expr.args[0]] / self.convert(expr.args[0])
        return self._dependent["call", expr]

    def _angle(self, angle: sm.Expr) -> tuple[Element, Element]:
        """Cosine and sine of an angle."""
        pair = self.ring.one, self.ring.zero
        for base, factor in angle_terms(angle):
            exact = exact_phase(factor) if base is sm.S.Pi else None
            if exact is None:
                divisor = self._divisors[base]
                part = self.ring.multiple_angle(base, divisor, int(factor * divisor))
            else:
                part = self.convert(exact[0]), self.convert(exact[1])
            pair = add_angles(pair, part)
        return pair

    def _define(self, key: Key) -> None:
        kind, expr = key
        index = self.ring.index[key]
        if kind == "root":
            self._dependent[key] = define_root(self.ring, index, self.convert(expr))
        elif kind == "denominator":
            self._dependent[key] = self._define_denominator(expr, index)
        elif kind == "magnitude":
            self._dependent[key] = define_magnitude(self.ring, index, self.convert(expr))
        else:
            self._define_call(key)

    def _root(self, base: sm.Expr) -> Element:
        """√(n/d) as √(n d)/|d|."""
        return self._dependent["root", base] / self._dependent["denominator", base]

    def _define_denominator(self, base: sm.Expr, index: int) -> Element:
        """|d| of a radicand n/d: d itself where it is made of positive symbols only."""
        ring, radicand = self.ring, self.convert(base)
        if radicand.denominator is None:
            return ring.one
        below = Element(ring, radicand.denominator)
        symbols = [ring.keys[i] for i in below.generators()]
        positive = all(key[0] == "symbol" and key[1].is_positive for key in symbols)
        if positive and all(c > 0 for _, c in ring.polynomials.terms(below.numerator)):
            return below
        return define_magnitude(ring, index, below)

    def _define_call(self, key: Key) -> None:
        """A function value: one generator per distinct argument list."""
        ring, expr = self.ring, key[1]
        index = ring.index[key]
        contains: frozenset[int] = frozenset()
        if is_opaque(expr) and not expr.is_Pow:
            arguments: tuple[Element, ...] = ()
            contains = frozenset(i for a in independent_atoms(expr) for i in self.convert(a).generators())
        else:
            arguments = tuple(self.convert(a) for a in expr.args)
        self._dependent[key] = define_call(ring, index, Definition("call", arguments, (), contains))

    def _fill_slopes(self, keys: Iterable[Key]) -> None:
        for key in keys:
            definition = self.ring.definitions.get(self.ring.index[key])
            if key[0] != "call" or definition is None or not definition.arguments:
                continue
            if key[1].is_Pow:
                base, exponent = definition.arguments
                generator = Element(self.ring, self.ring.polynomials.gens[self.ring.index[key]])
                definition.slopes = (exponent * generator / base, None)
                definition.contains = frozenset(exponent.generators())
                continue
            found = [None if s is None else self.convert(s) for s in slopes(key[1])]
            definition.slopes = tuple(found)
            unknown = [a for a, s in zip(definition.arguments, found, strict=True) if s is None]
            definition.contains = frozenset(i for a in unknown for i in a.generators())
