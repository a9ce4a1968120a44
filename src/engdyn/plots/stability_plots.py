"""Where a motion is stable, and how its eigenvalues move: maps and root loci (chapter 5)."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import sympy as sm
from matplotlib.axes import Axes
from matplotlib.colors import ListedColormap
from matplotlib.patches import Patch
from sympy.physics.vector.printing import vlatex

from engdyn.errors import EngdynError
from engdyn.plots.alternative import describe
from engdyn.plots.look import COLORS, new_axes, style
from engdyn.plots.words import number, plain_verdict, symbol, with_unit

if TYPE_CHECKING:
    from engdyn.analysis.stability_map import StabilityMap
    from engdyn.system import System

__all__ = ["root_locus", "stability_map"]

AREAS = {
    "asymptotically stable": ("#cfe3f2", ""),
    "marginal": ("#f7e7b6", ".."),
    "unstable (divergence)": ("#f2b48f", "\\\\"),
    "unstable (flutter)": ("#d9a3c3", "//"),
    "no equilibrium": ("#ffffff", "xx"),
}
"""Fill and hatching of each verdict: different in hue, in brightness and in pattern."""


def stability_map(found: StabilityMap, ax: Axes | None = None, *, system: System | None = None) -> Axes:
    """Draw the verdicts on one equilibrium over a plane of two parameters (course section 5.5).

    Parameters
    ----------
    found : StabilityMap
        What ``engdyn.stability_map`` returned.
    ax : matplotlib.axes.Axes, optional
        Where to draw; default: new axes.
    system : System, optional
        Knows the units of the parameters.

    Returns
    -------
    matplotlib.axes.Axes

    Raises
    ------
    EngdynError
        A parameter with fewer than two values.
    """
    _check_map(found)
    (_, across), (_, up) = found.x, found.y
    if min(len(across), len(up)) < 2:
        raise EngdynError("a map needs at least two values of each parameter; draw one row with root_locus.")
    present = [verdict for verdict in AREAS if np.any(found.verdict == verdict)]
    codes = sum(k * (found.verdict == verdict) for k, verdict in enumerate(present))
    ax = new_axes() if ax is None else ax
    with style():
        fills = ListedColormap([AREAS[verdict][0] for verdict in present])
        ax.pcolormesh(across, up, codes, cmap=fills, vmin=-0.5, vmax=len(present) - 0.5, rasterized=True)
        ink = COLORS["body"]
        for k, verdict in enumerate(present):
            share = (codes == k).astype(float)
            if AREAS[verdict][1]:
                hatched = ax.contourf(
                    across, up, share, [0.5, 1.5], colors="none", hatches=[AREAS[verdict][1]]
                )
                hatched.set(edgecolor="#6b7077", linewidth=0.0)
            if 0 < share.mean() < 1:
                ax.contour(across, up, share, [0.5], colors=ink, linewidths=1.2)
        ax.set(xlabel=_label(found.x[0], system), ylabel=_label(found.y[0], system))
        ax.grid(False)
        keys = [
            Patch(facecolor=AREAS[v][0], hatch=AREAS[v][1], edgecolor="#6b7077", label=plain_verdict(v))
            for v in present
        ]
        ax.legend(handles=keys, loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=2)
    describe(ax, _map_in_words(found, system, present))
    return ax


def _check_map(found: Any) -> None:
    if not hasattr(found, "verdict") or not hasattr(found, "eigenvalues") or not hasattr(found, "x"):
        raise EngdynError(f"{found!r} is no stability map: give what engdyn.stability_map returned")


def _map_in_words(found: StabilityMap, system: System | None, present: list[str]) -> str:
    ranges = " and ".join(
        f"{name} from {_quantity(name, array[0], system)} to {_quantity(name, array[-1], system)}"
        for name, array in (found.x, found.y)
    )
    shares = ", ".join(f"{plain_verdict(v)} {100 * found.shares[v]:.0f} %" for v in present)
    text = f"Map of stability over {ranges}: {shares} of the area."
    for row, place in ((0, "lowest"), (-1, "highest")):
        verdicts, at = found.verdict[row], found.x[1]
        runs = [plain_verdict(verdicts[0])]
        for i in np.flatnonzero(verdicts[1:] != verdicts[:-1]):
            where = _quantity(found.x[0], float(at[i] + at[i + 1]) / 2, system)
            runs.append(f"from {found.x[0]} = {where} {plain_verdict(verdicts[i + 1])}")
        text += f" At the {place} {found.y[0]}: {', '.join(runs)}."
    return text


def _parameter(name: str, system: System | None) -> Any:
    return next((p for p in system.parameters if p.name == name), None) if system is not None else None


def _label(name: str, system: System | None) -> str:
    parameter = _parameter(name, system)
    if parameter is None:
        return f"${vlatex(sm.Symbol(name))}$"
    return with_unit(symbol(parameter), parameter.unit)


def _quantity(name: str, value: float, system: System | None) -> str:
    parameter = _parameter(name, system)
    unit = "" if parameter is None or parameter.unit in ("", "-") else f" {parameter.unit}"
    return number(float(value)) + unit


def root_locus(
    found: StabilityMap, ax: Axes | None = None, *, row: int = 0, system: System | None = None
) -> Axes:
    """Draw how the eigenvalues move with one parameter (course section 5.5).

    Parameters
    ----------
    found : StabilityMap
        What ``engdyn.stability_map`` returned; eigenvalues over its parameter x, one value of y suffices.
    ax : matplotlib.axes.Axes, optional
        Where to draw; default: new axes.
    row : int
        Which value of the parameter y.
    system : System, optional
        Knows the unit of the parameter.

    Returns
    -------
    matplotlib.axes.Axes

    Raises
    ------
    EngdynError
        No such row, or no equilibrium in it.
    """
    _check_map(found)
    if not -len(found.y[1]) <= row < len(found.y[1]):
        raise EngdynError(f"root_locus: there is no row {row}; {found.y[0]} has {len(found.y[1])} values.")
    name, values = found.x
    roots = found.eigenvalues[row]
    there = np.isfinite(roots[:, 0])
    if not there.any():
        raise EngdynError(f"root_locus: there is no equilibrium in row {row}.")
    roots, values = roots[there], values[there]
    ax = new_axes() if ax is None else ax
    with style():
        colors = np.repeat(values, roots.shape[1])
        dots = ax.scatter(roots.real.ravel(), roots.imag.ravel(), 14.0, colors, cmap="viridis", zorder=3)
        for end, marker, text in ((0, "o", "first"), (-1, "s", "last")):
            label = f"{text}: {_quantity(name, values[end], system)}"
            ax.plot(
                roots[end].real,
                roots[end].imag,
                marker,
                markerfacecolor="none",
                color=COLORS["body"],
                label=label,
                zorder=4,
            )
        _half_planes(ax, [*roots.real.ravel(), 0.0])
        ax.get_figure(root=True).colorbar(dots, ax=ax, label=_label(name, system))
        ax.legend(loc="best", frameon=True, framealpha=0.9)
    describe(ax, _locus_in_words(name, values, roots, system))
    return ax


def _half_planes(ax: Axes, real: Any) -> None:
    """Axis of stability, the right half plane tinted, and the names of both axes."""
    low, high = float(np.min(real)), float(np.max(real))
    margin = 0.08 * (high - low) or 1.0
    ax.set_xlim(low - margin, high + margin)
    ax.axvspan(0.0, high + margin, color="#fbeee6", zorder=0)
    ax.axvline(0.0, color=COLORS["body"], linewidth=1.2, zorder=1)
    ax.axhline(0.0, color=COLORS["body"], linewidth=1.2, zorder=1)
    ax.set(xlabel=r"Re $\lambda$ [1/s]", ylabel=r"Im $\lambda$ [1/s]")


def _locus_in_words(name: str, values: np.ndarray, roots: np.ndarray, system: System | None) -> str:
    ends = [_quantity(name, values[end], system) for end in (0, -1)]
    text = f"Eigenvalues in the complex plane as {name} goes from {ends[0]} to {ends[1]}."
    for end, place in zip((0, -1), ends, strict=True):
        text += f" At {place}: {', '.join(_complex(x) for x in roots[end] if x.imag >= 0)} 1/s."
    largest = roots.real.max(axis=1)
    edge = 1e-6 * abs(roots).max()
    for i in np.flatnonzero((largest[1:] > edge) != (largest[:-1] > edge)):
        way = "enters" if largest[i + 1] > edge else "leaves"
        where = _quantity(name, float(values[i] + values[i + 1]) / 2, system)
        text += f" An eigenvalue {way} the right half plane near {name} = {where}."
    return text


def _complex(x: complex) -> str:
    real = number(x.real)
    return real if x.imag == 0 else f"{real} ± {number(abs(x.imag))}i"
