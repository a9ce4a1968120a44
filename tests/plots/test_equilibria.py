"""Equilibria on the drawing, over the energy and along a parameter."""

from __future__ import annotations

import math

import numpy as np
import pytest

import engdyn as ed
from engdyn.plots.axes import MARKS
from engdyn.plots.energy import effective_potential

S03, S07, S23 = (ed.systems.load(number) for number in (3, 7, 23))


def governor_angle(Omega):
    """Closed form: m l Omega^2 cos = (m + M_c) g + 2 k l (1 - cos) for theta other than zero."""
    v = S03.values()
    cosine = ((v["m"] + v["M_c"]) * v["g"] + 2 * v["k"] * v["l"]) / (
        v["m"] * v["l"] * Omega**2 + 2 * v["k"] * v["l"]
    )
    return np.arccos(np.minimum(cosine, 1.0))


CRITICAL = math.sqrt((1.2 + 3.0) * 9.81 / (1.2 * 0.25))


@pytest.fixture(scope="module")
def governor_branches():
    return ed.continue_equilibria(S03.equations, S03.values(), "Omega", (5.0, 30.0), bounds=S03.bounds)


# Poses


def test_poses_are_told_with_their_verdicts():
    ax = ed.plots.equilibrium_poses(S03, S03.equilibria())
    words = ed.plots.alt(ax)
    assert "3 equilibria drawn on top of each other" in words
    assert "theta = 0.7727 rad (44.3°) (asymptotically stable)" in words
    assert "theta = 0 rad (unstable, divergence)" in words


def test_unstable_poses_are_broken_and_unfilled_stable_ones_solid():
    ax = ed.plots.equilibrium_poses(S07, S07.equilibria())
    broken = [c for c in ax.collections if any(dash is not None for _, dash in c.get_linestyle())]
    solid = [c for c in ax.collections if c not in broken]
    assert broken
    assert solid
    assert all(np.all(c.get_facecolor()[:, 3] == 0.0) for c in broken if len(c.get_facecolor()))
    # The unstable container is the only large body above the rail.
    assert max(p.vertices[:, 1].max() for c in broken for p in c.get_paths()) == pytest.approx(9.0 * 1.13)
    assert min(p.vertices[:, 1].min() for c in solid for p in c.get_paths()) == pytest.approx(-9.0 * 1.13)


def test_poses_are_labeled_by_what_differs():
    ax = ed.plots.equilibrium_poses(S07, S07.equilibria())
    assert sorted(text.get_text() for text in ax.texts) == [
        "θ = 0°\nstable",
        "θ = 180°\nunstable",
    ]


def test_many_poses_are_numbered():
    crane = list(S07.equilibria())
    ax = ed.plots.equilibrium_poses(S07, [*crane, *crane, *crane], judged=["marginal"] * 6)
    assert sorted(text.get_text() for text in ax.texts) == ["1", "2", "3", "4", "5", "6"]


def test_verdicts_that_are_known_are_not_judged_again(monkeypatch):
    monkeypatch.setattr("engdyn.plots.equilibria.verdicts", lambda *_: pytest.fail("judged again"))
    ax = ed.plots.equilibrium_poses(S07, S07.equilibria(), judged=["marginal", "unstable (divergence)"])
    assert "(marginal)" in ed.plots.alt(ax)


def test_no_equilibrium_is_said():
    with pytest.raises(ed.EngdynError, match="no equilibrium was found"):
        ed.plots.equilibrium_poses(S07, [])


# Energy


def test_curve_is_the_potential_energy_of_the_model():
    ax = ed.plots.potential_energy(S07)
    x, y = ax.lines[0].get_data()
    assert y == pytest.approx(-2500 * 9.81 * 9.0 * np.cos(x))
    assert (x[0], x[-1]) == pytest.approx((-math.pi, math.pi))
    assert ax.get_xlabel() == r"$\theta$ [rad]"
    assert ax.get_ylabel() == "$V$ [J]"
    assert "π" in ax.xaxis.get_major_formatter()(math.pi, 0)


def test_at_constant_speed_the_effective_potential_is_stationary_at_the_steady_motions():
    ax = ed.plots.potential_energy(S03, equilibria=S03.equilibria())
    assert ax.get_ylabel() == "$V - T_0$ [J]"
    energy, _ = effective_potential(S03, S03.values())
    for theta in (0.0, governor_angle(18.0), -governor_angle(18.0)):
        slope = (energy(np.array([theta + 1e-5])) - energy(np.array([theta - 1e-5]))) / 2e-5
        assert slope == pytest.approx(0.0, abs=1e-6)
    # Independent of the package: V - T0 of the governor, by hand.
    v, theta = S03.values(), 0.3
    by_hand = (
        -2 * (v["m"] + v["M_c"]) * v["g"] * v["l"] * math.cos(theta)
        + 2 * v["k"] * (v["l"] * (1 - math.cos(theta))) ** 2
        - v["m"] * (v["l"] * v["Omega"] * math.sin(theta)) ** 2
    )
    assert energy(np.array([theta])) == pytest.approx(by_hand)


def test_equilibria_are_marked_on_the_curve_by_their_stability():
    ax = ed.plots.potential_energy(S03, equilibria=S03.equilibria())
    curve, stable, unstable = ax.lines
    assert sorted(stable.get_xdata()) == pytest.approx([-governor_angle(18.0), governor_angle(18.0)])
    assert unstable.get_xdata() == pytest.approx([0.0])
    assert unstable.get_markerfacecolor() == "white"
    for marks in (stable, unstable):
        assert np.interp(marks.get_xdata(), *curve.get_data()) == pytest.approx(marks.get_ydata(), rel=1e-3)
    assert [text.get_text() for text in ax.get_legend().get_texts()] == ["stable", "unstable"]
    words = ed.plots.alt(ax)
    assert "effective potential V − T₀ in J over theta [rad]" in words
    assert "theta = 0.7727 rad (44.3°), −24.58 J, stable" in words


