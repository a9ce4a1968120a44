"""Exact rational values of ring elements near an equilibrium, parameters drawn at random."""

from __future__ import annotations

import math
from fractions import Fraction
from random import Random
from typing import TYPE_CHECKING, Any

from engdyn.algebra.ring import Element
from engdyn.modeling.numbers import input_values, parameter_values

if TYPE_CHECKING:
    from engdyn.analysis.linear import LinearSystem

__all__ = ["ExactSample"]


class ExactSample:
    """Values of all generators: rational, consistent for sines and cosines.

    Parameters
    ----------
    linear : LinearSystem
    source : random.Random
        Where parameters that are not zero get their values from.
    """

    def __init__(self, linear: LinearSystem, source: Random):
        self._ring, self._source = linear.eom.ring, source
        self._plain = self._given(linear)
        self._values: dict[int, Fraction] = {}

    def _given(self, linear: LinearSystem) -> dict[tuple[Any, ...], Fraction]:
        """Coordinates, speeds, accelerations and inputs as they are; parameters random unless zero."""
        from engdyn.analysis.linear import motion_keys

        eom, at = linear.eom, linear.at
        given: dict[tuple[Any, ...], Fraction] = {}
        state = [*at.q, *at.speeds, *at.accelerations]
        for key, x in zip([k for keys in motion_keys(eom) for k in keys], state, strict=True):
            given[key] = Fraction(repr(float(x))) if abs(x) > 1e-12 else Fraction(0)
        for p, x in zip(eom.parameters, parameter_values(eom, at.values), strict=True):
            given["symbol", p] = self._random() if x else Fraction(0)
        order = [(w, k) for w in eom.inputs for k in (0, 1, 2)]
        for (w, k), x in zip(order, input_values(eom, at.inputs, at.values), strict=True):
            given["function", w, k] = self._random() if x else Fraction(0)
        return given

    def _random(self) -> Fraction:
        return Fraction(self._source.randint(1, 10**6), self._source.randint(1, 10**6))

    def value(self, element: Element) -> Fraction:
        """Exact value of an element."""
        above = self._polynomial(element.numerator)
        return above if element.denominator is None else above / self._polynomial(element.denominator)

    def _polynomial(self, p: Any) -> Fraction:
        total = Fraction(0)
        for exponents, coefficient in self._ring.polynomials.terms(p):
            for i, e in enumerate(exponents):
                if e:
                    coefficient *= self._generator(i) ** e
            total += coefficient
        return total

    def _generator(self, index: int) -> Fraction:
        if index not in self._values:
            key = self._ring.keys[index]
            if key[0] in ("sine", "cosine"):
                self._on_circle(key)
            else:  # roots and calls: any number will do, they are independent of the rest
                self._values[index] = self._plain.get(
                    key, self._random() if index in self._ring.definitions else Fraction(0)
                )
        return self._values[index]

    def _on_circle(self, key: tuple[Any, ...]) -> None:
        """Sine and cosine from the half-angle tangent: exactly on the unit circle."""
        ring = self._ring
        sine, cosine = ring.index["sine", *key[1:]], ring.index["cosine", *key[1:]]
        angle = float(self.value(ring.definitions[sine].arguments[0]))
        turned = math.remainder(angle, 2 * math.pi)
        if abs(abs(turned) - math.pi) < 1e-9:
            self._values[sine], self._values[cosine] = Fraction(0), Fraction(-1)
            return
        half = Fraction(math.tan(turned / 2)).limit_denominator(10**6) if abs(turned) > 1e-12 else Fraction(0)
        self._values[sine], self._values[cosine] = 2 * half / (1 + half**2), (1 - half**2) / (1 + half**2)
