"""Many motions at once: other starts, other parameters.  Course section 8.9 and "going further"."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from engdyn.algebra.codegen import has_numba
from engdyn.analysis.inputs import Plan, plan_inputs
from engdyn.analysis.simulation import MOST_STEPS, checked_question, simulate
from engdyn.errors import EngdynError
from engdyn.modeling.equations import EquationsOfMotion

__all__ = ["Ensemble", "ensemble"]


@dataclass(frozen=True, eq=False, repr=False)
class Ensemble:
    """Motions of N members.

    Attributes
    ----------
    time : ndarray, shape (K,)
        [s].
    q : ndarray, shape (N, K, n)
    u : ndarray, shape (N, K, m)
    names : tuple of str
        Of the coordinates.
    """

    time: np.ndarray
    q: np.ndarray
    u: np.ndarray
    names: tuple[str, ...]

    def __len__(self) -> int:
        return len(self.q)

    def __getitem__(self, name: str) -> np.ndarray:
        """A coordinate of all members, shape (N, K)."""
        if name not in self.names:
            raise EngdynError(f"there is no coordinate {name!r}: choose one of {', '.join(self.names)}")
        return self.q[:, :, self.names.index(name)]

    def __repr__(self) -> str:
        return f"Ensemble({len(self)} motions of {', '.join(self.names)}; to {self.time[-1]:.5g} s)"


def ensemble(
    eom: EquationsOfMotion,
    initial: tuple[Any, Any],
    times: Any,
    values: Mapping[str, Any],
    inputs: Mapping[str, Any] | None = None,
    rtol: float = 1e-8,
    atol: float = 1e-10,
    *,
    max_step: float = np.inf,
) -> Ensemble:
    """Integrate many motions at once, on all cores where numba is.

    Parameters
    ----------
    eom, times, inputs, rtol, atol, max_step
        As for :func:`engdyn.simulate`; all members feel the same inputs.
    initial : (q, u)
        Shapes (N, n) and (N, m); what is the same for all needs one row only.
    values : mapping of str to float or array, shape (N,)
        Parameters by name [SI]; arrays hold one value for each member.

    Returns
    -------
    Ensemble

    Raises
    ------
    EngdynError
        As `simulate`, with the number of the member; numbers of members that do not agree.

    Examples
    --------
    >>> import engdyn as ed, numpy as np
    >>> pendulum = ed.systems.load("pendulum")
    >>> starts = np.linspace(0.1, 3.0, 5)[:, None]
    >>> ed.ensemble(pendulum.equations, (starts, [0.0]), [0.0, 1.0], pendulum.values())["theta"].shape
    (5, 2)
    """
    times, x0 = checked_question(eom, initial, times, rtol, atol, max_step)
    x0, members = _rows(x0, values)
    varied = {name for name, v in values.items() if np.ndim(v)}
    first = {name: float(v[0]) for name, v in members.items()}
    plan = plan_inputs(eom, inputs, first, times, max_step)
    names, n = tuple(q.func.__name__ for q in eom.coordinates), len(eom.coordinates)
    own = (
        any(s.name in varied for e in plan.formulas.values() for s in e.free_symbols) and len(plan.starts) > 1
    )
    code = None
    if not (plan.functions or own) and has_numba():
        from engdyn.analysis.dop853 import SIGNATURE

        code = plan.derivative.machine(SIGNATURE)
    if code is None:
        states = np.empty((len(x0), len(times), x0.shape[1]))
        for k, x in enumerate(x0):
            own_values = {name: float(v[k]) for name, v in members.items()}
            try:
                found = simulate(
                    eom, (x[:n], x[n:]), times, own_values, inputs, rtol=rtol, atol=atol, max_step=max_step
                )
            except EngdynError as error:
                raise EngdynError(f"member {k}: {error}") from error
            states[k] = np.hstack([found.q, found.u])
    else:
        states = _at_once(plan, code, x0, times, members, (float(rtol), float(atol), float(max_step)))
    return Ensemble(times, states[..., :n], states[..., n:], names)


def _rows(x0: np.ndarray, values: Mapping[str, Any]) -> tuple[np.ndarray, dict[str, np.ndarray]]:
    """One row of x0, and one value of every parameter, for each member."""
    try:
        values = {name: np.asarray(v, dtype=float) for name, v in values.items()}
    except (AttributeError, TypeError, ValueError, OverflowError) as error:
        raise EngdynError("values must map parameter names to numbers, or to arrays of numbers") from error
    sizes = {np.shape(v) for v in values.values() if np.ndim(v)} | {x0.shape[:-1]} - {(), (1,)}
    if len(sizes) > 1 or any(len(size) > 1 or 0 in size for size in sizes):
        raise EngdynError(f"initial and values hold {sorted(sizes)} members: give rows of one length")
    (count,) = next(iter(sizes), (1,))
    members = {name: np.broadcast_to(v, (count,)) for name, v in values.items()}
    return np.array(np.broadcast_to(x0, (count, x0.shape[-1]))), members


def _at_once(
    plan: Plan, code: Any, x0: np.ndarray, times: np.ndarray, members: Mapping[str, np.ndarray], limits: tuple
) -> np.ndarray:
    from engdyn.analysis.dop853 import DONE
    from engdyn.analysis.many import many

    pieces = plan.pieces()
    P = np.tile(np.append(plan.numbers, np.zeros(pieces.shape[1])), (len(x0), 1))
    for i, s in enumerate(plan.symbols):
        P[:, i] = members[s.name]
    states = np.zeros((len(x0), 6))
    states[:, 1] = plan.starts[0]
    out = np.empty((len(x0), len(times), x0.shape[1]))
    many(code, P, pieces, plan.starts, plan.ends, x0, times, *limits, MOST_STEPS, out, states)
    failed = np.flatnonzero(states[:, 5] != DONE)
    if len(failed):
        k = failed[0]
        raise EngdynError(
            f"member {k} of {len(failed)} that fail ends at t = {states[k, 1]:.6g} s: simulate it alone to see why; it "
            f"starts at (q, u) = {x0[k].tolist()}"
        )
    return out
