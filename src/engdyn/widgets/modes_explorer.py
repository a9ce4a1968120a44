"""Explorer of modes: a shape on the drawing, and its components, nodes or eigenvalues beside it (chapter 6)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from engdyn.analysis import modes as undamped
from engdyn.analysis.damped_modes import DampedModes, damped_modes
from engdyn.analysis.linear import LinearSystem, linearize
from engdyn.errors import EngdynError
from engdyn.plots.look import COLORS, PALETTE
from engdyn.plots.modal_plots import chosen_modes, mode_name, mode_shapes, phasors
from engdyn.plots.nodal_picture import nodal_points
from engdyn.plots.words import number
from engdyn.system import System
from engdyn.widgets.controls import Choice, Control, Slider
from engdyn.widgets.system_explorer import SystemExplorer, resting, slider

__all__ = ["ModesExplorer", "Shape", "modes", "shape_of"]

BODIES = {
    "rod_on_springs": ("y", "theta", lambda v: (-v["L"] / 2, v["L"] / 2)),
    "half_car": ("z", "theta", lambda v: (-v["b"], v["a"])),
}
"""Systems with one rigid body that has nodes: its translation, its rotation, and where it ends."""

SIDES = (
    ("components of the shape", "components"),
    ("nodes of the body", "nodes"),
    ("eigenvalues and damping ratio", "eigenvalues"),
)


@dataclass(frozen=True)
class Shape:
    """All modes, which one is seen (from 0), and its components in the scale that is asked for."""

    modes: undamped.Modes | DampedModes
    index: int
    components: NDArray


def shape_of(linear: LinearSystem, damping: str, mode: int, scale: str) -> Shape:
    """Return one mode, counted from 1, of a linearized system, without its damping or with it."""
    found = damped_modes(linear) if damping == "damped" else undamped.modes(linear)
    (k,) = chosen_modes(found, mode - 1)
    if isinstance(found, undamped.Modes):
        return Shape(found, k, found.normalized(scale)[:, k])
    column = found.shapes[:, k]
    usual = {"mass": 1.0, "max": column[np.argmax(np.abs(column))], "unit": np.linalg.norm(column)}
    one = usual[scale] if scale in usual else column[found.coordinates.index(scale)]
    if abs(one) < 1e-9 * np.max(np.abs(column)):
        raise EngdynError(f"{scale} is at rest in mode {mode}: choose another scale")
    return Shape(found, k, column / one)


class ModesExplorer(SystemExplorer):
    """See `modes`."""

    title = "Modes"

    def __init__(self, system: str | int | System = "W8", **values: Any) -> None:
        self._linear: tuple[Any, LinearSystem, int] | None = None
        super().__init__(system, **values)

    def controls(self, chosen: Mapping[str, Any]) -> Sequence[Control]:
        choice = self.system_choice("system that vibrates")
        if "system" not in chosen:
            return [choice]
        system = self.system(chosen["system"])
        names = [c.name for c in system.coordinates]
        usual = [("ΦᵀMΦ = 1", "mass"), ("largest = 1", "max"), ("length 1", "unit")]
        scales = (*usual, *((f"{name} = 1", name) for name in names))
        sides = SIDES if system.key in BODIES else (SIDES[0], SIDES[2])
        return [
            choice,
            Choice(
                "damping",
                (("without damping", "undamped"), ("with damping", "damped")),
                "undamped",
                "damping",
            ),
            Choice("scale", tuple(scales), "mass", "rule that fixes the size of the shape"),
            Choice("beside", sides, "components", "what is shown beside the drawing"),
            Slider("mode", 1.0, float(max(2, len(names))), 1.0, "-", "number of the mode", 1.0),
            *map(slider, system.parameters),
        ]

    def model(self, state: Mapping[str, Any]) -> Shape:
        return shape_of(self._linearized(state)[0], state["damping"], round(state["mode"]), state["scale"])

    def _linearized(self, state: Mapping[str, Any]) -> tuple[LinearSystem, int]:
        """Return small motion about the first stable equilibrium, and which one that is; the last is remembered."""
        system, values = self.system(state["system"]), self.parameter_values(state)
        key = (system, *values.items())
        if self._linear is None or self._linear[0] != key:
            found, k = resting(system, values)
            self._linear = key, linearize(system.equations, found[k]), k
        return self._linear[1:]

    def draw_static(self, figure: Figure, state: Mapping[str, Any], result: Shape) -> None:
        left, right = figure.add_axes((0.0, 0.0, 0.52, 0.9)), figure.add_axes((0.63, 0.17, 0.35, 0.70))
        system, found, k = self.system(state["system"]), result.modes, result.index
        mode_shapes(found, left, system=system, mode=k)
        if state["beside"] == "nodes":
            translation, rotation, ends = BODIES[system.key]
            nodal_points(found, translation, rotation, ends(self.parameter_values(state)), right, mode=k)
        elif state["beside"] == "eigenvalues":
            _plane(right, damped_modes(found.linear), k)
        elif isinstance(found, DampedModes):
            phasors(found, k, right)
        else:
            mode_shapes(found, right, mode=k)
            right.set_ylim(-1.1, 1.1)
        right.set_title("", loc="left")  # the drawing has it
        if (legend := right.get_legend()) is not None:
            handles, labels = right.get_legend_handles_labels()
            legend.remove()
            if isinstance(found, DampedModes):
                place = {"loc": "lower center", "bbox_to_anchor": (0.5, 1.0), "ncols": len(handles)}
                right.legend(handles, labels, fontsize=10.0 if len(handles) < 3 else 7.0, **place)

    def caption(self, state: Mapping[str, Any]) -> str:
        return self.system(state["system"]).title

    def words(self, state: Mapping[str, Any], result: Shape) -> str:
        found, k = result.modes, result.index
        system = self.system(state["system"])
        told = [f"{mode_name(found, k)}: {_components(found.coordinates, result.components)}"]
        if isinstance(found, DampedModes):
            told.append(_damping(found, k))
        else:
            shares = zip(found.coordinates, found.energy_share[:, k], strict=True)
            told.append("energy " + ", ".join(f"{q} {100 * share:.0f} %" for q, share in shares))
            if system.key in BODIES:
                translation, rotation, _ = BODIES[system.key]
                place = found.nodes(translation, rotation)[k]
                told.append(
                    f"node at {number(place)} m" if np.isfinite(place) else "no node, it only translates"
                )
        return "; ".join(told) + "."

    def lines(self, state: Mapping[str, Any]) -> list[str]:
        system, k = self.system(state["system"]), round(state["mode"]) - 1
        damped = state["damping"] == "damped"
        beside = f"ed.plots.phasors(modes, {k})" if damped else f"ed.plots.mode_shapes(modes, mode={k})"
        if state["beside"] == "nodes":
            translation, rotation, ends = BODIES[system.key]
            low, high = ends(self.parameter_values(state))
            beside = f'ed.plots.nodal_points(modes, "{translation}", "{rotation}", ({low:.10g}, {high:.10g}), mode={k})'
        shown = f"ed.plots.show({beside})" if state["beside"] != "eigenvalues" else "ed.damped_modes(linear)"
        return [
            *self.loading(state),
            f"linear = ed.linearize(system.equations, system.equilibria(values)[{self._linearized(state)[1]}])",
            f"modes = ed.{'damped_modes' if damped else 'modes'}(linear)",
            f"ed.plots.show(ed.plots.mode_shapes(modes, system=system, mode={k}))",
            shown,
        ]


def _components(names: Sequence[str], column: NDArray) -> str:
    if np.isrealobj(column):
        return ", ".join(f"{q} {number(x)}" for q, x in zip(names, column, strict=True))
    parts = zip(names, np.abs(column), np.degrees(np.angle(column)), strict=True)
    return ", ".join(f"{q} {number(x)} at {number(round(phase, 1))}°" for q, x, phase in parts)


def _damping(found: DampedModes, k: int) -> str:
    """Tell how far damping is from classical, and what the ratio would be without the coupling of modes."""
    if found.classicality is None:
        return "damping that couples modes has no classical part here"
    if found.classicality < 1e-9:
        return "damping is classical: the shapes are those without damping"
    try:
        dropped = found.neglecting_coupling.damping_ratio
    except EngdynError:
        dropped = np.array([])
    told = f"damping is not classical ({number(found.classicality)})"
    return f"{told}; with the coupling dropped ζ would be {number(dropped[k])}" if k < len(dropped) else told


def _plane(ax: Axes, found: DampedModes, k: int) -> None:
    """Draw the eigenvalues, the circle of equal frequency and the ray of equal damping ratio through one of them."""
    roots = found.eigenvalues
    reach = 1.15 * float(np.max(np.abs(roots), initial=1e-3))
    arc = np.exp(1j * np.linspace(0.0, np.pi, 181))
    ax.axvspan(0.0, reach, color="#fbeee6", zorder=0)
    ax.axvline(0.0, color=COLORS["body"], linewidth=1.2)
    ax.plot(roots.real, roots.imag, "o", color=PALETTE[0], zorder=4)
    if k < len(roots):
        circle, ray = abs(roots[k]) * arc, 1.1 * roots[k]
        ax.plot(circle.real, circle.imag, color=COLORS["reference"], linewidth=1.2, linestyle="--")
        ax.plot([0.0, ray.real], [0.0, ray.imag], color=PALETTE[1])
        ax.plot([roots[k].real], [roots[k].imag], "o", color=PALETTE[1], markersize=12.0, zorder=5)
        ax.text(0.03, 0.92, f"ζ = {number(found.damping_ratio[k])}", transform=ax.transAxes)
    ax.set(xlim=(-reach, 0.4 * reach), ylim=(0.0, reach), aspect="equal")
    ax.set(xlabel=r"Re $\lambda$ [1/s]", ylabel=r"Im $\lambda$ [1/s]")


def modes(system: str | int | System = "W8", **values: Any) -> ModesExplorer:
    """Explore the modes of a system: a shape on its drawing, and its components, nodes or eigenvalues beside it.

    Course sections 6.1 to 6.5. Small motion is about the first stable equilibrium. Controls: ``system``,
    ``damping`` ("undamped" or "damped"), ``scale`` (as in `engdyn.Modes.normalized`), ``beside`` ("components",
    "nodes" of a system with one body, "eigenvalues"), ``mode`` (counted from 1) and a slider for every parameter.

    Parameters
    ----------
    system : str, int or System
        A system by number, key or label, or a System of one's own.
    **values : float or str
        Where the other controls stand at first.

    Returns
    -------
    ModesExplorer

    Raises
    ------
    EngdynError
        A value that its slider does not reach; UnknownSystemError for a system that does not exist.
    """
    return ModesExplorer(system, **values)
