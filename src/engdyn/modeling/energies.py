"""Energies of bodies, springs and dampers, written from points, frames and bodies.

Kinetic energy comes from absolute velocities, springs have a free length, dampers feel the relative
velocity along themselves: what is forgotten most often is asked for here.  Course sections 3.4 to 3.6.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, TypeAlias

import sympy as sm
from sympy.physics.mechanics import Particle, RigidBody
from sympy.physics.vector import Point, ReferenceFrame, Vector

from engdyn.algebra.expressions import as_expression
from engdyn.algebra.ring import Element
from engdyn.errors import EngdynError
from engdyn.modeling.free_body import FreeBody
from engdyn.modeling.model_motion import center_of, frames_of, inertial_frame, motion_of, place, readable
from engdyn.modeling.motion import Motion, dot, measure_numbers, path_of_point

__all__ = ["damper_dissipation", "gravity_potential", "kinetic_energy", "spring_potential"]

Body: TypeAlias = Particle | RigidBody


def kinetic_energy(bodies: Body | FreeBody | Sequence[Body | FreeBody], frame: ReferenceFrame) -> sm.Expr:
    """Kinetic energy ½ m v_G² + ½ ω·I_G·ω of all bodies, from their absolute velocities.

    Parameters
    ----------
    bodies : Particle, RigidBody, FreeBody, or a sequence of them
    frame : ReferenceFrame
        The inertial frame; velocities and angular velocities are those seen from it.

    Returns
    -------
    sympy.Expr
        T [J], grouped by products of rates, every coefficient factored.

    Raises
    ------
    EngdynError
        Something that is no body, a point whose velocity or a frame whose rotation is unknown.

    Notes
    -----
    Course section 3.6.  The mass center and the central inertia are used, so nothing is counted
    twice, and no point needs to be fixed (J. S. König, 1751).

    Examples
    --------
    >>> import engdyn as ed, sympy as sm
    >>> from sympy.physics.mechanics import Particle, Point, ReferenceFrame, dynamicsymbols
    >>> s, m = dynamicsymbols("s"), sm.Symbol("m", positive=True)
    >>> N, O = ReferenceFrame("N"), Point("O")
    >>> O.set_vel(N, 0)
    >>> ed.kinetic_energy(Particle("bead", O.locatenew("P", s * N.x + s**2 * N.y), m), N)
    m*(4*s(t)**2 + 1)*Derivative(s(t), t)**2/2
    """
    found = _bodies(bodies)
    paths = [path_of_point(center_of(body), inertial_frame(frame)) for body in found]
    turning = [body.frame for body in found if isinstance(body, RigidBody)]
    dyadics = [body.central_inertia for body in found if isinstance(body, RigidBody)]
    axes = [unit.args[0][1] for dyadic in dyadics for part in dyadic.args for unit in part[1:]]
    masses = [as_expression(body.mass, f"the mass of {body.name}") for body in found]
    motion = motion_of(frame, paths, turning, [*masses, *measure_numbers(*dyadics)], axes)
    energy = motion.state.ring.zero
    for body, path, mass in zip(found, paths, masses, strict=True):
        velocity = motion.velocity(path)
        energy = energy + motion.state.convert(mass) * dot(velocity, velocity) / 2
        if isinstance(body, RigidBody):
            energy = energy + _rotation(body, motion) / 2
    return readable(energy)


def _rotation(body: RigidBody, motion: Motion) -> Element:
    """ω·I_G·ω of a rigid body."""
    total = motion.state.ring.zero
    for measure, left, right in body.central_inertia.args:
        axes = left.args[0][1]
        spin = motion.angular_velocity(body.frame, axes)
        sides = [dot(motion.components(side, axes), spin) for side in (left, right)]
        total = total + motion.state.convert(as_expression(measure)) * sides[0] * sides[1]
    return total


def gravity_potential(
    bodies: Body | FreeBody | Sequence[Body | FreeBody], acceleration: Vector, datum: Point
) -> sm.Expr:
    """Potential energy −Σ m g·r_G of weights in a uniform field.

    Parameters
    ----------
    bodies : Particle, RigidBody, FreeBody, or a sequence of them
    acceleration : Vector
        The acceleration of free fall, ``-g*N.y`` where N.y points up [m/s²]; written in axes that do
        not turn.
    datum : Point
        Where V is zero, a fixed point; another one changes V by a constant, the equations not at all.

    Returns
    -------
    sympy.Expr
        V [J], factored.

    Raises
    ------
    EngdynError
        Something that is no body, an acceleration that is no vector or is written in axes that turn,
        a datum that moves, a mass center that is not placed from the datum.

    Notes
    -----
    Course section 3.4.
    """
    found = _bodies(bodies)
    if not isinstance(acceleration, Vector) or len(acceleration.args) != 1:
        raise EngdynError(
            f"the acceleration of gravity is {acceleration!r}: give a vector in one frame, such as -g*N.y"
        )
    axes = acceleration.args[0][1]
    _check_datum(datum, axes)
    places = [place(center_of(body), datum, f"the mass center of {body.name}") for body in found]
    masses = [as_expression(body.mass, f"the mass of {body.name}") for body in found]
    motion = motion_of(axes, (), (), [*masses, *measure_numbers(acceleration, *places)], frames_of(*places))
    pull = motion.components(acceleration, axes)
    total = motion.state.ring.zero
    for mass, vector in zip(masses, places, strict=True):
        total = total - motion.state.convert(mass) * dot(pull, motion.components(vector, axes))
    return readable(total)


def spring_potential(stiffness: sm.Expr, start: Point, end: Point, free_length: sm.Expr) -> sm.Expr:
    """Potential energy ½ k (length − free length)² of a spring between two points.

    Parameters
    ----------
    stiffness : sympy.Expr
        k [N/m].
    start, end : Point
        The ends, both free to move, each placed from the other by known vectors.
    free_length : sympy.Expr
        Length without force [m]; it must be said, 0 where the law of the spring is meant so.

    Returns
    -------
    sympy.Expr
        V [J].  The length is a distance, never negative: a spring along a line gives a magnitude.

    Raises
    ------
    EngdynError
        Points that are not connected, or the same point twice.

    Notes
    -----
    Course section 3.4.  A free length of zero and one that is forgotten give different equations as
    soon as the spring turns; :func:`engdyn.check_potential` compares V with the force of the spring.
    """
    stiffness = as_expression(stiffness, "the stiffness")
    free = as_expression(free_length, "the free length")
    square = readable(_square(*_between(start, end)))
    if free == 0:
        return stiffness * square / 2
    return stiffness * (_root(square) - free) ** 2 / 2


def damper_dissipation(damping: sm.Expr, start: Point, end: Point, frame: ReferenceFrame) -> sm.Expr:
    """Rayleigh's function ½ c Δ̇² of a linear damper between two points, in any direction.

    Parameters
    ----------
    damping : sympy.Expr
        c [N s/m].
    start, end : Point
        The ends; Δ̇ is their relative velocity along the damper, the rate of its length.
    frame : ReferenceFrame
        The inertial frame.

    Returns
    -------
    sympy.Expr
        D [W], half the power that the damper takes out.

    Raises
    ------
    EngdynError
        Points that are not connected, the same point twice, a damper whose length cannot change.

    Notes
    -----
    Course section 3.5; J. W. Strutt (Lord Rayleigh), *Proc. London Math. Soc.* s1-4 (1873).
    """
    damping = as_expression(damping, "the damping constant")
    motion, vector = _between(start, end, inertial_frame(frame))
    square = _square(motion, vector)
    change = motion.state.time_derivative(square) / 2  # length times its rate
    if change.is_zero():
        raise EngdynError(f"the distance from {start} to {end} does not change: a damper there does nothing")
    quotient = change * change / square
    if quotient.denominator is None:
        return damping * readable(quotient) / 2
    return damping * readable(change) ** 2 / (2 * readable(square))


def _check_datum(datum: Point, axes: ReferenceFrame) -> None:
    """Refuse a datum that is known to move, and axes that are known to turn where it rests."""
    at_rest = [f for f, velocity in getattr(datum, "_vel_dict", {}).items() if velocity == 0]
    turns = [
        any(not w.is_zero() for w in motion_of(f, (), [axes]).angular_velocity(axes, f)) for f in at_rest
    ]
    if turns and all(turns):
        raise EngdynError(
            f"the acceleration of gravity is written in {axes}, which turns: write it in axes fixed in {at_rest[0]}"
        )
    try:
        path = path_of_point(datum, axes)
    except (EngdynError, AttributeError):
        return  # nothing is known of its motion
    if any(not v.is_zero() for v in motion_of(axes, [path]).velocity(path)):
        raise EngdynError(f"the datum {datum} moves: heights are counted from a fixed point")


def _bodies(bodies: Any) -> list[Body]:
    given = [bodies] if isinstance(bodies, Particle | RigidBody | FreeBody) else list(bodies)
    found = [body.body if isinstance(body, FreeBody) else body for body in given]
    for body in found:
        if not isinstance(body, Particle | RigidBody):
            raise EngdynError(f"{body!r} is not a body: give a Particle, a RigidBody or a FreeBody")
    if not found:
        raise EngdynError("there are no bodies: give at least one")
    return found


def _between(start: Point, end: Point, frame: ReferenceFrame | None = None) -> tuple[Motion, list[Element]]:
    """The vector from start to end in components, and the ring in which it is written."""
    vector = place(end, start, "the end of the spring or damper")
    if vector == 0:
        raise EngdynError(f"both ends are at {start}: a spring or damper connects two different points")
    axes = frame or vector.args[0][1]
    motion = motion_of(axes, (), (), measure_numbers(vector), frames_of(vector))
    return motion, motion.components(vector, axes)


def _square(motion: Motion, vector: list[Element]) -> Element:
    return dot(vector, vector)


def _root(square: sm.Expr) -> sm.Expr:
    """√ of a square length: factors with even powers leave the root as magnitudes."""
    outside, inside = sm.S.One, sm.S.One
    for factor in sm.Mul.make_args(square):
        base, exponent = factor.as_base_exp()
        if exponent.is_Integer and exponent % 2 == 0:
            outside *= (base if base.is_positive else sm.Abs(base)) ** (exponent / 2)
        else:
            inside *= factor
    return outside * sm.sqrt(inside)
