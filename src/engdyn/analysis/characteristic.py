"""Characteristic polynomials of small motion, exact where the data are.  Course sections 5.3 to 5.5."""

from __future__ import annotations

import math
from dataclasses import replace
from fractions import Fraction
from typing import Any

import sympy as sm
from sympy.physics.vector import dynamicsymbols
from sympy.polys.matrices import DomainMatrix

from engdyn.algebra.ring import Element
from engdyn.analysis.exact_sample import AT_ZERO
from engdyn.analysis.linear import LinearSystem
from engdyn.analysis.neutral import neutral_eigenvalues
from engdyn.analysis.residuals import residuals, size
from engdyn.analysis.routh import exact
from engdyn.analysis.slopes import Products
from engdyn.analysis.small_motion import motion_keys, small_motion
from engdyn.errors import EngdynError
from engdyn.modeling.numbers import input_values, parameter_values

__all__ = ["characteristic_polynomial"]

S = sm.Dummy("s")  # a parameter may be called s, too


def characteristic_polynomial(linear: LinearSystem, parameter: str | None = None) -> tuple[sm.Expr, ...]:
    """Coefficients of det(λI − A), highest power first.

    Parameters
    ----------
    linear : LinearSystem
        With numbers, or with symbols (``linearize(..., symbolic=True)``).
    parameter : str, optional
        A parameter that stays a symbol while all others have their numbers, for :func:`routh_limits`.

    Returns
    -------
    tuple of sympy.Expr
        Rational numbers, the first of them 1, where `linear` has numbers: parameters and coordinates enter as the
        rationals of their shortest decimals, and what is zero identically is zero. With symbols the coefficients
        are polynomials, the first of them det M up to a common factor.

    Raises
    ------
    EngdynError
        An unknown parameter; an equilibrium that moves with it; a parameter inside a root or a function.

    Notes
    -----
    Course sections 5.3 to 5.5.  With a parameter left open, the polynomial is that of one fixed state. Where the
    equilibrium moves with the parameter and small motion depends on where it is, this is refused.
    """
    if not isinstance(linear, LinearSystem):
        raise EngdynError(
            f"characteristic_polynomial needs a LinearSystem, not {linear!r}: call linearize first"
        )
    if isinstance(linear.mass, sm.MatrixBase):
        if parameter is not None:
            raise EngdynError(
                "linear has symbols for all parameters already: substitute numbers for the others"
            )
        return _with_symbols(linear)
    symbols = {p.name: p for p in linear.eom.parameters}
    if parameter is not None and parameter not in symbols:
        raise EngdynError(f"unknown parameter {parameter!r}: the equations have {', '.join(symbols)}")
    kept = None if parameter is None else symbols[parameter]
    found = _Values(linear, kept).polynomial()
    if kept is not None and _moves(linear, parameter):
        shifted = replace(linear, at=replace(linear.at, q=linear.at.q + 1e-3))
        if _Values(shifted, kept).polynomial() != found:
            raise EngdynError(
                f"the equilibrium moves with {parameter}, and small motion depends on where it is: follow it with "
                "continue_equilibria or stability_map"
            )
    neutral = neutral_eigenvalues(linear)
    return (*found[: len(found) - neutral], *([sm.S.Zero] * neutral))


def _moves(linear: LinearSystem, parameter: str) -> bool:
    """Whether the state is no equilibrium at other values of a parameter."""
    at = linear.at
    others = [(at.values[parameter] or 1.0) * share for share in (0.5, 2.0)]
    changed = [replace(at, values={**at.values, parameter: other}) for other in others]
    return not all(_Values(replace(linear, at=at), None).balanced() for at in changed)


def _determinant(blocks: dict[str, sm.Matrix]) -> tuple[sm.Expr, ...]:
    """Coefficients of det [[sI − Gq, −G], [K, sM + C]], a common factor left out."""
    n = blocks["Gq"].shape[0]
    upper = (S * sm.eye(n) - blocks["Gq"]).row_join(-blocks["G"])
    lower = blocks["K"].row_join(S * blocks["M"] + blocks["C"])
    matrix = DomainMatrix.from_Matrix(upper.col_join(lower))
    size = matrix.shape[0]
    determinant = matrix.domain.to_sympy(matrix.charpoly()[-1]) * (-1) ** size
    above = sm.fraction(sm.cancel(determinant))[0]
    p = sm.Poly(above, S)
    coefficients = p.primitive()[1].all_coeffs()
    if len(coefficients) != size + 1:
        raise EngdynError(
            "singular mass matrix: the characteristic polynomial has a lower degree than the state"
        )
    return tuple(sm.factor(c) for c in coefficients)


def _with_symbols(linear: LinearSystem) -> tuple[sm.Expr, ...]:
    n = linear.stiffness.shape[1]
    blocks = {"M": linear.mass, "C": linear.damping, "K": linear.stiffness}
    blocks |= {"Gq": linear.state_matrix[:n, :n], "G": linear.state_matrix[:n, n:]}
    return _determinant({name: block.applyfunc(exact) for name, block in blocks.items()})


