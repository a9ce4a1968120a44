"""Simulations: known end states, two derivations, other solvers, inputs of all kinds, events, and what goes wrong."""

from __future__ import annotations

import math
import sys
from functools import cache

import numpy as np
import pytest
import sympy as sm
from scipy.integrate import cumulative_simpson, solve_ivp
from sympy.physics.mechanics import dynamicsymbols

import engdyn as ed
from engdyn import progress
from engdyn.algebra import codegen
from engdyn.modeling import derivative
from engdyn.modeling.derivative import derivative_of

t = dynamicsymbols._t
x, F, base = dynamicsymbols("x F base")
m, k, c = sm.symbols("m k c", positive=True)
VALUES = {"m": 2.0, "k": 800.0, "c": 0.0}  # ω = 20 rad/s
OMEGA = 20.0


@pytest.fixture(autouse=True)
def _cache(tmp_path_factory, monkeypatch):
    """Machine code of the tests is shared by them and forgotten with them."""
    monkeypatch.setenv("ENGDYN_CACHE", str(tmp_path_factory.getbasetemp() / "machine code"))


@cache
def oscillator():
    """m x″ + c x′ + k x = F on a base that moves."""
    return ed.lagrange(m * x.diff() ** 2 / 2, k * (x - base) ** 2 / 2, [x], c * x.diff() ** 2 / 2, {x: F})


@cache
def load(key):
    return ed.systems.load(key)


def swing(time, start=0.01, **inputs):
    return ed.simulate(oscillator(), ([start], [0.0]), time, VALUES, inputs)


def without_numba(monkeypatch):
    monkeypatch.setenv("ENGDYN_NUMBA", "0")


def by_scipy(eom, initial, times, values, inputs=None, rtol=1e-11):
    """The same by solve_ivp on accelerations that numpy solves for; inputs as a function of time."""
    n = len(eom.coordinates)
    speeds = [eom.coordinates.index(u.args[0]) for u in eom.speeds]
    assert speeds == list(range(n))

    def f(time, state):
        given = inputs(time) if inputs else None
        return np.append(state[n:], eom.accelerations(state[:n], state[n:], values, given, time))

    found = solve_ivp(
        f, (times[0], times[-1]), np.concatenate(initial), "DOP853", times, rtol=rtol, atol=1e-13
    )
    return found.y.T


# ---------------------------------------------------------------- the catalogue

CALIBRATION = {  # start (q, u), end time, end (q, rates)
    3: (([0.972691], [0]), 2, [0.7881778, -0.03372995]),
    7: (([0, 0.5], [0, 0]), 5, [2.393683, -0.09737666, 2.411327, -0.4411736]),
    13: (([0, 0.2], [0]), 0.5, [4.070277e-06, 5.096865e-05, 6.365324e-05, -0.0003828406]),
    14: (
        ([1.97525e-06, -8.60705e-06], [0, 0]),
        0.05,
        [-2.550287e-05, -4.014369e-05, -0.002549125, -0.006609374],
    ),
    23: (
        ([-0.165518, 0.034628, -0.025851, -0.0193311], [0] * 4),
        1,
        [
            -0.1990927,
            -0.002206845,
            -0.02272479,
            -0.01958278,
            -0.008137029,
            -0.01067978,
            -0.00996152,
            0.001736252,
        ],
    ),
}


@pytest.mark.parametrize("number", CALIBRATION)
def test_known_end_states(number):
    initial, end, expected = CALIBRATION[number]
    system = load(number)
    history = system.simulate(initial, [0, end], rtol=1e-10, atol=1e-14)
    found = [*history.q[-1], *(history[f"{name}'"][-1] for name in history.names)]
    # Starts are given to six digits: so are the ends, measured by the motion.
    size = np.max(
        np.abs(np.hstack([history.q, np.column_stack([history[f"{n}'"] for n in history.names])])), axis=0
    )
    np.testing.assert_allclose(found, expected, rtol=1e-5, atol=1e-6 * size.max() if number == 23 else 1e-9)


SPAN = {1: 0.5, 2: 0.1, 10: 0.3, 12: 0.6, 14: 0.05, 19: 0.4, 20: 0.5, 22: 3000.0}


