"""Euler's equations in body axes and in axes that do not spin; free and steady precession of gyroscopes."""

from __future__ import annotations

import math

import numpy as np
import pytest
import sympy as sm
from scipy.integrate import solve_ivp
from sympy.physics.mechanics import (
    KanesMethod,
    Point,
    ReferenceFrame,
    RigidBody,
    Torque,
    dynamicsymbols,
    inertia,
)

import engdyn as ed

t = dynamicsymbols._t
A, B, C = sm.symbols("A B C", positive=True)
m, l, g = sm.symbols("m l g", positive=True)
w = dynamicsymbols("w1 w2 w3")
phi, theta, psi = ANGLES = dynamicsymbols("phi theta psi")
N, D, R = ReferenceFrame("N"), ReferenceFrame("D"), ReferenceFrame("R")
D.orient_body_fixed(N, (phi, theta, 0), "ZXZ")  # precesses and nutates
R.orient_axis(D, psi, D.z)  # spins as well
WEIGHT = m * g * l * sm.sin(theta) * D.x
BOX = {"A": 1.0, "B": 2.0, "C": 2.5}


def body_with(dyadic, frame=R):
    """A body of unit mass whose mass center stays in place."""
    point = Point("G")
    point.set_vel(N, 0)
    return RigidBody("body", point, frame, 1, (dyadic, point))


def assert_kane_agrees(ours, dyadic, axes, couple, values):
    """Accelerations and rates of the angles by sympy's KanesMethod, at random states."""
    spin = [R.ang_vel_in(N).dot(e) for e in axes]
    method = KanesMethod(N, list(ANGLES), list(w), kd_eqs=[s - x for s, x in zip(w, spin, strict=True)])
    method.kanes_equations([body_with(dyadic)], [(R, couple)])
    symbols = [s for s in (A, B, C, m, l, g) if s.name in values]
    rates = [method.kindiffdict()[angle.diff(t)] for angle in ANGLES]
    matrices = sm.lambdify([*ANGLES, *w, *symbols], [method.mass_matrix, method.forcing, rates], cse=True)
    source = np.random.default_rng(11)
    for _ in range(10):
        q, u = source.uniform(0.3, 1.2, 3), source.uniform(-2, 2, 3)
        mass, force, expected = matrices(*q, *u, *(values[s.name] for s in symbols))
        found = ours.accelerations(q, u, values)
        np.testing.assert_allclose(found, np.linalg.solve(mass, force.ravel()), rtol=1e-12, atol=1e-12)
        np.testing.assert_allclose(ours.function(values)(0.0, [*q, *u])[:3], expected, rtol=1e-12, atol=1e-12)


def run(eom, values, start, times):
    found = solve_ivp(
        eom.function(values),
        (times[0], times[-1]),
        start,
        t_eval=times,
        rtol=1e-11,
        atol=1e-13,
        method="DOP853",
    )
    return found.y


# Body axes


def test_eulers_equations_in_principal_axes():
    box = ed.euler_equations([A, B, C], w)
    expected = [
        A * w[0].diff(t) - (B - C) * w[1] * w[2],
        B * w[1].diff(t) - (C - A) * w[2] * w[0],
        C * w[2].diff(t) - (A - B) * w[0] * w[1],
    ]
    terms = zip(box.component_derivative, box.turning, expected, strict=True)
    assert all(sm.expand(change + turn - wanted) == 0 for change, turn, wanted in terms)
    assert box.angular_momentum == (A * w[0], B * w[1], C * w[2])
    assert box.moment == (0, 0, 0)
    assert (box.coordinates, box.speeds) == ((), tuple(w))
    assert repr(box) == "EulerEquations(no coordinates; speeds w1, w2, w3)"
    assert r"A \dot{w}_{1} + \left(- B + C\right) w_{2} w_{3} &= 0" in box._repr_latex_()


