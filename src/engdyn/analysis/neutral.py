"""How many eigenvalues of small motion are zero whatever the parameters are.  Course section 5.5."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from sympy.physics.vector import dynamicsymbols

from engdyn.analysis.exact_sample import ExactSample, NoRootError, primes
from engdyn.analysis.linear import LinearSystem
from engdyn.analysis.residues import Matrix, solve, trailing_zeros
from engdyn.analysis.small_motion import motion_keys, small_motion
from engdyn.modeling.numbers import input_values, parameter_values

__all__ = ["neutral_eigenvalues"]

ATTEMPTS = 60
"""Samples that are tried; half of all radicands have a root modulo a prime."""


def neutral_eigenvalues(linear: LinearSystem) -> int:
    """Number of eigenvalues that are zero identically: trailing characteristic coefficients vanish.

    They are those of coordinates on which nothing depends, and of momenta that are conserved. The state
    matrix is evaluated exactly, modulo a prime, with random parameters, at the coordinates of the
    equilibrium. A parameter that is zero (no damping, say) may add to the count only what it adds at other
    coordinates, too: a stiffness that vanishes at one point is a critical state, not a neutral coordinate.

    Parameters
    ----------
    linear : LinearSystem
        With numbers.

    Returns
    -------
    int
    """
    count = min(_zeros(linear, seed, zeros_too=True) for seed in (1, 2))
    eom, at = linear.eom, linear.at
    if all(parameter_values(eom, at.values)) and all(input_values(eom, at.inputs, at.values)):
        return count
    here = _zeros(linear, 3)
    return max(count, min(here, _zeros(linear, 4, moved=True))) if here > count else count


def _zeros(linear: LinearSystem, seed: int, **choices: bool) -> int:
    """Zero eigenvalues of one random sample; a radicand without a root asks for another prime."""
    for attempt in range(1, ATTEMPTS):
        prime = primes(attempt)[-1]
        try:
            sample = _sample(linear, ATTEMPTS * seed + attempt, prime, **choices)
            return trailing_zeros(_state_matrix(linear, sample, prime), prime)
        except NoRootError:
            continue
    return 0  # not counted: the verdict then judges all eigenvalues and says marginal


def _sample(
    linear: LinearSystem, seed: int, prime: int, zeros_too: bool = False, moved: bool = False
) -> ExactSample:
    """Coordinates, speeds and accelerations of the state, parameters and inputs at random.

    Those that are zero stay zero unless `zeros_too`; the coordinates are random, too, where `moved`.
    """
    eom, at = linear.eom, linear.at
    sample = ExactSample(eom.ring, seed, prime)
    q_keys, u_keys, a_keys = motion_keys(eom)
    for key, x in zip([*u_keys, *a_keys, *q_keys], [*at.speeds, *at.accelerations, *at.q], strict=True):
        sample.given[key] = Fraction(repr(float(x))) if abs(x) > 1e-12 else Fraction(0)
    if moved:
        sample.given |= {key: sample.random(1000) for key in q_keys}
    named = [("symbol", p) for p in eom.parameters]
    named += [("function", w, k) for w in eom.inputs for k in (0, 1, 2)]
    numbers = [*parameter_values(eom, at.values), *input_values(eom, at.inputs, at.values)]
    for key, x in zip(named, numbers, strict=True):
        sample.given[key] = sample.random() if x or zeros_too else Fraction(0)
    sample.given["symbol", dynamicsymbols._t] = Fraction(0)
    return sample


def _state_matrix(linear: LinearSystem, sample: ExactSample, prime: int) -> Matrix:
    """A modulo the prime."""
    blocks = small_motion(linear.eom)
    needed = ("M", "C", "K", "Gq", "G")
    numbers: dict[str, Any] = {
        name: [[sample.sum_of_products(entry) for entry in row] for row in blocks[name]] for name in needed
    }
    lower = solve(numbers["M"], [[*k, *c] for k, c in zip(numbers["K"], numbers["C"], strict=True)], prime)
    upper = [[*a, *b] for a, b in zip(numbers["Gq"], numbers["G"], strict=True)]
    return [*upper, *([-x % prime for x in row] for row in lower)]
