"""Outlines of bodies that are known only by the points where loads act on them."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from engdyn import shapes as sh
from engdyn.modeling.free_body import FreeBody

__all__ = ["outline_of"]


def outline_of(body: FreeBody, points: NDArray, size: float, planar: bool) -> Iterator[sh.Shape]:
    """The body of a free-body diagram that nobody drew: as simple as the points on it allow.

    Parameters
    ----------
    body : FreeBody
    points : ndarray, shape (N, 3)
        Where loads act, from the mass center [m].
    size : float
        The largest distance among them, or 1.
    planar : bool
        Whether the diagram lies in the x-y plane.
    """
    distinct = np.unique(np.round(points, 9), axis=0)
    if not planar:
        yield from (sh.Link((0.0, 0.0, 0.0), tuple(p)) for p in distinct if np.any(p))
        yield sh.Particle((0.0, 0.0, 0.0)) if not body.turns else sh.CenterOfMass((0.0, 0.0, 0.0))
        return
    flat = distinct[:, :2]
    spread = np.linalg.svd(flat - flat.mean(axis=0))
    if not body.turns:
        yield sh.Box((0.0, 0.0), (0.3, 0.3))
        return
    if len(flat) == 1:
        yield sh.Disc((0.0, 0.0), 0.5 * size)
    elif spread.S[1] < 1e-6 * size:
        yield _bar(flat, spread.Vh[0], size)
    else:
        yield sh.Polygon(_hull(flat, 0.08 * size))
    yield sh.CenterOfMass((0.0, 0.0))


def _bar(points: NDArray, along: NDArray, size: float) -> sh.Box:
    """A bar through points on a line; a body loaded at one end and at G reaches as far on the other side."""
    reach = points @ along
    low, high = min(reach.min(), -reach.max()), max(reach.max(), -reach.min())
    middle, length = 0.5 * (low + high) * along, high - low + 0.1 * size
    return sh.Box(tuple(middle), (length, 0.12 * size), angle=math.atan2(along[1], along[0]))


def _hull(points: NDArray, margin: float) -> tuple[tuple[float, float], ...]:
    """Corners of the convex hull, rounded and set off by ``margin``."""
    from scipy.spatial import ConvexHull

    circle = np.linspace(0.0, 2.0 * np.pi, 24, endpoint=False)
    ring = margin * np.column_stack([np.cos(circle), np.sin(circle)])
    cloud = (points[:, None] + ring[None]).reshape(-1, 2)
    return tuple(tuple(p) for p in cloud[ConvexHull(cloud).vertices])
