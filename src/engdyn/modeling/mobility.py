"""How many coordinates are free: coordinates minus independent constraints.  Course section 1.2."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import sympy as sm
from sympy.core.function import AppliedUndef

from engdyn.algebra.elimination import eliminate
from engdyn.algebra.readable import to_sympy, tree
from engdyn.errors import EngdynError
from engdyn.modeling.instants import number_at
from engdyn.modeling.motion import Triple
from engdyn.modeling.state import State

__all__ = ["functions_in", "rank", "rank_at"]

TOLERANCE = 1e-6
"""How well a configuration must satisfy the constraints, relative to the size of their terms."""


def functions_in(*expressions: sm.Expr) -> list[sm.Expr]:
    """Dynamicsymbols that occur, sorted by name."""
    return sorted({q for e in expressions for q in e.atoms(AppliedUndef)}, key=str)


def rank(coordinates: Sequence[sm.Expr], constraints: Sequence[sm.Expr]) -> int:
    """Number of independent constraints = 0 at a configuration in general position, exactly.

    Parameters
    ----------
    coordinates : sequence of dynamicsymbols
    constraints : sequence of expressions
        Of positions, or of velocities where rates appear.
    """
    if not constraints or not coordinates:
        return 0
    return len(coordinates) - len(eliminate(_jacobian(coordinates, constraints), len(coordinates)).missing)


def rank_at(
    coordinates: Sequence[sm.Expr], constraints: Sequence[sm.Expr], values: Mapping[Any, float]
) -> int:
    """Number of independent constraints at one configuration, by singular values.

    Raises
    ------
    EngdynError
        The configuration does not satisfy the constraints, or a number is missing.
    """
    if not constraints or not coordinates:
        return 0
    for constraint in constraints:
        terms = [number_at(term, values) for term in sm.Add.make_args(constraint)]
        if abs(sum(terms)) > TOLERANCE * max(map(abs, terms)):
            raise EngdynError(
                f"the values violate the constraint {constraint} = 0: it is {sum(terms):.4g} there; "
                "give a configuration in which the loop is closed"
            )
    rows = [
        [number_at(to_sympy(tree(e)), values) for e in row] for row in _jacobian(coordinates, constraints)
    ]
    matrix = np.array(rows)
    return int(np.linalg.matrix_rank(matrix, tol=TOLERANCE * max(np.abs(matrix).max(), 1e-300)))


def _jacobian(coordinates: Sequence[sm.Expr], constraints: Sequence[sm.Expr]) -> list[Triple]:
    """Derivatives of the constraints by the coordinates, or by the rates where these appear."""
    state, rows = State(coordinates, constraints), []
    for constraint in constraints:
        order = max((int(d.derivative_count) for d in constraint.atoms(sm.Derivative)), default=0)
        if order > 1:
            raise EngdynError(f"the constraint {constraint} = 0 contains accelerations: integrate it first")
        element = state.convert(constraint)
        rows.append([state.ring.partial(("function", q, order))(element) for q in coordinates])
    return rows