@pytest.mark.parametrize("number", range(1, 24))
def test_both_derivations_two_tolerances_and_the_balance_of_energy(number):
    system = load(number)
    n, rates = len(system.coordinates), len(system.equations.speeds)
    slow = 1e-4 if number in (14, 22) else 0.1
    q = np.array(system.pose if system.pose else [0.1] * n)
    initial, times = (q, [slow] * rates), np.linspace(0, SPAN.get(number, 1.0), 11)
    fine, coarse = (
        system.simulate(initial, times, rtol=tolerance, atol=1e-14) for tolerance in (1e-12, 1e-10)
    )
    newton = ed.simulate(system.newton(), initial, times, system.values(), rtol=1e-12, atol=1e-14)
    size = np.max(np.abs(fine.q), axis=0) + 1e-9
    assert np.max(np.abs(coarse.q - fine.q) / size) < 1e-8
    assert np.max(np.abs(newton.q - fine.q) / size) < 1e-8
    assert fine.audit.error < 1e-8
    if rates == n:
        oracle = by_scipy(system.newton(), initial, times, system.values())
        assert np.max(np.abs(oracle[:, :n] - fine.q) / size) < 1e-8


def test_a_rolling_condition_is_kept():
    system = load(13)
    history = system.simulate(([0, 0.2], [0.0]), np.linspace(0, 0.5, 20_001), {"v": 20.0}, rtol=1e-11)
    psi, values = history["psi"], history.values
    across = history["y'"] * np.cos(psi) - values["v"] * np.sin(psi)
    turned = cumulative_simpson(across / values["a"], x=history.time, initial=0.0)
    assert np.max(np.abs(psi)) > 0.2, "it shimmies"
    assert np.max(np.abs(psi - psi[0] - turned)) < 1e-8
    assert np.max(np.abs(history["psi'"] - across / values["a"])) < 1e-10


# ---------------------------------------------------------------- with and without numba, other methods


@pytest.mark.parametrize("way", ["variable", "absent"])
def test_without_numba_all_is_the_same(way, monkeypatch):
    record = ed.Record(np.sin(np.arange(60) / 5), 50, "F", "N")
    times = np.linspace(0, 1, 7)
    questions = [{}, {"F": 30.0, "base": 0.001 * sm.sin(30 * t)}, {"F": record, "base": (0.01, 0.0, 0.0)}]
    compiled = [swing(times, **inputs) for inputs in questions]
    if way == "variable":
        without_numba(monkeypatch)
    else:
        monkeypatch.setitem(sys.modules, "numba", None)
    assert not codegen.has_numba()
    for inputs, expected in zip(questions, compiled, strict=True):
        found = swing(times, **inputs)
        np.testing.assert_allclose(found.q, expected.q, rtol=0, atol=1e-9)
        assert abs(len(found.steps) - len(expected.steps)) <= 2
    many = ed.ensemble(oscillator(), ([[0.01], [0.02]], [0.0]), times, VALUES)
    np.testing.assert_allclose(many.q[0], compiled[0].q, atol=1e-9)


def test_machine_code_is_kept_in_a_file_that_is_never_run(tmp_path, monkeypatch):
    pytest.importorskip("numba")
    from engdyn.analysis.dop853 import SIGNATURE

    monkeypatch.setenv("ENGDYN_CACHE", str(tmp_path / "made"))
    text = "def generated(t, x, p, out):\n    out[0] = 2.0*x[0]\n"
    first = codegen.machine_code(text, SIGNATURE)
    (file,) = (tmp_path / "made").glob("*.py")
    assert file.read_text() == text
    assert codegen.machine_code(text, SIGNATURE).stats.cache_hits
    file.write_text(f"from pathlib import Path\nPath({str(tmp_path / 'run')!r}).touch()\n" + text)
    again = codegen.machine_code(text, SIGNATURE)
    for function in (first, again):
        out = np.zeros(1)
        function(0.0, np.array([3.0]), np.zeros(1), out)
        assert out[0] == 6.0
    assert file.read_text() == text
    assert not (tmp_path / "run").exists()


def test_where_nothing_can_be_written_nothing_is_kept(tmp_path, monkeypatch):
    pytest.importorskip("numba")
    (tmp_path / "file").touch()
    monkeypatch.setenv("ENGDYN_CACHE", str(tmp_path / "file" / "folder"))
    eom = ed.lagrange(m * x.diff() ** 2 / 2, k * x**4, [x])
    found = ed.simulate(eom, ([0.1], [0.0]), [0, 1], VALUES)
    assert found.audit.error < 1e-6


@pytest.mark.parametrize("method", ["radau", "bdf", "lsoda"])
def test_methods_for_stiff_equations(method):
    values = {"m": 1.0, "k": 1e5, "c": 1e5}  # poles at -1 and -1e5 1/s
    explicit, stiff = (
        ed.simulate(oscillator(), ([0.01], [0.0]), [0, 0.5, 1], values, {}, way, rtol=1e-6, atol=1e-9)
        for way in ("dop853", method)
    )
    np.testing.assert_allclose(stiff.q, explicit.q, rtol=1e-4)
    assert len(stiff.steps) < len(explicit.steps) / 20
    assert stiff.method == method


