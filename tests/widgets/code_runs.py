"""Runs the code that an explorer shows, as a student would in a cell of their own."""

from __future__ import annotations

import runpy
import tempfile
from pathlib import Path
from typing import Any

from engdyn.plots import alternative


def run(explorer, monkeypatch) -> tuple[dict[str, Any], list[str]]:
    """Names that the code leaves behind, and the words of the pictures that it shows."""
    shown: list[str] = []
    monkeypatch.setattr(
        "engdyn.plots.show", lambda drawn: shown.append(alternative.alt(drawn)), raising=False
    )
    with tempfile.TemporaryDirectory() as folder:
        script = Path(folder) / "cell.py"
        script.write_text(explorer.code, encoding="utf-8")
        return runpy.run_path(str(script)), shown
