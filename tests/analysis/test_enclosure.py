"""Enclosure of all roots: against numpy.roots, closed forms and a brute-force search, on both backends."""

from __future__ import annotations

import copy
import dataclasses
import importlib.util
import itertools
import math
import sys
import time
from fractions import Fraction
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from scipy.optimize import root as scipy_root

from engdyn.analysis.enclosure import Certificate
from engdyn.errors import EngdynError

BACKENDS = ["flint", "sympy"] if importlib.util.find_spec("flint") else ["sympy"]
PI = math.pi


def load(backend: str) -> SimpleNamespace:
    """Private copies of both modules that read ENGDYN_BACKEND anew."""
    copies = {}
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("ENGDYN_BACKEND", backend)
        for name in ("engdyn.algebra.balls", "engdyn.analysis.interval_newton", "engdyn.analysis.enclosure"):
            spec = importlib.util.find_spec(name)
            copies[name] = importlib.util.module_from_spec(spec)
            patch.setitem(sys.modules, name, copies[name])
            spec.loader.exec_module(copies[name])
    balls, _, enclosure = copies.values()
    names = {**balls.NAMESPACE, "ball": balls.ball, "module": enclosure}
    return SimpleNamespace(**names, enclose=enclosure.enclose_roots, backend=balls.BACKEND)


COPIES = {backend: load(backend) for backend in BACKENDS}


@pytest.fixture(params=BACKENDS)
def e(request):
    """The backend's elementary functions, `ball`, `enclose` and the `module` itself."""
    return COPIES[request.param]


# ------------------------------------------------ problems: (function, jacobian, region, periodic)


def circle(e):
    return lambda x: [e.sin(x[0])], lambda x: [[e.cos(x[0])]], [(-PI, PI)], (0,)


def governor(e):
    def function(x):
        return [e.sin(x[0]) * (2.5 * e.cos(x[0]) - 1)]

    def jacobian(x):
        return [[5 * e.square(e.cos(x[0])) - 2.5 - e.cos(x[0])]]

    return function, jacobian, [(-PI, PI)], (0,)


def snap_through(e, load=0.05, rise=0.5):
    def function(x):
        return [x[0] * (1 - 1 / e.sqrt(rise**2 + e.square(x[0]))) - load]

    def jacobian(x):
        length = e.sqrt(rise**2 + e.square(x[0]))
        return [[1 - rise**2 / e.power(length, 3)]]

    return function, jacobian, [(-2.0, 2.0)], ()


def hinged_pair(e, stiffness=0.9):
    """Two inverted pendula with a torsion spring between them."""

    def function(x):
        a, b = x
        return [2 * e.sin(a) - stiffness * e.sin(b - a), e.sin(b) + stiffness * e.sin(b - a)]

    def jacobian(x):
        a, b = x
        c = stiffness * e.cos(b - a)
        return [[2 * e.cos(a) + c, -c], [-c, e.cos(b) + c]]

    return function, jacobian, [(-PI, PI), (-PI, PI)], (0, 1)


def tilting_chain(e, stiffness=0.35):
    """Three pendula in a row with linear torsion springs between neighbors."""
    k = stiffness

    def function(x):
        a, b, c = x
        return [e.sin(a) + k * (a - b), e.sin(b) + k * (2 * b - a - c), e.sin(c) + k * (c - b)]

    def jacobian(x):
        a, b, c = x
        return [[e.cos(a) + k, -k, 0], [-k, e.cos(b) + 2 * k, -k], [0, -k, e.cos(c) + k]]

    return function, jacobian, [(-6.0, 6.0)] * 3, ()


def polynomial(e, coefficients, region):
    """One polynomial, coefficients from the highest power down, by Horner's rule."""

    def function(x):
        value = e.ball(0)
        for c in coefficients:
            value = value * x[0] + e.ball(c)
        return [value]

    degree = len(coefficients) - 1
    slopes = [(degree - k) * c for k, c in enumerate(coefficients[:-1])]

    def jacobian(x):
        value = e.ball(0)
        for c in slopes:
            value = value * x[0] + e.ball(c)
        return [[value]]

    return function, jacobian, region, ()


