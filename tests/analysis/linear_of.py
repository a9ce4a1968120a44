"""Linear systems with given matrices, for tests of modes."""

from __future__ import annotations

import numpy as np
import sympy as sm
from sympy.physics.mechanics import dynamicsymbols

import engdyn as ed

__all__ = ["linear_of", "linearized"]


def linear_of(mass, damping, stiffness):
    """M ẍ + C ẋ + K x = 0 with these numbers, exactly."""
    q = sm.Matrix(dynamicsymbols(f"x1:{len(mass) + 1}"))
    t = dynamicsymbols._t
    parts = zip((mass, damping, stiffness), (q.diff(t, 2), q.diff(t), q), strict=True)
    rows = sum(
        (sm.Matrix(np.array(m, float)).applyfunc(sm.Rational) * x for m, x in parts), sm.zeros(len(q), 1)
    )
    return ed.linearize(ed.EquationsOfMotion.from_residuals(list(rows), list(q)), {}, {})


def linearized(key, number=0, **changes):
    """A system of the catalogue about one of its equilibria."""
    system = ed.systems.load(key)
    return ed.linearize(system.equations, system.equilibria(system.values(**changes))[number])
