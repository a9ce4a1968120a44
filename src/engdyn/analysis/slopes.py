"""Derivatives of rows, kept apart where a common denominator would explode.

A row with three tire forces, each the arc tangent of its own quotient, has derivatives with three
denominators; brought to a common one they fill tens of thousands of terms. So a derivative is a sum of
products of ring elements here, one product for each root or function in the row where that is shorter.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from math import prod
from typing import Any

from engdyn.algebra.codegen import compile_elements
from engdyn.algebra.ring import Derivation, Element, Ring

__all__ = ["Products", "as_products", "compile_products", "slopes"]

Key = tuple[Any, ...]
Products = tuple[tuple[Element, ...], ...]
"""A sum of products."""

LARGEST = 64
"""Denominators are expanded while the product of their numbers of terms stays below this."""


def as_products(element: Element) -> Products:
    """An element as a sum of one product."""
    return ((element,),)


def slopes(ring: Ring, row: Element, keys: Sequence[Key]) -> list[Products]:
    """∂row/∂key for every key.

    Parameters
    ----------
    ring : Ring
    row : Element
    keys : sequence of tuple
        Independent generators; the derivative is zero for those that the ring does not have.

    Returns
    -------
    list of Products
    """
    outer = [i for i in sorted(row.generators()) if _is_function(ring, i)]
    if prod(_terms_below(ring, i) for i in outer) < LARGEST:
        return [as_products(ring.partial(key)(row) if key in ring.index else ring.zero) for key in keys]
    held: Any = dict.fromkeys(outer)
    by_function = {i: Derivation(ring, {**held, i: ring.one})(row) for i in outer}
    found = []
    for key in keys:
        if key not in ring.index:
            found.append(as_products(ring.zero))
            continue
        products = [(Derivation(ring, {**held, ring.index[key]: ring.one})(row),)]
        for i in outer:
            products += [(by_function[i], change, moved) for change, moved in _inner(ring, i, key)]
        found.append(tuple(p for p in products if not any(factor.is_zero() for factor in p)))
    return found


def _inner(ring: Ring, index: int, key: Key) -> list[tuple[Element, Element]]:
    """Slopes of a function with the derivatives of its arguments, remembered so that code shares them."""
    cache = ring.__dict__.setdefault("_inner_slopes", {})
    if (index, key) not in cache:
        definition, partial = ring.definitions[index], ring.partial(key)
        pairs = zip(definition.slopes, definition.arguments, strict=False)
        cache[index, key] = [(change, partial(argument)) for change, argument in pairs if change is not None]
    return cache[index, key]


def _is_function(ring: Ring, index: int) -> bool:
    definition = ring.definitions.get(index)
    if definition is None or definition.kind not in ("root", "magnitude", "call"):
        return False
    return bool(definition.slopes)


def _terms_below(ring: Ring, index: int) -> int:
    """Number of terms in the denominators that differentiating a generator brings."""
    definition = ring.definitions[index]
    found = 1
    for argument, change in zip(definition.arguments, definition.slopes, strict=False):
        for element in (argument, change):
            if element is not None and element.denominator is not None:
                found *= len(element.denominator)
    return found


def compile_products(
    entries: Sequence[Products], arguments: Sequence[Key], target: str
) -> Callable[..., tuple[Any, ...]]:
    """A function of the given generators that returns the values of sums of products.

    Parameters
    ----------
    entries : sequence of Products
    arguments, target :
        As in :func:`engdyn.algebra.codegen.compile_elements`.
    """
    factors: dict[int, Element] = {id(f): f for entry in entries for product in entry for f in product}
    compiled = compile_elements(list(factors.values()), arguments, target)
    places = {key: place for place, key in enumerate(factors)}
    plans = [[[places[id(f)] for f in product] for product in entry] for entry in entries]

    def function(*numbers: Any) -> tuple[Any, ...]:
        values = compiled(*numbers)
        return tuple(_evaluated(plan, values) for plan in plans)

    return function


def _evaluated(plan: Sequence[Sequence[int]], values: Sequence[Any]) -> Any:
    """A sum of products of the given values; a sum of one product of one factor is that value."""
    total: Any = None
    for places in plan:
        product = values[places[0]]
        for place in places[1:]:
            product = product * values[place]
        total = product if total is None else total + product
    return 0.0 if total is None else total
