"""What several plots share: axes of angles, ranges of coordinates, marks for stable and unstable."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.axis import Axis
from matplotlib.lines import Line2D
from matplotlib.ticker import FuncFormatter, MultipleLocator
from numpy.typing import NDArray

from engdyn.errors import EngdynError
from engdyn.plots.look import PALETTE
from engdyn.plots.words import symbol, with_unit

if TYPE_CHECKING:
    from engdyn.system import System

__all__ = ["MARKS", "coordinate_axis", "coordinate_range", "index_of", "is_stable", "legend_entry"]

MARKS = {
    True: {"label": "stable", "color": PALETTE[0], "linestyle": "-", "markerfacecolor": PALETTE[0]},
    False: {"label": "unstable", "color": PALETTE[1], "linestyle": "--", "markerfacecolor": "white"},
}
"""Look of what is stable (solid, filled) and unstable (broken, open); color is never the only difference."""


def is_stable(verdict: str) -> bool:
    """Whether a verdict of ``engdyn.stability`` reads as stable; *marginal* counts with the stable ones."""
    return not verdict.startswith("unstable")


def index_of(system: System, coordinate: str) -> int:
    """Return the place of a coordinate, by name, among those of the system.

    Raises
    ------
    EngdynError
        The system has no coordinate of this name.
    """
    names = [c.name for c in system.coordinates]
    if coordinate not in names:
        raise EngdynError(
            f"{system.title} has no coordinate {coordinate!r}; choose one of {', '.join(names)}."
        )
    return names.index(coordinate)


def coordinate_range(coordinate: Any, shown: Iterable[float] = ()) -> tuple[float, float]:
    """Return an interval to plot over: the admissible one, a full turn, or what surrounds ``shown``."""
    low, high = coordinate.bounds if coordinate.bounds is not None else (-math.inf, math.inf)
    shown = [float(value) for value in shown]
    wide = (
        math.pi
        if coordinate.unit == "rad"
        else 1.5 * max([abs(value) for value in shown], default=0.0) or 1.0
    )
    low, high = (float(low) if math.isfinite(low) else -wide), (float(high) if math.isfinite(high) else wide)
    return min([low, *shown]), max([high, *shown])


def coordinate_axis(axis: Axis, coordinate: Any, span: float) -> None:
    """Label an axis with symbol and unit of a coordinate; wide axes of angles have ticks in parts of pi."""
    axis.set_label_text(with_unit(symbol(coordinate), coordinate.unit))
    if coordinate.unit == "rad" and span > 0.75 * math.pi:
        step = math.pi / 4 if span < 1.6 * math.pi else math.pi / 2
        axis.set_major_locator(MultipleLocator(step))
        axis.set_major_formatter(FuncFormatter(lambda value, _: _multiple_of_pi(value)))


def _multiple_of_pi(value: float) -> str:
    quarters = round(4.0 * value / math.pi)
    if quarters == 0:
        return "0"
    divisor = math.gcd(quarters, 4)
    above, below = abs(quarters) // divisor, 4 // divisor
    return f"{'−' * (quarters < 0)}{above if above != 1 else ''}π" + (f"/{below}" if below != 1 else "")


def legend_entry(stable: bool, marker: str = "") -> Line2D:
    """Return a line for a legend that shows how stable or unstable states look."""
    look = MARKS[stable]
    return Line2D([], [], marker=marker, **{**look, "linestyle": "" if marker else look["linestyle"]})


def split(mask: NDArray[np.bool_]) -> list[slice]:
    """Return the runs of equal entries of a mask, each but the last one entry longer so that lines join."""
    edges = np.flatnonzero(np.diff(mask)) + 1
    starts, stops = np.concatenate([[0], edges]), np.concatenate([edges + 1, [len(mask)]])
    return [slice(int(start), int(min(stop, len(mask)))) for start, stop in zip(starts, stops, strict=True)]
