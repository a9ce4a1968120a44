"""All equilibria and steady motions of a system, with a certificate that none is missing.

Course chapter 4.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np

from engdyn.algebra.balls import ball, contains_zero, is_finite, lower, upper
from engdyn.algebra.codegen import compile_elements
from engdyn.analysis.enclosure import enclose_roots
from engdyn.analysis.prescribed import evaluated
from engdyn.analysis.results import Equilibrium, EquilibriumSet
from engdyn.analysis.slopes import Products, as_products, compile_products, slopes
from engdyn.analysis.steady import SteadyProblem, Unknown
from engdyn.errors import EngdynError
from engdyn.modeling.equations import EquationsOfMotion
from engdyn.modeling.numbers import input_values, mass_and_force, parameter_values

__all__ = ["Equilibrium", "EquilibriumSet", "Region", "equilibria"]

Region = Callable[[np.ndarray, Mapping[str, float]], bool]
"""Whether coordinates q belong to what is searched, given the parameters; for regions that are no boxes."""


def equilibria(
    eom: EquationsOfMotion,
    values: Mapping[str, float],
    bounds: Mapping[str, tuple[float, float]] | None = None,
    inputs: Mapping[str, Any] | None = None,
    rates: Mapping[str, float] | None = None,
    accelerations: Mapping[str, float] | None = None,
    free: Sequence[str] = (),
    region: Region | None = None,
) -> EquilibriumSet:
    """All equilibria and steady motions in a region.

    Parameters
    ----------
    eom : EquationsOfMotion
    values : mapping of str to float
        Parameters by name [SI].
    bounds : mapping of str to (lower, upper), optional
        Region of each unknown coordinate [m, rad].  An angle that occurs in sines and cosines alone
        is searched over (−π, π] where nothing is given; a coordinate that occurs linearly needs no
        bounds.  An unknown rate or acceleration of x is bounded under the name x_d or x_dd.
    inputs : mapping, optional
        Constant inputs, or (value, rate, acceleration); zero where not given.
    rates, accelerations : mapping of str to float, optional
        Prescribed constant rates and accelerations of coordinates.  For a coordinate that nothing
        depends on, its rate is an unknown where neither is given (its acceleration, where the rate
        has no influence).
    free : sequence of str
        Inputs that are solved for (the drive torque that holds a prescribed rate, say).
    region : callable, optional
        ``region(q, values)`` says whether a place within the bounds is asked for; for regions that
        are no boxes.

    Returns
    -------
    EquilibriumSet
        Sorted by coordinates.

    Raises
    ------
    EngdynError
        Equations with explicit time, missing or reversed bounds, more unknowns than equations.

    Notes
    -----
    Course sections 4.1 to 4.4.  Bounds, inputs, rates and accelerations may be expressions in the
    parameters.  Roots are enclosed by interval Newton steps in ball arithmetic (see
    :mod:`engdyn.analysis.enclosure`); parameters enter as the rationals of their decimals.
    """
    if not isinstance(eom, EquationsOfMotion):
        raise EngdynError(f"eom is {eom!r}: give EquationsOfMotion, for example system.lagrange()")
    inputs, rates = evaluated(inputs, values, "inputs"), evaluated(rates, values, "rates")
    accelerations = evaluated(accelerations, values, "accelerations")
    bounds = _checked_bounds(eom, evaluated(bounds, values, "bounds"))
    problem = SteadyProblem(eom, values, inputs, rates, accelerations, free)
    problem.eliminate_linear(bounds)
    names = tuple(problem.names)
    if problem.unsatisfied:
        why = f"no equilibrium: {'; '.join(problem.unsatisfied)}"
        return EquilibriumSet((), None, (), tuple(problem.neutral), why, names)
    _check_count(problem)
    if not problem.unknowns:
        found = _complete(problem, [[]], bounds, region)
        return EquilibriumSet(tuple(found), None, (), tuple(problem.neutral), "", names)
    box = [_region(problem, unknown, bounds) for unknown in problem.unknowns]
    periodic = [i for i, u in enumerate(problem.unknowns) if is_periodic(problem, u, box[i])]
    certificate = enclose_roots(*_ball_functions(problem), box, periodic=periodic)
    enclosed = [[ball(*side) for side in root] for root in certificate.roots]
    found = _complete(problem, enclosed, bounds, region)
    labels = tuple(u.name for u in problem.unknowns)
    return EquilibriumSet(tuple(found), certificate, labels, tuple(problem.neutral), "", names)


def _checked_bounds(
    eom: EquationsOfMotion, bounds: Mapping[str, tuple[float, float]] | None
) -> dict[str, tuple[float, float]]:
    names = [q.func.__name__ for q in eom.coordinates]
    accepted = {
        *names,
        *(f"{n}{d}" for n in names for d in ("_d", "_dd")),
        *(w.func.__name__ for w in eom.inputs),
    }
    found = {}
    for name, pair in dict(bounds or {}).items():
        if name not in accepted:
            raise EngdynError(f"bounds names {name!r}: the coordinates are {', '.join(names)}")
        try:
            low, high = (float(x) for x in pair)
        except (TypeError, ValueError) as error:
            raise EngdynError(f"bounds[{name!r}] is {pair!r}: give (lower, upper)") from error
        if not (math.isfinite(low) and math.isfinite(high)):
            raise EngdynError(f"bounds[{name!r}] = ({low}, {high}): both ends must be finite")
        if low >= high:
            raise EngdynError(
                f"bounds[{name!r}] = ({low:g}, {high:g}) are reversed: the lower end comes first"
            )
        found[name] = (low, high)
    return found


def _check_count(problem: SteadyProblem) -> None:
    rows, unknowns = len(problem.rows), [u.name for u in problem.unknowns]
    if rows == len(unknowns):
        return
    counted = f"{rows} equation{'s' * (rows != 1)} for {len(unknowns)} unknown{'s' * (len(unknowns) != 1)}"
    counted += f" ({', '.join(unknowns)})" if unknowns else ""
    if rows < len(unknowns):
        raise EngdynError(f"{counted}: prescribe a rate or an acceleration, or name fewer free inputs")
    raise EngdynError(f"{counted}: name an input in free that holds the prescribed motion, or prescribe less")


def _region(
    problem: SteadyProblem, unknown: Unknown, bounds: Mapping[str, tuple[float, float]]
) -> tuple[float, float]:
    if unknown.name in bounds:
        return bounds[unknown.name]
    if unknown.name in problem.names and _only_in_angles(problem, unknown):
        return (-math.pi, math.pi)
    advice = (
        f"give bounds for {unknown.name} to engdyn.equilibria: bounds={{{unknown.name!r}: (lower, upper)}}"
    )
    if unknown.key[2:] == (1,):
        advice += f", or prescribe it: rates={{{unknown.name.removesuffix('_d')!r}: number}}"
    raise EngdynError(advice)


def _only_in_angles(problem: SteadyProblem, unknown: Unknown) -> bool:
    """Whether an unknown occurs nowhere but in sines and cosines of whole multiples of itself."""
    ring = problem.ring
    at, seen = ring.index[unknown.key], set()
    waiting = {i for row in problem.rows for i in row.generators()}
    while waiting:
        i = waiting.pop()
        definition = ring.definitions.get(i)
        if i == at or (definition is not None and at in definition.contains):
            return False
        whole = ring.keys[i][0] in ("sine", "cosine") and ring.keys[i][1:] == (unknown.key[1], 1)
        if definition is not None and not whole and i not in seen:  # inside a root, say
            seen.add(i)
            waiting |= {j for argument in definition.arguments for j in argument.generators()}
    return True


def is_periodic(problem: SteadyProblem, unknown: Unknown, region: tuple[float, float]) -> bool:
    """Whether a region is one whole turn of an angle in which the equations repeat."""
    whole = abs(region[1] - region[0] - 2 * math.pi) < 1e-9
    return whole and unknown.name in problem.names and _only_in_angles(problem, unknown)


def _ball_functions(problem: SteadyProblem) -> tuple[Callable, Callable]:
    """The rows and their Jacobian as functions of balls."""
    n = len(problem.unknowns)
    function = _on_balls(problem, [as_products(row) for row in problem.rows])
    keys = [u.key for u in problem.unknowns]
    partials = _on_balls(problem, [e for row in problem.rows for e in slopes(problem.ring, row, keys)])

    def jacobian(z: list[Any]) -> list[list[Any]]:
        flat = partials(z)
        return [list(flat[i * n : (i + 1) * n]) for i in range(n)]

    return function, jacobian


def _on_balls(problem: SteadyProblem, entries: Sequence[Products]) -> Callable[[list[Any]], tuple]:
    constants = [ball(value) for value in problem.constants.values()]
    keys = [*(u.key for u in problem.unknowns), *problem.constants]
    compiled = compile_products(entries, keys, "balls")
    return lambda z: compiled(*z, *constants)


def _complete(
    problem: SteadyProblem,
    roots: Sequence[list[Any]],
    bounds: Mapping[str, tuple[float, float]],
    region: Region | None,
) -> list[Equilibrium]:
    """Equilibria from enclosures of the unknowns: eliminated unknowns added, bounds and inertia checked."""
    follow = (
        _on_balls(problem, [as_products(e) for _, e in problem.eliminated])
        if problem.eliminated
        else lambda z: ()
    )
    found = []
    for z in roots:
        solution = dict(zip((u.name for u in problem.unknowns), z, strict=True))
        solution |= dict(zip((u.name for u, _ in problem.eliminated), follow(z), strict=True))
        if any(not _inside(solution[name], bounds[name]) for name in solution if name in bounds):
            continue
        equilibrium = _equilibrium(problem, {name: _middle(b) for name, b in solution.items()})
        wanted = region is None or region(equilibrium.q, equilibrium.values)
        if wanted and not _is_singular(problem, solution, equilibrium):
            found.append(equilibrium)
    return sorted(found, key=lambda e: tuple(np.round(e.q, 9)))


def _middle(b: Any) -> float:
    """The middle of an enclosure; zero where it holds zero, so that rounding is not shown."""
    return 0.0 if contains_zero(b) and is_finite(b) else 0.5 * (lower(b) + upper(b))


def _inside(b: Any, bounds: tuple[float, float]) -> bool:
    """Whether an enclosed value lies within bounds or on their edge."""
    return not is_finite(b) or not (upper(b) < bounds[0] or lower(b) > bounds[1])


def _is_singular(problem: SteadyProblem, solution: Mapping[str, Any], at: Equilibrium) -> bool:
    """Whether det M may be zero: the coordinates fail there, and a zero of the equations means nothing."""
    eom = problem.eom
    cache = eom.__dict__.setdefault("_compiled", {})
    if "mass on balls" not in cache:
        cache["mass on balls"] = compile_elements(
            [e for row in eom.mass for e in row], eom.arguments, "balls"
        )
    known = [*at.speeds, *parameter_values(eom, at.values), *input_values(eom, at.inputs, at.values), 0.0]
    q = [solution.get(name, ball(float(x))) for name, x in zip(problem.names, at.q, strict=True)]
    flat = [ball(entry) for entry in cache["mass on balls"](*q, *(ball(float(x)) for x in known))]
    n = len(at.speeds)
    return contains_zero(_determinant([flat[i * n : (i + 1) * n] for i in range(n)]))


def _determinant(matrix: Sequence[Sequence[Any]]) -> Any:
    """Laplace expansion: division-free, and the matrices are small."""
    if not matrix:
        return ball(1.0)
    total = ball(0.0)
    for j, entry in enumerate(matrix[0]):
        minor = _determinant([[*row[:j], *row[j + 1 :]] for row in matrix[1:]])
        total = total + entry * minor if j % 2 == 0 else total - entry * minor
    return total


def _equilibrium(problem: SteadyProblem, solution: Mapping[str, float]) -> Equilibrium:
    """The equilibrium of a solution."""
    eom, names = problem.eom, problem.names
    q = np.array([solution.get(name, 0.0) for name in names])
    owners = [u.expr.func.__name__ if u.is_Derivative else u.func.__name__ for u in eom.speeds]
    speeds = np.array([solution.get(f"{n}_d", float(problem.rates.get(n, 0))) for n in owners])
    udot = np.array([solution.get(f"{n}_dd", float(problem.accelerations.get(n, 0))) for n in owners])
    inputs = {
        **problem.inputs,
        **{key[1].func.__name__: solution[key[1].func.__name__] for key in problem.free},
    }
    values = {p.name: float(problem.values[p.name]) for p in eom.parameters} | dict(problem.values)
    mass, force = mass_and_force(eom, q, speeds, values, inputs)
    residual = float(np.max(np.abs(mass @ udot - force), initial=0.0))
    return Equilibrium(q, speeds, udot, inputs, values, residual, tuple(names))
