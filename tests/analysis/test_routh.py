"""Routh's table against roots known by construction, numpy's roots, published tables and formulas."""

from __future__ import annotations

import itertools
import math
import random
import re

import numpy as np
import pytest
import sympy as sm
from sympy.physics.mechanics import dynamicsymbols

import engdyn as ed
from engdyn.analysis.half_plane import right_half_plane

S = sm.Symbol("s")


def factor(kind, source):
    """An integer factor and the number of its roots in the right half plane."""
    a, b = source.randint(-4, 4), source.randint(1, 6)
    if kind == "real":
        return [1, -a], int(a > 0)
    if kind == "pair":
        return [1, -2 * a, a * a + b], 2 * (a > 0)
    return {
        "imaginary": ([1, 0, b], 0),
        "opposite": ([1, 0, -b], 1),
        "cross": ([1, 0, 0, 0, b], 2),
        "quadruple": ([1, 0, 2 * b, 0, b * b], 0),
        "origin": ([1, 0], 0),
    }[kind]


def polynomial(source, special):
    """Integer coefficients of degree 2 to 8, of roots known by construction, and how many of these are on the right.

    A zero first entry: the last real factor makes the sum of the roots zero. A zero row: a factor with roots
    symmetric about the origin.
    """
    wanted = source.randint(3, 8)
    found, count = np.array([source.choice([1, 1, -2, 3])], dtype=object), 0
    if special == "row":
        part, count = factor(source.choice(["imaginary", "opposite", "cross", "quadruple", "origin"]), source)
        found = np.convolve(found, part)
    while len(found) < wanted:
        part, more = factor(source.choice(["real", "pair"]), source)
        found, count = np.convolve(found, part), count + more
    if special == "entry":
        total = int(found[1] / found[0])
        found, count = np.convolve(found, [1, -total]), count + (total > 0)
    return [int(c) for c in found], count


@pytest.mark.parametrize(("special", "mark"), [("", None), ("entry", "epsilon"), ("row", "auxiliary")])
def test_right_half_plane_of_random_polynomials(special, mark):
    source, marked, compared = random.Random(f"routh {special}"), 0, 0
    for _ in range(400):
        coefficients, count = polynomial(source, special)
        table = ed.routh_table(coefficients)
        assert table.right_half_plane == count, coefficients
        assert table.sign_changes == count, coefficients
        assert len(table.rows) == len(coefficients)
        marked += mark in table.marks
        roots = np.roots(coefficients)
        if abs(roots.real).min() > 0.1:  # numpy tells the sides apart, multiple roots included
            compared += 1
            assert int(np.sum(roots.real > 0)) == count
        assert (table.conditions == ()) == (count == 0 and mark is None and roots.real.max() < -0.1)
    assert special != "row" or marked == 400
    assert special != "entry" or marked > 250  # the others are even or odd, or have a zero row first
    assert special == "row" or compared > 250


@pytest.mark.parametrize("degree", range(2, 9))
def test_any_integer_coefficients_against_numpy(degree):
    source = random.Random(degree)
    for _ in range(40):
        coefficients = [1, *(source.choice([-2, -1, 0, 0, 1, 1, 2, 3]) for _ in range(degree))]
        roots = np.roots(coefficients)
        if abs(roots.real).min() > 1e-3:
            assert ed.routh_table(coefficients).right_half_plane == np.sum(roots.real > 0), coefficients


# ---------------------------------------------------------------- special cases (pitfall 15)


def test_zero_first_entry_is_never_stable():
    table = ed.routh_table([1, 1, 2, 2, 3])
    roots = np.roots([1, 1, 2, 2, 3])
    np.testing.assert_allclose(max(roots, key=lambda r: (r.real, r.imag)), 0.406 + 1.293j, atol=5e-4)
    assert (table.right_half_plane, table.sign_changes) == (2, 2)
    assert table.marks == ("", "", "epsilon", "", "")
    epsilon = sm.Symbol("epsilon")
    assert table.first_column[2] == epsilon
    assert sm.expand(table.first_column[3] - (2 - 3 / epsilon)) == 0
    assert "row of s² began with zero" in table.special


