"""Explorer of rotations in space: a manipulator, successive rotations, Euler angles (chapter 1)."""

from __future__ import annotations

import math
from collections.abc import Mapping
from functools import cache
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation
from sympy.physics.vector import dynamicsymbols

from engdyn import shapes as sh
from engdyn.modeling.instants import components, rotation_matrix
from engdyn.modeling.kinematic_chain import KinematicChain
from engdyn.plots.drawing import sketch, structure
from engdyn.plots.kinematic_pictures import orientations
from engdyn.plots.words import number
from engdyn.systems.library import load
from engdyn.widgets.controls import Choice, Slider
from engdyn.widgets.scenes import Scene, SceneExplorer, bars, beside, size_of, whole

__all__ = ["OrientationExplorer", "orientation"]

SHOULDER = 0.6
"""Height of the shoulder of the manipulator [m]."""

CHAIN = [
    "from sympy.physics.mechanics import dynamicsymbols",
    'psi, beta, r = dynamicsymbols("psi beta r")',
    'chain = ed.KinematicChain("N", origin="O")',
    'column = chain.turn("A", about=chain.ground.z, by=psi)',
    f'chain.move("S", {SHOULDER} * column.z)',
    'boom = chain.turn("B", about=column.y, by=-beta)',
    'chain.move("P", r * boom.x)',
]


# Section 1.5


@cache
def _manipulator() -> KinematicChain:
    psi, beta, r = dynamicsymbols("psi beta r")
    chain = KinematicChain("N", origin="O")
    column = chain.turn("A", about=chain.ground.z, by=psi)
    chain.move("S", SHOULDER * column.z)
    boom = chain.turn("B", about=column.y, by=-beta)
    chain.move("P", r * boom.x)
    return chain


@cache
def _boom_vectors() -> dict[str, Any]:
    chain = _manipulator()
    turning = chain.angular_motion("B")
    return {
        "velocity": chain.velocity("P", axes="B"),
        "acceleration": chain.acceleration("P", axes="B"),
        "omega": turning.angular_velocity,
        "alpha": turning.angular_acceleration,
    }


def _rates(state: Mapping[str, Any]) -> dict[str, float]:
    """Coordinates and rates; the rates are constant."""
    names = [f"{q}{dots}" for q in ("psi", "beta", "r") for dots in ("", "_d", "_dd")]
    return {name: float(state.get(name, 0.0)) for name in names}


def boom_motion(state: Mapping[str, Any]) -> dict[str, NDArray[np.float64]]:
    """Return v and a of the load, ω and α of the boom in boom axes, at constant rates, and the boom's axes [SI]."""
    chain, values = _manipulator(), _rates(state)
    found = {name: components(v, chain.frame("B"), values) for name, v in _boom_vectors().items()}
    return {**found, "axes": rotation_matrix(chain.frame("B"), chain.ground, values).T}


def _draw_boom(figure: Figure, state: Mapping[str, Any], result: Mapping[str, Any]) -> None:
    left, right = beside(figure, 0.6)
    machine, axes = load("W2"), result["axes"]
    shoulder = np.array([0.0, 0.0, SHOULDER])
    tip, scale = shoulder + state["r"] * axes[0], 0.4  # m of the picture for 1 m/s or 1 rad/s
    drawn = structure(machine.shapes([state["psi"], state["beta"], state["r"]], machine.values()))
    drawn.append(
        sh.Triad(tuple(shoulder), tuple(map(tuple, axes)), ("$b_x$", "$b_y$", "$b_z$"), 0.45, "coordinate")
    )
    for part, axis in zip(result["velocity"], axes, strict=True):
        drawn.append(sh.VectorArrow(tuple(tip), tuple(tip + scale * part * axis), role="force"))
    drawn.append(sh.VectorArrow(tuple(tip), tuple(tip + scale * result["velocity"] @ axes), "$v$"))
    turn = tuple(shoulder + scale * result["omega"] @ axes)
    drawn.append(sh.VectorArrow(tuple(shoulder), turn, r"$\omega$", double=True, role="momentum"))
    sketch(drawn, "The manipulator, the velocity of its load and the angular velocity of its boom.", left)
    bars(
        right,
        dict(zip(("$v_{bx}$", "$v_{by}$", "$v_{bz}$"), result["velocity"], strict=True)),
        "velocity [m/s]",
    )


def _tell_boom(state: Mapping[str, Any], result: Mapping[str, Any]) -> str:
    v, alpha = result["velocity"], result["alpha"]
    return (
        f"In boom axes the load moves with ({', '.join(map(number, v))}) m/s: extension r_d, sweep r cos β ψ_d, rise "
        f"r β_d. At these constant rates its acceleration is {number(size_of(result['acceleration']))} m/s² and the "
        f"angular acceleration of the boom {number(size_of(alpha))} rad/s², ψ_d β_d."
    )


def _boom_lines(state: Mapping[str, Any]) -> list[str]:
    return [
        *CHAIN,
        f"values = {_rates(state)}",
        'print(ed.components(chain.velocity("P"), boom, values))',
        'print(chain.angular_motion("B").in_axes(boom).evaluate(values))',
        "ed.plots.kinematic_chain(chain, values)",
    ]


# Section 1.6


def _turned(axes: str, angles: list[float]) -> NDArray[np.float64]:
    """Rotation matrix of successive rotations; small letters: about fixed axes, capitals: about moving ones."""
    return Rotation.from_euler(axes, angles).as_matrix()


