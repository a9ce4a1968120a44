"""W4 Thrown ball: an axisymmetric body in free flight.  The worked example of sections 2.12 and 3.6."""

from __future__ import annotations

from math import cos, pi, sin, sqrt

import numpy as np
import sympy as sm
from sympy.physics.mechanics import Force, Point, ReferenceFrame, RigidBody, dynamicsymbols, inertia

from engdyn import shapes as sh
from engdyn.modeling.newton import FreeBody
from engdyn.quantities import Coordinate, Parameter
from engdyn.system import System

PARAMETERS = (
    Parameter("m", "kg", 0.42, "mass"),
    Parameter("A", "kg m^2", 0.0032, "transverse moment of inertia"),
    Parameter("C", "kg m^2", 0.0020, "axial moment of inertia"),
    Parameter("g", "m/s^2", 9.81, "gravity", "any"),
)
m, A, C, g = (p.symbol for p in PARAMETERS)

x, y, z, phi, theta, psi = dynamicsymbols("x y z phi theta psi")
x_d, y_d, z_d, phi_d, theta_d, psi_d = dynamicsymbols("x y z phi theta psi", 1)

ground = ReferenceFrame("N")  # X in the direction of the throw, Z up
nodal = ReferenceFrame("D")  # precesses and nutates: X along the axis of the ball, Z along the line of nodes
nodal.orient_body_fixed(ground, (phi, theta, 0), "XZX")
ball_axes = ReferenceFrame("B")  # spins as well
ball_axes.orient_axis(nodal, psi, nodal.x)

#: From where the outline of the ball is seen: the direction of the eye in the usual view of a drawing.
EYE = np.array([cos(pi / 9) * cos(pi / 3), -cos(pi / 9) * sin(pi / 3), sin(pi / 9)])


def free_bodies() -> list[FreeBody]:
    """The ball; nothing but its weight acts."""
    start = Point("O")
    start.set_vel(ground, 0)
    center = start.locatenew("G", x * ground.x + y * ground.y + z * ground.z)
    body = RigidBody("ball", center, ball_axes, m, (inertia(ball_axes, C, A, A), center))
    return [FreeBody(body, applied=[Force(center, -m * g * ground.z)])]


def half_sizes(values: dict[str, float]) -> tuple[float, float]:
    """Half length and radius [m] of the uniform ellipsoid with the mass and the moments of the ball."""
    radius = sqrt(2.5 * values["C"] / values["m"])
    return sqrt(5.0 * values["A"] / values["m"] - radius**2), radius  # real, as C < 2 A


def _skin(center: np.ndarray, axes: np.ndarray, sizes: np.ndarray, spin: float) -> list:
    """The ball as it is seen: outline, the two stripes, and the laces that show the spin."""
    eye = axes.T @ EYE / sizes  # where the eye is, on the unit sphere that becomes the ball
    side = np.cross(eye, (0.0, 0.0, 1.0))
    basis = np.array([side / np.linalg.norm(side), np.cross(eye, side) / np.linalg.norm(np.cross(eye, side))])
    turn = np.linspace(0.0, 2 * pi, 73)
    circle = np.column_stack([np.cos(turn), np.sin(turn)])

    def on_ball(units: np.ndarray) -> tuple:
        return tuple(map(tuple, center + (units * sizes) @ axes.T))

    def seen(units: np.ndarray, role: str) -> list:
        visible = units @ eye > 0
        first = int(np.argmin(visible))  # start where the line is hidden: what is seen is then in one piece
        units, visible = np.roll(units, -first, axis=0), np.roll(visible, -first)
        return [sh.Curve(on_ball(units[visible]), role=role)] if visible.sum() > 1 else []

    def ring(latitude: float) -> np.ndarray:
        return np.column_stack([np.full(72, sin(latitude)), cos(latitude) * circle[:-1]])

    def lace(start: tuple[float, float], end: tuple[float, float]) -> np.ndarray:
        latitude, longitude = np.linspace(start, end, 25).T
        return np.column_stack(
            [np.sin(latitude), np.cos(latitude) * np.cos(longitude), np.cos(latitude) * np.sin(longitude)]
        )

    laces = [lace((-0.5, spin), (0.5, spin))]
    laces += [lace((k, spin - 0.17), (k, spin + 0.17)) for k in (-0.4, -0.2, 0.0, 0.2, 0.4)]
    stripes = [curve for latitude in (-0.75, 0.75) for curve in seen(ring(latitude), "body")]
    return [
        sh.Polygon(on_ball(circle @ basis)),
        *stripes,
        *(curve for line in laces for curve in seen(line, "joint")),
    ]


