"""Explorers of chapters 1 to 3, driven without a browser: numbers, words, extremes, code."""

from __future__ import annotations

import math
import random
import runpy

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

import engdyn as ed
from engdyn.widgets.controls import Choice, Slider

SCENES = [
    (name, scene)
    for name, scenes in {
        "motion": ("arm", "shuttle", "arrow", "rod"),
        "orientation": ("manipulator", "orders", "euler"),
        "gyroscope": ("top", "path", "ball", "book"),
        "inertia": ("mass", "disc"),
        "balance": ("belt", "bar", "roll"),
        "loads": ("push", "dashpot", "energy"),
    }.items()
    for scene in scenes
]


@pytest.fixture(scope="module")
def explorers():
    return {name: getattr(ed.widgets, name)() for name, _ in SCENES}


def numbers(explorer):
    return explorer.model(explorer.state)


def anywhere(explorer, rng: random.Random):
    """Put all controls anywhere, ends included."""
    explorer.set(
        **{
            name: rng.choice([option for _, option in c.options])
            if isinstance(c, Choice)
            else rng.choice([c.low, c.high, rng.uniform(c.low, c.high)])
            for name, c in explorer._controls.items()
            if name not in explorer.structural
        }
    )


def shows_something(explorer):
    return np.ptp(np.frombuffer(explorer.figure.canvas.buffer_rgba(), np.uint8)) > 100


@pytest.mark.parametrize(("name", "scene"), SCENES)
@settings(max_examples=4)
@given(rng=st.randoms(use_true_random=False))
def test_no_position_of_the_controls_raises_or_blanks(explorers, name, scene, rng):
    explorer = explorers[name]
    explorer.set(scene=scene)
    anywhere(explorer, rng)
    assert shows_something(explorer)
    assert "nan " not in explorer.text
    assert explorer.text.startswith(f"{explorer.title}. {explorer.caption(explorer.state)}: ")


@pytest.mark.parametrize(("name", "scene"), SCENES)
def test_reset_returns_to_the_picture_of_the_beginning(name, scene):
    explorer = getattr(ed.widgets, name)(scene)
    start, picture, words = explorer.state, explorer.png(), explorer.text
    anywhere(explorer, random.Random(3))
    assert explorer.state != start
    explorer.reset()
    assert (explorer.state, explorer.png(), explorer.text) == (start, picture, words)
    # A slider shows nothing between its steps.
    for c in (c for c in explorer._controls.values() if isinstance(c, Slider)):
        steps = (c.value - c.low) / c.step
        assert steps == pytest.approx(round(steps), abs=1e-6), c.name
        assert c.meaning


@pytest.mark.parametrize(("name", "scene"), SCENES)
def test_the_lines_of_code_run(name, scene, monkeypatch, tmp_path):
    shown = []
    monkeypatch.setattr(ed.plots, "show", shown.append)
    explorer = getattr(ed.widgets, name)(scene)
    explorer.set(**{c.name: c.high for c in explorer._controls.values() if isinstance(c, Slider)})
    (tmp_path / "shown.py").write_text(explorer.code, encoding="utf-8")
    runpy.run_path(tmp_path / "shown.py")
    assert ed.plots.alt(shown[0])


# Chapter 1


def test_the_chord_becomes_the_tangent():
    explorer = ed.widgets.motion("arrow", L=2.0, L_d=1.0, theta_d=1.0)
    misses = []
    for dt in (0.2, 0.02):
        explorer.set(dt=dt)
        rates = numbers(explorer)["rates"][:, 0]
        before, after = numbers(explorer)["ends"]
        assert np.linalg.norm(rates) * dt == pytest.approx(np.linalg.norm(after - before))
        misses.append(np.linalg.norm(rates - [1.0, 2.0]))
    assert misses[0] / misses[1] == pytest.approx(10.0, rel=0.1)


def test_the_velocity_of_a_rod_is_one_vector_in_two_bases():
    explorer = ed.widgets.motion("rod", theta=0.7, theta_d=3.0)
    assert "(−2.706, 3.212) m/s" in explorer.text  # -1.4 * 3 sin 0.7, 1.4 * 3 cos 0.7
    explorer.set(basis="rod")
    assert "(0, 4.2) m/s" in explorer.text
    explorer.set(basis="twice")
    assert "a speed of 8.4 m/s" in explorer.text


