"""Explorer of force and moment balances: parcel on a belt, bar on a cart, roll on a wedge (chapter 2)."""

from __future__ import annotations

import math
from collections.abc import Mapping
from functools import cache
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import ArrayLike
from sympy.physics.vector import dynamicsymbols

from engdyn import shapes as sh
from engdyn.modeling.kinematic_chain import KinematicChain
from engdyn.plots.drawing import draw, sketch
from engdyn.plots.newton_pictures import regions
from engdyn.plots.words import number
from engdyn.systems.library import load
from engdyn.widgets.controls import Choice, Slider
from engdyn.widgets.moment_scene import BAR_ON_CART
from engdyn.widgets.scenes import Scene, SceneExplorer, bars, beside, size_of

if TYPE_CHECKING:
    from engdyn.modeling.kinematics import AccelerationTerms

__all__ = ["BalanceExplorer", "balance"]

G = 9.81
"""Gravity [m/s²]."""

SIDE = 0.2
"""Distance of the parcel from the middle of the belt [m]."""

# Section 2.3


@cache
def _parcel() -> AccelerationTerms:
    psi, s = dynamicsymbols("psi s")
    chain = KinematicChain("N", origin="O")
    belt = chain.turn("B", about=chain.ground.z, by=psi)
    chain.move("P", s * belt.x + SIDE * belt.y)
    return chain.acceleration_terms("P", base="O", frame="B")


def _belt_values(state: Mapping[str, Any]) -> dict[str, float]:
    return {"psi": 0.0, **{name: state[name] for name in ("psi_d", "psi_dd", "s", "s_d", "s_dd")}}


def parcel_friction(state: Mapping[str, Any]) -> dict[str, Any]:
    """Return absolute and relative acceleration along and across the belt [m/s²], and the friction each asks for."""
    terms = _parcel().evaluate(_belt_values(state))
    found = {"absolute": terms["total"][:2], "relative": terms["relative"][:2]}
    return found | {f"mu_{name}": size_of(a) / G for name, a in found.items()}


def _draw_parcel(figure: Figure, state: Mapping[str, Any], result: Mapping[str, Any]) -> None:
    left, right = beside(figure, 0.62)
    at, scale = (state["s"], SIDE), 0.12  # m of the picture for 1 m/s²
    corners = ((0.0, -0.4), (2.2, -0.4), (2.2, 0.6), (0.0, 0.6))
    drawn = [
        sh.Polygon(corners, role="ground"),
        sh.Support((0.0, 0.0), "$O$"),
        sh.Box(at, (0.22, 0.16)),
        sh.MomentArrow((0.0, 0.0), 0.35, 1.2, 1.2 + math.copysign(1.6, state["psi_d"]), r"$\dot\psi$", role="velocity"),
        sh.VectorArrow((1.7, -0.25), (1.7 + 0.12 * state["s_d"], -0.25), r"$\dot s$"),
    ]  # fmt: skip
    counted = "absolute" if state["acceleration"] == "absolute" else "relative"
    for name in ("absolute", "relative"):
        label = "$F/m$" if name == counted else ""
        role = "force" if name == counted else "reference"
        tip = tuple(np.array(at) + scale * result[name])
        drawn.append(sh.VectorArrow(at, tip, label, role=role))
    sketch(drawn, "A parcel on a turning belt from above, and the friction it needs.", left)
    bars(right, {name: result[f"mu_{name}"] for name in ("absolute", "relative")}, "friction coefficient [1]", [
        name for name in ("absolute", "relative") if name != counted])  # fmt: skip


def _tell_parcel(state: Mapping[str, Any], result: Mapping[str, Any]) -> str:
    need, wrong = result["mu_absolute"], result["mu_relative"]
    along, across = result["absolute"]
    if state["acceleration"] == "relative":
        return (
            f"The acceleration of the frame is forgotten: {number(wrong)} seems enough, but the parcel needs the "
            f"friction coefficient {number(need)}."
        )
    return (
        f"The parcel needs {number(along)} m/s² along the belt and {number(across)} m/s² across it: a friction "
        f"coefficient of {number(need)}; relative to the belt alone it would be {number(wrong)}."
    )


def _parcel_lines(state: Mapping[str, Any]) -> list[str]:
    return [
        "from sympy.physics.mechanics import dynamicsymbols",
        'psi, s = dynamicsymbols("psi s")',
        'chain = ed.KinematicChain("N", origin="O")',
        'belt = chain.turn("B", about=chain.ground.z, by=psi)',
        f'chain.move("P", s * belt.x + {SIDE} * belt.y)',
        'terms = chain.acceleration_terms("P", base="O", frame="B")',
        f"values = {_belt_values(state)}",
        "print(terms.table(values))",
        "ed.plots.acceleration_terms(terms, values, chain.ground, head_to_tail=True)",
    ]


# Section 2.13


def friction_needed(slope: ArrayLike, ratio: ArrayLike) -> Any:
    """Return the friction coefficient with which the roll just rolls; ``ratio`` is m/M of roll and wedge."""
    share, c, s = np.asarray(ratio) / (1.0 + np.asarray(ratio)), np.cos(slope), np.sin(slope)
    along = s / (1.5 - share * c**2)  # s̈/g, from both force balances and rolling
    return 0.5 * along / (c - share * along * s * c)


