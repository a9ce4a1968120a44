"""Students' copies: made from the solutions, runnable as they are, and giving nothing away."""

from __future__ import annotations

import copy
from pathlib import Path

import nbformat
import pytest
from nbformat.v4 import new_code_cell, new_markdown_cell, new_notebook
from nbgrader.nbgraderformat import MetadataValidator

from engdyn.course import build, execution, student_copies

CHECKOUT = Path(__file__).resolve().parents[2]
SOLUTIONS = sorted((CHECKOUT / "solutions").glob("*.ipynb"))
EXERCISES = sorted((CHECKOUT / "exercises").glob("*.ipynb"))

GRADED = {
    "nbgrader": {
        "grade": True,
        "grade_id": "exercise-4-1",
        "locked": False,
        "points": 2,
        "schema_version": 3,
        "solution": True,
        "task": False,
    },
    "tags": ["exercise-4.1"],
}
ANSWERED = """length = 1.25
### BEGIN SOLUTION
import math
answer = 2 * math.pi * math.sqrt(length / 9.81)  # small angles
### END SOLUTION
print(answer)"""


def made_up_solutions():
    """Two exercises, one with names of its own, a model explanation and a picture for the instructor."""
    return new_notebook(
        cells=[
            new_markdown_cell("# Exercises", id="title"),
            new_code_cell(ANSWERED, id="period", metadata=copy.deepcopy(GRADED)),
            new_markdown_cell(
                "The period follows from the linearized equation.", id="why", metadata={"tags": ["solution"]}
            ),
            new_code_cell(
                "### BEGIN SOLUTION\n### STUB: M, K = ..., ...\nM = [[2.0, 0.0], [0.0, 1.0]]\n"
                "K = [[1100.0, -300.0], [-300.0, 300.0]]\n### END SOLUTION",
                id="matrices",
            ),
            new_code_cell(
                "def kinetic_energy(v):\n    ### BEGIN SOLUTION\n    ### STUB: return ...\n"
                "    return 0.5 * 3.0 * v**2\n    ### END SOLUTION",
                id="energy",
            ),
            new_markdown_cell("### BEGIN SOLUTION\nBoth masses move in step.\n### END SOLUTION", id="essay"),
        ]
    )


def test_student_copy_of_every_kind_of_cell():
    solution = made_up_solutions()
    before = copy.deepcopy(solution)
    student = student_copies.student_copy(solution)
    assert solution == before
    assert [cell.id for cell in student.cells] == ["title", "period", "matrices", "energy", "essay"]
    assert student.cells[1].source == "length = 1.25\nanswer = ...\nprint(answer)"
    assert student.cells[2].source == "M, K = ..., ..."
    assert student.cells[3].source == "def kinetic_energy(v):\n    return ..."
    assert student.cells[4].source == "*Your answer:*"
    assert student.cells[1].metadata == GRADED
    assert student_copies.leaks(solution, student) == []


def test_nbgrader_accepts_the_metadata():
    MetadataValidator().validate_nb(student_copies.student_copy(made_up_solutions()))


def test_an_empty_stub_leaves_nothing_and_gives_nothing_away():
    source = "total = 0\n### BEGIN SOLUTION\n### STUB:\ntotal = 1234567890\n### END SOLUTION"
    student = student_copies.student_copy(new_notebook(cells=[new_code_cell(source)]))
    assert student.cells[0].source == "total = 0"


@pytest.mark.parametrize(
    ("source", "message"),
    [
        ("### BEGIN SOLUTION\nanswer = 1", "has no"),
        ("answer = 1\n### END SOLUTION", "do not alternate"),
        ("### BEGIN SOLUTION\n### BEGIN SOLUTION\nanswer = 1\n### END SOLUTION", "do not alternate"),
        ("### BEGIN SOLUTION\nperiod = 1\n### END SOLUTION", "sets answer, the solution does not"),
        (
            "### BEGIN SOLUTION\n### STUB: M, K = ..., ...\nM = 1\n### END SOLUTION",
            "sets K, the solution does not",
        ),
        ("### BEGIN SOLUTION\nanswer = (1\n### END SOLUTION", "no complete piece of Python"),
    ],
)
def test_markers_that_do_not_fit_are_refused(source, message):
    with pytest.raises(student_copies.SolutionMarkerError, match=message):
        student_copies.student_copy(new_notebook(cells=[new_code_cell(source)]))


