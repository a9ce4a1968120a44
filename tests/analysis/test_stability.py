"""Verdicts on stability: against numpy's roots, closed forms and Hurwitz; neutral eigenvalues; rounding."""

from __future__ import annotations

import math
from math import pi

import numpy as np
import pytest
import sympy as sm
from hypothesis import assume, given
from hypothesis import strategies as st
from scipy.optimize import brentq

import engdyn as ed
from analysis import small_systems as small
from engdyn.analysis.stability import verdict_of

STABLE, MARGINAL = "asymptotically stable", "marginal"
DIVERGENCE, FLUTTER = "unstable (divergence)", "unstable (flutter)"


def judged(case, at=None, values=None):
    return ed.stability(ed.linearize(case.eom, at or {}, case.values | (values or {})))


def at_equilibria(case, values=None, **options):
    answer = ed.equilibria(case.eom, case.values | (values or {}), case.bounds, **options)
    return [ed.stability(ed.linearize(case.eom, e)) for e in answer]


# ---------------------------------------------------------------- the four verdicts


def test_pendulum_hanging_upright_and_without_damping():
    case = small.pendulum()
    assert judged(case, {"theta": 0.0}).verdict == STABLE
    assert judged(case, {"theta": pi}).verdict == DIVERGENCE
    assert judged(case, {"theta": 0.0}, {"c": 0.0}).verdict == MARGINAL
    assert judged(case, {"theta": pi}, {"c": 0.0}).verdict == DIVERGENCE


@given(st.floats(0.1, 10), st.floats(-3, 3), st.floats(-10, 10).filter(lambda k: k == 0 or abs(k) > 1e-3))
def test_one_degree_of_freedom_by_the_signs_of_its_coefficients(m, c, k):
    """m ẍ + c ẋ + k x = 0, all cases of the textbook."""
    assume(c == 0 or abs(c) > 1e-3)
    x, mass, damping, stiffness = *small.coordinates("x"), *small.symbols("mass damping stiffness")
    eom = ed.EquationsOfMotion.from_residuals(
        [mass * x.diff(small.T, 2) + damping * x.diff(small.T) + stiffness * x], [x]
    )
    found = ed.stability(ed.linearize(eom, {}, {"mass": m, "damping": c, "stiffness": k}))
    roots = [r for r in np.roots([m, c, k]) if r != 0 or k != 0]
    if k == 0:  # free: one zero eigenvalue, two without damping
        expected = MARGINAL if c == 0 else (STABLE if c > 0 else DIVERGENCE)
        assert found.neutral == (1 if c else 2)
    elif k < 0:
        expected = DIVERGENCE
    elif c == 0:
        expected = MARGINAL
    elif c > 0:
        expected = STABLE
    else:
        oscillates = any(abs(r.imag) > 1e-6 * abs(r) for r in roots)
        assume(abs(c * c - 4 * m * k) > 1e-6)
        expected = FLUTTER if oscillates else DIVERGENCE
    assert found.verdict == expected


def test_published_verdicts_of_the_catalogue():
    expected = {
        3: [STABLE, DIVERGENCE, STABLE],
        7: [STABLE, DIVERGENCE],
        23: [STABLE],
    }
    for number, verdicts in expected.items():
        system = ed.systems.load(number)
        found = [ed.stability(ed.linearize(system.equations, e)) for e in system.equilibria()]
        assert [s.verdict for s in found] == verdicts
        assert [s.stable for s in found] == [v == STABLE for v in verdicts]


def follower_critical(damped):
    """The thrust at which the mast flutters: by Hurwitz' determinant; undamped, by the frequency equation."""
    v = small.follower_mast().values
    m_1, m_2, L, k, c = v["m_1"], v["m_2"], v["L"], v["k_1"], v["c_1"] * damped
    M = np.array([[(m_1 + m_2) * L**2, m_2 * L**2], [m_2 * L**2, m_2 * L**2]])
    C = c * np.array([[2.0, -1.0], [-1.0, 1.0]])

    def coefficients(P):
        K = np.array([[2 * k - P * L, P * L - k], [-k, k]])
        s = sm.Symbol("s")
        matrix = sm.Matrix(M) * s**2 + sm.Matrix(C) * s + sm.Matrix(K)
        return [float(x) for x in sm.Poly(matrix.det(method="berkowitz"), s).all_coeffs()]

    def margin(P):
        a4, a3, a2, a1, a0 = coefficients(P)
        return a1 * a2 * a3 - a4 * a1**2 - a0 * a3**2 if damped else a2**2 - 4 * a4 * a0

    return brentq(margin, 40.0, 90.0, xtol=1e-12)


