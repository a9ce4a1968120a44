"""Natural frequencies of many systems at once: engdyn against a loop over scipy.

    python -m benchmarks.modal [--systems N] [--rounds N]

A sweep of the masses and stiffnesses of chains with random terms in both matrices. The peer is what one
writes without engdyn, ``scipy.linalg.eigh(K, M, eigvals_only=True)`` in a loop; it and
``ed.natural_frequencies`` have their turns in one interleaved run, warm, and must agree to 1e-10.

How to read the table: CPU times in milliseconds; "ratio" is the time of the loop over that of engdyn. Run with
one thread of BLAS (OPENBLAS_NUM_THREADS=1), since processor times of all threads are added up.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable, Sequence
from functools import partial
from typing import Any

import numpy as np
import scipy.linalg

import engdyn as ed
from benchmarks.timing import heading, interleaved

SIZES = (2, 3, 5, 10)


def sweep(n: int, count: int) -> tuple[np.ndarray, np.ndarray]:
    """Mass and stiffness matrices, positive definite, shape (count, n, n)."""
    rng = np.random.default_rng(n)
    a, b = rng.normal(size=(2, count, n, n)) / n
    chain = 2 * np.eye(n) - np.eye(n, k=1) - np.eye(n, k=-1)
    return np.eye(n) + a @ a.swapaxes(1, 2), 1e3 * (chain + b @ b.swapaxes(1, 2))


def loop(mass: np.ndarray, stiffness: np.ndarray) -> np.ndarray:
    """The peer for undamped frequencies."""
    pairs = zip(stiffness, mass, strict=True)
    return np.sqrt([scipy.linalg.eigh(k, m, eigvals_only=True) for k, m in pairs]) / (2 * np.pi)


def timed(name: str, ours: Callable[[], Any], peer: Callable[[], Any], rounds: int) -> dict[str, Any]:
    """Time both tools in turn and print one line; return what they computed."""
    tools = {"engdyn": lambda: ours, "loop": lambda: peer}
    times, results = interleaved(tools, rounds, budget=120.0, warm=True)
    ratio = times["loop"] / times["engdyn"]
    print(f"{name:32} {times['engdyn']:10.2f} {times['loop']:10.2f} {ratio:8.1f}×")
    return results


def main(arguments: Sequence[str] | None = None) -> None:
    """Run the benchmark from the command line."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--systems", type=int, default=10_000)
    parser.add_argument("--rounds", type=int, default=7)
    chosen = parser.parse_args(arguments)
    print(heading())
    print(f"{chosen.systems} systems at once {'engdyn ms':>26} {'loop ms':>10} {'ratio':>9}")
    for n in SIZES:
        mass, stiffness = sweep(n, chosen.systems)
        ours, peer = partial(ed.natural_frequencies, mass, stiffness), partial(loop, mass, stiffness)
        results = timed(f"undamped, n = {n}", ours, peer, chosen.rounds)
        np.testing.assert_allclose(results["engdyn"], results["loop"], rtol=1e-10)


if __name__ == "__main__":
    main()
