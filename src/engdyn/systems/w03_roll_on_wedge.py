"""W3 Paper roll on a wedge-shaped cart: two bodies, one contact.  The worked example of section 2.13."""

from __future__ import annotations

from math import cos, pi, sin, tan

import sympy as sm
from sympy.physics.mechanics import Force, Particle, Point, ReferenceFrame, RigidBody, dynamicsymbols, inertia

from engdyn import shapes as sh
from engdyn.modeling.newton import FreeBody
from engdyn.quantities import Coordinate, Input, Parameter
from engdyn.system import System

PARAMETERS = (
    Parameter("m", "kg", 300.0, "mass of the roll"),
    Parameter("R", "m", 0.4, "radius of the roll"),
    Parameter("M", "kg", 500.0, "mass of the cart"),
    Parameter("beta", "rad", pi / 9, "slope of the wedge", "any", (0.0, pi / 3)),
    Parameter("g", "m/s^2", 9.81, "gravity", "any"),
)
m, R, M, beta, g = (p.symbol for p in PARAMETERS)

x, s, F = dynamicsymbols("x s F")
x_d, s_d = dynamicsymbols("x s", 1)
N, S, N_w = sm.symbols("N S N_w")

ground = ReferenceFrame("N")  # X right, Y up
slope = ReferenceFrame("E")  # X down the slope, Y off the slope
slope.orient_axis(ground, -beta, ground.z)
roll_axes = ReferenceFrame("B")
roll_axes.orient_axis(ground, -s / R, ground.z)  # down the slope to the right: clockwise


def free_bodies() -> list[FreeBody]:
    """Cart and roll, cut at the contact: N presses them apart, S holds the roll back."""
    origin = Point("O")
    origin.set_vel(ground, 0)
    cart = origin.locatenew("W", x * ground.x)
    center = cart.locatenew("G", s * slope.x + R * slope.y)
    contact = center.locatenew("P", -R * slope.y)
    on_roll = N * slope.y - S * slope.x
    return [
        FreeBody(
            Particle("cart", cart, M),
            applied=[Force(cart, -M * g * ground.y), Force(cart, F * ground.x)],
            reactions=[Force(cart, N_w * ground.y), Force(contact, -on_roll)],
        ),
        FreeBody(
            RigidBody("roll", center, roll_axes, m, (inertia(roll_axes, 0, 0, m * R**2 / 2), center)),
            applied=[Force(center, -m * g * ground.y)],
            reactions=[Force(contact, on_roll)],
        ),
    ]


def shapes(q: list[float], values: dict[str, float]) -> list:
    """Side view; the wedge is as long as the roll can use, x is counted from the mark on the floor."""
    x, s, radius, incline = q[0], q[1], values["R"], values["beta"]
    along, off = (cos(incline), -sin(incline)), (sin(incline), cos(incline))
    base, deck, wheel = 4.6 * radius, 0.75 * radius, 0.22 * radius
    left, right = x, x + base
    top = deck + max(base * tan(incline), 0.0)
    toe = top - base * tan(incline)

    def on_slope(distance: float, height: float) -> tuple[float, float]:
        start = (x + 1.2 * radius, top - 1.2 * radius * tan(incline))
        return (
            start[0] + distance * along[0] + height * off[0],
            start[1] + distance * along[1] + height * off[1],
        )

    center = on_slope(s, radius)
    return [
        sh.Ground((min(0.0, left) - 0.7 * radius, 0.0), (max(0.0, left) + base + 0.7 * radius, 0.0)),
        *(sh.Disc((left + part * base, wheel), wheel) for part in (0.18, 0.82)),
        sh.Polygon(
            ((left, 2 * wheel), (right, 2 * wheel), (right, toe), (left, top)),
        ),
        sh.Label((left + 0.3 * base, 2 * wheel + 0.25 * (top - 2 * wheel)), "$M$"),
        sh.CenterLine((right - 0.45 * base, toe), (right, toe), role="parameter"),
        sh.AngleArrow((right, toe), 0.36 * base, pi, pi - incline, r"$\beta$", role="parameter"),
        sh.Disc(center, radius, angle=pi / 2 - s / radius),
        sh.CenterOfMass(center),
        sh.Label(on_slope(s + 0.35 * radius, 1.45 * radius), "$m,\\ R$", (0.0, 0.0)),
        sh.CoordinateArrow(on_slope(0.0, 2.25 * radius), on_slope(s, 2.25 * radius), "$s$", positive=along),
        sh.CoordinateArrow((0.0, -0.45 * radius), (left, -0.45 * radius), "$x$"),
        sh.ForceArrow((left - 0.9 * radius, 0.5 * top), (left, 0.5 * top), "$F$"),
        sh.GravityArrow(
            (left - 0.6 * radius, top + 1.2 * radius), (left - 0.6 * radius, top + 0.4 * radius), "$g$"
        ),
    ]


def build() -> System:
    """The roll on the wedge as a System."""
    v_x, v_y = x_d + s_d * sm.cos(beta), -s_d * sm.sin(beta)
    return System(
        key="roll_on_wedge",
        title="Paper roll on a wedge-shaped cart",
        field="worked example",
        description=(
            "A cart (mass M) with a plane that falls to the right at the angle beta rolls on a level floor; its "
            "light wheels run freely. A paper roll (uniform cylinder, mass m, radius R) rolls without slip down the "
            "plane. x is the travel of the cart to the right, s that of the roll's axis down the plane, relative to "
            "the cart. A force F pushes the cart to the right. N is the normal force between roll and plane, S the "
            "friction, on the roll up the plane."
        ),
        coordinates=(
            Coordinate(x, "m", "travel of the cart to the right", None, "ignorable"),
            Coordinate(s, "m", "travel of the roll down the plane, relative to the cart", None, "ignorable"),
        ),
        parameters=PARAMETERS,
        inputs=(Input(F, "N", "force on the cart, positive to the right"),),
        kinetic_energy=M * x_d**2 / 2 + m * (v_x**2 + v_y**2) / 2 + m * R**2 / 4 * (s_d / R) ** 2,
        potential_energy=-m * g * s * sm.sin(beta),
        generalized_forces={x: F},
        frame=ground,
        free_bodies=free_bodies,
        unknowns=(N, S, N_w),
        shapes=shapes,
    )
