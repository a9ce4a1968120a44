"""All roots of a system of equations in a box, each one enclosed and proved.

Branch and bound: a box is thrown away when the equations, evaluated on all of it in ball arithmetic, exclude
zero; otherwise an interval Newton step shrinks it around the roots it may hold, proves that it holds exactly
one, or leaves it to be cut in two. What can be neither proved nor thrown away (a multiple root, a point
where the equations are not defined, a budget used up) is reported as undecided, never guessed.

Course section 4.2. Sources: A. Neumaier, *Interval Methods for Systems of Equations*, Cambridge University
Press (1990), chapter 5 (the Hansen-Sengupta operator: what it excludes and what it proves); R. E. Moore,
R. B. Kearfott and M. J. Cloud, *Introduction to Interval Analysis*, SIAM (2009), chapter 8; S. M. Rump,
"Verification methods", Acta Numerica 19 (2010) (inflation).
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from itertools import chain
from typing import Any, NamedTuple

import numpy as np

from engdyn.algebra.balls import ball, contains_zero, is_finite, lower, midpoint, upper
from engdyn.errors import EngdynError

__all__ = ["Certificate", "enclose_roots"]

Box = tuple[tuple[float, float], ...]

EDGE_TOLERANCE = 1e-13  # a root this close to the region's edge, relative to its bounds, is on the edge
CUT = 0.4863  # where a box is cut: off the middle, away from the round numbers where roots like to lie


@dataclass(frozen=True, repr=False)
class Certificate:
    """What a search proved about the roots of n equations in a box; a box is n pairs (lower, upper).

    Attributes
    ----------
    region : tuple of (float, float)
        The region asked for.
    searched : tuple of (float, float)
        The region searched: a trifle larger, so that roots on the edge are found.
    accepted : tuple of boxes
        Each is proved to hold exactly one root. A root on the seam of a periodic unknown lies in one box at
        either end, so there may be more accepted boxes than roots.
    rejected : tuple of boxes
        Each is proved to hold no root.
    undecided : tuple of boxes
        About these nothing is claimed; neighboring ones are merged.
    roots : tuple of boxes
        A tight enclosure of every root in an accepted box, one per distinct root, sorted; periodic unknowns
        are brought into (lower, upper]. A root within rounding of the edge is centered on the edge.
    examined : int
        Number of boxes looked at.
    """

    region: Box
    searched: Box
    accepted: tuple[Box, ...]
    rejected: tuple[Box, ...] = field(default=())
    undecided: tuple[Box, ...] = field(default=())
    roots: tuple[Box, ...] = field(default=())
    examined: int = 0

    @property
    def points(self) -> np.ndarray:
        """Midpoints of the root enclosures, shape (number of roots, n)."""
        middles = [[_middle(pair) for pair in root] for root in self.roots]
        return np.array(middles).reshape(-1, len(self.region))

    @cached_property
    def certified(self) -> bool:
        """Whether `roots` are provably all roots: nothing is undecided and the boxes cover the region."""
        return not self.undecided and self.covers()

    def covers(self) -> bool:
        """Return whether accepted, rejected and undecided boxes together leave no gap in `searched`."""
        return _is_covered(self.searched, (*self.accepted, *self.rejected, *self.undecided))

    def __repr__(self) -> str:
        state = "certified" if self.certified else f"not certified, {len(self.undecided)} undecided boxes"
        return f"Certificate({len(self.roots)} roots, {state}, {self.examined} boxes examined)"


def enclose_roots(
    function: Callable[[list[Any]], Sequence[Any]],
    jacobian: Callable[[list[Any]], Sequence[Sequence[Any]]],
    region: Sequence[tuple[float, float]],
    *,
    periodic: Sequence[int] = (),
    max_boxes: int = 20000,
    min_width: float = 1e-9,
) -> Certificate:
    """Enclose every root of n equations in n unknowns in a region.

    Parameters
    ----------
    function : callable
        Takes a list of n balls (`engdyn.algebra.balls`), returns n balls (or exact numbers) that enclose the
        equations' left sides on them; a non-finite ball where an equation is not defined and continuous.
    jacobian : callable
        Takes a list of n balls, returns n rows of n balls (or exact numbers): the derivatives.
    region : sequence of (lower, upper), n pairs of finite floats
        The box to search, both ends included.
    periodic : sequence of int
        Unknowns whose range is one whole period of the equations: the lower end is the upper end again.
    max_boxes : int
        How many boxes to look at; those still waiting then are undecided.
    min_width : float
        A box this narrow in every unknown, as a fraction of the region, is not cut again but undecided.

    Returns
    -------
    Certificate
        All roots with the proof; ``certified`` says whether it is complete.

    Raises
    ------
    EngdynError
        When the region, a limit or the shape of what the callables return makes no sense.
    """
    region = _checked_region(region, periodic, max_boxes, min_width)
    margins = [EDGE_TOLERANCE * max(high - low, abs(low), abs(high)) for low, high in region]
    searched = tuple((low - edge, high + edge) for (low, high), edge in zip(region, margins, strict=True))
    search = _Search(function, jacobian, searched, min_width)
    search.run(max_boxes)
    accepted = tuple(box for box, _ in search.accepted)
    rest = search.undecided
    for box in accepted:  # so that no undecided box hides what an accepted one covers
        rest = [piece for other in rest for piece in _subtract(other, box)]
    n = len(region)
    undecided = _merge(_as_array(rest, n), _as_array(accepted, n), np.array(search.extent))
    return Certificate(
        region=region,
        searched=searched,
        accepted=accepted,
        rejected=tuple(search.rejected),
        undecided=tuple(undecided),
        roots=_distinct_roots(search.accepted, region, margins, periodic),
        examined=search.examined,
    )


def _checked_region(region: Any, periodic: Sequence[int], max_boxes: int, min_width: float) -> Box:
    """Return the region as a tuple of float pairs; raise `EngdynError` when an argument makes no sense."""
    try:
        box = tuple((float(low), float(high)) for low, high in region)
    except (TypeError, ValueError):
        raise EngdynError(f"region={region!r} is no box: give one pair (lower, upper) per unknown.") from None
    for k, (low, high) in enumerate(box):
        if not (-math.inf < low < high < math.inf):
            raise EngdynError(
                f"region[{k}]=({low}, {high}) has no extent: give finite bounds, lower < upper."
            )
    if not box or any(k not in range(len(box)) for k in periodic):
        raise EngdynError(
            f"periodic={periodic!r} with {len(box)} unknowns: give indices from 0 to one below that."
        )
    if max_boxes < 1 or not 0.0 < min_width < 1.0:
        raise EngdynError(f"{max_boxes=}, {min_width=}: give at least one box and a width between 0 and 1.")
    return box


class _Step(NamedTuple):
    """Outcome of one Newton step: all roots of the box lie in the image."""

    image: Box
    proved: bool  # the box holds exactly one root, and the image holds it
    regular: bool  # every pivot of the preconditioned Jacobian excludes zero
    slopes: list[list[Any]] | None  # the Jacobian on the box where it is finite


class _Search:
    """Branch and bound over boxes: the state of one search."""

    def __init__(self, function: Callable, jacobian: Callable, searched: Box, min_width: float) -> None:
        self.function, self.jacobian, self.searched = function, jacobian, searched
        self.extent = [high - low for low, high in searched]
        self.smallest = [min_width * extent for extent in self.extent]
        self.accepted: list[tuple[Box, Box]] = []  # (box with exactly one root, tight enclosure of the root)
        self.rejected: list[Box] = []
        self.undecided: list[Box] = []
        self.waiting: deque[Box] = deque()
        self.postponed: deque[Box] = deque()
        self.examined = 0

    def run(self, max_boxes: int) -> None:
        """Examine boxes breadth first, so that a spent budget leaves small boxes everywhere.

        Where the equations are not finite comes last: the budget is for the roots first.
        """
        self._check_shapes()
        self.waiting.append(self.searched)
        while (self.waiting or self.postponed) and self.examined < max_boxes:
            self.examined += 1
            self._examine((self.waiting or self.postponed).popleft())
        self.undecided.extend((*self.waiting, *self.postponed))

    def _check_shapes(self) -> None:
        variables = [ball(low, high) for low, high in self.searched]
        n, values, rows = len(variables), self.function(variables), self.jacobian(variables)
        if len(values) != n or len(rows) != n or any(len(row) != n for row in rows):
            raise EngdynError(
                f"{n} unknowns, but the function returns {len(values)} values and the Jacobian {len(rows)} "
                f"rows of lengths {sorted({len(row) for row in rows})}: give n values and n rows of n."
            )

    def _examine(self, box: Box) -> None:
        """Decide a box, or cut it in two."""
        inner = box
        while True:
            step = self._newton(inner)
            if step is None:
                self.rejected.append(box)
                return
            if step.proved:  # what the earlier steps cut off holds no root: the whole box holds exactly one
                self._accept(box, box, step.image)
                return
            if step.regular and self._accept_inflated(box, inner, step.image):
                return
            image = self._with_margin(step.image, inner)
            shrunk = math.prod(_width(new) / _width(old) for new, old in zip(image, inner, strict=True))
            if shrunk < 0.8:  # less is not worth the boxes that are left around it
                inner = image
            if shrunk > 0.3:
                break
        self.rejected.extend(_subtract(box, inner))
        self._cut(inner, step.slopes)

    def _with_margin(self, image: Box, box: Box) -> Box:
        """Return the image with a margin, so that what is cut off touches no root, not even with its rim."""
        margins = [1e-12 * extent for extent in self.extent]
        return tuple(
            (max(low, new_low - margin), min(high, new_high + margin))
            for (new_low, new_high), (low, high), margin in zip(image, box, margins, strict=True)
        )

    def _cut(self, box: Box, slopes: list[list[Any]] | None) -> None:
        """Cut a box in two across the unknown that moves the equations most, or give it up as undecided."""
        effect = None if slopes is None else _effects(slopes, box)
        if effect is None:
            effect = [_width(pair) / extent for pair, extent in zip(box, self.extent, strict=True)]
        # Cutting across an unknown that has no effect at all would tell nothing.
        wide = [k for k, pair in enumerate(box) if _width(pair) > self.smallest[k] and effect[k] > 0.0]
        if wide:
            k = max(wide, key=effect.__getitem__)
            low, high = box[k]
            cut = low + CUT * (high - low)
            if low < cut < high:
                queue = self.postponed if slopes is None else self.waiting
                queue.append((*box[:k], (low, cut), *box[k + 1 :]))
                queue.append((*box[:k], (cut, high), *box[k + 1 :]))
                return
        self.undecided.append(box)

    def _newton(self, box: Box) -> _Step | None:
        return _newton_step(self.function, self.jacobian, box)

    def _accept_inflated(self, box: Box, inner: Box, image: Box) -> bool:
        """Try to prove a root on a cut or an edge, which no box it borders can hold in its interior.

        The proof is tried on a box grown around the image, once a step has pinned the root down.
        """
        relative = [_width(pair) / extent for pair, extent in zip(image, self.extent, strict=True)]
        shrunk = [_width(new) < 0.5 * _width(old) for new, old in zip(image, inner, strict=True)]
        if not all(small or r < 1e-6 for small, r in zip(shrunk, relative, strict=True)):
            return False
        floor = 0.01 * max(relative) + 1e-10
        pads = [0.1 * _width(pair) + floor * extent for pair, extent in zip(image, self.extent, strict=True)]
        grown = tuple((low - pad, high + pad) for (low, high), pad in zip(image, pads, strict=True))
        step = self._newton(grown)
        if step is None or not step.proved:
            return False
        self._accept(box, grown, step.image)
        return True

    def _accept(self, box: Box, single: Box, root: Box) -> None:
        """Book a box all of whose roots lie in `single`, which holds exactly one root, enclosed by `root`."""
        for _ in range(20):
            step = self._newton(root)
            if step is None or step.image == root:
                break
            root = step.image
        if not _meet(root, box):  # the neighbor's root
            self.rejected.append(box)
            return
        for known, known_root in self.accepted:
            if _contains(known, root) or _contains(single, known_root):  # one root seen from two boxes
                self.rejected.extend(_subtract(box, known))
                return
            if _meet(known_root, root):  # too blurred to tell one root from two
                self.undecided.append(box)
                return
        self.accepted.append((single, root))
        self.rejected.extend(_subtract(box, single))


def _newton_step(function: Callable, jacobian: Callable, box: Box) -> _Step | None:
    """Return one Newton step on a box, None when the box is proved to hold no root."""
    variables = [ball(low, high) for low, high in box]
    ranges = [ball(value) for value in function(variables)]
    if not all(map(contains_zero, ranges)):
        return None
    slopes = [[ball(entry) for entry in row] for row in jacobian(variables)]
    if not all(map(is_finite, chain(ranges, *slopes))):  # perhaps not continuous: no mean value theorem
        return _Step(box, proved=False, regular=False, slopes=None)
    center = [_middle(pair) for pair in box]
    values = [ball(value) for value in function([ball(c) for c in center])]
    spread = [x - c for x, c in zip(variables, center, strict=True)]
    for value, row in zip(values, slopes, strict=True):  # mean value form
        for slope, d in zip(row, spread, strict=True):
            value = value + slope * d
        if not contains_zero(value):
            return None
    inverse = _inverse([[midpoint(entry) for entry in row] for row in slopes])
    if inverse is None:
        return _Step(box, proved=False, regular=False, slopes=slopes)
    return _contract(box, center, spread, values, slopes, inverse)


def _effects(slopes: list[list[Any]], box: Box) -> list[float] | None:
    """Return each unknown's share in the variation of the equations, summed over the equations."""
    widths = [_width(pair) for pair in box]
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
) -> _Step | None:
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
    return _Step(tuple(image), proved, regular, slopes)


