"""Proving that two derivations agree: engdyn against sympy's simplify and trigsimp(expand).

    python -m benchmarks.prove [--quick] [--limit S] [--rounds N]

Each case holds two derivations of one system as sympy expressions, equation by equation: what
LagrangesMethod and KanesMethod give, or equations written by hand in another form.  The peers must bring
the difference of each pair of equations to zero.  engdyn gets the same equations, translates them into its
ring and decides (``from_residuals`` twice and ``prove_equal``, all of it timed).  In the last case the first
derivation still contains its four reactions: engdyn starts from the free bodies and the energies, the peers
solve the six linear balances first.  Caches are emptied before every turn.

A peer that runs longer than the limit is stopped; "fails" means that it left something else than zero.  Then
one term of each case is changed: engdyn must refute the pair, with a state at which the accelerations differ.

How to read the table: CPU times in milliseconds; "ratio" is the time of simplify over that of engdyn, a lower
bound (≥) where simplify was stopped.
"""

from __future__ import annotations

import argparse
import signal
import statistics
import time
import warnings
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Any

import sympy as sm
from sympy.physics.mechanics import dynamicsymbols

import engdyn as ed
from benchmarks import models
from benchmarks.double_bar import double_bar, double_bar_accelerations
from benchmarks.models import Equations
from benchmarks.timing import forget, heading


@dataclass(frozen=True)
class Case:
    """Two derivations: how engdyn decides on them, the same with a changed term, and what peers must prove."""

    name: str
    decide: Callable[[], ed.Proof]
    decide_changed: Callable[[], ed.Proof]
    differences: Callable[[], list[sm.Expr]]


def of_equations(name: str, coordinates: list, first: Equations, second: Equations) -> Case:
    """Two sets of M and f as equations M q̈ − f; the changed one has its last force larger by a tenth."""
    accelerations = sm.Matrix([q.diff().diff() for q in coordinates])
    a, b = (list(mass * accelerations - force) for mass, force in (first, second))
    changed = [*b[:-1], b[-1] - second[1][-1] / 10]

    def decide(other: list[sm.Expr]) -> ed.Proof:
        return ed.prove_equal(*(ed.EquationsOfMotion.from_residuals(e, coordinates) for e in (a, other)))

    def differences() -> list[sm.Expr]:
        return [x - y for x, y in zip(a, b, strict=True)]

    return Case(name, partial(decide, b), partial(decide, changed), differences)


def of_model(make: Callable[[], models.Model], name: str = "") -> Case:
    """What LagrangesMethod and KanesMethod give for one system."""
    model = make()
    speeds, _ = models.speeds_of(model)
    rates = {u: q.diff() for u, q in zip(speeds, model.coordinates, strict=True)}
    mass, force = (matrix.xreplace(rates) for matrix in models.kane(model))
    return of_equations(name or model.name, model.coordinates, models.lagrangian(model), (mass, force))


def cart_pendulum_with_spring() -> Case:
    """Cart, spring and pendulum, once with the angle and once with half of it."""
    x, a = dynamicsymbols("x a")
    m, M, l, k, g = sm.symbols("m M l k g", positive=True)
    half = a / 2
    sine, cosine = 2 * sm.sin(half) * sm.cos(half), 1 - 2 * sm.sin(half) ** 2

    def equations(s: sm.Expr, c: sm.Expr) -> Equations:
        mass = sm.Matrix([[M + m, m * l * c], [m * l * c, m * l**2]])
        return mass, sm.Matrix([m * l * a.diff() ** 2 * s - k * x, -m * g * l * s])

    return of_equations(
        "cart-pendulum with spring", [x, a], equations(sm.sin(a), sm.cos(a)), equations(sine, cosine)
    )


def stretched_spring() -> Case:
    """A ball on a spring of finite free length, in the plane: components of the force against −∂V/∂q."""
    q = dynamicsymbols("x y")
    m, k, free, g, h, b = sm.symbols("m k L_0 g h b", positive=True)
    arm = sm.Matrix([q[0] - b, q[1] + h])
    length = sm.sqrt(arm.dot(arm))
    mass = m * sm.eye(2)
    newton = -k * (arm.dot(arm) - free * length) / arm.dot(arm) * arm - sm.Matrix([0, m * g])
    potential = k * (length - free) ** 2 / 2 + m * g * q[1]
    return of_equations(
        "stretched spring (√)", q, (mass, newton), (mass, -sm.Matrix([potential]).jacobian(q).T)
    )


