"""The explorer of linearization, driven without a browser."""

from __future__ import annotations

import math

import numpy as np
import pytest
import sympy as sm
from hypothesis import given, settings
from hypothesis import strategies as st

import engdyn as ed
from engdyn.widgets.linearization_explorer import FUNCTIONS, tangent_of
from widgets.code_runs import run

EXPLORER = ed.widgets.linearization()


def test_numbers_of_the_sine():
    found = tangent_of(FUNCTIONS["sine"], 0.6, 0.5)
    assert (found.value, found.slope) == pytest.approx((math.sin(0.6), math.cos(0.6)))
    assert found.error == pytest.approx(math.sin(0.6) + 0.5 * math.cos(0.6) - math.sin(1.1))
    assert tangent_of(FUNCTIONS["sine"], 0.6, 0.02).ratio == pytest.approx(4.0, abs=0.05)  # second order
    assert tangent_of(FUNCTIONS["sine"], 0.0, 0.02).ratio == pytest.approx(
        8.0, abs=0.01
    )  # no curvature: third


@pytest.mark.parametrize("name", list(FUNCTIONS))
@pytest.mark.parametrize("at", [0.35, 1.25])
def test_value_and_slope_are_those_of_the_code_that_is_shown(name, at, monkeypatch):
    EXPLORER.set(function=name, at=at, deviation=0.3)
    names, shown = run(EXPLORER, monkeypatch)
    found = tangent_of(FUNCTIONS[name], at, 0.3)
    assert (names["value"], names["slope"], names["error"]) == pytest.approx(
        (found.value, found.slope, found.error)
    )
    assert isinstance(names["function"], sm.Expr)
    assert shown[0].startswith(f"The curve {names['function']} and its tangent at x = {at:g}")


def test_the_picture_shows_point_tangent_and_error():
    EXPLORER.set(function="cosine", at=0.5, deviation=1.0)
    left, right = EXPLORER.figure.axes
    tangent, gap, point = (line for line in left.lines if line.get_animated())
    x, y = tangent.get_data()
    assert np.diff(y) / np.diff(x) == pytest.approx(-math.sin(0.5))
    assert gap.get_ydata() == pytest.approx([math.cos(1.5), math.cos(0.5) - math.sin(0.5)])
    assert point.get_xydata()[0] == pytest.approx((0.5, math.cos(0.5)))
    curve, dot = (line for line in right.lines if line.get_animated())
    assert dot.get_ydata()[0] == pytest.approx(abs(math.cos(0.5) - math.sin(0.5) - math.cos(1.5)))
    assert np.interp(1.0, *curve.get_data()) == pytest.approx(dot.get_ydata()[0], rel=1e-3)


def test_where_there_is_no_slope_the_picture_says_so():
    EXPLORER.set(function="root", at=0.0)
    assert "Nothing to draw: outflow of a tank, √x has no finite slope at x = 0" in EXPLORER.text
    EXPLORER.set(at=1.0)
    assert EXPLORER.text.startswith("Linearization. outflow of a tank, √x: value 1 and slope 0.5 at x = 1;")


def test_out_of_range_is_refused_and_reset_returns():
    EXPLORER.set(function="sine", at=1.0)
    with pytest.raises(ed.EngdynError, match="choose one of sine, cosine, spring, root"):
        EXPLORER.set(function="tangent")
    with pytest.raises(ed.EngdynError, match="deviation = 0 is out of range"):
        EXPLORER.set(deviation=0.0)
    EXPLORER.reset()
    assert EXPLORER.state == {"function": "sine", "at": 0.6, "deviation": 0.5}


@settings(max_examples=25)
@given(st.sampled_from(list(FUNCTIONS)), st.floats(0.0, 1.0), st.floats(0.02, 2.0))
def test_no_position_of_the_sliders_raises_or_blanks(name, share, deviation):
    f = FUNCTIONS[name]
    EXPLORER.set(function=name, at=min(f.high, f.low + share * (f.high - f.low)), deviation=deviation)
    assert "the tangent is off by" in EXPLORER.text or "no finite slope" in EXPLORER.text
    assert np.ptp(np.frombuffer(EXPLORER.figure.canvas.buffer_rgba(), np.uint8)) > 100
