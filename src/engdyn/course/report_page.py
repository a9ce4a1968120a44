"""The page that reports are written on: one HTML file that needs nothing else, and never half of it."""

from __future__ import annotations

import html
import os
import tempfile
from collections.abc import Sequence
from importlib import resources
from pathlib import Path
from string import Template

import engdyn
from engdyn.errors import EngdynError

__all__ = ["checked_target", "page", "write_text"]


def checked_target(out: str | Path, force: bool) -> Path:
    """The file to write; refused where its folder does not exist, or where it exists and is not to be replaced.

    Parameters
    ----------
    out : str or Path
    force : bool
        Replace a file that exists.
    """
    target = Path(out)
    if target.is_dir():
        raise EngdynError(f"{target} is a folder: name a file in it, for example {target / 'report.html'}")
    if not target.absolute().parent.is_dir():
        raise EngdynError(
            f"the folder {target.absolute().parent} does not exist: make it, or write elsewhere"
        )
    if target.exists() and not force:
        raise EngdynError(f"{target} exists and was not touched: name another file, or give force=True")
    return target


def write_text(target: Path, text: str) -> None:
    """Write a file that appears when it is complete.

    Parameters
    ----------
    target : Path
    text : str
    """
    descriptor, name = tempfile.mkstemp(prefix=f".{target.name}.", dir=target.parent)
    try:
        with os.fdopen(descriptor, "w", encoding="utf-8", newline="\n") as file:
            file.write(text)
        os.chmod(name, 0o644)
        os.replace(name, target)
    except BaseException:
        Path(name).unlink(missing_ok=True)
        raise


def page(
    parts: Sequence[tuple[str, str]],
    *,
    title: str,
    label: str,
    subtitle: str,
    summary: Sequence[tuple[str, str]],
    command: str,
) -> str:
    """A report as HTML text.

    Parameters
    ----------
    parts : sequence of (heading, HTML)
    title, label, subtitle : str
        Plain text at the top.
    summary : sequence of (name, value)
        Plain text in the boxes below it.
    command : str
        What made the page, for its foot.
    """
    cells = "".join(
        f"<div><dt>{html.escape(name)}</dt><dd>{html.escape(value)}</dd></div>" for name, value in summary
    )
    listed = "".join(
        f'<li><a href="#s{i}">{html.escape(heading)}</a></li>' for i, (heading, _) in enumerate(parts, 1)
    )
    body = f'<dl class="summary">{cells}</dl><nav aria-label="Contents"><ol>{listed}</ol></nav>'
    for i, (heading, text) in enumerate(parts, 1):
        heading = f'<h2 id="s{i}"><span class="number">{i}</span>{html.escape(heading)}</h2>'
        body += f"\n<section>{heading}\n{text}</section>"
    template = Template(resources.files("engdyn.course").joinpath("report_template.html").read_text("utf-8"))
    return template.substitute(
        version=engdyn.__version__,
        title=html.escape(title),
        label=html.escape(label),
        subtitle=html.escape(subtitle),
        body=body,
        footer=f"Made by <code>{html.escape(command)}</code>, engdyn {engdyn.__version__}. SI units, angles in rad.",
    )
