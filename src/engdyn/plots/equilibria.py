"""Pictures of equilibria: their poses on the drawing, and how they move with a parameter (chapter 4)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray

from engdyn.errors import EngdynError
from engdyn.plots.alternative import describe
from engdyn.plots.axes import MARKS, coordinate_axis, is_stable, legend_entry, split
from engdyn.plots.drawing import Layer, draw_layers, drawing_axes, structure
from engdyn.plots.look import new_axes, style
from engdyn.plots.pen import direction
from engdyn.plots.words import number, plain_symbol, plain_verdict, pose, quantity, symbol, with_unit
from engdyn.shapes import Label, Shape

if TYPE_CHECKING:
    from engdyn.analysis.branches import BranchSet
    from engdyn.analysis.equilibrium import Equilibrium
    from engdyn.system import System

__all__ = ["branches", "equilibrium_poses", "verdicts"]

MARGIN, SIZE = (76.0, 44.0), 15.0
"""Room around the poses for their names, and the size of their letters, in points."""

FEW = 4
"""Up to so many poses are labeled with their coordinates; more get numbers."""


def verdicts(system: System, equilibria: Sequence[Equilibrium]) -> list[str]:
    """Return the stability verdict of each equilibrium, from the linearized equations (chapter 5)."""
    if not equilibria:
        return []
    from engdyn.analysis.linear import linearize
    from engdyn.analysis.stability import stability

    eom = system.equations
    return [stability(linearize(eom, state)).verdict for state in equilibria]


def equilibrium_poses(
    system: System,
    equilibria: Sequence[Equilibrium],
    ax: Axes | None = None,
    *,
    judged: Sequence[str] | None = None,
) -> Axes:
    """Draw all equilibria of a system on top of each other: stable ones solid, unstable ones broken.

    Course section 4.2, Fig. 4.2.

    Parameters
    ----------
    system : System
    equilibria : sequence of Equilibrium
        What ``system.equilibria`` returned.
    ax : matplotlib.axes.Axes, optional
        Where to draw; default: new axes.
    judged : sequence of str, optional
        Stability verdicts, one for each equilibrium, if they are known already.

    Returns
    -------
    matplotlib.axes.Axes

    Raises
    ------
    EngdynError
        There is no equilibrium to draw.
    """
    if not len(equilibria):
        raise EngdynError(f"{system.title}: no equilibrium was found, so there is no pose to draw.")
    judged = verdicts(system, equilibria) if judged is None else list(judged)
    stable = [is_stable(verdict) for verdict in judged]
    drawn = [
        _without_dampers(system.shapes(np.asarray(state.q, float), dict(state.values)))
        for state in equilibria
    ]
    names = _names(system, equilibria, stable)
    layers = [
        Layer([*shapes, Label(at, name, side, "coordinate" if kind else "input")], dashed=not kind)
        for shapes, kind, name, (at, side) in zip(drawn, stable, names, _label_places(drawn), strict=True)
    ]
    layers.sort(key=lambda layer: not layer.dashed)
    ax = drawing_axes(layers, margin=MARGIN) if ax is None else ax
    draw_layers(ax, layers, margin=MARGIN, size=SIZE)
    parts = [
        f"{i}: {pose(system.coordinates, state.q)} ({plain_verdict(verdict)})"
        for i, (state, verdict) in enumerate(zip(equilibria, judged, strict=True), 1)
    ]
    count = f"{len(parts)} equilibri{'um' if len(parts) == 1 else 'a'}"
    describe(ax, f"{system.title}, {count} drawn on top of each other. {'; '.join(parts)}.")
    return ax


def _without_dampers(shapes: Sequence[Shape]) -> list[Shape]:
    """Return the structure but for the dampers: at rest they exert no force and crowd the picture."""
    return [shape for shape in structure(shapes) if shape.role != "damper"]


def _names(system: System, equilibria: Sequence[Equilibrium], stable: Sequence[bool]) -> list[str]:
    """Return a short name for each pose: the coordinates in which they differ, or a number if many."""
    kinds = ["stable" if kind else "unstable" for kind in stable]
    if len(equilibria) > FEW:
        return [f"{i}" for i in range(1, len(equilibria) + 1)]
    q = np.array([state.q for state in equilibria], float)
    differ = np.flatnonzero(np.ptp(q, axis=0) > 1e-9)[:2]
    chosen = [system.coordinates[i] for i in differ]
    rows = [
        [f"{plain_symbol(c)} = {_short(q[k, i], c.unit)}" for i, c in zip(differ, chosen, strict=True)]
        for k in range(len(q))
    ]
    return ["\n".join([*row, kind]) for row, kind in zip(rows, kinds, strict=True)]


def _short(value: float, unit: str) -> str:
    return (
        f"{number(np.degrees(value).round(1))}°"
        if unit == "rad"
        else f"{number(float(f'{value:.3g}'))} {unit}"
    )


def _label_places(drawn: Sequence[Sequence[Shape]]) -> list[tuple[tuple[float, ...], tuple[float, float]]]:
    """Return where to name each pose: at the body that moves most between the poses, on its outer side."""
    centers = [[_center(shape) for shape in shapes if shape.role == "body"] for shapes in drawn]
    bodies = min(len(row) for row in centers)
    if not bodies:
        return [((0.0, 0.0), (1.0, 0.0))] * len(drawn)
    places = np.array([row[:bodies] for row in centers])
    most = int(np.argmax(np.ptp(places, axis=0).sum(axis=-1)))
    middle = places[:, most].mean(axis=0)
    return [(tuple(row[most]), tuple(direction((row[most] - middle)[:2]))) for row in places]


def _center(shape: Any) -> NDArray[np.float64]:
    for name in ("center", "point"):
        if hasattr(shape, name):
            return np.array(getattr(shape, name))
    return np.mean(shape.points, axis=0)


def branches(branch_set: BranchSet, coordinate: str, ax: Axes | None = None, *, system: System) -> Axes:
    """Plot how one coordinate of the equilibria moves with a parameter (course section 4.3).

    Stable branches are solid, unstable ones broken; folds, pitchforks and transcritical points are named.

    Parameters
    ----------
    branch_set : BranchSet
        What ``engdyn.continue_equilibria`` returned.
    coordinate : str
        Name of the coordinate to plot upward.
    ax : matplotlib.axes.Axes, optional
        Where to draw; default: new axes.
    system : System
        Knows symbols and units.

    Returns
    -------
    matplotlib.axes.Axes

    Raises
    ------
    EngdynError
        Unknown coordinate.
    """
    from engdyn.plots.axes import index_of

    index = index_of(system, coordinate)
    parameter = next(p for p in system.parameters if p.name == branch_set.parameter)
    ax = new_axes() if ax is None else ax
    with style():
        for kind in (True, False):
            across, up = _runs(branch_set, index, kind)
            if len(across):
                ax.plot(across, up, **{k: v for k, v in MARKS[kind].items() if k != "markerfacecolor"})
        for point in branch_set.points:
            _mark_point(ax, point, index)
        ax.set_xlabel(with_unit(symbol(parameter), parameter.unit))
        ax.ticklabel_format(axis="x", scilimits=(-3, 4), useMathText=True)
        low, high = ax.get_ylim()
        coordinate_axis(ax.yaxis, system.coordinates[index], high - low)
        handles = [legend_entry(kind) for kind in (True, False) if len(_runs(branch_set, index, kind)[0])]
        if handles:
            ax.legend(handles=handles, loc="best", frameon=True)
        ax.margins(y=0.08)
        ax.set_xlim(*branch_set.range)
    describe(ax, _branches_in_words(branch_set, system, parameter, index))
    return ax


def _runs(branch_set: BranchSet, index: int, kind: bool) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return all stretches of one stability as one line, interrupted by NaN."""
    across, up = [], []
    for branch in branch_set:
        parameter, q, stable = _judged(branch, branch_set.points)
        for run in split(stable):
            if stable[run.start] == kind:
                across += [parameter[run], [np.nan]]
                up += [q[run, index], [np.nan]]
    return np.concatenate([*across, []]), np.concatenate([*up, []])


