"""Phase along frequency: continuous, but never by inventing turns.  Course section 7.1."""

from __future__ import annotations

import warnings

import numpy as np

from engdyn.errors import EngdynWarning

__all__ = ["unwrapped"]

NOISE = 1e-10
"""Below this share of the largest amplitude a phase means nothing and turns are not counted."""

JUMP = 1e-6
"""A step that differs from π by less [rad] is a change of sign, not a turn."""

STEEP = 0.75 * np.pi
"""A larger step [rad] may as well be one in the other direction: the grid is too coarse to tell."""


def unwrapped(frequency: np.ndarray, response: np.ndarray) -> np.ndarray:
    """Phase of complex amplitudes [rad], by rule.

    The phase begins in (−π, π]; from there each step is the one of at most π, so that jumps of 2π disappear. A
    change of sign stays a jump of π: upward at an antiresonance without damping, where the amplitude goes through
    zero, and downward at a resonance, both the limits of small damping. Where the amplitude is below 1e-10 of the
    largest the phase is kept as it is, moved by the turns counted so far, and no turn is counted there.

    Parameters
    ----------
    frequency : ndarray, shape (N,)
        [Hz]
    response : ndarray of complex, shape (N,)

    Returns
    -------
    ndarray, shape (N,)

    Warns
    -----
    EngdynWarning
        A step larger than 3π/4 that is no change of sign: the grid is too coarse.
    """
    phase, size = np.angle(response), np.abs(response)
    good = np.flatnonzero(size > NOISE * np.max(size, initial=0.0))
    if not len(good):
        return phase
    raw, size = phase[good], size[good]
    steps = np.angle(np.exp(1j * np.diff(raw)))
    jumps = np.abs(np.abs(steps) - np.pi) < JUMP
    if len(coarse := np.flatnonzero((np.abs(steps) > STEEP) & ~jumps)):
        low, high = frequency[good[coarse[0]]], frequency[good[coarse[0] + 1]]
        warnings.warn(
            f"the phase turns by {np.degrees(abs(steps[coarse[0]])):.0f}° between {low:.5g} and {high:.5g} Hz: the "
            "frequencies are too coarse to tell in which direction; give more of them there",
            EngdynWarning,
            stacklevel=4,
        )
    outside = np.concatenate(
        [size[:1], size, size[-1:]]
    )  # what is beyond each step, compared with what is beside it
    antiresonance = outside[:-3] + outside[3:] >= size[:-1] + size[1:]
    steps = np.where(jumps, np.where(antiresonance, np.pi, -np.pi), steps)
    whole = raw[0] + np.concatenate([[0.0], np.cumsum(steps)])
    turns = np.round((whole - raw) / (2 * np.pi))
    return phase + 2 * np.pi * turns[np.maximum(np.searchsorted(good, np.arange(len(phase)), "right") - 1, 0)]
