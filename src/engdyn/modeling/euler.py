"""Euler's moment equations of one rigid body, in body axes or in axes that do not spin with it.

Course sections 2.11, 2.12 and 2.14; L. Euler, *Theoria motus corporum solidorum seu rigidorum* (1765).
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, TypeAlias

import sympy as sm
from sympy.physics.vector import ReferenceFrame, Vector

from engdyn.algebra.elimination import solve
from engdyn.algebra.expressions import as_expression
from engdyn.algebra.ring import Element
from engdyn.algebra.scan import derivative_key
from engdyn.errors import EngdynError
from engdyn.modeling.balances import Balance, Balances
from engdyn.modeling.equations import EquationsOfMotion
from engdyn.modeling.inertia import check_tensor, is_symbolic
from engdyn.modeling.model_motion import frames_of, readable
from engdyn.modeling.motion import Motion, Triple, cross, dot, measure_numbers, rotation_steps, spin_steps
from engdyn.modeling.state import State, check_coordinates

__all__ = ["EulerEquations", "euler_equations"]

Components: TypeAlias = tuple[sm.Expr, ...]


@dataclass(frozen=True, eq=False, repr=False)
class EulerEquations(EquationsOfMotion):
    """Equations of motion of a turning body, M = (dH/dt)_axes + Ω × H, with these terms by name.

    Attributes
    ----------
    moment : tuple of three expressions
        M along the axes [N m].
    angular_momentum : tuple of three expressions
        H = I ω along the axes [kg m²/s].
    component_derivative : tuple of three expressions
        (dH/dt)_axes: how the components of H change [N m].
    turning : tuple of three expressions
        Ω × H with the angular velocity Ω *of the axes* [N m].
    """

    moment: Components = ()
    angular_momentum: Components = ()
    component_derivative: Components = ()
    turning: Components = ()

    def __repr__(self) -> str:
        names = ", ".join(q.func.__name__ for q in self.coordinates) or "no coordinates"
        speeds = ", ".join(
            str(key[1].func.__name__) + "'" * key[2] for key in map(derivative_key, self.speeds)
        )
        return f"EulerEquations({names}; speeds {speeds})"

    def _repr_latex_(self) -> str:
        from sympy.physics.vector.printing import vlatex

        named = zip(self.component_derivative, self.turning, self.moment, strict=True)
        rows = [vlatex(sm.Eq(change + turn, moment, evaluate=False)) for change, turn, moment in named]
        return (
            "$\\displaystyle \\begin{aligned}"
            + r"\\".join(r.replace(" = ", " &= ") for r in rows)
            + (r"\end{aligned}$")
        )


def euler_equations(
    tensor: Any,
    speeds: Sequence[sm.Expr] | None = None,
    moment: Vector | Sequence[Any] = (0, 0, 0),
    *,
    coordinates: Sequence[sm.Expr] = (),
    frame: ReferenceFrame | None = None,
    axes: ReferenceFrame | None = None,
    body: ReferenceFrame | None = None,
    kinematics: Mapping[sm.Expr, sm.Expr] | None = None,
    axes_rate: Sequence[Any] | None = None,
    unknowns: Sequence[sm.Symbol] = (),
) -> EulerEquations:
    """Euler's equations of a rigid body about its mass center or about a point of it that is fixed.

    Parameters
    ----------
    tensor : three principal moments, or array_like, shape (3, 3)
        About that point, along the axes [kg m²].
    speeds : sequence of three dynamicsymbols, optional
        Components ω of the *body's* angular velocity along the axes [rad/s].  Where not given the
        rates of the coordinates are the speeds, and the equations are projected on them.
    moment : Vector or sequence of three expressions
        About that point, along the axes [N m].
    coordinates : sequence of dynamicsymbols, optional
        What describes the attitude; without them the equations stand for themselves.
    frame, axes, body : ReferenceFrame, optional
        Inertial frame, the frame along which everything is written, and the frame that is fixed in
        the body (the same as `axes` where not given).  Oriented in each other by the coordinates,
        they give ω, the rate Ω of the axes and the kinematics q̇ = G(q) u.
    kinematics : mapping of coordinate to expression, optional
        q̇ in terms of the speeds, where no frames are given.
    axes_rate : sequence of three expressions, optional
        Ω of the axes along themselves, where no frames are given; ω where this is not given either.
    unknowns : sequence of sympy.Symbol
        Magnitudes of couples in `moment` that hold a prescribed motion.

    Returns
    -------
    EulerEquations
        EquationsOfMotion, with ``.moment .angular_momentum .component_derivative .turning``.

    Raises
    ------
    EngdynError
        A tensor that no body can have, axes that turn in the body although the tensor is not
        symmetric about the axis of that turn, frames that do not tell the attitude, a wrong number
        of speeds or equations.

    Notes
    -----
    Course sections 2.11, 2.12 and 2.14.  Axes that do not spin with an axisymmetric body keep its
    tensor constant; the rate of change of H then takes *their* Ω, while H = I ω takes the body's ω.

    Examples
    --------
    >>> import engdyn as ed, sympy as sm
    >>> from sympy.physics.mechanics import dynamicsymbols
    >>> A, B, C = sm.symbols("A B C")
    >>> box = ed.euler_equations([A, B, C], dynamicsymbols("w1 w2 w3"))
    >>> box.turning[0]
    (-B + C)*w2(t)*w3(t)
    """
    entries, speeds, unknowns = _tensor(tensor), _speeds(speeds), list(unknowns)
    coordinates = check_coordinates(coordinates) if len(coordinates) else ()
    if (axes is None) != (frame is None) or (axes is None and body is not None):
        raise EngdynError("give frame and axes together (and body, where it turns in these axes), or neither")
    if axes is None:
        state, spin, turn = _by_hand(entries, speeds, moment, coordinates, kinematics, axes_rate, unknowns)
        load = [state.convert(as_expression(x)) for x in _three(moment, "moment")]
    elif kinematics is not None or axes_rate is not None:
        raise EngdynError("the frames tell kinematics and axes_rate: give either frames or these")
    else:
        motion, spin, turn = _by_frames(
            entries, speeds, moment, coordinates, frame, axes, body or axes, unknowns
        )
        state, load = motion.state, _load(motion, moment, axes)
    inertia = [[state.convert(x) for x in row] for row in entries]
    _check_turning(inertia, spin, turn)
    momentum = [dot(row, spin) for row in inertia]
    change, turning = [state.time_derivative(h) for h in momentum], cross(turn, momentum)
    rows = [a + b - c for a, b, c in zip(change, turning, load, strict=True)]
    found = _equations(state, rows, spin, unknowns)
    named = {"moment": load, "angular_momentum": momentum, "component_derivative": change, "turning": turning}
    return replace(found, **{name: tuple(readable(e) for e in part) for name, part in named.items()})


def _equations(state: State, residuals: Triple, spin: Triple, unknowns: list[sm.Symbol]) -> EulerEquations:
    """Count the moment balances, project them on the speeds."""
    rows = [
        Balance(
            f"moments along axis {k + 1}",
            residuals[k],
            [partial(spin[k]) for partial in state.speed_partials()],
        )
        for k in range(3)
    ]
    balances = Balances(state, [row for row in rows if not row.residual.is_zero()], unknowns)
    balances.check()
    mass, force = balances.projected() or balances.eliminated()
    return EulerEquations.from_elements(state, mass, force, "Euler", balances.reactions)


def _three(values: Any, what: str) -> list[Any]:
    found = list(values) if not isinstance(values, Vector | sm.Basic | str) else []
    if len(found) != 3:
        raise EngdynError(f"{what} is {values!r}: give its three components along the axes")
    return found


def _tensor(tensor: Any) -> list[list[sm.Expr]]:
    """Three rows of expressions; numbers must be those of a body."""
    rows = tensor.tolist() if hasattr(tensor, "tolist") else list(tensor)
    if len(rows) == 3 and not any(isinstance(row, list | tuple) for row in rows):
        rows = [[rows[i] if i == j else 0 for j in range(3)] for i in range(3)]
    if len(rows) != 3 or any(not isinstance(row, list | tuple) or len(row) != 3 for row in rows):
        raise EngdynError("the tensor has three principal moments, or three rows of three entries")
    found = [[as_expression(x, "an entry of the tensor") for x in row] for row in rows]
    if not is_symbolic(*(x for row in found for x in row)):
        check_tensor(found)
    return found


def _speeds(speeds: Sequence[sm.Expr] | None) -> tuple[sm.Expr, ...] | None:
    if speeds is None:
        return None
    found = tuple(speeds)
    if len(found) != 3 or any(derivative_key(u) is None for u in found):
        raise EngdynError(
            f"speeds is {found}: give three dynamicsymbols, the body's angular velocity along the axes"
        )
    return found


def _by_hand(
    tensor: list[list[sm.Expr]],
    speeds: tuple[sm.Expr, ...] | None,
    moment: Any,
    coordinates: tuple[sm.Expr, ...],
    kinematics: Mapping[sm.Expr, sm.Expr] | None,
    axes_rate: Sequence[Any] | None,
    unknowns: list[sm.Symbol],
) -> tuple[State, Triple, Triple]:
    """State, ω of the body and Ω of the axes, as the user wrote them."""
    if speeds is None:
        raise EngdynError("speeds are missing: give three dynamicsymbols, or frames that tell the attitude")
    rates = dict(kinematics or {})
    if set(rates) != set(coordinates):
        raise EngdynError(
            f"kinematics describes the rates of {list(rates)}, the coordinates are {list(coordinates)}: give one "
            "expression in the speeds for each, or frames that tell them"
        )
    given = None if axes_rate is None else [as_expression(x) for x in _three(axes_rate, "axes_rate")]
    entries = [x for row in tensor for x in row]
    others = [as_expression(x) for x in (*_three(moment, "moment"), *(given or ()), *unknowns)]
    state = State(coordinates, [*entries, *speeds, *others], speeds, rates, moving=[*entries, *speeds])
    spin = [state.convert(w) for w in speeds]
    return state, spin, spin if given is None else [state.convert(x) for x in given]


def _by_frames(
    tensor: list[list[sm.Expr]],
    speeds: tuple[sm.Expr, ...] | None,
    moment: Any,
    coordinates: tuple[sm.Expr, ...],
    frame: Any,
    axes: ReferenceFrame,
    body: ReferenceFrame,
    unknowns: list[sm.Symbol],
) -> tuple[Motion, Triple, Triple]:
    """Motion, ω of the body and Ω of the axes, from frames oriented by the coordinates."""
    if any(not isinstance(f, ReferenceFrame) for f in (frame, axes, body)):
        raise EngdynError(f"frame, axes and body are {frame!r}, {axes!r}, {body!r}: give ReferenceFrames")
    vector = isinstance(moment, Vector)
    loads = measure_numbers(moment) if vector else [as_expression(x) for x in _three(moment, "moment")]
    written = frames_of(moment) if vector else []
    moving = [*_attitude([axes, body, *written], frame), *(x for row in tensor for x in row)]
    others = [*loads, *unknowns]
    if speeds is None:
        motion = Motion(State(coordinates, [*moving, *others], moving=moving), frame)
        return motion, motion.angular_velocity(body, axes), motion.angular_velocity(axes, axes)
    rates = _kinematics(coordinates, speeds, frame, axes, body, moving)
    state = State(coordinates, [*moving, *others, *speeds], speeds, rates, moving=[*moving, *speeds])
    motion, spin = Motion(state, frame), [state.convert(w) for w in speeds]
    return motion, spin, spin if axes is body else motion.angular_velocity(axes, axes)


def _attitude(frames: Sequence[ReferenceFrame], ground: ReferenceFrame) -> list[sm.Expr]:
    """Everything that rotations and angular velocities of frames are made of."""
    spins = [spin for f in dict.fromkeys(frames) for spin in spin_steps(f, ground)]
    found = dict.fromkeys([*frames, *frames_of(*spins)])
    turns = [step for f in found for a, b in ((f, ground), (ground, f)) for step in rotation_steps(a, b)]
    return measure_numbers(*spins, *turns)


def _kinematics(
    coordinates: tuple[sm.Expr, ...],
    speeds: tuple[sm.Expr, ...],
    frame: ReferenceFrame,
    axes: ReferenceFrame,
    body: ReferenceFrame,
    moving: Iterable[sm.Expr],
) -> dict[sm.Expr, sm.Expr]:
    """Solve ω(q, q̇) = u for q̇."""
    if len(coordinates) != 3:
        raise EngdynError(
            f"{len(coordinates)} coordinates for three speeds: three angles tell the attitude; with fewer leave "
            "speeds out, the rates are the speeds then"
        )
    state = State(coordinates, [*moving, *speeds])
    spin = Motion(state, frame).angular_velocity(body, axes)
    rows = []
    for component, speed in zip(spin, speeds, strict=True):
        row = [partial(component) for partial in state.speed_partials()]
        rest: Element = component - state.convert(speed)
        for entry, key in zip(row, state.speed_keys, strict=True):
            rest = rest - entry * state.ring.generator(key)
        rows.append([*row, rest])
    found = solve(rows, 3)
    if found is None:
        raise EngdynError(
            f"the angular velocity of {body} does not tell the rates of {list(coordinates)}: orient {body} in "
            f"{frame} by three independent angles"
        )
    return {q: readable(e) for q, e in zip(coordinates, found, strict=True)}


def _load(motion: Motion, moment: Any, axes: ReferenceFrame) -> Triple:
    if isinstance(moment, Vector):
        return motion.components(moment, axes)
    return [motion.state.convert(as_expression(x)) for x in _three(moment, "moment")]


def _check_turning(inertia: list[Triple], spin: Triple, turn: Triple) -> None:
    """Axes may turn in the body only where that leaves the tensor as it is: W I − I W = 0."""
    x, y, z = (a - b for a, b in zip(spin, turn, strict=True))
    zero = x - x
    skew = [[zero, -z, y], [z, zero, -x], [-y, x, zero]]
    for i in range(3):
        for j in range(3):
            left = dot(skew[i], [row[j] for row in inertia])
            right = dot(inertia[i], [row[j] for row in skew])
            if not (left - right).is_zero():
                raise EngdynError(
                    "the body turns in these axes and its tensor changes with that: use axes fixed in the body, or a "
                    "body that is symmetric about the axis of the turn (equal moments across it, no products)"
                )
