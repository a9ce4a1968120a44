"""Frequency response: against direct solutions, closed forms, published values and scipy.signal."""

from __future__ import annotations

import itertools
import warnings

import mpmath
import numpy as np
import pytest
import scipy.integrate
import scipy.signal
import sympy as sm
from sympy.physics.mechanics import dynamicsymbols

import engdyn as ed
from analysis.linear_of import linear_of, linearized
from engdyn.analysis.harmonic import CHUNK, Harmonic
from engdyn.analysis.phase import unwrapped

T = dynamicsymbols._t


def chain(c_1=4.0, c_2=1.5, outputs=None):
    """The worked example W9, by Lagrange."""
    x1, x2, F = dynamicsymbols("x1 x2 F")
    v1, v2 = x1.diff(T), x2.diff(T)
    kinetic, potential = (2 * v1**2 + v2**2) / 2, 400 * x1**2 + 150 * (x2 - x1) ** 2
    losses = c_1 * v1**2 / 2 + c_2 * (v2 - v1) ** 2 / 2
    eom = ed.lagrange(kinetic, potential, [x1, x2], losses, {x1: F})
    return ed.linearize(eom, {}, {}, outputs=outputs)


def oscillator(mass=2.0, ratio=0.05, frequency=3.0):
    omega = 2 * np.pi * frequency
    return linear_of([[mass]], [[2 * ratio * omega * mass]], [[omega**2 * mass]])


def rotor_in_fixed_axes(values):
    """S14 with the displacements x, y along fixed axes; F_x, F_y at the disc."""
    x, y, F_x, F_y = dynamicsymbols("x y F_x F_y")
    m, k, c_e, c_i, Omega = (values[n] for n in ("m", "k", "c_e", "c_i", "Omega"))
    rows = [
        m * x.diff(T, 2) + c_e * x.diff(T) + c_i * (x.diff(T) + Omega * y) + k * x - F_x,
        m * y.diff(T, 2) + c_e * y.diff(T) + c_i * (y.diff(T) - Omega * x) + k * y - F_y,
    ]
    return ed.linearize(ed.EquationsOfMotion.from_residuals(rows, [x, y]), {}, {})


def directly(linear, frequency, inputs):
    """All coordinates, by one dense solution of [[s − Gq, −G], [K, sM + C]] per frequency, shape (n, inputs, N)."""
    A, n, m = linear.state_matrix, len(linear.coordinates), len(linear.mass)
    holonomic = n == m and np.array_equal(A[:n], np.eye(n, 2 * n, n))
    found = []
    for s in 2j * np.pi * np.asarray(frequency):
        below = [linear.stiffness, s * linear.mass + linear.damping]
        columns = []
        for name in inputs:
            if name in linear.coordinates:
                columns.append(A[linear.coordinates.index(name), n:] + 0j)
            else:
                columns.append(
                    sum(B[:, linear.inputs.index(name)] * s**k for k, B in enumerate(linear.input_matrices))
                )
        load = np.array(columns).T
        if holonomic:
            found.append(np.linalg.solve(below[0] + s * below[1], load))
        else:
            matrix = np.block([[s * np.eye(n) - A[:n, :n], -A[:n, n:]], below])
            found.append(np.linalg.solve(matrix, np.vstack([np.zeros((n, len(inputs))), load]))[:n])
    return np.moveaxis(np.array(found), 0, -1)


def stable_states():
    for number in range(1, 24):
        system = ed.systems.load(number)
        values = system.values(r_u=0) if number == 19 else system.values()  # S19 about its averaged state
        for e in system.equilibria(values):
            linear = ed.linearize(system.equations, e)
            if not ed.stability(linear).verdict.startswith("unstable"):
                yield pytest.param(linear, id=f"S{number:02d}")
                break
    yield pytest.param(rotor_in_fixed_axes(ed.systems.load(14).values()), id="S14 in fixed axes")
    yield pytest.param(chain(), id="W9")


