"""Every figure and table of the plan has its cell, with a caption and words for those who cannot see it."""

from __future__ import annotations

import re
from pathlib import Path

import nbformat
import pytest

import engdyn as ed

LESSONS = Path(__file__).resolve().parents[2] / "notebooks"

PLAN = {
    "01_kinematics": ([f"1.{k}" for k in range(1, 8)], []),
    "02_newton": ([f"2.{k}" for k in range(1, 16)], []),
    "03_lagrange": ([f"3.{k}" for k in range(1, 8)], []),
    "04_equilibrium": ([f"4.{k}" for k in range(1, 5)], []),
    "05_stability": (["5.1", "5.2"], [f"5.{k}" for k in range(1, 6)]),
    "06_mode_shapes": ([f"6.{k}" for k in range(1, 9)], ["6.1"]),
    "07_frequency_domain": ([f"7.{k}" for k in range(1, 13)], ["7.1"]),
    "08_time_domain": ([f"8.{k}" for k in range(1, 7)], [f"8.{k}" for k in range(1, 4)]),
    "09_experimental_data": ([f"9.{k}" for k in range(1, 15)], [f"9.{k}" for k in range(1, 5)]),
    "A_representative_systems": ([f"A.{k}" for k in range(1, 24)], []),
    "B_inertia": (["B.1"], []),
    "C_units": ([], []),
    "D_least_squares": (["D.1"], ["D.1"]),
}
"""Notebook → numbers of its figures, numbers of its tables."""

SECTIONS = {
    "01_kinematics": 7,
    "02_newton": 14,
    "03_lagrange": 8,
    "04_equilibrium": 4,
    "05_stability": 5,
    "06_mode_shapes": 5,
    "07_frequency_domain": 3,
    "08_time_domain": 9,
    "09_experimental_data": 10,
    "A_representative_systems": 23,
    "B_inertia": 4,
    "C_units": 5,
    "D_least_squares": 7,
}

MANY_CLAIMS = 10


@pytest.fixture
def cells(lesson):
    return nbformat.read(LESSONS / f"{lesson}.ipynb", as_version=4).cells


def tagged(cells, tag):
    return [(i, c) for i, c in enumerate(cells) if tag in c.metadata.get("tags", ())]


@pytest.mark.parametrize(("lesson", "number"), [(k, n) for k, (figures, _) in PLAN.items() for n in figures])
def test_a_figure_is_a_picture_with_words_and_a_caption(lesson, number, cells):
    ((place, cell),) = tagged(cells, f"figure-{number}")
    pictures = [o for o in cell.outputs if "image/png" in o.get("data", {})]
    assert pictures
    for picture in pictures:
        assert len(picture["data"]["text/plain"]) > 20
        assert "Figure(" not in picture["data"]["text/plain"]
    below = "\n".join(c.source for c in cells[place + 1 : place + 4] if c.cell_type == "markdown")
    assert re.search(rf"^\*Figure {re.escape(number)}\b", below, re.MULTILINE)


@pytest.mark.parametrize(("lesson", "number"), [(k, n) for k, (_, tables) in PLAN.items() for n in tables])
def test_a_table_is_a_table_with_a_caption(lesson, number, cells):
    ((place, cell),) = tagged(cells, f"table-{number}")
    assert any("<table" in o.get("data", {}).get("text/html", "") for o in cell.outputs)
    below = "\n".join(c.source for c in cells[place + 1 : place + 4] if c.cell_type == "markdown")
    assert re.search(rf"^\*Table {re.escape(number)}\b", below, re.MULTILINE)


@pytest.mark.parametrize("lesson", PLAN)
def test_sections_are_complete_and_claims_are_asserted(lesson, cells):
    text = "\n".join(c.source for c in cells if c.cell_type == "markdown")
    chapter = lesson.split("_")[0].lstrip("0")
    numbers = [int(k) for k in re.findall(rf"^## {chapter}\.(\d+) \S", text, re.MULTILINE)]
    assert numbers == list(range(1, SECTIONS[lesson] + 1))
    claims = [c for c in cells if any(t.startswith("claim-") for t in c.metadata.get("tags", ()))]
    assert len(claims) >= MANY_CLAIMS
    assert [c.id for c in claims if "assert" not in c.source] == []
    tags = [t for c in cells for t in c.metadata.get("tags", ()) if t.startswith("claim-")]
    assert len(set(tags)) == len(tags)


@pytest.mark.parametrize("number", range(1, 24))
def test_every_system_has_a_page_with_its_facts_a_prediction_and_a_claim(number):
    system = ed.systems.load(number)
    cells = nbformat.read(LESSONS / "A_representative_systems.ipynb", as_version=4).cells
    heads = [i for i, c in enumerate(cells) if c.cell_type == "markdown" and c.source.startswith("## ")]
    (start,) = (i for i in heads if cells[i].source.startswith(f"## A.{number} "))
    page = cells[start : next(i for i in heads if i > start)]
    ((_, table),) = tagged(page, f"table-A.{number}")
    facts = table.outputs[0]["data"]["text/html"]
    rows = re.findall(r"<tr><td><code>(\w+)</code></td><td>[^<]*</td><td>([^<]+)</td>", facts)
    assert [(name, float(value)) for name, value in rows] == [(p.name, p.default) for p in system.parameters]
    assert f"Degrees of freedom: {len(system.coordinates) - len(system.constraints)}" in facts
    words = "\n".join(c.source for c in page if c.cell_type == "markdown")
    assert "**Predict first.**" in words
    chapters = re.findall(r"^- \*\*(?:Chapter|Appendix) (\w)\.\*\* \S", words, re.MULTILINE)
    assert len(chapters) >= 3
    assert chapters == sorted(set(chapters))
    assert len(tagged(page, f"claim-A.{number}")) == 1
