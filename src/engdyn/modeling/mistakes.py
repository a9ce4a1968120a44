"""Mistakes of mechanics that can be told from the form of a wrong term, its equation and the others.

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

from engdyn.algebra.ring import Element, Ring

__all__ = [
    "HALF",
    "TWO",
    "WEIGHT",
    "Finding",
    "Rows",
    "acceleration",
    "centripetal",
    "coriolis",
    "damping",
    "follower",
    "friction",
    "name_of",
    "offset",
    "parallel_axis",
    "reaction",
    "spring",
]

HALF, TWO = Fraction(1, 2), Fraction(2)

#: The name of the acceleration of gravity.
WEIGHT = "g"


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
        """Functions that occur in the argument of a sine or cosine."""
        bases = [key[1] for key in self.ring.keys if key[0] == "sine"]
        return {f for base in bases for f in base.atoms(sm.Function)}

    def coordinate(self, row: int) -> sm.Expr | None:
        """The coordinate whose equation a row is."""
        owner = self.owners[row]
        return None if owner is None or owner[2] != 2 else owner[1]


def name_of(quantity: sm.Expr) -> str:
    """How a quantity is written in a remark: theta, theta', F."""
    if isinstance(quantity, sm.Derivative):
        return quantity.expr.func.__name__ + "'" * int(quantity.variable_count[0][1])
    return quantity.func.__name__ if quantity.is_Function else str(quantity)


def _rates(finding: Finding, rows: Rows) -> list[tuple[tuple, int]]:
    """The time derivatives in a term, with exponents."""
    return [(rows.ring.keys[i], e) for i, e in enumerate(finding.motion) if e]


def follower(finding: Finding, rows: Rows) -> str:
    """A force that has a potential in the first set only."""
    coordinates = [rows.coordinate(i) for i in range(len(rows.given))]
    if finding.kind not in ("missing", "extra", "changed") or None in coordinates or len(coordinates) < 2:
        return ""
    keys = [("function", q, 0) for q in coordinates]
    for load in _loads(finding, rows):
        given, wanted = ([rows.partial(row, load) for row in both] for both in (rows.given, rows.wanted))
        static = all(not _moves(rows, e) for e in (*given, *wanted))
        if static and any(not e.is_zero() for e in given) and not _curl(rows, given, keys):
            if _curl(rows, wanted, keys):
                return f"{name_of(load[1])} has a potential in your equations; a force that turns with a body has none"
    return ""


def _loads(finding: Finding, rows: Rows) -> list[tuple]:
    """Parameters and inputs in which a term is linear."""
    inputs = [rows.ring.keys[i] for i in rows.ring.independent([finding.term])]
    inputs = [key for key in inputs if key[0] == "function" and key[2] == 0]
    own = {key[1] for key in rows.keys}
    keys = [*rows.symbols(finding.term), *(key for key in inputs if key[1] not in own)]
    return [key for key in keys if _linear_in(rows, finding.term, key)]


def _linear_in(rows: Rows, element: Element, key: tuple) -> bool:
    """Whether an element is a multiple of a generator."""
    slope = rows.partial(element, key)
    return not slope.is_zero() and (slope * rows.ring.generator(key)).equals(element)


def _moves(rows: Rows, element: Element) -> bool:
    keys = [rows.ring.keys[i] for i in rows.ring.independent([element])]
    return any(key[0] == "function" and key[2] > 0 for key in keys)


def _curl(rows: Rows, forces: Sequence[Element], keys: Sequence[tuple]) -> bool:
    n = len(forces)
    return any(
        not rows.partial(forces[i], keys[j]).equals(rows.partial(forces[j], keys[i]))
        for i in range(n)
        for j in range(i)
    )


def friction(finding: Finding, rows: Rows) -> str:
    """Dry friction with the weight alone for normal force."""
    given, wanted = rows.given[finding.row], rows.wanted[finding.row]
    for mu in rows.symbols(finding.term):
        g = [key for key in rows.symbols(wanted) if key[1].name == WEIGHT]
        if mu[1].name.split("_")[0] not in ("mu", "μ") or not g:
            continue
        assumed, right = (rows.partial(row, mu) for row in (given, wanted))
        if _linear_in(rows, assumed, g[0]) and not assumed.equals(right):
            return "was N = m g assumed? The normal force has other parts too; find it from a balance"
    return ""


def reaction(finding: Finding, rows: Rows) -> str:
    """Everything with one mass, spring or damper is gone from an equation, though others have it."""
    if finding.kind != "missing":
        return ""
    given, wanted = rows.given[finding.row], rows.wanted[finding.row]
    others = [row for i, row in enumerate(rows.given) if i != finding.row]
    for key in rows.symbols(finding.term):
        elsewhere = any(not rows.partial(row, key).is_zero() for row in others)
        whole = _linear_in(rows, wanted - given, key) and rows.partial(given, key).is_zero()
        if elsewhere and whole and key[1].name != WEIGHT and not _is_length(key, rows):
            return (
                f"nothing with {key[1]} is left in this equation, though it stands in another one: "
                "was the reaction on this body forgotten?"
            )
    return ""


