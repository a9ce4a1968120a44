"""Pitfalls 3, 5 and 6: what goes wrong with moments, kinetic energy and reactions, and that it is noticed."""

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
    dynamicsymbols,
    inertia,
)

import engdyn as ed
from modeling.third_opinion import chain

t = dynamicsymbols._t
m, l, g = sm.symbols("m l g", positive=True)

# Pitfall 3: a bar hinged at A to a cart that is accelerated, x(t) given

theta, x = dynamicsymbols("theta x")
N, B, O = ReferenceFrame("N"), ReferenceFrame("B"), Point("O")
B.orient_axis(N, theta, N.z)
O.set_vel(N, 0)
A = O.locatenew("A", x * N.x)
G = A.locatenew("G", -l / 2 * B.y)
H_x, H_y = sm.symbols("H_x H_y")
BAR = ed.FreeBody(
    RigidBody("bar", G, B, m, (inertia(B, 0, 0, m * l**2 / 12), G)),
    [Force(G, -m * g * N.y)],
    [Force(A, H_x * N.x + H_y * N.y)],
)
#: Force balance by hand: ΣF = m a_G with G at (x + l/2 sin θ, −l/2 cos θ).
HINGE = {
    H_x: m * (x + l / 2 * sm.sin(theta)).diff(t, 2),
    H_y: m * g + m * (-l / 2 * sm.cos(theta)).diff(t, 2),
}


def equation(balance, left_out=0):
    moment = balance.equation[2] - left_out
    return ed.EquationsOfMotion.from_residuals([moment.subs(HINGE)], [theta])


@pytest.mark.parametrize(
    ("about", "kind"), [(G, "mass center"), (A, "accelerating point"), (O, "fixed point")], ids=str
)
def test_pitfall_3_three_reference_points_give_one_equation_of_motion(about, kind):
    balance = ed.moment_balance(BAR, about, N)
    assert balance.kind == kind
    reference = ed.newton_euler([BAR], [theta], N, [H_x, H_y])
    assert ed.prove_equal(equation(balance), reference)
    kinetic = m * ((x + l / 2 * sm.sin(theta)).diff(t) ** 2 + (l / 2 * sm.cos(theta)).diff(t) ** 2) / 2
    energies = ed.lagrange(
        kinetic + m * l**2 / 24 * theta.diff(t) ** 2, -m * g * l / 2 * sm.cos(theta), [theta]
    )
    assert ed.prove_equal(equation(balance), energies)


def test_pitfall_3_the_extra_term_left_out_is_refuted():
    balance = ed.moment_balance(BAR, A, N)
    extra = balance.extra.dot(N.z)
    assert sm.expand(extra - m * l / 2 * sm.cos(theta) * x.diff(t, 2)) == 0
    proof = ed.prove_equal(equation(balance, left_out=extra), equation(balance))
    assert proof.verdict == "refuted"
    assert proof.differences
    # About the hinge its force has no moment: it need not be known.
    assert not {H_x, H_y} & balance.equation[2].free_symbols


def test_pitfall_3_in_space_the_term_is_a_vector():
    q, offset = dynamicsymbols("q_1:4"), sm.symbols("d_1:4")
    body, hub, center = ReferenceFrame("S"), Point("P"), Point("C")
    body.orient_body_fixed(N, q, "ZYX")
    hub.set_pos(O, sm.sin(t) * N.x + t**2 * N.y + sm.exp(t) * N.z)
    center.set_pos(hub, sum((d * e for d, e in zip(offset, body, strict=True)), 0 * N.x))
    rigid = RigidBody("body", center, body, m, (inertia(body, *sm.symbols("J_1:4")), center))
    about_hub, about_center = (ed.moment_balance(ed.FreeBody(rigid), p, N) for p in (hub, center))
    # r × m a_G transfers the balance from G to any point: that is the oracle.
    a_center = center.pos_from(O).dt(N).dt(N)
    wanted = about_center.rate_of_change + center.pos_from(hub).cross(m * a_center)
    found = about_hub.rate_of_change + about_hub.extra
    source = np.random.default_rng(2)
    numbers = {s: source.uniform(0.5, 1.5) for s in (*sm.symbols("J_1:4"), *offset, m)}
    numbers |= {e.diff(t, k): source.uniform(-1, 1) for e in q for k in (1, 2)}
    numbers |= {e: source.uniform(0.2, 0.9) for e in q} | {t: 0.4}
    both = [[float(e.xreplace(numbers)) for e in v.to_matrix(N)] for v in (wanted, found)]
    np.testing.assert_allclose(both[1], both[0], rtol=1e-10)
    extra = [float(e.xreplace(numbers)) for e in about_hub.extra.to_matrix(N)]
    assert min(abs(e) for e in extra) > 0.01


