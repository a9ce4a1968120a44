"""One equilibrium, followed over a plane of two parameters, all points of a front at once.  Course section 5.5."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from sympy.physics.vector import dynamicsymbols

from engdyn.algebra.codegen import compile_elements
from engdyn.algebra.conversion import Converter
from engdyn.algebra.expressions import as_expression
from engdyn.analysis.results import Equilibrium
from engdyn.analysis.small_motion import compiled_blocks, unpacked
from engdyn.errors import EngdynError
from engdyn.modeling.equations import EquationsOfMotion
from engdyn.modeling.numbers import input_values, parameter_values

__all__ = ["Follower"]

STEPS, APPROACH, ITERATIONS = (1, 8, 64), 64, 8
"""Steps from one point to its neighbor (more where one fails), steps from the start to the grid, Newton steps each."""

WISH = 1e-8
"""Weight of what is kept only where nothing speaks against it."""

CLOSE = 1e-8
"""A residual counts as zero where a displacement of this size [m, rad] would make it."""


class Follower:
    """State of an equilibrium as its parameters change, in arrays.

    Parameters
    ----------
    eom : EquationsOfMotion
    at : Equilibrium
        Where to start. Inputs, accelerations and the proportions of rates stay as they are there.
    values : mapping of str to float
        Parameters by name [SI].
    names : (str, str)
        The two that vary.
    """

    def __init__(
        self, eom: EquationsOfMotion, at: Equilibrium, values: Mapping[str, float], names: tuple[str, str]
    ):
        self._eom, self._at, self._names = eom, at, names
        self._values = dict(values)
        self._n = len(eom.coordinates)
        self._parameters = parameter_values(eom, values)
        self._places = [[p.name for p in eom.parameters].index(name) for name in names]
        self._defaults = {
            place: _compiled(eom, eom.defaults[w])
            for place, w in enumerate(eom.inputs)
            if w in eom.defaults and w.func.__name__ not in at.inputs
        }
        held = [np.ravel(at.inputs.get(w.func.__name__, 0.0))[0] for w in eom.inputs]
        self._loads = abs(np.array(held, dtype=float))
        state = np.concatenate([at.q, at.speeds]).astype(float)
        self._rates = self._residuals(state[None], np.array([self.start]))[0, : self._n]

    @property
    def start(self) -> tuple[float, float]:
        """The two parameters where `at` is an equilibrium."""
        return tuple(float(self._at.values.get(name, self._values[name])) for name in self._names)

    def arguments(self, states: np.ndarray, points: np.ndarray) -> list[Any]:
        """What compiled functions take before u̇: q, u, parameters, inputs, t; arrays of shape (N,) or numbers."""
        numbers: list[Any] = list(self._parameters)
        for place, column in zip(self._places, points.T, strict=True):
            numbers[place] = column
        return [*states.T, *numbers, *self._inputs(numbers), 0.0]

    def _inputs(self, numbers: list[Any]) -> list[Any]:
        """Inputs as given; those with a default, such as a drive angle Omega*t, follow the parameters."""
        found: list[Any] = input_values(self._eom, self._at.inputs, self._values)
        for place, default in self._defaults.items():
            found[3 * place : 3 * place + 3] = default(*numbers, 0.0)
        return found

    def blocks(self, states: np.ndarray, points: np.ndarray) -> dict[str, np.ndarray]:
        """Blocks of small motion, shape (N, rows, columns)."""
        arguments = [*self.arguments(states, points), *map(float, self._at.accelerations)]
        with np.errstate(all="ignore"):
            return unpacked(self._eom, stacked(compiled_blocks(self._eom, "numpy")(*arguments), len(points)))

    def _residuals(self, states: np.ndarray, points: np.ndarray) -> np.ndarray:
        """Rates q̇ and M u̇ − f, shape (N, n + m): all zero at rest."""
        m = len(self._eom.speeds)
        with np.errstate(all="ignore"):
            flat = stacked(self._eom.compiled("numpy")(*self.arguments(states, points)), len(points))
        mass, force, rates = np.split(flat, [m * m, m * m + m], axis=1)
        inertia = mass.reshape(-1, m, m) @ np.asarray(self._at.accelerations, dtype=float)
        return np.concatenate([rates, inertia - force], axis=1)

    def _unbalanced(
        self, states: np.ndarray, points: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Residuals of steady motion, their derivatives, and whether each is zero as far as rounding tells.

        Rates keep their proportions. A last row asks softly for their magnitude: inputs may need another one.
        """
        n, found, blocks = self._n, self._residuals(states, points), self.blocks(states, points)
        rows = [np.concatenate([blocks[a], blocks[b]], axis=-1) for a, b in (("Gq", "G"), ("K", "C"))]
        slopes = np.concatenate(rows, axis=1)
        length = np.linalg.norm(self._rates)
        along = self._rates / (length or 1.0)
        excess, change = found[:, :n] @ along, along @ slopes[:, :n]
        found[:, :n] -= excess[:, None] * along
        slopes[:, :n] -= along[:, None] * change[:, None, :]
        forces = found[:, n:]  # those that held inputs balance but for rounding are zero
        forces[abs(forces) <= 1e-12 * (abs(blocks["B0"]) @ self._loads)] = 0.0
        balanced = np.all(abs(found) <= CLOSE * abs(slopes).sum(axis=2) + 1e-300, axis=1)
        if length:
            found = np.concatenate([found, excess[:, None] - length], axis=1)
            slopes = np.concatenate([slopes, change[:, None, :]], axis=1)
        return found, slopes, balanced

    def settle(self, states: np.ndarray, points: np.ndarray) -> np.ndarray:
        """Newton's method from states near an equilibrium; NaN where it does not contract to one."""
        states, last = states.copy(), np.full(len(states), np.inf)
        active = np.flatnonzero(np.isfinite(states).all(axis=1))
        for _ in range(ITERATIONS):
            if not len(active):
                return states
            found, slopes, balanced = self._unbalanced(states[active], points[active])
            step = _solved(slopes, found)
            size = abs(step).max(axis=1)
            # Steps that do not shrink lead elsewhere: to another equilibrium, or to none.
            lost = ~(size <= np.maximum(0.7 * last[active], 1e-12)) & ~balanced
            states[active] = np.where(lost[:, None], np.nan, states[active] - step)
            last[active] = size
            done = balanced & (size <= 1e-10 * (1 + abs(states[active]).max(axis=1)))
            active = active[~done & ~lost]
        states[active] = np.where(
            self._unbalanced(states[active], points[active])[2][:, None], states[active], np.nan
        )
        return states

    def move(self, states: np.ndarray, start: np.ndarray, end: np.ndarray, steps: int) -> np.ndarray:
        """States at the points `end`, shape (N, 2), from those at `start`; NaN where the branch ends on the way."""
        stride = (end - start) / steps
        for _ in range(steps):
            ahead = self.settle(states, start + stride)
            states = np.where(self._leads_back(ahead, states, start)[:, None], ahead, np.nan)
            start = start + stride
        return states

    def _leads_back(self, ahead: np.ndarray, behind: np.ndarray, place: np.ndarray) -> np.ndarray:
        """Whether a Newton step from the states ahead leads to those behind, as it does on one smooth branch.

        It does not where the branch has ended in between (at a fold, a pitchfork) and another one was met.
        """
        found, slopes, _ = self._unbalanced(ahead, place)
        missed = abs(ahead - _solved(slopes, found) - behind).max(axis=1)
        return missed <= 0.5 * abs(ahead - behind).max(axis=1) + 1e-9 * (1 + abs(behind).max(axis=1))

    def over(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """States on the grid, shape (len(y), len(x), n + m); NaN where the equilibrium has ceased to exist.

        Raises
        ------
        EngdynError
            There is no equilibrium where to start.
        """
        points = np.stack(np.meshgrid(x, y), axis=-1)
        state = np.concatenate([self._at.q, self._at.speeds]).astype(float)
        everywhere = np.broadcast_to(state, (*points.shape[:2], len(state))).copy()
        flat = everywhere.reshape(-1, len(state)), points.reshape(-1, 2)
        if not self._residuals(*flat).any() or self._unbalanced(*flat)[2].all():
            return everywhere
        states = np.full_like(everywhere, np.nan)
        j, i = (int(np.argmin(abs(array - at))) for array, at in zip((y, x), self.start[::-1], strict=True))
        begin = np.array([self.start])
        first = self.settle(state[None], begin)
        if np.isnan(first).any():
            raise EngdynError(
                f"{self._at!r} is no equilibrium for these values: give one that equilibria has found"
            )
        states[j, i] = self.move(first, begin, points[j, i][None], APPROACH)[0]
        for steps in STEPS:
            self._fill(states, points, steps)
        return states

    def _fill(self, states: np.ndarray, points: np.ndarray, steps: int) -> None:
        """Spread from the points that are known to their neighbors, until no further one is reached."""
        tried = np.zeros((4, *states.shape[:2]), dtype=bool)
        while True:
            before = np.isfinite(states[..., 0]).sum()
            for way, (down, right) in enumerate([(0, 1), (0, -1), (1, 0), (-1, 0)]):
                known = np.isfinite(states[..., 0])
                source = np.roll(known, (down, right), axis=(0, 1))
                if down:
                    source[0 if down > 0 else -1] = False
                else:
                    source[:, 0 if right > 0 else -1] = False
                rows, columns = np.nonzero(source & ~known & ~tried[way])
                tried[way][rows, columns] = True
                if len(rows):
                    near = rows - down, columns - right
                    states[rows, columns] = self.move(
                        states[near], points[near], points[rows, columns], steps
                    )
            if np.isfinite(states[..., 0]).sum() == before:
                return


def _compiled(eom: EquationsOfMotion, default: tuple[Any, Any, Any]) -> Callable[..., tuple]:
    """Value, rate and acceleration of an input as a function of arrays of parameters, and of time."""
    keys = [("symbol", s) for s in (*eom.parameters, dynamicsymbols._t)]
    parts = [as_expression(part) for part in default]
    converter = Converter(parts, keys)
    return compile_elements([converter.convert(part) for part in parts], keys, "numpy")


def stacked(flat: Any, count: int) -> np.ndarray:
    """Numbers and arrays that compiled code returned as one array, shape (count, number of entries)."""
    return np.stack([np.broadcast_to(np.asarray(x, dtype=float), (count,)) for x in flat], axis=-1)


def _solved(slopes: np.ndarray, found: np.ndarray) -> np.ndarray:
    """Newton steps; the shortest ones where neutral coordinates leave them open."""
    scale = abs(slopes).max(axis=2, keepdims=True)
    scale = np.where(np.isfinite(scale) & (scale > 0), scale, 1.0)
    slopes, found = slopes / scale, found[..., None] / scale
    bad = ~np.isfinite(slopes).all(axis=(1, 2)) | ~np.isfinite(found).all(axis=(1, 2))
    slopes[bad], found[bad] = 0.0, np.nan
    rows, size = slopes.shape[1:]
    if rows > size:  # the last row is a wish
        slopes[:, -1] *= WISH
        found[:, -1] *= WISH
        return (np.linalg.pinv(slopes, rcond=1e-12) @ found)[..., 0]
    singular = abs(np.linalg.det(slopes)) < 1e-12
    step = np.empty_like(found)
    step[~singular] = np.linalg.solve(slopes[~singular], found[~singular])
    step[singular] = np.linalg.pinv(slopes[singular], rcond=1e-10) @ found[singular]
    return step[..., 0]