def two_orders(state: Mapping[str, Any]) -> dict[str, Any]:
    """Return the boxes after each of two rotations about fixed axes, in both orders, and the angle between the ends."""
    first, second = ("z", state["about_z"]), ("x", state["about_x"])
    rows = []
    for one, two in ((second, first), (first, second)):
        both = _turned(one[0] + two[0], [one[1], two[1]])
        rows.append(
            [("", np.eye(3)), (f"about ${one[0]}$", _turned(one[0], [one[1]])), (f"about ${two[0]}$", both)]
        )
    gap = Rotation.from_matrix(rows[0][2][1].T @ rows[1][2][1]).magnitude()
    return {"rows": rows, "gap": float(gap)}


def _draw_rows(figure: Figure, state: Mapping[str, Any], result: Mapping[str, Any]) -> None:
    orientations(result["rows"], "A box after successive rotations.", whole(figure))


def _tell_orders(state: Mapping[str, Any], result: Mapping[str, Any]) -> str:
    product = state["about_x"] * state["about_z"]
    return (
        f"The two orders end {math.degrees(result['gap']):.2f}° apart; the product of the two angles is "
        f"{math.degrees(abs(product)):.2f}°, which the gap approaches when both are small."
    )


def euler_rotations(state: Mapping[str, Any]) -> dict[str, Any]:
    """Return the boxes after each Euler rotation and the determinant of rates → ω: zero where the angles fail."""
    axes, angles = state["sequence"], [state[name] for name in ("first", "second", "third")]
    row = [("", np.eye(3))]
    for k in range(3):
        name = f"{axes[k].lower()}{chr(39) * k}"
        row.append((f"about ${name}$", _turned(axes[: k + 1], angles[: k + 1])))
    unit = {"X": np.eye(3)[0], "Y": np.eye(3)[1], "Z": np.eye(3)[2]}
    about = [row[k][1] @ unit[axes[k]] for k in range(3)]
    return {"rows": [row], "determinant": float(np.linalg.det(np.array(about)))}


def _tell_euler(state: Mapping[str, Any], result: Mapping[str, Any]) -> str:
    matrix, determinant = result["rows"][0][-1][1], result["determinant"]
    end = f"Axis 3 of the box ends along ({', '.join(number(float(x)) for x in np.round(matrix[:, 2], 4))})."
    if abs(determinant) < 0.05:
        return (
            f"{end} Gimbal lock: the first and the third rotation have the same axis, one rotation is lost."
        )
    volume = number(round(abs(determinant), 4))
    return f"{end} The three axes of rotation span a volume of {volume}; at 0 one rotation is lost."


def _rotation_lines(state: Mapping[str, Any]) -> list[str]:
    if state["scene"] == "orders":
        steps = [f'rotation("xz", [{state["about_x"]}, {state["about_z"]}])']
        steps.append(f'rotation("zx", [{state["about_z"]}, {state["about_x"]}])')
    else:
        angles = [state[name] for name in ("first", "second", "third")]
        steps = [f'rotation("{state["sequence"][: k + 1]}", {angles[: k + 1]})' for k in range(3)]
    boxes = ", ".join(f'("", {step}.as_matrix())' for step in steps)
    return [
        "from scipy.spatial.transform import Rotation",
        "rotation = Rotation.from_euler",
        f'ed.plots.orientations([[{boxes}]], "A box after successive rotations.")',
    ]


_BOOM = (
    Slider("psi", -3.1, 3.1, 0.7, "rad", "yaw of the column", 0.1),
    Slider("beta", -1.4, 1.4, 0.5, "rad", "elevation of the boom", 0.05),
    Slider("r", 0.5, 2.0, 1.1, "m", "distance of the load from the shoulder", 0.05),
    Slider("psi_d", -2.0, 2.0, 1.0, "rad/s", "rate of yaw", 0.1),
    Slider("beta_d", -2.0, 2.0, 0.6, "rad/s", "rate of elevation", 0.1),
    Slider("r_d", -1.0, 1.0, 0.4, "m/s", "rate of extension", 0.05),
)
_ORDERS = (
    Slider("about_x", -3.1, 3.1, 1.5, "rad", "rotation about the fixed x axis", 0.1),
    Slider("about_z", -3.1, 3.1, 1.5, "rad", "rotation about the fixed z axis", 0.1),
)
_EULER = (
    Choice(
        "sequence",
        (("z, x′, z″: precession, nutation, spin", "ZXZ"), ("z, y′, x″: yaw, pitch, roll", "ZYX")),
        "ZXZ",
        "axes of the three rotations",
    ),
    Slider("first", -3.1, 3.1, 0.8, "rad", "angle of the first rotation", 0.1),
    Slider("second", -3.1, 3.1, 0.6, "rad", "angle of the second rotation", 0.1),
    Slider("third", -3.1, 3.1, 0.5, "rad", "angle of the third rotation", 0.1),
)


class OrientationExplorer(SceneExplorer):
    """See `orientation`."""

    title = "Orientation"
    scenes = {
        "manipulator": Scene("Three-axis manipulator", _BOOM, boom_motion, _draw_boom, _tell_boom, _boom_lines),
        "orders": Scene("Two rotations, both orders", _ORDERS, two_orders, _draw_rows, _tell_orders, _rotation_lines),
        "euler": Scene("Euler angles", _EULER, euler_rotations, _draw_rows, _tell_euler, _rotation_lines),
    }  # fmt: skip


def orientation(scene: str = "manipulator", **values: Any) -> OrientationExplorer:
    """Explore motion in space: a manipulator with its rates, rotations in both orders, Euler angles.

    Course sections 1.5 and 1.6.

    Parameters
    ----------
    scene : {"manipulator", "orders", "euler"}
        Three-axis manipulator (1.5); two finite rotations in both orders, Euler angles (1.6).
    **values : float or str
        Controls of the scene to start from [SI].

    Returns
    -------
    OrientationExplorer

    Raises
    ------
    EngdynError
        An unknown scene or control, a value that its slider does not reach.
    """
    return OrientationExplorer(scene=scene, **values)
