"""Inertia tensors of points, their transfer and their principal axes, against sums, cross products and energies."""

from __future__ import annotations

import numpy as np
import pytest
import sympy as sm
from hypothesis import given, settings
from hypothesis import strategies as st

import engdyn as ed
from engdyn.errors import EngdynError
from engdyn.modeling import inertia

numbers = st.floats(-2, 2).filter(lambda v: abs(v) > 1e-3)
triples = st.tuples(numbers, numbers, numbers)
places = st.lists(triples, min_size=3, max_size=6)


@settings(max_examples=40)
@given(places, triples)
def test_the_tensor_gives_momentum_and_energy_of_the_points(points, omega):
    """H = Σ r × m (ω × r) and T = ½ Σ m (ω × r)², written with cross products only."""
    masses = [0.5 + 0.1 * i for i in range(len(points))]
    tensor = inertia.inertia_tensor(masses, points)
    velocity = np.cross(omega, points)
    momentum = sum(m * np.cross(r, v) for m, r, v in zip(masses, points, velocity, strict=True))
    energy = sum(m * v @ v / 2 for m, v in zip(masses, velocity, strict=True))
    np.testing.assert_allclose(tensor @ omega, momentum, rtol=1e-9, atol=1e-9)
    assert omega @ tensor @ np.array(omega) / 2 == pytest.approx(energy)


def test_numbers_and_symbols_give_the_same_tensor():
    a, b, m = sm.symbols("a b m")
    symbolic = inertia.inertia_tensor([m, 2], [(a, b, 1), (1, -b, a)])
    numeric = inertia.inertia_tensor([3.0, 2.0], [(0.5, 0.7, 1.0), (1.0, -0.7, 0.5)])
    replaced = symbolic.subs({a: 0.5, b: 0.7, m: 3})
    np.testing.assert_allclose(np.array(replaced, dtype=float), numeric)
    assert symbolic[0, 1] == -m * a * b + 2 * b


@settings(max_examples=60)
@given(places, triples)
def test_every_tensor_is_possible_and_moves_as_steiner_says(points, offset):
    masses = [0.5 + 0.1 * i for i in range(len(points))]
    total = sum(masses)
    center = np.array(masses) @ np.array(points) / total
    about_center = inertia.inertia_tensor(masses, [tuple(np.array(p) - center) for p in points])
    inertia.check_tensor(about_center)
    moved = inertia.parallel_axis(about_center, total, offset)
    direct = inertia.inertia_tensor(masses, [tuple(np.array(p) - center - np.array(offset)) for p in points])
    np.testing.assert_allclose(moved, direct, rtol=1e-9, atol=1e-9)


@settings(max_examples=40)
@given(places)
def test_principal_axes_diagonalize(points):
    tensor = inertia.inertia_tensor([1.0 + i for i in range(len(points))], points)
    found = inertia.principal_axes(tensor)
    np.testing.assert_allclose(found.axes.T @ tensor @ found.axes, np.diag(found.moments), atol=1e-8)
    assert np.linalg.det(found.axes) == pytest.approx(1.0)
    assert np.all(np.diff(found.moments) >= 0)
    np.testing.assert_allclose(inertia.rotate_tensor(tensor, found.axes.T), np.diag(found.moments), atol=1e-8)


@settings(max_examples=40)
@given(places, triples)
def test_a_rotation_of_axes_is_a_rotation_of_the_points(points, turn):
    """Rodrigues' formula turns the points; the tensor of turned points is the turned tensor."""
    n, angle = np.array(turn) / np.linalg.norm(turn), float(np.linalg.norm(turn))
    cross = np.array([[0, -n[2], n[1]], [n[2], 0, -n[0]], [-n[1], n[0], 0]])
    R = np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross
    masses = [1.0 + i for i in range(len(points))]
    rotated = inertia.rotate_tensor(inertia.inertia_tensor(masses, points), R)
    direct = inertia.inertia_tensor(masses, [tuple(R @ p) for p in points])
    np.testing.assert_allclose(rotated, direct, rtol=1e-9, atol=1e-9)


def test_rotation_with_symbols():
    a, m, beta = sm.symbols("a m beta")
    R = sm.Matrix([[sm.cos(beta), sm.sin(beta), 0], [-sm.sin(beta), sm.cos(beta), 0], [0, 0, 1]])
    rotated = inertia.rotate_tensor(inertia.inertia_tensor([m], [(a, 0, 0)]), R)
    assert rotated[0, 1] == m * a**2 * sm.cos(beta) * sm.sin(beta)  # the point is at (a cos β, −a sin β)
    numeric = inertia.rotate_tensor(np.diag([0.0, 1.0, 1.0]), R)
    assert float(numeric[0, 1].subs(beta, 0.3)) == pytest.approx(np.cos(0.3) * np.sin(0.3))


