"""System: parameters checked, two routes offered, and a user's own system in 25 lines."""

from __future__ import annotations

import inspect
import math

import numpy as np
import pytest
import sympy as sm
from sympy.physics.mechanics import Force, Particle, Point, ReferenceFrame, dynamicsymbols

import engdyn as ed
from engdyn import Coordinate, Input, Parameter, System


def own_system() -> System:
    """A bead on a spinning hoop, as a user would write it."""
    m, R, W, c, g = ps = [
        Parameter("m", "kg", 0.1, "bead"),
        Parameter("R", "m", 0.3, "hoop radius"),
        Parameter("W", "rad/s", 8.0, "spin of the hoop", "any"),
        Parameter("c", "N s/m", 0.05, "friction", "nonnegative"),
        Parameter("g", "m/s^2", 9.81, "gravity", "any"),
    ]
    m, R, W, c, g = (p.symbol for p in ps)
    phi, F = dynamicsymbols("phi F")
    u, t = phi.diff(), dynamicsymbols._t
    N, H, O, n1, n2 = ReferenceFrame("N"), ReferenceFrame("H"), Point("O"), *sm.symbols("n1 n2")
    H.orient_axis(N, W * t, N.z)
    O.set_vel(N, 0)
    out, along = sm.sin(phi) * H.x - sm.cos(phi) * H.z, sm.cos(phi) * H.x + sm.sin(phi) * H.z
    P = O.locatenew("P", R * out)
    loads = [Force(P, -m * g * N.z), Force(P, (F - c * R * u) * along)]
    bead = ed.FreeBody(Particle("bead", P, m), loads, [Force(P, n1 * out + n2 * H.y)])
    T, V = m * R**2 * (u**2 + (W * sm.sin(phi)) ** 2) / 2, -m * g * R * sm.cos(phi)
    where = [Coordinate(phi, "rad", "angle from the lowest point", (-math.pi, math.pi))]
    push = [Input(F, "N", "push along the hoop")]
    return System(title="Bead on a hoop", coordinates=where, parameters=ps, inputs=push, kinetic_energy=T,
                  potential_energy=V, dissipation=c * (R * u) ** 2 / 2, generalized_forces={phi: F * R},
                  free_bodies=[bead], frame=N, unknowns=[n1, n2])  # fmt: skip


def test_a_users_own_system_takes_25_lines_and_goes_all_the_way():
    body = inspect.getsource(own_system).splitlines()[2:]
    assert len(body) <= 32  # with the five parameters one to a line
    system = own_system()
    assert system.prove()
    v = system.values(W=10)
    expected = (
        -(9.81 / 0.3) * math.sin(0.5)
        + 100 * math.sin(0.5) * math.cos(0.5)
        - 0.05 / 0.1 * 0.2
        + 2.0 / (0.1 * 0.3)
    )
    for eom in (system.newton(), system.lagrange()):
        np.testing.assert_allclose(eom.accelerations([0.5], [0.2], v, {"F": 2.0}), [expected], rtol=1e-12)
    found = system.equilibria(v)
    assert found.certified
    tilt = math.acos(9.81 / (0.3 * 100))
    np.testing.assert_allclose(sorted(s.q[0] for s in found)[:3], [-tilt, 0.0, tilt], atol=1e-9)
    assert repr(system) == "System(Bead on a hoop; phi)"
    assert "spin of the hoop" in system._repr_html_()


def test_values_are_defaults_with_changes_in_any_unit():
    crane = ed.systems.load("S07")
    values = crane.values(L="30 ft", m=3000, c_x="0.4 kN s/m")
    assert values["L"] == pytest.approx(9.144)
    assert values["m"] == 3000.0
    assert values["c_x"] == pytest.approx(400.0)
    assert values["M_t"] == 1200.0
    assert all(type(v) is float for v in values.values())
    assert list(values) == [p.name for p in crane.parameters]


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"mass": 1.0}, "unknown parameter 'mass'.*has M_t, m, L"),
        ({"M_T": 1.0}, "did you mean 'M_t'"),
        ({"m": -1.0}, "container mass.* is -1 kg: it must be greater than zero"),
        ({"m": 0}, "must be greater than zero"),
        ({"c_x": -0.1}, "must be zero or greater"),
        ({"L": math.nan}, "finite"),
        ({"L": math.inf}, "finite"),
        ({"L": "9 kg"}, "measures something else"),
        ({"L": "9,5"}, "not a number with a unit"),
        ({"L": None}, "give a number in m"),
        ({"L": [9.0]}, "give a number in m"),
    ],
)
def test_values_that_are_refused(changes, message):
    with pytest.raises(ed.ParameterError, match=message):
        ed.systems.load("S07").values(**changes)


