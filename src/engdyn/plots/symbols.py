"""How each shape looks: one small function per shape tells the pen what to draw."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import singledispatch
from typing import Any

import numpy as np
from numpy.typing import NDArray

from engdyn import shapes
from engdyn.errors import EngdynError
from engdyn.plots.pen import LEVELS, Pen, direction, left_of
from engdyn.plots.projection import arc, box_faces

__all__ = ["arc_points", "trace"]


@singledispatch
def trace(shape: object, pen: Pen) -> None:
    """Draw one shape with the pen.

    Raises
    ------
    EngdynError
        The object is no shape of ``engdyn.shapes``.
    """
    raise EngdynError(f"{shape!r} cannot be drawn; a drawing is a list of shapes of engdyn.shapes.")


def arc_points(shape: Any, angles: NDArray) -> NDArray[np.float64]:
    """Return points of a round shape at ``angles`` [rad], shape (N, 2 or 3), in meters."""
    return arc(shape.center, shape.radius, angles, shape.x_axis, shape.y_axis)


ABOVE_BODIES = LEVELS["joint"] - 0.2
"""Rotary springs and dampers stand on the bodies they turn."""

_CIRCLE = np.linspace(0.0, 2.0 * math.pi, 61)


@trace.register
def _(shape: shapes.Polygon, pen: Pen) -> None:
    points = np.array(shape.points)
    pen.area(points, shape.role)
    pen.text(points.mean(axis=0), shape.label, "parameter")


@trace.register
def _(shape: shapes.Box, pen: Pen) -> None:
    for face in box_faces(shape):
        pen.area(face, shape.role)
    pen.text(shape.center, shape.label, "parameter")


@trace.register
def _(shape: shapes.Disc, pen: Pen) -> None:
    pen.area(arc_points(shape, _CIRCLE), shape.role)
    if shape.angle is not None:
        rim = arc_points(shape, np.array([shape.angle]))[0]
        pen.line([shape.center, rim], shape.role, 1.2, level=LEVELS["joint"])
    pen.text(shape.center, shape.label, "parameter")


@trace.register
def _(shape: shapes.Particle, pen: Pen) -> None:
    center = pen.view.project([shape.point])[0]
    pen.area(arc(tuple(center), 6.0 * pen.unit, _CIRCLE[::3]), shape.role, fill="ink", at=shape.point)
    pen.text(shape.point, shape.label, "parameter", (1.0, 1.0), 8.0)


@trace.register
def _(shape: shapes.Wheel, pen: Pen) -> None:
    tire = arc(shape.center, shape.radius, _CIRCLE)
    if shape.flat is not None:
        tire[:, 1] = np.maximum(tire[:, 1], shape.flat)
    pen.area(tire, shape.role, 2.2, "tire")
    pen.area(arc(shape.center, 0.58 * shape.radius, _CIRCLE), shape.role, 1.4)
    if shape.angle is not None:
        spoke = arc(shape.center, 0.58 * shape.radius, [shape.angle, shape.angle + math.pi])
        pen.line(spoke, shape.role, 1.2, level=LEVELS["joint"])
    pen.text(shape.center, shape.label, "parameter")


@trace.register
def _(shape: shapes.CenterOfMass, pen: Pen) -> None:
    center = tuple(pen.view.project([shape.point])[0])
    pen.area(arc(center, 5.0 * pen.unit, _CIRCLE[::3]), "body", 1.0, "paper", LEVELS["joint"])
    for start in (0.0, math.pi):
        quarter = arc(center, 5.0 * pen.unit, np.linspace(start, start + math.pi / 2, 7))
        pen.area(np.vstack([center, quarter]), "body", 0.5, "ink", LEVELS["joint"] + 0.1)
    pen.text(shape.point, shape.label, shape.role, (1.0, 1.0), 7.0)


def _beside(shape, pen: Pen, clearance: float, role: str = "parameter") -> None:
    """Write the label of a straight shape beside its middle."""
    start, end = pen.view.project([shape.start, shape.end])
    middle, left = (start + end) / 2, left_of(direction(end - start))
    pen.text_at([(middle, -left), (middle, left)], shape.label, role, clearance)


@trace.register
def _(shape: shapes.Link, pen: Pen) -> None:
    pen.line([shape.start, shape.end], shape.role, 2.6)
    _beside(shape, pen, 5.0)


@trace.register
def _(shape: shapes.Curve, pen: Pen) -> None:
    points = np.array(shape.points)
    pen.line(points, shape.role, 2.2)
    pen.text(points[len(points) // 2], shape.label, "parameter", (1.0, 1.0), 5.0)


def _along(shape, pen: Pen, local: NDArray, width: float) -> NDArray[np.float64]:
    """Map a symbol drawn along (0..1) and across (-1..1) onto the way from start to end."""
    start, end = pen.view.project([shape.start, shape.end])
    across = 0.5 * width * left_of(direction(end - start))
    return start + local[:, :1] * (end - start) + local[:, 1:] * across


@trace.register
def _(shape: shapes.Spring, pen: Pen) -> None:
    width = 15.0 * pen.unit if shape.width is None else shape.width
    turns = 2 * max(int(shape.coils), 1)
    along = np.concatenate([[0.0, 0.14], 0.14 + 0.72 * (np.arange(turns) + 0.5) / turns, [0.86, 1.0]])
    across = np.concatenate([[0.0, 0.0], (-1.0) ** np.arange(turns), [0.0, 0.0]])
    pen.line(_along(shape, pen, np.column_stack([along, across]), width), shape.role)
    _beside(shape, pen, 0.5 * width / pen.unit + 4.0)


def _dashpot(slenderness: float) -> tuple[NDArray[np.float64], ...]:
    """Foot, cylinder, piston and rod along (0..1) and across (-1..1) a dashpot, its length given in widths.

    However far the dashpot is pulled out, its cylinder is at most three widths long.
    """
    half = min(0.21, 1.5 / max(slenderness, 1e-9))
    bottom, mouth, piston = 0.5 - half, 0.5 + half, 0.5 + 0.3 * half
    return (
        np.array([[0.0, 0.0], [bottom, 0.0]]),
        np.array([[mouth, 1.0], [bottom, 1.0], [bottom, -1.0], [mouth, -1.0]]),
        np.array([[piston, 0.72], [piston, -0.72]]),
        np.array([[piston, 0.0], [1.0, 0.0]]),
    )


@trace.register
def _(shape: shapes.Damper, pen: Pen) -> None:
    width = 15.0 * pen.unit if shape.width is None else shape.width
    length = np.linalg.norm(np.diff(pen.view.project([shape.start, shape.end]), axis=0))
    for part, weight in zip(_dashpot(float(length) / width), (1.8, 1.8, 2.8, 1.8), strict=True):
        pen.line(_along(shape, pen, part, width), shape.role, weight)
    _beside(shape, pen, 0.5 * width / pen.unit + 4.0)


def _beside_arc(shape, pen: Pen, clearance: float, role: str) -> None:
    """Write the label of an arc outside its middle."""
    middle = arc_points(shape, np.array([(shape.start + shape.end) / 2]))
    center, middle = pen.view.project([shape.center])[0], pen.view.project(middle)[0]
    pen.text(middle, shape.label, role, direction(middle - center), clearance)


@trace.register
def _(shape: shapes.TorsionalSpring, pen: Pen) -> None:
    angles = np.linspace(shape.start, shape.end + 4.0 * math.pi, 121)
    radii = shape.radius * np.linspace(0.3, 1.0, len(angles))
    unit = arc((0.0,) * len(shape.center), 1.0, angles, shape.x_axis, shape.y_axis)
    pen.line(np.array(shape.center) + radii[:, None] * unit, shape.role, 1.6, level=ABOVE_BODIES)
    _beside_arc(shape, pen, 5.0, "parameter")


@trace.register
def _(shape: shapes.TorsionalDamper, pen: Pen) -> None:
    width = min(13.0 * pen.unit, 0.6 * shape.radius)
    unit_center = (0.0,) * len(shape.center)
    # After a full turn it looks as before.
    turn = math.fmod(shape.end - shape.start, 2.0 * math.pi)
    shape = replace(shape, end=shape.start + turn)
    length = shape.radius * abs(turn)
    if length < 3.0 * pen.unit:
        _beside_arc(shape, pen, 4.0, "parameter")
        return
    for part, weight in zip(_dashpot(length / width), (1.8, 1.8, 2.6, 1.8), strict=True):
        # Enough points that the straight symbol follows the arc.
        fine = np.linspace(0, len(part) - 1, 12 * (len(part) - 1) + 1)
        along, across = (np.interp(fine, np.arange(len(part)), part[:, i]) for i in (0, 1))
        unit = arc(unit_center, 1.0, shape.start + along * turn, shape.x_axis, shape.y_axis)
        radii = shape.radius + 0.5 * width * across
        pen.line(np.array(shape.center) + radii[:, None] * unit, shape.role, weight, level=ABOVE_BODIES)
    _beside_arc(shape, pen, 0.5 * width / pen.unit + 4.0, "parameter")


@trace.register
def _(shape: shapes.Pin, pen: Pen) -> None:
    center = tuple(pen.view.project([shape.point])[0])
    pen.area(arc(center, 4.2 * pen.unit, _CIRCLE[::3]), shape.role, 1.6, "paper")
    pen.text(shape.point, shape.label, "reference", (-1.0, 1.0), 6.0)


def _hatch(pen: Pen, start: NDArray, end: NDArray, role: str) -> None:
    """Draw a fixed line and short strokes on its right-hand side."""
    pen.line([start, end], role, 2.0)
    along = direction(end - start)
    length = float(np.linalg.norm(end - start))
    count = min(max(int(length / (8.0 * pen.unit)), 1), 200)
    stroke = -8.0 * pen.unit * (left_of(along) + along) / math.sqrt(2.0)
    for i in range(count):
        foot = start + (i + 0.8) / count * length * along
        pen.line([foot, foot + stroke], role, 1.0)


@trace.register
def _(shape: shapes.Support, pen: Pen) -> None:
    tip = pen.view.project([shape.point])[0]
    down = np.array([math.cos(shape.angle), math.sin(shape.angle)])
    foot, half = tip + 17.0 * pen.unit * down, 10.0 * pen.unit * left_of(down)
    pen.area([tip, foot - half, foot + half], shape.role, 1.6, "paper")
    # Seen along `down`, the free side of the ground must lie toward the pin.
    _hatch(pen, foot - 1.5 * half, foot + 1.5 * half, shape.role)
    trace(shapes.Pin(shape.point, shape.label), pen)


@trace.register
def _(shape: shapes.Ground, pen: Pen) -> None:
    start, end = pen.view.project([shape.start, shape.end])
    _hatch(pen, start, end, shape.role)
    pen.text(end, shape.label, "reference", left_of(direction(end - start)), 5.0)


@trace.register
def _(shape: shapes.CenterLine, pen: Pen) -> None:
    start, end = pen.view.project([shape.start, shape.end])
    if shape.arrow:
        pen.arrow([start, end], shape.role, 1.4, 9.0)
    else:
        # A reference line runs below bodies and rods; the zero line of a coordinate must be seen on a body.
        level = LEVELS["ground"] + 0.5 if shape.role == "reference" else None
        pen.line([start, end], shape.role, 1.0, "-.", level)
    pen.text(end, shape.label, shape.role, direction(end - start), 3.0)
