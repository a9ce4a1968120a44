"""Mistakes with forces that can be told from the form of a wrong term, its equation and the others.

One function per mistake, as in :mod:`engdyn.modeling.mistakes`.  Course chapters 1 to 3.
"""

from __future__ import annotations

from collections.abc import Sequence

from engdyn.algebra.ring import Element
from engdyn.modeling.mistakes import HALF, TWO, WEIGHT, Finding, Rows, name_of

__all__ = ["damping", "elongation", "follower", "friction", "reaction", "spring", "virtual_work"]


def follower(finding: Finding, rows: Rows) -> str:
    """A force that has a potential in the first set only."""
    coordinates = [rows.coordinate(i) for i in range(len(rows.given))]
    if finding.kind not in ("missing", "extra", "changed") or None in coordinates or len(coordinates) < 2:
        return ""
    keys = [("function", q, 0) for q in coordinates]
    for load in _loads(finding, rows):
        given, wanted = ([rows.partial(row, load) for row in both] for both in (rows.given, rows.wanted))
        static = all(not rows.moves(e) for e in (*given, *wanted))
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
    return [key for key in keys if rows.linear_in(finding.term, key)]


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
        if rows.linear_in(assumed, g[0]) and not assumed.equals(right):
            return "was N = m g assumed? The normal force has other parts too; find it from a balance"
    return ""


def reaction(finding: Finding, rows: Rows) -> str:
    """Everything with one mass, spring or damper is gone from an equation, though others have it."""
    if finding.kind != "missing":
        return ""
    given, wanted = rows.given[finding.row], rows.wanted[finding.row]
    others = [row for i, row in enumerate(rows.given) if i != finding.row]
    symbols = rows.symbols(finding.term)
    for key in symbols if all(key[1].name != WEIGHT for key in symbols) else ():  # a weight is no reaction
        elsewhere = any(not rows.partial(row, key).is_zero() for row in others)
        whole = rows.linear_in(wanted - given, key) and rows.partial(given, key).is_zero()
        if elsewhere and whole and not rows.is_length(key):
            return (
                f"nothing with {key[1]} is left in this equation, though it stands in another one: "
                "was the reaction on this body forgotten?"
            )
    return ""


def damping(finding: Finding, rows: Rows) -> str:
    """Terms linear in one rate."""
    rates = rows.rates(finding)
    if len(rates) != 1 or rates[0][1] != 1 or rates[0][0][2] != 1:
        return ""
    name, owner = f"{rates[0][0][1].func.__name__}'", rows.coordinate(finding.row)
    if finding.factor == TWO:
        return "twice as large as it should be: Rayleigh's function is half the dissipated power"
    if finding.factor == HALF:
        return "half as large as it should be: with D = c v²/2 the damper's force is c v"
    if finding.kind == "sign":
        if owner not in (None, rates[0][0][1]):
            return f"the part with {name} has its sign reversed: check in which sense both rates are counted"
        return "a damper must act against the motion: sign reversed"
    given = rows.given[finding.row]
    for key in rows.symbols(finding.term) if finding.kind == "missing" else ():
        kept = rows.partial(given, key)
        if not kept.is_zero() and rows.linear_in(finding.term, key) and _only_rates(rows, kept):
            arm = rows.symbols(rows.partial(finding.term, key)) or owner in (None, rates[0][0][1])
            why = "a lever arm or an offset" if arm else f"the rate {name} of its other end"
            return f"the rate at the damper {key[1]} is incomplete: {why} is left out"
    return ""


def _only_rates(rows: Rows, element: Element) -> bool:
    """Whether every term has one rate."""
    rates = [i for i, key in enumerate(rows.ring.keys) if key[0] == "function" and key[2] > 0]
    terms = [e for e, _ in rows.ring.polynomials.terms(element.numerator)]
    return all(sum(exponents[i] for i in rates) == 1 for exponents in terms)


def spring(finding: Finding, rows: Rows) -> str:
    """A spring without its free length: k L L_q remains of k (L − L_0) L_q."""
    own = rows.coordinate(finding.row)
    if finding.kind != "missing" or own is None or any(finding.motion):
        return ""
    q, wanted, term = ("function", own, 0), rows.wanted[finding.row], finding.term
    loads = [key for key in rows.symbols(term) if rows.linear_in(term, key)]
    for s in loads:
        for k in (key for key in loads if key != s):
            length, slope = rows.ring.generator(s), -term / (rows.ring.generator(k) * rows.ring.generator(s))
            whole = rows.partial(wanted, k)
            if slope.is_zero() or rows.moves(whole) or not rows.partial(slope, k).is_zero():
                continue
            found = length + whole / slope
            rate = rows.partial(found, q)
            if not rate.is_zero() and not rows.ring.independent([slope / rate]):  # n equal springs
                return f"the free length {s[1]} of the spring is missing from its energy or force"
    return ""


def elongation(finding: Finding, rows: Rows) -> str:
    """The displacement of one end of a spring left out: k q remains of k (q − q_2)."""
    own, term = rows.coordinate(finding.row), finding.term
    if finding.kind != "missing" or own is None or any(finding.motion):
        return ""
    for k in _loads(finding, rows):
        kept = rows.partial(rows.given[finding.row], k)
        for end in (key for key in rows.ring.keys if key[0] == "function" and key[1:] not in ((own, 0),)):
            if k[0] == "symbol" and rows.linear_in(term, end) and rows.linear_in(kept, ("function", own, 0)):
                left_out = f"the displacement {name_of(end[1])} is left out"
                return f"the elongation of the spring {k[1]} is incomplete: {left_out}"
    return ""


def virtual_work(finding: Finding, rows: Rows) -> str:
    """A force or couple that stands in another equation only."""
    own = rows.coordinate(finding.row)
    if finding.kind != "missing" or own is None:
        return ""
    for load in _loads(finding, rows):
        absent = [rows.partial(row, load).is_zero() for row in rows.given]
        if load[0] == "function" and absent[finding.row] and not all(absent):
            alone = f"when {name_of(own)} alone changes"
            return f"{name_of(load[1])} stands in another equation only: does it, or its reaction, do work {alone}?"
    return ""
