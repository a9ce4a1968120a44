"""Scenes of vectors that change: an arrow that grows and turns, a rod about a pivot (sections 1.1 and 1.3)."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

from engdyn import shapes as sh
from engdyn.plots.drawing import sketch
from engdyn.plots.kinematic_pictures import vector_change
from engdyn.plots.newton_pictures import curves
from engdyn.plots.words import number
from engdyn.widgets.controls import Choice, Slider
from engdyn.widgets.scenes import Scene, beside, size_of, whole

__all__ = ["ARROW", "CHAIN", "ROD", "arrow_change", "rod_velocity"]

START = 0.2
"""Direction of the growing and turning arrow before the change [rad]."""

LENGTH = 1.4
"""Length of the rod [m]."""

CHAIN = [
    "from sympy.physics.mechanics import dynamicsymbols",
    'x, theta, r = dynamicsymbols("x theta r")',
    'chain = ed.KinematicChain("N", origin="O")',
    'chain.move("C", x * chain.ground.x)',
    'arm = chain.turn("A", about=chain.ground.z, by=theta)',
    'chain.move("P", r * arm.x)',
]

# Section 1.1


def arrow_change(state: Mapping[str, Any]) -> dict[str, NDArray[np.float64]]:
    """Return the arrow before and after Δt, and Δr/Δt along and across it [m/s], for Δt and times up to 1 s."""
    times = np.array([state["dt"], *np.linspace(0.01, 1.0, 50)])
    length, turn = state["L"] + state["L_d"] * times, state["theta_d"] * times
    change = np.array([length * np.cos(turn) - state["L"], length * np.sin(turn)])
    angles = START + np.array([0.0, turn[0]])
    ends = np.array([state["L"], length[0]])[:, None] * np.column_stack([np.cos(angles), np.sin(angles)])
    return {"ends": ends, "times": times, "rates": change / times}


def _draw_arrow(figure: Figure, state: Mapping[str, Any], result: Mapping[str, Any]) -> None:
    left, right = beside(figure, 0.5)
    vector_change(*result["ends"], left)
    times, rates = result["times"], result["rates"]
    lines = {name: (times[1:], rate[1:]) for name, rate in zip(("along", "across"), rates, strict=True)}
    points = {"now": (times[[0, 0]], rates[:, 0])}
    words = "Δr/Δt along and across the arrow over the time step."
    curves(lines, r"$\Delta t$ [s]", r"$\Delta r/\Delta t$ [m/s]", words, right, points=points)
    limits = [state["L_d"], state["L"] * state["theta_d"]]
    right.plot([0.0, 0.0], limits, "s", color="white", markeredgecolor="black", clip_on=False)


def _tell_arrow(state: Mapping[str, Any], result: Mapping[str, Any]) -> str:
    along, across = result["rates"][:, 0]
    limit = state["L_d"], state["L"] * state["theta_d"]
    miss = size_of((along - limit[0], across - limit[1]))
    return (
        f"Δr/Δt is {number(along)} m/s along the arrow and {number(across)} m/s across it; with Δt → 0 they become "
        f"the rate of the length, {number(limit[0])} m/s, and L times the rate of turn, {number(limit[1])} m/s. "
        f"The chord misses the tangent by {number(miss)} m/s."
    )


def _arrow_lines(state: Mapping[str, Any]) -> list[str]:
    before, after = np.round(arrow_change(state)["ends"], 6).tolist()
    return [f"ed.plots.vector_change({before}, {after})"]


# Section 1.3


def rod_velocity(state: Mapping[str, Any]) -> dict[str, NDArray[np.float64]]:
    """Return tip [m], axes of the rod, those that are chosen, true velocity and the one found [m/s]."""
    c, s = math.cos(state["theta"]), math.sin(state["theta"])
    axes = np.array([[c, s], [-s, c]])
    speed = LENGTH * state["theta_d"] * axes[1]
    basis = axes if state["basis"] == "rod" else np.eye(2)
    found = 2.0 * speed if state["basis"] == "twice" else speed
    return {"tip": LENGTH * axes[0], "axes": axes, "basis": basis, "velocity": speed, "found": found}


def _draw_rod(figure: Figure, state: Mapping[str, Any], result: Mapping[str, Any]) -> None:
    tip, scale, origin = result["tip"], 0.15, (0.0, 0.0)  # m of the picture for 1 m/s
    parts = scale * (result["basis"] @ result["found"])[:, None] * result["basis"]
    drawn: list[sh.Shape] = [
        sh.Support(origin, "$O$"),
        sh.CenterLine(origin, (1.2, 0.0)),
        sh.Link(origin, tuple(tip)),
        sh.Triad(origin, labels=("$n_x$", "$n_y$"), length=0.4),
        sh.Triad(tuple(tip), tuple(map(tuple, result["axes"])), ("$a_x$", "$a_y$"), 0.4, "coordinate"),
        sh.AngleArrow(origin, 0.7, 0.0, state["theta"], r"$\theta$"),
        sh.Pin(origin),
        # Points at the rim keep the scale while the rod turns.
        *(sh.CenterLine(p, p) for p in ((-1.9, -1.7), (1.9, 1.7))),
    ]
    for foot, part in zip((tip, tip + parts[0]), parts, strict=True):
        drawn.append(sh.VectorArrow(tuple(foot), tuple(foot + part), role="force"))
    drawn.append(sh.VectorArrow(tuple(tip), tuple(tip + scale * result["found"]), "$v$"))
    sketch(drawn, "The rod, the velocity of its tip and its components.", whole(figure))


def _tell_rod(state: Mapping[str, Any], result: Mapping[str, Any]) -> str:
    parts = result["basis"] @ result["found"]
    pair = f"({number(parts[0])}, {number(parts[1])}) m/s"
    if state["basis"] == "rod":
        return f"In the axes of the rod v = {pair}: the components (l, 0) do not change, all of it is ω × r."
    if state["basis"] == "ground":
        return f"In the axes of the ground v = {pair}: the components change, the axes do not turn; no ω × r is added."
    return (
        f"Wrong: ω × r added to components along the ground, which contain the rotation already, gives {pair}, a "
        f"speed of {number(size_of(result['found']))} m/s; right is l times the rate of turn, "
        f"{number(size_of(result['velocity']))} m/s."
    )


def _rod_lines(state: Mapping[str, Any]) -> list[str]:
    frame = "A" if state["basis"] == "rod" else "N"
    return [
        *CHAIN,
        f'values = {{"x": 0, "x_d": 0, "theta": {state["theta"]}, "theta_d": {state["theta_d"]},',
        f'    "r": {LENGTH}, "r_d": 0}}',
        f'print(ed.components(chain.velocity("P"), chain.frame("{frame}"), values))',
        "ed.plots.kinematic_chain(chain, values)",
    ]


_BASIS = Choice(
    "basis",
    (
        ("unit vectors of the ground", "ground"),
        ("unit vectors of the rod", "rod"),
        ("counted twice", "twice"),
    ),
    "ground",
    "axes in which the velocity is written",
)
_ARROW = (
    Slider("L", 1.2, 3.0, 2.0, "m", "length before", 0.1),
    Slider("L_d", -1.0, 2.0, 1.0, "m/s", "rate of the length", 0.1),
    Slider("theta_d", -3.0, 3.0, 1.0, "rad/s", "rate of turn", 0.1),
    Slider("dt", 0.01, 1.0, 0.4, "s", "time step", 0.01),
)
_ROD = (
    Slider("theta", -3.1, 3.1, 0.7, "rad", "angle of the rod", 0.05),
    Slider("theta_d", -5.0, 5.0, 3.0, "rad/s", "rate of turn", 0.25),
)

ARROW = Scene("Arrow that grows and turns", _ARROW, arrow_change, _draw_arrow, _tell_arrow, _arrow_lines)
ROD = Scene("Rod about a pivot", (_BASIS, *_ROD), rod_velocity, _draw_rod, _tell_rod, _rod_lines)
