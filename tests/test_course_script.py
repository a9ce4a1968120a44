"""course.py: everything it can say before the package is installed."""

from __future__ import annotations

import ast
import importlib.util
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

SCRIPT = Path(__file__).resolve().parents[1] / "course.py"


@pytest.fixture
def script(tmp_path, monkeypatch):
    """course.py as a module, in a folder of its own that looks like the course."""
    spec = importlib.util.spec_from_file_location("course_script", SCRIPT)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    monkeypatch.setattr(module, "HERE", tmp_path / "course")
    (tmp_path / "course" / "src").mkdir(parents=True)
    for name in ("pyproject.toml", "constraints.txt"):
        (tmp_path / "course" / name).write_text("first")
    monkeypatch.delenv("ENGDYN_VENV", raising=False)
    return module


@pytest.fixture
def steps(script, monkeypatch):
    """What `ensure_environment` does, with an environment and a pip that are only noted."""
    done = []

    def create(folder):
        done.append("create")
        script.environment_python(folder).parent.mkdir(parents=True, exist_ok=True)
        script.environment_python(folder).touch()
        (folder / "pyvenv.cfg").touch()

    monkeypatch.setattr(script, "create", create)
    monkeypatch.setattr(script, "install", lambda python, extras: done.append(",".join(sorted(extras))))
    monkeypatch.setattr(script, "works", lambda python: python.exists())
    return done


def test_it_needs_only_the_standard_library():
    tree = ast.parse(SCRIPT.read_text(encoding="utf-8"))
    imported = {alias.name for node in ast.walk(tree) if isinstance(node, ast.Import) for alias in node.names}
    imported |= {node.module for node in ast.walk(tree) if isinstance(node, ast.ImportFrom)}
    assert {name.split(".")[0] for name in imported} <= set(sys.stdlib_module_names)


def test_an_old_python_can_read_it_and_is_told():
    ast.parse(SCRIPT.read_text(encoding="utf-8"), feature_version=(3, 6))


def test_an_old_python_is_named_with_what_is_needed(script):
    with pytest.raises(script.SetupError, match=r"Python 3\.10, the course needs Python 3\.11"):
        script.check_python((3, 10, 4))
    script.check_python((3, 11, 0))
    script.check_python((4, 0, 0))


def test_alone_in_a_folder_it_says_what_is_missing_and_writes_nothing(tmp_path):
    shutil.copy(SCRIPT, tmp_path)
    run = subprocess.run(
        [sys.executable, str(tmp_path / "course.py"), "open"], capture_output=True, text=True, check=False
    )
    assert run.returncode == 1
    assert "holds no pyproject.toml and no constraints.txt and no src" in run.stderr
    assert "Traceback" not in run.stderr
    assert [path.name for path in tmp_path.iterdir()] == ["course.py"]


def test_the_environment_is_beside_the_script_unless_named(script, tmp_path):
    assert script.environment_folder({}) == script.HERE / ".venv"
    assert script.environment_folder({"ENGDYN_VENV": "  "}) == script.HERE / ".venv"
    assert script.environment_folder({"ENGDYN_VENV": str(tmp_path / "other")}) == tmp_path / "other"


def test_it_installs_once_and_again_only_when_something_changed(script, steps):
    folder = script.HERE / ".venv"
    script.ensure_environment(folder, {"lab"})
    script.ensure_environment(folder, {"lab"})
    assert steps == ["create", "lab"]
    script.ensure_environment(folder, {"lab", "test"})
    script.ensure_environment(folder, {"lab"})
    assert steps == ["create", "lab", "lab,test"]
    (script.HERE / "constraints.txt").write_text("second")
    script.ensure_environment(folder, {"lab"})
    assert steps == ["create", "lab", "lab,test", "lab,test"]


def test_an_installation_that_broke_off_is_not_taken_for_done(script, steps, monkeypatch):
    folder = script.HERE / ".venv"
    script.ensure_environment(folder, {"lab"})
    (script.HERE / "pyproject.toml").write_text("second")

    def broken(python, extras):
        raise script.SetupError("no network")

    with monkeypatch.context() as patch:
        patch.setattr(script, "install", broken)
        with pytest.raises(script.SetupError, match="no network"):
            script.ensure_environment(folder, {"lab"})
    (script.HERE / "pyproject.toml").write_text("first")
    script.ensure_environment(folder, {"lab"})
    assert steps == ["create", "lab", "lab"]


def test_a_moved_course_gets_a_new_environment(script, steps, monkeypatch, tmp_path):
    script.ensure_environment(script.HERE / ".venv", {"lab"})
    moved = tmp_path / "moved"
    shutil.move(script.HERE, moved)
    monkeypatch.setattr(script, "HERE", moved)
    script.ensure_environment(moved / ".venv", {"lab"})
    assert steps == ["create", "lab", "create", "lab"]


