"""Pictures of motions and schemes show their numbers."""

from __future__ import annotations

import numpy as np
import pytest

import engdyn as ed
from engdyn.plots.look import PALETTE

S07 = ed.systems.load("S07")


@pytest.fixture(scope="module")
def history():
    theta = S07.coordinates[1].symbol
    return S07.simulate(([0, 0.5], [0, 0]), np.linspace(0, 5, 101), events=theta)


def relaxation(t, x):
    return -2 * x


def drawn(ax):
    return [np.column_stack(line.get_data()) for line in ax.get_lines()]


def test_one_panel_for_each_unit(history):
    ax = ed.plots.time_history(history, ["x", "theta", "theta'", "F"], system=S07)
    panels = ax.figure.axes
    assert [panel.get_ylabel() for panel in panels] == [
        "$x$ [m]",
        r"$\theta$ [rad]",
        r"$\dot {\theta}$ [rad/s]",
        "$F$ [N]",
    ]
    assert panels[-1].get_xlabel() == "$t$ [s]"
    np.testing.assert_array_equal(drawn(panels[2])[0][:, 1], history["theta'"])
    marks = [line for line in panels[1].get_lines() if line.get_linestyle() == ":"]
    np.testing.assert_allclose([line.get_xdata()[0] for line in marks], history.events[0].time)
    words = ed.plots.alt(ax)
    assert "theta goes from 0.5 to −0.09738 rad within 5 s" in words
    assert "theta: at 1.0258, 2.9469, 4.796 s" in words


def test_several_motions_are_told_apart_without_color(history):
    slow = S07.simulate(([0, 0.2], [0, 0]), np.linspace(0, 5, 51))
    ax = ed.plots.time_history({"wide": history, "narrow": slow}, "theta", system=S07)
    lines = [line for line in ax.get_lines() if line.get_label()[0] == "$"]
    assert [t.get_text() for t in ax.get_legend().get_texts()] == [r"$\theta$, wide", r"$\theta$, narrow"]
    assert len({line.get_linestyle() for line in lines}) == 2
    assert [line.get_color() for line in lines] == list(PALETTE[:2])
    assert "narrow: theta goes from 0.2" in ed.plots.alt(ax)
    again = ed.plots.time_history(slow, "theta", ax=ax)
    assert again is ax
    assert ax.get_ylabel() == "theta", "without a system no unit is claimed"
    with pytest.raises(ed.EngdynError, match="different units"):
        ed.plots.time_history(history, ax=ax, system=S07)
    with pytest.raises(ed.EngdynError, match="no 'phi'"):
        ed.plots.time_history(history, "phi")


def test_phase_portraits(history):
    ax = ed.plots.phase_portrait(history, "theta", system=S07)
    path, start = drawn(ax)
    np.testing.assert_array_equal(path, np.column_stack([history["theta"], history["theta'"]]))
    np.testing.assert_array_equal(start, [[0.5, 0.0]])
    assert (ax.get_xlabel(), ax.get_ylabel()) == (r"$\theta$ [rad]", r"$\dot {\theta}$ [rad/s]")
    assert "from (0.5, 0) to (−0.09738, −0.4412)" in ed.plots.alt(ax)
    both = ed.plots.phase_portrait({"a": history, "b": history})
    assert both.get_xlabel() == "x"
    assert both.get_legend() is not None


def test_errors_over_step_and_over_work():
    found = [ed.measure_order(relaxation, [1.0], 1.0, s, (10, 20, 40)) for s in ("euler", "rk4")]
    steps, work = ed.plots.error_over_step(found), ed.plots.work_precision(found)
    for ax in (steps, work):
        assert (ax.get_xscale(), ax.get_yscale()) == ("log", "log")
        assert len({(line.get_marker(), line.get_linestyle()) for line in ax.get_lines()}) == 2
    np.testing.assert_array_equal(drawn(steps)[1], np.column_stack([found[1].step, found[1].error]))
    np.testing.assert_array_equal(drawn(work)[1][:, 0], [40, 80, 160])
    assert "rk4 (slope 4." in steps.get_legend().get_texts()[1].get_text()
    own = ed.plots.work_precision({"mine": ([10, 100], [1e-2, 1e-4])})
    assert "mine: 1.0e-02 at 10, 1.0e-04 at 100" in ed.plots.alt(own)
    with pytest.raises(ed.EngdynError, match="nothing to plot"):
        ed.plots.error_over_step([])


def test_constructions_of_steps():
    euler = ed.plots.step_construction(relaxation, [1.0], 0.2, "euler", steps=2)
    exact, *tangents, points = drawn(euler)
    np.testing.assert_allclose(exact[:, 1], np.exp(-2 * exact[:, 0]), rtol=1e-6)
    np.testing.assert_allclose(points, [[0, 1], [0.2, 0.6], [0.4, 0.36]])
    np.testing.assert_allclose(tangents, [points[:2], points[1:]])
    middle = ed.plots.step_construction(relaxation, [1.0], 0.2, "midpoint")
    _, tangent, slope, square, chord, points = drawn(middle)
    np.testing.assert_allclose(tangent, [[0, 1], [0.1, 0.8]])
    np.testing.assert_allclose(square, [[0.1, 0.8]])
    np.testing.assert_allclose(points, [[0, 1], [0.2, 0.68]])
    np.testing.assert_allclose(chord, points)
    np.testing.assert_allclose(np.diff(slope[:, 1]) / np.diff(slope[:, 0]), -1.6)
    assert "1 step of midpoint" in ed.plots.alt(middle)
    with pytest.raises(ed.EngdynError, match="not 'rk4'"):
        ed.plots.step_construction(relaxation, [1.0], 0.2, "rk4")


def test_a_history_can_be_animated(history):
    film = ed.plots.animate(S07, history)
    np.testing.assert_allclose(film.q[[0, -1]], history.q[[0, -1]])
