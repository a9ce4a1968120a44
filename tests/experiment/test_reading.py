"""Records written by others come in right; damaged files are refused in words."""

from __future__ import annotations

import sys
import time
import tracemalloc
import zipfile
from contextlib import suppress
from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest
import scipy.io

import engdyn as ed
from engdyn.errors import RecordError

RATE, COUNT = 1024.0, 1000
TIME = np.arange(COUNT) / RATE
ACC = np.sin(2 * np.pi * 5 * TIME) - 0.25
FORCE = 30 * np.cos(2 * np.pi * 3 * TIME)
ROWS = "".join(f"{t!r},{a!r}\n" for t, a in zip(TIME.tolist(), ACC.tolist(), strict=True))


def _written(folder, text, name="file.csv", encoding="utf-8"):
    path = folder / name
    path.write_bytes(text.encode(encoding))
    return path


# ----- text ----------------------------------------------------------------------------------------------------


def test_a_table_written_by_pandas(tmp_path):
    pd.DataFrame({"time": TIME, "acc [m/s²]": ACC, "force (N)": FORCE}).to_csv(
        tmp_path / "a.csv", index=False
    )
    record = ed.read_record(tmp_path / "a.csv")
    assert record.channels == ("acc", "force")
    assert record.units == ("m/s^2", "N")
    assert (record.rate, record.start) == (RATE, 0.0)
    np.testing.assert_array_equal(record.samples, np.c_[ACC, FORCE])
    assert record.metadata["file"] == "a.csv"
    np.testing.assert_array_equal(ed.read_record(tmp_path / "a.csv", channel="force").samples, FORCE)


@pytest.mark.parametrize("encoding", ["utf-8", "cp1252", "utf-8-sig", "utf-16"])
def test_a_spreadsheet_export_with_semicolons_and_decimal_commas(tmp_path, encoding):
    rows = "".join(f"{1e3 * t:.3f};{a:.6f}\r\n" for t, a in zip(TIME, ACC, strict=True)).replace(".", ",")
    path = _written(tmp_path, "Zeit;Beschleunigung für x\r\nms;m/s²\r\n" + rows, encoding=encoding)
    record = ed.read_record(path)
    assert (record.name, record.unit, record.rate) == ("Beschleunigung für x", "m/s^2", RATE)
    np.testing.assert_allclose(record.samples, ACC, atol=5e-7)


@pytest.mark.parametrize(
    ("header", "separator", "comma", "line_end"),
    [
        ("# rig 7\n# t [s], acc [m/s^2]\n", ",", False, "\n"),
        ("t / s\tacc / m/s2\n", "\t", True, "\n"),
        ("", "  ", False, "\n"),
        ("", ";", True, "\r\n"),
        ("time|acc\n", "|", False, "\n"),
        ('"time","acc"\n', ",", False, "\n"),
        ("time;acc;\n", ";", False, ";\n"),
        ("t;acc\r", ";", False, "\r"),
    ],
)
def test_dialects(tmp_path, header, separator, comma, line_end):
    rows = "".join(f"{t:.9e}{separator}{a:.9e}{line_end}" for t, a in zip(2.5 + TIME, ACC, strict=True))
    record = ed.read_record(_written(tmp_path, header + (rows.replace(".", ",") if comma else rows)))
    np.testing.assert_allclose(record.samples, ACC, atol=1e-9)
    assert record.rate == RATE
    assert record.start == 2.5


def test_quoted_decimal_commas_between_commas(tmp_path):
    rows = "".join(f'"{t:.6f}","{a:.6f}"\n' for t, a in zip(TIME, ACC, strict=True))
    text = "time,acc\n" + rows.replace('","', "§").replace(".", ",").replace("§", '","')
    np.testing.assert_allclose(ed.read_record(_written(tmp_path, text)).samples, ACC, atol=1e-6)


def test_one_column_needs_a_rate_and_takes_a_unit(tmp_path):
    path = _written(tmp_path, "".join(f"{a:.9f}\n" for a in ACC))
    with pytest.raises(RecordError, match="rate="):
        ed.read_record(path)
    record = ed.read_record(path, rate=RATE, unit="m/s^2")
    assert (record.rate, record.unit) == (RATE, "m/s^2")


def test_a_rate_that_the_times_deny_is_refused(tmp_path):
    path = _written(tmp_path, "t,acc\n" + ROWS)
    assert ed.read_record(path, rate=RATE).rate == RATE
    with pytest.raises(RecordError, match="1024 per second"):
        ed.read_record(path, rate=1000)


