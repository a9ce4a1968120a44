"""Checks of the matrix that need motion: frequency response, simulation, measured data.

Every check has an oracle of its own, and notices a corrupted input, as those of
:mod:`engdyn.course.matrix_checks`.  Appendix A.
"""

from __future__ import annotations

import numpy as np
import sympy as sm
from sympy.physics.vector import dynamicsymbols

from engdyn.analysis.damped_modes import damped_modes
from engdyn.analysis.linear import LinearSystem, linearize
from engdyn.analysis.response import frequency_response
from engdyn.analysis.results import Equilibrium
from engdyn.analysis.simulation import simulate
from engdyn.analysis.stability import stability
from engdyn.course.failure import CORRUPTION, CheckFailure
from engdyn.errors import EngdynError
from engdyn.experiment.fitting import fit
from engdyn.experiment.identification import log_decrement
from engdyn.experiment.virtual_test import Sensor, virtual_test
from engdyn.record import Record
from engdyn.system import System

__all__ = ["measured", "response", "simulation"]

SMALL = 1e-5
"""Amplitude of a motion that is linear for all purposes, as a share of a radian or of a coordinate's room."""

HEAVY = 0.3
"""Damping ratio above which a decay has too few maxima for a decrement."""

PERFECT = Sensor("perfect", "-", 1.0, 1.0, 1e12)
"""Nothing but the converter stands between a motion and its record."""


def response(system: System, corrupt: bool) -> str:
    """The steady state that is predicted under a harmonic input, against the nonlinear equations.

    A simulation that starts on the predicted steady state must follow it for a whole period. Corrupted,
    the prediction is one percent too large.
    """
    state, linear = _stable(system)
    turning = set(linear.changing_inputs)
    name = next((i.name for i in system.inputs if i.name not in turning and i.kind != "drive angle"), None)
    if name is None:  # forces that turn, seen from the coordinates: there is no single amplitude
        return _refused(linear, system.inputs[0].name, corrupt)
    n, omega = len(state.q), 0.8 * float(np.min(np.abs(damped_modes(linear).eigenvalues)))
    outputs = [*linear.coordinates, *_rates(system)]
    H = frequency_response(linear, np.array([omega / (2 * np.pi)]), name, outputs).response[:, 0]
    amplitude = SMALL / float(np.max(np.abs(H[:n]) / _rooms(system)))
    times = np.linspace(0.0, 2 * np.pi / omega, 9)
    X = H * amplitude * (CORRUPTION if corrupt else 1.0)
    at_rest = np.concatenate([state.q, state.speeds])[:, None]
    predicted = at_rest + (X[:, None] * np.exp(1j * omega * times)).real
    predicted[:n] += np.outer(_travel(system, state), times)
    constant = state.inputs.get(name, 0.0)
    wave = constant + amplitude * sm.cos(omega * dynamicsymbols._t)
    run = simulate(
        system.equations, (predicted[:n, 0], predicted[n:, 0]), times, state.values,
        {**state.inputs, name: wave}, rtol=1e-10, atol=1e-9 * float(np.max(np.abs(X))),
    )  # fmt: skip
    error = float(np.max(np.abs(run.q.T - predicted[:n]) / np.max(np.abs(X[:n]))))
    if not error < 1e-3:
        raise CheckFailure(f"the motion leaves the predicted steady state by {error:.2g} of its amplitude")
    return f"{name} at {omega / (2 * np.pi):.3g} Hz: a period within {error:.0e} of the nonlinear motion"


def simulation(system: System, corrupt: bool) -> str:
    """A push from an equilibrium: energy or power balanced, and Newton's equations arrive where Lagrange's do.

    Corrupted, one derivation has its last parameter, which is gravity for most, one percent larger.
    """
    state, linear = _stable(system)
    slowest = float(np.min(np.abs(damped_modes(linear).eigenvalues)))
    times = np.linspace(0.0, 2 * np.pi / slowest, 41)
    push = 0.05 * _rooms(system) * np.where(np.arange(len(state.q)) % 2, -1.0, 1.0)
    rates = (
        np.where(np.arange(len(state.speeds)) % 2, 1.0, -1.0)
        * 0.05
        * slowest
        * _rooms(system)[: len(state.speeds)]
    )
    initial = state.q + push, state.speeds + rates
    options = {"inputs": state.inputs, "rtol": 1e-10, "atol": 1e-12}
    run = simulate(system.equations, initial, times, state.values, **options)
    other = dict(state.values)
    if corrupt:
        influential = [p.name for p in system.equations.parameters if other[p.name]]
        other |= {name: CORRUPTION * other[name] for name in influential[-3:]}
    twin = simulate(system.newton(), initial, times, other, **options)
    moved = np.max(np.abs(run.q - run.q[0]), axis=0)
    apart = float(np.max(np.abs(run.q - twin.q)[-1] / np.where(moved > 0, moved, 1.0)))
    if not apart < 1e-7:
        raise CheckFailure(f"Newton's and Lagrange's motions end {apart:.2g} of their way apart")
    error = run.audit.error
    if not error < 1e-6:
        raise CheckFailure(f"the balance of energy is {error:.2g} off")
    return f"{times[-1]:.3g} s: both derivations within {apart:.0e}, energy balanced to {error:.0e}"


