"""Explorer of equilibria: all poses on the drawing, and how they move with a parameter (chapter 4)."""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from engdyn.errors import EngdynError
from engdyn.plots.axes import MARKS, is_stable
from engdyn.plots.equilibria import branches, equilibrium_poses, verdicts
from engdyn.plots.words import number, plain_verdict, quantity
from engdyn.system import System
from engdyn.widgets.controls import Choice, Control
from engdyn.widgets.system_explorer import SystemExplorer, interesting, slider

if TYPE_CHECKING:
    from engdyn.analysis.branches import BranchSet
    from engdyn.analysis.equilibrium import Equilibrium

__all__ = ["EquilibriumExplorer", "Found", "equilibrium", "find"]

MANY = 6
"""So many equilibria are told one by one."""

REMEMBERED = 16
"""So many branch diagrams are kept, for sliders that go back and forth."""


@dataclass(frozen=True)
class Found:
    """Equilibria of a system at one set of values, judged."""

    states: tuple[Equilibrium, ...]
    verdicts: tuple[str, ...]
    certified: bool
    undecided: int
    branches: BranchSet | None
    trouble: str
    late: bool


def find(system: System, values: Mapping[str, float]) -> tuple[Any, list[str]]:
    """Return all equilibria at these values and the stability verdict of each."""
    found = system.equilibria(values)
    return found, verdicts(system, found)


class EquilibriumExplorer(SystemExplorer):
    """See `equilibrium`."""

    title = "Equilibria"

    def __init__(self, system: str | int | System = "S07", **values: Any) -> None:
        self._followed: dict[tuple, tuple[BranchSet | None, str]] = {}
        super().__init__(system, **values)

    def controls(self, chosen: Mapping[str, Any]) -> Sequence[Control]:
        choice = self.system_choice("system whose equilibria are shown")
        if "system" not in chosen:
            return [choice]
        system = self.system(chosen["system"])
        names = tuple((f"{p.name} ({p.meaning})", p.name) for p in system.parameters)
        shown = [c for c in system.coordinates if c.kind != "ignorable"] or system.coordinates
        seen = tuple((f"{c.name} ({c.meaning})", c.name) for c in shown)
        return [
            choice,
            Choice(
                "over", names, interesting(system)[0], "parameter along which the equilibria are followed"
            ),
            Choice("coordinate", seen, seen[0][1], "coordinate that the diagram shows"),
            *(slider(p) for p in system.parameters),
        ]

    def model(self, state: Mapping[str, Any]) -> Found:
        system, values = self.system(state["system"]), self.parameter_values(state)
        found, judged = find(system, values)
        key = self._branch_key(state)
        # Following takes some tenths of a second: while a slider is dragged it waits.
        late = self._haste is not None and key not in self._followed and self._key is not None
        branch_set, trouble = (None, "") if late else self._follow(key)
        if late:
            self._complete_later()
        return Found(
            tuple(found), tuple(judged), found.certified, len(found.undecided), branch_set, trouble, late
        )

    def _branch_key(self, state: Mapping[str, Any]) -> tuple:
        others = tuple((n, v) for n, v in self.parameter_values(state).items() if n != state["over"])
        return self.system(state["system"]), state["over"], others

    def _follow(self, key: tuple) -> tuple[BranchSet | None, str]:
        """Return the branches, or why there are none; the last few are remembered."""
        if key not in self._followed:
            system, over, others = key
            control = slider(next(p for p in system.parameters if p.name == over))
            values = {**dict(others), over: control.value}
            try:
                self._followed[key] = system.branches(over, (control.low, control.high), values), ""
            except (EngdynError, ArithmeticError, np.linalg.LinAlgError) as error:
                self._followed[key] = None, str(error)
            for old in list(self._followed)[:-REMEMBERED]:
                del self._followed[old]
        return self._followed[key]

    def static_key(self, state: Mapping[str, Any], result: Found) -> Hashable:
        return self._key if result.late else (*self._branch_key(state), state["coordinate"])

    def draw_static(self, figure: Figure, state: Mapping[str, Any], result: Found) -> None:
        figure.add_axes((0.0, 0.0, 0.47, 1.0)).set_axis_off()
        right = figure.add_axes((0.57, 0.17, 0.40, 0.77))
        if result.branches is None:
            right.set_axis_off()
            right.text(0.5, 0.5, f"No branch diagram: {result.trouble}", ha="center", va="center", wrap=True)
        else:
            branches(result.branches, state["coordinate"], right, system=self.system(state["system"]))

    def draw_moving(self, figure: Figure, state: Mapping[str, Any], result: Found) -> Iterable[Artist]:
        left, right = figure.axes
        if result.states:
            equilibrium_poses(self.system(state["system"]), result.states, left, judged=result.verdicts)
        else:
            left.text(0.5, 0.5, "no equilibrium", ha="center", va="center", transform=left.transAxes)
        poses = sorted([*left.collections, *left.texts], key=Artist.get_zorder)
        marks = _veil(right) if result.late else self._marks(right, state, result)
        for artist in (*poses, *marks):
            artist.set_animated(True)
        return [*poses, *marks]

    def _marks(self, ax: Axes, state: Mapping[str, Any], result: Found) -> list[Artist]:
        """Mark the present value and the equilibria there."""
        if result.branches is None:
            return []
        index = [c.name for c in self.system(state["system"]).coordinates].index(state["coordinate"])
        here = state[state["over"]]
        marks = [ax.axvline(here, color="black", linewidth=1.2, linestyle=":")]
        for found, verdict in zip(result.states, result.verdicts, strict=True):
            look = {**MARKS[is_stable(verdict)], "linestyle": ""}
            marks += ax.plot([here], [found.q[index]], marker="o", markeredgewidth=2.0, clip_on=False, **look)
        return marks

    def lines(self, state: Mapping[str, Any]) -> list[str]:
        over = self._controls[state["over"]]
        return [
            *self.loading(state),
            "found = system.equilibria(values)",
            "ed.plots.show(ed.plots.equilibrium_poses(system, found))",
            f'branches = system.branches("{over.name}", ({over.low:.10g}, {over.high:.10g}), values)',
            f'ed.plots.show(ed.plots.branches(branches, "{state["coordinate"]}", system=system))',
        ]

    def caption(self, state: Mapping[str, Any]) -> str:
        system, over = self.system(state["system"]), self._controls[state["over"]]
        return f"{system.title}, {quantity(over.name, state[over.name], over.unit)}"

    def words(self, state: Mapping[str, Any], result: Found) -> str:
        system = self.system(state["system"])
        shown = [i for i, c in enumerate(system.coordinates) if c.kind != "ignorable"]
        told = []
        for found, verdict in zip(result.states[:MANY], result.verdicts, strict=False):
            pose = ", ".join(
                f"{system.coordinates[i].name} = {_value(found.q[i], system.coordinates[i].unit)}"
                for i in shown
            )
            told.append(f"{pose} ({plain_verdict(verdict)})")
        count = len(result.states)
        text = f"{count} equilibri{'um' if count == 1 else 'a'}" + (": " + "; ".join(told) if told else "")
        text += f"; and {count - MANY} more" if count > MANY else ""
        return f"{text}.{_doubt(result)}"


