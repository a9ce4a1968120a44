"""Common bodies against numerical integration, twice: a midpoint rule and random points (Appendix B.4)."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
import sympy as sm
from sympy.physics.mechanics import ReferenceFrame

import engdyn as ed
from engdyn import solids
from engdyn.modeling.inertia import check_tensor

N = 48  # points of the midpoint rule in each direction
MID = (np.arange(N) + 0.5) / N
ROUND = 2 * np.pi * MID


def integrated(points, weights, mass):
    """Tensor of a cloud of weighted points about its own mass center, without the package."""
    weights = np.asarray(weights, dtype=float) * mass / np.sum(weights)
    points = np.asarray(points, dtype=float)
    points = points - weights @ points / mass
    second = (weights * points.T) @ points  # ∫ r rᵀ dm
    return np.trace(second) * np.eye(3) - second


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


def ball(a, b, c, radii=MID):
    """Points and weights of an ellipsoid or, with one radius, of a shell: polar coordinates, scaled."""
    radii, angles, heights = grid(radii, ROUND, 2 * MID - 1).T
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
    "thin tube": (
        solids.tube(2.0, 0.7, 0.7, 1.1),
        *of_revolution(lambda z: 0.7 + 0 * z, 1.1 * MID, 0.699999),
    ),
    "cone": (solids.cone(2.0, 0.7, 1.1), *of_revolution(lambda z: 0.7 * (1 - z / 1.1), 1.1 * MID)),
    "sphere": (solids.sphere(2.0, 0.7), *ball(0.7, 0.7, 0.7)),
    "shell": (solids.shell(2.0, 0.7), *ball(0.7, 0.7, 0.7, [1.0])),
    "ellipsoid": (solids.ellipsoid(2.0, 0.7, 0.5, 0.3), *ball(0.7, 0.5, 0.3)),
}

INSIDE = {  # what a point of the box (-1..1)³ must fulfill, and the mass center above the origin
    "box": lambda x, y, z: (abs(x) < 0.3) & (abs(y) < 0.45) & (abs(z) < 0.15),
    "cylinder": lambda x, y, z: (np.hypot(x, y) < 0.7) & (abs(z) < 0.55),
    "tube": lambda x, y, z: (np.hypot(x, y) < 0.7) & (np.hypot(x, y) > 0.4) & (abs(z) < 0.55),
    "cone": lambda x, y, z: (np.hypot(x, y) < 0.7 * (0.55 - z) / 1.1) & (abs(z) < 0.55),
    "sphere": lambda x, y, z: x**2 + y**2 + z**2 < 0.49,
    "ellipsoid": lambda x, y, z: (x / 0.7) ** 2 + (y / 0.5) ** 2 + (z / 0.3) ** 2 < 1,
}


def test_every_body_is_integrated():
    lower = {name for name in solids.__all__ if name[0].islower()} - {"composite"}
    assert lower == set(CLOUDS) - {"thin tube"}


@pytest.mark.parametrize("name", CLOUDS)
def test_closed_forms_equal_the_midpoint_rule(name):
    tensor, points, weights = CLOUDS[name]
    np.testing.assert_allclose(tensor, integrated(points, weights, 2.0), rtol=2e-3, atol=2e-4)


@pytest.mark.parametrize("name", INSIDE)
def test_closed_forms_equal_monte_carlo_integration(name):
    """A million random points, of which those inside count; tolerance from the scatter of twenty batches."""
    points = np.random.default_rng(7).uniform(-1, 1, (1_000_000, 3))
    batches = [cloud[INSIDE[name](*cloud.T)] for cloud in np.split(points, 20)]
    found = np.array([integrated(cloud, np.ones(len(cloud)), 2.0) for cloud in batches])
    error = np.std(found, axis=0, ddof=1) / np.sqrt(20)
    assert np.max(error) < 2e-3
    assert np.all(abs(found.mean(axis=0) - CLOUDS[name][0]) < 5 * error)


@pytest.mark.parametrize("name", CLOUDS)
def test_common_bodies_are_possible_and_the_flat_ones_are_on_the_limit(name):
    small, middle, large = np.sort(np.diag(check_tensor(CLOUDS[name][0])))
    flat = name in ("rod", "plate", "disc")
    assert np.isclose(large, small + middle) == flat


def test_bodies_become_each_other_in_the_limit():
    np.testing.assert_allclose(solids.cylinder(2, 0.7, 1e-9), solids.disc(2, 0.7), atol=1e-12)
    np.testing.assert_allclose(solids.cylinder(2, 1e-9, 0.7), solids.rod(2, 0.7), atol=1e-12)
    np.testing.assert_allclose(solids.box(2, 0.6, 0.9, 1e-9), solids.plate(2, 0.6, 0.9), atol=1e-12)
    np.testing.assert_allclose(solids.tube(2, 0.7, 0, 1.1), solids.cylinder(2, 0.7, 1.1))
    np.testing.assert_allclose(solids.ellipsoid(2, 0.7, 0.7, 0.7), solids.sphere(2, 0.7))
    thick, hollow = 1.0, 0.999
    outer, inner = solids.sphere(thick**3, thick), solids.sphere(hollow**3, hollow)
    np.testing.assert_allclose(solids.shell(thick**3 - hollow**3, 1.0), outer - inner, rtol=4e-3)


def test_symbols_stay_exact():
    m, a, d = sm.symbols("m a d", positive=True)
    assert solids.rod(m, a)[0, 0] == m * a**2 / 12
    about_end = ed.parallel_axis(solids.rod(m, a), m, (0, 0, a / 2))
    assert about_end[0, 0] == m * a**2 / 3
    two = solids.composite([(m, solids.sphere(m, a), (d, 0, 0)), (m, solids.sphere(m, a), (-d, 0, 0))])
    assert two.center == (0, 0, 0)
    assert two.tensor[2, 2].expand() == 4 * m * a**2 / 5 + 2 * m * d**2


def test_a_hole_takes_away_what_would_fill_it():
    density = 2.0 / (np.pi * (0.7**2 - 0.4**2) * 1.1)
    full, missing = (density * np.pi * r**2 * 1.1 for r in (0.7, 0.4))
    body = solids.composite(
        [(full, solids.cylinder(full, 0.7, 1.1), (0, 0, 0))],
        holes=[(missing, solids.cylinder(missing, 0.4, 1.1), (0, 0, 0))],
    )
    assert body.mass == pytest.approx(2.0)
    np.testing.assert_allclose(body.tensor, solids.tube(2.0, 0.7, 0.4, 1.1), rtol=1e-12)


def test_an_eccentric_hole_moves_the_mass_center_away_from_it():
    """A square plate (side 2, 4 kg) without the quarter at x, y > 0, against a cloud of points."""
    body = solids.composite(
        [(4.0, solids.plate(4.0, 2.0, 2.0), (0, 0, 0))],
        holes=[(1.0, solids.plate(1.0, 1.0, 1.0), (0.5, 0.5, 0))],
    )
    points = grid(2 * MID - 1, 2 * MID - 1, [0.0])
    points = points[~((points[:, 0] > 0) & (points[:, 1] > 0))]
    np.testing.assert_allclose(body.center, points.mean(axis=0), atol=1e-12)
    np.testing.assert_allclose(
        body.tensor, integrated(points, np.ones(len(points)), 3.0), rtol=2e-3, atol=1e-12
    )
    assert body.tensor[0, 1] > 0  # the mass left lies in the second and fourth quadrant: −∫xy dm is positive


def test_a_dumb_bell_of_parts():
    ball = solids.sphere(1.0, 0.1)
    body = solids.composite([(1.0, ball, (0.5, 0, 0)), (1.0, ball, (-0.5, 0, 0))])
    assert body.center == (0.0, 0.0, 0.0)
    np.testing.assert_allclose(np.diag(body.tensor), [0.008, 0.508, 0.508])


def test_a_part_may_come_in_its_own_axes():
    """A rod at 30° to z in the z-x plane, against points along it; its axis is the third column."""
    angle = np.radians(30.0)
    rotation = [[np.cos(angle), 0, np.sin(angle)], [0, 1, 0], [-np.sin(angle), 0, np.cos(angle)]]
    body = solids.composite([(2.0, solids.rod(2.0, 1.4), (1.0, 2.0, 3.0), rotation)])
    points = 1.4 * (np.linspace(0, 1, 20001)[:, None] - 0.5) * [np.sin(angle), 0, np.cos(angle)]
    np.testing.assert_allclose(body.tensor, integrated(points, np.ones(20001), 2.0), rtol=2e-4, atol=1e-12)
    assert body.tensor[0, 2] < 0  # the rod lies where z and x have the same sign


def test_a_rotation_may_come_from_a_reference_frame():
    m, a, beta = sm.symbols("m a beta")
    common = ReferenceFrame("N")
    own = common.orientnew("B", "Axis", (beta, common.y))
    body = solids.composite([(m, solids.rod(m, a), (0, 0, 0), common.dcm(own))])
    axis = own.z.to_matrix(common)
    expected = m * a**2 / 12 * (sm.eye(3) - axis * axis.T)
    difference = (body.tensor - expected).subs({m: 2, a: 3, beta: sm.pi / 7}).evalf()
    assert max(abs(x) for x in difference) < 1e-12


def test_the_order_of_parts_does_not_matter():
    parts = [
        (1.0, solids.sphere(1.0, 0.1), (0.5, 0.1, 0)),
        (2.0, solids.box(2.0, 0.1, 0.2, 0.3), (0.0, -0.2, 0.4)),
        (0.5, solids.cone(0.5, 0.1, 0.3), (0.3, 0.3, 0.3)),
    ]
    tensors = [solids.composite(order).tensor for order in itertools.permutations(parts)]
    for tensor in tensors:
        np.testing.assert_allclose(tensor, tensors[0], rtol=1e-12, atol=1e-15)


SMALL = solids.sphere(1.0, 0.1)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: solids.cylinder(-1, 1, 1), "mass is -1: it must be greater than zero"),
        (lambda: solids.tube(1, 0.2, 0.4, 1), "inner radius 0.4 m exceeds the outer radius 0.2 m"),
        (lambda: solids.sphere(1, float("nan")), "radius is nan"),
        (lambda: solids.box(1, 0, 1, 1), "a is 0"),
        (lambda: solids.rod("2", 1), "mass is '2'"),
        (lambda: solids.rod(1, 1j), "length is 1j"),
        (lambda: solids.composite([]), "at least one part"),
        (lambda: solids.composite([(1.0, SMALL)]), "a part is"),
        (lambda: solids.composite([(1.0, SMALL, (1, 2))]), "a part is"),
        (lambda: solids.composite([(-1.0, SMALL, (0, 0, 0))]), "mass is -1.*holes="),
        (lambda: solids.composite([(1.0, SMALL, (0, 0, 0))], [(2.0, SMALL, (0, 0, 0))]), "outweigh"),
        (lambda: solids.composite([(1.0, SMALL, (0, 0, 0))], [(0.5, SMALL, (1, 0, 0))]), "negative"),
        (lambda: solids.composite([(1.0, SMALL, (0, float("inf"), 0))]), "inf"),
        (lambda: solids.composite([(1.0, SMALL, (0, 0, 0), np.diag([1, 1, 2]))]), "not orthogonal"),
    ],
)
def test_bad_input_is_refused_with_its_reason(make, message):
    with pytest.raises(ed.EngdynError, match=message):
        make()