class _Values:
    """Exact values of ring elements at the state of a linear system, one parameter possibly left open."""

    def __init__(self, linear: LinearSystem, kept: sm.Symbol | None):
        eom, at = linear.eom, linear.at
        self._eom, self._ring, self._kept = eom, eom.ring, kept
        self.field = sm.QQ if kept is None else sm.QQ.frac_field(kept)
        self._known: dict[int, Any] = {}
        q_keys, u_keys, a_keys = motion_keys(eom)
        state = [float(x) for x in (*at.q, *at.speeds, *at.accelerations)]
        self._given = dict(zip([*q_keys, *u_keys, *a_keys], state, strict=True))
        numbers = parameter_values(eom, at.values)
        by_symbol = dict(zip(eom.parameters, numbers, strict=True)) | ({kept: kept} if kept else {})
        self._given |= {("symbol", p): x for p, x in by_symbol.items()}
        self._given |= {("symbol", dynamicsymbols._t): 0, ("symbol", sm.pi): math.pi}
        self._give_inputs(linear, by_symbol)

    def _give_inputs(self, linear: LinearSystem, by_symbol: dict[sm.Symbol, Any]) -> None:
        """Inputs as given, or as their defaults say, which may hold the open parameter."""
        eom, at = linear.eom, linear.at
        numbers = iter(input_values(eom, at.inputs, at.values))
        replaced = {p: exact(x) for p, x in by_symbol.items()} | {dynamicsymbols._t: sm.S.Zero}
        for w in eom.inputs:
            default = None if w.func.__name__ in at.inputs else eom.defaults.get(w)
            for k in (0, 1, 2):
                x = next(numbers)
                self._given["function", w, k] = x if default is None else exact(default[k]).xreplace(replaced)

    def polynomial(self) -> tuple[sm.Expr, ...]:
        """The characteristic polynomial; monic where no parameter is open."""
        rows = small_motion(self._eom)
        blocks = {
            name: sm.Matrix([[self._sum(entry) for entry in row] for row in rows[name]])
            for name in ("M", "C", "K", "Gq", "G")
        }
        found = _determinant(blocks)
        return found if self._kept is not None else tuple(c / found[0] for c in found)

    def balanced(self) -> bool:
        """Whether the state is one of equilibrium, but for the rounding of its coordinates."""
        rows = residuals(self._eom, motion_keys(self._eom)[1], {})
        forces = [abs(_fraction(self._polynomial(row.numerator))) for row in rows]
        known = {i: _fraction(x) for i, x in self._known.items()}
        return all(force <= size(row, known) / 10**9 for force, row in zip(forces, rows, strict=True))

    def _sum(self, products: Products) -> sm.Expr:
        total = sum((math.prod(map(self.value, product)) for product in products), self.field.zero)
        return self.field.to_sympy(total)

    def value(self, element: Element) -> Any:
        """An element in the field of rational numbers, or of quotients of polynomials in the open parameter."""
        below = self.field.one if element.denominator is None else self._polynomial(element.denominator)
        if not below:
            raise EngdynError(
                "a denominator vanishes there: the linearized equations do not exist at this state"
            )
        return self._polynomial(element.numerator) / below

    def _polynomial(self, p: Any) -> Any:
        total = self.field.zero
        for exponents, coefficient in self._ring.polynomials.sparse(p):
            term = self.field.from_sympy(sm.Rational(coefficient))
            for i, e in exponents:
                term = term * self._generator(i) ** e
            total = total + term
        return total

    def _generator(self, index: int) -> Any:
        if index not in self._known:
            key, definition = self._ring.keys[index], self._ring.definitions.get(index)
            if definition is None:
                self._known[index] = self.field.from_sympy(exact(self._given[key]))
            elif definition.kind in ("sine", "cosine"):
                self._on_circle(key)
            else:
                self._known[index] = self._call(key, definition)
        return self._known[index]

    def _number(self, element: Element, what: str) -> sm.Rational:
        """The value of an argument, which must not hold the open parameter."""
        x = self.field.to_sympy(self.value(element))
        if x.free_symbols:
            raise EngdynError(f"{self._kept} occurs in {what}: the polynomial is no polynomial in it")
        return x

    def _call(self, key: tuple[Any, ...], definition: Any) -> Any:
        """A root, a magnitude or a function, as the rational of its shortest decimal where it is no rational."""
        inside = [self._number(a, f"the {definition.kind} {key[1]}") for a in definition.arguments]
        function = {"root": sm.sqrt, "magnitude": sm.Abs}.get(definition.kind) or key[1].func
        if inside == [0] and function in AT_ZERO:
            return self.field.from_sympy(sm.Integer(AT_ZERO[function]))
        value = function(*inside)
        return self.field.from_sympy(value if value.is_Rational else exact(float(value)))

    def _on_circle(self, key: tuple[Any, ...]) -> None:
        """Sine and cosine: exactly on the unit circle, and exact for quarter turns."""
        sine, cosine = self._ring.index["sine", *key[1:]], self._ring.index["cosine", *key[1:]]
        angle = float(self._number(self._ring.definitions[sine].arguments[0], f"the angle {key[1]}"))
        quarters = round(angle / (math.pi / 2))
        if abs(angle - quarters * math.pi / 2) < 1e-9:
            pair = [(0, 1), (1, 0), (0, -1), (-1, 0)][quarters % 4]
        else:
            half = exact(math.tan(math.remainder(angle, 2 * math.pi) / 2))
            pair = 2 * half / (1 + half**2), (1 - half**2) / (1 + half**2)
        for index, x in zip((sine, cosine), pair, strict=True):
            self._known[index] = self.field.from_sympy(sm.Rational(x))


def _fraction(x: Any) -> Fraction:
    return Fraction(int(x.numerator), int(x.denominator))
