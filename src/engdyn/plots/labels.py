"""Finds places for the labels of a drawing where they cover neither lines nor each other."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.path import Path
from matplotlib.text import Text
from numpy.typing import NDArray

from engdyn.plots.look import COLORS
from engdyn.plots.pen import Area, Line, Words

__all__ = ["place"]

_TURNS = np.radians([0, 25, -25, 50, -50, 80, -80, 110, -110, 145, -145, 180])
"""Directions to try, counted from the side where a label would like to stand."""

_STEPS = (0.0, 5.0, 11.0, 19.0, 30.0)
"""Additional distances to try, in points."""

SIZE = 17.0
"""Size of the letters on a drawing, in points."""

_SPACING = 3.0
"""Lines are avoided as rows of dots this many points apart."""


def place(
    ax: Axes, texts: Sequence[Words], marks: Sequence[Line | Area], unit: float, size: float = SIZE
) -> list[Text]:
    """Write texts into axes, each at the best of some sixty places around each of its anchors.

    Parameters
    ----------
    ax : matplotlib.axes.Axes
        Limits and aspect must be final.
    texts : sequence of Words
        Texts with anchors in picture meters, most important first.
    marks : sequence of Line or Area
        What should not be covered.
    unit : float
        Meters of the picture per typographic point.
    size : float
        Size of the letters in points.

    Returns
    -------
    list of matplotlib.text.Text
    """
    scale = 72.0 / ax.get_figure(root=True).dpi
    page = _Page(marks, np.array([ax.get_xlim(), ax.get_ylim()]).T / unit, unit)
    written = []
    for words in texts:
        # A label at the rim must be readable rather than cut off, hence no clipping.
        text = ax.text(0.0, 0.0, words.text, color=COLORS[words.role], ha="center", va="center", zorder=9)
        text.set(clip_on=False, fontsize=size)
        extent = text.get_window_extent()
        center = page.settle(words, 0.5 * scale * np.array([extent.width, extent.height]) + 3.0)
        text.set_position(tuple(center * unit))
        written.append(text)
    return written


class _Page:
    """What is on the paper so far; all lengths in typographic points."""

    def __init__(self, marks: Sequence[Line | Area], paper: NDArray, unit: float) -> None:
        self.paper, self.unit = paper, unit
        self.bodies = [
            (Path(m.points / unit), m.level) for m in marks if isinstance(m, Area) and _large(m, unit)
        ]
        self.dots = self._dots(marks)
        self.boxes = np.empty((0, 2, 2))

    def _dots(self, marks: Sequence[Line | Area]) -> NDArray[np.float64]:
        """Return points along all visible lines and outlines, shape (N, 2)."""
        rows, levels = [np.empty((0, 2))], [np.empty(0)]
        for mark in marks:
            points = mark.points / self.unit
            points = np.vstack([points, points[:1]]) if isinstance(mark, Area) else points
            way = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(points, axis=0).T))])
            steps = np.linspace(0.0, way[-1], min(int(way[-1] / _SPACING) + 2, 2000))
            rows.append(np.column_stack([np.interp(steps, way, points[:, i]) for i in (0, 1)]))
            levels.append(np.full(len(steps), mark.level))
        dots, levels = np.vstack(rows), np.concatenate(levels)
        for path, level in self.bodies:
            # What a body hides needs no room.
            hidden = np.flatnonzero(levels < level)
            hidden = hidden[path.contains_points(dots[hidden])]
            dots, levels = np.delete(dots, hidden, axis=0), np.delete(levels, hidden)
        return dots

    def settle(self, words: Words, half: NDArray) -> NDArray:
        """Return the center where a text of half size ``half`` covers least, and occupy that place."""
        centers, cost, whose = _candidates(words, half, self.unit)
        low, high = centers - half, centers + half
        near = np.all((self.dots > low.min(axis=0)) & (self.dots < high.max(axis=0)), axis=1)
        gaps = abs(self.dots[near][None] - centers[:, None])
        # Inside a body a label may come close to the outline: there is no doubt what it belongs to.
        on_it = np.all(centers == words.anchors[whose] / self.unit, axis=1)
        tight = half - 4.0 * on_it[:, None]
        cost = cost + 0.7 * np.all(gaps < tight[:, None], axis=2).sum(axis=1)
        outside = np.maximum(self.paper[0] - low, 0.0) + np.maximum(high - self.paper[1], 0.0)
        meets = (low[:, None] < self.boxes[None, :, 1]) & (high[:, None] > self.boxes[None, :, 0])
        cost = cost + 2.0 * outside.sum(axis=1) + 30.0 * np.all(meets, axis=2).sum(axis=1)
        # Between the two ends of an arrow, the end that touches nothing is the clearer place.
        crowd = [
            np.count_nonzero(np.all(abs(self.dots - a) < 9.0, axis=1)) for a in words.anchors / self.unit
        ]
        cost = cost + 0.1 * np.array(crowd)[whose]
        if np.any(words.sides):
            inside = [path.contains_points(centers) for path, _ in self.bodies]
            cost = cost + 1.5 * np.any(np.array(inside).reshape(-1, len(centers)), axis=0)
        best = int(np.argmin(cost))
        self.boxes = np.concatenate([self.boxes, [[low[best], high[best]]]])
        return centers[best]


def _large(area: Area, unit: float) -> bool:
    return bool(np.all(np.ptp(area.points, axis=0) > 12.0 * unit))


def _candidates(words: Words, half: NDArray, unit: float) -> tuple[NDArray, NDArray, NDArray]:
    """Return centers (N, 2) to try, how much each is disliked, and which anchor it belongs to (N,)."""
    step = np.array(_STEPS)
    centers, dislikes, whose = [], [], []
    for rank, (anchor, side) in enumerate(zip(words.anchors / unit, words.sides, strict=True)):
        centered = int(not np.any(side))
        angles = (np.pi / 2 if centered else np.arctan2(side[1], side[0])) + _TURNS[:, None]
        ways = np.stack([np.cos(angles), np.sin(angles)], axis=-1)
        # How far the box reaches from its center toward the anchor.
        reach = np.min(half / np.maximum(abs(ways), 1e-9), axis=-1)
        around = (anchor + (words.clearance + reach + step)[..., None] * ways).reshape(-1, 2)
        dislike = (0.5 * abs(_TURNS)[:, None] + 0.06 * step + 0.4 * rank + 1.0 * centered).ravel()
        centers += [np.tile(anchor, (centered, 1)), around]
        dislikes += [np.zeros(centered), dislike]
        whose.append(np.full(centered + len(around), rank))
    return np.vstack(centers), np.concatenate(dislikes), np.concatenate(whose)
