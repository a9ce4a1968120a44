"""Newton and Euler: free bodies counted, reactions found, accelerations those of closed forms."""

from __future__ import annotations

import math

import numpy as np
import pytest
import sympy as sm
from sympy.physics.mechanics import (
    Force,
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
m, M, l, g, k, J, c = sm.symbols("m M l g k J c", positive=True)
N_x, N_y, N_z, S = sm.symbols("N_x N_y N_z S")
theta, x, F = dynamicsymbols("theta x F")
ground = ReferenceFrame("N")


def pendulum(reactions=None, applied=(), body=None):
    """A bob on a rod: the free body and its coordinate."""
    rod = ReferenceFrame("A")
    rod.orient_axis(ground, theta, ground.z)
    pivot = Point("O")
    pivot.set_vel(ground, 0)
    bob = pivot.locatenew("P", -l * rod.y)
    loads = [Force(bob, S * rod.y)] if reactions is None else reactions(rod, bob)
    weight = Force(bob, -m * g * ground.y)
    return ed.FreeBody(body(bob) if body else Particle("bob", bob, m), [weight, *applied], loads)


def test_a_pendulum_and_its_rod_force():
    eom = ed.newton_euler([pendulum()], [theta], ground, [S])
    assert ed.prove_equal(
        eom, ed.lagrange(m * l**2 * theta.diff(t) ** 2 / 2, -m * g * l * sm.cos(theta), [theta])
    )
    assert sm.expand(eom.reactions[S] - m * (g * sm.cos(theta) + l * theta.diff(t) ** 2)) == 0
    assert eom.origin == "Newton-Euler"


def test_one_free_body_or_unknown_needs_no_list():
    single = ed.newton_euler(pendulum(), [theta], ground, S)
    assert ed.prove_equal(single, ed.newton_euler([pendulum()], [theta], ground, [S]))


# Counting


def test_a_missing_reaction_is_counted_and_its_equation_named():
    with pytest.raises(ed.EngdynError) as caught:
        ed.newton_euler([pendulum(lambda rod, bob: [])], [theta], ground, [])
    message = str(caught.value)
    assert "2 equations for 1 accelerations and 0 reactions: 1 reaction is missing" in message
    assert "Nothing can satisfy: bob: forces along N." in message


def test_a_reaction_that_was_not_listed_is_named():
    with pytest.raises(ed.EngdynError, match="The reactions contain S, not listed among the unknowns"):
        ed.newton_euler([pendulum()], [theta], ground, [])


def test_too_many_reactions_are_counted():
    def both(rod, bob):
        return [Force(bob, S * rod.y), Force(bob, N_x * rod.x)]

    with pytest.raises(ed.EngdynError, match="2 equations for 1 accelerations and 2 reactions: 1 too many"):
        ed.newton_euler([pendulum(both)], [theta], ground, [S, N_x])


def test_reactions_along_one_line_cannot_be_told_apart():
    """Two bobs, one of them unsupported, the other held twice: the count fits, the reactions do not."""

    def twice(rod, bob):
        return [Force(bob, (S + N_x) * rod.y)]

    free = Point("Q")
    free.set_vel(ground, x.diff(t) * ground.x)
    block = ed.FreeBody(Particle("block", free, M), [Force(free, -M * g * ground.y)])
    with pytest.raises(ed.EngdynError, match=r"N_x do not act independently|S do not act independently"):
        ed.newton_euler([pendulum(twice), block], [theta, x], ground, [S, N_x])


def test_rows_that_read_zero_equals_zero_are_not_counted():
    eom = ed.newton_euler([pendulum()], [theta], ground, [S])
    assert eom.mass_matrix.shape == (1, 1)

    def out_of_plane(rod, bob):
        return [Force(bob, S * rod.y), Force(bob, N_z * ground.z)]

    supported = ed.newton_euler([pendulum(out_of_plane)], [theta], ground, [S, N_z])
    assert supported.reactions[N_z] == 0
    assert ed.prove_equal(supported, eom)


# Models that are not complete


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: ed.newton_euler([pendulum()], [theta], ground, [S, N_x]), "N_x act on no free body"),
        (lambda: ed.newton_euler([pendulum()], [theta], ground, [S, S]), "each once"),
        (lambda: ed.newton_euler([pendulum()], [theta], ground, [F]), "symbols of the reaction magnitudes"),
        (lambda: ed.newton_euler([], [theta], ground, []), "no free bodies"),
        (lambda: ed.newton_euler([Particle("p", Point("P"), m)], [theta], ground, []), "not a FreeBody"),
        (lambda: ed.newton_euler([pendulum()], theta, ground, [S]), "must be a list of dynamicsymbols"),
        (lambda: ed.newton_euler([pendulum()], [sm.Symbol("q")], ground, [S]), "not a dynamicsymbol"),
        (lambda: ed.newton_euler([pendulum()], [theta, theta], ground, [S]), "each of them once"),
        (lambda: ed.newton_euler([pendulum()], [], ground, [S]), "at least one"),
        (lambda: ed.newton_euler([pendulum()], [theta], "N", [S]), "inertial ReferenceFrame"),
        (lambda: ed.FreeBody("bob"), "needs a Particle or a RigidBody"),
        (lambda: ed.FreeBody(Particle("p", Point("P"), m), [m * ground.x]), "neither a Force nor a Torque"),
        (
            lambda: ed.newton_euler([pendulum(lambda r, p: [Force(p, S**2 * r.y)])], [theta], ground, [S]),
            "not linear in the unknown reactions",
        ),
        (
            lambda: ed.newton_euler(
                [pendulum(applied=[Torque(ground, c * theta.diff(t) * ground.z)])], [theta], ground, [S]
            ),
            "torque acts on the particle bob",
        ),
        (
            lambda: ed.newton_euler([pendulum()], [theta], ground, [S], speeds=[x], kinematics=None),
            "rates of .*theta.* not described",
        ),
        (
            lambda: ed.newton_euler([pendulum()], [theta], ground, [S], kinematics={theta: x}),
            "kinematics needs speeds",
        ),
        (
            lambda: ed.newton_euler(
                [pendulum()], [theta], ground, [S], speeds=[x], kinematics={theta: x, F: x}
            ),
            "not among the coordinates",
        ),
        (
            lambda: ed.newton_euler(
                [pendulum()], [theta], ground, [S], constraints=[theta.diff(t)], kinematics={theta: x}
            ),
            "either constraints or kinematics",
        ),
    ],
)
def test_incomplete_models_are_refused(make, message):
    with pytest.raises(ed.EngdynError, match=message):
        make()


