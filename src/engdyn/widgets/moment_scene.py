"""Scene of a moment balance: a bar on a cart, about the point of one's choice (section 2.8)."""

from __future__ import annotations

import math
from collections.abc import Mapping
from functools import cache
from typing import Any

import numpy as np
import sympy as sm
from matplotlib.figure import Figure
from sympy.physics.mechanics import Force, Point, ReferenceFrame, RigidBody, dynamicsymbols, inertia

from engdyn import shapes as sh
from engdyn.modeling.free_body import FreeBody
from engdyn.modeling.instants import components, number_at
from engdyn.modeling.moments import MomentBalance, moment_balance
from engdyn.plots.drawing import sketch
from engdyn.plots.words import number
from engdyn.widgets.controls import Choice, Slider
from engdyn.widgets.scenes import Scene, bars, beside

__all__ = ["BAR_ON_CART", "bar_balance"]

BAR = {"m": 2.0, "l": 0.8, "g": 9.81}
"""Mass [kg] and length [m] of the bar on the cart, gravity [m/s²]."""

POINTS = {"G": "mass center G", "A": "hinge A", "E": "free end E", "O": "fixed origin O"}


@cache
def _bar_balances() -> tuple[dict[str, MomentBalance], sm.Expr, dict[str, sm.Expr]]:
    """Balances about each point, θ̈, and the hinge forces."""
    x_b, theta = dynamicsymbols("x_b theta")
    A_x, A_y, m, l, g = sm.symbols("A_x A_y m l g")
    ground, axes = ReferenceFrame("N"), ReferenceFrame("B")
    axes.orient_axis(ground, theta, ground.z)
    origin = Point("O")
    origin.set_vel(ground, 0)
    hinge = origin.locatenew("A", x_b * ground.x)
    center, end = hinge.locatenew("G", l / 2 * axes.y), hinge.locatenew("E", l * axes.y)
    rod = RigidBody("bar", center, axes, m, (inertia(axes, m * l**2 / 12, 0, m * l**2 / 12), center))
    cut = FreeBody(rod, [Force(center, -m * g * ground.y)], [Force(hinge, A_x * ground.x + A_y * ground.y)])
    points = {"G": center, "A": hinge, "E": end, "O": origin}
    balances = {name: moment_balance(cut, point, ground) for name, point in points.items()}
    a_G = center.pos_from(origin).dt(ground).dt(ground)
    forces = {"A_x": m * a_G.dot(ground.x), "A_y": m * a_G.dot(ground.y) + m * g}
    return balances, sm.solve(balances["A"].equation[2], theta.diff().diff())[0], forces


def bar_balance(state: Mapping[str, Any]) -> dict[str, Any]:
    """Return the moments, dH/dt and the extra term of the chosen point [N m], counter-clockwise, and θ̈ [rad/s²]."""
    balances, acceleration, forces = _bar_balances()
    values = {**BAR, "x_b": state["x_b"], "x_b_d": 0.0, "x_b_dd": state["x_b_dd"]}
    values |= {"theta": state["theta"], "theta_d": state["theta_d"]}
    values["theta_dd"] = number_at(acceleration, values)
    values |= {name: number_at(force, values) for name, force in forces.items()}
    about = balances[state["about"]]
    vectors = {"moments": about.moments, "rate": about.rate_of_change, "extra": about.extra}
    found = {name: float(components(vector, about.axes, values)[2]) for name, vector in vectors.items()}
    return {
        **found,
        "theta_dd": values["theta_dd"],
        "kind": about.kind,
        "hinge": (values["A_x"], values["A_y"]),
    }


