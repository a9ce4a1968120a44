"""The explorer of equilibria, driven without a browser."""

from __future__ import annotations

import asyncio
import math
import random
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import engdyn as ed
from engdyn.widgets import explorer as frame
from engdyn.widgets.equilibrium_explorer import find
from engdyn.widgets.system_explorer import slider

CRITICAL = math.sqrt((1.2 + 3.0) * 9.81 / (1.2 * 0.25))


@pytest.fixture(scope="module")
def explorer():
    return ed.widgets.equilibrium("S07")


def test_starts_with_the_crane(explorer):
    assert explorer.state["system"] == "S07"
    assert explorer.state["L"] == 9.0
    assert "2 equilibria: theta = 0 (asymptotically stable); theta = 3.14 rad (unstable, div" in explorer.text


def test_system_and_value_in_one_call(explorer):
    explorer.set(system="S03", Omega=12.0)
    assert explorer.state["over"] == "Omega"
    assert explorer.text.startswith(
        "Equilibria. Spring-loaded flyball governor at constant speed, Omega = 12 rad/s: 3 equilibria"
    )
    explorer.set(Omega=11.0)
    assert "Omega = 11 rad/s: 1 equilibrium: theta = 0 (asymptotically stable)." in explorer.text


@pytest.mark.parametrize("name", ["S03", 3, "flyball_governor"])
def test_a_system_may_be_named_in_every_way(name):
    assert ed.widgets.equilibrium(name).state["system"] == "S03"


def test_unknown_system_names_the_nearest():
    with pytest.raises(ed.UnknownSystemError, match="gantry_crane"):
        ed.widgets.equilibrium("gantri_crane")


def test_the_present_value_and_the_equilibria_there_are_marked(explorer):
    explorer.set(system="S03", over="Omega", Omega=18.0)
    right = explorer.figure.axes[1]
    line, *marks = [line for line in right.lines if line.get_animated()]
    assert list(line.get_xdata()) == [18.0, 18.0]
    found = {
        (mark.get_xdata()[0], round(mark.get_ydata()[0], 4)): mark.get_markerfacecolor() for mark in marks
    }
    assert set(found) == {(18.0, 0.0), (18.0, 0.7727), (18.0, -0.7727)}
    assert found[18.0, 0.0] == "white"
    assert found[18.0, 0.7727] != "white"


@pytest.fixture
def followed(monkeypatch):
    """Every call of `System.branches`."""
    calls, follow = [], ed.System.branches
    monkeypatch.setattr(ed.System, "branches", lambda *given: calls.append(given[3]) or follow(*given))
    return calls


def test_moving_along_the_diagram_does_not_follow_the_branches_again(followed):
    explorer = ed.widgets.equilibrium("S03", Omega=18.0)
    assert len(followed) == 1
    for Omega in (10.0, 20.0, 30.0):
        explorer.set(Omega=Omega)
    assert len(followed) == 1
    explorer.set(k=150.0)
    assert len(followed) == 2
    explorer.set(k=200.0)
    assert len(followed) == 2  # remembered


class Loop:
    """An event loop of which the test decides when time passes."""

    def __init__(self):
        self.waiting = []

    def call_later(self, delay, function, *arguments):
        assert delay > 0
        call = SimpleNamespace(run=lambda: function(*arguments), cancel=lambda: self.waiting.remove(call))
        self.waiting.append(call)
        return call


def test_while_dragged_in_a_live_notebook_the_diagram_waits_for_rest(followed, monkeypatch):
    loop = Loop()
    monkeypatch.setattr(frame, "_running_loop", lambda: loop)
    explorer = ed.widgets.equilibrium("S03", Omega=18.0)
    for m in (1.3, 1.4, 2.4):
        explorer._widgets["m"].value = m
        assert f"m = {m} kg" in explorer._line.value
    assert len(followed) == 1
    assert len(explorer.figure.axes[1].patches) == 1  # veiled
    (call,) = loop.waiting
    call.run()
    assert [values["m"] for values in followed] == [1.2, 2.4]
    assert not explorer.figure.axes[1].patches
    (diamond,) = (line for line in explorer.figure.axes[1].lines if line.get_marker() == "D")
    assert diamond.get_xdata()[0] == pytest.approx(math.sqrt((2.4 + 3.0) * 9.81 / (2.4 * 0.25)), abs=1e-6)


def test_setting_from_code_never_waits(followed, monkeypatch):
    loop = Loop()
    monkeypatch.setattr(frame, "_running_loop", lambda: loop)
    explorer = ed.widgets.equilibrium("S03", Omega=18.0)
    explorer.set(m=2.4)
    assert len(followed) == 2
    assert not loop.waiting


def test_a_live_kernel_is_told_from_a_script():
    async def inside():
        return frame._running_loop() is asyncio.get_running_loop()

    assert asyncio.run(inside())
    assert frame._running_loop() is None


def test_the_diagram_moves_with_the_other_parameters(explorer):
    explorer.set(system="S03", over="Omega", Omega=18.0, m=1.2, k=200.0)
    explorer.set(m=2.4)
    (diamond,) = (line for line in explorer.figure.axes[1].lines if line.get_marker() == "D")
    assert diamond.get_xdata()[0] == pytest.approx(math.sqrt((2.4 + 3.0) * 9.81 / (2.4 * 0.25)), abs=1e-6)


