"""S10, S11, S12, S19, S20 and S21 against their definitions, by the oracle of :mod:`systems.definitions`."""

from __future__ import annotations

import math

import numpy as np
import pytest

import engdyn as ed
from engdyn import shapes
from systems.definitions import (
    Definition,
    Given,
    Moving,
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
    oracle_accelerations,
    plain,
    reaction,
    roots_from_grid,
    steady_gradient,
    unstable,
    verdict_of_changed_load,
)

PI = math.pi


def t_19(v, sin, cos, sqrt):
    x_d = v.x_d - (v.e_x * sin(v.phi) + v.e_y * cos(v.phi)) * v.phi_d - v.r_u * v.drive_d * sin(v.drive)
    y_d = v.y_d + (v.e_x * cos(v.phi) - v.e_y * sin(v.phi)) * v.phi_d + v.r_u * v.drive_d * cos(v.drive)
    return v.m * (v.x_d**2 + v.y_d**2) / 2 + v.J * v.phi_d**2 / 2 + v.m_u * (x_d**2 + y_d**2) / 2


def v_19(v, sin, cos, sqrt):
    height = v.y + (v.e_x * sin(v.phi) + v.e_y * cos(v.phi)) + v.r_u * sin(v.drive)
    first, second = (
        v.x - v.a * cos(v.phi) + v.h * sin(v.phi) + v.a,
        v.x + v.b * cos(v.phi) + v.h * sin(v.phi) - v.b,
    )
    level = v.y - v.h * cos(v.phi) + v.h
    upright = v.k_v * (level - v.a * sin(v.phi)) ** 2 / 2 + v.k_v2 * (level + v.b * sin(v.phi)) ** 2 / 2
    return (v.m * v.y + v.m_u * height) * v.g + v.k_h * (first**2 + second**2) / 2 + upright


def d_19(v, sin, cos, sqrt):
    first = v.x_d + (v.a * sin(v.phi) + v.h * cos(v.phi)) * v.phi_d
    second = v.x_d + (-v.b * sin(v.phi) + v.h * cos(v.phi)) * v.phi_d
    rise, other = (
        v.y_d + (-v.a * cos(v.phi) + v.h * sin(v.phi)) * v.phi_d,
        v.y_d + (v.b * cos(v.phi) + v.h * sin(v.phi)) * v.phi_d,
    )
    return v.c_h * (first**2 + second**2) / 2 + v.c_v * (rise**2 + other**2) / 2


def lift(v):
    return v.rho * v.U**2 * v.A_w * v.C_L / 2 * (v.alpha + v.alpha_g - v.y_d / v.U + v.a_34 * v.alpha_d / v.U)


def wind_torque(v):
    lam = v.tr_d * v.R / v.v
    return v.rho * PI * v.R**3 * v.v**2 / 2 * (v.q_0 + v.q_1 * lam + v.q_2 * lam**2)


def v_10(v, *f):
    mount = v.k_2 * (v.y2 - v.y1) ** 2 / 2 + v.k_3 * (v.y2 - v.y1) ** 4 / 4
    return v.k_1 * (v.y1 - v.yb) ** 2 / 2 + mount + (v.m_1 * v.y1 + v.m_2 * v.y2) * v.g


def t_21(v, sin, cos, sqrt):
    bob = (v.x2_d + v.xg_d + v.L * cos(v.theta) * v.theta_d) ** 2 + (v.L * sin(v.theta) * v.theta_d) ** 2
    return (v.m_1 * (v.x1_d + v.xg_d) ** 2 + v.m_2 * (v.x2_d + v.xg_d) ** 2 + v.m_3 * bob) / 2


