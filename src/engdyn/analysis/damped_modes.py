"""Complex modes of damped, gyroscopic, circulatory and nonholonomic systems.  Course sections 6.4 and 6.5."""

from __future__ import annotations

import warnings
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
import scipy.linalg

from engdyn.analysis.linear import LinearSystem
from engdyn.analysis.modes import canonical, leading, modes
from engdyn.analysis.neutral import neutral_eigenvalues
from engdyn.analysis.rounding import eigenvalue_errors
from engdyn.analysis.undamped import sizes, undamped_matrices
from engdyn.errors import EngdynError, EngdynWarning

__all__ = ["DampedModes", "damped_modes", "whirl"]

REAL = 1e-7
"""An imaginary part below this share of abs(λ) is rounding: a double real root cannot be known better."""

CLOSE, EQUAL = 1e-6, 1e-9
"""Eigenvalues this close, relative to their size, may be a Jordan block; as close as that they are one."""

PARALLEL = 1e-6
"""Below this, left and right eigenvectors of one eigenvalue are perpendicular: a Jordan block."""


@dataclass(frozen=True, eq=False, repr=False)
class DampedModes:
    """Modes of ẋ = A x for the state x = (q, u), one entry for each conjugate pair, by rising abs(λ).

    Attributes
    ----------
    eigenvalues : ndarray of complex, shape (p,)
        λ [1/s] of each pair, the one with positive imaginary part.
    state_shapes : ndarray of complex, shape (n + m, p)
        Right eigenvectors (q, u), scaled so that φᴴMφ = 1 (without such a matrix: Euclidean length 1); the
        largest component, as energies measure it, is real and positive.
    left_shapes : ndarray of complex, shape (n + m, p)
        Left eigenvectors w, wᵀA = λwᵀ, scaled so that wⱼᵀxₖ = 1 for j = k and 0 otherwise, conjugates
        included: η = wᵀx is the modal coordinate of a state.
    real_eigenvalues : ndarray, shape (n + m − 2p,)
        What does not oscillate [1/s], by falling value; those that are zero identically are exactly 0.
    defective : ndarray of bool, shape (p,)
        Modes that share their shape with another one (a Jordan block, as at the edge of flutter): there are
        fewer shapes than eigenvalues and their left shapes are not scaled, because wᵀx is 0.
    linear : LinearSystem
        What the modes belong to.
    """

    eigenvalues: np.ndarray
    state_shapes: np.ndarray
    left_shapes: np.ndarray
    real_eigenvalues: np.ndarray
    defective: np.ndarray
    linear: LinearSystem

    @property
    def coordinates(self) -> tuple[str, ...]:
        """Names of the rows of the shapes."""
        return self.linear.coordinates

    @property
    def shapes(self) -> np.ndarray:
        """Complex shapes of the coordinates, shape (n, p)."""
        return self.state_shapes[: len(self.coordinates)]

    @property
    def natural_frequency(self) -> np.ndarray:
        """abs(λ)/2π [Hz], shape (p,)."""
        return np.abs(self.eigenvalues) / (2 * np.pi)

    @property
    def damped_frequency(self) -> np.ndarray:
        """Im λ/2π [Hz], shape (p,): what a free vibration shows."""
        return self.eigenvalues.imag / (2 * np.pi)

    @property
    def damping_ratio(self) -> np.ndarray:
        """ζ = −Re λ/abs(λ), shape (p,): the sine of the angle between λ and the imaginary axis."""
        return -self.eigenvalues.real / np.abs(self.eigenvalues) + 0.0

    @property
    def phases(self) -> np.ndarray:
        """Phase of each coordinate [rad] in (−π, π], shape (n, p), relative to the largest; 0 where it rests."""
        size = np.abs(self.shapes) * sizes(self.linear)[:, None]
        return np.where(size > 1e-9 * np.max(size, axis=0, initial=0.0), np.angle(self.shapes), 0.0)

    def whirl(self, first: str, second: str) -> np.ndarray:
        """Sense in which two coordinates circle in each mode, see `whirl`, shape (p,)."""
        for name in (first, second):
            if not isinstance(name, str) or name not in self.coordinates:
                raise EngdynError(
                    f"there is no coordinate {name!r}: choose two of {', '.join(self.coordinates)}"
                )
        return whirl(*(self.shapes[self.coordinates.index(name)] for name in (first, second)))

    @cached_property
    def classicality(self) -> float | None:
        """How far damping is from classical: ‖C M⁻¹K − K M⁻¹C‖ / ‖C M⁻¹K‖ (Frobenius), 0 for classical.

        Zero if and only if the undamped modes diagonalize C as well (T. K. Caughey and M. E. J. O'Kelly,
        Journal of Applied Mechanics 32 (1965) 583). The size of a value other than zero depends on the units
        where coordinates have several; what the coupling costs, `neglecting_coupling` says. None where the
        question has no meaning: unsymmetric matrices, nonholonomic systems.
        """
        try:
            undamped_matrices(self.linear)
        except EngdynError:
            return None
        product = self.linear.damping @ np.linalg.solve(self.linear.mass, self.linear.stiffness)
        whole = np.linalg.norm(product)
        return float(np.linalg.norm(product - product.T) / whole) if whole else 0.0

    @cached_property
    def neglecting_coupling(self) -> DampedModes:
        """The modes if the terms off the diagonal of ΦᵀCΦ are dropped; compare ratios with the exact ones.

        Raises
        ------
        EngdynError
            A system without undamped modes.
        """
        undamped, n = modes(self.linear), len(self.coordinates)
        spread = self.linear.mass @ undamped.shapes
        constants = np.diag(undamped.modal_damping)
        rigid = undamped.natural_frequency == 0
        matrix = self.linear.state_matrix.copy()
        matrix[n:, n:] = -(undamped.shapes * constants) @ spread.T  # −M⁻¹C, as M⁻¹ = ΦΦᵀ
        linear = replace(self.linear, damping=(spread * constants) @ spread.T, state_matrix=matrix)
        free = rigid & (np.abs(constants) <= 1e-12 * np.max(np.abs(constants), initial=0.0))
        return _modes_of(linear, int(np.sum(rigid) + np.sum(free)), np.zeros(2 * n))

    def __repr__(self) -> str:
        told = [
            f"{f:.5g} Hz, ζ = {z:.4g}"
            for f, z in zip(self.natural_frequency, self.damping_ratio, strict=True)
        ]
        if len(self.real_eigenvalues):
            told.append("real " + ", ".join(f"{x:.4g}" for x in self.real_eigenvalues) + " 1/s")
        return f"DampedModes({'; '.join(told)})"

    def _repr_html_(self) -> str:
        rows = [
            ("natural frequency [Hz]", [f"{f:.5g}" for f in self.natural_frequency]),
            ("damping ratio", [f"{z:.4g}" for z in self.damping_ratio]),
        ]
        for name, row, phase in zip(self.coordinates, self.shapes, np.degrees(self.phases), strict=True):
            rows.append(
                (name, [f"{abs(x):.4g} ∠ {round(p, 1) + 0.0:.1f}°" for x, p in zip(row, phase, strict=True)])
            )
        head = "".join(f"<th>mode {k + 1}</th>" for k in range(len(self.eigenvalues)))
        body = "".join(
            f"<tr><th>{name}</th>{''.join(f'<td>{x}</td>' for x in row)}</tr>" for name, row in rows
        )
        real = ", ".join(f"{x:.4g}" for x in self.real_eigenvalues)
        note = f"<p>Real eigenvalues [1/s]: {real}</p>" if real else ""
        return f"<table><tr><th></th>{head}</tr>{body}</table>{note}"


