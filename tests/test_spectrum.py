"""Spectra: conversions, mean squares and responses against scipy.signal and closed forms."""

from __future__ import annotations

import numpy as np
import pytest
import scipy.signal

import engdyn as ed
from analysis.linear_of import linear_of


def oscillator():
    return linear_of([[2.0]], [[3.0]], [[800.0]])


def test_sides_of_a_sampled_signal():
    """Pitfall 25: one-sided is twice two-sided, lines at 0 and half the rate apart; scipy agrees."""
    rate, x = 64.0, np.random.default_rng(1).normal(size=256) + 0.7
    one, two = (
        scipy.signal.periodogram(x, rate, detrend=False, return_onesided=kind)[1] for kind in (True, False)
    )
    f = np.fft.rfftfreq(256, 1 / rate)
    spectrum = ed.Spectrum(f, one, "V^2/Hz", rate=rate)
    np.testing.assert_allclose(spectrum.as_two_sided().values, two[:129], rtol=1e-12)
    np.testing.assert_allclose(spectrum.as_two_sided().as_one_sided().values, one, rtol=1e-12)
    assert ed.mean_square(spectrum) == pytest.approx(ed.mean_square(spectrum.as_two_sided()), rel=1e-12)
    assert np.sum(one) * rate / 256 == pytest.approx(
        np.mean(x**2)
    )  # Parseval; the trapezoids halve both ends
    assert ed.mean_square(spectrum) == pytest.approx(np.mean(x**2) - (one[0] + one[-1]) / 2 * rate / 256)


def test_hertz_and_radians():
    """Pitfall 25: S(f) df = S(ω) dω; the mean square is the same."""
    spectrum = ed.road_spectrum(np.linspace(0.5, 20, 400), 20.0)
    per_radian = spectrum.per_radian()
    np.testing.assert_allclose(per_radian.values * 2 * np.pi, spectrum.values, rtol=1e-14)
    assert (per_radian.unit, per_radian.per) == ("m^2/(rad/s)", "(rad/s)")
    assert per_radian.per_hertz().unit == "m^2/Hz"
    for other in (per_radian, spectrum.as_two_sided(), per_radian.as_two_sided()):
        assert ed.mean_square(other) == pytest.approx(ed.mean_square(spectrum), rel=1e-13)
        assert ed.mean_square(other, (1, 3)) == pytest.approx(ed.mean_square(spectrum, (1, 3)), rel=1e-13)
    assert repr(per_radian.as_two_sided()) == "Spectrum(400 values [m^2/(rad/s)], two-sided, 0.5 to 20 Hz)"


def test_mean_square_of_white_noise_by_welch():
    rate = 200.0
    x = 3.0 * np.random.default_rng(2).normal(size=60_000)
    f, values = scipy.signal.welch(x, rate, nperseg=1024)
    assert ed.mean_square(ed.Spectrum(f, values, "m^2/Hz", "hann", rate=rate)) == pytest.approx(9.0, rel=0.02)


def test_bands_add_up():
    f = np.linspace(0.1, 30, 777)
    spectrum = ed.earthquake_spectrum(f, 0.02)
    parts = [ed.mean_square(spectrum, band) for band in ((0.1, 1.234), (1.234, 9.99), (9.99, 30.0))]
    assert sum(parts) == pytest.approx(ed.mean_square(spectrum), rel=1e-5)
    total = ed.cumulative_mean_square(spectrum)
    assert (total[0], len(total)) == (0.0, 777)
    assert np.all(np.diff(total) > 0)
    assert total[-1] == pytest.approx(np.trapezoid(spectrum.values, f), rel=1e-13)


def test_response_to_white_noise():
    """One mode under a force of constant one-sided density G: mean square G/(4 c k)."""
    f = np.linspace(0.0, 400.0, 400_001)
    response = ed.frequency_response(oscillator(), f, "x1", "x1", unit="m/N")
    found = ed.response_psd(response, ed.white_noise(f, 7.0, "N^2/Hz"))
    assert found.unit == "m^2/Hz"
    assert ed.mean_square(found) == pytest.approx(7.0 / (4 * 3.0 * 800.0), rel=1e-5)
    two_sided = ed.response_psd(response, ed.white_noise(f, 7.0, "N^2/Hz").as_two_sided().per_radian())
    assert (two_sided.one_sided, two_sided.unit) == (False, "m^2/(rad/s)")
    assert ed.mean_square(two_sided) == pytest.approx(ed.mean_square(found), rel=1e-12)


