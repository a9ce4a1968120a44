"""All equilibria: against brute force on the energies, closed forms, and the certificate's own claims."""

from __future__ import annotations

import dataclasses
import math
from math import pi

import numpy as np
import pytest
import sympy as sm
from hypothesis import given, settings
from hypothesis import strategies as st
from sympy.physics.mechanics import dynamicsymbols

import engdyn as ed
from analysis import small_systems as small

#: System, and how many brute-force starts per coordinate find all of its equilibria.
CASES = [
    (small.pendulum(), 0),
    (small.windy_pendulum(), 0),
    (small.hoop(), 0),
    (small.snap_through(), 0),
    (small.seismometer(), 0),
    (small.bar_on_slider(), 9),
    (small.two_wells(), 13),
    (small.elastic_pendulum(), 9),
    (small.sprung_double_pendulum(), 17),
    (small.isolator(), 5),
    (small.follower_mast(), 9),
    (small.carousel(), 15),
    (small.ship(), 9),
]


def found(case, values, **more):
    """Certified equilibria of a case as an array."""
    answer = ed.equilibria(case.eom, values, case.bounds, **more)
    assert answer.certified
    assert answer.undecided == ()
    assert all(e.residual < 1e-9 * (1 + max(map(abs, values.values()))) for e in answer)
    return np.array([e.q for e in answer]).reshape(-1, len(case.coordinates))


def varied(values, seed, spread=0.3):
    """Every parameter off by up to 30 percent."""
    random = np.random.default_rng(seed)
    return {k: float(f"{v * (1 + spread * random.uniform(-1, 1)):.4g}") for k, v in values.items()}


def in_order(case, q):
    region = [case.bounds.get(n, (-pi, pi)) for n in case.names]
    return small.distinct(list(q), region)


@pytest.mark.parametrize(("case", "starts"), CASES, ids=lambda x: str(x))
@pytest.mark.parametrize("seed", [None, 1, 2])
def test_finds_what_brute_force_finds(case, starts, seed):
    values = case.values if seed is None else varied(case.values, seed)
    expected = case.brute_force(values, starts)
    assert len(expected) > 0
    np.testing.assert_allclose(in_order(case, found(case, values)), expected, atol=2e-8)


@pytest.mark.parametrize("number", [3, 23])
@pytest.mark.parametrize("seed", range(6))
def test_the_catalogue_with_random_parameters(number, seed):
    case = small.of_catalogue(number)
    values = varied(case.values, seed, 0.5)
    system = ed.systems.load(number)
    answer = system.equilibria(values)
    assert answer.certified
    expected = case.brute_force(values, starts=3)
    np.testing.assert_allclose(in_order(case, [e.q for e in answer]), expected, atol=2e-8)


@pytest.mark.parametrize("seed", range(6))
def test_the_crane_in_constant_acceleration(seed):
    """Independent: in the frame of the trolley gravity and inertia force add up to a tilted gravity."""
    system, random = ed.systems.load(7), np.random.default_rng(seed)
    values = varied({k: v for k, v in system.values().items() if k != "c_x"}, seed) | {"c_x": 0.0}
    force = float(random.uniform(-2e4, 2e4))
    answer = system.equilibria(values, F=force)
    a = force / (values["M_t"] + values["m"])
    hanging = math.atan2(-a, values["g"])
    expected = sorted([hanging, hanging + pi if hanging <= 0 else hanging - pi])
    assert answer.certified
    assert answer.neutral == ("x",)
    np.testing.assert_allclose([e.q[1] for e in answer], expected, atol=1e-12)
    np.testing.assert_allclose([e.accelerations for e in answer], [[a, 0.0]] * 2, rtol=1e-12)


@settings(max_examples=30)
@given(st.floats(0.1, 10), st.floats(0.05, 2), st.floats(0.5, 30))
def test_bead_on_a_hoop_in_closed_form(m, R, Omega):
    case, g = small.hoop(), 9.81
    answer = ed.equilibria(case.eom, {"m": m, "R": R, "g": g, "c": 0.1, "Omega": Omega})
    share = g / (R * Omega**2)
    if abs(share - 1) < 1e-6:
        return  # at the pitchfork itself nothing is decided
    lifted = [math.acos(share)] if share < 1 else []
    expected = sorted([0.0, pi, *lifted, *(-x for x in lifted)])
    assert answer.certified
    np.testing.assert_allclose([e.q[0] for e in answer], expected, atol=1e-7)


def test_the_bar_on_the_slider():
    case = small.bar_on_slider()
    answer = ed.equilibria(case.eom, case.values, case.bounds)
    np.testing.assert_allclose([e.q for e in answer], [[-0.04905, 0.0], [-0.04905, pi]], atol=1e-12)
    without_bounds = ed.equilibria(case.eom, case.values)  # s occurs linearly: no bounds needed
    np.testing.assert_array_equal([e.q for e in without_bounds], [e.q for e in answer])


def test_pendulum_of_the_worked_example_has_its_upright_position_once():
    """θ = π lies on both edges of the region."""
    case = small.pendulum()
    for bounds in (None, {"theta": (-pi, pi)}, {"theta": (-np.pi, np.pi)}):
        answer = ed.equilibria(case.eom, case.values, bounds)
        assert [e.q[0] for e in answer] == [0.0, pi]
        assert answer.certified


@pytest.mark.parametrize(
    ("bounds", "expected"),
    [
        ((0.0, 2 * pi), [pi, 2 * pi]),  # one turn: the lower end is the upper end again
        ((-2 * pi, 2 * pi), [-2 * pi, -pi, 0.0, pi, 2 * pi]),  # two turns are not one
        ((0.0, pi), [0.0, pi]),
        ((-1.0, 0.0), [0.0]),
        ((0.5, 3.0), []),
    ],
)
def test_roots_on_the_edge(bounds, expected):
    case = small.pendulum()
    answer = ed.equilibria(case.eom, case.values, {"theta": bounds})
    np.testing.assert_allclose([e.q[0] for e in answer], expected, atol=1e-12)
    assert answer.certified


