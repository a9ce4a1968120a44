"""Nodes of readable trees, and the sympy expressions they stand for.

Nodes are tuples: ``("number", rational)``, ``("generator", key)``, ``("sum", nodes)``,
``("product", nodes)``, ``("power", node, n)``, ``("cos", angle)`` and ``("sin", angle)`` with an
angle given as ``((base, factor), ...)``, ``("call", expr, arguments)``.  A rational is an int or a Fraction.
"""

from __future__ import annotations

from collections.abc import Iterable
from fractions import Fraction
from functools import cmp_to_key
from typing import Any

import sympy as sm
from sympy.core.function import AppliedUndef
from sympy.core.sorting import default_sort_key

from engdyn.algebra.scan import key_to_sympy

__all__ = ["ONE", "ZERO", "Node", "make_power", "make_product", "make_sum", "to_sympy"]

Node = tuple[Any, ...]
ZERO: Node = ("number", 0)
ONE: Node = ("number", 1)

#: Kinds of nodes whose expressions are remembered: they occur again and again.
SHARED = frozenset(("sum", "power", "cos", "sin", "generator"))
#: Factors that are no numbers, powers or products themselves, so that a product can hold them as they are.
PLAIN = (sm.Symbol, AppliedUndef, sm.Derivative, sm.sin, sm.cos, sm.Add)

canonical = cmp_to_key(sm.Basic.compare)  # the order in which sympy keeps factors


def make_sum(nodes: Iterable[Node]) -> Node:
    """Sum of nodes, zeros dropped."""
    kept = [node for node in nodes if node != ZERO]
    if not kept:
        return ZERO
    return kept[0] if len(kept) == 1 else ("sum", tuple(kept))


def make_product(nodes: Iterable[Node]) -> Node:
    """Product of nodes, numbers collected in front."""
    number, kept = 1, []
    for node in nodes:
        kind = node[0]
        if kind == "number":
            number *= node[1]
        elif kind == "product":
            for part in node[1]:
                if part[0] == "number":
                    number *= part[1]
                else:
                    kept.append(part)
        else:
            kept.append(node)
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
        return ("number", Fraction(node[1]) ** n)
    if node[0] == "power":
        return ("power", node[1], node[2] * n)
    return ("power", node, n)


def to_sympy(node: Node, known: dict[Node, sm.Expr] | None = None) -> sm.Expr:
    """The sympy expression of a tree.

    Parameters
    ----------
    node : Node
    known : dict, optional
        Expressions of nodes that were met before; new ones are added.
    """
    known = {} if known is None else known
    if node[0] not in SHARED:
        return _expression(node, known)
    found = known.get(node)
    if found is None:
        found = known[node] = _expression(node, known)
    return found


def _expression(node: Node, known: dict[Node, sm.Expr]) -> sm.Expr:
    kind = node[0]
    if kind == "number":
        return _rational(node[1])
    if kind == "generator":
        return key_to_sympy(node[1])
    if kind == "sum":
        return sm.Add(*[to_sympy(part, known) for part in node[1]])
    if kind == "product":
        return _product([to_sympy(part, known) for part in node[1]])
    if kind == "power":
        return to_sympy(node[1], known) ** node[2]
    if kind in ("cos", "sin"):
        return _circular(sm.cos if kind == "cos" else sm.sin, node[1])
    return node[1](*(to_sympy(part, known) for part in node[2]))


def _rational(value: Any) -> sm.Rational:
    return sm.Integer(value) if isinstance(value, int) else sm.Rational(value.numerator, value.denominator)


def _product(factors: list[sm.Expr]) -> sm.Expr:
    """The product that ``sm.Mul(*factors)`` gives; put together at once where nothing can combine."""
    number = factors[0] if factors[0].is_Rational else sm.S.One
    rest = factors[1:] if number is not sm.S.One else factors
    bases = {f.base if f.is_Pow else f for f in rest}
    alone = len(rest) < 2 and any(f.is_Add for f in rest)  # sympy multiplies a number into a sum
    if alone or len(bases) < len(rest) or not all(_is_plain(f) for f in rest):
        return sm.Mul(*factors)
    rest.sort(key=canonical)
    return sm.Mul._from_args(rest if number is sm.S.One else [number, *rest], is_commutative=True)


def _is_plain(factor: sm.Expr) -> bool:
    """Whether a factor is a plain quantity, or a positive integer power of one."""
    if factor.is_Pow:
        return factor.exp.is_Integer and factor.exp.p > 0 and isinstance(factor.base, PLAIN)
    return isinstance(factor, PLAIN)


def _circular(function: Any, angle: tuple[tuple[sm.Expr, Any], ...]) -> sm.Expr:
    """Cosine or sine of an angle given by its terms."""
    plain = all(isinstance(base, sm.Symbol | AppliedUndef) for base, _ in angle)
    turned = plain and _is_turned(angle)
    signed = [(base, -f if turned else f) for base, f in angle]
    total = sm.Add(*[base if f == 1 else _rational(f) * base for base, f in signed])
    value = function(total, evaluate=not plain)  # of a plain angle sympy would find nothing to evaluate
    return -value if turned and function is sm.sin else value


def _is_turned(angle: tuple[tuple[sm.Expr, Any], ...]) -> bool:
    """Whether sympy takes the minus sign out of an angle: most terms negative, or the first of them."""
    minus = sum([f < 0 for _, f in angle])
    if 2 * minus != len(angle):
        return 2 * minus > len(angle)
    return min(angle, key=lambda term: default_sort_key(term[0]))[1] < 0
