"""From the solutions manual to the students' copies.

``solutions/NN_*.ipynb`` is the single source of the exercises; ``exercises/NN_*.ipynb`` is made from
it by these rules and never edited by hand.

- In a code cell, what stands between the lines ``### BEGIN SOLUTION`` and ``### END SOLUTION`` is
  replaced by one stub, ``answer = ...``, so an unanswered exercise still runs.
- Where the answer has another name, or several, the region starts with a line that says so:
  ``### STUB: M, K = ..., ...`` puts ``M, K = ..., ...`` in the student's copy. The stub takes the
  indentation of the marker, so a function body can end with ``### STUB: return ...``. An empty stub
  leaves nothing.
- In a text cell the same markers are replaced by ``*Your answer:*`` or by what its ``### STUB:`` line says.
- A cell with the tag ``solution`` is dropped: the model explanation, a picture of the result.
- All other metadata stay: tags, slides, nbgrader's grade and solution flags.

The names that a stub sets must be set by the solution as well; anything else is refused, since the
cells below would meet a name that the instructor's copy does not have.
"""

from __future__ import annotations

import ast
import copy
import textwrap
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..errors import EngdynError
from .execution import clear_outputs, execute, read_notebook, stale_reason, write_notebook

if TYPE_CHECKING:
    from nbformat import NotebookNode

__all__ = ["SolutionMarkerError", "leaks", "out_of_step", "student_copy", "write_student_copy"]

BEGIN, END, STUB = "### BEGIN SOLUTION", "### END SOLUTION", "### STUB:"
DEFAULT_STUB = {"code": "answer = ...", "markdown": "*Your answer:*"}
SHORTEST_LEAK = 12  # a solution line with fewer characters than this may well occur elsewhere


class SolutionMarkerError(EngdynError):
    """The solution markers of a cell do not pair up, or its stub does not fit its solution."""


def student_copy(solution: NotebookNode) -> NotebookNode:
    """The students' copy of a solutions notebook, without outputs.

    Raises
    ------
    SolutionMarkerError
        If the markers of a cell do not pair up or a stub sets a name that the solution does not.
    """
    student = copy.deepcopy(solution)
    student.cells = [cell for cell in student.cells if not _is_solution_cell(cell)]
    for cell in student.cells:
        if cell.cell_type in DEFAULT_STUB:
            parts = [lines if stub is None else stub for lines, stub in _split(cell)]
            cell.source = "\n".join(line for part in parts for line in part)
    clear_outputs(student)
    student.metadata.pop("engdyn", None)
    return student


def _is_solution_cell(cell: Any) -> bool:
    return "solution" in cell.metadata.get("tags", ())


def _split(cell: Any) -> list[tuple[list[str], list[str] | None]]:
    """A cell as runs of lines, each with the lines of its stub; None for lines that the student sees."""
    parts: list[tuple[list[str], list[str] | None]] = [([], None)]
    begun = ""
    for line in cell.source.split("\n"):
        mark = line.strip()
        if mark in (BEGIN, END) and (mark == BEGIN) == bool(begun):
            raise SolutionMarkerError(f"cell {cell.id}: the markers '{BEGIN}' and '{END}' do not alternate.")
        if mark == BEGIN:
            begun = line
            parts.append(([], []))
        elif mark == END:
            parts[-1] = _with_stub(cell, parts[-1][0], begun)
            parts.append(([], None))
            begun = ""
        else:
            parts[-1][0].append(line)
    if begun:
        raise SolutionMarkerError(f"cell {cell.id}: '{BEGIN}' has no '{END}'.")
    return parts


def _with_stub(cell: Any, lines: list[str], marker: str) -> tuple[list[str], list[str]]:
    stub = DEFAULT_STUB[cell.cell_type]
    if lines and lines[0].strip().startswith(STUB):
        stub = lines[0].strip().removeprefix(STUB).strip()
        lines = lines[1:]
    if cell.cell_type == "code":
        missing = sorted(_names_set(stub) - _names_set("\n".join(lines)))
        if missing:
            raise SolutionMarkerError(
                f"cell {cell.id}: the stub '{stub}' sets {', '.join(missing)}, the solution does not; "
                f"name the answer so, or start the region with a line '{STUB} name = ...'."
            )
    indentation = marker[: len(marker) - len(marker.lstrip())]
    return lines, [indentation + stub] if stub else []


def _names_set(code: str) -> set[str]:
    """Names that a piece of code assigns or defines, at any depth."""
    body = textwrap.indent(textwrap.dedent(code), "    ") + "\n    pass\n"
    try:
        tree = ast.parse("def region():\n" + body)  # a region may hold a return
    except SyntaxError as error:
        raise SolutionMarkerError(
            f"a solution region is no complete piece of Python: {error.msg}."
        ) from error
    names = {
        node.id for node in ast.walk(tree) if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store)
    }
    defined = (ast.FunctionDef, ast.ClassDef)
    return names | {node.name for node in ast.walk(tree) if isinstance(node, defined)} - {"region"}


def solution_lines(solution: NotebookNode) -> Iterator[str]:
    """Every line of a solutions notebook that no student's copy may hold."""
    for cell in solution.cells:
        if _is_solution_cell(cell):
            yield from cell.source.split("\n")
        elif cell.cell_type in DEFAULT_STUB:
            yield from (line for lines, stub in _split(cell) if stub is not None for line in lines)


def leaks(solution: NotebookNode, student: NotebookNode) -> list[str]:
    """Solution lines that appear in a student's copy, in its cells or in their outputs.

    Spaces are ignored, and so are lines with fewer than 12 other characters.
    """
    visible = ["".join(text.split()) for cell in student.cells for text in _texts(cell)]
    found = []
    for line in solution_lines(solution):
        bare = "".join(line.split())
        if len(bare) >= SHORTEST_LEAK and any(bare in text for text in visible):
            found.append(line.strip())
    return found


def _texts(cell: Any) -> Iterator[str]:
    yield cell.source
    for output in cell.get("outputs", ()):
        yield output.get("text", "")
        yield "\n".join(output.get("traceback", ()))
        for value in output.get("data", {}).values():
            if isinstance(value, str):
                yield value


def out_of_step(solution: NotebookNode, student: NotebookNode) -> str:
    """Where a student's copy is not what the solutions notebook gives now; empty when it is."""
    expected = student_copy(solution)
    if len(expected.cells) != len(student.cells):
        return f"has {len(student.cells)} cells instead of {len(expected.cells)}"
    for position, (wanted, found) in enumerate(zip(expected.cells, student.cells, strict=True), start=1):
        for part in ("cell_type", "id", "source", "metadata"):
            if wanted[part] != found[part]:
                return f"differs from the solutions in the {part} of cell {position} (id {found.id})"
    return stale_reason(student)


def write_student_copy(solution_path: str | Path, student_path: str | Path) -> bool:
    """Make, run and write the students' copy of a solutions notebook; returns whether the file changed.

    Raises
    ------
    SolutionMarkerError
        As `student_copy`.
    NotebookFailure
        If an unanswered exercise does not run, or a solution line would be handed out.
    """
    solution = read_notebook(solution_path)
    student = execute(student_copy(solution), Path(student_path).parent)
    found = leaks(solution, student)
    if found:
        raise SolutionMarkerError(f"{student_path} would hold lines of the solution: {'; '.join(found)}")
    return write_notebook(student, student_path)
