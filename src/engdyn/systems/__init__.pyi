from .library import catalogue as catalogue, load as load

__all__ = ["catalogue", "load"]
