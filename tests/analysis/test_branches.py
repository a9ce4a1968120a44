"""Branches over a parameter: normal forms and closed forms, each branch once, ends exactly on the range."""

from __future__ import annotations

import math
import time

import numpy as np
import pytest
import sympy as sm
from sympy.physics.mechanics import dynamicsymbols

import engdyn as ed
from analysis import small_systems as small
from analysis.checks import (
    assert_all_are_equilibria,
    assert_no_branch_twice,
    kinds,
)

GOVERNOR = ed.systems.load(3)
VALUES = GOVERNOR.values()
CRITICAL = math.sqrt((VALUES["m"] + VALUES["M_c"]) * VALUES["g"] / (VALUES["m"] * VALUES["l"]))


def governor_cosine(Omega):
    """cos θ of the lifted arms: m l Ω² cos = (m + M_c) g + 2 k l (1 − cos)."""
    v = VALUES
    spring = 2 * v["k"] * v["l"]
    return ((v["m"] + v["M_c"]) * v["g"] + spring) / (v["m"] * v["l"] * Omega**2 + spring)


@pytest.fixture(scope="module")
def governor():
    return ed.continue_equilibria(GOVERNOR.equations, VALUES, "Omega", (5.0, 30.0), bounds=GOVERNOR.bounds)


def over_lambda(potential, name="normal form", range=(-1.0, 1.3), **values):
    case = small.normal_form(potential, name, **values)
    return ed.continue_equilibria(case.eom, case.values, "lam", range, bounds=case.bounds)


def x_and_lambda():
    return *small.coordinates("x"), *small.symbols("lam e")


# ---------------------------------------------------------------- the governor


def test_governor_pitchfork_to_eight_digits(governor):
    (point,) = governor.points
    assert point.kind == "pitchfork"
    assert abs(point.parameter - CRITICAL) < 1e-8
    assert np.max(np.abs(point.q)) < 1e-8


def test_governor_arms_follow_the_closed_form(governor):
    trunk, *arms = sorted(governor, key=lambda b: np.ptp(b.q))
    assert len(arms) == 2
    assert np.max(np.abs(trunk.q)) < 1e-8
    for arm in arms:
        np.testing.assert_allclose(np.cos(arm.q[:, 0]), governor_cosine(arm.parameter), atol=1e-8)
    assert np.all(
        arms[0].q[1:] * arms[1].q[1:][:: 1 if arms[0].parameter[0] == arms[1].parameter[0] else -1] < 0
    )


def test_governor_stability_along_the_branches(governor):
    trunk, *arms = sorted(governor, key=lambda b: np.ptp(b.q))
    away = np.abs(trunk.parameter - CRITICAL) > 1e-6
    np.testing.assert_array_equal(trunk.stable[away], trunk.parameter[away] < CRITICAL)
    for arm in arms:
        assert arm.stable.all()


def test_branches_end_exactly_on_the_range_and_at_the_branch_point(governor):
    trunk, *arms = sorted(governor, key=lambda b: np.ptp(b.q))
    assert sorted([trunk.parameter[0], trunk.parameter[-1]]) == [5.0, 30.0]
    (point,) = governor.points
    for arm in arms:
        ends = sorted([(p, *q) for p, q in zip(arm.parameter[[0, -1]], arm.q[[0, -1]], strict=True)])
        assert ends[0] == (point.parameter, *point.q)
        assert ends[1][0] == 30.0
    assert any(p == point.parameter for p in trunk.parameter)


def test_governor_branches_contain_what_single_searches_find(governor):
    for Omega in (6.3, 11.0, 13.0, 19.7, 29.0):
        for e in GOVERNOR.equilibria({"Omega": Omega}):
            near = [
                np.interp(Omega, *_rising(b))
                for b in governor
                if b.parameter.min() <= Omega <= b.parameter.max()
            ]
            assert min(abs(near - e.q[0])) < 2e-3


def _rising(branch):
    order = np.argsort(branch.parameter)
    return branch.parameter[order], branch.q[order, 0]


def test_a_call_takes_a_fraction_of_a_second():
    """Processor time, which other work on the machine does not count into; warm."""
    options = {"bounds": GOVERNOR.bounds}
    ed.continue_equilibria(GOVERNOR.equations, VALUES, "Omega", (5.0, 30.0), **options)
    start = time.process_time()
    ed.continue_equilibria(GOVERNOR.equations, VALUES, "Omega", (5.0, 30.0), **options)
    assert time.process_time() - start < 1.0


# ---------------------------------------------------------------- normal forms


