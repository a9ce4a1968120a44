"""W1 collar in a slotted arm and W2 manipulator: two derivations, known states, drawings."""

from __future__ import annotations

import math

import numpy as np
import pytest
import sympy as sm

import engdyn as ed
from engdyn import shapes
from engdyn.modeling.instants import number_at
from engdyn.systems import w01_collar_in_arm as w01
from engdyn.systems import w02_manipulator as w02

W1, W2 = ed.systems.load("W1"), ed.systems.load("manipulator")


def refuted(wrong, right):
    proof = ed.prove_equal(wrong, right)
    return proof.verdict == "refuted" and proof.differences


@pytest.mark.parametrize("system", [W1, W2], ids=repr)
def test_both_derivations_are_proved_equal(system):
    assert system.prove().verdict == "proved"


@pytest.mark.parametrize("system", [W1, W2], ids=repr)
@pytest.mark.parametrize("part", ["kinetic_energy", "potential_energy", "dissipation"])
def test_every_energy_term_matters(system, part):
    """Each term of T, V and D taken twice is refuted: no term is there in one derivation only."""
    for term in sm.Add.make_args(sm.expand(getattr(system, part))):
        if term == 0 or not term.atoms(sm.Function):
            continue
        parts = {
            name: getattr(system, name) for name in ("kinetic_energy", "potential_energy", "dissipation")
        }
        parts[part] = parts[part] + term
        wrong = ed.lagrange(
            parts["kinetic_energy"],
            parts["potential_energy"],
            [c.symbol for c in system.coordinates],
            parts["dissipation"],
            system.generalized_forces,
        )
        assert refuted(wrong, system.newton()), term


@pytest.mark.parametrize("system", [W1, W2], ids=repr)
def test_every_drive_does_work_as_lagrange_says(system):
    for q, force in system.generalized_forces.items():
        wrong = ed.lagrange(
            system.kinetic_energy,
            system.potential_energy,
            [c.symbol for c in system.coordinates],
            system.dissipation,
            {**system.generalized_forces, q: -force},
        )
        assert refuted(wrong, system.newton())


def test_the_normal_force_on_the_collar_has_three_parts():
    """Weight across the arm, Euler and Coriolis terms; at rest and level it carries the weight."""
    found = W1.newton().reactions[w01.N_c]
    t = w01.theta.args[0]
    expected = w01.m * (w01.g * sm.cos(w01.theta) + w01.r * w01.theta.diff(t, 2) + 2 * w01.r_d * w01.theta_d)
    assert sm.expand(found - expected) == 0


def test_the_arm_stands_or_hangs():
    """Equilibria of W1 by hand: upright or hanging, spring force = weight of the collar."""
    v, found = W1.values(), W1.equilibria()
    sag = v["m"] * v["g"] / v["k"]
    assert found.certified
    np.testing.assert_allclose(
        [e.q for e in found], [[-math.pi / 2, v["l_0"] + sag], [math.pi / 2, v["l_0"] - sag]], atol=1e-9
    )


def test_the_arm_is_a_real_body():
    """Its moment of inertia about the pivot exceeds that of its mass at the mass center."""
    v = W1.values()
    assert v["J_O"] > v["m_a"] * v["a"] ** 2
    arm = w01.free_bodies()[1].body
    about_center = arm.central_inertia.dot(w01.ground.z).dot(w01.ground.z)
    assert sm.expand(about_center - (w01.J_O - w01.m_a * w01.a**2)) == 0


def test_the_drives_of_the_manipulator_hold_it_still():
    v = W2.values()
    q, u = [0.3, 0.5, 1.2], [0.0, 0.0, 0.0]
    lift = (v["m_b"] * v["a"] + v["m"] * 1.2) * v["g"] * math.cos(0.5)
    hold = {"M_psi": 0.0, "M_beta": lift, "F": v["m"] * v["g"] * math.sin(0.5)}
    np.testing.assert_allclose(W2.equations.accelerations(q, u, v, hold), 0, atol=1e-12)


def at_rest(system, **state):
    """Reactions by name, with all rates and accelerations zero."""
    values = {**system.values(), **state}
    for c in system.coordinates:
        values |= {f"{c.name}_d": 0.0, f"{c.name}_dd": 0.0}
    return {u.name: number_at(e, values) for u, e in system.newton().reactions.items()}


