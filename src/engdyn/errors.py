"""The one family of errors, and the one warning, that engdyn raises.

Every message says what was given, what is wrong with it and what to do.
"""

from __future__ import annotations

__all__ = [
    "EngdynError",
    "EngdynWarning",
    "OutsideRingError",
    "ParameterError",
    "RecordError",
    "UnknownSystemError",
]


class EngdynError(ValueError):
    """Bad input: the message names the argument, what is wrong with it and the way out."""


class UnknownSystemError(EngdynError):
    """No system of the catalogue has this number or key."""


class ParameterError(EngdynError):
    """A parameter has an unknown name, a value that is not admissible or a unit that does not fit."""


class RecordError(EngdynError):
    """Sampled data that cannot be used as they are."""


class OutsideRingError(EngdynError):
    """An expression that the exact algebra cannot hold or cannot differentiate."""


class EngdynWarning(UserWarning):
    """The result is right, but mind this."""
