"""Which explorers there are."""

from __future__ import annotations

__all__ = ["catalogue"]

NAMES = (
    "balance",
    "eigenvalue_plane",
    "equilibrium",
    "free_body",
    "gyroscope",
    "inertia",
    "linearization",
    "loads",
    "modes",
    "motion",
    "orientation",
    "pose",
    "routh",
    "stability_map",
)


def catalogue() -> list[str]:
    """Return the names of all explorers, as in ``engdyn.widgets.equilibrium()``.

    Examples
    --------
    >>> "equilibrium" in catalogue()
    True
    """
    return sorted(NAMES)