def test_a_torque_free_box_keeps_energy_and_momentum():
    box = ed.euler_equations([A, B, C], w)
    moments = np.array(list(BOX.values()))
    y = run(box, BOX, [0.3, 2.0, -1.1], np.linspace(0, 20, 200))
    energy, momentum = (moments @ y**2) / 2, np.linalg.norm(moments[:, None] * y, axis=0)
    assert np.ptp(y[0]) > 1
    np.testing.assert_allclose(energy, energy[0], rtol=1e-8)
    np.testing.assert_allclose(momentum, momentum[0], rtol=1e-8)


@pytest.mark.parametrize("axis", [0, 1, 2])
def test_only_the_turn_about_the_intermediate_axis_is_unstable(axis):
    box, rate, h = ed.euler_equations([A, B, C], w), 3.0, 1e-6
    start = rate * np.eye(3)[axis]
    f = box.function(BOX)
    slopes = np.column_stack([(f(0, start + h * e) - f(0, start - h * e)) / (2 * h) for e in np.eye(3)])
    own, others = BOX["ABC"[axis]], [BOX[k] for k in "ABC" if k != "ABC"[axis]]
    square = -(own - others[0]) * (own - others[1]) / (others[0] * others[1]) * rate**2
    expected = sorted([0, np.emath.sqrt(square), -np.emath.sqrt(square)], key=lambda x: (x.real, x.imag))
    found = sorted(np.linalg.eigvals(slopes), key=lambda x: (round(x.real, 6), x.imag))
    np.testing.assert_allclose(found, expected, atol=1e-6)
    assert (max(np.real(found)) > 0.1) == (axis == 1)


def test_kanes_method_agrees_in_principal_axes():
    couple = [sm.sin(theta), w[0] * sm.cos(psi), sm.Integer(2)]
    ours = ed.euler_equations([A, B, C], w, couple, coordinates=ANGLES, frame=N, axes=R)
    vector = sum((c * e for c, e in zip(couple, R, strict=True)), 0 * N.x)
    assert_kane_agrees(ours, inertia(R, A, B, C), R, vector, BOX)


def test_kanes_method_agrees_with_products_of_inertia():
    tensor = np.array([[2.0, -0.3, 0.2], [-0.3, 2.4, 0.1], [0.2, 0.1, 1.8]])
    ours = ed.euler_equations(tensor, w, coordinates=ANGLES, frame=N, axes=R)
    assert_kane_agrees(ours, inertia(R, 2.0, 2.4, 1.8, -0.3, 0.1, 0.2), R, 0 * N.x, {})


def test_the_same_equations_as_newton_euler_with_its_forces():
    kinematics = dict(
        zip(
            ANGLES,
            ed.euler_equations([A, B, C], w, coordinates=ANGLES, frame=N, axes=R).kinematics,
            strict=True,
        )
    )
    body = body_with(inertia(R, A, B, C))
    newton = ed.newton_euler(
        [ed.FreeBody(body, [Torque(R, WEIGHT)])], ANGLES, N, [], speeds=w, kinematics=kinematics
    )
    ours = ed.euler_equations([A, B, C], w, WEIGHT, coordinates=ANGLES, frame=N, axes=R)
    assert ed.prove_equal(ours, newton)


# Axes that do not spin


def test_a_symmetric_body_wobbles_at_the_closed_form_rate():
    values, spin = {"A": 0.0032, "C": 0.0020}, 50.0
    ball = ed.euler_equations([A, A, C], w)
    times = np.linspace(0, 1, 400)
    y = run(ball, values, [3.0, 0.0, spin], times)
    wobble = ed.free_precession(0.0032, 0.0020, spin).wobble
    np.testing.assert_allclose(y[2], spin, rtol=1e-12)
    np.testing.assert_allclose(y[0], 3.0 * np.cos(wobble * times), atol=1e-7)
    np.testing.assert_allclose(y[1], 3.0 * np.sin(wobble * times), atol=1e-7)


