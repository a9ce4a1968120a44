"""W16, the bead on a wire: both derivations, the wire's force and the small oscillations by hand."""

from __future__ import annotations

import math

import numpy as np
import pytest
import sympy as sm

import engdyn as ed


@pytest.fixture(scope="module")
def bead():
    return ed.systems.load("W16")


def test_both_derivations_are_proved_equal(bead):
    assert bead.prove().verdict == "proved"
    assert not bead.unknowns[0].free_symbols & bead.newton().forcing.free_symbols


def test_the_force_of_the_wire_is_that_of_the_curvature(bead):
    """N = m (g cos α + v² κ), κ = 2p/(1 + 4p²x²)^(3/2): the normal balance in path coordinates."""
    values, place, rate = bead.values(), 0.45, -1.3
    m, p, g = (values[name] for name in ("m", "p", "g"))
    eom = bead.newton()
    (udot,) = eom.accelerations([place], [rate], values)
    x = bead.coordinates[0].symbol
    t = x.args[0]
    force = eom.reactions[bead.unknowns[0]]
    number = force.subs({x.diff(t, 2): udot}).subs({x.diff(t): rate}).subs({x: place})
    number = number.subs({q.symbol: values[q.name] for q in bead.parameters})
    root = math.sqrt(1 + (2 * p * place) ** 2)
    expected = m * (g / root + (rate * root) ** 2 * 2 * p / root**3)
    assert float(number) == pytest.approx(expected, rel=1e-12)


def test_the_force_is_finite_at_the_lowest_point(bead):
    x = bead.coordinates[0].symbol
    t = x.args[0]
    force = (
        bead.newton().reactions[bead.unknowns[0]].subs({x.diff(t, 2): 0}).subs({x.diff(t): 0}).subs({x: 0})
    )
    m, _, g = (q.symbol for q in bead.parameters)
    assert sm.expand(force - m * g) == 0


def test_small_oscillations_are_those_of_a_pendulum_of_length_1_over_2p(bead):
    (rest,) = bead.equilibria()
    assert rest.q[0] == pytest.approx(0, abs=1e-12)
    omega = math.sqrt(2 * 0.8 * 9.81)
    np.testing.assert_allclose(
        ed.eigenvalues(ed.linearize(bead.equations, rest)), [1j * omega, -1j * omega], rtol=1e-9
    )


def test_its_drawing_puts_the_bead_on_the_wire(bead):
    shapes = bead.shapes([0.3], bead.values())
    disc = next(s for s in shapes if type(s).__name__ == "Disc")
    assert disc.center == pytest.approx((0.3, 0.8 * 0.09))