def satellite(e, inertias=(80.0, 90.0, 20.0), pitch=1.5):
    """Gravity-gradient torques on a satellite in circular orbit: yaw, pitch, roll (rotations 3-2-1).

    Torque over orbit rate squared = 3 o3 x J o3 - o2 x J o2, o2 and o3 being the orbit's axes in the body.
    """
    differences = [inertias[2] - inertias[1], inertias[0] - inertias[2], inertias[1] - inertias[0]]
    pairs = [(1, 2), (2, 0), (0, 1)]

    def axes(x):
        (cy, cp, cr), (sy, sp, sr) = [e.cos(v) for v in x], [e.sin(v) for v in x]
        o3, o2 = (-sp, sr * cp, cr * cp), (cp * sy, sr * sp * sy + cr * cy, cr * sp * sy - sr * cy)
        of_o3 = ((0, 0, 0), (-cp, -sr * sp, -cr * sp), (0, cr * cp, -sr * cp))
        of_o2 = (
            (cp * cy, sr * sp * cy - cr * sy, cr * sp * cy + sr * sy),
            (-sp * sy, sr * cp * sy, cr * cp * sy),
            (0, cr * sp * sy - sr * cy, -sr * sp * sy - cr * cy),
        )
        return o3, o2, of_o3, of_o2

    def function(x):
        o3, o2, _, _ = axes(x)
        return [d * (3 * o3[i] * o3[j] - o2[i] * o2[j]) for d, (i, j) in zip(differences, pairs, strict=True)]

    def jacobian(x):
        o3, o2, of_o3, of_o2 = axes(x)
        return [
            [
                d * (3 * (p[i] * o3[j] + o3[i] * p[j]) - (q[i] * o2[j] + o2[i] * q[j]))
                for p, q in zip(of_o3, of_o2, strict=True)
            ]
            for d, (i, j) in zip(differences, pairs, strict=True)
        ]

    return function, jacobian, [(-PI, PI), (-pitch, pitch), (-PI, PI)], (0, 2)


def enclose(e, problem, **options):
    function, jacobian, region, periodic = problem
    return e.enclose(function, jacobian, region, periodic=periodic, **options)


PROBLEMS = {
    "circle": circle,
    "governor": governor,
    "snap_through": snap_through,
    "hinged_pair": hinged_pair,
    "tilting_chain": tilting_chain,
    "wilkinson": lambda e: polynomial(e, [round(c) for c in np.poly(range(1, 9))], [(-1.0, 9.5)]),
    "edges": lambda e: polynomial(e, [1, -3, 2, 0], [(0.0, 2.0)]),
}


def brute_force(e, problem, points: int) -> np.ndarray:
    """Roots found by scipy's hybrid Powell method from every node of a grid, without duplicates."""
    floats = SimpleNamespace(
        sin=np.sin, cos=np.cos, sqrt=np.sqrt, square=np.square, power=np.power, ball=float, exp=np.exp
    )
    function, jacobian, region, periodic = problem(floats)
    found: list[np.ndarray] = []
    for start in itertools.product(*(np.linspace(low, high, points) for low, high in region)):
        result = scipy_root(
            lambda x: np.array(function(list(x)), dtype=float),
            start,
            jac=lambda x: np.array(jacobian(list(x)), dtype=float),
            tol=1e-13,
        )
        x = result.x
        if not result.success or np.abs(function(list(x))).max() > 1e-10:
            continue
        for k in periodic:
            low, high = region[k]
            x[k] = high - (high - x[k]) % (high - low)
            x[k] = high if x[k] - low < 1e-9 else x[k]
        inside = all(low - 1e-9 <= v <= high + 1e-9 for v, (low, high) in zip(x, region, strict=True))
        if inside and not any(np.abs(x - known).max() < 1e-6 for known in found):
            found.append(x)
    return np.array(sorted(found, key=lambda x: [round(v, 6) for v in x])).reshape(-1, len(region))


def assert_same_roots(certificate, expected, tolerance=1e-12):
    """Both sets are equal as sets: each expected root is met by one enclosure, and no enclosure is left."""
    expected = np.atleast_2d(np.asarray(expected, dtype=float))
    assert len(certificate.roots) == len(expected)
    for root in expected:
        assert np.abs(certificate.points - root).max(axis=1).min() <= tolerance


def holds(box, point, slack=0.0) -> bool:
    return all(low - slack <= v <= high + slack for (low, high), v in zip(box, point, strict=True))


# ------------------------------------------------------------ closed forms


def test_sine_on_a_periodic_circle_has_its_seam_root_once(e):
    certificate = enclose(e, circle(e))
    assert certificate.certified
    assert_same_roots(certificate, [[0.0], [PI]], 1e-15)
    assert len(certificate.accepted) == 3  # the root on the seam is proved at either end
    assert certificate.points.max() <= PI


def test_sine_without_wrapping_has_a_root_at_both_ends(e):
    function, jacobian, region, _ = circle(e)
    certificate = e.enclose(function, jacobian, region)
    assert certificate.certified
    assert_same_roots(certificate, [[-PI], [0.0], [PI]], 1e-15)


