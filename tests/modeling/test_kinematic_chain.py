"""Kinematic chains against finite differences of positions written by hand, and the count of what is free."""

from __future__ import annotations

import math

import numpy as np
import pytest
import sympy as sm
from sympy.physics.mechanics import Particle, Point, ReferenceFrame, RigidBody, dynamicsymbols, inertia

import engdyn as ed
from modeling.turning import as_function, bend, slope, spin, spin_change, turn

t = dynamicsymbols._t
theta, phi, r, x, psi, beta = dynamicsymbols("theta phi r x psi beta")
h, R, l = sm.symbols("h R l", positive=True)
PATHS = {
    theta: 0.3 + 1.1 * sm.sin(2 * t),
    psi: 0.5 * t**2,
    beta: 0.6 * sm.cos(t),
    r: 0.4 + 0.2 * sm.cos(3 * t),
    x: 0.3 * t**3,
}
AT = {q.func.__name__: as_function(path) for q, path in PATHS.items()}
T0 = 0.7
VALUES = {**ed.motion_at(PATHS, T0), "h": 0.6}


@pytest.fixture
def rig():
    """A carriage on a rail, a column that turns on it, a boom that is raised, a load on the boom."""
    chain = ed.KinematicChain("N", origin="O")
    chain.move("C", x * chain.ground.x, meaning="carriage")
    A = chain.turn("A", about=chain.ground.z, by=psi, meaning="column")
    chain.move("S", h * A.z, meaning="shoulder")
    B = chain.turn("B", about=A.y, by=-beta, meaning="boom")
    chain.move("P", r * B.x, meaning="load")
    return chain


def place(at):
    """The load in ground axes."""
    column = turn(2, AT["psi"](at))
    boom = column @ turn(1, -AT["beta"](at))
    return np.array([AT["x"](at), 0, 0.6]) + boom @ [AT["r"](at), 0, 0]


def matrices():
    column = turn(2, AT["psi"](T0))
    return {"N": np.eye(3), "A": column, "B": column @ turn(1, -AT["beta"](T0))}


@pytest.mark.parametrize("axes", ["N", "A", "B"])
def test_position_velocity_and_acceleration_in_any_axes(rig, axes):
    to_ground = matrices()[axes]
    for quantity, expected in (
        (rig.position("P", axes), place(T0)),
        (rig.velocity("P", axes), slope(place, T0)),
        (rig.acceleration("P", axes), bend(place, T0)),
    ):
        assert {frame for _, frame in quantity.args} == {rig.frame(axes)}
        found = ed.components(quantity, rig.frame(axes), VALUES)
        np.testing.assert_allclose(to_ground @ found, expected, rtol=2e-6, atol=2e-6)


@pytest.mark.parametrize("axes", ["N", "A", "B"])
def test_angular_velocity_and_acceleration_in_any_axes(rig, axes):
    def boom(at):
        return turn(2, AT["psi"](at)) @ turn(1, -AT["beta"](at))

    to_ground = matrices()[axes]
    omega = ed.components(rig.angular_velocity("B", axes), rig.frame(axes), VALUES)
    alpha = ed.components(rig.angular_acceleration("B", axes), rig.frame(axes), VALUES)
    np.testing.assert_allclose(to_ground @ omega, spin(boom, T0), atol=1e-6)
    np.testing.assert_allclose(to_ground @ alpha, spin_change(boom, T0), atol=2e-5)


def test_an_observer_on_the_column_sees_the_boom_move_in_a_plane(rig):
    def seen(at):
        return turn(1, -AT["beta"](at)) @ [AT["r"](at), 0, 0]

    relative = rig.velocity("P", axes="A", base="S", seen_from="A")
    np.testing.assert_allclose(ed.components(relative, rig.frame("A"), VALUES), slope(seen, T0), atol=1e-6)
    bent = rig.acceleration("P", axes="A", base="S", seen_from="A")
    np.testing.assert_allclose(ed.components(bent, rig.frame("A"), VALUES), bend(seen, T0), atol=1e-6)
    assert rig.velocity("P", base="S", seen_from="B") == r.diff() * rig.frame("B").x


def test_the_velocity_from_a_moving_base_as_the_ground_sees_it(rig):
    found = ed.components(rig.velocity("P", "N", base="C"), rig.ground, VALUES)
    carriage = np.array([VALUES["x_d"], 0, 0])
    np.testing.assert_allclose(found, slope(place, T0) - carriage, atol=1e-6)


def test_results_are_short_in_the_axes_of_the_last_vector():
    chain = ed.KinematicChain("N")
    A = chain.turn("A", about=chain.ground.z, by=theta)
    chain.move("P", r * A.x)
    assert chain.velocity("P") == r.diff() * A.x + r * theta.diff() * A.y
    radial, transverse = (chain.acceleration("P").dot(axis) for axis in (A.x, A.y))
    assert radial == r.diff(t, 2) - r * theta.diff() ** 2
    assert transverse == r * theta.diff(t, 2) + 2 * r.diff() * theta.diff()


