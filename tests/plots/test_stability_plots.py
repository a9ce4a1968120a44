"""Pictures of chapter 5 show what was computed, with units on the axes and numbers in the words."""

from __future__ import annotations

import re

import numpy as np
import pytest
import sympy as sm
from matplotlib.collections import PathCollection, QuadMesh

import engdyn as ed
from engdyn.plots.alternative import png
from engdyn.plots.linear_pictures import GALLERY
from engdyn.plots.stability_plots import AREAS

S11, S12 = ed.systems.load(11), ed.systems.load(12)
SPEEDS = ("U", np.linspace(1, 80, 80))


@pytest.fixture(scope="module")
def airfoil():
    return ed.stability_map(S12.equations, S12.values(), SPEEDS, ("d", np.linspace(-0.05, 0.1, 31)))


@pytest.fixture(scope="module")
def mast():
    """Undamped in the lowest row, marginal up to 83.43 N."""
    plane = ("P", np.linspace(0, 120, 61)), ("c_1", np.linspace(0, 1, 3))
    return ed.stability_map(S11.equations, S11.values(c_2=0.0), *plane)


def brightness(color):
    r, g, b = (int(color[i : i + 2], 16) / 255 for i in (1, 3, 5))
    return 0.299 * r + 0.587 * g + 0.114 * b


def test_areas_are_the_verdicts_in_colors_of_their_own(airfoil):
    ax = ed.plots.stability_map(airfoil, system=S12)
    (mesh,) = [c for c in ax.collections if isinstance(c, QuadMesh)]
    names = [text.get_text() for text in ax.get_legend().get_texts()]
    assert names == ["asymptotically stable", "unstable, divergence", "unstable, flutter"]
    present = [v for v in AREAS if v in airfoil.shares]
    expected = np.vectorize(present.index)(airfoil.verdict)
    assert np.array_equal(np.asarray(mesh.get_array()).reshape(expected.shape), expected)
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("$U$ [m/s]", "$d$ [m]")


def test_areas_differ_without_color():
    looks = [(round(brightness(color), 2), hatch) for color, hatch in AREAS.values()]
    assert len({hatch for _, hatch in looks}) == len(AREAS)
    assert len({shade for shade, _ in looks}) == len(AREAS)


def test_a_map_in_words_has_its_boundaries(airfoil, mast):
    words = ed.plots.alt(ed.plots.stability_map(airfoil, system=S12))
    assert "U from 1 m/s to 80 m/s and d from −0.05 m to 0.1 m" in words
    first = float(re.search(r"At the lowest d: asymptotically stable, from U = ([\d.]+) m/s", words)[1])
    assert abs(first - 57.1429) < 1.0
    words = ed.plots.alt(ed.plots.stability_map(mast))
    assert "At the lowest c_1: marginal, from P = 83 unstable, flutter" in words


def test_a_map_without_a_system_has_no_units(mast):
    ax = ed.plots.stability_map(mast)
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("$P$", "$c_{1}$")


def test_where_there_is_no_equilibrium_the_map_is_crossed_out():
    system = ed.systems.load(2)
    plane = ("g", np.linspace(0, 60, 21)), ("k", np.linspace(500, 6000, 12))
    found = ed.stability_map(system.equations, system.values(), *plane, at=system.equilibria()[-1])
    ax = ed.plots.stability_map(found, system=system)
    names = {p.get_label(): p.get_hatch() for p in ax.get_legend().get_patches()}
    assert names["no equilibrium"] == "xx"
    assert len(png(ax)) > 5000


def test_root_locus_shows_all_eigenvalues_and_both_ends(airfoil):
    row = int(np.argmin(abs(airfoil.y[1] - 0.04)))
    ax = ed.plots.root_locus(airfoil, row=row, system=S12)
    (dots,) = [c for c in ax.collections if isinstance(c, PathCollection)]
    shown = dots.get_offsets() @ [1, 1j]
    np.testing.assert_allclose(np.sort_complex(shown), np.sort_complex(airfoil.eigenvalues[row].ravel()))
    assert [t.get_text() for t in ax.get_legend().get_texts()] == ["first: 1 m/s", "last: 80 m/s"]
    assert (ax.get_xlabel(), ax.get_ylabel()) == (r"Re $\lambda$ [1/s]", r"Im $\lambda$ [1/s]")
    bar = ax.get_figure().axes[-1]
    assert bar.get_ylabel() == "$U$ [m/s]"
    words = ed.plots.alt(ax)
    entered = float(re.search(r"enters the right half plane near U = ([\d.]+) m/s", words)[1])
    assert abs(entered - 20.33) < 1.0


def test_root_locus_refuses_rows_that_are_not_there(mast):
    with pytest.raises(ed.EngdynError, match="no row 5"):
        ed.plots.root_locus(mast, row=5)
    one = ed.stability_map(S11.equations, S11.values(), ("P", [1.0, 2.0]), ("c_1", [0.1]))
    with pytest.raises(ed.EngdynError, match="at least two values"):
        ed.plots.stability_map(one)


def test_gallery_has_the_response_of_each_kind():
    ax = ed.plots.response_gallery()
    insets = ax.child_axes
    assert len(insets) == len(GALLERY) == 6
    for (real, imaginary), inset in zip(GALLERY, insets, strict=True):
        t, curve = inset.lines[0].get_data()
        half = len(t) // 2
        growth = np.max(abs(curve[half:])) / np.max(abs(curve[:half]))
        assert np.sign(round(np.log(growth), 1)) == real
        assert (np.sum(np.diff(np.sign(curve)) != 0) > 4) == bool(imaginary)
    assert "oscillates and grows: flutter" in ed.plots.alt(ax)


def test_tangent_touches_and_says_what_is_dropped():
    x = sm.Symbol("theta")
    ax = ed.plots.tangent(sm.sin(x), 0.6)
    curve, line, point = ax.lines
    slope = np.diff(line.get_ydata())[0] / np.diff(line.get_xdata())[0]
    np.testing.assert_allclose(slope, np.cos(0.6), rtol=1e-9)
    np.testing.assert_allclose(curve.get_ydata(), np.sin(curve.get_xdata()))
    assert (point.get_xdata()[0], point.get_ydata()[0]) == (0.6, pytest.approx(np.sin(0.6)))
    off = float(ed.plots.alt(ax).split("off by ")[1].rstrip("."))
    assert off == pytest.approx(np.sin(0.6) + 0.8 * np.cos(0.6) - np.sin(1.4), rel=1e-3)
    assert ax.get_legend().get_texts()[1].get_text() == r"$0.5646 + 0.8253\,(\theta - 0.6)$"


@pytest.mark.parametrize(
    ("function", "at", "message"),
    [
        (sm.Symbol("x") * sm.Symbol("y"), 0.0, "one symbol"),
        ("sin(x)", 0.0, "one symbol"),
        (sm.sqrt(sm.Symbol("x")), 0.0, "no finite value and slope"),
        (sm.log(sm.Symbol("x")), -1.0, "no finite value and slope"),
    ],
)
def test_tangent_refuses_what_has_none(function, at, message):
    with pytest.raises(ed.EngdynError, match=message):
        ed.plots.tangent(function, at)
