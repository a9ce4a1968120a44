"""One student's case of an exercise: the system, that student's numbers and the symbols to answer in."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import cached_property, lru_cache
from typing import Any, Protocol

import sympy as sm

from engdyn.course.evaluation import NoValueError, evaluate, real
from engdyn.course.notation import Notation
from engdyn.course.sameness import Points
from engdyn.course.variants import course_code, draw_values, student_name
from engdyn.course.verdict import Verdict
from engdyn.errors import EngdynError
from engdyn.system import System

__all__ = ["Case", "Question", "Setup"]


@dataclass(frozen=True, eq=False)
class Case:
    """A system with one student's parameter values.

    Attributes
    ----------
    system : System
    values : dict of str to float
        This student's parameters [SI].
    defaults : dict of str to float
        The parameters of someone who named no student.
    accepted : callable
        Whether a set of values belongs to the exercise.
    """

    system: System
    values: dict[str, float]
    defaults: dict[str, float]
    accepted: Callable[[dict[str, float]], bool]

    @cached_property
    def notation(self) -> Notation:
        """The symbols in which answers are written."""
        return Notation(self.system)

    @cached_property
    def points(self) -> Points:
        """Points at which expressions are compared."""
        return Points(self.system, self.values, self.accepted)

    def number(self, formula: str | sm.Expr) -> float:
        """Value of a formula in the parameters, at the values of this case.

        Raises
        ------
        EngdynError
            The formula cannot be read, contains more than parameters or has no real value there.
        """
        expr = self.notation.expression(formula)
        try:
            return float(
                evaluate(expr, {p.symbol: real(self.values[p.name]) for p in self.system.parameters})[0]
            )
        except NoValueError as error:
            raise EngdynError(f"the formula {expr} has no value at these parameters: {error}") from error

    def at(self, **changes: float) -> Case:
        """The same exercise with some values changed."""
        return Case(self.system, {**self.values, **changes}, self.defaults, self.accepted)


class Question(Protocol):
    """What an exercise asks for; one class per kind of answer."""

    @property
    def kind(self) -> str:
        """One of "expression", "equations", "number", "set", "choice"."""

    def solution(self, case: Case) -> Any:
        """A right answer, computed from the system."""

    def mistakes(self, case: Case) -> dict[Any, str]:
        """Known wrong answers and the hint that each deserves."""

    def judge(self, answer: Any, case: Case) -> Verdict:
        """The verdict on an answer; an EngdynError says why it cannot be read."""


@dataclass(frozen=True, eq=False)
class Setup:
    """What the parts of one exercise have in common: the system and how its numbers are drawn.

    Parameters
    ----------
    build : callable
        Returns the system.
    varied : sequence of str
        Parameters that differ from student to student.
    fixed : mapping of str to float
        Parameters that have another value than the system's default.
    accepted : callable
        Whether a set of values is clear-cut: no count of roots and no verdict would change if one of them
        changed by 2 %.
    """

    build: Callable[[], System]
    varied: tuple[str, ...] = ()
    fixed: Mapping[str, float] = field(default_factory=dict)
    accepted: Callable[[dict[str, float]], bool] = lambda values: True

    @cached_property
    def system(self) -> System:
        """The system, built once."""
        return self.build()

    def case(self, exercise: str, student: Any = None) -> Case:
        """The case of one student (None: the default values).

        Raises
        ------
        EngdynError
            A student id that is no text.
        """
        return _case(self, exercise, None if student is None else student_name(student), course_code())


@lru_cache(maxsize=512)
def _case(setup: Setup, exercise: str, student: str | None, course: str) -> Case:
    system = setup.system
    defaults = system.values(**setup.fixed)
    values = defaults
    if student is not None:
        values = draw_values(defaults, setup.varied, setup.accepted, exercise, student, course)
    return Case(system, values, defaults, setup.accepted)
