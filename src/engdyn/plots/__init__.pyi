from .alternative import alt, show
from .animation import animate
from .charts import flow_chart
from .drawing import draw, sketch
from .ellipsoid_picture import equivalent_ellipsoid
from .energy import potential_energy
from .equilibria import branches, equilibrium_poses
from .free_body_diagram import free_body
from .gyro_pictures import bicycle, gyroscope, precession_cones, sphere_paths
from .inertia_pictures import inertia_terms
from .kinematic_pictures import acceleration_terms, kinematic_chain, orientations, vector_change
from .look import style
from .motion import mode_motion
from .newton_pictures import curves, regions
from .projection import View

__all__ = [
    "View",
    "acceleration_terms",
    "alt",
    "animate",
    "bicycle",
    "branches",
    "curves",
    "draw",
    "equilibrium_poses",
    "equivalent_ellipsoid",
    "flow_chart",
    "free_body",
    "gyroscope",
    "inertia_terms",
    "kinematic_chain",
    "mode_motion",
    "orientations",
    "potential_energy",
    "precession_cones",
    "regions",
    "show",
    "sketch",
    "sphere_paths",
    "style",
    "vector_change",
]
