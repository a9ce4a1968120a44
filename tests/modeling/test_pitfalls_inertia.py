"""Pitfall 4: transfer of the inertia tensor goes through G, and products of inertia have one sign."""

from __future__ import annotations

import numpy as np
import pytest
import sympy as sm

import engdyn as ed
from engdyn.modeling.inertia import check_tensor

MASSES = np.array([2.0, 1.0, 3.0, 0.5])
POINTS = np.array([[0.3, 0.1, -0.2], [-0.4, 0.5, 0.3], [0.2, -0.3, 0.6], [0.7, 0.4, -0.5]])
MASS = float(MASSES.sum())
G = MASSES @ POINTS / MASS
O, P = np.array([1.0, -0.5, 0.25]), np.array([-0.75, 1.25, 0.5])


def about(point):
    """The definition Σ m (r² 1 − r rᵀ), written without the package."""
    arms = POINTS - point
    return sum(m * (r @ r * np.eye(3) - np.outer(r, r)) for m, r in zip(MASSES, arms, strict=True))


def steiner(d):
    return MASS * (d @ d * np.eye(3) - np.outer(d, d))


def test_the_tensor_is_its_definition():
    np.testing.assert_allclose(ed.inertia_tensor(MASSES, POINTS - O), about(O), rtol=1e-12)


def test_the_way_from_one_point_to_another_goes_through_the_mass_center():
    found = ed.parallel_axis(about(O), MASS, P - G, start=O - G)
    np.testing.assert_allclose(found, about(P), rtol=1e-12)


def test_out_and_back_is_the_identity():
    out = ed.parallel_axis(about(G), MASS, O - G)
    back = ed.parallel_axis(out, MASS, (0, 0, 0), start=O - G)
    np.testing.assert_allclose(back, about(G), rtol=1e-12)
    around = ed.parallel_axis(ed.parallel_axis(out, MASS, P - G, start=O - G), MASS, O - G, start=P - G)
    np.testing.assert_allclose(around, about(O), rtol=1e-12)


def test_the_direct_way_is_wrong_by_a_known_amount():
    """Adding m S(P − O) to I_O leaves the error m [S(O) + S(P − O) − S(P)], all counted from G."""
    wrong = ed.parallel_axis(about(O), MASS, P - O)
    error = steiner(O - G) + steiner(P - O) - steiner(P - G)
    np.testing.assert_allclose(wrong - about(P), error, rtol=1e-9)
    assert np.max(abs(error)) > 0.5 * np.max(abs(about(P)))
    # For a moment about z: twice the mass times (O − G)·(O − P), the z components left out.
    assert error[2, 2] == pytest.approx(2 * MASS * (O - G)[:2] @ (O - P)[:2])


def test_two_steps_outward_are_not_one():
    """In symbols: the wrong chain G → O → P misses by 2 m a b for steps a and b along one line."""
    m, a, b, J = sm.symbols("m a b J", positive=True)
    tensor = J * sm.eye(3)
    chained = ed.parallel_axis(ed.parallel_axis(tensor, m, (a, 0, 0)), m, (b, 0, 0))
    right = ed.parallel_axis(tensor, m, (a + b, 0, 0))
    assert sm.expand(right[2, 2] - chained[2, 2]) == 2 * m * a * b
    through_center = ed.parallel_axis(
        ed.parallel_axis(tensor, m, (a, 0, 0)), m, (a + b, 0, 0), start=(a, 0, 0)
    )
    assert (through_center - right).expand() == sm.zeros(3)


def test_a_tensor_that_does_not_refer_to_the_point_named_is_flagged():
    """Whoever takes I_G for I_O and goes back to G arrives at a body that cannot be."""
    with pytest.raises(ed.EngdynError, match="does not refer to the point"):
        ed.parallel_axis(about(G), MASS, (0, 0, 0), start=O - G)


def test_elements_of_the_tensor_carry_the_minus_sign():
    """One mass in the first quadrant: the element is −m x y, and only so is H = I ω."""
    tensor = ed.inertia_tensor([2.0], [(1.0, 3.0, 0.0)])
    assert tensor[0, 1] == -6.0
    spin, r = np.array([0.0, 1.0, 0.0]), np.array([1.0, 3.0, 0.0])
    momentum = 2.0 * np.cross(r, np.cross(spin, r))
    np.testing.assert_allclose(tensor @ spin, momentum)
    other_convention = np.where(np.eye(3, dtype=bool), tensor, -tensor)
    assert not np.allclose(other_convention @ spin, momentum)


def test_products_move_with_the_sign_of_both_offsets():
    """Steiner's share of a product is −m dx dy: negative in the first and third quadrant, else positive."""
    for x, y in ((1, 1), (-1, 1), (-1, -1), (1, -1)):
        assert ed.parallel_axis(np.eye(3), 2.0, (x, 0.5 * y, 0))[0, 1] == -x * y


def test_the_wrong_sign_mirrors_the_principal_axes_and_spoils_three_products():
    """With one product a wrong sign only mirrors the axes; with three it changes the moments themselves."""
    right = about(G)
    wrong = np.where(np.eye(3, dtype=bool), right, -right)
    assert not np.allclose(ed.principal_axes(right).moments, np.linalg.eigvalsh(wrong), rtol=1e-3)
    flat = ed.inertia_tensor([1.0, 2.0], [(1.0, 0.5, 0.0), (-0.5, -0.4, 0.0)])
    mirrored = np.where(np.eye(3, dtype=bool), flat, -flat)
    a, b = ed.principal_axes(flat), ed.principal_axes(mirrored)
    np.testing.assert_allclose(a.moments, b.moments, atol=1e-12)
    np.testing.assert_allclose(abs(a.axes[0, 0] * a.axes[1, 0]), abs(b.axes[0, 0] * b.axes[1, 0]))
    assert np.sign(a.axes[0, 0] * a.axes[1, 0]) == -np.sign(b.axes[0, 0] * b.axes[1, 0])


def test_every_body_is_semidefinite_and_keeps_the_triangle():
    rng = np.random.default_rng(3)
    for _ in range(200):
        count = int(rng.integers(1, 6))
        tensor = ed.inertia_tensor(rng.uniform(0, 2, count), rng.normal(size=(count, 3)))
        moments = np.linalg.eigvalsh(tensor)
        assert moments[0] >= -1e-12
        assert moments[0] + moments[1] >= moments[2] * (1 - 1e-12)
        check_tensor(tensor)
    # Planar bodies reach the limit: J_x + J_y = J_z.
    flat = ed.inertia_tensor([1.0, 2.0, 3.0], [(1, 2, 0), (-1, 1, 0), (0, -2, 0)])
    assert flat[0, 0] + flat[1, 1] == pytest.approx(flat[2, 2])
