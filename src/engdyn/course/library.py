"""Where the files of the course are, and how they get to a student's own folder.

In a checkout the folders ``notebooks/`` and ``exercises/`` are used as they are; an installed wheel
carries them as package data. `copy_course` puts them into a folder of the student's own and, later, brings
that folder up to date without ever touching a file that the student changed.
"""

from __future__ import annotations

import hashlib
import json
import os
from dataclasses import dataclass, field
from pathlib import Path

from ..errors import EngdynError

__all__ = ["CopyReport", "CourseFolderError", "checkout_folder", "copy_course", "course_files"]

PARTS = ("notebooks", "exercises")
MANIFEST = ".engdyn-course.json"
DESKTOP_LITTER = {".DS_Store", "Thumbs.db", "desktop.ini"}


class CourseFolderError(EngdynError):
    """The course cannot be copied to this folder, or its files are not there."""


@dataclass(frozen=True)
class CopyReport:
    """What `copy_course` did, as paths relative to the folder.

    Attributes
    ----------
    new : list of str
        Files that were not there before.
    updated : list of str
        Files that the student had not changed, replaced by a newer edition.
    kept : list of str
        Files that the student changed and of which a newer edition exists; they stay as they are.
    """

    new: list[str] = field(default_factory=list)
    updated: list[str] = field(default_factory=list)
    kept: list[str] = field(default_factory=list)


def checkout_folder() -> Path | None:
    """The folder of the checkout that this package runs from; None for an installed wheel."""
    folder = Path(__file__).resolve().parents[3]
    inside = (folder / "pyproject.toml").is_file() and (folder / "notebooks").is_dir()
    return folder if inside else None


def course_files() -> dict[str, Path]:
    """Every file of the course that a student gets: relative path with forward slashes → where it is.

    Raises
    ------
    CourseFolderError
        If this copy of the package came without the course.
    """
    root = checkout_folder() or Path(__file__).resolve().parents[1] / "course_files"
    found = {}
    for part in PARTS:
        for path in sorted((root / part).rglob("*")):
            inside = path.relative_to(root)
            hidden = any(name.startswith((".", "__pycache__")) for name in inside.parts)
            if path.is_file() and not hidden and path.suffix != ".part":
                found[inside.as_posix()] = path
    if not found:
        raise CourseFolderError(
            "this copy of engdyn came without the notebooks; install it from a complete folder of the course."
        )
    return found


def copy_course(folder: str | Path) -> CopyReport:
    """Copy the course to a folder, or bring a copy made earlier up to date.

    A file that differs from what was copied is the student's work: it is never overwritten. A file that was
    deleted is copied again.

    Parameters
    ----------
    folder : str or Path
        A folder that does not exist yet, is empty, or holds a copy of the course.

    Raises
    ------
    CourseFolderError
        If the folder is a file, holds anything else than a copy of the course, or cannot be written;
        in the first two cases nothing is written.
    """
    folder = Path(folder).expanduser().absolute()
    noted = _noted_checksums(folder)
    sources = course_files()
    report = CopyReport()
    try:
        folder.mkdir(parents=True, exist_ok=True)
        _write_manifest(folder, noted)  # first, so that a copy that breaks off can be resumed
        for name, source in sources.items():
            _copy_one(name, source.read_bytes(), folder / name, noted, report)
        _write_manifest(folder, noted)
    except OSError as error:
        raise CourseFolderError(
            f"the course cannot be written to {folder}: {error.strerror or error}. Name another folder."
        ) from error
    return report


def _noted_checksums(folder: Path) -> dict[str, str]:
    """Checksums of the files as they were copied; empty for a new folder. Refuses other folders."""
    if not folder.exists():
        return {}
    if not folder.is_dir():
        raise CourseFolderError(
            f"{folder} is a file; name a folder, new or with an earlier copy of the course."
        )
    manifest = folder / MANIFEST
    if manifest.is_file():
        try:
            return {
                str(name): str(value) for name, value in json.loads(manifest.read_text())["files"].items()
            }
        except (OSError, ValueError, KeyError, TypeError, AttributeError) as error:
            raise CourseFolderError(
                f"{manifest} is damaged, so your changes cannot be told from the course's own text. "
                "Nothing was written; name a new folder."
            ) from error
    others = sorted(path.name for path in folder.iterdir() if path.name not in DESKTOP_LITTER)
    if others:
        shown = ", ".join(others[:3]) + (", …" if len(others) > 3 else "")
        raise CourseFolderError(
            f"{folder} holds other files than a copy of the course ({shown}). "
            "Nothing was written; name a new or an empty folder."
        )
    return {}


def _copy_one(name: str, content: bytes, target: Path, noted: dict[str, str], report: CopyReport) -> None:
    wanted = _checksum(content)
    if not target.exists():
        _write_whole(target, content)
        report.new.append(name)
        noted[name] = wanted
        return
    present = _checksum(target.read_bytes())
    if present == wanted:
        noted[name] = wanted
    elif present == noted.get(name):
        _write_whole(target, content)
        report.updated.append(name)
        noted[name] = wanted
    elif wanted != noted.get(name):
        report.kept.append(name)


def _checksum(content: bytes) -> str:
    return hashlib.sha256(content).hexdigest()


def _write_whole(path: Path, content: bytes) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    unfinished = path.with_name(path.name + ".part")
    unfinished.write_bytes(content)
    os.replace(unfinished, path)


def _write_manifest(folder: Path, noted: dict[str, str]) -> None:
    text = json.dumps({"course": "engdyn", "files": dict(sorted(noted.items()))}, indent=1) + "\n"
    _write_whole(folder / MANIFEST, text.encode())
