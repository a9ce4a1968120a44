"""Spectra of records: amplitudes of lines, densities, folding, and densities of derivatives.  Sections 9.6 to 9.8."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from engdyn.errors import EngdynError
from engdyn.experiment.averaging import AveragedSpectrum, averaged_spectrum
from engdyn.experiment.segments import cut, density_unit, doubled
from engdyn.experiment.windows import amplitude_correction
from engdyn.record import Record
from engdyn.spectrum import Spectrum
from engdyn.units import _registry

__all__ = ["alias_frequency", "amplitude_spectrum", "motion_psd", "power_spectral_density"]

KINDS = ("displacement", "velocity", "acceleration")


def amplitude_spectrum(
    record: Record, window: str = "boxcar", detrend: str | None = None, interpolation: int = 1
) -> Spectrum:
    """Peak amplitudes of the lines of a record: abs(X₀)/Σw, 2 abs(X_k)/Σw, and abs(X)/Σw of the Nyquist line.

    Parameters
    ----------
    record : Record
        One channel.
    window : str
        See `window`. Amplitudes are corrected for it: a sine on a line has its own.
    detrend : {None, "constant", "linear"}
        What is taken out before: nothing, the mean or the straight line that fits the record.
    interpolation : int
        Times as many lines, by zeros that are appended. They show the curve between the lines and nothing else: what
        is resolved is 1/T apart as before, T being the length of the record.

    Returns
    -------
    Spectrum
        In the unit of the record; ``.correction`` is N/Σw. A record with an odd number of samples has no Nyquist line.

    Raises
    ------
    RecordError
        Several channels; an unknown detrend.
    EngdynError
        An unknown window; an interpolation that is not a whole number of 1 or more.

    Notes
    -----
    Course sections 9.6 to 9.8. Right for sines, whatever the length of the record; the level of noise in it depends
    on that length: for noise see `power_spectral_density`. Without window, the mean square of the record is that of
    its lines: A₀² + Σ A_k²/2 + A_Nyquist².

    Examples
    --------
    >>> import engdyn as ed
    >>> cosine = [1.0, 0.0, -1.0, 0.0] * 2
    >>> ed.amplitude_spectrum(ed.Record(cosine, rate=8.0, name="x", unit="m")).values.round(12).tolist()
    [0.0, 0.0, 1.0, 0.0, 0.0]
    """
    if not isinstance(interpolation, int | np.integer) or interpolation < 1:
        raise EngdynError(f"interpolation is {interpolation!r}: how many times as many lines, 1, 2, 3 …")
    whole = cut(record, window, None, 0, detrend)
    length = interpolation * whole.length
    ((X,),) = whole.transforms(length)
    values = np.abs(X) * doubled(length) / np.sum(whole.weights)
    frequency = np.arange(len(X)) * (record.rate / length)
    correction = amplitude_correction(whole.weights)
    return Spectrum(frequency, values, whole.unit, window=window, correction=correction, rate=record.rate)


def power_spectral_density(
    record: Record,
    window: str = "hann",
    segment: int | None = None,
    overlap: float = 0.5,
    detrend: str | None = "constant",
    *,
    one_sided: bool = True,
) -> AveragedSpectrum:
    """Power spectral density of a record per Hz, the average of its segments as Welch does it.

    Parameters
    ----------
    record, window, segment, overlap, detrend
        As for `averaged_spectrum`. Without ``segment`` the whole record is one, and the scatter of noise is as large as
        its density: see ``.confidence_band()``.
    one_sided : bool
        Whether the density stands for negative frequencies as well.

    Returns
    -------
    AveragedSpectrum
        2 abs(X)²/(rate Σw²), at 0 Hz and the Nyquist line half of that; ``.correction`` is N/Σw².

    Raises
    ------
    RecordError, EngdynError
        As for `averaged_spectrum`.

    Notes
    -----
    Course sections 7.3, 9.8 and 9.10. The sum of the densities times the distance of the lines is Σ(wx)²/Σw², for one
    segment exactly, which is the mean square of the record when there is no window.
    """
    found = averaged_spectrum(record, window, segment, overlap, detrend)
    return found if one_sided else found.as_two_sided()


def alias_frequency(frequency: Any, rate: float) -> Any:
    """Frequency at which a sine appears after sampling: folded into the band from 0 to rate/2.

    Parameters
    ----------
    frequency : float or array_like
        [Hz]
    rate : float
        Samples per second.

    Returns
    -------
    float or ndarray
        abs(f − k·rate) with the k that makes it least [Hz].

    Raises
    ------
    EngdynError
        A rate that is not positive, frequencies that are not finite.

    Notes
    -----
    Course section 9.7.

    Examples
    --------
    >>> alias_frequency([7.0, 13.0, 23.0], rate=10.0).tolist()
    [3.0, 3.0, 3.0]
    """
    f = np.asarray(frequency, dtype=float)
    if not (0 < rate < np.inf) or not np.all(np.isfinite(f)):
        raise EngdynError(
            f"rate is {rate!r}, frequency {frequency!r}: give positive samples per second and finite Hz"
        )
    folded = np.abs(f - rate * np.round(f / rate))
    return folded if folded.ndim else float(folded)


def motion_psd(spectrum: Spectrum, wanted: str) -> Spectrum:
    """Density of displacement, velocity or acceleration from that of another of them: times (2πf)² for each derivative.

    Parameters
    ----------
    spectrum : Spectrum
        Its unit tells what it is the density of: "m^2/Hz", "(m/s)^2/Hz", "(rad/s^2)^2/Hz".
    wanted : {"displacement", "velocity", "acceleration"}

    Returns
    -------
    Spectrum
        Without the line at 0 Hz where it was integrated. Noise of the instrument at low frequencies grows with it:
        judge from where on it is true.

    Raises
    ------
    EngdynError
        No density of a motion in a unit with its seconds ("g" is a gram); another kind wanted.

    Notes
    -----
    Course section 9.10.

    Examples
    --------
    >>> import engdyn as ed
    >>> ed.motion_psd(ed.white_noise([1.0, 2.0], 1.0, "m^2/Hz"), "velocity").unit
    '(m/s)^2/Hz'
    """
    if wanted not in KINDS:
        raise EngdynError(f"wanted is {wanted!r}: choose one of {KINDS}")
    base, given = _motion(spectrum)
    order = KINDS.index(wanted) - given
    kept = spectrum.frequency > 0 if order < 0 else slice(None)
    frequency = spectrum.frequency[kept]
    values = spectrum.values[kept] * (2 * np.pi * frequency) ** (2 * order)
    unit = density_unit(base + ("", "/s", "/s^2")[KINDS.index(wanted)]).removesuffix("Hz") + spectrum.per
    return replace(spectrum, frequency=frequency, values=values, unit=unit)


def _motion(spectrum: Spectrum) -> tuple[str, int]:
    """Unit of the displacement behind a density, and how many derivatives of it the density is of."""
    if not isinstance(spectrum, Spectrum) or spectrum.per is None:
        raise EngdynError(
            f"motion_psd needs a Spectrum of densities, in a unit that ends in /Hz, not {spectrum!r}"
        )
    units = _registry()
    try:
        parts = dict(units.Unit(spectrum.unit.removesuffix("/" + spectrum.per))._units)
        seconds = -parts.pop("second", 0)
        motion = list(parts.values()) == [2] and units.Unit(*parts).dimensionality in ({}, {"[length]": 1})
    except Exception:  # pint raises many kinds of errors on units it does not know
        motion = False
    if not motion or seconds not in (0, 2, 4):
        raise EngdynError(
            f"{spectrum.unit!r} is not the density of a motion: write its unit as m^2/Hz, (m/s)^2/Hz or (m/s^2)^2/Hz, "
            "with another unit in place of m if it is one"
        )
    return f"{units.Unit(*parts):~}", int(seconds) // 2
