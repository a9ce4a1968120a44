"""The exercises of chapter 4: truth against independent computations, and a hint for every known mistake."""

from __future__ import annotations

import math
import re
from pathlib import Path

import nbformat
import numpy as np
import pytest
import sympy as sm
from scipy.optimize import brentq, fsolve, minimize_scalar

import engdyn as ed
from engdyn.course.checking import check
from engdyn.course.registry import exercise, exercises

CHAPTER = [item for item in exercises() if item.chapter == 4]
STUDENTS = [None, *(f"student{n}" for n in range(10))]
EACH = pytest.mark.parametrize("item", CHAPTER, ids=lambda item: item.id)
STUDENT = pytest.mark.parametrize("student", STUDENTS)


def value(item, student):
    """The solution of an expression exercise as a number."""
    numbers = item.case(student).values
    expr = item.solution(student)
    return float(expr.subs({s: numbers[s.name] for s in expr.free_symbols}))


# Every exercise


def test_the_chapter_has_what_the_curriculum_asks_for():
    assert {item.number for item in CHAPTER} >= {"4.3", "4.7", "4.13", "4.14", "4.15"}
    assert {item.kind for item in CHAPTER} == {"expression", "equations", "number", "set", "choice"}
    for number in ("4.3", "4.7", "4.13", "4.14", "4.15"):
        assert 10 <= sum(item.minutes for item in CHAPTER if item.number == number) <= 30


@EACH
def test_an_exercise_describes_itself(item):
    assert item.prompt_title
    assert re.fullmatch(r"4\.[1-4]", item.needs)
    assert 5 <= item.minutes <= 20
    assert item.difficulty in (1, 2, 3)
    assert item.id in repr(item)
    assert list(item.systems) == ([f"S{item.system.number:02d}"] if item.system.number else [])


@EACH
@STUDENT
def test_the_solution_is_right_for_every_student(item, student):
    assert check(item.id, item.solution(student), student)


@EACH
@STUDENT
def test_every_known_mistake_gets_its_own_hint(item, student):
    mistakes = item.mistakes(student)
    assert len(mistakes) >= 4
    assert len(set(mistakes.values())) == len(mistakes), "two mistakes share a hint"
    for wrong, hint in mistakes.items():
        verdict = check(item.id, wrong, student)
        assert not verdict.right, wrong
        assert verdict.hint == hint, wrong


def bare(text):
    return re.sub(r"[\s()]", "", str(text)).replace("**", "^")


@EACH
@STUDENT
def test_no_hint_gives_the_solution_away(item, student):
    truth = item.solution(student)
    secrets = []
    if item.kind == "expression":
        secrets = [bare(truth), bare(sm.factor(truth)), f"{value(item, student):.3g}"]
    elif item.kind == "number":
        secrets = [f"{truth:.3g}", f"{abs(truth):.3g}", f"{math.degrees(abs(truth)):.3g}"]
    elif item.kind == "set":
        secrets = [f"{abs(root):.3g}" for root in truth if abs(root) > 1e-9]
    elif item.kind == "equations":
        secrets = [bare(term) for row in truth for term in sm.Add.make_args(sm.expand(row))]
    elif item.kind == "choice":
        secrets = [truth, f"statement {truth[0]}", f"({truth[0]})"]
    for hint in item.mistakes(student).values():
        words = bare(hint) if item.kind in ("expression", "equations") else hint
        for secret in secrets:
            assert secret not in words, (secret, hint)


@EACH
def test_hints_are_whole_sentences(item):
    for hint in item.mistakes().values():
        assert hint[0].isupper() or hint.startswith(("theta", "sin", "x ")), hint
        assert hint.endswith((".", "?")), hint
        assert 25 <= len(hint) <= 200, hint


@STUDENT
def test_mistaken_numbers_lie_outside_the_tolerance_for_every_student(student):
    item = exercise("4.7")
    truth = item.solution(student)
    for wrong in item.mistakes(student):
        assert abs(wrong / truth - 1) > 0.002


# 4.3: against a numeric search in the effective potential