DEFINITIONS = {
    10: Definition(
        10,
        "two_stage_isolator",
        "m_1 kg 150.0; m_2 kg 400.0; k_1 N/m 600000.0; k_2 N/m 300000.0; k_3 N/m^3 300000000.0; "
        "c_1 N_s/m 3000.0; c_2 N_s/m 500.0; g m/s^2 9.81",
        [("y1", "m", (-0.1, 0.1)), ("y2", "m", (-0.1, 0.1))],
        [("F", "N", "force"), ("yb", "m", "prescribed motion")],
        (
            lambda v, *f: v.m_1 * v.y1_d**2 / 2 + v.m_2 * v.y2_d**2 / 2,
            v_10,
            lambda v, *f: v.c_1 * (v.y1_d - v.yb_d) ** 2 / 2 + v.c_2 * (v.y2_d - v.y1_d) ** 2 / 2,
            lambda v, *f: 0,
            lambda v, *f: v.F,
        ),
    ),
    11: Definition(
        11,
        "follower_force_mast",
        "m_1 kg 2.0; m_2 kg 1.0; L m 0.5; k_1 N_m/rad 20.0; k_2 N_m/rad 20.0; c_1 N_m_s/rad 0.1; "
        "c_2 N_m_s/rad 0.1; P N 50.0",
        [("theta1", "rad", (-PI / 2, PI / 2)), ("theta2", "rad", (-PI / 2, PI / 2))],
        [("F", "N", "force")],
        (
            lambda v, sin, cos, sqrt: (
                (v.m_1 + v.m_2) * v.L**2 * v.theta1_d**2 / 2
                + v.m_2 * v.L**2 * v.theta2_d**2 / 2
                + v.m_2 * v.L**2 * cos(v.theta1 - v.theta2) * v.theta1_d * v.theta2_d
            ),
            lambda v, *f: v.k_1 * v.theta1**2 / 2 + v.k_2 * (v.theta2 - v.theta1) ** 2 / 2,
            lambda v, *f: v.c_1 * v.theta1_d**2 / 2 + v.c_2 * (v.theta2_d - v.theta1_d) ** 2 / 2,
            lambda v, sin, cos, sqrt: v.P * v.L * sin(v.theta1 - v.theta2) + v.F * v.L * cos(v.theta1),
            lambda v, sin, cos, sqrt: v.F * v.L * cos(v.theta2),
        ),
        signed={"P"},
    ),
    12: Definition(
        12,
        "airfoil_section",
        "m kg 12.0; J_G kg_m^2 0.1; d m 0.04; e m 0.05; a_34 m 0.1; k_h N/m 5000.0; k_a N_m/rad 150.0; "
        "k_c N_m/rad^3 3000.0; c_h N_s/m 10.0; c_a N_m_s/rad 0.15; rho kg/m^3 1.225; A_w m^2 0.3; "
        "C_L 1/rad 5.0; U m/s 15.0",
        [("y", "m", (-0.3, 0.3)), ("alpha", "rad", (-1.2, 1.2))],
        [("alpha_g", "rad", "force"), ("F", "N", "force")],
        (
            lambda v, sin, cos, sqrt: (
                v.m * (v.y_d**2 - 2 * v.d * cos(v.alpha) * v.y_d * v.alpha_d + v.d**2 * v.alpha_d**2) / 2
                + v.J_G * v.alpha_d**2 / 2
            ),
            lambda v, *f: v.k_h * v.y**2 / 2 + v.k_a * v.alpha**2 / 2 + v.k_c * v.alpha**4 / 4,
            lambda v, *f: v.c_h * v.y_d**2 / 2 + v.c_a * v.alpha_d**2 / 2,
            lambda v, *f: lift(v) + v.F,
            lambda v, sin, cos, sqrt: lift(v) * v.e * cos(v.alpha),
        ),
        signed={"d", "e", "a_34", "C_L", "U"},
    ),
    19: Definition(
        19,
        "vibrating_feeder",
        "m kg 280.0; J kg_m^2 60.0; a m 0.7; b m 0.9; h m 0.25; k_v N/m 90000.0; k_v2 N/m 60000.0; "
        "k_h N/m 30000.0; c_v N_s/m 400.0; c_h N_s/m 150.0; m_u kg 10.0; r_u m 0.08; Omega rad/s 100.0; "
        "e_x m 0.2; e_y m 0.3; g m/s^2 9.81",
        [("x", "m", (-0.1, 0.1)), ("y", "m", (-0.1, 0.1)), ("phi", "rad", (-1.5, 1.5))],
        [("F_m", "N", "force"), ("drive", "rad", "drive angle")],
        (t_19, v_19, d_19, lambda v, *f: 0, lambda v, *f: v.F_m, lambda v, *f: 0),
        signed={"Omega", "e_x", "e_y"},
        may_be_zero={"r_u"},
        input_size=100.0,
    ),
    20: Definition(
        20,
        "wind_turbine_drivetrain",
        "J_r kg_m^2 2900000.0; J_1 kg_m^2 500.0; J_2 kg_m^2 3.0; J_g kg_m^2 60.0; N - 80.0; "
        "K_s N_m/rad 100000000.0; C_s N_m_s/rad 400000.0; K_h N_m/rad 200000.0; C_h N_m_s/rad 20.0; "
        "B N_m_s/rad 3000.0; w_0 rad/s 157.08; rho kg/m^3 1.225; R m 35.0; v m/s 11.0; q_0 - -0.03; "
        "q_1 - 0.0425; q_2 - -0.0042",
        [("tr", "rad", None), ("tb", "rad", None), ("tg", "rad", None)],
        [("T_w", "N m", "couple"), ("T_e", "N m", "couple")],
        (
            lambda v, *f: (
                v.J_r * v.tr_d**2 / 2 + (v.J_2 + v.J_1 / v.N**2) * v.tb_d**2 / 2 + v.J_g * v.tg_d**2 / 2
            ),
            lambda v, *f: v.K_s * (v.tr - v.tb / v.N) ** 2 / 2 + v.K_h * (v.tb - v.tg) ** 2 / 2,
            lambda v, *f: v.C_s * (v.tr_d - v.tb_d / v.N) ** 2 / 2 + v.C_h * (v.tb_d - v.tg_d) ** 2 / 2,
            lambda v, *f: wind_torque(v) + v.T_w,
            lambda v, *f: 0,
            lambda v, *f: -v.B * (v.tg_d - v.w_0) + v.T_e,
        ),
        signed={"w_0", "v", "q_0", "q_1", "q_2"},
        unbounded={"tb", "tg"},
        input_size=1e5,
    ),
    21: Definition(
        21,
        "frame_pendulum_damper",
        "m_1 kg 40000.0; m_2 kg 35000.0; m_3 kg 2000.0; k_1 N/m 1200000.0; k_2 N/m 1000000.0; "
        "c_1 N_s/m 6000.0; c_2 N_s/m 5000.0; L m 0.85; c_3 N_m_s/rad 900.0; g m/s^2 9.81",
        [("x1", "m", (-1.0, 1.0)), ("x2", "m", (-1.0, 1.0)), ("theta", "rad", (-PI, PI))],
        [("F_w", "N", "force"), ("xg", "m", "prescribed motion")],
        (
            t_21,
            lambda v, sin, cos, sqrt: (
                v.k_1 * v.x1**2 / 2 + v.k_2 * (v.x2 - v.x1) ** 2 / 2 - v.m_3 * v.g * v.L * cos(v.theta)
            ),
            lambda v, *f: (
                v.c_1 * v.x1_d**2 / 2 + v.c_2 * (v.x2_d - v.x1_d) ** 2 / 2 + v.c_3 * v.theta_d**2 / 2
            ),
            lambda v, *f: 0,
            lambda v, *f: v.F_w,
            lambda v, *f: 0,
        ),
    ),
}
NUMBERS = list(DEFINITIONS)