def test_supercritical_pitchfork():
    x, lam, _ = x_and_lambda()
    found = over_lambda(-lam * x**2 / 2 + x**4 / 4)
    (point,) = found.points
    assert (point.kind, len(found)) == ("pitchfork", 3)
    np.testing.assert_allclose([point.parameter, *point.q], [0.0, 0.0], atol=1e-10)
    trunk, *arms = sorted(found, key=lambda b: np.ptp(b.q))
    for arm in arms:
        np.testing.assert_allclose(arm.q[:, 0] ** 2, arm.parameter, atol=1e-10)
        assert arm.stable.all()
    np.testing.assert_array_equal(trunk.stable, trunk.parameter < -1e-12)
    assert_no_branch_twice(found)


def test_subcritical_pitchfork_found_from_its_arms():
    """The curve that is met first turns around at the branch point: not a fold."""
    x, lam, _ = x_and_lambda()
    found = over_lambda(-lam * x**2 / 2 - x**4 / 4)
    (point,) = found.points
    assert point.kind == "pitchfork"
    np.testing.assert_allclose([point.parameter, *point.q], [0.0, 0.0], atol=1e-10)
    bent = [b for b in found if np.ptp(b.q) > 0.1]
    for branch in bent:
        np.testing.assert_allclose(branch.q[:, 0] ** 2, -branch.parameter, atol=1e-10)
        assert not branch.stable.any()
    straight = [b for b in found if np.ptp(b.q) <= 0.1]
    assert min(b.parameter.min() for b in straight) == -1.0
    assert max(b.parameter.max() for b in straight) == 1.3
    for branch in straight:
        inner = np.abs(branch.parameter) > 1e-9
        np.testing.assert_array_equal(branch.stable[inner], branch.parameter[inner] < 0)
    assert_no_branch_twice(found)


def test_transcritical():
    x, lam, _ = x_and_lambda()
    found = over_lambda(-lam * x**2 / 2 + x**3 / 3)
    (point,) = found.points
    assert point.kind == "transcritical"
    np.testing.assert_allclose([point.parameter, *point.q], [0.0, 0.0], atol=1e-10)
    for branch in found:
        product = branch.q[:, 0] * (branch.q[:, 0] - branch.parameter)
        np.testing.assert_allclose(product, 0.0, atol=1e-10)
        inner = np.abs(branch.parameter) > 1e-9
        stable = np.where(np.abs(branch.q[:, 0]) < 1e-9, branch.parameter < 0, branch.parameter > 0)
        np.testing.assert_array_equal(branch.stable[inner], stable[inner])
    assert_no_branch_twice(found)


@pytest.mark.parametrize("e", [0.05, -0.05, 1e-3])
def test_imperfect_pitchfork_has_a_fold(e):
    x, lam, imperfection = x_and_lambda()
    found = over_lambda(-lam * x**2 / 2 + x**4 / 4 - imperfection * x, e=e)
    (point,) = found.points
    assert point.kind == "fold"
    critical = 3 * (abs(e) / 2) ** (2 / 3)
    np.testing.assert_allclose(point.parameter, critical, rtol=1e-9)
    np.testing.assert_allclose(point.q[0], -math.copysign((abs(e) / 2) ** (1 / 3), e), rtol=1e-6)
    assert len(found) == 2
    assert_no_branch_twice(found)


def test_a_curve_with_two_folds_is_one_branch():
    x, lam, e = x_and_lambda()
    case = small.normal_form(-lam * x**2 / 2 + x**4 / 4 - e * x, "hysteresis", lam=0.5)
    found = ed.continue_equilibria(case.eom, {"lam": 0.5}, "e", (-1.0, 1.0), bounds=case.bounds)
    (branch,) = found
    fold = 2 * (0.5 / 3) ** 1.5
    assert kinds(found) == ["fold", "fold"]
    np.testing.assert_allclose(sorted(p.parameter for p in found.points), [-fold, fold], rtol=1e-12)
    inner = np.abs(np.abs(branch.q[:, 0]) - math.sqrt(0.5 / 3)) > 1e-6
    np.testing.assert_array_equal(branch.stable[inner], (np.abs(branch.q[:, 0]) > math.sqrt(0.5 / 3))[inner])
    assert sorted([branch.parameter[0], branch.parameter[-1]]) == [-1.0, 1.0]


def test_a_closed_loop_is_traced_once_and_closes():
    x, lam, _ = x_and_lambda()
    found = over_lambda(x**3 / 3 + x * (lam**2 - 0.04), range=(-1.0, 1.0))
    (branch,) = found
    np.testing.assert_allclose(branch.q[:, 0] ** 2 + branch.parameter**2, 0.04, atol=1e-10)
    np.testing.assert_allclose(sorted(p.parameter for p in found.points), [-0.2, 0.2], atol=1e-12)
    assert (branch.parameter[0], *branch.q[0]) == (branch.parameter[-1], *branch.q[-1])
    turned = np.unwrap(np.arctan2(branch.parameter, branch.q[:, 0]))
    np.testing.assert_allclose(abs(turned[-1] - turned[0]), 2 * math.pi, atol=1e-9)  # once around


