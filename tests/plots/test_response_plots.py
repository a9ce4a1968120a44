"""Pictures over frequency show the numbers they are given, with units and words."""

from __future__ import annotations

import numpy as np
import pytest

import engdyn as ed
from analysis.linear_of import linear_of

F = np.linspace(0.5, 6.0, 400)


@pytest.fixture(scope="module")
def responses():
    linear = linear_of(np.diag([2.0, 1.0]), [[5.5, -1.5], [-1.5, 1.5]], [[1100.0, -300.0], [-300.0, 300.0]])
    return [ed.frequency_response(linear, F, "x1", x, unit="m/N") for x in ("x1", "x2")]


def test_amplitude_and_phase(responses):
    ax = ed.plots.frequency_response(responses, labels=["first", "second"])
    upper, lower = ax.figure.axes
    assert upper is ax
    for i, response in enumerate(responses):
        np.testing.assert_array_equal(upper.lines[2 * i].get_ydata(), response.amplitude)
        np.testing.assert_allclose(lower.lines[i].get_ydata(), np.degrees(response.phase))
    peaks = upper.lines[1].get_xdata()
    np.testing.assert_allclose(peaks, [2.121, 4.121], atol=0.02)
    assert len({line.get_linestyle() for line in lower.lines}) == 2, "told apart without color"
    assert (upper.get_yscale(), upper.get_ylabel(), lower.get_ylabel()) == (
        "log",
        "amplitude [m/N]",
        "phase [°]",
    )
    assert lower.get_xlabel() == "frequency [Hz]"
    assert [t.get_text() for t in upper.get_legend().get_texts()] == ["first", "second"]
    words = ed.plots.alt(ax.figure)
    top = responses[0].amplitude.argmax()
    peak = f"{responses[0].amplitude[top]:.4g} m/N at {F[top]:.4g} Hz"
    assert f"first, 0.5 to 6 Hz: peaks {peak}" in words
    assert "second from −1° to −338.2°" in words


def test_wide_ranges_are_logarithmic(responses):
    linear = linear_of([[1.0]], [[1.0]], [[400.0]])
    wide = ed.frequency_response(linear, np.geomspace(0.1, 100.0, 300), "x1", "x1")
    ax = ed.plots.frequency_response(wide)
    assert ax.get_xscale() == "log"
    assert ax.get_ylabel() == "amplitude"
    assert ed.plots.frequency_response(responses[0]).get_xscale() == "linear"


def test_densities_and_lines():
    road = ed.road_spectrum(F, 20.0)
    ax = ed.plots.spectrum([road, ed.road_spectrum(F, 10.0)], labels=["20 m/s", "10 m/s"])
    np.testing.assert_array_equal(ax.lines[0].get_ydata(), road.values)
    assert (ax.get_yscale(), ax.get_ylabel()) == ("log", "density, one-sided [m²/Hz]")
    assert "20 m/s: largest 0.0002048 m^2/Hz at 0.5 Hz" in ed.plots.alt(ax)
    assert ed.plots.spectrum(road.as_two_sided()).get_ylabel() == "density, two-sided [m²/Hz]"
    lines = ed.plots.spectrum(ed.Spectrum([0.0, 1.0, 2.0], [0.5, 3.0, 1.0], "m/s^2"))
    tops = [segment[:, 1].max() for segment in lines.collections[0].get_segments()]
    assert (tops, lines.get_ylabel()) == ([0.5, 3.0, 1.0], "amplitude [m/s²]")


def test_cumulative_mean_square():
    noise = ed.white_noise([0.0, 2.0, 4.0], 3.0, "N^2/Hz")
    ax = ed.plots.cumulative_mean_square(noise)
    np.testing.assert_array_equal(ax.lines[0].get_ydata(), [0.0, 6.0, 12.0])
    assert ax.get_ylabel() == "cumulative mean square [N²]"
    assert "12 N^2 in all, half of it below 2 Hz" in ed.plots.alt(ax)


def test_what_no_picture_shows(responses):
    road = ed.road_spectrum(F, 20.0)
    for attempt, message in (
        (lambda: ed.plots.spectrum([road, road.per_radian()]), "convert them first"),
        (lambda: ed.plots.frequency_response(responses, labels=["one"]), "give 2 names"),
        (lambda: ed.plots.frequency_response(responses, [ed.plots.spectrum(road)]), "two axes"),
        (
            lambda: ed.plots.cumulative_mean_square(ed.Spectrum([0.0], [1.0], "m")),
            "needs a Spectrum of densities",
        ),
    ):
        with pytest.raises(ed.EngdynError, match=message):
            attempt()
