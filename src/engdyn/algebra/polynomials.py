"""Sparse polynomials over the rationals, in C where python-flint is installed.

Two backends stand behind one small interface: python-flint's ``fmpq_mpoly`` and, where it has no
wheel, the ``sympy.polys`` rings.  Nothing else in engdyn knows which of them is at work.  The
environment variable ``ENGDYN_BACKEND`` (``flint`` or ``sympy``) forces one of them.

Polynomials of both backends add, subtract, multiply and compare with ``+ - * ** ==``; everything
that differs between them is a method of :class:`FlintPolynomials` or :class:`SympyPolynomials`.
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Sequence
from fractions import Fraction
from functools import lru_cache
from typing import Any

__all__ = ["FlintPolynomials", "SympyPolynomials", "backend_name", "polynomials"]

Polynomial = Any
Exponents = tuple[int, ...]
Sparse = tuple[tuple[int, int], ...]


def backend_name() -> str:
    """Name of the backend in force: ``"flint"`` or ``"sympy"``."""
    wanted = os.environ.get("ENGDYN_BACKEND", "").lower()
    if wanted in ("flint", "sympy"):
        return wanted
    try:
        import flint  # noqa: F401
    except ImportError:
        return "sympy"
    return "flint"


def _dense(terms: Iterable[tuple[Sparse, int | Fraction]], count: int) -> dict[Exponents, int | Fraction]:
    """Terms with the exponents of all generators."""
    found = {}
    for pairs, coefficient in terms:
        exponents = [0] * count
        for i, e in pairs:
            exponents[i] = e
        found[tuple(exponents)] = coefficient
    return found


def polynomials(count: int) -> FlintPolynomials | SympyPolynomials:
    """Polynomials in `count` generators, ordered lexicographically (the first leads)."""
    return _of_size(backend_name(), max(count, 1))


@lru_cache(maxsize=64)
def _of_size(backend: str, count: int) -> FlintPolynomials | SympyPolynomials:
    """One set of polynomials for all rings of one size."""
    return FlintPolynomials(count) if backend == "flint" else SympyPolynomials(count)


class FlintPolynomials:
    """Polynomials in `count` generators on python-flint."""

    #: Products that could have more terms than this are refused: they would take minutes.
    largest_product = 300_000

    def __init__(self, count: int):
        import flint

        self._flint = flint
        self._context = flint.fmpq_mpoly_ctx.get(("g", count), flint.Ordering.lex)
        self.gens: tuple[Polynomial, ...] = tuple(self._context.gens())
        self.rational = flint.fmpq  #: numbers of the backend, faster than Fractions
        self.zero = self._context.constant(0)
        self.one = self._context.constant(1)

    def constant(self, value: Fraction | int) -> Polynomial:
        """The constant polynomial `value`."""
        return self._context.constant(self.rational(value.numerator, value.denominator))

    def from_terms(self, terms: dict[Exponents, Fraction]) -> Polynomial:
        """The sum of the given terms: exponents of all generators → coefficient."""
        fmpq = self._flint.fmpq
        return self._context.from_dict({e: fmpq(c.numerator, c.denominator) for e, c in terms.items()})

    def terms(self, p: Polynomial) -> list[tuple[Exponents, Fraction]]:
        """Exponents and coefficient of every term."""
        return [
            (tuple(map(int, e)), Fraction(int(c.p), int(c.q)))
            for e, c in zip(p.monoms(), p.coeffs(), strict=True)
        ]

    def sparse(self, p: Polynomial) -> list[tuple[Sparse, int | Fraction]]:
        """Every term as (index, exponent) pairs of the generators in it and its coefficient."""
        return [
            (
                tuple([(i, int(e)) for i, e in enumerate(exponents) if e]),
                int(c.p) if c.q == 1 else Fraction(int(c.p), int(c.q)),
            )
            for exponents, c in zip(p.monoms(), p.coeffs(), strict=True)
        ]

    def from_sparse(self, terms: Iterable[tuple[Sparse, int | Fraction]]) -> Polynomial:
        """The sum of terms that are given as (index, exponent) pairs and coefficient."""
        return self.from_terms(_dense(terms, len(self.gens)))

    def is_zero(self, p: Polynomial) -> bool:
        """Whether `p` is the zero polynomial."""
        return p.is_zero()

    def is_constant(self, p: Polynomial) -> bool:
        """Whether `p` contains no generator."""
        return p.is_constant()

    def degrees(self, p: Polynomial) -> Exponents:
        """Degree of `p` in every generator."""
        return p.degrees()

    def derivative(self, p: Polynomial, generator: int) -> Polynomial:
        """Partial derivative with respect to the generator of that index."""
        return p.derivative(generator)

    def remainder(self, p: Polynomial, divisor: Polynomial) -> Polynomial:
        """Remainder of the division of `p` by `divisor` in the lexicographic order."""
        return divmod(p, divisor)[1]

    def gcd(self, a: Polynomial, b: Polynomial) -> Polynomial:
        """Greatest common divisor, monic."""
        return a.gcd(b)

    def quotient(self, p: Polynomial, divisor: Polynomial) -> Polynomial:
        """Exact quotient (the caller knows that the division leaves no remainder)."""
        return divmod(p, divisor)[0]

    def factor(self, p: Polynomial) -> tuple[Fraction, list[tuple[Polynomial, int]]]:
        """Rational content and the irreducible factors with their multiplicities."""
        content, factors = p.factor()
        return Fraction(int(content.p), int(content.q)), [(f, int(m)) for f, m in factors]

    def leading_coefficient(self, p: Polynomial) -> Fraction:
        """Coefficient of the leading term (0 for the zero polynomial)."""
        if p.is_zero():
            return Fraction(0)
        c = p.leading_coefficient()
        return Fraction(int(c.p), int(c.q))

    def specialize(self, p: Polynomial, values: dict[int, Fraction]) -> Polynomial:
        """`p` with numbers in place of some generators."""
        images = [self.constant(values[i]) if i in values else g for i, g in enumerate(self.gens)]
        return p.compose(*images, ctx=self._context)

    def value(self, p: Polynomial, point: Sequence[Any]) -> Any:
        """The value of `p` where the generators have the given values, all of them ``rational``."""
        return p(*point)

    def transfer(self, p: Polynomial, target: FlintPolynomials, mapping: list[int]) -> Polynomial:
        """`p` written in the generators of `target`; generator i becomes generator ``mapping[i]``."""
        # compose, not project_to_context: that one ignores the mapping between rings of equal size
        return p.compose(*(target.gens[i] for i in mapping), ctx=target._context)


class SympyPolynomials:
    """Polynomials in `count` generators on the rings of ``sympy.polys``: pure Python, slower."""

    largest_product = 30_000

    def __init__(self, count: int):
        from sympy import QQ, lex
        from sympy.polys.rings import ring

        self._qq = self.rational = QQ  #: numbers of the backend
        self._ring, *gens = ring([f"g{i}" for i in range(count)], QQ, lex)
        self.gens: tuple[Polynomial, ...] = tuple(gens)
        self.zero = self._ring.zero
        self.one = self._ring.one

    def _rational(self, value: Fraction | int) -> Any:
        value = Fraction(value)
        return self._qq(value.numerator, value.denominator)

    def constant(self, value: Fraction | int) -> Polynomial:
        """The constant polynomial `value`."""
        return self._ring.ground_new(self._rational(value))

    def from_terms(self, terms: dict[Exponents, Fraction]) -> Polynomial:
        """The sum of the given terms: exponents of all generators → coefficient."""
        return self._ring.from_dict({e: self._rational(c) for e, c in terms.items()})

    def terms(self, p: Polynomial) -> list[tuple[Exponents, Fraction]]:
        """Exponents and coefficient of every term."""
        return [(tuple(e), Fraction(int(c.numerator), int(c.denominator))) for e, c in p.terms()]

    def sparse(self, p: Polynomial) -> list[tuple[Sparse, int | Fraction]]:
        """Every term as (index, exponent) pairs of the generators in it and its coefficient."""
        return [
            (
                tuple([(i, e) for i, e in enumerate(exponents) if e]),
                int(c.numerator) if c.denominator == 1 else Fraction(int(c.numerator), int(c.denominator)),
            )
            for exponents, c in p.terms()
        ]

    def from_sparse(self, terms: Iterable[tuple[Sparse, int | Fraction]]) -> Polynomial:
        """The sum of terms that are given as (index, exponent) pairs and coefficient."""
        return self.from_terms(_dense(terms, len(self.gens)))

    def is_zero(self, p: Polynomial) -> bool:
        """Whether `p` is the zero polynomial."""
        return not p

    def is_constant(self, p: Polynomial) -> bool:
        """Whether `p` contains no generator."""
        return p.is_ground

    def degrees(self, p: Polynomial) -> Exponents:
        """Degree of `p` in every generator."""
        return tuple(max(0, int(d)) if p else -1 for d in p.degrees()) if p else (-1,) * len(self.gens)

    def derivative(self, p: Polynomial, generator: int) -> Polynomial:
        """Partial derivative with respect to the generator of that index."""
        return p.diff(generator)

    def remainder(self, p: Polynomial, divisor: Polynomial) -> Polynomial:
        """Remainder of the division of `p` by `divisor` in the lexicographic order."""
        return p.rem(divisor)

    def gcd(self, a: Polynomial, b: Polynomial) -> Polynomial:
        """Greatest common divisor, monic."""
        return a.gcd(b).monic()

    def quotient(self, p: Polynomial, divisor: Polynomial) -> Polynomial:
        """Exact quotient (the caller knows that the division leaves no remainder)."""
        return p.div(divisor)[0]

    def factor(self, p: Polynomial) -> tuple[Fraction, list[tuple[Polynomial, int]]]:
        """Rational content and the irreducible factors with their multiplicities."""
        content, factors = p.factor_list()
        return Fraction(int(content.numerator), int(content.denominator)), [(f, int(m)) for f, m in factors]

    def leading_coefficient(self, p: Polynomial) -> Fraction:
        """Coefficient of the leading term (0 for the zero polynomial)."""
        c = p.LC
        return Fraction(int(c.numerator), int(c.denominator))

    def specialize(self, p: Polynomial, values: dict[int, Fraction]) -> Polynomial:
        """`p` with numbers in place of some generators."""
        return p.compose([(self.gens[i], self.constant(value)) for i, value in values.items()])

    def value(self, p: Polynomial, point: Sequence[Any]) -> Any:
        """The value of `p` where the generators have the given values, all of them ``rational``."""
        total = self._qq(0)
        for exponents, coefficient in p.terms():
            for e, x in zip(exponents, point, strict=True):
                if e:
                    coefficient = coefficient * x**e
            total = total + coefficient
        return total

    def transfer(self, p: Polynomial, target: SympyPolynomials, mapping: list[int]) -> Polynomial:
        """`p` written in the generators of `target`; generator i becomes generator ``mapping[i]``."""
        width = len(target.gens)
        terms = {}
        for exponents, coefficient in p.terms():
            moved = [0] * width
            for i, e in enumerate(exponents):
                if e:
                    moved[mapping[i]] += e
            terms[tuple(moved)] = terms.get(tuple(moved), 0) + coefficient
        return target._ring.from_dict(terms)
