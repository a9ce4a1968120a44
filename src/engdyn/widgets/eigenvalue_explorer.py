"""Explorer of eigenvalues: where a pair lies in the plane, and the response that belongs to it (section 5.1)."""

from __future__ import annotations

import math
from collections.abc import Hashable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib.artist import Artist
from matplotlib.figure import Figure
from numpy.typing import NDArray

from engdyn.analysis.stability import verdict_of
from engdyn.plots.look import COLORS, PALETTE
from engdyn.plots.stability_plots import _half_planes
from engdyn.plots.words import number, plain_verdict
from engdyn.widgets.controls import Control, Slider
from engdyn.widgets.explorer import Explorer

__all__ = ["EigenvalueExplorer", "Response", "eigenvalue_plane", "respond"]

UNTIL, WINDOW = 10.0, 3.0
"""End of the response [s]; and how many times the first deviation the picture is high, either way."""


@dataclass(frozen=True)
class Response:
    """Eigenvalues [1/s], one real or a conjugate pair, the response x/x₀ over the time [s], and the verdict."""

    eigenvalues: NDArray[np.complex128]
    time: NDArray[np.float64]
    deviation: NDArray[np.float64]
    verdict: str


def respond(real: float, imaginary: float) -> Response:
    """Return the response Re exp(λt) to the eigenvalue λ = real + i imaginary [1/s]."""
    root = complex(real, imaginary)
    roots = np.array([root, root.conjugate()] if imaginary else [root])
    time = np.linspace(0.0, UNTIL, 1001)
    return Response(roots, time, np.exp(root * time).real, verdict_of(roots))


class EigenvalueExplorer(Explorer):
    """See `eigenvalue_plane`."""

    title = "Eigenvalue and response"

    def controls(self, chosen: Mapping[str, Any]) -> Sequence[Control]:
        return [
            Slider("real", -2.0, 2.0, -0.3, "1/s", "real part of the eigenvalue", 0.05),
            Slider("imaginary", 0.0, 12.0, 4.0, "rad/s", "imaginary part of the eigenvalue", 0.1),
        ]

    def model(self, state: Mapping[str, Any]) -> Response:
        return respond(state["real"], state["imaginary"])

    def static_key(self, state: Mapping[str, Any], result: Response) -> Hashable:
        return "axes"

    def draw_static(self, figure: Figure, state: Mapping[str, Any], result: Response) -> None:
        plane = figure.add_axes((0.08, 0.16, 0.36, 0.78))
        _half_planes(plane, [-2.0, 2.0])
        plane.set_ylim(-13.0, 13.0)
        right = figure.add_axes((0.55, 0.16, 0.42, 0.78))
        right.set(xlim=(0.0, UNTIL), ylim=(-WINDOW, WINDOW))
        right.set(xlabel="time [s]", ylabel="deviation / first deviation [1]")
        right.axhline(0.0, color=COLORS["reference"], linewidth=1.0)

    def draw_moving(self, figure: Figure, state: Mapping[str, Any], result: Response) -> Iterable[Artist]:
        plane, right = figure.axes
        color = PALETTE[1] if state["real"] > 0 else PALETTE[0]
        look = {"color": color, "animated": True, "clip_on": True}
        lines = plane.plot(result.eigenvalues.real, result.eigenvalues.imag, "o", markersize=12.0, **look)
        if state["imaginary"]:
            envelope = np.exp(state["real"] * result.time)
            dashes = {"color": COLORS["reference"], "linewidth": 1.2, "linestyle": "--", "animated": True}
            lines += [right.plot(result.time, sign * envelope, **dashes)[0] for sign in (1.0, -1.0)]
        return [*lines, *right.plot(result.time, result.deviation, **look)]

    def words(self, state: Mapping[str, Any], result: Response) -> str:
        real, imaginary = state["real"], state["imaginary"]
        where = f"λ = {number(real)}" + (f" ± {number(imaginary)}i" if imaginary else "") + " 1/s"
        told = [f"{where}: {plain_verdict(result.verdict)}"]
        if imaginary:
            ratio = -real / math.hypot(real, imaginary)
            told.append(f"one swing takes {number(2 * math.pi / imaginary)} s, damping ratio {number(ratio)}")
        if real:
            what = "doubles" if real > 0 else "halves"
            told.append(
                f"the {'amplitude' if imaginary else 'deviation'} {what} in {number(math.log(2) / abs(real))} s"
            )
        elif not imaginary:
            told.append("a deviation stays")
        return "; ".join(told) + "."

    def lines(self, state: Mapping[str, Any]) -> list[str]:
        return [
            "import numpy as np",
            f"root = complex({state['real']:.10g}, {state['imaginary']:.10g})",
            f"time = np.linspace(0, {UNTIL:g}, 1001)",
            "response = np.exp(root * time).real",
            'ax = ed.plots.curves({"x": (time, response)}, "time [s]", "x / first x [1]", f"Response to {root}.")',
            f"ax.set_ylim({-WINDOW:g}, {WINDOW:g})",
            "ed.plots.show(ax)",
        ]


def eigenvalue_plane(**values: float) -> EigenvalueExplorer:
    """Explore how a disturbance grows or decays: an eigenvalue in the complex plane and its response.

    Course section 5.1. Controls: ``real`` [1/s] and ``imaginary`` [rad/s].

    Parameters
    ----------
    **values : float
        Where the sliders stand at first.

    Returns
    -------
    EigenvalueExplorer

    Raises
    ------
    EngdynError
        A value that its slider does not reach.
    """
    return EigenvalueExplorer(**values)
