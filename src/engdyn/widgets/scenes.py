"""Explorers made of scenes: pictures of one family, chosen from a list, each with controls of its own."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import ArrayLike

from engdyn.plots.look import COLORS, PALETTE
from engdyn.widgets.controls import Choice, Control
from engdyn.widgets.explorer import Explorer

__all__ = ["Scene", "SceneExplorer", "bars", "beside", "size_of", "whole"]


@dataclass(frozen=True)
class Scene:
    """One picture of a family.

    Parameters
    ----------
    label : str
        What the list of scenes shows.
    controls : tuple of Slider or Choice
        What can be set.
    model : callable
        State → numbers; knows nothing of pictures.
    draw : callable
        Figure, state, numbers → draws into the empty figure.
    words : callable
        State, numbers → a sentence or two.
    lines : callable
        State → the same as lines of code, after ``import engdyn as ed``; the last one gives the picture.
    """

    label: str
    controls: tuple[Control, ...]
    model: Callable[[Mapping[str, Any]], Any]
    draw: Callable[[Figure, Mapping[str, Any], Any], Any]
    words: Callable[[Mapping[str, Any], Any], str]
    lines: Callable[[Mapping[str, Any]], Sequence[str]]


class SceneExplorer(Explorer):
    """An explorer whose first choice is the scene.

    Attributes
    ----------
    scenes : mapping of str to Scene
        By the names that ``set(scene=…)`` takes; the first one is shown at first.
    """

    structural = ("scene",)
    scenes: ClassVar[Mapping[str, Scene]] = {}

    def controls(self, chosen: Mapping[str, Any]) -> Sequence[Control]:
        options = tuple((scene.label, name) for name, scene in self.scenes.items())
        choice = Choice("scene", options, options[0][1], "what is shown")
        return [choice, *(self.scenes[chosen["scene"]].controls if "scene" in chosen else ())]

    def model(self, state: Mapping[str, Any]) -> Any:
        return self.scenes[state["scene"]].model(state)

    def draw_static(self, figure: Figure, state: Mapping[str, Any], result: Any) -> None:
        self.scenes[state["scene"]].draw(figure, state, result)

    def caption(self, state: Mapping[str, Any]) -> str:
        return self.scenes[state["scene"]].label

    def words(self, state: Mapping[str, Any], result: Any) -> str:
        return self.scenes[state["scene"]].words(state, result)

    def lines(self, state: Mapping[str, Any]) -> Sequence[str]:
        *before, picture = self.scenes[state["scene"]].lines(state)
        return [*before, f"ed.plots.show({picture})"]


def size_of(vector: ArrayLike) -> float:
    """Return the magnitude of a vector."""
    return float(np.linalg.norm(vector))


def whole(figure: Figure) -> Axes:
    """Return axes that fill the figure, for a drawing."""
    return figure.add_axes((0.0, 0.0, 1.0, 1.0))


def beside(figure: Figure, share: float = 0.55) -> tuple[Axes, Axes]:
    """Return axes for a drawing on the left, which takes a share of the width, and for a chart on the right."""
    left = figure.add_axes((0.0, 0.0, share, 1.0))
    return left, figure.add_axes((share + 0.11, 0.17, 0.97 - share - 0.11, 0.76))


def bars(ax: Axes, heights: Mapping[str, float], ylabel: str, pale: Sequence[str] = ()) -> None:
    """Draw one bar for each label; the axis ends at 1, 2 or 5 times a power of ten, so that it seldom jumps.

    Parameters
    ----------
    ax : matplotlib.axes.Axes
    heights : mapping of str to float
    ylabel : str
        With the unit.
    pale : sequence of str
        Labels of bars that do not count.
    """
    places = np.arange(len(heights))
    colors = [COLORS["reference"] if label in pale else PALETTE[0] for label in heights]
    drawn = ax.bar(places, list(heights.values()), 0.6, color=colors, edgecolor=COLORS["body"])
    for label, bar in zip(heights, drawn, strict=True):
        bar.set_alpha(0.3 if label in pale else 1.0)
    ax.set_xticks(places, list(heights))
    ax.set_xlim(-0.6, max(len(heights), 2) - 0.4)
    ax.axhline(0.0, color=COLORS["body"], linewidth=1.0)
    ax.tick_params(axis="x", labelsize=14)
    ax.grid(False, axis="x")
    top = max((abs(h) for h in heights.values()), default=0.0) or 1.0
    scale = 10.0 ** math.floor(math.log10(top))
    limit = next(scale * k for k in (1.0, 2.0, 5.0, 10.0) if scale * k >= 0.999 * top)
    ax.set_ylim(-limit if min(heights.values(), default=0.0) < 0.0 else 0.0, 1.05 * limit)
    ax.set_ylabel(ylabel)
