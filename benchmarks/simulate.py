"""Simulating: engdyn against scipy on lambdified equations, and PyDy.

    python -m benchmarks.simulate [--quick] [--rounds N] [--members N]

A double pendulum swings for 20 s, wanted at 1000 times with a relative tolerance of 1e-9. All tools have their
turns in one interleaved run, warm; the column "error" is the largest deviation of an angle from a run at 1e-13,
so that nobody is fast by being wrong. "First use" begins with a system never seen before: derivation, compiling
and the run, beside the time in which PyDy compiles alone (wall clock). The ensemble is timed against a loop
over solve_ivp, of which a part is run and the rest extrapolated (wall clock). The last table shows one evaluation
of the right-hand side: called from Python, and from compiled code. Tools that are not installed are named.

How to read the tables: milliseconds; "ratio" is the time of a tool over that of engdyn.
"""

from __future__ import annotations

import argparse
import itertools
import os
import time
from collections.abc import Callable, Sequence
from functools import partial
from typing import Any

import numpy as np
import sympy as sm
from scipy.integrate import odeint, solve_ivp
from sympy.physics.mechanics import dynamicsymbols

import engdyn as ed
from benchmarks import models
from benchmarks.timing import forget, heading, interleaved
from engdyn.algebra.codegen import has_numba

VALUES = {"m": 1.0, "l": 1.0, "g": 9.81}
START = np.array([1.0, 0.6]), np.array([0.0, 0.0])
TIMES = np.linspace(0.0, 20.0, 1000)
RTOL, ATOL = 1e-9, 1e-12

numbers = itertools.count(1)


def equations(model: models.Model) -> ed.EquationsOfMotion:
    return ed.lagrange(model.kinetic, model.potential, model.coordinates)


def simulated(eom: ed.EquationsOfMotion, rtol: float = RTOL) -> np.ndarray:
    return ed.simulate(eom, START, TIMES, VALUES, rtol=rtol, atol=ATOL).q


def without_numba(eom: ed.EquationsOfMotion) -> np.ndarray:
    os.environ["ENGDYN_NUMBA"] = "0"
    try:
        return simulated(eom)
    finally:
        del os.environ["ENGDYN_NUMBA"]


def plain(eom: ed.EquationsOfMotion) -> tuple[sm.Matrix, sm.Matrix, list, list]:
    """M, f, coordinates and speeds with symbols of their own for the speeds."""
    u = list(dynamicsymbols(f"u:{len(eom.coordinates)}"))
    back = dict(zip(eom.speeds, u, strict=True))
    return eom.mass_matrix.xreplace(back), eom.forcing.xreplace(back), list(eom.coordinates), u


def lambdified(
    eom: ed.EquationsOfMotion, values: dict[str, float]
) -> Callable[[float, np.ndarray], np.ndarray]:
    """What one writes without engdyn: lambdify, and numpy's solver for M."""
    M, f, q, u = plain(eom)
    n = len(q)
    evaluate = sm.lambdify([*q, *u, *eom.parameters], [M, f], cse=True)
    given = [values[p.name] for p in eom.parameters]

    def derivative(t: float, x: np.ndarray) -> np.ndarray:
        mass, force = evaluate(*x, *given)
        return np.concatenate([x[n:], np.linalg.solve(mass, force)[:, 0]])

    return derivative