def test_the_terms_of_the_collar():
    state = {"r": 0.4, "r_d": 0.5, "r_dd": -3.0, "theta": 0.5, "theta_d": -2.0, "theta_dd": 7.0}
    explorer = ed.widgets.motion("shuttle", x_dd=6.0, **state)
    along, across = np.array([math.cos(0.5), math.sin(0.5)]), np.array([-math.sin(0.5), math.cos(0.5)])
    expected = {
        "base": [6.0, 0.0],
        "tangential": 0.4 * 7.0 * across,
        "centripetal": -0.4 * 4.0 * along,
        "coriolis": 2 * 0.5 * -2.0 * across,
        "relative": -3.0 * along,
    }
    found = numbers(explorer)
    for name, term in expected.items():
        assert found[name] == pytest.approx(term)
    assert found["total"] == pytest.approx(sum(np.array(term) for term in expected.values()))
    assert found["path"] == pytest.approx(found["total"], abs=1e-5)
    explorer.set(left_out="coriolis")
    assert numbers(explorer)["path"] - numbers(explorer)["total"] == pytest.approx(
        expected["coriolis"], abs=1e-5
    )
    assert "without the Coriolis term the sum misses it by 2 m/s²" in explorer.text


def test_where_all_terms_vanish_the_picture_says_so():
    explorer = ed.widgets.motion("arm", r_d=0.0, r_dd=0.0, theta_d=0.0, theta_dd=0.0)
    assert "Nothing to draw: acceleration_terms: all terms are zero" in explorer.text


def test_the_manipulator():
    explorer = ed.widgets.orientation("manipulator", beta=0.5, r=1.1, psi_d=1.0, beta_d=0.6, r_d=0.4)
    found = numbers(explorer)
    assert found["velocity"] == pytest.approx([0.4, 1.1 * math.cos(0.5), 1.1 * 0.6])
    assert np.linalg.norm(found["alpha"]) == pytest.approx(0.6)
    assert found["axes"][0] == pytest.approx(
        [math.cos(0.5) * math.cos(0.7), math.cos(0.5) * math.sin(0.7), math.sin(0.5)]
    )


def test_the_gap_between_two_orders_is_second_order():
    explorer = ed.widgets.orientation("orders", about_x=math.pi / 2, about_z=math.pi / 2)
    assert numbers(explorer)["gap"] == pytest.approx(2 * math.pi / 3)
    explorer.set(about_x=0.01, about_z=0.02)
    assert numbers(explorer)["gap"] == pytest.approx(0.01 * 0.02, rel=0.01)
    first, second = numbers(explorer)["rows"]
    quarter = [Rotation.from_rotvec(v).as_matrix() for v in ([0.01, 0, 0], [0, 0, 0.02])]
    assert first[2][1] == pytest.approx(quarter[1] @ quarter[0])
    assert second[2][1] == pytest.approx(quarter[0] @ quarter[1])


def test_euler_angles_and_gimbal_lock():
    explorer = ed.widgets.orientation("euler", first=0.8, second=0.6, third=0.5)
    end = numbers(explorer)["rows"][0][-1][1]
    assert end[:, 2] == pytest.approx(
        [math.sin(0.6) * math.sin(0.8), -math.sin(0.6) * math.cos(0.8), math.cos(0.6)]
    )
    assert abs(numbers(explorer)["determinant"]) == pytest.approx(math.sin(0.6))
    explorer.set(second=0.0)
    assert "Gimbal lock" in explorer.text
    explorer.set(sequence="ZYX")
    assert "Gimbal lock" not in explorer.text


# Chapter 2


def test_the_top_has_two_precessions_one_or_none():
    explorer = ed.widgets.gyroscope("top", spin=200.0, theta=0.5)
    A, C, weight = 4.2e-4, 9.2e-5, 0.15 * 9.81 * 0.05
    slow, fast = sorted(np.roots([A * math.cos(0.5), -C * 200.0, weight]).real)
    assert numbers(explorer)["now"].rates == pytest.approx((slow, fast))
    assert f"Slow precession {slow:.4g} rad/s" in explorer.text
    explorer.set(spin=60.0)
    assert "No steady precession" in explorer.text
    explorer.set(theta=2.2)
    assert numbers(explorer)["now"].fast < 0.0 < numbers(explorer)["now"].slow


