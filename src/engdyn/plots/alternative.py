"""Every picture has a text alternative, and shows itself together with it.

Plot functions call `describe`; readers call `alt`. `show` displays a picture as PNG beside the text, so that
a notebook read aloud, searched, or compared by a test has words where the picture is.
"""

from __future__ import annotations

import base64
import io
import sys
from weakref import WeakKeyDictionary

from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from engdyn.errors import EngdynError
from engdyn.plots.look import style

__all__ = ["alt", "bundle", "describe", "png", "show", "small"]

DPI = 90
"""Resolution of pictures in notebooks, in dots per inch."""

_words: WeakKeyDictionary[Axes, list[str]] = WeakKeyDictionary()


def describe(ax: Axes, text: str, add: bool = False) -> None:
    """Attach a text alternative to axes.

    Parameters
    ----------
    ax : matplotlib.axes.Axes
        What has been drawn in.
    text : str
        What a reader who cannot see the picture should know: whole sentences with the numbers that matter.
    add : bool
        Append to what was said about these axes before, because both are visible.
    """
    _words[ax] = [*(_words.get(ax, []) if add else []), text]


def alt(drawn: Axes | Figure) -> str:
    """Return the text alternative of axes, or of all axes of a figure.

    Parameters
    ----------
    drawn : matplotlib.axes.Axes or matplotlib.figure.Figure

    Returns
    -------
    str
        What the plot functions said about the picture; of a picture drawn by other means, titles and axis labels.

    Raises
    ------
    EngdynError
        ``drawn`` is neither axes nor figure.
    """
    if isinstance(drawn, Figure):
        told = [ax for ax in drawn.axes if ax in _words] or [ax for ax in drawn.axes if _plain(ax)]
        return " ".join(alt(ax) for ax in told)
    if not isinstance(drawn, Axes):
        raise EngdynError(
            f"{drawn!r} is neither matplotlib Axes nor Figure; give what a plot function returned."
        )
    return " ".join(_words[drawn]) if drawn in _words else _plain(drawn)


def _plain(ax: Axes) -> str:
    parts = [ax.get_title(), *(text and f"{text}." for text in (ax.get_xlabel(), ax.get_ylabel()))]
    return " ".join(part for part in parts if part)


def _figure(drawn: Axes | Figure) -> Figure:
    alt(drawn)  # refuses what is neither
    return drawn if isinstance(drawn, Figure) else drawn.get_figure(root=True)


def png(drawn: Axes | Figure, dpi: float = DPI) -> bytes:
    """Render axes or a figure and return the PNG file as bytes.

    Parameters
    ----------
    drawn : matplotlib.axes.Axes or matplotlib.figure.Figure
    dpi : float
        Dots per inch.

    Raises
    ------
    EngdynError
        ``drawn`` is neither axes nor figure.
    """
    figure, stream = _figure(drawn), io.BytesIO()
    with style():
        # An Agg canvas works whatever backend the figure belongs to; no version inside, so files compare.
        canvas = figure.canvas if isinstance(figure.canvas, FigureCanvasAgg) else FigureCanvasAgg(figure)
        canvas.print_figure(stream, format="png", dpi=dpi, metadata={"Software": None})
    return stream.getvalue()


def small(picture: bytes) -> bytes:
    """Return the same PNG with a palette: a quarter of the size, kind to notebooks in a repository."""
    from PIL import Image

    stream = io.BytesIO()
    colors = Image.open(io.BytesIO(picture)).convert("RGB")
    colors.quantize(128, dither=Image.Dither.NONE).save(stream, "PNG", optimize=True)
    return stream.getvalue()


def bundle(drawn: Axes | Figure, dpi: float = DPI) -> tuple[dict[str, str], dict[str, dict[str, str]]]:
    """Return a picture as Jupyter's MIME bundle and metadata: PNG (base64) beside its alternative text."""
    words = alt(drawn)
    data = {"image/png": base64.b64encode(small(png(drawn, dpi))).decode("ascii"), "text/plain": words}
    return data, {"image/png": {"alt": words}}


def show(drawn: Axes | Figure, dpi: float = DPI) -> None:
    """Display a picture in the notebook together with its text alternative, then close the figure.

    Parameters
    ----------
    drawn : matplotlib.axes.Axes or matplotlib.figure.Figure
        What a plot function returned.
    dpi : float
        Dots per inch; 90 keeps notebooks small.

    Raises
    ------
    EngdynError
        ``drawn`` is neither axes nor figure.
    """
    from IPython.display import display

    data, metadata = bundle(drawn, dpi)
    display(data, metadata=metadata, raw=True)
    # A figure made by pyplot would be shown a second time at the end of the cell and stay in memory.
    if (pyplot := sys.modules.get("matplotlib.pyplot")) is not None:
        pyplot.close(_figure(drawn))