@pytest.mark.parametrize("number", NUMBERS)
def test_names_units_and_defaults_are_those_of_the_definition(number):
    assert_described_as(DEFINITIONS[number])


@pytest.mark.parametrize("number", NUMBERS)
def test_both_derivations_are_proved_equal_and_independent(number, monkeypatch):
    assert_proved_and_independent(ed.systems.load(number), monkeypatch)


#: Loads that reactions balance entirely: (system, body, index).
CARRIED = {(21, "floor 1", 4), (21, "floor 2", 3)}


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


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("number", NUMBERS)
def test_accelerations_at_random_states(number, seed):
    assert_accelerations(DEFINITIONS[number], seed)


# Equilibria and steady motions

VARIED = {
    10: [({}, {}), ({"k_2": 0.0, "k_3": 1e9}, {}), ({"g": -5.0}, {"yb": 0.02, "F": 900.0})],
    11: [({}, {}), ({"P": 300.0}, {"F": 12.0}), ({"P": -120.0, "k_2": 4.0}, {"F": -7.0})],
    12: [
        ({}, {}),
        ({"U": 1.1 * 57.1429}, {}),
        ({"U": 80.0, "k_c": 0.0, "k_h": 5e4}, {"alpha_g": 0.02, "F": 30.0}),
    ],
    19: [({}, {}), ({"k_v": 9000.0, "k_v2": 12000.0, "m": 90.0}, {}), ({"e_y": -0.4}, {"F_m": 1500.0})],
    21: [({}, {}), ({"g": 3.0}, {"F_w": -2e5})],
}


