"""S18 Car with a single-axle trailer at constant speed: weave above a critical speed."""

from __future__ import annotations

from collections.abc import Mapping
from math import cos, pi, sin
from typing import Any

import sympy as sm
from sympy.physics.mechanics import (
    Force,
    Point,
    ReferenceFrame,
    RigidBody,
    Torque,
    dynamicsymbols,
    inertia,
)

from engdyn import shapes as sh
from engdyn.modeling.newton import FreeBody
from engdyn.quantities import Coordinate, Input, Parameter
from engdyn.system import System

PARAMETERS = (
    Parameter("m_1", "kg", 1500.0, "car mass"),
    Parameter("J_1", "kg m^2", 2500.0, "car yaw inertia"),
    Parameter("a", "m", 1.2, "mass center to front axle"),
    Parameter("b", "m", 1.4, "mass center to rear axle"),
    Parameter("h", "m", 2.3, "mass center to hitch"),
    Parameter("m_2", "kg", 1000.0, "trailer mass"),
    Parameter("J_2", "kg m^2", 1800.0, "trailer yaw inertia"),
    Parameter("e", "m", 2.9, "hitch to mass center of the trailer"),
    Parameter("d", "m", 3.0, "hitch to trailer axle"),
    Parameter("C_1", "N/rad", 80000.0, "front cornering stiffness", "nonnegative"),
    Parameter("C_2", "N/rad", 90000.0, "rear cornering stiffness", "nonnegative"),
    Parameter("C_3", "N/rad", 60000.0, "trailer cornering stiffness", "nonnegative"),
    Parameter("c_h", "N m s/rad", 200.0, "hitch damper", "nonnegative"),
    Parameter("v", "m/s", 22.0, "forward speed", "any"),
)
m_1, J_1, a, b, h, m_2, J_2, e, d, C_1, C_2, C_3, c_h, v = (p.symbol for p in PARAMETERS)

y, psi, theta, delta, F_w = dynamicsymbols("y psi theta delta F_w")
y_d, psi_d, theta_d = dynamicsymbols("y psi theta", 1)
H_x, H_y, X_c = sm.symbols("H_x H_y X_c")

ground = ReferenceFrame("N")  # seen from above, X forward, Y to the left
car_axes = ReferenceFrame("C")
car_axes.orient_axis(ground, psi, ground.z)
trailer_axes = ReferenceFrame("T")
trailer_axes.orient_axis(ground, theta, ground.z)


def slip(axle: Point, axes: ReferenceFrame) -> sm.Expr:
    """Angle of an axle's velocity to the left of the straight-ahead direction of its body."""
    velocity = axle.pos_from(road).dt(ground) + v * ground.x
    return sm.atan(velocity.dot(axes.y) / velocity.dot(axes.x))


road = Point("O")  # goes along at the forward speed
road.set_vel(ground, v * ground.x)


def free_bodies() -> list[FreeBody]:
    """Car and trailer, cut at the hitch; every axle is one tire with its side force."""
    center = road.locatenew("G_1", y * ground.y)
    front, rear = center.locatenew("A_1", a * car_axes.x), center.locatenew("A_2", -b * car_axes.x)
    hitch = center.locatenew("H", -h * car_axes.x)
    load = hitch.locatenew("G_2", -e * trailer_axes.x)
    last = hitch.locatenew("A_3", -d * trailer_axes.x)
    hitch_force = H_x * ground.x + H_y * ground.y  # of the car on the trailer
    damper = -c_h * (theta_d - psi_d) * ground.z

    car = FreeBody(
        RigidBody("car", center, car_axes, m_1, (inertia(car_axes, 0, 0, J_1), center)),
        applied=[
            Force(front, -C_1 * (slip(front, car_axes) - delta) * car_axes.y),
            Force(rear, -C_2 * slip(rear, car_axes) * car_axes.y),
            Torque(car_axes, -damper),
        ],
        reactions=[Force(center, X_c * ground.x), Force(hitch, -hitch_force)],
    )
    trailer = FreeBody(
        RigidBody("trailer", load, trailer_axes, m_2, (inertia(trailer_axes, 0, 0, J_2), load)),
        applied=[
            Force(last, -C_3 * slip(last, trailer_axes) * trailer_axes.y),
            Torque(trailer_axes, damper),
            Force(load, F_w * ground.y),
        ],
        reactions=[Force(hitch, hitch_force)],
    )
    return [car, trailer]


