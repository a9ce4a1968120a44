"""S13 to S18 and S22 against their definitions.

The oracle knows nothing of the package: the definition's T, V, D and Q are typed once more as functions of
numbers, and Lagrange's equations (with a multiplier for S13) are formed from them by differences in 60-digit
arithmetic.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable
from types import SimpleNamespace

import mpmath
import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import fsolve
from scipy.spatial.transform import Rotation
from sympy.physics.mechanics import Particle, RigidBody

import engdyn as ed
from engdyn import shapes
from engdyn.plots.words import symbol
from engdyn.systems.attitudes import PITCH, SECOND, angles_231, angles_321, matrix_231, matrix_321

mpmath.mp.dps = 60
PI = math.pi

# Parameters (name, unit, default), coordinates (name, unit, bounds), inputs (name, unit, kind)
TABLES = {
    13: {
        "key": "castor_shimmy",
        "parameters": "m_p kg 3.0; m kg 8.0; J_G kg_m^2 0.12; a m 0.1; b m 0.07; k_y N/m 60000.0; "
        "c_y N_s/m 150.0; k_p N_m/rad 0.0; c_p N_m_s/rad 2.0; v m/s 2.0",
        "coordinates": [("y", "m", (-0.05, 0.05)), ("psi", "rad", (-PI / 2, PI / 2))],
        "inputs": [("F", "N", "force"), ("M", "N m", "couple")],
    },
    14: {
        "key": "jeffcott_rotor",
        "parameters": "m kg 12.0; k N/m 1200000.0; epsilon m 5e-05; c_e N_s/m 240.0; c_i N_s/m 160.0; "
        "Omega rad/s 450.0",
        "coordinates": [("xi", "m", (-0.001, 0.001)), ("eta", "m", (-0.001, 0.001))],
        "inputs": [("F_x", "N", "force"), ("F_y", "N", "force"), ("drive", "rad", "drive angle")],
    },
    15: {
        "key": "gimballed_rotor",
        "parameters": "m kg 5.0; l m 0.15; A kg_m^2 0.12; C kg_m^2 0.18; k_a N_m/rad 60.0; "
        "k_b N_m/rad 60.0; c_a N_m_s/rad 0.3; c_b N_m_s/rad 0.3; Omega rad/s 20.0; "
        "g m/s^2 9.81",
        "coordinates": [("alpha", "rad", (-1.5, 1.5)), ("beta", "rad", (-1.5, 1.5))],
        "inputs": [("M_x", "N m", "couple"), ("M_y", "N m", "couple")],
    },
    16: {
        "key": "ship_gyro_stabilizer",
        "parameters": "I_s kg_m^2 400000.0; W N 882900.0; GM m 0.8; m_g kg 800.0; h m 0.1; "
        "A_x kg_m^2 85.0; A_y kg_m^2 80.0; C_g kg_m^2 25.0; C_r kg_m^2 60.0; "
        "w_s rad/s 550.0; c_r N_m_s/rad 25000.0; c_t N_m_s/rad 5000.0; g m/s^2 9.81",
        "coordinates": [("phi", "rad", (-PI, PI)), ("theta", "rad", (-PI, PI))],
        "inputs": [("M_w", "N m", "couple")],
    },
    17: {
        "key": "swing_carousel",
        "parameters": "m kg 90.0; R m 5.0; L m 4.0; Omega rad/s 1.1; c N_s/m 12.0; g m/s^2 9.81",
        "coordinates": [("alpha", "rad", (-PI / 2, PI / 2)), ("beta", "rad", (-PI, PI))],
        "inputs": [("F_t", "N", "force"), ("drive", "rad", "drive angle")],
    },
    18: {
        "key": "car_trailer",
        "parameters": "m_1 kg 1500.0; J_1 kg_m^2 2500.0; a m 1.2; b m 1.4; h m 2.3; m_2 kg 1000.0; "
        "J_2 kg_m^2 1800.0; e m 2.9; d m 3.0; C_1 N/rad 80000.0; C_2 N/rad 90000.0; "
        "C_3 N/rad 60000.0; c_h N_m_s/rad 200.0; v m/s 22.0",
        "coordinates": [("y", "m", None), ("psi", "rad", (-1.0, 1.0)), ("theta", "rad", (-1.0, 1.0))],
        "inputs": [("delta", "rad", "force"), ("F_w", "N", "force")],
    },
    22: {
        "key": "gravity_gradient_satellite",
        "parameters": "J_1 kg_m^2 80.0; J_2 kg_m^2 90.0; J_3 kg_m^2 20.0; n rad/s 0.0011; c N_m_s/rad 0.004",
        "coordinates": [
            ("psi", "rad", (-PI, PI)),
            ("theta", "rad", (-PI / 2, PI / 2)),
            ("phi", "rad", (-PI, PI)),
        ],
        "inputs": [("tau_1", "N m", "couple"), ("tau_2", "N m", "couple"), ("tau_3", "N m", "couple")],
    },
}
NUMBERS = list(TABLES)
SIGNED = {"v", "epsilon", "Omega", "w_s", "n"}  # parameters that may be negative


def front(v, f):
    """Side forces of the tires of S18."""
    return -v.C_1 * (
        f.atan(
            (v.y_d * f.cos(v.psi) - v.v * f.sin(v.psi) + v.a * v.psi_d)
            / (v.v * f.cos(v.psi) + v.y_d * f.sin(v.psi))
        )
        - v.delta
    )


def rear(v, f):
    return -v.C_2 * f.atan(
        (v.y_d * f.cos(v.psi) - v.v * f.sin(v.psi) - v.b * v.psi_d)
        / (v.v * f.cos(v.psi) + v.y_d * f.sin(v.psi))
    )


def last(v, f):
    sideways = v.y_d * f.cos(v.theta) - v.v * f.sin(v.theta) - v.h * f.cos(v.psi - v.theta) * v.psi_d
    ahead = v.v * f.cos(v.theta) + v.y_d * f.sin(v.theta) + v.h * f.sin(v.psi - v.theta) * v.psi_d
    return -v.C_3 * f.atan((sideways - v.d * v.theta_d) / ahead)


# Of every system T, V, D and the Q of each coordinate: functions of the numbers v, with those of the module f.
FORMULAS: dict[int, tuple[Callable, ...]] = {
    13: (
        lambda v, f: (
            v.m_p * (v.v**2 + v.y_d**2) / 2
            + v.m
            * ((v.v + v.b * f.sin(v.psi) * v.psi_d) ** 2 + (v.y_d - v.b * f.cos(v.psi) * v.psi_d) ** 2)
            / 2
            + v.J_G * v.psi_d**2 / 2
        ),
        lambda v, f: v.k_y * v.y**2 / 2 + v.k_p * v.psi**2 / 2,
        lambda v, f: v.c_y * v.y_d**2 / 2 + v.c_p * v.psi_d**2 / 2,
        lambda v, f: v.F,
        lambda v, f: v.M,
    ),
    14: (
        lambda v, f: (
            v.m * ((v.xi_d - v.drive_d * v.eta) ** 2 + (v.eta_d + v.drive_d * (v.xi + v.epsilon)) ** 2) / 2
        ),
        lambda v, f: v.k * (v.xi**2 + v.eta**2) / 2,
        lambda v, f: (
            v.c_e * ((v.xi_d - v.drive_d * v.eta) ** 2 + (v.eta_d + v.drive_d * v.xi) ** 2) / 2
            + v.c_i * (v.xi_d**2 + v.eta_d**2) / 2
        ),
        lambda v, f: v.F_x * f.cos(v.drive) + v.F_y * f.sin(v.drive),
        lambda v, f: -v.F_x * f.sin(v.drive) + v.F_y * f.cos(v.drive),
    ),
    15: (
        lambda v, f: (
            v.A * ((v.alpha_d * f.cos(v.beta)) ** 2 + v.beta_d**2) / 2
            + v.C * (v.Omega + v.alpha_d * f.sin(v.beta)) ** 2 / 2
        ),
        lambda v, f: (
            v.m * v.g * v.l * f.cos(v.alpha) * f.cos(v.beta) + v.k_a * v.alpha**2 / 2 + v.k_b * v.beta**2 / 2
        ),
        lambda v, f: v.c_a * v.alpha_d**2 / 2 + v.c_b * v.beta_d**2 / 2,
        lambda v, f: v.M_x,
        lambda v, f: v.M_y * f.cos(v.alpha),
    ),
    16: (
        lambda v, f: (
            v.I_s * v.phi_d**2 / 2
            + v.A_x * (v.phi_d * f.cos(v.theta)) ** 2 / 2
            + v.A_y * v.theta_d**2 / 2
            + v.C_g * (v.phi_d * f.sin(v.theta)) ** 2 / 2
            + v.C_r * (v.w_s + v.phi_d * f.sin(v.theta)) ** 2 / 2
        ),
        lambda v, f: -v.W * v.GM * f.cos(v.phi) - v.m_g * v.g * v.h * f.cos(v.phi) * f.cos(v.theta),
        lambda v, f: v.c_r * v.phi_d**2 / 2 + v.c_t * v.theta_d**2 / 2,
        lambda v, f: v.M_w,
        lambda v, f: 0,
    ),
    17: (
        lambda v, f: (
            v.m
            * (
                (v.L * f.cos(v.alpha) * v.alpha_d - v.drive_d * v.L * f.cos(v.alpha) * f.sin(v.beta)) ** 2
                + (
                    v.L
                    * (f.cos(v.alpha) * f.cos(v.beta) * v.beta_d - f.sin(v.alpha) * f.sin(v.beta) * v.alpha_d)
                    + v.drive_d * (v.R + v.L * f.sin(v.alpha))
                )
                ** 2
                + (
                    v.L
                    * (f.sin(v.alpha) * f.cos(v.beta) * v.alpha_d + f.cos(v.alpha) * f.sin(v.beta) * v.beta_d)
                )
                ** 2
            )
            / 2
        ),
        lambda v, f: -v.m * v.g * v.L * f.cos(v.alpha) * f.cos(v.beta),
        lambda v, f: v.c * v.L**2 * (v.alpha_d**2 + f.cos(v.alpha) ** 2 * v.beta_d**2) / 2,
        lambda v, f: -v.F_t * v.L * f.sin(v.alpha) * f.sin(v.beta),
        lambda v, f: v.F_t * v.L * f.cos(v.alpha) * f.cos(v.beta),
    ),
    18: (
        lambda v, f: (
            v.m_1 * (v.v**2 + v.y_d**2) / 2
            + v.J_1 * v.psi_d**2 / 2
            + v.m_2
            * (
                (v.v + v.h * f.sin(v.psi) * v.psi_d + v.e * f.sin(v.theta) * v.theta_d) ** 2
                + (v.y_d - v.h * f.cos(v.psi) * v.psi_d - v.e * f.cos(v.theta) * v.theta_d) ** 2
            )
            / 2
            + v.J_2 * v.theta_d**2 / 2
        ),
        lambda v, f: 0,
        lambda v, f: v.c_h * (v.theta_d - v.psi_d) ** 2 / 2,
        lambda v, f: (front(v, f) + rear(v, f)) * f.cos(v.psi) + last(v, f) * f.cos(v.theta) + v.F_w,
        lambda v, f: (
            v.a * front(v, f)
            - v.b * rear(v, f)
            - v.h * last(v, f) * f.cos(v.psi - v.theta)
            - v.h * v.F_w * f.cos(v.psi)
        ),
        lambda v, f: -v.d * last(v, f) - v.e * v.F_w * f.cos(v.theta),
    ),
    22: (
        lambda v, f: (
            (
                v.J_1 * (v.phi_d - v.psi_d * f.sin(v.theta) - v.n * f.cos(v.theta) * f.sin(v.psi)) ** 2
                + v.J_2
                * (
                    v.theta_d * f.cos(v.phi)
                    + v.psi_d * f.sin(v.phi) * f.cos(v.theta)
                    - v.n * (f.cos(v.phi) * f.cos(v.psi) + f.sin(v.phi) * f.sin(v.theta) * f.sin(v.psi))
                )
                ** 2
                + v.J_3
                * (
                    -v.theta_d * f.sin(v.phi)
                    + v.psi_d * f.cos(v.phi) * f.cos(v.theta)
                    - v.n * (-f.sin(v.phi) * f.cos(v.psi) + f.cos(v.phi) * f.sin(v.theta) * f.sin(v.psi))
                )
                ** 2
            )
            / 2
        ),
        lambda v, f: (
            3
            * v.n**2
            / 2
            * (
                v.J_1 * f.sin(v.theta) ** 2
                + v.J_2 * (f.sin(v.phi) * f.cos(v.theta)) ** 2
                + v.J_3 * (f.cos(v.phi) * f.cos(v.theta)) ** 2
            )
        ),
        lambda v, f: (
            v.c * (v.psi_d**2 + v.theta_d**2 + v.phi_d**2 - 2 * v.phi_d * v.psi_d * f.sin(v.theta)) / 2
        ),
        lambda v, f: (
            -v.tau_1 * f.sin(v.theta)
            + v.tau_2 * f.sin(v.phi) * f.cos(v.theta)
            + v.tau_3 * f.cos(v.phi) * f.cos(v.theta)
        ),
        lambda v, f: v.tau_2 * f.cos(v.phi) - v.tau_3 * f.sin(v.phi),
        lambda v, f: v.tau_1,
    ),
}


def rolling(v, f):
    """The constraint of S13."""
    return v.y_d * f.cos(v.psi) - v.v * f.sin(v.psi) - v.a * v.psi_d


def names(number):
    return [name for name, *_ in TABLES[number]["coordinates"]]


def table(number):
    rows = [row.split() for row in TABLES[number]["parameters"].split("; ")]
    return [(name, unit.replace("_", " "), float(default)) for name, unit, default in rows]


# What the definition says


@pytest.mark.parametrize("number", NUMBERS)
def test_names_units_and_defaults_are_those_of_the_definition(number):
    system, given = ed.systems.load(number), TABLES[number]
    assert (system.number, system.key) == (number, given["key"])
    assert [(p.name, p.unit, p.default) for p in system.parameters] == table(number)
    assert [(c.name, c.unit, c.bounds) for c in system.coordinates] == given["coordinates"]
    assert [(i.name, i.unit, i.kind) for i in system.inputs] == given["inputs"]
    for p in system.parameters:
        plain = (p.name[0] in "kc" or p.unit == "N/rad") and p.unit not in ("m", "kg")
        assert (p.admissible == "any") == (p.name in SIGNED | {"g"})
        assert (p.admissible == "nonnegative") == plain
    for c in system.coordinates:
        assert c.kind == ("ignorable" if c.bounds is None else "angle" if c.unit == "rad" else "length")


# Two derivations


@pytest.mark.parametrize("number", NUMBERS)
def test_both_derivations_are_proved_equal_and_independent(number, monkeypatch):
    system = ed.systems.load(number)
    assert system.prove().verdict == "proved"

    def forbidden(*_):
        raise AssertionError("this route must not be used")

    with monkeypatch.context() as patch:
        for name in ("kinetic_energy", "potential_energy", "dissipation", "generalized_forces"):
            patch.setattr(ed.System, name, property(forbidden))
        alone = system.newton()
    with monkeypatch.context() as patch:
        patch.setattr(ed.System, "free_bodies", forbidden)
        other = system.lagrange()
    assert ed.prove_equal(alone, other)
    assert set(alone.reactions) == set(system.unknowns)


def newton_with(system, bodies):
    """Newton's equations with other free bodies."""
    q = [c.symbol for c in system.coordinates]
    return ed.newton_euler(bodies, q, system.frame, system.unknowns, constraints=system.constraints)


