"""Maps of stability: points against `stability`, boundaries against exact limits, folds against certificates."""

from __future__ import annotations

import math
import random

import numpy as np
import pytest
import sympy as sm

import engdyn as ed
from analysis import small_systems as small

STABLE, MARGINAL = "asymptotically stable", "marginal"
DIVERGENCE, FLUTTER = "unstable (divergence)", "unstable (flutter)"
NONE = "no equilibrium"

PLANES = {
    11: (("P", np.linspace(0, 120, 31)), ("c_1", np.linspace(0, 1, 11))),
    12: (("U", np.linspace(1, 80, 31)), ("d", np.linspace(-0.05, 0.1, 11))),
    13: (("v", np.linspace(1, 80, 31)), ("a", np.linspace(0.02, 0.2, 11))),
    15: (("Omega", np.linspace(0, 40, 31)), ("k_a", np.linspace(0, 60, 11))),
    18: (("v", np.linspace(5, 60, 12)), ("e", np.linspace(2.0, 3.5, 6))),
}


def agrees(found, eom, values, count, equilibrium=None):
    """Whether `stability` says the same at random points, about the equilibrium that is there."""
    source, names = random.Random(1), [c.func.__name__ for c in eom.coordinates]
    for _ in range(count):
        j, i = (source.randrange(len(array)) for _, array in (found.y, found.x))
        here = {**values, found.x[0]: found.x[1][i], found.y[0]: found.y[1][j]}
        at = equilibrium(here) if equilibrium else dict.fromkeys(names, 0.0)
        judged = ed.stability(ed.linearize(eom, at, here))
        assert found.verdict[j, i] == judged.verdict, here
        scale = np.max(abs(judged.eigenvalues))
        gaps = abs(found.eigenvalues[j, i][:, None] - judged.eigenvalues).min(axis=1)
        assert np.max(gaps) < 1e-6 * scale


@pytest.mark.parametrize("number", PLANES)
def test_every_verdict_is_that_of_stability(number):
    system = ed.systems.load(number)
    values = system.values()
    found = ed.stability_map(system.equations, values, *PLANES[number])
    (_, across), (_, up) = PLANES[number]
    assert found.verdict.shape == (len(up), len(across))
    assert found.eigenvalues.shape[:2] == found.verdict.shape
    assert len(np.unique(found.verdict)) > 1
    agrees(found, system.equations, values, 40)


@pytest.mark.parametrize(("number", "x"), [(11, "P"), (12, "U"), (13, "v"), (14, "Omega")])
def test_verdicts_change_at_the_exact_limits(number, x):
    system = ed.systems.load(number)
    values, top = system.values(), {11: 120, 12: 80, 13: 90, 14: 1200}[number]
    at = system.equilibria()[0]
    grid = np.linspace(1, top, 400)
    other = system.parameters[0].name
    found = ed.stability_map(system.equations, values, (x, grid), (other, [values[other]]), at=at)
    unstable = np.char.startswith(found.verdict[0], "unstable")
    edges = np.flatnonzero(unstable[1:] != unstable[:-1])
    linear = ed.linearize(system.equations, at)
    limits = ed.routh_limits(ed.characteristic_polynomial(linear, x), x, (1, top))
    limits = [limit for limit in limits if 0 in (limit.before, limit.after)]
    assert len(edges) == len(limits)
    for edge, limit in zip(edges, limits, strict=True):
        assert grid[edge] < limit < grid[edge + 1]


# ---------------------------------------------------------------- the equilibrium is followed


def test_snapped_through_where_the_fold_is_passed():
    """S02: the upper state exists where the certified search finds three equilibria, and is the highest of them."""
    system = ed.systems.load(2)
    at = system.equilibria()[-1]
    plane = ("g", np.linspace(0, 60, 61)), ("k", np.linspace(200, 6000, 30))
    found = ed.stability_map(system.equations, system.values(), *plane, at=at)
    assert set(np.unique(found.verdict)) == {STABLE, NONE}
    source = random.Random(2)
    for _ in range(40):
        j, i = source.randrange(30), source.randrange(61)
        states = system.equilibria(system.values(g=plane[0][1][i], k=plane[1][1][j]))
        assert states.certified
        assert (len(states) == 3) == (found.verdict[j, i] == STABLE)
        if len(states) == 3:
            np.testing.assert_allclose(found.states[j, i, 0], states[-1].q[0], rtol=1e-9)
        else:
            assert np.isnan(found.states[j, i]).all()


