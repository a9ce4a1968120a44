"""Newton's and Euler's laws for every free body: ΣF = m a_G and ΣM_G = dH_G/dt.

Every reaction stays an unknown until the equations have been counted; then the reactions are
eliminated.  Nothing here knows of energies.  Course sections 2.3 to 2.14; L. Euler, *Nova methodus
motum corporum rigidorum determinandi* (1775).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import sympy as sm
from sympy.physics.mechanics import Force
from sympy.physics.vector import ReferenceFrame, dynamicsymbols

from engdyn.algebra.expressions import as_expression
from engdyn.errors import EngdynError
from engdyn.modeling.balances import Balance, Balances
from engdyn.modeling.constrained_balances import without_constraint_reactions
from engdyn.modeling.equations import EquationsOfMotion
from engdyn.modeling.free_body import FreeBody, arm_of, load_vector
from engdyn.modeling.motion import (
    Motion,
    Triple,
    VectorPath,
    cross,
    dot,
    measure_numbers,
    path_of_point,
    rotation_steps,
    spin_steps,
)
from engdyn.modeling.state import State, check_coordinates, dependent_rates

__all__ = ["FreeBody", "newton_euler"]


def newton_euler(
    free_bodies: Sequence[FreeBody],
    coordinates: Sequence[sm.Expr],
    frame: ReferenceFrame,
    unknowns: Sequence[sm.Symbol],
    *,
    constraints: Sequence[sm.Expr] = (),
    speeds: Sequence[sm.Expr] | None = None,
    kinematics: Mapping[sm.Expr, sm.Expr] | None = None,
) -> EquationsOfMotion:
    """Equations of motion from free-body diagrams.

    Parameters
    ----------
    free_bodies : sequence of FreeBody
        Every body with mass, or massless ones that carry loads.
    coordinates : sequence of dynamicsymbols, length n
    frame : ReferenceFrame
        The inertial frame.
    unknowns : sequence of sympy.Symbol
        Magnitudes of the reactions.
    constraints : sequence of expressions, optional
        Nonholonomic velocity constraints = 0, linear in the rates.
    speeds : sequence of dynamicsymbols or rates, optional
        Independent speeds; the rates of the coordinates where not given.
    kinematics : mapping of coordinate to expression, optional
        q̇ in terms of the speeds, where these are not the rates.

    Returns
    -------
    EquationsOfMotion
        ``.reactions`` gives each unknown in terms of the motion.

    Raises
    ------
    EngdynError
        More or fewer equations than unknown accelerations and reactions (rows that read 0 = 0 are
        not counted), an unknown that acts nowhere, a body whose motion is not described.

    Notes
    -----
    Course sections 2.4, 2.8 and 2.13.  Workless reactions disappear when the balances are projected
    on the motions that the joints allow (J. le R. d'Alembert, *Traité de dynamique*, 1743); where
    some do not, elimination does the rest.
    """
    coordinates = check_coordinates(coordinates)
    if not isinstance(frame, ReferenceFrame):
        raise EngdynError(f"frame is {frame!r}: give the inertial ReferenceFrame")
    free_bodies = [free_bodies] if isinstance(free_bodies, FreeBody) else list(free_bodies)
    unknowns = _check_unknowns(free_bodies, unknowns)

    def balances(speeds: Sequence[sm.Expr] | None, rates: Mapping[sm.Expr, sm.Expr], bound: int) -> Balances:
        state, motion, paths = _prepare(free_bodies, coordinates, frame, unknowns, speeds, rates)
        rows = [row for body in free_bodies for row in _balances(body, motion, paths)]
        found = Balances(state, rows, unknowns)
        found.check(lambda: _other_symbols(free_bodies, unknowns), bound)
        return found

    if constraints:
        if kinematics:
            raise EngdynError("give either constraints or kinematics: each determines the rates by itself")
        speeds, rates = dependent_rates(coordinates, tuple(constraints), speeds)
        eom = without_constraint_reactions(balances(None, {}, len(constraints)), speeds, rates, constraints)
        if eom is not None:
            return replace(eom, solve_reactions=lambda: balances(speeds, rates, 0).reactions())
    else:
        speeds, rates = _check_kinematics(coordinates, speeds, kinematics)
    written = balances(speeds, rates, 0)
    mass, force = written.projected() or written.eliminated()
    return EquationsOfMotion.from_elements(written.state, mass, force, "Newton-Euler", written.reactions)


def _check_unknowns(
    free_bodies: Sequence[FreeBody], unknowns: Sequence[sm.Symbol] | sm.Symbol
) -> list[sm.Symbol]:
    for body in free_bodies:
        if not isinstance(body, FreeBody):
            raise EngdynError(f"{body!r} is not a FreeBody: wrap the body and its loads in engdyn.FreeBody")
    if not free_bodies:
        raise EngdynError("there are no free bodies: give at least one body with its loads")
    found = [unknowns] if isinstance(unknowns, sm.Symbol) else list(unknowns)
    if any(not isinstance(x, sm.Symbol) for x in found) or len(set(found)) != len(found):
        raise EngdynError(f"unknowns {found}: give the symbols of the reaction magnitudes, each once")
    acting = {s for body in free_bodies for s in _reaction_symbols(body)}
    idle = [x.name for x in found if x not in acting]
    if idle:
        raise EngdynError(
            f"the unknowns {', '.join(idle)} act on no free body: add them to the reactions or drop them"
        )
    return found


def _reaction_symbols(body: FreeBody) -> set[sm.Symbol]:
    vectors = [load_vector(load) for load in body.reactions]
    return {s for e in measure_numbers(*vectors) for s in e.free_symbols}


def _other_symbols(free_bodies: Sequence[FreeBody], unknowns: Sequence[sm.Symbol]) -> set[sm.Symbol]:
    """Symbols that occur in reactions alone and are not unknowns: forgotten ones, probably."""
    known = {*unknowns, dynamicsymbols._t}
    for body in free_bodies:
        inertia = [body.body.central_inertia] if body.turns else []
        vectors = [load_vector(load) for load in body.applied]
        known |= {s for e in measure_numbers(body.body.mass, *inertia, *vectors) for s in e.free_symbols}
    return {s for body in free_bodies for s in _reaction_symbols(body)} - known


def _check_kinematics(
    coordinates: Sequence[sm.Expr],
    speeds: Sequence[sm.Expr] | None,
    kinematics: Mapping[sm.Expr, sm.Expr] | None,
) -> tuple[Sequence[sm.Expr] | None, dict[sm.Expr, sm.Expr]]:
    """Speeds and the rates in terms of them: every rate must be a speed or have its equation."""
    rates, t = dict(kinematics or {}), dynamicsymbols._t
    if speeds is None:
        if rates:
            raise EngdynError("kinematics needs speeds: name the quantities in which the rates are written")
        return None, rates
    unknown = [q for q in rates if q not in coordinates]
    if unknown:
        raise EngdynError(f"kinematics names {unknown}, not among the coordinates {list(coordinates)}")
    open_rates = [q for q in coordinates if q not in rates and q.diff(t) not in speeds]
    if open_rates:
        raise EngdynError(
            f"the rates of {open_rates} are not described: add them to kinematics as expressions in the "
            f"speeds {list(speeds)}"
        )
    return tuple(speeds), rates


def _prepare(
    free_bodies: Sequence[FreeBody],
    coordinates: Sequence[sm.Expr],
    frame: ReferenceFrame,
    unknowns: Sequence[sm.Symbol],
    speeds: Sequence[sm.Expr] | None,
    rates: Mapping[sm.Expr, sm.Expr],
) -> tuple[State, Motion, dict]:
    """Collect all expressions of the model, make their ring."""
    paths: dict[Any, VectorPath] = {}
    moving: list[sm.Expr] = []
    loads: list[sm.Expr] = list(unknowns)
    for body in free_bodies:
        paths[body.center] = path_of_point(body.center, frame)
        moving += _kinematic_scalars(body, paths[body.center], frame)
        loads += body.scalars()
    state = State(coordinates, [*moving, *loads], speeds, rates, moving=moving, unknowns=unknowns)
    return state, Motion(state, frame), paths


def _kinematic_scalars(body: FreeBody, path: VectorPath, frame: ReferenceFrame) -> list[sm.Expr]:
    """Everything that position, velocity, rotation and inertia of a body are made of."""
    forces = [load for load in (*body.applied, *body.reactions) if isinstance(load, Force)]
    vectors = [*path.steps, path.start._vel_dict[frame]]
    vectors += [arm_of(load, body) for load in forces if load.point != body.center]
    inertia = [body.body.central_inertia] if body.turns else []
    turning = [body.body.frame] if body.turns else []
    turning += [unit.args[0][1] for part in inertia[0].args for unit in part[1:]] if inertia else []
    vectors += [spin for f in dict.fromkeys(turning) for spin in spin_steps(f, frame)]
    frames = dict.fromkeys([*turning, *(f for v in (*vectors, *body.vectors()) for _, f in v.args)])
    turns = [step for f in frames for step in rotation_steps(frame, f)]
    return measure_numbers(*vectors, *inertia, *turns)


def _balances(body: FreeBody, motion: Motion, paths: dict) -> list[Balance]:
    """Force balance (3 rows) and, for a rigid body, moment balance about G (3 rows)."""
    state, inertial = motion.state, motion.frame
    axes = body.preferred_frame(inertial)
    velocity = motion.velocity(paths[body.center])
    mass = state.convert(as_expression(body.body.mass))
    inertia = [mass * a for a in motion.turned(motion.derivative(velocity), inertial, axes)]
    forces = [
        motion.components(load.force, axes)
        for load in (*body.applied, *body.reactions)
        if isinstance(load, Force)
    ]
    turned = motion.turned(velocity, inertial, axes)
    rows = _rows(f"{body.name}: forces", axes, inertia, forces, turned, state)
    if body.turns:
        rows += _moment_balance(body, motion)
    elif any(not isinstance(load, Force) for load in (*body.applied, *body.reactions)):
        raise EngdynError(
            f"a torque acts on the particle {body.name}: particles do not turn, use a RigidBody"
        )
    return rows


def _moment_balance(body: FreeBody, motion: Motion) -> list[Balance]:
    """ΣM_G = dH_G/dt, written in the axes in which the inertia is given."""
    state, dyadic = motion.state, body.body.central_inertia
    axes = dyadic.args[0][1].args[0][1] if dyadic.args else body.body.frame
    spin = motion.angular_velocity(body.body.frame, axes)
    zero = state.ring.zero
    momentum = [zero, zero, zero]
    for measure, left, right in dyadic.args:
        value = state.convert(as_expression(measure)) * dot(motion.components(right, axes), spin)
        momentum = [h + value * e for h, e in zip(momentum, motion.components(left, axes), strict=True)]
    axes_spin = motion.angular_velocity(axes, axes)
    turning = cross(axes_spin, momentum)
    change = [a + b for a, b in zip(motion.derivative(momentum), turning, strict=True)]
    moments = [_moment(load, body, motion, axes) for load in (*body.applied, *body.reactions)]
    return _rows(f"{body.name}: moments", axes, change, moments, spin, state)


def _moment(load: Any, body: FreeBody, motion: Motion, axes: ReferenceFrame) -> Triple:
    """Moment of a load about the mass center: r × F, or the torque itself."""
    if not isinstance(load, Force):
        return motion.components(load.torque, axes)
    if load.point == body.center:
        return [motion.state.ring.zero] * 3
    arm = motion.components(arm_of(load, body), axes)
    return cross(arm, motion.components(load.force, axes))


def _rows(
    what: str, axes: ReferenceFrame, inertia: Triple, loads: Sequence[Triple], velocity: Triple, state: State
) -> list[Balance]:
    rows = []
    for i, letter in enumerate("xyz"):
        residual = inertia[i]
        for load in loads:
            residual = residual - load[i]
        if not residual.is_zero():  # 0 = 0 says nothing
            partials = [partial(velocity[i]) for partial in state.speed_partials()]
            rows.append(Balance(f"{what} along {axes}.{letter}", residual, partials))
    return rows