def test_the_top_in_motion_keeps_its_energy_and_may_fall():
    explorer = ed.widgets.gyroscope("path", spin=200.0, theta=0.5, precession=0.0)
    found = numbers(explorer)
    # Released at rest: the cone to which it falls, from energy and angular momentum.
    A, C, weight = 4.2e-4, 9.2e-5, 0.15 * 9.81 * 0.05
    a = (C * 200.0) ** 2 / (4 * A * weight)
    u0 = math.cos(0.5)
    lowest = a - math.sqrt(a**2 - 2 * a * u0 + 1)
    assert math.cos(found["lean"].max()) == pytest.approx(lowest, abs=2e-4)
    assert found["lean"].min() == pytest.approx(0.5, abs=1e-4)
    explorer.set(spin=20.0)
    assert "The top falls" in explorer.text


def test_the_ball():
    explorer = ed.widgets.gyroscope("ball", ratio=0.6, nutation=0.45, spin=50.0)
    found = numbers(explorer)
    assert found["found"].precession == pytest.approx(0.6 * 50.0 / math.cos(0.45))
    assert found["found"].wobble == pytest.approx(-0.4 * 50.0)
    axis, omega = found["axis"], found["omega"]
    momentum = 0.6 * (omega @ axis) * axis + 1.0 * (omega - (omega @ axis) * axis)
    assert momentum == pytest.approx(found["momentum"])
    assert math.acos(omega @ axis / np.linalg.norm(omega)) == pytest.approx(found["between"])
    assert "ω lies between the axis and H" in explorer.text
    explorer.set(ratio=1.95)
    assert "ω lies beyond H" in explorer.text


@pytest.mark.parametrize(("axis", "calm"), [("1", True), ("2", False), ("3", True)])
def test_the_book_is_calm_about_two_axes(axis, calm):
    explorer = ed.widgets.gyroscope("book", axis=axis)
    found = numbers(explorer)
    size = np.linalg.norm(found["momentum"], axis=1)
    assert np.ptp(size) < 1e-5 * size[0]
    energy = np.sum(found["momentum"] * found["omega"].T, axis=1)
    assert np.ptp(energy) < 1e-5 * energy[0]
    assert ("stays calm" if calm else "turns over 3 times") in explorer.text


def test_one_mass_on_a_bent_arm():
    explorer = ed.widgets.inertia("mass", x=0.8, y=0.6, z=0.5)
    assert numbers(explorer)["moments"] == pytest.approx([0.36 + 0.25, -0.48, -0.4])
    explorer.set(motion="velocity")
    r, spin = np.array([0.8, 0.6, 0.5]), np.array([1.0, 0.0, 0.0])
    force = np.cross(spin, np.cross(spin, r))
    assert numbers(explorer)["moments"] == pytest.approx(np.cross(r, force))
    explorer.set(x=0.0)
    assert "nothing to hold against" in explorer.text


def test_the_disc_askew():
    explorer = ed.widgets.inertia("disc", skew=0.4, thickness=0.02, omega=100.0)
    found = numbers(explorer)
    A, C = 2.0 * (3 * 0.15**2 + 0.02**2) / 12, 2.0 * 0.15**2 / 2
    c, s = math.cos(0.4), math.sin(0.4)
    assert found["momentum"] == pytest.approx([0.0, -(C - A) * s * c * 100.0, (C * c**2 + A * s**2) * 100.0])
    assert found["moment"] == pytest.approx([(C - A) * s * c * 1e4, 0.0, 0.0])
    assert "toward the axis" in explorer.text
    explorer.set(thickness=0.4)
    assert "away from the axis" in explorer.text
    explorer.set(skew=0.0)
    assert "principal axis" in explorer.text


def test_the_parcel_on_the_belt():
    explorer = ed.widgets.balance("belt", s=1.2, s_d=1.5, s_dd=1.8, psi_d=1.1, psi_dd=0.6)
    along = 1.8 - 1.2 * 1.1**2 - 0.2 * 0.6
    across = 1.2 * 0.6 + 2 * 1.5 * 1.1 - 0.2 * 1.1**2
    assert numbers(explorer)["absolute"] == pytest.approx([along, across])
    assert f"coefficient of {math.hypot(along, across) / 9.81:.4g}" in explorer.text
    explorer.set(acceleration="relative")
    assert f"forgotten: {1.8 / 9.81:.4g} seems enough" in explorer.text


