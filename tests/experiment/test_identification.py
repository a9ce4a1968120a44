"""Modes of the catalogue's systems, found again in simulated measurements that scipy has integrated."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest
import scipy.integrate
import scipy.signal

import engdyn as ed
from engdyn.errors import EngdynError, EngdynWarning, RecordError

RNG = np.random.default_rng(11)


def _decay(time, frequency, zeta, phase=0.3):
    omega = 2 * np.pi * frequency
    return np.exp(-zeta * omega * time) * np.cos(omega * np.sqrt(1 - zeta**2) * time + phase)


TIME = np.arange(4000) / 100


@pytest.mark.parametrize("zeta", [0.005, 0.02, 0.076, 0.15])
@pytest.mark.parametrize("offset", [0.0, 3.0])
def test_decrement_of_one_mode_about_its_offset(zeta, offset):
    x = _decay(TIME, 0.5, zeta) + offset
    found = ed.log_decrement(ed.Record(x, 100, "x", "m", start=7.0))
    assert found.damping_ratio == pytest.approx(zeta, rel=1e-3)
    assert found.decrement == pytest.approx(2 * np.pi * zeta / np.sqrt(1 - zeta**2), rel=1e-3)
    assert found.natural_frequency == pytest.approx(0.5, rel=1e-3)
    assert found.offset == pytest.approx(offset, abs=1e-4)
    assert found.times[0] > 7.0
    noisy = ed.log_decrement(x + 0.005 * RNG.normal(size=len(x)), 100)
    assert noisy.damping_ratio == pytest.approx(zeta, rel=0.04)
    assert noisy.natural_frequency == pytest.approx(0.5, rel=0.01)


def test_decrement_of_two_modes_warns_or_is_refused():
    first = _decay(TIME, 0.5, 0.02)
    with pytest.warns(EngdynWarning, match="several modes"):
        ed.log_decrement(first + 0.1 * _decay(TIME, 1.35, 0.02), 100)
    for other in (1.35, 2.5, 0.2):
        with pytest.raises(RecordError, match="mode"):
            ed.log_decrement(first + _decay(TIME, other, 0.01), 100)
    with pytest.raises(RecordError, match="beat"):
        ed.log_decrement(_decay(TIME, 0.5, 0.003) + 0.95 * _decay(TIME, 0.575, 0.003), 100)


def test_decrement_of_friction_warns():
    wobble = np.clip(1 - TIME / 42, 0, None) * np.cos(np.pi * TIME)
    with pytest.warns(EngdynWarning, match="friction"):
        ed.log_decrement(wobble, 100)


@pytest.mark.parametrize(
    ("x", "rate", "message"),
    [
        (np.cos(np.pi * TIME) * np.exp(0.05 * TIME), 100, "smaller"),
        (_decay(TIME[:250], 0.5, 0.02), 100, "maxima and minima"),
        (_decay(TIME, 0.5, 0.02), None, "rate"),
        (np.c_[TIME, TIME], 100, "choose one channel"),
        (np.cos(np.pi * np.arange(50)), 1, "in a period"),
    ],
)
def test_what_has_no_decrement(x, rate, message):
    with pytest.raises(RecordError, match=message):
        ed.log_decrement(ed.Record(x, 100, ["a", "b"]) if x.ndim == 2 else x, rate)


def test_half_power_of_one_mode():
    f = np.linspace(0.1, 20, 4000)
    response = 1 / (25 - f**2 + 2j * 0.02 * 5 * f)
    found = ed.half_power(SimpleNamespace(frequency=f, response=response))
    assert found.frequency == pytest.approx(5 * np.sqrt(1 - 2 * 0.02**2), rel=1e-4)
    assert found.damping_ratio == pytest.approx(0.02, rel=0.01)
    density = ed.Spectrum(f, np.abs(response) ** 2, "m^2/Hz")
    assert ed.half_power(density, 4.0).damping_ratio == pytest.approx(found.damping_ratio, rel=1e-9)
    coarse = SimpleNamespace(frequency=f[::40], response=response[::40])
    with pytest.warns(EngdynWarning, match="lines lie within"):
        ed.half_power(coarse)
    with pytest.raises(EngdynError, match="no peak"):
        ed.half_power(SimpleNamespace(frequency=f, response=1 / (1 + f)))
    with pytest.raises(EngdynError, match="half its power"):
        ed.half_power(SimpleNamespace(frequency=f[970:1010], response=response[970:1010]))


def _sum_of_modes(s, eigenvalues, residues):
    return sum(
        r[:, None] / (s - p) + r.conj()[:, None] / (s - p.conj())
        for r, p in zip(residues.T, eigenvalues, strict=True)
    )


def test_a_rational_fraction_is_found_exactly():
    f = np.linspace(0.05, 30, 600)
    zeta, natural = np.array([0.19, 0.30, 0.239, 0.02]), np.array([1.04, 1.157, 11.02, 11.4])
    eigenvalues = 2 * np.pi * natural * (-zeta + 1j * np.sqrt(1 - zeta**2))
    residues = RNG.normal(size=(3, 4)) + 1j * RNG.normal(size=(3, 4))
    response = _sum_of_modes(2j * np.pi * f, eigenvalues, residues) + 0.01
    frf = SimpleNamespace(frequency=f, response=response)
    found = ed.fit_modes(frf, 4)
    np.testing.assert_allclose(found.eigenvalues, eigenvalues, rtol=1e-8)
    np.testing.assert_allclose(found.residues, residues, rtol=1e-6)
    np.testing.assert_allclose(found.evaluate(f), response, rtol=0, atol=1e-9)
    assert found.error.max() < 1e-9
    one_by_one = [SimpleNamespace(frequency=f, response=row) for row in response]
    np.testing.assert_allclose(ed.fit_modes(one_by_one, 4).eigenvalues, eigenvalues, rtol=1e-8)
    assert "ζ = 0.19" in repr(found)
    assert "damping ratio" in found._repr_html_()
    with pytest.raises(EngdynError, match="more lines"):
        ed.fit_modes(frf, 400)
    with pytest.raises(EngdynError, match="same frequencies"):
        ed.fit_modes([frf, SimpleNamespace(frequency=f + 1, response=response)], 2)
    with pytest.raises(EngdynError, match=r"needs \.frequency"):
        ed.fit_modes(response, 2)


# ----- the catalogue -------------------------------------------------------------------------------------------


def _measured(key, start, inputs, times):
    """Motion of a system by scipy: equilibrium plus a start, under inputs of time."""
    system = ed.systems.load(key)
    equations = system.equations
    rhs = equations.function(system.values())
    n = len(system.coordinates)
    rest = np.concatenate([system.equilibria()[0].q, np.zeros(n)])

    def f(t, x):
        return rhs(t, x, inputs(t))

    found = scipy.integrate.solve_ivp(
        f, times[[0, -1]], rest + start, t_eval=times, method="DOP853", rtol=1e-7, atol=1e-10
    )
    history = SimpleNamespace(time=times, q=(found.y.T - rest)[:, :n], u=found.y.T[:, n:])
    return history, ed.damped_modes(ed.linearize(equations, system.equilibria()[0]))


def test_crane_by_decrement_and_by_fit():
    """S07: one swinging mode beside the trolley's creeping; the sensor's mean drifts."""
    times = np.arange(0, 40, 0.01)
    history, truth = _measured("S07", [0, 0.05, 0, 0], lambda t: {}, times)
    wide = ed.Sensor("gyro angle", "rad", 10.0, 1.0, 500.0)
    record = ed.virtual_test(history, wide, "q2", rate=50, noise=1e-4, offset=0.01, bits=16)
    found = ed.log_decrement(record)
    assert found.natural_frequency == pytest.approx(truth.natural_frequency[0], rel=0.01)
    assert found.damping_ratio == pytest.approx(truth.damping_ratio[0], rel=0.1)

    def swing(t, a, b, zeta, f, c):
        omega = 2 * np.pi * f
        turn = omega * np.sqrt(1 - zeta**2) * t
        return np.exp(-zeta * omega * t) * (a * np.cos(turn) + b * np.sin(turn)) + c

    start = {"a": 0.05, "b": 0.0, "zeta": 0.05, "f": 0.28, "c": 0.0}
    fitted = ed.fit(record.time, record.samples, swing, start=start)
    assert fitted["f"] == pytest.approx(truth.natural_frequency[0], rel=0.01)
    assert fitted["zeta"] == pytest.approx(truth.damping_ratio[0], rel=0.1)


@pytest.mark.parametrize(
    ("key", "driven", "size", "band", "rate", "periods", "runs", "channels"),
    [
        ("S10", "F", 20.0, (0.5, 30.0), 100.0, 8.0, 3, (0, 1)),
        ("S21", "F_w", 2000.0, (0.1, 2.5), 10.0, 100.0, 2, (0, 1, 2)),
        ("S23", "F_z", 300.0, (0.2, 25.0), 80.0, 20.0, 2, (0, 1, 2, 3)),
    ],
)
def test_frequencies_damping_and_shapes_of_a_shaker_test(
    key, driven, size, band, rate, periods, runs, channels
):
    """A periodic noise without leakage, after the start has died out; estimates by scipy, not by our spectra."""
    # S10's floor spring is cubic: its force is small enough for a linear test.
    force = ed.random_noise(size, *band, periods, seed=1)
    times = np.arange(0, runs * periods + 0.5 / rate, 0.5 / rate)
    history, truth = _measured(key, 0.0, lambda t: {driven: float(force(t))}, times)
    free = ed.Sensor("displacement", "m", 100.0, 0.01 + 2e-4 * size, 50.0 * rate)
    cell = ed.Sensor("force", "N", 0.001, 1e4, 50.0 * rate)
    places = [f"q{i + 1}" for i in channels]
    output = {"force": force(times), **dict(zip(places, places, strict=True))}
    sensors = [cell] + [free] * len(places)  # one filter for all: its delay cancels
    record = ed.virtual_test(history, sensors, output, rate=rate, noise=1e-8, bits=24, seed=2)
    count = round(periods * rate)
    frequency = np.fft.rfftfreq(count, 1 / rate)
    lines = (frequency > band[0]) & (frequency < min(band[1], 0.35 * rate))
    x, *y = np.fft.rfft(record.samples[-count:], axis=0)[lines].T
    frf = SimpleNamespace(frequency=frequency[lines], response=np.array(y) / x)
    found = ed.fit_modes(frf, len(truth.eigenvalues))
    np.testing.assert_allclose(found.natural_frequency, truth.natural_frequency, rtol=0.01)
    np.testing.assert_allclose(found.damping_ratio, truth.damping_ratio, rtol=0.1)
    alike = ed.mac(found.shapes, truth.shapes)
    assert np.diag(alike).min() > 0.98