#: Loads that reactions balance entirely: (system, body, index).
CARRIED = {(16, "ship", 3)}


def changed_loads():
    for number in NUMBERS:
        for b, body in enumerate(ed.systems.load(number).free_bodies()):
            for i in range(len(body.applied)):
                for factor in (0, -1, 2):
                    yield pytest.param(
                        number, b, i, factor, id=f"S{number:02d}-{body.name}-{i}-times{factor}"
                    )


@pytest.mark.parametrize(("number", "b", "i", "factor"), list(changed_loads()))
def test_every_change_of_one_load_is_refuted(number, b, i, factor):
    system = ed.systems.load(number)
    bodies = system.free_bodies()
    loads = list(bodies[b].applied)
    where, vector = loads[i]
    loads[i] = type(loads[i])(where, factor * vector)
    if not factor:
        del loads[i]
    bodies[b] = ed.FreeBody(bodies[b].body, loads, bodies[b].reactions)
    wrong = newton_with(system, bodies)
    expected = "proved" if (number, bodies[b].name, i) in CARRIED else "refuted"
    assert ed.prove_equal(wrong, system.lagrange()).verdict == expected


#: Parts of T that alone give some coordinate its inertia: (system, place, factor).
INERTIA = {(14, 0, 0), (15, 0, 0), (16, 1, 0), (17, 0, 0), (22, 0, 0), (22, 1, 0), (22, 2, 0)}


