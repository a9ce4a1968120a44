"""System: one mechanical system that is taken through the whole sequence of the course.

The catalogue's 23 systems and a user's own are objects of this one class.  Appendix A.
"""

from __future__ import annotations

import difflib
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import cached_property
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

import sympy as sm

from engdyn.errors import EngdynError, OutsideRingError, ParameterError
from engdyn.modeling.equality import Proof, prove_equal
from engdyn.modeling.equations import EquationsOfMotion
from engdyn.modeling.lagrange import lagrange
from engdyn.modeling.newton import FreeBody, newton_euler
from engdyn.quantities import Coordinate, Input, Parameter

if TYPE_CHECKING:
    from sympy.physics.vector import ReferenceFrame

    from engdyn.analysis.branches import BranchSet
    from engdyn.analysis.equilibrium import EquilibriumSet
    from engdyn.analysis.time_history import TimeHistory

__all__ = ["System"]


class System:
    """A mechanical system: its description, its two models, and the way through the course.

    Parameters
    ----------
    title : str
    coordinates : sequence of Coordinate
    parameters : sequence of Parameter
    kinetic_energy, potential_energy, dissipation : sympy.Expr
        T, V [J] and Rayleigh's function D [W].
    generalized_forces : mapping of dynamicsymbol to expression, optional
        What is neither in V nor in D [N, N m].
    free_bodies : sequence of FreeBody, or a function that returns it
    frame : ReferenceFrame
        The inertial frame of the free bodies.
    unknowns : sequence of sympy.Symbol
        Magnitudes of the reactions.
    inputs : sequence of Input
    shapes : callable, optional
        ``shapes(q, values)`` returns the drawing as a list of :mod:`engdyn.shapes`.
    pose : sequence of float, optional
        Coordinates [m, rad] of a pose that shows the system well; drawings begin with it.
    constraints : sequence of expressions, optional
        Nonholonomic velocity constraints = 0.
    steady : callable, optional
        ``steady(values, inputs)`` returns keyword arguments for :func:`engdyn.equilibria` that define
        the steady motion looked for: rates, accelerations, free; inputs that hold where they are not
        given; bounds beside those of the coordinates.  Of a parameter that varies along a branch it
        gets the symbol.
    region : callable, optional
        ``region(q, values)`` says whether a place within the bounds belongs to the region in which
        equilibria are looked for, where that is no box.
    number, key, field, description, measured :
        Place in the catalogue, field of engineering, description and what one would measure.

    Notes
    -----
    Appendix A of the course.  Both derivations are independent: :meth:`newton` uses the free
    bodies alone, :meth:`lagrange` the energies alone.
    """

    kinetic_energy: sm.Expr = sm.S.Zero
    potential_energy: sm.Expr = sm.S.Zero
    dissipation: sm.Expr = sm.S.Zero
    generalized_forces: Mapping[sm.Expr, sm.Expr] = MappingProxyType({})

    def __init__(
        self,
        *,
        title: str,
        coordinates: Sequence[Coordinate],
        parameters: Sequence[Parameter],
        kinetic_energy: sm.Expr,
        potential_energy: sm.Expr,
        dissipation: sm.Expr = 0,
        generalized_forces: Mapping[sm.Expr, sm.Expr] | None = None,
        free_bodies: Sequence[FreeBody] | Callable[[], Sequence[FreeBody]] = (),
        frame: ReferenceFrame | None = None,
        unknowns: Sequence[sm.Symbol] = (),
        inputs: Sequence[Input] = (),
        shapes: Callable[..., list] | None = None,
        pose: Sequence[float] | None = None,
        constraints: Sequence[sm.Expr] = (),
        steady: Callable[..., dict] | None = None,
        region: Callable[..., bool] | None = None,
        number: int | None = None,
        key: str = "own_system",
        field: str = "",
        description: str = "",
        measured: str = "",
    ):
        self.title, self.number, self.key, self.field = title, number, key, field
        self.description, self.measured = description, measured
        self.coordinates, self.parameters, self.inputs = tuple(coordinates), tuple(parameters), tuple(inputs)
        self.kinetic_energy, self.potential_energy = kinetic_energy, potential_energy
        self.dissipation, self.generalized_forces = dissipation, dict(generalized_forces or {})
        self.frame, self.unknowns, self.constraints = frame, tuple(unknowns), tuple(constraints)
        self._free_bodies, self._shapes, self._steady, self._region = free_bodies, shapes, steady, region
        self.pose = None if pose is None else tuple(float(x) for x in pose)
        names = [p.name for p in self.parameters]
        if len(set(names)) != len(names):
            raise EngdynError(f"parameter names must differ: {names}")

    @property
    def bounds(self) -> dict[str, tuple[float, float]]:
        """Region in which equilibria are looked for: coordinate name → (lower, upper)."""
        return {c.name: c.bounds for c in self.coordinates if c.bounds is not None}

    def free_bodies(self) -> list[FreeBody]:
        """Free-body diagrams, one per body."""
        bodies = self._free_bodies() if callable(self._free_bodies) else self._free_bodies
        if not bodies:
            raise EngdynError(
                f"the system {self.title!r} has no free bodies: give free_bodies, frame and unknowns"
            )
        return list(bodies)

    def shapes(self, q: Any, values: Mapping[str, float] | None = None) -> list:
        """The drawing as data, in meters: shapes of :mod:`engdyn.shapes`."""
        if self._shapes is None:
            raise EngdynError(f"the system {self.title!r} has no drawing: give shapes=function(q, values)")
        return self._shapes([float(x) for x in q], dict(values) if values is not None else self.values())

    def values(self, **changes: Any) -> dict[str, float]:
        """All parameter values in SI units.

        Parameters
        ----------
        **changes : float or str
            Values that differ from the default, as numbers or as text with a unit ("30 ft").

        Raises
        ------
        ParameterError
            Unknown name, a value that is not finite or has the wrong sign, a unit that does not fit.
        """
        known = {p.name: p for p in self.parameters}
        for name in changes:
            if name not in known:
                near = difflib.get_close_matches(name, known, n=1, cutoff=0.3)
                hint = f"did you mean {near[0]!r}? " if near else ""
                raise ParameterError(f"unknown parameter {name!r}: {hint}{self.title} has {', '.join(known)}")
        return {name: p.check(changes.get(name, p.default)) for name, p in known.items()}

    def newton(self) -> EquationsOfMotion:
        """Equations of motion from the free bodies, by Newton and Euler."""
        bodies = self.free_bodies()
        if self.frame is None:
            raise EngdynError(f"the system {self.title!r} has no inertial frame: give frame=")
        eom = newton_euler(bodies, self._symbols, self.frame, self.unknowns, constraints=self.constraints)
        return replace(eom, defaults=self._defaults)

    def lagrange(self) -> EquationsOfMotion:
        """Equations of motion from the energies, by Lagrange."""
        eom = lagrange(
            self.kinetic_energy,
            self.potential_energy,
            self._symbols,
            self.dissipation,
            self.generalized_forces,
            self.constraints,
        )
        return replace(eom, defaults=self._defaults)

    def prove(self) -> Proof:
        """Whether both derivations give the same equations of motion."""
        try:
            return prove_equal(self.newton(), self.lagrange())
        except OutsideRingError as error:
            return Proof("undecided", f"outside the exact algebra: {error}")

    def equilibria(self, values: Mapping[str, float] | None = None, **inputs: Any) -> EquilibriumSet:
        """All equilibria and steady motions within :attr:`bounds`.

        Parameters
        ----------
        values : mapping of str to float, optional
            Parameters by name [SI]; the defaults where not given.
        **inputs : float or (value, rate, acceleration)
            Constant inputs by name.
        """
        from engdyn.analysis.equilibrium import equilibria

        complete, question = self._question(values, inputs)
        return equilibria(self.equations, complete, **question)

    def branches(
        self,
        parameter: str,
        range: tuple[float, float],
        values: Mapping[str, float] | None = None,
        **inputs: Any,
    ) -> BranchSet:
        """Equilibria and steady motions over one parameter, within :attr:`bounds`.

        Parameters
        ----------
        parameter : str
            Name of the parameter that varies.
        range : (float, float)
            First and last value of it [SI].
        values : mapping of str to float, optional
            The other parameters by name [SI]; the defaults where not given.
        **inputs : float or (value, rate, acceleration)
            Constant inputs by name.
        """
        from engdyn.analysis.branches import continue_equilibria

        complete, question = self._question(values, inputs, parameter)
        return continue_equilibria(self.equations, complete, parameter, range, **question)

    def simulate(
        self,
        initial: tuple[Any, Any],
        times: Any,
        values: Mapping[str, float] | None = None,
        inputs: Mapping[str, Any] | None = None,
        **options: Any,
    ) -> TimeHistory:
        """Motion over time, with the balance of energy (chapter 8).

        Parameters
        ----------
        initial : (q, u)
            Coordinates [m, rad] and speeds at ``times[0]``.
        times : array_like
            When the motion is wanted [s].
        values : mapping of str to float, optional
            Parameters by name [SI]; the defaults where not given.
        inputs, **options
            As for :func:`engdyn.simulate`.
        """
        from engdyn.analysis.simulation import simulate

        self._check_inputs(inputs or {})
        return simulate(self.equations, initial, times, self.complete(values), inputs, **options)

    def _question(
        self, values: Mapping[str, float] | None, inputs: Mapping[str, Any], varied: str | None = None
    ) -> tuple[dict[str, float], dict[str, Any]]:
        """All parameters; and region, inputs and steady motion as arguments of ``equilibria``."""
        complete = self.complete(values)
        self._check_inputs(inputs)
        symbols = {p.name: p.symbol for p in self.parameters if p.name == varied}
        question = dict(self._steady({**complete, **symbols}, inputs)) if self._steady else {}
        question["bounds"] = {**self.bounds, **question.get("bounds", {})}
        question["inputs"] = {**question.get("inputs", {}), **inputs}
        return complete, {**question, "region": self._region}

    def complete(self, values: Mapping[str, float] | None) -> dict[str, float]:
        """Given values, checked, with the defaults for those not given."""
        if values is not None and not isinstance(values, Mapping):
            raise EngdynError(f"values must map parameter names to numbers, not be a {type(values).__name__}")
        return self.values(**(values or {}))

    def _check_inputs(self, inputs: Mapping[str, Any]) -> None:
        known = [i.name for i in self.inputs]
        for name in inputs:
            if name not in known:
                near = difflib.get_close_matches(name, known, n=1, cutoff=0.3)
                hint = f"did you mean {near[0]!r}? " if near else ""
                raise EngdynError(
                    f"unknown input {name!r}: {hint}{self.title} has {', '.join(known) or 'none'}"
                )

    @cached_property
    def equations(self) -> EquationsOfMotion:
        """The equations of motion that the analyses use (Lagrange's), derived once."""
        return self.lagrange()

    @property
    def _symbols(self) -> list[sm.Expr]:
        return [c.symbol for c in self.coordinates]

    @property
    def _defaults(self) -> dict[sm.Expr, tuple[Any, Any, Any]]:
        return {i.symbol: i.default for i in self.inputs if i.default is not None}

    def __repr__(self) -> str:
        number = f"S{self.number:02d} " if self.number else ""
        return f"System({number}{self.title}; {', '.join(c.name for c in self.coordinates)})"

    def _repr_html_(self) -> str:
        rows = "".join(
            f"<tr><td><code>{p.name}</code></td><td>{p.meaning}</td><td>{p.default:g}</td><td>{p.unit}</td></tr>"
            for p in self.parameters
        )
        coordinates = "; ".join(f"<code>{c.name}</code> [{c.unit}]: {c.meaning}" for c in self.coordinates)
        inputs = "; ".join(f"<code>{i.name}</code> [{i.unit}]: {i.meaning}" for i in self.inputs) or "none"
        number = f"S{self.number:02d} " if self.number else ""
        return (
            f"<h4>{number}{self.title}</h4><p>{self.description}</p>"
            f"<p>Coordinates: {coordinates}<br>Inputs: {inputs}</p>"
            "<table><thead><tr><th>symbol</th><th>meaning</th><th>default</th><th>unit</th></tr></thead>"
            f"<tbody>{rows}</tbody></table>"
        )
