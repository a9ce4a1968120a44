"""Small systems for the tests of the analyses, each with an oracle that knows nothing of engdyn.

Definitions of numbered systems are those of the catalogue; the oracle differentiates the energies with
sympy itself and looks for zeros by brute force.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from math import pi

import numpy as np
import sympy as sm
from scipy.optimize import brentq
from scipy.optimize import root as scipy_root
from sympy.core.function import AppliedUndef
from sympy.physics.mechanics import dynamicsymbols

import engdyn as ed

T = dynamicsymbols._t


@dataclass
class Case:
    """Energies of a system, default values, and the region of its equilibria."""

    name: str
    coordinates: Sequence[sm.Expr]
    kinetic: sm.Expr
    potential: sm.Expr
    values: dict[str, float]
    bounds: dict[str, tuple[float, float]]
    dissipation: sm.Expr = sm.S.Zero
    forces: dict[sm.Expr, sm.Expr] = field(default_factory=dict)
    constraints: Sequence[sm.Expr] = ()
    motion: dict[sm.Expr, sm.Expr] = field(default_factory=dict)

    def __post_init__(self) -> None:
        energies = self.kinetic, self.potential, list(self.coordinates), self.dissipation
        self.eom = ed.lagrange(*energies, self.forces, self.constraints)

    def __repr__(self) -> str:
        return self.name

    @property
    def names(self) -> list[str]:
        return [q.func.__name__ for q in self.coordinates]

    def generalized_force(
        self, values: dict[str, float], **inputs: float
    ) -> Callable[[np.ndarray], np.ndarray]:
        """∂T/∂q − ∂V/∂q − ∂D/∂q̇ + Q at rest, from the energies, as a function of q."""
        rates = [q.diff(T) for q in self.coordinates]
        slope = [
            sm.diff(self.kinetic - self.potential, q) - sm.diff(self.dissipation, r) + self.forces.get(q, 0)
            for q, r in zip(self.coordinates, rates, strict=True)
        ]
        moving = {d for e in slope for d in sm.sympify(e).atoms(sm.Derivative)}
        known = {**dict.fromkeys(moving, sm.S.Zero), **self.motion}
        plain = {q: sm.Symbol(f"q_{i}") for i, q in enumerate(self.coordinates)}
        expressions = []
        for e in slope:
            e = sm.sympify(e).xreplace(known).xreplace(plain)
            e = e.xreplace({f: inputs.get(f.func.__name__, sm.S.Zero) for f in e.atoms(AppliedUndef)})
            expressions.append(e.xreplace({s: values[s.name] for s in e.free_symbols if s.name in values}))
        function = sm.lambdify(list(plain.values()), expressions, "numpy")
        return lambda q: np.array([float(x) for x in function(*q)])

    def inertia(self, values: dict[str, float]) -> Callable[[np.ndarray], np.ndarray]:
        """det ∂²T/∂q̇², from the energies, as a function of q."""
        rates = [q.diff(T) for q in self.coordinates]
        plain = {q: sm.Symbol(f"q_{i}") for i, q in enumerate(self.coordinates)}
        mass = sm.hessian(
            self.kinetic.xreplace({r: sm.Symbol(f"u_{r}") for r in rates}),
            [sm.Symbol(f"u_{r}") for r in rates],
        )
        determinant = mass.det().xreplace(plain)
        known = {s: values[s.name] for s in determinant.free_symbols if s.name in values}
        function = sm.lambdify(list(plain.values()), determinant.xreplace(known), "numpy")
        return lambda q: float(function(*q))

    def brute_force(self, values: dict[str, float], starts: int = 13, **inputs: float) -> np.ndarray:
        """All zeros that a dense grid of starts finds in the region, sorted, shape (number, n).

        Where the mass matrix is singular the coordinates fail: a zero there is no equilibrium.
        """
        force, inertia = self.generalized_force(values, **inputs), self.inertia(values)
        region = [self.bounds.get(n, (-pi, pi)) for n in self.names]
        if len(region) == 1:
            found = _sign_changes(lambda x: force([x])[0], *region[0])
        else:
            grids = [np.linspace(low, high, starts) + 1e-3 * (high - low) for low, high in region]
            found = [_polished(force, np.array(start)) for start in itertools.product(*grids)]
        typical = inertia([0.1234] * len(region))
        regular = [x for x in found if x is not None and abs(inertia(x)) > 1e-9 * typical]
        return distinct(regular, region)


def _sign_changes(function: Callable[[float], float], low: float, high: float) -> list[np.ndarray]:
    grid = np.linspace(low, high, 4001)
    values = np.array([function(x) for x in grid])
    values[np.abs(values) < 1e-12 * np.max(np.abs(values))] = 0.0
    found = [np.array([x]) for x, v in zip(grid, values, strict=True) if v == 0.0]
    for i in range(len(grid) - 1):
        if values[i] * values[i + 1] < 0.0:
            found.append(np.array([brentq(function, grid[i], grid[i + 1], xtol=1e-14)]))
    return found


def _polished(function: Callable[[np.ndarray], np.ndarray], start: np.ndarray) -> np.ndarray | None:
    answer = scipy_root(function, start, tol=1e-13)
    scale = 1.0 + np.max(np.abs(function(start)))
    return answer.x if np.max(np.abs(function(answer.x))) < 1e-9 * scale else None


def distinct(found: Sequence[np.ndarray], region: Sequence[tuple[float, float]]) -> np.ndarray:
    """Zeros in the region, each once; a full turn is one place, (−π, π]."""
    kept: list[np.ndarray] = []
    for x in found:
        x = np.array(x, dtype=float)
        for i, (low, high) in enumerate(region):
            if abs(high - low - 2 * pi) < 1e-9:
                x[i] = high - np.mod(high - x[i], 2 * pi)
                if x[i] - low < 1e-7:
                    x[i] = high
        inside = all(low - 1e-9 <= y <= high + 1e-9 for y, (low, high) in zip(x, region, strict=True))
        if inside and not any(np.allclose(x, y, atol=1e-6) for y in kept):
            kept.append(x)
    return np.array(sorted(kept, key=lambda y: tuple(np.round(y, 6)))).reshape(-1, len(region))


def of_catalogue(number: int) -> Case:
    """The energies of a system of the catalogue."""
    system = ed.systems.load(number)
    motion = {w.symbol.diff(T): w.default[1] for w in system.inputs if w.default is not None}
    return Case(
        f"S{number:02d}",
        [c.symbol for c in system.coordinates],
        system.kinetic_energy,
        system.potential_energy,
        system.values(),
        system.bounds,
        system.dissipation,
        system.generalized_forces,
        motion=motion,
    )


def symbols(names: str) -> list[sm.Symbol]:
    """Parameters by name."""
    return list(sm.symbols(names, real=True, seq=True))


def pendulum() -> Case:
    (theta,) = coordinates("theta")
    m, l, g, c = symbols("m l g c")
    kinetic = m * l**2 * theta.diff() ** 2 / 2
    numbers = {"m": 1.3, "l": 0.8, "g": 9.81, "c": 0.2}
    return Case(
        "W10 pendulum", [theta], kinetic, -m * g * l * sm.cos(theta), numbers, {}, c * theta.diff() ** 2 / 2
    )


def windy_pendulum() -> Case:
    (theta,) = coordinates("theta")
    m, l, g, c, W = symbols("m l g c W")
    potential = -m * g * l * sm.cos(theta) - W * l * sm.sin(theta)
    numbers = {"m": 1.3, "l": 0.8, "g": 9.81, "c": 0.2, "W": 7.0}
    kinetic = m * l**2 * theta.diff() ** 2 / 2
    return Case("pendulum in the wind", [theta], kinetic, potential, numbers, {}, c * theta.diff() ** 2 / 2)


def hoop() -> Case:
    """A bead on a hoop that turns about its vertical diameter."""
    (theta,) = coordinates("theta")
    m, R, g, c, Omega = symbols("m R g c Omega")
    kinetic = m * R**2 * (theta.diff() ** 2 + Omega**2 * sm.sin(theta) ** 2) / 2
    numbers = {"m": 0.4, "R": 0.3, "g": 9.81, "c": 0.05, "Omega": 8.0}
    return Case(
        "bead on a hoop", [theta], kinetic, -m * g * R * sm.cos(theta), numbers, {}, c * theta.diff() ** 2 / 2
    )


def snap_through() -> Case:
    (y,) = coordinates("y")
    m, b, L_0, k, c, g, P = symbols("m b L_0 k c g P")
    potential = k * (sm.sqrt(b**2 + y**2) - L_0) ** 2 + m * g * y - P * y
    numbers = {"m": 0.05, "b": 0.03, "L_0": 0.0325, "k": 4000.0, "c": 0.8, "g": 9.81, "P": 0.0}
    kinetic = m * y.diff() ** 2 / 2
    return Case(
        "S02 snap-through", [y], kinetic, potential, numbers, {"y": (-0.05, 0.05)}, c * y.diff() ** 2 / 2
    )


def seismometer() -> Case:
    (theta,) = coordinates("theta")
    m, l, J_G, k_f, c_e, g = symbols("m l J_G k_f c_e g")
    xb, M_c = dynamicsymbols("xb M_c")
    kinetic = (
        m
        * ((xb.diff() - l * sm.cos(theta) * theta.diff()) ** 2 + (l * sm.sin(theta) * theta.diff()) ** 2)
        / 2
    )
    kinetic += J_G * theta.diff() ** 2 / 2
    potential = m * g * l * sm.cos(theta) + k_f * theta**2 / 2
    numbers = {"m": 0.5, "l": 0.2, "J_G": 0.002, "k_f": 0.9, "c_e": 0.05, "g": 9.81}
    damping = c_e * theta.diff() ** 2 / 2
    return Case(
        "S04 seismometer", [theta], kinetic, potential, numbers, {"theta": (-pi, pi)}, damping, {theta: M_c}
    )


def bar_on_slider() -> Case:
    s, theta = coordinates("s theta")
    m, m_s, l, gamma, k, c, c_h, g = symbols("m m_s l gamma k c c_h g")
    v_x = s.diff() * sm.cos(gamma) + l / 2 * sm.cos(theta) * theta.diff()
    v_y = s.diff() * sm.sin(gamma) + l / 2 * sm.sin(theta) * theta.diff()
    kinetic = m_s * s.diff() ** 2 / 2 + m * (v_x**2 + v_y**2) / 2 + m * l**2 / 12 * theta.diff() ** 2 / 2
    potential = k * s**2 / 2 + (m + m_s) * g * s * sm.sin(gamma) - m * g * l / 2 * sm.cos(theta)
    numbers = {"m": 3.0, "m_s": 1.0, "l": 0.6, "gamma": pi / 6, "k": 400.0, "c": 4.0, "c_h": 0.15, "g": 9.81}
    damping = c * s.diff() ** 2 / 2 + c_h * theta.diff() ** 2 / 2
    return Case("W7 bar on slider", [s, theta], kinetic, potential, numbers, {"s": (-1.0, 1.0)}, damping)


def two_wells() -> Case:
    x, y = coordinates("x y")
    a, b = symbols("a b")
    potential = (x**2 - 1) ** 2 / 4 + b * (y**2 - 1) ** 2 / 4 + a * x * y
    region = {"x": (-2.0, 2.0), "y": (-2.0, 2.0)}
    kinetic = (x.diff() ** 2 + y.diff() ** 2) / 2
    damping = (x.diff() ** 2 + y.diff() ** 2) / 20
    return Case("two wells", [x, y], kinetic, potential, {"a": 0.1, "b": 1.0}, region, damping)


def elastic_pendulum() -> Case:
    r, theta = coordinates("r theta")
    m, k, L_0, g, W = symbols("m k L_0 g W")
    kinetic = m * (r.diff() ** 2 + (r * theta.diff()) ** 2) / 2
    potential = k * (r - L_0) ** 2 / 2 - m * g * r * sm.cos(theta) - W * r * sm.sin(theta)
    numbers = {"m": 1.1, "k": 90.0, "L_0": 0.5, "g": 9.81, "W": 3.0}
    damping = (r.diff() ** 2 + theta.diff() ** 2) / 10
    return Case("elastic pendulum", [r, theta], kinetic, potential, numbers, {"r": (0.1, 2.0)}, damping)


def sprung_double_pendulum() -> Case:
    theta1, theta2 = coordinates("theta1 theta2")
    m_1, m_2, L, k_1, k_2, g = symbols("m_1 m_2 L k_1 k_2 g")
    w_1, w_2 = theta1.diff(), theta2.diff()
    kinetic = (m_1 + m_2) * L**2 * w_1**2 / 2 + m_2 * L**2 * (
        w_2**2 / 2 + sm.cos(theta1 - theta2) * w_1 * w_2
    )
    potential = (m_1 + m_2) * g * L * sm.cos(theta1) + m_2 * g * L * sm.cos(theta2)
    potential += k_1 * theta1**2 / 2 + k_2 * (theta2 - theta1) ** 2 / 2
    numbers = {"m_1": 1.0, "m_2": 1.5, "L": 0.5, "k_1": 6.0, "k_2": 4.0, "g": 9.81}
    region = {"theta1": (-3.0, 3.0), "theta2": (-3.5, 3.5)}
    damping = (w_1**2 + (w_2 - w_1) ** 2) / 10
    return Case("inverted double pendulum", [theta1, theta2], kinetic, potential, numbers, region, damping)


def isolator() -> Case:
    y1, y2 = coordinates("y1 y2")
    m_1, m_2, k_1, k_2, k_3, c_1, c_2, g = symbols("m_1 m_2 k_1 k_2 k_3 c_1 c_2 g")
    yb, F = dynamicsymbols("yb F")
    kinetic = (m_1 * y1.diff() ** 2 + m_2 * y2.diff() ** 2) / 2
    potential = k_1 * (y1 - yb) ** 2 / 2 + k_2 * (y2 - y1) ** 2 / 2 + k_3 * (y2 - y1) ** 4 / 4
    potential += (m_1 * y1 + m_2 * y2) * g
    damping = c_1 * (y1.diff() - yb.diff()) ** 2 / 2 + c_2 * (y2.diff() - y1.diff()) ** 2 / 2
    numbers = {
        "m_1": 150.0,
        "m_2": 400.0,
        "k_1": 6e5,
        "k_2": 3e5,
        "k_3": 3e8,
        "c_1": 3e3,
        "c_2": 500.0,
        "g": 9.81,
    }
    region = {"y1": (-0.1, 0.1), "y2": (-0.1, 0.1)}
    return Case("S10 isolator", [y1, y2], kinetic, potential, numbers, region, damping, {y2: F})


def follower_mast() -> Case:
    theta1, theta2 = coordinates("theta1 theta2")
    m_1, m_2, L, k_1, k_2, c_1, c_2, P = symbols("m_1 m_2 L k_1 k_2 c_1 c_2 P")
    F = dynamicsymbols("F")
    w_1, w_2 = theta1.diff(), theta2.diff()
    kinetic = (m_1 + m_2) * L**2 * w_1**2 / 2 + m_2 * L**2 * (
        w_2**2 / 2 + sm.cos(theta1 - theta2) * w_1 * w_2
    )
    potential = k_1 * theta1**2 / 2 + k_2 * (theta2 - theta1) ** 2 / 2
    damping = c_1 * w_1**2 / 2 + c_2 * (w_2 - w_1) ** 2 / 2
    forces = {
        theta1: P * L * sm.sin(theta1 - theta2) + F * L * sm.cos(theta1),
        theta2: F * L * sm.cos(theta2),
    }
    numbers = {"m_1": 2.0, "m_2": 1.0, "L": 0.5, "k_1": 20.0, "k_2": 20.0, "c_1": 0.1, "c_2": 0.1, "P": 50.0}
    region = {"theta1": (-pi / 2, pi / 2), "theta2": (-pi / 2, pi / 2)}
    return Case("S11 mast", [theta1, theta2], kinetic, potential, numbers, region, damping, forces)


def carousel() -> Case:
    """S17, the arm at constant rate."""
    alpha, beta = coordinates("alpha beta")
    m, R, L, Omega, c, g = symbols("m R L Omega c g")
    ca, sa, cb, sb = sm.cos(alpha), sm.sin(alpha), sm.cos(beta), sm.sin(beta)
    a, b = alpha.diff(), beta.diff()
    kinetic = m * ((L * ca * a - Omega * L * ca * sb) ** 2 + (L * (sa * cb * a + ca * sb * b)) ** 2) / 2
    kinetic += m * (L * (ca * cb * b - sa * sb * a) + Omega * (R + L * sa)) ** 2 / 2
    damping = c * L**2 * (a**2 + ca**2 * b**2) / 2
    numbers = {"m": 90.0, "R": 5.0, "L": 4.0, "Omega": 1.1, "c": 12.0, "g": 9.81}
    region = {"alpha": (-pi / 2, pi / 2), "beta": (-pi, pi)}
    return Case("S17 carousel", [alpha, beta], kinetic, -m * g * L * ca * cb, numbers, region, damping)


def ship() -> Case:
    """S16, ship roll with a gyro stabilizer."""
    phi, theta = coordinates("phi theta")
    I_s, W, GM, m_g, h, A_x, A_y, C_g, C_r, w_s, c_r, c_t, g = symbols(
        "I_s W GM m_g h A_x A_y C_g C_r w_s c_r c_t g"
    )
    roll, tilt = phi.diff(), theta.diff()
    kinetic = I_s * roll**2 / 2 + A_x * (roll * sm.cos(theta)) ** 2 / 2 + A_y * tilt**2 / 2
    kinetic += C_g * (roll * sm.sin(theta)) ** 2 / 2 + C_r * (w_s + roll * sm.sin(theta)) ** 2 / 2
    potential = -W * GM * sm.cos(phi) - m_g * g * h * sm.cos(phi) * sm.cos(theta)
    numbers = {
        "I_s": 4e5,
        "W": 882900.0,
        "GM": 0.8,
        "m_g": 800.0,
        "h": 0.1,
        "A_x": 85.0,
        "A_y": 80.0,
        "C_g": 25.0,
    }
    numbers |= {"C_r": 60.0, "w_s": 550.0, "c_r": 25000.0, "c_t": 5000.0, "g": 9.81}
    damping = c_r * roll**2 / 2 + c_t * tilt**2 / 2
    region = {"phi": (-pi, pi), "theta": (-pi, pi)}
    return Case("S16 ship", [phi, theta], kinetic, potential, numbers, region, damping)


def quartic() -> Case:
    (x,) = coordinates("x")
    return Case("V = x^4", [x], x.diff() ** 2 / 2, x**4 / 4, {}, {"x": (-1.0, 1.0)})


def turntable() -> Case:
    """S06, steady motion at the reference rate, held by the motor."""
    theta, s = coordinates("theta s")
    J, m, e, k, s_0, c_s, c_t = symbols("J m e k s_0 c_s c_t")
    M, F = dynamicsymbols("M F")
    kinetic = (
        J * theta.diff() ** 2 / 2 + m * ((s.diff() - e * theta.diff()) ** 2 + (s * theta.diff()) ** 2) / 2
    )
    damping = c_t * theta.diff() ** 2 / 2 + c_s * s.diff() ** 2 / 2
    numbers = {"J": 0.8, "m": 2.0, "e": 0.05, "k": 1500.0, "s_0": 0.25, "c_s": 8.0, "c_t": 0.05}
    potential = k * (s - s_0) ** 2 / 2
    region = {"s": (0.0, 1.0)}
    return Case("S06 turntable", [theta, s], kinetic, potential, numbers, region, damping, {theta: M, s: F})


def drum_robot() -> Case:
    """S09, on a slope."""
    x, theta = coordinates("x theta")
    M_d, R, J_d, m, l, J_p, beta, c_a, g = symbols("M_d R J_d m l J_p beta c_a g")
    tau = dynamicsymbols("tau")
    v, w = x.diff(), theta.diff()
    across = v * sm.cos(beta) + l * sm.cos(theta) * w
    upward = v * sm.sin(beta) + l * sm.sin(theta) * w
    kinetic = (M_d + J_d / R**2) * v**2 / 2 + m * (across**2 + upward**2) / 2 + J_p * w**2 / 2
    potential = (M_d + m) * g * x * sm.sin(beta) - m * g * l * sm.cos(theta)
    numbers = {
        "M_d": 6.0,
        "R": 0.2,
        "J_d": 0.2,
        "m": 8.0,
        "l": 0.12,
        "J_p": 0.05,
        "beta": 0.05,
        "c_a": 0.06,
        "g": 9.81,
    }
    damping = c_a * (w + v / R) ** 2 / 2
    return Case("S09 drum", [x, theta], kinetic, potential, numbers, {}, damping, {x: tau / R, theta: tau})


def castor() -> Case:
    """S13, rolling without side slip."""
    y, psi = coordinates("y psi")
    m_p, m, J_G, a, b, k_y, c_y, k_p, c_p, v = symbols("m_p m J_G a b k_y c_y k_p c_p v")
    F, M = dynamicsymbols("F M")
    w = psi.diff()
    kinetic = m_p * (v**2 + y.diff() ** 2) / 2 + J_G * w**2 / 2
    kinetic += m * ((v + b * sm.sin(psi) * w) ** 2 + (y.diff() - b * sm.cos(psi) * w) ** 2) / 2
    potential = k_y * y**2 / 2 + k_p * psi**2 / 2
    damping = c_y * y.diff() ** 2 / 2 + c_p * w**2 / 2
    numbers = {"m_p": 3.0, "m": 8.0, "J_G": 0.12, "a": 0.1, "b": 0.07, "k_y": 6e4, "c_y": 150.0, "k_p": 0.0}
    numbers |= {"c_p": 2.0, "v": 2.0}
    rolling = y.diff() * sm.cos(psi) - v * sm.sin(psi) - a * w
    region = {"y": (-0.05, 0.05), "psi": (-pi / 2, pi / 2)}
    forces = {y: F, psi: M}
    return Case("S13 castor", [y, psi], kinetic, potential, numbers, region, damping, forces, [rolling])


def car_and_trailer() -> Case:
    """S18, straight running."""
    y, psi, theta = coordinates("y psi theta")
    m_1, J_1, a, b, h, m_2, J_2, e, d = symbols("m_1 J_1 a b h m_2 J_2 e d")
    C_1, C_2, C_3, c_h, v = symbols("C_1 C_2 C_3 c_h v")
    delta, F_w = dynamicsymbols("delta F_w")
    sp, cp, st, ct = sm.sin(psi), sm.cos(psi), sm.sin(theta), sm.cos(theta)
    y_d, psi_d, theta_d = y.diff(), psi.diff(), theta.diff()
    across, along = y_d * cp - v * sp, v * cp + y_d * sp
    front = -C_1 * (sm.atan((across + a * psi_d) / along) - delta)
    rear = -C_2 * sm.atan((across - b * psi_d) / along)
    side = y_d * ct - v * st - h * sm.cos(psi - theta) * psi_d - d * theta_d
    axle = -C_3 * sm.atan(side / (v * ct + y_d * st + h * sm.sin(psi - theta) * psi_d))
    kinetic = m_1 * (v**2 + y_d**2) / 2 + J_1 * psi_d**2 / 2 + J_2 * theta_d**2 / 2
    kinetic += m_2 * (v + h * sp * psi_d + e * st * theta_d) ** 2 / 2
    kinetic += m_2 * (y_d - h * cp * psi_d - e * ct * theta_d) ** 2 / 2
    forces = {
        y: (front + rear) * cp + axle * ct + F_w,
        psi: a * front - b * rear - h * axle * sm.cos(psi - theta) - h * F_w * cp,
        theta: -d * axle - e * F_w * ct,
    }
    numbers = {
        "m_1": 1500.0,
        "J_1": 2500.0,
        "a": 1.2,
        "b": 1.4,
        "h": 2.3,
        "m_2": 1000.0,
        "J_2": 1800.0,
        "e": 2.9,
    }
    numbers |= {"d": 3.0, "C_1": 8e4, "C_2": 9e4, "C_3": 6e4, "c_h": 200.0, "v": 22.0}
    damping = c_h * (theta_d - psi_d) ** 2 / 2
    return Case("S18 car and trailer", [y, psi, theta], kinetic, sm.S.Zero, numbers, {}, damping, forces)


def drive_train() -> Case:
    """S20, wind turbine with a gear stage."""
    tr, tb, tg = coordinates("tr tb tg")
    J_r, J_1, J_2, J_g, N, K_s, C_s, K_h, C_h, B, w_0 = symbols("J_r J_1 J_2 J_g N K_s C_s K_h C_h B w_0")
    rho, R, v, q_0, q_1, q_2 = symbols("rho R v q_0 q_1 q_2")
    T_w, T_e = dynamicsymbols("T_w T_e")
    a, b, c = tr.diff(), tb.diff(), tg.diff()
    speed_ratio = a * R / v
    wind = rho * sm.pi * R**3 * v**2 / 2 * (q_0 + q_1 * speed_ratio + q_2 * speed_ratio**2)
    kinetic = J_r * a**2 / 2 + (J_2 + J_1 / N**2) * b**2 / 2 + J_g * c**2 / 2
    potential = K_s * (tr - tb / N) ** 2 / 2 + K_h * (tb - tg) ** 2 / 2
    damping = C_s * (a - b / N) ** 2 / 2 + C_h * (b - c) ** 2 / 2
    numbers = {
        "J_r": 2.9e6,
        "J_1": 500.0,
        "J_2": 3.0,
        "J_g": 60.0,
        "N": 80.0,
        "K_s": 1e8,
        "C_s": 4e5,
        "K_h": 2e5,
    }
    numbers |= {"C_h": 20.0, "B": 3000.0, "w_0": 157.08, "rho": 1.225, "R": 35.0, "v": 11.0}
    numbers |= {"q_0": -0.03, "q_1": 0.0425, "q_2": -0.0042}
    forces = {tr: wind + T_w, tg: -B * (c - w_0) + T_e}
    region = {"tr_d": (-5.0, 10.0)}
    return Case("S20 drive train", [tr, tb, tg], kinetic, potential, numbers, region, damping, forces)


def coordinates(names: str) -> list[sm.Expr]:
    """Dynamicsymbols as a list, also for one name."""
    return [dynamicsymbols(name) for name in names.split()]


def normal_form(potential: sm.Expr, name: str, **values: float) -> Case:
    """A particle on a line, ẍ + ẋ/10 + dV/dx = 0."""
    (x,) = coordinates("x")
    return Case(name, [x], x.diff() ** 2 / 2, potential, dict(values), {"x": (-2.0, 2.0)}, x.diff() ** 2 / 20)
