"""Angular velocity and acceleration against finite differences of rotation matrices written by hand."""

from __future__ import annotations

import numpy as np
import pytest
import sympy as sm
from sympy.physics.mechanics import ReferenceFrame, dynamicsymbols

import engdyn as ed
from engdyn.modeling.rotations import AngularMotion
from modeling.turning import as_function, spin, spin_change, turn

t = dynamicsymbols._t
ANGLES = dynamicsymbols("psi beta phi")
PATHS = dict(
    zip(ANGLES, (0.4 + 0.9 * t - 0.3 * t**2, 0.7 * sm.sin(1.3 * t), 2 * t + 0.2 * t**3), strict=True)
)
FUNCTIONS = [as_function(path) for path in PATHS.values()]
T0 = 0.8


def frames_of(order):
    """Successive rotations about body-fixed axes, with the frames A, B, C."""
    ground = before = ReferenceFrame("N")
    for name, axis, angle in zip("ABC", order, ANGLES, strict=False):
        frame = ReferenceFrame(name)
        frame.orient_axis(before, (before.x, before.y, before.z)[axis], angle)
        before = frame
    return ground, before


def matrix_of(order):
    """The same rotations as a function of time, by hand."""

    def rotation(at):
        product = np.eye(3)
        for axis, path in zip(order, FUNCTIONS, strict=False):
            product = product @ turn(axis, path(at))
        return product

    return rotation


def assert_moves_like(motion, rotation):
    """ω and α, brought to ground axes by the matrix written by hand, are those of the differences."""
    found = motion.evaluate(ed.motion_at(PATHS, T0))
    to_ground = np.eye(3) if motion.axes is motion.ground else rotation(T0)
    np.testing.assert_allclose(to_ground @ found["angular_velocity"], spin(rotation, T0), atol=1e-6)
    np.testing.assert_allclose(
        to_ground @ found["angular_acceleration"], spin_change(rotation, T0), atol=2e-5
    )


BODY_FIXED = [(2, 1), (0, 2), (2, 1, 0), (2, 0, 2), (0, 1, 2), (1, 1, 2)]


@pytest.mark.parametrize("order", BODY_FIXED)
def test_successive_rotations_about_body_axes(order):
    ground, last = frames_of(order)
    motion = ed.angular_motion(last, ground)
    assert_moves_like(motion, matrix_of(order))
    assert_moves_like(motion.in_axes(ground), matrix_of(order))
    assert [str(step.frame) for step in motion.steps] == list("ABC")[: len(order)]


@pytest.mark.parametrize("order", ["XYZ", "ZXZ", "YZX"])
def test_rotations_about_space_axes(order):
    """Space-fixed x, y, z is body-fixed z, y, x: each further matrix is multiplied from the left."""
    ground, body = ReferenceFrame("N"), ReferenceFrame("B")
    body.orient_space_fixed(ground, ANGLES, order)

    def rotation(at):
        product = np.eye(3)
        for letter, path in zip(order, FUNCTIONS, strict=True):
            product = turn("XYZ".index(letter), path(at)) @ product
        return product

    assert_moves_like(ed.angular_motion(body, ground), rotation)
    assert_moves_like(ed.angular_motion(body, ground, ground), rotation)


def test_one_step_with_three_angles():
    """A frame whose ω is written in its own axes: the step's change and carry still add up to α."""
    ground, middle, body = (ReferenceFrame(name) for name in "NAB")
    middle.orient_axis(ground, ANGLES[0], ground.z)
    body.orient_body_fixed(middle, (ANGLES[1], ANGLES[2], 0), "XYZ")

    def rotation(at):
        a, b, c = (path(at) for path in FUNCTIONS)
        return turn(2, a) @ turn(0, b) @ turn(1, c)

    motion = ed.angular_motion(body, ground)
    assert_moves_like(motion, rotation)
    values = ed.motion_at(PATHS, T0)
    total = sum(ed.components(term, body, values) for _, term in motion.terms())
    np.testing.assert_allclose(total, motion.evaluate(values)["angular_acceleration"], atol=1e-12)


