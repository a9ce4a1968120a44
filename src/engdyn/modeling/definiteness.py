"""Is a kinetic energy positive for every motion?  Asked of the mass matrix, answered honestly.

*Not positive definite* comes with a real state at which interval arithmetic shows it; *singular* is exact.
*Positive definite* is exact where the matrix holds numbers only, and otherwise what was found at many states:
the words say so.  Course sections 3.6 and 3.8.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import islice
from typing import Any

import sympy as sm

from engdyn.algebra.balls import ball, contains_zero, is_finite, midpoint
from engdyn.algebra.codegen import compile_elements
from engdyn.algebra.elimination import is_singular
from engdyn.algebra.ring import Element
from engdyn.errors import OutsideRingError
from engdyn.modeling.witness import key_name, sample_states

__all__ = ["Definiteness", "definiteness"]

#: States looked at.
STATES = 32


@dataclass(frozen=True)
class Definiteness:
    """Whether a mass matrix is positive definite, so that every motion has kinetic energy.

    Attributes
    ----------
    verdict : {"positive definite", "not positive definite", "singular", "depends", "undecided"}
        "depends": positive definite at some of the states, not at others; give parameter values.
    method : str
        How the verdict was reached.
    witness : dict of str to float or None
        A state and parameters at which the matrix is not positive definite [SI].
    """

    verdict: str
    method: str
    witness: dict[str, float] | None = None

    def __bool__(self) -> bool:
        return self.verdict == "positive definite"

    def __repr__(self) -> str:
        place = ", ".join(f"{name} = {value:.4g}" for name, value in (self.witness or {}).items())
        return f"{self.verdict}: {self.method}{f', not at {place}' if place else ''}"


def definiteness(
    mass: Sequence[Sequence[Element]], values: Mapping[str, float] | None = None
) -> Definiteness:
    """Judge a symmetric mass matrix by its pivots, in interval arithmetic at reproducible states.

    Parameters
    ----------
    mass : Element matrix, shape (m, m)
    values : mapping of str to float, optional
        Parameters [SI]; without them positive numbers are tried for every parameter.

    Returns
    -------
    Definiteness
    """
    if is_singular(mass):
        return Definiteness("singular", "its determinant is zero identically: some motion has no inertia")
    entries = [entry for row in mass for entry in row]
    ring = mass[0][0].ring
    keys = [key for key in map(ring.keys.__getitem__, ring.independent(entries)) if key[1] is not sm.pi]
    try:
        function = compile_elements(entries, keys, "balls")
    except OutsideRingError as error:
        return Definiteness("undecided", str(error))
    given = {name: Fraction(repr(float(value))) for name, value in (values or {}).items()}
    good, bad = 0, []
    for state in islice(sample_states(keys), STATES if keys else 1):
        state |= {key: given[str(key[1])] for key in keys if key[0] == "symbol" and str(key[1]) in given}
        signs = _pivots(function(*(ball(state[key]) for key in keys)), len(mass))
        good += signs is True
        bad += [state] if signs is False else []
    witness = {key_name(key): float(value) for key, value in bad[0].items()} if bad else None
    if good and bad:
        return Definiteness("depends", f"positive definite at {good} of {good + len(bad)} states", witness)
    if bad:
        return Definiteness("not positive definite", f"at all {len(bad)} states looked at", witness)
    if good:
        return Definiteness("positive definite", f"at all {good} states looked at" if keys else "exactly")
    return Definiteness("undecided", "interval arithmetic decides at none of the states")


def _pivots(flat: Sequence[Any], n: int) -> bool | None:
    """Whether all pivots of LDLᵀ are positive; None where a ball contains zero."""
    rows = [list(flat[i * n : (i + 1) * n]) for i in range(n)]
    for k in range(n):
        head = rows[k][k]
        if not is_finite(head) or contains_zero(head):
            return None
        if midpoint(head) < 0:
            return False
        for i in range(k + 1, n):
            factor = rows[i][k] / head
            rows[i] = [x - factor * y for x, y in zip(rows[i], rows[k], strict=True)]
    return True
