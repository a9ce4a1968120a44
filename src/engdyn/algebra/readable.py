"""From ring elements back to formulas that people like to read.

An element is first turned into a small tree (:mod:`engdyn.algebra.nodes`): grouped by products of speeds
and accelerations, every coefficient factored, angle sums restored (``cos(a)cos(b) + sin(a)sin(b)`` →
``cos(a - b)``) and ``1 - cos²`` written as ``sin²``.  Trees become sympy expressions (for people) or
source text (:mod:`engdyn.algebra.codegen`).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from fractions import Fraction
from math import gcd, lcm
from typing import Any

import sympy as sm

from engdyn.algebra.element import Element, without_common_roots
from engdyn.algebra.nodes import ONE, ZERO, Node, make_power, make_product, make_sum, to_sympy
from engdyn.algebra.ring import Ring
from engdyn.algebra.scan import key_to_sympy
from engdyn.algebra.trigonometry import circular, shortest

__all__ = [
    "ONE",
    "ZERO",
    "Node",
    "expression",
    "key_to_sympy",
    "make_power",
    "make_product",
    "make_sum",
    "to_sympy",
    "tree",
]

Exponents = tuple[tuple[int, int], ...]
Terms = list[tuple[Exponents, Any]]

#: Polynomials with more terms than this are not factored: it would take longer than it helps.
FACTOR_LIMIT = 150


def expression(element: Element) -> sm.Expr:
    """The readable sympy expression of a ring element."""
    return to_sympy(tree(element), element.ring.expressions)


def tree(element: Element) -> Node:
    """The readable tree of a ring element."""
    if element.node is None:
        element.node = _tree(element)
    return element.node


def _tree(element: Element) -> Node:
    ring = element.ring
    if element.denominator is None:
        return _grouped(ring, element.numerator)
    if element.is_zero():
        return ZERO
    above, below = without_common_roots(ring, [element.numerator, element.denominator])
    return make_product(
        [_grouped(ring, above), make_power(_factored(ring, ring.polynomials.sparse(below)), -1)]
    )


def _grouped(ring: Ring, p: Any) -> Node:
    """A polynomial grouped by its monomials in time derivatives, each coefficient factored."""
    keys = ring.keys
    groups: dict[Exponents, Terms] = {}
    for exponents, coefficient in ring.polynomials.sparse(p):
        motion = tuple([ie for ie in exponents if keys[ie[0]][0] == "function" and keys[ie[0]][2] > 0])
        rest = tuple([ie for ie in exponents if ie not in motion]) if motion else exponents
        groups.setdefault(motion, []).append((rest, coefficient))
    return make_sum(
        [make_product([_factored(ring, terms), _monomial(ring, motion)]) for motion, terms in groups.items()]
    )


def _monomial(ring: Ring, exponents: Exponents) -> Node:
    """A product of generators; parameters first, sines and cosines last."""
    return make_product([make_power(generator_node(ring, i), e) for i, e in reversed(exponents)])


def generator_node(ring: Ring, index: int) -> Node:
    """The node of one generator: what it stands for, spelled out."""
    key = ring.keys[index]
    if key[0] in ("sine", "cosine"):
        return circular(key)
    definition = ring.definitions.get(index)
    if definition is None:
        return ("generator", key)
    if definition.kind == "root":
        return ("call", sm.sqrt, (tree(definition.arguments[0]),))
    if definition.kind == "magnitude":
        return ("call", sm.Abs, (tree(definition.arguments[0]),))
    if not definition.arguments:
        return ("generator", key)
    return ("call", key[1].func, tuple(tree(a) for a in definition.arguments))


def _factored(ring: Ring, terms: Terms) -> Node:
    """A polynomial as a product of readable factors."""
    number, common, terms = _content(terms)
    nodes = [_monomial(ring, common)]
    if len(terms) > 1:
        counts = [fm for part in _separated(ring, terms) for fm in _remembered(ring, _factors, part)]
        sines, counts = _sine_squares(ring, counts)
        nodes += sines
        for factor, multiplicity in sorted(counts, key=lambda fm: len(fm[0])):
            node = _remembered(ring, _sum_of_terms, factor)
            if _reads_better_negative(node, number):
                node = make_sum([make_product([("number", -1), part]) for part in node[1]])
                number *= (-1) ** multiplicity
            nodes.append(make_power(node, multiplicity))
    return make_product([("number", number), *nodes])


def _remembered(ring: Ring, function: Callable[[Ring, Terms], Any], terms: Terms) -> Any:
    """``function(ring, terms)``, computed once: the same factors occur in many entries."""
    key = (function, tuple(terms))
    if key not in ring.remembered:
        ring.remembered[key] = function(ring, terms)
    return ring.remembered[key]


def _content(terms: Terms) -> tuple[Any, Exponents, Terms]:
    """Terms as number · monomial · primitive terms, of which the first is positive."""
    below = lcm(*[c.denominator for _, c in terms])
    above = gcd(*[c.numerator * (below // c.denominator) for _, c in terms])
    above = above if terms[0][1] > 0 else -above
    common = dict(terms[0][0])
    for exponents, _ in terms[1:]:
        other = dict(exponents)
        common = {i: min(e, other[i]) for i, e in common.items() if i in other}
        if not common:
            break
    scaled = [(exponents, c.numerator * (below // c.denominator) // above) for exponents, c in terms]
    if common:
        scaled = [
            (tuple([(i, e - common.get(i, 0)) for i, e in exponents if e != common.get(i, 0)]), c)
            for exponents, c in scaled
        ]
    return (above if below == 1 else Fraction(above, below)), tuple(common.items()), scaled


def _separated(ring: Ring, terms: Terms) -> list[Terms]:
    """Primitive terms as a product A·T where T holds all sines and cosines, if they can be written so."""
    groups = _by_trig(ring, terms)
    first = next(iter(groups.values()))
    if len(groups) == 1 or len(first) == 1:
        return [terms]
    wanted = dict(first)
    lead = first[0][0]
    ratios = []
    for trig, group in groups.items():
        found = dict(group)
        if found.keys() != wanted.keys():
            return [terms]
        ratio = Fraction(found[lead], wanted[lead])
        if any(found[rest] != ratio * c for rest, c in first):
            return [terms]
        ratios.append((trig, ratio))
    return [_content(first)[2], _content(ratios)[2]]


def _by_trig(ring: Ring, terms: Terms) -> dict[Exponents, Terms]:
    """Terms collected by their sines and cosines."""
    keys = ring.keys
    groups: dict[Exponents, Terms] = {}
    for exponents, c in terms:
        trig = tuple([ie for ie in exponents if keys[ie[0]][0] in ("sine", "cosine")])
        rest = tuple([ie for ie in exponents if ie not in trig]) if trig else exponents
        groups.setdefault(trig, []).append((rest, c))
    return groups


def _factors(ring: Ring, terms: Terms) -> list[tuple[Terms, int]]:
    """Irreducible factors of primitive terms without a common monomial, with their multiplicities.

    A generator that occurs in one term only, to the first power, leaves no room for a factor.
    """
    seen: dict[int, int] = {}
    for exponents, _ in terms:
        for i, e in exponents:
            seen[i] = seen.get(i, 0) + e
    if 1 in seen.values() or len(terms) > FACTOR_LIMIT:
        return [(terms, 1)]
    ps = ring.polynomials
    content, factors = ps.factor(ps.from_sparse(terms))
    found = [(ps.sparse(f), m) for f, m in factors]
    if content < 0:
        found.append(([((), -1)], 1))
    return found


def _reads_better_negative(node: Node, content: Any) -> bool:
    """Whether a factor reads better with the opposite sign: fewer minus signs altogether."""
    if node[0] != "sum":
        return False
    minus = 0
    for part in node[1]:
        first = part[1][0] if part[0] == "product" else part
        minus += first[0] == "number" and first[1] < 0
    return 2 * minus > len(node[1]) or (2 * minus == len(node[1]) and content < 0)


def _sine_squares(
    ring: Ring, counts: Sequence[tuple[Terms, int]]
) -> tuple[list[Node], list[tuple[Terms, int]]]:
    """Replace (cos − 1)(cos + 1) among the factors by −sin²."""
    halves: dict[tuple[int, int], int] = {}
    for at, (terms, _) in enumerate(counts):
        if len(terms) == 2 and terms[1][0] == () and abs(terms[1][1]) == terms[0][1] == 1:
            ((i, e),) = terms[0][0] if len(terms[0][0]) == 1 else ((0, 0),)
            if e == 1 and ring.keys[i][0] == "cosine":
                halves[i, terms[1][1]] = at
    nodes, left = [], [m for _, m in counts]
    for (i, sign), at in halves.items():
        if sign < 0 and (i, 1) in halves:
            n = min(left[at], left[halves[i, 1]])
            left[at] -= n
            left[halves[i, 1]] -= n
            sine = circular(("sine", *ring.keys[i][1:]))
            nodes += [("number", (-1) ** n), make_power(sine, 2 * n)]
    return nodes, [(terms, m) for (terms, _), m in zip(counts, left, strict=True) if m]


def _sum_of_terms(ring: Ring, terms: Terms) -> Node:
    """An unfactored polynomial: terms that differ only in sines and cosines are taken together."""
    groups: dict[Exponents, dict[Exponents, Any]] = {}
    for trig, group in _by_trig(ring, terms).items():
        for rest, c in group:
            groups.setdefault(rest, {})[trig] = c
    parts: Iterable[Node] = (
        make_product([("number", c), monomial, trig])
        for rest, angular in groups.items()
        for monomial in [_monomial(ring, rest)]
        for c, trig in shortest(ring, angular)
    )
    return make_sum(parts)
