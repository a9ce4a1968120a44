"""Second pass: sympy expressions become elements of a trigonometric ring.

Angles may be any rational combination of base angles: their sines and cosines are expanded by
angle addition, so that ``cos(a - b)`` and ``cos(a)*cos(b) + sin(a)*sin(b)`` are one element.
Floats enter as the rational of their shortest decimal (0.1 is 1/10).
"""

from __future__ import annotations

from collections.abc import Iterable
from fractions import Fraction
from math import gcd, isqrt, lcm

import sympy as sm

from engdyn.algebra.ring import Definition, Element, Ring, add_angles
from engdyn.algebra.scan import (
    RECIPROCAL,
    Key,
    Scan,
    angle_terms,
    as_fraction,
    derivative_key,
    half_power,
    independent_atoms,
    is_opaque,
    slopes,
)
from engdyn.errors import EngdynError

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
    """

    def __init__(
        self,
        expressions: Iterable[sm.Expr],
        extra: Iterable[Key] = (),
        substitutions: dict[Key, sm.Expr] | None = None,
    ):
        self._substitutions = substitutions or {}
        scan = Scan(self._substitutions)
        for key in extra:
            scan.plain.setdefault(key)
        scan.read(sm.sympify(e) if not isinstance(e, sm.Basic) else e for e in expressions)
        self.ring = Ring(scan.keys())
        self._divisors = scan.divisors
        self._known: dict[sm.Basic, Element] = {}
        self._dependent: dict[Key, Element] = {}
        for base, divisor in scan.divisors.items():
            self._define_angle(base, divisor)
        for key in scan.dependent:
            self._define(key)
        self._fill_slopes(scan.dependent)

    def convert(self, expr: sm.Expr) -> Element:
        """The ring element of an expression whose generators the ring has."""
        found = self._known.get(expr)
        if found is None:
            found = self._known[expr] = self._translate(expr)
        return found

    def _translate(self, expr: sm.Basic) -> Element:
        if not isinstance(expr, sm.Basic):
            return self.convert(sm.sympify(expr))
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
            return {sm.tan: lambda: s / c, sm.cot: lambda: c / s, sm.sec: lambda: 1 / c, sm.csc: lambda: 1 / s}[
                type(expr)
            ]()
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
            if base in self._divisors:
                divisor = self._divisors[base]
                part = self.ring.multiple_angle(base, divisor, int(factor * divisor))
            else:
                phase = sm.Rational(factor.numerator, factor.denominator) * base
                part = self.convert(sm.cos(phase)), self.convert(sm.sin(phase))
            pair = add_angles(pair, part)
        return pair

    def _define_angle(self, base: sm.Expr, divisor: int) -> None:
        ring = self.ring
        angle = self.convert(base) * Fraction(1, divisor)
        cosine, sine = ring.generator(("cosine", base, divisor)), ring.generator(("sine", base, divisor))
        ring.define(ring.index["sine", base, divisor], Definition("sine", (angle,), (cosine,)))
        ring.define(ring.index["cosine", base, divisor], Definition("cosine", (angle,), (-sine,)))

    def _define(self, key: Key) -> None:
        if key[0] == "root":
            self._define_root(key)
        elif key[0] == "magnitude":
            self._define_magnitude(key)
        else:
            self._define_call(key)

    def _define_root(self, key: Key) -> None:
        """√radicand with r² = radicand: the same radicand gives the same generator."""
        ring, radicand = self.ring, self.convert(key[1])
        whole, content = squarefree_content(radicand)
        same = next((k for k, d in ring.definitions.items() if d.kind == "root" and d.arguments[0].equals(whole)), None)
        index = ring.index[key] if same is None else same
        generator = Element(ring, ring.polynomials.gens[index])
        if same is None:
            slope = generator / (whole * 2)
            ring.define(index, Definition("root", (whole,), (slope,)))
        self._dependent[key] = generator * content

    def _root(self, base: sm.Expr) -> Element:
        radicand = self.convert(base)
        root = self._dependent["root", base]
        if radicand.denominator is None:
            return root
        return root / self._magnitude_of_denominator(radicand, base)

    def _magnitude_of_denominator(self, radicand: Element, base: sm.Expr) -> Element:
        """|d| of a radicand n/d: d itself where it is made of positive symbols only."""
        below = Element(self.ring, radicand.denominator)
        positive = all(
            key[0] == "symbol" and (key[1].is_positive or key[1] is sm.S.Pi)
            for key in (self.ring.keys[i] for i in below.generators())
        ) and all(c > 0 for _, c in self.ring.polynomials.terms(below.numerator))
        if positive:
            return below
        return self._define_magnitude_at(self.ring.index["magnitude", sm.denom(sm.together(base))], below)

    def _define_magnitude(self, key: Key) -> None:
        """|x| with a² = x²; |x| and |−x| are one generator."""
        argument, index = self.convert(key[1]), self.ring.index[key]
        self._dependent[key] = self._define_magnitude_at(index, argument)

    def _define_magnitude_at(self, index: int, argument: Element) -> Element:
        ring = self.ring
        if argument.as_rational() is not None:
            return ring.constant(abs(argument.as_rational()))
        if argument.denominator is not None:
            raise EngdynError("the magnitude of a quotient is not supported: write |a|/|b| instead of |a/b|")
        for i, definition in ring.definitions.items():
            known = definition.arguments[0] if definition.kind == "magnitude" else None
            if known is not None and (known.equals(argument) or known.equals(-argument)):
                return Element(ring, ring.polynomials.gens[i])
        generator = Element(ring, ring.polynomials.gens[index])
        ring.define(index, Definition("magnitude", (argument,), (generator / argument,)))
        return generator

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
        for i, definition in ring.definitions.items():
            if definition.kind == "call" and arguments and ring.keys[i][1].func is expr.func:
                if all(a.equals(b) for a, b in zip(definition.arguments, arguments, strict=True)):
                    self._dependent[key] = Element(ring, ring.polynomials.gens[i])
                    return
        ring.define(index, Definition("call", arguments, (), contains))
        self._dependent[key] = Element(ring, ring.polynomials.gens[index])

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


def squarefree_content(radicand: Element) -> tuple[Element, Fraction]:
    """A radicand n/d as content² · whole with an integer, square-free leading content.

    √(n/d) is then content·√whole/|d|; here the product n·d stands in for n/d.
    """
    ring, ps = radicand.ring, radicand.ring.polynomials
    product = radicand if radicand.denominator is None else Element(ring, radicand.numerator * radicand.denominator)
    product = Element(ring, ring.reduce(product.numerator))
    coefficients = [c for _, c in ps.terms(product.numerator)]
    if not coefficients:
        return product, Fraction(0)
    below = lcm(*(c.denominator for c in coefficients))
    content = Fraction(gcd(*(int(c * below) for c in coefficients)), below)
    outside = Fraction(square_part(content.numerator * content.denominator), content.denominator)
    return product * (1 / outside**2), outside


def square_part(n: int) -> int:
    """The largest integer whose square divides n, searched up to a small bound."""
    root = isqrt(n)
    if root * root == n:
        return root
    part = 1
    for p in range(2, 1000):
        while n % (p * p) == 0:
            n //= p * p
            part *= p
    return part