def test_zero_row_is_marginal_with_its_imaginary_pair():
    table = ed.routh_table([1, 1, 4, 4])
    assert table.rows == ((1, 4), (1, 4), (2, 0), (4, 0))
    assert (table.right_half_plane, table.verdict) == (0, "marginal: roots on the imaginary axis")
    assert "s² + 4" in table.special
    assert "2 imaginary" in table.special


@pytest.mark.parametrize(
    ("coefficients", "count", "words"),
    [
        ([1, 0, 2, 0, 1], 0, "4 imaginary"),  # (s² + 1)²: two zero rows
        ([1, 0, 0, 0, 1], 2, "2 on the right and as many on the left"),
        ([1, 0, -1], 1, "1 on the right"),
        ([1, 2, 0, -2, -1], 1, "1 on the right"),  # (s² − 1)(s + 1)²
        ([1, 1, 3, 3, 3, 2, 1], 2, "2 imaginary"),  # Gantmacher: zero entry and zero row
        ([1, 1, 1, 0], 0, "1 zero"),
        ([1, 0, 0], 0, "2 zero"),
        ([3], 0, ""),
        ([2, 0], 0, "1 zero"),
        ([-1, 2], 1, ""),
    ],
)
def test_special_polynomials(coefficients, count, words):
    table = ed.routh_table(coefficients)
    assert (table.right_half_plane, table.sign_changes) == (count, count)
    assert words in table.special
    assert bool(table.special) == bool(words)


def test_a_second_epsilon_must_be_smaller_than_the_first():
    """s⁹ − s² − 1: with one and the same ε in all places the signs count wrong."""
    coefficients = [1, 0, 0, 0, 0, 0, 0, -1, 0, -1]
    expected = int(np.sum(np.roots(coefficients).real > 0))
    assert abs(np.roots(coefficients).real).min() > 0.05
    table = ed.routh_table(coefficients)
    assert table.sign_changes == table.right_half_plane == expected
    assert table.marks.count("epsilon") > 1


def test_floats_are_their_decimals_and_zero_is_zero():
    """The row is zero, which floats would not see."""
    assert 0.1 * 0.7 != 0.07
    table = ed.routh_table([1, 0.1, 0.7, 0.07])
    assert table.marks == ("", "", "auxiliary", "")
    assert table.rows[1] == (sm.Rational(1, 10), sm.Rational(7, 100))


def test_the_leading_sign_does_not_matter():
    coefficients = [2, 3, 4, 5, 1]
    table, negative = ed.routh_table(coefficients), ed.routh_table([-c for c in coefficients])
    assert (negative.first_column, negative.conditions) == (table.first_column, table.conditions)


@pytest.mark.parametrize(
    ("coefficients", "message"),
    [
        ([], "empty"),
        ([0, 1, 2], "first coefficient is zero"),
        ("123", "give a sequence"),
        (5, "give a sequence"),
        ([1, "2"], "not text"),
        ([1, float("nan")], "no real number"),
        ([1, math.inf], "no real number"),
        ([1, 2j], "no real number"),
        ([1, sm.sqrt(2)], "no rational number"),
        ([1, sm.pi], "no rational number"),
        ([1, sm.sqrt(2) * S], "no rational number"),
        ([1, sm.sin(S)], "no rational number"),
    ],
)
def test_what_is_no_polynomial_is_refused(coefficients, message):
    with pytest.raises(ed.EngdynError, match=message):
        ed.routh_table(coefficients)


# ---------------------------------------------------------------- published tables and formulas