@pytest.mark.parametrize(
    ("number", "changes", "inputs"), [(n, *changed) for n, cases in VARIED.items() for changed in cases]
)
def test_equilibria_are_those_of_a_brute_force_search(number, changes, inputs):
    definition, system = DEFINITIONS[number], ed.systems.load(number)
    found = system.equilibria(changes, **inputs)
    assert found.certified
    known = {f"{name}_d": 0.0 for name in definition.names} | system.values(**changes)
    known |= {f"{name}{order}": 0.0 for name, *_ in definition.inputs for order in ("", "_d")} | inputs

    def residual(q):
        rows = steady_gradient(definition, known | dict(zip(definition.names, q, strict=True)))
        return np.array(list(rows.values()))

    regions = [region for *_, region in definition.coordinates]
    expected = roots_from_grid(residual, regions, 26 if len(regions) == 2 else 6)
    assert len(found) == len(expected)
    for state, root in zip(sorted(found, key=lambda e: tuple(e.q)), expected, strict=True):
        assert state.q == pytest.approx(root, abs=1e-7)


def speeds_of_generator(values, couple=0.0):
    """Roots of wind torque = N (braking torque), a parabola in the generator speed."""
    N, R, v = values["N"], values["R"], values["v"]
    wind = (
        values["rho"]
        * PI
        * R**3
        / 2
        * np.array([values["q_2"] * R**2, values["q_1"] * v * R, values["q_0"] * v**2])
    )
    parabola = wind / [N**2, N, 1.0] - N * np.array([0.0, values["B"], -values["B"] * values["w_0"] - couple])
    roots = np.roots(parabola)
    return sorted(w.real for w in roots if abs(w.imag) < 1e-9 and -400.0 < w.real < 800.0)


