"""Moving drawings: any time history or mode on the system's own drawing, as a player, a strobe or a file."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from functools import cached_property, lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import ArrayLike, NDArray

from engdyn.errors import EngdynError
from engdyn.plots.alternative import bundle, describe
from engdyn.plots.drawing import structure
from engdyn.plots.motion import Motion, checked_motion, course_in_words, pace_in_words, shown_speed
from engdyn.plots.projection import View
from engdyn.plots.stage import Stage, encoded, lasting_ground, size_of
from engdyn.plots.strobe import apart, draw_strobe, features
from engdyn.shapes import Ground, Shape

if TYPE_CHECKING:
    from engdyn.system import System

__all__ = ["Animation", "animate"]

MOST = 15_000
"""More frames than these nobody watches."""

POSES = 7
"""Poses of a strobe picture."""

FINE = 4
"""In a player the time between two frames can be passed in so many steps, for slow motion that is smooth."""


class Animation:
    """A motion of a system that can be played, looked at in one picture, and saved. Made by `animate`.

    Attributes
    ----------
    system : System
    values : dict of str to float
        Parameters of the drawing.
    time : ndarray, shape (N,)
        Time of each frame [s], evenly spaced.
    q : ndarray, shape (N, n)
        Pose of each frame.
    speed : float
        Seconds of motion per second of film.
    rate : float
        Frames per second of film.
    repeats : bool
        Whether the motion ends where it began: the film then goes on without a jump.
    """

    def __init__(
        self,
        system: System,
        motion: Motion,
        values: Mapping[str, float],
        speed: float,
        rate: float,
        view: View,
    ) -> None:
        steps = max(round(motion.duration / speed * rate), 1)
        if steps > MOST:
            raise EngdynError(
                f"{motion.duration:g} s at speed {speed:g} would be {steps} frames: choose a speed of "
                f"{motion.duration * rate / MOST:.2g} or more, or show a part of the motion."
            )
        self.system, self.values, self.speed, self.rate = system, dict(values), speed, rate
        self._motion, self._view, self.repeats = motion, view, motion.closed
        times = np.linspace(motion.time[0], motion.time[-1], steps + 1)
        self.time = times[:-1] if self.repeats else times
        self.q = motion.at(self.time)
        # The last pose is shown exactly, so frames may be a little shorter or longer than 1/rate.
        self._step = motion.duration / steps
        self._digits = max(math.ceil(-math.log10(self._step) - 1e-9), 0)
        self._png_at = lru_cache(maxsize=400)(lambda tick: encoded(self._picture(self._moment(tick))))

    def __len__(self) -> int:
        return len(self.time)

    def __repr__(self) -> str:
        return f"Animation({self.system.title}; {len(self)} frames, {self._span})"

    # One frame

    def frame(self, k: int) -> NDArray[np.uint8]:
        """Return frame ``k`` as a picture, shape (height, width, 3); negative numbers count from the end."""
        return self._picture(float(self.time[self._checked(k)]))

    def png(self, k: int) -> bytes:
        """Return frame ``k`` as a PNG file."""
        return self._png_at(FINE * self._checked(k))

    def _checked(self, k: int) -> int:
        if not -len(self) <= k < len(self):
            raise EngdynError(f"there is no frame {k}: the animation has frames 0 to {len(self) - 1}.")
        return int(k) % len(self)

    @cached_property
    def _drawings(self) -> list[list[Shape]]:
        return [structure(self.system.shapes(q, self.values)) for q in self.q]

    @cached_property
    def _ground(self) -> dict[int, Ground]:
        return lasting_ground(self._drawings)

    @cached_property
    def _stage(self) -> Stage:
        return Stage([self._grounded(shapes) for shapes in self._drawings], self._view)

    def _grounded(self, shapes: list[Shape]) -> list[Shape]:
        return [self._ground.get(i, shape) for i, shape in enumerate(shapes)]

    def _shapes(self, q: ArrayLike) -> list[Shape]:
        return self._grounded(structure(self.system.shapes(q, self.values)))

    def _picture(self, time: float) -> NDArray[np.uint8]:
        pace = "" if self.speed == 1.0 else f"   ({pace_in_words(self.speed)})"
        return self._stage.picture(self._shapes(self._motion.at(time)), f"t = {self._clock(time)} s{pace}")

    def _clock(self, time: float) -> str:
        return f"{time + 0.0:.{self._digits}f}".replace("-", "−")

    # Playing

    @property
    def ticks(self) -> int:
        """Number of the finest steps of a player; `FINE` of them pass from frame to frame."""
        return FINE * len(self) if self.repeats else FINE * (len(self) - 1) + 1

    def _moment(self, tick: int) -> float:
        return min(float(self.time[0] + tick * self._step / FINE), float(self._motion.time[-1]))

    @cached_property
    def player(self) -> Any:
        """The player for notebooks, see :class:`engdyn.plots.player.Player`."""
        from engdyn.plots.player import Player

        return Player(
            picture=self._png_at,
            start=float(self.time[0]),
            step=self._step / FINE,
            ticks=self.ticks,
            fine=FINE,
            seconds=self._step / self.speed,
            speed=self.speed,
            words=self.words,
        )

    def _repr_mimebundle_(self, include: Any = None, exclude: Any = None) -> tuple[dict, dict]:
        """The player, and beside it the strobe picture and its words for readers without a kernel."""
        still, metadata = bundle(self.strobe())
        return {**(self.player.widget._repr_mimebundle_() or {}), **still}, metadata

    # Words

    @property
    def _span(self) -> str:
        return f"t = {self._clock(self.time[0])} s to {self._clock(self._motion.time[-1])} s"

    @cached_property
    def words(self) -> str:
        """What moves, how long, how fast and how far, in words."""
        told = course_in_words(self.system.coordinates, self._motion)
        pace = "in real time" if self.speed == 1.0 else f"at {pace_in_words(self.speed)}"
        again = ", again and again" if self.repeats else ""
        return f"{self.system.title} in motion, {self._span}{again}, shown {pace}. {told}."

    # One picture of the whole motion

    def strobe(self, ax: Axes | None = None, *, poses: int | Sequence[float] = POSES) -> Axes:
        """Draw several poses of the motion on top of each other, early ones faint, the last one strong.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            Where to draw; default: new axes of a new figure.
        poses : int or sequence of float
            How many: these are chosen among the frames so that they differ as much as possible. Or their
            times [s]: at equal intervals the distances show how fast the bodies are.

        Returns
        -------
        matplotlib.axes.Axes

        Raises
        ------
        EngdynError
            No pose, or times outside the motion.
        """
        times = self._strobe_times(poses)
        ends = [f"{self._clock(time)} s" for time in times]
        heading = f"t = {ends[0]}" + (f" … {ends[-1]}" if len(ends) > 1 else "")
        drawings = [self._shapes(self._motion.at(time)) for time in times]
        ax = draw_strobe(drawings, heading, ax, self._view)
        count = f"{len(times)} poses from faint to strong" if len(times) > 1 else "one pose"
        describe(ax, f"Strobe picture, {count}. {self.words}")
        return ax

    def _strobe_times(self, poses: int | Sequence[float]) -> NDArray[np.float64]:
        if isinstance(poses, int | np.integer):
            if poses < 1:
                raise EngdynError(f"poses = {poses}: a picture shows one pose at least.")
            size = size_of(self._shapes(self.q[0]), self._view)
            return self.time[apart(features(self.system.coordinates, self.q, size), int(poses))]
        times, (first, last) = np.sort(np.array(poses, float).ravel()), self._motion.time[[0, -1]]
        if not (len(times) and np.all((first <= times) & (times <= last))):
            raise EngdynError(f"poses = {poses}: give times between {first:g} s and {last:g} s.")
        return times

    def save(self, path: str | Path, *, overwrite: bool = False) -> Path:
        """Write the animation to a file.

        Parameters
        ----------
        path : str or Path
            Ends with ``.gif``, ``.html`` (a page with a player that needs nothing else) or ``.mp4`` (needs the
            program ffmpeg).
        overwrite : bool
            Replace a file that exists.

        Returns
        -------
        Path
            Where the file is.

        Raises
        ------
        EngdynError
            Another ending; the file exists; its folder does not; there is no ffmpeg.
        """
        from engdyn.plots.films import save

        ends = np.round(np.arange(len(self) + 1) * self._step / self.speed, 9)
        return save(self, Path(path), ends, overwrite)


def animate(
    system: System,
    motion: Any,
    values: Mapping[str, float] | None = None,
    *,
    speed: float | None = None,
    rate: float = 25.0,
    view: View | None = None,
) -> Animation:
    """Set the drawing of a system in motion.

    Course appendix A. In a notebook the result shows itself as a player; see `Animation` for the strobe picture
    and for files. All frames have the same scale and limits.

    Parameters
    ----------
    system : System
    motion : TimeHistory or (time, q)
        An object with ``.time`` (N,) [s] and ``.q`` (N, n), a pair of such arrays, or what `mode_motion` returns.
        The times need not be evenly spaced: frames are interpolated.
    values : mapping of str to float, optional
        Parameter values in SI units; what is not given has its default.
    speed : float, optional
        Seconds of motion per second of film. Default: 1 (real time), but a film that would last less than 2 s is
        slowed down and one that would last more than a minute is sped up, by a round number.
    rate : float
        Frames per second of film, 1 to 50.
    view : View, optional
        From where a system in space is seen.

    Returns
    -------
    Animation

    Raises
    ------
    EngdynError
        What is no motion of this system, says where; ParameterError for ``values`` that are not admissible.

    Examples
    --------
    >>> import numpy as np
    >>> import engdyn as ed
    >>> time = np.linspace(0.0, 2.0, 41)
    >>> q = np.column_stack([0.0 * time, 0.3 * np.cos(3.0 * time)])
    >>> ed.plots.animate(ed.systems.load("S07"), (time, q))
    Animation(...; 51 frames, t = 0.00 s to 2.00 s)
    """
    if not 1.0 <= rate <= 50.0:
        raise EngdynError(f"rate = {rate}: give 1 to 50 frames per second.")
    checked = checked_motion(system, motion)
    speed = shown_speed(checked.duration, speed)
    return Animation(system, checked, system.complete(values), speed, float(rate), view or View())