def changed_energies():
    for number in NUMBERS:
        system = ed.systems.load(number)
        for name in ("kinetic_energy", "potential_energy", "dissipation"):
            whole = getattr(system, name)
            for i in range(len(whole.as_ordered_terms()) if whole else 0):
                yield pytest.param(number, name, i, id=f"S{number:02d}-{name}-{i}")
        for q, force in system.generalized_forces.items():
            for i in range(len(force.as_ordered_terms())):
                yield pytest.param(number, q, i, id=f"S{number:02d}-Q-{q.func}-{i}")


@pytest.mark.parametrize(("number", "name", "i"), list(changed_energies()))
def test_every_change_of_one_energy_term_is_refuted(number, name, i):
    reference = ed.systems.load(number).newton()
    for factor in (0, -1, 2):
        system = ed.systems.load(number)
        if isinstance(name, str):
            whole = getattr(system, name)
            setattr(system, name, whole + (factor - 1) * whole.as_ordered_terms()[i])
        else:
            force = system.generalized_forces[name]
            system.generalized_forces[name] = force + (factor - 1) * force.as_ordered_terms()[i]
        if (number, i, factor) in INERTIA and name == "kinetic_energy":
            with pytest.raises(ed.EngdynError, match="singular mass matrix"):
                ed.prove_equal(reference, system.lagrange())
        else:
            assert ed.prove_equal(reference, system.lagrange()).verdict == "refuted"


@pytest.mark.parametrize("number", NUMBERS)
def test_every_other_mass_or_inertia_is_refuted(number):
    system = ed.systems.load(number)
    for b, body in enumerate(system.free_bodies()):
        bodies, old = system.free_bodies(), body.body
        changed = []
        if isinstance(old, Particle):
            changed.append(Particle(old.name, old.point, 2 * old.mass))
        else:
            place, tensor = old.masscenter, old.central_inertia
            if tensor != 0:
                changed.append(RigidBody(old.name, place, old.frame, old.mass, (2 * tensor, place)))
            if old.mass != 0:
                changed.append(RigidBody(old.name, place, old.frame, 2 * old.mass, (tensor, place)))
        assert changed
        for new in changed:
            bodies[b] = ed.FreeBody(new, body.applied, body.reactions)
            wrong = newton_with(system, bodies)
            assert ed.prove_equal(wrong, system.lagrange()).verdict == "refuted"


def test_the_wrong_rolling_condition_is_refuted():
    castor = ed.systems.load(13)
    rates = [c.symbol.diff() for c in castor.coordinates]
    (rolls,) = castor.constraints
    wrong = ed.lagrange(
        castor.kinetic_energy,
        castor.potential_energy,
        [c.symbol for c in castor.coordinates],
        castor.dissipation,
        castor.generalized_forces,
        [rolls.subs(rates[1], -rates[1])],
    )
    assert ed.prove_equal(castor.newton(), wrong).verdict == "refuted"


# Accelerations


