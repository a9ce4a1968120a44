"""Trigonometric polynomials in the form that people write: angle sums restored, 1 − cos² written as sin².

A product of sines and cosines is a tuple of ``(generator index, exponent)``.
"""

from __future__ import annotations

from fractions import Fraction
from functools import lru_cache
from typing import Any

from engdyn.algebra.nodes import ONE, Node, make_power, make_product
from engdyn.algebra.ring import Ring

__all__ = ["circular", "shortest"]

Product = tuple[tuple[int, int], ...]
#: Products of more sines and cosines than this are not written as sums of angles: it would take too long.
DEGREE_LIMIT = 12


def circular(key: tuple[Any, ...]) -> Node:
    """The node of a sine or cosine generator."""
    return (key[0][:3], ((key[1], _ratio(1, key[2])),))


def shortest(ring: Ring, terms: dict[Product, Any]) -> list[tuple[Any, Node]]:
    """A trigonometric polynomial as (coefficient, node) pairs, in the shorter of two forms."""
    if len(terms) < 2:
        return [(c, _plain(ring, trig)) for trig, c in terms.items()]
    key = tuple(terms.items())
    found = ring.remembered.get(key)
    if found is None:
        found = _squares_joined(ring, terms)
        if max(sum(e for _, e in trig) for trig in terms) <= DEGREE_LIMIT:
            summed = _angle_sums(ring, terms)
            found = summed if len(summed) < len(found) else found
        ring.remembered[key] = found
    return found


def _plain(ring: Ring, trig: Product) -> Node:
    return make_product([make_power(circular(ring.keys[i]), e) for i, e in trig])


def _squares_joined(ring: Ring, terms: dict[Product, Any]) -> list[tuple[Any, Node]]:
    """Products of sines and cosines, a·(1 − cos²) joined to a·sin²."""
    terms, found = dict(terms), []
    for trig in [trig for trig in terms if any(e > 1 for _, e in trig)]:
        for i, e in trig:
            lower = tuple((j, d - 2 if j == i else d) for j, d in trig if j != i or d > 2)
            if e > 1 and trig in terms and terms.get(lower) == -terms[trig]:
                terms.pop(trig)
                sine = circular(("sine", *ring.keys[i][1:]))
                found.append((terms.pop(lower), make_product([_plain(ring, lower), make_power(sine, 2)])))
    return found + [(c, _plain(ring, trig)) for trig, c in terms.items()]


def _angle_sums(ring: Ring, terms: dict[Product, Any]) -> list[tuple[Any, Node]]:
    """The same polynomial as a sum of cosines and sines of angle sums (product-to-sum formulas)."""
    angles = list(dict.fromkeys(ring.keys[i][1:] for trig in terms for i, _ in trig))
    place = {angle: at for at, angle in enumerate(angles)}
    degree = max(sum([e for _, e in trig]) for trig in terms)
    waves: dict[tuple[int, ...], list[Any]] = {}
    for trig, coefficient in terms.items():
        powers, sines = [0] * (2 * len(angles)), 0
        for i, e in trig:
            key = ring.keys[i]
            sine = key[0] == "sine"
            powers[place[key[1:]] + (len(angles) if sine else 0)] = e
            sines += e if sine else 0
        turns = sines % 4  # each sine brings a factor −i
        scale = (coefficient if turns in (0, 3) else -coefficient) * 2 ** (degree - sum(powers))
        for multiples, count in _exponentials(tuple(powers)):
            waves.setdefault(multiples, [0, 0])[turns % 2] += scale * count
    found: list[tuple[Any, Node]] = []
    for multiples, (re, im) in waves.items():
        if (re == 0 and im == 0) or multiples < tuple(-k for k in multiples):
            continue
        angle = tuple((base, _ratio(k, d)) for (base, d), k in zip(angles, multiples, strict=True) if k)
        if not angle:
            found.append((_ratio(re, 2**degree), ONE))
            continue
        found += [(_ratio(2 * re, 2**degree), ("cos", angle))] if re else []
        found += [(_ratio(-2 * im, 2**degree), ("sin", angle))] if im else []
    return found


def _ratio(above: Any, below: int) -> Any:
    """A quotient, an int where it is whole."""
    if isinstance(above, int) and above % below == 0:
        return above // below
    return Fraction(above) / below


@lru_cache(maxsize=4096)
def _exponentials(powers: tuple[int, ...]) -> tuple[tuple[tuple[int, ...], int], ...]:
    """Expand Π (z + 1/z)^c (z − 1/z)^s over all angles, cosines' powers first: multiples → integer."""
    n = len(powers) // 2
    waves: dict[tuple[int, ...], int] = {(): 1}
    for c, s in zip(powers[:n], powers[n:], strict=True):
        single = {0: 1}
        for sign in (1,) * c + (-1,) * s:
            out: dict[int, int] = {}
            for k, count in single.items():
                out[k + 1] = out.get(k + 1, 0) + count
                out[k - 1] = out.get(k - 1, 0) + sign * count
            single = out
        waves = {(*k, d): a * b for k, a in waves.items() for d, b in single.items() if a * b}
    return tuple(waves.items())
