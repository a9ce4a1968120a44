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

from engdyn.algebra.expressions import as_expression
from engdyn.analysis.equilibrium import Equilibrium
from engdyn.analysis.outputs import numeric_outputs, with_speeds
from engdyn.analysis.small_motion import assemble, compiled_blocks, unpacked
from engdyn.analysis.symbolic import symbolic_matrices, symbolic_outputs
from engdyn.errors import EngdynError
from engdyn.modeling.equations import EquationsOfMotion
from engdyn.modeling.numbers import input_values, mass_and_force, parameter_values

__all__ = ["LinearSystem", "eigenvalues", "linearize", "sorted_eigenvalues"]

MOMENTS = (0.1234, 1.3579, 7.7531)
"""Times [s] at which coefficients are compared with those at t = 0."""


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
    changing_inputs : tuple of str
        Inputs whose matrices depend on time (a force in a fixed direction, seen from turning coordinates);
        numeric input matrices hold their values at t = 0.
    outputs : tuple of str
        Names of the expressions that are observed.
    output_matrices : tuple of six arrays, shape (number of outputs, n, m, m or number of inputs)
        y = Y₀ q + Y₁ u + Y₂ u̇ + D₀ w + D₁ ẇ + D₂ ẅ; empty without outputs.
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
    changing_inputs: tuple[str, ...] = ()
    outputs: tuple[str, ...] = ()
    output_matrices: tuple[Any, ...] = ()

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
    outputs: Mapping[str, Any] | None = None,
    symbolic: bool = False,
    *,
    speeds: Sequence[Any] | None = None,
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
    outputs : mapping of str to sympy.Expr, optional
        What is observed, in coordinates with two derivatives, inputs and parameters: the force in a spring, the
        motion, speed or acceleration of a point.
    symbolic : bool
        Keep the parameters as symbols; the values in `at` may then be expressions.
    speeds : sequence of str or of rates, optional
        Of a nonholonomic system: coordinates whose rates are the speeds u; those of the equations where not given.

    Returns
    -------
    LinearSystem
        Arrays, or sympy matrices where `symbolic`. Where the coordinates fail at an equilibrium that
        knows others (a pitch of 90 degrees), small motion is described in these.

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
    if outputs is not None and not isinstance(outputs, Mapping):
        raise EngdynError(f"outputs is {outputs!r}: give a mapping of names to expressions")
    if isinstance(at, Equilibrium) and at.regular is not None:
        eom, at = at.regular
        state = _state_at(eom, at)
    given = inputs if inputs is not None else (at.inputs if isinstance(at, Equilibrium) else {})
    observed: tuple[Any, ...] = ()
    if symbolic:
        matrices = symbolic_matrices(eom, state, given)
        if outputs:
            observed = symbolic_outputs(eom, outputs, state, given)
    else:
        if values is None:
            if not isinstance(at, Equilibrium):
                raise EngdynError("give values: a mapping of coordinates carries no parameters")
            values = at.values
        matrices = _numeric(eom, state, values, given)
        if outputs:
            observed = numeric_outputs(eom, outputs, state, values, given, (0.0, *MOMENTS))
        at = _as_equilibrium(eom, state, values, given)
    *matrices, changing = matrices
    names, driven = (tuple(f.func.__name__ for f in part) for part in (eom.coordinates, eom.inputs))
    found = LinearSystem(*matrices, names, driven, eom, at, changing, tuple(outputs or ()), observed)
    return found if speeds is None else with_speeds(found, speeds)


def _state_at(eom: EquationsOfMotion, at: Any) -> list[Any]:
    """q, u and u̇ in one list."""
    n, m = len(eom.coordinates), len(eom.speeds)
    names = [q.func.__name__ for q in eom.coordinates]
    if isinstance(at, Equilibrium):
        if list(at.names) != names:
            raise EngdynError(
                f"at has the coordinates {', '.join(at.names)}, the equations {', '.join(names)}"
            )
        return [*at.q, *at.speeds, *at.accelerations]
    if not isinstance(at, Mapping):
        raise EngdynError(f"at is {at!r}: give an Equilibrium, or a mapping of coordinate names to values")
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
    """Matrices as arrays, at t = 0, and the inputs whose matrices change in time."""
    split = len(eom.coordinates) + len(eom.speeds)
    try:
        moved, udot = [float(x) for x in state[:split]], [float(x) for x in state[split:]]
    except (TypeError, ValueError) as error:
        raise EngdynError(f"at holds {state}: give numbers, or ask for symbolic=True") from error
    if not np.all(np.isfinite([*moved, *udot])):
        raise EngdynError(f"at holds {state}: give finite numbers")
    parameters = parameter_values(eom, values)

    def blocks_at(t: float) -> dict[str, np.ndarray]:
        rest = [*parameters, *input_values(eom, given, values, t), t]
        try:
            flat = np.array(compiled_blocks(eom, "math")(*moved, *rest, *udot), dtype=float)
        except (ArithmeticError, ValueError):  # of Python's own mathematical functions
            flat = np.array([np.nan])
        if not np.all(np.isfinite(flat)):
            raise EngdynError(
                "the linearized equations are not finite there: a root or a quotient has no derivative"
            )
        return unpacked(eom, flat)

    blocks = blocks_at(0.0)
    changing = _changing_inputs(eom, blocks, blocks_at) if _has_time(eom) else ()
    force = tuple(-blocks[b] + 0.0 for b in ("B0", "B1", "B2"))
    return blocks["M"], blocks["C"], blocks["K"], force, assemble(blocks), changing


def _has_time(eom: EquationsOfMotion) -> bool:
    """Whether time occurs, explicitly or through a prescribed motion."""
    moving = any(as_expression(part).has(dynamicsymbols._t) for d in eom.defaults.values() for part in d)
    return moving or ("symbol", dynamicsymbols._t) in eom.occurring


def _changing_inputs(
    eom: EquationsOfMotion, start: Mapping[str, np.ndarray], blocks_at: Any
) -> tuple[str, ...]:
    """Inputs whose matrices change in time; refused where the others do."""
    changing = set()
    for t in MOMENTS:
        for name, later in blocks_at(t).items():
            moved = np.abs(later - start[name]) > 1e-9 * (np.abs(later) + np.abs(start[name]))
            if moved.any() and not name.startswith("B"):
                raise EngdynError(
                    "the linearized coefficients depend on time: linearize about a steady motion, in "
                    "coordinates in which nothing but the deviations changes"
                )
            if name.startswith("B"):
                changing |= {w.func.__name__ for w, c in zip(eom.inputs, moved.any(axis=0), strict=True) if c}
    return tuple(sorted(changing))


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