STATES = list(stable_states())


def scale_of(linear):
    size = np.abs(ed.eigenvalues(linear))
    return np.array([size[size > 1e-6 * size.max()].min(), size.max()]) / (2 * np.pi)


@pytest.mark.parametrize("linear", STATES)
def test_every_stable_system_against_direct_solutions(linear):
    low, high = scale_of(linear)
    f = np.geomspace(0.03 * low, 10 * high, 60)
    inputs = [w for w in linear.inputs if w not in linear.changing_inputs] + list(linear.coordinates)
    response = ed.frequency_response(linear, f, inputs, linear.coordinates)
    expected = directly(linear, f, inputs)
    assert response.response.shape == expected.shape == (len(linear.coordinates), len(inputs), 60)
    scale = np.max(np.abs(expected), axis=0)
    assert np.max(np.abs(response.response - expected) / np.where(scale > 0, scale, 1)) < 1e-10


@pytest.mark.parametrize("linear", STATES)
def test_very_many_frequencies(linear):
    """Sums over modes, and what replaces them, are as exact as solutions."""
    low, high = scale_of(linear)
    f, some = np.linspace(0.03 * low, 2 * high, 3 * CHUNK + 7), np.arange(5, 3 * CHUNK, 611)
    many = ed.frequency_response(linear, f, linear.coordinates, linear.coordinates)
    few = ed.frequency_response(linear, f[some], linear.coordinates, linear.coordinates)
    scale = np.max(np.abs(few.response), axis=0)
    assert np.max(np.abs(many.response[..., some] - few.response) / scale) < 2e-12


def test_sums_over_modes_are_used_where_they_are_exact(monkeypatch):
    solved, solve = [], Harmonic._solved
    monkeypatch.setattr(
        Harmonic, "_solved", lambda self, omega: solved.append(len(omega)) or solve(self, omega)
    )
    ed.frequency_response(chain(), np.linspace(0.1, 6.0, 2 * CHUNK), "F", ["x1", "x2"])
    assert solved == [4, 4]  # what the two chunks are compared with: their ends, middles and peaks


@pytest.mark.parametrize(
    ("number", "state", "input", "size", "output", "frequency"),
    [
        (3, 2, "F", 0.01, "theta", 1.0),
        (10, 0, "yb", 1e-6, "y2", 4.0),
        (12, 0, "alpha_g", 1e-5, "alpha", 3.0),
        (13, 0, "F", 1e-3, "psi", 8.0),
        (23, 0, "yf", 1e-5, "theta", 1.5),
    ],
)
def test_settled_nonlinear_motion(number, state, input, size, output, frequency):
    """The equations of motion themselves, integrated until free vibrations are gone, vibrate as H says."""
    system = ed.systems.load(number)
    e = system.equilibria()[state]
    linear, rhs = ed.linearize(system.equations, e), system.equations.function(e.values)
    w, slowest = 2 * np.pi * frequency, -np.max(ed.eigenvalues(linear).real)
    begin = np.ceil(10 / slowest * frequency) / frequency
    times = begin + np.arange(64) / 64 / frequency

    def moved(t, x):
        drive = size * np.array([np.cos(w * t), -w * np.sin(w * t), -w * w * np.cos(w * t)])
        return rhs(t, x, {**e.inputs, input: tuple(drive)})

    start = np.concatenate([e.q, e.speeds])
    options = {"method": "DOP853", "rtol": 1e-9, "atol": 1e-13, "t_eval": times}
    path = scipy.integrate.solve_ivp(moved, (0.0, times[-1]), start, **options).y
    found = 2 * np.mean(path[linear.coordinates.index(output)] * np.exp(-1j * w * times)) / size
    assert abs(found / ed.frequency_response(linear, frequency, input, output).response[0] - 1) < 1e-3


