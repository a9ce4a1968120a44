"""Complex modes: against the state matrix, its exponential and closed forms (pitfalls 18 to 20)."""

from __future__ import annotations

import warnings
from math import pi, sqrt

import numpy as np
import pytest
import scipy.linalg

import engdyn as ed
from analysis.linear_of import linear_of, linearized
from analysis.test_modes import in_other_units, random_system

OSCILLATING = ["S10", "S11", "S12", "S14", "S15", "S19", "S20", "S21", "S23", "W7", "W8"]


# ---------------------------------------------------------------- eigenvalues and eigenvectors


@pytest.mark.parametrize("key", [*OSCILLATING, "S07", "S13", "S16", "S18"])
def test_pairs_and_real_eigenvalues_together_are_those_of_the_state_matrix(key):
    linear = linearized(key)
    found = ed.damped_modes(linear)
    together = np.concatenate([found.eigenvalues, found.eigenvalues.conj(), found.real_eigenvalues])
    expected = scipy.linalg.eigvals(linear.state_matrix)
    gaps = np.abs(together[:, None] - expected)
    assert len(together) == len(expected)
    assert max(gaps.min(axis=0).max(), gaps.min(axis=1).max()) < 1e-6 * np.max(np.abs(expected))
    assert np.all(np.diff(found.natural_frequency) >= 0)
    assert np.all(np.diff(found.real_eigenvalues) <= 0)
    right, left = found.state_shapes, found.left_shapes
    size = np.linalg.norm(linear.state_matrix, 2) * np.linalg.norm(right, axis=0)
    assert np.all(np.abs(linear.state_matrix @ right - right * found.eigenvalues) < 1e-12 * size)
    np.testing.assert_allclose(left.T @ right, np.eye(len(found.eigenvalues)), atol=1e-12)
    np.testing.assert_allclose(left.T @ right.conj(), 0, atol=1e-12)
    assert not found.defective.any()


@pytest.mark.parametrize("key", ["S10", "S12", "S15", "S23"])
def test_modal_coordinates_rebuild_the_free_motion(key):
    """x(t) = Σ 2 Re (xₖ wₖᵀx₀ e^{λₖt}) is exp(A t) x₀ where everything oscillates."""
    linear = linearized(key)
    found, start, t = ed.damped_modes(linear), np.arange(1.0, 1 + len(linear.state_matrix)), 0.07
    sums = 2 * ((found.state_shapes * np.exp(found.eigenvalues * t)) @ (found.left_shapes.T @ start)).real
    expected = scipy.linalg.expm(linear.state_matrix * t) @ start
    np.testing.assert_allclose(sums, expected, rtol=1e-9, atol=1e-9 * np.max(np.abs(expected)))


def test_shapes_are_normalized_and_turned_as_those_of_undamped_modes():
    linear = linearized("S23")
    shapes = ed.damped_modes(linear).shapes
    np.testing.assert_allclose(np.einsum("ik,ij,jk->k", shapes.conj(), linear.mass, shapes), 1, rtol=1e-12)
    mass, _, stiffness = random_system(3)
    undamped = linear_of(mass, np.zeros((4, 4)), stiffness)
    found = ed.damped_modes(undamped)
    np.testing.assert_allclose(found.shapes, ed.modes(undamped).shapes, atol=1e-9)
    np.testing.assert_allclose(found.damping_ratio, 0, atol=1e-12)


# ---------------------------------------------------------------- damping ratios (pitfall 20)


def test_the_damping_ratio_is_that_of_the_oscillator():
    """ζ = c/(2√(km)), also where −Re λ/Im λ would be far off."""
    found = ed.damped_modes(linear_of([[2.0]], [[14.0]], [[50.0]]))
    np.testing.assert_allclose(found.damping_ratio, [14 / (2 * sqrt(100))], rtol=1e-14)
    np.testing.assert_allclose(found.natural_frequency, [5 / (2 * pi)], rtol=1e-14)
    np.testing.assert_allclose(found.damped_frequency, [5 * sqrt(1 - 0.49) / (2 * pi)], rtol=1e-14)
    wrong = -found.eigenvalues.real / found.eigenvalues.imag
    assert abs(wrong[0] - 0.7) > 0.2


