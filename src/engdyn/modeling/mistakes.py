"""Mistakes with inertia that can be told from the form of a wrong term, its equation and the others.

One function per mistake, with the finding and the rows of both sets; the answer is a remark, or ""
where the term does not have that form.  Course chapters 1 to 3.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from typing import Any

import sympy as sm
from sympy.physics.vector.printing import vsstrrepr

from engdyn.algebra.ring import Element, Ring

__all__ = [
    "HALF",
    "TWO",
    "WEIGHT",
    "Finding",
    "Rows",
    "acceleration",
    "body_spin",
    "centripetal",
    "coriolis",
    "name_of",
    "offset",
    "parallel_axis",
]

HALF, TWO = Fraction(1, 2), Fraction(2)

#: The name of the acceleration of gravity.
WEIGHT = "g"

DONE = {"missing": "is missing", "sign": "has its sign reversed"}


@dataclass(frozen=True)
class Finding:
    """A wrong term: number of its row, kind, factor, exponents of its rates, the term itself, as given, as expected."""

    row: int
    kind: str
    factor: Any
    motion: tuple[int, ...]
    term: Element
    given: sm.Expr
    expected: sm.Expr


@dataclass(frozen=True)
class Rows:
    """The equations of both sets, row by row, and the acceleration (a key of the ring) that each row belongs to."""

    ring: Ring
    given: Sequence[Element]
    wanted: Sequence[Element]
    owners: Sequence[tuple | None]
    keys: Sequence[tuple]

    def partial(self, element: Element, key: tuple) -> Element:
        """Partial derivative with respect to one generator."""
        return self.ring.partial(key)(element)

    def symbols(self, *elements: Element) -> list[tuple]:
        """Keys of the parameters that elements contain, π and time aside."""
        keys = [self.ring.keys[i] for i in self.ring.independent(elements)]
        return [key for key in keys if key[0] == "symbol" and key[1] != sm.pi]

    @cached_property
    def angles(self) -> set[sm.Expr]:
        """Functions in the argument of a sine or cosine, by themselves: of s/R the s is a length."""
        bases = [key[1] for key in self.ring.keys if key[0] == "sine"]
        return {f for base in bases for f in base.atoms(sm.Function) if base.diff(f).is_number}

    def linear_in(self, element: Element, key: tuple) -> bool:
        """Whether an element is a multiple of a generator."""
        slope = self.partial(element, key)
        return not slope.is_zero() and (slope * self.ring.generator(key)).equals(element)

    def moves(self, element: Element) -> bool:
        """Whether an element contains a rate or an acceleration."""
        keys = [self.ring.keys[i] for i in self.ring.independent([element])]
        return any(key[0] == "function" and key[2] > 0 for key in keys)

    def is_length(self, key: tuple) -> bool:
        """Whether a parameter stands with a higher power anywhere, as masses, stiffnesses and dampers do not."""
        return any(not self.partial(self.partial(row, key), key).is_zero() for row in self.wanted)

    def rates(self, finding: Finding) -> list[tuple[tuple, int]]:
        """The time derivatives in a term, with exponents."""
        return [(self.ring.keys[i], e) for i, e in enumerate(finding.motion) if e]

    def coordinate(self, row: int) -> sm.Expr | None:
        """The coordinate whose equation a row is."""
        owner = self.owners[row]
        return None if owner is None or owner[2] != 2 else owner[1]


def name_of(quantity: sm.Expr) -> str:
    """How a quantity is written in a remark: theta, theta', F, cos(theta)."""
    return vsstrrepr(quantity)


def offset(finding: Finding, rows: Rows) -> str:
    """A length that the first set does not know, in a term with rates."""
    if finding.kind != "missing" or not any(finding.motion):
        return ""
    known = set(rows.symbols(*rows.given))
    lost = [key for key in rows.symbols(finding.term) if key not in known]
    if len(lost) == 1 and (rows.is_length(lost[0]) or len(rows.rates(finding)) > 1):
        return f"{lost[0][1]} occurs nowhere in your equations: a distance or an offset left out?"
    return ""


def acceleration(finding: Finding, rows: Rows) -> str:
    """Terms with the acceleration of a base or of another coordinate."""
    rates = rows.rates(finding)
    if len(rates) != 1 or rates[0][0][2] != 2 or finding.kind not in ("missing", "extra", "sign"):
        return ""
    key, own = rates[0][0], rows.coordinate(finding.row)
    name = f"{key[1].func.__name__}''"
    if finding.kind == "extra":
        coupled = own in (None, key[1]) or not rows.partial(rows.wanted[finding.row], key).is_zero()
        return "" if coupled else f"{name} has no place in this equation: was a relative velocity put into T?"
    if key not in rows.keys:
        if finding.kind == "sign":
            return f"the term with the base acceleration {name} has its sign reversed"
        if _squared(("function", key[1], 1), rows):
            return f"the Euler term α × r with {name} is missing: the prescribed turning need not be steady"
        return (
            f"the term with the base acceleration {name} is missing: relative velocities in T, "
            "or a moment balance about an accelerating point without m r_PG × a_P?"
        )
    if own is None or key[1] == own or finding.kind == "sign":
        return ""
    other, back = rows.keys.index(key), rows.owners[finding.row]
    lost = rows.partial(rows.wanted[other] - rows.given[other], back)
    if not lost.is_zero():
        return "the coupling is lost in both equations: relative velocities in T?"
    if own in rows.angles:
        return f"a moment balance about an accelerating point: the term m r_PG × a_P (here with {name}) is missing"
    return f"was a relative acceleration taken for the absolute one? The part with {name} is missing"