def test_signs_of_principal_axes_do_not_hang_on_rounding():
    """Axes at 45°: both components are equally large, and rounding must not choose the sign."""
    for noise in (0.0, 1e-13, -1e-13):
        tensor = np.array([[2.0 + noise, 1.0, 0.0], [1.0, 2.0 - noise, 0.0], [0.0, 0.0, 3.5]])
        axes = inertia.principal_axes(tensor).axes
        np.testing.assert_allclose(axes[:, 0], np.array([1, -1, 0]) / np.sqrt(2), atol=1e-6)
        np.testing.assert_allclose(axes[:, 1], np.array([1, 1, 0]) / np.sqrt(2), atol=1e-6)


def test_principal_axes_read_well():
    text = repr(inertia.principal_axes(np.diag([3.0, 1.0, 2.5])))
    assert text.splitlines() == [
        "PrincipalAxes:",
        "  1 kg m² about (0, 1, 0)",
        "  2.5 kg m² about (0, 0, 1)",
        "  3 kg m² about (1, 0, 0)",
    ]


@pytest.mark.parametrize(
    ("tensor", "message"),
    [
        (np.diag([1.0, 1.0, 3.0]), "no body has the principal moments 1, 1, 3.*exceeds the sum"),
        (np.diag([-1.0, 1.0, 1.0]), "principal moment -1 kg m² is negative"),
        ([[1, 2, 0], [2, 1, 0], [0, 0, 1]], "negative"),
        ([[1, 2, 0], [0, 1, 0], [0, 0, 1]], "not symmetric"),
        (np.eye(2), "three rows"),
        (np.diag([1.0, 1.0, np.nan]), "nan: give a finite"),
        (np.diag([1.0, 1.0, 1j]), "give a finite number"),
        ([["1", 0, 0], [0, 1, 0], [0, 0, 1]], "'1': give a finite"),
        ("abc", "three rows"),
        (5.0, "three rows"),
        (sm.Symbol("J") * sm.eye(3), "substitute values"),
    ],
)
def test_tensors_that_no_body_has(tensor, message):
    with pytest.raises(EngdynError, match=message):
        inertia.principal_axes(tensor)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: ed.inertia_tensor([1.0], [(1, 2)]), "has 2 coordinates"),
        (lambda: ed.inertia_tensor([1.0, 2.0], [(1, 2, 3)]), "2 masses and 1 points"),
        (lambda: ed.inertia_tensor([], []), "0 masses"),
        (lambda: ed.inertia_tensor([-1.0], [(1, 2, 3)]), "mass is -1: it must be zero or positive"),
        (lambda: ed.inertia_tensor([1.0], [(1, 2, float("nan"))]), "coordinate of the point .* nan"),
        (lambda: ed.inertia_tensor(["1"], [(1, 2, 3)]), "mass is '1'"),
        (lambda: ed.inertia_tensor([sm.Symbol("m")], [("x", 2, 3)]), "'x'"),
        (lambda: ed.parallel_axis(np.eye(3), -1.0, (1, 0, 0)), "mass is -1"),
        (lambda: ed.parallel_axis(np.eye(3), 1.0, (1, 0)), "has 2 coordinates"),
        (lambda: ed.parallel_axis(np.eye(3), 1.0, (1, 0, np.inf)), "inf"),
        (lambda: ed.parallel_axis(np.eye(3), 1.0, 0.5), "offset is 0.5.*give \\(x, y, z\\)"),
        (lambda: ed.inertia_tensor(1.0, (1, 2, 3)), "list of masses"),
        (lambda: ed.parallel_axis([[1, 1, 0], [0, 1, 0], [0, 0, 1]], 1.0, (1, 0, 0)), "not symmetric"),
        (lambda: ed.parallel_axis(np.eye(3) * np.nan, 1.0, (1, 0, 0)), "nan"),
        (lambda: ed.rotate_tensor(np.eye(3), 2 * np.eye(3)), "not orthogonal"),
        (lambda: ed.rotate_tensor(np.eye(3), np.diag([1, 1, -1])), "mirror image"),
        (lambda: ed.rotate_tensor([["x", 0, 0], [0, 1, 0], [0, 0, 1]], sm.Symbol("c") * sm.eye(3)), "'x'"),
    ],
)
def test_bad_input_is_refused_with_its_reason(make, message):
    with pytest.raises(EngdynError, match=message):
        make()
