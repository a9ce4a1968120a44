"""Verdicts on stability: against numpy's roots, closed forms and Hurwitz; neutral eigenvalues; rounding."""

from __future__ import annotations

from math import pi

import numpy as np
import pytest
import sympy as sm
from hypothesis import assume, given
from hypothesis import strategies as st
from scipy.optimize import brentq

import engdyn as ed
from analysis import small_systems as small
from analysis.checks import (
    at_equilibria,
    judged,
)
from engdyn.analysis.stability import verdict_of

STABLE, MARGINAL = "asymptotically stable", "marginal"
DIVERGENCE, FLUTTER = "unstable (divergence)", "unstable (flutter)"


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


# ---------------------------------------------------------------- what is shown and refused


def crane(**changes):
    system = ed.systems.load(7)
    return [
        ed.stability(ed.linearize(system.equations, e)) for e in system.equilibria(system.values(**changes))
    ]


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
