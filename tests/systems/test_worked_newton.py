"""The worked systems of chapter 2: W3 roll on a wedge, W4 thrown ball, W5 top, W6 bicycle wheel."""

from __future__ import annotations

import math

import numpy as np
import pytest
import sympy as sm
from scipy.integrate import solve_ivp
from sympy.physics.mechanics import Force, KanesMethod, RigidBody, Torque, dynamicsymbols, inertia

import engdyn as ed
from engdyn import shapes as sh

t = dynamicsymbols._t
KEYS = ["W3", "W4", "W5", "W6"]
#: A pose in which nothing is special, per system.
POSES = {"W3": [0.2, 0.5], "W4": [1.0, 0.3, 2.0, 0.7, 0.6, -0.4], "W5": [0.7, 0.6, -0.4], "W6": [0.4]}


@pytest.mark.parametrize("key", KEYS)
def test_both_derivations_are_proved_equal(key):
    proof = ed.systems.load(key).prove()
    assert proof.verdict == "proved"
    assert not proof.differences


def newton_with(system, bodies):
    return ed.newton_euler(bodies, [c.symbol for c in system.coordinates], system.frame, system.unknowns)


def load_mutations():
    for key in KEYS:
        for b, body in enumerate(ed.systems.load(key).free_bodies()):
            for i in range(len(body.applied)):
                yield pytest.param(key, b, i, id=f"{key}-{body.name}-load{i}")


@pytest.mark.parametrize(("key", "b", "i"), list(load_mutations()))
def test_every_other_load_is_refuted(key, b, i):
    system = ed.systems.load(key)
    bodies = system.free_bodies()
    loads = list(bodies[b].applied)
    load = loads[i]
    loads[i] = (
        Force(load.point, 2 * load.force) if isinstance(load, Force) else Torque(load.frame, 2 * load.torque)
    )
    bodies[b] = ed.FreeBody(bodies[b].body, loads, bodies[b].reactions)
    carried = {("W3", "cart", 0), ("W6", "wheel", 0)}  # weights that the floor and the fork carry
    proof = ed.prove_equal(newton_with(system, bodies), system.lagrange())
    assert proof.verdict == ("proved" if (key, bodies[b].name, i) in carried else "refuted")


@pytest.mark.parametrize("key", KEYS)
def test_every_other_inertia_is_refuted(key):
    system = ed.systems.load(key)
    for b, old in enumerate(body.body for body in system.free_bodies()):
        if isinstance(old, RigidBody):
            bodies = system.free_bodies()
            point, tensor = bodies[b].body.masscenter, bodies[b].body.central_inertia
            more = tensor + inertia(
                old.frame, 0, 0, sm.Symbol("J")
            )  # twice the tensor turns freely just as well
            new = RigidBody(old.name, point, old.frame, old.mass, (more, point))
            bodies[b] = ed.FreeBody(new, bodies[b].applied, bodies[b].reactions)
            assert ed.prove_equal(newton_with(system, bodies), system.lagrange()).verdict == "refuted"


@pytest.mark.parametrize("key", KEYS)
@pytest.mark.filterwarnings("ignore:.*Velocity of:UserWarning")
def test_kanes_method_agrees(key):
    system = ed.systems.load(key)
    bodies, q = system.free_bodies(), [c.symbol for c in system.coordinates]
    speeds = dynamicsymbols([f"u_{c.name}" for c in system.coordinates])
    method = KanesMethod(
        system.frame, q, speeds, kd_eqs=[u - x.diff(t) for x, u in zip(q, speeds, strict=True)]
    )
    method.kanes_equations([b.body for b in bodies], [load for b in bodies for load in b.applied])
    eom = system.newton()
    inputs = [w.diff(t, k) if k else w for w in eom.inputs for k in (2, 1, 0)]
    plain = {f: sm.Dummy() for f in inputs}
    rates = {x.diff(t): u for x, u in zip(q, speeds, strict=True)}
    matrices = [e.xreplace(rates).xreplace(plain) for e in (method.mass_matrix, method.forcing)]
    function = sm.lambdify([*q, *speeds, *plain.values(), *eom.parameters], matrices, cse=True)
    source = np.random.default_rng(7)
    for _ in range(10):
        state, u = source.uniform(0.3, 1.2, len(q)), source.uniform(-2, 2, len(q))
        values = {p.name: source.uniform(0.4, 0.9) for p in eom.parameters}
        given = {w.func.__name__: source.uniform(-1, 1, 3) for w in eom.inputs}
        numbers = [given[w.func.__name__][k] for w in eom.inputs for k in (2, 1, 0)]
        mass, force = function(*state, *u, *numbers, *(values[p.name] for p in eom.parameters))
        expected = np.linalg.solve(mass, force.ravel())
        np.testing.assert_allclose(
            eom.accelerations(state, u, values, given), expected, rtol=1e-12, atol=1e-11
        )


