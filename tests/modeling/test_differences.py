"""Which term of which equation is wrong: the answer that a student gets."""

from __future__ import annotations

from fractions import Fraction

import pytest
import sympy as sm
from sympy.physics.mechanics import dynamicsymbols

import engdyn as ed

t = dynamicsymbols._t
x, theta, F = dynamicsymbols("x theta F")
x_d, theta_d = x.diff(t), theta.diff(t)
x_dd, theta_dd = x.diff(t, 2), theta.diff(t, 2)
M, m, l, g, k, c = sm.symbols("M m l g k c", positive=True)
sin, cos = sm.sin, sm.cos

CART = [
    (M + m) * x_dd + m * l * cos(theta) * theta_dd - m * l * sin(theta) * theta_d**2 + k * x - F,
    m * l**2 * theta_dd + m * l * cos(theta) * x_dd + m * g * l * sin(theta) + c * theta_d,
]
RIGHT = ed.EquationsOfMotion.from_residuals(CART, [x, theta])


def found(*rows: sm.Expr) -> list[tuple]:
    proof = ed.prove_equal(ed.EquationsOfMotion.from_residuals(rows, [x, theta]), RIGHT)
    assert proof.verdict == "refuted"
    return [(d.equation, d.kind, d.term, d.factor) for d in proof.differences]


MISTAKES = {
    "missing spring": (0, -k * x, (1, "missing", k * x, None)),
    "missing weight": (1, -m * g * l * sin(theta), (2, "missing", m * g * l * sin(theta), None)),
    "sign of the centripetal term": (
        0,
        2 * m * l * sin(theta) * theta_d**2,
        (1, "sign", -m * l * sin(theta) * theta_d**2, Fraction(-1)),
    ),
    "half the inertia": (1, -m * l**2 * theta_dd / 2, (2, "factor", m * l**2 * theta_dd, Fraction(1, 2))),
    "gravity twice": (1, m * g * l * sin(theta), (2, "factor", m * g * l * sin(theta), Fraction(2))),
    "extra damping": (0, c * x_d, (1, "extra", c * x_d, None)),
    "coupling lost": (1, -m * l * cos(theta) * x_dd, (2, "missing", m * l * cos(theta) * x_dd, None)),
    "trolley mass lost": (0, -M * x_dd, (1, "missing", M * x_dd, None)),
    "input on the wrong side": (0, 2 * F, (1, "sign", -F, Fraction(-1))),
}


@pytest.mark.parametrize("name", MISTAKES)
def test_one_mistake_is_named(name):
    row, change, expected = MISTAKES[name]
    rows = list(CART)
    rows[row] += change
    assert found(*rows) == [expected]


def test_mistakes_are_named_in_scaled_and_reordered_rows():
    assert found(-3 * (CART[1] + c * theta_d), CART[0] / 7) == [(2, "factor", c * theta_d, Fraction(2))]


@pytest.mark.parametrize(
    "scale",
    [1 / (m * l**2), cos(theta), 1 / (m * l * cos(theta)), sm.sqrt(1 + theta**2), -sm.Rational(7, 3) * M],
    ids=str,
)
def test_rows_divided_by_masses_and_functions_are_compared_as_they_were(scale):
    """Students write theta'' = ..., the definition says m l^2 theta'' = ...: one mistake is still one."""
    assert found(CART[0], scale * (CART[1] - 2 * m * g * l * sin(theta))) == [
        (2, "sign", m * g * l * sin(theta), Fraction(-1))
    ]
    assert found(scale * (CART[0] - k * x), CART[1]) == [(1, "missing", k * x, None)]
    assert found(CART[0], scale * (CART[1] + m * l**2 * theta_dd)) == [
        (2, "factor", m * l**2 * theta_dd, Fraction(2))
    ]


def test_a_long_list_of_differences_is_cut_short():
    rows = [CART[0] + sum(sm.Symbol(f"p{i}") * theta**i * x_d**i for i in range(1, 15)), CART[1]]
    proof = ed.prove_equal(ed.EquationsOfMotion.from_residuals(rows, [x, theta]), RIGHT)
    assert len(proof.differences) == 14
    assert "and 6 more" in repr(proof)
    assert len(repr(proof).splitlines()) == 11


def test_two_mistakes_are_both_named():
    rows = found(CART[0] - 2 * k * x, CART[1] - c * theta_d)
    assert {(n, kind) for n, kind, *_ in rows} == {(1, "sign"), (2, "missing")}


def test_terms_with_the_same_fault_and_the_same_rates_are_one_difference():
    rows = found(CART[0] - M * x_dd - m * x_dd, CART[1] + m * l * cos(theta) * x_dd)
    assert rows == [
        (1, "missing", (M + m) * x_dd, None),
        (2, "factor", m * l * cos(theta) * x_dd, Fraction(2)),
    ]


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("missing spring", "equation 1 (x): the term k*x is missing"),
        ("extra damping", "equation 1 (x): the term c*x' should not be there"),
        ("input on the wrong side", "equation 1 (x): the term -F has the wrong sign"),
        ("half the inertia", "is multiplied by 1/2"),
        ("gravity twice", "is multiplied by 2 – twice as large as it should be: gravity counted twice"),
    ],
)
def test_differences_read_as_sentences(name, text):
    row, change, _ = MISTAKES[name]
    rows = list(CART)
    rows[row] += change
    proof = ed.prove_equal(ed.EquationsOfMotion.from_residuals(rows, [x, theta]), RIGHT)
    assert text in str(proof.differences[0])
    assert text in repr(proof)


def rows_touched(term: sm.Expr, part: str, coordinates) -> set[int]:
    """Equations, counted from 1, that a term of T, V or D enters: Lagrange's operator by sympy."""
    rates = [q.diff(t) for q in coordinates]
    operators = {
        "kinetic_energy": [
            term.diff(u).diff(t) - term.diff(q) for q, u in zip(coordinates, rates, strict=True)
        ],
        "potential_energy": [term.diff(q) for q in coordinates],
        "dissipation": [term.diff(u) for u in rates],
    }
    return {i for i, e in enumerate(operators[part], 1) if e.expand() != 0}


@pytest.mark.parametrize("key", ["S03", "S07", "S23"])
def test_differences_name_the_equations_that_a_term_enters(key):
    """Every term of the expanded energies, doubled: the equations named are those it enters, no others."""
    system = ed.systems.load(key)
    coordinates = [c.symbol for c in system.coordinates]
    right = system.newton()
    parts = ("kinetic_energy", "potential_energy", "dissipation")
    for part in parts:
        for term in sm.Add.make_args(sm.expand(getattr(system, part))):
            wrong = {name: getattr(system, name) for name in parts}
            wrong[part] += term
            eom = ed.lagrange(
                wrong["kinetic_energy"],
                wrong["potential_energy"],
                coordinates,
                wrong["dissipation"],
                system.generalized_forces,
            )
            proof = ed.prove_equal(eom, right)
            touched = rows_touched(term, part, coordinates)
            assert proof.verdict == ("refuted" if touched else "proved")
            assert {d.equation for d in proof.differences} == touched