def effective_potential(v):
    def potential(theta):
        weight = -2 * (v["m"] + v["M_c"]) * v["g"] * v["l"] * np.cos(theta)
        spring = v["k"] / 2 * (2 * v["l"] * (1 - np.cos(theta))) ** 2
        return weight + spring - v["m"] * (v["Omega"] * v["l"] * np.sin(theta)) ** 2

    return potential


@STUDENT
def test_the_raised_governor_is_the_minimum_of_the_effective_potential(student):
    v = exercise("4.3").case(student).values
    found = minimize_scalar(
        effective_potential(v), bounds=(0.01, 1.57), method="bounded", options={"xatol": 1e-10}
    )
    assert np.cos(found.x) == pytest.approx(value(exercise("4.3"), student), rel=1e-6)
    assert student or found.x == pytest.approx(0.77269, abs=1e-5)  # the governor of the catalogue
    roots = exercise("4.3c").solution(student)
    assert roots == pytest.approx((-found.x, 0.0, found.x), abs=1e-5)


@STUDENT
def test_the_critical_speed_is_where_the_bottom_of_the_potential_turns_flat(student):
    v = exercise("4.3b").case(student).values

    def curvature(Omega):
        potential, h = effective_potential({**v, "Omega": Omega}), 1e-3
        return potential(h) - 2 * potential(0.0) + potential(-h)

    assert brentq(curvature, 1.0, 100.0) == pytest.approx(value(exercise("4.3b"), student), rel=1e-5)


# 4.7


@STUDENT
def test_the_container_hangs_where_its_moment_about_the_hinge_vanishes(student):
    v = exercise("4.7").case(student).values
    a = 3700 / (v["M_t"] + v["m"])
    angle = brentq(lambda theta: v["m"] * v["L"] * (a * np.cos(theta) + v["g"] * np.sin(theta)), -1, 1)
    assert exercise("4.7").solution(student) == pytest.approx(angle, rel=1e-9)
    assert student or angle == pytest.approx(-0.101586, abs=5e-7)


# 4.13: against the exact nonlinear statics


def half_car_statics(v):
    def residuals(place):
        z, theta, zf, zr = place
        front = v["k_f"] * (z + v["a"] * np.sin(theta) - zf)
        rear = v["k_r"] * (z - v["b"] * np.sin(theta) - zr)
        return [
            front + rear + v["m_s"] * v["g"],
            (v["a"] * front - v["b"] * rear) * np.cos(theta),
            v["k_tf"] * zf - front + v["m_f"] * v["g"],
            v["k_tr"] * zr - rear + v["m_r"] * v["g"],
        ]

    return residuals


@STUDENT
def test_the_half_car_at_rest(student):
    v = exercise("4.13").case(student).values
    _, theta, zf, _ = fsolve(half_car_statics(v), [-0.2, 0, 0, 0], xtol=1e-13)
    assert value(exercise("4.13"), student) == pytest.approx(-v["k_tf"] * zf, rel=1e-9)
    assert value(exercise("4.13b"), student) == pytest.approx(np.sin(theta), rel=1e-7, abs=1e-12)


def test_the_half_car_of_the_catalogue():
    assert value(exercise("4.13b"), None) == pytest.approx(math.sin(-0.015372), abs=5e-7)


# 4.14: against the potential energy, written here once more


def lamp_potential(v):
    def potential(theta):
        eye = v["d"] * np.array([-np.sin(theta), np.cos(theta)])
        length = np.hypot(*(eye - np.array([0.0, v["h"]])))
        return v["m"] * v["g"] * v["l"] * np.cos(theta) + v["k"] / 2 * (length - v["L_0"]) ** 2

    return potential


@STUDENT
def test_the_lamp_rests_where_its_potential_is_stationary(student):
    v = exercise("4.14").case(student).values
    potential = lamp_potential(v)

    def slope(theta, h=1e-5):
        return (potential(theta + h) - potential(theta - h)) / (2 * h)

    grid = np.linspace(-3.1, 3.3, 400)
    slopes = [slope(x) for x in grid]
    changes = [i for i in range(len(grid) - 1) if slopes[i] * slopes[i + 1] < 0]
    found = [brentq(slope, grid[i], grid[i + 1]) for i in changes]
    assert exercise("4.14b").solution(student) == pytest.approx(found, abs=1e-6)