def _judged(branch: Any, points: Sequence[Any]) -> tuple[NDArray, NDArray, NDArray[np.bool_]]:
    """Return parameter, coordinates and stability along a branch, changing exactly where branches meet.

    A state at a meeting point is marginal: it takes the stability of what follows. Where the stability
    changes between two states, the meeting point between them is inserted.
    """
    parameter, q, stable = (np.array(part) for part in (branch.parameter, branch.q, branch.stable))
    for point in points:
        state = np.concatenate([[point.parameter], point.q])
        states = np.column_stack([parameter, q])
        scale = np.maximum(np.ptp(states, axis=0), 1e-12)
        apart = np.max(abs(states - state) / scale, axis=1)
        for i in np.flatnonzero(apart < 1e-6):
            stable[i] = stable[i + 1] if i + 1 < len(stable) else stable[i - 1]
        for i in np.flatnonzero(np.diff(stable)):
            step = 1.01 * np.max(abs(states[i + 1] - states[i]) / scale)
            if apart[i] <= step and 1e-6 < apart[i + 1] <= step:
                parameter = np.insert(parameter, i + 1, point.parameter)
                q, stable = np.insert(q, i + 1, point.q, axis=0), np.insert(stable, i + 1, stable[i + 1])
                break
    return parameter, q, stable


def _mark_point(ax: Axes, point: Any, index: int) -> None:
    x, y = float(point.parameter), float(point.q[index])
    ax.plot([x], [y], marker="D", color="black", markersize=7.0, linestyle="", zorder=6)
    ax.annotate(point.kind, (x, y), xytext=(8.0, 8.0), textcoords="offset points", fontsize=12.0, zorder=7)


def _branches_in_words(branch_set: BranchSet, system: System, parameter: Any, index: int) -> str:
    coordinate = system.coordinates[index]
    text = f"{system.title}: {coordinate.name} [{coordinate.unit}] of the equilibria over {parameter.name}"
    text += f" [{parameter.unit}], {len(branch_set)} branch{'' if len(branch_set) == 1 else 'es'}."
    for branch in branch_set:
        first, last = (quantity(parameter.name, float(branch.parameter[i]), parameter.unit) for i in (0, -1))
        ends = " to ".join(number(float(branch.q[i][index])) for i in (0, -1))
        stable = _judged(branch, branch_set.points)[2]
        share = "stable" if stable.all() else ("partly stable" if stable.any() else "unstable")
        text += f" From {first} to {last}: {coordinate.name} {ends}, {share}."
    for point in branch_set.points:
        where = quantity(parameter.name, float(point.parameter), parameter.unit)
        text += f" {point.kind.capitalize()} at {where}."
    return text