def by_scipy(
    derivative: Callable[..., np.ndarray], start: np.ndarray, times: np.ndarray = TIMES
) -> np.ndarray:
    ends = times[0], times[-1]
    return solve_ivp(derivative, ends, start, "DOP853", times, rtol=RTOL, atol=ATOL).y[: len(start) // 2].T


def pydy(eom: ed.EquationsOfMotion) -> Callable[..., np.ndarray] | None:
    """PyDy's cython right-hand side; None where PyDy or a compiler is missing."""
    try:
        from pydy.codegen.ode_function_generators import generate_ode_function
    except ImportError:
        return None
    M, f, q, u = plain(eom)
    mass = sm.diag(sm.eye(len(q)), M)
    return generate_ode_function(
        sm.Matrix([*u, *f]), q, u, list(eom.parameters), mass_matrix=mass, generator="cython"
    )


def warm_runs(rounds: int) -> None:
    eom = equations(models.double_pendulum())
    exact, start = simulated(eom, 1e-13), np.concatenate(START)
    tools: dict[str, Callable[[], np.ndarray]] = {
        "engdyn": partial(simulated, eom),
        "engdyn without numba": partial(without_numba, eom),
        "solve_ivp + lambdify": partial(by_scipy, lambdified(eom, VALUES), start),
    }
    f = pydy(eom)
    if f is None:
        print("PyDy is not installed: left out")
    else:
        given = np.array([VALUES[p.name] for p in eom.parameters])
        tools["PyDy cython + odeint"] = lambda: odeint(
            f, start, TIMES, args=(given,), rtol=RTOL, atol=ATOL, mxstep=5000
        )[:, :2]
    for tool in tools.values():
        tool()
    times, results = interleaved({k: partial(lambda t: t, v) for k, v in tools.items()}, rounds, 120.0, True)
    print(f"\n{'20 s of a double pendulum':28}{'ms':>10}{'ratio':>9}{'error':>11}")
    for name, found in times.items():
        error = np.max(np.abs(results[name] - exact))
        print(f"{name:28}{found:10.2f}{found / times['engdyn']:8.1f}×{error:11.1e}")


def first_use() -> None:
    def new() -> ed.EquationsOfMotion:
        """A double pendulum with a spring that no system before had."""
        model = models.double_pendulum()
        stiffness = sm.Rational(next(numbers) + int(time.time()), 10**10)
        a = model.coordinates[0]
        return ed.lagrange(model.kinetic, model.potential + stiffness * a**2, model.coordinates)

    ed.simulate(new(), START, TIMES, VALUES)  # imports, and the driver, which is compiled once for all
    spent = []
    for _ in range(3):
        forget()
        begin = time.perf_counter()
        simulated(new())
        spent.append(time.perf_counter() - begin)
    print(f"\nfirst use of a new system: derived, compiled, run {1e3 * min(spent):8.0f} ms")
    eom = new()
    eom.mass_matrix, eom.forcing  # noqa: B018 - expressions are made before the clock runs
    begin = time.perf_counter()
    if pydy(eom) is not None:
        print(
            f"PyDy compiles a new system in                     {1e3 * (time.perf_counter() - begin):8.0f} ms"
        )


def many(members: int) -> None:
    eom = equations(models.double_pendulum())
    random, times = np.random.default_rng(1), np.linspace(0.0, 10.0, 11)
    q, u = random.uniform(-2, 2, (members, 2)), np.zeros(2)
    ed.ensemble(eom, (q[:2], u), times, VALUES, rtol=RTOL, atol=ATOL)
    begin = time.perf_counter()
    found = ed.ensemble(eom, (q, u), times, VALUES, rtol=RTOL, atol=ATOL).q
    ours = time.perf_counter() - begin
    derivative, part = lambdified(eom, VALUES), min(members, 10)
    begin = time.perf_counter()
    peer = [by_scipy(derivative, np.concatenate([row, u]), times) for row in q[:part]]
    loop = (time.perf_counter() - begin) / part * members
    apart = np.max(np.abs(np.array(peer)[:, 1] - found[:part, 1]))  # after 1 s: chaos is still young
    print(
        f"\n{members} double pendulums for 10 s: {ours:.2f} s on {os.cpu_count()} cores; loop over solve_ivp "
        f"{loop:.0f} s (from {part}); ratio {loop / ours:.0f}×; apart after 1 s by {apart:.0e}"
    )


def evaluations() -> None:
    print(f"\n{'one evaluation, ns':28}{'lambdify':>10}{'math':>8}{'compiled':>10}")
    for links in (1, 4):
        model = models.cart_with_links(links)
        eom = equations(model)
        values = {p.name: 1.0 for p in eom.parameters}
        x = np.full(2 * len(eom.coordinates), 0.3)
        slow, own = lambdified(eom, values), eom.function(values)
        found = [_each(partial(f, 0.0, x), 2000) for f in (slow, own)]
        np.testing.assert_allclose(own(0.0, x), slow(0.0, x), rtol=1e-10, atol=1e-12)
        compiled = f"{_in_compiled_loop(eom, values, x):10.0f}" if has_numba() else "  no numba"
        print(f"{model.name:28}{found[0]:10.0f}{found[1]:8.0f}{compiled}")


def _each(work: Callable[[], Any], count: int) -> float:
    work()
    begin = time.process_time()
    for _ in range(count):
        work()
    return 1e9 * (time.process_time() - begin) / count


def _in_compiled_loop(eom: ed.EquationsOfMotion, values: dict[str, float], x: np.ndarray) -> float:
    from numba import njit

    from engdyn.analysis.dop853 import SIGNATURE
    from engdyn.modeling.derivative import derivative_of

    code = derivative_of(eom)
    p = np.zeros(len(code.slots))
    p[: len(eom.parameters)] = [values[s.name] for s in eom.parameters]
    f = code.machine(SIGNATURE)

    @njit
    def loop(f: Any, x: np.ndarray, p: np.ndarray, out: np.ndarray, count: int) -> None:
        for i in range(count):
            x[0] = 0.3 + 1e-9 * i
            f(0.0, x, p, out)

    count = 200_000
    out = np.empty_like(x)
    return _each(lambda: loop(f, x.copy(), p, out, count), 5) / count


def main(arguments: Sequence[str] | None = None) -> None:
    """Run and print the tables."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--quick", action="store_true", help="one round, a small ensemble")
    parser.add_argument("--rounds", type=int, default=7)
    parser.add_argument("--members", type=int, default=10_000)
    chosen = parser.parse_args(arguments)
    print(heading())
    warm_runs(1 if chosen.quick else chosen.rounds)
    first_use()
    many(200 if chosen.quick else chosen.members)
    evaluations()


if __name__ == "__main__":
    main()
