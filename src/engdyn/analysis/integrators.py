"""Numerical integration as it is taught: one step of each scheme is a few lines.  Course sections 8.3 to 8.8.

A *step function* has the signature ``step(f, t, x, h)`` and returns the state at t + h.  The right-hand side
``f(t, x)`` returns ẋ.  ``simulate`` does the real work; these schemes are here to be read, compared and broken.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np
from scipy.integrate import RK45

from engdyn.errors import EngdynError

if TYPE_CHECKING:
    import pandas as pd

__all__ = ["SCHEMES", "Integration", "integrate", "step_table"]

Function = Callable[[float, np.ndarray], np.ndarray]

ITERATIONS, CLOSE = 60, 1e-14
"""How often, and how closely, a velocity is corrected that its own force depends on."""


def euler(f: Function, t: float, x: np.ndarray, h: float) -> np.ndarray:
    """Go along the tangent (8.4). First order."""
    return x + h * f(t, x)


def semi_implicit_euler(f: Function, t: float, x: np.ndarray, h: float) -> np.ndarray:
    """Euler, but positions move with the new velocities: one line different, and vibrations stay bounded."""
    q, v = halves(x)
    v = v + h * halves(f(t, x))[1]
    return np.concatenate([q + h * v, v])


def midpoint(f: Function, t: float, x: np.ndarray, h: float) -> np.ndarray:
    """Use the slope in the middle of the step, found by half a step of Euler. Second order."""
    return x + h * f(t + h / 2, x + h / 2 * f(t, x))


def heun(f: Function, t: float, x: np.ndarray, h: float) -> np.ndarray:
    """Use the mean of the slopes at both ends. Second order."""
    first = f(t, x)
    return x + h / 2 * (first + f(t + h, x + h * first))


def rk4(f: Function, t: float, x: np.ndarray, h: float) -> np.ndarray:
    """The classical scheme of Runge and Kutta: four slopes, weighted as in Simpson's rule. Fourth order."""
    k1 = f(t, x)
    k2 = f(t + h / 2, x + h / 2 * k1)
    k3 = f(t + h / 2, x + h / 2 * k2)
    k4 = f(t + h, x + h * k3)
    return x + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)


def central_difference(f: Function, t: float, x: np.ndarray, h: float) -> np.ndarray:
    """Replace q̈ by (q₊ − 2q + q₋)/h² (8.6). Second order; stable for ωh < 2.

    The start needs a fictitious place q₋ = q − h v + h² a/2 before the first one. Because v is kept as the central
    difference (q₊ − q₋)/2h, the same formula gives q₋ back at every later step. The velocity at the end of the
    step depends on the acceleration there; where this depends on the velocity (damping), both are found by
    iteration, so that damping is not felt half a step late.
    """
    (q, v), a = halves(x), halves(f(t, x))[1]
    before = q - h * v + h**2 / 2 * a
    after = 2 * q - before + h**2 * a
    v_after = (after - q) / h + h / 2 * a
    for _ in range(ITERATIONS):
        a = halves(f(t + h, np.concatenate([after, v_after])))[1]
        v_before, v_after = v_after, (after - q) / h + h / 2 * a
        if not np.max(np.abs(v_after - v_before)) > CLOSE * np.max(np.abs([(after - q) / h, h * a])):
            return np.concatenate([after, v_after])
    raise EngdynError(
        f"central_difference: at t = {t + h:.5g} s the forces depend so strongly on the velocity that it cannot be "
        "found by iteration; take a smaller step"
    )


