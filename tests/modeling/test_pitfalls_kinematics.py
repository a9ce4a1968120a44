"""Pitfall 2: which ω belongs to a derivative, and where the angular acceleration comes from."""

from __future__ import annotations

import numpy as np
import pytest
import sympy as sm
from sympy.physics.mechanics import ReferenceFrame, dynamicsymbols
from sympy.physics.vector import Vector

import engdyn as ed
from engdyn.systems import w02_manipulator as w02
from modeling.turning import as_function, bend, slope, spin, spin_change, turn

t = dynamicsymbols._t
theta = dynamicsymbols("theta")
L = sm.Symbol("L", positive=True)
T0 = 0.6


def ring_equal(first, second, frame):
    """Whether two vectors are one, identically: decided in the exact algebra, not by numbers."""
    chain = ed.KinematicChain(frame)
    chain.move("D", first - second)
    return chain.position("D", frame) == Vector(0)


@pytest.fixture
def rod():
    """A rod about a pivot: its vector in ground axes and in rod axes."""
    N, A = ReferenceFrame("N"), ReferenceFrame("A")
    A.orient_axis(N, theta, N.z)
    return N, A, L * (sm.cos(theta) * N.x + sm.sin(theta) * N.y), L * A.x


def test_ground_axes_and_rod_axes_give_one_velocity(rod):
    N, A, in_ground, in_rod = rod
    first = ed.vector_derivative(in_ground, N, N)
    second = ed.vector_derivative(in_rod, A, N)
    assert first.of_direction == 0  # ground axes do not turn
    assert second.of_magnitude == 0  # rod axes carry constant components
    assert ring_equal(first.total, second.total, N)


def test_counting_the_rotation_twice_is_seen_to_be_different(rod):
    """The components in ground axes already contain θ; ω × r on top of their derivative counts it twice."""
    N, A, in_ground, in_rod = rod
    right = ed.vector_derivative(in_rod, A, N).total
    twice = ed.vector_derivative(in_ground, N, N).of_magnitude + A.ang_vel_in(N).cross(in_ground)
    assert not ring_equal(twice, right, N)
    assert ring_equal(twice, 2 * right, N)


def test_the_spin_of_the_body_in_place_of_that_of_its_frame_is_different():
    """A wheel on a turning axle, components in axle axes: ω of the axle enters, not that of the wheel."""
    psi, phi = dynamicsymbols("psi phi")
    N, A, W = (ReferenceFrame(name) for name in "NAW")
    A.orient_axis(N, psi, N.z)
    W.orient_axis(A, phi, A.x)
    spin_vector = W.ang_vel_in(N)
    components = sum((spin_vector.dot(axis).diff(t) * axis for axis in (A.x, A.y, A.z)), Vector(0))
    right = ed.angular_motion(W, N, A).angular_acceleration
    assert ring_equal(components + A.ang_vel_in(N).cross(spin_vector), right, N)
    assert not ring_equal(components, right, N)  # components differentiated alone
    assert not ring_equal(components + W.ang_vel_in(N).cross(spin_vector), right, N)  # the wheel's own ω


# W2 against finite differences of rotation matrices

PATHS = {w02.psi: 0.4 + 0.9 * t, w02.beta: 0.5 + 0.3 * sm.sin(2 * t), w02.r: 1.1 + 0.2 * sm.cos(1.5 * t)}
PSI, BETA, REACH = (as_function(path) for path in PATHS.values())
VALUES = {**ed.motion_at(PATHS, T0), "h": 0.6}


def column(at):
    return turn(2, PSI(at))


def boom(at):
    return column(at) @ turn(1, -BETA(at))


def tip(at):
    return np.array([0, 0, 0.6]) + boom(at) @ [REACH(at), 0, 0]


@pytest.mark.parametrize(
    ("frame", "rotation"), [(w02.column_axes, column), (w02.boom_axes, boom)], ids=["column", "boom"]
)
def test_the_frames_of_the_manipulator_turn_as_their_matrices_do(frame, rotation):
    motion = ed.angular_motion(frame, w02.ground, w02.ground).evaluate(VALUES)
    np.testing.assert_allclose(motion["angular_velocity"], spin(rotation, T0), atol=1e-6)
    np.testing.assert_allclose(motion["angular_acceleration"], spin_change(rotation, T0), atol=2e-5)
    np.testing.assert_allclose(ed.rotation_matrix(frame, w02.ground, VALUES), rotation(T0), atol=1e-12)


def test_rates_alone_miss_part_of_the_angular_acceleration_of_the_boom():
    motion = ed.angular_motion(w02.boom_axes, w02.ground, w02.ground)
    alone = sum(ed.components(step.rate_change, w02.ground, VALUES) for step in motion.steps)
    missed = spin_change(boom, T0) - alone
    expected = VALUES["psi_d"] * VALUES["beta_d"] * column(T0)[:, 0]
    assert np.linalg.norm(expected) > 0.1
    np.testing.assert_allclose(missed, expected, atol=2e-5)
    carried = sum(ed.components(step.carried, w02.ground, VALUES) for step in motion.steps)
    np.testing.assert_allclose(carried, expected, atol=1e-12)


def test_the_tip_of_the_manipulator_moves_as_its_path_does():
    load = w02.free_bodies()[2]
    chain = ed.KinematicChain(w02.ground, _foot(load.center))
    chain.add(load.body)
    velocity = ed.components(chain.velocity(load.body), w02.boom_axes, VALUES)
    acceleration = ed.components(chain.acceleration(load.body), w02.boom_axes, VALUES)
    np.testing.assert_allclose(boom(T0) @ velocity, slope(tip, T0), atol=1e-6)
    np.testing.assert_allclose(boom(T0) @ acceleration, bend(tip, T0), atol=1e-6)


def _foot(point):
    """The fixed point from which a chain of points was placed."""
    while w02.ground not in point._vel_dict:
        point = next(iter(point._pos_dict))
    return point
