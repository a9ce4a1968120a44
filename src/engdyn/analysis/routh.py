"""Routh's criterion: stability from the coefficients of a polynomial, exact, with all its special cases.

E. J. Routh, *A Treatise on the Stability of a Given State of Motion*, Macmillan, 1877; the special cases as in
F. R. Gantmacher, *The Theory of Matrices*, Chelsea, 1959, volume 2, chapter XV. Course section 5.4.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence, Set
from dataclasses import dataclass
from itertools import accumulate, repeat
from operator import mul
from typing import Any

import sympy as sm

from engdyn.algebra.expressions import as_expression
from engdyn.algebra.scan import as_fraction
from engdyn.analysis.half_plane import parts, right_half_plane, sign_changes, symmetric_part
from engdyn.analysis.routh_html import entry_text, superscripts, table
from engdyn.errors import EngdynError

__all__ = ["RouthTable", "exact", "exact_coefficients", "routh_table"]

S, EPSILON = sm.Dummy("s"), sm.Symbol("epsilon")  # a coefficient may hold an s of its own

Row = list[Any]


@dataclass(frozen=True, eq=False, repr=False)
class RouthTable:
    """Routh's table of a polynomial a₀ sⁿ + … + aₙ.

    Attributes
    ----------
    coefficients : tuple of sympy.Expr
        Highest power first, exact, all with the opposite sign where the first was negative.
    rows : tuple of tuple of sympy.Expr
        The rows of sⁿ to s⁰, equally long. Where a row was zero, what continues the table in its place; ``epsilon``
        stands for a positive number as small as one likes.
    first_column : tuple of sympy.Expr
    marks : tuple of str
        For each row ``""``, ``"epsilon"`` (its first entry was zero) or ``"auxiliary"`` (it was zero).
    sign_changes : int or None
        In the first column; None where symbols leave it open.
    right_half_plane : int or None
        Number of roots with positive real part, counted by a second exact method.
    special : str
        What is special about the table, in words; empty where nothing is.
    conditions : tuple of sympy.Expr
        What must be positive, the leading coefficient included, for all roots to have negative real parts; what is
        positive anyway is left out. A zero or negative number among them can never be positive.
    """

    coefficients: tuple[sm.Expr, ...]
    rows: tuple[tuple[sm.Expr, ...], ...]
    marks: tuple[str, ...]
    sign_changes: int | None
    right_half_plane: int | None
    special: str
    conditions: tuple[sm.Expr, ...]

    @property
    def first_column(self) -> tuple[sm.Expr, ...]:
        """First entries of all rows."""
        return tuple(row[0] for row in self.rows)

    @property
    def verdict(self) -> str:
        """What the table says, in words."""
        if self.right_half_plane is None:
            if any(c.is_nonpositive for c in self.conditions):
                return "never asymptotically stable"
            count = len(self.conditions)
            some = f"where {count} condition{'s' * (count > 1)} hold{'s' * (count == 1)}"
            return f"stable {some if count else 'whatever the symbols are'}"
        count = self.right_half_plane
        if count:
            return f"unstable: {count} root{'s' * (count > 1)} in the right half plane"
        return "marginal: roots on the imaginary axis" if self.conditions else "stable"

    def __repr__(self) -> str:
        column = ", ".join(entry_text(x) for x in self.first_column)
        return f"RouthTable({self.verdict}; first column {column})"

    def _repr_html_(self) -> str:
        return table(self)


MOST_LETTERS = 6
"""A polynomial of a higher degree with more symbols than these fills pages."""


def routh_table(coefficients: Sequence[Any]) -> RouthTable:
    """Set up Routh's table of a polynomial.

    Parameters
    ----------
    coefficients : sequence of number or sympy.Expr
        From the highest power down. Floats are the rationals of their shortest decimals; symbols are allowed.

    Returns
    -------
    RouthTable

    Raises
    ------
    EngdynError
        No coefficients, a leading zero, something that is neither a rational number nor an expression in symbols,
        a symbol named epsilon, more than six symbols in a polynomial of a degree above six.

    Notes
    -----
    Course section 5.4. A zero first entry in a row that is not zero becomes ε > 0. A zero row means roots symmetric
    about the origin; they are the roots of the auxiliary polynomial (the row above), whose derivative takes the place
    of the row. Where both occur, ε times the auxiliary polynomial is added to the row, so that the symmetric
    roots stay where they are.

    Examples
    --------
    >>> routh_table([1, 1, 2, 2, 3]).right_half_plane
    2
    >>> a = sm.symbols("a_0:4", positive=True)
    >>> routh_table(a).conditions
    (-a_0*a_3 + a_1*a_2,)
    """
    given = exact_coefficients(coefficients)
    if given[0].is_negative:
        given = tuple(-c for c in given)
    symbols = sorted({x for c in given for x in c.free_symbols}, key=str)
    if any(x.name == EPSILON.name for x in symbols):
        raise EngdynError(
            "the coefficients hold a symbol epsilon, the table's name of a small positive number: rename it"
        )
    if len(given) > MOST_LETTERS + 1 and len(symbols) > MOST_LETTERS:
        raise EngdynError(
            f"with {len(symbols)} symbols in a polynomial of degree {len(given) - 1} the entries of the table would "
            "have thousands of terms: give numbers for some of them"
        )
    field = sm.QQ.frac_field(*symbols, EPSILON)
    p = sm.Poly.from_list([field.from_sympy(c) for c in given], S, domain=field)
    if symbols:
        marks, chain = _chain(p, 1)
        rows, signs, count = _rows(chain), None, None
    else:
        count = right_half_plane(sm.Poly.from_list(given, S, domain=sm.QQ))
        for power in accumulate(repeat(2), mul, initial=1):
            # A later ε has to be smaller than what an earlier one has left behind; how much smaller, the count tells.
            marks, chain = _chain(p, power)
            rows = _rows(chain)
            signs = sign_changes([_sign(row[0]) for row in rows])
            if signs == count:
                break
    shown = tuple(tuple(_factored(field.to_sympy(x)) for x in row) for row in rows)
    special = " ".join(_explained(chain, marks))
    return RouthTable(given, shown, marks, signs, count, special, _conditions(shown, marks))


def exact(value: Any) -> sm.Expr:
    """A number or an expression with its floats replaced by the rationals of their shortest decimals."""
    expression = as_expression(value, "a coefficient")
    floats = expression.atoms(sm.Float)
    if any(not x.is_finite for x in expression.atoms(sm.Number)) or expression.has(sm.I, sm.nan, sm.zoo):
        raise EngdynError(f"the coefficient {value!r} is no real number: give finite real coefficients")
    return expression.xreplace({x: sm.Rational(as_fraction(x)) for x in floats})


def exact_coefficients(coefficients: Sequence[Any]) -> tuple[sm.Expr, ...]:
    """Coefficients, checked, as exact expressions."""
    if isinstance(coefficients, str | Mapping | Set) or not hasattr(coefficients, "__iter__"):
        raise EngdynError(f"coefficients is {coefficients!r}: give a sequence, highest power first")
    found = tuple(exact(c) for c in coefficients)
    if not found:
        raise EngdynError("coefficients is empty: give them from the highest power down")
    if sm.cancel(found[0]) == 0:
        raise EngdynError("the first coefficient is zero: begin with the highest power that is there")
    for c in found:
        rational = all(x.is_Symbol or x.is_Rational for x in c.atoms())
        if not (rational and all(x.exp.is_Integer for x in c.atoms(sm.Pow)) and not c.has(sm.Function)):
            raise EngdynError(
                f"the coefficient {c} is no rational number or quotient of polynomials in symbols"
            )
    return found


def _chain(p: sm.Poly, power: int) -> tuple[tuple[str, ...], list[sm.Poly]]:
    """The rows as polynomials: multiples of the auxiliary polynomial, then those that its derivative begins."""
    g, h = symmetric_part(p)
    field, epsilon = p.domain, p.domain.from_sympy(EPSILON)
    chain, marks, used = list(parts(h)), [""], 0
    for degree in range(h.degree() - 1, -1, -1):
        row = chain[-1]
        marks.append("")
        if row.degree() < degree:
            row = row + sm.Poly.from_dict({(degree,): epsilon**power**used}, S, domain=field)
            chain[-1], marks[-1], used = row, "epsilon", used + 1
        chain.append(chain[-2] - row * sm.Poly.from_list([chain[-2].LC() / row.LC(), 0], S, domain=field))
    chain = [row * g for row in chain[: h.degree() + 1]]
    if g.degree() == 0:
        return tuple(marks), chain
    last = chain[-1]
    rest_marks, rest = _chain(g + g.diff(S), power)
    scale = sm.Poly(field.to_sympy(last.LC()), S, domain=field)
    return (*marks, "auxiliary", *rest_marks[2:]), [*chain, *(row * scale for row in rest[1:])]


def _rows(chain: Sequence[sm.Poly]) -> list[Row]:
    """Every second coefficient of each polynomial, filled with zeros to equal length."""
    width = len(chain) // 2 + len(chain) % 2
    zero = chain[0].domain.zero
    entries = [row.rep.to_list()[::2] for row in chain]
    return [[*row, *[zero] * (width - len(row))] for row in entries]


def _factored(x: sm.Expr) -> sm.Expr:
    return sm.factor(x) if x.free_symbols else x


def _sign(x: Any) -> int:
    """Sign of a rational function of ε for small positive ε."""
    lowest = [min(part.terms())[1] for part in (x.numer, x.denom)]
    return 1 if lowest[0] * lowest[1] > 0 else -1


def _conditions(rows: Sequence[Sequence[sm.Expr]], marks: Sequence[str]) -> tuple[sm.Expr, ...]:
    """Entries of the first column without the factors that are positive by themselves or by other conditions."""
    found: list[sm.Expr] = []
    for row, mark in zip(rows, marks, strict=True):
        entry = sm.S.Zero if mark else row[0]
        if entry.has(EPSILON) or entry.is_positive:
            continue  # what comes after a zero changes nothing: zero is not positive
        above, below = sm.fraction(sm.together(entry))
        content, factors = sm.factor_list(above * below)
        condition = sm.sign(content)
        for factor, power in factors:
            if factor.is_negative or -factor in found:
                condition *= (-1) ** power
            elif not factor.is_positive and factor not in found:
                condition *= factor ** (2 - power % 2)
        if condition not in found and not condition.is_positive:
            found.append(_plus_first(condition))
    return tuple(found)


def _plus_first(condition: sm.Expr) -> sm.Expr:
    """−(a − b) as b − a."""
    sign, rest = condition.as_coeff_Mul()
    return sm.Add(*(sign * term for term in rest.args)) if rest.is_Add else condition


def _explained(chain: Sequence[sm.Poly], marks: Sequence[str]) -> Iterator[str]:
    """A few sentences on every special row."""
    for i, mark in enumerate(marks):
        power = superscripts(f"s**{len(marks) - 1 - i}")
        if mark == "epsilon":
            yield (
                f"The row of {power} began with zero without being zero: ε > 0, however small, takes its place, "
                "and signs are those for ε → 0. Such a polynomial is never asymptotically stable."
            )
        elif mark == "auxiliary":
            auxiliary = chain[i - 1].monic()
            coefficients = [auxiliary.domain.to_sympy(c) for c in auxiliary.rep.to_list()]
            yield (
                f"The row of {power} was zero: the row above holds the auxiliary polynomial "
                f"{superscripts(sm.Poly.from_list(coefficients, S).as_expr(sm.Symbol('s')))} but for a factor. "
                f"It divides the polynomial, and its roots lie symmetric about the origin{_located(coefficients)}. "
                "Its derivative takes the place of the row."
            )


def _located(coefficients: Sequence[sm.Expr]) -> str:
    """Where the roots of an auxiliary polynomial are, if it has numbers for coefficients."""
    if any(c.free_symbols for c in coefficients):
        return ""
    right = right_half_plane(sm.Poly.from_list(coefficients, S, domain=sm.QQ))
    zeros = next(k for k, c in enumerate(reversed(coefficients)) if c)
    imaginary = len(coefficients) - 1 - 2 * right - zeros
    counted = [(imaginary, "imaginary"), (zeros, "zero"), (right, "on the right and as many on the left")]
    return ": " + ", ".join(f"{count} {where}" for count, where in counted if count)