@STUDENT
def test_the_lamps_equation_of_motion_has_that_potential(student):
    (row,) = exercise("4.14").solution(student)
    v = exercise("4.14").case(student).values
    theta = exercise("4.14").system.coordinates[0].symbol
    t = sm.Symbol("t")
    angle, rate, acceleration = 0.7, 1.1, -0.4
    numbers = {theta.diff(t, 2): acceleration, theta.diff(t): rate, theta: angle}
    left = row.subs(numbers).subs({s: v[s.name] for s in row.free_symbols if s.name in v})
    slope = (lamp_potential(v)(angle + 1e-6) - lamp_potential(v)(angle - 1e-6)) / 2e-6
    assert float(left) == pytest.approx(v["m"] * v["l"] ** 2 * acceleration + v["c"] * rate + slope, rel=1e-6)


@STUDENT
def test_a_stiffer_spring_than_the_critical_one_leaves_two_equilibria(student):
    item = exercise("4.14c")
    v, critical = item.case(student).values, value(item, student)
    counts = [len(item.system.equilibria({**v, "k": factor * critical})) for factor in (0.98, 1.02)]
    assert counts[0] >= 4
    assert len(exercise("4.14b").question.solution(item.case(student).at(k=0.98 * critical))) == 4
    assert len(exercise("4.14b").question.solution(item.case(student).at(k=1.02 * critical))) == 2


# 4.15


@STUDENT
def test_the_armature_rests_where_both_forces_are_equal(student):
    v = exercise("4.15").case(student).values

    def difference(x):
        return v["k"] * x - v["C"] * v["i"] ** 2 / (v["d"] - x) ** 2

    third = v["d"] / 3
    found = [brentq(difference, 0, third, xtol=1e-15), brentq(difference, third, 0.999 * v["d"], xtol=1e-15)]
    assert exercise("4.15b").solution(student) == pytest.approx(found, rel=1e-9)


@STUDENT
def test_the_pull_in_current_is_the_largest_that_an_armature_can_bear(student):
    v = exercise("4.15c").case(student).values
    best = minimize_scalar(
        lambda x: -v["k"] * x * (v["d"] - x) ** 2 / v["C"],
        bounds=(0, v["d"]),
        method="bounded",
        options={"xatol": 1e-12},
    )
    assert value(exercise("4.15c"), student) == pytest.approx(math.sqrt(-best.fun), rel=1e-7)
    assert best.x == pytest.approx(v["d"] / 3, rel=1e-4)


@pytest.mark.parametrize("id", ["4.14", "4.15"])
def test_own_systems_draw_themselves_and_are_not_in_the_catalogue(id):
    system = exercise(id).system
    assert system.number is None
    assert system.key not in set(ed.systems.catalogue()["key"])
    words = " ".join(getattr(s, "label", "") or getattr(s, "text", "") for s in system.shapes([0.002]))
    for parameter in system.parameters:
        assert parameter.name in words.replace("\\", ""), parameter.name


# The notebook and the bank belong together

SOLUTIONS = Path(__file__).resolve().parents[2] / "solutions" / "04_equilibrium.ipynb"


def test_the_notebook_asks_and_checks_every_exercise_once():
    cells = nbformat.read(SOLUTIONS, as_version=4).cells
    tags = [tag for cell in cells for tag in cell.metadata.get("tags", ())]
    for item in CHAPTER:
        assert tags.count(f"exercise-{item.id}") == 1
        assert tags.count(f"check-{item.id}") == 1
        (check_cell,) = (c for c in cells if f"check-{item.id}" in c.metadata.get("tags", ()))
        assert f'ed.course.check("{item.id}", ' in check_cell.source
        (output,) = check_cell.outputs
        assert output.data["text/plain"].startswith(f"Exercise {item.id}: right.")
    assert max(len(cell.source.split("\n")) for cell in cells if cell.cell_type == "code") <= 15


def test_the_notebook_holds_a_worked_solution_for_every_exercise():
    cells = nbformat.read(SOLUTIONS, as_version=4).cells
    worked = [
        c.source for c in cells if c.cell_type == "markdown" and "solution" in c.metadata.get("tags", ())
    ]
    assert len(worked) == len(CHAPTER)
    assert all(len(text.split()) > 30 for text in worked)
