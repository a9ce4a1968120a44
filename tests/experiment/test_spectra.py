"""Amplitudes, densities, folding, leakage and densities of derivatives (sections 9.6 to 9.8)."""

from __future__ import annotations

import numpy as np
import pytest
import scipy.signal

import engdyn as ed
from engdyn.experiment.windows import COSINES

WINDOWS = (*COSINES, "bartlett")


def noise(N, rate=1000.0, unit="m", seed=1):
    return ed.Record(np.random.default_rng(seed).normal(size=N) + 0.7, rate, "x", unit)


def cosine(lines, N=256, amplitude=1.0, phase=0.0):
    return ed.Record(amplitude * np.cos(2 * np.pi * lines * np.arange(N) / N + phase), N, "x", "m")


@pytest.mark.parametrize("N", [1000, 1001])
def test_parseval_of_lines_without_window(N):
    record = noise(N)
    A = ed.amplitude_spectrum(record).values
    total = A[0] ** 2 + np.sum(A[1:] ** 2) / 2 + (A[-1] ** 2 / 2 if N % 2 == 0 else 0)
    assert total == pytest.approx(np.mean(record.samples**2), rel=1e-12)


@pytest.mark.parametrize("N", [1000, 1001])
@pytest.mark.parametrize("name", WINDOWS)
def test_parseval_of_densities_for_every_window(name, N):
    record, w = noise(N), ed.window(name, N)
    found = ed.power_spectral_density(record, window=name, detrend=None)
    windowed = np.sum((w * record.samples) ** 2) / np.sum(w**2)
    assert np.sum(found.values) * record.rate / N == pytest.approx(windowed, rel=1e-12)
    two = ed.power_spectral_density(record, window=name, detrend=None, one_sided=False)
    both = np.concatenate([two.values, two.values[1 : (N + 1) // 2]])  # the negative frequencies, not listed
    assert np.sum(both) * record.rate / N == pytest.approx(windowed, rel=1e-12)
    assert found.correction == pytest.approx(N / np.sum(w**2))


@pytest.mark.parametrize("name", WINDOWS)
def test_pitfall_25_density_of_white_noise_and_amplitude_of_a_line(name):
    """Without the energy correction, or with that for amplitudes, or two-sided for one-sided: 30 % off or more."""
    record = ed.Record(np.random.default_rng(3).normal(size=2**18) + 5.0, 100.0, "x", "m")
    found = ed.power_spectral_density(record, window=name, segment=1024)
    variance = np.var(record.samples)
    assert ed.mean_square(found) == pytest.approx(variance, rel=0.01)
    assert np.mean(found.values[2:-1]) == pytest.approx(2 * variance / 100, rel=0.01)
    assert ed.mean_square(found.as_two_sided()) == pytest.approx(ed.mean_square(found), rel=1e-12)
    assert ed.mean_square(found.per_radian()) == pytest.approx(ed.mean_square(found), rel=1e-12)
    assert ed.amplitude_spectrum(cosine(20, amplitude=3.0), window=name).values[20] == pytest.approx(
        3, rel=1e-13
    )


def test_the_mean_is_taken_out_before_the_window_spreads_it():
    record = ed.Record(np.random.default_rng(3).normal(size=4096) + 100.0, 1.0)
    left_in = ed.power_spectral_density(record, segment=256, detrend=None).values
    out = ed.power_spectral_density(record, segment=256).values
    assert left_in[1] > 1e4 * out[1]
    assert left_in[5:] == pytest.approx(out[5:], rel=1e-6)


def test_a_trend_is_taken_out_of_each_segment():
    t = np.arange(4096) / 64
    wave = np.cos(2 * np.pi * 8 * t)
    found = ed.power_spectral_density(ed.Record(wave + 50 * t, 64.0), segment=256, detrend="linear")
    expected = scipy.signal.welch(wave + 50 * t, 64.0, nperseg=256, detrend="linear")[1]
    assert np.max(np.abs(found.values - expected)) < 1e-12 * np.max(expected)


@pytest.mark.parametrize(
    ("N", "segment", "overlap"), [(5000, 256, 0.5), (5001, 255, 0.5), (999, 999, 0.0), (4000, 300, 0.75)]
)
@pytest.mark.parametrize("name", ["boxcar", "hann", "flattop"])
def test_densities_equal_those_of_scipy(N, segment, overlap, name):
    record = noise(N)
    found = ed.power_spectral_density(record, name, segment, overlap)
    how = {"window": name, "nperseg": segment, "noverlap": int(overlap * segment)}
    f, expected = scipy.signal.welch(record.samples, record.rate, **how)
    assert np.max(np.abs(found.frequency - f)) < 1e-12 * record.rate
    assert np.max(np.abs(found.values - expected)) < 1e-12 * np.max(expected)


def test_W12_three_sines_fold_onto_one_line():
    assert ed.alias_frequency([7, 13, 23], 10).tolist() == [3, 3, 3]
    assert ed.alias_frequency(15.92, 20.0) == pytest.approx(4.08)
    assert ed.alias_frequency([0, 5, 10, -7, 4], 10).tolist() == [0, 5, 0, 3, 4]
    t = np.arange(40) / 10
    for f in (7.0, 13.0, 23.0):
        found = ed.amplitude_spectrum(ed.Record(np.cos(2 * np.pi * f * t), 10.0))
        assert found.frequency[np.argmax(found.values)] == 3.0
        assert np.max(found.values) == pytest.approx(1)


def test_W13_leakage_with_and_without_hann():
    on = ed.amplitude_spectrum(cosine(10)).values
    assert on[10] == pytest.approx(1)
    assert np.max(np.delete(on, 10)) < 1e-14
    boxcar, hann = (ed.amplitude_spectrum(cosine(10.5), window=name).values for name in ("boxcar", "hann"))
    assert round(float(np.max(boxcar)), 4) == 0.6511
    assert round(float(np.max(hann)), 4) == 0.8489
    assert [f"{values[30]:.1e}" for values in (boxcar, hann)] == ["2.4e-02", "4.8e-05"]


def test_worst_amplitude_off_a_line_is_the_scalloping_of_the_window():
    phases = np.linspace(0, np.pi, 12)
    worst = [
        min(np.max(ed.amplitude_spectrum(cosine(60.5, 1024, phase=p), window=name).values) for p in phases)
        for name in ("boxcar", "hann", "flattop")
    ]
    assert worst == pytest.approx([2 / np.pi, 8 / (3 * np.pi), 0.9988], abs=5e-3)


def test_pitfall_26_zeros_interpolate_and_do_not_resolve():
    """Two sines 0.5 Hz apart: not told apart in 1 s whatever is appended, told apart in 4 s."""

    def record(seconds):
        t = np.arange(int(64 * seconds)) / 64
        return ed.Record(np.sin(2 * np.pi * 10 * t) + np.sin(2 * np.pi * 10.5 * t), 64.0)

    def peaks(spectrum):
        near = spectrum.values[(spectrum.frequency > 9) & (spectrum.frequency < 11.6)]
        return len(scipy.signal.find_peaks(near, height=0.6)[0])

    short, padded = (ed.amplitude_spectrum(record(1), interpolation=n) for n in (1, 16))
    assert peaks(padded) == 1
    assert peaks(ed.amplitude_spectrum(record(4), interpolation=4)) == 2
    assert padded.values[::16] == pytest.approx(short.values, abs=1e-13)
    assert padded.frequency[::16] == pytest.approx(short.frequency)
    top = ed.amplitude_spectrum(
        cosine(10.5, 255), interpolation=8
    )  # the curve between the lines has the amplitude
    assert np.max(top.values) == pytest.approx(1, rel=0.03)


def test_density_of_acceleration_from_that_of_displacement_and_back():
    t = np.arange(2000) / 200
    d = ed.power_spectral_density(ed.Record(0.01 * np.sin(2 * np.pi * 5 * t), 200.0, "x", "m"))
    a = ed.power_spectral_density(
        ed.Record(-0.01 * (10 * np.pi) ** 2 * np.sin(2 * np.pi * 5 * t), 200.0, "a", "m/s^2")
    )
    found = ed.motion_psd(d, "acceleration")
    assert found.unit == a.unit == "(m/s^2)^2/Hz"
    assert ed.mean_square(found, (3, 7)) == pytest.approx(ed.mean_square(a, (3, 7)), rel=1e-2)
    back = ed.motion_psd(found, "displacement")
    assert back.unit == d.unit == "m^2/Hz"
    assert len(back.values) == len(d.values) - 1
    assert back.values == pytest.approx(d.values[1:], rel=1e-12)
    assert (
        ed.motion_psd(ed.white_noise([1.0, 2.0], 1.0, "(rad/s)^2/(rad/s)"), "acceleration").unit
        == "(rad/s^2)^2/(rad/s)"
    )


@pytest.mark.parametrize("unit", ["g^2/Hz", "N^2/Hz", "m/Hz", "1/Hz", "kg m^2/Hz", "nonsense^2/Hz"])
def test_a_density_of_no_motion_is_refused(unit):
    with pytest.raises(ed.EngdynError, match="not the density of a motion"):
        ed.motion_psd(ed.white_noise([1.0, 2.0], 1.0, unit), "velocity")


def test_refusals():
    record = noise(100)
    two = ed.Record(np.ones((100, 2)), 10.0, ["a", "b"])
    for wrong, match in (
        (lambda: ed.amplitude_spectrum(two), "one channel"),
        (lambda: ed.amplitude_spectrum(record.samples), "one channel"),
        (lambda: ed.amplitude_spectrum(record, interpolation=1.5), "how many times"),
        (lambda: ed.power_spectral_density(record, segment=101), "from 2 to the 100"),
        (lambda: ed.power_spectral_density(record, segment=50, overlap=1.0), "0 ≤ overlap < 1"),
        (lambda: ed.power_spectral_density(record, detrend="mean"), "choose 'constant'"),
        (lambda: ed.power_spectral_density(record, window="none"), "choose one of boxcar"),
        (lambda: ed.alias_frequency(3.0, 0.0), "positive samples per second"),
        (lambda: ed.motion_psd(ed.amplitude_spectrum(record), "velocity"), "needs a Spectrum of densities"),
        (lambda: ed.motion_psd(ed.power_spectral_density(record), "jerk"), "choose one of"),
    ):
        with pytest.raises(ed.EngdynError, match=match):
            wrong()
