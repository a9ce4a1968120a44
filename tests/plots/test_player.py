"""The player of animations, driven without a browser, and what it leaves in a notebook."""

from __future__ import annotations

import base64
import io

import ipywidgets
import numpy as np
import pytest
from PIL import Image

import engdyn as ed


def animation(speed=1.0):
    time = np.array([0.0, 1.0, 2.0])
    return ed.plots.animate(ed.systems.load("S07"), (time, np.column_stack([time, 0.3 * time])), speed=speed)


def shown(player):
    return np.asarray(Image.open(io.BytesIO(player.picture.value)).convert("RGB"))


def parts(widget):
    for child in getattr(widget, "children", ()):
        yield child
        yield from parts(child)


def test_it_stands_still_until_somebody_presses_play():
    film = animation()
    player = film.player
    assert player.play.playing is False
    assert player.play.value == 0
    assert np.array_equal(shown(player), film.frame(0))
    assert player.time.value == 0.0


def test_ticks_drive_the_picture_and_the_slider():
    film = animation()
    player = film.player
    player.play.value += player.play.step
    assert np.array_equal(shown(player), film.frame(1))
    assert player.time.value == pytest.approx(film.time[1])
    player.play.value = player.play.max
    assert np.array_equal(shown(player), film.frame(-1))
    assert player.time.value == pytest.approx(2.0)
    assert player.time.max == pytest.approx(2.0)


def test_the_slider_drives_the_picture_and_the_ticks():
    film = animation()
    player = film.player
    player.time.value = 1.0
    assert np.array_equal(shown(player), film.frame(25))
    assert player.play.value == 25 * player.play.step
    assert player.time.value == 1.0


def test_an_arrow_key_on_the_slider_moves_the_picture():
    film = animation()
    player = film.player
    before = shown(player)
    player.time.value += player.time.step
    assert player.play.value == 1
    assert np.any(shown(player) != before)


@pytest.mark.parametrize("speed", [1.0, 0.2])
def test_speeds_pass_the_motion_at_the_pace_they_promise(speed):
    film = animation(speed)
    player = film.player
    for label, ticks in player.speed.options:
        player.speed.value = ticks
        pace = 1.0 if label == "real time" else float(label.split(" ×")[0])
        passed = player.play.step * player.time.step / (player.play.interval / 1000.0)
        assert passed == pytest.approx(pace, rel=0.01)
    assert ("real time", 4) in player.speed.options or speed != 1.0
    # A new player runs at the speed of the film.
    assert animation(speed).player.play.step == 4


def test_a_motion_that_repeats_goes_on_without_a_jump():
    film = ed.plots.animate(ed.systems.load("S07"), ed.plots.mode_motion([0.0, 0.0], [0.0, 1.0], 0.5))
    player = film.player
    steps = len(range(0, player.play.max + 1, player.play.step))
    assert steps == len(film)
    assert player.play.repeat


def test_pictures_are_not_drawn_twice():
    film = animation()
    player = film.player
    drawn = []
    film._stage.picture, original = lambda *a: drawn.append(a) or original(*a), film._stage.picture
    for value in (4, 8, 4, 8, 0):
        player.play.value = value
    assert len(drawn) == 2


def test_controls_can_be_reached_by_keys_and_have_names():
    player = animation().player
    controls = [player.button, player.time, player.speed]
    assert all(control.tabbable for control in controls)
    assert all(control.description and control.tooltip for control in controls)
    seen = list(parts(player.widget))
    assert all(control in seen for control in [*controls, player.play, player.picture])
    words = [part.value for part in seen if isinstance(part, ipywidgets.HTML)]
    assert any("Gantry crane" in text for text in words)


def test_the_button_says_what_it_does_next():
    player = animation().player
    assert player.button.description == "Play"
    player.button.value = True
    assert player.button.description == "Pause"


def test_a_notebook_without_kernel_shows_the_strobe_picture_and_its_words():
    data, metadata = animation()._repr_mimebundle_()
    assert "application/vnd.jupyter.widget-view+json" in data
    assert data["text/plain"].startswith("Strobe picture, 7 poses")
    assert metadata["image/png"]["alt"] == data["text/plain"]
    picture = Image.open(io.BytesIO(base64.b64decode(data["image/png"])))
    assert min(picture.size) > 200
    assert "text/html" not in data


def test_what_a_notebook_stores_is_the_same_at_every_run():
    (first, _), (again, _) = (animation()._repr_mimebundle_() for _ in range(2))
    for kind in ("text/plain", "image/png"):
        assert first[kind] == again[kind]


def test_it_is_short_on_a_terminal():
    assert repr(animation()) == (
        "Animation(Gantry crane: trolley and hanging container; 51 frames, t = 0.00 s to 2.00 s)"
    )
