"""The frame of all explorers, driven without a browser."""

from __future__ import annotations

import base64
import io
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from PIL import Image

from engdyn import EngdynError
from engdyn.widgets import Explorer, catalogue
from engdyn.widgets.controls import Choice, Slider


class Pendulum(Explorer):
    """A toy: one dot per slider value; counts what it is asked for."""

    title = "Toy"
    structural = ("kind",)
    size = (4.0, 3.0)
    dpi = 50

    def __init__(self, **values):
        self.calls = {"model": 0, "static": 0, "moving": 0}
        super().__init__(**values)

    def controls(self, chosen):
        kinds = Choice(
            "kind", (("A long pendulum", "long"), ("A short pendulum", "short")), "long", "which one"
        )
        if "kind" not in chosen:
            return [kinds]
        length = (
            Slider("L", 0.5, 10.0, 2.0, "m", "length")
            if chosen["kind"] == "long"
            else Slider("L", 0.01, 0.5, 0.1, "m")
        )
        return [
            kinds,
            length,
            Slider("theta", -math.pi, math.pi, 0.5, "rad", "angle"),
            Slider("N", 0.0, 5.0, 1.0),
        ]

    def model(self, state):
        self.calls["model"] += 1
        if abs(state["theta"]) > 3.0:
            raise EngdynError("the pendulum stands on its head")
        if state["N"] == 0.0:
            return 1.0 / state["N"]
        return state["L"] * math.sin(state["theta"])

    def static_key(self, state, result):
        return state["kind"], state["L"]

    def draw_static(self, figure, state, result):
        self.calls["static"] += 1
        ax = figure.add_axes((0.2, 0.2, 0.7, 0.7))
        ax.set_xlim(-10.0, 10.0)

    def draw_moving(self, figure, state, result):
        self.calls["moving"] += 1
        return figure.axes[0].plot([result], [0.5], "o", color="red", animated=True)

    def words(self, state, result):
        return f"The bob is {result:.2f} m to the side."

    def lines(self, state):
        return [f"side = {state['L']} * {state['theta']} < 1  # small"]


def pixels(explorer):
    return np.asarray(Image.open(io.BytesIO(explorer.png())).convert("RGB"), int)


def red_column(explorer):
    """Center of the red dot as a fraction of the width of the axes."""
    rgb = pixels(explorer)
    red = (rgb[..., 0] > 200) & (rgb[..., 1] < 60)
    return (np.nonzero(red)[1].mean() / rgb.shape[1] - 0.2) / 0.7


def test_state_starts_at_the_defaults_and_is_a_copy():
    toy = Pendulum()
    assert toy.state == {"kind": "long", "L": 2.0, "theta": 0.5, "N": 1.0}
    toy.state["L"] = 99.0
    assert toy.state["L"] == 2.0


def test_set_draws_once_whatever_the_number_of_values():
    toy = Pendulum()
    before = dict(toy.calls)
    toy.set(L=3.0, theta=0.1, N=2.0)
    assert {name: toy.calls[name] - before[name] for name in before} == {"model": 1, "static": 1, "moving": 1}
    assert toy.state == {"kind": "long", "L": 3.0, "theta": 0.1, "N": 2.0}


def test_what_stays_is_not_drawn_again():
    toy = Pendulum()
    static = toy.calls["static"]
    for theta in (0.1, 0.2, 0.3):
        toy.set(theta=theta)
    assert toy.calls["static"] == static
    toy.set(L=4.0)
    assert toy.calls["static"] == static + 1


@pytest.mark.parametrize("theta", [-1.5, 0.0, 0.9])
def test_the_picture_shows_the_result_also_on_the_reused_background(theta):
    toy = Pendulum(L=8.0)
    toy.set(theta=0.3)
    toy.set(theta=theta)
    assert red_column(toy) == pytest.approx((8.0 * math.sin(theta) + 10.0) / 20.0, abs=0.01)
    fresh = Pendulum(L=8.0, theta=theta)
    assert np.array_equal(pixels(toy), pixels(fresh))


def test_the_figure_holds_what_the_picture_shows():
    toy = Pendulum(L=8.0, theta=0.9)
    (dot,) = toy.figure.axes[0].lines
    assert dot.get_xdata() == pytest.approx([8.0 * math.sin(0.9)])


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({"length": 1.0}, "no control 'length'; choose from kind, L, theta, N"),
        ({"L": 11.0}, "L = 11 is out of range; give a number from 0.5 to 10 m"),
        ({"L": math.nan}, "L = nan is not finite"),
        ({"L": math.inf}, "not finite"),
        ({"L": "long"}, "no number"),
        ({"L": None}, "no number"),
        ({"N": -0.1}, "from 0 to 5"),
        ({"kind": "medium"}, "kind = 'medium' is unknown; choose one of long, short"),
    ],
)
def test_refused_values_change_nothing(values, message):
    toy = Pendulum()
    state, picture = toy.state, toy.png()
    with pytest.raises(EngdynError, match=message):
        toy.set(theta=0.1, **values)
    assert toy.state == state
    assert toy.png() == picture


def test_refused_at_the_start_too():
    with pytest.raises(EngdynError, match="out of range"):
        Pendulum(L=1e9)


