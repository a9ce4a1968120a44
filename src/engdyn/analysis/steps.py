"""The steps of a simulation, one portion after the other: in machine code, or by scipy's solvers.  Section 8.9.

Both give portions of steps with an interpolation between them, so that outputs, events and energies never
depend on how the steps were made.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
import scipy.integrate
from scipy.integrate import OdeSolution

from engdyn.algebra.codegen import has_numba
from engdyn.analysis.inputs import Plan
from engdyn.errors import EngdynError
from engdyn.modeling.derivative import Derivative

__all__ = ["METHODS", "Portion", "Steps", "compiled_steps", "interpolated", "scipy_steps"]

METHODS = {"dop853": "DOP853", "radau": "Radau", "bdf": "BDF", "lsoda": "LSODA"}
"""Names of our methods and of scipy's; all but the first are for stiff equations."""

PORTION = 1_000
"""Steps in machine code between two looks at the clock."""


@dataclass
class Portion:
    """Some steps: the times at which they begin and end, and how states between are interpolated.

    Of DOP853 `tables` holds begins and ends (k, 2), states (k, n) and coefficients (k, 7, n), as
    :func:`engdyn.analysis.dop853.advance` makes them; of other methods it holds scipy's interpolants.
    """

    times: np.ndarray
    tables: Any
    machine: bool = False


@dataclass
class Steps:
    """What is to be integrated, and how it goes.

    Attributes
    ----------
    plan : Plan
    x0 : ndarray
    rtol, atol, max_step : float
    evaluations, rejected : int
    """

    plan: Plan
    x0: np.ndarray
    rtol: float
    atol: float
    max_step: float
    evaluations: int = 0
    rejected: int = 0


def compiled_steps(run: Steps) -> Iterator[Portion] | None:
    """DOP853 in machine code; None where it cannot be had: without numba, or with functions of Python as inputs."""
    if run.plan.functions or not has_numba():
        return None
    from engdyn.analysis.dop853 import SIGNATURE

    code = run.plan.derivative.machine(SIGNATURE)
    return None if code is None else _compiled(run, code)


def _compiled(run: Steps, f: Any) -> Iterator[Portion]:
    from engdyn.analysis.dop853 import COLLAPSED, RUNNING, advance

    plan, x = run.plan, run.x0.copy()
    pieces, n = plan.pieces(), len(x)
    p = np.concatenate([plan.numbers, np.zeros(pieces.shape[1])])
    state = np.array([-1.0, plan.starts[0], 0.0, 0.0, 0.0, RUNNING])
    while state[5] == RUNNING:
        T, X, F = np.empty((PORTION, 2)), np.empty((PORTION, n)), np.empty((PORTION, 7, n))
        k = advance(f, p, pieces, plan.starts, plan.ends, state, x, run.rtol, run.atol, run.max_step, T, X, F)
        run.evaluations, run.rejected = int(state[3]), int(state[4])
        if k:
            yield Portion(np.append(T[:k, 0], T[k - 1, 1]), (T[:k], X[:k], F[:k]), True)
        if state[5] == COLLAPSED:
            raise _failure(state[1], x)


def scipy_steps(run: Steps, method: str) -> Iterator[Portion]:
    """One of scipy's solvers on generated Python code, segment by segment."""
    plan, x = run.plan, run.x0
    pieces, solver = plan.pieces(), getattr(scipy.integrate, METHODS[method])
    functions = [(plan.derivative.slots[key], g) for key, g in plan.functions.items()]
    for start, end, piece in zip(plan.starts, plan.ends, pieces, strict=True):
        if not end > start:
            continue
        derivative = _with_functions(plan.derivative, [*plan.numbers, *piece.tolist()], functions)
        if not np.isfinite(derivative(start, x)).all():
            raise _failure(start, x)
        try:
            steps = solver(derivative, start, x, end, rtol=run.rtol, atol=run.atol, max_step=run.max_step)
            steps.fun = _counted(steps, derivative)
            evaluations = run.evaluations
            while steps.status == "running":
                steps.step()
                run.evaluations = evaluations + steps.nfev
                stuck = (
                    method != "dop853"
                    and steps.status == "running"
                    and steps.t - steps.t_old < 10 * np.spacing(steps.t)
                )
                if stuck or steps.status == "failed":
                    raise _failure(steps.t, x)
                x, dense = steps.y, steps.dense_output()
                tables: Any = [dense]
                if method == "dop853":
                    tables = np.array([[dense.t_old, dense.t]]), dense.y_old[None], dense.F[None]
                yield Portion(np.array([steps.t_old, steps.t]), tables)
            if not np.isfinite(x).all():
                raise _failure(steps.t, x)
        except EngdynError:
            raise
        except (ArithmeticError, ValueError) as error:  # of scipy, on numbers that are not finite
            raise _failure(steps.t, x) from error


def _counted(
    steps: Any, f: Callable[[float, np.ndarray], np.ndarray]
) -> Callable[[float, np.ndarray], np.ndarray]:
    """A right-hand side that counts, in place of scipy's, which checks its type in every call besides."""

    def counted(t: float, x: np.ndarray) -> np.ndarray:
        steps.nfev += 1
        return f(t, x)

    return counted


def _with_functions(
    code: Derivative, p: list[float], functions: list[tuple[int, Callable[[float], float]]]
) -> Callable[[float, np.ndarray], np.ndarray]:
    """The right-hand side for parameters p, those of them that are functions of Python brought up to date."""
    f = code.python(p)
    if not functions:
        return f

    def derivative(t: float, x: np.ndarray) -> np.ndarray:
        for slot, g in functions:
            p[slot] = float(g(t))
        return f(t, x)

    return derivative


def _failure(t: float, x: np.ndarray) -> EngdynError:
    """Why no step can be made: the motion runs away, or its equations have no value."""
    state = ", ".join(f"{value:.5g}" for value in x)
    why = (
        "the motion runs away"
        if np.max(np.abs(x)) > 1e6
        else "steps became too small (a singular mass matrix, a root or quotient without a value, a jump of a force "
        "with the state); look at the equations there"
    )
    return EngdynError(f"the simulation ends at t = {t:.6g} s with (q, u) = ({state}): {why}")


def interpolated(portions: list[Portion]) -> Callable[[np.ndarray], np.ndarray]:
    """States at any times within the steps, shape (n, k)."""
    if not isinstance(portions[0].tables, tuple):
        ends = np.concatenate([portions[0].times[:1], *(p.times[1:] for p in portions)])
        return OdeSolution(ends, [dense for p in portions for dense in p.tables])
    machine = portions[0].machine
    T, X, F = (np.concatenate(parts) for parts in zip(*(p.tables for p in portions), strict=True))

    def dense(at: np.ndarray) -> np.ndarray:
        if machine and len(at) and at[0] >= T[0, 0] and np.all(at[1:] >= at[:-1]):
            from engdyn.analysis.dop853 import between

            out = np.empty((len(at), X.shape[1]))
            if between(np.ascontiguousarray(at), 0, len(T), T, X, F, out) == len(at):
                return out.T
        i = np.clip(np.searchsorted(T[:, 0], at, "right") - 1, 0, len(T) - 1)
        s = (at - T[i, 0]) / (T[i, 1] - T[i, 0])
        weights = np.cumprod([s, 1.0 - s] * 3 + [s], axis=0)  # s, s (1 − s), s² (1 − s), …
        return X[i].T + np.einsum("rk,krn->nk", weights, F[i])

    return dense
