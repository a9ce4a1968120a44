"""Equilibrium conditions as a family over one parameter, with their derivatives.  Course section 4.3."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import sympy as sm
from sympy.physics.vector import dynamicsymbols

from engdyn.algebra.codegen import compile_elements
from engdyn.algebra.conversion import Converter
from engdyn.algebra.expressions import as_expression
from engdyn.analysis.equilibrium import Equilibrium, Region, is_periodic
from engdyn.analysis.prescribed import evaluated, symbols_in
from engdyn.analysis.slopes import as_products, compile_products, slopes
from engdyn.analysis.steady import SteadyProblem
from engdyn.errors import EngdynError
from engdyn.modeling.equations import EquationsOfMotion
from engdyn.modeling.numbers import mass_and_force

__all__ = ["Curve", "Family", "Point"]

Key = tuple[Any, ...]
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
        symbol: sm.Symbol,
        interval: tuple[float, float],
        bounds: Mapping[str, tuple[float, float]] | None,
        steady: Mapping[str, Any],
        region: Region | None = None,
    ):
        self.eom, self.values, self.parameter, self.interval = eom, dict(values), symbol.name, interval
        self.bounds, self.steady, self.region = dict(bounds or {}), steady, region
        middle = 0.5 * (interval[0] + interval[1]) or 0.4321 * interval[1]
        self._driven = [*self._driven_inputs(symbol), *self._driven_by_hand()]
        varied = frozenset({("symbol", symbol), *(key for key, _ in self._driven)})
        self.problem = SteadyProblem(eom, {**values, symbol.name: middle}, keep=varied, **self._at(middle))
        self._check_free_motion()
        self._middle = self._bounds_at(middle)
        self.names = self.problem.names
        self.unknowns = self.problem.unknowns
        self.scale = np.array([self._width(u.name) for u in self.unknowns])
        widths = zip(self.unknowns, self.scale, strict=True)
        self.periodic = np.array(
            [is_periodic(self.problem, u, (0.0, width)) for u, width in widths], dtype=bool
        )
        self._compile(symbol)

    def _width(self, name: str) -> float:
        low, high = self._middle.get(name, (-np.pi, np.pi))
        return high - low

    def fit(self, seeds: Sequence[np.ndarray]) -> None:
        """Scale unknowns without bounds (a force that is solved for) with what they are at some equilibria."""
        for i, unknown in enumerate(self.unknowns):
            largest = max((abs(z[i]) for z in seeds), default=0.0)
            if unknown.name not in self.bounds and not self.periodic[i] and largest > 1e-6:
                self.scale[i] = 2 * largest

    def _at(self, at: float) -> dict[str, Any]:
        """What is prescribed, in numbers, at one value of the parameter."""
        values = {**self.values, self.parameter: at}
        kept = {"free": self.steady["free"]}  # names, no numbers
        return kept | {k: evaluated(x, values, k) for k, x in self.steady.items() if k not in kept}

    def _bounds_at(self, at: float) -> dict[str, tuple[float, float]]:
        return evaluated(self.bounds, {**self.values, self.parameter: at}, "bounds")

    def _driven_by_hand(self) -> list[tuple[Key, sm.Expr]]:
        """Inputs, rates and accelerations that are given as expressions in the parameter."""
        named = {w.func.__name__: w for w in (*self.eom.inputs, *self.eom.coordinates)}
        found = []
        for what, first in (("inputs", 0), ("rates", 1), ("accelerations", 2)):
            for name, given in (self.steady.get(what) or {}).items():
                parts = given if isinstance(given, tuple | list) else (given,)
                found += [
                    (("function", named[name], first + k), part)
                    for k, part in enumerate(parts)
                    if name in named and self.parameter in {s.name for s in symbols_in(part)}
                ]
        return found

    def _check_free_motion(self) -> None:
        """Refuse a rate that varies where it prescribes those of other coordinates."""
        for what in ("rates", "accelerations"):
            given = self.steady.get(what) or {}
            implied = [name for name in getattr(self.problem, what) if name not in given]
            if implied and any(self.parameter in {s.name for s in symbols_in(x)} for x in given.values()):
                raise EngdynError(
                    f"{what} that follow {self.parameter} also prescribe those of {', '.join(implied)}, which "
                    "move along: prescribe one of them by a number, or vary another parameter"
                )

    def _driven_inputs(self, symbol: Any) -> list[tuple[Key, sm.Expr]]:
        """Inputs whose default depends on the parameter (a drive rate Omega)."""
        given = dict(self.steady.get("inputs") or {})
        found = []
        for w, triple in self.eom.defaults.items():
            if w.func.__name__ not in given:
                symbols = [as_expression(e).free_symbols for e in triple]
                found += [
                    (("function", w, k), triple[k])
                    for k in (1, 2)
                    if symbol in symbols[k] and dynamicsymbols._t not in symbols[k]
                ]
        return found

    def _compile(self, symbol: Any) -> None:
        """F, ∂F/∂z and dF/dλ as one compiled function of (z, λ, driven inputs)."""
        problem, ring = self.problem, self.problem.ring
        varied = [("symbol", symbol), *(key for key, _ in self._driven)]
        n = len(self.unknowns)
        entries = [as_products(row) for row in problem.rows]
        by_row = [slopes(ring, row, [*(u.key for u in self.unknowns), *varied]) for row in problem.rows]
        entries += [entry for by_key in zip(*by_row, strict=True) for entry in by_key]
        constants = [key for key in problem.constants if key not in varied]
        self._constant_values = [float(problem.constants[key]) for key in constants]
        self._compiled = compile_products(
            entries, [*(u.key for u in self.unknowns), *varied, *constants], "math"
        )
        driven = [
            e.xreplace({s: symbol for s in e.free_symbols if s.name == symbol.name}) for _, e in self._driven
        ]
        rates = [e.diff(symbol) for e in driven]
        others = [p for e in (*driven, *rates) for p in e.free_symbols if p != symbol]
        numbers = {p: self.values[p.name] for p in others if p.name in self.values}
        expressions = [e.xreplace(numbers) for e in (*driven, *rates)]
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
        bounds = self._bounds_at(at)
        for unknown, value, periodic in zip(self.unknowns, z, self.periodic, strict=True):
            if unknown.name in bounds and not periodic:
                least, greatest = bounds[unknown.name]
                edge = 1e-9 * (greatest - least)
                if not least - edge <= value <= greatest + edge:
                    return False
        return self.region is None or self.region(
            self.coordinates(z, at), {**self.values, self.parameter: at}
        )

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
        given = self._at(at)
        rates = {**problem.rates, **(given["rates"] or {})}
        gains = {**problem.accelerations, **(given["accelerations"] or {})}
        speeds = np.array([named.get(f"{n}_d", float(rates.get(n, 0))) for n in owners])
        udot = np.array([named.get(f"{n}_dd", float(gains.get(n, 0))) for n in owners])
        inputs = dict(given["inputs"] or {})
        inputs |= {key[1].func.__name__: named[key[1].func.__name__] for key in problem.free}
        values = {**self.values, self.parameter: at}
        mass, force = mass_and_force(self.eom, q, speeds, values, inputs)
        residual = float(np.max(np.abs(mass @ udot - force), initial=0.0))
        return Equilibrium(q, speeds, udot, inputs, values, residual, tuple(self.names))
