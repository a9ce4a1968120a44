"""The explorer of free-body diagrams, driven without a browser."""

from __future__ import annotations

import math
import random
import runpy

import numpy as np
import pytest

import engdyn as ed
from engdyn.widgets.controls import Slider

NAMES = [*ed.systems.catalogue().index, "W1", "W2", "W3", "W5", "W7", "W10"]


def test_the_normal_force_of_the_collar_changes_its_sign():
    explorer = ed.widgets.free_body("W1", theta=0.5, r=0.38, theta_d=6.0, r_d=-1.95)
    system = ed.systems.load("W1")
    turn = system.equations.accelerations([0.5, 0.38], [6.0, -1.95], system.values())[0]
    expected = 0.5 * (9.81 * math.cos(0.5) + 2 * -1.95 * 6.0 + 0.38 * turn)
    state = explorer.state
    assert explorer.model(state).reactions["N_c"] == pytest.approx(expected)
    assert expected < 0.0
    assert "Against its arrow: N_c." in explorer.text
    explorer.set(r_d=2.0)
    assert explorer.model(explorer.state).reactions["N_c"] > 0.0


@pytest.mark.parametrize("body", ["collar", "arm"])
def test_forces_sum_up_to_mass_times_acceleration(body):
    explorer = ed.widgets.free_body("W1", body=body, theta=0.3, r=0.3, theta_d=2.0, r_d=1.2)
    found = explorer.model(explorer.state)
    v = found.values
    mass, distance, out, slide = (
        (v["m"], v["r"], v["r_dd"], v["r_d"]) if body == "collar" else (v["m_a"], v["a"], 0, 0)
    )
    along, across = np.array([math.cos(0.3), math.sin(0.3), 0]), np.array([-math.sin(0.3), math.cos(0.3), 0])
    a = (out - distance * 4.0) * along + (distance * v["theta_dd"] + 2 * slide * 2.0) * across
    assert found.applied + found.reaction == pytest.approx(mass * a)


def test_bodies_and_loads_are_chosen():
    explorer = ed.widgets.free_body("W3", body="roll")
    words = ed.plots.alt(explorer.figure.axes[0])
    assert "applied loads: m\\,g; reaction loads: S, N." in words
    explorer.set(loads="reactions")
    assert "applied loads: none" in ed.plots.alt(explorer.figure.axes[0])
    explorer.set(loads="applied", body="cart")
    assert "reaction loads: none" in ed.plots.alt(explorer.figure.axes[0])
    explorer.set(system="S07")
    assert explorer.state["body"] == "trolley"
    with pytest.raises(ed.EngdynError, match="choose one of trolley, container"):
        explorer.set(body="roll")


@pytest.mark.parametrize("name", NAMES)
def test_every_body_of_every_system_in_extreme_states(name, monkeypatch, tmp_path):
    explorer, rng = ed.widgets.free_body(name), random.Random(1)
    shown = []
    monkeypatch.setattr(ed.plots, "show", shown.append)
    for body in ed.systems.load(name).free_bodies():
        explorer.set(body=body.name)
        sliders = [c for c in explorer._controls.values() if isinstance(c, Slider)]
        explorer.set(**{c.name: rng.choice([c.low, c.high, rng.uniform(c.low, c.high)]) for c in sliders})
        assert np.ptp(np.frombuffer(explorer.figure.canvas.buffer_rgba(), np.uint8)) > 100
        assert "Sums along" in explorer.text or "Nothing to draw" in explorer.text
    explorer.reset()
    assert "Sums along" in explorer.text
    (tmp_path / "shown.py").write_text(explorer.code, encoding="utf-8")
    runpy.run_path(tmp_path / "shown.py")
    assert shown
