"""How many products Fourier transforms take: by formula, and counted while they run.  Course section 9.5."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from engdyn.errors import EngdynError
from engdyn.experiment.fourier import dft, dft_by_symmetry, fft_recursive

if TYPE_CHECKING:
    import pandas as pd

__all__ = ["operation_counts"]

MOST, LARGEST = 1024, 2**28
"""Transforms up to the first length are counted, longer ones would take too long; formulas reach up to the second."""


def operation_counts(N: int | Sequence[int], counted: bool = False) -> pd.DataFrame:
    """How many products of two numbers the transforms of N samples take (Table 9.1).

    Parameters
    ----------
    N : int or sequence of int
        Numbers of samples, powers of two.
    counted : bool
        Whether to let the transforms run and count their products, in place of the formulas: N up to 1024.

    Returns
    -------
    pandas.DataFrame
        One row for each N; columns "integral" (only by formula), "definition", "table and symmetry" and "fft".

    Raises
    ------
    EngdynError
        Not powers of two; beyond 2^28, or 1024 for counting.

    Notes
    -----
    Course section 9.5. A product counts once, whether its factors are real or complex. The integrals of the N/2 + 1
    coefficients that N samples can give are taken at 21 points of each half period of the highest harmonic, N in all.
    The definition evaluates 2N² sines and cosines besides, the table 2N.
    """
    import pandas as pd

    sizes, largest = np.atleast_1d(N), MOST if counted else LARGEST
    whole = sizes.dtype.kind in "iu" and sizes.size > 0 and sizes.ndim == 1
    if not whole or np.any((sizes < 1) | (sizes > largest) | (sizes & (sizes - 1) != 0)):
        raise EngdynError(f"N is {N!r}: give powers of two up to {largest}")
    sizes = sizes.tolist()
    if counted:
        transforms = {"definition": dft, "table and symmetry": dft_by_symmetry, "fft": fft_recursive}
        rows = [{name: _products(run, n) for name, run in transforms.items()} for n in sizes]
    else:
        rows = [
            {
                "integral": 21 * n * (n // 2 + 1),
                "definition": n**2,
                "table and symmetry": 2 * ((n - 1) // 2) * (n // 2 + 1),
                "fft": n // 2 * (n.bit_length() - 1),
            }
            for n in sizes
        ]
    return pd.DataFrame(rows, index=pd.Index(sizes, name="N"))


class _Counted:
    """A number that counts the products it takes part in."""

    __array_priority__ = 1.0

    def __init__(self, value: complex, tally: list[int]):
        self.value, self.tally = value, tally

    def _new(self, value: complex) -> _Counted:
        return _Counted(value, self.tally)

    def __add__(self, other: Any) -> _Counted:
        return self._new(self.value + getattr(other, "value", other))

    def __sub__(self, other: Any) -> _Counted:
        return self._new(self.value - getattr(other, "value", other))

    def __mul__(self, other: Any) -> _Counted:
        self.tally[0] += other != 1j  # a turn by a right angle only exchanges real and imaginary part
        return self._new(self.value * other)

    def __neg__(self) -> _Counted:
        return self._new(-self.value)

    __radd__, __rmul__ = __add__, __mul__


def _products(transform: Callable[[Any], np.ndarray], N: int) -> int:
    tally = [0]
    transform(np.array([_Counted(float(n), tally) for n in range(N)], dtype=object))
    return tally[0]
