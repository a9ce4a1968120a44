"""Elements of a trigonometric ring: quotients of two polynomials in normal form."""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING, Any

from engdyn.errors import EngdynError, OutsideRingError

if TYPE_CHECKING:
    from engdyn.algebra.ring import Ring

__all__ = ["Element", "add_angles", "without_common_roots"]


class Element:
    """An element of a ring: numerator over denominator (None for 1), both polynomials.

    `bounded` is a bit mask: the generators with a relation that the numerator may contain.  Products
    of elements that have none of them in common are in normal form already.
    """

    __slots__ = ("_bounded", "_generators", "denominator", "node", "numerator", "ring")

    def __init__(self, ring: Ring, numerator: Any, denominator: Any = None, bounded: int | None = None):
        self.ring = ring
        self.numerator = numerator
        self.denominator = denominator
        self.node: Any = None  # the readable tree, once it has been asked for
        self._bounded = bounded
        self._generators: frozenset[int] | None = None

    @property
    def bounded(self) -> int:
        """Which generators with a relation the numerator may contain, as a bit mask."""
        if self._bounded is None:
            self._bounded = self.ring.bounded_among(self.generators())
        return self._bounded

    @staticmethod
    def quotient(ring: Ring, numerator: Any, denominator: Any) -> Element:
        """Normal form of a quotient: common factors cancelled, denominator monic."""
        ps = ring.polynomials
        numerator, denominator = _rationalized(ring, ring.reduce(numerator), ring.reduce(denominator))
        if ps.is_zero(denominator):
            raise EngdynError(
                "an expression is divided by something that is zero identically: check its denominators"
            )
        if ps.is_zero(numerator):
            return ring.zero
        if not ps.is_constant(denominator):
            common = ps.gcd(numerator, denominator)
            if not ps.is_constant(common):
                numerator, denominator = ps.quotient(numerator, common), ps.quotient(denominator, common)
        leading = ps.leading_coefficient(denominator)
        if leading != 1:
            scale = ps.constant(1 / leading)
            numerator, denominator = numerator * scale, denominator * scale
        return Element(ring, numerator, None if ps.is_constant(denominator) else denominator)

    def _coerce(self, other: Any) -> Element:
        return other if isinstance(other, Element) else self.ring.constant(other)

    def __add__(self, other: Any) -> Element:
        if not isinstance(other, Element):
            other = self.ring.constant(other)
        a, b = self.denominator, other.denominator
        if a is None and b is None:
            if not len(self.numerator):
                return other
            if not len(other.numerator):
                return self
            return Element(
                self.ring, self.numerator + other.numerator, None, _union(self._bounded, other._bounded)
            )
        if a is not None and b is not None and a == b:
            return Element.quotient(self.ring, self.numerator + other.numerator, a)
        one = self.ring.polynomials.one
        a, b = a if a is not None else one, b if b is not None else one
        return Element.quotient(self.ring, self.numerator * b + other.numerator * a, a * b)

    __radd__ = __add__

    def __neg__(self) -> Element:
        return Element(self.ring, -self.numerator, self.denominator, self._bounded)

    def __sub__(self, other: Any) -> Element:
        other = self._coerce(other)
        if self.denominator is None and other.denominator is None:
            if not len(other.numerator):
                return self
            return Element(
                self.ring, self.numerator - other.numerator, None, _union(self._bounded, other._bounded)
            )
        return self + (-other)

    def __rsub__(self, other: Any) -> Element:
        return self._coerce(other) + (-self)

    def __mul__(self, other: Any) -> Element:
        if not isinstance(other, Element):
            other = self.ring.constant(other)
        a, b = self.denominator, other.denominator
        terms = len(self.numerator) * len(other.numerator)
        if terms < 2:
            if not terms:
                return self.ring.zero
            if other is self.ring.one:
                return self
            if self is self.ring.one:
                return other
        if terms > self.ring.polynomials.largest_product:
            raise OutsideRingError(
                "an expression has too many terms to be expanded exactly: write it in shorter parts"
            )
        product = self.numerator * other.numerator
        if a is None and b is None:
            common = self.bounded & other.bounded
            if not common:
                return Element(self.ring, product, None, self._bounded | other._bounded)
            return Element(self.ring, self.ring.reduce(product, common))
        one = self.ring.polynomials.one
        return Element.quotient(
            self.ring, product, (a if a is not None else one) * (b if b is not None else one)
        )

    __rmul__ = __mul__

    def __truediv__(self, other: Any) -> Element:
        other = self._coerce(other)
        one = self.ring.polynomials.one
        a, b = self.denominator, other.denominator
        return Element.quotient(
            self.ring,
            self.numerator * (b if b is not None else one),
            other.numerator * (a if a is not None else one),
        )

    def __rtruediv__(self, other: Any) -> Element:
        return self._coerce(other) / self

    def __pow__(self, n: int) -> Element:
        if n < 0:
            return self.ring.one / self ** (-n)
        result, base = self.ring.one, self
        while n:
            if n & 1:
                result = result * base
            n >>= 1
            if n:
                base = base * base
        return result

    def is_zero(self) -> bool:
        """Whether the element is zero identically."""
        return self.ring.polynomials.is_zero(self.numerator)

    def equals(self, other: Element) -> bool:
        """Whether both elements (of one ring) are equal identically."""
        if self.denominator is None and other.denominator is None:
            return self.numerator == other.numerator
        return (self - other).is_zero()

    def as_rational(self) -> Fraction | None:
        """The value of a constant element, None for any other."""
        ps = self.ring.polynomials
        if self.denominator is not None or not ps.is_constant(self.numerator):
            return None
        return ps.leading_coefficient(self.numerator)

    def specialize(self, values: dict[int, Fraction]) -> Element:
        """The element with numbers in place of some independent generators (no angle may contain them)."""
        ps = self.ring.polynomials
        above = ps.specialize(self.numerator, values)
        if self.denominator is None:
            return Element(self.ring, above)
        return Element.quotient(self.ring, above, ps.specialize(self.denominator, values))

    def generators(self) -> frozenset[int]:
        """Indices of the generators that occur."""
        if self._generators is None:
            ps = self.ring.polynomials
            found = [i for i, d in enumerate(ps.degrees(self.numerator)) if d > 0]
            if self.denominator is not None:
                found += [i for i, d in enumerate(ps.degrees(self.denominator)) if d > 0]
            self._generators = frozenset(found)
        return self._generators