def test_sine_over_many_periods(e):
    function, jacobian, _, _ = circle(e)
    certificate = e.enclose(function, jacobian, [(-40.5 * PI, 40.5 * PI)])
    assert certificate.certified
    assert_same_roots(certificate, [[k * PI] for k in range(-40, 41)])


def test_governor_has_its_symmetric_pair(e):
    certificate = enclose(e, governor(e))
    assert certificate.certified
    assert_same_roots(certificate, [[0.0], [PI], [math.acos(0.4)], [-math.acos(0.4)]], 1e-14)


@pytest.mark.parametrize("load", [0.05, 0.2, 0.5])
def test_snap_through_truss_has_three_equilibria_below_the_snap_load(e, load):
    """With x = rise * tan(a) the equation is a quartic in x: numpy.roots, then the spurious ones dropped."""
    rise = 0.5
    quartic = np.poly1d([1, -load]) ** 2 * np.poly1d([1, 0, rise**2]) - np.poly1d([1, 0, 0])
    real = [r.real for r in quartic.roots if abs(r.imag) < 1e-9]
    expected = [[x] for x in real if abs(x * (1 - 1 / math.hypot(rise, x)) - load) < 1e-9 and abs(x) <= 2]
    certificate = enclose(e, snap_through(e, load, rise))
    snap_load = (1 - rise ** (2 / 3)) ** 1.5
    assert len(expected) == (3 if load < snap_load else 1)
    assert certificate.certified
    assert_same_roots(certificate, expected)


@pytest.mark.parametrize("stiffness", [0.3, 0.9, 3.0])
def test_coupled_pendula_against_brute_force(e, stiffness):
    expected = brute_force(e, lambda floats: hinged_pair(floats, stiffness), 12)
    certificate = enclose(e, hinged_pair(e, stiffness))
    assert certificate.certified
    assert_same_roots(certificate, expected, 1e-9)
    for a, b in certificate.points:  # to the last bits, which the brute force does not reach
        assert abs(2 * math.sin(a) - stiffness * math.sin(b - a)) < 5e-15
        assert abs(math.sin(b) + stiffness * math.sin(b - a)) < 5e-15


def test_three_unknowns_against_brute_force(e):
    certificate = enclose(e, tilting_chain(e))
    assert certificate.certified
    assert_same_roots(certificate, brute_force(e, tilting_chain, 7), 1e-9)


def test_gravity_gradient_satellite_has_every_attitude_with_its_axes_on_the_orbit_axes():
    """Away from pitch +-pi/2 the 24 attitudes are 16 triples: yaw and roll multiples of pi/2, pitch zero."""
    e = COPIES[BACKENDS[0]]
    certificate = enclose(e, satellite(e))
    quarters = [-PI / 2, 0.0, PI / 2, PI]
    assert certificate.certified
    assert_same_roots(certificate, [[yaw, 0.0, roll] for yaw in quarters for roll in quarters], 1e-13)


def test_a_curve_of_roots_is_undecided_but_the_regular_roots_are_still_proved():
    """At pitch +-pi/2 yaw and roll turn about one axis: curves of roots in the full cube of angles."""
    e = COPIES[BACKENDS[0]]
    certificate = enclose(e, satellite(e, pitch=2.0), max_boxes=8000)
    quarters = [-PI / 2, 0.0, PI / 2, PI]
    assert not certificate.certified
    assert certificate.covers()
    assert_same_roots(certificate, [[yaw, 0.0, roll] for yaw in quarters for roll in quarters], 1e-13)
    assert 0 < len(certificate.undecided) < 200
    for yaw in np.linspace(-3.0, 3.0, 25):  # a point of the curve at pitch +pi/2: roll - yaw = 0
        assert any(holds(box, (yaw, PI / 2, yaw)) for box in certificate.undecided)


def test_wilkinson_like_polynomial(e):
    certificate = enclose(e, PROBLEMS["wilkinson"](e))
    assert certificate.certified
    assert_same_roots(certificate, np.sort(np.roots(np.poly(range(1, 9))))[:, None], 1e-8)
    assert_same_roots(certificate, np.arange(1.0, 9.0)[:, None], 1e-11)


@pytest.mark.parametrize("gap", [Fraction(1, 10), Fraction(1, 1000)])
def test_clustered_roots_are_told_apart(e, gap):
    roots = [Fraction(1), 1 + gap, 1 + 2 * gap, Fraction(2), Fraction(-7, 3)]
    certificate = enclose(e, polynomial(e, expand(roots), [(-3.0, 3.0)]))
    assert certificate.certified
    for enclosed, exact in zip(certificate.roots, sorted(roots), strict=True):
        assert Fraction(enclosed[0][0]) <= exact <= Fraction(enclosed[0][1])
        assert enclosed[0][1] - enclosed[0][0] < 1e-13 / float(gap) ** 2


