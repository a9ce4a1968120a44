"""Linear algebra over a trigonometric ring: elimination without fractions."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from engdyn.algebra.element import Element, without_common_roots
from engdyn.algebra.ring import Ring

__all__ = [
    "Elimination",
    "determinant",
    "eliminate",
    "independent_columns",
    "is_singular",
    "primitive",
    "solve",
]

Row = list[Element]


@dataclass(frozen=True)
class Elimination:
    """What is left of a set of linear rows when the leading columns are eliminated.

    Attributes
    ----------
    pivots : list of (column, row)
        Triangular rows, in the order in which their columns were eliminated.
    remaining : list of (origin, row)
        Rows without the eliminated columns; `origin` is the number of the row they came from.
    missing : list of int
        Leading columns that could not be eliminated because no row contains them independently.
    """

    pivots: list[tuple[int, Row]]
    remaining: list[tuple[int, Row]]
    missing: list[int]


def eliminate(rows: Sequence[Row], columns: int) -> Elimination:
    """Eliminate the first `columns` columns from linear rows by fraction-free row operations.

    Pivots are taken where they cost least: numbers first, then short polynomials (the idea of
    Markowitz, *Management Science* 3, 1957, carried to polynomial entries).
    """
    active = [(origin, list(row)) for origin, row in enumerate(rows)]
    open_columns, pivots = set(range(columns)), []
    while open_columns:
        best = min(
            (
                (_cost(row[column]), position, column)
                for position, (_, row) in enumerate(active)
                for column in open_columns
                if not row[column].is_zero()
            ),
            default=None,
        )
        if best is None:
            break
        _, position, column = best
        _, pivot = active.pop(position)
        open_columns.discard(column)
        pivots.append((column, pivot))
        active = [(origin, _cleared(row, pivot, column)) for origin, row in active]
    return Elimination(pivots, active, sorted(open_columns))


def _cost(entry: Element) -> tuple[int, int]:
    constant = entry.as_rational() is not None
    return (0, 0) if constant else (1, len(entry.numerator))


def _cleared(row: Row, pivot: Row, column: int) -> Row:
    """`row` without `column`, a multiple of `pivot` subtracted."""
    head = row[column]
    if head.is_zero():
        return row
    value = pivot[column].as_rational()
    if value is not None:
        factor = head * (1 / value)
        return [a if b.is_zero() else a - factor * b for a, b in zip(row, pivot, strict=True)]
    return primitive([pivot[column] * a - head * b for a, b in zip(row, pivot, strict=True)])


def primitive(row: Row) -> Row:
    """A row divided by what all its entries have in common, denominators cleared."""
    ring = row[0].ring
    ps = ring.polynomials
    row = _without_denominators(row)
    common = ps.zero
    for entry in row:
        if not entry.is_zero():
            common = entry.numerator if ps.is_zero(common) else ps.gcd(common, entry.numerator)
            if ps.is_constant(common):
                break
    if ps.is_zero(common):
        return row
    numerators = [entry.numerator for entry in row]
    if not ps.is_constant(common):
        numerators = [ps.quotient(p, common) for p in numerators]
    occupied = [i for i, p in enumerate(numerators) if not ps.is_zero(p)]
    for i, p in zip(occupied, without_common_roots(ring, [numerators[i] for i in occupied]), strict=True):
        numerators[i] = p
    return [Element(ring, p) for p in numerators]


def _without_denominators(row: Row) -> Row:
    """A row multiplied by the least common multiple of its denominators."""
    ring, ps = row[0].ring, row[0].ring.polynomials
    denominators = [entry.denominator for entry in row if entry.denominator is not None]
    if not denominators:
        return row
    multiple = ps.one
    for below in denominators:
        multiple = multiple * ps.quotient(below, ps.gcd(multiple, below))
    factors = [multiple if e.denominator is None else ps.quotient(multiple, e.denominator) for e in row]
    return [Element(ring, e.numerator) * Element(ring, f) for e, f in zip(row, factors, strict=True)]


def solve(rows: Sequence[Row], unknowns: int) -> list[Element] | None:
    """Solve rows ``A x + b = 0`` given as ``[A | b]`` for x; None where A is singular.

    Parameters
    ----------
    rows : sequence of rows with ``unknowns + 1`` columns
    unknowns : int
    """
    done = eliminate(rows, unknowns)
    if done.missing:
        return None
    found: dict[int, Element] = {}
    for column, row in reversed(done.pivots):
        total = row[unknowns]
        for other, value in found.items():
            if not row[other].is_zero():
                total = total + row[other] * value
        found[column] = -total / row[column]
    return [found[i] for i in range(unknowns)]


def determinant(matrix: Sequence[Row]) -> Element:
    """Determinant by Laplace expansion along the emptiest row (matrices here are small)."""
    if len(matrix) == 1:
        return matrix[0][0]
    at = max(range(len(matrix)), key=lambda i: sum(a.is_zero() for a in matrix[i]))
    total = matrix[0][0].ring.zero
    for j, entry in enumerate(matrix[at]):
        if not entry.is_zero():
            minor = [[*row[:j], *row[j + 1 :]] for i, row in enumerate(matrix) if i != at]
            part = entry * determinant(minor)
            total = total + part if (at + j) % 2 == 0 else total - part
    return total


def is_singular(matrix: Sequence[Row]) -> bool:
    """Whether the determinant of a square matrix is zero identically."""
    return not _full_rank_somewhere(matrix) and determinant(matrix).is_zero()


def independent_columns(rows: Sequence[Row], columns: int) -> bool:
    """Whether the first `columns` columns are independent of each other."""
    if columns == 0:
        return True
    rows = [row[:columns] for row in rows]
    return _full_rank_somewhere(rows) or not eliminate(rows, columns).missing


def _full_rank_somewhere(matrix: Sequence[Row]) -> bool:
    """Whether the columns are independent at one rational point: then they are in the ring."""
    ring = matrix[0][0].ring
    used = {i for row in matrix for entry in row for i in entry.generators()}
    if any(i in ring.definitions and ring.definitions[i].kind not in ("sine", "cosine") for i in used):
        return False  # a root has no rational value
    point = _rational_point(ring)
    rows = [[_value(entry, point) for entry in row] for row in matrix]
    if any(entry is None for row in rows for entry in row):
        return False
    for column in range(len(rows[0])):
        at = next((at for at, row in enumerate(rows) if row[column]), None)
        if at is None:
            return False
        pivot = rows.pop(at)
        rows = [_without(row, pivot, column) for row in rows]
    return True


def _without(row: list[Any], pivot: list[Any], column: int) -> list[Any]:
    """A row of numbers less the multiple of `pivot` that clears a column."""
    if not row[column]:
        return row
    factor = row[column] / pivot[column]
    return [a - factor * b if b else a for a, b in zip(row, pivot, strict=True)]


def _rational_point(ring: Ring) -> list[Any]:
    """Values of all generators that respect sin² + cos² = 1: rational points of the circle."""
    rational = ring.polynomials.rational
    point = [rational(2 + 61 * i % 97) for i in range(len(ring.keys))]
    for i, key in enumerate(ring.keys):
        if key[0] == "sine":
            half = point[i]
            point[i] = 2 * half / (1 + half**2)
            point[ring.index["cosine", *key[1:]]] = (1 - half**2) / (1 + half**2)
    return point


def _value(element: Element, point: Sequence[Any]) -> Any | None:
    """Value of an element at a rational point, None where its denominator vanishes."""
    value = element.ring.polynomials.value
    if element.is_zero():
        return element.ring.polynomials.rational(0)
    above = value(element.numerator, point)
    if element.denominator is None:
        return above
    below = value(element.denominator, point)
    return above / below if below else None