def _is_length(key: tuple, rows: Rows) -> bool:
    """Whether a parameter stands with a higher power anywhere, as masses, stiffnesses and dampers do not."""
    return any(not rows.partial(rows.partial(row, key), key).is_zero() for row in rows.wanted)


def offset(finding: Finding, rows: Rows) -> str:
    """A length that the first set does not know, in a term with rates."""
    if finding.kind != "missing" or not any(finding.motion):
        return ""
    known = set(rows.symbols(*rows.given))
    lost = [key for key in rows.symbols(finding.term) if key not in known]
    if len(lost) == 1 and (_is_length(lost[0], rows) or len(_rates(finding, rows)) > 1):
        return f"{lost[0][1]} occurs nowhere in your equations: a distance or an offset left out?"
    return ""


def acceleration(finding: Finding, rows: Rows) -> str:
    """Terms with the acceleration of a base or of another coordinate."""
    rates = _rates(finding, rows)
    if len(rates) != 1 or rates[0][0][2] != 2 or finding.kind not in ("missing", "sign"):
        return ""
    key, own = rates[0][0], rows.coordinate(finding.row)
    name = f"{key[1].func.__name__}''"
    if key not in rows.keys:
        if finding.kind == "sign":
            return f"the term with the base acceleration {name} has its sign reversed"
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
    rates = _rates(finding, rows)
    two = len(rates) == 2 and all(key[2] == 1 and e == 1 for key, e in rates)
    product = two and any(key[1] in rows.angles or _turns(key, rows) for key, _ in rates)
    if not product and not (len(rates) == 1 and _gyroscopic(finding, rows, rates[0])):
        return ""
    if finding.kind == "factor" and finding.factor == HALF:
        return "half as large as it should be: the Coriolis term 2 ω v has lost its factor 2"
    texts = {
        "missing": "the Coriolis term 2 ω v is missing",
        "sign": "the Coriolis term has its sign reversed",
    }
    return texts.get(finding.kind, "")


def _turns(key: tuple, rows: Rows) -> bool:
    """Whether a coordinate is an angle because its rate squared times a length is an acceleration elsewhere."""
    at = rows.ring.index[key]
    return any(
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
    """The square of the rate of an angle."""
    rates = _rates(finding, rows)
    square = len(rates) == 1 and rates[0][1] == 2 and rates[0][0][2] == 1 and rates[0][0][1] in rows.angles
    texts = {
        "missing": "the centripetal term ω² r is missing",
        "sign": "the centripetal term has its sign reversed",
    }
    return texts.get(finding.kind, "") if square else ""


def damping(finding: Finding, rows: Rows) -> str:
    """Terms linear in one rate."""
    rates = _rates(finding, rows)
    if len(rates) != 1 or rates[0][1] != 1 or rates[0][0][2] != 1:
        return ""
    if finding.factor == TWO:
        return "twice as large as it should be: Rayleigh's function is half the dissipated power"
    if finding.factor == HALF:
        return "half as large as it should be: with D = c v²/2 the damper's force is c v"
    if finding.kind == "sign":
        return "a damper must act against the motion: sign reversed"
    given = rows.given[finding.row]
    for key in rows.symbols(finding.term) if finding.kind == "missing" else ():
        kept = rows.partial(given, key)
        if not kept.is_zero() and _linear_in(rows, finding.term, key) and _only_rates(rows, kept):
            return f"the rate at the damper {key[1]} is incomplete: a lever arm or an offset is left out"
    return ""


def _only_rates(rows: Rows, element: Element) -> bool:
    """Whether every term has one rate."""
    rates = [i for i, key in enumerate(rows.ring.keys) if key[0] == "function" and key[2] > 0]
    terms = [e for e, _ in rows.ring.polynomials.terms(element.numerator)]
    return all(sum(exponents[i] for i in rates) == 1 for exponents in terms)


def parallel_axis(finding: Finding, rows: Rows) -> str:
    """A mass times the square of a length, with the acceleration of the equation's own coordinate."""
    owner, rates = rows.owners[finding.row], _rates(finding, rows)
    if owner is None or rates != [(owner, 1)] or finding.kind not in ("missing", "extra"):
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
    return "the parallel-axis term m d² stands there once too often: is the inertia about this point already?"


def spring(finding: Finding, rows: Rows) -> str:
    """A spring without its free length: k L L_q remains of k (L − L_0) L_q."""
    own = rows.coordinate(finding.row)
    if finding.kind != "missing" or own is None or any(finding.motion):
        return ""
    q, wanted, term = ("function", own, 0), rows.wanted[finding.row], finding.term
    loads = [key for key in rows.symbols(term) if _linear_in(rows, term, key)]
    for s in loads:
        for k in (key for key in loads if key != s):
            length, slope = rows.ring.generator(s), -term / (rows.ring.generator(k) * rows.ring.generator(s))
            whole = rows.partial(wanted, k)
            if slope.is_zero() or _moves(rows, whole) or not rows.partial(slope, k).is_zero():
                continue
            found = length + whole / slope
            if not slope.is_zero() and rows.partial(found, q).equals(slope):
                return f"the free length {s[1]} of the spring is missing from its energy or force"
    return ""
