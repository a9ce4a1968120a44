"""The construction of nodes: where the lines of a vibrating body cross.  Course sections 6.3 and 6.4."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray

from engdyn.errors import EngdynError
from engdyn.plots.alternative import describe
from engdyn.plots.look import COLORS, PALETTE, new_figure, style
from engdyn.plots.modal_plots import chosen_modes, mode_name
from engdyn.plots.words import number

if TYPE_CHECKING:
    from engdyn.analysis.damped_modes import DampedModes
    from engdyn.analysis.modes import Modes

__all__ = ["nodal_points"]

FAR = 4.0
"""A node further away than this many lengths of the body is told, not drawn."""

PHASES = (0, 45, 90, 135)
"""Moments of half a period at which a complex mode is drawn, in degrees; the other half is their mirror image."""

DASHES = ("-", "--", "-.", (0, (1, 0.6)))


def nodal_points(
    modes: Modes | DampedModes,
    translation: str,
    rotation: str,
    ends: tuple[float, float],
    ax: Axes | None = None,
    *,
    mode: int | None = None,
) -> Axes:
    """Construct the nodes of a rigid body: both ends of its vibration and where their lines cross.

    Course sections 6.3 and 6.4, Figures 6.5 and 6.6. Of a complex mode, which has no node, lines show the body at
    four phases, their crossings with rest, the envelope, and the place that moves least.

    Parameters
    ----------
    modes : Modes or DampedModes
    translation, rotation : str
        Coordinates of the body: displacement of its reference point and angle.
    ends : (float, float)
        Where the body begins and ends, counted from the reference point [m].
    ax : matplotlib.axes.Axes, optional
        Where to draw one mode; default: new axes, one pair for each mode.
    mode : int, optional
        Only this one, counted from 0.

    Returns
    -------
    matplotlib.axes.Axes
        Of several the first; its words tell all modes.

    Raises
    ------
    EngdynError
        Unknown coordinates, no such mode, ends that are not in order, several modes for one pair of axes.

    Notes
    -----
    With the displacements y + θx of a body, the least amplitude is at x = −Re(y θ̄)/|θ|²; of a real mode it is zero.
    """
    chosen, (low, high) = chosen_modes(modes, mode), _checked_ends(ends)
    if ax is not None and len(chosen) > 1:
        raise EngdynError("nodal_points: these axes have room for one mode; say which by mode=")
    moving = modes.shapes[_rows(modes, translation, rotation)]
    real = np.isrealobj(moving)
    nodes = modes.nodes(translation, rotation) if real else _quietest(*moving)
    near = [x for x in nodes[chosen] if abs(x - (low + high) / 2) < FAR * (high - low)]
    span = np.array([min([low, *near]), max([high, *near])])
    panels = _panels(len(chosen), 7.0 if real else 7.8) if ax is None else [ax]
    told, draw = [], _two_ends if real else _four_phases
    with style():
        for panel, k in zip(panels, chosen, strict=True):
            words = _node_in_words(nodes[k], low, high, real)
            told.append(f"{mode_name(modes, k)}: {words}")
            draw(panel, moving[:, k], nodes[k], np.array([low, high]), span)
            panel.set_title(f"{mode_name(modes, k)}; {words}", loc="left", fontsize=13.0)
            panel.set_ylabel("relative\ndisplacement [1]")
            panel.set_ylim(-1.35, 1.35)
        panels[-1].set_xlabel("distance along the body [m]")
        if not real:
            panels[0].legend(title="phase", loc="upper left", bbox_to_anchor=(1.0, 1.05))
    what = "Both ends of the vibration of a rigid body as lines, and the nodes where they cross"
    if not real:
        what = "A rigid body at four phases of a vibration with damping, and the place that moves least"
    describe(panels[0], f"{what}. {'; '.join(told)}.")
    return panels[0]


def _checked_ends(ends: tuple[float, float]) -> tuple[float, float]:
    try:
        low, high = (float(x) for x in ends)
    except (TypeError, ValueError):
        low = high = math.nan
    if not low < high or not math.isfinite(high - low):
        raise EngdynError(f"ends = {ends}: give where the body begins and where it ends, in meters")
    return low, high


def _rows(modes: Modes | DampedModes, *names: str) -> list[int]:
    if not set(names) <= set(modes.coordinates):
        told = " and ".join(map(repr, names))
        raise EngdynError(f"{told}: choose two of {', '.join(modes.coordinates)}")
    return [modes.coordinates.index(q) for q in names]


def _panels(count: int, width: float) -> list[Axes]:
    with style():
        figure = new_figure(width, 0.6 + 2.1 * count)
        return list(figure.subplots(count, sharex=True, squeeze=False)[:, 0])


def _quietest(y: NDArray, theta: NDArray) -> NDArray[np.float64]:
    """Place of the least amplitude of y + θx in each mode."""
    square = np.abs(theta) ** 2
    turns = square > 0
    return np.where(turns, -np.real(y * np.conj(theta)) / np.where(turns, square, 1.0) + 0.0, np.inf)


def _node_in_words(node: float, low: float, high: float, real: bool = True) -> str:
    if not np.isfinite(node):
        return "no node, it only translates" if np.isinf(node) else "the body is at rest"
    if not real:
        return f"least motion at {number(node)} m"
    return f"node at {number(node)} m, {'on' if low <= node <= high else 'off'} the body"


def _reach(ax: Axes, span: NDArray) -> NDArray[np.float64]:
    """Let the axes end a little beyond body and node, and draw the line of rest."""
    room = 0.06 * (span[1] - span[0])
    ax.set_xlim(span[0] - room, span[1] + room)
    ax.axhline(0.0, color=COLORS["reference"], linewidth=1.0, linestyle="-.")
    return np.array([span[0] - room, span[1] + room])


def _two_ends(ax: Axes, motion: NDArray, node: float, body: NDArray, span: NDArray) -> None:
    """The lines of a real mode; displacements are relative to the largest on the body."""
    y, theta = motion
    largest, reach = np.max(np.abs(y + theta * body)) or 1.0, _reach(ax, span)
    for sign, color, line in ((1.0, PALETTE[0], "-"), (-1.0, PALETTE[1], "--")):
        ax.plot(reach, sign * (y + theta * reach) / largest, color=color, linewidth=1.0, linestyle=":")
        ax.plot(body, sign * (y + theta * body) / largest, color=color, linewidth=5.0, linestyle=line)
    if span[0] <= node <= span[1]:
        look = {"markerfacecolor": "white", "markeredgecolor": "black", "markersize": 11.0}
        ax.plot([node], [0.0], "o", zorder=5, **look)


def _four_phases(ax: Axes, motion: NDArray, quietest: float, body: NDArray, span: NDArray) -> None:
    """The lines of a complex mode, their crossings with rest, and the envelope."""
    y, theta = motion / np.max(np.abs(motion[0] + motion[1] * body))
    reach = _reach(ax, span)
    along = np.linspace(*reach, 201)
    for sign in (1.0, -1.0):
        amplitude = sign * np.abs(y + theta * along)
        ax.plot(along, amplitude, color=COLORS["reference"], linewidth=1.4, linestyle=(0, (4, 2)))
    for phase, color, line in zip(PHASES, PALETTE, DASHES, strict=False):
        turned = np.exp(1j * np.radians(phase)) * np.array([y, theta])
        rise, slope = turned.real
        ax.plot(body, rise + slope * body, color=color, linewidth=3.6, linestyle=line, label=f"{phase}°")
        ax.plot(reach, rise + slope * reach, color=color, linewidth=1.0, linestyle=":")
        crossing = -rise / slope if slope else np.inf
        if reach[0] <= crossing <= reach[1]:
            ax.plot([crossing], [0.0], "s", color=color, markersize=7.0, zorder=5)
    if span[0] <= quietest <= span[1]:
        least = np.abs(y + theta * quietest)
        ax.plot([quietest] * 2, [-least, least], "k_-", linewidth=1.6, markersize=12.0, zorder=6)
