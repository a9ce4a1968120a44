"""The systems of the catalogue: two independent derivations, every single-term mutation refuted, calibration."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
import sympy as sm
from sympy.physics.mechanics import Force, Particle, RigidBody

import engdyn as ed

CATALOGUE = ["S03", "S07", "S23"]
WORKED = ["W1", "W2", "W3", "W4", "W5", "W6", "W7", "W8", "W9", "W10", "W14", "W15", "W16"]


def lagrange_with(system, **changes):
    """Lagrange's equations with one of T, V, D, Q exchanged."""
    parts = {
        name: changes.get(name, getattr(system, name))
        for name in ("kinetic_energy", "potential_energy", "dissipation", "generalized_forces")
    }
    return ed.lagrange(
        parts["kinetic_energy"],
        parts["potential_energy"],
        [c.symbol for c in system.coordinates],
        parts["dissipation"],
        parts["generalized_forces"],
    )


def newton_with(system, bodies):
    """Newton's equations with other free bodies."""
    return ed.newton_euler(bodies, [c.symbol for c in system.coordinates], system.frame, system.unknowns)


def terms(expression):
    """Additive terms, squares of sums left alone."""
    return [t for t in sm.Add.make_args(expression) if t != 0]


def energy_mutations():
    for key in CATALOGUE:
        system = ed.systems.load(key)
        for name in ("kinetic_energy", "potential_energy", "dissipation"):
            whole = getattr(system, name)
            for i, term in enumerate(terms(whole)):
                for what, factor in (("dropped", 0), ("sign", -1), ("twice", 2)):
                    yield pytest.param(key, name, whole + (factor - 1) * term, id=f"{key}-{name}-{i}-{what}")
        for q, force in system.generalized_forces.items():
            for i, term in enumerate(terms(force)):
                for what, factor in (("dropped", 0), ("sign", -1), ("twice", 2)):
                    forces = {**system.generalized_forces, q: force + (factor - 1) * term}
                    yield pytest.param(key, "generalized_forces", forces, id=f"{key}-Q-{q.func}-{i}-{what}")


def load_mutations():
    for key in CATALOGUE:
        for b, body in enumerate(ed.systems.load(key).free_bodies()):
            for i in range(len(body.applied)):
                for what in ("dropped", "sign", "twice"):
                    yield pytest.param(key, b, i, what, id=f"{key}-{body.name}-load{i}-{what}")


@pytest.mark.parametrize("key", CATALOGUE + WORKED)
def test_both_derivations_are_proved_equal(key):
    proof = ed.systems.load(key).prove()
    assert proof.verdict == "proved"
    assert proof.witness is None
    assert not proof.differences


@pytest.mark.parametrize("key", CATALOGUE)
def test_newton_works_without_energies_and_lagrange_without_free_bodies(key, monkeypatch):
    system = ed.systems.load(key)
    reference = system.newton()

    def forbidden(*_):
        raise AssertionError("this route must not be used")

    with monkeypatch.context() as patch:
        for name in ("kinetic_energy", "potential_energy", "dissipation", "generalized_forces"):
            patch.setattr(ed.System, name, property(forbidden))
        alone = system.newton()
    with monkeypatch.context() as patch:
        patch.setattr(ed.System, "free_bodies", forbidden)
        other = system.lagrange()
    assert ed.prove_equal(alone, reference)
    assert ed.prove_equal(alone, other)


@pytest.mark.parametrize(("key", "name", "mutated"), list(energy_mutations()))
def test_every_change_of_one_energy_term_is_refuted(key, name, mutated):
    system = ed.systems.load(key)
    if name == "kinetic_energy" and any(mutated.diff(c.symbol.diff()) == 0 for c in system.coordinates):
        with pytest.raises(ed.EngdynError, match="singular mass matrix"):
            lagrange_with(system, **{name: mutated})
        return
    assert_refuted(lagrange_with(system, **{name: mutated}), system.newton())


@pytest.mark.parametrize(("key", "b", "i", "what"), list(load_mutations()))
def test_every_change_of_one_load_is_refuted(key, b, i, what):
    system = ed.systems.load(key)
    bodies = system.free_bodies()
    loads = list(bodies[b].applied)
    load = loads.pop(i)
    if what != "dropped":
        factor = -1 if what == "sign" else 2
        changed = Force(load.point, factor * load.force) if isinstance(load, Force) else None
        loads.insert(i, changed or type(load)(load.frame, factor * load.torque))
    bodies[b] = ed.FreeBody(bodies[b].body, loads, bodies[b].reactions)
    wrong = newton_with(system, bodies)
    if (key, bodies[b].name, i) == ("S07", "trolley", 2):  # its weight: the rail carries it, whatever it is
        assert ed.prove_equal(wrong, system.lagrange())
        assert wrong.reactions != system.newton().reactions
    else:
        assert_refuted(wrong, system.lagrange())


