"""The strongest true thing that can be said of a wrong expression without giving the right one away."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from fractions import Fraction
from math import pi
from typing import Any

import sympy as sm

from engdyn.course.case import Case
from engdyn.course.evaluation import NoValueError, evaluate, real
from engdyn.course.sameness import ROUNDED, agree, value_pairs
from engdyn.dimensions import (
    DimensionMismatch,
    dimension_of,
    dimension_of_unit,
    system_dimensions,
    unit_text,
)

__all__ = ["ratio_in_words", "strongest_statement"]

#: Points at which a statement about a wrong expression is tested.
ENOUGH = 8


def strongest_statement(
    given: sm.Expr, truth: sm.Expr, unit: str, case: Case, up_to_constant: bool = False
) -> str:
    """A hint for a wrong expression that no known mistake explains.

    Parameters
    ----------
    given, truth : sympy.Expr
        The answer and the right expression.
    unit : str
        SI unit that the answer must have.
    case : Case
    up_to_constant : bool
        Whether only differences of the expression matter (a potential energy).
    """
    if up_to_constant:
        zero = {c.symbol: sm.S.Zero for c in case.system.coordinates}
        given, truth = given - given.xreplace(zero), truth - truth.xreplace(zero)
    tests: Iterable[Callable[[], str]] = (
        lambda: _at_these_numbers(given, truth, case),
        lambda: _units(given, unit, case),
        lambda: _no_value(given, truth, case),
        lambda: _constant_ratio(given, truth, case),
        lambda: _power_of_truth(given, truth, case),
        lambda: _symbols(given, truth, case),
        lambda: _right_without(given, truth, case),
        lambda: _small_angles(given, truth, case),
    )
    for test in tests:
        said = test()
        if said:
            return said
    return _size(given, truth, case)


def _units(given: sm.Expr, unit: str, case: Case) -> str:
    try:
        found = dimension_of(given, system_dimensions(case.system))
    except DimensionMismatch as error:
        return f"Check the units: {error}."
    wanted = dimension_of_unit(unit)
    if found == wanted or given.is_zero:
        return ""
    return (
        f"Check the units: your expression has the unit {unit_text(found)}, the answer has "
        f"{unit_text(wanted)}."
    )


def _no_value(given: sm.Expr, truth: sm.Expr, case: Case) -> str:
    for point in case.points.take(ENOUGH):
        try:
            evaluate(truth, point)
        except NoValueError:
            continue
        try:
            evaluate(given, point)
            return ""
        except NoValueError as error:
            return (
                f"Your expression has no real value at parameters such as yours: {error}. Check the signs "
                f"inside."
            )
    return ""


def _constant_ratio(given: sm.Expr, truth: sm.Expr, case: Case) -> str:
    ratios = _ratios(given, truth, case)
    if not ratios or any(abs(r - ratios[0]) > ROUNDED * abs(ratios[0]) for r in ratios):
        return ""
    return ratio_in_words(float(ratios[0]), "expression")


def ratio_in_words(ratio: float, noun: str) -> str:
    """What a constant ratio of a wrong to the right result says; empty for nothing in particular."""
    if abs(ratio) < 1e-12:
        return ""
    size, sign = abs(ratio), " and its sign is wrong" if ratio < 0 else ""
    simple = Fraction(size).limit_denominator(12)
    if abs(size - 1) < ROUNDED:
        return f"Only the sign of your {noun} is wrong: check the positive directions."
    if _either_way(size, 180 / pi):
        return f"Your {noun} mixes degrees and radians{sign}: work in radians."
    if _either_way(size, 60 / (2 * pi)):
        return f"Your {noun} mixes revolutions per minute and radians per second{sign}."
    if _either_way(size, 2 * pi):
        return f"Your {noun} is off by the factor 2 pi{sign}: hertz is not radian per second."
    if abs(size - 2) < ROUNDED or abs(size - 0.5) < ROUNDED:
        cause = "large by the factor 2", "is something counted twice?"
        if size < 1:
            cause = "small by the factor 2", "is one of two equal parts left out?"
        return f"Your {noun} is too {cause[0]}{sign}: {cause[1]}"
    if simple and abs(size / float(simple) - 1) < ROUNDED:
        return f"Your {noun} is right but for a constant factor{sign}: check the numbers in front."
    return (
        f"Your {noun} is right but for a constant factor{sign}, which is no simple fraction: is a number "
        f"put in?"
    )


def _either_way(size: float, factor: float) -> bool:
    """Whether a ratio is a factor or its reciprocal."""
    return abs(size / factor - 1) < ROUNDED or abs(size * factor - 1) < ROUNDED


def _power_of_truth(given: sm.Expr, truth: sm.Expr, case: Case) -> str:
    if agree(given * truth, sm.S.One, case.points, ROUNDED, ENOUGH):
        return "Your expression is the reciprocal of the right one."
    if agree(given, truth**2, case.points, ROUNDED, ENOUGH):
        return "Your expression is the square of the right one."
    if agree(given**2, truth, case.points, ROUNDED, ENOUGH):
        return "Your expression is the square root of the right one."
    return ""


def _at_these_numbers(given: sm.Expr, truth: sm.Expr, case: Case) -> str:
    """Numbers put in for symbols: right at one set of parameters, and symbols are lacking."""
    names = case.notation.symbols_in
    if set(names(truth)) <= set(names(given)):
        return ""
    moving = [{**point, **case.points.here()} for point in case.points.take(4)]
    pairs = list(value_pairs(given, truth, moving))
    if pairs and all(abs(x - y) <= 1e-3 * scale for x, y, scale in pairs):
        return (
            "Your expression has the right value at your numbers, but not in general. Keep every symbol; "
            "put in no numbers."
        )
    return ""


def _symbols(given: sm.Expr, truth: sm.Expr, case: Case) -> str:
    names = case.notation.symbols_in
    extra = [n for n in names(given) if n not in names(truth)]
    lacking = [n for n in names(truth) if n not in names(given)]
    if extra and lacking:
        return f"The result does not depend on {_listed(extra)}, but it does depend on {_listed(lacking)}."
    if extra:
        return f"The result does not depend on {_listed(extra)}. Why?"
    if lacking:
        return f"Your expression does not depend on {_listed(lacking)}, but the result does."
    return ""


def _listed(names: list[str]) -> str:
    return " and ".join([", ".join(names[:-1]), names[-1]] if len(names) > 1 else names)


def _right_without(given: sm.Expr, truth: sm.Expr, case: Case) -> str:
    """A parameter whose terms are wrong: without it both expressions agree."""
    for name in case.notation.symbols_in(truth):
        symbol = case.notation.table[name]
        points = [{**point, symbol: real(0)} for point in case.points.take(ENOUGH)]
        pairs = list(value_pairs(given, truth, points))
        if len(pairs) == ENOUGH and all(y != 0 and abs(x - y) <= ROUNDED * scale for x, y, scale in pairs):
            return f"Your expression would be right for {name} = 0: look at the terms with {name}."
    return ""


def _small_angles(given: sm.Expr, truth: sm.Expr, case: Case) -> str:
    angles = [c.symbol for c in case.system.coordinates if c.unit == "rad"]
    if not any(truth.has(angle) for angle in angles):
        return ""
    points = [
        {symbol: value * real(1e-9) if symbol in angles else value for symbol, value in point.items()}
        for point in case.points.take(ENOUGH)
    ]
    pairs = list(value_pairs(given, truth, points))
    if pairs and all(y != 0 and abs(x / y - 1) < 1e-6 for x, y, _ in pairs):
        return "Your expression is right for small angles only: check sines, cosines and their powers."
    return ""


def _size(given: sm.Expr, truth: sm.Expr, case: Case) -> str:
    ratios = _ratios(given, truth, case)
    if not ratios:
        return "This is not the right expression."
    if all(abs(r - 1) < 0.01 for r in ratios):
        return (
            "Your expression is close to the right one, but not equal to it. Was something small neglected?"
        )
    if all(r < 0 for r in ratios):
        return "At parameters such as yours your expression has the wrong sign."
    if all(abs(r) > 1 for r in ratios) or all(abs(r) < 1 for r in ratios):
        return (
            f"At parameters such as yours the value of your expression is too "
            f"{'large' if abs(ratios[0]) > 1 else 'small'}."
        )
    return (
        "This is not the right expression: for some parameters its value is too large, for others too small."
    )


def _ratios(given: sm.Expr, truth: sm.Expr, case: Case) -> list[Any]:
    return [x / y for x, y, _ in value_pairs(given, truth, case.points.take(ENOUGH)) if y != 0]
