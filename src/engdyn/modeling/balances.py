"""Counting, projecting and eliminating: from the balances of free bodies to equations of motion.

Course sections 2.4 and 2.13.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass

import sympy as sm

from engdyn.algebra.elimination import eliminate, independent_columns, primitive, solve
from engdyn.algebra.readable import to_sympy, tree
from engdyn.algebra.ring import Element
from engdyn.errors import EngdynError
from engdyn.modeling.nonholonomic import total
from engdyn.modeling.state import State

__all__ = ["Balance", "Balances"]


@dataclass(frozen=True)
class Balance:
    """One scalar equation of a free body: residual = 0.

    Attributes
    ----------
    name : str
        What is balanced, e.g. "trolley: forces along N.x".
    residual : Element
        Inertia minus loads.
    motion : list of Element
        Partial velocities of this row, one per speed: ∂(v or ω)/∂u along this axis.
    """

    name: str
    residual: Element
    motion: list[Element]


class Balances:
    """Balances written as R λ + M̃ u̇ + h = 0 with reactions λ and accelerations u̇.

    Parameters
    ----------
    state : State
    balances : sequence of Balance
        Those that do not read 0 = 0.
    unknowns : sequence of sympy.Symbol, length k
        Magnitudes of the reactions.
    """

    def __init__(self, state: State, balances: Sequence[Balance], unknowns: Sequence[sm.Symbol]):
        self.state, self.balances, self.unknowns = state, list(balances), list(unknowns)
        ring = state.ring
        by_reaction = [ring.partial(("symbol", x)) for x in unknowns]
        by_acceleration = state.acceleration_partials()
        gens = [ring.generator(("symbol", x)) for x in unknowns]
        gens += [ring.generator(key) for key in state.acceleration_keys]
        self.rows = []
        for balance in self.balances:
            row = [partial(balance.residual) for partial in (*by_reaction, *by_acceleration)]
            rest = balance.residual
            for entry, generator in zip(row, gens, strict=True):
                if not entry.is_zero():
                    rest = rest - entry * generator
            self.rows.append([*row, rest])
        reactions = {ring.index["symbol", x] for x in unknowns}
        if any(not e.is_zero() and e.generators() & reactions for row in self.rows for e in row):
            raise EngdynError(
                "the loads are not linear in the unknown reactions: give each reaction one magnitude"
            )

    def check(self, others: Callable[[], Iterable[sm.Symbol]] = tuple, constraints: int = 0) -> None:
        """As many balances as unknown accelerations and reactions, or an error that says what is wrong.

        Parameters
        ----------
        others : callable
            Returns the symbols of the reaction loads that are not among the unknowns, for the message.
        constraints : int
            How many of the accelerations follow from the others.
        """
        n, k = len(self.state.speeds) - constraints, len(self.unknowns)
        if len(self.rows) == n + k:
            return self._check_independence()
        listing = "; ".join(
            f"{b.name} ({self._names(row) or 'no reaction'})"
            for b, row in zip(self.balances, self.rows, strict=True)
        )
        counted = f"{len(self.rows)} equations for {n} accelerations and {k} reactions"
        if len(self.rows) > n + k:
            missing = len(self.rows) - n - k
            names = ", ".join(sorted(x.name for x in others()))
            hint = f"The reactions contain {names}, not listed among the unknowns. " if names else ""
            raise EngdynError(
                f"{counted}: {missing} reaction{'s are' if missing > 1 else ' is'} missing. "
                f"{self._unsupported()}{hint}Equations and the reactions in them: {listing}"
            )
        raise EngdynError(
            f"{counted}: {n + k - len(self.rows)} too many, so they cannot be found from these bodies "
            "(statically indeterminate, or a free body is missing). Equations and the reactions in them: "
            f"{listing}"
        )

    def _check_independence(self) -> None:
        """No reaction may be a combination of others: two along one line cannot be told apart."""
        k = len(self.unknowns)
        if not independent_columns(self.rows, k):
            missing = eliminate([row[:k] for row in self.rows], k).missing
            names = ", ".join(self.unknowns[i].name for i in missing)
            raise EngdynError(
                f"the reactions {names} do not act independently of the others: they cannot be told apart"
            )

    def _names(self, row: list[Element]) -> str:
        return ", ".join(x.name for x, entry in zip(self.unknowns, row, strict=False) if not entry.is_zero())

    def _unsupported(self) -> str:
        """Which balances remain without any unknown to satisfy them."""
        columns = len(self.unknowns) + len(self.state.speeds)
        done = eliminate(self.rows, columns)
        left = [self.balances[origin].name for origin, row in done.remaining if not row[-1].is_zero()]
        return f"Nothing can satisfy: {', '.join(left)}. " if left else ""

    def along_motions(self) -> list[list[Element]]:
        """Balances projected on the motion that each speed stands for: rows ``[R | M | h]``, one per speed."""
        n, k = len(self.state.speeds), len(self.unknowns)
        found = []
        for j in range(n):
            total = [self.state.ring.zero] * (k + n + 1)
            for balance, row in zip(self.balances, self.rows, strict=True):
                weight = balance.motion[j]
                if not weight.is_zero():
                    total = [a if b.is_zero() else a + weight * b for a, b in zip(total, row, strict=True)]
            found.append(total)
        return found

    def projected(self) -> tuple[list[list[Element]], list[Element]] | None:
        """Project on the motions that the joints allow; None where a reaction does not drop out."""
        k, rows = len(self.unknowns), self.along_motions()
        if any(not entry.is_zero() for row in rows for entry in row[:k]):
            return None
        return [row[k:-1] for row in rows], [-row[-1] for row in rows]

    def eliminated(self) -> tuple[list[list[Element]], list[Element]]:
        """Eliminate the reactions one by one."""
        n, k = len(self.state.speeds), len(self.unknowns)
        done = eliminate(self.rows, k)
        rows = [primitive(row[k:]) for _, row in done.remaining]
        return [row[:n] for row in rows], [-row[n] for row in rows]

    def reactions(self) -> dict[sm.Symbol, sm.Expr]:
        """Each reaction in terms of q, u and u̇."""
        n, k = len(self.state.speeds), len(self.unknowns)
        if not k:
            return {}
        ring = self.state.ring
        accelerations = [ring.generator(key) for key in self.state.acceleration_keys]
        rows = []
        for row in self.rows:
            rest = row[-1]
            for entry, udot in zip(row[k : k + n], accelerations, strict=True):
                rest = rest + entry * udot
            rows.append([*row[:k], rest])
        found = solve([*rows, *self._along_reactions(rows)], k) or []
        return {x: to_sympy(tree(e)) for x, e in zip(self.unknowns, found, strict=True)}

    def _along_reactions(self, rows: list[list[Element]]) -> list[list[Element]]:
        """Balances of a body along the direction of a reaction, where no axis of the balances has it.

        Written along other axes, the reaction would be divided by the cosine between them, which may vanish.
        """
        triples: dict[str, list[list[Element]]] = {}
        for balance, row in zip(self.balances, rows, strict=True):
            triples.setdefault(balance.name.rpartition(" along ")[0], []).append(row)
        found = []
        for triple in triples.values():
            for column in range(len(self.unknowns)):
                weights = [row[column] for row in triple]
                if any(w.as_rational() is not None and not w.is_zero() for w in weights):
                    continue
                length = total(w * w for w in weights)
                if not length.is_zero() and length.as_rational() is not None:
                    terms = ([w * e for e in row] for w, row in zip(weights, triple, strict=True))
                    found.append([total(column) for column in zip(*terms, strict=True)])
        return found