def test_a_frame_that_is_not_oriented():
    loose, origin = ReferenceFrame("B"), Point("O")
    origin.set_vel(ground, 0)
    point = origin.locatenew("P", x * ground.x)
    with pytest.raises(ed.EngdynError, match="frame B is not oriented"):
        ed.newton_euler([ed.FreeBody(Particle("p", point, m), [Force(point, k * loose.x)])], [x], ground, [])
    body = RigidBody("b", point, loose, m, (inertia(loose, 0, 0, J), point))
    with pytest.raises(ed.EngdynError, match="frame B is not oriented"):
        ed.newton_euler([ed.FreeBody(body)], [x], ground, [])


def test_a_point_without_velocity_and_a_force_at_a_point_without_place():
    lost = Point("P")
    with pytest.raises(ed.EngdynError, match=r"velocity of P in frame N is unknown.*set_vel"):
        ed.newton_euler([ed.FreeBody(Particle("p", lost, m))], [x], ground, [])
    origin = Point("O")
    origin.set_vel(ground, 0)
    center = origin.locatenew("C", x * ground.x)
    with pytest.raises(ed.EngdynError, match="point Q of a force on p is not placed"):
        ed.newton_euler(
            [ed.FreeBody(Particle("p", center, m), [Force(Point("Q"), k * ground.x)])], [x], ground, []
        )


