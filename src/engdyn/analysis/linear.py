"""Linear equations of small motion about an equilibrium or a steady motion.

Everything comes from the complete residual R = M u̇ − f: the derivatives of M(q) u̇ and of the
velocity terms are included, and nothing is made symmetric that physics leaves unsymmetric.
Course section 5.3.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import sympy as sm
from sympy.physics.vector import dynamicsymbols

from engdyn.algebra.readable import to_sympy, tree
from engdyn.analysis.equilibrium import Equilibrium
from engdyn.analysis.small_motion import (
    BLOCKS,
    assemble,
    block_shapes,
    compiled_blocks,
    motion_keys,
    small_motion,
    unpacked,
)
from engdyn.errors import EngdynError
from engdyn.modeling.equations import EquationsOfMotion
from engdyn.modeling.numbers import input_values, mass_and_force, parameter_values

__all__ = ["LinearSystem", "eigenvalues", "linearize", "sorted_eigenvalues"]


@dataclass(frozen=True, eq=False, repr=False)
class LinearSystem:
    """M ẍ + C ẋ + K x = B₀ w + B₁ ẇ + B₂ ẅ for small deviations x, and its state matrix.

    Attributes
    ----------
    mass, damping : ndarray or sympy.Matrix, shape (m, m)
    stiffness : ndarray or sympy.Matrix, shape (m, n)
        −∂f/∂q + ∂(M u̇)/∂q; m = n unless the system is nonholonomic.
    input_matrices : tuple of three arrays, shape (m, number of inputs)
        Acting on value, rate and acceleration of each input.
    state_matrix : ndarray or sympy.Matrix, shape (n + m, n + m)
        A in ẋ = A x for the state (q, u).
    coordinates, inputs : tuple of str
    eom : EquationsOfMotion
    at : Equilibrium or mapping
        Where the equations were linearized.
    """

    mass: Any
    damping: Any
    stiffness: Any
    input_matrices: tuple[Any, Any, Any]
    state_matrix: Any
    coordinates: tuple[str, ...]
    inputs: tuple[str, ...]
    eom: EquationsOfMotion
    at: Any

    def __repr__(self) -> str:
        return f"LinearSystem({', '.join(self.coordinates)}; about {self.at!r})"

    def _repr_latex_(self) -> str:
        parts = [("M", self.mass), ("C", self.damping), ("K", self.stiffness)]
        shown = [f"{name} = {sm.latex(_rounded(matrix))}" for name, matrix in parts]
        return "$\\displaystyle " + ",\\quad ".join(shown) + "$"


def _rounded(matrix: Any) -> sm.Matrix:
    if isinstance(matrix, np.ndarray):
        return sm.Matrix(
            matrix.shape[0], matrix.shape[1], lambda i, j: sm.Float(f"{matrix[i, j] + 0.0:.5g}", 5)
        )
    return matrix


def linearize(
    eom: EquationsOfMotion,
    at: Equilibrium | Mapping[str, Any],
    values: Mapping[str, float] | None = None,
    inputs: Mapping[str, Any] | None = None,
    symbolic: bool = False,
) -> LinearSystem:
    """Linearize equations of motion about an equilibrium or a steady motion.

    Parameters
    ----------
    eom : EquationsOfMotion
    at : Equilibrium, or mapping of coordinate name to value
        A mapping is a state of rest; what it does not name is zero.
    values : mapping of str to float, optional
        Parameters by name [SI]; those of `at` where not given.
    inputs : mapping, optional
        Inputs by name; those of `at` where not given.
    symbolic : bool
        Keep the parameters as symbols; the values in `at` may then be expressions.

    Returns
    -------
    LinearSystem
        Arrays, or sympy matrices where `symbolic`.

    Raises
    ------
    EngdynError
        Missing values, unknown coordinates, a singular mass matrix, coefficients that depend on time.

    Notes
    -----
    Course sections 5.2 and 5.3.
    """
    if not isinstance(eom, EquationsOfMotion):
        raise EngdynError(f"eom is {eom!r}: give EquationsOfMotion, for example system.lagrange()")
    state = _state_at(eom, at)
    given = inputs if inputs is not None else (at.inputs if isinstance(at, Equilibrium) else {})
    if symbolic:
        matrices = _symbolic(eom, state, given)
    else:
        if values is None:
            if not isinstance(at, Equilibrium):
                raise EngdynError("give values: a mapping of coordinates carries no parameters")
            values = at.values
        matrices = _numeric(eom, state, values, given)
        at = _as_equilibrium(eom, state, values, given)
    names = tuple(q.func.__name__ for q in eom.coordinates)
    return LinearSystem(*matrices, names, tuple(w.func.__name__ for w in eom.inputs), eom, at)


def _state_at(eom: EquationsOfMotion, at: Any) -> list[Any]:
    """q, u and u̇ in one list."""
    n, m = len(eom.coordinates), len(eom.speeds)
    if isinstance(at, Equilibrium):
        return [*at.q, *at.speeds, *at.accelerations]
    if not isinstance(at, Mapping):
        raise EngdynError(f"at is {at!r}: give an Equilibrium, or a mapping of coordinate names to values")
    names = [q.func.__name__ for q in eom.coordinates]
    given = {(k if isinstance(k, str) else k.func.__name__): v for k, v in at.items()}
    unknown = [k for k in given if k not in names]
    if unknown:
        raise EngdynError(f"at names {unknown}: the coordinates are {', '.join(names)}")
    return [*(given.get(name, 0) for name in names), *([0] * (2 * m))][: n + 2 * m]


def _as_equilibrium(
    eom: EquationsOfMotion, state: list[Any], values: Mapping[str, float], given: Mapping[str, Any]
) -> Equilibrium:
    """The state of linearization with the parameters and inputs that were used."""
    n, m = len(eom.coordinates), len(eom.speeds)
    q, u, udot = (
        np.array([float(x) for x in part]) for part in (state[:n], state[n : n + m], state[n + m :])
    )
    mass, force = mass_and_force(eom, q, u, values, given)
    residual = float(np.max(np.abs(mass @ udot - force), initial=0.0))
    names = tuple(c.func.__name__ for c in eom.coordinates)
    return Equilibrium(q, u, udot, dict(given), dict(values), residual, names)


def _numeric(
    eom: EquationsOfMotion, state: list[Any], values: Mapping[str, float], given: Mapping[str, Any]
) -> tuple:
    n, m = len(eom.coordinates), len(eom.speeds)
    try:
        q, u, udot = state[:n], state[n : n + m], [float(x) for x in state[n + m :]]
        moved = [float(x) for x in (*q, *u)]
    except (TypeError, ValueError) as error:
        raise EngdynError(f"at holds {state}: give numbers, or ask for symbolic=True") from error
    rest = [*parameter_values(eom, values), *input_values(eom, given, values), 0.0]
    flat = np.array(compiled_blocks(eom, "math")(*moved, *rest, *udot), dtype=float)
    blocks = unpacked(eom, flat)
    if not np.all(np.isfinite(flat)):
        raise EngdynError(
            "the linearized equations are not finite there: a root or a quotient has no derivative"
        )
    state_matrix = assemble(blocks)
    force = (-blocks["B0"], -blocks["B1"], -blocks["B2"])
    return blocks["M"], blocks["C"], blocks["K"], tuple(b + 0.0 for b in force), state_matrix


def _symbolic(eom: EquationsOfMotion, state: list[Any], given: Mapping[str, Any]) -> tuple:
    t = dynamicsymbols._t
    q_keys, u_keys, a_keys = motion_keys(eom)
    replaced: dict[sm.Expr, sm.Expr] = {}
    for key, value in zip([*q_keys, *u_keys, *a_keys], state, strict=True):
        replaced[key[1] if key[2] == 0 else sm.Derivative(key[1], (t, key[2]))] = sm.sympify(value)
    for w in eom.inputs:
        triple = given.get(w.func.__name__, eom.defaults.get(w, 0))
        triple = triple if isinstance(triple, Sequence) else (triple, 0, 0)
        for k, value in enumerate(triple):
            replaced[sm.Derivative(w, (t, k)) if k else w] = sm.sympify(value)
    ordered = sorted(replaced, key=lambda e: -e.derivative_count if e.is_Derivative else 0)

    def matrix(name: str) -> sm.Matrix:
        rows = small_motion(eom)[name]
        shape = block_shapes(eom)[name]
        entries = [to_sympy(tree(entry)) for row in rows for entry in row]
        entries = [entry.xreplace({key: replaced[key] for key in ordered}) for entry in entries]
        return sm.Matrix(*shape, [sm.factor_terms(entry) for entry in entries])

    blocks = {name: matrix(name) for name in BLOCKS}
    left = [e for block in blocks.values() for e in block if e.has(t, sm.Derivative)]
    if left:
        raise EngdynError(
            f"linearized coefficients depend on time: {left[0]}; linearize about a steady motion"
        )
    inverse = blocks["M"].LUsolve(blocks["K"].row_join(blocks["C"]))
    state_matrix = blocks["Gq"].row_join(blocks["G"]).col_join(-inverse)
    return blocks["M"], blocks["C"], blocks["K"], tuple(-blocks[b] for b in ("B0", "B1", "B2")), state_matrix


def eigenvalues(linear: LinearSystem) -> np.ndarray:
    """Eigenvalues of the state matrix [1/s].

    Parameters
    ----------
    linear : LinearSystem
        With numbers, not symbols.

    Returns
    -------
    ndarray of complex, shape (n + m,)
        Sorted by falling real part, the one with positive imaginary part first.

    Notes
    -----
    Course sections 5.1 and 5.3.
    """
    if not isinstance(linear, LinearSystem) or not isinstance(linear.state_matrix, np.ndarray):
        raise EngdynError("eigenvalues needs a LinearSystem with numbers: linearize without symbolic=True")
    return sorted_eigenvalues(np.linalg.eigvals(linear.state_matrix))


def sorted_eigenvalues(found: np.ndarray) -> np.ndarray:
    """Eigenvalues along the last axis by falling real part, +imaginary before −imaginary."""
    found = np.asarray(found, dtype=complex)
    scale = np.max(np.abs(found), axis=-1, keepdims=True)
    rounded = np.round(found.real / np.where(scale == 0, 1, scale), 10)  # so that pairs keep together
    order = np.lexsort((-found.imag, -np.abs(found.imag), -rounded), axis=-1)
    return np.take_along_axis(found, order, axis=-1)
