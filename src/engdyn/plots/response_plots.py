"""Pictures over frequency: amplitude and phase, spectra, cumulative mean square.  Chapters 7 and 9."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.ticker import FuncFormatter, LogLocator, MultipleLocator, NullFormatter

from engdyn.errors import EngdynError
from engdyn.plots.alternative import describe
from engdyn.plots.look import COLORS, PALETTE, new_axes, new_figure, style
from engdyn.plots.words import number, with_unit
from engdyn.spectrum import cumulative_mean_square as cumulated

if TYPE_CHECKING:
    from engdyn.analysis.response import FrequencyResponse
    from engdyn.spectrum import Spectrum

__all__ = ["cumulative_mean_square", "frequency_response", "spectrum"]

DASHES = ("-", "--", "-.", ":")
"""Tell curves apart without color."""

STEPS = (15.0, 30.0, 90.0, 180.0, 360.0, 720.0)
"""Between ticks of the phase, in degrees."""

WIDE = 40.0
"""Frequencies that span more than this factor stand on a logarithmic axis."""


def frequency_response(
    response: FrequencyResponse | Sequence[FrequencyResponse],
    axes: Sequence[Axes] | None = None,
    *,
    labels: Sequence[str] | None = None,
) -> Axes:
    """Plot amplitude and phase of one or several frequency responses over frequency.

    Course sections 7.1 and 7.2, Figures 7.2 to 7.5.

    Parameters
    ----------
    response : FrequencyResponse, or sequence of them
        Each of one input and one output.
    axes : two matplotlib.axes.Axes, optional
        For amplitude and phase; default: a new figure with one above the other.
    labels : sequence of str, optional
        Names in the legend; default: what is plotted per what.

    Returns
    -------
    matplotlib.axes.Axes
        That of the amplitude; ``ax.figure.axes`` holds both. Peaks are marked; the phase is that of the response,
        unwrapped by rule, in degrees.

    Raises
    ------
    EngdynError
        Responses of several inputs or outputs; another number of labels or axes.
    """
    chosen = list(response) if isinstance(response, Sequence) else [response]
    names = _names(labels, [f"{r.output} per {r.input}" for r in chosen])
    if any(r.response.ndim != 1 for r in chosen):
        raise EngdynError("frequency_response: plot responses of one input and one output each")
    if axes is not None and len(axes) != 2:
        raise EngdynError("frequency_response needs two axes, for amplitude and phase")
    with style():
        upper, lower = axes or new_figure(7.0, 6.2).subplots(2, 1, sharex=True, height_ratios=(3, 2))
        for i, (r, name) in enumerate(zip(chosen, names, strict=True)):
            look = _look(i)
            upper.plot(r.frequency, np.where(r.amplitude > 0, r.amplitude, np.nan), label=name, **look)
            lower.plot(r.frequency, np.degrees(r.phase), **look)
            upper.plot(*_peaks(r), linestyle="", marker="o", markersize=6.0, color=look["color"])
        upper.set_yscale("log")
        upper.set_ylabel(_label("amplitude", chosen[0].unit))
        lower.set_ylabel("phase [°]")
        span = np.ptp(lower.get_ylim())
        lower.yaxis.set_major_locator(MultipleLocator(next((d for d in STEPS if span < 5 * d), STEPS[-1])))
        _frequency_axis(lower, [r.frequency for r in chosen])
        _frequency_axis(upper, [r.frequency for r in chosen])
        if axes is None:
            upper.set_xlabel("")
        upper.legend(loc="best", frameon=True)
    told = "; ".join(_response_in_words(r, name) for r, name in zip(chosen, names, strict=True))
    describe(upper, f"Amplitude over frequency, logarithmic, with the phase below. {told}.")
    phases = (
        f"{name} from {_degrees(r.phase[0])} to {_degrees(r.phase[-1])}"
        for r, name in zip(chosen, names, strict=True)
    )
    describe(lower, f"Phase over frequency: {'; '.join(phases)}.")
    return upper


def spectrum(
    spectra: Spectrum | Sequence[Spectrum], ax: Axes | None = None, *, labels: Sequence[str] | None = None
) -> Axes:
    """Plot power spectral densities, on a logarithmic axis, or amplitudes of lines as stems.

    Course section 7.3, Figures 7.8 and 7.12.

    Parameters
    ----------
    spectra : Spectrum, or sequence of them in one unit
    ax : matplotlib.axes.Axes, optional
        Where to draw; default: new axes.
    labels : sequence of str, optional
        Names in the legend.

    Returns
    -------
    matplotlib.axes.Axes

    Raises
    ------
    EngdynError
        Several units or kinds in one picture.
    """
    chosen, names = _spectra(spectra, labels)
    density = chosen[0].per is not None
    ax = new_axes() if ax is None else ax
    with style():
        for i, (s, name) in enumerate(zip(chosen, names, strict=True)):
            if density:
                ax.plot(s.frequency, np.where(s.values > 0, s.values, np.nan), label=name, **_look(i))
            else:
                ax.vlines(s.frequency, 0.0, s.values, color=PALETTE[i % 7], label=name, linewidth=1.6)
        if density:
            ax.set_yscale("log")
        else:
            ax.set_ylim(bottom=0.0)
        sides = "one-sided" if chosen[0].one_sided else "two-sided"
        ax.set_ylabel(_label(f"density, {sides}" if density else "amplitude", chosen[0].unit))
        _finish(ax, chosen, labels)
    told = "; ".join(
        f"{name}: largest {number(s.values.max())} {s.unit} at {number(s.frequency[s.values.argmax()])} Hz"
        for s, name in zip(chosen, names, strict=True)
    )
    kind = f"Power spectral density, {sides}" if density else "Amplitudes of lines"
    describe(ax, f"{kind}, over frequency. {told}.")
    return ax


def cumulative_mean_square(
    spectra: Spectrum | Sequence[Spectrum], ax: Axes | None = None, *, labels: Sequence[str] | None = None
) -> Axes:
    """Plot how the mean square grows with frequency: steps show where vibration comes from.

    Course section 7.3, Figures 7.10 and 7.11.

    Parameters
    ----------
    spectra : Spectrum, or sequence of them in one unit
        Densities.
    ax : matplotlib.axes.Axes, optional
        Where to draw; default: new axes.
    labels : sequence of str, optional
        Names in the legend.

    Returns
    -------
    matplotlib.axes.Axes

    Raises
    ------
    EngdynError
        Amplitudes instead of densities; several units in one picture.
    """
    chosen, names = _spectra(spectra, labels)
    sums = [cumulated(s) for s in chosen]
    unit = chosen[0].unit.removesuffix(f"/{chosen[0].per}")
    ax = new_axes() if ax is None else ax
    with style():
        for i, (s, total, name) in enumerate(zip(chosen, sums, names, strict=True)):
            ax.plot(s.frequency, total, label=name, **_look(i))
            ax.axhline(total[-1], color=COLORS["reference"], linewidth=1.0, linestyle=(0, (2, 3)))
        ax.set_ylim(0.0, 1.08 * max(total[-1] for total in sums) or 1.0)
        ax.ticklabel_format(axis="y", scilimits=(-3, 4), useMathText=True)
        ax.set_ylabel(_label("cumulative mean square", unit))
        _finish(ax, chosen, labels)
    told = "; ".join(
        f"{name}: {number(total[-1])} {unit} in all, half of it below {number(_half(s.frequency, total))} Hz"
        for s, total, name in zip(chosen, sums, names, strict=True)
    )
    describe(ax, f"Mean square of what lies below each frequency. {told}.")
    return ax


def _half(frequency: np.ndarray, total: np.ndarray) -> float:
    return float(np.interp(total[-1] / 2, total, frequency))


def _label(what: str, unit: str) -> str:
    """An axis label with its unit, where there is one, exponents raised."""
    return (
        with_unit(what, re.sub(r"\^([2-9])", lambda found: "²³⁴⁵⁶⁷⁸⁹"[int(found[1]) - 2], unit))
        if unit
        else what
    )


def _look(i: int) -> dict[str, Any]:
    return {"color": PALETTE[i % 7], "linestyle": DASHES[i % 4]}


def _names(labels: Sequence[str] | None, default: Sequence[str]) -> list[str]:
    if labels is None:
        return list(default)
    if isinstance(labels, str) or len(labels) != len(default):
        raise EngdynError(f"labels is {labels!r}: give {len(default)} names, one for each curve")
    return list(labels)


def _spectra(spectra: Any, labels: Sequence[str] | None) -> tuple[list[Spectrum], list[str]]:
    chosen = list(spectra) if isinstance(spectra, Sequence) else [spectra]
    if len({(s.unit, s.one_sided) for s in chosen}) != 1:
        told = ", ".join(repr(s) for s in chosen)
        raise EngdynError(f"{told}: one picture has one unit and one kind of density; convert them first")
    return chosen, _names(
        labels, [f"spectrum {i + 1}" if len(chosen) > 1 else "spectrum" for i in range(len(chosen))]
    )


def _finish(ax: Axes, chosen: Sequence[Spectrum], labels: Sequence[str] | None) -> None:
    _frequency_axis(ax, [s.frequency for s in chosen])
    if labels is not None or len(chosen) > 1:
        ax.legend(loc="best", frameon=True)


def _frequency_axis(ax: Axes, frequencies: Sequence[np.ndarray]) -> None:
    low, high = min(f[0] for f in frequencies), max(f[-1] for f in frequencies)
    if low > 0 and high / low > WIDE:
        ax.set_xscale("log")
        ax.xaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0) if high / low < 3e3 else (1.0,)))
        ax.xaxis.set_major_formatter(FuncFormatter(lambda f, _: number(f)))
        ax.xaxis.set_minor_formatter(NullFormatter())
    if high > low:
        ax.set_xlim(low, high)
    ax.set_xlabel("frequency [Hz]")


def _peaks(response: FrequencyResponse) -> tuple[np.ndarray, np.ndarray]:
    """Where local maxima of the curve as drawn are."""
    size = response.amplitude
    top = np.flatnonzero((size[1:-1] > size[:-2]) & (size[1:-1] >= size[2:])) + 1
    return response.frequency[top], size[top]


def _response_in_words(response: FrequencyResponse, name: str) -> str:
    unit = f" {response.unit}" if response.unit not in ("", "-") else ""
    peaks = ", ".join(f"{number(a)}{unit} at {number(f)} Hz" for f, a in zip(*_peaks(response), strict=True))
    low, high = response.frequency[[0, -1]]
    ends = f"{name}, {number(low)} to {number(high)} Hz"
    return f"{ends}: {f'peaks {peaks}' if peaks else f'no peak, largest {number(response.amplitude.max())}{unit}'}"


def _degrees(phase: float) -> str:
    return f"{number(round(float(np.degrees(phase)), 1))}°"