def measured(system: System, corrupt: bool) -> str:
    """Frequency and damping of the least damped mode, from a simulated record, against the eigenvalue.

    Corrupted, the record claims a rate that is two percent larger.
    """
    state, linear = _stable(system)
    modes = damped_modes(linear)
    k = int(np.argmin(modes.damping_ratio))
    shape, value, n = modes.state_shapes[:, k], modes.eigenvalues[k], len(state.q)
    place = int(np.argmax(np.abs(shape[:n]) / _rooms(system)))
    shape = shape * (SMALL * _rooms(system)[place] / shape[place])
    periods = float(np.clip(1.5 / modes.damping_ratio[k], 4.0, 12.0))
    times = np.linspace(0.0, periods * 2 * np.pi / value.imag, round(400 * periods))
    initial = state.q + shape[:n].real, state.speeds + shape[n:].real
    run = simulate(
        system.equations, initial, times, state.values, state.inputs, rtol=1e-11, atol=1e-9 * SMALL
    )
    deviation = (run.q[:, place] - state.q[place] - _travel(system, state)[place] * times) / np.max(
        np.abs(shape[:n])
    )
    rate = 100 * value.imag / (2 * np.pi)
    record = virtual_test(run, PERFECT, deviation, rate=rate, bits=24, antialias=False)
    claimed = Record(record.samples, rate * (1.02 if corrupt else 1.0))
    frequency, damping = _identified(claimed, float(modes.damping_ratio[k]))
    for what, told, expected, most in (
        ("frequency", frequency, value.imag / (2 * np.pi), 0.01),
        ("damping ratio", damping, float(modes.damping_ratio[k]), 0.1),
    ):
        if not abs(told - expected) < most * abs(expected):
            raise CheckFailure(f"the identified {what} is {told:.4g}, the eigenvalue says {expected:.4g}")
    return f"{frequency:.4g} Hz, damping ratio {damping:.3g} identified"


def _identified(record: Record, about: float) -> tuple[float, float]:
    """Damped frequency [Hz] and damping ratio of a decay; by a fitted curve where it hardly swings."""
    if about < HEAVY:
        found = log_decrement(record)
        return found.damped_frequency, found.damping_ratio

    def decay(t: np.ndarray, size: float, decrease: float, omega: float, phase: float) -> np.ndarray:
        return size * np.exp(-decrease * t) * np.cos(omega * t + phase)

    start = {
        "size": 1.0,
        "decrease": 0.05 * record.rate,
        "omega": 2 * np.pi * record.rate / 100,
        "phase": 0.0,
    }
    found = fit(record.time - record.start, record.samples, decay, start)
    decrease, omega = found["decrease"], abs(found["omega"])
    return omega / (2 * np.pi), decrease / np.hypot(decrease, omega)


def _stable(system: System) -> tuple[Equilibrium, LinearSystem]:
    """The first stable equilibrium, linearized."""
    for state in system.equilibria():
        linear = linearize(system.equations, state)
        if state.regular is None and stability(linear).stable:
            return state, linear
    raise CheckFailure("there is no stable equilibrium to move about")


def _refused(linear: LinearSystem, name: str, corrupt: bool) -> str:
    """What has no stationary amplitude must not get one."""
    try:
        frequency_response(linear, np.array([1.0]), name, linear.coordinates[0])
    except EngdynError as error:
        if corrupt:
            raise CheckFailure(str(error)) from error
        return f"{name} turns with the coordinates: refused, as it must be"
    raise CheckFailure(f"the input {name} turns with the coordinates and was given an amplitude")


def _rooms(system: System) -> np.ndarray:
    """What is much of each coordinate: a radian, or half the width of the region."""
    return np.array(
        [
            1.0 if c.unit == "rad" or c.bounds is None else 0.5 * (c.bounds[1] - c.bounds[0])
            for c in system.coordinates
        ]
    )


def _rates(system: System) -> list[str]:
    """Names of the speeds as outputs."""
    return [f"{u.expr.func.__name__}'" for u in system.equations.speeds]


def _travel(system: System, state: Equilibrium) -> np.ndarray:
    """Rates at which coordinates go on along a steady motion [m/s, rad/s]."""
    speeds = dict(zip(_rates(system), state.speeds, strict=True))
    return np.array([speeds.get(f"{c.name}'", 0.0) for c in system.coordinates])