@pytest.mark.parametrize("ratio", [1.0, 1.0 + 1e-9])
def test_nearly_parallel_eigenvectors(ratio):
    """A critically damped oscillator has one eigenvector for two eigenvalues."""
    f = np.linspace(0.0, 9.0, CHUNK + 50)
    response = ed.frequency_response(oscillator(ratio=ratio), f, "x1", "x1").response
    r = f / 3.0
    np.testing.assert_allclose(response, 1 / (2 * (6 * np.pi) ** 2 * (1 - r**2 + 2j * ratio * r)), rtol=1e-9)


PUBLISHED = [
    (3, 2, "F", 1.0, {"theta": (0.0120353, -17.24)}),
    (7, 0, "F", 0.2, {"x": (0.000156592, -9.831), "theta": (5.35449e-05, 172.9)}),
    (23, 0, "yf", 1.0, {"z": (1.67014, -57.27), "theta": (1.12743, -58.73), "zf": (1.18299, -11.63)}),
    (23, 0, "yf", 1.0, {"zr": (0.00503328, 84.71)}),
    (10, 0, "yb", 4.0, {"y1": (3.6854, None), "y2": (9.2314, None)}),
    (16, 0, "M_w", 0.2, {"phi": (3.2705e-6, None)}),
]


@pytest.mark.parametrize(("number", "state", "input", "frequency", "expected"), PUBLISHED)
def test_published_responses(number, state, input, frequency, expected):
    linear = linearized(number, state)
    for name, (amplitude, degrees) in expected.items():
        response = ed.frequency_response(linear, frequency, input, name)
        assert response.amplitude == pytest.approx(amplitude, rel=2e-5)
        assert degrees is None or np.degrees(response.phase) == pytest.approx(degrees, abs=0.06)


def test_unbalance_of_the_feeder():
    """Exercise 7.3: the force grows with the square of the speed and acts at the exciter."""
    system = ed.systems.load(19)
    values = system.values(r_u=0)
    linear = ed.linearize(system.equations, system.equilibria(values)[0])
    turn = linear.at.q[2]
    across, up = (np.array([[0.2, -0.3], [0.3, 0.2]]) @ [np.cos(turn), np.sin(turn)]).tolist()
    unbalance = {
        "x": lambda f: 0.8 * (2 * np.pi * f) ** 2,
        "y": lambda f: -0.8j * (2 * np.pi * f) ** 2,
        "phi": lambda f: 0.8 * (2 * np.pi * f) ** 2 * (-1j * across - up),
    }
    speed = 100 / (2 * np.pi)
    response = ed.frequency_response(linear, [speed / 2, speed], unbalance, ["x", "y", "phi"])
    np.testing.assert_allclose(response.amplitude[:, 1], [2.763e-3, 2.885e-3, 5.205e-3], rtol=2e-4)


@pytest.mark.parametrize("Omega", [150.0, 316.2, 450.0])
def test_internal_damping_does_nothing_in_synchronous_whirl(Omega):
    """Exercise 7.7: r = m ε Ω²/(k − m Ω² + i c_e Ω), also as the steady state in turning axes."""
    system = ed.systems.load(14)
    values = system.values(Omega=Omega)
    push = values["m"] * values["epsilon"] * Omega**2
    turning = {"F_x": push, "F_y": -1j * push}
    response = ed.frequency_response(rotor_in_fixed_axes(values), Omega / (2 * np.pi), turning, ["x", "y"])
    expected = push / (values["k"] - values["m"] * Omega**2 + 1j * values["c_e"] * Omega)
    np.testing.assert_allclose(response.response[:, 0], [expected, -1j * expected], rtol=1e-10)
    xi, eta = system.equilibria(values)[0].q
    np.testing.assert_allclose(xi + 1j * eta, expected, rtol=1e-9)


