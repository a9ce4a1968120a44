"""Are two sets of equations of motion the same?  Proved, refuted with a witness, or undecided.

*Proved* comes only from the normal form of the trigonometric ring.  *Refuted* comes only with a
real state at which interval arithmetic shows that the accelerations differ.  Agreement at any
number of points proves nothing and is never called proof.  Course sections 2.4, 3.1 and 3.8.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from html import escape

from sympy.physics.vector.printing import vlatex, vsstrrepr

from engdyn.algebra.elimination import determinant, independent_columns, is_singular
from engdyn.algebra.ring import Element
from engdyn.algebra.union import common_ring
from engdyn.errors import EngdynError, OutsideRingError
from engdyn.modeling.differences import Difference, differences
from engdyn.modeling.equations import EquationsOfMotion
from engdyn.modeling.speeds import Transformation, names, restated, transformation
from engdyn.modeling.witness import Witness, different_values, find_witness

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

    def _repr_html_(self) -> str:
        """The verdict, the witness and a table of the wrong terms: what stands there and what should."""
        parts = [f"<b>{self.verdict}</b>: {escape(self.method)}"]
        if self.witness is not None:
            parts.append(f"<small>at {escape(str(self.witness))}</small>")
        text = "<br>".join(parts)
        if not self.differences:
            return text
        rows = "".join(_html_row(difference) for difference in self.differences[:SHOWN])
        columns = ("equation", "your term", "should be", "remark")
        heads = "".join(f'<th style="text-align:left">{head}</th>' for head in columns)
        more = len(self.differences) - SHOWN
        rest = f"and {more} more: the equations have little in common" if more > 0 else ""
        return f"{text}<table><tr>{heads}</tr>{rows}</table>{rest}"


def _html_row(difference: Difference) -> str:
    given, expected = (f"$\\displaystyle {vlatex(e)}$" for e in (difference.given, difference.expected))
    cells = [
        difference.where.removeprefix("equation "),
        "missing" if difference.kind == "missing" else given,
        "nothing" if difference.kind == "extra" else expected,
        escape(difference.remark or difference.in_short),
    ]
    return "<tr>" + "".join(f'<td style="text-align:left">{cell}</td>' for cell in cells) + "</tr>"


def prove_equal(a: EquationsOfMotion, b: EquationsOfMotion) -> Proof:
    """Decide whether two sets of equations of motion describe the same motion.

    Parameters
    ----------
    a, b : EquationsOfMotion
        In the same coordinates; rows may be scaled, reordered or combined.  The speeds may differ
        where both allow the same velocities: other independent rates of a nonholonomic system, or
        body rates instead of rates of angles.  Then `a` is written in the speeds of `b`.

    Returns
    -------
    Proof
        Truthy only when proved.  Differences are told from the side of `a`: "missing" means that
        `a` lacks a term that `b` has.

    Raises
    ------
    EngdynError
        Other coordinates, another number of speeds, speeds that do not determine each other, or a
        mass matrix that is singular identically.

    Notes
    -----
    Course sections 3.1 and 3.8.
    """
    _check(a, b)
    try:
        if set(names(a.speeds)) == set(names(b.speeds)) and _same_rates(a, b):
            return _compare(a, b)
        return _in_other_speeds(a, b)
    except OutsideRingError as error:
        return Proof("undecided", f"outside the exact algebra: {error}")


def _check(a: EquationsOfMotion, b: EquationsOfMotion) -> None:
    for which, eom in (("first", a), ("second", b)):
        if not isinstance(eom, EquationsOfMotion):
            given = repr(eom) if len(repr(eom)) <= 60 else f"{repr(eom)[:57]}..."
            raise EngdynError(
                f"the {which} argument, {given}, is not EquationsOfMotion: make them with "
                "EquationsOfMotion.from_residuals(equations, coordinates), newton_euler or lagrange"
            )
    first, second = names(a.coordinates), names(b.coordinates)
    if set(first) != set(second):
        raise EngdynError(
            f"the coordinates differ: {', '.join(first)} and {', '.join(second)}; use the same in both"
        )
    first, second = names(a.speeds), names(b.speeds)
    if len(first) != len(second):
        raise EngdynError(
            f"the speeds differ in number: {len(first)} ({', '.join(first)}) and {len(second)} "
            f"({', '.join(second)}); both sets must have the same degrees of freedom, so give both the same "
            "velocity constraints"
        )


def _same_rates(a: EquationsOfMotion, b: EquationsOfMotion) -> bool:
    _, (into_a, into_b) = common_ring([a.ring, b.ring])
    wanted = [into_b(b.rates[names(b.coordinates).index(q)]) for q in names(a.coordinates)]
    return _equal([into_a(e) for e in a.rates], wanted)


def _in_other_speeds(a: EquationsOfMotion, b: EquationsOfMotion) -> Proof:
    """Compare after writing the first set in the speeds of the second."""
    change = transformation(a, b)
    alike = set(names(a.speeds)) == set(names(b.speeds))
    if alike or not change.consistent:
        proof = None if not (change.consistent and change.regular) else _restated_proof(a, b, change, alike)
        settled = proof is not None and proof.verdict != "refuted"
        return proof if settled else _different_kinematics(a, b, change)
    if not change.regular:
        raise EngdynError(
            f"the speeds {', '.join(names(b.speeds))} cannot be found from the rates of the coordinates: their "
            "kinematics q̇ = G u + g are singular everywhere, so they cannot be compared with other speeds"
        )
    return _restated_proof(a, b, change, alike)


def _restated_proof(a: EquationsOfMotion, b: EquationsOfMotion, change: Transformation, alike: bool) -> Proof:
    proof = _compare(restated(a, b, change), b)
    first, second = (", ".join(names(eom.speeds)) for eom in (a, b))
    zeros = " and ".join(map(vsstrrepr, change.excluded))
    where = f" (possible where {zeros} is not zero)" if len(change.excluded) == 1 else ""
    where = f" (possible where none of {zeros} is zero)" if len(change.excluded) > 1 else where
    how = (
        f"the speeds {first} have another meaning in the second set"
        if alike
        else f"with the speeds {first} of the first set written in {second} of the second"
    )
    return replace(proof, method=f"{how}{where}: {proof.method}")


def _compare(a: EquationsOfMotion, b: EquationsOfMotion) -> Proof:
    """Compare two sets in the same speeds, with the same kinematics."""
    ring, (into_a, into_b) = common_ring([a.ring, b.ring])
    order = [names(b.speeds).index(u) for u in names(a.speeds)]
    mass_a, force_a = [[into_a(e) for e in row] for row in a.mass], [into_a(e) for e in a.force]
    mass_b = [[into_b(row[j]) for j in order] for row in b.mass]
    force_b = [into_b(e) for e in b.force]
    for which, mass in (("first", mass_a), ("second", mass_b)):
        if is_singular(mass):
            raise EngdynError(
                f"singular mass matrix of the {which} set: its determinant is zero identically, so there are no "
                "accelerations to compare; is one equation a combination of the others?"
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


def _different_kinematics(a: EquationsOfMotion, b: EquationsOfMotion, change: Transformation) -> Proof:
    """A state at which a rate of a coordinate differs: speeds of one name first, else equal other rates."""
    if set(names(a.speeds)) == set(names(b.speeds)):
        first = [change.into[0](e) for e in a.rates]
        method = "the kinematics q̇ = G u + g differ at a real state"
    else:
        first = list(change.first)
        method = "the velocity constraints differ: where the other rates are equal, one rate of a coordinate is not"
    quantities = [f"the rate of {q}" for q in names(a.coordinates)]
    witness = different_values(change.ring, quantities, first, change.second)
    if witness is None:
        return Proof("undecided", "the kinematics differ in form, but no real state was found that shows it")
    return Proof("refuted", method, witness)


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
