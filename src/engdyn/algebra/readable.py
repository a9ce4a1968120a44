"""From ring elements back to formulas that people like to read.

An element is first turned into a small tree: grouped by products of speeds and accelerations,
every coefficient factored, angle sums restored (``cos(a)cos(b) + sin(a)sin(b)`` → ``cos(a - b)``)
and ``1 - cos²`` written as ``sin²``.  Trees become sympy expressions (for people) or source text
(:mod:`engdyn.algebra.codegen`).

Nodes are tuples: ``("number", Fraction)``, ``("generator", key)``, ``("sum", nodes)``,
``("product", nodes)``, ``("power", node, n)``, ``("cos", angle)`` and ``("sin", angle)`` with an
angle given as ``((base, factor), ...)``, ``("call", expr, arguments)``.
"""

from __future__ import annotations

from collections.abc import Iterable
from fractions import Fraction
from functools import lru_cache
from typing import Any

import sympy as sm

from engdyn.algebra.element import Element, without_common_roots
from engdyn.algebra.ring import Ring

__all__ = ["ONE", "ZERO", "make_product", "make_sum", "to_sympy", "tree"]

Node = tuple[Any, ...]
ZERO: Node = ("number", Fraction(0))
ONE: Node = ("number", Fraction(1))

#: Polynomials with more terms than this are not factored: it would take longer than it helps.
FACTOR_LIMIT = 150
#: Products of more sines and cosines than this are not written as sums of angles, for the same reason.
DEGREE_LIMIT = 12


def tree(element: Element) -> Node:
    """The readable tree of a ring element."""
    ring = element.ring
    if element.denominator is None:
        return _grouped(ring, element.numerator)
    if element.is_zero():
        return ZERO
    above, below = without_common_roots(ring, [element.numerator, element.denominator])
    return make_product([_grouped(ring, above), make_power(_factored(ring, below), -1)])


def make_sum(nodes: Iterable[Node]) -> Node:
    """Sum of nodes, zeros dropped."""
    kept = [node for node in nodes if node != ZERO]
    if not kept:
        return ZERO
    return kept[0] if len(kept) == 1 else ("sum", tuple(kept))


def make_product(nodes: Iterable[Node]) -> Node:
    """Product of nodes, numbers collected in front."""
    number, kept = Fraction(1), []
    for node in nodes:
        parts = node[1] if node[0] == "product" else (node,)
        for part in parts:
            if part[0] == "number":
                number *= part[1]
            else:
                kept.append(part)
    if number == 0:
        return ZERO
    if number != 1 or not kept:
        kept.insert(0, ("number", number))
    return kept[0] if len(kept) == 1 else ("product", tuple(kept))


def make_power(node: Node, n: int) -> Node:
    """Integer power of a node."""
    if n == 1:
        return node
    if node[0] == "number":
        return ("number", node[1] ** n)
    if node[0] == "power":
        return ("power", node[1], node[2] * n)
    return ("power", node, n)


def _grouped(ring: Ring, p: Any) -> Node:
    """A polynomial grouped by its monomials in time derivatives, each coefficient factored."""
    rates = {i for i, key in enumerate(ring.keys) if key[0] == "function" and key[2] > 0}
    groups: dict[tuple[int, ...], dict] = {}
    for exponents, coefficient in ring.polynomials.terms(p):
        motion = tuple(e if i in rates else 0 for i, e in enumerate(exponents))
        rest = tuple(0 if i in rates else e for i, e in enumerate(exponents))
        groups.setdefault(motion, {})[rest] = coefficient
    parts = []
    for motion, terms in groups.items():
        factor = _factored(ring, ring.polynomials.from_terms(terms))
        parts.append(make_product([factor, _monomial(ring, motion)]))
    return make_sum(parts)


def _monomial(ring: Ring, exponents: tuple[int, ...]) -> Node:
    """A product of generators; parameters first, sines and cosines last."""
    return make_product(
        make_power(generator_node(ring, i), e) for i, e in reversed(list(enumerate(exponents))) if e
    )