@pytest.mark.parametrize("key", CATALOGUE)
def test_every_other_mass_or_inertia_is_refuted(key):
    system = ed.systems.load(key)
    for b, body in enumerate(system.free_bodies()):
        bodies = system.free_bodies()
        old = body.body
        if isinstance(old, Particle):
            heavier = [Particle(old.name, old.point, 2 * old.mass)]
        else:
            tensor = old.central_inertia
            heavier = [
                RigidBody(old.name, old.masscenter, old.frame, 2 * old.mass, (tensor, old.masscenter)),
                RigidBody(old.name, old.masscenter, old.frame, old.mass, (2 * tensor, old.masscenter)),
            ]
        for new in heavier:
            bodies[b] = ed.FreeBody(new, body.applied, body.reactions)
            assert_refuted(newton_with(system, bodies), system.lagrange())


def assert_refuted(wrong, right):
    """Refuted, by a witness whose accelerations differ when they are computed independently."""
    proof = ed.prove_equal(wrong, right)
    assert proof.verdict == "refuted", proof
    assert not proof
    first, second = proof.witness.values
    assert first != pytest.approx(second, rel=1e-12)
    assert proof.differences
    found = [accelerations_at(eom, proof.witness.state) for eom in (wrong, right)]
    names = [q.func.__name__ for q in right.coordinates]
    at = names.index(proof.witness.quantity.split()[-1])
    assert found[0][at] == pytest.approx(first, rel=1e-9)
    assert found[1][at] == pytest.approx(second, rel=1e-9)


def accelerations_at(eom, state):
    """Accelerations at a witness's state, through M and f as floats."""
    names = [q.func.__name__ for q in eom.coordinates]
    q = [state.get(name, 0.0) for name in names]
    u = [state.get(f"{name}'", 0.0) for name in names]
    inputs = {
        w.func.__name__: [state.get(w.func.__name__ + "'" * k, 0.0) for k in (0, 1, 2)] for w in eom.inputs
    }
    values = {p.name: state.get(p.name, 1.0) for p in eom.parameters}
    return eom.accelerations(q, u, values, inputs)


@pytest.mark.parametrize("key", CATALOGUE)
def test_a_constant_in_the_potential_changes_nothing(key):
    system = ed.systems.load(key)
    assert ed.prove_equal(
        lagrange_with(system, potential_energy=system.potential_energy + 5), system.newton()
    )


def test_equal_at_every_state_tried_so_far_is_not_equal():
    """A difference that vanishes at the first states of the search is still found."""
    from engdyn.modeling.witness import sample_states

    crane = ed.systems.load("S07")
    theta = crane.coordinates[1].symbol
    key = ("function", theta, 0)
    keys = list(crane.newton().occurring)
    seen = {state[key] for _, state in zip(range(12), sample_states(keys), strict=False) if key in state}
    numbers = [sm.Rational(x.numerator, x.denominator) for x in sorted(seen)]
    product = sm.prod([theta - x for x in numbers[:9]]) * sm.prod([sm.sin(theta - x) for x in numbers[9:]])
    wrong = lagrange_with(crane, potential_energy=crane.potential_energy + product**2)
    assert ed.prove_equal(wrong, crane.newton()).verdict == "refuted"


def test_what_is_too_large_to_expand_is_said_to_be_so():
    crane = ed.systems.load("S07")
    theta = crane.coordinates[1].symbol
    product = sm.prod([sm.sin(theta - sm.Rational(k, 101)) for k in range(30, 60)])
    crane.potential_energy = crane.potential_energy + product
    proof = crane.prove()
    assert proof.verdict == "undecided"
    assert "too many terms" in proof.method


def test_gravity_in_v_and_as_a_force_is_named():
    crane = ed.systems.load("S07")
    theta = crane.coordinates[1].symbol
    weight = sm.diff(crane.potential_energy, theta)
    forces = {**crane.generalized_forces, theta: crane.generalized_forces[theta] - weight}
    with pytest.raises(ed.EngdynError, match="gravity is counted twice"):
        lagrange_with(crane, generalized_forces=forces)


def test_too_few_reactions_are_counted_and_named():
    crane = ed.systems.load("S07")
    trolley, container = crane.free_bodies()
    unsupported = ed.FreeBody(trolley.body, trolley.applied, trolley.reactions[:1])
    with pytest.raises(ed.EngdynError, match="5 equations for 2 accelerations and 2 reactions"):
        ed.newton_euler(
            [unsupported, container], [c.symbol for c in crane.coordinates], crane.frame, crane.unknowns[:2]
        )


