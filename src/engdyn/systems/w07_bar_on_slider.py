"""W7 Uniform bar hinged to a slider on an inclined guide: the worked example of chapters 3 to 6."""

from __future__ import annotations

from math import cos, pi, sin

import sympy as sm
from sympy.physics.mechanics import (
    Force,
    Particle,
    Point,
    ReferenceFrame,
    RigidBody,
    Torque,
    dynamicsymbols,
    inertia,
)

from engdyn import shapes as sh
from engdyn.modeling.newton import FreeBody
from engdyn.quantities import Coordinate, Parameter
from engdyn.system import System

PARAMETERS = (
    Parameter("m", "kg", 3.0, "bar mass"),
    Parameter("m_s", "kg", 1.0, "slider mass"),
    Parameter("l", "m", 0.6, "bar length"),
    Parameter("gamma", "rad", pi / 6, "inclination of the guide", "any", (-pi / 3, pi / 3)),
    Parameter("k", "N/m", 400.0, "slider spring", "nonnegative"),
    Parameter("c", "N s/m", 4.0, "slider damping", "nonnegative"),
    Parameter("c_h", "N m s/rad", 0.15, "hinge damping", "nonnegative"),
    Parameter("g", "m/s^2", 9.81, "gravity", "any"),
)
m, m_s, l, gamma, k, c, c_h, g = (p.symbol for p in PARAMETERS)

s, theta = dynamicsymbols("s theta")
s_d, theta_d = dynamicsymbols("s theta", 1)
H_x, H_y, N_g = sm.symbols("H_x H_y N_g")

ground = ReferenceFrame("N")  # X right, Y up
guide = ReferenceFrame("E")  # X up the guide
guide.orient_axis(ground, gamma, ground.z)
bar_axes = ReferenceFrame("B")  # -Y along the bar, away from the hinge
bar_axes.orient_axis(ground, theta, ground.z)


def free_bodies() -> list[FreeBody]:
    """Slider and bar, cut at the hinge and at the guide."""
    origin = Point("O")
    origin.set_vel(ground, 0)
    hinge = origin.locatenew("A", s * guide.x)
    center = hinge.locatenew("G", -l / 2 * bar_axes.y)
    hinge_force = H_x * ground.x + H_y * ground.y  # of the slider on the bar
    slider = FreeBody(
        Particle("slider", hinge, m_s),
        applied=[Force(hinge, -(k * s + c * s_d) * guide.x), Force(hinge, -m_s * g * ground.y)],
        reactions=[Force(hinge, -hinge_force), Force(hinge, N_g * guide.y)],
    )
    bar = FreeBody(
        RigidBody("bar", center, bar_axes, m, (inertia(bar_axes, 0, 0, m * l**2 / 12), center)),
        applied=[Force(center, -m * g * ground.y), Torque(bar_axes, -c_h * theta_d * ground.z)],
        reactions=[Force(hinge, hinge_force)],
    )
    return [slider, bar]


def shapes(q: list[float], values: dict[str, float]) -> list:
    """Side view; the guide passes through the origin, where the spring is relaxed."""
    position, angle, length, incline = q[0], q[1], values["l"], values["gamma"]
    along, across = (cos(incline), sin(incline)), (-sin(incline), cos(incline))

    def on_guide(x: float, y: float) -> tuple[float, float]:
        return (x * along[0] + y * across[0], x * along[1] + y * across[1])

    hinge = on_guide(position, 0.0)
    end = (hinge[0] + length * sin(angle), hinge[1] - length * cos(angle))
    low, high, rail = -0.85 * length, 0.62 * length, -0.09 * length
    block = 0.13 * length
    return [
        sh.Ground(on_guide(low, rail), on_guide(high, rail)),
        sh.Ground(on_guide(low, 0.22 * length), on_guide(low, rail)),
        sh.Spring(
            on_guide(low, 0.05 * length),
            on_guide(position - block, 0.05 * length),
            "$k$",
            width=0.08 * length,
        ),
        sh.Damper(
            on_guide(low, -0.04 * length), on_guide(position - block, -0.04 * length), width=0.06 * length
        ),
        sh.Box(hinge, (2 * block, 0.18 * length), angle=incline),
        sh.Label(on_guide(position + 0.16 * length, 0.12 * length), "$m_s$", (1.0, 0.5)),
        sh.CenterLine(hinge, (hinge[0], hinge[1] - 0.7 * length)),
        sh.Box(
            ((hinge[0] + end[0]) / 2, (hinge[1] + end[1]) / 2), (0.06 * length, length), angle=angle, label=""
        ),
        sh.CenterOfMass(((hinge[0] + end[0]) / 2, (hinge[1] + end[1]) / 2)),
        sh.Label(end, "$m,\\ l$", (0.6, -1.0)),
        sh.Pin(hinge),
        sh.AngleArrow(hinge, 0.42 * length, -pi / 2, angle - pi / 2, r"$\theta$"),
        sh.CoordinateArrow(
            on_guide(0.0, 0.3 * length), on_guide(position, 0.3 * length), "$s$", positive=along
        ),
        sh.GravityArrow((0.75 * length, 0.1 * length), (0.75 * length, -0.2 * length), "$g$"),
    ]


def build() -> System:
    """The bar on the slider as a System."""
    v_x = sm.cos(gamma) * s_d + l / 2 * sm.cos(theta) * theta_d
    v_y = sm.sin(gamma) * s_d + l / 2 * sm.sin(theta) * theta_d
    return System(
        key="bar_on_slider",
        title="Bar hinged to a slider on an inclined guide",
        field="worked example",
        description=(
            "A slider (mass m_s) moves on a guide that rises to the right at the angle gamma; s is its "
            "travel up the guide, a spring k relaxed at s = 0 and a damper c hold it. A uniform bar (mass "
            "m, length l) hangs from a hinge on the slider; theta is its angle from the downward vertical, "
            "counter-clockwise. c_h damps the hinge."
        ),
        coordinates=(
            Coordinate(s, "m", "travel of the slider up the guide", (-0.5, 0.5), "length"),
            Coordinate(
                theta, "rad", "bar angle from the downward vertical, counter-clockwise", (-pi, pi), "angle"
            ),
        ),
        parameters=PARAMETERS,
        kinetic_energy=m_s * s_d**2 / 2 + m * (v_x**2 + v_y**2) / 2 + m * l**2 / 24 * theta_d**2,
        potential_energy=k * s**2 / 2 + (m_s + m) * g * s * sm.sin(gamma) - m * g * l / 2 * sm.cos(theta),
        dissipation=c * s_d**2 / 2 + c_h * theta_d**2 / 2,
        frame=ground,
        free_bodies=free_bodies,
        unknowns=(H_x, H_y, N_g),
        shapes=shapes,
    )
