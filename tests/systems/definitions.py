"""What the tests of the systems share: definitions as data, and an oracle that knows nothing of the package.

The definition's T, V, D and Q are typed once more as functions of numbers, and Lagrange's equations are
formed from them by differences in 60-digit arithmetic.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable
from dataclasses import dataclass, field
from types import SimpleNamespace

import mpmath
import numpy as np
import pytest
from scipy.optimize import fsolve
from sympy.physics.mechanics import Particle, RigidBody

import engdyn as ed
from engdyn import shapes
from engdyn.plots.words import symbol

mpmath.mp.dps = 60

STIFFNESS_OR_DAMPING = {"N/m", "N/m^3", "N m/rad", "N m/rad^3", "N s/m", "N m s/rad"}


@dataclass(frozen=True)
class Definition:
    """A system as the catalogue defines it.

    Parameters as text "name unit default; ...", coordinates as (name, unit, bounds), inputs as (name, unit,
    kind), formulas T, V, D and the Q of each coordinate as functions of the numbers and of sin, cos, sqrt.
    """

    number: int
    key: str
    parameters: str
    coordinates: list[tuple]
    inputs: list[tuple]
    formulas: tuple[Callable, ...]
    signed: set[str] = field(default_factory=set)  # parameters that may be negative
    may_be_zero: set[str] = field(default_factory=set)  # besides stiffness and damping
    unbounded: set[str] = field(default_factory=set)  # coordinates that are searched for without bounds
    input_size: float = 2.0
    rate_size: float = 3.0

    @property
    def names(self):
        return [name for name, *_ in self.coordinates]

    @property
    def table(self):
        rows = [row.split() for row in self.parameters.split("; ")]
        return [(name, unit.replace("_", " "), float(default)) for name, unit, default in rows]

    def load(self):
        return ed.systems.load(self.number)


def assert_described_as(definition):
    """Names, units, defaults and admissible values of a system are those of its definition."""
    system = definition.load()
    assert (system.number, system.key) == (definition.number, definition.key)
    assert [(p.name, p.unit, p.default) for p in system.parameters] == definition.table
    assert [(c.name, c.unit, c.bounds) for c in system.coordinates] == definition.coordinates
    assert [(i.name, i.unit, i.kind) for i in system.inputs] == definition.inputs
    for p in system.parameters:
        zero = p.unit in STIFFNESS_OR_DAMPING or p.name in definition.may_be_zero
        assert (p.admissible == "any") == (p.name in definition.signed | {"g"}), p.name
        assert (p.admissible == "nonnegative") == zero, p.name
    for c in system.coordinates:
        sought = c.bounds is not None or c.name in definition.unbounded
        assert c.kind == (("angle" if c.unit == "rad" else "length") if sought else "ignorable")


# Two derivations


def assert_proved_and_independent(system, monkeypatch):
    """Both derivations agree, and neither uses what the other one starts from."""
    assert system.prove().verdict == "proved"

    def forbidden(*_):
        raise AssertionError("this route must not be used")

    with monkeypatch.context() as patch:
        for name in ("kinetic_energy", "potential_energy", "dissipation", "generalized_forces"):
            patch.setattr(ed.System, name, property(forbidden))
        alone = system.newton()
    with monkeypatch.context() as patch:
        patch.setattr(ed.System, "free_bodies", forbidden)
        other = system.lagrange()
    assert ed.prove_equal(alone, other)
    assert set(alone.reactions) == set(system.unknowns)


def newton_with(system, bodies):
    """Newton's equations with other free bodies."""
    return ed.newton_euler(bodies, [c.symbol for c in system.coordinates], system.frame, system.unknowns)


def changed_loads(numbers):
    """(system, body, load, factor) for every load of every body."""
    for number in numbers:
        for b, body in enumerate(ed.systems.load(number).free_bodies()):
            for i in range(len(body.applied)):
                for factor in (0, -1, 2):
                    yield pytest.param(
                        number, b, i, factor, id=f"S{number:02d}-{body.name}-{i}-times{factor}"
                    )


