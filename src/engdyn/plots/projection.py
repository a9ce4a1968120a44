"""From points in meters, in the plane or in space, to points of the picture (numpy only)."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from engdyn.shapes import Box, Point, Points

__all__ = ["View", "arc", "box_faces", "in_plane"]


@dataclass(frozen=True)
class View:
    """Parallel projection of space: where the eye stands, seen from the origin.

    Parameters
    ----------
    azimuth : float
        Direction of the eye about the vertical Z axis, counter-clockwise from X, in rad.
    elevation : float
        Height of the eye above the horizontal XY plane, in rad.
    """

    azimuth: float = -math.pi / 3
    elevation: float = math.pi / 9

    @property
    def axes(self) -> NDArray[np.float64]:
        """Rows: the unit vectors to the right, upward and toward the eye; shape (3, 3)."""
        ca, sa = math.cos(self.azimuth), math.sin(self.azimuth)
        ce, se = math.cos(self.elevation), math.sin(self.elevation)
        return np.array([[-sa, ca, 0.0], [-se * ca, -se * sa, ce], [ce * ca, ce * sa, se]])

    def project(self, points: ArrayLike) -> NDArray[np.float64]:
        """Return picture points, shape (N, 2), of points in the plane (N, 2) or in space (N, 3) [m]."""
        points = np.asarray(points, float)
        return points if points.shape[-1] == 2 else points @ self.axes[:2].T

    def depth(self, points: ArrayLike) -> float:
        """Mean distance of points toward the eye [m] (0 in the plane): what is nearer is drawn later."""
        points = np.asarray(points, float)
        return 0.0 if points.shape[-1] == 2 else float(np.mean(points @ self.axes[2]))


def in_plane(vector: Point, size: int) -> NDArray[np.float64]:
    """Return ``vector`` with zeros appended to ``size`` components."""
    return np.array(vector + (0.0,) * (size - len(vector)))


def arc(
    center: Point, radius: float, angles: ArrayLike, x_axis: Point = (1.0, 0.0), y_axis: Point = (0.0, 1.0)
) -> NDArray[np.float64]:
    """Points ``center + radius*(x_axis*cos + y_axis*sin)`` at ``angles`` [rad]; shape (N, 2 or 3)."""
    size = max(len(center), len(x_axis), len(y_axis))
    origin, x, y = (in_plane(vector, size) for vector in (center, x_axis, y_axis))
    angles = np.atleast_1d(np.asarray(angles, float))[:, None]
    return origin + radius * (np.cos(angles) * x + np.sin(angles) * y)


def box_faces(box: Box) -> list[NDArray[np.float64]]:
    """Corners, in order, of the one face (plane) or the six faces (space) of a box, each (4, 2 or 3)."""
    if len(box.size) == 2:
        c, s = math.cos(box.angle), math.sin(box.angle)
        return [_face(box.center, ((c, s), (-s, c)), box.size)]
    faces = []
    for normal in range(3):
        others = [i for i in range(3) if i != normal]
        for side in (-0.5, 0.5):
            center = np.array(box.center) + side * box.size[normal] * np.array(box.axes[normal])
            faces.append(
                _face(tuple(center), tuple(box.axes[i] for i in others), [box.size[i] for i in others])
            )
    return faces


def _face(center: Point, axes: Points, size) -> NDArray[np.float64]:
    across, along = (
        0.5 * width * in_plane(axis, len(center)) for axis, width in zip(axes, size, strict=True)
    )
    return np.array(center) + np.array([-across - along, across - along, across + along, along - across])
