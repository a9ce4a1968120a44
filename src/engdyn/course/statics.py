"""What remains of a system's equations of motion at rest or in steady motion.  Course chapter 4."""

from __future__ import annotations

from collections.abc import Sequence

import sympy as sm
from sympy.physics.vector import dynamicsymbols

from engdyn.algebra.expressions import as_expression
from engdyn.system import System

__all__ = ["linear_solution", "small_angle", "steady_residuals"]


def steady_residuals(system: System) -> list[sm.Expr]:
    """Residuals with all rates and accelerations zero, inputs zero, drive angles at constant speed.

    Returns
    -------
    list of sympy.Expr
        One per equation, in the coordinates and parameters alone; zero at an equilibrium.
    """
    t = dynamicsymbols._t
    eom = system.equations
    replaced: dict[sm.Expr, sm.Expr] = {}
    for moving in (*system.inputs, *system.coordinates):
        default = getattr(moving, "default", None) or (sm.S.Zero, sm.S.Zero, sm.S.Zero)
        for order, part in enumerate(default):
            if order or moving in system.inputs:
                replaced[moving.symbol.diff(t, order) if order else moving.symbol] = as_expression(part)
    return [sm.expand_trig(-force.xreplace(replaced)) for force in eom.forcing]


def small_angle(expr: sm.Expr, angle: sm.Expr) -> sm.Expr:
    """An expression with sin(angle) → angle and cos(angle) → 1."""
    return expr.xreplace({sm.sin(angle): angle, sm.cos(angle): sm.S.One})


def linear_solution(equations: Sequence[sm.Expr], unknowns: Sequence[sm.Expr]) -> dict[sm.Expr, sm.Expr]:
    """Solution of equations that are linear in their unknowns."""
    dummies = [sm.Dummy(f"x{i}") for i in range(len(unknowns))]
    rows = [e.xreplace(dict(zip(unknowns, dummies, strict=True))) for e in equations]
    (found,) = sm.linsolve(rows, dummies)
    return dict(zip(unknowns, found, strict=True))
