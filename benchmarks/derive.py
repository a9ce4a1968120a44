"""Deriving equations of motion: engdyn against sympy's LagrangesMethod, KanesMethod and System.

    python -m benchmarks.derive [--quick] [--links N] [--rounds N] [--budget S] [--warm] [--plot FILE]

One run times all tools in turn on the same sympy.physics.mechanics objects, round after round, so that
drifts of the machine hit all alike; the table shows medians.  engdyn derives twice (Newton–Euler with its
reactions, and Lagrange), proves both results equal and turns mass matrix and forcing into sympy
expressions; the others derive once and prove nothing.  The accelerations of all tools are compared at a
random state.  Caches are emptied before every turn, as they are when a system is derived for the first
time; ``--warm`` keeps them, which helps the others most (they find their own results of the round before).

How to read the table: times in milliseconds; "Lagrange ×" is how many times longer LagrangesMethod takes,
"best ×" the same for the fastest of all peers.  ``--plot`` draws how time and output grow with the number
of links.
"""

from __future__ import annotations

import argparse
import warnings
from collections.abc import Callable
from functools import partial
from pathlib import Path

import sympy as sm

from benchmarks import models
from benchmarks.agreement import check
from benchmarks.models import Equations, Model
from benchmarks.timing import heading, interleaved

TOOLS: dict[str, Callable[[Model], Equations]] = {
    "engdyn": models.engdyn,
    "LagrangesMethod": models.lagrangian,
    "KanesMethod": models.kane,
    "System": models.system,
}


def compared(
    make: Callable[[], Model], rounds: int, budget: float, warm: bool
) -> tuple[dict[str, float], int]:
    """Median milliseconds of every tool on one system, and the operations of engdyn's result."""

    def prepared(tool: Callable[[Model], Equations]) -> Callable[[], Equations]:
        return partial(tool, make())

    tools = {name: partial(prepared, tool) for name, tool in TOOLS.items()}
    times, results = interleaved(tools, rounds, budget, warm)
    check(make(), results)
    return times, int(sum(sm.count_ops(e) for matrix in results["engdyn"] for e in matrix))


def growth(rows: dict[int, tuple[dict[str, float], int]], file: Path) -> None:
    """Draw time and size of the result over the number of links."""
    from engdyn.plots.look import new_figure, style

    links = sorted(rows)
    figure = new_figure(7.2, 4.6)
    with style():
        ax = figure.subplots()
        for name, marker in zip(TOOLS, "os^v", strict=True):
            ax.loglog(links, [rows[n][0][name] for n in links], f"{marker}-", label=name)
        scale = rows[links[-1]][0]["engdyn"] / rows[links[-1]][1]
        ax.loglog(links, [scale * rows[n][1] for n in links], "k:", label="operations in the result (scaled)")
        ax.set_xticks(links, [str(n) for n in links])
        ax.set_xticks([], minor=True)
        ax.set_xlabel("links on the cart")
        ax.set_ylabel("time to derive [ms]")
        ax.set_title("engdyn: derived twice, proved equal; the others: derived once")
        ax.set_ylim(top=100.0 * max(max(times.values()) for times, _ in rows.values()))
        ax.legend(loc="upper left")
    figure.savefig(file, dpi=90)


def main(arguments: list[str] | None = None) -> None:
    """Run and print the table."""
    options = _options(arguments)
    warnings.filterwarnings("ignore", message="(?s).*automatically calculated based on point")
    links = range(1, (3 if options.quick else options.links) + 1)
    carts = {n: partial(models.cart_with_links, n) for n in links}
    others = [models.double_pendulum, models.heavy_top, partial(models.heavy_top, True)]
    others += [partial(models.mass_chain, 5 if options.quick else 20)]
    others += [partial(models.catalogue_system, key) for key in ("S03", "S07", "S23")]
    print(f"{heading()}; medians, caches {'warm' if options.warm else 'empty'}\n")
    print(f"{'system':24}" + "".join(f"{name:>17}" for name in TOOLS) + f"{'Lagrange ×':>13}{'best ×':>9}")
    for tool in TOOLS.values():  # imports are not timed
        tool(models.double_pendulum())
    rows = {}
    for n, make in [*carts.items(), *((0, make) for make in others)]:
        times, size = compared(make, 1 if options.quick else options.rounds, options.budget, options.warm)
        rows[n] = times, size
        peers = [times[name] for name in TOOLS if name != "engdyn"]
        ratios = peers[0] / times["engdyn"], min(peers) / times["engdyn"]
        row = f"{make().name:24}" + "".join(f"{times[name]:17.1f}" for name in TOOLS)
        print(row + f"{ratios[0]:13.0f}{ratios[1]:9.1f}", flush=True)
    if options.plot:
        growth({n: row for n, row in rows.items() if n}, options.plot)


def _options(arguments: list[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--quick", action="store_true", help="small systems, one round")
    parser.add_argument("--links", type=int, default=8, help="longest chain on the cart")
    parser.add_argument("--rounds", type=int, default=7)
    parser.add_argument("--budget", type=float, default=20.0, help="seconds for one system")
    parser.add_argument("--warm", action="store_true", help="keep the caches between turns")
    parser.add_argument("--plot", type=Path, metavar="FILE", help="picture of the growth with the links")
    return parser.parse_args(arguments)


if __name__ == "__main__":
    main()
