"""Routh's table as a notebook shows it: row by row, each with the way it comes about.  Course section 5.4."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any

import sympy as sm

if TYPE_CHECKING:
    from engdyn.analysis.routh import RouthTable

__all__ = ["entry_text", "superscripts", "table"]

ORIGIN = {
    "": "every second coefficient",
    "epsilon": "began with 0: ε in its place",
    "auxiliary": "was zero: derivative of the row above",
}

SUPERSCRIPTS = str.maketrans("0123456789−", "⁰¹²³⁴⁵⁶⁷⁸⁹⁻")


def table(found: RouthTable) -> str:
    """HTML of a table: power, entries, sign of the first one, and where the row comes from."""
    n, width = len(found.rows) - 1, len(found.rows[0])
    body = []
    for i, (row, mark) in enumerate(zip(found.rows, found.marks, strict=True)):
        room = (n - i) // 2 + 1  # entries that a row of this power has; the rest stays empty
        cells = "".join(f"<td>{_marked(x) if k < room else ''}</td>" for k, x in enumerate(row))
        shade = ' style="background:#fdf3d9"' if mark else ""
        origin = _computed(found, i) if i > 1 and not mark else ORIGIN[mark]
        sign = _sign_text(row[0])
        body.append(f"<tr{shade}><th>s<sup>{n - i}</sup></th>{cells}<td>{sign}</td><td>{origin}</td></tr>")
    head = f'<tr><th></th><th colspan="{width}">entries</th><th>sign</th><th>comes from</th></tr>'
    caption = found.verdict
    if found.sign_changes is not None:
        caption += f" ({found.sign_changes} sign change{'s' * (found.sign_changes != 1)} in the first column)"
    caption = _escaped(caption[0].upper() + caption[1:])
    note = f"<p>{_escaped(found.special)}</p>" if found.special else ""
    if found.right_half_plane is None and found.conditions:
        note += "<p>Conditions: " + ", ".join(f"${sm.latex(c)} > 0$" for c in found.conditions) + "</p>"
    return f"<table><caption>{caption}</caption><thead>{head}</thead><tbody>{''.join(body)}</tbody></table>{note}"


def entry_text(x: sm.Expr) -> str:
    """A number with up to five digits; an expression as it is."""
    text = str(x)
    return f"{float(x):.5g}" if x.is_number and len(text) > 7 else text.replace("epsilon", "ε")


def superscripts(expression: Any) -> str:
    """An expression in plain letters with its powers raised: s² + 4."""
    plain = str(expression).replace("epsilon", "ε").replace("-", "−")
    return re.sub(r"\*\*\(?(−?\d+)\)?", lambda found: found[1].translate(SUPERSCRIPTS), plain).replace(
        "*", " "
    )


def _marked(x: sm.Expr) -> str:
    """An entry for the table: expressions in symbols as formulas."""
    if x.is_number:
        return entry_text(x).replace("-", "−")
    return superscripts(x) if _only_epsilon(x) else f"${sm.latex(x)}$"


def _only_epsilon(x: sm.Expr) -> bool:
    return {symbol.name for symbol in x.free_symbols} == {"epsilon"}


def _computed(found: RouthTable, i: int) -> str:
    """How the first entry of a row follows from the two rows above, in numbers; nothing where these are long."""
    above, over = found.rows[i - 1], found.rows[i - 2]
    a, b, c, d = over[0], over[1], above[0], (*above, sm.S.Zero)[1]
    if not all(x.is_number for x in (a, b, c, d)):
        return "two rows above"
    texts = [entry_text(x) if x >= 0 else f"({entry_text(x)})" for x in (c, b, a, d)]
    return "({} · {} − {} · {})/{}".format(*texts, texts[0]).replace("-", "−")


def _sign_text(x: sm.Expr) -> str:
    """Plus or minus; for small positive ε where it occurs, a question mark where symbols leave it open."""
    if not x.is_number:
        if not _only_epsilon(x):
            return "+" if x.is_positive else "−" if x.is_negative else "?"
        lowest = [sm.Poly(part, *x.free_symbols).EC() for part in sm.fraction(sm.together(x))]
        x = lowest[0] * lowest[1]
    return "+" if x > 0 else "−"


def _escaped(text: str) -> str:
    return text.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")