@pytest.mark.parametrize("key", KEYS)
def test_a_drawing_names_what_the_model_holds(key):
    system = ed.systems.load(key)
    drawn = system.shapes(POSES[key], system.values())
    labels = [str(getattr(s, "label", "") or getattr(s, "text", "")) for s in drawn]
    words = " ".join(labels).replace("$", " ").replace(",", " ").replace("\\", " ").replace("/", " ").split()
    shown = {p.name for p in system.parameters} - {"p", "n"}  # rates that are looked for, no parts
    assert shown <= set(words)
    coordinates = [
        s for s in drawn if isinstance(s, sh.CoordinateArrow | sh.AngleArrow) and s.role == "coordinate"
    ]
    assert {s.label.strip("$\\") for s in coordinates} == {c.name for c in system.coordinates}
    forces = {s.label.strip("$") for s in drawn if isinstance(s, sh.ForceArrow | sh.MomentArrow)}
    assert {i.name for i in system.inputs if i.kind != "drive angle"} <= forces
    assert any(isinstance(s, sh.GravityArrow) for s in drawn)


# W3: needed friction is tested with pitfall 6


def test_the_roll_touches_the_plane_and_turns_as_it_rolls():
    system = ed.systems.load("W3")
    values = system.values()

    def parts(x, s):
        drawn = system.shapes([x, s], values)
        roll = next(d for d in drawn if isinstance(d, sh.Disc) and d.radius == values["R"])
        return roll, next(d for d in drawn if isinstance(d, sh.Polygon))

    for x, s in ((0.0, 0.0), (0.4, 0.7)):
        roll, wedge = parts(x, s)
        toe, top = np.array(wedge.points[2]), np.array(wedge.points[3])
        along = (toe - top) / np.linalg.norm(toe - top)
        away = np.array(roll.center) - top
        assert abs(along[0] * away[1] - along[1] * away[0]) == pytest.approx(values["R"], rel=1e-12)
        assert math.atan2(-along[1], along[0]) == pytest.approx(values["beta"])
        assert wedge.points[0][0] == pytest.approx(x)
    first, second = parts(0.0, 0.1)[0], parts(0.0, 0.6)[0]
    assert math.dist(first.center, second.center) == pytest.approx(0.5)
    assert first.angle - second.angle == pytest.approx(0.5 / values["R"])  # clockwise


# W4


def test_the_ball_flies_as_a_particle_and_keeps_h_and_its_energy():
    ball = ed.systems.load("W4")
    values, eom = ball.values(), ball.newton()
    times = np.linspace(0.0, 1.5, 40)
    start = [0.0, 0.0, 1.8, 0.0, 0.3, 0.0, 18.0, 1.0, 7.0, 20.0, 0.8, 2 * math.pi * 8]
    y = solve_ivp(eom.function(values), (0, 1.5), start, t_eval=times, rtol=1e-11, atol=1e-12).y
    np.testing.assert_allclose(y[2], 1.8 + 7.0 * times - 9.81 * times**2 / 2, atol=1e-8)
    np.testing.assert_allclose(y[:2], np.outer([18.0, 1.0], times), atol=1e-8)
    symbols = [c.symbol for c in ball.coordinates]
    (body,) = ball.free_bodies()
    H = ed.angular_momentum(body, body.center, ball.frame, axes=ball.frame).to_matrix(ball.frame)
    energy = ball.kinetic_energy + ball.potential_energy
    rates = {c.diff(t): sm.Dummy() for c in symbols}
    expressions = [e.xreplace(rates) for e in (*H, energy)]
    known = {p.symbol: values[p.name] for p in ball.parameters}
    function = sm.lambdify([*symbols, *rates.values()], [e.xreplace(known) for e in expressions])
    history = np.array(function(*y))
    assert np.ptp(y[4]) > 0.01  # it wobbles about another axis than X
    np.testing.assert_allclose(history, history[:, :1] @ np.ones((1, len(times))), rtol=1e-7, atol=1e-9)


def test_the_ball_is_the_ellipsoid_with_its_moments():
    from engdyn.systems.w04_thrown_ball import half_sizes

    values = ed.systems.load("W4").values()
    length, radius = half_sizes(values)
    tensor = ed.solids.ellipsoid(values["m"], length, radius, radius)
    np.testing.assert_allclose(tensor, np.diag([values["C"], values["A"], values["A"]]), rtol=1e-12)


# W5


