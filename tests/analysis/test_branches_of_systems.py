"""Branches of mechanical systems over their parameters: folds, pitchforks and steady motions."""

from __future__ import annotations

import math

import numpy as np
import pytest

import engdyn as ed
from analysis import small_systems as small
from analysis.checks import (
    assert_all_are_equilibria,
    assert_no_branch_twice,
    kinds,
)


def test_folds_of_the_snap_through_in_closed_form():
    """S02 under a force: 2 k y (1 − L_0/√(b² + y²)) + m g = P turns at (b² + y²)³ᐟ² = L_0 b²."""
    case = small.snap_through()
    v = case.values
    found = ed.continue_equilibria(case.eom, v, "P", (-12.0, 12.0), bounds={"y": (-0.05, 0.05)})
    y = math.sqrt((v["L_0"] * v["b"] ** 2) ** (2 / 3) - v["b"] ** 2)
    force = 2 * v["k"] * y * (1 - v["L_0"] / math.sqrt(v["b"] ** 2 + y**2))
    expected = sorted([v["m"] * v["g"] + force, v["m"] * v["g"] - force])
    assert kinds(found) == ["fold", "fold"]
    np.testing.assert_allclose(sorted(p.parameter for p in found.points), expected, rtol=1e-10)
    np.testing.assert_allclose(sorted(p.q[0] for p in found.points), [-y, y], rtol=1e-7)
    (branch,) = found
    inner = np.abs(np.abs(branch.q[:, 0]) - y) > 1e-6
    np.testing.assert_array_equal(branch.stable[inner], (np.abs(branch.q[:, 0]) > y)[inner])
    assert_all_are_equilibria(case, found)


def test_bead_on_a_hoop_goes_all_the_way_around():
    """The upright position lies on the seam of the region and is one branch all the same."""
    case = small.hoop()
    found = ed.continue_equilibria(case.eom, case.values, "Omega", (0.0, 15.0))
    (point,) = found.points
    assert abs(point.parameter - math.sqrt(9.81 / 0.3)) < 1e-8
    assert len(found) == 4
    upright = [b for b in found if np.min(np.cos(b.q)) < -0.999]
    assert len(upright) == 1
    assert not upright[0].stable.any()
    for arm in (b for b in found if np.ptp(b.q) > 0.1):
        np.testing.assert_allclose(np.cos(arm.q[:, 0]), 9.81 / (0.3 * arm.parameter**2), atol=1e-8)


def test_seismometer_buckles_when_its_flexure_gets_soft():
    case = small.seismometer()
    found = ed.continue_equilibria(case.eom, case.values, "k_f", (0.8, 1.2), bounds={"theta": (-1.5, 1.5)})
    (point,) = found.points
    assert point.kind == "pitchfork"
    np.testing.assert_allclose(point.parameter, 0.5 * 9.81 * 0.2, rtol=1e-10)
    assert_all_are_equilibria(case, found)
    assert_no_branch_twice(found)


def test_crane_over_its_parameters_keeps_its_two_positions():
    crane = ed.systems.load(7)
    for name in ("L", "m", "c_x"):
        low, high = 0.5 * crane.values()[name], 2.0 * crane.values()[name]
        found = ed.continue_equilibria(
            crane.equations, crane.values(), name, (low, high), bounds=crane.bounds
        )
        assert len(found) == 2
        assert found.points == ()
        assert sorted(b.stable.all() for b in found) == [False, True]
        assert all(sorted(b.parameter[[0, -1]]) == [low, high] for b in found)


def test_steady_motions_over_a_force_that_is_solved_for():
    """The crane accelerated at x'' = 1: tan θ = −a/g over g, and the force does not depend on it."""
    crane = ed.systems.load(7)
    options = {"bounds": {"theta": (-1.5, 1.5)}, "accelerations": {"x": 1.0}, "free": ["F"]}
    values = crane.values(c_x=0)
    found = ed.continue_equilibria(
        crane.equations,
        values,
        "g",
        (5.0, 15.0),
        **{**options, "bounds": {"theta": (-1.5, 1.5), "F": (0.0, 1e4)}},
    )
    (branch,) = found
    np.testing.assert_allclose(np.tan(branch.q[:, 1]), -1.0 / branch.parameter, atol=1e-9)
    assert branch.stable.all()


def test_drive_train_over_the_wind():
    """Rates that go together are followed together."""
    case = small.drive_train()
    found = ed.continue_equilibria(case.eom, case.values, "v", (6.0, 20.0), bounds=case.bounds)
    (branch,) = found
    assert branch.stable.all()
    for i in (0, 20, -1):
        (e,) = ed.equilibria(case.eom, {**case.values, "v": float(branch.parameter[i])}, case.bounds)
        np.testing.assert_allclose(branch.q[i], e.q, rtol=1e-9)
    with pytest.raises(ed.EngdynError, match="N changes which motion is neutral"):
        ed.continue_equilibria(case.eom, case.values, "N", (60.0, 90.0), bounds=case.bounds)


def test_half_car_over_its_load():
    car = ed.systems.load(23)
    found = ed.continue_equilibria(car.equations, car.values(), "m_s", (400.0, 1000.0), bounds=car.bounds)
    (branch,) = found
    assert len(np.unique(branch.parameter)) == len(branch.parameter)
    assert np.all(np.diff(branch.q[:, 0]) * np.diff(branch.parameter) < 0)  # more load, more sag
    for i in (0, -1):
        (e,) = car.equilibria({"m_s": float(branch.parameter[i])})
        np.testing.assert_allclose(branch.q[i], e.q, atol=1e-10)


def test_turntable_over_a_rate_that_only_its_steady_motion_knows():
    """S06: (k − m Ω²) s = k s_0 while s < 1 m; the torque of the bearing, c_t Ω, is solved for."""
    table = ed.systems.load(6)
    (branch,) = table.branches("Omega", (5.0, 25.0))
    v = table.values()
    np.testing.assert_allclose(branch.q[:, 1], v["k"] * v["s_0"] / (v["k"] - v["m"] * branch.parameter**2))
    assert branch.parameter.max() == pytest.approx(math.sqrt(0.75 * v["k"] / v["m"]))  # there s = 1 m
    assert branch.stable.all()


def test_gymnast_within_the_region_of_the_hip():
    gymnast = ed.systems.load(8)
    found = gymnast.branches("k_h", (20.0, 200.0))
    (fork,) = found.points
    assert fork.kind == "pitchfork"
    np.testing.assert_allclose(fork.q, [math.pi, math.pi], atol=1e-6)
    for branch in found:
        assert np.all(np.abs(branch.q[:, 1] - branch.q[:, 0]) < math.pi + 1e-6)
    # The handstand is one state: its angles -pi, -pi are left out.
    assert sum(np.ptp(b.q) < 1e-9 and abs(b.q[0, 0]) > 3.0 for b in found) == 1
