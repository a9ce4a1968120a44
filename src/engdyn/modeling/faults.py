"""Term by term: what was done to an equation that differs from another one in a few places."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import sympy as sm

from engdyn.algebra.readable import to_sympy, tree
from engdyn.algebra.ring import Element, Ring

__all__ = ["Fault", "faults", "merged", "motion_of"]

Exponents = tuple[int, ...]
Terms = dict[Exponents, Fraction]

#: What is done to terms most often, and in which order explanations are tried: left out, turned, doubled, halved.
USUAL = (Fraction(0), Fraction(-1), Fraction(2), Fraction(1, 2))
KINDS = ("missing", "extra", "sign", "factor", "changed", "partly")


@dataclass(frozen=True)
class Fault:
    """Terms with the same rates to which the same was done.

    Attributes
    ----------
    motion : tuple of int
        Exponents of the time derivatives.
    kind : str
        As of :class:`engdyn.modeling.differences.Difference`; "partly" before the part is looked for.
    factor : fractions.Fraction, sympy.Expr or None
    given, expected : dict
        Polynomials of the first and of the second set, as exponents → coefficient.
    below : polynomial
        Denominator of both.
    shift : tuple of int
        For "changed": exponents that the given term has more than the expected one, () where it is no monomial.
    """

    motion: Exponents
    kind: str
    factor: Any
    given: Terms
    expected: Terms
    ring: Ring
    below: Any
    shift: Exponents = ()

    @property
    def size(self) -> int:
        """Number of terms that differ."""
        return len(self.given.keys() | self.expected.keys())


def motion_of(ring: Ring, exponents: Exponents) -> Exponents:
    """The exponents of time derivatives alone."""
    return tuple(
        e if key[0] == "function" and key[2] > 0 else 0 for e, key in zip(exponents, ring.keys, strict=True)
    )


def faults(row: Element, wanted: Element) -> list[Fault]:
    """What differs between two rows, one fault for each product of parameters, coordinates and rates.

    Terms that differ only in sines and cosines stay together: 1 − cos² is sin², and cos(a − b) one term.
    """
    ring, one = row.ring, row.ring.polynomials.one
    below = [e.denominator if e.denominator is not None else one for e in (row, wanted)]
    a, b = (
        _by_parameters(ring, ring.reduce(p)) for p in (row.numerator * below[1], wanted.numerator * below[0])
    )
    common, found = below[0] * below[1], []
    for rest in dict.fromkeys([*b, *a]):
        given, expected = a.get(rest, {}), b.get(rest, {})
        if given != expected:
            kind, factor = _kind(given, expected)
            found.append(Fault(motion_of(ring, rest), kind, factor, given, expected, ring, common))
    return _paired(found)


def _by_parameters(ring: Ring, p: Any) -> dict[Exponents, Terms]:
    """Terms of a polynomial by their exponents without those of sines and cosines."""
    angular = [key[0] in ("sine", "cosine") for key in ring.keys]
    parts: dict[Exponents, Terms] = {}
    for exponents, coefficient in ring.polynomials.terms(p):
        rest = tuple(0 if skip else e for e, skip in zip(exponents, angular, strict=True))
        parts.setdefault(rest, {})[exponents] = coefficient
    return parts


def _kind(given: Terms, expected: Terms) -> tuple[str, Fraction | None]:
    if not given:
        return "missing", None
    if not expected:
        return "extra", None
    ratio = _ratio(given, expected)
    if ratio is None:
        return "partly", None
    return ("sign" if ratio == -1 else "factor"), ratio


def _ratio(given: Terms, expected: Terms) -> Fraction | None:
    """The number that one polynomial is times the other."""
    if given.keys() != expected.keys():
        return None
    ratios = {given[e] / expected[e] for e in given}
    return ratios.pop() if len(ratios) == 1 else None


def _paired(found: list[Fault]) -> list[Fault]:
    """Join an extra and a missing term where one is the other in disguise: π/180 of it, m l θ̈ for m l² θ̈."""
    missing = [f for f in found if f.kind == "missing"]
    result = [f for f in found if f.kind not in ("missing", "extra")]
    for extra in (f for f in found if f.kind == "extra"):
        ranked = sorted(
            ((rank, i) for i, f in enumerate(missing) if (rank := _likeness(extra, f)) is not None)
        )
        if ranked:
            result.append(_joined(extra, missing.pop(ranked[0][1])))
        else:
            result.append(extra)
    return [*result, *missing]


def _shift(extra: Fault, missing: Fault) -> tuple[Exponents, Fraction] | None:
    """The monomial that the given terms are times the expected ones, None where it is none."""
    if len(extra.given) != len(missing.expected):
        return None
    (first, a), (second, b) = ((max(terms), terms[max(terms)]) for terms in (extra.given, missing.expected))
    shift, ratio = tuple(x - y for x, y in zip(first, second, strict=True)), a / b
    moved = {
        tuple(e + s for e, s in zip(exponents, shift, strict=True)): ratio * c
        for exponents, c in missing.expected.items()
    }
    return (shift, ratio) if moved == extra.given else None


def _likeness(extra: Fault, missing: Fault) -> int | None:
    """How little two terms differ: 0 a factor with π, 1 a symbol more or less, 2 one in place of another."""
    found = _shift(extra, missing)
    if found is None:
        return None
    keys = [(extra.ring.keys[i], s) for i, s in enumerate(found[0]) if s]
    if all(key == ("symbol", sm.pi) for key, _ in keys):
        return 0
    if len(keys) == 1:
        return 1 if keys[0][0][0] in ("symbol", "function", "root") else None
    (one, up), (other, down) = keys if len(keys) == 2 else ((None, 0), (None, 0))
    alike = one is not None and one[0] == other[0] and one[0] in ("symbol", "function") and up == -down
    return 2 if alike and one[2:] == other[2:] and ("symbol", sm.pi) not in (one, other) else None


def _joined(extra: Fault, missing: Fault) -> Fault:
    shift, ratio = _shift(extra, missing)
    ring = extra.ring
    powers = {ring.keys[i]: s for i, s in enumerate(shift) if s}
    kind, factor = "changed", None
    if set(powers) == {("symbol", sm.pi)}:
        kind, factor = (
            "factor",
            sm.Rational(ratio.numerator, ratio.denominator) * sm.pi ** powers["symbol", sm.pi],
        )
    expected = missing.expected
    return Fault(missing.motion, kind, factor, extra.given, expected, ring, extra.below, shift)


def merged(found: Sequence[Fault], finest: bool = False) -> list[Fault]:
    """Faults of the same kind on terms with the same rates as one, accelerations first.

    Parameters
    ----------
    finest : bool
        Whether to find out which part of a group of sines and cosines is affected; needed only
        for what is shown.
    """
    if finest:
        found = [fault if fault.kind != "partly" else _part(fault) for fault in found]
    groups: dict[tuple, Fault] = {}
    for fault in found:
        key = (fault.motion, fault.kind, fault.factor, fault.shift)
        known = groups.get(key)
        groups[key] = fault if known is None else _union(known, fault)
    return sorted(groups.values(), key=_order)


def _union(a: Fault, b: Fault) -> Fault:
    return Fault(
        a.motion,
        a.kind,
        a.factor,
        {**a.given, **b.given},
        {**a.expected, **b.expected},
        a.ring,
        a.below,
        a.shift,
    )


def _order(fault: Fault) -> tuple:
    rates = [(fault.ring.keys[i][2], e) for i, e in enumerate(fault.motion) if e]
    highest, degree = max((order for order, _ in rates), default=0), sum(e for _, e in rates)
    return -highest, -degree, tuple(-e for e in fault.motion), KINDS.index(fault.kind), str(fault.factor)


def _part(fault: Fault) -> Fault:
    """Which part of the expected terms was left out, turned or scaled: given = r P + Q, expected = P + Q."""
    given, expected = fault.given, fault.expected
    if _single(fault, given) and _single(fault, expected):
        return _as(fault, "changed", None, given, expected)
    change = {e: given.get(e, Fraction(0)) - expected.get(e, Fraction(0)) for e in given | expected}
    change = {e: c for e, c in change.items() if c}
    own = {given.get(e, Fraction(0)) / expected[e] for e in change if e in expected}
    options = []
    for rank, r in enumerate((*USUAL, *(sorted(own - set(USUAL)) if len(own) == 1 else ()))):
        part = {e: c / (r - 1) for e, c in change.items()}
        rest = [e for e in expected | part if expected.get(e, 0) != part.get(e, 0)]
        options.append((len(part) + len(rest), rank, r, part))
    best = min(options, key=lambda option: option[:2])
    added = len(change) + len(expected)
    if min(best[0], added) > len(given | expected):  # nothing simple was done
        return _as(fault, "changed", None, given, expected)
    if added < best[0]:
        return _as(fault, "extra", None, change, {})
    _, _, r, part = best
    kind = {0: "missing", -1: "sign"}.get(r, "factor")
    kept = {} if r == 0 else {e: r * c for e, c in part.items()}
    return _as(fault, kind, None if r == 0 else r, kept, part)


def _as(fault: Fault, kind: str, factor: Any, given: Terms, expected: Terms) -> Fault:
    return Fault(fault.motion, kind, factor, given, expected, fault.ring, fault.below)


def _single(fault: Fault, terms: Terms) -> bool:
    """Whether a polynomial reads as one product: m l cos(a − b)."""
    ring = fault.ring
    expr = to_sympy(tree(Element(ring, ring.polynomials.from_terms(terms))))
    return not any(factor.is_Add for f in sm.Mul.make_args(expr) for factor in (f, f.as_base_exp()[0]))