class Moving:
    """A random state of a system: numbers for everything, and where they lead at the time h."""

    def __init__(self, number, seed):
        source = np.random.default_rng([number, seed])
        self.number, self.names = number, names(number)
        self.values = {name: default * source.uniform(0.6, 1.4) for name, _, default in table(number)}
        self.values |= {name: x * source.choice([-1, 1]) for name, x in self.values.items() if name in SIGNED}
        if number == 13:
            self.values["k_p"] = source.uniform(5.0, 50.0)
        regions = [bounds or (-3.0, 3.0) for *_, bounds in TABLES[number]["coordinates"]]
        self.q = [0.9 * source.uniform(*region) for region in regions]
        self.u = [source.normal() * {14: 0.1, 22: 0.002}.get(number, 1.5) for _ in self.q]
        if number == 13:
            slip = self.u[0] * math.cos(self.q[1]) - self.values["v"] * math.sin(self.q[1])
            self.u[1] = slip / self.values["a"]
        size = {14: 300.0, 15: 20.0, 16: 1e5, 17: 200.0, 22: 1e-4}.get(number, 2.0)
        self.inputs = {name: tuple(size * source.normal(size=3)) for name, *_ in TABLES[number]["inputs"]}
        if "drive" in self.inputs:
            self.inputs["drive"] = tuple(2.0 * source.normal(size=3))

    def at(self, h, acceleration):
        """All numbers at the time h of a motion with constant accelerations."""
        mp = mpmath.mpf
        found = {name: mp(x) for name, x in self.values.items()}
        for name, x, rate, gain in zip(self.names, self.q, self.u, acceleration, strict=True):
            found[name] = mp(x) + mp(rate) * h + mp(gain) * h**2 / 2
            found[f"{name}_d"] = mp(rate) + mp(gain) * h
        for name, (x, rate, gain) in self.inputs.items():
            found[name] = mp(x) + mp(rate) * h + mp(gain) * h**2 / 2
            found[f"{name}_d"] = mp(rate) + mp(gain) * h
        return SimpleNamespace(**found)


STEP = mpmath.mpf(10) ** -15


def slope(function, numbers, name):
    """Derivative of a formula by one of its numbers."""
    ends = []
    for sign in (1, -1):
        moved = SimpleNamespace(**vars(numbers))
        setattr(moved, name, getattr(numbers, name) + sign * STEP)
        ends.append(function(moved, mpmath))
    return (ends[0] - ends[1]) / (2 * STEP)


def residual(state, acceleration):
    """d/dt(dT/dq_d) - dT/dq + dV/dq + dD/dq_d - Q by differences; for S13 also the rate of the constraint."""
    kinetic, potential, dissipation, *forces = FORMULAS[state.number]
    now = state.at(mpmath.mpf(0), acceleration)
    later, before = state.at(STEP, acceleration), state.at(-STEP, acceleration)
    rows = []
    for name, force in zip(state.names, forces, strict=True):
        momentum = [slope(kinetic, numbers, f"{name}_d") for numbers in (later, before)]
        row = (momentum[0] - momentum[1]) / (2 * STEP) - slope(kinetic, now, name)
        row += slope(potential, now, name) + slope(dissipation, now, f"{name}_d")
        rows.append(row - force(now, mpmath))
    if state.number == 13:
        rows.append((rolling(later, mpmath) - rolling(before, mpmath)) / (2 * STEP))
    return mpmath.matrix(rows)


def oracle(state):
    """Accelerations, and for S13 the multiplier behind them."""
    n = len(state.names)
    at_rest = residual(state, [0] * n)
    size = len(at_rest)
    mass = mpmath.matrix(size, size)
    for j in range(n):
        mass[:, j] = residual(state, [int(i == j) for i in range(n)]) - at_rest
    if state.number == 13:
        now = state.at(mpmath.mpf(0), [0] * n)
        for i, name in enumerate(state.names):
            mass[i, n] = -slope(rolling, now, f"{name}_d")
    return [float(x) for x in mpmath.lu_solve(mass, -at_rest)]


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("number", NUMBERS)
def test_accelerations_at_random_states(number, seed):
    state, system = Moving(number, seed), ed.systems.load(number)
    expected = oracle(state)
    for eom in (system.newton(), system.lagrange()):
        m = len(eom.speeds)
        found = eom.accelerations(state.q, state.u[:m], state.values, state.inputs)
        assert found == pytest.approx(expected[:m], rel=1e-9, abs=1e-9 if number != 22 else 1e-15)


@pytest.mark.parametrize("seed", range(3))
def test_the_side_force_of_the_tire_is_the_multiplier(seed):
    castor, state = ed.systems.load(13), Moving(13, seed)
    y_dd, psi_dd, multiplier = oracle(state)
    found = reaction(castor, "lam", state.q, state.u, [y_dd, psi_dd], state.values, state.inputs)
    assert found == pytest.approx(multiplier, rel=1e-9)


@pytest.mark.parametrize("number", [14, 17])
def test_a_run_up_feels_the_acceleration_of_the_drive(number):
    """In axes that turn faster and faster everything is left behind by -drive_dd times its lever."""
    system = ed.systems.load(number)
    q = [1e-4, -2e-4] if number == 14 else [0.4, 0.3]
    steady, speeding = (
        system.newton().accelerations(q, [0.0, 0.0], system.values(), {"drive": (0.0, 1.1, gain)})
        for gain in (0.0, 0.5)
    )
    if number == 14:
        behind = [0.5 * -2e-4, -0.5 * (1e-4 + 5e-5)]
    else:  # R + L sin(alpha) backward and L cos(alpha) sin(beta) outward, per length of the rod
        s_a, c_a, s_b, c_b = math.sin(0.4), math.cos(0.4), math.sin(0.3), math.cos(0.3)
        back, out = -0.5 * (5.0 + 4.0 * s_a), 0.5 * 4.0 * c_a * s_b
        behind = [(out * c_a - back * s_a * s_b) / 4.0, back * c_b / (4.0 * c_a)]
    assert speeding - steady == pytest.approx(behind, rel=1e-9)


def reaction(system, name, q, u, udot, values=None, inputs=None):
    """A reaction as a number; parameters at their defaults where not given."""
    t = system.coordinates[0].symbol.args[0]
    expression = system.newton().reactions[next(x for x in system.unknowns if x.name == name)]
    motion = dict(zip((c.symbol for c in system.coordinates), zip(q, u, udot, strict=True), strict=True))
    motion |= {i.symbol: (inputs or {}).get(i.name, (0.0, 0.0, 0.0)) for i in system.inputs}
    for order in (2, 1, 0):
        expression = expression.subs(
            {(x.diff(t, order) if order else x): triple[order] for x, triple in motion.items()}
        )
    known = system.values(**(values or {}))
    return float(expression.subs({p.symbol: known[p.name] for p in system.parameters}))


# Equilibria and steady motions


