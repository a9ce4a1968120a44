"""Newton–Euler under velocity constraints: balances in all rates, projected as Lagrange's equations are.

Course sections 2.13 and 3.8.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import sympy as sm

from engdyn.algebra.readable import to_sympy, tree
from engdyn.modeling.balances import Balances
from engdyn.modeling.constrained import Constrained
from engdyn.modeling.equations import EquationsOfMotion
from engdyn.modeling.nonholonomic import projected, total, with_rates_inside
from engdyn.modeling.state import State

__all__ = ["without_constraint_reactions"]


def without_constraint_reactions(
    balances: Balances,
    speeds: Sequence[sm.Expr],
    rates: Mapping[sm.Expr, sm.Expr],
    constraints: Sequence[sm.Expr],
) -> EquationsOfMotion | None:
    """Project balances in all rates on the motions that the constraints allow.

    Parameters
    ----------
    balances : Balances
        In all n rates of the coordinates, none of them replaced.
    speeds : sequence of rates
        The independent ones.
    rates : mapping of coordinate to expression
        The dependent rates.
    constraints : sequence of expressions = 0

    Returns
    -------
    EquationsOfMotion or None
        None where a reaction does work on these motions (friction): it must be eliminated.
    """
    coordinates, k = balances.state.coordinates, len(balances.unknowns)
    rows = [[to_sympy(tree(entry)) for entry in row] for row in balances.along_motions()]
    entries = [entry for row in rows for entry in row]
    state = State(coordinates, entries, speeds, rates, substitute=False)
    lines = [[state.convert(entry) for entry in row] for row in rows]
    by_speed = [[partial(rate) for partial in state.speed_partials()] for rate in state.rate_elements()]
    for reaction in range(k):
        column = [line[reaction] for line in lines]
        for j in range(len(speeds)):
            if not total(by_speed[i][j] * entry for i, entry in enumerate(column)).is_zero():
                return None
    mass, force = [line[k:-1] for line in lines], [-line[-1] for line in lines]
    full = Constrained(coordinates, state.speeds, tuple(map(tuple, mass)), tuple(force), tuple(constraints))
    state, mass, force = with_rates_inside(state, mass, force)
    mass, force, _ = projected(state, mass, force, constraints)
    return replace(EquationsOfMotion.from_elements(state, mass, force, "Newton-Euler"), constrained=full)
