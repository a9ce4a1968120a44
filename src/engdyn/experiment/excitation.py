"""Excitations of a test as functions of time: impact, sine, chirp and noise, with exact derivatives.  Section 9.1."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from engdyn.errors import EngdynError

__all__ = ["Excitation", "chirp", "impact", "random_noise", "sine"]

Function = Callable[[Any], Any]


@dataclass(frozen=True, repr=False)
class Excitation:
    """A function of time, for a force or for a prescribed motion.

    ``excitation(t)`` is its value; a prescribed motion takes ``excitation.motion``.

    Attributes
    ----------
    value, rate, acceleration : callable
        Of the time [s], a number or an array; the derivatives are exact.
    description : str
    """

    value: Function
    rate: Function
    acceleration: Function
    description: str

    @property
    def motion(self) -> tuple[Function, Function, Function]:
        """Value, rate and acceleration."""
        return self.value, self.rate, self.acceleration

    def __call__(self, t: Any) -> Any:
        return self.value(t)

    def __repr__(self) -> str:
        return f"Excitation({self.description})"


def _positive(**given: Any) -> list[float]:
    for name, value in given.items():
        if not (isinstance(value, int | float | np.number) and np.isfinite(value) and value > 0):
            raise EngdynError(f"{name} is {value!r}: give a positive number")
    return [float(value) for value in given.values()]


def sine(amplitude: float, frequency: float, phase: float = 0.0) -> Excitation:
    """amplitude · sin(2π frequency t + phase).

    Parameters
    ----------
    amplitude : float
    frequency : float
        [Hz]
    phase : float
        [rad]
    """
    (frequency,) = _positive(frequency=frequency)
    omega = 2 * np.pi * frequency
    return Excitation(
        lambda t: amplitude * np.sin(omega * np.asarray(t) + phase),
        lambda t: amplitude * omega * np.cos(omega * np.asarray(t) + phase),
        lambda t: -amplitude * omega**2 * np.sin(omega * np.asarray(t) + phase),
        f"sine of {amplitude:g} at {frequency:g} Hz",
    )


def impact(peak: float, duration: float, start: float = 0.0) -> Excitation:
    """The blow of a hammer: peak · sin²(π (t − start)/duration) while it lasts.

    Parameters
    ----------
    peak : float
    duration, start : float
        [s]

    Notes
    -----
    The impulse is peak · duration/2.  Its spectrum is flat up to about 1/(2 duration) and first zero at 2/duration.
    """
    (duration,) = _positive(duration=duration)
    omega = 2 * np.pi / duration

    def while_lasting(function: Function) -> Function:
        def of_time(t: Any) -> Any:
            since = np.asarray(t) - start
            return np.where((since > 0) & (since < duration), function(since), 0.0)

        return of_time

    return Excitation(
        while_lasting(lambda s: peak / 2 * (1 - np.cos(omega * s))),
        while_lasting(lambda s: peak / 2 * omega * np.sin(omega * s)),
        while_lasting(lambda s: peak / 2 * omega**2 * np.cos(omega * s)),
        f"impact of {peak:g} for {duration:g} s",
    )


def chirp(
    amplitude: float, first: float, last: float, duration: float, logarithmic: bool = False
) -> Excitation:
    """A sine whose frequency moves from first to last [Hz] within the duration [s], and on beyond it.

    Parameters
    ----------
    amplitude : float
    first, last : float
        Frequencies at t = 0 and t = duration [Hz].
    duration : float
        [s]
    logarithmic : bool
        Equal times for equal ratios of frequency, instead of for equal differences.

    Notes
    -----
    The phase is the integral of the frequency, 2π (f₀ t + (f₁ − f₀) t²/(2T)) for a linear chirp: sin(2π f(t) t) would
    end at twice the sweep.
    """
    first, last, duration = _positive(first=first, last=last, duration=duration)
    growth = np.log(last / first) / duration
    if not logarithmic or growth == 0:
        slope = (last - first) / duration
        frequency = (lambda t: first + slope * t, lambda t: slope)
        turns: Function = lambda t: first * t + slope * t**2 / 2  # noqa: E731
    else:
        frequency = (lambda t: first * np.exp(growth * t), lambda t: first * growth * np.exp(growth * t))
        turns = lambda t: first * np.expm1(growth * t) / growth  # noqa: E731

    def acceleration(t: Any) -> Any:
        t = np.asarray(t)
        phase, omega, change = (2 * np.pi * x(t) for x in (turns, *frequency))
        return amplitude * (change * np.cos(phase) - omega**2 * np.sin(phase))

    return Excitation(
        lambda t: amplitude * np.sin(2 * np.pi * turns(np.asarray(t))),
        lambda t: (
            amplitude * 2 * np.pi * frequency[0](np.asarray(t)) * np.cos(2 * np.pi * turns(np.asarray(t)))
        ),
        acceleration,
        f"chirp of {amplitude:g} from {first:g} to {last:g} Hz in {duration:g} s",
    )


def random_noise(rms: float, first: float, last: float, period: float, seed: int = 0) -> Excitation:
    """Random noise of constant density between two frequencies, which repeats itself after a period.

    Parameters
    ----------
    rms : float
        Root mean square, exact over one period.
    first, last : float
        [Hz]; lines stand at whole multiples of 1/period.
    period : float
        [s]; with it as the length of a segment there is no leakage.
    seed : int
        Another seed, other phases.

    Raises
    ------
    EngdynError
        A band without lines.

    Notes
    -----
    Cosines of one amplitude with random phases: M. Shinozuka and C.-M. Jan, *Journal of Sound and Vibration* 25
    (1972) 111.
    """
    first, last, period, rms = _positive(first=first, last=last, period=period, rms=rms)
    lines = np.arange(np.ceil(first * period * (1 - 1e-12)), np.floor(last * period * (1 + 1e-12)) + 1)
    if not len(lines):
        raise EngdynError(f"no multiple of {1 / period:g} Hz lies between {first:g} and {last:g} Hz")
    omega = 2 * np.pi * lines / period
    phase = np.random.default_rng(seed).uniform(0, 2 * np.pi, len(omega))
    size = rms * np.sqrt(2 / len(omega))

    def of_time(weight: np.ndarray, shift: float) -> Function:
        def one(t: float) -> Any:
            return weight @ np.cos(omega * t + phase + shift)

        return lambda t: np.vectorize(one, otypes=[float])(t) if np.ndim(t) else one(t)

    return Excitation(
        of_time(np.full(len(omega), size), 0.0),
        of_time(size * omega, np.pi / 2),
        of_time(size * omega**2, np.pi),
        f"noise of rms {rms:g} from {first:g} to {last:g} Hz, seed {seed}",
    )