@pytest.mark.parametrize("last", [4242.16, -4242.16])
def test_bar_on_a_slider(last):
    """W7: the hanging and the inverted equilibrium."""
    table = ed.routh_table([1, 2.45045, 216.115, 114.494, last])
    column = [float(x) for x in table.first_column]
    if last > 0:
        np.testing.assert_allclose(column, [1, 2.45045, 169.392, 53.126, 4242.16], rtol=1e-5)
    assert (column[-1], table.right_half_plane) == (last, 0 if last > 0 else 1)


def test_conditions_of_cubic_and_quartic():
    """A. Hurwitz' conditions, with all coefficients positive."""
    a = sm.symbols("a_0:5", positive=True)
    assert ed.routh_table(a[:3]).conditions == ()
    (cubic,) = ed.routh_table(a[:4]).conditions
    assert sm.expand(cubic - (a[1] * a[2] - a[0] * a[3])) == 0
    first, second = ed.routh_table(a).conditions
    assert sm.expand(first - (a[1] * a[2] - a[0] * a[3])) == 0
    assert sm.expand(second - (a[3] * (a[1] * a[2] - a[0] * a[3]) - a[1] ** 2 * a[4])) == 0


def test_conditions_of_symbols_of_any_sign():
    a = sm.symbols("a_0:4")
    conditions = ed.routh_table(a).conditions
    assert {sm.expand(c) for c in conditions} == {a[0], a[1], a[1] * a[2] - a[0] * a[3], a[3]}
    assert ed.routh_table(a).right_half_plane is None


@pytest.mark.parametrize("size", [3, 4, 5, 6])
def test_conditions_decide_as_the_numbers_do(size):
    """Symbolic conditions, numbers put in, against numpy's roots."""
    a, source = sm.symbols(f"a_0:{size}"), random.Random(size)
    conditions = sm.lambdify(a, ed.routh_table(a).conditions)
    verdicts = set()
    for _ in range(400):
        numbers = [source.randint(1, 9) for _ in a]
        largest = np.roots(numbers).real.max()
        if abs(largest) > 1e-6:
            verdicts.add(largest < 0)
            assert all(c > 0 for c in conditions(*numbers)) == (largest < 0)
    assert verdicts == ({True} if size == 3 else {True, False})


def test_gain_of_a_loop():
    """s³ + 6 s² + 11 s + 6 + K: stable for −6 < K < 60 (any textbook of control)."""
    K = sm.Symbol("K")
    assert set(ed.routh_table([1, 6, 11, K + 6]).conditions) == {60 - K, K + 6}
    low, high = ed.routh_limits([1, 6, 11, 6 + K], K)
    assert (low, high) == (-6, 60)
    assert (low.kind, high.kind) == ("divergence", "flutter")
    assert (low.before, low.after, high.before, high.after) == (1, 0, 0, 2)
    np.testing.assert_allclose(high.frequency, math.sqrt(11) / (2 * math.pi), rtol=1e-14)


def test_symbols_that_make_a_zero_row_are_never_asymptotically_stable():
    m, k, c = sm.symbols("m k c", positive=True)
    for coefficients in ([m, 0, k], [1, c, k, c * k], [1, c, 2, 2 * c, 3]):
        table = ed.routh_table(coefficients)
        assert table.conditions == (0,)
        assert table.verdict == "never asymptotically stable"


# ---------------------------------------------------------------- shown in a notebook


def test_table_shows_each_step():
    html = ed.routh_table([1, 2.45045, 216.115, 114.494, 4242.16])._repr_html_()
    assert "Stable (0 sign changes in the first column)" in html
    powers = re.findall(r"<th>s<sup>(\d)</sup></th>", html)
    assert powers == ["4", "3", "2", "1", "0"]
    assert "(2.4504 · 216.12 − 1 · 114.49)/2.4504" in html.replace("2.4505", "2.4504")
    assert "<img" not in html
    assert max(len(x) for x in re.findall(r"\d*\.(\d+)", html)) <= 5