def test_rounded_times_give_the_rate_that_was_meant(tmp_path):
    rows = "".join(f"{t:.4f},{a}\n" for t, a in zip(TIME, ACC, strict=True))
    assert ed.read_record(_written(tmp_path, "t,acc\n" + rows)).rate == RATE
    coarse = "".join(f"{t:.2f},{a}\n" for t, a in zip(TIME, ACC, strict=True))
    path = _written(tmp_path, "t,acc\n" + coarse)
    with pytest.raises(RecordError, match="line 3 the time repeats"):
        ed.read_record(path)
    assert ed.read_record(path, rate=RATE).rate == RATE


def test_uneven_times_are_refused_or_resampled(tmp_path):
    lines = ROWS.splitlines(keepends=True)
    path = _written(tmp_path, "t,acc\n" + "".join(lines[:500] + lines[503:]))
    with pytest.raises(RecordError, match=r"line 502 .*resample=1024"):
        ed.read_record(path)
    record = ed.read_record(path, resample=RATE)
    assert len(record) == COUNT
    np.testing.assert_allclose(record.samples[:500], ACC[:500], atol=1e-12)
    np.testing.assert_allclose(record.samples[500:503], ACC[500:503], atol=2e-3)  # straight lines bridge
    with pytest.raises(RecordError, match="decimate"):
        ed.read_record(path, resample=100)
    rng = np.random.default_rng(3)
    jittered = TIME + rng.uniform(-2e-4, 2e-4, COUNT)
    rows = (
        "".join(f"{t!r},{np.sin(t)!r}\n" for t in jittered.tolist())
        .replace("np.float64(", "")
        .replace(")", "")
    )
    path = _written(tmp_path, "t,acc\n" + rows)
    with pytest.raises(RecordError, match="not even"):
        ed.read_record(path)
    even = ed.read_record(path, resample=RATE)
    np.testing.assert_allclose(even.samples, np.sin(even.time), atol=1e-6)


@pytest.mark.parametrize(
    ("spoiled", "message"),
    [
        ("0.48828125,abc\n", "line 502, column 2: 'abc' is not a number"),
        ("0.48828125\n", "line 502: acc is empty or not finite"),
        ("0.48828125,NaN\n", "line 502: acc is empty or not finite"),
        ("0.48828125,-inf\n", "line 502: acc is empty or not finite"),
        ("0.48828125,1,2\n", "line 502 has 3 columns, the others have 2"),
        ("\n\n\n0.48828125,1;5\n", "line 505, column 2: '1;5' is not a number"),
        (",1.0\n", "line 502, column 1: there is no time"),
    ],
)
def test_a_fault_is_named_by_line_and_column(tmp_path, spoiled, message):
    lines = ROWS.splitlines(keepends=True)
    path = _written(tmp_path, "t,acc\n" + "".join([*lines[:500], spoiled, *lines[501:]]))
    with pytest.raises(RecordError, match=message):
        ed.read_record(path)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "empty"),
        (" \n\n", "empty"),
        ("hello\nworld\n", "no rows of numbers.*'hello'"),
        ("t,acc\n0.0,1.0\n", "two or more"),
        ("t,acc\n0.0,abc\n" + ROWS, "line 2, column 2: 'abc'"),
        ("x" * 300_000, "longer than"),
        ("t\n0.0\n0.1\n0.2\n", "times only"),
        ("t [furlong],acc\n" + ROWS, "unit of time"),
        ("\0\0\0", "zero bytes"),
    ],
)
def test_what_is_no_record(tmp_path, text, message):
    with pytest.raises(ed.EngdynError, match=message):
        ed.read_record(_written(tmp_path, text))
    with pytest.raises(RecordError, match="no file"):
        ed.read_record(tmp_path / "absent.csv")
    with pytest.raises(RecordError, match="is no file"):
        ed.read_record(tmp_path)


