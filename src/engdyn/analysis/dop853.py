"""The Runge–Kutta pair of order 8 (5, 3) in machine code: one driver for all equations of motion.

It calls the right-hand side by its address, so it is compiled once and kept by numba, whatever is simulated.
Coefficients, error estimate and interpolation are those of J. R. Dormand and P. J. Prince and of E. Hairer,
S. P. Nørsett and G. Wanner, *Solving Ordinary Differential Equations I* (1993), section II.10; the numbers are
read from scipy.  Only imported where numba is.  Course section 8.8.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numba import float64, int64, njit, types
from scipy.integrate._ivp import dop853_coefficients as published

__all__ = ["COLLAPSED", "DONE", "RUNNING", "SIGNATURE", "advance", "between"]

SIGNATURE = types.void(float64, float64[::1], float64[::1], float64[::1])
"""Of right-hand sides: f(t, x, p, out)."""

RHS = types.FunctionType(SIGNATURE)
VECTOR, MATRIX, CUBE = float64[::1], float64[:, ::1], float64[:, :, ::1]
RUNNING, DONE, COLLAPSED = 0, 1, 2
SAFETY, LEAST, MOST = 0.9, 0.2, 10.0
STAGES, ALL = 12, 16
A, B, C = published.A, published.B, published.C
E3, E5, D = published.E3, published.E5, published.D

# numba reads the constants above at compile time; what it compiles it keeps beside this file.
compiled = njit(cache=True, error_model="numpy")


@njit(inline="always")
def stage(f: Any, t: float, x: Any, p: Any, h: float, K: Any, s: int, y: Any) -> None:
    """Stage s from those before it."""
    for i in range(len(x)):
        total = 0.0
        for j in range(s):
            total += A[s, j] * K[j, i]
        y[i] = x[i] + h * total
    f(t + C[s] * h, y, p, K[s])


@compiled
def attempt(f: Any, t: float, x: Any, p: Any, h: float, K: Any, y: Any, rtol: float, atol: float) -> float:
    """One step to y; returns its error relative to the tolerance."""
    for s in range(1, STAGES):
        stage(f, t, x, p, h, K, s, y)
    for i in range(len(x)):
        total = 0.0
        for j in range(STAGES):
            total += B[j] * K[j, i]
        y[i] = x[i] + h * total
    f(t + h, y, p, K[STAGES])
    fifth, third = 0.0, 0.0
    for i in range(len(x)):
        scale = atol + rtol * max(abs(x[i]), abs(y[i]))
        e5, e3 = 0.0, 0.0
        for j in range(STAGES + 1):
            e5 += E5[j] * K[j, i]
            e3 += E3[j] * K[j, i]
        fifth += (e5 / scale) ** 2
        third += (e3 / scale) ** 2
    if fifth == 0.0 and third == 0.0:
        return 0.0
    return h * fifth / np.sqrt((fifth + 0.01 * third) * len(x))


@compiled
def dense(f: Any, t: float, x: Any, y: Any, p: Any, h: float, K: Any, F: Any, z: Any) -> None:
    """Coefficients F of the interpolation between x and y; three more stages."""
    for s in range(STAGES + 1, ALL):
        stage(f, t, x, p, h, K, s, z)
    for i in range(len(x)):
        change = y[i] - x[i]
        F[0, i] = change
        F[1, i] = h * K[0, i] - change
        F[2, i] = 2.0 * change - h * (K[STAGES, i] + K[0, i])
        for r in range(4):
            total = 0.0
            for j in range(ALL):
                total += D[r, j] * K[j, i]
            F[3 + r, i] = h * total


@compiled
def change(error: float) -> float:
    """Factor of the next step."""
    if error == 0.0:
        return MOST
    return min(MOST, max(LEAST, SAFETY * error**-0.125)) if error < np.inf else LEAST


@compiled
def step(
    f: Any, t: float, bound: float, x: Any, p: Any, h: float, K: Any, y: Any, rtol: float, atol: float
) -> tuple[float, float, int]:
    """One step within the tolerance: its end (t itself if there is none), the next step, failed attempts."""
    failed, least = 0, 10.0 * (np.nextafter(t, np.inf) - t)
    last = bound - t < least
    while last or h >= least:  # what is not a number is no step
        end = bound if last else min(t + h, bound)
        error = attempt(f, t, x, p, end - t, K, y, rtol, atol)
        factor = change(error)
        h = (end - t) * (min(1.0, factor) if failed else factor)
        if error < 1.0 or last:
            return end, h, failed
        failed += 1
    return t, h, failed


@compiled
def first_step(
    f: Any, t: float, x: Any, p: Any, K: Any, y: Any, span: float, rtol: float, atol: float
) -> float:
    """A step to begin with, from the sizes of the first two derivatives."""
    d0, d1, d2, n = 0.0, 0.0, 0.0, len(x)
    for i in range(n):
        scale = atol + rtol * abs(x[i])
        d0 += (x[i] / scale) ** 2
        d1 += (K[0, i] / scale) ** 2
    d0, d1 = np.sqrt(d0 / n), np.sqrt(d1 / n)
    h = min(1e-6 if d0 < 1e-5 or d1 < 1e-5 else 0.01 * d0 / d1, span)
    for i in range(n):
        y[i] = x[i] + h * K[0, i]
    f(t + h, y, p, K[1])
    for i in range(n):
        d2 += ((K[1, i] - K[0, i]) / (atol + rtol * abs(x[i]))) ** 2
    d2 = np.sqrt(d2 / n) / h
    if d1 <= 1e-15 and d2 <= 1e-15:
        return min(100.0 * h, max(1e-6, 1e-3 * h), span)
    return min(100.0 * h, (0.01 / max(d1, d2)) ** 0.125, span)


@njit(
    int64(
        RHS, VECTOR, MATRIX, VECTOR, VECTOR, VECTOR, VECTOR, float64, float64, float64, MATRIX, MATRIX, CUBE
    ),
    cache=True,
    error_model="numpy",
)
def advance(
    f: Any, p: Any, pieces: Any, starts: Any, ends: Any, state: Any, x: Any,
    rtol: float, atol: float, max_step: float, T: Any, X: Any, F: Any,
) -> int:  # fmt: skip
    """As many steps as the tables have room for; returns their number.

    Parameters
    ----------
    f : address of a right-hand side
    p, pieces : ndarrays
        Parameters; what their last entries are on each segment.
    starts, ends : ndarrays
        Times of the segments. No step goes across.
    state : ndarray, shape (6,)
        Segment (-1 before the first), time, step to try, evaluations, rejected steps, status; changed in place.
    x : ndarray
        State, changed in place.
    rtol, atol, max_step : float
    T, X, F : ndarrays, shape (N, 2), (N, n), (N, 7, n)
        Begin and end of each step, state at its begin, interpolation.
    """
    n, count, status = len(x), 0, RUNNING
    K, y, z = np.empty((ALL, n)), np.empty(n), np.empty(n)
    segment, t, h, evaluations, rejected = int(state[0]), state[1], state[2], state[3], state[4]
    if segment >= 0:
        f(t, x, p, K[0])
    while count < len(T):
        if segment < 0 or t >= ends[segment]:
            segment += 1
            if segment == len(ends):
                status = DONE
                break
            t = max(t, starts[segment])
            p[len(p) - pieces.shape[1] :] = pieces[segment]
            f(t, x, p, K[0])
            evaluations += 1
            if h == 0.0 and t < ends[segment]:
                h = first_step(f, t, x, p, K, y, ends[segment] - t, rtol, atol)
            continue
        end, h, failed = step(f, t, ends[segment], x, p, min(h, max_step), K, y, rtol, atol)
        evaluations += STAGES * failed
        rejected += failed
        if end == t:
            status = COLLAPSED
            break
        dense(f, t, x, y, p, end - t, K, F[count], z)
        evaluations += ALL - 1
        T[count, 0], T[count, 1] = t, end
        X[count] = x
        x[:] = y
        K[0] = K[STAGES]
        t = end
        count += 1
    state[:] = np.array([segment, t, h, evaluations, rejected, status])
    return count


@njit(int64(VECTOR, int64, int64, MATRIX, MATRIX, CUBE, MATRIX), cache=True, error_model="numpy")
def between(times: Any, at: int, count: int, T: Any, X: Any, F: Any, out: Any) -> int:
    """States at rising times, from number `at` on, as far as `count` steps reach; returns the next number."""
    for j in range(count):
        while at < len(times) and times[at] <= T[j, 1]:
            s = (times[at] - T[j, 0]) / (T[j, 1] - T[j, 0])
            for i in range(X.shape[1]):
                value = 0.0
                for r in range(6, -1, -1):
                    value = (value + F[j, r, i]) * (s if r % 2 == 0 else 1.0 - s)
                out[at, i] = X[j, i] + value
            at += 1
    return at
