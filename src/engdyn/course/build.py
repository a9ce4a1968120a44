"""Run the notebooks of the course and write their outputs: ``python -m engdyn.course.build``.

    python -m engdyn.course.build                       every notebook and every student's copy
    python -m engdyn.course.build notebooks/04_x.ipynb  only this one
    python -m engdyn.course.build --check [NOTEBOOK]    run nothing, name what is stale

A notebook of ``solutions/`` is built together with its copy in ``exercises/``; a notebook of
``exercises/`` is always made anew from ``solutions/``. The exit code is 1 when a notebook failed or, with
``--check``, when one is stale.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

from ..errors import EngdynError
from .execution import NotebookFailure, execute, read_notebook, stale_reason, write_notebook
from .student_copies import out_of_step, write_student_copy

__all__ = ["build", "check", "course_notebooks", "main"]

FOLDERS = ("notebooks", "solutions", "exercises")


def course_notebooks(root: str | Path) -> list[Path]:
    """All notebooks of a checkout that are to be built; students' copies only where no solution is left."""
    root = Path(root)
    found = [path for folder in FOLDERS for path in sorted((root / folder).glob("*.ipynb"))]
    return [path for path in found if not (path.parent.name == "exercises" and solution_of(path).is_file())]


def solution_of(student_path: Path) -> Path:
    """The solutions notebook that a student's copy is made from."""
    return student_path.parent.parent / "solutions" / student_path.name


def student_of(solution_path: Path) -> Path:
    """The student's copy that belongs to a solutions notebook."""
    return solution_path.parent.parent / "exercises" / solution_path.name


def build(path: str | Path) -> list[Path]:
    """Run one notebook, write it, and return the files that changed.

    Raises
    ------
    NotebookFailure
        If a cell fails; the file stays as it was.
    SolutionMarkerError
        If a student's copy cannot be made or would give a solution away.
    """
    path = Path(path).absolute()
    if path.parent.name == "exercises":
        if not solution_of(path).is_file():
            raise NotebookFailure(f"{path.name} of exercises/ has no source in solutions/; remove it.")
        return [path] if write_student_copy(solution_of(path), path) else []
    notebook = execute(read_notebook(path), path.parent)
    changed = [path] if write_notebook(notebook, path) else []
    if path.parent.name == "solutions" and write_student_copy(path, student_of(path)):
        changed.append(student_of(path))
    return changed


def check(path: str | Path) -> list[str]:
    """What is stale about one notebook and its student's copy, one sentence each; empty when nothing is."""
    path = Path(path).absolute()
    if path.parent.name == "exercises":
        return _check_student(solution_of(path), path)
    reason = stale_reason(read_notebook(path))
    found = [f"{path.parent.name}/{path.name} {reason}"] if reason else []
    if path.parent.name == "solutions":
        found += _check_student(path, student_of(path))
    return found


def _check_student(solution_path: Path, student_path: Path) -> list[str]:
    name = f"exercises/{student_path.name}"
    if not solution_path.is_file():
        return [f"{name} has no source in solutions/"]
    if not student_path.is_file():
        return [f"{name} is missing"]
    reason = out_of_step(read_notebook(solution_path), read_notebook(student_path))
    return [f"{name} {reason}"] if reason else []


def main(arguments: Sequence[str] | None = None) -> int:
    """Command line of the build; returns the exit code."""
    parser = argparse.ArgumentParser(
        prog="python -m engdyn.course.build",
        description="Run the notebooks of the course and write their outputs.",
    )
    parser.add_argument("notebooks", nargs="*", metavar="NOTEBOOK", help="default: all of the checkout")
    parser.add_argument("--check", action="store_true", help="run nothing, name what is stale")
    options = parser.parse_args(arguments)
    paths = [Path(name) for name in options.notebooks] or course_notebooks(Path.cwd())
    if not paths:
        print(
            "No notebooks here: run this in the folder that holds notebooks/ and solutions/.", file=sys.stderr
        )
        return 1
    failed = False
    for path in paths:
        try:
            lines = check(path) if options.check else [f"wrote {changed}" for changed in build(path)]
        except EngdynError as error:
            print(f"{path}: {error}", file=sys.stderr)
            failed = True
            continue
        failed = failed or (options.check and bool(lines))
        print("\n".join(lines) or f"{path} is up to date", flush=True)
    return int(failed)


if __name__ == "__main__":
    sys.exit(main())
