"""Tools that are timed on the same work must give the same accelerations: compared at a random state."""

from __future__ import annotations

import random
from collections.abc import Mapping

import numpy as np
import sympy as sm
from sympy.core.function import AppliedUndef
from sympy.physics.mechanics import dynamicsymbols

from benchmarks.models import Equations, Model

TOLERANCE = 1e-9


def check(model: Model, equations: Mapping[str, Equations]) -> None:
    """Raise where the accelerations that follow from M and f differ at a random state.

    Parameters
    ----------
    model : Model
    equations : mapping of tool to (mass matrix, forcing)
        The first one is what the others are compared with.
    """
    t, n = dynamicsymbols._t, len(model.coordinates)
    rates = dict(zip(dynamicsymbols(f"u:{n}"), (q.diff(t) for q in model.coordinates), strict=True))
    found = {
        tool: np.linalg.solve(*(_numbers(part.xreplace(rates)) for part in parts))[:, 0]
        for tool, parts in equations.items()
    }
    expected = next(iter(found.values()))
    for tool, values in found.items():
        if np.max(np.abs(values - expected)) > TOLERANCE * (1.0 + np.max(np.abs(expected))):
            raise AssertionError(f"{model.name}: {tool} gives {values}, not {expected}")


def _numbers(matrix: sm.Matrix) -> np.ndarray:
    """The matrix where every symbol, function and rate has a value that its name decides."""
    atoms = matrix.atoms(sm.Derivative) | matrix.atoms(AppliedUndef) | matrix.free_symbols
    values = {atom: random.Random(str(atom)).uniform(0.5, 1.5) for atom in atoms}
    return np.array(matrix.xreplace(values).evalf().tolist(), dtype=float)
