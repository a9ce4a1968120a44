"""The derivation by Lagrange term by term, as one writes it on paper.  Course sections 3.2 to 3.7."""

from __future__ import annotations

import warnings
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import sympy as sm

from engdyn.algebra.ring import Element
from engdyn.errors import EngdynWarning
from engdyn.modeling.definiteness import definiteness
from engdyn.modeling.equations import EquationsOfMotion
from engdyn.modeling.model_motion import readable
from engdyn.modeling.nonholonomic import multiplier_symbols
from engdyn.modeling.state import State

__all__ = ["LagrangeSteps", "lagrange_steps"]


@dataclass(frozen=True, eq=False)
class LagrangeSteps:
    """d/dt(∂T/∂q̇) − ∂T/∂q + ∂V/∂q + ∂D/∂q̇ = Q + Aᵀ λ with every term at hand.

    All columns have the shape (n, 1), in the order of the coordinates, and hold factored expressions.

    Attributes
    ----------
    coordinates : tuple of dynamicsymbols, length n
    kinetic, potential, dissipation : sympy.Expr
        T, V and D as they were given.
    forces : sympy.Matrix
        Generalized forces Q.
    constraints : tuple of expressions
        Velocity constraints = 0.
    equations_of_motion : EquationsOfMotion
    """

    coordinates: tuple[sm.Expr, ...]
    kinetic: sm.Expr
    potential: sm.Expr
    dissipation: sm.Expr
    forces: sm.Matrix
    constraints: tuple[sm.Expr, ...]
    equations_of_motion: EquationsOfMotion

    @cached_property
    def _state(self) -> State:
        terms = [self.kinetic, self.potential, self.dissipation, *self.constraints]
        return State(self.coordinates, terms, substitute=False, moving=[self.kinetic])

    def _gradient(self, energy: sm.Expr, order: int) -> list[Element]:
        """∂/∂q (order 0) or ∂/∂q̇ (order 1) of an energy."""
        element, ring = self._state.convert(energy), self._state.ring
        return [ring.partial(("function", q, order))(element) for q in self.coordinates]

    @cached_property
    def momenta(self) -> sm.Matrix:
        """∂T/∂q̇, the generalized momenta."""
        return _column(self._gradient(self.kinetic, 1))

    @cached_property
    def momentum_rates(self) -> sm.Matrix:
        """d/dt(∂T/∂q̇): every q and q̇ in the momenta depends on time."""
        return _column([self._state.time_derivative(p) for p in self._gradient(self.kinetic, 1)])

    @cached_property
    def kinetic_gradient(self) -> sm.Matrix:
        """∂T/∂q."""
        return _column(self._gradient(self.kinetic, 0))

    @cached_property
    def potential_gradient(self) -> sm.Matrix:
        """∂V/∂q."""
        return _column(self._gradient(self.potential, 0))

    @cached_property
    def dissipation_gradient(self) -> sm.Matrix:
        """∂D/∂q̇."""
        return _column(self._gradient(self.dissipation, 1))

    @property
    def multipliers(self) -> dict[sm.Symbol, sm.Expr]:
        """Each multiplier lambda_1, … in terms of the motion (empty without constraints)."""
        return self.equations_of_motion.reactions

    @cached_property
    def constraint_forces(self) -> sm.Matrix:
        """Aᵀ λ with A = ∂c/∂q̇: what the constraints do to every coordinate."""
        symbols = multiplier_symbols(len(self.constraints))
        columns = [_column(self._gradient(c, 1)) for c in self.constraints]
        zero = sm.zeros(len(self.coordinates), 1)
        return sum((x * column for x, column in zip(symbols, columns, strict=True)), zero)

    @property
    def residuals(self) -> sm.Matrix:
        """The equations of motion, all terms on the left: a column that is zero."""
        inertia = self.momentum_rates - self.kinetic_gradient
        given = self.potential_gradient + self.dissipation_gradient
        return inertia + given - self.forces - self.constraint_forces

    def __repr__(self) -> str:
        names = ", ".join(q.func.__name__ for q in self.coordinates)
        return f"LagrangeSteps({names}; from kinetic to equations_of_motion)"

    def _repr_latex_(self) -> str:
        from sympy.physics.vector.printing import vlatex

        energies = [("T", self.kinetic), ("V", self.potential), ("D", self.dissipation)]
        rows = [f"{name} &= {vlatex(e)}" for name, e in energies if e != 0]
        columns = [
            (r"\frac{d}{dt}\frac{\partial T}{\partial \dot q}", self.momentum_rates),
            (r"\frac{\partial T}{\partial q}", self.kinetic_gradient),
            (r"\frac{\partial V}{\partial q}", self.potential_gradient),
            (r"\frac{\partial D}{\partial \dot q}", self.dissipation_gradient),
            ("Q", self.forces),
            (r"A^T\lambda", self.constraint_forces),
        ]
        rows += [f"{name} &= {vlatex(column)}" for name, column in columns if any(column)]
        return r"$\displaystyle \begin{aligned}" + r"\\".join(rows) + r"\end{aligned}$"


def _column(elements: Sequence[Element]) -> sm.Matrix:
    return sm.Matrix([readable(e) for e in elements])


def lagrange_steps(
    eom: EquationsOfMotion,
    kinetic: sm.Expr,
    potential: sm.Expr,
    dissipation: sm.Expr,
    forces: Mapping[sm.Expr, sm.Expr],
    constraints: Sequence[sm.Expr],
) -> LagrangeSteps:
    """The derivation that led to `eom`, after a look at the kinetic energy.

    Warns
    -----
    EngdynWarning
        A mass matrix that is singular, or not positive definite at some state that was looked at.
    """
    verdict = definiteness(eom.mass)
    if verdict.verdict not in ("positive definite", "undecided"):
        warnings.warn(
            f"the kinetic energy is not positive for every motion ({verdict!r}): look for a wrong sign or a "
            "coordinate without inertia, or make sure that your parameters exclude this",
            EngdynWarning,
            stacklevel=3,
        )
    column = sm.Matrix([forces[q] for q in eom.coordinates])
    return LagrangeSteps(eom.coordinates, kinetic, potential, dissipation, column, tuple(constraints), eom)