@pytest.mark.parametrize(
    ("changes", "couple", "count"),
    [
        ({}, 0.0, 1),
        ({"B": 4.0}, 0.0, 2),
        ({"B": 0.0}, 0.0, 2),
        ({"B": 5.0, "v": 18.0, "N": 60.0}, 500.0, 2),
        ({"B": 0.0, "v": 38.0}, 0.0, 1),  # the other one is beyond 800 rad/s
        ({"B": 10.0}, -20000.0, 0),
        ({"w_0": -250.0}, 0.0, 1),
        ({"w_0": -450.0}, 0.0, 0),
        ({"v": 0.0, "B": 1.0}, 0.0, 2),
        ({"q_2": 0.0}, 0.0, 1),
    ],
)
def test_all_steady_speeds_of_the_drive_train_are_found(changes, couple, count):
    train = ed.systems.load(20)
    found = train.equilibria(changes, T_e=couple)
    expected = speeds_of_generator(train.values(**changes), couple)
    assert sorted(state.speeds[2] for state in found) == pytest.approx(expected)
    assert (len(found), found.certified) == (count, True)
    N = train.values(**changes)["N"]
    for state in found:
        assert state.q[0] == 0.0
        assert state.speeds[0] * N == pytest.approx(state.speeds[1])
        assert state.speeds[1] == pytest.approx(state.speeds[2])
        calm = {"v": state.values["v"] or 1e-9}  # the formulas divide by the wind speed
        given = Given(DEFINITIONS[20], state.q, state.speeds, state.values | calm, {"T_e": couple})
        assert oracle_accelerations(given) == pytest.approx([0.0] * 3, abs=1e-6)


# Small motion


def jacobian(definition, at, inputs):
    """State matrix from differences of the oracle's accelerations."""
    n = len(at.q)
    z = np.concatenate([at.q, at.speeds])
    columns = []
    for j in range(2 * n):
        ends = []
        for sign in (1, -1):
            moved = z.copy()
            moved[j] += sign * 1e-6
            state = Given(definition, moved[:n], moved[n:], at.values, inputs)
            ends.append(np.concatenate([moved[n:], oracle_accelerations(state)]))
        columns.append((ends[0] - ends[1]) / 2e-6)
    return np.array(columns).T


@pytest.mark.parametrize("number", NUMBERS)
def test_linear_equations_are_those_of_the_oracle_by_differences(number):
    system = ed.systems.load(number)
    for at in system.equilibria():
        expected = jacobian(DEFINITIONS[number], at, {})
        found = ed.linearize(system.equations, at).state_matrix
        np.testing.assert_allclose(found, expected, rtol=1e-6, atol=1e-8 * np.max(np.abs(expected)))


def undamped_hertz(linear):
    """Frequencies from the mass and stiffness matrices alone."""
    squares = np.linalg.eigvals(np.linalg.solve(linear.mass, linear.stiffness))
    return np.sort(np.sqrt(np.maximum(squares.real, 0.0))) / (2 * PI)


def growth(system, values):
    """Largest real part of the eigenvalues about the position without deflection."""
    origin = min(system.equilibria(values), key=lambda e: np.max(np.abs(e.q)))
    return np.max(eigenvalues_at(system, origin).real)


def test_isolator_is_stiffer_where_it_has_sagged():
    isolator = ed.systems.load(10)
    (sagged,) = isolator.equilibria()
    (weightless,) = isolator.equilibria({"g": 0.0})
    found = undamped_hertz(ed.linearize(isolator.equations, sagged))
    assert found == pytest.approx([3.8245, 13.572], rel=2e-5)
    found = undamped_hertz(ed.linearize(isolator.equations, weightless))
    assert found == pytest.approx([3.4809, 12.604], rel=4e-5)


def test_isolator_answers_the_floor_through_spring_and_damper():
    isolator = ed.systems.load(10)
    linear = ed.linearize(isolator.equations, isolator.equilibria()[0])
    s = 2j * PI * 4.0
    column = linear.inputs.index("yb")
    push = sum(b[:, column] * s**k for k, b in enumerate(linear.input_matrices))
    answer = np.linalg.solve(linear.mass * s**2 + linear.damping * s + linear.stiffness, push)
    assert np.abs(answer) == pytest.approx([3.6854, 9.2314], rel=2e-5)


def test_mast_flutters_at_the_known_thrust_and_sooner_when_damped():
    mast = ed.systems.load(11)
    undamped = {"c_1": 0.0, "c_2": 0.0}
    assert abs(growth(mast, undamped | {"P": 83.431})) < 1e-6
    assert growth(mast, undamped | {"P": 83.432}) > 1e-3
    assert growth(mast, {"P": 58.611}) < 0 < growth(mast, {"P": 58.612})
    assert growth(mast, {"P": 70.0}) == pytest.approx(0.0493, rel=2e-3)


