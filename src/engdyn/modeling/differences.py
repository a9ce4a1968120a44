"""Which terms of which equation differ: what a student needs to know about a refuted derivation."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import TYPE_CHECKING

import sympy as sm
from sympy.physics.vector.printing import vsstrrepr

from engdyn.algebra.readable import to_sympy, tree
from engdyn.algebra.ring import Element, Ring
from engdyn.modeling.diagnosis import remark
from engdyn.modeling.faults import Fault, faults, merged, motion_of
from engdyn.modeling.mistakes import Finding, Rows

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
        Number of the equation in the second set, counted from 1.
    kind : {"missing", "extra", "sign", "factor", "changed"}
        "missing": the second set has the term, the first has not.  "changed": the first set has another
        term in its place.
    term : sympy.Expr
        The term as it stands in the second set (for "extra": in the first), all terms on the left.
    factor : fractions.Fraction, sympy.Expr or None
        For "factor" and "sign": first set = factor × second set; an expression where π is in it.
    instead : sympy.Expr or None
        For "changed": what stands in the first set.
    coordinate : str
        The coordinate whose equation it is, "" where the equations do not belong to one each.
    remark : str
        What mistake this looks like, in plain words; "" where nothing certain can be said.
    """

    equation: int
    kind: str
    term: sm.Expr
    factor: Fraction | sm.Expr | None = None
    instead: sm.Expr | None = None
    coordinate: str = ""
    remark: str = ""

    @property
    def given(self) -> sm.Expr:
        """What stands in the first set: zero for a missing term."""
        if self.kind in ("missing", "changed"):
            return sm.S.Zero if self.instead is None else self.instead
        factor = sm.S.One if self.factor is None else self.factor
        return (
            sm.Rational(*factor.as_integer_ratio()) if isinstance(factor, Fraction) else factor
        ) * self.term

    @property
    def expected(self) -> sm.Expr:
        """What stands in the second set: zero for an extra term."""
        return sm.S.Zero if self.kind == "extra" else self.term

    @property
    def where(self) -> str:
        """The equation by number and coordinate: "equation 2 (theta)"."""
        return f"equation {self.equation}" + (f" ({self.coordinate})" if self.coordinate else "")

    @property
    def in_short(self) -> str:
        """What is wrong with the term, in three words."""
        return {
            "missing": "missing",
            "extra": "does not belong there",
            "sign": "sign reversed",
            "factor": f"multiplied by {self.factor}",
            "changed": "another term",
        }[self.kind]

    def __str__(self) -> str:
        term = vsstrrepr(self.term)
        what = {
            "missing": f"the term {term} is missing",
            "extra": f"the term {term} should not be there",
            "sign": f"the term {term} has the wrong sign",
            "factor": f"the term {term} is multiplied by {self.factor}",
            "changed": f"the term {vsstrrepr(self.given)} should read {term}",
        }[self.kind]
        return f"{self.where}: {what}" + (f" – {self.remark}" if self.remark else "")


def differences(eom: EquationsOfMotion, ring: Ring, a: System, b: System) -> tuple[Difference, ...]:
    """Terms that differ between M u̇ − f = 0 of two sets, after matching scaled and reordered rows."""
    keys = [("function", u.expr, 2) if u.is_Derivative else ("function", u, 1) for u in eom.speeds]
    keys = [_key_of(ring, key) for key in keys]
    first = [_residual(ring, mass, force, keys) for mass, force in zip(*a, strict=True)]
    second = [_residual(ring, mass, force, keys) for mass, force in zip(*b, strict=True)]
    matched = _matched(first, second)
    owners = _owners(b[0], keys)
    rows = Rows(ring, [row for row, _ in matched], second, owners, keys)
    found: list[Difference] = []
    for j, (_, wrong) in enumerate(matched):
        name = owners[j][1].func.__name__ if owners[j] else ""
        found += [_told(rows, j, fault, name) for fault in merged(wrong, finest=True)]
    return tuple(found)


def _key_of(ring: Ring, wanted: tuple) -> tuple:
    """The same key as the common ring has it: symbols of one name are one symbol there."""
    if wanted in ring.index:
        return wanted
    name = wanted[1].func.__name__
    return next(
        k for k in ring.keys if k[0] == "function" and k[2] == wanted[2] and k[1].func.__name__ == name
    )


def _residual(ring: Ring, mass: Sequence[Element], force: Element, keys: Sequence[tuple]) -> Element:
    total = -force
    for entry, key in zip(mass, keys, strict=True):
        if not entry.is_zero():
            total = total + entry * ring.generator(key)
    return total