def test_table_marks_what_is_special():
    html = ed.routh_table([1, 0, 0, 0, 1])._repr_html_()
    assert html.count("background") == 2
    assert "was zero: derivative of the row above" in html
    assert "began with 0: ε in its place" in html
    signs = re.findall(r"<td>([+−])</td><td>[^<]*</td></tr>", html)
    assert signs == ["+", "+", "+", "−", "+"]
    assert repr(ed.routh_table([1, 1, 4, 4])).startswith("RouthTable(marginal")


# ---------------------------------------------------------------- limits of stability


def test_limits_without_damping_are_where_pairs_meet():
    """(λ² + 1)(λ² + 4) coupled by ±p: frequencies coalesce at p = 3/2 (discriminant zero)."""
    p = sm.Symbol("p")
    (limit,) = ed.routh_limits([1, 0, 5, 0, 4 + p**2], p, (0, 10))
    assert (limit, limit.kind, limit.before, limit.after) == (1.5, "flutter", 0, 2)
    np.testing.assert_allclose(limit.frequency, math.sqrt(2.5) / (2 * math.pi), rtol=1e-14)


def test_limits_of_one_degree_of_freedom():
    m, c, k = sm.symbols("m c k")
    (limit,) = ed.routh_limits([2, c, 8], "c")
    assert (limit, limit.kind) == (0, "flutter")
    np.testing.assert_allclose(limit.frequency, 1 / math.pi, rtol=1e-14)
    (limit,) = ed.routh_limits([2, 1, k, 0], k)  # a neutral eigenvalue apart
    assert (limit, limit.kind, limit.frequency, limit.before, limit.after) == (0, "divergence", 0, 1, 0)
    (limit,) = ed.routh_limits([m, 1, 1], m)
    assert (limit, limit.kind) == (0, "leading coefficient")
    assert "0 (divergence; unstable roots 1 → 0)" in repr(ed.routh_limits([1, 1, k], k))


def test_roots_that_touch_the_axis_are_no_limit():
    """s² + p² s + 1 touches at p = 0 without crossing."""
    p = sm.Symbol("p")
    assert ed.routh_limits([1, p**2, 1], p) == ()
    (limit,) = ed.routh_limits([1, p**2 - sm.Rational(1, 10**8), 1], sm.Symbol("p"), (0, 1))
    np.testing.assert_allclose(limit, 1e-4, rtol=1e-15)


def test_limits_agree_with_counts_on_a_fine_grid():
    """Random quartics in one parameter: numpy's counts change at the limits and nowhere else."""
    source, p, found = random.Random(17), sm.Symbol("p"), 0
    for _ in range(12):
        coefficients = [1, *(source.randint(-3, 5) + source.randint(-3, 3) * p for _ in range(4))]
        limits = ed.routh_limits(coefficients, p, (-4, 4))
        edges, function = [-4.0, *limits, 4.0], sm.lambdify(p, coefficients)
        found += len(limits)
        for low, high in itertools.pairwise(edges):
            inside = low + (high - low) * np.linspace(0.01, 0.99, 41)
            counts = {int(np.sum(np.roots(function(at)).real > 0)) for at in inside}
            assert len(counts) == 1
        for limit in limits:
            before, after = (np.sum(np.roots(function(limit + h)).real > 0) for h in (-1e-6, 1e-6))
            assert (before, after) == (limit.before, limit.after)
            pairs = np.roots(function(float(limit)))
            nearest = pairs[np.argmin(abs(pairs.real))]
            np.testing.assert_allclose(2 * math.pi * limit.frequency, abs(nearest.imag), atol=1e-6)
    assert found > 15


@pytest.mark.parametrize(
    ("coefficients", "symbol", "interval", "message"),
    [
        ([1, S], "p", None, "must contain p"),
        ([1, 2], "p", None, "contain no symbols"),
        ([1, S * sm.Symbol("p")], "p", None, "contain p, s"),
        ([1, S], S, (2, 1), "lower end comes first"),
        ([1, S], S, 3, "give \\(lower, upper\\)"),
    ],
)
def test_limits_refuse_what_they_cannot_read(coefficients, symbol, interval, message):
    with pytest.raises(ed.EngdynError, match=message):
        ed.routh_limits(coefficients, symbol, interval)