def test_a_coordinate_without_inertia():
    origin = Point("O")
    origin.set_vel(ground, 0)
    center = origin.locatenew("C", x * ground.x)
    body = ed.FreeBody(Particle("p", center, m), [Force(center, -k * theta * ground.x)])
    with pytest.raises(ed.EngdynError, match=r"singular mass matrix|reaction is missing|too many"):
        ed.newton_euler([body], [x, theta], ground, [])


# Motion in space, against closed forms


def test_a_spinning_top_by_quasi_velocities_is_eulers_equation():
    """Body components of the angular velocity as speeds: A w1' = (B - C) w2 w3 and so on."""
    psi, nutation, phi = dynamicsymbols("psi theta phi")
    w = dynamicsymbols("w1:4")
    A, B, C = sm.symbols("A B C", positive=True)
    tau = dynamicsymbols("tau1:4")
    body = ReferenceFrame("B")
    body.orient_body_fixed(ground, (psi, nutation, phi), "ZXZ")
    spin = body.ang_vel_in(ground)
    rates = [q.diff(t) for q in (psi, nutation, phi)]
    solved = sm.solve([spin.dot(e) - u for e, u in zip(body, w, strict=True)], rates, dict=True)[0]
    center = Point("G")
    center.set_vel(ground, 0)
    torque = sum((T * e for T, e in zip(tau, body, strict=True)), 0 * body.x)
    free = ed.FreeBody(
        RigidBody("top", center, body, m, (inertia(body, A, B, C), center)), [Torque(body, torque)]
    )
    eom = ed.newton_euler(
        [free],
        [psi, nutation, phi],
        ground,
        [],
        speeds=w,
        kinematics={q: solved[q.diff(t)] for q in (psi, nutation, phi)},
    )
    euler = [
        tau[0] + (B - C) * w[1] * w[2],
        tau[1] + (C - A) * w[2] * w[0],
        tau[2] + (A - B) * w[0] * w[1],
    ]
    values = {"A": 2.0, "B": 3.0, "C": 4.5}
    source = np.random.default_rng(3)
    for _ in range(5):
        q, u, couples = source.uniform(0.3, 1.2, 3), source.uniform(-2, 2, 3), source.uniform(-1, 1, 3)
        known = dict(zip((*w, *tau), (*u, *couples), strict=True)) | {A: 2.0, B: 3.0, C: 4.5}
        expected = [float(e.subs(known)) / i for e, i in zip(euler, (2.0, 3.0, 4.5), strict=True)]
        inputs = {f"tau{i + 1}": value for i, value in enumerate(couples)}
        np.testing.assert_allclose(eom.accelerations(q, u, values, inputs), expected, rtol=1e-12)
        found = eom.function(values)(0.0, [*q, *u])[:3]
        omega = np.array(
            [
                [
                    float(
                        spin.dot(e)
                        .subs(dict(zip(rates, found, strict=True)))
                        .subs(dict(zip((psi, nutation, phi), q, strict=True)))
                    )
                    for e in body
                ]
            ]
        )
        np.testing.assert_allclose(omega[0], u, atol=1e-12)


def test_inertia_may_be_given_about_another_point_and_in_another_frame():
    rod, center = ReferenceFrame("A"), Point("O")
    rod.orient_axis(ground, theta, ground.z)
    center.set_vel(ground, 0)
    mass_center = center.locatenew("G", -l * rod.y)
    about_center = inertia(rod, 0, 0, J)
    about_pivot = about_center + inertia(rod, m * l**2, 0, m * l**2)
    bearing = [Force(center, N_x * ground.x + N_y * ground.y)]
    weight = [Force(mass_center, -m * g * ground.y)]
    turned = inertia(ground, 0, 0, J)
    found = [
        ed.newton_euler(
            [ed.FreeBody(RigidBody("rod", mass_center, rod, m, given), weight, bearing)],
            [theta],
            ground,
            [N_x, N_y],
        )
        for given in ((about_center, mass_center), (about_pivot, center), (turned, mass_center))
    ]
    by_hand = ed.EquationsOfMotion.from_residuals(
        [(J + m * l**2) * theta.diff(t, 2) + m * g * l * sm.sin(theta)], [theta]
    )
    assert all(ed.prove_equal(eom, by_hand) for eom in found)


