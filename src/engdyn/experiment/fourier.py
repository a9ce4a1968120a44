"""Fourier coefficients and discrete Fourier transforms, as the course teaches them.  Sections 9.2 to 9.5.

The transforms are unscaled, as in most libraries: X_k = Σ x_n exp(−2πi kn/N), so that X_k/N is the rectangle rule
for the Fourier coefficient c_k. For work on data, `spectra` uses scipy's transforms.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from engdyn.errors import EngdynError

__all__ = [
    "dft",
    "dft_by_symmetry",
    "fft",
    "fft_recursive",
    "fourier_coefficients",
    "idft",
]

BASE = 16
"""Transforms as short as this are products with a matrix: quicker than splitting them further."""

LARGEST_ODD = 1023
"""`fft` gives up where the length, divided by two as often as it can be, is still larger than this."""


def fourier_coefficients(
    function: Callable[[float], float],
    period: float,
    count: int,
    *,
    start: float = 0.0,
    breaks: Sequence[float] = (),
) -> np.ndarray:
    """Fourier coefficients of a continuous function, by integrals.

    Parameters
    ----------
    function : callable
        x(t), a number for a time [s] from ``start`` to ``start + period``.
    period : float
        T [s]; what lies outside of it is taken for a repetition.
    count : int
        Highest harmonic wanted.
    start : float
        [s]
    breaks : sequence of float
        Times within the period at which the function jumps or has a corner [s]: integrals are split there.

    Returns
    -------
    ndarray of complex, shape (count + 1,)
        c_k = (1/T) ∫ x(t) exp(−2πi kt/T) dt for k = 0 … count. Of a real function c₋ₖ is the conjugate, the cosine
        of harmonic k has the amplitude 2 Re c_k, the sine −2 Im c_k.

    Raises
    ------
    EngdynError
        A period that is not positive, a negative count, integrals that do not converge.

    Notes
    -----
    Course section 9.2. Adaptive Gauss–Kronrod quadrature of all integrals together (``scipy.integrate.quad_vec``).
    """
    from scipy.integrate import quad_vec

    if not (0 < period < np.inf) or not isinstance(count, int | np.integer) or count < 0:
        raise EngdynError(
            f"period = {period!r}, count = {count!r}: give a positive time and the highest harmonic, 0 or more"
        )
    rates = -2j * np.pi * np.arange(count + 1) / period
    # At least two panels for each period of the highest harmonic: none is mistaken for a constant.
    panels = np.concatenate([np.linspace(start, start + period, 2 * count + 2), breaks])
    accuracy = {"epsabs": 1e-11, "epsrel": 1e-11, "norm": "max", "limit": 10_000}
    with np.errstate(all="ignore"):  # what is not finite is told below
        integrals, error = quad_vec(
            lambda t: function(t) * np.exp(rates * (t - start)) / period,
            start,
            start + period,
            points=np.unique(panels),
            **accuracy,
        )
    if not np.all(np.isfinite(integrals)) or error > 1e-6 * np.max(np.abs(integrals)):
        raise EngdynError(
            "the integrals do not converge: name the times where the function jumps by breaks=, and see that it is "
            "finite"
        )
    return integrals


def dft(x: Any) -> np.ndarray:
    """Discrete Fourier transform by its definition: X_k = Σ x_n exp(−2πi kn/N), N² products.

    Parameters
    ----------
    x : array_like, shape (N,)
        Real or complex.

    Returns
    -------
    ndarray of complex, shape (N,)

    Raises
    ------
    EngdynError
        Not a row of finite numbers.

    Notes
    -----
    Course section 9.3.

    Examples
    --------
    >>> dft([1, 0, -1, 0]).round(12).real.tolist()
    [0.0, 2.0, 0.0, 2.0]
    """
    x = _checked(x)
    N = len(x)
    n = np.arange(N)
    return np.array([np.sum(x * np.exp(-2j * np.pi * (k * n % N) / N)) for k in range(N)])


def idft(X: Any) -> np.ndarray:
    """Inverse of the discrete Fourier transform: x_n = (1/N) Σ X_k exp(+2πi kn/N).

    Parameters
    ----------
    X : array_like, shape (N,)

    Returns
    -------
    ndarray of complex, shape (N,)

    Notes
    -----
    Course section 9.3. The definition with the other sign, which is the conjugate of the transform of the conjugate.
    """
    X = _checked(X)
    return np.conj(dft(np.conj(X))) / len(X)


def dft_by_symmetry(x: Any) -> np.ndarray:
    """Discrete Fourier transform with one table of sines and cosines, and half of the work done once for two.

    Parameters
    ----------
    x : array_like, shape (N,)

    Returns
    -------
    ndarray of complex, shape (N,)

    Notes
    -----
    Course section 9.4. All the angles 2π kn/N are multiples of 2π/N: N sines and N cosines suffice. The cosine of
    sample n equals that of sample N − n, the sine is its negative, so sums and differences of such samples are
    multiplied instead of the samples; and X_k and X_{N−k} share both results. About N²/2 products.
    """
    x = _checked(x)
    N = len(x)
    angles = 2 * np.pi * np.arange(N) / N
    cosine, sine = np.cos(angles), np.sin(angles)
    n = np.arange(1, (N + 1) // 2)  # samples that have a partner N − n other than themselves
    sums, differences = x[n] + x[-n], x[n] - x[-n]
    X = np.empty(N, dtype=np.result_type(x, complex))
    for k in range(N // 2 + 1):
        even, odd = np.sum(sums * cosine[k * n % N]), np.sum(differences * sine[k * n % N])
        middle = (-x[N // 2] if k % 2 else x[N // 2]) if N % 2 == 0 else 0.0
        X[k], X[-k] = x[0] + middle + even - 1j * odd, x[0] + middle + even + 1j * odd
    return X


def fft_recursive(x: Any) -> np.ndarray:
    """Fast Fourier transform, written as it is thought: even and odd samples are transformed apart and combined.

    Parameters
    ----------
    x : array_like, shape (N,)
        Where N cannot be halved any further, what is left is transformed by the definition.

    Returns
    -------
    ndarray of complex, shape (N,)

    Notes
    -----
    Course section 9.5. Radix 2: J. W. Cooley and J. W. Tukey, *Mathematics of Computation* 19 (1965) 297. (N/2) log₂N
    products where N is a power of two. `fft` does the same many times faster.
    """
    x = _checked(x)
    N = len(x)
    if N == 1:
        return x.astype(np.result_type(x, complex))
    if N % 2:
        return dft(x)
    even, odd = fft_recursive(x[::2]), fft_recursive(x[1::2])
    turned = odd * np.exp(-2j * np.pi * np.arange(N // 2) / N)
    return np.concatenate([even + turned, even - turned])


def fft(x: Any) -> np.ndarray:
    """Fast Fourier transform, radix 2, all transforms of one length at once.

    Parameters
    ----------
    x : array_like, shape (N,)
        Real or complex. N need not be a power of two, but each halving that is possible saves half of the work.

    Returns
    -------
    ndarray of complex, shape (N,)

    Raises
    ------
    EngdynError
        Not a row of finite numbers; a length with an odd factor above 1023, of which radix 2 makes nothing better
        than the definition.

    Notes
    -----
    Course section 9.5. Row j of the array holds, for all columns, line j of the transforms of as many interleaved
    parts of the record; each step combines two halves of the columns, the even and the odd parts.
    """
    x = _checked(x)
    N = length = len(x)
    while length % 2 == 0 and length > BASE:
        length //= 2
    if length > LARGEST_ODD:
        raise EngdynError(
            f"{N} samples cannot be halved beyond {length}: cut the record to {2 ** (N.bit_length() - 1)}, or use "
            "numpy.fft"
        )
    j = np.arange(length)
    X = np.exp(-2j * np.pi * (np.outer(j, j) % length) / length) @ x.reshape(length, -1)
    while (rows := len(X)) < N:
        half = X.shape[1] // 2
        turned = X[:, half:] * np.exp(-1j * np.pi * np.arange(rows) / rows)[:, None]
        X, even = np.empty((2 * rows, half), dtype=complex), X[:, :half]
        np.add(even, turned, out=X[:rows])
        np.subtract(even, turned, out=X[rows:])
    return X[:, 0]


def _checked(given: Any) -> np.ndarray:
    """Samples as floats or complex numbers; numbers that count their products stay what they are."""
    x = np.asarray(given)
    counting = x.dtype == object and all(hasattr(item, "tally") for item in x.flat)
    if x.ndim != 1 or not len(x) or not (counting or (x.dtype.kind in "biufc" and np.all(np.isfinite(x)))):
        raise EngdynError("a transform needs a row of finite numbers, real or complex, one at least")
    return x if counting or x.dtype.kind == "c" else x.astype(float)
