"""Events: the instants at which something happens, found as roots between the steps.  Course section 8.7."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import sympy as sm
from scipy.optimize import brentq

from engdyn.errors import EngdynError

__all__ = ["Event", "Occurrences", "Watch", "checked_events"]

LOOKS = 10
"""A step is looked at in so many places: an event that happens and is undone within one is not overlooked."""


@dataclass(frozen=True)
class Event:
    """Something that happens when an expression passes zero.

    Parameters
    ----------
    expression : sympy.Expr or callable
        In coordinates, rates, inputs, parameters and t; or ``g(t, q, u)`` with arrays q, u. What touches zero
        without passing it is not an event.
    direction : {0, 1, -1}
        Passing upward (1), downward (-1) or both ways.
    terminal : bool
        Whether the simulation ends there.
    name : str
        Default: the expression as text.
    """

    expression: Any
    direction: int = 0
    terminal: bool = False
    name: str = ""

    def __post_init__(self) -> None:
        if not (callable(self.expression) or isinstance(self.expression, sm.Expr)):
            raise EngdynError(
                f"the event {self.expression!r} is neither a sympy expression nor a function g(t, q, u)"
            )
        if self.direction not in (0, 1, -1):
            raise EngdynError(
                f"the direction of an event is {self.direction!r}: choose 1 (upward), -1 or 0 (both)"
            )
        if not self.name:
            plain = getattr(self.expression, "__name__", "") or str(self.expression)
            object.__setattr__(self, "name", plain.replace("(t)", ""))


@dataclass(frozen=True, eq=False)
class Occurrences:
    """When an event happened, and the states there.

    Attributes
    ----------
    name : str
    time : ndarray, shape (k,)
    q : ndarray, shape (k, n)
    u : ndarray, shape (k, m)
    """

    name: str
    time: np.ndarray
    q: np.ndarray
    u: np.ndarray

    def __repr__(self) -> str:
        times = ", ".join(f"{t:.5g}" for t in self.time[:5]) + (", …" if len(self.time) > 5 else "")
        return f"Occurrences({self.name}: {f'at {times} s' if times else 'never'})"


def checked_events(events: Any) -> tuple[Event, ...]:
    """Events as given: one or several, each an Event, an expression or a function."""
    given = [events] if isinstance(events, Event | sm.Basic) or callable(events) else list(events)
    return tuple(
        e
        if isinstance(e, Event)
        else Event(e, int(getattr(e, "direction", 0)), bool(getattr(e, "terminal", False)))
        for e in given
    )


class Watch:
    """Looks at every step whether one of the events happens in it.

    Parameters
    ----------
    events : sequence of Event
    functions : sequence of callable
        Value of each event at stacked times (k,) and states (n + m, k).
    """

    def __init__(self, events: Sequence[Event], functions: Sequence[Callable[..., np.ndarray]]):
        self.events, self._functions = events, functions
        self.found: list[list[float]] = [[] for _ in events]

    def look(self, times: np.ndarray, dense: Callable[[np.ndarray], np.ndarray]) -> float | None:
        """Note what happens between the given ends of steps; returns the time of the first terminal event.

        Parameters
        ----------
        times : ndarray
            Begin of the first step, then the end of each.
        dense : callable
            States at times within, shape (n + m, k).
        """
        parts = np.linspace(0.0, 1.0, LOOKS + 1)[:-1]
        at = np.append((times[:-1, None] + parts * np.diff(times)[:, None]).ravel(), times[-1])
        states = dense(at)
        ends = []
        for event, function, found in zip(self.events, self._functions, self.found, strict=True):
            values = np.asarray(function(at, states), dtype=float)
            crossing = (values[:-1] * values[1:] < 0) | ((values[1:] == 0) & (values[:-1] != 0))
            rising = values[1:] > values[:-1]
            for i in np.flatnonzero(
                crossing & (rising | (event.direction <= 0)) & (~rising | (event.direction >= 0))
            ):
                found.append(self._root(function, dense, at[i], at[i + 1]))
                if event.terminal:
                    ends.append(found[-1])
                    break
        if not ends:
            return None
        for found in self.found:  # what would have happened after the end does not
            found[:] = [t for t in found if t <= min(ends)]
        return min(ends)

    @staticmethod
    def _root(
        function: Callable[..., np.ndarray], dense: Callable[..., np.ndarray], a: float, b: float
    ) -> float:
        def g(t: float) -> float:
            return float(function(np.array([t]), dense(np.array([t])))[0])

        return b if g(b) == 0.0 else float(brentq(g, a, b, xtol=1e-15 * max(1.0, abs(b)), rtol=1e-14))

    def occurrences(self, dense: Callable[[np.ndarray], np.ndarray], n: int) -> tuple[Occurrences, ...]:
        """What has happened, with the states."""
        result = []
        for event, found in zip(self.events, self.found, strict=True):
            times = np.array(found)
            states = dense(times).T if len(times) else np.empty((0, n))
            result.append(Occurrences(event.name, times, states[:, :n], states[:, n:]))
        return tuple(result)