def test_thrust_has_no_potential():
    forces = ed.systems.load(11).generalized_forces
    (theta1, first), (theta2, second) = forces.items()
    assert first.diff(theta2) != second.diff(theta1)
    assert ed.linearize(ed.systems.load(11).equations, {}, ed.systems.load(11).values()).stiffness[0, 1] == (
        pytest.approx(-20.0 + 25.0)
    )


def test_wing_flutters_and_diverges_at_the_known_speeds():
    wing = ed.systems.load(12)
    assert growth(wing, {"U": 20.334}) < 0 < growth(wing, {"U": 20.335})
    stiffness = [
        np.linalg.det(ed.linearize(wing.equations, {}, wing.values(U=speed)).stiffness)
        for speed in (57.142, 57.143)
    ]
    assert stiffness[0] > 0 > stiffness[1]


def test_wing_has_a_pitchfork_above_the_divergence_speed():
    wing = ed.systems.load(12)
    assert len(wing.equilibria({"U": 57.14})) == 1
    found = wing.equilibria({"U": 1.1 * 57.142857})
    assert [e.q[1] for e in found] == pytest.approx([-found[2].q[1], 0.0, found[2].q[1]], abs=1e-12)
    assert found[2].q[1] > 0.05


def test_wing_in_still_air_is_defined():
    wing = ed.systems.load(12)
    found = wing.equations.accelerations([0.1, 0.2], [1.0, -2.0], wing.values(U=0.0), {})
    assert np.all(np.isfinite(found))


def test_feeder_has_three_modes_and_answers_its_exciter_as_known():
    feeder = ed.systems.load(19)
    (mean,) = feeder.equilibria()
    linear = ed.linearize(feeder.equations, mean)
    turn, force = 100.0, 10.0 * 0.08 * 100.0**2
    phi = mean.q[2]
    lever = [0.2 * math.sin(phi) + 0.3 * math.cos(phi), 0.2 * math.cos(phi) - 0.3 * math.sin(phi)]
    push = force * np.array([1.0, -1j, -lever[0] - 1j * lever[1]])
    answer = np.linalg.solve(linear.stiffness - turn**2 * linear.mass + 1j * turn * linear.damping, push)
    assert np.abs(answer) == pytest.approx([2.763e-3, 2.885e-3, 5.205e-3], rel=2e-4)


def test_exciter_pushes_the_feeder_with_the_centrifugal_force_of_its_mass():
    """At rest in the mean position the trough starts as if pushed by m_u r_u Omega^2 at E."""
    feeder = ed.systems.load(19)
    (mean,) = feeder.equilibria()
    mass = ed.linearize(feeder.equations, mean).mass
    for angle, gain in ((0.0, 0.0), (0.7, 0.0), (2.1, 40.0)):
        udot = feeder.equations.accelerations(mean.q, [0, 0, 0], mean.values, {"drive": (angle, 100.0, gain)})
        along, across = 0.8 * 100.0**2, 0.8 * gain  # across: what a run-up adds
        x = along * math.cos(angle) + across * math.sin(angle)
        y = along * math.sin(angle) - across * math.cos(angle)
        phi = mean.q[2]
        arm = [0.2 * math.cos(phi) - 0.3 * math.sin(phi), 0.2 * math.sin(phi) + 0.3 * math.cos(phi)]
        assert mass @ udot == pytest.approx([x, y, arm[0] * y - arm[1] * x], rel=1e-9, abs=1e-6)


