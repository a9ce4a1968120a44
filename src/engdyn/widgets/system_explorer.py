"""What explorers of systems have in common: a list of systems, which one's own may join, and their parameters."""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache
from typing import Any

from engdyn.analysis.equilibrium import EquilibriumSet
from engdyn.analysis.linear import linearize
from engdyn.analysis.stability import stability
from engdyn.errors import EngdynError, UnknownSystemError
from engdyn.quantities import Parameter
from engdyn.system import System
from engdyn.systems.library import catalogue, load
from engdyn.widgets.controls import Choice, Slider
from engdyn.widgets.explorer import Explorer

__all__ = ["SystemExplorer", "interesting", "resting", "slider"]


INTERESTING = ("rad/s", "m/s", "m/s^2", "N m/rad", "N/m", "rad", "m")
"""Units of the parameters that are varied at first: what moves, then what is stiff, then what is long."""


def interesting(system: System) -> list[str]:
    """Return the names of all parameters, those that are worth varying first, one of each unit."""
    of = {p.unit: p.name for p in reversed(system.parameters) if p.name != "g"}
    first = [of[unit] for unit in INTERESTING if unit in of]
    return [*first, *(p.name for p in system.parameters if p.name not in first)]


def slider(parameter: Parameter) -> Slider:
    """Return a slider for a parameter: its span, or 0 (what must be positive: 0.2) to 2.5 times the default.

    A default of zero tells no scale: such a parameter goes up to 10 in its unit, or from -10 if it may be
    negative.
    """
    default = float(parameter.default)
    if parameter.span is not None:
        low, high = parameter.span
        step = abs(default) / 50.0 or (high - low) / 100.0
    elif default == 0.0:
        low, high, step = (-10.0 if parameter.admissible == "any" else 0.0), 10.0, 0.1
    else:
        low, high = sorted((0.2 * default if parameter.admissible == "positive" else 0.0, 2.5 * default))
        step = abs(default) / 50.0
    return Slider(parameter.name, low, high, default, parameter.unit, parameter.meaning, step)


def resting(system: System, values: Mapping[str, float]) -> tuple[EquilibriumSet, int]:
    """Return all equilibria and the place of the first stable one among them; of the first, if none is stable.

    Raises
    ------
    EngdynError
        There is none.
    """
    found = system.equilibria(values)
    if not len(found):
        raise EngdynError(f"{system.title} has no equilibrium for these values")
    stable = (i for i, state in enumerate(found) if stability(linearize(system.equations, state)).stable)
    return found, next(stable, 0)


class SystemExplorer(Explorer):
    """An explorer whose first choice is a system.

    Parameters
    ----------
    system : str, int or System
        A system by number, key or label, or a System of one's own.
    **values : float or str
        Where the other controls stand at first.
    """

    structural = ("system",)

    def __init__(self, system: str | int | System = "S07", **values: Any) -> None:
        self._labels = {name: f"{name} {title}" for name, title in _titles().items()}
        self._systems: dict[str, System] = {}
        super().__init__(system=system, **values)

    def set(self, **values: Any) -> None:
        if "system" in values:
            values["system"] = self._named(values["system"])
        super().set(**values)

    def _named(self, system: Any) -> str:
        """Return the name of a system among the choices; one that is not of the catalogue joins them."""
        if isinstance(system, str) and system in self._labels:
            return system
        found = system if isinstance(system, System) else load(system)
        if not isinstance(system, System) and found.number is not None:
            return f"S{found.number:02d}"
        self._labels, self._systems[found.key] = {found.key: found.title, **self._labels}, found
        return found.key

    def system(self, name: str) -> System:
        """Return the system behind a choice."""
        if name not in self._systems:
            self._systems[name] = load(name)
        return self._systems[name]

    def system_choice(self, meaning: str) -> Choice:
        """Return the control that chooses the system."""
        options = tuple((label, name) for name, label in self._labels.items())
        return Choice("system", options, options[0][1], meaning)

    def parameter_values(self, state: Mapping[str, Any]) -> dict[str, float]:
        """Return the values of all parameters, those that have no slider at their defaults."""
        parameters = self.system(state["system"]).parameters
        return {p.name: state.get(p.name, float(p.default)) for p in parameters}

    def loading(self, state: Mapping[str, Any]) -> list[str]:
        """Return the lines that load the system and set the parameters that differ from their defaults."""
        name = state["system"]
        system, values = self.system(name), self.parameter_values(state)
        written = {p.name: (f"{values[p.name]:.10g}", f"{float(p.default):.10g}") for p in system.parameters}
        changes = ", ".join(f"{name}={now}" for name, (now, usual) in written.items() if now != usual)
        return [_loaded(name, system), f"values = system.values({changes})"]


@lru_cache(maxsize=1)
def _titles() -> dict[str, str]:
    return dict(catalogue()["title"])


def _loaded(name: str, system: System) -> str:
    try:
        return f'system = ed.systems.load("{name if name in _titles() else load(system.key).key}")'
    except UnknownSystemError:
        return f"# system is your own: {system.title}"
