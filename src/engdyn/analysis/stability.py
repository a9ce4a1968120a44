"""Stability of equilibria and steady motions from the eigenvalues of small motion.

Course sections 5.1 and 5.5.
"""

from __future__ import annotations

import random
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import numpy as np

from engdyn.algebra.ring import Element
from engdyn.analysis.linear import LinearSystem, eigenvalues, small_motion
from engdyn.errors import EngdynError

__all__ = ["Stability", "stability", "verdict_of"]

#: Real parts below this share of the largest |λ| count as zero (rounding of double roots included).
TOLERANCE = 1e-8


@dataclass(frozen=True, eq=False)
class Stability:
    """What linearization says about an equilibrium.

    Attributes
    ----------
    verdict : {"asymptotically stable", "marginal", "unstable (divergence)", "unstable (flutter)"}
    neutral : int
        Number of eigenvalues that are zero identically; the verdict judges the others.
    eigenvalues : ndarray of complex
        All of them [1/s], sorted by falling real part.
    """

    verdict: str
    neutral: int
    eigenvalues: np.ndarray

    def __repr__(self) -> str:
        neutral = (
            f" + {self.neutral} zero eigenvalue{'s' if self.neutral > 1 else ''}" if self.neutral else ""
        )
        shown = ", ".join(_digits(x) for x in self.eigenvalues)
        return f"{self.verdict}{neutral}; eigenvalues [1/s]: {shown}"

    @property
    def stable(self) -> bool:
        """Whether the equilibrium is asymptotically stable, neutral directions apart."""
        return self.verdict == "asymptotically stable"


def _digits(x: complex) -> str:
    scale = abs(x) or 1.0
    real, imaginary = (0.0 if abs(part) < 1e-9 * scale else part for part in (x.real, x.imag))
    return f"{real:.4g}" if imaginary == 0 else f"{real:.4g}{imaginary:+.4g}i"


def stability(linear: LinearSystem) -> Stability:
    """Judge the stability of an equilibrium or a steady motion by its eigenvalues.

    Parameters
    ----------
    linear : LinearSystem
        With numbers.

    Returns
    -------
    Stability

    Notes
    -----
    Course sections 5.1 and 5.5.  Eigenvalues that are zero whatever the parameters are (those of
    coordinates on which nothing depends) are counted exactly, with rational arithmetic, and set
    apart.  Where the others only touch the imaginary axis the verdict is "marginal":
    linearization cannot decide (A. M. Lyapunov, 1892).
    """
    if not isinstance(linear, LinearSystem):
        raise EngdynError(f"stability needs a LinearSystem, not {linear!r}: call linearize first")
    found = eigenvalues(linear)
    neutral = neutral_eigenvalues(linear)
    return Stability(verdict_of(found, neutral), neutral, found)


def verdict_of(found: np.ndarray, neutral: int = 0) -> str:
    """The verdict on a set of eigenvalues of which `neutral` are zero identically."""
    judged = sorted(found, key=abs)[neutral:]
    if not judged:
        return "marginal"
    scale = max(abs(x) for x in judged)
    worst = max(judged, key=lambda x: x.real)
    if worst.real > TOLERANCE * scale:
        flutter = abs(worst.imag) > TOLERANCE * scale
        return "unstable (flutter)" if flutter else "unstable (divergence)"
    return "asymptotically stable" if worst.real < -TOLERANCE * scale else "marginal"


def neutral_eigenvalues(linear: LinearSystem) -> int:
    """Number of eigenvalues that are zero for all parameters: trailing characteristic coefficients vanish.

    The state matrix is evaluated exactly at random rational parameters (those that are zero stay
    zero), the coordinates where they are; a coefficient that is not identically zero vanishes at
    both samples with negligible probability (Schwartz and Zippel).
    """
    return min(_trailing_zeros(_exact_state_matrix(linear, seed)) for seed in (1, 2))


def _exact_state_matrix(linear: LinearSystem, seed: int) -> list[list[Fraction]]:
    """A with rational entries: parameters random, sines and cosines on the unit circle, exactly."""
    from engdyn.analysis.exact_sample import ExactSample

    sample = ExactSample(linear, random.Random(seed))
    blocks: dict[str, list[list[Element]]] = small_motion(linear.eom)
    numbers: dict[str, Any] = {
        name: [[sample.value(entry) for entry in row] for row in blocks[name]]
        for name in ("M", "C", "K", "Gq", "G")
    }
    lower = _solve(numbers["M"], [[*k, *c] for k, c in zip(numbers["K"], numbers["C"], strict=True)])
    upper = [[*a, *b] for a, b in zip(numbers["Gq"], numbers["G"], strict=True)]
    return [*upper, *([-x for x in row] for row in lower)]


def _solve(matrix: list[list[Fraction]], right: list[list[Fraction]]) -> list[list[Fraction]]:
    """Gauss–Jordan elimination with fractions."""
    n = len(matrix)
    rows = [[*a, *b] for a, b in zip(matrix, right, strict=True)]
    for column in range(n):
        pivot = next((i for i in range(column, n) if rows[i][column] != 0), None)
        if pivot is None:
            raise EngdynError("singular mass matrix: stability cannot be judged there")
        rows[column], rows[pivot] = rows[pivot], rows[column]
        head = rows[column][column]
        rows[column] = [x / head for x in rows[column]]
        for i in range(n):
            factor = rows[i][column]
            if i != column and factor:
                rows[i] = [x - factor * y for x, y in zip(rows[i], rows[column], strict=True)]
    return [row[n:] for row in rows]


def _trailing_zeros(matrix: list[list[Fraction]]) -> int:
    """How often λ divides the characteristic polynomial: n − rank(Aⁿ)."""
    n = len(matrix)
    power = matrix
    while True:
        squared = [
            [
                sum((a * b for a, b in zip(row, column, strict=True)), Fraction(0))
                for column in zip(*power, strict=True)
            ]
            for row in power
        ]
        if _rank(squared) == _rank(power):
            return n - _rank(power)
        power = squared


def _rank(matrix: list[list[Fraction]]) -> int:
    rows, rank = [list(row) for row in matrix], 0
    for column in range(len(matrix)):
        pivot = next((i for i in range(rank, len(rows)) if rows[i][column] != 0), None)
        if pivot is None:
            continue
        rows[rank], rows[pivot] = rows[pivot], rows[rank]
        for i in range(rank + 1, len(rows)):
            factor = rows[i][column] / rows[rank][column]
            if factor:
                rows[i] = [x - factor * y for x, y in zip(rows[i], rows[rank], strict=True)]
        rank += 1
    return rank
