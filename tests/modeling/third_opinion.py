"""Models in the language of sympy.physics.mechanics, for our two routes and for sympy's own two."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
import sympy as sm
from sympy.physics.mechanics import (
    Force,
    KanesMethod,
    LagrangesMethod,
    Particle,
    Point,
    ReferenceFrame,
    RigidBody,
    Torque,
    dynamicsymbols,
    inertia,
)

import engdyn as ed

t = dynamicsymbols._t
sin, cos = sm.sin, sm.cos


@dataclass
class Model:
    """A system described twice, with a range of states to look at."""

    coordinates: list[sm.Expr]
    kinetic: sm.Expr
    potential: sm.Expr
    bodies: list[ed.FreeBody]
    frame: ReferenceFrame
    unknowns: list[sm.Symbol] = field(default_factory=list)
    dissipation: sm.Expr = sm.S.Zero
    forces: dict[sm.Expr, sm.Expr] = field(default_factory=dict)
    constraints: list[sm.Expr] = field(default_factory=list)
    spread: float = 1.0
    further_bodies: list[ed.FreeBody] = field(default_factory=list)
    ranges: dict[str, tuple[float, float]] = field(default_factory=dict)
    defaults: dict[sm.Expr, tuple] = field(default_factory=dict)

    def newton(self) -> ed.EquationsOfMotion:
        return ed.newton_euler(
            self.bodies, self.coordinates, self.frame, self.unknowns, constraints=self.constraints
        )

    def lagrange(self) -> ed.EquationsOfMotion:
        return ed.lagrange(
            self.kinetic, self.potential, self.coordinates, self.dissipation, self.forces, self.constraints
        )


def from_catalogue(key: str) -> Model:
    system = ed.systems.load(key)
    return Model(
        [c.symbol for c in system.coordinates],
        system.kinetic_energy,
        system.potential_energy,
        system.free_bodies(),
        system.frame,
        list(system.unknowns),
        system.dissipation,
        system.generalized_forces,
    )


def governor() -> Model:
    """S03; for sympy the second ball has to be there in person."""
    from engdyn.systems import s03_flyball_governor as s03

    model = from_catalogue("S03")
    ball = model.bodies[0]
    mirrored = ReferenceFrame("A2")
    mirrored.orient_axis(s03.ground, s03.drive + sm.pi, s03.ground.z)
    pivot = Point("P2")
    pivot.set_vel(s03.ground, 0)
    along = sin(s03.theta) * mirrored.x - cos(s03.theta) * mirrored.z
    outward = cos(s03.theta) * mirrored.x + sin(s03.theta) * mirrored.z
    center = pivot.locatenew("B2", s03.l * along)
    weight = Force(center, -s03.m * s03.g * s03.ground.z)
    pin = Force(center, -s03.c_p * s03.theta_d / (2 * s03.l) * outward)
    model.further_bodies = [ed.FreeBody(Particle("ball 2", center, s03.m), [weight, pin])]
    assert len(ball.applied) == 2
    return model


def chain(links: int, cart: bool) -> Model:
    """Links of a pendulum, each with mass and inertia, hanging from a cart or from a fixed point."""
    frame, origin = ReferenceFrame("N"), Point("O")
    origin.set_vel(frame, 0)
    x, F = dynamicsymbols("x F")
    angles = dynamicsymbols(f"theta1:{links + 1}")
    g, M, c = sm.symbols("g M c", positive=True)
    hinge = origin.locatenew("H0", x * frame.x) if cart else origin
    hinge_velocity = [x.diff(t), sm.S.Zero] if cart else [sm.S.Zero, sm.S.Zero]
    hinge_height, T, V, D = sm.S.Zero, M * x.diff(t) ** 2 / 2 if cart else sm.S.Zero, sm.S.Zero, sm.S.Zero
    pulls = [sm.symbols(f"H_x{i} H_y{i}") for i in range(links)]
    bodies, unknowns = [], []
    if cart:
        N = sm.Symbol("N")
        loads = [Force(hinge, F * frame.x), Force(hinge, -M * g * frame.y)]
        pull = Force(hinge, -pulls[0][0] * frame.x - pulls[0][1] * frame.y)
        bodies.append(ed.FreeBody(Particle("cart", hinge, M), loads, [Force(hinge, N * frame.y), pull]))
        unknowns.append(N)
    for i, angle in enumerate(angles):
        m, l, a, J = sm.symbols(f"m{i + 1} l{i + 1} a{i + 1} J{i + 1}", positive=True)
        rod = ReferenceFrame(f"B{i}")
        rod.orient_axis(frame, angle, frame.z)
        center, end = hinge.locatenew(f"G{i}", -a * rod.y), hinge.locatenew(f"H{i + 1}", -l * rod.y)
        before = angles[i - 1].diff(t) if i else 0
        couple = c * (angle.diff(t) - before)
        following = c * (angles[i + 1].diff(t) - angle.diff(t)) if i + 1 < links else 0
        reactions = [Force(hinge, pulls[i][0] * frame.x + pulls[i][1] * frame.y)]
        if i + 1 < links:
            reactions.append(Force(end, -pulls[i + 1][0] * frame.x - pulls[i + 1][1] * frame.y))
        loads = [Force(center, -m * g * frame.y), Torque(rod, (following - couple) * frame.z)]
        body = RigidBody(f"rod {i + 1}", center, rod, m, (inertia(rod, 0, 0, J), center))
        bodies.append(ed.FreeBody(body, loads, reactions))
        unknowns += pulls[i]
        rate = angle.diff(t)
        velocity = [hinge_velocity[0] + a * cos(angle) * rate, hinge_velocity[1] + a * sin(angle) * rate]
        T += m * (velocity[0] ** 2 + velocity[1] ** 2) / 2 + J * rate**2 / 2
        V += m * g * (hinge_height - a * cos(angle))
        D += c * (rate - before) ** 2 / 2
        hinge_velocity = [
            hinge_velocity[0] + l * cos(angle) * rate,
            hinge_velocity[1] + l * sin(angle) * rate,
        ]
        hinge_height, hinge = hinge_height - l * cos(angle), end
    coordinates = [x, *angles] if cart else list(angles)
    return Model(coordinates, T, V, bodies, frame, unknowns, D, {x: F} if cart else {})


def heavy_top() -> Model:
    """A symmetric top on a fixed point, Euler angles precession, nutation, spin."""
    psi, theta, phi = dynamicsymbols("psi theta phi")
    m, l, g, A, C = sm.symbols("m l g A C", positive=True)
    R = sm.symbols("R_x R_y R_z")
    frame, body, pivot = ReferenceFrame("N"), ReferenceFrame("B"), Point("O")
    body.orient_body_fixed(frame, (psi, theta, phi), "ZXZ")
    pivot.set_vel(frame, 0)
    center = pivot.locatenew("G", l * body.z)
    rigid = RigidBody("top", center, body, m, (inertia(body, A, A, C), center))
    support = sum((r * e for r, e in zip(R, frame, strict=True)), 0 * frame.x)
    free = ed.FreeBody(rigid, [Force(center, -m * g * frame.z)], [Force(pivot, support)])
    psi_d, theta_d, phi_d = (q.diff(t) for q in (psi, theta, phi))
    T = (A + m * l**2) * (theta_d**2 + (psi_d * sin(theta)) ** 2) / 2 + C * (
        phi_d + psi_d * cos(theta)
    ) ** 2 / 2
    ranges = {"theta": (0.4, 2.6)}
    return Model([psi, theta, phi], T, m * g * l * cos(theta), [free], frame, list(R), ranges=ranges)


def castor() -> Model:
    """S13: shimmy of a trailing castor, one nonholonomic constraint."""
    y, psi, F, M = dynamicsymbols("y psi F M")
    m_p, m, J, a, b = sm.symbols("m_p m J_G a b", positive=True)
    k_y, c_y, k_p, c_p = sm.symbols("k_y c_y k_p c_p", nonnegative=True)
    v = sm.Symbol("v", real=True)
    P_x, P_y, lam, X = sm.symbols("P_x P_y lam X")
    y_d, psi_d = y.diff(t), psi.diff(t)
    frame, arm, origin = ReferenceFrame("N"), ReferenceFrame("A"), Point("O")
    arm.orient_axis(frame, psi, frame.z)
    origin.set_vel(frame, 0)
    pin = origin.locatenew("P", v * t * frame.x + y * frame.y)
    center, wheel = pin.locatenew("G", -b * arm.x), pin.locatenew("C", -a * arm.x)
    force = P_x * frame.x + P_y * frame.y
    carriage = ed.FreeBody(
        Particle("carriage", pin, m_p),
        [Force(pin, (F - k_y * y - c_y * y_d) * frame.y)],
        [Force(pin, -force), Force(pin, X * frame.x)],
    )
    body = RigidBody("castor", center, arm, m, (inertia(arm, 0, 0, J), center))
    couple = Torque(arm, (M - k_p * psi - c_p * psi_d) * frame.z)
    arm_body = ed.FreeBody(body, [couple], [Force(pin, force), Force(wheel, lam * arm.y)])
    T = m_p * (v**2 + y_d**2) / 2 + J * psi_d**2 / 2
    T += m * ((v + b * sin(psi) * psi_d) ** 2 + (y_d - b * cos(psi) * psi_d) ** 2) / 2
    return Model(
        [y, psi],
        T,
        k_y * y**2 / 2 + k_p * psi**2 / 2,
        [carriage, arm_body],
        frame,
        [P_x, P_y, lam, X],
        c_y * y_d**2 / 2 + c_p * psi_d**2 / 2,
        {y: F, psi: M},
        [y_d * cos(psi) - v * sin(psi) - a * psi_d],
    )


def press() -> Model:
    """S01: slider-crank press, energies from the formulas of its definition, three free bodies."""
    theta, M_m, F_p = dynamicsymbols("theta M_m F_p")
    names = "r L a_c b_r m_c J_O m_r J_r m_s k_s x_0 c_g c_b g"
    r, L, a_c, b_r, m_c, J_O, m_r, J_r, m_s, k_s, x_0, c_g, c_b, g = sm.symbols(names, positive=True)
    theta_d, root = theta.diff(t), sm.sqrt(1 - (r * sin(theta) / L) ** 2)
    slope = -r * sin(theta) - L * (r / L * sin(theta)) * (r * cos(theta) / (L * root))  # dx_B/dtheta
    swing = r * cos(theta) / (L * root)  # dphi/dtheta
    along = -r * sin(theta) - b_r * (r / L * sin(theta)) * swing
    T = J_O + m_r * (along**2 + ((1 - b_r / L) * r * cos(theta)) ** 2) + J_r * swing**2 + m_s * slope**2
    x_B = r * cos(theta) + L * root
    V = m_c * g * a_c * sin(theta) + m_r * g * (1 - b_r / L) * r * sin(theta) + k_s * (x_B - x_0) ** 2 / 2
    frame, crank, rod, O = ReferenceFrame("N"), ReferenceFrame("C"), ReferenceFrame("R"), Point("O")
    O.set_vel(frame, 0)
    crank.orient_axis(frame, theta, frame.z)
    sine = r / L * sin(theta)
    rod.orient_explicit(frame, sm.Matrix([[root, sine, 0], [-sine, root, 0], [0, 0, 1]]))  # turned by -phi
    rod.set_ang_vel(frame, -swing * theta_d * frame.z)
    A, B = O.locatenew("A", r * crank.x), O.locatenew("B", x_B * frame.x)
    G_c, G_r = O.locatenew("G_c", a_c * crank.x), A.locatenew("G_r", b_r * rod.x)
    unknowns = sm.symbols("O_x O_y A_x A_y B_x B_y N")
    O_x, O_y, A_x, A_y, B_x, B_y, N = unknowns
    at_A, at_B = A_x * frame.x + A_y * frame.y, B_x * frame.x + B_y * frame.y
    bodies = [
        ed.FreeBody(
            RigidBody("crank", G_c, crank, m_c, (inertia(crank, 0, 0, J_O - m_c * a_c**2), G_c)),
            [Force(G_c, -m_c * g * frame.y), Torque(crank, (M_m - c_b * theta_d) * frame.z)],
            [Force(O, O_x * frame.x + O_y * frame.y), Force(A, -at_A)],
        ),
        ed.FreeBody(
            RigidBody("rod", G_r, rod, m_r, (inertia(rod, 0, 0, J_r), G_r)),
            [Force(G_r, -m_r * g * frame.y)],
            [Force(A, at_A), Force(B, -at_B)],
        ),
        ed.FreeBody(
            Particle("ram", B, m_s),
            [
                Force(B, (F_p - k_s * (x_B - x_0) - c_g * slope * theta_d) * frame.x),
                Force(B, -m_s * g * frame.y),
            ],
            [Force(B, at_B), Force(B, N * frame.y)],
        ),
    ]
    D = c_b * theta_d**2 / 2 + c_g * (slope * theta_d) ** 2 / 2
    ranges = {"r": (0.2, 0.6), "L": (0.9, 1.5), "a_c": (0.01, 0.1)}
    forces = {theta: M_m + F_p * slope}
    return Model([theta], T * theta_d**2 / 2, V, bodies, frame, list(unknowns), D, forces, ranges=ranges)


def satellite() -> Model:
    """S22: a rigid body on a circular orbit, Euler's equations against energies."""
    psi, theta, phi = dynamicsymbols("psi theta phi")
    tau = dynamicsymbols("tau_1:4")
    J = sm.symbols("J_1:4", positive=True)
    n, c = sm.Symbol("n", real=True), sm.Symbol("c", nonnegative=True)
    inertial, orbit, body = ReferenceFrame("N"), ReferenceFrame("O"), ReferenceFrame("B")
    orbit.orient_axis(inertial, -n * t, inertial.y)
    body.orient_body_fixed(orbit, (psi, theta, phi), "ZYX")
    center = Point("G")
    center.set_vel(inertial, 0)
    earth = [orbit.z.dot(e) for e in body]
    pull = [J[i] * e * b for i, (e, b) in enumerate(zip(earth, body, strict=True))]
    gradient = 3 * n**2 * orbit.z.cross(sum(pull, 0 * body.x))
    damper = -c * body.ang_vel_in(orbit)
    control = sum((T * e for T, e in zip(tau, body, strict=True)), 0 * body.x)
    rigid = RigidBody("satellite", center, body, sm.Symbol("m", positive=True), (inertia(body, *J), center))
    free = ed.FreeBody(rigid, [Torque(body, gradient), Torque(body, damper), Torque(body, control)])
    psi_d, theta_d, phi_d = (q.diff(t) for q in (psi, theta, phi))
    w = [
        phi_d - psi_d * sin(theta) - n * cos(theta) * sin(psi),
        theta_d * cos(phi)
        + psi_d * sin(phi) * cos(theta)
        - n * (cos(phi) * cos(psi) + sin(phi) * sin(theta) * sin(psi)),
        -theta_d * sin(phi)
        + psi_d * cos(phi) * cos(theta)
        - n * (-sin(phi) * cos(psi) + cos(phi) * sin(theta) * sin(psi)),
    ]
    T = sum(Ji * wi**2 for Ji, wi in zip(J, w, strict=True)) / 2
    V = (
        3
        * n**2
        / 2
        * (J[0] * sin(theta) ** 2 + J[1] * (sin(phi) * cos(theta)) ** 2 + J[2] * (cos(phi) * cos(theta)) ** 2)
    )
    D = c * (psi_d**2 + theta_d**2 + phi_d**2 - 2 * phi_d * psi_d * sin(theta)) / 2
    Q = {
        psi: -tau[0] * sin(theta) + tau[1] * sin(phi) * cos(theta) + tau[2] * cos(phi) * cos(theta),
        theta: tau[1] * cos(phi) - tau[2] * sin(phi),
        phi: tau[0],
    }
    return Model([psi, theta, phi], T, V, [free], inertial, [], D, Q)


