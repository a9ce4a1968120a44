from .alternative import alt, show
from .animation import animate
from .campbell_diagram import campbell
from .charts import flow_chart
from .contact_sheet import contact_sheet
from .drawing import draw, sketch
from .ellipsoid_picture import equivalent_ellipsoid
from .energy import potential_energy
from .equilibria import branches, equilibrium_poses
from .free_body_diagram import free_body
from .gyro_pictures import bicycle, gyroscope, precession_cones, sphere_paths
from .inertia_pictures import inertia_terms
from .kinematic_pictures import acceleration_terms, kinematic_chain, orientations, vector_change
from .linear_pictures import response_gallery, tangent
from .look import style
from .modal_plots import mode_shapes, phasors
from .motion import mode_motion
from .newton_pictures import curves, regions
from .nodal_picture import nodal_points
from .projection import View
from .record_plot import record
from .response_plots import cumulative_mean_square, frequency_response, spectrum
from .spectrum_plots import folding, leakage, spectrogram, window
from .stability_plots import root_locus, stability_map
from .time_plots import error_over_step, phase_portrait, step_construction, time_history, work_precision

__all__ = [
    "View",
    "acceleration_terms",
    "alt",
    "animate",
    "bicycle",
    "branches",
    "campbell",
    "contact_sheet",
    "cumulative_mean_square",
    "curves",
    "draw",
    "equilibrium_poses",
    "equivalent_ellipsoid",
    "error_over_step",
    "flow_chart",
    "folding",
    "free_body",
    "frequency_response",
    "gyroscope",
    "inertia_terms",
    "kinematic_chain",
    "leakage",
    "mode_motion",
    "mode_shapes",
    "nodal_points",
    "orientations",
    "phase_portrait",
    "phasors",
    "potential_energy",
    "precession_cones",
    "record",
    "regions",
    "response_gallery",
    "root_locus",
    "show",
    "sketch",
    "spectrogram",
    "spectrum",
    "sphere_paths",
    "stability_map",
    "step_construction",
    "style",
    "tangent",
    "time_history",
    "vector_change",
    "window",
    "work_precision",
]
