"""The explorer of poses, driven without a browser."""

from __future__ import annotations

import io
import math

import numpy as np
import pytest
from matplotlib.collections import PolyCollection
from PIL import Image
from sympy.physics.mechanics import dynamicsymbols

import engdyn as ed
from engdyn.quantities import Coordinate
from engdyn.widgets.pose_explorer import coordinate_slider


def fills(figure):
    """Opacities of the areas that are drawn."""
    areas = [c for ax in figure.axes for c in ax.collections if isinstance(c, PolyCollection)]
    return {round(float(color[3]), 2) for area in areas for color in area.get_facecolor()}


def test_starts_in_the_pose_of_the_drawing_and_says_it():
    explorer = ed.widgets.pose("S08")
    assert explorer.state == {"system": "S08", "theta1": 0.35, "theta2": 0.8}
    assert explorer.text == (
        "Pose. Gymnast on the high bar (two segments with hip stiffness): "
        "theta1 = 0.35 rad (20.1°), theta2 = 0.8 rad (45.8°)."
    )
    assert Image.open(io.BytesIO(explorer.png())).size == (640, 432)


def test_a_slider_moves_the_drawing_and_the_first_pose_stays_behind_pale():
    explorer = ed.widgets.pose("S07")
    before, alone = explorer.png(), fills(explorer.figure)
    explorer.set(theta=-0.6)
    assert explorer.png() != before
    assert fills(explorer.figure) - alone == {0.35}
    explorer.reset()
    assert explorer.png() == before


def test_what_is_drawn_is_where_the_coordinates_say():
    explorer = ed.widgets.pose("S02", y=-0.03)
    (ax,) = explorer.figure.axes
    bodies = {round(float(np.mean(p.vertices[:-1, 1])), 3) for c in ax.collections for p in c.get_paths()}
    assert -0.03 in bodies  # the mass, at its height


@pytest.mark.parametrize("name", list(ed.systems.catalogue().index))
def test_every_system_can_be_posed_at_both_ends_of_its_sliders(name):
    system, explorer = ed.systems.load(name), ed.widgets.pose(name)
    shown = explorer.state
    assert list(shown) == ["system", *(c.name for c in system.coordinates)]
    sliders = [explorer._controls[c.name] for c in system.coordinates]
    for end in ("low", "high"):
        explorer.set(**{control.name: getattr(control, end) for control in sliders})
        assert "Nothing to draw" not in explorer.text
    for control in sliders:
        steps = (shown[control.name] - control.low) / control.step
        assert steps == pytest.approx(round(steps), abs=1e-6)  # sliders stand on steps


def test_another_system_brings_its_own_sliders_and_one_of_your_own_joins_the_list():
    pendulum = ed.systems.load("W10")
    explorer = ed.widgets.pose(pendulum, theta=1.0)
    assert explorer.state == {"system": pendulum.key, "theta": 1.0}
    explorer.set(system=23)
    assert list(explorer.state) == ["system", "z", "theta", "zf", "zr"]
    explorer.set(system=pendulum.key)
    assert "theta" in explorer.state
    with pytest.raises(ed.UnknownSystemError, match="gantry_crane"):
        explorer.set(system="gantri_crane")


def test_a_value_out_of_reach_changes_nothing():
    explorer = ed.widgets.pose("S02")
    before = explorer.state
    with pytest.raises(ed.EngdynError, match="y = 1 is out of range"):
        explorer.set(y=1.0)
    assert explorer.state == before


def test_sliders_follow_bounds_or_reach_one_turn_or_the_width_of_the_drawing():
    angle, length = (
        Coordinate(dynamicsymbols("a"), "rad", "an angle"),
        Coordinate(dynamicsymbols("b"), "m", "a length"),
    )
    turn, wide = coordinate_slider(angle, 0.0, 2.0), coordinate_slider(length, 0.33, 8.0)
    assert (turn.low, turn.high) == pytest.approx((-math.pi, math.pi), abs=turn.step)
    assert (wide.low, wide.high, wide.value) == (-4.0, 4.0, 0.35)
    bounded = coordinate_slider(
        Coordinate(dynamicsymbols("c"), "m", "a gap", bounds=(0.0, 1e-3)), 4.02e-4, 8.0
    )
    assert (bounded.low, bounded.high, bounded.value) == (0.0, 1e-3, 4e-4)
    assert {round(math.log10(s.step) % 1, 3) for s in (turn, wide, bounded)} <= {0.0, 0.301, 0.699}