def test_signs_that_are_admissible():
    crane, governor = ed.systems.load("S07"), ed.systems.load("S03")
    assert crane.values(c_x=0, g=-1.0)["g"] == -1.0
    assert governor.values(Omega="-172 rpm")["Omega"] == pytest.approx(-172 * math.pi / 30)
    with pytest.raises(ed.ParameterError, match="rpm"):
        governor.values(Omega="3 Hz")


def test_values_and_inputs_of_questions_are_checked_before_the_answer():
    crane = ed.systems.load("S07")
    with pytest.raises(ed.EngdynError, match=r"unknown input 'f'.*F"):
        crane.equilibria(f=1.0)
    with pytest.raises(ed.ParameterError, match="unknown parameter"):
        crane.equilibria({"Mt": 1.0})
    with pytest.raises(ed.EngdynError, match="values must map"):
        crane.equilibria([1.0])


def test_what_is_missing_is_said_where_it_is_needed():
    x = dynamicsymbols("x")
    m = Parameter("m", "kg", 1.0, "mass")
    bare = System(
        title="Free mass",
        coordinates=[Coordinate(x, "m", "place")],
        parameters=[m],
        kinetic_energy=m.symbol * x.diff() ** 2 / 2,
        potential_energy=sm.S.Zero,
    )
    assert bare.lagrange().mass_matrix == sm.Matrix([[m.symbol]])
    with pytest.raises(ed.EngdynError, match="no free bodies"):
        bare.newton()
    with pytest.raises(ed.EngdynError, match="no drawing"):
        bare.shapes([0.0])
    with pytest.raises(ed.EngdynError, match="no free bodies"):
        bare.prove()
    with pytest.raises(ed.EngdynError, match="parameter names must differ"):
        System(title="Two", coordinates=[], parameters=[m, m], kinetic_energy=0, potential_energy=0)
    point = Point("P")
    homeless = System(
        title="No frame",
        coordinates=[Coordinate(x, "m", "place")],
        parameters=[m],
        kinetic_energy=0,
        potential_energy=0,
        free_bodies=[ed.FreeBody(Particle("p", point, m.symbol))],
    )
    with pytest.raises(ed.EngdynError, match="no inertial frame"):
        homeless.newton()


def test_a_wrong_own_system_is_refuted_not_accepted():
    system = own_system()
    system.potential_energy = system.potential_energy * 2
    proof = system.prove()
    assert proof.verdict == "refuted"
    assert [d.kind for d in proof.differences] == ["factor"]


def test_symbols_know_what_is_admissible():
    assert Parameter("k", "N/m", 1.0, "spring", "nonnegative").symbol.is_nonnegative
    assert Parameter("m", "kg", 1.0, "mass").symbol.is_positive
    assert Parameter("w", "rad/s", 1.0, "spin", "any").symbol.is_real
    with pytest.raises(ed.ParameterError, match="choose one of positive, nonnegative, any"):
        Parameter("k", "N/m", 1.0, "spring", "negative")
    own = sm.Symbol("anything")
    assert Parameter(own, "m", 1.0, "length").symbol is own
    assert Parameter(own, "m", 1.0, "length").name == "anything"


def test_the_equations_of_the_analyses_are_derived_once():
    crane = ed.systems.load("S07")
    assert crane.equations is crane.equations
    assert crane.equations.origin == "Lagrange"
    assert crane.newton().defaults == {}
    governor = ed.systems.load("S03")
    assert [w.func.__name__ for w in governor.newton().defaults] == ["drive"]


