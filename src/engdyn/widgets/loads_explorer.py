"""Explorer of loads and energies of the bar on a slider (chapter 3)."""

from __future__ import annotations

import math
from collections.abc import Mapping
from functools import cache
from typing import Any

import numpy as np
import sympy as sm
from matplotlib.figure import Figure
from sympy.physics.mechanics import Force, Point

from engdyn import shapes as sh
from engdyn.modeling.energies import damper_dissipation
from engdyn.modeling.instants import number_at
from engdyn.modeling.virtual_work import generalized_forces
from engdyn.plots.drawing import sketch, structure
from engdyn.plots.words import number
from engdyn.system import System
from engdyn.systems.library import load
from engdyn.widgets.controls import Choice, Slider
from engdyn.widgets.scenes import Scene, SceneExplorer, bars, beside

__all__ = ["LoadsExplorer", "loads"]

DAMPING = 5.0
"""Coefficient of the oblique dashpot [N s/m]."""

FAR = 0.9
"""Distance of the dashpot's foot from the end of the bar [m]."""

SETUP = [
    "import sympy as sm",
    "from sympy.physics.mechanics import Force, Point",
    'system = ed.systems.load("W7")',
    "bar, ground = system.free_bodies()[1], system.frame",
    "hinge, axes = bar.reactions[0].point, bar.body.frame",
    "s, theta = (c.symbol for c in system.coordinates)",
    'end = hinge.locatenew("E", -sm.Symbol("l", positive=True) * axes.y)',
]


@cache
def _bench() -> System:
    return load("W7")


@cache
def _symbols() -> dict[str, Any]:
    """Coordinates, axes of the bar, its end and the fixed origin, as the model has them."""
    bar, ground = _bench().free_bodies()[1], _bench().frame
    hinge, origin = bar.reactions[0].point, Point("O")
    par = {p.name: p.symbol for p in _bench().parameters}
    s, theta = (c.symbol for c in _bench().coordinates)
    origin.set_vel(ground, 0)
    hinge.set_pos(origin, s * (sm.cos(par["gamma"]) * ground.x + sm.sin(par["gamma"]) * ground.y))
    end = hinge.locatenew("E", -par["l"] * bar.body.frame.y)
    return {"q": [s, theta], "bar": bar.body.frame, "end": end, "origin": origin}


def _values(state: Mapping[str, Any]) -> dict[str, float]:
    return {**_bench().values(), "s_d": 0.0, "theta_d": 0.0, **state}


def _pose(state: Mapping[str, Any]) -> tuple[list[sh.Shape], np.ndarray, np.ndarray, np.ndarray]:
    """The bench without what is written on it; hinge, mass center and end of the bar [m]."""
    v = _bench().values()
    drawn = structure(_bench().shapes([state["s"], state["theta"]], v))
    hinge = state["s"] * np.array([math.cos(v["gamma"]), math.sin(v["gamma"])])
    down = v["l"] * np.array([math.sin(state["theta"]), -math.cos(state["theta"])])
    return drawn, hinge, hinge + down / 2.0, hinge + down


# Section 3.3


@cache
def _push(follower: bool) -> list[sm.Expr]:
    known, ground, size = _symbols(), _bench().frame, sm.Symbol("F")
    direction = known["bar"].x if follower else ground.x
    forces = generalized_forces(Force(known["end"], size * direction), known["q"], ground)
    return [forces[q] for q in known["q"]]


def push_forces(state: Mapping[str, Any]) -> np.ndarray:
    """Return the generalized forces Q_s [N] and Q_theta [N m] of a push on the end of the bar."""
    return np.array([number_at(e, _values(state)) for e in _push(state["direction"] == "follower")])


def _draw_push(figure: Figure, state: Mapping[str, Any], result: np.ndarray) -> None:
    left, right = beside(figure, 0.6)
    drawn, _, _, end = _pose(state)
    angle = state["theta"] if state["direction"] == "follower" else 0.0
    way = 0.03 * state["F"] * np.array([math.cos(angle), math.sin(angle)])
    drawn.append(sh.VectorArrow(tuple(end), tuple(end + way), "$F$", role="force"))
    sketch(drawn, "The bar on the slider, pushed at its end.", left)
    bars(right, {"$Q_s$ [N]": result[0], r"$Q_\theta$ [N m]": result[1]}, "generalized force")


def _tell_push(state: Mapping[str, Any], result: np.ndarray) -> str:
    text = f"Q_s = {number(result[0])} N, Q_theta = {number(result[1])} N m."
    if state["direction"] == "follower":
        return (
            f"{text} The force turns with the bar: its arm about the hinge is always l. It has no potential."
        )
    return f"{text} The force keeps its direction: its share along the guide does not change; it has a potential."


