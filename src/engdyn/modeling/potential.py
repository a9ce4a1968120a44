"""Has a force a potential, and is the potential that was written down its potential?

Course section 3.4.  A field Q(q) has one where ∂Q_i/∂q_j = ∂Q_j/∂q_i for every pair (A. C. Clairaut, 1740).
Both questions are decided exactly in the ring; no formula is accepted that has not been differentiated back.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import sympy as sm
from sympy.physics.vector import ReferenceFrame
from sympy.simplify.fu import TR8

from engdyn.algebra.expressions import as_expression
from engdyn.algebra.ring import Derivation, Element
from engdyn.errors import EngdynError
from engdyn.modeling.model_motion import grouped, readable, readable_sum
from engdyn.modeling.state import State, check_coordinates
from engdyn.modeling.virtual_work import Loads, generalized_forces

__all__ = ["check_potential", "potential_of"]


def potential_of(forces: Mapping[sm.Expr, sm.Expr], coordinates: Sequence[sm.Expr]) -> sm.Expr:
    """The potential energy V with Q = −∂V/∂q, where the generalized forces have one.

    Parameters
    ----------
    forces : mapping of coordinate to expression
        Generalized forces Q(q) [N, N m]; those not given are zero.
    coordinates : sequence of dynamicsymbols, length n

    Returns
    -------
    sympy.Expr
        V [J], up to a constant.

    Raises
    ------
    EngdynError
        A force that depends on rates; a pair with ∂Q_i/∂q_j ≠ ∂Q_j/∂q_i, with both derivatives (a
        follower force, say): no potential exists; or a field that has a potential whose formula is
        not found (it is looked for among polynomials, sines, cosines and square roots).

    Notes
    -----
    Course sections 3.3 and 3.4.

    Examples
    --------
    >>> import engdyn as ed, sympy as sm
    >>> from sympy.physics.mechanics import dynamicsymbols
    >>> x, y = dynamicsymbols("x y")
    >>> k = sm.Symbol("k")
    >>> ed.potential_of({x: -k * (x - y), y: k * (x - y)}, [x, y])
    k*(x(t) - y(t))**2/2
    """
    coordinates = check_coordinates(coordinates)
    unknown = [q for q in forces if q not in coordinates]
    if unknown:
        raise EngdynError(f"forces names {unknown}, which are not among the coordinates {list(coordinates)}")
    given = [as_expression(forces.get(q, 0), f"the generalized force of {q}") for q in coordinates]
    state = State(coordinates, given)
    _check_curl(state, [state.convert(Q) for Q in given])
    potential = sm.S.Zero
    for q, Q in zip(coordinates, given, strict=True):
        potential += _integral(sm.expand_mul(-Q), potential, q)
    whole = State(coordinates, [*given, potential])
    V = whole.convert(potential)
    for q, Q in zip(coordinates, given, strict=True):
        if not (whole.ring.partial(("function", q, 0))(V) + whole.convert(Q)).is_zero():
            raise EngdynError(
                "these forces have a potential (all cross derivatives agree), but its formula was not found: "
                "write it down and check it with check_potential"
            )
    return readable_sum([whole.convert(term) for term in sm.Add.make_args(potential)])


def _check_curl(state: State, field: Sequence[Element]) -> None:
    """Refuse forces that depend on rates and fields with curl; the message names the pair."""
    ring, q = state.ring, state.coordinates
    moving = {("function", x, k) for x in q for k in (1, 2)}
    for x, Q in zip(q, field, strict=True):
        rate = next((ring.keys[i] for i in ring.independent([Q]) if ring.keys[i] in moving), None)
        if rate is not None:
            raise EngdynError(
                f"the generalized force of {x} depends on the rate of {rate[1]}: it has no potential"
            )
    partials = [ring.partial(("function", x, 0)) for x in q]
    for i in range(len(q)):
        for j in range(i):
            one, two = partials[i](field[j]), partials[j](field[i])
            if not one.equals(two):
                a, b = q[j], q[i]
                raise EngdynError(
                    f"these forces have no potential: dQ_{_name(a)}/d{_name(b)} = {readable(one)}, but "
                    f"dQ_{_name(b)}/d{_name(a)} = {readable(two)}; keep them as generalized forces"
                )


def _name(q: sm.Expr) -> str:
    return q.func.__name__


def _integral(slope: sm.Expr, known: sm.Expr, q: sm.Expr) -> sm.Expr:
    """∫ (slope − ∂known/∂q) dq: roots by their derivatives, the rest term by term."""
    terms = [sm.Add.make_args(e) for e in (slope, known)]
    state = State((), [q, *terms[0], *terms[1]])
    ring, by_q = state.ring, state.ring.partial(("function", q, 0))
    parts = [state.convert(term) for term in terms[0]] + [-by_q(state.convert(term)) for term in terms[1]]
    total, rest = sm.S.Zero, []
    for part in grouped(parts):
        for index in [i for i in part.generators() if i in ring.definitions]:
            primitive = _root_integral(part, index, by_q)
            if primitive is not None:
                total += readable(primitive)
                part = part - _coefficient(part, index) * Element(ring, ring.polynomials.gens[index])
        rest.append(part)
    return total + _by_terms(readable_sum(rest), q)


def _root_integral(part: Element, index: int, by_q: Derivation) -> Element | None:
    """∫ of the terms with √p where they are c p'/√p or c p' √p; None for other terms."""
    definition = part.ring.definitions[index]
    if definition.kind != "root":
        return None
    radicand, root = definition.arguments[0], Element(part.ring, part.ring.polynomials.gens[index])
    inner, factor = by_q(radicand), _coefficient(part, index)
    if inner.is_zero():
        return None
    for constant, primitive in (
        (factor * radicand / inner, 2 * root),
        (factor / inner, root * radicand * 2 / 3),
    ):
        if by_q(constant).is_zero():
            return constant * primitive
    return None


def _coefficient(element: Element, index: int) -> Element:
    """The factor of a generator that occurs to the first power at most."""
    ps = element.ring.polynomials
    above = Element(element.ring, ps.derivative(element.numerator, index))
    return above if element.denominator is None else above / Element(element.ring, element.denominator)


def _by_terms(expr: sm.Expr, q: sm.Expr) -> sm.Expr:
    """∫ expr dq of powers of q times sines and cosines of multiples of q; other terms are left out."""
    total = sm.S.Zero
    for term in sm.Add.make_args(sm.expand(TR8(sm.expand(sm.expand_trig(expr))))):
        outside, inside = term.as_independent(q, as_Add=False)
        power, angle, kind = 0, None, None
        for factor in sm.Mul.make_args(inside):
            base, exponent = factor.as_base_exp()
            if base == q and exponent.is_Integer and exponent >= 0:
                power = int(exponent)
            elif isinstance(factor, sm.sin | sm.cos) and angle is None and not factor.args[0].diff(q).has(q):
                angle, kind = factor.args[0], factor.func
            elif factor != 1:
                break
        else:
            total += outside * _primitive(power, kind, angle, q)
    return total


def _primitive(power: int, kind: Any, angle: sm.Expr | None, q: sm.Expr) -> sm.Expr:
    """∫ qⁿ dq, ∫ qⁿ sin(k q + φ) dq or the same with the cosine, by parts."""
    if angle is None:
        return q ** (power + 1) / (power + 1)
    k = angle.diff(q)
    other = -sm.cos(angle) if kind is sm.sin else sm.sin(angle)
    whole = q**power * other / k
    if power == 0:
        return whole
    sign = -1 if kind is sm.sin else 1
    return whole - sign * power / k * _primitive(power - 1, sm.cos if kind is sm.sin else sm.sin, angle, q)


def check_potential(
    potential: sm.Expr, loads: Loads, coordinates: Sequence[sm.Expr], frame: ReferenceFrame
) -> dict[sm.Expr, sm.Expr]:
    """Compare a potential energy with the loads that it stands for: −∂V/∂q must be their Q.

    Parameters
    ----------
    potential : sympy.Expr
        V [J].
    loads : Force, Torque, FreeBody, or a sequence of them
        The conservative loads as vectors: weights, the forces of springs on both their ends.
    coordinates : sequence of dynamicsymbols, length n
    frame : ReferenceFrame
        The inertial frame.

    Returns
    -------
    dict of coordinate to sympy.Expr
        The generalized forces, the same from both.

    Raises
    ------
    EngdynError
        A difference: the message names the coordinate, the terms, and quantities that the loads know
        and the potential does not, such as the free length of a spring.

    Notes
    -----
    Course section 3.4.
    """
    coordinates = check_coordinates(coordinates)
    potential = as_expression(potential, "the potential energy")
    forces = generalized_forces(loads, coordinates, frame)
    state = State(coordinates, [potential, *forces.values()])
    V = state.convert(potential)
    for q, Q in forces.items():
        rest = state.convert(Q) + state.ring.partial(("function", q, 0))(V)
        if not rest.is_zero():
            known = {s for e in forces.values() for s in e.free_symbols} - potential.free_symbols
            names = ", ".join(sorted(str(s) for s in known))
            hint = f"; V knows nothing of {names} (the free length of a spring?)" if names else ""
            raise EngdynError(
                f"the potential energy does not give the loads: Q_{_name(q)} + dV/d{_name(q)} = {readable(rest)}, "
                f"not 0{hint}"
            )
    return forces