def test_arms_that_have_swung_in_are_gone():
    """S03: below the pitchfork only the hanging arms are an equilibrium."""
    system = ed.systems.load(3)
    at = system.equilibria()[-1]
    plane = ("Omega", np.linspace(4, 30, 53)), ("k", np.linspace(0, 200, 9))
    found = ed.stability_map(system.equations, system.values(), *plane, at=at)
    for j, k in enumerate(plane[1][1]):
        straight = ed.linearize(system.equations, {}, system.values(k=k))
        (limit,) = ed.routh_limits(ed.characteristic_polynomial(straight, "Omega"), "Omega", (0, 100))
        assert [v == STABLE for v in found.verdict[j]] == list(plane[0][1] > limit)


def test_steady_whirl_follows_speed_and_unbalance():
    """S14: the drive angle Omega t is an input whose default follows the parameter."""
    system = ed.systems.load(14)
    plane = ("Omega", np.linspace(10, 1200, 25)), ("epsilon", np.linspace(1e-5, 2e-4, 6))
    at = system.equilibria()[0]
    found = ed.stability_map(system.equations, system.values(), *plane, at=at)
    agrees(found, system.equations, system.values(), 20, lambda v: ed.equilibria(system.equations, v)[0])
    for j, i in ((0, 0), (3, 20), (5, 24)):
        there = ed.equilibria(system.equations, system.values(Omega=plane[0][1][i], epsilon=plane[1][1][j]))[
            0
        ]
        np.testing.assert_allclose(found.states[j, i, :2], there.q, rtol=1e-7)


@pytest.mark.parametrize(
    ("number", "plane"),
    [
        (
            6,
            (("k", np.linspace(1000, 3000, 5)), ("c_s", np.linspace(0, 20, 4))),
        ),  # rate prescribed, torque held
        (
            9,
            (("l", np.linspace(0.05, 0.15, 5)), ("c_a", np.linspace(0, 0.1, 4))),
        ),  # at rest on a slope, torque held
        (20, (("v", np.linspace(8, 14, 5)), ("C_s", np.linspace(1e5, 1e6, 4)))),  # rate decided by the wind
    ],
)
def test_steady_motions_are_followed(number, plane):
    system = ed.systems.load(number)
    at = system.equilibria()[0]
    found = ed.stability_map(system.equations, system.values(), *plane, at=at)
    for j, y in enumerate(plane[1][1]):
        for i, x in enumerate(plane[0][1]):
            here = system.equilibria(system.values(**{plane[0][0]: x, plane[1][0]: y}))[0]
            state = np.concatenate([here.q, here.speeds])
            varied = np.flatnonzero(abs(state) > 0)  # what is neutral is reported as zero
            if number == 20:  # all three turn together
                turned, ratio = found.states[j, i, 0], 1 / system.values()["N"]
                state[:3] += turned * np.array([1, 1 / ratio, 1 / ratio])
            np.testing.assert_allclose(found.states[j, i, varied], state[varied], rtol=1e-7)
            assert found.verdict[j, i] == ed.stability(ed.linearize(system.equations, here)).verdict


def test_an_equilibrium_at_other_values_is_led_to_the_plane():
    """Found at g = 9.81 m/s², followed to a plane that does not contain this."""
    system = ed.systems.load(2)
    at = system.equilibria()[-1]
    plane = ("g", [40.0, 50.0]), ("k", [5000.0, 6000.0])
    found = ed.stability_map(system.equations, system.values(), *plane, at=at)
    for j in (0, 1):
        for i in (0, 1):
            states = system.equilibria(system.values(g=plane[0][1][i], k=plane[1][1][j]))
            np.testing.assert_allclose(found.states[j, i, 0], states[-1].q[0], rtol=1e-9)


# ---------------------------------------------------------------- neutral and marginal


