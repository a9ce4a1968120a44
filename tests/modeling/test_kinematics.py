"""Derivatives of vectors and the five acceleration terms, against finite differences of rotation matrices."""

from __future__ import annotations

import math

import numpy as np
import pytest
import sympy as sm
from sympy.physics.mechanics import Point, ReferenceFrame, dynamicsymbols

from engdyn.errors import EngdynError
from engdyn.modeling.instants import components, number_at
from engdyn.modeling.kinematics import acceleration_terms, vector_derivative

T0, H = 0.7, 1e-4
t = dynamicsymbols._t
theta, psi, r, x = dynamicsymbols("theta psi r x")
PATHS = {theta: 0.3 + 1.1 * sm.sin(2 * t), psi: 0.5 * t**2, r: 0.4 + 0.2 * sm.cos(3 * t), x: 0.3 * t**3}


def numbers(at=T0):
    """Values of all coordinates and their first two derivatives."""
    found = {}
    for q, path in PATHS.items():
        for k in (0, 1, 2):
            found[q.func.__name__ + ("_" + "d" * k if k else "")] = (
                float(path.diff(t, k).subs(t, at)) if k else float(path.subs(t, at))
            )
    return found


def turned(angle, axis):
    """Rotation matrix: components in the turned axes into the old ones."""
    c, s = math.cos(angle), math.sin(angle)
    return np.array({"y": [[c, 0, s], [0, 1, 0], [-s, 0, c]], "z": [[c, -s, 0], [s, c, 0], [0, 0, 1]]}[axis])


@pytest.fixture
def arm():
    """A base on a rail, a column that turns about z, a boom that tilts about y, a collar on the boom."""
    N, A, B = (ReferenceFrame(name) for name in "NAB")
    A.orient_axis(N, psi, N.z)
    B.orient_axis(A, theta, A.y)
    O = Point("O")
    O.set_vel(N, 0)
    base = O.locatenew("C", x * N.x)
    return N, A, B, base, base.locatenew("P", r * B.x)


def place(at):
    v = numbers(at)
    return np.array([v["x"], 0, 0]) + turned(v["psi"], "z") @ turned(v["theta"], "y") @ [v["r"], 0, 0]


def test_the_five_terms_add_up_to_the_second_difference_of_the_path(arm):
    N, _, B, base, P = arm
    parts = acceleration_terms(P, base, B, N).evaluate(numbers())
    v = numbers()
    to_ground = turned(v["psi"], "z") @ turned(v["theta"], "y")
    measured = (place(T0 + H) - 2 * place(T0) + place(T0 - H)) / H**2
    np.testing.assert_allclose(to_ground @ parts["total"], measured, rtol=2e-6, atol=2e-6)
    np.testing.assert_allclose(sum(parts[n] for n in parts if n != "total"), parts["total"], atol=1e-12)


def test_each_term_is_what_its_name_says(arm):
    N, _, B, base, P = arm
    v = numbers()
    parts = acceleration_terms(P, base, B, N).evaluate(v)
    up = turned(v["theta"], "y").T @ [0, 0, 1]  # the column's axis in boom axes
    omega = v["psi_d"] * up + np.array([0, v["theta_d"], 0])
    crossed = np.cross(v["psi_d"] * up, [0, v["theta_d"], 0])  # psi' z × theta' y
    alpha = v["psi_dd"] * up + np.array([0, v["theta_dd"], 0]) + crossed
    arm_vector, seen = np.array([v["r"], 0, 0]), np.array([v["r_d"], 0, 0])
    to_boom = (turned(v["psi"], "z") @ turned(v["theta"], "y")).T
    np.testing.assert_allclose(parts["base"], to_boom @ [v["x_dd"], 0, 0], atol=1e-12)
    np.testing.assert_allclose(parts["tangential"], np.cross(alpha, arm_vector), atol=1e-12)
    np.testing.assert_allclose(parts["centripetal"], np.cross(omega, np.cross(omega, arm_vector)), atol=1e-12)
    np.testing.assert_allclose(parts["coriolis"], 2 * np.cross(omega, seen), atol=1e-12)
    np.testing.assert_allclose(parts["relative"], [v["r_dd"], 0, 0], atol=1e-12)


def test_magnitudes_are_norms(arm):
    N, _, B, base, P = arm
    terms = acceleration_terms(P, base, B, N)
    parts, sizes = terms.evaluate(numbers()), terms.magnitudes(numbers())
    assert set(sizes) == {"base", "tangential", "centripetal", "coriolis", "relative", "total"}
    for name, size in sizes.items():
        assert size == pytest.approx(np.linalg.norm(parts[name]))


