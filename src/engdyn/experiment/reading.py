"""Reading records that others have made.  Course section 9.1."""

from __future__ import annotations

import os
import warnings
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from engdyn.errors import RecordError
from engdyn.experiment.binary_files import READERS, kind_of
from engdyn.experiment.raw import Raw, even_rate, resampled
from engdyn.experiment.text_files import read_text
from engdyn.record import Record

__all__ = ["read_record"]


def read_record(
    path: str | os.PathLike[str],
    channel: str | int | None = None,
    rate: float | None = None,
    unit: str | Sequence[str] | None = None,
    resample: float | None = None,
) -> Record:
    """A record from a file: CSV, TSV, WAV, MAT, NPY, NPZ, UFF 58, TDMS, MiniSEED or SAC.

    Parameters
    ----------
    path : str or path
        The first bytes tell what it is, then the ending; all else is read as text. Of text the separator, the decimal
        comma, the names with units (``acc [m/s^2]``, also in a row of their own) and the times are found out.
    channel : str or int, optional
        One channel, by name or by number; all where not given. Of MAT and NPZ files with several arrays it names
        the array.
    rate : float, optional
        Samples per second [1/s]; needed where the file has neither times nor a rate. What the file says must agree.
    unit : str or sequence of str, optional
        Unit of the channels, in place of the file's own.
    resample : float, optional
        Samples per second [1/s] of an even grid to interpolate on, where times are not even or samples missing.

    Returns
    -------
    Record
        Its `metadata` name the file and its kind.

    Raises
    ------
    RecordError
        No such file; empty, damaged or no table of numbers; times that are not even; a missing rate. The message names
        line and column where the file has lines.

    Notes
    -----
    Course section 9.1.  Samples of WAV files are shares of full scale, −1 to 1.  No file can make it run code: pickled
    arrays are refused.  UFF and TDMS need the extra ``data``, MiniSEED and SAC the extra ``seismic``.
    """
    path = Path(path)
    if not path.is_file():
        raise RecordError(
            f"there is no file {str(path)!r}" if not path.exists() else f"{str(path)!r} is no file"
        )
    rate, resample = _number(rate, "rate"), _number(resample, "resample")
    if unit is not None and not isinstance(unit, str | list | tuple):
        raise RecordError(f"unit is {unit!r}: give text, or a list with one text for each channel")
    kind, raw = _raw(path, channel)
    if resample is not None:
        raw = resampled(raw, resample)
    _check_finite(raw, path)
    sampling = _rate(raw, rate, path)
    start = raw.start if raw.time is None else float(raw.time[0])
    single = raw.columns.shape[1] == 1
    units = ([unit] * len(raw.units) if isinstance(unit, str) else unit) or raw.units
    record = Record(
        raw.columns[:, 0] if single else raw.columns,
        sampling,
        raw.names[0] if single else raw.names,
        units[0] if single else units,
        start,
        {"file": path.name, "kind": kind, **raw.metadata},
    )
    return (
        record
        if channel is None or (kind in ("mat", "npz") and channel not in raw.names)
        else record[channel]
    )


def _number(value: Any, name: str) -> float | None:
    try:
        return None if value is None else float(value)
    except (TypeError, ValueError) as error:
        raise RecordError(f"{name} is {value!r}: give samples per second") from error


def _raw(path: Path, channel: str | int | None) -> tuple[str, Raw]:
    kind = "file"
    try:
        with warnings.catch_warnings(record=True) as said:
            warnings.simplefilter("always")
            kind = kind_of(path)
            raw = read_text(path) if kind == "text" else READERS[kind](path, channel)
    except RecordError:
        raise
    except Exception as error:  # readers of damaged files raise whatever comes
        told = str(error).splitlines()[0][:200] if str(error) else type(error).__name__
        raise RecordError(
            f"{path.name} cannot be read as {kind}, it is damaged or of another kind: {told}"
        ) from error
    short = [str(w.message) for w in said if "prematurely" in str(w.message).lower()]
    if short:
        raise RecordError(f"{path.name} ends too early: {short[0]}")
    if len(raw.columns) < 2:
        raise RecordError(f"{path.name} has {len(raw.columns)} samples: a record needs two or more")
    return kind, raw


def _rate(raw: Raw, rate: float | None, path: Path) -> float:
    if raw.time is not None:
        if not np.all(np.isfinite(raw.time)):
            raise RecordError(f"{path.name}: the times are not all finite numbers")
        return even_rate(raw, rate)
    if rate is None and raw.rate is None:
        raise RecordError(
            f"{path.name} does not say how fast it was sampled: give rate=... in samples per second"
        )
    if rate is not None and raw.rate is not None and abs(rate / raw.rate - 1) > 1e-6:
        raise RecordError(f"rate is {rate:g}, but {path.name} says {raw.rate:g}: leave it out")
    return float(raw.rate if rate is None else rate)


def _check_finite(raw: Raw, path: Path) -> None:
    for i, column in enumerate(raw.columns.T):
        bad = np.flatnonzero(~np.isfinite(column))
        if len(bad):
            raise RecordError(
                f"{path.name}, {raw.place(int(bad[0]))}: {raw.names[i]} is empty or not finite there, and in "
                f"{len(bad)} places in all. Cut such gaps out, or bridge them with resample=..."
            )