def test_large_and_unsymmetric_mass_matrices():
    chain = dynamicsymbols("s1:13")
    kinetic = sum((a.diff() + b.diff()) ** 2 for a, b in zip(chain, (*chain[1:], chain[0]), strict=True))
    kinetic += sum((i + 1) * s.diff() ** 2 for i, s in enumerate(chain))
    large = ed.lagrange(m * kinetic, k * sum(s**2 + s**4 for s in chain), list(chain))
    y = dynamicsymbols("y")
    mixed = [
        x.diff(t, 2) + 2 * y.diff(t, 2) + k * y,
        x.diff(t, 2) * sm.cos(y) - k * x,
    ]  # zero on the diagonal
    unsymmetric = ed.EquationsOfMotion.from_residuals(mixed[::-1], [x, y])
    random = np.random.default_rng(5)
    for eom in (large, unsymmetric, load(22).equations, load(19).equations):
        n = len(eom.coordinates)
        values = {p.name: random.uniform(1, 2) for p in eom.parameters}
        state = random.uniform(-0.5, 0.5, 2 * n)
        expected = eom.accelerations(state[:n], state[n:], values)
        np.testing.assert_allclose(eom.function(values)(0.0, state)[n:], expected, rtol=1e-9)
        if codegen.has_numba():
            from engdyn.analysis.dop853 import SIGNATURE

            code, out = derivative_of(eom), np.zeros(2 * n)
            p = np.zeros(len(code.slots))
            p[: len(eom.parameters)] = [values[s.name] for s in eom.parameters]
            for i, w in enumerate(eom.inputs):
                if w in eom.defaults:  # a drive angle at t = 0
                    p[len(eom.parameters) + 3 * i + 1] = values["Omega"]
            code.machine(SIGNATURE)(0.0, state, p, out)
            np.testing.assert_allclose(out[n:], expected, rtol=1e-9)


def test_the_function_of_equations_forgets_the_inputs_of_the_call_before():
    f, state = oscillator().function(VALUES), [0.01, 0.5]
    free = f(0.0, state)
    np.testing.assert_allclose(free, [0.5, -4.0])
    np.testing.assert_allclose(f(0.0, state, {"F": 8.0}), [0.5, 0.0], atol=1e-15)
    np.testing.assert_array_equal(f(0.0, state), free)
    feeder = load(19)  # its drive angle goes on by itself
    g, rest = feeder.equations.function(feeder.values()), np.zeros(6)
    assert not np.allclose(g(0.0, rest), g(0.01, rest))
    np.testing.assert_array_equal(g(0.01, rest), g(0.01, rest, {}))


def test_long_projected_equations_are_projected_as_numbers(monkeypatch):
    castor = load(13)
    question = ([0, 0.2], [0.0]), np.linspace(0, 0.05, 5)
    direct = castor.simulate(*question)
    monkeypatch.setattr(derivative, "LONG", 0)
    again = ed.simulate(castor.lagrange(), *question, castor.values())
    assert not again.plan.derivative.direct
    np.testing.assert_allclose(again.q, direct.q, atol=1e-9)


# ---------------------------------------------------------------- inputs


def test_all_ways_to_give_a_force():
    times = np.linspace(0, 2, 41)
    at = np.arange(0, 2.0005, 5e-4)
    reference = swing(times, F=40 * sm.sin(7 * t))
    exact = 40 / (2 * (OMEGA**2 - 49)) * (np.sin(7 * times) - 7 / OMEGA * np.sin(OMEGA * times))
    np.testing.assert_allclose(reference.q[:, 0], exact + 0.01 * np.cos(OMEGA * times), atol=1e-7)
    for F in (lambda time: 40 * math.sin(7 * time), ed.Record(40 * np.sin(7 * at), 2000, "F", "N")):
        np.testing.assert_allclose(swing(times, F=F).q, reference.q, atol=1e-7)
    np.testing.assert_array_equal(reference["F"], 40 * np.sin(7 * times))
    scaled = ed.simulate(
        oscillator(), ([0.01], [0]), times, VALUES | {"A": 40.0}, {"F": sm.Symbol("A") * sm.sin(7 * t)}
    )
    np.testing.assert_array_equal(scaled.q, reference.q)
    constant = ed.simulate(oscillator(), ([0.01], [0]), times, VALUES | {"A": 40.0}, {"F": sm.Symbol("A")})
    np.testing.assert_allclose(constant.q, swing(times, F=40.0).q, atol=1e-12)
    sampled = swing(times, F=[40.0] * len(times))
    np.testing.assert_allclose(constant.q, sampled.q, atol=1e-9)
    np.testing.assert_allclose(
        swing([0, 1, 2], F=np.full(3, 40.0)).q[:, 0], constant.q[[0, 20, 40], 0], atol=1e-9
    )
    np.testing.assert_allclose(
        swing([0, 1, 2, 3], base=np.array([0.05, 0, 0])).q[1], constant.q[20], atol=1e-9
    )


