"""Windows: what multiplies a segment of a record before it is transformed.  Course section 9.8."""

from __future__ import annotations

from typing import Any

import numpy as np

from engdyn.errors import EngdynError

__all__ = ["amplitude_correction", "energy_correction", "equivalent_noise_bandwidth", "window"]

COSINES = {
    "boxcar": (1.0,),
    "hann": (0.5, 0.5),
    "hamming": (0.54, 0.46),
    "blackman": (0.42, 0.5, 0.08),
    "nuttall": (0.3635819, 0.4891775, 0.1365995, 0.0106411),
    "blackmanharris": (0.35875, 0.48829, 0.14128, 0.01168),
    "flattop": (0.21557895, 0.41663158, 0.277263158, 0.083578947, 0.006947368),
}
"""Coefficients of the windows that are sums of cosines."""


def window(name: str, N: int) -> np.ndarray:
    """A window of N samples, periodic: the sample N, which would equal sample 0, is left to the next period.

    Parameters
    ----------
    name : str
        "boxcar" (none), "hann", "hamming", "bartlett", "blackman", "nuttall", "blackmanharris" or "flattop".
    N : int
        Number of samples.

    Returns
    -------
    ndarray, shape (N,)

    Raises
    ------
    EngdynError
        An unknown name; a number of samples that is not a positive integer.

    Notes
    -----
    Course section 9.8. F. J. Harris, *Proceedings of the IEEE* 66 (1978) 51; A. H. Nuttall, *IEEE Transactions on
    Acoustics, Speech and Signal Processing* 29 (1981) 84; the flat top is that of ISO 18431-2 (2004) as D'Antona
    and Ferrero give it. The same as ``scipy.signal.get_window``.

    Examples
    --------
    >>> window("hann", 4)
    array([0. , 0.5, 1. , 0.5])
    """
    known = (*COSINES, "bartlett")
    if name not in known:
        raise EngdynError(f"there is no window {name!r}: choose one of {', '.join(known)}")
    if not isinstance(N, int | np.integer) or isinstance(N, bool) or N < 1:
        raise EngdynError(f"N is {N!r}: a window has a whole number of samples, 1 or more")
    if N == 1:
        return np.ones(1)
    n = np.arange(N)
    if name == "bartlett":
        return 1 - np.abs(2 * n / N - 1)
    terms = ((-1) ** k * a * np.cos(2 * np.pi * k * n / N) for k, a in enumerate(COSINES[name]))
    return np.sum(list(terms), axis=0)


def amplitude_correction(window: Any) -> float:
    """N/Σw: what an amplitude is multiplied by so that a sine on a line has its own (2 for Hann).

    Parameters
    ----------
    window : array_like, shape (N,)
        What `window` returned.
    """
    w = _values(window)
    return len(w) / float(np.sum(w))


def energy_correction(window: Any) -> float:
    """N/Σw²: what a power is multiplied by so that noise keeps its mean square (8/3 for Hann).

    Parameters
    ----------
    window : array_like, shape (N,)
        What `window` returned.
    """
    w = _values(window)
    return len(w) / float(w @ w)


def equivalent_noise_bandwidth(window: Any) -> float:
    """N Σw²/(Σw)²: the width, in lines, of a rectangular filter that lets as much noise pass (1.5 for Hann).

    Parameters
    ----------
    window : array_like, shape (N,)
        What `window` returned.
    """
    return amplitude_correction(window) ** 2 / energy_correction(window)


def _values(window: Any) -> np.ndarray:
    w = np.asarray(window)
    if w.dtype.kind not in "fiu" or w.ndim != 1 or not np.sum(w) > 0:
        raise EngdynError(f"{window!r} is not a window: give the values that engdyn.window returns")
    return w.astype(float)
