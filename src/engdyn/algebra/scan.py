"""First pass over sympy expressions: which generators does their ring need?

The generators of a ring are fixed when it is made, so expressions are read twice: here to collect
what occurs in them, and in :mod:`engdyn.algebra.conversion` to translate them.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from fractions import Fraction
from math import lcm
from typing import Any

import sympy as sm
from sympy.core.function import AppliedUndef, ArgumentIndexError
from sympy.physics.vector import dynamicsymbols

from engdyn.errors import EngdynError, OutsideRingError

__all__ = [
    "Scan",
    "angle_terms",
    "as_fraction",
    "derivative_key",
    "exact_phase",
    "half_power",
    "independent_atoms",
    "is_opaque",
    "key_to_sympy",
]

Key = tuple[Any, ...]

#: Functions written with sines and cosines before anything else is done with them.
RECIPROCAL = {
    sm.tan: lambda x: sm.sin(x) / sm.cos(x),
    sm.cot: lambda x: sm.cos(x) / sm.sin(x),
    sm.sec: lambda x: 1 / sm.cos(x),
    sm.csc: lambda x: 1 / sm.sin(x),
}


def as_fraction(number: sm.Expr) -> Fraction:
    """A sympy number as a fraction; a float as the rational of its shortest decimal."""
    if isinstance(number, sm.Rational):
        return Fraction(int(number.p), int(number.q))
    if number.is_finite and number._prec > 53:
        return Fraction(str(number))  # a float of more digits than Python's: all of them count
    value = float(number)
    if value != value or value in (float("inf"), float("-inf")):
        raise OutsideRingError(f"{number} is not a finite number")
    return Fraction(repr(value))


def derivative_key(expr: sm.Expr) -> Key | None:
    """Key of a dynamicsymbol or of one of its time derivatives, None for anything else."""
    t = dynamicsymbols._t
    if isinstance(expr, AppliedUndef) and expr.args == (t,):
        return ("function", expr, 0)
    if isinstance(expr, sm.Derivative) and isinstance(expr.expr, AppliedUndef) and expr.expr.args == (t,):
        if len(expr.variable_count) == 1 and expr.variable_count[0][0] == t:
            return ("function", expr.expr, int(expr.variable_count[0][1]))
    return None


def key_to_sympy(key: Key) -> sm.Expr:
    """The sympy expression that an independent generator stands for."""
    if key[0] != "function":
        return key[1]
    _, function, order = key
    if order == 0:
        return function
    # the canonical form is known: letting sympy differentiate takes a hundred times as long
    return sm.Expr.__new__(sm.Derivative, function, sm.Tuple(function.args[0], sm.Integer(order)))


def half_power(expr: sm.Expr) -> bool:
    """Whether an expression is an odd multiple of a square root, such as ``x**(-3/2)``."""
    return isinstance(expr, sm.Pow) and isinstance(expr.exp, sm.Rational) and expr.exp.q == 2


def is_opaque(expr: sm.Expr) -> bool:
    """Whether an expression stands for itself: nothing is known of its derivatives."""
    return not (isinstance(expr, sm.Function) and all(isinstance(a, sm.Expr) for a in expr.args))


def independent_atoms(expr: sm.Basic) -> list[sm.Expr]:
    """Symbols, dynamicsymbols and their derivatives that an expression is made of."""
    if isinstance(expr, sm.Symbol) or derivative_key(expr) is not None:
        return [expr]
    found: dict[sm.Expr, None] = {}
    for argument in expr.args:
        found |= dict.fromkeys(independent_atoms(argument))
    return list(found)


#: Multiples and parts of a base angle up to this size are expanded by angle addition.
SIMPLE = 24


def angle_terms(angle: sm.Expr) -> list[tuple[sm.Expr, Fraction]]:
    """An angle as a sum of rational multiples of base angles.

    Returns
    -------
    list of (base, factor)
        ``2*theta - phi/3`` gives ``[(theta, 2), (phi, -1/3)]``; a number gives base 1.  A factor
        that is not a simple fraction (1.2345) stays with its base: expanding it would be endless.
    """
    if isinstance(angle, sm.Symbol | AppliedUndef):
        return [(angle, Fraction(1))]
    if any(a.is_Add or (a.is_Pow and a.base.is_Add) for term in sm.Add.make_args(angle) for a in term.args):
        angle = sm.expand(angle)
    factors: dict[sm.Expr, Fraction] = {}
    for term in sm.Add.make_args(angle):
        coefficient, base = term.as_coeff_Mul()
        factors[base] = factors.get(base, Fraction(0)) + as_fraction(coefficient)
    found = []
    for base, factor in factors.items():
        if factor and max(abs(factor.numerator), factor.denominator) > SIMPLE:
            size = abs(factor)
            found.append((sm.Rational(size.numerator, size.denominator) * base, factor / size))
        elif factor:
            found.append((base, factor))
    return found


def exact_phase(factor: Fraction) -> tuple[sm.Expr, sm.Expr] | None:
    """Cosine and sine of factor·π where they are made of square roots, None elsewhere."""
    phase = sm.Rational(factor.numerator, factor.denominator) * sm.pi
    pair = sm.cos(phase), sm.sin(phase)
    return None if any(value.has(sm.cos, sm.sin) for value in pair) else pair


class Scan:
    """Collects the generators that a set of expressions needs.

    Attributes
    ----------
    plain : dict
        Keys of independent generators in the order of their appearance.
    divisors : dict
        Base angle → common denominator of the multiples that occur.
    dependent : dict
        Keys of roots, magnitudes and calls, inner ones first.
    """

    def __init__(self, substitutions: dict[Key, sm.Expr] | None = None):
        self.plain: dict[Key, None] = {}
        self.divisors: dict[sm.Expr, int] = {}
        self.dependent: dict[Key, None] = {}
        self._substitutions = substitutions or {}
        self._seen: set[sm.Basic] = set()

    def read(self, expressions: Iterable[sm.Expr]) -> None:
        """Collect the generators of each expression."""
        for expression in expressions:
            self._visit(expression)

    def keys(self, first: Sequence[Key] = (), last: Sequence[Key] = ()) -> list[Key]:
        """All keys in ring order: dependent ones (outer first), sines, cosines, the plain ones by name."""
        angles = sorted(self.divisors.items(), key=lambda angle: _name(angle[0]))
        given = {*first, *last}
        return [
            *reversed(self.dependent),
            *(("sine", *angle) for angle in angles),
            *(("cosine", *angle) for angle in angles),
            *first,
            *sorted((key for key in self.plain if key not in given), key=lambda key: (key[0], _name(key[1]))),
            *last,
        ]

    def prescribed(self, own: set[sm.Expr]) -> list[Key]:
        """Keys of all dynamicsymbols met so far that are not `own`, and of their first two derivatives."""
        functions = {key[1] for key in self.plain if key[0] == "function"} - own
        return [("function", f, k) for f in sorted(functions, key=_name) for k in (0, 1, 2)]

    def _visit(self, expr: sm.Basic) -> None:
        if expr in self._seen:
            return
        self._seen.add(expr)
        key = derivative_key(expr) if isinstance(expr, AppliedUndef | sm.Derivative) else None
        if key is not None:
            self._visit_function(key)
        elif isinstance(expr, sm.Symbol):
            self.plain.setdefault(("symbol", expr))
        elif expr.is_Number or expr is sm.S.Pi:
            self._visit_number(expr)
        elif isinstance(expr, sm.Add | sm.Mul):
            self.read(expr.args)
        elif isinstance(expr, sm.Pow) and isinstance(expr.exp, sm.Integer):
            self._visit(expr.base)
        elif isinstance(expr, sm.sin | sm.cos):
            self._visit_angle(expr.args[0])
        elif type(expr) in RECIPROCAL:
            self._visit_angle(expr.args[0])
        elif isinstance(expr, sm.Derivative):
            self._visit_derivative(expr)
        else:
            self._visit_dependent(expr)

    def _visit_function(self, key: Key) -> None:
        if key in self._substitutions:
            self._visit(self._substitutions[key])
        else:
            self.plain.setdefault(key)

    def _visit_number(self, expr: sm.Expr) -> None:
        if expr is sm.S.Pi:
            self.plain.setdefault(("symbol", expr))
        elif not expr.is_finite:
            raise OutsideRingError(f"an expression contains {expr}: it has no finite value")

    def _visit_angle(self, angle: sm.Expr) -> None:
        for base, factor in angle_terms(angle):
            exact = exact_phase(factor) if base is sm.S.Pi else None
            if exact is not None:
                self.read(exact)
                continue
            self.divisors[base] = lcm(self.divisors.get(base, 1), factor.denominator)
            self._visit(base)

    def _visit_derivative(self, expr: sm.Derivative) -> None:
        done = expr.doit()
        if isinstance(done, sm.Derivative):
            raise OutsideRingError(f"the derivative {expr} has no closed form")
        self._visit(done)

    def _visit_dependent(self, expr: sm.Basic) -> None:
        if not isinstance(expr, sm.Expr):
            raise EngdynError(
                f"{expr!r} is a {type(expr).__name__}, not a scalar expression: give one equation term"
            )
        if expr.is_commutative is False or expr is sm.I or (not expr.is_finite and expr.is_Atom):
            raise OutsideRingError(f"{expr} is not a real, finite quantity")
        if half_power(expr):
            self._visit(expr.base)
            self.dependent.setdefault(("root", expr.base))
            self.dependent.setdefault(("denominator", expr.base))
        elif isinstance(expr, sm.Abs | sm.sign):
            self._visit(expr.args[0])
            self.dependent.setdefault(("magnitude", expr.args[0]))
        elif isinstance(expr, sm.Pow):
            self.read([expr.base, expr.exp])
            self.dependent.setdefault(("call", expr))
        elif is_opaque(expr):
            self.read(independent_atoms(expr))
            self.dependent.setdefault(("call", expr))
        else:
            self._visit_call(expr)

    def _visit_call(self, expr: sm.Expr) -> None:
        self.read(expr.args)
        self.dependent.setdefault(("call", expr))
        for slope in slopes(expr):
            if slope is not None:
                self._visit(slope)


def _name(expr: sm.Expr) -> str:
    if isinstance(expr, sm.Symbol):
        return expr.name
    return expr.func.__name__ if isinstance(expr, AppliedUndef) else str(expr)


def slopes(expr: sm.Expr) -> list[sm.Expr | None]:
    """Partial derivatives of a function with respect to its arguments, None where unknown."""
    found: list[sm.Expr | None] = []
    dummies = [sm.Dummy(f"x{i}", real=True) for i in range(len(expr.args))]
    for i in range(1, len(expr.args) + 1):
        try:
            slope = expr.func(*dummies).fdiff(i)
        except (ArgumentIndexError, AttributeError, NotImplementedError, TypeError, ValueError):
            slope = None
        unknown = slope is None or slope.has(sm.Derivative, sm.Subs, sm.DiracDelta, sm.oo, sm.zoo, sm.nan)
        found.append(None if unknown else slope.xreplace(dict(zip(dummies, expr.args, strict=True))))
    return found