@pytest.mark.parametrize(("damped", "published"), [(True, 58.61), (False, 83.43)])
def test_follower_force_flutters_above_its_critical_thrust(damped, published):
    """S11, and the destabilizing effect of damping."""
    case, critical = small.follower_mast(), follower_critical(damped)
    assert abs(critical - published) < 0.005
    damping = {} if damped else {"c_1": 0.0, "c_2": 0.0}
    below = judged(case, values={"P": critical - 1e-6, **damping})
    above = judged(case, values={"P": critical + 1e-6, **damping})
    assert below.verdict == (STABLE if damped else MARGINAL)
    assert above.verdict == FLUTTER


@pytest.mark.parametrize(("v", "verdict"), [(2.0, STABLE), (20.0, FLUTTER), (80.0, STABLE)])
def test_castor_shimmies_in_a_band_of_speeds(v, verdict):
    (found,) = at_equilibria(small.castor(), {"v": v})
    assert found.verdict == verdict
    assert found.neutral == 0
    assert len(found.eigenvalues) == 3


def test_unstable_in_one_way_and_in_another():
    """Of several unstable eigenvalues the one that grows fastest gives the name."""
    assert verdict_of(np.array([2.0, 1 + 3j, 1 - 3j])) == DIVERGENCE
    assert verdict_of(np.array([1.0, 2 + 3j, 2 - 3j])) == FLUTTER
    assert verdict_of(np.array([-1.0, -2 + 3j, -2 - 3j])) == STABLE
    assert verdict_of(np.array([-1.0, 3j, -3j])) == MARGINAL
    assert verdict_of(np.array([0.0, -1.0]), neutral=1) == STABLE
    assert verdict_of(np.array([0.0, 0.0]), neutral=2) == MARGINAL


# ---------------------------------------------------------------- neutral eigenvalues


def crane(**changes):
    system = ed.systems.load(7)
    return [
        ed.stability(ed.linearize(system.equations, e)) for e in system.equilibria(system.values(**changes))
    ]


def test_crane_has_one_zero_eigenvalue_with_damping_and_two_without():
    assert [s.neutral for s in crane()] == [1, 1]
    assert [s.neutral for s in crane(c_h=0)] == [1, 1]
    assert [s.neutral for s in crane(c_x=0)] == [2, 2]
    assert [s.neutral for s in crane(c_x=0, c_h=0)] == [2, 2]
    assert [s.verdict for s in crane(c_x=0)] == [STABLE, DIVERGENCE]
    assert [s.verdict for s in crane(c_x=0, c_h=0)] == [MARGINAL, DIVERGENCE]


def test_neutral_eigenvalues_of_a_steady_acceleration():
    system = ed.systems.load(7)
    found = [
        ed.stability(ed.linearize(system.equations, e))
        for e in system.equilibria(system.values(c_x=0), F=3700.0)
    ]
    assert [(s.verdict, s.neutral) for s in found] == [(STABLE, 2), (DIVERGENCE, 2)]


@pytest.mark.parametrize(
    ("case", "values", "options", "neutral"),
    [
        (small.turntable(), {}, {"rates": {"theta": 12.0}, "free": ["M"]}, 1),
        (small.turntable(), {"c_t": 0.0}, {"rates": {"theta": 12.0}}, 2),  # angular momentum is conserved
        (small.turntable(), {"c_t": 0.0, "c_s": 0.0}, {"rates": {"theta": 12.0}}, 2),
        (small.drum_robot(), {}, {"rates": {"x": 0.0}, "free": ["tau"]}, 1),
        (small.drum_robot(), {"c_a": 0.0}, {"rates": {"x": 0.0}, "free": ["tau"]}, 2),
        (small.drive_train(), {}, {}, 1),
        (small.drive_train(), {"rho": 0.0}, {}, 1),
        (small.drive_train(), {"rho": 0.0, "B": 0.0}, {}, 2),
        (small.drive_train(), {"rho": 0.0, "B": 0.0, "C_s": 0.0, "C_h": 0.0}, {}, 2),
        (small.castor(), {}, {}, 0),
        (small.isolator(), {"c_1": 0.0, "c_2": 0.0}, {}, 0),
        (small.follower_mast(), {"c_1": 0.0, "c_2": 0.0}, {}, 0),
    ],
    ids=str,
)
def test_number_of_neutral_eigenvalues(case, values, options, neutral):
    for found in at_equilibria(case, values, **options):
        assert found.neutral == neutral
        zeros = sorted(abs(found.eigenvalues))[: neutral + 1]
        scale = max(abs(found.eigenvalues))
        assert all(z < 1e-5 * scale for z in zeros[:neutral])
        assert len(zeros) == neutral or zeros[neutral] > 1e-3


