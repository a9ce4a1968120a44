"""Pictures of kinematics show the vectors that were computed."""

from __future__ import annotations

import numpy as np
import pytest
import sympy as sm
from sympy.physics.mechanics import dynamicsymbols

import engdyn as ed
from engdyn import shapes
from engdyn.plots import kinematic_pictures as pictures

theta, r, x, beta = dynamicsymbols("theta r x beta")
VALUES = {
    **{"theta": 0.7, "theta_d": 5.0, "theta_dd": -8.0, "r": 0.4, "r_d": 0.3, "r_dd": -1.5},
    **{"x": 0.3, "x_d": 1.0, "x_dd": 3.0, "beta": 0.5, "beta_d": 0.4, "beta_dd": 0.0},
}


@pytest.fixture
def drawn(monkeypatch):
    """What was handed to the drawing."""
    found = []

    def spy(items, words, ax=None, **rest):
        found.extend(items)
        return ed.plots.sketch(items, words, ax, **rest)

    monkeypatch.setattr(pictures, "sketch", spy)
    return found


@pytest.fixture
def arm():
    chain = ed.KinematicChain("N")
    chain.move("C", x * chain.ground.x)
    A = chain.turn("A", about=chain.ground.z, by=theta)
    chain.move("P", r * A.x)
    return chain


def vectors(drawn):
    return {v.label: (np.array(v.start), np.array(v.end)) for v in drawn if isinstance(v, shapes.VectorArrow)}


def test_a_change_is_split_along_and_across(drawn):
    ax = ed.plots.vector_change([2.0, 0.0], [2.5, 1.0])
    found = {
        v.role: (v.start, v.end) for v in drawn if isinstance(v, shapes.VectorArrow) if v.role != "position"
    }
    np.testing.assert_allclose(found["reaction"], [[2, 0], [2.5, 0]])
    np.testing.assert_allclose(found["force"], [[2.5, 0], [2.5, 1]])
    np.testing.assert_allclose(found["velocity"], [[2, 0], [2.5, 1]])
    middles = {s.text: s.point for s in drawn if isinstance(s, shapes.Label)}
    assert middles[r"$\Delta r_{\perp}$"] == (2.5, 0.5)
    assert "the part 0.5 along the vector and 1 across it" in ed.plots.alt(ax)


def test_a_change_through_the_negative_x_axis_is_a_small_angle(drawn):
    ed.plots.vector_change([-1.0, 0.1], [-1.0, -0.1])
    (angle,) = (s for s in drawn if isinstance(s, shapes.AngleArrow))
    assert angle.end - angle.start == pytest.approx(2 * np.arctan(0.1))


@pytest.mark.parametrize(
    ("before", "after", "message"),
    [
        ([0, 0], [1, 0], "no direction"),
        ([1, 0, 0], [1, 0], "two finite"),
        ([1, 0], [np.nan, 0], "two finite"),
        ("ab", [1, 0], "two finite"),
    ],
)
def test_vectors_that_cannot_be_drawn(before, after, message):
    with pytest.raises(ed.EngdynError, match=message):
        ed.plots.vector_change(before, after)


def test_the_terms_start_at_the_point_and_keep_their_proportions(drawn, arm):
    terms = arm.acceleration_terms("P", "C", "A")
    ax = ed.plots.acceleration_terms(terms, VALUES, arm.ground, at=(0.5, 0.2), length=0.3)
    found, sizes = vectors(drawn), terms.magnitudes(VALUES)
    assert len(found) == 5
    for name, label in pictures.TERMS.items():
        if name != "total":
            start, end = found[label]
            beside = 0.021 if name == "relative" else 0.0  # it has the direction of the centripetal term
            np.testing.assert_allclose(np.linalg.norm(start - (0.5, 0.2)), beside, atol=1e-12)
            np.testing.assert_allclose((start - (0.5, 0.2)) @ (end - start), 0, atol=1e-12)
            exact = ed.components(dict(terms)[name], arm.ground, VALUES)[:2] * 0.3 / sizes["centripetal"]
            np.testing.assert_allclose(end - start, exact, atol=1e-12)
    assert "coriolis 3 m/s²" in ed.plots.alt(ax)


