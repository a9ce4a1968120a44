"""Pictures of a report, as figures with an embedded PNG and its alternative text."""

from __future__ import annotations

import base64
import html
from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes

from engdyn.errors import EngdynError
from engdyn.plots.alternative import alt, png
from engdyn.plots.drawing import draw
from engdyn.plots.energy import effective_potential, potential_energy
from engdyn.plots.equilibria import branches, equilibrium_poses
from engdyn.plots.look import new_axes
from engdyn.quantities import Parameter
from engdyn.system import System

__all__ = ["branch_figure", "branch_question", "drawing_figure", "figure", "poses_figure", "potential_figure"]

DPI = 110
"""Resolution of the pictures."""

CROWD = 8
"""More poses than these on top of each other nobody can tell apart."""

SAMPLES = (0.5, 0.7, 1.4, 2.0)
"""Multiples of a parameter's default at which equilibria are compared with those at the default."""


def figure(ax: Axes, caption: str) -> str:
    """A picture with its caption; both the picture and its words travel inside the file."""
    data = base64.b64encode(png(ax, DPI)).decode("ascii")
    words = html.escape(alt(ax), quote=True)
    width = round(ax.get_figure(root=True).get_figwidth() * 96)
    image = f'<img src="data:image/png;base64,{data}" width="{width}" alt="{words}">'
    return f"<figure>{image}<figcaption>{html.escape(caption)}</figcaption></figure>"


def drawing_figure(system: System) -> str:
    """The system as drawn from its own parameters; empty where it has no drawing."""
    try:
        ax = draw(system)
    except EngdynError:
        return ""
    return figure(ax, "The system with its coordinates, parameters and inputs.")


def poses_figure(system: System, found: Sequence[Any], verdicts: Sequence[str]) -> str:
    """All equilibria on one drawing; of a crowd, those that are stable."""
    shown = list(zip(found, verdicts, strict=True))
    caption = "All equilibria on top of each other: stable ones in full lines, unstable ones broken."
    if len(shown) > CROWD:
        shown = [(state, verdict) for state, verdict in shown if verdict == "asymptotically stable"] or shown
        caption = f"The {len(shown)} stable ones of {len(found)} equilibria, on top of each other."
    try:
        ax = equilibrium_poses(system, [s for s, _ in shown], judged=[v for _, v in shown])
    except EngdynError:
        return ""
    return figure(ax, caption if len(found) > 1 else "The system in its equilibrium.")


def potential_figure(system: System, found: Sequence[Any]) -> str:
    """The potential over the one or two coordinates on which it depends most; empty where there is none."""
    values = system.values()
    try:
        energy, name = effective_potential(system, values)
    except EngdynError:  # it depends on time
        return ""
    if not all(_is_stationary(energy, e.q) for e in found):  # something else acts: a drive, an acceleration
        return ""
    over = _coordinates_of(system, energy, found)[:2]
    if not over:
        return ""
    ax = potential_energy(system, None, over[0], over[1] if len(over) > 1 else None, list(found), new_axes())
    what = "potential energy" if "T" not in name else "effective potential, the centrifugal part included"
    others = "" if len(system.coordinates) <= len(over) else ", the other coordinates as in equilibrium 1"
    if not any(c.bounds is not None and c.name not in over for c in system.coordinates):
        others = ""
    return figure(ax, f"The {what}{others}: equilibria are its stationary points, stable ones its wells.")


def _is_stationary(energy: Any, q: np.ndarray) -> bool:
    """Whether the energy is stationary at a pose, by differences."""
    steps = 1e-4 * np.eye(len(q))
    slopes = np.array([float(energy(q + step) - energy(q - step)) for step in steps]) / 2e-4
    curvatures = np.array([float(energy(q + s) - 2 * energy(q) + energy(q - s)) for s in steps]) / 1e-8
    return bool(np.all(np.abs(slopes) <= 1e-5 * (np.max(np.abs(curvatures)) + 1e-9)))


def _coordinates_of(system: System, energy: Any, found: Sequence[Any]) -> list[str]:
    """Names of the coordinates on which the energy depends, near the first equilibrium."""
    from engdyn.plots.axes import coordinate_range

    held = np.array(found[0].q if len(found) else np.zeros(len(system.coordinates)), dtype=float)
    names = []
    for i, coordinate in enumerate(system.coordinates):
        poses = np.tile(held, (7, 1))
        poses[:, i] = np.linspace(*coordinate_range(coordinate), 7)
        heights = energy(poses)
        if np.ptp(heights) > 1e-12 * (1.0 + np.max(np.abs(heights))):
            names.append(coordinate.name)
    return names


def branch_question(system: System) -> tuple[Parameter, bool] | None:
    """The parameter to vary, and whether it changes number or stability of the equilibria.

    The first parameter that does so between half and twice its default; else the one that moves them most.
    """
    start = _census(system, {})
    moved: list[tuple[float, int]] = []
    for i, parameter in enumerate(system.parameters):
        if parameter.default == 0:
            continue
        furthest = 0.0
        for factor in SAMPLES:
            census = _census(system, {parameter.name: factor * parameter.default})
            if census is None or start is None:
                continue
            if census[0] != start[0]:
                return parameter, True
            furthest = max(furthest, float(np.max(np.abs(census[1] - start[1]), initial=0.0)))
        moved.append((furthest, -i))
    return (system.parameters[-max(moved)[1]], False) if moved else None


def _census(system: System, changes: dict[str, float]) -> tuple[tuple[str, ...], np.ndarray] | None:
    """Verdicts and places of all equilibria; None where the parameters do not make sense together."""
    from engdyn.plots.equilibria import verdicts

    try:
        found = system.equilibria(system.values(**changes))
        widths = np.array([np.ptp(c.bounds) if c.bounds is not None else 1.0 for c in system.coordinates])
        places = np.array([e.q / widths for e in found]).reshape(-1, len(system.coordinates))
        return tuple(verdicts(system, found)), places
    except EngdynError:
        return None


def branch_figure(system: System, parameter: Parameter) -> str:
    """Equilibria over one parameter, from half to twice its default."""
    low, high = sorted((0.5 * parameter.default, 2.0 * parameter.default))
    try:
        found = system.branches(parameter.name, (low, high))
    except EngdynError:
        return ""
    if not len(found):
        return ""
    spread = np.ptp(np.vstack([b.q for b in found]), axis=0)
    widths = [np.ptp(c.bounds) if c.bounds is not None else 1.0 for c in system.coordinates]
    coordinate = system.coordinates[int(np.argmax(spread / np.array(widths)))]
    ax = branches(found, coordinate.name, new_axes(), system=system)
    caption = f"Equilibria over {parameter.name} ({parameter.meaning}), from half to twice its default."
    return figure(ax, caption)
