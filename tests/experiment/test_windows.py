"""Every window against scipy.signal, and what it does to sines and noise (section 9.8)."""

from __future__ import annotations

import numpy as np
import pytest
import scipy.signal

import engdyn as ed
from engdyn.experiment.windows import COSINES

NAMES = (*COSINES, "bartlett")


@pytest.mark.parametrize("name", NAMES)
def test_windows_equal_those_of_scipy(name):
    for N in (1, 2, 3, 7, 8, 255, 256):
        assert np.max(np.abs(ed.window(name, N) - scipy.signal.get_window(name, N))) < 1e-15


def test_corrections_of_hann_are_the_well_known_ones():
    w = ed.window("hann", 64)
    found = [f(w) for f in (ed.amplitude_correction, ed.energy_correction, ed.equivalent_noise_bandwidth)]
    assert found == pytest.approx([2, 8 / 3, 1.5], rel=1e-14)
    assert ed.equivalent_noise_bandwidth(ed.window("boxcar", 64)) == pytest.approx(1)
    assert ed.equivalent_noise_bandwidth(ed.window("flattop", 4096)) == pytest.approx(3.7702, abs=1e-4)


@pytest.mark.parametrize("name", NAMES)
def test_noise_bandwidth_is_what_noise_shows_at_a_line(name):
    """Power of white noise at a line over that of a boxcar, both corrected for sines."""
    x = np.random.default_rng(2).normal(size=(4000, 64))
    w = ed.window(name, 64)
    line = np.mean(np.abs(np.fft.rfft(x * w * ed.amplitude_correction(w))[:, 8:24]) ** 2) / 64
    assert line == pytest.approx(ed.equivalent_noise_bandwidth(w), rel=0.02)


def test_refusals():
    with pytest.raises(ed.EngdynError, match="choose one of boxcar, hann"):
        ed.window("hanning", 8)
    with pytest.raises(ed.EngdynError, match="choose one of boxcar, hann"):
        ed.window(["hann"], 8)
    for wrong in (0, 8.0, True):
        with pytest.raises(ed.EngdynError, match="whole number of samples"):
            ed.window("hann", wrong)
    with pytest.raises(ed.EngdynError, match="is not a window"):
        ed.amplitude_correction("hann")
