"""Columns of numbers in text files: CSV, TSV and what spreadsheets export.  Course section 9.1."""

from __future__ import annotations

import codecs
import csv
import math
import os
import re
from collections import deque
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from io import BytesIO
from itertools import chain, islice, repeat
from pathlib import Path
from typing import IO, Any

import numpy as np

from engdyn.errors import RecordError
from engdyn.experiment.raw import Raw, distinct, name_and_unit
from engdyn.progress import Progress
from engdyn.units import si_factor, to_si

__all__ = ["read_text"]

HEAD = 2**18
"""Bytes at the beginning that show how the file is written."""

TRIED = 3000
"""Lines of these that separators and decimal points are tried on."""

BLOCK, WORKERS = 2**23, 4
"""Bytes that are read at once, and by how many threads at most."""

DIALECTS = [(sep, point) for sep in ("\t", ";", ",", "|", " ") for point in ".,"]
TIMES = re.compile(
    r"t|time|zeit|temps|tiempo|tempo|timestamp|seconds|sec|elapsed.*|(time|zeit).*", re.IGNORECASE
)
COMMENT = "#%"


@dataclass(frozen=True)
class Layout:
    """How a text file is written: separator (a blank: any blanks), decimal point, first row of numbers."""

    path: Path
    encoding: str
    separator: str
    point: str
    columns: int
    first: int
    header: tuple[str, ...]
    bytes_per_line: float
    quoted: bool
    as_text: bool

    def open(self) -> IO[Any]:
        """The file; as text where pieces of its bytes could not be told apart."""
        if self.as_text:
            return self.path.open(encoding=self.encoding, errors="replace")
        return self.path.open("rb")

    def fields(self, line: str) -> list[str]:
        return _fields(line, self.separator)


def read_text(path: Path) -> Raw:
    """All columns of a text file.

    Parameters
    ----------
    path : Path

    Raises
    ------
    RecordError
        No table of numbers; a cell that is none, with its line and column.
    """
    layout = _layout(path)
    table = _table(layout)
    labels = [name_and_unit(text) for text in layout.header] or [("", "-")] * layout.columns
    used = [i for i in range(layout.columns) if not (np.isnan(table[0, i]) and np.all(np.isnan(table[:, i])))]
    if len(used) < layout.columns:  # a separator at the end of each line
        table, labels = table[:, used], [labels[i] for i in used]
    names = distinct([name or f"column {i + 1}" for i, (name, _) in enumerate(labels)])
    raw = Raw(
        table, names, [unit for _, unit in labels], place=lambda row: f"line {_line_number(layout, row)}"
    )
    column = _time_column(raw, bool(layout.header))
    return raw if column is None else _with_time(raw, column, layout)


def _layout(path: Path) -> Layout:
    with path.open("rb") as file:
        head = file.read(HEAD)
    encoding = _encoding(head, path)
    text = head.decode(encoding, errors="replace").removeprefix("\ufeff")
    lines = text.splitlines()
    if len(head) == HEAD and len(lines) > 1:
        lines.pop()  # it is cut
    elif len(head) == HEAD:
        raise RecordError(f"{path.name}, line 1 is longer than {HEAD} bytes: this is not a table of numbers")
    found = max((_tried(lines[:TRIED], *dialect) for dialect in DIALECTS), key=lambda choice: choice[0])
    (rows, *_), separator, point, columns, first = found
    if not rows:
        shown = next((line for line in lines if line.strip()), "")[:40]
        raise RecordError(
            f"{path.name} has no rows of numbers in its first {len(lines)} lines; the first reads {shown!r}: give a "
            "table with one row for each sample, and no text or dates between the numbers"
        )
    header = _header(lines, separator, columns, first)
    for column, name in enumerate(header, start=1):
        if name and _number(name, point) is not None and any(_number(n, point) is None for n in header):
            bad = next(i for i, n in enumerate(header, start=1) if _number(n, point) is None)
            raise RecordError(
                f"{path.name}, line {first}, column {bad}: {header[bad - 1][:40]!r} is not a number, but column "
                f"{column} is"
            )
    as_text = encoding == "utf-16" or b"\n" not in head  # else bytes are read as they are
    per_line = len(head) / max(len(lines), 1)
    return Layout(path, encoding, separator, point, columns, first, header, per_line, '"' in text, as_text)


