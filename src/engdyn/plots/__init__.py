"""Pictures of systems and results: ``engdyn.plots.draw(system)`` and companions, each with its words."""

from __future__ import annotations

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach(
    __name__,
    submod_attrs={
        "alternative": ["alt", "show"],
        "animation": ["animate"],
        "charts": ["flow_chart"],
        "drawing": ["draw", "sketch"],
        "ellipsoid_picture": ["equivalent_ellipsoid"],
        "energy": ["potential_energy"],
        "equilibria": ["branches", "equilibrium_poses"],
        "inertia_pictures": ["inertia_terms"],
        "kinematic_pictures": ["acceleration_terms", "kinematic_chain", "orientations", "vector_change"],
        "projection": ["View"],
        "free_body_diagram": ["free_body"],
        "look": ["style"],
        "motion": ["mode_motion"],
        "gyro_pictures": ["bicycle", "gyroscope", "precession_cones", "sphere_paths"],
        "newton_pictures": ["curves", "regions"],
    },
)
