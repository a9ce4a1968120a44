"""Histories: names, outputs, tables, other times, and the books of energy."""

from __future__ import annotations

import numpy as np
import pytest
import sympy as sm
from sympy.physics.mechanics import dynamicsymbols

import engdyn as ed
from engdyn.analysis import energy_audit

t = dynamicsymbols._t
TIMES = np.linspace(0, 5, 101)


@pytest.fixture(scope="module")
def crane():
    return ed.systems.load("S07")


@pytest.fixture(scope="module")
def history(crane):
    return crane.simulate(([0, 0.5], [0.2, 0]), TIMES, inputs={"F": 500 * sm.cos(3 * t)}, rtol=1e-10)


def test_names_of_coordinates_rates_accelerations_and_inputs(crane, history):
    np.testing.assert_array_equal(history["theta"], history.q[:, 1])
    np.testing.assert_array_equal(history["x'"], history.u[:, 0])
    forces = 500 * np.cos(3 * TIMES)
    np.testing.assert_allclose(history["F"], forces)
    for i in (0, 40, 100):
        expected = crane.equations.accelerations(history.q[i], history.u[i], crane.values(), {"F": forces[i]})
        np.testing.assert_allclose([history["x''"][i], history["theta''"][i]], expected, rtol=1e-10)
    fine = history.at(np.linspace(1, 2, 100_001))
    slope = np.gradient(fine["theta'"], fine.time, edge_order=2)
    np.testing.assert_allclose(fine["theta''"], slope, atol=1e-5)
    assert history.names == ("x", "theta")


def test_outputs_of_expressions(crane, history):
    x, theta = (q.symbol for q in crane.coordinates)
    values = crane.values()
    at = history.output(x + sm.Symbol("L", positive=True) * sm.sin(theta))
    np.testing.assert_allclose(at, history["x"] + values["L"] * np.sin(history["theta"]))
    constant = history.output(sm.Integer(3))
    assert (constant.shape, constant[7]) == ((101,), 3.0)
    np.testing.assert_allclose(
        history.output(sm.sin(1003 * t) * x.diff(t)), np.sin(1003 * TIMES) * history["x'"]
    )
    np.testing.assert_allclose(
        history.output((x**2).diff(t, 2)), 2 * (history["x'"] ** 2 + history["x"] * history["x''"])
    )


def test_rates_that_a_rolling_condition_fixes():
    castor = ed.systems.load("S13")
    history = castor.simulate(([0, 0.2], [0.0]), np.linspace(0, 0.1, 11))
    assert history.u.shape == (11, 1)
    v = history.values
    expected = (history["y'"] * np.cos(history["psi"]) - v["v"] * np.sin(history["psi"])) / v["a"]
    np.testing.assert_allclose(history["psi'"], expected, rtol=1e-12)
    assert list(history.to_dataframe().columns) == ["y", "psi", "y'", "psi'", "F", "M"]


def test_a_table(history):
    table = history.to_dataframe()
    assert list(table.columns) == ["x", "theta", "x'", "theta'", "F", "W"]
    assert table.index.name == "time"
    np.testing.assert_array_equal(table.index, TIMES)
    np.testing.assert_array_equal(table["theta'"], history["theta'"])


def test_other_times(history):
    later = history.at([1.0, 2.5, 5.0])
    np.testing.assert_array_equal(later.q, history.q[[20, 50, 100]])
    np.testing.assert_array_equal(later["F"], history["F"][[20, 50, 100]])
    with pytest.raises(ed.EngdynError, match="between 0 and 5 s"):
        history.at([5.1])


def test_short_in_words(history):
    assert repr(history) == "TimeHistory(x, theta; 0 to 5 s, 101 times)"
    html = history._repr_html_()
    assert "<td><code>theta</code></td><td>0.5</td>" in html
    assert "0x" not in html


def test_what_a_history_does_not_know(history):
    for name, message in (("phi", "x, theta, F, W"), (3, "history\\[3\\]")):
        with pytest.raises(ed.EngdynError, match=message):
            history[name]
    with pytest.raises(ed.EngdynError, match="contains phi"):
        history.output(dynamicsymbols("phi"))
    with pytest.raises(ed.EngdynError, match="contains A"):
        history.output(sm.Symbol("A") * t)
    with pytest.raises(ed.EngdynError, match="not text"):
        history.output("x")


# ---------------------------------------------------------------- energy


def test_energies_are_those_of_the_definition(crane, history):
    audit = history.audit
    np.testing.assert_allclose(audit.energy, audit.kinetic + audit.potential)
    np.testing.assert_allclose(audit.kinetic, history.output(crane.kinetic_energy))
    power = history["F"] * history["x'"]
    work = np.append(0, np.cumsum((power[1:] + power[:-1]) / 2 * np.diff(TIMES)))
    assert np.max(np.abs(audit.work_of_forces - work)) < 2e-3 * np.ptp(work)
    losses = history.output(2 * crane.dissipation)
    lost = np.append(0, np.cumsum((losses[1:] + losses[:-1]) / 2 * np.diff(TIMES)))
    assert np.max(np.abs(audit.dissipated - lost)) < 2e-3 * np.ptp(lost)
    assert np.max(np.abs(audit.work_of_motions)) < 1e-9
    assert audit.error < 1e-8


def test_the_work_of_a_moving_base_is_what_its_force_does():
    x, base = dynamicsymbols("x base")
    m, k, c = sm.symbols("m k c", positive=True)
    stretch = x - base
    eom = ed.lagrange(m * x.diff() ** 2 / 2, k * stretch**2 / 2, [x], c * stretch.diff(t) ** 2 / 2)
    values = {"m": 2.0, "k": 800.0, "c": 5.0}
    times = np.linspace(0, 2, 4001)
    history = ed.simulate(eom, ([0], [0]), times, values, {"base": 0.01 * sm.sin(25 * t)}, rtol=1e-11)
    force = -(values["k"] * history.output(stretch) + values["c"] * history.output(stretch.diff(t)))
    power = force * history["base'"]
    work = np.append(0, np.cumsum((power[1:] + power[:-1]) / 2 * np.diff(times)))
    np.testing.assert_allclose(history.audit.work_of_motions, work, atol=1e-5 * np.ptp(work))
    lost = values["c"] * history.output(stretch.diff(t)) ** 2
    assert history.audit.dissipated[-1] == pytest.approx(np.trapezoid(lost, times), rel=1e-5)
    assert history.audit.error < 1e-9


def test_a_wrong_motion_does_not_pass_the_audit(crane, history):
    question = history._observe, history.time, history.steps
    right = energy_audit.audited(*question, history.dense)

    def slipping(at):
        states = history.dense(at).copy()
        states[1] += 1e-4 * at
        return states

    wrong = energy_audit.audited(*question, slipping)
    assert right.error < 1e-8
    assert wrong.error > 1e-5


def test_equations_without_energies_say_so(crane):
    history = ed.simulate(crane.newton(), ([0, 0.5], [0, 0]), [0, 1], crane.values())
    with pytest.raises(ed.EngdynError, match="equations from Newton-Euler do not know their energies"):
        assert history.audit


def test_the_books_in_words(history):
    assert repr(history.audit).startswith("EnergyAudit(closed to ")
    assert "<td>work of forces</td>" in history.audit._repr_html_()
