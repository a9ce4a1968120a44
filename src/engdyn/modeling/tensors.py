"""Three rows of three entries: numbers or expressions, and nothing else."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import sympy as sm

from engdyn.algebra.expressions import as_expression
from engdyn.errors import EngdynError

__all__ = ["as_rows", "as_tensor", "check_positive", "checked_entry", "is_symbolic"]


def is_symbolic(*values: Any) -> bool:
    """Whether any of the values is a sympy expression that is not a number."""
    return any(isinstance(v, sm.Basic) and not v.is_number for v in values)


def as_tensor(rows: Sequence[Sequence[Any]]) -> Any:
    """Nine entries as a numpy array, or as a sympy matrix where one of them is symbolic."""
    rows = [[checked_entry(x) for x in row] for row in rows]
    if is_symbolic(*(x for row in rows for x in row)):
        return sm.Matrix(rows)
    return np.array([[float(x) for x in row] for row in rows])


def checked_entry(value: Any, what: str = "an element") -> Any:
    """A finite number or an expression; text is refused before sympy could read it."""
    if is_symbolic(value):
        return as_expression(value, what)
    try:
        number = np.nan if isinstance(value, str | bytes) else float(value)
    except (TypeError, ValueError):
        number = np.nan
    if not np.isfinite(number):
        raise EngdynError(f"{what} is {repr(value)[:60]}: give a finite number or an expression")
    return value


def as_rows(tensor: Any) -> list[list[Any]]:
    """A 3 × 3 array, matrix or nested list as lists."""
    try:
        rows = tensor.tolist() if hasattr(tensor, "tolist") else [list(row) for row in tensor]
    except TypeError:
        rows = []
    if (
        not isinstance(rows, list)
        or len(rows) != 3
        or any(not isinstance(row, list) or len(row) != 3 for row in rows)
    ):
        raise EngdynError("an inertia tensor or a rotation has three rows of three entries")
    return rows


def check_positive(zero: bool = False, **quantities: Any) -> None:
    """Refuse numbers that are not finite or have the wrong sign; symbols pass."""
    for name, value in quantities.items():
        number = checked_entry(value, name)
        if is_symbolic(value):
            continue
        if number < 0 or (number == 0 and not zero):
            raise EngdynError(
                f"{name} is {float(number):g}: it must be {'zero or positive' if zero else 'greater than zero'}"
            )
