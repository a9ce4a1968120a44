"""Motions that can be shown: a time history of poses, checked, and brought to the pace of a film."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from engdyn.errors import EngdynError
from engdyn.plots.drawing import checked_pose, structure
from engdyn.plots.projection import View
from engdyn.plots.stage import size_of
from engdyn.plots.words import number

if TYPE_CHECKING:
    from engdyn.system import System

__all__ = ["Motion", "checked_motion", "course_in_words", "mode_motion", "pace_in_words", "shown_speed"]

FILM = (2.0, 60.0)
"""A film that its maker leaves to us lasts so many seconds, at least and at most."""

ROUND = (1.0, 2.0, 5.0)
"""Speeds other than real time are these numbers times a power of ten."""

TURN, TRAVEL, ROOM = 0.3, 0.06, 0.5
"""Amplitudes of a mode: of an angle in rad, of a length as a share of the drawing; and as a share of the room that
the bounds of a coordinate leave, unless that is less than half of them: bounds may be narrow for other reasons."""

SAMPLES = 96
"""Poses per period of a mode."""


@dataclass(frozen=True)
class Motion:
    """Poses over time: ``time`` (N,) in s, increasing; ``q`` (N, n) in m or rad, finite."""

    time: NDArray[np.float64]
    q: NDArray[np.float64]

    @property
    def duration(self) -> float:
        """Seconds from the first to the last pose."""
        return float(self.time[-1] - self.time[0])

    @property
    def closed(self) -> bool:
        """Whether the motion ends in the pose in which it began, so that it can go on for ever."""
        span = np.maximum(np.ptp(self.q, axis=0), 1e-12)
        return bool(np.all(abs(self.q[-1] - self.q[0]) < 1e-6 * span))

    def at(self, time: ArrayLike) -> NDArray[np.float64]:
        """Return poses at other times by linear interpolation, which never goes beyond the given poses."""
        return np.stack([np.interp(time, self.time, column) for column in self.q.T], axis=-1)


def checked_motion(system: System, motion: Any) -> Motion:
    """Return a time history, or a pair of times and poses, as a motion of the system.

    Parameters
    ----------
    system : System
    motion : TimeHistory or (time, q)
        An object with ``.time``, shape (N,), and ``.q``, shape (N, n), or these two arrays.

    Raises
    ------
    EngdynError
        Neither of both; times that do not increase; poses that are not finite or do not fit the system.
    """
    if hasattr(motion, "time") and hasattr(motion, "q"):
        given = motion.time, motion.q
    elif isinstance(motion, tuple | list) and len(motion) == 2:
        given = tuple(motion)
    else:
        raise EngdynError(
            f"a {type(motion).__name__} is no motion: give a time history (with .time and .q), the pair (time, q), "
            "or what mode_motion returned."
        )
    try:
        time, q = (np.array(part, float) for part in given)
    except (TypeError, ValueError):
        raise EngdynError(
            "the motion holds something that is no real number: give time and q as arrays."
        ) from None
    if time.ndim != 1 or len(time) < 2:
        raise EngdynError(f"time has shape {time.shape}: a motion has two times or more, in one row.")
    if not np.all(np.isfinite(time)):
        raise EngdynError(f"time {np.flatnonzero(~np.isfinite(time))[0]} of the motion is not finite.")
    if not np.all(np.diff(time) > 0.0):
        k = int(np.flatnonzero(np.diff(time) <= 0.0)[0])
        raise EngdynError(
            f"time must increase, but {time[k + 1]:g} s follows {time[k]:g} s (entry {k + 1}): sort the samples, "
            "drop those that are there twice."
        )
    return Motion(time, _checked_poses(system, time, q))


def _checked_poses(system: System, time: NDArray, q: NDArray) -> NDArray[np.float64]:
    count, names = len(system.coordinates), ", ".join(c.name for c in system.coordinates)
    if q.ndim == 1 and count == 1:
        q = q[:, None]
    if q.shape != (len(time), count):
        hint = ""
        if q.shape == (count, len(time)):
            hint = " It looks transposed: give q.T."
        elif q.ndim == 2 and len(q) == len(time) and q.shape[1] > count:
            hint = f" If the rows are states (q, u), give their first part, x[:, :{count}]."
        raise EngdynError(
            f"q has shape {q.shape}; {len(time)} times and {system.title} with the coordinates {names} ask for "
            f"({len(time)}, {count}).{hint}"
        )
    bad = np.argwhere(~np.isfinite(q))
    if len(bad):
        k, i = bad[0]
        raise EngdynError(
            f"{system.coordinates[i].name} = {q[k, i]} at t = {time[k]:g} s is not finite: show the motion only until "
            "then, and find out what went wrong there."
        )
    return q


def shown_speed(duration: float, speed: float | None = None) -> float:
    """Return seconds of motion per second of film: real time unless the film would last too short or too long.

    Raises
    ------
    EngdynError
        A speed that is not positive.
    """
    if speed is not None:
        if not (math.isfinite(speed) and speed > 0.0):
            raise EngdynError(f"speed = {speed}: give seconds of motion per second of film, 1 for real time.")
        return float(speed)
    low, high = duration / FILM[1], duration / FILM[0]
    if low <= 1.0 <= high:
        return 1.0
    if high < 1.0:
        return max(step for step in _round_numbers(high) if step <= high * (1.0 + 1e-9))
    return min(step for step in _round_numbers(low) if step >= low * (1.0 - 1e-9))


def _round_numbers(near: float) -> list[float]:
    power = math.floor(math.log10(near))
    return [float(f"{digit:g}e{power + k}") for k in (-1, 0, 1) for digit in ROUND]


def pace_in_words(speed: float) -> str:
    """Say how fast the film runs.

    Examples
    --------
    >>> pace_in_words(1.0), pace_in_words(0.05)
    ('real time', '0.05 × real time')
    """
    return "real time" if abs(speed - 1.0) < 1e-9 else f"{number(speed)} × real time"


def course_in_words(coordinates: Sequence[Any], motion: Motion) -> str:
    """Tell of each coordinate where it begins, ends and goes."""
    told = []
    for coordinate, values in zip(coordinates, motion.q.T, strict=True):
        begin, end, low, high = _rounded(values)
        unit = f" {coordinate.unit}" if coordinate.unit not in ("", "-") else ""
        told.append(
            f"{coordinate.name} begins at {begin}, ends at {end}, lies between {low} and {high}{unit}"
        )
    return "; ".join(told)


def _rounded(values: NDArray[np.float64]) -> list[str]:
    """First, last, least and greatest value, to three digits of the largest: rounding errors stay out."""
    largest = float(np.max(abs(values)))
    digits = min(max(2 - math.floor(math.log10(largest)), 0), 9) if largest > 1e-9 else 0
    chosen = (values[0], values[-1], values.min(), values.max())
    return [f"{round(float(x), digits) + 0.0:.{digits}f}".replace("-", "−") for x in chosen]


def mode_motion(
    q0: ArrayLike,
    shape: ArrayLike,
    frequency: float,
    *,
    system: System | None = None,
    values: Mapping[str, float] | None = None,
    amplitude: float | None = None,
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    r"""One period of a mode as a motion, enlarged until it can be seen: ``animate(system, mode_motion(...))``.

    Course section 6.3: :math:`q(t) = q_0 + \mathrm{Re}\,(a\,\phi\,e^{i 2\pi f t})`. A complex shape shows the
    phases between the coordinates; it is turned so that its largest component begins at its peak. Decay is left
    out, as the film repeats.

    Parameters
    ----------
    q0 : array_like, shape (n,)
        The pose about which the system vibrates [m or rad].
    shape : array_like of float or complex, shape (n,) or (2 n,)
        A column of mode shapes, or an eigenvector of the state matrix, of which the first half counts.
    frequency : float
        Natural frequency in Hz.
    system : System, optional
        Its units, drawing and bounds decide how large the amplitude may be.
    values : mapping of str to float, optional
        Parameters of that drawing.
    amplitude : float, optional
        Largest component of the motion [m or rad]; default: what the drawing of ``system`` shows well,
        0.3 without a system.

    Returns
    -------
    time : ndarray, shape (N,)
        One period [s].
    q : ndarray, shape (N, n)

    Raises
    ------
    EngdynError
        Shapes that do not fit, zero or not finite; a frequency that is not positive.
    """
    pose, phi = _checked_mode(q0, shape)
    if not (np.isscalar(frequency) and np.isreal(frequency) and 0.0 < float(frequency) < math.inf):
        raise EngdynError(
            f"frequency = {frequency}: only what vibrates, at a frequency above 0 Hz, has a period."
        )
    if amplitude is not None and not 0.0 < amplitude < math.inf:
        raise EngdynError(f"amplitude = {amplitude}: give a positive number of m or rad.")
    largest = phi[np.argmax(abs(phi))]
    phi = phi / largest
    if amplitude is None:
        amplitude = TURN if system is None else _visible(system, pose, abs(phi), values)
    time = np.linspace(0.0, 1.0 / float(frequency), SAMPLES + 1)
    turns = np.exp(2j * np.pi * np.linspace(0.0, 1.0, SAMPLES + 1))
    turns[-1] = turns[0]
    return time, pose + amplitude * (turns[:, None] * phi).real


def _checked_mode(q0: ArrayLike, shape: ArrayLike) -> tuple[NDArray[np.float64], NDArray[np.complex128]]:
    try:
        pose, phi = np.atleast_1d(np.array(q0, float)), np.atleast_1d(np.array(shape, complex))
    except (TypeError, ValueError):
        raise EngdynError("q0 and shape must be numbers, one for each coordinate: give arrays.") from None
    if phi.shape == (2 * len(pose),):
        phi = phi[: len(pose)]
    if pose.ndim != 1 or phi.shape != pose.shape:
        raise EngdynError(
            f"q0 has shape {pose.shape} and the mode shape {phi.shape}: give one column with a number per coordinate."
        )
    if not (np.all(np.isfinite(pose)) and np.all(np.isfinite(phi))):
        raise EngdynError("the pose or the mode shape is not finite.")
    if not np.any(phi):
        raise EngdynError("the mode shape is zero: nothing moves.")
    return pose, phi


def _visible(system: System, pose: NDArray, share: NDArray, values: Mapping[str, float] | None) -> float:
    """Return the largest amplitude at which every coordinate keeps to what suits its drawing and its bounds."""
    shapes = structure(system.shapes(checked_pose(system, pose), system.complete(values)))
    size = size_of(shapes, View())
    limits = []
    for coordinate, q in zip(system.coordinates, pose, strict=True):
        limit = TURN if coordinate.unit == "rad" else TRAVEL * size
        if coordinate.bounds is not None:
            room = min(q - coordinate.bounds[0], coordinate.bounds[1] - q)
            limit = min(limit, max(ROOM * room, 0.5 * limit))
        limits.append(limit)
    return float(np.min(np.array(limits)[share > 1e-9] / share[share > 1e-9]))
