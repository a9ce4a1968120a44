"""The same equations of motion in other speeds: what a comparison needs when these were chosen differently.

Euler's angles or body rates, x' or θ' of a rolling wheel: both describe the same velocities when one
set of speeds is an invertible linear function of the other.  Course sections 2.13 and 3.8.
"""

from __future__ import annotations

from collections.abc import Sequence
from copy import copy
from dataclasses import dataclass

import sympy as sm
from sympy.core.function import AppliedUndef
from sympy.physics.vector import dynamicsymbols

from engdyn.algebra.elimination import determinant, independent_columns, solve
from engdyn.algebra.readable import key_to_sympy, to_sympy, tree
from engdyn.algebra.ring import Element, Ring
from engdyn.algebra.scan import derivative_key
from engdyn.algebra.union import Transfer, common_ring
from engdyn.errors import EngdynError
from engdyn.modeling.equations import EquationsOfMotion
from engdyn.modeling.state import State

__all__ = ["Transformation", "names", "restated", "transformation"]

Matrix = list[list[Element]]


@dataclass(frozen=True)
class Transformation:
    """The speeds of one set of equations in terms of those of another: u_a = T(q, t) u_b + τ(q, t).

    Attributes
    ----------
    ring : Ring
        The common ring of both sets.
    speeds : tuple of Element
        u_a, one element per speed of the first set.
    first, second : tuple of Element
        The rates q̇ of both sets, in the order of the first one's coordinates, the first with u_a inserted.
    regular : bool
        Whether T can be inverted.
    excluded : tuple of sympy.Expr
        Where one of these is zero, one of the two sets of speeds is not defined by the other.
    into : pair of Transfer
        From the rings of the two sets into the common one.
    """

    ring: Ring
    speeds: tuple[Element, ...]
    first: tuple[Element, ...]
    second: tuple[Element, ...]
    regular: bool
    excluded: tuple[sm.Expr, ...]
    into: tuple[Transfer, Transfer]

    @property
    def consistent(self) -> bool:
        """Whether both sets allow the same velocities."""
        return all(a.equals(b) for a, b in zip(self.first, self.second, strict=True))


def names(quantities: Sequence[sm.Expr]) -> list[str]:
    """Names of dynamicsymbols and rates: theta, theta'."""
    return [f"{x.expr.func.__name__}'" if x.is_Derivative else x.func.__name__ for x in quantities]


def transformation(a: EquationsOfMotion, b: EquationsOfMotion) -> Transformation:
    """How the speeds of `a` follow from those of `b`, both having as many and the same coordinates.

    Raises
    ------
    EngdynError
        The speeds of `a` cannot be found from the rates of its coordinates.
    """
    ring, (into_a, into_b) = common_ring([_apart(a), b.ring])
    rates_a = [into_a(e) for e in a.rates]
    rates_b = [into_b(b.rates[names(b.coordinates).index(q)]) for q in names(a.coordinates)]
    keys_a, keys_b = ([_key(ring, u) for u in eom.speeds] for eom in (a, b))
    G, g = _linear(ring, rates_a, keys_a)
    rows = _independent_rows(G)
    if len(rows) < len(keys_a):
        raise EngdynError(
            f"the speeds {', '.join(names(a.speeds))} cannot be found from the rates of the coordinates: their "
            "kinematics q̇ = G u + g are singular everywhere, so they cannot be compared with other speeds"
        )
    images = solve([[*G[i], g[i] - rates_b[i]] for i in rows], len(keys_a))
    if images is None:  # not reached: the rows are independent
        raise EngdynError("the kinematics cannot be solved for the speeds")
    first = [_combined(row, images) + rest for row, rest in zip(G, g, strict=True)]
    T, _ = _linear(ring, images, keys_b)
    size = determinant(T)
    return Transformation(
        ring,
        tuple(images),
        tuple(first),
        tuple(rates_b),
        not size.is_zero(),
        () if size.is_zero() else _zeros(size),
        (into_a, into_b),
    )


def _apart(eom: EquationsOfMotion) -> Ring:
    """The ring of equations with other keys for roots, magnitudes and calls of rates.

    They are keyed by the expression they came from; in other speeds, that expression is another element.
    """
    t, ring = dynamicsymbols._t, copy(eom.ring)
    marks = {rate: sm.Dummy() for q in eom.coordinates for rate in [q.diff(t)]}
    marks |= {u: sm.Dummy() for u in eom.speeds if u not in marks}
    ring.keys = tuple(
        (key[0], key[1].xreplace(marks))
        if i in ring.definitions and len(key) == 2 and _has_arguments(ring, i)
        else key
        for i, key in enumerate(ring.keys)
    )
    return ring


def _has_arguments(ring: Ring, index: int) -> bool:
    return bool(ring.definitions[index].arguments)


