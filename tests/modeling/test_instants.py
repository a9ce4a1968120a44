"""Numbers at one instant: coordinates with their rates, components, rotation matrices."""

from __future__ import annotations

import numpy as np
import pytest
import sympy as sm
from sympy.physics.mechanics import ReferenceFrame, dynamicsymbols

import engdyn as ed
from modeling.turning import turn

t = dynamicsymbols._t
theta, r = dynamicsymbols("theta r")
L = sm.Symbol("L", positive=True)


def test_a_given_motion_with_its_rates():
    found = ed.motion_at({theta: sm.sin(2 * t), r: 3}, 0.25)
    assert found == pytest.approx(
        {
            "theta": np.sin(0.5),
            "theta_d": 2 * np.cos(0.5),
            "theta_dd": -4 * np.sin(0.5),
            "r": 3,
            "r_d": 0,
            "r_dd": 0,
        }
    )


@pytest.mark.parametrize(
    ("paths", "message"),
    [
        ({"theta": t}, "no coordinate"),
        ({theta.diff(): t}, "no coordinate"),
        ({theta: L * t}, "the time t alone"),
        ({theta: r}, "the time t alone"),
        ({theta: "t"}, "not text"),
        ({theta: sm.sqrt(t - 1)}, "not a finite real number"),
    ],
)
def test_paths_that_make_no_sense(paths, message):
    with pytest.raises(ed.EngdynError, match=message):
        ed.motion_at(paths, 0.0)


def test_components_come_from_any_frames():
    N, A, B = (ReferenceFrame(name) for name in "NAB")
    A.orient_axis(N, theta, N.z)
    B.orient_axis(A, 0.3, A.x)
    values = {theta: 0.7, "r": 2.0, r.diff(): -1.0, L: 0.5}
    vector = r * A.x + r.diff() * N.y + L * B.z
    to_ground = {"A": turn(2, 0.7), "B": turn(2, 0.7) @ turn(0, 0.3)}
    expected = to_ground["A"] @ [2, 0, 0] + [0, -1, 0] + to_ground["B"] @ [0, 0, 0.5]
    np.testing.assert_allclose(ed.components(vector, N, values), expected, atol=1e-15)
    np.testing.assert_allclose(ed.components(vector, B, values), to_ground["B"].T @ expected, atol=1e-15)
    np.testing.assert_allclose(ed.rotation_matrix(B, N, values), to_ground["B"], atol=1e-15)
    np.testing.assert_allclose(ed.rotation_matrix(N, B, values), to_ground["B"].T, atol=1e-15)
    np.testing.assert_array_equal(ed.rotation_matrix(N, N, {}), np.eye(3))


def test_missing_numbers_and_other_things_are_refused():
    N = ReferenceFrame("N")
    with pytest.raises(ed.EngdynError, match="values lacks r_d"):
        ed.components(r.diff() * N.x, N, {"r": 1.0})
    with pytest.raises(ed.EngdynError, match="no vector"):
        ed.components(3, N, {})
    with pytest.raises(ed.EngdynError, match="finite"):
        ed.components(r * N.x, N, {"r": float("nan")})
    with pytest.raises(ed.EngdynError, match="not oriented"):
        ed.rotation_matrix(ReferenceFrame("Z"), N, {})
