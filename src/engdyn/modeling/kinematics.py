"""Kinematics: derivatives of vectors, and the acceleration of a point term by term.

The vectors, points and frames are those of sympy.physics.mechanics; the algebra is done in the
trigonometric ring, so that results come out in a short, factored form.  Course sections 1.1 to 1.7.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, fields
from typing import Any

import numpy as np
import sympy as sm
from sympy.core.function import AppliedUndef
from sympy.physics.vector import Point, ReferenceFrame, Vector, dynamicsymbols

from engdyn.algebra.readable import to_sympy, tree
from engdyn.errors import EngdynError
from engdyn.modeling.motion import Motion, Triple, cross, measure_numbers, rotation_steps, spin_steps
from engdyn.modeling.state import State

__all__ = ["AccelerationTerms", "VectorDerivative", "acceleration_terms", "vector_derivative"]


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
    motion = _motion([vector], [frame], ground)
    components = motion.components(vector, frame)
    spin = motion.angular_velocity(frame, frame)
    grows, turns = motion.derivative(components), cross(spin, components)
    total = [a + b for a, b in zip(grows, turns, strict=True)]
    return VectorDerivative(*(_vector(part, frame) for part in (grows, turns, total)))


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
        return {name: _numbers(term, self.frame, values) for name, term in named}

    def magnitudes(self, values: Mapping[Any, float]) -> dict[str, float]:
        """Magnitude of every term, and of the total [m/s²]."""
        return {name: float(np.linalg.norm(part)) for name, part in self.evaluate(values).items()}

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
    motion = _motion([arm, given, *path.steps], [frame], ground)
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
    return AccelerationTerms(*(_vector(term, frame) for term in terms), frame)


def _check_vector(vector: Any, name: str) -> None:
    if not isinstance(vector, Vector):
        raise EngdynError(f"{name} is {vector!r}: give a Vector of sympy.physics.mechanics")


def _motion(vectors: list[Vector], frames: list[ReferenceFrame], ground: ReferenceFrame) -> Motion:
    """A ring for given vectors and frames, with generators for all derivatives that will be needed."""
    involved = {f for v in vectors for _, f in v.args} | set(frames)
    spins = [s for f in involved for s in spin_steps(f, ground)]
    involved |= {f for s in spins for _, f in s.args}
    steps = [
        m for f in involved for one in (rotation_steps(f, ground), rotation_steps(ground, f)) for m in one
    ]
    scalars = measure_numbers(*vectors, *spins, *steps)
    return Motion(State((), scalars, moving=scalars), ground)


def _vector(components: Triple, frame: ReferenceFrame) -> Vector:
    """A sympy vector from ring components, factored."""
    parts = [to_sympy(tree(c)) for c in components]
    return sum(
        (p * axis for p, axis in zip(parts, (frame.x, frame.y, frame.z), strict=True) if p != 0), Vector(0)
    )


def _numbers(vector: Vector, frame: ReferenceFrame, values: Mapping[Any, float]) -> np.ndarray:
    """Components of a vector with numbers for everything in it."""
    components = [vector.dot(axis) for axis in (frame.x, frame.y, frame.z)]
    named = {key_name(k): v for k, v in values.items()}
    found = []
    for component in components:
        replaced = component
        for atom in sorted(component.atoms(sm.Derivative), key=lambda d: -d.derivative_count):
            replaced = replaced.xreplace({atom: _value_of(atom, named)})
        rest = {
            a: _value_of(a, named) for a in replaced.atoms(sm.Symbol, AppliedUndef) if a != dynamicsymbols._t
        }
        found.append(float(replaced.xreplace(rest)))
    return np.array(found)


def key_name(key: Any) -> str:
    """``theta_dd`` for the second derivative of theta, names as they are."""
    if isinstance(key, str):
        return key
    if isinstance(key, sm.Derivative):
        return f"{key.expr.func.__name__}_{'d' * int(key.derivative_count)}"
    return key.func.__name__ if isinstance(key, AppliedUndef) else str(key)


def _value_of(atom: sm.Expr, named: Mapping[str, float]) -> sm.Float:
    name = key_name(atom)
    if name not in named:
        raise EngdynError(f"values lacks {name}: give it a number")
    return sm.Float(float(named[name]))
