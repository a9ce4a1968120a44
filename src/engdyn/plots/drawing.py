"""Draws a system: its shapes, given as data, become one picture with equal scales on both axes."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.colors import to_rgba
from numpy.typing import ArrayLike, NDArray

from engdyn.errors import EngdynError
from engdyn.plots import arrows as _arrows  # noqa: F401  (registers how arrows and labels look)
from engdyn.plots.alternative import describe
from engdyn.plots.labels import SIZE, place
from engdyn.plots.look import COLORS, FILL, new_figure, style
from engdyn.plots.pen import Area, Line, Pen
from engdyn.plots.projection import View
from engdyn.plots.symbols import trace
from engdyn.plots.words import pose as pose_in_words
from engdyn.shapes import Shape

if TYPE_CHECKING:
    from engdyn.system import System

__all__ = ["Layer", "draw", "draw_layers", "drawing_axes", "shown_pose", "sketch", "structure"]

STRUCTURE = ("body", "link", "spring", "damper", "joint", "ground")
"""Roles that remain when a pose is drawn faintly: what is there, without what is written on it."""

MARGIN = (26.0, 26.0)
"""Room for labels at the sides of the shapes, and above and below them, in points."""

LARGEST, SMALLEST = (7.0, 5.6), (3.0, 2.4)
"""Limits of the width and height of a figure made for a drawing, in inches."""


@dataclass(frozen=True)
class Layer:
    """One pose in a picture: faint is pale and without labels, dashed has broken outlines, unfilled."""

    shapes: Sequence[Shape]
    faint: bool = False
    dashed: bool = False

    @property
    def visible(self) -> list[Shape]:
        """The shapes that this layer shows."""
        return structure(self.shapes) if self.faint else list(self.shapes)


def structure(shapes: Iterable[Shape]) -> list[Shape]:
    """Return bodies, connections and ground without what is written on them."""
    kept = (shape for shape in shapes if shape.role in STRUCTURE)
    return [replace(shape, label="") if getattr(shape, "label", "") else shape for shape in kept]


def draw(
    system: System,
    q: ArrayLike | None = None,
    values: Mapping[str, float] | None = None,
    ax: Axes | None = None,
    faint: bool = False,
    *,
    view: View | None = None,
    labels: bool = True,
) -> Axes:
    """Draw a system in one pose.

    Course appendix A: every system as drawn from the parameters of its own model.

    Parameters
    ----------
    system : System
    q : array_like, shape (n,), optional
        Coordinates in the order of ``system.coordinates`` (m or rad); default: a pose that shows them.
    values : mapping of str to float, optional
        Parameter values in SI units; what is not given has its default.
    ax : matplotlib.axes.Axes, optional
        Where to draw; default: new axes of a new figure. A pose drawn into axes that hold one joins it.
    faint : bool
        Draw the structure only, pale, as a background.
    view : View, optional
        From where a system in space is seen.
    labels : bool
        Write the labels.

    Returns
    -------
    matplotlib.axes.Axes

    Raises
    ------
    EngdynError
        ``q`` has the wrong length or is not finite; ParameterError for ``values`` that are not admissible.
    """
    values = system.values(**dict(values or {}))
    q = shown_pose(system) if q is None else checked_pose(system, q)
    layers = [Layer(system.shapes(q, values), faint)]
    ax = drawing_axes(layers, view) if ax is None else ax
    draw_layers(ax, layers, view=view, labels=labels, keep=True)
    kind = "Faint drawing" if faint else "Drawing"
    describe(ax, f"{kind} of {system.title} at {pose_in_words(system.coordinates, q)}.", add=True)
    return ax


def sketch(
    shapes: Iterable[Shape],
    words: str,
    ax: Axes | None = None,
    *,
    view: View | None = None,
    labels: bool = True,
    letters: float = SIZE,
) -> Axes:
    """Draw any list of shapes: a figure of a text, a diagram of vectors, one's own machine.

    Parameters
    ----------
    shapes : iterable of Shape
        From :mod:`engdyn.shapes`, in meters.
    words : str
        The picture in a sentence or two, for readers who cannot see it.
    ax : matplotlib.axes.Axes, optional
        Where to draw; default: new axes of a new figure. A sketch drawn into axes that hold one joins it.
    view : View, optional
        From where shapes in space are seen.
    labels : bool
        Write the labels.
    letters : float
        Size of the letters in points.

    Returns
    -------
    matplotlib.axes.Axes

    Raises
    ------
    EngdynError
        No words, or something that is no shape.
    """
    if not isinstance(words, str) or not words.strip():
        raise EngdynError("sketch: say in words what the picture shows; some readers cannot see it.")
    layers = [Layer(tuple(shapes))]
    ax = drawing_axes(layers, view) if ax is None else ax
    draw_layers(ax, layers, view=view, labels=labels, keep=True, size=letters)
    describe(ax, words, add=True)
    return ax


def checked_pose(system: System, q: ArrayLike) -> NDArray[np.float64]:
    """Return ``q`` as an array, or say why it is no pose of the system."""
    names = ", ".join(coordinate.name for coordinate in system.coordinates)
    pose = np.atleast_1d(np.asarray(q, float))
    if pose.shape != (len(system.coordinates),):
        raise EngdynError(
            f"q has shape {pose.shape}; {system.title} has the coordinates {names}, in this order."
        )
    if not np.all(np.isfinite(pose)):
        raise EngdynError(f"q = {pose.tolist()} is not finite; give numbers for {names}.")
    return pose


def shown_pose(system: System) -> NDArray[np.float64]:
    """Return a pose that shows the coordinates: the system's own, or angles of about 25 degrees."""
    if system.pose is not None:
        return checked_pose(system, system.pose)
    return np.array([_shown_value(coordinate) for coordinate in system.coordinates])


