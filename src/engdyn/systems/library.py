"""The catalogue of representative systems.  Appendix A."""

from __future__ import annotations

import difflib
from functools import cache
from importlib import import_module, resources
from typing import TYPE_CHECKING, Any

from engdyn.errors import UnknownSystemError
from engdyn.system import System

if TYPE_CHECKING:
    import pandas as pd

__all__ = ["catalogue", "load"]


@cache
def _modules() -> dict[int, tuple[str, str]]:
    """Number → (key, module name) of every file ``sNN_key.py`` beside this one."""
    found = {}
    for entry in resources.files("engdyn.systems").iterdir():
        name = entry.name
        if name.startswith("s") and name.endswith(".py") and name[1:3].isdigit() and name[3] == "_":
            found[int(name[1:3])] = (name[4:-3], name[:-3])
    return dict(sorted(found.items()))


def load(key: str | int) -> System:
    """A system of the catalogue.

    Parameters
    ----------
    key : str or int
        ``"gantry_crane"``, ``"S07"`` or ``7``.

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
    number = _number(key)
    return import_module(f"engdyn.systems.{_modules()[number][1]}").build()


def _number(key: Any) -> int:
    modules = _modules()
    if isinstance(key, int) and not isinstance(key, bool) and key in modules:
        return key
    text = str(key).strip().lower()
    by_name = {name: number for number, (name, _) in modules.items()}
    by_name |= {f"s{number:02d}": number for number in modules} | {f"s{number}": number for number in modules}
    if text in by_name:
        return by_name[text]
    near = difflib.get_close_matches(text, by_name, n=1, cutoff=0.0)
    if text.lstrip("s").isdigit():
        nearest = min(modules, key=lambda n: abs(n - int(text.lstrip("s"))))
    else:
        nearest = by_name[near[0]] if near else next(iter(modules))
    raise UnknownSystemError(
        f"there is no system {key!r}; the nearest is S{nearest:02d} {modules[nearest][0]!r}. "
        "engdyn.systems.catalogue() lists all"
    )


def catalogue() -> pd.DataFrame:
    """All systems as a table.

    Returns
    -------
    pandas.DataFrame
        One row a system: number (index, "S07"), key, title, field and degrees of freedom.
    """
    import pandas as pd

    systems = [load(number) for number in _modules()]
    rows = [
        {"key": s.key, "title": s.title, "field": s.field, "degrees of freedom": len(s.coordinates) - len(s.constraints)}
        for s in systems
    ]
    return pd.DataFrame(rows, index=pd.Index([f"S{s.number:02d}" for s in systems], name="number"))
