"""How many eigenvalues of small motion are zero whatever the parameters are.  Course section 5.5."""

from __future__ import annotations

from typing import Any

from engdyn.analysis.exact_sample import ExactSample, NoRootError, primes
from engdyn.analysis.linear import LinearSystem
from engdyn.analysis.small_motion import small_motion
from engdyn.errors import EngdynError
from engdyn.modeling.numbers import input_values, parameter_values

__all__ = ["neutral_eigenvalues"]

Matrix = list[list[int]]

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
            sample = ExactSample(linear, ATTEMPTS * seed + attempt, prime, **choices)
            return _trailing_zeros(_state_matrix(linear, sample, prime), prime)
        except NoRootError:
            continue
    return 0  # not counted: the verdict then judges all eigenvalues and says marginal


def _state_matrix(linear: LinearSystem, sample: ExactSample, prime: int) -> Matrix:
    """A modulo the prime."""
    blocks = small_motion(linear.eom)
    needed = ("M", "C", "K", "Gq", "G")
    numbers: dict[str, Any] = {
        name: [[sample.sum_of_products(entry) for entry in row] for row in blocks[name]] for name in needed
    }
    lower = _solve(numbers["M"], [[*k, *c] for k, c in zip(numbers["K"], numbers["C"], strict=True)], prime)
    upper = [[*a, *b] for a, b in zip(numbers["Gq"], numbers["G"], strict=True)]
    return [*upper, *([-x % prime for x in row] for row in lower)]


def _solve(matrix: Matrix, right: Matrix, prime: int) -> Matrix:
    """Gauss–Jordan elimination modulo the prime."""
    n = len(matrix)
    rows = [[*a, *b] for a, b in zip(matrix, right, strict=True)]
    for column in range(n):
        pivot = next((i for i in range(column, n) if rows[i][column]), None)
        if pivot is None:
            raise EngdynError("singular mass matrix: stability cannot be judged there")
        rows[column], rows[pivot] = rows[pivot], rows[column]
        inverse = pow(rows[column][column], -1, prime)
        rows[column] = [x * inverse % prime for x in rows[column]]
        for i in range(n):
            factor = rows[i][column]
            if i != column and factor:
                rows[i] = [(x - factor * y) % prime for x, y in zip(rows[i], rows[column], strict=True)]
    return [row[n:] for row in rows]


def _trailing_zeros(matrix: Matrix, prime: int) -> int:
    """How often λ divides the characteristic polynomial: n − rank(Aⁿ)."""
    n, power, rank = len(matrix), matrix, _rank(matrix, prime)
    while True:
        columns = list(zip(*power, strict=True))
        power = [[sum(map(int.__mul__, row, column)) % prime for column in columns] for row in power]
        if (lower := _rank(power, prime)) == rank:
            return n - rank
        rank = lower


def _rank(matrix: Matrix, prime: int) -> int:
    rows, rank = [list(row) for row in matrix], 0
    for column in range(len(matrix)):
        pivot = next((i for i in range(rank, len(rows)) if rows[i][column]), None)
        if pivot is None:
            continue
        rows[rank], rows[pivot] = rows[pivot], rows[rank]
        inverse = pow(rows[rank][column], -1, prime)
        for i in range(rank + 1, len(rows)):
            factor = rows[i][column] * inverse % prime
            if factor:
                rows[i] = [(x - factor * y) % prime for x, y in zip(rows[i], rows[rank], strict=True)]
        rank += 1
    return rank
