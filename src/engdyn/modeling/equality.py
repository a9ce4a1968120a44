"""Are two sets of equations of motion the same?  Proved, refuted with a witness, or undecided.

*Proved* comes only from the normal form of the trigonometric ring.  *Refuted* comes only with a
real state at which interval arithmetic shows that the accelerations differ.  Agreement at any
number of points proves nothing and is never called proof.  Course sections 2.4, 3.1 and 3.8.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import sympy as sm

from engdyn.algebra.elimination import determinant, independent_columns, is_singular
from engdyn.algebra.ring import Element, Ring
from engdyn.algebra.union import common_ring
from engdyn.errors import EngdynError, OutsideRingError
from engdyn.modeling.differences import Difference, differences
from engdyn.modeling.equations import EquationsOfMotion
from engdyn.modeling.witness import Witness, find_witness

__all__ = ["Proof", "prove_equal"]

Matrix = list[list[Element]]

#: Differences that the text of a proof lists.
SHOWN = 8


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
        lines += [f"  {difference}" for difference in self.differences[:SHOWN]]
        if len(self.differences) > SHOWN:
            lines.append(f"  and {len(self.differences) - SHOWN} more: the equations have little in common")
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
        try:
            found = differences(a, ring, (mass_a, force_a), (mass_b, force_b))
        except OutsideRingError:  # too large to be compared term by term: the witness stands all the same
            found = ()
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
    """Whether every row of ``[M_b | f_b]`` is a combination of rows of ``[M_a | f_a]``."""
    ring = force_a[0].ring
    domain = all(d.kind in ("sine", "cosine") for d in ring.definitions.values())
    if not domain and (determinant(mass_a) * determinant(mass_b)).is_zero():  # |x| + x and |x| − x
        return Proof(
            "undecided", "nowhere are both mass matrices regular: there is no state to compare them at"
        )
    rows, others = (
        [[*row, f] for row, f in zip(*both, strict=True)] for both in ((mass_a, force_a), (mass_b, force_b))
    )
    left, wanted = list(rows), []
    for row in others:
        at = next((i for i, known in enumerate(left) if _combines([known], row)), None)
        if at is None:
            wanted.append(row)
        else:
            left.pop(at)
    if any(all(_combines(some, row) for row in wanted) for some in (left, rows)):
        return Proof(
            "proved",
            "the rows of [M | f] are combinations of each other: all minors have the normal form zero",
        )
    return Proof(
        "undecided", "the normal forms differ, but no real state was found at which the accelerations do"
    )


def _combines(rows: Matrix, row: list[Element]) -> bool:
    """Whether a row is a combination of k independent rows: all minors of order k + 1 are zero."""
    chosen: list[int] = []
    for column in range(len(row) - 1):
        trial = [*chosen, column]
        if len(trial) <= len(rows) and independent_columns([[r[j] for j in trial] for r in rows], len(trial)):
            chosen = trial
    others = [j for j in range(len(row)) if j not in chosen]
    minors = ([[r[j] for j in (*chosen, other)] for r in (*rows, row)] for other in others)
    return all(determinant(minor).is_zero() for minor in minors)
