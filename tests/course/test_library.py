"""The student's own copy of the course: complete, resumable, and never at the cost of the student's work."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from engdyn.course import library


@pytest.fixture
def edition(tmp_path, monkeypatch):
    """A small course whose files a test can change to make the next edition of it."""
    root = tmp_path / "edition"
    files = {}
    for name in ("notebooks/00_start_here.ipynb", "notebooks/data/run.csv", "exercises/04_equilibrium.ipynb"):
        files[name] = root / name
        files[name].parent.mkdir(parents=True, exist_ok=True)
        files[name].write_text(f"first edition of {name}")
    monkeypatch.setattr(library, "course_files", lambda: dict(files))
    return files


def _texts(folder: Path) -> dict[str, str]:
    found = {path.relative_to(folder).as_posix(): path for path in folder.rglob("*") if path.is_file()}
    return {name: path.read_text() for name, path in found.items() if name != library.MANIFEST}


def test_a_new_folder_gets_everything(edition, tmp_path):
    report = library.copy_course(tmp_path / "deep" / "mine")
    assert sorted(report.new) == sorted(edition)
    assert (report.updated, report.kept) == ([], [])
    assert _texts(tmp_path / "deep" / "mine") == {name: f"first edition of {name}" for name in edition}


def test_a_second_edition_replaces_only_what_the_student_left_alone(edition, tmp_path):
    mine = tmp_path / "mine"
    library.copy_course(mine)
    (mine / "exercises/04_equilibrium.ipynb").write_text("my answers")
    (mine / "notebooks/my_own.ipynb").write_text("my notebook")
    (mine / "notebooks/data/run.csv").unlink()
    for name, path in edition.items():
        path.write_text(f"second edition of {name}")

    report = library.copy_course(mine)
    assert report.updated == ["notebooks/00_start_here.ipynb"]
    assert report.kept == ["exercises/04_equilibrium.ipynb"]
    assert report.new == ["notebooks/data/run.csv"]
    assert _texts(mine) == {
        "exercises/04_equilibrium.ipynb": "my answers",
        "notebooks/00_start_here.ipynb": "second edition of notebooks/00_start_here.ipynb",
        "notebooks/data/run.csv": "second edition of notebooks/data/run.csv",
        "notebooks/my_own.ipynb": "my notebook",
    }
    # the kept file stays the student's in every later run
    assert library.copy_course(mine).kept == ["exercises/04_equilibrium.ipynb"]
    assert (mine / "exercises/04_equilibrium.ipynb").read_text() == "my answers"


def test_work_is_not_named_while_there_is_no_newer_edition(edition, tmp_path):
    library.copy_course(tmp_path / "mine")
    (tmp_path / "mine/exercises/04_equilibrium.ipynb").write_text("my answers")
    assert library.copy_course(tmp_path / "mine") == library.CopyReport()
    assert (tmp_path / "mine/exercises/04_equilibrium.ipynb").read_text() == "my answers"


def test_a_copy_that_broke_off_is_completed(edition, tmp_path, monkeypatch):
    original = library._copy_one

    def full_disk(name, *rest):
        if name.startswith("notebooks/data"):
            raise OSError(28, "No space left on device")
        original(name, *rest)

    monkeypatch.setattr(library, "_copy_one", full_disk)
    with pytest.raises(library.CourseFolderError, match="No space left"):
        library.copy_course(tmp_path / "mine")
    monkeypatch.setattr(library, "_copy_one", original)
    library.copy_course(tmp_path / "mine")
    assert sorted(_texts(tmp_path / "mine")) == sorted(edition)


def test_a_folder_with_other_files_is_refused_and_untouched(edition, tmp_path):
    other = tmp_path / "thesis"
    other.mkdir()
    (other / "chapter1.tex").write_text("text")
    with pytest.raises(library.CourseFolderError, match=r"other files .*chapter1\.tex.*Nothing was written"):
        library.copy_course(other)
    assert _texts(other) == {"chapter1.tex": "text"}
    assert not (other / library.MANIFEST).exists()


def test_a_file_is_refused(edition, tmp_path):
    (tmp_path / "mine").write_text("text")
    with pytest.raises(library.CourseFolderError, match="is a file"):
        library.copy_course(tmp_path / "mine")


def test_an_empty_folder_with_desktop_litter_counts_as_empty(edition, tmp_path):
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / ".DS_Store").write_text("")
    assert len(library.copy_course(tmp_path / "mine").new) == len(edition)


@pytest.mark.parametrize("damage", ["{", "[]", '{"files": 3}'])
def test_a_damaged_manifest_stops_the_copy(edition, tmp_path, damage):
    library.copy_course(tmp_path / "mine")
    (tmp_path / "mine" / library.MANIFEST).write_text(damage)
    edition["notebooks/00_start_here.ipynb"].write_text("second edition")
    with pytest.raises(library.CourseFolderError, match="damaged"):
        library.copy_course(tmp_path / "mine")
    assert "first edition" in (tmp_path / "mine/notebooks/00_start_here.ipynb").read_text()


def test_the_manifest_names_every_copied_file(edition, tmp_path):
    library.copy_course(tmp_path / "mine")
    manifest = json.loads((tmp_path / "mine" / library.MANIFEST).read_text())
    assert sorted(manifest["files"]) == sorted(edition)


def test_the_checkout_is_found_and_its_files_are_those_of_the_two_folders(checkout):
    assert library.checkout_folder() == checkout
    on_disk = {
        path.relative_to(checkout).as_posix()
        for part in ("notebooks", "exercises")
        for path in (checkout / part).rglob("*.ipynb")
        if ".ipynb_checkpoints" not in path.parts
    }
    assert on_disk
    assert on_disk <= set(library.course_files())
