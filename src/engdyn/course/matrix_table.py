"""The matrix of systems and analyses as a table for the terminal."""

from __future__ import annotations

from rich.table import Table
from rich.text import Text

from engdyn.course.matrix import Cell, Matrix
from engdyn.course.matrix_checks import CHECKS
from engdyn.errors import EngdynError
from engdyn.systems.library import load

__all__ = ["matrix_table", "summary"]

MARKS = {"passed": ("✓", "green"), "failed": ("✗ failed", "bold red"), "not built": ("· not built", "dim")}
"""Shape and word carry the meaning, not the color alone."""


def matrix_table(matrix: Matrix) -> Table:
    """One row a system: a mark for each analysis, or, of a single analysis, what was found and in what time.

    Parameters
    ----------
    matrix : Matrix
    """
    names = list(dict.fromkeys(cell.analysis for cell in matrix.cells))
    table = Table(box=None, pad_edge=False)
    table.add_column("")
    rows: dict[str, list[Cell]] = {}
    for cell in matrix.cells:
        rows.setdefault(cell.system, []).append(cell)
    if len(names) == 1:
        for heading in ("system", CHECKS[names[0]][0], "result"):
            table.add_column(heading)
        table.add_column("seconds", justify="right")
        for label, (cell,) in rows.items():
            table.add_row(label, _title(label), _mark(cell), cell.detail, f"{cell.seconds:.2f}")
        return table
    for name in names:
        table.add_column(CHECKS[name][0])
    for label, cells in rows.items():
        table.add_row(label, *(_mark(cell) for cell in cells))
    return table


def _mark(cell: Cell) -> Text:
    mark, look = MARKS[cell.status]
    return Text(mark, look)


def _title(label: str) -> str:
    try:
        return load(label).title
    except EngdynError:  # a system of one's own
        return ""


def summary(matrix: Matrix) -> list[str]:
    """What failed, one line each, and the count of cells by what became of them.

    Parameters
    ----------
    matrix : Matrix
    """
    lines = [
        f"{cell.system} {cell.analysis}: {cell.detail}" for cell in matrix.cells if cell.status == "failed"
    ]
    counts = {status: sum(cell.status == status for cell in matrix.cells) for status in MARKS}
    total = sum(cell.seconds for cell in matrix.cells)
    return [*lines, ", ".join(f"{n} {status}" for status, n in counts.items() if n) + f"; {total:.1f} s"]
