"""The systems that deriving is timed on, each as sympy.physics.mechanics objects for all tools alike."""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import pairwise

import sympy as sm
from sympy.physics.mechanics import (
    Force,
    KanesMethod,
    LagrangesMethod,
    Particle,
    Point,
    ReferenceFrame,
    RigidBody,
    System,
    dynamicsymbols,
    inertia,
)

import engdyn as ed

#: Mass matrix and forcing vector.
Equations = tuple[sm.Matrix, sm.Matrix]


@dataclass
class Model:
    """One system, ready for every tool."""

    name: str
    coordinates: list
    frame: ReferenceFrame
    free_bodies: list
    unknowns: list
    kinetic: sm.Expr
    potential: sm.Expr
    dissipation: sm.Expr = sm.S.Zero
    forces: dict = field(default_factory=dict)
    constraints: tuple = ()


def catalogue_system(key: str) -> Model:
    """A system of the catalogue."""
    s = ed.systems.load(key)
    return Model(
        f"{key} {s.key}",
        [c.symbol for c in s.coordinates],
        s.frame,
        s.free_bodies(),
        list(s.unknowns),
        s.kinetic_energy,
        s.potential_energy,
        s.dissipation,
        s.generalized_forces,
        s.constraints,
    )


def cart_with_links(n: int) -> Model:
    """A cart on a rail with n point masses hanging in a chain, absolute angles, a force on the cart."""
    q = dynamicsymbols(f"q:{n + 1}")
    F = dynamicsymbols("F")
    g, *masses = sm.symbols(f"g m:{n + 1}", positive=True)
    lengths = sm.symbols(f"l1:{n + 1}", positive=True)
    rail, tensions = sm.Symbol("R"), sm.symbols(f"S1:{n + 1}")
    N, O = ReferenceFrame("N"), Point("O")
    O.set_vel(N, 0)
    here = O.locatenew("P0", q[0] * N.x)
    points, pulls, velocity = [here], [], [q[0].diff(), sm.S.Zero]
    kinetic, potential = masses[0] * q[0].diff() ** 2 / 2, sm.S.Zero
    height = sm.S.Zero
    for i in range(n):
        down = sm.sin(q[i + 1]) * N.x - sm.cos(q[i + 1]) * N.y
        here = here.locatenew(f"P{i + 1}", lengths[i] * down)
        points.append(here)
        pulls.append(tensions[i] * down)
        velocity = [
            velocity[0] + lengths[i] * sm.cos(q[i + 1]) * q[i + 1].diff(),
            velocity[1] + lengths[i] * sm.sin(q[i + 1]) * q[i + 1].diff(),
        ]
        height -= lengths[i] * sm.cos(q[i + 1])
        kinetic += masses[i + 1] * (velocity[0] ** 2 + velocity[1] ** 2) / 2
        potential += masses[i + 1] * g * height
    bodies = []
    for i, point in enumerate(points):
        applied = [Force(point, -masses[i] * g * N.y)] + ([Force(point, F * N.x)] if i == 0 else [])
        reactions = [Force(point, rail * N.y)] if i == 0 else [Force(point, -pulls[i - 1])]
        reactions += [Force(point, pulls[i])] if i < n else []
        bodies.append(ed.FreeBody(Particle(f"b{i}", point, masses[i]), applied, reactions))
    return Model(
        f"cart + {n} links", list(q), N, bodies, [rail, *tensions], kinetic, potential, forces={q[0]: F}
    )


def double_pendulum() -> Model:
    """Two point masses on two rods, absolute angles."""
    a, b = dynamicsymbols("a b")
    m, l, g = sm.symbols("m l g", positive=True)
    upper, lower = sm.symbols("S_1 S_2")
    N, O = ReferenceFrame("N"), Point("O")
    O.set_vel(N, 0)
    along = [sm.sin(q) * N.x - sm.cos(q) * N.y for q in (a, b)]
    P = O.locatenew("P", l * along[0])
    Q = P.locatenew("Q", l * along[1])
    bodies = [
        ed.FreeBody(
            Particle("upper", P, m),
            [Force(P, -m * g * N.y)],
            [Force(P, -upper * along[0]), Force(P, lower * along[1])],
        ),
        ed.FreeBody(Particle("lower", Q, m), [Force(Q, -m * g * N.y)], [Force(Q, -lower * along[1])]),
    ]
    kinetic = m * l**2 * (2 * a.diff() ** 2 + b.diff() ** 2 + 2 * sm.cos(a - b) * a.diff() * b.diff()) / 2
    potential = -m * g * l * (2 * sm.cos(a) + sm.cos(b))
    return Model("double pendulum", [a, b], N, bodies, [upper, lower], kinetic, potential)


def heavy_top(from_body: bool = False) -> Model:
    """A symmetric top about a fixed point in three angles, its energy by hand or as sympy gives it."""
    a, b, c = dynamicsymbols("a b c")
    m, l, A, C, g = sm.symbols("m l A C g", positive=True)
    reactions = sm.symbols("R_x R_y R_z")
    N, P, Q, B = (ReferenceFrame(name) for name in "NPQB")
    P.orient_axis(N, a, N.z)
    Q.orient_axis(P, b, P.x)
    B.orient_axis(Q, c, Q.z)
    O = Point("O")
    O.set_vel(N, 0)
    G = O.locatenew("G", l * B.z)
    tensor = inertia(Q, A, A, C)
    body = RigidBody("top", G, B, m, (tensor, G))
    load = sum((r * axis for r, axis in zip(reactions, (N.x, N.y, N.z), strict=True)), 0 * N.x)
    free = ed.FreeBody(body, [Force(G, -m * g * N.z)], [Force(O, load)])
    across = b.diff() ** 2 + (a.diff() * sm.sin(b)) ** 2
    along = c.diff() + a.diff() * sm.cos(b)
    kinetic = (A + m * l**2) * across / 2 + C * along**2 / 2
    if from_body:
        kinetic = body.kinetic_energy(N)
    name = "3-D top, T of the body" if from_body else "3-D top, T by hand"
    return Model(name, [a, b, c], N, [free], list(reactions), kinetic, m * g * l * sm.cos(b))


