"""Explorer of stability: a map over two parameters, and the response at the place that a probe marks (section 5.5)."""

from __future__ import annotations

import math
from collections.abc import Hashable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from matplotlib.artist import Artist
from matplotlib.figure import Figure
from numpy.typing import NDArray
from scipy.linalg import expm

from engdyn.analysis.linear import linearize
from engdyn.analysis.stability_map import NO_EQUILIBRIUM, StabilityMap
from engdyn.analysis.stability_map import stability_map as judged
from engdyn.errors import EngdynError
from engdyn.plots import stability_plots
from engdyn.plots.look import COLORS, PALETTE
from engdyn.plots.words import number, plain_symbol, plain_verdict, quantity
from engdyn.system import System
from engdyn.widgets.controls import Choice, Control
from engdyn.widgets.system_explorer import SystemExplorer, interesting, resting, slider

__all__ = ["Probe", "StabilityExplorer", "probe", "stability_map"]

PLANES = {
    "S11": ("P", "c_1"),
    "S12": ("U", "d"),
    "S13": ("v", "c_p"),
    "S14": ("Omega", "c_i"),
    "S15": ("Omega", "k_a"),
    "S18": ("v", "e"),
}
"""Parameters that show most; of other systems the first two that are interesting."""

SPANS = {("S13", "v"): (1.0, 80.0), ("S13", "c_p"): (0.0, 60.0)}
"""Ranges of parameters whose default lies far from where the verdict changes [SI]."""

GRID, SAMPLES, WINDOW, MAPS = 51, 401, 3.0, 8
"""Points of the map each way, of the response; height of its picture in first deviations; so many maps are kept."""


@dataclass(frozen=True)
class Probe:
    """The map, and at one place of it the verdict, eigenvalues [1/s] and response x/x₀ over time [s]."""

    chart: StabilityMap
    verdict: str
    eigenvalues: NDArray[np.complex128]
    time: NDArray[np.float64]
    deviation: NDArray[np.float64]


def probe(system: System, values: Mapping[str, float], chart: StabilityMap, coordinate: str) -> Probe:
    """Judge one place of a map, and let the system go there from a small displacement of one coordinate."""
    here = [(name, [values[name]]) for name, _ in (chart.x, chart.y)]
    spot = judged(system.equations, values, *here, at=chart.at)
    verdict, found, state = str(spot.verdict[0, 0]), spot.eigenvalues[0, 0], spot.states[0, 0]
    time = np.linspace(0.0, _until(chart), SAMPLES)
    if verdict == NO_EQUILIBRIUM:
        return Probe(chart, verdict, found, time, np.full(SAMPLES, np.nan))
    n, names = len(system.coordinates), [c.name for c in system.coordinates]
    at = replace(chart.at, q=state[:n], speeds=state[n:], values=dict(values))
    step = expm(linearize(system.equations, at).state_matrix * time[1])
    motion = np.zeros((SAMPLES, len(state)))
    motion[0, names.index(coordinate)] = 1.0
    for i in range(1, SAMPLES):
        motion[i] = step @ motion[i - 1]
    return Probe(chart, verdict, found, time, motion[:, names.index(coordinate)])


def _until(chart: StabilityMap) -> float:
    """Return the end of the response, the same all over a map: 1, 2 or 5 times a power of ten, some slow swings."""
    sizes = np.abs(chart.eigenvalues[np.isfinite(chart.eigenvalues)])
    slow = float(np.median(sizes[sizes > 1e-6 * sizes.max(initial=0.0)])) if sizes.any() else 1.0
    power = 10.0 ** math.floor(math.log10(40.0 / slow))
    return next(power * k for k in (1.0, 2.0, 5.0, 10.0) if power * k >= 40.0 / slow)


