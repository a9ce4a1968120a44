"""Numbers for anything that can be said about a motion: rates, accelerations, spring forces, energies."""

from __future__ import annotations

from typing import Any

import numpy as np
import sympy as sm
from sympy.physics.vector import dynamicsymbols

from engdyn.algebra.codegen import compile_trees
from engdyn.algebra.expressions import as_expression
from engdyn.algebra.plain import plain_tree
from engdyn.algebra.scan import derivative_key
from engdyn.analysis.inputs import Plan
from engdyn.errors import EngdynError

__all__ = ["Observer"]

Key = tuple[Any, ...]


class Observer:
    """Values of expressions along a motion.

    Parameters
    ----------
    plan : Plan
        Equations, parameters and inputs.
    """

    def __init__(self, plan: Plan):
        self.plan, eom = plan, plan.eom
        n, m = len(eom.coordinates), len(eom.speeds)
        self._speeds = eom.arguments[n : n + m]
        self._accelerations = [(kind, u, k + 1) for kind, u, k in self._speeds]
        self._rates = [("function", q, 1) for q in eom.coordinates]
        self._parameters = [("symbol", s) for s in plan.symbols]
        known = [*eom.arguments, *self._parameters, *self._rates, *self._accelerations]
        self._keys = list(dict.fromkeys(known))
        self._compiled: dict[sm.Expr, Any] = {}

    def named(self, name: str) -> sm.Expr:
        """The expression that a name stands for: ``theta``, ``theta'`` and ``theta''``; inputs likewise."""
        eom, base = self.plan.eom, name.rstrip("'")
        quasi = [u for u in eom.speeds if not isinstance(u, sm.Derivative)]
        functions = {f.func.__name__: f for f in (*eom.coordinates, *quasi, *eom.inputs)}
        if base not in functions:
            raise EngdynError(
                f"there is no {name!r}: choose among {', '.join(functions)}; a prime behind a name is a rate, two an "
                "acceleration; everything else is an output of an expression"
            )
        return functions[base].diff(dynamicsymbols._t, len(name) - len(base))

    def __call__(self, expr: sm.Expr, times: np.ndarray, states: np.ndarray) -> np.ndarray:
        """An expression at the times (k,) in the states (n + m, k); shape (k,)."""
        return self.several([expr], times, states)[0]

    def several(self, expressions: list[Any], times: np.ndarray, states: np.ndarray) -> list[np.ndarray]:
        """Several expressions at once."""
        functions = [self._function(e) for e in expressions]
        numbers = self._numbers(times, states, any(moving for _, moving in functions))
        values = [numbers.get(key, np.nan) for key in self._keys]
        with np.errstate(all="ignore"):
            return [
                np.broadcast_to(function(*values)[0], times.shape).astype(float) for function, _ in functions
            ]

    def _function(self, given: Any) -> tuple[Any, bool]:
        """Compiled expression, and whether it holds accelerations or rates that are no speeds."""
        expr = as_expression(given, "an output")
        expr = expr.doit() if expr.atoms(sm.Derivative) else expr
        if expr not in self._compiled:
            asked = {derivative_key(a) or ("symbol", a) for a in _atoms(expr)}
            unknown = sorted(_spoken(key) for key in asked - {*self._keys})
            if unknown:
                raise EngdynError(
                    f"{expr} contains {', '.join(unknown)}: neither the equations nor values know it"
                )
            moving = not asked.isdisjoint({*self._accelerations, *self._rates} - {*self._speeds})
            self._compiled[expr] = compile_trees([plain_tree(expr)], self._keys, "numpy"), moving
        return self._compiled[expr]

    def _numbers(self, times: np.ndarray, states: np.ndarray, moving: bool) -> dict[Key, Any]:
        plan, eom = self.plan, self.plan.eom
        numbers: dict[Key, Any] = dict(zip(eom.arguments, states, strict=False))
        numbers |= dict(zip(self._parameters, plan.numbers, strict=False))
        numbers |= {key: x for key, x in plan.at(times).items() if key[0] == "function"}
        numbers["symbol", dynamicsymbols._t] = times
        if moving:
            m = len(eom.speeds)
            flat = eom.compiled("numpy")(*(numbers[key] for key in eom.arguments))
            flat = np.stack([np.broadcast_to(np.asarray(x, float), times.shape) for x in flat], axis=-1)
            mass, force = flat[:, : m * m].reshape(-1, m, m), flat[:, m * m : m * m + m]
            numbers |= dict(zip(self._rates, flat[:, m * m + m :].T, strict=True))
            udot = np.linalg.solve(mass, force[..., None])[..., 0]
            numbers |= dict(zip(self._accelerations, udot.T, strict=True))
        return numbers


def _atoms(expr: sm.Expr) -> set[sm.Expr]:
    """Dynamicsymbols with their derivatives, and symbols other than those inside of them."""
    if derivative_key(expr) is not None or expr.is_Symbol:
        return {expr}
    return {atom for part in expr.args for atom in _atoms(part)}


def _spoken(key: Key) -> str:
    return key[1].func.__name__ + "'" * key[2] if key[0] == "function" else str(key[1])
