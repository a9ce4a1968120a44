"""Judging equations of motion: proved equal to those of the system, or told apart term by term."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, ClassVar

import sympy as sm
from sympy.physics.vector import dynamicsymbols

from engdyn.algebra.expressions import as_expression
from engdyn.course.case import Case
from engdyn.course.equation_hints import explain, residuals, same_motion
from engdyn.course.formula import FormulaError
from engdyn.course.sameness import CLOSE, ENOUGH, TERMS, cost
from engdyn.course.verdict import Verdict, not_yet, right
from engdyn.dimensions import DimensionMismatch, dimension_of, system_dimensions
from engdyn.modeling.equality import prove_equal
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
        equations = self._read(answer, case)
        given = self._model(equations, case)
        truth = self._truth(case)
        proof = prove_equal(given, truth)
        if proof:
            return right(self.remark)
        if (
            proof.verdict == "undecided"
        ):  # functions or roots beyond the algebra: agreement to 45 digits decides
            if same_motion(given, truth, case, states=ENOUGH, tolerance=CLOSE):
                return right(self.remark)
            return not_yet(
                "This form cannot be compared. Write the equations with sines, cosines and roots only."
            )
        for wrong, hint in self.mistakes(case).items():
            if same_motion(given, self._model(wrong, case), case):
                return not_yet(hint)
        try:
            known = system_dimensions(case.system)
            for equation in equations:
                dimension_of(equation, known)
        except DimensionMismatch as error:
            return not_yet(f"Check the units: {error}.")
        return not_yet(explain(given, truth, proof, case))

    def _truth(self, case: Case) -> EquationsOfMotion:
        """The system's own equations, drive angles in place."""
        return self._model(self.solution(case), case) if _drives(case) else case.system.equations

    def _read(self, answer: Any, case: Case) -> tuple[sm.Expr, ...]:
        """Residuals from equations of motion, one equation or a list of them."""
        if isinstance(answer, EquationsOfMotion):
            return tuple(map(case.notation.residual, residuals(answer)))
        if isinstance(answer, sm.MatrixBase):
            answer = answer.flat()
        elif isinstance(answer, str | sm.Basic) or not isinstance(answer, Iterable):
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
                raise FormulaError(
                    "These equations are too large to be checked. Bring them into a shorter form."
                )
            in_place = [e.xreplace(_drives(case)) for e in equations]
            _check_accelerations(in_place, case)
            model = EquationsOfMotion.from_residuals(in_place, [c.symbol for c in case.system.coordinates])
            if len(self._models) > 50:
                self._models.clear()
            self._models[key] = model
        return self._models[key]


def _drives(case: Case) -> dict[sm.Expr, sm.Expr]:
    """Drive angles and their derivatives → what they are where nothing else is given."""
    t = dynamicsymbols._t
    found = {}
    for given in case.system.inputs:
        if given.default is not None:
            for order, part in enumerate(given.default):
                symbol = given.symbol.diff(t, order) if order else given.symbol
                found[symbol] = as_expression(part)
    return found


def _counted(number: int) -> str:
    return "one equation" if number == 1 else f"{number} equations, one for each coordinate"


def _check_accelerations(equations: Sequence[sm.Expr], case: Case) -> None:
    t = dynamicsymbols._t
    for coordinate in case.system.coordinates:
        if not any(e.has(coordinate.symbol.diff(t, 2)) for e in equations):
            raise FormulaError(
                f"No equation contains the acceleration {coordinate.name}_dd. Give the equations of "
                f"motion, not those of "
                "the equilibrium."
            )
