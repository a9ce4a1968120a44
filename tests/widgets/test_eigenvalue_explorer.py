"""The explorer of eigenvalues, driven without a browser."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import solve_ivp

import engdyn as ed
from engdyn.widgets.eigenvalue_explorer import respond
from widgets.code_runs import run

EXPLORER = ed.widgets.eigenvalue_plane()


@pytest.mark.parametrize(("real", "imaginary"), [(-0.3, 4.0), (0.2, 2.0), (0.0, 1.0)])
def test_the_response_solves_the_equation_of_the_pair(real, imaginary):
    found = respond(real, imaginary)
    c, k = -2 * real, real**2 + imaginary**2  # λ² + cλ + k with the roots real ± i imaginary
    solved = solve_ivp(
        lambda _, x: [x[1], -k * x[0] - c * x[1]],
        (0, 10),
        [1.0, real],
        t_eval=found.time,
        rtol=1e-10,
        atol=1e-12,
    )
    assert np.allclose(found.deviation, solved.y[0], atol=1e-7)
    assert np.allclose(np.sort_complex(found.eigenvalues), np.sort_complex(np.roots([1, c, k])))


@pytest.mark.parametrize(
    ("real", "imaginary", "told"),
    [
        (
            -0.5,
            4.0,
            "asymptotically stable; one swing takes 1.571 s, damping ratio 0.124; the amplitude halves in 1.386 s",
        ),
        (0.5, 4.0, "unstable, flutter"),
        (0.5, 0.0, "λ = 0.5 1/s: unstable, divergence; the deviation doubles in 1.386 s."),
        (0.0, 4.0, "marginal; one swing takes 1.571 s, damping ratio 0."),
        (0.0, 0.0, "λ = 0 1/s: marginal; a deviation stays."),
    ],
)
def test_words_tell_verdict_period_and_decay(real, imaginary, told):
    EXPLORER.set(real=real, imaginary=imaginary)
    assert told in EXPLORER.text
    assert EXPLORER._repr_mimebundle_()[1]["image/png"]["alt"] == EXPLORER.text


def test_the_picture_shows_the_pair_and_its_response():
    EXPLORER.set(real=-0.2, imaginary=3.0)
    plane, right = EXPLORER.figure.axes
    (pair,) = (line for line in plane.lines if line.get_animated())
    assert sorted(zip(*pair.get_data(), strict=True)) == [(-0.2, -3.0), (-0.2, 3.0)]
    *envelope, curve = (line for line in right.lines if line.get_animated())
    assert np.interp(1.7, *curve.get_data()) == pytest.approx(math.exp(-0.34) * math.cos(5.1), abs=1e-4)
    assert all(np.all(np.abs(e.get_ydata()) >= np.abs(curve.get_ydata()) - 1e-12) for e in envelope)


def test_out_of_range_is_refused_and_reset_returns():
    EXPLORER.set(real=0.5)
    with pytest.raises(ed.EngdynError, match="real = 3 is out of range; give a number from -2 to 2 1/s"):
        EXPLORER.set(real=3)
    assert EXPLORER.state["real"] == 0.5
    EXPLORER.reset()
    assert EXPLORER.state == {"real": -0.3, "imaginary": 4.0}


def test_the_code_gives_the_same_curve(monkeypatch):
    EXPLORER.set(real=-0.15, imaginary=2.5)
    names, shown = run(EXPLORER, monkeypatch)
    assert np.array_equal(names["response"], respond(-0.15, 2.5).deviation)
    assert shown == ["Response to (-0.15+2.5j)."]


@settings(max_examples=25)
@given(st.floats(-2.0, 2.0), st.floats(0.0, 12.0))
def test_no_position_of_the_sliders_raises_or_blanks(real, imaginary):
    EXPLORER.set(real=real, imaginary=imaginary)
    assert "1/s: " in EXPLORER.text
    assert np.ptp(np.frombuffer(EXPLORER.figure.canvas.buffer_rgba(), np.uint8)) > 100