def test_growth_and_turning_are_told_apart():
    N, A = ReferenceFrame("N"), ReferenceFrame("A")
    A.orient_axis(N, theta, N.z)
    change = vector_derivative(r * A.x, A, N)
    assert change.of_magnitude == r.diff() * A.x
    assert change.of_direction == r * theta.diff() * A.y
    assert change.total == change.of_magnitude + change.of_direction


def test_the_same_vector_in_both_bases_has_one_derivative():
    """Components in ground axes change, those in rod axes do not: the sum is the same (section 1.3)."""
    N, A = ReferenceFrame("N"), ReferenceFrame("A")
    A.orient_axis(N, theta, N.z)
    length = sm.Symbol("l", positive=True)
    in_rod = vector_derivative(length * A.x, A, N)
    in_ground = vector_derivative(length * (sm.cos(theta) * N.x + sm.sin(theta) * N.y), N, N)
    assert in_rod.of_magnitude == 0
    assert in_ground.of_direction == 0
    difference = (in_rod.total - in_ground.total).to_matrix(N)
    assert difference.applyfunc(sm.trigsimp) == sm.zeros(3, 1)


def test_the_wrong_treatment_is_seen():
    """Adding ω × r to components that contain the rotation already counts it twice."""
    N, A = ReferenceFrame("N"), ReferenceFrame("A")
    A.orient_axis(N, theta, N.z)
    rod = sm.cos(theta) * N.x + sm.sin(theta) * N.y
    right = vector_derivative(rod, N, N).total
    twice = vector_derivative(rod, N, N).of_magnitude + A.ang_vel_in(N).cross(rod)
    assert right.to_matrix(N) * 2 == twice.to_matrix(N)


@pytest.mark.parametrize("vector", [3, sm.Symbol("v"), None])
def test_what_is_no_vector_is_refused(vector):
    N = ReferenceFrame("N")
    with pytest.raises(EngdynError, match="give a Vector"):
        vector_derivative(vector, N, N)


def test_unconnected_points_frames_and_missing_numbers(arm):
    N, _, B, base, P = arm
    with pytest.raises(EngdynError, match="connect them"):
        acceleration_terms(Point("X"), base, B, N)
    with pytest.raises(EngdynError, match="orient"):
        vector_derivative(N.x, ReferenceFrame("Z"), N)
    with pytest.raises(EngdynError, match="values lacks"):
        acceleration_terms(P, base, B, N).evaluate({"theta": 1.0})


def test_forgetting_a_term_leaves_the_others(arm):
    N, _, B, base, P = arm
    terms = acceleration_terms(P, base, B, N)
    parts = terms.evaluate(numbers())
    left = components(terms.without("coriolis", "base"), B, numbers())
    expected = parts["total"] - parts["coriolis"] - parts["base"]
    np.testing.assert_allclose(left, expected, atol=1e-12)
    assert terms.without() == terms.total
    with pytest.raises(EngdynError, match="no term 'Euler': choose among base, tangential"):
        terms.without("Euler")


def test_the_table_gives_magnitudes_and_unit_vectors(arm):
    N, _, B, base, P = arm
    terms = acceleration_terms(P, base, B, N)
    table, parts = terms.table(numbers()), terms.evaluate(numbers())
    assert list(table.index) == ["base", "tangential", "centripetal", "coriolis", "relative", "total"]
    for name, row in table.iterrows():
        np.testing.assert_allclose(row.iloc[0] * row.iloc[1:].to_numpy(), parts[name], atol=1e-12)
        assert np.linalg.norm(row.iloc[1:]) == pytest.approx(1.0)


def test_a_term_that_is_zero_has_no_direction(arm):
    N, _, B, _, _ = arm
    fixed = Point("O")
    fixed.set_vel(N, 0)
    tip = fixed.locatenew("T", 2 * B.x)
    table = acceleration_terms(tip, fixed, B, N).table(numbers())
    assert table.loc["coriolis"].iloc[0] == 0
    assert table.loc["coriolis"].iloc[1:].isna().all()


def test_rounding_has_no_direction(arm):
    N, _, B, base, P = arm
    v = {**numbers(), "r_dd": 1e-17}
    table = acceleration_terms(P, base, B, N).table(v)
    assert table.loc["relative"].iloc[0] == 0
    assert table.loc["relative"].iloc[1:].isna().all()


def test_symbolic_magnitudes_are_those_of_the_numbers(arm):
    N, _, B, base, P = arm
    terms = acceleration_terms(P, base, B, N)
    sizes, found = terms.magnitudes(numbers()), terms.symbolic_magnitudes()
    for name, size in found.items():
        assert number_at(size, numbers()) == pytest.approx(sizes[name], rel=1e-12)
    assert found["relative"] == sm.Abs(r.diff(t, 2))
    # the carriage accelerates along a ground axis: all sines and cosines cancel
    assert found["base"] == sm.Abs(x.diff(t, 2))