def test_car_and_trailer_may_run_anywhere_in_any_direction():
    """S18: lateral position and course are neutral, whatever the speed; the weave is judged apart."""
    case = small.car_and_trailer()
    stable, weaving = judged(case), judged(case, values={"v": 30.0})
    assert (stable.neutral, stable.verdict) == (2, STABLE)
    assert (weaving.neutral, weaving.verdict) == (2, FLUTTER)


def test_drive_train_is_not_judged_by_the_rounding_of_its_rigid_mode():
    """S20: the zero eigenvalue stands beside 270 1/s, masses beside 2.9e6 kg m²."""
    (found,) = at_equilibria(small.drive_train())
    assert (found.verdict, found.neutral) == (STABLE, 1)
    (free,) = at_equilibria(small.drive_train(), {"rho": 0.0, "B": 0.0})
    assert (free.verdict, free.neutral) == (STABLE, 2)
    (undamped,) = at_equilibria(small.drive_train(), {"rho": 0.0, "B": 0.0, "C_s": 0.0, "C_h": 0.0})
    assert (undamped.verdict, undamped.neutral) == (MARGINAL, 2)
    np.testing.assert_allclose(max(abs(undamped.eigenvalues.imag)) / (2 * pi), 43.05, atol=0.005)


@pytest.mark.parametrize("scale", [1e-6, 1.0, 1e6])
def test_units_do_not_matter(scale):
    """The crane in other units of mass and length: same verdicts, same neutral eigenvalues."""
    v = ed.systems.load(7).values(c_x=0)
    changes = {
        "M_t": v["M_t"] * scale,
        "m": v["m"] * scale,
        "J_G": v["J_G"] * scale,
        "c_h": v["c_h"] * scale,
        "c_x": 0,
    }
    assert [(s.verdict, s.neutral) for s in crane(**changes)] == [(STABLE, 2), (DIVERGENCE, 2)]


def test_a_coordinate_without_stiffness_is_neutral_one_with_vanishing_stiffness_is_not():
    """k = 0 leaves a mass free; V = λ x²/2 + x⁴/4 at λ = 0 does not: its zero eigenvalue is critical."""
    x, k, lam, c = *small.coordinates("x"), *small.symbols("k lam c")
    kinetic, damping = x.diff() ** 2 / 2, c * x.diff() ** 2 / 2
    free = ed.lagrange(kinetic, k * x**2 / 2, [x], damping)
    found = ed.stability(ed.linearize(free, {}, {"k": 0.0, "c": 1.0}))
    assert (found.verdict, found.neutral) == (STABLE, 1)
    critical = ed.lagrange(kinetic, lam * x**2 / 2 + x**4 / 4, [x], damping)
    found = ed.stability(ed.linearize(critical, {}, {"lam": 0.0, "c": 1.0}))
    assert (found.verdict, found.neutral) == (MARGINAL, 0)


# ---------------------------------------------------------------- never judged by rounding


@pytest.mark.parametrize("R", [0.1, 0.3, 0.7, 1.0, 1.1, 2.3, 13.7])
@pytest.mark.parametrize("c", [0.0, 0.05])
def test_a_critical_state_is_marginal_however_its_numbers_round(R, c):
    """Bead on a hoop at Ω² = g/R: stiffness zero but for the last digits."""
    case = small.hoop()
    for step in range(-2, 3):
        Omega = math.sqrt(9.81 / R)
        for _ in range(abs(step)):
            Omega = math.nextafter(Omega, math.inf * step)
        assert judged(case, values={"R": R, "Omega": Omega, "c": c}).verdict == MARGINAL
    apart = 1e-6
    Omega = math.sqrt(9.81 / R)
    assert judged(case, values={"R": R, "Omega": Omega * (1 + apart), "c": c}).verdict == DIVERGENCE
    expected = STABLE if c else MARGINAL
    assert judged(case, values={"R": R, "Omega": Omega * (1 - apart), "c": c}).verdict == expected


