"""Curves through measured points by least squares, with what they are worth.  Appendix D."""

from __future__ import annotations

import inspect
import warnings
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from html import escape
from typing import Any

import numpy as np
import scipy.optimize

from engdyn.errors import EngdynError, EngdynWarning

__all__ = ["Fit", "fit"]

POOR = 1e8
"""Condition number above which half of the digits are lost."""

Function = Callable[..., Any]


@dataclass(frozen=True, eq=False, repr=False)
class Fit:
    """A curve through points; ``fit(x)`` is its value.

    Attributes
    ----------
    names : tuple of str
        Of the parameters.
    parameters : ndarray, shape (p,)
    covariance : ndarray, shape (p, p)
        Of the parameters, infinite where the points leave no residual to judge by.
    residuals : ndarray, shape (N,)
        Points minus curve.
    condition : float
        Ratio of the largest to the smallest singular value of the matrix of least squares (of the derivatives by the
        parameters, for a nonlinear model).
    degrees_of_freedom : int
        Points less parameters.
    """

    names: tuple[str, ...]
    parameters: np.ndarray
    covariance: np.ndarray
    residuals: np.ndarray
    condition: float
    degrees_of_freedom: int
    curve: Callable[[Any, np.ndarray], np.ndarray]

    @property
    def uncertainty(self) -> np.ndarray:
        """Standard deviation of each parameter, shape (p,); twice as much covers about 95 %."""
        return np.sqrt(np.diag(self.covariance))

    @property
    def standard_error(self) -> float:
        """Standard deviation of the points about the curve; infinite without degrees of freedom."""
        if not self.degrees_of_freedom:
            return np.inf
        return float(np.sqrt(self.residuals @ self.residuals / self.degrees_of_freedom))

    def __getitem__(self, name: str) -> float:
        """A parameter by name."""
        if name not in self.names:
            raise EngdynError(f"there is no parameter {name!r}: choose one of {', '.join(self.names)}")
        return float(self.parameters[self.names.index(name)])

    def __call__(self, x: Any) -> np.ndarray:
        return self.curve(np.asarray(x, dtype=float), self.parameters)

    def __repr__(self) -> str:
        told = (
            f"{n} = {p:.5g} ± {u:.2g}"
            for n, p, u in zip(self.names, self.parameters, self.uncertainty, strict=True)
        )
        return f"Fit({'; '.join(told)}; residual {np.sqrt(np.mean(self.residuals**2)):.3g} rms)"

    def _repr_html_(self) -> str:
        rows = "".join(
            f"<tr><td>{escape(n)}</td><td>{p:.5g}</td><td>{u:.2g}</td></tr>"
            for n, p, u in zip(self.names, self.parameters, self.uncertainty, strict=True)
        )
        caption = (
            f"{len(self.residuals)} points, residual {np.sqrt(np.mean(self.residuals**2)):.3g} rms, condition number "
            f"{self.condition:.3g}"
        )
        head = "".join(f"<th>{h}</th>" for h in ("parameter", "value", "standard deviation"))
        return (
            f"<table><caption>{caption}</caption><thead><tr>{head}</tr></thead><tbody>{rows}</tbody></table>"
        )


def fit(
    x: Any,
    y: Any,
    model: int | str | Function | Sequence[Function] | Mapping[str, Function] = "line",
    start: Mapping[str, float] | None = None,
    sigma: Any = None,
) -> Fit:
    """Least squares: the parameters for which the sum of the squared residuals is smallest.

    Parameters
    ----------
    x, y : array_like, shape (N,)
        Points.
    model : "line", "proportional", int, functions, or function
        A straight line, one through the origin, a polynomial of this degree (c0 + c1 x + …); functions of x that are
        combined linearly, in a sequence or by name; or any function ``model(x, a, b, …)`` with the parameters of
        `start`.
    start : mapping of str to float, optional
        For a nonlinear function: its parameters, from where to search.
    sigma : array_like, shape (N,), optional
        Standard deviation of each point: residuals are divided by it. Equal where not given.

    Returns
    -------
    Fit

    Raises
    ------
    EngdynError
        Fewer points than parameters, parameters that the points do not tell apart, values that are not finite, a search
        that does not end.

    Warns
    -----
    EngdynWarning
        A condition number above 1e8: center or scale x.

    Notes
    -----
    Appendix D.  Linear models are solved by singular values of the matrix with columns of equal length, not by the
    normal equations, which would square the condition number; nonlinear ones by Levenberg and Marquardt (J. J. Moré,
    1978). The covariance is s² (AᵀA)⁻¹ with s² the sum of squares per degree of freedom, so that `sigma` need only be
    right up to a factor.

    Examples
    --------
    >>> fit([0, 1, 3], [1, 3, 4], "proportional").parameters
    array([1.5])
    >>> fit([0, 1, 3], [1, 3, 4], "line").parameters.round(6)
    array([1.428571, 0.928571])
    """
    x, y, weight = _checked(x, y, sigma)
    if callable(model):
        return _nonlinear(x, y, weight, model, start)
    basis = _basis(model)
    matrix = np.column_stack([np.broadcast_to(f(x), x.shape) for f in basis.values()]).astype(float)

    def curve(at: Any, parameters: np.ndarray) -> np.ndarray:
        return sum(
            p * np.broadcast_to(f(at), np.shape(at)) for p, f in zip(parameters, basis.values(), strict=True)
        )

    _enough(len(x), len(basis))
    if not np.all(np.isfinite(matrix)):
        raise EngdynError("a function of the model is not finite at one of the points")
    matrix = matrix * weight[:, None]
    lengths = np.linalg.norm(matrix, axis=0)
    lengths[lengths == 0] = 1.0
    left, singular, right = np.linalg.svd(matrix / lengths, full_matrices=False)
    _told_apart(singular, basis)
    parameters = right.T @ ((left.T @ (weight * y)) / singular) / lengths
    return _judged(tuple(basis), parameters, matrix, x, y, weight, curve)


