"""The `engdyn` command: quick to answer, clear about what is wrong, never a traceback."""

from __future__ import annotations

import subprocess
import sys

import pytest

import engdyn
from engdyn import cli


def run(capsys, *arguments):
    """Exit code, output and error output of a command line."""
    code = cli.main(list(arguments))
    captured = capsys.readouterr()
    return code, captured.out, captured.err


def test_version(capsys):
    assert run(capsys, "--version") == (0, f"engdyn {engdyn.__version__}\n", "")


def test_help_names_every_command(capsys):
    code, out, _ = run(capsys, "--help")
    assert code == 0
    assert all(f" {command} " in out for command in ("lab", "systems", "analyze", "matrix"))


def test_importing_the_command_loads_nothing_heavy():
    code = "import sys, engdyn.cli; print(*sys.modules)"
    loaded = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert {"numpy", "sympy", "matplotlib", "IPython", "nbclient"}.isdisjoint(loaded.stdout.split())


def test_systems_lists_the_catalogue(capsys):
    code, out, err = run(capsys, "systems")
    assert (code, err) == (0, "")
    assert "gantry_crane" in out
    assert len(out.splitlines()) >= 1 + len(engdyn.systems.catalogue())


@pytest.mark.parametrize("command", [["analyze", "gantry_crain"], ["analyze", "S99"], ["analyze", ""]])
def test_an_unknown_system_is_an_error_without_traceback(capsys, command):
    code, out, err = run(capsys, *command)
    assert (code, out) == (2, "")
    assert err.startswith("engdyn: ")
    assert "Traceback" not in err
    if "crain" in command[1]:
        assert "gantry_crane" in err


def test_analyze_writes_one_file_and_does_not_replace_another(capsys, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "gantry_crane.html").write_text("mine")
    code, _, err = run(capsys, "analyze", "S07")
    assert code == 2
    assert "was not touched" in err
    assert (tmp_path / "gantry_crane.html").read_text() == "mine"

    code, out, err = run(capsys, "analyze", "S07", "--force")
    assert (code, out, err) == (0, "wrote gantry_crane.html\n", "")
    assert "<html" in (tmp_path / "gantry_crane.html").read_text(encoding="utf-8")


@pytest.mark.parametrize("out", [".", "no/such/folder/report.html"])
def test_analyze_refuses_a_place_that_cannot_hold_a_file(capsys, tmp_path, monkeypatch, out):
    monkeypatch.chdir(tmp_path)
    code, _, err = run(capsys, "analyze", "S07", "--out", out)
    assert code == 2
    assert "is a folder" in err or "does not exist" in err
    assert not list(tmp_path.rglob("*.html"))


def test_lab_refuses_a_folder_with_other_files(capsys, tmp_path):
    (tmp_path / "letter.txt").write_text("dear")
    code, _, err = run(capsys, "lab", str(tmp_path))
    assert code == 2
    assert "letter.txt" in err
    assert [path.name for path in tmp_path.iterdir()] == ["letter.txt"]


def test_lab_copies_the_course_and_opens_the_copy(capsys, tmp_path, monkeypatch):
    from engdyn.course import launch

    opened = {}
    monkeypatch.setattr(launch, "open_lab", lambda root, **options: opened.update(root=root, **options) or 0)
    code, out, _ = run(capsys, "lab", str(tmp_path / "mine"), "--no-browser", "--port", "9123")
    assert code == 0
    assert "copied" in out
    assert opened == {"root": tmp_path / "mine", "port": 9123, "browser": False}
    assert list((tmp_path / "mine" / "notebooks").glob("*.ipynb"))
    (notebook,) = list((tmp_path / "mine" / "notebooks").glob("*.ipynb"))[:1]
    notebook.write_text("my work")
    code, _, _ = run(capsys, "lab", str(tmp_path / "mine"), "--no-browser")
    assert notebook.read_text() == "my work"


def test_lab_without_a_folder_opens_the_checkout(capsys, checkout, monkeypatch):
    from engdyn.course import launch

    opened = []
    monkeypatch.setattr(launch, "open_lab", lambda root, **options: opened.append(root) or 0)
    assert run(capsys, "lab")[0] == 0
    assert opened == [checkout]


def test_lab_from_a_wheel_asks_for_a_folder(capsys, monkeypatch):
    from engdyn.course import library

    monkeypatch.setattr(library, "checkout_folder", lambda: None)
    code, _, err = run(capsys, "lab")
    assert code == 2
    assert "engdyn lab my_course" in err
