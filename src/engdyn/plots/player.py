"""The player of animations in notebooks: play and pause, a slider, speeds, and one picture that is reused."""

from __future__ import annotations

import html
from collections.abc import Callable

import ipywidgets

from engdyn.plots.motion import pace_in_words

__all__ = ["Player"]


class Player:
    """Controls and a picture; stands still until somebody presses play.

    The browser counts the ticks and asks for the next picture when it has got the last one, so a busy kernel
    makes the film jerky but never late.

    Parameters
    ----------
    picture : callable
        ``picture(tick)`` returns a PNG file.
    start, step : float
        Time of tick 0, and from tick to tick [s].
    ticks : int
        How many there are.
    fine : int
        Ticks from frame to frame.
    seconds : float
        From frame to frame of the film, at its own speed [s].
    speed : float
        That speed: seconds of motion per second of film.
    words : str
        What is to be seen, for readers who cannot see it.

    Attributes
    ----------
    widget : ipywidgets.VBox
    button, play, time, speed, picture : widgets
        Its parts.
    """

    def __init__(
        self,
        picture: Callable[[int], bytes],
        *,
        start: float,
        step: float,
        ticks: int,
        fine: int,
        seconds: float,
        speed: float,
        words: str,
    ) -> None:
        self._png, self._start, self._step, self._quiet = picture, start, step, False
        last = max(ticks - 1, 1)
        # No tooltip on the picture: with one, ipywidgets 8.1.9 fails to show it. Its words stand below.
        self.picture = ipywidgets.Image(
            value=picture(0), format="png", layout=ipywidgets.Layout(width="max-content", max_width="100%")
        )
        self.play = ipywidgets.Play(
            min=0, max=last, step=fine, interval=max(round(1000.0 * seconds), 10), repeat=True
        )
        # The buttons of Play have no names that a screen reader could tell: another one stands for them.
        self.play.layout.display = "none"
        self.button = ipywidgets.ToggleButton(tooltip="Play or pause", tabbable=True)
        self.button.layout.width = "8em"
        ipywidgets.jslink((self.button, "value"), (self.play, "playing"))
        self.time = _time_slider(start, start + last * step, step)
        self.speed = _speed_menu(speed, fine)
        controls = ipywidgets.HBox([self.button, self.play, self.time, self.speed])
        controls.layout.flex_flow = "row wrap"
        self.widget = ipywidgets.VBox(
            [self.picture, controls, ipywidgets.HTML(f"<p>{html.escape(words)}</p>")]
        )
        self._named({"new": False})
        self.button.observe(self._named, "value")
        self.play.observe(self._ticked, "value")
        self.time.observe(self._slid, "value")
        self.speed.observe(self._hurried, "value")

    def _named(self, change: dict) -> None:
        """Say on the button what it does next."""
        self.button.description, self.button.icon = ("Pause", "pause") if change["new"] else ("Play", "play")

    def _ticked(self, change: dict) -> None:
        """Show the picture of a tick, and let the slider follow."""
        self.picture.value = self._png(change["new"])
        self._quiet = True
        try:
            self.time.value = self._start + change["new"] * self._step
        finally:
            self._quiet = False

    def _slid(self, change: dict) -> None:
        """Go where the slider was put."""
        if not self._quiet:
            self.play.value = round((change["new"] - self._start) / self._step)

    def _hurried(self, change: dict) -> None:
        self.play.step = change["new"]


def _time_slider(low: float, high: float, step: float) -> ipywidgets.FloatSlider:
    return ipywidgets.FloatSlider(
        value=low,
        min=low,
        max=high,
        step=step,
        description="time [s]",
        tooltip="Time of the picture in seconds",
        readout_format=".4g",
        tabbable=True,
        layout=ipywidgets.Layout(width="26em"),
    )


def _speed_menu(speed: float, fine: int) -> ipywidgets.Dropdown:
    return ipywidgets.Dropdown(
        options=[(pace_in_words(speed * ticks / fine), ticks) for ticks in (1, 2, 4, 8, 16)],
        value=fine,
        description="speed",
        tooltip="How fast the film runs",
        tabbable=True,
        layout=ipywidgets.Layout(width="18em"),
    )
