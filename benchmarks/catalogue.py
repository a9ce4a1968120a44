"""Deriving all systems of the catalogue: engdyn twice and proved, against LagrangesMethod and KanesMethod once each.

    python -m benchmarks.catalogue [SYSTEM ...] [--rounds N] [--budget S]

Tools are timed in turn on the same sympy.physics.mechanics objects, caches emptied before every turn, as in
``benchmarks.derive``.  Where a tool of sympy cannot be given the system (multipliers of a nonholonomic
constraint in the same call, say) or its equations do not agree, its place is empty, the reason is told, and
the system does not count in the ratio.
"""

from __future__ import annotations

import argparse
import warnings
from collections.abc import Callable
from functools import partial

import engdyn as ed
from benchmarks import models
from benchmarks.agreement import check
from benchmarks.models import Equations, Model
from benchmarks.timing import heading, interleaved

PEERS: dict[str, Callable[[Model], Equations]] = {
    "LagrangesMethod": models.lagrangian,
    "KanesMethod": models.kane,
}


def obstacle(key: str, tool: Callable[[Model], Equations]) -> str:
    """Why a peer cannot be compared on a system; empty where it can."""
    if ed.systems.load(key).constraints:
        return "nonholonomic"
    try:
        model = models.catalogue_system(key)
        check(model, {"engdyn": models.engdyn(model), "peer": tool(models.catalogue_system(key))})
    except AssertionError:
        return "other accelerations from this input"
    except Exception as error:  # whatever a peer raises is its answer
        return f"{type(error).__name__}: {str(error).splitlines()[0][:60]}"
    return ""


def compared(key: str, rounds: int, budget: float) -> tuple[dict[str, float], dict[str, str]]:
    """Median milliseconds of engdyn and of the peers that can do it, and why others cannot."""
    why = {name: reason for name, tool in PEERS.items() if (reason := obstacle(key, tool))}
    tools = {"engdyn": models.engdyn} | {name: tool for name, tool in PEERS.items() if name not in why}

    def prepared(tool: Callable[[Model], Equations]) -> Callable[[], Equations]:
        return partial(tool, models.catalogue_system(key))

    times, _ = interleaved({name: partial(prepared, tool) for name, tool in tools.items()}, rounds, budget)
    return times, why


def main(arguments: list[str] | None = None) -> None:
    """Run and print the table."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("systems", nargs="*", default=list(ed.systems.catalogue().index))
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--budget", type=float, default=20.0, help="seconds for one system")
    options = parser.parse_args(arguments)
    warnings.filterwarnings("ignore", message="(?s).*automatically calculated based on point")
    print(f"{heading()}; medians in ms, caches empty\n")
    print(f"{'system':32}{'engdyn':>9}{'Lagrange':>10}{'Kane':>10}{'sum ×':>8}")
    ours = all_of_ours = theirs = 0.0
    for key in options.systems:
        times, why = compared(key, options.rounds, options.budget)
        all_of_ours += times["engdyn"]
        cells = [f"{times[name]:10.0f}" if name in times else f"{'–':>10}" for name in PEERS]
        ratio, told = "", "; ".join(f"{name}: {reason}" for name, reason in why.items())
        if not why:
            both = sum(times[name] for name in PEERS)
            ours, theirs, ratio = ours + times["engdyn"], theirs + both, f"{both / times['engdyn']:8.0f}"
        name = f"{key} {ed.systems.load(key).key}"
        print(f"{name:32}{times['engdyn']:9.1f}{''.join(cells)}{ratio}  {told}".rstrip(), flush=True)
    print(f"\nall: engdyn {all_of_ours / 1e3:.2f} s", end="")
    print(f"; where both peers apply: {theirs / ours:.0f} × engdyn's time" if ours else "")


if __name__ == "__main__":
    main()