def verdict_of_changed_load(system, b, i, factor):
    """Verdict on Newton's equations with one load multiplied, and the name of its body."""
    bodies = system.free_bodies()
    loads = list(bodies[b].applied)
    where, vector = loads[i]
    loads[i] = type(loads[i])(where, factor * vector)
    if not factor:
        del loads[i]
    bodies[b] = ed.FreeBody(bodies[b].body, loads, bodies[b].reactions)
    return ed.prove_equal(newton_with(system, bodies), system.lagrange()).verdict, bodies[b].name


def changed_energies(numbers):
    """(system, energy or coordinate, term) for every term of the energies and generalized forces."""
    for number in numbers:
        system = ed.systems.load(number)
        for name in ("kinetic_energy", "potential_energy", "dissipation"):
            for i in range(len(getattr(system, name).as_ordered_terms())):
                yield pytest.param(number, name, i, id=f"S{number:02d}-{name}-{i}")
        for q, force in system.generalized_forces.items():
            for i in range(len(force.as_ordered_terms())):
                yield pytest.param(number, q, i, id=f"S{number:02d}-Q-{q.func}-{i}")


def assert_changed_energy_is_refuted(number, name, i):
    """A term of an energy or of a generalized force that is dropped, reversed or doubled is found out."""
    reference = ed.systems.load(number).newton()
    for factor in (0, -1, 2):
        system = ed.systems.load(number)
        moving = True
        if isinstance(name, str):
            whole = getattr(system, name)
            term = whole.as_ordered_terms()[i]
            setattr(system, name, whole + (factor - 1) * term)
            moving = any(term.has(c.symbol) for c in system.coordinates)
        else:
            force = system.generalized_forces[name]
            system.generalized_forces[name] = force + (factor - 1) * force.as_ordered_terms()[i]
        if name == "potential_energy" and not moving:
            assert ed.prove_equal(reference, system.lagrange())  # the potential of what is prescribed
        elif name == "kinetic_energy" and any(
            system.kinetic_energy.diff(c.symbol.diff()) == 0 for c in system.coordinates
        ):
            with pytest.raises(ed.EngdynError, match="singular mass matrix"):
                system.lagrange()
        else:
            assert ed.prove_equal(reference, system.lagrange()).verdict == "refuted"


def assert_other_masses_are_refuted(system):
    """Twice the mass or the inertia of any body is found out."""
    count = 0
    for b, body in enumerate(system.free_bodies()):
        bodies, old = system.free_bodies(), body.body
        if isinstance(old, Particle):
            changed = [Particle(old.name, old.point, 2 * old.mass)]
        else:
            place, tensor = old.masscenter, old.central_inertia
            changed = []
            if tensor != 0:
                changed.append(RigidBody(old.name, place, old.frame, old.mass, (2 * tensor, place)))
            if old.mass != 0:
                changed.append(RigidBody(old.name, place, old.frame, 2 * old.mass, (tensor, place)))
        for new in changed:
            bodies[b] = ed.FreeBody(new, body.applied, body.reactions)
            assert ed.prove_equal(newton_with(system, bodies), system.lagrange()).verdict == "refuted"
            count += 1
    assert count >= len(system.free_bodies())


# Accelerations


