"""Numbers of constrained systems, from the equations in all rates.

Projected on the independent speeds, the equations of a closed loop are exact but long: sines that divide are
expanded with everything else, and thousands of terms cancel in floating point.  So numbers are computed from
what the projection starts with, M q̈ = f + Aᵀ λ with A q̇ + b = 0, and projected as numbers.
Course sections 3.8 and 8.9.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import sympy as sm

from engdyn.algebra.codegen import compile_elements
from engdyn.algebra.ring import Element
from engdyn.errors import OutsideRingError
from engdyn.modeling.state import State

__all__ = ["Constrained"]

Key = tuple[Any, ...]


@dataclass(frozen=True, eq=False)
class Constrained:
    """Equations of motion in all n rates, and the constraints between these.

    Attributes
    ----------
    coordinates : tuple of dynamicsymbols, length n
    speeds : tuple of rates, length m
        The independent ones.
    mass, force : Element arrays
        M (n × n) and f (n) in terms of q and q̇; reactions of the constraints left out.
    constraints : tuple of expressions = 0, length c = n - m
        Linear in the rates.
    """

    coordinates: tuple[sm.Expr, ...]
    speeds: tuple[sm.Expr, ...]
    mass: tuple[tuple[Element, ...], ...]
    force: tuple[Element, ...]
    constraints: tuple[sm.Expr, ...]

    def compiled(self, arguments: Sequence[Key], target: str) -> Callable[..., tuple] | None:
        """A function of `arguments` that returns M, f and q̇ on the independent speeds, flat.

        None where something is needed that is not among the arguments.

        Parameters
        ----------
        arguments : sequence of tuple
            Generator keys: n coordinates, m speeds, everything else.
        target : {"math", "numpy"}
        """
        n, m = len(self.coordinates), len(self.speeds)
        rates = [("function", q, 1) for q in self.coordinates]
        keys = (*arguments[:n], *rates, *arguments[n + m :])
        A, b, change = self._constraint_elements()
        flat = [*change, *(e for row in self.mass for e in row), *self.force]
        try:
            links = compile_elements([*(e for row in A for e in row), *b], keys, target)
            rest = compile_elements(flat, keys, target)
        except (OutsideRingError, KeyError):
            return None
        kept = [self.coordinates.index(u.args[0]) for u in self.speeds]
        return _projection(links, rest, kept, n)

    def _constraint_elements(self) -> tuple[list[list[Element]], list[Element], list[Element]]:
        """A and b of A q̇ + b = 0, and what its derivative A q̈ + … = 0 adds to A q̈."""
        state = State(self.coordinates, self.constraints, moving=self.constraints)
        A, b, change = [], [], []
        for row in (state.convert(c) for c in self.constraints):
            line = [partial(row) for partial in state.speed_partials()]
            slope = state.time_derivative(row)
            for entry, rate, second in zip(line, state.speed_keys, state.acceleration_keys, strict=True):
                row = row - entry * state.ring.generator(rate)
                slope = slope - entry * state.ring.generator(second)
            A.append(line)
            b.append(row)
            change.append(slope)
        return A, b, change


def _projection(
    links: Callable[..., tuple], rest: Callable[..., tuple], kept: list[int], n: int
) -> Callable[..., tuple]:
    """Gᵀ M G and Gᵀ (f − M c), where q̇ = G u + g and q̈ = G u̇ + c follow from the constraints."""
    m, c = len(kept), n - len(kept)
    bound = [i for i in range(n) if i not in kept]

    def function(*values: Any) -> tuple:
        q, u, others = values[:n], values[n : n + m], values[n + m :]
        A_b = _stacked(links(*q, *([0.0] * n), *others))
        A, b = A_b[..., : c * n].reshape(*A_b.shape[:-1], c, n), A_b[..., c * n :]
        speeds = np.broadcast_to(_stacked(u), (*A_b.shape[:-1], m))
        try:
            inverse = -np.linalg.inv(A[..., bound])
        except np.linalg.LinAlgError:  # a dead center: callers say so of numbers that are not finite
            inverse = np.full((*A_b.shape[:-1], c, c), np.nan)
        rates = np.empty((*A_b.shape[:-1], n))
        rates[..., kept] = speeds
        rates[..., bound] = _times(inverse, _times(A[..., kept], speeds) + b)
        flat = _stacked(rest(*q, *np.moveaxis(rates, -1, 0), *others))
        shape = flat.shape[:-1]
        curve = np.zeros((*shape, n))
        curve[..., bound] = _times(inverse, flat[..., :c])
        G = np.zeros((*shape, n, m))
        G[..., kept, range(m)] = 1.0
        G[..., bound, :] = inverse @ A[..., kept]
        M, f = flat[..., c : c + n * n].reshape(*shape, n, n), flat[..., c + n * n :]
        turned = np.swapaxes(G, -1, -2)
        mass, force = turned @ M @ G, _times(turned, f - _times(M, curve))
        found = np.concatenate([mass.reshape(*shape, m * m), force, np.broadcast_to(rates, (*shape, n))], -1)
        return tuple(np.moveaxis(found, -1, 0))

    return function


def _stacked(values: Sequence[Any]) -> np.ndarray:
    """Scalars or arrays of one shape along a last axis."""
    return np.stack(np.broadcast_arrays(*(np.asarray(x, dtype=float) for x in values)), axis=-1)


def _times(matrix: np.ndarray, vector: np.ndarray) -> np.ndarray:
    return (matrix @ vector[..., None])[..., 0]