def test_an_environment_whose_python_is_gone_is_made_again(script, steps):
    folder = script.HERE / ".venv"
    script.ensure_environment(folder, {"lab"})
    script.environment_python(folder).unlink()
    script.ensure_environment(folder, {"lab"})
    assert steps == ["create", "lab", "create", "lab"]


def test_a_folder_with_other_files_is_never_made_an_environment(script, steps, tmp_path):
    (tmp_path / "thesis").mkdir()
    (tmp_path / "thesis" / "chapter1.tex").touch()
    with pytest.raises(script.SetupError, match="nothing was changed"):
        script.ensure_environment(tmp_path / "thesis", {"lab"})
    with pytest.raises(script.SetupError, match="is a file"):
        script.ensure_environment(tmp_path / "thesis" / "chapter1.tex", {"lab"})
    assert steps == []


@pytest.mark.parametrize("module", ["venv", "ensurepip"])
def test_without_venv_it_names_the_package_of_debian(script, monkeypatch, module):
    monkeypatch.setattr(script.importlib.util, "find_spec", lambda name: None if name == module else object())
    with pytest.raises(script.SetupError, match="apt install python3-venv"):
        script.create(script.HERE / ".venv")


@pytest.mark.parametrize(
    ("output", "advice"),
    [
        ("NewConnectionError: [Errno -3] Temporary failure in name resolution", "no network"),
        ("HTTPSConnectionPool: Max retries exceeded with url: /simple/", "no network"),
        ("OSError: [Errno 28] No space left on device", "disk is full"),
        ("ERROR: Failed building wheel for numpy", "own words are above"),
    ],
)
def test_what_pip_says_becomes_advice(script, output, advice):
    assert advice in script.installation_advice(output)


@pytest.mark.skipif(sys.platform == "win32", reason="the stand-in for pip is a shell script")
@pytest.mark.parametrize(
    ("pip", "shown", "advice"),
    [
        ("echo 'Collecting numpy'; echo 'some detail'; exit 0", "  Collecting numpy\nInstalled into", ""),
        ("echo 'Collecting numpy'; echo 'ERROR: no such wheel'; exit 1", "ERROR: no such wheel", "own words"),
        ("echo 'Temporary failure in name resolution' >&2; exit 1", "name resolution", "no network"),
    ],
)
def test_pip_is_heard_while_it_works_and_quoted_when_it_fails(script, capsys, tmp_path, pip, shown, advice):
    stand_in = tmp_path / "python"
    stand_in.write_text(f"#!/bin/sh\n{pip}\n")
    stand_in.chmod(0o755)
    if advice:
        with pytest.raises(script.SetupError, match=advice):
            script.install(stand_in, {"lab"})
    else:
        script.install(stand_in, {"lab"})
    assert shown in capsys.readouterr().out


def test_a_real_environment_works_and_a_broken_one_does_not(script, tmp_path):
    assert script.works(Path(sys.executable))
    broken = tmp_path / "python"
    broken.write_text("not a program")
    broken.chmod(0o755)
    assert not script.works(broken)
    assert not script.works(tmp_path / "missing")


@pytest.mark.parametrize(
    ("arguments", "extras", "command"),
    [
        (["open"], {"lab"}, ["-m", "engdyn.cli", "lab"]),
        (
            ["open", "--no-browser", "--port", "9000"],
            {"lab"},
            ["-m", "engdyn.cli", "lab", "--no-browser", "--port", "9000"],
        ),
        (["test"], {"lab", "test"}, ["-m", "pytest"]),
        (
            ["test", "-k", "crane", "-x", "tests"],
            {"lab", "test"},
            ["-m", "pytest", "-k", "crane", "-x", "tests"],
        ),
    ],
)
def test_command_lines(script, monkeypatch, arguments, extras, command):
    wanted, commands = [], []
    monkeypatch.setattr(
        script, "ensure_environment", lambda folder, extras: wanted.append(extras) or Path("py")
    )
    monkeypatch.setattr(script, "run", lambda command: commands.append(command) or 7)
    assert script.main(arguments) == 7
    assert wanted == [extras]
    assert commands == [["py", *command]]


@pytest.mark.parametrize("arguments", [[], ["close"], ["open", "--prot", "3"], ["open", "--port", "x"]])
def test_wrong_command_lines_are_refused_before_anything_is_installed(script, steps, arguments, capsys):
    with pytest.raises(SystemExit) as end:
        script.main(arguments)
    assert end.value.code == 2
    assert "usage: course.py" in capsys.readouterr().err
    assert steps == []


def test_the_exit_code_passes_through(script):
    assert script.run([sys.executable, "-c", "raise SystemExit(5)"]) == 5
