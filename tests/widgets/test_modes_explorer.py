"""The explorer of modes, driven without a browser."""

from __future__ import annotations

import math
import random

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import engdyn as ed
from widgets.code_runs import run

EXPLORER = ed.widgets.modes()


@pytest.fixture(autouse=True)
def _begin_with_the_rod():
    EXPLORER.set(system="W8")
    EXPLORER.reset()


def test_the_first_mode_of_the_rod():
    assert EXPLORER.text == (
        "Modes. Rigid rod on two springs: mode 1: 5.005 Hz: y 0.2207, theta −0.062; energy y 97 %, theta 3 %; "
        "node at 3.56 m."
    )
    EXPLORER.set(mode=2, scale="y")
    assert "mode 2: 6.013 Hz: y 1, theta 10.68;" in EXPLORER.text
    assert "node at −0.09363 m" in EXPLORER.text


@pytest.mark.parametrize("a_1", [0.5, 0.7, 0.98])
def test_the_node_wanders_as_the_closed_form_says(a_1):
    EXPLORER.set(a_1=a_1, beside="nodes")
    K = np.array(
        [[20000.0, 12000 * 0.6 - 8000 * a_1], [12000 * 0.6 - 8000 * a_1, 8000 * a_1**2 + 12000 * 0.36]]
    )
    squares, vectors = np.linalg.eig(np.diag([1 / 20, 3 / 20]) @ K)  # J = m L²/12 = 20/3
    y, theta = vectors[:, np.argmin(squares)]
    assert f"node at {-y / theta:.4g} m".replace("-", "−") in EXPLORER.text


def test_where_the_node_is_at_infinity_it_is_told():
    EXPLORER.set(a_1=0.9, beside="nodes")
    assert "no node, it only translates" in EXPLORER.text


def test_damped_modes_of_the_chapter():
    EXPLORER.set(damping="damped", scale="y")
    assert "ζ = 0.04701: y 1 at 0°, theta 0.4884 at 126°" in EXPLORER.text  # −0.287 + 0.395i
    assert abs(complex(-0.287, 0.395)) == pytest.approx(0.4884, abs=1e-3)
    assert "with the coupling dropped ζ would be 0.04648" in EXPLORER.text
    EXPLORER.set(c_2=60.0)
    assert "damping is classical" in EXPLORER.text
    frequency = ed.modes(EXPLORER.model(EXPLORER.state).modes.linear).natural_frequency[0]
    assert f"ζ = {math.pi * frequency / 200:.4g}" in EXPLORER.text  # C = K/200


@pytest.mark.parametrize(("scale", "size"), [("max", np.max), ("unit", np.linalg.norm)])
@pytest.mark.parametrize("damping", ["undamped", "damped"])
def test_scales(scale, size, damping):
    EXPLORER.set(scale=scale, damping=damping)
    found = EXPLORER.model(EXPLORER.state)
    assert size(np.abs(found.components)) == pytest.approx(1.0)
    assert found.components[1] / found.components[0] == pytest.approx(
        found.modes.shapes[1, 0] / found.modes.shapes[0, 0]
    )


def test_a_coordinate_at_rest_gives_no_scale():
    for damping in ("undamped", "damped"):
        EXPLORER.set(a_1=0.9, c_1=0.0, scale="theta", damping=damping)
        assert "Nothing to draw: theta is at rest in mode 1" in EXPLORER.text


def test_the_plane_shows_eigenvalues_and_ratio():
    EXPLORER.set(beside="eigenvalues", damping="damped")
    plane = EXPLORER.figure.axes[1]
    _, dots, circle, ray, chosen = plane.lines
    roots = EXPLORER.model(EXPLORER.state).modes.eigenvalues
    assert dots.get_xdata() + 1j * dots.get_ydata() == pytest.approx(roots)
    assert chosen.get_xdata()[0] == pytest.approx(roots[0].real)
    assert np.hypot(*circle.get_data()) == pytest.approx(abs(roots[0]))
    x, y = ray.get_xydata()[1]
    assert math.sin(math.atan2(-x, y)) == pytest.approx(0.04701, abs=1e-5)
    assert [text.get_text() for text in plane.texts] == ["ζ = 0.04701"]


def test_what_does_not_exist_is_explained():
    EXPLORER.set(system="S12", damping="undamped")
    assert (
        "Nothing to draw: the stiffness matrix is not symmetric (circulatory: use damped_modes)"
        in EXPLORER.text
    )
    EXPLORER.set(damping="damped")
    assert "mode 1: 3.252 Hz" in EXPLORER.text
    EXPLORER.set(system="S07", mode=2.0)
    assert "there are the modes 0 to 0" in EXPLORER.text  # the other one does not oscillate
    EXPLORER.set(system="W8", k_1=0.0, k_2=0.0)
    assert "Nothing to draw" in EXPLORER.text


def test_nodes_are_offered_where_there_is_a_body():
    with pytest.raises(ed.EngdynError, match="choose one of components, eigenvalues"):
        EXPLORER.set(system="S10", beside="nodes")
    EXPLORER.set(system="S23", beside="nodes", mode=2.0)
    assert "node at" in EXPLORER.text


def test_out_of_range_is_refused_and_reset_returns():
    EXPLORER.set(mode=2.0)
    with pytest.raises(ed.EngdynError, match=r"a_1 = 1\.5 is out of range; give a number from 0 to 1 m"):
        EXPLORER.set(a_1=1.5)
    assert EXPLORER.state["mode"] == 2.0
    EXPLORER.reset()
    assert EXPLORER.state["mode"] == 1.0


@pytest.mark.parametrize(
    "values",
    [
        {"mode": 2.0, "a_1": 0.7},
        {"beside": "nodes"},
        {"damping": "damped"},
        {"damping": "damped", "beside": "nodes", "mode": 2.0},
        {"system": "S23", "mode": 3.0},
    ],
)
def test_the_code_gives_the_same_pictures(values, monkeypatch):
    EXPLORER.set(**values)
    names, shown = run(EXPLORER, monkeypatch)
    assert np.array_equal(names["modes"].shapes, EXPLORER.model(EXPLORER.state).modes.shapes)
    assert shown == [ed.plots.alt(ax) for ax in EXPLORER.figure.axes]


def test_the_code_beside_the_plane(monkeypatch):
    EXPLORER.set(beside="eigenvalues")
    _, shown = run(EXPLORER, monkeypatch)
    assert shown == [ed.plots.alt(EXPLORER.figure.axes[0])]


@settings(max_examples=12)
@given(
    st.sampled_from(["W7", "W8", "S10", "S12"]),
    st.sampled_from(["undamped", "damped"]),
    st.randoms(use_true_random=False),
)
def test_no_position_of_the_sliders_raises_or_blanks(name, damping, rng: random.Random):
    EXPLORER.set(system=name, damping=damping)
    controls = [c for c in EXPLORER._controls.values() if hasattr(c, "low")]
    EXPLORER.set(
        **{
            c.name: rng.choice([c.low, c.high, rng.uniform(c.low, c.high)])
            for c in controls
            if c.name != "mode"
        }
    )
    assert " Hz" in EXPLORER.text or "Nothing to draw" in EXPLORER.text
    assert np.ptp(np.frombuffer(EXPLORER.figure.canvas.buffer_rgba(), np.uint8)) > 100
