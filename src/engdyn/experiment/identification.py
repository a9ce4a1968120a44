"""Frequency and damping of single modes: logarithmic decrement and half power.  Sections 9.1 and 9.10, Appendix D."""

from __future__ import annotations

import warnings
from dataclasses import dataclass
from typing import Any

import numpy as np
import scipy.signal

from engdyn.errors import EngdynError, EngdynWarning, RecordError
from engdyn.experiment.fitting import Fit, fit
from engdyn.record import Record
from engdyn.spectrum import Spectrum

__all__ = ["Decrement", "HalfPower", "half_power", "log_decrement"]

FADED = 0.05
"""Swings below this share of the largest are left to the noise."""

REFUSED, NOTICED = 0.15, 0.03
"""Share of the motion (rms) that one decaying mode does not explain: refused, or warned about; what is left at its own
frequency, as of friction, is refused above twice as much."""


@dataclass(frozen=True, eq=False, repr=False)
class Decrement:
    """A free vibration that dies out.

    Attributes
    ----------
    decrement : float
        δ = ln(x₀/x₁) of two maxima that follow each other, about the mean they swing about.
    damping_ratio : float
        ζ = δ/√(4π² + δ²).
    uncertainty : float
        Standard deviation of ζ from the scatter of the swings.
    damped_frequency : float
        [Hz]
    offset : float
        Mean that it swings about [unit of the record].
    times, extremes : ndarray, shape (K,)
        Times [s] and values of the maxima and minima in turn.
    line : Fit
        Straight line through the logarithm of the swings, over half periods.
    """

    decrement: float
    damping_ratio: float
    uncertainty: float
    damped_frequency: float
    offset: float
    times: np.ndarray
    extremes: np.ndarray
    line: Fit

    @property
    def natural_frequency(self) -> float:
        """Undamped, f_d/√(1 − ζ²) [Hz]."""
        return self.damped_frequency / np.sqrt(1 - self.damping_ratio**2)

    def __repr__(self) -> str:
        return (
            f"Decrement({self.decrement:.4g} over {len(self.extremes)} extremes: ζ = {self.damping_ratio:.4g} ± "
            f"{self.uncertainty:.1g}, natural frequency {self.natural_frequency:.5g} Hz)"
        )

    def _repr_html_(self) -> str:
        rows = (
            ("decrement", f"{self.decrement:.4g}"),
            ("damping ratio", f"{self.damping_ratio:.4g} ± {self.uncertainty:.1g}"),
            ("damped frequency [Hz]", f"{self.damped_frequency:.5g}"),
            ("natural frequency [Hz]", f"{self.natural_frequency:.5g}"),
            ("offset", f"{self.offset:.4g}"),
        )
        cells = "".join(f"<tr><th>{name}</th><td>{value}</td></tr>" for name, value in rows)
        return f"<table><caption>{len(self.extremes)} extremes</caption><tbody>{cells}</tbody></table>"


def log_decrement(record: Record, rate: float | None = None) -> Decrement:
    """Damping from a free vibration of one mode.

    Parameters
    ----------
    record : Record or array_like, shape (N,)
        One channel that begins when the system is left alone.
    rate : float, optional
        Samples per second [1/s], of an array.

    Returns
    -------
    Decrement

    Raises
    ------
    RecordError
        Several channels, less than four extremes, a motion that does not decay; several modes: the decrement of their
        sum belongs to none of them.

    Warns
    -----
    EngdynWarning
        A trace of a second mode, or a decrement that changes with the amplitude, as friction and large swings make it.

    Notes
    -----
    Differences of neighboring extremes hold no offset and hardly any drift; the straight line through their logarithms
    is weighted by the swings, because the logarithm magnifies the noise of the small ones. Linear damping only.
    """
    record = record if isinstance(record, Record) else Record(record, rate if rate is not None else np.nan)
    if len(record.channels) > 1:
        raise RecordError(f"choose one channel of {', '.join(record.channels)}: record[name]")
    x = record.samples.reshape(-1)
    places, values = _extremes(x)
    swings = np.abs(np.diff(values))
    faded = np.flatnonzero(swings < FADED * swings.max())
    used = int(faded[0]) if len(faded) else len(swings)
    if swings[0] < FADED * swings.max():
        raise RecordError("the swings grow: this is no free vibration with damping")
    if used < 3:
        raise RecordError(
            f"only {used} swings are above {FADED:.0%} of the largest: a decrement needs three or more. Record "
            "longer, or fit a decaying function"
        )
    if np.any(swings[used:] > 4 * FADED * swings.max()):
        raise RecordError(
            "the swings fade and grow again: two modes of close frequencies beat. Use fit_modes"
        )
    swings, places, values = swings[:used], places[: used + 1], values[: used + 1]
    line = fit(np.arange(used), np.log(swings), "line", sigma=swings.max() / swings)
    delta = -2 * line["c1"]
    if not delta > 0:
        raise RecordError("the swings do not become smaller: this is no free vibration with damping")
    sizes = np.append(swings, swings[-1])
    half = fit(np.arange(used + 1), places, "line", sigma=swings.max() / sizes)["c1"] / record.rate
    zeta = delta / np.hypot(2 * np.pi, delta)
    rate_of_zeta = 4 * np.pi**2 / np.hypot(2 * np.pi, delta) ** 3  # dζ/dδ
    start, end = int(places[0]), int(np.ceil(places[-1])) + 1
    offset = _judge(x[start:end], zeta, half * record.rate)
    return Decrement(
        float(delta), float(zeta), float(2 * line.uncertainty[1] * rate_of_zeta), float(0.5 / half), offset,
        record.start + places / record.rate, values, line,
    )  # fmt: skip


