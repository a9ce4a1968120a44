"""Comparing modes: the modal assurance criterion, and modes followed over a parameter.  Sections 6.1 and 6.5."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.optimize import linear_sum_assignment

from engdyn.analysis.damped_modes import whirl
from engdyn.analysis.equilibrium import Equilibrium
from engdyn.analysis.small_motion import assemble, compiled_blocks, unpacked
from engdyn.errors import EngdynError
from engdyn.modeling.equations import EquationsOfMotion
from engdyn.modeling.numbers import input_values, parameter_values

__all__ = ["ModeBranches", "mac", "track_modes"]

EQUAL = 1e-6
"""Eigenvalues this close, relative to the largest, have no vectors of their own."""


def mac(a: Any, b: Any, weight: Any = None) -> Any:
    """Modal assurance criterion: how alike shapes are, whatever their scale and phase.

    Parameters
    ----------
    a, b : array_like, shape (n,) or (n, p) and (n, r)
        Shapes, real or complex, in columns.
    weight : array_like, shape (n, n), optional
        A mass matrix, positive definite: shapes are compared as energies compare them, whatever the units of the
        coordinates are. Without it meters and radians are added.

    Returns
    -------
    float or ndarray, shape (p, r)
        |aᴴb|² / (aᴴa · bᴴb) between 0 (orthogonal) and 1 (the same shape).

    Raises
    ------
    EngdynError
        Shapes of different length, zero, not finite or no numbers.

    Notes
    -----
    R. J. Allemang and D. L. Brown, *A correlation coefficient for modal vector analysis*, IMAC (1982).
    """
    try:
        one, two = np.asarray(a, dtype=complex), np.asarray(b, dtype=complex)
        metric = None if weight is None else np.asarray(weight, dtype=float)
    except (TypeError, ValueError) as error:
        raise EngdynError("mac: a and b must be arrays of numbers, weight one of real numbers") from error
    left, right = (x[:, None] if x.ndim == 1 else x for x in (one, two))
    if left.ndim != 2 or right.ndim != 2 or len(left) != len(right):
        raise EngdynError(
            f"shapes {one.shape} and {two.shape} do not go together: give columns of one length"
        )
    metric = np.eye(len(left)) if metric is None else metric
    if metric.shape != (len(left), len(left)):
        raise EngdynError(
            f"weight has shape {metric.shape}: give a square matrix for {len(left)} coordinates"
        )
    sizes = [np.einsum("ik,ij,jk->k", x.conj(), metric, x).real for x in (left, right)]
    if not all(np.all(np.isfinite(size) & (size > 0)) for size in sizes):
        raise EngdynError("a shape is zero or not finite, or weight is not positive definite")
    found = np.abs(left.conj().T @ metric @ right) ** 2 / np.outer(*sizes)
    return float(found[0, 0]) if one.ndim == two.ndim == 1 else found


@dataclass(frozen=True, eq=False, repr=False)
class ModeBranches:
    """Modes followed over a parameter: column k is one mode from the first value to the last.

    Attributes
    ----------
    parameter : str
    values : ndarray, shape (N,)
        Of the parameter [SI].
    eigenvalues : ndarray of complex, shape (N, k)
        [1/s]; of conjugate pairs the one with positive imaginary part. At the first value, in order of abs(λ).
    shapes : ndarray of complex, shape (N, n, k)
        Components of the coordinates.
    coordinates : tuple of str
    """

    parameter: str
    values: np.ndarray
    eigenvalues: np.ndarray
    shapes: np.ndarray
    coordinates: tuple[str, ...]

    @property
    def natural_frequency(self) -> np.ndarray:
        """abs(λ)/2π [Hz], shape (N, k)."""
        return np.abs(self.eigenvalues) / (2 * np.pi)

    @property
    def damped_frequency(self) -> np.ndarray:
        """abs(Im λ)/2π [Hz], shape (N, k); 0 where a mode does not oscillate."""
        return np.abs(self.eigenvalues.imag) / (2 * np.pi)

    @property
    def damping_ratio(self) -> np.ndarray:
        """−Re λ/abs(λ), shape (N, k); 0 for λ = 0, ±1 where a mode does not oscillate."""
        size = np.abs(self.eigenvalues)
        return -self.eigenvalues.real / np.where(size == 0, 1.0, size) + 0.0

    def whirl(self, first: str, second: str) -> np.ndarray:
        """Sense in which two coordinates circle, 1 from the first toward the second, −1 back; shape (N, k)."""
        for name in (first, second):
            if name not in self.coordinates:
                raise EngdynError(
                    f"there is no coordinate {name!r}: choose two of {', '.join(self.coordinates)}"
                )
        a, b = (self.shapes[:, self.coordinates.index(name)] for name in (first, second))
        return whirl(a, b)

    def __repr__(self) -> str:
        low, high = self.values[0], self.values[-1]
        return f"ModeBranches({self.eigenvalues.shape[1]} modes over {self.parameter} = {low:g} to {high:g})"


def track_modes(
    eom: EquationsOfMotion,
    values: Mapping[str, float],
    x: tuple[str, Sequence[float]],
    at: Equilibrium | Mapping[str, Any] | None = None,
    inputs: Mapping[str, Any] | None = None,
) -> ModeBranches:
    """Follow the modes of an equilibrium or a steady motion over a parameter, each as one branch.

    Parameters
    ----------
    eom : EquationsOfMotion
    values : mapping of str to float
        Parameters by name [SI]; that of `x` is ignored.
    x : (str, array_like of shape (N,))
        Name of the parameter and its values [SI], rising or falling.
    at : Equilibrium or mapping of coordinate name to value, optional
        The state, the same for all values of the parameter or, in a mapping, an array with one for each;
        what is not named is zero.
    inputs : mapping, optional
        Constant inputs by name; those of `at` where not given.

    Returns
    -------
    ModeBranches

    Raises
    ------
    EngdynError
        Unknown names, values that are not finite, a state that is not in equilibrium for some value.

    Notes
    -----
    Course sections 6.1 and 6.5. Sorted by frequency, branches would be interchanged wherever they cross. So
    the modes of neighboring values are assigned to each other by the modal assurance criterion in its form
    with left and right eigenvectors, |wⱼᵀxₖ′ · w′ₖᵀxⱼ|, which is blind to scale, phase and units and for
    undamped modes equals the mass-weighted criterion `mac`. Where eigenvalues are equal the vectors are
    those of their subspace that resemble the neighbors' most. At a Jordan block two branches meet and
    nothing says which one goes on as which.
    """
    name, sweep = _checked_sweep(eom, x)
    matrices = _state_matrices(eom, {**values, name: float(sweep[0])}, name, sweep, at, inputs)
    found, right = np.linalg.eig(matrices)
    found, right = found.astype(complex), right.astype(complex)
    left = np.linalg.pinv(right)  # rows; of a defective matrix as far as they exist
    scale = np.max(np.abs(found), axis=1, initial=1e-300)
    gaps = np.abs(found[:, :, None] - found[:, None, :]) + np.eye(found.shape[1]) * scale[:, None, None]
    start = int(np.argmax(np.min(gaps, axis=(1, 2)) / scale))
    for step in (1, -1):
        ends = range(start + step, len(sweep) if step > 0 else -1, step)
        for k in ends:
            _align(found, right, left, k, k - step, EQUAL * scale[k])
    order = np.lexsort((-found[0].imag, np.round(np.abs(found[0]) / scale[0], 9)))
    kept = _one_of_each_pair(found[:, order])
    chosen = order[kept]
    n = len(eom.coordinates)
    names = tuple(q.func.__name__ for q in eom.coordinates)
    return ModeBranches(name, sweep, found[:, chosen], right[:, :n, chosen], names)


def _align(found: np.ndarray, right: np.ndarray, left: np.ndarray, k: int, before: int, equal: float) -> None:
    """Put the modes of point k in the order of the point before, in place."""
    alike = np.abs(left[before] @ right[k]) * np.abs(left[k] @ right[before]).T
    # Of modes that are equally alike the nearer eigenvalue goes on.
    far = np.abs(found[before][:, None] - found[k])
    order = linear_sum_assignment(1e-3 * far / max(far.max(), 1e-300) - np.minimum(alike, 1.0))[1]
    found[k], right[k], left[k] = found[k, order], right[k][:, order], left[k, order]
    for j in range(len(order)):
        group = np.flatnonzero(np.abs(found[k] - found[k, j]) <= equal)
        if group[0] == j and len(group) > 1:
            moved = left[k, group] @ right[before][:, group]
            if np.linalg.cond(moved) < 1e6:
                right[k][:, group] = right[k][:, group] @ moved
                left[k, group] = np.linalg.solve(moved, left[k, group])


def _one_of_each_pair(found: np.ndarray) -> list[int]:
    """Branches without those that are the conjugates of others everywhere; of two, the one above the real axis."""
    above = np.mean(found.imag, axis=0)
    scale = 1e-9 * np.max(np.abs(found), initial=0.0)
    kept: list[int] = []
    for j in sorted(range(found.shape[1]), key=lambda j: -above[j]):
        oscillates = np.any(np.abs(found[:, j].imag) > scale)
        twin = any(np.all(np.abs(found[:, i] - found[:, j].conj()) <= scale) for i in kept)
        if not (oscillates and twin):
            kept.append(j)
    return sorted(kept)


def _checked_sweep(eom: EquationsOfMotion, x: Any) -> tuple[str, np.ndarray]:
    if not isinstance(eom, EquationsOfMotion):
        raise EngdynError(f"eom is {eom!r}: give EquationsOfMotion, for example system.equations")
    try:
        name, sweep = x[0], np.array(x[1], dtype=float)
    except (TypeError, ValueError, IndexError, KeyError) as error:
        raise EngdynError(f"x is {x!r}: give (parameter name, array of values)") from error
    known = [p.name for p in eom.parameters]
    if name not in known:
        raise EngdynError(f"unknown parameter {name!r}: the equations have {', '.join(known)}")
    steps = np.diff(sweep) if sweep.ndim == 1 else np.zeros(0)
    if sweep.ndim != 1 or len(sweep) < 2 or not np.all(np.isfinite(sweep)):
        raise EngdynError(f"the values of {name} must be at least two finite numbers in one row")
    if not (np.all(steps > 0) or np.all(steps < 0)):
        raise EngdynError(f"the values of {name} must rise or fall: modes are followed from one to the next")
    return name, sweep


def _state_matrices(
    eom: EquationsOfMotion,
    values: Mapping[str, float],
    name: str,
    sweep: np.ndarray,
    at: Equilibrium | Mapping[str, Any] | None,
    inputs: Mapping[str, Any] | None,
) -> np.ndarray:
    """State matrices for all values of a parameter, shape (N, n + m, n + m)."""
    m, count = len(eom.speeds), len(sweep)
    q, u, udot = _states(eom, at, count)
    inputs = at.inputs if inputs is None and isinstance(at, Equilibrium) else inputs
    given = np.array([_numbers(eom, {**values, name: float(value)}, inputs) for value in sweep])
    columns = [*np.hstack([q, u, given]).T]
    flat = np.array([np.broadcast_to(part, count) for part in eom.compiled("numpy")(*columns)]).T
    force = np.einsum("kij,kj->ki", flat[:, : m * m].reshape(count, m, m), udot) - flat[:, m * m : m * m + m]
    blocks = compiled_blocks(eom, "numpy")(*columns, *udot.T)
    stacked = np.stack([np.broadcast_to(np.asarray(part, dtype=float), (count,)) for part in blocks], axis=-1)
    if not (np.all(np.isfinite(stacked)) and np.all(np.isfinite(force))):
        raise EngdynError(
            "the linearized equations are not finite there: a root or a quotient has no derivative"
        )
    parts = unpacked(eom, stacked)
    # A force that a displacement of a millionth would balance does not move the state.
    reach = 1e-6 * np.max(np.abs(parts["K"]), axis=2) * np.maximum(1.0, np.max(np.abs(q), axis=1))[:, None]
    off = np.flatnonzero(np.any(np.abs(force) > reach + 1e-9, axis=1))
    if len(off):
        raise EngdynError(
            f"at {name} = {sweep[off[0]]:.5g} the state is not in equilibrium, it lacks up to "
            f"{np.max(np.abs(force[off[0]])):.3g} N or N m: give at= with the coordinates for each value, from a "
            "branch of equilibria"
        )
    return assemble(parts)


def _numbers(
    eom: EquationsOfMotion, values: Mapping[str, float], inputs: Mapping[str, Any] | None
) -> list[float]:
    return [*parameter_values(eom, values), *input_values(eom, inputs, values), 0.0]


def _states(eom: EquationsOfMotion, at: Any, count: int) -> list[np.ndarray]:
    """q, u and u̇ for all values of the parameter, each with shape (count, …)."""
    n, m = len(eom.coordinates), len(eom.speeds)
    names = [q.func.__name__ for q in eom.coordinates]
    if isinstance(at, Equilibrium):
        if list(at.names) != names:
            raise EngdynError(
                f"at has the coordinates {', '.join(at.names)}, the equations {', '.join(names)}"
            )
        return [
            np.tile(np.array(part, dtype=float), (count, 1)) for part in (at.q, at.speeds, at.accelerations)
        ]
    given = {} if at is None else at
    if not isinstance(given, Mapping) or not set(given) <= set(names):
        raise EngdynError(f"at is {at!r}: give an Equilibrium, or numbers or arrays for {', '.join(names)}")
    q = np.zeros((count, n))
    for name, value in given.items():
        try:
            column = np.asarray(value, dtype=float)
        except (TypeError, ValueError):
            column = np.array(np.nan)
        if column.shape not in ((), (count,)) or not np.all(np.isfinite(column)):
            raise EngdynError(
                f"at[{name!r}] must be one finite number, or one for each of the {count} values"
            )
        q[:, names.index(name)] = column
    return [q, np.zeros((count, m)), np.zeros((count, m))]
