"""The report of `engdyn analyze`: complete, self-contained, the same every time, and never half-written."""

from __future__ import annotations

import base64
import re
import struct
from html.parser import HTMLParser
from xml.etree import ElementTree

import numpy as np
import pytest
import sympy as sm
from sympy.physics.mechanics import dynamicsymbols

import engdyn as ed
from engdyn.course.report import report, write_report
from engdyn.course.report_pictures import branch_question
from engdyn.course.report_tables import number
from engdyn.errors import EngdynError, UnknownSystemError

KEYS = ("S03", "S07", "S23")
VOID = {"img", "meta", "br"}


class Page(HTMLParser):
    """Checks the nesting of elements and collects text, pictures, links and identifiers."""

    def __init__(self, text):
        super().__init__(convert_charrefs=True)
        self.open, self.images, self.links, self.ids, self.words, self.tags = [], [], [], [], [], set()
        self.feed(text)
        self.close()
        assert self.open == []

    def handle_starttag(self, tag, attrs):
        attributes = dict(attrs)
        self.tags.add(tag)
        self.ids += [attributes["id"]] if "id" in attributes else []
        self.links += [attributes[name] for name in ("href", "src", "srcset", "data") if name in attributes]
        if tag == "img":
            self.images.append(attributes)
        if tag not in VOID:
            self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        if not {"style", "math"} & set(self.open):
            self.words.append(data)

    @property
    def text(self):
        return " ".join(" ".join(self.words).split())


@pytest.fixture(scope="module")
def texts():
    return {key: report(ed.systems.load(key)) for key in KEYS}


@pytest.fixture(scope="module")
def pages(texts):
    return {key: Page(text) for key, text in texts.items()}


@pytest.mark.parametrize("key", KEYS)
def test_asks_for_nothing_outside_the_file(pages, texts, key):
    for link in pages[key].links:
        assert link.startswith(("#", "data:image/png;base64,"))
    assert {"script", "link", "iframe", "object"}.isdisjoint(pages[key].tags)
    assert "url(" not in texts[key]
    assert "@import" not in texts[key]
    assert not re.search(r"https?://", texts[key])


@pytest.mark.parametrize("key", KEYS)
def test_pictures_are_pictures_and_have_words(pages, key):
    assert len(pages[key].images) >= 3
    for image in pages[key].images:
        data = base64.b64decode(image["src"].removeprefix("data:image/png;base64,"), validate=True)
        assert data.startswith(b"\x89PNG")
        width, height = struct.unpack(">II", data[16:24])
        assert width >= 250
        assert height >= 200
        assert len(image["alt"]) > 30
    words = " ".join(image["alt"] for image in pages[key].images)
    assert "Drawing of" in words
    assert "equilibri" in words


@pytest.mark.parametrize("key", KEYS)
def test_contents_lead_to_their_sections(pages, key):
    page = pages[key]
    targets = [link[1:] for link in page.links if link.startswith("#")]
    assert targets == page.ids
    assert len(targets) >= 8
    assert len(set(page.ids)) == len(page.ids)


@pytest.mark.parametrize("key", KEYS)
def test_formulas_are_well_formed_and_have_a_latex_form(texts, key):
    found = re.findall(r"<math.*?</math>", texts[key], flags=re.DOTALL)
    assert len(found) > 30
    for text in found:
        root = ElementTree.fromstring(text)
        assert root.get("alttext")
        assert {element.tag for element in root.iter()} <= {
            *("math", "mrow", "mi", "mn", "mo", "msup", "msub", "mover", "mfrac", "msqrt", "mspace"),
            *("mtable", "mtr", "mtd"),
        }
        assert not any("(t)" in "".join(element.itertext()) for element in root.iter())


@pytest.mark.parametrize("key", KEYS)
def test_names_everything_the_system_has(pages, texts, key):
    system = ed.systems.load(key)
    text = pages[key].text
    assert system.title in text
    assert " ".join(system.description.split()) in text
    for item in (*system.coordinates, *system.parameters, *system.inputs):
        assert f"<code>{item.name}</code>" in texts[key]
        assert item.meaning in text
    for body in system.free_bodies():
        assert body.name.capitalize() in text
    loads = sum(len(body.applied) + len(body.reactions) for body in system.free_bodies())
    assert text.count(" known") + text.count(" reaction ") >= loads
    assert "Proved: both derivations give the same equations of motion." in text


@pytest.mark.parametrize("key", KEYS)
def test_reports_all_equilibria_with_their_stability(pages, key):
    system = ed.systems.load(key)
    found, text = system.equilibria(), pages[key].text
    assert "certified: there are no others in the region" in text
    for i, e in enumerate(found, 1):
        judged = ed.stability(ed.linearize(system.equations, e))
        assert f"Equilibrium {i}: {judged.verdict}" in text
        for value in judged.eigenvalues:
            if value.imag >= 0 and abs(value) > 1e-9:
                assert number(float(value.real)) in text
        assert all(number(float(x)) in text for x in e.q)


def test_reactions_have_their_values_in_the_equilibria(pages):
    """S07: N = (M_t + m) g. S03 at θ = 0, where the formula reads 0/0: T_2 carries half the collar."""
    text = pages["S07"].text
    assert text.count(number(3700 * 9.81)) == 2
    shown = np.array([float(word) for word in re.findall(r"(?<![\d.−])\d+\.\d+", pages["S03"].text)])
    collar, ball = 3.0 * 9.81 / 2, 1.2 * 9.81
    assert np.min(np.abs(shown - collar)) < 0.006
    assert np.min(np.abs(shown - (collar + ball))) < 0.006