def test_turning_takes_the_rate_of_the_axes_and_momentum_that_of_the_body():
    rate = sm.Symbol("Omega_3")
    disc = ed.euler_equations([A, A, C], w, axes_rate=[w[0], w[1], rate])
    H = (A * w[0], A * w[1], C * w[2])
    assert disc.angular_momentum == H
    cross = sm.Matrix([w[0], w[1], rate]).cross(sm.Matrix(H))
    assert all(sm.expand(a - b) == 0 for a, b in zip(disc.turning, cross, strict=True))
    assert ed.prove_equal(disc, ed.euler_equations([A, A, C], w)).verdict == "refuted"


def test_speeds_in_axes_that_do_not_spin_by_frames_and_by_hand():
    by_frames = ed.euler_equations([A, A, C], w, WEIGHT, coordinates=ANGLES, frame=N, axes=D, body=R)
    rate = w[1] * sm.cos(theta) / sm.sin(theta)
    by_hand = ed.euler_equations(
        [A, A, C],
        w,
        [m * g * l * sm.sin(theta), 0, 0],
        coordinates=ANGLES,
        kinematics={phi: w[1] / sm.sin(theta), theta: w[0], psi: w[2] - rate},
        axes_rate=[w[0], w[1], rate],
    )
    assert ed.prove_equal(by_frames, by_hand)
    values = {"A": 0.9, "C": 0.4, "m": 1.1, "l": 0.5, "g": 9.81}
    assert_kane_agrees(by_frames, inertia(D, A, A, C), D, WEIGHT, values)


# S15, a rotor at constant spin on a gimbal: one equation of motion, whatever the axes (pitfall 2)

alpha, beta = dynamicsymbols("alpha beta")
Omega, lam = sm.symbols("Omega lam")
ring, shaft, rotor = ReferenceFrame("M"), ReferenceFrame("S"), ReferenceFrame("W")
ring.orient_axis(N, alpha, N.x)
shaft.orient_axis(ring, beta, ring.y)
rotor.orient_axis(shaft, Omega * t, shaft.z)
#: Weight about O (G lies on the shaft at l), and the couple that the gimbal transmits across its two axes.
LOADS = l * shaft.z.cross(-m * g * N.z) + lam * ring.z


def gimballed(axes, unknowns=(lam,)):
    return ed.euler_equations(
        [A, A, C], None, LOADS, coordinates=[alpha, beta], frame=N, axes=axes, body=rotor, unknowns=unknowns
    )


def lagrange_of_gimbal():
    a_d, b_d = alpha.diff(t), beta.diff(t)
    kinetic = A * ((a_d * sm.cos(beta)) ** 2 + b_d**2) / 2 + C * (Omega + a_d * sm.sin(beta)) ** 2 / 2
    return ed.lagrange(kinetic, m * g * l * sm.cos(alpha) * sm.cos(beta), [alpha, beta])


def test_a_rotor_in_its_own_axes_and_in_axes_that_do_not_spin():
    in_shaft, in_rotor = gimballed(shaft), gimballed(rotor)
    assert ed.prove_equal(in_shaft, in_rotor)
    assert ed.prove_equal(in_shaft, lagrange_of_gimbal())
    body = ed.FreeBody(body_with(inertia(shaft, A, A, C), rotor), [], [Torque(rotor, LOADS)])
    newton = ed.newton_euler([body], [alpha, beta], N, [lam])
    assert ed.prove_equal(newton, in_shaft)
    values = {"A": 1.1, "C": 1.7, "Omega": 20.0, "m": 2.0, "l": 0.3, "g": 9.81}
    udot = newton.accelerations([0.3, 0.5], [0.7, -0.4], values, t=0.2)
    at = dict(zip((alpha.diff(t, 2), beta.diff(t, 2)), udot, strict=True))
    at |= {alpha.diff(t): 0.7, beta.diff(t): -0.4, alpha: 0.3, beta: 0.5, t: 0.2}
    at |= {s: values[s.name] for s in (A, C, Omega, m, l, g)}
    couples = [float(eom.reactions[lam].xreplace(at)) for eom in (newton, in_shaft, in_rotor)]
    np.testing.assert_allclose(couples[1:], couples[0], rtol=1e-12)


