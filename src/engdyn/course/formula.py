"""Formulas as text, read without ever being executed.

A tokenizer and a recursive-descent parser with a fixed grammar: numbers, the names of a symbol table, the
operators ``+ - * / ** ^``, parentheses and a short list of functions. Nothing else means anything, so a
text can neither call code nor keep the check busy: length, depth, powers and the size of every constant
part are limited. In particular ``S``, ``N``, ``C``, ``E``, ``I``, ``Q``, ``O``, ``beta``, ``gamma`` and
``zeta`` mean what the table says, never what a library means by them.
"""

from __future__ import annotations

import difflib
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import sympy as sm

from engdyn.course.evaluation import NoValueError, evaluate
from engdyn.errors import EngdynError

__all__ = ["FUNCTIONS", "READABLE", "FormulaError", "parse_formula"]

#: Functions that a formula may call → what they mean and how many arguments they take.
FUNCTIONS: dict[str, tuple[Callable[..., sm.Expr], int]] = {
    "sin": (sm.sin, 1),
    "cos": (sm.cos, 1),
    "tan": (sm.tan, 1),
    "asin": (sm.asin, 1),
    "acos": (sm.acos, 1),
    "atan": (sm.atan, 1),
    "atan2": (sm.atan2, 2),
    "sqrt": (sm.sqrt, 1),
    "exp": (sm.exp, 1),
    "log": (sm.log, 1),
    "abs": (sm.Abs, 1),
}

#: Functions that may stand in a sympy expression given as an answer.
READABLE = (
    *(sm.sin, sm.cos, sm.tan, sm.cot, sm.sec, sm.csc, sm.asin, sm.acos, sm.atan, sm.atan2),
    *(sm.sinh, sm.cosh, sm.tanh, sm.exp, sm.log, sm.Abs, sm.sign),
)

#: Longest text, largest number of tokens, deepest nesting, largest numeric exponent.
LENGTH, TOKENS, DEPTH, EXPONENT = 2000, 600, 50, 20

_GREEK = dict(
    zip(
        "αβγζθρφψωΩπ",
        ["alpha", "beta", "gamma", "zeta", "theta", "rho", "phi", "psi", "omega", "Omega", "pi"],
        strict=True,
    )
)
_TOKEN = re.compile(
    r"(?P<number>(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)"
    rf"|(?P<name>[A-Za-z{''.join(_GREEK)}][A-Za-z0-9_]*)"
    r"|(?P<sign>\*\*|[-+*/^(),])",
    re.ASCII,
)
_NUMBER = re.compile(r"\d{0,30}\.?\d{0,30}(?:[eE][+-]?\d{1,2})?")
_PLAIN = str.maketrans("−–·×∗⁄", "--***/")


class FormulaError(EngdynError):
    """A formula that cannot be read: the message says where and why."""


@dataclass(frozen=True)
class Token:
    """A piece of a formula: its kind, its text and its position, counted from 1."""

    kind: str
    text: str
    position: int


def parse_formula(text: str, table: Mapping[str, sm.Expr]) -> sm.Expr:
    """The expression that a text stands for.

    Parameters
    ----------
    text : str
        Such as ``"sqrt((m + M_c)*g/(m*l))"``; ``^`` and ``**`` are powers, products need ``*``.
    table : mapping of str to sympy.Expr
        The symbols that may occur, by name; ``pi`` is known besides.

    Returns
    -------
    sympy.Expr

    Raises
    ------
    FormulaError
        An unknown name or sign, something missing, a text that is too long, too deep or too large.

    Examples
    --------
    >>> import sympy as sm
    >>> parse_formula("-N^2/2", {"N": sm.Symbol("N")})
    -N**2/2
    """
    if not isinstance(text, str):
        raise FormulaError(f"A formula is text, not a {type(text).__name__}.")
    if len(text) > LENGTH:
        raise FormulaError(f"The formula is {len(text)} characters long; at most {LENGTH} are read.")
    plain = text.translate(_PLAIN)
    parser = _Parser(_tokens(plain), table, len(plain) + 1)
    return parser.whole()


def _tokens(text: str) -> list[Token]:
    found: list[Token] = []
    position = 0
    while position < len(text):
        if text[position].isspace():
            position += 1
            continue
        match = _TOKEN.match(text, position)
        if match is None:
            raise FormulaError(
                f"At position {position + 1}: the sign {text[position]!r} has no meaning in a formula."
            )
        piece = match.group()
        found.append(Token(str(match.lastgroup), _GREEK.get(piece[0], piece[0]) + piece[1:], position + 1))
        position = match.end()
        if len(found) > TOKENS:
            raise FormulaError(f"The formula has more than {TOKENS} parts. Bring it into a shorter form.")
    if not found:
        raise FormulaError("The formula is empty.")
    return found