class Moving:
    """A random state of a system: numbers for everything, and where they lead at the time h."""

    def __init__(self, definition, seed):
        source = np.random.default_rng([definition.number, seed])
        self.definition, self.names = definition, definition.names
        signed = definition.signed
        self.values = {name: default * source.uniform(0.6, 1.4) for name, _, default in definition.table}
        self.values |= {name: x * source.choice([-1, 1]) for name, x in self.values.items() if name in signed}
        regions = [bounds or (-3.0, 3.0) for *_, bounds in definition.coordinates]
        self.q = [source.uniform(*region) for region in regions]
        self.u = [source.normal() * definition.rate_size for _ in self.q]
        size = definition.input_size
        self.inputs = {name: tuple(size * source.normal(size=3)) for name, *_ in definition.inputs}

    def at(self, h, acceleration):
        """All numbers at the time h of a motion with constant accelerations."""
        mp = mpmath.mpf
        found = {name: mp(x) for name, x in self.values.items()}
        motion = [*zip(self.names, self.q, self.u, acceleration, strict=True)]
        motion += [(name, *triple) for name, triple in self.inputs.items()]
        for name, x, rate, gain in motion:
            found[name] = mp(x) + mp(rate) * h + mp(gain) * h**2 / 2
            found[f"{name}_d"] = mp(rate) + mp(gain) * h
        return SimpleNamespace(**found)


class Given(Moving):
    """A given state of a system."""

    def __init__(self, definition, q, u, values, inputs):
        self.definition, self.names = definition, definition.names
        self.q, self.u, self.values = list(q), list(u), dict(values)
        self.inputs = {name: (0.0, 0.0, 0.0) for name, *_ in definition.inputs}
        for name, x in inputs.items():
            self.inputs[name] = (float(x), 0.0, 0.0) if np.ndim(x) == 0 else tuple(x)


FUNCTIONS = (mpmath.sin, mpmath.cos, mpmath.sqrt)
STEP = mpmath.mpf(10) ** -15


def slope(function, numbers, name):
    """Derivative of a formula by one of its numbers."""
    ends = []
    for sign in (1, -1):
        moved = SimpleNamespace(**vars(numbers))
        setattr(moved, name, getattr(numbers, name) + sign * STEP)
        ends.append(function(moved, *FUNCTIONS))
    return (ends[0] - ends[1]) / (2 * STEP)


def lagrange_residual(state, acceleration):
    """d/dt(dT/dq_d) - dT/dq + dV/dq + dD/dq_d - Q, each derivative by differences."""
    kinetic, potential, dissipation, *forces = state.definition.formulas
    now = state.at(mpmath.mpf(0), acceleration)
    later, before = state.at(STEP, acceleration), state.at(-STEP, acceleration)
    rows = []
    for name, force in zip(state.names, forces, strict=True):
        momentum = [slope(kinetic, numbers, f"{name}_d") for numbers in (later, before)]
        row = (momentum[0] - momentum[1]) / (2 * STEP) - slope(kinetic, now, name)
        row += slope(potential, now, name) + slope(dissipation, now, f"{name}_d")
        rows.append(row - force(now, *FUNCTIONS))
    return mpmath.matrix(rows)


def oracle_accelerations(state):
    """Accelerations from the formulas of the definition."""
    n = len(state.names)
    at_rest = lagrange_residual(state, [0] * n)
    mass = mpmath.matrix(n, n)
    for j in range(n):
        mass[:, j] = lagrange_residual(state, [int(i == j) for i in range(n)]) - at_rest
    return [float(x) for x in mpmath.lu_solve(mass, -at_rest)]


def assert_accelerations(definition, seed):
    """Both derivations give the accelerations of the oracle at a random state."""
    state, system = Moving(definition, seed), definition.load()
    expected = oracle_accelerations(state)
    for eom in (system.newton(), system.lagrange()):
        found = eom.accelerations(state.q, state.u, state.values, state.inputs)
        assert found == pytest.approx(expected, rel=1e-9, abs=1e-9)


# Equilibria and steady motions


def steady_gradient(definition, at):
    """d(V - T)/dq - Q of every coordinate at constant rates, by complex steps."""
    kinetic, potential, _, *forces = definition.formulas
    functions = (np.sin, np.cos, np.sqrt)
    rows = {}
    for name, force in zip(definition.names, forces, strict=True):
        step = SimpleNamespace(**(at | {name: at[name] + 1e-30j}))
        gradient = np.imag(potential(step, *functions) - kinetic(step, *functions)) / 1e-30
        rows[name] = gradient - np.real(force(SimpleNamespace(**at), *functions))
    return rows


