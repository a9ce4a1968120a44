"""The ellipsoid that moves as a body does.  Sections B.3 and B.4."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray

from engdyn import shapes
from engdyn.errors import EngdynError
from engdyn.modeling.inertia import principal_axes
from engdyn.plots.drawing import sketch
from engdyn.plots.projection import View
from engdyn.plots.words import number

__all__ = ["equivalent_ellipsoid"]

_ROUND = np.linspace(0.0, 2.0 * np.pi, 121)


def equivalent_ellipsoid(
    mass: float,
    tensor: Any,
    body: Iterable[shapes.Shape] = (),
    center: Sequence[float] = (0.0, 0.0, 0.0),
    *,
    ax: Axes | None = None,
    view: View | None = None,
) -> Axes:
    """Draw the principal axes of a body and the uniform ellipsoid of the same mass and inertia tensor.

    The ellipsoid is long where the body is long: it shows at a glance about which axes the body is hard to
    turn, and no experiment on rigid motion can tell the two apart.

    Parameters
    ----------
    mass : float
        [kg]
    tensor : array_like, shape (3, 3)
        About the mass center [kg m²].
    body : iterable of Shape, optional
        The body itself, drawn below the ellipsoid.
    center : (x, y, z)
        Mass center [m].
    ax : matplotlib.axes.Axes, optional
        Where to draw; default: new axes of a new figure.
    view : View, optional
        From where it is seen.

    Returns
    -------
    matplotlib.axes.Axes

    Raises
    ------
    EngdynError
        A mass that is not positive, a tensor that no body can have.

    Notes
    -----
    Section B.4. Half axes √(5 (J₂ + J₃ − J₁) / 2m) and so on, from J₁ = m (b² + c²)/5. The triangle
    inequality J₁ ≤ J₂ + J₃ is what makes them real; a flat body gives a flat ellipsoid. Axes 1, 2, 3 have rising
    moments.
    """
    if not np.isfinite(mass) or mass <= 0:
        raise EngdynError(f"mass is {mass!r}: give kilograms greater than zero")
    found = principal_axes(tensor)
    view = view or View()
    squares = 2.5 / mass * (np.sum(found.moments) - 2.0 * found.moments)
    half = np.sqrt(np.maximum(squares, 0.0))
    # A flat ellipsoid has no normal on its rim; a paper-thin one has.
    half = np.maximum(half, 1e-4 * np.max(half))
    at = np.array(center, float)
    drawn = [*body, *_outlines(at, found.axes, half, view)]
    for k in range(3):
        tip = at + 1.3 * np.max(half) * found.axes[:, k]
        drawn.append(shapes.VectorArrow(tuple(at), tuple(tip), f"${k + 1}$", role="force"))
    moments = ", ".join(f"J{k + 1} = {number(found.moments[k])} kg m²" for k in range(3))
    sizes = ", ".join(f"{number(1000.0 * h)} mm" for h in half)
    words = f"Principal axes 1, 2, 3 ({moments}) and the uniform ellipsoid of the same mass and inertia."
    return sketch(drawn, f"{words} Its half axes are {sizes}.", ax, view=view)


def _outlines(at: NDArray, axes: NDArray, half: NDArray, view: View) -> list[shapes.Shape]:
    """The rim of the ellipsoid as seen, and the visible halves of its three principal ellipses."""
    # A point A s with |s| = 1 has the normal A⁻ᵀ s, which on the rim is square to the view.
    toward = axes.T @ view.axes[2] / half
    first = np.linalg.svd(toward[None])[2][1:]
    rim = np.cos(_ROUND)[:, None] * first[0] + np.sin(_ROUND)[:, None] * first[1]
    drawn: list[shapes.Shape] = [_curve(at, axes, half, rim, "coordinate")]
    for k in range(3):
        e = np.eye(3)
        u, v = e[(k + 1) % 3], e[(k + 2) % 3]
        start = np.arctan2(v @ toward, u @ toward) - np.pi / 2
        angles = start + _ROUND[:61]
        seen = np.cos(angles)[:, None] * u + np.sin(angles)[:, None] * v
        drawn.append(_curve(at, axes, half, seen, "reference"))
    return drawn


def _curve(at: NDArray, axes: NDArray, half: NDArray, unit: NDArray, role: str) -> shapes.Curve:
    points = at + (unit * half) @ axes.T
    return shapes.Curve(tuple(map(tuple, points)), role=role)
