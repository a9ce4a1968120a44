"""``engdyn spectrum``: files that none of our code wrote, through chapter 9 to a page and a table."""

from __future__ import annotations

import html
import re

import numpy as np
import pandas as pd
import pytest
from scipy.io import wavfile
from scipy.signal import TransferFunction, lsim

import engdyn as ed
from engdyn.cli import main
from engdyn.course.spectrum_report import default_segment, write_spectrum_report
from engdyn.experiment.peaks import peaks

RATE, SAMPLES = 200.0, 60_000
FREQUENCY, DAMPING = 12.0, 0.04


@pytest.fixture(scope="module")
def shaken():
    """Displacement of an oscillator under white noise, and noise itself."""
    omega = 2 * np.pi * FREQUENCY
    noise = np.random.default_rng(4).normal(size=SAMPLES)
    time = np.arange(SAMPLES) / RATE
    _, x, _ = lsim(TransferFunction([omega**2], [1.0, 2 * DAMPING * omega, omega**2]), noise, time)
    return time, x, noise


@pytest.fixture
def spreadsheet(shaken, tmp_path):
    """As a European spreadsheet writes it."""
    time, x, noise = shaken
    file = tmp_path / "Messung.csv"
    frame = pd.DataFrame({"Zeit [s]": time, "Weg [mm]": x + 0.3, "Kraft [N]": noise})
    frame.to_csv(file, sep=";", decimal=",", index=False)
    return file


def test_a_spreadsheet_becomes_a_page_and_a_table(spreadsheet, shaken, tmp_path, capsys):
    out = tmp_path / "report.html"
    assert main(["spectrum", str(spreadsheet), "--out", str(out)]) == 0
    assert f"wrote {out}" in capsys.readouterr().out
    page = html.unescape(out.read_text(encoding="utf-8"))
    for heading in ("The record", "Averaging", "Power spectral density of Weg", "Peaks of Kraft"):
        assert f"</span>{heading}</h2>" in page
    assert page.count("<img ") == 6
    assert "http" not in re.sub(r"http://www\.w3\.org\S*", "", page)  # nothing is fetched
    numbers = pd.read_csv(out.with_suffix(".csv"))
    f, density, total = (numbers.iloc[:, i].to_numpy() for i in range(3))
    assert list(numbers.columns[:3]) == [
        "frequency [Hz]",
        "Weg density [mm^2/Hz]",
        "Weg cumulative mean square [mm^2]",
    ]
    assert total[-1] == pytest.approx(np.var(shaken[1]), rel=0.05)
    assert np.trapezoid(density, f) == pytest.approx(total[-1], rel=1e-6)
    assert f[np.argmax(density)] == pytest.approx(FREQUENCY, rel=0.02)


def test_the_one_resonance_is_found_with_its_damping_and_noise_has_no_peaks(shaken):
    _, x, noise = shaken
    segment = default_segment(SAMPLES)
    (peak,) = peaks(ed.averaged_spectrum(ed.Record(x, RATE), segment=segment))
    assert peak.frequency == pytest.approx(FREQUENCY, rel=0.01)
    assert peak.damping_ratio == pytest.approx(DAMPING, abs=2.5 * peak.uncertainty)
    assert peak.uncertainty < 0.1 * DAMPING
    assert peaks(ed.averaged_spectrum(ed.Record(noise, RATE), segment=segment)) == []


def test_a_band_narrower_than_the_lines_gives_no_damping(shaken):
    _, x, _ = shaken
    (peak,) = peaks(ed.averaged_spectrum(ed.Record(x, RATE), segment=256))
    assert peak.damping_ratio is None


def test_a_sound_file_and_a_channel_by_number(tmp_path, spreadsheet):
    file = tmp_path / "tone.wav"
    wave = 0.3 * np.sin(2 * np.pi * 440 * np.arange(16_000) / 8000)
    wavfile.write(file, 8000, (wave * 32767).astype(np.int16))
    page, table = write_spectrum_report(file, tmp_path / "tone.html", unit="Pa")
    numbers = pd.read_csv(table)
    assert numbers.columns[1].endswith("[Pa^2/Hz]")
    assert numbers.iloc[np.argmax(numbers.iloc[:, 1]), 0] == pytest.approx(440, abs=5)
    assert "440" in page.read_text(encoding="utf-8")
    assert main(["spectrum", str(spreadsheet), "--channel", "1", "--out", str(tmp_path / "one.html")]) == 0
    assert pd.read_csv(tmp_path / "one.csv").shape[1] == 3


@pytest.mark.parametrize("samples", [10, 64, 100, 1000, 10_000, 10_000_000])
def test_the_segment_gives_sixteen_averages_where_the_record_is_long_enough(samples):
    segment = default_segment(samples)
    assert segment <= samples
    count = 1 + (samples - segment) // (segment // 2)
    assert count >= 16 or segment == min(64, samples)


def test_what_exists_is_not_touched_and_what_is_wrong_is_said(spreadsheet, tmp_path, capsys):
    out = tmp_path / "report.html"
    table = out.with_suffix(".csv")
    table.write_text("mine", encoding="utf-8")
    for arguments, told in (
        ([str(spreadsheet), "--out", str(out)], "report.csv exists"),
        ([str(tmp_path / "none.csv")], "there is no file"),
        ([str(spreadsheet), "--out", str(tmp_path / "a.html"), "--channel", "Druck"], "Druck"),
        ([str(spreadsheet), "--out", str(tmp_path / "b.html"), "--segment", "1"], "segment"),
        ([str(spreadsheet), "--out", str(tmp_path / "c.html"), "--window", "none"], "window"),
    ):
        assert main(["spectrum", *arguments]) == 2
        assert told in capsys.readouterr().err
    assert table.read_text(encoding="utf-8") == "mine"
    assert sorted(path.name for path in tmp_path.iterdir()) == ["Messung.csv", "report.csv"]
