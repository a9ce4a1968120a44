from .library import catalogue as catalogue
from .library import load as load

__all__ = ["catalogue", "load"]
