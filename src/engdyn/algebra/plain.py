"""Trees of expressions as they stand: nothing is expanded, so that sin(300.1*t) stays one sine.

Rings are for what has to be proved or differentiated; inputs over time and outputs only have to become numbers.
"""

from __future__ import annotations

import sympy as sm

from engdyn.algebra.codegen import FUNCTIONS, JUMPS
from engdyn.algebra.expressions import as_expression
from engdyn.algebra.nodes import Node, make_power, make_product, make_sum
from engdyn.algebra.scan import RECIPROCAL, as_fraction, derivative_key, half_power
from engdyn.errors import OutsideRingError

__all__ = ["plain_tree"]


def plain_tree(expr: sm.Expr) -> Node:
    """The tree of an expression, for :mod:`engdyn.algebra.codegen`.

    Parameters
    ----------
    expr : sympy.Expr
        Numbers, symbols, dynamicsymbols and their derivatives; the functions that generated code may call,
        and the jumps ``Heaviside`` (1 at 0) and ``sign``.

    Raises
    ------
    OutsideRingError
        Other functions, such as Piecewise.
    """
    expr = as_expression(expr)
    key = derivative_key(expr)
    if key is not None:
        return ("generator", key)
    if expr.is_Symbol or expr is sm.S.Pi:
        return ("generator", ("symbol", expr))
    if expr is sm.E:
        return ("generator", ("call", sm.E))
    if expr.is_Number:
        return ("number", as_fraction(expr))
    if expr.is_Pow and isinstance(expr.exp, sm.Integer):
        return make_power(plain_tree(expr.base), int(expr.exp))
    if half_power(expr):
        return make_power(("call", sm.sqrt, (plain_tree(expr.base),)), int(2 * expr.exp))
    if type(expr) in RECIPROCAL:
        return plain_tree(RECIPROCAL[type(expr)](*expr.args))
    if isinstance(expr, sm.Derivative) and expr.doit() != expr:
        return plain_tree(expr.doit())
    if not (expr.is_Add or expr.is_Mul or expr.is_Pow or expr.func in FUNCTIONS or expr.func in JUMPS):
        known = ", ".join(sorted({*FUNCTIONS.values(), "Heaviside", "sign"}))
        raise OutsideRingError(f"numbers cannot be computed for {expr}: use {known}")
    parts = tuple(plain_tree(part) for part in expr.args)
    if expr.is_Add:
        return make_sum(parts)
    if expr.is_Mul:
        return make_product(parts)
    return ("jump", expr.func, parts[:1]) if expr.func in JUMPS else ("call", expr.func, parts)