def test_the_bar_on_the_cart_moves_alike_about_all_points():
    explorer = ed.widgets.balance("bar", theta=0.45, theta_d=1.0, x_b_dd=4.0)
    expected = 1.5 / 0.8 * (9.81 * math.sin(0.45) + 4.0 * math.cos(0.45))
    for point, extra in (("A", True), ("G", False), ("E", True), ("O", False)):
        explorer.set(about=point)
        found = numbers(explorer)
        assert found["theta_dd"] == pytest.approx(expected)
        assert found["rate"] + found["extra"] == pytest.approx(found["moments"])
        assert (abs(found["extra"]) > 0.1) is extra
    explorer.set(about="A")
    assert numbers(explorer)["moments"] == pytest.approx(2.0 * 9.81 * 0.4 * math.sin(0.45))


def test_the_roll_against_the_system_and_at_the_limit():
    explorer = ed.widgets.balance("roll", beta=0.35, ratio=0.6, mu=0.3)
    system = ed.systems.load("W3")
    values = system.values(beta=0.35, m=300.0, M=500.0)
    found = numbers(explorer)
    wedge, roll = system.newton().accelerations([0, 0], [0, 0], values)
    assert (found["wedge"], found["roll"]) == pytest.approx((wedge, roll))
    normal = 300 * (9.81 * math.cos(0.35) + wedge * math.sin(0.35))
    assert found["needed"] == pytest.approx(300 * roll / 2 / normal)
    explorer.set(beta=0.6, mu=0.05)
    found = numbers(explorer)
    assert "It slips" in explorer.text
    assert found["roll"] > 2 * found["turning"]
    # Heavy wedge: a cylinder on a fixed slope needs tan(beta)/3.
    explorer.set(ratio=0.02)
    assert numbers(explorer)["needed"] == pytest.approx(math.tan(0.6) / 3, rel=0.02)


# Chapter 3


def test_a_push_that_keeps_its_direction_and_one_that_follows():
    explorer = ed.widgets.loads("push", F=8.0, theta=0.6)
    gamma, l = math.pi / 6, 0.6
    assert numbers(explorer) == pytest.approx([8 * math.cos(gamma), 8 * l * math.cos(0.6)])
    explorer.set(direction="follower")
    assert numbers(explorer) == pytest.approx([8 * math.cos(0.6 - gamma), 8 * l])


def test_the_dashpot_takes_out_the_power_of_its_forces():
    explorer = ed.widgets.loads("dashpot", angle=0.7, s=0.1, theta=-0.5, s_d=-1.0, theta_d=2.0)
    found = numbers(explorer)
    gamma, l = math.pi / 6, 0.6
    velocity = -1.0 * np.array([math.cos(gamma), math.sin(gamma)]) + 2 * l * np.array(
        [math.cos(0.5), -math.sin(0.5)]
    )
    rate = -velocity @ [math.cos(0.7), math.sin(0.7)]
    assert found["rate"] == pytest.approx(rate)
    assert found["D"] == pytest.approx(5.0 * rate**2 / 2)
    assert found["Q"] @ [-1.0, 2.0] == pytest.approx(-2 * found["D"])
    assert ("grows" if rate > 0 else "shrinks") in explorer.text


def test_the_energies_of_the_bench():
    explorer = ed.widgets.loads("energy", s=0.1, theta=0.6, s_d=0.5, theta_d=2.0)
    found = numbers(explorer)
    gamma, l, m, m_s = math.pi / 6, 0.6, 3.0, 1.0
    assert found["spring"] == pytest.approx(400 * 0.1**2 / 2)
    height = 0.1 * math.sin(gamma)
    assert found["weights"] == pytest.approx(9.81 * (m_s * height + m * (height - l / 2 * math.cos(0.6))))
    v = [0.5 * math.cos(gamma) + l * math.cos(0.6), 0.5 * math.sin(gamma) + l * math.sin(0.6)]
    assert found["T"] == pytest.approx((m_s * 0.25 + m * np.dot(v, v) + m * l**2 / 12 * 4) / 2)
