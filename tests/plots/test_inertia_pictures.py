"""Pictures of products of inertia and of equivalent ellipsoids: what they show is what mechanics says."""

from __future__ import annotations

import itertools

import numpy as np
import pytest

import engdyn as ed
from engdyn import shapes
from engdyn.plots import ellipsoid_picture, inertia_pictures

MASS = (0.8, 0.6, 0.5)


@pytest.fixture
def drawn(monkeypatch):
    """The shapes that a picture hands to `sketch`, caught on the way."""
    kept: list = []

    def catch(pieces, words, ax, *, view):
        kept[:] = pieces
        return words

    for module in (inertia_pictures, ellipsoid_picture):
        monkeypatch.setattr(module, "sketch", catch)
    return kept


def of_kind(drawn, kind, role=None):
    return [shape for shape in drawn if isinstance(shape, kind) and role in (None, shape.role)]


def arrow(shape):
    return np.subtract(shape.end, shape.start)


def turn(shape):
    """Direction of a curved arrow, as a vector by the right-hand rule."""
    return np.sign(shape.end - shape.start) * np.cross(shape.x_axis, shape.y_axis)


POSITIONS = [MASS, (-0.8, 0.6, 0.5), (0.8, -0.6, -0.5), (-0.3, -0.9, 0.4)]
CASES = list(itertools.product(POSITIONS, "xyz", "xyz", ("acceleration", "velocity")))


@pytest.mark.parametrize(("position", "axis", "about", "motion"), CASES)
def test_arrows_point_as_force_and_moment_do(position, axis, about, motion, drawn):
    ed.plots.inertia_terms(position, axis, about, motion=motion)
    e, a = np.eye(3)["xyz".index(axis)], "xyz".index(about)
    force = np.cross(e, position) if motion == "acceleration" else np.cross(e, np.cross(e, position))
    moment = np.cross(position, force)[a]
    tensor = ed.inertia_tensor([1.0], [position])
    expected = tensor @ e if motion == "acceleration" else np.cross(e, tensor @ e)
    assert moment == pytest.approx(expected[a], abs=1e-15)
    arms = 0.0
    for shown in of_kind(drawn, shapes.ForceArrow):
        along = int(np.argmax(abs(arrow(shown))))
        assert np.sign(arrow(shown)[along]) == np.sign(force[along])
        assert shown.start == position
        arms += np.cross(position, force[along] * np.eye(3)[along])[a]
    assert arms == pytest.approx(moment, abs=1e-15)  # the components shown make up the whole moment
    curved = of_kind(drawn, shapes.MomentArrow, "input")
    assert len(curved) == (moment != 0.0)
    for shown in curved:
        np.testing.assert_allclose(turn(shown), np.sign(moment) * np.eye(3)[a])


@pytest.mark.parametrize(("position", "axis", "about", "motion"), CASES)
def test_levers_are_square_to_the_axis_and_to_the_force(position, axis, about, motion, drawn):
    ed.plots.inertia_terms(position, axis, about, motion=motion)
    a = np.eye(3)["xyz".index(about)]
    levers, forces = of_kind(drawn, shapes.Dimension), of_kind(drawn, shapes.ForceArrow)
    assert len(levers) == len(forces)
    for lever, force in zip(levers, forces, strict=True):
        assert arrow(lever) @ a == 0
        assert arrow(lever) @ arrow(force) == pytest.approx(0)
        np.testing.assert_allclose(np.cross(lever.start, a), 0)  # starts on the axis
        np.testing.assert_allclose(np.cross(np.subtract(position, lever.end), arrow(force)), 0, atol=1e-15)


def numbers_of(formula, position):
    """Evaluate a formula of the picture for m = α = ω = 1, with the few forms there are."""
    names = dict(zip("xyz", position, strict=True))
    sign = -1.0 if formula.startswith("−") else 1.0
    body = formula.lstrip("−").replace("m ", "").replace(" α", "").replace(" ω²", "")
    if body.startswith("("):
        return sign * sum(names[letter] ** 2 for letter in body if letter in names)
    return sign * np.prod([names[letter] for letter in body.split()]) if body != "0" else 0.0