def test_chain_of_two_masses():
    """W9 undamped: peaks at 2.1280 and 4.1234 Hz, the first mass at rest at 2.7566 Hz."""
    f = np.linspace(0.5, 6.0, 800)
    first, second = (ed.frequency_response(chain(0, 0), f, "F", x) for x in ("x1", "x2"))
    np.testing.assert_allclose(first.antiresonances, [np.sqrt(300) / (2 * np.pi)], rtol=1e-7)
    np.testing.assert_allclose(first.peaks, [2.1280, 4.1234], atol=5e-5)
    assert len(second.antiresonances) == 1  # a minimum between the peaks, but no zero
    assert second.amplitude.min() > 1e-4
    damped = ed.frequency_response(chain(), f, "F", ["x1", "x2"])
    polynomials = (
        [1.0, 1.5, 300.0],
        np.polysub(np.polymul([2.0, 5.5, 1100.0], [1.0, 1.5, 300.0]), [2.25, 900.0, 9e4]),
    )
    expected = scipy.signal.freqs(*polynomials, worN=2 * np.pi * f)[1]
    np.testing.assert_allclose(damped.response[0], expected, rtol=1e-11)


def test_two_wheels_with_a_delay():
    """Exercise 7.5 and 7.1: the rear wheel meets the road (a + b)/v later."""
    linear, f = linearized(23), np.linspace(0.2, 12.0, 300)
    delay = 2.6 / 20.0
    both = {"yf": 1.0, "yr": lambda f: np.exp(-2j * np.pi * f * delay)}
    response = ed.frequency_response(linear, f, both, "z")
    front, rear = directly(linear, f, ["yf", "yr"])[0]
    np.testing.assert_allclose(response.response, front + np.exp(-2j * np.pi * f * delay) * rear, rtol=1e-10)
    # A bump shorter than the wheelbase, by superposition over a period of 64 s and by integration
    rate, count = 256.0, 2**14
    t = np.arange(count) / rate

    def bump(t):
        return np.where((t > 0) & (t < 0.1), 0.04 * np.sin(np.pi * t / 0.1) ** 2, 0.0)

    lines = np.fft.rfftfreq(count, 1 / rate)
    heave = np.fft.irfft(
        np.fft.rfft(bump(t)) * ed.frequency_response(linear, lines, both, "z").response, count
    )
    wheels = np.column_stack([bump(t), bump(t - delay)])
    B = np.vstack([np.zeros((4, 3)), np.linalg.solve(linear.mass, linear.input_matrices[0])])
    B = B[:, [linear.inputs.index("yf"), linear.inputs.index("yr")]]
    expected = scipy.signal.lsim((linear.state_matrix, B, np.eye(1, 8), np.zeros((1, 2))), wheels, t)[1]
    np.testing.assert_allclose(heave, expected, atol=1e-3 * np.max(np.abs(expected)))


def test_rates_and_accelerations_by_name():
    linear, f = chain(), np.array([1.0, 2.5])
    motion, rate, acceleration = ed.frequency_response(linear, f, "F", ["x2", "x2'", "x2''"]).response
    np.testing.assert_allclose(rate, 2j * np.pi * f * motion, rtol=1e-14)
    np.testing.assert_allclose(acceleration, (2j * np.pi * f) ** 2 * motion, rtol=1e-14)


# ---------------------------------------------------------------- outputs


