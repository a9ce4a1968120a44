"""Where energy comes from and goes to: powers of forces, dampers and prescribed motions, from the energies.

Along a motion dE/dt = Q·q̇ + P − P_D with E = T + V.  P_D = ∂D/∂q̇·q̇ + ∂D/∂ẇ·ẇ is dissipated, and P is the power of
whatever prescribes the motions w, time itself and moving constraints:

    P = d/dt(2T − ∂T/∂q̇·q̇) − ∂L/∂t + ∂D/∂ẇ·ẇ + λ·(∂c/∂q̇·q̇),   L = T − V,

with ∂L/∂t through w and t alone.  The bracket, 2T₀ + T₁ by powers of q̇, vanishes where nothing is prescribed
(Jacobi's integral).  Course sections 3.7 and 8.9.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

import sympy as sm
from sympy.physics.vector import dynamicsymbols

from engdyn.algebra.expressions import as_expression
from engdyn.algebra.scan import key_to_sympy

if TYPE_CHECKING:
    from engdyn.modeling.equations import EquationsOfMotion

__all__ = ["Energies", "Powers"]


@dataclass(frozen=True, eq=False)
class Powers:
    """Energies and powers as expressions in coordinates, rates, accelerations, inputs, parameters and t.

    Attributes
    ----------
    kinetic, potential : sympy.Expr
        [J].
    dissipated, forces, motions : sympy.Expr
        P_D, Q·q̇, and P without the part that is integrated already [W].
    moved : sympy.Expr
        That part, 2T₀ + T₁ [J].
    """

    kinetic: sm.Expr
    potential: sm.Expr
    dissipated: sm.Expr
    forces: sm.Expr
    motions: sm.Expr
    moved: sm.Expr


@dataclass(frozen=True, eq=False)
class Energies:
    """What Lagrange's equations were derived from: T, V, D, Q and velocity constraints."""

    kinetic: sm.Expr
    potential: sm.Expr
    dissipation: sm.Expr
    forces: Mapping[sm.Expr, sm.Expr]
    constraints: tuple[sm.Expr, ...] = ()

    def powers(self, eom: EquationsOfMotion) -> Powers:
        """The terms of the balance of energy."""
        t = dynamicsymbols._t
        T, V, D = (as_expression(e) for e in (self.kinetic, self.potential, self.dissipation))
        moving = [*eom.coordinates, *eom.inputs]
        atoms = {key_to_sympy(("function", f, k)): sm.Dummy() for f in moving for k in (2, 1, 0)}
        back = {dummy: atom for atom, dummy in atoms.items()}

        def slope(expr: sm.Expr, by: sm.Expr) -> sm.Expr:
            """Partial derivative: all other functions of time stand still."""
            return sm.diff(expr.xreplace(atoms), atoms.get(by, by)).xreplace(back)

        def by_rates(expr: sm.Expr, functions: tuple[sm.Expr, ...]) -> sm.Expr:
            return sm.Add(*(slope(expr, f.diff(t)) * f.diff(t) for f in functions))

        q, w = eom.coordinates, eom.inputs
        orders = [(f.diff(t, k), f.diff(t, k + 1)) for f in w for k in (0, 1)]
        explicit = slope(T - V, t) + sm.Add(*(slope(T - V, at) * rate for at, rate in orders))
        multipliers = [
            eom.reactions.get(sm.Symbol(f"lambda_{i + 1}"), 0) for i in range(len(self.constraints))
        ]
        held = sm.Add(*(x * by_rates(c, q) for x, c in zip(multipliers, self.constraints, strict=True)))
        return Powers(
            kinetic=T,
            potential=V,
            dissipated=by_rates(D, (*q, *w)),
            forces=sm.Add(*(Q * f.diff(t) for f, Q in self.forces.items())),
            motions=by_rates(D, w) - explicit + held,
            moved=2 * T - by_rates(T, q),
        )
