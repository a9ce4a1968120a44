"""Controls of an explorer as data: what may be set, within which limits, and the widget that sets it."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import ipywidgets

from engdyn.errors import EngdynError

__all__ = ["Choice", "Control", "Slider"]


@dataclass(frozen=True)
class Slider:
    """A number between two limits.

    Parameters
    ----------
    name : str
        Name in the state of the explorer.
    low, high : float
        Limits, in ``unit``.
    value : float
        Where it starts and returns to.
    unit : str
        SI unit, "-" for none.
    meaning : str
        What is set, in words; shown as a tooltip and read by screen readers.
    step : float, optional
        What one press of an arrow key changes; by default the range has about a hundred steps. A slider shows
        no values between its steps, so ``value`` should be one of them.
    """

    name: str
    low: float
    high: float
    value: float
    unit: str = "-"
    meaning: str = ""
    step: float | None = None

    def check(self, value: Any) -> float:
        """Return ``value`` as a float within the limits.

        Raises
        ------
        EngdynError
            No number, not finite, or out of range.
        """
        try:
            number = float(value)
        except (TypeError, ValueError):
            raise EngdynError(f"{self.name} = {value!r} is no number; give one {self._range}.") from None
        if not math.isfinite(number):
            raise EngdynError(f"{self.name} = {number} is not finite; give a number {self._range}.")
        if not self.low <= number <= self.high:
            raise EngdynError(f"{self.name} = {number:g} is out of range; give a number {self._range}.")
        return number

    @property
    def _range(self) -> str:
        return f"from {self.low:g} to {self.high:g}" + (f" {self.unit}" if self.unit != "-" else "")

    def widget(self, value: float) -> ipywidgets.FloatSlider:
        """Return a slider, operable by the arrow keys, that stands at ``value``."""
        return ipywidgets.FloatSlider(
            value=value,
            min=self.low,
            max=self.high,
            step=self.step or (self.high - self.low) / 100.0,
            description=f"{self.name} [{self.unit if self.unit != '-' else '1'}]",
            tooltip=f"{self.meaning or self.name}, {self._range}",
            readout_format=".4g",
            tabbable=True,
            style={"description_width": "11em"},
            layout=ipywidgets.Layout(width="26em"),
        )


@dataclass(frozen=True)
class Choice:
    """One of several texts.

    Parameters
    ----------
    name : str
        Name in the state of the explorer.
    options : tuple of (str, str)
        Label and value of each option.
    value : str
        The first choice.
    meaning : str
        What is chosen, in words.
    """

    name: str
    options: tuple[tuple[str, str], ...]
    value: str
    meaning: str = ""

    def check(self, value: Any) -> str:
        """Return ``value`` if it is one of the options.

        Raises
        ------
        EngdynError
            It is none of them.
        """
        known = [option for _, option in self.options]
        if value not in known:
            raise EngdynError(f"{self.name} = {value!r} is unknown; choose one of {', '.join(known)}.")
        return value

    def widget(self, value: str) -> ipywidgets.Dropdown:
        """Return a dropdown list that shows ``value``."""
        return ipywidgets.Dropdown(
            options=self.options,
            value=value,
            description=self.name,
            tooltip=self.meaning or self.name,
            tabbable=True,
            style={"description_width": "6em"},
            layout=ipywidgets.Layout(width="30em"),
        )


Control = Slider | Choice
