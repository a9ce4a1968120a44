"""Equations of motion in standard form, M(q) q̈ + h(q, q̇) = B u.  Course section 3.8."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import sympy as sm
from sympy.physics.vector import dynamicsymbols

from engdyn.algebra.ring import Element, Ring
from engdyn.errors import EngdynError
from engdyn.modeling.definiteness import Definiteness, definiteness
from engdyn.modeling.equations import EquationsOfMotion
from engdyn.modeling.model_motion import readable

__all__ = ["StandardForm", "standard_form"]


@dataclass(frozen=True, eq=False)
class StandardForm:
    """M(q) q̈ + h(q, q̇) = B u.

    Attributes
    ----------
    speeds : tuple, length m
        The rates whose derivatives M multiplies.
    inputs : tuple of dynamicsymbols, length r
        u: forces and couples in which the equations are linear.
    others : tuple of dynamicsymbols
        Inputs that stay in h: prescribed motions, and those that enter nonlinearly.
    mass, rest, gains : Element arrays
        M (m × m), h (m) and B (m × r), exact.
    """

    speeds: tuple[sm.Expr, ...]
    inputs: tuple[sm.Expr, ...]
    others: tuple[sm.Expr, ...]
    ring: Ring
    mass: tuple[tuple[Element, ...], ...]
    rest: tuple[Element, ...]
    gains: tuple[tuple[Element, ...], ...]

    @cached_property
    def mass_matrix(self) -> sm.Matrix:
        """M(q), shape (m, m), factored."""
        return sm.Matrix([[readable(entry) for entry in row] for row in self.mass])

    @cached_property
    def h(self) -> sm.Matrix:
        """All terms without accelerations and inputs, on the left, shape (m, 1)."""
        return sm.Matrix([readable(entry) for entry in self.rest])

    @property
    def velocity_terms(self) -> sm.Matrix:
        """The same as :attr:`h`: gyroscopic, centripetal, damping, stiffness and weight terms."""
        return self.h

    @cached_property
    def input_matrix(self) -> sm.Matrix:
        """B(q), shape (m, r)."""
        return sm.Matrix(len(self.rest), len(self.inputs), [readable(e) for row in self.gains for e in row])

    # Self-checks: what every mass matrix from energies must be

    @property
    def symmetric(self) -> bool:
        """Whether M equals its transpose, decided exactly."""
        pairs = ((i, j) for i in range(len(self.mass)) for j in range(i))
        return all(self.mass[i][j].equals(self.mass[j][i]) for i, j in pairs)

    @property
    def positive_definite(self) -> bool:
        """Whether M is positive definite at all states looked at; :meth:`definiteness` says more."""
        return bool(self.definiteness())

    def definiteness(self, values: Mapping[str, float] | None = None) -> Definiteness:
        """Whether every motion has kinetic energy: a verdict with a witness where it has not.

        Parameters
        ----------
        values : mapping of str to float, optional
            Parameters by name [SI]; without them positive numbers are tried for every parameter.
        """
        if not self.symmetric:
            return Definiteness("undecided", "the mass matrix is not symmetric: combine the rows first")
        return definiteness(self.mass, values)

    def __repr__(self) -> str:
        names = ", ".join(u.func.__name__ for u in self.inputs) or "none"
        return f"StandardForm(M {len(self.mass)} × {len(self.mass)}; inputs: {names})"

    def _repr_latex_(self) -> str:
        from sympy.physics.vector.printing import vlatex

        rates = sm.Matrix([u.diff(dynamicsymbols._t) for u in self.speeds])
        right = f"{vlatex(self.input_matrix)} {vlatex(sm.Matrix(self.inputs))}" if self.inputs else "0"
        return f"$\\displaystyle {vlatex(self.mass_matrix)} {vlatex(rates)} + {vlatex(self.h)} = {right}$"


def standard_form(eom: EquationsOfMotion) -> StandardForm:
    """Write equations of motion as M(q) q̈ + h(q, q̇) = B u.

    Parameters
    ----------
    eom : EquationsOfMotion

    Returns
    -------
    StandardForm

    Raises
    ------
    EngdynError
        Something that is not EquationsOfMotion.

    Notes
    -----
    Course section 3.8.  M of Lagrange's equations is symmetric, and positive definite unless a motion
    has no kinetic energy: two checks that find many slips.

    Examples
    --------
    >>> import engdyn as ed, sympy as sm
    >>> from sympy.physics.mechanics import dynamicsymbols
    >>> x, F = dynamicsymbols("x F")
    >>> m, k = sm.symbols("m k", positive=True)
    >>> form = ed.standard_form(ed.lagrange(m * x.diff() ** 2 / 2, k * x**2 / 2, [x], 0, {x: F}))
    >>> form.mass_matrix, form.h, form.input_matrix
    (Matrix([[m]]), Matrix([[k*x(t)]]), Matrix([[1]]))
    """
    if not isinstance(eom, EquationsOfMotion):
        raise EngdynError(
            f"{eom!r} is not EquationsOfMotion: make them with lagrange, newton_euler or from_residuals"
        )
    inputs = _linear_inputs(eom)
    keys = [("function", w, 0) for w in inputs]
    partials = [eom.ring.partial(key) for key in keys]
    gains = tuple(tuple(partial(f) for partial in partials) for f in eom.force)
    rest = []
    for f, row in zip(eom.force, gains, strict=True):
        for gain, key in zip(row, keys, strict=True):
            f = f - gain * eom.ring.generator(key)
        rest.append(-f)
    others = tuple(w for w in eom.inputs if w not in inputs)
    return StandardForm(eom.speeds, inputs, others, eom.ring, eom.mass, tuple(rest), gains)


def _linear_inputs(eom: EquationsOfMotion) -> tuple[sm.Expr, ...]:
    """Inputs without derivatives, in which all forces are linear, and on which M does not depend."""
    ring, occurring = eom.ring, set(eom.occurring)
    moving = {key[1] for key in occurring if key[0] == "function" and key[2] > 0}
    inertia = {ring.keys[i] for i in ring.independent(entry for row in eom.mass for entry in row)}
    candidates = [w for w in eom.inputs if w not in moving and ("function", w, 0) not in inertia]
    found = []
    for w in candidates:
        slopes = [ring.partial(("function", w, 0))(f) for f in eom.force]
        keys = {ring.keys[i] for i in ring.independent(slopes)}
        if not any(("function", other, 0) in keys for other in candidates):
            found.append(w)
    return tuple(found)
