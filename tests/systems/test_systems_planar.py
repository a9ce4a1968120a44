"""S01, S02, S04, S05, S06, S08 and S09 against their definitions, by the oracle of :mod:`systems.definitions`."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import pytest

import engdyn as ed
from engdyn import shapes
from systems.definitions import (
    Definition,
    assert_accelerations,
    assert_changed_energy_is_refuted,
    assert_described_as,
    assert_drawing_names_what_the_model_holds,
    assert_labels_are_readable,
    assert_other_masses_are_refuted,
    assert_proved_and_independent,
    changed_energies,
    changed_loads,
    eigenvalues_at,
    reaction,
    roots_from_grid,
    steady_gradient,
    unstable,
    verdict_of_changed_load,
)

PI = math.pi

# Parameters (name, unit, default), coordinates (name, unit, bounds), inputs (name, unit, kind)
TABLES = {
    1: {
        "key": "slider_crank_press",
        "parameters": "r m 0.05; L m 0.18; a_c m 0.01; b_r m 0.06; m_c kg 3.0; J_O kg_m^2 0.012; m_r kg 0.8; "
        "J_r kg_m^2 0.003; m_s kg 1.5; k_s N/m 20000.0; x_0 m 0.17; c_g N_s/m 20.0; c_b N_m_s/rad 0.02; "
        "g m/s^2 9.81",
        "coordinates": [("theta", "rad", (-PI, PI))],
        "inputs": [("M_m", "N m", "couple"), ("F_p", "N", "force")],
    },
    2: {
        "key": "snap_through_switch",
        "parameters": "m kg 0.05; b m 0.03; L_0 m 0.0325; k N/m 4000.0; c N_s/m 0.8; g m/s^2 9.81",
        "coordinates": [("y", "m", (-0.05, 0.05))],
        "inputs": [("F", "N", "force"), ("yb", "m", "prescribed motion")],
    },
    4: {
        "key": "inverted_pendulum_seismometer",
        "parameters": "m kg 0.5; l m 0.2; J_G kg_m^2 0.002; k_f N_m/rad 1.06; c_e N_m_s/rad 0.05; g m/s^2 9.81",
        "coordinates": [("theta", "rad", (-PI, PI))],
        "inputs": [("M_c", "N m", "couple"), ("xb", "m", "prescribed motion")],
    },
    5: {
        "key": "bobsleigh_bend",
        "parameters": "m kg 630.0; v m/s 35.0; R m 30.0; rho m 3.0; c N_s/m 600.0; g m/s^2 9.81",
        "coordinates": [("phi", "rad", (-PI, PI))],
        "inputs": [("F_s", "N", "force")],
    },
    6: {
        "key": "turntable_carriage",
        "parameters": "J kg_m^2 0.8; m kg 2.0; e m 0.05; k N/m 1500.0; s_0 m 0.25; c_s N_s/m 8.0; "
        "c_t N_m_s/rad 0.05; Omega rad/s 12.0",
        "coordinates": [("theta", "rad", None), ("s", "m", (0.0, 1.0))],
        "inputs": [("M", "N m", "couple"), ("F", "N", "force")],
    },
    8: {
        "key": "gymnast_high_bar",
        "parameters": "m_1 kg 42.0; L_1 m 1.3; a_1 m 0.75; J_1 kg_m^2 5.0; m_2 kg 23.0; a_2 m 0.4; "
        "J_2 kg_m^2 1.6; k_h N_m/rad 60.0; c_b N_m_s/rad 4.0; c_h N_m_s/rad 6.0; g m/s^2 9.81",
        "coordinates": [("theta1", "rad", (-PI, PI)), ("theta2", "rad", (-2 * PI, 2 * PI))],
        "inputs": [("M_h", "N m", "couple")],
    },
    9: {
        "key": "rolling_drum_robot",
        "parameters": "M_d kg 6.0; R m 0.2; J_d kg_m^2 0.2; m kg 8.0; l m 0.12; J_p kg_m^2 0.05; beta rad 0.05; "
        "c_a N_m_s/rad 0.06; g m/s^2 9.81",
        "coordinates": [("x", "m", None), ("theta", "rad", (-PI, PI))],
        "inputs": [("tau", "N m", "couple")],
    },
}
NUMBERS = list(TABLES)
SIGNED = {"a_c", "e", "x_0", "s_0", "v", "beta", "Omega"}  # parameters that may be negative


def t_1(v, sin, cos, sqrt):
    root = sqrt(1 - (v.r * sin(v.theta) / v.L) ** 2)
    swing = v.r * cos(v.theta) / (v.L * root)
    along = -v.r * sin(v.theta) - v.b_r * (v.r / v.L * sin(v.theta)) * swing
    slope = -v.r * sin(v.theta) - v.L * (v.r / v.L * sin(v.theta)) * swing
    rod = v.m_r * (along**2 + ((1 - v.b_r / v.L) * v.r * cos(v.theta)) ** 2) + v.J_r * swing**2
    return (v.J_O + rod + v.m_s * slope**2) * v.theta_d**2 / 2


def v_1(v, sin, cos, sqrt):
    x_ram = v.r * cos(v.theta) + v.L * sqrt(1 - (v.r * sin(v.theta) / v.L) ** 2)
    weights = v.m_c * v.g * v.a_c * sin(v.theta) + v.m_r * v.g * (1 - v.b_r / v.L) * v.r * sin(v.theta)
    return weights + v.k_s * (x_ram - v.x_0) ** 2 / 2


def slope_1(v, sin, cos, sqrt):
    swing = v.r * cos(v.theta) / (v.L * sqrt(1 - (v.r * sin(v.theta) / v.L) ** 2))
    return -v.r * sin(v.theta) - v.L * (v.r / v.L * sin(v.theta)) * swing


def t_8(v, sin, cos, sqrt):
    own = v.m_1 * v.a_1**2 * v.theta1_d**2 / 2 + v.J_1 * v.theta1_d**2 / 2 + v.J_2 * v.theta2_d**2 / 2
    mixed = 2 * v.L_1 * v.a_2 * cos(v.theta1 - v.theta2) * v.theta1_d * v.theta2_d
    return own + v.m_2 * (v.L_1**2 * v.theta1_d**2 + v.a_2**2 * v.theta2_d**2 + mixed) / 2


def t_9(v, sin, cos, sqrt):
    x_d, y_d = v.x_d * cos(v.beta) + v.l * cos(v.theta) * v.theta_d, v.x_d * sin(v.beta)
    bob = v.m * (x_d**2 + (y_d + v.l * sin(v.theta) * v.theta_d) ** 2) / 2
    return (v.M_d + v.J_d / v.R**2) * v.x_d**2 / 2 + bob + v.J_p * v.theta_d**2 / 2


# Of every system T, V, D and the Q of each coordinate: functions of the numbers and of sin, cos, sqrt.
FORMULAS: dict[int, tuple[Callable, ...]] = {
    1: (
        t_1,
        v_1,
        lambda v, *f: v.c_b * v.theta_d**2 / 2 + v.c_g * (slope_1(v, *f) * v.theta_d) ** 2 / 2,
        lambda v, *f: v.M_m + v.F_p * slope_1(v, *f),
    ),
    2: (
        lambda v, *f: v.m * (v.y_d + v.yb_d) ** 2 / 2,
        lambda v, sin, cos, sqrt: v.k * (sqrt(v.b**2 + v.y**2) - v.L_0) ** 2 + v.m * v.g * (v.y + v.yb),
        lambda v, *f: v.c * v.y_d**2 / 2,
        lambda v, *f: v.F,
    ),
    4: (
        lambda v, sin, cos, sqrt: (
            v.m * ((v.xb_d - v.l * cos(v.theta) * v.theta_d) ** 2 + (v.l * sin(v.theta) * v.theta_d) ** 2) / 2
            + v.J_G * v.theta_d**2 / 2
        ),
        lambda v, sin, cos, sqrt: v.m * v.g * v.l * cos(v.theta) + v.k_f * v.theta**2 / 2,
        lambda v, *f: v.c_e * v.theta_d**2 / 2,
        lambda v, *f: v.M_c,
    ),
    5: (
        lambda v, sin, cos, sqrt: (
            v.m * ((v.rho * v.phi_d) ** 2 + ((v.v / v.R) * (v.R + v.rho * sin(v.phi))) ** 2) / 2
        ),
        lambda v, sin, cos, sqrt: -v.m * v.g * v.rho * cos(v.phi),
        lambda v, *f: v.c * (v.rho * v.phi_d) ** 2 / 2,
        lambda v, *f: v.F_s * v.rho,
    ),
    6: (
        lambda v, *f: (
            v.J * v.theta_d**2 / 2 + v.m * ((v.s_d - v.e * v.theta_d) ** 2 + (v.s * v.theta_d) ** 2) / 2
        ),
        lambda v, *f: v.k * (v.s - v.s_0) ** 2 / 2,
        lambda v, *f: v.c_t * v.theta_d**2 / 2 + v.c_s * v.s_d**2 / 2,
        lambda v, *f: v.M,
        lambda v, *f: v.F,
    ),
    8: (
        t_8,
        lambda v, sin, cos, sqrt: (
            -v.m_1 * v.g * v.a_1 * cos(v.theta1)
            - v.m_2 * v.g * (v.L_1 * cos(v.theta1) + v.a_2 * cos(v.theta2))
            + v.k_h * (v.theta2 - v.theta1) ** 2 / 2
        ),
        lambda v, *f: v.c_b * v.theta1_d**2 / 2 + v.c_h * (v.theta2_d - v.theta1_d) ** 2 / 2,
        lambda v, *f: -v.M_h,
        lambda v, *f: v.M_h,
    ),
    9: (
        t_9,
        lambda v, sin, cos, sqrt: (v.M_d + v.m) * v.g * v.x * sin(v.beta) - v.m * v.g * v.l * cos(v.theta),
        lambda v, *f: v.c_a * (v.theta_d + v.x_d / v.R) ** 2 / 2,
        lambda v, *f: v.tau / v.R,
        lambda v, *f: v.tau,
    ),
}


INPUT_SIZE = {1: 100.0, 5: 3000.0, 8: 30.0}
DEFINITIONS = {
    number: Definition(
        number,
        formulas=FORMULAS[number],
        signed=SIGNED,
        input_size=INPUT_SIZE.get(number, 2.0),
        rate_size=1.0 if number == 9 else 3.0,
        **TABLES[number],
    )
    for number in NUMBERS
}


def names(number):
    return DEFINITIONS[number].names


# What the definition says


@pytest.mark.parametrize("number", NUMBERS)
def test_names_units_and_defaults_are_those_of_the_definition(number):
    assert_described_as(DEFINITIONS[number])


# Two derivations


@pytest.mark.parametrize("number", NUMBERS)
def test_both_derivations_are_proved_equal_and_independent(number, monkeypatch):
    assert_proved_and_independent(ed.systems.load(number), monkeypatch)


#: Loads that reactions balance entirely: (system, body, index).
CARRIED = {(1, "ram", 3)}


@pytest.mark.parametrize(("number", "b", "i", "factor"), list(changed_loads(NUMBERS)))
def test_every_change_of_one_load_is_refuted(number, b, i, factor):
    verdict, body = verdict_of_changed_load(ed.systems.load(number), b, i, factor)
    assert verdict == ("proved" if (number, body, i) in CARRIED else "refuted")


@pytest.mark.parametrize(("number", "name", "i"), list(changed_energies(NUMBERS)))
def test_every_change_of_one_energy_term_is_refuted(number, name, i):
    assert_changed_energy_is_refuted(number, name, i)


@pytest.mark.parametrize("number", NUMBERS)
def test_every_other_mass_or_inertia_is_refuted(number):
    assert_other_masses_are_refuted(ed.systems.load(number))


# Accelerations


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("number", NUMBERS)
def test_accelerations_at_random_states(number, seed):
    assert_accelerations(DEFINITIONS[number], seed)


# Equilibria and steady motions


def brute_force(number, values, inputs=None, rate=0.0):
    """Roots from a dense grid of starts: d(V - T)/dq = Q at constant rates, by complex steps."""
    definition = DEFINITIONS[number]
    sought = [(name, bounds) for name, _, bounds in definition.coordinates if bounds]
    if number == 9:
        sought.append(("tau", (-20.0, 20.0)))  # the torque that holds the drum
    known = dict.fromkeys(names(number), 0.0) | {f"{name}_d": 0.0 for name in names(number)}
    for name, *_ in definition.inputs:
        known |= {name: (inputs or {}).get(name, 0.0), f"{name}_d": 0.0}
    known |= values | ({"theta_d": rate} if number == 6 else {})

    def residual(z):
        at = known | dict(zip((name for name, _ in sought), z, strict=True))
        rows = steady_gradient(definition, at)
        return np.array([row for name, row in rows.items() if (number, name) != (6, "theta")])

    return roots_from_grid(residual, [region for _, region in sought], 90 if len(sought) == 1 else 18)


def counted(number, roots):
    """Roots in the region of S08: the lower end of a turn is its upper end; the hip bends by half a turn."""
    if number != 8:
        return roots
    return [z for z in roots if z[0] > -PI + 1e-6 and abs(z[1] - z[0]) < PI + 1e-6]


VARIED = {
    1: [{}, {"x_0": 0.2, "a_c": -0.02}, {"r": 0.09, "k_s": 300.0}],
    2: [{}, {"L_0": 0.029}, {"k": 60.0}],
    4: [{}, {"k_f": 0.9}, {"k_f": 0.05}],
    5: [{}, {"v": 8.0}, {"R": 5.0, "v": -12.0}],
    6: [{}, {"Omega": -20.0, "e": -0.1}, {"Omega": 26.0}],
    8: [{}, {"k_h": 9.0}, {"k_h": 400.0}],
    9: [{}, {"beta": -0.3}, {"beta": 0.34, "c_a": 0.0}, {"beta": 0.36}],
}


@pytest.mark.parametrize(
    ("number", "changes"), [(number, changes) for number in NUMBERS for changes in VARIED[number]]
)
def test_equilibria_are_those_of_a_brute_force_search(number, changes):
    system = ed.systems.load(number)
    values = system.values(**changes)
    found = system.equilibria(changes)
    assert found.certified
    expected = counted(number, brute_force(number, values, rate=values.get("Omega", 0.0)))
    free = [c.name for c in system.coordinates if c.bounds]
    at = [names(number).index(name) for name in free]
    rows = [[*e.q[at], *([e.inputs["tau"]] if number == 9 else [])] for e in found]
    assert len(rows) == len(expected)
    for row, root in zip(sorted(rows), expected, strict=True):
        assert row == pytest.approx(root, abs=1e-7)


def test_press_has_two_stable_and_two_unstable_positions():
    press = ed.systems.load(1)
    assert [unstable(press, e) for e in press.equilibria()] == [0, 1, 0, 1]


def test_switch_snaps_at_the_known_force():
    switch = ed.systems.load(2)
    assert [unstable(switch, e) for e in switch.equilibria()] == [0, 1, 0]
    assert len(switch.equilibria(F=-2.588)) == 3
    assert len(switch.equilibria(F=-2.590)) == 1


def test_switch_feels_the_acceleration_of_its_base_as_weight():
    switch = ed.systems.load(2)
    lifted = switch.equilibria(yb=(0.0, 0.0, 3.0))
    heavier = switch.equilibria({"g": 12.81})
    assert [e.q[0] for e in lifted] == pytest.approx([e.q[0] for e in heavier])


def test_seismometer_buckles_when_the_flexure_is_soft():
    sensor = ed.systems.load(4)
    assert len(sensor.equilibria({"k_f": 0.99})) == 1  # m g l = 0.981 N m
    assert [e.q[0] for e in sensor.equilibria({"k_f": 0.9})] == pytest.approx(
        [-0.71286, 0.0, 0.71286], abs=5e-6
    )


def test_sled_climbs_to_the_known_angle_and_its_load_is_that_of_two_accelerations():
    sled = ed.systems.load(5)
    inner, outer = sled.equilibria()
    assert outer.q[0] == pytest.approx(1.35533, abs=5e-6)
    assert [unstable(sled, e) for e in (inner, outer)] == [1, 0]
    load = reaction(sled, "N_i", outer.q, [0], [0])
    radius = 30.0 + 3.0 * math.sin(outer.q[0])
    assert load == pytest.approx(630.0 * math.hypot(9.81, (35.0 / 30.0) ** 2 * radius), rel=1e-9)


def test_turntable_is_held_at_its_rate_by_the_torque_of_its_bearing():
    table_ = ed.systems.load(6)
    (motion,) = table_.equilibria()
    assert motion.inputs["M"] == pytest.approx(0.05 * 12.0)
    assert motion.q == pytest.approx([0.0, 1500.0 * 0.25 / (1500.0 - 2.0 * 144.0)])
    assert motion.speeds == pytest.approx([12.0, 0.0])
    assert table_.equilibria().neutral == ("theta",)
    (driven,) = table_.equilibria(M=0.9)
    assert driven.speeds == pytest.approx([18.0, 0.0])
    (free,) = table_.equilibria({"c_t": 0.0}, M=0.0)  # without friction any rate is steady
    assert free.speeds == pytest.approx([12.0, 0.0])
    # One zero for the angle; the rest is of third order.
    assert np.sum(np.abs(eigenvalues_at(table_, motion)) < 1e-9) == 1


def test_gymnast_has_four_equilibria_and_two_ways_to_fall_from_the_handstand():
    gymnast = ed.systems.load(8)
    found = gymnast.equilibria()
    assert [unstable(gymnast, e) for e in found] == [1, 0, 1, 2]
    assert found[-1].q == pytest.approx([PI, PI])


def test_drum_is_held_by_the_known_torque_up_to_the_steepest_slope():
    drum = ed.systems.load(9)
    found = drum.equilibria()
    assert [e.inputs["tau"] for e in found] == pytest.approx([1.37283, 1.37283], abs=5e-6)
    assert [unstable(drum, e) for e in found] == [0, 1]
    assert [len(drum.equilibria({"beta": b})) for b in (0.34995, 0.34996)] == [2, 0]


def test_drum_with_a_given_torque_climbs_steadily_or_accelerates_steadily():
    drum = ed.systems.load(9)
    climbing = drum.equilibria(tau=2.0)[0]
    slope_torque = 14.0 * 9.81 * math.sin(0.05) * 0.2
    assert climbing.speeds[0] == pytest.approx((2.0 - slope_torque) * 0.2 / 0.06)
    for e in drum.equilibria({"c_a": 0.0}, tau=2.0):
        gain, theta = e.accelerations[0], e.q[1]
        assert gain > 0
        push = 8.0 * 0.12 * (9.81 * math.sin(theta) + gain * math.cos(theta - 0.05))
        assert push == pytest.approx(2.0)


# Reactions


def test_bearing_guide_and_weights_of_the_press_change_its_vertical_momentum():
    press = ed.systems.load(1)
    q, u, a = 1.0, 20.0, -35.0
    t = np.array([-1, 0, 1]) * 1e-4
    theta = q + u * t + a * t**2 / 2
    height = 3.0 * 0.01 * np.sin(theta) + 0.8 * (1 - 0.06 / 0.18) * 0.05 * np.sin(theta)
    change = (height[0] - 2 * height[1] + height[2]) / 1e-8
    upward = sum(reaction(press, name, [q], [u], [a]) for name in ("O_y", "N_g"))
    assert upward - (3.0 + 0.8 + 1.5) * 9.81 == pytest.approx(change, rel=1e-5)


def test_bar_carries_the_weight_and_the_swing_of_the_gymnast():
    expected = 65.0 * 9.81 + 16.0 * (42.0 * 0.75 + 23.0 * 1.7)
    found = reaction(ed.systems.load(8), "B_y", [0, 0], [4, 4], [0, 0])
    assert found == pytest.approx(expected, rel=1e-9)


def test_friction_holds_the_drum_on_the_slope():
    drum = ed.systems.load(9)
    at = drum.equilibria()[0]
    forces = [reaction(drum, name, at.q, [0, 0], [0, 0], at.inputs) for name in ("F_f", "N_c")]
    weight = 14.0 * 9.81
    assert forces == pytest.approx([weight * math.sin(0.05), weight * math.cos(0.05)], rel=1e-9)


# Drawings

POSES = {
    1: [[0.45], [1.2], [-2.2], [3.0]],
    2: [[0.0], [0.012], [-0.02], [0.04]],
    4: [[0.0], [0.45], [-0.7], [2.6]],
    5: [[0.0], [0.45], [1.35533], [-1.83]],
    6: [[0.45, 0.0], [0.45, 0.31], [2.2, 0.25], [-0.9, 0.6]],
    8: [[0.35, 0.8], [0.45, 0.45], [-0.5, 0.3], [2.9964, 4.4486]],
    9: [[0.0, 0.146], [0.2, 0.45], [-0.3, -1.0], [0.5, 2.8]],
}


@pytest.mark.parametrize(("number", "q"), [(number, q) for number in NUMBERS for q in POSES[number]])
def test_labels_neither_overlap_nor_leave_the_picture(number, q):
    assert_labels_are_readable(ed.systems.load(number), q)


@pytest.mark.parametrize("number", NUMBERS)
def test_a_drawing_names_what_the_model_holds(number):
    assert_drawing_names_what_the_model_holds(ed.systems.load(number), POSES[number][1])


@pytest.mark.parametrize("theta", [0.3, -2.0, 3.0])
def test_the_rod_of_the_press_has_its_length_whatever_the_angle(theta):
    press = ed.systems.load(1)
    pins = [x.point for x in press.shapes([theta], press.values()) if isinstance(x, shapes.Pin)]
    bearing, pin, ram = pins
    assert [math.dist(bearing, pin), math.dist(pin, ram), ram[1]] == pytest.approx([0.05, 0.18, 0.0])


@pytest.mark.parametrize("y", [-0.04, 0.0, 0.013])
def test_the_springs_of_the_switch_end_at_the_base_points(y):
    switch = ed.systems.load(2)
    springs = [x for x in switch.shapes([y], switch.values()) if isinstance(x, shapes.Spring)]
    assert [x.start for x in springs] == [(-0.03, 0.0), (0.03, 0.0)]
    assert {x.end[1] for x in springs} == {y}
