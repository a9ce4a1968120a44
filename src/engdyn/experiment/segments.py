"""Records cut into segments, each without its mean or trend, windowed and transformed.  Course section 9.10."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from engdyn.errors import RecordError
from engdyn.experiment.windows import window as window_values
from engdyn.record import Record

__all__ = ["Segments", "cut", "density_unit", "doubled", "quotient_unit"]

CHUNK = 2**18
"""Samples that are transformed at once: what fits into the cache of a processor is quicker than the whole."""

DETRENDS = ("constant", "linear", None, False)


@dataclass(frozen=True)
class Segments:
    """A channel cut into overlapping segments; what is left at its end is not used."""

    samples: np.ndarray
    rate: float
    unit: str
    name: str
    window: str
    weights: np.ndarray
    step: int
    detrend: str | None

    @property
    def length(self) -> int:
        """Samples of one segment."""
        return len(self.weights)

    @property
    def count(self) -> int:
        """Number of segments."""
        return (len(self.samples) - self.length) // self.step + 1

    @property
    def frequency(self) -> np.ndarray:
        """Lines of the transforms [Hz], 1/T apart."""
        return np.arange(self.length // 2 + 1) * (self.rate / self.length)

    @property
    def times(self) -> np.ndarray:
        """Centers of the segments, from the first sample of the record [s]."""
        return (np.arange(self.count) * self.step + self.length / 2) / self.rate

    @property
    def density(self) -> np.ndarray:
        """What abs(X)² is multiplied by to become a one-sided density, shape (lines,): 2/(rate Σw²)."""
        return doubled(self.length) / (self.rate * (self.weights @ self.weights))

    def worth(self, shares: np.ndarray | None = None) -> float:
        """Number of independent segments whose mean power has the same variance, for noise.

        Parameters
        ----------
        shares : ndarray, shape (count,), optional
            Share of each segment in the average; all alike where not given.
        """
        w, shares = self.weights, np.full(self.count, 1 / self.count) if shares is None else shares
        variance = shares @ shares
        for m, shift in enumerate(range(self.step, len(w), self.step), start=1):
            correlation = ((w[:-shift] @ w[shift:]) / (w @ w)) ** 2
            variance += 2 * correlation * (shares[m:] @ shares[:-m])
        return float(1 / variance)

    def transforms(self, length: int | None = None) -> Iterator[np.ndarray]:
        """Unscaled transforms, some segments at a time, shape (segments, lines).

        Parameters
        ----------
        length : int, optional
            Zeros are appended to each segment up to this length.
        """
        from scipy import fft

        rows = np.lib.stride_tricks.sliding_window_view(self.samples, self.length)[:: self.step]
        many = max(1, CHUNK // self.length)
        for start in range(0, len(rows), many):
            yield fft.rfft(_without_trend(rows[start : start + many], self.detrend) * self.weights, length)


def cut(
    record: Any, window: str, segment: int | None, overlap: float, detrend: str | bool | None
) -> Segments:
    """Check what was asked for and cut one channel into segments.

    Raises
    ------
    RecordError
        No record or several channels, a segment longer than the record or shorter than two samples, an overlap
        outside of 0 ≤ overlap < 1, an unknown detrend.
    """
    if not isinstance(record, Record) or len(record.channels) > 1:
        given = f"a record of {', '.join(record.channels)}" if isinstance(record, Record) else repr(record)
        raise RecordError(f"{given:.200} was given: a spectrum is that of one channel, record['name']")
    length = len(record) if segment is None else segment
    if not isinstance(length, int | np.integer) or isinstance(length, bool) or not 2 <= length <= len(record):
        raise RecordError(
            f"segment is {segment!r}: give its number of samples, from 2 to the {len(record)} of the record"
        )
    if not isinstance(overlap, int | float | np.number) or not 0 <= overlap < 1:
        raise RecordError(f"overlap is {overlap!r}: give the part shared by neighbors, 0 ≤ overlap < 1")
    if not any(detrend is known or detrend == known for known in DETRENDS):
        raise RecordError(f"detrend is {detrend!r}: choose 'constant' (the mean), 'linear' or None")
    step = length - int(overlap * length)
    weights = window_values(window, length)
    samples = record.samples.reshape(-1)
    return Segments(
        samples, record.rate, record.units[0], record.channels[0], window, weights, step, detrend or None
    )


def _without_trend(rows: np.ndarray, detrend: str | None) -> np.ndarray:
    """Each segment without its mean, or without the straight line that fits it best."""
    if detrend is None:
        return rows
    rows = rows - rows.mean(axis=1, keepdims=True)
    if detrend == "linear":
        time = np.arange(rows.shape[1]) - (rows.shape[1] - 1) / 2
        rows -= np.outer(rows @ time / (time @ time), time)
    return rows


def doubled(length: int) -> np.ndarray:
    """2 for every line that stands for a negative frequency as well, 1 for 0 Hz and for the Nyquist line.

    A record with an odd number of samples has no Nyquist line: its last line is an ordinary one.
    """
    factor = np.full(length // 2 + 1, 2.0)
    factor[0] = 1.0
    if length % 2 == 0:
        factor[-1] = 1.0
    return factor


def _grouped(unit: str) -> str:
    """A unit in parentheses where it is more than one name."""
    return unit if re.fullmatch(r"\w+", unit) else f"({unit})"


def density_unit(unit: str, other: str | None = None) -> str:
    """Unit of the density of a signal, or of a cross-spectrum of two."""
    if other is None or other == unit:
        return "1/Hz" if unit == "-" else f"{_grouped(unit)}^2/Hz"
    names = [_grouped(name) for name in (unit, other) if name != "-"]
    return f"{' '.join(names)}/Hz"


def quotient_unit(above: str, below: str) -> str:
    """Unit of one signal per unit of another."""
    if below == "-" or above == below:
        return above if below == "-" else "-"
    return f"{'1' if above == '-' else above}/{_grouped(below)}"
