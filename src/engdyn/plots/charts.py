"""Flow charts: a procedure of the course on one page."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from matplotlib.axes import Axes

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
        for arrow in arrows:
            _arrow(ax, boxes[arrow[0]][1], boxes[arrow[1]][1], arrow[2] if len(arrow) > 2 else "")
        for text, at in boxes.values():
            _box(ax, text, at)
    steps = "; ".join(" → ".join(boxes[name][0].replace("\n", " ") for name in arrow[:2]) for arrow in arrows)
    describe(ax, f"Flow chart. {steps}.")
    return ax


def _box(ax: Axes, text: str, at: tuple[float, float]) -> None:
    decision = text.endswith("?")
    frame = {
        "boxstyle": "round,pad=0.45,rounding_size=1.2" if decision else "square,pad=0.45",
        "facecolor": "#fdf3d9" if decision else FILL["body"],
        "edgecolor": COLORS["body"],
        "linewidth": 1.4,
    }
    ax.text(*at, text, ha="center", va="center", fontsize=11, color=COLORS["body"], bbox=frame, zorder=3)


def _arrow(ax: Axes, start: tuple[float, float], end: tuple[float, float], label: str) -> None:
    """An arrow from box to box; downward ones leave below the box, others beside it."""
    beside = start[0] != end[0]
    side = 0.34 if end[0] > start[0] else -0.34
    tail = (start[0] + side, start[1]) if beside else (start[0], start[1] + 0.28)
    head = (end[0] - side, end[1]) if beside else (end[0], end[1] - 0.28)
    look = {"arrowstyle": "-|>", "color": COLORS["body"], "linewidth": 1.4, "shrinkA": 0, "shrinkB": 0}
    ax.annotate("", xy=head, xytext=tail, arrowprops=look, zorder=2)
    if label:
        place = (
            (0.5 * (tail[0] + head[0]), tail[1] - 0.16)
            if beside
            else (tail[0] + 0.08, 0.5 * (tail[1] + head[1]))
        )
        ax.text(*place, label, ha="center", va="center", fontsize=11, color=COLORS["coordinate"], zorder=4)