def damped_modes(linear: LinearSystem) -> DampedModes:
    """Complex modes of any linearized system: damped, gyroscopic, circulatory or nonholonomic.

    Parameters
    ----------
    linear : LinearSystem
        With numbers.

    Returns
    -------
    DampedModes

    Raises
    ------
    EngdynError
        Not a LinearSystem with numbers.

    Notes
    -----
    Course sections 6.4 and 6.5. Eigenvalues that are zero whatever the parameters are (rigid-body motion)
    are counted exactly and stand among the real ones, never as NaN or as slow vibrations made by rounding.
    Where eigenvalues are equal only the subspace of their shapes is determined; where shapes are
    missing a warning says so.
    """
    if not isinstance(linear, LinearSystem) or not isinstance(linear.state_matrix, np.ndarray):
        raise EngdynError(f"damped_modes needs a LinearSystem with numbers, not {linear!r}: call linearize")
    found = _modes_of(linear, neutral_eigenvalues(linear), None)
    if found.defective.any():
        warnings.warn(
            f"modes {', '.join(str(k + 1) for k in np.flatnonzero(found.defective))} share their shape with another "
            "(a Jordan block): the system is at an edge, and its free motion contains terms t·exp(λt)",
            EngdynWarning,
            stacklevel=2,
        )
    return found


