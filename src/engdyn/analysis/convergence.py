"""What a scheme is worth: its order, measured; how it treats a vibration; where it becomes unstable.

Course sections 8.3 to 8.8.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from numbers import Real
from typing import Any

import numpy as np

from engdyn.analysis.integrators import SCHEMES, Function, integrate
from engdyn.errors import EngdynError

__all__ = ["Convergence", "growth_factor", "measure_order", "stability_limit"]


@dataclass(frozen=True, eq=False)
class Convergence:
    """How the error of a scheme falls with its step.

    Attributes
    ----------
    scheme : str
    step : ndarray
        Steps h [s].
    error : ndarray
        Largest deviation of the observed entries of the state at the end.
    evaluations : ndarray of int
        Of the right-hand side: what the accuracy costs.
    order : float
        Slope of log(error) over log(h), by least squares.
    """

    scheme: str
    step: np.ndarray
    error: np.ndarray
    evaluations: np.ndarray
    order: float


def measure_order(
    f: Function,
    x0: Any,
    end: float,
    scheme: str,
    counts: Sequence[int],
    exact: Any = None,
    observe: Any = None,
) -> Convergence:
    """Integrate from 0 to `end` in different numbers of steps, and compare with the exact state there.

    Parameters
    ----------
    f, x0, scheme
        As for :func:`engdyn.integrate`; a fixed-step scheme.
    end : float
        Final time [s]; away from turning points, where the order of the error looks accidental.
    counts : sequence of int
        Numbers of steps, two or more.
    exact : array_like, shape (n,), optional
        State at the end; by default from an integration at a tolerance of 1e-13.
    observe : index or list of indices, optional
        Entries of the state that are compared; default: all.

    Returns
    -------
    Convergence

    Raises
    ------
    EngdynError
        Less than two counts, an adaptive scheme, and what :func:`engdyn.integrate` refuses.

    Notes
    -----
    Course sections 8.5, 8.6 and 8.8; pitfall: an error of 1e-13 is rounding and has no order.
    """
    if scheme not in SCHEMES or len(counts) < 2:
        raise EngdynError(f"give two or more numbers of steps and one of the schemes {', '.join(SCHEMES)}")
    if not np.all(np.isfinite(end)) or not end > 0:  # solve_ivp would not come back
        raise EngdynError(f"end is {end!r}: give a positive, finite time [s]")
    if exact is None:
        integrate(f, x0, [0.0, end], scheme)  # refuses what does not fit
        from scipy.integrate import solve_ivp

        exact = solve_ivp(f, (0.0, end), x0, "DOP853", rtol=1e-13, atol=1e-14).y[:, -1]
    chosen = slice(None) if observe is None else np.atleast_1d(observe)
    runs = [integrate(f, x0, np.linspace(0.0, end, n + 1), scheme) for n in counts]
    error = np.array([np.max(np.abs((run.x[-1] - exact)[chosen])) for run in runs])
    step = end / np.array(counts, dtype=float)
    order = float(np.polyfit(np.log(step), np.log(error), 1)[0])
    return Convergence(scheme, step, error, np.array([run.evaluations for run in runs]), order)


def growth_factor(scheme: str, omega_h: float, damping_ratio: float = 0.0) -> float:
    """Factor of the amplitude in one step of a free vibration ẍ + 2ζωẋ + ω²x = 0.

    Above 1 the computed vibration grows: Euler's √(1 + ω²h²) for ζ = 0, whatever the step.

    Parameters
    ----------
    scheme : str
    omega_h : float
        Natural frequency times step, ωh [rad].
    damping_ratio : float
        ζ.

    Returns
    -------
    float
        Largest magnitude of the eigenvalues of the step, a linear map of the state.

    Notes
    -----
    Course sections 8.4 and 8.6.

    Examples
    --------
    >>> import engdyn as ed
    >>> round(ed.growth_factor("euler", 0.75), 6)  # 1.25
    1.25
    """
    _check_vibration(scheme, damping_ratio, omega_h)

    def oscillator(t: float, x: np.ndarray) -> np.ndarray:
        return np.array([x[1], -x[0] - 2 * damping_ratio * x[1]])

    step = np.column_stack([SCHEMES[scheme](oscillator, 0.0, unit, float(omega_h)) for unit in np.eye(2)])
    return float(np.max(np.abs(np.linalg.eigvals(step))))


def _check_vibration(scheme: str, *numbers: Any) -> None:
    if scheme not in SCHEMES:
        raise EngdynError(f"unknown scheme {scheme!r}: choose one of {', '.join(SCHEMES)}")
    if not all(isinstance(x, Real) and math.isfinite(x) for x in numbers):
        raise EngdynError(f"damping_ratio and omega_h must be finite numbers, not {numbers!r}")


def stability_limit(scheme: str, damping_ratio: float = 0.0) -> float:
    """Largest ωh up to which a free vibration does not grow: 2 for central differences, 0 for Euler.

    Parameters
    ----------
    scheme : str
    damping_ratio : float
        ζ.

    Notes
    -----
    Course section 8.6. The highest natural frequency counts, whether or not one cares for that mode.

    Examples
    --------
    >>> import engdyn as ed
    >>> round(ed.stability_limit("rk4"), 4)  # 2√2
    2.8284
    """
    _check_vibration(scheme, damping_ratio)

    def stable(z: float) -> bool:
        try:
            return growth_factor(scheme, z, damping_ratio) <= 1 + 1e-9
        except EngdynError:
            return False  # the damping force cannot be found by iteration

    grid = np.arange(0.01, 10.0, 0.01)
    first = next((i for i, z in enumerate(grid) if not stable(z)), None)
    if first is None:
        raise EngdynError(f"{scheme} does not become unstable up to ωh = 10")
    low, high = (grid[first - 1] if first else 0.0), grid[first]
    for _ in range(40):
        middle = (low + high) / 2
        low, high = (middle, high) if middle and stable(middle) else (low, middle)
    return float(low) if first else 0.0