def test_worked_example_w8():
    found = ed.damped_modes(linearized("W8"))
    np.testing.assert_allclose(found.damping_ratio, [0.04701, 0.03815], atol=6e-6)
    np.testing.assert_allclose(found.neglecting_coupling.damping_ratio, [0.04648, 0.03861], atol=6e-6)
    ratio = found.shapes[1] / found.shapes[0]
    np.testing.assert_allclose(ratio, [-0.287 + 0.395j, 2.78 + 4.68j], rtol=2e-3)
    np.testing.assert_allclose(found.phases[1] - found.phases[0], np.angle(ratio), atol=1e-12)
    assert "ζ = 0.04701" in repr(found)
    assert "∠ 126.0°" in found._repr_html_()
    assert "-0.0°" not in found._repr_html_(), "what is zero but for rounding has no sign"


@pytest.mark.parametrize(("key", "index"), [("S10", 0.338), ("S21", 0.055), ("S23", 1.075)])
def test_published_indices_of_classicality(key, index):
    assert ed.damped_modes(linearized(key)).classicality == pytest.approx(index, abs=6e-4)


def test_classical_damping_has_the_index_zero_and_nothing_to_neglect():
    mass, _, stiffness = random_system(2)
    series = 0.3 * mass + 1e-3 * stiffness + 2e-6 * stiffness @ np.linalg.solve(mass, stiffness)
    linear = linear_of(mass, series, stiffness)
    found = ed.damped_modes(linear)
    assert found.classicality == pytest.approx(0, abs=1e-12)
    np.testing.assert_allclose(found.neglecting_coupling.eigenvalues, found.eigenvalues, rtol=1e-9)
    np.testing.assert_allclose(found.natural_frequency, ed.modes(linear).natural_frequency, rtol=1e-9)
    assert ed.damped_modes(linear_of(mass, np.zeros((4, 4)), stiffness)).classicality == 0.0
    other = ed.damped_modes(in_other_units(linear, [1e3, 1, 1, 60]))
    assert other.classicality == pytest.approx(0, abs=1e-9), "classical damping is so in any units"


@pytest.mark.parametrize("key", ["S10", "S21", "S23"])
def test_neglecting_coupling_takes_the_diagonal_of_the_modal_damping(key):
    linear = linearized(key)
    undamped, found = ed.modes(linear), ed.damped_modes(linear)
    omega = 2 * pi * undamped.natural_frequency
    ratios = np.diag(undamped.modal_damping) / (2 * omega)
    np.testing.assert_allclose(found.neglecting_coupling.damping_ratio, ratios, rtol=1e-9)
    np.testing.assert_allclose(
        found.neglecting_coupling.natural_frequency, undamped.natural_frequency, rtol=1e-9
    )
    assert found.neglecting_coupling.classicality == pytest.approx(0, abs=1e-9)
    assert np.max(np.abs(found.damping_ratio - ratios)) > 1e-4, "the coupling of this system counts"


def test_neglecting_coupling_with_rigid_body_modes():
    found = ed.damped_modes(linearized("S07"))
    uncoupled = found.neglecting_coupling
    np.testing.assert_allclose(uncoupled.real_eigenvalues, [0, -400 / 3700], rtol=1e-9, atol=0)
    np.testing.assert_allclose(found.real_eigenvalues, [0, -0.1089], atol=6e-5)
    assert len(ed.damped_modes(linearized("S07", c_x=0.0, c_h=0.0)).neglecting_coupling.real_eigenvalues) == 2


def test_the_question_has_no_meaning_for_unsymmetric_systems():
    for key in ("S12", "S13", "S15"):
        found = ed.damped_modes(linearized(key))
        assert found.classicality is None
        with pytest.raises(ed.EngdynError, match="use damped_modes"):
            _ = found.neglecting_coupling


# ---------------------------------------------------------------- gyroscopic, circulatory, nonholonomic


def test_the_spinning_rotor_whirls_in_circles():
    """A ω² ∓ CΩω − (k − mgl) = 0: forward and backward precession, phases of ±90 degrees."""
    found = ed.damped_modes(linearized("S15", c_a=0.0, c_b=0.0))
    A, spin, k = 0.12, 0.18 * 20.0, 60 - 5 * 9.81 * 0.15
    root = sqrt(spin**2 + 4 * A * k)
    expected = np.array([-spin + root, spin + root]) / (2 * A) / (2 * pi)
    np.testing.assert_allclose(found.natural_frequency, expected, rtol=1e-10)
    np.testing.assert_allclose(found.phases[1] - found.phases[0], [pi / 2, -pi / 2], atol=1e-8)
    np.testing.assert_allclose(found.whirl("alpha", "beta"), [-1, 1], atol=1e-9)
    np.testing.assert_allclose(found.whirl("beta", "alpha"), [1, -1], atol=1e-9)
    with pytest.raises(ed.EngdynError, match="no coordinate 'x': choose two of alpha, beta"):
        found.whirl("alpha", "x")