MODELS = {
    "S03": governor,
    "S07": lambda: from_catalogue("S07"),
    "S23": lambda: from_catalogue("S23"),
    "double pendulum": lambda: chain(2, cart=False),
    "cart with 3 links": lambda: chain(3, cart=True),
    "heavy top": heavy_top,
    "S13": castor,
    "S01": press,
    "S22": satellite,
}


class Sample:
    """Random numbers for everything that occurs in a model; prescribed motions with their derivatives."""

    def __init__(self, model: Model, eom: ed.EquationsOfMotion, seed: int):
        source = np.random.default_rng(seed)
        self.q = [source.uniform(*model.ranges.get(q.func.__name__, (-1.2, 1.2))) for q in model.coordinates]
        self.u = list(source.uniform(-1.5, 1.5, len(eom.speeds)))
        self.values = {p.name: source.uniform(*model.ranges.get(p.name, (0.5, 2.0))) for p in eom.parameters}
        self.inputs = {w.func.__name__: tuple(source.uniform(-1, 1, 3)) for w in eom.inputs}
        self.time = source.uniform(0, 2)

    def known(self, model: Model, eom: ed.EquationsOfMotion) -> list[dict[sm.Expr, float]]:
        """Substitutions, derivatives of higher order first."""
        orders = [
            {(w.diff(t, k) if k else w): self.inputs[w.func.__name__][k] for w in eom.inputs}
            for k in (2, 1, 0)
        ]
        return [*orders, {p: self.values[p.name] for p in eom.parameters}, {t: self.time}]


