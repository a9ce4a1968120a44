"""The report in a real browser: no request, nothing too wide, fractions drawn as fractions."""

from __future__ import annotations

import importlib.util

import pytest

import engdyn as ed
from engdyn.course.report import report

KEYS = ("S03", "S07", "S23")


@pytest.fixture(scope="module")
def browser():
    """A chromium without a window; skips where there is none, and says what is missing."""
    if importlib.util.find_spec("playwright") is None:
        pytest.skip('playwright is missing: pip install "engdyn[test]"')
    from playwright.sync_api import sync_playwright

    from browser.lab_session import find_browser

    executable = find_browser()
    if executable is None:
        pytest.skip("chromium is missing, for example: apt install chromium")
    with sync_playwright() as playwright:
        found = playwright.chromium.launch(
            executable_path=executable, args=["--no-sandbox", "--disable-gpu", "--disable-quic"]
        )
        yield found
        found.close()


@pytest.mark.browser
@pytest.mark.parametrize("key", KEYS)
def test_shows_in_a_browser_without_a_request(browser, tmp_path, key):
    path = tmp_path / "report.html"
    path.write_text(report(ed.systems.load(key)), "utf-8")
    page = browser.new_page(viewport={"width": 1000, "height": 800})
    asked, said = [], []
    page.on("request", lambda request: asked.append(request.url))
    page.on("console", lambda message: said.append(message.text))
    page.goto(path.as_uri())
    assert [url for url in asked if not url.startswith("data:")] == [path.as_uri()]
    assert said == []
    sizes = page.evaluate("[...document.images].map(i => [i.complete, i.naturalWidth])")
    assert all(complete and width > 200 for complete, width in sizes)
    assert page.evaluate("document.documentElement.scrollWidth") <= 1000
    formulas = "[...document.querySelectorAll('.formula')]"
    assert page.evaluate(f"{formulas}.every(e => e.scrollWidth <= e.clientWidth + 1)")
    raised = page.evaluate(
        """[...document.querySelectorAll('mfrac')].every(f =>
             f.children[0].getBoundingClientRect().bottom <= f.children[1].getBoundingClientRect().top + 1)"""
    )
    assert raised  # fractions are drawn as fractions, so the browser knows MathML
    page.close()
