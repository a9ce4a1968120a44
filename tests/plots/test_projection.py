"""From meters to the picture."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from engdyn.plots.projection import View, arc, box_faces
from engdyn.shapes import Box

ANGLES = st.floats(-10.0, 10.0)


@given(ANGLES, ANGLES)
def test_the_axes_of_a_view_are_a_right_handed_triad(azimuth, elevation):
    axes = View(azimuth, elevation).axes
    assert axes @ axes.T == pytest.approx(np.eye(3), abs=1e-12)
    assert np.cross(axes[0], axes[1]) == pytest.approx(axes[2], abs=1e-12)


def test_plane_points_stay_what_they_are():
    points = np.array([(1.0, 2.0), (-3.0, 0.5)])
    assert np.array_equal(View(1.0, 1.0).project(points), points)


def test_front_view_shows_y_to_the_right_and_z_up():
    view = View(azimuth=0.0, elevation=0.0)
    assert view.project([(5.0, 1.0, 2.0)])[0] == pytest.approx([1.0, 2.0])
    assert view.depth([(5.0, 1.0, 2.0), (3.0, 0.0, 0.0)]) == pytest.approx(4.0)


def test_arc_passes_through_its_cardinal_points():
    points = arc((1.0, 2.0), 3.0, [0.0, math.pi / 2, math.pi])
    assert points == pytest.approx(np.array([(4, 2), (1, 5), (-2, 2)]))


def test_arc_in_space_lies_in_the_plane_of_its_axes():
    points = arc((0.0, 0.0, 1.0), 2.0, np.linspace(0, 6, 20), x_axis=(0.0, 1.0, 0.0), y_axis=(0.0, 0.0, 1.0))
    assert np.all(points[:, 0] == 0.0)
    assert np.linalg.norm(points - [0, 0, 1], axis=1) == pytest.approx(np.full(20, 2.0))


def area(corners):
    x, y = corners.T
    return 0.5 * abs(np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1)))


@given(st.floats(-4, 4))
def test_turning_a_rectangle_keeps_its_area_and_center(angle):
    (corners,) = box_faces(Box((1.0, 2.0), (3.0, 0.5), angle=angle))
    assert area(corners) == pytest.approx(1.5)
    assert corners.mean(axis=0) == pytest.approx([1.0, 2.0])
    edge = corners[1] - corners[0]
    assert edge == pytest.approx([3.0 * math.cos(angle), 3.0 * math.sin(angle)])


def test_a_box_in_space_has_six_faces_and_eight_corners():
    faces = box_faces(Box((0.0, 0.0, 0.0), (1.0, 2.0, 3.0)))
    assert len(faces) == 6
    corners = {tuple(np.round(corner, 9)) for face in faces for corner in face}
    assert corners == {(x, y, z) for x in (-0.5, 0.5) for y in (-1.0, 1.0) for z in (-1.5, 1.5)}
    for face in faces:
        # In order: no diagonal is walked, so opposite edges are parallel.
        assert face[1] - face[0] == pytest.approx(face[2] - face[3])
