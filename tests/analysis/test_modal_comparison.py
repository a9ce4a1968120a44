"""The modal assurance criterion, and modes followed over a parameter (pitfall 18)."""

from __future__ import annotations

import numpy as np
import pytest
import sympy as sm
from sympy.physics.mechanics import dynamicsymbols

import engdyn as ed
from analysis.test_modes import random_system

S12, S15 = ed.systems.load("S12"), ed.systems.load("S15")


# ---------------------------------------------------------------- mac


def test_mac_is_the_squared_cosine_blind_to_scale_and_phase():
    a, b = np.array([1.0, 2.0, -1.0]), np.array([0.5, 1.0, 3.0])
    cosine = a @ b / np.linalg.norm(a) / np.linalg.norm(b)
    assert ed.mac(a, b) == pytest.approx(cosine**2)
    assert ed.mac(a, -7j * np.exp(0.3j) * a) == pytest.approx(1)
    assert ed.mac([1, 1j], [1, -1j]) == pytest.approx(0), "forward and backward whirl are orthogonal"
    assert ed.mac(np.eye(3), a).ravel() == pytest.approx([1 / 6, 4 / 6, 1 / 6])
    assert ed.mac(np.eye(3)[:, :2], np.eye(3)).tolist() == [[1, 0, 0], [0, 1, 0]]


def test_mac_with_the_mass_matrix_separates_modes_in_any_units():
    mass, _, stiffness = random_system(4)
    scale = np.diag([1e3, 1.0, 57.3, 1e-2])
    shapes = np.linalg.eig(np.linalg.solve(mass, stiffness))[1]
    assert np.max(ed.mac(shapes, shapes) - np.eye(4)) > 0.01, "modes are orthogonal with respect to M only"
    for unit in (np.eye(4), scale):
        inverse = np.linalg.inv(unit)
        found = ed.mac(unit @ shapes, unit @ shapes, inverse @ mass @ inverse)
        np.testing.assert_allclose(found, np.eye(4), atol=1e-10)


@pytest.mark.parametrize(
    ("a", "b", "weight", "message"),
    [
        ([1, 2], [1, 2, 3], None, "do not go together"),
        ([0, 0], [1, 2], None, "zero or not finite"),
        ([1, np.nan], [1, 2], None, "zero or not finite"),
        ([1, 2], [1, 2], np.eye(3), "weight has shape"),
        ([1, 2], [1, 2], -np.eye(2), "not positive definite"),
        ([[[1, 2]]], [1, 2], None, "do not go together"),
    ],
)
def test_what_has_no_mac(a, b, weight, message):
    with pytest.raises(ed.EngdynError, match=message):
        ed.mac(a, b, weight)


# ---------------------------------------------------------------- branches


def two_oscillators(coupling=0.0):
    """One stiffness grows, the other does not; without coupling their frequencies cross."""
    x, y = dynamicsymbols("x y")
    t, s = dynamicsymbols._t, sm.Symbol("s")
    pull = sm.Rational(coupling) * (x - y)
    return ed.EquationsOfMotion.from_residuals(
        [x.diff(t, 2) + s * x + pull, y.diff(t, 2) + 4 * y - pull], [x, y]
    )


@pytest.mark.parametrize("sweep", [np.linspace(1, 9, 33), np.linspace(9, 1, 33), [1.0, 3.99, 4.0, 9.0]])
def test_branches_cross_where_sorting_would_interchange_them(sweep):
    found = ed.track_modes(two_oscillators(), {}, ("s", sweep))
    assert 4.0 in np.asarray(sweep), "the crossing itself, where the shapes are arbitrary, is a point"
    own = {float(f): k for k, f in enumerate(found.natural_frequency[0])}
    k = own[min(own)] if sweep[0] == 1 else own[max(own)]  # the branch of x
    np.testing.assert_allclose(found.natural_frequency[:, k], np.sqrt(sweep) / (2 * np.pi), rtol=1e-12)
    np.testing.assert_allclose(found.natural_frequency[:, 1 - k], 2 / (2 * np.pi), rtol=1e-12)
    np.testing.assert_allclose(found.shapes[:, 1, k], 0, atol=1e-12)
    assert np.any(np.sort(found.natural_frequency, axis=1) != found.natural_frequency)


def test_coupled_branches_veer_and_exchange_their_shapes():
    found = ed.track_modes(two_oscillators(0.5), {}, ("s", np.linspace(1, 9, 81)))
    assert np.all(np.diff(found.natural_frequency, axis=1) > 0), "coupled, they never meet"
    first, last = np.abs(found.shapes[0]), np.abs(found.shapes[-1])
    assert np.argmax(first, axis=0).tolist() == [0, 1]
    assert np.argmax(last, axis=0).tolist() == [1, 0]


def test_the_campbell_diagram_of_the_rotor_has_its_closed_form():
    """Without damping A ω² ∓ CΩω − (k − mgl) = 0; at Ω = 0 both have one frequency."""
    speeds = np.linspace(0, 60, 61)
    values = {**S15.values(), "c_a": 0.0, "c_b": 0.0}
    found = ed.track_modes(S15.equations, values, ("Omega", speeds))
    assert found.eigenvalues.shape == (61, 2)
    gyro, stiff = values["C"] * speeds, 4 * values["A"] * (60 - 5 * 9.81 * 0.15)
    roots = np.sqrt(gyro**2 + stiff)
    sense = found.whirl("alpha", "beta")
    np.testing.assert_allclose(np.abs(sense), 1, atol=1e-9)
    forward = int(np.argmax(sense[-1]))
    np.testing.assert_allclose(sense[:, forward], 1, atol=1e-9)
    expected = (roots + gyro) / (2 * values["A"]) / (2 * np.pi)
    np.testing.assert_allclose(found.damped_frequency[:, forward], expected, rtol=1e-9)
    expected = (roots - gyro) / (2 * values["A"]) / (2 * np.pi)
    np.testing.assert_allclose(found.damped_frequency[:, 1 - forward], expected, rtol=1e-9)
    with pytest.raises(ed.EngdynError, match="no coordinate 'x'"):
        found.whirl("x", "beta")


