"""Pictures of what sampling and windows do: folding, leakage, windows; and of spectra over time.  Chapter 9."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes

from engdyn.errors import EngdynError
from engdyn.plots.alternative import describe
from engdyn.plots.look import COLORS, FILL, PALETTE, new_axes, new_figure, style
from engdyn.plots.response_plots import DASHES, _label
from engdyn.plots.words import number

if TYPE_CHECKING:
    from engdyn.experiment.averaging import Spectrogram
    from engdyn.record import Record
    from engdyn.spectrum import Spectrum

__all__ = ["folding", "leakage", "spectrogram", "window"]

ROUNDING = 1e-12
"""Lines below this share of the largest are nothing but rounding, for which no axis has room."""

MARKERS = ("o", "s", "^", "D", "v", "P", "X")


def folding(rate: float, frequencies: Sequence[float] = (), ax: Axes | None = None) -> Axes:
    """Plot at which frequency a sine appears after sampling, over its own frequency.

    Course section 9.7, Figure 9.6.

    Parameters
    ----------
    rate : float
        Samples per second.
    frequencies : sequence of float
        Some to mark [Hz].
    ax : matplotlib.axes.Axes, optional
        Where to draw; default: new axes.

    Returns
    -------
    matplotlib.axes.Axes
    """
    from engdyn.experiment.spectra import alias_frequency

    marked = np.asarray(frequencies, dtype=float)
    seen = alias_frequency(marked, rate)
    folds = np.arange(0, int(np.ceil(2 * max([*marked, 1.5 * rate]) / rate)) + 1) * rate / 2
    ax = new_axes(7.6, 3.8) if ax is None else ax
    with style():
        ax.axvspan(0.0, rate / 2, color=FILL["body"], alpha=0.6, label="band of the record", zorder=0)
        ax.plot(folds, alias_frequency(folds, rate), color=PALETTE[0])
        for a in np.unique(seen):  # one line for all that meet there
            far = marked[seen == a].max()
            ax.plot([0.0, far], [a, a], color=COLORS["reference"], linestyle="--", linewidth=1.3)
        for i, (f, a) in enumerate(zip(marked, seen, strict=True)):
            look = {"color": PALETTE[1 + i % 6], "linestyle": "--", "linewidth": 1.3}
            ax.plot([f, f], [0.0, a], **look)
            text = f"{number(f)} Hz appears at {number(a)} Hz"
            ax.plot([f], [a], MARKERS[i % 7], color=look["color"], label=text, zorder=5)
        ax.set_xlim(0.0, folds[-1])
        ax.set_ylim(0.0, 0.62 * rate)
        ax.set_xticks(folds, [f"{number(f)}\n{_of_rate(i)}" for i, f in enumerate(folds)])
        ax.set_xlabel("frequency before sampling [Hz]")
        ax.set_ylabel("frequency after\nsampling [Hz]")
        ax.legend(loc="upper left", bbox_to_anchor=(1.0, 1.03))
    told = "; ".join(f"{number(f)} Hz appears at {number(a)} Hz" for f, a in zip(marked, seen, strict=True))
    words = f"up to {number(rate / 2)} Hz and falls back to 0 at {number(rate)} Hz, again and again"
    describe(
        ax,
        f"Folding at {number(rate)} samples per second: the frequency seen rises {words}. {told or 'None marked'}.",
    )
    return ax


def _of_rate(half: int) -> str:
    """Half multiples of the rate as text."""
    if half == 0:
        return ""
    whole = f"{half // 2 if half > 2 else ''}$f_s$"
    return whole if half % 2 == 0 else f"{half if half > 1 else ''}$f_s$/2"


def leakage(
    record: Record,
    windows: Sequence[str] = ("boxcar",),
    ax: Axes | None = None,
    *,
    band: tuple[float, float] | None = None,
    logarithmic: bool = False,
) -> Axes:
    """Plot the amplitudes of the lines of a record, and between them the curve on which they lie.

    Course section 9.8, Figures 9.8, 9.9 and 9.14.

    Parameters
    ----------
    record : Record
        One channel.
    windows : sequence of str
        One set of lines for each, amplitudes corrected.
    ax : matplotlib.axes.Axes, optional
        Where to draw; default: new axes.
    band : (float, float), optional
        Frequencies shown [Hz].
    logarithmic : bool
        Whether amplitudes have a logarithmic axis, to see far leakage; without the curve.

    Returns
    -------
    matplotlib.axes.Axes

    Raises
    ------
    EngdynError
        Several channels, unknown windows, an empty band.
    """
    chosen = (windows,) if isinstance(windows, str) else tuple(windows)
    low, high = band or (0.0, record.rate / 2)
    if not low < high:
        raise EngdynError(f"band is {band!r}: give two frequencies in Hz, the lower one first")
    ax = new_axes(7.6, 4.2) if ax is None else ax
    told = []
    with style():
        sets = [_lines(ax, record, name, i, not logarithmic) for i, name in enumerate(chosen)]
        for name, lines in zip(chosen, sets, strict=True):
            top = lines.values.argmax()
            told.append(
                f"{name}: largest line {number(lines.values[top])} at {number(lines.frequency[top])} Hz"
            )
        if logarithmic:
            ax.set_yscale("log")
            shown = [s.values[(low <= s.frequency) & (s.frequency <= high)] for s in sets]
            seen = [x[x > ROUNDING * s.values.max()] for x, s in zip(shown, sets, strict=True)]
            ax.set_ylim(bottom=0.5 * np.concatenate(seen).min(initial=1.0))
        else:
            ax.set_ylim(bottom=0.0)
        ax.set_xlim(low, high)
        ax.set_xlabel("frequency [Hz]")
        ax.set_ylabel(_label("amplitude", record.units[0]))
        ax.legend(loc="best", frameon=True)
    curve = "" if logarithmic else " and the curve between them"
    describe(ax, f"Lines {number(1 / record.duration)} Hz apart{curve}. {'; '.join(told)}.")
    return ax


def _lines(ax: Axes, record: Record, name: str, i: int, curve: bool) -> Spectrum:
    from engdyn.experiment.spectra import amplitude_spectrum

    lines, color = amplitude_spectrum(record, name), PALETTE[i % 7]
    look = {"color": color, "markerfacecolor": color if i == 0 else "white", "markersize": 7.0}
    ax.plot(lines.frequency, lines.values, MARKERS[i % 7], label=name, **look)
    if curve:  # on a logarithmic axis it would be hidden by its own zeros
        fine = amplitude_spectrum(record, name, interpolation=16)
        ax.plot(fine.frequency, fine.values, color=color, linewidth=1.0, linestyle=DASHES[i % 4])
        ax.vlines(lines.frequency, 0.0, lines.values, color=color, linewidth=1.6)
    return lines


def window(names: str | Sequence[str], N: int = 64, axes: Sequence[Axes] | None = None) -> Axes:
    """Plot windows over the samples, and what they make of a sine: their main lobe and side lobes.

    Course section 9.8, Figure 9.11.

    Parameters
    ----------
    names : str or sequence of str
        See ``engdyn.window``.
    N : int
        Number of samples.
    axes : two matplotlib.axes.Axes, optional
        For time and frequency; default: a new figure with one above the other.

    Returns
    -------
    matplotlib.axes.Axes
        That of the samples; ``ax.figure.axes`` holds both.

    Raises
    ------
    EngdynError
        Unknown names; another number of axes than two.
    """
    from engdyn.experiment import windows

    chosen = (names,) if isinstance(names, str) else tuple(names)
    if axes is not None and len(axes) != 2:
        raise EngdynError("plots.window needs two axes, for time and frequency")
    told = []
    with style():
        upper, lower = axes or new_figure(8.0, 6.0).subplots(2, 1)
        for i, name in enumerate(chosen):
            w = windows.window(name, N)
            look = {"color": PALETTE[i % 7], "linestyle": DASHES[i % 4]}
            size = np.abs(np.fft.rfft(w, 64 * N)) / np.sum(w)
            width = windows.equivalent_noise_bandwidth(w)
            upper.plot(np.arange(N), w, label=f"{name}: {number(width)}", **look)
            lower.plot(
                np.arange(len(size)) / 64, 20 * np.log10(np.maximum(size, 1e-9)), **{**look, "linewidth": 1.6}
            )
            told.append(
                f"{name}: equivalent noise bandwidth {number(width)} lines, half a line off {_scallop(size)} dB"
            )
        upper.set_xlabel("sample [1]")
        upper.set_ylabel("window [1]")
        upper.set_xlim(0, N)
        upper.legend(title="noise bandwidth", loc="upper left", bbox_to_anchor=(1.0, 1.05))
        lower.set_xlim(0, min(12, N / 2))
        lower.set_ylim(-120, 5)
        lower.set_xlabel("distance from the frequency of a sine [lines]")
        lower.set_ylabel("amplitude [dB]")
    describe(
        upper, f"Windows of {N} samples, and below what is left of a sine at a distance. {'; '.join(told)}."
    )
    return upper


def _scallop(size: np.ndarray) -> str:
    return number(round(float(20 * np.log10(size[32])), 2))


def spectrogram(spectrogram: Spectrogram, ax: Axes | None = None, *, decibels: float = 60.0) -> Axes:
    """Plot densities over time and frequency, as colors.

    Course section 9.10.

    Parameters
    ----------
    spectrogram : Spectrogram
    ax : matplotlib.axes.Axes, optional
        Where to draw; default: new axes.
    decibels : float
        Range of the colors below the largest density.

    Returns
    -------
    matplotlib.axes.Axes
    """
    s = spectrogram
    top = float(s.values.max())
    if not top > 0:
        raise EngdynError("there is nothing in this spectrogram: all densities are zero")
    levels = 10 * np.log10(np.maximum(s.values / top, 10 ** (-decibels / 10)))
    ax = new_axes(7.6, 4.2) if ax is None else ax
    with style():
        colors = ax.pcolormesh(
            s.time, s.frequency, levels, cmap="cividis", vmin=-decibels, vmax=0.0, rasterized=True
        )
        ax.grid(visible=False)
        ax.set_xlabel("time [s]")
        ax.set_ylabel("frequency [Hz]")
        bar = ax.figure.colorbar(colors, ax=ax)
        bar.set_label(f"density [dB]\n0 dB = {number(top)} {_label('', s.unit)[2:-1]}")
    ridge = s.frequency[s.values.argmax(axis=0)]
    at = [0, len(ridge) // 2, len(ridge) - 1]
    told = ", ".join(f"{number(ridge[i])} Hz at {number(s.time[i])} s" for i in at)
    describe(ax, f"Spectrogram of {s.name}; the largest density is at {told}.")
    return ax