def test_leaks_are_found_in_cells_and_in_outputs_whatever_the_spaces():
    solution = made_up_solutions()
    student = student_copies.student_copy(solution)
    student.cells[0].source += "\nHint: M=[[2.0,0.0],\n [0.0,1.0]]"
    output = nbformat.v4.new_output("stream", text="    return 0.5*3.0*v**2\n")
    student.cells[1].outputs = [output]
    student.cells[4].source = "The period follows from the linearized equation."
    assert sorted(student_copies.leaks(solution, student)) == [
        "M = [[2.0, 0.0], [0.0, 1.0]]",
        "The period follows from the linearized equation.",
        "return 0.5 * 3.0 * v**2",
    ]


def test_short_solution_lines_are_no_leak():
    source = "### BEGIN SOLUTION\nanswer = 1.5\n### END SOLUTION"  # 10 characters without spaces
    solution = new_notebook(cells=[new_code_cell(source), new_markdown_cell("So answer = 1.5?")])
    assert student_copies.leaks(solution, student_copies.student_copy(solution)) == []


def test_a_copy_that_would_give_the_solution_away_is_not_written(tmp_path):
    solution = made_up_solutions()
    solution.cells[0].source = "# Try M = [[2.0, 0.0], [0.0, 1.0]]"
    (tmp_path / "solutions").mkdir()
    (tmp_path / "exercises").mkdir()
    nbformat.write(solution, tmp_path / "solutions" / "04_x.ipynb")
    with pytest.raises(student_copies.SolutionMarkerError, match="would hold lines of the solution"):
        student_copies.write_student_copy(
            tmp_path / "solutions/04_x.ipynb", tmp_path / "exercises/04_x.ipynb"
        )
    assert not (tmp_path / "exercises" / "04_x.ipynb").exists()


def test_building_the_solutions_writes_a_copy_that_ran_and_is_in_step(tmp_path):
    source = tmp_path / "solutions" / "04_made_up.ipynb"
    target = tmp_path / "exercises" / "04_made_up.ipynb"
    for path in (source, target):
        path.parent.mkdir()
    nbformat.write(made_up_solutions(), source)
    assert build.build(source) == [source, target]
    assert build.check(source) == []
    student = execution.read_notebook(target)
    assert student.cells[1].outputs[0].text == "Ellipsis\n"
    assert execution.read_notebook(source).cells[1].outputs[0].text.startswith("2.24")
    assert build.course_notebooks(tmp_path) == [source]

    changed = execution.read_notebook(source)
    changed.cells[0].source = "# Exercises, second edition"
    execution.write_notebook(changed, source)
    expected = "exercises/04_made_up.ipynb differs from the solutions in the source of cell 1 (id title)"
    assert build.check(target) == [expected]
    target.unlink()
    assert build.check(source) == ["exercises/04_made_up.ipynb is missing"]


def test_a_copy_without_its_source_is_named(tmp_path):
    orphan = tmp_path / "exercises" / "05_orphan.ipynb"
    orphan.parent.mkdir()
    nbformat.write(new_notebook(cells=[]), orphan)
    assert build.course_notebooks(tmp_path) == [orphan]
    assert build.check(orphan) == ["exercises/05_orphan.ipynb has no source in solutions/"]
    assert build.main([str(orphan)]) == 1


@pytest.mark.parametrize("path", SOLUTIONS, ids=lambda path: path.stem)
def test_the_students_copy_is_in_step_and_gives_nothing_away(path):
    assert build.check(path) == []
    solution = execution.read_notebook(path)
    student = execution.read_notebook(build.student_of(path))
    hidden = [line for line in student_copies.solution_lines(solution) if line.strip()]
    assert hidden, "a solutions notebook without a single solution line"
    assert student_copies.leaks(solution, student) == []
    MetadataValidator().validate_nb(solution)
    MetadataValidator().validate_nb(student)


def test_every_students_copy_has_its_source():
    assert {path.name for path in EXERCISES} == {path.name for path in SOLUTIONS}
