"""Modes over a parameter: Campbell diagrams, coalescence before flutter, damping that changes sign."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.axes import Axes

from engdyn.errors import EngdynError
from engdyn.plots.alternative import describe
from engdyn.plots.look import COLORS, PALETTE, new_axes, style
from engdyn.plots.words import number, symbol, with_unit

if TYPE_CHECKING:
    from engdyn.analysis.modal_comparison import ModeBranches
    from engdyn.system import System

__all__ = ["campbell"]

QUANTITIES = {
    "damped_frequency": ("frequency", "Hz"),
    "natural_frequency": ("natural frequency", "Hz"),
    "damping_ratio": ("damping ratio", "1"),
}

ROUNDING = 1e-9
"""What is smaller than this share of the largest neither oscillates nor grows."""

DASHES = ("-", "--", "-.", (0, (1, 1)))


def campbell(
    branches: ModeBranches,
    ax: Axes | None = None,
    *,
    quantity: str = "damped_frequency",
    orders: Sequence[float] = (),
    whirl: tuple[str, str] | None = None,
    system: System | None = None,
) -> Axes:
    """Plot modes over a parameter; over the speed of a rotor this is its Campbell diagram.

    Course sections 6.1 and 6.5; W. Campbell, Transactions of the ASME 46 (1924).

    Parameters
    ----------
    branches : ModeBranches
        What ``engdyn.track_modes`` returned.
    ax : matplotlib.axes.Axes, optional
        Where to draw; default: new axes.
    quantity : {"damped_frequency", "natural_frequency", "damping_ratio"}
        What is plotted upward; a mode that does not oscillate has no frequency.
    orders : sequence of float
        Lines of excitation at these multiples of the parameter, which is then a speed in rad/s; where they
        cross a mode there is a resonance, marked by a dot.
    whirl : (str, str), optional
        Two coordinates, displacements along or rotations about X and Y: modes are told as forward or backward.
    system : System, optional
        Knows symbol and unit of the parameter.

    Returns
    -------
    matplotlib.axes.Axes
        Stretches with Re λ > 0 have a broad pale band.

    Raises
    ------
    EngdynError
        Another quantity, unknown coordinates, orders with a damping ratio.
    """
    if not hasattr(branches, "damped_frequency") or not hasattr(branches, "values"):
        raise EngdynError(f"{branches!r} is no ModeBranches: give what engdyn.track_modes returned")
    if quantity not in QUANTITIES:
        raise EngdynError(f"quantity is {quantity!r}: choose one of {', '.join(QUANTITIES)}")
    if len(orders) and quantity == "damping_ratio":
        raise EngdynError("orders are frequencies: plot them with a frequency, not with the damping ratio")
    across, (what, unit) = branches.values, QUANTITIES[quantity]
    oscillates = branches.damped_frequency > ROUNDING * np.max(branches.natural_frequency, initial=0.0)
    shown = np.flatnonzero(oscillates.any(axis=0))
    up = np.where(oscillates, getattr(branches, quantity), np.nan)[:, shown]
    names = [f"mode {i + 1}{_sense(branches, whirl, k)}" for i, k in enumerate(shown)]
    parameter = next((p for p in system.parameters if p.name == branches.parameter), None) if system else None
    ax = new_axes() if ax is None else ax
    with style():
        told = _branch_lines(ax, across, up, branches.eigenvalues[:, shown], names, unit)
        told += _order_lines(ax, across, up, orders)
        if quantity == "damping_ratio":
            ax.axhline(0.0, color=COLORS["reference"], linewidth=1.0)
        else:
            ax.set_ylim(bottom=0.0)
        ax.set_xlim(*sorted((across[0], across[-1])))
        ax.set_xlabel(with_unit(symbol(parameter), parameter.unit) if parameter else branches.parameter)
        ax.set_ylabel(f"{what} [{unit}]")
        ax.legend(loc="best", frameon=True, framealpha=0.9)
    title, ends = f"{system.title}: " if system else "", f"{number(across[0])} to {number(across[-1])}"
    intro = f"{title}{what} [{unit}] of {len(shown)} modes over {branches.parameter} = {ends}"
    describe(ax, f"{intro}. {'; '.join(told)}.")
    return ax


def _sense(branches: ModeBranches, whirl: tuple[str, str] | None, k: int) -> str:
    """What to say about the sense in which a mode circles."""
    if whirl is None:
        return ""
    mean = np.mean(branches.whirl(*whirl)[:, k])
    return ", forward" if mean > 0.01 else ", backward" if mean < -0.01 else ", straight"


def _branch_lines(
    ax: Axes, across: np.ndarray, up: np.ndarray, found: np.ndarray, names: Sequence[str], unit: str
) -> list[str]:
    """One line a mode, a band below what grows, and both in words."""
    told, grows = [], found.real > ROUNDING * np.max(np.abs(found), initial=0.0)
    for i, name in enumerate(names):
        ax.plot(across, up[:, i], color=PALETTE[i % 7], linestyle=DASHES[i % 4], label=name)
        told.append(f"{name} {_course(across, up[:, i], unit)}")
        where = np.flatnonzero(grows[:, i] & np.isfinite(up[:, i]))
        if len(where):
            first = not any(line.get_label() == "unstable" for line in ax.lines)
            band = {"color": "#e9c7bb", "linewidth": 10.0, "solid_capstyle": "butt", "zorder": 1}
            ax.plot(
                across, np.where(grows[:, i], up[:, i], np.nan), label="unstable" if first else "_", **band
            )
            told[-1] += (
                f", unstable from {number(float(across[where[0]]))} to {number(float(across[where[-1]]))}"
            )
    return told


def _course(across: np.ndarray, up: np.ndarray, unit: str) -> str:
    """First and last value where the mode oscillates."""
    known = np.flatnonzero(np.isfinite(up))
    mark = "" if unit == "1" else f" {unit}"
    first, last = (number(float(up[i])) for i in known[[0, -1]])
    span = "" if len(known) == len(up) else f" (oscillates up to {number(float(across[known[-1]]))})"
    return f"from {first} to {last}{mark}{span}"


def _order_lines(ax: Axes, across: np.ndarray, up: np.ndarray, orders: Sequence[float]) -> list[str]:
    """Lines of excitation, the dots where they meet modes, and both in words."""
    told: list[str] = []
    for order in orders:
        line: Any = order * across / (2 * np.pi)
        ax.plot(
            across, line, color=COLORS["reference"], linewidth=1.2, linestyle=(0, (5, 2, 1, 2)), zorder=1.5
        )
        ax.annotate(
            f"{order:g}×", (across[-1], line[-1]), xytext=(-6.0, 4.0), textcoords="offset points", ha="right"
        )
        gap = up - line[:, None]
        for i, k in zip(*np.nonzero(gap[:-1] * gap[1:] < 0), strict=True):
            share = gap[i, k] / (gap[i, k] - gap[i + 1, k])
            x = across[i] + share * (across[i + 1] - across[i])
            ax.plot([x], [order * x / (2 * np.pi)], "o", color="black", markersize=7.0, zorder=6)
            told.append(f"resonance with {order:g}× at {number(x)} rad/s")
    return told
