from .balance_explorer import balance
from .eigenvalue_explorer import eigenvalue_plane
from .equilibrium_explorer import equilibrium
from .explorer import Explorer
from .free_body_explorer import free_body
from .gyroscope_explorer import gyroscope
from .inertia_explorer import inertia
from .linearization_explorer import linearization
from .listing import catalogue
from .loads_explorer import loads
from .modes_explorer import modes
from .motion_explorer import motion
from .orientation_explorer import orientation
from .pose_explorer import pose
from .routh_explorer import routh
from .stability_explorer import stability_map

__all__ = [
    "Explorer",
    "balance",
    "catalogue",
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
]
