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

__all__ = ["Products", "as_products", "compile_products", "slope"]

Key = tuple[Any, ...]
Products = tuple[tuple[Element, ...], ...]
"""A sum of products."""

LARGEST = 64
"""Denominators are expanded while the product of their numbers of terms stays below this."""


def as_products(element: Element) -> Products:
    """An element as a sum of one product."""
    return ((element,),)


def slope(ring: Ring, row: Element, key: Key) -> Products:
    """∂row/∂key.

    Parameters
    ----------
    ring : Ring
    row : Element
    key : tuple
        An independent generator.

    Returns
    -------
    Products
    """
    if key not in ring.index:
        return as_products(ring.zero)
    outer = [i for i in row.generators() if _is_quotient_rule(ring, i)]
    if prod(_terms_below(ring, i) for i in outer) < LARGEST:
        return as_products(ring.partial(key)(row))
    held = dict.fromkeys(outer)
    products: list[tuple[Element, ...]] = [(Derivation(ring, {**held, ring.index[key]: ring.one})(row),)]
    inner = ring.partial(key)
    for i in outer:
        by_generator = Derivation(ring, {**held, i: ring.one})(row)
        definition = ring.definitions[i]
        for argument, change in zip(definition.arguments, definition.slopes, strict=False):
            moved = inner(argument)
            if change is not None and not moved.is_zero():
                products.append((by_generator, change, moved))
    return tuple(product for product in products if not any(factor.is_zero() for factor in product))


def _is_quotient_rule(ring: Ring, index: int) -> bool:
    definition = ring.definitions.get(index)
    return (
        definition is not None
        and definition.kind in ("root", "magnitude", "call")
        and bool(definition.slopes)
    )


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
    factors = [factor for entry in entries for product in entry for factor in product]
    compiled = compile_elements(factors, arguments, target)
    if all(len(entry) == 1 and len(entry[0]) == 1 for entry in entries):
        return compiled
    shapes = [[len(product) for product in entry] for entry in entries]

    def function(*numbers: Any) -> tuple[Any, ...]:
        values = iter(compiled(*numbers))
        found = []
        for shape in shapes:
            total: Any = 0.0
            for length in shape:
                product = next(values)
                for _ in range(length - 1):
                    product = product * next(values)
                total = total + product
            found.append(total)
        return tuple(found)

    return function