def test_an_array_is_linear_between_the_times():
    times, force = np.array([0.0, 0.3, 0.35, 1.0]), np.array([0.0, 50.0, -20.0, -20.0])
    found = swing(times, 0.0, F=force)
    state = np.zeros(2)  # exact, piece by piece: x = a + b s and a free vibration
    for i, (h, slope) in enumerate(zip(np.diff(times), np.diff(force) / np.diff(times), strict=True)):
        a, b = force[i] / 800, slope / 800
        free = state - [a, b]
        turn = np.array(
            [[math.cos(20 * h), math.sin(20 * h) / 20], [-20 * math.sin(20 * h), math.cos(20 * h)]]
        )
        state = turn @ free + [a + b * h, b]
        np.testing.assert_allclose([found.q[i + 1, 0], found.u[i + 1, 0]], state, atol=1e-8)
    assert set(times) <= set(found.steps)


def test_all_ways_to_prescribe_a_motion():
    times = np.linspace(0, 1, 21)
    motion = 0.02 * sm.sin(9 * t)
    expected = load(2).simulate(([0.012], [0]), times, inputs={"yb": motion})
    functions = [sm.lambdify(t, e, "math") for e in (motion, motion.diff(t), motion.diff(t, 2))]
    at = np.arange(-5, 106) / 100  # splines are less accurate at their ends
    record = ed.Record(0.02 * np.sin(9 * at), 100, "yb", "m", start=-0.05)
    for given, tolerance in ((tuple(functions), 1e-8), (record, 1e-6), ((motion, *functions[1:]), 1e-8)):
        found = load(2).simulate(([0.012], [0]), times, inputs={"yb": given})
        np.testing.assert_allclose(found.q, expected.q, atol=tolerance)
        np.testing.assert_allclose(found["yb''"], -81 * expected["yb"], atol=1e-2)
    oracle = by_scipy(
        load(2).equations,
        ([0.012], [0]),
        times,
        load(2).values(),
        lambda s: {"yb": [f(s) for f in functions]},
    )
    np.testing.assert_allclose(expected.q[:, 0], oracle[:, 0], atol=1e-8)


@pytest.mark.parametrize(("unit", "size"), [("mm", 1e-3), ("-", 1.0), ("m", 1.0), ("ft", 0.3048)])
def test_a_record_is_taken_in_its_own_unit(unit, size):
    at = np.arange(-5, 106) / 100
    motion = 0.02 * np.sin(9 * at)
    found, expected = (
        swing(np.linspace(0, 1, 11), base=ed.Record(samples, 100, "base", u, start=-0.05))
        for samples, u in ((motion / size, unit), (motion, "m"))
    )
    np.testing.assert_allclose(found.q, expected.q, atol=1e-12)
    np.testing.assert_allclose(found["base"], 0.02 * np.sin(9 * found.time), atol=1e-4)


def test_a_run_up_needs_the_integral_of_the_speed_as_its_angle():
    """Pitfall 24: sin(Ω(t)·t) turns twice as fast as Ω says; and φ″ exerts forces of its own."""
    feeder, rate = load(19), 40.0
    times = np.linspace(0, 1, 201)
    question = ([0] * 3, [0] * 3), times
    right = feeder.simulate(*question, inputs={"drive": rate * t**2 / 2})
    wrong = feeder.simulate(*question, inputs={"drive": (rate * t) * t})
    np.testing.assert_allclose(right["drive'"], rate * times, atol=1e-12)
    turns = np.unwrap(np.angle(np.exp(1j * right["drive"])))
    np.testing.assert_allclose(np.gradient(turns, times)[1:-1], rate * times[1:-1], rtol=1e-6)
    np.testing.assert_allclose(wrong["drive'"], 2 * right["drive'"], atol=1e-12)
    assert np.max(np.abs(wrong.q - right.q)) > 0.3 * np.max(np.abs(right.q))
    forgotten = feeder.simulate(*question, inputs={"drive": (rate * t**2 / 2, rate * t, 0.0)})
    assert np.max(np.abs(forgotten.q - right.q)) > 1e-6

    def inputs(s):
        return {"drive": (rate * s**2 / 2, rate * s, rate)}

    oracle = by_scipy(feeder.newton(), question[0], times, feeder.values(), inputs)
    np.testing.assert_allclose(right.q, oracle[:, :3], atol=1e-8)
    assert right.audit.error < 1e-6


