"""The stage of a moving drawing: one figure, drawn into again and again, in which only the system moves."""

from __future__ import annotations

import io
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray
from PIL import Image

from engdyn.errors import EngdynError
from engdyn.plots.drawing import Layer, _frame, _ink, _traced, drawing_axes
from engdyn.plots.look import style
from engdyn.plots.pen import direction, left_of
from engdyn.plots.projection import View
from engdyn.shapes import Ground, Shape

__all__ = ["MARGIN", "Stage", "encoded", "lasting_ground", "page", "place_of_heading", "size_of"]

MARGIN, HEADING = (12.0, 12.0), 24.0
"""Room around the moving drawing, and above it for the time, in points."""

DPI = 80
"""Resolution of the frames, in dots per inch: small, since there are many of them."""


class Stage:
    """One figure that is drawn into again and again: page, scale and limits stay, the system moves.

    Parameters
    ----------
    drawings : sequence of lists of Shape
        The system in all its poses; together they decide about scale and limits.
    view : View
        From where a system in space is seen.
    """

    def __init__(self, drawings: Sequence[Sequence[Shape]], view: View) -> None:
        self._view = view
        layers = [Layer(drawings[k]) for k in sorted(outermost(drawings, view))]
        self._ax = page(layers, view)
        self._figure = self._ax.get_figure(root=True)
        self._figure.set_dpi(DPI)
        with style():
            self._unit = _frame(self._ax, layers, view, False, MARGIN)
            self._heading = self._ax.set_title("", loc="left", animated=True, **place_of_heading(self._ax))
            self._figure.canvas.draw()
        self._empty = self._figure.canvas.copy_from_bbox(self._figure.bbox)

    def picture(self, shapes: Sequence[Shape], heading: str) -> NDArray[np.uint8]:
        """Draw the system in one pose and return the picture, shape (height, width, 3)."""
        canvas, ax, layer = self._figure.canvas, self._ax, Layer(shapes)
        with style():
            canvas.restore_region(self._empty)
            self._heading.set_text(heading)
            _ink(ax, _traced(layer, self._unit, self._view), layer, 0.0)
            for artist in [*sorted(ax.collections, key=lambda one: one.get_zorder()), self._heading]:
                self._figure.draw_artist(artist)
            for artist in list(ax.collections):
                artist.remove()
        return np.asarray(canvas.buffer_rgba())[..., :3].copy()


def outermost(drawings: Sequence[Sequence[Shape]], view: View) -> set[int]:
    """Return which drawings reach furthest to the left, down, to the right and up."""
    points = [_traced(Layer(shapes), 1e-9, view).points() for shapes in drawings]
    boxes = np.array([[*-p.min(axis=0), *p.max(axis=0)] for p in points if len(p)])
    if len(boxes) < len(drawings):
        raise EngdynError("there is a pose in which nothing is drawn: shapes(q, values) must return bodies.")
    return {int(k) for k in np.argmax(boxes, axis=0)}


def lasting_ground(drawings: Sequence[Sequence[Shape]]) -> dict[int, Ground]:
    """Return what stands for the ground in all drawings: place in the list → the longest stretch of each line.

    Many a drawing ends its ground a little beyond the bodies; in a film that end would move with them.
    """
    if len({len(shapes) for shapes in drawings}) != 1:
        return {}
    stretches = ((i, _stretch(row)) for i, row in enumerate(zip(*drawings, strict=True)))
    return {i: stretch for i, stretch in stretches if stretch is not None}


def _stretch(row: Sequence[Shape]) -> Ground | None:
    """Return one ground that covers those of all drawings, if they lie on one line in the plane."""
    if not all(isinstance(shape, Ground) and len(shape.start) == len(shape.end) == 2 for shape in row):
        return None
    ends = np.array([(shape.start, shape.end) for shape in row])
    origin, along = ends[0, 0], direction(ends[0, 1] - ends[0, 0])
    way, off = (ends - origin) @ along, (ends - origin) @ left_of(along)
    if np.max(abs(off)) > 1e-9 * max(np.max(abs(way)), 1.0) or np.any(way[:, 0] > way[:, 1]):
        return None
    start, end = (tuple(map(float, origin + x * along)) for x in (way.min(), way.max()))
    return replace(row[0], start=start, end=end)


def size_of(shapes: Sequence[Shape], view: View) -> float:
    """Return the width or height of a drawing [m], whichever is larger."""
    points = _traced(Layer(shapes), 1e-9, view).points()
    return float(np.max(np.ptp(points, axis=0))) if len(points) else 1.0


def page(layers: Sequence[Layer], view: View) -> Axes:
    """Make axes for these layers, with room above them for a heading."""
    ax = drawing_axes(layers, view, MARGIN)
    figure = ax.get_figure(root=True)
    width, height = figure.get_size_inches()
    figure.set_size_inches(width, height + HEADING / 72.0)
    ax.set_position((0.0, 0.0, 1.0, height / (height + HEADING / 72.0)))
    return ax


def place_of_heading(ax: Axes) -> dict[str, float]:
    """Return where the heading stands: a little to the right of the edge of the page."""
    width = 72.0 * ax.get_figure(root=True).get_figwidth() * ax.get_position().width
    return {"x": MARGIN[0] / width, "pad": 3.0}


def encoded(picture: NDArray[np.uint8]) -> bytes:
    """Return a picture as PNG; light compression, because speed matters more than size here."""
    stream = io.BytesIO()
    Image.fromarray(picture).save(stream, "png", compress_level=1)
    return stream.getvalue()