def test_flat_pitchfork():
    x, lam, _ = x_and_lambda()
    found = over_lambda(-lam * x**2 / 2 + x**6 / 6)
    assert kinds(found) == ["pitchfork"]
    for arm in (b for b in found if np.ptp(b.q) > 0.1):
        np.testing.assert_allclose(arm.q[:, 0] ** 4, arm.parameter, atol=1e-10)


def test_two_degrees_of_freedom_and_secondary_branches():
    """V = −λ(x² + y²)/2 + x⁴/4 + y⁴/4 + y²/4: nine branches, four pitchforks."""
    x, y = small.coordinates("x y")
    (lam,) = small.symbols("lam")
    potential = -lam * (x**2 + y**2) / 2 + x**4 / 4 + y**4 / 4 + y**2 / 4
    kinetic, region = (x.diff() ** 2 + y.diff() ** 2) / 2, {"x": (-2.0, 2.0), "y": (-2.0, 2.0)}
    case = small.Case("two", [x, y], kinetic, potential, {}, region, kinetic / 10)
    found = ed.continue_equilibria(case.eom, {}, "lam", (-1.0, 1.3), bounds=region)
    assert kinds(found) == ["pitchfork"] * 4
    at = sorted((round(p.parameter, 9), *np.round(p.q, 6)) for p in found.points)
    root = round(math.sqrt(0.5), 6)
    assert at == [(0.0, 0.0, 0.0), (0.5, -root, 0.0), (0.5, 0.0, 0.0), (0.5, root, 0.0)]
    assert_all_are_equilibria(case, found)
    assert_no_branch_twice(found)
    for value in (-0.5, 0.25, 1.1):  # as many as there are zeros
        expected = {(-0.5): 1, 0.25: 3, 1.1: 9}[value]
        crossings = sum(int(np.sum(np.diff(np.sign(b.parameter - value)) != 0)) for b in found)
        assert crossings == expected == len(ed.equilibria(case.eom, {"lam": value}, region))


# ---------------------------------------------------------------- what is shown and refused


def test_representations(governor):
    lines = repr(governor).splitlines()
    assert lines[0] == "3 branches over Omega"
    assert any("partly stable" in line for line in lines)
    assert lines[-1].startswith("  pitchfork at 11.7192")
    assert governor.coordinates == ("theta",)
    assert governor.range == (5.0, 30.0)


@pytest.mark.parametrize(
    ("parameter", "range", "message"),
    [
        ("omega", (5.0, 30.0), "unknown parameter 'omega'"),
        ("Omega", (30.0, 5.0), "smaller one first"),
        ("Omega", (5.0, 5.0), "smaller one first"),
        ("Omega", (5.0, math.inf), "finite"),
        ("Omega", (math.nan, 30.0), "finite"),
        ("Omega", 5.0, r"give \(first, last\)"),
        ("Omega", ("slow", "fast"), r"give \(first, last\)"),
    ],
)
def test_bad_arguments_are_refused(parameter, range, message):
    with pytest.raises(ed.EngdynError, match=message):
        ed.continue_equilibria(GOVERNOR.equations, VALUES, parameter, range, bounds=GOVERNOR.bounds)


def test_missing_values_and_other_models_are_refused():
    with pytest.raises(ed.EngdynError, match="lacks the parameters"):
        ed.continue_equilibria(GOVERNOR.equations, {"m": 1.0}, "Omega", (5.0, 30.0), bounds=GOVERNOR.bounds)
    with pytest.raises(ed.EngdynError, match="give EquationsOfMotion"):
        ed.continue_equilibria(GOVERNOR, VALUES, "Omega", (5.0, 30.0), bounds=GOVERNOR.bounds)


def test_where_all_places_are_equilibria_a_neutral_family_is_told_and_not_followed():
    """V = (p − 1) x²/2: at p = 1 every x is an equilibrium; elsewhere only x = 0 is."""
    x, p = dynamicsymbols("x"), sm.Symbol("p")
    eom = ed.lagrange(x.diff() ** 2 / 2, (p - 1) * x**2 / 2, [x], dissipation=x.diff() ** 2 / 8)
    found = ed.continue_equilibria(eom, {"p": 0.0}, "p", (0.3, 2.0), bounds={"x": (-1, 1)})
    (crossing,) = found.points
    assert crossing.kind == "neutral family"
    assert crossing.parameter == pytest.approx(1.0, abs=1e-9)
    (branch,) = found
    assert np.ptp(branch.parameter) == pytest.approx(1.7)
    away = np.abs(branch.parameter - 1.0) > 1e-6
    assert np.array_equal(branch.stable[away], branch.parameter[away] > 1.0)