def halves(x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Read a state as (q, v), or its derivative as (v, a)."""
    n = len(x) // 2
    return x[:n], x[n:]


SCHEMES: dict[str, Callable[[Function, float, np.ndarray, float], np.ndarray]] = {
    scheme.__name__: scheme
    for scheme in (euler, semi_implicit_euler, midpoint, heun, rk4, central_difference)
}
"""Step functions by name."""

IN_HALVES = ("semi_implicit_euler", "central_difference")


@dataclass(frozen=True, eq=False, repr=False)
class Integration:
    """What `integrate` returns.

    Attributes
    ----------
    time : ndarray, shape (N,)
    x : ndarray, shape (N, n)
    scheme : str
    evaluations : int
        Of the right-hand side.
    steps : ndarray
        Times between which single steps went; of an adaptive scheme they are its own.
    rejected : int
        Steps that an adaptive scheme had to repeat.
    """

    time: np.ndarray
    x: np.ndarray
    scheme: str
    evaluations: int
    steps: np.ndarray = field(default_factory=lambda: np.empty(0))
    rejected: int = 0

    def __repr__(self) -> str:
        return f"Integration({self.scheme}; {len(self.steps) - 1} steps, {self.evaluations} evaluations)"


def integrate(
    f: Function,
    x0: Any,
    times: Any,
    scheme: str,
    *,
    rtol: float = 1e-6,
    atol: float = 1e-9,
) -> Integration:
    """Integrate ẋ = f(t, x) by one of the schemes of chapter 8.

    Parameters
    ----------
    f : callable
        ``f(t, x)`` returns ẋ, shape (n,).
    x0 : array_like, shape (n,)
        State at ``times[0]``.
    times : array_like, shape (N,)
        Rising. A fixed-step scheme takes one step from each to the next; "rk45" chooses its own steps.
    scheme : str
        "euler", "semi_implicit_euler", "midpoint", "heun", "rk4", "central_difference", or adaptive "rk45".
        "semi_implicit_euler" and "central_difference" read x as halves (q, v), and ẋ as (v, a).
    rtol, atol : float
        Tolerance of each step of "rk45": atol + rtol·|x|. It is not the error of the result.

    Returns
    -------
    Integration
        ``.time`` (N,) and ``.x`` (N, n).

    Raises
    ------
    EngdynError
        Unknown scheme, times that do not rise, a state that does not fit; values that are not finite any
        more, with the time and the last state that was.

    Examples
    --------
    >>> import engdyn as ed, numpy as np
    >>> found = ed.integrate(lambda t, x: np.array([x[1], -x[0]]), [1.0, 0.0], np.linspace(0, 1, 11), "rk4")
    >>> round(float(found.x[-1, 0]), 5)  # cos(1) = 0.54030
    0.5403
    """
    times, x0 = _checked(times, x0, scheme)
    count = [0]

    def counted(t: float, x: np.ndarray) -> np.ndarray:
        count[0] += 1
        try:
            slope = np.asarray(f(t, x), dtype=float)
        except (OverflowError, ValueError) as error:
            raise EngdynError(f"f gives no array of numbers at t = {t:.5g} s: {error}") from error
        if slope.shape != x.shape:
            raise EngdynError(
                f"f returns shape {slope.shape} for a state of shape {x.shape}: it must be the same"
            )
        return slope

    with np.errstate(all="ignore"):  # what is not finite is an error below
        if scheme == "rk45":
            x, steps, rejected = _adaptive(counted, times, x0, rtol, atol)
        else:
            x, steps, rejected = np.empty((len(times), len(x0))), times, 0
            x[0] = x0
            for i, (t, h) in enumerate(zip(times[:-1], np.diff(times), strict=True)):
                x[i + 1] = SCHEMES[scheme](counted, t, x[i], h)
                _check_finite(scheme, times[i + 1], x[i + 1], x[i])
    return Integration(times, x, scheme, count[0], steps, rejected)


def _adaptive(
    f: Function, times: np.ndarray, x0: np.ndarray, rtol: float, atol: float
) -> tuple[np.ndarray, np.ndarray, int]:
    """Dormand and Prince's pair of orders 5 and 4 (1980): their difference estimates the error of a step."""
    t, x, k = times[0], x0, f(times[0], x0)
    h, steps, rejected, found = (times[-1] - t) / 100, [t], 0, [x0]
    while t < times[-1]:
        h = min(h, times[-1] - t)
        K = _slopes(f, t, x, h, k)
        x_new = x + h * RK45.B @ K[:-1]
        error = h * RK45.E @ K
        size = np.max(np.abs(error) / (atol + rtol * np.maximum(np.abs(x), np.abs(x_new))))
        if size <= 1:  # accept; the last slope is the first one of the next step
            end = times[-1] if h == times[-1] - t else t + h
            for at in times[(times > t) & (times <= end)]:
                s = (at - t) / h
                found.append(x + h * (s ** np.arange(1, 5)) @ (RK45.P.T @ K))
            t, x, k = end, x_new, K[-1]
            steps.append(t)
        else:
            rejected += 1
        h *= min(5.0, max(0.2, 0.9 * size**-0.2)) if 0 < size < np.inf else (5.0 if size == 0 else 0.2)
        if h < 1e-14 * max(abs(t), abs(times[-1])):
            _check_finite("rk45", t, np.array([np.nan]), x)
    return np.array(found), np.array(steps), rejected


def _slopes(f: Function, t: float, x: np.ndarray, h: float, k: np.ndarray) -> np.ndarray:
    """The seven slopes of the pair, the last at the end of the step."""
    K = np.empty((7, len(x)))
    K[0] = k
    for s in range(1, 6):
        K[s] = f(t + RK45.C[s] * h, x + h * RK45.A[s, :s] @ K[:s])
    K[6] = f(t + h, x + h * RK45.B @ K[:6])
    return K


def _checked(times: Any, x0: Any, scheme: str) -> tuple[np.ndarray, np.ndarray]:
    try:
        times, x0 = np.asarray(times, dtype=float), np.asarray(x0, dtype=float)
    except (TypeError, ValueError, OverflowError) as error:
        raise EngdynError("times and x0 must be arrays of numbers") from error
    if scheme not in (*SCHEMES, "rk45"):
        raise EngdynError(f"unknown scheme {scheme!r}: choose one of {', '.join([*SCHEMES, 'rk45'])}")
    if times.ndim != 1 or len(times) < 2 or not np.all(np.diff(times) > 0) or not np.isfinite(times).all():
        raise EngdynError("times must hold two or more finite numbers, each larger than the one before")
    if x0.ndim != 1 or not len(x0) or not np.isfinite(x0).all() or (scheme in IN_HALVES and len(x0) % 2):
        half = ", places and velocities, an even number" if scheme in IN_HALVES else ""
        raise EngdynError(f"x0 is {x0.tolist()}: give a row of finite numbers{half}")
    return times, x0


def _check_finite(scheme: str, t: float, x: np.ndarray, last: np.ndarray) -> None:
    if not np.isfinite(x).all():
        state = ", ".join(f"{value:.5g}" for value in last)
        raise EngdynError(
            f"{scheme} left the finite numbers at t = {t:.5g} s; the last state was ({state}). Take smaller steps, or "
            "look whether the motion itself runs away"
        )


def step_table(
    f: Function, x0: Any, times: Any, scheme: str = "euler", names: Sequence[str] | None = None
) -> pd.DataFrame:
    """The steps of a scheme as a table to be checked by hand: t, the state, its slope there (Table 8.1).

    Parameters
    ----------
    f, x0, times, scheme
        As for :func:`integrate`.
    names : sequence of str, optional
        Names of the entries of x; default x1, x2, …

    Returns
    -------
    pandas.DataFrame
        One row for each time; columns t, the names, and the names with a prime for ẋ.

    Raises
    ------
    EngdynError
        As :func:`integrate`; names that do not fit.

    Notes
    -----
    Course section 8.5.
    """
    import pandas as pd

    found = integrate(f, x0, times, scheme)
    n = found.x.shape[1]
    names = [f"x{i + 1}" for i in range(n)] if names is None else list(names)
    if len(names) != n:
        raise EngdynError(f"{len(names)} names for {n} entries of the state: give one each")
    slopes = np.array([f(t, x) for t, x in zip(found.time, found.x, strict=True)], dtype=float)
    columns = ["t", *names, *(f"{name}'" for name in names)]
    return pd.DataFrame(np.column_stack([found.time, found.x, slopes]), columns=columns)
