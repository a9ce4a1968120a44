"""Every student's own numbers: the same everywhere, near the defaults, and clear-cut."""

from __future__ import annotations

import os
import subprocess
import sys

import pytest

from engdyn.course.registry import exercise, exercises, variant
from engdyn.course.variants import ATTEMPTS, draw_values
from engdyn.errors import EngdynError

STUDENTS = [f"student{n}" for n in range(60)]
PINNED = {
    ("4.3", "ab123"): {"m": 1.25, "M_c": 2.51, "l": 0.25, "k": 237.0, "Omega": 17.4},
    ("4.14", "ab123"): {"m": 0.601, "l": 0.538, "k": 147.0},
    ("4.15", "12345"): {"k": 931.0, "d": 0.0104, "C": 3.46e-05, "i": 1.75},
}


@pytest.mark.parametrize(("id", "student"), PINNED)
def test_three_outcomes_that_must_never_change(id, student):
    values = variant(id, student)
    pinned = PINNED[id, student]
    assert {name: values[name] for name in pinned} == pinned
    assert {name: values[name] for name in values if name not in pinned} == {
        name: value for name, value in variant(id).items() if name not in pinned
    }


def test_another_process_with_another_hash_seed_draws_the_same():
    code = "import engdyn as ed; print(ed.course.variant('4.13', 'zoë'))"
    outputs = {
        subprocess.run(
            [sys.executable, "-c", code],
            env={**os.environ, "PYTHONHASHSEED": seed},
            capture_output=True,
            check=True,
        ).stdout
        for seed in ("0", "4711")
    }
    assert outputs == {f"{variant('4.13', 'zoë')}\n".encode()}


@pytest.mark.parametrize("item", exercises(), ids=lambda item: item.id)
def test_drawn_values_are_near_the_defaults_with_three_digits(item):
    defaults = item.system.values(**item.setup.fixed)
    assert variant(item.id) == defaults
    for student in STUDENTS:
        values = variant(item.id, student)
        assert list(values) == list(defaults)
        for name, value in values.items():
            if name not in item.setup.varied:
                assert value == defaults[name]
            else:
                assert 0.7995 <= value / defaults[name] <= 1.2005
                assert float(f"{value:.3g}") == value


def test_students_differ_and_parts_agree():
    drawn = [tuple(variant("4.13", student).values()) for student in STUDENTS]
    assert len(set(drawn)) == len(STUDENTS)
    assert variant("4.3", "ab123") == variant("4.3b", "ab123") == variant("4.3c", "ab123")
    assert variant("4.3", "  AB123 ") == variant("4.3", "ab123")
    assert variant("4.15", 12345) == variant("4.15", "12345")


def test_draws_fill_the_range_evenly():
    factors = sorted(variant("4.13", f"n{n}")["m_s"] / 730.0 for n in range(400))
    assert factors[0] < 0.81
    assert factors[-1] > 1.19
    assert factors[200] == pytest.approx(1.0, abs=0.04)
    assert factors[100] == pytest.approx(0.9, abs=0.04)


def test_another_course_has_other_numbers(monkeypatch):
    before = variant("4.3", "ab123")
    monkeypatch.setenv("ENGDYN_COURSE", "ME342-2027")
    assert variant("4.3", "ab123") != before
    monkeypatch.setenv("ENGDYN_COURSE", "  ")
    assert variant("4.3", "ab123") == before


def test_a_changed_copy_does_not_change_the_next():
    variant("4.3", "ab123")["m"] = 99.0
    assert variant("4.3", "ab123")["m"] == 1.25


@pytest.mark.parametrize("student", ["", "   ", 3.5, True, b"ab", ["ab"], -1, "x" * 300])
def test_what_is_no_student_id_is_refused(student):
    with pytest.raises(EngdynError, match="student"):
        variant("4.3", student)


def test_an_exercise_that_no_draw_suits_is_named():
    with pytest.raises(EngdynError, match=rf"9\.9.*none of {ATTEMPTS}"):
        draw_values({"m": 1.0}, ["m"], lambda values: False, "9.9", "ab", "course")


def test_negative_zero_and_large_defaults_are_drawn_too():
    defaults = {"a": -2.0, "b": 0.0, "c": 6.5e6, "d": 1.2e-7}
    drawn = draw_values(defaults, defaults, lambda values: True, "9.9", "ab", "course")
    assert drawn["b"] == 0.0
    for name in "acd":
        assert 0.7995 <= drawn[name] / defaults[name] <= 1.2005
        assert float(f"{drawn[name]:.3g}") == drawn[name]


@pytest.mark.parametrize("id", ["4.3c", "4.14b", "4.15b"])
def test_no_count_of_roots_changes_when_a_parameter_changes_by_two_percent(id):
    item = exercise(id)
    for student in STUDENTS[:6]:
        case = item.case(student)
        count = len(item.question.solution(case))
        for name in item.setup.varied:
            for factor in (0.98, 1.02):
                other = case.at(**{name: case.values[name] * factor})
                assert len(item.question.solution(other)) == count, (student, name, factor)
