"""Lagrange's equations under velocity constraints: projected, with the multipliers at hand.

With constraints A q̇ + b = 0 the n equations are M q̈ − f = Aᵀ λ.  On the motions q̇ = G u + g that the
constraints allow A G = 0, so that Gᵀ(M q̈ − f) = 0 holds without λ; λ follows from the rows left over.
Course section 3.8 and exercise 3.9; N. M. Ferrers, *Quart. J. Math.* 12 (1873).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import sympy as sm

from engdyn.algebra.elimination import solve
from engdyn.algebra.readable import to_sympy, tree
from engdyn.algebra.ring import Element
from engdyn.modeling.state import State

__all__ = ["multiplier_symbols", "projected", "substitute", "total", "with_rates_inside"]

Elements = list[Element]


def multiplier_symbols(count: int) -> tuple[sm.Symbol, ...]:
    """lambda_1, lambda_2, …: one for every constraint, in their order."""
    return tuple(sm.Symbol(f"lambda_{i + 1}") for i in range(count))


def with_rates_inside(
    state: State, mass: list[list[Element]], force: list[Element]
) -> tuple[State, list[list[Element]], list[Element]]:
    """The same equations where dependent rates inside roots, magnitudes and calls are replaced, too."""
    rates = {("function", q, 1) for q in state.rates}
    ring, entries = state.ring, [*(e for row in mass for e in row), *force]
    inner = [a for i in _used(entries) if i in ring.definitions for a in ring.definitions[i].arguments]
    opaque = {j for i in _used(entries) if i in ring.definitions for j in ring.definitions[i].contains}
    if not rates & {ring.keys[i] for i in {*ring.independent(inner), *opaque}}:
        return state, mass, force
    lines = [[to_sympy(tree(e)) for e in row] for row in mass]
    column = [to_sympy(tree(e)) for e in force]
    state = State(
        state.coordinates, [*(e for line in lines for e in line), *column], state.speeds, state.rates
    )
    return state, [[state.convert(e) for e in line] for line in lines], [state.convert(e) for e in column]


def _used(elements: Sequence[Element]) -> set[int]:
    return {i for e in elements for i in e.generators()}


def projected(
    state: State, mass: list[Elements], force: Elements, constraints: Sequence[sm.Expr]
) -> tuple[list[Elements], Elements, Callable[[], dict[sm.Symbol, sm.Expr]]]:
    """Project the n equations on the m independent speeds: Gᵀ M G u̇ = Gᵀ (f − M (q̈ without u̇)).

    Returns
    -------
    mass, force, multipliers
        M (m × m), f (m), and a function that solves for the multipliers when they are wanted.
    """
    ring = state.ring
    rates = state.rate_elements()
    keys = {q: ("function", q, 1) for q in state.rates}
    dependent = {ring.index[k]: state.convert(state.rates[q]) for q, k in keys.items() if k in ring.index}
    speeds, accelerations = state.speed_partials(), state.acceleration_partials()
    G = [[partial(rate) for partial in speeds] for rate in rates]
    curvature = []
    for rate in rates:
        bare = state.time_derivative(rate)
        for partial, key in zip(accelerations, state.acceleration_keys, strict=True):
            bare = bare - partial(bare) * ring.generator(key)
        curvature.append(substitute(bare, dependent))
    n, m = len(rates), len(speeds)
    mass = [[substitute(entry, dependent) for entry in row] for row in mass]
    force = [substitute(entry, dependent) for entry in force]
    rest = [force[i] - total(mass[i][j] * curvature[j] for j in range(n)) for i in range(n)]
    half = [[total(mass[i][k] * G[k][j] for k in range(n)) for j in range(m)] for i in range(n)]
    return (
        [[total(G[k][i] * half[k][j] for k in range(n)) for j in range(m)] for i in range(m)],
        [total(G[k][i] * rest[k] for k in range(n)) for i in range(m)],
        lambda: _multipliers(state, half, rest, constraints),
    )


def _multipliers(
    state: State, half: list[Elements], rest: Elements, constraints: Sequence[sm.Expr]
) -> dict[sm.Symbol, sm.Expr]:
    """λ of Aᵀ λ = M q̈ − f, from the rows of the dependent coordinates, in terms of q, u and u̇."""
    ring, unknowns = state.ring, multiplier_symbols(len(constraints))
    accelerations = [ring.generator(key) for key in state.acceleration_keys]
    rows = [i for i, q in enumerate(state.coordinates) if q in state.rates]
    needed = []
    for i in rows:
        inertia = total(h * a for h, a in zip(half[i], accelerations, strict=True))
        needed.append(to_sympy(tree(inertia - rest[i])))
    own = State(state.coordinates, [*needed, *constraints])  # with the constraints as they were given
    by_rate = own.speed_partials()
    lines = [own.convert(c) for c in constraints]
    system = [
        [*(by_rate[i](line) for line in lines), -own.convert(e)] for i, e in zip(rows, needed, strict=True)
    ]
    found = solve(system, len(unknowns)) or []
    return {x: to_sympy(tree(e)) for x, e in zip(unknowns, found, strict=True)}


def total(elements: Any) -> Element:
    """Sum of one or more elements."""
    first, *rest = elements
    for element in rest:
        first = first + element
    return first


def substitute(element: Element, images: Mapping[int, Element]) -> Element:
    """Replace independent generators by elements of the same ring (angles do not contain them)."""
    if not element.generators() & set(images):
        return element
    ring, ps = element.ring, element.ring.polynomials

    def polynomial(p: Any) -> Element:
        result = ring.zero
        for exponents, coefficient in ps.terms(p):
            kept = tuple(0 if i in images else e for i, e in enumerate(exponents))
            term = Element(ring, ps.from_terms({kept: coefficient}))
            for i, image in images.items():
                if exponents[i]:
                    term = term * image ** exponents[i]
            result = result + term
        return result

    above = polynomial(element.numerator)
    return above if element.denominator is None else above / polynomial(element.denominator)
