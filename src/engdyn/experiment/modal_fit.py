"""Poles and shapes from measured frequency responses: a rational fraction that all channels share.  Section 9.10."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import scipy.signal

from engdyn.errors import EngdynError

__all__ = ["ModalFit", "fit_modes"]

ROUNDS, SETTLED = 60, 1e-9
"""Iterations of the poles at most, and the relative change at which they end."""


@dataclass(frozen=True, eq=False, repr=False)
class ModalFit:
    """Modes identified from frequency responses, by rising natural frequency.

    Attributes
    ----------
    eigenvalues : ndarray of complex, shape (n,)
        λ [1/s] of each pair, the one with positive imaginary part.
    residues : ndarray of complex, shape (channels, n)
        R in H(s) = Σ R/(s − λ) + R*/(s − λ*) + …
    error : ndarray, shape (channels,)
        Root mean square of what the fit leaves, over that of the response.
    """

    eigenvalues: np.ndarray
    residues: np.ndarray
    error: np.ndarray
    _rest: np.ndarray
    _scale: float

    @property
    def natural_frequency(self) -> np.ndarray:
        """abs(λ)/2π [Hz], shape (n,)."""
        return np.abs(self.eigenvalues) / (2 * np.pi)

    @property
    def damping_ratio(self) -> np.ndarray:
        """−Re λ/abs(λ), shape (n,)."""
        return -self.eigenvalues.real / np.abs(self.eigenvalues)

    @property
    def shapes(self) -> np.ndarray:
        """Complex shapes, shape (channels, n): residues over the largest of each mode, which becomes 1."""
        largest = np.argmax(np.abs(self.residues), axis=0)
        return self.residues / self.residues[largest, np.arange(len(self.eigenvalues))]

    def evaluate(self, frequency: Any) -> np.ndarray:
        """The fitted responses at other frequencies [Hz], shape (channels, N)."""
        s = 2j * np.pi * np.asarray(frequency, dtype=float) / self._scale
        terms = np.column_stack(
            [_fractions(s, self.eigenvalues / self._scale), _beyond(s, len(self._rest[0]))]
        )
        pairs = self.residues / self._scale
        real = np.stack([pairs.real, pairs.imag], axis=2).reshape(len(pairs), -1)
        return np.hstack([real, self._rest]) @ terms.T

    def __repr__(self) -> str:
        modes = zip(self.natural_frequency, self.damping_ratio, strict=True)
        told = "; ".join(f"{f:.5g} Hz, ζ = {z:.4g}" for f, z in modes)
        return f"ModalFit({told}; error {100 * self.error.max():.2g} %)"

    def _repr_html_(self) -> str:
        rows = "".join(
            f"<tr><td>{k + 1}</td><td>{f:.5g}</td><td>{z:.4g}</td></tr>"
            for k, (f, z) in enumerate(zip(self.natural_frequency, self.damping_ratio, strict=True))
        )
        head = "".join(f"<th>{h}</th>" for h in ("mode", "natural frequency [Hz]", "damping ratio"))
        caption = f"{len(self.residues)} channels, error {100 * self.error.max():.2g} %"
        return (
            f"<table><caption>{caption}</caption><thead><tr>{head}</tr></thead><tbody>{rows}</tbody></table>"
        )


def fit_modes(
    frf: Any, n: int, band: tuple[float, float] | None = None, residual_terms: bool = True
) -> ModalFit:
    """Modes from one or several frequency responses to the same input.

    Parameters
    ----------
    frf : frequency response, or sequence of these
        With `.frequency` [Hz], shape (N,), and `.response`, complex, shape (N,) or (channels, N): displacements,
        velocities or accelerations per unit of the input. Estimates that know their coherence are weighted with it.
    n : int
        Number of modes in the band.
    band : (float, float), optional
        [Hz]; all lines above 0 Hz where not given.
    residual_terms : bool
        Allow each channel terms in 1, s² and 1/s² for the modes beyond the band.

    Returns
    -------
    ModalFit

    Raises
    ------
    EngdynError
        Responses that do not fit together, too few lines, a fit that finds no n oscillating modes.

    Notes
    -----
    Course section 9.10 and Appendix D.  Partial fractions with common poles, which are moved to where the weighted
    linear least squares have no more reason to move them: B. Gustavsen and A. Semlyen, *IEEE Transactions on Power
    Delivery* 14 (1999) 1052; channels are reduced one by one (D. Deschrijver et al., *IEEE Microwave and Wireless
    Components Letters* 18 (2008) 383).
    """
    frequency, response, weight = _gathered(frf, band)
    rest = 3 if residual_terms else 1
    if not (isinstance(n, int | np.integer) and n > 0) or 2 * len(frequency) < 4 * n + rest:
        raise EngdynError(
            f"{n!r} modes from {len(frequency)} lines: give a positive number of modes, and more lines"
        )
    scale = 2 * np.pi * float(frequency[-1])
    s = 2j * np.pi * frequency / scale
    poles = _first_guess(frequency, response, n) / scale
    for _ in range(ROUNDS):
        moved = _relocated(s, response, weight, poles, rest)
        change = np.max(np.abs(moved - poles) / np.abs(moved))
        poles = moved
        if change < SETTLED:
            break
    if np.any(np.abs(poles.imag) < 1e-3 * np.abs(poles)):
        raise EngdynError(
            f"the responses do not show {n} modes that oscillate: fit fewer, or choose another band"
        )
    terms = np.column_stack([_fractions(s, poles), _beyond(s, rest)])
    factors = np.array(
        [_least_squares(w[:, None] * terms, w * h) for w, h in zip(weight, response, strict=True)]
    )
    left = response - factors @ terms.T
    error = np.linalg.norm(left, axis=1) / np.linalg.norm(response, axis=1)
    pairs = factors[:, : 2 * n : 2] + 1j * factors[:, 1 : 2 * n : 2]
    return ModalFit(poles * scale, pairs * scale, error, factors[:, 2 * n :], scale)


def _gathered(frf: Any, band: tuple[float, float] | None) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Lines in the band, responses and weights, shape (channels, N)."""
    given: Sequence[Any] = frf if isinstance(frf, list | tuple) else [frf]
    try:
        frequency = np.asarray(given[0].frequency, dtype=float)
        rows = [np.atleast_2d(np.asarray(one.response, dtype=complex)) for one in given]
        same = all(np.array_equal(one.frequency, frequency) for one in given)
    except (AttributeError, IndexError, TypeError) as error:
        raise EngdynError("frf needs .frequency and .response, or is a sequence of what has them") from error
    if not same or any(row.shape[1:] != frequency.shape for row in rows):
        raise EngdynError("all responses need the same frequencies, one value for each, channels in rows")
    response = np.vstack(rows)
    inside = frequency > 0
    if band is not None:
        inside &= (frequency >= band[0]) & (frequency <= band[1])
    weight = np.vstack([_weights(one, row) for one, row in zip(given, rows, strict=True)])
    if not np.all(np.isfinite(response[:, inside])) or not np.any(response[:, inside]):
        raise EngdynError(
            "a response is not finite in the band, or zero: leave out the undamped resonance or the line"
        )
    return frequency[inside], response[:, inside], weight[:, inside]


