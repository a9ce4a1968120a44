"""Linear algebra over the ring against numerical linear algebra at many points."""

from __future__ import annotations

import mpmath
import numpy as np
import pytest
import sympy as sm
from hypothesis import given, settings
from hypothesis import strategies as st

from algebra.expressions import a, agree, b, elements, k, points, short, values, x, y
from engdyn.algebra.elimination import (
    determinant,
    eliminate,
    independent_columns,
    is_singular,
    primitive,
    solve,
)
from engdyn.algebra.readable import to_sympy, tree

s, c = sm.sin(x), sm.cos(x)
AT = points(3, seed=5)


def rows_of(matrix: list[list[sm.Expr]]):
    width = len(matrix[0])
    flat = elements(*(e for row in matrix for e in row))
    return [flat[i : i + width] for i in range(0, len(flat), width)]


def numbers(matrix: list[list[sm.Expr]], point: int) -> mpmath.matrix:
    with mpmath.workdps(40):
        return mpmath.matrix(
            [[values(sm.sympify(e), AT[point : point + 1])[0] for e in row] for row in matrix]
        )


def det3(m: mpmath.matrix) -> mpmath.mpf:
    """Sarrus' rule."""
    return sum(
        m[0, i] * (m[1, (i + 1) % 3] * m[2, (i + 2) % 3] - m[1, (i + 2) % 3] * m[2, (i + 1) % 3])
        for i in range(3)
    )


def entries(n: int, m: int):
    return st.lists(
        st.lists(st.one_of(st.just(sm.S.Zero), short), min_size=m, max_size=m), min_size=n, max_size=n
    )


@settings(max_examples=25)
@given(entries(3, 3))
def test_determinants(matrix):
    found = determinant(rows_of(matrix))
    expected = numbers(matrix, 0)
    with mpmath.workdps(40):
        reference = det3(expected)
        got = values(to_sympy(tree(found)), AT[:1])[0]
        assert abs(got - reference) < mpmath.mpf(10) ** -28 * (1 + mpmath.norm(expected) ** 3)
        assert is_singular(rows_of(matrix)) == (abs(reference) < mpmath.mpf(10) ** -25)


@settings(max_examples=6)
@given(entries(3, 4))
def test_solutions(matrix):
    rows = rows_of(matrix)
    found = solve(rows, 3)
    square = numbers([row[:3] for row in matrix], 1)
    with mpmath.workdps(40):
        regular = abs(det3(square)) > mpmath.mpf(10) ** -20
        assert (found is not None) == regular
        if found is not None:
            unknowns = [values(to_sympy(tree(e)), AT[1:2])[0] for e in found]
            right = numbers([[row[3]] for row in matrix], 1)
            residual = square * mpmath.matrix(unknowns) + right
            assert mpmath.norm(residual) < mpmath.mpf(10) ** -20 * (
                1 + mpmath.norm(square) * mpmath.norm(unknowns)
            )


def test_elimination_leaves_combinations_of_the_rows():
    matrix = [[c, s, a], [s, -c, x], [k, y, b], [1, c, s]]
    done = eliminate(rows_of(matrix), 1)
    assert [column for column, _ in done.pivots] == [0]
    assert done.missing == []
    assert len(done.remaining) == 3
    for point in range(3):
        original = numbers(matrix, point)
        for _, row in done.remaining:
            left = numbers([[to_sympy(tree(e)) for e in row]], point)
            assert abs(left[0, 0]) < 1e-30
            stacked = np.array([[float(v) for v in (*left,)], *np.array(original.tolist(), dtype=float)])
            assert np.linalg.matrix_rank(stacked, tol=1e-9) == 3


def test_dependent_columns_are_named():
    rows = rows_of([[s, 2 * s, 1], [c, 2 * c, x], [a, 2 * a, y]])
    assert eliminate(rows, 2).missing == [1]
    assert not independent_columns(rows, 2)
    assert independent_columns(rows, 1)
    assert independent_columns(rows, 0)
    assert solve(rows, 2) is None


@pytest.mark.parametrize(
    ("matrix", "singular"),
    [
        ([[c, s], [-s, c]], False),
        ([[c, s], [c * s, s**2]], True),
        ([[c, 1 - c**2], [1, s * sm.tan(x)]], True),
        ([[sm.cos(2 * x), c**2], [1, sm.Rational(1, 2)]], False),
        ([[sm.cos(2 * x) + 1, c**2], [2, 1]], True),
        ([[sm.sqrt(1 + x**2), 1 + x**2], [1, sm.sqrt(x**2 + 1)]], True),
        ([[sm.sqrt(1 + x**2), 1], [1, sm.sqrt(x**2 + 2)]], False),
        ([[sm.S.Zero]], True),
        ([[x - x + a]], False),
        ([[1 / (1 + c), 1], [1 - c, s**2]], True),
    ],
)
def test_singular_matrices(matrix, singular):
    assert is_singular(rows_of([[sm.sympify(e) for e in row] for row in matrix])) == singular
    values_there = [mpmath.det(numbers(matrix, i)) for i in range(3)]
    assert all(abs(v) < 1e-25 for v in values_there) == singular


def test_common_factors_of_a_row_are_cancelled():
    (row,) = rows_of([[a * s * (1 + x), a * (1 - c**2), a * s * c / b]])
    short_row = primitive(row)
    assert [to_sympy(tree(e)) for e in short_row] == [b * (x + 1), b * s, c]
    (row,) = rows_of([[s * x, c]])
    assert all(p.equals(q) for p, q in zip(primitive(row), row, strict=True))
    (row,) = rows_of([[sm.S.Zero, s**2 * a, sm.S.Zero]])
    assert [to_sympy(tree(e)) for e in primitive(row)] == [0, 1, 0]


@pytest.mark.parametrize("root", [s, sm.sqrt(1 + x**2), sm.Abs(x + a)], ids=str)
def test_denominators_with_sines_and_roots_are_cleared(root):
    """(1 + g)/g times g is (g + g^2)/g: with g^2 replaced, no common factor is left to see."""
    (row,) = rows_of([[(1 + root) / root, k / (2 + root), x]])
    cleared = primitive(row)
    assert all(e.denominator is None for e in cleared)
    first, second, third = (to_sympy(tree(e)) for e in cleared)
    assert agree(first * k * root, second * (1 + root) * (2 + root))
    assert agree(first * x * root, third * (1 + root))


@pytest.mark.parametrize("root", [s, sm.sqrt(1 + x**2), sm.Abs(x + a)], ids=str)
def test_sums_of_quotients_by_powers_of_a_root_do_not_grow(root):
    total = elements(*(k / root**i for i in range(1, 7)))
    summed = total[0]
    for term in total[1:]:
        summed = summed + term
    assert agree(to_sympy(tree(summed)), sum(k / root**i for i in range(1, 7)))
    assert max(summed.ring.polynomials.degrees(summed.denominator)) <= 6
    assert all(summed.ring.polynomials.degrees(summed.denominator)[i] == 0 for i in summed.ring.squares)


def test_a_common_sine_does_not_survive_elimination():
    """x cos + N sin = 0 and x' sin + N (1 - cos^2) = 0: without N the sine must be gone, too."""
    matrix = [[s, c, a], [1 - c**2, s * x, s * k]]
    ((_, row),) = eliminate(rows_of(matrix), 1).remaining
    assert agree(to_sympy(tree(row[1])) * (k - a), to_sympy(tree(row[2])) * (x - c))
    assert abs(to_sympy(tree(row[1])).subs(x, 0)) == 1
