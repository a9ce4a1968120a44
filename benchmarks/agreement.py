"""Before tools are timed on the same work: do their equations of motion agree?"""

from __future__ import annotations

import random
from collections.abc import Callable
from typing import Any

import numpy as np
import sympy as sm
from sympy.core.function import AppliedUndef
from sympy.physics.mechanics import dynamicsymbols

from benchmarks.models import Model, engdyn_equations, kane, lagrangian

TOLERANCE = 1e-9


def check(make: Callable[[], Model]) -> None:
    """Raise where the accelerations of the three derivations differ at a random state.

    Parameters
    ----------
    make : callable
        Returns the model anew.
    """
    expected = _engdyn(make())
    for name, tool in (("LagrangesMethod", _lagrange), ("KanesMethod", _kane)):
        found = tool(make())
        if np.max(np.abs(found - expected)) > TOLERANCE * (1.0 + np.max(np.abs(expected))):
            raise AssertionError(f"{make().name}: {name} gives {found}, engdyn {expected}")


def _engdyn(model: Model) -> np.ndarray:
    eom = engdyn_equations(model)[1]
    return _solved(eom.mass_matrix, eom.forcing, model.coordinates)


def _lagrange(model: Model) -> np.ndarray:
    method = lagrangian(model)
    return _solved(method.mass_matrix, method.forcing, model.coordinates)


def _kane(model: Model) -> np.ndarray:
    method = kane(model)
    t = dynamicsymbols._t
    rates = {u: q.diff(t) for u, q in zip(method.u, model.coordinates, strict=True)}
    return _solved(method.mass_matrix.subs(rates), method.forcing.subs(rates), model.coordinates)


def _solved(mass: sm.Matrix, forcing: sm.Matrix, coordinates: list[Any]) -> np.ndarray:
    """M⁻¹ f where every symbol, function and rate has a value that its name decides."""
    found = [
        np.array(matrix.xreplace(_values(matrix)).evalf().tolist(), dtype=float) for matrix in (mass, forcing)
    ]
    return np.linalg.solve(found[0], found[1])[:, 0]


def _values(matrix: sm.Matrix) -> dict[sm.Expr, float]:
    atoms = matrix.atoms(sm.Derivative) | matrix.atoms(AppliedUndef) | matrix.free_symbols
    return {atom: random.Random(str(atom)).uniform(0.5, 1.5) for atom in atoms}
