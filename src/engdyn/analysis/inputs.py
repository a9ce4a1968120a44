"""What acts on a system over time: numbers, expressions, functions, arrays and records become one plan.

A plan says what a right-hand side has to know (:mod:`engdyn.modeling.derivative`) and at which times no step may
go across: at the samples of an array, where an input jumps, and around pulses after a rest.  Course section 8.7.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import sympy as sm
from scipy.interpolate import PPoly, make_interp_spline
from sympy.core.function import AppliedUndef
from sympy.physics.vector import dynamicsymbols

from engdyn.algebra.codegen import compile_trees
from engdyn.algebra.expressions import as_expression
from engdyn.algebra.plain import plain_tree
from engdyn.analysis.jumps import breaks
from engdyn.errors import EngdynError
from engdyn.modeling.derivative import Derivative, derivative_of
from engdyn.modeling.equations import EquationsOfMotion
from engdyn.modeling.numbers import given_inputs, parameter_values
from engdyn.record import Record
from engdyn.units import si_factor

__all__ = ["Plan", "plan_inputs"]

Key = tuple[Any, ...]

#: Degrees of the polynomials between the samples: a force between its values, a motion with a smooth acceleration.
FORCE, MOTION = 1, 5


@dataclass(eq=False)
class Plan:
    """Inputs sorted by kind, and the segments of time on which all are smooth.

    Attributes
    ----------
    eom : EquationsOfMotion
    symbols : tuple of sympy.Symbol
        Parameters of the equations and of the formulas.
    numbers : list of float
        Values of the symbols and constant inputs, as the derivative's p begins.
    formulas : dict of key to sympy.Expr
    functions : dict of key to callable of t
    sampled : dict of input to PPoly
    starts, ends : ndarray
        Segments of time.
    """

    eom: EquationsOfMotion
    symbols: tuple[sm.Symbol, ...]
    numbers: list[float]
    formulas: dict[Key, sm.Expr] = field(default_factory=dict)
    functions: dict[Key, Callable[[float], float]] = field(default_factory=dict)
    sampled: dict[sm.Expr, PPoly] = field(default_factory=dict)
    starts: np.ndarray = field(default_factory=lambda: np.empty(0))
    ends: np.ndarray = field(default_factory=lambda: np.empty(0))

    @property
    def derivative(self) -> Derivative:
        """The right-hand side for this kind of inputs."""
        degrees = {w: curve.c.shape[0] - 1 for w, curve in self.sampled.items()}
        return derivative_of(self.eom, self.symbols, self.formulas, degrees)

    def pieces(self) -> np.ndarray:
        """Time and coefficients of every sampled input on every segment, shape (segments, …)."""
        columns = []
        for curve in self.sampled.values():
            i = np.clip(np.searchsorted(curve.x, self.starts, "right") - 1, 0, len(curve.x) - 2)
            columns.append(np.column_stack([curve.x[i], curve.c[:, i].T]))
        return np.ascontiguousarray(np.hstack([np.empty((len(self.starts), 0)), *columns]))

    def at(self, times: np.ndarray) -> dict[Key, np.ndarray]:
        """Value, rate and acceleration of every input at the given times."""
        keys = [("symbol", s) for s in self.symbols] + [("symbol", dynamicsymbols._t)]
        found: dict[Key, np.ndarray] = {}
        for key, index in self.derivative.slots.items():
            if key in self.functions:
                found[key] = np.array([float(self.functions[key](t)) for t in times.tolist()])
            elif key in self.formulas:
                formula = compile_trees([plain_tree(self.formulas[key])], keys, "numpy")
                found[key] = formula(*self.numbers[: len(self.symbols)], times)[0]
            elif key[1] in self.sampled:
                found[key] = self.sampled[key[1]](times, nu=key[2])
            else:
                found[key] = np.asarray(self.numbers[index])
        return {key: np.broadcast_to(values, times.shape) for key, values in found.items()}


def plan_inputs(
    eom: EquationsOfMotion,
    inputs: Mapping[str, Any] | None,
    values: Mapping[str, float],
    times: np.ndarray,
    max_step: float,
) -> Plan:
    """Sort inputs by their kind and find the segments of time on which all of them are smooth."""
    given, known = given_inputs(eom, inputs)
    needed: dict[sm.Expr, int] = dict.fromkeys(eom.inputs, 0)
    for key in eom.occurring:
        if key[0] == "function" and key[1] in needed:
            needed[key[1]] = max(needed[key[1]], key[2])
    triples = {
        w: _triple(name, given.get(name, eom.defaults.get(w, 0)), needed[w], times)
        for name, w in known.items()
    }
    expressions = [e for parts in triples.values() for e in np.ravel(parts) if isinstance(e, sm.Expr)]
    symbols = _symbols(eom, expressions, values)
    numbers = [
        *parameter_values(eom, values),
        *(float(values[s.name]) for s in symbols[len(eom.parameters) :]),
    ]
    plan = Plan(eom, symbols, numbers)
    for w, parts in triples.items():
        if isinstance(parts, PPoly):
            plan.sampled[w] = parts
            parts = (0.0, 0.0, 0.0)
        for k, part in enumerate(parts):
            if isinstance(part, sm.Expr) and k <= needed[w]:
                plan.formulas["function", w, k] = part
            elif _is_function(part):
                plan.functions["function", w, k] = part
            numbers.append(part if isinstance(part, float) else 0.0)
    varying = _varying(plan, {w for name, w in known.items() if name in given})
    gaps = [gap for f in varying for gap in breaks(f, times[0], times[-1], max_step)]
    samples = [x for curve in plan.sampled.values() for x in curve.x if times[0] < x < times[-1]]
    gaps = sorted({*gaps, *((x, x) for x in samples)})
    plan.starts = np.array([times[0], *(after for _, after in gaps)])
    plan.ends = np.array([*(before for before, _ in gaps), times[-1]])
    return plan


def _triple(name: str, given: Any, order: int, times: np.ndarray) -> Any:
    """Value, rate and acceleration: floats, expressions, functions, None for what is not needed; or a PPoly."""
    if isinstance(given, Record):
        return _curve(name, given.time, _in_si(name, given), order, times)
    array = isinstance(given, np.ndarray) and given.ndim > 0
    if (array and (len(given) != 3 or len(times) == 3)) or (isinstance(given, list) and len(given) != 3):
        try:
            return _curve(name, times, np.asarray(given), order, times)
        except ValueError as error:  # rows of different lengths
            if isinstance(error, EngdynError):
                raise
            raise EngdynError(f"input {name} is {given!r}: give one number for each time") from error
    if _is_function(given):
        if order:
            raise EngdynError(
                f"input {name} acts by its {('rate', 'acceleration')[order - 1]}, too: give three functions "
                "(value, rate, acceleration), an expression in t or a Record"
            )
        return given, None, None
    if array or isinstance(given, tuple | list):
        parts = list(given)
        if len(parts) != 3:
            raise EngdynError(f"input {name} has {len(parts)} entries: a prescribed motion has three")
        return tuple(part if _is_function(part) else _part(name, part) for part in parts)
    value = _part(name, given)
    t = dynamicsymbols._t
    return (value, 0.0, 0.0) if isinstance(value, float) else (value, value.diff(t), value.diff(t, 2))


def _in_si(name: str, record: Record) -> np.ndarray:
    """Samples of a record in SI units; of one with several channels, which `_curve` refuses, as they are."""
    if not isinstance(record.unit, str):
        return record.samples
    factor = si_factor(record.unit)
    if factor is None:
        raise EngdynError(
            f"input {name} is a Record in {record.unit!r}, which is no unit: write it like mm or N m, or - where the "
            "samples are in SI units"
        )
    return factor * record.samples


def _is_function(given: Any) -> bool:
    """Whether this is a function of Python; symbols of sympy can be called, too, but are none."""
    return callable(given) and not isinstance(given, sm.Basic)


def _part(name: str, given: Any) -> float | sm.Expr:
    """A number, or an expression in t."""
    expr = as_expression(given, f"input {name}")
    expr = expr.xreplace({s: dynamicsymbols._t for s in expr.free_symbols if s.name == "t"})
    if expr.atoms(AppliedUndef):
        raise EngdynError(
            f"input {name} is {given}: give an expression in t and parameters; what depends on the "
            "state belongs into the equations"
        )
    if expr.free_symbols:
        return expr
    if not (expr.is_real and expr.is_finite):
        raise EngdynError(f"input {name} is {given!r}: give finite numbers")
    return float(expr)


def _symbols(
    eom: EquationsOfMotion, expressions: list[sm.Expr], values: Mapping[str, float]
) -> tuple[sm.Symbol, ...]:
    """Parameters of the equations, then further symbols of the inputs; each must have a value."""
    found = {s for e in expressions for s in e.free_symbols} - {dynamicsymbols._t, *eom.parameters}
    unknown = sorted(s.name for s in found if s.name not in values)
    if unknown:
        raise EngdynError(f"an input contains {', '.join(unknown)}, which values does not: give it a number")
    return (*eom.parameters, *sorted(found, key=lambda s: s.name))


def _curve(name: str, at: np.ndarray, samples: np.ndarray, order: int, times: np.ndarray) -> PPoly:
    """Samples as piecewise polynomials: linear where the value alone acts, else a spline of degree five."""
    if samples.ndim != 1 or len(samples) != len(at) or samples.dtype.kind not in "biuf":
        raise EngdynError(
            f"input {name} has shape {samples.shape}: give one channel, {len(at)} numbers for {len(at)} times"
        )
    if not np.isfinite(samples).all():
        raise EngdynError(f"input {name} contains values that are not finite: close such gaps first")
    if at[0] > times[0] + 1e-12 or at[-1] < times[-1] - 1e-12 * max(1.0, abs(times[-1])):
        raise EngdynError(
            f"input {name} is known from {at[0]:.5g} to {at[-1]:.5g} s, not from {times[0]:.5g} to {times[-1]:.5g} s"
        )
    degree = MOTION if order else FORCE
    if len(at) <= degree:
        raise EngdynError(f"input {name} has {len(at)} samples: a motion needs {degree + 1} or more")
    curve = PPoly.from_spline(make_interp_spline(at, samples, degree))
    kept = np.flatnonzero(np.diff(curve.x) > 0)  # splines have multiple knots at their ends
    return PPoly(curve.c[:, kept], np.append(curve.x[kept], curve.x[-1]))


def _varying(plan: Plan, given: set[sm.Expr]) -> list[Callable[[np.ndarray], np.ndarray]]:
    """Functions of arrays of times that may jump or rest: polynomials in t and defaults do not."""
    t, keys = dynamicsymbols._t, [("symbol", s) for s in plan.symbols]
    found: list[Callable[[np.ndarray], np.ndarray]] = []
    for key, expr in plan.formulas.items():
        if key[1] in given and not expr.is_polynomial(t):
            formula = compile_trees([plain_tree(expr)], [*keys, ("symbol", t)], "numpy")
            numbers = plan.numbers[: len(keys)]
            found.append(lambda at, g=formula, p=numbers: np.broadcast_to(g(*p, at)[0], at.shape))
    for key, function in plan.functions.items():
        name = key[1].func.__name__
        found.append(lambda at, g=function, n=name: np.array([_called(n, g, t) for t in at.tolist()]))
    return found


def _called(name: str, function: Callable[[float], float], t: float) -> float:
    """A function of the user at one time, checked."""
    try:
        value = float(function(t))
    except (TypeError, ValueError, OverflowError) as error:
        raise EngdynError(
            f"the function of input {name} gives no number at t = {t:.5g} s: {error}"
        ) from error
    if not np.isfinite(value):
        raise EngdynError(f"the function of input {name} is {value} at t = {t:.5g} s: it must be finite")
    return value
