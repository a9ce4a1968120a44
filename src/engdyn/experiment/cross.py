"""Two records together: cross-spectra, estimates of frequency responses, coherence.  Course section 9.10."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from engdyn.errors import EngdynError, RecordError
from engdyn.experiment.segments import Segments, cut, density_unit, quotient_unit
from engdyn.record import Record

__all__ = ["CrossSpectrum", "EstimatedResponse", "cross_spectral_density", "estimate_frf"]

SILENT = 1e-24
"""Where the power of a signal is below this share of its largest line, there is nothing but rounding."""


@dataclass(frozen=True, eq=False, repr=False)
class CrossSpectrum:
    """Cross-spectral density of two records.

    Attributes
    ----------
    frequency : ndarray, shape (N,)
        [Hz]
    values : ndarray of complex, shape (N,)
        One-sided, per Hz: mean of conj(X) Y; its phase is that by which the second signal leads the first [rad].
    unit, window : str
    segments : int
    """

    frequency: np.ndarray
    values: np.ndarray
    unit: str
    window: str
    segments: int

    def __repr__(self) -> str:
        return f"CrossSpectrum({len(self.values)} values [{self.unit}], average of {self.segments} segments)"


@dataclass(frozen=True, eq=False, repr=False)
class EstimatedResponse:
    """Frequency response estimated from an input and an output.

    Attributes
    ----------
    frequency : ndarray, shape (N,)
        [Hz], the lines at which the input is more than rounding.
    response : ndarray of complex, shape (N,)
        Complex amplitude of the output per unit of the input, time factor exp(+iωt).
    input, output, unit, estimator : str
    segments : int
    averages : float
        How many independent segments they are worth.
    """

    frequency: np.ndarray
    response: np.ndarray
    input: str
    output: str
    unit: str
    estimator: str
    segments: int
    averages: float
    _coherence: np.ndarray = field(repr=False)

    @property
    def amplitude(self) -> np.ndarray:
        """abs(H)."""
        return np.abs(self.response)

    @property
    def phase(self) -> np.ndarray:
        """Phase [rad], continued without jumps of more than π; a lag is negative."""
        return np.unwrap(np.angle(self.response))

    @property
    def coherence(self) -> np.ndarray:
        """abs(Sxy)²/(Sxx Syy), 0 … 1: the share of the output's power that goes linearly with the input.

        Raises
        ------
        EngdynError
            One segment, of which the coherence is 1 whatever was measured.
        """
        if self.segments == 1:
            raise EngdynError(
                "the coherence of a single segment is 1 at every line, whatever was measured: give segment= so that "
                "there are several to average"
            )
        return self._coherence

    @property
    def random_error(self) -> np.ndarray:
        """Standard deviation of abs(H) over abs(H), and of its phase [rad]: √((1 − γ²)/(2 n γ²)).

        J. S. Bendat and A. G. Piersol, *Engineering Applications of Correlation and Spectral Analysis* (1980).
        """
        square = np.maximum(self.coherence, np.finfo(float).tiny)
        return np.sqrt((1 - np.minimum(square, 1.0)) / (2 * self.averages * square))

    def __repr__(self) -> str:
        return (
            f"EstimatedResponse({self.output} per {self.input} [{self.unit}], {self.estimator}, "
            f"{len(self.frequency)} lines, {self.segments} segments)"
        )


def cross_spectral_density(
    input: Record,
    output: Record,
    window: str = "hann",
    segment: int | None = None,
    overlap: float = 0.5,
    detrend: str | None = "constant",
) -> CrossSpectrum:
    """Cross-spectral density of two records, averaged over their segments.

    Parameters
    ----------
    input, output : Record
        One channel each, taken at the same times.
    window, segment, overlap, detrend
        As for `averaged_spectrum`.

    Returns
    -------
    CrossSpectrum

    Raises
    ------
    RecordError
        Records of different length, rate or start.

    Notes
    -----
    Course section 9.10.
    """
    x, y = _together(input, output, window, segment, overlap, detrend)
    _, cross, _ = _means(x, y)
    return CrossSpectrum(x.frequency, cross * x.density, density_unit(x.unit, y.unit), window, x.count)


def estimate_frf(
    input: Record,
    output: Record,
    estimator: str = "H1",
    window: str = "hann",
    segment: int | None = None,
    overlap: float = 0.5,
    detrend: str | None = "constant",
) -> EstimatedResponse:
    """Estimate a frequency response from averaged powers and cross-spectra of an input and an output.

    Parameters
    ----------
    input, output : Record
        One channel each, taken at the same times.
    estimator : {"H1", "H2"}
        H1 = Sxy/Sxx is not biased by noise in the output, which makes it the choice at antiresonances; H2 = Syy/Syx
        not by noise in the input, as there is at resonances of a shaker test. The truth lies between them.
    window, segment, overlap, detrend
        As for `averaged_spectrum`. Segments that are short beside the decay of a vibration make peaks too low.

    Returns
    -------
    EstimatedResponse
        With ``.coherence``, unless there is one segment only.

    Raises
    ------
    RecordError
        Records of different length, rate or start; no input at all.
    EngdynError
        Another estimator.

    Notes
    -----
    Course section 9.10. Powers and cross-spectra are averaged, not their quotients: the latter lets noise in.
    """
    if estimator not in ("H1", "H2"):
        raise EngdynError(
            f"estimator is {estimator!r}: choose 'H1' (noise in the output) or 'H2' (in the input)"
        )
    x, y = _together(input, output, window, segment, overlap, detrend)
    xx, xy, yy = _means(x, y)
    driven = xx > SILENT * np.max(xx)
    if estimator == "H2":
        driven &= np.abs(xy) > 0
    if not np.any(driven):
        raise RecordError(
            f"{x.name!r} does not change: a response needs an input, and for H2 an output, that does"
        )
    xx, xy, yy = xx[driven], xy[driven], yy[driven]
    heard = np.where(yy > 0, yy, 1.0)
    return EstimatedResponse(
        x.frequency[driven],
        xy / xx if estimator == "H1" else yy / np.conj(xy),
        x.name,
        y.name,
        quotient_unit(y.unit, x.unit),
        estimator,
        x.count,
        x.worth(),
        np.abs(xy) ** 2 / (xx * heard),
    )


def _together(input: Record, output: Record, *how: object) -> tuple[Segments, Segments]:
    x, y = cut(input, *how), cut(output, *how)
    if len(input) != len(output) or input.rate != output.rate or input.start != output.start:
        raise RecordError(
            f"{input!r} and {output!r} do not belong together: make length, rate and start the same; `decimate` "
            "or cut one of them"
        )
    return x, y


def _means(x: Segments, y: Segments) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Means over the segments of abs(X)², conj(X) Y and abs(Y)²."""
    sums = np.zeros((3, x.length // 2 + 1), dtype=complex)
    for X, Y in zip(x.transforms(), y.transforms(), strict=True):
        for row, (a, b) in enumerate(((X, X), (X, Y), (Y, Y))):
            sums[row] += np.einsum("ij,ij->j", np.conj(a), b)
    xx, xy, yy = sums / x.count
    return xx.real, xy, yy.real
