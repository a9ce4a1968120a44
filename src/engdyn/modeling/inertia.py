"""Moments and products of inertia.  Appendix B.

One sign convention everywhere: a tensor holds the *elements*, so that its off-diagonal entries are
−∫xy dm, −∫yz dm, −∫zx dm, and H = I ω is a plain matrix product.  Arguments may be numbers or sympy
expressions; numbers give a numpy array, expressions a sympy matrix.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import sympy as sm

from engdyn.errors import EngdynError

__all__ = ["PrincipalAxes", "check_tensor", "inertia_tensor", "parallel_axis", "principal_axes", "rotated"]


def is_symbolic(*values: Any) -> bool:
    """Whether any of the values is a sympy expression that is not a number."""
    return any(isinstance(v, sm.Basic) and not v.is_number for v in values)


def as_tensor(rows: Sequence[Sequence[Any]]) -> Any:
    """Nine entries as a numpy array, or as a sympy matrix where one of them is symbolic."""
    if is_symbolic(*(x for row in rows for x in row)):
        return sm.Matrix(rows)
    return np.array([[float(x) for x in row] for row in rows])


def inertia_tensor(masses: Sequence[Any], points: Sequence[Sequence[Any]]) -> Any:
    """Inertia tensor of particles about the origin of their coordinates.

    Parameters
    ----------
    masses : sequence, length N
        [kg], none negative.
    points : sequence of (x, y, z), length N
        [m].

    Returns
    -------
    ndarray or sympy.Matrix, shape (3, 3)
        Σ m (r² 1 − r rᵀ) [kg m²]; off-diagonal elements are −Σ m x y and so on.

    Raises
    ------
    EngdynError
        Different numbers of masses and points, points that are not triples, negative masses.

    Notes
    -----
    Section B.1.

    Examples
    --------
    >>> import engdyn as ed
    >>> ed.inertia_tensor([2.0], [(1.0, 3.0, 0.0)])
    array([[18., -6.,  0.],
           [-6.,  2.,  0.],
           [ 0.,  0., 20.]])
    """
    masses, points = list(masses), [tuple(p) for p in points]
    if len(masses) != len(points) or not masses:
        raise EngdynError(
            f"{len(masses)} masses and {len(points)} points: give one point for every mass, at least one"
        )
    rows: list[list[Any]] = [[0, 0, 0] for _ in range(3)]
    for mass, r in zip(masses, points, strict=True):
        if len(r) != 3:
            raise EngdynError(f"the point {r} has {len(r)} coordinates: give (x, y, z)")
        check_positive(zero=True, mass=mass)
        square = sum(x * x for x in r)
        for i in range(3):
            for j in range(3):
                rows[i][j] = rows[i][j] + mass * ((square if i == j else 0) - r[i] * r[j])
    return as_tensor(rows)


def parallel_axis(tensor: Any, mass: Any, offset: Sequence[Any]) -> Any:
    """Inertia tensor about a point at `offset`, from that about the mass center.

    Parameters
    ----------
    tensor : array_like, shape (3, 3)
        About the mass center G [kg m²].
    mass : float or sympy.Expr
        [kg]
    offset : (x, y, z)
        From G to the new point [m]; its sign does not matter.

    Returns
    -------
    ndarray or sympy.Matrix, shape (3, 3)

    Notes
    -----
    Sections B.2 and B.3: I_P = I_G + m (d² 1 − d dᵀ) (J. Steiner; C. Huygens, *Horologium
    oscillatorium*, 1673).  It leads from G outward only: from one point to another go through G, back
    with a *minus* sign.
    """
    rows = _rows(tensor)
    added = _rows(inertia_tensor([mass], [tuple(offset)]))
    return as_tensor([[a + b for a, b in zip(x, y, strict=True)] for x, y in zip(rows, added, strict=True)])


def rotated(tensor: Any, rotation: Any) -> Any:
    """Elements of the same tensor in other axes: R I Rᵀ.

    Parameters
    ----------
    tensor : array_like, shape (3, 3)
    rotation : array_like, shape (3, 3)
        Turns components in the old axes into components in the new ones.
    """
    if is_symbolic(*(x for row in (*_rows(tensor), *_rows(rotation)) for x in row)):
        R = sm.Matrix(_rows(rotation))
        return R * sm.Matrix(_rows(tensor)) * R.T
    R = np.array(_rows(rotation), dtype=float)
    if not np.allclose(R @ R.T, np.eye(3), atol=1e-9):
        raise EngdynError("rotation is not orthogonal: its rows must be unit vectors, square to each other")
    return R @ np.array(_rows(tensor), dtype=float) @ R.T


@dataclass(frozen=True, eq=False)
class PrincipalAxes:
    """Principal moments of inertia and their axes.

    Attributes
    ----------
    moments : ndarray, shape (3,)
        In rising order [kg m²].
    axes : ndarray, shape (3, 3)
        Unit vectors as columns, right-handed.
    """

    moments: np.ndarray
    axes: np.ndarray


def principal_axes(tensor: Any) -> PrincipalAxes:
    """Principal moments and axes of an inertia tensor.

    Parameters
    ----------
    tensor : array_like, shape (3, 3)
        Numbers [kg m²].

    Raises
    ------
    EngdynError
        A tensor that no body can have (see :func:`check_tensor`).

    Notes
    -----
    Section B.3.  Each axis is turned so that its largest component is positive, the third one so
    that the set is right-handed.
    """
    checked = check_tensor(tensor)
    moments, axes = np.linalg.eigh(checked)
    for k in range(3):
        axes[:, k] *= np.sign(axes[np.argmax(np.abs(axes[:, k])), k])
    if np.linalg.det(axes) < 0:
        axes[:, 2] *= -1
    return PrincipalAxes(moments, axes)


def check_tensor(tensor: Any) -> np.ndarray:
    """The tensor as an array, if a body can have it.

    Raises
    ------
    EngdynError
        Not 3 × 3 and symmetric, negative moments, or J1 + J2 < J3: the largest principal moment
        cannot exceed the sum of the others.
    """
    try:
        array = np.array(_rows(tensor), dtype=float)
    except (TypeError, ValueError) as error:
        raise EngdynError("the inertia tensor must be a 3 × 3 array of numbers") from error
    if not np.all(np.isfinite(array)):
        raise EngdynError("the inertia tensor contains values that are not finite")
    scale = np.max(np.abs(array)) or 1.0
    if np.max(np.abs(array - array.T)) > 1e-9 * scale:
        raise EngdynError(
            "the inertia tensor is not symmetric: its element (i, j) is −∫ x_i x_j dm, the same as (j, i)"
        )
    small, middle, large = np.linalg.eigvalsh(array)
    if small < -1e-9 * scale:
        raise EngdynError(
            f"the principal moment {small:.4g} kg m² is negative: check masses and signs of the products"
        )
    if large > (small + middle) * (1 + 1e-9) + 1e-12 * scale:
        raise EngdynError(
            f"no body has the principal moments {small:.4g}, {middle:.4g}, {large:.4g} kg m²: the largest exceeds "
            "the sum of the others; check the products' sign and the axes they refer to"
        )
    return array


def _rows(tensor: Any) -> list[list[Any]]:
    rows = tensor.tolist() if hasattr(tensor, "tolist") else [list(row) for row in tensor]
    if len(rows) != 3 or any(not isinstance(row, list) or len(row) != 3 for row in rows):
        raise EngdynError("an inertia tensor or a rotation has three rows of three entries")
    return rows


def check_positive(zero: bool = False, **quantities: Any) -> None:
    """Refuse numbers that are not finite or have the wrong sign; symbols pass."""
    for name, value in quantities.items():
        if is_symbolic(value):
            continue
        try:
            number = float(value)
        except (TypeError, ValueError) as error:
            raise EngdynError(f"{name} is {value!r}: give a number or an expression") from error
        if not np.isfinite(number) or number < 0 or (number == 0 and not zero):
            raise EngdynError(
                f"{name} is {number:g}: it must be finite and {'not negative' if zero else 'greater than zero'}"
            )
