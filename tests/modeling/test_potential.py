"""Which forces have a potential, and does a potential give its loads?"""

from __future__ import annotations

import pytest
import sympy as sm
from sympy.physics import mechanics as me

import engdyn as ed

t = me.dynamicsymbols._t
x, y, theta, psi = me.dynamicsymbols("x y theta psi")
k, l, a, b, m, g, P, free = sm.symbols("k l a b m g P l_0", positive=True)
sin, cos = sm.sin, sm.cos

POTENTIALS = {
    "springs": (k * (x - y) ** 2 / 2 + b * x**4 - m * g * y, [x, y]),
    "pendulums": (-m * g * (2 * l * cos(theta) + a * cos(psi)) + k * (theta - psi) ** 2 / 2, [theta, psi]),
    "products": (m * g * cos(theta) * sin(psi) ** 2 + k * x * sin(3 * theta) * theta**2, [theta, psi, x]),
    "distance": (k * (sm.sqrt(x**2 + a**2) - free) ** 2 / 2, [x]),
    "distance in a plane": (
        k
        * (sm.sqrt((a * cos(theta) + b * cos(psi) - l) ** 2 + (a * sin(theta) + b * sin(psi)) ** 2) - free)
        ** 2
        / 2,
        [theta, psi],
    ),
    "by parts": (k * (x * sin(3 * x) / 3 + cos(3 * x) / 9) - b * (x * cos(2 * x) / 2 - sin(2 * x) / 4), [x]),
    "cube of a distance": (k * (x**2 + a**2) ** sm.Rational(3, 2), [x]),
    "time": (k * x * t * sin(b * t), [x]),
    "none": (sm.S.Zero, [x, y]),
}


@pytest.mark.parametrize("name", POTENTIALS)
def test_the_potential_is_found_again(name):
    V, q = POTENTIALS[name]
    found = ed.potential_of({e: -V.diff(e) for e in q}, q)
    numbers = dict(zip((k, l, a, b, m, g, free), (3, 2, 1.5, 0.7, 1.1, 9.81, 0.4), strict=True))
    here = dict(zip((x, y, theta, psi), (0.3, -0.8, 0.5, 1.1), strict=True))
    there = dict(zip((x, y, theta, psi), (-1.2, 0.4, -0.9, 2.0), strict=True))
    change = [(e.subs(there) - e.subs(here)).subs(numbers).subs(t, 0.6) for e in (V, found)]
    assert float(change[1]) == pytest.approx(float(change[0]), rel=1e-10, abs=1e-12)


def test_a_field_with_curl_names_the_pair():
    with pytest.raises(ed.EngdynError, match=r"no potential: dQ_x/dy = -k, but dQ_y/dx = k"):
        ed.potential_of({x: -k * y, y: k * x}, [x, y])
    with pytest.raises(ed.EngdynError, match="depends on the rate of x"):
        ed.potential_of({x: -k * x.diff(t)}, [x])
    with pytest.raises(ed.EngdynError, match="not among the coordinates"):
        ed.potential_of({y: -k * y}, [x])
    with pytest.raises(ed.EngdynError, match="formula was not found"):
        ed.potential_of({x: -k / (x**2 + 1)}, [x])
    with pytest.raises(ed.EngdynError, match="not text"):
        ed.potential_of({x: "-k*x"}, [x])


def spring_scene():
    N, B, O = me.ReferenceFrame("N"), me.ReferenceFrame("B"), me.Point("O")
    B.orient_axis(N, theta, N.z)
    O.set_vel(N, 0)
    tip, wall = O.locatenew("tip", l * B.x), O.locatenew("wall", a * N.x)
    vector = tip.pos_from(wall)
    length = vector.magnitude()
    return N, wall, tip, me.Force(tip, -k * (length - free) * vector / length)


def test_v_and_the_loads_agree():
    N, wall, tip, pull = spring_scene()
    weight = me.Force(tip, -m * g * N.y)
    V = ed.spring_potential(k, wall, tip, free) + m * g * l * sin(theta)
    Q = ed.check_potential(V, [pull, weight], [theta], N)
    expected = ed.generalized_forces([pull, weight], [theta], N)
    assert expected[theta] == Q[theta] != 0


def test_a_missing_free_length_is_noticed():
    N, wall, tip, pull = spring_scene()
    with pytest.raises(
        ed.EngdynError, match=r"Q_theta \+ dV/dtheta = .*V knows nothing of l_0 \(the free length"
    ):
        ed.check_potential(ed.spring_potential(k, wall, tip, 0), [pull], [theta], N)
    with pytest.raises(ed.EngdynError, match=r"not 0$"):
        ed.check_potential(ed.spring_potential(2 * k, wall, tip, free), [pull], [theta], N)


def test_a_wrong_sign_of_gravity_is_noticed():
    N, _, tip, _ = spring_scene()
    with pytest.raises(ed.EngdynError, match="does not give the loads"):
        ed.check_potential(-m * g * l * sin(theta), me.Force(tip, -m * g * N.y), [theta], N)