def _draw_bar(figure: Figure, state: Mapping[str, Any], result: Mapping[str, Any]) -> None:
    left, right = beside(figure, 0.55)
    lean, l = state["theta"], BAR["l"]
    foot = np.array([state["x_b"], 0.0])
    up = np.array([-math.sin(lean), math.cos(lean)])
    places = {"G": foot + l / 2 * up, "A": foot, "E": foot + l * up, "O": np.zeros(2)}
    drawn: list[sh.Shape] = [
        sh.Ground((-1.2, -0.2), (1.2, -0.2)),
        sh.Box((foot[0], -0.08), (0.5, 0.14)),
        *(sh.Disc((foot[0] + x, -0.16), 0.04) for x in (-0.16, 0.16)),
        sh.Box(tuple(places["G"]), (0.06, l), angle=lean),
        *(sh.Pin(tuple(place), f"${name}$") for name, place in places.items()),
        sh.ForceArrow(tuple(places["G"]), tuple(places["G"] - [0.0, 0.3]), "$m\\,g$"),
        sh.Disc(tuple(places[state["about"]]), 0.07, role="ground"),
    ]
    force = 0.3 / (BAR["m"] * BAR["g"]) * np.array(result["hinge"])
    drawn.append(sh.VectorArrow(tuple(foot - force), tuple(foot), "hinge", role="reaction"))
    push = 0.03 * state["x_b_dd"]
    start = (foot[0] + math.copysign(0.3, push), -0.08)
    drawn.append(sh.VectorArrow(start, (start[0] + push, -0.08), r"$\ddot x_b$", role="acceleration"))
    sketch(drawn, f"A bar on a cart; moments are taken about the {POINTS[state['about']]}.", left)
    heights = {r"$\Sigma M$": result["moments"], r"$\dot H$": result["rate"], "extra": result["extra"]}
    bars(right, heights, "moment [N m]")


def _tell_bar(state: Mapping[str, Any], result: Mapping[str, Any]) -> str:
    moments, rate, extra = (number(round(result[name], 6)) for name in ("moments", "rate", "extra"))
    text = (
        f"About the {POINTS[state['about']]} the moments are {moments} N m and dH/dt is {rate} N m; θ̈ is "
        f"{number(result['theta_dd'])} rad/s² whatever the point."
    )
    if result["kind"] == "accelerating point":
        return f"{text} The point accelerates: the extra term is {extra} N m."
    why = "it is the mass center" if state["about"] == "G" else "the point is fixed"
    return f"{text} There is no extra term: {why}."


def _bar_lines(state: Mapping[str, Any]) -> list[str]:
    return [
        "import sympy as sm",
        "from sympy.physics.mechanics import Force, Point, ReferenceFrame, RigidBody, dynamicsymbols, inertia",
        'x_b, theta = dynamicsymbols("x_b theta")',
        'A_x, A_y, m, l, g = sm.symbols("A_x A_y m l g")',
        'N, B, O = ReferenceFrame("N"), ReferenceFrame("B"), Point("O")',
        "B.orient_axis(N, theta, N.z)",
        "O.set_vel(N, 0)",
        'A = O.locatenew("A", x_b * N.x)',
        'G, E = A.locatenew("G", l / 2 * B.y), A.locatenew("E", l * B.y)',
        'rod = RigidBody("bar", G, B, m, (inertia(B, m * l**2 / 12, 0, m * l**2 / 12), G))',
        "bar = ed.FreeBody(rod, [Force(G, -m * g * N.y)], [Force(A, A_x * N.x + A_y * N.y)])",
        f"balance = ed.moment_balance(bar, {state['about']}, N)",
        "print(balance, balance.extra)",
        f'ed.plots.free_body(bar, {{"theta": {state["theta"]}, "l": {BAR["l"]}}}, frame=N)',
    ]


_BAR = (
    Choice(
        "about",
        tuple((meaning, name) for name, meaning in POINTS.items()),
        "A",
        "reference point of the moments",
    ),
    Slider("theta", -1.5, 1.5, 0.45, "rad", "lean of the bar, counter-clockwise", 0.05),
    Slider("theta_d", -4.0, 4.0, 1.0, "rad/s", "rate of the lean", 0.25),
    Slider("x_b", -0.8, 0.8, 0.35, "m", "place of the cart", 0.05),
    Slider("x_b_dd", -10.0, 10.0, 4.0, "m/s^2", "acceleration of the cart, to the right", 0.5),
)

BAR_ON_CART = Scene("Bar on a cart", _BAR, bar_balance, _draw_bar, _tell_bar, _bar_lines)
