"""What moments and products of inertia mean: one mass on a bent arm.  Sections 2.10 and B.3."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray

from engdyn import shapes
from engdyn.errors import EngdynError
from engdyn.plots.drawing import sketch
from engdyn.plots.projection import View
from engdyn.plots.words import number

__all__ = ["inertia_terms"]

AXES = "xyz"

_SHOWN = View(math.radians(-62.0), math.radians(22.0))
"""x to the right, y away from the eye, z upward."""


def inertia_terms(
    position: Sequence[float],
    axis: str = "x",
    about: str | None = None,
    *,
    motion: str = "acceleration",
    ax: Axes | None = None,
    view: View | None = None,
) -> Axes:
    r"""Draw one mass on a bent, massless arm, and the moment that one element of its inertia tensor stands for.

    The shaft lies along ``axis``. When its rotation is accelerated, the mass accelerates across the axis, and
    the force that makes it do so has moments about all three axes. The moment about ``about`` is the element
    (about, axis) of the tensor times the angular acceleration.

    Parameters
    ----------
    position : (x, y, z)
        Of the mass [m], as seen from O on the shaft.
    axis : {"x", "y", "z"}
        About which the arm turns.
    about : {"x", "y", "z"}, optional
        Axis of the moment to explain: that of the shaft gives the moment of inertia, another one a product;
        without it the mass and its arm are drawn alone.
    motion : {"acceleration", "velocity"}
        The arm starts to turn (:math:`\alpha`), or turns evenly (:math:`\omega`).
    ax : matplotlib.axes.Axes, optional
        Where to draw; default: new axes of a new figure.
    view : View, optional
        From where the mass is seen.

    Returns
    -------
    matplotlib.axes.Axes

    Raises
    ------
    EngdynError
        A position that is not three finite numbers or lies at O; an unknown axis or motion.

    Notes
    -----
    Section 2.10, Figures 2.5 to 2.8. All arrows point as force and moment really do; the formulas beside them
    are components along the positive axes, so a minus sign shows as an arrow against the axis.
    Force on the mass: m α × r, or m ω × (ω × r).
    """
    r = _checked(position, axis, about, motion)
    drawn = [*_arm(r, axis), *_turning(r, axis, motion)]
    words = (
        f"A mass m at x = {number(r[0])} m, y = {number(r[1])} m, z = {number(r[2])} m on a bent massless arm that "
        f"is fixed to a shaft along the {axis} axis"
    )
    if about is None:
        words += "; the legs of the arm are the coordinates of the mass."
    else:
        explained, shown = _explained(r, axis, about, motion)
        drawn += shown
        words += (
            f" and {'starts to turn' if motion == 'acceleration' else 'turns evenly'} about it. {explained}"
        )
    return sketch(drawn, words, ax, view=view or _SHOWN)


def _checked(position: Sequence[float], axis: str, about: str | None, motion: str) -> NDArray[np.float64]:
    """Return the position as an array, or say what is wrong with the arguments."""
    try:
        r = np.array([float(x) for x in position])
    except (TypeError, ValueError):
        r = np.empty(0)
    if r.shape != (3,) or not np.all(np.isfinite(r)) or not np.any(r):
        raise EngdynError(f"position is {position!r}: give x, y, z of the mass in meters, not all zero.")
    for name, value in (("axis", axis), ("about", about)):
        if value not in ("x", "y", "z") and not (name == "about" and value is None):
            raise EngdynError(f"{name} is {value!r}: choose 'x', 'y' or 'z'.")
    if motion not in ("acceleration", "velocity"):
        raise EngdynError(f"motion is {motion!r}: choose 'acceleration' or 'velocity'.")
    return r


def _only(r: NDArray, *kept: int) -> tuple[float, ...]:
    """The point with the components ``kept`` of r, the others zero."""
    return tuple(float(x) if i in kept else 0.0 for i, x in enumerate(r))


def _unit(i: int) -> tuple[float, ...]:
    return tuple(float(i == j) for j in range(3))


def _legs(r: NDArray, axis: str) -> list[tuple[tuple[float, ...], tuple[float, ...], str]]:
    """Start, end and coordinate of each leg of the arm: along the shaft first, then across."""
    i = AXES.index(axis)
    j, k = (i + 1) % 3, (i + 2) % 3
    corners = [_only(r), _only(r, i), _only(r, i, j), _only(r, i, j, k)]
    return [
        (start, end, AXES[n])
        for start, end, n in zip(corners, corners[1:], (i, j, k), strict=False)
        if start != end
    ]


def _arm(r: NDArray, axis: str) -> list[shapes.Shape]:
    """The axes, the shaft and the arm, whose legs are the coordinates of the mass."""
    i = AXES.index(axis)
    size = float(np.max(abs(r)))
    drawn: list[shapes.Shape] = [shapes.Link(tuple(-0.7 * size * x for x in _unit(i)), _only(r))]
    for n in range(3):
        # The axis of the shaft is seen beyond the shaft only.
        start = _only(r, n) if n == i and r[n] > 0.0 else _only(r)
        tip = tuple((max(r[n], 0.0) + 0.7 * size) * x for x in _unit(n))
        drawn.append(shapes.CenterLine(start, tip, f"${AXES[n]}$", arrow=True))
    drawn += [shapes.Link(start, end, f"${name}$") for start, end, name in _legs(r, axis)]
    mark = shapes.Label(_only(r), "$O$", (-1.0, 1.0), "reference")
    return [*drawn, shapes.Particle(tuple(r), "$m$"), mark]


def _turn(i: int, at: float, radius: float, sense: float, label: str, role: str) -> shapes.MomentArrow:
    """Three quarters of a turn about axis i, through its point ``at``."""
    center = tuple(at * x for x in _unit(i))
    first, second = _unit((i + 1) % 3), _unit((i + 2) % 3)
    start, end = (-0.5, 4.0) if sense > 0 else (4.0, -0.5)
    return shapes.MomentArrow(center, radius, start, end, label, first, second, role)


def _turning(r: NDArray, axis: str, motion: str) -> list[shapes.Shape]:
    size = float(np.max(abs(r)))
    label = r"$\alpha$" if motion == "acceleration" else r"$\omega$"
    return [_turn(AXES.index(axis), -0.45 * size, 0.18 * size, 1.0, label, "coordinate")]


def _force(r: NDArray, axis: str, motion: str) -> tuple[NDArray[np.float64], list[str]]:
    """Force on a unit mass for a unit motion, and its components as formulas."""
    i = AXES.index(axis)
    j, k = (i + 1) % 3, (i + 2) % 3
    e = np.array(_unit(i))
    force = np.cross(e, r) if motion == "acceleration" else np.cross(e, np.cross(e, r))
    text = ["0", "0", "0"]
    if motion == "acceleration":
        text[j], text[k] = rf"-m\,{AXES[k]}\,\alpha", rf"m\,{AXES[j]}\,\alpha"
    else:
        text[j], text[k] = rf"-m\,{AXES[j]}\,\omega^2", rf"-m\,{AXES[k]}\,\omega^2"
    return force, text


def _moment_text(axis: str, about: str, motion: str) -> str:
    """The moment about an axis as a formula."""
    i, a = AXES.index(axis), AXES.index(about)
    j, k = AXES[(i + 1) % 3], AXES[(i + 2) % 3]
    if motion == "acceleration":
        return (
            rf"m\,({j}^2+{k}^2)\,\alpha" if a == i else rf"-m\,{min(axis, about)}\,{max(axis, about)}\,\alpha"
        )
    if a == i:
        return "0"
    return rf"m\,{axis}\,{k}\,\omega^2" if about == j else rf"-m\,{axis}\,{j}\,\omega^2"


def _explained(r: NDArray, axis: str, about: str, motion: str) -> tuple[str, list[shapes.Shape]]:
    """The force components that have a moment about an axis, their lever arms, and the moment."""
    a = AXES.index(about)
    force, text = _force(r, axis, motion)
    size = float(np.max(abs(r)))
    longest = float(np.max(abs(force))) or 1.0
    legs = [leg[:2] for leg in _legs(r, axis)]
    drawn: list[shapes.Shape] = []
    said = []
    for f in range(3):
        lever = 3 - a - f
        if f == a or f == AXES.index(axis) or r[lever] == 0.0 or force[f] == 0.0:
            continue
        end = _only(r, a, lever)
        tip = r + 0.6 * size * force[f] / longest * np.array(_unit(f))
        drawn += [
            shapes.CenterLine(tuple(r), end),
            shapes.Dimension(_only(r, a), end, "" if (_only(r, a), end) in legs else f"${AXES[lever]}$"),
            shapes.ForceArrow(tuple(r), tuple(tip), f"$F_{AXES[f]} = {text[f]}$"),
        ]
        said.append(
            f"The force component F_{AXES[f]} = {_plain(text[f])} acts on the mass with the arm {AXES[lever]}."
        )
    moment = float(np.cross(r, force)[a])
    formula = _moment_text(axis, about, motion)
    if moment == 0.0:
        said.append(f"There is no moment about the {about} axis.")
        return " ".join(said), drawn
    sense = math.copysign(1.0, moment)
    at = max(float(r[a]), 0.0) + 0.4 * size
    drawn.append(_turn(a, at, 0.18 * size, sense, f"$M_{about} = {formula}$", "input"))
    way = "along" if sense > 0 else "against"
    said.append(f"The moment about the {about} axis is M_{about} = {_plain(formula)}, here {way} the axis.")
    return " ".join(said), drawn


def _plain(formula: str) -> str:
    """A formula of these pictures in plain letters."""
    swaps = {r"\,": " ", r"\alpha": "α", r"\omega": "ω", "^2": "²", "-": "−", "+": " + "}
    for old, new in swaps.items():
        formula = formula.replace(old, new)
    return formula
