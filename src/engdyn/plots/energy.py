"""Potential energy over one or two coordinates: equilibria are its stationary points (course chapter 4)."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
import sympy as sm
from matplotlib.axes import Axes
from numpy.typing import ArrayLike, NDArray
from sympy.core.function import AppliedUndef
from sympy.physics.vector import dynamicsymbols

from engdyn.algebra.codegen import compile_elements
from engdyn.algebra.conversion import Converter
from engdyn.algebra.expressions import as_expression
from engdyn.errors import EngdynError
from engdyn.plots.alternative import describe
from engdyn.plots.axes import MARKS, coordinate_axis, coordinate_range, index_of, is_stable, legend_entry
from engdyn.plots.drawing import checked_pose
from engdyn.plots.equilibria import verdicts
from engdyn.plots.look import PALETTE, new_axes, style
from engdyn.plots.words import number, pose, with_unit

if TYPE_CHECKING:
    from engdyn.analysis.equilibrium import Equilibrium
    from engdyn.system import System

__all__ = ["effective_potential", "potential_energy"]


def potential_energy(
    system: System,
    values: Mapping[str, float] | None = None,
    x: str | tuple[str, ArrayLike] | None = None,
    y: str | tuple[str, ArrayLike] | None = None,
    equilibria: Sequence[Equilibrium] | None = None,
    ax: Axes | None = None,
    *,
    at: ArrayLike | None = None,
) -> Axes:
    """Plot the potential energy over one coordinate, or as contours over two (course sections 4.2 and 4.3).

    Where a speed is kept up from outside, T contains a part T₀ without rates; then V − T₀ is shown, whose
    stationary points are the steady motions (Lagrange 1788; Goldstein, Poole and Safko 2002, section 2.7).

    Parameters
    ----------
    system : System
    values : mapping of str to float, optional
        Parameter values in SI units; what is not given has its default.
    x, y : str or (str, array_like), optional
        Coordinates to plot over, by name or with the values (m or rad) to plot at. Default for ``x``: the
        first coordinate on which the energy depends; without ``y`` a curve is drawn.
    equilibria : sequence of Equilibrium, optional
        States to mark, filled where stable.
    ax : matplotlib.axes.Axes, optional
        Where to draw; default: new axes.
    at : array_like, shape (n,), optional
        Where the other coordinates are held; default: at the first of ``equilibria``, else at zero.

    Returns
    -------
    matplotlib.axes.Axes

    Raises
    ------
    EngdynError
        Unknown coordinate, a pose of the wrong length, an energy that depends explicitly on time.
    """
    values = system.values(**dict(values or {}))
    states = list(equilibria or [])
    held = checked_pose(
        system, at if at is not None else (states[0].q if states else np.zeros(len(system.coordinates)))
    )
    energy, name = effective_potential(system, values)
    across, grid_x = _grid(system, x if x is not None else _first_dependent(system, energy, held), states)
    stable = [is_stable(verdict) for verdict in verdicts(system, states)]
    ax = new_axes() if ax is None else ax
    with style():
        if y is None:
            marks = _curve(ax, system, energy, name, across, grid_x, held, states)
        else:
            up, grid_y = _grid(system, y, states)
            if up == across:
                raise EngdynError(
                    f"x and y are both {system.coordinates[up].name!r}; choose two coordinates."
                )
            marks = _contours(ax, system, energy, name, (across, grid_x), (up, grid_y), held, states)
        _mark(ax, marks, stable)
        ax.set_title(system.title, pad=14.0)
    over = [system.coordinates[i] for i in ([across] if y is None else [across, up])]
    _tell(ax, system, name, states, stable, energy, over)
    return ax


def effective_potential(
    system: System, values: Mapping[str, float]
) -> tuple[Callable[[NDArray[np.float64]], NDArray[np.float64]], str]:
    """Return V, or V − T₀ where T has a part without rates that varies, as a function of poses, and its name.

    Parameters
    ----------
    system : System
    values : mapping of str to float
        All parameters in SI units.

    Returns
    -------
    energy : callable
        From poses of shape (..., n) to joules of shape (...).
    name : str
        Mathtext ``$V$`` or ``$V - T_0$``.

    Raises
    ------
    EngdynError
        The energy depends explicitly on time.
    """
    symbols = [c.symbol for c in system.coordinates]
    still, kinetic = (_at_rest(system, e) for e in (system.potential_energy, system.kinetic_energy))
    steady = bool(kinetic.free_symbols) and kinetic.has(*symbols)
    expression = still - kinetic if steady else still
    if dynamicsymbols._t in expression.xreplace({q: sm.Dummy() for q in symbols}).free_symbols:
        raise EngdynError(
            f"The energy of {system.title} depends on time; a plot over coordinates shows one instant."
        )
    known = {s: values[s.name] for s in expression.free_symbols if s.name in values}
    element = Converter([expression]).convert(expression)
    arguments = [*(("function", q, 0) for q in symbols), *(("symbol", s) for s in known)]
    compiled = compile_elements([element], arguments, "numpy")

    def energy(poses: NDArray[np.float64]) -> NDArray[np.float64]:
        columns = [poses[..., i] for i in range(len(symbols))]
        return np.broadcast_to(compiled(*columns, *known.values())[0], poses.shape[:-1])

    return energy, "$V - T_0$" if steady else "$V$"


def _at_rest(system: System, expression: Any) -> sm.Expr:
    """Put zero for the rates of the coordinates; inputs take their defaults or vanish."""
    expression = as_expression(expression, "an energy")
    own = {c.symbol for c in system.coordinates}
    known = dict.fromkeys(expression.atoms(sm.Derivative) | (expression.atoms(AppliedUndef) - own), sm.S.Zero)
    for item in system.inputs:
        for order, default in enumerate(item.default or (0, 0, 0)):
            known[item.symbol.diff(dynamicsymbols._t, order)] = as_expression(
                default, "the default of an input"
            )
    return expression.xreplace(known)


def _first_dependent(system: System, energy: Callable, held: NDArray) -> str:
    """Name the first coordinate along which the energy is not constant."""
    for i, coordinate in enumerate(system.coordinates):
        poses = np.tile(held, (7, 1))
        poses[:, i] = np.linspace(*coordinate_range(coordinate), 7)
        if np.ptp(energy(poses)) > 1e-12 * (1.0 + np.max(abs(energy(poses)))):
            return coordinate.name
    return system.coordinates[0].name


def _grid(
    system: System, choice: str | tuple[str, ArrayLike], states: Sequence
) -> tuple[int, NDArray[np.float64]]:
    """Return the place of the chosen coordinate and the values to plot at."""
    if isinstance(choice, str):
        index = index_of(system, choice)
        low, high = coordinate_range(system.coordinates[index], [state.q[index] for state in states])
        return index, np.linspace(low, high, 241)
    index, grid = index_of(system, choice[0]), np.asarray(choice[1], float)
    if grid.ndim != 1 or len(grid) < 2 or not np.all(np.isfinite(grid)):
        raise EngdynError(f"{choice[0]}: give at least two finite values to plot at; given {choice[1]!r}.")
    return index, grid


def _curve(ax, system, energy, name, across, grid, held, states) -> NDArray[np.float64]:
    poses = np.tile(held, (len(grid), 1))
    poses[:, across] = grid
    ax.plot(grid, energy(poses), color=PALETTE[6])
    coordinate_axis(ax.xaxis, system.coordinates[across], np.ptp(grid))
    ax.set_ylabel(with_unit(name, "J"))
    ax.ticklabel_format(axis="y", scilimits=(-3, 4), useMathText=True)
    ax.margins(x=0.02, y=0.12)
    q = np.array([state.q for state in states], float).reshape(-1, len(held))
    on_curve = np.tile(held, (len(q), 1))
    on_curve[:, across] = q[:, across]
    return np.column_stack([q[:, across], energy(on_curve)])


def _contours(ax, system, energy, name, x, y, held, states) -> NDArray[np.float64]:
    (across, grid_x), (up, grid_y) = x, y
    poses = np.tile(held, (len(grid_y), len(grid_x), 1))
    poses[..., across], poses[..., up] = np.meshgrid(grid_x, grid_y)
    height = energy(poses)
    filled = ax.contourf(grid_x, grid_y, height, levels=24, cmap="cividis")
    ax.contour(filled, colors="white", linewidths=0.6, alpha=0.6)
    bar = ax.get_figure(root=True).colorbar(filled, ax=ax)
    bar.set_label(with_unit(name, "J"))
    bar.formatter.set_powerlimits((-3, 4))
    bar.formatter.set_useMathText(True)
    coordinate_axis(ax.xaxis, system.coordinates[across], np.ptp(grid_x))
    coordinate_axis(ax.yaxis, system.coordinates[up], np.ptp(grid_y))
    ax.grid(False)
    return np.array([[state.q[across], state.q[up]] for state in states], float).reshape(-1, 2)


def _mark(ax: Axes, marks: NDArray[np.float64], stable: Sequence[bool]) -> None:
    for kind in (True, False):
        chosen = marks[[s is kind for s in stable]] if len(marks) else marks
        if len(chosen):
            # The white rim keeps a filled mark visible on dark contours.
            look = {
                **MARKS[kind],
                "linestyle": "",
                "markeredgecolor": "white" if kind else MARKS[kind]["color"],
            }
            ax.plot(
                *chosen.T, marker="o", markersize=11.0, markeredgewidth=2.0, zorder=5, clip_on=False, **look
            )
    kinds = sorted(set(stable), reverse=True)
    if kinds:
        ax.legend(handles=[legend_entry(kind, "o") for kind in kinds], loc="best", frameon=True)


def _tell(ax, system, name, states, stable, energy, over) -> None:
    plain = "potential energy V" if "T" not in name else "effective potential V − T₀"
    text = f"{system.title}: {plain} in J over {' and '.join(with_unit(c.name, c.unit) for c in over)}."
    for state, is_well in zip(states, stable, strict=True):
        height = float(energy(np.asarray(state.q, float)))
        kind = "stable" if is_well else "unstable"
        text += f" Equilibrium at {pose(system.coordinates, state.q)}, {number(height)} J, {kind}."
    describe(ax, text)
