"""How a System shows itself in a notebook: its drawing, its description, its parameters.

Systems know nothing of pictures, and pictures nothing of notebooks; here both meet.
"""

from __future__ import annotations

import sys
from contextlib import suppress
from typing import TYPE_CHECKING, Any

from engdyn.errors import EngdynError

if TYPE_CHECKING:
    from engdyn.system import System

__all__ = ["register", "show_system"]


def register() -> None:
    """Tell a running IPython how to show a System; without IPython, do nothing."""
    ipython = sys.modules.get("IPython")
    shell: Any = ipython.get_ipython() if ipython is not None else None
    if shell is not None:
        formatter = shell.display_formatter.ipython_display_formatter
        formatter.for_type_by_name("engdyn.system", "System", show_system)


def show_system(system: System) -> None:
    """Display the drawing of a system, where it has one, and below it its description and parameters.

    Parameters
    ----------
    system : System
    """
    from IPython.display import display

    from engdyn.plots import draw, show

    with suppress(EngdynError):  # a system of one's own may have no drawing
        show(draw(system))
    display({"text/html": system._repr_html_(), "text/plain": repr(system)}, raw=True)
