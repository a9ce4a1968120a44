"""An oracle for equilibria that knows nothing of engdyn.

It differentiates energies with sympy itself and looks for zeros by brute force.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from math import pi

import numpy as np
import sympy as sm
from scipy.optimize import brentq
from scipy.optimize import root as scipy_root
from sympy.core.function import AppliedUndef
from sympy.physics.mechanics import dynamicsymbols

import engdyn as ed

T = dynamicsymbols._t


@dataclass
class Case:
    """Energies of a system, default values, and the region of its equilibria."""

    name: str
    coordinates: Sequence[sm.Expr]
    kinetic: sm.Expr
    potential: sm.Expr
    values: dict[str, float]
    bounds: dict[str, tuple[float, float]]
    dissipation: sm.Expr = sm.S.Zero
    forces: dict[sm.Expr, sm.Expr] = field(default_factory=dict)
    constraints: Sequence[sm.Expr] = ()
    motion: dict[sm.Expr, sm.Expr] = field(default_factory=dict)

    def __post_init__(self) -> None:
        energies = self.kinetic, self.potential, list(self.coordinates), self.dissipation
        self.eom = ed.lagrange(*energies, self.forces, self.constraints)

    def __repr__(self) -> str:
        return self.name

    @property
    def names(self) -> list[str]:
        return [q.func.__name__ for q in self.coordinates]

    def generalized_force(
        self, values: dict[str, float], **inputs: float
    ) -> Callable[[np.ndarray], np.ndarray]:
        """∂T/∂q − ∂V/∂q − ∂D/∂q̇ + Q at rest, from the energies, as a function of q."""
        rates = [q.diff(T) for q in self.coordinates]
        slope = [
            sm.diff(self.kinetic - self.potential, q) - sm.diff(self.dissipation, r) + self.forces.get(q, 0)
            for q, r in zip(self.coordinates, rates, strict=True)
        ]
        moving = {d for e in slope for d in sm.sympify(e).atoms(sm.Derivative)}
        known = {**dict.fromkeys(moving, sm.S.Zero), **self.motion}
        plain = {q: sm.Symbol(f"q_{i}") for i, q in enumerate(self.coordinates)}
        expressions = []
        for e in slope:
            e = sm.sympify(e).xreplace(known).xreplace(plain)
            e = e.xreplace({f: inputs.get(f.func.__name__, sm.S.Zero) for f in e.atoms(AppliedUndef)})
            expressions.append(e.xreplace({s: values[s.name] for s in e.free_symbols if s.name in values}))
        function = sm.lambdify(list(plain.values()), expressions, "numpy")
        return lambda q: np.array([float(x) for x in function(*q)])

    def inertia(self, values: dict[str, float]) -> Callable[[np.ndarray], np.ndarray]:
        """det ∂²T/∂q̇², from the energies, as a function of q."""
        rates = [q.diff(T) for q in self.coordinates]
        plain = {q: sm.Symbol(f"q_{i}") for i, q in enumerate(self.coordinates)}
        mass = sm.hessian(
            self.kinetic.xreplace({r: sm.Symbol(f"u_{r}") for r in rates}),
            [sm.Symbol(f"u_{r}") for r in rates],
        )
        determinant = mass.det().xreplace(plain)
        known = {s: values[s.name] for s in determinant.free_symbols if s.name in values}
        function = sm.lambdify(list(plain.values()), determinant.xreplace(known), "numpy")
        return lambda q: float(function(*q))

    def brute_force(self, values: dict[str, float], starts: int = 13, **inputs: float) -> np.ndarray:
        """All zeros that a dense grid of starts finds in the region, sorted, shape (number, n).

        Where the mass matrix is singular the coordinates fail: a zero there is no equilibrium.
        """
        force, inertia = self.generalized_force(values, **inputs), self.inertia(values)
        region = [self.bounds.get(n, (-pi, pi)) for n in self.names]
        if len(region) == 1:
            found = _sign_changes(lambda x: force([x])[0], *region[0])
        else:
            grids = [np.linspace(low, high, starts) + 1e-3 * (high - low) for low, high in region]
            found = [_polished(force, np.array(start)) for start in itertools.product(*grids)]
        typical = inertia([0.1234] * len(region))
        regular = [x for x in found if x is not None and abs(inertia(x)) > 1e-9 * typical]
        return distinct(regular, region)


def _sign_changes(function: Callable[[float], float], low: float, high: float) -> list[np.ndarray]:
    grid = np.linspace(low, high, 4001)
    values = np.array([function(x) for x in grid])
    values[np.abs(values) < 1e-12 * np.max(np.abs(values))] = 0.0
    found = [np.array([x]) for x, v in zip(grid, values, strict=True) if v == 0.0]
    for i in range(len(grid) - 1):
        if values[i] * values[i + 1] < 0.0:
            found.append(np.array([brentq(function, grid[i], grid[i + 1], xtol=1e-14)]))
    return found


def _polished(function: Callable[[np.ndarray], np.ndarray], start: np.ndarray) -> np.ndarray | None:
    answer = scipy_root(function, start, tol=1e-13)
    scale = 1.0 + np.max(np.abs(function(start)))
    return answer.x if np.max(np.abs(function(answer.x))) < 1e-9 * scale else None


def distinct(found: Sequence[np.ndarray], region: Sequence[tuple[float, float]]) -> np.ndarray:
    """Zeros in the region, each once; a full turn is one place, (−π, π]."""
    kept: list[np.ndarray] = []
    for x in found:
        x = np.array(x, dtype=float)
        for i, (low, high) in enumerate(region):
            if abs(high - low - 2 * pi) < 1e-9:
                x[i] = high - np.mod(high - x[i], 2 * pi)
                if x[i] - low < 1e-7:
                    x[i] = high
        inside = all(low - 1e-9 <= y <= high + 1e-9 for y, (low, high) in zip(x, region, strict=True))
        if inside and not any(np.allclose(x, y, atol=1e-6) for y in kept):
            kept.append(x)
    return np.array(sorted(kept, key=lambda y: tuple(np.round(y, 6)))).reshape(-1, len(region))


def of_catalogue(number: int) -> Case:
    """The energies of a system of the catalogue."""
    system = ed.systems.load(number)
    motion = {w.symbol.diff(T): w.default[1] for w in system.inputs if w.default is not None}
    return Case(
        f"S{number:02d}",
        [c.symbol for c in system.coordinates],
        system.kinetic_energy,
        system.potential_energy,
        system.values(),
        system.bounds,
        system.dissipation,
        system.generalized_forces,
        motion=motion,
    )


def symbols(names: str) -> list[sm.Symbol]:
    """Parameters by name."""
    return list(sm.symbols(names, real=True, seq=True))


def coordinates(names: str) -> list[sm.Expr]:
    """Dynamicsymbols as a list, also for one name."""
    return [dynamicsymbols(name) for name in names.split()]