def _weights(one: Any, row: np.ndarray) -> np.ndarray:
    """One over the standard deviation where it is known, else equal for all lines of a channel."""
    even = 1 / np.maximum(np.sqrt(np.mean(np.abs(row) ** 2, axis=1, keepdims=True)), np.finfo(float).tiny)
    try:
        error = np.maximum(one.random_error, 1e-3)  # a bias remains where the scatter is small
    except (AttributeError, EngdynError):
        return np.broadcast_to(even, row.shape)
    return 1 / np.maximum(np.abs(row) * error, 1e-6 / even)


def _first_guess(frequency: np.ndarray, response: np.ndarray, n: int) -> np.ndarray:
    """Poles at the n most prominent peaks of all channels together, 1 % damped; others spread over the band."""
    size = np.sqrt(np.sum(np.abs(response / np.linalg.norm(response, axis=1, keepdims=True)) ** 2, axis=0))
    smooth = np.convolve(np.pad(size, 2, mode="edge"), np.ones(5) / 5, mode="valid")
    peaks, found = scipy.signal.find_peaks(np.log(smooth), prominence=0.05)
    best = peaks[np.argsort(found["prominences"])[::-1][:n]]
    spread = np.geomspace(frequency[0], frequency[-1], 2 * (n - len(best)) + 1)[1::2]
    omega = 2 * np.pi * np.sort(np.concatenate([frequency[best], spread]))
    return omega * (-0.01 + 1j)