def test_velocities_set_by_the_user_are_used():
    """A point that rides on a prescribed motion: its acceleration is an input."""
    yb = dynamicsymbols("yb")
    base = Point("B")
    base.set_vel(ground, yb.diff(t) * ground.y)
    mass = base.locatenew("P", x * ground.y)
    eom = ed.newton_euler(
        [ed.FreeBody(Particle("p", mass, m), [Force(mass, -k * x * ground.y)])], [x], ground, []
    )
    assert [w.func.__name__ for w in eom.inputs] == ["yb"]
    found = eom.accelerations([0.2], [0.0], {"m": 2.0, "k": 3.0}, {"yb": (9.0, 8.0, 7.0)})
    np.testing.assert_allclose(found, [-7.0 - 0.3])


def test_an_inertia_that_changes_with_time_contributes_its_rate():
    """J(t) theta'' + J'(t) theta' = 0: the skater who draws in the arms."""
    J_t, body, pivot = dynamicsymbols("J"), ReferenceFrame("A"), Point("O")
    body.orient_axis(ground, theta, ground.z)
    pivot.set_vel(ground, 0)
    free = ed.FreeBody(RigidBody("skater", pivot, body, m, (inertia(body, 0, 0, J_t), pivot)))
    eom = ed.newton_euler([free], [theta], ground, [])
    np.testing.assert_allclose(
        eom.accelerations([0.0], [3.0], {}, {"J": (2.0, -0.5, 0.0)}), [0.5 * 3.0 / 2.0]
    )


def test_forces_with_accelerations_become_inertia():
    """The water that a bob carries along: m + M swings, m weighs."""
    free = pendulum()
    rod = free.reactions[0].force.args[0][1]
    water = Force(free.center, -M * l * theta.diff(t, 2) * rod.x)
    heavier = ed.FreeBody(free.body, [*free.applied, water], free.reactions)
    eom = ed.newton_euler([heavier], [theta], ground, [S])
    values = {"m": 1.0, "M": 0.5, "l": 2.0, "g": 9.81}
    np.testing.assert_allclose(eom.accelerations([0.3], [0.0], values), [-9.81 * math.sin(0.3) / 3.0])
    energies = ed.lagrange(
        m * l**2 * theta.diff(t) ** 2 / 2,
        -m * g * l * sm.cos(theta),
        [theta],
        forces={theta: -M * l**2 * theta.diff(t, 2)},
    )
    assert ed.prove_equal(eom, energies)


# Reactions of the catalogue, put back into the balances by hand


def numbers(system, eom, state):
    """Reactions as floats at a state: name → (value, rate, acceleration)."""
    values = system.values()
    known = {p.symbol: values[p.name] for p in system.parameters}
    functions = [*eom.coordinates, *eom.inputs]
    found = {}
    for symbol, expression in eom.reactions.items():
        for order in (2, 1, 0):
            at = {
                (f.diff(t, order) if order else f): state.get(f.func.__name__, (0, 0, 0))[order]
                for f in functions
            }
            expression = expression.subs(at)
        found[symbol.name] = float(expression.subs(known))
    return found