def test_the_reactions_of_the_crane_are_those_found_by_hand():
    crane = ed.systems.load("S07")
    eom = crane.newton()
    values = crane.values()
    state = {"theta": 0.4, "theta_d": 0.3, "theta_dd": -0.7}
    m, M_t, L, g = (values[name] for name in ("m", "M_t", "L", "g"))
    lift = L * (math.sin(0.4) * state["theta_dd"] + math.cos(0.4) * state["theta_d"] ** 2)
    theta = crane.coordinates[1].symbol
    t = theta.args[0]
    reaction = eom.reactions[next(x for x in crane.unknowns if x.name == "N_r")]
    number = reaction.subs({theta.diff(t, 2): -0.7}).subs({theta.diff(t): 0.3}).subs({theta: 0.4})
    number = number.subs({p.symbol: values[p.name] for p in crane.parameters})
    assert float(number) == pytest.approx((m + M_t) * g + m * lift, rel=1e-12)


def test_a_drive_that_speeds_up_needs_a_force_on_the_balls():
    governor = ed.systems.load("S03")
    azimuth = governor.newton().reactions[next(x for x in governor.unknowns if x.name == "N_a")]
    drive = next(i.symbol for i in governor.inputs if i.name == "drive")
    theta, t = governor.coordinates[0].symbol, drive.args[0]
    m, l = (next(p.symbol for p in governor.parameters if p.name == name) for name in "ml")
    expected = m * l * (sm.sin(theta) * drive.diff(t, 2) + 2 * sm.cos(theta) * theta.diff(t) * drive.diff(t))
    assert sm.expand(azimuth - expected) == 0


# Calibration: values of the definition of each system, to the digits given there

EIGENVALUES = {
    ("S03", 2): [-1.327 + 9.563j, -1.327 - 9.563j],
    ("S03", 1): [13.17, -14.17],
    ("S07", 0): [0, -0.1089, -0.1364 + 1.781j, -0.1364 - 1.781j],
    ("S07", 1): [1.667, 0, -0.1073, -1.942],
    ("S23", 0): [
        *(-1.247 + 6.431j, -1.247 - 6.431j, -2.182 + 6.933j, -2.182 - 6.933j),
        *(-16.53 + 67.26j, -16.53 - 67.26j, -22.6 + 68.14j, -22.6 - 68.14j),
    ],
}
STATES = {
    "S03": [[-0.77269], [0.0], [0.77269]],
    "S07": [[0, 0], [0, math.pi]],
    "S23": [[-0.215518, -0.015372, -0.025851, -0.019331]],
}


@pytest.mark.parametrize("key", CATALOGUE)
def test_equilibria_are_those_of_the_definition(key):
    found = ed.systems.load(key).equilibria()
    assert found.certified
    np.testing.assert_allclose([state.q for state in found], STATES[key], atol=6e-6)


@pytest.mark.parametrize(("key", "at"), list(EIGENVALUES))
def test_eigenvalues_are_those_of_the_definition(key, at):
    system = ed.systems.load(key)
    state = system.equilibria()[at]
    for eom in (system.newton(), system.lagrange()):
        found = ed.eigenvalues(ed.linearize(eom, state))
        np.testing.assert_allclose(found, EIGENVALUES[key, at], rtol=6e-4, atol=6e-5)


def test_the_accelerating_crane_is_that_of_the_definition():
    crane = ed.systems.load("S07")
    found = crane.equilibria(crane.values(c_x=0), F=3700.0)
    assert found.certified
    np.testing.assert_allclose([state.q[1] for state in found], [-0.10159, 3.04001], atol=6e-6)
    np.testing.assert_allclose([state.accelerations[0] for state in found], 1.0, rtol=1e-12)
    verdicts = [ed.stability(ed.linearize(crane.equations, state)) for state in found]
    assert [v.neutral for v in verdicts] == [2, 2]
    np.testing.assert_allclose(
        verdicts[0].eigenvalues, [0, 0, -0.02854 + 1.779j, -0.02854 - 1.779j], rtol=6e-4, atol=1e-6
    )
    np.testing.assert_allclose(sorted(verdicts[1].eigenvalues.real)[::3], [-1.808, 1.751], rtol=6e-4)


@pytest.mark.parametrize("key", CATALOGUE)
def test_defaults_do_not_leak_between_copies(key):
    first, second = ed.systems.load(key), ed.systems.load(key)
    first.kinetic_energy = 2 * first.kinetic_energy
    assert second.prove()
    assert not first.prove()
    eom = second.newton()
    assert replace(eom, defaults={}).coordinates == eom.coordinates
