"""One JupyterLab and one browser for all tests of this folder."""

from __future__ import annotations

import importlib.util
import shutil

import pytest

from browser import lab_session


@pytest.fixture(scope="session")
def chromium():
    """A running browser; skips where there is none, and says what is missing."""
    for module in ("playwright", "jupyterlab"):
        if importlib.util.find_spec(module) is None:
            pytest.skip(f'{module} is missing: pip install "engdyn[lab,test]"')
    executable = lab_session.find_browser()
    if executable is None:
        pytest.skip(f"no browser found ({', '.join(lab_session.BROWSERS)}); on Debian: apt install chromium")
    from playwright.sync_api import sync_playwright

    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=executable, args=lab_session.FLAGS)
        yield browser
        browser.close()


@pytest.fixture(scope="session")
def lab(checkout, tmp_path_factory, chromium):
    """JupyterLab on a copy of the course, so that no test writes into the checkout."""
    root = tmp_path_factory.mktemp("course")
    for part in ("notebooks", "exercises"):
        shutil.copytree(checkout / part, root / part, ignore=shutil.ignore_patterns(".*", "__pycache__"))
    (root / "tests").mkdir()
    with lab_session.running_lab(root, tmp_path_factory.mktemp("home")) as running:
        yield running


@pytest.fixture
def lab_page(chromium, lab, tmp_path):
    """A fresh browser page; its last sight stays in the test's tmp_path."""
    context = chromium.new_context(viewport={"width": 1280, "height": 900})
    page = context.new_page()
    seen = lab_session.LabPage(page, lab)
    try:
        yield seen
    finally:
        page.screenshot(path=tmp_path / "last_sight.png")
        context.close()
        seen.close()