class _Parser:
    """Recursive descent: sum, product, sign, power, atom."""

    def __init__(self, tokens: list[Token], table: Mapping[str, sm.Expr], end: int):
        self.tokens, self.table, self.end = tokens, table, end
        self.at = 0
        self.depth = 0

    def whole(self) -> sm.Expr:
        expr = self.sum()
        token = self.peek()
        if token is not None:
            if token.kind == "sign" and token.text in "),":
                raise self.error(token, f"the sign {token.text!r} has no partner")
            raise self.error(
                token, f"an operator is missing before {token.text[:40]!r}; write products with *"
            )
        return expr

    def peek(self) -> Token | None:
        return self.tokens[self.at] if self.at < len(self.tokens) else None

    def take(self, *signs: str) -> Token | None:
        """The next token if it is one of these signs."""
        token = self.peek()
        if token is not None and token.kind == "sign" and token.text in signs:
            self.at += 1
            return token
        return None

    def error(self, token: Token | None, what: str) -> FormulaError:
        return FormulaError(f"At position {token.position if token else self.end}: {what}.")

    def sum(self) -> sm.Expr:
        self.depth += 1
        if self.depth > DEPTH:
            raise self.error(self.peek(), f"the formula is nested more than {DEPTH} deep")
        expr = self.product()
        while (sign := self.take("+", "-")) is not None:
            term = self.product()
            expr = self.made(sign, expr + term if sign.text == "+" else expr - term)
        self.depth -= 1
        return expr

    def product(self) -> sm.Expr:
        expr = self.signed()
        while (sign := self.take("*", "/")) is not None:
            factor = self.signed()
            if sign.text == "/" and factor.is_zero:
                raise self.error(sign, "this divides by zero")
            expr = self.made(sign, expr * factor if sign.text == "*" else expr / factor)
        return expr

    def signed(self) -> sm.Expr:
        negative = False
        while (sign := self.take("+", "-")) is not None:
            negative ^= sign.text == "-"
        expr = self.power()
        return -expr if negative else expr

    def power(self) -> sm.Expr:
        base = self.atom()
        sign = self.take("**", "^")
        if sign is None:
            return base
        self.depth += 1
        if self.depth > DEPTH:
            raise self.error(sign, f"the formula is nested more than {DEPTH} deep")
        exponent = self.signed()
        self.depth -= 1
        if not exponent.is_Number or abs(exponent) > EXPONENT:
            raise self.error(
                sign, f"an exponent must be a number between -{EXPONENT} and {EXPONENT}; for e^x write exp(x)"
            )
        if base.is_zero and exponent < 0:
            raise self.error(sign, "this divides by zero")
        if base.is_Rational and (abs(base.p).bit_length() + base.q.bit_length()) * abs(exponent) > 2048:
            raise self.error(sign, "this power of a number is too large")
        return self.made(sign, base**exponent)

    def atom(self) -> sm.Expr:
        token = self.peek()
        if token is None:
            raise self.error(None, "the formula ends too early")
        if self.take("("):
            expr = self.sum()
            if not self.take(")"):
                raise self.error(self.peek(), "a closing parenthesis is missing")
            return expr
        self.at += 1
        if token.kind == "number":
            return self.number(token)
        if token.kind == "name":
            return self.named(token)
        raise self.error(token, f"a number, a symbol or a parenthesis is missing before {token.text!r}")

    def number(self, token: Token) -> sm.Expr:
        if not _NUMBER.fullmatch(token.text):
            raise self.error(token, "this number is too long or too large")
        return sm.Integer(token.text) if token.text.isdigit() else sm.Float(token.text)

    def named(self, token: Token) -> sm.Expr:
        following = self.peek()
        called = following is not None and following.text == "("
        if token.text in self.table:
            if called:
                raise self.error(
                    following, f"{token.text} is a symbol, not a function; write products with *"
                )
            return self.table[token.text]
        if token.text in FUNCTIONS:
            if not called:
                raise self.error(token, f"the function {token.text} needs parentheses")
            return self.call(token)
        if token.text == "pi":
            return sm.pi
        known = [*self.table, *FUNCTIONS, "pi"]
        near = difflib.get_close_matches(token.text[:40], known, n=1, cutoff=0.5)
        advice = f" Did you mean {near[0]}?" if near else ""
        raise FormulaError(
            f"At position {token.position}: the name {token.text[:40]!r} means nothing here.{advice}"
        )

    def call(self, token: Token) -> sm.Expr:
        function, count = FUNCTIONS[token.text]
        self.take("(")
        arguments = [self.sum()]
        while self.take(","):
            arguments.append(self.sum())
        if not self.take(")"):
            raise self.error(self.peek(), "a closing parenthesis is missing")
        if len(arguments) != count:
            raise self.error(
                token, f"{token.text} takes {count} argument{'s' if count > 1 else ''}, not {len(arguments)}"
            )
        return self.made(token, function(*arguments))

    def made(self, token: Token, expr: Any) -> sm.Expr:
        """An intermediate result; a constant one must have a finite, moderate value."""
        if not expr.free_symbols and not expr.is_Rational:
            try:
                evaluate(expr, {})
            except NoValueError as error:
                raise self.error(token, f"this part has no real value of moderate size ({error})") from error
        elif expr.is_Rational and abs(expr.p).bit_length() + expr.q.bit_length() > 4096:
            raise self.error(token, "this number is too large")
        return expr
