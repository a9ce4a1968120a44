"""Flow charts: a procedure of the course on one page."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from matplotlib.axes import Axes
from matplotlib.text import Text

from engdyn.errors import EngdynError
from engdyn.plots.alternative import describe
from engdyn.plots.look import COLORS, FILL, new_axes, style

__all__ = ["flow_chart"]

WIDTH, HEIGHT = 3.0, 0.95  # inches between the centers of neighboring boxes


def flow_chart(
    boxes: Mapping[str, tuple[str, tuple[float, float]]],
    arrows: Sequence[tuple[str, str] | tuple[str, str, str]],
    ax: Axes | None = None,
) -> Axes:
    """Draw boxes with text and arrows between them.

    Parameters
    ----------
    boxes : mapping of name to (text, (column, row))
        Rows count downward from 0. A text that ends with a question mark is a decision.
    arrows : sequence of (from, to) or (from, to, label)
        Names of boxes.
    ax : matplotlib Axes, optional
        Where to draw; a new figure of fitting size if not given.

    Returns
    -------
    matplotlib Axes

    Raises
    ------
    EngdynError
        An arrow that starts or ends at a box that is not there.
    """
    for arrow in arrows:
        for name in arrow[:2]:
            if name not in boxes:
                raise EngdynError(
                    f"flow_chart: an arrow names the box {name!r}; there are {', '.join(boxes)}."
                )
    columns = [at[0] for _, at in boxes.values()]
    rows = [at[1] for _, at in boxes.values()]
    span = max(columns) - min(columns) + 1, max(rows) - min(rows) + 1
    if ax is None:
        ax = new_axes(WIDTH * span[0], HEIGHT * span[1])
    with style():
        ax.set_axis_off()
        ax.set_xlim(min(columns) - 0.5, max(columns) + 0.5)
        ax.set_ylim(max(rows) + 0.5, min(rows) - 0.5)
        drawn = {name: _box(ax, text, at) for name, (text, at) in boxes.items()}
        for arrow in arrows:
            _arrow(ax, drawn[arrow[0]], drawn[arrow[1]], arrow[2] if len(arrow) > 2 else "")
    steps = "; ".join(" → ".join(boxes[name][0].replace("\n", " ") for name in arrow[:2]) for arrow in arrows)
    describe(ax, f"Flow chart. {steps}.")
    return ax


def _box(ax: Axes, text: str, at: tuple[float, float]) -> Text:
    decision = text.endswith("?")
    frame = {
        "boxstyle": "round,pad=0.45,rounding_size=0.8" if decision else "square,pad=0.45",
        "facecolor": "#fdf3d9" if decision else FILL["body"],
        "edgecolor": COLORS["body"],
        "linewidth": 1.4,
    }
    look = {"fontsize": 11, "color": COLORS["body"], "bbox": frame, "zorder": 3}
    return ax.text(*at, text, ha="center", va="center", **look)


def _arrow(ax: Axes, start: Text, end: Text, label: str) -> None:
    """An arrow from the edge of one box to that of another, drawn after them: only then they have their size."""
    look = {"arrowstyle": "-|>", "color": COLORS["body"], "linewidth": 1.4, "shrinkA": 2, "shrinkB": 2}
    look |= {"patchA": start.get_bbox_patch(), "patchB": end.get_bbox_patch()}
    (x0, y0), (x1, y1) = tail, head = start.get_position(), end.get_position()
    ax.annotate("", xy=head, xytext=tail, arrowprops=look, zorder=4)
    if label:
        x, y = 0.5 * (x0 + x1), 0.5 * (y0 + y1)
        place = (x, y - 0.16) if x0 != x1 else (x + 0.08, y)
        ax.text(*place, label, ha="center", va="center", fontsize=11, color=COLORS["coordinate"], zorder=4)
