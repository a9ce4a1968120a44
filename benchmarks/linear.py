"""Maps of stability: engdyn against a loop over scipy.linalg.eig.

    python -m benchmarks.linear [--quick] [--points N] [--rounds N] [--budget S]

One run times all tools in turn, round after round, on the same plane of two parameters.  engdyn follows the
equilibrium, evaluates the linearized equations on arrays, computes all eigenvalues at once and judges each point.
"loop" does at each point what a script does: M, C and K from functions that sympy's lambdify made, the state matrix
by numpy.linalg.solve, and scipy.linalg.eig.  "eig alone" is scipy.linalg.eig on state matrices that are there
already: nothing is linearized, nothing judged.  The largest real parts of all three are compared.

How to read the table: times in milliseconds; "loop ×" is how many times longer the loop takes.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable
from typing import Any

import numpy as np
import scipy.linalg
import sympy as sm

import engdyn as ed
from benchmarks.timing import heading, interleaved

#: System, the two parameters and their ranges, whether its equilibrium moves with them.
PLANES = {
    "S11 follower force": (11, ("P", 1.0, 120.0), ("c_1", 0.01, 1.0)),
    "S12 airfoil": (12, ("U", 1.0, 80.0), ("d", -0.05, 0.1)),
    "S15 gimballed rotor": (15, ("Omega", 0.0, 60.0), ("k_a", 0.0, 80.0)),
    "S14 rotor, whirl moves": (14, ("Omega", 10.0, 1200.0), ("c_i", 1.0, 300.0)),
}


class Plane:
    """One system over one plane, ready for all tools."""

    def __init__(self, number: int, x: tuple, y: tuple, points: int):
        system = ed.systems.load(number)
        self.eom, self.values = system.equations, system.values()
        self.x, self.y = ((name, np.linspace(low, high, points)) for name, low, high in (x, y))
        self.at = system.equilibria()[0]
        zero = {c.name: 0 for c in system.coordinates}
        linear = ed.linearize(self.eom, zero, symbolic=True)
        numbers = {p.symbol: self.values[p.name] for p in system.parameters if p.name not in (x[0], y[0])}
        symbols = [p.symbol for name in (x[0], y[0]) for p in system.parameters if p.name == name]
        self.matrices = [
            sm.lambdify(symbols, matrix.subs(numbers), "numpy")
            for matrix in (linear.mass, linear.damping, linear.stiffness)
        ]
        self.ready = np.array([[self.state_matrix(a, b) for a in self.x[1]] for b in self.y[1]])

    def state_matrix(self, a: float, b: float) -> np.ndarray:
        mass, damping, stiffness = (np.asarray(function(a, b), dtype=float) for function in self.matrices)
        n = len(mass)
        found = np.zeros((2 * n, 2 * n))
        found[:n, n:] = np.eye(n)
        found[n:] = -np.linalg.solve(mass, np.hstack([stiffness, damping]))
        return found

    def engdyn(self) -> np.ndarray:
        found = ed.stability_map(self.eom, self.values, self.x, self.y, at=self.at)
        return found.eigenvalues.real.max(axis=-1)

    def loop(self) -> np.ndarray:
        return np.array(
            [[scipy.linalg.eig(self.state_matrix(a, b))[0].real.max() for a in self.x[1]] for b in self.y[1]]
        )

    def alone(self) -> np.ndarray:
        return np.array([[scipy.linalg.eig(matrix)[0].real.max() for matrix in row] for row in self.ready])


def compared(plane: Plane, rounds: int, budget: float) -> dict[str, float]:
    """Median milliseconds of every tool."""
    works: dict[str, Callable[[], Any]] = {
        "engdyn": plane.engdyn,
        "loop": plane.loop,
        "eig alone": plane.alone,
    }
    times, results = interleaved(
        {name: lambda w=work: w for name, work in works.items()}, rounds, budget, warm=True
    )
    for name, found in results.items():
        if np.max(np.abs(found - results["loop"])) > 1e-6 * np.max(np.abs(results["loop"])):
            raise AssertionError(f"{name} finds other eigenvalues than the loop")
    return times


def main(arguments: list[str] | None = None) -> None:
    """Run and print the table."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--quick", action="store_true", help="40 x 40 points, one round")
    parser.add_argument("--points", type=int, default=200, help="points along each side")
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--budget", type=float, default=60.0, help="seconds for one system")
    options = parser.parse_args(arguments)
    points, rounds = (40, 1) if options.quick else (options.points, options.rounds)
    print(f"{heading()}; scipy {scipy.__version__}; medians, {points} x {points} points\n")
    print(f"{'system':26}{'engdyn':>10}{'loop':>10}{'eig alone':>12}{'loop ×':>10}{'eig alone ×':>14}")
    for name, (number, x, y) in PLANES.items():
        times = compared(Plane(number, x, y, points), rounds, options.budget)
        ratios = times["loop"] / times["engdyn"], times["eig alone"] / times["engdyn"]
        row = f"{name:26}{times['engdyn']:10.0f}{times['loop']:10.0f}{times['eig alone']:12.0f}"
        print(row + f"{ratios[0]:10.1f}{ratios[1]:14.1f}", flush=True)


if __name__ == "__main__":
    main()
