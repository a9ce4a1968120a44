"""Verdicts: right answers in any form, wrong ones with a true hint, junk without an error."""

from __future__ import annotations

import math
import subprocess
import sys
import time

import numpy as np
import pint
import pytest
import sympy as sm
from sympy.physics.mechanics import dynamicsymbols

import engdyn as ed
from engdyn.course.case import Setup
from engdyn.course.checking import check
from engdyn.course.judging_sets import RootSet
from engdyn.course.registry import exercise, exercises
from engdyn.course.verdict import Verdict, not_yet, right, unanswered
from engdyn.errors import EngdynError

CRANE = Setup(lambda: ed.systems.load("S07"))
t = sm.Symbol("t")

# Verdicts


def test_a_verdict_is_truthy_only_when_right():
    assert right()
    assert not not_yet("Look again.")
    assert not unanswered()
    assert not unanswered().answered
    assert not_yet("Look again.").answered


def test_a_verdict_speaks_plainly_and_escapes_what_it_shows():
    verdict = Verdict(False, True, "<script>alert(1)</script>", "4.3")
    assert repr(verdict) == "Exercise 4.3: not right yet. <script>alert(1)</script>"
    assert "<script>" not in verdict._repr_html_()
    assert "&lt;script&gt;" in verdict._repr_html_()
    assert "right" in right("Fine.")._repr_html_()


@pytest.mark.parametrize("answer", [..., [...], (1, ...), [..., ...]], ids=repr)
def test_three_dots_are_no_answer(answer):
    verdict = check("4.3", answer)
    assert not verdict.answered
    assert not verdict.right


@pytest.mark.parametrize(
    ("id", "near"), [("4.33", "4.3"), ("4.3 x", "4.3"), ("", "4."), ("9.9", "."), ("4,3", "4.3")]
)
def test_an_unknown_exercise_is_named_with_its_nearest(id, near):
    with pytest.raises(EngdynError, match=r"no exercise.*nearest is") as caught:
        check(id, 1.0)
    assert near in str(caught.value)


@pytest.mark.parametrize("id", [4.3, None, 43, ["4.3"]])
def test_an_id_that_is_no_text_is_refused(id):
    with pytest.raises(EngdynError, match="id is text"):
        check(id, 1.0)


def test_the_public_names():
    code = (
        "import engdyn as ed, sys; assert 'sympy' not in sys.modules; "
        "assert not ed.course.check('4.3', ...).answered; "
        "assert isinstance(ed.course.check('4.3', 1), ed.course.Verdict); "
        "assert ed.course.exercise('4.7') in ed.course.exercises(); "
        "assert ed.course.variant('4.7')['c_x'] == 0"
    )
    subprocess.run([sys.executable, "-c", code], check=True)


# Sets of roots

ROOTS = exercise("4.14b").solution()


@pytest.mark.parametrize(
    "answer",
    [
        *(ROOTS, ROOTS[::-1], list(ROOTS), set(ROOTS), np.array(ROOTS), iter(ROOTS)),
        [root + 2 * math.pi for root in ROOTS],
        [0, -math.pi, ROOTS[0], ROOTS[2] + 5e-4],
        ["0", "180 deg", f"{math.degrees(ROOTS[2])} deg", f"{math.degrees(ROOTS[0])} deg"],
        f"0, pi, {ROOTS[0]:.5f}, {ROOTS[2]:.5f}",
        f"[0, pi, {ROOTS[0]:.5f}, {ROOTS[2]:.5f}]",
    ],
    ids=lambda a: f"{type(a).__name__}-{str(a)[:30]}",
)
def test_roots_count_in_any_order_and_modulo_a_turn(answer):
    assert check("4.14b", answer)


@pytest.mark.parametrize(
    ("id", "answer", "words"),
    [
        ("4.14b", [*ROOTS, -math.pi], "listed twice"),
        ("4.14b", [0], "but there are more"),
        ("4.14b", [*ROOTS, 1.0], "1 should not be"),
        ("4.14b", [0, math.pi, 0.7, -0.7], "Wrong: 0.7, -0.7"),
        ("4.14b", [0, math.pi, 0.7], "their number is not right"),
        ("4.14b", [1, 2, -1, -2], "number of angles is right, but none"),
        ("4.14b", [1.0], "there are more"),
        ("4.14b", [0.1, 0.2, 0.3, 0.4, 0.5], "there are fewer"),
        ("4.14b", [math.degrees(x) for x in ROOTS], "These are degrees"),
        ("4.14b", [x + 0.004 for x in ROOTS], "more digits"),
        ("4.14b", [], "list is empty"),
        ("4.14b", range(10**12), "more than 64 roots"),
        ("4.3c", [0, 2.0], "outside the region"),
        ("4.15b", [1.702, 6.877], "power of ten"),
        ("4.15b", [-0.001702, -0.006877], "All signs are wrong"),
        ("4.15b", ["1.702 kg", "6.877 mm"], "not a unit"),
    ],
    ids=lambda item: str(item)[:30],
)
def test_wrong_sets_get_a_true_hint(id, answer, words):
    verdict = check(id, answer)
    assert not verdict.right
    assert words in verdict.hint


def test_a_set_of_equilibria_found_with_an_own_equation_is_an_answer():
    lamp = exercise("4.14").system
    own = ed.EquationsOfMotion.from_residuals(list(exercise("4.14").solution()), [lamp.coordinates[0].symbol])
    assert check("4.14b", ed.equilibria(own, lamp.values(), bounds={"theta": (-3, 3.2)}))


