"""S12 Wing section in a wind tunnel: plunge and pitch with quasi-steady lift, flutter and divergence."""

from __future__ import annotations

from math import cos, pi, sin

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
    Parameter("m", "kg", 12.0, "wing mass"),
    Parameter("J_G", "kg m^2", 0.1, "inertia about the mass center"),
    Parameter("d", "m", 0.04, "mass center behind elastic axis", "any"),
    Parameter("e", "m", 0.05, "aerodynamic center ahead of elastic axis", "any"),
    Parameter("a_34", "m", 0.1, "three-quarter-chord point behind elastic axis", "any"),
    Parameter("k_h", "N/m", 5000.0, "plunge stiffness", "nonnegative"),
    Parameter("k_a", "N m/rad", 150.0, "pitch stiffness", "nonnegative"),
    Parameter("k_c", "N m/rad^3", 3000.0, "cubic pitch stiffness", "nonnegative"),
    Parameter("c_h", "N s/m", 10.0, "plunge damping", "nonnegative"),
    Parameter("c_a", "N m s/rad", 0.15, "pitch damping", "nonnegative"),
    Parameter("rho", "kg/m^3", 1.225, "air density"),
    Parameter("A_w", "m^2", 0.3, "wing area"),
    Parameter("C_L", "1/rad", 5.0, "lift slope", "any"),
    Parameter("U", "m/s", 15.0, "air speed", "any"),
)
m, J_G, d, e, a_34, k_h, k_a, k_c, c_h, c_a, rho, A_w, C_L, U = (p.symbol for p in PARAMETERS)

y, alpha, alpha_g, F = dynamicsymbols("y alpha alpha_g F")
y_d, alpha_d = dynamicsymbols("y alpha", 1)
S_x = sm.Symbol("S_x")

ground = ReferenceFrame("N")  # X into the wind, Y up in the picture
section = ReferenceFrame("B")  # X from the elastic axis to the nose
section.orient_axis(ground, alpha, ground.z)

# U*(U*angle - ...) for U**2*(angle - .../U): the same, and defined in still air
lift = rho * A_w * C_L / 2 * U * (U * (alpha + alpha_g) - y_d + a_34 * alpha_d)


def free_bodies() -> list[FreeBody]:
    """The section, cut at the guide and at the springs and dampers of its elastic axis."""
    origin = Point("O")
    origin.set_vel(ground, 0)
    axis = origin.locatenew("E", y * ground.y)
    center = axis.locatenew("G", -d * section.x)
    pressure = axis.locatenew("A", e * section.x)
    wing = FreeBody(
        RigidBody("section", center, section, m, (inertia(section, 0, 0, J_G), center)),
        applied=[
            Force(axis, -k_h * y * ground.y),
            Force(axis, -c_h * y_d * ground.y),
            Torque(section, -(k_a * alpha + k_c * alpha**3) * ground.z),
            Torque(section, -c_a * alpha_d * ground.z),
            Force(pressure, lift * ground.y),
            Force(axis, F * ground.y),
        ],
        reactions=[Force(axis, S_x * ground.x)],
    )
    return [wing]


def shapes(q: list[float], values: dict[str, float]) -> list:
    """View along the span, E at (0, 0) for y = 0; lift acts at a quarter of the chord, a_34 leads to three."""
    y, alpha = q
    d, e, a_34 = values["d"], values["e"], values["a_34"]
    c = 2.0 * max(e + a_34, abs(d), 0.05)  # chord

    def body(along: float, up: float = 0.0) -> tuple[float, float]:
        return (along * cos(alpha) - up * sin(alpha), y + along * sin(alpha) + up * cos(alpha))

    axis, center, pressure = body(0.0), body(-d), body(e)
    outline = _profile(e + 0.25 * c, c)
    return [
        sh.CenterLine((-0.75 * c, 0.0), (0.95 * c, 0.0), "$X$", arrow=True),
        *_support(axis, c),
        sh.Polygon([body(*point) for point in outline]),
        sh.CenterLine(body(-a_34 - 0.3 * c), body(e + 0.55 * c), role="coordinate"),
        sh.CenterLine(axis, (0.62 * c, axis[1]), role="coordinate"),
        sh.AngleArrow(axis, 0.55 * c, 0.0, alpha, r"$\alpha$"),
        sh.TorsionalSpring(axis, 0.08 * c, -pi / 2, alpha),
        sh.Label((-0.01 * c, axis[1] - 0.26 * c), "$k_a,\\ k_c$", (-1.0, 0.0)),
        sh.TorsionalDamper(axis, 0.27 * c, -pi / 2, alpha, "$c_a$"),
        sh.Pin(axis),
        sh.Label(body(0.0, 0.07 * c), "$E$", (0.3, 1.0), "reference"),
        sh.CenterOfMass(center),
        sh.Label(body(-d - 0.02 * c, 0.06 * c), "$G$", (-1.0, 0.6), "reference"),
        sh.Label((-0.66 * c, y - 0.34 * c), "$m,\\ J_G$"),
        sh.Dimension(axis, pressure, "$e$", offset=0.3 * c),
        sh.Dimension(center, axis, "$d$", offset=0.3 * c),
        sh.Dimension(body(-a_34), axis, "$a_{34}$", offset=0.52 * c),
        sh.VectorArrow(
            pressure,
            (pressure[0], pressure[1] + 0.45 * c),
            r"$\mathrm{lift}:\ \rho,\ A_w,\ C_L$",
            role="force",
        ),
        sh.CoordinateArrow((-0.62 * c, 0.0), (-0.62 * c, y), "$y$", positive=(0.0, 1.0)),
        *_wind(e + 1.45 * c, c),
    ]