def test_neutral_eigenvalues_are_set_apart_where_damping_vanishes_too():
    """S07: one zero with friction of the trolley, two without."""
    system = ed.systems.load(7)
    plane = ("c_x", np.array([0.0, 10.0, 300.0])), ("c_h", np.array([0.0, 50.0]))
    found = ed.stability_map(system.equations, system.values(), *plane)
    expected = [
        [
            ed.stability(ed.linearize(system.equations, {}, system.values(c_x=c_x, c_h=c_h))).verdict
            for c_x in plane[0][1]
        ]
        for c_h in plane[1][1]
    ]
    assert found.verdict.tolist() == expected
    assert expected[0][0] == MARGINAL
    assert expected[1] == [STABLE] * 3


def test_without_damping_the_map_is_marginal():
    case = small.follower_mast()
    values = {**case.values, "c_1": 0.0, "c_2": 0.0}
    found = ed.stability_map(case.eom, values, ("P", np.linspace(0, 120, 200)), ("c_1", [0.0]))
    assert found.verdict[0].tolist() == [MARGINAL if P < 83.4315 else FLUTTER for P in found.x[1]]


def test_critical_points_are_judged_one_by_one():
    """Bead on a hoop: exactly at Ω² = g/R the stiffness is rounding, and light damping is not lost."""
    case = small.hoop()
    critical = math.sqrt(9.81 / case.values["R"])
    speeds = critical * np.array([0.9, 1 - 1e-9, 1.0, 1 + 1e-9, 1.1])
    found = ed.stability_map(case.eom, case.values, ("Omega", speeds), ("c", [1e-9, 0.05]))
    for j, c in enumerate(found.y[1]):
        for i, Omega in enumerate(speeds):
            judged = ed.stability(ed.linearize(case.eom, {}, {**case.values, "Omega": Omega, "c": c}))
            assert found.verdict[j, i] == judged.verdict
    assert found.verdict[1].tolist()[::4] == [STABLE, DIVERGENCE]


# ---------------------------------------------------------------- which equilibrium, and what is refused


def test_the_first_stable_equilibrium_where_zero_is_none():
    theta, load, c = *small.coordinates("theta"), *small.symbols("load c")
    tilted = ed.EquationsOfMotion.from_residuals(
        [theta.diff(small.T, 2) + c * theta.diff(small.T) + sm.sin(theta) - load], [theta]
    )
    plane = ("load", [0.3, 0.6, 0.99, 1.01]), ("c", [0.1])
    found = ed.stability_map(tilted, {"load": 0.5, "c": 0.1}, *plane)
    assert found.verdict.tolist() == [[STABLE, STABLE, STABLE, NONE]]
    np.testing.assert_allclose(found.states[0, :3, 0], np.arcsin(plane[0][1][:3]), rtol=1e-9)
    pendulum = small.pendulum()
    upright = ed.stability_map(
        pendulum.eom, pendulum.values, ("c", [0.0, 1.0]), ("g", [9.81]), at={"theta": math.pi}
    )
    assert upright.verdict.tolist() == [[DIVERGENCE, DIVERGENCE]]
    assert upright.shares == {DIVERGENCE: 1.0}
    assert "2 x 1 points: 100 % unstable (divergence)" in repr(upright)


def test_arguments_are_checked():
    system = ed.systems.load(11)
    eom, values = system.equations, system.values()
    P, c = ("P", [1.0, 2.0]), ("c_1", [0.0, 1.0])
    for x, y, message in [
        (("Q", [1.0]), c, "x names 'Q'"),
        (P, P, "both P"),
        (("P", []), c, "at least one"),
        (P, ("c_1", [math.nan]), "must be finite"),
        ("P", c, "give \\(parameter name"),
        (P, ("c_1", [[1.0]]), "in one row"),
    ]:
        with pytest.raises(ed.EngdynError, match=message):
            ed.stability_map(eom, values, x, y)
    with pytest.raises(ed.EngdynError, match="no equilibrium"):
        ed.stability_map(eom, values, P, c, at={"theta1": 0.3})
    with pytest.raises(ed.EngdynError, match="give an Equilibrium"):
        ed.stability_map(eom, values, P, c, at=3)
    with pytest.raises(ed.EngdynError, match="singular mass matrix"):
        ed.stability_map(eom, values, ("m_2", [0.0, 1.0]), c)


def test_only_equations_of_motion_have_a_map():
    mast = ed.systems.load("S11")
    with pytest.raises(ed.EngdynError, match="give EquationsOfMotion"):
        ed.stability_map(mast, mast.values(), ("P", [1.0, 2.0]), ("c_1", [0.1]))