def test_outputs_against_differences_at_a_steady_motion():
    """Slopes of expressions in motion, inputs and parameters, at a turning table with a moving base of parts."""
    system = ed.systems.load(6)
    e = system.equilibria()[0]
    names = [c.symbol for c in system.coordinates]
    a, b = names[0], names[-1]
    parameter = system.parameters[0].symbol
    outputs = {
        "mixed": parameter * a.diff(T) ** 2 * b + sm.cos(a - b) * b.diff(T, 2) + sm.sqrt(1 + b**2),
        "force": system.inputs[0].symbol * sm.cos(b) + b.diff(T) * a.diff(T, 2),
    }
    linear = ed.linearize(system.equations, e, outputs=outputs)
    assert linear.outputs == ("mixed", "force")
    derivatives = [[q.diff(T, k) if k else q for q in names] for k in (0, 1, 2)]
    points = [x for part in derivatives for x in part] + [w.symbol for w in system.inputs]
    stand_ins = sm.symbols(f"z0:{len(points)}")
    swap = dict(zip(points[::-1], stand_ins[::-1], strict=True))
    swap = dict(sorted(swap.items(), key=lambda item: -getattr(item[0], "derivative_count", 0)))
    values = {p.symbol: e.values[p.name] for p in system.parameters}
    plain = [y.xreplace(swap).xreplace(values) for y in outputs.values()]
    here = [*e.q, *e.speeds, *e.accelerations, *(e.inputs.get(w.name, 0.0) for w in system.inputs)]
    at = dict(zip(stand_ins, map(float, here), strict=True))
    slopes = np.array([[float(y.diff(z).xreplace(at)) for z in stand_ins] for y in plain])
    n = len(names)
    order = [n * 3 + [w.name for w in system.inputs].index(w) for w in linear.inputs]
    for found, columns in zip(
        linear.output_matrices[:4], (range(n), range(n, 2 * n), range(2 * n, 3 * n), order), strict=True
    ):
        np.testing.assert_allclose(found, slopes[:, list(columns)], rtol=1e-12, atol=1e-12)
    assert not np.any(linear.output_matrices[4:])


def test_force_and_motion_of_a_point():
    """The crane: a point of the container, and the wind that is needed to see it at rest."""
    system = ed.systems.load(7)
    x, theta = (c.symbol for c in system.coordinates)
    L = next(p.symbol for p in system.parameters if p.name == "L")
    place = x + L * sm.sin(theta)
    outputs = {
        "place": place,
        "acceleration": place.diff(T, 2),
        "sway": L * theta - system.inputs[0].symbol / 1000,
    }
    linear = ed.linearize(system.equations, system.equilibria()[0], outputs=outputs)
    f = np.array([0.1, 0.3])
    names = ["x", "theta", "place", "acceleration", "sway", "place''"]
    X, Theta, P, A, S, P_dd = ed.frequency_response(linear, f, system.inputs[0].name, names).response
    np.testing.assert_allclose(P, X + 9.0 * Theta, rtol=1e-12)
    np.testing.assert_allclose(A, -((2 * np.pi * f) ** 2) * P, rtol=1e-12)
    np.testing.assert_allclose(P_dd, A, rtol=1e-12)
    np.testing.assert_allclose(S, 9.0 * Theta - 1e-3, rtol=1e-12)


def test_nonholonomic_outputs_and_other_speeds():
    """S13: ψ' follows from the rolling condition; speeds=["psi"] is the derivation with that speed."""
    system = ed.systems.load(13)
    y, psi = (c.symbol for c in system.coordinates)
    outputs = {"swing": psi.diff(T), "jolt": psi.diff(T, 2) + y.diff(T, 2)}
    usual = ed.linearize(system.equations, {}, system.values(), outputs=outputs)
    other = ed.linearize(system.equations, {}, system.values(), outputs=outputs, speeds=["psi"])
    f, inputs, names = np.array([1.0, 9.0, 20.0]), ["F", "M", "y", "psi"], ["y", "psi", "swing", "jolt"]
    a, b = (ed.frequency_response(linear, f, inputs, names).response for linear in (usual, other))
    np.testing.assert_allclose(b, a, rtol=1e-11)
    np.testing.assert_allclose(a[2], 2j * np.pi * f * a[1], rtol=1e-11)
    np.testing.assert_allclose(a[3], -((2 * np.pi * f) ** 2) * (a[0] + a[1]), rtol=1e-11)
    derived = ed.lagrange(
        system.kinetic_energy,
        system.potential_energy,
        [y, psi],
        system.dissipation,
        system.generalized_forces,
        system.constraints,
        speeds=[psi.diff(T)],
    )
    expected = ed.linearize(derived, {}, system.values())
    for name in ("mass", "damping", "stiffness", "state_matrix"):
        np.testing.assert_allclose(getattr(other, name), getattr(expected, name), rtol=1e-11, atol=1e-9)
    np.testing.assert_allclose(other.input_matrices[0], expected.input_matrices[0], rtol=1e-11)


