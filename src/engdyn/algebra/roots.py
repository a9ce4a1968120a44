"""Roots, magnitudes and calls: one generator for one function, however it was written.

Two roots of the same radicand, √(x²) and |x|, √(1 − cos²) and |sin| are the same function, so they must
be the same generator.  Rational square factors go in front of the generator: √(8 a) = 2 √(2 a).  Two
calls are the same when their arguments are proved equal.
"""

from __future__ import annotations

from fractions import Fraction
from math import gcd, isqrt, lcm

from engdyn.algebra.ring import Definition, Element, Ring

__all__ = ["define_call", "define_magnitude", "define_root", "squarefree_content"]


def define_root(ring: Ring, index: int, radicand: Element) -> Element:
    """√(n d) of a radicand n/d: a rational multiple of generator `index`, or of one known already."""
    whole, content = squarefree_content(radicand)
    known = _known_root(ring, whole)
    if known is not None:
        return known * content
    generator = Element(ring, ring.polynomials.gens[index])
    ring.define(index, Definition("root", (whole,), (generator / (whole * 2),)))
    return generator * content


def define_magnitude(ring: Ring, index: int, argument: Element) -> Element:
    """|x| with |x|² = x²: a rational multiple of generator `index`, or of one known already."""
    if argument.denominator is not None:  # |n/d| = |n d|/d²
        below = Element(ring, argument.denominator)
        return define_magnitude(ring, index, Element(ring, argument.numerator) * below) / (below * below)
    whole, content = squarefree_content(argument * argument)
    known = _known_root(ring, whole)
    if known is not None:
        return known * content
    argument, generator = argument * (1 / content), Element(ring, ring.polynomials.gens[index])
    ring.define(index, Definition("magnitude", (argument,), (generator / argument,)))
    return generator * content


def define_call(ring: Ring, index: int, definition: Definition) -> Element:
    """A function value: generator `index`, or the one whose arguments are equal."""
    function, arguments = ring.keys[index][1].func, definition.arguments
    for i, known in ring.definitions.items():
        if known.kind != "call" or not arguments or ring.keys[i][1].func != function:
            continue
        if all(a.equals(b) for a, b in zip(known.arguments, arguments, strict=True)):
            return Element(ring, ring.polynomials.gens[i])
    ring.define(index, definition)
    return Element(ring, ring.polynomials.gens[index])


def _known_root(ring: Ring, whole: Element) -> Element | None:
    """The root of a square-free radicand that is a rational number or a generator of the ring."""
    number = whole.as_rational()
    if number is not None and number in (0, 1):
        return ring.constant(number)
    for i, definition in ring.definitions.items():
        square = definition.square
        if square is not None and square.equals(whole):
            return Element(ring, ring.polynomials.gens[i])
    return None


def squarefree_content(radicand: Element) -> tuple[Element, Fraction]:
    """A radicand n/d as content² · whole with an integer, square-free leading content.

    √(n/d) is then content·√whole/|d|; here the product n·d stands in for n/d.
    """
    ring, ps = radicand.ring, radicand.ring.polynomials
    product = radicand.numerator if radicand.denominator is None else radicand.numerator * radicand.denominator
    product = ring.reduce(product)
    coefficients = [c for _, c in ps.terms(product)]
    if not coefficients:
        return ring.zero, Fraction(1)
    below = lcm(*(c.denominator for c in coefficients))
    content = Fraction(gcd(*(int(c * below) for c in coefficients)), below)
    outside = Fraction(_square_part(content.numerator * content.denominator), content.denominator)
    return Element(ring, product) * (1 / outside**2), outside


def _square_part(n: int) -> int:
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
