"""Rotations written out by hand in numpy, and rates by finite differences: an oracle for kinematics."""

from __future__ import annotations

import math

import numpy as np
import sympy as sm
from sympy.physics.mechanics import dynamicsymbols

H = 1e-4


def turn(axis, angle):
    """Columns: the axes turned by `angle` about the axis number `axis` (right-handed)."""
    c, s = math.cos(angle), math.sin(angle)
    i, j = (axis + 1) % 3, (axis + 2) % 3
    matrix = np.eye(3)
    matrix[i, i] = matrix[j, j] = c
    matrix[j, i], matrix[i, j] = s, -s
    return matrix


def spin(rotation, at, h=H):
    """ω in ground axes of a rotation matrix given as a function of time: the vector of Ṙ Rᵀ."""
    rate = (rotation(at + h) - rotation(at - h)) / (2 * h)
    skew = rate @ rotation(at).T
    return np.array([skew[2, 1], skew[0, 2], skew[1, 0]])


def spin_change(rotation, at, h=1e-3):
    """α in ground axes, the difference quotient of ω."""
    return (spin(rotation, at + h) - spin(rotation, at - h)) / (2 * h)


def slope(path, at, h=H):
    """Velocity of a path given as a function of time."""
    return (path(at + h) - path(at - h)) / (2 * h)


def bend(path, at, h=H):
    """Acceleration of a path given as a function of time."""
    return (path(at + h) - 2 * path(at) + path(at - h)) / h**2


def as_function(path):
    """A path of the time as a quick function."""
    return sm.lambdify(dynamicsymbols._t, path, "math")
