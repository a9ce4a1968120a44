"""How many roots of a real polynomial have a positive real part, exactly and without computing them.

Two exact steps decide. Roots that lie symmetric about the origin are those of the greatest common divisor of
the even and the odd part; Sturm's theorem counts which of them are imaginary. The Cauchy index along the
imaginary axis counts the others (A. Hurwitz, Mathematische Annalen 46, 1895; F. R. Gantmacher, *The Theory of
Matrices*, Chelsea, 1959, volume 2, chapter XV). Course section 5.4.
"""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import sympy as sm

__all__ = ["parts", "right_half_plane", "sign_changes", "squared", "symmetric_part"]

X = sm.Dummy("x")


def parts(p: sm.Poly) -> tuple[sm.Poly, sm.Poly]:
    """The part of `p` whose powers are even or odd as its degree is, and the rest."""
    even = {m: c for m, c in _terms(p).items() if (m[0] - p.degree()) % 2 == 0}
    leading = sm.Poly.from_dict(even, *p.gens, domain=p.domain)
    return leading, p - leading


def symmetric_part(p: sm.Poly) -> tuple[sm.Poly, sm.Poly]:
    """The monic divisor g that holds all roots symmetric about the origin, and p/g."""
    leading, rest = parts(p)
    g = leading.monic() if rest.is_zero else leading.gcd(rest).monic()
    return g, p.exquo(g)


def squared(p: sm.Poly) -> sm.Poly:
    """An even or odd polynomial in s as a polynomial in x = s², a single factor s left out."""
    found = {(m[0] // 2,): c for m, c in _terms(p).items()}
    return sm.Poly.from_dict(found, X, domain=p.domain)


def right_half_plane(p: sm.Poly) -> int:
    """Number of roots with positive real part, each as often as it occurs.

    Parameters
    ----------
    p : sympy.Poly
        In one generator, with rational coefficients, not zero.
    """
    g, h = symmetric_part(p)
    mirrored = (g.degree() - _imaginary(g)) // 2
    return mirrored + (h.degree() - _cauchy_index(h)) // 2


def _imaginary(g: sm.Poly) -> int:
    """Number of roots on the imaginary axis, zero included, where all roots lie symmetric about the origin."""
    squares = [(int(factor.count_roots(None, 0)), count) for factor, count in squared(g).sqf_list()[1]]
    return 2 * sum(found * count for found, count in squares) + g.degree() % 2


def _cauchy_index(h: sm.Poly) -> int:
    """Roots in the left minus roots in the right half plane, where no two roots are opposite.

    On the axis s = jω, h/jⁿ = u − j v with real polynomials u, v in ω. Its argument turns by π for every root in the
    left half plane and by −π for every other one: the Cauchy index of v/u, which Sturm's chain counts.
    """
    chain = [_on_axis(part, h.degree()) for part in parts(h)]
    while not chain[-1].is_zero:
        chain.append(-chain[-2].rem(chain[-1]))
    ends = [(int(sm.sign(q.LC())), q.degree()) for q in chain[:-1]]
    return sign_changes([s * (-1) ** d for s, d in ends]) - sign_changes([s for s, _ in ends])


def _on_axis(part: sm.Poly, degree: int) -> sm.Poly:
    """``part(jω)/j^degree`` as a polynomial in ω, but for a factor −j where that is imaginary."""
    turned = {m: c * (-1) ** ((degree - m[0]) // 2) for m, c in _terms(part).items()}
    return sm.Poly.from_dict(turned, *part.gens, domain=part.domain)


def sign_changes(signs: list[int]) -> int:
    """How often neighbors differ in a list of signs without zeros."""
    return sum(a != b for a, b in pairwise(signs))


def _terms(p: sm.Poly) -> dict[tuple[int], Any]:
    """Coefficients, as elements of the domain, by exponents."""
    return p.rep.to_dict()
