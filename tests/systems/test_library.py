"""Finding a system by number, label or key; the catalogue as a table."""

from __future__ import annotations

import re

import numpy as np
import pytest

import engdyn as ed


@pytest.mark.parametrize(
    "key",
    [
        "gantry_crane",
        "Gantry_Crane",
        "gantry crane",
        "gantry-crane",
        " S07 ",
        "s7",
        "S7",
        "7",
        7,
        np.int64(7),
    ],
)
def test_one_system_has_many_names(key):
    system = ed.systems.load(key)
    assert (system.number, system.key) == (7, "gantry_crane")


@pytest.mark.parametrize(
    ("key", "nearest"),
    [
        ("gantry_crain", "S07 'gantry_crane'"),
        ("governor", "S03 'flyball_governor'"),
        ("halfcar", "S23 'half_car'"),
        ("S99", "S23 'half_car'"),
        (99, "S23 'half_car'"),
        (-5, "S01 'slider_crank_press'"),
    ],
)
def test_an_unknown_name_is_answered_with_the_nearest(key, nearest):
    with pytest.raises(ed.UnknownSystemError, match=re.escape(nearest)) as caught:
        ed.systems.load(key)
    assert repr(key) in str(caught.value)
    assert "catalogue()" in str(caught.value)


@pytest.mark.parametrize(
    "key", ["", None, True, 3.5, [1], "²", "S²", "S", "x" * 10**6, 10**30, ("S07",), "../../etc", "S07.py"]
)
def test_nonsense_is_an_unknown_system(key):
    with pytest.raises(ed.UnknownSystemError) as caught:
        ed.systems.load(key)
    assert len(str(caught.value)) < 250


def test_the_table_lists_every_system_of_the_catalogue_once():
    table = ed.systems.catalogue()
    assert list(table.columns) == ["key", "title", "field", "degrees of freedom"]
    assert table.index.is_unique
    assert {"S03", "S07", "S23"} <= set(table.index)
    assert all(re.fullmatch(r"S\d\d", label) for label in table.index)
    for label, row in table.iterrows():
        system = ed.systems.load(label)
        assert system.key == row["key"]
        assert system.title == row["title"]
        assert row["degrees of freedom"] == len(system.equations.speeds)


def test_every_system_says_what_it_is_made_of():
    for label in ed.systems.catalogue().index:
        system = ed.systems.load(label)
        names = {p.name for p in system.equations.parameters} | {p.name for p in system.newton().parameters}
        assert names <= {p.name for p in system.parameters}
        inputs = {w.func.__name__ for w in system.equations.inputs}
        assert inputs == {i.name for i in system.inputs}
        assert all(p.meaning and p.unit for p in system.parameters)
        assert all(c.meaning and c.unit in ("m", "rad") for c in system.coordinates)
        assert len(system.description) > 200
        assert system.measured
        assert system.values() == {p.name: p.default for p in system.parameters}