def _shown_value(coordinate) -> float:
    low, high = coordinate.bounds if coordinate.bounds is not None else (-np.inf, np.inf)
    wish = 0.45 if coordinate.unit == "rad" else 0.0
    if not low <= wish <= high:
        wish = 0.5 * (low + high) if np.isfinite(low + high) else (low if np.isfinite(low) else high)
    return float(wish)


def drawing_axes(
    layers: Sequence[Layer], view: View | None = None, margin: tuple[float, float] = MARGIN
) -> Axes:
    """Make axes without frame that fill a new figure, sized within limits as the layers ask for."""
    corners = _corners(layers, 1e-9, view or View())
    wish = np.ptp(corners, axis=0) if len(corners) else np.ones(2)
    rim = 2.0 * np.array(margin) / 72.0
    size = wish / max(np.max(wish / (np.array(LARGEST) - rim)), 1e-30) + rim
    width, height = np.maximum(size, SMALLEST)
    return new_figure(width, height, layout=None).add_axes((0.0, 0.0, 1.0, 1.0))


def _corners(layers: Sequence[Layer], unit: float, view: View) -> NDArray[np.float64]:
    """All picture points of the layers, shape (N, 2), in meters."""
    return np.vstack([np.empty((0, 2)), *(_traced(layer, unit, view).points() for layer in layers)])