def _extremes(x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Places, between the samples, and values of maxima and minima in turn."""
    slope = np.linspace(-1, 1, len(x))
    level = x - x.mean() - slope * (slope @ (x - x.mean())) / (slope @ slope)
    size = np.abs(np.fft.rfft(level, 4 * len(x)))
    period = 4 * len(x) / max(int(np.argmax(size)), 1)
    if period < 6 or period > len(x):
        raise RecordError(
            f"{len(x)} samples with {period:.3g} in a period: a decrement needs six or more in a period, and several "
            "periods"
        )
    smooth = scipy.signal.savgol_filter(level, max(2 * int(period / 12) + 1, 3), 2) if period > 36 else level
    near = max(int(0.35 * period), 1)
    height = 0.3 * FADED * np.ptp(level)
    tops = [
        scipy.signal.find_peaks(sign * smooth, distance=near, prominence=height)[0] for sign in (1.0, -1.0)
    ]
    signed = sorted([(k, 1.0) for k in tops[0]] + [(k, -1.0) for k in tops[1]])
    kept: list[tuple[int, float]] = []
    for k, sign in signed:  # of neighbors of the same kind only the larger is an extreme
        if kept and kept[-1][1] == sign:
            if sign * smooth[k] > sign * smooth[kept[-1][0]]:
                kept[-1] = (k, sign)
        else:
            kept.append((k, sign))
    if len(kept) < 4:
        raise RecordError(f"there are {len(kept)} maxima and minima: a decrement needs four or more")
    tops = [_vertex(x, k, max(int(period / 10), 1)) for k, _ in kept]
    return np.array([place for place, _ in tops]), np.array([value for _, value in tops])


def _vertex(x: np.ndarray, k: int, width: int) -> tuple[float, float]:
    """Place and value of the parabola through the samples around an extreme."""
    width = min(width, k, len(x) - 1 - k)
    if width < 1:
        return float(k), float(x[k])
    around = np.arange(-width, width + 1)
    c, b, a = np.polynomial.polynomial.polyfit(around, x[k - width : k + width + 1], 2)
    shift = float(np.clip(-b / (2 * a), -width, width)) if a else 0.0
    return k + shift, float(c + shift * (b + a * shift))


def _judge(x: np.ndarray, zeta: float, half: float) -> float:
    """The offset; a word, or a refusal, where one decaying mode does not explain the samples."""
    k = np.arange(len(x))
    phase, decay = np.pi * k / half, np.exp(-np.pi * k / half * zeta / np.sqrt(1 - zeta**2))
    rise = k / len(x) - 0.5
    matrix = np.column_stack([decay * np.cos(phase), decay * np.sin(phase), np.ones(len(x)), rise])
    factors = np.linalg.lstsq(matrix, x, rcond=None)[0]
    left = x - matrix @ factors
    motion = matrix[:, :2] @ factors[:2]
    lines = np.abs(np.fft.rfft(left)) ** 2
    top = int(np.argmax(lines))
    # Noise spreads over all lines, another mode does not.
    tonal = np.sum(lines[max(top - 2, 0) : top + 3]) / max(float(np.sum(lines)), np.finfo(float).tiny)
    share = float(np.linalg.norm(left) / np.linalg.norm(motion)) if np.any(motion) else np.inf
    strength = share * np.sqrt(tonal)
    own = len(x) / (2 * half)
    if strength > 2 * REFUSED:
        raise RecordError(
            f"{share:.0%} of the motion is not that of one decaying mode: there are several, or damping is far from "
            "linear. Filter one mode out, or use fit_modes"
        )
    if strength > NOTICED and abs(top - own) <= max(0.2 * own, 1.5):
        warnings.warn(
            "the decrement changes on the way: friction, large swings or a close second mode. What is returned is a "
            "mean",
            EngdynWarning,
            stacklevel=3,
        )
    elif strength > NOTICED:
        told = (
            f"{share:.0%} of the motion is at another frequency, about {top / own:.2g} times this one: there are "
            "several modes. Filter one out, or use fit_modes"
        )
        if strength > REFUSED:
            raise RecordError(told)
        warnings.warn(told, EngdynWarning, stacklevel=3)
    return float(factors[2])


@dataclass(frozen=True)
class HalfPower:
    """A resonance peak.

    Attributes
    ----------
    frequency : float
        Of the peak [Hz].
    damping_ratio : float
        (f₂² − f₁²)/(4 f²).
    band : (float, float)
        Where the power is half as large [Hz].
    lines : float
        Lines of the spectrum within the band.
    """

    frequency: float
    damping_ratio: float
    band: tuple[float, float]
    lines: float


def half_power(response: Any, frequency: float | None = None) -> HalfPower:
    """Damping from the width of a resonance peak.

    Parameters
    ----------
    response : frequency response or Spectrum
        With `.frequency` [Hz] and `.response`, or a Spectrum of amplitudes or densities of a motion under broad-band
        excitation.
    frequency : float, optional
        About where the peak is [Hz]; the highest peak where not given.

    Raises
    ------
    EngdynError
        No peak there, or it does not fall to half power on both sides.

    Warns
    -----
    EngdynWarning
        Less than five lines within the band: the window and the line spacing are measured, not the damping.

    Notes
    -----
    Light damping of one mode that stands alone. From f₁,₂² = f²(1 ∓ 2ζ): the usual (f₂ − f₁)/(2f) is the same for
    small ζ.
    """
    f, power = _power(response)
    tops = scipy.signal.find_peaks(power)[0]
    if not len(tops):
        raise EngdynError("there is no peak between the first and the last frequency")
    top = tops[np.argmax(power[tops])] if frequency is None else _climbed(power, f, float(frequency))
    if top not in tops:
        raise EngdynError(
            f"there is no peak near {frequency:g} Hz; there are some at {np.round(f[tops][:5], 4)} Hz"
        )
    peak, level = _vertex(power, int(top), 1)
    below, above = (np.flatnonzero(power[part] < level / 2) for part in (slice(0, top), slice(top, None)))
    if not (len(below) and len(above)):
        raise EngdynError(
            "the peak does not fall to half its power on both sides: another mode is too near, or the band ends"
        )
    i, j = int(below[-1]), int(top + above[0])
    low = f[i] + (f[i + 1] - f[i]) * (level / 2 - power[i]) / (power[i + 1] - power[i])
    high = f[j - 1] + (f[j] - f[j - 1]) * (power[j - 1] - level / 2) / (power[j - 1] - power[j])
    center = float(np.interp(peak, np.arange(len(f)), f))
    lines = float(np.interp(high, f, np.arange(len(f))) - np.interp(low, f, np.arange(len(f))))
    if lines < 5:
        warnings.warn(
            f"only {lines:.1f} lines lie within the half-power band: the true peak is narrower. Take longer segments",
            EngdynWarning,
            stacklevel=2,
        )
    return HalfPower(center, float((high**2 - low**2) / (4 * center**2)), (float(low), float(high)), lines)


def _power(response: Any) -> tuple[np.ndarray, np.ndarray]:
    if isinstance(response, Spectrum):
        return response.frequency, response.values if response.per else response.values**2
    try:
        f, h = np.asarray(response.frequency, dtype=float), np.asarray(response.response)
    except AttributeError as error:
        raise EngdynError("response needs .frequency and .response, or is a Spectrum") from error
    if h.shape != f.shape:
        raise EngdynError(f"response has shape {h.shape}: choose one channel")
    return f, np.abs(h) ** 2


def _climbed(power: np.ndarray, f: np.ndarray, frequency: float) -> int:
    """The peak that one comes to by climbing from a frequency."""
    k = int(np.argmin(np.abs(f - frequency)))
    while 0 < k < len(f) - 1 and max(power[k - 1], power[k + 1]) > power[k]:
        k += 1 if power[k + 1] > power[k - 1] else -1
    return k
