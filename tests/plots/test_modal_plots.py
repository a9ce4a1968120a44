"""Pictures of modes show the numbers of the modes."""

from __future__ import annotations

import numpy as np
import pytest
import sympy as sm

import engdyn as ed

W8, S07, S12, S15 = (ed.systems.load(key) for key in ("W8", "S07", "S12", "S15"))


def linear(system, **changes):
    return ed.linearize(system.equations, system.equilibria(system.values(**changes))[0])


@pytest.fixture(scope="module")
def rod():
    found = linear(W8)
    return ed.modes(found), ed.damped_modes(found)


@pytest.fixture(scope="module")
def rotor():
    values = {**S15.values(), "c_a": 0.0, "c_b": 0.0}
    return ed.track_modes(S15.equations, values, ("Omega", np.linspace(0, 60, 121)))


# ---------------------------------------------------------------- shapes


def rods_in(ax):
    """Left and right end of every rod of 2 m in a picture."""
    boxes = [
        path.vertices[:4] for c in ax.collections for path in c.get_paths() if len(path.vertices) in (4, 5)
    ]
    boxes = [box[np.argsort(box[:, 0])] for box in boxes]
    ends = [(box[:2].mean(axis=0), box[2:].mean(axis=0)) for box in boxes]
    return [(a, b) for a, b in ends if abs(np.linalg.norm(b - a) - 2.0) < 0.01]


def test_bars_compare_translations_with_rotations_as_energies_do(rod):
    ax = ed.plots.mode_shapes(rod[0])
    heights = np.array([[bar.get_height() for bar in bars] for bars in ax.containers])
    np.testing.assert_allclose(heights**2, rod[0].energy_share.T, rtol=1e-9)
    assert [t.get_text() for t in ax.get_xticklabels()] == ["y", "θ"]
    assert [t.get_text() for t in ax.get_legend().get_texts()] == ["mode 1: 5.005 Hz", "mode 2: 6.013 Hz"]
    assert len({bars[0].get_hatch() for bars in ax.containers}) == 2, "told apart without color"
    assert "[1]" in ax.get_ylabel()
    assert "mode 1: 5.005 Hz: y 0.9871, theta −0.1601" in ed.plots.alt(ax)


def test_modes_on_the_drawing_turn_about_their_nodes(rod):
    ax = ed.plots.mode_shapes(rod[0], system=W8)
    panels = ax.figure.axes
    assert [panel.get_title(loc="left") for panel in panels] == ["mode 1: 5.005 Hz", "mode 2: 6.013 Hz"]
    for panel, node in zip(panels, rod[0].nodes("y", "theta"), strict=True):
        ends = rods_in(panel)
        assert len(ends) == 3, "both ends of the vibration and rest"
        slopes = np.array([(right[1] - left[1]) / (right[0] - left[0]) for left, right in ends])
        levels = np.array([left[1] - left[0] * k for (left, _), k in zip(ends, slopes, strict=True)])
        # All three lines pass one point, but for the tangent being longer than the arc.
        assert np.ptp(levels + node * slopes) < 0.05 * np.ptp(levels + 2 * (1 + node) * slopes)
    words = ed.plots.alt(ax)
    assert "mode 1: 5.005 Hz" in words
    assert "mode 2: 6.013 Hz" in words


def test_complex_modes_are_drawn_at_several_phases(rod):
    ax = ed.plots.mode_shapes(rod[1], system=W8, mode=1)
    assert len(rods_in(ax)) == 4
    assert ax.get_title(loc="left") == "mode 2: 5.951 Hz, ζ = 0.03815"
    assert "y 0.06786 at −59.3°, theta 0.369 at 0°" in ed.plots.alt(ax)


def test_a_rigid_body_mode_can_be_drawn_and_animated():
    found = ed.modes(linear(S07))
    ax = ed.plots.mode_shapes(found, system=S07, mode=0)
    assert ax.get_title(loc="left") == "mode 1: 0 Hz"
    motion = ed.plots.mode_motion(
        found.linear.at.q, found.shapes[:, 1], found.natural_frequency[1], system=S07
    )
    assert ed.plots.animate(S07, motion).q.shape[1] == 2


