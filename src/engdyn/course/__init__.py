"""The exercises of the course: ``check`` an answer, see your own ``variant``, list all ``exercises``."""

from __future__ import annotations

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach(
    __name__,
    submod_attrs={
        "checking": ["check"],
        "registry": ["exercise", "exercises", "variant"],
        "verdict": ["Verdict"],
    },
)
