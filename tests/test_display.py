"""How systems show themselves in a notebook."""

from __future__ import annotations

import subprocess
import sys

import pytest
from IPython.core.interactiveshell import InteractiveShell

import engdyn as ed
from engdyn.display import register


@pytest.fixture
def shown(monkeypatch):
    """What a cell that ends with an object displays: a list of MIME bundles."""
    shell = InteractiveShell.instance()
    register()
    published = []
    monkeypatch.setattr(shell.display_pub, "publish", lambda data, *_, **__: published.append(data))

    def show(thing):
        published.clear()
        shell.display_formatter.format(thing)
        return list(published)

    yield show
    InteractiveShell.clear_instance()


def test_a_system_shows_its_drawing_above_its_description(shown):
    picture, table = shown(ed.systems.load("S07"))
    assert set(picture) == {"image/png", "text/plain"}
    assert "Gantry crane" in picture["text/plain"]
    assert "container inertia about CG" in table["text/html"] or "container" in table["text/html"]
    assert table["text/plain"].startswith("System(S07")


def test_a_subclass_shows_itself_alike_and_a_system_without_drawing_its_description(shown):
    class Own(ed.System):
        pass

    x = ed.systems.load("W10").coordinates
    own = Own(
        title="Bare", coordinates=x, parameters=(), kinetic_energy=x[0].symbol.diff() ** 2, potential_energy=0
    )
    (table,) = shown(own)
    assert "Bare" in table["text/html"]


def test_without_ipython_nothing_is_loaded():
    code = "import sys, engdyn; print('IPython' in sys.modules, 'engdyn.display' in sys.modules)"
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert run.stdout.split() == ["False", "False"]