def _fractions(s: np.ndarray, poles: np.ndarray) -> np.ndarray:
    """Columns 1/(s − λ) + 1/(s − λ*) and i/(s − λ) − i/(s − λ*) of each pair: real factors make real systems."""
    one, two = 1 / (s[:, None] - poles), 1 / (s[:, None] - poles.conj())
    return np.stack([one + two, 1j * (one - two)], axis=2).reshape(len(s), -1)


def _beyond(s: np.ndarray, terms: int) -> np.ndarray:
    return np.column_stack([np.ones_like(s), s**2, 1 / s**2][:terms])


def _least_squares(matrix: np.ndarray, right: np.ndarray) -> np.ndarray:
    """Real factors of complex columns."""
    whole = np.vstack([matrix.real, matrix.imag])
    lengths = np.linalg.norm(whole, axis=0)
    return np.linalg.lstsq(whole / lengths, np.concatenate([right.real, right.imag]), rcond=None)[0] / lengths


def _relocated(
    s: np.ndarray, response: np.ndarray, weight: np.ndarray, poles: np.ndarray, rest: int
) -> np.ndarray:
    """The zeros of the common denominator σ(s) = 1 + Σ c/(s − λ) for which σH has the poles λ as well."""
    fractions = _fractions(s, poles)
    own = np.column_stack([fractions, _beyond(s, rest)])
    rows, rights = [], []
    for h, w in zip(response, weight, strict=True):
        whole = w[:, None] * np.column_stack([own, -h[:, None] * fractions, h])
        triangle = np.linalg.qr(np.vstack([whole.real, whole.imag]), mode="r")
        kept = triangle[
            own.shape[1] :, own.shape[1] :
        ]  # what is left once the channel has chosen its own factors
        rows.append(kept[:, :-1])
        rights.append(kept[:, -1])
    matrix = np.vstack(rows)
    lengths = np.linalg.norm(matrix, axis=0)
    lengths[lengths == 0] = 1.0
    c = np.linalg.lstsq(matrix / lengths, np.concatenate(rights), rcond=None)[0] / lengths
    block = np.zeros((len(c), len(c)))
    for k, pole in enumerate(poles):
        block[2 * k : 2 * k + 2, 2 * k : 2 * k + 2] = [[pole.real, pole.imag], [-pole.imag, pole.real]]
    found = np.linalg.eigvals(block - np.outer(np.tile([2.0, 0.0], len(poles)), c))
    return _paired(found)


def _paired(found: np.ndarray) -> np.ndarray:
    """One pole of each pair, stable; two real ones are taken for a strongly damped pair."""
    found = np.where(found.real > 0, -found.conj(), found)
    upper = list(found[found.imag > 0])
    real = np.sort(np.abs(found[found.imag == 0].real))
    pairs = zip(real[::2], real[1::2], strict=True)
    upper += [np.sqrt(max(a * b, 1e-12)) * (-0.9 + np.sqrt(1 - 0.81) * 1j) for a, b in pairs]
    return np.array(sorted(upper, key=abs))
