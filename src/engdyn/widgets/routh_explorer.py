"""Explorer of Routh's criterion: coefficients on sliders, the table colored by signs, the roots (section 5.4)."""

from __future__ import annotations

import math
from collections.abc import Callable, Hashable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from itertools import pairwise
from typing import Any

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle
from numpy.typing import NDArray

from engdyn.analysis.characteristic import characteristic_polynomial
from engdyn.analysis.linear import linearize
from engdyn.analysis.routh import RouthTable, routh_table
from engdyn.analysis.routh_html import _marked, _sign_text, superscripts
from engdyn.plots.look import COLORS, PALETTE
from engdyn.plots.stability_plots import AREAS, _half_planes
from engdyn.system import System
from engdyn.systems.library import load
from engdyn.widgets.controls import Choice, Control, Slider
from engdyn.widgets.explorer import Explorer

__all__ = ["RouthExplorer", "polynomial", "routh"]

State = Mapping[str, Any]

LONGEST = 24
"""Letters of an entry that still can be read in its cell."""


@dataclass(frozen=True)
class Family:
    """Polynomials that sliders move: name, sliders, coefficients from the highest power down, and these as code."""

    label: str
    sliders: tuple[Slider, ...]
    coefficients: Callable[[State], Sequence[Any]]
    code: Callable[[State], Sequence[str]]


def _plain(degree: int, values: Sequence[float], reach: float) -> Family:
    names = [f"a{k}" for k in range(1, degree + 1)]
    sliders = (
        Slider(name, -reach, reach, value, "-", f"coefficient of s to the {degree - k}", 0.1)
        for k, (name, value) in enumerate(zip(names, values, strict=True), start=1)
    )

    def coefficients(state: State) -> list[float]:
        return [1.0, *(round(state[name], 9) for name in names)]  # a slider stops beside zero, not at it

    def code(state: State) -> list[str]:
        return [f"coefficients = [{', '.join(f'{c:.10g}' for c in coefficients(state))}]"]

    terms = [f"s**{degree}", *(f"a{k} s**{degree - k}" for k in range(1, degree)), f"a{degree}"]
    return Family(superscripts(" + ".join(terms)).replace("¹", ""), tuple(sliders), coefficients, code)


BAR = (
    Slider("k", 0.0, 1000.0, 400.0, "N/m", "slider spring", 10.0),
    Slider("c", -4.0, 10.0, 4.0, "N s/m", "slider damping", 0.25),
    Slider("g", -10.0, 10.0, 9.75, "m/s^2", "gravity; negative: the bar stands on its head", 0.25),
)


@cache
def _bar() -> System:
    return load("W7")


def _bar_coefficients(state: State) -> Sequence[Any]:
    bar = _bar()
    values = {**bar.values(), **{control.name: state[control.name] for control in BAR}}
    return characteristic_polynomial(linearize(bar.equations, {"theta": 0}, values))


def _bar_code(state: State) -> list[str]:
    values = ", ".join(f'"{c.name}": {state[c.name]:.10g}' for c in BAR)
    return [
        'bar = ed.systems.load("W7")',
        f"values = {{**bar.values(), {values}}}",
        'linear = ed.linearize(bar.equations, {"theta": 0}, values)',
        "coefficients = ed.characteristic_polynomial(linear)",
    ]


FAMILIES = {
    "cubic": _plain(3, (2.0, 3.0, 4.0), 8.0),
    "quartic": _plain(4, (2.0, 6.0, 4.0, 3.0), 10.0),
    "quintic": _plain(5, (3.0, 8.0, 9.0, 6.0, 1.0), 10.0),
    "bar": Family("bar on the slider, θ = 0 (W7)", BAR, _bar_coefficients, _bar_code),
}


def polynomial(family: str, state: State) -> tuple[RouthTable, NDArray[np.complex128]]:
    """Return the table and, by another route, the roots [1/s] of a polynomial."""
    coefficients = FAMILIES[family].coefficients(state)
    return routh_table(coefficients), np.roots([float(c) for c in coefficients])


