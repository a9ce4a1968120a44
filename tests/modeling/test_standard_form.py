"""M(q) q'' + h(q, q') = B u: what goes where, and the self-checks."""

from __future__ import annotations

import numpy as np
import pytest
import sympy as sm
from sympy.physics.mechanics import dynamicsymbols

import engdyn as ed

t = dynamicsymbols._t
x, y, theta, F, M_m, base = dynamicsymbols("x y theta F M_m base")
x_d, y_d, theta_d = (q.diff(t) for q in (x, y, theta))
m, k, c, l, g = sm.symbols("m k c l g", positive=True)
sin, cos = sm.sin, sm.cos


@pytest.mark.parametrize("key", ["S07", "W7", "W16", "S23"])
def test_the_parts_make_up_the_equations_again(key):
    system = ed.systems.load(key)
    eom = system.lagrange()
    form = ed.standard_form(eom)
    right = form.input_matrix * sm.Matrix(form.inputs) if form.inputs else sm.zeros(len(eom.speeds), 1)
    accelerations = sm.Matrix([u.diff(t) for u in eom.speeds])
    residuals = form.mass_matrix * accelerations + form.h - right
    own = ed.EquationsOfMotion.from_residuals(list(residuals), eom.coordinates)
    assert ed.prove_equal(own, eom)
    assert form.symmetric
    assert form.positive_definite
    assert not (form.h.atoms(*map(type, form.inputs)) & set(form.inputs) if form.inputs else set())


def test_w7_by_hand():
    bar = ed.systems.load("W7")
    form = ed.standard_form(bar.lagrange())
    p = {parameter.name: parameter.symbol for parameter in bar.parameters}
    s, angle = (coordinate.symbol for coordinate in bar.coordinates)
    coupling = p["m"] * p["l"] / 2 * cos(angle - p["gamma"])
    expected = sm.Matrix([[p["m"] + p["m_s"], coupling], [coupling, p["m"] * p["l"] ** 2 / 3]])
    assert sm.expand(sm.expand_trig(form.mass_matrix - expected)) == sm.zeros(2, 2)
    assert form.velocity_terms == form.h
    q, u = np.array([0.1, 0.7]), np.array([0.4, -1.2])
    values = bar.values()
    parameters = {p[name]: value for name, value in values.items()}
    mass = np.array(form.mass_matrix.subs(angle, q[1]).subs(parameters), dtype=float)
    state = {s.diff(t): u[0], angle.diff(t): u[1]}
    h = np.array(form.h.subs(state).subs({s: q[0], angle: q[1]}).subs(parameters), dtype=float)[:, 0]
    np.testing.assert_allclose(
        np.linalg.solve(mass, -h), bar.equations.accelerations(q, u, values), rtol=1e-12
    )


def test_inputs_that_are_not_linear_and_prescribed_motions_stay_in_h():
    T, V = m * (x_d + base.diff(t)) ** 2 / 2, k * x**2 / 2
    form = ed.standard_form(ed.lagrange(T, V, [x], 0, {x: F * cos(x) + M_m**2}))
    assert form.inputs == (F,)
    assert set(form.others) == {M_m, base}
    assert form.input_matrix == sm.Matrix([[cos(x)]])
    assert sm.expand(form.h[0] - (m * base.diff(t, 2) + k * x - M_m**2)) == 0
    product = ed.standard_form(ed.lagrange(m * x_d**2 / 2, 0, [x], 0, {x: F * M_m}))
    assert product.inputs == ()


def test_symmetry_is_decided_exactly():
    rows = [m * x.diff(t, 2) + k * x, m * x.diff(t, 2) + m * y.diff(t, 2)]
    skew = ed.standard_form(ed.EquationsOfMotion.from_residuals(rows, [x, y]))
    assert not skew.symmetric
    assert not skew.positive_definite
    assert "not symmetric" in skew.definiteness().method


def test_how_it_reads():
    form = ed.standard_form(ed.lagrange(m * x_d**2 / 2, k * x**2 / 2, [x], 0, {x: F}))
    assert repr(form) == "StandardForm(M 1 × 1; inputs: F)"
    assert r"\ddot{x}" in form._repr_latex_()
    with pytest.raises(ed.EngdynError, match="is not EquationsOfMotion"):
        ed.standard_form(m * x_d)
