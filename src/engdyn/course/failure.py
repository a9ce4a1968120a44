"""How a check of the matrix fails, and how its input is corrupted to see that it can."""

from __future__ import annotations

from engdyn.errors import EngdynError

__all__ = ["CORRUPTION", "CheckFailure"]

CORRUPTION = 1.01
"""What a corrupted input is multiplied with."""


class CheckFailure(EngdynError):
    """An analysis gave what it must not give."""
