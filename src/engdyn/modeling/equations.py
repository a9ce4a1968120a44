"""Equations of motion in standard form, M(q, t) u̇ = f(q, u, t) with q̇ = G(q) u + g(q, t).

The nouns that Part I hands to everything after it.  Course section 3.8.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np
import sympy as sm
from sympy.physics.vector import dynamicsymbols

from engdyn.algebra.codegen import compile_elements
from engdyn.algebra.expressions import as_expression
from engdyn.algebra.readable import expression
from engdyn.algebra.ring import Element, Ring
from engdyn.errors import EngdynError
from engdyn.modeling.constrained import Constrained
from engdyn.modeling.energy_balance import Energies
from engdyn.modeling.state import State, check_coordinates

__all__ = ["EquationsOfMotion"]


@dataclass(frozen=True, eq=False)
class EquationsOfMotion:
    """Equations of motion M u̇ = f with the kinematics q̇ = G u + g.

    Made by :func:`engdyn.newton_euler`, :func:`engdyn.lagrange` or :meth:`from_residuals`.

    Attributes
    ----------
    coordinates : tuple of dynamicsymbols, length n
    speeds : tuple, length m
        Rates of the coordinates, or quasi-velocities; m < n for nonholonomic systems.
    ring : Ring
        The algebra in which mass, force and rates are held.
    mass, force, rates : Element arrays
        M (m × m), f (m), q̇ (n), exact.
    origin : str
        Where the equations come from ("Newton-Euler", "Lagrange", "residuals").
    defaults : mapping
        Prescribed motion → (value, rate, acceleration) expressions that hold where it is not given.
    constrained : Constrained or None
        Under velocity constraints, the equations before they were projected: numbers come from them.
    energies : Energies or None
        What Lagrange's equations were derived from: lets a simulation draw up its balance of energy.
    """

    coordinates: tuple[sm.Expr, ...]
    speeds: tuple[sm.Expr, ...]
    ring: Ring
    mass: tuple[tuple[Element, ...], ...]
    force: tuple[Element, ...]
    rates: tuple[Element, ...]
    origin: str
    solve_reactions: Callable[[], dict[sm.Symbol, sm.Expr]] | None = None
    defaults: Mapping[sm.Expr, tuple[sm.Expr, sm.Expr, sm.Expr]] = field(default_factory=dict)
    constrained: Constrained | None = None
    energies: Energies | None = None

    @classmethod
    def from_residuals(
        cls, equations: Iterable[sm.Expr | sm.Eq], coordinates: Sequence[sm.Expr]
    ) -> EquationsOfMotion:
        """Your own equations of motion, each an expression that is zero (or a sympy ``Eq``).

        Parameters
        ----------
        equations : iterable of sympy.Expr or sympy.Eq, length n
            Linear in the accelerations, in any order, with any common factor.
        coordinates : sequence of dynamicsymbols, length n

        Returns
        -------
        EquationsOfMotion
            Ready for :func:`engdyn.prove_equal` and everything after it.

        Raises
        ------
        EngdynError
            Another number of equations than coordinates, accelerations not linear or missing.
        """
        coordinates = check_coordinates(coordinates)
        residuals = [_residual(e) for e in ([equations] if isinstance(equations, sm.Basic) else equations)]
        if len(residuals) != len(coordinates):
            raise EngdynError(
                f"{len(residuals)} equations for {len(coordinates)} coordinates: give one equation of motion each"
            )
        state = State(coordinates, residuals)
        rows = [state.convert(r) for r in residuals]
        partials = state.acceleration_partials()
        mass = tuple(tuple(partial(row) for partial in partials) for row in rows)
        force = []
        for row, line in zip(rows, mass, strict=True):
            for entry, key in zip(line, state.acceleration_keys, strict=True):
                row = row - entry * state.ring.generator(key)
            force.append(-row)
        return cls.from_elements(state, mass, force, "residuals")

    @classmethod
    def from_elements(
        cls,
        state: State,
        mass: Sequence[Sequence[Element]],
        force: Sequence[Element],
        origin: str,
        solve_reactions: Callable[[], dict[sm.Symbol, sm.Expr]] | None = None,
    ) -> EquationsOfMotion:
        """Equations from ring elements, after a check that they are linear and every speed has inertia."""
        mass, rates = _mirrored(mass), state.rate_elements()
        _check_linear(state, [*(e for row in mass for e in row), *force, *rates])
        for j, u in enumerate(state.speeds):
            if all(row[j].is_zero() for row in mass):
                raise EngdynError(
                    f"singular mass matrix: no equation contains the acceleration of {u}; give that coordinate inertia "
                    "or remove it with the equation that fixes it"
                )
        return cls(
            state.coordinates,
            state.speeds,
            state.ring,
            tuple(tuple(row) for row in mass),
            tuple(force),
            tuple(rates),
            origin,
            solve_reactions,
        )

    # What the equations say, as sympy expressions (built when first asked for)

    @cached_property
    def mass_matrix(self) -> sm.Matrix:
        """M(q, t), shape (m, m), factored."""
        m = len(self.mass)
        return sm.Matrix(m, m, [expression(entry) for row in self.mass for entry in row])

    @cached_property
    def forcing(self) -> sm.Matrix:
        """f(q, u, t), shape (m, 1), factored."""
        return sm.Matrix(len(self.force), 1, [expression(entry) for entry in self.force])

    @cached_property
    def kinematics(self) -> sm.Matrix:
        """q̇ = G u + g as expressions, shape (n, 1)."""
        return sm.Matrix(len(self.rates), 1, [expression(entry) for entry in self.rates])

    @cached_property
    def reactions(self) -> dict[sm.Symbol, sm.Expr]:
        """Each unknown reaction in terms of q, q̇ and the accelerations (of the constraints after Lagrange)."""
        return self.solve_reactions() if self.solve_reactions else {}

    @cached_property
    def inputs(self) -> tuple[sm.Expr, ...]:
        """Dynamicsymbols that are neither coordinate nor speed: forces, couples, prescribed motions."""
        own = {*self.coordinates, *self.speeds}
        found = {key[1] for key in self.occurring if key[0] == "function"} - own
        return tuple(sorted(found, key=lambda f: f.func.__name__))

    @cached_property
    def parameters(self) -> tuple[sm.Symbol, ...]:
        """Symbols of the equations, sorted by name (those of the defaults included)."""
        found = {key[1] for key in self.occurring if key[0] == "symbol"}
        for default in self.defaults.values():
            found |= {
                s for part in default for s in as_expression(part, "the default of an input").free_symbols
            }
        return tuple(sorted(found - {dynamicsymbols._t, sm.pi}, key=lambda s: s.name))

    @cached_property
    def occurring(self) -> tuple[tuple, ...]:
        """Keys of the independent generators that the equations contain, those inside angles too."""
        elements = [*(e for row in self.mass for e in row), *self.force, *self.rates]
        return tuple(self.ring.keys[i] for i in self.ring.independent(elements))

    # Numbers

    @cached_property
    def arguments(self) -> tuple[tuple, ...]:
        """Generator keys in the order in which compiled functions take their values: q, u, parameters, inputs, t."""
        speeds = [(u.expr, 1) if isinstance(u, sm.Derivative) else (u, 0) for u in self.speeds]
        return (
            *(("function", q, 0) for q in self.coordinates),
            *(("function", *u) for u in speeds),
            *(("symbol", p) for p in self.parameters),
            *(("function", w, k) for w in self.inputs for k in (0, 1, 2)),
            ("symbol", dynamicsymbols._t),
        )

    def compiled(self, target: str) -> Callable[..., tuple]:
        """Compiled M, f and q̇ (flat, in that order) of the scalar :attr:`arguments`."""
        cache = self.__dict__.setdefault("_compiled", {})
        if target not in cache and self.constrained is not None and target in ("math", "numpy"):
            cache[target] = self.constrained.compiled(self.arguments, target)
        if cache.get(target) is None:
            elements = [*(e for row in self.mass for e in row), *self.force, *self.rates]
            cache[target] = compile_elements(elements, self.arguments, target)
        return cache[target]

    def accelerations(
        self,
        q: Any,
        u: Any,
        values: Mapping[str, float],
        inputs: Mapping[str, Any] | None = None,
        t: float = 0.0,
    ) -> np.ndarray:
        """Accelerations u̇ at given states.

        Parameters
        ----------
        q : array_like, shape (n,) or (..., n)
            Coordinates in the order of :attr:`coordinates` [m, rad].
        u : array_like, shape (m,) or (..., m)
            Speeds [m/s, rad/s].
        values : mapping of str to float
            Parameters by name [SI].
        inputs : mapping, optional
            Input name → number, or (value, rate, acceleration) of a prescribed motion; zero where
            not given.
        t : float
            Time [s].

        Returns
        -------
        numpy.ndarray, shape (m,) or (..., m)

        Raises
        ------
        EngdynError
            Missing parameters, wrong shapes, a singular mass matrix, results that are not finite.
        """
        from engdyn.modeling.numbers import accelerations

        return accelerations(self, q, u, values, inputs, t)

    def function(self, values: Mapping[str, float]) -> Callable[..., np.ndarray]:
        """State derivative ``f(t, x, inputs=None)`` for integrators, x = (q, u).

        Parameters
        ----------
        values : mapping of str to float
            Parameters by name [SI].
        """
        from engdyn.modeling.numbers import state_derivative

        return state_derivative(self, values)

    def __repr__(self) -> str:
        names = ", ".join(q.func.__name__ for q in self.coordinates)
        count = len(self.speeds)
        return f"EquationsOfMotion({names}; {count} equation{'s' * (count != 1)}, from {self.origin})"

    def _repr_latex_(self) -> str:
        from sympy.physics.vector.printing import vlatex

        udot = sm.Matrix([u.diff(dynamicsymbols._t) for u in self.speeds])
        return f"$\\displaystyle {vlatex(self.mass_matrix)} {vlatex(udot)} = {vlatex(self.forcing)}$"


def _mirrored(mass: Sequence[Sequence[Element]]) -> list[list[Element]]:
    """The mass matrix with one element for equal entries on both sides of its diagonal."""
    found: list[list[Element]] = []
    for i, row in enumerate(mass):
        found.append([found[j][i] if j < i and e.equals(mass[j][i]) else e for j, e in enumerate(row)])
    return found


def _residual(equation: Any) -> sm.Expr:
    if isinstance(equation, sm.Equality):
        return equation.lhs - equation.rhs
    if isinstance(equation, sm.Expr):
        return equation
    if isinstance(equation, int | float):
        return as_expression(equation)
    raise EngdynError(
        f"{equation!r} is not an equation: give sympy expressions that are zero, or sympy.Eq(left, right)"
    )


def _check_linear(state: State, elements: Sequence[Element]) -> None:
    """Nothing but coordinates and speeds may be left of the motion in M and f."""
    own = {key[1] for key in state.speed_keys} | set(state.coordinates)
    allowed = {("function", q, 0) for q in state.coordinates} | set(state.speed_keys)
    for i in state.ring.independent(elements):
        key = state.ring.keys[i]
        if key[0] != "function" or key[1] not in own or key in allowed:
            continue
        if key in state.acceleration_keys:
            raise EngdynError(
                "the equations are not linear in the accelerations: solve products and powers of them first"
            )
        raise EngdynError(
            f"the equations contain the time derivative of order {key[2]} of {key[1]}, which is neither a coordinate "
            "nor a speed: write it in terms of these"
        )