def test_symbolic_outputs_and_transfer_functions():
    system = ed.systems.load(13)
    y, psi = (c.symbol for c in system.coordinates)
    outputs = {"side": sm.Symbol("k_s", real=True) * y + psi.diff(T)}
    values = {**system.values(), "k_s": 7.0}
    symbolic = ed.linearize(system.equations, {}, outputs=outputs, symbolic=True, speeds=["psi"])
    numeric = ed.linearize(system.equations, {}, values, outputs=outputs, speeds=["psi"])
    f = 11.0
    for linear, exact, output in ((numeric, symbolic, "side"), (numeric, symbolic, "psi''")):
        H = ed.transfer_function(exact, "F", output)
        number = H.xreplace({s: values[s.name] for s in H.free_symbols if s.name != "s"})
        expected = complex(number.subs("s", 2j * np.pi * f))
        np.testing.assert_allclose(
            ed.frequency_response(linear, f, "F", output).response, expected, rtol=1e-9
        )
    W9 = ed.systems.load("W9")
    s, m_1, m_2, k_1, k_2, c_1, c_2 = (sm.Symbol("s"), *(p.symbol for p in W9.parameters))
    found = ed.transfer_function(ed.linearize(W9.equations, {}, symbolic=True), "xb", "x2")
    a, b = c_1 * s + k_1, c_2 * s + k_2
    expected = a * b / ((m_1 * s**2 + a + b) * (m_2 * s**2 + b) - b**2)
    assert sm.cancel(found - expected) == 0


# ---------------------------------------------------------------- phase


def test_phase_of_a_lag_is_negative_and_continuous():
    """Pitfall 22: mass 2 of W9 goes from 0 to −2π without jumps; atan2 alone would jump."""
    f = np.linspace(0.1, 6.0, 600)
    first, second = (ed.frequency_response(chain(), f, "F", x) for x in ("x1", "x2"))
    assert np.max(np.abs(np.diff(np.angle(second.response)))) > 6
    for response, end in ((first, -1.0), (second, -2.0)):
        assert np.max(np.abs(np.diff(response.phase))) < 0.5
        assert response.phase[0] == pytest.approx(0.0, abs=0.01)
        assert response.phase[-1] == pytest.approx(end * np.pi, abs=0.5)
        np.testing.assert_allclose(np.exp(1j * response.phase) * response.amplitude, response.response)


def test_jumps_without_damping_are_those_of_small_damping():
    """Pitfall 22: down by π at resonances, up by π at an antiresonance, as with a little damping."""
    f = np.linspace(0.5, 6.0, 4001)
    for name, levels in (("x1", [0, -1, 0, -1]), ("x2", [0, -1, -2])):
        sharp = ed.frequency_response(chain(0, 0), f, "F", name).phase / np.pi
        runs = sharp[np.concatenate([[True], np.abs(np.diff(sharp)) > 0.5])]
        np.testing.assert_allclose(runs, levels, atol=1e-9)
        soft = (
            ed.frequency_response(chain(4e-3, 1.5e-3), np.linspace(0.5, 6.0, 200_001), "F", name).phase
            / np.pi
        )
        at = [1.0, 2.5, 3.3, 5.5]
        np.testing.assert_allclose(
            np.interp(at, np.linspace(0.5, 6.0, 200_001), soft), np.interp(at, f, sharp), atol=0.01
        )


def test_noise_is_not_unwrapped():
    """Pitfall 22: where the amplitude means nothing no turn is counted."""
    f = np.arange(200.0)
    clean = np.exp(-0.02j * f)
    random = np.random.default_rng(3)
    noisy = clean.copy()
    noisy[80:120] = 1e-13 * np.exp(1j * random.uniform(-np.pi, np.pi, 40))
    phase = unwrapped(f, noisy)
    good = np.r_[:80, 120:200]
    np.testing.assert_allclose(phase[good], -0.02 * f[good], atol=1e-12)
    assert np.all(np.abs(phase[80:120]) <= np.pi)
    noisy[80:120] *= 1e12
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        assert np.abs(unwrapped(f, noisy)[80:] + 0.02 * f[80:]).max() > 1


