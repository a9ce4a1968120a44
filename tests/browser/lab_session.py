"""A real JupyterLab in a real browser, for tests.

`running_lab` starts the server the way `engdyn lab` does, in an isolated home; `LabPage` opens one notebook
in it and sees what a student sees: cells that ran, errors, sliders, pictures.
"""

from __future__ import annotations

import contextlib
import hashlib
import json
import os
import re
import shutil
import socket
import subprocess
import time
import urllib.error
import urllib.request
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from urllib.parse import urlparse

from engdyn.course.launch import lab_process, lab_settings

BROWSERS = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable")
FLAGS = [
    "--headless",
    "--no-sandbox",
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
]
PATIENCE = 240_000  # ms for a page or a whole notebook, on a machine with other things to do
CODE_CELLS = ".jp-NotebookPanel:not(.lm-mod-hidden) .jp-CodeCell"
# JupyterLab gives errors the same type as text on stderr; only errors tell where they come from.
STDERR = f"{CODE_CELLS} [data-mime-type='application/vnd.jupyter.stderr']"
SIGNS_OF_ERROR = ("Traceback (most recent call last)", "SyntaxError", "IndentationError")
# The prompts of the cells that hold code: "[ ]:" never ran, "[*]:" waits or runs, "[3]:" ran.
PROMPTS = f"""() => [...document.querySelectorAll("{CODE_CELLS}")]
    .filter(cell => cell.querySelector(".cm-content").textContent.trim() !== "")
    .map(cell => cell.querySelector(".jp-InputPrompt").textContent)"""
NOTHING_RAN = f"() => ({PROMPTS})().every(prompt => !/\\d|\\*/.test(prompt))"
RUN_ENDED = f"""() => {{
    const prompts = ({PROMPTS})();
    return prompts.some(prompt => /\\d/.test(prompt)) && !prompts.some(prompt => prompt.includes("*"));
}}"""


def find_browser() -> str | None:
    """Path of a chromium or of one of its relatives; ENGDYN_CHROMIUM names another one."""
    named = os.environ.get("ENGDYN_CHROMIUM")
    return named or next(filter(None, map(shutil.which, BROWSERS)), None)


@dataclass(frozen=True)
class Lab:
    """A running server: its address, the token it asks for, and the folder it serves."""

    address: str
    token: str
    root: Path
    log: Path


@contextlib.contextmanager
def running_lab(root: Path, home: Path) -> Iterator[Lab]:
    """JupyterLab serving a folder, with settings of its own; stopped on the way out."""
    token, port = "browser-test-token", _free_port()
    settings = lab_settings(root, token, port, browser=False)
    settings["LabApp"]["user_settings_dir"] = str(home / "settings")
    notebook = home / "settings" / "@jupyterlab" / "notebook-extension" / "tracker.jupyterlab-settings"
    notebook.parent.mkdir(parents=True)
    notebook.write_text(json.dumps({"windowingMode": "none"}))  # all cells are in the page, seen or not
    (home / "private").mkdir()
    command, environment = lab_process(home / "private", settings)
    environment |= {
        "HOME": str(home),
        "JUPYTER_CONFIG_DIR": str(home / "jupyter"),
        "IPYTHONDIR": str(home / "ipython"),
    }
    lab = Lab(f"http://127.0.0.1:{port}", token, root, home / "lab.log")
    with lab.log.open("w") as log:
        server = subprocess.Popen(command, env=environment, stdout=log, stderr=log, cwd=root)
    try:
        _wait_for(lab, server)
        yield lab
    finally:
        server.terminate()
        try:
            server.wait(timeout=15)
        except subprocess.TimeoutExpired:
            server.kill()
            server.wait()


def _free_port() -> int:
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


def _wait_for(lab: Lab, server: subprocess.Popen[bytes], seconds: float = 90) -> None:
    request = urllib.request.Request(
        f"{lab.address}/api/status", headers={"Authorization": f"token {lab.token}"}
    )
    deadline = time.monotonic() + seconds
    while time.monotonic() < deadline and server.poll() is None:
        try:
            with urllib.request.urlopen(request, timeout=5):
                return
        except (urllib.error.URLError, OSError):
            time.sleep(0.2)
    raise RuntimeError(f"JupyterLab did not start:\n{lab.log.read_text()[-3000:]}")


