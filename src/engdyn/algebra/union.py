"""One ring for elements of several: what a comparison of two derivations needs first."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from math import lcm
from typing import Any

from engdyn.algebra.ring import Definition, Element, Ring
from engdyn.algebra.roots import define_call, define_magnitude, define_root

__all__ = ["Transfer", "common_ring"]

#: Kinds of keys whose generators are defined by others.
DEPENDENT = ("root", "denominator", "magnitude", "call")


def common_ring(rings: Sequence[Ring]) -> tuple[Ring, list[Transfer | _Renaming]]:
    """A ring with the generators of all `rings`, and the map from each of them into it.

    Equal angles, roots and function values become one generator each, whatever they were called.
    """
    for whole in rings:
        if all(_holds(whole, ring) or _holds_generators(whole, ring) for ring in rings):
            angles = {key[1]: key[2] for key in whole.keys if key[0] == "sine"}
            return whole, [
                _Renaming(whole) if _holds(whole, ring) else Transfer(ring, list(ring.keys), whole, angles)
                for ring in rings
            ]
    divisors: dict = {}
    dependent: dict = {}
    plain: dict = {}
    named = _by_name(rings)
    for keys in named:
        for key in reversed(keys):
            if key[0] in DEPENDENT:
                dependent.setdefault(key)
        for key in keys:
            if key[0] == "sine":
                divisors[key[1]] = lcm(divisors.get(key[1], 1), key[2])
            elif key[0] in ("symbol", "function"):
                plain.setdefault(key)
    angles = list(divisors.items())
    union = Ring(
        [
            *reversed(dependent),
            *(("sine", *angle) for angle in angles),
            *(("cosine", *angle) for angle in angles),
            *plain,
        ]
    )
    for angle in angles:
        union.define_angle(*angle)
    transfers = [Transfer(ring, keys, union, divisors) for ring, keys in zip(rings, named, strict=True)]
    for transfer in transfers:
        transfer.define_dependent()
    return union, transfers


def _holds(whole: Ring, part: Ring) -> bool:
    """Whether elements of `part` are elements of `whole` as they stand: all generators agree."""
    if whole is part:
        return True
    if whole.polynomials is not part.polynomials or whole.keys[: len(part.named)] != part.named:
        return False
    return _has_distinct_names(whole) and all(
        _alike(whole.definitions.get(i), own) for i, own in part.definitions.items()
    )


def _holds_generators(whole: Ring, part: Ring) -> bool:
    """Whether `whole` has all generators of `part`, none of which is a root, magnitude or call."""
    known = all(key in whole.index and key[0] not in DEPENDENT for key in part.named)
    return known and _has_distinct_names(whole)


def _has_distinct_names(ring: Ring) -> bool:
    named = [_name(key) for key in ring.keys if key[0] == "symbol"]
    return len(set(named)) == len(named)


def _alike(a: Definition | None, b: Definition) -> bool:
    """Whether two definitions of rings with the same generators are one."""
    if a is None or a.kind != b.kind or len(a.arguments) != len(b.arguments) or a.contains != b.contains:
        return False
    pairs = zip(a.arguments, b.arguments, strict=True)
    return all(x.numerator == y.numerator and x.denominator == y.denominator for x, y in pairs)


class _Renaming:
    """The map into a ring whose first generators are those of the element's own."""

    def __init__(self, target: Ring):
        self._target = target

    def __call__(self, element: Element) -> Element:
        if element.ring is self._target:
            return element
        return Element(self._target, element.numerator, element.denominator)


def _by_name(rings: Sequence[Ring]) -> list[list[tuple]]:
    """Keys of the rings, symbols of one name replaced by one symbol.

    ``Symbol("m")`` and ``Symbol("m", positive=True)`` are different objects, but mean one mass.
    """
    chosen: dict[tuple[str, str], Any] = {}
    for key in (key for ring in rings for key in ring.keys if key[0] in ("symbol", "function")):
        known = chosen.setdefault(_name(key), key[1])
        if known.is_extended_real is None and key[1].is_extended_real is not None:
            chosen[_name(key)] = key[1]  # the one of which more is known
    return [_renamed(ring, chosen) for ring in rings]


