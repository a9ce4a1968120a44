"""Pictures of kinematics: how a vector changes, chains of position vectors, terms of an acceleration."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import ArrayLike, NDArray
from sympy.physics.vector import ReferenceFrame

from engdyn import shapes as sh
from engdyn.errors import EngdynError
from engdyn.modeling.instants import components, rotation_matrix
from engdyn.plots.drawing import sketch, structure
from engdyn.plots.projection import View
from engdyn.plots.words import number

if TYPE_CHECKING:
    from engdyn.modeling.kinematic_chain import KinematicChain
    from engdyn.modeling.kinematics import AccelerationTerms

__all__ = ["acceleration_terms", "kinematic_chain", "orientations", "vector_change"]

TERMS = {
    "base": r"$a_{base}$",
    "tangential": r"$\alpha\times r$",
    "centripetal": r"$\omega\times(\omega\times r)$",
    "coriolis": r"$2\,\omega\times v_{rel}$",
    "relative": r"$a_{rel}$",
    "total": r"$a$",
}
"""What is written at the arrow of each term."""


def vector_change(
    before: ArrayLike,
    after: ArrayLike,
    ax: Axes | None = None,
    *,
    labels: tuple[str, str, str] = (r"$r(t)$", r"$r(t+\Delta t)$", r"$\Delta r$"),
) -> Axes:
    """Draw a vector before and after a change, and the change along and across the vector.

    Course section 1.1: what lies along changes the length, what lies across changes the direction.

    Parameters
    ----------
    before, after : array_like, shape (2,)
        Components in the plane.
    ax : matplotlib.axes.Axes, optional
        Where to draw; default: new axes.
    labels : (str, str, str)
        What is written at the two vectors and at their difference.

    Returns
    -------
    matplotlib.axes.Axes

    Raises
    ------
    EngdynError
        Not two plane vectors, or `before` has no length.
    """
    first, second = _plane(before, "before"), _plane(after, "after")
    length = float(np.linalg.norm(first))
    if not length:
        raise EngdynError("vector_change: `before` is zero and has no direction; give a vector with length.")
    change = second - first
    along = first * (change @ first) / length**2
    corner, across = first + along, change - along
    angles = [math.atan2(v[1], v[0]) for v in (first, second)]
    turn = (angles[1] - angles[0] + math.pi) % (2 * math.pi) - math.pi
    outward = along if along @ along else first  # the side of the change on which nothing else is drawn
    beyond = -across if across @ across else np.array([first[1], -first[0]])
    shapes: list[sh.Shape] = [
        sh.VectorArrow((0.0, 0.0), tuple(first), labels[0], role="position"),
        sh.VectorArrow((0.0, 0.0), tuple(second), labels[1], role="position"),
        sh.VectorArrow(tuple(first), tuple(corner), role="reaction"),
        sh.Label(tuple((first + corner) / 2), r"$\Delta r_{\parallel}$", tuple(beyond), "reaction"),
        sh.VectorArrow(tuple(corner), tuple(second), role="force"),
        sh.Label(tuple((corner + second) / 2), r"$\Delta r_{\perp}$", tuple(outward), "force"),
        sh.VectorArrow(tuple(first), tuple(second), role="velocity"),
        sh.Label(tuple((first + second) / 2), labels[2], tuple(-outward), "velocity"),
    ]
    if abs(turn) > 0.02:
        shapes.append(
            sh.AngleArrow((0.0, 0.0), 0.45 * length, angles[0], angles[0] + turn, r"$\Delta\theta$")
        )
    size = [number(float(x)) for x in (change @ first / length, np.linalg.norm(across))]
    words = (
        f"A vector of length {number(length)} before and one of length {number(float(np.linalg.norm(second)))} after a "
        f"change; the difference has the part {size[0]} along the vector and {size[1]} across it."
    )
    return sketch(shapes, words, ax)


def _plane(vector: ArrayLike, name: str) -> NDArray[np.float64]:
    try:
        found = np.asarray(vector, float)
    except (TypeError, ValueError):
        found = np.empty(0)
    if found.shape != (2,) or not np.all(np.isfinite(found)):
        raise EngdynError(f"vector_change: {name} is {vector!r}; give two finite components.")
    return found


def acceleration_terms(
    terms: AccelerationTerms,
    values: Mapping[Any, float],
    ground: ReferenceFrame,
    at: Sequence[float] = (0.0, 0.0),
    ax: Axes | None = None,
    *,
    background: Sequence[sh.Shape] = (),
    length: float = 0.2,
    head_to_tail: bool = False,
    view: View | None = None,
) -> Axes:
    """Draw the terms of an acceleration as arrows at the point, or head to tail with their sum.

    Course section 1.7.

    Parameters
    ----------
    terms : AccelerationTerms
    values : mapping
        Numbers for everything in the terms [SI].
    ground : ReferenceFrame
        X to the right and Y up in a plane picture.
    at : sequence of 2 or 3 floats
        Where the point is in the picture [m]; three coordinates make a picture in space.
    ax : matplotlib.axes.Axes, optional
        Where to draw; default: new axes.
    background : sequence of Shape
        What else is seen, for example ``system.shapes(q)``; what is written on it is left out.
    length : float
        Drawn length of the longest term [m].
    head_to_tail : bool
        Add the arrows up, with the total from the first tail to the last head.
    view : View, optional
        From where a picture in space is seen.

    Returns
    -------
    matplotlib.axes.Axes

    Raises
    ------
    EngdynError
        A number is missing, all terms are zero, or a term points out of a plane picture.
    """
    named = [*terms, ("total", terms.total)] if head_to_tail else list(terms)
    arrows = {name: components(term, ground, values) for name, term in named}
    sizes = {name: float(np.linalg.norm(arrow)) for name, arrow in arrows.items()}
    longest, count = max(sizes.values()), len(tuple(at))
    if not longest:
        raise EngdynError("acceleration_terms: all terms are zero at these values; there is nothing to draw.")
    if count == 2 and any(abs(arrow[2]) > 1e-9 * longest for arrow in arrows.values()):
        raise EngdynError(
            "acceleration_terms: a term points out of the plane; give `at` three coordinates for space."
        )
    start, shapes, ways = np.array(at, float), structure(background), []
    for name, arrow in arrows.items():
        if sizes[name] > 1e-9 * longest:
            tail = np.array(at, float) if name == "total" else start
            if count == 2 and not head_to_tail:  # side by side where two have one direction
                way = arrow[:2] / sizes[name]
                tail = tail + 0.07 * length * sum(float(way @ w) > 0.99 for w in ways) * np.array(
                    [way[1], -way[0]]
                )
                ways.append(way)
            tip = tail + arrow[:count] * length / longest
            role = "position" if name == "total" else "acceleration"
            shapes.append(sh.VectorArrow(tuple(tail), tuple(tip), TERMS[name], role=role))
            start = tip if head_to_tail else start
    told = ", ".join(f"{name} {number(size)} m/s²" for name, size in sizes.items())
    return sketch(shapes, f"Terms of the acceleration as arrows: {told}.", ax, view=view)


def kinematic_chain(
    chain: KinematicChain,
    values: Mapping[Any, float],
    ax: Axes | None = None,
    *,
    total: str | None = None,
    frames: bool = True,
    view: View | None = None,
) -> Axes:
    """Draw a chain of relative position vectors as a skeleton, with the unit vectors of its frames.

    Course sections 1.2 and 1.6.

    Parameters
    ----------
    chain : KinematicChain
    values : mapping
        Numbers for everything in the vectors and angles of the chain [SI].
    ax : matplotlib.axes.Axes, optional
        Where to draw; default: new axes.
    total : str, optional
        Name of the point to which the vector from the origin is drawn.
    frames : bool
        Draw the unit vectors of each frame at the point from which its first vector starts.
    view : View, optional
        From where a chain in space is seen; a chain in the XY plane is drawn in that plane.

    Returns
    -------
    matplotlib.axes.Axes

    Raises
    ------
    EngdynError
        A number is missing, or there is no such point.
    """
    ground = chain.ground
    places = {
        name: components(point.pos_from(chain.origin), ground, values) for name, point in chain.points.items()
    }
    turned = {name: rotation_matrix(frame, ground, values) for name, frame in chain.frames.items()}
    span = float(np.ptp(np.array(list(places.values())), axis=0).max()) or 1.0
    flat = all(abs(p[2]) < 1e-9 * span for p in places.values()) and all(
        abs(matrix[2, 2] - 1.0) < 1e-9 for matrix in turned.values()
    )
    size = 2 if flat else 3
    at = {name: tuple(p[:size]) for name, p in places.items()}
    shapes: list[sh.Shape] = [] if flat else _feet(places, span)
    if frames:
        shapes += _triads(chain, at, turned, 0.22 * span)
    for step in chain.steps:
        if step.kind == "point":
            label = f"$r_{{{step.start}{step.name}}}$"
            shapes.append(sh.VectorArrow(at[step.start], at[step.name], label, role="position"))
    if total is not None:
        end = at[str(chain.point(total))]
        label = f"$r_{{{chain.origin}{total}}}$"
        shapes.append(sh.VectorArrow(at[str(chain.origin)], end, label, role="coordinate"))
    shapes += [sh.Pin(place, f"${name}$") for name, place in at.items()]
    told = "; ".join(f"{name} at ({', '.join(number(x) for x in p)}) m" for name, p in places.items())
    return sketch(shapes, f"Chain of relative position vectors: {told}.", ax, view=view)


def _triads(
    chain: KinematicChain, at: Mapping[str, tuple], turned: Mapping[str, NDArray], length: float
) -> list[sh.Shape]:
    """Unit vectors of every frame, where the first vector that is written in it starts."""
    homes = {str(chain.ground): str(chain.origin)}
    for step in chain.steps:
        if step.kind == "point":
            for _, frame in step.vector.args:
                homes.setdefault(str(frame), step.start)
    size = len(at[str(chain.origin)])
    found: list[sh.Shape] = []
    for name, home in homes.items():
        letter = name.lower()
        labels = tuple(f"${letter}_{axis}$" for axis in "xyz")
        axes = tuple(tuple(column[:size]) for column in turned[name].T[:size])
        role = "reference" if name == str(chain.ground) else "coordinate"
        found.append(sh.Triad(at[home], axes, labels, length, role))
    return found


def _feet(places: Mapping[str, NDArray], span: float) -> list[sh.Shape]:
    """Plumb lines down to the ground, and the way there: a picture in space needs them to be read."""
    found: list[sh.Shape] = []
    for place in places.values():
        foot = (place[0], place[1], 0.0)
        if abs(place[2]) > 0.02 * span:
            found.append(sh.CenterLine(tuple(place), foot))
        if math.hypot(place[0], place[1]) > 0.02 * span:
            found.append(sh.CenterLine((0.0, 0.0, 0.0), foot))
    return found


def orientations(
    rows: Sequence[Sequence[tuple[str, ArrayLike]]],
    words: str,
    ax: Axes | None = None,
    *,
    size: tuple[float, float, float] = (1.0, 0.7, 0.2),
    view: View | None = None,
) -> Axes:
    """Draw a box in several orientations, row by row: what successive rotations do to it.

    Course section 1.6: finite rotations do not add.

    Parameters
    ----------
    rows : sequence of rows, each a sequence of (step, array of shape (3, 3))
        Rotation matrices whose columns are the axes of the box; the name of a step is written at the arrow
        that leads to its box (not used for the first of a row).
    words : str
        The picture in a sentence or two, for readers who cannot see it.
    ax : matplotlib.axes.Axes, optional
        Where to draw; default: new axes.
    size : (float, float, float)
        Edges of the box along its own axes.
    view : View, optional
        From where it is seen.

    Returns
    -------
    matplotlib.axes.Axes

    Raises
    ------
    EngdynError
        A matrix that is not a rotation.
    """
    seen = View() if view is None else view
    right, up, _ = seen.axes
    unit = max(size)
    shapes: list[sh.Shape] = []
    for i, row in enumerate(rows):
        for j, (step, matrix) in enumerate(row):
            turn = np.asarray(matrix, float)
            if turn.shape != (3, 3) or not np.allclose(turn.T @ turn, np.eye(3), atol=1e-6):
                raise EngdynError(f"orientations: box {j + 1} of row {i + 1} has no rotation matrix.")
            center = 3.2 * unit * j * right - 2.2 * unit * i * up
            axes = tuple(tuple(column) for column in turn.T)
            shapes.append(sh.Box(tuple(center), size, axes=axes))
            shapes.append(sh.Triad(tuple(center), axes, ("$1$", "$2$", "$3$"), 0.85 * unit, "coordinate"))
            if j:
                tail, tip = center - 2.05 * unit * right, center - 1.15 * unit * right
                shapes.append(sh.VectorArrow(tuple(tail), tuple(tip), role="reference"))
                shapes.append(sh.Label(tuple((tail + tip) / 2), step, (0.0, -1.0), "reference"))
    return sketch(shapes, words, ax, view=seen)
