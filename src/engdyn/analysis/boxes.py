"""Boxes, products of closed intervals: cutting, covering, merging, and bringing roots into a region.

A box is a tuple of pairs (lower, upper) of floats; all comparisons are exact.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

__all__ = [
    "Box",
    "as_array",
    "contains",
    "distinct_roots",
    "is_covered",
    "meet",
    "merge",
    "middle",
    "subtract",
    "width",
]

Box = tuple[tuple[float, float], ...]


def distinct_roots(
    accepted: list[tuple[Box, Box]], region: Box, margins: list[float], periodic: Sequence[int]
) -> tuple[Box, ...]:
    """Return one enclosure per root: periodic unknowns brought into (lower, upper], edges hit exactly."""
    found: list[tuple[Box, Box]] = []
    for box, root in accepted:
        for k in periodic:
            box, root = _wrap(box, root, k, region[k], margins[k])
        if not any(contains(known, root) or contains(box, known_root) for known, known_root in found):
            found.append((box, root))
    snapped = [tuple(map(_snap, root, region)) for _, root in found]
    return tuple(sorted(snapped, key=lambda root: [middle(pair) for pair in root]))


def _wrap(box: Box, root: Box, k: int, bounds: tuple[float, float], margin: float) -> tuple[Box, Box]:
    """Move a root and its box by whole periods so that the root lies in (lower, upper], up to the margin."""
    low, high = bounds
    turns = math.ceil((middle(root[k]) - high - margin) / (high - low))
    if turns == 0:
        return box, root
    shift = turns * (high - low)
    pad = 4.0 * math.ulp(max(abs(low), abs(high), abs(shift)))  # the period itself is rounded, too
    moved = (root[k][0] - shift - pad, root[k][1] - shift + pad)
    moved_box = (box[k][0] - shift, box[k][1] - shift)
    return (*box[:k], moved_box, *box[k + 1 :]), (*root[:k], moved, *root[k + 1 :])


def _snap(root: tuple[float, float], bounds: tuple[float, float]) -> tuple[float, float]:
    """Return the enclosure of one unknown, widened to be centered on zero or on an edge where it holds it.

    A root beyond an edge, but within the margin that was searched, counts as on the edge.
    """
    low, high = bounds
    held = [mark for mark in (0.0, low, high) if low <= mark <= high and root[0] <= mark <= root[1]]
    center = held[0] if held else min(max(middle(root), low), high)
    if center == middle(root):
        return root
    unit = 2.0 * math.ulp(max(abs(center), abs(root[0]), abs(root[1])))  # so that both bounds are exact
    reach = unit * math.ceil(max(center - root[0], root[1] - center) / unit)
    return center - reach, center + reach


def width(pair: tuple[float, float]) -> float:
    """Return upper minus lower."""
    return pair[1] - pair[0]


def middle(pair: tuple[float, float]) -> float:
    """Return a number halfway."""
    return 0.5 * pair[0] + 0.5 * pair[1]


def meet(a: Box, b: Box) -> bool:
    """Return whether two closed boxes have a point in common."""
    return all(
        low <= other_high and other_low <= high
        for (low, high), (other_low, other_high) in zip(a, b, strict=True)
    )


def contains(large: Box, small: Box) -> bool:
    """Return whether one box lies in another."""
    return all(a <= c and d <= b for (a, b), (c, d) in zip(large, small, strict=True))


def subtract(box: Box, other: Box) -> list[Box]:
    """Return boxes that cover what is left of a box when another one is cut out of it."""
    if any(
        high <= low_cut or high_cut <= low
        for (low, high), (low_cut, high_cut) in zip(box, other, strict=True)
    ):
        return [box]
    pieces, rest = [], list(box)
    for k, (low_cut, high_cut) in enumerate(other):
        low, high = rest[k]
        if low < low_cut:
            pieces.append((*rest[:k], (low, low_cut), *rest[k + 1 :]))
        if high_cut < high:
            pieces.append((*rest[:k], (high_cut, high), *rest[k + 1 :]))
        rest[k] = (max(low, low_cut), min(high, high_cut))
    return pieces


def as_array(boxes: Sequence[Box], n: int) -> np.ndarray:
    """Return boxes as an array of shape (number of boxes, n, 2)."""
    return np.array(boxes, dtype=float).reshape(-1, n, 2)


def is_covered(box: Box, boxes: Sequence[Box]) -> bool:
    """Return whether boxes leave no gap in a box: it is cut along their faces, then they are subtracted."""
    waiting = [(np.array(box), as_array(boxes, len(box)))]
    while waiting:
        piece, others = waiting.pop()
        low, high = piece.T
        others = others[((others[:, :, 0] < high) & (others[:, :, 1] > low)).all(axis=1)]
        if len(others) <= 12:
            rest = [tuple(map(tuple, piece.tolist()))]
            for other in others.tolist():
                rest = [part for remaining in rest for part in subtract(remaining, other)]
            if rest:
                return False
            continue
        inside = (others > low[:, None]) & (others < high[:, None])
        k = int(inside.sum(axis=(0, 2)).argmax())
        faces = np.sort(others[:, k][inside[:, k]])
        if not len(faces):  # all of them contain the piece
            continue
        for bounds in ((low[k], faces[len(faces) // 2]), (faces[len(faces) // 2], high[k])):
            part = piece.copy()
            part[k] = bounds
            waiting.append((part, others))
    return True


def merge(boxes: np.ndarray, avoided: np.ndarray, extent: np.ndarray) -> list[Box]:
    """Return few boxes that cover the given ones and overlap none of those avoided.

    A group of boxes becomes one when it is tiny or fills half of its hull; else it is split at gaps, then up
    to four times in the middle (a curve of roots keeps its shape roughly).
    """
    merged: list[Box] = []
    waiting = [(boxes, 4)] if len(boxes) else []
    while waiting:
        group, halvings = waiting.pop()
        hull = np.stack([group[:, :, 0].min(axis=0), group[:, :, 1].max(axis=0)], axis=1)
        relative = (hull[:, 1] - hull[:, 0]) / extent
        free = not ((avoided[:, :, 0] < hull[:, 1]) & (avoided[:, :, 1] > hull[:, 0])).all(axis=1).any()
        parts = None if free and relative.max() < 1e-4 else _parts_at_gap(group)
        if parts is None:
            filled = (np.diff(group)[:, :, 0] / extent).prod(axis=1).sum() / relative.prod()
            if len(group) == 1 or (free and (halvings == 0 or filled > 0.5 or relative.max() < 1e-4)):
                merged.append(tuple((float(low), float(high)) for low, high in hull))
                continue
            order = group[:, relative.argmax(), 0].argsort()
            parts, halvings = np.array_split(group[order], 2), max(halvings - 1, 0)
        waiting.extend((part, halvings) for part in parts)
    return merged


def _parts_at_gap(boxes: np.ndarray) -> list[np.ndarray] | None:
    """Return the boxes before and after the gaps along one unknown, None when there is no gap."""
    for k in range(boxes.shape[1]):
        ordered = boxes[boxes[:, k, 0].argsort()]
        reached = np.maximum.accumulate(ordered[:, k, 1])
        gaps = np.flatnonzero(ordered[1:, k, 0] > reached[:-1]) + 1
        if len(gaps):
            return np.split(ordered, gaps)
    return None
