"""Look first: what the samples of a record say about the measurement, before anything is computed from them.

Course section 9.1.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from html import escape

import numpy as np

from engdyn.units import si_factor

__all__ = ["ChannelSummary", "Summary", "find_dropouts", "summarize"]

MAINS = (50.0, 60.0)
"""Frequencies of the mains [Hz]."""

LINE = 10.0
"""A spectral line is one where it stands this many times above the median of its neighborhood."""

HELD, JUMP = 5, 6.0
"""A dropout holds a value for so many samples, and jumps to or from it by so many typical steps."""

ODD = {"m": (10.0, "millimeters?"), "rad": (100.0, "degrees?"), "m/m": (0.1, "microstrain?")}
"""Largest value that is usual in a unit, and what the numbers rather are."""


@dataclass(frozen=True)
class ChannelSummary:
    """One channel at a glance; values in its unit.

    Attributes
    ----------
    name, unit : str
    mean, standard_deviation, smallest, largest : float
    drift : float
        Rise of the straight line of least squares from the first sample to the last.
    clipped : int
        Samples that lie flat at the smallest or largest value.
    dropouts : int
        Times that the value stands still between jumps.
    hum : float
        Amplitude of the line at the frequency of the mains, 0 where there is none.
    remarks : tuple of str
        What to clear up before going on.
    """

    name: str
    unit: str
    mean: float
    standard_deviation: float
    smallest: float
    largest: float
    drift: float
    clipped: int
    dropouts: int
    hum: float
    remarks: tuple[str, ...]


@dataclass(frozen=True, repr=False)
class Summary:
    """What a first look at a record shows.

    Attributes
    ----------
    channels : tuple of ChannelSummary
    samples : int
    rate : float
        [1/s]
    """

    channels: tuple[ChannelSummary, ...]
    samples: int
    rate: float

    @property
    def remarks(self) -> tuple[str, ...]:
        """Remarks of all channels, each with the name of its channel."""
        return tuple(f"{c.name}: {remark}" for c in self.channels for remark in c.remarks)

    @property
    def _title(self) -> str:
        seconds = self.samples / self.rate
        return f"{self.samples} samples at {self.rate:.5g} per second, {seconds:.5g} s, up to {self.rate / 2:.5g} Hz"

    def __repr__(self) -> str:
        lines = [f"{self._title}"]
        for c in self.channels:
            lines.append(
                f"  {c.name} [{c.unit}]: {c.smallest:.4g} to {c.largest:.4g}, mean {c.mean:.4g}, "
                f"standard deviation {c.standard_deviation:.4g}"
            )
            lines += [f"    ! {remark}" for remark in c.remarks]
        return "\n".join(lines)

    def _repr_html_(self) -> str:
        heads = ("channel", "unit", "smallest", "largest", "mean", "standard deviation", "drift", "remarks")
        rows = ""
        for c in self.channels:
            numbers = (c.smallest, c.largest, c.mean, c.standard_deviation, c.drift)
            cells = [c.name, c.unit, *(f"{x:.4g}" for x in numbers), "; ".join(c.remarks) or "none"]
            rows += "<tr>" + "".join(f"<td>{escape(cell)}</td>" for cell in cells) + "</tr>"
        head = "".join(f"<th>{h}</th>" for h in heads)
        return f"<table><caption>{self._title}</caption><thead><tr>{head}</tr></thead><tbody>{rows}</tbody></table>"


def summarize(samples: np.ndarray, rate: float, names: Sequence[str], units: Sequence[str]) -> Summary:
    """Look at each channel: level, drift, clipping, dropouts, hum and unit.

    Parameters
    ----------
    samples : ndarray, shape (N, channels)
        Finite.
    rate : float
        Samples per second [1/s].
    names, units : sequence of str
        One for each channel.
    """
    looks = (_channel(x, rate, n, u) for x, n, u in zip(samples.T, names, units, strict=True))
    return Summary(tuple(looks), len(samples), rate)


def _channel(x: np.ndarray, rate: float, name: str, unit: str) -> ChannelSummary:
    mean, spread, low, high = float(x.mean()), float(x.std()), float(x.min()), float(x.max())
    if low == high:
        remarks = ("the value never changes", *_about_unit(unit, mean, 0.0, high))
        return ChannelSummary(name, unit, mean, 0.0, low, high, 0.0, 0, 0, 0.0, remarks)
    place = np.linspace(-0.5, 0.5, len(x))
    drift = float(place @ x / (place @ place))
    dropouts, held = find_dropouts(x)
    rest = x[~held]
    clipped = _flat_at(rest, high) + _flat_at(-rest, -low) if len(rest) else 0
    frequency, hum = _hum(x - mean, rate)
    found = [
        # A line takes d²/12 of the mean square: remarkable where that is a tenth.
        (drift**2 / 12 > 0.1 * spread**2, f"drifts by {drift:.3g} {unit} from the first sample to the last"),
        (clipped > 0, f"{clipped} samples lie flat at the largest or smallest value: clipped?"),
        (
            dropouts > 0,
            f"stands still {dropouts} time{'s' * (dropouts != 1)} between jumps: dropouts of the signal?",
        ),
        (hum > 0, f"a line of {hum:.3g} {unit} at {frequency:g} Hz: hum of the mains?"),
    ]
    remarks = [text for true, text in found if true]
    remarks += _about_unit(unit, mean, spread, max(abs(low), abs(high)))
    return ChannelSummary(name, unit, mean, spread, low, high, drift, clipped, dropouts, hum, tuple(remarks))


def _flat_at(x: np.ndarray, top: float) -> int:
    """Samples at the largest value that neighbor each other.

    A slow signal of coarse steps rests at its top as well, but hardly longer than one step below.
    """
    at = x == top
    if np.all(at):
        return 0
    runs = at[1:-1] & at[:-2] & at[2:]
    count = int(np.sum(at))
    below = int(np.sum(x == np.max(x, where=~at, initial=-np.inf)))
    return count if np.any(runs) and count > 3 * below else 0


def find_dropouts(x: np.ndarray) -> tuple[int, np.ndarray]:
    """How many there are, and which samples they hold, shape (N,) of bool.

    A plateau at the largest magnitude, however steep its edges, is clipping and no dropout.
    """
    step = np.diff(x)
    edges = np.flatnonzero(step)  # runs of equal samples lie between these
    jump = np.concatenate([[0.0], np.abs(step[edges]), [0.0]])
    length = np.diff(np.concatenate([[-1], edges, [len(x) - 1]]))
    size = np.abs(x[np.concatenate([[0], edges + 1])])
    held = (length >= HELD) & (np.maximum(jump[:-1], jump[1:]) > JUMP * np.median(jump[1:-1]))
    held &= size < np.max(np.abs(x))
    return int(np.sum(held)), np.repeat(held, length)


def _hum(x: np.ndarray, rate: float) -> tuple[float, float]:
    """Frequency and amplitude of a line at the frequency of the mains; zeros where there is none."""
    x = x[: 2**18]
    f = np.fft.rfftfreq(len(x), 1 / rate)
    if f[1] > 1 or len(x) < 64:  # too short to tell a line from what is beside it
        return 0.0, 0.0
    size = np.abs(np.fft.rfft(x * np.hanning(len(x)))) * (4 / len(x))
    for mains in MAINS:
        near = np.abs(f - mains) < max(3 * f[1], 0.1)
        around = (np.abs(f - mains) < max(40 * f[1], 5.0)) & ~near
        if mains < rate / 2 and np.any(around):
            line = float(size[near].max())
            inside = near & (size == line)
            if (
                line > LINE * np.median(size[around])
                and line > 1e-3 * x.std()
                and abs(f[inside][0] - mains) < 2 * f[1]
            ):
                return mains, line
    return 0.0, 0.0


def _about_unit(unit: str, mean: float, spread: float, largest: float) -> list[str]:
    if unit in ("-", ""):
        return ["no unit: say what is measured"]
    factor = si_factor(unit)
    if factor is None:
        return [f"the unit {unit!r} is not known"]
    remarks = []
    if unit == "m/s^2" and abs(abs(mean) - 9.81) < 0.3:
        remarks.append("the mean is that of gravity: the sensor feels its weight")
    if unit == "m/s^2" and spread > 1e4:
        remarks.append(f"a standard deviation of {spread:.3g} m/s^2 is very large: millimeters or volts?")
    if unit in ODD and largest > ODD[unit][0]:
        remarks.append(f"a value of {largest:.3g} {unit} is very large: {ODD[unit][1]}")
    if unit == "g":
        remarks.append("g reads gram: of accelerations write m/s^2, 1 g is 9.80665 of them")
    elif abs(factor - 1) > 1e-12:
        remarks.append(f"1 {unit} is {factor:.5g} in SI units: convert before it meets SI values")
    return remarks
