"""Which terms of which equation differ: what a student needs to know about a refuted derivation."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING

import sympy as sm

from engdyn.algebra.readable import to_sympy, tree
from engdyn.algebra.ring import Element, Ring

if TYPE_CHECKING:
    from engdyn.modeling.equations import EquationsOfMotion

__all__ = ["Difference", "differences"]

System = tuple[list[list[Element]], list[Element]]
Faults = dict[tuple[tuple[int, ...], str, Fraction | None], dict[tuple[int, ...], Fraction]]


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
    told: dict[int, list[Difference]] = {}
    taken: set[int] = set()
    for j, wanted in enumerate(second):
        same = next((i for i, row in enumerate(first) if i not in taken and row.equals(wanted)), None)
        if same is not None:
            taken.add(same)
            told[j] = []
    open_rows = [i for i in range(len(first)) if i not in taken]
    pairs = [
        (*_closest(first[i], second[j]), i, j) for i in open_rows for j in range(len(second)) if j not in told
    ]
    for *_, faults, common, i, j in sorted(pairs, key=lambda pair: pair[:2]):
        if i not in taken and j not in told:  # the rows that resemble each other most belong together
            taken.add(i)
            told[j] = _told(j + 1, faults, common)
    return tuple(difference for j in sorted(told) for difference in told[j])


def _residual(ring: Ring, mass: Sequence[Element], force: Element, keys: Sequence[tuple]) -> Element:
    total = -force
    for entry, key in zip(mass, keys, strict=True):
        if not entry.is_zero():
            total = total + entry * ring.generator(key)
    return total


def _closest(row: Element, wanted: Element) -> tuple[int, int, Faults, Element]:
    """The faults of a row, multiplied by the factor that leaves fewest; their number comes first."""
    best = None
    for scale in _scales(row, wanted):
        faults, common = _faults(row * scale, wanted)
        cost = len(faults), sum(map(len, faults.values()))
        if best is None or cost < best[:2]:
            best = (*cost, faults, common)
        if best[0] == 0:
            break
    return best


def _scales(row: Element, wanted: Element) -> Iterator[Element]:
    """Factors by which a row may have been divided: 1, and the ratios of corresponding terms.

    Terms correspond when they have the same speeds and accelerations: θ̈ with m l² θ̈.
    """
    tried = [row.ring.one]
    yield tried[0]
    own, other = _by_motion(row), _by_motion(wanted)
    for motion in own.keys() & other.keys():
        ratio = other[motion] / own[motion]
        if not any(ratio.equals(known) for known in tried):
            tried.append(ratio)
            yield ratio


def _by_motion(element: Element) -> dict[tuple[int, ...], Element]:
    """Coefficients of an element's products of rates, in the order in which they occur."""
    ring, parts = element.ring, {}
    for exponents, coefficient in ring.polynomials.terms(element.numerator):
        motion = _motion(ring, exponents)
        rest = tuple(e - m for e, m in zip(exponents, motion, strict=True))
        parts.setdefault(motion, {})[rest] = coefficient
    below = ring.one if element.denominator is None else Element(ring, element.denominator)
    return {
        motion: Element(ring, ring.polynomials.from_terms(terms)) / below for motion, terms in parts.items()
    }


def _motion(ring: Ring, exponents: tuple[int, ...]) -> tuple[int, ...]:
    """The exponents of time derivatives alone."""
    return tuple(
        e if key[0] == "function" and key[2] > 0 else 0 for e, key in zip(exponents, ring.keys, strict=True)
    )


def _faults(row: Element, wanted: Element) -> tuple[Faults, Element]:
    """Terms that differ, by rates and kind of fault, and the denominator that they all have."""
    ring = row.ring
    one = ring.polynomials.one
    below = [e.denominator if e.denominator is not None else one for e in (row, wanted)]
    numerators = [ring.reduce(row.numerator * below[1]), ring.reduce(wanted.numerator * below[0])]
    a, b = (dict(ring.polynomials.terms(p)) for p in numerators)
    groups: Faults = {}
    for exponents in a | b:
        given, expected = a.get(exponents, Fraction(0)), b.get(exponents, Fraction(0))
        if given != expected:
            kind, factor = _fault(given, expected)
            group = groups.setdefault((_motion(ring, exponents), kind, factor), {})
            group[exponents] = expected if kind != "extra" else given
    return groups, Element(ring, below[0] * below[1])


def _told(number: int, faults: Faults, common: Element) -> list[Difference]:
    ring, found = common.ring, []
    for (_, kind, factor), terms in sorted(faults.items(), key=lambda item: str(item[0])):
        term = Element(ring, ring.polynomials.from_terms(terms)) / common
        found.append(Difference(number, kind, to_sympy(tree(term)), factor))
    return found


def _fault(given: Fraction, expected: Fraction) -> tuple[str, Fraction | None]:
    if given == 0:
        return "missing", None
    if expected == 0:
        return "extra", None
    return ("sign", Fraction(-1)) if given == -expected else ("factor", given / expected)