@pytest.mark.parametrize("order", BODY_FIXED)
def test_the_terms_add_up_and_each_is_what_it_is_called(order):
    ground, last = frames_of(order)
    motion, values = ed.angular_motion(last, ground, ground), ed.motion_at(PATHS, T0)
    found = motion.evaluate(values)
    rates = [ed.components(step.rate, ground, values) for step in motion.steps]
    np.testing.assert_allclose(sum(rates), found["angular_velocity"], atol=1e-12)
    total = sum(ed.components(term, ground, values) for _, term in motion.terms())
    np.testing.assert_allclose(total, found["angular_acceleration"], atol=1e-12)
    for i, step in enumerate(motion.steps):
        carried = np.cross(sum(rates[:i], np.zeros(3)), rates[i])
        np.testing.assert_allclose(ed.components(step.carried, ground, values), carried, atol=1e-12)
        size = values[f"{ANGLES[i].func}_dd"]
        change = rates[i] / np.linalg.norm(rates[i]) * size * np.sign(values[f"{ANGLES[i].func}_d"])
        np.testing.assert_allclose(ed.components(step.rate_change, ground, values), change, atol=1e-12)


def test_a_rate_written_in_a_third_frame():
    """Angular velocity given outright, along an axis that neither the frame nor its parent carries."""
    ground, carrier, body = (ReferenceFrame(name) for name in "NAB")
    carrier.orient_axis(ground, ANGLES[0], ground.z)
    body.set_ang_vel(ground, ANGLES[1] * carrier.x)  # the second angle serves as a speed
    motion, values = ed.angular_motion(body, ground, ground), ed.motion_at(PATHS, T0)
    x, y = turn(2, values["psi"])[:, 0], turn(2, values["psi"])[:, 1]
    expected = values["beta_d"] * x + values["beta"] * values["psi_d"] * y
    np.testing.assert_allclose(motion.evaluate(values)["angular_acceleration"], expected, atol=1e-12)
    (step,) = motion.steps
    np.testing.assert_allclose(ed.components(step.rate_change, ground, values), expected, atol=1e-12)
    assert step.carried == 0


def test_steady_rates_still_need_an_angular_acceleration():
    """Yaw and elevation at constant rates: α is ψ' β' about the horizontal axis below the boom."""
    psi, beta, _ = ANGLES
    ground, column, boom = (ReferenceFrame(name) for name in "NAB")
    column.orient_axis(ground, psi, ground.z)
    boom.orient_axis(column, -beta, column.y)
    motion = ed.angular_motion(boom, ground, column)
    steady = {a.diff(t, 2): 0 for a in (psi, beta)}
    assert motion.angular_acceleration.xreplace(steady) == psi.diff() * beta.diff() * column.x
    assert motion.steps[1].carried == psi.diff() * beta.diff() * column.x


def test_finite_rotations_do_not_add_small_ones_nearly_do():
    first, second = turn(0, np.pi / 2), turn(2, np.pi / 2)
    assert np.abs(first @ second - second @ first).max() == pytest.approx(1.0)
    gaps = [np.abs(turn(0, e) @ turn(2, e) - turn(2, e) @ turn(0, e)).max() for e in (1e-2, 1e-3)]
    assert gaps[0] / gaps[1] == pytest.approx(100.0, rel=0.02)


def test_a_frame_in_itself_does_not_turn():
    ground = ReferenceFrame("N")
    motion = ed.angular_motion(ground, ground)
    assert motion.steps == ()
    assert motion.angular_velocity == 0
    assert "0" in motion._repr_latex_()


def test_results_read_well():
    ground, last = frames_of((2, 1))
    motion = ed.angular_motion(last, ground)
    assert isinstance(motion, AngularMotion)
    assert "AngularMotion(B in N" in repr(motion)
    latex = motion._repr_latex_()
    assert r"\underbrace" in latex
    assert r"\dot{\psi}" in latex


def test_what_is_no_frame_or_not_oriented_is_refused():
    ground, last = frames_of((2, 1))
    with pytest.raises(ed.EngdynError, match="no frame"):
        ed.angular_motion("B", ground)
    with pytest.raises(ed.EngdynError, match="not oriented"):
        ed.angular_motion(ReferenceFrame("Z"), ground)
    with pytest.raises(ed.EngdynError, match="not oriented"):
        ed.angular_motion(last, ground, ReferenceFrame("Z"))
