"""Notebooks are run and written so that a second run changes nothing."""

from __future__ import annotations

import json
import re

import nbformat
import pytest
from nbformat.v4 import new_code_cell, new_markdown_cell, new_notebook

from engdyn.course import build, execution

EVERYTHING = [
    "import matplotlib.pyplot as plt\nimport ipywidgets as widgets\nfrom IPython.display import display",
    "plt.figure(figsize=(2, 1), dpi=60)\nplt.plot([0, 1], [1, 0])\nplt.show()",
    "print('first'); print('second', flush=True)\nprint(object())\n{'q': object()}",
    "slider = widgets.FloatSlider(value=0.5)\npicture = widgets.Image(value=b'\\x89PNG' + bytes(range(40)))\n"
    "display(slider)\nwidgets.VBox([slider, picture])",
]


@pytest.fixture
def notebook_path(tmp_path):
    """A notebook whose outputs differ in every run unless the build takes care."""
    cells = [new_markdown_cell("# A notebook")] + [new_code_cell(source) for source in EVERYTHING]
    notebook = new_notebook(cells=cells)
    content = json.loads(nbformat.writes(notebook))
    for cell in content["cells"]:
        del cell["id"]
    path = tmp_path / "notebooks" / "98_everything.ipynb"
    path.parent.mkdir()
    path.write_text(json.dumps(content), encoding="utf-8")
    return path


def test_two_builds_are_byte_identical_and_the_result_is_clean(notebook_path):
    assert build.build(notebook_path) == [notebook_path]
    first = notebook_path.read_bytes()
    assert build.build(notebook_path) == []
    assert notebook_path.read_bytes() == first

    text = first.decode()
    notebook = nbformat.reads(text, as_version=4)
    nbformat.validate(notebook)
    assert [cell.id for cell in notebook.cells] == ["m01", "c02", "c03", "c04", "c05"]
    assert "widgets" not in notebook.metadata
    assert "widget-view" not in text
    assert not re.search(r"0x[0-9a-f]{6,}", text)
    assert all("execution" not in cell.metadata for cell in notebook.cells)
    assert "version" not in notebook.metadata.language_info
    assert text.endswith("}\n")

    picture, printed, shown = (notebook.cells[k].outputs for k in (2, 3, 4))
    assert picture[0].data["image/png"].startswith("iVBOR")
    assert printed[0].text == "first\nsecond\n<object object at 0xADDRESS>\n"
    assert printed[1].data["text/plain"] == "{'q': <object at 0xADDRESS>}"
    assert shown[0].data["text/plain"].startswith("FloatSlider(value=0.5")
    assert "Image(value=b'PICTURE'" in shown[1].data["text/plain"]
    assert [cell.execution_count for cell in notebook.cells[1:]] == [1, 2, 3, 4]


def test_identifiers_that_are_there_stay_and_copies_get_their_own():
    cells = [{"cell_type": "code", "id": name} for name in ("free-body", "c03", "free-body")]
    cells.append({"cell_type": "markdown"})
    execution._fix_identifiers(cells)
    assert [cell["id"] for cell in cells] == ["free-body", "c03", "c03-2", "m04"]


def test_check_names_what_changed_since_the_outputs_were_made(notebook_path, capsys):
    assert build.check(notebook_path) == ["notebooks/98_everything.ipynb was never built"]
    notebook = execution.read_notebook(notebook_path)
    for count, cell in enumerate(notebook.cells[1:], start=1):
        cell.execution_count = count
    execution.write_notebook(execution.normalize(notebook), notebook_path)
    assert build.check(notebook_path) == []

    notebook.cells[0].source = "# Another title"
    execution.write_notebook(notebook, notebook_path)
    assert build.check(notebook_path) == []

    notebook.cells[1].source += "\n# edited"
    execution.write_notebook(notebook, notebook_path)
    assert build.main(["--check", str(notebook_path)]) == 1
    assert "its code changed after its outputs were made" in capsys.readouterr().out


def test_a_failing_cell_is_named_and_nothing_is_written(tmp_path, capsys):
    path = tmp_path / "notebooks" / "97_fails.ipynb"
    cells = [new_code_cell("x = 1"), new_code_cell("raise RuntimeError('the crane fell over')", id="crane")]
    path.parent.mkdir()
    nbformat.write(new_notebook(cells=cells), path)
    before = path.read_bytes()
    assert build.main([str(path)]) == 1
    message = capsys.readouterr().err
    assert "cell 2 (id crane) failed" in message
    assert "the crane fell over" in message
    assert path.read_bytes() == before


@pytest.mark.parametrize(
    ("text", "clean"),
    [
        (r"Image(value=b'\x89PNG\r\n', width='300')", "Image(value=b'PICTURE', width='300')"),
        (r"VBox(children=(Image(value=b'\x89PNG\…", "VBox(children=(Image(value=b'PICTURE'"),
        (
            """Image(value=b'\\x89\\'"', width='3'), Image(value=b"it's")""",
            "Image(value=b'PICTURE', width='3'), Image(value=b'PICTURE')",
        ),
        ("<a at 0x7f3a12c4d5e0> and 0x1F", "<a at 0xADDRESS> and 0x1F"),
    ],
)
def test_scrubbing_of_bytes_and_addresses(text, clean):
    assert execution.scrub(text) == clean


def test_an_announced_error_is_an_output(tmp_path):
    cell = new_code_cell("raise RuntimeError('as announced')", metadata={"tags": ["raises-exception"]})
    notebook = execution.execute(new_notebook(cells=[cell]), tmp_path)
    assert notebook.cells[0].outputs[0].ename == "RuntimeError"


def test_the_kernel_is_this_interpreter_in_the_notebooks_folder(tmp_path):
    import sys

    cell = new_code_cell("import os, sys\nprint(sys.executable)\nprint(os.getcwd())")
    notebook = execution.execute(new_notebook(cells=[cell]), tmp_path)
    executable, folder = notebook.cells[0].outputs[0].text.split("\n")[:2]
    assert executable == sys.executable
    assert folder == str(tmp_path.resolve())


@pytest.mark.parametrize(
    ("content", "message"),
    [("{", "cannot be read"), ('{"nbformat": 3, "cells": []}', "format 4"), ("[]", "format 4")],
)
def test_what_is_no_notebook_is_refused(tmp_path, content, message):
    path = tmp_path / "broken.ipynb"
    path.write_text(content)
    with pytest.raises(execution.NotebookFailure, match=message):
        execution.read_notebook(path)


def test_a_folder_without_notebooks_is_an_error(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert build.main([]) == 1
    assert "No notebooks here" in capsys.readouterr().err


def test_the_tests_sanitize_exactly_what_the_build_scrubs(checkout):
    from nbval.plugin import get_sanitize_patterns

    text = (checkout / "tests" / "nbval.cfg").read_text(encoding="utf-8")
    expected = {pattern.pattern: replacement for pattern, replacement in execution.SCRUBBED}
    assert dict(get_sanitize_patterns(text)) == expected
