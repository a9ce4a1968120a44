"""Explorer of bodies that spin: a top, a thrown ball, a thrown box (chapter 2)."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from scipy.integrate import solve_ivp

from engdyn.modeling.gyroscopes import free_precession, steady_precession
from engdyn.plots.gyro_pictures import gyroscope as gyroscope_picture
from engdyn.plots.gyro_pictures import precession_cones, sphere_paths
from engdyn.plots.newton_pictures import curves
from engdyn.plots.projection import View
from engdyn.plots.words import number
from engdyn.solids import box
from engdyn.systems.library import load
from engdyn.widgets.controls import Choice, Slider
from engdyn.widgets.scenes import Scene, SceneExplorer, beside

__all__ = ["GyroscopeExplorer", "gyroscope"]

FASTEST = 400.0
"""Greatest spin of the top [rad/s]."""

BOOK = np.diag(box(1.2, 0.24, 0.16, 0.05))
"""Principal moments of inertia of a book of 1.2 kg, 240 x 160 x 50 mm [kg m²], rising."""

THROW, FLIGHT = 10.0, 6.0
"""Spin of the thrown book [rad/s] and how long it is watched [s]."""

AXES = {"1": "smallest", "2": "intermediate", "3": "largest"}


def _top() -> dict[str, float]:
    """Moments A and C about the tip [kg m²], and the weight times its distance from the tip, m g l [N m]."""
    v = load("W5").values()
    return {"A": v["A"], "C": v["C"], "mgl": v["m"] * v["g"] * v["l"]}


# Section 2.14, steady


def top_rates(state: Mapping[str, Any]) -> dict[str, Any]:
    """Return the steady precession of the top and that over all spins with a solution [rad/s]."""
    top, lean = _top(), state["theta"]

    def at(spin: float) -> Any:
        return steady_precession(top["A"], top["C"], spin, lean, top["mgl"])

    now = at(state["spin"])
    spins = np.linspace(max(1.0001 * now.limiting_spin, 20.0), FASTEST, 60)
    found = np.array([at(spin).rates for spin in spins])
    return {"now": now, "spins": spins, "rates": found}


def _draw_top(figure: Figure, state: Mapping[str, Any], result: Mapping[str, Any]) -> None:
    left, right = beside(figure, 0.5)
    now = result["now"]
    gyroscope_picture(state["theta"], -0.2, 1.2 if state["theta"] > 1.2 else 0.0, ax=left)
    if not now.rates:
        left.text(0.02, 0.02, "no steady\nprecession:\nit falls", transform=left.transAxes, fontsize=13)
    names = ("slow", "fast")[: result["rates"].shape[1]]
    lines = {name: (result["spins"], result["rates"][:, k]) for k, name in enumerate(names)}
    points = {"now": ([state["spin"]] * len(now.rates), now.rates)} if now.rates else None
    words = "Precession rates over the spin."
    curves(lines, r"$\omega_3$ [rad/s]", r"$\Omega$ [rad/s]", words, right, points=points)
    right.axvline(state["spin"], color="black", linewidth=1.2, linestyle=":")
    right.set_xlim(0.0, FASTEST)
    right.set_ylim(*((0.0, 60.0) if math.cos(state["theta"]) > 0.0 else (-60.0, 30.0)))


def _tell_top(state: Mapping[str, Any], result: Mapping[str, Any]) -> str:
    now, top = result["now"], _top()
    if not now.rates:
        return (
            f"No steady precession: the discriminant is negative, for the spin is below the limiting spin of "
            f"{number(now.limiting_spin)} rad/s; the top falls."
        )
    simple = top["mgl"] / (top["C"] * state["spin"])
    text = f"Slow precession {number(now.slow)} rad/s (M = Ω × H alone says {number(simple)})"
    if len(now.rates) == 1:
        return f"{text}, the only one with the axis level."
    limit = (
        f"the limiting spin is {number(now.limiting_spin)} rad/s"
        if now.limiting_spin
        else "every spin will do"
    )
    return f"{text}, fast precession {number(now.fast)} rad/s; {limit}."


def _top_lines(state: Mapping[str, Any]) -> list[str]:
    return [
        'v = ed.systems.load("W5").values()',
        'weight = v["m"] * v["g"] * v["l"]',
        f'print(ed.steady_precession(v["A"], v["C"], {state["spin"]}, {state["theta"]}, weight))',
        f"ed.plots.gyroscope({state['theta']}, -0.2)",
    ]


# Section 2.14, in motion


def top_path(state: Mapping[str, Any]) -> dict[str, Any]:
    """Return times [s], lean [rad] and direction of the axis of a top that starts with some precession."""
    system, lean = load("W5"), state["theta"]
    rate = state["precession"]
    start = [0.0, lean, 0.0, rate, 0.0, state["spin"] - rate * math.cos(lean)]
    fly, times = system.equations.function(system.values()), np.linspace(0.0, 0.8, 321)

    def lying(t: float, y: Any) -> float:
        return min(y[1] - 0.02, math.pi / 2 - y[1])

    lying.terminal = True  # type: ignore[attr-defined]
    run = solve_ivp(fly, (0.0, 0.8), start, t_eval=times, rtol=1e-6, atol=1e-8, events=lying)
    phi, theta = run.y[:2]
    axis = np.column_stack([np.sin(theta) * np.sin(phi), -np.sin(theta) * np.cos(phi), np.cos(theta)])
    return {"times": run.t, "lean": theta, "axis": axis, "around": phi[-1], "fell": bool(theta[-1] > 1.5)}


def _draw_path(figure: Figure, state: Mapping[str, Any], result: Mapping[str, Any]) -> None:
    left, right = beside(figure, 0.48)
    view = View(math.radians(-60), math.radians(55))
    sphere_paths([result["axis"]], ["X", "Y", "Z"], "Path of the axis of the top on a sphere.", view, left)
    lines = {"lean": (result["times"], np.degrees(result["lean"]))}
    curves(lines, "$t$ [s]", r"$\theta$ [°]", "Lean of the axis over time.", right)
    right.set_xlim(0.0, 0.8)
    right.margins(y=0.3)


def _tell_path(state: Mapping[str, Any], result: Mapping[str, Any]) -> str:
    low, high = np.degrees([result["lean"].min(), result["lean"].max()])
    end = float(result["times"][-1])
    if result["fell"]:
        return f"The top falls: after {number(round(end, 3))} s its axis is level."
    mean = result["around"] / end
    return (
        f"The axis nods between {low:.1f}° and {high:.1f}° and goes around the vertical at {mean:.1f} rad/s."
    )


def _path_lines(state: Mapping[str, Any]) -> list[str]:
    spin = state["spin"] - state["precession"] * math.cos(state["theta"])
    return [
        'top = ed.systems.load("W5")',
        f"start = [0, {state['theta']}, 0], [{state['precession']}, 0, {spin:.6g}]",
        "history = top.simulate(start, [0.002 * k for k in range(401)])",
        'ed.plots.time_history(history, "theta")',
    ]


# Section 2.12


def ball_precession(state: Mapping[str, Any]) -> dict[str, Any]:
    """Return precession and wobble [rad/s] of a ball with A = 1, and directions of axis, ω and H."""
    ratio, angle = state["ratio"], state["nutation"]
    found = free_precession(1.0, ratio, state["spin"], angle)
    axis = np.array([math.sin(angle), 0.0, math.cos(angle)])
    momentum = np.array([0.0, 0.0, 1.0])
    along = math.cos(angle) * axis
    omega = along / ratio + (momentum - along)
    between = math.atan(ratio * math.tan(angle))  # of ω and the axis
    return {"found": found, "axis": axis, "omega": omega, "momentum": momentum, "between": between}


def _draw_ball(figure: Figure, state: Mapping[str, Any], result: Mapping[str, Any]) -> None:
    left, right = beside(figure, 0.5)
    slender = math.sqrt(2.0 / state["ratio"] - 1.0)
    half = (0.75 / max(1.0, slender), 0.75 * min(1.0, slender))
    precession_cones(result["axis"], result["omega"], result["momentum"], half, ax=left)
    ratios = np.linspace(0.2, 1.95, 60)
    cosine = math.cos(state["nutation"])
    lines = {"precession": (ratios, ratios / cosine), "wobble": (ratios, ratios - 1.0)}
    spin, found = state["spin"], result["found"]
    points = {"now": ([state["ratio"]] * 2, [found.precession / spin, found.wobble / spin])}
    curves(lines, "$C/A$ [1]", r"rate in units of $\omega_3$", "Rates over C/A.", right, points=points)


def _tell_ball(state: Mapping[str, Any], result: Mapping[str, Any]) -> str:
    found, ratio = result["found"], round(state["ratio"], 9)
    sense = "with" if ratio > 1.0 else "against"
    wobble = "does not wobble (C = A: every axis is principal)" if ratio == 1.0 else (
        f"in the body ω goes around the axis at {number(found.wobble)} rad/s, {sense} the spin"
    )  # fmt: skip
    where = "between the axis and H" if ratio < 1.0 else "along H" if ratio == 1.0 else "beyond H"
    return (
        f"An observer sees the axis go around H at {number(found.precession)} rad/s, in the sense of the spin of "
        f"{number(state['spin'])} rad/s; {wobble}. ω lies {where}, {math.degrees(result['between']):.1f}° from "
        "the axis."
    )


def _ball_lines(state: Mapping[str, Any]) -> list[str]:
    result = ball_precession(state)
    axis, omega = (np.round(result[name], 6).tolist() for name in ("axis", "omega"))
    return [
        f"print(ed.free_precession(1.0, {state['ratio']}, {state['spin']}, {state['nutation']}))",
        f"ed.plots.precession_cones({axis}, {omega}, [0, 0, 1])",
    ]


# Section 2.11


def book_flight(state: Mapping[str, Any]) -> dict[str, Any]:
    """Return times [s], ω [rad/s] and H [kg m²/s] in the axes of a thrown book."""
    k = int(state["axis"]) - 1
    start = np.where(np.arange(3) == k, THROW, state["perturbation"] * THROW)
    A, B, C = BOOK

    def euler(t: float, w: Any) -> list[float]:
        return [(B - C) / A * w[1] * w[2], (C - A) / B * w[2] * w[0], (A - B) / C * w[0] * w[1]]

    times = np.linspace(0.0, FLIGHT, 401)
    run = solve_ivp(euler, (0.0, FLIGHT), start, "DOP853", times, rtol=1e-7, atol=1e-9)
    return {"times": times, "omega": run.y, "momentum": (BOOK[:, None] * run.y).T}


def _draw_book(figure: Figure, state: Mapping[str, Any], result: Mapping[str, Any]) -> None:
    left, right = beside(figure, 0.45)
    sphere_paths([result["momentum"]], ["1", "2", "3"], "Path of H in the book.", View(0.85, 0.5), left)
    lines = {f"axis {k + 1}": (result["times"], w) for k, w in enumerate(result["omega"])}
    curves(lines, "$t$ [s]", r"$\omega$ [rad/s]", "Angular velocity over time.", right)
    right.set_ylim(-15.0, 15.0)


def _tell_book(state: Mapping[str, Any], result: Mapping[str, Any]) -> str:
    spin = result["omega"][int(state["axis"]) - 1]
    turns = int(np.count_nonzero(np.diff(np.sign(spin))))
    text = f"Thrown about the axis of the {AXES[state['axis']]} moment of inertia"
    if turns:
        return f"{text} the book turns over {turns} time{'s' * (turns > 1)} in {FLIGHT:g} s."
    if np.min(np.abs(spin)) > 0.5 * THROW:
        return f"{text} the book stays calm: the spin about it keeps above {np.min(np.abs(spin)):.2f} rad/s."
    return f"{text} the spin falls to {np.min(np.abs(spin)):.2f} rad/s within {FLIGHT:g} s."


def _book_lines(state: Mapping[str, Any]) -> list[str]:
    start = np.where(np.arange(3) == int(state["axis"]) - 1, THROW, round(state["perturbation"] * THROW, 6))
    return [
        "import numpy as np",
        "from scipy.integrate import solve_ivp",
        "from sympy import symbols",
        "from sympy.physics.mechanics import dynamicsymbols",
        'book = ed.euler_equations(symbols("A B C"), dynamicsymbols("omega_1:4"))',
        "moments = np.diag(ed.solids.box(1.2, 0.24, 0.16, 0.05))",
        'fly = book.function(dict(zip("ABC", moments)))',
        f"run = solve_ivp(fly, (0, {FLIGHT}), {start.tolist()}, max_step=0.02)",
        'ed.plots.sphere_paths([(moments[:, None] * run.y).T], "123", "Path of H.", ed.plots.View(0.85, 0.5))',
    ]


_SPIN = Slider("spin", 20.0, FASTEST, 200.0, "rad/s", "total spin of the top about its axis", 5.0)
_TOP = (_SPIN, Slider("theta", 0.1, 2.6, 0.5, "rad", "lean of the axis from the upward vertical", 0.05))
_PATH = (
    _SPIN,
    Slider("theta", 0.1, 1.4, 0.5, "rad", "lean of the axis at the start", 0.05),
    Slider("precession", -20.0, 60.0, 0.0, "rad/s", "rate of precession at the start", 1.0),
)
_BALL = (
    Slider("ratio", 0.2, 1.95, 0.6, "-", "axial over transverse moment of inertia, C/A", 0.05),
    Slider("nutation", 0.05, 1.2, 0.45, "rad", "angle between the axis and H", 0.05),
    Slider("spin", 5.0, 80.0, 50.0, "rad/s", "axial component of ω", 1.0),
)
_BOOK = (
    Choice("axis", tuple((f"axis {k}, {name} moment", k) for k, name in AXES.items()), "2", "axis of the throw"),
    Slider("perturbation", 0.001, 0.3, 0.01, "-", "spin about the other axes, in units of that about this one", 0.001),
)  # fmt: skip


class GyroscopeExplorer(SceneExplorer):
    """See `gyroscope`."""

    title = "Gyroscope"
    scenes = {
        "top": Scene("Top in steady precession", _TOP, top_rates, _draw_top, _tell_top, _top_lines),
        "path": Scene("Top in motion", _PATH, top_path, _draw_path, _tell_path, _path_lines),
        "ball": Scene("Thrown ball", _BALL, ball_precession, _draw_ball, _tell_ball, _ball_lines),
        "book": Scene("Thrown book", _BOOK, book_flight, _draw_book, _tell_book, _book_lines),
    }


def gyroscope(scene: str = "top", **values: Any) -> GyroscopeExplorer:
    """Explore bodies that spin.

    Course sections 2.11, 2.12 and 2.14.

    Parameters
    ----------
    scene : {"top", "path", "ball", "book"}
        Top in steady precession and in motion (2.14), thrown ball (2.12), thrown book (2.11).
    **values : float or str
        Controls of the scene to start from [SI].

    Returns
    -------
    GyroscopeExplorer

    Raises
    ------
    EngdynError
        An unknown scene or control, a value that its slider does not reach.
    """
    return GyroscopeExplorer(scene=scene, **values)
