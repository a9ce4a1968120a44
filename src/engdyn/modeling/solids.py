"""Inertia tensors of common bodies about their mass centers.  Section B.4.

Dimensions may be numbers or sympy expressions.  The axis of a body of revolution is z.  Every
formula is tested against numerical integration.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import sympy as sm

from engdyn.errors import EngdynError
from engdyn.modeling.inertia import as_tensor, check_positive, is_symbolic, parallel_axis

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
    center: tuple[Any, Any, Any]
    tensor: Any


def composite(parts: Sequence[tuple[Any, Any, Sequence[Any]]]) -> Composite:
    """A body made of several, in common axes; a hole is a part with negative mass and tensor.

    Parameters
    ----------
    parts : sequence of (mass, tensor, center)
        Tensor of each part about its own mass center [kg m²], in axes common to all; center [m].

    Raises
    ------
    EngdynError
        No parts, or a total mass of zero.
    """
    if not parts:
        raise EngdynError("composite: give at least one part (mass, tensor, center)")
    mass = sum(part[0] for part in parts)
    if not is_symbolic(mass) and float(mass) <= 0:
        raise EngdynError(f"composite: the total mass is {float(mass):g} kg: it must be greater than zero")
    center = tuple(sum(m * c[i] for m, _, c in parts) / mass for i in range(3))
    total: Any = None
    for m, tensor, c in parts:
        sign = 1 if is_symbolic(m) or m >= 0 else -1
        arm = [a - b for a, b in zip(c, center, strict=True)]
        moved = parallel_axis(sign * tensor, sign * m, arm)
        total = sign * moved if total is None else total + sign * moved
    return Composite(mass, center, total)
