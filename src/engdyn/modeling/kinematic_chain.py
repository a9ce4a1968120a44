"""The procedure of kinematic analysis as an object: from a fixed point to the mass center.  Course section 1.2.

A chain remembers every step, so that it can tell the degrees of freedom, and write the motion of any of
its points and frames in any axes.  What it makes are points and frames of sympy.physics.mechanics, ready
for free bodies.
"""

from __future__ import annotations

from typing import Any

from sympy.physics.vector import Point, ReferenceFrame, Vector

from engdyn.modeling.chain_steps import Steps
from engdyn.modeling.chain_text import as_html, count_in_words
from engdyn.modeling.kinematics import AccelerationTerms, acceleration_terms, carried, motion_of, written_in
from engdyn.modeling.motion import path_of_point
from engdyn.modeling.rotations import AngularMotion, angular_motion

__all__ = ["KinematicChain"]


class KinematicChain(Steps):
    """A chain of relative position vectors from a fixed point to every point of interest.

    Parameters
    ----------
    ground : ReferenceFrame or str
        The inertial frame; text makes one of that name.
    origin : Point or str
        The fixed point with which the analysis starts (its velocity in the ground is set to zero), or an
        existing point whose velocity in the ground is known.
    prescribed : sequence of dynamicsymbols
        Motions imposed from outside: they appear, but are no degrees of freedom.

    Notes
    -----
    Course section 1.2: fixed point → relative position vectors → degrees of freedom → frames and their
    angular velocities → differentiation.

    Examples
    --------
    >>> import engdyn as ed
    >>> from sympy.physics.mechanics import dynamicsymbols
    >>> theta, r = dynamicsymbols("theta r")
    >>> chain = ed.KinematicChain("N", origin="O")
    >>> A = chain.turn("A", about=chain.ground.z, by=theta)
    >>> P = chain.move("P", r * A.x)
    >>> chain.degrees_of_freedom, chain.velocity(P)
    (2, Derivative(r(t), t)*A.x + r(t)*Derivative(theta(t), t)*A.y)
    """

    def position(
        self, point: Point | str, axes: ReferenceFrame | str | None = None, base: Point | str | None = None
    ) -> Vector:
        """The vector from the origin (or from `base`) to a point [m], in the given axes."""
        vector, frame = self._way(point, axes, base)
        motion = motion_of([vector], [frame], self.ground)
        return written_in(motion.components(vector, frame), frame)

    def velocity(
        self,
        point: Point | str,
        axes: ReferenceFrame | str | None = None,
        base: Point | str | None = None,
        seen_from: ReferenceFrame | str | None = None,
    ) -> Vector:
        """Velocity of a point [m/s].

        Parameters
        ----------
        point : Point or str
            Also a body: its mass center.
        axes : ReferenceFrame or str, optional
            The axes in which the result is written; those of the last vector of the chain to the point,
            where the result is shortest, if not given.
        base, seen_from : optional
            Velocity relative to an observer: the point in which he stands, the frame with which he turns
            (the origin and the ground where not given).
        """
        return self._motion_of_point(point, axes, base, seen_from)[0]

    def acceleration(
        self,
        point: Point | str,
        axes: ReferenceFrame | str | None = None,
        base: Point | str | None = None,
        seen_from: ReferenceFrame | str | None = None,
    ) -> Vector:
        """Acceleration of a point [m/s²]; arguments as for :meth:`velocity`."""
        return self._motion_of_point(point, axes, base, seen_from)[1]

    def acceleration_terms(
        self, point: Point | str, base: Point | str, frame: ReferenceFrame | str
    ) -> AccelerationTerms:
        """The five terms of the acceleration of a point, for a frame that moves with `base` (1.7)."""
        return acceleration_terms(self.point(point), self.point(base), self.frame(frame), self.ground)

    def angular_motion(
        self, frame: ReferenceFrame | str, axes: ReferenceFrame | str | None = None
    ) -> AngularMotion:
        """Angular velocity and acceleration of a frame or a rigid body, step by step (1.6)."""
        return angular_motion(self.frame(frame), self.ground, None if axes is None else self.frame(axes))

    def angular_velocity(
        self, frame: ReferenceFrame | str, axes: ReferenceFrame | str | None = None
    ) -> Vector:
        """Angular velocity of a frame or a rigid body [rad/s], in its own axes if none are given."""
        return self.angular_motion(frame, axes).angular_velocity

    def angular_acceleration(
        self, frame: ReferenceFrame | str, axes: ReferenceFrame | str | None = None
    ) -> Vector:
        """Angular acceleration of a frame or a rigid body [rad/s²], in its own axes if none are given."""
        return self.angular_motion(frame, axes).angular_acceleration

    def _motion_of_point(self, point: Any, axes: Any, base: Any, seen_from: Any) -> tuple[Vector, Vector]:
        """Velocity and acceleration, both from vectors differentiated in the frames they are written in."""
        whole, frame = self._way(point, axes, base)
        observer, given, vectors = self.ground, Vector(0), [whole]
        if base is None and seen_from is None:
            path = path_of_point(self.point(point), self.ground)
            given, vectors = path.start._vel_dict[self.ground], path.steps
        elif seen_from is not None:
            observer = self.frame(seen_from)
        motion = motion_of([given, *vectors], [frame], observer)
        velocity = motion.components(given, frame)
        for matrix, own in (part for vector in vectors for part in vector.args):
            rate = carried(motion, [motion.state.convert(e) for e in matrix], own)
            turned = motion.turned(rate, own, frame)
            velocity = [a + b for a, b in zip(velocity, turned, strict=True)]
        return written_in(velocity, frame), written_in(carried(motion, velocity, frame), frame)

    def _way(self, point: Any, axes: Any, base: Any) -> tuple[Vector, ReferenceFrame]:
        """The vector from a base to a point, and the frame in which the result is to be written."""
        end, start = self.point(point), self.origin if base is None else self.point(base)
        if axes is not None:
            return end.pos_from(start), self.frame(axes)
        last = next((s.vector for s in self.steps if s.name == str(end) and s.kind == "point"), Vector(0))
        return end.pos_from(start), last.args[-1][1] if last.args else self.ground

    def __repr__(self) -> str:
        return f"KinematicChain({', '.join(self.points)}; degrees of freedom: {count_in_words(self)})"

    def _repr_html_(self) -> str:
        return as_html(self)