def test_a_structural_choice_brings_its_own_controls():
    toy = Pendulum(theta=0.2)
    toy.set(kind="short")
    # What means the same is kept, what has other limits starts anew.
    assert toy.state == {"kind": "short", "L": 0.1, "theta": 0.2, "N": 1.0}
    toy.set(kind="long", L=7.0)
    assert toy.state["L"] == 7.0
    with pytest.raises(EngdynError, match="out of range"):
        toy.set(kind="short", L=7.0)
    assert toy.state["kind"] == "long"


def test_reset_keeps_the_structure():
    toy = Pendulum(kind="short", L=0.3, theta=1.0)
    toy.reset()
    assert toy.state == {"kind": "short", "L": 0.1, "theta": 0.5, "N": 1.0}


@pytest.mark.parametrize(
    ("values", "why"), [({"theta": math.pi}, "stands on its head"), ({"N": 0.0}, "division by zero")]
)
def test_where_there_is_nothing_to_draw_the_picture_says_why(values, why):
    toy = Pendulum()
    toy.set(**values)
    assert why in toy.text
    assert [text.get_text() for text in toy.figure.texts] == [toy.text.removeprefix("Toy. ")]
    assert pixels(toy).min() < 128  # not blank
    toy.set(theta=0.1, N=1.0)
    assert toy.text == "Toy. The bob is 0.20 m to the side."
    assert not toy.figure.texts


@settings(max_examples=30)
@given(st.floats(0.5, 10.0), st.floats(-math.pi, math.pi), st.floats(0.0, 5.0))
def test_no_position_of_the_sliders_raises_or_blanks(L, theta, N):
    TOY.set(L=L, theta=theta, N=N)
    assert TOY.text
    assert np.ptp(pixels(TOY)) > 100


TOY = Pendulum()


def test_words_tell_what_changed():
    toy = Pendulum()
    toy.set(theta=-0.25)
    assert toy._line.value == "<p role='status'>theta = −0.25 rad: The bob is -0.49 m to the side.</p>"


def test_the_code_is_shown_on_demand_and_follows():
    toy = Pendulum(theta=0.25)
    assert toy.code == "import engdyn as ed\nside = 2.0 * 0.25 < 1  # small"
    assert toy._code.value == ""
    named(toy)["Show code"].value = True
    assert "2.0 * 0.25 &lt; 1  # small</pre>" in toy._code.value
    toy.set(theta=0.5)
    assert "2.0 * 0.5 &lt; 1" in toy._code.value
    named(toy)["Show code"].value = False
    assert toy._code.value == ""


def test_words_are_escaped():
    class Sly(Pendulum):
        def words(self, state, result):
            return "<script>alert(1)</script> & more"

    assert Sly()._line.value == "<p role='status'>&lt;script&gt;alert(1)&lt;/script&gt; &amp; more</p>"


# As widgets


def named(toy):
    return {widget.description: widget for widget in (*toy._choices.children, *toy._sliders.children)}


def test_controls_carry_unit_limits_and_meaning():
    length = named(Pendulum())["L [m]"]
    assert (length.min, length.max, length.value) == (0.5, 10.0, 2.0)
    assert length.tooltip == "length, from 0.5 to 10 m"
    assert length.tabbable
    assert length.step == pytest.approx(0.095)


def test_moving_a_slider_draws_once():
    toy = Pendulum()
    calls = toy.calls["model"]
    named(toy)["theta [rad]"].value = 0.9
    assert toy.state["theta"] == 0.9
    assert toy.calls["model"] == calls + 1


def test_set_moves_the_sliders():
    toy = Pendulum()
    toy.set(L=5.0)
    assert named(toy)["L [m]"].value == 5.0


def test_a_dropdown_changes_the_sliders():
    toy = Pendulum()
    named(toy)["kind"].value = "short"
    assert toy.state["kind"] == "short"
    assert named(toy)["L [m]"].max == 0.5


def test_the_reset_button_resets():
    toy = Pendulum(theta=1.0)
    named(toy)["Reset"].click()
    assert toy.state["theta"] == 0.5


def test_the_picture_widget_shows_the_picture_and_can_be_shown():
    toy = Pendulum()
    assert toy._picture.value == toy.png()
    assert toy._picture.tooltip is None  # the view of ipywidgets 8.1.9 breaks with one
    assert Image.open(io.BytesIO(toy.png())).size == (200, 150)


def test_display_has_a_live_view_a_still_picture_and_stable_words():
    data, metadata = Pendulum()._repr_mimebundle_()
    again, _ = Pendulum()._repr_mimebundle_()
    assert data["text/plain"] == again["text/plain"] == "Toy. The bob is 0.96 m to the side."
    still = base64.b64decode(data["image/png"])  # with a palette, to keep notebooks small
    assert len(still) < len(Pendulum().png())
    assert (
        np.abs(np.asarray(Image.open(io.BytesIO(still)).convert("RGB"), int) - pixels(Pendulum())).max() < 40
    )
    assert "model_id" in data["application/vnd.jupyter.widget-view+json"]
    assert metadata["image/png"]["alt"] == data["text/plain"]
    assert repr(Pendulum()) == data["text/plain"]


def test_catalogue_names_functions_of_the_namespace():
    import engdyn as ed

    assert catalogue() == sorted(set(catalogue()))
    for name in catalogue():
        assert callable(getattr(ed.widgets, name))