# ---------------------------------------------------------------- characteristic polynomials


@pytest.mark.parametrize("number", [1, 3, 6, 7, 8, 9, 13, 14, 16, 18, 20, 22, 23])
def test_characteristic_polynomial_against_numpy(number):
    system = ed.systems.load(number)
    for equilibrium in list(system.equilibria())[:2]:
        linear = ed.linearize(system.equations, equilibrium)
        found = ed.characteristic_polynomial(linear)
        scale = np.max(abs(ed.eigenvalues(linear))) ** np.arange(len(found))
        expected = np.poly(linear.state_matrix)
        np.testing.assert_allclose(np.array(found, float) / scale, expected / scale, atol=1e-12)
        judged = ed.stability(linear)
        zeros = found[len(found) - judged.neutral :]
        assert all(c.is_Rational for c in found)
        assert zeros == (0,) * judged.neutral
        unstable = int(np.sum(judged.eigenvalues.real > 10 * judged.errors))
        assert ed.routh_table(found).right_half_plane == unstable


def test_castor_has_a_cubic():
    """S13, by hand: three states, and all coefficients positive where it shimmies (pitfall 16)."""
    system = ed.systems.load(13)
    linear = ed.linearize(system.equations, {}, symbolic=True)
    m_p, m, J_G, a, b, k_y, c_y, k_p, c_p, v = sm.symbols("m_p m J_G a b k_y c_y k_p c_p v")
    expected = [
        J_G + m * (a - b) ** 2 + m_p * a**2,
        a**2 * c_y + c_p + v * (m * (a - b) + m_p * a),
        a**2 * k_y + a * c_y * v + k_p,
        a * k_y * v,
    ]
    found = ed.characteristic_polynomial(linear)
    names = {s.name: s for c in found for s in c.free_symbols}
    ratio = expected[3].subs({s: names[s.name] for s in (a, k_y, v)}) / found[3]
    for ours, theirs in zip(found, expected, strict=True):
        assert sm.expand(ratio * ours - theirs.subs({s: names[s.name] for s in theirs.free_symbols})) == 0
    values = system.values(v=20.0)
    numbers = ed.characteristic_polynomial(ed.linearize(system.equations, {}, values))
    assert all(c > 0 for c in numbers)
    assert ed.routh_table(numbers).right_half_plane == 2
    np.testing.assert_allclose(
        max(np.roots(np.array(numbers, float)), key=lambda r: r.imag), 7.206 + 84.81j, rtol=1e-4
    )


def test_symbols_and_an_open_parameter_give_the_same_polynomial():
    for number, at in ((11, {}), (12, {}), (15, {})):
        system = ed.systems.load(number)
        values = {
            p.name: sm.Rational(repr(v))
            for p, v in zip(system.parameters, system.values().values(), strict=True)
        }
        name = {11: "P", 12: "U", 15: "Omega"}[number]
        opened = ed.characteristic_polynomial(ed.linearize(system.equations, at, system.values()), name)
        symbolic = ed.characteristic_polynomial(ed.linearize(system.equations, at, symbolic=True))
        numbers = [c.subs({s: values[s.name] for s in c.free_symbols if s.name != name}) for c in symbolic]
        for ours, theirs in zip(opened, numbers, strict=True):
            assert sm.cancel(ours * numbers[0] - theirs * opened[0]) == 0


def test_an_equilibrium_that_moves_is_refused():
    """S03: the arms of the governor swing out with its speed; hanging straight down they stay."""
    system = ed.systems.load(3)
    low, straight, _ = (ed.linearize(system.equations, e) for e in system.equilibria())
    with pytest.raises(ed.EngdynError, match="moves with Omega"):
        ed.characteristic_polynomial(low, "Omega")
    (limit,) = ed.routh_limits(ed.characteristic_polynomial(straight, "Omega"), "Omega", (0, 100))
    v = system.values()
    assert limit.kind == "divergence"
    branches = system.branches("Omega", (5.0, 30.0))
    (pitchfork,) = [p for p in branches.points if p.kind == "pitchfork"]
    np.testing.assert_allclose(limit, pitchfork.parameter, rtol=1e-9)
    assert v["Omega"] > limit


