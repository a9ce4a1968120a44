"""Roots, magnitudes and calls: one generator for one function, however it was written.

Two roots of the same radicand, √(x²) and |x|, √(1 − cos²) and |sin| are the same function, so they must
be the same generator.  Square factors that are rational or made of positive symbols go in front of the
generator: √(8 l² a) = 2 l √(2 a).  Two calls are the same when their arguments are proved equal.
"""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from math import gcd, isqrt, lcm
from typing import Any

import sympy as sm

from engdyn.algebra.ring import Definition, Element, Ring

__all__ = ["define_call", "define_magnitude", "define_root", "square_content"]

#: f(−x) from f(x), for functions that sympy turns round: tanh(−x) becomes −tanh(x).
OF_THE_NEGATIVE: dict[Any, Callable[[Element], Element]] = {
    **dict.fromkeys((sm.atan, sm.asin, sm.sinh, sm.tanh, sm.asinh, sm.atanh), lambda value: -value),
    sm.cosh: lambda value: value,
    sm.exp: lambda value: 1 / value,
}


def define_root(ring: Ring, index: int, radicand: Element) -> Element:
    """√(n d) of a radicand n/d: a positive multiple of generator `index`, or of one known already."""
    below = radicand.denominator
    product = radicand.numerator if below is None else radicand.numerator * below
    whole, content = square_content(Element(ring, ring.reduce(product)))
    known = _known_root(ring, whole)
    if known is not None:
        return known * content
    generator = Element(ring, ring.polynomials.gens[index])
    ring.define(index, Definition("root", (whole,), (generator / (whole * 2),)))
    return generator * content


def define_magnitude(ring: Ring, index: int, argument: Element) -> Element:
    """|x| with |x|² = x²: a positive multiple of generator `index`, or of one known already."""
    if argument.denominator is not None:  # |n/d| = |n d|/d²
        below = Element(ring, argument.denominator)
        return define_magnitude(ring, index, Element(ring, argument.numerator) * below) / (below * below)
    whole, content = square_content(argument * argument)
    known = _known_root(ring, whole)
    if known is not None:
        return known * content
    inside, generator = argument / content, Element(ring, ring.polynomials.gens[index])
    if inside.denominator is not None:
        inside, content = argument, ring.one
    ring.define(index, Definition("magnitude", (inside,), (generator / inside,)))
    return generator * content


def define_call(ring: Ring, index: int, definition: Definition) -> Element:
    """A function value: generator `index`, or the one whose arguments are equal, or opposite."""
    function, arguments = ring.keys[index][1].func, definition.arguments
    for i, known in ring.definitions.items():
        if known.kind != "call" or not arguments or ring.keys[i][1].func != function:
            continue
        generator = Element(ring, ring.polynomials.gens[i])
        if all(a.equals(b) for a, b in zip(known.arguments, arguments, strict=True)):
            return generator
        if function in OF_THE_NEGATIVE and known.arguments[0].equals(-arguments[0]):
            return OF_THE_NEGATIVE[function](generator)
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


def square_content(product: Element) -> tuple[Element, Element]:
    """A polynomial as whole · content², content being a rational times positive symbols."""
    ring, ps = product.ring, product.ring.polynomials
    terms = ps.terms(product.numerator)
    if not terms:
        return ring.zero, ring.one
    below = lcm(*(c.denominator for _, c in terms))
    common = Fraction(gcd(*(int(c * below) for _, c in terms)), below)
    rational = Fraction(_square_part(common.numerator * common.denominator), common.denominator)
    half = tuple(
        (i, min(exponents[i] for exponents, _ in terms) // 2)
        for i, key in enumerate(ring.keys)
        if key[0] == "symbol" and key[1].is_positive
    )
    content = Element(ring, ps.from_sparse([(half, rational)]))
    return product / (content * content), content


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
