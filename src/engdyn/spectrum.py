"""Spectra of what is random or sampled: density over frequency, mean square, and excitations by formula.

A density says per what it is in its unit ("m^2/Hz" or "m^2/(rad/s)") and whether it is one-sided; nothing is
converted silently.  Course sections 7.3 and 9.7.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from engdyn.errors import EngdynError

__all__ = [
    "Spectrum",
    "cumulative_mean_square",
    "earthquake_spectrum",
    "mean_square",
    "road_spectrum",
    "white_noise",
]

PER = {"Hz": 1.0, "(rad/s)": 2 * np.pi}
"""What a density may be per, and how much of it 1 Hz is."""


@dataclass(frozen=True, eq=False, repr=False)
class Spectrum:
    """Values over frequency.

    Attributes
    ----------
    frequency : ndarray, shape (N,)
        [Hz], rising from 0 or above, whatever the values are per.
    values : ndarray, shape (N,)
        Densities, or amplitudes of the lines of a sampled signal.
    unit : str
        Unit of the values. One that ends in "/Hz" or "/(rad/s)" is that of a power spectral density.
    window : str
        Window of a sampled signal.
    correction : float
        What the values were multiplied by because of the window.
    one_sided : bool
        Whether the values stand for negative frequencies as well; a two-sided density is half as large.
    rate : float, optional
        Samples per second of the signal that the spectrum was made of: its lines at 0 and at half the rate have no
        counterpart at negative frequencies, and are not doubled.
    """

    frequency: np.ndarray
    values: np.ndarray
    unit: str
    window: str = "boxcar"
    correction: float = 1.0
    one_sided: bool = True
    rate: float | None = None

    def __post_init__(self) -> None:
        for name in ("frequency", "values"):
            try:
                object.__setattr__(self, name, np.array(getattr(self, name), dtype=float))
            except (TypeError, ValueError) as error:
                raise EngdynError(
                    f"{name} of a spectrum must be real numbers: give one for each frequency"
                ) from error
        f, values = self.frequency, self.values
        if f.ndim != 1 or not len(f) or f.shape != values.shape:
            raise EngdynError(
                f"frequency has shape {f.shape}, values {values.shape}: give one value for each frequency"
            )
        if not (np.all(np.isfinite(f)) and f[0] >= 0 and np.all(np.diff(f) > 0)):
            raise EngdynError("the frequencies of a spectrum must be finite, not negative, and rise")
        if not (np.all(np.isfinite(values)) and (self.per is None or np.all(values >= 0))):
            raise EngdynError("the values of a spectrum must be finite, and a density is never negative")

    @property
    def per(self) -> str | None:
        """What a density is per, "Hz" or "(rad/s)"; None of amplitudes."""
        return next((per for per in PER if self.unit.endswith("/" + per)), None)

    def per_hertz(self) -> Spectrum:
        """The same density per Hz: S(f) df = S(ω) dω, so that S(f) = 2π S(ω)."""
        return self._per("Hz")

    def per_radian(self) -> Spectrum:
        """The same density per rad/s; the frequencies stay in Hz."""
        return self._per("(rad/s)")

    def _per(self, wanted: str) -> Spectrum:
        per = _density(self, "a conversion")
        unit = self.unit.removesuffix(per) + wanted
        return replace(self, values=self.values * (PER[per] / PER[wanted]), unit=unit)

    def as_one_sided(self) -> Spectrum:
        """The same density for f ≥ 0 alone: G(f) = 2 S(f), lines at 0 and half the rate of sampling apart."""
        return self._sided(True)

    def as_two_sided(self) -> Spectrum:
        """The same density for positive and negative frequencies, the positive half of which is listed."""
        return self._sided(False)

    def _sided(self, one_sided: bool) -> Spectrum:
        _density(self, "a conversion")
        if one_sided == self.one_sided:
            return self
        factor = np.full(len(self.values), 2.0 if one_sided else 0.5)
        if self.rate is not None:
            factor[(self.frequency == 0) | np.isclose(self.frequency, self.rate / 2, rtol=1e-12)] = 1.0
        return replace(self, values=self.values * factor, one_sided=one_sided)

    def __repr__(self) -> str:
        low, high = self.frequency[[0, -1]]
        sides = "" if self.per is None else ", one-sided" if self.one_sided else ", two-sided"
        return f"Spectrum({len(self.values)} values [{self.unit}]{sides}, {low:.4g} to {high:.4g} Hz)"


def _density(spectrum: Any, what: str) -> str:
    if not isinstance(spectrum, Spectrum) or spectrum.per is None:
        raise EngdynError(
            f"{what} needs a Spectrum of densities, in a unit that ends in /Hz or /(rad/s), not {spectrum!r}"
        )
    return spectrum.per


def cumulative_mean_square(spectrum: Spectrum) -> np.ndarray:
    """Mean square of what lies below each frequency.

    Parameters
    ----------
    spectrum : Spectrum
        Densities, per Hz or rad/s, one- or two-sided: all are taken for what they are.

    Returns
    -------
    ndarray, shape (N,)
        From 0 at the first frequency to the mean square at the last, by the trapezoidal rule [unit of the signal,
        squared].

    Notes
    -----
    Course section 7.3.

    Examples
    --------
    >>> cumulative_mean_square(white_noise([0.0, 1.0, 3.0], 2.0, "N^2/Hz")).tolist()
    [0.0, 2.0, 6.0]
    """
    per = _density(spectrum, "the mean square")
    density = spectrum.values * PER[per] * (1.0 if spectrum.one_sided else 2.0)
    if not spectrum.one_sided and spectrum.rate is not None:
        density = spectrum.as_one_sided().values * PER[per]
    strips = (density[1:] + density[:-1]) / 2 * np.diff(spectrum.frequency)
    return np.concatenate([[0.0], np.cumsum(strips)])


def mean_square(spectrum: Spectrum, band: tuple[float, float] | None = None) -> float:
    """Mean square of a signal, of what lies within a band of frequencies.

    Parameters
    ----------
    spectrum : Spectrum
        Densities.
    band : (float, float), optional
        [Hz], within the frequencies of the spectrum; all of them where not given. Between frequencies the density
        is a straight line.

    Returns
    -------
    float
        By the trapezoidal rule [unit of the signal, squared].

    Raises
    ------
    EngdynError
        No densities; a band that is empty or beyond the frequencies.

    Notes
    -----
    Course section 7.3.
    """
    _density(spectrum, "the mean square")
    f = spectrum.frequency
    if band is None:
        return float(cumulative_mean_square(spectrum)[-1])
    try:
        low, high = map(float, band)
    except (TypeError, ValueError) as error:
        raise EngdynError(f"band is {band!r}: give two frequencies in Hz") from error
    if not f[0] <= low < high <= f[-1]:
        raise EngdynError(
            f"the band from {low:g} to {high:g} Hz does not lie within the spectrum, {f[0]:g} to {f[-1]:g} Hz: nothing "
            "is known of what is outside"
        )
    inside = np.concatenate([[low], f[(f > low) & (f < high)], [high]])
    part = replace(spectrum, frequency=inside, values=np.interp(inside, f, spectrum.values))
    return float(cumulative_mean_square(part)[-1])


def white_noise(frequency: Any, level: float, unit: str) -> Spectrum:
    """A constant density, one-sided.

    Parameters
    ----------
    frequency : array_like, shape (N,)
        [Hz]
    level : float
        [unit]
    unit : str
        "N^2/Hz", for example.
    """
    return Spectrum(frequency, np.full(np.shape(frequency), level), unit)


def road_spectrum(frequency: Any, speed: float, road_class: str = "C") -> Spectrum:
    """Density of the height of a road under a wheel that rolls along it, one-sided [m²/Hz].

    Parameters
    ----------
    frequency : array_like, shape (N,)
        [Hz], above 0.
    speed : float
        Of the vehicle [m/s].
    road_class : {"A", "B", "C", "D", "E", "F", "G", "H"}
        From very good to very bad.

    Raises
    ------
    EngdynError
        Another class, a speed that is not positive, 0 Hz.

    Notes
    -----
    Course section 7.3. ISO 8608 (1995, 2016): G(n) = G(n₀) (n/n₀)⁻² over the spatial frequency n [1/m], n₀ = 0.1/m,
    with the geometric mean G(n₀) = 16, 64, 256 … · 10⁻⁶ m³ of classes A, B, C …; at a speed v, f = n v and
    G(f) = G(n)/v. Measured roads follow it from about 0.011 to 2.83 1/m.
    """
    if road_class not in tuple("ABCDEFGH"):
        raise EngdynError(f"road_class is {road_class!r}: choose a letter from A (very good) to H (very bad)")
    f = np.asarray(frequency, dtype=float)
    if not speed > 0 or not np.all(f > 0):
        raise EngdynError(
            "a road has no spectrum at standstill or at 0 Hz: give a positive speed and frequencies"
        )
    roughness = 16e-6 * 4.0 ** "ABCDEFGH".index(road_class)
    return Spectrum(f, roughness * 0.1**2 * speed / f**2, "m^2/Hz")


def earthquake_spectrum(
    frequency: Any, level: float, ground_frequency: float = 2.5, ground_damping: float = 0.6
) -> Spectrum:
    """Density of the ground's acceleration in a strong earthquake, one-sided [m²/s⁴/Hz].

    Parameters
    ----------
    frequency : array_like, shape (N,)
        [Hz]
    level : float
        Density of the acceleration of the bedrock, one-sided [m²/s⁴/Hz].
    ground_frequency : float
        Natural frequency of the layer of soil on it [Hz].
    ground_damping : float
        Damping ratio of that layer; the defaults are those of firm soil.

    Notes
    -----
    Course section 7.3. White noise through one oscillator, absolute acceleration: K. Kanai, *Bulletin of the
    Earthquake Research Institute* 35 (1957) 309, and H. Tajimi, *2nd World Conference on Earthquake Engineering*
    (1960) 781. It does not vanish at 0 Hz, so that displacements of the ground have no mean square: use it for
    accelerations and for motions relative to the ground.
    """
    if not (ground_frequency > 0 and ground_damping > 0):
        raise EngdynError("ground_frequency and ground_damping must be positive")
    r2 = (np.asarray(frequency, dtype=float) / ground_frequency) ** 2
    soft = 4 * ground_damping**2 * r2
    return Spectrum(frequency, level * (1 + soft) / ((1 - r2) ** 2 + soft), "m^2/s^4/Hz")