def test_roots_too_close_for_the_arithmetic_are_undecided(e):
    """Rounding alone moves roots of this polynomial that are 1e-5 apart by more than that."""
    roots = [Fraction(1), 1 + Fraction(1, 10**5), 1 + Fraction(2, 10**5), Fraction(2), Fraction(-7, 3)]
    certificate = enclose(e, polynomial(e, expand(roots), [(-3.0, 3.0)]), max_boxes=3000)
    assert not certificate.certified
    assert_same_roots(certificate, [[2.0], [-7 / 3]], 1e-13)
    assert len(certificate.undecided) <= 4
    for r in roots[:3]:
        assert any(holds(box, (r,)) for box in certificate.undecided)


def expand(roots) -> list[Fraction]:
    """Exact coefficients, from the highest power down, of the monic polynomial with these roots."""
    coefficients = [Fraction(1)]
    for r in roots:
        padded = [*coefficients, Fraction(0)]
        coefficients = [c - r * d for c, d in zip(padded, [Fraction(0), *coefficients], strict=True)]
    return coefficients


simple_roots = st.lists(
    st.fractions(min_value=-3, max_value=3, max_denominator=40), min_size=0, max_size=6, unique=True
)


@pytest.mark.parametrize("backend", BACKENDS)
@settings(max_examples=60, deadline=None)
@given(roots=simple_roots)
def test_polynomials_with_known_rational_roots(backend, roots):
    e = COPIES[backend]
    certificate = enclose(e, polynomial(e, expand([*roots, Fraction(10)]), [(-3.5, 3.5)]))
    assert certificate.certified
    assert len(certificate.roots) == len(roots)
    for enclosed, exact in zip(certificate.roots, sorted(roots), strict=True):
        assert Fraction(enclosed[0][0]) <= exact <= Fraction(enclosed[0][1])
    for box in certificate.accepted:
        assert sum(Fraction(box[0][0]) <= r <= Fraction(box[0][1]) for r in roots) == 1
    for box in certificate.rejected:
        assert not any(Fraction(box[0][0]) <= r <= Fraction(box[0][1]) for r in roots)


few_integers = st.lists(st.integers(-5, 5), min_size=1, max_size=3, unique=True)


@settings(max_examples=30, deadline=None)
@given(
    u_roots=few_integers,
    v_roots=few_integers,
    matrix=st.tuples(*[st.integers(-5, 5)] * 4),
    bend=st.sampled_from([Fraction(-1, 2), Fraction(0), Fraction(1, 4)]),
)
def test_planar_polynomial_systems_with_known_roots(u_roots, v_roots, matrix, bend):
    """Products of parabolas: in (u, v) = A (x, y + bend x^2) the roots form a grid, so they are exact."""
    e, (a, b, c, d) = COPIES[BACKENDS[0]], matrix
    assume(a * d - b * c != 0)

    def product(factors):
        value = e.ball(1)
        for factor in factors:
            value = value * factor
        return value

    def slope(variable, roots):
        value = e.ball(0)
        for k in range(len(roots)):
            value = value + product(variable - r for i, r in enumerate(roots) if i != k)
        return value

    def bent(x):
        y = x[1] + e.ball(bend) * e.square(x[0])
        return a * x[0] + b * y, c * x[0] + d * y

    def function(x):
        u, v = bent(x)
        return [product(u - r for r in u_roots), product(v - r for r in v_roots)]

    def jacobian(x):
        (u, v), y_slope = bent(x), 2 * e.ball(bend) * x[0]
        f, g = slope(u, u_roots), slope(v, v_roots)
        return [[f * (a + b * y_slope), f * b], [g * (c + d * y_slope), g * d]]

    exact = []
    for u, v in itertools.product(u_roots, v_roots):
        x, y = Fraction(d * u - b * v, a * d - b * c), Fraction(a * v - c * u, a * d - b * c)
        exact.append((x, y - bend * x**2))
    inside = [(x, y) for x, y in exact if abs(x) <= 4 and abs(y) <= 8]
    certificate = e.enclose(function, jacobian, [(-4.0, 4.0), (-8.0, 8.0)])
    assert certificate.certified
    assert len(certificate.roots) == len(inside)
    for point in inside:
        assert sum(holds(root, point) for root in certificate.roots) == 1
        assert sum(holds(box, point) for box in certificate.accepted) == 1
        assert not any(holds(box, point) for box in certificate.rejected)


# ------------------------------------------------------------ what a certificate claims