def _encoding(head: bytes, path: Path) -> str:
    if not head.strip():
        raise RecordError(f"{path.name} is empty: nothing was measured, or the export failed")
    if head.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):
        return "utf-16"
    if b"\0" in head:
        line = head[: head.index(b"\0")].count(b"\n") + 1
        raise RecordError(f"{path.name}, line {line} has zero bytes: this is no text file, or it is damaged")
    try:
        codecs.getincrementaldecoder("utf-8")().decode(head)
    except UnicodeDecodeError:
        return "cp1252"
    return "utf-8"


def _fields(line: str, separator: str) -> list[str]:
    if separator == " ":
        return line.split()
    if '"' in line:
        line = next(csv.reader([line.strip("\r\n")], delimiter=separator), [])
    else:
        line = line.rstrip("\r\n").split(separator)
    return [field.strip() for field in line]


def _number(text: str, point: str) -> float | None:
    """A number, NaN for an empty cell, None for anything else."""
    if not text:
        return math.nan
    if "_" in text or (point == "," and "." in text):
        return None
    try:
        return float(text.replace(point, "."))
    except ValueError:
        return None


def _tried(lines: list[str], separator: str, point: str) -> tuple[tuple[int, bool, int], str, str, int, int]:
    """How well a dialect fits: rows of numbers, header of equal length, columns."""
    counts: dict[int, list[int]] = {}
    for i, line in enumerate(lines):
        fields = _fields(line, separator)
        numbers = [_number(field, point) for field in fields]
        if None not in numbers and any(field for field in fields):
            counts.setdefault(len(fields), []).append(i)
    if not counts:
        return (0, False, 0), separator, point, 0, 0
    columns, rows = max(counts.items(), key=lambda item: len(item[1]))
    first = rows[0]
    above = next((line for line in reversed(lines[:first]) if line.strip()), None)
    fits = above is None or len(_fields(above.lstrip(COMMENT), separator)) == columns
    return (len(rows), fits, columns), separator, point, columns, first


def _header(lines: list[str], separator: str, columns: int, first: int) -> tuple[str, ...]:
    """Names with units above the numbers; a row of units below the names is joined to them."""
    above = []
    told = [line for line in lines[:first] if line.strip() and not line.lower().startswith("sep=")]
    for line in reversed(told[-2:]):
        fields = _fields(line.lstrip(COMMENT), separator)
        if len(fields) != columns:
            break
        above.append(fields)
    named = (
        len(above) == 2 and any(map(TIMES.fullmatch, above[0])) and not any(map(TIMES.fullmatch, above[1]))
    )
    if len(above) == 2 and not named and all(_is_unit(field) for field in above[0]):  # t, a, F are units, too
        return tuple(f"{name} [{unit.strip('[]()')}]" for name, unit in zip(above[1], above[0], strict=True))
    return tuple(above[0]) if above else ()


def _is_unit(text: str) -> bool:
    return not text or si_factor(name_and_unit(f"x [{text.strip('[]()')}]")[1]) is not None


def _table(layout: Layout) -> np.ndarray:
    """All numbers, shape (N, columns); what the reader grumbles at is looked up by line and column."""
    size = os.path.getsize(layout.path)
    table, count = np.empty((layout.columns, int(size / layout.bytes_per_line * 1.02) + 10)), 0
    progress = Progress(f"reading {layout.path.name}")
    blocks, workers, waiting = _blocks(layout), min(os.cpu_count() or 1, WORKERS), deque()
    try:
        with ThreadPoolExecutor(workers) as pool:
            for block in chain(blocks, repeat(b"", workers + 1)):
                waiting.append(pool.submit(_numbers, block, layout))
                if len(waiting) > workers + 1:  # no more than that is in memory
                    rows = waiting.popleft().result()
                    if count + rows.shape[1] > table.shape[1]:
                        table = np.hstack(
                            [table[:, :count], np.empty((layout.columns, count + rows.shape[1]))]
                        )
                    table[:, count : count + rows.shape[1]] = rows
                    count += rows.shape[1]
                    progress.tell(min(count * layout.bytes_per_line / size, 1.0))
    except Exception as error:  # the kinds of errors of a parser are many
        raise RecordError(_blame(layout, count) or f"{layout.path.name} cannot be read: {error}") from error
    finally:
        progress.close()
    if count < 2:
        raise RecordError(f"{layout.path.name} has {count} row of numbers: a record needs two or more")
    return table[:, :count].T  # columns stay in one piece