# Pitfall 5: the kinetic energy of a body of which no point, or another one, is fixed


def double_pendulum(second, first=None):
    """Lagrange's equations of two uniform bars with given kinetic energies, and Newton's."""
    model = chain(2, cart=False)
    m1, l1, a1, J1, m2, a2, J2 = sm.symbols("m1 l1 a1 J1 m2 a2 J2", positive=True)
    q1, q2 = model.coordinates
    w1, w2 = q1.diff(t), q2.diff(t)
    v_g1 = a1**2 * w1**2
    v_g2 = l1**2 * w1**2 + a2**2 * w2**2 + 2 * l1 * a2 * sm.cos(q1 - q2) * w1 * w2
    kinds = {
        "about G": lambda m_, v, a, J, w: m_ * v / 2 + J * w**2 / 2,
        "about the hinge alone": lambda m_, v, a, J, w: (J + m_ * a**2) * w**2 / 2,
        "counted twice": lambda m_, v, a, J, w: m_ * v / 2 + (J + m_ * a**2) * w**2 / 2,
    }
    kinetic = kinds[first or "about G"](m1, v_g1, a1, J1, w1) + kinds[second](m2, v_g2, a2, J2, w2)
    lagrange = ed.lagrange(kinetic, model.potential, [q1, q2], model.dissipation)
    return ed.prove_equal(lagrange, model.newton())


def test_pitfall_5_about_g_and_about_a_fixed_hinge_are_one():
    assert double_pendulum("about G")
    assert double_pendulum("about G", first="about the hinge alone")
    gymnast = ed.systems.load("S08")
    bodies = [free.body for free in gymnast.free_bodies()]
    by_package = ed.kinetic_energy(bodies, gymnast.frame)
    coordinates = [c.symbol for c in gymnast.coordinates]
    rest = gymnast.potential_energy, coordinates, gymnast.dissipation, gymnast.generalized_forces
    assert ed.prove_equal(ed.lagrange(by_package, *rest), gymnast.newton())


@pytest.mark.parametrize(
    ("first", "second"),
    [
        ("about G", "about the hinge alone"),  # the hinge of the second bar accelerates
        ("about G", "counted twice"),
        ("counted twice", "about G"),
    ],
)
def test_pitfall_5_a_moving_point_or_translation_counted_twice_is_refuted(first, second):
    proof = double_pendulum(second, first)
    assert proof.verdict == "refuted"
    assert proof.witness is not None


# Pitfall 6: reactions are unknowns, counted with the equations; no normal force is m g by itself

WEDGE = ed.systems.load("W3")
COORDINATES = [c.symbol for c in WEDGE.coordinates]


((_, SLOPE),) = WEDGE.free_bodies()[1].reactions[0].force.args  # X down the plane, Y off it
PARAMETER = {p.name: p.symbol for p in WEDGE.parameters}


def wedge_with(reactions, applied, unknowns):
    """Newton's equations with other forces of the plane on the roll: unknown ones and known ones."""
    cart, roll = WEDGE.free_bodies()
    point = roll.reactions[0].point
    on_roll = [[Force(point, v) for v in vectors] for vectors in (reactions, applied)]
    on_cart = [[Force(point, -v) for v in vectors] for vectors in (reactions, applied)]
    bodies = [
        ed.FreeBody(cart.body, [*cart.applied, *on_cart[1]], [cart.reactions[0], *on_cart[0]]),
        ed.FreeBody(roll.body, [*roll.applied, *on_roll[1]], on_roll[0]),
    ]
    return ed.newton_euler(bodies, COORDINATES, WEDGE.frame, unknowns)