@pytest.mark.parametrize("name", PROBLEMS)
def test_every_accepted_box_is_needed_for_the_cover(e, name):
    certificate = enclose(e, PROBLEMS[name](e))
    assert certificate.certified
    for k in range(len(certificate.accepted)):
        remaining = certificate.accepted[:k] + certificate.accepted[k + 1 :]
        damaged = dataclasses.replace(certificate, accepted=remaining)
        assert not damaged.covers()
        assert not damaged.certified


def test_every_accepted_box_of_the_satellite_is_needed():
    e = COPIES[BACKENDS[0]]
    certificate = enclose(e, satellite(e))
    assert certificate.covers()
    for k in range(len(certificate.accepted)):
        remaining = certificate.accepted[:k] + certificate.accepted[k + 1 :]
        assert not dataclasses.replace(certificate, accepted=remaining).covers()


@pytest.mark.parametrize("name", PROBLEMS)
def test_random_points_lie_in_some_box_and_no_root_in_a_rejected_one(e, name):
    problem = PROBLEMS[name](e)
    certificate = enclose(e, problem)
    low, high = np.array(problem[2]).T
    boxes = [*certificate.accepted, *certificate.rejected]
    for point in np.random.default_rng(4).uniform(low, high, size=(300, len(low))):
        assert any(holds(box, point) for box in boxes)
    for point in certificate.points:
        assert not any(holds(box, point) for box in certificate.rejected)
        assert any(holds(box, point) for box in certificate.accepted)


def test_the_cover_check_sees_a_tiny_gap(e):
    region = ((0.0, 1.0), (0.0, 1.0))
    thirds = [((a / 3, (a + 1) / 3), (b / 3, (b + 1) / 3)) for a in range(3) for b in range(3)]
    whole = e.module.Certificate(region, region, accepted=(), rejected=tuple(thirds))
    assert whole.covers()
    for k in range(9):
        (x_low, x_high), y = thirds[k]
        shrunk = ((x_low, math.nextafter(x_high, 0.0)), y)
        gap = dataclasses.replace(whole, rejected=(*thirds[:k], shrunk, *thirds[k + 1 :]))
        assert not gap.covers()
    assert not e.module.Certificate(region, region, accepted=()).covers()


@pytest.mark.parametrize("name", PROBLEMS)
def test_enclosures_are_tight_and_sorted(e, name):
    certificate = enclose(e, PROBLEMS[name](e))
    widths = [high - low for root in certificate.roots for low, high in root]
    assert max(widths) < (1e-9 if name == "wilkinson" else 5e-14)
    assert certificate.points.tolist() == sorted(certificate.points.tolist())


def test_certificate_travels_and_speaks(e):
    certificate = enclose(e, snap_through(e))
    assert "3 roots, certified" in repr(certificate)
    assert certificate.region == ((-2.0, 2.0),)
    with pytest.raises(dataclasses.FrozenInstanceError):
        certificate.roots = ()
    values = {field.name: getattr(certificate, field.name) for field in dataclasses.fields(certificate)}
    twin = copy.deepcopy(Certificate(**values))  # needs what a worker process needs: no backend object inside
    assert twin.roots == certificate.roots
    assert twin.certified


# ------------------------------------------------------------ edges and cuts


def test_roots_on_both_edges_are_reported_exactly_there(e):
    certificate = enclose(e, PROBLEMS["edges"](e))
    assert certificate.certified
    assert certificate.points[[0, 2], 0].tolist() == [0.0, 2.0]
    assert_same_roots(certificate, [[0.0], [1.0], [2.0]], 1e-15)


@pytest.mark.parametrize("beyond", [1e-15, 3e-14])
def test_a_root_beyond_the_edge_by_rounding_counts_as_on_the_edge(e, beyond):
    certificate = enclose(e, polynomial(e, [1.0, -(1.0 + beyond)], [(0.0, 1.0)]))
    assert certificate.certified
    assert certificate.points.ravel().tolist() == [1.0]
    assert certificate.roots[0][0][0] <= 1.0 + beyond <= certificate.roots[0][0][1]


@pytest.mark.parametrize("beyond", [1e-11, 1e-6, 0.1])
def test_a_root_truly_beyond_the_edge_is_not_reported(e, beyond):
    for root in (-beyond, 1.0 + beyond):
        certificate = enclose(e, polynomial(e, [1.0, -root], [(0.0, 1.0)]))
        assert certificate.certified
        assert certificate.roots == ()


