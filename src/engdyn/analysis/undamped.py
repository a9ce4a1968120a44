"""Matrices of undamped vibration: whether there are modes, and the frequencies of many systems at once.

Course section 6.1.
"""

from __future__ import annotations

import warnings
from typing import Any

import numpy as np

from engdyn.analysis.linear import LinearSystem
from engdyn.errors import EngdynError, EngdynWarning

__all__ = ["checked_squares", "natural_frequencies", "sizes", "undamped_matrices"]

ROUNDING = 50 * float(np.finfo(float).eps)
"""Squares of ω below this share of the largest, times their number, are zero: rounding alone makes them."""

BLOCK = 1000
"""So many systems at once keep within the cache."""

CLIPPED = 1e-9
"""Negative squares of ω down to this share of the largest are taken as zero, with a warning."""

SYMMETRIC = 1e-9
"""Entries that differ by less than this share of the largest, in coordinates scaled to unit mass, are equal."""


def sizes(linear: LinearSystem) -> np.ndarray:
    """√Mᵢᵢ: makes components comparable, meters with radians; 1 where the system has no such matrix."""
    n, mass = len(linear.coordinates), linear.mass
    return np.sqrt(np.abs(np.diag(mass))) if mass.shape == (n, n) else np.ones(n)


def undamped_matrices(linear: LinearSystem) -> tuple[np.ndarray, np.ndarray]:
    """M and K of a system that has undamped modes, or an EngdynError that says why it has none."""
    if not isinstance(linear, LinearSystem) or not isinstance(linear.state_matrix, np.ndarray):
        raise EngdynError(f"modes needs a LinearSystem with numbers, not {linear!r}: call linearize")
    n = len(linear.coordinates)
    kinematics = np.hstack([np.zeros((n, n)), np.eye(n)])
    if linear.stiffness.shape != (n, n) or not np.array_equal(linear.state_matrix[:n], kinematics):
        raise EngdynError(
            "the speeds are not the rates of the coordinates (nonholonomic, for example): use damped_modes"
        )
    size = sizes(linear)
    if not np.all(size > 0):
        raise EngdynError(
            "the mass matrix has a zero on its diagonal: a coordinate without inertia has no mode"
        )
    mass, damping, stiffness = (
        matrix / np.outer(size, size) for matrix in (linear.mass, linear.damping, linear.stiffness)
    )
    rate = np.sqrt(np.max(np.abs(stiffness)))
    for name, matrix, scale in (
        ("mass", mass, 1.0),
        ("stiffness", stiffness, rate**2),
        ("damping", damping, max(rate, np.max(np.abs(damping)))),
    ):
        if np.any(np.abs(matrix - matrix.T) > SYMMETRIC * scale):
            why = {
                "mass": "take the equations of system.lagrange()",
                "stiffness": "circulatory: use damped_modes",
            }
            raise EngdynError(
                f"the {name} matrix is not symmetric ({why.get(name, 'gyroscopic: use damped_modes')}); undamped "
                "modes need symmetric matrices, and nothing is made symmetric that physics leaves unsymmetric"
            )
    if np.linalg.eigvalsh(mass)[0] <= 0:
        raise EngdynError("the mass matrix is not positive definite: some motion has no inertia")
    return linear.mass, linear.stiffness


def checked_squares(squares: np.ndarray) -> np.ndarray:
    """Squares of ω without rounding below zero; (..., n)."""
    largest = np.max(np.abs(squares), axis=-1, keepdims=True)
    squares = np.where(np.abs(squares) <= ROUNDING * squares.shape[-1] * largest, 0.0, squares)
    if np.any(squares < -CLIPPED * largest):
        raise EngdynError(
            f"ω² = {np.min(squares):.4g} 1/s² is negative: statically unstable there, a motion that grows without "
            "oscillating has no natural frequency; linearize about a stable equilibrium or use damped_modes"
        )
    if np.any(squares < 0):
        warnings.warn(
            f"ω² = {np.min(squares):.2g} 1/s² was taken as 0: rounding of the stiffness, or the edge of stability",
            EngdynWarning,
            stacklevel=3,
        )
    return np.maximum(squares, 0.0)


