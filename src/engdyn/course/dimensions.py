"""Units of formulas: the first test that every result has to pass.  Appendix C."""

from __future__ import annotations

from fractions import Fraction

import sympy as sm
from sympy.core.function import AppliedUndef
from sympy.physics.vector import dynamicsymbols

from engdyn.errors import EngdynError
from engdyn.system import System

__all__ = [
    "Dimension",
    "DimensionMismatch",
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


def system_dimensions(system: System) -> dict[sm.Expr, Dimension]:
    """Dimension of every symbol of a system, rates and accelerations included."""
    t = dynamicsymbols._t
    found = {p.symbol: dimension_of_unit(p.unit) for p in system.parameters}
    for moving in (*system.coordinates, *system.inputs):
        own = dimension_of_unit(moving.unit)
        for order in (0, 1, 2):
            symbol = moving.symbol.diff(t, order) if order else moving.symbol
            found[symbol] = (own[0], own[1], own[2] - order, *own[3:])
    return found


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
