"""Equilibria of a body that may take any attitude: two sequences of Euler angles, joined.  Course section 4.2.

Yaw, pitch and roll (3-2-1) fail where the body's axis 1 is along the axis 3 of the reference, the angles of the
sequence 2-3-1 where it is along the axis 2. As these two are at right angles, an attitude that is too near to
the first failure is far from the second: two searches, each with its middle angle bounded, together cover
all attitudes. What both find is one attitude if the rotation matrices agree. J. Stuelpnagel, "On the
parametrization of the three-dimensional rotation group", SIAM Review 6 (1964).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from math import atan2, cos, hypot, pi, sin
from typing import Any

import numpy as np

from engdyn.analysis.boxes import Box
from engdyn.analysis.enclosure import Certificate
from engdyn.analysis.equilibrium import equilibria
from engdyn.analysis.results import Equilibrium, EquilibriumSet
from engdyn.modeling.equations import EquationsOfMotion
from engdyn.modeling.numbers import mass_and_force
from engdyn.system import System

__all__ = [
    "AttitudeSystem",
    "SequenceCertificates",
    "angles_231",
    "angles_321",
    "matrix_231",
    "matrix_321",
]

PITCH = 1.4
"""Bound of the middle angle of the first search [rad]."""

SECOND = pi / 2 - PITCH + 0.05
"""Bound of the middle angle of the second [rad]: axis 1 leaves at most this angle to the plane 3-1."""

SAME = 1e-6
"""Largest difference of two rotation matrices of one attitude."""


def _turn(axis: int, angle: float) -> np.ndarray:
    """Components in the old axes = this matrix times those in the axes turned about one of them."""
    j, k = (axis + 1) % 3, (axis + 2) % 3
    matrix = np.eye(3)
    matrix[j, j] = matrix[k, k] = cos(angle)
    matrix[j, k], matrix[k, j] = -sin(angle), sin(angle)
    return matrix


def matrix_321(q: Sequence[float]) -> np.ndarray:
    """Rotation matrix of yaw, pitch and roll: its columns are the body axes in the reference axes."""
    return _turn(2, q[0]) @ _turn(1, q[1]) @ _turn(0, q[2])


def matrix_231(q: Sequence[float]) -> np.ndarray:
    """Rotation matrix of the angles about 2, the new 3 and the new 1."""
    return _turn(1, q[0]) @ _turn(2, q[1]) @ _turn(0, q[2])


def angles_321(matrix: np.ndarray) -> np.ndarray:
    """Yaw, pitch (within ±π/2) and roll of a rotation matrix; without roll where axis 1 is vertical.

    Examples
    --------
    >>> angles_321(matrix_321([0.3, -0.4, 2.0]))
    array([ 0.3, -0.4,  2. ])
    """
    R = np.asarray(matrix, float)
    level = hypot(R[0, 0], R[1, 0])
    if level < SAME:
        return np.array([_angle(-R[0, 1], R[1, 1]), -np.copysign(pi / 2, R[2, 0]), 0.0])
    return np.array([_angle(R[1, 0], R[0, 0]), atan2(-R[2, 0], level), _angle(R[2, 1], R[2, 2])])


def angles_231(matrix: np.ndarray) -> np.ndarray:
    """Angles of the sequence 2-3-1 of a rotation matrix, away from its own singularity."""
    R = np.asarray(matrix, float)
    level = hypot(R[0, 0], R[2, 0])
    return np.array([_angle(-R[2, 0], R[0, 0]), atan2(R[1, 0], level), _angle(-R[1, 2], R[1, 1])])


def _angle(sine: float, cosine: float) -> float:
    """The angle in (−π, π]; what is −π but for rounding is π."""
    angle = atan2(sine, cosine)
    return angle + 2 * pi if angle < SAME - pi else angle


@dataclass(frozen=True)
class SequenceCertificates:
    """What two searches, one in each sequence of angles, proved together; see Certificate."""

    sequences: tuple[Certificate, ...]

    @property
    def certified(self) -> bool:
        """Whether both searches found all there is in their regions, which together hold all attitudes."""
        return all(c.certified for c in self.sequences)

    @property
    def accepted(self) -> tuple[Box, ...]:
        """Boxes of either sequence that hold exactly one equilibrium; some are found in both."""
        return tuple(box for c in self.sequences for box in c.accepted)

    @property
    def rejected(self) -> tuple[Box, ...]:
        """Boxes of either sequence that hold none."""
        return tuple(box for c in self.sequences for box in c.rejected)

    @property
    def undecided(self) -> tuple[Box, ...]:
        """Boxes of either sequence about which nothing is claimed."""
        return tuple(box for c in self.sequences for box in c.undecided)

    @property
    def roots(self) -> tuple[Box, ...]:
        """Enclosures of what either sequence found, in its own angles."""
        return tuple(box for c in self.sequences for box in c.roots)

    @property
    def examined(self) -> int:
        """Number of boxes looked at."""
        return sum(c.examined for c in self.sequences)


class AttitudeSystem(System):
    """A system whose coordinates are yaw, pitch and roll of one body.

    Parameters
    ----------
    charts : callable
        Returns equations of motion of the body in its angles of the sequences 3-2-1 and 2-3-1.
    **rest :
        As for System.
    """

    def __init__(self, *, charts: Callable[[], tuple[EquationsOfMotion, EquationsOfMotion]], **rest: Any):
        super().__init__(**rest)
        self._charts = charts

    @cached_property
    def charts(self) -> tuple[EquationsOfMotion, EquationsOfMotion]:
        """Equations of motion in the sequences 3-2-1 and 2-3-1: one of them is regular at any attitude."""
        return self._charts()

    def equilibria(self, values: Mapping[str, float] | None = None, **inputs: Any) -> EquilibriumSet:
        """All attitudes of equilibrium, each once, whatever its Euler angles.

        Parameters
        ----------
        values : mapping of str to float, optional
            Parameters by name [SI]; the defaults where not given.
        **inputs : float
            Constant inputs by name.

        Notes
        -----
        Where pitch is ±90 degrees, yaw and roll are one angle: roll is reported as zero, and small motion is
        described in other coordinates; see :meth:`regular`.
        """
        complete, question = self._question(values, inputs)
        found, certificates = [], []
        for eom, bound in zip(self.charts, (PITCH, SECOND), strict=True):
            first, middle, last = (q.func.__name__ for q in eom.coordinates)
            bounds = {first: (-pi, pi), middle: (-bound, bound), last: (-pi, pi)}
            found.append(equilibria(eom, complete, **(question | {"bounds": bounds})))
            certificates.append(found[-1].certificate)
        items = [_moved(e, self.equations, e.q) for e in found[0]]
        for item in (self._in_321(e) for e in found[1]):
            R = matrix_321(item.q)
            if all(np.max(np.abs(R - matrix_321(other.q))) > SAME for other in items):
                items.append(item)
        items = [self._with_regular(e) for e in items]
        items.sort(key=lambda e: tuple(np.round(e.q, 9)))
        certificate = None if None in certificates else SequenceCertificates(tuple(certificates))
        return replace(found[0], items=tuple(items), certificate=certificate)

    def regular(self, equilibrium: Equilibrium) -> tuple[EquationsOfMotion, Equilibrium]:
        """Equations of motion that are regular at an equilibrium, and the equilibrium in their coordinates.

        Parameters
        ----------
        equilibrium : Equilibrium
            One of :meth:`equilibria`.

        Returns
        -------
        EquationsOfMotion, Equilibrium
            In yaw, pitch and roll where these do. :func:`engdyn.linearize` asks for it by itself.
        """
        if abs(sin(equilibrium.q[1])) <= sin(PITCH):
            return self.equations, equilibrium
        eom = self.charts[1]
        return eom, _moved(equilibrium, eom, angles_231(matrix_321(equilibrium.q)))

    def _with_regular(self, e: Equilibrium) -> Equilibrium:
        """The equilibrium, with other coordinates at hand where its own fail."""
        eom, other = self.regular(e)
        if other is e:
            return e
        return replace(e, regular=(eom, other))

    def _in_321(self, equilibrium: Equilibrium) -> Equilibrium:
        return _moved(equilibrium, self.equations, angles_321(matrix_231(equilibrium.q)))


def _moved(equilibrium: Equilibrium, eom: EquationsOfMotion, q: np.ndarray) -> Equilibrium:
    """The same attitude, at rest, in the coordinates of other equations."""
    q = np.where(np.abs(q) < 1e-12, 0.0, q)
    _, force = mass_and_force(eom, q, equilibrium.speeds, equilibrium.values, equilibrium.inputs)
    names = tuple(c.func.__name__ for c in eom.coordinates)
    return replace(equilibrium, q=q, residual=float(np.max(np.abs(force))), names=names)