def test_the_spin_of_the_rotor_taken_for_that_of_the_axes_is_refuted():
    eom = gimballed(shaft)
    H, moments = sm.Matrix(eom.angular_momentum), sm.Matrix([LOADS.dot(e) for e in shaft])
    axes_rate = sm.Matrix([alpha.diff(t) * sm.cos(beta), beta.diff(t), alpha.diff(t) * sm.sin(beta)])

    def equations(rate):
        rows = H.diff(t) + rate.cross(H) - moments
        about_x, about_y = rows[0] * sm.cos(beta) + rows[2] * sm.sin(beta), rows[1]
        return ed.EquationsOfMotion.from_residuals([sm.expand(about_x), about_y], [alpha, beta])

    assert ed.prove_equal(equations(axes_rate), eom)
    wrong = equations(axes_rate + sm.Matrix([0, 0, Omega]))
    assert ed.prove_equal(wrong, eom).verdict == "refuted"


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (
            lambda: ed.euler_equations([A, B, C], w, coordinates=ANGLES, frame=N, axes=D, body=R),
            "the body turns in these axes and its tensor changes",
        ),
        (lambda: ed.euler_equations([A, A, C], w, axes_rate=[0, 0, 0]), "the body turns in these axes"),
        (lambda: ed.euler_equations([1.0, 2.0, 3.5], w), "no body has the principal moments"),
        (lambda: ed.euler_equations([1.0, 2.0], w), "three principal moments"),
        (lambda: ed.euler_equations([A, B, "C"], w), "not text"),
        (lambda: ed.euler_equations([A, B, C], w[:2]), "three dynamicsymbols"),
        (lambda: ed.euler_equations([A, B, C], sm.symbols("a b c")), "three dynamicsymbols"),
        (lambda: ed.euler_equations([A, B, C]), "speeds are missing"),
        (lambda: ed.euler_equations([A, B, C], w, [1, 2]), "moment is .*three components"),
        (lambda: ed.euler_equations([A, B, C], w, 3 * N.x), "moment is .*three components"),
        (lambda: ed.euler_equations([A, B, C], w, frame=N), "frame and axes together"),
        (lambda: ed.euler_equations([A, B, C], w, body=R), "frame and axes together"),
        (lambda: ed.euler_equations([A, B, C], w, coordinates=ANGLES), "kinematics describes"),
        (
            lambda: ed.euler_equations([A, B, C], w, coordinates=ANGLES, frame=N, axes=R, axes_rate=w),
            "either frames or these",
        ),
        (
            lambda: ed.euler_equations([A, B, C], w, coordinates=ANGLES[:2], frame=N, axes=R),
            "2 coordinates for three speeds",
        ),
        (
            lambda: ed.euler_equations([A, B, C], w, coordinates=[*ANGLES[:2], alpha], frame=N, axes=R),
            "does not tell the rates",
        ),
        (
            lambda: gimballed(shaft, unknowns=()),
            "3 equations for 2 accelerations and 0 reactions",
        ),
        (lambda: ed.euler_equations([A, B, C], w, frame="N", axes=R, coordinates=ANGLES), "ReferenceFrames"),
    ],
)
def test_what_does_not_tell_the_motion_is_refused(make, message):
    with pytest.raises(ed.EngdynError, match=message):
        make()


# Closed forms of steady motions, put into the equations of motion


def rates_of(system, q, u, values):
    eom = system.newton()
    return eom.accelerations(q, u, {p.name: values[p.name] for p in eom.parameters})


