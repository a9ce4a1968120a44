"""Equilibria as results: one of them, and all that a search found.  Course chapter 4."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from engdyn.analysis.enclosure import Certificate

if TYPE_CHECKING:
    from engdyn.modeling.equations import EquationsOfMotion

__all__ = ["Equilibrium", "EquilibriumSet"]


@dataclass(frozen=True, eq=False)
class Equilibrium:
    """One equilibrium or steady motion.

    Attributes
    ----------
    q : ndarray, shape (n,)
        Coordinates [m, rad]; neutral ones are reported as zero.
    speeds : ndarray, shape (m,)
        Constant speeds u [m/s, rad/s].
    accelerations : ndarray, shape (m,)
        Constant accelerations u̇ [m/s², rad/s²].
    inputs : dict
        Inputs by name, those solved for included.
    values : dict
        Parameters by name [SI].
    residual : float
        Largest magnitude of M u̇ − f there: zero up to rounding [N, N m].
    names : tuple of str
        Names of the coordinates.
    regular : (EquationsOfMotion, Equilibrium), optional
        The same state in coordinates that are regular there, with their equations, where `q` is a
        coordinate singularity: small motion is described in these.
    """

    q: np.ndarray
    speeds: np.ndarray
    accelerations: np.ndarray
    inputs: dict[str, Any]
    values: dict[str, float]
    residual: float
    names: tuple[str, ...]
    regular: tuple[EquationsOfMotion, Equilibrium] | None = field(default=None, repr=False)

    def __repr__(self) -> str:
        parts = [f"{name} = {_digits(x)}" for name, x in zip(self.names, self.q, strict=True)]
        moving = [f"{name}' = {_digits(x)}" for name, x in zip(self.names, self.speeds, strict=False) if x]
        moving += [
            f"{name}'' = {_digits(x)}" for name, x in zip(self.names, self.accelerations, strict=False) if x
        ]
        return f"Equilibrium({', '.join([*parts, *moving])})"


def _digits(x: float) -> str:
    return f"{0.0 if abs(x) < 1e-12 else x:.5g}"


def _residual(x: float) -> str:
    """Rounding differs from machine to machine, so it is not spelled out."""
    return "&lt; 1e-9" if x < 1e-9 else f"{x:.1e}"


@dataclass(frozen=True, eq=False, repr=False)
class EquilibriumSet(Sequence):
    """All equilibria that a search found, and whether they are provably all.

    Attributes
    ----------
    certified : bool
        Whether the search proves that there is no other equilibrium in the region.
    undecided : tuple of boxes
        Boxes about which the search could not decide (a bifurcation point, for example).
    certificate : Certificate or None
        The boxes and the proof; None where the equations were solved in closed form.
    unknowns : tuple of str
        What the boxes' sides are.
    neutral : tuple of str
        Coordinates that nothing depends on: every value of them is an equilibrium.
    explanation : str
        Why there is no equilibrium, where there is none.
    """

    items: tuple[Equilibrium, ...]
    certificate: Certificate | None = None
    unknowns: tuple[str, ...] = ()
    neutral: tuple[str, ...] = ()
    explanation: str = ""
    names: tuple[str, ...] = field(default=())

    @cached_property
    def certified(self) -> bool:
        """Whether all equilibria of the region are provably in this set."""
        return self.certificate is None or self.certificate.certified

    @property
    def undecided(self) -> tuple:
        """Boxes about which nothing is claimed."""
        return () if self.certificate is None else self.certificate.undecided

    def __len__(self) -> int:
        return len(self.items)

    def __getitem__(self, index: Any) -> Any:
        return self.items[index]

    def __iter__(self) -> Iterator[Equilibrium]:
        return iter(self.items)

    @property
    def _count(self) -> str:
        return f"{len(self)} equilibri{'um' if len(self) == 1 else 'a'}"

    @property
    def _claim(self) -> str:
        if self.explanation:
            return self.explanation
        if self.certified:
            return "certified: there are no others in the region"
        count = len(self.undecided)
        return f"not certified: {count} {'box is' if count == 1 else 'boxes are'} undecided"

    def __repr__(self) -> str:
        count = f"{self._count} ({self._claim})"
        neutral = (
            [f"  neutral: {', '.join(self.neutral)} (reported as 0)"] if self.neutral and len(self) else []
        )
        return "\n".join([count, *(f"  {item!r}" for item in self), *neutral])

    def _repr_html_(self) -> str:
        head = "".join(f"<th>{name}</th>" for name in self.names)
        rows = "".join(
            "<tr>"
            + "".join(f"<td>{_digits(x)}</td>" for x in item.q)
            + f"<td>{_residual(item.residual)}</td></tr>"
            for item in self
        )
        neutral = f"; neutral: {', '.join(self.neutral)}" if self.neutral else ""
        return (
            f"<table><caption>{self._count} ({self._claim}){neutral}</caption>"
            f"<thead><tr>{head}<th>residual</th></tr></thead><tbody>{rows}</tbody></table>"
        )
