"""JupyterLab is started for this machine and this user only, whatever else is configured."""

from __future__ import annotations

import http.client
import json
import os
import re
import socket
import subprocess
import sys
import time
from pathlib import Path

import pytest

from engdyn.course import launch


@pytest.fixture
def taken_port():
    with socket.socket() as server:
        server.bind(("127.0.0.1", 0))
        server.listen()
        yield server.getsockname()[1]


def _free_port() -> int:
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


def test_settings_open_the_first_page_when_there_is_one(tmp_path):
    assert launch.lab_settings(tmp_path, "t", 8888)["LabApp"]["default_url"] == "/lab"
    (tmp_path / "notebooks").mkdir()
    (tmp_path / "notebooks" / "00_start_here.ipynb").write_text("{}")
    settings = launch.lab_settings(tmp_path, "t", 8888, browser=False)
    assert settings["LabApp"]["default_url"] == "/lab/tree/notebooks/00_start_here.ipynb"
    assert settings["ServerApp"]["open_browser"] is False


def test_a_port_in_use_is_named(tmp_path, taken_port):
    with pytest.raises(launch.LaunchError, match=f"port {taken_port} cannot be used"):
        launch.open_lab(tmp_path, port=taken_port, browser=False)


@pytest.mark.parametrize("port", [0, -1, 65536])
def test_a_port_that_does_not_exist_is_refused(tmp_path, port):
    with pytest.raises(launch.LaunchError, match="does not exist"):
        launch.open_lab(tmp_path, port=port, browser=False)


def test_without_jupyterlab_the_message_says_how_to_get_it(tmp_path, monkeypatch):
    monkeypatch.setattr(launch.importlib.util, "find_spec", lambda name: None)
    with pytest.raises(launch.LaunchError, match="engdyn\\[lab\\]"):
        launch.open_lab(tmp_path)


def test_the_next_port_is_taken_when_the_first_is_in_use(monkeypatch, taken_port):
    free = _free_port()
    monkeypatch.setattr(launch, "USUAL_PORTS", [taken_port, free])
    assert launch._free_port() == free
    monkeypatch.setattr(launch, "USUAL_PORTS", [taken_port])
    with pytest.raises(launch.LaunchError, match="all in use"):
        launch._free_port()


def _status(port: int, path: str, method: str = "GET", token: str = "") -> int:
    connection = http.client.HTTPConnection("127.0.0.1", port, timeout=5)
    headers = {"Authorization": f"token {token}"} if token else {}
    try:
        connection.request(method, path, headers=headers)
        return connection.getresponse().status
    except OSError:
        return 0
    finally:
        connection.close()


def test_a_running_server_asks_for_its_token_even_where_a_configuration_switches_it_off(tmp_path):
    careless = {
        "ServerApp": {"token": "", "password": "", "ip": "0.0.0.0"},
        "IdentityProvider": {"token": ""},
    }
    (tmp_path / "config").mkdir()
    (tmp_path / "config" / "jupyter_server_config.json").write_text(json.dumps(careless))
    isolated = {
        "JUPYTER_CONFIG_DIR": str(tmp_path / "config"),
        "HOME": str(tmp_path),
        "TMPDIR": str(tmp_path),
    }
    environment = os.environ | isolated
    port = _free_port()
    arguments = f"{str(tmp_path)!r}, port={port}, browser=False"
    code = f"from engdyn.course.launch import open_lab; open_lab({arguments})"
    log = tmp_path / "log.txt"
    with log.open("w") as output:
        lab = subprocess.Popen([sys.executable, "-c", code], env=environment, stdout=output, stderr=output)
    try:
        deadline = time.monotonic() + 60
        while _status(port, "/api/contents") == 0 and time.monotonic() < deadline:
            time.sleep(0.2)
        token = re.search(r"token=([0-9a-f]{48})", log.read_text())
        assert token, log.read_text()
        assert _status(port, "/api/contents") == 403
        assert _status(port, "/api/contents", token="0" * 48) == 403
        assert _status(port, "/api/contents", token=token[1]) == 200
        if sys.platform == "linux":
            # port in hexadecimal behind the address: 0100007F is 127.0.0.1, 00000000 would be every address
            sockets = Path("/proc/net/tcp").read_text().splitlines()
            listening = [line.split()[1] for line in sockets if f":{port:04X} 00000000:0000" in line]
            assert listening == [f"0100007F:{port:04X}"]
        if sys.platform == "win32":  # where a process cannot be asked to end
            assert _status(port, "/api/shutdown", "POST", token[1]) == 200
        else:
            lab.terminate()
        lab.wait(timeout=30)
        assert _status(port, "/api/contents") == 0, "the server outlives the command"
        assert list(tmp_path.glob("engdyn-lab-*")) == [], "the file with the token is left behind"
    finally:
        lab.kill()
