"""Where an input jumps, and where it wakes up after a rest: places that no step may go across.

An adaptive scheme that sees nothing for a long time takes long steps, over a short pulse as well.  Course
section 8.7.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

__all__ = ["breaks"]

Function = Callable[[np.ndarray], np.ndarray]

LOOKS, MOST = 2_000, 1_000_000
"""An input is looked at so many times; more often where ``max_step`` is short."""
QUIET = 1e-9
"""A change below this share of the whole range is none."""
REST, PARTS = 3, 4
"""So many looks without a change are a rest; what lies between two rests is cut in so many parts."""


def breaks(function: Function, begin: float, end: float, max_step: float) -> list[tuple[float, float]]:
    """Pairs (before, after) of times: a segment of time ends at the first, the next begins at the second.

    Parameters
    ----------
    function : callable
        Values at an array of times.
    begin, end : float
    max_step : float
        Pulses as long as this are found in any case.

    Returns
    -------
    list of (float, float)
        Two neighboring numbers at a jump, one and the same elsewhere.
    """
    looks = min(max(LOOKS, int(np.ceil(4.0 * (end - begin) / max_step))), MOST)
    at = np.linspace(begin, end, looks + 1)
    values = function(at)
    small = QUIET * np.ptp(values)
    moving = np.flatnonzero(np.abs(np.diff(values)) > small)
    if not len(moving):
        return []
    found: list[tuple[float, float]] = []
    for run in np.split(moving, np.flatnonzero(np.diff(moving) > REST) + 1):
        first, last = run[0], run[-1]
        wakes = _edge(function, at[first], at[first + 1], values[first], small) if first else None
        rests = None
        if last + 1 < looks:
            after, before = _edge(function, at[last + 1], at[last], values[last + 1], small)
            rests = before, after
        if wakes is None and rests is None:
            continue
        found += [edge for edge in (wakes, rests) if edge]
        cuts = np.linspace(wakes[1] if wakes else begin, rests[0] if rests else end, PARTS + 1)[1:-1]
        if len(run) > 1:
            found += [(cut, cut) for cut in cuts.tolist()]
    return sorted(set(found))


def _edge(function: Function, still: float, moved: float, value: float, small: float) -> tuple[float, float]:
    """Neighboring times between which a function leaves a value, from the side where it is at rest."""
    while True:
        middle = still + (moved - still) / 2
        if middle in (still, moved):
            return still, moved
        if abs(function(np.array([middle]))[0] - value) <= small:
            still = middle
        else:
            moved = middle
