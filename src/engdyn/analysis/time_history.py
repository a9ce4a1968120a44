"""TimeHistory: a simulated motion.  Course chapter 8."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
import sympy as sm

from engdyn.analysis.energy_audit import EnergyAudit, audited
from engdyn.analysis.events import Occurrences
from engdyn.analysis.inputs import Plan
from engdyn.analysis.observation import Observer
from engdyn.errors import EngdynError

if TYPE_CHECKING:
    import pandas as pd

    from engdyn.modeling.equations import EquationsOfMotion

__all__ = ["TimeHistory"]


@dataclass(frozen=True, eq=False, repr=False)
class TimeHistory:
    """A motion over time, as `simulate` returns it.

    ``history["theta"]`` is a coordinate, ``history["theta'"]`` its rate and ``history["theta''"]`` its
    acceleration; inputs have names, too. ``history.output(expression)`` is everything else.

    Attributes
    ----------
    time : ndarray, shape (N,)
        [s]; ends early where a terminal event or an interruption ended the simulation.
    q : ndarray, shape (N, n)
        Coordinates [m, rad].
    u : ndarray, shape (N, m)
        Speeds [m/s, rad/s].
    events : tuple of Occurrences
        For each event asked for, when it happened and the states there.
    values : dict
        Parameters by name [SI].
    method : str
    steps : ndarray
        Ends of the integrator's own steps [s]: they do not depend on the times asked for.
    evaluations, rejected : int
        Of the right-hand side; steps that had to be repeated.
    """

    time: np.ndarray
    q: np.ndarray
    u: np.ndarray
    events: tuple[Occurrences, ...]
    values: dict[str, float]
    method: str
    steps: np.ndarray
    evaluations: int
    rejected: int
    plan: Plan
    dense: Callable[[np.ndarray], np.ndarray]

    @property
    def eom(self) -> EquationsOfMotion:
        """The equations that were integrated."""
        return self.plan.eom

    @cached_property
    def _observe(self) -> Observer:
        return Observer(self.plan)

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the coordinates."""
        return tuple(q.func.__name__ for q in self.eom.coordinates)

    def __getitem__(self, name: str) -> np.ndarray:
        """A coordinate, a rate (one prime), an acceleration (two primes) or an input, shape (N,)."""
        if not isinstance(name, str):
            raise EngdynError(
                f'history[{name!r}]: give a name such as {self.names[0]!r} or "{self.names[0]}\'"'
            )
        if name in self.names:
            return self.q[:, self.names.index(name)]
        return self.output(self._observe.named(name))

    def __len__(self) -> int:
        return len(self.time)

    def output(self, expression: sm.Expr) -> np.ndarray:
        """An expression along the motion, shape (N,).

        Parameters
        ----------
        expression : sympy.Expr
            In coordinates, their rates and accelerations, inputs, parameters and t.

        Raises
        ------
        EngdynError
            Symbols that neither the equations nor the values know.
        """
        return self._observe(expression, self.time, np.hstack([self.q, self.u]).T)

    def at(self, times: Any) -> TimeHistory:
        """The same motion at other times, by the interpolation that belongs to the integrator.

        Parameters
        ----------
        times : array_like, shape (K,)
            Rising, within the time simulated [s].
        """
        try:
            times = np.atleast_1d(np.asarray(times, dtype=float))
        except (TypeError, ValueError, OverflowError) as error:
            raise EngdynError(f"times is {times!r}: give an array of numbers [s]") from error
        first, last = self.steps[[0, -1]]
        if times.ndim != 1 or not len(times) or not np.all((times >= first) & (times <= last)):
            raise EngdynError(
                f"times must lie between {first:.6g} and {last:.6g} s, where the motion is known"
            )
        states = self.dense(times).T
        n = self.q.shape[1]
        return replace(self, time=times, q=states[:, :n], u=states[:, n:])

    @cached_property
    def audit(self) -> EnergyAudit:
        """Balance of energy along the motion.

        Raises
        ------
        EngdynError
            The equations do not know their energies: those of ``engdyn.lagrange`` do.
        """
        if self.eom.energies is None:
            raise EngdynError(
                f"equations from {self.eom.origin} do not know their energies: simulate those of engdyn.lagrange, or "
                "use system.simulate"
            )
        return audited(self._observe, self.time, self.steps, self.dense)

    def to_dataframe(self) -> pd.DataFrame:
        """Coordinates, rates and inputs, one column each, over the time [s]."""
        import pandas as pd

        inputs = [w.func.__name__ for w in self.eom.inputs]
        columns = [*self.names, *(f"{name}'" for name in self.names), *inputs]
        return pd.DataFrame({name: self[name] for name in columns}, index=pd.Index(self.time, name="time"))

    def __repr__(self) -> str:
        span = f"{self.time[0]:.5g} to {self.time[-1]:.5g} s"
        return f"TimeHistory({', '.join(self.names)}; {span}, {len(self)} times)"

    def _repr_html_(self) -> str:
        rows = "".join(
            f"<tr><td><code>{name}</code></td>"
            + "".join(f"<td>{_digits(x)}</td>" for x in (c[0], c[-1], c.min(), c.max()))
            + "</tr>"
            for name, c in zip(self.names, self.q.T, strict=True)
        )
        happened = "".join(f"<br>{event!r}" for event in self.events)
        head = "".join(f"<th>{h}</th>" for h in ("", "start", "end", "smallest", "largest"))
        caption = f"t = {self.time[0]:.5g} to {self.time[-1]:.5g} s, {len(self)} times{happened}"
        return (
            f"<table><caption>{caption}</caption><thead><tr>{head}</tr></thead><tbody>{rows}</tbody></table>"
        )


def _digits(x: float) -> str:
    return f"{0.0 if abs(x) < 1e-9 else x:.4g}"
