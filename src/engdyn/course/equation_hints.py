"""The strongest true thing that can be said of wrong equations of motion without giving the right ones away."""

from __future__ import annotations

from collections.abc import Sequence

import sympy as sm
from sympy.physics.vector import dynamicsymbols

from engdyn.course.case import Case
from engdyn.course.sameness import TERMS, cost
from engdyn.course.statics import small_angle
from engdyn.errors import EngdynError
from engdyn.modeling.differences import Difference
from engdyn.modeling.equality import Proof, prove_equal
from engdyn.modeling.equations import EquationsOfMotion

__all__ = ["explain", "residuals"]


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
    given = _same_inertia(given, truth)
    if _equal_after(given, truth, lambda e: _all_small(e, case)):
        return "Your equations are right for small angles only. Keep sines and cosines as they are."
    if _same_denominators(given, truth):
        found = prove_equal(given, truth).differences or proof.differences
        if found:
            return _in_words(found, case)
    without = [
        p.name
        for p in case.system.parameters
        if _equal_after(given, truth, lambda e, symbol=p.symbol: e.xreplace({symbol: sm.S.Zero}))
    ]
    if without:
        names = " and ".join([", ".join(without[:-1]), without[-1]] if len(without) > 1 else without)
        return f"Everything is right but for the terms with {names}: look at them again."
    return "Your equations describe another motion. Compare each term with the free bodies or the energies."


def _same_inertia(given: EquationsOfMotion, truth: EquationsOfMotion) -> EquationsOfMotion:
    """A single equation, scaled so that its acceleration has the right factor."""
    if len(truth.coordinates) != 1:
        return given
    scaled = sm.Mul(truth.mass_matrix[0] / given.mass_matrix[0], residuals(given)[0])
    if cost(scaled) > TERMS or not (given.mass[0][0].equals(given.mass[0][0])):
        return given
    other = EquationsOfMotion.from_residuals([scaled], truth.coordinates)
    before, after = prove_equal(given, truth).differences, prove_equal(other, truth).differences
    return other if len(after) < len(before) or not _same_denominators(given, truth) else given


def _same_denominators(given: EquationsOfMotion, truth: EquationsOfMotion) -> bool:
    """Whether terms can be compared one by one: nothing is divided, or everything by the same."""

    def denominators(eom: EquationsOfMotion) -> set[str]:
        entries = [*(e for row in eom.mass for e in row), *eom.force]
        return {str(sm.expand(sm.denom(sm.together(f)))) for f in (*eom.mass_matrix, *eom.forcing)} if entries else set()

    return denominators(given) == denominators(truth)


def _equal_after(given: EquationsOfMotion, truth: EquationsOfMotion, change) -> bool:
    """Whether both describe the same motion once both were changed."""
    try:
        a, b = (
            EquationsOfMotion.from_residuals([change(e) for e in residuals(eom)], eom.coordinates) for eom in (given, truth)
        )
        return bool(prove_equal(a, b))
    except EngdynError:
        return False  # the change left no inertia, or divided by zero


def _all_small(expr: sm.Expr, case: Case) -> sm.Expr:
    for coordinate in case.system.coordinates:
        if coordinate.unit == "rad":
            expr = small_angle(expr, coordinate.symbol)
    return expr


def _in_words(differences: Sequence[Difference], case: Case) -> str:
    """What differs, in words that name the kind of a term but not the term that is missing."""
    first = min(differences, key=lambda d: ("sign", "factor", "extra", "missing").index(d.kind))
    where = f"Equation {first.equation}: " if len(case.system.coordinates) > 1 else ""
    kind = _kind(first.term, case)
    said = {
        "missing": f"{kind} is missing or incomplete",
        "extra": f"{kind} stands there that does not belong there",
        "sign": f"{kind} has the wrong sign",
        "factor": f"{kind} has a wrong constant factor",
    }[first.kind]
    others = len({(d.equation, d.kind, _kind(d.term, case)) for d in differences}) - 1
    more = f" (After it, {others} more {'term differs' if others == 1 else 'terms differ'}.)" if others else ""
    text = f"{where}{said}."
    return text[:1].upper() + text[1:] + more


def _kind(term: sm.Expr, case: Case) -> str:
    """What a term is: inertia, centrifugal and Coriolis, damping, input, weight, stiffness."""
    t = dynamicsymbols._t
    rates = {d for d in term.atoms(sm.Derivative) if d.variable_count[0][1] == 1}
    if any(d.variable_count[0][1] == 2 for d in term.atoms(sm.Derivative)):
        return "an inertia term (with an acceleration)"
    if rates:
        zero = term.xreplace({d: sm.S.Zero for d in rates})
        doubled = term.xreplace({d: 2 * d for d in rates})
        quadratic = zero == 0 and sm.expand(doubled - 4 * term) == 0
        return "a term with squares or products of rates" if quadratic else "a term with rates (a damper?)"
    inputs = [i.name for i in case.system.inputs if term.has(i.symbol)]
    if inputs:
        return f"a term with the input {' and '.join(inputs)}"
    names = sorted(s.name for s in term.free_symbols if s != t)
    return "a weight term (with g)" if "g" in names else f"a static term (with {', '.join(names) or 'numbers only'})"
