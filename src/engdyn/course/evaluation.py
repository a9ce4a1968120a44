"""Values of expressions at given points, in 200 bits, with limits that no expression can exceed.

sympy's own evaluation may run for hours on ``exp(exp(exp(9)))``; this one gives up as soon as a part
has no real value of moderate size.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import mpmath
import sympy as sm

__all__ = ["BITS", "NoValueError", "evaluate", "real", "solve"]

#: Working precision, and the largest binary exponent that any part may have.
BITS, EXPONENT = 200, 1200

_numbers = mpmath.mp.clone()
_numbers.prec = BITS


class NoValueError(ArithmeticError):
    """An expression has no real value of moderate size at a point."""


def real(value: Any) -> Any:
    """A number as a 200-bit float."""
    if isinstance(value, sm.Rational):
        return _numbers.mpf(int(value.p)) / int(value.q)
    if isinstance(value, sm.Float):
        return _numbers.mpf(value._mpf_)
    return _numbers.mpf(value)


def solve(matrix: Sequence[Sequence[Any]], vector: Sequence[Any]) -> list[Any]:
    """Solution of a small linear system in 200 bits.

    Raises
    ------
    NoValueError
        The matrix is singular.
    """
    try:
        return list(_numbers.lu_solve(_numbers.matrix(matrix), _numbers.matrix(vector)))
    except (ZeroDivisionError, ValueError) as error:
        raise NoValueError("a singular matrix") from error


def evaluate(expr: sm.Expr, point: Mapping[sm.Expr, Any]) -> tuple[Any, Any]:
    """Value and scale of an expression.

    Parameters
    ----------
    expr : sympy.Expr
    point : mapping of symbols, dynamicsymbols and derivatives to 200-bit floats

    Returns
    -------
    value, scale : mpmath floats
        The scale of a sum is the sum of the scales of its terms: rounding errors are measured by it.

    Raises
    ------
    NoValueError
        A root of a negative number, a division by zero, a number out of range, an unknown symbol.
    """
    known: dict[sm.Basic, tuple[Any, Any]] = {}
    try:
        return _value(expr, point, known)
    except ZeroDivisionError as error:
        raise NoValueError("a division by zero") from error
    except (OverflowError, ValueError, MemoryError, RecursionError) as error:
        raise NoValueError("a number out of range") from error


def _value(expr: sm.Basic, point: Mapping[sm.Expr, Any], known: dict) -> tuple[Any, Any]:
    if expr in known:
        return known[expr]
    if expr in point:
        pair = point[expr], abs(point[expr])
    elif expr.is_Add:
        parts = [_value(a, point, known) for a in expr.args]
        pair = sum(v for v, _ in parts), sum(s for _, s in parts)
    elif expr.is_Mul:
        value = scale = _numbers.one
        for v, s in (_value(a, point, known) for a in expr.args):
            value, scale = value * v, scale * s
        pair = value, scale
    else:
        value = _other(expr, point, known)
        pair = value, abs(value)
    known[expr] = _checked(pair[0]), _checked(pair[1])
    return known[expr]


def _checked(value: Any) -> Any:
    if not isinstance(value, _numbers.mpf):
        raise NoValueError("a root or another function outside its domain")
    if not _numbers.isfinite(value) or abs(value) > _numbers.ldexp(1, EXPONENT):
        raise NoValueError("a number out of range")
    return value


def _other(expr: sm.Basic, point: Mapping[sm.Expr, Any], known: dict) -> Any:
    """Value of what is neither a symbol nor a sum nor a product."""
    if isinstance(expr, sm.Rational | sm.Float):
        return real(expr)
    if expr is sm.pi:
        return +_numbers.pi
    if expr is sm.E:
        return +_numbers.e
    if isinstance(expr, sm.Pow):
        return _power(*(_value(a, point, known)[0] for a in expr.args))
    if expr is sm.I:
        raise NoValueError("the root of a negative number")
    if expr in (sm.zoo, sm.oo, -sm.oo, sm.nan):
        raise ZeroDivisionError
    function = _FUNCTIONS.get(type(expr))
    if function is None:
        raise NoValueError(f"{type(expr).__name__} cannot be evaluated")
    arguments = [_value(a, point, known)[0] for a in expr.args]
    if type(expr) in _GROWING and abs(arguments[0]) > EXPONENT / 2:
        raise NoValueError("a number out of range")
    return function(*arguments)


def _power(base: Any, exponent: Any) -> Any:
    if base == 0:
        if exponent <= 0:
            raise ZeroDivisionError
        return _numbers.zero
    if abs(exponent) * (abs(_numbers.log(abs(base))) + 1) > EXPONENT:
        raise NoValueError("a number out of range")
    return base ** int(exponent) if exponent == int(exponent) else base**exponent


_GROWING = (sm.exp, sm.sinh, sm.cosh, sm.tanh)
_FUNCTIONS = {
    sm.sin: _numbers.sin,
    sm.cos: _numbers.cos,
    sm.tan: _numbers.tan,
    sm.cot: _numbers.cot,
    sm.sec: _numbers.sec,
    sm.csc: _numbers.csc,
    sm.asin: _numbers.asin,
    sm.acos: _numbers.acos,
    sm.atan: _numbers.atan,
    sm.atan2: _numbers.atan2,
    sm.sinh: _numbers.sinh,
    sm.cosh: _numbers.cosh,
    sm.tanh: _numbers.tanh,
    sm.exp: _numbers.exp,
    sm.log: _numbers.log,
    sm.Abs: abs,
    sm.sign: _numbers.sign,
}
