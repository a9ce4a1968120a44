"""Response of a linear system to random excitation.  Course section 7.3."""

from __future__ import annotations

import re
from dataclasses import replace

import numpy as np

from engdyn.analysis.response import FrequencyResponse
from engdyn.errors import EngdynError
from engdyn.spectrum import Spectrum
from engdyn.units import UNIT, _registry

__all__ = ["response_psd"]


def response_psd(response: FrequencyResponse, input_psd: Spectrum) -> Spectrum:
    """Power spectral density of the response to one random input: abs(H)² S.

    Parameters
    ----------
    response : FrequencyResponse
        Of one input and one output, per unit of what the density is of: to a ground acceleration, say, with the
        input ``{"xb": lambda f: -1 / (2 * np.pi * f) ** 2}``.
    input_psd : Spectrum
        Of the input, per Hz or rad/s, one- or two-sided: the result is what it is.

    Returns
    -------
    Spectrum
        On the frequencies of the response; the input's density is interpolated by straight lines between its own.
        Its unit is that of the response squared times that of the input; where the response has none it says so.

    Raises
    ------
    EngdynError
        No density; frequencies of the response beyond those of the input; several inputs or outputs.

    Notes
    -----
    Course section 7.3.
    """
    if not isinstance(response, FrequencyResponse) or response.response.ndim != 1:
        raise EngdynError("response_psd needs the FrequencyResponse of one input and one output")
    if not isinstance(input_psd, Spectrum) or input_psd.per is None:
        raise EngdynError(
            f"input_psd must be a Spectrum of densities (unit ending in /Hz or /(rad/s)), not {input_psd!r}"
        )
    f, known = response.frequency, input_psd.frequency
    if f[0] < known[0] or f[-1] > known[-1]:
        raise EngdynError(
            f"the response reaches from {f[0]:g} to {f[-1]:g} Hz, the density of the input from {known[0]:g} to "
            f"{known[-1]:g} Hz only: nothing is known of it outside"
        )
    values = response.amplitude**2 * np.interp(f, known, input_psd.values)
    per = "/" + input_psd.per
    unit = f"|H|^2 {input_psd.unit}"
    if response.unit:
        unit = _product({response.unit: 2, input_psd.unit.removesuffix(per): 1}) + per
    return replace(input_psd, frequency=f, values=values, unit=unit)


def _product(powers: dict[str, int]) -> str:
    """Product of powers of units, written as units are here."""
    total = _registry().Unit("")
    for unit, power in powers.items():
        try:
            if unit != "-" and not re.fullmatch(UNIT, unit):
                raise EngdynError("text that is more than a unit is not handed on")
            total *= _registry().Unit("" if unit in ("", "-") else unit) ** power
        except Exception as error:  # pint raises many kinds of errors on units it does not know
            raise EngdynError(
                f"{unit!r} is not a unit: write it like m/N or m^2/s^4, or - for none"
            ) from error
    return re.sub(r" ?(/) ?| \* ", lambda found: found[1] or " ", f"{total:~}".replace(" ** ", "^")) or "1"