def test_a_coarse_grid_is_told():
    with pytest.warns(ed.EngdynWarning, match="too coarse"):
        _ = ed.frequency_response(chain(0.04, 0.015), [2.0, 2.2, 2.5], "F", "x1").phase
    _ = ed.frequency_response(chain(), np.linspace(2.0, 2.5, 30), "F", "x1").phase  # any warning is an error


# ---------------------------------------------------------------- peaks


@pytest.mark.parametrize("ratio", [0.01, 0.1, 0.4])
def test_peak_and_half_power_of_one_mode(ratio):
    response = ed.frequency_response(oscillator(ratio=ratio), np.linspace(0.0, 9.0, 400), "x1", "x1")
    (peak,) = response.peaks
    assert peak == pytest.approx(3 * np.sqrt(1 - 2 * ratio**2), rel=1e-7)
    if ratio == 0.4:  # the static response is more than 1/√2 of the peak
        with pytest.raises(ed.EngdynError, match="widen the range"):
            response.half_power_band(peak)
        return
    squares = 1 - 2 * ratio**2 + np.array([-2, 2]) * ratio * np.sqrt(1 - ratio**2)
    np.testing.assert_allclose(response.half_power_band(peak), 3 * np.sqrt(squares), rtol=1e-7)
    assert len(response.antiresonances) == 0


# ---------------------------------------------------------------- refusals


def test_no_stationary_response():
    """Exercise 7.8: beyond the speed of flutter there is none."""
    assert ed.frequency_response(linearized(12, U=20.0), 1.0, "alpha_g", "y").amplitude > 0
    with pytest.raises(ed.EngdynError, match=r"no stationary response: .*unstable \(flutter\)"):
        ed.frequency_response(linearized(12, U=21.0), 1.0, "alpha_g", "y")
    with pytest.raises(ed.EngdynError, match="undamped natural frequency"):
        ed.frequency_response(chain(0, 0), ed.modes(chain(0, 0)).natural_frequency, "F", "x1")
    with pytest.raises(ed.EngdynError, match="write the equations in fixed axes"):
        ed.frequency_response(linearized(14), 1.0, "F_x", "xi")


def test_rigid_body_motion():
    """Pitfall 19: the crane is carried away at 0 Hz, like 1/(c_x ω) just above."""
    linear = linearized(7)
    with pytest.raises(ed.EngdynError, match="begin above 0 Hz"):
        ed.frequency_response(linear, [0.0, 1.0], "F", "x")
    low = ed.frequency_response(linear, [1e-6, 1e-5], "F", "x")
    np.testing.assert_allclose(low.amplitude * 2 * np.pi * low.frequency, 1 / linear.damping[0, 0], rtol=1e-6)
    free = linear_of([[2.0, 0.0], [0.0, 1.0]], np.zeros((2, 2)), [[5.0, -5.0], [-5.0, 5.0]])
    f = np.linspace(1e-3, 2.0, CHUNK + 1)  # a Jordan block: the mass center moves freely
    x = ed.frequency_response(free, f, "x1", ["x1", "x2"]).response
    np.testing.assert_allclose((2 * x[0] + x[1]) * (2 * np.pi * f) ** 2, -1, rtol=1e-6)


