"""The symbols of an exercise: what each name means, and answers rewritten in them.

An answer may come as text or as a sympy expression with symbols of the student's own making
(``Symbol("m")`` with whatever assumptions, ``dynamicsymbols("theta")``). Here every name is given its
one meaning, that of the exercise's system, and anything that a check cannot read is refused with a reason.
"""

from __future__ import annotations

import difflib
import numbers
from collections.abc import Iterable, Iterator
from math import inf
from typing import Any

import sympy as sm
from sympy.core.function import AppliedUndef
from sympy.physics.vector import dynamicsymbols

from engdyn.course.evaluation import NoValueError, evaluate
from engdyn.course.formula import READABLE, FormulaError, parse_formula
from engdyn.system import System

__all__ = ["Notation"]

#: Largest expression that is looked at: nodes, depth, bits of a number, magnitude of a numeric power.
NODES, DEPTH, BITS, POWER = 3000, 100, 4096, 64


class Notation:
    """Name → symbol of one system.

    Parameters
    ----------
    system : System
        Gives parameters, coordinates (with their rates ``x_d``, ``x_dd``) and inputs.

    Attributes
    ----------
    table : dict of str to sympy.Expr
    """

    def __init__(self, system: System):
        t = dynamicsymbols._t
        self.system = system
        self.table: dict[str, sm.Expr] = {p.name: p.symbol for p in system.parameters}
        for moving in (*system.coordinates, *system.inputs):
            self.table[moving.name] = moving.symbol
            self.table[f"{moving.name}_d"] = moving.symbol.diff(t)
            self.table[f"{moving.name}_dd"] = moving.symbol.diff(t, 2)
        self.names = {symbol: name for name, symbol in self.table.items()}

    def expression(self, answer: Any) -> sm.Expr:
        """One expression in the system's symbols, from text, a sympy expression or a number.

        Raises
        ------
        FormulaError
            What cannot be read, and why.
        """
        if isinstance(answer, str):
            return parse_formula(answer, self.table)
        if isinstance(answer, sm.Basic):
            return self._translate(answer)
        if isinstance(answer, numbers.Real) and not isinstance(answer, bool):
            return _number(answer)
        if getattr(answer, "shape", None) == () and hasattr(answer, "item"):
            return self.expression(answer.item())
        if answer is None:
            raise FormulaError("Your answer is None: does a function lack its return?")
        raise FormulaError(
            f"An answer of type {type(answer).__name__} is no formula. Give text or a sympy expression."
        )

    def residual(self, answer: Any) -> sm.Expr:
        """Left minus right side of an equation: text with or without ``=``, ``Eq``, an expression."""
        if isinstance(answer, str) and "=" in answer:
            left, *right = answer.split("=")
            if len(right) != 1:
                raise FormulaError(
                    "The text holds more than one sign =. Write one equation, with = or == 0 left out."
                )
            return parse_formula(left, self.table) - parse_formula(right[0], self.table)
        if isinstance(answer, sm.Equality):
            return self._translate(answer.lhs) - self._translate(answer.rhs)
        return self.expression(answer)

    def name(self, symbol: sm.Expr) -> str:
        """The name under which a symbol of the system is written."""
        return self.names[symbol]

    def symbols_in(self, expr: sm.Expr) -> list[str]:
        """Names of all symbols of an expression, in the order of the table."""
        found = {node for node in nodes(expr) if node in self.names}
        return [name for name, symbol in self.table.items() if symbol in found]

    def _translate(self, expr: sm.Basic) -> sm.Expr:
        if isinstance(expr, sm.Equality):
            raise FormulaError("This is an equation. Give its right-hand side alone, one expression.")
        if not isinstance(expr, sm.Expr):
            raise FormulaError(f"This is a sympy {type(expr).__name__}. Give one expression.")
        own = {node: self._meaning(node) for node in nodes(expr) if is_symbol(node)}
        return expr.xreplace({node: symbol for node, symbol in own.items() if node is not symbol})

    def _meaning(self, node: sm.Expr) -> sm.Expr:
        name = written_name(node)
        if name not in self.table:
            raise FormulaError(unknown_name(name, self.table))
        return self.table[name]