def test_the_same_root_twice_in_a_truth_counts_once():
    question = RootSet(lambda case: [math.pi, -math.pi, 0.0, 2 * math.pi], unit="rad")
    assert question.solution(CRANE.case("0.1")) == (0.0, math.pi)


# Choices


@pytest.mark.parametrize("answer", ["b1", "B1", "b 1", "(b1)", "b, 1", ("b", 1), ["b", "1"]], ids=repr)
def test_a_choice_may_be_written_freely(answer):
    assert check("4.7b", answer)


def test_a_statement_needs_its_reason():
    assert "Add the number of the reason" in check("4.7b", "b").hint
    assert check("4.7b", "a1").hint == check("4.7b", "a").hint
    assert "letters a, b, c, d" in check("4.7b", "e").hint
    assert "reason, 1, 2, 3" in check("4.7b", "b7").hint


# Junk


class Hostile:
    """Raises whatever is asked of it."""

    def __getattr__(self, name):
        raise RuntimeError(name)

    def __eq__(self, other):
        raise RuntimeError("eq")

    __hash__ = None

    def __iter__(self):
        raise OSError("iter")

    def __float__(self):
        raise MemoryError


def nested(depth):
    found: list = []
    for _ in range(depth):
        found = [found]
    return found


def deep_expression():
    found = sm.Symbol("m")
    for _ in range(300):
        found = sm.sin(found, evaluate=False)
    return found


def doubling_expression():
    """A small graph that is an enormous tree."""
    found = sm.Symbol("m")
    for _ in range(60):
        found = sm.Add(sm.sin(found, evaluate=False), sm.cos(found, evaluate=False), evaluate=False)
    return found


JUNK = {
    "none": None,
    "true": True,
    "nan": float("nan"),
    "infinity": float("inf"),
    "complex": 1 + 2j,
    "huge integer": 10**100_000,
    "bytes": b"m*g",
    "empty": "",
    "blank": "   ",
    "prose": "I do not know",
    "import": "__import__('os').system('echo hacked')",
    "lambda": "(lambda: 1)()",
    "attribute": "m.__class__.__mro__",
    "null": "m\x00g",
    "tower": "9**9**9**9",
    "tower with unit": "9**9**9 rad",
    "long": "m+" * 100_000 + "m",
    "deep": "(" * 5000 + "m" + ")" * 5000,
    "equals": "a=b=c",
    "spaces": "1" + " " * 50_000 + "!",
    "units": "1 " + "m " * 5000,
    "list": [1, 2, 3],
    "texts": ["a", None, {}],
    "nested": nested(2000),
    "dict": {"answer": 1},
    "set": {1, 2},
    "array": np.zeros((3, 3)),
    "object array": np.array([None, "a"], dtype=object),
    "nan array": np.full(4, np.nan),
    "generator": (n for n in iter(int, 1)),
    "range": range(10**15),
    "function": lambda: 1,
    "class": Hostile,
    "hostile": Hostile(),
    "module": sys,
    "sympy nan": sm.nan,
    "sympy infinity": sm.oo,
    "imaginary": sm.I,
    "matrix": sm.Matrix([[1, 2], [3, 4]]),
    "true equation": sm.Eq(1, 1),
    "relation": sm.Symbol("m") < 3,
    "integral": sm.Integral(sm.exp(-(sm.Symbol("m") ** 2)), (sm.Symbol("m"), 0, 1)),
    "series": sm.Sum(1 / sm.Symbol("m"), (sm.Symbol("m"), 1, 10**9)),
    "piecewise": sm.Piecewise((1, sm.Symbol("m") > 0), (2, True)),
    "unknown function": sm.Function("f")(sm.Symbol("m")),
    "high derivative": dynamicsymbols("theta").diff(t, 7),
    "deep expression": deep_expression(),
    "doubling expression": doubling_expression(),
    "wide powers": (sm.Symbol("m") + sm.Symbol("l") + sm.Symbol("k") + sm.Symbol("g")) ** 60,
    "hidden tower": sm.Symbol("m") + sm.Pow(9, sm.Pow(9, 9, evaluate=False), evaluate=False),
    "fine angle": sm.sin(sm.Rational(123456789, 10**9) * sm.Symbol("k") / sm.Symbol("k") * 7),
    "many roots": sum(sm.sqrt(sm.Symbol("m") + n * sm.Symbol("l")) for n in range(40)),
    "huge values": np.array([1e308, -1e308]),
    "quantity": pint.UnitRegistry().Quantity([1, 2], "rad"),
    "equations of another system": ed.systems.load("S07").newton(),
    "system": ed.systems.load("S03"),
}


@pytest.mark.parametrize("item", exercises(), ids=lambda item: item.id)
def test_junk_is_wrong_at_once_and_without_an_error(item):
    item.solution()
    check(item.id, 0.123)  # whatever is derived once is derived here
    for name, junk in JUNK.items():
        start = time.perf_counter()
        verdict = check(item.id, junk)
        elapsed = time.perf_counter() - start
        assert not verdict.right, name
        assert verdict.answered, name
        assert verdict.hint.strip(), name
        assert len(verdict.hint) <= 600, name
        assert elapsed < 1.0, (name, elapsed)
        assert "Traceback" not in verdict.hint
        repr(verdict), verdict._repr_html_()
