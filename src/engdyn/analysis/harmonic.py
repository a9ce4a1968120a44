"""Complex amplitudes of small harmonic motion: one solution for each frequency, or sums over modes for very many.

H(s) = C (s − A)⁻¹ Σₖ sᵏ Lₖ + D at s = iω, where the Lₖ are what value, rate and acceleration of the inputs do. With
A = V Λ V⁻¹ all frequencies share the eigenvectors, H = Σ R/(s − λ) (D. J. Ewins, *Modal Testing*, 2nd ed., Research
Studies Press, 2000, section 2.8); each chunk of such sums is compared with solutions and replaced by these where
eigenvectors are nearly parallel, or small responses are differences of large ones. Course section 7.1.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property

import numpy as np
import scipy.linalg

from engdyn.analysis.linear import LinearSystem
from engdyn.errors import EngdynError

__all__ = ["Harmonic"]

WORST = 1e4
"""Modal sums are tried while cond(V), of the balanced state matrix, stays below this: digits are lost as it grows."""

ACCURACY = 1e-12
"""Largest error of a modal sum, relative to the largest response to the same input at that frequency."""

CHUNK = 2048
"""Frequencies worked on together, so that they stay in the processor's cache; fewer are solved one by one."""


class Harmonic:
    """Responses of some outputs to some inputs, a function of frequency.

    Parameters
    ----------
    linear : LinearSystem
        With numbers.
    inputs : sequence of str
        Names of inputs, or of coordinates: then a unit generalized force on the equation of that coordinate.
    outputs : sequence of str
        Names of coordinates or outputs, also of their rates (``x'``) and accelerations (``x''``).
    """

    def __init__(self, linear: LinearSystem, inputs: Sequence[str], outputs: Sequence[str]):
        n = len(linear.coordinates)
        self._order = np.array([split(linear, name)[1] for name in outputs])
        observed = [_observed(linear, split(linear, name)[0]) for name in outputs]
        loads = [_load(linear, name) for name in inputs]
        scaled, (scale, _) = scipy.linalg.matrix_balance(linear.state_matrix, permute=False, separate=True)
        Y0, Y1, Y2 = (np.array([row[k] for row in observed]) for k in range(3))
        B = [np.linalg.solve(linear.mass, np.array([load[k] for load in loads]).T) for k in range(3)]
        self._state = scaled
        self._loads = [np.vstack([np.zeros((n, len(inputs))), b]) / scale[:, None] for b in B]
        rows = [np.hstack([Y0, Y1]), np.hstack([np.zeros_like(Y0), Y2])]  # u̇ = iω u
        self._rows = [row * scale for row in rows]
        at = [linear.inputs.index(name) if name in linear.inputs else None for name in inputs]
        self._through = [
            np.array([[0.0 if j is None else row[3 + k][j] for j in at] for row in observed])
            for k in range(3)
        ]

    def __call__(self, frequency: np.ndarray) -> np.ndarray:
        """Complex amplitudes, shape (outputs, inputs, N), at frequencies [Hz], shape (N,)."""
        omega = 2 * np.pi * frequency
        found = np.empty((len(self._order), self._loads[0].shape[1], len(omega)), dtype=complex)
        for start in range(0, len(omega), CHUNK):
            now, part = omega[start : start + CHUNK], found[..., start : start + CHUNK]
            if len(omega) <= CHUNK or not self.modal or not self._modal_sum(now, part):
                part[...] = self._solved(now)
            for k, through in enumerate(self._through):
                if through.any():
                    part += through[..., None] * (1j * now) ** k
        for row, order in zip(found, self._order, strict=True):
            if order:
                row *= (1j * omega) ** order
        return found

    @cached_property
    def modal(self) -> bool:
        """Whether the eigenvectors are far enough from parallel for sums over modes."""
        return bool(np.linalg.cond(self._eigen[1]) < WORST)

    @cached_property
    def _eigen(self) -> tuple[np.ndarray, np.ndarray]:
        values, vectors = np.linalg.eig(self._state)
        # Near a light resonance an error of λ is magnified by 1/(iω − λ): take out what rounding left, in more digits.
        A, X, left = (
            np.asarray(part, np.clongdouble) for part in (self._state, vectors, np.linalg.inv(vectors))
        )
        change = np.einsum("si,is->s", left, A @ X - X * values).astype(complex)
        return values + np.where(np.imag(values) == 0, change.real, change), vectors

    @cached_property
    def _residues(self) -> list[tuple[int, np.ndarray]]:
        """For each power of iω that occurs, real factors of the basis functions, shape (outputs·inputs, s)."""
        values, vectors = self._eigen
        left, above, real = np.linalg.inv(vectors), values.imag > 0, values.imag == 0
        found = []
        for power in range(4):
            total = np.zeros((len(self._order) * self._loads[0].shape[1], len(values)), dtype=complex)
            for a, rows in enumerate(self._rows):
                if 0 <= power - a <= 2:
                    product = np.einsum("ps,sw->pws", rows @ vectors, left @ self._loads[power - a])
                    total += product.reshape(total.shape)
            if total.any():
                pairs = total[:, above]
                constant = -2 * (pairs * values[above].conj()).real
                found.append((power, np.hstack([constant, 2 * pairs.real, total[:, real].real])))
        return found

    def _modal_sum(self, omega: np.ndarray, found: np.ndarray) -> bool:
        """Write the response into `found` and say whether it is accurate.

        A conjugate pair is (a + iωb)/((iω − λ)(iω − λ̄)), a real eigenvalue r/(iω − λ), with real a, b and r, so that
        all outputs and inputs are one product of real matrices.
        """
        values = self._eigen[0]
        pairs, real = values[values.imag > 0, None], values[values.imag == 0, None].real
        p, size = len(pairs), np.abs(pairs)
        basis = np.empty((len(values), len(omega)), dtype=complex)
        np.reciprocal((size - omega) * (size + omega) - 2j * omega * pairs.real, out=basis[:p])
        np.multiply(basis[:p], 1j * omega, out=basis[p : 2 * p])
        np.reciprocal(1j * omega - real, out=basis[2 * p :])
        first, *more = self._residues or [(0, np.zeros((found.shape[0] * found.shape[1], len(values))))]
        flat = found.reshape(len(first[1]), -1)
        np.matmul(first[1], basis.view(float), out=flat.view(float))
        if first[0]:
            flat *= (1j * omega) ** first[0]
        for power, factors in more:
            flat += (factors @ basis.view(float)).view(complex) * (1j * omega) ** power
        peak = int(np.argmax(np.max(np.abs(flat), axis=0)))
        tried = sorted({0, peak, len(omega) // 2, len(omega) - 1})
        exact = self._solved(omega[tried])
        scale = np.max(np.abs(exact), axis=0)
        return bool(np.all(np.abs(found[..., tried] - exact) <= ACCURACY * scale))

    def _solved(self, omega: np.ndarray) -> np.ndarray:
        """One system of equations for each frequency."""
        s = (1j * omega)[:, None, None]
        load = sum(part * s**k for k, part in enumerate(self._loads))
        try:
            state = np.linalg.solve(s * np.eye(len(self._state)) - self._state, load)
        except np.linalg.LinAlgError as error:
            raise EngdynError("the response is unbounded at one of the frequencies: leave it out") from error
        return np.moveaxis((self._rows[0] + s * self._rows[1]) @ state, 0, -1)


def split(linear: LinearSystem, name: str) -> tuple[str, int]:
    """An output name without its primes, and the order of the time derivative that they ask for."""
    base = name.rstrip("'")
    known = (*linear.outputs, *linear.coordinates)
    if base in known:
        return base, len(name) - len(base)
    raise EngdynError(
        f"there is no output {name!r}: choose among {', '.join(known)}, with one prime (x') for the rate and two for "
        "the acceleration, or give linearize(outputs=...) an expression"
    )


def _observed(linear: LinearSystem, name: str) -> list[np.ndarray]:
    """Rows of the six output matrices."""
    if name in linear.outputs:
        return [matrix[linear.outputs.index(name)] for matrix in linear.output_matrices]
    n, m, w = len(linear.coordinates), linear.mass.shape[0], len(linear.inputs)
    return [np.eye(n)[linear.coordinates.index(name)], *np.zeros((2, m)), *np.zeros((3, w))]


def _load(linear: LinearSystem, name: str) -> list[np.ndarray]:
    """What an input, or a generalized force on a coordinate, does by its value, rate and acceleration; (m,) each."""
    if name in linear.changing_inputs:
        raise EngdynError(
            f"the input {name} acts in a direction that turns in these coordinates, so that a harmonic {name} answers "
            "at other frequencies, too: write the equations in fixed axes, or give forces that turn "
            "with the coordinates by the names of these"
        )
    ring = linear.eom.ring
    kinematic = [ring.keys[i] for i in ring.independent(linear.eom.rates)]
    if any(key[1] in linear.eom.inputs and key[1].func.__name__ == name for key in kinematic):
        raise EngdynError(
            f"the input {name} occurs in the constraints, so that it moves coordinates without a force: this response "
            "is not covered; simulate it"
        )
    if name in linear.inputs:
        return [matrix[:, linear.inputs.index(name)] for matrix in linear.input_matrices]
    n, m = len(linear.coordinates), linear.mass.shape[0]
    if name in linear.coordinates:  # a generalized force does work on the motions that the speeds allow
        return [linear.state_matrix[linear.coordinates.index(name), n:], *np.zeros((2, m))]
    raise EngdynError(
        f"there is no input {name!r}: choose among the inputs {', '.join(linear.inputs) or '(none)'} and, for "
        f"generalized forces, the coordinates {', '.join(linear.coordinates)}"
    )
