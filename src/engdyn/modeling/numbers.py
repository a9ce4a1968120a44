"""Numbers for equations of motion: parameters, inputs and states become accelerations."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
import sympy as sm
from sympy.physics.vector import dynamicsymbols

from engdyn.algebra.codegen import compile_elements
from engdyn.algebra.conversion import Converter
from engdyn.algebra.expressions import as_expression
from engdyn.errors import EngdynError
from engdyn.modeling.derivative import derivative_of

if TYPE_CHECKING:
    from engdyn.modeling.equations import EquationsOfMotion

__all__ = [
    "accelerations",
    "given_inputs",
    "input_values",
    "mass_and_force",
    "parameter_values",
    "state_derivative",
]


def parameter_values(eom: EquationsOfMotion, values: Mapping[str, float]) -> list[float]:
    """Values of the parameters in the order of ``eom.parameters``; every one must be given and finite."""
    if not isinstance(values, Mapping):
        raise EngdynError(f"values must map parameter names to numbers, not be a {type(values).__name__}")
    missing = [p.name for p in eom.parameters if p.name not in values]
    if missing:
        raise EngdynError(f"values lacks the parameters {', '.join(missing)}: give each a number in SI units")
    return [_finite(values[p.name], f"parameter {p.name}") for p in eom.parameters]


def _finite(value: Any, what: str) -> float:
    try:
        number = float(value)
    except (TypeError, ValueError) as error:
        raise EngdynError(f"{what} is {value!r}: give a number in SI units") from error
    if not math.isfinite(number):
        raise EngdynError(f"{what} is {number}: give a finite number")
    return number


def input_values(
    eom: EquationsOfMotion, inputs: Mapping[str, Any] | None, values: Mapping[str, float], t: float = 0.0
) -> list[float]:
    """Value, rate and acceleration of every input, in the order of the compiled arguments.

    What is not given takes its default (a drive angle Omega*t, say) or is zero.
    """
    given, known = given_inputs(eom, inputs)
    found: list[float] = []
    for name, function in known.items():
        if name in given:
            found += _input_triple(name, given[name])
        elif function in eom.defaults:
            symbols, compiled = _default(eom, function)
            found += compiled(*(float(values[x.name]) for x in symbols), t)
        else:
            found += [0.0, 0.0, 0.0]
    return found


def given_inputs(
    eom: EquationsOfMotion, inputs: Mapping[str, Any] | None
) -> tuple[dict[str, Any], dict[str, sm.Expr]]:
    """What is given, after a check of its names; and the inputs of the equations by name."""
    if inputs is not None and not isinstance(inputs, Mapping):
        raise EngdynError(f"inputs must map input names to numbers, not be a {type(inputs).__name__}")
    given = dict(inputs or {})
    known = {w.func.__name__: w for w in eom.inputs}
    for name in given:
        if name not in known:
            raise EngdynError(
                f"unknown input {name!r}: the equations have {', '.join(sorted(known)) or 'none'}"
            )
    return given, known


def _input_triple(name: str, value: Any) -> list[float]:
    if isinstance(value, int | float | np.number) or getattr(value, "ndim", None) == 0:
        return [_finite(value, f"input {name}"), 0.0, 0.0]
    if not isinstance(value, Sequence | np.ndarray) or isinstance(value, str | bytes):
        raise EngdynError(f"input {name} is {value!r}: give a number or (value, rate, acceleration)")
    parts = list(value)
    if len(parts) != 3:
        raise EngdynError(
            f"input {name} has {len(parts)} entries: give a number or (value, rate, acceleration)"
        )
    return [_finite(part, f"input {name}") for part in parts]


def _default(eom: EquationsOfMotion, function: sm.Expr) -> tuple[list[sm.Symbol], Callable[..., tuple]]:
    """Value, rate and acceleration that hold where an input is not given, compiled once."""
    cache = eom.__dict__.setdefault("_defaults", {})
    if function not in cache:
        parts = [as_expression(part, "the default of an input") for part in eom.defaults[function]]
        t = dynamicsymbols._t
        symbols = sorted({s for part in parts for s in part.free_symbols} - {t}, key=lambda s: s.name)
        keys = [("symbol", s) for s in (*symbols, t)]
        converter = Converter(parts, keys)
        cache[function] = symbols, compile_elements([converter.convert(part) for part in parts], keys)
    return cache[function]


def accelerations(
    eom: EquationsOfMotion,
    q: Any,
    u: Any,
    values: Mapping[str, float],
    inputs: Mapping[str, Any] | None,
    t: float,
) -> np.ndarray:
    """Implementation of :meth:`EquationsOfMotion.accelerations`."""
    q, u, shape = _states(eom, q, u)
    n, m = len(eom.coordinates), len(eom.speeds)
    t = _finite(t, "the time t")
    rest = [*parameter_values(eom, values), *input_values(eom, inputs, values, t), t]
    columns = [q[..., i] for i in range(n)] + [u[..., i] for i in range(m)]
    with np.errstate(all="ignore"):  # what is not finite is an error below
        flat = eom.compiled("numpy")(*columns, *rest)[: m * m + m]
    stacked = np.stack([np.broadcast_to(np.asarray(x, dtype=float), shape) for x in flat], axis=-1)
    mass, force = stacked[..., : m * m].reshape(*shape, m, m), stacked[..., m * m :]
    if not np.all(np.isfinite(stacked)):
        raise EngdynError(
            "the equations of motion are not finite at this state: a root or a quotient has no value there"
        )
    try:
        found = np.linalg.solve(mass, force[..., None])[..., 0]
    except np.linalg.LinAlgError:
        found = np.full_like(force, np.nan)
    if not np.all(np.isfinite(found)) or np.any(np.linalg.cond(_equilibrated(mass)) > 1e14):
        raise EngdynError(
            "singular mass matrix at this state: some combination of coordinates has no inertia there (a "
            "coordinate singularity, or a mass of zero); choose another state, other coordinates or masses"
        )
    return found


def _equilibrated(matrices: np.ndarray) -> np.ndarray:
    """Matrices with rows and columns scaled to 1: tons beside grams are not singular."""
    for axis in (-1, -2):
        largest = np.max(np.abs(matrices), axis=axis, keepdims=True)
        matrices = matrices / np.where(largest > 0, largest, 1.0)
    return matrices


def mass_and_force(
    eom: EquationsOfMotion, q: Any, u: Any, values: Mapping[str, float], inputs: Mapping[str, Any] | None
) -> tuple[np.ndarray, np.ndarray]:
    """M, shape (m, m), and f, shape (m,), at one state."""
    m = len(eom.speeds)
    rest = [*parameter_values(eom, values), *input_values(eom, inputs, values), 0.0]
    flat = eom.compiled("math")(*(float(x) for x in (*q, *u)), *rest)
    return np.array(flat[: m * m], dtype=float).reshape(m, m), np.array(flat[m * m : m * m + m], dtype=float)


def _states(eom: EquationsOfMotion, q: Any, u: Any) -> tuple[np.ndarray, np.ndarray, tuple[int, ...]]:
    """q and u as arrays, and the shape in which their states are stacked."""
    try:
        q, u = np.asarray(q, dtype=float), np.asarray(u, dtype=float)
    except (TypeError, ValueError) as error:
        raise EngdynError(f"q and u must be arrays of numbers, given {q!r} and {u!r}") from error
    for name, array, size in (("q", q, len(eom.coordinates)), ("u", u, len(eom.speeds))):
        if array.ndim == 0 or array.shape[-1] != size:
            raise EngdynError(f"{name} has shape {array.shape}: its last axis must hold {size} values")
        if not np.all(np.isfinite(array)):
            raise EngdynError(f"{name} contains values that are not finite")
    try:
        return q, u, np.broadcast_shapes(q.shape[:-1], u.shape[:-1])
    except ValueError as error:
        raise EngdynError(
            f"q with shape {q.shape} and u with shape {u.shape} do not go together: stack equally many states"
        ) from error


def state_derivative(eom: EquationsOfMotion, values: Mapping[str, float]) -> Callable[..., np.ndarray]:
    """Implementation of :meth:`EquationsOfMotion.function`."""
    size = len(eom.coordinates) + len(eom.speeds)
    parameters = parameter_values(eom, values)
    p = [*parameters, *input_values(eom, None, values)]
    function, known = derivative_of(eom).python(p), len(parameters)
    fixed, as_given = not eom.defaults, True

    def derivative(t: float, x: np.ndarray, inputs: Mapping[str, Any] | None = None) -> np.ndarray:
        nonlocal as_given
        if not (fixed and inputs is None and as_given):
            p[known:], as_given = input_values(eom, inputs, values, t), inputs is None
        x = np.asarray(x, dtype=float)
        if x.shape != (size,):
            raise EngdynError(
                f"the state x holds {x.size} values: it must hold {len(eom.coordinates)} coordinates and "
                f"{len(eom.speeds)} speeds"
            )
        found = function(float(t), x)
        if not math.isfinite(sum(found.tolist())) and not np.isfinite(found).all():
            raise EngdynError(f"{_trouble(eom, x, [*p, float(t)])} {_at(t, x)}")
        return found

    return derivative


def _trouble(eom: EquationsOfMotion, x: np.ndarray, rest: list[float]) -> str:
    """Why a state has no derivative."""
    m = len(eom.speeds)
    try:
        mass = np.array(eom.compiled("math")(*x.tolist(), *rest)[: m * m], dtype=float).reshape(m, m)
        np.linalg.solve(mass, np.zeros(m))
    except np.linalg.LinAlgError:
        return "singular mass matrix"
    except (ArithmeticError, TypeError, ValueError):
        pass
    return "the equations of motion have no finite value"


def _at(t: float, x: Any) -> str:
    return f"at t = {t:.5g} s, x = {np.asarray(x).tolist()}"
