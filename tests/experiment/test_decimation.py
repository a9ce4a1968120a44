"""Decimation: no folding, no phase, usable band and edges (section 9.9)."""

from __future__ import annotations

import numpy as np
import pytest

import engdyn as ed


def sine(f, rate=2000.0, seconds=20.0, **more):
    t = np.arange(int(rate * seconds)) / rate
    return ed.Record(np.sin(2 * np.pi * f * t), rate, "a", "m/s^2", **more)


def amplitude(record, f):
    found = ed.amplitude_spectrum(record, "hann")
    return float(np.max(found.values[np.abs(found.frequency - f) < 0.5]))


@pytest.mark.parametrize("factor", [2, 5, 20, 64])
def test_every_frequency_of_the_usable_band_is_kept_with_its_phase(factor):
    for part in (0.1, 0.5, 1.0):
        record = sine(part * 0.8 * 1000 / factor)
        found = ed.decimate(record, factor)
        assert found.usable_frequency == pytest.approx(0.8 * 1000 / factor)
        inner = slice(found.edge, -found.edge)
        assert found.rate == 2000 / factor
        assert len(found) == -(-len(record) // factor)
        assert np.max(np.abs(found.samples - record.samples[::factor])[inner]) < 2e-4


@pytest.mark.parametrize("factor", [2, 20, 64])
def test_what_would_fold_is_gone(factor):
    for f in np.array([1.0, 1.1, 1.7, 2.3]) * 1000 / factor:
        if f < 1000:
            found = ed.decimate(sine(f), factor)
            assert np.max(np.abs(found.samples[found.edge : -found.edge])) < 2e-4


def test_pitfall_26_every_twentieth_sample_alone_folds_the_band():
    """A vibration of 92 Hz turns into one of 8 Hz at 100 samples per second."""
    body, hop = sine(3.0), sine(92.0)
    record = ed.Record(body.samples + hop.samples, 2000.0)
    wrong = ed.Record(record.samples[::20], 100.0)
    assert amplitude(wrong, 8.0) == pytest.approx(1, abs=0.01)
    right = ed.decimate(record, 20)
    assert amplitude(right, 8.0) < 1e-3
    assert amplitude(right, 3.0) == pytest.approx(1, abs=0.01)


def test_what_folded_in_the_converter_stays():
    t = np.arange(2000) / 100
    measured = ed.Record(np.sin(2 * np.pi * 92 * t), 100.0)  # no filter before the converter: 8 Hz
    assert amplitude(ed.decimate(measured, 2), 8.0) == pytest.approx(1, abs=0.01)


def test_edges_are_told_and_a_ramp_has_none():
    ramp = ed.Record(np.arange(4000.0), 2000.0)
    found = ed.decimate(ramp, 10)
    assert np.max(np.abs(found.samples - ramp.samples[::10])) < 1e-8
    step = ed.decimate(ed.Record(np.cos(2 * np.pi * 30 * np.arange(4000) / 2000), 2000.0), 10)
    error = np.abs(step.samples - np.cos(2 * np.pi * 30 * step.time))
    assert np.max(error[: step.edge]) > 5e-3
    assert np.max(error[step.edge : -step.edge]) < 2e-4


def test_channels_times_and_factor_one():
    both = ed.Record(
        np.random.default_rng(0).normal(size=(2001, 2)), 100.0, ["x", "y"], ["m", "N"], start=5.0
    )
    found = ed.decimate(both, 4)
    assert (found.channels, found.units, found.start) == (("x", "y"), ("m", "N"), 5.0)
    assert np.array_equal(found["y"].samples, ed.decimate(both["y"], 4).samples)
    assert found.time == pytest.approx(both.time[::4])
    same = ed.decimate(both, 1)
    assert np.array_equal(same.samples, both.samples)
    assert (same.usable_frequency, same.edge) == (50.0, 0)


def test_refusals():
    record = sine(1.0, seconds=0.5)
    for wrong in (0, 2.0, "2"):
        with pytest.raises(ed.RecordError, match="whole factor"):
            ed.decimate(record, wrong)
    with pytest.raises(ed.RecordError, match="longer record or a smaller factor"):
        ed.decimate(record, 100)