def steady(values: Mapping[str, float], inputs: Mapping[str, Any]) -> dict[str, Any]:
    """Running straight along X; what holds the car there is solved for: the steering, or else the gust."""
    free = [name for name in ("delta", "F_w") if name not in inputs]
    if not free and not any(inputs.values()):
        free = ["delta"]
    return {"rates": {"y": 0.0}, "free": free[:1]}


def kinetic_energy() -> sm.Expr:
    """Both bodies in translation, written with the velocity of the mass centers, and in rotation."""
    forward = v + h * sm.sin(psi) * psi_d + e * sm.sin(theta) * theta_d  # of the trailer
    sideways = y_d - h * sm.cos(psi) * psi_d - e * sm.cos(theta) * theta_d
    translation = m_1 * (v**2 + y_d**2) / 2 + m_2 * (forward**2 + sideways**2) / 2
    return translation + J_1 * psi_d**2 / 2 + J_2 * theta_d**2 / 2


def generalized_forces() -> dict[sm.Expr, sm.Expr]:
    """Virtual work of the side forces and of the gust."""
    sine, cosine = sm.sin(psi), sm.cos(psi)
    ahead, across = v * cosine + y_d * sine, y_d * cosine - v * sine  # of the car's mass center
    ahead_3 = v * sm.cos(theta) + y_d * sm.sin(theta) + h * sm.sin(psi - theta) * psi_d
    across_3 = y_d * sm.cos(theta) - v * sm.sin(theta) - h * sm.cos(psi - theta) * psi_d - d * theta_d
    F_1 = -C_1 * (sm.atan((across + a * psi_d) / ahead) - delta)
    F_2 = -C_2 * sm.atan((across - b * psi_d) / ahead)
    F_3 = -C_3 * sm.atan(across_3 / ahead_3)
    return {
        y: (F_1 + F_2) * cosine + F_3 * sm.cos(theta) + F_w,
        psi: a * F_1 - b * F_2 - h * F_3 * sm.cos(psi - theta) - h * F_w * cosine,
        theta: -d * F_3 - e * F_w * sm.cos(theta),
    }


def _on(start: tuple[float, float], angle: float, along: float, across: float = 0.0) -> tuple[float, float]:
    """A point of a body that is turned by an angle, from one of its points."""
    x, y = along * cos(angle) - across * sin(angle), along * sin(angle) + across * cos(angle)
    return (start[0] + x, start[1] + y)


def _body(start: tuple[float, float], angle: float, rear: float, front: float, wide: float) -> sh.Polygon:
    """A body on wheels, from above."""
    corners = ((rear, -wide), (front, -wide), (front, wide), (rear, wide))
    return sh.Polygon(tuple(_on(start, angle, x, y / 2) for x, y in corners))


def _tire(place: tuple[float, float], angle: float, turned: float, size: float, label: str) -> list:
    """The one tire of an axle of a body with the given angle; the wheel may be turned in it."""
    beside = _on(place, angle, 0.0, -0.4 * size)
    box = sh.Box(place, (size, 0.35 * size), angle=angle + turned, role="joint")
    return [box, sh.Label(beside, label, (sin(angle), -cos(angle)))]