def test_the_steady_precession_of_the_top_is_that_of_the_closed_form():
    top = ed.systems.load("W5")
    values = top.values()
    found = top.equilibria()
    assert found.certified
    (state,) = found
    weight, tilt = values["m"] * values["g"] * values["l"], state.q[1]
    rates = ed.steady_precession(values["A"], values["C"], values["n"], tilt, weight, relative=True).rates
    assert min(abs(r / values["p"] - 1) for r in rates) < 1e-9
    cosine = (values["C"] * values["p"] * values["n"] - weight) / (
        (values["A"] - values["C"]) * values["p"] ** 2
    )
    assert math.cos(tilt) == pytest.approx(cosine, rel=1e-9)
    assert len(top.equilibria({"p": 3.0})) == 0  # too slow for the weight at any angle


def test_the_top_precesses_where_its_moment_turns_h_to():
    """M = Ω × H: released from a slow precession the vertical reaction is the weight, the rest centripetal."""
    top = ed.systems.load("W5")
    values, eom = top.values(), top.newton()
    weight = values["m"] * values["g"] * values["l"]
    found = ed.steady_precession(values["A"], values["C"], 250.0, 1.0, weight)
    symbols = [c.symbol for c in top.coordinates]
    at = dict.fromkeys((c.diff(t, 2) for c in symbols), 0.0)
    rates = [found.slow, 0.0, 250.0 - found.slow * math.cos(1.0)]
    at |= {c.diff(t): u for c, u in zip(symbols, rates, strict=True)}
    at |= dict(zip(symbols, [0.0, 1.0, 0.0], strict=True)) | {
        p.symbol: values[p.name] for p in top.parameters
    }
    force = [float(eom.reactions[x].xreplace(at)) for x in top.unknowns]
    centripetal = values["m"] * values["l"] * math.sin(1.0) * found.slow**2
    # At phi = 0 the axis leans to -Y, the mass center goes around at l sin(theta).
    np.testing.assert_allclose(force, [0, centripetal, values["m"] * values["g"]], atol=1e-12)
    (body,) = top.free_bodies()
    balance = ed.moment_balance(body, next(iter(body.reactions)).point, top.frame, axes=top.frame)
    assert balance.kind == "fixed point"
    moment = [float(e.xreplace(at)) for e in balance.moments.to_matrix(top.frame)]
    H = [float(e.xreplace(at)) for e in balance.angular_momentum.to_matrix(top.frame)]
    np.testing.assert_allclose(moment, np.cross([0, 0, found.slow], H), atol=1e-12)


# W6


def at_rest(system, **inputs):
    """Steering acceleration, upright and straight ahead, with given inputs."""
    given = {"lean": (0, 0, 0), "yaw": (0, 0, 0), **inputs}
    return system.newton().accelerations([0.0], [0.0], system.values(), given)[0]


def test_a_wheel_that_leans_to_the_right_steers_to_the_right():
    wheel = ed.systems.load("W6")
    values = wheel.values()
    couple = values["C"] * values["v"] / values["R"] * 0.5
    assert at_rest(wheel, lean=(0, 0.5, 0)) == pytest.approx(-couple / values["A"], rel=1e-12)
    assert at_rest(wheel, lean=(0, 0.5, 0), T=couple) == pytest.approx(0, abs=1e-12)
    assert at_rest(wheel, lean=(0, 0.5, 0), spin=(0, 0, 0)) == 0  # a wheel that stands has no H


def test_in_a_right_turn_the_wheel_pushes_the_bicycle_outward():
    """Ω × H by hand: Ω = −r Z, H = C v/R Y, so a couple + C v/R r about X must act on the wheel."""
    wheel = ed.systems.load("W6")
    values, eom = wheel.values(), wheel.newton()
    inputs = {"lean": (0.0, 0.0, 0.0), "yaw": (0.0, -0.6, 0.0), "spin": (0.0, values["v"] / values["R"], 0.0)}
    at = {i.symbol.diff(t, k): inputs[i.name][k] for i in wheel.inputs if i.name in inputs for k in (2, 1)}
    at |= {i.symbol: 0.0 for i in wheel.inputs} | {p.symbol: values[p.name] for p in wheel.parameters}
    delta = wheel.coordinates[0].symbol
    at |= {delta.diff(t, 2): 0.0, delta.diff(t): 0.0, delta: 0.0}
    found = {x.name: float(e.xreplace(at)) for x, e in eom.reactions.items()}
    assert found["L"] == pytest.approx(values["C"] * values["v"] / values["R"] * 0.6, rel=1e-12)
    assert found["D"] == pytest.approx(0, abs=1e-15)
    assert found["H_z"] == pytest.approx(values["m"] * values["g"])
    H = np.array([0, values["C"] * values["v"] / values["R"], 0])
    np.testing.assert_allclose(np.cross([0, 0, -0.6], H), [found["L"], 0, 0], rtol=1e-12)
