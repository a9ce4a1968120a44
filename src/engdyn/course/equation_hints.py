"""The strongest true thing to say of wrong equations of motion without giving the right ones away."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from itertools import islice
from typing import Any

import sympy as sm
from sympy.physics.vector import dynamicsymbols

from engdyn.algebra.union import common_ring
from engdyn.course.case import Case
from engdyn.course.evaluation import NoValueError, evaluate, real, solve
from engdyn.course.sameness import ROUNDED, TERMS, cost, value_pairs
from engdyn.course.statics import small_angle
from engdyn.modeling.diagnosis import nature
from engdyn.modeling.differences import Difference
from engdyn.modeling.equality import Proof, prove_equal
from engdyn.modeling.equations import EquationsOfMotion

__all__ = ["explain", "residuals", "same_motion"]

#: States at which two motions are compared to recognize a mistake.
STATES = 6


def residuals(eom: EquationsOfMotion) -> tuple[sm.Expr, ...]:
    """M u̇ − f of equations of motion, one expression per row."""
    t = dynamicsymbols._t
    udot = sm.Matrix([u.diff(t) for u in eom.speeds])
    return tuple(eom.mass_matrix * udot - eom.forcing)


def explain(given: EquationsOfMotion, truth: EquationsOfMotion, proof: Proof, case: Case) -> str:
    """A hint for equations that were refuted and that no known mistake explains.

    Parameters
    ----------
    given, truth : EquationsOfMotion
    proof : Proof
        The refutation, with the differences.
    case : Case
    """
    if same_motion(given, truth, case, change=lambda e: _all_small(e, case)):
        return "Your equations are right for small angles only. Keep sines and cosines as they are."
    found = _differences(given, truth, proof)
    if found:
        return _in_words(found, case)
    return _right_without(given, truth, case) or (
        "Your equations describe another motion. Compare each term with the free bodies or the energies."
    )


def _right_without(given: EquationsOfMotion, truth: EquationsOfMotion, case: Case) -> str:
    """What a part of the equations has to be left out for the rest to be right."""
    rates = [c.symbol.diff(dynamicsymbols._t) for c in case.system.coordinates]
    if same_motion(given, truth, case, zero=rates):
        return "Your equations are right where all rates are zero: look at the terms with rates."
    named = {item.name: item.symbol for item in (*case.system.parameters, *case.system.inputs)}
    without = [name for name, symbol in named.items() if same_motion(given, truth, case, zero=[symbol])]
    if without:
        names = " and ".join([", ".join(without[:-1]), without[-1]] if len(without) > 1 else without)
        return f"Everything is right but for the terms with {names}: look at them again."
    if len(given.forcing) == 1 and _proportional(given.forcing[0], truth.forcing[0], case):
        return "Forces and couples are right: look at the inertia term."
    return ""


def _proportional(given: sm.Expr, truth: sm.Expr, case: Case) -> bool:
    """Whether the ratio of two expressions is one number, not zero, at all points."""
    ratios = [x / y for x, y, _ in value_pairs(given, truth, case.points.take(STATES)) if y != 0]
    return bool(ratios) and ratios[0] != 0 and all(abs(r / ratios[0] - 1) < ROUNDED for r in ratios)


def same_motion(
    a: EquationsOfMotion,
    b: EquationsOfMotion,
    case: Case,
    change: Callable[[sm.Expr], sm.Expr] = lambda e: e,
    zero: Sequence[sm.Expr] = (),
    states: int = STATES,
    tolerance: float = ROUNDED,
) -> bool:
    """Whether all accelerations agree at several states, expressions changed, some symbols zero."""
    first, second = ([[*map(change, e.mass_matrix)], [*map(change, e.forcing)]] for e in (a, b))
    found = 0
    for point in islice(case.points, 2 * states):
        point = {**point, **dict.fromkeys(zero, real(0))}
        try:
            x, y = _accelerations(first, point), _accelerations(second, point)
        except NoValueError:
            continue
        largest = max(abs(v) for v in (*x, *y))
        if any(abs(v - w) > tolerance * largest for v, w in zip(x, y, strict=True)):
            return False
        found += 1
    return found >= states


def _accelerations(equations: list[list[sm.Expr]], point: Mapping[sm.Expr, Any]) -> list[Any]:
    mass, force = ([evaluate(e, point)[0] for e in entries] for entries in equations)
    n = len(force)
    return solve([mass[i * n : (i + 1) * n] for i in range(n)], force)


def _differences(given: EquationsOfMotion, truth: EquationsOfMotion, proof: Proof) -> Sequence[Difference]:
    """The shortest list of differing terms, where terms can be compared one by one; else none."""
    found = [proof.differences] if _same_denominators(given, truth) else []
    if (
        len(truth.coordinates) == 1
    ):  # a single equation may be scaled so that its acceleration has the right factor
        scaled = sm.Mul(truth.mass_matrix[0] / given.mass_matrix[0], residuals(given)[0])
        if cost(scaled) <= TERMS:
            other = EquationsOfMotion.from_residuals([scaled], truth.coordinates)
            if _same_denominators(other, truth):
                found.append(prove_equal(other, truth).differences)
    return min((f for f in found if f), key=len, default=())


def _same_denominators(given: EquationsOfMotion, truth: EquationsOfMotion) -> bool:
    """Whether nothing is divided, or everything by the same: else terms cannot be told apart."""
    _, transfers = common_ring([given.ring, truth.ring])
    below = [
        [into(e).denominator for row in (*eom.mass, eom.force) for e in row]
        for eom, into in zip((given, truth), transfers, strict=True)
    ]
    return all(any(a == b for b in below[1]) for a in below[0]) and all(
        any(a == b for a in below[0]) for b in below[1]
    )


def _all_small(expr: sm.Expr, case: Case) -> sm.Expr:
    for coordinate in case.system.coordinates:
        if coordinate.unit == "rad":
            expr = small_angle(expr, coordinate.symbol)
    return expr


def _in_words(differences: Sequence[Difference], case: Case) -> str:
    """What differs, in words that name the kind of a term but not the term that is missing."""
    inputs = [i.symbol for i in case.system.inputs]
    first = min(differences, key=lambda d: ("sign", "factor", "changed", "extra", "missing").index(d.kind))
    where = f"Equation {first.equation}: " if len(case.system.coordinates) > 1 else ""
    kind = nature(first.term, inputs)
    said = {
        "missing": f"{kind} is missing or incomplete",
        "extra": f"{kind} stands there that does not belong there",
        "sign": f"{kind} has the wrong sign",
        "factor": f"{kind} has a wrong constant factor",
        "changed": f"{kind} is not what it should be",
    }[first.kind]
    others = len({(d.equation, d.kind, nature(d.term, inputs)) for d in differences}) - 1
    more = (
        f" (After it, {others} more {'term differs' if others == 1 else 'terms differ'}.)" if others else ""
    )
    remark = f" {first.remark[:1].upper()}{first.remark[1:]}" if first.remark else ""
    stop = "." if remark and remark[-1] not in ".?!" else ""
    text = f"{where}{said}."
    return text[:1].upper() + text[1:] + remark + stop + more
