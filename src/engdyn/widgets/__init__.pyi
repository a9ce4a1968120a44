from .equilibrium_explorer import equilibrium
from .explorer import Explorer
from .listing import catalogue

__all__ = ["Explorer", "catalogue", "equilibrium"]
