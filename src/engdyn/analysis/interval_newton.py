"""One interval Newton step: what a box is proved to hold, or a smaller box around what it may hold."""

from __future__ import annotations

import math
from collections.abc import Callable
from itertools import chain
from typing import Any, NamedTuple

from engdyn.algebra.balls import ball, contains_zero, is_finite, lower, midpoint, upper
from engdyn.analysis.boxes import Box, middle, width

__all__ = ["Step", "effects", "newton_step"]


class Step(NamedTuple):
    """Outcome of one Newton step: all roots of the box lie in the image."""

    image: Box
    proved: bool  # the box holds exactly one root, and the image holds it
    regular: bool  # every pivot of the preconditioned Jacobian excludes zero
    slopes: list[list[Any]] | None  # the Jacobian on the box where it is finite


def newton_step(function: Callable, jacobian: Callable, box: Box) -> Step | None:
    """Return one Newton step on a box, None when the box is proved to hold no root."""
    variables = [ball(low, high) for low, high in box]
    ranges = [ball(value) for value in function(variables)]
    if not all(map(contains_zero, ranges)):
        return None
    slopes = [[ball(entry) for entry in row] for row in jacobian(variables)]
    if not all(map(is_finite, chain(ranges, *slopes))):  # perhaps not continuous: no mean value theorem
        return Step(box, proved=False, regular=False, slopes=None)
    center = [middle(pair) for pair in box]
    values = [ball(value) for value in function([ball(c) for c in center])]
    spread = [x - c for x, c in zip(variables, center, strict=True)]
    for value, row in zip(values, slopes, strict=True):  # mean value form
        for slope, d in zip(row, spread, strict=True):
            value = value + slope * d
        if not contains_zero(value):
            return None
    inverse = _inverse([[midpoint(entry) for entry in row] for row in slopes])
    if inverse is None:
        return Step(box, proved=False, regular=False, slopes=slopes)
    return _contract(box, center, spread, values, slopes, inverse)


def effects(slopes: list[list[Any]], box: Box) -> list[float] | None:
    """Return each unknown's share in the variation of the equations, summed over the equations."""
    widths = [width(pair) for pair in box]
    effect = [0.0] * len(box)
    for row in slopes:
        moves = [max(-lower(slope), upper(slope)) * w for slope, w in zip(row, widths, strict=True)]
        total = sum(moves)
        if not math.isfinite(total):
            return None
        if total > 0.0:
            effect = [share + move / total for share, move in zip(effect, moves, strict=True)]
    return effect


def _inverse(matrix: list[list[float]]) -> list[list[float]] | None:
    """Return the inverse in plain floats (it need not be accurate), None where there is none.

    Gauss-Jordan elimination: at two to four unknowns a fraction of the time of a library call.
    """
    n = len(matrix)
    rows = [[*row, *(float(i == j) for j in range(n))] for i, row in enumerate(matrix)]
    for k in range(n):
        pivot = max(range(k, n), key=lambda i: abs(rows[i][k]))
        rows[k], rows[pivot] = rows[pivot], rows[k]
        scale = rows[k][k]
        if not 0.0 < abs(scale) < math.inf:
            return None
        rows[k] = [entry / scale for entry in rows[k]]
        for i in range(n):
            factor = rows[i][k]
            if i != k and factor:
                rows[i] = [entry - factor * other for entry, other in zip(rows[i], rows[k], strict=True)]
    return [row[n:] for row in rows]


def _contract(
    box: Box,
    center: list[float],
    spread: list[Any],
    values: list[Any],
    slopes: list[list[Any]],
    inverse: list[list[float]],
) -> Step | None:
    """Return the Hansen-Sengupta step: Gauss-Seidel on the preconditioned linear interval equations."""
    n, image, proved, regular = len(box), list(box), True, True
    for i, weights in enumerate(inverse):
        row = [_dot(weights, [slopes[k][j] for k in range(n)]) for j in range(n)]
        if contains_zero(row[i]):
            proved = regular = False
            continue
        total = _dot(weights, values)
        for j in range(n):
            if j != i:
                total = total + row[j] * spread[j]
        solution = center[i] - total / row[i]
        low, high = lower(solution), upper(solution)
        old_low, old_high = box[i]
        if low > old_high or high < old_low:
            return None
        proved = proved and old_low < low and high < old_high
        if low > old_low or high < old_high:
            image[i] = (max(low, old_low), min(high, old_high))
            spread[i] = ball(*image[i]) - center[i]
    return Step(tuple(image), proved, regular, slopes)


def _dot(weights: list[float], balls: list[Any]) -> Any:
    total = weights[0] * balls[0]
    for weight, value in zip(weights[1:], balls[1:], strict=True):
        total = total + weight * value
    return total
