"""What each cell of the matrix checks: one real test of one analysis on one system.

Every check has an oracle of its own (finite differences, an exact proof, the nonlinear equations), and every
check can be given a corrupted input, which it must not let pass.  Appendix A.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from typing import Any

import numpy as np
import sympy as sm
from scipy.spatial.transform import Rotation
from sympy.physics.vector import ReferenceFrame, dynamicsymbols

from engdyn.analysis.characteristic import characteristic_polynomial
from engdyn.analysis.damped_modes import damped_modes
from engdyn.analysis.linear import linearize
from engdyn.analysis.results import Equilibrium
from engdyn.analysis.routh import routh_table
from engdyn.analysis.stability import stability
from engdyn.course import matrix_motion as motion
from engdyn.course.failure import CORRUPTION, CheckFailure
from engdyn.modeling.equality import prove_equal
from engdyn.modeling.equations import EquationsOfMotion
from engdyn.modeling.instants import components, motion_at, rotation_matrix
from engdyn.modeling.kinematic_chain import KinematicChain
from engdyn.modeling.lagrange import lagrange
from engdyn.modeling.motion import VectorPath, path_of_point
from engdyn.system import System

__all__ = ["CHECKS"]

STEP = 3e-5
"""Of finite differences in time [s]; their error is of second order."""


def _compare(found: Any, expected: Any, tolerance: float, what: str) -> None:
    """Raise unless two arrays agree on the scale of their largest entry."""
    found, expected = np.asarray(found), np.asarray(expected)
    scale = float(np.max(np.abs([found, expected]), initial=1e-3))
    error = float(np.max(np.abs(found - expected), initial=0.0)) / scale
    if not error <= tolerance:
        raise CheckFailure(f"{what} is {error:.2g} off")


def kinematics(system: System, corrupt: bool) -> str:
    """Velocity and acceleration of every mass center and body, against differences of a motion in time.

    Corrupted, the rates of the coordinates are one percent too large.
    """
    ground, bodies, moments = system.frame, system.free_bodies(), _moments(system)
    now = moments[1]
    if corrupt:
        now = {name: x * (CORRUPTION if name.endswith("_d") else 1.0) for name, x in now.items()}
    for body in bodies:
        path = path_of_point(body.center, ground)
        chain = KinematicChain(ground, origin=path.start)
        chain.add(body.body)
        places = _places(path, ground, moments)
        velocity = components(chain.velocity(body.center), ground, now)
        _compare(velocity, (places[2] - places[0]) / (2 * STEP), 1e-5, f"the velocity of {body.name}")
        acceleration = components(chain.acceleration(body.center), ground, now)
        second = (places[2] - 2 * places[1] + places[0]) / STEP**2
        _compare(acceleration, second, 1e-5, f"the acceleration of {body.name}")
        if body.turns:
            _compare_turning(chain, body.body.frame, moments, now, body.name)
    return f"{len(bodies)} {'body' if len(bodies) == 1 else 'bodies'} followed"


def _moments(system: System) -> list[dict[str, float]]:
    """Numbers for everything at three instants of a smooth motion."""
    t, random = dynamicsymbols._t, np.random.default_rng(7)
    moving = [*(c.symbol for c in system.coordinates), *(i.symbol for i in system.inputs)]
    scales = [0.1 * (c.bounds[1] if c.bounds else 1.0) for c in system.coordinates] + [0.1] * len(
        system.inputs
    )
    paths: dict[Any, sm.Expr] = {}
    for q, scale in zip(moving, scales, strict=True):
        a, b, c = (float(x) for x in random.uniform(0.5, 1.5, 3))
        paths[q] = scale * (a + b * sm.sin(c * t))
    rest = {s.name: 0.0 for s in system.unknowns}
    times = (0.7 - STEP, 0.7, 0.7 + STEP)
    return [system.values() | rest | motion_at(paths, x) | {t.name: x} for x in times]


def _places(path: VectorPath, ground: ReferenceFrame, moments: list[dict[str, float]]) -> list[np.ndarray]:
    """Where a point is at three instants, counted from where its path starts at the second.

    A start with a given velocity (a car on a road) travels as the trapezoidal rule says.
    """
    given = [components(path.start._vel_dict[ground], ground, at) for at in moments]
    travel = [-STEP * (given[0] + given[1]) / 2, np.zeros(3), STEP * (given[1] + given[2]) / 2]
    steps = [[components(step, ground, at) for step in path.steps] for at in moments]
    return [np.sum([way, *vectors], axis=0) for way, vectors in zip(travel, steps, strict=True)]


def _compare_turning(
    chain: KinematicChain,
    frame: ReferenceFrame,
    moments: list[dict[str, float]],
    now: Mapping[str, float],
    name: str,
) -> None:
    """ω and α of a frame against its rotations from one instant to the next, as rotation vectors."""
    ground = chain.ground
    before, middle, after = (Rotation.from_matrix(rotation_matrix(frame, ground, at)) for at in moments)
    first, second = (middle * before.inv()).as_rotvec(), (after * middle.inv()).as_rotvec()
    for vector, expected, what in (
        (chain.angular_velocity(frame), (first + second) / (2 * STEP), "velocity"),
        (chain.angular_acceleration(frame), (second - first) / STEP**2, "acceleration"),
    ):
        _compare(components(vector, ground, now), expected, 1e-5, f"the angular {what} of {name}")


def derivation(system: System, corrupt: bool) -> str:
    """Newton–Euler and Lagrange proved equal; corrupted, the kinetic energy is one percent too large."""
    newton = system.newton()
    energy = system.kinetic_energy * (sm.Rational(101, 100) if corrupt else 1)
    symbols = [c.symbol for c in system.coordinates]
    proof = prove_equal(
        newton,
        lagrange(
            energy,
            system.potential_energy,
            symbols,
            system.dissipation,
            system.generalized_forces,
            system.constraints,
        ),
    )
    if not proof:
        raise CheckFailure(f"{proof.verdict}: {proof.method}")
    count = len(system.unknowns)
    return f"proved, {count} {'reaction' if count == 1 else 'reactions'} eliminated"


def equilibria(system: System, corrupt: bool) -> str:
    """The nonlinear equations give, at every equilibrium, the accelerations it is said to have.

    Corrupted, each state is moved by one percent of a coordinate.
    """
    found = system.equilibria()
    if not len(found):
        raise CheckFailure("no equilibrium found in the region")
    for number, state in enumerate(found, 1):
        eom, regular = state.regular or (system.equations, state)
        moved = _moved(regular, found.neutral) if corrupt else regular
        _compare_accelerations(eom, moved, f"equilibrium {number}")
    kept = {tuple(np.round(state.q, 9)) + tuple(np.round(state.speeds, 9)) for state in found}
    if len(kept) != len(found):
        raise CheckFailure("an equilibrium is listed twice")
    return f"{len(found)}, {'certified' if found.certified else f'{len(found.undecided)} boxes undecided'}"


def _moved(state: Equilibrium, neutral: Any) -> Equilibrium:
    """The state with its first coordinate that matters changed."""
    q = np.array(state.q)
    at = next((i for i, name in enumerate(state.names) if name not in neutral), 0)
    q[at] += (CORRUPTION - 1.0) * max(abs(q[at]), 0.1)
    return replace(state, q=q)


def _compare_accelerations(eom: EquationsOfMotion, state: Equilibrium, what: str) -> None:
    """Compare u̇ of the equations with that of the state, on the scale of what one percent of a radian does."""

    def at(q: np.ndarray) -> np.ndarray:
        return eom.accelerations(q, state.speeds, state.values, state.inputs)

    scale = max(
        float(np.max(np.abs(at(state.q + step) - at(state.q)))) for step in 0.01 * np.eye(len(state.q))
    )
    error = np.max(np.abs(at(state.q) - state.accelerations)) / max(scale, 1e-9)
    if not error < 1e-6:
        raise CheckFailure(f"{what}: the accelerations are {error:.2g} off")


def small_motion(system: System, corrupt: bool) -> str:
    """State matrix of every equilibrium against differences of the nonlinear equations, eigenvalues against Routh.

    Corrupted, it belongs to parameters that are up to one percent larger, each by another part of it.
    """
    verdicts = []
    for number, state in enumerate(system.equilibria(), 1):
        parts = np.linspace(1.0, CORRUPTION if corrupt else 1.0, len(state.values))
        values = {name: x * float(part) for (name, x), part in zip(state.values.items(), parts, strict=True)}
        linear = linearize(system.equations, state, values)
        what = f"the state matrix of equilibrium {number}"
        _compare(linear.state_matrix, _slopes(system, state), 1e-5, what)
        judged = stability(linear)
        growing = int(np.sum(judged.eigenvalues.real > 10 * judged.errors))
        counted = routh_table(characteristic_polynomial(linear)).right_half_plane
        if counted != growing:
            raise CheckFailure(f"equilibrium {number}: {growing} eigenvalues grow, Routh counts {counted}")
        verdicts.append(judged.verdict)
    if not verdicts:
        raise CheckFailure("no equilibrium to linearize about")
    told = {verdict: verdicts.count(verdict) for verdict in verdicts}
    return ", ".join(f"{count} {verdict}" for verdict, count in told.items())


def _slopes(system: System, state: Equilibrium) -> np.ndarray:
    """∂ẋ/∂x by central differences whose steps are halved once (Richardson), shape (n + m, n + m)."""
    eom, state = state.regular or (system.equations, state)
    derivative = eom.function(state.values)
    x = np.concatenate([state.q, state.speeds])

    def columns(size: float) -> Iterator[np.ndarray]:
        for step in size * np.diag(1.0 + np.abs(x)):
            difference = derivative(0.0, x + step, state.inputs) - derivative(0.0, x - step, state.inputs)
            yield difference / (2 * np.max(step))

    coarse, fine = (np.column_stack(list(columns(size))) for size in (2e-4, 1e-4))
    return (4 * fine - coarse) / 3


def modes_of(system: System, corrupt: bool) -> str:
    """Modes of the first equilibrium, the first stable one where there is one, as solutions of the equations.

    Every right and left shape must satisfy the differences of the nonlinear equations, and shapes of different
    modes must be orthogonal. Corrupted, one component of the first shape is one percent larger.
    """
    states = system.equilibria()
    judged = [(state, linearize(system.equations, state)) for state in states]
    state, linear = next((s for s in judged if stability(s[1]).stable), judged[0])
    found, A = damped_modes(linear), _slopes(system, state)
    right, left, values = found.state_shapes.copy(), found.left_shapes, found.eigenvalues
    if corrupt and len(values):
        right[np.argmax(np.abs(right[:, 0])), 0] *= CORRUPTION
    elif corrupt:
        A = CORRUPTION * A
    for vectors, matrix, what in ((right, A, "shapes"), (left, A.T, "left shapes")):
        size = np.linalg.norm(A, 2) * np.linalg.norm(vectors, axis=0)
        error = np.max(np.linalg.norm(matrix @ vectors - vectors * values, axis=0) / size, initial=0.0)
        if not error < 1e-6:
            raise CheckFailure(f"the {what} do not solve the equations of small motion: {error:.2g} off")
    _compare(left.T @ right, np.eye(len(values)), 1e-6, "the product of left and right shapes")
    total = np.sum(found.real_eigenvalues) + 2 * np.sum(values.real)
    if not abs(total - np.trace(A)) < 1e-6 * np.linalg.norm(A):
        raise CheckFailure("the eigenvalues do not sum up to the trace of the state matrix")
    return f"{len(values)} modes, {len(found.real_eigenvalues)} real eigenvalues"


CHECKS: dict[str, tuple[str, Callable[[System, bool], str] | None]] = {
    "kinematics": ("Kinematics", kinematics),
    "derivation": ("Newton = Lagrange", derivation),
    "equilibria": ("Equilibria", equilibria),
    "stability": ("Stability", small_motion),
    "modes": ("Modes", modes_of),
    "response": ("Frequency response", motion.response),
    "simulation": ("Simulation", motion.simulation),
    "measured": ("Measured data", motion.measured),
}
"""Analyses in the order of the course: name → (heading, check); an analysis without a check is not built yet."""
