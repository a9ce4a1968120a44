"""Undamped modes: natural frequencies, shapes, shares of energy, nodes.  Course sections 6.1 to 6.3 and 6.5."""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
import scipy.linalg

from engdyn.analysis.linear import LinearSystem
from engdyn.analysis.undamped import checked_squares, sizes, undamped_matrices
from engdyn.errors import EngdynError, EngdynWarning

__all__ = ["Modes", "canonical", "leading", "modes"]

EQUAL = 1e-9
"""Squares of ω this close belong to one frequency."""

SMALL = 1e-9
"""A part of a shape below this share of the others is zero."""


@dataclass(frozen=True, eq=False, repr=False)
class Modes:
    """Undamped modes of M ẍ + K x = 0, by rising frequency.

    Attributes
    ----------
    natural_frequency : ndarray, shape (n,)
        [Hz]; exactly 0 for rigid-body modes.
    shapes : ndarray, shape (n, n)
        One column a mode, mass-normalized: ΦᵀMΦ = I. The largest component, as energies measure it, is
        positive. In a group any other basis would do as well; this one keeps close to the coordinates.
    groups : tuple of tuples of int
        Modes with one frequency: only the subspace that their shapes span is determined.
    linear : LinearSystem
        What the modes belong to.
    """

    natural_frequency: np.ndarray
    shapes: np.ndarray
    groups: tuple[tuple[int, ...], ...]
    linear: LinearSystem

    @property
    def coordinates(self) -> tuple[str, ...]:
        """Names of the rows of the shapes."""
        return self.linear.coordinates

    @property
    def modal_mass(self) -> np.ndarray:
        """ΦᵀMΦ, the unit matrix."""
        return self._modal(self.linear.mass)

    @property
    def modal_stiffness(self) -> np.ndarray:
        """ΦᵀKΦ [1/s²], the squares of ω on its diagonal."""
        return self._modal(self.linear.stiffness)

    @property
    def modal_damping(self) -> np.ndarray:
        """ΦᵀCΦ [1/s].

        On the diagonal stand the damping constants 2ζω; those of rigid-body modes are constants too,
        while a ratio ζ would divide by ω = 0. What is off the diagonal couples the modes.
        """
        return self._modal(self.linear.damping)

    def _modal(self, matrix: np.ndarray) -> np.ndarray:
        return self.shapes.T @ matrix @ self.shapes

    @cached_property
    def energy_share(self) -> np.ndarray:
        """Share of each coordinate (row) in the energy of each mode (column); columns sum to 1.

        The share φᵢ (Mφ)ᵢ / φᵀMφ of the kinetic energy is that of the potential energy, too, because
        Kφ = ω²Mφ. Shares compare translations with rotations whatever the units are. Where coordinates
        are coupled by their masses a share may be negative.
        """
        parts = self.shapes * (self.linear.mass @ self.shapes)
        return parts / parts.sum(axis=0)

    def normalized(self, rule: str = "mass") -> np.ndarray:
        """Shapes in one of the usual scales, shape (n, n).

        Parameters
        ----------
        rule : str
            ``"mass"``: ΦᵀMΦ = I. ``"max"``: the component of largest magnitude is 1. ``"unit"``: columns of
            Euclidean length 1. Or the name of a coordinate, whose component becomes 1. ``"max"`` and
            ``"unit"`` add meters to radians where a system has both: ratios within a column are all they say.

        Raises
        ------
        EngdynError
            Another rule; a coordinate that is at rest in a mode.
        """
        if not isinstance(rule, str):
            raise EngdynError(f"rule is {rule!r}: choose mass, max, unit or a coordinate")
        if rule == "mass":
            return self.shapes.copy()
        if rule == "max":
            largest = np.argmax(np.abs(self.shapes), axis=0)
            return self.shapes / self.shapes[largest, np.arange(len(largest))]
        if rule == "unit":
            return self.shapes / np.linalg.norm(self.shapes, axis=0)
        row = self.shapes[self._row(rule, "rule", "mass, max, unit, ")]
        weighted = np.abs(self.shapes) * sizes(self.linear)[:, None]
        resting = np.flatnonzero(
            np.abs(row) * sizes(self.linear)[self.coordinates.index(rule)] <= SMALL * weighted.max(axis=0)
        )
        if len(resting):
            raise EngdynError(
                f"{rule} is at rest in mode {resting[0] + 1}: choose a coordinate that moves in every mode"
            )
        return self.shapes / row

    def nodes(
        self,
        translation: str | None = None,
        rotation: str | None = None,
        *,
        chain: Sequence[str] | None = None,
        places: Sequence[float] | None = None,
    ) -> Any:
        """Nodes: what stays at rest in a mode.

        Parameters
        ----------
        translation, rotation : str, optional
            Coordinates of a rigid body in the plane: displacement y of its reference point across the body,
            and its angle θ. The node is the instantaneous center, on the body or off it.
        chain : sequence of str, optional
            Without these: the coordinates of a chain in their order, default all of them.
        places : sequence of float, optional
            Where along the chain they are; default 0, 1, 2, …

        Returns
        -------
        ndarray, shape (n,)
            Of a body: position −y/θ [m] along it, from the reference point; inf in a mode in which it
            does not rotate, NaN in one in which it does not move at all.
        tuple of ndarray
            Of a chain: for each mode the places where its straight-line interpolation crosses zero.

        Raises
        ------
        EngdynError
            Unknown coordinates, a translation without a rotation, places that do not fit.

        Notes
        -----
        Course section 6.3. Nodes do not depend on the scale of a shape. In a group of equal frequencies
        they are those of one choice among many: a warning says so.
        """
        if any(len(group) > 1 for group in self.groups):
            warnings.warn(
                "modes with equal frequencies have no shapes of their own, so their nodes are those of one "
                "choice among many",
                EngdynWarning,
                stacklevel=2,
            )
        if translation is None and rotation is None:
            return self._chain_nodes(self.coordinates if chain is None else chain, places)
        if translation is None or rotation is None or chain is not None or places is not None:
            raise EngdynError(
                "nodes of a body need its translation and its rotation, nodes of a chain only chain and places"
            )
        return self._centers(self._row(translation, "translation"), self._row(rotation, "rotation"))

    def _centers(self, translation: int, rotation: int) -> np.ndarray:
        size = sizes(self.linear)
        y, theta = self.shapes[translation], self.shapes[rotation]
        speed, turn = np.abs(y) * size[translation], np.abs(theta) * size[rotation]
        total = np.max(np.abs(self.shapes) * size[:, None], axis=0)
        turns, moves = turn > SMALL * np.maximum(speed, SMALL * total), speed > SMALL * total
        quotient = -y / np.where(turns, theta, 1.0) + 0.0
        return np.where(turns, quotient, np.where(moves, np.inf, np.nan))

    def _chain_nodes(self, chain: Sequence[str], places: Sequence[float] | None) -> tuple[np.ndarray, ...]:
        if isinstance(chain, str) or not isinstance(chain, Sequence) or not chain:
            raise EngdynError(f"chain is {chain!r}: give the names of one or more coordinates in their order")
        rows = self.shapes[[self._row(name, "chain") for name in chain]]
        try:
            at = np.arange(len(rows), dtype=float) if places is None else np.array(places, dtype=float)
        except (TypeError, ValueError):
            at = np.full(0, np.nan)
        if at.shape != (len(rows),) or not np.all(np.isfinite(at)):
            raise EngdynError(
                f"places is {places!r}: give {len(rows)} numbers, one for each of {', '.join(chain)}"
            )
        found = []
        for column in rows.T:
            v = np.where(np.abs(column) <= SMALL * np.max(np.abs(column)), 0.0, column)
            i = np.flatnonzero(v[:-1] * v[1:] < 0)
            crossings = at[i] + (at[i + 1] - at[i]) * v[i] / (v[i] - v[i + 1])
            found.append(np.sort(np.concatenate([at[v == 0], crossings])))
        return tuple(found)

    def _row(self, name: str, argument: str, others: str = "") -> int:
        if not isinstance(name, str) or name not in self.coordinates:
            raise EngdynError(f"{argument} is {name!r}: choose one of {others}{', '.join(self.coordinates)}")
        return self.coordinates.index(name)

    def __repr__(self) -> str:
        return f"Modes({', '.join(f'{f:.5g}' for f in self.natural_frequency)} Hz; {', '.join(self.coordinates)})"

    def _repr_html_(self) -> str:
        def line(name: str, row: np.ndarray, form: str) -> str:
            return f"<tr><th>{name}</th>{''.join(f'<td>{x + 0.0:{form}}</td>' for x in row)}</tr>"

        shapes = "".join(line(q, row, ".4g") for q, row in zip(self.coordinates, self.shapes, strict=True))
        shares = "".join(
            line(f"{q}, share of energy", row, ".1%")
            for q, row in zip(self.coordinates, self.energy_share, strict=True)
        )
        head = "".join(f"<th>mode {k + 1}</th>" for k in range(len(self.natural_frequency)))
        frequency = line("natural frequency [Hz]", self.natural_frequency, ".5g")
        return f"<table><tr><th></th>{head}</tr>{frequency}{shapes}{shares}</table>"


