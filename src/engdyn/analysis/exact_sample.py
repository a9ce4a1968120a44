"""Exact values of ring elements modulo a prime, with random numbers for what is not given.

What vanishes identically vanishes in every sample; what does not, vanishes in a random sample with a
probability of about its degree over the prime (J. T. Schwartz, J. ACM 27, 1980; R. Zippel, 1979).
"""

from __future__ import annotations

import math
from fractions import Fraction
from functools import cache
from random import Random
from typing import Any

import sympy as sm

from engdyn.algebra.ring import Element, Ring
from engdyn.analysis.slopes import Products
from engdyn.errors import EngdynError

__all__ = ["ExactSample", "NoRootError", "primes"]

AT_ZERO = {sm.atan: 0, sm.asin: 0, sm.sinh: 0, sm.tanh: 0, sm.exp: 1, sm.cosh: 1}
"""Values of functions at zero, where they are rational; elsewhere a call is independent of the rest."""


@cache
def primes(count: int) -> tuple[int, ...]:
    """Large primes of the form 4 k + 3, for which square roots are powers."""
    found, candidate = [2**61 - 1], 2**61 - 1
    while len(found) < count:
        candidate = sm.prevprime(candidate)
        if candidate % 4 == 3:
            found.append(candidate)
    return tuple(found)


class NoRootError(EngdynError):
    """A radicand is no square modulo the prime: draw another sample, modulo another prime."""

    def __init__(self) -> None:
        super().__init__("the sample has no square root: draw another one")


class ExactSample:
    """Values of all generators modulo a prime, consistent for sines, cosines and roots.

    Parameters
    ----------
    ring : Ring
    seed : int
        Of the random numbers.
    prime : int
        Of the form 4 k + 3.

    Attributes
    ----------
    given : dict of key to Fraction
        Values of independent generators; random where the sample comes to need others.
    """

    def __init__(self, ring: Ring, seed: int, prime: int):
        self.given: dict[tuple[Any, ...], Fraction] = {}
        self._ring, self._source, self._prime = ring, Random(seed), prime
        self._values: dict[int, int] = {}

    def random(self, largest: int = 10**6) -> Fraction:
        """A positive random number with numerator up to `largest`."""
        return Fraction(self._source.randint(1, largest), self._source.randint(1, 10**6))

    def _plain(self, key: tuple[Any, ...]) -> Fraction:
        """Value of an independent generator; pi is transcendental, so any number stands for it."""
        if key not in self.given:
            self.given[key] = self.random(10**6 if key[0] == "symbol" else 1000)
        return self.given[key]

    def _residue(self, value: Fraction) -> int:
        return value.numerator * pow(value.denominator, -1, self._prime) % self._prime

    def sum_of_products(self, products: Products) -> int:
        """Value of a sum of products modulo the prime."""
        return sum(math.prod(map(self.value, product)) for product in products) % self._prime

    def value(self, element: Element) -> int:
        """Value of an element modulo the prime."""
        above = self._polynomial(element.numerator)
        if element.denominator is None:
            return above
        below = self._polynomial(element.denominator)
        if below == 0:
            raise EngdynError(
                "a denominator vanishes there: the linearized equations do not exist at this state"
            )
        return above * pow(below, -1, self._prime) % self._prime

    def _polynomial(self, p: Any) -> int:
        total = 0
        for exponents, coefficient in self._ring.polynomials.terms(p):
            term = self._residue(coefficient)
            for i, e in enumerate(exponents):
                if e:
                    term = term * pow(self._generator(i), e, self._prime) % self._prime
            total += term
        return total % self._prime

    def _generator(self, index: int) -> int:
        if index not in self._values:
            definition = self._ring.definitions.get(index)
            key = self._ring.keys[index]
            if definition is None:
                self._values[index] = self._residue(self._plain(key))
            elif definition.kind in ("sine", "cosine"):
                self._on_circle(key)
            else:
                self._values[index] = self._dependent(key, definition)
        return self._values[index]

    def _dependent(self, key: tuple[Any, ...], definition: Any) -> int:
        """A root, a magnitude or a call."""
        inside = [self.value(a) for a in definition.arguments]
        if definition.kind == "root":
            root = pow(inside[0], (self._prime + 1) // 4, self._prime)
            if root * root % self._prime != inside[0]:
                raise NoRootError
            return root
        if definition.kind == "magnitude":
            return inside[0]
        if inside == [0] and key[1].func in AT_ZERO:
            return AT_ZERO[key[1].func]
        return self._source.randint(1, self._prime - 1)

    def _on_circle(self, key: tuple[Any, ...]) -> None:
        """Sine and cosine from the half-angle tangent: exactly on the unit circle."""
        ring = self._ring
        sine, cosine = ring.index["sine", *key[1:]], ring.index["cosine", *key[1:]]
        turned = math.remainder(self._angle(ring.definitions[sine].arguments[0]), 2 * math.pi)
        if abs(abs(turned) - math.pi) < 1e-9:
            self._values[sine], self._values[cosine] = 0, self._prime - 1
            return
        half = Fraction(math.tan(turned / 2)).limit_denominator(10**6) if abs(turned) > 1e-12 else Fraction(0)
        self._values[sine] = self._residue(2 * half / (1 + half**2))
        self._values[cosine] = self._residue((1 - half**2) / (1 + half**2))

    def _angle(self, element: Element) -> float:
        """An angle in radians: a linear combination of coordinates and the like."""
        total = 0.0
        for exponents, coefficient in self._ring.polynomials.terms(element.numerator):
            factors = (float(self._plain(self._ring.keys[i])) ** e for i, e in enumerate(exponents) if e)
            total += float(coefficient) * math.prod(factors)
        return total
