"""Pictures of systems and results: ``engdyn.plots.draw(system)`` and companions, each with its words."""

from __future__ import annotations

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach(
    __name__,
    submod_attrs={
        "alternative": ["alt", "show"],
        "charts": ["flow_chart"],
        "drawing": ["draw"],
        "energy": ["potential_energy"],
        "equilibria": ["branches", "equilibrium_poses"],
        "projection": ["View"],
        "look": ["style"],
    },
)