def kane(model: Model, eom: ed.EquationsOfMotion, samples: list[Sample]) -> list[np.ndarray]:
    """Accelerations of the independent speeds by sympy's KanesMethod."""
    q = model.coordinates
    speeds = list(dynamicsymbols(" ".join(f"u_{e.func.__name__}" for e in q) + " u_"))[: len(q)]
    names = [u.expr for u in eom.speeds]
    independent = [speeds[q.index(e)] for e in names]
    dependent = [u for u in speeds if u not in independent]
    kinematic = [u - e.diff(t) for e, u in zip(q, speeds, strict=True)]
    rates = {e.diff(t): u for e, u in zip(q, speeds, strict=True)}
    extra = {}
    if dependent:
        extra = {
            "u_dependent": dependent,
            "velocity_constraints": [c.subs(rates) for c in model.constraints],
        }
    method = KanesMethod(model.frame, q, independent, kd_eqs=kinematic, **extra)
    free = [*model.bodies, *model.further_bodies]
    method.kanes_equations([f.body for f in free], [load for f in free for load in f.applied])
    matrices = [method.mass_matrix, method.forcing]
    return _solved(model, eom, samples, matrices, rates, [*independent, *dependent])


def lagranges_method(model: Model, eom: ed.EquationsOfMotion, samples: list[Sample]) -> list[np.ndarray]:
    """Accelerations by sympy's LagrangesMethod (with multipliers), damping and forces added to it."""
    q, c = model.coordinates, len(model.constraints)
    method = LagrangesMethod(model.kinetic - model.potential, q, nonhol_coneqs=model.constraints or None)
    method.form_lagranges_equations()
    n = len(q)
    mass, forcing = method.mass_matrix_full[n:, n:], method.forcing_full[n:, :]
    added = [model.forces.get(e, 0) - sm.sympify(model.dissipation).diff(e.diff(t)) for e in q]
    forcing = forcing + sm.Matrix([*added, *([0] * c)])
    return _solved(model, eom, samples, [mass, forcing], {}, [])