def test_what_cannot_be_drawn(rod):
    found, damped = rod
    ax = ed.plots.mode_shapes(found, system=W8, mode=0)
    for call, message in (
        (lambda: ed.plots.mode_shapes(damped), "use phasors"),
        (lambda: ed.plots.mode_shapes(found, ax, system=W8), "say which by mode="),
        (lambda: ed.plots.mode_shapes(found, system=S07), "does not have the coordinates"),
        (lambda: ed.plots.mode_shapes(found, mode=2), "modes 0 to 1"),
        (lambda: ed.plots.nodal_points(found, "y", "theta", (1, -1)), "where the body begins"),
        (lambda: ed.plots.nodal_points(found, "y", "theta", (-1, 1), ax), "say which by mode="),
        (lambda: ed.plots.nodal_points(damped, "y", "phi", (-1, 1)), "choose two of y, theta"),
        (lambda: ed.plots.phasors(damped, 5), "modes 0 to 1"),
        (lambda: ed.plots.phasors(ed.damped_modes(linear(W8, c_1=1e5, c_2=1e5)), 0), "nothing oscillates"),
    ):
        with pytest.raises(ed.EngdynError, match=message):
            call()


# ---------------------------------------------------------------- nodes


def test_the_lines_of_both_ends_cross_at_the_node(rod):
    ax = ed.plots.nodal_points(rod[0], "y", "theta", (-1.0, 1.0))
    for panel, node in zip(ax.figure.axes, (3.5603, -0.09363), strict=True):
        up, down = (line for line in panel.lines if line.get_linestyle() == ":")
        (x0, x1), a, b = up.get_xdata(), up.get_ydata(), down.get_ydata()
        crossing = x0 + (x1 - x0) * (a - b)[0] / ((a - b)[0] - (a - b)[1])
        assert crossing == pytest.approx(node, rel=1e-4)
        (circle,) = (line for line in panel.lines if line.get_marker() == "o")
        assert circle.get_xydata()[0] == pytest.approx([node, 0], rel=1e-4)
    assert ax.figure.axes[-1].get_xlabel() == "distance along the body [m]"
    assert "node at 3.56 m, off the body" in ed.plots.alt(ax)
    assert "node at −0.09363 m, on the body" in ed.plots.alt(ax)


def test_a_node_at_infinity_or_far_away_is_told():
    found = ed.modes(linear(W8, a_1=0.9))
    ax = ed.plots.nodal_points(found, "y", "theta", (-1.0, 1.0), mode=0)
    assert not [line for line in ax.lines if line.get_marker() == "o"]
    assert ax.get_title(loc="left").endswith("; no node, it only translates")
    far = ed.modes(linear(W8, a_1=0.89))
    ax = ed.plots.nodal_points(far, "y", "theta", (-1.0, 1.0), mode=0)
    assert not [line for line in ax.lines if line.get_marker() == "o"]
    assert np.ptp(ax.get_xlim()) < 3
    assert "off the body" in ed.plots.alt(ax)


def test_a_complex_mode_has_no_node_but_a_place_that_moves_least(rod):
    ax = ed.plots.nodal_points(rod[1], "y", "theta", (-1.0, 1.0), mode=1)
    y, theta = rod[1].shapes[:, 1]
    along = np.linspace(-1.0, 1.0, 20001)
    amplitude = np.abs(y + theta * along)
    (least,) = (line.get_xydata() for line in ax.lines if line.get_marker() == "_")
    assert least[0, 0] == least[1, 0] == pytest.approx(along[amplitude.argmin()], abs=1e-4)
    assert -least[0, 1] == least[1, 1] == pytest.approx(amplitude.min() / amplitude.max(), rel=1e-4)
    crossings = [line.get_xdata()[0] for line in ax.lines if line.get_marker() == "s"]
    turned = [np.exp(1j * np.radians(phase)) * np.array([y, theta]) for phase in (0, 45, 90, 135)]
    expected = [-(z[0].real / z[1].real) for z in turned]
    assert crossings == pytest.approx([x for x in expected if abs(x) < 1.12])
    assert len(crossings) == 3
    assert max(crossings) - min(crossings) > 0.3, "the node travels"
    assert [text.get_text() for text in ax.get_legend().get_texts()] == ["0°", "45°", "90°", "135°"]
    assert "mode 2: 5.951 Hz, ζ = 0.03815: least motion at −0.09383 m" in ed.plots.alt(ax.figure)
    assert "displacement" not in ed.plots.alt(ax.figure)


# ---------------------------------------------------------------- phasors


