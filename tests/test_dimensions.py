"""The units of every term: right equations agree, a wrong term is named."""

from __future__ import annotations

import pytest
import sympy as sm
from sympy.physics.vector import dynamicsymbols

import engdyn as ed
from engdyn.errors import EngdynError
from engdyn.units import si_factor

M, G, L, C, T = sm.symbols("m g L c T")
THETA = dynamicsymbols("theta")
RATE = THETA.diff()
UNITS = {M: "kg", G: "m/s^2", L: "m", C: "N m s/rad", T: "N m", THETA: "rad"}
RIGHT = M * L**2 * RATE.diff() + C * RATE + M * G * L * sm.sin(THETA) - T


@pytest.mark.parametrize("number", range(1, 24))
def test_both_derivations_of_every_system_agree(number):
    system = ed.systems.load(number)
    for eom in (system.newton(), system.lagrange()):
        check = ed.check_dimensions(eom, system)
        assert check
        assert len(check.terms) >= 2


@pytest.mark.parametrize(
    ("right", "wrong"),
    [
        (M * L**2 * RATE.diff(), M * L * RATE.diff()),
        (C * RATE, C * THETA),
        (M * G * L * sm.sin(THETA), M * G * sm.sin(THETA)),
        (T, T * L),
    ],
)
def test_the_wrong_term_is_named(right, wrong):
    equation = RIGHT.subs(right, wrong) if right != C * RATE else RIGHT - right + wrong
    check = ed.check_dimensions([RIGHT, sm.Eq(equation, 0)], UNITS)
    assert not check
    (term,) = check.wrong
    assert (term.equation, abs(term.expression / wrong)) == (2, 1)
    assert "does not go with the others" in repr(check)
    assert "does not go with the others" in check._repr_html_()


def test_a_fault_inside_a_term_is_told():
    check = ed.check_dimensions(RIGHT + M * L * G * sm.sin(L), UNITS)
    (term,) = check.wrong
    assert "argument of sin" in term.reason
    check = ed.check_dimensions(RIGHT + T * (L + M), UNITS)
    assert "are added" in check.wrong[0].reason


def test_two_terms_that_disagree_are_both_named():
    check = ed.check_dimensions(M * G - T, UNITS)
    assert [term.right for term in check.wrong] == [None, None]


def test_time_has_a_unit():
    omega = sm.Symbol("Omega")
    units = {**UNITS, omega: "rad/s"}
    assert ed.check_dimensions(RIGHT - T * sm.cos(omega * dynamicsymbols._t), units)
    assert not ed.check_dimensions(RIGHT - T * sm.cos(dynamicsymbols._t), units)


def test_a_symbol_without_a_unit_and_an_unknown_unit_are_refused():
    with pytest.raises(EngdynError, match="holds x without a unit"):
        ed.check_dimensions(RIGHT + sm.Symbol("x"), UNITS)
    with pytest.raises(EngdynError, match="furlong"):
        ed.check_dimensions(RIGHT, {**UNITS, T: "furlong"})


@pytest.mark.parametrize(
    ("unit", "factor"),
    [
        ("mm", 1e-3),
        ("N m", 1.0),
        ("-", 1.0),
        ("m/s^2", 1.0),
        ("degC", 1.0),
        ("furl", None),
        ("", None),
        ("m; exit()", None),
    ],
)
def test_how_many_si_units_a_unit_is(unit, factor):
    found = si_factor(unit)
    assert found is factor or found == pytest.approx(factor)
