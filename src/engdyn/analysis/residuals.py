"""Residuals of equations of motion as rows of ring elements, and what they contain."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from math import prod
from typing import Any

from engdyn.algebra.ring import Element, Ring
from engdyn.modeling.equations import EquationsOfMotion

__all__ = ["contents", "inside_definitions", "residuals", "size"]

Key = tuple[Any, ...]


def residuals(
    eom: EquationsOfMotion, speed_keys: Sequence[Key], rates: Mapping[str, Fraction]
) -> list[Element]:
    """M u̇ − f, and q̇ − rate for coordinates whose rates are not speeds."""
    ring, rows = eom.ring, []
    for line, force in zip(eom.mass, eom.force, strict=True):
        total = -force
        for entry, key in zip(line, speed_keys, strict=True):
            if not entry.is_zero():
                total = total + entry * ring.generator((key[0], key[1], key[2] + 1))
        rows.append(total)
    for q, rate in zip(eom.coordinates, eom.rates, strict=True):
        if ("function", q, 1) not in speed_keys:
            rows.append(rate - ring.constant(rates.get(q.func.__name__, Fraction(0))))
    return rows


def inside_definitions(ring: Ring, rows: Sequence[Element]) -> set[int]:
    """Independent generators that angles, roots and calls of the rows depend on."""
    found: set[int] = set()
    waiting = {i for row in rows for i in row.generators() if i in ring.definitions}
    while waiting:
        definition = ring.definitions[waiting.pop()]
        inside = {j for a in definition.arguments for j in a.generators()} | set(definition.contains)
        waiting |= {j for j in inside if j in ring.definitions}
        found |= {j for j in inside if j not in ring.definitions}
    return found


def contents(ring: Ring, rows: Sequence[Element]) -> set[Key]:
    """Keys of all independent generators on which rows depend."""
    plain = {i for row in rows for i in row.generators() if i not in ring.definitions}
    return {ring.keys[i] for i in plain | inside_definitions(ring, rows)}


def size(row: Element, known: Mapping[int, Fraction]) -> Fraction:
    """Sum of the magnitudes of a row's terms, what is not known taken as one."""
    total = Fraction(0)
    for exponents, coefficient in row.ring.polynomials.terms(row.numerator):
        total += abs(coefficient) * prod(abs(known.get(i, 1)) ** e for i, e in enumerate(exponents) if e)
    return total
