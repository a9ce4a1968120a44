"""Explorers: pictures with sliders for lectures and self-study, each also driven from code by ``set``."""

from __future__ import annotations

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach(
    __name__,
    submod_attrs={
        "balance_explorer": ["balance"],
        "eigenvalue_explorer": ["eigenvalue_plane"],
        "equilibrium_explorer": ["equilibrium"],
        "explorer": ["Explorer"],
        "free_body_explorer": ["free_body"],
        "gyroscope_explorer": ["gyroscope"],
        "inertia_explorer": ["inertia"],
        "linearization_explorer": ["linearization"],
        "listing": ["catalogue"],
        "loads_explorer": ["loads"],
        "modes_explorer": ["modes"],
        "motion_explorer": ["motion"],
        "orientation_explorer": ["orientation"],
        "pose_explorer": ["pose"],
        "routh_explorer": ["routh"],
        "stability_explorer": ["stability_map"],
    },
)
