"""Averages of the powers of segments: linear, exponential, peak hold, with their confidence.  Course section 9.10."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from engdyn.errors import EngdynError
from engdyn.experiment.segments import Segments, cut, density_unit, doubled
from engdyn.experiment.windows import amplitude_correction, energy_correction, equivalent_noise_bandwidth
from engdyn.record import Record
from engdyn.spectrum import Spectrum

__all__ = ["AveragedSpectrum", "Spectrogram", "averaged_spectrum", "spectrogram"]

AVERAGINGS = ("linear", "exponential", "peak hold")


@dataclass(frozen=True, eq=False, repr=False)
class AveragedSpectrum(Spectrum):
    """A spectrum of a record, averaged over segments.

    Attributes
    ----------
    segments : int
        How many segments there were.
    averages : float
        How many independent ones they are worth for noise: fewer where they overlap or count unequally. Not a
        number for a peak hold, which is no average.
    """

    segments: int = 1
    averages: float = 1.0

    @property
    def degrees_of_freedom(self) -> np.ndarray:
        """Of the chi-square distribution of each line: two for each average, one where a line has no phase."""
        real = (self.frequency == 0) | np.isclose(self.frequency, self.rate / 2, rtol=1e-12)
        return self.averages * np.where(real, 1.0, 2.0)

    def confidence_band(self, level: float = 0.95) -> tuple[np.ndarray, np.ndarray]:
        """Between what values the true spectrum of noise lies, line by line, with a probability.

        Parameters
        ----------
        level : float
            Probability, 0 < level < 1.

        Returns
        -------
        low, high : ndarray, shape (N,)
            [unit of the values]

        Raises
        ------
        EngdynError
            A level that is no probability; a peak hold.

        Notes
        -----
        Course section 9.10. Of Gaussian noise whose density hardly changes within a line, n Ĝ/G is distributed as
        chi-square with n degrees of freedom: J. S. Bendat and A. G. Piersol, *Random Data* (1971), section 8.5.
        """
        from scipy.stats import chi2

        if not 0 < level < 1 or np.isnan(self.averages):
            raise EngdynError(
                f"level = {level!r}: give a probability between 0 and 1"
                if self.averages > 0
                else "a peak hold is no average: there is no confidence band; average linearly"
            )
        n = self.degrees_of_freedom
        low, high = (n / chi2.ppf((1 + sign * level) / 2, n) for sign in (1, -1))
        power = 0.5 if self.per is None else 1.0
        return self.values * low**power, self.values * high**power


def averaged_spectrum(
    record: Record,
    window: str = "hann",
    segment: int | None = None,
    overlap: float = 0.5,
    detrend: str | None = "constant",
    *,
    averaging: str = "linear",
    memory: float = 8.0,
    scaling: str = "density",
) -> AveragedSpectrum:
    """Average the powers of the segments of a record.

    Parameters
    ----------
    record : Record
        One channel.
    window : str
        See `window`.
    segment : int, optional
        Samples of a segment; the whole record where not given. Lines are rate/segment apart: more averages cost
        resolution.
    overlap : float
        Part of a segment that the next one shares.
    detrend : {"constant", "linear", None}
        What is taken out of each segment: its mean, or the straight line that fits it.
    averaging : {"linear", "exponential", "peak hold"}
        All segments alike; recent ones more; of each line the largest value.
    memory : float
        Of an exponential average: the share of a new segment is 1/memory, that of the k-th one 1/k as long as that
        is more.
    scaling : {"density", "amplitude"}
        One-sided density per Hz, or peak amplitudes: the root of the averaged power, true for sines.

    Returns
    -------
    AveragedSpectrum
        With ``.confidence_band()``.

    Raises
    ------
    RecordError
        Several channels; a segment, overlap or detrend that does not fit.
    EngdynError
        Another averaging or scaling, a memory below one segment.

    Notes
    -----
    Course section 9.10. P. D. Welch, *IEEE Transactions on Audio and Electroacoustics* 15 (1967) 70, for segments,
    scaling and for what overlapping ones are worth.
    """
    if averaging not in AVERAGINGS or scaling not in ("density", "amplitude") or not memory >= 1:
        raise EngdynError(
            f"averaging = {averaging!r}, scaling = {scaling!r}, memory = {memory!r}: choose one of {AVERAGINGS}, of "
            "('density', 'amplitude'), and a memory of 1 segment or more"
        )
    segments = cut(record, window, segment, overlap, detrend)
    if averaging == "peak hold":
        shares, worth = None, np.nan
    else:
        shares = _shares(segments.count, memory if averaging == "exponential" else np.inf)
        worth = segments.worth(shares)
    values = mean_power(segments, shares) * segments.density
    unit, correction = density_unit(segments.unit), energy_correction(segments.weights)
    if scaling == "amplitude":
        line = segments.rate / segments.length * equivalent_noise_bandwidth(segments.weights)
        values = np.sqrt(values * line * doubled(segments.length))  # A² is twice the mean square of a sine
        unit, correction = segments.unit, amplitude_correction(segments.weights)
    found = {"window": window, "correction": correction, "rate": segments.rate}
    return AveragedSpectrum(
        segments.frequency, values, unit, **found, segments=segments.count, averages=worth
    )


def _shares(count: int, memory: float) -> np.ndarray:
    """Share of each segment in an average where A ← A + (new − A)/min(k, memory) as they come in turn."""
    gain = 1 / np.minimum(np.arange(1, count + 1), memory)
    later = np.concatenate([np.cumprod((1 - gain)[:0:-1])[::-1], [1.0]])
    return gain * later


def mean_power(segments: Segments, shares: np.ndarray | None) -> np.ndarray:
    """Weighted mean of abs(X)² over the segments, or its largest value where there are no shares."""
    total, first = np.zeros(2 * (segments.length // 2 + 1)), 0
    for X in segments.transforms():
        squares = np.square(X.view(float))  # of real and imaginary parts in turn
        if shares is None:
            power = squares[:, ::2] + squares[:, 1::2]
            total[::2] = np.maximum(total[::2], power.max(axis=0))
        else:
            total += shares[first : first + len(X)] @ squares
        first += len(X)
    return total[::2] + total[1::2]


@dataclass(frozen=True, eq=False, repr=False)
class Spectrogram:
    """Densities of segments one after another.

    Attributes
    ----------
    time : ndarray, shape (M,)
        Centers of the segments [s].
    frequency : ndarray, shape (N,)
        [Hz]
    values : ndarray, shape (N, M)
        One-sided densities.
    unit, window, name : str
    """

    time: np.ndarray
    frequency: np.ndarray
    values: np.ndarray
    unit: str
    window: str
    name: str = "signal"

    def __repr__(self) -> str:
        lines, times = self.values.shape
        high = self.frequency[-1]
        return f"Spectrogram({self.name} [{self.unit}]: {lines} lines up to {high:.4g} Hz, {times} times)"


def spectrogram(
    record: Record,
    window: str = "hann",
    segment: int | None = None,
    overlap: float = 0.5,
    detrend: str | None = "constant",
) -> Spectrogram:
    """Densities of the segments of a record, not averaged: how the spectrum changes with time.

    Parameters
    ----------
    record, window, segment, overlap, detrend
        As for `averaged_spectrum`. A short segment tells times, a long one frequencies, none tells both.

    Returns
    -------
    Spectrogram

    Raises
    ------
    RecordError
        As for `averaged_spectrum`.

    Notes
    -----
    Course section 9.10.
    """
    segments = cut(record, window, segment, overlap, detrend)
    powers = [X.real**2 + X.imag**2 for X in segments.transforms()]
    values = np.concatenate(powers).T * segments.density[:, None]
    unit = density_unit(segments.unit)
    time = record.start + segments.times
    return Spectrogram(time, segments.frequency, values, unit, window, segments.name)
