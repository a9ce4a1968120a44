"""What a file holds before it becomes a record: columns, names, units, times; and the even grid they need."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from engdyn.errors import RecordError

__all__ = ["Raw", "distinct", "even_rate", "name_and_unit", "resampled"]

EVEN = 0.01
"""Times may miss the even grid by this share of a step: at the highest frequency that is a phase of 0.03 rad."""

BLOCK = 2**18

LABELED = re.compile(r"(?P<name>.*?)\s*(?:\[(?P<a>[^\]]*)\]|\((?P<b>[^)]*)\)|\s/\s+(?P<c>.+))\s*")


@dataclass
class Raw:
    """Columns of a file.

    Attributes
    ----------
    columns : ndarray, shape (N, channels)
    names, units : list of str
    time : ndarray, shape (N,), optional
        [s]
    rate : float, optional
        Samples per second that the file states.
    start : float
        [s], where there are no times.
    quantum : float
        Step of the last digit of the times [s].
    place : callable
        Row of the columns → "line 12".
    metadata : dict
    """

    columns: np.ndarray
    names: list[str]
    units: list[str]
    time: np.ndarray | None = None
    rate: float | None = None
    start: float = 0.0
    quantum: float = 0.0
    place: Callable[[int], str] = "row {}".format
    metadata: Mapping[str, Any] = field(default_factory=dict)


def name_and_unit(text: str) -> tuple[str, str]:
    """``"acc [m/s²]"``, ``"acc (m/s2)"`` and ``"acc / m/s^2"`` are acc in m/s^2; without a unit "-"."""
    found = LABELED.fullmatch(text.strip())
    if found is None:
        return text.strip(), "-"
    unit = next(part for part in found.group("a", "b", "c") if part is not None).strip()
    unit = unit.replace("²", "^2").replace("³", "^3").replace("**", "^").replace("°", "deg")
    return found["name"].strip(), re.sub(r"(?<=[A-Za-z])(\d)", r"^\1", unit) or "-"


def distinct(names: list[str]) -> list[str]:
    """Names, with a number where one comes again."""
    return [f"{n} ({names[:i].count(n) + 1})" if n in names[:i] else n for i, n in enumerate(names)]


def even_rate(raw: Raw, rate: float | None) -> float:
    """Samples per second of times that lie on an even grid.

    Parameters
    ----------
    raw : Raw
        With times.
    rate : float, optional
        What it should be [1/s]; the times are held against it.

    Raises
    ------
    RecordError
        Times that go back, repeat or leave the grid: the place of the first is named.
    """
    time, wanted = raw.time, rate
    span = float(time[-1] - time[0])
    if not span > 0:
        raise RecordError(
            "the times do not rise: name the channels to read, or give the rate and leave them out"
        )
    if rate is None:
        rate = (len(time) - 1) / span
        exact = max(_miss(time, rate, first) for first in range(0, len(time), BLOCK)) * rate < 1e-9
        slack = (0.0 if exact else 2 * raw.quantum / span) + 1e-11
        # The rate of rounded times is not known better than this: the number of fewest digits is the one meant.
        rate = next(r for d in range(1, 18) if abs((r := float(f"{rate:.{d}g}")) / rate - 1) <= slack)
    miss = max(_miss(time, rate, first) for first in range(0, len(time), BLOCK))
    allowed = EVEN / rate + 1.01 * raw.quantum + 4 * np.spacing(np.abs(time[[0, -1]]).max())
    if raw.quantum < 1 / rate or wanted is None:
        allowed = min(allowed, 0.49 / rate)
    if miss > allowed:
        raise _uneven(raw, wanted, miss)
    return rate


def _miss(time: np.ndarray, rate: float, first: int) -> float:
    """How far a block of times is off the even grid [s]; block by block, to need no memory."""
    block = time[first : first + BLOCK]
    return float(np.max(np.abs(np.arange(first, first + len(block)) / -rate + (block - time[0]))))


def _uneven(raw: Raw, wanted: float | None, miss: float) -> RecordError:
    time = np.asarray(raw.time)
    if wanted is not None:
        own = (len(time) - 1) / float(time[-1] - time[0])
        return RecordError(
            f"rate is {wanted:g}, but the times of the file say {own:.6g} per second: leave it out"
        )
    step = np.diff(time)
    usual = float(np.median(step))
    row = int(np.argmax(np.abs(step - usual))) + 1
    if np.min(step) <= 0:
        row = int(np.argmin(step)) + 1
        return RecordError(
            f"in {raw.place(row)} the time repeats or goes back: where it has too few digits, give the rate; it has to "
            "agree"
        )
    return RecordError(
        f"the times are not even, off by up to {miss:.3g} s: in {raw.place(row)} the time comes {step[row - 1]:.4g} s "
        f"after the one before, usual are {usual:.4g} s. Interpolate with resample={1 / usual:.5g}, which bridges gaps "
        "with straight lines"
    )


def resampled(raw: Raw, rate: float) -> Raw:
    """The same signals on an even grid, by straight lines; samples that are not finite are bridged.

    Raises
    ------
    RecordError
        No times, times that do not rise, a rate below that of the file: it would fold what lies above.
    """
    if raw.time is None:
        raise RecordError("resample needs times: this file has none; give its rate and decimate the record")
    step = np.diff(raw.time)
    if not np.all(step > 0):
        raise RecordError(
            f"in {raw.place(int(np.argmin(step)) + 1)} the time repeats or goes back: take such rows out"
        )
    usual = 1 / float(np.median(step))
    if not usual * (1 - EVEN) <= rate <= 100 * usual:
        raise RecordError(
            f"resample is {rate:g}, the file has about {usual:.5g} samples per second: give that or more, and decimate "
            "the record afterwards, which filters first"
        )
    count = int((raw.time[-1] - raw.time[0]) * rate * (1 + 1e-12)) + 1
    if count > 100 * len(raw.time):
        raise RecordError(
            "the gaps are a hundred times longer than the record: cut out what belongs together"
        )
    grid = raw.time[0] + np.arange(count) / rate
    columns = np.empty((count, raw.columns.shape[1]))
    for i, column in enumerate(raw.columns.T):
        known = np.isfinite(column)
        if np.sum(known) < 2:
            raise RecordError(f"{raw.names[i]} has less than two finite samples: leave it out")
        columns[:, i] = np.interp(grid, raw.time[known], column[known])
    raw.columns, raw.time, raw.rate, raw.start = columns, None, rate, float(raw.time[0])
    return raw
