"""Angular velocity and angular acceleration of a frame, step by step from the ground.

Course section 1.6: angular velocities of successive frames add; angular accelerations do too, but each
step also brings what the turning of the frames before it does to its axis.  Finite rotations do not add.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np
from sympy.physics.vector import ReferenceFrame, Vector
from sympy.physics.vector.printing import vlatex

from engdyn.errors import EngdynError
from engdyn.modeling.instants import components
from engdyn.modeling.kinematics import carried, motion_of, written_in
from engdyn.modeling.motion import cross, spin_steps

__all__ = ["AngularMotion", "RotationStep", "angular_motion"]


@dataclass(frozen=True)
class RotationStep:
    """What one rotation, of a frame in the frame before it, adds.

    Attributes
    ----------
    frame, parent : ReferenceFrame
        The frame that turns, and in which it turns.
    rate : Vector
        ω_rel, its angular velocity in the parent, as the rotation was defined [rad/s].
    rate_change : Vector
        Derivative of ω_rel seen in the parent: the rate itself changes [rad/s²].
    carried : Vector
        ω_parent × ω_rel: the parent carries the axis along [rad/s²].
    """

    frame: ReferenceFrame
    parent: ReferenceFrame
    rate: Vector
    rate_change: Vector
    carried: Vector


@dataclass(frozen=True)
class AngularMotion:
    """Angular velocity and acceleration of a frame as sums over successive rotations.

    Attributes
    ----------
    frame, ground : ReferenceFrame
        Which frame turns, and from where it is seen.
    steps : tuple of RotationStep
        From the ground outward; each term is written in the axes in which its rotation was defined.
    axes : ReferenceFrame
        The axes in which the two totals are written.
    angular_velocity : Vector
        ω [rad/s].
    angular_acceleration : Vector
        α [rad/s²].
    """

    frame: ReferenceFrame
    ground: ReferenceFrame
    steps: tuple[RotationStep, ...]
    axes: ReferenceFrame
    angular_velocity: Vector
    angular_acceleration: Vector

    def in_axes(self, axes: ReferenceFrame) -> AngularMotion:
        """The same motion with the totals written in other axes."""
        return angular_motion(self.frame, self.ground, axes)

    def terms(self) -> Iterator[tuple[str, Vector]]:
        """Name and vector of every term of α: the change of each rate, and what carries each axis."""
        for step in self.steps:
            yield f"change of the rate of {step.frame}", step.rate_change
            yield f"ω of {step.parent} × rate of {step.frame}", step.carried

    def evaluate(self, values: Mapping[Any, float]) -> dict[str, np.ndarray]:
        """ω and α as numbers.

        Parameters
        ----------
        values : mapping
            As for :func:`engdyn.components`.

        Returns
        -------
        dict of str to ndarray, shape (3,)
            ``"angular_velocity"`` [rad/s] and ``"angular_acceleration"`` [rad/s²] in :attr:`axes`.
        """
        return {
            name: components(getattr(self, name), self.axes, values)
            for name in ("angular_velocity", "angular_acceleration")
        }

    def _repr_latex_(self) -> str:
        omega = _sum([step.rate for step in self.steps])
        alpha = [_sum([step.rate_change for step in self.steps]), *self._carried_latex()]
        rows = [
            rf"{_named('omega', self.frame, self.ground)} &= {omega}",
            rf"{_named('alpha', self.frame, self.ground)} &= {' + '.join(alpha)}",
        ]
        return "$\\displaystyle \\begin{aligned}" + r"\\".join(rows) + r"\end{aligned}$"

    def _carried_latex(self) -> list[str]:
        """Each ω_parent × ω_rel, with its result below a brace."""
        found = []
        for step in self.steps:
            if step.carried != 0:
                product = rf"{_named('omega', step.parent, self.ground)} \times "
                product += _named("omega", step.frame, step.parent)
                found.append(rf"\underbrace{{{product}}}_{{{vlatex(step.carried)}}}")
        return found

    def __repr__(self) -> str:
        return f"AngularMotion({self.frame} in {self.ground}: ω = {self.angular_velocity})"


def angular_motion(
    frame: ReferenceFrame, ground: ReferenceFrame, axes: ReferenceFrame | None = None
) -> AngularMotion:
    """Angular velocity and angular acceleration of a frame by addition over successive rotations.

    Parameters
    ----------
    frame : ReferenceFrame
        Oriented in the ground, directly or through other frames.
    ground : ReferenceFrame
        From where the turning is seen.
    axes : ReferenceFrame, optional
        Axes in which the totals are written; those of `frame` where not given.

    Returns
    -------
    AngularMotion

    Raises
    ------
    EngdynError
        Not a frame, or frames that are not oriented with respect to each other.

    Notes
    -----
    Course section 1.6: ω = Σ ω_rel and α = Σ (dω_rel/dt in the parent + ω_parent × ω_rel).

    Examples
    --------
    >>> import engdyn as ed
    >>> from sympy.physics.mechanics import ReferenceFrame, dynamicsymbols
    >>> psi, beta = dynamicsymbols("psi beta")
    >>> N, A, B = (ReferenceFrame(name) for name in "NAB")
    >>> A.orient_axis(N, psi, N.z)
    >>> B.orient_axis(A, beta, A.y)
    >>> ed.angular_motion(B, N).steps[1].carried
    - Derivative(beta(t), t)*Derivative(psi(t), t)*A.x
    """
    axes = frame if axes is None else axes
    for one in (frame, ground, axes):
        if not isinstance(one, ReferenceFrame):
            raise EngdynError(f"{one!r} is no frame: give a ReferenceFrame of sympy.physics.mechanics")
    rates = spin_steps(frame, ground)
    frames = frame._dict_list(ground, 1) if rates else [frame]
    motion = motion_of(rates, [axes], ground)
    steps = tuple(
        _step(motion, rate, turning, parent)
        for rate, (turning, parent) in zip(rates, pairwise(frames), strict=True)
    )
    spin = motion.angular_velocity(frame, axes)
    totals = written_in(spin, axes), written_in(carried(motion, spin, axes), axes)
    return AngularMotion(frame, ground, steps[::-1], axes, *totals)


def _step(motion: Any, rate: Vector, frame: ReferenceFrame, parent: ReferenceFrame) -> RotationStep:
    """The terms of one rotation, in the axes in which its rate is given (those of the parent else)."""
    own = rate.args[0][1] if len(rate.args) == 1 else parent
    written = motion.components(rate, own)
    relative = motion.components(sum(spin_steps(own, parent), Vector(0)), own)
    change = [a + b for a, b in zip(motion.derivative(written), cross(relative, written), strict=True)]
    carry = cross(motion.angular_velocity(parent, own), written)
    return RotationStep(frame, parent, rate, written_in(change, own), written_in(carry, own))


def _named(letter: str, frame: ReferenceFrame, ground: ReferenceFrame) -> str:
    return rf"\boldsymbol{{\{letter}}}_{{{frame}/{ground}}}"


def _sum(vectors: list[Vector]) -> str:
    """Vectors as a sum in LaTeX; they may be written in different frames."""
    written = [vlatex(vector) for vector in vectors if vector != 0]
    return " + ".join(written).replace("+ -", "- ").replace("+  -", "- ") or "0"
