"""Judging a choice: one of several statements, and the reason for it."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, ClassVar

from engdyn.course.case import Case
from engdyn.course.formula import FormulaError
from engdyn.course.verdict import Verdict, not_yet, right

__all__ = ["Choice"]


@dataclass(frozen=True, eq=False)
class Choice:
    """A question whose answer is a letter, or a letter and the number of its reason ("b2").

    Parameters
    ----------
    right_statement : str
        The letter of the statement that is true.
    statements : mapping of str to str
        Letter of each false statement → the hint that it deserves.
    right_reason : int or None
        The number of the reason that carries the true statement.
    reasons : mapping of int to str
        Number of each reason that does not carry it → the hint that it deserves.
    remark : str
        What to say to a right answer.
    """

    right_statement: str
    statements: Mapping[str, str]
    right_reason: int | None = None
    reasons: Mapping[int, str] = field(default_factory=dict)
    remark: str = ""

    kind: ClassVar[str] = "choice"

    def solution(self, case: Case) -> str:
        """The letter, with the number of the reason."""
        return f"{self.right_statement}{self.right_reason or ''}"

    def mistakes(self, case: Case) -> dict[str, str]:
        """False statements by letter, false reasons by letter and number, and their hints."""
        found = dict(self.statements)
        return found | {f"{self.right_statement}{number}": hint for number, hint in self.reasons.items()}

    def judge(self, answer: Any, case: Case) -> Verdict:
        """The verdict; an EngdynError says why an answer cannot be read."""
        letter, number = self._read(answer)
        if letter != self.right_statement:
            return not_yet(self.statements[letter])
        if number == self.right_reason:
            return right(self.remark)
        if number is None:
            return not_yet(
                "Add the number of the reason, as in 'a1': a statement without its reason may be a guess."
            )
        return not_yet(self.reasons[number])

    def _read(self, answer: Any) -> tuple[str, int | None]:
        letters = sorted({self.right_statement, *self.statements})
        numbers = sorted({*self.reasons, *([self.right_reason] if self.right_reason else [])})
        wanted = f"one of the letters {', '.join(letters)}"
        if numbers:
            wanted += f", followed by the number of a reason, {', '.join(map(str, numbers))}"
        if (
            isinstance(answer, list | tuple)
            and len(answer) == 2
            and all(isinstance(a, str | int) for a in answer)
        ):
            answer = "".join(
                a if isinstance(a, str) else f"{a:d}"
                for a in answer
                if not isinstance(a, int) or abs(a) < 100
            )
        if not isinstance(answer, str) or len(answer) > 20:
            raise FormulaError(f"Answer with text: {wanted}.")
        match = re.fullmatch(r"([a-z])(\d?)", re.sub(r"[\s().,]", "", answer).lower(), re.ASCII)
        if match is None or match[1] not in letters or (match[2] and int(match[2]) not in numbers):
            raise FormulaError(f"Answer with {wanted}.")
        return match[1], int(match[2]) if match[2] else None
