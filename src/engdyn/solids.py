"""Inertia tensors of common bodies about their mass centers.  Section B.4.

Dimensions may be numbers or sympy expressions.  The axis of a body of revolution is z.  Every
formula is tested against numerical integration.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import sympy as sm

from engdyn.errors import EngdynError
from engdyn.modeling.inertia import check_tensor, parallel_axis, rotate_tensor
from engdyn.modeling.tensors import as_tensor, check_positive, checked_entry, is_symbolic

__all__ = [
    "Composite",
    "box",
    "composite",
    "cone",
    "cylinder",
    "disc",
    "ellipsoid",
    "plate",
    "rod",
    "shell",
    "sphere",
    "tube",
]


def _share(above: int, below: int, *values: Any) -> Any:
    """A fraction, exact where the values are symbols."""
    return sm.Rational(above, below) if is_symbolic(*values) else above / below


def _diagonal(x: Any, y: Any, z: Any) -> Any:
    return as_tensor([[x, 0, 0], [0, y, 0], [0, 0, z]])


def rod(mass: Any, length: Any) -> Any:
    """Thin uniform rod along z [kg m²]."""
    check_positive(mass=mass, length=length)
    across = _share(1, 12, mass, length) * mass * length**2
    return _diagonal(across, across, 0)


def plate(mass: Any, a: Any, b: Any) -> Any:
    """Thin rectangular plate in the x-y plane, sides `a` along x and `b` along y."""
    check_positive(mass=mass, a=a, b=b)
    k = _share(1, 12, mass, a, b) * mass
    return _diagonal(k * b**2, k * a**2, k * (a**2 + b**2))


def box(mass: Any, a: Any, b: Any, c: Any) -> Any:
    """Solid box with sides `a`, `b`, `c` along x, y, z."""
    check_positive(mass=mass, a=a, b=b, c=c)
    k = _share(1, 12, mass, a, b, c) * mass
    return _diagonal(k * (b**2 + c**2), k * (c**2 + a**2), k * (a**2 + b**2))


def disc(mass: Any, radius: Any) -> Any:
    """Thin disc, axis z."""
    check_positive(mass=mass, radius=radius)
    across = _share(1, 4, mass, radius) * mass * radius**2
    return _diagonal(across, across, 2 * across)


def cylinder(mass: Any, radius: Any, length: Any) -> Any:
    """Solid cylinder, axis z."""
    check_positive(mass=mass, radius=radius, length=length)
    across = _share(1, 12, mass, radius, length) * mass * (3 * radius**2 + length**2)
    return _diagonal(across, across, _share(1, 2, mass, radius) * mass * radius**2)


def tube(mass: Any, outer: Any, inner: Any, length: Any) -> Any:
    """Hollow cylinder with outer and inner radius, axis z; equal radii make a thin tube."""
    check_positive(mass=mass, outer=outer, length=length)
    check_positive(zero=True, inner=inner)
    if not is_symbolic(outer, inner) and inner > outer:
        raise EngdynError(f"the inner radius {inner:g} m exceeds the outer radius {outer:g} m: exchange them")
    squares = outer**2 + inner**2
    across = _share(1, 12, mass, outer, inner, length) * mass * (3 * squares + length**2)
    return _diagonal(across, across, _share(1, 2, mass, outer, inner) * mass * squares)


def sphere(mass: Any, radius: Any) -> Any:
    """Solid sphere."""
    check_positive(mass=mass, radius=radius)
    moment = _share(2, 5, mass, radius) * mass * radius**2
    return _diagonal(moment, moment, moment)


def shell(mass: Any, radius: Any) -> Any:
    """Thin spherical shell."""
    check_positive(mass=mass, radius=radius)
    moment = _share(2, 3, mass, radius) * mass * radius**2
    return _diagonal(moment, moment, moment)


def cone(mass: Any, radius: Any, height: Any) -> Any:
    """Solid cone, axis z, about its mass center (a quarter of the height above the base)."""
    check_positive(mass=mass, radius=radius, height=height)
    across = _share(3, 80, mass, radius, height) * mass * (4 * radius**2 + height**2)
    return _diagonal(across, across, _share(3, 10, mass, radius) * mass * radius**2)


def ellipsoid(mass: Any, a: Any, b: Any, c: Any) -> Any:
    """Solid ellipsoid with half axes `a`, `b`, `c` along x, y, z."""
    check_positive(mass=mass, a=a, b=b, c=c)
    k = _share(1, 5, mass, a, b, c) * mass
    return _diagonal(k * (b**2 + c**2), k * (c**2 + a**2), k * (a**2 + b**2))


@dataclass(frozen=True, eq=False)
class Composite:
    """A body made of parts.

    Attributes
    ----------
    mass : float or sympy.Expr
        [kg]
    center : tuple of three
        Mass center [m].
    tensor : ndarray or sympy.Matrix, shape (3, 3)
        About the mass center, in the common axes [kg m²].
    """

    mass: Any
    center: tuple[Any, ...]
    tensor: Any

    def __repr__(self) -> str:
        if is_symbolic(self.mass, *self.center) or not isinstance(self.tensor, np.ndarray):
            return f"Composite(mass={self.mass}, center={self.center}, tensor={self.tensor})"
        center = ", ".join(f"{round(x, 12) + 0.0:.4g}" for x in self.center)
        tensor = self.tensor + 0.0  # -0 reads as 0
        rows = np.array2string(tensor, precision=4, suppress_small=True, prefix="  tensor about it ")
        return f"Composite: {self.mass:.4g} kg, center at ({center}) m\n  tensor about it {rows} kg m²"


def composite(parts: Sequence[Sequence[Any]], holes: Sequence[Sequence[Any]] = ()) -> Composite:
    """A body made of several parts, less what was cut out of them.

    Parameters
    ----------
    parts : sequence of (mass, tensor, center) or (mass, tensor, center, rotation)
        Mass [kg], tensor of the part about its own mass center [kg m²], place of that center [m]. The
        tensor is in axes parallel to the common ones, or in the part's own axes with `rotation`, the
        3 × 3 matrix whose columns are these axes (sympy: ``common.dcm(own)``).
    holes : sequence of the same, optional
        What is missing: mass and tensor of the material that would fill the hole, both positive.

    Returns
    -------
    Composite

    Raises
    ------
    EngdynError
        No parts, a part that is not of this form, a mass that is not positive, holes heavier than the
        parts or so large that no body remains.

    Notes
    -----
    Section B.4. Mass center first, then each part by the parallel-axis theorem to that point, a hole with
    a minus sign.

    Examples
    --------
    >>> from engdyn import solids
    >>> ring = solids.composite([(4.0, solids.disc(4.0, 2.0), (0, 0, 0))], [(1.0, solids.disc(1.0, 1.0), (0, 0, 0))])
    >>> ring.mass, float(ring.tensor[2, 2])
    (3.0, 7.5)
    """
    signed = [(1, *_part(part, "part")) for part in parts] + [(-1, *_part(hole, "hole")) for hole in holes]
    if not parts:
        raise EngdynError("composite: give at least one part (mass, tensor, center)")
    mass = _plain(sum(sign * m for sign, m, _, _ in signed))
    if not is_symbolic(mass) and float(mass) <= 0:
        raise EngdynError(f"composite: the total mass is {float(mass):g} kg: the holes outweigh the parts")
    center = tuple(_plain(sum(sign * m * c[i] for sign, m, _, c in signed) / mass) for i in range(3))
    total: Any = as_tensor([[0, 0, 0]] * 3)
    for sign, m, tensor, c in signed:
        moved = parallel_axis(tensor, m, [a - b for a, b in zip(c, center, strict=True)])
        # A sympy matrix and an array do not add.
        rows = zip(total.tolist(), moved.tolist(), strict=True)
        total = as_tensor([[a + sign * b for a, b in zip(x, y, strict=True)] for x, y in rows])
    if holes and not is_symbolic(*(x for row in total.tolist() for x in row)):
        check_tensor(total)
    return Composite(mass, center, total)


def _plain(value: Any) -> Any:
    return value if is_symbolic(value) else float(value)


def _part(part: Sequence[Any], what: str) -> tuple[Any, Any, tuple[Any, ...]]:
    """Mass, tensor in the common axes, and center of one part."""
    if not isinstance(part, Sequence) or len(part) not in (3, 4) or len(tuple(part[2])) != 3:
        raise EngdynError(f"composite: a {what} is (mass, tensor, center (x, y, z)) and perhaps a rotation")
    mass, tensor, center = part[0], part[1], tuple(part[2])
    for x in center:
        checked_entry(x, f"composite: a coordinate of the center {center}")
    try:
        check_positive(mass=mass)
    except EngdynError as error:
        raise EngdynError(
            f"composite: {error}; what is cut out belongs in holes=, with its positive mass"
        ) from error
    return mass, tensor if len(part) == 3 else rotate_tensor(tensor, part[3]), center
