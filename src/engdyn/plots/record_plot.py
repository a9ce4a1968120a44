"""The picture of a record, with what a first look finds.  Course section 9.1."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.axes import Axes

from engdyn.errors import EngdynError
from engdyn.experiment.segments import density_unit
from engdyn.looking import find_dropouts
from engdyn.plots.alternative import describe
from engdyn.plots.look import PALETTE, new_axes, style
from engdyn.plots.response_plots import _label
from engdyn.plots.words import number

if TYPE_CHECKING:
    from engdyn.record import Record

__all__ = ["record"]

FINEST = 4000
"""A longer record is drawn as what lies between the smallest and largest of so many groups of samples."""


def record(record: Record, ax: Axes | None = None, *, square: bool = False) -> Axes:
    """Plot one channel over time with what a first look finds: mean, drift, clipped samples, dropouts.

    Course section 9.1, Figures 9.1 and 9.2.

    Parameters
    ----------
    record : Record
        One channel.
    ax : matplotlib.axes.Axes, optional
        Where to draw; default: new axes.
    square : bool
        Plot the square of the samples: the area under it is that under its mean, the mean square.

    Returns
    -------
    matplotlib.axes.Axes

    Raises
    ------
    EngdynError
        Several channels.
    """
    if len(record.channels) > 1:
        raise EngdynError(f"plots.record draws one channel: choose one of {', '.join(record.channels)}")
    name, unit, (seen,) = record.channels[0], record.units[0], record.summary().channels
    x, t = record.samples.reshape(-1), record.time
    ax = new_axes(8.4, 3.6) if ax is None else ax
    with style():
        if square:
            mean = float(np.mean(x**2))
            ax.plot(*_outline(t, x**2), color=PALETTE[0], linewidth=1.0)
            ax.fill_between([t[0], t[-1]], mean, color=PALETTE[4], alpha=0.35, label="mean square")
            ax.axhline(mean, color=PALETTE[1], linewidth=2.0)
            ax.set_ylim(bottom=0.0)
            unit = density_unit(unit).removesuffix("/Hz")
            said = f"its square; mean square {number(mean)} {unit}"
        else:
            ax.plot(*_outline(t, x), color=PALETTE[0], linewidth=1.0)
            ax.axhline(seen.mean, color=PALETTE[1], linestyle="--", linewidth=1.8, label="mean")
            _first_look(ax, t, x, seen)
            said = f"mean {number(seen.mean)} {unit}; {'; '.join(seen.remarks) or 'nothing to remark'}"
        ax.set_xlim(t[0], t[-1])
        ax.set_xlabel("time [s]")
        ax.set_ylabel(_label(f"{name}{'²' if square else ''}", unit))
        ax.legend(loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=5)
    span = f"{number(t[0])} to {number(t[-1])} s, {number(x.min())} to {number(x.max())} {record.units[0]}"
    describe(ax, f"Record {name}, {span}; {said}{'' if said.endswith('?') else '.'}")
    return ax


def _first_look(ax: Axes, t: np.ndarray, x: np.ndarray, seen: Any) -> None:
    if any("drifts" in remark for remark in seen.remarks):
        ends = seen.mean + seen.drift * np.array([-0.5, 0.5])
        ax.plot(t[[0, -1]], ends, color=PALETTE[3], linestyle="-.", linewidth=1.8, label="drift")
    _, lost = find_dropouts(x)
    for value in (seen.largest, seen.smallest) if seen.clipped else ():
        at = (x == value) & ~lost
        if np.count_nonzero(at) > 2:
            look = {"color": PALETTE[6], "marker": "v" if value == seen.largest else "^", "markersize": 6.0}
            ax.plot(t[at], x[at], linestyle="", label=f"clipped at {number(value)}", **look)
    edges = np.flatnonzero(np.diff(np.concatenate([[0], lost.astype(int), [0]])))
    for i, (start, stop) in enumerate(edges.reshape(-1, 2)):
        ax.axvspan(t[start], t[stop - 1], color="#f0c9b0", label=None if i else "dropout", zorder=0)


def _outline(t: np.ndarray, x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The curve itself, or of a long one the smallest and largest values of groups of samples."""
    size = len(x) // FINEST
    if size < 2:
        return t, x
    rows = x[: len(x) // size * size].reshape(-1, size)
    extremes = np.stack([rows.min(axis=1), rows.max(axis=1)], axis=1)
    return np.repeat(t[: rows.size : size], 2), extremes.reshape(-1)
