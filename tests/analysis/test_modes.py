"""Undamped modes: against the state matrix, closed forms of chains, and invariances (pitfalls 18, 19 and 21)."""

from __future__ import annotations

from dataclasses import replace
from math import pi

import numpy as np
import pytest
import scipy.linalg

import engdyn as ed
from analysis.linear_of import linear_of, linearized


def random_system(seed, n=4):
    rng = np.random.default_rng(seed)
    a, b, c = rng.normal(size=(3, n, n))
    return a @ a.T + np.eye(n), 0.05 * (c @ c.T), 100 * (b @ b.T + 0.1 * np.eye(n))


def chain(n, k=300.0, m=2.0, free=False):
    """n equal masses, the first held by a spring unless free."""
    stiffness = 2 * np.eye(n) - np.eye(n, k=1) - np.eye(n, k=-1)
    stiffness[-1, -1] = 1
    stiffness[0, 0] = 1 if free else 2
    return linear_of(m * np.eye(n), np.zeros((n, n)), k * stiffness)


# ---------------------------------------------------------------- frequencies and shapes


@pytest.mark.parametrize("seed", range(5))
def test_modes_are_those_of_the_undamped_state_matrix(seed):
    mass, damping, stiffness = random_system(seed)
    found = ed.modes(linear_of(mass, damping, stiffness))
    state = np.block([[np.zeros((4, 4)), np.eye(4)], [-np.linalg.solve(mass, stiffness), np.zeros((4, 4))]])
    values = scipy.linalg.eigvals(state)
    expected = np.sort(values.imag[values.imag > 0]) / (2 * pi)
    np.testing.assert_allclose(found.natural_frequency, expected, rtol=1e-10)
    np.testing.assert_allclose(found.modal_mass, np.eye(4), atol=1e-12)
    np.testing.assert_allclose(found.modal_stiffness, np.diag((2 * pi * expected) ** 2), atol=1e-9 * 400)
    np.testing.assert_allclose(found.modal_damping, found.shapes.T @ damping @ found.shapes, atol=1e-14)
    weighted = found.shapes * np.sqrt(np.diag(mass))[:, None]
    assert np.all(weighted.max(axis=0) == np.abs(weighted).max(axis=0))


@pytest.mark.parametrize("n", [2, 5, 9])
def test_a_chain_has_the_frequencies_shapes_and_nodes_of_the_textbook(n):
    """ω = 2 √(k/m) sin β/2, x_j = sin jβ, β = (2r − 1)π/(2n + 1) for a chain fixed at one end."""
    found = ed.modes(chain(n))
    beta = (2 * np.arange(1, n + 1) - 1) * pi / (2 * n + 1)
    np.testing.assert_allclose(
        found.natural_frequency, np.sqrt(150.0) * 2 * np.sin(beta / 2) / (2 * pi), rtol=1e-11
    )
    sines = np.sin(np.outer(np.arange(1, n + 1), beta))
    np.testing.assert_allclose(np.diag(ed.mac(found.shapes, sines)), 1, rtol=1e-12)
    nodes = found.nodes(places=np.arange(1, n + 1))
    assert [len(each) for each in nodes] == list(range(n)), "mode r has r − 1 nodes (C. Sturm)"
    for r, each in enumerate(nodes):
        true = np.arange(1, r + 1) * pi / beta[r]
        assert np.all(np.abs(each - true) < 0.1 + 0.04 * r), "straight lines between masses are near sines"


def test_worked_example_w7():
    found = ed.modes(linearized("W7"))
    np.testing.assert_allclose(found.natural_frequency, [0.7453, 2.2137], atol=6e-5)
    np.testing.assert_allclose(found.normalized("s")[1], [18.27, -2.479], rtol=3e-4)
    assert "0.74526, 2.2137 Hz" in repr(found)
    assert "share of energy" in found._repr_html_()


def test_the_sag_counts_in_the_frequencies_of_the_isolator():
    """Pitfall 12: not 3.4809 and 12.604 Hz."""
    np.testing.assert_allclose(ed.modes(linearized("S10")).natural_frequency, [3.8245, 13.572], rtol=2e-5)


# ---------------------------------------------------------------- rigid-body modes (pitfall 19)


def test_a_free_chain_has_one_mode_of_exactly_zero_hertz():
    found = ed.modes(chain(6, k=1 / 3, free=True))
    assert found.natural_frequency[0] == 0.0
    expected = 2 * np.sqrt(1 / 6) * np.sin(np.arange(6) * pi / 12) / (2 * pi)
    np.testing.assert_allclose(found.natural_frequency, expected, rtol=1e-10, atol=0)
    np.testing.assert_allclose(found.normalized("max")[:, 0], 1, rtol=1e-12)
    assert len(found.nodes()[0]) == 0