def test_a_nonholonomic_system_has_modes_of_its_state():
    found = ed.damped_modes(linearized("S13"))
    n = len(found.coordinates)
    assert found.shapes.shape == (n, 1)
    np.testing.assert_allclose(found.natural_frequency, [9.8425], rtol=1e-5)
    np.testing.assert_allclose(np.linalg.norm(found.shapes, axis=0), 1, rtol=1e-12)


# ---------------------------------------------------------------- zeros and Jordan blocks (pitfalls 18, 19)


def test_a_free_mass_has_two_eigenvalues_zero_and_no_mode():
    found = ed.damped_modes(linear_of([[3.0]], [[0.0]], [[0.0]]))
    assert found.real_eigenvalues.tolist() == [0.0, 0.0]
    assert len(found.eigenvalues) == found.shapes.shape[1] == len(found.damping_ratio) == 0
    assert found.phases.shape == (1, 0)
    assert repr(found) == "DampedModes(real 0, 0 1/s)"


@pytest.mark.parametrize(("key", "changes"), [("S07", {"c_x": 0.0, "c_h": 0.0}), ("S20", {}), ("S18", {})])
def test_rigid_body_motion_is_exactly_zero_and_never_a_slow_vibration(key, changes):
    linear = linearized(key, **changes)
    found = ed.damped_modes(linear)
    neutral = ed.stability(linear).neutral
    assert neutral > 0
    assert np.count_nonzero(found.real_eigenvalues == 0) == neutral
    assert np.all(found.natural_frequency > 1e-3)
    assert np.all(np.isfinite([found.damping_ratio, found.natural_frequency]))


def test_equal_pendulums_have_independent_modes():
    found = ed.damped_modes(linear_of(2 * np.eye(2), 0.4 * np.eye(2), 50 * np.eye(2)))
    np.testing.assert_allclose(found.eigenvalues, [-0.1 + 1j * sqrt(24.99)] * 2, rtol=1e-12)
    np.testing.assert_allclose(found.left_shapes.T @ found.state_shapes, np.eye(2), atol=1e-12)
    np.testing.assert_allclose(np.abs(found.shapes), np.eye(2) / sqrt(2), atol=1e-12)
    assert not found.defective.any()


def test_nearly_equal_pendulums_keep_their_own_shapes():
    linear = linear_of(np.eye(2), 0.1 * np.eye(2), [[25 + 1e-6, -1e-6], [-1e-6, 25 + 1e-6]])
    found = ed.damped_modes(linear)
    np.testing.assert_allclose(ed.mac(found.shapes, [[1, 1], [1, -1]]), np.eye(2), atol=1e-6)
    np.testing.assert_allclose(found.left_shapes.T @ found.state_shapes, np.eye(2), atol=1e-9)


def test_shapes_that_coincide_are_told():
    """At the edge of flutter two modes have one shape: here one oscillator drives an equal one."""
    linear = linear_of(np.eye(2), np.zeros((2, 2)), [[9, 0], [-4, 9]])
    with pytest.warns(ed.EngdynWarning, match="modes 1, 2 share their shape"):
        found = ed.damped_modes(linear)
    assert found.defective.all()
    assert ed.mac(found.shapes[:, 0], found.shapes[:, 1]) == pytest.approx(1)
    assert np.all(np.isfinite(found.left_shapes))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        apart = ed.damped_modes(linear_of(np.eye(2), np.zeros((2, 2)), [[9, 0], [-4, 9.01]]))
    assert not apart.defective.any()


def test_critical_damping_is_a_double_real_eigenvalue():
    found = ed.damped_modes(linear_of([[1.0]], [[2.2]], [[1.21]]))
    np.testing.assert_allclose(found.real_eigenvalues, [-1.1, -1.1], atol=1e-7)
    assert len(found.eigenvalues) == 0


def test_other_arguments_are_refused():
    crane = ed.systems.load("S07")
    for wrong in (ed.linearize(crane.equations, {}, symbolic=True), crane, 3):
        with pytest.raises(ed.EngdynError, match="LinearSystem with numbers"):
            ed.damped_modes(wrong)
