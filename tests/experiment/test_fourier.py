"""Our transforms against numpy's, closed forms and counted products (sections 9.2 to 9.6)."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import engdyn as ed

TRANSFORMS = (ed.dft, ed.dft_by_symmetry, ed.fft_recursive, ed.fft)


def noise(N, seed=0):
    rng = np.random.default_rng(seed)
    return rng.normal(size=N) + 1j * rng.normal(size=N)


@pytest.mark.parametrize("transform", TRANSFORMS)
def test_transforms_equal_those_of_numpy_for_every_short_length(transform):
    for N in range(1, 65):
        for x in (noise(N, N), noise(N, N).real):
            assert np.max(np.abs(transform(x) - np.fft.fft(x))) < 1e-12 * N


@pytest.mark.parametrize("N", [1000, 1024, 1536, 4096])
def test_transforms_equal_those_of_numpy_for_long_records(N):
    x = noise(N)
    for transform in TRANSFORMS:
        assert np.max(np.abs(transform(x) - np.fft.fft(x))) < 1e-13 * N


@pytest.mark.parametrize("N", [2**16, 2**20, 3 * 2**17])
def test_fast_transform_of_very_long_records(N):
    x = noise(N)
    expected = np.fft.fft(x)
    assert np.max(np.abs(ed.fft(x) - expected)) < 1e-13 * np.max(np.abs(expected))


@given(st.lists(st.complex_numbers(max_magnitude=1e3), min_size=1, max_size=40))
def test_round_trip_and_parseval(samples):
    x = np.array(samples)
    X = ed.fft(x)
    assert np.max(np.abs(ed.idft(X) - x)) <= 1e-12 * (1 + np.max(np.abs(x)))
    assert np.sum(np.abs(X) ** 2) / len(x) == pytest.approx(np.sum(np.abs(x) ** 2), rel=1e-12, abs=1e-12)


def test_W11_has_the_coefficients_of_its_three_terms():
    t = np.arange(8) / 16
    X = ed.dft(0.5 + np.cos(2 * np.pi * 2 * t) + 0.6 * np.sin(2 * np.pi * 6 * t)) / 8
    assert np.max(np.abs(X - [0.5, 0.5, 0, -0.3j, 0, 0.3j, 0, 0.5])) < 1e-15


def test_pitfall_23_amplitudes_of_even_and_odd_records():
    """Scaled by N alone, or every line doubled, or the last line of an odd record not doubled: each is wrong."""
    for N, lines in ((8, 5), (9, 5)):
        t = np.arange(N) / N
        x = (
            0.5 + 0.9 * np.cos(2 * np.pi * t) + 0.4 * np.cos(2 * np.pi * 4 * t)
        )  # 4: Nyquist of 8, but not of 9
        found = ed.amplitude_spectrum(ed.Record(x, N))
        assert found.values == pytest.approx([0.5, 0.9, 0, 0, 0.4], abs=1e-15)
        assert len(found.values) == lines
        X = np.abs(ed.fft(x)) / N
        assert X[4] == pytest.approx(0.4 if N == 8 else 0.2)


def test_coefficients_of_the_example_of_section_9_6_equal_those_of_its_samples():
    def x(t):
        return 0.8 + 1.5 * np.cos(6 * np.pi * t) + 0.7 * np.sin(16 * np.pi * t) + 0.2 * np.cos(22 * np.pi * t)

    c = ed.fourier_coefficients(x, 1.0, 15)
    expected = np.zeros(16, dtype=complex)
    expected[[0, 3, 8, 11]] = 0.8, 0.75, -0.35j, 0.1
    assert np.max(np.abs(c - expected)) < 1e-13
    assert np.max(np.abs(ed.fft(x(np.arange(32) / 32))[:16] / 32 - c)) < 1e-13


def test_coefficients_of_a_square_wave_and_of_a_triangle():
    square = ed.fourier_coefficients(lambda t: 1.0 if t < 0.2 else -1.0, 0.4, 9, breaks=[0.2])
    k = np.arange(1, 10, 2)
    assert np.max(np.abs(square[1::2] + 2j / (np.pi * k))) < 1e-14
    assert np.max(np.abs(square[::2])) < 1e-14
    triangle = ed.fourier_coefficients(lambda t: 1 - abs(t), 2.0, 9, start=-1.0, breaks=[0.0])
    # Counted from its start, at −1, half a period before the peak.
    assert np.max(np.abs(triangle[1::2] * np.exp(1j * np.pi * k) - 2 / (np.pi * k) ** 2)) < 1e-14
    assert triangle[0] == pytest.approx(0.5)


def test_a_pulse_between_two_points_of_a_coarse_rule_is_not_missed():
    c = ed.fourier_coefficients(lambda t: np.exp(-(((t - 0.37) / 0.004) ** 2)), 1.0, 20)
    assert c[0] == pytest.approx(0.004 * np.sqrt(np.pi), rel=1e-9)


def test_rectangle_rule_errs_where_the_function_has_higher_harmonics():
    """X/N holds all coefficients whose harmonics fold onto line k, which is why it differs from the integral."""
    N = 16
    c = ed.fourier_coefficients(lambda t: np.exp(np.cos(2 * np.pi * t)) ** 4, 1.0, 40)
    X = ed.fft(np.exp(np.cos(2 * np.pi * np.arange(N) / N)) ** 4) / N
    assert abs(X[8] - c[8]) > 0.9 * abs(c[8])
    assert X[8].real == pytest.approx(2 * c[8].real + 2 * c[24].real, rel=1e-9)


def test_products_counted_while_transforms_run_are_those_of_the_formulas():
    sizes = [1, 2, 4, 16, 128]
    by_formula, counted = ed.operation_counts(sizes), ed.operation_counts(sizes, counted=True)
    assert (by_formula[counted.columns] == counted).to_numpy().all()
    big = ed.operation_counts(2**20).loc[2**20]
    assert big["fft"] == 10 * 2**20
    assert big["definition"] == 2**40
    assert big["table and symmetry"] == pytest.approx(2**39, rel=1e-5)


def test_integrals_take_about_as_many_products_as_the_formula_says():
    calls = []
    ed.fourier_coefficients(lambda t: calls.append(t) or np.cos(2 * np.pi * 3 * t), 1.0, 32)
    counted = len(calls) * 33
    assert ed.operation_counts(64).loc[64, "integral"] / counted == pytest.approx(1, abs=0.1)


def test_refusals():
    for wrong in ([], [[1.0, 2.0]], [1.0, np.nan], ["a"]):
        for transform in (*TRANSFORMS, ed.idft):
            with pytest.raises(ed.EngdynError, match="row of finite numbers"):
                transform(wrong)
    with pytest.raises(ed.EngdynError, match="cut the record to 8192, or use numpy"):
        ed.fft(np.ones(10007))
    for wrong in (2048, [8, 12], 0, 8.0, [], "8"):
        with pytest.raises(ed.EngdynError, match="powers of two up to 1024"):
            ed.operation_counts(wrong, counted=True)
    with pytest.raises(ed.EngdynError, match="positive time"):
        ed.fourier_coefficients(np.cos, 0.0, 3)
    with pytest.raises(ed.EngdynError, match="do not converge"):
        ed.fourier_coefficients(lambda t: 1 / t if t else np.inf, 1.0, 1)