@pytest.mark.parametrize("number", [3, 14, 17, 19])
def test_drive_angles_turn_at_constant_speed_unless_told_otherwise(number):
    system = load(number)
    n = len(system.coordinates)
    question = ([1e-5] * n, [0] * n), [0, 0.02, 0.05]
    by_default = system.simulate(*question)
    given = system.simulate(*question, inputs={"drive": system.values()["Omega"] * t})
    np.testing.assert_allclose(given.q, by_default.q, rtol=1e-9, atol=1e-15)
    faster = system.simulate(*question, inputs={"drive": system.values()["Omega"] * (t + t**2)})
    assert not np.allclose(faster.q, by_default.q, rtol=1e-6, atol=0)


# ---------------------------------------------------------------- jumps and pulses (pitfall 29)

STEP = 16.0  # static deflection 0.02 m


@pytest.mark.parametrize(
    "force",
    [lambda time: STEP if time > 0.4321 else 0.0, STEP * sm.Heaviside(t - sm.Rational(4321, 10000))],
    ids=["function", "expression"],
)
def test_a_step_is_met_exactly(force):
    times = np.array([0, 0.4321, 0.5, 0.9])
    found = swing(times, 0.0, F=force)
    late = np.maximum(times - 0.4321, 0)
    np.testing.assert_allclose(found.q[:, 0], 0.02 * (1 - np.cos(OMEGA * late)), atol=1e-9)
    assert found.rejected <= 8


PULSE = 0.01


def half_sine(time):
    return 100.0 * math.sin(math.pi * (time - 30.0) / PULSE) if 30.0 < time < 30.0 + PULSE else 0.0


PHASE = sm.pi * (t - 30) / sm.Rational(1, 100)
WINDOW = sm.Heaviside(t - 30) - sm.Heaviside(t - 30 - sm.Rational(1, 100))


@pytest.mark.parametrize("force", [half_sine, 100 * sm.sin(PHASE) * WINDOW], ids=["function", "expression"])
def test_a_pulse_after_a_long_rest_is_not_missed(force):
    found = ed.simulate(oscillator(), ([0.0], [0.0]), [0, 31.0], VALUES, {"F": force}, max_step=PULSE)
    momentum = solve_ivp(
        lambda s, y: [half_sine(s) * math.cos(OMEGA * (31.0 - s))], (30, 30.01), [0], rtol=1e-11
    )
    assert found.u[-1, 0] == pytest.approx(momentum.y[0, -1] / 2.0, rel=1e-6)

    def naive(time, state):
        return [state[1], -400 * state[0] + half_sine(time) / 2]

    missed = solve_ivp(naive, (0, 31), [0, 0], "DOP853", rtol=1e-8, atol=1e-10)
    assert not missed.y.any(), "what a solver does that is not told"


def test_a_longer_pulse_is_found_without_being_told():
    def push(time):
        return 100.0 if 30.0 <= time < 30.05 else 0.0

    found = swing([0, 30, 30.05, 31], 0.0, F=push)
    x = 0.125 * (1 - math.cos(OMEGA * 0.05))
    assert found.q[2, 0] == pytest.approx(x, rel=1e-7)
    assert found.q[1, 0] == 0.0
    smooth = swing([0, 40], 0.0, F=50 * sm.exp(-(((t - 30) / sm.Rational(3, 100)) ** 2)))
    force = 50 * 0.03 * math.sqrt(math.pi) * math.exp(-((OMEGA * 0.03) ** 2) / 4)  # of its spectrum at ω
    assert np.hypot(OMEGA * smooth.q[-1, 0], smooth.u[-1, 0]) == pytest.approx(force / 2, rel=1e-5)


def test_the_smallest_pulse_that_snaps_the_switch():
    """S02 on a base with half-sine acceleration of 20 ms, from its upper well: 89.99 m/s², and 150 is too much."""
    switch, length = load(2), 0.02
    (upper,) = [e.q for e in switch.equilibria() if e.q[0] > 0.005]

    def end(size):
        motion = (0.0, 0.0, lambda s: size * math.sin(math.pi * s / length) if 0 < s < length else 0.0)
        return switch.simulate((upper, [0.0]), [0, 0.3], inputs={"yb": motion}).q[-1, 0]

    assert end(89.97) > 0 > end(90.0)
    assert end(150.0) > 0


# ---------------------------------------------------------------- steps and output


def test_steps_do_not_depend_on_the_times_asked_for():
    few, many = swing([0, 3]), swing(np.linspace(0, 3, 2001))
    np.testing.assert_array_equal(few.steps, many.steps)
    np.testing.assert_array_equal(few.q[-1], many.q[-1])
    np.testing.assert_allclose(many.q[:, 0], 0.01 * np.cos(OMEGA * many.time), atol=1e-8)
    assert len(few.steps) < 120