@pytest.mark.parametrize("shift", [0.0, 1e-15, -1e-15, 4e-13, -4e-13, 1e-9, -1e-9])
def test_a_root_near_the_seam_is_reported_once_and_in_range(e, shift):
    """sin(x - shift) in both unknowns: near the seam, and the corner of the torus, whatever rounding does."""

    def function(x):
        return [e.sin(x[0] - shift), e.sin(x[1] - shift)]

    def jacobian(x):
        return [[e.cos(x[0] - shift), 0], [0, e.cos(x[1] - shift)]]

    certificate = e.enclose(function, jacobian, [(-PI, PI)] * 2, periodic=(0, 1))
    assert certificate.certified
    assert len(certificate.roots) == 4
    assert (certificate.points > -PI).all()
    assert (certificate.points <= PI).all()
    turned = np.abs(np.sin(certificate.points - shift)).max()
    assert turned <= 1e-12


def test_roots_on_the_cuts_are_neither_lost_nor_doubled(e, monkeypatch):
    """With cuts in the middle of a symmetric region, 0 is a corner of many boxes and +-1 lie on faces."""
    monkeypatch.setattr(e.module, "CUT", 0.5)

    def function(x):
        return [x[0] * (e.square(x[0]) - 1), x[1] * (e.square(x[1]) - 1)]

    def jacobian(x):
        return [[3 * e.square(x[0]) - 1, 0], [0, 3 * e.square(x[1]) - 1]]

    certificate = e.enclose(function, jacobian, [(-4.0, 4.0)] * 2)
    assert certificate.certified
    assert_same_roots(certificate, list(itertools.product([-1.0, 0.0, 1.0], repeat=2)), 1e-15)
    for k in range(len(certificate.accepted)):
        remaining = certificate.accepted[:k] + certificate.accepted[k + 1 :]
        assert not dataclasses.replace(certificate, accepted=remaining).covers()


@pytest.mark.parametrize("offset", [0.0, 1e-16, -1e-16, 1e-12, -1e-12, 1e-8])
def test_a_root_at_or_beside_the_first_cut_is_found_once(e, offset):
    searched = e.enclose(lambda x: [x[0]], lambda x: [[1]], [(-3.0, 2.0)]).searched[0]
    cut = searched[0] + e.module.CUT * (searched[1] - searched[0]) + offset

    def function(x):
        return [(x[0] - cut) * (e.square(x[0] - cut) + 0.001)]

    certificate = e.enclose(function, lambda x: [[3 * e.square(x[0] - cut) + 0.001]], [(-3.0, 2.0)])
    assert certificate.certified
    assert_same_roots(certificate, [[cut]], 1e-14)


# ------------------------------------------------------------ degenerate and hostile equations


def test_a_quartic_potential_is_undecided_at_its_minimum(e):
    started = time.perf_counter()
    certificate = e.enclose(
        lambda x: [4 * e.power(x[0], 3)], lambda x: [[12 * e.square(x[0])]], [(-1.0, 1.3)]
    )
    assert time.perf_counter() - started < 1.0
    assert not certificate.certified
    assert certificate.roots == ()
    assert len(certificate.undecided) == 1
    ((low, high),) = certificate.undecided[0]
    assert low <= 0.0 <= high
    assert high - low < 1e-7
    assert certificate.covers()


def test_a_pitchfork_point_is_undecided_and_the_other_root_is_proved(e):
    """The governor at its critical speed: sin(x) (cos(x) - 1) has a triple root at 0, a simple one at pi."""

    def function(x):
        return [e.sin(x[0]) * (e.cos(x[0]) - 1)]

    certificate = e.enclose(
        function, lambda x: [[2 * e.square(e.cos(x[0])) - 1 - e.cos(x[0])]], [(-PI, PI)], periodic=(0,)
    )
    assert_same_roots(certificate, [[PI]], 1e-15)
    assert not certificate.certified
    assert any(holds(box, (0.0,)) for box in certificate.undecided)
    assert all(abs(bound) < 1e-3 for box in certificate.undecided for pair in box for bound in pair)


@pytest.mark.parametrize("lift", [-1e-10, 0.0, 1e-10])
def test_a_fold_has_two_roots_before_it_none_after_it_and_is_undecided_at_it(e, lift):
    certificate = e.enclose(lambda x: [e.square(x[0]) + lift], lambda x: [[2 * x[0]]], [(-1.0, 1.3)])
    if lift == 0.0:
        assert not certificate.certified
        assert any(holds(box, (0.0,)) for box in certificate.undecided)
    else:
        assert certificate.certified
        assert_same_roots(certificate, [[-1e-5], [1e-5]] if lift < 0 else np.empty((0, 1)), 1e-12)


def test_degenerate_in_three_unknowns(e):
    """V = x^4 + y^4 + z^2 has one degenerate minimum, given up long before the budget is spent."""

    def function(x):
        return [4 * e.power(x[0], 3), 4 * e.power(x[1], 3), 2 * x[2]]

    def jacobian(x):
        return [[12 * e.square(x[0]), 0, 0], [0, 12 * e.square(x[1]), 0], [0, 0, 2]]

    certificate = e.enclose(function, jacobian, [(-1.0, 1.3)] * 3)
    assert certificate.examined < 5000
    assert certificate.roots == ()
    assert len(certificate.undecided) <= 4
    assert any(holds(box, (0.0, 0.0, 0.0)) for box in certificate.undecided)
    assert certificate.covers()


