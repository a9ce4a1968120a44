"""The contact sheet: many systems on one page, to see at a glance what there is."""

from __future__ import annotations

from collections.abc import Sequence
from numbers import Integral

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from engdyn.errors import EngdynError
from engdyn.plots.alternative import describe
from engdyn.plots.drawing import Layer, draw_layers, shown_pose
from engdyn.plots.look import new_figure, style
from engdyn.system import System
from engdyn.systems.library import catalogue, load

__all__ = ["contact_sheet"]

CELL = (4.0, 3.3)
"""Width and height of the place of one drawing, its title included, in inches."""

TITLE = 30.0
"""Height of the line of text above a drawing, in points."""

MARGIN = (16.0, 14.0)
"""Room around a drawing without labels, at the sides and above and below, in points."""


def contact_sheet(
    systems: Sequence[System | str | int] | None = None,
    columns: int = 4,
    *,
    labels: bool = False,
    letters: float = 12.0,
) -> Figure:
    """Draw many systems on one page, each in the pose that shows it best.

    Course appendix A.

    Parameters
    ----------
    systems : sequence of System, str or int, optional
        Systems, or keys as for ``engdyn.systems.load``; default: the catalogue.
    columns : int
        Drawings in a row.
    labels : bool
        Write the labels and draw the dimensions of the parameters.
    letters : float
        Size of the labels in points.

    Returns
    -------
    matplotlib.figure.Figure
        With one pair of axes a system, in the order given.

    Raises
    ------
    EngdynError
        No systems, something that is none, or less than one column.

    Examples
    --------
    >>> import engdyn as ed
    >>> sheet = ed.plots.contact_sheet(["S07", "S23"], columns=2)
    >>> [ax.get_title() for ax in sheet.axes]
    ['S07 gantry crane', 'S23 half car']
    """
    chosen = _chosen(systems)
    if not isinstance(columns, Integral) or isinstance(columns, bool) or columns < 1:
        raise EngdynError(f"columns = {columns!r}: a sheet has one column or more; give a whole number.")
    columns = min(int(columns), len(chosen))
    rows = -(-len(chosen) // columns)
    figure = new_figure(columns * CELL[0], rows * CELL[1], layout=None)
    share = 1.0 - TITLE / (72.0 * CELL[1])
    for place, system in enumerate(chosen):
        row, column = divmod(place, columns)
        box = (column / columns, 1.0 - (row + 1) / rows, 1.0 / columns, share / rows)
        _draw(figure.add_axes(box), system, labels, letters)
    intro = f"{len(chosen)} drawings, {columns} in a row."
    describe(figure.axes[0], f"{intro} {_words(chosen[0])}")
    return figure


def _chosen(systems: Sequence[System | str | int] | None) -> list[System]:
    """The systems to draw; keys are loaded."""
    if systems is None:
        systems = list(catalogue().index)
    if isinstance(systems, str | System) or not isinstance(systems, Sequence):
        raise EngdynError(
            f"systems = {systems!r}: give a list of systems or of their keys, as in ['S07', 'S23']."
        )
    if not systems:
        raise EngdynError("there are no systems to draw: give at least one, or leave `systems` out for all.")
    return [system if isinstance(system, System) else load(system) for system in systems]


def _draw(ax: Axes, system: System, labels: bool, letters: float) -> None:
    shapes = system.shapes(shown_pose(system), system.values())
    if not labels:  # a dimension without its letter says nothing
        shapes = [shape for shape in shapes if shape.role != "parameter"]
    draw_layers(ax, [Layer(shapes)], labels=labels, margin=(22.0, 18.0) if labels else MARGIN, size=letters)
    with style():
        ax.set_title(_heading(system), fontsize=14.0, pad=5.0)
    describe(ax, _words(system))


def _heading(system: System) -> str:
    """Number and short name, as ``S07 gantry crane``; the title of a system without number."""
    return f"S{system.number:02d} {system.key.replace('_', ' ')}" if system.number else system.title


def _words(system: System) -> str:
    return f"{f'S{system.number:02d}: ' if system.number else ''}{system.title}."
