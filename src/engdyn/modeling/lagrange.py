"""Lagrange's equations: d/dt(∂T/∂q̇) − ∂T/∂q + ∂V/∂q + ∂D/∂q̇ = Q.

Course chapter 3; J. L. Lagrange, *Mécanique analytique* (1788); Rayleigh's function after
J. W. Strutt, *Proc. London Math. Soc.* s1-4 (1873).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any, Literal, overload

import sympy as sm
from sympy.physics.vector import dynamicsymbols

from engdyn.algebra.expressions import as_expression
from engdyn.algebra.readable import to_sympy, tree
from engdyn.algebra.ring import Derivation, Element
from engdyn.errors import EngdynError
from engdyn.modeling.constrained import Constrained
from engdyn.modeling.energy_balance import Energies
from engdyn.modeling.equations import EquationsOfMotion
from engdyn.modeling.nonholonomic import projected, substitute, with_rates_inside
from engdyn.modeling.state import State, check_coordinates, dependent_rates

if TYPE_CHECKING:
    from engdyn.modeling.lagrange_steps import LagrangeSteps

__all__ = ["lagrange", "substitute"]


@overload
def lagrange(
    kinetic: sm.Expr,
    potential: sm.Expr,
    coordinates: Sequence[sm.Expr],
    dissipation: sm.Expr = 0,
    forces: Mapping[sm.Expr, sm.Expr] | None = None,
    constraints: Sequence[sm.Expr] = (),
    *,
    speeds: Sequence[sm.Expr] | None = None,
    steps: Literal[False] = False,
) -> EquationsOfMotion: ...
@overload
def lagrange(
    kinetic: sm.Expr,
    potential: sm.Expr,
    coordinates: Sequence[sm.Expr],
    dissipation: sm.Expr = 0,
    forces: Mapping[sm.Expr, sm.Expr] | None = None,
    constraints: Sequence[sm.Expr] = (),
    *,
    speeds: Sequence[sm.Expr] | None = None,
    steps: Literal[True],
) -> LagrangeSteps: ...
def lagrange(
    kinetic: sm.Expr,
    potential: sm.Expr,
    coordinates: Sequence[sm.Expr],
    dissipation: sm.Expr = 0,
    forces: Mapping[sm.Expr, sm.Expr] | None = None,
    constraints: Sequence[sm.Expr] = (),
    *,
    speeds: Sequence[sm.Expr] | None = None,
    steps: bool = False,
) -> EquationsOfMotion | LagrangeSteps:
    """Equations of motion from energies.

    Parameters
    ----------
    kinetic : sympy.Expr
        T(q, q̇, t) with absolute velocities [J].
    potential : sympy.Expr
        V(q, t) [J].
    coordinates : sequence of dynamicsymbols, length n
    dissipation : sympy.Expr
        Rayleigh's function D(q, q̇): half the dissipated power [W].
    forces : mapping of coordinate to expression, optional
        Generalized forces Q of everything that is neither in V nor in D [N, N m].
    constraints : sequence of expressions
        Nonholonomic velocity constraints = 0, linear in the rates. They are *not* put into T;
        the equations are projected on the motions that they allow.
    speeds : sequence of rates, optional
        Which rates to keep as independent speeds under constraints; the first that can be where
        not given.
    steps : bool
        Return the terms of the derivation, too, and look at the kinetic energy: a warning says when it
        is not positive for every motion.

    Returns
    -------
    EquationsOfMotion or LagrangeSteps
        With `steps` the derivation, which holds the equations.  Under constraints
        ``eom.reactions`` gives the multipliers lambda_1, …: the constraint forces are Σ λ ∂c/∂q̇.

    Raises
    ------
    EngdynError
        Unknown coordinates in `forces`, a kinetic energy without inertia for some coordinate, a
        potential with rates in it, a force that the potential energy holds already (weight counted
        twice).

    Notes
    -----
    Course sections 3.2 to 3.5 and 3.8.

    Examples
    --------
    >>> import engdyn as ed, sympy as sm
    >>> from sympy.physics.mechanics import dynamicsymbols
    >>> theta = dynamicsymbols("theta")
    >>> m, l, g = sm.symbols("m l g", positive=True)
    >>> pendulum = ed.lagrange(m * l**2 * theta.diff() ** 2 / 2, -m * g * l * sm.cos(theta), [theta])
    >>> pendulum.forcing[0]
    -g*l*m*sin(theta(t))
    """
    coordinates = check_coordinates(coordinates)
    kinetic, potential = _energy(kinetic, "kinetic"), _energy(potential, "potential")
    dissipation = _energy(dissipation, "dissipation")
    forces = _forces(forces, coordinates)
    constraints = tuple(constraints)
    rates: dict[sm.Expr, sm.Expr] = {}
    independent = None
    if constraints:
        independent, rates = dependent_rates(coordinates, constraints, speeds)
    elif speeds is not None and tuple(speeds) != tuple(q.diff(dynamicsymbols._t) for q in coordinates):
        raise EngdynError(
            "without constraints the speeds of Lagrange's equations are the rates of the coordinates"
        )
    terms = [kinetic, potential, dissipation, *forces.values()]
    state = State(coordinates, terms, independent, rates, substitute=False, moving=[kinetic])
    mass, force = _equations(state, kinetic, potential, dissipation, forces)
    multipliers = full = None
    if constraints:
        full = Constrained(coordinates, state.speeds, tuple(map(tuple, mass)), tuple(force), constraints)
        state, mass, force = with_rates_inside(state, mass, force)
        mass, force, multipliers = projected(state, mass, force, constraints)
    eom = EquationsOfMotion.from_elements(state, mass, force, "Lagrange", multipliers)
    energies = Energies(kinetic, potential, dissipation, forces, constraints)
    eom = replace(eom, constrained=full, energies=energies)
    if not steps:
        return eom
    from engdyn.modeling.lagrange_steps import lagrange_steps

    return lagrange_steps(eom, kinetic, potential, dissipation, forces, constraints)


def _energy(expr: Any, name: str) -> sm.Expr:
    if isinstance(expr, int | float):
        return as_expression(expr)
    if not isinstance(expr, sm.Expr):
        raise EngdynError(f"the {name} energy is {expr!r}: give a sympy expression")
    return expr


def _forces(
    forces: Mapping[sm.Expr, sm.Expr] | None, coordinates: Sequence[sm.Expr]
) -> dict[sm.Expr, sm.Expr]:
    given = dict(forces or {})
    unknown = [q for q in given if q not in coordinates]
    if unknown:
        raise EngdynError(f"forces names {unknown}, which are not among the coordinates {list(coordinates)}")
    return {q: as_expression(given.get(q, 0), f"the generalized force of {q}") for q in coordinates}


def _equations(
    state: State,
    kinetic: sm.Expr,
    potential: sm.Expr,
    dissipation: sm.Expr,
    forces: Mapping[sm.Expr, sm.Expr],
) -> tuple[list[list[Element]], list[Element]]:
    """M and f of Lagrange's equations in all n coordinates."""
    ring = state.ring
    T, V, D = (_without_accelerations(state, e) for e in (kinetic, potential, dissipation))
    by_q = [ring.partial(("function", q, 0)) for q in state.coordinates]
    by_rate = [ring.partial(("function", q, 1)) for q in state.coordinates]
    by_acceleration = [(ring.partial(key), ring.generator(key)) for key in _acceleration_keys(state)]
    if any(not partial(V).is_zero() for partial in by_rate):
        raise EngdynError(
            "the potential energy contains a rate: put velocity-dependent effects into D or the forces"
        )
    velocity_part = _velocity_part(state)
    mass, force = [], []
    for q, d_q, d_rate in zip(state.coordinates, by_q, by_rate, strict=True):
        momentum, attraction = d_rate(T), -d_q(V)
        Q = state.convert(forces[q])
        _check_counted_once(q, Q, attraction)
        carried = [partial(Q) for partial, _ in by_acceleration]  # a force with accelerations is inertia
        for entry, (_, acceleration) in zip(carried, by_acceleration, strict=True):
            Q = Q - entry * acceleration
        mass.append([partial(momentum) - entry for partial, entry in zip(by_rate, carried, strict=True)])
        force.append(d_q(T) + attraction - d_rate(D) + Q - velocity_part(momentum))
    return mass, force


