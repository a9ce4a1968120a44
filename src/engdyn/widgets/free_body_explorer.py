"""Explorer of free-body diagrams: one body of any system, cut free, with live values of its loads (chapter 2)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray
from sympy.physics.mechanics import Force
from sympy.physics.vector import Vector, dynamicsymbols

from engdyn.modeling.free_body import FreeBody, load_vector
from engdyn.modeling.instants import components, key_name, number_at
from engdyn.modeling.numbers import input_values
from engdyn.plots.drawing import shown_pose
from engdyn.plots.free_body_diagram import free_body as diagram
from engdyn.plots.projection import View
from engdyn.plots.stage import size_of
from engdyn.plots.words import number
from engdyn.system import System
from engdyn.widgets.controls import Choice, Control, Slider
from engdyn.widgets.pose_explorer import coordinate_slider
from engdyn.widgets.scenes import bars, beside
from engdyn.widgets.system_explorer import SystemExplorer

if TYPE_CHECKING:
    from engdyn.modeling.equations import EquationsOfMotion

__all__ = ["FreeBodyExplorer", "Loads", "free_body", "loads_at"]

FASTEST = {"rad": 10.0, "m": 3.0}
"""Limits of the rates of coordinates [rad/s, m/s]."""


@dataclass(frozen=True)
class Loads:
    """Loads on one body at one instant: reactions by name [N, N m], resultant forces [N], all numbers."""

    reactions: Mapping[str, float]
    applied: NDArray[np.float64]
    reaction: NDArray[np.float64]
    values: Mapping[str, float]


@lru_cache(maxsize=8)
def _equations(system: System) -> EquationsOfMotion:
    """Newton's equations, derived once for a system that is moved by sliders."""
    return system.newton()


@lru_cache(maxsize=8)
def _bodies(system: System) -> dict[str, FreeBody]:
    return {body.name: body for body in system.free_bodies()}


def loads_at(system: System, body: FreeBody, q: Sequence[float], u: Sequence[float]) -> Loads:
    """Return the loads on a body of a system that moves freely through a state; inputs are zero or their defaults.

    Parameters
    ----------
    system : System
    body : FreeBody
        One of ``system.free_bodies()``.
    q, u : sequence of float
        Coordinates and speeds of ``system.newton()`` [SI].
    """
    equations, values = _equations(system), dict(system.complete(None))
    inputs = [f"{key_name(w)}{dots}" for w in equations.inputs for dots in ("", "_d", "_dd")]
    values |= dict(zip(inputs, input_values(equations, None, values), strict=True)) | {"t": 0.0}
    udot = equations.accelerations(q, u, system.complete(None))
    t = dynamicsymbols._t
    values |= {key_name(c): float(x) for c, x in zip(equations.coordinates, q, strict=True)}
    for speed, x, a in zip(equations.speeds, u, udot, strict=True):
        values |= {key_name(speed): float(x), key_name(speed.diff(t)): float(a)}
    for c, rate in zip(equations.coordinates, equations.kinematics, strict=True):
        for expression, name in ((rate, f"{key_name(c)}_d"), (rate.diff(t), f"{key_name(c)}_dd")):
            if name not in values:  # a rate that a constraint fixes
                values[name] = number_at(expression, values)
    names = {s.name for vector in map(load_vector, body.reactions) for s in vector.free_symbols(system.frame)}
    found = {s.name: number_at(e, values) for s, e in equations.reactions.items() if s.name in names}
    values |= found
    sums = [
        sum((f.force for f in loads if isinstance(f, Force)), Vector(0))
        for loads in (body.applied, body.reactions)
    ]
    applied, reaction = (components(total, system.frame, values) for total in sums)
    return Loads(found, applied, reaction, values)


