"""The sequence of Part III on a measured file, as one HTML file and a table of numbers: ``engdyn spectrum FILE``.

Course chapter 9: look first, average, density, mean square, peaks with their damping.
"""

from __future__ import annotations

import csv
import html
import io
import math
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from engdyn.course.report_page import checked_target, page, write_text
from engdyn.course.report_pictures import figure
from engdyn.course.report_tables import number, paragraph, table, unit
from engdyn.experiment.averaging import AveragedSpectrum, averaged_spectrum
from engdyn.experiment.peaks import peaks
from engdyn.experiment.reading import read_record
from engdyn.plots.record_plot import record as record_picture
from engdyn.plots.response_plots import cumulative_mean_square as mean_square_picture
from engdyn.plots.response_plots import spectrum as spectrum_picture
from engdyn.record import Record
from engdyn.spectrum import cumulative_mean_square

__all__ = ["default_segment", "write_spectrum_report"]

AVERAGES = 16
"""Segments that half of them overlapping should give, where the record is long enough."""

SHORTEST = 64
"""Samples of a segment, at least."""

MOST = 8
"""Channels that are shown."""


def write_spectrum_report(
    path: str | Path,
    out: str | Path | None = None,
    *,
    channel: str | int | None = None,
    rate: float | None = None,
    unit: str | None = None,
    resample: float | None = None,
    window: str = "hann",
    segment: int | None = None,
    overlap: float = 0.5,
    force: bool = False,
    progress: Callable[[str], Any] | None = None,
) -> tuple[Path, Path]:
    """Take a measured file through the sequence of chapter 9.

    Parameters
    ----------
    path : str or Path
        The file, see :func:`engdyn.read_record`, as for `channel`, `rate` [1/s], `unit` and `resample` [1/s].
    out : str or Path, optional
        The report; default: ``NAME_spectrum.html``, here.
    window, segment, overlap :
        As for :func:`engdyn.averaged_spectrum`; the segment is chosen for 16 averages where not given.
    force : bool
        Replace report and table where they exist.
    progress : callable, optional
        Called with a short message before each step.

    Returns
    -------
    Path, Path
        The report, and beside it the numbers as CSV.

    Raises
    ------
    RecordError
        What is wrong with the file; a segment longer than the record.
    EngdynError
        A file that exists already, a folder that does not.
    """
    tell = progress or (lambda message: None)
    page_file = checked_target(out if out is not None else f"{Path(path).stem}_spectrum.html", force)
    table_file = checked_target(page_file.with_suffix(".csv"), force)
    tell(f"reading {Path(path).name}")
    record = read_record(path, channel, rate, unit, resample)
    names = record.channels[:MOST]
    segment = default_segment(len(record)) if segment is None else segment
    tell(f"averaging {', '.join(names)}")
    spectra = [averaged_spectrum(record[name], window, segment, overlap) for name in names]
    tell("drawing")
    write_text(page_file, _page(path, record, names, spectra, segment))
    write_text(table_file, _numbers(names, record, spectra))
    return page_file, table_file


def _page(
    path: str | Path, record: Record, names: Sequence[str], spectra: Sequence[AveragedSpectrum], segment: int
) -> str:
    parts = [
        ("The record", _record_part(record)),
        ("Averaging", _averaging_part(spectra[0], segment, record)),
    ]
    for name, density in zip(names, spectra, strict=True):
        of = f" of {name}" if len(names) > 1 else ""
        parts += [
            (
                f"Power spectral density{of}",
                figure(spectrum_picture(density), _density_caption(density, name)),
            ),
            (f"Mean square{of}", _mean_square_part(record[name], density)),
            (f"Peaks{of}", _peaks_part(density)),
        ]
    summary = [
        ("samples", f"{len(record)}"),
        ("rate", f"{record.rate:g} 1/s"),
        ("duration", f"{record.duration:.4g} s"),
        ("line spacing", f"{record.rate / segment:.4g} Hz"),
    ]
    title = f"Spectrum of {Path(path).name}"
    label, kind = f"{len(record.channels)} channel{'s' * (len(record.channels) > 1)}", record.metadata["kind"]
    return page(
        parts, title=title, label=label, subtitle=f"{kind} file", summary=summary, command="engdyn spectrum"
    )


