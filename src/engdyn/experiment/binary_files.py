"""Files of instruments and programs: WAV, MAT, NPY and NPZ, UFF 58, TDMS, MiniSEED and SAC.  Course section 9.1."""

from __future__ import annotations

import logging
from collections.abc import Callable, Mapping, Sequence
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np

from engdyn.errors import RecordError
from engdyn.experiment.raw import Raw, distinct

__all__ = ["READERS", "kind_of"]

SIGNATURES = {
    b"RIFF": "wav", b"RIFX": "wav", b"RF64": "wav", b"\x93NUMPY": "npy", b"TDSm": "tdms", b"MATLAB": "mat",
    b"\x89HDF": "hdf", b"PK\x03\x04": "npz", b"    -1": "uff",
}  # fmt: skip
ENDINGS = {".unv": "uff", ".uf": "uff", ".mseed": "seismic", ".miniseed": "seismic", ".sac": "seismic"}
RATES, STEPS, TIMES = {"fs", "rate", "sampling_rate", "sample_rate"}, {"dt", "delta"}, {"t", "time"}
DIRECTIONS = {0: "", 1: "x", 2: "y", 3: "z", 4: "rx", 5: "ry", 6: "rz"}


def kind_of(path: Path) -> str:
    """The kind of a file, by its first bytes, then by its ending; "text" for all others."""
    with path.open("rb") as file:
        head = file.read(16)
    ending = path.suffix.lower()
    if head.startswith(b"PK") and ending != ".npz":
        raise RecordError(
            f"{path.name} is a zip file or workbook: export the table as CSV, or name an NPZ file .npz"
        )
    known = next((kind for start, kind in SIGNATURES.items() if head.startswith(start)), None)
    wanted = ENDINGS.get(ending, ending[1:])
    return known or (wanted if wanted in READERS else "text")


def _wav(path: Path, channel: Any) -> Raw:
    from scipy.io import wavfile

    rate, samples = wavfile.read(path)
    full = {"u": 128.0, "i": float(2 ** (8 * samples.dtype.itemsize - 1)), "f": 1.0}[samples.dtype.kind]
    columns = samples.reshape(len(samples), -1) / full - (samples.dtype.kind == "u")
    names = _numbered("channel", columns.shape[1])
    return Raw(columns, names, ["-"] * len(names), rate=rate, metadata={"full_scale": 1.0, "steps": full})


def _mat(path: Path, channel: Any) -> Raw:
    from scipy.io import loadmat

    try:
        found = loadmat(path)
    except NotImplementedError as error:
        raise _of_version_73(path) from error
    return _of_arrays(path, {name: x for name, x in found.items() if not name.startswith("__")}, channel)


def _hdf(path: Path, channel: Any) -> Raw:
    raise _of_version_73(path)


def _of_version_73(path: Path) -> RecordError:
    return RecordError(
        f"{path.name} is an HDF5 file, such as MATLAB's version 7.3: save it in MATLAB with save(..., '-v7'), or as CSV"
    )


def _npy(path: Path, channel: Any) -> Raw:
    return _of_arrays(path, {path.stem: np.load(path, allow_pickle=False)}, channel)


def _npz(path: Path, channel: Any) -> Raw:
    # A damaged archive leaves open what numpy itself opened.
    with path.open("rb") as file, np.load(file, allow_pickle=False) as found:
        return _of_arrays(path, {name: found[name] for name in found.files}, channel)


def _of_arrays(path: Path, found: Mapping[str, Any], channel: Any) -> Raw:
    """The array asked for, with the rate or the times that stand beside it."""
    arrays = {
        name: np.squeeze(x)
        for name, x in found.items()
        if isinstance(x, np.ndarray) and x.dtype.kind in "biuf" and x.dtype.names is None
    }
    rate = next((float(x) for n, x in arrays.items() if n.lower() in RATES and x.ndim == 0), None)
    step = next((float(x) for n, x in arrays.items() if n.lower() in STEPS and x.ndim == 0), None)
    if rate is None and step:
        rate = 1 / step
    time = next((x.astype(float) for n, x in arrays.items() if n.lower() in TIMES and x.ndim == 1), None)
    signals = {
        n: x for n, x in arrays.items() if x.ndim in (1, 2) and (n.lower() not in TIMES or x.ndim == 2)
    }
    name = channel if channel in signals else next(iter(signals), "")
    if not signals or (len(signals) > 1 and channel not in signals):
        raise RecordError(
            f"{path.name} holds {', '.join(signals) or 'no arrays of numbers'}: name one as channel"
            if signals
            else f"{path.name} holds no arrays of real numbers with one or two axes"
        )
    samples = signals[name].astype(float)
    if samples.ndim == 2 and samples.shape[0] < samples.shape[1]:
        samples = samples.T  # a record is longer than it has channels
    columns = samples.reshape(len(samples), -1)
    names = [name] if columns.shape[1] == 1 else _numbered(name, columns.shape[1])
    if time is not None and len(time) != len(columns):
        time = None
    return Raw(columns, names, ["-"] * len(names), time, rate, quantum=_single(time))