@pytest.mark.parametrize("tilt", [0.2, 0.9, math.pi / 2, 2.3])
@pytest.mark.parametrize("spin", [400.0, -250.0])
@pytest.mark.parametrize("relative", [False, True])
def test_steady_precession_needs_no_acceleration(tilt, spin, relative):
    top = ed.systems.load("W5")
    values = top.values()
    weight = values["m"] * values["g"] * values["l"]
    found = ed.steady_precession(values["A"], values["C"], spin, tilt, weight, relative=relative)
    assert len(found.rates) == (1 if tilt == math.pi / 2 else 2)
    assert [abs(r) for r in found.rates] == sorted(abs(r) for r in found.rates)
    assert found.slow == found.rates[0]
    for rate in found.rates:
        own = spin if relative else spin - rate * math.cos(tilt)
        udot = rates_of(top, [0.3, tilt, 0.8], [rate, 0.0, own], values)
        assert np.max(np.abs(udot)) < 1e-12 * rate**2 + 1e-12 * abs(rate * spin) + 1e-12
    near = weight / (values["C"] * spin)
    assert found.slow == pytest.approx(near, rel=0.2)
    if len(found.rates) == 2 and not relative:
        free = ed.free_precession(values["A"], values["C"], abs(spin), min(tilt, math.pi - tilt)).precession
        assert abs(found.fast) == pytest.approx(free, rel=0.2)
    if tilt == math.pi / 2:
        assert found.slow == pytest.approx(near, rel=1e-14)
        with pytest.raises(ed.EngdynError, match="no fast precession"):
            _ = found.fast


@pytest.mark.parametrize("relative", [False, True])
def test_below_the_limiting_spin_the_top_cannot_precess_steadily(relative):
    values = ed.systems.load("W5").values()
    inertia_, weight = (values["A"], values["C"]), values["m"] * values["g"] * values["l"]
    limit = ed.steady_precession(*inertia_, 1.0, 0.4, weight, relative=relative).limiting_spin
    square = (values["A"] - values["C"] * relative) * math.cos(0.4)
    assert limit == pytest.approx(2 * math.sqrt(square * weight) / values["C"], rel=1e-14)
    below, at, above = (
        ed.steady_precession(*inertia_, factor * limit, 0.4, weight, relative=relative)
        for factor in (1 - 1e-6, 1.0, 1 + 1e-6)
    )
    assert below.rates == ()
    assert f"none at spin {0.999999 * limit:.5g}" in repr(below)
    assert f"the limiting spin is {limit:.5g} rad/s" in repr(below)
    with pytest.raises(ed.EngdynError, match="no steady precession"):
        _ = below.slow
    assert at.slow == pytest.approx(at.fast, rel=1e-6)
    assert above.slow < at.slow < above.fast
    # The equation of motion itself: below the limit the top tips at every rate of precession.
    top = ed.systems.load("W5")
    rates = np.linspace(-400, 400, 4001)
    for found, crosses in ((below, False), (above, True)):
        tried = np.concatenate([rates, np.linspace(0.99 * at.slow, 1.01 * at.slow, 4001)])
        own = found.spin - (0 if relative else 1) * tried * math.cos(0.4)
        u = np.column_stack([tried, 0 * tried, own])
        tipping = rates_of(top, np.tile([0.0, 0.4, 0.0], (len(tried), 1)), u, values)[:, 1]
        assert (np.min(tipping) < 0) == crosses


def test_a_hanging_top_precesses_at_every_spin_and_without_weight_it_is_free():
    hanging = ed.steady_precession(4e-4, 1e-4, 0.0, 2.5, 0.07)
    assert hanging.limiting_spin == 0
    assert hanging.slow == pytest.approx(-hanging.fast)
    assert hanging.fast**2 == pytest.approx(-0.07 / (4e-4 * math.cos(2.5)))  # a conical pendulum
    free = ed.steady_precession(4e-4, 1e-4, 90.0, 0.3, 0.0)
    assert free.rates == pytest.approx((0.0, ed.free_precession(4e-4, 1e-4, 90.0, 0.3).precession))
    assert ed.steady_precession(4e-4, 1e-4, 0.0, math.pi / 2, 0.07).rates == ()
    assert ed.steady_precession(4e-4, 4e-4, 90.0, 0.3, 0.07, relative=True).rates == pytest.approx(
        (0.07 / (4e-4 * 90.0),)
    )


