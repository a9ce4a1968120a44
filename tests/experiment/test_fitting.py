"""Least squares against normal equations, numpy, scipy and the scatter of repeated measurements."""

from __future__ import annotations

import numpy as np
import pytest
import scipy.optimize

import engdyn as ed
from engdyn.errors import EngdynError, EngdynWarning

X, Y = np.array([0.0, 1.0, 3.0]), np.array([1.0, 3.0, 4.0])


def test_the_three_points_of_the_course():
    assert ed.fit(X, Y, "proportional").parameters == pytest.approx([1.5], rel=1e-14)
    line = ed.fit(X, Y)
    np.testing.assert_allclose(line.parameters, [10 / 7, 13 / 14], rtol=1e-13)
    np.testing.assert_allclose(line.residuals, Y - 10 / 7 - 13 / 14 * X, atol=1e-14)
    matrix = np.c_[X**0, X]
    np.testing.assert_allclose(matrix.T @ line.residuals, 0, atol=1e-13)
    spread = line.residuals @ line.residuals
    np.testing.assert_allclose(line.covariance, spread * np.linalg.inv(matrix.T @ matrix), rtol=1e-12)
    assert line.condition == pytest.approx(np.linalg.cond(matrix), rel=1e-12)
    assert line.standard_error == pytest.approx(np.sqrt(spread), rel=1e-12)
    assert line["c1"] == line.parameters[1]
    assert line(2.0) == pytest.approx(10 / 7 + 13 / 7)
    assert "c1 = 0.92857" in repr(line)
    assert "condition number" in line._repr_html_()


def test_polynomials_and_functions_of_ones_own():
    rng = np.random.default_rng(0)
    x = np.linspace(-1, 2, 40)
    y = rng.normal(size=40)
    np.testing.assert_allclose(
        ed.fit(x, y, 4).parameters, np.polynomial.polynomial.polyfit(x, y, 4), rtol=1e-10
    )
    named = ed.fit(
        x, 3 * np.cos(5 * x) - 2 * np.sin(5 * x), {"a": lambda x: np.cos(5 * x), "b": lambda x: np.sin(5 * x)}
    )
    np.testing.assert_allclose([named["a"], named["b"]], [3, -2], rtol=1e-12)
    assert ed.fit(x, y, [lambda x: 1.0]).parameters[0] == pytest.approx(y.mean())


def test_uncertainty_is_the_scatter_of_repeated_measurements():
    rng = np.random.default_rng(1)
    x = np.linspace(0, 1, 30)
    found = [ed.fit(x, 2 + 3 * x + 0.1 * rng.normal(size=30)) for _ in range(800)]
    scatter = np.std([f.parameters for f in found], axis=0)
    told = np.sqrt(np.mean([f.uncertainty**2 for f in found], axis=0))
    np.testing.assert_allclose(told, scatter, rtol=0.08)


def test_a_point_known_better_counts_more():
    sigma = np.array([1.0, 2.0, 0.5])
    weight = np.diag(1 / sigma**2)
    matrix = np.c_[X**0, X]
    expected = np.linalg.solve(matrix.T @ weight @ matrix, matrix.T @ weight @ Y)
    np.testing.assert_allclose(ed.fit(X, Y, sigma=sigma).parameters, expected, rtol=1e-12)


def test_nonlinear_fit_agrees_with_scipy():
    def decay(x, a, rate, omega):
        return a * np.exp(-rate * x) * np.cos(omega * x)

    rng = np.random.default_rng(2)
    x = np.linspace(0, 5, 200)
    y = decay(x, 2.0, 0.4, 6.0) + 0.05 * rng.normal(size=200)
    found = ed.fit(x, y, decay, start={"a": 1.5, "rate": 0.3, "omega": 5.9})
    expected, covariance = scipy.optimize.curve_fit(decay, x, y, p0=[1.5, 0.3, 5.9])
    np.testing.assert_allclose(found.parameters, expected, rtol=1e-6)
    np.testing.assert_allclose(found.covariance, covariance, rtol=1e-3, atol=1e-9)
    assert found.names == ("a", "rate", "omega")


def test_poor_conditioning_is_said_and_centering_helps():
    x = 1000 + np.linspace(0, 1, 20)
    with pytest.warns(EngdynWarning, match="center or scale"):
        poor = ed.fit(x, (x - 1000) ** 2, 2)
    good = ed.fit(x - 1000.5, (x - 1000) ** 2, 2)
    assert poor.condition > 1e8 > 100 > good.condition
    np.testing.assert_allclose(good.parameters, [0.25, 1, 1], rtol=1e-12)


def test_as_many_points_as_parameters_leave_no_judgment():
    exact = ed.fit([0, 1], [1, 3])
    np.testing.assert_allclose(exact.parameters, [1, 2], rtol=1e-13)
    assert np.all(np.isinf(exact.uncertainty))
    assert exact.standard_error == np.inf


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (([0.0], [1.0]), "1 points do not determine 2"),
        (([1.0, 1.0, 1.0], [1, 2, 3]), "apart"),
        (([0, 1], [1, 2, 3]), "shape"),
        (([0, np.nan, 2], [1, 2, 3]), "finite"),
        ((["a", "b"], [1, 2]), "real numbers"),
        (([0, 1, 2], [1, 2, 3], "parabola"), "model is"),
        (([0, 1, 2], [1, 2, 3], 99), "model is"),
        (([0, 1, 2], [1, 2, 3], [1, 2]), "model is"),
        (([0, 1, 2], [1, 2, 3], {"a": lambda x: 1 / x}), "not finite at one"),
        (([0, 1, 2], [1, 2, 3], lambda x, a: a * x), "start={'a'"),
        (([0, 1, 2], [1, 2, 3], lambda x, a: np.log(a) * x, {"a": -1.0}), "another start"),
        (([0, 1, 2], [1, 2, 3], lambda x, a, b: a * x, {"a": 1.0, "b": 1.0}), "b has no influence"),
    ],
)
@pytest.mark.filterwarnings("ignore:(divide|invalid):RuntimeWarning")
def test_what_cannot_be_fitted(arguments, message):
    with pytest.raises(EngdynError, match=message):
        ed.fit(*arguments)


def test_an_unknown_parameter_is_refused():
    with pytest.raises(EngdynError, match="c0, c1"):
        ed.fit(X, Y)["slope"]


def test_parameters_that_only_count_together_are_refused_by_a_search_too():
    x = np.linspace(0, 1, 50)
    with pytest.raises(EngdynError, match="apart"):
        ed.fit(x, 3 * x + 0.01 * np.cos(40 * x), lambda x, a, b: (a + b) * x, start={"a": 1, "b": 1})


def test_complex_points_and_a_start_without_names_are_refused():
    x = np.linspace(0, 1, 5)
    with pytest.raises(EngdynError, match="real"):
        ed.fit(x, x + 1j)
    with pytest.raises(EngdynError, match="start"):
        ed.fit(x, x, lambda x, a: a * x, start=[1])