def test_equal_calls_give_equal_bits():
    runs = [load(8).simulate(([1.0, 0.5], [0, 0]), np.linspace(0, 20, 11)) for _ in range(2)]
    np.testing.assert_array_equal(runs[0].q, runs[1].q)
    np.testing.assert_array_equal(runs[0].u, runs[1].u)


def test_a_longest_step_is_kept():
    assert (
        np.max(np.diff(ed.simulate(oscillator(), ([0], [0]), [0, 1], VALUES, max_step=0.01).steps)) < 0.0101
    )


def test_the_error_falls_with_the_tolerance():
    times = np.linspace(0, 5, 11)
    errors = [
        np.max(np.abs(ed.simulate(oscillator(), ([0.01], [0]), times, VALUES, rtol=r, atol=r * 1e-3).q[:, 0]
                      - 0.01 * np.cos(OMEGA * times)))
        for r in (1e-6, 1e-9, 1e-12)
    ]  # fmt: skip
    assert errors[0] > 50 * errors[1] > 2500 * errors[2]


# ---------------------------------------------------------------- events


@pytest.mark.parametrize("numba", [True, False])
def test_events_are_roots_between_the_steps(numba, monkeypatch):
    if not numba:
        without_numba(monkeypatch)

    def falls(time, q, u):
        return q[0]

    falls.direction = -1
    history = ed.simulate(
        oscillator(),
        ([0.01], [0.0]),
        [0, 1],
        VALUES,
        events=[x, ed.Event(x, 1, name="rises"), falls, x.diff()],
    )
    zeros = (np.arange(6) + 0.5) * np.pi / OMEGA
    through, rises, downward, turns = history.events
    np.testing.assert_allclose(through.time, zeros, atol=1e-8)
    np.testing.assert_allclose(rises.time, zeros[1::2], atol=1e-8)
    np.testing.assert_allclose(downward.time, zeros[0::2], atol=1e-8)
    np.testing.assert_allclose(turns.time[-6:], np.arange(1, 7) * np.pi / OMEGA, atol=1e-8)
    np.testing.assert_allclose(through.q, 0, atol=1e-15)
    np.testing.assert_allclose(np.abs(through.u), 0.2, atol=1e-7)
    assert [e.name for e in history.events] == ["x", "rises", "falls", "Derivative(x, t)"]
    assert repr(rises) == "Occurrences(rises: at 0.23562, 0.54978, 0.86394 s)"


def test_a_terminal_event_ends_the_history_before_anything_worse_happens():
    away = ed.lagrange(m * x.diff() ** 2 / 2, -k * x**4, [x])  # x″ = 4 k x³/m runs away
    question = ([0.1], [0.0]), np.linspace(0, 9, 91), VALUES
    history = ed.simulate(
        away, *question, events=[ed.Event(x - 1, 1, terminal=True), x - 2, x - sm.Rational(1, 2)]
    )
    stop, beyond, half = history.events
    assert history.time[-1] == stop.time[0]
    assert history.q[-1, 0] == pytest.approx(1, abs=1e-9)
    assert history.u[-1, 0] ** 2 == pytest.approx(2 * 800 / 2.0 * (1 - 1e-4), rel=1e-8)  # energy
    assert (len(beyond.time), len(half.time)) == (0, 1)
    assert history.steps[-1] == history.time[-1]
    with pytest.raises(ed.EngdynError, match=r"ends at t = 0.\d+ s with .* the motion runs away"):
        ed.simulate(away, *question)


def test_an_event_that_is_undone_within_a_step_is_seen():
    free = ed.lagrange(m * x.diff() ** 2 / 2, k * x, [x])  # a throw: steps as long as they may be
    history = ed.simulate(
        free, ([0.0], [10.0]), [0, 0.1], {"m": 1.0, "k": 200.0}, events=x - sm.Rational(249, 1000)
    )
    assert len(history.steps) < 12
    np.testing.assert_allclose(
        history.events[0].time, 0.05 + np.array([-1, 1]) * math.sqrt(2 * 0.001 / 200), atol=1e-9
    )


# ---------------------------------------------------------------- interruption and progress


@pytest.mark.parametrize("numba", [True, False])
def test_an_interrupted_run_keeps_what_was_computed(numba, monkeypatch):
    if not numba:
        without_numba(monkeypatch)

    def stop(time, q, u):
        if time > 5.0:
            raise KeyboardInterrupt
        return 1.0

    times = np.linspace(0, 400, 4001)
    with pytest.warns(ed.EngdynWarning, match="the history ends at t = .* instead of 400 s"):
        history = ed.simulate(oscillator(), ([0.01], [0.0]), times, VALUES, events=stop)
    assert 1 < history.time[-1] < 400
    np.testing.assert_allclose(history.q[:, 0], 0.01 * np.cos(OMEGA * history.time), atol=1e-6)