def _number(value: numbers.Real) -> sm.Expr:
    if isinstance(value, numbers.Integral):
        if int(value).bit_length() > BITS:
            raise FormulaError("This number is too large to be an answer.")
        return sm.Integer(int(value))
    number = float(value)
    if number != number or number in (float("inf"), float("-inf")):
        raise FormulaError(f"Your answer is {number}, not a finite number.")
    return sm.Float(number)


def unknown_name(name: str, known: Iterable[str]) -> str:
    """What to say about a name that means nothing here."""
    near = difflib.get_close_matches(name[:40], list(known), n=1, cutoff=0.5)
    advice = f" Did you mean {near[0]}?" if near else ""
    return f"The name {name[:40]!r} is no symbol of this exercise.{advice}"


def is_symbol(node: sm.Basic) -> bool:
    """Whether a node stands for a quantity: a symbol, a function of time or its derivative."""
    return isinstance(node, sm.Symbol | AppliedUndef | sm.Derivative)


def written_name(node: sm.Expr) -> str:
    """The name of a symbol as one writes it: theta, theta_d, theta_dd."""
    if isinstance(node, sm.Symbol):
        return node.name
    if isinstance(node, AppliedUndef):
        if len(node.args) != 1 or not isinstance(node.args[0], sm.Symbol):
            raise FormulaError(
                f"The function {node.func.__name__[:40]} is unknown here; use symbols of the exercise."
            )
        return node.func.__name__
    inner = node.expr
    if not isinstance(inner, AppliedUndef) or len(node.variable_count) != 1:
        raise FormulaError("Carry out the derivatives first, so that only rates of coordinates remain.")
    return f"{written_name(inner)}_{'d' * min(int(node.variable_count[0][1]), 9)}"


def nodes(expr: sm.Basic) -> Iterator[sm.Basic]:
    """All nodes of an expression, its symbols whole; refuses what is too large or unreadable."""
    waiting: list[tuple[sm.Basic, int]] = [(expr, 1)]
    count = 0
    while waiting:
        node, depth = waiting.pop()
        count += 1
        if count > NODES or depth > DEPTH:
            raise FormulaError("This expression is too large to be checked. Bring it into a shorter form.")
        _refuse_unreadable(node)
        yield node
        if not is_symbol(node):
            waiting += [(argument, depth + 1) for argument in node.args]


def _value(number: sm.Expr) -> float:
    """Value of an exponent without symbols, infinite where it has none of moderate size."""
    try:
        return float(evaluate(number, {})[0])
    except NoValueError:
        return inf


def _refuse_unreadable(node: sm.Basic) -> None:
    if isinstance(node, sm.Rational):
        if abs(node.p).bit_length() + abs(node.q).bit_length() > BITS:
            raise FormulaError("This expression contains a number that is too large.")
    elif isinstance(node, sm.Float):
        if not node.is_finite or abs(node._mpf_[2] + node._mpf_[3]) > BITS:
            raise FormulaError("This expression contains a number that is too large or not finite.")
    elif isinstance(node, sm.Pow):
        if not node.exp.free_symbols and abs(_value(node.exp)) > POWER:
            raise FormulaError(f"This expression contains a power beyond {POWER}.")
    elif node is sm.I:
        raise FormulaError(
            "This expression contains the imaginary unit. Make your symbols with sympy.symbols."
        )
    elif not (is_symbol(node) or isinstance(node, (sm.Add, sm.Mul, *READABLE)) or node in (sm.pi, sm.E)):
        if node in (sm.nan, sm.oo, -sm.oo, sm.zoo):
            raise FormulaError("This expression has no finite value: something is divided by zero.")
        raise FormulaError(f"This expression contains {type(node).__name__}, which the check does not read.")
