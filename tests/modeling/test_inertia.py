"""Inertia tensors against numerical integration over the bodies, and against their own physics."""

from __future__ import annotations

import numpy as np
import pytest
import sympy as sm
from hypothesis import given, settings
from hypothesis import strategies as st

from engdyn.errors import EngdynError
from engdyn.modeling import inertia, solids

N = 48  # points of the midpoint rule in each direction
MID = (np.arange(N) + 0.5) / N
ROUND = 2 * np.pi * MID


def integrated(points, weights, mass):
    """Tensor of a cloud of weighted points about its own mass center."""
    weights = np.asarray(weights, dtype=float) * mass / np.sum(weights)
    points = np.asarray(points, dtype=float)
    points = points - weights @ points / mass
    return inertia.inertia_tensor(list(weights), [tuple(p) for p in points])


def grid(*axes):
    """All combinations of three coordinates, shape (N³, 3)."""
    return np.stack([a.ravel() for a in np.meshgrid(*axes, indexing="ij")], axis=-1)


def of_revolution(radius_at, heights, inner=0.0):
    """Points and volume weights of a body of revolution about z."""
    shares, angles, z = grid(MID, ROUND, heights).T
    outer = radius_at(z)
    radii = inner + (outer - inner) * shares
    points = np.stack([radii * np.cos(angles), radii * np.sin(angles), z], axis=-1)
    return points, radii * (outer - inner)


def sphere_points(a, b, c):
    """Points and weights of an ellipsoid, polar coordinates scaled."""
    radii, angles, heights = grid(MID, ROUND, 2 * MID - 1).T
    across = np.sqrt(1 - heights**2)
    unit = np.stack([across * np.cos(angles), across * np.sin(angles), heights], axis=-1)
    return radii[:, None] * unit * [a, b, c], radii**2


CLOUDS = {
    "rod": (solids.rod(2.0, 1.4), *(grid([0], [0], 1.4 * MID), np.ones(N))),
    "plate": (solids.plate(2.0, 0.6, 0.9), *(grid(0.6 * MID, 0.9 * MID, [0]), np.ones(N * N))),
    "box": (solids.box(2.0, 0.6, 0.9, 0.3), *(grid(0.6 * MID, 0.9 * MID, 0.3 * MID), np.ones(N**3))),
    "disc": (solids.disc(2.0, 0.7), *of_revolution(lambda z: 0.7 + 0 * z, np.array([0.0]))),
    "cylinder": (solids.cylinder(2.0, 0.7, 1.1), *of_revolution(lambda z: 0.7 + 0 * z, 1.1 * MID)),
    "tube": (solids.tube(2.0, 0.7, 0.4, 1.1), *of_revolution(lambda z: 0.7 + 0 * z, 1.1 * MID, 0.4)),
    "cone": (solids.cone(2.0, 0.7, 1.1), *of_revolution(lambda z: 0.7 * (1 - z / 1.1), 1.1 * MID)),
    "sphere": (solids.sphere(2.0, 0.7), *sphere_points(0.7, 0.7, 0.7)),
    "ellipsoid": (solids.ellipsoid(2.0, 0.7, 0.5, 0.3), *sphere_points(0.7, 0.5, 0.3)),
}


@pytest.mark.parametrize("name", CLOUDS)
def test_closed_forms_equal_numerical_integration(name):
    tensor, points, weights = CLOUDS[name]
    np.testing.assert_allclose(tensor, integrated(points, weights, 2.0), rtol=2e-3, atol=2e-4)


def test_a_thin_shell_is_the_limit_of_a_thick_one():
    thick, hollow = 1.0, 0.999
    outer, inner = solids.sphere(thick**3, thick), solids.sphere(hollow**3, hollow)
    mass = thick**3 - hollow**3
    np.testing.assert_allclose(solids.shell(mass, 1.0), outer - inner, rtol=4e-3)


numbers = st.floats(-2, 2).filter(lambda v: abs(v) > 1e-3)
places = st.lists(st.tuples(numbers, numbers, numbers), min_size=3, max_size=6)


