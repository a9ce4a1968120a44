"""Pictures of spinning bodies: cones of a free body, paths on a sphere, a top, a bicycle.  Sections 2.11 to 2.14."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import ArrayLike, NDArray

from engdyn import shapes as sh
from engdyn.errors import EngdynError
from engdyn.plots.drawing import sketch
from engdyn.plots.projection import View

__all__ = ["bicycle", "gyroscope", "precession_cones", "sphere_paths"]

HUB, HEAD, BARS = (0.0, 0.0, 0.34), (-0.17, 0.0, 0.78), (-0.2, 0.0, 0.95)
REAR, CRANK, SEAT = (-1.02, 0.0, 0.34), (-0.6, 0.0, 0.28), (-0.72, 0.0, 0.84)

FRAME = (
    (REAR, CRANK, SEAT, REAR),
    (SEAT, HEAD, CRANK),
    (SEAT, (-0.73, 0.0, 0.92)),
    ((-0.84, 0.0, 0.92), (-0.62, 0.0, 0.92)),
)
FORK = ((HUB, HEAD, BARS), ((-0.24, -0.26, 0.95), BARS, (-0.24, 0.26, 0.95)))
"""Lines of a bicycle: what leans, and what is steered as well."""


def precession_cones(
    axis: ArrayLike,
    omega: ArrayLike,
    momentum: ArrayLike,
    half_axes: tuple[float, float] = (0.6, 1.0),
    view: View | None = None,
    ax: Axes | None = None,
) -> Axes:
    """Draw a body of revolution in free flight with H, ω and its axis, and the cones they trace about H.

    Course section 2.12; L. Poinsot, *Théorie nouvelle de la rotation des corps* (1834).

    Parameters
    ----------
    axis, omega, momentum : array_like, shape (3,)
        Symmetry axis, angular velocity and angular momentum at one instant; only directions are shown,
        Z is up.
    half_axes : (float, float)
        Half axes of the body, across and along its axis.
    view : View, optional
    ax : matplotlib.axes.Axes, optional
        Where to draw; default: new axes.

    Returns
    -------
    matplotlib.axes.Axes

    Raises
    ------
    EngdynError
        A vector without length or not finite.
    """
    view = view or View(-math.pi / 2.6, math.pi / 10)
    n, w, h = _unit(axis, "axis"), _unit(omega, "omega"), _unit(momentum, "momentum")
    across, along = half_axes
    reach = 1.75 * max(half_axes)
    between = [math.degrees(math.acos(np.clip(v @ h, -1.0, 1.0))) for v in (n, w)]
    drawn: list[sh.Shape] = [sh.Polygon(tuple(map(tuple, _outline(n, across, along, view))))]
    seams = [_seam(n, across, along, view, turn) for turn in (-0.5, 0.5)]
    drawn += [sh.Curve(tuple(map(tuple, seam)), role="joint") for seam in seams]
    for vector, role, length in ((n, "position", reach), (w, "velocity", 0.9 * reach)):
        rim = _rim(length * vector, h)
        drawn.append(sh.Curve(tuple(map(tuple, rim)), role=role))
        drawn += [sh.CenterLine((0.0, 0.0, 0.0), tuple(rim[i]), role=role) for i in (30, 60, 90)]
    drawn += [
        sh.VectorArrow((0.0, 0.0, 0.0), tuple(1.25 * reach * h), "$H$", double=True, role="momentum"),
        sh.VectorArrow((0.0, 0.0, 0.0), tuple(0.9 * reach * w), r"$\omega$", double=True, role="velocity"),
        sh.VectorArrow((0.0, 0.0, 0.0), tuple(reach * n), "axis", role="position"),
    ]
    words = (
        f"A body of revolution in free flight: its axis stands at {between[0]:.1f}° and the angular velocity at "
        f"{between[1]:.1f}° from the angular momentum H; both trace cones about H."
    )
    return sketch(drawn, words, ax, view=view)


def bicycle(
    lean: float = 0.0,
    steer: float = 0.0,
    extra: Sequence[sh.Shape] = (),
    words: str = "",
    view: View | None = None,
) -> Axes:
    """Draw a bicycle seen from behind on its right, with the angular momentum of the front wheel.

    Course section 2.14.  X points forward, Y to the left, Z up; the front wheel (radius 0.34 m) touches the
    road at the origin.

    Parameters
    ----------
    lean : float
        Lean to the right [rad].
    steer : float
        Steer to the right [rad].
    extra : sequence of Shape
        Further arrows, in meters.
    words : str
        Sentences to add to the text alternative.
    view : View, optional

    Returns
    -------
    matplotlib.axes.Axes

    Raises
    ------
    EngdynError
        An angle that is not finite or beyond a right angle.
    """
    if not max(abs(lean), abs(steer)) < math.pi / 2:
        raise EngdynError(
            f"bicycle: lean {lean!r} and steer {steer!r} are angles in rad below a right angle."
        )
    c, s = math.cos(lean), math.sin(lean)
    tilted = np.array([[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]])
    c, s = math.cos(steer), math.sin(steer)
    turned = tilted @ np.array([[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]])
    circle = [(0.34 * math.cos(a), 0.0, 0.34 * math.sin(a)) for a in np.linspace(0.0, 2.0 * math.pi, 61)]
    wheels = [tuple((x + center[0], 0.0, z + center[2]) for x, _, z in circle) for center in (HUB, REAR)]
    drawn = [
        sh.Curve(tuple(tuple(rotation @ np.array(point)) for point in line))
        for lines, rotation in (((*FORK, wheels[0]), turned), ((*FRAME, wheels[1]), tilted))
        for line in lines
    ]
    road = sh.Polygon(((-1.7, -0.7, 0.0), (0.9, -0.7, 0.0), (0.9, 0.7, 0.0), (-1.7, 0.7, 0.0)), role="ground")
    center = turned @ np.array(HUB)
    tip = center + 0.75 * turned[:, 1]
    spin = sh.VectorArrow(tuple(center), tuple(tip), "$H$", double=True, role="momentum")
    told = (
        f"A bicycle from behind, leaning {math.degrees(lean):.0f}° and steered {math.degrees(steer):.0f}° to the "
        f"right; the angular momentum of the front wheel points along its axle to the left. {words}"
    )
    return sketch([road, *drawn, spin, *extra], told.strip(), view=view or View(math.radians(-142), 0.36))


def gyroscope(
    nutation: float = 0.5,
    azimuth: float = 0.0,
    post: float = 0.0,
    words: str = "",
    view: View | None = None,
    ax: Axes | None = None,
) -> Axes:
    """Draw a top on its tip: its angular momentum, its weight, the moment of the weight, the precession.

    Course section 2.14. The tip is at the origin, the mass center at the distance 1.

    Parameters
    ----------
    nutation : float
        Angle of the axis from the upward vertical [rad]; pi/2 is a top that lies over.
    azimuth : float
        Direction to which it leans, counter-clockwise from X [rad].
    post : float
        Height of a post on which the tip stands; zero: on the floor.
    words : str
        Sentences to add to the text alternative.
    view : View, optional
    ax : matplotlib.axes.Axes, optional
        Where to draw; default: new axes.

    Returns
    -------
    matplotlib.axes.Axes

    Raises
    ------
    EngdynError
        An angle that is not between 0 and pi, a height below zero.
    """
    if not (0.0 < nutation < math.pi and math.isfinite(azimuth) and 0.0 <= post < math.inf):
        raise EngdynError(
            f"gyroscope: nutation {nutation!r} lies between 0 and pi, azimuth {azimuth!r} is finite, post {post!r} "
            "is not negative."
        )
    drawn = [*_top(nutation, azimuth, post), *_top_vectors(nutation, azimuth)]
    told = (
        f"A top whose axis leans {math.degrees(nutation):.0f}° from the vertical: its angular momentum H lies along "
        "the axis, the moment M of its weight is horizontal and square to it; H moves toward M, so the axis precesses "
        f"about the vertical at the rate Omega. {words}"
    )
    return sketch(drawn, told.strip(), ax, view=view)


def _top_axes(nutation: float, azimuth: float) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Unit vectors along the axis of a top, and level and square to it: where the moment of the weight points."""
    across = np.array([-math.sin(azimuth), math.cos(azimuth), 0.0])
    level = math.sin(nutation) * np.array([math.cos(azimuth), math.sin(azimuth), 0.0])
    return level + [0.0, 0.0, math.cos(nutation)], across


