"""Cross-spectra, estimated responses and coherence against scipy.signal and a known filter (section 9.10)."""

from __future__ import annotations

import numpy as np
import pytest
import scipy.signal

import engdyn as ed

RATE = 200.0
FILTER = scipy.signal.butter(2, 0.3)


@pytest.fixture(scope="module")
def pair():
    rng = np.random.default_rng(7)
    x = rng.normal(size=60_000)
    return x, scipy.signal.lfilter(*FILTER, x), rng.normal(size=60_000)


def records(x, y):
    return ed.Record(x, RATE, "force", "N"), ed.Record(y, RATE, "acceleration", "m/s^2")


@pytest.mark.parametrize("window", ["boxcar", "hann"])
@pytest.mark.parametrize(("segment", "overlap"), [(256, 0.5), (255, 0.25)])
def test_estimates_and_coherence_equal_those_of_scipy(pair, window, segment, overlap):
    x, y = pair[0] + 0.3, pair[1] + 0.2 * pair[2]
    how = {"fs": RATE, "window": window, "nperseg": segment, "noverlap": int(overlap * segment)}
    xy, yx = scipy.signal.csd(x, y, **how)[1], scipy.signal.csd(y, x, **how)[1]
    xx, yy = scipy.signal.welch(x, **how)[1], scipy.signal.welch(y, **how)[1]
    coherence = scipy.signal.coherence(x, y, **how)[1]
    a, b = records(x, y)
    cross = ed.cross_spectral_density(a, b, window, segment, overlap)
    assert np.max(np.abs(cross.values - xy)) < 1e-12 * np.max(np.abs(xy))
    assert cross.unit == "N (m/s^2)/Hz"
    for estimator, expected in (("H1", xy / xx), ("H2", yy / yx)):
        found = ed.estimate_frf(a, b, estimator, window, segment, overlap)
        lines = np.searchsorted(cross.frequency, found.frequency)
        assert len(lines) >= len(xx) - 1  # without window the mean has no power once it is taken out
        assert np.max(np.abs(found.response / expected[lines] - 1)) < 1e-10
        assert np.max(np.abs(found.coherence - coherence[lines])) < 1e-12
        assert found.unit == "m/s^2/N"


def test_H1_is_not_biased_by_noise_in_the_output_nor_H2_by_noise_in_the_input(pair):
    x, y, noise = pair
    truth = np.abs(scipy.signal.freqz(*FILTER, worN=[0.1 * np.pi])[1][0])  # at 10 Hz

    def gain(a, b, estimator):
        found = ed.estimate_frf(*records(a, b), estimator, segment=200)
        return found.amplitude[np.searchsorted(found.frequency, 10.0)]

    assert gain(x, y + noise, "H1") == pytest.approx(truth, rel=0.06)
    assert gain(x, y + noise, "H2") > 1.7 * truth
    assert gain(x + noise, y, "H2") == pytest.approx(truth, rel=0.06)
    assert gain(x + noise, y, "H1") < 0.6 * truth


def test_pitfall_26_the_mean_of_quotients_is_not_the_quotient_of_means(pair):
    x, y, noise = pair
    noisy = y + 3 * noise
    found = ed.estimate_frf(*records(x, noisy), segment=200, overlap=0)
    spectra = [scipy.signal.stft(a, RATE, "hann", 200, 0, boundary=None)[2] for a in (x, noisy)]
    truth = scipy.signal.freqz(*FILTER, worN=2 * np.pi * found.frequency / RATE)[1]
    inner = slice(2, -2)
    error = np.sqrt(np.mean(np.abs((found.response - truth)[inner]) ** 2))
    wrong = np.sqrt(np.mean(np.abs((np.mean(spectra[1] / spectra[0], axis=1) - truth)[inner]) ** 2))
    assert error < 0.25
    assert wrong > 2 * error


def test_pitfall_26_coherence_of_one_segment_is_refused_and_of_several_tells_the_noise(pair):
    x, y, noise = pair
    one = ed.estimate_frf(*records(x, noise))
    assert one.response.shape == one.frequency.shape
    with pytest.raises(ed.EngdynError, match="whatever was measured: give segment="):
        _ = one.coherence
    unrelated = ed.estimate_frf(*records(x, noise), segment=200)
    assert np.mean(unrelated.coherence) < 0.01
    low = ed.estimate_frf(*records(x, y + noise), segment=200)
    assert np.mean(low.coherence[2:20]) == pytest.approx(0.5, abs=0.03)  # equal powers in the pass band
    assert np.min(ed.estimate_frf(*records(x, 2 * x), segment=200).coherence) == pytest.approx(1)


def test_random_error_is_the_scatter_of_repeated_estimates(pair):
    x, y, noise = pair
    parts = [
        ed.estimate_frf(*records(a, b), segment=100)
        for a, b in zip(x.reshape(60, -1), (y + noise).reshape(60, -1), strict=True)
    ]
    sizes = np.array([p.amplitude for p in parts])[:, 3:12]
    scatter = np.mean(np.std(sizes, axis=0) / np.mean(sizes, axis=0))
    told = np.mean([p.random_error[3:12] for p in parts])
    assert told == pytest.approx(scatter, rel=0.15)


def test_a_delay_is_a_lag(pair):
    x = pair[0]
    found = ed.estimate_frf(*records(x[3:], x[:-3]), segment=512)
    inner = slice(2, 60)
    assert found.phase[inner] == pytest.approx(-2 * np.pi * found.frequency[inner] * 3 / RATE, abs=0.1)


def test_lines_that_the_input_does_not_excite_are_left_out():
    t = np.arange(2000) / RATE
    drive = np.sin(2 * np.pi * 20 * t)
    found = ed.estimate_frf(*records(drive, -0.5 * drive), window="boxcar", segment=200)
    assert found.frequency.tolist() == [20.0]
    assert found.response[0] == pytest.approx(-0.5)


def test_refusals(pair):
    x, y = records(*pair[:2])
    with pytest.raises(ed.EngdynError, match="choose 'H1'"):
        ed.estimate_frf(x, y, "H3")
    with pytest.raises(ed.RecordError, match="do not belong together"):
        ed.estimate_frf(x, ed.Record(pair[1], 2 * RATE))
    with pytest.raises(ed.RecordError, match="do not belong together"):
        ed.cross_spectral_density(x, ed.Record(pair[1][:-1], RATE))
    with pytest.raises(ed.RecordError, match="does not change"):
        ed.estimate_frf(ed.Record(np.ones(1000), RATE), ed.Record(pair[1][:1000], RATE), segment=100)
