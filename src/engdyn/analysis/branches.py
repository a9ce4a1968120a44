"""Branches of equilibria over a parameter: followed around folds and through branch points.

Course section 4.3.  Pseudo-arclength continuation after H. B. Keller (in *Applications of
Bifurcation Theory*, 1977); the classification of singular points after Govaerts, *Numerical Methods
for Bifurcations of Dynamical Equilibria* (2000).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import sympy as sm

from engdyn.analysis.continuation import trace
from engdyn.analysis.equilibrium import Equilibrium, Region, equilibria
from engdyn.analysis.family import Curve, Family
from engdyn.analysis.linear import linearize, sorted_eigenvalues
from engdyn.analysis.neutral import neutral_eigenvalues
from engdyn.analysis.prescribed import symbols_in
from engdyn.analysis.small_motion import assemble, compiled_blocks, unpacked
from engdyn.analysis.stability import verdict_of
from engdyn.errors import EngdynError
from engdyn.modeling.equations import EquationsOfMotion
from engdyn.modeling.numbers import input_values, parameter_values

__all__ = ["Branch", "BranchPoint", "BranchSet", "continue_equilibria"]


@dataclass(frozen=True, eq=False)
class Branch:
    """A family of equilibria over the parameter.

    Attributes
    ----------
    parameter : ndarray, shape (N,)
        Values of the parameter [SI], in the order in which the branch was followed.
    q : ndarray, shape (N, n)
        Coordinates [m, rad].
    stable : ndarray of bool, shape (N,)
        Whether each equilibrium is asymptotically stable (neutral directions apart).
    """

    parameter: np.ndarray
    q: np.ndarray
    stable: np.ndarray

    def __repr__(self) -> str:
        share = "stable" if self.stable.all() else "unstable" if not self.stable.any() else "partly stable"
        ends = f"{self.parameter.min():.5g} to {self.parameter.max():.5g}"
        return f"Branch({len(self.parameter)} points, {ends}, {share})"


@dataclass(frozen=True, eq=False)
class BranchPoint:
    """A point where equilibria meet.

    Attributes
    ----------
    kind : {"fold", "pitchfork", "transcritical", "multiple", "neutral family"}
        "multiple" where the equations lose more than one rank; "neutral family" where other equilibria
        with the same value of the parameter lie arbitrarily near.
    parameter : float
        Value of the parameter [SI].
    q : ndarray, shape (n,)
        Coordinates [m, rad].
    """

    kind: str
    parameter: float
    q: np.ndarray

    def __repr__(self) -> str:
        return f"{self.kind} at {self.parameter:.6g}, q = {np.round(self.q, 6).tolist()}"


@dataclass(frozen=True, eq=False, repr=False)
class BranchSet(Sequence):
    """Branches over one parameter and the points where they meet.

    Attributes
    ----------
    parameter : str
        Name of the varied parameter.
    range : (float, float)
    points : tuple of BranchPoint
    coordinates : tuple of str
    """

    items: tuple[Branch, ...]
    points: tuple[BranchPoint, ...]
    parameter: str
    range: tuple[float, float]
    coordinates: tuple[str, ...]

    def __len__(self) -> int:
        return len(self.items)

    def __getitem__(self, index: Any) -> Any:
        return self.items[index]

    def __repr__(self) -> str:
        head = f"{len(self)} branch{'es' if len(self) != 1 else ''} over {self.parameter}"
        return "\n".join([head, *(f"  {item!r}" for item in (*self.items, *self.points))])


def continue_equilibria(
    eom: EquationsOfMotion,
    values: Mapping[str, float],
    parameter: str,
    range: tuple[float, float],
    *,
    bounds: Mapping[str, tuple[float, float]] | None = None,
    inputs: Mapping[str, Any] | None = None,
    rates: Mapping[str, float] | None = None,
    accelerations: Mapping[str, float] | None = None,
    free: Sequence[str] = (),
    region: Region | None = None,
    starts: int = 5,
) -> BranchSet:
    """Follow all equilibria while one parameter varies.

    Parameters
    ----------
    eom, values, bounds, inputs, rates, accelerations, free, region :
        As in :func:`engdyn.equilibria`; what is given as an expression in the parameter follows it.
    parameter : str
        Name of the parameter that varies; it occurs in the equations, or in what is prescribed.
    range : (float, float)
        First and last value of it [SI].
    starts : int
        Number of parameter values, evenly spaced, at which all equilibria are searched for to
        start from; closed loops of equilibria between them could be missed.

    Returns
    -------
    BranchSet
        Branches with their stability; folds, pitchforks and transcritical points located.

    Raises
    ------
    EngdynError
        Unknown parameter, a reversed or infinite range.

    Notes
    -----
    Course section 4.3.
    """
    if not isinstance(eom, EquationsOfMotion):
        raise EngdynError(f"eom is {eom!r}: give EquationsOfMotion, for example system.lagrange()")
    if not isinstance(values, Mapping):
        raise EngdynError(f"values is {values!r}: give a mapping of parameter names to numbers in SI units")
    steady = {"inputs": inputs, "rates": rates, "accelerations": accelerations, "free": free}
    symbol, (low, high) = _varied(eom, parameter, steady), _checked_range(parameter, range)
    family = Family(eom, values, symbol, (low, high), bounds, steady, region)
    places = [float(x) for x in np.linspace(low, high, max(int(starts), 2))]
    found = [equilibria(eom, {**values, parameter: x}, bounds, region=region, **steady) for x in places]
    if all(set(each.neutral) != set(family.problem.neutral) for each in found):
        raise EngdynError(
            f"{parameter} changes which motion is neutral ({', '.join(found[0].neutral)}): vary another "
            "parameter, or search for equilibria at single values of this one"
        )
    seeds = [(x, family.unknown_part(e)) for x, each in zip(places, found, strict=True) for e in each]
    family.fit([z for _, z in seeds])
    curves, singular = trace(family, seeds)
    ends = [np.append(z, at) for _, at, z in singular]
    branches = tuple(_branch(family, curve, ends) for curve in curves)
    points = tuple(BranchPoint(kind, at, family.coordinates(z, at)) for kind, at, z in singular)
    return BranchSet(branches, points, parameter, (low, high), tuple(family.names))


def _varied(eom: EquationsOfMotion, parameter: str, steady: Mapping[str, Any]) -> sm.Symbol:
    """Symbol of the parameter, in the equations or else in what is prescribed."""
    known = {s.name: s for given in steady.values() for s in symbols_in(given)}
    known |= {p.name: p for p in eom.parameters}
    if parameter not in known:
        raise EngdynError(f"unknown parameter {parameter!r}: the equations have {', '.join(known)}")
    return known[parameter]


def _checked_range(parameter: str, range: Any) -> tuple[float, float]:
    try:
        low, high = (float(x) for x in range)
    except (TypeError, ValueError) as error:
        raise EngdynError(f"range is {range!r}: give (first, last) value of {parameter}") from error
    if not (np.isfinite(low) and np.isfinite(high) and low < high):
        raise EngdynError(f"range is ({low:g}, {high:g}): give two finite values, the smaller one first")
    return low, high


def _branch(family: Family, curve: Curve, singular: Sequence[np.ndarray]) -> Branch:
    """A branch with the stability of each of its points; an end on a branch point follows its neighbor."""
    parameter = np.array([at for at, _ in curve])
    states = [family.equilibrium(z, at) for at, z in curve]
    stable = _stable(family, states)
    for end, neighbor in ((0, 1), (-1, -2)):
        at, z = curve[end]
        if any(np.allclose(np.append(z, at), point, rtol=1e-9, atol=1e-9) for point in singular):
            stable[end] = stable[neighbor]
    q = np.array([state.q for state in states])
    for unknown, periodic in zip(family.unknowns, family.periodic, strict=True):
        if periodic:  # whole turns off, the branch left in one piece
            column = family.names.index(unknown.name)
            q[:, column] -= 2 * np.pi * np.round((np.median(q[:, column]) - 1e-9) / (2 * np.pi))
    return Branch(parameter, q, stable)


def _stable(family: Family, states: Sequence[Equilibrium]) -> np.ndarray:
    """Verdict at every point, all eigenvalues in one batch."""
    eom, count = family.eom, len(states)
    rows = []
    for s in states:
        given = [*parameter_values(eom, s.values), *input_values(eom, s.inputs, s.values)]
        rows.append([*s.q, *s.speeds, *given, 0.0, *s.accelerations])
    flat = compiled_blocks(eom, "numpy")(*np.array(rows, dtype=float).T)
    flat = np.stack([np.broadcast_to(np.asarray(x, dtype=float), (count,)) for x in flat], axis=-1)
    found = sorted_eigenvalues(np.linalg.eigvals(assemble(unpacked(eom, flat))))
    # A single state could be a branch point, where more eigenvalues are zero than elsewhere.
    samples = {min(count - 1, place * count // 4) for place in (1, 2, 3)}
    neutral = min(neutral_eigenvalues(linearize(eom, states[i])) for i in samples)
    return np.array([verdict_of(each, neutral) == "asymptotically stable" for each in found])
