"""The pen: collects the lines, areas and texts of a drawing before anything is handed to matplotlib.

Lengths that serve reading (arrow heads, hatching) are given in typographic points; the pen knows how many
meters of the picture one point is.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike, NDArray

from engdyn.plots.projection import View

__all__ = ["LEVELS", "Area", "Line", "Pen", "Words", "direction", "left_of"]

LEVELS = {
    "ground": 1.0,
    "link": 2.0,
    "spring": 3.0,
    "damper": 3.0,
    "body": 4.0,
    "joint": 5.0,
    "reference": 5.5,
    "parameter": 6.0,
    "coordinate": 7.0,
    "input": 8.0,
    **dict.fromkeys(("position", "velocity", "acceleration", "momentum", "force", "reaction"), 8.0),
}
"""What lies on top of what: a larger number is drawn later."""


@dataclass(frozen=True)
class Line:
    """A line through picture points (N, 2); ``weight`` in points; ``dash`` as matplotlib names it."""

    points: NDArray[np.float64]
    role: str
    weight: float
    dash: str
    level: float


@dataclass(frozen=True)
class Area:
    """An area with an outline; ``fill`` names a color of ``look.FILL`` or is "role" for that of the role."""

    points: NDArray[np.float64]
    role: str
    weight: float
    fill: str
    level: float
    depth: float


@dataclass(frozen=True)
class Words:
    """A text that would like to stand ``clearance`` points away from one of ``anchors`` toward its ``sides``.

    Anchors (picture points) and sides (directions, zero for a text centered on its anchor) have the shape
    (k, 2); the first is liked best.
    """

    text: str
    anchors: NDArray[np.float64]
    sides: NDArray[np.float64]
    clearance: float
    role: str


@dataclass
class Pen:
    """Collects ink. ``unit`` is the size of one typographic point in meters of the picture."""

    unit: float
    view: View
    lines: list[Line] = field(default_factory=list)
    areas: list[Area] = field(default_factory=list)
    texts: list[Words] = field(default_factory=list)

    def line(
        self, points: ArrayLike, role: str, weight: float = 1.8, dash: str = "-", level: float | None = None
    ) -> None:
        """Draw a line through points in the plane or in space."""
        level = LEVELS[role] if level is None else level
        self.lines.append(Line(self.view.project(points), role, weight, dash, level))

    def area(
        self,
        points: ArrayLike,
        role: str,
        weight: float = 1.6,
        fill: str = "",
        level: float | None = None,
        at: ArrayLike | None = None,
    ) -> None:
        """Draw a closed outline and fill it, by default as a body or, with that role, as ground.

        A mark of fixed size on paper stands for the point `at`, which decides what it hides.
        """
        fill = fill or ("ground" if role == "ground" else "body")
        level = LEVELS[role] if level is None else level
        depth = self.view.depth(points if at is None else [at])
        self.areas.append(Area(self.view.project(points), role, weight, fill, level, depth))

    def head(self, tip: ArrayLike, along: ArrayLike, role: str, length: float = 10.0) -> None:
        """Draw an arrow head at the picture point ``tip`` that points ``along``."""
        tip, along = np.asarray(tip, float), direction(along)
        back, across = length * self.unit * along, 0.36 * length * self.unit * left_of(along)
        self.area([tip, tip - back + across, tip - 0.8 * back, tip - back - across], role, 0.6, "role")

    def arrow(self, points: ArrayLike, role: str, weight: float = 1.8, length: float = 10.0) -> None:
        """Draw a line with a head at its last point; the line stops inside the head."""
        points = np.array(self.view.project(points), float)
        tip = points[-1].copy()
        steps = np.linalg.norm(tip - points, axis=1)
        behind = points[np.argmax(steps[::-1] > 0.6 * length * self.unit) * -1 - 1]
        along = direction(tip - behind)
        self.head(tip, along, role, length)
        points = points[steps > 0.8 * length * self.unit]
        self.line(np.vstack([points, tip - 0.7 * length * self.unit * along]), role, weight)

    def text(
        self, anchor: ArrayLike, text: str, role: str, side: ArrayLike = (0.0, 0.0), clearance: float = 4.0
    ) -> None:
        """Ask for a text near a point; where it ends up is decided when everything else is drawn."""
        self.text_at([(self.view.project([anchor])[0], side)], text, role, clearance)

    def text_at(self, places: Sequence, text: str, role: str, clearance: float = 4.0) -> None:
        """Ask for a text near one of several picture points, given as pairs (anchor, side)."""
        if text:
            anchors = np.array([anchor for anchor, _ in places], float)
            sides = np.array([np.asarray(side, float)[:2] for _, side in places])
            self.texts.append(Words(text, anchors, sides, clearance, role))

    def points(self) -> NDArray[np.float64]:
        """All picture points touched so far, shape (N, 2), in meters."""
        return np.vstack([np.empty((0, 2)), *(mark.points for mark in (*self.lines, *self.areas))])


def direction(vector: ArrayLike) -> NDArray[np.float64]:
    """Return the unit vector along ``vector``; upward where the vector is too short to have a direction."""
    vector = np.asarray(vector, float)
    length = np.linalg.norm(vector)
    return vector / length if length > 1e-12 else np.array([0.0, 1.0])


def left_of(along: ArrayLike) -> NDArray[np.float64]:
    """Return the picture vector ``along`` turned by 90 degrees counter-clockwise."""
    x, y = np.asarray(along, float)
    return np.array([-y, x])