def test_a_long_file_comes_in_pieces_with_bounded_memory(tmp_path, monkeypatch):
    monkeypatch.setattr("engdyn.experiment.text_files.BLOCK", 2**18)
    count = 200_000
    x = np.random.default_rng(1).normal(size=count).round(6)
    t = np.arange(count) / 1000
    pd.DataFrame({"time": t, "x": x}).to_csv(tmp_path / "long.csv", index=False)
    ed.read_record(_written(tmp_path, "t,acc\n" + ROWS))  # imports
    tracemalloc.start()
    record = ed.read_record(tmp_path / "long.csv")
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    np.testing.assert_array_equal(record.samples, x)
    assert peak < 2 * (t.nbytes + x.nbytes) + 4_000_000
    text = (tmp_path / "long.csv").read_text().splitlines(keepends=True)
    text[150_000] = "149.999,oops\n"
    with pytest.raises(RecordError, match="line 150001, column 2: 'oops'"):
        ed.read_record(_written(tmp_path, "".join(text)))


# ----- binary files --------------------------------------------------------------------------------------------


def test_wav(tmp_path):
    scipy.io.wavfile.write(tmp_path / "a.wav", 1024, np.c_[ACC, FORCE / 30].astype(np.float32))
    record = ed.read_record(tmp_path / "a.wav")
    assert (record.channels, record.rate) == (("channel 1", "channel 2"), RATE)
    np.testing.assert_allclose(record.samples, np.c_[ACC, FORCE / 30], atol=1e-7)
    scipy.io.wavfile.write(tmp_path / "b.wav", 1024, np.round(ACC / 2 * 32768).astype(np.int16))
    np.testing.assert_allclose(ed.read_record(tmp_path / "b.wav").samples, ACC / 2, atol=1 / 65000)


def test_mat(tmp_path):
    scipy.io.savemat(tmp_path / "a.mat", {"acc": ACC, "fs": RATE})
    record = ed.read_record(tmp_path / "a.mat", unit="m/s^2")
    assert (record.name, record.unit, record.rate) == ("acc", "m/s^2", RATE)
    scipy.io.savemat(tmp_path / "b.mat", {"acc": np.c_[ACC, FORCE].T, "other": ACC, "t": TIME})
    with pytest.raises(RecordError, match="acc, other: name one"):
        ed.read_record(tmp_path / "b.mat")
    np.testing.assert_array_equal(
        ed.read_record(tmp_path / "b.mat", channel="acc").samples, np.c_[ACC, FORCE]
    )
    (tmp_path / "c.mat").write_bytes(b"\x89HDF\r\n\x1a\n" + bytes(100))
    header = b"MATLAB 7.3 MAT-file".ljust(124) + b"\x00\x02IM"
    (tmp_path / "d.mat").write_bytes(header + bytes(600))
    for name in ("c.mat", "d.mat"):
        with pytest.raises(RecordError, match="-v7"):
            ed.read_record(tmp_path / name)


def test_npy_and_npz(tmp_path):
    np.save(tmp_path / "acc.npy", ACC)
    assert ed.read_record(tmp_path / "acc.npy", rate=RATE).name == "acc"
    np.savez(tmp_path / "a.npz", acc=ACC, dt=1 / RATE)
    record = ed.read_record(tmp_path / "a.npz")
    np.testing.assert_array_equal(record.samples, ACC)
    assert record.rate == pytest.approx(RATE, rel=1e-12)
    np.savez(tmp_path / "b.npz", acc=ACC.astype(np.float32), time=TIME.astype(np.float32))
    assert ed.read_record(tmp_path / "b.npz").rate == RATE
    np.save(tmp_path / "p.npy", np.array([{"a": 1}, None], dtype=object), allow_pickle=True)
    with pytest.raises(RecordError, match="damaged or of another kind"):
        ed.read_record(tmp_path / "p.npy", rate=1)
    with zipfile.ZipFile(tmp_path / "book.xlsx", "w") as file:
        file.writestr("sheet.xml", "<a/>")
    with pytest.raises(RecordError, match="export the table as CSV"):
        ed.read_record(tmp_path / "book.xlsx")


def _write_uff(path, channels):
    import pyuff

    file = pyuff.UFF(str(path))
    for node, data, unit in channels:
        content = pyuff.prepare_58(
            func_type=1, rsp_node=node, rsp_dir=3, data=data, x=TIME, binary=0, num_pts=COUNT, abscissa_spacing=1,
            abscissa_inc=1 / RATE, abscissa_min=0.0, ordinate_axis_units_lab=unit, id1="NONE", return_full_dict=True,
        )  # fmt: skip
        file.write_sets({key: 0 if value is None else value for key, value in content.items()}, "add")


