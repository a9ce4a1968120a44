"""Judging equations of motion: proved equal to those of the system, or told apart term by term."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, ClassVar

import sympy as sm
from sympy.physics.vector import dynamicsymbols

from engdyn.course.case import Case
from engdyn.course.formula import FormulaError
from engdyn.course.sameness import TERMS, cost
from engdyn.course.verdict import Verdict, not_yet, right
from engdyn.modeling.differences import Difference
from engdyn.modeling.equality import Proof, prove_equal
from engdyn.modeling.equations import EquationsOfMotion

__all__ = ["Equations"]


@dataclass(frozen=True, eq=False)
class Equations:
    """A question whose answer is a set of equations of motion, in any order and with any factor.

    Parameters
    ----------
    wrong : sequence of (sequence of str, str)
        Known mistakes as residuals in the system's symbols, and the hint that each deserves.
    remark : str
        What to say to a right answer.
    """

    wrong: Sequence[tuple[Sequence[str], str]] = ()
    remark: str = ""

    kind: ClassVar[str] = "equations"

    @cached_property
    def _models(self) -> dict[Any, EquationsOfMotion]:
        return {}

    def solution(self, case: Case) -> tuple[sm.Expr, ...]:
        """Residuals of the system's own equations."""
        return residuals(case.system.equations)

    def mistakes(self, case: Case) -> dict[tuple[sm.Expr, ...], str]:
        """Wrong residuals and their hints."""
        return {tuple(map(case.notation.residual, texts)): hint for texts, hint in self.wrong}

    def judge(self, answer: Any, case: Case) -> Verdict:
        """The verdict; an EngdynError says why an answer cannot be read."""
        given = self._model(self._read(answer, case), case)
        proof = prove_equal(given, self._model(self.solution(case), case))
        if proof:
            return right(self.remark)
        if proof.verdict == "undecided":
            return not_yet("This form cannot be compared. Write the equations with sines, cosines and roots only.")
        for wrong, hint in self.mistakes(case).items():
            if prove_equal(given, self._model(wrong, case)):
                return not_yet(hint)
        return not_yet(in_words(self._clearest(proof, given, case), case))

    def _read(self, answer: Any, case: Case) -> tuple[sm.Expr, ...]:
        """Residuals from equations of motion, one equation or a list of them."""
        if isinstance(answer, EquationsOfMotion):
            return tuple(map(case.notation.residual, residuals(answer)))
        if isinstance(answer, str | sm.Basic) or not isinstance(answer, Iterable):
            answer = [answer]
        expected = len(case.system.coordinates)
        found: list[sm.Expr] = []
        for equation in answer:
            if len(found) == expected:
                raise FormulaError(f"There are more equations than coordinates. Give {_counted(expected)}.")
            found.append(case.notation.residual(equation))
        if len(found) < expected:
            raise FormulaError(f"There are fewer equations than coordinates. Give {_counted(expected)}.")
        return tuple(found)

    def _model(self, equations: tuple[sm.Expr, ...], case: Case) -> EquationsOfMotion:
        """Residuals as equations of motion, drive angles in place; what was built once is kept."""
        key = (case.system, equations)
        if key not in self._models:
            if sum(map(cost, equations)) > 4 * TERMS:
                raise FormulaError("These equations are too large to be checked. Bring them into a shorter form.")
            in_place = [e.xreplace(_drives(case)) for e in equations]
            model = EquationsOfMotion.from_residuals(in_place, [c.symbol for c in case.system.coordinates])
            if len(self._models) > 50:
                self._models.clear()
            self._models[key] = model
        return self._models[key]

    def _clearest(self, proof: Proof, given: EquationsOfMotion, case: Case) -> Sequence[Difference]:
        """The differences, taken after scaling a single equation by its inertia if they are fewer then."""
        if len(case.system.coordinates) != 1:
            return proof.differences
        truth = self._model(self.solution(case), case)
        scale = truth.mass_matrix[0] / given.mass_matrix[0]
        scaled = (sm.Mul(scale, residuals(given)[0]),)
        if cost(scaled[0]) > TERMS:
            return proof.differences
        other = prove_equal(self._model(scaled, case), truth).differences
        return other if other and len(other) < len(proof.differences) else proof.differences


def residuals(eom: EquationsOfMotion) -> tuple[sm.Expr, ...]:
    """M u̇ − f of equations of motion, one expression per row."""
    t = dynamicsymbols._t
    udot = sm.Matrix([u.diff(t) for u in eom.speeds])
    return tuple(eom.mass_matrix * udot - eom.forcing)


def _drives(case: Case) -> dict[sm.Expr, sm.Expr]:
    """Drive angles and their derivatives → what they are where nothing else is given."""
    t = dynamicsymbols._t
    found = {}
    for given in case.system.inputs:
        if given.default is not None:
            for order, part in enumerate(given.default):
                symbol = given.symbol.diff(t, order) if order else given.symbol
                found[symbol] = sm.sympify(part)
    return found


def _counted(number: int) -> str:
    return "one equation" if number == 1 else f"{number} equations, one for each coordinate"


def in_words(differences: Sequence[Difference], case: Case) -> str:
    """What differs, in words that name the kind of a term but not the term that is missing."""
    if not differences:
        return "Your equations describe another motion: compare each term with the free bodies."
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
