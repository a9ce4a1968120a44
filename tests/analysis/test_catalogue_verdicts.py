"""Where the systems of the catalogue lose stability: exact limits of Routh, and eigenvalues, by two ways.

The published numbers are those of the course's exercises 5.5 to 5.11 (pitfall 17: damping may destabilize).
"""

from __future__ import annotations

import math
from functools import cache

import numpy as np
import pytest

import engdyn as ed

NO_DAMPING = {"c_1": 0.0, "c_2": 0.0}
TOP = {"k_a": 0.0, "k_b": 0.0}  # S15 without springs: only the spin can hold it upright
UNDAMPED_TOP = {**TOP, "c_a": 0.0, "c_b": 0.0}

CASES = {
    "S11 follower force, damped": (11, {}, "P", (1.0, 150.0), [(58.6114, "flutter", 0, 2)]),
    "S11 follower force, undamped": (11, NO_DAMPING, "P", (1.0, 150.0), [(83.4315, "flutter", 0, 2)]),
    "S12 airfoil": (
        12,
        {},
        "U",
        (1.0, 100.0),
        [(20.3343, "flutter", 0, 2), (57.1429, "divergence", 2, 3)],
    ),
    "S13 castor": (13, {}, "v", (0.5, 200.0), [(3.9260, "flutter", 0, 2), (66.0370, "flutter", 2, 0)]),
    "S14 internal damping": (14, {}, "Omega", (1.0, 2000.0), [(790.5694, "flutter", 0, 2)]),
    "S15 spinning top, undamped": (15, UNDAMPED_TOP, "Omega", (0.5, 60.0), [(10.4403, "flutter", 2, 0)]),
    "S15 spinning top, damped": (15, TOP, "Omega", (0.5, 1000.0), []),
    "S18 car and trailer": (18, {}, "v", (2.0, 80.0), [(26.3524, "flutter", 0, 2)]),
}


@cache
def case(name):
    number, changes, parameter, interval, published = CASES[name]
    system = ed.systems.load(number)
    values = system.values(**changes)
    return system, values, parameter, interval, published


def straight(system, values):
    """The equilibrium that the published numbers are about: the one nearest to zero."""
    return min(system.equilibria(values), key=lambda e: float(np.max(abs(e.q))))


@cache
def limits(name):
    system, values, parameter, interval, _ = case(name)
    linear = ed.linearize(system.equations, straight(system, values))
    return ed.routh_limits(ed.characteristic_polynomial(linear, parameter), parameter, interval)


def judged(name, at):
    """Eigenvalues where the parameter is `at`, without the neutral ones: straight motion is there at any value."""
    system, values, parameter, _, _ = case(name)
    found = ed.eigenvalues(ed.linearize(system.equations, {}, {**values, parameter: float(at)}))
    return found[np.argsort(abs(found))[neutral(name) :]]


@cache
def neutral(name):
    """Number of eigenvalues that are zero at any value of the parameter."""
    system, values, *_ = case(name)
    return ed.stability(ed.linearize(system.equations, {}, values)).neutral


def unstable(name, at):
    """Number of eigenvalues on the right.

    Without damping they lie on the axis before, where rounding scatters them; a pair that has met there parts as the
    square root of the distance, so that this share tells both apart.
    """
    found = judged(name, at)
    return int(np.sum(found.real > ("undamped" in name) * 3e-8 * np.max(abs(found))))


def bisected(name, low, high):
    """The value between at which the number of unstable eigenvalues changes."""
    before = unstable(name, low)
    assert unstable(name, high) != before
    while high - low > 2e-11 * high:
        middle = 0.5 * (low + high)
        low, high = (middle, high) if unstable(name, middle) == before else (low, middle)
    return 0.5 * (low + high)


@pytest.mark.parametrize("name", CASES)
def test_limits_are_the_published_ones(name):
    published = CASES[name][4]
    found = limits(name)
    assert [(x.kind, x.before, x.after) for x in found] == [row[1:] for row in published]
    np.testing.assert_allclose(found, [row[0] for row in published], atol=5.1e-5)


@pytest.mark.parametrize("name", [name for name, row in CASES.items() if row[4]])
def test_limits_agree_with_eigenvalues(name):
    for limit in limits(name):
        found = bisected(name, limit * (1 - 1e-3), limit * (1 + 1e-3))
        np.testing.assert_allclose(found, limit, rtol=1e-8)


@pytest.mark.parametrize("name", [name for name, row in CASES.items() if row[4]])
def test_frequencies_at_the_limit_are_those_of_an_eigenvalue_on_the_axis(name):
    for limit in limits(name):
        found = judged(name, limit)
        assert min(abs(found - 2j * math.pi * limit.frequency)) < 1e-6 * np.max(abs(found))


@pytest.mark.parametrize("name", CASES)
def test_limits_are_the_only_changes_of_the_verdict(name):
    found, interval = limits(name), CASES[name][3]
    counts = [found[0].before, *(x.after for x in found)] if found else [2]
    for at in np.linspace(*interval, 23):
        expected = counts[sum(float(x) < at for x in found)]
        assert unstable(name, at) == expected


def test_closed_forms():
    """S14: ω₀ (1 + c_e/c_i); S15: C Ω = 2 √(A m g l); S12: k_a = ½ ρ U² A_w C_L e."""
    v = ed.systems.load(14).values()
    expected = math.sqrt(v["k"] / v["m"]) * (1 + v["c_e"] / v["c_i"])
    np.testing.assert_allclose(limits("S14 internal damping")[0], expected, rtol=1e-14)
    v = ed.systems.load(15).values()
    expected = 2 * math.sqrt(v["A"] * v["m"] * v["g"] * v["l"]) / v["C"]
    np.testing.assert_allclose(limits("S15 spinning top, undamped")[0], expected, rtol=1e-14)
    v = ed.systems.load(12).values()
    expected = math.sqrt(2 * v["k_a"] / (v["rho"] * v["A_w"] * v["C_L"] * v["e"]))
    np.testing.assert_allclose(limits("S12 airfoil")[1], expected, rtol=1e-14)


def test_damping_destroys_gyroscopic_stability():
    """S15 without springs: marginal above the critical spin without damping, unstable at any spin with it."""
    system = ed.systems.load(15)
    for Omega in (15.0, 50.0, 500.0):
        verdicts = [
            ed.stability(ed.linearize(system.equations, {}, system.values(**changes, Omega=Omega))).verdict
            for changes in (UNDAMPED_TOP, TOP)
        ]
        assert verdicts == ["marginal", "unstable (flutter)"]


def test_damping_lowers_the_critical_thrust():
    """S11: 58.61 N with damping, 83.43 N without; no load makes K singular (no divergence)."""
    damped, undamped = (limits(f"S11 follower force, {kind}")[0] for kind in ("damped", "undamped"))
    assert damped < 0.71 * undamped
    system = ed.systems.load(11)
    linear = ed.linearize(system.equations, {}, system.values())
    assert ed.characteristic_polynomial(linear, "P")[-1].is_number
