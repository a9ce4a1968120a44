"""Averages of segments, what they are worth, and spectrograms (section 9.10)."""

from __future__ import annotations

import numpy as np
import pytest
import scipy.signal

import engdyn as ed


def noise(N, seed=0, rate=100.0):
    return ed.Record(np.random.default_rng(seed).normal(size=N), rate, "x", "m")


def test_the_scatter_of_one_segment_is_as_large_as_the_density_and_falls_with_averages():
    for segments in (1, 8, 64):
        record = noise(1024 * segments)
        found = ed.averaged_spectrum(record, "boxcar", 1024, overlap=0)
        inner = found.values[1:-1]
        assert found.segments == segments
        assert found.averages == pytest.approx(segments)
        assert np.std(inner) / np.mean(inner) == pytest.approx(1 / np.sqrt(segments), rel=0.12)


@pytest.mark.parametrize(
    ("overlap", "averaging"), [(0.0, "linear"), (0.5, "linear"), (0.75, "linear"), (0.5, "exponential")]
)
def test_what_averages_are_worth_is_seen_in_their_scatter(overlap, averaging):
    record = noise(640 * 400)
    blocks = record.samples.reshape(400, -1)
    found = [
        ed.averaged_spectrum(ed.Record(x, 100.0), "hann", 64, overlap, None, averaging=averaging, memory=5)
        for x in blocks
    ]
    values = np.array([s.values[3:-3] for s in found])
    scatter = np.mean(np.var(values, axis=0)) / np.mean(values) ** 2
    assert 1 / scatter == pytest.approx(found[0].averages, rel=0.08)
    assert found[0].averages < found[0].segments + 1e-9


@pytest.mark.parametrize("scaling", ["density", "amplitude"])
def test_95_of_100_confidence_bands_hold_the_truth(scaling):
    inside = []
    for x in np.random.default_rng(5).normal(size=(100, 1024)):
        found = ed.averaged_spectrum(ed.Record(x, 100.0), "hann", 128, detrend=None, scaling=scaling)
        low, high = found.confidence_band(0.95)
        truth = 2 / 100 if scaling == "density" else np.sqrt(2 * 2 / 100 * 100 / 128 * 1.5)
        inside.append((low < truth) & (truth < high))
    assert np.mean(np.array(inside)[:, 2:-2]) == pytest.approx(0.95, abs=0.015)


def test_lines_without_phase_have_one_degree_of_freedom_for_each_average():
    even, odd = (ed.averaged_spectrum(noise(N), "boxcar", detrend=None) for N in (64, 65))
    assert even.degrees_of_freedom[[0, 1, -1]].tolist() == [1, 2, 1]
    assert odd.degrees_of_freedom[[0, 1, -1]].tolist() == [1, 2, 2]
    first = [ed.averaged_spectrum(noise(64, seed), "boxcar", detrend=None).values for seed in range(2000)]
    spread = (
        np.var(first, axis=0) / np.mean(first, axis=0) ** 2
    )  # 2/n of a chi-square with n degrees of freedom
    assert spread[[0, -1]] == pytest.approx([2, 2], rel=0.15)
    assert np.mean(spread[1:-1]) == pytest.approx(1, rel=0.05)


def test_exponential_average_is_its_recursion():
    record = noise(64 * 20)
    segments = ed.spectrogram(record, "hann", 64, 0.5).values.T
    expected = segments[0]
    for k, new in enumerate(segments[1:], start=2):
        expected = expected + (new - expected) / min(k, 6)
    found = ed.averaged_spectrum(record, "hann", 64, 0.5, averaging="exponential", memory=6)
    assert found.values == pytest.approx(expected, rel=1e-12)


def test_peak_hold_is_the_largest_of_all_segments(monkeypatch):
    record = noise(64 * 20)
    monkeypatch.setattr("engdyn.experiment.segments.CHUNK", 640)
    found = ed.averaged_spectrum(record, "hann", 64, 0.5, averaging="peak hold")
    assert found.values == pytest.approx(
        ed.spectrogram(record, "hann", 64, 0.5).values.max(axis=1), rel=1e-12
    )


