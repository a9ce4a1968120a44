"""Directions in which all coordinates can be shifted together without any equation noticing.

The common rotation of a drive train is one, the travel of a train of cars another: no coordinate is
ignorable by itself, the combination is.  Course section 4.4.
"""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from fractions import Fraction
from typing import Any

from engdyn.algebra.ring import Element, Ring
from engdyn.analysis.exact_sample import ExactSample, primes
from engdyn.analysis.residues import Matrix, rank
from engdyn.analysis.slopes import slopes
from engdyn.errors import EngdynError

__all__ = ["Ties", "imply_rates", "neutral_directions", "ties"]

ATTEMPTS = 4
"""Random points at which slopes are looked at before they are expanded."""

Vector = list[Fraction]
Ties = Sequence[tuple[int, Vector]]
"""What moves together: the coordinate that leads (the first), and the share of every coordinate."""


def ties(
    ring: Ring, rows: Sequence[Element], keys: Sequence[tuple[Any, ...]], here: Sequence[int]
) -> list[tuple[int, Vector]]:
    """Neutral directions of the coordinates that occur in the rows.

    Parameters
    ----------
    ring, rows, keys :
        As in :func:`neutral_directions`.
    here : sequence of int
        Places of the coordinates that occur.
    """
    found = []
    for short in neutral_directions(ring, rows, [keys[j] for j in here]):
        direction = [Fraction(0)] * len(keys)
        for j, share in zip(here, short, strict=True):
            direction[j] = share
        found.append((next(j for j in here if direction[j]), direction))
    return found


def imply_rates(direction: Vector, names: Sequence[str], *prescribed: dict[str, Fraction]) -> bool:
    """Let a prescribed rate or acceleration of one coordinate prescribe those of all that go along with it.

    Returns
    -------
    bool
        Whether there is one.
    """
    shares = {name: share for name, share in zip(names, direction, strict=True) if share}
    leaders = [next((name for name in shares if name in given), None) for given in prescribed]
    for given, leader in zip(prescribed, leaders, strict=True):
        if leader is not None:
            for name, share in shares.items():
                given.setdefault(name, given[leader] * share / shares[leader])
    return any(leader is not None for leader in leaders)


def neutral_directions(ring: Ring, rows: Sequence[Element], keys: Sequence[tuple[Any, ...]]) -> list[Vector]:
    """All constant directions d with Σ dⱼ ∂row/∂qⱼ = 0 identically, for every row.

    Parameters
    ----------
    ring : Ring
    rows : sequence of Element
        With numbers for all parameters.
    keys : sequence of tuple, length n
        Generators of the coordinates.

    Returns
    -------
    list of lists of Fraction, each of length n
        In echelon form: the first entry that is not zero is 1, and the other directions have 0 there.
    """
    if _all_noticed(ring, rows, keys):
        return []
    partials = [ring.partial(key) for key in keys]
    pivots: list[tuple[int, Vector]] = []
    for row in rows:
        slopes = _common_denominator([partial(row) for partial in partials])
        terms: dict[tuple[int, ...], Vector] = {}
        for j, slope in enumerate(slopes):
            for exponents, coefficient in ring.polynomials.terms(slope.numerator):
                terms.setdefault(exponents, [Fraction(0)] * len(keys))[j] = coefficient
        for condition in terms.values():
            _add_condition(pivots, condition)
            if len(pivots) == len(keys):
                return []
    return _null_space(pivots, len(keys))


def _all_noticed(ring: Ring, rows: Sequence[Element], keys: Sequence[tuple[Any, ...]]) -> bool:
    """Whether slopes at random points, modulo a prime, rule out every direction.

    A direction that no equation notices is orthogonal to the slopes at all points; so what rules it out
    at a few is proved. Derivatives with denominators of thousands of terms need not be expanded for it.
    """
    moved = [slopes(ring, row, keys) for row in rows]
    seen: Matrix = []
    for attempt in range(1, ATTEMPTS + 1):
        prime = primes(1)[0]
        sample = ExactSample(ring, attempt, prime)
        with suppress(EngdynError):  # no square root of a radicand, a denominator of zero: the next one
            seen += [[sample.sum_of_products(products) for products in row] for row in moved]
        if rank(seen, prime) == len(keys):
            return True
    return False


def _common_denominator(elements: Sequence[Element]) -> list[Element]:
    """Elements times all their denominators."""
    found = list(elements)
    for element in elements:
        if element.denominator is not None:
            below = Element(element.ring, element.denominator)
            found = [other * below for other in found]
    return found if all(e.denominator is None for e in found) else _common_denominator(found)


def _add_condition(pivots: list[tuple[int, Vector]], condition: Vector) -> None:
    """Reduce a linear condition by those known (Gauss–Jordan from the right), keep what is new."""
    for column, known in pivots:
        factor = condition[column]
        if factor:
            condition = [a - factor * b for a, b in zip(condition, known, strict=True)]
    column = next((j for j in reversed(range(len(condition))) if condition[j]), None)
    if column is None:
        return
    new = [a / condition[column] for a in condition]
    for i, (other, known) in enumerate(pivots):
        factor = known[column]
        if factor:
            pivots[i] = (other, [a - factor * b for a, b in zip(known, new, strict=True)])
    pivots.append((column, new))


def _null_space(pivots: Sequence[tuple[int, Vector]], n: int) -> list[Vector]:
    """Directions that satisfy all conditions: one per column without pivot."""
    solved = dict(pivots)
    found = []
    for free in range(n):
        if free not in solved:
            direction = [Fraction(int(j == free)) for j in range(n)]
            for column, row in solved.items():
                direction[column] = -row[free]
            found.append(direction)
    return found
