"""A virtual test rig: what instruments would have recorded of a simulated motion.  Course section 9.1."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from numbers import Real
from typing import Any

import numpy as np
import scipy.signal
from scipy.interpolate import make_interp_spline

from engdyn.errors import RecordError
from engdyn.record import Record

__all__ = ["SENSORS", "Sensor", "virtual_test"]

OVERSAMPLING = 8
"""The analog part is computed at this multiple of the converter's rate, or finer."""

MOST = 50_000_000
"""Values of the analog part."""


@dataclass(frozen=True)
class Sensor:
    """An instrument.

    Attributes
    ----------
    kind : str
    unit : str
        Of what it measures.
    sensitivity : float
        [V per unit]
    range : float
        What it can follow, ± [unit]; beyond it clips.
    bandwidth : float
        Frequency at which its amplitude is down to 1/√2 [Hz].
    step : float
        Smallest step of a counting sensor [unit]; 0 for an analog one.
    derivative : int
        What it takes of a coordinate that is named: 0 its value, 1 its rate, 2 its acceleration.
    """

    kind: str
    unit: str
    sensitivity: float
    range: float
    bandwidth: float
    step: float = 0.0
    derivative: int = 0


SENSORS = {
    s.kind: s
    for s in (
        Sensor("accelerometer", "m/s^2", 0.0102, 490.0, 5000.0, derivative=2),
        Sensor("displacement", "m", 100.0, 0.1, 2000.0),
        Sensor("velocity", "m/s", 10.0, 1.0, 20000.0, derivative=1),
        Sensor("encoder", "rad", 1.0, 1e4, 20000.0, step=2 * np.pi / 8192),
        Sensor("strain", "m/m", 2000.0, 5e-3, 1000.0),
        Sensor("force", "N", 0.001, 1e4, 5000.0),
    )
}


def virtual_test(
    history: Any,
    sensor: str | Sensor | Sequence[str | Sensor] = "accelerometer",
    output: Any = None,
    *,
    rate: float,
    antialias: bool | float = True,
    noise: float = 0.0,
    offset: float = 0.0,
    drift: float = 0.0,
    hum: float = 0.0,
    mains: float = 50.0,
    dropouts: int = 0,
    bits: int | None = 16,
    full_scale: float | None = None,
    seed: int = 0,
) -> Record:
    """Record a motion: sensor, cable, anti-alias filter, converter.

    Parameters
    ----------
    history : TimeHistory, or any object with ``.time`` and ``.q``, ``.u``
        The motion. Without names of its own, its coordinates are q1, q2 …
    sensor : str or Sensor, or one for each output
        "accelerometer", "displacement", "velocity", "encoder", "strain", "force", or a :class:`Sensor` of one's own.
    output : str, array, sympy expression, or sequence or mapping of name to these, optional
        What the sensors sit on: the name of a coordinate (an accelerometer takes its second derivative) or input,
        ``"x'"``, an expression, samples over ``history.time``. All coordinates where not given.
    rate : float
        Samples per second of the converter [1/s].
    antialias : bool or float
        Analog low-pass, Butterworth of order 8: with its corner at 0.4 times the rate, at a frequency of one's own
        [Hz], or left out (False), to see what happens.
    noise, offset, drift, hum : float
        Standard deviation, constant, rise per second and amplitude at the frequency of the mains [unit of the sensor].
        Hum and drift enter before the filter, noise after it.
    mains : float
        [Hz]
    dropouts : int
        Times that the signal is lost for a hundredth of the record.
    bits : int or None
        Of the converter; None for one without steps.
    full_scale : float, optional
        ± [V] of the converter; that of the sensor's range where not given.
    seed : int
        Of noise and dropouts: the same seed gives the same record.

    Returns
    -------
    Record
        In the units of the sensors; `metadata` holds the settings. It starts where the history starts.

    Raises
    ------
    RecordError
        Outputs that are not known, a history coarser than the converter, settings that make no sense.

    Notes
    -----
    Course section 9.1.  Filters are settled at the first sample. Their delay is the same for all channels with the same
    sensor. A counting sensor, such as an encoder, needs no converter: bits do not matter to it.
    """
    settings = {
        "noise": noise, "offset": offset, "drift": drift, "hum": hum, "mains": mains, "bits": bits,
        "full_scale": full_scale,
    }  # fmt: skip
    _check_settings(
        history, {"rate": rate, "dropouts": dropouts, "antialias": antialias, "seed": seed}, settings
    )
    measured = _outputs(history, output, sensor)
    corner = 0.4 * rate if antialias is True else float(antialias)
    factor = _oversampling(history, rate)
    time, read = _times(history, rate, factor)
    random = np.random.default_rng(seed)
    lost = _lost(random, dropouts, len(time[::factor]))
    columns = []
    for one, of in measured.values():
        analog = _analog(read(of), time, one, rate * factor, corner, settings)
        columns.append(_converted(analog[::factor], one, lost, random, settings))
    settings |= {"antialias": corner or None, "dropouts": dropouts, "seed": seed}
    return _record(measured, columns, rate, float(time[0]), settings)


