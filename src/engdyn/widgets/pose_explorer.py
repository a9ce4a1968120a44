"""Explorer of poses: every coordinate is a slider, and the drawing follows (appendix A)."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

from engdyn.plots.drawing import Layer, draw_layers, shown_pose
from engdyn.plots.projection import View
from engdyn.plots.stage import size_of
from engdyn.plots.words import pose as pose_in_words
from engdyn.quantities import Coordinate
from engdyn.system import System
from engdyn.widgets.controls import Control, Slider
from engdyn.widgets.system_explorer import SystemExplorer

__all__ = ["PoseExplorer", "coordinate_slider", "pose"]

STEPS = 200
"""About so many steps has the slider of a coordinate."""


class PoseExplorer(SystemExplorer):
    """See `pose`."""

    title = "Pose"
    size = (8.0, 5.4)

    def controls(self, chosen: Mapping[str, Any]) -> Sequence[Control]:
        choice = self.system_choice("system that is drawn")
        if "system" not in chosen:
            return [choice]
        system = self.system(chosen["system"])
        start = shown_pose(system)
        size = size_of(system.shapes(start), View())
        sliders = map(coordinate_slider, system.coordinates, start.tolist(), [size] * len(start))
        return [choice, *sliders]

    def model(self, state: Mapping[str, Any]) -> NDArray[np.float64]:
        return np.array([state[c.name] for c in self.system(state["system"]).coordinates])

    def draw_static(self, figure: Figure, state: Mapping[str, Any], result: NDArray[np.float64]) -> None:
        system = self.system(state["system"])
        # The pose of the beginning stays behind, pale: it shows what has moved, and which way.
        start = [self._controls[c.name].value for c in system.coordinates]
        behind = [] if np.array_equal(start, result) else [Layer(system.shapes(start), faint=True)]
        draw_layers(figure.add_axes((0.0, 0.0, 1.0, 1.0)), [*behind, Layer(system.shapes(result))])

    def lines(self, state: Mapping[str, Any]) -> list[str]:
        pose = ", ".join(f"{x:.10g}" for x in self.model(state))
        return [self.loading(state)[0], f"ed.plots.show(ed.plots.draw(system, q=[{pose}]))"]

    def caption(self, state: Mapping[str, Any]) -> str:
        return self.system(state["system"]).title

    def words(self, state: Mapping[str, Any], result: NDArray[np.float64]) -> str:
        return f"{pose_in_words(self.system(state['system']).coordinates, result)}."


def coordinate_slider(coordinate: Coordinate, start: float, size: float) -> Slider:
    """Return the slider of a coordinate: its bounds, or one turn of an angle, or the width of the drawing.

    Parameters
    ----------
    coordinate : Coordinate
    start : float
        Where it stands at first [m, rad]; moved to the nearest step.
    size : float
        Size of the drawing [m], for a length without bounds.
    """
    reach = math.pi if coordinate.unit == "rad" else max(0.5 * size, abs(start))
    low, high = coordinate.bounds or (-reach, reach)
    scale = 10.0 ** math.floor(math.log10((high - low) / STEPS))
    step = next(scale * k for k in (1.0, 2.0, 5.0, 10.0) if scale * k >= 0.999 * (high - low) / STEPS)
    ends = (
        step * math.floor(low / step + 1e-9),
        step * math.ceil(high / step - 1e-9),
        step * round(start / step),
    )
    low, high, value = (float(f"{x:.12g}") for x in ends)
    return Slider(coordinate.name, low, high, value, coordinate.unit, coordinate.meaning, step)


def pose(system: str | int | System = "S07", **values: float) -> PoseExplorer:
    """Explore the poses of a system: its drawing, with a slider for every coordinate.

    Course appendix A. Controls: ``system`` and the coordinates by name.

    Parameters
    ----------
    system : str, int or System
        A system by number, key or label, or a System of one's own.
    **values : float
        Coordinates [m, rad] to start from; the pose of the drawing where not given.

    Returns
    -------
    PoseExplorer

    Raises
    ------
    EngdynError
        A value that its slider does not reach, or a system without a drawing; UnknownSystemError for a system
        that does not exist.
    """
    return PoseExplorer(system, **values)
