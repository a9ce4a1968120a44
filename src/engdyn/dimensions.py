"""Units of formulas: the first test that every result has to pass.  Appendix C."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from html import escape
from typing import Any

import sympy as sm
from sympy.core.function import AppliedUndef
from sympy.physics.vector import dynamicsymbols

from engdyn.algebra.expressions import as_expression
from engdyn.errors import EngdynError

__all__ = [
    "Dimension",
    "DimensionCheck",
    "DimensionMismatch",
    "Term",
    "check_dimensions",
    "dimension_of",
    "dimension_of_unit",
    "system_dimensions",
    "unit_text",
]

#: Exponents of kg, m, s, A, K.
Dimension = tuple[Fraction, ...]

_BASES = ("kg", "m", "s", "A", "K")
_DERIVED = {
    "-": (0, 0, 0, 0, 0),
    "1": (0, 0, 0, 0, 0),
    "rad": (0, 0, 0, 0, 0),
    "kg": (1, 0, 0, 0, 0),
    "m": (0, 1, 0, 0, 0),
    "s": (0, 0, 1, 0, 0),
    "A": (0, 0, 0, 1, 0),
    "K": (0, 0, 0, 0, 1),
    "Hz": (0, 0, -1, 0, 0),
    "N": (1, 1, -2, 0, 0),
    "Pa": (1, -1, -2, 0, 0),
    "J": (1, 2, -2, 0, 0),
    "W": (1, 2, -3, 0, 0),
    "V": (1, 2, -3, -1, 0),
}
_NONE: Dimension = (Fraction(0),) * 5


class DimensionMismatch(EngdynError):
    """A formula adds, or takes the sine of, what has the wrong unit; the message names the parts."""


def dimension_of_unit(unit: str) -> Dimension:
    """Dimension of an SI unit written as in the course: ``"N m s/rad"``, ``"kg m^2"``.

    Raises
    ------
    EngdynError
        A unit that is not among those of the course.
    """
    total, sign = list(_NONE), 1
    for word in unit.replace("/", " / ").split():
        if word == "/":
            sign = -1
            continue
        name, _, power = word.partition("^")
        if name not in _DERIVED or (power and not power.lstrip("-").isdigit()):
            raise EngdynError(
                f"the unit {unit!r} is not understood at {word!r}: write it with {', '.join(_DERIVED)}"
            )
        total = [a + sign * int(power or 1) * b for a, b in zip(total, _DERIVED[name], strict=True)]
    return tuple(total)


def system_dimensions(system: Any) -> dict[sm.Expr, Dimension]:
    """Dimension of every symbol of a system, rates and accelerations included."""
    found = {p.symbol: dimension_of_unit(p.unit) for p in system.parameters}
    found[dynamicsymbols._t] = dimension_of_unit("s")
    for moving in (*system.coordinates, *system.inputs):
        found |= _with_rates(moving.symbol, dimension_of_unit(moving.unit))
    return found


def _with_rates(symbol: sm.Expr, own: Dimension) -> dict[sm.Expr, Dimension]:
    """A symbol and, of one that moves, its rate and acceleration."""
    t = dynamicsymbols._t
    orders = (0, 1, 2) if symbol.has(t) else (0,)
    return {
        symbol.diff(t, order) if order else symbol: (own[0], own[1], own[2] - order, *own[3:])
        for order in orders
    }


def dimension_of(expr: sm.Expr, known: dict[sm.Expr, Dimension]) -> Dimension:
    """Dimension of an expression.

    Raises
    ------
    DimensionMismatch
        Terms of different dimensions are added, or a function is given what is no pure number.
    """
    if expr in known:
        return known[expr]
    if isinstance(expr, AppliedUndef | sm.Derivative) or not expr.args:
        return _NONE
    if expr.is_Add:
        return _of_sum(expr, known)
    if expr.is_Mul:
        parts = [dimension_of(a, known) for a in expr.args]
        return tuple(sum(column, Fraction(0)) for column in zip(*parts, strict=True))
    if isinstance(expr, sm.Pow) and expr.exp.is_Number:
        power = Fraction(float(expr.exp)).limit_denominator(100)
        return tuple(power * e for e in dimension_of(expr.base, known))
    if isinstance(expr, sm.Abs):
        return dimension_of(expr.args[0], known)
    parts = [dimension_of(a, known) for a in expr.args]
    if (isinstance(expr, sm.atan2) and parts[0] == parts[1]) or isinstance(expr, sm.sign):
        return _NONE
    if any(part != _NONE for part in parts):
        name = "power" if isinstance(expr, sm.Pow) else type(expr).__name__
        raise DimensionMismatch(
            f"the argument of {name} in {short(expr)} must be a pure number, but has a unit"
        )
    return _NONE


def _of_sum(expr: sm.Expr, known: dict[sm.Expr, Dimension]) -> Dimension:
    first, *others = sorted(expr.args, key=sm.default_sort_key)
    wanted = dimension_of(first, known)
    for term in others:
        found = dimension_of(term, known)
        if found != wanted:
            raise DimensionMismatch(
                f"{short(first)} [{unit_text(wanted)}] and {short(term)} [{unit_text(found)}] are added"
            )
    return wanted


def unit_text(dimension: Dimension) -> str:
    """A dimension in base units, such as kg m^2 s^-2; 1 for a pure number."""
    parts = [
        f"{base}^{power}" if power != 1 else base
        for base, power in zip(_BASES, dimension, strict=True)
        if power
    ]
    return " ".join(parts) or "1"


def short(expr: sm.Expr) -> str:
    """An expression as text of at most 60 characters, with names such as theta_d for rates."""
    named = {
        node: sm.Symbol(f"{node.expr.func.__name__}_{'d' * int(node.variable_count[0][1])}")
        for node in expr.atoms(sm.Derivative)
    }
    text = str(expr.xreplace(named)).replace("(t)", "")
    return text if len(text) <= 60 else f"{text[:57]}..."


@dataclass(frozen=True)
class Term:
    """One term of an equation.

    Attributes
    ----------
    equation : int
        Number of the equation, from 1.
    expression : sympy.Expr
    unit : str
        In base units; "" where the term itself has none, because what it adds does not go together.
    right : bool or None
        Whether its unit is that of most terms of the equation; None where there is no majority.
    reason : str
        What is wrong inside the term.
    """

    equation: int
    expression: sm.Expr
    unit: str
    right: bool | None
    reason: str = ""


@dataclass(frozen=True, repr=False)
class DimensionCheck:
    """Units of all terms of some equations; true where they agree.

    Attributes
    ----------
    terms : tuple of Term
    """

    terms: tuple[Term, ...]

    @property
    def wrong(self) -> tuple[Term, ...]:
        """Terms that do not go with the others; all terms of an equation that has no majority."""
        return tuple(term for term in self.terms if not term.right)

    def __bool__(self) -> bool:
        return not self.wrong

    def __repr__(self) -> str:
        if self:
            return f"DimensionCheck(all {len(self.terms)} terms agree)"
        return "\n".join(
            f"equation {t.equation}: {short(t.expression)} {_verdict(t)}"
            + (f" [{t.unit}]" if t.unit else f": {t.reason}")
            for t in self.wrong
        )

    def _repr_html_(self) -> str:
        rows = "".join(
            f"<tr><td>{t.equation}</td><td><code>{escape(short(t.expression))}</code></td><td>{t.unit or '?'}</td>"
            f"<td>{escape(' '.join([_verdict(t), t.reason]).strip())}</td></tr>"
            for t in self.terms
        )
        head = "".join(f"<th>{h}</th>" for h in ("equation", "term", "unit", "verdict"))
        return f"<table><thead><tr>{head}</tr></thead><tbody>{rows}</tbody></table>"


def _verdict(term: Term) -> str:
    words = {
        True: "goes with the others",
        False: "does not go with the others",
        None: "may be wrong, or the others",
    }
    return words[term.right]


def check_dimensions(equations: Any, units: Any) -> DimensionCheck:
    """The unit of every term of equations of motion, and which term does not go with the others.

    Parameters
    ----------
    equations : EquationsOfMotion, or sympy expression, Eq or sequence of these
        Expressions are sums that are zero.
    units : System, or mapping of symbol to str
        Units of the symbols, such as ``"N s/m"``, "-" for none; the rates of a coordinate follow from its own unit.

    Returns
    -------
    DimensionCheck

    Raises
    ------
    EngdynError
        A unit that is not understood; a symbol without a unit.

    Notes
    -----
    Appendix C.  Where two terms disagree and there is no third one, both are named: the units alone do not say which
    of them is wrong.

    Examples
    --------
    >>> import sympy as sm
    >>> m, g, L, T = sm.symbols("m g L T")
    >>> check_dimensions(T - m * g * L - m * g, {m: "kg", g: "m/s^2", L: "m", T: "N m"})
    equation 1: -g*m does not go with the others [kg m s^-2]
    """
    known = _of_symbols(units) if isinstance(units, Mapping) else system_dimensions(units)
    known[dynamicsymbols._t] = dimension_of_unit("s")
    found: list[Term] = []
    for number, equation in enumerate(_expressions(equations), start=1):
        strange = {s for s in _symbols(equation) if s not in known}
        if strange:
            names = ", ".join(sorted(map(short, strange)))
            raise EngdynError(f"equation {number} holds {names} without a unit: give one for each symbol")
        found += _terms(number, equation, known)
    return DimensionCheck(tuple(found))


def _terms(number: int, equation: sm.Expr, known: dict[sm.Expr, Dimension]) -> list[Term]:
    units: dict[sm.Expr, Dimension | str] = {}
    for term in sorted(sm.Add.make_args(equation), key=sm.default_sort_key):
        try:
            units[term] = dimension_of(term, known)
        except DimensionMismatch as error:
            units[term] = str(error)
    votes = Counter(unit for unit in units.values() if not isinstance(unit, str)).most_common(2)
    clear = len(votes) == 1 or (len(votes) == 2 and votes[0][1] > votes[1][1])
    return [
        Term(number, term, "", False, unit)
        if isinstance(unit, str)
        else Term(number, term, unit_text(unit), unit == votes[0][0] if clear else None)
        for term, unit in units.items()
    ]


def _expressions(given: Any) -> list[sm.Expr]:
    """What is zero: M u̇ − f, or left minus right side."""
    if hasattr(given, "mass_matrix"):
        rates = sm.Matrix([u.diff(dynamicsymbols._t) for u in given.speeds])
        return list(given.mass_matrix * rates - given.forcing)
    rows = list(given) if isinstance(given, list | tuple | sm.MatrixBase) else [given]
    return [
        row.lhs - row.rhs if isinstance(row, sm.Equality) else as_expression(row, "an equation")
        for row in rows
    ]


def _of_symbols(units: Mapping[Any, str]) -> dict[sm.Expr, Dimension]:
    return {
        key: value
        for symbol, unit in units.items()
        for key, value in _with_rates(symbol, dimension_of_unit(unit)).items()
    }


def _symbols(expr: sm.Expr) -> set[sm.Expr]:
    moving = expr.atoms(AppliedUndef, sm.Derivative)
    return expr.free_symbols | moving
