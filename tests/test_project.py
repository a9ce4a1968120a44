"""The project as a whole: its rules are kept, its documents tell the truth, its wheel is complete."""

from __future__ import annotations

import ast
import math
import re
import subprocess
import sys
import tomllib
import warnings
import zipfile
from importlib.metadata import version
from pathlib import Path

import pytest
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

import engdyn

CHECKOUT = Path(__file__).resolve().parents[1]
SOURCES = sorted((CHECKOUT / "src" / "engdyn").rglob("*.py"))
DOCUMENTS = ("README.md", "CONTRIBUTING.md", "CHANGELOG.md")
MODULE_LINES, FUNCTION_LINES = 330, 40  # "about 300"
ROOM_LINES = {
    "algebra": 2_200,
    "modeling": 4_700,
    "analysis": 5_700,
    "experiment": 2_100,
    "systems": 4_950,
    "plots": 4_150,
    "widgets": 2_850,
    "course": 4_300,
    "": 1_550,
}
"""Lines of code of each room: a companion grows only where somebody decides that it may."""


def _run(*command: str, folder: Path = CHECKOUT) -> subprocess.CompletedProcess[str]:
    return subprocess.run([sys.executable, *command], cwd=folder, capture_output=True, text=True, check=False)


def _text(name: str) -> str:
    return (CHECKOUT / name).read_text(encoding="utf-8")


@pytest.mark.parametrize(
    "tool",
    [
        ["ruff", "format", "--check", "--no-cache", "."],
        ["ruff", "check", "--no-cache", "--output-format=concise", "."],
        ["mypy", "--no-error-summary"],
    ],
    ids=["format", "lint", "types"],
)
def test_tools_find_nothing(tool):
    run = _run("-m", *tool)
    assert run.returncode == 0, run.stdout[-4000:] + run.stderr[-2000:]


def test_imports_point_one_way():
    run = _run(
        "-c", "import sys; from importlinter.cli import lint_imports; sys.exit(lint_imports(no_cache=True))"
    )
    assert run.returncode == 0, run.stdout[-4000:] + run.stderr[-2000:]
    assert "2 kept, 0 broken" in run.stdout


def _name(path: Path) -> str:
    return path.relative_to(CHECKOUT / "src" / "engdyn").as_posix()


@pytest.mark.parametrize("path", SOURCES, ids=_name)
def test_rooms_are_small(path):
    text = path.read_text(encoding="utf-8")
    assert text.count("\n") <= MODULE_LINES
    functions = [node for node in ast.walk(ast.parse(text)) if isinstance(node, ast.FunctionDef)]
    long = {node.name: _lines(node) for node in functions if _lines(node) > FUNCTION_LINES}
    assert long == {}


@pytest.mark.parametrize("path", SOURCES, ids=_name)
def test_public_signatures_are_complete(path):
    tree = ast.parse(path.read_text(encoding="utf-8"))
    classes = [node for node in tree.body if isinstance(node, ast.ClassDef) and not node.name.startswith("_")]
    functions = [node for home in (tree, *classes) for node in home.body if isinstance(node, ast.FunctionDef)]
    incomplete = {
        node.name for node in functions if not node.name.startswith("_") and not _is_annotated(node)
    }
    assert incomplete == set()


def _is_annotated(function: ast.FunctionDef) -> bool:
    given = function.args
    named = [*given.posonlyargs, *given.args, *given.kwonlyargs, given.vararg, given.kwarg]
    typed = [argument.annotation for argument in named if argument and argument.arg not in ("self", "cls")]
    return function.returns is not None and None not in typed


def _lines(function: ast.FunctionDef) -> int:
    """Lines of a function without its docstring."""
    body = function.body
    documented = isinstance(body[0], ast.Expr) and isinstance(getattr(body[0], "value", None), ast.Constant)
    docstring = body[0].end_lineno - body[0].lineno + 1 if documented else 0
    return function.end_lineno - function.lineno + 1 - docstring


def test_the_companion_stays_small():
    lines = dict.fromkeys(ROOM_LINES, 0)
    for path in SOURCES:
        lines[_name(path).rpartition("/")[0].partition("/")[0]] += _code_lines(path)
    assert {room: n for room, n in lines.items() if n > ROOM_LINES[room]} == {}


def _code_lines(path: Path) -> int:
    """Lines of a module without docstrings, comments and blank ones."""
    text = path.read_text(encoding="utf-8")
    docstrings: set[int] = set()
    for node in ast.walk(ast.parse(text)):
        if (
            isinstance(node, ast.Expr)
            and isinstance(node.value, ast.Constant)
            and isinstance(node.value.value, str)
        ):
            docstrings |= set(range(node.lineno, node.end_lineno + 1))
    lines = enumerate(text.splitlines(), start=1)
    return sum(bool(line.strip()) and line.strip()[0] != "#" and n not in docstrings for n, line in lines)


@pytest.mark.parametrize("module", ["engdyn", "engdyn.algebra.ring", "tests.algebra.test_ring"])
def test_a_warning_from_our_own_code_is_an_error(module):
    with pytest.raises(DeprecationWarning):
        warnings.warn_explicit("outdated", DeprecationWarning, "file.py", 1, module=module)
    with pytest.raises(engdyn.EngdynWarning):
        warnings.warn("mind this", engdyn.EngdynWarning, stacklevel=2)


def test_nothing_is_simplified():
    calls = {
        f"{_name(path)}:{node.lineno}"
        for path in SOURCES
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8")))
        if isinstance(node, ast.Call)
        and getattr(node.func, "attr", getattr(node.func, "id", "")) in {"simplify", "trigsimp", "nsimplify"}
    }
    assert calls == set()