def test_without_speed_there_is_no_effective_potential():
    assert ed.plots.potential_energy(S07).get_ylabel().startswith("$V$")


def test_contours_of_two_coordinates():
    equilibria = S23.equilibria()
    tilt = ("theta", np.linspace(-0.3, 0.3, 41))
    ax = ed.plots.potential_energy(S23, x="z", y=tilt, equilibria=equilibria)
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("$z$ [m]", r"$\theta$ [rad]")
    bar = ax.figure.axes[1]
    assert bar.get_ylabel() == "$V$ [J]"
    assert ax.get_ylim() == pytest.approx((-0.3, 0.3))
    (marks,) = ax.lines
    assert marks.get_xydata()[0] == pytest.approx(equilibria[0].q[:2])
    # The lowest contour surrounds the stable equilibrium.
    energy, _ = effective_potential(S23, S23.values())
    around = np.tile(equilibria[0].q, (8, 1))
    around[:, :2] += 0.05 * np.array([(math.cos(a), math.sin(a)) for a in np.arange(8) * math.pi / 4])
    assert np.all(energy(around) > energy(equilibria[0].q))


def test_the_other_coordinates_are_held_where_told():
    low, high = (
        ed.plots.potential_energy(S23, x=("z", [-0.1, 0.1]), at=[0, 0, zf, 0]).lines[0].get_ydata()
        for zf in (0.0, 0.1)
    )
    v = S23.values()
    z = np.array([-0.1, 0.1])
    difference = 0.5 * v["k_f"] * ((z - 0.1) ** 2 - z**2) + 0.5 * v["k_tf"] * 0.01 + v["m_f"] * v["g"] * 0.1
    assert high - low == pytest.approx(difference)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"x": "phi"}, "no coordinate 'phi'"),
        ({"x": "theta", "y": "theta"}, "choose two coordinates"),
        ({"x": ("theta", [1.0])}, "at least two finite values"),
        ({"x": ("theta", [1.0, math.nan])}, "at least two finite values"),
        ({"at": [0.0]}, "coordinates x, theta"),
        ({"values": {"L": -1.0}}, "greater than zero"),
    ],
)
def test_bad_arguments_are_named(arguments, message):
    with pytest.raises(ed.EngdynError, match=message):
        ed.plots.potential_energy(S07, **arguments)


# Branches


def test_branches_follow_the_closed_form(governor_branches):
    ax = ed.plots.branches(governor_branches, "theta", system=S03)
    stable, unstable = ax.lines[0].get_xydata(), ax.lines[1].get_xydata()
    for line in (stable, unstable):
        points = line[np.all(np.isfinite(line), axis=1)]
        bent = points[abs(points[:, 1]) > 1e-6]
        assert abs(bent[:, 1]) == pytest.approx(governor_angle(bent[:, 0]), abs=1e-6)
    straight = unstable[np.all(np.isfinite(unstable), axis=1)]
    assert straight[:, 1] == pytest.approx(np.zeros(len(straight)), abs=1e-9)
    assert straight[:, 0].min() == pytest.approx(CRITICAL, abs=0.5)


def test_stable_branches_are_solid_and_unstable_ones_broken(governor_branches):
    ax = ed.plots.branches(governor_branches, "theta", system=S03)
    solid, broken = ax.lines[:2]
    assert (solid.get_linestyle(), broken.get_linestyle()) == ("-", "--")
    assert (solid.get_color(), broken.get_color()) == (MARKS[True]["color"], MARKS[False]["color"])
    for line, kind in ((solid, True), (broken, False)):
        points = line.get_xydata()[np.all(np.isfinite(line.get_xydata()), axis=1)]
        for Omega, theta in points[abs(points[:, 0] - CRITICAL) > 1e-3]:
            # Below the critical speed all is stable; above it only the upright arms are not.
            assert bool(Omega < CRITICAL or abs(theta) > 1e-6) == kind


def test_the_pitchfork_is_marked_and_labeled(governor_branches):
    ax = ed.plots.branches(governor_branches, "theta", system=S03)
    diamonds = [line for line in ax.lines if line.get_marker() == "D"]
    assert [line.get_xydata()[0].tolist() for line in diamonds] == [pytest.approx([CRITICAL, 0.0], abs=1e-6)]
    assert [text.get_text() for text in ax.texts] == ["pitchfork"]


def test_branch_axes_carry_units_and_words_carry_numbers(governor_branches):
    ax = ed.plots.branches(governor_branches, "theta", system=S03)
    assert ax.get_xlabel() == r"$\Omega$ [rad/s]"
    assert ax.get_ylabel() == r"$\theta$ [rad]"
    assert ax.get_xlim() == (5.0, 30.0)
    words = ed.plots.alt(ax)
    assert "3 branches" in words
    assert "Pitchfork at Omega = 11.72 rad/s" in words
    assert words.count(", stable.") == 2


def test_unknown_coordinate_of_a_branch_is_named(governor_branches):
    with pytest.raises(ed.EngdynError, match="no coordinate 'phi'; choose one of theta"):
        ed.plots.branches(governor_branches, "phi", system=S03)
