"""The frame of all explorers: controls, one picture drawn again and again into the same figure, and words.

An explorer is a class with a few small methods: `controls` says what can be set, `model` computes (and knows
nothing of pictures), `draw_static` and `draw_moving` draw, `words` tells, `lines` writes the same as code. All of
them are driven by ``set`` without a browser.
"""

from __future__ import annotations

import asyncio
import base64
import html
import io
import warnings
from abc import ABC, abstractmethod
from collections.abc import Hashable, Iterable, Mapping, Sequence
from typing import Any

import ipywidgets
import numpy as np
from matplotlib.artist import Artist
from matplotlib.figure import Figure
from PIL import Image

from engdyn.errors import EngdynError, EngdynWarning
from engdyn.plots.alternative import small
from engdyn.plots.look import new_figure, style
from engdyn.plots.words import number
from engdyn.widgets.controls import Choice, Control, Slider

__all__ = ["Explorer"]

PATIENCE = 0.2
"""Seconds of rest after which what is slow to compute is made up for."""


class Explorer(ABC):
    """An interactive picture; subclasses say what is set, computed, drawn and told.

    Parameters
    ----------
    **values : float or str
        Where the controls stand at first.

    Attributes
    ----------
    title : str
        What is explored.
    structural : tuple of str
        Names of the choices on which the other controls depend.
    size : tuple of float
        Width and height of the picture in inches.
    dpi : int
        Dots per inch; small, since every step of a slider makes a new picture.
    """

    title: str = ""
    structural: tuple[str, ...] = ()
    size: tuple[float, float] = (9.6, 4.2)
    dpi: int = 80

    @abstractmethod
    def controls(self, chosen: Mapping[str, Any]) -> Sequence[Control]:
        """Return the controls that fit the structural choices so far; equal choices give equal controls."""

    @abstractmethod
    def model(self, state: Mapping[str, Any]) -> Any:
        """Compute what is to be shown; raises EngdynError where there is nothing to show."""

    @abstractmethod
    def draw_static(self, figure: Figure, state: Mapping[str, Any], result: Any) -> None:
        """Draw, into an empty figure, what stays while `static_key` is the same."""

    def draw_moving(self, figure: Figure, state: Mapping[str, Any], result: Any) -> Iterable[Artist]:
        """Draw the rest and return its artists, lowest first; by default there is none."""
        return ()

    def caption(self, state: Mapping[str, Any]) -> str:
        """Say what is being looked at, as a heading for the words; by default nothing."""
        return ""

    @abstractmethod
    def words(self, state: Mapping[str, Any], result: Any) -> str:
        """Tell the result in a sentence or two."""

    @abstractmethod
    def lines(self, state: Mapping[str, Any]) -> Sequence[str]:
        """Return the lines of engdyn that compute and draw what is seen, after ``import engdyn as ed``."""

    def static_key(self, state: Mapping[str, Any], result: Any) -> Hashable:
        """Return what `draw_static` depends on; by default everything, so that nothing is reused."""
        return tuple(state.items())

    def __init__(self, **values: Any) -> None:
        self.figure = new_figure(*self.size, layout=None)
        self.figure.set_dpi(self.dpi)
        self._key: Hashable = None
        self._background: Any = None
        self._moving: list[Artist] = []
        self._controls: dict[str, Control] = {}
        self._widgets: dict[str, Any] = {}
        self._state: dict[str, Any] = {}
        self._quiet = False
        self._haste: asyncio.AbstractEventLoop | None = None
        self._pending: asyncio.TimerHandle | None = None
        self._text, self._png = "", b""
        self._build_frame()
        self.set(**values)

    # State

    @property
    def state(self) -> dict[str, Any]:
        """Where the controls stand: name → value (a copy)."""
        return dict(self._state)

    def set(self, **values: Any) -> None:
        """Set some controls and draw once; nothing changes if any of the values is refused.

        Parameters
        ----------
        **values : float or str
            Values by the names of the controls.

        Raises
        ------
        EngdynError
            Unknown name, a number that is not finite or out of range, an unknown choice.
        """
        controls = self._fitting_controls(values)
        for name in values:
            if name not in controls:
                raise EngdynError(f"There is no control {name!r}; choose from {', '.join(controls)}.")
        checked = {name: controls[name].check(value) for name, value in values.items()}
        kept = {n: v for n, v in self._state.items() if n in controls and controls[n] == self._controls[n]}
        state = {name: checked.get(name, kept.get(name, control.value)) for name, control in controls.items()}
        changed = [n for n in state if n in checked and state[n] != self._state.get(n)]
        self._state = state
        self._show_controls(controls)
        self._render(changed)

    def reset(self) -> None:
        """Put all controls back to where they started, keeping the structural choices."""
        self.set(**{name: c.value for name, c in self._controls.items() if name not in self.structural})

    def _fitting_controls(self, values: Mapping[str, Any]) -> dict[str, Control]:
        chosen = {n: self._state[n] for n in self.structural if n in self._state}
        for name in self.structural:
            # One structural choice may decide about the next, so they are checked in turn.
            known = {control.name: control for control in self.controls(chosen)}
            if name in values:
                chosen[name] = known[name].check(values[name])
            elif chosen.get(name) not in [option for _, option in known[name].options]:
                chosen[name] = known[name].value
        return {control.name: control for control in self.controls(chosen)}

    # Picture

    def png(self) -> bytes:
        """Return the present picture as a PNG file."""
        return self._png

    @property
    def text(self) -> str:
        """The present picture in words."""
        return self._text

    @property
    def code(self) -> str:
        """The lines of engdyn that make the present picture, to be run in a cell of one's own."""
        return "\n".join(["import engdyn as ed", *self.lines(self._state)])

    def _render(self, changed: Sequence[str]) -> None:
        if self._pending is not None:
            self._pending.cancel()
            self._pending = None
        with style(), warnings.catch_warnings(record=True) as heard:
            warnings.simplefilter("always", EngdynWarning)
            try:
                result = self.model(self._state)
                told = self.words(self._state, result)
                self._draw(result)
            except (EngdynError, ArithmeticError, np.linalg.LinAlgError) as error:
                told = f"Nothing to draw: {error}"
                self._draw_message(told)
        remarks = {str(w.message): None for w in heard if issubclass(w.category, EngdynWarning)}
        told += "".join(f" Note: {remark}." for remark in remarks)
        self._png = _encoded(self.figure)
        caption = self.caption(self._state)
        self._text = f"{self.title}. {caption}: {told}" if caption else f"{self.title}. {told}"
        self._picture.value = self._png
        news = ", ".join(self._in_words(name) for name in changed[:3]) + (" …" if len(changed) > 3 else "")
        before = news or caption
        self._line.value = f"<p role='status'>{html.escape(f'{before}: {told}' if before else told)}</p>"
        self._show_code()

    def _show_code(self) -> None:
        shown = f"<pre tabindex='0'>{html.escape(self.code)}</pre>" if self._coding.value else ""
        self._code.value = shown

    def _draw(self, result: Any) -> None:
        canvas, key = self.figure.canvas, self.static_key(self._state, result)
        for artist in self._moving:
            artist.remove()
        self._moving = []
        if key != self._key or self._background is None:
            self.figure.clear()
            self._key = None
            self.draw_static(self.figure, self._state, result)
            canvas.draw()
            self._background = canvas.copy_from_bbox(self.figure.bbox)
            self._key = key
        else:
            canvas.restore_region(self._background)
        self._moving = list(self.draw_moving(self.figure, self._state, result))
        for artist in self._moving:
            self.figure.draw_artist(artist)

    def _draw_message(self, text: str) -> None:
        self.figure.clear()
        self._key, self._moving = None, []
        self.figure.text(0.5, 0.5, text, ha="center", va="center", wrap=True)
        self.figure.canvas.draw()

    def _in_words(self, name: str) -> str:
        control, value = self._controls[name], self._state[name]
        if isinstance(control, Choice):
            return f"{name} = {value}"
        return f"{name} = {number(value)}" + (f" {control.unit}" if control.unit != "-" else "")

    # Widgets

    def _build_frame(self) -> None:
        width = f"{round(self.size[0] * self.dpi)}px"
        # No tooltip on the picture: with one, ipywidgets 8.1.9 fails to show it. Its words stand below.
        self._picture = ipywidgets.Image(
            format="png", layout=ipywidgets.Layout(width=width, max_width="100%")
        )
        self._line = ipywidgets.HTML()
        self._choices, self._sliders = ipywidgets.HBox(), ipywidgets.Box()
        self._choices.layout.flex_flow = "row wrap"
        self._sliders.layout = ipywidgets.Layout(flex_flow="row wrap", max_height="13em", overflow="auto")
        self._reset = ipywidgets.Button(
            description="Reset", tooltip="Put all controls back to where they started"
        )
        self._reset.on_click(lambda _: self.reset())
        self._code = ipywidgets.HTML()
        self._coding = ipywidgets.ToggleButton(
            description="Show code", tooltip="Show the lines of engdyn that make this picture"
        )
        self._coding.observe(lambda _: self._show_code(), "value")
        self.widget = ipywidgets.VBox([self._choices, self._picture, self._line, self._sliders, self._code])

    def _show_controls(self, controls: Mapping[str, Control]) -> None:
        self._quiet = True
        try:
            if controls != self._controls:
                self._controls = dict(controls)
                old, self._widgets = self._widgets, {n: c.widget(self._state[n]) for n, c in controls.items()}
                for name, widget in self._widgets.items():
                    widget.observe(lambda change, name=name: self._moved(name, change["new"]), "value")
                of = {
                    kind: [w for n, w in self._widgets.items() if isinstance(controls[n], kind)]
                    for kind in (Choice, Slider)
                }
                self._choices.children = (*of[Choice], self._reset, self._coding)
                self._sliders.children = tuple(of[Slider])
                for widget in old.values():
                    widget.close()
            for name, widget in self._widgets.items():
                widget.value = self._state[name]
        finally:
            self._quiet = False

    def _moved(self, name: str, value: Any) -> None:
        """Follow a control; while it is dragged in a live notebook, slow parts of the picture may wait."""
        if self._quiet:
            return
        self._haste = _running_loop()
        try:
            self.set(**{name: value})
        finally:
            self._haste = None

    def _complete_later(self) -> None:
        """Draw again, completely, as soon as the controls have been at rest for `PATIENCE` seconds."""
        if self._haste is not None:
            self._pending = self._haste.call_later(PATIENCE, self._render, [])

    def __repr__(self) -> str:
        return self._text

    def _repr_mimebundle_(self, include: Any = None, exclude: Any = None) -> tuple[dict, dict]:
        """The live widget, and beside it the picture and its words for readers without a kernel."""
        data = dict(self.widget._repr_mimebundle_() or {})
        data.update(
            {"text/plain": self._text, "image/png": base64.b64encode(small(self._png)).decode("ascii")}
        )
        return data, {"image/png": {"alt": self._text}}


def _encoded(figure: Figure) -> bytes:
    """Return what the canvas shows as PNG; light compression, because speed matters more than size here."""
    stream = io.BytesIO()
    Image.fromarray(np.asarray(figure.canvas.buffer_rgba())).convert("RGB").save(
        stream, "png", compress_level=1
    )
    return stream.getvalue()


def _running_loop() -> asyncio.AbstractEventLoop | None:
    """Return the event loop of a live kernel; None in a script or a test, where nothing may be put off."""
    try:
        return asyncio.get_running_loop()
    except RuntimeError:
        return None