def test_a_root_of_a_linear_equation_on_and_beyond_the_edge():
    case = small.isolator()
    sag = -(150.0 + 400.0) * 9.81 / 6e5
    for low, count in ((sag, 1), (sag + 1e-9, 0), (sag - 1e-9, 1)):
        answer = ed.equilibria(case.eom, case.values, {"y1": (low, 0.1), "y2": (-0.1, 0.1)})
        assert len(answer) == count
        assert answer.certified


@pytest.mark.parametrize("power", [4, 6])
def test_a_multiple_root_is_undecided_not_guessed(power):
    (x,) = small.coordinates("x")
    case = small.normal_form(x**power, "flat")
    answer = ed.equilibria(case.eom, {}, case.bounds)
    assert not answer.certified
    assert len(answer) == 0
    assert any(low <= 0 <= high for ((low, high),) in answer.undecided)
    assert all(max(abs(low), abs(high)) < 1e-3 for ((low, high),) in answer.undecided)
    assert "not certified" in repr(answer)
    assert "undecided" in answer._repr_html_()


def test_a_pitchfork_point_is_undecided_and_the_rest_is_found():
    case = small.hoop()
    answer = ed.equilibria(case.eom, {"m": 1.0, "R": 1.0, "g": 9.0, "c": 0.1, "Omega": 3.0})
    assert not answer.certified
    assert [e.q[0] for e in answer] == [pi]


def certified_sets():
    for case in (small.hoop(), small.snap_through(), small.two_wells(), small.carousel(), small.isolator()):
        yield case.name, ed.equilibria(case.eom, case.values, case.bounds)
    for number in (3, 7, 23):
        yield f"S{number:02d}", ed.systems.load(number).equilibria()


@pytest.mark.parametrize(
    ("name", "answer"), list(certified_sets()), ids=lambda x: x if isinstance(x, str) else ""
)
def test_the_certificate_covers_the_region_and_needs_every_accepted_box(name, answer):
    certificate = answer.certificate
    assert certificate.covers()
    assert len(certificate.accepted) >= len(answer) > 0
    for i in range(len(certificate.accepted)):
        fewer = (*certificate.accepted[:i], *certificate.accepted[i + 1 :])
        assert not dataclasses.replace(certificate, accepted=fewer).covers()


def test_every_root_lies_in_exactly_one_accepted_box():
    case = small.sprung_double_pendulum()
    answer = ed.equilibria(case.eom, case.values, case.bounds)
    assert answer.unknowns == ("theta1", "theta2")
    for e in answer:
        inside = [
            all(a <= x <= b for x, (a, b) in zip(e.q, box, strict=True))
            for box in answer.certificate.accepted
        ]
        assert sum(inside) == 1


def test_a_false_root_at_a_coordinate_singularity_is_left_out():
    """S17: at α = ±π/2 the equations vanish where the coordinates do; no seat rests there."""
    case = small.carousel()
    for e in ed.equilibria(case.eom, case.values, {"alpha": (-pi / 2, pi / 2)}):
        assert abs(abs(e.q[0]) - pi / 2) > 0.1


def test_equilibria_behave_like_a_sequence_and_show_themselves():
    answer = ed.systems.load(3).equilibria()
    assert len(answer) == len(list(answer)) == 3
    assert answer[0] is answer.items[0]
    assert [e.q[0] for e in answer] == sorted(e.q[0] for e in answer)
    np.testing.assert_allclose(answer[2].q, [0.77269], atol=5e-6)
    assert repr(answer).splitlines()[0] == "3 equilibria (certified: there are no others in the region)"
    assert repr(answer[1]) == "Equilibrium(theta = 0)"
    html = answer._repr_html_()
    assert html.count("<tr>") == 4
    assert "0.77269" in html
    assert answer[0].values == ed.systems.load(3).values()


def test_repeating_a_search_gives_the_same_bits():
    case = small.sprung_double_pendulum()
    first, second = (ed.equilibria(case.eom, case.values, case.bounds) for _ in range(2))
    np.testing.assert_array_equal([e.q for e in first], [e.q for e in second])


def test_a_coordinate_becomes_neutral_where_nothing_depends_on_it():
    case = small.pendulum()
    answer = ed.equilibria(case.eom, {**case.values, "g": 0.0})
    assert answer.neutral == ("theta",)
    assert [e.q[0] for e in answer] == [0.0]
    assert "neutral: theta" in repr(answer)


def test_an_angle_inside_a_root_wraps_too():
    """A spring between the tip of a crank and a fixed point: theta = pi is one state, not two."""
    theta = dynamicsymbols("theta")
    m, r, d, k, rest = sm.symbols("m r d k L_0", positive=True)
    stretch = sm.sqrt(r**2 + d**2 - 2 * r * d * sm.cos(theta)) - rest
    crank = ed.lagrange(m * r**2 * theta.diff() ** 2 / 2, k * stretch**2 / 2, [theta])
    found = ed.equilibria(crank, {"m": 1.0, "r": 0.3, "d": 0.5, "k": 100.0, "L_0": 0.6})
    relaxed = np.arccos((0.3**2 + 0.5**2 - 0.6**2) / (2 * 0.3 * 0.5))
    assert found.certified
    assert [e.q[0] for e in found] == pytest.approx([-relaxed, 0.0, relaxed, np.pi], abs=1e-9)
