"""Kinematics: derivatives of vectors, and the acceleration of a point term by term.

The vectors, points and frames are those of sympy.physics.mechanics; the algebra is done in the
trigonometric ring, so that results come out in a short, factored form.  Course sections 1.1 to 1.7.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, fields
from typing import TYPE_CHECKING, Any

import numpy as np
import sympy as sm
from sympy.physics.vector import Point, ReferenceFrame, Vector

from engdyn.algebra.readable import to_sympy, tree
from engdyn.errors import EngdynError
from engdyn.modeling.instants import components, key_name
from engdyn.modeling.motion import Motion, Triple, cross, measure_numbers, rotation_steps, spin_steps
from engdyn.modeling.state import State

if TYPE_CHECKING:
    import pandas as pd

__all__ = [
    "AccelerationTerms",
    "VectorDerivative",
    "acceleration_terms",
    "carried",
    "key_name",
    "motion_of",
    "vector_derivative",
    "written_in",
]


@dataclass(frozen=True)
class VectorDerivative:
    """The time derivative of a vector, split into the two things that can change.

    Attributes
    ----------
    of_magnitude : Vector
        Change of the components in their own frame: the vector grows.
    of_direction : Vector
        ω × vector: the frame carries the vector along.
    total : Vector
        Their sum, the derivative seen from the ground.
    """

    of_magnitude: Vector
    of_direction: Vector
    total: Vector


def vector_derivative(vector: Vector, frame: ReferenceFrame, ground: ReferenceFrame) -> VectorDerivative:
    """Differentiate a vector that is written in a turning frame.

    Parameters
    ----------
    vector : Vector
    frame : ReferenceFrame
        The frame in whose axes the vector is written; it is this frame's ω that enters, once.
    ground : ReferenceFrame
        From where the change is seen.

    Returns
    -------
    VectorDerivative
        All parts in the axes of `frame`.

    Raises
    ------
    EngdynError
        Not a vector, or a frame that is not oriented with respect to the ground.

    Notes
    -----
    Course section 1.1.

    Examples
    --------
    >>> import engdyn as ed
    >>> from sympy.physics.mechanics import ReferenceFrame, dynamicsymbols
    >>> theta, r = dynamicsymbols("theta r")
    >>> N, A = ReferenceFrame("N"), ReferenceFrame("A")
    >>> A.orient_axis(N, theta, N.z)
    >>> ed.vector_derivative(r * A.x, A, N).of_direction
    r(t)*Derivative(theta(t), t)*A.y
    """
    _check_vector(vector, "vector")
    motion = motion_of([vector], [frame], ground)
    written = motion.components(vector, frame)
    spin = motion.angular_velocity(frame, frame)
    grows, turns = motion.derivative(written), cross(spin, written)
    total = [a + b for a, b in zip(grows, turns, strict=True)]
    return VectorDerivative(*(written_in(part, frame) for part in (grows, turns, total)))


@dataclass(frozen=True)
class AccelerationTerms:
    """The acceleration of a point that moves in a moving frame, in its five named terms.

    Attributes
    ----------
    base : Vector
        Acceleration of the base point, the origin of the moving frame.
    tangential : Vector
        α × r, the Euler term: the frame's rate of turn changes.
    centripetal : Vector
        ω × (ω × r).
    coriolis : Vector
        2 ω × v_rel.
    relative : Vector
        Acceleration seen by an observer in the moving frame.
    frame : ReferenceFrame
        The moving frame; all terms are written in its axes.
    """

    base: Vector
    tangential: Vector
    centripetal: Vector
    coriolis: Vector
    relative: Vector
    frame: ReferenceFrame

    @property
    def total(self) -> Vector:
        """The absolute acceleration: the sum of the five terms."""
        return sum((term for _, term in self), Vector(0))

    def without(self, *names: str) -> Vector:
        """The sum of the terms that remain when those named are forgotten: what a mistake looks like.

        Raises
        ------
        EngdynError
            There is no term of that name.
        """
        terms = dict(self)
        for name in names:
            if name not in terms:
                raise EngdynError(f"there is no term {name!r}: choose among {', '.join(terms)}")
        return sum((term for name, term in terms.items() if name not in names), Vector(0))

    def __iter__(self) -> Iterator[tuple[str, Vector]]:
        return iter((f.name, getattr(self, f.name)) for f in fields(self) if f.name != "frame")

    def evaluate(self, values: Mapping[Any, float]) -> dict[str, np.ndarray]:
        """Components of every term, and of the total, as numbers.

        Parameters
        ----------
        values : mapping
            Symbols, dynamicsymbols and their derivatives (or their names, ``"theta"``,
            ``"theta_d"``, ``"theta_dd"``) → numbers [SI].

        Returns
        -------
        dict of str to ndarray, shape (3,)
            Components in :attr:`frame` [m/s²].
        """
        named = [*self, ("total", self.total)]
        return {name: components(term, self.frame, values) for name, term in named}

    def magnitudes(self, values: Mapping[Any, float]) -> dict[str, float]:
        """Magnitude of every term, and of the total [m/s²]."""
        return {name: float(np.linalg.norm(part)) for name, part in self.evaluate(values).items()}

    def symbolic_magnitudes(self) -> dict[str, sm.Expr]:
        """Magnitude of every term as an expression: the absolute value where it has one component."""
        found = {}
        for name, term in self:
            motion = motion_of([term], [self.frame], self.frame)
            parts = [c for c in motion.components(term, self.frame) if not c.is_zero()]
            if len(parts) > 1:
                square = to_sympy(tree(sum((c * c for c in parts), motion.state.ring.zero)))
                found[name] = sm.Abs(square.base) if square.is_Pow and square.exp == 2 else sm.sqrt(square)
            else:
                found[name] = sm.Abs(to_sympy(tree(parts[0]))) if parts else sm.S.Zero
        return found

    def table(self, values: Mapping[Any, float]) -> pd.DataFrame:
        """Every term, and the total, with magnitude and direction.

        Parameters
        ----------
        values : mapping
            As for :meth:`evaluate`.

        Returns
        -------
        pandas.DataFrame
            One row a term: magnitude [m/s²] and the components of its unit vector along the axes of
            :attr:`frame` (NaN for a term that is zero, which has no direction).
        """
        import pandas as pd

        parts, sizes = self.evaluate(values), self.magnitudes(values)
        least = 1e-12 * max(sizes.values())  # what is smaller is rounding
        sizes = {name: size if size > least else 0.0 for name, size in sizes.items()}
        rows = {
            name: part / sizes[name] if sizes[name] else np.full(3, np.nan) for name, part in parts.items()
        }
        axes = [f"along {self.frame}.{axis}" for axis in "xyz"]
        found = pd.DataFrame(rows, index=axes).T
        found.insert(0, "magnitude [m/s²]", pd.Series(sizes))
        return found.rename_axis("term")

    def _repr_latex_(self) -> str:
        from sympy.physics.vector.printing import vlatex

        rows = [rf"\text{{{name}}} &= {vlatex(term) if term != 0 else 0}" for name, term in self]
        return "$\\displaystyle \\begin{aligned}" + r"\\".join(rows) + r"\end{aligned}$"


def acceleration_terms(
    point: Point, base: Point, frame: ReferenceFrame, ground: ReferenceFrame
) -> AccelerationTerms:
    """The five terms of the general acceleration expression.

    Parameters
    ----------
    point : Point
        The point whose acceleration is wanted, placed from `base`.
    base : Point
        Origin of the moving frame; its velocity in the ground must be known (``set_vel``), or that
        of a point it is placed from.
    frame : ReferenceFrame
        The moving frame.
    ground : ReferenceFrame
        The inertial frame.

    Returns
    -------
    AccelerationTerms

    Raises
    ------
    EngdynError
        Points that are not connected, a frame that is not oriented.

    Notes
    -----
    Course section 1.7: a = a_base + α × r + ω × (ω × r) + 2 ω × v_rel + a_rel.
    """
    from engdyn.modeling.motion import path_of_point

    try:
        arm = point.pos_from(base)
    except ValueError as error:
        raise EngdynError(
            f"{point} is not placed from {base}: connect them with locatenew or set_pos"
        ) from error
    path = path_of_point(base, ground)
    given = path.start._vel_dict[ground]
    motion = motion_of([arm, given, *path.steps], [frame], ground)
    r = motion.components(arm, frame)
    spin = motion.angular_velocity(frame, frame)
    angular_acceleration = motion.derivative(spin)  # the frame's own ω: its turning adds ω × ω = 0
    seen = motion.derivative(r)
    twice = [2 * x for x in cross(spin, seen)]
    base_acceleration = motion.turned(motion.derivative(motion.velocity(path)), ground, frame)
    terms = (
        base_acceleration,
        cross(angular_acceleration, r),
        cross(spin, cross(spin, r)),
        twice,
        motion.derivative(seen),
    )
    return AccelerationTerms(*(written_in(term, frame) for term in terms), frame)


def _check_vector(vector: Any, name: str) -> None:
    if not isinstance(vector, Vector):
        raise EngdynError(f"{name} is {vector!r}: give a Vector of sympy.physics.mechanics")


def motion_of(vectors: list[Vector], frames: list[ReferenceFrame], ground: ReferenceFrame) -> Motion:
    """A ring for given vectors and frames, with generators for all derivatives that will be needed."""
    involved = {f for v in vectors for _, f in v.args} | set(frames)
    spins = [s for f in involved for s in spin_steps(f, ground)]
    involved |= {f for s in spins for _, f in s.args}
    steps = [
        m for f in involved for one in (rotation_steps(f, ground), rotation_steps(ground, f)) for m in one
    ]
    scalars = measure_numbers(*vectors, *spins, *steps)
    return Motion(State((), scalars, moving=scalars), ground)


def carried(motion: Motion, written: Triple, frame: ReferenceFrame) -> Triple:
    """Derivative of a vector, seen from the ground of `motion`, in the frame in which it is written."""
    turning = cross(motion.angular_velocity(frame, frame), written)
    return [a + b for a, b in zip(motion.derivative(written), turning, strict=True)]


def written_in(written: Triple, frame: ReferenceFrame) -> Vector:
    """A sympy vector from ring components in a frame, factored."""
    parts = [to_sympy(tree(c)) for c in written]
    return sum(
        (p * axis for p, axis in zip(parts, (frame.x, frame.y, frame.z), strict=True) if p != 0), Vector(0)
    )
