"""The explorer of stability maps, driven without a browser."""

from __future__ import annotations

import math
import random

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import solve_ivp

import engdyn as ed
from engdyn.widgets.stability_explorer import GRID, PLANES, probe
from widgets.code_runs import run

EXPLORER = ed.widgets.stability_map("S12")


def response():
    (curve,) = (line for line in EXPLORER.figure.axes[1].lines if line.get_animated())
    return curve


def test_the_verdict_of_the_probe_changes_at_the_flutter_speed():
    assert ed.widgets.stability_map().state["system"] == "S13"
    EXPLORER.set(system="S12", U=20.3)  # 20.3343 m/s, see the exercises
    assert "U = 20.3 m/s, d = 0.04 m: asymptotically stable, rightmost eigenvalue −0.0" in EXPLORER.text
    EXPLORER.set(U=20.37)
    assert "d = 0.04 m: unstable, flutter, rightmost eigenvalue 0.0" in EXPLORER.text


def test_the_probe_stands_where_the_sliders_say():
    EXPLORER.set(system="S12", U=12.0, d=0.05)
    *_, ring = (line for line in EXPLORER.figure.axes[0].lines if line.get_animated())
    assert ring.get_xydata().tolist() == [[12.0, 0.05]]


def test_the_response_is_that_of_small_nonlinear_motion():
    system = ed.systems.load("S12")
    EXPLORER.set(system="S12", U=25.0, d=0.04, coordinate="alpha")
    time, shown = response().get_data()
    size = 1e-7
    rhs = system.equations.function(system.values(U=25.0))
    solved = solve_ivp(rhs, (0, time[-1]), [0, size, 0, 0], t_eval=time, rtol=1e-10, atol=1e-16)
    assert np.allclose(shown, solved.y[1] / size, atol=1e-4)


def test_the_map_is_drawn_again_only_when_it_changes(monkeypatch):
    calls = []
    from engdyn.widgets import stability_explorer as module

    judged = module.judged
    monkeypatch.setattr(module, "judged", lambda *a, **k: calls.append(a[2]) or judged(*a, **k))
    explorer = ed.widgets.stability_map("S11")
    explorer.set(P=60.0)
    explorer.set(P=70.0, c_1=0.02)
    assert [len(x[1]) for x in calls] == [GRID, 1, 1, 1]
    explorer.set(m_1=2.2)
    assert [len(x[1]) for x in calls[4:]] == [GRID, 1]
    explorer.set(m_1=2.0)
    assert [len(x[1]) for x in calls[6:]] == [1]  # remembered


def ladder():
    import sympy as sm
    from sympy.physics.vector import dynamicsymbols

    theta = dynamicsymbols("theta")
    names = {"m": ("kg", 12.0), "L": ("m", 3.0), "k": ("N/m", 40.0), "g": ("m/s^2", 9.81)}
    parameters = [ed.Parameter(name, unit, value, name) for name, (unit, value) in names.items()]
    m, L, k, g = (p.symbol for p in parameters)
    return ed.System(
        title="Ladder",
        key="ladder",
        coordinates=[ed.Coordinate(theta, "rad", "angle", (-1.5, 1.5), "angle")],
        parameters=parameters,
        kinetic_energy=m * L**2 * theta.diff() ** 2 / 6,
        potential_energy=m * g * L / 2 * sm.cos(theta) + k * (L * sm.sin(theta)) ** 2 / 2,
    )


def test_a_system_of_ones_own_and_its_closed_form():
    explorer = ed.widgets.stability_map(ladder(), across="m", up="k")
    edge = 12.0 * 9.81 / (2 * 3.0)  # m g/(2 L)
    explorer.set(k=edge + 0.3)
    assert ": marginal" in explorer.text  # stable, without damping
    explorer.set(k=edge - 0.3)
    growth = math.sqrt(3 * (edge - explorer.state["k"]) / 12.0)  # J λ² = mgL/2 − kL², J = mL²/3
    assert f"unstable, divergence, rightmost eigenvalue {growth:.4g} 1/s" in explorer.text
    assert "# system is your own: Ladder" in explorer.code


def test_other_equilibria_than_zero_are_looked_for_within_the_bounds():
    EXPLORER.set(system="S10")
    assert "asymptotically stable" in EXPLORER.text
    assert "at=system.equilibria(values)[0])" in EXPLORER.code


def test_one_parameter_on_both_axes_is_explained():
    EXPLORER.set(system="S12", across="U", up="U")
    assert "Nothing to draw: both axes would show U; choose two parameters" in EXPLORER.text
    EXPLORER.reset()
    assert EXPLORER.state["up"] == "d"
    assert "asymptotically stable" in EXPLORER.text


def test_out_of_range_is_refused():
    with pytest.raises(ed.EngdynError, match="out of range"):
        EXPLORER.set(system="S13", v=81.0)


@pytest.mark.parametrize("name", ["S13", "S14", "S10"])
def test_the_code_gives_the_same_map_and_verdict(name, monkeypatch):
    EXPLORER.set(system=name)
    EXPLORER.reset()
    names, shown = run(EXPLORER, monkeypatch)
    system = EXPLORER.system(name)
    found = probe(system, system.values(), names["chart"], EXPLORER.state["coordinate"])
    mine = EXPLORER.model(EXPLORER.state)
    assert np.array_equal(names["chart"].verdict, mine.chart.verdict)
    assert names["here"].verdict[0, 0] == mine.verdict == found.verdict
    assert shown == [ed.plots.alt(EXPLORER.figure.axes[0])]


@settings(max_examples=12)
@given(st.sampled_from(["S11", "S12", "S13", "S15"]), st.randoms(use_true_random=False))
def test_no_position_of_the_sliders_raises_or_blanks(name, rng: random.Random):
    EXPLORER.set(system=name)
    controls = [c for c in EXPLORER._controls.values() if hasattr(c, "low")]
    EXPLORER.set(**{c.name: rng.choice([c.low, c.high, rng.uniform(c.low, c.high)]) for c in controls})
    assert (
        "The map:" in EXPLORER.text
        or "Nothing to draw" in EXPLORER.text
        or "ceased to exist" in EXPLORER.text
    )
    assert np.ptp(np.frombuffer(EXPLORER.figure.canvas.buffer_rgba(), np.uint8)) > 100


def test_the_planes_name_parameters_of_their_systems():
    for name, plane in PLANES.items():
        assert set(plane) <= {p.name for p in ed.systems.load(name).parameters}