def at_rest(number, values, inputs=None):
    """d(V - T)/dq - Q + dD/dq_d at constant coordinates, as a function of these; by complex steps."""
    kinetic, potential, dissipation, *forces = FORMULAS[number]
    f = SimpleNamespace(sin=np.sin, cos=np.cos, atan=np.arctan)
    known = dict.fromkeys((f"{name}_d" for name in names(number)), 0.0) | values
    known |= {name: 0.0 for name, *_ in TABLES[number]["inputs"]} | (inputs or {})
    known["drive_d"] = values.get("Omega", 0.0)

    def rows(q):
        at = known | dict(zip(names(number), q, strict=True))
        found = []
        for name, force in zip(names(number), forces, strict=True):
            step = SimpleNamespace(**(at | {name: at[name] + 1e-30j}))
            drag = SimpleNamespace(**(at | {f"{name}_d": 1e-30j}))
            total = potential(step, f) - kinetic(step, f) + dissipation(drag, f)
            found.append(np.imag(total) / 1e-30 - force(SimpleNamespace(**at), f))
        return np.array(found)

    return rows


def brute_force(rows, region, count=18, size=1.0):
    """Roots from a dense grid of starts."""
    found = []
    for start in itertools.product(*(np.linspace(*side, count) for side in region)):
        root, _, flag, _ = fsolve(rows, start, full_output=True, xtol=1e-13)
        inside = all(lo + 1e-9 < x <= hi + 1e-9 for x, (lo, hi) in zip(root, region, strict=True))
        new = all(np.max(np.abs(root - other)) > 1e-6 * size for other in found)
        if flag == 1 and inside and new and np.max(np.abs(rows(root))) < 1e-6:
            found.append(root)
    return sorted(found, key=lambda z: tuple(np.round(z, 9)))


VARIED = {
    14: [{}, {"Omega": -300.0, "epsilon": -8e-5}, {"Omega": 900.0, "c_i": 0.0}],
    15: [{}, {"k_a": 2.0, "k_b": 3.0}, {"k_a": 5.0, "k_b": 7.0}, {"k_a": 0.0, "k_b": 1.0, "Omega": -50.0}],
    16: [{}, {"h": 0.4, "W": 3000.0}, {"w_s": -900.0}],
    17: [{}, {"Omega": 0.3}, {"Omega": 1.5}, {"Omega": -2.2, "R": 0.4}],
}


@pytest.mark.parametrize(
    ("number", "changes"), [(number, changes) for number, cases in VARIED.items() for changes in cases]
)
def test_equilibria_are_those_of_a_brute_force_search(number, changes):
    system = ed.systems.load(number)
    found = system.equilibria(changes)
    assert found.certified
    region = [bounds for *_, bounds in TABLES[number]["coordinates"]]
    if number == 17:  # the coordinates fail at its edges
        region[0] = (1e-6 - PI / 2, PI / 2 - 1e-6)
    size = 1e-3 if number == 14 else 1.0
    expected = brute_force(at_rest(number, system.values(**changes)), region, size=size)
    assert len(found) == len(expected)
    for e, root in zip(found, expected, strict=True):
        assert e.q == pytest.approx(root, abs=1e-7 * size)


def eigenvalues_at(system, equilibrium):
    return ed.eigenvalues(ed.linearize(system.equations, equilibrium))


def growth(number, values=None, **inputs):
    """Largest real part of the eigenvalues of the first steady motion."""
    system = ed.systems.load(number)
    return eigenvalues_at(system, system.equilibria(values, **inputs)[0]).real.max()


def unstable(system, equilibrium):
    return int(np.sum(eigenvalues_at(system, equilibrium).real > 1e-9))


def check_eigenvalues(found, expected):
    assert found.real == pytest.approx(np.real(expected), rel=2e-4)
    assert found.imag == pytest.approx(np.imag(expected), rel=1e-3, abs=1e-9)


# S13


@pytest.mark.parametrize(
    ("v", "expected"),
    [
        (2.0, [-4.588 + 61.67j, -4.588 - 61.67j, -19.96]),
        (20.0, [7.206 + 84.81j, 7.206 - 84.81j, -105.4]),
        (80.0, [-1.784 + 102j, -1.784 - 102j, -293.5]),
    ],
)
def test_castor_has_the_eigenvalues_of_the_calibration(v, expected):
    castor = ed.systems.load(13)
    found = castor.equilibria({"v": v})
    assert found.certified
    (straight,) = found
    assert straight.q == pytest.approx([0.0, 0.0])
    check_eigenvalues(eigenvalues_at(castor, straight), expected)


def test_castor_shimmies_in_the_known_band_of_speeds():
    assert [growth(13, {"v": v}) > 0 for v in (3.9259, 3.9261, 66.0369, 66.0371)] == [
        False,
        True,
        True,
        False,
    ]


def test_castor_settles_as_in_the_calibration_and_keeps_rolling():
    castor = ed.systems.load(13)
    run = castor.equations.function(castor.values())
    y, psi, y_d = solve_ivp(run, (0, 0.5), [0.0, 0.2, 0.0], rtol=1e-11, atol=1e-13).y[:, -1]
    psi_d = (y_d * math.cos(psi) - 2.0 * math.sin(psi)) / 0.1
    expected = [4.070277e-06, 5.096865e-05, 6.365324e-05, -0.0003828406]
    assert [y, psi, y_d, psi_d] == pytest.approx(expected, rel=2e-6)


def test_castor_under_a_side_force_stands_aside():
    castor = ed.systems.load(13)
    (aside,) = castor.equilibria(F=600.0)
    assert aside.q == pytest.approx([0.01, 0.0])
    assert reaction(castor, "lam", aside.q, [0, 0], [0, 0], None, {"F": (600.0, 0, 0)}) == pytest.approx(0.0)


@pytest.mark.parametrize(("couple", "force"), [({}, 0.0), ({"M": 3.0}, -30.0)])
def test_castor_without_lateral_spring_runs_straight_anywhere(couple, force):
    """The ground holds the castor with the side force M/a, and F = -M/a the carriage."""
    castor = ed.systems.load(13)
    found = castor.equilibria({"k_y": 0.0}, **couple)
    assert found.certified
    assert found.neutral == ("y",)
    (straight,) = found
    assert straight.q == pytest.approx([0.0, 0.0])
    assert straight.inputs["F"] == pytest.approx(force)
    stability = ed.stability(ed.linearize(castor.equations, straight))
    assert (stability.verdict, stability.neutral) == ("asymptotically stable", 1)


# S14


def test_rotor_whirls_as_in_the_calibration():
    rotor = ed.systems.load(14)
    (whirl,) = rotor.equilibria()
    assert whirl.q == pytest.approx([-9.8025e-05, -8.6071e-06], rel=1e-5)
    expected = [-7.171 + 134.1j, -7.171 - 134.1j, -26.16 + 765.9j, -26.16 - 765.9j]
    check_eigenvalues(eigenvalues_at(rotor, whirl), expected)
    start = [1.97525e-06, -8.60705e-06, 0, 0]
    end = solve_ivp(rotor.equations.function(rotor.values()), (0, 0.05), start, rtol=1e-11, atol=1e-14)
    expected = [-2.550287e-05, -4.014369e-05, -0.002549125, -0.006609374]
    assert end.y[:, -1] == pytest.approx(expected, rel=2e-6)


