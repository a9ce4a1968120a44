"""Folds and branch points of F(y) = 0, n equations in the n + 1 unknowns y = (z, λ).

Course section 4.3.  W. Govaerts, *Numerical Methods for Bifurcations of Dynamical Equilibria*, SIAM
(2000), chapters 3 and 4; H. B. Keller, in *Applications of Bifurcation Theory*, Academic Press (1977)
(the directions in which branches leave a branch point).
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

__all__ = ["branch_point", "classify"]

System = Callable[[np.ndarray], tuple[np.ndarray, np.ndarray]]

DIFFERENCE = 1e-4
"""Step of second differences, in units of the region's width."""

SINGULAR = 1e-6
"""A singular value below this, rows being scaled to order one, counts as zero."""


def branch_point(system: System, guess: np.ndarray) -> np.ndarray | None:
    """The simple branch point near a guess, to machine precision.

    Newton's method on F(y) + μ s = 0, wᵀ F_y(y) = 0, wᵀ w = 1 for y, the left null vector w and the
    unfolding μ, which is zero at a branch point (s is the first guess of w).

    Parameters
    ----------
    system : callable
        Returns F, shape (n,), and its Jacobian, shape (n, n + 1), at y; scaled to order one.
    guess : ndarray, shape (n + 1,)

    Returns
    -------
    ndarray, shape (n + 1,), or None
        None where the iteration does not settle beside the guess: no simple branch point.
    """
    y, n = guess.copy(), len(guess) - 1
    w, unfolding = np.linalg.svd(system(y)[1])[0][:, -1], 0.0
    support = w.copy()
    for _ in range(15):
        value, slopes = system(y)
        residual = np.concatenate([value + unfolding * support, slopes.T @ w, [w @ w - 1.0]])
        matrix = np.zeros((2 * n + 2, 2 * n + 2))
        matrix[:n, : n + 1], matrix[:n, -1] = slopes, support
        matrix[n:-1, : n + 1], matrix[n:-1, n + 1 : -1] = _hessian(system, y, w), slopes.T
        matrix[-1, n + 1 : -1] = 2.0 * w
        try:
            change = np.linalg.solve(matrix, residual)
        except np.linalg.LinAlgError:
            return None
        y, w, unfolding = y - change[: n + 1], w - change[n + 1 : -1], unfolding - change[-1]
        if not np.all(np.isfinite(y)) or np.max(np.abs(y - guess)) > 0.02:
            return None
        if np.max(np.abs(change)) < 1e-13:
            break
    return y if abs(unfolding) < 1e-10 and np.max(np.abs(change)) < 1e-8 else None


def _hessian(system: System, y: np.ndarray, w: np.ndarray) -> np.ndarray:
    """Second derivatives of wᵀ F by differences of the Jacobian."""
    columns = []
    for step in 1e-5 * np.eye(len(y)):
        columns.append((w @ system(y + step)[1] - w @ system(y - step)[1]) / 2e-5)
    return np.array(columns).T


def classify(system: System, y: np.ndarray) -> tuple[str, list[np.ndarray]]:
    """What kind of singular point y is, and the tangents of the curves through it.

    Parameters
    ----------
    system : callable
        As in :func:`branch_point`.
    y : ndarray, shape (n + 1,)

    Returns
    -------
    kind : {"fold", "pitchfork", "transcritical", "multiple"}
        "multiple" where the equations lose more than one rank.
    tangents : list of ndarray, shape (n + 1,)
        Of all curves through a simple branch point, empty otherwise.
    """
    n = len(y) - 1
    slopes = system(y)[1]
    left, sizes, right = np.linalg.svd(slopes[:, :n])
    w, v = left[:, -1], np.append(right[-1], 0.0)
    if n > 1 and sizes[-2] < SINGULAR:
        return "multiple", []
    if abs(w @ slopes[:, n]) > 10 * SINGULAR:
        return "fold", []
    a, b = np.linalg.svd(slopes)[2][-2:]

    def second(p: np.ndarray, q: np.ndarray) -> float:
        corners = ((s, t) for s in (1, -1) for t in (1, -1))
        parts = [s * t * (w @ system(y + DIFFERENCE * (s * p + t * q))[0]) for s, t in corners]
        return float(sum(parts)) / (4 * DIFFERENCE**2)

    form = second(a, a), 2 * second(a, b), second(b, b)
    tangents = [p * a + q * b for p, q in _quadratic_directions(*form)]
    size = max(*map(abs, form), 1e-300)
    kind = "pitchfork" if abs(second(v, v)) < 1e-3 * size else "transcritical"
    return kind, [tangent / np.linalg.norm(tangent) for tangent in tangents]


def _quadratic_directions(a: float, b: float, c: float) -> list[tuple[float, float]]:
    """Real solutions (p, q) of a p² + b p q + c q² = 0, up to scale."""
    size = max(abs(a), abs(b), abs(c))
    if size == 0:
        return []
    if abs(a) < 1e-9 * size:
        return [(1.0, 0.0), (-c, b)] if b else [(1.0, 0.0)]
    discriminant = b * b - 4 * a * c
    if discriminant < 0:
        return []
    root = float(np.sqrt(discriminant))
    return [((-b + root) / (2 * a), 1.0), ((-b - root) / (2 * a), 1.0)]
