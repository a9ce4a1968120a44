"""Pictures look as they did: comparison with small reference images.

Set ENGDYN_UPDATE_BASELINE=1 to write the reference images anew, then look at every one of them.
"""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np
import pytest
from matplotlib.testing.compare import compare_images

import engdyn as ed
from engdyn.plots.alternative import png

BASELINE = Path(__file__).parent / "baseline"

TOLERANCE = 12.0
"""Root-mean-square difference of gray levels: another release of matplotlib or FreeType may move edges of letters."""


def governor():
    return ed.plots.draw(ed.systems.load(3), [0.77269])


def crane():
    return ed.plots.draw(ed.systems.load(7), [2.0, 0.45])


def half_car():
    return ed.plots.draw(ed.systems.load(23), [-0.2155, -0.0154, -0.0259, -0.0193])


def governor_poses():
    system = ed.systems.load(3)
    return ed.plots.equilibrium_poses(system, system.equilibria())


def crane_energy():
    system = ed.systems.load(7)
    return ed.plots.potential_energy(system, equilibria=system.equilibria())


def half_car_energy():
    system = ed.systems.load(23)
    tilt = ("theta", np.linspace(-0.3, 0.3, 61))
    return ed.plots.potential_energy(system, x="z", y=tilt, equilibria=system.equilibria())


def governor_branches():
    system = ed.systems.load(3)
    found = ed.continue_equilibria(
        system.equations, system.values(), "Omega", (5.0, 30.0), bounds=system.bounds
    )
    return ed.plots.branches(found, "theta", system=system)


PICTURES = [governor, crane, half_car, governor_poses, crane_energy, half_car_energy, governor_branches]


@pytest.mark.parametrize("picture", PICTURES, ids=lambda picture: picture.__name__)
def test_picture_looks_as_it_did(picture, tmp_path):
    expected, actual = BASELINE / f"{picture.__name__}.png", tmp_path / f"{picture.__name__}.png"
    image = png(picture(), dpi=50)
    if os.environ.get("ENGDYN_UPDATE_BASELINE"):
        expected.write_bytes(image)
    actual.write_bytes(image)
    assert compare_images(str(expected), str(actual), TOLERANCE) is None


def test_the_comparison_notices_missing_labels(tmp_path):
    other = tmp_path / "other.png"
    other.write_bytes(png(ed.plots.draw(ed.systems.load(7), [2.0, 0.45], labels=False), dpi=50))
    reference = tmp_path / "crane.png"
    reference.write_bytes((BASELINE / "crane.png").read_bytes())
    assert compare_images(str(reference), str(other), TOLERANCE) is not None