def _blocks(layout: Layout) -> Iterator[bytes]:
    """The rows of numbers in pieces that end with a line."""
    with layout.open() as file:
        for _ in range(layout.first):
            file.readline()
        while block := file.read(BLOCK) + file.readline():
            yield block.encode() if isinstance(block, str) else block


def _numbers(block: bytes, layout: Layout) -> np.ndarray:
    """The numbers of a piece, shape (columns, rows), by the C reader of pandas, which lets other threads work."""
    import pandas as pd

    if not block.strip():
        return np.empty((layout.columns, 0))
    found = pd.read_csv(
        BytesIO(block), sep=r"\s+" if layout.separator == " " else layout.separator, header=None, dtype=float,
        decimal=layout.point, index_col=False,
        quoting=csv.QUOTE_MINIMAL if layout.quoted else csv.QUOTE_NONE,
    )  # fmt: skip
    if found.shape[1] != layout.columns:
        raise ValueError(f"a row has {found.shape[1]} columns instead of {layout.columns}")
    return found.to_numpy().T


def _data_lines(layout: Layout) -> Iterator[tuple[int, str]]:
    """Line numbers, from 1, and text of the rows of numbers."""
    with layout.path.open(encoding=layout.encoding, errors="replace") as file:
        yield from ((n, line) for n, line in enumerate(file, start=1) if n > layout.first and line.strip())


def _line_number(layout: Layout, row: int) -> int:
    return next(islice(_data_lines(layout), row, None), (0, ""))[0]


def _blame(layout: Layout, start: int) -> str:
    """The first cell, from a row on, that is no number: its line, column and text."""
    for n, line in islice(_data_lines(layout), start, None):
        fields = layout.fields(line)
        if len(fields) != layout.columns:
            return f"{layout.path.name}, line {n} has {len(fields)} columns, the others have {layout.columns}"
        for column, text in enumerate(fields, start=1):
            if _number(text, layout.point) is None:
                return f"{layout.path.name}, line {n}, column {column}: {text[:40]!r} is not a number"
    return ""


def _time_column(raw: Raw, labeled: bool) -> int | None:
    """The column that says when; without names the first one, if it rises all along."""
    if labeled:
        return next((i for i, name in enumerate(raw.names) if TIMES.fullmatch(name)), None)
    rises = raw.columns.shape[1] > 1 and bool(np.all(np.diff(raw.columns[:, 0]) >= 0))
    return 0 if rises else None


def _with_time(raw: Raw, column: int, layout: Layout) -> Raw:
    if raw.columns.shape[1] < 2:
        raise RecordError(f"{layout.path.name} has times only: nothing was measured")
    tail = re.search(r"[_ ](ns|us|µs|ms|msec|min)$", raw.names[column])  # time_ms
    unit = tail[1] if tail and raw.units[column] == "-" else raw.units[column]
    factor = 1.0 if unit == "-" else to_si(f"1 {unit}", "s", "the unit of time")
    time = raw.columns[:, column] * factor if factor != 1.0 else raw.columns[:, column]
    bad = np.flatnonzero(~np.isfinite(time))
    if len(bad):
        raise RecordError(f"{layout.path.name}, {raw.place(bad[0])}, column {column + 1}: there is no time")
    raw.time, raw.quantum = time, _quantum(layout, column, max(abs(time[0]), abs(time[-1])) / factor) * factor
    rest = [i for i in range(raw.columns.shape[1]) if i != column]
    keep = slice(rest[0], rest[-1] + 1) if rest[-1] - rest[0] + 1 == len(rest) else rest
    raw.columns = raw.columns[:, keep]
    raw.names, raw.units = [raw.names[i] for i in rest], [raw.units[i] for i in rest]
    return raw


def _quantum(layout: Layout, column: int, largest: float) -> float:
    """Step of the last digit of the times: the finest in the first hundred rows, or the coarsest of exponents."""
    texts = (layout.fields(line)[column] for _, line in islice(_data_lines(layout), 100))
    found = [re.fullmatch(r"[+-]?\d*[.,]?(\d*)([eE].*)?", text) for text in texts]
    power = math.floor(math.log10(largest)) if largest > 0 else 0
    steps = [10.0 ** ((power if m[2] else 0) - len(m[1])) for m in found if m]
    return min(steps, default=0.0)
