"""The schemes of chapter 8: orders, stability, tables, and what becomes of wrong variants (pitfalls 27, 28)."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.special import ellipj, ellipk

import engdyn as ed
from engdyn.analysis.integrators import SCHEMES

G_OVER_L = 9.81 / 0.8
START = np.array([1.2, 0.0])


def pendulum(t, x):
    """W10."""
    return np.array([x[1], -G_OVER_L * math.sin(x[0])])


def exact_angle(t):
    """θ(t) of W10 from rest at 1.2 rad, by elliptic functions."""
    k = math.sin(START[0] / 2)
    quarter = ellipk(k**2)
    return 2 * math.asin(k * ellipj(quarter - math.sqrt(G_OVER_L) * t, k**2)[0])


def oscillator(omega=1.0, zeta=0.0):
    return lambda t, x: np.array([x[1], -(omega**2) * x[0] - 2 * zeta * omega * x[1]])


# ---------------------------------------------------------------- orders


@pytest.mark.parametrize(
    ("scheme", "order", "counts"),
    [
        ("euler", 1, (1000, 2000, 4000)),
        ("semi_implicit_euler", 1, (500, 1000, 2000)),
        ("midpoint", 2, (100, 200, 400)),
        ("heun", 2, (100, 200, 400)),
        ("central_difference", 2, (100, 200, 400)),
        ("rk4", 4, (40, 80, 160)),
    ],
)
def test_measured_orders(scheme, order, counts):
    found = ed.measure_order(pendulum, START, 1.3, scheme, counts)
    assert found.order == pytest.approx(order, abs=0.2)
    angle = exact_angle(1.3)
    assert angle == pytest.approx(-0.659798077, abs=1e-9)
    place = ed.measure_order(pendulum, START, 1.3, scheme, counts, [angle, 0.0], observe=0)
    assert place.order == pytest.approx(order, abs=0.2)
    assert np.all(np.diff(place.error) < 0)


def test_central_differences_of_the_pendulum_with_and_without_their_start():
    errors = []
    for h in (0.05, 0.025):
        times = np.arange(round(1.3 / h) + 1) * h
        errors.append(ed.integrate(pendulum, START, times, "central_difference").x[-1, 0] - exact_angle(1.3))
    assert errors == pytest.approx([4.126e-3, 1.029e-3], abs=5e-7)

    def forgetting(count):  # x₋₁ = x₀ − h v₀
        h = 1.3 / count
        before, q = START[0], START[0]
        for _ in range(count):
            before, q = q, 2 * q - before - h**2 * G_OVER_L * math.sin(q)
        return abs(q - exact_angle(1.3))

    assert math.log2(forgetting(200) / forgetting(400)) == pytest.approx(1, abs=0.2)


def test_the_two_step_recursion_gives_the_same_places():
    h, count = 0.03, 200
    a0 = pendulum(0, START)[1]
    places = [START[0] + h**2 * a0 / 2, START[0]]  # x₋₁ with v₀ = 0
    for _ in range(count):
        places.append(2 * places[-1] - places[-2] + h**2 * pendulum(0, [places[-1], 0])[1])
    found = ed.integrate(pendulum, START, np.arange(count + 1) * h, "central_difference")
    np.testing.assert_allclose(found.x[:, 0], places[1:], atol=1e-11)
    inner = (found.x[2:, 0] - found.x[:-2, 0]) / (2 * h)
    np.testing.assert_allclose(found.x[1:-1, 1], inner, atol=1e-10)


def test_damping_is_not_felt_late_by_central_differences():
    zeta = 0.2
    decay = math.sqrt(1 - zeta**2)

    def exact(t):
        return math.exp(-zeta * t) * (math.cos(decay * t) + zeta / decay * math.sin(decay * t))

    damped = oscillator(1.0, zeta)
    order = ed.measure_order(
        damped, [1.0, 0.0], 5.0, "central_difference", (50, 100, 200), [exact(5.0), 0], 0
    )
    assert order.order == pytest.approx(2, abs=0.1)
    assert ed.stability_limit("central_difference", zeta) == pytest.approx(2, abs=1e-3)

    def lagging(z):  # the damping force of half a step before: the limit falls to √(1 + ζ²) − ζ, times two
        step = np.array([[2 - z**2 - 2 * zeta * z, -1 + 2 * zeta * z], [1, 0]])
        return np.max(np.abs(np.linalg.eigvals(step)))

    limit = 2 * (math.sqrt(1 + zeta**2) - zeta)
    assert lagging(0.999 * limit) <= 1 < lagging(1.001 * limit)


# ---------------------------------------------------------------- stability


def test_growth_of_euler():
    for z in (0.01, 0.3, 1.0, 2.5):
        assert ed.growth_factor("euler", z) == pytest.approx(math.sqrt(1 + z**2), abs=1e-12)
        for scheme in ("midpoint", "heun"):
            assert ed.growth_factor(scheme, z) == pytest.approx(math.sqrt(1 + z**4 / 4), abs=1e-12)
    times = np.arange(101) * 0.1
    grown = ed.integrate(oscillator(), [1.0, 0.0], times, "euler").x[-1]
    assert np.linalg.norm(grown) == pytest.approx((1 + 0.01) ** 50, rel=1e-12)


def test_bounded_just_below_the_limit_and_divergent_just_above():
    for scheme in ("central_difference", "semi_implicit_euler"):
        size = {
            z: np.max(np.abs(ed.integrate(oscillator(), [1.0, 0.0], np.arange(2001) * z, scheme).x[:, 0]))
            for z in (1.99, 2.01)
        }
        assert size[1.99] < 20
        assert size[2.01] > 1e10
        assert ed.stability_limit(scheme) == pytest.approx(2, abs=1e-4)


@pytest.mark.parametrize(
    ("scheme", "limit"), [("euler", 0.0), ("midpoint", 0.0), ("heun", 0.0), ("rk4", 2 * math.sqrt(2))]
)
def test_stability_limits(scheme, limit):
    assert ed.stability_limit(scheme) == pytest.approx(limit, abs=1e-3)


def test_euler_is_stable_with_enough_damping():
    zeta = 0.3  # |1 + h(−ζ ± i√(1−ζ²))| = 1 at h = 2ζ
    assert ed.stability_limit("euler", zeta) == pytest.approx(2 * zeta, abs=1e-6)


def test_periods_of_central_differences_are_short():
    z = 0.1
    step = np.column_stack([SCHEMES["central_difference"](oscillator(), 0.0, e, z) for e in np.eye(2)])
    angle = abs(np.angle(np.linalg.eigvals(step)[0]))
    assert z / angle - 1 == pytest.approx(-(z**2) / 24, rel=0.01)


# ---------------------------------------------------------------- tables and the adaptive pair


def test_table_8_1():
    table = ed.step_table(pendulum, START, np.arange(5) * 0.05, "euler", ["theta", "omega"])
    assert list(table.columns) == ["t", "theta", "omega", "theta'", "omega'"]
    assert table["theta"].tolist() == pytest.approx([1.2, 1.2, 1.171427, 1.114282, 1.028892], abs=5e-7)
    assert table["omega"].tolist() == pytest.approx([0, -0.571456, -1.142913, -1.707789, -2.258126], abs=5e-7)
    assert table["omega'"].tolist() == pytest.approx([-G_OVER_L * math.sin(x) for x in table["theta"]])


def test_the_adaptive_pair_against_scipy():
    times = np.linspace(0, 5, 41)
    coarse, fine = (ed.integrate(pendulum, START, times, "rk45", rtol=r, atol=r) for r in (1e-6, 1e-10))
    reference = solve_ivp(pendulum, (0, 5), START, "DOP853", times, rtol=1e-12, atol=1e-13).y.T
    errors = [np.max(np.abs(run.x - reference)) for run in (coarse, fine)]
    assert 1e-9 < errors[0] < 1e-4
    assert errors[1] < 1e-8
    assert len(fine.steps) > 4 * len(coarse.steps)
    more = ed.integrate(pendulum, START, np.linspace(0, 5, 1001), "rk45")
    np.testing.assert_array_equal(more.steps, ed.integrate(pendulum, START, [0, 5], "rk45").steps)


def test_the_adaptive_pair_shortens_its_steps_where_things_happen_fast():
    def snap(t, x):  # a bistable spring, hit hard
        return np.array([x[1], 500 * x[0] - 5e4 * x[0] ** 3 - 0.5 * x[1]])

    run = ed.integrate(snap, [1e-6, 0.0], [0.0, 3.0], "rk45")
    assert run.rejected > 0
    steps = np.diff(run.steps)
    assert steps.max() > 5 * steps.min()
    assert run.evaluations == 6 * (len(steps) + run.rejected) + 1


# ---------------------------------------------------------------- errors


@pytest.mark.parametrize("scheme", [*SCHEMES, "rk45"])
def test_a_motion_that_runs_away_is_reported_with_time_and_state(scheme):
    def away(t, x):  # x = 1/(1 − t)
        return np.array([x[0] ** 2 * np.exp(x[0] / 50), x[1] ** 2 * np.exp(x[1] / 50)])

    with pytest.raises(ed.EngdynError, match=r"finite numbers at t = \d|iteration"):
        ed.integrate(away, [1.0, 1.0], np.linspace(0, 30, 301), scheme)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"scheme": "leapfrog"}, "unknown scheme 'leapfrog'"),
        ({"times": [0, 1, 1]}, "larger than the one before"),
        ({"times": [0, np.nan]}, "finite"),
        ({"times": [0]}, "two or more"),
        ({"x0": [1, np.inf]}, "finite"),
        ({"x0": "ab"}, "arrays of numbers"),
        ({"x0": [1, 2, 3], "scheme": "central_difference"}, "even number"),
        ({"f": lambda t, x: [1.0]}, "shape"),
    ],
)
def test_what_cannot_be_integrated(change, message):
    question = {"f": pendulum, "x0": START, "times": [0, 0.1], "scheme": "euler"} | change
    with pytest.raises(ed.EngdynError, match=message):
        ed.integrate(**question)


def test_velocities_that_cannot_be_found_are_reported():
    with pytest.raises(ed.EngdynError, match="take a smaller step"):
        ed.integrate(
            lambda t, x: np.array([x[1], -500 * x[1]]), [0.0, 1.0], np.arange(9) * 0.1, "central_difference"
        )


def test_names_of_a_table_must_fit():
    with pytest.raises(ed.EngdynError, match="1 names for 2"):
        ed.step_table(pendulum, START, [0, 1], names=["theta"])


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"end": np.nan}, "end is nan"),
        ({"end": np.inf}, "end is inf"),
        ({"x0": []}, "row of finite numbers"),
        ({"f": lambda t, x: "x"}, "no array of numbers at t = 0 s"),
    ],
)
def test_orders_that_cannot_be_measured(change, message):
    with pytest.raises(ed.EngdynError, match=message):
        ed.measure_order(
            **({"f": pendulum, "x0": START, "end": 1.0, "scheme": "rk4", "counts": [4, 8]} | change)
        )


def test_limits_of_what_is_no_scheme_or_no_number():
    for ask in (ed.stability_limit, lambda scheme: ed.growth_factor(scheme, 1.0)):
        with pytest.raises(ed.EngdynError, match="unknown scheme 'rk5'"):
            ask("rk5")
    for ask in (lambda x: ed.stability_limit("rk4", x), lambda x: ed.growth_factor("rk4", x)):
        with pytest.raises(ed.EngdynError, match="must be finite numbers"):
            ask(np.nan)