def natural_frequencies(mass: Any, stiffness: Any) -> np.ndarray:
    """Undamped natural frequencies of many systems at once.

    Parameters
    ----------
    mass, stiffness : array_like, shape (..., n, n)
        Symmetric matrices, stacked; the leading axes are broadcast.

    Returns
    -------
    ndarray, shape (..., n)
        [Hz], rising along the last axis.

    Raises
    ------
    EngdynError
        Matrices that are not square, finite or symmetric; a mass matrix that is not positive definite; a
        statically unstable system.

    Notes
    -----
    Course section 6.1; the route of `modes`, all systems in one call.

    Examples
    --------
    >>> import numpy as np
    >>> stiffness = np.array([[[800.0, -300.0], [-300.0, 300.0]], [[1100.0, -300.0], [-300.0, 300.0]]])
    >>> natural_frequencies(np.diag([2.0, 1.0]), stiffness).round(4)
    array([[1.8289, 3.7929],
           [2.128 , 4.1234]])
    """
    try:
        mass, stiffness = np.asarray(mass, dtype=float), np.asarray(stiffness, dtype=float)
    except (TypeError, ValueError) as error:
        raise EngdynError("mass and stiffness must be arrays of real numbers (..., n, n)") from error
    for name, matrix in (("mass", mass), ("stiffness", stiffness)):
        if matrix.ndim < 2 or matrix.shape[-1] != matrix.shape[-2] or not matrix.shape[-1]:
            raise EngdynError(f"{name} has shape {matrix.shape}: give square matrices (..., n, n)")
    try:
        mass, stiffness = np.broadcast_arrays(mass, stiffness)
    except ValueError as error:
        raise EngdynError(
            f"mass with shape {mass.shape} and stiffness with shape {stiffness.shape} do not go together"
        ) from error
    *stack, n, _ = mass.shape
    mass, stiffness = mass.reshape(-1, n, n), stiffness.reshape(-1, n, n)
    parts = (slice(i, i + BLOCK) for i in range(0, max(len(mass), 1), BLOCK))
    squares = np.concatenate([_squares(mass[part], stiffness[part]) for part in parts])
    return np.sqrt(checked_squares(squares)).reshape(*stack, n) / (2 * np.pi)


def _squares(mass: np.ndarray, stiffness: np.ndarray) -> np.ndarray:
    """ω² of a stack of systems, (N, n)."""
    for name, matrix in (("mass", mass), ("stiffness", stiffness)):
        skew = np.max(np.abs(matrix - matrix.swapaxes(1, 2)), axis=(1, 2))
        if not np.all(skew <= SYMMETRIC * np.max(np.abs(matrix), axis=(1, 2))):  # NaN is not
            raise EngdynError(
                f"{name} is not symmetric, or not finite: undamped modes need symmetric matrices"
            )
    try:
        inverse = _inverse(np.linalg.cholesky(mass))
    except np.linalg.LinAlgError as error:
        raise EngdynError("a mass matrix is not positive definite: some motion has no inertia") from error
    return np.linalg.eigvalsh(inverse @ stiffness @ inverse.swapaxes(1, 2))


def _inverse(lower: np.ndarray) -> np.ndarray:
    """Inverses of lower triangles, by forward substitution in all of them at once."""
    inverse = np.zeros_like(lower)
    for i in range(lower.shape[-1]):
        pivot = lower[..., i, i, None]
        inverse[..., i, :i] = -(lower[..., i, None, :i] @ inverse[..., :i, :i])[..., 0, :] / pivot
        inverse[..., i, i] = 1 / pivot[..., 0]
    return inverse