def test_frequencies_come_together_before_the_wing_flutters():
    """Exercise 6.10: 20.3343 m/s; beyond divergence, 57.14 m/s, some eigenvalues are real."""
    speeds = np.linspace(1, 25, 97)
    found = ed.track_modes(S12.equations, S12.values(), ("U", speeds))
    gap = np.diff(found.damped_frequency, axis=1)[:, 0]
    assert np.all(np.diff(np.abs(gap)) < 0)
    assert np.all(found.damping_ratio[:, 0] > 0)
    ratio = found.damping_ratio[:, 1]
    assert np.interp(0, -ratio, speeds) == pytest.approx(20.3343, abs=2e-3)
    for k in (0, 50, 96):
        linear = ed.linearize(S12.equations, {}, {**S12.values(), "U": speeds[k]})
        np.testing.assert_allclose(
            np.sort_complex(found.eigenvalues[k]),
            np.sort_complex(ed.damped_modes(linear).eigenvalues),
            rtol=1e-9,
        )


def test_pairs_that_become_real_are_followed_one_by_one():
    found = ed.track_modes(S12.equations, S12.values(), ("U", np.linspace(40, 60, 81)))
    assert found.eigenvalues.shape == (81, 4)
    divergence = [(z.imag == 0) & (z.real > 0) for z in found.eigenvalues[-1]]
    flutter = [(z.imag != 0) & (z.real > 0) for z in found.eigenvalues[-1]]
    assert (sum(divergence), sum(flutter)) == (1, 2)
    for k in (0, 40, 80):
        linear = ed.linearize(S12.equations, {}, {**S12.values(), "U": np.linspace(40, 60, 81)[k]})
        np.testing.assert_allclose(
            np.sort_complex(found.eigenvalues[k]), np.sort_complex(ed.eigenvalues(linear)), rtol=1e-8
        )


def test_the_state_may_change_with_the_parameter():
    """The bar's angle in a spinning pair of arms: S03 above its critical speed."""
    governor = ed.systems.load("S03")
    speeds = np.linspace(14, 22, 9)
    states = [max(governor.equilibria(governor.values(Omega=w)), key=lambda e: e.q[0]) for w in speeds]
    angle = np.array([e.q[0] for e in states])
    found = ed.track_modes(governor.equations, governor.values(), ("Omega", speeds), {"theta": angle})
    expected = [ed.damped_modes(ed.linearize(governor.equations, e)).eigenvalues[0] for e in states]
    np.testing.assert_allclose(found.eigenvalues[:, 0], expected, rtol=1e-7)
    with pytest.raises(ed.EngdynError, match="not in equilibrium"):
        ed.track_modes(governor.equations, governor.values(), ("Omega", speeds), states[0])
    one = ed.track_modes(governor.equations, governor.values(), ("k", [150.0, 160.0]), {"theta": 0.0})
    assert "ModeBranches" in repr(one)


@pytest.mark.parametrize(
    ("x", "at", "message"),
    [
        (("V", [1, 2]), None, "unknown parameter 'V'"),
        (("U", [1.0]), None, "at least two finite"),
        (("U", [1.0, np.nan]), None, "at least two finite"),
        (("U", [1.0, 3.0, 2.0]), None, "rise or fall"),
        (3, None, "give \\(parameter name, array of values\\)"),
        (("U", [1, 2]), {"beta": 0.0}, "numbers or arrays for y, alpha"),
        (("U", [1, 2]), {"alpha": [0.0, 0.0, 0.0]}, "one for each of the 2 values"),
        (("U", [1, 2]), {"alpha": 0.1}, "not in equilibrium"),
        (("U", [1, 2]), S15.equilibria()[0], "at has the coordinates alpha, beta"),
    ],
)
def test_arguments_that_make_no_sweep(x, at, message):
    with pytest.raises(ed.EngdynError, match=message):
        ed.track_modes(S12.equations, S12.values(), x, at)


def test_only_equations_of_motion_can_be_swept():
    with pytest.raises(ed.EngdynError, match="give EquationsOfMotion"):
        ed.track_modes(S12, S12.values(), ("U", [1, 2]))


@pytest.mark.parametrize("shapes", [[[1.0, 2.0], [1.0]], "xy", ["a", "b"]])
def test_mac_of_what_is_no_array_of_numbers(shapes):
    for arguments in ((shapes, np.ones(2)), (np.ones(2), shapes), (np.ones(2), np.ones(2), shapes)):
        with pytest.raises(ed.EngdynError, match="mac: a and b must be arrays of numbers"):
            ed.mac(*arguments)


def test_a_place_in_words_is_no_place():
    with pytest.raises(ed.EngdynError, match="must be one finite number"):
        ed.track_modes(S12.equations, S12.values(), ("U", [1, 2]), {"alpha": "flat"})