@pytest.mark.parametrize("n", [1, 2, 3])
def test_equations_that_hold_everywhere_are_undecided_at_once(e, n):
    certificate = e.enclose(lambda x: [0 * v for v in x], lambda x: [[0] * n] * n, [(-1.0, 1.3)] * n)
    assert certificate.examined == 1
    assert certificate.undecided == (certificate.searched,)
    assert not certificate.certified


def test_equations_that_hold_everywhere_up_to_rounding_stop_at_the_limit():
    e = COPIES[BACKENDS[0]]

    def function(x):
        return [e.square(e.sin(v)) + e.square(e.cos(v)) - 1 for v in x]

    def jacobian(x):
        slopes = [2 * e.sin(v) * e.cos(v) - 2 * e.cos(v) * e.sin(v) for v in x]
        return [[slopes[0], 0], [0, slopes[1]]]

    certificate = e.enclose(function, jacobian, [(-1.0, 1.3)] * 2, max_boxes=3000)
    assert certificate.examined == 3000
    assert len(certificate.undecided) == 1
    assert certificate.roots == ()
    assert certificate.covers()


def test_an_isolated_root_inside_a_ring_of_roots_is_proved(e):
    def function(x):
        ring = e.square(x[0]) + e.square(x[1]) - 1
        return [x[0] * ring, x[1] * ring]

    def jacobian(x):
        ring = e.square(x[0]) + e.square(x[1]) - 1
        mixed = 2 * x[0] * x[1]
        return [[ring + 2 * e.square(x[0]), mixed], [mixed, ring + 2 * e.square(x[1])]]

    certificate = e.enclose(function, jacobian, [(-2.0, 2.1)] * 2, max_boxes=2000)
    assert_same_roots(certificate, [[0.0, 0.0]], 1e-15)
    assert not certificate.certified
    assert certificate.covers()
    assert len(certificate.undecided) < 100
    assert not any(holds(box, (0.0, 0.0)) for box in certificate.undecided)
    for angle in np.linspace(0.0, 2 * PI, 50):
        assert any(holds(box, (math.cos(angle), math.sin(angle)), 1e-15) for box in certificate.undecided)
    damaged = dataclasses.replace(certificate, accepted=())
    assert not damaged.covers()


def test_where_an_equation_is_not_defined_nothing_is_claimed(e):
    """sqrt(x) - 1 on [-1, 4]: the root is proved, everything left of zero is undecided."""
    certificate = e.enclose(
        lambda x: [e.sqrt(x[0]) - 1], lambda x: [[0.5 / e.sqrt(x[0])]], [(-1.0, 4.0)], max_boxes=400
    )
    assert_same_roots(certificate, [[1.0]], 1e-15)
    assert not certificate.certified
    assert certificate.covers()
    assert len(certificate.undecided) == 1
    assert holds(certificate.undecided[0], (-1.0,))
    assert holds(certificate.undecided[0], (0.0,))
    assert certificate.undecided[0][0][1] < 0.1


def test_a_pole_is_undecided_and_no_root(e):
    certificate = e.enclose(lambda x: [1 / x[0]], lambda x: [[-1 / e.square(x[0])]], [(-1.0, 1.5)])
    assert certificate.roots == ()
    assert [holds(box, (0.0,)) for box in certificate.undecided] == [True]
    assert certificate.undecided[0][0][1] - certificate.undecided[0][0][0] < 1e-7


def test_a_jump_through_zero_is_not_taken_for_a_root(e):
    """atan(1/x) jumps from -pi/2 to pi/2 at 0 although its derivative, -1/(1 + x^2), is smooth there."""
    certificate = e.enclose(
        lambda x: [e.atan(1 / x[0])], lambda x: [[-1 / (1 + e.square(x[0]))]], [(-1.0, 1.5)]
    )
    assert certificate.roots == ()
    assert not certificate.certified
    assert any(holds(box, (0.0,)) for box in certificate.undecided)


def test_equations_that_are_never_finite(e):
    undefined = 1 / e.ball(-1.0, 1.0)
    certificate = e.enclose(
        lambda x: [undefined] * 2, lambda x: [[undefined] * 2] * 2, [(0.0, 1.0)] * 2, max_boxes=500
    )
    assert certificate.roots == ()
    assert len(certificate.undecided) == 1
    assert certificate.covers()