def test_an_input_in_a_constraint_is_not_ignored():
    x, y, w = dynamicsymbols("x y w")
    eom = ed.lagrange(
        (x.diff(T) ** 2 + y.diff(T) ** 2) / 2,
        50 * (x**2 + y**2),
        [x, y],
        (x.diff(T) ** 2) / 2,
        constraints=[y.diff(T) - 2 * x.diff(T) - w],
    )
    with pytest.raises(ed.EngdynError, match="occurs in the constraints"):
        ed.frequency_response(ed.linearize(eom, {}, {}), 1.0, "w", "y")


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (([1.0], "G", "x1"), "there is no input 'G'"),
        (([1.0], "F", "x3"), "there is no output 'x3'"),
        (([2.0, 1.0], "F", "x1"), "rising"),
        (([1.0], "F", 1), "output is 1"),
        (([1.0], [], "x1"), "give the name of one"),
        (([-1.0, 1.0], "F", "x1"), "from 0 on"),
        (([np.nan], "F", "x1"), "rising"),
        ((["a"], "F", "x1"), "numbers in Hz"),
        (([1.0], {"F": "2"}, "x1"), "factor of F"),
        (([1.0], {"F": np.inf}, "x1"), "not finite"),
    ],
)
def test_what_is_wrong_is_said(arguments, message):
    with pytest.raises(ed.EngdynError, match=message):
        ed.frequency_response(chain(), *arguments)


def test_wrong_outputs_and_speeds():
    x1, other = dynamicsymbols("x1 other")
    castor = ed.systems.load(13)
    for outputs, message in (
        ({"x1": x1}, "other than those of coordinates"),
        ([x1], "give a mapping"),
        ({"a": other}, "contains other"),
        ({"a": x1.diff(T, 3)}, "two derivatives"),
        ({"a": sm.Symbol("c") * x1}, "lacks the parameters c"),
        ({"a": x1 * T}, "depend on time"),
        ({"a": sm.sqrt(x1)}, "not finite"),
        ({"a": "x1"}, "not text"),
    ):
        with pytest.raises(ed.EngdynError, match=message):
            chain(outputs=outputs)
    with pytest.raises(ed.EngdynError, match="choose the rates of 1 of y, psi"):
        ed.linearize(castor.equations, {}, castor.values(), speeds=["y", "psi"])
    with pytest.raises(ed.EngdynError, match="symbolic=True"):
        ed.transfer_function(chain(), "F", "x1")
    response = ed.frequency_response(chain(), [1.0, 2.0], "F", ["x1", "x2"])
    with pytest.raises(ed.EngdynError, match="one input and one output"):
        _ = response.peaks
    assert repr(response) == "FrequencyResponse(('x1', 'x2') per F, 1 to 2 Hz)"


def test_modal_sums_are_right_to_the_last_digits_at_a_light_resonance():
    """Against 40 digits: an error of λ would be magnified there by 1/(iω − λ)."""
    n = 10
    x = dynamicsymbols(f"x1:{n + 1}")
    stretch = [x[0], *(b - a for a, b in itertools.pairwise(x))]
    kinetic, potential, loss = (
        sum(q.diff() ** 2 for q in x) / 2,
        500 * sum(d**2 for d in stretch),
        sum(d.diff() ** 2 for d in stretch) / 4,
    )
    F = dynamicsymbols("F")
    linear = ed.linearize(ed.lagrange(kinetic, potential, list(x), loss, {x[-1]: F}), {}, {})
    f = np.linspace(0.1, 12.0, 2 * CHUNK + 900)
    found = ed.frequency_response(linear, f, "F", list(linear.coordinates)).response
    peak = int(np.argmax(np.max(np.abs(found), axis=0)))
    with mpmath.workdps(40):
        omega = 2 * mpmath.pi * mpmath.mpf(float(f[peak]))
        M, C, K = (mpmath.matrix(a.tolist()) for a in (linear.mass, linear.damping, linear.stiffness))
        load = mpmath.matrix(linear.input_matrices[0][:, 0].tolist())
        exact = mpmath.lu_solve(K - omega**2 * M + mpmath.mpc(0, 1) * omega * C, load)
    expected = np.array([complex(value) for value in exact])
    assert np.max(np.abs(found[:, peak] - expected)) < 1e-12 * np.max(np.abs(expected))