class LabPage:
    """One notebook, opened in JupyterLab in a browser page."""

    def __init__(self, page, lab: Lab):
        self.page = page
        self.lab = lab
        self.foreign_hosts: set[str] = set()
        page.set_default_timeout(PATIENCE)
        page.on("request", self._note_host)

    def _note_host(self, request) -> None:
        url = urlparse(request.url)
        if url.scheme in ("http", "https", "ws", "wss") and url.hostname != "127.0.0.1":
            self.foreign_hosts.add(url.hostname)

    def open(self, notebook: str) -> None:
        """Open a notebook of the served folder and wait for its kernel."""
        assert (self.lab.root / notebook).is_file(), f"the course has no {notebook}"
        self.page.goto(f"{self.lab.address}/lab/tree/{notebook}?token={self.lab.token}&reset")
        self.page.wait_for_selector(".jp-Notebook-ExecutionIndicator[data-status=idle]")
        self.page.wait_for_selector(CODE_CELLS)

    def run_all(self) -> None:
        """Drop all stored outputs, run every cell in the new kernel, and wait until the last one or an error."""
        self.page.locator(CODE_CELLS).first.locator(".cm-content").click()
        self._menu("Edit", "editmenu:clear-all")
        self.page.wait_for_function(NOTHING_RAN)
        self._menu("Run", "runmenu:run-all")
        self.page.wait_for_function(RUN_ENDED)
        self.page.wait_for_selector(".jp-Notebook-ExecutionIndicator[data-status=idle]")

    def _menu(self, title: str, command: str) -> None:
        self.page.locator(".lm-MenuBar-item", has_text=title).first.click()
        self.page.locator(f".lm-Menu-item[data-command='{command}']").click()

    def close(self) -> None:
        """Stop all kernels: those of notebooks that nobody looks at any more cost memory and time."""
        for kernel in json.loads(self._ask("GET", "kernels")):
            self._ask("DELETE", f"kernels/{kernel['id']}")

    def _ask(self, method: str, what: str) -> bytes:
        request = urllib.request.Request(
            f"{self.lab.address}/api/{what}",
            headers={"Authorization": f"token {self.lab.token}"},
            method=method,
        )
        with urllib.request.urlopen(request, timeout=60) as answer:
            return answer.read()

    def errors(self) -> list[str]:
        """Text of every error that a cell shows, and every cell that did not run."""
        texts = self.page.locator(STDERR).all_inner_texts()
        found = [text.strip() for text in texts if any(sign in text for sign in SIGNS_OF_ERROR)]
        prompts = enumerate(self.page.evaluate(PROMPTS), start=1)
        return found + [f"code cell {k} did not run" for k, prompt in prompts if not re.search(r"\d", prompt)]

    def step_first_slider(self, key: str = "ArrowRight") -> tuple[str, str, float]:
        """Press a key on the first slider that stands with a picture.

        Returns the hash of the picture's bytes before and after, and the seconds until it changed.
        """
        view = self.page.locator(".jp-OutputArea-output:has(.noUi-handle):has(img.widget-image)").first
        view.scroll_into_view_if_needed()
        picture = view.locator("img.widget-image").first
        before = _picture_hash(picture)
        handle = view.locator(".noUi-handle").first
        handle.focus()
        start = time.monotonic()
        handle.press(key)
        after = before
        while after == before and time.monotonic() - start < PATIENCE / 1000:
            time.sleep(0.02)
            after = _picture_hash(picture)
        return before, after, time.monotonic() - start


def _picture_hash(picture) -> str:
    """SHA-256 of the bytes an image widget shows, whatever address the page gave them."""
    content = picture.evaluate(
        "async image => Array.from(new Uint8Array(await (await fetch(image.src)).arrayBuffer()))"
    )
    return hashlib.sha256(bytes(content)).hexdigest()