def default_segment(samples: int) -> int:
    """Samples of a segment: the power of two that gives 16 averages or more with half of them overlapping.

    Parameters
    ----------
    samples : int
        Of the record. Records too short for that keep segments of 64 samples, or are one segment.
    """
    longest = 2 * samples / (AVERAGES + 1)
    return min(max(2 ** int(math.log2(max(longest, 1.0))), SHORTEST), samples)


def _record_part(record: Record) -> str:
    rows = [
        (
            html.escape(c.name),
            unit(c.unit),
            *(number(x) for x in (c.smallest, c.largest, c.mean, c.standard_deviation, c.drift)),
            html.escape("; ".join(c.remarks) or "none"),
        )
        for c in record.summary().channels
    ]
    head = ("channel", "unit", "smallest", "largest", "mean", "standard deviation", "drift", "remarks")
    text = table("A first look", head, rows, right=range(2, 7))
    if len(record.channels) > MOST:
        text += paragraph(
            f"The first {MOST} of {len(record.channels)} channels follow; name others.", note=True
        )
    return text + "".join(
        figure(record_picture(record[name]), f"{name} over time.") for name in record.channels[:MOST]
    )


def _averaging_part(density: AveragedSpectrum, segment: int, record: Record) -> str:
    spacing, count = record.rate / segment, density.segments
    text = (
        f"{count} segment{'s' * (count > 1)} of {segment} samples ({segment / record.rate:.4g} s each), window "
        f"{density.window}: lines {spacing:.4g} Hz apart up to {record.rate / 2:.5g} Hz. "
    )
    if count == 1:
        text += "A single segment is not averaged: of noise every line scatters by as much as it is large."
    else:
        text += (
            f"Overlapping as they do, they are worth {density.averages:.3g} independent averages, so that each line of "
            f"noise has a standard error of {100 / math.sqrt(density.averages):.0f} %. Longer segments tell apart what "
            "lies closer together and scatter more; shorter ones the reverse."
        )
    return paragraph(text)


def _density_caption(density: AveragedSpectrum, name: str) -> str:
    if density.segments == 1:
        return f"One-sided density of {name}, not averaged."
    low, high = density.confidence_band()
    ratio = float(np.median(high / low))
    return f"One-sided density of {name}; with 95 % probability a line of noise is known to a factor of {ratio:.2g}."


def _mean_square_part(record: Record, density: AveragedSpectrum) -> str:
    total, direct = cumulative_mean_square(density)[-1], float(np.std(record.samples))
    shown = unit(record.units[0])
    text = (
        f"<p>Root mean square about the mean: {number(math.sqrt(total))} {shown} from the density, {number(direct)} "
        f"{shown} from the samples.</p>"
    )
    return text + figure(mean_square_picture(density), "Mean square of what lies below each frequency.")


def _peaks_part(density: AveragedSpectrum) -> str:
    found = peaks(density)
    if not found:
        return paragraph("No peak stands out of the scatter.")
    rows = [
        (
            number(peak.frequency),
            number(peak.level),
            "–"
            if peak.damping_ratio is None
            else f"{100 * peak.damping_ratio:.2g} % ± {100 * (peak.uncertainty or 0):.1g} %",
        )
        for peak in found
    ]
    head = ("frequency [Hz]", f"density [{unit(density.unit)}]", "damping ratio")
    note = (
        "Damping ratios are those of resonances under broad-band excitation that fit the lines around the peak; a dash "
        "stands where fewer than five lines lie within the peak: take longer segments."
    )
    return table("Peaks, the strongest first", head, rows, right=range(3)) + paragraph(note, note=True)


def _numbers(names: Sequence[str], record: Record, spectra: Sequence[AveragedSpectrum]) -> str:
    """Frequency, density and cumulative mean square of each channel, with units in the header."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    head, columns = ["frequency [Hz]"], [spectra[0].frequency]
    for name, density in zip(names, spectra, strict=True):
        square = density.unit.removesuffix(f"/{density.per}")
        head += [f"{name} density [{density.unit}]", f"{name} cumulative mean square [{square}]"]
        columns += [density.values, cumulative_mean_square(density)]
    writer.writerow(head)
    writer.writerows([f"{x:.9g}" for x in row] for row in zip(*columns, strict=True))
    return text.getvalue()
