"""Simulation: equations of motion, a start, times, and what acts on the system.  Course sections 8.7 to 8.9."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Iterator, Mapping
from typing import Any

import numpy as np
import sympy as sm

from engdyn.analysis.events import Event, Watch, checked_events
from engdyn.analysis.inputs import Plan, plan_inputs
from engdyn.analysis.observation import Observer
from engdyn.analysis.steps import METHODS, Portion, Steps, compiled_steps, interpolated, scipy_steps
from engdyn.analysis.time_history import TimeHistory
from engdyn.errors import EngdynError, EngdynWarning
from engdyn.modeling.equations import EquationsOfMotion
from engdyn.progress import Progress

__all__ = ["checked_question", "simulate"]

MOST_STEPS = 3_000_000
"""All steps are kept, for outputs, events and energies at any time: a gigabyte for three coordinates."""


def simulate(
    eom: EquationsOfMotion,
    initial: tuple[Any, Any],
    times: Any,
    values: Mapping[str, float],
    inputs: Mapping[str, Any] | None = None,
    method: str = "dop853",
    rtol: float = 1e-8,
    atol: float = 1e-10,
    events: Any = (),
    *,
    max_step: float = np.inf,
) -> TimeHistory:
    """Integrate equations of motion over time.

    Parameters
    ----------
    eom : EquationsOfMotion
    initial : (q, u)
        Coordinates, shape (n,), and speeds, shape (m,), at ``times[0]``; a nonholonomic system has m < n.
    times : array_like, shape (N,)
        When the motion is wanted [s], rising; the steps do not depend on it.
    values : mapping of str to float
        Parameters by name [SI].
    inputs : mapping, optional
        Input name → a number; an expression in t and parameters (its derivatives are exact); a function of t;
        an array on `times` [SI], or a Record, which says its own unit. A motion that acts by its rate and
        acceleration, too, is given as (value, rate, acceleration), each a number, expression or function; or as
        one expression, one array or one Record. Between samples a force is linear and a motion a spline of degree
        five. What is not given takes its default, or is zero.
    method : {"dop853", "radau", "bdf", "lsoda"}
        Explicit Runge–Kutta of order 8 (5, 3), in machine code where numba is and no input is a function of
        Python; or one of scipy's solvers for stiff equations.
    rtol, atol : float
        Each step has an error below atol + rtol·|x|. The error of the result is another one: compare two tolerances.
    events : Event, expression, function, or a sequence of these
        Found as roots on the interpolated motion, see :class:`engdyn.Event`.
    max_step : float
        Longest step [s]. Inputs are searched for jumps and for pulses after a rest, where steps begin anew;
        pulses shorter than 1/2000 of the whole time are found if `max_step` is not longer than they are.

    Returns
    -------
    TimeHistory

    Raises
    ------
    EngdynError
        What is given does not fit; no step can be made any more: a motion that runs away, equations without
        a finite value, with the time and the state.

    Warns
    -----
    EngdynWarning
        The run was interrupted from the keyboard: what was computed is returned.

    Notes
    -----
    Course chapter 8. Equal calls give equal numbers, to the last bit.

    Examples
    --------
    >>> import engdyn as ed, numpy as np
    >>> crane = ed.systems.load("S07")
    >>> history = crane.simulate(([0, 0.5], [0, 0]), np.linspace(0, 5, 101))
    >>> history
    TimeHistory(x, theta; 0 to 5 s, 101 times)
    >>> round(float(history["theta"][-1]), 5)
    -0.09738
    """
    times, x0 = checked_question(eom, initial, times, rtol, atol, max_step)
    _check_single(x0, method)
    plan = plan_inputs(eom, inputs, values, times, max_step)
    watch = _watch(plan, checked_events(events))
    run = Steps(plan, x0, float(rtol), float(atol), float(max_step))
    with np.errstate(all="ignore"):  # steps that lead nowhere are tried again, shorter
        source = compiled_steps(run) if method == "dop853" else None
        portions, end = _collected(source or scipy_steps(run, method), watch, times)
    dense, n = interpolated(portions), len(eom.coordinates)
    if end is not None and end < times[-1]:
        times = np.append(times[times < end], end)
    states = dense(times).T
    ends = np.concatenate([portions[0].times[:1], *(p.times[1:] for p in portions)])
    return TimeHistory(
        time=times,
        q=states[:, :n],
        u=states[:, n:],
        events=watch.occurrences(dense, n),
        values=dict(zip([s.name for s in plan.symbols], plan.numbers, strict=False)),
        method=method,
        steps=ends if end is None else np.append(ends[ends < end], end),
        evaluations=run.evaluations,
        rejected=run.rejected,
        plan=plan,
        dense=dense,
    )


def _check_single(x0: np.ndarray, method: str) -> None:
    if x0.ndim > 1:
        raise EngdynError(f"initial holds {x0.shape[:-1]} states: simulate takes one, ensemble takes many")
    if method not in METHODS:
        raise EngdynError(f"unknown method {method!r}: choose one of {', '.join(METHODS)}")


def checked_question(
    eom: EquationsOfMotion, initial: Any, times: Any, rtol: float, atol: float, max_step: float
) -> tuple[np.ndarray, np.ndarray]:
    """Times, and initial states as x = (q, u) in the last axis."""
    if not isinstance(eom, EquationsOfMotion):
        raise EngdynError(f"eom is {eom!r}: give EquationsOfMotion, such as the equations of a system")
    try:
        q, u = (np.asarray(part, dtype=float) for part in initial)
        times = np.asarray(times, dtype=float)
    except (TypeError, ValueError, OverflowError) as error:
        raise EngdynError("initial must be a pair (q, u) of arrays of numbers, times an array") from error
    for name, part, symbols in (("q", q, eom.coordinates), ("u", u, eom.speeds)):
        if part.shape[-1:] != (len(symbols),):
            raise EngdynError(
                f"the initial {name} has shape {part.shape}: give {len(symbols)}, the values of "
                + ", ".join(str(s).replace("(t)", "") for s in symbols)
            )
        if not np.isfinite(part).all():
            raise EngdynError(f"the initial {name} is {part.tolist()}: give finite numbers")
    if times.ndim != 1 or len(times) < 2 or not np.isfinite(times).all() or not np.all(np.diff(times) > 0):
        raise EngdynError("times must hold two or more finite numbers [s], each larger than the one before")
    if not (3e-14 <= rtol < 1 and 0 <= atol < np.inf and max_step > 0):
        raise EngdynError(
            f"rtol = {rtol}, atol = {atol}, max_step = {max_step}: rtol must lie between 3e-14 and 1, atol must not be "
            "negative, max_step must be positive"
        )
    shape = np.broadcast_shapes(q.shape[:-1], u.shape[:-1])
    return times, np.concatenate(
        [np.broadcast_to(part, (*shape, part.shape[-1])) for part in (q, u)], axis=-1
    )


def _watch(plan: Plan, events: tuple[Event, ...]) -> Watch:
    """Events with functions of stacked times and states."""
    n, observe = len(plan.eom.coordinates), Observer(plan)

    def function(event: Event) -> Callable[[np.ndarray, np.ndarray], np.ndarray]:
        given = event.expression
        if isinstance(given, sm.Expr):
            return lambda at, states: observe(given, at, states)
        return lambda at, states: np.array(
            [given(t, x[:n], x[n:]) for t, x in zip(at, states.T, strict=True)]
        )

    return Watch(events, [function(event) for event in events])


def _collected(
    source: Iterator[Portion], watch: Watch, times: np.ndarray
) -> tuple[list[Portion], float | None]:
    """All steps, and where they end if that is before the last of the times."""
    portions: list[Portion] = []
    count, progress = 0, Progress("simulating")
    try:
        for portion in source:
            portions.append(portion)
            end = watch.look(portion.times, interpolated([portion])) if watch.events else None
            if end is not None:
                return portions, end
            count += len(portion.times) - 1
            progress.tell((portion.times[-1] - times[0]) / (times[-1] - times[0]))
            if count > MOST_STEPS:
                raise EngdynError(
                    f"{count} steps led to t = {portion.times[-1]:.6g} s only: take a looser tolerance or less time; "
                    'if nothing in the motion is that fast, the equations are stiff: method="radau"'
                )
    except KeyboardInterrupt:
        if not portions:
            raise
        end = float(portions[-1].times[-1])
        warnings.warn(
            EngdynWarning(f"interrupted: the history ends at t = {end:.6g} s instead of {times[-1]:.6g} s"),
            stacklevel=3,
        )
        return portions, end
    finally:
        progress.close()
    return portions, None