@pytest.mark.parametrize(("position", "axis", "about", "motion"), CASES)
def test_formulas_in_the_words_are_right(position, axis, about, motion, drawn):
    words = ed.plots.inertia_terms(position, axis, about, motion=motion)
    e, a = np.eye(3)["xyz".index(axis)], "xyz".index(about)
    force = np.cross(e, position) if motion == "acceleration" else np.cross(e, np.cross(e, position))
    moment = np.cross(position, force)[a]
    if moment == 0.0:
        assert f"no moment about the {about} axis" in words
    else:
        formula = words.split(f"M_{about} = ")[1].split(",")[0]
        assert numbers_of(formula, position) == pytest.approx(moment)
    for part in words.split("The force component F_")[1:]:
        assert numbers_of(part.split(" = ")[1].split(" acts")[0], position) == pytest.approx(
            force["xyz".index(part[0])]
        )


def test_the_mass_alone_has_neither_force_nor_moment(drawn):
    ed.plots.inertia_terms(MASS)
    assert of_kind(drawn, shapes.ForceArrow) == of_kind(drawn, shapes.MomentArrow, "input") == []
    legs = [shape for shape in of_kind(drawn, shapes.Link) if shape.label]
    np.testing.assert_allclose([arrow(leg) for leg in legs], np.diag(MASS))


def test_pictures_can_be_drawn_and_have_words():
    ax = ed.plots.inertia_terms(MASS, about="y")
    assert "F_z = m y α acts on the mass with the arm x" in ed.plots.alt(ax)
    assert "against the axis" in ed.plots.alt(ax)
    assert len(ax.texts) >= 8
    ax = ed.plots.equivalent_ellipsoid(2.0, ed.solids.box(2.0, 0.3, 0.2, 0.1))
    assert "J1" in ed.plots.alt(ax)


def test_a_mass_without_coordinate_has_no_product():
    words = ed.plots.alt(ed.plots.inertia_terms((0.0, 0.6, 0.5), about="y"))
    assert "no moment about the y axis" in words


@pytest.mark.parametrize("view", [None, ed.plots.View(0.7, -0.4)])
@pytest.mark.parametrize("half", [(0.5, 0.3, 0.2), (0.4, 0.4, 0.1), (0.3, 0.3, 0.3)])
def test_the_equivalent_of_an_ellipsoid_is_itself(half, view, drawn):
    """Every curve lies on the given ellipsoid, and the rim is its outline: nothing reaches beyond it."""
    angle = 0.6
    R = np.array([[np.cos(angle), np.sin(angle), 0], [-np.sin(angle), np.cos(angle), 0], [0, 0, 1]])
    tensor = ed.rotate_tensor(ed.solids.ellipsoid(2.0, *half), R)
    center = np.array([1.0, 2.0, 3.0])
    ed.plots.equivalent_ellipsoid(2.0, tensor, center=center, view=view)
    inverse = R @ np.diag(1 / np.square(half)) @ R.T
    for curve in of_kind(drawn, shapes.Curve):
        r = np.array(curve.points) - center
        np.testing.assert_allclose(np.sum(r @ inverse * r, axis=1), 1.0, rtol=1e-6)
        normals = r @ inverse
        toward = normals @ (view or ed.plots.View()).axes[2]
        if curve.role == "coordinate":
            np.testing.assert_allclose(toward, 0, atol=1e-6)
        else:
            assert toward.min() > -1e-6  # the side that is seen


def test_a_flat_body_has_a_flat_ellipsoid(drawn):
    words = ed.plots.equivalent_ellipsoid(2.0, ed.solids.disc(2.0, 0.3))
    heights = np.vstack([curve.points for curve in of_kind(drawn, shapes.Curve)])[:, 2]
    assert np.max(abs(heights)) < 1e-3
    assert "J3 = 0.09 kg m²" in words


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: ed.plots.inertia_terms((1, 2)), "give x, y, z"),
        (lambda: ed.plots.inertia_terms((0, 0, 0)), "not all zero"),
        (lambda: ed.plots.inertia_terms(("a", 1, 2)), "give x, y, z"),
        (lambda: ed.plots.inertia_terms((1, 2, float("nan"))), "give x, y, z"),
        (lambda: ed.plots.inertia_terms(MASS, "w"), "axis is 'w'"),
        (lambda: ed.plots.inertia_terms(MASS, None), "axis is None"),
        (lambda: ed.plots.inertia_terms(MASS, about="r"), "about is 'r'"),
        (lambda: ed.plots.inertia_terms(MASS, motion="speed"), "motion is 'speed'"),
        (lambda: ed.plots.equivalent_ellipsoid(-1.0, np.eye(3)), "greater than zero"),
        (lambda: ed.plots.equivalent_ellipsoid(1.0, np.diag([1, 1, 3])), "no body has"),
    ],
)
def test_bad_input_is_refused(call, message):
    with pytest.raises(ed.EngdynError, match=message):
        call()
