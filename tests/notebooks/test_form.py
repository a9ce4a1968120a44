"""What every notebook of the course has in common, apart from running (which nbval looks at cell by cell)."""

from __future__ import annotations

import ast
import json
import re
from pathlib import Path

import nbformat
import pytest

from engdyn.course import build

CHECKOUT = Path(__file__).resolve().parents[2]
FOLDERS = ("notebooks", "solutions", "exercises")
NOTEBOOKS = [path for folder in FOLDERS for path in sorted((CHECKOUT / folder).glob("*.ipynb"))]
LESSONS = [path for path in NOTEBOOKS if path.parent.name == "notebooks"]
CHAPTERS = [path for path in LESSONS if re.match(r"0[1-9]_", path.name)]
CELL_LINES, FILE_SIZE = 15, 1_000_000  # lines of a code cell; bytes of a notebook with its pictures
SLIDE_TYPES = {"slide", "subslide", "fragment", "notes", "skip", "-"}


def _name(path: Path) -> str:
    return f"{path.parent.name}/{path.stem}"


def _code(notebook):
    return [cell for cell in notebook.cells if cell.cell_type == "code"]


@pytest.fixture
def notebook(path):
    return nbformat.read(path, as_version=4)


every_notebook = pytest.mark.parametrize("path", NOTEBOOKS, ids=_name)


def test_there_are_lessons_and_exercises():
    assert {path.parent.name for path in NOTEBOOKS} == set(FOLDERS)
    assert CHAPTERS


@every_notebook
def test_it_is_valid_and_its_outputs_belong_to_its_code(path, notebook):
    nbformat.validate(notebook)
    assert build.check(path) == []


@every_notebook
def test_it_carries_nothing_of_one_run(path, notebook):
    assert path.stat().st_size <= FILE_SIZE
    assert "widgets" not in notebook.metadata
    assert "widget-view" not in json.dumps([cell.outputs for cell in _code(notebook)])
    assert [cell.id for cell in notebook.cells if "execution" in cell.metadata] == []
    counts = [cell.execution_count for cell in _code(notebook) if cell.source.strip()]
    assert counts == list(range(1, len(counts) + 1))


@every_notebook
def test_no_output_is_an_unannounced_error(path, notebook):
    silent = [cell for cell in _code(notebook) if "raises-exception" not in cell.metadata.get("tags", ())]
    assert [cell.id for cell in silent for output in cell.outputs if output.output_type == "error"] == []


@every_notebook
def test_code_cells_are_short_and_of_the_kind_that_compares_strictly(path, notebook):
    for cell in _code(notebook):
        lines = [line for line in cell.source.splitlines() if line.strip()]
        if path.parent.name != "solutions":
            assert len(lines) <= CELL_LINES, f"cell {cell.id}"
        assert not (lines and lines[-1].rstrip().endswith(";")), f"cell {cell.id} ends with a semicolon"
        called = {node.id for node in ast.walk(ast.parse(cell.source)) if isinstance(node, ast.Name)}
        called |= {node.attr for node in ast.walk(ast.parse(cell.source)) if isinstance(node, ast.Attribute)}
        assert called.isdisjoint({"interact", "interactive", "interactive_output"}), f"cell {cell.id}"


@pytest.mark.parametrize("path", LESSONS, ids=_name)
def test_every_cell_of_a_lesson_has_its_place_in_the_slides(path, notebook):
    kinds = {cell.id: cell.metadata.get("slideshow", {}).get("slide_type") for cell in notebook.cells}
    assert [name for name, kind in kinds.items() if kind not in SLIDE_TYPES] == []


@every_notebook
def test_links_lead_to_files_of_the_course(path, notebook):
    text = "\n".join(cell.source for cell in notebook.cells if cell.cell_type == "markdown")
    links = [link.split("#")[0] for link in re.findall(r"\]\(([^)\s]+)\)", text) if "://" not in link]
    missing = [link for link in links if link and not link.startswith("attachment:")]
    assert [link for link in missing if not (path.parent / link).exists()] == []


@pytest.mark.parametrize("path", CHAPTERS, ids=_name)
def test_the_sections_of_a_chapter_are_numbered_in_order(path, notebook):
    chapter = int(path.name[:2])
    text = "\n".join(cell.source for cell in notebook.cells if cell.cell_type == "markdown")
    assert re.search(rf"^# .*\b{chapter}\b", text, re.MULTILINE), "the title names the chapter"
    numbers = [int(number) for number in re.findall(rf"^## {chapter}\.(\d+) \S", text, re.MULTILINE)]
    assert numbers == list(range(1, len(numbers) + 1))
    assert len(numbers) >= 3