def _place(q: list[float], length: float) -> list:
    """x, y and z of G one after the other; near the start they stand beside the ball."""
    near = np.linalg.norm(q[:3]) < 2 * length
    end, drawn = length * np.array([-1.5, 0.0, -1.3]) * near, []
    for name, distance, direction in zip("xyz", q, np.eye(3), strict=False):
        start, end = end, end + distance * direction
        drawn.append(sh.CoordinateArrow(tuple(start), tuple(end), f"${name}$", positive=tuple(direction)))
    return drawn


def shapes(q: list[float], values: dict[str, float]) -> list:
    """In space; the ball is the uniform ellipsoid with its mass and moments, outlined as the usual view sees it."""
    phi, theta, psi = q[3:]
    length, radius = half_sizes(values)
    forward, left, up = np.eye(3)
    lean = np.array([0.0, cos(phi), sin(phi)])  # square to the throw, to where the axis leans
    axis, across = cos(theta) * forward + sin(theta) * lean, cos(theta) * lean - sin(theta) * forward
    node, center = np.cross(forward, lean), np.array(q[:3])
    reach, girth = 2.3 * length, 1.25 * radius

    def at(along: float, direction: np.ndarray) -> tuple[float, ...]:
        return tuple(center + along * direction)

    hoop = at(
        reach * cos(theta), forward
    )  # the center of the circle on which a point of the axis goes around
    wide = reach * sin(theta)
    turn = np.linspace(0.0, 2 * pi, 73)[:, None]
    circle = np.array(hoop) + wide * (np.cos(turn) * left + np.sin(turn) * up)
    return [
        *_skin(center, np.column_stack([axis, across, node]), np.array([length, radius, radius]), psi),
        sh.CenterLine(at(-1.6 * length, forward), at(reach, forward)),
        sh.CenterLine(at(reach, forward), at(1.3 * reach, forward), "$X$", arrow=True),
        sh.CenterLine(at(-1.4 * length, axis), at(1.15 * reach, axis), role="joint"),
        sh.CenterOfMass(at(0.0, axis)),
        sh.Curve(tuple(map(tuple, circle)), role="reference"),
        sh.CenterLine(hoop, tuple(hoop + wide * left)),
        sh.CenterLine(hoop, at(reach, axis)),
        sh.AngleArrow(hoop, 0.6 * wide, 0.0, phi, r"$\phi$", tuple(left), tuple(up)),
        sh.AngleArrow(at(0.0, axis), 1.6 * length, 0.0, theta, r"$\theta$", tuple(forward), tuple(lean)),
        sh.CenterLine(at(0.0, axis), at(1.5 * radius, across), role="joint"),
        sh.AngleArrow(at(0.0, axis), girth, 0.0, psi, r"$\psi$", tuple(across), tuple(node)),
        sh.Label(at(-1.3 * radius, up), "$m,\\ A,\\ C$"),
        *_place(q, length),
        sh.GravityArrow(at(-1.9 * length, forward - 0.3 * up), at(-1.9 * length, forward + 0.1 * up), "$g$"),
    ]


def build() -> System:
    """The ball as a System."""
    axial = psi_d + phi_d * sm.cos(theta)
    rotation = A * (theta_d**2 + phi_d**2 * sm.sin(theta) ** 2) / 2 + C * axial**2 / 2
    return System(
        key="thrown_ball",
        title="Axisymmetric ball in free flight",
        field="worked example",
        description=(
            "A ball of elongated shape (mass m, axial moment of inertia C, transverse A about the mass center G) flies "
            "with a spin about its long axis; the air is left out. x (in the direction of the throw), y and z (up) "
            "place G. From the direction of the throw the attitude follows by the precession phi about X, the "
            "nutation theta about the turned z axis, and the spin psi about the axis of the ball."
        ),
        coordinates=(
            Coordinate(x, "m", "travel of G in the direction of the throw", None, "ignorable"),
            Coordinate(y, "m", "travel of G to the left", None, "ignorable"),
            Coordinate(z, "m", "height of G", None, "ignorable"),
            Coordinate(phi, "rad", "precession about the direction of the throw", None, "ignorable"),
            Coordinate(
                theta, "rad", "nutation: angle of the axis from the direction of the throw", (0.02, pi - 0.02)
            ),
            Coordinate(psi, "rad", "spin about the axis of the ball", None, "ignorable"),
        ),
        parameters=PARAMETERS,
        kinetic_energy=m * (x_d**2 + y_d**2 + z_d**2) / 2 + rotation,
        potential_energy=m * g * z,
        frame=ground,
        free_bodies=free_bodies,
        shapes=shapes,
        pose=(0.0, 0.0, 0.0, 2.2, 0.45, 0.7),
    )