def _top(nutation: float, azimuth: float, post: float) -> list[sh.Shape]:
    """The body of a top with its spin, its tip and the floor below."""
    axis, across = _top_axes(nutation, azimuth)
    other, tip = np.cross(axis, across), (0.0, 0.0, 0.0)
    faces = {"x_axis": tuple(across), "y_axis": tuple(other)}
    return [
        sh.Disc((0.0, 0.0, -post), 0.8, role="ground"),
        *([sh.Link((0.0, 0.0, -post), tip)] if post else []),
        sh.Link(tip, tuple(0.92 * axis)),
        *(sh.Disc(tuple(along * axis), 0.6, **faces) for along in (0.92, 1.08)),
        sh.Curve((tuple(1.08 * axis), tuple(1.5 * axis)), role="joint"),
        sh.Pin(tip, "$O$"),
        sh.CenterLine(tip, (0.0, 0.0, 1.5)),
        sh.MomentArrow(tuple(1.3 * axis), 0.3, -2.4, 2.4, role="momentum", **faces),
    ]


def _top_vectors(nutation: float, azimuth: float) -> list[sh.Shape]:
    """Angular momentum, moment and what it adds, weight, precession."""
    axis, across = _top_axes(nutation, azimuth)
    tip, end = (0.0, 0.0, 0.0), 2.1 * axis
    added = tuple(end + 0.7 * across)
    return [
        sh.VectorArrow(tuple(1.5 * axis), tuple(end), "$H$", double=True, role="momentum"),
        sh.VectorArrow(tuple(end), added, r"$M\,\mathrm{d}t$", double=True, role="force"),
        sh.VectorArrow(tip, tuple(1.1 * across), "$M$", double=True, role="force"),
        sh.VectorArrow(tuple(axis), tuple(axis - [0.0, 0.0, 0.95]), "$m\\,g$", role="force"),
        sh.VectorArrow((0.0, 0.0, 1.5), (0.0, 0.0, 2.2), r"$\Omega$", double=True),
    ]