class RouthExplorer(Explorer):
    """See `routh`."""

    title = "Routh's table"
    structural = ("polynomial",)

    def controls(self, chosen: State) -> Sequence[Control]:
        options = tuple((family.label, name) for name, family in FAMILIES.items())
        choice = Choice("polynomial", options, "quartic", "polynomial whose roots are judged")
        return [choice, *FAMILIES[chosen["polynomial"]].sliders] if "polynomial" in chosen else [choice]

    def model(self, state: State) -> tuple[RouthTable, NDArray[np.complex128]]:
        return polynomial(state["polynomial"], state)

    def static_key(self, state: State, result: Any) -> Hashable:
        """The scale of the plane: the next of 1, 2, 5, 10, …"""
        largest = max(1.0, 1.02 * float(np.max(np.abs(result[1]))))
        power = 10.0 ** math.floor(math.log10(largest))
        return next(power * k for k in (1.0, 2.0, 5.0, 10.0) if power * k >= largest)

    def draw_static(self, figure: Figure, state: State, result: Any) -> None:
        table, plane = figure.add_axes((0.01, 0.02, 0.60, 0.96)), figure.add_axes((0.73, 0.17, 0.25, 0.70))
        table.set_axis_off()
        reach = float(self.static_key(state, result))
        _half_planes(plane, [-reach, reach])
        plane.set(ylim=(-1.08 * reach, 1.08 * reach), title="roots")

    def draw_moving(self, figure: Figure, state: State, result: Any) -> Iterable[Artist]:
        (ax, plane), (table, roots) = figure.axes, result
        right = roots.real > 1e-6 * self.static_key(
            state, result
        )  # what rounding leaves on the axis is no growth
        for side, color in ((~right, PALETTE[0]), (right, PALETTE[1])):
            plane.plot(roots[side].real, roots[side].imag, "o", color=color, clip_on=False)
        _cells(ax, table)
        drawn = [*ax.patches, *ax.texts, *plane.lines[2:]]
        for artist in drawn:
            artist.set_animated(True)
        return drawn

    def caption(self, state: State) -> str:
        return FAMILIES[state["polynomial"]].label

    def words(self, state: State, result: Any) -> str:
        table, _ = result
        column = ", ".join(_entry(x, _sign_text(x)) for x in table.first_column)
        changes = f"{table.sign_changes} sign change{'s' * (table.sign_changes != 1)}"
        first, *more = table.special.split(" The row of ")
        rest = f" So do {len(more)} more rows." if more else ""
        return f"{table.verdict}; first column {column}: {changes}. {first}{rest}".strip()

    def lines(self, state: State) -> list[str]:
        code = FAMILIES[state["polynomial"]].code(state)
        return [
            "import numpy as np",
            *code,
            "roots = np.roots(np.array(coefficients, float))",
            "table = ed.routh_table(coefficients)",
            "table",
        ]


def _entry(entry: Any, sign: str) -> str:
    """Return an entry in plain letters; of a long quotient in ε only the sign."""
    text = _marked(entry)
    return text if len(text) <= LONGEST else {"+": "> 0, ε → 0", "−": "< 0, ε → 0", "": "…"}[sign]


def _cells(ax: Axes, table: RouthTable) -> None:
    """Write the table, the first column filled by its signs, other rows than plain ones in yellow."""
    n, width = len(table.rows), len(table.rows[0])
    height, across = min(0.14, 0.86 / n), 0.62 / width
    signs = [_sign_text(row[0]) for row in table.rows]
    for i, (row, mark) in enumerate(zip(table.rows, table.marks, strict=True)):
        y, room = 0.90 - (i + 1) * height, (n - 1 - i) // 2 + 1
        ax.text(0.05, y + height / 2, superscripts(f"s**{n - 1 - i}"), ha="center", va="center", fontsize=15)
        for k, entry in enumerate(row[:room]):
            verdict = "asymptotically stable" if signs[i] == "+" else "unstable (divergence)"
            fill = AREAS[verdict][0] if k == 0 else "#f7e7b6" if mark else "white"
            corner = (0.10 + k * across, y)
            ax.add_patch(Rectangle(corner, across, height, facecolor=fill, edgecolor="#6b7077"))
            text = _entry(entry, signs[i] if k == 0 else "")
            size = next(
                points for most, points in ((9, 14.0), (13, 11.0), (LONGEST, 8.0)) if len(text) <= most
            )
            ax.text(corner[0] + across / 2, y + height / 2, text, ha="center", va="center", fontsize=size)
        note = {"epsilon": "ε for 0", "auxiliary": "derivative"}.get(mark, "")
        ax.text(0.80, y + height / 2, f"{signs[i]}   {note}", va="center", fontsize=13, color=COLORS["body"])
    for i, (above, below) in enumerate(pairwise(signs), start=1):
        if above != below:
            ax.text(
                0.74, 0.90 - i * height, "change ⇅", va="center", ha="left", fontsize=12, color=PALETTE[1]
            )
    verdict = table.verdict[0].upper() + table.verdict[1:]
    ax.text(0.10, 0.95, verdict, va="center", fontsize=14, fontweight="bold", color=COLORS["body"])


def routh(polynomial: str = "quartic", **values: float) -> RouthExplorer:
    """Explore Routh's criterion: the table of a polynomial, colored by the signs of its first column, and the roots.

    Course section 5.4. Controls: ``polynomial`` and its coefficients ``a1``, ``a2``, …, or the parameters of the
    bar on the slider.

    Parameters
    ----------
    polynomial : {"cubic", "quartic", "quintic", "bar"}
    **values : float
        Where the sliders stand at first.

    Returns
    -------
    RouthExplorer

    Raises
    ------
    EngdynError
        An unknown polynomial, a value that its slider does not reach.
    """
    return RouthExplorer(polynomial=polynomial, **values)
