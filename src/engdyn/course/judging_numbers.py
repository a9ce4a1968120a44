"""Judging a number, with its unit."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

from engdyn.course.case import Case
from engdyn.course.formula import FormulaError
from engdyn.course.statements import ratio_in_words
from engdyn.course.verdict import Verdict, not_yet, right
from engdyn.errors import EngdynError, ParameterError
from engdyn.units import to_si

__all__ = ["TOLERANCES", "Number", "read_number"]

#: Relative error that is forgiven: a result worked out by hand, or computed.
TOLERANCES = {"hand": 1e-3, "code": 1e-6}

_UNIT = r"[A-Za-zµμ°]+(?:(?:\^|\*\*)?-?\d)?"
_QUANTITY = re.compile(
    r"([+-]?(?:\d{1,30}\.?\d{0,30}|\.\d{1,30})(?:[eE][+-]?\d{1,3})?)"  # the number
    rf" *({_UNIT}(?: ?[ */·] ?{_UNIT}){{0,6}})?",
    re.ASCII,
)

Formula = str | Callable[[Case], float]


@dataclass(frozen=True, eq=False)
class Number:
    """A question whose answer is a number.

    Parameters
    ----------
    truth : callable
        Computes the number from a case's system and values.
    unit : str
        SI unit; a plain number is taken in it.
    wrong : sequence of (formula or callable, str)
        Known mistakes, as formulas in the parameters or functions of the case, and their hints.
    tolerance : {"hand", "code"}
        Relative error that is forgiven: 1e-3 or 1e-6.
    scale : float
        What the error is measured by where the truth is zero.
    remark : str
        What to say to a right answer.
    """

    truth: Callable[[Case], float]
    unit: str
    wrong: Sequence[tuple[Formula, str]] = ()
    tolerance: str = "hand"
    scale: float = 1.0
    remark: str = ""

    kind: ClassVar[str] = "number"

    def solution(self, case: Case) -> float:
        """The number [SI], computed from the system."""
        return float(self.truth(case))

    def mistakes(self, case: Case) -> dict[float, str]:
        """Wrong numbers [SI] at these values, and their hints."""
        return {
            case.number(formula) if isinstance(formula, str) else float(formula(case)): hint
            for formula, hint in self.wrong
        }

    def judge(self, answer: Any, case: Case) -> Verdict:
        """The verdict; an EngdynError says why an answer cannot be read."""
        given, truth = read_number(answer, self.unit, case), self.solution(case)
        if self._equal(given, truth):
            return right(self.remark)
        for wrong, hint in self.mistakes(case).items():
            if self._equal(given, wrong):
                return not_yet(hint)
        return not_yet(self._statement(given, truth, case))

    def _equal(self, a: float, b: float) -> bool:
        return abs(a - b) <= TOLERANCES[self.tolerance] * (abs(b) or self.scale)

    def _statement(self, given: float, truth: float, case: Case) -> str:
        """The strongest true thing to say of a number that no known mistake explains."""
        if case.values != case.defaults and self._equal(given, self.solution(case.at(**case.defaults))):
            return (
                "This is the result for the default parameters. Use your own: engdyn.course.variant "
                "gives them."
            )
        if case.values.get("g", 0.0) == 9.81 and self._equal(given, self.solution(case.at(g=10.0))):
            return "This is the result with g rounded to 10 m/s^2. Take g from the parameters."
        if truth == 0 or given == 0:
            return (
                "Your number is zero, the result is not."
                if given == 0
                else "Your number is too large: look for symmetry."
            )
        ratio = given / truth
        for simple in (
            1,
            2,
            0.5,
            math.pi / 180,
            180 / math.pi,
            2 * math.pi,
            0.5 / math.pi,
            30 / math.pi,
            math.pi / 30,
        ):
            for sign in (1, -1):
                if abs(ratio / (sign * simple) - 1) <= TOLERANCES[self.tolerance]:
                    return ratio_in_words(sign * simple, "number")
        return self._size(given, truth)

    def _size(self, given: float, truth: float) -> str:
        ratio = given / truth
        power = round(math.log10(abs(ratio)))
        if power and abs(abs(ratio) / 10.0**power - 1) <= TOLERANCES[self.tolerance]:
            return (
                f"Your number is off by a power of ten{', and its sign is wrong' if ratio < 0 else ''}: "
                f"check prefixes."
            )
        if ratio < 0:
            return "Your number has the wrong sign, and its magnitude is not right either."
        if abs(ratio - 1) < 0.02:
            share = f"{TOLERANCES[self.tolerance]:g}".replace("e-0", "e-")
            return (
                f"You are close, but the relative error must be below {share}. Keep more digits in "
                f"between; was "
                "something small neglected or an angle taken as small?"
            )
        return f"Your number is too {'large' if ratio > 1 else 'small'} in magnitude; its sign is right."


def read_number(answer: Any, unit: str, case: Case) -> float:
    """A number in an SI unit, from a number, text with a unit, or a formula in the parameters.

    Raises
    ------
    EngdynError
        What cannot be read, and why.
    """
    if isinstance(answer, str):
        return _from_text(answer.strip().replace("−", "-"), unit, case)
    if hasattr(answer, "to") and hasattr(answer, "magnitude"):
        return _finite(answer.to("dimensionless" if unit == "-" else unit).magnitude)
    if getattr(answer, "shape", None) == (1,) and hasattr(answer, "item"):
        answer = answer.item()
    return _finite(case.number(case.notation.expression(answer)))


def _from_text(text: str, unit: str, case: Case) -> float:
    if re.fullmatch(r"[+-]?\d{1,30},\d{1,30}( *\S{1,20})?", text):
        raise FormulaError("Write the number with a decimal point instead of a comma.")
    match = _QUANTITY.fullmatch(text) if len(text) <= 100 else None
    if match is None:
        return _finite(case.number(case.notation.expression(text)))
    number, own = match.groups()
    if own is None or not math.isfinite(float(number)):
        return _finite(number)
    try:
        return to_si(f"{number} {own}", unit, "your answer")
    except ParameterError as error:
        wanted = "no unit" if unit == "-" else f"a unit such as {unit}"
        raise EngdynError(f"{own!r} is not a unit of this answer: give a number with {wanted}.") from error


def _finite(value: Any) -> float:
    number = float(value)
    if not math.isfinite(number):
        raise FormulaError(f"Your answer is {number}, not a finite number.")
    return number
