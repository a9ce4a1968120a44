"""Sweeps: one function over the product of several arrays, here or on many computers.  Course section 8.7."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Executor
from typing import Any

import numpy as np

from engdyn.errors import EngdynError

__all__ = ["sweep"]

PORTIONS = 4
"""So many portions of work each worker gets: few messages, and no worker waits long for the last one."""


def sweep(
    function: Callable[..., Any], grid: Mapping[str, Any], executor: Executor | None = None
) -> np.ndarray:
    """Values of ``function(**point)`` over all combinations of the values in `grid`.

    Parameters
    ----------
    function : callable
        Takes the names of `grid` as keywords. For an executor of processes it must be importable.
    grid : mapping of str to array_like
        Name → values, one row each.
    executor : concurrent.futures.Executor, optional
        Where to compute: ``ThreadPoolExecutor``, ``ProcessPoolExecutor``, or what
        ``dask.distributed.Client(...).get_executor()`` returns.

    Returns
    -------
    numpy.ndarray
        Shape of the grid, in the order of its names; results that are arrays of one shape add their axes behind.
        What is no number is kept as an object.

    Raises
    ------
    EngdynError
        An empty grid, values that are no row. An error of the function is passed on, with the point in a note.

    Examples
    --------
    >>> import engdyn as ed
    >>> ed.sweep(lambda a, b: a + b, {"a": [1, 2], "b": [10, 20, 30]})
    array([[11, 21, 31],
           [12, 22, 32]])
    """
    if not isinstance(grid, Mapping) or not grid:
        raise EngdynError(f"grid is {grid!r}: give a mapping of names to arrays of values")
    rows = {name: list(values) if np.ndim(values) == 1 else [] for name, values in grid.items()}
    for name, row in rows.items():
        if not row:
            raise EngdynError(f"grid[{name!r}] is {grid[name]!r}: give one or more values in a row")
    points = [dict(zip(rows, values, strict=True)) for values in itertools.product(*rows.values())]
    if executor is not None and not hasattr(executor, "map"):
        raise EngdynError(f"executor is {executor!r}: give an Executor, such as ThreadPoolExecutor()")
    if executor is None:
        results = _portion(function, points)
    else:
        size = -(-len(points) // (PORTIONS * (getattr(executor, "_max_workers", None) or 8)))
        portions = [points[i : i + size] for i in range(0, len(points), size)]
        results = [x for part in executor.map(_portion, [function] * len(portions), portions) for x in part]
    return _arranged(results, tuple(len(row) for row in rows.values()))


def _portion(function: Callable[..., Any], points: Sequence[Mapping[str, Any]]) -> list[Any]:
    found = []
    for point in points:
        try:
            found.append(function(**point))
        except Exception as error:
            error.add_note(f"sweep: at {', '.join(f'{name} = {value}' for name, value in point.items())}")
            raise
    return found


def _arranged(results: list[Any], shape: tuple[int, ...]) -> np.ndarray:
    if len({np.shape(x) if isinstance(x, np.ndarray) else () for x in results}) == 1:
        if all(isinstance(x, np.ndarray | np.generic | int | float | complex) for x in results):
            stacked = np.array(results)
            return stacked.reshape(*shape, *stacked.shape[1:])
    found = np.empty(len(results), dtype=object)
    found[:] = results
    return found.reshape(shape)
