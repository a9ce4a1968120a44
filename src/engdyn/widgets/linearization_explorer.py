"""Explorer of linearization: a function, its tangent, and what the tangent drops (section 5.2)."""

from __future__ import annotations

import math
from collections.abc import Callable, Hashable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib.artist import Artist
from matplotlib.figure import Figure

from engdyn.errors import EngdynError
from engdyn.plots.look import COLORS, PALETTE
from engdyn.plots.words import number
from engdyn.widgets.controls import Choice, Control, Slider
from engdyn.widgets.explorer import Explorer

__all__ = ["LinearizationExplorer", "Tangent", "linearization", "tangent_of"]


@dataclass(frozen=True)
class Function:
    """A function of one variable: its name, itself as code for sympy, value, slope, range of the variable and start."""

    label: str
    code: str
    value: Callable[[Any], Any]
    slope: Callable[[float], float]
    low: float
    high: float
    start: float


FUNCTIONS = {
    "sine": Function("sin x", "sm.sin(x)", np.sin, math.cos, -3.0, 3.0, 0.6),
    "cosine": Function("cos x", "sm.cos(x)", np.cos, lambda x: -math.sin(x), -3.0, 3.0, 0.0),
    "spring": Function(
        "force of a spring across, x − 1.2 x/√(1 + x²)",
        "x - sm.Rational(6, 5) * x / sm.sqrt(1 + x**2)",
        lambda x: x - 1.2 * x / np.sqrt(1 + x**2),
        lambda x: 1 - 1.2 / (1 + x**2) ** 1.5,
        -2.0,
        2.0,
        1.0,
    ),
    "root": Function(
        "outflow of a tank, √x", "sm.sqrt(x)", np.sqrt, lambda x: 0.5 / math.sqrt(x), 0.0, 4.0, 1.0
    ),
}
SMALLEST, LARGEST, FLOOR = 0.02, 2.0, 1e-7
"""Least and largest deviation; and the smallest error that the diagram shows."""


@dataclass(frozen=True)
class Tangent:
    """Value and slope at the point; error of the tangent at the deviation and at half of it."""

    value: float
    slope: float
    error: float
    half_error: float

    @property
    def ratio(self) -> float:
        """By what the error shrinks when the deviation is halved."""
        return self.error / self.half_error if self.half_error else math.nan


def tangent_of(function: Function, at: float, deviation: float) -> Tangent:
    """Expand a function at a point and compare the tangent with it at a deviation from there."""
    try:
        value, slope = float(function.value(at)), float(function.slope(at))
    except ZeroDivisionError:
        raise EngdynError(
            f"{function.label} has no finite slope at x = {at:g}, so no tangent replaces it there"
        ) from None
    errors = (float(value + slope * d - function.value(at + d)) for d in (deviation, deviation / 2))
    return Tangent(value, slope, *errors)