def test_the_pin_carries_both_weights_when_arm_and_collar_hang_still():
    v = W1.values()
    found = at_rest(W1, theta=-math.pi / 2, r=v["l_0"] + v["m"] * v["g"] / v["k"], M=0.0)
    assert found["O_x"] == pytest.approx(0.0, abs=1e-9)
    assert found["O_y"] == pytest.approx((v["m"] + v["m_a"]) * v["g"])


def test_the_foot_of_the_manipulator_carries_all_weights_and_their_moment():
    v = W2.values()
    moment = (v["m_b"] * v["a"] + v["m"] * 1.2) * v["g"] * math.cos(0.5)
    drives = {"M_psi": 0.0, "M_beta": moment, "F": v["m"] * v["g"] * math.sin(0.5)}
    found = at_rest(W2, psi=0.3, beta=0.5, r=1.2, **drives)
    assert found["G_z"] == pytest.approx((v["m_c"] + v["m_b"] + v["m"]) * v["g"])
    assert found["C_y"] == pytest.approx(-moment)  # the weights turn about +y of the column
    for name in ("G_x", "G_y", "C_x"):
        assert found[name] == pytest.approx(0.0, abs=1e-9)


def test_a_sweeping_manipulator_keeps_its_angular_momentum():
    """Without a yaw drive: drawing the load in makes it faster, as H_z says."""
    v = W2.values()

    def momentum(q, u):
        reach = v["J_b"] + v["m_b"] * v["a"] ** 2 + v["m"] * q[2] ** 2
        return (v["J_c"] + reach * math.cos(q[1]) ** 2) * u[0]

    q, u, h = np.array([0.0, 0.4, 1.5]), np.array([1.2, 0.3, -0.5]), 1e-6
    a = W2.equations.accelerations(q, u, v, {"M_psi": 0.0, "M_beta": 30.0, "F": -4.0})
    rate = (momentum(q + h * u, u + h * a) - momentum(q - h * u, u - h * a)) / (2 * h)
    assert rate == pytest.approx(0.0, abs=1e-6)
    assert abs(a[0]) > 0.1


# Drawings


def of(kind, drawn):
    return [shape for shape in drawn if isinstance(shape, kind)]


@pytest.mark.parametrize("theta", [-2.0, 0.0, 0.6, 1.5])
def test_the_collar_is_drawn_where_the_coordinates_say(theta):
    drawn = W1.shapes([theta, 0.36])
    (arrow,) = of(shapes.CoordinateArrow, drawn)
    assert math.dist(arrow.start, arrow.end) == pytest.approx(0.36)
    centers = [box.center for box in of(shapes.Box, drawn)]
    assert any(np.allclose(center, (0.36 * math.cos(theta), 0.36 * math.sin(theta))) for center in centers)
    (center,) = of(shapes.CenterOfMass, drawn)
    assert center.point == pytest.approx((0.25 * math.cos(theta), 0.25 * math.sin(theta)))


def test_the_load_is_drawn_where_the_model_has_it():
    q = [0.7, 0.5, 1.1]
    (load,) = of(shapes.Particle, W2.shapes(q))
    tip = w02.free_bodies()[2].center
    foot = next(iter(next(iter(tip._pos_dict))._pos_dict))
    values = {"psi": 0.7, "beta": 0.5, "r": 1.1, "h": 0.6}
    np.testing.assert_allclose(load.point, ed.components(tip.pos_from(foot), w02.ground, values), atol=1e-12)


@pytest.mark.parametrize("system", [W1, W2], ids=repr)
def test_everything_in_the_model_is_written_on_the_drawing(system):
    q = [0.5 if c.unit == "rad" else 0.35 for c in system.coordinates]
    drawn = system.shapes(q)
    words = " ".join(getattr(s, "label", "") or getattr(s, "text", "") for s in drawn)
    for letter in {"$", "\\", "{", "}", ","}:
        words = words.replace(letter, " " if letter in "$," else "")
    for item in (*system.parameters, *system.coordinates, *system.inputs):
        assert item.name in words.split(), item.name
    assert ed.plots.alt(ed.plots.draw(system, q))