def generator_node(ring: Ring, index: int) -> Node:
    """The node of one generator: what it stands for, spelled out."""
    key = ring.keys[index]
    if key[0] in ("sine", "cosine"):
        return (key[0][:3], ((key[1], Fraction(1, key[2])),))
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


def _factored(ring: Ring, p: Any) -> Node:
    """A polynomial as a product of readable factors."""
    ps = ring.polynomials
    if len(p) > FACTOR_LIMIT:
        return _sum_of_terms(ring, p)
    content, factors = ps.factor(p)
    nodes: list[Node] = [("number", content)]
    counts = [[f, m] for f, m in factors]
    nodes += _sine_squares(ring, counts)
    for factor, multiplicity in sorted(counts, key=lambda fm: len(fm[0])):
        if multiplicity:
            node = _sum_of_terms(ring, factor)
            if _negative(node, content):
                node, content = _sum_of_terms(ring, -factor), content * (-1) ** multiplicity
                nodes.append(("number", Fraction((-1) ** multiplicity)))
            nodes.append(make_power(node, multiplicity))
    return make_product(nodes)


def _negative(node: Node, content: Fraction) -> bool:
    """Whether a factor reads better with the opposite sign: fewer minus signs altogether."""
    if node[0] != "sum":
        return False
    signs = [part[0] == "product" and part[1][0][0] == "number" and part[1][0][1] < 0 for part in node[1]]
    signs = [s or (part[0] == "number" and part[1] < 0) for s, part in zip(signs, node[1], strict=True)]
    return 2 * sum(signs) > len(signs) or (2 * sum(signs) == len(signs) and content < 0)


def _sine_squares(ring: Ring, counts: list[list]) -> list[Node]:
    """Replace (cos − 1)(cos + 1) among the factors by −sin²; lowers the multiplicities."""
    ps, nodes = ring.polynomials, []
    for i, key in enumerate(ring.keys):
        if key[0] != "cosine":
            continue
        minus, plus = ps.gens[i] - ps.one, ps.gens[i] + ps.one
        pair = [next((fm for fm in counts if fm[0] == wanted), None) for wanted in (minus, plus)]
        if all(pair):
            n = min(pair[0][1], pair[1][1])
            pair[0][1] -= n
            pair[1][1] -= n
            sine = ("sin", ((key[1], Fraction(1, key[2])),))
            nodes += [("number", Fraction((-1) ** n)), make_power(sine, 2 * n)]
    return nodes


def _sum_of_terms(ring: Ring, p: Any) -> Node:
    """An unfactored polynomial: terms that differ only in sines and cosines are taken together."""
    angular = [i for i, key in enumerate(ring.keys) if key[0] in ("sine", "cosine")]
    groups: dict[tuple[int, ...], dict[tuple[int, ...], Fraction]] = {}
    for exponents, coefficient in ring.polynomials.terms(p):
        rest = list(exponents)
        for i in angular:
            rest[i] = 0
        trig = tuple(exponents[i] for i in angular)
        groups.setdefault(tuple(rest), {})[trig] = coefficient
    parts = []
    for rest, terms in groups.items():
        monomial = _monomial(ring, rest)
        parts += [
            make_product([coefficient, monomial, trig]) for coefficient, trig in _trig(ring, angular, terms)
        ]
    return make_sum(parts)


def _trig(ring: Ring, angular: list[int], terms: dict) -> list[tuple[Node, Node]]:
    """A trigonometric polynomial as (coefficient, product) pairs, in the shorter of two forms."""
    plain = _plain_trig(ring, angular, terms)
    if len(terms) < 2 or max(map(sum, terms)) > DEGREE_LIMIT:
        return plain
    summed = _angle_sums(ring, angular, terms)
    return summed if len(summed) < len(plain) else plain


