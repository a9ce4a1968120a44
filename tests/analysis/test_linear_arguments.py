"""What `linearize` takes, shows and refuses; time in the coefficients."""

from __future__ import annotations

from math import pi

import numpy as np
import pytest
import sympy as sm

import engdyn as ed
from analysis import small_systems as small
from engdyn.analysis.linear import sorted_eigenvalues


def test_a_mapping_is_a_state_of_rest_and_an_equilibrium_carries_its_values():
    system = ed.systems.load(7)
    e = system.equilibria()[0]
    a, b = ed.linearize(system.equations, e), ed.linearize(system.equations, {"theta": 0.0}, system.values())
    np.testing.assert_array_equal(a.state_matrix, b.state_matrix)
    changed = ed.linearize(system.equations, e, system.values(L=4.0))
    np.testing.assert_allclose(changed.stiffness[1, 1], 2500.0 * 9.81 * 4.0)
    assert b.at.values == system.values()
    assert a.coordinates == ("x", "theta")
    assert a.inputs == ("F", "W")


def test_representations():
    system = ed.systems.load(7)
    linear = ed.linearize(system.equations, system.equilibria()[0])
    assert repr(linear).startswith("LinearSystem(x, theta; about Equilibrium(x = 0, theta = 0)")
    latex = linear._repr_latex_()
    assert latex.startswith("$")
    assert "3700.0" in latex
    assert "2.0550e" not in latex


@pytest.mark.parametrize(
    ("at", "more", "message"),
    [
        ({"thta": 0.0}, {}, r"\['thta'\]: the coordinates are x, theta"),
        (1.0, {}, "give an Equilibrium, or a mapping"),
        ({"theta": sm.Symbol("a")}, {}, "symbolic=True"),
        ({"theta": "upright"}, {}, "give numbers|give a number"),
        ({"theta": "0"}, {"symbolic": True}, "is not a quantity"),
        ({"theta": float("nan")}, {}, "finite"),
        ({}, {"values": {"L": 1.0}}, "lacks the parameters"),
        ({}, {"inputs": {"G": 1.0}}, "unknown input 'G'"),
        ({}, {"inputs": {"G": 1.0}, "symbolic": True}, "unknown input 'G'"),
    ],
)
def test_bad_arguments_are_refused(at, more, message):
    system = ed.systems.load(7)
    with pytest.raises(ed.EngdynError, match=message):
        ed.linearize(system.equations, at, **{"values": system.values(), **more})


def test_values_are_asked_for_and_other_models_refused():
    system = ed.systems.load(7)
    with pytest.raises(ed.EngdynError, match="a mapping of coordinates carries no parameters"):
        ed.linearize(system.equations, {})
    with pytest.raises(ed.EngdynError, match="give EquationsOfMotion"):
        ed.linearize(system, {}, system.values())
    symbolic = ed.linearize(system.equations, {}, symbolic=True)
    with pytest.raises(ed.EngdynError, match="with numbers"):
        ed.eigenvalues(symbolic)


def test_a_state_without_a_derivative_is_refused():
    (x,) = small.coordinates("x")
    eom = ed.lagrange(x.diff() ** 2 / 2, sm.Rational(2, 3) * x ** sm.Rational(3, 2), [x])
    with pytest.raises(ed.EngdynError, match="not finite"):
        ed.linearize(eom, {"x": 0.0}, {})


def test_a_singular_mass_matrix_is_refused():
    case = small.carousel()
    with pytest.raises(ed.EngdynError, match="mass"):
        ed.linearize(case.eom, {"alpha": 0.0}, {**case.values, "m": 0.0})


def test_time_in_the_coefficients_is_refused_symbolically():
    (x,) = small.coordinates("x")
    k, w = small.symbols("k w")
    eom = ed.lagrange(x.diff() ** 2 / 2, k * sm.cos(w * small.T) * x**2 / 2, [x])
    with pytest.raises(ed.EngdynError, match="depend on time"):
        ed.linearize(eom, {}, symbolic=True)
    with pytest.raises(ed.EngdynError, match="depend on time"):
        ed.linearize(eom, {}, {"k": 1.0, "w": 2.0})