def _renamed(ring: Ring, chosen: dict[tuple[str, str], Any]) -> list[tuple]:
    plain = [key for key in ring.keys if key[0] in ("symbol", "function")]
    renamed = {key[1]: chosen[_name(key)] for key in plain if chosen[_name(key)] != key[1]}
    if not renamed:
        return list(ring.keys)
    own = [(key[0], key[1].xreplace(renamed), *key[2:]) for key in ring.named]
    return [*own, *ring.keys[len(own) :]]


def _name(key: tuple) -> tuple[str, str]:
    if key[0] == "symbol":
        return key[0], getattr(key[1], "name", "pi")
    return key[0], key[1].func.__name__


class Transfer:
    """The map of one ring's elements into a larger ring."""

    def __init__(self, source: Ring, keys: list[tuple], target: Ring, divisors: dict):
        self._source, self._keys, self._target, self._divisors = source, keys, target, divisors
        self._images: dict[int, Element] = {}
        self._mapping = [
            target.index.get(
                key if key[0] not in ("sine", "cosine") else (key[0], key[1], divisors[key[1]]), 0
            )
            for key in keys
        ]

    def __call__(self, element: Element) -> Element:
        """The same element in the larger ring."""
        if self._source is self._target:
            return element
        above = self._polynomial(element.numerator)
        return above if element.denominator is None else above / self._polynomial(element.denominator)

    def _polynomial(self, p) -> Element:
        source, target = self._source.polynomials, self._target.polynomials
        used = [i for i, degree in enumerate(source.degrees(p)) if degree > 0]
        if not used:
            return self._target.constant(source.leading_coefficient(p))
        images = {i: self.image(i) for i in used}
        if all(
            image.denominator is None and image.numerator == target.gens[self._mapping[i]]
            for i, image in images.items()
        ):
            moved = source.transfer(p, target, self._mapping)
            return Element(self._target, self._target.reduce(moved))
        total = self._target.zero
        for exponents, coefficient in source.terms(p):
            term = self._target.constant(coefficient)
            for i in used:
                if exponents[i]:
                    term = term * images[i] ** exponents[i]
            total = total + term
        return total

    def image(self, index: int) -> Element:
        """The image of one generator."""
        if index not in self._images:
            key, definition = self._keys[index], self._source.definitions.get(index)
            if definition is None:
                self._images[index] = self._target.generator(key)
            elif definition.kind in ("sine", "cosine"):
                kind, base, divisor = key
                whole = self._divisors[base]
                c, s = self._target.multiple_angle(base, whole, whole // divisor)
                self._images[index] = c if kind == "cosine" else s
            else:
                self._images[index] = self._carried(key, definition)
        return self._images[index]

    def define_dependent(self) -> None:
        """Carry over what angles, roots, magnitudes and calls stand for, inner ones first."""
        source, target = self._source, self._target
        for index in reversed(range(len(source.named))):
            self.image(index)
        for index, definition in source.definitions.items():
            if definition.kind == "sine":
                _, base, divisor = self._keys[index]
                whole = self._divisors[base]
                if not target.definitions[target.index["sine", base, whole]].arguments:
                    target.set_angle(base, whole, self(definition.arguments[0]) * Fraction(divisor, whole))
            elif definition.kind == "call":
                (at,) = self._images[index].generators()
                if target.keys[at] == self._keys[index] and not target.definitions[at].slopes:
                    slopes = tuple(None if s is None else self(s) for s in definition.slopes)
                    target.definitions[at].slopes = slopes

    def _carried(self, key: tuple, definition: Definition) -> Element:
        """A root, magnitude or call in the larger ring: one that is there already, or a new one."""
        target = self._target
        arguments, at = tuple(self(a) for a in definition.arguments), target.index[key]
        if definition.kind == "root":
            return define_root(target, at, arguments[0])
        if definition.kind == "magnitude":
            return define_magnitude(target, at, arguments[0])
        contains = frozenset(j for i in definition.contains for j in self.image(i).generators())
        return define_call(target, at, Definition("call", arguments, (), contains))