def test_feeder_turns_at_its_own_speed_where_no_drive_is_given():
    feeder, state = ed.systems.load(19), Moving(DEFINITIONS[19], 7)
    speed = state.values["Omega"]
    given = {"F_m": state.inputs["F_m"]}
    found = feeder.newton().accelerations(state.q, state.u, state.values, given)
    expected = feeder.newton().accelerations(
        state.q, state.u, state.values, given | {"drive": (0.0, speed, 0.0)}
    )
    assert found == pytest.approx(expected, rel=1e-12)


def test_feeder_has_one_branch_of_mean_positions():
    (branch,) = ed.systems.load(19).branches("m_u", (5.0, 15.0))
    assert len(branch.q) > 1


def test_drive_train_has_the_known_frequencies_and_one_motion_without_stiffness():
    train = ed.systems.load(20)
    (steady,) = train.equilibria()
    linear = ed.linearize(train.equations, steady)
    assert undamped_hertz(linear) == pytest.approx([0.0, 2.5835, 43.047], rel=2e-5, abs=1e-4)
    assert train.equilibria().neutral == ("tr",)
    found = ed.eigenvalues(linear)
    assert np.sum(np.abs(found) < 1e-6) == 1
    assert np.sum(found.real > 1e-6) == 0


def test_power_of_the_wind_reaches_the_generator_through_the_teeth():
    train = ed.systems.load(20)
    (steady,) = train.equilibria()
    brake = 3000.0 * (steady.speeds[2] - 157.08)
    tooth = reaction(train, "F_z", steady.q, steady.speeds, [0, 0, 0], r_p=0.15)
    assert tooth * 0.15 == pytest.approx(brake, rel=1e-8)
    lam = steady.speeds[0] * 35.0 / 11.0
    wind = 0.5 * 1.225 * PI * 35.0**3 * 11.0**2 * (-0.03 + 0.0425 * lam - 0.0042 * lam**2)
    assert wind * steady.speeds[0] == pytest.approx(brake * steady.speeds[2], rel=1e-9)
    assert reaction(train, "W_y", steady.q, steady.speeds, [0, 0, 0], r_p=0.15) == pytest.approx(-tooth)
    assert reaction(train, "P_y", steady.q, steady.speeds, [0, 0, 0], r_p=0.15) == pytest.approx(tooth)


def test_pendulum_of_the_known_length_shares_its_damping_with_the_frame():
    frame = ed.systems.load(21)
    found = eigenvalues_at(frame, frame.equilibria({"L": 0.8939})[0])
    slow = sorted(found[found.imag > 0], key=abs)[:2]
    assert [-x.real / abs(x) for x in slow] == pytest.approx([0.04729, 0.04729], rel=2e-4)


def test_frame_holds_its_pendulum_down_and_may_hold_it_up():
    frame = ed.systems.load(21)
    found = frame.equilibria()
    assert [e.q[2] for e in found] == pytest.approx([0.0, PI])
    assert [unstable(frame, e) for e in found] == [0, 1]


def test_pendulum_rod_carries_shear_of_the_hinge_damper_and_the_columns_all_weight():
    frame = ed.systems.load(21)
    q, u, inputs = [0.1, 0.2, 0.7], [0.3, -0.4, 1.6], {"F_w": 9000.0, "xg": (0.0, 0.0, 1.3)}
    udot = oracle_accelerations(Given(DEFINITIONS[21], q, u, frame.values(), inputs))
    assert reaction(frame, "S_t", q, u, udot, inputs) == pytest.approx(-900.0 * 1.6 / 0.85, rel=1e-9)
    rise = 0.85 * (math.sin(0.7) * udot[2] + math.cos(0.7) * 1.6**2)  # of the bob
    assert reaction(frame, "N_1", q, u, udot, inputs) == pytest.approx(77000 * 9.81 + 2000 * rise, rel=1e-9)
    sway = udot[1] + 1.3
    pull = 2000 * (9.81 * math.cos(0.7) + 0.85 * 1.6**2 - math.sin(0.7) * sway)
    assert reaction(frame, "S_a", q, u, udot, inputs) == pytest.approx(pull, rel=1e-9)


