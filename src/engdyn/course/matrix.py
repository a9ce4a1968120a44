"""All systems through all analyses, each cell a check of its own: ``engdyn matrix``.  Appendix A."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Sequence
from dataclasses import asdict, dataclass
from typing import Any

from engdyn.course.matrix_checks import CHECKS
from engdyn.errors import EngdynError
from engdyn.system import System
from engdyn.systems.library import catalogue, load

__all__ = ["Cell", "Matrix", "matrix"]

PASSED, FAILED, MISSING = "passed", "failed", "not built"


@dataclass(frozen=True)
class Cell:
    """One analysis of one system.

    Attributes
    ----------
    system, analysis : str
        ``"S07"``, ``"equilibria"``.
    status : {"passed", "failed", "not built"}
    detail : str
        What was found, or why it failed.
    seconds : float
        How long it took.
    """

    system: str
    analysis: str
    status: str
    detail: str
    seconds: float


@dataclass(frozen=True)
class Matrix:
    """The cells of all systems and analyses asked for.

    Attributes
    ----------
    cells : tuple of Cell
        System by system.
    sabotaged : bool
        Whether every check was given a corrupted input.
    """

    cells: tuple[Cell, ...]
    sabotaged: bool

    @property
    def right(self) -> bool:
        """Nothing failed; of a sabotaged matrix, nothing passed."""
        unwanted = PASSED if self.sabotaged else FAILED
        return all(cell.status != unwanted for cell in self.cells)

    def as_dict(self) -> dict[str, Any]:
        """The matrix as plain data for ``--json``."""
        return {
            "right": self.right,
            "sabotaged": self.sabotaged,
            "cells": [asdict(cell) | {"seconds": round(cell.seconds, 3)} for cell in self.cells],
        }


def matrix(
    systems: Iterable[str | int | System] = (),
    only: Sequence[str] = (),
    sabotage: bool = False,
    progress: Callable[[Cell], Any] | None = None,
) -> Matrix:
    """Take systems through the analyses of the course and check every result.

    Parameters
    ----------
    systems : iterable of str, int or System
        All of the catalogue if none are given.
    only : sequence of str
        Names of analyses; all if none are given.
    sabotage : bool
        Corrupt what each check works on: a check worth its name must fail then.
    progress : callable, optional
        Called with each cell as soon as it is known.

    Returns
    -------
    Matrix

    Raises
    ------
    EngdynError
        Unknown analysis; UnknownSystemError for a system.
    """
    for name in only:
        if name not in CHECKS:
            raise EngdynError(f"there is no analysis {name!r}; choose from {', '.join(CHECKS)}")
    names = [name for name in CHECKS if name in only or not only]
    chosen = [s if isinstance(s, System) else load(s) for s in systems or catalogue().index]
    cells = []
    for system in chosen:
        for name in names:
            cells.append(_cell(system, name, sabotage))
            if progress is not None:
                progress(cells[-1])
    return Matrix(tuple(cells), sabotage)


def _cell(system: System, name: str, sabotage: bool) -> Cell:
    label = f"S{system.number:02d}" if system.number else system.key
    check = CHECKS[name][1]
    if check is None:
        return Cell(label, name, MISSING, "this analysis is not built yet", 0.0)
    start = time.perf_counter()
    try:
        status, detail = PASSED, check(system, sabotage)
    except (EngdynError, ArithmeticError) as error:
        status, detail = FAILED, str(error)
    return Cell(label, name, status, detail, time.perf_counter() - start)