def _modes_of(linear: LinearSystem, neutral: int, errors: np.ndarray | None) -> DampedModes:
    """Modes of a state matrix of which `neutral` eigenvalues are zero; errors as rounding leaves them."""
    found, left, right = scipy.linalg.eig(linear.state_matrix, left=True, right=True)
    errors = eigenvalue_errors(linear, found) if errors is None else errors
    rest = np.argsort(np.abs(found), kind="stable")[neutral:]
    pair = np.abs(found.imag) > np.maximum(REAL * np.abs(found), errors)
    real = np.concatenate([np.zeros(neutral), found[[i for i in rest if not pair[i]]].real])
    chosen = np.array([i for i in rest if pair[i] and found[i].imag > 0], dtype=int)
    values = found[chosen]
    right, left, defective = _biorthogonal(linear, values, right[:, chosen], left[:, chosen].conj())
    n, scale = len(linear.coordinates), sizes(linear)[:, None]
    shapes, columns = right[:n], np.arange(len(values))
    weight = linear.mass if linear.mass.shape == (n, n) else np.eye(n)
    size = np.sqrt(np.abs(np.einsum("ik,ij,jk->k", shapes.conj(), weight, shapes)))
    turn = shapes[leading(shapes * scale), columns] if len(columns) else np.ones(0)
    factor = size * turn / np.abs(turn)
    return DampedModes(values, right / factor, left * factor, np.sort(real)[::-1] + 0.0, defective, linear)


def _biorthogonal(
    linear: LinearSystem, values: np.ndarray, right: np.ndarray, left: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Eigenvectors scaled so that wⱼᵀxₖ is the unit matrix, equal eigenvalues as subspaces; Jordan blocks marked."""
    n, size = len(linear.coordinates), sizes(linear)
    defective = np.zeros(len(values), dtype=bool)
    for group in _groups(values):
        # In units of the mode's own frequency and of √M all parts of a state vector compare.
        unit = np.concatenate([size, size[: len(right) - n] / max(np.abs(values[group[0]]), 1e-300)])[:, None]
        x, w = right[:, group] * unit, left[:, group] / unit
        x, w = x / np.linalg.norm(x, axis=0), w / np.linalg.norm(w, axis=0)
        one = np.ptp(values[group].real) + np.ptp(values[group].imag) <= EQUAL * np.abs(values[group[0]])
        if one and len(group) > 1 and np.linalg.svd(x, compute_uv=False)[-1] > PARALLEL:
            x = np.linalg.qr(x)[0]
            x = x @ canonical(x.conj().T)
        product = w.T @ x
        if np.linalg.svd(product, compute_uv=False)[-1] > PARALLEL:
            w = w @ np.linalg.inv(product).T
        else:
            defective[group] = True
        right[:, group], left[:, group] = x / unit, w * unit
    return right, left, defective


def _groups(values: np.ndarray) -> list[list[int]]:
    """Places of close eigenvalues together."""
    groups: list[list[int]] = []
    for k, value in enumerate(values):
        for group in groups:
            if abs(values[group[0]] - value) <= CLOSE * abs(value):
                group.append(k)
                break
        else:
            groups.append([k])
    return groups


def whirl(first: np.ndarray, second: np.ndarray) -> np.ndarray:
    """Sense in which two coordinates circle: 1 from the first toward the second, −1 back, 0 along a line.

    Parameters
    ----------
    first, second : ndarray of complex
        Components of shapes.

    Notes
    -----
    2 Im(a b̄)/(|a|² + |b|²): the area swept, over that of a circle of the same size. Of displacements along
    X and Y, or small rotations about them, 1 is a circle in the sense of a positive turn about Z.
    """
    total = np.abs(first) ** 2 + np.abs(second) ** 2
    return 2 * np.imag(first * np.conj(second)) / np.where(total == 0, 1.0, total)
