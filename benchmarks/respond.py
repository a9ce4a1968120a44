"""Frequency response at very many frequencies: engdyn against python-control and a loop over numpy.

    python -m benchmarks.respond [--frequencies N] [--size N] [--rounds N]

A chain of masses with dampers that are not proportional, at frequencies up to twice the highest natural one: all
responses to a force on each mass ("full"), and one of them ("single"). ``engdyn`` is `ed.frequency_response` from the
linearized equations, its verdict on stability included; ``control`` is ``control.frequency_response`` of the same
state matrices; ``loop`` solves (K + iωC − ω²M) X = F at one frequency after the other. All have their turns in one
interleaved run, warm, and must agree to 1e-12 of the largest response at each frequency. Where python-control is not
installed (``pip install control``) it is left out.

How to read the table: CPU times in milliseconds; "control ×" and "loop ×" are how many times longer these take. Run
with one thread of BLAS (OPENBLAS_NUM_THREADS=1), since processor times of all threads are added up.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
import sympy as sm
from sympy.physics.mechanics import dynamicsymbols

import engdyn as ed
from benchmarks.timing import heading, interleaved

try:
    import control
except ImportError:
    control = None

Tools = dict[str, Callable[[], np.ndarray]]


def chain(size: int) -> ed.LinearSystem:
    """Masses between springs and dampers, numbers at random."""
    random = np.random.default_rng(size)
    mass, springs, dampers = (
        random.uniform(1, 3, size),
        random.uniform(0.5e4, 1.5e4, size),
        random.uniform(1, 30, size),
    )
    q = sm.Matrix(dynamicsymbols(f"x1:{size + 1}"))
    stretched = [q[0], *(q[i] - q[i - 1] for i in range(1, size))]
    t = dynamicsymbols._t
    kinetic = sum(m * x.diff(t) ** 2 for m, x in zip(mass, q, strict=True)) / 2
    potential = sum(k * x**2 for k, x in zip(springs, stretched, strict=True)) / 2
    dissipation = sum(c * x.diff(t) ** 2 for c, x in zip(dampers, stretched, strict=True)) / 2
    return ed.linearize(ed.lagrange(kinetic, potential, list(q), dissipation), {}, {})


def tools(linear: ed.LinearSystem, f: np.ndarray, single: bool) -> Tools:
    """What computes all responses, or that of the first mass alone, shape (outputs, inputs, N)."""
    names, count = list(linear.coordinates), 1 if single else len(linear.coordinates)
    M, C, K, n = linear.mass, linear.damping, linear.stiffness, len(linear.coordinates)
    force, omega = np.eye(n)[:, :count], 2 * np.pi * f

    def loop() -> np.ndarray:
        return np.stack([np.linalg.solve(K + 1j * w * C - w * w * M, force)[:count] for w in omega], axis=-1)

    found: Tools = {
        "engdyn": lambda: ed.frequency_response(linear, f, names[:count], names[:count]).response,
        "loop": loop,
    }
    if control is not None:
        B = np.vstack([np.zeros((n, count)), np.linalg.solve(M, force)])
        model = control.ss(linear.state_matrix, B, np.eye(count, 2 * n), np.zeros((count, count)))
        found["control"] = lambda: control.frequency_response(model, omega, squeeze=False).complex
    return found


def main(arguments: Sequence[str] | None = None) -> None:
    """Run the benchmark from the command line."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--frequencies", type=int, default=100_000)
    parser.add_argument("--size", type=int, default=10, help="number of masses")
    parser.add_argument("--rounds", type=int, default=5)
    chosen = parser.parse_args(arguments)
    linear = chain(chosen.size)
    highest = np.max(np.abs(ed.eigenvalues(linear))) / (2 * np.pi)
    f = np.linspace(highest / 1e3, 2 * highest, chosen.frequencies)
    print(heading(), "" if control else "; python-control is not installed and left out")
    print(f"{chosen.frequencies} frequencies, {chosen.size} masses; CPU times in ms")
    print(f"{'':8}" + "".join(f"{name:>12}" for name in ("engdyn", "control", "loop", "control ×", "loop ×")))
    for name in ("full", "single"):
        compared(name, tools(linear, f, name == "single"), chosen.rounds)


def compared(name: str, work: Tools, rounds: int) -> None:
    """Time all tools in turn, print one line and check that they agree."""

    def prepared(tool: Callable[[], np.ndarray]) -> Callable[[], Callable[[], Any]]:
        return lambda: tool

    times, results = interleaved(
        {key: prepared(tool) for key, tool in work.items()}, rounds, 300.0, warm=True
    )
    ms = [times.get(key) for key in ("engdyn", "control", "loop")]
    row = [f"{x:.1f}" if x else "–" for x in ms] + [f"{x / ms[0]:.0f}×" if x else "–" for x in ms[1:]]
    print(f"{name:8}" + "".join(f"{text:>12}" for text in row), flush=True)
    scale = np.max(np.abs(results["loop"]), axis=0)
    for key, found in results.items():
        error = np.max(np.abs(found - results["loop"]) / scale)
        assert error < 1e-12, f"{key} differs by {error:.1e}"


if __name__ == "__main__":
    main()
