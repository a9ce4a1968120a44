"""The ``engdyn`` command.

Every subcommand imports what it needs when it runs, so that ``engdyn --help`` answers at once. A bad
argument prints the message of the `EngdynError` and ends with exit code 2.
"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from . import __version__
from .errors import EngdynError

if TYPE_CHECKING:
    from .course.library import CopyReport

app = typer.Typer(
    name="engdyn",
    help="The practice of engineering dynamics, as a course that runs.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
)


def _print_version(wanted: bool) -> None:
    if wanted:
        print(f"engdyn {__version__}")
        raise typer.Exit


@app.callback()
def options(
    version: Annotated[
        bool,
        typer.Option("--version", callback=_print_version, is_eager=True, help="Print the version and stop."),
    ] = False,
) -> None:
    """Options that stand before the subcommand."""


@app.command()
def lab(
    folder: Annotated[
        Path | None,
        typer.Argument(
            metavar="[DIR]",
            help="Your own folder: the course is copied there first, and your work is never overwritten.",
        ),
    ] = None,
    port: Annotated[
        int | None, typer.Option(help="Port to listen on (default: a free one from 8888 up).")
    ] = None,
    no_browser: Annotated[
        bool, typer.Option("--no-browser", help="Print the address, open no browser.")
    ] = False,
) -> None:
    """Open the course in JupyterLab."""
    from .course.launch import open_lab
    from .course.library import CourseFolderError, checkout_folder, copy_course

    if folder is not None:
        _tell(copy_course(folder))
    root = folder or checkout_folder()
    if root is None:
        raise CourseFolderError(
            "name a folder for your copy of the course, for example: engdyn lab my_course"
        )
    raise typer.Exit(open_lab(root, port=port, browser=not no_browser))


def _tell(report: CopyReport) -> None:
    """Say what copying the course did."""
    for count, what in ((len(report.new), "copied"), (len(report.updated), "brought up to date")):
        if count:
            print(f"{count} {'file' if count == 1 else 'files'} {what}")
    for name in report.kept:
        print(f"kept your {name}; rename it and start again to get the new edition beside it")


@app.command()
def systems() -> None:
    """List the mechanical systems of the catalogue."""
    from rich.console import Console
    from rich.table import Table

    from .systems import catalogue

    rows = catalogue().reset_index()
    table = Table(box=None, pad_edge=False)
    for name, values in rows.items():
        table.add_column(str(name), justify="right" if values.dtype.kind == "i" else "left")
    for row in rows.itertuples(index=False):
        table.add_row(*(str(value) for value in row))
    Console().print(table)


@app.command()
def analyze(
    key: Annotated[str, typer.Argument(help="A system: gantry_crane, S07 or 7.")],
    out: Annotated[
        Path | None, typer.Option(help="File to write (default: the system's key with .html).")
    ] = None,
    force: Annotated[bool, typer.Option("--force", help="Replace the file if it is there.")] = False,
) -> None:
    """Take one system through the whole sequence and write an HTML report."""
    from .systems import load

    system = load(key)
    target = out or Path(f"{system.key}.html")
    from .course.report import write_report

    write_report(system.key, target, force=force, progress=_step if sys.stderr.isatty() else None)
    print(f"wrote {target}")


@app.command()
def spectrum(
    file: Annotated[Path, typer.Argument(help="A record: CSV, TSV, WAV, MAT, NPZ, UFF, TDMS ...")],
    channel: Annotated[
        str | None, typer.Option(help="One channel, by name or number (default: all).")
    ] = None,
    rate: Annotated[
        float | None, typer.Option(help="Samples per second, where the file does not say.")
    ] = None,
    unit: Annotated[str | None, typer.Option(help="Unit of the samples, in place of the file's.")] = None,
    resample: Annotated[
        float | None, typer.Option(help="Samples per second to interpolate on, where times are uneven.")
    ] = None,
    window: Annotated[str, typer.Option(help="hann, boxcar, hamming, flattop ...")] = "hann",
    segment: Annotated[int | None, typer.Option(help="Samples of a segment (default: 16 averages).")] = None,
    overlap: Annotated[float, typer.Option(help="Part that neighboring segments share.")] = 0.5,
    out: Annotated[Path | None, typer.Option(help="Report to write (default: NAME_spectrum.html).")] = None,
    force: Annotated[bool, typer.Option("--force", help="Replace the files if they are there.")] = False,
) -> None:
    """Take a measured file through chapter 9: an HTML report, and the numbers as CSV."""
    from .course.spectrum_report import write_spectrum_report

    chosen = int(channel) if channel is not None and channel.isdigit() else channel
    for written in write_spectrum_report(
        file,
        out,
        channel=chosen,
        rate=rate,
        unit=unit,
        resample=resample,
        window=window,
        segment=segment,
        overlap=overlap,
        force=force,
        progress=_step if sys.stderr.isatty() else None,
    ):
        print(f"wrote {written}")


@app.command()
def matrix(
    systems: Annotated[
        list[str] | None, typer.Argument(metavar="[KEY]...", help="Systems; all of the catalogue if none.")
    ] = None,
    only: Annotated[
        list[str] | None, typer.Option(help="An analysis, for example derivation; may be repeated.")
    ] = None,
    json: Annotated[bool, typer.Option("--json", help="Print the result as JSON.")] = False,
    sabotage: Annotated[
        bool, typer.Option("--sabotage", help="Corrupt what each check works on: every check must fail.")
    ] = False,
) -> None:
    """Take all systems through all analyses; every cell is a check that can fail."""
    from json import dumps

    from rich.console import Console

    from .course.matrix import matrix as fill
    from .course.matrix_table import matrix_table, summary

    watch = sys.stderr.isatty()
    found = fill(
        systems or (),
        only or (),
        sabotage,
        (lambda cell: _step(f"{cell.system} {cell.analysis}: {cell.status}")) if watch else None,
    )
    if json:
        print(dumps(found.as_dict(), indent=1, ensure_ascii=False))
    else:
        Console().print(matrix_table(found))
        print("\n".join(summary(found)))
    raise typer.Exit(0 if found.right and not sabotage else 1)


def _step(step: str) -> None:
    """One line of progress, for people who watch."""
    print(f"  {step} ...", file=sys.stderr, flush=True)


def main(arguments: list[str] | None = None) -> int:
    """Run the command; bad input ends with its message and exit code 2, never with a traceback."""
    try:
        app(args=arguments, prog_name="engdyn")
    except EngdynError as error:
        print(f"engdyn: {error}", file=sys.stderr)
        return 2
    except SystemExit as end:
        return end.code if isinstance(end.code, int) else int(end.code is not None)
    return 0


if __name__ == "__main__":
    sys.exit(main())
