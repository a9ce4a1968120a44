"""What has to vanish in an equilibrium or a steady motion, and which quantities are unknown.

The general equilibrium problem of course section 4.4: constant rates and accelerations turn inertia
terms into constants; a coordinate that nothing depends on (an ignorable one) brings its rate, its
acceleration or a driving input as the unknown in its place.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import sympy as sm
from sympy.physics.vector import dynamicsymbols

from engdyn.algebra.ring import Element
from engdyn.errors import EngdynError
from engdyn.modeling.equations import EquationsOfMotion
from engdyn.modeling.numbers import input_values, parameter_values

__all__ = ["SteadyProblem", "Unknown"]

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
        Keys of generators to keep as symbols (a parameter to be varied).

    Attributes
    ----------
    rows : list of Element
        Residuals M u̇ − f (and kinematic rows of nonholonomic systems) that contain unknowns.
    unknowns : list of Unknown
        What is left to be searched for.
    eliminated : list of (Unknown, Element)
        Unknowns that occur linearly, with constant factors, solved for exactly.
    neutral : list of str
        Coordinates that nothing depends on.
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
        self.rates, self.accelerations = (
            self._by_coordinate(given, what)
            for given, what in ((rates, "rates"), (accelerations, "accelerations"))
        )
        self.free = self._free_inputs(free)
        self.values, self.inputs = values, dict(inputs or {})
        self._numbers = self._known_numbers(keep)
        self.unknowns, self.eliminated, self.neutral = [], [], []
        self._specialize()
        self._check_time()
        self.unsatisfied: list[str] = []
        self._drop_constant_rows(keep)

    # What is given

    def _by_coordinate(self, given: Mapping[str, float] | None, what: str) -> dict[str, Fraction]:
        found = {}
        for name, value in dict(given or {}).items():
            if name not in self.names:
                raise EngdynError(f"{what} names {name!r}: the coordinates are {', '.join(self.names)}")
            if not isinstance(value, int | float) or not math.isfinite(value):
                raise EngdynError(f"{what}[{name!r}] is {value!r}: give a finite number")
            found[name] = as_rational(value)
        return found

    def _free_inputs(self, free: Sequence[str]) -> list[Key]:
        known = {w.func.__name__: w for w in self.eom.inputs}
        names = [free] if isinstance(free, str) else list(free)
        for name in names:
            if name not in known:
                raise EngdynError(
                    f"free names the input {name!r}: the equations have {', '.join(known) or 'none'}"
                )
        return [("function", known[name], 0) for name in names]

    def _known_numbers(self, keep: frozenset[Key]) -> dict[Key, Fraction]:
        """Rational values of parameters and inputs, time-dependent defaults left out."""
        eom = self.eom
        numbers: dict[Key, Fraction] = {}
        for p, value in zip(eom.parameters, parameter_values(eom, self.values), strict=True):
            numbers["symbol", p] = as_rational(value)
        triples = input_values(eom, self.inputs, self.values)
        order = [(w, k) for w in eom.inputs for k in (0, 1, 2)]
        for (w, k), value in zip(order, triples, strict=True):
            default = eom.defaults.get(w)
            moving = (
                default is not None
                and w.func.__name__ not in self.inputs
                and sm.sympify(default[k]).has(dynamicsymbols._t)
            )
            if not moving:
                numbers["function", w, k] = as_rational(value)
        for key in (*self.free, *keep):
            numbers.pop(key, None)
        return numbers

    # Rows

    def _specialize(self) -> None:
        """Put numbers into the residuals and find out what is unknown."""
        eom, ring = self.eom, self.ring
        speed_keys = [("function", u.expr, 1) if u.is_Derivative else ("function", u, 0) for u in eom.speeds]
        owners = [key[1] if key[2] == 1 else None for key in speed_keys]
        rows = self._residuals(speed_keys)
        inner = self._inside_definitions(rows)
        self.constants = {ring.keys[i]: v for i, v in self._indexed(self._numbers).items() if i in inner}
        rows = self._with_numbers(rows, self._numbers, inner)
        motion: dict[Key, Fraction] = {}
        open_speeds = []
        for key, owner in zip(speed_keys, owners, strict=True):
            name = owner.func.__name__ if owner is not None else ""
            if owner is None or self._occurs(owner, rows) or name in self.rates or name in self.accelerations:
                motion[key] = self.rates.get(name, Fraction(0))
                motion[key[0], key[1], key[2] + 1] = self.accelerations.get(name, Fraction(0))
            else:
                open_speeds.append((key, name))
        rows = self._with_numbers(rows, motion, inner)
        self.neutral = [q.func.__name__ for q in eom.coordinates if not self._occurs(q, rows)]
        unknowns = [
            Unknown(("function", q, 0), q.func.__name__) for q in eom.coordinates if self._occurs(q, rows)
        ]
        for key, name in open_speeds:
            rows, unknown = self._ignorable(key, name, rows, inner)
            unknowns += unknown
        unknowns += [Unknown(key, key[1].func.__name__) for key in self.free]
        self.rows, self.unknowns = rows, unknowns

    def _residuals(self, speed_keys: Sequence[Key]) -> list[Element]:
        """M u̇ − f, and q̇ − rate for coordinates whose rates are not speeds."""
        eom, ring = self.eom, self.ring
        rows = []
        for line, force in zip(eom.mass, eom.force, strict=True):
            total = -force
            for entry, key in zip(line, speed_keys, strict=True):
                if not entry.is_zero():
                    total = total + entry * ring.generator((key[0], key[1], key[2] + 1))
            rows.append(total)
        for q, rate in zip(eom.coordinates, eom.rates, strict=True):
            if ("function", q, 1) not in speed_keys:
                rows.append(rate - ring.constant(self.rates.get(q.func.__name__, Fraction(0))))
        return rows

    def _ignorable(
        self, key: Key, name: str, rows: list[Element], inner: set[int]
    ) -> tuple[list[Element], list[Unknown]]:
        """The unknown that stands in for an ignorable coordinate: its rate, else its acceleration."""
        ring = self.ring
        acceleration = (key[0], key[1], key[2] + 1)
        still = self._with_numbers(rows, {acceleration: Fraction(0)}, inner)
        if any(not ring.partial(key)(row).is_zero() for row in still):
            return still, [Unknown(key, f"{name}_d")]
        return self._with_numbers(rows, {key: Fraction(0)}, inner), [Unknown(acceleration, f"{name}_dd")]

    def _indexed(self, numbers: Mapping[Key, Fraction]) -> dict[int, Fraction]:
        return {self.ring.index[key]: value for key, value in numbers.items() if key in self.ring.index}

    def _with_numbers(
        self, rows: Sequence[Element], numbers: Mapping[Key, Fraction], inner: set[int]
    ) -> list[Element]:
        indexed = {i: value for i, value in self._indexed(numbers).items() if i not in inner}
        return [row.specialize(indexed) for row in rows]

    def _inside_definitions(self, rows: Sequence[Element]) -> set[int]:
        """Independent generators that angles, roots and calls of the rows depend on."""
        found: set[int] = set()
        waiting = {i for row in rows for i in row.generators() if i in self.ring.definitions}
        while waiting:
            definition = self.ring.definitions[waiting.pop()]
            inside = {j for a in definition.arguments for j in a.generators()} | set(definition.contains)
            waiting |= {j for j in inside if j in self.ring.definitions}
            found |= {j for j in inside if j not in self.ring.definitions}
        return found

    def contents(self, rows: Sequence[Element]) -> set[Key]:
        """Keys of all independent generators on which rows depend."""
        plain = {i for row in rows for i in row.generators() if i not in self.ring.definitions}
        return {self.ring.keys[i] for i in plain | self._inside_definitions(rows)}

    def _occurs(self, q: sm.Expr, rows: Sequence[Element]) -> bool:
        return ("function", q, 0) in self.contents(rows)

    def _check_time(self) -> None:
        moving = [
            key
            for key in self.contents(self.rows)
            if key == ("symbol", dynamicsymbols._t) or self._is_moving(key)
        ]
        if moving:
            raise EngdynError(
                f"the equations contain time explicitly (through {', '.join(sorted(str(k[1]) for k in moving))}): they have "
                "no equilibria; write them in coordinates in which the motion is steady, or set that input to zero"
            )

    def _is_moving(self, key: Key) -> bool:
        unknown = {u.key for u in self.unknowns}
        return (
            key[0] == "function"
            and key not in unknown
            and key not in self.constants
            and key[1] in self.eom.defaults
            and key[2] == 0
        )

    def _drop_constant_rows(self, keep: frozenset[Key]) -> None:
        """Rows without unknowns are either satisfied or make an equilibrium impossible."""
        wanted = {u.key for u in self.unknowns} | keep
        kept = []
        for number, row in enumerate(self.rows):
            if row.is_zero():
                continue
            if self.contents([row]) & wanted:
                kept.append(row)
            elif (value := row.as_rational()) is None or abs(value) > self._tolerance(number):
                left = "a number that is not zero" if value is None else f"{float(value):.5g}"
                self.unsatisfied.append(f"equation {number + 1} reads {left} = 0")
        self.rows = kept

    def _tolerance(self, number: int) -> Fraction:
        """Rounding allowed in a row of given numbers: 1e-12 of its largest input or parameter."""
        return Fraction(1, 10**12) * max([abs(v) for v in self._numbers.values()], default=Fraction(1))

    # Exact elimination of unknowns that occur linearly

    def eliminate_linear(self) -> None:
        """Solve rows for unknowns that occur linearly with a constant factor; shrinks rows and unknowns."""
        while self._eliminate_one():
            pass

    def _eliminate_one(self) -> bool:
        unknown_keys = {u.key for u in self.unknowns}
        inner = {self.ring.keys[i] for i in self._inside_definitions(self.rows)}
        for unknown in reversed(self.unknowns):
            if unknown.key in inner or unknown.key not in self.ring.index:
                continue
            partial = self.ring.partial(unknown.key)
            for at, row in enumerate(self.rows):
                factor = partial(row)
                number = factor.as_rational()
                if number is None or number == 0 or not self.contents([row]) & unknown_keys:
                    continue
                solution = self.ring.generator(unknown.key) - row * (1 / number)
                self._replace(unknown, solution, at)
                return True
        return False

    def _replace(self, unknown: Unknown, solution: Element, at: int) -> None:
        from engdyn.modeling.lagrange import substitute

        images = {self.ring.index[unknown.key]: solution}
        rows = [substitute(row, images) for i, row in enumerate(self.rows) if i != at]
        self.eliminated = [(u, substitute(e, images)) for u, e in self.eliminated]
        self.eliminated.append((unknown, solution))
        self.unknowns = [u for u in self.unknowns if u is not unknown]
        self.rows = rows
        self._drop_constant_rows(frozenset())


def as_rational(value: float) -> Fraction:
    """A float as the rational of its shortest decimal."""
    return Fraction(repr(float(value)))