def test_an_infinite_jacobian_at_a_root(e):
    """|x|^(3/2) sign(x) + ... = sqrt|x| x has the slope 0 and no second derivative at its root."""
    certificate = e.enclose(
        lambda x: [e.sqrt(e.fabs(x[0])) - 0.5],
        lambda x: [[0.5 * e.sign(x[0]) / e.sqrt(e.fabs(x[0]))]],
        [(-1.0, 1.2)],
    )
    assert certificate.certified
    assert_same_roots(certificate, [[-0.25], [0.25]], 1e-15)


def test_huge_values_do_not_break_the_search(e):
    certificate = e.enclose(
        lambda x: [e.exp(e.exp(20 * x[0])) - 3.0],
        lambda x: [[20 * e.exp(20 * x[0]) * e.exp(e.exp(20 * x[0]))]],
        [(-1.0, 1.0)],
        max_boxes=3000,
    )
    assert_same_roots(certificate, [[math.log(math.log(3.0)) / 20]], 1e-14)


# ------------------------------------------------------------ limits and units


def test_a_spent_budget_is_reported_not_hidden(e):
    certificate = enclose(e, hinged_pair(e), max_boxes=10)
    assert certificate.examined == 10
    assert not certificate.certified
    assert certificate.undecided
    assert certificate.covers()
    complete = enclose(e, hinged_pair(e))
    boxes = [*certificate.accepted, *certificate.undecided]
    assert all(any(holds(box, point) for box in boxes) for point in complete.points)


@pytest.mark.parametrize("unit", [1e-6, 1e6])
def test_the_unit_of_an_unknown_does_not_matter(e, unit):
    """The same spring arch in micrometers and megameters."""
    certificate = e.enclose(
        lambda x: [e.power(x[0] / unit, 3) - x[0] / unit],
        lambda x: [[(3 * e.square(x[0] / unit) - 1) / unit]],
        [(-2.0 * unit, 2.5 * unit)],
    )
    assert certificate.certified
    assert_same_roots(certificate, [[-unit], [0.0], [unit]], 1e-14 * unit)


def test_mixed_units_in_two_unknowns(e):
    """An angle in radians and a displacement in millimeters given in meters, stiffnesses far apart."""

    def function(x):
        return [1e-4 * e.sin(x[0]) - 0.05 * x[1], 2e6 * x[1] - 4e3 * e.sin(2 * x[0])]

    def jacobian(x):
        return [[1e-4 * e.cos(x[0]), -0.05], [-8e3 * e.cos(2 * x[0]), 2e6]]

    certificate = e.enclose(function, jacobian, [(-PI, PI), (-0.01, 0.01)], periodic=(0,))
    # x1 = 2e-3 sin(2 x0), so sin(x0) (1 - 2 cos(x0)) = 0 in units of 1e-4
    expected = [
        [0.0, 0.0],
        [PI, 0.0],
        [PI / 3, 2e-3 * math.sin(2 * PI / 3)],
        [-PI / 3, -2e-3 * math.sin(2 * PI / 3)],
    ]
    assert certificate.certified
    assert_same_roots(certificate, expected, 1e-14)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"region": [(1.0, 0.0)]}, "no extent"),
        ({"region": [(0.0, 0.0)]}, "no extent"),
        ({"region": [(0.0, math.inf)]}, "no extent"),
        ({"region": [(0.0, math.nan)]}, "no extent"),
        ({"region": [0.0, 1.0]}, "no box"),
        ({"region": []}, "0 unknowns"),
        ({"periodic": (1,)}, "periodic"),
        ({"max_boxes": 0}, "max_boxes"),
        ({"min_width": 0.0}, "min_width"),
        ({"function": lambda x: [x[0], x[0]]}, "2 values"),
        ({"jacobian": lambda x: [[1, 2]]}, "lengths"),
    ],
)
def test_arguments_that_make_no_sense_are_refused(e, changes, message):
    arguments = {
        "function": lambda x: [x[0]],
        "jacobian": lambda x: [[1]],
        "region": [(-1.0, 1.0)],
        **changes,
    }
    with pytest.raises(EngdynError, match=message):
        e.enclose(**arguments)


@pytest.mark.skipif(
    "flint" not in BACKENDS, reason="times are promised for the compiled backend: no python-flint"
)
@pytest.mark.parametrize(
    ("name", "limit"), [("governor", 0.05), ("hinged_pair", 0.2), ("tilting_chain", 0.5)]
)
def test_it_is_fast(name, limit):
    e = COPIES["flint"]
    times = []
    for _ in range(3):
        started = time.perf_counter()
        enclose(e, PROBLEMS[name](e))
        times.append(time.perf_counter() - started)
    assert min(times) < limit
