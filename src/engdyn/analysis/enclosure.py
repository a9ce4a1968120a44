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
from typing import Any

import numpy as np

from engdyn.algebra.balls import ball
from engdyn.analysis.boxes import (
    Box,
    as_array,
    contains,
    distinct_roots,
    is_covered,
    meet,
    merge,
    middle,
    subtract,
    width,
)
from engdyn.analysis.interval_newton import Step, effects, newton_step
from engdyn.errors import EngdynError

__all__ = ["Certificate", "enclose_roots"]

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
        middles = [[middle(pair) for pair in root] for root in self.roots]
        return np.array(middles).reshape(-1, len(self.region))

    @cached_property
    def certified(self) -> bool:
        """Whether `roots` are provably all roots: nothing is undecided and the boxes cover the region."""
        return not self.undecided and self.covers()

    def covers(self) -> bool:
        """Return whether accepted, rejected and undecided boxes together leave no gap in `searched`."""
        return is_covered(self.searched, (*self.accepted, *self.rejected, *self.undecided))

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
        rest = [piece for other in rest for piece in subtract(other, box)]
    n = len(region)
    undecided = merge(as_array(rest, n), as_array(accepted, n), np.array(search.extent))
    return Certificate(
        region=region,
        searched=searched,
        accepted=accepted,
        rejected=tuple(search.rejected),
        undecided=tuple(undecided),
        roots=distinct_roots(search.accepted, region, margins, periodic),
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
            shrunk = math.prod(width(new) / width(old) for new, old in zip(image, inner, strict=True))
            if shrunk < 0.8:  # less is not worth the boxes that are left around it
                inner = image
            if shrunk > 0.3:
                break
        self.rejected.extend(subtract(box, inner))
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
        effect = None if slopes is None else effects(slopes, box)
        if effect is None:
            effect = [width(pair) / extent for pair, extent in zip(box, self.extent, strict=True)]
        # Cutting across an unknown that has no effect at all would tell nothing.
        wide = [k for k, pair in enumerate(box) if width(pair) > self.smallest[k] and effect[k] > 0.0]
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

    def _newton(self, box: Box) -> Step | None:
        return newton_step(self.function, self.jacobian, box)

    def _accept_inflated(self, box: Box, inner: Box, image: Box) -> bool:
        """Try to prove a root on a cut or an edge, which no box it borders can hold in its interior.

        The proof is tried on a box grown around the image, once a step has pinned the root down.
        """
        relative = [width(pair) / extent for pair, extent in zip(image, self.extent, strict=True)]
        shrunk = [width(new) < 0.5 * width(old) for new, old in zip(image, inner, strict=True)]
        if not all(small or r < 1e-6 for small, r in zip(shrunk, relative, strict=True)):
            return False
        floor = 0.01 * max(relative) + 1e-10
        pads = [0.1 * width(pair) + floor * extent for pair, extent in zip(image, self.extent, strict=True)]
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
        if not meet(root, box):  # the neighbor's root
            self.rejected.append(box)
            return
        for known, known_root in self.accepted:
            if contains(known, root) or contains(single, known_root):  # one root seen from two boxes
                self.rejected.extend(subtract(box, known))
                return
            if meet(known_root, root):  # too blurred to tell one root from two
                self.undecided.append(box)
                return
        self.accepted.append((single, root))
        self.rejected.extend(subtract(box, single))
