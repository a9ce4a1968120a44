"""Stationary response to harmonic excitation.  Course section 7.1."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
import scipy.optimize

from engdyn.analysis.harmonic import Harmonic
from engdyn.analysis.linear import LinearSystem
from engdyn.analysis.phase import unwrapped
from engdyn.analysis.stability import stability
from engdyn.errors import EngdynError

__all__ = ["FrequencyResponse", "frequency_response"]

EXACT = 1e-12
"""A frequency this close to an undamped natural frequency, relatively, is at the resonance."""


@dataclass(frozen=True, eq=False, repr=False)
class FrequencyResponse:
    """Complex amplitudes of outputs per unit complex amplitude of inputs, with the time factor exp(+iωt).

    Attributes
    ----------
    frequency : ndarray, shape (N,)
        [Hz], rising.
    response : ndarray of complex, shape (N,), (inputs, N), (outputs, N) or (outputs, inputs, N)
        Frequency along the last axis; an axis only for what was given as a sequence of names.
    input, output : str or tuple of str
        What was asked for.
    unit : str
        Unit of the response, for labels; "" where it was not said, "-" for none.
    evaluate : callable
        The response at other frequencies [Hz], for what lies between those asked for.
    """

    frequency: np.ndarray
    response: np.ndarray
    input: str | tuple[str, ...]
    output: str | tuple[str, ...]
    unit: str = ""
    evaluate: Callable[[np.ndarray], np.ndarray] | None = None

    @property
    def amplitude(self) -> np.ndarray:
        """abs(H)."""
        return np.abs(self.response)

    @cached_property
    def phase(self) -> np.ndarray:
        """Phase [rad]; a lag is negative. Continued along frequency by the rule of `phase.unwrapped`.

        It begins in (−π, π] and goes on without jumps of 2π; a change of sign is a jump of π, up at an undamped
        antiresonance and down at an undamped resonance; nothing is unwrapped where the amplitude is below 1e-10 of
        the largest, and a warning says where the frequencies are too coarse.
        """
        rows = self.response.reshape(-1, len(self.frequency))
        return np.array([unwrapped(self.frequency, row) for row in rows]).reshape(self.response.shape)

    @property
    def peaks(self) -> np.ndarray:
        """Resonance frequencies [Hz]: where the amplitude has a maximum between the first and last frequency."""
        return self._extremes(-1.0)

    @property
    def antiresonances(self) -> np.ndarray:
        """Frequencies [Hz] where the amplitude has a minimum between the first and last frequency."""
        return self._extremes(1.0)

    def half_power_band(self, peak: float) -> tuple[float, float]:
        """Frequencies [Hz] beside a peak where the power is half as large, the amplitude 1/√2 of the peak's.

        Parameters
        ----------
        peak : float
            One of :attr:`peaks` [Hz]. Of a lightly damped single mode the width is 2ζ times this frequency.

        Raises
        ------
        EngdynError
            The amplitude does not fall that far between the first and the last frequency.
        """
        level = float(self._size(peak)) / np.sqrt(2)
        below = self.frequency[self.amplitude < level]
        low, high = below[below < peak], below[below > peak]
        if not (len(low) and len(high)):
            raise EngdynError(
                f"the amplitude does not fall to 1/√2 of its value at {peak:.5g} Hz on both sides: widen the range of "
                "frequencies, or look for another peak"
            )
        edges = (
            scipy.optimize.brentq(lambda f: self._size(f) - level, end, peak) for end in (low[-1], high[0])
        )
        return next(edges), next(edges)

    def _size(self, frequency: float) -> float:
        if self.response.ndim > 1 or self.evaluate is None:
            raise EngdynError("ask for one input and one output: each response has its own peaks")
        return float(abs(self.evaluate(np.array([frequency]))[0]))

    def _extremes(self, sign: float) -> np.ndarray:
        """Where sign·amplitude has a minimum, refined between the frequencies."""
        size, f = sign * self.amplitude, self.frequency
        self._size(f[0])
        inner = np.flatnonzero((size[1:-1] < size[:-2]) & (size[1:-1] <= size[2:])) + 1
        options = {"xatol": 1e-10 * f[-1]}
        return np.array(
            [
                scipy.optimize.minimize_scalar(
                    lambda x: sign * self._size(x),
                    bounds=(f[i - 1], f[i + 1]),
                    method="bounded",
                    options=options,
                ).x
                for i in inner
            ]
        )

    def __repr__(self) -> str:
        unit = f" [{self.unit}]" if self.unit else ""
        low, high = self.frequency[[0, -1]]
        return f"FrequencyResponse({self.output} per {self.input}{unit}, {low:.4g} to {high:.4g} Hz)"


def frequency_response(
    linear: LinearSystem,
    frequency: Any,
    input: str | Sequence[str] | Mapping[str, Any],
    output: str | Sequence[str],
    *,
    unit: str = "",
) -> FrequencyResponse:
    """Complex amplitude of stationary small motion per unit amplitude of an input.

    Parameters
    ----------
    linear : LinearSystem
        With numbers.
    frequency : array_like, shape (N,)
        [Hz], rising, not negative.
    input : str, sequence of str, or mapping
        An input, or a coordinate for a generalized force on its equation. The response to a prescribed motion is per
        unit displacement, its rate and acceleration included. A mapping combines several: name → complex factor, or
        a function of the frequencies [Hz] that returns factors (a delay, an unbalance ∝ Ω²). A sequence gives one
        response each.
    output : str or sequence of str
        A coordinate or one of the `outputs` of `linearize`; with one prime added its rate (``x'``), with two its
        acceleration (``x''``).
    unit : str
        Unit of the response ("m/N", "-"), for labels and for `response_psd`.

    Returns
    -------
    FrequencyResponse

    Raises
    ------
    EngdynError
        Unknown names; frequencies that do not rise; an unstable system; 0 Hz where a coordinate is neutral; an
        undamped natural frequency; an input whose direction turns in these coordinates.

    Notes
    -----
    Course section 7.1. A marginal system answers with what is left when its damping goes to zero; neutral coordinates
    (zero eigenvalues) grow beyond all limits as the frequency goes to zero.

    Examples
    --------
    >>> import engdyn as ed
    >>> crane = ed.systems.load("gantry_crane")
    >>> linear = ed.linearize(crane.equations, crane.equilibria()[0])
    >>> response = ed.frequency_response(linear, [0.1, 0.2], "F", "x", unit="m/N")
    >>> response.amplitude.round(9).tolist()
    [0.000489588, 0.000156592]
    """
    if not isinstance(linear, LinearSystem) or not isinstance(linear.state_matrix, np.ndarray):
        raise EngdynError(
            f"frequency_response needs a LinearSystem with numbers, not {linear!r}: call linearize"
        )
    f = _frequencies(frequency)
    inputs, outputs = _names(input, "input"), _names(output, "output")
    harmonic = Harmonic(linear, inputs, outputs)
    _check_stationary(linear, f)

    def evaluate(at: np.ndarray) -> np.ndarray:
        found = harmonic(at)
        if isinstance(input, Mapping):
            found = np.einsum("pwn,wn->pn", found, _factors(input, at))
        elif isinstance(input, str):
            found = found[:, 0]
        return found[0] if isinstance(output, str) else found

    driven = ", ".join(inputs) if isinstance(input, str | Mapping) else tuple(inputs)
    observed = output if isinstance(output, str) else tuple(outputs)
    return FrequencyResponse(f, evaluate(f), driven, observed, unit, evaluate)


def _names(given: Any, what: str) -> list[str]:
    names = [given] if isinstance(given, str) else list(given) if isinstance(given, Iterable) else []
    if not names or not all(isinstance(name, str) for name in names):
        raise EngdynError(f"{what} is {given!r}: give the name of one, or a sequence of names")
    return names


def _frequencies(frequency: Any) -> np.ndarray:
    try:
        f = np.atleast_1d(np.array(frequency, dtype=float))
    except (TypeError, ValueError, OverflowError) as error:
        raise EngdynError(f"frequency is {frequency!r}: give an array of numbers in Hz") from error
    if f.ndim != 1 or not len(f) or not np.all(np.isfinite(f)) or f[0] < 0 or np.any(np.diff(f) <= 0):
        raise EngdynError(
            "frequency must be a one-dimensional array of rising, finite frequencies in Hz from 0 on"
        )
    return f


def _check_stationary(linear: LinearSystem, frequency: np.ndarray) -> None:
    """There is a stationary response at these frequencies."""
    judged = stability(linear)
    if judged.verdict.startswith("unstable"):
        raise EngdynError(
            f"no stationary response: {linear.at!r} is {judged.verdict}, so that any disturbance grows beyond the "
            "response to the excitation; choose a stable equilibrium or other parameters"
        )
    if judged.neutral and frequency[0] == 0:
        raise EngdynError(
            f"no response at 0 Hz: {judged.neutral} eigenvalues are zero (rigid-body motion), so that a constant input "
            "moves the system away; begin above 0 Hz"
        )
    for value, error in zip(judged.eigenvalues, judged.errors, strict=True):
        if abs(value.real) <= 10 * error < value.imag:
            natural = value.imag / (2 * np.pi)
            if len(hit := frequency[np.abs(frequency - natural) <= EXACT * natural]):
                raise EngdynError(
                    f"no stationary response at {hit[0]:.6g} Hz: it is an undamped natural frequency; leave it out or "
                    "give the system damping"
                )


def _factors(input: Mapping[str, Any], frequency: np.ndarray) -> np.ndarray:
    """Complex factors of the inputs, shape (inputs, N)."""
    found = np.empty((len(input), len(frequency)), dtype=complex)
    for row, (name, factor) in zip(found, input.items(), strict=True):
        try:
            if isinstance(factor, str | bytes):
                raise TypeError
            row[:] = factor(frequency) if callable(factor) else factor
        except (TypeError, ValueError, OverflowError) as error:
            raise EngdynError(
                f"the factor of {name} is {factor!r}: give a complex number, or a function of the frequencies [Hz] "
                "that returns one for each"
            ) from error
    if not np.all(np.isfinite(found)):
        raise EngdynError(f"a factor of {', '.join(input)} is not finite at one of the frequencies")
    return found
