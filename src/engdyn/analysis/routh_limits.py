"""Where stability changes with a parameter: exact, from the coefficients of the characteristic polynomial.

Roots reach the imaginary axis at zero, where the last coefficient vanishes, or in pairs, where the last but one of
Hurwitz' determinants does (L. Orlando, Mathematische Annalen 71, 1911), which is the resultant of even and odd part.
Without damping all roots lie symmetric about the origin: pairs meet where a discriminant vanishes. Course section 5.4.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise
from typing import Any

import sympy as sm

from engdyn.analysis.half_plane import X, parts, right_half_plane, squared, symmetric_part
from engdyn.analysis.routh import exact_coefficients
from engdyn.errors import EngdynError

__all__ = ["StabilityLimit", "routh_limits"]

S = sm.Dummy("s")  # a parameter may be called s, too
Source = str | tuple[sm.Poly, sm.Poly]
Root = tuple[sm.Rational, sm.Rational, list[Source]]
DIGITS = 40
"""Decimal digits to which the limits are enclosed before they become floats."""


class StabilityLimit(float):
    """A value of a parameter at which the number of roots in the right half plane changes.

    A float with attributes.

    Attributes
    ----------
    kind : {"divergence", "flutter", "leading coefficient"}
        A root passes through zero, a pair through the imaginary axis, or one through infinity.
    frequency : float
        Of the pair on the imaginary axis [Hz]; 0 for divergence, infinite where the leading coefficient vanishes.
    before, after : int
        Number of roots in the right half plane below and above the value.
    """

    kind: str
    frequency: float
    before: int
    after: int

    def __new__(cls, value: float, kind: str, frequency: float, before: int, after: int) -> StabilityLimit:
        """A float that knows what happens there."""
        found = super().__new__(cls, value)
        found.kind, found.frequency, found.before, found.after = kind, frequency, before, after
        return found

    def __repr__(self) -> str:
        at = f" at {self.frequency:.5g} Hz" if self.kind == "flutter" else ""
        return f"{float(self):.5g} ({self.kind}{at}; unstable roots {self.before} → {self.after})"


def routh_limits(
    coefficients: Sequence[Any], symbol: sm.Symbol | str, interval: tuple[float, float] | None = None
) -> tuple[StabilityLimit, ...]:
    """Parameter values at which the number of roots in the right half plane changes.

    Parameters
    ----------
    coefficients : sequence of number or sympy.Expr
        Of the polynomial, highest power first; quotients of polynomials in one symbol with rational numbers.
        Trailing coefficients that are zero identically (neutral eigenvalues) are set apart.
    symbol : sympy.Symbol or str
        The parameter.
    interval : (float, float), optional
        Which values are asked for; all real ones by default, the positive ones of a positive symbol.

    Returns
    -------
    tuple of StabilityLimit
        Rising floats, right to the last digit but one.

    Raises
    ------
    EngdynError
        Other symbols, a symbol that does not occur, an empty interval.

    Notes
    -----
    Course section 5.4. The coefficients must belong to one equilibrium for all values of the parameter;
    :func:`characteristic_polynomial` sees to that.

    Examples
    --------
    >>> K = sm.Symbol("K")
    >>> routh_limits([1, 6, 11, K + 6], K)
    (-6 (divergence; unstable roots 1 → 0), 60 (flutter at 0.52786 Hz; unstable roots 0 → 2))
    """
    given, parameter = _checked(coefficients, symbol)
    low, high = _interval(interval, parameter)
    field = sm.QQ.frac_field(parameter)
    p = sm.Poly.from_list([field.from_sympy(c) for c in given], S, domain=field)
    roots = _sorted_roots(_sources(p), parameter)
    if not roots:
        return ()
    between = [(b[0] + a[1]) / 2 for a, b in pairwise(roots)]
    places = [roots[0][0] - 1, *between, roots[-1][1] + 1]
    counts = [right_half_plane(_at(p.clear_denoms(convert=True)[1], at)) for at in places]
    found = []
    for (below, above, sources), (before, after) in zip(roots, pairwise(counts), strict=True):
        value = (below + above) / 2
        if before != after and low <= float(value) <= high:
            found.append(StabilityLimit(float(value), *_named(sources, value), before, after))
    return tuple(found)


def _checked(coefficients: Sequence[Any], symbol: sm.Symbol | str) -> tuple[list[sm.Expr], sm.Symbol]:
    """Exact coefficients in the parameter alone, without those at the end that are zero identically."""
    given = list(exact_coefficients(coefficients))
    while sm.cancel(given[-1]) == 0:
        given.pop()
    found = sorted({x for c in given for x in c.free_symbols}, key=str)
    name = symbol if isinstance(symbol, str) else getattr(symbol, "name", None)
    if [x.name for x in found] != [name]:
        names = ", ".join(map(str, found)) or "no symbols"
        raise EngdynError(f"the coefficients contain {names}: they must contain {symbol} and nothing else")
    return given, found[0]


def _interval(interval: tuple[float, float] | None, parameter: sm.Symbol) -> tuple[float, float]:
    if interval is None:
        return (0.0 if parameter.is_nonnegative else -math.inf), math.inf
    try:
        low, high = (float(x) for x in interval)
    except (TypeError, ValueError) as error:
        raise EngdynError(f"interval is {interval!r}: give (lower, upper)") from error
    if not low < high:
        raise EngdynError(f"interval = ({low:g}, {high:g}): the lower end comes first")
    return low, high


def _sources(p: sm.Poly) -> list[tuple[sm.Poly, Source]]:
    """What has to vanish for a root to reach the imaginary axis, and why."""
    whole, (g, h) = p.clear_denoms(convert=True)[1], symmetric_part(p)
    mirrored = g.clear_denoms(convert=True)[1]
    rest = [squared(part) for part in parts(whole.exquo(mirrored))]
    simple = squared(g).sqf_part().clear_denoms(convert=True)[1]
    pairs = [(rest[0], rest[1])] if h.degree() > 0 else []
    pairs += [(simple, simple.diff(X))] if simple.degree() > 1 else []
    found: list[tuple[Any, Source]] = [(a.resultant(b), (a, b)) for a, b in pairs]
    return [*found, (whole.TC(), "divergence"), (whole.LC(), "leading coefficient")]


def _sorted_roots(sources: list[tuple[Any, Source]], parameter: sm.Symbol) -> list[Root]:
    """Real roots of all sources as narrow rational intervals, each once with all of its sources."""
    by_factor: dict[sm.Poly, list[Source]] = {}
    for f, source in sources:
        for factor, _ in sm.Poly(f, parameter, domain=sm.QQ).factor_list()[1]:
            by_factor.setdefault(factor, []).append(source)
    found = []
    for factor, why in by_factor.items():
        for (a, b), _ in factor.intervals():
            size = max(abs(a), abs(b), sm.Rational(1, 10**9))
            found.append((*factor.refine_root(a, b, eps=size / 10**DIGITS), why))
    return sorted(found, key=lambda root: root[0])


def _at(p: sm.Poly, value: sm.Rational) -> sm.Poly:
    """A polynomial with a number for the parameter."""
    (parameter,) = p.domain.symbols
    return sm.Poly(p.as_expr().subs(parameter, value), *p.gens, domain=sm.QQ)


def _named(sources: list[Source], value: sm.Rational) -> tuple[str, float]:
    """Kind and frequency [Hz] of what happens at a limit."""
    for source in sources:
        if not isinstance(source, str):
            square = _common_root(*(_at(part, value) for part in source))
            if square is not None and square < 0:
                return "flutter", math.sqrt(-square) / (2 * math.pi)
    kind = next((source for source in sources if isinstance(source, str)), "divergence")
    return kind, 0.0 if kind == "divergence" else math.inf


def _common_root(a: sm.Poly, b: sm.Poly) -> float | None:
    """The real x = s² at which both polynomials vanish but for the width of the enclosures."""
    places = [x for p in (a, b) if p.degree() > 0 for x in p.nroots(n=30, maxsteps=500)]
    real = [sm.re(x) for x in places if abs(sm.im(x)) <= abs(x) * sm.Float("1e-9")]
    near = [x for x in real if max(_share(a, x), _share(b, x)) < sm.Float("1e-12")]
    return float(max(near)) if near else None


def _share(p: sm.Poly, x: sm.Float) -> sm.Float:
    """A polynomial's value as a share of its terms' magnitudes."""
    largest = sum(abs(c) * abs(x) ** m for (m,), c in p.terms())
    return abs(p.eval(x)) / largest if largest else sm.S.Zero