def test_progress_is_told_to_people_only(monkeypatch, capsys):
    for environment, talks in (({"ENGDYN_PROGRESS": "0"}, False), ({}, True)):
        with monkeypatch.context() as patch:
            patch.delenv("PYTEST_CURRENT_TEST", raising=False)
            patch.setattr(progress, "PATIENCE", 0.0)
            patch.setattr(sys.stderr, "isatty", lambda: True, raising=False)
            for name, value in environment.items():
                patch.setenv(name, value)
            teller = progress.Progress("simulating")
            teller.tell(0.34)
            teller.close()
        assert ("simulating: 34 %" in capsys.readouterr().err) == talks
    silent = progress.Progress("simulating")
    silent.tell(0.5)
    assert capsys.readouterr().err == ""


# ---------------------------------------------------------------- ensembles


def test_members_of_an_ensemble_are_single_simulations():
    system, times = load(8), np.linspace(0, 2, 9)
    random = np.random.default_rng(2)
    q, u = random.uniform(-1, 1, (6, 2)), random.uniform(-1, 1, (6, 2))
    values = system.values()
    name = next(iter(values))
    many = values | {name: values[name] * random.uniform(0.8, 1.2, 6)}
    found = ed.ensemble(system.equations, (q, u), times, many, {"M_h": 3 * sm.sin(5 * t)})
    assert (found.q.shape, found.u.shape, len(found)) == ((6, 9, 2), (6, 9, 2), 6)
    for i in range(6):
        own = values | {name: many[name][i]}
        alone = ed.simulate(system.equations, (q[i], u[i]), times, own, {"M_h": 3 * sm.sin(5 * t)})
        np.testing.assert_allclose(found.q[i], alone.q, rtol=1e-12, atol=1e-13)
    np.testing.assert_array_equal(found[found.names[1]], found.q[:, :, 1])
    record = ed.Record(np.linspace(0, 5, 21), 10, "M_h", "N m")
    pair = ed.ensemble(system.equations, (q[:2], [0, 0]), times, values, {"M_h": record})
    alone = ed.simulate(system.equations, (q[1], [0, 0]), times, values, {"M_h": record})
    np.testing.assert_allclose(pair.q[1], alone.q, rtol=1e-12, atol=1e-13)


def test_time_need_not_begin_at_zero():
    times = np.array([-3.0, -2.9, -2.5])
    force = 40 * sm.sin(7 * t)
    alone = ed.simulate(oscillator(), ([0.01], [0.0]), times, VALUES, {"F": force})
    many = ed.ensemble(oscillator(), ([[0.01]], [0.0]), times, VALUES, {"F": force})
    oracle = by_scipy(oscillator(), ([0.01], [0.0]), times, VALUES, lambda s: {"F": 40 * math.sin(7 * s)})
    np.testing.assert_allclose(alone.q, oracle[:, :1], atol=1e-9)
    np.testing.assert_allclose(many.q[0], alone.q, rtol=1e-12)


def test_an_ensemble_names_the_member_that_fails(monkeypatch):
    away = ed.lagrange(m * x.diff() ** 2 / 2, -k * x**4, [x])
    question = away, ([[0.0], [0.0], [0.5]], [0.0]), [0, 5], VALUES
    for _ in range(2):
        with pytest.raises(ed.EngdynError, match=r"member 2.*t = 0\.\d+ s"):
            ed.ensemble(*question)
        without_numba(monkeypatch)
    with pytest.raises(ed.EngdynError, match="rows of one length"):
        ed.ensemble(oscillator(), ([[0.0], [1.0]], [0.0]), [0, 1], VALUES | {"c": np.zeros(3)})
    with pytest.raises(ed.EngdynError, match="map parameter names"):
        ed.ensemble(oscillator(), ([0.0], [0.0]), [0, 1], VALUES | {"c": "much"})
    found = ed.ensemble(oscillator(), ([[0.0], [1.0]], [0.0]), [0, 1], VALUES)
    with pytest.raises(ed.EngdynError, match="'y'"):
        found["y"]


# ---------------------------------------------------------------- what cannot be simulated


