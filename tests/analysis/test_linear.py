"""Linearization: against finite differences of the nonlinear equations, closed forms and published tables."""

from __future__ import annotations

import numpy as np
import pytest
import sympy as sm
from hypothesis import given
from hypothesis import strategies as st

import engdyn as ed
from analysis import small_systems as small
from engdyn.analysis.linear import sorted_eigenvalues


def difference(function, x, step=1e-6):
    """Columns of central differences, extrapolated once."""
    x = np.array(x, dtype=float)
    columns = []
    for i in range(len(x)):
        h = step * max(1.0, abs(x[i]))
        e = np.eye(len(x))[i] * h
        near = (function(x + e) - function(x - e)) / (2 * h)
        far = (function(x + 2 * e) - function(x - 2 * e)) / (4 * h)
        columns.append((4 * near - far) / 3)
    return np.array(columns).T


def state_matrix_by_differences(eom, e):
    n = len(eom.coordinates)
    rhs = eom.function(e.values)
    return difference(lambda x: rhs(0.0, x, e.inputs), [*e.q, *e.speeds][: n + len(eom.speeds)], 1e-4)


def assert_close(actual, expected, tolerance):
    """Equal to a share of the largest entry of the row: entries of one row have one unit up to length."""
    scale = np.max(np.abs(expected), axis=-1, keepdims=True) + 1e-9
    np.testing.assert_allclose(actual / scale, expected / scale, atol=tolerance)


CASES = [
    small.pendulum(),
    small.hoop(),
    small.snap_through(),
    small.seismometer(),
    small.bar_on_slider(),
    small.elastic_pendulum(),
    small.isolator(),
    small.follower_mast(),
    small.carousel(),
    small.ship(),
    small.sprung_double_pendulum(),
]


def steady_states():
    """(label, equations, equilibrium) of equilibria and steady motions, parameters at random."""
    for k, case in enumerate(CASES):
        random = np.random.default_rng(k)
        values = {n: v * (1 + 0.2 * random.uniform(-1, 1)) for n, v in case.values.items()}
        for e in ed.equilibria(case.eom, values, case.bounds):
            yield f"{case.name} at {np.round(e.q, 3)}", case.eom, e
    for number, changes, inputs in [
        (3, {}, {}),
        (3, {"k": 350.0, "Omega": 21.0}, {"F": 12.0}),
        (7, {}, {"W": 900.0}),
        (7, {"c_x": 0.0}, {"F": 3700.0}),
        (23, {}, {"F_z": -400.0}),
        (23, {"k_f": 15000.0}, {"yf": (0.02, 0.0, 0.0)}),
    ]:
        system = ed.systems.load(number)
        for e in system.equilibria(system.values(**changes), **inputs):
            yield f"S{number:02d} {inputs} at {np.round(e.q, 3)}", system.equations, e
    turntable, drum, shafts, castor = (
        small.turntable(),
        small.drum_robot(),
        small.drive_train(),
        small.castor(),
    )
    for case, options in [
        (turntable, {"rates": {"theta": 12.0}, "free": ["M"]}),
        (drum, {"rates": {"x": 0.0}, "free": ["tau"]}),
        (shafts, {}),
        (castor, {}),
    ]:
        for e in ed.equilibria(case.eom, case.values, case.bounds, **options):
            yield f"{case.name} at {np.round(e.q, 3)}", case.eom, e


STATES = list(steady_states())


@pytest.mark.parametrize(("eom", "e"), [s[1:] for s in STATES], ids=[s[0] for s in STATES])
def test_state_matrix_against_finite_differences(eom, e):
    linear = ed.linearize(eom, e)
    expected = state_matrix_by_differences(eom, e)
    assert linear.state_matrix.shape == expected.shape
    assert_close(linear.state_matrix, expected, 2e-8)


@pytest.mark.parametrize(("eom", "e"), [s[1:] for s in STATES], ids=[s[0] for s in STATES])
def test_input_matrices_against_finite_differences(eom, e):
    linear = ed.linearize(eom, e)
    names = [w.func.__name__ for w in eom.inputs]
    assert linear.inputs == tuple(names)
    start = {n: (float(v), 0.0, 0.0) if np.isscalar(v) else tuple(v) for n, v in e.inputs.items()}
    known = {p: e.values[p.name] for p in eom.parameters} | {small.T: 0}
    drives = {
        w.func.__name__: [float(sm.sympify(p).xreplace(known)) for p in d] for w, d in eom.defaults.items()
    }
    for column, name in enumerate(names):
        here = np.array(start.get(name, drives.get(name, (0.0, 0.0, 0.0))))
        slopes = difference(
            lambda w, name=name: eom.accelerations(e.q, e.speeds, e.values, {**e.inputs, name: tuple(w)}),
            here,
            1e-3,
        )
        for k in range(3):
            force = linear.mass @ slopes[:, k]
            scale = 1 + np.max(np.abs(linear.mass)) * np.max(np.abs(slopes))
            np.testing.assert_allclose(linear.input_matrices[k][:, column], force, atol=1e-7 * scale)


