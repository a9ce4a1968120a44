"""Judging one expression: a formula in the symbols of the exercise's system."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, ClassVar

import sympy as sm

from engdyn.course.case import Case
from engdyn.course.sameness import ROUNDED, agree, same
from engdyn.course.statements import strongest_statement
from engdyn.course.verdict import Verdict, not_yet, right
from engdyn.system import System

__all__ = ["Expression"]

#: Points at which a known mistake is recognized.
ENOUGH = 8


@dataclass(frozen=True, eq=False)
class Expression:
    """A question whose answer is one expression.

    Parameters
    ----------
    truth : callable
        Derives the expression from the system; called once.
    unit : str
        SI unit of the answer.
    wrong : sequence of (str, str)
        Formulas of known mistakes, in the system's symbols, and the hint that each deserves.
    of : sequence of str
        Coordinates, rates and inputs that the answer may contain besides parameters.
    also : sequence of str
        Further right answers, such as the form before an approximation.
    up_to_constant : bool
        For a potential energy: a term without coordinates does not matter.
    remark : str
        What to say to a right answer.
    """

    truth: Callable[[System], sm.Expr]
    unit: str
    wrong: Sequence[tuple[str, str]] = ()
    of: Sequence[str] = ()
    also: Sequence[str] = ()
    up_to_constant: bool = False
    remark: str = ""

    kind: ClassVar[str] = "expression"

    @cached_property
    def _derived(self) -> dict[System, sm.Expr]:
        return {}

    def solution(self, case: Case) -> sm.Expr:
        """The expression, derived from the system the first time."""
        if case.system not in self._derived:
            self._derived[case.system] = self.truth(case.system)
        return self._derived[case.system]

    def mistakes(self, case: Case) -> dict[sm.Expr, str]:
        """Wrong expressions and their hints."""
        return {case.notation.expression(formula): hint for formula, hint in self.wrong}

    def judge(self, answer: Any, case: Case) -> Verdict:
        """The verdict; an EngdynError says why an answer cannot be read."""
        given, truth = case.notation.expression(answer), self.solution(case)
        allowed = {p.name for p in case.system.parameters} | set(self.of)
        stray = [name for name in case.notation.symbols_in(given) if name not in allowed]
        if stray:
            wanted = "the parameters" + (f", {', '.join(self.of)}" if self.of else " alone")
            return not_yet(f"Your answer still contains {', '.join(stray)}. Express it by {wanted}.")
        if any(
            self._same(given, other, case) for other in (truth, *map(case.notation.expression, self.also))
        ):
            return right(self.remark)
        for wrong, hint in self.mistakes(case).items():
            if all(agree(x, y, case.points, ROUNDED, ENOUGH) for x, y in self._views(given, wrong, case)):
                return not_yet(hint)
        return not_yet(strongest_statement(given, truth, self.unit, case, self.up_to_constant))

    def _same(self, given: sm.Expr, truth: sm.Expr, case: Case) -> bool:
        return all(same(x, y, case.points) for x, y in self._views(given, truth, case))

    def _views(self, a: sm.Expr, b: sm.Expr, case: Case) -> list[tuple[sm.Expr, sm.Expr]]:
        """What has to agree: the expressions, or their slopes where a constant does not matter."""
        if not self.up_to_constant:
            return [(a, b)]
        symbols = [c.symbol for c in case.system.coordinates]
        return [(a.diff(q), b.diff(q)) for q in symbols]