def _push_lines(state: Mapping[str, Any]) -> list[str]:
    frame = "axes" if state["direction"] == "follower" else "ground"
    return [
        *SETUP,
        f"print(ed.generalized_forces(Force(end, {state['F']} * {frame}.x), [s, theta], ground))",
        f"ed.plots.draw(system, [{state['s']}, {state['theta']}])",
    ]


# Section 3.5


@cache
def _dashpot() -> tuple[sm.Expr, list[sm.Expr]]:
    """Dissipation function and its gradient for a dashpot to a fixed point at (X, Y)."""
    known, ground = _symbols(), _bench().frame
    X, Y, c = sm.symbols("X Y c_d")
    foot = known["origin"].locatenew("W", X * ground.x + Y * ground.y)
    dissipation = damper_dissipation(c, foot, known["end"], ground)
    return dissipation, [dissipation.diff(q.diff()) for q in known["q"]]


def dashpot_forces(state: Mapping[str, Any]) -> dict[str, Any]:
    """Return D [W], Q_s [N], Q_theta [N m], the rate of the dashpot's length [m/s] and its foot [m]."""
    _, _, _, end = _pose(state)
    foot = end + FAR * np.array([math.cos(state["angle"]), math.sin(state["angle"])])
    values = {**_values(state), "X": foot[0], "Y": foot[1], "c_d": DAMPING}
    dissipation, slopes = _dashpot()
    D = number_at(dissipation, values)
    v = _bench().values()
    along = np.array([math.cos(v["gamma"]), math.sin(v["gamma"])])
    across = np.array([math.cos(state["theta"]), math.sin(state["theta"])])
    velocity = state["s_d"] * along + v["l"] * state["theta_d"] * across
    rate = float(velocity @ (end - foot)) / FAR
    forces = np.array([-number_at(slope, values) for slope in slopes])
    return {"D": D, "Q": forces, "rate": rate, "foot": foot, "velocity": velocity}


def _draw_dashpot(figure: Figure, state: Mapping[str, Any], result: Mapping[str, Any]) -> None:
    left, right = beside(figure, 0.6)
    drawn, _, _, end = _pose(state)
    foot = result["foot"]
    drawn += [sh.Support(tuple(foot), angle=state["angle"]), sh.Damper(tuple(foot), tuple(end), "$c_d$")]
    drawn.append(sh.VectorArrow(tuple(end), tuple(end + 0.25 * result["velocity"]), "$v_E$"))
    force = -0.05 * DAMPING * result["rate"] * (end - foot) / FAR
    drawn.append(sh.VectorArrow(tuple(end), tuple(end + force), r"$c_d\,\dot\Delta$", role="force"))
    sketch(drawn, "The bar on the slider with a dashpot from its end to a fixed point.", left)
    power = {"$Q_s$": result["Q"][0], r"$Q_\theta$": result["Q"][1], "$-2D$": -2.0 * result["D"]}
    bars(right, power, "[N], [N m], [W]")


def _tell_dashpot(state: Mapping[str, Any], result: Mapping[str, Any]) -> str:
    way = "grows" if result["rate"] > 0.0 else "shrinks"
    change = (
        f"{way} at {number(abs(result['rate']))} m/s" if abs(result["rate"]) > 1e-9 else "keeps its length"
    )
    return (
        f"The dashpot {change}: force {number(DAMPING * abs(result['rate']))} N, Q_s = {number(result['Q'][0])} N, "
        f"Q_theta = {number(result['Q'][1])} N m. It takes out 2D = {number(2.0 * result['D'])} W."
    )


def _dashpot_lines(state: Mapping[str, Any]) -> list[str]:
    X, Y = np.round(dashpot_forces(state)["foot"], 6).tolist()
    motion = {name: state[name] for name in ("s", "theta", "s_d", "theta_d")}
    return [
        *SETUP,
        'origin = Point("O")',
        "origin.set_vel(ground, 0)",
        'gamma = sm.Symbol("gamma")',
        "hinge.set_pos(origin, s * (sm.cos(gamma) * ground.x + sm.sin(gamma) * ground.y))",
        f'foot = origin.locatenew("W", {X} * ground.x + {Y} * ground.y)',
        f"D = ed.damper_dissipation({DAMPING}, foot, end, ground)",
        f"motion = {motion}",
        "numbers = {s.diff(): motion['s_d'], theta.diff(): motion['theta_d'], s: motion['s'], theta: motion['theta']}",
        "numbers |= {p.symbol: p.default for p in system.parameters}",
        "print([D.subs(numbers), *(-D.diff(q.diff()).subs(numbers) for q in (s, theta))])",
        f"ed.plots.draw(system, [{state['s']}, {state['theta']}])",
    ]


# Section 3.7


