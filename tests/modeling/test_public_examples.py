"""Sympy's own kind of examples through both routes: proved equal, and KanesMethod's accelerations to 1e-12."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest
import sympy as sm
from scipy.integrate import solve_ivp
from sympy.physics.mechanics import KanesMethod, dynamicsymbols

import engdyn as ed
from engdyn.algebra.balls import ball, midpoint
from engdyn.modeling.witness import working_precision
from modeling.public_examples import EXAMPLES, disc_in_its_own_rates
from modeling.third_opinion import Sample, kane

pytestmark = pytest.mark.filterwarnings("ignore:.*Velocity of:UserWarning")  # sympy, of points reached twice
STATES = 8


@pytest.fixture(scope="module", params=EXAMPLES)
def case(request):
    model = EXAMPLES[request.param]()
    newton, lagrange = model.newton(), model.lagrange()
    samples = [Sample(model, lagrange, seed) for seed in range(STATES)]
    for sample in samples:
        if getattr(model, "closure", None):
            sample.q = model.closure(sample.q, sample.values)
    return model, newton, lagrange, samples


def ours(eom: ed.EquationsOfMotion, samples: list[Sample]) -> np.ndarray:
    return np.array([eom.accelerations(s.q, s.u, s.values, s.inputs, s.time) for s in samples])


def test_both_routes_are_proved_equal(case):
    _, newton, lagrange, _ = case
    assert ed.prove_equal(newton, lagrange).verdict == "proved"


def exactly(eom: ed.EquationsOfMotion, samples: list[Sample]) -> np.ndarray:
    """The acceleration of a system of one degree of freedom, evaluated with 400 bits."""
    with working_precision(400):
        function = eom.compiled("balls")
        numbers = [[*s.q, *s.u, *(s.values[p.name] for p in eom.parameters), s.time] for s in samples]
        found = [function(*(ball(Fraction(float(x))) for x in row)) for row in numbers]
        return np.array([[midpoint(force / mass)] for mass, force, *_ in found])


def test_kanes_method_agrees_to_twelve_digits(case):
    model, newton, lagrange, samples = case
    expected = np.array(kane(model, lagrange, samples))
    size = np.max(np.abs(expected))
    if len(model.constraints) == 2 and len(lagrange.speeds) == 1 and len(newton.force[0].numerator) > 10_000:
        found = [
            exactly(lagrange, samples)
        ]  # the four-bar linkage: see the next test; Newton is proved equal
    else:
        found = [ours(eom, samples) for eom in (newton, lagrange)]
    for accelerations in found:
        np.testing.assert_allclose(accelerations, expected, rtol=1e-12, atol=1e-12 * size)


@pytest.mark.parametrize("route", ["newton", "lagrange"])
def test_the_four_bar_linkage_in_double_precision(route):
    """Its projected equations have thousands of terms that would cancel: numbers come from before."""
    model = EXAMPLES["four-bar linkage"]()
    eom, reference = getattr(model, route)(), model.lagrange()
    samples = [Sample(model, eom, seed) for seed in range(STATES)]
    for sample in samples:
        sample.q = model.closure(sample.q, sample.values)
    np.testing.assert_allclose(ours(eom, samples), exactly(reference, samples), rtol=1e-12)


def test_closed_loops_stay_closed():
    """A quarter turn of the slider-crank from a consistent state: the loop equations hold along the motion."""
    model = EXAMPLES["slider-crank"]()
    eom = model.newton()
    sample = Sample(model, eom, 3)
    values, q = sample.values, model.closure([0.3, 0.0, 0.0], sample.values)
    found = solve_ivp(
        lambda t, x: eom.function(values)(t, x, {}), (0, 0.6), [*q, 2.0], rtol=1e-11, atol=1e-12
    )
    theta, phi, x = found.y[:3]
    assert np.ptp(theta) > 0.3
    r, l = values["r"], values["l"]
    np.testing.assert_allclose(r * np.sin(theta), l * np.sin(phi), atol=1e-9)
    np.testing.assert_allclose(r * np.cos(theta) + l * np.cos(phi), x, atol=1e-9)


#: Independent rates by the numbers of their coordinates.  Each choice leaves out states where it fails.
CHOICES = {
    "slider-crank": [(0,), (1,)],
    "rolling disc": [(0, 1, 2), (0, 1, 3), (0, 1, 4)],
    "knife edge": [(0, 2), (1, 2)],
}


@pytest.mark.parametrize("name", CHOICES)
def test_any_choice_of_independent_speeds_is_the_same_motion(name):
    model = EXAMPLES[name]()
    rates = [q.diff(dynamicsymbols._t) for q in model.coordinates]
    given = model.bodies, model.coordinates, model.frame, model.unknowns
    reference = model.lagrange()
    for chosen in CHOICES[name]:
        speeds = [rates[i] for i in chosen]
        other = ed.newton_euler(*given, constraints=model.constraints, speeds=speeds)
        proof = ed.prove_equal(other, reference)
        assert proof.verdict == "proved", (speeds, proof)
        assert ("of the first set written in" in proof.method) == (set(speeds) != set(reference.speeds))


def test_rolling_disc_in_its_own_rates():
    """u1, u2, u3 = components of the angular velocity: KanesMethod in the same speeds, and the rates of the angles."""
    eom, kane_model = disc_in_its_own_rates(own=True)
    method = KanesMethod(
        kane_model["frame"], kane_model["q"], kane_model["u"], kd_eqs=kane_model["kinematic"]
    )
    method.kanes_equations([kane_model["body"]], kane_model["loads"])
    parameters = list(eom.parameters)
    arguments = [*kane_model["q"], *kane_model["u"], *parameters]
    functions = [sm.lambdify(arguments, m, cse=True) for m in (method.mass_matrix, method.forcing)]
    source = np.random.default_rng(5)
    for _ in range(STATES):
        q, u = source.uniform(-1, 1, 3), source.uniform(-2, 2, 3)
        values = dict(zip((p.name for p in parameters), source.uniform(0.5, 2, len(parameters)), strict=True))
        M, f = (np.array(fn(*q, *u, *values.values()), dtype=float) for fn in functions)
        expected = np.linalg.solve(M, f).ravel()
        np.testing.assert_allclose(
            eom.accelerations(q, u, values), expected, rtol=1e-12, atol=1e-12 * np.max(np.abs(expected))
        )
    angles, _ = disc_in_its_own_rates(own=False)
    for pair in ((eom, angles), (angles, eom)):
        proof = ed.prove_equal(*pair)
        assert proof.verdict == "proved"
        assert "cos(theta) is not zero" in proof.method
