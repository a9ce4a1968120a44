"""Sweeps: the product of several arrays, in one process or in many."""

from __future__ import annotations

import operator
import time
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

import engdyn as ed


def power(base, exponent):
    return base**exponent


def test_results_have_the_shape_of_the_grid_in_the_order_of_its_names():
    found = ed.sweep(power, {"exponent": [1, 2, 3], "base": [2.0, 5.0]})
    np.testing.assert_array_equal(found, [[2, 5], [4, 25], [8, 125]])
    assert found.dtype == float


def test_arrays_add_axes_and_other_results_are_objects():
    vectors = ed.sweep(lambda a, b: np.array([a, b, a * b]), {"a": [1, 2], "b": [3, 4]})
    assert vectors.shape == (2, 2, 3)
    assert vectors[1, 0].tolist() == [2, 3, 6]
    words = ed.sweep(lambda a: "x" * a, {"a": [1, 2]})
    assert words.tolist() == ["x", "xx"]
    ragged = ed.sweep(lambda a: np.zeros(a), {"a": [1, 2]})
    assert [len(x) for x in ragged] == [1, 2]


def test_an_executor_gives_the_same_in_few_portions():
    grid = {"base": np.linspace(0.5, 2.0, 40), "exponent": np.arange(10)}

    class Counting(ThreadPoolExecutor):
        portions = 0

        def submit(self, *arguments, **keywords):
            self.portions += 1
            return super().submit(*arguments, **keywords)

    with Counting(2) as executor:
        found = ed.sweep(power, grid, executor)
        assert executor.portions <= 8
    np.testing.assert_array_equal(found, ed.sweep(power, grid))
    np.testing.assert_allclose(found, grid["base"][:, None] ** grid["exponent"], rtol=1e-14)


def test_workers_work_at_the_same_time():
    def slow(k):
        time.sleep(0.02)
        return k

    with ThreadPoolExecutor(8) as executor:
        begin = time.perf_counter()
        assert ed.sweep(slow, {"k": range(32)}, executor).tolist() == list(range(32))
        assert time.perf_counter() - begin < 0.4  # one after the other: 0.64 s


def test_errors_say_at_which_point():
    with pytest.raises(ZeroDivisionError) as caught:
        ed.sweep(lambda a, b: operator.truediv(a, b), {"a": [1, 2], "b": [1, 0]})
    assert caught.value.__notes__ == ["sweep: at a = 1, b = 0"]


@pytest.mark.parametrize("grid", [{}, [1, 2], {"a": []}, {"a": 3.0}, {"a": [[1, 2], [3, 4]]}])
def test_what_is_no_grid(grid):
    with pytest.raises(ed.EngdynError, match="grid"):
        ed.sweep(lambda a: a, grid)


def test_what_is_no_executor():
    with pytest.raises(ed.EngdynError, match="executor is 4: give an Executor"):
        ed.sweep(lambda a: a, {"a": [1]}, 4)
