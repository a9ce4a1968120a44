"""Fewer samples per second: low-pass first, then every n-th sample.  Course section 9.9."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from engdyn.errors import RecordError
from engdyn.record import Record

__all__ = ["DecimatedRecord", "decimate"]

USABLE, ATTENUATION = 0.8, 80.0
"""The low-pass passes up to this part of the new Nyquist frequency; from there on it stops by so many decibels."""


@dataclass(frozen=True, eq=False, repr=False)
class DecimatedRecord(Record):
    """A record with fewer samples per second than it was measured with.

    Attributes
    ----------
    usable_frequency : float
        Up to here amplitudes and phases are those of the original, to 1e-4 [Hz].
    edge : int
        So many samples at either end know of what was before the record began or after it ended, which is guessed
        (the record turned about its end).
    """

    usable_frequency: float = 0.0
    edge: int = 0


def decimate(record: Record, factor: int) -> DecimatedRecord:
    """Keep every n-th sample of a record, after all that would fold has been filtered out.

    Parameters
    ----------
    record : Record
        One or more channels. What had folded when it was measured is in its band and cannot be taken out any more.
    factor : int
        n; the new rate is rate/n.

    Returns
    -------
    DecimatedRecord
        With ``.usable_frequency`` = 0.8 of the new Nyquist frequency, and the number of samples, ``.edge``, not to be
        trusted at either end.

    Raises
    ------
    RecordError
        A factor that is not a whole number of 1 or more; a record too short for the filter.

    Notes
    -----
    Course section 9.9. A symmetric filter of finite length with a Kaiser window, shifted by half its length, so that
    it has no phase; what is above the new Nyquist frequency is weakened by 80 dB.
    """
    from scipy.signal import firwin, kaiserord, upfirdn

    if not isinstance(record, Record) or not isinstance(factor, int | np.integer) or factor < 1:
        raise RecordError(f"decimate needs a Record and a whole factor of 1 or more, not {factor!r}")
    taps, beta = kaiserord(ATTENUATION, (1 - USABLE) / factor)
    half = -(-taps // (2 * factor)) * factor if factor > 1 else 0
    if len(record) <= half:
        raise RecordError(
            f"the filter for one sample in {factor} reaches {half} samples to either side, the record has "
            f"{len(record)}: take a longer record or a smaller factor"
        )
    x = record.samples.reshape(len(record), -1)
    if half:
        low_pass = firwin(2 * half + 1, (1 + USABLE) / 2 / factor, window=("kaiser", beta))
        before, after = 2 * x[0] - x[half:0:-1], 2 * x[-1] - x[-2 : -half - 2 : -1]
        wide = upfirdn(low_pass, np.concatenate([before, x, after]), down=factor, axis=0)
        x = wide[2 * half // factor :][: -(-len(record) // factor)]
    samples = x if record.samples.ndim == 2 else x[:, 0]
    rate = record.rate / factor
    usable = (USABLE if half else 1.0) * rate / 2
    kept = (record.name, record.unit, record.start, record.metadata)
    return DecimatedRecord(samples, rate, *kept, usable, half // factor)