def modes(linear: LinearSystem) -> Modes:
    """Undamped modes of a linearized system; symmetric damping is left out of account.

    Parameters
    ----------
    linear : LinearSystem
        With numbers.

    Returns
    -------
    Modes

    Raises
    ------
    EngdynError
        Gyroscopic, circulatory or nonholonomic systems (use `damped_modes`); statically unstable ones; a mass
        matrix that is not positive definite.

    Notes
    -----
    Course section 6.1. Solves K φ = ω² M φ by Cholesky's factors of M and an orthogonal method (G. Peters and
    J. H. Wilkinson, Computer Journal 12 (1969) 398), which keeps shapes orthogonal also where frequencies
    are equal.
    """
    mass, stiffness = undamped_matrices(linear)
    squares, shapes = scipy.linalg.eigh(stiffness, mass)
    squares, size = checked_squares(squares), sizes(linear)
    splits = np.flatnonzero(np.diff(squares) > EQUAL * squares[1:]) + 1
    groups = tuple(tuple(int(i) for i in group) for group in np.split(np.arange(len(squares)), splits))
    for group in groups:
        if len(group) > 1:
            shapes[:, group] = shapes[:, group] @ canonical(shapes[:, group].T @ mass / size)
    row, column = leading(shapes * size[:, None]), np.arange(len(squares))
    return Modes(np.sqrt(squares) / (2 * np.pi), shapes * np.sign(shapes[row, column]), groups, linear)


def canonical(components: np.ndarray) -> np.ndarray:
    """Turn (unitary) of a basis, given its components as rows, so that the first ones are along coordinates."""
    return scipy.linalg.qr(components, pivoting=True, mode="economic")[0]


def leading(weighted: np.ndarray) -> np.ndarray:
    """Row of the largest component of each column; of almost equal ones the first."""
    size = np.abs(weighted)
    return np.argmax(size >= (1 - 1e-6) * size.max(axis=0), axis=0)