def test_random_and_harmonic_excitation_of_one_system():
    """The density of a simulated response, by Welch, is |H|² S."""
    rate, linear = 100.0, oscillator()
    force = np.random.default_rng(5).normal(size=2**16)
    system = (linear.state_matrix, [[0.0], [0.5]], [[1.0, 0.0]], [[0.0]])
    x = scipy.signal.lsim(system, force, np.arange(2**16) / rate)[1]
    f, measured = scipy.signal.welch(x, rate, nperseg=4096)
    chosen = (f > 0.5) & (f < 8.0)
    response = ed.frequency_response(linear, f[chosen], "x1", "x1")
    expected = ed.response_psd(response, ed.Spectrum([0.0, 50.0], [2 / rate] * 2, "N^2/Hz"))
    ratio = measured[chosen] / expected.values
    assert np.mean(ratio) == pytest.approx(1.0, abs=0.05)
    assert ed.mean_square(expected) == pytest.approx(np.trapezoid(measured[chosen], f[chosen]), rel=0.1)


def test_units_are_carried():
    f = np.array([1.0, 2.0])
    road = ed.road_spectrum(f, 20.0)
    for unit, expected in (("-", "m^2/Hz"), ("1/s^2", "m^2/s^4/Hz"), ("N/m", "N^2/Hz"), ("", "|H|^2 m^2/Hz")):
        response = ed.frequency_response(oscillator(), f, "x1", "x1", unit=unit)
        assert ed.response_psd(response, road).unit == expected
    quake = ed.earthquake_spectrum(f, 1.0)
    shaken = ed.frequency_response(oscillator(), f, "x1", "x1", unit="s^2")
    assert ed.response_psd(shaken, quake).unit == "m^2/Hz"


def test_interpolation_is_linear():
    response = ed.frequency_response(oscillator(), [1.0, 1.5], "x1", "x1")
    found = ed.response_psd(response, ed.Spectrum([1.0, 2.0], [4.0, 8.0], "N^2/Hz"))
    np.testing.assert_allclose(found.values / response.amplitude**2, [4.0, 6.0], rtol=1e-14)


def test_roads_of_iso_8608():
    """At 0.1 cycles/m a class C road has 256e-6 m³; the speed shifts and lowers it."""
    for road_class, roughness in (("A", 16e-6), ("C", 256e-6), ("H", 262144e-6)):
        for speed in (10.0, 30.0):
            found = ed.road_spectrum([0.1 * speed, 0.2 * speed], speed, road_class)
            np.testing.assert_allclose(found.values, [roughness / speed, roughness / speed / 4], rtol=1e-14)


def test_earthquake_of_kanai_and_tajimi():
    """|absolute acceleration of an oscillator on rock|², which tends to the rock's at 0 Hz."""
    f = np.array([0.0, 1.0, 2.5, 20.0])
    s, w = 2j * np.pi * f, 2 * np.pi * 2.5
    expected = np.abs((w**2 + 1.2 * w * s) / (w**2 + 1.2 * w * s + s**2)) ** 2
    np.testing.assert_allclose(ed.earthquake_spectrum(f, 0.3).values, 0.3 * expected, rtol=1e-13)


ROAD = ed.road_spectrum(np.linspace(1.0, 9.0, 9), 20.0)
LINES = ed.Spectrum([0.0, 1.0], [1.0, 2.0], "m")
WRONG = [
    (lambda: ed.mean_square(LINES), "needs a Spectrum of densities"),
    (lambda: LINES.per_radian(), "needs a Spectrum of densities"),
    (lambda: ed.mean_square(ROAD, (0.5, 2.0)), "does not lie within"),
    (lambda: ed.mean_square(ROAD, (3.0, 2.0)), "does not lie within"),
    (lambda: ed.mean_square(ROAD, 3.0), "two frequencies"),
    (lambda: ed.Spectrum([0.0, 1.0], [1.0], "m^2/Hz"), "one value for each frequency"),
    (lambda: ed.Spectrum([1.0, 0.0], [1.0, 1.0], "m^2/Hz"), "rise"),
    (lambda: ed.Spectrum([0.0, 1.0], [1.0, np.nan], "m"), "finite"),
    (lambda: ed.Spectrum([0.0, 1.0], [1.0, -1.0], "m^2/Hz"), "never negative"),
    (lambda: ed.Spectrum([0.0], ["a"], "m"), "real numbers"),
    (lambda: ed.road_spectrum([1.0], 20.0, "I"), "letter from A"),
    (lambda: ed.road_spectrum([0.0, 1.0], 20.0), "0 Hz"),
    (lambda: ed.earthquake_spectrum([1.0], 1.0, 0.0), "positive"),
    (lambda: ed.response_psd(response(12.0), ROAD), "nothing is known"),
    (lambda: ed.response_psd(response(2.0), LINES), "must be a Spectrum of densities"),
    (lambda: ed.response_psd(response(2.0, "furlong?/N"), ROAD), "is not a unit"),
    (lambda: ed.response_psd(ROAD, ROAD), "needs the FrequencyResponse"),
]


def response(frequency, unit=""):
    return ed.frequency_response(oscillator(), [1.0, frequency], "x1", "x1", unit=unit)


@pytest.mark.parametrize(("attempt", "message"), WRONG, ids=[message for _, message in WRONG])
def test_what_is_wrong_is_said(attempt, message):
    with pytest.raises(ed.EngdynError, match=message):
        attempt()
