"""Free bodies: what is cut free, with every load that acts on it.  Course section 2.4."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TypeAlias

from sympy.physics.mechanics import Force, Particle, RigidBody, Torque
from sympy.physics.vector import Point, ReferenceFrame, Vector

from engdyn.errors import EngdynError
from engdyn.modeling.motion import measure_numbers

__all__ = ["FreeBody", "arm_of", "load_vector"]

Load: TypeAlias = Force | Torque


@dataclass(frozen=True)
class FreeBody:
    """A free-body diagram: one body, the known loads on it and the unknown reactions.

    Parameters
    ----------
    body : sympy.physics.mechanics.Particle or RigidBody
    applied : sequence of Force or Torque
        Known loads: weight, springs, dampers, inputs [N, N m].
    reactions : sequence of Force or Torque
        Loads whose magnitudes are unknown: bearings, guides, rods [N, N m].

    Notes
    -----
    Course section 2.4.  Write every load as the body feels it: an action here is a reaction with
    the opposite sign on the other body.
    """

    body: Particle | RigidBody
    applied: Sequence[Load] = ()
    reactions: Sequence[Load] = ()

    def __post_init__(self) -> None:
        if not isinstance(self.body, Particle | RigidBody):
            raise EngdynError(f"a free body needs a Particle or a RigidBody, not {self.body!r}")
        for kind in ("applied", "reactions"):
            loads = getattr(self, kind)
            loads = (loads,) if isinstance(loads, Force | Torque) else tuple(loads)
            for load in loads:
                if not isinstance(load, Force | Torque):
                    raise EngdynError(
                        f"{load!r} among the {kind} loads of {self.name} is neither a Force nor a Torque"
                    )
            object.__setattr__(self, kind, loads)

    @property
    def name(self) -> str:
        """Name of the body."""
        return self.body.name

    @property
    def center(self) -> Point:
        """The particle's point, or the body's mass center."""
        return self.body.point if isinstance(self.body, Particle) else self.body.masscenter

    @property
    def turns(self) -> bool:
        """Whether moments matter: a rigid body, or a particle never."""
        return isinstance(self.body, RigidBody)

    def vectors(self) -> list[Vector]:
        """All load vectors."""
        return [load_vector(load) for load in (*self.applied, *self.reactions)]

    def scalars(self) -> list:
        """Mass, inertia and load measure numbers as expressions."""
        inertia = [self.body.central_inertia] if self.turns else []
        return measure_numbers(self.body.mass, *inertia, *self.vectors())

    def preferred_frame(self, inertial: ReferenceFrame) -> ReferenceFrame:
        """The frame in which most reactions are written: balances are shortest there."""
        frames = [frame for load in self.reactions for _, frame in load_vector(load).args]
        return max(frames, key=frames.count) if frames else inertial


def load_vector(load: Load) -> Vector:
    """The vector of a force or a torque."""
    return load.force if isinstance(load, Force) else load.torque


def arm_of(force: Force, body: FreeBody) -> Vector:
    """Vector from the mass center of a body to the point where a force acts."""
    try:
        return force.point.pos_from(body.center)
    except ValueError as error:
        raise EngdynError(
            f"the point {force.point} of a force on {body.name} is not placed relative to its mass center "
            f"{body.center}: place it with locatenew or set_pos"
        ) from error
