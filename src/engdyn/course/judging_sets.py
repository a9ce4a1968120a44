"""Judging a set of roots: in any order, angles modulo a turn, each root once."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

from engdyn.course.case import Case
from engdyn.course.formula import FormulaError
from engdyn.course.judging_numbers import TOLERANCES, read_number
from engdyn.course.verdict import Verdict, not_yet, right

__all__ = ["RootSet"]

#: More roots than this are not compared.
MOST = 64


@dataclass(frozen=True, eq=False)
class RootSet:
    """A question whose answer is a list of all roots.

    Parameters
    ----------
    truth : callable
        Computes the roots [SI] from a case's system and values.
    unit : str
        SI unit of a root.
    wrong : sequence of (callable, str)
        Known mistakes: functions of the case and the right roots that return wrong roots, and their hints.
    noun : str
        What a root is: "angle", "position".
    periodic : bool
        Whether roots that differ by a full turn are the same.
    region : (callable) or None
        Returns the (lower, upper) ends of the region asked for.
    tolerance : {"hand", "code"}
        Error that is forgiven, as a share of `scale`.
    scale : callable or None
        Returns what the error is measured by; 1 rad for angles, else the largest root.
    remark : str
        What to say to a right answer.
    """

    truth: Callable[[Case], Sequence[float]]
    unit: str
    wrong: Sequence[tuple[Callable[[Case, list[float]], Sequence[float]], str]] = ()
    noun: str = "angle"
    periodic: bool = True
    region: Callable[[Case], tuple[float, float]] | None = None
    tolerance: str = "hand"
    scale: Callable[[Case], float] | None = None
    remark: str = ""

    kind: ClassVar[str] = "set"

    def solution(self, case: Case) -> tuple[float, ...]:
        """All roots [SI], sorted, computed from the system; angles in (−π, π], each once."""
        found: list[float] = []
        for root in map(float, self.truth(case)):
            if self.periodic and root <= -math.pi + 1e-9:
                root += 2 * math.pi
            if not any(self._apart(root, other) < 1e-9 for other in found):
                found.append(root)
        return tuple(sorted(found))

    def mistakes(self, case: Case) -> dict[tuple[float, ...], str]:
        """Wrong sets of roots at these values, as sorted tuples, and their hints."""
        return self._mistakes(case, list(self.solution(case)))

    def _mistakes(self, case: Case, roots: list[float]) -> dict[tuple[float, ...], str]:
        return {tuple(sorted(float(x) for x in wrong(case, roots))): hint for wrong, hint in self.wrong}

    def judge(self, answer: Any, case: Case) -> Verdict:
        """The verdict; an EngdynError says why an answer cannot be read."""
        given, truth = self._read(answer, case), list(self.solution(case))
        near = self._tolerance(case, truth)
        if self._matches(given, truth, near):
            return right(self.remark)
        for wrong, hint in self._mistakes(case, truth).items():
            if self._matches(given, list(wrong), near):
                return not_yet(hint)
        return not_yet(self._statement(given, truth, near, case))

    def _read(self, answer: Any, case: Case) -> list[float]:
        if isinstance(answer, str):
            answer = answer.strip().strip("[](){}").split(",")
        elif not hasattr(answer, "__iter__"):
            answer = [answer]
        found: list[float] = []
        for item in answer:
            if len(found) == MOST:
                raise FormulaError(f"These are more than {MOST} roots. List each root once.")
            q = getattr(item, "q", None)  # an Equilibrium of a system with one coordinate
            found.append(read_number(item if q is None else q, self.unit, case))
        if not found:
            raise FormulaError(f"The list is empty. There is at least one {self.noun}.")
        return found

    def _tolerance(self, case: Case, truth: list[float]) -> float:
        if self.scale is not None:
            return TOLERANCES[self.tolerance] * self.scale(case)
        return TOLERANCES[self.tolerance] * (1.0 if self.periodic else max(map(abs, truth)))

    def _apart(self, a: float, b: float) -> float:
        difference = abs(a - b)
        if self.periodic:
            difference = math.fmod(difference, 2 * math.pi)
            difference = min(difference, 2 * math.pi - difference)
        return difference

    def _matches(self, given: list[float], wanted: list[float], near: float) -> bool:
        """Whether two lists hold the same roots, each as often."""
        left = list(wanted)
        for x in given:
            best = min(left, key=lambda root: self._apart(x, root), default=None)
            if best is None or self._apart(x, best) > near:
                return False
            left.remove(best)
        return not left

    def _is_root(self, x: float, truth: list[float], near: float) -> bool:
        return any(self._apart(x, root) <= near for root in truth)

    def _statement(self, given: list[float], truth: list[float], near: float, case: Case) -> str:
        """The strongest true thing to say of a list that no known mistake explains."""
        if case.values != case.defaults and self._matches(
            given, list(self.solution(case.at(**case.defaults))), near
        ):
            return (
                "These are the roots for the default parameters. Use your own: engdyn.course.variant "
                "gives them."
            )
        if self.unit == "rad" and self._matches([math.radians(x) for x in given], truth, near):
            return "These are degrees. Give the angles in radians, or as text with a unit, such as '30 deg'."
        if not self.periodic and any(
            self._matches([x * 10.0**n for x in given], truth, near) for n in (-6, -3, -2, 2, 3)
        ):
            return f"All are off by the same power of ten. Give them in {self.unit}, or as text with a unit."
        if self._matches(given, truth, 20 * near):
            return "The count is right and all are close, but more digits are needed."
        if self._matches([-x for x in given], truth, near):
            return "All signs are wrong: check the positive direction."
        if self._repeated(given, near):
            modulo = " (angles that differ by a full turn are one)" if self.periodic else ""
            return f"One {self.noun} is listed twice{modulo}. List each once."
        outside = self._outside(given, case, near)
        if outside:
            return outside
        return self._count(given, truth, near)

    def _repeated(self, given: list[float], near: float) -> bool:
        return any(self._apart(x, y) <= near for i, x in enumerate(given) for y in given[:i])

    def _outside(self, given: list[float], case: Case, near: float) -> str:
        if self.region is None:
            return ""
        low, high = self.region(case)
        beyond = [x for x in given if not low - near <= x <= high + near]
        return (
            f"{_shown(beyond)} {'lies' if len(beyond) == 1 else 'lie'} outside the region asked for."
            if beyond
            else ""
        )

    def _count(self, given: list[float], truth: list[float], near: float) -> str:
        good = [x for x in given if self._is_root(x, truth, near)]
        bad = [x for x in given if not self._is_root(x, truth, near)]
        plural = f"{self.noun}s"
        if good and not bad:
            return f"Every {self.noun} that you give is right, but there are more. What was divided out?"
        if good and len(good) == len(truth):
            return f"All right {plural} are there, but {_shown(bad)} should not be: put it into the equation."
        if good:
            count = "as many as there are" if len(given) == len(truth) else "but their number is not right"
            return f"Right: {_shown(good)}. Wrong: {_shown(bad)}. You list {len(given)} {plural}, {count}."
        if len(given) == len(truth):
            return f"The number of {plural} is right, but none of the values. Put one into your equation."
        return (
            f"None of these {plural} is right, and there are "
            f"{'more' if len(given) < len(truth) else 'fewer'}."
        )


def _shown(numbers: list[float]) -> str:
    texts = [f"{x:.4g}" for x in numbers[:4]]
    return ", ".join(texts) + (", ..." if len(numbers) > 4 else "")
