"""What eigenvalues mean, and what linearization drops: the figures that chapter 5 begins with."""

from __future__ import annotations

import math
import numbers

import numpy as np
import sympy as sm
from matplotlib.axes import Axes

from engdyn.errors import EngdynError
from engdyn.plots.alternative import describe
from engdyn.plots.look import COLORS, PALETTE, new_axes, style
from engdyn.plots.words import number

__all__ = ["response_gallery", "tangent"]

GALLERY = {
    (-1, 0): "dies away",
    (0, 0): "stays",
    (1, 0): "grows: divergence",
    (-1, 1): "oscillates and dies away",
    (0, 1): "oscillates for ever",
    (1, 1): "oscillates and grows: flutter",
}
"""Signs of real and imaginary part, and what the response does."""


def response_gallery(ax: Axes | None = None) -> Axes:
    """Draw the plane of eigenvalues with the response that belongs to each part of it (course section 5.1, Fig. 5.1).

    Parameters
    ----------
    ax : matplotlib.axes.Axes, optional
        Where to draw; default: new axes.

    Returns
    -------
    matplotlib.axes.Axes
    """
    ax = new_axes(8.4, 5.2) if ax is None else ax
    t = np.linspace(0.0, 1.0, 300)
    with style():
        ax.set(xlim=(-1.75, 1.75), ylim=(-0.62, 1.62), xticks=[], yticks=[])
        ax.grid(False)
        ax.axvspan(-1.75, 0.0, color="#eef5fa", zorder=0)
        ax.axvspan(0.0, 1.75, color="#fbeee6", zorder=0)
        for line in (ax.axhline, ax.axvline):
            line(0.0, color=COLORS["body"], linewidth=1.2, zorder=1)
        for (real, imaginary), text in GALLERY.items():
            inset = ax.inset_axes(
                (real * 1.1 - 0.46, imaginary - 0.28, 0.92, 0.56), transform=ax.transData, zorder=3
            )
            curve = np.exp(2.2 * real * t) * np.cos(2 * np.pi * 4 * imaginary * t)
            inset.plot(
                t, curve / np.max(abs(curve)), color=PALETTE[1] if real > 0 else PALETTE[0], linewidth=1.8
            )
            inset.axhline(0.0, color="#9aa0a6", linewidth=0.8)
            inset.set(xticks=[], yticks=[], ylim=(-1.15, 1.15), facecolor="white")
            inset.grid(False)
            look = {"ha": "center", "va": "top", "fontsize": 11.5, "color": COLORS["body"], "zorder": 4}
            box = {"facecolor": "#f4f1ef" if real == 0 else "none", "edgecolor": "none", "pad": 1.5}
            ax.text(real * 1.1, imaginary - 0.33, text, bbox=box, **look)
        ax.set(xlabel=r"Re $\lambda$", ylabel=r"Im $\lambda$")
        for x, text in ((-1.1, "stable"), (0.0, "marginal"), (1.1, "unstable")):
            box = {"facecolor": "#f4f1ef" if x == 0 else "none", "edgecolor": "none", "pad": 1.5}
            ax.text(x, 1.54, text, ha="center", va="top", fontweight="bold", color=COLORS["body"], bbox=box)
    parts = "; ".join(
        f"real part {_sign(re)}, imaginary part {_sign(im)}: {text}" for (re, im), text in GALLERY.items()
    )
    describe(ax, f"Upper half of the plane of eigenvalues with the responses exp(λt). {parts}.")
    return ax


def _sign(x: float) -> str:
    return "zero" if x == 0 else "positive" if x > 0 else "negative"


def tangent(function: sm.Expr, at: float, ax: Axes | None = None, *, reach: float | None = None) -> Axes:
    """Draw a function, its tangent at a point, and what linearization drops (course section 5.2, Fig. 5.2).

    Parameters
    ----------
    function : sympy.Expr
        Of one symbol.
    at : float
        Value of the symbol at the point of expansion.
    ax : matplotlib.axes.Axes, optional
        Where to draw; default: new axes.
    reach : float, optional
        How far to draw on either side; default 1, or half of `at` where that is larger.

    Returns
    -------
    matplotlib.axes.Axes

    Raises
    ------
    EngdynError
        Not a function of one symbol; no finite value or slope there.
    """
    x, value, slope = _expanded(function, at)
    reach = max(1.0, 0.5 * abs(at)) if reach is None else float(reach)
    places = np.linspace(at - reach, at + reach, 201)
    curve = [_real(function.subs(x, place)) for place in places]
    ax = new_axes() if ax is None else ax
    end = at + 0.8 * reach
    heights = value + slope * 0.8 * reach, _real(function.subs(x, end))
    with style():
        ax.plot(places, curve, color=PALETTE[0], label=f"${sm.latex(function)}$")
        ax.plot(
            places,
            value + slope * (places - at),
            "--",
            color=PALETTE[1],
            label=_line_text(x, at, value, slope),
        )
        ax.plot([at], [value], "o", color=COLORS["body"], zorder=5)
        ax.annotate(
            "",
            (end, heights[0]),
            (end, heights[1]),
            arrowprops={"arrowstyle": "<->", "shrinkA": 0, "shrinkB": 0},
        )
        ax.annotate(
            "dropped", (end, sum(heights) / 2), (6, 0), textcoords="offset points", va="center", fontsize=12.0
        )
        ax.set(xlabel=f"${sm.latex(x)}$", ylabel="value")
        ax.margins(x=0.02)
        ax.set_xlim(right=at + 1.12 * reach)
        ax.legend(loc="best", frameon=True, framealpha=0.9)
    describe(
        ax,
        f"The curve {function} and its tangent at {x} = {number(at)}, where the value is {number(value)} and the slope "
        f"{number(slope)}. At {x} = {number(end)} the tangent is off by {number(heights[0] - heights[1])}.",
    )
    return ax


def _expanded(function: sm.Expr, at: float) -> tuple[sm.Symbol, float, float]:
    """The symbol of a function, its value and its slope."""
    symbols = sorted(getattr(function, "free_symbols", ()), key=str)
    if not isinstance(function, sm.Expr) or len(symbols) != 1:
        raise EngdynError(f"tangent: {function!r} must be a sympy expression in one symbol.")
    if not isinstance(at, numbers.Real) or not math.isfinite(at):
        raise EngdynError(f"tangent: at is {at!r}, give a finite number.")
    (x,) = symbols
    value, slope = (sm.N(e.subs(x, at)) for e in (function, function.diff(x)))
    if not (value.is_real and slope.is_real and value.is_finite and slope.is_finite):
        raise EngdynError(f"tangent: {function} has no finite value and slope at {x} = {at:g}.")
    return x, float(value), float(slope)


def _real(value: sm.Expr) -> float:
    """A number, NaN where the function has no real value."""
    found = sm.N(value)
    return float(found) if found.is_real and found.is_finite else float("nan")


def _line_text(x: sm.Symbol, at: float, value: float, slope: float) -> str:
    moved = f"({sm.latex(x)} - {number(at)})" if at else sm.latex(x)
    return (
        f"${number(value)} + {number(slope)}\\,{moved}$".replace("−", "-")
        .replace("+ -", "- ")
        .replace("- -", "+ ")
    )