def _plain_trig(ring: Ring, angular: list[int], terms: dict) -> list[tuple[Node, Node]]:
    """Products of sines and cosines, a·(1 − cos²) joined to a·sin²."""
    terms, found = dict(terms), []
    for position, i in enumerate(angular):
        if ring.keys[i][0] != "cosine":
            continue
        for trig in list(terms):
            lower = (*trig[:position], trig[position] - 2, *trig[position + 1 :])
            if trig[position] >= 2 and terms.get(lower) == -terms.get(trig, Fraction(0)) != 0:
                coefficient = terms.pop(lower)
                terms.pop(trig)
                sine = make_power(("sin", ((ring.keys[i][1], Fraction(1, ring.keys[i][2])),)), 2)
                found.append(
                    (("number", coefficient), make_product([_trig_product(ring, angular, lower), sine]))
                )
    found += [(("number", c), _trig_product(ring, angular, trig)) for trig, c in terms.items()]
    return found


def _trig_product(ring: Ring, angular: list[int], exponents: tuple[int, ...]) -> Node:
    pairs = zip(angular, exponents, strict=True)
    return make_product(make_power(generator_node(ring, i), e) for i, e in pairs if e)


def _angle_sums(ring: Ring, angular: list[int], terms: dict) -> list[tuple[Node, Node]]:
    """The same polynomial as a sum of cosines and sines of angle sums (product-to-sum formulas)."""
    used = [at for at in range(len(angular)) if any(exponents[at] for exponents in terms)]
    angles = sorted({ring.keys[angular[at]][1:] for at in used}, key=str)
    place = {
        key: i for i, key in enumerate((kind, *angle) for kind in ("cosine", "sine") for angle in angles)
    }
    slots = [(at, place[ring.keys[angular[at]]]) for at in used]
    waves: dict[tuple[int, ...], list[Fraction]] = {}
    for exponents, coefficient in terms.items():
        powers = [0] * (2 * len(angles))
        for at, slot in slots:
            powers[slot] = exponents[at]
        turns = sum(powers[len(angles) :]) % 4  # each sine brings a factor −i
        scale = coefficient / 2 ** sum(powers) * (1 if turns in (0, 3) else -1)
        for multiples, count in _exponentials(tuple(powers)):
            waves.setdefault(multiples, [Fraction(0), Fraction(0)])[turns % 2] += scale * count
    found = []
    for multiples, (re, im) in waves.items():
        if multiples < tuple(-k for k in multiples) or (re == 0 and im == 0):
            continue
        angle = tuple((base, Fraction(k, d)) for (base, d), k in zip(angles, multiples, strict=True) if k)
        if not angle:
            found.append((("number", re), ONE))
            continue
        found += [(("number", 2 * re), ("cos", angle))] if re else []
        found += [(("number", -2 * im), ("sin", angle))] if im else []
    return found


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


def to_sympy(node: Node) -> sm.Expr:
    """The sympy expression of a tree."""
    kind = node[0]
    if kind == "number":
        return sm.Rational(node[1].numerator, node[1].denominator)
    if kind == "generator":
        return key_to_sympy(node[1])
    if kind == "sum":
        return sm.Add(*(to_sympy(part) for part in node[1]))
    if kind == "product":
        return sm.Mul(*(to_sympy(part) for part in node[1]))
    if kind == "power":
        return to_sympy(node[1]) ** node[2]
    if kind in ("cos", "sin"):
        angle = sm.Add(*(sm.Rational(f.numerator, f.denominator) * base for base, f in node[1]))
        return sm.cos(angle) if kind == "cos" else sm.sin(angle)
    return node[1](*(to_sympy(part) for part in node[2]))


def key_to_sympy(key: tuple[Any, ...]) -> sm.Expr:
    """The sympy expression that an independent generator stands for."""
    if key[0] != "function":
        return key[1]
    _, function, order = key
    return function if order == 0 else sm.Derivative(function, (function.args[0], order))