@pytest.mark.parametrize("k", [1e-3, 1.0, 1e6])
@pytest.mark.parametrize("angle", [0.0, 0.3, 1.1, 2.7])
def test_a_free_body_in_the_plane_is_never_called_unstable(k, angle):
    """Two particles and a spring at its natural length: six zeros that rounding scatters, one oscillation."""
    q = x1, y1, x2, y2 = small.coordinates("x1 y1 x2 y2")
    m, stiffness, L_0 = small.symbols("m stiffness L_0")
    kinetic = m * sum(c.diff() ** 2 for c in q) / 2
    eom = ed.lagrange(kinetic, stiffness * (sm.sqrt((x2 - x1) ** 2 + (y2 - y1) ** 2) - L_0) ** 2 / 2, q)
    at = {"x2": 0.7 * math.cos(angle), "y2": 0.7 * math.sin(angle)}
    found = ed.stability(ed.linearize(eom, at, {"m": 1.0, "stiffness": k, "L_0": 0.7}))
    assert found.verdict == MARGINAL
    assert found.neutral == 4  # two directions; the rotation is one only while the spring is relaxed
    np.testing.assert_allclose(max(found.eigenvalues.imag), math.sqrt(2 * k), rtol=1e-9)
    assert repr(found).count("0, ") >= 5


def test_critically_damped_is_stable():
    """A double eigenvalue (a Jordan block) is sensitive, but not that sensitive."""
    x, m, c, k = *small.coordinates("x"), *small.symbols("m c k")
    eom = ed.lagrange(m * x.diff() ** 2 / 2, k * x**2 / 2, [x], c * x.diff() ** 2 / 2)
    for mass, damping, stiffness in [(1.0, 2.0, 1.0), (0.3, 2 * math.sqrt(0.3 * 7), 7.0), (1e-4, 2e-2, 1.0)]:
        found = ed.stability(ed.linearize(eom, {}, {"m": mass, "c": damping, "k": stiffness}))
        assert found.verdict == STABLE


def test_light_damping_is_not_lost():
    """A damping ratio of 1e-9 is small, and it is not rounding."""
    x, k, c = *small.coordinates("x"), *small.symbols("k c")
    eom = ed.lagrange(x.diff() ** 2 / 2, k * x**2 / 2, [x], c * x.diff() ** 2 / 2)
    assert ed.stability(ed.linearize(eom, {}, {"k": 4.0, "c": 4e-9})).verdict == STABLE
    assert ed.stability(ed.linearize(eom, {}, {"k": 4.0, "c": -4e-9})).verdict == FLUTTER


def test_errors_bound_what_rounding_does():
    """Eigenvalues computed with fifty digits differ from ours by less than the bound says."""
    import mpmath

    for number in (3, 7, 23):
        system = ed.systems.load(number)
        for e in system.equilibria():
            found = ed.stability(linear := ed.linearize(system.equations, e))
            with mpmath.workdps(50):
                exact = [
                    complex(x) for x in mpmath.eig(mpmath.matrix(linear.state_matrix.tolist()), right=False)
                ]
            nearest = [min(abs(x - y) for y in exact) for x in found.eigenvalues]
            assert all(a <= b for a, b in zip(nearest, found.errors, strict=True))
            assert max(found.errors) < 1e-6 * max(abs(found.eigenvalues))


# ---------------------------------------------------------------- what is shown and refused


def test_representation():
    found = crane()[0]
    verdict, values = repr(found).split("; ")
    assert verdict == "asymptotically stable + 1 zero eigenvalue"
    assert values == "eigenvalues [1/s]: 0, -0.1089, -0.1364+1.781i, -0.1364-1.781i"
    assert "2 zero eigenvalues" in repr(crane(c_x=0)[0])


def test_refuses_what_is_no_linear_system_and_symbols():
    system = ed.systems.load(7)
    with pytest.raises(ed.EngdynError, match="call linearize first"):
        ed.stability(system.equilibria()[0])
    with pytest.raises(ed.EngdynError, match="with numbers"):
        ed.stability(ed.linearize(system.equations, {}, symbolic=True))