class LinearizationExplorer(Explorer):
    """See `linearization`."""

    title = "Linearization"
    structural = ("function",)

    def controls(self, chosen: Mapping[str, Any]) -> Sequence[Control]:
        options = tuple((f.label, name) for name, f in FUNCTIONS.items())
        choice = Choice("function", options, "sine", "function that the tangent replaces")
        if "function" not in chosen:
            return [choice]
        f = FUNCTIONS[chosen["function"]]
        return [
            choice,
            Slider("at", f.low, f.high, f.start, "-", "point of expansion", 0.05),
            Slider("deviation", SMALLEST, LARGEST, 0.5, "-", "deviation from the point of expansion", 0.02),
        ]

    def model(self, state: Mapping[str, Any]) -> Tangent:
        return tangent_of(FUNCTIONS[state["function"]], state["at"], state["deviation"])

    def static_key(self, state: Mapping[str, Any], result: Tangent) -> Hashable:
        return state["function"]

    def draw_static(self, figure: Figure, state: Mapping[str, Any], result: Tangent) -> None:
        f = FUNCTIONS[state["function"]]
        left, right = figure.add_axes((0.09, 0.16, 0.39, 0.76)), figure.add_axes((0.61, 0.16, 0.36, 0.76))
        x = np.linspace(f.low if f.low == 0 else f.low - LARGEST, f.high + LARGEST, 401)
        left.plot(x, f.value(x), color=PALETTE[0])
        left.set(xlim=(f.low - LARGEST, f.high + LARGEST), xlabel="x [1]", ylabel="value [1]")
        left.set_ylim(*(np.array([-1.0, 1.0]) * 1.6 * np.max(np.abs(f.value(x)))))
        left.set_title(f.label, loc="left")
        right.set(xscale="log", yscale="log", xlim=(SMALLEST, LARGEST), ylim=(FLOOR, 10.0))
        right.set(xlabel="deviation [1]", ylabel="error of the tangent [1]")

    def draw_moving(self, figure: Figure, state: Mapping[str, Any], result: Tangent) -> Iterable[Artist]:
        (left, right), f = figure.axes, FUNCTIONS[state["function"]]
        at, d, end = state["at"], state["deviation"], np.array(left.get_xlim())
        far = result.value + result.slope * d
        sizes = np.geomspace(SMALLEST, LARGEST, 101)
        errors = np.abs(result.value + result.slope * sizes - f.value(at + sizes))
        tangent = {"color": PALETTE[1], "linestyle": "--", "animated": True}
        mark = {"color": COLORS["body"], "marker": "o", "linestyle": "", "animated": True, "clip_on": False}
        gap = {"color": COLORS["body"], "linewidth": 4.0, "animated": True}
        return [
            left.axvspan(at, at + d, color="#e69f00", alpha=0.25, animated=True, linewidth=0.0),
            *left.plot(end, result.value + result.slope * (end - at), **tangent),
            *left.plot([at + d, at + d], [far - result.error, far], **gap),
            *left.plot([at], [result.value], **mark),
            *right.plot(sizes, np.maximum(errors, FLOOR / 10), color=PALETTE[0], animated=True),
            *right.plot([d], [max(abs(result.error), FLOOR)], **mark),
        ]

    def caption(self, state: Mapping[str, Any]) -> str:
        return FUNCTIONS[state["function"]].label

    def words(self, state: Mapping[str, Any], result: Tangent) -> str:
        told = (
            f"value {number(result.value)} and slope {number(result.slope)} at x = {number(state['at'])}; "
            f"{number(state['deviation'])} further the tangent is off by {number(result.error)}"
        )
        if abs(result.half_error) > 1e-12:
            told += (
                f", at half the deviation by {number(result.half_error)}, {number(result.ratio)} times less"
            )
        return f"{told}."

    def lines(self, state: Mapping[str, Any]) -> list[str]:
        return [
            "import sympy as sm",
            'x = sm.Symbol("x")',
            f"function = {FUNCTIONS[state['function']].code}",
            f"at, deviation = {state['at']:.10g}, {state['deviation']:.10g}",
            "value, slope = (float(f.subs(x, at)) for f in (function, function.diff(x)))",
            "error = value + slope * deviation - float(function.subs(x, at + deviation))",
            "ed.plots.show(ed.plots.tangent(function, at, reach=deviation))",
        ]


def linearization(function: str = "sine", **values: float) -> LinearizationExplorer:
    """Explore what linearization drops: a function and its tangent, and the error over the deviation.

    Course section 5.2. Controls: ``function``, ``at`` (point of expansion) and ``deviation``.

    Parameters
    ----------
    function : {"sine", "cosine", "spring", "root"}
    **values : float
        Where the sliders stand at first.

    Returns
    -------
    LinearizationExplorer

    Raises
    ------
    EngdynError
        An unknown function, a value that its slider does not reach.
    """
    return LinearizationExplorer(function=function, **values)
