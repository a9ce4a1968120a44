"""Spectra of long records and our own FFT: engdyn against scipy.signal and numpy.fft.

    python -m benchmarks.spectra [--quick] [--samples N] [--rounds N] [--budget S]

One run times all tools in turn, round after round, on the same record of noise.  "density" is
power_spectral_density against scipy.signal.welch, "response" is estimate_frf with its coherence against
scipy.signal.csd, welch and coherence; both with Hann windows and half of each segment shared.  "fft" is our vectorized
radix-2 transform of 2^16 numbers against numpy.fft.fft.  Results are compared: densities and responses to 1e-12,
transforms to 1e-12 of the largest line.

How to read the table: times in milliseconds; "peer ×" is how many times longer the peer takes.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable
from typing import Any

import numpy as np
import scipy.signal

import engdyn as ed
from benchmarks.timing import heading, interleaved

SEGMENTS = (1024, 8192, 65536)
RATE = 1000.0


def density(samples: int, segment: int) -> dict[str, Callable[[], np.ndarray]]:
    x = np.random.default_rng(0).normal(size=samples)
    record = ed.Record(x, RATE)
    return {
        "engdyn": lambda: ed.power_spectral_density(record, segment=segment).values,
        "peer": lambda: scipy.signal.welch(x, RATE, nperseg=segment)[1],
    }


def response(samples: int, segment: int) -> dict[str, Callable[[], np.ndarray]]:
    rng = np.random.default_rng(1)
    x = rng.normal(size=samples)
    y = scipy.signal.lfilter(*scipy.signal.butter(2, 0.3), x) + 0.1 * rng.normal(size=samples)
    a, b = ed.Record(x, RATE), ed.Record(y, RATE)

    def ours() -> np.ndarray:
        found = ed.estimate_frf(a, b, segment=segment)
        return np.concatenate([found.response, found.coherence])

    def peer() -> np.ndarray:
        xx, xy = (scipy.signal.csd(x, other, RATE, nperseg=segment)[1] for other in (x, y))
        return np.concatenate([xy / xx, scipy.signal.coherence(x, y, RATE, nperseg=segment)[1]])

    return {"engdyn": ours, "peer": peer}


def transform(length: int) -> dict[str, Callable[[], np.ndarray]]:
    x = np.random.default_rng(2).normal(size=(2, length))
    x = x[0] + 1j * x[1]
    return {"engdyn": lambda: ed.fft(x), "peer": lambda: np.fft.fft(x)}


def compared(works: dict[str, Callable[[], Any]], rounds: int, budget: float, relative: bool) -> list[float]:
    """Median milliseconds of both tools, and by how much their results differ."""
    tools = {name: lambda w=work: w for name, work in works.items()}
    times, results = interleaved(tools, rounds, budget, warm=True)
    ours, theirs = results["engdyn"], results["peer"]
    scale = np.abs(theirs) if relative else np.max(np.abs(theirs))
    error = float(np.max(np.abs(ours - theirs) / scale))
    if error > 1e-12:
        raise AssertionError(f"the results differ by {error:.1e}")
    return [times["engdyn"], times["peer"], error]


def main(arguments: list[str] | None = None) -> None:
    """Run and print the table."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--quick", action="store_true", help="a record of 1e6 samples, one round")
    parser.add_argument("--samples", type=int, default=10**7)
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--budget", type=float, default=60.0, help="seconds for one line")
    options = parser.parse_args(arguments)
    samples, rounds = (10**6, 1) if options.quick else (options.samples, options.rounds)
    rows = [(f"density, segments of {n}", density(samples, n), True) for n in SEGMENTS]
    rows += [(f"response, segments of {n}", response(samples, n), False) for n in SEGMENTS]
    rows += [("fft, 2^16 numbers", transform(2**16), False)]
    print(f"{heading()}; numpy {np.__version__}, scipy {scipy.__version__}; medians, {samples} samples\n")
    print(f"{'work':28}{'engdyn':>10}{'peer':>10}{'peer ×':>10}{'difference':>14}")
    for name, works, relative in rows:
        ours, peer, error = compared(works, rounds, options.budget, relative)
        print(f"{name:28}{ours:10.2f}{peer:10.2f}{peer / ours:10.2f}{error:14.1e}", flush=True)


if __name__ == "__main__":
    main()