def _union(a: int | None, b: int | None) -> int | None:
    return None if a is None or b is None else a | b


def add_angles(a: tuple[Element, Element], b: tuple[Element, Element]) -> tuple[Element, Element]:
    """Cosine and sine of a sum of two angles, each given as (cosine, sine)."""
    return a[0] * b[0] - a[1] * b[1], a[1] * b[0] + a[0] * b[1]


def _rationalized(ring: Ring, numerator: Any, denominator: Any) -> tuple[Any, Any]:
    """n/(b g) as n g/(b g²) for every sine or root g that divides the denominator."""
    ps = ring.polynomials
    degrees = ps.degrees(denominator)
    for index, square in ring.squares.items():
        if degrees[index] == 1:
            rest, generator = ps.derivative(denominator, index), ps.gens[index]
            if denominator == rest * generator:
                numerator, denominator = ring.reduce(numerator * generator), ring.reduce(rest * square)
                degrees = ps.degrees(denominator)
    return numerator, denominator


def without_common_roots(ring: Ring, polynomials: list[Any]) -> list[Any]:
    """Polynomials divided by the sines and roots that all contain, if only as squares (1 − cos²).

    Common factors of polynomials are found by their greatest common divisor, these are not.
    """
    ps = ring.polynomials
    used = {i for p in polynomials for i, degree in enumerate(ps.degrees(p)) if degree > 0}
    for index in sorted(used & ring.squares.keys()):
        while not ps.is_constant(ring.squares[index]):
            divided = [_over_root(ring, p, index) for p in polynomials]
            if any(p is None for p in divided):
                break
            polynomials = divided
    return polynomials


def _over_root(ring: Ring, p: Any, index: int) -> Any | None:
    """p/g where it is a polynomial: from p = a g + b it is a + b g/g²."""
    ps, square = ring.polynomials, ring.squares[index]
    generator, a = ps.gens[index], ps.derivative(p, index)
    b = p - a * generator
    if ps.is_zero(b):
        return a
    return a + ps.quotient(b, square) * generator if ps.is_zero(ps.remainder(b, square)) else None
