"""W8, the rod on two springs, and W9, the chain of two masses: derivations, drawings, numbers of the course."""

from __future__ import annotations

import numpy as np
import pytest
import sympy as sm

import engdyn as ed


@pytest.fixture(scope="module", params=["W8", "W9"])
def system(request):
    return ed.systems.load(request.param)


def modes_of(key, **changes):
    system = ed.systems.load(key)
    (rest,) = system.equilibria(system.values(**changes))
    return ed.modes(ed.linearize(system.equations, rest))


def test_both_derivations_are_proved_equal(system):
    assert system.prove().verdict == "proved"
    assert system.equilibria()[0].q == pytest.approx(np.zeros(2), abs=1e-12)
    assert all(c.meaning and c.unit in ("m", "rad") for c in system.coordinates)
    names = {p.name for p in system.equations.parameters}
    assert names == {p.name for p in system.parameters}


@pytest.mark.parametrize("name", ["kinetic_energy", "potential_energy", "dissipation"])
def test_a_changed_term_is_refuted(system, name):
    whole = getattr(system, name)
    for term in sm.Add.make_args(whole):
        parts = {
            part: getattr(system, part) for part in ("kinetic_energy", "potential_energy", "dissipation")
        }
        parts[name] = whole + term
        coordinates = [c.symbol for c in system.coordinates]
        changed = ed.lagrange(
            parts["kinetic_energy"],
            parts["potential_energy"],
            coordinates,
            parts["dissipation"],
            system.generalized_forces,
        )
        assert ed.prove_equal(system.newton(), changed).verdict == "refuted"


def test_the_numbers_of_the_rod():
    """By hand: 20 ω⁴ · 20/3 … from M = diag(20, 20/3), K = [[20000, 800], [800, 9440]]."""
    found = modes_of("W8")
    squares = np.roots([20 * 20 / 3, -(20 * 9440 + 20000 * 20 / 3), 20000 * 9440 - 800**2])
    np.testing.assert_allclose(found.natural_frequency, np.sort(np.sqrt(squares)) / (2 * np.pi), rtol=1e-12)
    np.testing.assert_allclose(found.natural_frequency, [5.0046, 6.0127], atol=6e-5)
    np.testing.assert_allclose(found.nodes("y", "theta"), [3.560, -0.0936], atol=4e-4)


def test_the_numbers_of_the_chain():
    """The antiresonance of mass 1 is the frequency of mass 2 with mass 1 held: √(k₂/m₂)."""
    found = modes_of("W9")
    squares = np.roots([2 * 1, -(2 * 300 + 1 * 1100), 800 * 300])
    np.testing.assert_allclose(found.natural_frequency, np.sort(np.sqrt(squares)) / (2 * np.pi), rtol=1e-12)
    np.testing.assert_allclose(found.natural_frequency, [2.1280, 4.1234], atol=6e-5)
    held = modes_of("W9", k_1="1e12 N/m").natural_frequency[0]
    assert held == pytest.approx(2.7566, abs=6e-5)


def test_a_slow_motion_of_the_wall_carries_the_chain_along():
    system = ed.systems.load("W9")
    rest = system.equilibria(xb=0.03)[0]
    np.testing.assert_allclose(rest.q, [0.03, 0.03], rtol=1e-12)
    pushed = system.equilibria(F=8.0)[0]
    np.testing.assert_allclose(pushed.q, [8 / 800, 8 / 800], rtol=1e-12)


def test_the_rod_rests_on_its_springs_in_the_drawing():
    rod = ed.systems.load("W8")
    values, angle = rod.values(c_2=10.0), 0.2
    drawn = rod.shapes([0.05, angle], values)
    springs = [s for s in drawn if isinstance(s, ed.shapes.Spring)]
    dampers = [s for s in drawn if isinstance(s, ed.shapes.Damper)]
    assert len(springs) == len(dampers) == 2
    assert len([s for s in rod.shapes([0, 0]) if isinstance(s, ed.shapes.Damper)]) == 1, (
        "c_2 = 0 is not drawn"
    )
    for spring, place in zip(springs, (-0.8, 0.6), strict=True):
        assert spring.start[0] == spring.end[0], "springs act vertically"
        along = (spring.end[0] - 0.0175 * 2 * np.sin(angle)) / np.cos(angle)
        assert along == pytest.approx(place, abs=1e-12)
    (box,) = (s for s in drawn if isinstance(s, ed.shapes.Box))
    assert (box.size[0], box.angle) == (2.0, angle)
    assert box.center == pytest.approx((0.0, 0.65))
