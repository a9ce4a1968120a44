"""Explorer of inertia tensors: one mass on a bent arm, a disc askew on its shaft (chapter 2)."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

from engdyn import shapes as sh
from engdyn.modeling.inertia import inertia_tensor, rotate_tensor
from engdyn.plots.drawing import sketch
from engdyn.plots.inertia_pictures import inertia_terms
from engdyn.plots.projection import View
from engdyn.plots.words import number
from engdyn.solids import cylinder
from engdyn.widgets.controls import Choice, Slider
from engdyn.widgets.scenes import Scene, SceneExplorer, bars, beside, size_of

__all__ = ["InertiaExplorer", "inertia"]

RADIUS, MASS = 0.15, 2.0
"""Radius [m] and mass [kg] of the disc."""

AXES = "xyz"


# Section 2.10


def mass_moments(state: Mapping[str, Any]) -> dict[str, NDArray[np.float64]]:
    """Return the tensor of 1 kg at (x, y, z) [kg m²], and the moments [N m] for a unit motion about x.

    The motion is an angular acceleration of 1 rad/s², or an angular velocity of 1 rad/s.
    """
    place = [state[axis] for axis in AXES]
    tensor, unit = inertia_tensor([1.0], [place]), np.array([1.0, 0.0, 0.0])
    steady = state["motion"] == "velocity"
    return {"tensor": tensor, "moments": np.cross(unit, tensor @ unit) if steady else tensor @ unit}


def _draw_mass(figure: Figure, state: Mapping[str, Any], result: Mapping[str, Any]) -> None:
    left, right = beside(figure, 0.62)
    place = [state[axis] for axis in AXES]
    inertia_terms(place, about=state["about"], motion=state["motion"], ax=left)
    bars(right, dict(zip(("$M_x$", "$M_y$", "$M_z$"), result["moments"], strict=True)), "moment [N m]")


def _tell_mass(state: Mapping[str, Any], result: Mapping[str, Any]) -> str:
    moments = ", ".join(
        f"M_{axis} = {number(float(m))}" for axis, m in zip(AXES, result["moments"], strict=True)
    )
    asked = "turning at 1 rad/s" if state["motion"] == "velocity" else "for 1 rad/s² about x"
    across = [abs(m) > 1e-12 for m in result["moments"][1:]]
    hold = (
        "nothing to hold against across the shaft"
        if not any(across)
        else "the moments across the shaft load its bearings"
    )
    return f"A mass of 1 kg {asked} needs {moments} N m: {hold}."


def _mass_lines(state: Mapping[str, Any]) -> list[str]:
    place = [state[axis] for axis in AXES]
    return [
        f"print(ed.inertia_tensor([1.0], [{place}]))",
        f'ed.plots.inertia_terms({place}, about="{state["about"]}", motion="{state["motion"]}")',
    ]


# Section 2.9


def askew(state: Mapping[str, Any]) -> dict[str, Any]:
    """Return ω [rad/s], H [kg m²/s] and the moment of the bearings [N m] in shaft axes, and the lean of H [rad]."""
    skew, thickness = state["skew"], state["thickness"]
    c, s = math.cos(skew), math.sin(skew)
    to_shaft = np.array([[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]])  # the disc turned by the skew about x
    tensor = rotate_tensor(cylinder(MASS, RADIUS, thickness), to_shaft)
    omega = np.array([0.0, 0.0, state["omega"]])
    momentum = tensor @ omega
    lean = math.atan2(
        -momentum[1], momentum[2]
    )  # positive to the side of the axis of the disc for positive skew
    return {
        "omega": omega,
        "momentum": momentum,
        "moment": np.cross(omega, momentum),
        "lean": lean,
        "disc": to_shaft,
    }


def _draw_askew(figure: Figure, state: Mapping[str, Any], result: Mapping[str, Any]) -> None:
    left, right = beside(figure, 0.55)
    across, face, axle = map(tuple, result["disc"].T)
    half = 0.8 / RADIUS * state["thickness"] / 2.0  # the radius is drawn as 0.8
    layers = np.linspace(-1.0, 1.0, 2 + round(state["thickness"] / 0.04))
    h = result["momentum"] / size_of(result["momentum"]) * 1.4
    rim = [
        (size_of(h[:2]) * math.sin(a), size_of(h[:2]) * math.cos(a), h[2])
        for a in np.linspace(0, math.tau, 61)
    ]
    moment = result["moment"] / (size_of(result["moment"]) or 1.0) * 0.9
    origin = (0.0, 0.0, 0.0)
    drawn = [
        sh.Link((0.0, 0.0, -1.1), origin),
        *(sh.Disc(tuple(k * half * np.array(axle)), 0.8, x_axis=across, y_axis=face) for k in layers),
        sh.Link(tuple(half * np.array(axle)), (0.0, 0.0, 1.1)),
        sh.CenterLine(origin, tuple(1.5 * np.array(axle)), "disc axis"),
        sh.Curve(tuple(rim), role="momentum"),
        sh.VectorArrow(origin, (0.0, 0.0, 1.6), r"$\omega$", double=True),
        sh.VectorArrow(origin, tuple(h), "$H$", double=True, role="momentum"),
        sh.VectorArrow(origin, tuple(moment), "$M$", double=True, role="force"),
    ]
    sketch(
        drawn,
        "A disc askew on its shaft, with ω, H and the moment of the bearings.",
        left,
        view=View(0.25, 0.3),
    )
    angles = {"disc axis": math.degrees(state["skew"]), "$H$": math.degrees(result["lean"])}
    bars(right, angles, "angle from the shaft [°]")


def _tell_askew(state: Mapping[str, Any], result: Mapping[str, Any]) -> str:
    moment = size_of(result["moment"])
    if moment < 1e-9 * size_of(result["momentum"]) * state["omega"]:
        return (
            "H lies along ω, the shaft is a principal axis of the disc: the bearings have no moment to carry."
        )
    side = "toward" if result["lean"] * state["skew"] > 0.0 else "away from"
    return (
        f"H leans {math.degrees(abs(result['lean'])):.2f}° from ω, {side} the axis of the disc, which leans "
        f"{math.degrees(abs(state['skew'])):.2f}°; the bearings carry a turning moment of {number(moment)} N m."
    )


def _askew_lines(state: Mapping[str, Any]) -> list[str]:
    return [
        "import numpy as np",
        f"c, s = np.cos({state['skew']}), np.sin({state['skew']})",
        f"tensor = ed.rotate_tensor(ed.solids.cylinder({MASS}, {RADIUS}, {state['thickness']}), "
        "np.array([[1, 0, 0], [0, c, -s], [0, s, c]]))",
        f"omega = np.array([0, 0, {state['omega']}])",
        "print(tensor @ omega, np.cross(omega, tensor @ omega))",
        "arrow, shaft = ed.shapes.VectorArrow, (0, 0, 0.15)",
        "H = tensor @ omega / np.linalg.norm(tensor @ omega) * 0.15",
        'ed.plots.sketch([arrow((0, 0, 0), shaft, "ω"), arrow((0, 0, 0), tuple(H), "H", role="momentum")], "ω and H.")',
    ]


_MASS = (
    Choice("about", tuple((f"about {axis}", axis) for axis in AXES), "y", "axis of the moment that is explained"),
    Choice(
        "motion",
        (("starts to turn (α)", "acceleration"), ("turns evenly (ω)", "velocity")),
        "acceleration",
        "motion of the shaft, which lies along x",
    ),
    Slider("x", -1.0, 1.0, 0.8, "m", "place of the mass along the shaft", 0.1),
    Slider("y", 0.1, 1.0, 0.6, "m", "place of the mass across the shaft", 0.1),
    Slider("z", -1.0, 1.0, 0.5, "m", "place of the mass across the shaft", 0.1),
)  # fmt: skip
_ASKEW = (
    Slider("skew", -1.5, 1.5, 0.4, "rad", "angle between the axis of the disc and the shaft", 0.05),
    Slider("thickness", 0.02, 0.45, 0.02, "m", "thickness of the disc, of radius 0.15 m", 0.01),
    Slider("omega", 10.0, 320.0, 100.0, "rad/s", "angular velocity of the shaft", 10.0),
)


class InertiaExplorer(SceneExplorer):
    """See `inertia`."""

    title = "Inertia"
    scenes = {
        "mass": Scene("One mass on a bent arm", _MASS, mass_moments, _draw_mass, _tell_mass, _mass_lines),
        "disc": Scene("Disc askew on its shaft", _ASKEW, askew, _draw_askew, _tell_askew, _askew_lines),
    }


def inertia(scene: str = "mass", **values: Any) -> InertiaExplorer:
    """Explore what moments and products of inertia mean, and why H need not point along ω.

    Course sections 2.9 and 2.10.

    Parameters
    ----------
    scene : {"mass", "disc"}
        One mass on a bent arm (2.10), a disc askew on its shaft (2.9).
    **values : float or str
        Controls of the scene to start from [SI].

    Returns
    -------
    InertiaExplorer

    Raises
    ------
    EngdynError
        An unknown scene or control, a value that its slider does not reach.
    """
    return InertiaExplorer(scene=scene, **values)