def draw_layers(
    ax: Axes,
    layers: Iterable[Layer],
    view: View | None = None,
    labels: bool = True,
    keep: bool = False,
    margin: tuple[float, float] = MARGIN,
    size: float = SIZE,
) -> None:
    """Draw poses on top of each other at one common scale; labels only for the poses that are not faint.

    Parameters
    ----------
    ax : matplotlib.axes.Axes
    layers : iterable of Layer
        The first is drawn first.
    view : View, optional
        From where a system in space is seen.
    labels : bool
        Write the labels.
    keep : bool
        Keep what the present limits of the axes show in sight.
    margin : (float, float)
        Room for labels at the sides, and above and below, in points.
    size : float
        Size of the letters in points.
    """
    layers, view = list(layers), view or View()
    with style():
        unit = _frame(ax, layers, view, keep and bool(ax.collections), margin)
        marks, texts = [], []
        for depth, layer in enumerate(layers):
            pen = _traced(layer, unit, view)
            _ink(ax, pen, layer, -20.0 * (len(layers) - depth) * layer.faint)
            marks += [*pen.lines, *pen.areas]
            texts += pen.texts if labels and not layer.faint else []
        place(ax, texts, marks, unit, size)


def _traced(layer: Layer, unit: float, view: View) -> Pen:
    pen = Pen(unit, view)
    for shape in layer.visible:
        trace(shape, pen)
    return pen


def _frame(ax: Axes, layers: Sequence[Layer], view: View, keep: bool, margin: tuple[float, float]) -> float:
    """Set equal scales and limits that hold all layers; return meters per typographic point."""
    ax.set_axis_off()
    box = ax.get_position()
    root = ax.get_figure(root=True)
    paper = 72.0 * root.get_size_inches() * (box.width, box.height)
    room = np.maximum(paper - 2.0 * np.array(margin), 0.4 * paper)
    # Symbols of fixed size on paper widen the drawing a little, so the scale is found in two steps.
    unit = 0.0
    for _ in range(3):
        corners = _corners(layers, unit or 1e-9, view)
        if keep:
            corners = np.vstack([corners, np.array([ax.get_xlim(), ax.get_ylim()]).T])
        low, high = (corners.min(axis=0), corners.max(axis=0)) if len(corners) else (np.zeros(2), np.ones(2))
        unit = max(float(np.max((high - low) / room)), 1e-9)
    middle, half = (low + high) / 2, 0.5 * unit * paper
    ax.set_xlim(middle[0] - half[0], middle[0] + half[0])
    ax.set_ylim(middle[1] - half[1], middle[1] + half[1])
    ax.set_aspect("equal", adjustable="datalim")
    return unit


def _ink(ax: Axes, pen: Pen, layer: Layer, shift: float) -> None:
    """Hand lines and areas over to matplotlib, one collection for each level."""
    for level in sorted({mark.level for mark in (*pen.lines, *pen.areas)}):
        areas = sorted((a for a in pen.areas if a.level == level), key=lambda area: area.depth)
        lines = [line for line in pen.lines if line.level == level]
        if areas:
            ax.add_collection(_areas(areas, layer, level + shift), autolim=False)
        if lines:
            ax.add_collection(_lines(lines, layer, level + shift + 0.05), autolim=False)


def _color(role: str, layer: Layer) -> tuple[float, ...]:
    return to_rgba(COLORS["input"] if layer.dashed else COLORS[role], 0.4 if layer.faint else 1.0)


def _lines(lines: list[Line], layer: Layer, level: float) -> LineCollection:
    dashes = ["--" if layer.dashed else line.dash for line in lines]
    return LineCollection(
        [line.points for line in lines],
        colors=[_color(line.role, layer) for line in lines],
        linewidths=[line.weight for line in lines],
        linestyles=dashes,
        capstyle=None if set(dashes) != {"-"} else "round",
        zorder=level,
    )


def _areas(areas: list[Area], layer: Layer, level: float) -> PolyCollection:
    fills = [COLORS[area.role] if area.fill == "role" else FILL[area.fill] for area in areas]
    opacity = 0.0 if layer.dashed else (0.35 if layer.faint else 1.0)
    return PolyCollection(
        [area.points for area in areas],
        facecolors=[to_rgba(fill, opacity) for fill in fills],
        edgecolors=[_color(area.role, layer) for area in areas],
        linewidths=[area.weight for area in areas],
        linestyles="--" if layer.dashed else "-",
        zorder=level,
    )
