"""A virtual test records what its instruments would: each fault that is put in is found in the record."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest
import scipy.signal
import sympy as sm

import engdyn as ed
from engdyn.errors import EngdynError, RecordError

TIME = np.linspace(0, 10, 100_001)


def _history(x, u=None):
    u = np.gradient(x, TIME) if u is None else u
    return SimpleNamespace(time=TIME, q=x[:, None], u=u[:, None])


def _tone(frequency, amplitude=1.0):
    omega = 2 * np.pi * frequency
    return _history(amplitude * np.sin(omega * TIME), amplitude * omega * np.cos(omega * TIME))


def _amplitude(record, frequency):
    """Of one tone, by least squares over the second half."""
    x, t = record.samples[len(record) // 2 :], record.time[len(record) // 2 :]
    phase = 2 * np.pi * frequency * t
    return float(np.hypot(*np.linalg.lstsq(np.c_[np.cos(phase), np.sin(phase), t**0], x, rcond=None)[0][:2]))


def test_an_ideal_chain_returns_the_motion():
    record = ed.virtual_test(_tone(2.0, 0.05), "displacement", rate=100, antialias=False, bits=None)
    assert (record.name, record.unit, record.rate, len(record)) == ("q1", "m", 100, 1001)
    np.testing.assert_allclose(
        record.samples[50:], 0.05 * np.sin(4 * np.pi * record.time[50:]), atol=1e-4
    )  # its lag


def test_an_accelerometer_takes_the_second_derivative():
    record = ed.virtual_test(_tone(2.0), rate=200, bits=24)
    assert record.unit == "m/s^2"
    assert _amplitude(record, 2.0) == pytest.approx((4 * np.pi) ** 2, rel=1e-3)
    velocity = ed.virtual_test(_tone(2.0, 0.05), "velocity", rate=200, bits=None)
    assert _amplitude(velocity, 2.0) == pytest.approx(0.05 * 4 * np.pi, rel=1e-3)


def test_without_the_filter_what_lies_above_folds_back():
    history = _tone(13.0, 0.05)
    folded = ed.virtual_test(history, "displacement", rate=10, antialias=False, bits=None)
    assert _amplitude(folded, 3.0) == pytest.approx(0.05, rel=1e-3)  # |13 − 10|
    filtered = ed.virtual_test(history, "displacement", rate=10, bits=None)
    expected = 0.05 * abs(scipy.signal.freqs(*scipy.signal.butter(8, 4.0, analog=True), worN=[13.0])[1][0])
    assert _amplitude(filtered, 3.0) == pytest.approx(expected, rel=0.05)


def test_noise_offset_drift_hum_and_dropouts():
    rest = _history(np.zeros_like(TIME))
    options = {"rate": 1000, "bits": None}
    noisy = ed.virtual_test(rest, "displacement", noise=0.01, **options)
    assert noisy.samples.std() == pytest.approx(0.01, rel=0.03)
    again = ed.virtual_test(rest, "displacement", noise=0.01, **options)
    np.testing.assert_array_equal(noisy.samples, again.samples)
    other = ed.virtual_test(rest, "displacement", noise=0.01, seed=1, **options)
    assert abs(np.corrcoef(noisy.samples, other.samples)[0, 1]) < 0.05
    record = ed.virtual_test(
        rest, "displacement", offset=0.02, drift=0.003, hum=0.005, noise=1e-3, dropouts=2, **options
    )
    look = record.summary().channels[0]
    assert look.dropouts in (1, 2)  # they may overlap
    assert look.hum == pytest.approx(0.005, rel=0.1)
    assert look.drift == pytest.approx(0.03, rel=0.1)
    assert record.samples[:100].mean() == pytest.approx(0.02, abs=2e-3)


def test_the_converter_has_steps_and_an_end():
    record = ed.virtual_test(_tone(1.0, 0.08), "displacement", rate=500, bits=8)
    step = 0.2 / 2**8
    np.testing.assert_allclose(record.samples / step, np.round(record.samples / step), atol=1e-9)
    ideal = ed.virtual_test(_tone(1.0, 0.08), "displacement", rate=500, bits=None)
    assert (record.samples - ideal.samples).std() == pytest.approx(step / np.sqrt(12), rel=0.1)
    short = ed.virtual_test(_tone(1.0, 0.08), "displacement", rate=500, full_scale=5.0)
    assert short.samples.max() == pytest.approx(0.05, rel=1e-3)
    assert short.summary().channels[0].clipped > 100
    beyond = ed.virtual_test(_tone(1.0, 0.3), "displacement", rate=500, antialias=False)
    assert np.abs(beyond.samples).max() == pytest.approx(0.1, rel=1e-3)


def test_an_encoder_counts():
    record = ed.virtual_test(_tone(1.0, 0.01), "encoder", rate=500)
    counts = record.samples * 8192 / (2 * np.pi)
    np.testing.assert_allclose(counts, np.round(counts), atol=1e-9)
    assert len(np.unique(np.round(counts))) == 27  # ±0.01 rad are ±13.04 steps


def test_a_sensor_of_its_own_has_its_bandwidth():
    slow = ed.Sensor("geophone", "m", 1.0, 1.0, 5.0)
    record = ed.virtual_test(_tone(5.0), slow, rate=100, antialias=False, bits=None)
    assert _amplitude(record, 5.0) == pytest.approx(np.sqrt(0.5), rel=1e-3)


def test_a_simulation_is_read_by_name_and_by_expression():
    system = ed.systems.load("S10")
    start = (system.equilibria()[0].q + [0, 0.002], [0, 0])
    history = system.simulate(start, np.linspace(0, 2, 401), inputs={"F": ed.sine(100, 2)})
    y1, y2 = (c.symbol for c in system.coordinates)
    stretch = {"spring": y2 - y1, "arm": "y2", "force": "F"}
    record = ed.virtual_test(
        history, ["strain", "accelerometer", "force"], stretch, rate=1000, antialias=False, bits=None
    )
    assert record.channels == ("spring", "arm", "force")
    assert record.units == ("m/m", "m/s^2", "N")
    exact = history.at(record.time)
    late = slice(100, None)
    np.testing.assert_allclose(record["arm"].samples[late], exact["y2''"][late], rtol=0, atol=5e-3)
    np.testing.assert_allclose(record["force"].samples[late], exact["F"][late], rtol=0, atol=0.2)
    assert ed.virtual_test(history, rate=200).channels == ("y1", "y2")


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"rate": 0}, "rate must be positive"),
        ({"rate": 100, "bits": 0}, "bits"),
        ({"rate": 100, "noise": -1}, "noise"),
        ({"rate": 100, "hum": np.nan}, "finite"),
        ({"rate": 100, "sensor": "thermometer"}, "no sensor 'thermometer'"),
        ({"rate": 100, "sensor": ["encoder", "strain"]}, "2 sensors for 1"),
        ({"rate": 100, "output": "x"}, "no output"),
        ({"rate": 100, "output": np.ones(3)}, "one finite value"),
        ({"rate": 1e6}, "10000 times per second"),
        ({"rate": 0.05}, "two to"),
    ],
)
def test_what_no_rig_does_is_refused(options, message):
    with pytest.raises(RecordError, match=message):
        ed.virtual_test(_tone(1.0), **options)


# ----- excitations ---------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "excitation",
    [
        ed.sine(2.0, 3.0, 0.4),
        ed.impact(5.0, 0.3, 0.2),
        ed.chirp(2.0, 1.0, 8.0, 1.0),
        ed.chirp(2.0, 1.0, 8.0, 1.0, logarithmic=True),
        ed.chirp(2.0, 5.0, 5.0, 1.0, logarithmic=True),
        ed.random_noise(1.0, 1.0, 6.0, 4.0, seed=3),
    ],
    ids=repr,
)
def test_derivatives_are_exact(excitation):
    value, rate, acceleration = excitation.motion
    t, h = np.linspace(0.21, 0.47, 14), 1e-5
    np.testing.assert_allclose((value(t + h) - value(t - h)) / (2 * h), rate(t), rtol=1e-5, atol=1e-4)
    np.testing.assert_allclose((rate(t + h) - rate(t - h)) / (2 * h), acceleration(t), rtol=1e-5, atol=1e-3)
    assert float(excitation(0.3)) == pytest.approx(excitation(np.array([0.3]))[0], rel=1e-12)


@pytest.mark.parametrize("logarithmic", [False, True])
def test_the_phase_of_a_chirp_is_the_integral_of_its_frequency(logarithmic):
    t = sm.Symbol("t")
    frequency = 2 * (sm.Integer(10) / 2) ** (t / 4) if logarithmic else 2 + (10 - 2) * t / 4
    sweep = ed.chirp(1.0, 2.0, 10.0, 4.0, logarithmic)
    for end in (0.7, 2.2, 4.0):
        turns = float(sm.integrate(frequency, (t, 0, end)))
        assert float(sweep(end)) == pytest.approx(np.sin(2 * np.pi * turns), abs=1e-9)
    reference = scipy.signal.chirp(TIME, 2, 4, 10, "logarithmic" if logarithmic else "linear", phi=-90)
    np.testing.assert_allclose(sweep(TIME), reference, atol=1e-9)


def test_impact_has_its_impulse_and_noise_its_mean_square_and_band():
    assert np.trapezoid(ed.impact(5.0, 0.1, 1.0)(TIME), TIME) == pytest.approx(0.25, rel=1e-6)
    noise = ed.random_noise(3.0, 2.0, 7.0, 10.0, seed=5)
    t = np.arange(1000) / 100
    assert np.sqrt(np.mean(noise(t) ** 2)) == pytest.approx(3.0, rel=1e-9)
    lines = np.abs(np.fft.rfft(noise(t)))
    np.testing.assert_allclose(lines[20:71], lines[20], rtol=1e-6)
    assert max(lines[:20].max(), lines[71:].max()) < 1e-6 * lines[20]
    np.testing.assert_allclose(noise(t + 10.0), noise(t), atol=1e-9)
    assert not np.allclose(noise(t), ed.random_noise(3.0, 2.0, 7.0, 10.0, seed=6)(t))


def test_excitations_that_are_none():
    with pytest.raises(EngdynError, match="duration"):
        ed.impact(1.0, 0.0)
    with pytest.raises(EngdynError, match="no multiple"):
        ed.random_noise(1.0, 1.1, 1.2, 2.0)
    with pytest.raises(EngdynError, match="frequency"):
        ed.sine(1.0, np.nan)


@pytest.mark.parametrize(
    ("wrong", "given"),
    [
        ("rate", {"rate": "fast"}),
        ("antialias", {"antialias": -5.0}),
        ("antialias", {"antialias": float("nan")}),
        ("seed", {"seed": -1}),
        ("outputs", {"output": []}),
        ("history", {"history": None}),
        ("history", {"history": SimpleNamespace(time=np.zeros(1))}),
    ],
)
def test_settings_that_make_no_sense_are_named(wrong, given):
    time = np.linspace(0, 1, 1001)
    motion = SimpleNamespace(time=time, q=np.sin(time)[:, None], u=np.cos(time)[:, None])
    with pytest.raises(ed.RecordError, match=wrong):
        ed.virtual_test(**{"history": motion, "rate": 100} | given)