def _veil(ax: Axes) -> list[Artist]:
    """Cover a diagram that is out of date."""
    veil = Rectangle((0.0, 0.0), 1.0, 1.0, transform=ax.transAxes, facecolor="white", alpha=0.75, zorder=10.0)
    return [ax.add_patch(veil)]


def _value(value: float, unit: str) -> str:
    rounded = float(f"{value:.3g}") if abs(value) > 1e-9 else 0.0
    return number(rounded) + (f" {unit}" if rounded else "")


def _doubt(result: Found) -> str:
    if result.certified:
        return ""
    regions = f"{result.undecided} region{'' if result.undecided == 1 else 's'} could not be decided"
    return f" Not certified to be all: {regions}." if result.undecided else " Not certified to be all."


def equilibrium(system: str | int | System = "S07", **values: float) -> EquilibriumExplorer:
    """Explore the equilibria of a system: poses on the left, branches over one parameter on the right.
    Course sections 4.1 to 4.4. Controls: ``system``, ``over`` (the parameter to follow), ``coordinate`` (what
    the diagram shows) and a slider for every parameter of the system.

    Parameters
    ----------
    system : str, int or System
        A system of the catalogue by number or key, or a System of one's own.
    **values : float
        Parameter values in SI units to start from.

    Returns
    -------
    EquilibriumExplorer

    Raises
    ------
    EngdynError
        A value that its slider does not reach; UnknownSystemError for a system that does not exist.
    """
    return EquilibriumExplorer(system, **values)
