"""A motion in one picture: several poses on top of each other, early ones faint, the last one strong."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray

from engdyn.plots.drawing import Layer, _frame, _ink, _traced
from engdyn.plots.look import style
from engdyn.plots.projection import View
from engdyn.plots.stage import MARGIN, page, place_of_heading
from engdyn.shapes import Shape

__all__ = ["apart", "draw_strobe", "features"]

FAINT = (0.16, 0.5)
"""Opacity of the first pose and of the last but one."""


def draw_strobe(drawings: Sequence[Sequence[Shape]], heading: str, ax: Axes | None, view: View) -> Axes:
    """Draw poses on top of each other, from faint to strong, at one scale.

    Parameters
    ----------
    drawings : sequence of lists of Shape
        The system in each pose, the first drawn first.
    heading : str
        What stands above the picture.
    ax : matplotlib.axes.Axes, optional
        Where to draw; default: new axes of a new figure.
    view : View
        From where a system in space is seen.

    Returns
    -------
    matplotlib.axes.Axes
    """
    layers = [Layer(shapes) for shapes in drawings]
    ax = page(layers, view) if ax is None else ax
    strengths = [*np.linspace(*FAINT, len(layers))[:-1], 1.0]
    with style():
        unit = _frame(ax, layers, view, False, MARGIN)
        for depth, (layer, strength) in enumerate(zip(layers, strengths, strict=True), 1 - len(layers)):
            before = set(ax.collections)
            _ink(ax, _traced(layer, unit, view), layer, 20.0 * depth)
            for artist in set(ax.collections) - before:
                artist.set_alpha(strength)
        ax.set_title(heading, loc="left", **place_of_heading(ax))
    return ax


def features(coordinates: Sequence[Any], q: NDArray[np.float64], size: float) -> NDArray[np.float64]:
    """Return numbers that tell poses apart: lengths over the size of the drawing, angles as points of a circle."""
    turns = np.array([coordinate.unit == "rad" for coordinate in coordinates])
    return np.hstack([q[:, ~turns] / size, np.cos(q[:, turns]), np.sin(q[:, turns])])


def apart(features: NDArray[np.float64], count: int) -> list[int]:
    """Return up to ``count`` rows, first and last among them, each far from those chosen before; in order."""
    chosen = [0] if count == 1 or len(features) == 1 else [0, len(features) - 1]
    distance = np.min([np.linalg.norm(features - features[k], axis=1) for k in chosen], axis=0)
    while len(chosen) < count and np.max(distance) > 1e-6:
        chosen.append(int(np.argmax(distance)))
        distance = np.minimum(distance, np.linalg.norm(features - features[chosen[-1]], axis=1))
    return sorted(chosen)