def test_every_document_names_the_same_version():
    cited = re.search(r"^version: (.*)$", _text("CITATION.cff"), re.MULTILINE)[1]
    newest = re.search(r"^## \[(\d[^]]*)\]", _text("CHANGELOG.md"), re.MULTILINE)[1]
    assert cited == newest == engdyn.__version__


def _requirements() -> list[Requirement]:
    project = tomllib.loads(_text("pyproject.toml"))["project"]
    extras = project["optional-dependencies"]
    return [Requirement(line) for line in project["dependencies"] + extras["lab"] + extras["test"]]


def test_constraints_are_names_and_exact_versions_only():
    lines = _text("constraints.txt").splitlines()
    assert all(re.fullmatch(r"[a-z0-9][a-z0-9.-]*==[0-9][0-9a-z.]*", line) for line in lines)
    names = [line.split("==")[0] for line in lines]
    assert names == sorted(set(names))


@pytest.mark.parametrize("requirement", _requirements(), ids=lambda requirement: requirement.name)
def test_every_dependency_is_constrained_within_its_bound_and_tested_so(requirement):
    lines = _text("constraints.txt").splitlines()
    constrained = dict(line.split("==") for line in lines)[canonicalize_name(requirement.name)]
    assert requirement.specifier.contains(constrained)
    if requirement.marker is None or requirement.marker.evaluate():
        assert requirement.specifier.contains(version(requirement.name))


def test_the_wheel_carries_the_course_and_nothing_of_the_workshop(tmp_path):
    from hatchling.builders.wheel import WheelBuilder

    (wheel,) = WheelBuilder(str(CHECKOUT)).build(directory=str(tmp_path), versions=["standard"])
    names = set(zipfile.ZipFile(wheel).namelist())
    for part in ("notebooks", "exercises"):
        expected = {f"engdyn/course_files/{part}/{path.name}" for path in (CHECKOUT / part).glob("*.ipynb")}
        assert expected
        assert expected <= names
    assert {"engdyn/py.typed", "engdyn/__init__.pyi", "engdyn/cli.py"} <= names
    assert {f"engdyn/{_name(path)}" for path in SOURCES} <= names
    assert not any(
        "solutions" in name or name.startswith("tests") or ".ipynb_checkpoints" in name for name in names
    )


@pytest.mark.parametrize("document", DOCUMENTS)
def test_links_between_documents_lead_somewhere(document):
    text = _text(document)
    links = re.findall(r"\]\(([^)\s]+)\)", text) + re.findall(r"^\[[^]]+\]: (\S+)", text, re.MULTILINE)
    files = [link.split("#")[0] for link in links if "://" not in link]
    assert [name for name in files if not (CHECKOUT / name).exists()] == []


def test_folders_that_the_readme_names_are_there():
    named = re.findall(r"^\| `([a-z/]+)`", _text("README.md"), re.MULTILINE)
    assert len(named) >= 8
    assert [name for name in named if not (CHECKOUT / name).is_dir()] == []


def test_the_clean_run_is_the_line_of_the_readme():
    (line,) = re.findall(r"^    (python3 course\.py test)$", _text("README.md"), re.MULTILINE)
    assert re.search(rf"^{re.escape(line)} 2>&1", _text(".ci/run"), re.MULTILINE)


def test_an_own_system_of_the_readme(tmp_path):
    marked = _text("README.md").split("<!-- own system: tested -->")[1]
    code, printed = re.search(r"```python\n(.*?)```.*?```text\n(.*?)```", marked, re.DOTALL).groups()
    assert len([line for line in code.splitlines() if line.strip()]) <= 25
    (tmp_path / "own.py").write_text(code, encoding="utf-8")
    run = _run("own.py", folder=tmp_path)
    assert (run.stdout, run.stderr) == (printed, "")
    lean = float(printed.splitlines()[-1].split()[0])  # it rests where m g l sin(lean) = k lean
    assert math.isclose(12 * 9.81 * 3 * math.sin(lean), 300 * lean, rel_tol=1e-4)


def test_the_tour_of_the_readme(tmp_path):
    code = re.search(r"```python\n(.*?)```", _text("README.md").split("<!-- tour: tested -->")[1], re.DOTALL)[
        1
    ]
    shown = "print(ride.frequency[ride.amplitude.argmax()], bump.audit.error < 1e-6, record.rate)\n"
    (tmp_path / "tour.py").write_text(code + shown, encoding="utf-8")
    run = _run("tour.py", folder=tmp_path)
    assert (run.returncode, run.stderr) == (0, "")
    bounce, balanced, rate = run.stdout.split()
    assert 0.9 < float(bounce) < 1.3  # the body's own frequency, with its damping [Hz]
    assert (balanced, rate) == ("True", "200.0")


def test_the_first_example_of_the_readme(tmp_path):
    code = re.search(r"```python\n(.*?)```", _text("README.md"), re.DOTALL)[1]
    shown = "print(crane.prove().verdict, *(round(float(pose.q[1]), 6) for pose in windy))\n"
    (tmp_path / "example.py").write_text(code + shown, encoding="utf-8")
    run = _run("example.py", folder=tmp_path)
    assert (run.returncode, run.stderr) == (0, "")
    verdict, *angles = run.stdout.split()
    hanging = math.atan2(5000, 2500 * 9.81)  # the container lines up with wind and weight
    assert verdict == "proved"
    assert sorted(map(float, angles)) == pytest.approx(sorted([hanging, hanging - math.pi]), abs=1e-6)