def _acceleration_keys(state: State) -> list[tuple[Any, ...]]:
    return [("function", q, 2) for q in state.coordinates]


def _without_accelerations(state: State, energy: sm.Expr) -> Element:
    """An energy as an element; accelerations do not belong there."""
    element = state.convert(energy)
    wrong = {state.ring.keys[i] for i in state.ring.independent([element])} & {*_acceleration_keys(state)}
    if wrong:
        raise EngdynError(
            f"an energy or dissipation function contains an acceleration, that of {next(iter(wrong))[1]}: "
            "energies depend on coordinates and rates only"
        )
    return element


def _velocity_part(state: State) -> Derivation:
    """The time derivative without the accelerations of the coordinates: these go into M."""
    ring, rate_of = state.ring, state.time_derivative
    accelerations = {ring.index[key] for key in _acceleration_keys(state)}
    seeds = {}
    for i in range(len(ring.keys)):
        rate = None if i in ring.definitions or i in rate_of.unknown else rate_of.of_generator(i)
        if rate is not None and not rate.generators() & accelerations:
            seeds[i] = rate
    return Derivation(ring, seeds, rate_of.unknown)


def _check_counted_once(q: sm.Expr, Q: Element, attraction: Element) -> None:
    """Refuse a generalized force that repeats terms of −∂V/∂q: the weight, most often.

    What couples coordinates without a term of its own coordinate may be meant: a circulatory force has one half
    in V and one in Q.
    """
    ps, ring = Q.ring.polynomials, Q.ring
    if Q.denominator is not None or attraction.denominator is not None:
        return
    known = dict(ps.terms(attraction.numerator))
    for exponents, coefficient in ps.terms(Q.numerator):
        if known.get(exponents) != coefficient:
            continue
        repeated = Element(ring, ps.from_terms({exponents: coefficient}))
        term = to_sympy(tree(repeated))
        weight = any(s.name == "g" for s in term.free_symbols)
        if weight or not ring.partial(("function", q, 0))(repeated).is_zero():
            raise EngdynError(
                f"the generalized force of {q} contains {term}, which the potential energy gives already: "
                f"{'gravity' if weight else 'this force'} is counted twice; keep it in V or in forces, not in both"
            )
