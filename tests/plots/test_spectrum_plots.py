"""Pictures of records, folding, leakage, windows and spectrograms show what they say."""

from __future__ import annotations

import numpy as np
import pytest

import engdyn as ed

TIME = np.arange(4000) / 500


def line(ax, label):
    return next(x for x in ax.lines if x.get_label() == label)


@pytest.fixture(scope="module")
def measured():
    x = 2 + np.sin(2 * np.pi * 3 * TIME) + 0.1 * np.random.default_rng(0).normal(size=4000)
    x = np.minimum(x, 2.8)
    x[1000:1100] = 0.0
    return ed.Record(x, 500.0, "acceleration", "m/s^2", start=1.0)


def test_a_record_shows_its_mean_what_is_clipped_and_where_nothing_was_measured(measured):
    ax = ed.plots.record(measured)
    assert line(ax, "mean").get_ydata()[0] == pytest.approx(measured.samples.mean())
    clipped = line(ax, "clipped at 2.8")
    assert set(clipped.get_ydata()) == {2.8}
    assert len(clipped.get_ydata()) == np.count_nonzero(measured.samples == 2.8)
    (dropout,) = (patch for patch in ax.patches if patch.get_label() == "dropout")
    assert [dropout.get_x(), dropout.get_width()] == pytest.approx([3.0, 99 / 500])
    assert ax.get_ylabel() == "acceleration [m/s²]"
    assert "clipped?; stands still 1 time" in ed.plots.alt(ax)


def test_the_mean_square_has_the_area_of_the_squares(measured):
    ax = ed.plots.record(measured, square=True)
    x, y = ax.lines[0].get_data()
    level = ax.lines[1].get_ydata()[0]
    assert np.trapezoid(y, x) / (x[-1] - x[0]) == pytest.approx(level, rel=1e-3)
    assert ax.get_ylabel() == "acceleration² [(m/s²)²]"


def test_no_peak_of_a_long_record_is_lost():
    x = np.random.default_rng(0).normal(size=200_000)
    x[123_456] = 9.0
    shown = ed.plots.record(ed.Record(x, 1000.0)).lines[0]
    assert len(shown.get_xdata()) < 9000
    assert (shown.get_ydata().max(), shown.get_ydata().min()) == (9.0, x.min())
    assert shown.get_xdata()[shown.get_ydata().argmax()] == pytest.approx(123.456, abs=0.06)


def test_folding_marks_what_is_seen_of_each_frequency():
    ax = ed.plots.folding(10.0, [7.0, 13.0, 23.0])
    for f in (7, 13, 23):
        assert line(ax, f"{f} Hz appears at 3 Hz").get_xydata().tolist() == [[f, 3.0]]
    sawtooth = next(x for x in ax.lines if len(x.get_xdata()) > 3)
    assert np.interp([2, 7, 13, 23], *sawtooth.get_data()) == pytest.approx([2, 3, 3, 3])
    assert "13 Hz appears at 3 Hz" in ed.plots.alt(ax)
    assert "None marked" in ed.plots.alt(ed.plots.folding(10.0))


@pytest.mark.parametrize("logarithmic", [False, True])
def test_lines_lie_on_the_curve_between_them(logarithmic):
    record = ed.Record(np.cos(2 * np.pi * 10.5 * np.arange(256) / 256), 256.0, "x", "m")
    ax = ed.plots.leakage(record, ["boxcar", "hann"], band=(0, 60), logarithmic=logarithmic)
    assert max(line(ax, "boxcar").get_ydata()) == pytest.approx(0.6511, abs=5e-5)
    assert max(line(ax, "hann").get_ydata()) == pytest.approx(0.8489, abs=5e-5)
    curves = [x for x in ax.lines if len(x.get_xdata()) > 1000]
    assert len(curves) == (0 if logarithmic else 2)
    for curve, name in zip(curves, ("boxcar", "hann"), strict=False):
        assert curve.get_ydata()[::16] == pytest.approx(line(ax, name).get_ydata(), abs=1e-12)
    assert ax.get_xlim() == (0, 60)
    least = ed.amplitude_spectrum(record, "hann").values[60]  # what is beyond the band needs no room
    assert ax.get_ylim()[0] == pytest.approx(0.5 * least if logarithmic else 0.0, rel=1e-9)
    assert "hann: largest line 0.8489 at 10 Hz" in ed.plots.alt(ax)


def test_windows_over_samples_and_over_lines():
    upper = ed.plots.window(["boxcar", "hann"], 32)
    lower = upper.figure.axes[1]
    assert upper.lines[1].get_ydata() == pytest.approx(ed.window("hann", 32))
    at, level = lower.lines[1].get_data()
    assert np.interp([0, 0.5], at, level) == pytest.approx([0, 20 * np.log10(0.8488)], abs=0.01)
    assert np.interp([2, 3], at, level).max() < -100
    assert "half a line off −1.42 dB" in ed.plots.alt(upper)


def test_a_spectrogram_shows_levels_below_the_largest(measured):
    found = ed.spectrogram(measured, segment=400)
    ax = ed.plots.spectrogram(found, decibels=40)
    levels = ax.collections[0].get_array()
    assert levels.shape == found.values.shape
    assert (levels.max(), levels.min()) == (0, -40)
    assert "(m/s²)²/Hz" in ax.figure.axes[1].get_ylabel()
    assert "largest density is at" in ed.plots.alt(ax)


def test_refusals(measured):
    two = ed.Record(np.ones((10, 2)), 1.0, ["a", "b"])
    for wrong, match in (
        (lambda: ed.plots.record(two), "one channel"),
        (lambda: ed.plots.leakage(measured, band=(5, 5)), "lower one first"),
        (lambda: ed.plots.window("hann", axes=[None]), "two axes"),
        (
            lambda: ed.plots.spectrogram(ed.spectrogram(ed.Record(np.zeros(64), 1.0), segment=16)),
            "all densities",
        ),
    ):
        with pytest.raises(ed.EngdynError, match=match):
            wrong()