def test_shows_what_a_parameter_changes(pages):
    text = pages["S03"].text
    assert "Omega is the first parameter that changes number or stability of the equilibria" in text
    assert any("Pitchfork at Omega = 11.72 rad/s" in image["alt"] for image in pages["S03"].images)
    for key in ("S07", "S23"):
        assert (
            "No parameter, between half and twice its default, changes number or stability" in pages[key].text
        )


def test_the_branch_parameter_is_one_that_matters():
    parameter, changes = branch_question(ed.systems.load("S03"))
    assert (parameter.name, changes) == ("Omega", True)
    parameter, changes = branch_question(ed.systems.load("S23"))
    assert not changes
    car = ed.systems.load("S23")
    places = [car.equilibria({parameter.name: f * parameter.default})[0].q for f in (0.5, 2.0)]
    assert np.max(np.abs(places[1] - places[0])) > 0.1


@pytest.mark.parametrize("key", KEYS)
def test_the_same_report_every_time(texts, key):
    again = report(ed.systems.load(key))
    assert again == texts[key]
    assert not re.search(r"\b\d{4}-\d{2}-\d{2}\b|\b\d{2}:\d{2}:\d{2}\b", again)
    assert " at 0x" not in again


def test_writes_a_file_and_tells_how_far_it_is(tmp_path):
    told = []
    path = write_report("gantry_crane", tmp_path / "crane.html", progress=told.append)
    assert path == tmp_path / "crane.html"
    assert path.read_text("utf-8") == report(ed.systems.load(7))
    assert len(told) >= 4
    assert all(isinstance(message, str) and message for message in told)
    assert [p.name for p in tmp_path.iterdir()] == ["crane.html"]


@pytest.mark.parametrize("key", [7, "7", "S07", "gantry_crane"])
def test_every_name_of_a_system_will_do(tmp_path, key):
    path = write_report(key, str(tmp_path / "out.html"))
    assert "Gantry crane" in path.read_text("utf-8")


def test_does_not_touch_a_file_unless_forced(tmp_path):
    path = tmp_path / "mine.html"
    path.write_text("mine")
    with pytest.raises(EngdynError, match="was not touched"):
        write_report("S07", path)
    assert path.read_text() == "mine"
    write_report("S07", path, force=True)
    assert path.read_text("utf-8").startswith("<!DOCTYPE html>")


def test_leaves_nothing_half_written(tmp_path):
    path = tmp_path / "mine.html"
    path.write_text("mine")

    def stop(message):
        raise KeyboardInterrupt(message)

    with pytest.raises(KeyboardInterrupt):
        write_report("S07", path, force=True, progress=stop)
    assert path.read_text() == "mine"
    with pytest.raises(KeyboardInterrupt):
        write_report("S07", tmp_path / "new.html", progress=stop)
    assert [p.name for p in tmp_path.iterdir()] == ["mine.html"]


def test_an_interrupted_write_leaves_the_old_file(tmp_path, monkeypatch):
    import os

    path = tmp_path / "mine.html"
    path.write_text("mine")

    def full(*arguments):
        raise OSError("no space left on device")

    monkeypatch.setattr(os, "replace", full)
    with pytest.raises(OSError, match="no space"):
        write_report("S07", path, force=True)
    assert path.read_text() == "mine"
    assert [p.name for p in tmp_path.iterdir()] == ["mine.html"]


@pytest.mark.parametrize("key", ["gantry_crain", "S99", 99, ""])
def test_an_unknown_system_is_named_with_its_nearest(tmp_path, key):
    with pytest.raises(UnknownSystemError, match="nearest"):
        write_report(key, tmp_path / "out.html")
    assert list(tmp_path.iterdir()) == []


def test_a_place_that_cannot_hold_the_file_is_refused(tmp_path):
    with pytest.raises(EngdynError, match="is a folder"):
        write_report("S07", tmp_path)
    with pytest.raises(EngdynError, match="does not exist"):
        write_report("S07", tmp_path / "no" / "such" / "folder.html")


# ---------------------------------------------------------------- a system of one's own


def own_system(**more):
    x, m, k, F = dynamicsymbols("x"), *sm.symbols("m k", positive=True), dynamicsymbols("F")
    return ed.System(
        title="A mass on a spring <of our own>",
        coordinates=[ed.Coordinate(x, "m", "position & more", (-1.0, 1.0), "length")],
        parameters=[ed.Parameter(m, "kg", 2.0, "mass"), ed.Parameter(k, "N/m", 8.0, "stiffness")],
        inputs=[ed.Input(F, "N", "force")],
        kinetic_energy=m * x.diff() ** 2 / 2,
        potential_energy=k * x**2 / 2,
        generalized_forces={x: F},
        **more,
    )


def test_a_system_without_free_bodies_and_drawing_gets_a_report_all_the_same(tmp_path):
    path = write_report(own_system(), tmp_path / "own.html")
    page = Page(path.read_text("utf-8"))
    assert "A mass on a spring <of our own>" in page.text
    assert "position & more" in page.text
    assert "Free bodies" not in page.text
    assert "Proved" not in page.text
    assert "1 equilibrium" in page.text
    assert "marginal" in page.text
    assert number(2 / (2 * np.pi)) in page.text  # its frequency in Hz