def mass_chain(n: int) -> Model:
    """n masses on a rail, each tied to the one before by a spring and a damper, the first to a wall."""
    x = dynamicsymbols(f"x1:{n + 1}")
    masses, stiffness = (sm.symbols(f"{letter}1:{n + 1}", positive=True) for letter in "mk")
    c, F = sm.Symbol("c", positive=True), dynamicsymbols("F")
    N, O = ReferenceFrame("N"), Point("O")
    O.set_vel(N, 0)
    stretch = [x[0], *(b - a for a, b in pairwise(x))]
    tension = [k * s + c * s.diff() for k, s in zip(stiffness, stretch, strict=True)]
    bodies = []
    for i, m in enumerate(masses):
        point = O.locatenew(f"P{i + 1}", x[i] * N.x)
        ahead = tension[i + 1] if i + 1 < n else F
        bodies.append(
            ed.FreeBody(Particle(f"b{i + 1}", point, m), [Force(point, (ahead - tension[i]) * N.x)])
        )
    kinetic = sum((m * q.diff() ** 2 for m, q in zip(masses, x, strict=True)), sm.S.Zero) / 2
    potential = sum((k * s**2 for k, s in zip(stiffness, stretch, strict=True)), sm.S.Zero) / 2
    dissipation = sum((c * s.diff() ** 2 for s in stretch), sm.S.Zero) / 2
    return Model(
        f"{n} masses in a chain", list(x), N, bodies, [], kinetic, potential, dissipation, {x[-1]: F}
    )


def doubled(body: ed.FreeBody) -> tuple[list, list]:
    """The body and its applied loads with everything twice: a mirrored pair in the eyes of Kane's method."""
    twice = Particle(body.name, body.body.point, 2 * body.body.mass)
    return [twice], [Force(load.point, 2 * load.force) for load in body.applied]


def kane_input(model: Model) -> tuple[list, list]:
    """Bodies and loads for KanesMethod; the governor's one ball stands for both."""
    bodies, loads = [], []
    for free in model.free_bodies:
        if model.name.startswith("S03") and free.name == "ball":
            more = doubled(free)
        else:
            more = [free.body], list(free.applied)
        bodies += more[0]
        loads += more[1]
    return bodies, loads


def speeds_of(model: Model) -> tuple[list, list]:
    """Generalized speeds and the kinematic equations u = q̇."""
    t, speeds = dynamicsymbols._t, list(dynamicsymbols(f"u:{len(model.coordinates)}"))
    return speeds, [u - q.diff(t) for u, q in zip(speeds, model.coordinates, strict=True)]


def kane(model: Model) -> Equations:
    """sympy's KanesMethod on the same bodies and loads."""
    speeds, kinematic = speeds_of(model)
    method = KanesMethod(model.frame, q_ind=model.coordinates, u_ind=speeds, kd_eqs=kinematic)
    method.kanes_equations(*kane_input(model))
    return method.mass_matrix, method.forcing


def system(model: Model) -> Equations:
    """sympy's System on the same bodies and loads."""
    speeds, kinematic = speeds_of(model)
    bodies, loads = kane_input(model)
    whole = System(model.frame)
    whole.q_ind, whole.u_ind, whole.kdes = model.coordinates, speeds, kinematic
    whole.add_bodies(*bodies)
    whole.add_loads(*loads)
    whole.form_eoms()
    return whole.mass_matrix, whole.forcing


def lagrangian(model: Model) -> Equations:
    """sympy's LagrangesMethod on the same energies; the rest as generalized forces."""
    t = dynamicsymbols._t
    loads = []
    for i, q in enumerate(model.coordinates):
        Q = model.forces.get(q, 0) - sm.diff(model.dissipation, q.diff(t))
        if Q != 0:  # a torque Q on a frame that turns with q does the work Q dq
            frame = ReferenceFrame(f"D{i}")
            frame.set_ang_vel(model.frame, q.diff(t) * model.frame.z)
            loads.append((frame, Q * model.frame.z))
    method = LagrangesMethod(
        model.kinetic - model.potential, model.coordinates, forcelist=loads, frame=model.frame
    )
    method.form_lagranges_equations()
    return method.mass_matrix, method.forcing


def engdyn_equations(model: Model) -> tuple[ed.EquationsOfMotion, ed.EquationsOfMotion]:
    """Both derivations of engdyn."""
    q, constraints = model.coordinates, model.constraints
    return (
        ed.newton_euler(model.free_bodies, q, model.frame, model.unknowns, constraints=constraints),
        ed.lagrange(model.kinetic, model.potential, q, model.dissipation, model.forces, constraints),
    )


def engdyn(model: Model) -> Equations:
    """Both derivations and the proof that they agree, the result turned into sympy matrices."""
    a, b = engdyn_equations(model)
    proof = ed.prove_equal(a, b)
    if not proof:
        raise AssertionError(f"{model.name}: {proof!r}")
    return b.mass_matrix, b.forcing
