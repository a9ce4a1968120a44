"""Pictures of modes: shapes on the system's own drawing or as bars, phasors.  Chapter 6."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.axes import Axes
from sympy.printing.pretty.pretty_symbology import pretty_symbol

from engdyn.errors import EngdynError
from engdyn.plots.alternative import describe
from engdyn.plots.drawing import Layer, _corners, structure
from engdyn.plots.look import COLORS, PALETTE, new_axes, new_figure, style
from engdyn.plots.motion import mode_motion
from engdyn.plots.projection import View
from engdyn.plots.stage import HEADING
from engdyn.plots.strobe import draw_strobe
from engdyn.plots.words import number, pose

if TYPE_CHECKING:
    from engdyn.analysis.damped_modes import DampedModes
    from engdyn.analysis.modes import Modes
    from engdyn.system import System

__all__ = ["chosen_modes", "mode_name", "mode_shapes", "phasors"]

HATCHES = ("", "//", "..", "xx", "--", "oo", "++")
"""Tell bars of different modes apart without color."""

WIDTH, TALLEST, FLATTEST = 3.9, 3.6, 1.3
"""Width of the drawing of one mode of several, largest and smallest height, in inches."""

ALONE = 1.3
"""The drawing of a single mode may be larger by this factor."""


def mode_shapes(
    modes: Modes | DampedModes,
    ax: Axes | None = None,
    *,
    system: System | None = None,
    mode: int | None = None,
    values: Mapping[str, float] | None = None,
    view: View | None = None,
) -> Axes:
    """Draw mode shapes: on the drawing of the system, or as bars.

    Course sections 6.1 and 6.4, Figures 6.1, 6.2, 6.4 and 6.6.

    Parameters
    ----------
    modes : Modes or DampedModes
    ax : matplotlib.axes.Axes, optional
        Where to draw; default: new axes, one pair for each mode on the drawing of a system.
    system : System, optional
        Both ends of the vibration and the position of rest between them are drawn, from faint to strong, enlarged
        until they can be seen; of a complex mode, four positions within half a period. Without a system, bars show
        the components times √Mᵢᵢ, which compares translations with rotations as energies do.
    mode : int, optional
        Only this one, counted from 0.
    values : mapping of str to float, optional
        Parameters of the drawing; default: those of the linearization.
    view : View, optional
        From where a system in space is seen.

    Returns
    -------
    matplotlib.axes.Axes
        Of several the first; its words tell all modes.

    Raises
    ------
    EngdynError
        No such mode; several drawings for one pair of axes; a system with other coordinates; bars of complex modes.

    Notes
    -----
    ``plots.animate(system, plots.mode_motion(...))`` sets a mode in motion.
    """
    chosen = chosen_modes(modes, mode)
    if system is None:
        return _bars(modes, chosen, ax)
    if ax is not None and len(chosen) > 1:
        raise EngdynError("mode_shapes: these axes have room for the drawing of one mode; say which by mode=")
    if tuple(getattr(c, "name", c) for c in getattr(system, "coordinates", ())) != modes.coordinates:
        raise EngdynError(
            f"{getattr(system, 'title', repr(system))} does not have the coordinates of these modes, "
            f"{', '.join(modes.coordinates)}"
        )
    view = view or View()
    drawings = [_positions(modes, k, system, values) for k in chosen]
    panels = _panels(drawings, view) if ax is None else [ax]
    for panel, drawn, k in zip(panels, drawings, chosen, strict=True):
        draw_strobe(drawn, mode_name(modes, k), panel, view)
    told = "; ".join(f"{mode_name(modes, k)}: {_components(modes, k)}" for k in chosen)
    describe(
        panels[0],
        f"{system.title}, mode shapes on its drawing, enlarged, about {_rest(system, modes)}. {told}.",
    )
    return panels[0]


def chosen_modes(modes: Any, mode: int | None) -> list[int]:
    """The modes to draw: all, or one that there is."""
    shapes = getattr(modes, "shapes", None)
    if getattr(shapes, "ndim", 0) != 2:
        raise EngdynError(f"{modes!r} holds no modes: give what engdyn.modes or engdyn.damped_modes returned")
    count = shapes.shape[1]
    if not count:
        raise EngdynError("nothing oscillates: there is no mode shape to draw")
    if mode is not None and not (isinstance(mode, int | np.integer) and 0 <= mode < count):
        raise EngdynError(f"mode = {mode!r}: there are the modes 0 to {count - 1}, counted from 0")
    return list(range(count)) if mode is None else [int(mode)]


def mode_name(modes: Any, k: int) -> str:
    """Number, frequency and damping ratio of a mode."""
    ratio = f", ζ = {number(modes.damping_ratio[k])}" if hasattr(modes, "damping_ratio") else ""
    return f"mode {k + 1}: {number(modes.natural_frequency[k])} Hz{ratio}"


def _components(modes: Any, k: int) -> str:
    """Shape in words; the phases of a complex one in degrees."""
    column = modes.shapes[:, k]
    if np.isrealobj(column):
        return _listed(modes.coordinates, column)
    phases = np.degrees(modes.phases[:, k])
    parts = zip(modes.coordinates, np.abs(column), phases, strict=True)
    return ", ".join(f"{q} {number(x)} at {number(round(p, 1))}°" for q, x, p in parts)


def _listed(names: Sequence[str], column: Any) -> str:
    return ", ".join(f"{q} {number(x)}" for q, x in zip(names, column, strict=True))


def _rest(system: System, modes: Any) -> str:
    return pose(system.coordinates, modes.linear.at.q)


def _positions(modes: Any, k: int, system: System, values: Mapping[str, float] | None) -> list[list]:
    """Drawings of the system at some moments of one period."""
    at, column = modes.linear.at, modes.shapes[:, k]
    values = system.complete(dict(at.values) if values is None else values)
    _, q = mode_motion(at.q, column, 1.0, system=system, values=values)  # only positions count here
    half = (len(q) - 1) // 2
    steps = (half, half // 2, 0) if np.isrealobj(column) else np.linspace(0, 0.75 * half, 4).astype(int)
    poses = [q[i] for i in steps]
    if np.isrealobj(column):
        poses[1] = np.array(at.q, dtype=float)
    return [structure(system.shapes(x, values)) for x in poses]


def _panels(drawings: Sequence[Sequence], view: View) -> list[Axes]:
    """One pair of axes for each mode, two in a row, shaped as the drawings are."""
    corners = [_corners([Layer(shapes) for shapes in drawn], 1e-9, view) for drawn in drawings]
    spans = np.array([np.ptp(c, axis=0) for c in corners])
    aspect = float(np.max(spans[:, 1] / np.maximum(spans[:, 0], 1e-12)))
    columns = min(2, len(drawings))
    rows = -(-len(drawings) // columns)
    scale = ALONE if columns == 1 else 1.0
    height = scale * float(np.clip(WIDTH * aspect, FLATTEST, TALLEST)) + HEADING / 72.0
    figure = new_figure(columns * scale * WIDTH, rows * height, layout=None)
    share = 1.0 - HEADING / (72.0 * height)
    return [
        figure.add_axes((i % columns / columns, 1.0 - (i // columns + 1) / rows, 1.0 / columns, share / rows))
        for i in range(len(drawings))
    ]


def _bars(modes: Any, chosen: Sequence[int], ax: Axes | None) -> Axes:
    from engdyn.analysis.undamped import sizes

    if not np.isrealobj(modes.shapes):
        raise EngdynError(
            "mode_shapes: bars do not show phases; use phasors, or give system= for the drawing"
        )
    weighted = modes.shapes * sizes(modes.linear)[:, None]
    ax = new_axes() if ax is None else ax
    places, width = np.arange(len(modes.coordinates)), 0.8 / len(chosen)
    with style():
        for i, k in enumerate(chosen):
            look = {
                "color": PALETTE[i % 7],
                "hatch": HATCHES[i % 7],
                "edgecolor": "white",
                "label": mode_name(modes, k),
            }
            ax.bar(places + (i - (len(chosen) - 1) / 2) * width, weighted[:, k], width, **look)
        ax.axhline(0.0, color=COLORS["reference"], linewidth=1.0)
        ax.set_xticks(places, [pretty_symbol(q) for q in modes.coordinates])
        ax.grid(visible=False, axis="x")
        ax.set_ylabel(r"component $\times \sqrt{M_{ii}}$ [1]")
        ax.legend(loc="best", frameon=True)
    told = "; ".join(f"{mode_name(modes, k)}: {_listed(modes.coordinates, weighted[:, k])}" for k in chosen)
    describe(ax, f"Mode shapes as bars, each component times the root of its own mass or inertia. {told}.")
    return ax


def phasors(modes: DampedModes, mode: int = 0, ax: Axes | None = None) -> Axes:
    """Draw a complex mode as arrows in the complex plane: size and phase of each coordinate.

    Course section 6.4. All arrows turn together, counter-clockwise; a motion is the projection on the real axis.
    Components are multiplied by √Mᵢᵢ, so that lengths of translations and rotations compare, and the largest is 1.

    Parameters
    ----------
    modes : DampedModes
    mode : int
        Which one, counted from 0.
    ax : matplotlib.axes.Axes, optional
        Where to draw; default: new axes.

    Returns
    -------
    matplotlib.axes.Axes

    Raises
    ------
    EngdynError
        No such mode.
    """
    from engdyn.analysis.undamped import sizes

    if not hasattr(modes, "phases"):
        raise EngdynError(f"{modes!r} has no phases: give what engdyn.damped_modes returned")
    (k,) = chosen_modes(modes, 0 if mode is None else mode)
    weighted = modes.shapes[:, k] * sizes(modes.linear)
    weighted = weighted / np.max(np.abs(weighted))
    phases = np.degrees(modes.phases[:, k])
    ax = new_axes(7.6, 4.8) if ax is None else ax
    turn = np.exp(1j * np.linspace(0.0, 2 * np.pi, 181))
    with style():
        for radius in (0.5, 1.0):
            ax.plot(radius * turn.real, radius * turn.imag, color="#c3c7cc", linewidth=1.0)
        for i, (q, z, phase) in enumerate(zip(modes.coordinates, weighted, phases, strict=True)):
            text = f"{pretty_symbol(q)}:  {abs(z):.3f} ∠ {number(round(phase, 1))}°"
            look = {"color": PALETTE[i % 7], "linewidth": 2.6, "linestyle": ("-", "--", "-.", ":")[i % 4]}
            ax.plot([0.0, z.real], [0.0, z.imag], label=text, **look)
            if abs(z) > 0.02:
                head = {
                    "arrowstyle": "-|>",
                    "color": look["color"],
                    "mutation_scale": 20.0,
                    "shrinkA": 0,
                    "shrinkB": 0,
                }
                ax.annotate("", (z.real, z.imag), (0.9 * z.real, 0.9 * z.imag), arrowprops=head)
                tip = z * (1.0 + 0.1 / abs(z))
                ax.text(tip.real, tip.imag, pretty_symbol(q), color=look["color"], ha="center", va="center")
        ax.set_xlim(-1.25, 1.25)
        ax.set_ylim(-1.25, 1.25)
        ax.set_aspect("equal", adjustable="box")
        ax.set_xlabel(r"Re, component $\times \sqrt{M_{ii}}$ [1]")
        ax.set_ylabel("Im [1]")
        ax.set_title(mode_name(modes, k), loc="left")
        ax.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0))
    describe(ax, f"Phasors of {mode_name(modes, k)}. {_components(modes, k)}.")
    return ax