@pytest.mark.parametrize("numba", [True, False])
@pytest.mark.parametrize(
    ("potential", "start", "message"),
    [
        (
            k * (1 - x) ** sm.Rational(3, 2),
            ([0.5], [1.0]),
            r"ends at t = 0\.\d+ s with \(q, u\) = \(.*without a value",
        ),
        (k / x, ([0.0], [0.0]), r"ends at t = 0 s with \(q, u\) = \(0, 0\)"),
        (-k * sm.exp(x), ([1.0], [0.0]), "ends at t = 0.0"),
    ],
)
def test_where_the_equations_end_the_simulation_says_when_and_where(
    potential, start, message, numba, monkeypatch
):
    if not numba:
        without_numba(monkeypatch)
    eom = ed.lagrange(m * x.diff() ** 2 / 2, potential, [x])
    with pytest.raises(ed.EngdynError, match=message):
        ed.simulate(eom, start, [0, 10], VALUES)


def test_a_motion_that_runs_away_in_a_stiff_method():
    away = ed.lagrange(m * x.diff() ** 2 / 2, -k * x**4, [x])
    for method in ("radau", "bdf", "lsoda"):
        with pytest.raises(ed.EngdynError, match="ends at t = 0"):
            ed.simulate(away, ([0.5], [0.0]), [0, 10], VALUES, method=method)


LONG = np.linspace(0, 1, 11)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"initial": ([0.0], [0.0, 0.0])}, r"initial u has shape \(2,\): give 1"),
        ({"initial": ([np.nan], [0.0])}, "initial q is"),
        ({"initial": [0.0]}, "pair"),
        ({"times": [0]}, "two or more"),
        ({"times": [1, 0]}, "larger than the one before"),
        ({"times": [0, np.inf]}, "finite"),
        ({"values": {"m": 1.0}}, "lacks the parameters c, k"),
        ({"method": "euler"}, "unknown method 'euler': choose one of dop853"),
        ({"rtol": 1e-18}, "rtol"),
        ({"max_step": 0}, "max_step"),
        ({"inputs": {"G": 1.0}}, "unknown input 'G'"),
        ({"inputs": {"F": "sin(t)"}}, "not text"),
        ({"inputs": {"F": np.nan}}, "finite"),
        ({"inputs": {"F": np.zeros(5)}}, "11 numbers for 11 times"),
        ({"inputs": {"F": np.full(11, np.nan)}}, "not finite"),
        ({"inputs": {"F": ed.Record(np.zeros(5), 10)}}, "known from 0 to 0.4 s"),
        ({"inputs": {"F": ed.Record(np.zeros((20, 2)), 10, ["a", "b"])}}, "one channel"),
        ({"inputs": {"F": ed.Record(np.zeros(20), 10, "F", "furlong?")}}, "'furlong.', which is no unit"),
        ({"inputs": {"F": [[1, 2], [3]]}}, "one number for each time"),
        ({"inputs": {"F": lambda time: 10**400}}, "gives no number at t = 0 s"),
        ({"eom": "crane"}, "give EquationsOfMotion"),
        ({"initial": ([10**400], [0.0])}, "pair"),
        ({"initial": ([[0.0], [1.0]], [0.0])}, "ensemble takes many"),
        ({"inputs": {"F": sm.Symbol("A") * t}}, "contains A"),
        ({"inputs": {"F": x * 2}}, "depends on the state"),
        ({"inputs": {"F": sm.Piecewise((0, t < 1), (1, True))}}, "Heaviside, "),
        ({"inputs": {"F": lambda time: "much"}}, "gives no number at t = 0 s"),
        ({"inputs": {"F": lambda time: 1 / (time - 0.5) if time != 0.5 else np.inf}}, "inf at t = 0.5 s"),
        ({"inputs": {"F": (1.0, 2.0)}}, "2 entries"),
        ({"events": [3.0]}, "neither a sympy expression nor a function"),
        ({"events": sm.Symbol("A") - x}, "contains A"),
    ],
)
def test_questions_that_do_not_fit(change, message):
    question = {"initial": ([0.0], [0.0]), "times": LONG, "values": VALUES} | change
    with pytest.raises(ed.EngdynError, match=message):
        ed.simulate(**({"eom": oscillator()} | question))


def test_a_motion_that_acts_by_its_rate_needs_its_rate():
    with pytest.raises(ed.EngdynError, match="acts by its acceleration, too: give three functions"):
        load(2).simulate(([0.0], [0.0]), [0, 1], inputs={"yb": math.sin})
    with pytest.raises(ed.EngdynError, match="6 or more"):
        load(2).simulate(([0.0], [0.0]), [0, 0.5], inputs={"yb": ed.Record(np.zeros(4), 4)})
    with pytest.raises(ed.EngdynError, match="direction"):
        ed.Event(x, 2)
    with pytest.raises(ed.EngdynError, match="unknown input 'xb': did you mean 'yb'"):
        load(2).simulate(([0.0], [0.0]), [0, 1], inputs={"xb": 1.0})
