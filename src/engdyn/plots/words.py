"""Symbols, numbers and poses in words, for titles, labels and text alternatives."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import sympy as sm
from sympy.physics.vector.printing import vlatex
from sympy.printing.pretty.pretty_symbology import pretty_symbol

__all__ = ["number", "plain_symbol", "plain_verdict", "pose", "quantity", "symbol", "with_unit"]


def number(value: float) -> str:
    """Write a number with at most four significant digits; what is zero but for rounding is 0."""
    return "0" if abs(value) < 1e-12 else f"{value:.4g}".replace("-", "−")


def quantity(name: str, value: float, unit: str) -> str:
    """Write ``name = value unit``; angles also in degrees.

    Examples
    --------
    >>> quantity("L", 9.0, "m")
    'L = 9 m'
    >>> quantity("theta", 0.5, "rad")
    'theta = 0.5 rad (28.6°)'
    """
    text = f"{name} = {number(value)}" + (f" {unit}" if unit not in ("", "-") else "")
    degrees = f"{math.degrees(value):.1f}".replace("-", "−")
    return text + (f" ({degrees}°)" if unit == "rad" and abs(value) > 1e-12 else "")


def pose(coordinates: Sequence[Any], q: Sequence[float]) -> str:
    """Write a pose, for example ``x = 0 m, theta = 0.5 rad (28.6°)``."""
    return ", ".join(quantity(c.name, float(value), c.unit) for c, value in zip(coordinates, q, strict=True))


def plain_verdict(verdict: str) -> str:
    """Write ``unstable (flutter)`` without parentheses, because verdicts are told in parentheses."""
    return verdict.replace(" (", ", ").replace(")", "")


def symbol(item: Any) -> str:
    r"""Return the symbol of a coordinate, parameter or input as mathtext, for example ``$\theta$``.

    Names of two plain letters, such as ``zf``, are read as a letter with a subscript.
    """
    text = vlatex(getattr(item, "symbol", sm.Symbol(item.name)))
    if len(text) == 2 and text.isalpha():
        text = f"{text[0]}_{{{text[1]}}}"
    return f"${text}$"


def plain_symbol(item: Any) -> str:
    """Return the symbol as plain letters, for example ``θ``: quicker to typeset than mathtext."""
    return pretty_symbol(item.name)


def with_unit(label: str, unit: str) -> str:
    """Write an axis label with its unit in brackets; 1 for quantities without unit."""
    return f"{label} [{unit if unit not in ('', '-') else '1'}]"
