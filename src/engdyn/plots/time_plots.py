"""Pictures of motions over time, and of the schemes that compute them (chapter 8)."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.axes import Axes

from engdyn.errors import EngdynError
from engdyn.plots.alternative import describe
from engdyn.plots.look import COLORS, PALETTE, new_axes, new_figure, style
from engdyn.plots.newton_pictures import DASHES
from engdyn.plots.words import number, symbol, with_unit

if TYPE_CHECKING:
    from engdyn.analysis.convergence import Convergence
    from engdyn.analysis.time_history import TimeHistory
    from engdyn.system import System

__all__ = ["error_over_step", "phase_portrait", "step_construction", "time_history", "work_precision"]

MARKERS = "os^Dv*P"
PER_TIME = ("", "/s", "/s²")


def time_history(
    history: TimeHistory | Mapping[str, TimeHistory],
    names: str | Sequence[str] | None = None,
    ax: Axes | None = None,
    *,
    system: System | None = None,
) -> Axes:
    """Plot a motion over time: one panel for each unit, events as vertical lines.

    Course section 8.2, Fig. 8.2.

    Parameters
    ----------
    history : TimeHistory, or mapping of label to TimeHistory
        One motion, or several to be compared.
    names : str or sequence of str, optional
        Coordinates, rates (``"theta'"``) and inputs; default: all coordinates.
    ax : matplotlib.axes.Axes, optional
        Where to draw what has one unit; default: new axes.
    system : System, optional
        Knows symbols and units.

    Returns
    -------
    matplotlib.axes.Axes
        The uppermost; its words tell all panels.

    Raises
    ------
    EngdynError
        Unknown names, several units for one pair of axes.
    """
    runs = history if isinstance(history, Mapping) else {"": history}
    first = next(iter(runs.values()))
    names = list(first.names) if names is None else [names] if isinstance(names, str) else list(names)
    panels: dict[str, list[str]] = {}
    for name in names:
        panels.setdefault(_unit(system, name), []).append(name)
    if ax is not None and len(panels) > 1:
        raise EngdynError(
            f"time_history: {', '.join(names)} have different units; give no axes, or fewer names"
        )
    words = []
    with style():
        axes = [ax]
        if ax is None:
            figure = new_figure(7.0, 1.4 + 2.6 * len(panels))
            axes = figure.subplots(len(panels), sharex=True, squeeze=False)[:, 0]
        for panel, (unit, group) in zip(axes, panels.items(), strict=True):
            words += _draw_panel(panel, unit, group, runs, system)
        axes[-1].set_xlabel(with_unit("$t$", "s"))
    title = f"{system.title}, motion" if system else "Motion"
    happened = [f" {e!r}." for run in runs.values() for e in run.events]
    describe(axes[0], f"{title} over time. {' '.join(words)}{''.join(happened)}")
    return axes[0]


def _draw_panel(
    panel: Axes, unit: str, names: Sequence[str], runs: Mapping[str, TimeHistory], system: System | None
) -> list[str]:
    """Draw what has one unit, and say it in words."""
    words, lines = [], [(label, name, run) for name in names for label, run in runs.items()]
    for i, (label, name, run) in enumerate(lines):
        legend = ", ".join(part for part in (_symbol(system, name), label) if part)
        panel.plot(run.time, run[name], DASHES[i % 4], color=PALETTE[i % 7], label=legend)
        words.append(_in_words(label, name, unit, run))
    for event in [e for run in runs.values() for e in run.events]:
        for t in event.time[:50]:
            panel.axvline(t, color=COLORS["reference"], linewidth=0.9, linestyle=":")
    shown = ", ".join(_symbol(system, name) for name in names)
    panel.set_ylabel(with_unit(shown, unit) if unit else shown)
    if len(lines) > 1:
        panel.legend(loc="best", frameon=True)
    return words


def _split(name: str) -> tuple[str, int]:
    base = name.rstrip("'")
    return base, len(name) - len(base)


def _known(system: System | None, base: str) -> Any:
    known = {} if system is None else {item.name: item for item in (*system.coordinates, *system.inputs)}
    return known.get(base)


def _unit(system: System | None, name: str) -> str:
    base, order = _split(name)
    item = _known(system, base)
    return "" if item is None else item.unit + PER_TIME[min(order, 2)]


def _symbol(system: System | None, name: str) -> str:
    base, order = _split(name)
    item = _known(system, base)
    if item is None:
        return name
    dots = ("", r"\dot ", r"\ddot ")[min(order, 2)]
    return f"${dots}{{{symbol(item)[1:-1]}}}$" if order else symbol(item)


def _in_words(label: str, name: str, unit: str, run: TimeHistory) -> str:
    values = run[name]
    span = f"from {number(values[0])} to {number(values[-1])} {unit}".strip()
    between = f"between {number(values.min())} and {number(values.max())}"
    last = number(run.time[-1])
    return f"{f'{label}: ' if label else ''}{name} goes {span} within {last} s, {between}."


def phase_portrait(
    history: TimeHistory | Mapping[str, TimeHistory],
    coordinate: str | None = None,
    ax: Axes | None = None,
    *,
    system: System | None = None,
) -> Axes:
    """Plot the rate of a coordinate over the coordinate; a dot marks the start.

    Course section 8.2.

    Parameters
    ----------
    history : TimeHistory, or mapping of label to TimeHistory
    coordinate : str, optional
        Default: the first one.
    ax : matplotlib.axes.Axes, optional
        Where to draw; default: new axes.
    system : System, optional
        Knows symbols and units.

    Returns
    -------
    matplotlib.axes.Axes

    Raises
    ------
    EngdynError
        Unknown coordinate.
    """
    runs = history if isinstance(history, Mapping) else {"": history}
    coordinate = next(iter(runs.values())).names[0] if coordinate is None else coordinate
    rate = f"{coordinate}'"
    ax = new_axes() if ax is None else ax
    words = []
    with style():
        for i, (label, run) in enumerate(runs.items()):
            x, y, color = run[coordinate], run[rate], PALETTE[i % 7]
            ax.plot(x, y, DASHES[i % 4], color=color, label=label)
            ax.plot(x[:1], y[:1], MARKERS[i % 7], color=color)
            ends = [f"({number(x[k])}, {number(y[k])})" for k in (0, -1)]
            words.append(f"{f'{label}: ' if label else ''}from {ends[0]} to {ends[1]}.")
        for set_label, name in ((ax.set_xlabel, coordinate), (ax.set_ylabel, rate)):
            unit = _unit(system, name)
            set_label(with_unit(_symbol(system, name), unit) if unit else name)
        if any(runs):
            ax.legend(loc="best", frameon=True)
    describe(ax, f"Phase portrait, {rate} over {coordinate}. {' '.join(words)}")
    return ax


def error_over_step(convergences: Sequence[Convergence], ax: Axes | None = None) -> Axes:
    """Plot errors over the step on logarithmic scales: the slope is the order of the scheme.

    Course sections 8.5, 8.6 and 8.8, Fig. 8.4.

    Parameters
    ----------
    convergences : sequence of Convergence
        What ``engdyn.measure_order`` returned.
    ax : matplotlib.axes.Axes, optional
        Where to draw; default: new axes.

    Returns
    -------
    matplotlib.axes.Axes
    """
    lines = {f"{c.scheme} (slope {c.order:.2f})": (c.step, c.error) for c in convergences}
    return _logarithmic(lines, with_unit("step $h$", "s"), "Error over step", ax)


def work_precision(
    lines: Sequence[Convergence] | Mapping[str, tuple[Any, Any]], ax: Axes | None = None
) -> Axes:
    """Plot errors over the evaluations of the right-hand side: what accuracy costs.

    Course section 8.8.

    Parameters
    ----------
    lines : sequence of Convergence, or mapping of label to (evaluations, errors)
    ax : matplotlib.axes.Axes, optional
        Where to draw; default: new axes.

    Returns
    -------
    matplotlib.axes.Axes
    """
    if not isinstance(lines, Mapping):
        lines = {c.scheme: (c.evaluations, c.error) for c in lines}
    return _logarithmic(lines, "evaluations of the right-hand side", "Error over work", ax)


def _logarithmic(lines: Mapping[str, tuple[Any, Any]], across: str, what: str, ax: Axes | None) -> Axes:
    if not lines:
        raise EngdynError("there is nothing to plot: give one measurement or more")
    ax = new_axes() if ax is None else ax
    words = []
    with style():
        for i, (label, (x, error)) in enumerate(lines.items()):
            ax.loglog(x, error, f"{MARKERS[i % 7]}{DASHES[i % 4]}", color=PALETTE[i % 7], label=label)
            words.append(f"{label}: {error[0]:.1e} at {number(x[0])}, {error[-1]:.1e} at {number(x[-1])}.")
        ax.set_xlabel(across)
        ax.set_ylabel("error at the end")
        ax.legend(loc="best", frameon=True)
    describe(ax, f"{what}, logarithmic scales. {' '.join(words)}")
    return ax


def step_construction(
    f: Callable[[float, np.ndarray], np.ndarray],
    x0: Any,
    h: float,
    scheme: str = "euler",
    ax: Axes | None = None,
    *,
    steps: int = 1,
    entry: int = 0,
    label: str = "$x$",
) -> Axes:
    """Draw how a scheme makes its steps: along the tangent (Euler), or with the slope in the middle (midpoint).

    Course sections 8.4 and 8.8, Figs. 8.3 and 8.5.

    Parameters
    ----------
    f, x0
        As for ``engdyn.integrate``, from t = 0.
    h : float
        Step, large enough to be seen [s].
    scheme : {"euler", "midpoint"}
    ax : matplotlib.axes.Axes, optional
        Where to draw; default: new axes.
    steps : int
    entry : int
        Which entry of x is drawn.
    label : str
        Its symbol, with unit.

    Returns
    -------
    matplotlib.axes.Axes

    Raises
    ------
    EngdynError
        Another scheme.
    """
    if scheme not in ("euler", "midpoint"):
        raise EngdynError(f"step_construction draws 'euler' and 'midpoint', not {scheme!r}")
    from engdyn.analysis.integrators import integrate

    run = integrate(f, x0, np.arange(steps + 1) * h, scheme)
    exact = integrate(f, x0, np.linspace(0.0, steps * h, 201), "rk4")
    ax = new_axes() if ax is None else ax
    with style():
        ax.plot(exact.time, exact.x[:, entry], color=PALETTE[0], label="exact")
        for t, x in zip(run.time[:-1], run.x[:-1], strict=True):
            _draw_step(ax, f, t, x, h, scheme, entry)
        ax.plot(run.time, run.x[:, entry], "o", color=COLORS["body"], label=scheme)
        ax.set_xticks(run.time, [f"${i}h$" if i > 1 else ("0", "$h$")[i] for i in range(steps + 1)])
        ax.set_xlabel("$t$")
        ax.set_ylabel(label)
        ax.legend(loc="best", frameon=True)
    how = (
        "along the tangent"
        if scheme == "euler"
        else "with the slope in the middle, found by half a step of Euler"
    )
    off = number(abs(run.x[-1, entry] - exact.x[-1, entry]))
    describe(
        ax, f"{steps} step{'s' * (steps > 1)} of {scheme}, each {how}; at the end {off} off the exact curve."
    )
    return ax


def _draw_step(
    ax: Axes, f: Callable[..., Any], t: float, x: np.ndarray, h: float, scheme: str, entry: int
) -> None:
    slope = np.asarray(f(t, x))
    reach = h if scheme == "euler" else h / 2
    ax.plot([t, t + reach], [x[entry], (x + reach * slope)[entry]], "--", color=PALETTE[1])
    if scheme == "midpoint":
        half, middle = t + h / 2, x + h / 2 * slope
        lean = float(np.asarray(f(half, middle))[entry])
        ends = [middle[entry] - lean * h / 4, middle[entry] + lean * h / 4]
        ax.plot([half - h / 4, half + h / 4], ends, color=PALETTE[2], linewidth=3.0)
        ax.plot([half], [middle[entry]], "s", color=PALETTE[2])
        ax.plot([t, t + h], [x[entry], x[entry] + lean * h], color=PALETTE[2])
