"""Stability of one equilibrium over a plane of two parameters.  Course section 5.5."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from engdyn.analysis.equilibrium import equilibria
from engdyn.analysis.follow import Follower
from engdyn.analysis.linear import linearize, sorted_eigenvalues
from engdyn.analysis.neutral import neutral_eigenvalues
from engdyn.analysis.results import Equilibrium
from engdyn.analysis.small_motion import assemble
from engdyn.analysis.stability import VERDICTS, stability
from engdyn.errors import EngdynError
from engdyn.modeling.equations import EquationsOfMotion
from engdyn.modeling.numbers import mass_and_force

__all__ = ["NO_EQUILIBRIUM", "StabilityMap", "stability_map"]

NO_EQUILIBRIUM = "no equilibrium"

CLEAR, ZERO = 1e-6, 1e-12
"""Real parts beyond the first share of the plane's largest abs(λ) are out of rounding's reach, those below the second
count as zero; what lies between is judged one by one, with bounds of its rounding."""


@dataclass(frozen=True, eq=False, repr=False)
class StabilityMap:
    """Verdicts on one equilibrium over a parameter plane.

    Attributes
    ----------
    x, y : (str, ndarray)
        The two parameters and their values [SI].
    verdict : ndarray of str, shape (len(y), len(x))
        As :func:`engdyn.stability` says it, or "no equilibrium" where the one that is followed has ceased to exist.
    eigenvalues : ndarray of complex, shape (len(y), len(x), n + m)
        Sorted by falling real part [1/s]; NaN where there is no equilibrium.
    states : ndarray, shape (len(y), len(x), n + m)
        Coordinates and speeds of the equilibrium.
    at : Equilibrium
        The one that is followed.
    """

    x: tuple[str, np.ndarray]
    y: tuple[str, np.ndarray]
    verdict: np.ndarray
    eigenvalues: np.ndarray
    states: np.ndarray
    at: Equilibrium

    @property
    def shares(self) -> dict[str, float]:
        """What share of the points has each verdict."""
        names, counts = np.unique(self.verdict, return_counts=True)
        return {str(name): count / self.verdict.size for name, count in zip(names, counts, strict=True)}

    def __repr__(self) -> str:
        shares = ", ".join(f"{100 * share:.3g} % {name}" for name, share in self.shares.items())
        size = " x ".join(str(len(array)) for _, array in (self.x, self.y))
        return f"StabilityMap({self.x[0]}, {self.y[0]}; {size} points: {shares})"


def stability_map(
    eom: EquationsOfMotion,
    values: Mapping[str, float],
    x: tuple[str, Any],
    y: tuple[str, Any],
    at: Equilibrium | Mapping[str, float] | None = None,
) -> StabilityMap:
    """Judge the stability of one equilibrium over a plane of two parameters.

    Parameters
    ----------
    eom : EquationsOfMotion
    values : mapping of str to float
        All parameters by name [SI].
    x, y : (str, array)
        Two of them, and the values that they take.
    at : Equilibrium, or mapping of coordinate name to value, optional
        The equilibrium to follow; a mapping is a state of rest at `values`. By default all coordinates zero where
        that is one, else the first stable one.

    Returns
    -------
    StabilityMap

    Raises
    ------
    EngdynError
        An unknown parameter, arrays that are empty or not finite, a state that is no equilibrium, a singular mass
        matrix.

    Notes
    -----
    Course section 5.5.  The equilibrium is followed from each point to its neighbors by Newton's method, with
    the inputs of `at`. Where it meets another one and ends, "no equilibrium" is said. The rates of a steady
    motion keep their proportions, and their magnitude, too, unless the inputs require another one.
    """
    if not isinstance(eom, EquationsOfMotion):
        raise EngdynError(f"eom is {eom!r}: give EquationsOfMotion, for example system.lagrange()")
    x, y = _axis(eom, x, "x"), _axis(eom, y, "y")
    if x[0] == y[0]:
        raise EngdynError(f"x and y are both {x[0]}: name two parameters")
    at = _start(eom, values, at)
    if at.regular is not None:
        eom, at = at.regular
    follower = Follower(eom, at, values, (x[0], y[0]))
    states = follower.over(x[1], y[1])
    exists = np.isfinite(states[..., 0])
    rows, columns = np.nonzero(exists)
    points = np.column_stack([x[1][columns], y[1][rows]])
    blocks = follower.blocks(states[rows, columns], points)
    found = sorted_eigenvalues(np.linalg.eigvals(_state_matrices(blocks)))
    verdict = np.full(exists.shape, NO_EQUILIBRIUM, dtype=f"<U{max(map(len, VERDICTS))}")
    eigenvalues = np.full(states.shape, np.nan, dtype=complex)
    eigenvalues[rows, columns] = found
    verdict[rows, columns] = _judged(
        _Points(eom, values, at, (x[0], y[0]), points, states[rows, columns]), found
    )
    return StabilityMap(x, y, verdict, eigenvalues, states, at)


def _state_matrices(blocks: dict[str, np.ndarray]) -> np.ndarray:
    matrices = assemble(blocks)
    if not np.isfinite(matrices).all():
        raise EngdynError(
            "the linearized equations are not finite somewhere in the plane: leave that part out"
        )
    return matrices


def _axis(eom: EquationsOfMotion, given: tuple[str, Any], which: str) -> tuple[str, np.ndarray]:
    try:
        name, array = given
        numbers = np.array(array, dtype=float)
    except (TypeError, ValueError) as error:
        raise EngdynError(f"{which} is {given!r}: give (parameter name, array of values)") from error
    known = [p.name for p in eom.parameters]
    if name not in known:
        raise EngdynError(f"{which} names {name!r}: the equations have the parameters {', '.join(known)}")
    if numbers.ndim != 1 or not len(numbers) or not np.isfinite(numbers).all():
        raise EngdynError(f"{which}: the values of {name} must be finite, in one row, and at least one")
    return name, numbers


def _start(
    eom: EquationsOfMotion, values: Mapping[str, float], at: Equilibrium | Mapping[str, float] | None
) -> Equilibrium:
    """The equilibrium to follow."""
    if isinstance(at, Equilibrium):
        return at
    if isinstance(at, Mapping) or _rests_at_zero(eom, values):
        found = linearize(eom, at or {}, values).at
        if not _rests_at_zero(eom, values, found.q):
            raise EngdynError(f"at = {at} is no equilibrium: give one that equilibria has found")
        return found
    if at is not None:
        raise EngdynError(f"at is {at!r}: give an Equilibrium, or a mapping of coordinate names to values")
    try:
        found = equilibria(eom, values)
    except EngdynError as error:
        raise EngdynError(f"give at, the equilibrium to follow; looking for one failed: {error}") from error
    stable = [e for e in found if stability(linearize(eom, e)).stable]
    if not stable:
        raise EngdynError("give at, the equilibrium to follow: none is stable, and zero is none")
    return stable[0]


def _rests_at_zero(eom: EquationsOfMotion, values: Mapping[str, float], q: Any = None) -> bool:
    """Whether nothing moves at q, zero by default."""
    n, m = len(eom.coordinates), len(eom.speeds)
    q = np.zeros(n) if q is None else q
    try:
        force = mass_and_force(eom, q, np.zeros(m), values, {})[1]
        terms = abs(
            linearize(
                eom, dict(zip((c.func.__name__ for c in eom.coordinates), q, strict=True)), values
            ).stiffness
        )
    except (ArithmeticError, EngdynError):
        return False
    return bool(np.all(abs(force) <= 1e-8 * terms.sum(axis=1) + 1e-300))


@dataclass
class _Points:
    """States of one equilibrium at many points of the plane."""

    eom: EquationsOfMotion
    values: Mapping[str, float]
    at: Equilibrium
    names: tuple[str, str]
    points: np.ndarray
    states: np.ndarray

    def linear(self, i: int) -> Any:
        """The LinearSystem at one of them."""
        n = len(self.eom.coordinates)
        values = {**self.values, **dict(zip(self.names, self.points[i].tolist(), strict=True))}
        state = self.states[i]
        at = Equilibrium(
            state[:n], state[n:], self.at.accelerations, self.at.inputs, values, 0.0, self.at.names
        )
        return linearize(self.eom, at)

    def neutral(self) -> np.ndarray:
        """Number of eigenvalues that are zero identically; a parameter that is zero may make it larger."""
        kinds, of = np.unique(self.points == 0, axis=0, return_inverse=True)
        of = of.ravel()
        firsts = [int(np.flatnonzero(of == k)[0]) for k in range(len(kinds))]
        return np.array([neutral_eigenvalues(self.linear(i)) for i in firsts], dtype=int)[of]


def _judged(points: _Points, found: np.ndarray) -> np.ndarray:
    """The verdict at each point."""
    if not len(found):
        return np.empty(0, dtype=str)
    size, neutral = abs(found), points.neutral()
    scale, real = size.max(axis=1), found.real
    if neutral.any():  # the smallest ones are those
        real = np.where(size.argsort(axis=1).argsort(axis=1) < neutral[:, None], -np.inf, real)
    at = np.arange(len(found)), np.argmax(real, axis=1)
    largest, imaginary = real[at], abs(found.imag[at])
    zero = ~np.isfinite(largest) | (abs(largest) <= ZERO * scale)
    stable, marginal, divergence, flutter = VERDICTS
    verdict = np.select([zero, largest < 0, imaginary > 0], [marginal, stable, flutter], divergence)
    unclear = CLEAR * scale.max()  # of the whole plane: at a critical point all eigenvalues may be rounding
    close = (abs(largest) < unclear) | ((largest > 0) & (imaginary > 0) & (imaginary <= unclear))
    for i in np.flatnonzero(close & ~zero):
        verdict[i] = stability(points.linear(int(i))).verdict
    return verdict
