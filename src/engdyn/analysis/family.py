"""Equilibrium conditions as a family over one parameter, with their derivatives.  Course section 4.3."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from sympy.physics.vector import dynamicsymbols

from engdyn.algebra.codegen import compile_elements
from engdyn.algebra.conversion import Converter
from engdyn.algebra.expressions import as_expression
from engdyn.analysis.equilibrium import Equilibrium, is_periodic
from engdyn.analysis.slopes import as_products, compile_products, slopes
from engdyn.analysis.steady import SteadyProblem
from engdyn.modeling.equations import EquationsOfMotion
from engdyn.modeling.numbers import mass_and_force

__all__ = ["Curve", "Family", "Point"]

Curve = list[tuple[float, np.ndarray]]
Point = tuple[float, np.ndarray]


class Family:
    """Equilibrium conditions F(z, λ) = 0 over one parameter λ, with their derivatives.

    z holds the unknowns that an equilibrium search solves for (coordinates, rates, inputs), all
    scaled with their bounds so that steps compare.
    """

    def __init__(
        self,
        eom: EquationsOfMotion,
        values: Mapping[str, float],
        parameter: str,
        interval: tuple[float, float],
        bounds: Mapping[str, tuple[float, float]] | None,
        steady: Mapping[str, Any],
    ):
        self.eom, self.values, self.parameter, self.interval = eom, dict(values), parameter, interval
        self.bounds, self.steady = dict(bounds or {}), steady
        middle = {**values, parameter: 0.5 * (interval[0] + interval[1]) or 0.4321 * interval[1]}
        symbol = next(p for p in eom.parameters if p.name == parameter)
        self._driven = self._driven_inputs(symbol)
        varied = frozenset({("symbol", symbol), *(("function", w, k) for w, k, _ in self._driven)})
        self.problem = SteadyProblem(eom, middle, keep=varied, **steady)
        self.names = self.problem.names
        self.unknowns = self.problem.unknowns
        self.scale = np.array([self._width(u.name) for u in self.unknowns])
        widths = zip(self.unknowns, self.scale, strict=True)
        self.periodic = np.array(
            [is_periodic(self.problem, u, (0.0, width)) for u, width in widths], dtype=bool
        )
        self._compile(symbol)

    def _width(self, name: str) -> float:
        low, high = self.bounds.get(name, (-np.pi, np.pi))
        return high - low

    def _driven_inputs(self, symbol: Any) -> list[tuple[Any, int, Any]]:
        """Inputs whose default depends on the parameter (a drive rate Omega): (input, order, expression)."""
        given = dict(self.steady.get("inputs") or {})
        found = []
        for w, triple in self.eom.defaults.items():
            if w.func.__name__ not in given:
                symbols = [as_expression(e).free_symbols for e in triple]
                found += [
                    (w, k, triple[k])
                    for k in (1, 2)
                    if symbol in symbols[k] and dynamicsymbols._t not in symbols[k]
                ]
        return found

    def _compile(self, symbol: Any) -> None:
        """F, ∂F/∂z and dF/dλ as one compiled function of (z, λ, driven inputs)."""
        problem, ring = self.problem, self.problem.ring
        varied = [("symbol", symbol), *(("function", w, k) for w, k, _ in self._driven)]
        n = len(self.unknowns)
        entries = [as_products(row) for row in problem.rows]
        by_row = [slopes(ring, row, [*(u.key for u in self.unknowns), *varied]) for row in problem.rows]
        entries += [entry for by_key in zip(*by_row, strict=True) for entry in by_key]
        constants = [key for key in problem.constants if key not in varied]
        self._constant_values = [float(problem.constants[key]) for key in constants]
        self._compiled = compile_products(
            entries, [*(u.key for u in self.unknowns), *varied, *constants], "math"
        )
        defaults = [e for _, _, e in self._driven]
        rates = [e.diff(symbol) for e in defaults]
        others = [p for e in (*defaults, *rates) for p in e.free_symbols if p != symbol]
        numbers = {p: self.values[p.name] for p in others if p.name in self.values}
        expressions = [e.xreplace(numbers) for e in (*defaults, *rates)]
        converter = Converter(expressions, [("symbol", symbol)])
        self._driving = compile_elements(
            [converter.convert(e) for e in expressions], [("symbol", symbol)], "math"
        )
        self._n, self._varied = n, len(varied)
        self._tied = compile_elements(
            [e for _, e in problem.eliminated], [u.key for u in self.unknowns], "math"
        )

    def evaluate(self, z: np.ndarray, at: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """F, ∂F/∂z and dF/dλ at one point."""
        driving = self._driving(at)
        half = len(driving) // 2
        n = self._n
        flat = np.array(
            self._compiled(*(float(x) for x in z), at, *driving[:half], *self._constant_values), dtype=float
        )
        table = flat.reshape(1 + n + self._varied, -1)
        by_parameter = table[1 + n] + sum(
            (s * row for s, row in zip(driving[half:], table[2 + n :], strict=True)), 0.0
        )
        return table[0], table[1 : 1 + n].T, by_parameter

    def inside(self, z: np.ndarray, at: float) -> bool:
        """Whether a point lies within the interval and the bounds."""
        low, high = self.interval
        slack = 1e-9 * (high - low)
        if not low - slack <= at <= high + slack:
            return False
        for unknown, value, periodic in zip(self.unknowns, z, self.periodic, strict=True):
            if unknown.name in self.bounds and not periodic:
                least, greatest = self.bounds[unknown.name]
                edge = 1e-9 * (greatest - least)
                if not least - edge <= value <= greatest + edge:
                    return False
        return True

    def unknown_part(self, equilibrium: Equilibrium) -> np.ndarray:
        """The unknowns of a found equilibrium, in the order of this family."""
        named = dict(zip(equilibrium.names, equilibrium.q, strict=True))
        owners = [u.expr.func.__name__ if u.is_Derivative else u.func.__name__ for u in self.eom.speeds]
        named |= {f"{n}_d": x for n, x in zip(owners, equilibrium.speeds, strict=True)}
        named |= {f"{n}_dd": x for n, x in zip(owners, equilibrium.accelerations, strict=True)}
        named |= {n: x for n, x in equilibrium.inputs.items() if isinstance(x, int | float)}
        return np.array([float(named.get(u.name, 0.0)) for u in self.unknowns])

    def coordinates(self, z: np.ndarray, at: float) -> np.ndarray:
        """All coordinates at a point, neutral ones zero."""
        return self.equilibrium(z, at).q

    def equilibrium(self, z: np.ndarray, at: float) -> Equilibrium:
        """The equilibrium of a point on a branch."""
        named = {u.name: float(x) for u, x in zip(self.unknowns, z, strict=True)}
        problem = self.problem
        tied = self._tied(*named.values())
        named |= {u.name: float(x) for (u, _), x in zip(problem.eliminated, tied, strict=True)}
        owners = [u.expr.func.__name__ if u.is_Derivative else u.func.__name__ for u in self.eom.speeds]
        q = np.array([named.get(n, 0.0) for n in self.names])
        speeds = np.array([named.get(f"{n}_d", float(problem.rates.get(n, 0))) for n in owners])
        udot = np.array([named.get(f"{n}_dd", float(problem.accelerations.get(n, 0))) for n in owners])
        inputs = dict(self.steady.get("inputs") or {})
        inputs |= {key[1].func.__name__: named[key[1].func.__name__] for key in problem.free}
        values = {**self.values, self.parameter: at}
        mass, force = mass_and_force(self.eom, q, speeds, values, inputs)
        residual = float(np.max(np.abs(mass @ udot - force), initial=0.0))
        return Equilibrium(q, speeds, udot, inputs, values, residual, tuple(self.names))
