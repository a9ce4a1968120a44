"""Running a notebook and writing it so that two runs give the same bytes.

A notebook in the project's history carries its outputs. They are worth keeping only if running it
again changes nothing, so everything that belongs to one run alone is left out: timings, random
identifiers, memory addresses, the widgets' state and the version of the interpreter. What remains is
code, text, tables and pictures, and a hash of the code that made them (see `stale_reason`).
"""

from __future__ import annotations

import hashlib
import json
import os
import re
import sys
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..errors import EngdynError

if TYPE_CHECKING:
    from nbformat import NotebookNode

__all__ = [
    "NotebookFailure",
    "clear_outputs",
    "code_hash",
    "execute",
    "normalize",
    "read_notebook",
    "scrub",
    "stale_reason",
    "write_notebook",
]

KERNELSPEC = {"display_name": "Python 3 (ipykernel)", "language": "python", "name": "python3"}
LANGUAGE_INFO = {
    "codemirror_mode": {"name": "ipython", "version": 3},
    "file_extension": ".py",
    "mimetype": "text/x-python",
    "name": "python",
    "nbconvert_exporter": "python",
    "pygments_lexer": "ipython3",
}
WIDGET_VIEW = "application/vnd.jupyter.widget-view+json"
# Text that differs between two runs of the same code; tests/nbval.cfg holds the same pairs. The bytes in
# the text of an Image widget change with every version of matplotlib, and the text may break off in them.
SCRUBBED = (
    (re.compile(r"0x[0-9a-fA-F]{6,16}"), "0xADDRESS"),
    (re.compile(r"""value=b(['"])(?:\\.|[^\\])*?(\1|\\?…)"""), "value=b'PICTURE'"),
)


class NotebookFailure(EngdynError):
    """A notebook cannot be read, or a cell of it raised an error that it does not announce."""


def read_notebook(path: str | Path) -> NotebookNode:
    """Read a notebook and give every cell a fixed identifier.

    Identifiers that are there and unique stay; the others are made from the kind and the position of
    the cell (``c03`` for a code cell in third place, ``m04`` for text in fourth).

    Raises
    ------
    NotebookFailure
        If the file cannot be read or is not a notebook of format 4.
    """
    import nbformat

    path = Path(path)
    try:
        content = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise NotebookFailure(f"{path} cannot be read as a notebook: {error}") from error
    if not isinstance(content, dict) or content.get("nbformat") != 4 or "cells" not in content:
        raise NotebookFailure(f"{path} is not a notebook of format 4; open and save it in JupyterLab first.")
    content["nbformat_minor"] = 5
    _fix_identifiers(content["cells"])
    return nbformat.reads(json.dumps(content), as_version=4)


def _fix_identifiers(cells: list[dict[str, Any]]) -> None:
    kept: set[str] = set()
    for cell in cells:
        if cell.get("id") in kept:
            del cell["id"]  # a copied cell: the first one keeps the name
        elif "id" in cell:
            kept.add(cell["id"])
    for position, cell in enumerate(cells, start=1):
        if "id" in cell:
            continue
        name = wanted = f"{cell['cell_type'][0]}{position:02d}"
        suffix = 2
        while name in kept:
            name, suffix = f"{wanted}-{suffix}", suffix + 1
        cell["id"] = name
        kept.add(name)


def clear_outputs(notebook: NotebookNode) -> NotebookNode:
    """Remove every output and execution count, in place; returns the same notebook."""
    for cell in notebook.cells:
        if cell.cell_type == "code":
            cell.outputs = []
            cell.execution_count = None
    return notebook


def execute(notebook: NotebookNode, folder: str | Path, *, timeout: float = 600.0) -> NotebookNode:
    """Run all cells of a notebook in place and bring the result into its repeatable form.

    Parameters
    ----------
    notebook : NotebookNode
        As `read_notebook` returns it; its old outputs are dropped.
    folder : str or Path
        Working directory of the kernel, the folder of the notebook.
    timeout : float
        Longest time one cell may take [s].

    Raises
    ------
    NotebookFailure
        If a cell raises an error and does not carry the tag ``raises-exception``, or takes too long.
    """
    from nbclient import NotebookClient
    from nbclient.exceptions import CellExecutionError, CellTimeoutError, DeadKernelError

    clear_outputs(notebook)
    client = NotebookClient(
        notebook,
        km=_kernel_manager(),
        timeout=timeout,
        startup_timeout=120,
        record_timing=False,
        store_widget_state=True,
        coalesce_streams=True,
        resources={"metadata": {"path": str(folder)}},
    )
    with tempfile.TemporaryDirectory(prefix="engdyn-ipython-") as profile:
        try:
            client.execute(env=_kernel_environment(profile))
        except (CellExecutionError, CellTimeoutError, DeadKernelError) as error:
            raise NotebookFailure(f"{_failed_cell(notebook)}{error}") from error
    return normalize(notebook)