def _dot(weights: list[float], balls: list[Any]) -> Any:
    total = weights[0] * balls[0]
    for weight, value in zip(weights[1:], balls[1:], strict=True):
        total = total + weight * value
    return total


def _distinct_roots(
    accepted: list[tuple[Box, Box]], region: Box, margins: list[float], periodic: Sequence[int]
) -> tuple[Box, ...]:
    """Return one enclosure per root: periodic unknowns brought into (lower, upper], edges hit exactly."""
    found: list[tuple[Box, Box]] = []
    for box, root in accepted:
        for k in periodic:
            box, root = _wrap(box, root, k, region[k], margins[k])
        if not any(_contains(known, root) or _contains(box, known_root) for known, known_root in found):
            found.append((box, root))
    snapped = [tuple(map(_snap, root, region)) for _, root in found]
    return tuple(sorted(snapped, key=lambda root: [_middle(pair) for pair in root]))


def _wrap(box: Box, root: Box, k: int, bounds: tuple[float, float], margin: float) -> tuple[Box, Box]:
    """Move a root and its box by whole periods so that the root lies in (lower, upper], up to the margin."""
    low, high = bounds
    turns = math.ceil((_middle(root[k]) - high - margin) / (high - low))
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
    center = held[0] if held else min(max(_middle(root), low), high)
    if center == _middle(root):
        return root
    unit = 2.0 * math.ulp(max(abs(center), abs(root[0]), abs(root[1])))  # so that both bounds are exact
    reach = unit * math.ceil(max(center - root[0], root[1] - center) / unit)
    return center - reach, center + reach


