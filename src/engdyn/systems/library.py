"""The catalogue of representative systems and the worked examples.  Appendix A."""

from __future__ import annotations

import difflib
import reprlib
from functools import cache
from importlib import import_module, resources
from numbers import Integral
from typing import TYPE_CHECKING, Any

from engdyn.errors import UnknownSystemError
from engdyn.system import System

if TYPE_CHECKING:
    import pandas as pd

__all__ = ["catalogue", "load"]


@cache
def _modules() -> dict[str, tuple[str, str]]:
    """Label ("S07", "W10") → (key, module name) of every file ``sNN_key.py`` and ``wNN_key.py`` here."""
    found = {}
    for entry in resources.files("engdyn.systems").iterdir():
        name = entry.name
        if name.endswith(".py") and name[0] in "sw" and name[1:3].isdigit() and name[3] == "_":
            found[name[:3].upper()] = (name[4:-3], name[:-3])
    return dict(sorted(found.items()))


def load(key: str | int) -> System:
    """A system of the catalogue, or one of the worked examples.

    Parameters
    ----------
    key : str or int
        ``"gantry_crane"``, ``"S07"`` or ``7``; worked examples have labels such as ``"W7"``.

    Returns
    -------
    System

    Raises
    ------
    UnknownSystemError
        No such system; the message names the nearest one.

    Examples
    --------
    >>> import engdyn as ed
    >>> ed.systems.load("S07")
    System(S07 Gantry crane: trolley and hanging container; x, theta)
    """
    return import_module(f"engdyn.systems.{_modules()[_label(key)][1]}").build()


def _label(key: Any) -> str:
    """The label of a system, by number, label or key."""
    modules = _modules()
    whole = isinstance(key, Integral) and not isinstance(key, bool) and abs(key) < 10**8
    text = f"S{key:02d}" if whole else str(key)[:60].strip()
    text = f"S{text}" if text.isascii() and text.isdigit() else text
    kind, digits = text[:1].upper(), text[1:]
    if kind in ("S", "W") and digits.isascii() and digits.isdigit() and len(digits) < 3:
        label = f"{kind}{int(digits):02d}"
        if label in modules:
            return label
    by_key = {name: label for label, (name, _) in modules.items()}
    name = text.lower().replace(" ", "_").replace("-", "_")
    if name in by_key:
        return by_key[name]
    raise UnknownSystemError(
        f"there is no system {reprlib.repr(key)}; the nearest is {_nearest(text, by_key)}. "
        "engdyn.systems.catalogue() lists all"
    )


def _nearest(text: str, by_key: dict[str, str]) -> str:
    """The system whose number or key resembles the text most, as ``S07 'gantry_crane'``."""
    digits = text[1:] if text[:1].upper() in ("S", "W") else text
    if digits.isascii() and digits.lstrip("-").isdigit() and len(digits) < 10:
        label = min((x for x in by_key.values() if x[0] == "S"), key=lambda x: abs(int(x[1:]) - int(digits)))
    else:
        close = difflib.get_close_matches(text.lower(), by_key, n=1, cutoff=0.0)
        label = by_key[close[0]] if close else min(by_key.values())
    return f"{label} {_modules()[label][0]!r}"


def catalogue() -> pd.DataFrame:
    """All systems as a table.

    Returns
    -------
    pandas.DataFrame
        One row a system: number (index, "S07"), key, title, field and degrees of freedom.
    """
    import pandas as pd

    systems = [load(label) for label in _modules() if label[0] == "S"]
    rows = [
        {
            "key": s.key,
            "title": s.title,
            "field": s.field,
            "degrees of freedom": len(s.coordinates) - len(s.constraints),
        }
        for s in systems
    ]
    return pd.DataFrame(rows, index=pd.Index([f"S{s.number:02d}" for s in systems], name="number"))
