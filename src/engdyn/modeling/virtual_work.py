"""Generalized forces: what loads do along the motions that the coordinates allow.

Course section 3.3; J. L. Lagrange, *Mécanique analytique* (1788): the virtual work of all loads is
Σ Q δq, so that Q = Σ F·∂v/∂q̇ + Σ M·∂ω/∂q̇ (the partial velocities equal ∂r/∂q: "cancellation of dots").
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import TypeAlias

import sympy as sm
from sympy.physics.mechanics import Force, Torque
from sympy.physics.vector import Point, ReferenceFrame, Vector

from engdyn.algebra.ring import Element
from engdyn.errors import EngdynError
from engdyn.modeling.free_body import FreeBody, Load, arm_of, load_vector
from engdyn.modeling.model_motion import motion_of, readable_sum
from engdyn.modeling.motion import Motion, Triple, VectorPath, cross, measure_numbers, path_of_point
from engdyn.modeling.state import check_coordinates

__all__ = ["generalized_forces"]

Loads: TypeAlias = Load | FreeBody | Sequence[Load | FreeBody]


@dataclass(frozen=True)
class _Acting:
    """One load: a force at a point or with an arm on a turning body, or a torque on a frame."""

    vector: Vector
    point: Point | None = None
    turning: ReferenceFrame | None = None
    arm: Vector | None = None


def generalized_forces(
    loads: Loads, coordinates: Sequence[sm.Expr], frame: ReferenceFrame
) -> dict[sm.Expr, sm.Expr]:
    """Generalized forces of loads, by virtual work.

    Parameters
    ----------
    loads : Force, Torque, FreeBody, or a sequence of them
        A force acts at the point that it names, which moves as that point is placed or as its
        ``set_vel`` says; a torque turns with its frame.  A follower force is a force written in a
        frame that moves.  Of a :class:`engdyn.FreeBody` all loads count, applied and reactions, and
        its forces act on the *material* point of the body: reactions that do no work drop out when
        all the bodies that they connect are given.
    coordinates : sequence of dynamicsymbols, length n
    frame : ReferenceFrame
        The inertial frame.

    Returns
    -------
    dict of coordinate to sympy.Expr
        Q of every coordinate [N for a length, N m for an angle], ready for ``forces`` of
        :func:`engdyn.lagrange`.

    Raises
    ------
    EngdynError
        Something that is no load, a point whose velocity or a frame whose rotation is unknown, a
        torque on a particle.

    Notes
    -----
    Course section 3.3.

    Examples
    --------
    >>> import engdyn as ed, sympy as sm
    >>> from sympy.physics.mechanics import Force, Point, ReferenceFrame, dynamicsymbols
    >>> theta, l, F = dynamicsymbols("theta"), sm.Symbol("l"), sm.Symbol("F")
    >>> N, A, O = ReferenceFrame("N"), ReferenceFrame("A"), Point("O")
    >>> O.set_vel(N, 0)
    >>> A.orient_axis(N, theta, N.z)
    >>> tip = O.locatenew("tip", l * A.x)
    >>> ed.generalized_forces([Force(tip, F * N.y)], [theta], N)
    {theta(t): F*l*cos(theta(t))}
    """
    coordinates = check_coordinates(coordinates)
    if not isinstance(frame, ReferenceFrame):
        raise EngdynError(f"frame is {frame!r}: give the inertial ReferenceFrame")
    acting = list(_acting(loads))
    paths = {a.point: path_of_point(a.point, frame) for a in acting if a.point is not None}
    vectors = [v for a in acting for v in (a.vector, a.arm) if v is not None]
    terms = [list(_terms(a.vector)) for a in acting]
    motion = motion_of(
        frame,
        paths.values(),
        [a.turning for a in acting if a.turning is not None],
        [*coordinates, *measure_numbers(*vectors), *(t for found in terms for t, *_ in found)],
        [f for v in vectors for _, f in v.args],
    )
    by_rate = [motion.state.ring.partial(("function", q, 1)) for q in coordinates]
    work: list[list[Element]] = [[] for _ in coordinates]
    for load, found in zip(acting, terms, strict=True):
        velocity = _velocity(load, motion, paths)
        for own, partial in zip(work, by_rate, strict=True):
            along = [partial(v) for v in velocity]
            turned = {f: motion.turned(along, frame, f) for _, f in load.vector.args}
            own += [motion.state.convert(term) * turned[f][axis] for term, f, axis in found]
    return {q: readable_sum(elements) for q, elements in zip(coordinates, work, strict=True)}


def _acting(loads: Loads) -> Iterable[_Acting]:
    """All loads, those of free bodies on the material points of their bodies."""
    for load in [loads] if isinstance(loads, Force | Torque | FreeBody) else loads:
        if isinstance(load, FreeBody):
            for own in (*load.applied, *load.reactions):
                yield _on_body(own, load)
        elif isinstance(load, Force):
            yield _Acting(load.force, point=load.point)
        elif isinstance(load, Torque):
            yield _Acting(load.torque, turning=load.frame)
        else:
            raise EngdynError(f"{load!r} is no load: give a Force, a Torque or a FreeBody")


def _on_body(load: Load, body: FreeBody) -> _Acting:
    vector, frame = load_vector(load), body.body.frame if body.turns else None
    if isinstance(load, Torque):
        if frame is None:
            raise EngdynError(
                f"a torque acts on the particle {body.name}: particles do not turn, use a RigidBody"
            )
        return _Acting(vector, turning=frame)
    if frame is None or load.point == body.center:
        return _Acting(vector, point=body.center)
    return _Acting(vector, point=body.center, turning=frame, arm=arm_of(load, body))


def _terms(vector: Vector) -> Iterator[tuple[sm.Expr, ReferenceFrame, int]]:
    """A vector term by term (scalar, frame, axis): what is short in the load is to be short in Q."""
    for matrix, frame in vector.args:
        for axis in range(3):
            for term in sm.Add.make_args(sm.expand_mul(matrix[axis], deep=False)):
                if term != 0:
                    yield term, frame, axis


def _velocity(load: _Acting, motion: Motion, paths: dict[Point, VectorPath]) -> Triple:
    """What a load works along: the velocity of its material point, or an angular velocity."""
    spin = None if load.turning is None else motion.angular_velocity(load.turning, motion.frame)
    if load.point is None:
        return spin
    velocity = motion.velocity(paths[load.point])
    if load.arm is None:
        return velocity
    carried = cross(spin, motion.components(load.arm, motion.frame))
    return [a + b for a, b in zip(velocity, carried, strict=True)]
