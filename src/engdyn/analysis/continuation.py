"""Following a curve of solutions: predictor, corrector, singular points and branch switching."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import sympy as sm
from sympy.physics.vector import dynamicsymbols

from engdyn.algebra.codegen import compile_elements
from engdyn.algebra.conversion import Converter
from engdyn.algebra.ring import Element
from engdyn.analysis.equilibrium import Equilibrium, is_periodic
from engdyn.analysis.steady import SteadyProblem
from engdyn.modeling.equations import EquationsOfMotion
from engdyn.modeling.numbers import mass_and_force

__all__ = ["Curve", "Family", "trace"]

Curve = list[tuple[float, np.ndarray]]
Point = tuple[float, np.ndarray]


class Family:
    """Equilibrium conditions F(z, λ) = 0 over one parameter λ, with their derivatives.

    z holds the unknowns that an equilibrium search solves for (coordinates, rates, inputs), all
    scaled with their bounds so that steps compare.
    """

    def __init__(
        self,
        eom: EquationsOfMotion,
        values: Mapping[str, float],
        parameter: str,
        interval: tuple[float, float],
        bounds: Mapping[str, tuple[float, float]] | None,
        steady: Mapping[str, Any],
    ):
        self.eom, self.values, self.parameter, self.interval = eom, dict(values), parameter, interval
        self.bounds, self.steady = dict(bounds or {}), steady
        middle = {**values, parameter: 0.5 * (interval[0] + interval[1]) or 0.4321 * interval[1]}
        symbol = next(p for p in eom.parameters if p.name == parameter)
        self._driven = self._driven_inputs(symbol)
        varied = frozenset({("symbol", symbol), *(("function", w, k) for w, k, _ in self._driven)})
        self.problem = SteadyProblem(eom, middle, keep=varied, **steady)
        self.names = self.problem.names
        self.unknowns = self.problem.unknowns
        self.scale = np.array([self._width(u.name) for u in self.unknowns])
        widths = zip(self.unknowns, self.scale, strict=True)
        self.periodic = np.array([is_periodic(self.problem, u, (0.0, width)) for u, width in widths], dtype=bool)
        self._compile(symbol)

    def _width(self, name: str) -> float:
        low, high = self.bounds.get(name, (-np.pi, np.pi))
        return high - low

    def _driven_inputs(self, symbol: Any) -> list[tuple[Any, int, Any]]:
        """Inputs whose default depends on the parameter (a drive rate Omega): (input, order, expression)."""
        given = dict(self.steady.get("inputs") or {})
        found = []
        for w, triple in self.eom.defaults.items():
            if w.func.__name__ not in given:
                symbols = [sm.sympify(e).free_symbols for e in triple]
                found += [(w, k, triple[k]) for k in (1, 2) if symbol in symbols[k] and dynamicsymbols._t not in symbols[k]]
        return found

    def _compile(self, symbol: Any) -> None:
        """F, ∂F/∂z and dF/dλ as one compiled function of (z, λ, driven inputs)."""
        problem, ring = self.problem, self.problem.ring
        varied = [("symbol", symbol), *(("function", w, k) for w, k, _ in self._driven)]
        n = len(self.unknowns)
        elements: list[Element] = list(problem.rows)
        for key in (*(u.key for u in self.unknowns), *varied):
            partial = ring.partial(key)
            elements += [partial(row) for row in problem.rows]
        constants = [key for key in problem.constants if key not in varied]
        self._constant_values = [float(problem.constants[key]) for key in constants]
        self._compiled = compile_elements(elements, [*(u.key for u in self.unknowns), *varied, *constants], "math")
        defaults = [e for _, _, e in self._driven]
        rates = [e.diff(symbol) for e in defaults]
        others = [p for e in (*defaults, *rates) for p in e.free_symbols if p != symbol]
        numbers = {p: self.values[p.name] for p in others if p.name in self.values}
        expressions = [e.xreplace(numbers) for e in (*defaults, *rates)]
        converter = Converter(expressions, [("symbol", symbol)])
        self._driving = compile_elements([converter.convert(e) for e in expressions], [("symbol", symbol)], "math")
        self._n, self._varied = n, len(varied)

    def evaluate(self, z: np.ndarray, at: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """F, ∂F/∂z and dF/dλ at one point."""
        driving = self._driving(at)
        half = len(driving) // 2
        n = self._n
        flat = np.array(
            self._compiled(*(float(x) for x in z), at, *driving[:half], *self._constant_values), dtype=float
        )
        table = flat.reshape(1 + n + self._varied, -1)
        by_parameter = table[1 + n] + sum((s * row for s, row in zip(driving[half:], table[2 + n :], strict=True)), 0.0)
        return table[0], table[1 : 1 + n].T, by_parameter

    def inside(self, z: np.ndarray, at: float) -> bool:
        """Whether a point lies within the interval and the bounds."""
        low, high = self.interval
        slack = 1e-9 * (high - low)
        if not low - slack <= at <= high + slack:
            return False
        for unknown, value, periodic in zip(self.unknowns, z, self.periodic, strict=True):
            if unknown.name in self.bounds and not periodic:
                least, greatest = self.bounds[unknown.name]
                edge = 1e-9 * (greatest - least)
                if not least - edge <= value <= greatest + edge:
                    return False
        return True

    def unknown_part(self, equilibrium: Equilibrium) -> np.ndarray:
        """The unknowns of a found equilibrium, in the order of this family."""
        named = {n: x for n, x in zip(equilibrium.names, equilibrium.q, strict=True)}
        owners = [u.expr.func.__name__ if u.is_Derivative else u.func.__name__ for u in self.eom.speeds]
        named |= {f"{n}_d": x for n, x in zip(owners, equilibrium.speeds, strict=True)}
        named |= {f"{n}_dd": x for n, x in zip(owners, equilibrium.accelerations, strict=True)}
        named |= {n: x for n, x in equilibrium.inputs.items() if isinstance(x, int | float)}
        return np.array([float(named.get(u.name, 0.0)) for u in self.unknowns])

    def coordinates(self, z: np.ndarray, at: float) -> np.ndarray:
        """All coordinates at a point, neutral ones zero."""
        return self.equilibrium(z, at).q

    def equilibrium(self, z: np.ndarray, at: float) -> Equilibrium:
        """The equilibrium of a point on a branch."""
        named = {u.name: float(x) for u, x in zip(self.unknowns, z, strict=True)}
        problem = self.problem
        owners = [u.expr.func.__name__ if u.is_Derivative else u.func.__name__ for u in self.eom.speeds]
        q = np.array([named.get(n, 0.0) for n in self.names])
        speeds = np.array([named.get(f"{n}_d", float(problem.rates.get(n, 0))) for n in owners])
        udot = np.array([named.get(f"{n}_dd", float(problem.accelerations.get(n, 0))) for n in owners])
        inputs = dict(self.steady.get("inputs") or {})
        inputs |= {key[1].func.__name__: named[key[1].func.__name__] for key in problem.free}
        values = {**self.values, self.parameter: at}
        mass, force = mass_and_force(self.eom, q, speeds, values, inputs)
        residual = float(np.max(np.abs(mass @ udot - force), initial=0.0))
        return Equilibrium(q, speeds, udot, inputs, values, residual, tuple(self.names))


def trace(family: Family, seeds: Sequence[Point]) -> tuple[list[Curve], list[tuple[str, float, np.ndarray]]]:
    """Follow curves from all seeds and from all branch points, each curve once."""
    tracer = _Tracer(family, seeds)
    for at, z in seeds:
        tracer.start(z, at)
    return tracer.curves, tracer.singular


class _Tracer:
    """Curves found so far, in coordinates scaled to the size of the region."""

    STEP = 1 / 60  # of the region's width, along the curve
    LIMIT = 4000  # points on one curve

    def __init__(self, family: Family, seeds: Sequence[Point]):
        self.family = family
        self.width = np.append(family.scale, family.interval[1] - family.interval[0])
        self._sizes = self._row_sizes(seeds)
        self.curves: list[Curve] = []
        self.singular: list[tuple[str, float, np.ndarray]] = []

    def start(self, z: np.ndarray, at: float, direction: np.ndarray | None = None) -> None:
        """Follow the curve through a point both ways, unless it is known."""
        y = np.append(z, at) / self.width
        if direction is None:
            y = self._corrected(y, np.append(np.zeros(len(z)), 1.0))
            if y is None or self._known(y):
                return
            tangent = self._tangent(y, None)
            forward, backward = self._follow(y, tangent), self._follow(y, -tangent)
            points = [*reversed(backward), y, *forward]
        else:
            points = [y, *self._follow(y, direction)]
        if len(points) > 1:
            self.curves.append([(p[-1] * self.width[-1], p[:-1] * self.width[:-1]) for p in points])
            self._look_for_singular(points)

    # Geometry in scaled coordinates y = (z, λ)/width

    def _system(self, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """F and its Jacobian with respect to y."""
        value, by_z, by_parameter = self.family.evaluate(y[:-1] * self.width[:-1], float(y[-1] * self.width[-1]))
        return value / self._sizes, np.column_stack([by_z, by_parameter]) * self.width / self._sizes[:, None]

    def _row_sizes(self, seeds: Sequence[Point]) -> np.ndarray:
        """Typical size of each row's derivatives, fixed: near a singular point they vanish."""
        sizes = [np.zeros(len(self.width) - 1)]
        for at, z in seeds:
            _, by_z, by_parameter = self.family.evaluate(z, at)
            sizes.append(np.linalg.norm(np.column_stack([by_z, by_parameter]) * self.width, axis=1))
        largest = np.max(sizes, axis=0)
        return np.where(largest > 0, largest, 1.0)

    def _tangent(self, y: np.ndarray, previous: np.ndarray | None) -> np.ndarray:
        tangent = np.linalg.svd(self._system(y)[1])[2][-1]
        if previous is not None and tangent @ previous < 0:
            tangent = -tangent
        return tangent

    def _corrected(self, guess: np.ndarray, normal: np.ndarray) -> np.ndarray | None:
        """Newton's method in the plane through the guess; None where it does not settle."""
        y = guess.copy()
        for _ in range(12):
            value, slopes = self._system(y)
            matrix = np.vstack([slopes, normal])
            right = np.append(value, normal @ (y - guess))
            try:
                change = np.linalg.solve(matrix, right)
            except np.linalg.LinAlgError:
                return None
            y = y - change
            if not np.all(np.isfinite(y)):
                return None
            if np.max(np.abs(change)) < 1e-12:
                return y
        return y if np.max(np.abs(change)) < 1e-8 else None

    def _follow(self, y: np.ndarray, tangent: np.ndarray) -> list[np.ndarray]:
        """Points along the curve until it leaves the region or closes."""
        points: list[np.ndarray] = []
        first, step, travelled = y, self.STEP, 0.0
        while len(points) < self.LIMIT:
            new = self._corrected(y + step * tangent, tangent)
            turned = None if new is None else self._tangent(new, tangent)
            if turned is None or turned @ tangent < 0.96 or np.linalg.norm(new - y) > 2 * step:
                step *= 0.5
                if step < 1e-6:
                    break
                continue
            if not self.family.inside(new[:-1] * self.width[:-1], float(new[-1] * self.width[-1])):
                edge = self._to_edge(y, new, tangent)
                points += [] if edge is None else [edge]
                break
            points.append(new)
            travelled += float(np.linalg.norm(new - y))
            y, tangent = new, turned
            step = min(1.5 * step, self.STEP)
            if travelled > 4 * self.STEP and np.linalg.norm(y - first) < 0.6 * self.STEP:
                points.append(first)
                break
        return points

    def _to_edge(self, inside: np.ndarray, outside: np.ndarray, tangent: np.ndarray) -> np.ndarray | None:
        """The last point of the curve within the region, by bisection along the tangent."""
        low, high, best = 0.0, float(np.linalg.norm(outside - inside)), None
        for _ in range(40):
            middle = 0.5 * (low + high)
            y = self._corrected(inside + middle * tangent, tangent)
            if y is not None and self.family.inside(y[:-1] * self.width[:-1], float(y[-1] * self.width[-1])):
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
        for curve in self.curves:
            points = np.array([np.append(z, at) for at, z in curve]) / self.width
            a, b = points[:-1], points[1:]
            turns = np.append(self.family.periodic, False) * np.round(y - a)  # a whole turn away is the same place
            away, along = y - turns - a, b - a
            share = np.clip(np.sum(away * along, axis=1) / np.maximum(np.sum(along**2, axis=1), 1e-300), 0, 1)
            if np.min(np.linalg.norm(share[:, None] * along - away, axis=1)) < 2e-3:
                return True
        return False

    # Singular points

    def _look_for_singular(self, points: Sequence[np.ndarray]) -> None:
        """Locate folds (λ turns) and branch points (the extended determinant changes sign) on a curve."""
        tangent, tests = points[1] - points[0], []
        for y in points:
            tangent = self._tangent(y, tangent)
            tests.append((tangent, self._tests(y, tangent)))
        for i in range(len(points) - 1):
            tangent, before = tests[i]
            for which in (1, 0):  # a branch point may turn as well: look for it first
                if before[which] * tests[i + 1][1][which] < 0:
                    self._record(self._located(points[i], points[i + 1], tangent, which))
                    break

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
            if here is None:  # on the branch point itself the corrector has no unique answer
                return best
            best = here
            if np.sign(self._tests(here, self._tangent(here, tangent))[which]) == sign:
                low = middle
            else:
                high = middle
        return best

    def _record(self, y: np.ndarray) -> None:
        """Classify a singular point, and follow the other curve through it."""
        at, z = float(y[-1] * self.width[-1]), y[:-1] * self.width[:-1]
        for _, known_at, known_z in self.singular:
            if np.linalg.norm((np.append(known_z, known_at) - np.append(z, at)) / self.width) < 1e-4:
                return
        kind, directions = self._classified(y)
        self.singular.append((kind, at, z))
        for direction in directions:
            self._switch(y, direction)

    def _classified(self, y: np.ndarray) -> tuple[str, list[np.ndarray]]:
        """Fold, transcritical or pitchfork by the left and right null vectors, and the tangents there."""
        n = len(y) - 1
        slopes = self._system(y)[1]
        left, _, right = np.linalg.svd(slopes[:, :n])
        w, v = left[:, -1], right[-1]
        if abs(w @ slopes[:, n]) > 1e-5:
            return "fold", []
        basis = np.linalg.svd(slopes)[2][-2:]
        h = 1e-4

        def second(a: np.ndarray, b: np.ndarray) -> float:
            parts = [(s * t) * (w @ self._system(y + h * (s * a + t * b))[0]) for s in (1, -1) for t in (1, -1)]
            return float(sum(parts)) / (4 * h * h)

        a, b, c = second(basis[0], basis[0]), second(basis[0], basis[1]), second(basis[1], basis[1])
        directions = []
        for p, q in _quadratic_directions(a, 2 * b, c):
            direction = p * basis[0] + q * basis[1]
            directions.append(direction / np.linalg.norm(direction))
        curvature = second(np.append(v, 0.0), np.append(v, 0.0))
        size = max(abs(a), abs(b), abs(c), 1e-300)
        return ("pitchfork" if abs(curvature) < 1e-3 * size else "transcritical"), directions

    def _switch(self, y: np.ndarray, direction: np.ndarray) -> None:
        """Start along a tangent of a branch point, in both senses, where that curve is not known."""
        for sense in (direction, -direction):
            for length in (0.2 * self.STEP, 0.6 * self.STEP):
                new = self._corrected(y + length * sense, sense)
                if new is None or self._on_curve_near(new):
                    continue
                if not self.family.inside(new[:-1] * self.width[:-1], float(new[-1] * self.width[-1])):
                    continue
                points = [y, new, *self._follow(new, self._tangent(new, sense))]
                self.curves.append([(p[-1] * self.width[-1], p[:-1] * self.width[:-1]) for p in points])
                self._look_for_singular(points[1:])
                break

    def _on_curve_near(self, y: np.ndarray) -> bool:
        return self._known(y)


def _quadratic_directions(a: float, b: float, c: float) -> list[tuple[float, float]]:
    """Real solutions (p, q) of a p² + b p q + c q² = 0, up to scale."""
    size = max(abs(a), abs(b), abs(c))
    if size == 0:
        return []
    if abs(a) < 1e-9 * size:
        return [(1.0, 0.0), (-c, b)] if b else [(1.0, 0.0)]
    discriminant = b * b - 4 * a * c
    if discriminant < 0:
        return []
    root = np.sqrt(discriminant)
    return [((-b + root) / (2 * a), 1.0), ((-b - root) / (2 * a), 1.0)]
