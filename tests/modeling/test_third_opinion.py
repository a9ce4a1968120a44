"""Sympy's KanesMethod and LagrangesMethod on the same models: the same accelerations, both routes proved."""

from __future__ import annotations

import numpy as np
import pytest

import engdyn as ed
from modeling.third_opinion import MODELS, Sample, kane, lagranges_method

pytestmark = pytest.mark.filterwarnings("ignore:.*Velocity of:UserWarning")  # sympy, of points reached twice
STATES = 20


@pytest.fixture(scope="module", params=MODELS)
def case(request):
    model = MODELS[request.param]()
    newton, lagrange = model.newton(), model.lagrange()
    samples = [Sample(model, lagrange, seed) for seed in range(STATES)]
    return model, newton, lagrange, samples


def ours(eom, samples):
    found = []
    for s in samples:
        given = {name: s.inputs[name] for name in (w.func.__name__ for w in eom.inputs)}
        values = {p.name: s.values[p.name] for p in eom.parameters}
        found.append(eom.accelerations(s.q, s.u, values, given, s.time))
    return np.array(found)


def assert_same(found, expected):
    np.testing.assert_allclose(found, expected, rtol=1e-10, atol=1e-10 * np.max(np.abs(expected)))


def test_both_routes_are_proved_equal(case):
    _, newton, lagrange, samples = case
    assert ed.prove_equal(newton, lagrange).verdict == "proved"
    assert_same(ours(newton, samples), ours(lagrange, samples))


def test_kanes_method_agrees(case):
    model, newton, lagrange, samples = case
    assert_same(ours(newton, samples), kane(model, lagrange, samples))


def test_lagranges_method_agrees(case):
    model, _, lagrange, samples = case
    assert_same(ours(lagrange, samples), lagranges_method(model, lagrange, samples))