def test_shaft_drives_the_disc_against_the_air():
    rotor = ed.systems.load(14)
    (whirl,) = rotor.equilibria()
    couple = reaction(rotor, "M_d", whirl.q, [0, 0], [0, 0], None, {"drive": (0.7, 450.0, 0.0)})
    assert couple == pytest.approx(240.0 * 450.0 * np.sum(whirl.q**2), rel=1e-9)


@pytest.mark.parametrize(("c_e", "c_i"), [(240.0, 160.0), (100.0, 300.0)])
def test_internal_damping_drives_the_whirl_above_the_threshold(c_e, c_i):
    threshold = math.sqrt(1.2e6 / 12.0) * (1 + c_e / c_i)
    below, above = (growth(14, {"Omega": x * threshold, "c_e": c_e, "c_i": c_i}) for x in (0.9999, 1.0001))
    assert below < 0 < above


# S15


def test_spin_stabilizes_the_top_without_springs_unless_it_is_damped():
    bare = {"k_a": 0.0, "k_b": 0.0, "c_a": 0.0, "c_b": 0.0}
    rotor, verdicts = ed.systems.load(15), []
    for changes in ({"Omega": 10.4402}, {"Omega": 10.4404}, {"Omega": 30.0, "c_a": 0.01, "c_b": 0.01}):
        upright = ed.linearize(rotor.equations, {}, rotor.values(**(bare | changes)))
        verdicts.append(ed.eigenvalues(upright).real.max())
    assert verdicts[0] > 1e-3
    assert verdicts[1] == pytest.approx(0.0, abs=1e-9)
    assert verdicts[2] > 1e-4


def test_rotor_at_rest_has_one_frequency_twice():
    rotor = ed.systems.load(15)
    still = rotor.values(Omega=0.0, c_a=0.0, c_b=0.0)
    found = np.abs(ed.eigenvalues(ed.linearize(rotor.equations, {}, still))) / (2 * PI)
    assert found == pytest.approx([3.3335] * 4, abs=5e-5)


def test_gimbal_holds_the_rotor_about_the_third_axis_with_the_gyroscopic_couple():
    """At alpha = 0, X, y' and Z are at right angles: turned about Y alone, C Omega beta_d arises about X."""
    rotor = ed.systems.load(15)
    q, u = [0.0, 0.3], [0.0, 2.0]
    alpha_dd, beta_dd = rotor.newton().accelerations(q, u, rotor.values())
    held = reaction(rotor, "lam", q, u, [alpha_dd, beta_dd])
    s, c = math.sin(0.3), math.cos(0.3)
    # H = (-A alpha_d c, A beta_d, C (Omega + alpha_d s)) in shaft axes; its rate about the vertical.
    rate_x = 0.12 * alpha_dd * c + 0.18 * 20.0 * 2.0
    rate_z = 0.18 * alpha_dd * s
    assert held == pytest.approx(-s * rate_x + c * rate_z, rel=1e-9)


# S16


def test_ship_stays_upright_in_one_of_four_positions_only():
    ship = ed.systems.load(16)
    found = ship.equilibria()
    assert [[round(x, 6) for x in e.q] for e in found] == [
        [a, b] for a in (0.0, round(PI, 6)) for b in (0.0, round(PI, 6))
    ]
    assert [unstable(ship, e) for e in found] == [0, 1, 2, 1]


def test_ship_rolls_as_known_under_waves():
    ship = ed.systems.load(16)
    linear = ed.linearize(ship.equations, ship.equilibria()[0])
    s = 2j * PI * 0.2
    response = np.linalg.solve(
        linear.mass * s**2 + linear.damping * s + linear.stiffness, linear.input_matrices[0][:, 0]
    )
    assert abs(response[0]) == pytest.approx(3.2705e-6, rel=2e-5)


def test_gimbal_bearings_carry_the_gyroscopic_couple_to_the_ship():
    ship = ed.systems.load(16)
    q, u = [0.0, 0.0], [0.0, 0.5]
    phi_dd, theta_dd = ship.newton().accelerations(q, u, ship.values())
    couple = reaction(ship, "B_x", q, u, [phi_dd, theta_dd])
    assert couple == pytest.approx(85.0 * phi_dd + 60.0 * 550.0 * 0.5)  # H turned forward
    q, u = [0.1, 0.4], [0.2, 0.5]
    phi_dd, theta_dd = ship.newton().accelerations(q, u, ship.values())
    motor = reaction(ship, "R_s", q, u, [phi_dd, theta_dd])
    assert motor == pytest.approx(60.0 * (phi_dd * math.sin(0.4) + 0.2 * 0.5 * math.cos(0.4)))


# S17


def test_seat_hangs_where_gravity_and_its_own_radius_say():
    ride = ed.systems.load(17)
    found = ride.equilibria()
    inward, outward = found
    for e, direction in ((outward, 0.0), (inward, PI)):
        alpha = e.q[0]
        radius = 5.0 + 4.0 * math.sin(alpha)
        assert e.q[1] == pytest.approx(direction)
        assert 1.1**2 * radius == pytest.approx(9.81 * math.tan(alpha) * math.cos(direction), rel=1e-9)
        tension = reaction(ride, "S_t", e.q, [0, 0], [0, 0], None, {"drive": (0.3, 1.1, 0.0)})
        pull = 90.0 * math.hypot(9.81, 1.1**2 * radius)
        assert tension == pytest.approx(pull if direction == 0 else -pull, rel=1e-9)
    assert [unstable(ride, e) for e in found] == [2, 0]


def test_no_false_equilibrium_where_the_angles_of_the_seat_fail():
    ride = ed.systems.load(17)
    assert all(abs(e.q[0]) < 1.5 for e in ride.equilibria({"Omega": 2.0}))


# S18


def test_car_runs_straight_and_may_be_anywhere_and_anyhow():
    car = ed.systems.load(18)
    found = car.equilibria()
    assert found.certified
    assert found.neutral == ("y",)
    (straight,) = found
    assert straight.q == pytest.approx([0, 0, 0])
    assert straight.inputs["delta"] == pytest.approx(0)
    stability = ed.stability(ed.linearize(car.equations, straight))
    assert (stability.verdict, stability.neutral) == ("asymptotically stable", 2)


def test_trailer_weaves_above_the_known_speed_and_sooner_with_its_load_behind():
    car = ed.systems.load(18)

    def weave(**changes):
        found = ed.eigenvalues(ed.linearize(car.equations, {}, car.values(**changes)))
        return found[np.abs(found) > 1e-6].real.max()

    assert weave(v=26.3523) < 0 < weave(v=26.3525)
    assert [weave(e=e, v=26.3524) > 1e-4 for e in (2.6, 2.8, 3.1)] == [False, False, True]


