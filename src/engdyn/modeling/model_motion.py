"""The motion of a model in a ring of its own: what energies and virtual work need of points and frames."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

import sympy as sm
from sympy.physics.mechanics import Particle, RigidBody
from sympy.physics.vector import Point, ReferenceFrame, Vector

from engdyn.algebra.readable import to_sympy, tree
from engdyn.algebra.ring import Element
from engdyn.errors import EngdynError
from engdyn.modeling.motion import Motion, VectorPath, measure_numbers, rotation_steps, spin_steps
from engdyn.modeling.state import State

__all__ = [
    "center_of",
    "frames_of",
    "grouped",
    "inertial_frame",
    "motion_of",
    "place",
    "readable",
    "readable_sum",
]


def motion_of(
    frame: ReferenceFrame,
    paths: Iterable[VectorPath],
    turning: Iterable[ReferenceFrame] = (),
    scalars: Iterable[Any] = (),
    axes: Iterable[ReferenceFrame] = (),
) -> Motion:
    """A ring for the motion of points and frames, with generators for the rates that are needed.

    Parameters
    ----------
    frame : ReferenceFrame
        The inertial frame.
    paths : iterable of VectorPath
        How the points are reached whose velocities will be asked for.
    turning : iterable of ReferenceFrame
        Frames whose angular velocities will be asked for.
    scalars : iterable of expressions
        Everything else that will be converted: masses, loads.
    axes : iterable of ReferenceFrame
        Frames in which further vectors are written.
    """
    paths, turning, scalars = list(paths), list(dict.fromkeys(turning)), list(scalars)
    vectors = [v for path in paths for v in (path.start._vel_dict[frame], *path.steps)]
    vectors += [spin for f in turning for spin in spin_steps(f, frame)]
    frames = dict.fromkeys([*turning, *axes, *frames_of(*vectors)])
    turns = [
        step for f in frames for a, b in ((frame, f), (f, frame)) for step in rotation_steps(a, b)
    ]  # both ways: the inertia of a body is written in its own axes, velocities in the inertial ones
    expressions = [*measure_numbers(*vectors, *turns), *scalars]
    return Motion(State((), expressions, moving=expressions), frame)


def center_of(body: Particle | RigidBody) -> Point:
    """The point that carries the mass of a body."""
    return body.point if isinstance(body, Particle) else body.masscenter


def place(point: Point, base: Point, what: str) -> Vector:
    """The vector from `base` to `point`."""
    try:
        return point.pos_from(base)
    except (ValueError, AttributeError, TypeError) as error:
        raise EngdynError(
            f"{what}, {point}, is not placed from {base}: connect them with locatenew or set_pos"
        ) from error


def readable(element: Element) -> sm.Expr:
    """A ring element as a factored expression."""
    return to_sympy(tree(element))


def grouped(elements: Iterable[Element]) -> list[Element]:
    """Sums of the elements that have one denominator: bringing all to a common one makes long formulas."""
    groups: list[Element] = []
    for element in elements:
        same = [e.denominator == element.denominator for e in groups]
        if any(same):
            groups[same.index(True)] += element
        else:
            groups.append(element)
    return [e for e in groups if not e.is_zero()]


def readable_sum(elements: Sequence[Element]) -> sm.Expr:
    """A sum of ring elements as an expression, each denominator by itself."""
    groups = grouped(elements)
    if not groups or sum(groups[1:], groups[0]).is_zero():
        return sm.S.Zero
    return sm.Add(*map(readable, groups))


def inertial_frame(frame: Any) -> ReferenceFrame:
    """The frame, or an error that says what is asked for."""
    if not isinstance(frame, ReferenceFrame):
        raise EngdynError(f"frame is {frame!r}: give the inertial ReferenceFrame")
    return frame


def frames_of(*vectors: Vector) -> list[ReferenceFrame]:
    """The frames in which vectors are written."""
    return [f for vector in vectors for _, f in vector.args]
