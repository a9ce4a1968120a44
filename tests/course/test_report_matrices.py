"""What a report says about small motion, against numbers by hand, and again from another process."""

from __future__ import annotations

import math
import os
import re
import subprocess
import sys
from html.parser import HTMLParser
from pathlib import Path

import numpy as np
import pytest
import sympy as sm
from sympy.physics.mechanics import dynamicsymbols

import engdyn as ed
from engdyn.course.report import write_report
from engdyn.course.report_matrices import matrix, small_motion


class Page(HTMLParser):
    """The words of a page and its tags."""

    def __init__(self, path: Path):
        super().__init__()
        self.words, self.tags = "", []
        self._style = False
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attrs):
        self.tags.append((tag, dict(attrs)))
        self._style = tag == "style"

    def handle_endtag(self, tag):
        self._style = False
        self.words += " " if tag in ("td", "th", "p", "li", "mtd", "dd", "dt", "h2", "h3", "div") else ""

    def handle_data(self, data):
        self.words += "" if self._style else data

    def says(self, value: float) -> bool:
        shown = [
            float(x.replace("−", "-")) for x in re.findall(r"−?\d+(?:\.\d+)?(?:e[+−-]?\d+)?", self.words)
        ]
        return any(math.isclose(value, x, rel_tol=6e-4, abs_tol=1e-9) for x in shown)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("reports")


@pytest.fixture(scope="module")
def crane(folder):
    return Page(write_report("S07", folder / "S07.html"))


def test_small_motion_of_the_crane_is_that_of_the_double_mass(crane):
    for value in (1200 + 2500, 2500 * 9, 3000 + 2500 * 81, 400, 4000, 2500 * 9.81 * 9):
        assert crane.says(value), value
    s = sm.Symbol("s")
    rows = [[3700 * s**2 + 400 * s, 22500 * s**2], [22500 * s**2, 205500 * s**2 + 4000 * s + 220725]]
    roots = [complex(root) for root in sm.Poly(sm.Matrix(rows).det(), s).nroots()]
    swing = next(root for root in roots if root.imag > 0.1)
    assert crane.says(swing.real)
    assert crane.says(swing.imag)


def test_the_governor_hangs_where_the_closed_form_says(folder):
    page = Page(write_report("S03", folder / "S03.html"))
    m, M_c, l, k, speed, g = 1.2, 3.0, 0.25, 200.0, 18.0, 9.81
    theta = math.acos(((M_c + m) * g + 2 * k * l) / (m * l * speed**2 + 2 * k * l))
    assert page.says(theta)
    assert page.says(-theta)
    assert page.says(2 * m * l**2 + 4 * M_c * l**2 * math.sin(theta) ** 2)  # its inertia there


def test_the_half_car_sits_where_its_weights_press_it(folder):
    page = Page(write_report("S23", folder / "S23.html"))
    front, rear = 1.5 / 2.6 * 730 * 9.81, 1.1 / 2.6 * 730 * 9.81  # of the body, by its lever arms
    wheel_front, wheel_rear = -(front + 40 * 9.81) / 175000, -(rear + 36 * 9.81) / 175000
    drop_front, drop_rear = wheel_front - front / 20000, wheel_rear - rear / 17500
    pitch = math.asin((drop_front - drop_rear) / 2.6)
    for value in (wheel_front, wheel_rear, pitch, drop_front - 1.1 * math.sin(pitch), 20000 + 17500):
        assert page.says(value), value


def test_the_first_stable_equilibrium_is_shown_else_the_first():
    system = ed.systems.load("S03")
    linear = [ed.linearize(system.equations, state) for state in system.equilibria()]
    judged = [ed.stability(item) for item in linear]
    assert [verdict.stable for verdict in judged] == [True, False, True]
    assert "equilibrium 1 (the first that is asymptotically stable)" in small_motion(linear, judged)
    assert "equilibrium 2 (the first" in small_motion(linear[1:] * 2, judged[1:] * 2)
    assert "equilibrium 1 (none is stable)" in small_motion(linear[1:2], judged[1:2])
    assert small_motion([], []) == ""


def test_a_matrix_keeps_its_order_and_drops_what_is_rounding():
    text = matrix("K", np.array([[1.5, -2.0], [1e-17, 225000.0]]))
    assert re.findall(r"<mtd><mn>(.*?)</mn></mtd>", text)[:3] == ["1.5", "−2", "0"]
    assert text.count("<mtr>") == 2
    assert 'alttext="K = [1.5, −2; 0, ' in text


def test_the_command_in_another_process_writes_the_same_bytes(crane, folder, tmp_path):
    target = tmp_path / "crane.html"
    command = [sys.executable, "-m", "engdyn.cli", "analyze", "S07", "--out", str(target)]
    done = subprocess.run(command, capture_output=True, text=True, env={**os.environ, "PYTHONHASHSEED": "7"})
    assert (done.returncode, done.stderr) == (0, "")
    assert target.read_bytes() == (folder / "S07.html").read_bytes()
    again = subprocess.run(command, capture_output=True, text=True)
    assert again.returncode == 2
    assert "was not touched" in again.stderr


def test_text_of_a_system_is_shown_and_never_interpreted(tmp_path):
    theta, length = dynamicsymbols("theta"), ed.Parameter("l", "m", 0.7, 'length, "l" <i>here</i>')
    couple = ed.Input(dynamicsymbols("Q"), "N m", "couple <u>")
    system = ed.System(
        title="<script>alert(1)</script> & more",
        description="A <b>bold</b> claim.",
        measured="<img src=x>",
        coordinates=[ed.Coordinate(theta, "rad", "angle > 0 & < 1", (-3.0, 3.0))],
        parameters=[length],
        inputs=[couple],
        kinetic_energy=length.symbol**2 * theta.diff() ** 2 / 2,
        potential_energy=-length.symbol * sm.cos(theta),
        generalized_forces={theta: couple.symbol},
    )
    page = Page(write_report(system, tmp_path / "own.html"))
    assert {"script", "b", "i", "u"}.isdisjoint(tag for tag, _ in page.tags)
    assert "x" not in [attributes["src"] for tag, attributes in page.tags if tag == "img"]
    for text in (
        system.title,
        system.description,
        length.meaning,
        "angle > 0 & < 1",
        "couple <u>",
        "<img src=x>",
    ):
        assert text in page.words