@pytest.mark.parametrize("given", [{"F_w": 500.0}, {"delta": 0.02}, {"F_w": -900.0}])
def test_car_is_held_against_a_gust_by_its_steering(given):
    car = ed.systems.load(18)
    found = car.equilibria(**given)
    assert found.certified
    sought = next(name for name in ("delta", "F_w") if name not in given)

    def rows(z):
        return at_rest(18, car.values(), given | {sought: z[2]})([0.0, z[0], z[1]])

    start = [0.0, 0.0, 0.0]
    root, _, flag, _ = fsolve(rows, start, full_output=True, xtol=1e-13)
    assert flag == 1
    (held,) = found
    assert [held.q[1], held.q[2], held.inputs[sought]] == pytest.approx(root, rel=1e-7)


def test_hitch_pulls_the_trailer_against_its_side_force():
    """Running straight askew: the hitch carries the X component of the tire's force."""
    car = ed.systems.load(18)
    theta = 0.1
    q, u = [0.0, 0.0, theta], [0.0, 0.0, 0.0]
    a = list(car.newton().accelerations(q, u, car.values()))
    side = 60000.0 * math.atan(math.tan(theta))
    along = 1000.0 * 2.9 * math.sin(theta) * a[2]  # m times the acceleration of its mass center
    assert reaction(car, "H_x", q, u, a) == pytest.approx(along + side * math.sin(theta), rel=1e-9)


# S22


def torque(R, values, control):
    """What turns the satellite at rest in the attitude R, in body axes, over n squared."""
    J, n = np.array([values["J_1"], values["J_2"], values["J_3"]]), values["n"]
    o2, o3 = R[1], R[2]
    return 3 * np.cross(o3, J * o3) - np.cross(o2, J * o2) + np.array(control) / n**2


def attitudes(values, control=(0.0, 0.0, 0.0)):
    """All attitudes of equilibrium, from many random ones, by Newton's method on the rotation vector."""
    found = []
    for start in Rotation.random(400, random_state=3):

        def turning(w, start=start):
            return torque((start * Rotation.from_rotvec(w)).as_matrix(), values, control)

        w, _, flag, _ = fsolve(turning, np.zeros(3), full_output=True, xtol=1e-13)
        R = (start * Rotation.from_rotvec(w)).as_matrix()
        if flag == 1 and np.max(np.abs(turning(w))) < 1e-8 and all(np.abs(R - o).max() > 1e-5 for o in found):
            found.append(R)
    return found


@pytest.mark.parametrize(
    ("changes", "control", "count"),
    [
        ({}, (0.0, 0.0, 0.0), 24),
        ({"J_1": 20.0, "J_2": 80.0, "J_3": 90.0, "n": -0.002}, (0.0, 0.0, 0.0), 24),
        ({}, (1e-5, -2e-5, 0.7e-5), None),
    ],
)
def test_satellite_keeps_every_attitude_that_a_random_search_finds_and_no_other(changes, control, count):
    satellite = ed.systems.load(22)
    found = satellite.equilibria(changes, **{f"tau_{i}": x for i, x in enumerate(control, 1)})
    assert found.certified
    expected = attitudes(satellite.values(**changes), control)
    assert len(found) == len(expected)
    assert count in (len(found), None)
    for e in found:
        R = Rotation.from_euler("ZYX", e.q).as_matrix()
        assert min(np.abs(R - other).max() for other in expected) < 1e-7
        assert e.residual < 1e-12
        assert abs(e.q[1]) <= PI / 2 + 1e-12


def test_eight_of_the_attitudes_need_other_angles_and_have_them():
    satellite = ed.systems.load(22)
    found = satellite.equilibria()
    verdicts, moved = {}, 0
    for e in found:
        eom, regular = satellite.regular(e)
        moved += eom is not satellite.equations
        assert regular.residual < 1e-12
        R = np.abs(np.round(matrix_321(e.q)))
        along = tuple(int(np.argmax(row)) for row in R)  # which body axis lies along o1, o2, o3
        stability = ed.stability(ed.linearize(eom, regular))
        verdicts.setdefault(along, []).append(np.round(stability.eigenvalues, 9))
    assert moved == 8
    assert [len(same) for same in verdicts.values()] == [4] * 6
    for first, *others in verdicts.values():  # four attitudes of one kind move alike
        assert all(np.allclose(first, other, atol=1e-8) for other in others)


def test_every_attitude_can_be_linearized_as_it_is_found():
    satellite = ed.systems.load(22)
    found = [ed.stability(ed.linearize(satellite.equations, e)).verdict for e in satellite.equilibria()]
    assert found.count("asymptotically stable") == 4


@pytest.mark.parametrize("J", list(itertools.permutations((80.0, 90.0, 20.0))))
def test_librations_are_those_of_the_textbook(J):
    """Small pitch by itself, small roll and yaw coupled: V. A. Chobotov, Spacecraft Attitude Dynamics (1991)."""
    satellite, n, c = ed.systems.load(22), 0.0011, 0.004
    values = satellite.values(J_1=J[0], J_2=J[1], J_3=J[2])
    gyro = n * (J[0] - J[1] + J[2])
    pitch = np.roots([J[1], c, 3 * n**2 * (J[0] - J[2])])
    roll, yaw = [J[0], c, 4 * n**2 * (J[1] - J[2])], [J[2], c, n**2 * (J[1] - J[0])]
    # The damper is anchored to the orbital frame, so that roll and yaw rates are damped by themselves.
    coupled = np.polyadd(np.polymul(roll, yaw), [gyro**2, 0, 0])
    expected = np.concatenate([pitch, np.roots(coupled)])
    found = ed.eigenvalues(ed.linearize(satellite.equations, {}, values))
    assert np.sort_complex(found) == pytest.approx(np.sort_complex(expected), rel=1e-6, abs=1e-12)
    stable = np.all(found.real < 0)
    assert stable == (J == (80.0, 90.0, 20.0))


@pytest.mark.parametrize("changes", [{"J_2": 80.0}, {"J_3": 90.0}, {"J_1": 20.0}, {"n": 0.0}])
def test_attitudes_that_fill_curves_are_refused(changes):
    with pytest.raises(ed.EngdynError, match="not isolated"):
        ed.systems.load(22).equilibria(changes)


