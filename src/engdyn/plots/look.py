"""One look for all pictures: readable from the back row, distinguishable without color vision.

The colors are those proposed by Okabe and Ito (2002) for color-blind readers. Nothing is set at import time:
every plot function works inside ``with style():`` and leaves matplotlib's settings as it found them.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

import matplotlib
from cycler import cycler
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

__all__ = ["COLORS", "FILL", "PALETTE", "new_axes", "new_figure", "style"]

PALETTE = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000")
"""Blue, vermilion, bluish green, reddish purple, orange, sky blue, black."""

COLORS = {
    "body": "#20303c",
    "link": "#20303c",
    "spring": "#20303c",
    "damper": "#20303c",
    "joint": "#20303c",
    "ground": "#5a5f66",
    "reference": "#666b73",
    "parameter": "#00694f",
    "coordinate": "#0072B2",
    "input": "#C24A00",
    "position": "#20303c",
    "velocity": "#007A55",
    "acceleration": "#A83279",
    "momentum": "#8A5A00",
    "force": "#C24A00",
    "reaction": "#0072B2",
}
"""Color of each role of a shape; all have a contrast of at least 4.5 : 1 on white, also as text."""

FILL = {"body": "#d3e3ee", "ground": "#e3e5e8", "tire": "#8b939b", "paper": "#ffffff", "ink": "#20303c"}
"""Colors of areas: a body, fixed surroundings, rubber, what only hides things behind it, a solid mark."""

_SETTINGS = {
    "font.size": 13.0,
    "axes.titlesize": 14.0,
    "axes.labelsize": 14.0,
    "xtick.labelsize": 12.0,
    "ytick.labelsize": 12.0,
    "legend.fontsize": 12.0,
    "legend.frameon": False,
    "mathtext.fontset": "stix",
    "lines.linewidth": 2.2,
    "lines.markersize": 9.0,
    "axes.linewidth": 1.0,
    "axes.edgecolor": "#3a3f45",
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "axes.axisbelow": True,
    "grid.color": "#d9dce0",
    "grid.linewidth": 0.8,
    "axes.prop_cycle": cycler(color=PALETTE),
    "figure.facecolor": "white",
    "axes.facecolor": "white",
    "savefig.facecolor": "white",
    "text.usetex": False,
}


@contextmanager
def style() -> Iterator[None]:
    """Give everything that is drawn inside the block the look of the course.

    Examples
    --------
    >>> import matplotlib
    >>> from engdyn.plots import style
    >>> before = matplotlib.rcParams["font.size"]
    >>> with style():
    ...     inside = matplotlib.rcParams["font.size"]
    >>> inside, matplotlib.rcParams["font.size"] == before
    (13.0, True)
    """
    with matplotlib.rc_context(_SETTINGS):
        yield


def new_figure(width: float = 7.0, height: float = 4.6, layout: str | None = "constrained") -> Figure:
    """Make a figure of ``width`` by ``height`` inches that is rendered by Agg and unknown to pyplot.

    Parameters
    ----------
    width, height : float
        Size in inches.
    layout : str or None
        Layout engine of matplotlib; None leaves the axes where they are put (quicker to redraw).
    """
    with style():
        figure = Figure(figsize=(width, height), layout=layout)
    FigureCanvasAgg(figure)
    return figure


def new_axes(width: float = 7.0, height: float = 4.6) -> Axes:
    """Make a new figure (see `new_figure`) with one pair of axes."""
    with style():
        return new_figure(width, height).add_subplot()