def _single(time: np.ndarray | None) -> float:
    """Step of times in single precision: many programs keep no more."""
    return float(np.spacing(np.float32(np.max(np.abs(time))))) if time is not None and len(time) else 0.0


def _numbered(name: str, count: int) -> list[str]:
    return [f"{name} {i + 1}" for i in range(count)]


def _uff(path: Path, channel: Any) -> Raw:
    uff = _module("pyuff", "data").UFF(str(path))
    found = [uff.read_sets(int(i)) for i in np.flatnonzero(np.array(uff.get_set_types()) == 58)]
    times = [s for s in found if s["func_type"] in (0, 1)]
    if not times:
        kinds = sorted({int(s["func_type"]) for s in found})
        raise RecordError(
            f"{path.name} holds no time record of type 58"
            + (f", only functions of types {kinds} (4 is a frequency response)" if kinds else "")
        )
    names = [str(s["id1"]).strip() for s in times]
    if len(set(names)) < len(names) or not all(names) or "NONE" in names:
        names = [f"{s['rsp_node']}{DIRECTIONS.get(abs(s['rsp_dir']), '?')}" for s in times]
    units = [str(s.get("ordinate_axis_units_lab", "")).strip() for s in times]
    _same_length(path, names, [s["data"] for s in times])
    columns = np.column_stack([np.real(s["data"]) for s in times])
    units = [unit if unit not in ("", "NONE") else "-" for unit in units]
    return Raw(
        columns, distinct(names), units, np.array(times[0]["x"], dtype=float), quantum=_single(times[0]["x"])
    )


def _tdms(path: Path, channel: Any) -> Raw:
    reader = _module("nptdms", "data")
    reader.log.log_manager.set_level(logging.CRITICAL)  # what it would say on the console is an error here
    file = reader.TdmsFile.read(str(path))
    if file.file_status.incomplete_final_segment:
        raise RecordError(f"{path.name} ends too early: its last segment is not complete")
    found = [c for group in file.groups() for c in group.channels() if len(c) and c.dtype.kind in "biuf"]
    if not found:
        raise RecordError(f"{path.name} holds no channels of real numbers")
    several = len({c.group_name for c in found}) > 1
    names = [f"{c.group_name}/{c.name}" if several else c.name for c in found]
    _same_length(path, names, found)
    columns = np.column_stack([np.asarray(c[:], dtype=float) for c in found])
    units = [str(c.properties.get("unit_string", "-")) or "-" for c in found]
    step = found[0].properties.get("wf_increment")
    start = float(found[0].properties.get("wf_start_offset", 0.0))
    time = next((i for i, name in enumerate(names) if name.rpartition("/")[2].lower() in TIMES), None)
    if time is None or len(names) == 1:
        return Raw(columns, names, units, rate=1 / step if step else None, start=start)
    rest = [i for i in range(len(names)) if i != time]
    return Raw(columns[:, rest], [names[i] for i in rest], [units[i] for i in rest], columns[:, time])


def _seismic(path: Path, channel: Any) -> Raw:
    stream = _module("obspy", "seismic").read(str(path))
    gaps = stream.get_gaps()
    if gaps:
        raise RecordError(
            f"{path.name} has {len(gaps)} gaps or overlaps, the first at {gaps[0][4]}: cut it there"
        )
    stream.merge()
    _same_length(path, [trace.id for trace in stream], [trace.data for trace in stream])
    columns = np.column_stack([np.asarray(trace.data, dtype=float) for trace in stream])
    stats = stream[0].stats
    names = distinct([trace.id for trace in stream])
    return Raw(
        columns,
        names,
        ["-"] * len(names),
        rate=float(stats.sampling_rate),
        metadata={"start": str(stats.starttime)},
    )


def _module(name: str, extra: str) -> Any:
    try:
        return import_module(name)
    except ImportError as error:
        raise RecordError(f"this kind of file needs {name}: pip install 'engdyn[{extra}]'") from error


def _same_length(path: Path, names: Sequence[str], columns: Sequence[Any]) -> None:
    lengths = {name: len(column) for name, column in zip(names, columns, strict=True)}
    if len(set(lengths.values())) > 1:
        raise RecordError(
            f"the channels of {path.name} differ in length: {lengths}; export those of one length"
        )


READERS: dict[str, Callable[[Path, Any], Raw]] = {
    "wav": _wav, "mat": _mat, "npy": _npy, "npz": _npz, "uff": _uff, "tdms": _tdms, "seismic": _seismic, "hdf": _hdf,
}  # fmt: skip
