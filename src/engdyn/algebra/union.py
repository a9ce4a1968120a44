"""One ring for elements of several: what a comparison of two derivations needs first."""

from __future__ import annotations

from collections.abc import Sequence
from math import lcm

from engdyn.algebra.ring import Definition, Element, Ring

__all__ = ["Transfer", "common_ring"]


def common_ring(rings: Sequence[Ring]) -> tuple[Ring, list[Transfer]]:
    """A ring with the generators of all `rings`, and the map from each of them into it.

    Equal angles, roots and function values become one generator each, whatever they were called.
    """
    divisors: dict = {}
    dependent: dict = {}
    plain: dict = {}
    named = [_by_name(ring, rings[0]) for ring in rings]
    for keys in named:
        for key in reversed(keys):
            if key[0] in ("root", "magnitude", "call"):
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
    transfers = [Transfer(ring, keys, union, divisors) for ring, keys in zip(rings, named, strict=True)]
    for transfer in transfers:
        transfer.define_dependent()
    return union, transfers


def _by_name(ring: Ring, first: Ring) -> list[tuple]:
    """Keys of a ring, its symbols replaced by those of the same name in the first ring.

    ``Symbol("m")`` and ``Symbol("m", positive=True)`` are different objects, but mean one mass.
    """
    if ring is first:
        return list(ring.keys)
    known = {_name(key): key[1] for key in first.keys if key[0] in ("symbol", "function")}
    renamed = {
        key[1]: known[_name(key)]
        for key in ring.keys
        if key[0] in ("symbol", "function") and known.get(_name(key), key[1]) != key[1]
    }
    if not renamed:
        return list(ring.keys)
    return [(key[0], key[1].xreplace(renamed), *key[2:]) for key in ring.keys]


def _name(key: tuple) -> tuple[str, str]:
    return key[0], str(key[1]) if key[0] == "symbol" else key[1].func.__name__


class Transfer:
    """The map of one ring's elements into a larger ring."""

    def __init__(self, source: Ring, keys: list[tuple], target: Ring, divisors: dict):
        self._source, self._keys, self._target, self._divisors = source, keys, target, divisors
        self._images: dict[int, Element] = {}
        self._mapping = [
            target.index.get(key if key[0] not in ("sine", "cosine") else (key[0], key[1], divisors[key[1]]), 0)
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
        images = {i: self.image(i) for i in used}
        if all(image.denominator is None and image.numerator == target.gens[self._mapping[i]] for i, image in images.items()):
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
            key = self._keys[index]
            if key[0] in ("sine", "cosine"):
                self._images[index] = self._angle_image(key)
            else:
                self._images[index] = self._target.generator(key)
        return self._images[index]

    def _angle_image(self, key: tuple) -> Element:
        kind, base, divisor = key
        whole = self._divisors[base]
        target = self._target
        at = target.index["sine", base, whole]
        if at not in target.definitions:
            own = self._source.definitions[self._keys.index(("sine", base, divisor))].arguments[0]
            cosine, sine = target.generator(("cosine", base, whole)), target.generator(("sine", base, whole))
            target.define(at, Definition("sine", (), (cosine,)))
            angle = self(own) * divisor * target.constant(1) / whole
            target.definitions[at].arguments = (angle,)
            target.define(target.index["cosine", base, whole], Definition("cosine", (angle,), (-sine,)))
        c, s = target.multiple_angle(base, whole, whole // divisor)
        return c if kind == "cosine" else s

    def define_dependent(self) -> None:
        """Carry over what roots, magnitudes and calls stand for, inner ones first."""
        for index in reversed(range(len(self._source.keys))):
            definition = self._source.definitions.get(index)
            if definition is None:
                continue
            if definition.kind in ("sine", "cosine"):
                self.image(index)
            else:
                self._carry(index, definition)
        for index, definition in self._source.definitions.items():
            if definition.kind not in ("sine", "cosine"):
                at = self._index_of(self._images[index])
                carried = self._target.definitions[at]
                if not carried.slopes:
                    carried.slopes = tuple(None if s is None else self(s) for s in definition.slopes)

    def _carry(self, index: int, definition: Definition) -> None:
        target, key = self._target, self._keys[index]
        arguments = tuple(self(a) for a in definition.arguments)
        for at, known in target.definitions.items():
            if known.kind != definition.kind or len(known.arguments) != len(arguments):
                continue
            if known.kind == "call" and (not arguments or target.keys[at][1].func is not key[1].func):
                continue
            if all(a.equals(b) for a, b in zip(known.arguments, arguments, strict=True)):
                self._images[index] = Element(target, target.polynomials.gens[at])
                return
        at = target.index[key]
        if at not in target.definitions:
            contains = frozenset(j for i in definition.contains for j in self.image(i).generators())
            target.define(at, Definition(definition.kind, arguments, (), contains))
        self._images[index] = Element(target, target.polynomials.gens[at])

    def _index_of(self, image: Element) -> int:
        return next(iter(image.generators()))
