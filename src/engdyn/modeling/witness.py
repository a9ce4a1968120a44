"""A real state at which two sets of equations differ, shown by interval arithmetic."""

from __future__ import annotations

import random
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from sympy import pi
from sympy.physics.vector import dynamicsymbols

from engdyn.algebra.balls import BACKEND, ball, contains_zero, is_finite, midpoint
from engdyn.algebra.codegen import compile_elements
from engdyn.algebra.ring import Element, Ring
from engdyn.errors import OutsideRingError

if TYPE_CHECKING:
    from engdyn.modeling.equations import EquationsOfMotion

__all__ = ["Witness", "different_values", "find_witness"]

Matrix = list[list[Element]]

#: States tried before the search is given up, and the precisions (bits) tried at each.
ATTEMPTS = 64
PRECISIONS = (53, 400)


@contextmanager
def working_precision(bits: int) -> Iterator[None]:
    """Ball arithmetic with that many bits (the fallback backend always has 53)."""
    if BACKEND != "flint":
        yield
        return
    import flint

    before = flint.ctx.prec
    flint.ctx.prec = bits
    try:
        yield
    finally:
        flint.ctx.prec = before


@dataclass(frozen=True)
class Witness:
    """A state at which two expressions differ.

    Attributes
    ----------
    state : dict of str to float
        Values of coordinates, rates, inputs and parameters [SI].
    quantity : str
        What differs there.
    values : tuple of float
        Its value in the first and in the second set.
    """

    state: dict[str, float]
    quantity: str
    values: tuple[float, float]

    def __str__(self) -> str:
        place = ", ".join(f"{name} = {value:.4g}" for name, value in self.state.items())
        return f"{place}: {self.quantity} is {self.values[0]:.5g} in the first set, {self.values[1]:.5g} in the second"


def key_name(key: tuple[Any, ...]) -> str:
    """Readable name of an independent generator: theta, theta', theta''."""
    return str(key[1]) if key[0] == "symbol" else key[1].func.__name__ + "'" * key[2]


def sample_states(keys: Sequence[tuple[Any, ...]]) -> Iterator[dict[tuple[Any, ...], Fraction]]:
    """Rational values of all independent generators, different at every turn, reproducible."""
    source = random.Random(1788)
    for turn in range(ATTEMPTS):
        yield {key: _drawn(key, source, turn) for key in keys}


def _drawn(key: tuple[Any, ...], source: random.Random, turn: int) -> Fraction:
    """A number for one generator; parameters have the sign that their symbol is known to have."""
    if key[0] != "symbol" or key[1] == dynamicsymbols._t:
        return Fraction(source.randint(-150, 150) or 7, 101)
    value = Fraction(source.randint(20, 300 if turn % 2 == 0 else 1200), 101)
    either_sign = key[1].is_extended_real and key[1].is_extended_nonnegative is None
    return -value if key[1].is_extended_nonpositive or (either_sign and turn % 4 == 3) else value


def different_values(
    ring: Ring, names: Sequence[str], a: Sequence[Element], b: Sequence[Element]
) -> Witness | None:
    """A state at which corresponding elements of two lists have different values, None if none was found."""
    keys = _independent(ring, [*a, *b])
    function = _compiled([*a, *b], keys)
    if function is None:
        return None
    for state in sample_states(keys):
        for precision in PRECISIONS:
            with working_precision(precision):
                values = function(*(ball(state[key]) for key in keys))
                found = _first_difference(values[: len(a)], values[len(a) :])
                if found is not None:
                    return _witness(state, names[found], values[found], values[len(a) + found])
    return None


def find_witness(
    ring: Ring, eom: EquationsOfMotion, a: tuple[Matrix, list[Element]], b: tuple[Matrix, list[Element]]
) -> Witness | None:
    """A state at which the accelerations of two sets of equations differ, None if none was found."""
    n = len(a[1])
    elements = [e for mass, force in (a, b) for e in (*(x for row in mass for x in row), *force)]
    keys = _independent(ring, elements)
    function = _compiled(elements, keys)
    if function is None:
        return None
    half = n * n + n
    for state in sample_states(keys):
        for precision in PRECISIONS:
            with working_precision(precision):
                flat = function(*(ball(state[key]) for key in keys))
                first, second = (_accelerations(part, n) for part in (flat[:half], flat[half:]))
                found = None if first is None or second is None else _first_difference(first, second)
                if found is not None:
                    return _witness(
                        state, f"the acceleration of {_name(eom, found)}", first[found], second[found]
                    )
    return None


def _compiled(elements: Sequence[Element], keys: Sequence[tuple[Any, ...]]) -> Callable[..., tuple] | None:
    """The elements as a function of balls, its constants as tight as the highest precision needs them."""
    try:
        with working_precision(PRECISIONS[-1]):
            return compile_elements(elements, keys, "balls")
    except OutsideRingError:
        return None


def _name(eom: EquationsOfMotion, index: int) -> str:
    u = eom.speeds[index]
    return str(u.expr.func.__name__ if u.is_Derivative else u.func.__name__)


def _independent(ring: Ring, elements: Sequence[Element]) -> list[tuple[Any, ...]]:
    """Keys of all independent generators that the elements depend on, π aside."""
    return [key for key in map(ring.keys.__getitem__, ring.independent(elements)) if key != ("symbol", pi)]


def _first_difference(a: Sequence[Any], b: Sequence[Any]) -> int | None:
    for i, (x, y) in enumerate(zip(a, b, strict=True)):
        difference = x - y
        if is_finite(difference) and not contains_zero(difference):
            return i
    return None


def _witness(state: dict, quantity: str, first: Any, second: Any) -> Witness:
    named = {key_name(key): float(value) for key, value in state.items()}
    return Witness(named, quantity, (midpoint(first), midpoint(second)))


def _accelerations(flat: Sequence[Any], n: int) -> list[Any] | None:
    """Solve M u̇ = f in ball arithmetic; None where a pivot may be zero."""
    rows = [[*flat[i * n : (i + 1) * n], flat[n * n + i]] for i in range(n)]
    for column in range(n):
        pivot = max(range(column, n), key=lambda i: abs(midpoint(rows[i][column])))
        rows[column], rows[pivot] = rows[pivot], rows[column]
        head = rows[column][column]
        if not is_finite(head) or contains_zero(head):
            return None
        for i in range(n):
            if i != column:
                factor = rows[i][column] / head
                rows[i] = [x - factor * y for x, y in zip(rows[i], rows[column], strict=True)]
    return [rows[i][n] / rows[i][i] for i in range(n)]
