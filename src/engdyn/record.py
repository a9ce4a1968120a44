"""Record: sampled data, the noun that simulation inputs and measurements share.  Course chapters 8 and 9."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from engdyn.errors import RecordError
from engdyn.looking import Summary, summarize

__all__ = ["Record"]


@dataclass(frozen=True, eq=False, repr=False)
class Record:
    """Samples taken at equal intervals of time.

    Parameters
    ----------
    samples : array_like, shape (N,) or (N, channels)
    rate : float
        Samples per second [1/s].
    name : str or sequence of str
        What was measured; of several channels one name each.
    unit : str or sequence of str
        One for all channels, or one each; "-" for none.
    start : float
        Time of the first sample [s].
    metadata : mapping
        Whatever else is known: the file, the sensor, the day.

    Raises
    ------
    RecordError
        Less than two samples, samples that are not finite real numbers (gaps must be closed or cut out before),
        a rate that is not positive, names or units that do not fit.

    Examples
    --------
    >>> import engdyn as ed
    >>> record = ed.Record([[0.0, 1.0], [0.5, 0.8], [0.0, 0.1]], rate=100, name=["x", "F"], unit=["m", "N"])
    >>> record["F"].samples
    array([1. , 0.8, 0.1])
    >>> record.time
    array([0.  , 0.01, 0.02])
    """

    samples: np.ndarray
    rate: float
    name: str | Sequence[str] = "signal"
    unit: str | Sequence[str] = "-"
    start: float = 0.0
    metadata: Mapping[str, Any] = field(default_factory=dict)

    def __post_init__(self) -> None:
        samples = _checked_samples(self.samples)
        count = samples.shape[1] if samples.ndim == 2 else 1
        names = _one_each(self.name, count, "name")
        units = _one_each([self.unit] * count if isinstance(self.unit, str) else self.unit, count, "unit")
        if len(set(names)) < len(names):
            raise RecordError(f"the channels have the names {names}: give each its own")
        for what, value in (("rate", _number(self.rate)), ("start", _number(self.start))):
            if not np.isfinite(value) or (what == "rate" and value <= 0):
                raise RecordError(f"{what} is {getattr(self, what)!r}: give samples per second, or seconds")
            object.__setattr__(self, what, value)
        single = samples.ndim == 1
        object.__setattr__(self, "samples", samples)
        object.__setattr__(self, "name", names[0] if single else names)
        object.__setattr__(self, "unit", units[0] if single else units)

    @property
    def channels(self) -> tuple[str, ...]:
        """Names of the channels."""
        return (self.name,) if isinstance(self.name, str) else tuple(self.name)

    @property
    def units(self) -> tuple[str, ...]:
        """Units of the channels."""
        return (self.unit,) if isinstance(self.unit, str) else tuple(self.unit)

    @property
    def time(self) -> np.ndarray:
        """Time of each sample [s], shape (N,)."""
        return self.start + np.arange(len(self.samples)) / self.rate

    @property
    def duration(self) -> float:
        """Number of samples over their rate [s]."""
        return len(self.samples) / self.rate

    def __len__(self) -> int:
        return len(self.samples)

    def __getitem__(self, channel: str | int) -> Record:
        """One channel, by name or by number."""
        channels = self.channels
        if channel not in channels and channel not in range(len(channels)):
            raise RecordError(f"there is no channel {channel!r}: the record has {', '.join(channels)}")
        i = channels.index(channel) if isinstance(channel, str) else int(channel)
        column = self.samples if self.samples.ndim == 1 else self.samples[:, i]
        return Record(column, self.rate, channels[i], self.units[i], self.start, self.metadata)

    def summary(self) -> Summary:
        """Look first: mean, drift, clipping, dropouts, hum and unit of each channel, with remarks.  Section 9.1."""
        return summarize(self.samples.reshape(len(self), -1), self.rate, self.channels, self.units)

    def __repr__(self) -> str:
        channels = ", ".join(f"{n} [{u}]" for n, u in zip(self.channels, self.units, strict=True))
        return f"Record({channels}; {len(self)} samples at {self.rate:g} per second)"

    def _repr_html_(self) -> str:
        columns = self.samples.reshape(len(self), -1).T
        rows = "".join(
            f"<tr><td>{n}</td><td>{u}</td><td>{x.min():.4g}</td><td>{x.max():.4g}</td><td>{x.std():.4g}</td></tr>"
            for n, u, x in zip(self.channels, self.units, columns, strict=True)
        )
        head = "".join(
            f"<th>{h}</th>" for h in ("channel", "unit", "smallest", "largest", "standard deviation")
        )
        caption = f"{len(self)} samples at {self.rate:g} per second, {self.duration:.4g} s"
        return (
            f"<table><caption>{caption}</caption><thead><tr>{head}</tr></thead><tbody>{rows}</tbody></table>"
        )


def _checked_samples(given: Any) -> np.ndarray:
    try:
        samples = np.array(given)
        real = samples.dtype.kind in "biuf"
    except ValueError:
        real = False
    if not real or samples.ndim not in (1, 2) or len(samples) < 2 or 0 in samples.shape:
        raise RecordError(
            "samples must be an array of real numbers, two or more in a row or one column for each channel"
        )
    samples = samples.astype(float, copy=False)  # the copy was made above
    bad = np.argwhere(~np.isfinite(samples))
    if len(bad):
        raise RecordError(
            f"{len(bad)} of the samples are not finite, the first in row {bad[0][0]}: close such gaps by interpolation "
            "or cut them out"
        )
    samples.setflags(write=False)
    return samples


def _one_each(given: Any, count: int, what: str) -> tuple[str, ...]:
    found = (given,) if isinstance(given, str) else tuple(given)
    if len(found) != count or not all(isinstance(item, str) for item in found):
        raise RecordError(f"{what} is {given!r} for {count} channel{'s' * (count != 1)}: give one text each")
    return found


def _number(value: Any) -> float:
    try:
        return float(value)
    except (TypeError, ValueError):
        return float("nan")
