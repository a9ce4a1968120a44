"""Many trajectories at once, in machine code.  Only imported where numba is."""

from __future__ import annotations

from typing import Any

import numpy as np
from numba import float64, int64, njit, prange, types

from engdyn.analysis.dop853 import CUBE, MATRIX, RHS, RUNNING, VECTOR, advance, between

__all__ = ["many"]

ROWS = 32
"""Steps between two looks at the times wanted."""


@njit(
    types.void(
        RHS, MATRIX, MATRIX, VECTOR, VECTOR, MATRIX, VECTOR, float64, float64, float64, int64, CUBE, MATRIX
    ),
    cache=True,
    error_model="numpy",
    parallel=True,
)
def many(
    f: Any, P: Any, pieces: Any, starts: Any, ends: Any, X0: Any, times: Any,
    rtol: float, atol: float, max_step: float, limit: int, out: Any, states: Any,
) -> None:  # fmt: skip
    """Trajectories from the rows of X0 with the parameters in the rows of P, all cores at work.

    ``out``, shape (N, len(times), n), gets the trajectories, ``states``, shape (N, 6), what :func:`advance` leaves.
    """
    n = X0.shape[1]
    for k in prange(len(X0)):
        T, X, F, x = np.empty((ROWS, 2)), np.empty((ROWS, n)), np.empty((ROWS, 7, n)), X0[k].copy()
        states[k, 0] = -1.0
        out[k, 0] = x
        at, steps = 1, 0
        while states[k, 5] == RUNNING and steps < limit:
            count = advance(f, P[k], pieces, starts, ends, states[k], x, rtol, atol, max_step, T, X, F)
            steps += count
            at = between(times, at, count, T, X, F, out[k])
