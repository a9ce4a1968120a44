"""Are two sets of equations of motion the same?  Proved, refuted with a witness, or undecided.

*Proved* comes only from the normal form of the trigonometric ring.  *Refuted* comes only with a
real state at which interval arithmetic shows that the accelerations differ.  Agreement at any
number of points proves nothing and is never called proof.  Course sections 2.4, 3.1 and 3.8.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import sympy as sm

from engdyn.algebra.elimination import determinant, is_singular
from engdyn.algebra.ring import Element, Ring
from engdyn.algebra.union import common_ring
from engdyn.errors import EngdynError, OutsideRingError
from engdyn.modeling.differences import Difference, differences
from engdyn.modeling.equations import EquationsOfMotion
from engdyn.modeling.witness import Witness, find_witness

__all__ = ["Proof", "prove_equal"]

Matrix = list[list[Element]]


@dataclass(frozen=True)
class Proof:
    """The verdict on the equality of two sets of equations of motion.

    Attributes
    ----------
    verdict : {"proved", "refuted", "undecided"}
    method : str
        How the verdict was reached.
    witness : Witness or None
        For "refuted": a real state and the two accelerations there.
    differences : tuple of Difference
        For "refuted": terms that are missing, extra or scaled in the first set.
    """

    verdict: str
    method: str
    witness: Witness | None = None
    differences: tuple[Difference, ...] = ()

    def __bool__(self) -> bool:
        return self.verdict == "proved"

    def __repr__(self) -> str:
        lines = [f"{self.verdict}: {self.method}"]
        if self.witness is not None:
            lines.append(f"  at {self.witness}")
        lines += [f"  {difference}" for difference in self.differences]
        return "\n".join(lines)


def prove_equal(a: EquationsOfMotion, b: EquationsOfMotion) -> Proof:
    """Decide whether two sets of equations of motion describe the same motion.

    Parameters
    ----------
    a, b : EquationsOfMotion
        In the same coordinates and speeds; rows may be scaled, reordered or combined.

    Returns
    -------
    Proof
        Truthy only when proved.  Differences are told from the side of `a`: "missing" means that
        `a` lacks a term that `b` has.

    Raises
    ------
    EngdynError
        Other coordinates or speeds, or a mass matrix that is singular identically.

    Notes
    -----
    Course sections 3.1 and 3.8.
    """
    for eom in (a, b):
        if not isinstance(eom, EquationsOfMotion):
            raise EngdynError(
                f"{eom!r} is not EquationsOfMotion: make them with EquationsOfMotion.from_residuals"
            )
    for what in ("coordinates", "speeds"):
        first, second = (_names(getattr(eom, what)) for eom in (a, b))
        if set(first) != set(second):
            raise EngdynError(
                f"the {what} differ: {', '.join(first)} and {', '.join(second)}; use the same in both"
            )
    try:
        return _compare(a, b)
    except OutsideRingError as error:
        return Proof("undecided", f"outside the exact algebra: {error}")


def _names(quantities: Sequence[sm.Expr]) -> list[str]:
    """Names of dynamicsymbols and rates: theta, theta'."""
    return [f"{x.expr.func.__name__}'" if x.is_Derivative else x.func.__name__ for x in quantities]


def _compare(a: EquationsOfMotion, b: EquationsOfMotion) -> Proof:
    ring, (into_a, into_b) = common_ring([a.ring, b.ring])
    order = [_names(b.speeds).index(u) for u in _names(a.speeds)]
    mass_a, force_a = [[into_a(e) for e in row] for row in a.mass], [into_a(e) for e in a.force]
    mass_b = [[into_b(row[j]) for j in order] for row in b.mass]
    force_b = [into_b(e) for e in b.force]
    rates_a = [into_a(e) for e in a.rates]
    rates_b = [into_b(b.rates[_names(b.coordinates).index(q)]) for q in _names(a.coordinates)]
    if not _equal(rates_a, rates_b):
        return _different_kinematics(a, ring, rates_a, rates_b)
    for mass in (mass_a, mass_b):
        if is_singular(mass):
            raise EngdynError(
                "singular mass matrix: its determinant is zero identically, so there are no accelerations to compare"
            )
    entries = [*(e for row in mass_a for e in row), *force_a], [*(e for row in mass_b for e in row), *force_b]
    if _equal(*entries):
        return Proof("proved", "every entry of M and f has the same normal form")
    witness = find_witness(ring, a, (mass_a, force_a), (mass_b, force_b))
    if witness is not None:
        found = differences(a, ring, (mass_a, force_a), (mass_b, force_b))
        return Proof("refuted", "the accelerations differ at a real state", witness, found)
    return _row_equivalence(mass_a, force_a, mass_b, force_b)


def _equal(a: Sequence[Element], b: Sequence[Element]) -> bool:
    return all(x.equals(y) for x, y in zip(a, b, strict=True))


def _different_kinematics(
    a: EquationsOfMotion, ring: Ring, rates_a: list[Element], rates_b: list[Element]
) -> Proof:
    from engdyn.modeling.witness import different_values

    witness = different_values(ring, [str(q) for q in a.coordinates], rates_a, rates_b)
    if witness is None:
        return Proof("undecided", "the kinematics differ in form, but no real state was found that shows it")
    return Proof("refuted", "the kinematics q̇ = G u + g differ at a real state", witness)


def _row_equivalence(mass_a: Matrix, force_a: list[Element], mass_b: Matrix, force_b: list[Element]) -> Proof:
    """M_b adj(M_a) f_a = det(M_a) f_b with both determinants nonzero: the same accelerations."""
    det_a = determinant(mass_a)
    if (det_a * determinant(mass_b)).is_zero():  # possible with |x|: each is zero on one side
        return Proof(
            "undecided", "nowhere are both mass matrices regular: there is no state to compare them at"
        )
    cramer = [
        determinant([[*row[:j], f, *row[j + 1 :]] for row, f in zip(mass_a, force_a, strict=True)])
        for j in range(len(force_a))
    ]
    for row, f in zip(mass_b, force_b, strict=True):
        total = -(det_a * f)
        for entry, numerator in zip(row, cramer, strict=True):
            total = total + entry * numerator
        if not total.is_zero():
            return Proof(
                "undecided",
                "the normal forms differ, but no real state was found at which the accelerations do",
            )
    return Proof(
        "proved",
        "M_b adj(M_a) f_a − det(M_a) f_b has the normal form zero: the rows are combinations of each other",
    )