def _owners(mass: Sequence[Sequence[Element]], keys: Sequence[tuple]) -> list[tuple | None]:
    """The acceleration that each row belongs to: known where the mass matrix is symmetric, as projection makes it."""
    n = len(mass)
    symmetric = all(mass[i][j].equals(mass[j][i]) for i in range(n) for j in range(i))
    return list(keys) if symmetric and all(not mass[i][i].is_zero() for i in range(n)) else [None] * n


def _matched(first: list[Element], second: list[Element]) -> list[tuple[Element, list[Fault]]]:
    """For every row of the second set the row of the first that belongs to it, scaled, and its faults."""
    found: dict[int, tuple[Element, list[Fault]]] = {}
    taken: set[int] = set()
    for j, wanted in enumerate(second):
        same = next((i for i, row in enumerate(first) if i not in taken and row.equals(wanted)), None)
        if same is not None:
            taken.add(same)
            found[j] = wanted, []
    pairs = [
        (*_closest(first[i], second[j]), i, j)
        for i in range(len(first))
        if i not in taken
        for j in range(len(second))
        if j not in found
    ]
    for *_, row, wrong, i, j in sorted(pairs, key=lambda pair: pair[:2]):
        if i not in taken and j not in found:  # the rows that resemble each other most belong together
            taken.add(i)
            found[j] = row, wrong
    return [found[j] for j in range(len(second))]


def _closest(row: Element, wanted: Element) -> tuple[int, int, Element, list[Fault]]:
    """A row multiplied by the factor that leaves fewest faults; their number comes first."""
    best = None
    for scale in _scales(row, wanted):
        scaled = row * scale
        wrong = faults(scaled, wanted)
        cost = len(merged(wrong)), sum(fault.size for fault in wrong)
        if best is None or cost < best[:2]:
            best = (*cost, scaled, wrong)
        if best[0] == 0:
            break
    return best


def _scales(row: Element, wanted: Element) -> Iterator[Element]:
    """Factors by which a row may have been divided: 1, and the ratios of corresponding terms.

    Terms correspond when they have the same speeds and accelerations: θ̈ with m l² θ̈.  Ratios of
    inertia terms come first: of two explanations as short as each other, the one that leaves them right.
    """
    tried = [row.ring.one]
    yield tried[0]
    own, other = _by_motion(row), _by_motion(wanted)
    keys = row.ring.keys
    order = {
        motion: -max((keys[i][2] for i, e in enumerate(motion) if e), default=0)
        for motion in own
        if motion in other
    }
    for motion in sorted(order, key=lambda motion: (order[motion], motion)):
        ratio = other[motion] / own[motion]
        if not any(ratio.equals(known) for known in tried):
            tried.append(ratio)
            yield ratio


def _by_motion(element: Element) -> dict[tuple[int, ...], Element]:
    """Coefficients of an element's products of rates."""
    ring, parts = element.ring, {}
    for exponents, coefficient in ring.polynomials.terms(element.numerator):
        motion = motion_of(ring, exponents)
        rest = tuple(e - m for e, m in zip(exponents, motion, strict=True))
        parts.setdefault(motion, {})[rest] = coefficient
    below = ring.one if element.denominator is None else Element(ring, element.denominator)
    return {
        motion: Element(ring, ring.polynomials.from_terms(terms)) / below for motion, terms in parts.items()
    }


def _told(rows: Rows, j: int, fault: Fault, coordinate: str) -> Difference:
    given, expected = (_element(rows.ring, terms, fault.below) for terms in (fault.given, fault.expected))
    term = given if fault.kind == "extra" else expected
    told = Difference(
        j + 1,
        fault.kind,
        _readable(term),
        fault.factor,
        _readable(given) if fault.kind == "changed" else None,
        coordinate,
    )
    finding = Finding(j, fault.kind, fault.factor, fault.motion, term, told.given, told.expected)
    return replace(told, remark=remark(finding, rows))


def _element(ring: Ring, terms: dict, below: object) -> Element:
    return Element(ring, ring.polynomials.from_terms(terms)) / Element(ring, below)


def _readable(element: Element) -> sm.Expr:
    """A term for people: |v|/v is the sign of v."""
    expr = to_sympy(tree(element))
    for magnitude in expr.atoms(sm.Abs):
        (inner,) = magnitude.args
        factors = sm.Mul.make_args(expr)
        if magnitude in factors and 1 / inner in factors:
            expr = expr * inner / magnitude * sm.sign(inner)
    return expr
