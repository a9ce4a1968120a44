"""How much of a base motion arrives.  Course section 7.2."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from engdyn.analysis.harmonic import split
from engdyn.analysis.linear import LinearSystem
from engdyn.analysis.response import FrequencyResponse, frequency_response
from engdyn.errors import EngdynError

__all__ = ["transmissibility"]

KINDS = ("absolute", "relative", "acceleration")


def transmissibility(
    linear: LinearSystem,
    frequency: Any,
    base: str,
    output: str,
    kind: str = "absolute",
) -> FrequencyResponse:
    """How much of a base motion arrives: a dimensionless frequency response.

    Parameters
    ----------
    linear : LinearSystem
    frequency : array_like, shape (N,)
        [Hz], rising.
    base : str
        The prescribed motion.
    output : str
        A coordinate or one of the outputs, of the dimension of the base motion.
    kind : {"absolute", "relative", "acceleration"}
        Output per base displacement; output minus base, per base displacement; acceleration per base acceleration.
        For the latter a coordinate stands for its acceleration, a name among the outputs for an acceleration as it is
        (the reading of an accelerometer). The ratio of a point's accelerations is that of its displacements.

    Returns
    -------
    FrequencyResponse
        With unit "-".

    Raises
    ------
    EngdynError
        As `frequency_response`; another kind; a base that is no input; accelerations at 0 Hz.

    Notes
    -----
    Course section 7.2.
    """
    if kind not in KINDS:
        raise EngdynError(f"kind is {kind!r}: choose one of {', '.join(KINDS)}")
    if isinstance(linear, LinearSystem) and base not in linear.inputs:
        raise EngdynError(
            f"base is {base!r}: choose one of the inputs {', '.join(linear.inputs) or '(none)'}"
        )
    found = frequency_response(linear, frequency, base, output, unit="-")
    name, order = split(linear, output)
    if order not in ((0, 2) if kind == "acceleration" else (0,)):
        raise EngdynError(f"output is {output!r}: a ratio without dimension needs {name!r}")
    if kind == "absolute" or (kind == "acceleration" and order == 0 and name in linear.coordinates):
        return found  # (iω)² above and below: the ratio of accelerations is that of displacements
    if kind == "acceleration" and found.frequency[0] == 0:
        raise EngdynError("at 0 Hz there are no accelerations to compare: begin above 0 Hz")

    def evaluate(f: np.ndarray) -> np.ndarray:
        per_displacement = found.evaluate(f)  # type: ignore[misc]
        return per_displacement - 1 if kind == "relative" else per_displacement / (2j * np.pi * f) ** 2

    return replace(found, response=evaluate(found.frequency), evaluate=evaluate)
