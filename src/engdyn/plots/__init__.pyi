from .alternative import alt, show
from .charts import flow_chart
from .drawing import draw
from .energy import potential_energy
from .equilibria import branches, equilibrium_poses
from .look import style
from .projection import View

__all__ = [
    "View",
    "alt",
    "branches",
    "draw",
    "equilibrium_poses",
    "flow_chart",
    "potential_energy",
    "show",
    "style",
]