def _support(axis: tuple[float, float], c: float) -> list:
    """Spring and damper that hold the elastic axis, and the force on it."""
    wall, plate = -1.05 * c, axis[1] - 0.42 * c
    return [
        sh.Ground((-0.4 * c, wall), (0.4 * c, wall)),
        sh.Link(axis, (0.0, plate)),
        sh.Link((-0.16 * c, plate), (0.16 * c, plate)),
        sh.Spring((-0.13 * c, wall), (-0.13 * c, plate), coils=4, width=0.09 * c),
        sh.Label((-0.19 * c, 0.5 * (wall + plate)), "$k_h$", (-1.0, 0.0)),
        sh.Damper((0.13 * c, wall), (0.13 * c, plate), width=0.08 * c),
        sh.Label((0.19 * c, 0.5 * (wall + plate)), "$c_h$", (1.0, 0.0)),
        sh.ForceArrow((0.0, plate - 0.4 * c), (0.0, plate), "$F$"),
    ]


def _wind(x: float, c: float) -> list:
    """The stream that blows toward -X, and a gust from below."""
    end = (x - 0.5 * c, 0.3 * c)
    return [
        sh.VectorArrow((x, 0.3 * c), end, "$U$"),
        sh.CenterLine(end, (x, 0.12 * c), role="input"),
        sh.MomentArrow(end, 0.45 * c, 0.0, -0.35, r"$\alpha_g$"),
    ]


def _profile(nose: float, chord: float) -> list[tuple[float, float]]:
    """Outline of a symmetric section: along the chord, counted from E, and across it."""
    stations = [(i / 20) ** 2 for i in range(21)]
    half = [0.9 * x**0.5 * (1.0 - x) * (0.3 + 0.1 * (1.0 - x)) for x in stations]
    points = [(nose - x * chord, chord * w) for x, w in zip(stations, half, strict=True)]
    return points + [(x, -w) for x, w in reversed(points[1:-1])]


def build() -> System:
    """The wing section as a System."""
    own = m * (y_d**2 - 2 * d * sm.cos(alpha) * y_d * alpha_d + d**2 * alpha_d**2) / 2
    return System(
        number=12,
        key="airfoil_section",
        title="Wind-tunnel wing section: plunge and pitch with quasi-steady lift",
        field="aerospace",
        description=(
            "A rigid wing section (mass m, inertia J_G about its mass center) stands in a wind tunnel with "
            "its span vertical, so that gravity drops out. Seen along the span it flies toward X at the "
            "air speed U. Its elastic axis E can plunge, y positive along Y, held by the spring k_h and "
            "the damper c_h; the section can pitch by alpha about E, counter-clockwise, nose up, against "
            "the spring k_a with the cubic part k_c and the damper c_a. The mass center G lies at the "
            "distance d behind E, the aerodynamic center at e ahead of E. There the quasi-steady lift acts "
            "along Y: rho U^2 A_w C_L/2 times the angle of attack at the three-quarter-chord point, which "
            "lies a_34 behind E: alpha + alpha_g - y'/U + a_34 alpha'/U, with a gust angle alpha_g. A "
            "force F acts on E along Y."
        ),
        measured="two accelerometers while the wind rises: frequencies, damping and the flutter speed ahead",
        coordinates=(
            Coordinate(y, "m", "plunge of the elastic axis, positive along Y", (-0.3, 0.3), "length"),
            Coordinate(alpha, "rad", "pitch, counter-clockwise, nose up", (-1.2, 1.2), "angle"),
        ),
        parameters=PARAMETERS,
        inputs=(
            Input(alpha_g, "rad", "gust angle, added to the angle of attack", "force"),
            Input(F, "N", "force on the elastic axis, positive along Y"),
        ),
        kinetic_energy=own + J_G * alpha_d**2 / 2,
        potential_energy=k_h * y**2 / 2 + k_a * alpha**2 / 2 + k_c * alpha**4 / 4,
        dissipation=c_h * y_d**2 / 2 + c_a * alpha_d**2 / 2,
        generalized_forces={y: lift + F, alpha: lift * e * sm.cos(alpha)},
        frame=ground,
        free_bodies=free_bodies,
        unknowns=(S_x,),
        shapes=shapes,
        pose=(0.06, 0.3),
    )
