"""Motion of points and frames of sympy.physics.mechanics, computed in a ring.

The models people build are trees: points placed from other points, frames oriented in other frames.
This module walks these trees and does the algebra (rotations, time derivatives) in the ring, where
it costs a fraction of what symbolic vectors cost.  Course sections 1.2 to 1.7.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import pairwise
from typing import Any

import sympy as sm
from sympy.physics.vector import Dyadic, Point, ReferenceFrame, Vector

from engdyn.algebra.expressions import as_expression
from engdyn.algebra.ring import Element
from engdyn.errors import EngdynError
from engdyn.modeling.state import State

__all__ = [
    "Motion",
    "VectorPath",
    "cross",
    "dot",
    "measure_numbers",
    "path_of_point",
    "rotation_steps",
    "spin_steps",
]

Triple = list[Element]


class VectorPath:
    """How a point is reached: from a point whose velocity in `frame` is given, along vectors."""

    def __init__(self, start: Point, steps: list[Vector]):
        self.start, self.steps = start, steps


def rotation_steps(a: ReferenceFrame, b: ReferenceFrame) -> list[sm.Matrix]:
    """Direction cosine matrices whose product turns components in `b` into components in `a`."""
    if a is b:
        return []
    try:
        frames = a._dict_list(b, 0)
    except ValueError as error:
        raise EngdynError(
            f"frame {b} is not oriented with respect to frame {a}: orient it, e.g. with orient_axis"
        ) from error
    return [one._dcm_dict[two] for one, two in pairwise(frames)]


def spin_steps(a: ReferenceFrame, b: ReferenceFrame) -> list[Vector]:
    """Vectors whose sum is the angular velocity of `a` in `b`."""
    if a is b:
        return []
    try:
        frames = a._dict_list(b, 1)
    except ValueError as error:
        raise EngdynError(
            f"frame {a} is not oriented with respect to frame {b}: orient it, or call set_ang_vel"
        ) from error
    return [one._ang_vel_dict[two] for one, two in pairwise(frames)]


def path_of_point(point: Point, frame: ReferenceFrame) -> VectorPath:
    """The shortest way from a point with a given velocity in `frame` to `point`."""
    seen, waiting = {point}, [(point, [])]
    while waiting:
        here, steps = waiting.pop(0)
        if frame in here._vel_dict:
            return VectorPath(here, steps)
        for there, vector in here._pos_dict.items():
            if there not in seen:
                seen.add(there)
                waiting.append((there, [*steps, vector]))
    raise EngdynError(
        f"the velocity of {point} in frame {frame} is unknown: no point connected to it is fixed or has a velocity "
        f"there; call O.set_vel({frame}, 0) for the fixed point O"
    )


def measure_numbers(*quantities: Any) -> list[sm.Expr]:
    """All scalar expressions that vectors, dyadics and matrices are made of."""
    found: list[sm.Expr] = []
    for quantity in quantities:
        if isinstance(quantity, Vector):
            found += [e for matrix, _ in quantity.args for e in matrix.flat()]
        elif isinstance(quantity, Dyadic):
            found += [part[0] for part in quantity.args]
        elif isinstance(quantity, sm.MatrixBase):
            found += quantity.flat()
        else:
            found.append(as_expression(quantity))
    return found


class Motion:
    """Positions, velocities and accelerations in the ring of a state.

    Parameters
    ----------
    state : State
    frame : ReferenceFrame
        The inertial frame.
    """

    def __init__(self, state: State, frame: ReferenceFrame):
        self.state, self.frame = state, frame
        self._rotations: dict[tuple[ReferenceFrame, ReferenceFrame], list[Triple]] = {}

    def rotation(self, a: ReferenceFrame, b: ReferenceFrame) -> list[Triple] | None:
        """The matrix that turns components in `b` into components in `a` (None for the identity)."""
        if a is b:
            return None
        if (b, a) in self._rotations:
            return [list(column) for column in zip(*self._rotations[b, a], strict=True)]
        if (a, b) not in self._rotations:
            product: list[Triple] | None = None
            for step in rotation_steps(a, b):
                entries = [self.state.convert(e) for e in step.flat()]
                rows = [entries[:3], entries[3:6], entries[6:]]
                product = rows if product is None else [_row_times(row, rows) for row in product]
            self._rotations[a, b] = product
        return self._rotations[a, b]

    def components(self, vector: Vector, frame: ReferenceFrame) -> Triple:
        """Components of a vector in a frame."""
        total = [self.state.ring.zero] * 3
        for matrix, own in vector.args:
            part = [self.state.convert(e) for e in matrix.flat()]
            total = [a + b for a, b in zip(total, self.turned(part, own, frame), strict=True)]
        return total

    def turned(self, components: Triple, own: ReferenceFrame, frame: ReferenceFrame) -> Triple:
        """Components given in one frame, in another frame."""
        rotation = self.rotation(frame, own)
        return components if rotation is None else [dot(row, components) for row in rotation]

    def sum_of(self, vectors: Iterable[Vector], frame: ReferenceFrame) -> Triple:
        """Components of a sum of vectors."""
        total = [self.state.ring.zero] * 3
        for vector in vectors:
            total = [a + b for a, b in zip(total, self.components(vector, frame), strict=True)]
        return total

    def velocity(self, path: VectorPath) -> Triple:
        """Velocity in the inertial frame, components in it: given velocity + d/dt of the vectors."""
        given = self.components(path.start._vel_dict[self.frame], self.frame)
        position = self.sum_of(path.steps, self.frame)
        return [a + self.state.time_derivative(b) for a, b in zip(given, position, strict=True)]

    def angular_velocity(self, body: ReferenceFrame, frame: ReferenceFrame) -> Triple:
        """Angular velocity of `body` in the inertial frame, components in `frame`."""
        return self.sum_of(spin_steps(body, self.frame), frame)

    def derivative(self, components: Triple) -> Triple:
        """Time derivative of components (of the vector itself where their frame is inertial)."""
        return [self.state.time_derivative(c) for c in components]


def _row_times(row: Triple, matrix: Sequence[Triple]) -> Triple:
    return [dot(row, [line[j] for line in matrix]) for j in range(3)]


def dot(a: Triple, b: Triple) -> Element:
    """Scalar product of components in one frame."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a: Triple, b: Triple) -> Triple:
    """Vector product of components in one frame."""
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
