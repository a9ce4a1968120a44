"""Pictures of systems and results: ``engdyn.plots.draw(system)`` and companions, each with its words."""

from __future__ import annotations

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach(
    __name__,
    submod_attrs={
        "alternative": ["alt", "show"],
        "animation": ["animate"],
        "campbell_diagram": ["campbell"],
        "charts": ["flow_chart"],
        "contact_sheet": ["contact_sheet"],
        "drawing": ["draw", "sketch"],
        "ellipsoid_picture": ["equivalent_ellipsoid"],
        "energy": ["potential_energy"],
        "equilibria": ["branches", "equilibrium_poses"],
        "inertia_pictures": ["inertia_terms"],
        "kinematic_pictures": ["acceleration_terms", "kinematic_chain", "orientations", "vector_change"],
        "projection": ["View"],
        "free_body_diagram": ["free_body"],
        "look": ["style"],
        "modal_plots": ["mode_shapes", "phasors"],
        "nodal_picture": ["nodal_points"],
        "motion": ["mode_motion"],
        "gyro_pictures": ["bicycle", "gyroscope", "precession_cones", "sphere_paths"],
        "response_plots": ["cumulative_mean_square", "frequency_response", "spectrum"],
        "newton_pictures": ["curves", "regions"],
        "linear_pictures": ["response_gallery", "tangent"],
        "time_plots": [
            "error_over_step",
            "phase_portrait",
            "step_construction",
            "time_history",
            "work_precision",
        ],
        "record_plot": ["record"],
        "spectrum_plots": ["folding", "leakage", "spectrogram", "window"],
        "stability_plots": ["root_locus", "stability_map"],
    },
)
