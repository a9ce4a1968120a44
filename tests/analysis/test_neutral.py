"""Neutral eigenvalues are counted from the structure, and no verdict hangs on rounding."""

from __future__ import annotations

import math
from math import pi

import numpy as np
import pytest
import sympy as sm
from sympy.physics.mechanics import dynamicsymbols

import engdyn as ed
from analysis import small_systems as small
from analysis.checks import (
    at_equilibria,
    judged,
)

STABLE, MARGINAL = "asymptotically stable", "marginal"
DIVERGENCE, FLUTTER = "unstable (divergence)", "unstable (flutter)"


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


def test_pi_is_not_zero():
    """A stiffness pi k holds the mass: nothing is neutral."""
    x = dynamicsymbols("x")
    m, k = sm.symbols("m k", positive=True)
    oscillator = ed.lagrange(m * x.diff() ** 2 / 2, sm.pi * k * x**2 / 2, [x])
    found = ed.stability(ed.linearize(oscillator, {"x": 0}, {"m": 1.0, "k": 2.0}))
    assert (found.verdict, found.neutral) == ("marginal", 0)
