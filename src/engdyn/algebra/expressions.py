"""Numbers and sympy expressions are let in, text is not: sympy would evaluate it."""

from __future__ import annotations

from typing import Any

import sympy as sm

from engdyn.errors import EngdynError

__all__ = ["as_expression"]


def as_expression(value: Any, what: str = "a quantity") -> sm.Expr:
    """A number or an expression as a sympy expression.

    Parameters
    ----------
    value : sympy.Expr or number
    what : str
        What the value is, for the message.

    Raises
    ------
    EngdynError
        Text, or anything else that is neither a number nor an expression.  Text is never evaluated.
    """
    if isinstance(value, sm.Expr):
        return value
    try:
        found = sm.sympify(value, strict=True)  # strict: text is refused, not parsed
    except (sm.SympifyError, TypeError, ValueError, AttributeError):
        found = None
    if not isinstance(found, sm.Expr):
        raise EngdynError(f"{what} is {repr(value)[:60]}: give a number or a sympy expression, not text")
    return found