def test_the_five_terms_add_up_to_the_acceleration(rig):
    terms = rig.acceleration_terms("P", "S", "B")
    whole = ed.components(rig.acceleration("P", "B"), rig.frame("B"), VALUES)
    np.testing.assert_allclose(ed.components(terms.total, rig.frame("B"), VALUES), whole, atol=1e-12)


def test_what_is_built_are_points_for_free_bodies(rig):
    """sympy's own velocity of the point, computed its own way, is the same."""
    P = rig.point("P")
    np.testing.assert_allclose(
        ed.components(P.vel(rig.ground), rig.ground, VALUES),
        ed.components(rig.velocity("P", "N"), rig.ground, VALUES),
        atol=1e-12,
    )


# Degrees of freedom


def test_coordinates_that_appear_are_counted(rig):
    assert rig.coordinates == (x, psi, beta, r)
    assert rig.degrees_of_freedom == 4


def test_a_prescribed_base_is_no_degree_of_freedom():
    chain = ed.KinematicChain("N", prescribed=[x])
    chain.move("C", x * chain.ground.x)
    A = chain.turn("A", about=chain.ground.z, by=theta)
    chain.move("P", r * A.x)
    assert chain.coordinates == (theta, r)
    assert chain.degrees_of_freedom == 2
    assert ed.components(chain.velocity("C"), chain.ground, VALUES)[0] == VALUES["x_d"]


def crank():
    """Slider-crank: the rod's end must lie on the line of the ram."""
    chain = ed.KinematicChain("N")
    A = chain.turn("A", about=chain.ground.z, by=theta)
    chain.move("A1", R * A.x)
    B = chain.turn("B", about=chain.ground.z, by=phi)
    chain.move("B1", l * B.x)
    ram = chain.move("S", x * chain.ground.x, start="O")
    chain.constrain(chain.point("B1").pos_from(ram), meaning="the loop closes")
    return chain


def test_a_closed_loop_leaves_one_degree_of_freedom():
    chain = crank()
    assert chain.coordinates == (theta, phi, x)
    assert len(chain.constraints) == 2  # the third component of the loop is 0 = 0
    assert chain.degrees_of_freedom == 1


def test_the_same_condition_twice_counts_once():
    chain = crank()
    chain.constrain(3 * chain.constraints[0] + sm.sin(theta) * chain.constraints[1] * 0)
    chain.constrain(chain.constraints[0] + chain.constraints[1])
    assert len(chain.constraints) == 4
    assert chain.degrees_of_freedom == 1
    assert "2 constraints (of 4, 2 dependent) = 1" in repr(chain)


def test_a_third_bar_in_a_parallelogram_takes_nothing_away():
    """Overconstrained: only in the configurations that exist are two of the conditions dependent."""
    one, two, three, coupler = dynamicsymbols("one two three coupler")
    chain = ed.KinematicChain("N")
    N = chain.ground
    bars = [chain.turn(name, N.z, q) for name, q in zip(("A", "B", "C"), (one, two, three), strict=True)]
    D = chain.turn("D", N.z, coupler)
    for bar, foot in zip(bars[1:], (2, 1), strict=True):
        chain.constrain(l * bars[0].x + foot * D.x - foot * N.x - l * bar.x)
    assert chain.degrees_of_freedom == 0
    parallel = {"one": 0.8, "two": 0.8, "three": 0.8, "coupler": 0.0, "l": 0.7}
    assert chain.degrees_of_freedom_at(parallel) == 1
    with pytest.raises(ed.EngdynError, match="violate the constraint"):
        chain.degrees_of_freedom_at({**parallel, "three": 0.9})


def test_rolling_is_counted_from_its_rates():
    chain = ed.KinematicChain("N")
    chain.move("G", x * chain.ground.x + R * chain.ground.y)
    chain.turn("W", about=chain.ground.z, by=-theta)
    chain.constrain(x.diff() - R * theta.diff(), meaning="rolls")
    assert chain.degrees_of_freedom == 1
    assert chain.degrees_of_freedom_at({"x": 1.0, "theta": 2.0, "R": 0.3, "x_d": 0.6, "theta_d": 2.0}) == 1


def test_a_crank_at_its_dead_center_keeps_one_degree_of_freedom():
    dead = {"theta": 0.0, "phi": 0.0, "x": 1.3, "R": 0.3, "l": 1.0}
    assert crank().degrees_of_freedom_at(dead) == 1


# What others made


