"""Which terms of which equation differ: what a student needs to know about a refuted derivation."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Any

import sympy as sm

from engdyn.algebra.readable import to_sympy, tree
from engdyn.algebra.ring import Element, Ring

if TYPE_CHECKING:
    from engdyn.modeling.equations import EquationsOfMotion

__all__ = ["Difference", "differences"]

System = tuple[list[list[Element]], list[Element]]


@dataclass(frozen=True)
class Difference:
    """One term by which an equation of the first set differs from that of the second.

    Attributes
    ----------
    equation : int
        Number of the equation, counted from 1.
    kind : {"missing", "extra", "sign", "factor"}
        "missing": the second set has the term, the first has not.
    term : sympy.Expr
        The term as it stands in the second set (for "extra": in the first), all terms on the left.
    factor : fractions.Fraction or None
        For "factor" and "sign": first set = factor × second set.
    """

    equation: int
    kind: str
    term: sm.Expr
    factor: Fraction | None = None

    def __str__(self) -> str:
        what = {
            "missing": f"the term {self.term} is missing",
            "extra": f"the term {self.term} should not be there",
            "sign": f"the term {self.term} has the wrong sign",
            "factor": f"the term {self.term} is multiplied by {self.factor}",
        }[self.kind]
        twice = (
            self.kind == "factor" and self.factor == 2 and any(s.name == "g" for s in self.term.free_symbols)
        )
        return f"equation {self.equation}: {what}{' (gravity counted twice?)' if twice else ''}"


def differences(eom: EquationsOfMotion, ring: Ring, a: System, b: System) -> tuple[Difference, ...]:
    """Terms that differ between M u̇ − f = 0 of two sets, after matching scaled and reordered rows."""
    keys = [("function", u.expr, 2) if u.is_Derivative else ("function", u, 1) for u in eom.speeds]
    first = [_residual(ring, mass, force, keys) for mass, force in zip(*a, strict=True)]
    second = [_residual(ring, mass, force, keys) for mass, force in zip(*b, strict=True)]
    found: list[Difference] = []
    for i, row in enumerate(_matched(first, second, keys, ring)):
        found += _row_differences(i + 1, row, second[i])
    return tuple(found)


def _residual(ring: Ring, mass: Sequence[Element], force: Element, keys: Sequence[tuple]) -> Element:
    total = -force
    for entry, key in zip(mass, keys, strict=True):
        if not entry.is_zero():
            total = total + entry * acceleration(ring, key)
    return total


def acceleration(ring: Ring, key: tuple) -> Element:
    """The generator of an acceleration (every ring of equations of motion has it)."""
    return ring.generator(key)


def _matched(first: list[Element], second: list[Element], keys: Sequence[tuple], ring: Ring) -> list[Element]:
    """Rows of the first set, reordered and scaled by a number so that they resemble the second's."""
    left, rows = list(first), []
    for wanted in second:
        best = max(left, key=lambda row: _resemblance(row, wanted))
        left.remove(best)
        rows.append(best * _scale(best, wanted))
    return rows


def _terms(element: Element) -> dict[tuple[int, ...], Fraction]:
    return dict(element.ring.polynomials.terms(element.numerator))


def _resemblance(row: Element, wanted: Element) -> int:
    return len(_terms(row).keys() & _terms(wanted).keys())


def _scale(row: Element, wanted: Element) -> Fraction:
    """The factor that makes most terms of a row agree with those of the other."""
    a, b = _terms(row), _terms(wanted)
    votes: dict[Fraction, int] = {}
    for exponents in a.keys() & b.keys():
        ratio = b[exponents] / a[exponents]
        votes[ratio] = votes.get(ratio, 0) + 1
    if votes.get(Fraction(1), 0) * 2 >= sum(votes.values()):
        return Fraction(1)
    return max(votes, key=lambda ratio: votes[ratio])


def _row_differences(number: int, row: Element, wanted: Element) -> list[Difference]:
    """Compare two residuals term by term; terms with the same fault and the same rates are taken together."""
    ring = row.ring
    one = ring.polynomials.one
    below = [e.denominator if e.denominator is not None else one for e in (row, wanted)]
    a = _terms(Element(ring, ring.reduce(row.numerator * below[1])))
    b = _terms(Element(ring, ring.reduce(wanted.numerator * below[0])))
    rates = {i for i, key in enumerate(ring.keys) if key[0] == "function" and key[2] > 0}
    groups: dict[tuple[Any, ...], dict] = {}
    for exponents in a.keys() | b.keys():
        given, expected = a.get(exponents, Fraction(0)), b.get(exponents, Fraction(0))
        if given == expected:
            continue
        kind, factor = _fault(given, expected)
        motion = tuple(e if i in rates else 0 for i, e in enumerate(exponents))
        groups.setdefault((motion, kind, factor), {})[exponents] = expected if kind != "extra" else given
    common = Element(ring, below[0] * below[1])
    found = []
    for (_, kind, factor), terms in sorted(groups.items(), key=lambda item: str(item[0])):
        term = Element(ring, ring.polynomials.from_terms(terms)) / common
        found.append(Difference(number, kind, to_sympy(tree(term)), factor))
    return found


def _fault(given: Fraction, expected: Fraction) -> tuple[str, Fraction | None]:
    if given == 0:
        return "missing", None
    if expected == 0:
        return "extra", None
    return ("sign", Fraction(-1)) if given == -expected else ("factor", given / expected)