def test_pitfall_6_the_number_of_equations_is_that_of_the_unknowns():
    normal, friction, floor = WEDGE.unknowns
    loads = [normal * SLOPE.y, -friction * SLOPE.x]
    assert ed.prove_equal(wedge_with(loads, [], [normal, friction, floor]), WEDGE.lagrange())
    # One reaction forgotten: the balances say which of them nothing can satisfy.
    with pytest.raises(
        ed.EngdynError, match="5 equations for 2 accelerations and 2 reactions: 1 reaction is miss"
    ):
        wedge_with(loads[:1], [], [normal, floor])
    # One too many: the two wheels of the cart share the load in a way that these balances cannot tell.
    cart, roll = WEDGE.free_bodies()
    second = sm.Symbol("N_2")
    cart = ed.FreeBody(cart.body, cart.applied, [*cart.reactions, Force(cart.center, second * WEDGE.frame.y)])
    with pytest.raises(ed.EngdynError, match="5 equations for 2 accelerations and 4 reactions: 1 too many"):
        ed.newton_euler([cart, roll], COORDINATES, WEDGE.frame, [*WEDGE.unknowns, second])


def test_pitfall_6_a_normal_force_of_m_g_is_one_equation_too_many():
    _, friction, floor = WEDGE.unknowns
    assumed = PARAMETER["m"] * PARAMETER["g"] * sm.cos(PARAMETER["beta"]) * SLOPE.y
    with pytest.raises(ed.EngdynError, match="1 reaction is missing"):
        wedge_with([-friction * SLOPE.x], [assumed], [friction, floor])


def test_pitfall_6_friction_is_mu_n_only_when_sliding():
    normal, _, floor = WEDGE.unknowns
    mu = sm.Symbol("mu", positive=True)
    loads = [normal * SLOPE.y, -mu * normal * SLOPE.x]
    with pytest.raises(ed.EngdynError, match="1 reaction is missing"):
        wedge_with(loads, [], [normal, floor])


def test_pitfall_6_a_workless_force_in_q_is_refuted():
    """The friction at a rolling contact does no work: put into Q it is counted as if it did."""
    s = COORDINATES[1]
    forces = {**WEDGE.generalized_forces, s: -PARAMETER["m"] * s.diff(t, 2) / 2}
    wrong = ed.lagrange(WEDGE.kinetic_energy, WEDGE.potential_energy, COORDINATES, 0, forces)
    assert ed.prove_equal(wrong, WEDGE.newton()).verdict == "refuted"


@pytest.mark.parametrize("key", ["S07", "W3"])
def test_pitfall_6_the_normal_force_changes_with_the_motion(key):
    system = ed.systems.load(key)
    eom = system.newton()
    normal = next(x for x in system.unknowns if x.name in ("N_r", "N"))
    accelerations = [c.symbol.diff(t, 2) for c in system.coordinates]
    assert any(eom.reactions[normal].has(a) for a in accelerations)


# The roll on the wedge: does it stick?


def contact_forces(values, F=0.0):
    """Normal force, friction and floor force of the rolling roll, as numbers."""
    eom = WEDGE.newton()
    udot = eom.accelerations([0.2, 0.7], [0.4, -0.3], values, {"F": F})
    at = dict(zip((c.diff(t, 2) for c in COORDINATES), udot, strict=True))
    at |= {p.symbol: values[p.name] for p in WEDGE.parameters} | {WEDGE.inputs[0].symbol: F}
    return [float(eom.reactions[x].xreplace(at)) for x in WEDGE.unknowns], udot


@pytest.mark.parametrize("beta", [0.1, math.radians(20), 0.9])
@pytest.mark.parametrize("mass", [5.0, 500.0])
def test_the_needed_friction_is_the_closed_form(beta, mass):
    values = WEDGE.values(beta=beta, M=mass)
    (normal, friction, floor), (cart, along) = contact_forces(values)
    share = values["m"] * math.cos(beta) / (values["M"] + values["m"])
    s_dd = values["g"] * math.sin(beta) / (1.5 - share * math.cos(beta))
    assert along == pytest.approx(s_dd, rel=1e-12)
    assert cart == pytest.approx(-share * s_dd, rel=1e-12)
    wanted = s_dd / 2 / (values["g"] * math.cos(beta) - share * math.sin(beta) * s_dd)
    assert friction / normal == pytest.approx(wanted, rel=1e-12)
    assert normal < values["m"] * values["g"] * math.cos(beta)  # the wedge gives way
    assert floor < (values["m"] + values["M"]) * values["g"]