def coriolis(finding: Finding, rows: Rows) -> str:
    """Products of two different rates, one of them that of an angle; and 2 Ω v with constant Ω."""
    rates = rows.rates(finding)
    two = len(rates) == 2 and all(key[2] == 1 and e == 1 for key, e in rates)
    gyroscopic = len(rates) == 1 and _gyroscopic(finding, rows, rates[0])
    product = two and any(key[1] in rows.angles or _squared(key, rows) for key, _ in rates)
    if not product and not gyroscopic:
        return ""
    if gyroscopic and finding.kind == "sign":
        return "the gyroscopic term has its sign reversed: its partner elsewhere has the other sign"
    if finding.kind == "factor" and finding.factor == HALF:
        return "half as large as it should be: the Coriolis term 2 ω v has lost its factor 2"
    return f"the Coriolis term 2 ω v {DONE[finding.kind]}" if finding.kind in DONE else ""


def _squared(key: tuple, rows: Rows) -> bool:
    """Whether the square of a rate occurs: times a length it is an acceleration, and the coordinate an angle."""
    at = rows.ring.index.get(key)
    return at is not None and any(
        exponents[at] == 2
        for row in rows.wanted
        for exponents, _ in rows.ring.polynomials.terms(row.numerator)
    )


def _gyroscopic(finding: Finding, rows: Rows, rate: tuple[tuple, int]) -> bool:
    """Whether a term with the rate of another coordinate has its opposite in that one's equation."""
    (_, function, order), power = rate
    own, acceleration = rows.coordinate(finding.row), ("function", function, 2)
    if own is None or (order, power) != (1, 1) or function == own or acceleration not in rows.keys:
        return False
    there = rows.partial(rows.wanted[rows.keys.index(acceleration)], ("function", own, 1))
    here = rows.partial(rows.wanted[finding.row], ("function", function, 1))
    return not here.is_zero() and here.equals(-there)


def centripetal(finding: Finding, rows: Rows) -> str:
    """The square of the rate of an angle, or of a prescribed turning."""
    rates = rows.rates(finding)
    if len(rates) != 1 or rates[0][1] != 2 or rates[0][0][2] != 1:
        return ""
    angle = rates[0][0][1]
    prescribed = ("function", angle, 2) not in rows.keys
    if finding.factor == TWO and prescribed:
        return "twice as large as it should be: a centrifugal force in T and once more in V or as a load?"
    known = finding.kind in DONE and (angle in rows.angles or prescribed)
    return f"the centripetal term ω² r {DONE[finding.kind]}" if known else ""


def body_spin(finding: Finding, rows: Rows) -> str:
    """(C − A) where C belongs: the axes of a body that spins in them have been given its angular velocity."""
    row, ring = rows.wanted[finding.row], rows.ring
    plain = row.denominator is None and finding.term.denominator is None
    if finding.kind != "extra" or not any(finding.motion) or not plain:
        return ""
    inertias = [rows.partial(r, key) for r, key in zip(rows.wanted, rows.keys, strict=True)]
    right = dict(ring.polynomials.terms(row.numerator))
    for one in rows.symbols(finding.term):
        for two in rows.symbols(row) if rows.linear_in(finding.term, one) else ():
            swapped = rows.partial(finding.term, one) * ring.generator(two)
            opposite = all(right.get(e) == -c for e, c in ring.polynomials.terms(swapped.numerator))
            if opposite and all(any(not rows.partial(i, k).is_zero() for i in inertias) for k in (one, two)):
                names = f"({two[1]} - {one[1]}) stands where {two[1]} belongs"
                return f"{names}: was the angular velocity of the spinning body taken for that of the axes?"
    return ""


def parallel_axis(finding: Finding, rows: Rows) -> str:
    """A mass times the square of a length, with the acceleration of the equation's own coordinate."""
    owner, rates = rows.owners[finding.row], rows.rates(finding)
    fits = finding.kind in ("missing", "extra") or finding.factor == TWO
    if owner is None or rates != [(owner, 1)] or not fits:
        return ""
    ring, term = rows.ring, finding.term
    symbols = [i for i, key in enumerate(ring.keys) if key[0] == "symbol" and key[1] != sm.pi]
    squares = all(
        sorted(exponents[i] for i in symbols if exponents[i]) == [1, 2]
        for exponents, _ in ring.polynomials.terms(term.numerator)
    )
    own = [rows.partial(both[finding.row], owner) for both in (rows.given, rows.wanted)]
    if not squares or term.denominator is not None or any(e.is_zero() for e in own):
        return ""
    if finding.kind == "missing":
        return "the parallel-axis term m d² is missing: I_G in place of I_O?"
    if finding.factor == TWO:
        alone = (own[1] - rows.partial(term, owner)).is_zero()
        twice = "the parallel-axis term m d² counted twice: m v_G²/2 goes with I_G, not with I_O"
        return "" if alone else twice
    return "the parallel-axis term m d² stands there once too often: is the inertia about this point already?"
