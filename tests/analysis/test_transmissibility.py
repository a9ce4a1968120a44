"""Transmissibility: closed forms of one mode, and direct solutions of systems on moving ground."""

from __future__ import annotations

import numpy as np
import pytest
import sympy as sm
from sympy.physics.mechanics import dynamicsymbols

import engdyn as ed
from analysis.linear_of import linearized

T = dynamicsymbols._t


def isolator(ratio):
    """One mass of 1 kg on a spring and a damper, 1 Hz, with the base motion xb; s is its acceleration."""
    x, xb = dynamicsymbols("x xb")
    omega = 2 * np.pi
    row = x.diff(T, 2) + 2 * ratio * omega * (x - xb).diff(T) + omega**2 * (x - xb)
    eom = ed.EquationsOfMotion.from_residuals([row], [x])
    return ed.linearize(eom, {}, {}, outputs={"s": x.diff(T, 2), "stretch": x - xb})


@pytest.mark.parametrize("ratio", [0.02, 0.3, 1.5])
def test_closed_forms(ratio):
    linear, f = isolator(ratio), np.linspace(0.1, 4.0, 200)
    below = 1 - f**2 + 2j * ratio * f
    expected = {"absolute": (1 + 2j * ratio * f) / below, "relative": f**2 / below}
    expected["acceleration"] = expected["absolute"]
    for kind, response in expected.items():
        found = ed.transmissibility(linear, f, "xb", "x", kind)
        np.testing.assert_allclose(found.response, response, rtol=1e-11)
        assert found.unit == "-"
    for output in ("s", "x''"):
        sensed = ed.transmissibility(linear, f, "xb", output, "acceleration")
        np.testing.assert_allclose(sensed.response, expected["absolute"], rtol=1e-11)
    stretch = ed.frequency_response(linear, f, "xb", "stretch")
    np.testing.assert_allclose(stretch.response, expected["relative"], rtol=1e-9)


def test_all_curves_cross_at_the_root_of_two():
    for ratio in (0.05, 0.2, 0.9):
        at = ed.transmissibility(isolator(ratio), [0.0, np.sqrt(2)], "xb", "x")
        np.testing.assert_allclose(at.amplitude, 1.0, rtol=1e-12)


def test_peaks_of_what_is_derived():
    """The relative response has its peak above the natural frequency, at 1/√(1 − 2ζ²)."""
    found = ed.transmissibility(isolator(0.2), np.linspace(0.1, 4.0, 200), "xb", "x", "relative")
    np.testing.assert_allclose(found.peaks, 1 / np.sqrt(1 - 2 * 0.2**2), rtol=1e-7)


def test_two_stages():
    """Exercise 7.1: per base amplitude at 4 Hz; relative is not absolute."""
    linear = linearized(10)
    assert ed.transmissibility(linear, 4.0, "yb", "y1").amplitude == pytest.approx(3.6854, rel=2e-5)
    assert ed.transmissibility(linear, 4.0, "yb", "y2").amplitude == pytest.approx(9.2314, rel=2e-5)
    relative = ed.transmissibility(linear, 4.0, "yb", "y2", "relative")
    assert relative.response == pytest.approx(ed.frequency_response(linear, 4.0, "yb", "y2").response - 1)


def test_seismometer():
    """Exercise 7.2: the tilt of S04 per ground acceleration, flat below the natural frequency."""
    system = ed.systems.load(4)
    theta = system.coordinates[0].symbol
    values = system.values()
    length = next(p.symbol for p in system.parameters if p.name == "l")
    ground = next(w.symbol for w in system.inputs if w.kind == "prescribed motion")
    outputs = {"head": (ground - length * sm.sin(theta)).diff(T, 2)}
    linear = ed.linearize(system.equations, system.equilibria()[0], outputs=outputs)
    f = np.array([0.01, 0.3, 3.0])
    per_acceleration = {ground.func.__name__: lambda f: -1 / (2 * np.pi * f) ** 2}
    found = ed.frequency_response(linear, f, per_acceleration, "theta", unit="rad s^2/m")
    s, ml = 2j * np.pi * f, values["m"] * values["l"]
    inertia = values["J_G"] + ml * values["l"]
    expected = ml / (inertia * s**2 + values["c_e"] * s + values["k_f"] - ml * 9.81)
    np.testing.assert_allclose(found.response, expected, rtol=1e-10)
    head = ed.transmissibility(linear, f, "xb", "head", "acceleration")
    np.testing.assert_allclose(head.response, 1 - values["l"] * s**2 * expected, rtol=1e-10)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ((1.0, "x", "x"), "choose one of the inputs xb"),
        ((1.0, "xb", "x", "velocity"), "absolute, relative, acceleration"),
        (([0.0, 1.0], "xb", "s", "acceleration"), "begin above 0 Hz"),
        ((1.0, "xb", "y"), "no output 'y'"),
        ((1.0, "xb", "x''"), "needs 'x'"),
        ((1.0, "xb", "x'", "acceleration"), "needs 'x'"),
    ],
)
def test_what_is_wrong_is_said(arguments, message):
    with pytest.raises(ed.EngdynError, match=message):
        ed.transmissibility(isolator(0.1), *arguments)