def test_uff_58(tmp_path):
    pytest.importorskip("pyuff", reason="UFF files need pyuff")
    _write_uff(tmp_path / "a.uff", [(1, ACC, "m/s^2"), (2, FORCE, "N")])
    record = ed.read_record(tmp_path / "a.uff")
    assert (record.channels, record.units) == (("1z", "2z"), ("m/s^2", "N"))
    assert record.rate == pytest.approx(RATE, rel=1e-6)
    np.testing.assert_allclose(record.samples, np.c_[ACC, FORCE], rtol=1e-5, atol=1e-5)


def test_tdms(tmp_path):
    nptdms = pytest.importorskip("nptdms", reason="TDMS files need npTDMS")
    properties = {"wf_increment": 1 / RATE, "wf_start_offset": 0.5, "unit_string": "m/s^2"}
    with nptdms.TdmsWriter(tmp_path / "a.tdms") as file:
        file.write_segment([nptdms.ChannelObject("rig", "acc", ACC, properties=properties)])
    record = ed.read_record(tmp_path / "a.tdms")
    assert (record.name, record.unit, record.rate, record.start) == ("acc", "m/s^2", RATE, 0.5)
    np.testing.assert_array_equal(record.samples, ACC)
    (tmp_path / "cut.tdms").write_bytes((tmp_path / "a.tdms").read_bytes()[:-64])
    with pytest.raises(RecordError, match="ends too early"):
        ed.read_record(tmp_path / "cut.tdms")


def test_miniseed(tmp_path):
    obspy = pytest.importorskip("obspy", reason="MiniSEED files need obspy")
    trace = obspy.Trace(ACC, {"sampling_rate": RATE, "station": "RIG"})
    trace.write(str(tmp_path / "a.mseed"), format="MSEED")
    record = ed.read_record(tmp_path / "a.mseed")
    np.testing.assert_array_equal(record.samples, ACC)
    assert record.rate == RATE


@pytest.mark.parametrize(("ending", "module"), [("uff", "pyuff"), ("tdms", "nptdms"), ("sac", "obspy")])
def test_a_missing_reader_is_named(tmp_path, monkeypatch, ending, module):
    monkeypatch.setitem(sys.modules, module, None)
    with pytest.raises(RecordError, match=rf"needs {module}: pip install"):
        ed.read_record(_written(tmp_path, "0 1\n0 1\n", f"a.{ending}"))


# ----- damage --------------------------------------------------------------------------------------------------


def _sound_files(folder):
    pd.DataFrame({"time": TIME, "acc": ACC}).to_csv(folder / "a.csv", index=False)
    scipy.io.wavfile.write(folder / "a.wav", 1024, ACC.astype(np.float32))
    scipy.io.savemat(folder / "a.mat", {"acc": ACC, "fs": RATE}, do_compression=True)
    np.save(folder / "a.npy", ACC)
    np.savez_compressed(folder / "a.npz", acc=ACC, fs=RATE)
    with suppress(ImportError):
        _write_uff(folder / "a.uff", [(1, ACC, "m/s^2")])
    with suppress(ImportError):
        import nptdms

        with nptdms.TdmsWriter(folder / "a.tdms") as writer:
            writer.write_segment(
                [nptdms.ChannelObject("g", "acc", ACC, properties={"wf_increment": 1 / RATE})]
            )
    return {path.suffix: path.read_bytes() for path in sorted(folder.glob("a.*"))}


def _spoiled(sound, random):
    """Damage of one of many kinds."""
    data = bytearray(sound)
    kind = random.integers(6)
    at = int(random.integers(1, len(data)))
    if kind == 0:
        return data[:at]
    if kind == 1:
        for place in random.integers(0, len(data), 20):
            data[place] ^= 1 << int(random.integers(8))
        return data
    if kind == 2:  # within the header
        for place in random.integers(0, min(200, len(data)), 5):
            data[place] = int(random.integers(256))
        return data
    if kind == 3:
        return data[:at] + data[min(at + 64, len(data)) :]
    if kind == 4:
        return data[:at] + bytes(random.integers(0, 256, 300, dtype=np.uint8)) + data[at:]
    return data[:16] + b"9" * 100_000 + data[16:]