def test_frames_points_and_bodies_made_with_sympy_are_taken_in():
    N, A = ReferenceFrame("N"), ReferenceFrame("A")
    A.orient_axis(N, theta, N.z)
    O = Point("O")
    pivot = O.locatenew("Q", x * N.x)
    center = pivot.locatenew("G", h / 2 * A.x)
    body = RigidBody("bar", center, A, sm.Symbol("m"), (inertia(A, 0, 0, 1), center))
    chain = ed.KinematicChain(N, O)
    chain.add(body, Particle("p", center, 1))
    assert list(chain.points) == ["O", "Q", "G"]
    assert list(chain.frames) == ["N", "A"]
    assert chain.degrees_of_freedom == 2
    v = chain.velocity(body, axes=N)
    assert v == chain.velocity("G", axes="N")
    assert chain.angular_velocity(body) == theta.diff() * A.z
    np.testing.assert_allclose(
        ed.components(v, N, VALUES), ed.components(center.vel(N), N, VALUES), atol=1e-12
    )


def test_frames_inside_vectors_need_not_be_named():
    N, A, B = (ReferenceFrame(name) for name in "NAB")
    A.orient_axis(N, theta, N.z)
    B.orient_axis(A, phi, A.x)
    chain = ed.KinematicChain(N)
    chain.move("P", h * B.y)
    assert list(chain.frames) == ["N", "A", "B"]
    assert chain.coordinates == (theta, phi)


def test_an_origin_that_moves_is_respected():
    N = ReferenceFrame("N")
    O = Point("O")
    O.set_vel(N, 2 * t * N.x)
    chain = ed.KinematicChain(N, O)
    A = chain.turn("A", about=N.z, by=theta)
    chain.move("P", h * A.x)
    assert chain.steps[0].kind == "moving point"
    found = ed.components(chain.acceleration("P", N), N, {**VALUES, "t": T0})
    v = VALUES
    inward, along = -0.6 * v["theta_d"] ** 2, 0.6 * v["theta_dd"]
    c, s = math.cos(v["theta"]), math.sin(v["theta"])
    np.testing.assert_allclose(found, [2 + inward * c - along * s, inward * s + along * c, 0], atol=1e-12)


def test_an_origin_placed_from_a_fixed_point_is_not_nailed_down():
    N = ReferenceFrame("N")
    fixed = Point("F")
    fixed.set_vel(N, 0)
    cart = fixed.locatenew("C", x * N.x)
    chain = ed.KinematicChain(N, cart)
    assert chain.velocity("C", N) == x.diff() * N.x
    assert chain.steps[0].kind == "moving point"


# Reading and refusing


def test_the_table_tells_every_step(rig):
    html = rig._repr_html_()
    for text in ("fixed point", "carriage", "column", r"\mathbf{r}_{SP}", r"\boldsymbol{\omega}_{B/A}"):
        assert text in html
    assert "4 coordinates - 0 constraints = 4" in html
    assert html.count("<tr>") == 1 + len(rig.steps)
    chain = crank()
    assert "3 coordinates - 2 constraints = 1" in chain._repr_html_()
    assert "the loop closes" in chain._repr_html_()


def test_names_are_shown_as_text_not_as_markup():
    chain = ed.KinematicChain("N")
    chain.move("P", h * chain.ground.x, meaning="<b>bold</b>")
    assert "<b>" not in chain._repr_html_()


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        (lambda c: c.move("P", 3), "give a Vector"),
        (lambda c: c.move("O", c.ground.x), "already"),
        (lambda c: c.move("", c.ground.x), "no name"),
        (lambda c: c.move("P", c.ground.x, start="Q"), "no point 'Q'"),
        (lambda c: c.move("P", ReferenceFrame("Z").x), "not oriented"),
        (lambda c: c.turn("A", "z", theta), "the axis"),
        (lambda c: c.turn("A", c.ground.z, "theta"), "not text"),
        (lambda c: c.turn("A", theta * c.ground.z, phi), "not fixed in N"),
        (lambda c: c.turn("N", c.ground.z, theta), "already"),
        (lambda c: c.velocity("Z"), "no point 'Z'"),
        (lambda c: c.velocity("O", axes="Z"), "no frame 'Z'"),
        (lambda c: c.velocity(Point("O")), "no point"),
        (lambda c: c.add(Point("X")), "not placed"),
        (lambda c: c.add(7), "neither a frame nor a point"),
        (lambda c: c.constrain(sm.Symbol("a") - 2), "no coordinate"),
        (lambda c: c.constrain("x - 1"), "not text"),
    ],
)
def test_what_makes_no_sense_is_refused(wrong, message):
    with pytest.raises(ed.EngdynError, match=message):
        wrong(ed.KinematicChain("N"))


def test_constraints_with_accelerations_are_refused():
    chain = ed.KinematicChain("N")
    chain.move("P", x * chain.ground.x)
    chain.constrain(x.diff(t, 2) - 1)
    with pytest.raises(ed.EngdynError, match="accelerations"):
        chain.degrees_of_freedom  # noqa: B018


def test_ground_and_origin_of_other_kinds_are_refused():
    with pytest.raises(ed.EngdynError, match="give a ReferenceFrame and a Point"):
        ed.KinematicChain(3)