class FreeBodyExplorer(SystemExplorer):
    """See `free_body`."""

    title = "Free body"
    structural = ("system", "body")

    def controls(self, chosen: Mapping[str, Any]) -> Sequence[Control]:
        choice = self.system_choice("system that is cut")
        if "system" not in chosen:
            return [choice]
        system = self.system(chosen["system"])
        names = list(_bodies(system))
        shown = (("all", "all"), ("known loads", "applied"), ("reactions", "reactions"))
        start = shown_pose(system)
        size = size_of(system.shapes(start), View())
        units = {key_name(c.symbol): c.unit for c in system.coordinates}
        rates = []
        for speed in _equations(system).speeds:
            unit = units.get(key_name(speed).removesuffix("_d"), "rad")
            reach = FASTEST[unit]
            rates.append(
                Slider(
                    key_name(speed), -reach, reach, 0.0, f"{unit}/s", f"speed {key_name(speed)}", reach / 40.0
                )
            )
        return [
            choice,
            Choice("body", tuple((name, name) for name in names), names[0], "body that is cut free"),
            Choice("loads", shown, "all", "loads that are drawn"),
            *map(coordinate_slider, system.coordinates, start.tolist(), [size] * len(start)),
            *rates,
        ]

    def _body(self, state: Mapping[str, Any]) -> FreeBody:
        return _bodies(self.system(state["system"]))[state["body"]]

    def _motion(self, state: Mapping[str, Any]) -> tuple[list[float], list[float]]:
        system = self.system(state["system"])
        q = [state[c.name] for c in system.coordinates]
        return q, [state[key_name(speed)] for speed in _equations(system).speeds]

    def model(self, state: Mapping[str, Any]) -> Loads:
        return loads_at(self.system(state["system"]), self._body(state), *self._motion(state))

    def draw_static(self, figure: Figure, state: Mapping[str, Any], result: Loads) -> None:
        left, right = beside(figure, 0.6)
        body, loads = self._body(state), state["loads"]
        shown = FreeBody(
            body.body,
            body.applied if loads != "reactions" else (),
            body.reactions if loads != "applied" else (),
        )
        diagram(shown, result.values, left, frame=self.system(state["system"]).frame)
        if result.reactions:
            bars(
                right, {f"${name}$": value for name, value in result.reactions.items()}, "reactions [N, N m]"
            )
        else:
            bars(
                right,
                dict(zip(("$F_X$", "$F_Y$", "$F_Z$"), result.applied, strict=True)),
                "sum of forces [N]",
            )

    def caption(self, state: Mapping[str, Any]) -> str:
        return f"{self.system(state['system']).title}, {state['body']}"

    def words(self, state: Mapping[str, Any], result: Loads) -> str:
        told = ", ".join(f"{name} = {number(value)}" for name, value in result.reactions.items())
        pairs = (
            ("known forces", result.applied),
            ("reactions", result.reaction),
            ("m a", result.applied + result.reaction),
        )
        sums = ", ".join(
            f"{name} ({', '.join(number(float(f'{x:.4g}')) for x in vector)})" for name, vector in pairs
        )
        turned = [name for name, value in result.reactions.items() if value < -1e-9]
        against = f" Against its arrow: {', '.join(turned)}." if turned else ""
        return f"{f'Reactions {told}. ' if told else ''}Sums along X, Y, Z in N: {sums}.{against}"

    def lines(self, state: Mapping[str, Any]) -> list[str]:
        q, u = self._motion(state)
        system = self.system(state["system"])
        place = list(_bodies(system)).index(state["body"])
        geometry = {c.name: x for c, x in zip(system.coordinates, q, strict=True)}
        return [
            *self.loading(state),
            f"body = system.free_bodies()[{place}]",
            f"print(system.newton().accelerations({q}, {u}, values))",
            f"ed.plots.show(ed.plots.free_body(body, {{**values, **{geometry}}}, frame=system.frame))",
        ]


def free_body(system: str | int | System = "W1", **values: Any) -> FreeBodyExplorer:
    """Explore free-body diagrams: choose a body and its loads, move the system, and read the reactions.

    Course section 2.4. Controls: ``system``, ``body``, ``loads``, the coordinates and their rates by name. Inputs are
    zero, or as they are prescribed.

    Parameters
    ----------
    system : str, int or System
        A system by number, key or label, or a System of one's own.
    **values : float or str
        Controls to start from [SI].

    Returns
    -------
    FreeBodyExplorer

    Raises
    ------
    EngdynError
        A system without free bodies, a value that its slider does not reach; UnknownSystemError for a system that
        does not exist.
    """
    return FreeBodyExplorer(system, **values)
