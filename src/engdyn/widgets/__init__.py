"""Explorers: pictures with sliders for lectures and self-study, each also driven from code by ``set``."""

from __future__ import annotations

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach(
    __name__,
    submod_attrs={
        "equilibrium_explorer": ["equilibrium"],
        "explorer": ["Explorer"],
        "listing": ["catalogue"],
    },
)
