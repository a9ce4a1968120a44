"""Interleaved timing: all tools in turn, round after round, so that drifts of the machine hit all alike."""

from __future__ import annotations

import gc
import platform
import statistics
import time
from collections.abc import Callable, Mapping
from importlib.metadata import version
from typing import Any

from sympy.core.cache import clear_cache

from engdyn.algebra import polynomials, trigonometry

#: A tool's turn lasts this long [s], or this many repetitions.
TURN, REPEATS = 0.3, 5


def forget() -> None:
    """Empty the caches of sympy and engdyn: a system is derived for the first time only once."""
    clear_cache()
    gc.collect()  # what one tool leaves behind is not the next one's work
    polynomials._of_size.cache_clear()
    trigonometry._exponentials.cache_clear()


def interleaved(
    tools: Mapping[str, Callable[[], Callable[[], Any]]],
    rounds: int,
    budget: float,
    warm: bool = False,
) -> tuple[dict[str, float], dict[str, Any]]:
    """Median milliseconds of every tool, and what each returned.

    Parameters
    ----------
    tools : mapping of name to callable
        Each call prepares fresh input and returns the work to be timed.
    rounds : int
        How often each tool has its turn.
    budget : float
        No new round begins after this time [s].
    warm : bool
        Whether the caches stay as the tools before left them.
    """
    times: dict[str, list[float]] = {name: [] for name in tools}
    results: dict[str, Any] = {}
    begin = time.perf_counter()
    for turn in range(rounds):
        if turn and time.perf_counter() - begin > budget:
            break
        for name, prepare in tools.items():
            spent = 0.0
            for _ in range(REPEATS):  # a quick tool has as long a turn as it may, to see as much of the noise
                if spent > TURN:
                    break
                if not warm:
                    forget()
                work = prepare()
                start = time.process_time()  # of this process alone: the machine may be shared
                results[name] = work()
                times[name].append(1e3 * (time.process_time() - start))
                spent += times[name][-1] / 1e3
    return {name: statistics.median(found) for name, found in times.items()}, results


def heading() -> str:
    """Versions of what is compared."""
    packages = ", ".join(f"{name} {version(name)}" for name in ("engdyn", "sympy", "python-flint"))
    return f"Python {platform.python_version()}, {packages}, backend {polynomials.backend_name()}"
