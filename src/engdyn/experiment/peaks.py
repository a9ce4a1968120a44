"""Peaks of an averaged density, and the resonances that fit them.  Course section 9.10."""

from __future__ import annotations

import math
import warnings
from dataclasses import dataclass

import numpy as np
from scipy.signal import find_peaks

from engdyn.errors import EngdynError, EngdynWarning
from engdyn.experiment.averaging import AveragedSpectrum
from engdyn.experiment.fitting import fit
from engdyn.experiment.identification import half_power

__all__ = ["Peak", "peaks"]

MOST = 8
"""Peaks that are told."""


@dataclass(frozen=True)
class Peak:
    """A peak of a density.

    Attributes
    ----------
    frequency : float
        [Hz]
    level : float
        Density there.
    damping_ratio, uncertainty : float or None
        Of the resonance that fits the peak, and its standard deviation; None where the peak is too narrow to tell.
    """

    frequency: float
    level: float
    damping_ratio: float | None = None
    uncertainty: float | None = None


def peaks(density: AveragedSpectrum) -> list[Peak]:
    """Peaks that stand out of the scatter, the strongest first.

    Parameters
    ----------
    density : AveragedSpectrum

    Notes
    -----
    Course section 9.10. A peak counts where it rises above its neighborhood by more than the ratio of the
    confidence band that holds all lines together with 95 % probability (C. E. Bonferroni). Its frequency and damping
    ratio are those of one resonance under broad-band excitation, fitted to the logarithms of the lines around it,
    which scatter alike; none is given where fewer than five lines lie in the half-power band: then the window
    would be measured.
    """
    low, high = density.confidence_band(1.0 - 0.05 / len(density.frequency))
    inside = slice(1, None)  # what is left of the mean is no peak
    values = np.maximum(density.values[inside], np.max(density.values) * 1e-30)
    scatter = float(np.median(np.log10(high[inside] / low[inside])))
    tops = find_peaks(np.log10(values), prominence=scatter)[0]
    order = tops[np.argsort(values[tops])[::-1]][:MOST]
    return [_resonance(density, int(k) + 1) for k in order]


def _resonance(density: AveragedSpectrum, k: int) -> Peak:
    """The resonance that fits the lines around a peak."""
    f, values = density.frequency, density.values
    plain = Peak(float(f[k]), float(values[k]))
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", EngdynWarning)
            width = half_power(density, float(f[k])).band
        reach = max(3.0 * (width[1] - width[0]), 8.0 * (f[1] - f[0]))
        near = (np.abs(f - f[k]) < reach) & (values > 0) & (f > 0)
        start = {
            "level": math.log(values[k]),
            "center": float(f[k]),
            "zeta": 0.5 * (width[1] - width[0]) / f[k],
        }
        start["level"] += 2 * math.log(2 * start["zeta"])
        found = fit(f[near], np.log(values[near]), _log_resonance, start)
    except EngdynError:
        return plain
    center, zeta = found["center"], abs(found["zeta"])
    if not abs(center - f[k]) < reach or 2 * zeta * center < 5 * (f[1] - f[0]):
        return plain
    return Peak(center, plain.level, zeta, float(found.uncertainty[found.names.index("zeta")]))


def _log_resonance(f: np.ndarray, level: float, center: float, zeta: float) -> np.ndarray:
    r2 = (f / center) ** 2
    return level - np.log((1 - r2) ** 2 + 4 * zeta**2 * r2)