def _width(pair: tuple[float, float]) -> float:
    return pair[1] - pair[0]


def _middle(pair: tuple[float, float]) -> float:
    return 0.5 * pair[0] + 0.5 * pair[1]


def _meet(a: Box, b: Box) -> bool:
    return all(
        low <= other_high and other_low <= high
        for (low, high), (other_low, other_high) in zip(a, b, strict=True)
    )


def _contains(large: Box, small: Box) -> bool:
    return all(a <= c and d <= b for (a, b), (c, d) in zip(large, small, strict=True))


def _subtract(box: Box, other: Box) -> list[Box]:
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


def _as_array(boxes: Sequence[Box], n: int) -> np.ndarray:
    """Return boxes as an array of shape (number of boxes, n, 2)."""
    return np.array(boxes, dtype=float).reshape(-1, n, 2)


def _is_covered(box: Box, boxes: Sequence[Box]) -> bool:
    """Return whether boxes leave no gap in a box: it is cut along their faces, then they are subtracted."""
    waiting = [(np.array(box), _as_array(boxes, len(box)))]
    while waiting:
        piece, others = waiting.pop()
        low, high = piece.T
        others = others[((others[:, :, 0] < high) & (others[:, :, 1] > low)).all(axis=1)]
        if len(others) <= 12:
            rest = [tuple(map(tuple, piece.tolist()))]
            for other in others.tolist():
                rest = [part for remaining in rest for part in _subtract(remaining, other)]
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


def _merge(boxes: np.ndarray, avoided: np.ndarray, extent: np.ndarray) -> list[Box]:
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