@pytest.mark.parametrize(("eom", "e"), [s[1:] for s in STATES], ids=[s[0] for s in STATES])
def test_symbolic_equals_numeric(eom, e):
    """Parameters stay symbols, nothing depends on time, and numbers put in give the numeric matrices."""
    numeric, symbolic = ed.linearize(eom, e), ed.linearize(eom, e, symbolic=True)
    for name in ("mass", "damping", "stiffness", "state_matrix", *range(3)):
        a, b = (
            x.input_matrices[name] if isinstance(name, int) else getattr(x, name) for x in (numeric, symbolic)
        )
        assert not b.has(small.T, sm.Derivative, sm.Function("any"))
        assert not b.atoms(sm.core.function.AppliedUndef)
        values = {s: e.values[s.name] for s in b.free_symbols}
        evaluated = np.array(b.xreplace(values).evalf().tolist(), dtype=float).reshape(a.shape)
        scale = 1 + np.max(np.abs(a), initial=0.0)
        np.testing.assert_allclose(evaluated, a, atol=1e-11 * scale)


def test_symbolic_with_symbols_for_the_state():
    """The crane hanging at any angle: M and K of the textbook."""
    crane = ed.systems.load(7)
    angle = sm.Symbol("theta_0", real=True)
    linear = ed.linearize(crane.equations, {"theta": angle}, symbolic=True)
    M_t, m, L, J_G, _, _, g = (p.symbol for p in crane.parameters)
    mass = sm.Matrix([[M_t + m, m * L * sm.cos(angle)], [m * L * sm.cos(angle), m * L**2 + J_G]])
    assert (linear.mass - mass).applyfunc(sm.expand) == sm.zeros(2)
    stiffness = sm.Matrix([[0, 0], [0, m * g * L * sm.cos(angle)]])
    assert (linear.stiffness - stiffness).applyfunc(sm.expand) == sm.zeros(2)


def test_steady_motion_keeps_the_terms_that_naive_linearization_drops():
    """Constant acceleration: K contains ∂(M u̇)/∂q; without it the frequency would be that of g alone."""
    crane = ed.systems.load(7)
    values = crane.values(c_x=0, c_h=0, M_t=1e9)  # a trolley that nothing pushes back
    a = 4.0
    e = crane.equilibria(values, F=a * (1e9 + 2500.0))[0]
    linear = ed.linearize(crane.equations, e)
    frequency = np.max(ed.eigenvalues(linear).imag)
    apparent = np.hypot(9.81, a)  # gravity and acceleration add up
    expected = np.sqrt(2500.0 * apparent * 9.0 / (2500.0 * 81.0 + 3000.0))
    np.testing.assert_allclose(frequency, expected, rtol=1e-5)


@pytest.mark.parametrize(
    ("v", "expected"),
    [
        (2.0, [-4.588 + 61.67j, -4.588 - 61.67j, -19.96]),
        (20.0, [7.206 + 84.81j, 7.206 - 84.81j, -105.4]),
        (80.0, [-1.784 + 102j, -1.784 - 102j, -293.5]),
    ],
)
def test_castor_is_of_third_order(v, expected):
    case = small.castor()
    values = {**case.values, "v": v}
    linear = ed.linearize(case.eom, ed.equilibria(case.eom, values, case.bounds)[0])
    assert linear.state_matrix.shape == (3, 3)
    assert linear.mass.shape == (1, 1)
    assert linear.stiffness.shape == (1, 2)
    for found, known in zip(ed.eigenvalues(linear), expected, strict=True):
        assert abs(found - known) < 6e-4 * abs(known)


def test_castor_by_hand():
    """Third order from the momentum balance in the speed y' with ψ' = (y' − v ψ)/a, written out by hand."""
    case, v = small.castor(), 7.0
    p = {**case.values, "v": v, "k_p": 3.0}
    a, b = p["a"], p["b"]
    # y: (m_p + m) y'' − m b ψ'' + c_y y' + k_y y = λ;  ψ: (J + m b²) ψ'' − m b y'' + c_p ψ' + k_p ψ = −a λ
    # (times a) + second, with ψ'' = (y'' − v ψ')/a:
    inertia = (p["m_p"] + p["m"]) * a - p["m"] * b + ((p["J_G"] + p["m"] * b**2) - p["m"] * a * b) / a
    turning = (-p["m"] * a * b + p["J_G"] + p["m"] * b**2) * v / a  # multiplies −ψ'
    rate = np.array([0.0, -v / a, 1 / a])  # ψ' in terms of (y, ψ, y')
    row = -(np.array([p["k_y"] * a, p["k_p"], p["c_y"] * a]) + (p["c_p"] - turning) * rate) / inertia
    expected = np.array([[0.0, 0.0, 1.0], rate, row])
    linear = ed.linearize(case.eom, {}, p)
    np.testing.assert_allclose(linear.state_matrix, expected, rtol=1e-10)