def test_peak_hold_keeps_a_burst_that_an_average_hides():
    x = np.zeros(6400)
    x[3200:3264] = np.sin(2 * np.pi * 25 * np.arange(64) / 100)
    held, mean = (
        ed.averaged_spectrum(ed.Record(x, 100.0), "boxcar", 64, 0, averaging=a, scaling="amplitude")
        for a in ("peak hold", "linear")
    )
    assert held.values[16] == pytest.approx(1)
    assert mean.values[16] == pytest.approx(0.1)
    with pytest.raises(ed.EngdynError, match="no confidence band"):
        held.confidence_band()


def test_averaged_amplitudes_of_a_steady_sine_and_its_offset():
    t = np.arange(4096) / 256
    record = ed.Record(
        0.25 + 1.7 * np.sin(2 * np.pi * 32 * t) + 0.6 * np.cos(np.pi * 256 * t), 256.0, "a", "m/s^2"
    )
    found = ed.averaged_spectrum(record, "hann", 256, detrend=None, scaling="amplitude")
    assert found.values[[0, 32, -1]] == pytest.approx([0.25, 1.7, 0.6])
    assert (found.unit, found.correction) == ("m/s^2", pytest.approx(2))


def test_pitfall_26_complex_spectra_average_to_nothing():
    """Powers are averaged: the mean of the complex lines of segments with arbitrary phases vanishes."""
    record = noise(256 * 400)
    found = ed.averaged_spectrum(record, "boxcar", 256, 0, None)
    wrong = np.abs(np.mean(np.fft.rfft(record.samples.reshape(-1, 256)), axis=0)) ** 2 * 2 / (100 * 256)
    assert np.mean(found.values[1:-1]) == pytest.approx(0.02, rel=0.02)
    assert np.mean(wrong[1:-1]) < 0.02 / 300


def test_the_result_does_not_depend_on_how_many_segments_are_transformed_at_once(monkeypatch):
    record = noise(50_000)
    whole = ed.averaged_spectrum(record, segment=1000).values
    monkeypatch.setattr("engdyn.experiment.segments.CHUNK", 3000)
    assert ed.averaged_spectrum(record, segment=1000).values == pytest.approx(whole, rel=1e-13)


def test_a_long_record_equals_scipy():
    record = noise(10**6, rate=2000.0)
    expected = scipy.signal.welch(record.samples, 2000.0, nperseg=8192)[1]
    found = ed.power_spectral_density(record, segment=8192)
    assert np.max(np.abs(found.values / expected - 1)) < 1e-12


def test_spectrogram_equals_scipy_and_follows_a_chirp():
    t = np.arange(8000) / 1000
    record = ed.Record(np.sin(2 * np.pi * (20 * t + 20 * t**2)), 1000.0, "chirp", "V", start=2.0)
    found = ed.spectrogram(record, "hann", 256, 0.5)
    _, times, values = scipy.signal.spectrogram(record.samples, 1000.0, "hann", 256, 128)
    assert found.time == pytest.approx(times + 2.0)
    assert np.max(np.abs(found.values - values)) < 1e-12 * np.max(values)
    ridge = found.frequency[np.argmax(found.values, axis=0)]
    assert np.max(np.abs(ridge - (20 + 40 * (found.time - 2.0)))) < 1000 / 256 + 40 * 0.128
    assert found.unit == "V^2/Hz"


def test_refusals():
    record = noise(100)
    for how in ({"averaging": "median"}, {"scaling": "rms"}, {"memory": 0.5}):
        with pytest.raises(ed.EngdynError, match="choose one of"):
            ed.averaged_spectrum(record, **how)
    with pytest.raises(ed.EngdynError, match="probability between 0 and 1"):
        ed.averaged_spectrum(record).confidence_band(95)