def test_rigid_body_modes_of_crane_and_drive_train():
    crane, train = ed.modes(linearized("S07")), ed.modes(linearized("S20"))
    assert crane.natural_frequency[0] == train.natural_frequency[0] == 0.0
    np.testing.assert_allclose(train.natural_frequency[1:], [2.5835, 43.047], rtol=2e-5)
    assert np.all(np.isfinite(train.shapes))
    # A damping constant in place of a ratio: the trolley's c_x on all the mass that rolls.
    np.testing.assert_allclose(crane.modal_damping[0, 0], 400.0 / (1200.0 + 2500.0), rtol=1e-12)
    assert "0, 0.28533 Hz" in repr(crane)
    assert crane.linear.coordinates == ("x", "theta")


def test_tiny_negative_squares_are_clipped_with_a_warning_and_negative_ones_refused():
    stiffness = np.diag([-1e-12, 1.0])
    with pytest.warns(ed.EngdynWarning, match="taken as 0"):
        assert ed.natural_frequencies(np.eye(2), stiffness)[0] == 0.0
    with pytest.warns(ed.EngdynWarning, match="taken as 0"):
        assert ed.modes(linear_of(np.eye(2), np.zeros((2, 2)), stiffness)).natural_frequency[0] == 0.0
    with pytest.raises(ed.EngdynError, match=r"statically unstable.*damped_modes"):
        ed.modes(linearized("S07", 1))
    with pytest.raises(ed.EngdynError, match="statically unstable"):
        ed.natural_frequencies(np.eye(2), [np.eye(2), np.diag([-1e-3, 1.0])])


# ---------------------------------------------------------------- equal frequencies (pitfall 18)


def test_equal_frequencies_are_a_subspace():
    """Three masses in a ring: 0 and twice √(3k/m); the pair spans what has no mean motion."""
    ring = 3 * np.eye(3) - np.ones((3, 3))
    found = ed.modes(linear_of(np.eye(3), np.zeros((3, 3)), 40 * ring))
    assert found.groups == ((0,), (1, 2))
    np.testing.assert_allclose(found.natural_frequency, np.sqrt([0, 120, 120]) / (2 * pi), rtol=1e-12)
    pair = found.shapes[:, 1:]
    np.testing.assert_allclose(pair @ pair.T, np.eye(3) - np.ones((3, 3)) / 3, atol=1e-14)
    np.testing.assert_allclose(found.modal_mass, np.eye(3), atol=1e-14)
    with pytest.warns(ed.EngdynWarning, match="equal frequencies"):
        found.nodes()


def test_the_basis_of_a_subspace_does_not_depend_on_the_solver():
    """Two equal pendulums, and the same described so that eigh starts from another basis."""
    two = ed.modes(linear_of(2 * np.eye(2), np.zeros((2, 2)), 50 * np.eye(2)))
    assert two.groups == ((0, 1),)
    np.testing.assert_allclose(np.abs(two.shapes), np.eye(2) / np.sqrt(2), atol=1e-15)
    nearly = 50 * np.eye(2) + 1e-9 * np.array([[0, 1], [1, 0]])  # rounding, which eigh turns by 45 degrees
    assert np.min(np.abs(scipy.linalg.eigh(nearly)[1])) > 0.7
    turned = ed.modes(linear_of(2 * np.eye(2), np.zeros((2, 2)), nearly))
    np.testing.assert_allclose(turned.shapes, two.shapes, atol=1e-9)


def test_the_rotor_at_rest_has_a_double_frequency():
    found = ed.modes(linearized("S15", Omega="1e-30 rad/s"))
    np.testing.assert_allclose(
        found.natural_frequency, np.sqrt((60 - 5 * 9.81 * 0.15) / 0.12) / (2 * pi), rtol=1e-12
    )
    np.testing.assert_allclose(found.natural_frequency, [3.3335, 3.3335], rtol=2e-5)
    assert found.groups == ((0, 1),)


# ---------------------------------------------------------------- what has no undamped modes


