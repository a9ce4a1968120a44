"""The matrix of systems and analyses: every cell is a check, and every check can fail."""

from __future__ import annotations

import io
import json
from dataclasses import replace

import pytest
from rich.console import Console

import engdyn as ed
from engdyn.cli import main
from engdyn.course import matrix as module
from engdyn.course.matrix import Matrix, matrix
from engdyn.course.matrix_checks import CHECKS
from engdyn.course.matrix_table import matrix_table, summary

SYSTEMS = list(ed.systems.catalogue().index)
BUILT = [name for name, (_, check) in CHECKS.items() if check is not None]


@pytest.mark.parametrize("key", SYSTEMS)
def test_every_analysis_that_is_built_passes(key):
    cells = matrix([key], BUILT).cells
    assert [(cell.system, cell.analysis) for cell in cells] == [(key, name) for name in BUILT]
    assert [(cell.analysis, cell.detail) for cell in cells if cell.status != "passed"] == []


@pytest.mark.parametrize("key", SYSTEMS)
def test_every_check_notices_that_its_input_is_corrupted(key):
    found = matrix([key], BUILT, sabotage=True)
    assert [cell.analysis for cell in found.cells if cell.status != "failed"] == []
    assert found.right


def test_what_is_not_built_is_never_passed():
    open_ones = [name for name in CHECKS if name not in BUILT]
    cells = matrix(["S07"], open_ones).cells if open_ones else ()
    assert {cell.status for cell in cells} <= {"not built"}


def test_a_failure_makes_the_matrix_wrong_and_a_passed_sabotage_too(monkeypatch):
    def never(system, corrupt):
        raise ed.EngdynError("as expected")

    monkeypatch.setitem(CHECKS, "kinematics", ("Kinematics", never))
    found = matrix(["S07"], ["kinematics"])
    assert not found.right
    assert summary(found)[0] == "S07 kinematics: as expected"
    monkeypatch.setitem(CHECKS, "kinematics", ("Kinematics", lambda system, corrupt: "blind"))
    assert matrix(["S07"], ["kinematics"]).right
    assert not matrix(["S07"], ["kinematics"], sabotage=True).right


def test_an_own_system_may_be_checked_too():
    assert (
        module.matrix([ed.systems.load("W7")], ["derivation"]).cells[0].detail
        == "proved, 3 reactions eliminated"
    )


def test_progress_is_told_cell_by_cell():
    seen = []
    found = matrix(["S04"], ["kinematics", "derivation"], progress=seen.append)
    assert tuple(seen) == found.cells


def printed(found: Matrix) -> str:
    console = Console(width=160, file=io.StringIO())
    console.print(matrix_table(found))
    return console.file.getvalue()


def test_the_table_tells_with_marks_and_words():
    found = matrix(["S04"], ["derivation", "equilibria"])
    assert "✓" in printed(found)
    missing = replace(found.cells[0], status="not built")
    assert "not built" in printed(replace(found, cells=(missing, found.cells[1])))
    single = printed(matrix(["S04"], ["derivation"]))
    assert "proved, 2 reactions eliminated" in single
    assert "seismometer" in single


def test_the_command(capsys):
    assert main(["matrix", "S04", "--only", "derivation", "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert told["right"]
    assert told["cells"][0]["status"] == "passed"
    assert main(["matrix", "S04", "--only", "derivation", "--sabotage"]) == 1
    assert "1 failed" in capsys.readouterr().out
    assert main(["matrix", "--only", "dreams"]) == 2
    assert "choose from kinematics" in capsys.readouterr().err
    assert main(["matrix", "S99"]) == 2