def _checked(x: Any, y: Any, sigma: Any) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    try:
        x, y, sigma = (
            np.asarray(v).astype(float, casting="same_kind")
            for v in (x, y, np.ones(np.shape(y)) if sigma is None else sigma)
        )
    except (TypeError, ValueError) as error:
        raise EngdynError("x, y and sigma must be real numbers") from error
    if x.ndim != 1 or x.shape != y.shape or x.shape != sigma.shape:
        raise EngdynError(
            f"x has shape {x.shape}, y {y.shape}, sigma {sigma.shape}: give one value for each point"
        )
    if not all(np.all(np.isfinite(v)) for v in (x, y, sigma)) or not np.all(sigma > 0):
        raise EngdynError("x, y and sigma must be finite, sigma positive: leave such points out")
    return x, y, 1 / sigma


def _basis(model: Any) -> dict[str, Function]:
    if model == "line":
        model = 1
    if isinstance(model, int) and not isinstance(model, bool) and 0 <= model <= 50:
        return {f"c{k}": lambda x, k=k: x**k for k in range(model + 1)}
    if model == "proportional":
        return {"slope": lambda x: x}
    if isinstance(model, Mapping) or (isinstance(model, list | tuple) and model):
        named = dict(model) if isinstance(model, Mapping) else {f"c{i}": f for i, f in enumerate(model)}
        if named and all(callable(f) for f in named.values()):
            return named
    raise EngdynError(
        f'model is {model!r}: give "line", "proportional", a degree from 0 to 50, or functions of x'
    )


def _enough(points: int, parameters: int) -> None:
    if points < parameters:
        raise EngdynError(
            f"{points} points do not determine {parameters} parameters: measure more or fit fewer"
        )


def _told_apart(singular: np.ndarray, names: Any, limit: float = 1e-14) -> None:
    if singular[-1] <= limit * len(singular) * singular[0]:
        raise EngdynError(
            f"the points do not tell the parameters {', '.join(names)} apart: leave one out or spread the points"
        )


def _nonlinear(
    x: np.ndarray, y: np.ndarray, weight: np.ndarray, model: Function, start: Mapping[str, float] | None
) -> Fit:
    if not start:
        names = list(inspect.signature(model).parameters)[1:]
        raise EngdynError(
            f"a nonlinear fit needs start={{{', '.join(f'{n!r}: …' for n in names)}}}, a first guess"
        )
    try:
        names, first = tuple(start), np.array([*start.values()], dtype=float)
    except (AttributeError, TypeError, ValueError) as error:
        raise EngdynError(f"start is {start!r}: give a number for each name") from error
    _enough(len(x), len(names))

    def curve(at: Any, parameters: np.ndarray) -> np.ndarray:
        return np.broadcast_to(
            model(at, **dict(zip(names, map(float, parameters), strict=True))), np.shape(at)
        )

    if not np.all(np.isfinite(curve(x, first))):
        raise EngdynError("the model is not finite at the first guess: give another start")
    try:
        found = scipy.optimize.least_squares(
            lambda p: weight * (curve(x, p) - y), first, method="lm", x_scale="jac", xtol=1e-12, ftol=1e-12
        )
    except ValueError as error:
        raise EngdynError(
            f"the search left the region where the model is finite ({error}): start closer"
        ) from error
    if found.status <= 0 or not np.all(np.isfinite(found.x)):
        raise EngdynError("the search did not end: start closer, or scale the parameters to similar sizes")
    lengths = np.linalg.norm(found.jac, axis=0)
    if not np.all(lengths > 0):
        raise EngdynError(f"{names[int(np.argmin(lengths))]} has no influence at the points: leave it out")
    _told_apart(np.linalg.svd(found.jac / lengths, compute_uv=False), names, limit=1e-9)  # differences
    return _judged(names, found.x, found.jac, x, y, weight, curve)


def _judged(
    names: tuple[str, ...], parameters: np.ndarray, matrix: np.ndarray, x: np.ndarray, y: np.ndarray,
    weight: np.ndarray, curve: Function,
) -> Fit:  # fmt: skip
    singular = np.linalg.svd(matrix, compute_uv=False)
    condition = float(singular[0] / singular[-1]) if singular[-1] else np.inf
    if condition > POOR:
        warnings.warn(
            f"the condition number is {condition:.2g}: center or scale x, or choose functions that differ more",
            EngdynWarning,
            stacklevel=4,
        )
    residuals = y - curve(x, parameters)
    freedom = len(x) - len(parameters)
    lengths = np.linalg.norm(matrix, axis=0)
    _, singular, right = np.linalg.svd(matrix / lengths, full_matrices=False)
    inverse = (right.T / singular**2) @ right / np.outer(lengths, lengths)  # no variance below zero
    spread = float(np.sum((weight * residuals) ** 2)) / freedom if freedom else np.inf
    return Fit(names, parameters, inverse * spread, residuals, condition, freedom, curve)