def test_root_of_the_mast_feels_thrust_and_momentum():
    mast = ed.systems.load(11)
    q, u, udot = [0.3, 0.8], [1.1, -0.7], [2.0, 5.0]
    t = np.array([-1, 0, 1]) * 1e-4
    angles = [x + v * t + a * t**2 / 2 for x, v, a in zip(q, u, udot, strict=True)]
    place = 2.0 * 0.5 * np.exp(1j * angles[0]) + 1.0 * 0.5 * (np.exp(1j * angles[0]) + np.exp(1j * angles[1]))
    change = (place[0] - 2 * place[1] + place[2]) / 1e-8
    thrust = -50.0 * np.exp(0.8j) + 4.0j
    found = [reaction(mast, name, q, u, udot, {"F": 4.0}) for name in ("O_x", "O_y")]
    assert found == pytest.approx([(change - thrust).real, (change - thrust).imag], rel=1e-5)


def test_guide_of_the_wing_feels_its_mass_center_go_to_and_fro():
    wing = ed.systems.load(12)
    t = np.array([-1, 0, 1]) * 1e-4
    alpha = 0.4 + 2.0 * t - 7.0 * t**2 / 2
    x = -12.0 * 0.04 * np.cos(alpha)
    change = (x[0] - 2 * x[1] + x[2]) / 1e-8
    assert reaction(wing, "S_x", [0.1, 0.4], [0.5, 2.0], [3.0, -7.0]) == pytest.approx(change, rel=1e-5)


# Drawings

POSES = {
    10: [[0.0, 0.0], [0.07, 0.09], [-0.0089925, -0.020535], [0.08, -0.05]],
    11: [[0.0, 0.0], [0.35, 0.9], [0.45, 0.45], [-0.6, -0.2], [-0.3, 0.5]],
    12: [[0.0, 0.0], [0.06, 0.3], [-0.1, -0.3], [0.1, 0.8]],
    19: [[0.0, 0.0, 0.0], [0.06, 0.07, 0.1], [0.00052066, -0.019091, -0.0020818], [-0.08, -0.08, -0.3]],
    20: [[0.0, 0.0, 0.0], [0.0, 0.35, 0.35], [2.0, -50.0, -51.0]],
    21: [[0.0, 0.0, 0.0], [0.25, 0.5, 0.45], [-0.4, -0.7, -0.9], [0.3, -0.2, 2.6]],
}


@pytest.mark.parametrize(("number", "q"), [(number, q) for number in NUMBERS for q in POSES[number]])
def test_labels_neither_overlap_nor_leave_the_picture(number, q):
    assert_labels_are_readable(ed.systems.load(number), q)


@pytest.mark.parametrize("number", NUMBERS)
def test_a_drawing_names_what_the_model_holds(number):
    assert_drawing_names_what_the_model_holds(ed.systems.load(number), POSES[number][1])


def test_the_drawing_of_the_feeder_shows_the_drive():
    feeder = ed.systems.load(19)
    turns = [x for x in feeder.shapes([0, 0, 0]) if isinstance(x, shapes.MomentArrow)]
    assert "\\Omega t" in [plain(x.label).strip() for x in turns]
    places = [x.point for x in feeder.shapes([0, 0, 0]) if isinstance(x, shapes.Particle | shapes.Pin)]
    mass, bearing = places[-2:]
    assert math.dist(mass, bearing) == pytest.approx(0.08)
    assert bearing == pytest.approx((0.2, 0.3))


@pytest.mark.parametrize("number", [10, 19, 21])
def test_springs_and_dampers_of_a_drawing_move_with_what_they_hold(number):
    system = ed.systems.load(number)
    at = [
        [x.end for x in system.shapes(q) if isinstance(x, shapes.Spring | shapes.Damper)]
        for q in POSES[number][:2]
    ]
    assert all(math.dist(a, b) > 1e-3 for a, b in zip(*at, strict=True))
