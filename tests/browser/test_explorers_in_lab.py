"""Every explorer in a real JupyterLab: driven by the keyboard, it changes its picture and shows its code."""

from __future__ import annotations

import time

import nbformat
import pytest
from nbformat.v4 import new_code_cell, new_notebook

import engdyn as ed
from browser import lab_session
from engdyn.course import execution

pytestmark = pytest.mark.browser

EXPLORERS = ed.widgets.catalogue()


def test_explorers_answer_to_the_keyboard(lab_page, tmp_path):
    path = lab_page.lab.root / "tests" / "explorers.ipynb"
    sources = ["import engdyn as ed", *(f"ed.widgets.{name}()" for name in EXPLORERS), ""]
    notebook = new_notebook(cells=[new_code_cell(source) for source in sources])
    notebook.metadata["kernelspec"] = execution.KERNELSPEC
    nbformat.write(notebook, path)
    lab_page.open("tests/explorers.ipynb")
    lab_page.run_all()
    assert lab_page.errors() == []
    views = lab_page.page.locator(".jp-OutputArea-output:has(img.widget-image)")
    assert views.count() == len(EXPLORERS)  # one picture each
    for i, name in enumerate(EXPLORERS):
        view = views.nth(i)
        view.scroll_into_view_if_needed()
        assert _changed_by_key(view), f"{name}: the picture does not change"
        view.get_by_role("button", name="Show code").press("Enter")
        view.locator("pre", has_text="import engdyn as ed").wait_for()
        view.screenshot(path=tmp_path / f"{name}.png")
    assert lab_page.errors() == []
    assert lab_page.foreign_hosts == set()


def _changed_by_key(view) -> bool:
    """Whether an arrow key on one of the first sliders changes the picture."""
    picture = view.locator("img.widget-image").first
    before = lab_session._picture_hash(picture)
    for handle in view.locator(".noUi-handle").all()[:3]:
        handle.focus()
        handle.press("ArrowRight")
        deadline = time.monotonic() + 10
        while time.monotonic() < deadline:
            if lab_session._picture_hash(picture) != before:
                return True
            time.sleep(0.05)
    return False
