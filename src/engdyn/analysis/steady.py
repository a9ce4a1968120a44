"""What has to vanish in an equilibrium or a steady motion, and which quantities are unknown.

The general equilibrium problem of course section 4.4: constant rates and accelerations turn inertia
terms into constants; a coordinate that nothing depends on (an ignorable one), or a combination of
coordinates that nothing depends on, brings its rate, its acceleration or a driving input as the unknown
in its place.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import sympy as sm
from sympy.physics.vector import dynamicsymbols

from engdyn.algebra.ring import Element
from engdyn.analysis.directions import Ties, imply_rates, ties
from engdyn.analysis.prescribed import as_rational, by_coordinate, free_inputs, known_numbers
from engdyn.analysis.residuals import contents, inside_definitions, residuals, size
from engdyn.errors import EngdynError
from engdyn.modeling.equations import EquationsOfMotion
from engdyn.modeling.lagrange import substitute

__all__ = ["SteadyProblem", "Unknown", "as_rational"]

Key = tuple[Any, ...]


@dataclass(frozen=True)
class Unknown:
    """A quantity that an equilibrium search solves for.

    Attributes
    ----------
    key : tuple
        Its generator in the ring.
    name : str
        "theta", "x_d" (a rate), "x_dd" (an acceleration) or the name of an input.
    """

    key: Key
    name: str


class SteadyProblem:
    """Rows that are zero in a steady motion, with numbers for everything that is known.

    Parameters
    ----------
    eom, values, inputs, rates, accelerations, free :
        As in :func:`engdyn.equilibria`.
    keep : set of tuple
        Keys of generators to keep as symbols: a parameter to be varied, and rates, accelerations and
        inputs that vary with it.

    Attributes
    ----------
    rows : list of Element
        Residuals M u̇ − f (and kinematic rows of nonholonomic systems) that contain unknowns.
    unknowns : list of Unknown
        What is left to be searched for.
    eliminated : list of (Unknown, Element)
        Unknowns that follow from the others: they occur linearly, or their rates go together.
    neutral : list of str
        Coordinates that nothing depends on, and the first of every combination of that kind.
    unsatisfied : list of str
        Rows without unknowns that are not zero, in words.
    """

    def __init__(
        self,
        eom: EquationsOfMotion,
        values: Mapping[str, float],
        inputs: Mapping[str, Any] | None,
        rates: Mapping[str, float] | None,
        accelerations: Mapping[str, float] | None,
        free: Sequence[str] = (),
        keep: frozenset[Key] = frozenset(),
    ):
        self.eom, self.ring = eom, eom.ring
        self.names = [q.func.__name__ for q in eom.coordinates]
        self.rates = by_coordinate(self.names, rates, "rates")
        self.accelerations = by_coordinate(self.names, accelerations, "accelerations")
        self.free = free_inputs(eom, free)
        self.values, self.inputs = values, dict(inputs or {})
        held = {*self.free, *keep}
        self._keep = keep
        self._numbers = {k: v for k, v in known_numbers(eom, values, self.inputs).items() if k not in held}
        self.unknowns: list[Unknown] = []
        self.eliminated: list[tuple[Unknown, Element]] = []
        self.neutral: list[str] = []
        self.unsatisfied: list[str] = []
        self._specialize()
        self._check_time()
        self._drop_constant_rows(keep)

    # Rows

    def _specialize(self) -> None:
        """Put numbers into the residuals and find out what is unknown."""
        eom, ring = self.eom, self.ring
        keys = [("function", u.expr, 1) if u.is_Derivative else ("function", u, 0) for u in eom.speeds]
        raw = residuals(eom, keys, self.rates)
        self._inner = inside_definitions(ring, raw)
        self.constants = {
            ring.keys[i]: v for i, v in self._indexed(self._numbers).items() if i in self._inner
        }
        rows = self._with_numbers(raw, self._numbers)
        rows, tied = self._tied(rows, keys)
        motion, open_speeds = self._motion(rows, keys, tied)
        self._check_steady(rows, motion, tied)
        fixed = {k: x for k, x in motion.items() if k not in self._keep}
        rows = self._with_numbers(rows, fixed)
        self.constants |= {ring.keys[i]: x for i, x in self._indexed(fixed).items() if i in self._inner}
        known = {**self._indexed(self._numbers), **self._indexed(motion)}
        self._sizes = [size(row, known) for row in raw]
        self._labels = list(range(1, len(rows) + 1))
        pivots = {self.eom.coordinates[p] for p, _ in tied}
        occurring = [q for q in eom.coordinates if q not in pivots and self._occurs(q, rows)]
        self.neutral = [q.func.__name__ for q in eom.coordinates if q not in occurring]
        self.unknowns = [Unknown(("function", q, 0), q.func.__name__) for q in occurring]
        for key in open_speeds:
            rows = self._ignorable(key, rows)
        self._follow_tied(tied)
        self.unknowns += [Unknown(key, key[1].func.__name__) for key in self.free]
        self.rows = rows

    def _motion(
        self, rows: list[Element], keys: Sequence[Key], tied: Ties
    ) -> tuple[dict[Key, Fraction], list[Key]]:
        """Known rates and accelerations; and the rates that are unknown in place of their coordinates."""
        pivots = {self.eom.coordinates[p] for p, _ in tied}
        motion: dict[Key, Fraction] = {}
        open_speeds = []
        for key in keys:
            owner = key[1] if key[2] == 1 else None
            name = owner.func.__name__ if owner is not None else ""
            fixed = owner is None or (owner not in pivots and self._occurs(owner, rows))
            if fixed or name in self.rates or name in self.accelerations:
                motion[key] = self.rates.get(name, Fraction(0))
                motion[key[0], key[1], key[2] + 1] = self.accelerations.get(name, Fraction(0))
            else:
                open_speeds.append(key)
        return motion, open_speeds

    def _ignorable(self, key: Key, rows: list[Element]) -> list[Element]:
        """The unknown that stands in for an ignorable coordinate: its rate, else its acceleration."""
        acceleration, name = (key[0], key[1], key[2] + 1), key[1].func.__name__
        still = self._with_numbers(rows, {acceleration: Fraction(0)})
        if any(not self.ring.partial(key)(row).is_zero() for row in still):
            self.unknowns.append(Unknown(key, f"{name}_d"))
            return still
        self.unknowns.append(Unknown(acceleration, f"{name}_dd"))
        return self._with_numbers(rows, {key: Fraction(0)})

    # Coordinates that move together

    def _tied(self, rows: list[Element], keys: Sequence[Key]) -> tuple[list[Element], Ties]:
        """Combinations of coordinates on which nothing depends: their rates follow the first one's."""
        q_keys = [("function", q, 0) for q in self.eom.coordinates]
        here = [j for j, q in enumerate(self.eom.coordinates) if self._occurs(q, rows)]
        if len(keys) != len(q_keys) or len(here) < 2 or any(key[2] != 1 for key in keys):
            return rows, []
        found = ties(self.ring, rows, q_keys, here)
        moving = [(p, d) for p, d in found if not imply_rates(d, self.names, self.rates, self.accelerations)]
        images = {}
        for j in range(len(keys)):
            if any(d[j] and p != j for p, d in moving):
                for order in (1, 2):
                    images[self.ring.index["function", keys[j][1], order]] = self._combined(j, order, moving)
        if images.keys() & self._inner:
            return rows, []
        origin = {q_keys[p]: Fraction(0) for p, _ in found}
        self.constants |= {key: x for key, x in origin.items() if self.ring.index[key] in self._inner}
        return self._with_numbers([substitute(row, images) for row in rows], origin), found

    def _combined(self, j: int, order: int, tied: Ties) -> Element:
        """Rate (order 1) or acceleration of a coordinate that goes along with others."""
        leaders = [(("function", self.eom.coordinates[p], order), d[j]) for p, d in tied]
        return sum((self.ring.generator(key) * share for key, share in leaders), start=self.ring.zero)

    def _follow_tied(self, tied: Ties) -> None:
        """Book the rates that follow from the unknown ones."""
        open_keys = {u.key for u in self.unknowns}
        for order, suffix in ((1, "_d"), (2, "_dd")):
            leading = [(p, d) for p, d in tied if ("function", self.eom.coordinates[p], order) in open_keys]
            for j, q in enumerate(self.eom.coordinates):
                if any(d[j] and p != j for p, d in leading):
                    unknown = Unknown(("function", q, order), q.func.__name__ + suffix)
                    self.eliminated.append((unknown, self._combined(j, order, leading)))

    # Numbers in rows

    def _indexed(self, numbers: Mapping[Key, Fraction]) -> dict[int, Fraction]:
        return {self.ring.index[key]: value for key, value in numbers.items() if key in self.ring.index}

    def _with_numbers(self, rows: Sequence[Element], numbers: Mapping[Key, Fraction]) -> list[Element]:
        indexed = {i: value for i, value in self._indexed(numbers).items() if i not in self._inner}
        return [row.specialize(indexed) for row in rows]

    def contents(self, rows: Sequence[Element]) -> set[Key]:
        """Keys of all independent generators on which rows depend."""
        return contents(self.ring, rows)

    def _occurs(self, q: sm.Expr, rows: Sequence[Element]) -> bool:
        return ("function", q, 0) in self.contents(rows)

    # Checks

    def _check_steady(self, rows: Sequence[Element], motion: Mapping[Key, Fraction], tied: Ties) -> None:
        """Refuse prescribed rates with which an equation changes in time; a free input may follow it."""
        ring, named = self.ring, dict(zip(self.names, self.eom.coordinates, strict=True))
        sliding = dict(self.rates)
        for pivot, direction in tied:  # along these nothing changes
            rate = self.rates.get(self.names[pivot], Fraction(0))
            for name, share in zip(self.names, direction, strict=True):
                sliding[name] = sliding.get(name, Fraction(0)) - share * rate
        sliding = {n: x for n, x in sliding.items() if x}
        gaining = {n: x for n, x in self.accelerations.items() if x}
        drift = {("function", named[n], 0): x for n, x in sliding.items()}
        drift |= {("function", named[n], 1): x for n, x in gaining.items()}
        at = {key: x for key, x in motion.items() if key not in drift}
        for number, row in enumerate(rows, 1):
            if self.contents([row]) & set(self.free):
                continue
            parts = [ring.partial(key)(row) * x for key, x in drift.items() if key in ring.index]
            if not sum(self._with_numbers(parts, at), start=ring.zero).is_zero():
                going = [*(f"{n}_d" for n in sliding), *(f"{n}_dd" for n in gaining)]
                raise EngdynError(
                    f"the prescribed motion ({', '.join(going)}) is not steady: equation {number} changes in "
                    "time with it; prescribe zero, remove what resists it, or name a free input that follows"
                )

    def _check_time(self) -> None:
        known = {*(u.key for u in self.unknowns), *self.constants, *self._keep}
        moving = {
            str(key[1])
            for key in self.contents(self.rows)
            if key == ("symbol", dynamicsymbols._t)
            or (key[0] == "function" and key not in known and key[1] in self.eom.defaults and key[2] == 0)
        }
        if moving:
            raise EngdynError(
                f"the equations contain time explicitly (through {', '.join(sorted(moving))}): they have no "
                "equilibria; write them in coordinates in which the motion is steady, or set that input "
                "to zero"
            )

    def _drop_constant_rows(self, keep: frozenset[Key] = frozenset()) -> None:
        """Rows without unknowns are either satisfied (up to rounding of what is given) or never."""
        wanted = {u.key for u in self.unknowns} | keep
        kept = []
        for row, label, scale in zip(self.rows, self._labels, self._sizes, strict=True):
            if row.is_zero():
                continue
            value = row.as_rational()
            if self.contents([row]) & wanted:
                kept.append((row, label, scale))
            elif value is None or abs(value) > scale / 10**12:
                left = "a number that is not zero" if value is None else f"{float(value):.5g}"
                self.unsatisfied.append(f"equation {label} reads {left} = 0")
        self.rows, self._labels, self._sizes = ([entry[i] for entry in kept] for i in range(3))

    # Exact elimination of unknowns that occur linearly

    def eliminate_linear(self, bounded: Collection[str] = ()) -> None:
        """Solve rows for unknowns that occur linearly with a constant factor; shrinks rows and unknowns.

        Those without bounds come first: what is left at the end must be searched for in a region.
        """
        while self._eliminate_one(bounded):
            pass

    def _eliminate_one(self, bounded: Collection[str]) -> bool:
        inner = inside_definitions(self.ring, self.rows)
        order = sorted(range(len(self.unknowns)), key=lambda i: (self.unknowns[i].name in bounded, -i))
        for unknown in (self.unknowns[i] for i in order):
            index = self.ring.index.get(unknown.key)
            if index is None or index in inner:
                continue
            slopes = [self.ring.partial(unknown.key)(row) for row in self.rows]
            factors = [self._number(slope) for slope in slopes]
            at = next((i for i, factor in enumerate(factors) if factor), None)
            if at is not None:
                self._replace(unknown, at, slopes[at], factors)
                return True
        return False

    def _number(self, element: Element) -> Fraction | None:
        """The value of an element in which nothing is unknown, whatever stands in angles and functions too."""
        return element.specialize(self._indexed(self.constants)).as_rational()

    def _replace(self, unknown: Unknown, at: int, slope: Element, factors: Sequence[Fraction | None]) -> None:
        """Solve row `at` for an unknown and put the solution everywhere."""
        factor, added = Fraction(factors[at] or 1), self._sizes[at]
        solution = self.ring.generator(unknown.key) - self.rows[at] / slope
        images = {self.ring.index[unknown.key]: solution}
        rest = [i for i in range(len(self.rows)) if i != at]
        self._sizes = [self._sizes[i] + added * abs((factors[i] or 0) / factor) for i in rest]
        self._labels = [self._labels[i] for i in rest]
        self.rows = [substitute(self.rows[i], images) for i in rest]
        self.eliminated = [(u, substitute(e, images)) for u, e in self.eliminated]
        self.eliminated.append((unknown, solution))
        self.unknowns = [u for u in self.unknowns if u is not unknown]
        self._drop_constant_rows()