def sphere_paths(
    paths: Sequence[ArrayLike],
    labels: Sequence[str],
    words: str,
    view: View | None = None,
    ax: Axes | None = None,
) -> Axes:
    """Draw directions that change, as paths on a unit sphere, with three axes; the far side is not shown.

    Parameters
    ----------
    paths : sequence of array_like, shape (N, 3)
        Vectors; only their directions matter.
    labels : sequence of three str
        Names of the axes x, y, z.
    words : str
        The picture in a sentence or two.
    view : View, optional
    ax : matplotlib.axes.Axes, optional
        Where to draw; default: new axes.

    Returns
    -------
    matplotlib.axes.Axes

    Raises
    ------
    EngdynError
        A path of another shape or with a vector without direction, no words.
    """
    view = view or View(math.radians(35), math.radians(25))
    rim = [(math.cos(a), math.sin(a)) for a in np.linspace(0.0, 2.0 * math.pi, 121)[:-1]]
    drawn: list[sh.Shape] = [sh.Polygon(tuple(rim))]
    for axis, label in zip(np.eye(3), labels, strict=True):
        drawn.append(sh.CenterLine(tuple(axis), tuple(1.35 * axis), label, arrow=True))
    for k, path in enumerate(paths):
        points = np.asarray(path, float)
        lengths = np.linalg.norm(points, axis=1) if points.ndim == 2 and points.shape[1] == 3 else np.zeros(1)
        if not (np.all(np.isfinite(lengths)) and np.all(lengths > 0.0)):
            raise EngdynError(
                f"sphere_paths: path {k + 1} must be an array (N, 3) of vectors that have a direction."
            )
        points = points / lengths[:, None]
        role = ("momentum", "velocity", "acceleration", "coordinate")[k % 4]
        drawn += [sh.Curve(tuple(map(tuple, part)), role=role) for part in _near_side(points, view)]
    return sketch(drawn, words, ax, view=view)


def _unit(vector: ArrayLike, name: str) -> NDArray[np.float64]:
    found = np.asarray(vector, float)
    length = float(np.linalg.norm(found)) if found.shape == (3,) else 0.0
    if not 0.0 < length < math.inf:
        raise EngdynError(f"{name} is {vector!r}; give three finite numbers, not all zero.")
    return found / length


def _outline(n: NDArray, across: float, along: float, view: View) -> NDArray[np.float64]:
    """Silhouette of a spheroid, shape (N, 2): the ellipse whose shape matrix is the projected one."""
    shape = across**2 * np.eye(3) + (along**2 - across**2) * np.outer(n, n)
    flat = view.axes[:2] @ shape @ view.axes[:2].T
    angles = np.linspace(0.0, 2.0 * math.pi, 73)[:-1]
    return np.column_stack([np.cos(angles), np.sin(angles)]) @ np.linalg.cholesky(flat).T


def _seam(n: NDArray, across: float, along: float, view: View, turn: float) -> NDArray[np.float64]:
    """A meridian of the spheroid, `turn` rad from the middle of what the reader sees."""
    eye = view.axes[2] - (view.axes[2] @ n) * n
    side = (math.cos(turn) * eye + math.sin(turn) * np.cross(n, eye)) / np.linalg.norm(eye)
    angles = np.linspace(-0.4 * math.pi, 0.44 * math.pi, 41)[:, None]
    return across * np.cos(angles) * side + along * np.sin(angles) * n


def _rim(vector: NDArray, about: NDArray) -> NDArray[np.float64]:
    """Points of the circle that the tip of `vector` runs through about the direction `about`, (121, 3)."""
    high = (vector @ about) * about
    radius = vector - high
    angles = np.linspace(0.0, 2.0 * math.pi, 121)[:, None]
    return high + np.cos(angles) * radius + np.sin(angles) * np.cross(about, radius)


def _near_side(points: NDArray, view: View) -> list[NDArray[np.float64]]:
    """The parts of a path on the unit sphere that the eye sees, at least two points each."""
    seen = points @ view.axes[2] > 0.0
    cuts = np.flatnonzero(np.diff(seen)) + 1
    pieces = np.split(np.arange(len(points)), cuts)
    return [points[piece] for piece in pieces if len(piece) > 1 and seen[piece[0]]]
