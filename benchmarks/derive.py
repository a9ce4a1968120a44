"""Deriving equations of motion: engdyn against sympy's LagrangesMethod and KanesMethod.

    python -m benchmarks.derive [--rounds N] [--links N]

One run times all tools in turn on the same sympy.physics.mechanics objects, round after round, so that
drifts of the machine hit all alike; the table shows medians and their ratios. Before a system is timed,
the accelerations that the tools give are compared at a random state.  engdyn derives twice,
proves both results equal and turns them into sympy matrices; the others derive once and prove nothing.
"""

from __future__ import annotations

import argparse
import platform
import statistics
import time
import warnings
from collections.abc import Callable
from functools import partial
from importlib.metadata import version

from benchmarks.agreement import check
from benchmarks.models import (
    Model,
    cart_with_links,
    catalogue_system,
    double_pendulum,
    engdyn,
    heavy_top,
    kane,
    lagrangian,
)

TOOLS: dict[str, Callable[[Model], object]] = {
    "engdyn": engdyn,
    "LagrangesMethod": lagrangian,
    "KanesMethod": kane,
}


def timed(make: Callable[[], Model], rounds: int) -> dict[str, float]:
    """Median milliseconds of every tool, interleaved, on objects that no tool has touched before."""
    found: dict[str, list[float]] = {name: [] for name in TOOLS}
    for turn in range(rounds + 1):
        for name, tool in TOOLS.items():
            model = make()
            start = time.perf_counter()
            tool(model)
            if turn:  # the first round warms up
                found[name].append(1e3 * (time.perf_counter() - start))
    return {name: statistics.median(times) for name, times in found.items()}


def main(arguments: list[str] | None = None) -> None:
    """Run and print the table."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--links", type=int, default=5, help="longest chain on the cart")
    options = parser.parse_args(arguments)
    warnings.filterwarnings(
        "ignore", message="(?s).*automatically calculated based on point"
    )  # of KanesMethod
    packages = ", ".join(f"{name} {version(name)}" for name in ("engdyn", "sympy", "python-flint"))
    print(f"Python {platform.python_version()}, {packages}; medians of {options.rounds} rounds\n")
    head = f"{'system':26}" + "".join(f"{name + ' [ms]':>22}" for name in TOOLS)
    print(head + f"{'Lagrange/engdyn':>18}{'Kane/engdyn':>14}")
    models = [partial(catalogue_system, key) for key in ("S03", "S07", "S23")]
    models += [
        double_pendulum,
        heavy_top,
        *(partial(cart_with_links, n) for n in range(1, options.links + 1)),
    ]
    for make in models:
        check(make)
        times = timed(make, options.rounds)
        ratios = [times[name] / times["engdyn"] for name in ("LagrangesMethod", "KanesMethod")]
        row = f"{make().name:26}" + "".join(f"{times[name]:22.1f}" for name in TOOLS)
        print(row + f"{ratios[0]:17.1f}×{ratios[1]:13.1f}×", flush=True)


if __name__ == "__main__":
    main()