@settings(max_examples=60)
@given(places, st.tuples(numbers, numbers, numbers))
def test_every_tensor_is_possible_and_moves_as_steiner_says(points, offset):
    masses = [0.5 + 0.1 * i for i in range(len(points))]
    total = sum(masses)
    center = np.array(masses) @ np.array(points) / total
    about_center = inertia.inertia_tensor(masses, [tuple(np.array(p) - center) for p in points])
    inertia.check_tensor(about_center)
    moved = inertia.parallel_axis(about_center, total, offset)
    direct = inertia.inertia_tensor(masses, [tuple(np.array(p) - center - np.array(offset)) for p in points])
    np.testing.assert_allclose(moved, direct, rtol=1e-9, atol=1e-9)
    again = inertia.parallel_axis(moved, total, tuple(-x for x in offset))
    assert np.trace(again) > np.trace(about_center)  # from a point that is not G it does not lead back


@settings(max_examples=40)
@given(places)
def test_principal_axes_diagonalize(points):
    tensor = inertia.inertia_tensor([1.0 + i for i in range(len(points))], points)
    found = inertia.principal_axes(tensor)
    np.testing.assert_allclose(found.axes.T @ tensor @ found.axes, np.diag(found.moments), atol=1e-8)
    assert np.linalg.det(found.axes) == pytest.approx(1.0)
    np.testing.assert_allclose(inertia.rotated(tensor, found.axes.T), np.diag(found.moments), atol=1e-8)


def test_products_are_elements_of_the_tensor():
    """One mass at (1, 3, 0): the element is −m x y, whatever the other convention calls I_xy."""
    tensor = inertia.inertia_tensor([2.0], [(1.0, 3.0, 0.0)])
    assert tensor[0, 1] == -6.0
    spin = np.array([0.0, 1.0, 0.0])
    momentum = 2.0 * np.cross([1.0, 3.0, 0.0], np.cross(spin, [1.0, 3.0, 0.0]))
    np.testing.assert_allclose(tensor @ spin, momentum)


def test_symbols_stay_exact():
    m, a, d = sm.symbols("m a d", positive=True)
    assert solids.rod(m, a)[0, 0] == m * a**2 / 12
    assert inertia.parallel_axis(solids.rod(m, a), m, (0, d, 0))[0, 0] == m * a**2 / 12 + m * d**2


def test_a_hole_is_a_part_with_negative_mass():
    tube = solids.tube(2.0, 0.7, 0.4, 1.1)
    density = 2.0 / (np.pi * (0.7**2 - 0.4**2) * 1.1)
    parts = [(density * np.pi * r**2 * 1.1, r) for r in (0.7, 0.4)]
    body = solids.composite(
        [
            (parts[0][0], solids.cylinder(parts[0][0], 0.7, 1.1), (0, 0, 0)),
            (-parts[1][0], -solids.cylinder(parts[1][0], 0.4, 1.1), (0, 0, 0)),
        ]
    )
    assert body.mass == pytest.approx(2.0)
    np.testing.assert_allclose(body.tensor, tube, rtol=1e-12)


def test_a_dumb_bell_of_parts():
    ball = solids.sphere(1.0, 0.1)
    body = solids.composite([(1.0, ball, (0.5, 0, 0)), (1.0, ball, (-0.5, 0, 0))])
    assert body.center == (0.0, 0.0, 0.0)
    np.testing.assert_allclose(np.diag(body.tensor), [0.008, 0.508, 0.508])


@pytest.mark.parametrize(
    ("tensor", "message"),
    [
        (np.diag([1.0, 1.0, 3.0]), "exceeds the sum"),
        (np.diag([-1.0, 1.0, 1.0]), "negative"),
        ([[1, 2, 0], [0, 1, 0], [0, 0, 1]], "not symmetric"),
        (np.eye(2), "3 × 3"),
        (np.diag([1.0, 1.0, np.nan]), "not finite"),
        ("abc", "three rows|3 × 3"),
    ],
)
def test_tensors_that_no_body_has(tensor, message):
    with pytest.raises(EngdynError, match=message):
        inertia.principal_axes(tensor)


@pytest.mark.parametrize(
    "make",
    [
        lambda: solids.cylinder(-1, 1, 1),
        lambda: solids.tube(1, 0.2, 0.4, 1),
        lambda: solids.sphere(1, float("nan")),
        lambda: solids.box(1, 0, 1, 1),
        lambda: solids.composite([]),
        lambda: inertia.inertia_tensor([1.0], [(1, 2)]),
        lambda: inertia.inertia_tensor([1.0, 2.0], [(1, 2, 3)]),
        lambda: inertia.inertia_tensor([-1.0], [(1, 2, 3)]),
        lambda: inertia.rotated(np.eye(3), 2 * np.eye(3)),
        lambda: solids.rod("long", 1),
    ],
)
def test_bad_input_is_refused(make):
    with pytest.raises(EngdynError):
        make()
