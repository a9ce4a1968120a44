"""Moments and products of inertia.  Appendix B.

One sign convention everywhere: a tensor holds the *elements*, so that its off-diagonal entries are
−∫xy dm, −∫yz dm, −∫zx dm, and H = I ω is a plain matrix product.  Arguments may be numbers or sympy
expressions; numbers give a numpy array, expressions a sympy matrix.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import sympy as sm

from engdyn.errors import EngdynError
from engdyn.modeling.tensors import as_rows, as_tensor, check_positive, checked_entry, is_symbolic

__all__ = [
    "PrincipalAxes",
    "check_tensor",
    "inertia_tensor",
    "parallel_axis",
    "principal_axes",
    "rotate_tensor",
]


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
    if not _are_numbers(masses, points):
        masses, points = _checked(masses, points)
        if is_symbolic(*masses, *(x for r in points for x in r)):
            rows: Any = sm.zeros(3)
            for mass, point in zip(masses, points, strict=True):
                column = sm.Matrix(point)
                rows += mass * (column.dot(column) * sm.eye(3) - column * column.T)
            return rows
    m, x = np.array(masses, dtype=float), np.array(points, dtype=float)
    return np.sum(m * np.sum(x * x, axis=1)) * np.eye(3) - (m * x.T) @ x


def _are_numbers(masses: Any, points: Any) -> bool:
    """Whether nothing needs a closer look: a cloud of a million points is checked at once."""
    try:
        m, x = np.asarray(masses), np.asarray(points)
    except ValueError:
        return False
    plain = m.dtype.kind in "iuf" and x.dtype.kind in "iuf" and m.ndim == 1 and x.shape == (len(m), 3)
    return bool(plain and len(m) and np.all(np.isfinite(m)) and np.all(m >= 0) and np.all(np.isfinite(x)))


def _checked(masses: Any, points: Any) -> tuple[list[Any], list[tuple[Any, ...]]]:
    """Masses and points as lists, or what is wrong with them."""
    try:
        masses, points = list(masses), [tuple(p) for p in points]
    except TypeError as error:
        raise EngdynError("give a list of masses and a list of points (x, y, z)") from error
    if len(masses) != len(points) or not masses:
        raise EngdynError(
            f"{len(masses)} masses and {len(points)} points: give one point for every mass, at least one"
        )
    for mass, r in zip(masses, points, strict=True):
        if len(r) != 3:
            raise EngdynError(f"the point {r} has {len(r)} coordinates: give (x, y, z)")
        check_positive(zero=True, mass=mass)
        for x in r:
            checked_entry(x, f"a coordinate of the point {r}")
    return masses, points


def parallel_axis(
    tensor: Any, mass: Any, offset: Sequence[Any], *, start: Sequence[Any] = (0.0, 0.0, 0.0)
) -> Any:
    """Inertia tensor about the point at `offset` from the mass center G, in parallel axes.

    Parameters
    ----------
    tensor : array_like, shape (3, 3)
        About G [kg m²], or about the point at `start`.
    mass : float or sympy.Expr
        [kg]
    offset : (x, y, z)
        From G to the new point [m]; its sign does not matter. Zeros lead back to G.
    start : (x, y, z), optional
        From G to the point that `tensor` refers to [m]; default G itself.

    Returns
    -------
    ndarray or sympy.Matrix, shape (3, 3)

    Raises
    ------
    EngdynError
        Offsets that are not triples of finite numbers, a negative mass, a tensor that is not symmetric; a
        tensor that, brought back to G, no body can have: it does not refer to the point at `start`.

    Notes
    -----
    Sections B.2 and B.3: I_P = I_G + m (d² 1 − d dᵀ) (J. Steiner; C. Huygens, *Horologium
    oscillatorium*, 1673). The theorem leads from G outward, and back with a minus sign. The way from
    one point to another is always through G: both offsets count from there, never from each other.

    Examples
    --------
    >>> import engdyn as ed
    >>> about_end = ed.parallel_axis(ed.solids.rod(3.0, 2.0), 3.0, (0, 0, 1))
    >>> about_end.diagonal().tolist()
    [4.0, 4.0, 0.0]
    >>> ed.parallel_axis(about_end, 3.0, (0, 0, 0), start=(0, 0, 1)).diagonal().tolist()
    [1.0, 1.0, 0.0]
    """
    if not all(isinstance(place, Iterable) for place in (offset, start)):
        raise EngdynError(f"offset is {offset!r}, start is {start!r}: give (x, y, z) in meters")
    rows = as_rows(as_tensor(as_rows(tensor)))
    if not is_symbolic(*(x for row in rows for x in row)):
        _check_symmetric(np.array(rows))
    if any(x != 0 for x in start):
        rows = _shifted(rows, mass, start, -1)
        if not is_symbolic(*(x for row in rows for x in row)):
            _check_about_center(np.array(rows), start)
    return as_tensor(_shifted(rows, mass, offset, 1))


def _shifted(rows: list[list[Any]], mass: Any, offset: Sequence[Any], sign: int) -> list[list[Any]]:
    """The tensor plus (away from G) or minus (toward G) that of the whole mass at `offset`."""
    added = as_rows(inertia_tensor([mass], [tuple(offset)]))
    return [[a + sign * b for a, b in zip(x, y, strict=True)] for x, y in zip(rows, added, strict=True)]


def _check_about_center(array: np.ndarray, start: Sequence[Any]) -> None:
    try:
        check_tensor(array)
    except EngdynError as error:
        raise EngdynError(
            f"brought back to the mass center, the tensor is impossible, so it does not refer to the point at "
            f"{tuple(start)} from G: {error}"
        ) from error


def rotate_tensor(tensor: Any, rotation: Any) -> Any:
    """Elements of the same tensor, about the same point, in other axes: R I Rᵀ.

    Parameters
    ----------
    tensor : array_like, shape (3, 3)
        [kg m²]
    rotation : array_like, shape (3, 3)
        Turns components in the old axes into components in the new ones: its rows are the unit vectors of
        the new axes; with sympy ``new.dcm(old)``.

    Returns
    -------
    ndarray or sympy.Matrix, shape (3, 3)

    Raises
    ------
    EngdynError
        Rows (given as numbers) that are not unit vectors square to each other, or form a left-handed set.

    Notes
    -----
    Section B.3.
    """
    tensor, R = as_tensor(as_rows(tensor)), as_tensor(as_rows(rotation))
    if isinstance(R, np.ndarray):
        if not np.allclose(R @ R.T, np.eye(3), atol=1e-9):
            raise EngdynError(
                "rotation is not orthogonal: its rows must be unit vectors, square to each other"
            )
        if np.linalg.det(R) < 0:
            raise EngdynError("rotation is a mirror image, not a rotation: its axes are left-handed")
    if isinstance(tensor, np.ndarray) and isinstance(R, np.ndarray):
        return R @ tensor @ R.T
    R = sm.Matrix(R)
    return R * sm.Matrix(tensor) * R.T


@dataclass(frozen=True, eq=False)
class PrincipalAxes:
    """Principal moments of inertia and their axes.

    Attributes
    ----------
    moments : ndarray, shape (3,)
        In rising order [kg m²].
    axes : ndarray, shape (3, 3)
        Unit vectors as columns, right-handed. Its transpose is the rotation that leads to these axes.
    """

    moments: np.ndarray
    axes: np.ndarray

    def __repr__(self) -> str:
        lines = [
            f"  {moment:.4g} kg m² about ({', '.join(f'{x + 0.0:.4g}' for x in np.round(axis, 12))})"
            for moment, axis in zip(self.moments, self.axes.T, strict=True)
        ]
        return "\n".join(["PrincipalAxes:", *lines])


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
    Section B.3. Each axis is turned so that its largest component (of equal ones the first) is positive, the
    third one so that the set is right-handed. Where two moments are equal, every axis in the plane of the
    two is principal, and the pair returned is one of many.
    """
    checked = check_tensor(tensor)
    moments, axes = np.linalg.eigh(checked)
    for k in range(3):
        sizes = np.abs(axes[:, k])
        # Equal components must not be told apart by rounding.
        axes[:, k] *= np.sign(axes[np.argmax(sizes > 0.999999 * sizes.max()), k])
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
    rows = as_rows(tensor)
    if is_symbolic(*(x for row in rows for x in row)):
        raise EngdynError("the inertia tensor must be a 3 × 3 array of numbers: substitute values first")
    array = as_tensor(rows)
    scale = np.max(np.abs(array)) or 1.0
    _check_symmetric(array)
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


def _check_symmetric(array: np.ndarray) -> None:
    if np.max(np.abs(array - array.T)) > 1e-9 * np.max(np.abs(array)):
        raise EngdynError(
            "the inertia tensor is not symmetric: its element (i, j) is −∫ x_i x_j dm, the same as (j, i)"
        )