def test_head_to_tail_the_terms_end_where_the_total_ends(drawn, arm):
    terms = arm.acceleration_terms("P", "C", "A")
    ed.plots.acceleration_terms(terms, VALUES, arm.ground, head_to_tail=True)
    found = vectors(drawn)
    np.testing.assert_allclose(found[pictures.TERMS["relative"]][1], found["$a$"][1], atol=1e-12)
    np.testing.assert_allclose(found["$a$"][0], (0, 0))
    np.testing.assert_allclose(found[r"$\alpha\times r$"][0], found["$a_{base}$"][1])


def test_terms_in_space_need_a_point_in_space(arm):
    B = arm.turn("B", about=arm.frame("A").y, by=beta)
    arm.move("Q", r * B.x)
    terms = arm.acceleration_terms("Q", "P", "B")
    with pytest.raises(ed.EngdynError, match="out of the plane"):
        ed.plots.acceleration_terms(terms, VALUES, arm.ground)
    assert ed.plots.acceleration_terms(terms, VALUES, arm.ground, at=(0, 0, 0))


def test_terms_that_are_all_zero_cannot_be_drawn(arm):
    terms = arm.acceleration_terms("P", "C", "A")
    still = dict.fromkeys(VALUES, 0.0)
    with pytest.raises(ed.EngdynError, match="all terms are zero"):
        ed.plots.acceleration_terms(terms, still, arm.ground)


def test_a_plane_chain_is_drawn_in_its_plane(drawn, arm):
    ax = ed.plots.kinematic_chain(arm, VALUES, total="P")
    found = vectors(drawn)
    tip = 0.3 + 0.4 * np.cos(0.7), 0.4 * np.sin(0.7)
    np.testing.assert_allclose(found["$r_{OC}$"], [[0, 0], [0.3, 0]])
    np.testing.assert_allclose(found["$r_{CP}$"], [[0.3, 0], tip])
    np.testing.assert_allclose(found["$r_{OP}$"], [[0, 0], tip])
    triads = [s for s in drawn if isinstance(s, shapes.Triad)]
    assert [t.labels[0] for t in triads] == ["$n_x$", "$a_x$"]
    np.testing.assert_allclose(triads[1].axes[0], (np.cos(0.7), np.sin(0.7)))
    assert triads[1].origin == (0.3, 0.0)
    assert "P at (0.6059, 0.2577, 0) m" in ed.plots.alt(ax)


def test_a_chain_in_space_has_plumb_lines(drawn, arm):
    B = arm.turn("B", about=arm.frame("A").y, by=-beta)
    arm.move("Q", sm.Integer(1) * B.x)
    ed.plots.kinematic_chain(arm, VALUES, frames=False)
    assert all(len(v.start) == 3 for v in drawn if isinstance(v, shapes.VectorArrow))
    assert [s for s in drawn if isinstance(s, shapes.CenterLine)]
    assert not [s for s in drawn if isinstance(s, shapes.Triad)]


def test_numbers_that_are_missing_are_named(arm):
    with pytest.raises(ed.EngdynError, match="values lacks"):
        ed.plots.kinematic_chain(arm, {"x": 1.0})
    with pytest.raises(ed.EngdynError, match="no point 'Z'"):
        ed.plots.kinematic_chain(arm, VALUES, total="Z")


def test_boxes_are_turned_as_the_matrices_say(drawn):
    quarter = np.array([[0, -1, 0], [1, 0, 0], [0, 0, 1]])
    ax = ed.plots.orientations([[("", np.eye(3)), ("about z", quarter)]], "A box turns about z.")
    boxes = [s for s in drawn if isinstance(s, shapes.Box)]
    assert boxes[1].axes[0] == (0.0, 1.0, 0.0)
    assert ed.plots.alt(ax) == "A box turns about z."
    with pytest.raises(ed.EngdynError, match="no rotation matrix"):
        ed.plots.orientations([[("", 2 * np.eye(3))]], "words")