def restated(a: EquationsOfMotion, b: EquationsOfMotion, change: Transformation) -> EquationsOfMotion:
    """The equations `a` in the speeds of `b`: Tᵀ M T u̇_b = Tᵀ (f − M (Ṫ u_b + τ̇))."""
    into, images = change.into[0], [to_sympy(tree(e)) for e in change.speeds]
    mass, force = [[into(e) for e in row] for row in a.mass], [into(e) for e in a.force]
    keys = [_key(change.ring, u) for u in a.speeds]
    inner = _inside(change.ring, force, keys)
    inserted = {key_to_sympy(key): image for key, image in zip(keys, images, strict=True)}
    written = [to_sympy(tree(f)).xreplace(inserted) for f in force] if inner else []
    state = _state(a, b, change, images, written)
    ring, (up, across) = common_ring([change.ring, state.ring])
    accelerations = [state.time_derivative(state.convert(e)) for e in images]
    matrix, rest = _linear(state.ring, accelerations, state.acceleration_keys)
    T, rest = [[across(e) for e in row] for row in matrix], [across(e) for e in rest]
    M = [[up(e) for e in row] for row in mass]
    u = {ring.index[_key(ring, s)]: across(state.convert(e)) for s, e in zip(a.speeds, images, strict=True)}
    f = [across(state.convert(e)) for e in written] if inner else [_inserted(up(e), u) for e in force]
    remaining = [e - _combined(row, rest) for e, row in zip(f, M, strict=True)]
    columns = list(zip(*T, strict=True))
    half = [[_combined(row, column) for column in columns] for row in M]
    return EquationsOfMotion(
        tuple(key_to_sympy(_key(ring, q)) for q in a.coordinates),
        tuple(key_to_sympy(_key(ring, s)) for s in b.speeds),
        ring,
        tuple(tuple(_combined(c, entry) for entry in zip(*half, strict=True)) for c in columns),
        tuple(_combined(column, remaining) for column in columns),
        tuple(up(e) for e in change.second),
        a.origin,
    )


def _state(
    a: EquationsOfMotion, b: EquationsOfMotion, change: Transformation, images: list, written: list
) -> State:
    """Coordinates of `a` and speeds of `b`, by their names in the common ring, with the time derivative."""
    coordinates, speeds = (
        [key_to_sympy(_key(change.ring, x)) for x in several] for several in (a.coordinates, b.speeds)
    )
    rates = {
        q: to_sympy(tree(rate))
        for q, rate in zip(coordinates, change.second, strict=True)
        if q.diff(dynamicsymbols._t) not in speeds
    }
    return State(coordinates, [*images, *written], speeds, rates, moving=images)


def _inside(ring: Ring, elements: Sequence[Element], keys: Sequence[tuple]) -> bool:
    """Whether roots, magnitudes or calls contain some of the generators."""
    used = {i for e in elements for i in e.generators() if i in ring.definitions}
    found = [Element(ring, ring.polynomials.gens[i]) for i in used]
    return bool({ring.index[key] for key in keys} & set(ring.independent(found)))


def _inserted(element: Element, images: dict[int, Element]) -> Element:
    """An element with other elements in place of generators that its denominator does not contain."""
    ring, ps = element.ring, element.ring.polynomials
    groups: dict[tuple[int, ...], dict] = {}
    for exponents, coefficient in ps.terms(element.numerator):
        powers = tuple(exponents[i] for i in images)
        rest = tuple(0 if i in images else e for i, e in enumerate(exponents))
        groups.setdefault(powers, {})[rest] = coefficient
    total = ring.zero
    for powers, terms in groups.items():
        part = Element(ring, ps.from_terms(terms))
        for image, power in zip(images.values(), powers, strict=True):
            part = part * image**power if power else part
        total = total + part
    return total if element.denominator is None else total / Element(ring, element.denominator)


def _key(ring: Ring, quantity: sm.Expr) -> tuple:
    """The key in the common ring of a coordinate or speed, found by its name."""
    _, function, order = derivative_key(quantity)
    wanted = function.func.__name__
    return next(
        key
        for key in ring.keys
        if key[0] == "function" and key[2] == order and key[1].func.__name__ == wanted
    )


def _linear(ring: Ring, elements: Sequence[Element], keys: Sequence[tuple]) -> tuple[Matrix, list[Element]]:
    """Elements that are linear in some generators as matrix and rest."""
    matrix, rests = [], []
    for element in elements:
        line = [ring.partial(key)(element) for key in keys]
        for entry, key in zip(line, keys, strict=True):
            element = element - entry * ring.generator(key)
        matrix.append(line)
        rests.append(element)
    return matrix, rests


def _independent_rows(matrix: Matrix) -> list[int]:
    """As many independent rows as there are columns (or can be found), the emptiest first."""
    chosen: list[int] = []
    order = sorted(range(len(matrix)), key=lambda i: sum(len(e.numerator) for e in matrix[i]))
    for i in order:
        trial = [*chosen, i]
        columns = [list(column) for column in zip(*(matrix[j] for j in trial), strict=True)]
        if len(chosen) < len(matrix[0]) and independent_columns(columns, len(trial)):
            chosen = trial
    return chosen


def _combined(factors: Sequence[Element], elements: Sequence[Element]) -> Element:
    total = factors[0].ring.zero
    for factor, element in zip(factors, elements, strict=True):
        if not factor.is_zero() and not element.is_zero():
            total = total + factor * element
    return total


def _zeros(size: Element) -> tuple[sm.Expr, ...]:
    """Factors of a determinant that depend on the motion."""
    factors = sm.Mul.make_args(to_sympy(tree(size)))
    bases = [f.base if f.is_Pow else f for f in factors]
    return tuple(dict.fromkeys(b for b in bases if b.atoms(AppliedUndef)))