def carousel(**changes) -> System:
    """A bob on an arm that is turned at a rate: the rate W occurs in the steady motion alone."""
    ps = [
        Parameter("m", "kg", 2.0, "bob"),
        Parameter("L", "m", 0.5, "arm"),
        Parameter("W", "rad/s", 8.0, "rate of the steady motion", "any"),
        Parameter("g", "m/s^2", 9.81, "gravity", "any"),
    ]
    m, L, _, g = (p.symbol for p in ps)
    turn, tilt, M, F = dynamicsymbols("turn tilt M F")
    kinetic = m * L**2 * (tilt.diff() ** 2 + (turn.diff() * sm.sin(tilt)) ** 2) / 2 + turn.diff() ** 2
    where = [
        Coordinate(turn, "rad", "about the vertical", None, "ignorable"),
        Coordinate(tilt, "rad", "from the downward vertical", (-math.pi, math.pi)),
    ]
    held = {"steady": lambda values, inputs: {"rates": {"turn": values["W"]}, "free": ["M"]}}
    return System(title="Carousel", coordinates=where, parameters=ps, kinetic_energy=kinetic,
                  potential_energy=-m * g * L * sm.cos(tilt), generalized_forces={turn: M, tilt: F * L},
                  inputs=[Input(M, "N m", "motor", "couple"), Input(F, "N", "push")],
                  **(held | changes))  # fmt: skip


def test_a_parameter_of_the_steady_motion_alone_can_be_varied():
    found = carousel().branches("W", (2.0, 10.0))
    (fork,) = (p for p in found.points if abs(p.q[1]) < 1e-6)
    assert fork.kind == "pitchfork"
    assert fork.parameter == pytest.approx(math.sqrt(9.81 / 0.5), rel=1e-9)
    leaning = [b for b in found if np.ptp(np.abs(b.q[:, 1])) > 0.1]
    assert len(leaning) == 2
    for branch in leaning:
        np.testing.assert_allclose(np.cos(branch.q[:, 1]), 9.81 / (0.5 * branch.parameter**2), atol=1e-8)


def test_what_the_steady_motion_sets_gives_way_to_what_is_given():
    pushed = carousel(steady=lambda values, inputs: {"rates": {"turn": 0.0}, "inputs": {"F": 4.0}})
    expected = math.asin(4.0 / (2.0 * 9.81))
    assert sorted(e.q[1] for e in pushed.equilibria()) == pytest.approx([expected, math.pi - expected])
    assert sorted(e.q[1] for e in pushed.equilibria(F=-4.0)) == pytest.approx([expected - math.pi, -expected])
    for given, side in (({}, 1), ({"F": -4.0}, -1)):
        branches = pushed.branches("g", (8.0, 12.0), **given)
        assert len(branches) == 2
        assert all(side * b.q[i, 1] > 0 for b in branches for i in (0, -1))


def test_bounds_of_the_steady_motion_join_those_of_the_coordinates():
    def narrow(values, inputs):
        return {"rates": {"turn": 0.0}, "bounds": {"tilt": (-values["L"], 2 * values["L"])}}

    assert [e.q[1] for e in carousel(steady=narrow).equilibria()] == [0.0]
    assert len(carousel(steady=narrow).equilibria({"L": 2.0})) == 2
    over = carousel(steady=narrow).branches("L", (1.0, 2.0))  # upright within the bounds from L = pi/2
    assert sorted(round(float(b.parameter.min()), 6) for b in over) == [1.0, round(math.pi / 2, 6)]


def test_a_region_that_is_no_box():
    asked = []

    def leaning(q, values):
        asked.append(values["W"])
        return abs(q[1]) * values["L"] > 0.1

    found = carousel(region=leaning).equilibria()
    angle = math.acos(9.81 / (0.5 * 64))
    assert found.certified
    np.testing.assert_allclose([e.q[1] for e in found], [-angle, angle, math.pi])
    branches = carousel(region=leaning).branches("W", (2.0, 10.0))
    assert min(abs(q) for b in branches for q in b.q[:, 1]) == pytest.approx(0.2, abs=1e-6)
    assert set(asked) > {8.0}  # the varied parameter with its values along the branches


def test_a_rate_that_varies_and_takes_others_along_is_refused():
    train = ed.systems.load("S20")
    wind = next(p.symbol for p in train.parameters if p.name == "v")
    with pytest.raises(ed.EngdynError, match="also prescribe those of tb, tg"):
        ed.continue_equilibria(
            train.equations,
            train.values(),
            "v",
            (8.0, 12.0),
            rates={"tr": wind / 6},
            free=["T_w"],
        )