CALIBRATION = [
    (3, 2, {}, [-1.327 + 9.563j, -1.327 - 9.563j]),
    (3, 1, {}, [13.17, -14.17]),
    (3, 0, {}, [-1.327 + 9.563j, -1.327 - 9.563j]),
    (7, 0, {}, [0, -0.1089, -0.1364 + 1.781j, -0.1364 - 1.781j]),
    (7, 1, {}, [1.667, 0, -0.1073, -1.942]),
    (7, 0, {"c_x": 0.0}, [0, 0, -0.02854 + 1.779j, -0.02854 - 1.779j]),
    (7, 1, {"c_x": 0.0}, [1.751, 0, 0, -1.808]),
    (
        23,
        0,
        {},
        [-1.247 + 6.431j, -1.247 - 6.431j, -2.182 + 6.933j, -2.182 - 6.933j]
        + [-16.53 + 67.26j, -16.53 - 67.26j, -22.6 + 68.14j, -22.6 - 68.14j],
    ),
]


@pytest.mark.parametrize(("number", "which", "changes", "expected"), CALIBRATION)
def test_published_eigenvalues(number, which, changes, expected):
    system = ed.systems.load(number)
    inputs = {"F": 3700.0} if changes else {}
    e = system.equilibria(system.values(**changes), **inputs)[which]
    found = ed.eigenvalues(ed.linearize(system.equations, e))
    np.testing.assert_allclose(found, expected, rtol=6e-4, atol=1e-8)


def test_worked_example():
    case = small.bar_on_slider()
    hanging, upright = ed.equilibria(case.eom, case.values, case.bounds)
    expected = [-0.1771 + 4.680j, -0.1771 - 4.680j, -1.048 + 13.87j, -1.048 - 13.87j]
    np.testing.assert_allclose(ed.eigenvalues(ed.linearize(case.eom, hanging)), expected, rtol=5e-4)
    assert abs(ed.eigenvalues(ed.linearize(case.eom, upright))[0] - 4.941) < 5e-4


def test_nothing_is_made_symmetric():
    """S11: the follower force makes K unsymmetric; the exact K by hand."""
    case = small.follower_mast()
    linear = ed.linearize(case.eom, {}, case.values)
    k, P, L = 20.0, 50.0, 0.5
    np.testing.assert_allclose(linear.stiffness, [[2 * k - P * L, P * L - k], [-k, k]], rtol=1e-14)
    np.testing.assert_allclose(linear.damping, [[0.2, -0.1], [-0.1, 0.1]], rtol=1e-14)
    np.testing.assert_allclose(linear.mass, [[0.75, 0.25], [0.25, 0.25]], rtol=1e-14)
    np.testing.assert_allclose(linear.input_matrices[0], [[0.5], [0.5]], rtol=1e-14)


def test_prescribed_motion_acts_through_value_rate_and_acceleration():
    """S04: only the ground's acceleration acts; S10: only its displacement and velocity."""
    case = small.seismometer()
    B = ed.linearize(case.eom, {}, case.values).input_matrices
    at = case.eom.inputs.index(sm.Function("xb")(small.T))
    assert B[0][0, at] == B[1][0, at] == 0.0
    np.testing.assert_allclose(B[2][0, at], case.values["m"] * case.values["l"], rtol=1e-14)
    case = small.isolator()
    B = ed.linearize(case.eom, {}, case.values).input_matrices
    at = case.eom.inputs.index(sm.Function("yb")(small.T))
    np.testing.assert_allclose([b[:, at] for b in B], [[6e5, 0.0], [3e3, 0.0], [0.0, 0.0]], rtol=1e-14)


@given(st.lists(st.complex_numbers(max_magnitude=1e3, allow_nan=False), min_size=1, max_size=6))
def test_order_of_eigenvalues(roots):
    """Falling real part; of a pair the one with positive imaginary part first."""
    pairs = [x for r in roots for x in ((r, r.conjugate()) if r.imag else (r,))]
    found = sorted_eigenvalues(np.array(pairs))
    scale = np.max(np.abs(found))
    assert sorted(map(str, found)) == sorted(map(str, np.array(pairs, dtype=complex)))
    assert np.all(np.diff(found.real) <= 2e-10 * scale)
    for x in (found := list(found)):
        if x.imag > 1e-6 * scale:
            assert found.index(x) < len(found) - found[::-1].index(x.conjugate()) - 1