@pytest.mark.parametrize("seed", range(5))
def test_both_sequences_of_angles_tell_the_same_motion(seed):
    """Accelerations of the two charts agree as angular accelerations of one body."""
    source, satellite = np.random.default_rng(seed), ed.systems.load(22)
    values = satellite.values(n=0.3)
    R = Rotation.random(random_state=seed).as_matrix()
    w, tau = source.normal(size=3), dict(zip(("tau_1", "tau_2", "tau_3"), source.normal(size=3), strict=True))
    first, second = (
        eom.accelerations(angles(R), w, values, tau)
        for eom, angles in zip(satellite.charts, (angles_321, angles_231), strict=True)
    )
    assert first == pytest.approx(second, rel=1e-10)
    psi, theta, phi = angles_321(R)
    turning = np.array(
        [
            [-math.sin(theta), 0, 1],
            [math.sin(phi) * math.cos(theta), math.cos(phi), 0],
            [math.cos(phi) * math.cos(theta), -math.sin(phi), 0],
        ]
    )
    rates = np.linalg.solve(turning, w)
    udot = satellite.equations.accelerations([psi, theta, phi], rates, values, tau)
    ahead = [np.array([psi, theta, phi]) + rates * s * 1e-6 for s in (-1, 1)]
    spins = [_turning(q) @ (rates + s * 1e-6 * udot) for q, s in zip(ahead, (-1, 1), strict=True)]
    assert first == pytest.approx((spins[1] - spins[0]) / 2e-6, rel=1e-6, abs=1e-8)


def _turning(q):
    _, theta, phi = q
    return np.array(
        [
            [-math.sin(theta), 0, 1],
            [math.sin(phi) * math.cos(theta), math.cos(phi), 0],
            [math.cos(phi) * math.cos(theta), -math.sin(phi), 0],
        ]
    )


def test_no_attitude_is_left_out_by_both_searches():
    for R in Rotation.random(20000, random_state=5).as_matrix():
        assert abs(angles_321(R)[1]) <= PITCH or abs(angles_231(R)[1]) <= SECOND


@pytest.mark.parametrize("seed", range(20))
def test_angles_and_rotation_matrices_belong_together(seed):
    q = np.random.default_rng(seed).uniform([-PI, -PI / 2, -PI], [PI, PI / 2, PI])
    if seed < 4:
        q[1] = (-1) ** seed * PI / 2
    assert matrix_321(q) == pytest.approx(Rotation.from_euler("ZYX", q).as_matrix(), abs=1e-12)
    assert matrix_231(q) == pytest.approx(Rotation.from_euler("YZX", q).as_matrix(), abs=1e-12)
    assert matrix_321(angles_321(matrix_321(q))) == pytest.approx(matrix_321(q), abs=1e-9)
    if seed >= 4:
        assert matrix_231(angles_231(matrix_321(q))) == pytest.approx(matrix_321(q), abs=1e-9)


# Drawings

POSES = {
    13: [[0.0, 0.0], [0.03, 0.35], [-0.04, -0.6], [0.0, 1.2]],
    14: [[1.2e-4, 0.9e-4], [-9.8e-5, -8.6e-6], [0.0, 0.0]],
    15: [[0.0, 0.0], [0.35, 0.4], [-0.5, 0.3]],
    16: [[0.0, 0.0], [0.3, 0.4], [-0.4, -0.7], [2.8, 1.0]],
    17: [[0.0, 0.0], [0.55, 0.5], [0.764, 0.0], [-0.4, -0.8]],
    18: [[0.0, 0.0, 0.0], [0.6, 0.18, -0.3], [-0.7, -0.2, 0.4]],
    22: [[0.0, 0.0, 0.0], [0.5, 0.4, 0.35], [-0.6, 0.3, 1.0], [1.5708, 1.5708, 0.0]],
}


@pytest.mark.parametrize(("number", "q"), [(number, q) for number in NUMBERS for q in POSES[number]])
def test_labels_neither_overlap_nor_leave_the_picture(number, q):
    ax = ed.plots.draw(ed.systems.load(number), q)
    ax.figure.canvas.draw()
    renderer, frame = ax.figure.canvas.get_renderer(), ax.figure.bbox
    extents = [text.get_window_extent(renderer) for text in ax.texts]
    for extent in extents:
        assert frame.x0 <= extent.x0 < extent.x1 <= frame.x1
        assert frame.y0 <= extent.y0 < extent.y1 <= frame.y1
    for a, b in itertools.combinations(extents, 2):
        assert not a.overlaps(b), (a, b)


def plain(text):
    return text.replace("$", " ").replace(",", " ").replace("{", "").replace("}", "").replace("\\ ", " ")


@pytest.mark.parametrize("number", NUMBERS)
def test_a_drawing_names_what_the_model_holds(number):
    system = ed.systems.load(number)
    drawn = system.shapes(POSES[number][1], system.values())
    words = " ".join(plain(getattr(x, "label", "") or getattr(x, "text", "")) for x in drawn).split()
    assert {plain(symbol(p)).strip() for p in system.parameters} - {"g"} <= set(words)
    arrows = [x for x in drawn if isinstance(x, shapes.CoordinateArrow | shapes.AngleArrow)]
    assert sorted(plain(x.label) for x in arrows) == sorted(plain(symbol(c)) for c in system.coordinates)
    pushes = [x for x in drawn if isinstance(x, shapes.ForceArrow | shapes.MomentArrow)]
    acting = {plain(symbol(i)) for i in system.inputs if i.kind != "drive angle"}
    assert acting <= {plain(x.label) for x in pushes}
    weight = any(p.name == "g" for p in system.parameters)
    assert any(isinstance(x, shapes.GravityArrow) for x in drawn) == weight


@pytest.mark.parametrize("number", NUMBERS)
def test_a_system_begins_with_a_pose_that_shows_its_coordinates(number):
    system = ed.systems.load(number)
    assert len(system.pose) == len(system.coordinates)
    assert all(x != 0 for x in system.pose)
    for x, c in zip(system.pose, system.coordinates, strict=True):
        assert c.bounds is None or c.bounds[0] < x < c.bounds[1]


@pytest.mark.parametrize("q", [[0.3, 0.2], [-0.7, 2.0]])
def test_the_rod_of_the_carousel_has_its_length_and_hangs_from_the_arm(q):
    ride = ed.systems.load(17)
    (seat,) = [x.point for x in ride.shapes(q, ride.values()) if isinstance(x, shapes.Particle)]
    (tip,) = [x.point for x in ride.shapes(q, ride.values()) if isinstance(x, shapes.Pin)]
    s_a, c_a, s_b, c_b = math.sin(q[0]), math.cos(q[0]), math.sin(q[1]), math.cos(q[1])
    assert tip == pytest.approx((5.0, 0.0, 0.0))
    assert np.subtract(seat, tip) == pytest.approx([4 * s_a, 4 * c_a * s_b, -4 * c_a * c_b])


def test_the_trailer_of_the_drawing_hangs_on_the_car():
    car = ed.systems.load(18)
    y, psi, theta = q = [0.4, 0.3, -0.5]
    drawn = car.shapes(q, car.values())
    (hitch,) = [x.point for x in drawn if isinstance(x, shapes.Pin)]
    assert hitch == pytest.approx((-2.3 * math.cos(psi), y - 2.3 * math.sin(psi)))
    load = [x.point for x in drawn if isinstance(x, shapes.CenterOfMass)][1]
    assert np.subtract(load, hitch) == pytest.approx([-2.9 * math.cos(theta), -2.9 * math.sin(theta)])