def test_upright_pendulum_in_closed_form():
    case = small.pendulum()
    m, l, g, c = (case.values[n] for n in "mlgc")
    for angle, sign in ((0.0, 1), (pi, -1)):
        linear = ed.linearize(case.eom, {"theta": angle}, case.values)
        roots = np.roots([m * l**2, c, sign * m * g * l])
        np.testing.assert_allclose(ed.eigenvalues(linear), sorted_eigenvalues(roots), rtol=1e-12)


def test_a_force_in_a_fixed_direction_seen_from_turning_coordinates():
    """S14: the state matrix is constant, the input matrices turn; they are given at t = 0 and named."""
    xi, eta = small.coordinates("xi eta")
    m, k, epsilon, c_e, c_i, Omega = small.symbols("m k epsilon c_e c_i Omega")
    F_x = sm.Function("F_x")(small.T)
    v = (xi.diff() - Omega * eta, eta.diff() + Omega * (xi + epsilon))
    damping = c_e * ((xi.diff() - Omega * eta) ** 2 + (eta.diff() + Omega * xi) ** 2) / 2
    damping += c_i * (xi.diff() ** 2 + eta.diff() ** 2) / 2
    forces = {xi: F_x * sm.cos(Omega * small.T), eta: -F_x * sm.sin(Omega * small.T)}
    energies = m * (v[0] ** 2 + v[1] ** 2) / 2, k * (xi**2 + eta**2) / 2
    eom = ed.lagrange(*energies, [xi, eta], damping, forces)
    values = {"m": 12.0, "k": 1.2e6, "epsilon": 5e-5, "c_e": 240.0, "c_i": 160.0, "Omega": 450.0}
    (e,) = ed.equilibria(eom, values, {"xi": (-1e-3, 1e-3), "eta": (-1e-3, 1e-3)})
    np.testing.assert_allclose(e.q, [-9.8025e-05, -8.6071e-06], rtol=1e-4)
    linear = ed.linearize(eom, e)
    assert linear.changing_inputs == ("F_x",)
    np.testing.assert_allclose(linear.input_matrices[0], [[1.0], [0.0]])
    expected = [-7.171 + 134.1j, -7.171 - 134.1j, -26.16 + 765.9j, -26.16 - 765.9j]
    np.testing.assert_allclose(ed.eigenvalues(linear), expected, rtol=5e-4)
    symbolic = ed.linearize(eom, e, symbolic=True)
    assert symbolic.changing_inputs == ("F_x",)
    assert not symbolic.state_matrix.has(small.T)


def test_an_equilibrium_of_another_system_is_refused():
    with pytest.raises(ed.EngdynError, match="at has the coordinates theta, the equations x, theta"):
        ed.linearize(ed.systems.load(7).equations, ed.systems.load(3).equilibria()[0])


@pytest.mark.parametrize("symbolic", [False, True])
@pytest.mark.parametrize("value", [float("nan"), float("inf")])
def test_a_place_that_is_no_number_is_refused(symbolic, value):
    """Also where nothing depends on that coordinate: the residual would be NaN."""
    bar = ed.systems.load("W7")
    with pytest.raises(ed.EngdynError, match="finite number"):
        ed.linearize(bar.equations, {"s": value}, bar.values(), symbolic=symbolic)


@pytest.mark.parametrize("outputs", [0, np.ones(3), ["s"]])
def test_outputs_have_names(outputs):
    bar = ed.systems.load("W7")
    with pytest.raises(ed.EngdynError, match=r"outputs is .* give a mapping"):
        ed.linearize(bar.equations, {}, bar.values(), outputs=outputs)