def _solved(model, eom, samples, matrices, rates, speeds) -> list[np.ndarray]:
    """Solve sympy's M a = f at each sample, q' taken from our kinematics; the independent accelerations."""
    q = model.coordinates
    plain = [sm.Dummy() for _ in range(2 * len(q))]
    known = {e.diff(t): d for e, d in zip(q, plain[len(q) :], strict=True)}
    if rates:
        known |= {rates[e.diff(t)]: d for e, d in zip(q, plain[len(q) :], strict=True)}
    at = dict(zip(q, plain[: len(q)], strict=True))
    order = [(w, k) for k in (2, 1, 0) for w in eom.inputs]
    given = [sm.Dummy() for _ in order]
    inputs = [
        {(w.diff(t, k) if k else w): d for (w, k), d in zip(order, given, strict=True) if k == o}
        for o in (2, 1, 0)
    ]
    parameters = list(eom.parameters)
    arguments = [*plain, *given, *parameters, t]
    functions = []
    for matrix in matrices:
        for substitution in (*inputs[:2], known, inputs[2], at):
            matrix = matrix.xreplace(substitution)
        functions.append(sm.lambdify(arguments, matrix, cse=True))
    found = []
    f_rates = eom.compiled("math")
    for s in samples:
        numbers = [*s.q, *s.u, *(s.values[p.name] for p in parameters)]
        numbers += [v for w in eom.inputs for v in s.inputs[w.func.__name__]] + [s.time]
        m = len(eom.speeds)
        q_dot = f_rates(*numbers)[m * m + m :]
        values = [*s.q, *q_dot, *(s.inputs[w.func.__name__][k] for w, k in order)]
        values += [*(s.values[p.name] for p in parameters), s.time]
        M, f = (np.array(fn(*values), dtype=float) for fn in functions)
        solution = np.linalg.solve(M, f).ravel()
        if speeds:
            found.append(solution[:m])
        else:
            found.append(solution[[q.index(u.expr) for u in eom.speeds]])
    return found
