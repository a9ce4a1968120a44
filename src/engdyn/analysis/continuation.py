"""Following curves of equilibria over a parameter: predictor, corrector, edges, ways on at branch points.

Course section 4.3.  Pseudo-arclength continuation after H. B. Keller, in *Applications of Bifurcation
Theory*, Academic Press (1977).
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from engdyn.analysis.family import Curve, Family, Point
from engdyn.analysis.singular import branch_point, classify

__all__ = ["trace"]

STEP = 1 / 60
"""Length of a step along a curve; 1 is the width of the region."""

LIMIT = 4000
"""Number of points on one curve."""

LEVEL, RUN = 1e-9, 6
"""A curve that keeps the parameter to so many parts of the interval over so many points goes over a neutral family."""

NEAR = 2e-3
"""A point this close to a curve lies on it."""


def trace(family: Family, seeds: Sequence[Point]) -> tuple[list[Curve], list[tuple[str, float, np.ndarray]]]:
    """Follow curves from all seeds and from all branch points, each curve once.

    Parameters
    ----------
    family : Family
    seeds : sequence of (parameter, unknowns)
        Equilibria to start from.

    Returns
    -------
    curves : list of lists of (parameter, unknowns)
    singular : list of (kind, parameter, unknowns)
        Folds and branch points; each is a point of the curves that go through it, too.
    """
    tracer = _Tracer(family, seeds)
    for at, z in seeds:
        tracer.start(z, at)
    curves = [[tracer.unscaled(y) for y in points] for points in tracer.curves]
    return curves, [(kind, *tracer.unscaled(y)) for kind, y in tracer.singular]


class _Tracer:
    """Curves found so far, in coordinates y = (z, λ)/width scaled to the size of the region."""

    def __init__(self, family: Family, seeds: Sequence[Point]):
        self.family = family
        self.width = np.append(family.scale, family.interval[1] - family.interval[0])
        self.curves: list[list[np.ndarray]] = []
        self.singular: list[tuple[str, np.ndarray]] = []
        self._sizes = self._row_sizes(seeds)

    def unscaled(self, y: np.ndarray) -> Point:
        """Parameter and unknowns of a point."""
        return float(y[-1] * self.width[-1]), y[:-1] * self.width[:-1]

    def start(self, z: np.ndarray, at: float) -> None:
        """Follow the curve through an equilibrium both ways, unless it is known."""
        level = np.append(np.zeros(len(z)), 1.0)
        y = self._corrected(np.append(z, at) / self.width, level)
        if y is None or self._known(y):
            return
        tangent = self._tangent(y, level)
        forward = self._follow(y, tangent)
        closed = bool(forward) and forward[-1] is y
        backward = [] if closed else self._follow(y, -tangent)
        self._keep([*reversed(backward), y, *forward])

    # Geometry

    def _system(self, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """F and its Jacobian with respect to y, rows scaled to order one."""
        at, z = self.unscaled(y)
        value, by_z, by_parameter = self.family.evaluate(z, at)
        return value / self._sizes, np.column_stack([by_z, by_parameter]) * self.width / self._sizes[:, None]

    def _row_sizes(self, seeds: Sequence[Point]) -> np.ndarray:
        """Typical size of each row's derivatives, fixed: near a singular point they vanish."""
        sizes = [np.zeros(len(self.width) - 1)]
        for at, z in seeds:
            _, by_z, by_parameter = self.family.evaluate(z, at)
            sizes.append(np.linalg.norm(np.column_stack([by_z, by_parameter]) * self.width, axis=1))
        largest = np.max(sizes, axis=0)
        return np.where(largest > 0, largest, 1.0)

    def _tangent(self, y: np.ndarray, previous: np.ndarray) -> np.ndarray:
        tangent = np.linalg.svd(self._system(y)[1])[2][-1]
        return -tangent if tangent @ previous < 0 else tangent

    def _inside(self, y: np.ndarray) -> bool:
        at, z = self.unscaled(y)
        return self.family.inside(z, at)

    def _corrected(self, guess: np.ndarray, normal: np.ndarray) -> np.ndarray | None:
        """Newton's method in the plane through the guess; None where it does not settle."""
        y = guess.copy()
        for _ in range(12):
            value, slopes = self._system(y)
            try:
                change = np.linalg.solve(np.vstack([slopes, normal]), np.append(value, normal @ (y - guess)))
            except np.linalg.LinAlgError:
                return None
            y = y - change
            if not np.all(np.isfinite(y)):
                return None
            if np.max(np.abs(change)) < 1e-12:
                return y
        return y if np.max(np.abs(change)) < 1e-8 else None

    # Following

    def _follow(self, y: np.ndarray, tangent: np.ndarray) -> list[np.ndarray]:
        """Points along the curve until it leaves the region or closes (then the last point is the first)."""
        points: list[np.ndarray] = []
        first, step, travelled = y, STEP, 0.0
        while len(points) < LIMIT:
            new = self._corrected(y + step * tangent, tangent)
            turned = None if new is None else self._tangent(new, tangent)
            if turned is None or turned @ tangent < 0.96 or np.linalg.norm(new - y) > 2 * step:
                step *= 0.5
                if step < 1e-6:
                    break
                continue
            if not self._inside(new):
                self._end(points, y, self._to_edge(y, new, tangent))
                break
            points.append(new)
            if len(points) == RUN and _is_level([first, *points]):
                break
            travelled += float(np.linalg.norm(new - y))
            y, tangent = new, turned
            step = min(1.5 * step, STEP)
            if travelled > 4 * STEP and np.linalg.norm(y - first) < 0.6 * STEP:
                points.append(first)
                break
        return points

    @staticmethod
    def _end(points: list[np.ndarray], last: np.ndarray, edge: np.ndarray | None) -> None:
        """Put the end of a curve behind its points; in place of the last one where both are the same."""
        if edge is None:
            return
        if np.linalg.norm(edge - last) > 1e-8:
            points.append(edge)
        elif points:
            points[-1] = edge

    def _to_edge(self, inside: np.ndarray, outside: np.ndarray, tangent: np.ndarray) -> np.ndarray | None:
        """The last point of the curve within the region, by bisection along the tangent."""
        low, high, best = 0.0, float(np.linalg.norm(outside - inside)), None
        for _ in range(40):
            middle = 0.5 * (low + high)
            y = self._corrected(inside + middle * tangent, tangent)
            if y is not None and self._inside(y):
                low, best = middle, y
            else:
                high = middle
        return None if best is None else self._on_limit(best)

    def _on_limit(self, y: np.ndarray) -> np.ndarray:
        """A point at an end of the interval, moved exactly onto it."""
        limits = np.array(self.family.interval) / self.width[-1]
        nearest = limits[np.argmin(np.abs(limits - y[-1]))]
        if abs(nearest - y[-1]) > 1e-6:
            return y
        exact = self._corrected(np.append(y[:-1], nearest), np.append(np.zeros(len(y) - 1), 1.0))
        return y if exact is None else exact

    def _known(self, y: np.ndarray) -> bool:
        """Whether a point lies on a curve found before."""
        periodic = np.append(self.family.periodic, False)
        for curve in self.curves:
            points = np.array(curve)
            a, b = points[:-1], points[1:]
            turns = periodic * np.round(y - a)  # a whole turn away is the same place
            away, along = y - turns - a, b - a
            share = np.clip(np.sum(away * along, axis=1) / np.maximum(np.sum(along**2, axis=1), 1e-300), 0, 1)
            if np.min(np.linalg.norm(share[:, None] * along - away, axis=1)) < NEAR:
                return True
        return False

    # Singular points

    def _keep(self, points: list[np.ndarray], skip: int = 0) -> None:
        """Book a curve, put the singular points found on it into it, and follow what branches off there."""
        if len(points) < 2:
            return
        place = len(self.curves)
        self.curves.append(points)
        found = self._singular_on(points[skip:])
        for i, y in reversed(found):
            self.curves[place] = [*self.curves[place][: skip + i + 1], y, *self.curves[place][skip + i + 1 :]]
        for _, y in found:
            self._record(y)

    def _singular_on(self, points: Sequence[np.ndarray]) -> list[tuple[int, np.ndarray]]:
        """Folds (λ turns) and branch points (the bordered determinant changes sign) behind points[i]."""
        tangent, tests, found = points[1] - points[0], [], []
        for y in points:
            tangent = self._tangent(y, tangent)
            tests.append((tangent, self._tests(y, tangent)))
        for i in range(len(points) - 1):
            tangent, before = tests[i]
            after = tests[i + 1][1]
            if before[1] * after[1] < 0:  # a curve may turn where another crosses it: look for that first
                near = self._located(points[i], points[i + 1], tangent, 1)
                exact = branch_point(self._system, near)
                found.append((i, near if exact is None else exact))
            elif before[0] * after[0] < 0:
                found.append((i, self._located(points[i], points[i + 1], tangent, 0)))
        return found

    def _tests(self, y: np.ndarray, tangent: np.ndarray) -> tuple[float, float]:
        """Functions that change sign at folds and at branch points."""
        return float(tangent[-1]), float(np.linalg.det(np.vstack([self._system(y)[1], tangent])))

    def _located(self, y: np.ndarray, end: np.ndarray, tangent: np.ndarray, which: int) -> np.ndarray:
        """The point between two points of a curve at which a test function is zero, by bisection."""
        sign = np.sign(self._tests(y, tangent)[which])
        low, high, best = 0.0, float(np.linalg.norm(end - y)) * 1.05, 0.5 * (y + end)
        for _ in range(48):
            middle = 0.5 * (low + high)
            here = self._corrected(y + middle * tangent, tangent)
            # On the branch point itself the corrector has no unique answer, or leaps away.
            if here is None or np.linalg.norm(here - y) > 2.0 * middle + 1e-6:
                return best
            best = here
            if np.sign(self._tests(here, self._tangent(here, tangent))[which]) == sign:
                low = middle
            else:
                high = middle
        return best

    def _record(self, y: np.ndarray) -> None:
        """Classify a singular point, once, and follow the other curves through it."""
        if any(np.linalg.norm(known - y) < 1e-4 for _, known in self.singular):
            return
        kind, tangents = classify(self._system, y)
        place = len(self.singular)
        self.singular.append((kind, y))
        followed = [self._switch(y, tangent) for tangent in tangents]
        if not all(followed):
            self.singular[place] = "neutral family", y

    def _switch(self, y: np.ndarray, direction: np.ndarray) -> bool:
        """Start along a tangent of a branch point, in both senses, where that curve is not known.

        Where all points of the curve are equilibria at one value of the parameter, it is let go and told.
        """
        for sense in (direction, -direction):
            for length in (0.2 * STEP, 0.6 * STEP):
                new = self._corrected(y + length * sense, sense)
                if new is None or self._known(new) or not self._inside(new):
                    continue
                points = [y, new, *self._follow(new, self._tangent(new, sense))]
                if _is_level(points):
                    return False
                self._keep(points, skip=1)
                break
        return True


def _is_level(points: Sequence[np.ndarray]) -> bool:
    """Whether a curve begins with a run of points at one value of the parameter."""
    run = np.array(points[: RUN + 1])
    return len(run) > RUN and bool(np.ptp(run[:, -1]) < LEVEL)
