"""The steps of a kinematic analysis, and what they leave free.  Course section 1.2."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import sympy as sm
from sympy.physics.mechanics import Particle, RigidBody
from sympy.physics.vector import Point, ReferenceFrame, Vector

from engdyn.algebra.expressions import as_expression
from engdyn.algebra.readable import to_sympy, tree
from engdyn.errors import EngdynError
from engdyn.modeling.kinematics import motion_of
from engdyn.modeling.mobility import functions_in, rank, rank_at
from engdyn.modeling.motion import measure_numbers, path_of_point, rotation_steps

__all__ = ["ChainStep", "Steps"]


@dataclass(frozen=True)
class ChainStep:
    """One step of a kinematic analysis.

    Attributes
    ----------
    kind : {"fixed point", "moving point", "frame", "point", "constraint"}
    name : str
    start : str
        The point or the frame from which the step goes; empty for the first one.
    vector : Vector or expression
        Relative position [m], relative angular velocity [rad/s], or what a constraint makes zero.
    meaning : str
    """

    kind: str
    name: str
    start: str
    vector: Any
    meaning: str


class Steps:
    """Points and frames, added one by one from a fixed point, and the count of what is free to move.

    Parameters are those of :class:`engdyn.KinematicChain`, which adds the differentiation.
    """

    def __init__(
        self,
        ground: ReferenceFrame | str = "N",
        origin: Point | str = "O",
        prescribed: Sequence[sm.Expr] = (),
    ):
        self.ground = ReferenceFrame(ground) if isinstance(ground, str) else ground
        self.origin = Point(origin) if isinstance(origin, str) else origin
        if not isinstance(self.ground, ReferenceFrame) or not isinstance(self.origin, Point):
            raise EngdynError(f"ground {ground!r} and origin {origin!r}: give a ReferenceFrame and a Point")
        self.prescribed = tuple(as_expression(q, "a prescribed motion") for q in prescribed)
        self.points: dict[str, Point] = {}
        self.frames: dict[str, ReferenceFrame] = {str(self.ground): self.ground}
        self.steps: list[ChainStep] = []
        self.constraints: list[sm.Expr] = []
        try:
            path_of_point(self.origin, self.ground)
        except EngdynError:
            self.origin.set_vel(self.ground, 0)
        given = self.origin._vel_dict.get(self.ground)
        self._last = self._enter(self.points, self.origin)
        kind = "fixed point" if given == 0 else "moving point"
        self._record(kind, self.origin, "", given or Vector(0), "")

    # Steps

    def turn(
        self,
        name: str,
        about: Vector,
        by: sm.Expr,
        parent: ReferenceFrame | str | None = None,
        meaning: str = "",
    ) -> ReferenceFrame:
        """Add a frame that turns about an axis.

        Parameters
        ----------
        name : str
        about : Vector
            The axis, fixed in the parent.
        by : expression
            Angle of rotation, right-handed about the axis [rad].
        parent : ReferenceFrame or str, optional
            In which the frame turns; the one in which the axis is written where not given.
        meaning : str
            What turns, in words.

        Returns
        -------
        ReferenceFrame
        """
        if not isinstance(about, Vector) or len(about.args) != 1:
            raise EngdynError(f"the axis {about!r} of frame {name}: give a vector in one frame, such as N.z")
        before = about.args[0][1] if parent is None else self.frame(parent)
        by = as_expression(by, f"the angle of frame {name}")
        self._check_name(name)
        self._reach(before)
        frame = ReferenceFrame(name)
        try:
            frame.orient_axis(before, about, by)
        except ValueError as error:
            raise EngdynError(
                f"the axis {about} of frame {name} is not fixed in {before}: {error}"
            ) from error
        self._enter(self.frames, frame)
        self._record("frame", frame, before, frame.ang_vel_in(before), meaning)
        return frame

    def move(self, name: str, vector: Vector, start: Point | str | None = None, meaning: str = "") -> Point:
        """Add a point at the end of a relative position vector.

        Parameters
        ----------
        name : str
        vector : Vector
            From `start` to the new point [m], written in any frames.
        start : Point or str, optional
            The last point added where not given.
        meaning : str
            What the point is, in words: a joint, a mass center.

        Returns
        -------
        Point
        """
        if not isinstance(vector, Vector):
            raise EngdynError(f"the way to {name} is {vector!r}: give a Vector such as r * A.x")
        self._check_name(name)
        before = self._last if start is None else self.point(start)
        for _, frame in vector.args:
            self._reach(frame)
        self._last = self._enter(self.points, before.locatenew(name, vector))
        self._record("point", name, before, vector, meaning)
        return self._last

    def add(self, *items: Any) -> None:
        """Take in existing frames, points, particles or rigid bodies of sympy.physics.mechanics.

        Frames must be oriented in the ground, points placed from a point of the chain.
        """
        for item in items:
            if isinstance(item, Particle | RigidBody):
                self.add(*([item.frame] if isinstance(item, RigidBody) else []), _center(item))
            elif isinstance(item, ReferenceFrame):
                self._reach(item)
            elif isinstance(item, Point):
                self._connect(item)
            else:
                raise EngdynError(f"{item!r} is neither a frame nor a point nor a body")

    def constrain(self, *conditions: sm.Expr | Vector, meaning: str = "") -> None:
        """Add constraints: expressions, or components of vectors, that are zero.

        Parameters
        ----------
        *conditions : expression or Vector
            Positions (a loop that closes: a vector that is zero), or velocities where rates of the
            coordinates appear (rolling).
        meaning : str
            What constrains, in words.
        """
        for condition in conditions:
            if isinstance(condition, Vector):
                motion = motion_of([condition], [], self.ground)
                parts = [to_sympy(tree(c)) for c in motion.components(condition, self.ground)]
            else:
                parts = [as_expression(condition, "a constraint")]
            parts = [part for part in parts if part != 0]
            for part in parts:
                if not functions_in(part):
                    raise EngdynError(f"the constraint {part} = 0 contains no coordinate")
            self.constraints += parts
            for part in parts:
                self._record("constraint", f"{len(self.constraints)}", "", part, meaning)

    # Degrees of freedom

    @property
    def coordinates(self) -> tuple[sm.Expr, ...]:
        """All coordinates, in the order in which they appear; prescribed motions are none."""
        found: dict[sm.Expr, None] = {}
        for step in self.steps:
            if step.kind == "frame":
                scalars = measure_numbers(*rotation_steps(self.frames[step.start], self.frames[step.name]))
            else:
                scalars = measure_numbers(step.vector)
            found |= dict.fromkeys(functions_in(*scalars))
        return tuple(q for q in found if q not in self.prescribed)

    @property
    def degrees_of_freedom(self) -> int:
        """Coordinates minus independent constraints, at a configuration in general position.

        Where bodies are held more than necessary (a third bar in a parallelogram), ask
        :meth:`degrees_of_freedom_at`.
        """
        return len(self.coordinates) - rank(self.coordinates, self.constraints)

    def degrees_of_freedom_at(self, values: Mapping[Any, float]) -> int:
        """Degrees of freedom at one configuration, from the rank of the constraints there.

        Parameters
        ----------
        values : mapping
            Coordinates (and rates where constraints contain them) and parameters → numbers [SI].

        Raises
        ------
        EngdynError
            The configuration does not satisfy the constraints, or a number is missing.
        """
        return len(self.coordinates) - rank_at(self.coordinates, self.constraints, values)

    # What is known

    def point(self, point: Any) -> Point:
        """A point of the chain, by name, as it is, or as the mass center of a body."""
        return self._known(self.points, _center(point), "point")

    def frame(self, frame: Any) -> ReferenceFrame:
        """A frame of the chain, by name, as it is, or as that of a rigid body."""
        return self._known(self.frames, frame.frame if isinstance(frame, RigidBody) else frame, "frame")

    def _known(self, known: dict[str, Any], wanted: Any, kind: str) -> Any:
        found = known.get(str(wanted))
        if found is None or not (isinstance(wanted, str) or wanted is found):
            raise EngdynError(
                f"the chain has no {kind} {wanted!r}: it has {', '.join(known)}; take in others with add()"
            )
        return found

    def _check_name(self, name: str) -> None:
        if not isinstance(name, str) or not name:
            raise EngdynError(f"{name!r} is no name: give text such as 'A'")
        if name in self.points or name in self.frames:
            raise EngdynError(f"the chain has a point or frame {name} already: choose another name")

    def _enter(self, known: dict[str, Any], item: Any) -> Any:
        if known.setdefault(str(item), item) is not item:
            raise EngdynError(f"the chain has another {type(item).__name__} named {item}: rename one of them")
        return item

    def _record(self, kind: str, item: Any, start: Any, vector: Any, meaning: str) -> None:
        self.steps.append(ChainStep(kind, str(item), str(start), vector, meaning))

    def _reach(self, frame: ReferenceFrame) -> None:
        """Enter a frame and those between it and the ground."""
        rotation_steps(self.ground, frame)  # refuses what is not oriented
        way = self.ground._dict_list(frame, 0)
        for parent, one in pairwise(way):
            if self.frames.get(str(one)) is not one:
                self._enter(self.frames, one)
                self._record("frame", one, parent, one.ang_vel_in(parent), "")

    def _connect(self, point: Point) -> None:
        """Enter a point that is placed from the chain, and those between."""
        if self.points.get(str(point)) is point:
            return
        waiting, seen = [[point]], {point}
        while waiting:
            way = waiting.pop(0)
            if self.points.get(str(way[-1])) is way[-1]:
                for end, start in reversed(list(pairwise(way))):
                    for _, frame in end._pos_dict[start].args:
                        self._reach(frame)
                    self._last = self._enter(self.points, end)
                    self._record("point", end, start, end._pos_dict[start], "")
                return
            waiting += [[*way, p] for p in way[-1]._pos_dict if p not in seen]
            seen |= set(way[-1]._pos_dict)
        raise EngdynError(f"{point} is not placed from a point of the chain: use locatenew or set_pos")


def _center(item: Any) -> Any:
    """The point that stands for a particle or a rigid body."""
    if isinstance(item, Particle):
        return item.point
    return item.masscenter if isinstance(item, RigidBody) else item
