"""Records: sampled data with a rate, a name and a unit."""

from __future__ import annotations

import numpy as np
import pytest

import engdyn as ed


def test_channels_have_names_units_and_a_common_time():
    record = ed.Record(np.arange(6).reshape(3, 2), 50, ["x", "F"], "m", start=1.0)
    np.testing.assert_allclose(record.time, [1.0, 1.02, 1.04])
    assert (len(record), record.duration, record.channels, record.units) == (3, 0.06, ("x", "F"), ("m", "m"))
    force = record["F"]
    assert (force.name, force.unit, force.rate, force.start) == ("F", "m", 50.0, 1.0)
    np.testing.assert_array_equal(force.samples, [1.0, 3.0, 5.0])
    np.testing.assert_array_equal(record[0].samples, [0.0, 2.0, 4.0])
    assert force["F"].samples.shape == (3,)
    assert repr(record) == "Record(x [m], F [m]; 3 samples at 50 per second)"
    assert "<td>x</td><td>m</td><td>0</td><td>4</td>" in record._repr_html_()


def test_a_record_does_not_change_with_the_array_it_was_made_of():
    samples = np.zeros(4)
    record = ed.Record(samples, 1.0)
    samples[0] = 9.0
    assert record.samples[0] == 0.0
    with pytest.raises(ValueError, match="read-only"):
        record.samples[0] = 1.0


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (([1, np.nan, 2, np.inf], 10), "2 of the samples are not finite, the first in row 1"),
        (([1, 2], 0), "rate is 0"),
        (([1, 2], -5.0), "rate is -5.0"),
        (([1, 2], np.nan), "rate is nan"),
        (([1, 2], "fast"), "rate is 'fast'"),
        (([1], 10), "two or more"),
        (([[1, 2], [3]], 10), "array of real numbers"),
        ((["a", "b"], 10), "real numbers"),
        (([1 + 2j, 3], 10), "real numbers"),
        ((np.zeros((2, 2, 2)), 10), "real numbers"),
        (([[1, 2], [3, 4]], 10, ["only one"]), "name is .* for 2 channels"),
        (([[1, 2], [3, 4]], 10, ["x", "x"]), "each its own"),
        (([1, 2], 10, "x", ["m", "N"]), "unit is .* for 1 channel:"),
    ],
)
def test_data_that_cannot_be_used_are_refused(arguments, message):
    with pytest.raises(ed.RecordError, match=message):
        ed.Record(*arguments)


def test_unknown_channels_are_named():
    record = ed.Record(np.zeros((3, 2)), 10, ["x", "F"])
    for channel in ("y", 2, -1):
        with pytest.raises(ed.RecordError, match="x, F"):
            record[channel]


def test_a_steep_blow_that_clips_is_told_as_clipping():
    """Flat at full scale between steep edges: the largest magnitude, so no dropout."""
    x = 0.01 * np.random.default_rng(0).normal(size=400)
    x[100:120] += 5.0 * np.sin(np.linspace(0.0, np.pi, 20))
    (seen,) = ed.Record(np.clip(x, -0.5, 0.5), 1000.0, "a", "m/s^2").summary().channels
    assert (seen.dropouts, seen.clipped) == (0, 18)