def test_two_hundred_damaged_files(tmp_path):
    (tmp_path / "sound").mkdir()
    sound = _sound_files(tmp_path / "sound")
    random = np.random.default_rng(20)
    endings = list(sound)
    refused, begun = 0, time.monotonic()
    tracemalloc.start()
    for i in range(200):
        ending = endings[i % len(endings)]
        content = _spoiled(sound[ending], random)
        path = (
            tmp_path / f"f{i}{endings[(i // 7) % len(endings)] if i % 11 == 0 else ending}"
        )  # some of wrong type
        path.write_bytes(content)
        try:
            record = ed.read_record(path)
        except RecordError as error:
            refused += 1
            assert len(str(error)) < 600  # noqa: PT017
        else:  # a digit or a sample may be another one: nobody can know
            assert np.all(np.isfinite(record.samples))
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert refused > 100
    assert peak < 60_000_000
    assert time.monotonic() - begun < 60


# ----- looking -------------------------------------------------------------------------------------------------


def test_summary_finds_what_was_put_in():
    t = np.arange(20_000) / 1000
    noise = 0.1 * np.random.default_rng(4).normal(size=len(t))
    clipped = np.clip(3 * np.sin(2 * np.pi * 7 * t), -2.5, 2.5)
    lost = noise + 9.81 + 0.3 * np.sin(2 * np.pi * 50 * t)
    lost[3000:3100] = 0.0
    drifting = noise + 0.05 * t
    sound = np.round(5 * np.sin(2 * np.pi * 0.3 * t), 1)  # coarse steps are no clipping
    record = ed.Record(
        np.c_[clipped, lost, drifting, sound], 1000, ["a", "b", "c", "d"], ["g", "m/s^2", "furl", "N"]
    )
    a, b, c, d = record.summary().channels
    assert a.clipped == np.sum(np.abs(clipped) == 2.5)
    assert any("gram" in remark for remark in a.remarks)
    assert (b.dropouts, b.clipped) == (1, 0)
    assert b.hum == pytest.approx(0.3, rel=0.02)
    assert any("gravity" in remark for remark in b.remarks)
    assert c.drift == pytest.approx(1.0, rel=0.02)
    assert any("'furl' is not known" in remark for remark in c.remarks)
    assert d.remarks == ()
    assert "a: " in record.summary().remarks[0]
    assert "<table>" in record.summary()._repr_html_()
    assert "hum" in repr(record.summary())


def test_summary_of_what_never_changes_or_has_no_unit():
    flat = ed.Record(np.ones(100), 10).summary().channels[0]
    assert flat.remarks == ("the value never changes", "no unit: say what is measured")
    large = ed.Record(np.r_[0.0, 50.0, 3.0], 10, "x", "m").summary().channels[0]
    assert any("millimeters" in remark for remark in large.remarks)
    assert any("0.001 in SI" in r for r in ed.Record(np.r_[0, 5.0, 3], 1, "x", "mm").summary().remarks)


def test_metadata_stay_with_a_channel():
    record = ed.Record(np.ones((3, 2)), 1, ["a", "b"], metadata={"day": 1})
    assert record["a"].metadata == {"day": 1}
    assert SimpleNamespace(**record.metadata).day == 1


@pytest.mark.parametrize(
    ("text", "rate", "unit"),
    [
        ("t [ms],a [m]\n\n0,1\n10,2\n20,3\n", 100, "m"),  # a blank line below the names
        ("sep=;\nt;a [m]\n0;1\n0,1;2\n0,2;3\n", 10, "m"),  # as spreadsheets begin
        ("Test,run 3\nt,F\n0,1\n0.1,2\n0.2,3\n", 10, "-"),  # names that are units as well: ton, farad
        ("time_ms,a\n0,1\n10,2\n20,3\n", 100, "-"),
        ("t [min],a\n0,1\n1,2\n2,3\n", 1 / 60, "-"),  # exactly even times are no rounded ones
    ],
)
def test_heads_of_text_files_keep_their_units(tmp_path, text, rate, unit):
    path = tmp_path / "head.csv"
    path.write_text(text, encoding="utf-8")
    record = ed.read_record(path)
    assert record.rate == pytest.approx(rate, rel=1e-9)
    assert record.unit == unit
    assert record.samples.tolist() == [1, 2, 3]


@pytest.mark.parametrize("given", [{"rate": "fast"}, {"resample": "fast"}, {"unit": 5}])
def test_arguments_of_wrong_kinds_are_named(tmp_path, given):
    path = tmp_path / "plain.csv"
    path.write_text("t,a\n0,1\n0.1,2\n0.2,3\n", encoding="utf-8")
    with pytest.raises(RecordError, match=next(iter(given))):
        ed.read_record(path, **given)