@pytest.mark.parametrize(
    ("key", "message"),
    [
        ("S15", "damping matrix is not symmetric.*gyroscopic: use damped_modes"),
        ("S11", "stiffness matrix is not symmetric.*circulatory: use damped_modes"),
        ("S12", "circulatory: use damped_modes"),
        ("S13", "nonholonomic.*use damped_modes"),
    ],
)
def test_gyroscopic_circulatory_and_nonholonomic_systems_are_refused(key, message):
    with pytest.raises(ed.EngdynError, match=message):
        ed.modes(linearized(key))


def test_other_arguments_are_refused():
    crane = ed.systems.load("S07")
    for wrong in (ed.linearize(crane.equations, {}, symbolic=True), crane, None):
        with pytest.raises(ed.EngdynError, match="LinearSystem with numbers"):
            ed.modes(wrong)
    with pytest.raises(ed.EngdynError, match="mass matrix is not symmetric"):
        ed.modes(linear_of([[2, 1], [0, 1]], np.zeros((2, 2)), np.eye(2)))
    with pytest.raises(ed.EngdynError, match="not positive definite"):
        ed.modes(linear_of([[1, 2], [2, 1]], np.zeros((2, 2)), np.eye(2)))


# ---------------------------------------------------------------- energies and nodes (pitfall 21)


def in_other_units(linear, factors):
    """The same system in coordinates that are larger by these factors."""
    scale = np.outer(1 / np.array(factors), 1 / np.array(factors))
    return linear_of(*(matrix * scale for matrix in (linear.mass, linear.damping, linear.stiffness)))


def test_shares_of_energy_are_those_of_kinetic_and_potential_energy_in_any_units():
    linear = linearized("W8")
    found, other = ed.modes(linear), ed.modes(in_other_units(linear, [1000.0, 180 / pi]))
    potential = found.shapes * (linear.stiffness @ found.shapes)
    np.testing.assert_allclose(found.energy_share, potential / potential.sum(axis=0), atol=1e-12)
    np.testing.assert_allclose(found.energy_share.sum(axis=0), 1, rtol=1e-14)
    np.testing.assert_allclose(other.energy_share, found.energy_share, rtol=1e-9)
    np.testing.assert_allclose(other.natural_frequency, found.natural_frequency, rtol=1e-12)
    assert found.energy_share[0, 0] > 0.97  # bounce, though θ moves by more radians a meter in mode 2


def test_the_nodes_of_the_rod_do_not_depend_on_scale_and_units():
    linear = linearized("W8")
    found = ed.modes(linear)
    nodes = found.nodes("y", "theta")
    np.testing.assert_allclose(nodes, [3.560, -0.0936], atol=4e-4)
    rescaled = replace(found, shapes=found.shapes * [-3.0, 1e-4])
    np.testing.assert_allclose(rescaled.nodes("y", "theta"), nodes, rtol=1e-12)
    in_millimeters = ed.modes(in_other_units(linear, [1000.0, 1.0]))
    np.testing.assert_allclose(in_millimeters.nodes("x1", "x2"), 1000 * nodes, rtol=1e-9)
    # A node stays at rest: each mode is a rotation about it.
    for k, x in enumerate(nodes):
        y, theta = found.shapes[:, k]
        assert y + x * theta == pytest.approx(0, abs=1e-15)


def test_the_nodes_of_the_half_car():
    nodes = ed.modes(linearized("S23")).nodes("z", "theta")
    np.testing.assert_allclose(nodes[:2], [-1.354, 1.244], atol=6e-4)


def test_a_body_that_only_translates_has_its_node_at_infinity():
    found = ed.modes(linearized("W8", a_1=0.9))  # k₁ a₁ = k₂ a₂
    assert found.nodes("y", "theta").tolist() == [np.inf, 0.0]
    other = ed.modes(linear_of(np.eye(3), np.zeros((3, 3)), np.diag([1.0, 2.0, 3.0])))
    assert np.isnan(other.nodes("x1", "x2")[2]), "a body at rest has no one center"


def test_a_mass_at_rest_is_a_node_of_the_chain():
    """Three equal masses between walls: the middle one rests in the second mode."""
    stiffness = 2 * np.eye(3) - np.eye(3, k=1) - np.eye(3, k=-1)
    found = ed.modes(linear_of(np.eye(3), np.zeros((3, 3)), stiffness))
    assert [each.tolist() for each in found.nodes()[:2]] == [[], [1.0]]
    # between 1 and −√2: 1/(1 + √2) of the way
    np.testing.assert_allclose(
        found.nodes(places=[0, 2, 4])[2], [2 / (1 + np.sqrt(2)), 4 - 2 / (1 + np.sqrt(2))]
    )
    assert found.nodes(chain=["x1", "x3"])[2].tolist() == []


