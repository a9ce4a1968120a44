"""Text with units becomes SI floats, and nothing else is let through."""

from __future__ import annotations

import math
import time
from decimal import Decimal
from fractions import Fraction

import numpy as np
import pytest
import sympy as sm

from engdyn.errors import EngdynError, ParameterError
from engdyn.units import to_si


@pytest.mark.parametrize(
    ("text", "unit", "expected"),
    [
        ("30 ft", "m", 30 * 0.3048),
        ("44 deg", "rad", math.radians(44)),
        ("44°", "rad", math.radians(44)),
        ("1.5", "rad", 1.5),
        ("0.3", "-", 0.3),
        ("9.5e-1", "m", 0.95),
        ("5 %", "-", 0.05),
        ("172 rpm", "rad/s", 172 * 2 * math.pi / 60),
        ("2 turn/s", "rad/s", 4 * math.pi),
        ("30 lbf", "N", 30 * 4.4482216152605),
        ("30 kgf", "N", 30 * 9.80665),
        ("30 lb", "kg", 30 * 0.45359237),
        ("1 inch", "m", 0.0254),
        ("2.5 kN/m", "N/m", 2500.0),
        ("3 kg*m**2", "kg m^2", 3.0),
        ("3 kg m²", "kg m^2", 3.0),
        ("3 N·m", "N m", 3.0),
        ("10 N m/deg", "N m/rad", 10 * 180 / math.pi),
        ("1e-3 m/s^2", "m/s^2", 1e-3),
        ("-2.5E+2 mm", "m", -0.25),
        ("  .5  km/h ", "m/s", 0.5 / 3.6),
        ("9 N s/m", "N s/m", 9.0),
        ("20 degC", "K", 293.15),
        ("3 1/s", "1/s", 3.0),
    ],
)
def test_text_with_a_unit(text, unit, expected):
    assert to_si(text, unit, "length") == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize(
    ("number", "expected"),
    [
        (3, 3.0),
        (np.float32(0.5), 0.5),
        (np.int64(4), 4.0),
        (Fraction(1, 4), 0.25),
        (Decimal("0.1"), 0.1),
        (sm.Rational(1, 3), 1 / 3),
        (-0.0, 0.0),
    ],
)
def test_numbers_are_taken_as_they_are(number, expected):
    found = to_si(number, "m", "length")
    assert type(found) is float
    assert found == expected


@pytest.mark.parametrize(
    ("value", "unit", "message"),
    [
        ("30 kg", "m", "measures something else"),
        ("30 lb", "N", "measures something else"),
        ("30 m m", "m", "measures something else"),
        ("30 furlongsx", "m", "'furlongsx' is not a unit"),
        ("rev/s", "rad/s", "not a number with a unit"),
        ("", "m", "not a number with a unit"),
        ("m", "m", "not a number with a unit"),
        ("three m", "m", "not a number with a unit"),
        ("1,5 m", "m", "not a number with a unit"),
        ("1_000 m", "m", "not a number with a unit"),
        ("0x10 m", "m", "not a number with a unit"),
        ("٣ m", "m", "not a number with a unit"),
        ("(1 + 2) m", "m", "not a number with a unit"),
        ("3 m + 2 ft", "m", "not a number with a unit"),
        ("nan m", "m", "not a number with a unit"),
        ("inf", "-", "not a number with a unit"),
        ("__import__('os')", "m", "not a number with a unit"),
        ("x" * 10**6, "m", "not a number with a unit"),
        ("1e999 m", "m", "finite"),
        ("50 Hz", "rad/s", "rpm or turn/s"),
        ("3 kHz", "rad/s", "is a frequency"),
        (math.nan, "m", "finite"),
        (-math.inf, "m", "finite"),
        (10**400, "m", "give a number in m"),
        (None, "m", "give a number in m"),
        (True, "m", "give a number in m"),
        (np.False_, "m", "give a number in m"),
        (1j, "m", "give a number in m"),
        ([1.0], "m", "give a number in m"),
        (sm.Symbol("x"), "m", "give a number in m"),
    ],
    ids=lambda v: str(v)[:20],
)
def test_what_is_refused_and_why(value, unit, message):
    with pytest.raises(ParameterError, match=message) as caught:
        to_si(value, unit, "length of the arm")
    assert str(caught.value).startswith("length of the arm")
    assert len(str(caught.value)) < 300
    assert isinstance(caught.value, EngdynError)


@pytest.mark.parametrize(
    "text",
    [
        "9**9**9**9 m",
        "1 m**9**9**9",
        "1 m^99999999",
        "1 " + "a" * 97 + "!",
        "1 " + "m**" * 32,
        "1e" + "9" * 90,
    ]
    + [" " * 99, "1 " + "a*" * 48 + "!", "((((((" * 16],
)
def test_no_text_keeps_us_busy(text):
    start = time.perf_counter()
    with pytest.raises(ParameterError):
        to_si(text, "m", "length")
    assert time.perf_counter() - start < 2.0


@pytest.mark.parametrize("text", ["60 rpm", "6.28 rad/s", "1 turn/s", "360 deg/s"])
def test_an_angular_rate_is_no_frequency(text):
    """60 rpm is 1 Hz; as a plain number of radians a second it would read 6.28."""
    with pytest.raises(ParameterError, match="angular rate"):
        to_si(text, "Hz", "f")
    assert to_si("1 kHz", "Hz", "f") == 1000.0
