"""The 23 representative systems: ``load`` one, or look at the ``catalogue``.  Appendix A."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach(__name__, submod_attrs={"library": ["catalogue", "load"]})
