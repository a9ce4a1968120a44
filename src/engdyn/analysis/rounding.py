"""How far rounding may have moved an eigenvalue: a verdict must not hang on the last digit.

First-order perturbation bounds, entry by entry: |δλ| ≤ |y|ᴴ |δA| |x| / |yᴴ x| with left and right
eigenvectors y and x of the balanced matrix (J. H. Wilkinson, *The Algebraic Eigenvalue Problem*, Oxford
University Press, 1965, chapter 2), where |δA| comes from ball arithmetic on the entries. Course section 5.5.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from engdyn.algebra.balls import ball, is_finite, lower, upper
from engdyn.analysis.small_motion import compiled_blocks, unpacked
from engdyn.modeling.numbers import input_values, parameter_values

if TYPE_CHECKING:
    from engdyn.analysis.linear import LinearSystem

__all__ = ["eigenvalue_errors"]

EPS = float(np.finfo(float).eps)


def eigenvalue_errors(linear: LinearSystem, found: np.ndarray) -> np.ndarray:
    """Bounds to first order of what rounding may add to each eigenvalue.

    Parameters
    ----------
    linear : LinearSystem
        With numbers; each of them may be off by one unit in its last digit.
    found : ndarray of complex, shape (n + m,)
        Its eigenvalues.

    Returns
    -------
    ndarray, shape (n + m,)
        [1/s]
    """
    size = len(found)
    scale = _balance(linear.state_matrix)
    balanced = linear.state_matrix * scale / scale[:, None]
    change = _entry_errors(linear) * scale / scale[:, None]
    change += EPS * max(float(np.linalg.norm(balanced)), np.finfo(float).tiny)  # of the eigenvalue solver
    whole, norm = float(np.linalg.norm(change)), float(np.linalg.norm(balanced))
    # Where eigenvectors are parallel (a Jordan block) the first order says nothing; then L. Elsner's bound,
    # Linear Algebra and its Applications 71 (1985), which holds always.
    bound = np.full(size, (2 * norm + whole) ** (1 - 1 / size) * whole ** (1 / size))
    values, right = np.linalg.eig(balanced)
    try:
        left = np.linalg.inv(right)
        bound = np.minimum(bound, np.einsum("ki,ij,jk->k", np.abs(left), change, np.abs(right)))
    except np.linalg.LinAlgError:
        pass
    return bound[np.argmin(np.abs(found[:, None] - values), axis=1)]


def _balance(matrix: np.ndarray) -> np.ndarray:
    """Powers of two that, as a diagonal similarity, make rows and columns comparable.

    B. N. Parlett and C. Reinsch, Numerische Mathematik 13 (1969).
    """
    scale = np.ones(len(matrix))
    for _ in range(60):
        off = np.abs(matrix * scale / scale[:, None])
        np.fill_diagonal(off, 0.0)
        column, row = off.sum(axis=0), off.sum(axis=1)
        both = (column > 0) & (row > 0)
        step = np.where(both, np.round(np.log2(np.where(both, row, 1) / np.where(both, column, 1)) / 2), 0.0)
        if not step.any():
            break
        k = int(np.argmax(np.abs(step)))
        scale[k] *= 2.0 ** step[k]
    return scale


def _entry_errors(linear: LinearSystem) -> np.ndarray:
    """How far each entry of the state matrix may be off, shape (n + m, n + m)."""
    eom, at = linear.eom, linear.at
    n, m = len(eom.coordinates), len(eom.speeds)
    numbers = [*at.q, *at.speeds, *parameter_values(eom, at.values)]
    numbers += [*input_values(eom, at.inputs, at.values), 0.0, *at.accelerations]
    entries = compiled_blocks(eom, "balls")(*(_last_digit(float(x)) for x in numbers))
    errors = unpacked(eom, np.array([_radius(ball(entry)) for entry in entries]))
    below = np.abs(linear.state_matrix[n:])
    mass, inverse = np.abs(linear.mass), np.abs(np.linalg.inv(linear.mass))
    load = np.hstack([errors["K"], errors["C"]]) + (errors["M"] + m * EPS * mass) @ below
    return np.vstack([np.hstack([errors["Gq"], errors["G"]]), inverse @ load])


def _last_digit(x: float) -> Any:
    """A number with the uncertainty of its last binary digit."""
    return ball(x - EPS * abs(x), x + EPS * abs(x))


def _radius(b: Any) -> float:
    """Half the width of a ball; zero where it says nothing (a slope at a corner): the float has to do."""
    return 0.5 * (upper(b) - lower(b)) if is_finite(b) else 0.0