def with_reactions() -> Case:
    """Two hinged bars: six balances with four reactions against Lagrange's equations."""
    model = double_bar()

    def decide(share: sm.Expr) -> ed.Proof:
        newton = ed.newton_euler(model.free_bodies, model.coordinates, model.frame, model.unknowns)
        return ed.prove_equal(newton, ed.lagrange(model.kinetic, share * model.potential, model.coordinates))

    def differences() -> list[sm.Expr]:
        mass, force = models.lagrangian(model)
        return list(mass * double_bar_accelerations() - force)

    return Case(
        "two bars, 4 reactions", partial(decide, sm.S.One), partial(decide, sm.Rational(11, 10)), differences
    )


def cases(quick: bool) -> list[Case]:
    """All cases of the table."""
    found = [
        of_model(models.double_pendulum),
        cart_pendulum_with_spring(),
        of_model(partial(models.catalogue_system, "W03"), "roll on a wedge"),
        of_model(models.heavy_top),
        stretched_spring(),
    ]
    if not quick:
        found += [of_model(partial(models.cart_with_links, 5)), with_reactions()]
    return found


def limited(work: Callable[[], Any], limit: float) -> tuple[float, Any]:
    """CPU milliseconds and result of some work; None where it took longer than `limit` seconds."""

    def stop(*_: Any) -> None:
        raise TimeoutError

    before = signal.signal(signal.SIGALRM, stop)
    signal.setitimer(signal.ITIMER_REAL, limit)
    start = time.process_time()
    try:
        result = work()
    except TimeoutError:
        result = None
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0.0)
        signal.signal(signal.SIGALRM, before)
    return 1e3 * (time.process_time() - start), result


def peer(case: Case, bring_to_zero: Callable[[sm.Expr], sm.Expr], limit: float) -> tuple[float, str]:
    """Time of a peer, and how it ended."""
    forget()
    spent, left = limited(lambda: [bring_to_zero(e) for e in case.differences()], limit)
    if left is None:
        return spent, "stopped"
    return spent, "proved" if all(e == 0 for e in left) else "fails"


def decided(work: Callable[[], ed.Proof], rounds: int) -> tuple[float, ed.Proof]:
    """Median CPU milliseconds of engdyn, and its verdict."""
    times = []
    for _ in range(rounds):
        forget()
        start = time.process_time()
        proof = work()
        times.append(1e3 * (time.process_time() - start))
    return statistics.median(times), proof


def main(arguments: list[str] | None = None) -> None:
    """Run and print the table."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--quick", action="store_true", help="small systems, one round")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--limit", type=float, default=100.0, help="seconds for one call of a peer")
    options = parser.parse_args(arguments)
    warnings.filterwarnings("ignore", message="(?s).*automatically calculated based on point")
    print(f"{heading()}; medians of {options.rounds} rounds, caches empty\n")
    head = f"{'case':28}{'engdyn':>9}{'simplify':>12}{'':9}{'trigsimp(expand)':>18}"
    print(head + f"{'':9}{'ratio':>8}   changed term")
    peers = {"simplify": sm.simplify, "trigsimp": lambda e: sm.trigsimp(sm.expand(e))}
    for case in cases(options.quick):
        mine, proof = decided(case.decide, 1 if options.quick else options.rounds)
        _, changed = decided(case.decide_changed, 1)
        if proof.verdict != "proved" or changed.verdict != "refuted":
            raise AssertionError(f"{case.name}: {proof!r}; with a changed term {changed!r}")
        row = f"{case.name:28}{mine:9.1f}"
        found = {name: peer(case, function, options.limit) for name, function in peers.items()}
        for width, (spent, how) in zip((12, 18), found.values(), strict=True):
            row += f"{spent:{width}.0f} {how:8}"
        bound = "≥" if found["simplify"][1] == "stopped" else ""
        print(
            row + f"{bound + format(found['simplify'][0] / mine, '.0f'):>8}   {changed.verdict}", flush=True
        )


if __name__ == "__main__":
    main()
