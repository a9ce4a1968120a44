"""Checking an answer: always a verdict, never an error, whatever the answer is."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from engdyn.course.registry import exercise
from engdyn.course.verdict import Verdict, not_yet, unanswered
from engdyn.errors import EngdynError

__all__ = ["check", "is_unanswered"]

#: Longest hint that is shown.
HINT = 600


def check(id: str, answer: Any, student: Any = None) -> Verdict:
    """Whether an answer is right, and where not, what to look at next.

    Parameters
    ----------
    id : str
        Exercise, such as "4.3" or "4.3b".
    answer : object
        What the exercise asks for: an expression or equations (text or sympy), a number (with its unit as
        text, "44.3 deg", or in SI units), a list of roots, the letter of a choice. ``...`` is no answer yet.
    student : str, optional
        Student id; the default parameter values where not given.

    Returns
    -------
    Verdict
        Truthy only when the answer is right. A wrong answer, whatever its type, never raises an error.

    Raises
    ------
    EngdynError
        Unknown exercise, or a student id that is no text.

    Examples
    --------
    >>> import engdyn as ed
    >>> ed.course.check("4.3b", "sqrt((m + M_c)*g/(m*l))").right
    True
    """
    item = exercise(id)
    case = item.case(student)
    try:
        verdict = unanswered() if is_unanswered(answer) else item.question.judge(answer, case)
    except EngdynError as error:
        verdict = not_yet(_sentence(error))
    except Exception as error:  # whatever an odd object does when it is looked at
        verdict = not_yet(
            f"This answer cannot be read ({type(error).__name__}). Look again at what the exercise asks for."
        )
    hint = verdict.hint if len(verdict.hint) <= HINT else f"{verdict.hint[: HINT - 3]}..."
    return replace(verdict, hint=hint, exercise=item.id)


def is_unanswered(answer: Any) -> bool:
    """Whether an answer still is, or still contains, the three dots."""
    if isinstance(answer, list | tuple | set | frozenset):
        return any(item is Ellipsis for item in answer)
    return answer is Ellipsis


def _sentence(error: EngdynError) -> str:
    text = str(error).strip()
    text = text[:1].upper() + text[1:]
    return text if text.endswith((".", "!", "?")) else f"{text}."
