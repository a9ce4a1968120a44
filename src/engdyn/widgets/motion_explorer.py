"""Explorer of rotating vectors and of the terms of an acceleration (chapter 1)."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from functools import cache
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray
from sympy.physics.vector import Vector, dynamicsymbols

from engdyn import shapes as sh
from engdyn.modeling.kinematic_chain import KinematicChain
from engdyn.plots.drawing import sketch
from engdyn.plots.kinematic_pictures import acceleration_terms
from engdyn.plots.words import number
from engdyn.systems.library import load
from engdyn.widgets.controls import Choice, Slider
from engdyn.widgets.scenes import Scene, SceneExplorer, bars, beside, size_of
from engdyn.widgets.vector_scenes import ARROW, CHAIN, ROD

if TYPE_CHECKING:
    from engdyn.modeling.kinematics import AccelerationTerms

__all__ = ["MotionExplorer", "motion"]

TERMS = {
    "base": "base",
    "tangential": "Euler",
    "centripetal": "centripetal",
    "coriolis": "Coriolis",
    "relative": "relative",
}


@cache
def _slotted_arm() -> tuple[KinematicChain, AccelerationTerms]:
    x, theta, r = dynamicsymbols("x theta r")
    chain = KinematicChain("N", origin="O")
    chain.move("C", x * chain.ground.x)
    arm = chain.turn("A", about=chain.ground.z, by=theta)
    chain.move("P", r * arm.x)
    return chain, chain.acceleration_terms("P", base="C", frame="A")


def _instant(state: Mapping[str, Any]) -> dict[str, float]:
    names = [f"{q}{dots}" for q in ("x", "theta", "r") for dots in ("", "_d", "_dd")]
    return {name: float(state.get(name, 0.0)) for name in names}


def _left_out(state: Mapping[str, Any]) -> str:
    return state.get("left_out", "none")


def collar_terms(state: Mapping[str, Any]) -> dict[str, NDArray[np.float64]]:
    """Return the terms of the collar's acceleration in ground axes [m/s²], the sum of those kept, and the path's.

    The path is differentiated twice numerically: it knows none of the terms.
    """
    now = _instant(state)
    c, s = math.cos(now["theta"]), math.sin(now["theta"])
    written = _slotted_arm()[1].evaluate(now)  # along and across the arm
    terms = {name: np.array([[c, -s], [s, c]]) @ written[name][:2] for name in TERMS}

    def place(t: float) -> NDArray[np.float64]:
        x, theta, r = (now[q] + now[f"{q}_d"] * t + now[f"{q}_dd"] * t**2 / 2 for q in ("x", "theta", "r"))
        return np.array([x + r * math.cos(theta), r * math.sin(theta)])

    h = 1e-4
    path = (place(h) - 2.0 * place(0.0) + place(-h)) / h**2
    kept = [a for name, a in terms.items() if name != _left_out(state)]
    return {**terms, "total": np.sum(kept, axis=0), "path": path}


def _draw_collar(figure: Figure, state: Mapping[str, Any], result: Mapping[str, Any]) -> None:
    left, right = beside(figure, 0.58)
    moving, angle, distance = "x_dd" in state, state["theta"], state["r"]
    start = distance * np.array([math.cos(angle), math.sin(angle)])
    machine = load("W1")
    behind = [sh.Ground((-0.3, -0.09), (0.3, -0.09)), sh.Box((0.0, -0.04), (0.2, 0.08))] if moving else []
    behind += [
        s
        for s in machine.shapes([angle, distance], machine.values())
        if not (moving and isinstance(s, sh.Support))
    ]
    # Points at the rim keep the scale while the arm turns.
    rim = [sh.CenterLine(p, p, role="ground") for p in ((-0.7, -0.55), (0.7, 0.55))]
    chain, terms = _slotted_arm()
    if _left_out(state) != "none":
        terms = replace(terms, **{_left_out(state): Vector(0)})
    chained = state["arrows"] == "chain"
    longest = max(size_of(result[name]) for name in (*TERMS, *(["total"] if chained else [])))
    acceleration_terms(
        terms, _instant(state), chain.ground, start, left, background=[*behind, *rim], length=0.4, head_to_tail=chained
    )  # fmt: skip
    if chained:
        tip = start + 0.4 / longest * result["path"]
        sketch(
            [sh.VectorArrow(tuple(start), tuple(tip), "path", role="velocity")],
            "The path's acceleration.",
            left,
        )
    shown = {label: size_of(result[name]) for name, label in TERMS.items() if name != "base" or moving}
    bars(right, shown, "magnitude [m/s²]", [TERMS.get(_left_out(state), "")])
    right.tick_params(axis="x", labelrotation=35, labelsize=12)


def _tell_collar(state: Mapping[str, Any], result: Mapping[str, Any]) -> str:
    told = ", ".join(
        f"{label} {number(size_of(result[name]))}"
        for name, label in TERMS.items()
        if name != "base" or "x_dd" in state
    )
    path, miss = (float(f"{size_of(a):.3g}") for a in (result["path"], result["path"] - result["total"]))
    text = f"Terms in m/s²: {told}. The path, differentiated twice, has {number(path)} m/s²"
    if _left_out(state) == "none":
        return f"{text}, as the sum of the terms has."
    return f"{text}; without the {TERMS[_left_out(state)]} term the sum misses it by {number(miss)} m/s²."


def _collar_lines(state: Mapping[str, Any]) -> list[str]:
    left_out, chained = _left_out(state), state["arrows"] == "chain"
    return [
        *CHAIN,
        'terms = chain.acceleration_terms("P", base="C", frame="A")',
        f"values = {_instant(state)}",
        "print(terms.table(values))",
        *([] if left_out == "none" else [f'print(ed.components(terms.without("{left_out}"), arm, values))']),
        f"ed.plots.acceleration_terms(terms, values, chain.ground, head_to_tail={chained})",
    ]


_ARROWS = Choice(
    "arrows",
    (("at the collar", "point"), ("head to tail, with the path", "chain")),
    "point",
    "how the terms are drawn",
)
_LEFT_OUT = Choice(
    "left_out",
    (("nothing", "none"), *((label, name) for name, label in TERMS.items())),
    "none",
    "term that is left out of the sum",
)
_COLLAR = (
    Slider("r", 0.1, 0.6, 0.36, "m", "distance of the collar from the pivot", 0.01),
    Slider("r_d", -2.0, 2.0, 0.5, "m/s", "rate of r", 0.05),
    Slider("r_dd", -20.0, 20.0, -2.0, "m/s^2", "second rate of r", 0.5),
    Slider("theta", -3.1, 3.1, 0.6, "rad", "angle of the arm, counter-clockwise", 0.05),
    Slider("theta_d", -8.0, 8.0, 5.0, "rad/s", "rate of turn of the arm", 0.25),
    Slider("theta_dd", -40.0, 40.0, 10.0, "rad/s^2", "angular acceleration of the arm", 1.0),
)
_PUSH = Slider("x_dd", -20.0, 20.0, 6.0, "m/s^2", "acceleration of the base, to the right", 0.5)
_COLLAR_DOES = (collar_terms, _draw_collar, _tell_collar, _collar_lines)


class MotionExplorer(SceneExplorer):
    """See `motion`."""

    title = "Motion"
    scenes = {
        "arm": Scene("Collar in a turning arm", (_ARROWS, *_COLLAR), *_COLLAR_DOES),
        "shuttle": Scene("Collar on a moving base", (_ARROWS, _LEFT_OUT, _PUSH, *_COLLAR), *_COLLAR_DOES),
        "arrow": ARROW,
        "rod": ROD,
    }


def motion(scene: str = "arm", **values: Any) -> MotionExplorer:
    """Explore how vectors change, and the terms of an acceleration.

    Course sections 1.1, 1.3, 1.4 and 1.7.

    Parameters
    ----------
    scene : {"arm", "shuttle", "arrow", "rod"}
        Collar in a turning arm (1.4); the same on a moving base, with terms that can be left out (1.7); arrow
        that grows and turns (1.1); rod about a pivot, in two bases (1.3).
    **values : float or str
        Controls of the scene to start from [SI].

    Returns
    -------
    MotionExplorer

    Raises
    ------
    EngdynError
        An unknown scene or control, a value that its slider does not reach.
    """
    return MotionExplorer(scene=scene, **values)