def test_the_coordinate_shown_can_be_chosen(explorer):
    explorer.set(system="S23", over="k_f", coordinate="theta")
    assert explorer.figure.axes[1].get_ylabel() == r"$\theta$ [rad]"
    assert explorer.figure.axes[1].get_xlabel() == "$k_{f}$ [N/m]"
    with pytest.raises(ed.EngdynError, match="choose one of z, theta, zf, zr"):
        explorer.set(coordinate="phi")


def test_where_there_is_no_equilibrium_the_picture_says_so(explorer):
    # The front springs are so soft that the car would leave the region of admissible heights.
    explorer.set(system="S23", over="k_f", k_f=0.0)
    assert "0 equilibria" in explorer.text
    assert [text.get_text() for text in explorer.figure.axes[0].texts] == ["no equilibrium"]
    explorer.set(k_f=20000.0)
    assert "1 equilibrium: z = −0.216 m" in explorer.text


def test_an_own_system_joins_the_list():
    import sympy as sm
    from sympy.physics.vector import dynamicsymbols

    from engdyn import shapes

    theta = dynamicsymbols("theta")
    mass, length, spring = (
        ed.Parameter("m", "kg", 2.0, "mass"),
        ed.Parameter("l", "m", 1.0, "length"),
        ed.Parameter("k_t", "N m/rad", 10.0, "spring", "nonnegative"),
    )
    m, l, k = mass.symbol, length.symbol, spring.symbol
    own = ed.System(
        title="Inverted pendulum",
        coordinates=[ed.Coordinate(theta, "rad", "tilt", (-3.0, 3.0))],
        parameters=[mass, length, spring],
        kinetic_energy=m * l**2 * theta.diff() ** 2 / 2,
        potential_energy=m * 9.81 * l * sm.cos(theta) + k * theta**2 / 2,
        shapes=lambda q, v: [
            shapes.Link((0, 0), (-v["l"] * math.sin(q[0]), v["l"] * math.cos(q[0]))),
            shapes.Particle((-v["l"] * math.sin(q[0]), v["l"] * math.cos(q[0]))),
        ],
    )
    explorer = ed.widgets.equilibrium(own, k_t=10.0)
    assert explorer.state == {
        "system": own.key,
        "over": "k_t",
        "coordinate": "theta",
        "m": 2.0,
        "l": 1.0,
        "k_t": 10.0,
    }
    assert "Inverted pendulum, k_t = 10 N m/rad: 3 equilibria" in explorer.text
    explorer.set(k_t=25.0)
    assert "1 equilibrium: theta = 0 (marginal)" in explorer.text
    explorer.set(system="S07")
    assert "Gantry crane" in explorer.text
    explorer.set(system=own.key)
    assert "Inverted pendulum" in explorer.text
    again = ed.widgets.equilibrium("S07")
    again.set(system=own)
    assert again.state["system"] == own.key


def test_a_worked_example_may_be_chosen_too():
    explorer = ed.widgets.equilibrium("W10")
    assert explorer.text.startswith(
        "Equilibria. Simple pendulum, l = 0.8 m: 2 equilibria: theta = 0 (marginal)"
    )
    explorer.set(system="S03")
    explorer.set(system="W10", l=1.2)
    assert "l = 1.2 m" in explorer.text


@pytest.mark.parametrize(
    ("default", "admissible", "limits"),
    [
        (4.0, "positive", (0.8, 10.0)),
        (4.0, "nonnegative", (0.0, 10.0)),
        (4.0, "any", (0.0, 10.0)),
        (-4.0, "any", (-10.0, 0.0)),
        (0.0, "nonnegative", (0.0, 10.0)),
        (0.0, "any", (-10.0, 10.0)),
    ],
)
def test_sliders_stay_within_what_is_admissible(default, admissible, limits):
    parameter = ed.Parameter("p", "N/m", default, "something", admissible)
    control = slider(parameter)
    assert (control.low, control.high, control.value) == (*limits, default)
    for value in limits:
        parameter.check(value)
    # A slider shows nothing between its steps: the default must be one of them.
    steps = (control.value - control.low) / control.step
    assert steps == pytest.approx(round(steps))


def test_the_model_knows_nothing_of_pictures():
    governor = ed.systems.load("S03")
    found, verdicts = find(governor, governor.values(Omega=18.0))
    assert [state.q[0] for state in found] == pytest.approx([-0.77269, 0.0, 0.77269], abs=1e-5)
    assert verdicts == ["asymptotically stable", "unstable (divergence)", "asymptotically stable"]
    branches = governor.branches("Omega", (5.0, 30.0))
    assert [point.parameter for point in branches.points] == pytest.approx([CRITICAL])


@settings(max_examples=15)
@given(st.sampled_from(["S03", "S07", "S23"]), st.randoms(use_true_random=False))
def test_no_position_of_the_sliders_raises_or_blanks(explorer, system, rng: random.Random):
    explorer.set(system=system)
    controls = [c for c in explorer._controls.values() if hasattr(c, "low")]
    values = {c.name: rng.choice([c.low, c.high, rng.uniform(c.low, c.high)]) for c in controls}
    explorer.set(over=rng.choice(controls).name, **values)
    assert explorer.state | values == explorer.state
    assert "equilibri" in explorer.text or "Nothing to draw" in explorer.text
    assert np.ptp(np.frombuffer(explorer.figure.canvas.buffer_rgba(), np.uint8)) > 100


def test_words_are_the_same_in_every_run():
    assert repr(ed.widgets.equilibrium("S03")) == repr(ed.widgets.equilibrium("S03"))