def shapes(q: list[float], values: dict[str, float]) -> list:
    """View from above, the mass center of the car over the origin for y = 0; one tire per axle."""
    (y, psi, theta), v = q, values
    width, wheel, steered = 0.62 * (v["a"] + v["b"]), 0.26 * (v["a"] + v["b"]), 0.3
    center, tail, nose = (0.0, y), -v["b"] - 0.3 * width, v["a"] + 0.35 * width
    front, rear, hitch = (_on(center, psi, x) for x in (v["a"], -v["b"], -v["h"]))
    load, axle = _on(hitch, theta, -v["e"]), _on(hitch, theta, -v["d"])
    ahead, behind = -0.45 * min(v["d"], v["e"]), -1.3 * max(v["d"], v["e"])
    line = _on(center, psi, 0.45 * v["a"])[0]
    return [
        sh.CenterLine((hitch[0] + 1.15 * behind, 0.0), (nose + 1.1 * width, 0.0), "$X$", arrow=True),
        _body(hitch, theta, behind, ahead, 0.95 * width),
        _body(center, psi, tail, nose, width),
        sh.Link(_on(center, psi, tail), hitch),
        sh.Link(_on(hitch, theta, ahead), hitch),
        *_tire(front, psi, steered, wheel, "$C_1$"),
        *_tire(rear, psi, 0.0, wheel, "$C_2$"),
        *_tire(axle, theta, 0.0, wheel, "$C_3$"),
        sh.MomentArrow(front, 0.75 * width, psi, psi + steered, r"$\delta$"),
        *(sh.CenterLine(front, _on(front, angle, 0.9 * width)) for angle in (psi, psi + steered)),
        sh.CenterOfMass(center),
        sh.CenterOfMass(load),
        sh.Label(_on(center, psi, -0.35 * v["b"], 0.3 * width), "$m_1,\\ J_1$"),
        sh.Label(_on(load, theta, 0.25 * v["e"], 0.25 * width), "$m_2,\\ J_2$"),
        sh.Dimension(center, front, "$a$", offset=0.72 * width),
        sh.Dimension(rear, center, "$b$", offset=0.72 * width),
        sh.Dimension(hitch, center, "$h$", offset=1.3 * width),
        sh.Dimension(load, hitch, "$e$", offset=-0.72 * width),
        sh.Dimension(axle, hitch, "$d$", offset=-1.22 * width),
        sh.CenterLine(center, (1.25 * nose, y)),
        sh.AngleArrow(center, 1.15 * nose, 0.0, psi, r"$\psi$"),
        *(sh.CenterLine(hitch, _on(hitch, angle, 1.15 * behind)) for angle in (0.0, theta)),
        sh.AngleArrow(hitch, -1.08 * behind, pi, pi + theta, r"$\theta$"),
        sh.TorsionalDamper(hitch, 0.22 * width, psi, theta + pi, "$c_h$"),
        sh.Pin(hitch),
        sh.CoordinateArrow((line, 0.0), (line, y), "$y$", positive=(0.0, 1.0)),
        sh.ForceArrow(load, (load[0], load[1] + 0.9 * width), "$F_w$"),
        sh.VectorArrow((nose + 0.2 * width, -1.5 * width), (nose + 0.9 * width, -1.5 * width), "$v$"),
    ]


def build() -> System:
    """The car with its trailer as a System."""
    return System(
        number=18,
        key="car_trailer",
        title="Car with single-axle trailer at constant speed",
        field="vehicles",
        description=(
            "Seen from above, a car (mass m_1, inertia J_1) keeps the constant speed v along X (forward); y "
            "is the place of its mass center to the left, psi its yaw angle, counter-clockwise. The front "
            "axle is a ahead of the mass center, the rear axle b and the hitch h behind it. The trailer "
            "(m_2, J_2) has the absolute yaw angle theta; its mass center is e and its axle d behind the "
            "hitch. Every axle is one tire: its side force is -C times the slip, the angle between the "
            "axle's velocity and the direction of its body. Steering by the small angle delta reduces the "
            "slip of the front axle. The damper c_h acts in the hitch. A longitudinal force X_c on the car "
            "keeps v constant; a side gust F_w acts at the trailer's mass center along Y."
        ),
        measured="yaw-rate gyros on car and trailer after a steering pulse at several speeds: damping",
        coordinates=(
            Coordinate(y, "m", "mass center of the car, to the left", None, "ignorable"),
            Coordinate(psi, "rad", "yaw angle of the car, counter-clockwise", (-1.0, 1.0), "angle"),
            Coordinate(theta, "rad", "yaw angle of the trailer, counter-clockwise", (-1.0, 1.0), "angle"),
        ),
        parameters=PARAMETERS,
        inputs=(
            Input(delta, "rad", "steering angle, to the left"),
            Input(F_w, "N", "side gust on the trailer, to the left"),
        ),
        kinetic_energy=kinetic_energy(),
        potential_energy=sm.S.Zero,
        dissipation=c_h * (theta_d - psi_d) ** 2 / 2,
        generalized_forces=generalized_forces(),
        frame=ground,
        free_bodies=free_bodies,
        unknowns=(H_x, H_y, X_c),
        steady=steady,
        shapes=shapes,
        pose=(0.6, 0.18, 0.3),
    )
