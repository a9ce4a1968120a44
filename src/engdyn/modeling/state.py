"""The state of a mechanical system in a ring: coordinates, speeds, accelerations and time.

Both derivations start here: from the same coordinates they need generators for q, u and u̇, and
the total time derivative.  They share nothing else.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

import sympy as sm
from sympy.core.function import AppliedUndef
from sympy.physics.vector import dynamicsymbols

from engdyn.algebra.conversion import Converter
from engdyn.algebra.elimination import eliminate, solve
from engdyn.algebra.readable import to_sympy, tree
from engdyn.algebra.ring import Derivation, Element, Ring
from engdyn.algebra.scan import derivative_key, key_to_sympy
from engdyn.errors import EngdynError

__all__ = ["State", "check_coordinates", "dependent_rates", "rates_of"]

Key = tuple

#: Reactions beyond one for each coordinate for which rings have room: systems of few bodies need no more.
ROOM = 4


def check_coordinates(coordinates: Iterable[sm.Expr]) -> tuple[sm.Expr, ...]:
    """The coordinates as a tuple of distinct dynamicsymbols."""
    if isinstance(coordinates, sm.Basic):
        raise EngdynError(
            f"coordinates must be a list of dynamicsymbols, not the single expression {coordinates}: "
            f"write [{coordinates}]"
        )
    found = tuple(coordinates)
    for q in found:
        if not isinstance(q, AppliedUndef) or derivative_key(q) is None:
            raise EngdynError(
                f"the coordinate {q!r} is not a dynamicsymbol: make it with "
                "sympy.physics.mechanics.dynamicsymbols"
            )
    if not found or len(set(found)) != len(found):
        raise EngdynError(f"coordinates {list(found)}: give at least one, each of them once")
    return found


def rates_of(coordinates: Iterable[sm.Expr]) -> tuple[sm.Expr, ...]:
    """The time derivatives of dynamicsymbols."""
    return tuple(key_to_sympy(("function", q, 1)) for q in coordinates)


class State:
    """Generators of the motion and the total time derivative.

    Parameters
    ----------
    coordinates : sequence of dynamicsymbols, length n
    expressions : iterable of sympy.Expr
        Everything that will be converted into the ring.
    speeds : sequence of dynamicsymbols or of time derivatives of coordinates, optional
        Independent speeds u, length m; the rates of the coordinates where not given.
    rates : mapping of coordinate to expression, optional
        Kinematics q̇ = G(q) u + g(q, t); needed where the speeds are not the rates.
    substitute : bool
        Whether rates replace the q̇ in all expressions at once (Newton–Euler), or not (Lagrange).
    moving : iterable of sympy.Expr
        Those of the expressions that will be differentiated by time: their dynamicsymbols get
        generators for two further derivatives.
    unknowns : sequence of sympy.Symbol
        Reaction magnitudes: they come last, so that rings of one system agree in all else.
    """

    def __init__(
        self,
        coordinates: Sequence[sm.Expr],
        expressions: Iterable[sm.Expr],
        speeds: Sequence[sm.Expr] | None = None,
        rates: Mapping[sm.Expr, sm.Expr] | None = None,
        substitute: bool = True,
        moving: Iterable[sm.Expr] = (),
        unknowns: Sequence[sm.Symbol] = (),
    ):
        self.coordinates = tuple(coordinates)
        self.speeds = rates_of(coordinates) if speeds is None else tuple(speeds)
        self.rates = dict(rates or {})
        speed_keys = [derivative_key(u) for u in self.speeds]
        keys = [("function", u[1], u[2] + 1) for u in speed_keys] + speed_keys
        if not substitute:
            keys = [("function", q, k) for k in (2, 1) for q in self.coordinates]
        keys += [("function", q, 0) for q in self.coordinates]
        substitutions = {("function", q, 1): rate for q, rate in self.rates.items()} if substitute else {}
        room = max(0, len(self.coordinates) + ROOM - len(unknowns)) if self.coordinates else 0
        last = [("symbol", x) for x in unknowns]
        moving = [*moving, *self.rates.values()]
        self.converter = Converter([*expressions, *moving], keys, substitutions, moving, last, room)
        self.convert = self.converter.convert
        self.ring: Ring = self.converter.ring
        self.speed_keys = speed_keys
        self.acceleration_keys = [("function", u[1], u[2] + 1) for u in speed_keys]
        seeds = self._time_seeds()
        functions = [i for i, key in enumerate(self.ring.keys) if key[0] == "function"]
        self.time_derivative = Derivation(self.ring, seeds, unknown=set(functions) - set(seeds))

    def _time_seeds(self) -> dict[int, Element]:
        ring, t = self.ring, ("symbol", dynamicsymbols._t)
        seeds = {ring.index[t]: ring.one} if t in ring.index else {}
        for key in ring.keys:
            following = ("function", key[1], key[2] + 1) if key[0] == "function" else None
            if following in ring.index:
                seeds[ring.index[key]] = ring.generator(following)
        for q, rate in self.rates.items():
            if ("function", q, 1) not in ring.index:
                seeds[ring.index["function", q, 0]] = self.convert(rate)
        return seeds

    def rate_elements(self) -> list[Element]:
        """q̇ as ring elements, one per coordinate."""
        return [
            self.convert(self.rates[q]) if q in self.rates else self.ring.generator(("function", q, 1))
            for q in self.coordinates
        ]

    def speed_partials(self) -> list[Derivation]:
        """∂/∂u for every speed."""
        return [self.ring.partial(key) for key in self.speed_keys]

    def acceleration_partials(self) -> list[Derivation]:
        """∂/∂u̇ for every speed."""
        return [self.ring.partial(key) for key in self.acceleration_keys]


def dependent_rates(
    coordinates: Sequence[sm.Expr], constraints: Sequence[sm.Expr], speeds: Sequence[sm.Expr] | None
) -> tuple[tuple[sm.Expr, ...], dict[sm.Expr, sm.Expr]]:
    """Independent speeds and the rates of all coordinates that velocity constraints allow.

    Parameters
    ----------
    coordinates : sequence of dynamicsymbols, length n
    constraints : sequence of expressions = 0, linear in the rates, length c
    speeds : sequence of rates to keep as independent, length n - c, optional
        The rates of the first coordinates that can be independent where not given.

    Returns
    -------
    speeds, rates
        The independent speeds and, for each dependent coordinate, its rate in terms of them.
    """
    state = State(coordinates, constraints)
    matrix = _linear_in_rates(state, constraints)
    order = list(range(len(coordinates)))
    wanted = None if speeds is None else [state.speeds.index(u) for u in _known_rates(state, speeds)]
    if wanted is not None:
        if len(wanted) != len(coordinates) - len(constraints):
            raise EngdynError(
                f"{len(wanted)} speeds for {len(coordinates)} coordinates under {len(constraints)} velocity "
                f"constraints: give {len(coordinates) - len(constraints)}"
            )
        order = [*wanted, *(i for i in order if i not in wanted)]
    dependent = _dependent_columns(matrix, order)
    independent = [i for i in order if i not in dependent]
    if len(dependent) < len(constraints) or (wanted is not None and independent != wanted):
        raise EngdynError(
            f"{len(constraints)} velocity constraints fix only {len(dependent)} rates: one of them follows from "
            "the others, or the speeds asked for are not independent"
        )
    if not independent:
        raise EngdynError("as many velocity constraints as coordinates: nothing is left that can move")
    found = _solved(matrix, dependent, independent, state)
    rates = {coordinates[j]: to_sympy(tree(e)) for j, e in zip(dependent, found, strict=True)}
    return rates_of(coordinates[i] for i in independent), rates


def _linear_in_rates(state: State, constraints: Sequence[sm.Expr]) -> list[list[Element]]:
    """Velocity constraints as rows ``[A | b]`` with A q̇ + b = 0."""
    matrix = []
    for row in (state.convert(c) for c in constraints):
        line = [partial(row) for partial in state.speed_partials()]
        for entry, u in zip(line, state.speed_keys, strict=True):
            row = row - entry * state.ring.generator(u)
        line.append(row)
        if any(state.ring.keys[i] in state.speed_keys for i in state.ring.independent(line)):
            raise EngdynError(
                "a velocity constraint is not linear in the rates of the coordinates: differentiate it"
            )
        matrix.append(line)
    return matrix


def _known_rates(state: State, speeds: Sequence[sm.Expr]) -> Sequence[sm.Expr]:
    for u in speeds:
        if u not in state.speeds:
            raise EngdynError(
                f"the speed {u} is not the rate of a coordinate; choose among {list(state.speeds)}"
            )
    return speeds


def _dependent_columns(matrix: list[list[Element]], order: list[int]) -> list[int]:
    """The last columns (in the given order) that can be solved for."""
    chosen: list[int] = []
    for column in reversed(order):
        trial = [*chosen, column]
        rows = [[row[j] for j in trial] for row in matrix]
        if not eliminate(rows, len(trial)).missing:
            chosen = trial
        if len(chosen) == len(matrix):
            break
    return sorted(chosen)


def _solved(
    matrix: list[list[Element]], dependent: list[int], independent: list[int], state: State
) -> list[Element]:
    """Dependent rates as linear combinations of the independent ones."""
    rows = []
    for row in matrix:
        rest = row[-1]
        for j in independent:
            rest = rest + row[j] * state.ring.generator(state.speed_keys[j])
        rows.append([*(row[j] for j in dependent), rest])
    solution = solve(rows, len(dependent))
    if solution is None:
        raise EngdynError("the velocity constraints cannot be solved for the dependent rates")
    return solution
