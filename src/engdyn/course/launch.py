"""Opening the course in JupyterLab, for this machine and this user only."""

from __future__ import annotations

import importlib.util
import json
import os
import secrets
import signal
import socket
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

from ..errors import EngdynError

__all__ = ["LaunchError", "lab_process", "lab_settings", "open_lab"]

USUAL_PORTS = range(8888, 8988)
FIRST_PAGE = "notebooks/00_start_here.ipynb"


class LaunchError(EngdynError):
    """JupyterLab cannot be started as asked."""


def lab_settings(root: Path, token: str, port: int, *, browser: bool = True) -> dict[str, Any]:
    """Settings of a JupyterLab that listens on the loopback address and asks for a token.

    Parameters
    ----------
    root : Path
        Folder that the file browser shows.
    token : str
        Secret that the address in the browser carries.
    port : int
        Port to listen on, this one and no other.
    browser : bool
        Whether to open a browser window.
    """
    return {
        "Application": {"log_level": "WARN"},
        "ServerApp": {
            "ip": "127.0.0.1",
            "port": port,
            "port_retries": 0,
            "root_dir": str(root),
            "open_browser": browser,
            "allow_root": hasattr(os, "geteuid") and os.geteuid() == 0,  # a container has no other user
        },
        "LabApp": {
            "default_url": _first_page(root),
            "news_url": None,
            "check_for_updates_class": "jupyterlab.NeverCheckForUpdate",
        },
        "IdentityProvider": {"token": token},
    }


def _first_page(root: Path) -> str:
    return f"/lab/tree/{FIRST_PAGE}" if (root / FIRST_PAGE).is_file() else "/lab"


def open_lab(root: str | Path, *, port: int | None = None, browser: bool = True) -> int:
    """Run JupyterLab in a folder until it is shut down; returns its exit code.

    The token is new each time and reaches the server through a file that only this user can read: a command
    line can be read by everybody on the machine.

    Raises
    ------
    LaunchError
        If JupyterLab is not installed or the port cannot be used.
    """
    if importlib.util.find_spec("jupyterlab") is None:
        raise LaunchError('JupyterLab is not installed here. Install it with: pip install "engdyn[lab]"')
    root = Path(root).absolute()
    port = _free_port() if port is None else _checked_port(port)
    token = secrets.token_hex(24)
    settings = lab_settings(root, token, port, browser=browser)
    print(f"The course is served at http://127.0.0.1:{port}{_first_page(root)}?token={token}")
    print("Ready in a few seconds. To stop it, press Ctrl-C here.", flush=True)
    with tempfile.TemporaryDirectory(prefix="engdyn-lab-") as private:
        command, environment = lab_process(Path(private), settings)
        return _run_until_stopped(command, environment)


def _run_until_stopped(command: list[str], environment: dict[str, str]) -> int:
    with subprocess.Popen(command, env=environment) as lab:
        previous = signal.signal(signal.SIGTERM, lambda *_: lab.terminate())
        try:
            while True:
                try:
                    return lab.wait()
                except KeyboardInterrupt:  # JupyterLab got it too and asks whether to stop
                    continue
        finally:
            signal.signal(signal.SIGTERM, previous)


def lab_process(private: Path, settings: dict[str, Any]) -> tuple[list[str], dict[str, str]]:
    """Command and environment of a JupyterLab with these settings, which are written to a private folder."""
    config = private / "jupyter_server_config.json"
    config.write_text(json.dumps(settings), encoding="utf-8")
    # Without its announcements JupyterLab neither covers the first page with a question nor asks the network.
    page = private / "labconfig" / "page_config.json"
    page.parent.mkdir()
    quiet = {"disabledExtensions": {"@jupyterlab/apputils-extension:announcements": True}}
    page.write_text(json.dumps(quiet), encoding="utf-8")
    search = [str(private), os.environ.get("JUPYTER_CONFIG_PATH", "")]
    environment = os.environ | {
        "JUPYTER_CONFIG_PATH": os.pathsep.join(filter(None, search)),
        "JUPYTER_PREFER_ENV_PATH": "1",  # kernels of this environment come first
    }
    return [sys.executable, "-m", "jupyterlab", f"--config={config}"], environment


def _checked_port(port: int) -> int:
    if not 1 <= port <= 65535:
        raise LaunchError(f"port {port} does not exist; choose one from 1024 to 65535, or leave --port out.")
    reason = _why_not(port)
    if reason:
        raise LaunchError(f"port {port} cannot be used ({reason}); choose another one, or leave --port out.")
    return port


def _free_port() -> int:
    for port in USUAL_PORTS:
        if not _why_not(port):
            return port
    first, last = USUAL_PORTS[0], USUAL_PORTS[-1]
    raise LaunchError(f"ports {first} to {last} are all in use; name a free one with --port.")


def _why_not(port: int) -> str:
    """Why a server cannot listen on a port of this machine; empty when it can."""
    with socket.socket(socket.AF_INET, socket.SOCK_STREAM) as probe:
        if os.name != "nt":
            probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            probe.bind(("127.0.0.1", port))
        except OSError as error:
            return error.strerror or str(error)
    return ""
