"""All exercises of the course: what they ask, their truth and their known mistakes.

The exercises of chapter N are the ``EXERCISES`` of ``engdyn.course.bank.chNN``. To write one, make a `Setup`
(the system, which parameters vary, which values make a clear-cut exercise) and a question: `Expression`,
`Equations`, `Number`, `RootSet` or `Choice` of the ``judging_`` modules. Its truth is a function that derives
the answer from the system; its known mistakes are formulas with the hint that each deserves. Parts of one
exercise (4.3, 4.3b, 4.3c) share one `Setup`.
"""

from __future__ import annotations

import difflib
import re
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cache
from importlib import import_module, resources
from typing import Any

from engdyn.course.case import Case, Question, Setup
from engdyn.errors import EngdynError
from engdyn.system import System

__all__ = ["Exercise", "exercise", "exercises", "variant"]

_ID = re.compile(r"([1-9A-D])\.([1-9][0-9]?)([b-z]?)")


@dataclass(frozen=True, eq=False)
class Exercise:
    """One exercise, or one part of it.

    Parts are numbered ``"4.3"``, ``"4.3b"``, ``"4.3c"``; they share the system and every student's numbers.

    Attributes
    ----------
    id : str
    systems : tuple of str
        Systems of the catalogue that it is about ("S03"); empty for a system of its own.
    prompt_title : str
    needs : str
        Section of the course that it needs.
    minutes : int
        Time that a student needs.
    difficulty : int
        1 (apply), 2 (combine) or 3 (think).
    setup : Setup
        The system, and how a student's numbers are drawn.
    question : Question
        What is asked, its truth and its known mistakes.
    """

    id: str
    systems: tuple[str, ...]
    prompt_title: str
    needs: str
    minutes: int
    difficulty: int
    setup: Setup
    question: Question

    @property
    def chapter(self) -> int | str:
        """Chapter (4) or appendix ("B")."""
        name = self.id.split(".")[0]
        return int(name) if name.isdigit() else name

    @property
    def number(self) -> str:
        """The id without the letter of the part."""
        return self.id.rstrip("bcdefghijklmnopqrstuvwxyz")

    @property
    def kind(self) -> str:
        """One of "expression", "equations", "number", "set", "choice"."""
        return self.question.kind

    @property
    def system(self) -> System:
        """The system that the exercise is about."""
        return self.setup.system

    def case(self, student: Any = None) -> Case:
        """The system with the numbers of a student."""
        return self.setup.case(self.number, student)

    def solution(self, student: Any = None) -> Any:
        """A right answer, computed now from the system.

        Parameters
        ----------
        student : str, optional
            Student id; the default values where not given.
        """
        return self.question.solution(self.case(student))

    def mistakes(self, student: Any = None) -> dict[Any, str]:
        """Known wrong answers, at this student's numbers, and the hint that each deserves.

        Sets of roots and sets of equations are given as tuples, so that all answers can be keys.
        """
        return self.question.mistakes(self.case(student))

    def __repr__(self) -> str:
        about = f" ({', '.join(self.systems)})" if self.systems else ""
        return f"Exercise {self.id}: {self.prompt_title}{about}, {self.kind}, {self.minutes} min"


@cache
def _bank() -> dict[str, Exercise]:
    """All exercises by id, in the order of the course."""
    modules = sorted(
        entry.name[:-3]
        for entry in resources.files("engdyn.course.bank").iterdir()
        if re.fullmatch(r"ch[0-9A-Z]+\.py", entry.name)
    )
    found: list[Exercise] = []
    for module in modules:
        found += import_module(f"engdyn.course.bank.{module}").EXERCISES
    return _ordered(found)


def _ordered(found: Iterable[Exercise]) -> dict[str, Exercise]:
    """Exercises by id, sorted; refuses ids that are malformed or used twice."""
    by_id: dict[str, Exercise] = {}
    for item in found:
        if not _ID.fullmatch(item.id) or item.id in by_id:
            raise EngdynError(
                f"the exercise id {item.id!r} is malformed or used twice: write 4.3, 4.3b, 4.3c"
            )
        by_id[item.id] = item
    return {name: by_id[name] for name in sorted(by_id, key=_order)}


def _order(name: str) -> tuple[str, int, str]:
    chapter, number, part = _ID.fullmatch(name).groups()  # type: ignore[union-attr]
    return chapter, int(number), part


def exercises() -> list[Exercise]:
    """All exercises of the course, in its order.

    Examples
    --------
    >>> from engdyn.course.registry import exercises
    >>> [item.id for item in exercises() if item.id.startswith("4.3")]
    ['4.3', '4.3b', '4.3c']
    """
    return list(_bank().values())


def exercise(id: str) -> Exercise:
    """The exercise of that id.

    Raises
    ------
    EngdynError
        There is none; the message names the nearest.
    """
    bank = _bank()
    if isinstance(id, str) and id.strip() in bank:
        return bank[id.strip()]
    if not isinstance(id, str):
        kind = type(id).__name__
        raise EngdynError(f"an exercise id is text such as '4.3' (4.1 and 4.10 are one number), not a {kind}")
    near = difflib.get_close_matches(id.strip()[:40], bank, n=1, cutoff=0.0)
    raise EngdynError(
        f"there is no exercise {id[:40]!r}; the nearest is {near[0]!r}. engdyn.course.exercises() lists all"
        if near
        else f"there is no exercise {id[:40]!r}: the bank is empty"
    )


def variant(id: str, student: Any = None) -> dict[str, float]:
    """The parameter values of one student for an exercise.

    Parameters
    ----------
    id : str
        Such as "4.3"; all parts of an exercise have the same values.
    student : str, optional
        Student id; the default values where not given.

    Returns
    -------
    dict of str to float
        All parameters of the exercise's system [SI]: those that vary lie within ±20 % of their default
        and have 3 significant digits.

    Notes
    -----
    A stable function of course code, exercise and student: see `engdyn.course.variants`.
    """
    return dict(exercise(id).case(student).values)
