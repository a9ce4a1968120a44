"""Tables, paragraphs and numbers as HTML."""

from __future__ import annotations

import html
import math
import re
from collections.abc import Iterable, Sequence

from engdyn.plots import words

__all__ = ["number", "paragraph", "part_of_pi", "table", "unit"]


def table(caption: str, head: Sequence[str], rows: Iterable[Sequence[str]], right: Sequence[int] = ()) -> str:
    """A table; the columns in `right` hold numbers."""
    marks = [' class="number"' if i in right else "" for i in range(len(head))]
    top = "".join(f'<th scope="col"{m}>{h}</th>' for m, h in zip(marks, head, strict=True))
    body = "".join(
        "<tr>" + "".join(f"<td{m}>{cell}</td>" for m, cell in zip(marks, row, strict=True)) + "</tr>"
        for row in rows
    )
    shown = f"<caption>{caption}</caption>" if caption else ""
    return f'<div class="wide"><table>{shown}<thead><tr>{top}</tr></thead><tbody>{body}</tbody></table></div>'


def paragraph(text: str, note: bool = False) -> str:
    """A paragraph of plain text."""
    return f"<p{' class=' + chr(34) + 'note' + chr(34) if note else ''}>{html.escape(text)}</p>"


def unit(text: str) -> str:
    """A unit for a table: powers raised, no unit is a dash."""
    return re.sub(r"\^(-?\d+)", r"<sup>\1</sup>", html.escape(text)) if text not in ("", "-") else "–"


def number(value: float) -> str:
    """Four significant digits, without a power of ten where that is readable."""
    size = abs(value)
    if size < 1e-12:
        return "0"
    if not 1e-4 <= size < 1e7:
        return words.number(value)
    digits = max(0, 3 - math.floor(math.log10(float(f"{size:.3e}"))))
    text = f"{value:.{digits}f}"
    return (text.rstrip("0").rstrip(".") if digits else text).replace("-", "−")


def part_of_pi(value: float) -> str:
    """An angle as a part of π where it is a simple one."""
    twelfths = round(12 * value / math.pi)
    if twelfths == 0 or abs(12 * value / math.pi - twelfths) > 1e-9:
        return number(value)
    divisor = math.gcd(twelfths, 12)
    above, below = abs(twelfths) // divisor, 12 // divisor
    return (
        ("−" if twelfths < 0 else "")
        + (f"{above}" if above > 1 else "")
        + "π"
        + (f"/{below}" if below > 1 else "")
    )