def test_on_a_cart_that_does_not_move_a_third_of_the_slope_is_needed():
    eom = WEDGE.newton()
    normal, friction, _ = WEDGE.unknowns
    beta, mass = PARAMETER["beta"], PARAMETER["M"]
    solved = eom.mass_matrix.LUsolve(eom.forcing).subs(WEDGE.inputs[0].symbol, 0)
    at = dict(zip((c.diff(t, 2) for c in COORDINATES), solved, strict=True))
    needed = (eom.reactions[friction] / eom.reactions[normal]).subs(at).subs(WEDGE.inputs[0].symbol, 0)
    limit = sm.limit(sm.cancel(needed), mass, sm.oo)
    for angle in (0.1, 0.4, 1.0):
        assert float(limit.subs(beta, angle)) == pytest.approx(math.tan(angle) / 3, rel=1e-12)
    (N_, S_, _), _ = contact_forces(WEDGE.values(beta=0.4, M=1e12))
    assert pytest.approx(math.tan(0.4) / 3, rel=1e-9) == S_ / N_


def sliding():
    """The same roll with a turn of its own, and the friction mu N of a contact that slides down."""
    cart, roll = WEDGE.free_bodies()
    normal, friction, floor = WEDGE.unknowns
    mu, spin = sm.Symbol("mu", nonnegative=True), dynamicsymbols("spin")
    axes = ReferenceFrame("R")
    axes.orient_axis(WEDGE.frame, -spin, WEDGE.frame.z)
    mass, radius = PARAMETER["m"], PARAMETER["R"]
    body = RigidBody(
        "roll", roll.center, axes, mass, (inertia(axes, 0, 0, mass * radius**2 / 2), roll.center)
    )
    changed = [
        ed.FreeBody(
            new,
            old.applied,
            [Force(load.point, load.force.subs(friction, mu * normal)) for load in old.reactions],
        )
        for new, old in ((cart.body, cart), (body, roll))
    ]
    return ed.newton_euler(changed, [*COORDINATES, spin], WEDGE.frame, [normal, floor])


@pytest.mark.parametrize("F", [0.0, 1500.0, -2000.0])
def test_below_the_needed_friction_the_contact_slides_and_at_it_the_two_models_meet(F):
    values = WEDGE.values()
    (normal, friction, _), rolling = contact_forces(values, F)
    needed, eom = friction / normal, sliding()
    assert needed > 0
    slips = []
    for factor in (0.5, 0.9, 1.0, 1.1):
        found = eom.accelerations([0, 0, 0], [0, 0, 0], {**values, "mu": factor * needed}, {"F": F})
        slips.append(found[1] - values["R"] * found[2])
        if factor == 1.0:
            np.testing.assert_allclose(found[:2], rolling, rtol=1e-12)
    assert slips[0] > slips[1] > 1e-3  # down the plane, as the friction up the plane supposes
    assert slips[2] == pytest.approx(0, abs=1e-12)
    assert slips[3] < 0  # more than is needed would push it uphill: it sticks


def test_a_push_on_the_cart_changes_what_friction_is_needed():
    """Pushed with (M + m) g tan β the roll stays where it is on the plane and needs no friction."""
    values = WEDGE.values()
    push = (values["M"] + values["m"]) * values["g"] * math.tan(values["beta"])
    (normal, friction, _), (cart, along) = contact_forces(values, push)
    assert along == pytest.approx(0, abs=1e-10)
    assert cart == pytest.approx(values["g"] * math.tan(values["beta"]), rel=1e-12)
    assert friction == pytest.approx(0, abs=1e-8)
    assert normal == pytest.approx(values["m"] * values["g"] / math.cos(values["beta"]), rel=1e-12)
    forces = np.array([contact_forces(values, F)[0] for F in np.linspace(-1000, push, 9)])
    assert np.all(np.diff(forces[:, 1] / forces[:, 0]) < 0)


def test_a_particle_cannot_be_given_a_moment_by_mistake():
    balance = ed.moment_balance(ed.FreeBody(Particle("p", A, m), [Force(A, m * g * N.x)]), A, N)
    assert balance.equation == (0, 0, 0)