class StabilityExplorer(SystemExplorer):
    """See `stability_map`."""

    title = "Stability map"

    def __init__(self, system: str | int | System = "S13", **values: Any) -> None:
        self._charts: dict[tuple, tuple[StabilityMap, int | None]] = {}
        super().__init__(system, **values)

    def controls(self, chosen: Mapping[str, Any]) -> Sequence[Control]:
        choice = self.system_choice("system whose stability is judged")
        if "system" not in chosen:
            return [choice]
        name, system = chosen["system"], self.system(chosen["system"])
        parameters = tuple((f"{p.name} ({p.meaning})", p.name) for p in system.parameters)
        seen = tuple((f"{c.name} ({c.meaning})", c.name) for c in system.coordinates if c.kind != "ignorable")
        across, up = PLANES.get(name, interesting(system)[:2])
        sliders = sorted(map(slider, system.parameters), key=lambda c: c.name not in (across, up))
        spans = [SPANS.get((name, c.name), (c.low, c.high)) for c in sliders]
        return [
            choice,
            Choice("across", parameters, across, "parameter to the right"),
            Choice("up", parameters, up, "parameter upward"),
            Choice("coordinate", seen, seen[0][1], "coordinate that is displaced and seen"),
            *(replace(c, low=low, high=high) for c, (low, high) in zip(sliders, spans, strict=True)),
        ]

    def model(self, state: Mapping[str, Any]) -> Probe:
        system = self.system(state["system"])
        return probe(system, self.parameter_values(state), self._chart(state)[0], state["coordinate"])

    def _axes(self, state: Mapping[str, Any]) -> list[tuple[str, NDArray[np.float64]]]:
        controls = [self._controls[state[way]] for way in ("across", "up")]
        return [(c.name, np.linspace(c.low, c.high, GRID)) for c in controls]

    def _others(self, state: Mapping[str, Any]) -> dict[str, Any]:
        """Return the state without the place of the probe, on which the map does not depend."""
        return {name: x for name, x in state.items() if name not in (state["across"], state["up"])}

    def _chart(self, state: Mapping[str, Any]) -> tuple[StabilityMap, int | None]:
        """Return the map and which equilibrium it follows, None for zero; the last few are remembered."""
        system, others = self.system(state["system"]), self._others(state)
        key = (system, *(others | {"coordinate": ""}).items())
        if key not in self._charts:
            values, axes = self.parameter_values(others), self._axes(state)
            if state["across"] == state["up"]:
                raise EngdynError(f"both axes would show {state['up']}; choose two parameters")
            try:
                self._charts[key] = judged(system.equations, values, *axes), None
            except (
                EngdynError
            ):  # zero is no equilibrium, and others are looked for within the bounds of the system
                found, k = resting(system, values)
                self._charts[key] = judged(system.equations, values, *axes, at=found[k]), k
            for old in list(self._charts)[:-MAPS]:
                del self._charts[old]
        return self._charts[key]

    def static_key(self, state: Mapping[str, Any], result: Probe) -> Hashable:
        return self.system(state["system"]), *self._others(state).items()

    def draw_static(self, figure: Figure, state: Mapping[str, Any], result: Probe) -> None:
        system = self.system(state["system"])
        chart, right = figure.add_axes((0.09, 0.16, 0.40, 0.66)), figure.add_axes((0.60, 0.16, 0.37, 0.66))
        stability_plots.stability_map(result.chart, chart, system=system)
        symbol = plain_symbol(next(c for c in system.coordinates if c.name == state["coordinate"]))
        right.set(xlim=(0.0, result.time[-1]), ylim=(-WINDOW, WINDOW), xlabel="time [s]")
        right.set_ylabel(f"{symbol} / first {symbol} [1]")
        right.axhline(0.0, color=COLORS["reference"], linewidth=1.0)

    def draw_moving(self, figure: Figure, state: Mapping[str, Any], result: Probe) -> Iterable[Artist]:
        chart, right = figure.axes
        x, y = state[state["across"]], state[state["up"]]
        dots = {"color": COLORS["body"], "linewidth": 1.0, "linestyle": ":", "animated": True}
        ring = {
            "markersize": 13.0,
            "markerfacecolor": "white",
            "markeredgecolor": COLORS["body"],
            "clip_on": False,
        }
        lines = [chart.axvline(x, **dots), chart.axhline(y, **dots)]
        lines += chart.plot([x], [y], "o", markeredgewidth=2.5, animated=True, **ring)
        if result.verdict == NO_EQUILIBRIUM:
            text = right.text(
                0.5, 0.6, "no equilibrium here", ha="center", transform=right.transAxes, animated=True
            )
            return [*lines, text]
        color = PALETTE[1] if result.verdict.startswith("unstable") else PALETTE[0]
        return [*lines, *right.plot(result.time, result.deviation, color=color, animated=True)]

    def caption(self, state: Mapping[str, Any]) -> str:
        system = self.system(state["system"])
        units = {p.name: p.unit for p in system.parameters}
        here = (quantity(n, state[n], units[n]) for n in dict.fromkeys((state["across"], state["up"])))
        return f"{system.title}, {', '.join(here)}"

    def words(self, state: Mapping[str, Any], result: Probe) -> str:
        if result.verdict == NO_EQUILIBRIUM:
            return "the equilibrium that is followed has ceased to exist here."
        worst = result.eigenvalues[0]
        told = ", ".join(
            f"{plain_verdict(v)} {100 * share:.0f} %" for v, share in result.chart.shares.items()
        )
        imaginary = f" ± {number(abs(worst.imag))}i" if worst.imag else ""
        rightmost = f"rightmost eigenvalue {number(worst.real)}{imaginary} 1/s"
        return f"{plain_verdict(result.verdict)}, {rightmost}. The map: {told}."

    def lines(self, state: Mapping[str, Any]) -> list[str]:
        axes = ", ".join(
            f'("{n}", np.linspace({v[0]:.10g}, {v[-1]:.10g}, {GRID}))' for n, v in self._axes(state)
        )
        index = self._chart(state)[1]
        at = "" if index is None else f", at=system.equilibria(values)[{index}]"
        here = ", ".join(f'("{name}", [{state[name]:.10g}])' for name, _ in self._axes(state))
        return [
            "import numpy as np",
            *self.loading(self._others(state)),
            f"chart = ed.stability_map(system.equations, values, {axes}{at})",
            "ed.plots.show(ed.plots.stability_map(chart, system=system))",
            f"here = ed.stability_map(system.equations, values, {here}, at=chart.at)",
            "here.verdict, here.eigenvalues",
        ]


def stability_map(system: str | int | System = "S13", **values: Any) -> StabilityExplorer:
    """Explore where a motion is stable: a map over two parameters, and the response at the place of a probe.

    Course section 5.5. Controls: ``system``, ``across`` and ``up`` (the parameters of the map), ``coordinate``
    (what is displaced, by a little, and seen) and a slider for every parameter; those of ``across`` and ``up``
    move the probe.

    Parameters
    ----------
    system : str, int or System
        A system by number, key or label, or a System of one's own.
    **values : float or str
        Where the other controls stand at first.

    Returns
    -------
    StabilityExplorer

    Raises
    ------
    EngdynError
        A value that its slider does not reach; UnknownSystemError for a system that does not exist.
    """
    return StabilityExplorer(system, **values)
