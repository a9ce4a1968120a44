"""What is given in an equilibrium problem: parameters, inputs, rates and accelerations as exact numbers."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from fractions import Fraction
from numbers import Real
from typing import Any

import sympy as sm
from sympy.physics.vector import dynamicsymbols

from engdyn.algebra.expressions import as_expression
from engdyn.errors import EngdynError
from engdyn.modeling.equations import EquationsOfMotion
from engdyn.modeling.numbers import input_values, parameter_values

__all__ = ["as_rational", "by_coordinate", "evaluated", "free_inputs", "known_numbers", "symbols_in"]

Key = tuple[Any, ...]


def as_rational(value: float) -> Fraction:
    """A float as the rational of its shortest decimal."""
    return Fraction(repr(float(value)))


def evaluated(given: Any, values: Mapping[str, float], what: str) -> Any:
    """What is given, with numbers in place of expressions in the parameters.

    Parameters
    ----------
    given : mapping of str to number, expression, or sequence of these; or None
    values : mapping of str to float
        Parameters by name [SI].
    what : str
        "rates", "bounds", ... for messages.

    Raises
    ------
    EngdynError
        No mapping; an expression that is no finite real number with these values.
    """
    if given is None:
        return None
    if not isinstance(given, Mapping):
        raise EngdynError(f"{what} is {given!r}: give a mapping of names to numbers or expressions")
    return {name: _evaluated(x, values, f"{what}[{name!r}]") for name, x in given.items()}


def _evaluated(value: Any, values: Mapping[str, float], what: str) -> Any:
    if isinstance(value, tuple | list):
        return tuple(_evaluated(part, values, what) for part in value)
    if not isinstance(value, sm.Expr):
        return value
    known = {s: sm.Float(values[s.name]) for s in value.free_symbols if s.name in values}
    number = value.xreplace(known)
    if not (number.is_number and number.is_real and number.is_finite):
        raise EngdynError(
            f"{what} is {value}, which reads {number} here: give an expression in parameters with values"
        )
    return float(number)


def symbols_in(given: Any) -> set[sm.Symbol]:
    """Symbols of all expressions in a number, an expression, or nested mappings and sequences of these."""
    if isinstance(given, Mapping):
        given = tuple(given.values())
    if isinstance(given, tuple | list):
        return {s for part in given for s in symbols_in(part)}
    return set(given.free_symbols) if isinstance(given, sm.Expr) else set()


def by_coordinate(names: Sequence[str], given: Mapping[str, float] | None, what: str) -> dict[str, Fraction]:
    """Prescribed rates or accelerations, checked."""
    found = {}
    for name, value in dict(given or {}).items():
        if name not in names:
            raise EngdynError(f"{what} names {name!r}: the coordinates are {', '.join(names)}")
        if not isinstance(value, Real) or not math.isfinite(value):
            raise EngdynError(f"{what}[{name!r}] is {value!r}: give a finite number")
        found[name] = as_rational(float(value))
    return found


def free_inputs(eom: EquationsOfMotion, free: str | Sequence[str]) -> list[Key]:
    """Keys of the inputs that are solved for, checked."""
    known = {w.func.__name__: w for w in eom.inputs}
    names = [free] if isinstance(free, str) else list(free)
    for name in names:
        if name not in known:
            raise EngdynError(
                f"free names the input {name!r}: the equations have {', '.join(known) or 'none'}"
            )
    return [("function", known[name], 0) for name in names]


def known_numbers(
    eom: EquationsOfMotion, values: Mapping[str, float], inputs: Mapping[str, Any]
) -> dict[Key, Fraction]:
    """Rational values of parameters and inputs; defaults that depend on time are left out."""
    numbers: dict[Key, Fraction] = {}
    for p, value in zip(eom.parameters, parameter_values(eom, values), strict=True):
        numbers["symbol", p] = as_rational(value)
    order = [(w, k) for w in eom.inputs for k in (0, 1, 2)]
    for (w, k), value in zip(order, input_values(eom, inputs, values), strict=True):
        default = eom.defaults.get(w)
        follows = default is not None and w.func.__name__ not in inputs
        if not (follows and as_expression(default[k]).has(dynamicsymbols._t)):
            numbers["function", w, k] = as_rational(value)
    return numbers
