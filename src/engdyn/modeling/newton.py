"""Newton's and Euler's laws for every free body: ΣF = m a_G and ΣM_G = dH_G/dt.

Every reaction stays an unknown until the equations have been counted; then the reactions are
eliminated.  Nothing here knows of energies.  Course sections 2.3 to 2.14; L. Euler, *Nova methodus
motum corporum rigidorum determinandi* (1775).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import sympy as sm
from sympy.physics.mechanics import Force
from sympy.physics.vector import ReferenceFrame

from engdyn.algebra.elimination import eliminate, primitive, solve
from engdyn.algebra.readable import to_sympy, tree
from engdyn.algebra.ring import Element
from engdyn.errors import EngdynError
from engdyn.modeling.equations import EquationsOfMotion
from engdyn.modeling.free_body import FreeBody, load_vector
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


@dataclass(frozen=True)
class Balance:
    """One scalar equation of a free body: residual = 0.

    Attributes
    ----------
    name : str
        What is balanced, e.g. "trolley: forces along N.x".
    residual : Element
        Inertia minus loads.
    motion : list of Element
        Partial velocities of this row, one per speed: ∂(v or ω)/∂u along this axis.
    """

    name: str
    residual: Element
    motion: list[Element]


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
    free_bodies = [free_bodies] if isinstance(free_bodies, FreeBody) else list(free_bodies)
    unknowns = _check_unknowns(free_bodies, unknowns)
    rates = {q: rate for q, rate in (kinematics or {}).items()}
    if constraints:
        speeds, rates = dependent_rates(coordinates, tuple(constraints), speeds)
    state, motion, paths = _prepare(free_bodies, coordinates, frame, unknowns, speeds, rates)
    balances = [
        row
        for body in free_bodies
        for row in _balances(body, motion, paths)
        if not row.residual.is_zero()
    ]
    split = _Split(state, balances, unknowns)
    split.check_count()
    mass, force = split.projected() or split.eliminated()
    return EquationsOfMotion.from_elements(state, mass, force, "Newton-Euler", split.reactions)


def _check_unknowns(free_bodies: Sequence[FreeBody], unknowns: Sequence[sm.Symbol]) -> list[sm.Symbol]:
    for body in free_bodies:
        if not isinstance(body, FreeBody):
            raise EngdynError(f"{body!r} is not a FreeBody: wrap the body and its loads in engdyn.FreeBody")
    found = list(unknowns)
    if any(not isinstance(x, sm.Symbol) for x in found):
        raise EngdynError(f"unknowns {found}: give the symbols of the reaction magnitudes")
    acting = {s for body in free_bodies for load in body.reactions for e in measure_numbers(load_vector(load)) for s in e.free_symbols}
    idle = [x.name for x in found if x not in acting]
    if idle:
        raise EngdynError(f"the unknowns {', '.join(idle)} act on no free body: add them to the reactions or drop them")
    return found


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
        paths[body.center] = path = path_of_point(body.center, frame)
        vectors = [*path.steps, path.start._vel_dict[frame]]
        frames = {f for v in (*vectors, *body.vectors()) for _, f in v.args}
        if body.turns:
            frames |= {body.body.frame, *(f for part in body.body.central_inertia.args for f in (part[1].args[0][1], part[2].args[0][1]))}
            vectors += spin_steps(body.body.frame, frame)
            frames |= {f for v in vectors for _, f in v.args}
        for load in (*body.applied, *body.reactions):
            if isinstance(load, Force) and load.point != body.center:
                vectors.append(load.point.pos_from(body.center))
                frames |= {f for _, f in vectors[-1].args}
        moving += measure_numbers(*vectors, *(step for f in frames for step in rotation_steps(frame, f)))
        moving += measure_numbers(*(step for f in frames for step in rotation_steps(f, frame)))
        spins = [s for f in frames for s in spin_steps(f, frame)]
        moving += measure_numbers(*spins, *(step for s in spins for _, f in s.args for step in rotation_steps(f, frame)))
        loads += body.scalars()
    state = State(coordinates, [*moving, *loads], speeds, rates, moving=moving)
    return state, Motion(state, frame), paths


def _balances(body: FreeBody, motion: Motion, paths: dict) -> list[Balance]:
    """Force balance (3 rows) and, for a rigid body, moment balance about G (3 rows)."""
    state, inertial = motion.state, motion.frame
    axes = body.preferred_frame(inertial)
    velocity = motion.velocity(paths[body.center])
    mass = state.convert(sm.sympify(body.body.mass))
    inertia = [mass * a for a in motion.turned(motion.derivative(velocity), inertial, axes)]
    forces = [motion.components(load.force, axes) for load in (*body.applied, *body.reactions) if isinstance(load, Force)]
    turned = motion.turned(velocity, inertial, axes)
    rows = _rows(f"{body.name}: forces", axes, inertia, forces, turned, state)
    if body.turns:
        rows += _moment_balance(body, motion)
    elif any(not isinstance(load, Force) for load in (*body.applied, *body.reactions)):
        raise EngdynError(f"a torque acts on the particle {body.name}: particles do not turn, use a RigidBody")
    return rows


def _moment_balance(body: FreeBody, motion: Motion) -> list[Balance]:
    """ΣM_G = dH_G/dt, written in the axes in which the inertia is given."""
    state, inertial = motion.state, motion.frame
    dyadic = body.body.central_inertia
    axes = dyadic.args[0][1].args[0][1] if dyadic.args else body.body.frame
    spin = motion.angular_velocity(body.body.frame, axes)
    zero = state.ring.zero
    momentum = [zero, zero, zero]
    for measure, left, right in dyadic.args:
        value = state.convert(sm.sympify(measure)) * dot(motion.components(right, axes), spin)
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
    arm = motion.components(load.point.pos_from(body.center), axes)
    return cross(arm, motion.components(load.force, axes))


def _rows(
    what: str, axes: ReferenceFrame, inertia: Triple, loads: Sequence[Triple], velocity: Triple, state: State
) -> list[Balance]:
    rows = []
    for i, letter in enumerate("xyz"):
        residual = inertia[i]
        for load in loads:
            residual = residual - load[i]
        partials = [partial(velocity[i]) for partial in state.speed_partials()]
        rows.append(Balance(f"{what} along {axes}.{letter}", residual, partials))
    return rows


class _Split:
    """Balances written as R λ + M̃ u̇ + h = 0 with reactions λ and accelerations u̇."""

    def __init__(self, state: State, balances: Sequence[Balance], unknowns: Sequence[sm.Symbol]):
        self.state, self.balances, self.unknowns = state, list(balances), list(unknowns)
        ring = state.ring
        by_reaction = [ring.partial(("symbol", x)) for x in unknowns]
        by_acceleration = state.acceleration_partials()
        gens = [ring.generator(("symbol", x)) for x in unknowns]
        gens += [ring.generator(key) for key in state.acceleration_keys]
        self.rows = []
        for balance in self.balances:
            row = [partial(balance.residual) for partial in (*by_reaction, *by_acceleration)]
            rest = balance.residual
            for entry, generator in zip(row, gens, strict=True):
                if not entry.is_zero():
                    rest = rest - entry * generator
            self.rows.append([*row, rest])
        reactions = {ring.index["symbol", x] for x in unknowns}
        if any(entry.generators() & reactions for row in self.rows for entry in row):
            raise EngdynError("the loads are not linear in the unknown reactions: give each reaction one magnitude")

    def check_count(self) -> None:
        """As many balances as unknown accelerations and reactions, or an error that says what is wrong."""
        n, k = len(self.state.speeds), len(self.unknowns)
        if len(self.rows) == n + k:
            return
        listing = "; ".join(f"{b.name} ({self._names(row) or 'no reaction'})" for b, row in zip(self.balances, self.rows, strict=True))
        counted = f"{len(self.rows)} equations for {n} accelerations and {k} reactions"
        if len(self.rows) > n + k:
            raise EngdynError(
                f"{counted}: {len(self.rows) - n - k} reactions are missing. {self._unsupported()}"
                f"Equations and the reactions in them: {listing}"
            )
        raise EngdynError(
            f"{counted}: {n + k - len(self.rows)} too many, so they cannot be found from these bodies (statically "
            f"indeterminate, or a free body is missing). Equations and the reactions in them: {listing}"
        )

    def _names(self, row: list[Element]) -> str:
        return ", ".join(x.name for x, entry in zip(self.unknowns, row, strict=False) if not entry.is_zero())

    def _unsupported(self) -> str:
        """Which balances remain without any unknown to satisfy them."""
        columns = len(self.unknowns) + len(self.state.speeds)
        done = eliminate(self.rows, columns)
        left = [self.balances[origin].name for origin, row in done.remaining if not row[-1].is_zero()]
        return f"Nothing can satisfy: {', '.join(left)}. " if left else ""

    def projected(self) -> tuple[list[list[Element]], list[Element]] | None:
        """Project on the motions that the joints allow; None where a reaction does not drop out."""
        n, k = len(self.state.speeds), len(self.unknowns)
        zero = self.state.ring.zero
        mass, force = [], []
        for j in range(n):
            total = [zero] * (k + n + 1)
            for balance, row in zip(self.balances, self.rows, strict=True):
                weight = balance.motion[j]
                if not weight.is_zero():
                    total = [a if b.is_zero() else a + weight * b for a, b in zip(total, row, strict=True)]
            if any(not entry.is_zero() for entry in total[:k]):
                return None
            mass.append(total[k : k + n])
            force.append(-total[-1])
        return mass, force

    def eliminated(self) -> tuple[list[list[Element]], list[Element]]:
        """Eliminate the reactions one by one."""
        n, k = len(self.state.speeds), len(self.unknowns)
        done = eliminate(self.rows, k)
        if done.missing:
            names = ", ".join(self.unknowns[i].name for i in done.missing)
            raise EngdynError(f"the reactions {names} do not act independently of the others: they cannot be told apart")
        rows = [primitive(row[k:]) for _, row in done.remaining]
        return [row[:n] for row in rows], [-row[n] for row in rows]

    def reactions(self) -> dict[sm.Symbol, sm.Expr]:
        """Each reaction in terms of q, u and u̇."""
        n, k = len(self.state.speeds), len(self.unknowns)
        if not k:
            return {}
        ring = self.state.ring
        accelerations = [ring.generator(key) for key in self.state.acceleration_keys]
        rows = []
        for row in self.rows:
            rest = row[-1]
            for entry, udot in zip(row[k : k + n], accelerations, strict=True):
                rest = rest + entry * udot
            rows.append([*row[:k], rest])
        found = solve(rows, k)
        if found is None:
            raise EngdynError("the reactions do not act independently of each other: they cannot be told apart")
        return {x: to_sympy(tree(e)) for x, e in zip(self.unknowns, found, strict=True)}
