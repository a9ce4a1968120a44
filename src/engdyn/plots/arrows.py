"""How dimensions, labels and arrows look; the counterpart of ``symbols`` for what is written on a drawing."""

from __future__ import annotations

import math

import numpy as np

from engdyn import shapes
from engdyn.errors import EngdynError
from engdyn.plots.pen import Pen, direction, left_of
from engdyn.plots.projection import arc
from engdyn.plots.symbols import arc_points, trace

__all__: list[str] = []

SHORTEST = 18.0
"""A coordinate arrow shorter than this many points gives way to one that only shows the positive sense."""

SHOWN = 30.0
"""Length of that arrow, in points."""


@trace.register
def _(shape: shapes.Dimension, pen: Pen) -> None:
    start, end = pen.view.project([shape.start, shape.end])
    along = direction(end - start)
    across = left_of(along)
    shift = shape.offset * across
    if shape.offset:
        beyond = math.copysign(4.0 * pen.unit, shape.offset) * across
        for foot in (start, end):
            pen.line([foot + 0.55 * shift, foot + shift + beyond], shape.role, 0.9)
    start, end = start + shift, end + shift
    pen.line([start, end], shape.role, 1.1)
    pen.head(start, -along, shape.role, 8.0)
    pen.head(end, along, shape.role, 8.0)
    side = across if shape.offset >= 0.0 else -across
    pen.text_at([((start + end) / 2, side), ((start + end) / 2, -side)], shape.label, shape.role, 3.0)


@trace.register
def _(shape: shapes.Label, pen: Pen) -> None:
    pen.text(shape.point, shape.text, shape.role, shape.side, 5.0)


@trace.register
def _(shape: shapes.CoordinateArrow, pen: Pen) -> None:
    start, end = pen.view.project([shape.start, shape.end])
    positive = direction(pen.view.project([shape.positive])[0])
    if np.linalg.norm(end - start) < SHORTEST * pen.unit:
        end = start + SHOWN * pen.unit * positive
    tick = 7.0 * pen.unit * left_of(direction(end - start))
    pen.line([start - tick, start + tick], shape.role, 1.8)
    pen.arrow([start, end], shape.role, 2.0)
    out, left = direction(end - start), left_of(direction(end - start))
    places = [(end, out), ((start + end) / 2, left), ((start + end) / 2, -left)]
    pen.text_at(places, shape.label, shape.role, 4.0)


def _turn(shape, pen: Pen, start: float, end: float, weight: float) -> None:
    """Draw an arc with a head at ``end``."""
    steps = max(int(abs(end - start) / 0.05), 8)
    pen.arrow(arc_points(shape, np.linspace(start, end, steps + 1)), shape.role, weight)


@trace.register
def _(shape: shapes.AngleArrow, pen: Pen) -> None:
    end = shape.end
    if abs(end - shape.start) * shape.radius < SHORTEST * pen.unit:
        # At most a quarter turn, however small the radius is on paper.
        end = shape.start + math.copysign(min(SHOWN * pen.unit / shape.radius, math.pi / 2), shape.positive)
    _turn(shape, pen, shape.start, end, 2.0)
    middle = (shape.start + end) / 2
    center, middle = pen.view.project(np.vstack([shape.center, arc_points(shape, np.array([middle]))[0]]))
    pen.text(middle, shape.label, shape.role, direction(middle - center), 5.0)


@trace.register
def _(shape: shapes.ForceArrow, pen: Pen) -> None:
    start, end = pen.view.project([shape.start, shape.end])
    pen.arrow([start, end], shape.role, 2.8, 13.0)
    # Beyond one of the ends, whichever is free, or beside it.
    out, middle = direction(start - end), (start + end) / 2
    places = [(start, out), (end, -out), (middle, left_of(out)), (middle, -left_of(out))]
    pen.text_at(places, shape.label, shape.role, 4.0)


@trace.register
def _(shape: shapes.GravityArrow, pen: Pen) -> None:
    start, end = pen.view.project([shape.start, shape.end])
    pen.arrow([start, end], shape.role, 1.8, 11.0)
    pen.text((start + end) / 2, shape.label, shape.role, left_of(direction(end - start)), 4.0)


@trace.register
def _(shape: shapes.MomentArrow, pen: Pen) -> None:
    _turn(shape, pen, shape.start, shape.end, 2.4)
    # Outside the middle of the arc or outside one of its ends, whichever is free.
    angles = np.array([(shape.start + shape.end) / 2, shape.end, shape.start])
    center, *points = pen.view.project(np.vstack([shape.center, arc_points(shape, angles)]))
    pen.text_at([(point, direction(point - center)) for point in points], shape.label, shape.role, 5.0)


@trace.register
def _(shape: shapes.VectorArrow, pen: Pen) -> None:
    start, end = pen.view.project([shape.start, shape.end])
    way = end - start
    if np.linalg.norm(way) < 2.0 * pen.unit:
        return  # nothing to see, or the vector points at the reader
    # A head is never longer than its vector.
    length = min(12.0, 0.45 * float(np.linalg.norm(way)) / pen.unit)
    pen.arrow([start, end], shape.role, 2.4, length)
    if shape.double:
        pen.head(end - 0.75 * length * pen.unit * direction(way), way, shape.role, length)
    out, middle = direction(way), (start + end) / 2
    places = [(end, out), (middle, left_of(out)), (middle, -left_of(out))]
    pen.text_at(places, shape.label, shape.role, 4.0)


@trace.register
def _(shape: shapes.Triad, pen: Pen) -> None:
    size = len(shape.origin)
    axes = [direction(axis) for axis in shape.axes]
    if any(len(axis) != size for axis in axes):
        raise EngdynError(f"Triad: origin {shape.origin} and axes {shape.axes} differ in their dimensions.")
    for axis, label in zip(axes, shape.labels, strict=False):
        end = np.array(shape.origin) + shape.length * axis
        start, tip = pen.view.project([shape.origin, end])
        if np.linalg.norm(tip - start) < 2.0 * pen.unit:
            continue
        pen.arrow([start, tip], shape.role, 1.8, 9.0)
        pen.text(tip, label, shape.role, direction(tip - start), 3.0)
    if size == 2 and len(shape.labels) > len(axes):
        around = arc(shape.origin, 5.0 * pen.unit, np.linspace(0.0, 2.0 * math.pi, 25))
        pen.area(around, shape.role, 1.4, "paper")
        pen.area(
            arc(shape.origin, 1.6 * pen.unit, np.linspace(0.0, 2.0 * math.pi, 13)), shape.role, 0.6, "role"
        )
        pen.text(shape.origin, shape.labels[-1], shape.role, -sum(axes), 7.0)