def bench_energies(state: Mapping[str, Any]) -> dict[str, float]:
    """Return kinetic energy, and potential energies of spring and weights [J]."""
    bench, values = _bench(), _values(state)
    spring = values["k"] * state["s"] ** 2 / 2.0
    potential = number_at(bench.potential_energy, values)
    return {"T": number_at(bench.kinetic_energy, values), "spring": spring, "weights": potential - spring}


def _draw_energies(figure: Figure, state: Mapping[str, Any], result: Mapping[str, float]) -> None:
    left, right = beside(figure, 0.5)
    drawn, hinge, center, _ = _pose(state)
    drawn += [sh.CenterLine((-0.6, 0.0), (0.8, 0.0)), sh.Label((-0.6, 0.0), "datum", (0.3, -1.0))]
    drawn.append(sh.Dimension((0.7, 0.0), (0.7, float(center[1])), "$h_G$"))
    drawn.append(sh.CenterLine(tuple(center), (0.75, float(center[1]))))
    drawn.append(sh.CenterLine((-0.5, float(hinge[1])), tuple(hinge)))
    drawn.append(sh.Dimension((-0.45, 0.0), (-0.45, float(hinge[1])), "$h_A$"))
    sketch(drawn, "The bar on the slider with the heights of hinge and mass center.", left)
    total = result["spring"] + result["weights"]
    bars(
        right,
        {"$T$": result["T"], "spring": result["spring"], "weights": result["weights"], "$V$": total},
        "energy [J]",
    )


def _tell_energies(state: Mapping[str, Any], result: Mapping[str, float]) -> str:
    total = result["spring"] + result["weights"]
    return (
        f"T = {number(result['T'])} J; V = {number(total)} J, of which {number(result['spring'])} J are in the spring "
        f"and {number(result['weights'])} J in the weights, counted from the datum; T + V = "
        f"{number(result['T'] + total)} J."
    )


def _energy_lines(state: Mapping[str, Any]) -> list[str]:
    return [
        'system = ed.systems.load("W7")',
        "s, theta = (c.symbol for c in system.coordinates)",
        f"motion = {{s.diff(): {state['s_d']}, theta.diff(): {state['theta_d']}, s: {state['s']},",
        f"    theta: {state['theta']}}}",
        "numbers = motion | {p.symbol: p.default for p in system.parameters}",
        "print(system.kinetic_energy.subs(numbers), system.potential_energy.subs(numbers))",
        f"ed.plots.draw(system, [{state['s']}, {state['theta']}])",
    ]


_POSE = (
    Slider("s", -0.2, 0.3, 0.1, "m", "travel of the slider up the guide", 0.01),
    Slider(
        "theta", -3.1, 3.1, 0.6, "rad", "angle of the bar from the downward vertical, counter-clockwise", 0.05
    ),
)
_RATES = (
    Slider("s_d", -2.0, 2.0, 0.5, "m/s", "speed of the slider", 0.05),
    Slider("theta_d", -8.0, 8.0, 2.0, "rad/s", "rate of turn of the bar", 0.25),
)
_PUSH = (
    Choice(
        "direction",
        (("always level", "fixed"), ("follows the bar", "follower")),
        "fixed",
        "how the force is directed",
    ),
    Slider("F", -10.0, 10.0, 8.0, "N", "size of the force", 0.5),
    *_POSE,
)  # fmt: skip
_DASHPOT = (
    Slider(
        "angle", -3.1, 3.1, -1.2, "rad", "direction from the end of the bar to the foot of the dashpot", 0.1
    ),
    *_POSE,
    *_RATES,
)


class LoadsExplorer(SceneExplorer):
    """See `loads`."""

    title = "Loads"
    scenes = {
        "push": Scene("Push on the end of the bar", _PUSH, push_forces, _draw_push, _tell_push, _push_lines),
        "dashpot": Scene("Oblique dashpot", _DASHPOT, dashpot_forces, _draw_dashpot, _tell_dashpot, _dashpot_lines),
        "energy": Scene("Energies", (*_POSE, *_RATES), bench_energies, _draw_energies, _tell_energies, _energy_lines),
    }  # fmt: skip


def loads(scene: str = "push", **values: Any) -> LoadsExplorer:
    """Explore generalized forces, dampers and energies of the bar on a slider (W7).

    Course sections 3.3, 3.5 and 3.7.

    Parameters
    ----------
    scene : {"push", "dashpot", "energy"}
        Force of fixed direction or that follows (3.3), oblique dashpot (3.5), kinetic and potential energy (3.7).
    **values : float or str
        Controls of the scene to start from [SI].

    Returns
    -------
    LoadsExplorer

    Raises
    ------
    EngdynError
        An unknown scene or control, a value that its slider does not reach.
    """
    return LoadsExplorer(scene=scene, **values)
