"""An animation in a real JupyterLab: the picture moves while it plays, stands still after, follows the slider."""

from __future__ import annotations

import time

import pytest

from browser.lab_session import PATIENCE, _picture_hash
from browser.test_notebooks_in_lab import _put

pytestmark = pytest.mark.browser

SWING = """import numpy as np
import engdyn as ed
t = np.linspace(0.0, 40.0, 1001)
q = np.column_stack([0.0 * t, 0.6 * np.cos(1.5 * t)])
ed.plots.animate(ed.systems.load("S07"), (t, q))"""


def test_the_picture_moves_from_play_to_pause_and_follows_the_slider(lab_page):
    lab_page.open(_put(lab_page.lab, "swing.ipynb", SWING))
    lab_page.run_all()
    assert lab_page.errors() == []
    button = lab_page.page.locator(".jp-OutputArea-output button.widget-toggle-button")
    picture = lab_page.page.locator(".jp-OutputArea-output img.widget-image")
    seen, end = {_picture_hash(picture)}, time.monotonic() + PATIENCE / 1000
    button.click()
    while len(seen) < 4 and time.monotonic() < end:
        seen.add(_picture_hash(picture))
    assert len(seen) >= 4
    assert button.inner_text().strip() == "Pause"
    button.click()
    # A tick or two may still be on their way from the kernel.
    time.sleep(1.0)
    still = _picture_hash(picture)
    before, after, _ = lab_page.step_first_slider("ArrowRight")
    assert before == still != after
    assert lab_page.step_first_slider("ArrowLeft")[:2] == (after, before)
