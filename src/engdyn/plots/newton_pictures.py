"""Curves over a common axis, and maps of what happens where: the plain charts of a chapter."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import ArrayLike, NDArray

from engdyn.errors import EngdynError
from engdyn.plots.alternative import describe
from engdyn.plots.look import new_axes, style

__all__ = ["curves", "regions"]

TINTS = ("#cfe3f2", "#fbdcc7", "#cdebdf", "#f0dbe8")
"""Pale fills of regions, in the hues of the palette."""

DASHES = ("-", "--", "-.", ":")


def curves(
    lines: Mapping[str, tuple[ArrayLike, ArrayLike]],
    xlabel: str,
    ylabel: str,
    words: str,
    ax: Axes | None = None,
    *,
    points: Mapping[str, tuple[ArrayLike, ArrayLike]] | None = None,
    equal: bool = False,
) -> Axes:
    """Plot one or more curves over a common axis.

    Parameters
    ----------
    lines : mapping of label to (x, y)
        Arrays of equal length; the label of a single curve is not written.
    xlabel, ylabel : str
        Axis labels with units.
    words : str
        The picture in a sentence or two, for readers who cannot see it.
    ax : matplotlib.axes.Axes, optional
        Where to draw; default: new axes.
    points : mapping of label to (x, y), optional
        Marks on top of the curves, with their labels.
    equal : bool
        Give both axes the same scale: a path in the plane.

    Returns
    -------
    matplotlib.axes.Axes

    Raises
    ------
    EngdynError
        No curve, arrays of different lengths, values that are not finite, no words.
    """
    _check_words("curves", words)
    if not lines:
        raise EngdynError("curves: there is nothing to plot; give a mapping of label to (x, y).")
    marks = dict(points or {})
    known = {label: _checked_line(label, pair) for label, pair in [*lines.items(), *marks.items()]}
    ax = new_axes() if ax is None else ax
    with style():
        for i, label in enumerate(lines):
            ax.plot(*known[label], DASHES[i % len(DASHES)], label=label)
        for label in marks:
            ax.plot(*known[label], "o", color="#20303c", zorder=5, label=label)
        _frame(ax, xlabel, ylabel)
        if equal:
            ax.set_aspect("equal", adjustable="datalim")
        if len(known) > 1:
            ax.legend(loc="best", frameon=True, framealpha=0.9)
    describe(ax, words)
    return ax


def regions(
    x: ArrayLike,
    y: ArrayLike,
    values: ArrayLike,
    levels: Sequence[float],
    names: Sequence[str],
    xlabel: str,
    ylabel: str,
    words: str,
    ax: Axes | None = None,
) -> Axes:
    """Draw a map of what happens where: regions between levels of a quantity, each with its name in it.

    Parameters
    ----------
    x, y : array_like, shapes (N,) and (M,)
        Rising grid values.
    values : array_like, shape (M, N)
        The quantity that decides.
    levels : sequence of float
        Where one thing ends and the next begins, rising.
    names : sequence of str
        What happens below the first level, between the levels, above the last; at most four.
    xlabel, ylabel, words, ax
        As for :func:`curves`.

    Returns
    -------
    matplotlib.axes.Axes

    Raises
    ------
    EngdynError
        A grid and values that do not fit or are not finite, names that do not fit the levels, no words.
    """
    _check_words("regions", words)
    x, y, values = (np.asarray(item, float) for item in (x, y, values))
    if values.shape != (len(y), len(x)) or not np.all(np.isfinite(values)):
        raise EngdynError(
            f"regions: values has shape {values.shape}; {len(y)} values of y and {len(x)} of x need one finite "
            "number each."
        )
    if len(names) != len(levels) + 1 or len(names) > len(TINTS) or np.any(np.diff(levels) <= 0):
        raise EngdynError(
            f"regions: {len(levels)} rising levels need {len(levels) + 1} names, {len(TINTS)} at most; "
            f"given {list(levels)} and {len(names)} names."
        )
    ax = new_axes() if ax is None else ax
    with style():
        ax.contourf(x, y, values, levels=[-np.inf, *levels, np.inf], colors=TINTS[: len(names)])
        if levels:
            ax.contour(x, y, values, levels=list(levels), colors="#20303c", linewidths=1.2)
        kinds = np.searchsorted(np.asarray(levels, float), values)
        for kind, name in enumerate(names):
            if np.any(kinds == kind):
                at = _middle(kinds == kind)
                ax.text(x[at[1]], y[at[0]], name, ha="center", va="center", fontsize=14, zorder=5)
        _frame(ax, xlabel, ylabel)
        ax.grid(False)
    describe(ax, words)
    return ax


def _check_words(owner: str, words: str) -> None:
    if not isinstance(words, str) or not words.strip():
        raise EngdynError(f"{owner}: say in words what the picture shows; some readers cannot see it.")


def _checked_line(label: str, pair: tuple[ArrayLike, ArrayLike]) -> NDArray[np.float64]:
    x, y = (np.atleast_1d(np.asarray(values, float)) for values in pair)
    if x.shape != y.shape or x.ndim != 1:
        raise EngdynError(
            f"{label!r}: x has shape {x.shape} and y {y.shape}; give two arrays of equal length."
        )
    if not (np.all(np.isfinite(x)) and np.all(np.isfinite(y))):
        raise EngdynError(f"{label!r} contains values that are not finite; leave these points out.")
    return np.vstack([x, y])


def _frame(ax: Axes, xlabel: str, ylabel: str) -> None:
    ax.set_xlabel(xlabel)
    ax.set_ylabel(ylabel)


def _middle(inside: NDArray[np.bool_]) -> tuple[int, int]:
    """The grid point of a region that is farthest from its rim: there is most room for a name."""
    from scipy.ndimage import distance_transform_edt

    depth = distance_transform_edt(np.pad(inside, 1))[1:-1, 1:-1]
    row, column = np.unravel_index(int(np.argmax(depth)), depth.shape)
    return int(row), int(column)
