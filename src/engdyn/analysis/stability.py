"""Stability of equilibria and steady motions from the eigenvalues of small motion.

Course sections 5.1 and 5.5.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from engdyn.analysis.linear import LinearSystem, eigenvalues
from engdyn.analysis.neutral import neutral_eigenvalues
from engdyn.analysis.rounding import eigenvalue_errors
from engdyn.errors import EngdynError

__all__ = ["VERDICTS", "Stability", "stability", "verdict_of"]

VERDICTS = ("asymptotically stable", "marginal", "unstable (divergence)", "unstable (flutter)")

TOLERANCE = 1e-8
"""Real parts below this share of the largest abs(λ) count as zero where no bound of the rounding is given."""

SAFETY = 10.0
"""A real part counts where it is this many times larger than what rounding may have made it."""


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
    errors : ndarray
        How far rounding may have moved each eigenvalue [1/s].
    """

    verdict: str
    neutral: int
    eigenvalues: np.ndarray
    errors: np.ndarray

    def __repr__(self) -> str:
        plural = "s" if self.neutral > 1 else ""
        neutral = f" + {self.neutral} zero eigenvalue{plural}" if self.neutral else ""
        shown = ", ".join(map(_digits, self.eigenvalues, SAFETY * self.errors))
        return f"{self.verdict}{neutral}; eigenvalues [1/s]: {shown}"

    @property
    def stable(self) -> bool:
        """Whether the equilibrium is asymptotically stable, neutral directions apart."""
        return self.verdict == "asymptotically stable"


def _digits(x: complex, error: float) -> str:
    real, imaginary = (0.0 if abs(part) <= error else part for part in (x.real, x.imag))
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

    Raises
    ------
    EngdynError
        Not a LinearSystem with numbers.

    Notes
    -----
    Course sections 5.1 and 5.5.  Eigenvalues that are zero whatever the parameters are (those of
    coordinates on which nothing depends) are counted exactly and set apart.  Where the others only
    touch the imaginary axis, or are closer to it than rounding allows to tell, the verdict is
    "marginal": linearization cannot decide (A. M. Lyapunov, 1892).
    """
    if not isinstance(linear, LinearSystem):
        raise EngdynError(f"stability needs a LinearSystem, not {linear!r}: call linearize first")
    found = eigenvalues(linear)
    neutral = neutral_eigenvalues(linear)
    errors = eigenvalue_errors(linear, found)
    return Stability(verdict_of(found, neutral, errors), neutral, found, errors)


def verdict_of(found: np.ndarray, neutral: int = 0, errors: np.ndarray | None = None) -> str:
    """The verdict on a set of eigenvalues of which `neutral` are zero identically.

    Parameters
    ----------
    found : ndarray of complex, shape (N,)
    neutral : int
    errors : ndarray, shape (N,), optional
        How far rounding may have moved each.
    """
    judged = np.argsort(np.abs(found), kind="stable")[neutral:]
    if not len(judged):
        return "marginal"
    scale = float(np.max(np.abs(found)))
    limits = np.full(len(found), TOLERANCE * scale) if errors is None else SAFETY * errors
    worst = max(judged, key=lambda i: found[i].real - limits[i])
    if found[worst].real > limits[worst]:
        flutter = abs(found[worst].imag) > limits[worst]
        return "unstable (flutter)" if flutter else "unstable (divergence)"
    return "asymptotically stable" if all(found[judged].real < -limits[judged]) else "marginal"
