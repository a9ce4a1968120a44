"""The explorer of Routh's table, driven without a browser."""

from __future__ import annotations

import random

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from matplotlib.colors import to_hex

import engdyn as ed
from engdyn.widgets.routh_explorer import FAMILIES, polynomial
from widgets.code_runs import run

EXPLORER = ed.widgets.routh()


def cells():
    """Texts of the table, and the fills of its first column."""
    ax = EXPLORER.figure.axes[0]
    first = [to_hex(p.get_facecolor()) for p in ax.patches if p.get_x() == pytest.approx(0.10)]
    return [text.get_text() for text in ax.texts], first


def test_a_stable_quartic():
    EXPLORER.set(polynomial="quartic", a1=2.0, a2=6.0, a3=4.0, a4=3.0)
    assert "stable; first column 1, 2, 4, 5/2, 3: 0 sign changes." in EXPLORER.text  # by hand
    texts, first = cells()
    assert {"Stable", "s⁴", "5/2"} <= set(texts)
    assert first == ["#cfe3f2"] * 5


def test_sign_changes_recolor_the_first_column():
    EXPLORER.set(polynomial="cubic", a1=1.0, a2=1.0, a3=2.0)
    assert (
        "unstable: 2 roots in the right half plane; first column 1, 1, −1, 2: 2 sign changes."
        in EXPLORER.text
    )
    texts, first = cells()
    assert texts.count("change ⇅") == 2
    assert first == ["#cfe3f2", "#cfe3f2", "#f2b48f", "#cfe3f2"]


def test_special_cases_are_told():
    EXPLORER.set(polynomial="quartic", a1=1.0, a2=2.0, a3=2.0, a4=3.0)
    assert "ε > 0, however small" in EXPLORER.text
    assert "+   ε for 0" in cells()[0]
    EXPLORER.set(polynomial="cubic", a1=1.0, a2=4.0, a3=4.0)
    assert "auxiliary polynomial s² + 4" in EXPLORER.text
    assert "+   derivative" in cells()[0]


def test_long_quotients_are_cut_to_their_sign():
    EXPLORER.set(polynomial="quintic", a1=0.0, a2=-3.217, a3=2.391, a4=7.123, a5=-9.871)
    table, _ = polynomial("quintic", EXPLORER.state)
    assert max(len(str(x)) for x in table.first_column) > 60
    assert ", < 0, ε → 0," in EXPLORER.text or ", > 0, ε → 0," in EXPLORER.text
    assert max(map(len, cells()[0])) < 60


def test_a_slider_beside_zero_means_zero():
    EXPLORER.set(polynomial="cubic", a1=1.3877787807814457e-17, a2=1.0, a3=0.0)
    assert "marginal" in EXPLORER.text


@pytest.mark.parametrize(("g", "stable"), [(9.75, True), (-9.75, False)])
def test_the_bar_hanging_and_on_its_head(g, stable):
    EXPLORER.set(polynomial="bar", g=g, k=400.0, c=4.0)
    table, roots = polynomial("bar", EXPLORER.state)
    assert (table.right_half_plane == 0) is stable
    if stable:  # the quartic of the chapter, with g = 9.81
        monic = [float(c / table.coefficients[0]) for c in table.coefficients]
        assert monic[:2] == pytest.approx([1.0, 2.45045], rel=1e-5)
        assert monic[-1] == pytest.approx(4242.16 * 9.75 / 9.81, rel=1e-5)
    plane = EXPLORER.figure.axes[1]
    shown = np.concatenate([line.get_xdata() for line in plane.lines if line.get_animated()])
    assert np.sort(shown) == pytest.approx(np.sort(roots.real))


def test_out_of_range_is_refused_and_reset_returns():
    EXPLORER.set(polynomial="cubic", a1=1.0)
    with pytest.raises(ed.EngdynError, match="a1 = 9 is out of range"):
        EXPLORER.set(a1=9.0)
    with pytest.raises(ed.EngdynError, match="no control 'a4'"):
        EXPLORER.set(a4=1.0)
    EXPLORER.reset()
    assert EXPLORER.state == {"polynomial": "cubic", "a1": 2.0, "a2": 3.0, "a3": 4.0}


@pytest.mark.parametrize("name", list(FAMILIES))
def test_the_code_gives_the_same_table(name, monkeypatch):
    EXPLORER.set(polynomial=name)
    names, _ = run(EXPLORER, monkeypatch)
    table, roots = polynomial(name, EXPLORER.state)
    assert names["table"].rows == table.rows
    assert np.allclose(names["roots"], roots)


@settings(max_examples=25)
@given(st.sampled_from(list(FAMILIES)), st.randoms(use_true_random=False))
def test_no_position_of_the_sliders_raises_or_blanks(name, rng: random.Random):
    sliders = FAMILIES[name].sliders
    EXPLORER.set(
        polynomial=name,
        **{c.name: rng.choice([c.low, c.high, 0.0, round(rng.uniform(c.low, c.high), 2)]) for c in sliders},
    )
    assert "Nothing to draw" not in EXPLORER.text
    assert max(map(len, cells()[0])) < 60
    table, roots = polynomial(name, EXPLORER.state)
    clear = np.min(np.abs(roots.real)) > 1e-4 * np.max(np.abs(roots))
    assert not clear or table.right_half_plane == np.sum(roots.real > 0)
