"""Free-body diagrams: every load once, where it acts, in its direction."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
import sympy as sm
from sympy.physics.mechanics import (
    Force,
    Particle,
    Point,
    ReferenceFrame,
    RigidBody,
    Torque,
    dynamicsymbols,
    inertia,
)

import engdyn as ed
from engdyn import shapes
from engdyn.plots import free_body_diagram as module

theta = dynamicsymbols("theta")
m, g, l, N, T, k = sm.symbols("m g l N T k", positive=True)


@pytest.fixture
def ladder():
    """A bar on a wall: weight at G, push W along the bar, contact forces at both ends."""
    ground, axes = ReferenceFrame("N"), ReferenceFrame("B")
    axes.orient_axis(ground, theta, ground.z)
    center = Point("G")
    foot, top = center.locatenew("F", -l / 2 * axes.x), center.locatenew("T", l / 2 * axes.x)
    body = RigidBody("ladder", center, axes, m, (inertia(axes, 0, 0, m * l**2 / 12), center))
    N_1, N_2 = sm.symbols("N_1 N_2")
    return ed.FreeBody(
        body,
        [Force(center, -m * g * ground.y), Torque(axes, -k * theta * ground.z)],
        [Force(foot, N_1 * ground.y), Force(top, N_2 * ground.x)],
    )


@pytest.fixture
def drawn(monkeypatch):
    """What `free_body` hands over to be drawn, by label."""
    kept = {}

    def remember(some, words, ax=None, *, view=None):
        kept.update({s.label: s for s in some if getattr(s, "label", "")}, words=words)
        return ed.plots.sketch(some, words, ax, view=view)

    monkeypatch.setattr(module, "sketch", remember)
    return kept


def along(arrow):
    way = np.subtract(arrow.end, arrow.start)
    return way / np.linalg.norm(way)


def test_every_load_is_drawn_where_it_acts_and_points_where_it_acts(ladder, drawn):
    ed.plots.free_body(ladder, {"theta": 0.5, "l": 2.0})
    end = np.array([np.cos(0.5), np.sin(0.5)])
    expected = {"$m\\,g$": (0 * end, (0, -1)), "$N_{1}$": (-end, (0, 1)), "$N_{2}$": (end, (1, 0))}
    for label, (point, direction) in expected.items():
        arrow = drawn[label]
        assert along(arrow) == pytest.approx(direction)
        assert min(np.linalg.norm(np.subtract(p, point)) for p in (arrow.start, arrow.end)) < 1e-9
    assert drawn["$m\\,g$"].role == "force"
    assert drawn["$N_{1}$"].role == "reaction"


def test_a_couple_turns_in_its_own_sense(ladder, drawn):
    ed.plots.free_body(ladder)
    couple = drawn["$k\\,\\theta$"]
    assert isinstance(couple, shapes.MomentArrow)
    assert couple.end < couple.start  # it acts clockwise


def test_the_diagram_is_told_in_words(ladder):
    told = ed.plots.alt(ed.plots.free_body(ladder))
    assert told.startswith("Free-body diagram of ladder; applied loads: m\\,g")
    assert "reaction loads: N_{1}, N_{2}" in told


def test_components_that_make_one_force_are_one_arrow(drawn):
    ground = ReferenceFrame("N")
    point = Point("P")
    pull = T * sm.sin(theta) * ground.x - T * sm.cos(theta) * ground.y
    not_one = 2 * N * sm.sin(theta) * ground.x + N * sm.cos(theta) * ground.y
    ed.plots.free_body(ed.FreeBody(Particle("bob", point, m), [Force(point, pull), Force(point, not_one)]))
    assert along(drawn["$T$"]) == pytest.approx((np.sin(0.45), -np.cos(0.45)))
    assert "$2\\,N\\,\\sin{\\left(\\theta \\right)}$" in drawn


def test_a_long_formula_gets_a_letter_and_is_told(drawn):
    ground = ReferenceFrame("N")
    point, x = Point("P"), dynamicsymbols("x")
    formula = -(k * x + m * x.diff() ** 2 * sm.sin(theta) * sm.cos(theta) + N * l * sm.sqrt(l**2 + x**2))
    ed.plots.free_body(ed.FreeBody(Particle("block", point, m), [Force(point, formula * ground.x)]))
    assert along(drawn["$F_{1}$"]) == pytest.approx((-1, 0))
    assert f"F_{{1}} is {-formula}" in drawn["words"]


def test_sums_begin_with_what_is_counted_positive(drawn):
    ground, point, r = ReferenceFrame("N"), Point("P"), dynamicsymbols("r")
    ed.plots.free_body(ed.FreeBody(Particle("P", point, m), [Force(point, -k * (r - l) * ground.x)]))
    label = next(name for name in drawn if "left" in name)
    assert label == "$k\\,\\left(r - l\\right)$"
    assert along(drawn[label]) == pytest.approx((-1, 0))


def test_in_space_couples_are_arrows_with_two_heads(drawn):
    ground = ReferenceFrame("N")
    center = Point("G")
    body = RigidBody("rotor", center, ground, m, (inertia(ground, 1, 1, 2), center))
    end = center.locatenew("E", l * ground.z)
    ed.plots.free_body(
        ed.FreeBody(
            body, [Torque(ground, T * ground.x)], [Force(end, N * ground.y), Force(center, m * g * ground.z)]
        )
    )
    assert drawn["$T$"].double
    assert not drawn["$N$"].double
    assert along(drawn["$T$"]) == pytest.approx((1, 0, 0))


@pytest.mark.parametrize("key", ["W7", "S03", "S07", "S23", "W14"])
def test_no_two_labels_of_a_diagram_overlap(key):
    system = ed.systems.load(key)
    for body in system.free_bodies():
        ax = ed.plots.free_body(body, system.values())
        renderer = ax.figure.canvas.get_renderer()
        extents = [text.get_window_extent(renderer) for text in ax.texts]
        assert len(extents) >= len(body.applied) + len(body.reactions) + 2
        for a, b in itertools.combinations(extents, 2):
            assert not a.overlaps(b)


def test_what_cannot_be_drawn_is_refused(ladder):
    with pytest.raises(ed.EngdynError, match="is no FreeBody"):
        ed.plots.free_body(ladder.body)
    with pytest.raises(ed.EngdynError, match=r"theta = 'flat' is not a finite number"):
        ed.plots.free_body(ladder, {"theta": "flat"})
    with pytest.raises(ed.EngdynError, match="is not placed relative"):
        ed.plots.free_body(ed.FreeBody(ladder.body, [Force(Point("elsewhere"), g * ladder.body.frame.x)]))
    with pytest.raises(ed.EngdynError, match="give frame="):
        ed.plots.free_body(ed.FreeBody(Particle("P", Point("P"), m)))
    with pytest.raises(ed.EngdynError, match="say in words"):
        ed.plots.sketch([shapes.Pin((0.0, 0.0))], " ")


def test_axes_that_turn_with_time_are_drawn_at_time_zero(drawn):
    ground, turning = ReferenceFrame("N"), ReferenceFrame("A")
    turning.orient_axis(ground, 3 * dynamicsymbols._t, ground.z)
    point = Point("P")
    cut = ed.FreeBody(Particle("P", point, m), [Force(point, N * turning.x)])
    ed.plots.free_body(cut)
    assert along(drawn["$N$"]) == pytest.approx((1, 0))
    ed.plots.free_body(cut, {"t": np.pi / 6})
    assert along(drawn["$N$"]) == pytest.approx((0, 1))