def roots_from_grid(residual, regions, count):
    """Roots of a function in a region, found from a dense grid of starts."""
    found = []
    for start in itertools.product(*(np.linspace(*region, count) for region in regions)):
        root, *_ = fsolve(residual, start, full_output=True, xtol=1e-13)
        inside = all(low < x <= high + 1e-9 for x, (low, high) in zip(root, regions, strict=True))
        new = all(np.max(np.abs(root - other)) > 1e-6 for other in found)
        if inside and new and np.max(np.abs(residual(root))) < 1e-6:
            found.append(root)
    return sorted(found, key=tuple)


def eigenvalues_at(system, equilibrium):
    return ed.eigenvalues(ed.linearize(system.equations, equilibrium))


def unstable(system, equilibrium):
    return int(np.sum(eigenvalues_at(system, equilibrium).real > 1e-9))


def reaction(system, name, q, u, udot, inputs=None, **others):
    """A reaction as a number, all parameters at their defaults; others are further symbols by name."""
    t = system.coordinates[0].symbol.args[0]
    expression = system.newton().reactions[next(x for x in system.unknowns if x.name == name)]
    for order, numbers in ((2, udot), (1, u), (0, q)):
        pairs = zip(system.coordinates, numbers, strict=True)
        expression = expression.subs({(c.symbol.diff(t, order) if order else c.symbol): x for c, x in pairs})
    given = {name: (x, 0.0, 0.0) if np.ndim(x) == 0 else x for name, x in (inputs or {}).items()}
    for order in (2, 1, 0):
        for i in system.inputs:
            known = given.get(i.name, (0.0, 0.0, 0.0))[order]
            expression = expression.subs(i.symbol.diff(t, order) if order else i.symbol, known)
    known = {p.symbol: p.default for p in system.parameters}
    known |= {s: others[s.name] for s in expression.free_symbols if s.name in others}
    return float(expression.subs(known))


# Drawings


def assert_labels_are_readable(system, q):
    """No label of a drawing covers another one or leaves the picture."""
    ax = ed.plots.draw(system, q)
    ax.figure.canvas.draw()
    renderer, frame = ax.figure.canvas.get_renderer(), ax.figure.bbox
    extents = [text.get_window_extent(renderer) for text in ax.texts]
    for extent in extents:
        assert frame.x0 <= extent.x0 < extent.x1 <= frame.x1
        assert frame.y0 <= extent.y0 < extent.y1 <= frame.y1
    for a, b in itertools.combinations(extents, 2):
        assert not a.overlaps(b), (a, b)


def plain(text):
    return text.replace("$", " ").replace(",", " ").replace("{", "").replace("}", "").replace("\\ ", " ")


def assert_drawing_names_what_the_model_holds(system, q):
    """Parameters, coordinates, inputs and gravity are labeled."""
    drawn = system.shapes(q, system.values())
    words = " ".join(plain(getattr(x, "label", "") or getattr(x, "text", "")) for x in drawn).split()
    assert {plain(symbol(p)).strip() for p in system.parameters} <= set(words)
    arrows = [x for x in drawn if isinstance(x, shapes.CoordinateArrow | shapes.AngleArrow)]
    assert sorted(plain(x.label) for x in arrows) == sorted(plain(symbol(c)) for c in system.coordinates)
    pushes = [x for x in drawn if isinstance(x, shapes.ForceArrow | shapes.MomentArrow)]
    pushing = [i for i in system.inputs if i.kind != "drive angle"]
    assert {plain(symbol(i)) for i in pushing} <= {plain(x.label) for x in pushes}
    weight = any(p.name == "g" for p in system.parameters)
    assert any(isinstance(x, shapes.GravityArrow) for x in drawn) == weight