def test_the_torsional_nodes_of_the_drive_train():
    nodes = ed.modes(linearized("S20")).nodes()
    assert [len(each) for each in nodes] == [0, 1, 2]


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"translation": "z", "rotation": "theta"}, "translation is 'z': choose one of y, theta"),
        ({"translation": "y"}, "its translation and its rotation"),
        ({"translation": "y", "rotation": "theta", "places": [0, 1]}, "its translation and its rotation"),
        ({"chain": ["y", "phi"]}, "chain is 'phi'"),
        ({"places": [0.0]}, "give 2 numbers"),
        ({"places": [0.0, np.nan]}, "give 2 numbers"),
    ],
)
def test_wrong_arguments_of_nodes(arguments, message):
    with pytest.raises(ed.EngdynError, match=message):
        ed.modes(linearized("W8")).nodes(**arguments)


def test_the_usual_normalizations():
    found = ed.modes(linear_of(*random_system(1)))
    np.testing.assert_array_equal(found.normalized(), found.shapes)
    np.testing.assert_allclose(np.max(found.normalized("max"), axis=0), 1)
    assert np.max(np.abs(found.normalized("max"))) <= 1
    np.testing.assert_allclose(np.linalg.norm(found.normalized("unit"), axis=0), 1)
    np.testing.assert_allclose(found.normalized("x3")[2], 1)
    for rule in ("max", "unit", "x3"):
        np.testing.assert_allclose(np.diag(ed.mac(found.normalized(rule), found.shapes)), 1)
    with pytest.raises(ed.EngdynError, match="choose one of mass, max, unit, x1, x2, x3, x4"):
        found.normalized("norm")
    with pytest.raises(ed.EngdynError, match="theta is at rest in mode 1"):
        ed.modes(linearized("S07")).normalized("theta")


# ---------------------------------------------------------------- many at once


def test_a_stack_of_systems_has_the_frequencies_of_each():
    systems = [random_system(seed, 3) for seed in range(12)]
    mass, stiffness = (np.array([s[i] for s in systems]).reshape(3, 4, 3, 3) for i in (0, 2))
    found = ed.natural_frequencies(mass, stiffness)
    assert found.shape == (3, 4, 3)
    for at in np.ndindex(3, 4):
        expected = np.sqrt(scipy.linalg.eigh(stiffness[at], mass[at], eigvals_only=True)) / (2 * pi)
        np.testing.assert_allclose(found[at], expected, rtol=1e-11)
    np.testing.assert_allclose(ed.natural_frequencies(mass[0, 0], stiffness)[0, 0], found[0, 0], rtol=1e-12)
    many = np.linspace(1, 2, 2500)
    found = ed.natural_frequencies(np.eye(2), many[:, None, None] * np.diag([1.0, 4.0]))
    np.testing.assert_allclose(found, np.sqrt(many)[:, None] * [1, 2] / (2 * pi), rtol=1e-12)
    assert ed.natural_frequencies(np.empty((0, 3, 3)), np.empty((0, 3, 3))).shape == (0, 3)


@pytest.mark.parametrize(
    ("mass", "stiffness", "message"),
    [
        (np.eye(2), [[1, 2], [0, 1]], "stiffness is not symmetric"),
        (np.eye(2), [1e12 * np.eye(2), [[1, 2], [0, 1]]], "stiffness is not symmetric"),
        (np.eye(2), [[np.nan, 0], [0, 1]], "not finite"),
        (np.eye(2), np.eye(3), "do not go together"),
        (np.eye(2), [1.0, 2.0], "square matrices"),
        (np.diag([1.0, 0.0]), np.eye(2), "not positive definite"),
    ],
)
def test_matrices_that_are_none_of_a_vibrating_system(mass, stiffness, message):
    with pytest.raises(ed.EngdynError, match=message):
        ed.natural_frequencies(mass, stiffness)


def test_matrices_that_are_no_arrays():
    with pytest.raises(ed.EngdynError, match="arrays of real numbers"):
        ed.natural_frequencies([[1.0, 0.0], [0.0]], np.eye(2))


def test_nodes_and_scales_of_what_has_no_name():
    found = ed.modes(linearized("W9"))
    for message, ask in {
        "rule is": lambda: found.normalized(np.ones(2)),
        "translation is": lambda: found.nodes(np.ones(2), "x2"),
        "chain is": lambda: found.nodes(chain=[]),
        "places is": lambda: found.nodes(places=["left", "right"]),
    }.items():
        with pytest.raises(ed.EngdynError, match=message):
            ask()