def _kernel_manager() -> Any:
    """A manager for a kernel of this very interpreter, whatever kernels are registered on the machine."""
    from jupyter_client.kernelspec import KernelSpec, KernelSpecManager
    from jupyter_client.manager import AsyncKernelManager

    class ThisInterpreter(KernelSpecManager):  # type: ignore[misc]
        def get_kernel_spec(self, kernel_name: str) -> KernelSpec:
            argv = [
                sys.executable,
                "-m",
                "ipykernel_launcher",
                "-f",
                "{connection_file}",
                "--log-level=ERROR",
            ]
            return KernelSpec(argv=argv, display_name=kernel_name, language="python", resource_dir="")

    return AsyncKernelManager(kernel_name="python3", kernel_spec_manager=ThisInterpreter())


def _kernel_environment(profile: str) -> dict[str, str]:
    """The environment of the kernel, without the user's own IPython profile and matplotlib backend."""
    environment = {name: value for name, value in os.environ.items() if name != "MPLBACKEND"}
    return environment | {"IPYTHONDIR": profile, "PYDEVD_DISABLE_FILE_VALIDATION": "1"}


def _failed_cell(notebook: NotebookNode) -> str:
    for position, cell in enumerate(notebook.cells, start=1):
        if any(output.output_type == "error" for output in cell.get("outputs", ())):
            return f"cell {position} (id {cell.id}) failed:\n"
    return ""


def scrub(text: str) -> str:
    """Replace what differs between two runs of the same code.

    Examples
    --------
    >>> scrub("<Line2D object at 0x7f3a12c4d5e0>")
    '<Line2D object at 0xADDRESS>'
    """
    for pattern, replacement in SCRUBBED:
        text = pattern.sub(replacement, text)
    return text


def normalize(notebook: NotebookNode) -> NotebookNode:
    """Drop from an executed notebook what belongs to one run alone, in place; note the hash of its code."""
    metadata = notebook.metadata
    metadata.pop("widgets", None)
    metadata["kernelspec"] = dict(KERNELSPEC)
    metadata["language_info"] = dict(LANGUAGE_INFO)
    metadata["engdyn"] = {**metadata.get("engdyn", {}), "code_sha256": code_hash(notebook)}
    for cell in notebook.cells:
        cell.metadata.pop("execution", None)
        if cell.cell_type == "code":
            cell.outputs = [_normalized_output(output) for output in cell.outputs]
    return notebook


def _normalized_output(output: Any) -> Any:
    if output.output_type == "stream":
        output.text = scrub(output.text)
    elif output.output_type == "error":
        output.traceback = [scrub(line) for line in output.traceback]
    else:
        output.data.pop(WIDGET_VIEW, None)  # a view without its state shows nothing but an error
        for kind, value in output.data.items():
            if kind.startswith("text/") and isinstance(value, str):
                output.data[kind] = scrub(value)
    return output


def code_hash(notebook: NotebookNode) -> str:
    """SHA-256 of all code of a notebook, cell by cell."""
    digest = hashlib.sha256()
    for cell in notebook.cells:
        if cell.cell_type == "code":
            digest.update(cell.source.encode() + b"\0")
    return digest.hexdigest()


def stale_reason(notebook: NotebookNode) -> str:
    """Why the outputs of a notebook cannot be trusted; empty when its code made them."""
    noted = notebook.metadata.get("engdyn", {}).get("code_sha256")
    if noted is None:
        return "was never built"
    if noted != code_hash(notebook):
        return "its code changed after its outputs were made"
    for position, cell in enumerate(notebook.cells, start=1):
        if cell.cell_type == "code" and cell.source.strip() and cell.execution_count is None:
            return f"cell {position} has no outputs"
    return ""


def write_notebook(notebook: NotebookNode, path: str | Path) -> bool:
    """Write a notebook, whole or not at all; returns whether the file changed."""
    import nbformat

    path = Path(path)
    text = nbformat.writes(notebook).rstrip("\n") + "\n"
    if path.is_file() and path.read_text(encoding="utf-8") == text:
        return False
    path.parent.mkdir(parents=True, exist_ok=True)
    unfinished = path.with_name(path.name + ".part")
    unfinished.write_text(text, encoding="utf-8", newline="\n")
    os.replace(unfinished, path)
    return True