def test_reactions_of_the_governor_satisfy_the_balances_of_ball_and_collar():
    system = ed.systems.load("S03")
    eom, v = system.newton(), system.values()
    th, u = 0.6, 1.7
    drive = (0.4, 17.0, 3.0)
    F_up = 5.0
    (acc,) = eom.accelerations([th], [u], v, {"drive": drive, "F": F_up})
    found = numbers(system, eom, {"theta": (th, u, acc), "drive": drive, "F": (F_up, 0, 0)})
    s, co, lv, mv = math.sin(th), math.cos(th), v["l"], v["m"]
    radius, depth = lv * s, lv * co
    radial = mv * (lv * (acc * co - u**2 * s) - radius * drive[1] ** 2)
    vertical = mv * lv * (acc * s + u**2 * co)  # of the ball, up: z = -l cos(theta)
    pin = -v["c_p"] * u / (2 * lv)
    T_1, T_2 = found["T_1"], found["T_2"]
    assert radial == pytest.approx(-T_1 * s - T_2 * s + pin * co, rel=1e-9)
    assert vertical == pytest.approx(T_1 * co - T_2 * co + pin * s - mv * v["g"], rel=1e-9)
    azimuthal = mv * (2 * lv * co * u * drive[1] + radius * drive[2])
    assert found["N_a"] == pytest.approx(azimuthal, rel=1e-9)
    lift_rate, lift_acc = 2 * lv * s * u, 2 * lv * (s * acc + co * u**2)
    collar = 2 * T_2 * co + F_up - v["M_c"] * v["g"] - v["k"] * 2 * (lv - depth) - v["c_c"] * lift_rate
    assert v["M_c"] * lift_acc == pytest.approx(collar, rel=1e-9)


def test_reactions_of_the_crane_are_those_of_its_two_bodies():
    system = ed.systems.load("S07")
    eom, v = system.newton(), system.values()
    q, u, loads = [1.0, 0.4], [0.6, -0.3], {"F": 900.0, "W": -250.0}
    x_acc, acc = eom.accelerations(q, u, v, loads)
    state = {"x": (q[0], u[0], x_acc), "theta": (q[1], u[1], acc)}
    found = numbers(system, eom, state | {name: (value, 0, 0) for name, value in loads.items()})
    up = v["L"] * (math.sin(q[1]) * acc + math.cos(q[1]) * u[1] ** 2)
    along = x_acc + v["L"] * (math.cos(q[1]) * acc - math.sin(q[1]) * u[1] ** 2)
    assert found["N_r"] == pytest.approx((v["M_t"] + v["m"]) * v["g"] + v["m"] * up, rel=1e-10)
    assert found["H_y"] == pytest.approx(v["m"] * (v["g"] + up), rel=1e-10)
    assert found["H_x"] == pytest.approx(v["m"] * along - loads["W"], rel=1e-9)
    assert found["H_x"] == pytest.approx(loads["F"] - v["c_x"] * u[0] - v["M_t"] * x_acc, rel=1e-9)


def test_after_lagrange_there_are_no_reactions():
    assert ed.systems.load("S07").lagrange().reactions == {}
    assert ed.systems.load("S23").newton().reactions == {}


def test_a_reaction_is_found_where_no_axis_of_the_balances_has_its_direction():
    """A bead on a parabola: along x alone, its wire's force would read 0/0 at the lowest point."""
    x, (m, p, g, force) = dynamicsymbols("x"), sm.symbols("m p g N_w", positive=True)
    ground, origin = ReferenceFrame("N"), Point("O")
    origin.set_vel(ground, 0)
    place = origin.locatenew("P", x * ground.x + p * x**2 * ground.y)
    slope = sm.sqrt(1 + 4 * p**2 * x**2)
    normal = (-2 * p * x * ground.x + ground.y) / slope
    cut = ed.FreeBody(
        Particle("bead", place, m), [Force(place, -m * g * ground.y)], [Force(place, force * normal)]
    )
    found = ed.newton_euler([cut], [x], ground, [force]).reactions[force]
    numbers = {x.diff(dynamicsymbols._t, 2): 0.3, x.diff(): 0.7, x: 0, m: 2.0, p: 0.8, g: 9.81}
    assert float(found.subs(numbers)) == pytest.approx(2.0 * (9.81 + 2 * 0.8 * 0.7**2))