def test_phasors_show_sizes_and_phases(rod):
    ax = ed.plots.phasors(rod[1], 1)
    y, theta = (line.get_xydata()[1] for line in ax.lines[2:4])
    assert theta == pytest.approx([1, 0], abs=1e-12)
    ratio = rod[1].shapes[0, 1] / rod[1].shapes[1, 1] * np.sqrt(20 / (20 / 3))
    assert y == pytest.approx([ratio.real, ratio.imag])
    assert ax.get_legend().get_texts()[0].get_text() == "y:  0.319 ∠ −59.3°"
    assert "[1]" in ax.get_xlabel()
    assert "ζ = 0.03815" in ed.plots.alt(ax)


# ---------------------------------------------------------------- Campbell diagrams


def test_the_campbell_diagram_tells_whirl_and_resonances(rotor):
    ax = ed.plots.campbell(rotor, orders=(1, 2), whirl=("alpha", "beta"), system=S15)
    assert {t.get_text() for t in ax.get_legend().get_texts()} == {"mode 1, forward", "mode 2, backward"}
    assert (ax.get_xlabel(), ax.get_ylabel()) == (r"$\Omega$ [rad/s]", "frequency [Hz]")
    curves = {line.get_label(): line for line in ax.lines}
    assert curves["mode 1, forward"].get_ydata()[-1] > curves["mode 2, backward"].get_ydata()[-1]
    dots = sorted(float(line.get_xdata()[0]) for line in ax.lines if line.get_marker() == "o")
    # A ω² ∓ CΩω = k − mgl with ω = ±νΩ: Ω² = (k − mgl)/(ν²A ∓ νC) where positive.
    stiff = 60 - 5 * 9.81 * 0.15
    expected = sorted(
        np.sqrt(stiff / (n**2 * 0.12 - s * n * 0.18))
        for n in (1, 2)
        for s in (1, -1)
        if n**2 * 0.12 > s * n * 0.18
    )
    assert dots == pytest.approx(expected, rel=1e-4)
    assert "resonance with 1× at 13.25 rad/s" in ed.plots.alt(ax)


def test_flutter_is_marked_in_frequency_and_damping():
    found = ed.track_modes(S12.equations, S12.values(), ("U", np.linspace(1, 30, 117)))
    for quantity in ("damped_frequency", "damping_ratio"):
        ax = ed.plots.campbell(found, quantity=quantity, system=S12)
        band = next(line for line in ax.lines if line.get_label() == "unstable")
        known = np.isfinite(band.get_ydata())
        assert band.get_xdata()[known].min() == pytest.approx(20.3343, abs=0.25)
        assert band.get_xdata()[known].max() == 30
        assert "unstable from 20.5 to 30" in ed.plots.alt(ax)
    assert ax.get_ylabel() == "damping ratio [1]"
    curve = next(line for line in ax.lines if line.get_label() == "mode 2").get_ydata()
    assert curve[0] > 0 > curve[-1]


def test_what_no_diagram_shows(rotor):
    with pytest.raises(ed.EngdynError, match="choose one of damped_frequency"):
        ed.plots.campbell(rotor, quantity="phase")
    with pytest.raises(ed.EngdynError, match="orders are frequencies"):
        ed.plots.campbell(rotor, quantity="damping_ratio", orders=[1])
    with pytest.raises(ed.EngdynError, match="no coordinate 'x'"):
        ed.plots.campbell(rotor, whirl=("x", "y"))
    assert ed.plots.campbell(rotor).get_xlabel() == "Omega"


def test_pictures_of_something_else_are_refused():
    """Each says what it needs; phasors of real modes, too, have nothing to show."""
    real = ed.modes(ed.linearize(ed.systems.load("W8").equations, {}, ed.systems.load("W8").values(c_1=0.0)))
    for draw, message in {
        lambda: ed.plots.mode_shapes("modes"): "holds no modes",
        lambda: ed.plots.mode_shapes(real, system="rod"): "does not have the coordinates",
        lambda: ed.plots.phasors(real): "engdyn.damped_modes",
        lambda: ed.plots.nodal_points(3, "y", "theta", (-1, 1)): "holds no modes",
        lambda: ed.plots.nodal_points(real, "y", "theta", (-1, 0, 1)): "where the body begins",
        lambda: ed.plots.campbell(real): "engdyn.track_modes",
        lambda: ed.plots.stability_map(real): "engdyn.stability_map",
        lambda: ed.plots.root_locus(None): "engdyn.stability_map",
        lambda: ed.plots.tangent(sm.sin(sm.Symbol("x")), "x"): "finite number",
    }.items():
        with pytest.raises(ed.EngdynError, match=message):
            draw()