def roll_on_wedge(state: Mapping[str, Any]) -> dict[str, Any]:
    """Return accelerations of wedge, roll and turning times R [m/s²], the friction needed, and whether it rolls."""
    slope, ratio, mu = state["beta"], state["ratio"], state["mu"]
    c, s, need = math.cos(slope), math.sin(slope), float(friction_needed(slope, ratio))
    # Along x of both (1 + 1/κ) ẍ + c s̈ = 0, along the slope c ẍ + s̈ = g s − S/m; S by rolling or as μ N.
    rolls = mu >= need
    last = [c, 1.5] if rolls else [c + mu * s, 1.0]
    right = G * s if rolls else G * (s - mu * c)
    wedge, along = np.linalg.solve([[1.0 + 1.0 / ratio, c], last], [0.0, right])
    turning = along if rolls else 2.0 * mu * (G * c + wedge * s)
    return {
        "wedge": float(wedge),
        "roll": float(along),
        "turning": float(turning),
        "needed": need,
        "rolls": rolls,
    }


def _draw_roll(figure: Figure, state: Mapping[str, Any], result: Mapping[str, Any]) -> None:
    left, right = beside(figure, 0.5)
    system = load("W3")
    draw(system, [0.0, 0.5], system.values(beta=state["beta"], m=500.0 * state["ratio"]), left)
    slopes, ratios = np.radians(np.linspace(1.0, 58.0, 58)), np.linspace(0.02, 4.0, 50)
    need = friction_needed(slopes[None, :], ratios[:, None])
    words = "Map of slope and mass ratio: where the roll rolls and where it slips."
    regions(
        np.degrees(slopes),
        ratios,
        need,
        [state["mu"]],
        ["rolls", "slips"],
        "slope [°]",
        "$m/M$",
        words,
        right,
    )
    right.plot([math.degrees(state["beta"])], [state["ratio"]], "o", color="black", clip_on=False, zorder=6)


def _tell_roll(state: Mapping[str, Any], result: Mapping[str, Any]) -> str:
    need, wedge, along = (number(result[name]) for name in ("needed", "wedge", "roll"))
    if result["rolls"]:
        return (
            f"It rolls: {need} of friction is needed, {number(state['mu'])} is there. Wedge {wedge} m/s², roll {along} "
            "m/s² relative to it."
        )
    return (
        f"It slips: {need} of friction would be needed, only {number(state['mu'])} is there. Wedge {wedge} m/s², roll "
        f"{along} m/s² relative to it, its rim turns with {number(result['turning'])} m/s² only."
    )


def _roll_lines(state: Mapping[str, Any]) -> list[str]:
    return [
        'system = ed.systems.load("W3")',
        f"values = system.values(beta={state['beta']}, m={500.0 * state['ratio']:.6g})",
        "motion = system.newton()",
        "print(motion.accelerations([0, 0], [0, 0], values))",
        "ed.plots.draw(system, [0, 0.5], values)",
    ]


_BELT = (
    Choice(
        "acceleration",
        (("absolute, as it must be", "absolute"), ("forgot the frame's acceleration", "relative")),
        "absolute",
        "acceleration that is put into F = m a",
    ),
    Slider("s", 0.3, 2.0, 1.2, "m", "place of the parcel along the belt", 0.05),
    Slider("s_d", -2.0, 2.0, 1.5, "m/s", "speed of the belt, outward", 0.1),
    Slider("s_dd", -3.0, 3.0, 1.8, "m/s^2", "acceleration of the belt", 0.1),
    Slider("psi_d", -2.0, 2.0, 1.1, "rad/s", "rate of turn of the sorter, counter-clockwise", 0.1),
    Slider("psi_dd", -2.0, 2.0, 0.6, "rad/s^2", "angular acceleration of the sorter", 0.1),
)  # fmt: skip
_ROLL = (
    Slider("beta", 0.02, 1.0, 0.35, "rad", "slope of the wedge", 0.01),
    Slider("ratio", 0.02, 4.0, 0.6, "-", "mass of the roll over that of the wedge", 0.02),
    Slider("mu", 0.02, 1.0, 0.2, "-", "friction coefficient that is there", 0.01),
)


class BalanceExplorer(SceneExplorer):
    """See `balance`."""

    title = "Balance"
    scenes = {
        "belt": Scene("Parcel on a turning belt", _BELT, parcel_friction, _draw_parcel, _tell_parcel, _parcel_lines),
        "bar": BAR_ON_CART,
        "roll": Scene("Roll on a wedge", _ROLL, roll_on_wedge, _draw_roll, _tell_roll, _roll_lines),
    }  # fmt: skip


def balance(scene: str = "belt", **values: Any) -> BalanceExplorer:
    """Explore force and moment balances.

    Course sections 2.3, 2.8 and 2.13.

    Parameters
    ----------
    scene : {"belt", "bar", "roll"}
        Parcel on a belt that turns (2.3), moments of a bar on a cart about four points (2.8), roll on a wedge that
        rolls or slips (2.13).
    **values : float or str
        Controls of the scene to start from [SI].

    Returns
    -------
    BalanceExplorer

    Raises
    ------
    EngdynError
        An unknown scene or control, a value that its slider does not reach.
    """
    return BalanceExplorer(scene=scene, **values)