@pytest.mark.parametrize(("transverse", "axial"), [(0.0032, 0.0020), (0.0020, 0.0032)])
def test_free_precession_keeps_the_axis_at_its_angle_about_h(transverse, axial):
    ball = ed.systems.load("W4")
    values, tilt, spin = ball.values(A=transverse, C=axial), 0.35, 2 * math.pi * 8
    found = ed.free_precession(transverse, axial, spin, tilt)
    u = [20.0, 0.0, 5.0, found.precession, 0.0, found.relative_spin]
    udot = rates_of(ball, [0, 0, 0, 0.4, tilt, 1.0], u, values)
    np.testing.assert_allclose(udot, [0, 0, -9.81, 0, 0, 0], atol=1e-11)
    assert found.relative_spin + found.precession * math.cos(tilt) == pytest.approx(spin, rel=1e-14)
    assert found.wobble == -found.relative_spin
    assert (found.wobble > 0) == (axial > transverse)
    # H has its magnitude along the axis about which the precession goes, and nothing across it.
    (body,) = ball.free_bodies()
    H = ed.angular_momentum(body, body.center, ball.frame, axes=ball.frame)
    symbols = [c.symbol for c in ball.coordinates]
    at = {c.diff(t): v for c, v in zip(symbols, u, strict=True)}
    at |= dict(zip(symbols, [0, 0, 0, 0.4, tilt, 1.0], strict=True))
    at |= {p.symbol: values[p.name] for p in ball.parameters}
    along = [float(e.subs(at)) for e in H.to_matrix(ball.frame)]
    np.testing.assert_allclose(along, [found.angular_momentum, 0, 0], atol=1e-14)


def test_free_precession_in_symbols():
    spin, tilt = sm.symbols("omega_3 vartheta", positive=True)
    found = ed.free_precession(A, C, spin, tilt)
    assert found.precession == C * spin / (A * sm.cos(tilt))
    assert sm.expand(found.wobble - (C / A - 1) * spin) == 0
    assert "precession=C*omega_3/(A*cos(vartheta))" in repr(found)
    assert (
        repr(ed.free_precession(2.0, 1.0, 3.0)) == "FreePrecession(precession 1.5 rad/s, wobble -1.5 rad/s)"
    )


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: ed.free_precession(1.0, 2.1, 3.0), "at most twice"),
        (lambda: ed.free_precession(-1.0, 2.0, 3.0), "greater than zero"),
        (lambda: ed.free_precession(2.0, 1.0, 3.0, math.pi / 2), "leans from H"),
        (lambda: ed.free_precession(2.0, 1.0, math.nan), "spin is nan: it must be finite"),
        (lambda: ed.free_precession(2.0, 1.0, "fast"), "spin is 'fast': give a number"),
        (lambda: ed.steady_precession(2.0, 1.0, 3.0, 0.0, 1.0), "the axis vertical"),
        (lambda: ed.steady_precession(2.0, 1.0, 3.0, math.pi, 1.0), "the axis vertical"),
        (lambda: ed.steady_precession(2.0, 1.0, 3.0, -0.4, 1.0), "the axis vertical"),
        (lambda: ed.steady_precession(2.0, 1.0, 3.0, 0.4, math.inf), "torque_coefficient is inf"),
        (lambda: ed.steady_precession(2.0, 5.0, 3.0, 0.4, 1.0), "at most twice"),
    ],
)
def test_what_no_gyroscope_does_is_refused(make, message):
    with pytest.raises(ed.EngdynError, match=message):
        make()