def _record(
    measured: dict[str, tuple[Sensor, Any]],
    columns: list[np.ndarray],
    rate: float,
    start: float,
    settings: dict,
) -> Record:
    names, sensors = list(measured), [one for one, _ in measured.values()]
    units, told = (
        [one.unit for one in sensors],
        {"sensor": ", ".join(one.kind for one in sensors), **settings},
    )
    if len(columns) == 1:
        return Record(columns[0], rate, names[0], units[0], start, told)
    return Record(np.column_stack(columns), rate, names, units, start, told)


def _check_settings(history: Any, counts: Mapping[str, Any], settings: Mapping[str, Any]) -> None:
    bits, full = settings["bits"], settings["full_scale"]
    if np.ndim(getattr(history, "time", None)) != 1 or len(history.time) < 2:
        raise RecordError(
            "history needs two or more times: give a TimeHistory, or an object with .time, .q and .u"
        )
    for name, value in counts.items():
        if (
            not isinstance(value, Real)
            or not np.isfinite(value)
            or value < 0
            or (name == "rate" and not value)
        ):
            raise RecordError(
                f"{name} is {value!r}: rate must be positive; dropouts, antialias, seed finite and not negative"
            )
    if settings["noise"] < 0 or not all(
        np.isfinite(settings[n]) for n in ("noise", "offset", "drift", "hum")
    ):
        raise RecordError("noise must not be negative; noise, offset, drift and hum must be finite")
    if (bits is not None and bits not in range(1, 33)) or (full is not None and not full > 0):
        raise RecordError(
            "bits is a whole number from 1 to 32 or None, full_scale a positive number of volts"
        )


def _outputs(history: Any, output: Any, sensor: Any) -> dict[str, tuple[Sensor, Any]]:
    """Sensor and what it sits on, by the name of the channel."""
    if output is None:
        output = list(getattr(history, "names", ())) or [f"q{i + 1}" for i in range(history.q.shape[1])]
    if isinstance(output, Mapping):
        named = dict(output)
    elif isinstance(output, list | tuple):
        named = {_label(of): of for of in output}
    else:
        named = {_label(output): output}
    sensors = sensor if isinstance(sensor, list | tuple) else [sensor] * len(named)
    if len(sensors) != len(named) or not named:
        raise RecordError(f"there are {len(sensors)} sensors for {len(named)} outputs: give one each")
    unknown = [s for s in sensors if not isinstance(s, Sensor) and s not in SENSORS]
    if unknown:
        raise RecordError(f"there is no sensor {unknown[0]!r}: choose {', '.join(SENSORS)}, or make a Sensor")
    found = [s if isinstance(s, Sensor) else SENSORS[s] for s in sensors]
    primed = {
        name: of + "'" * one.derivative
        if isinstance(of, str) and "'" not in of and _moves(history, of)
        else of
        for (name, of), one in zip(named.items(), found, strict=True)
    }
    return {name: (one, of) for (name, of), one in zip(primed.items(), found, strict=True)}


def _label(of: Any) -> str:
    return of if isinstance(of, str) else "signal" if isinstance(of, np.ndarray) else str(of)


def _moves(history: Any, name: str) -> bool:
    return name in getattr(history, "names", ()) or not hasattr(history, "names")