def test_a_parameter_that_moves_nothing_may_stay_open():
    """S03, arms swung out: friction at the pivot leaves the angle alone, though it is no rational number."""
    system = ed.systems.load(3)
    swung = ed.linearize(system.equations, system.equilibria()[-1])
    opened = ed.characteristic_polynomial(swung, "c_p")
    (c_p,) = {s for c in opened for s in c.free_symbols}
    numbers = [c.subs(c_p, sm.Rational(repr(system.values()["c_p"]))) for c in opened]
    np.testing.assert_allclose(
        np.array(numbers, float) / float(numbers[0]), np.poly(swung.state_matrix), rtol=1e-12
    )


def test_characteristic_polynomial_says_what_it_needs():
    system = ed.systems.load(11)
    linear = ed.linearize(system.equations, {}, system.values())
    with pytest.raises(ed.EngdynError, match="call linearize first"):
        ed.characteristic_polynomial(linear.state_matrix)
    with pytest.raises(ed.EngdynError, match="unknown parameter 'Q'"):
        ed.characteristic_polynomial(linear, "Q")
    with pytest.raises(ed.EngdynError, match="symbols for all parameters"):
        ed.characteristic_polynomial(ed.linearize(system.equations, {}, symbolic=True), "P")


def test_the_exact_count_alone():
    """The method that decides, on roots known by construction, with rational and repeated ones."""
    p = sm.Poly(
        (S - sm.Rational(1, 3)) ** 3 * (S**2 + 2) ** 2 * (S**2 - 5) ** 2 * S**2 * (S + 7), S, domain="QQ"
    )
    assert right_half_plane(p) == 3 + 2


def test_a_parameter_may_be_called_s_as_the_variable_is():
    """A clamp of stiffness s and damping s: m λ² + s λ + s, not a polynomial in one s for both."""
    x, (m, s) = dynamicsymbols("x"), sm.symbols("m s")
    eom = ed.lagrange(m * x.diff() ** 2 / 2, s * x**2 / 2, [x], s * x.diff() ** 2 / 2)
    assert ed.characteristic_polynomial(ed.linearize(eom, {}, symbolic=True)) == (m, s, s)
    numbers = ed.linearize(eom, {}, {"m": 2.0, "s": 3.0})
    kept = ed.characteristic_polynomial(numbers, "s")
    assert [c / kept[0] for c in kept] == [1, s / 2, s / 2]
    assert ed.routh_table([1, s, 2, 3]).conditions == (s, 2 * s - 3)
    (limit,) = ed.routh_limits([1, s, 2, 3], s)
    assert limit == 1.5
    assert math.isclose(limit.frequency, math.sqrt(2) / (2 * math.pi))


@pytest.mark.parametrize("assumed", [{}, {"positive": True}])
def test_a_symbol_named_as_the_small_number_is_refused(assumed):
    with pytest.raises(ed.EngdynError, match="symbol epsilon"):
        ed.routh_table([1, sm.Symbol("epsilon", **assumed), 2, 3])


@pytest.mark.parametrize("given", [{1, 2, 3}, {1: 2, 3: 4}])
def test_coefficients_without_an_order_are_refused(given):
    with pytest.raises(ed.EngdynError, match="give a sequence"):
        ed.routh_table(given)


def test_a_table_of_letters_that_would_fill_pages_is_refused_at_once():
    with pytest.raises(ed.EngdynError, match="thousands of terms"):
        ed.routh_table(sm.symbols("a_0:8", positive=True))
    assert len(ed.routh_table(sm.symbols("a_0:6", positive=True)).rows) == 6