def _oversampling(history: Any, rate: float) -> int:
    own = (len(history.time) - 1) / (history.time[-1] - history.time[0])
    if own < rate * (1 - 1e-9) and not hasattr(history, "at"):
        raise RecordError(
            f"the history has {own:.5g} times per second, the converter takes {rate:g}: compute it at more times"
        )
    return max(OVERSAMPLING, int(np.ceil(own / rate - 1e-9)))


def _times(history: Any, rate: float, factor: int) -> tuple[np.ndarray, Callable[[Any], np.ndarray]]:
    """Times of the analog part, and how to read an output there."""
    first, last = float(history.time[0]), float(history.time[-1])
    count = int((last - first) * rate * (1 + 1e-12)) + 1
    if count < 2 or count * factor > MOST:
        raise RecordError(f"{count} samples at {rate:g} per second: a record has two to {MOST // factor}")
    time = first + np.arange((count - 1) * factor + 1) / (rate * factor)
    time[-1] = min(time[-1], last)
    finer = history.at(time) if hasattr(history, "at") else None

    def read(of: Any) -> np.ndarray:
        if isinstance(of, np.ndarray) or finer is None:
            samples = of if isinstance(of, np.ndarray) else _plain(history, of)
            if samples.shape != history.time.shape or not np.all(np.isfinite(samples)):
                raise RecordError("an output must have one finite value for each time of the history")
            return make_interp_spline(history.time, samples)(time)
        return finer[of] if isinstance(of, str) else finer.output(of)

    return time, read


def _plain(history: Any, name: Any) -> np.ndarray:
    """A coordinate q1, q2 …, its rate or its acceleration, of an object that only has .q and .u."""
    known = [f"q{i + 1}" for i in range(history.q.shape[1])]
    plain = name.rstrip("'") if isinstance(name, str) else name
    if plain not in known:
        raise RecordError(f"there is no output {name!r}: the history has {', '.join(known)}; or give samples")
    i, order = known.index(plain), len(name) - len(plain)
    if order < 2:
        return (history.u if order else history.q)[:, i]
    return make_interp_spline(history.time, history.u[:, i], k=5).derivative(order - 1)(history.time)


def _analog(
    x: np.ndarray, time: np.ndarray, sensor: Sensor, fine: float, corner: float, settings: Mapping[str, Any]
) -> np.ndarray:
    """What arrives at the converter [unit of the sensor]."""
    x = np.clip(_low_pass(x, sensor.bandwidth, 2, fine), -sensor.range, sensor.range)
    since = time - time[0]
    x = x + settings["offset"] + settings["drift"] * since
    x = x + settings["hum"] * np.sin(2 * np.pi * settings["mains"] * since)
    return x if sensor.step or not corner else _low_pass(x, corner, 8, fine)


def _low_pass(x: np.ndarray, corner: float, order: int, fine: float) -> np.ndarray:
    if corner >= 0.45 * fine:  # nothing to see of it here
        return x
    sections = scipy.signal.butter(order, corner, fs=fine, output="sos")
    return scipy.signal.sosfilt(sections, x, zi=scipy.signal.sosfilt_zi(sections) * x[0])[0]


def _lost(random: np.random.Generator, dropouts: int, count: int) -> np.ndarray:
    lost = np.zeros(count, dtype=bool)
    width = max(count // 100, 2)
    for start in random.integers(0, max(count - width, 1), dropouts):
        lost[start : start + width] = True
    return lost


def _converted(
    x: np.ndarray, sensor: Sensor, lost: np.ndarray, random: np.random.Generator, settings: Mapping[str, Any]
) -> np.ndarray:
    x = np.where(lost, 0.0, x + settings["noise"] * random.standard_normal(len(x)))
    if sensor.step:
        return np.round(x / sensor.step) * sensor.step
    if settings["bits"] is None:
        return x
    full = settings["full_scale"] or sensor.range * sensor.sensitivity
    step = 2 * full / 2 ** settings["bits"]
    code = np.clip(
        np.round(x * sensor.sensitivity / step),
        -(2 ** (settings["bits"] - 1)),
        2 ** (settings["bits"] - 1) - 1,
    )
    return code * step / sensor.sensitivity
