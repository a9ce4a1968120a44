"""S23 Half car: heave and pitch of the body, two wheels on a rough road."""

from __future__ import annotations

import sympy as sm
from sympy.physics.mechanics import Force, Particle, Point, ReferenceFrame, RigidBody, dynamicsymbols, inertia

from engdyn.modeling.newton import FreeBody
from engdyn.system import Coordinate, Input, Parameter, System

PARAMETERS = (
    Parameter("m_s", "kg", 730.0, "body mass"),
    Parameter("J", "kg m^2", 1230.0, "pitch inertia"),
    Parameter("a", "m", 1.1, "mass center to front axle"),
    Parameter("b", "m", 1.5, "mass center to rear axle"),
    Parameter("m_f", "kg", 40.0, "front wheel"),
    Parameter("m_r", "kg", 36.0, "rear wheel"),
    Parameter("k_f", "N/m", 20000.0, "front spring", "nonnegative"),
    Parameter("k_r", "N/m", 17500.0, "rear spring", "nonnegative"),
    Parameter("c_f", "N s/m", 1300.0, "front damper", "nonnegative"),
    Parameter("c_r", "N s/m", 1600.0, "rear damper", "nonnegative"),
    Parameter("k_tf", "N/m", 175000.0, "front tire", "nonnegative"),
    Parameter("k_tr", "N/m", 175000.0, "rear tire", "nonnegative"),
    Parameter("g", "m/s^2", 9.81, "gravity", "any"),
)
m_s, J, a, b, m_f, m_r, k_f, k_r, c_f, c_r, k_tf, k_tr, g = (p.symbol for p in PARAMETERS)

z, theta, zf, zr = dynamicsymbols("z theta zf zr")
z_d, theta_d, zf_d, zr_d = dynamicsymbols("z theta zf zr", 1)
yf, yr, F_z = dynamicsymbols("yf yr F_z")

ground = ReferenceFrame("N")  # X forward, Y up; it travels with the car at constant speed
body_axes = ReferenceFrame("B")
body_axes.orient_axis(ground, theta, ground.z)

# stretch of the suspensions and of the tires, and the rates of the suspensions
stretch_f, stretch_r = z + a * sm.sin(theta) - zf, z - b * sm.sin(theta) - zr
rate_f, rate_r = z_d + a * sm.cos(theta) * theta_d - zf_d, z_d - b * sm.cos(theta) * theta_d - zr_d


def free_bodies() -> list[FreeBody]:
    """Body and two wheels; the suspension forces act in pairs."""
    origin = Point("O")
    origin.set_vel(ground, 0)
    center = origin.locatenew("G", z * ground.y)
    front, rear = center.locatenew("P_f", a * body_axes.x), center.locatenew("P_r", -b * body_axes.x)
    axle_f, axle_r = origin.locatenew("W_f", zf * ground.y), origin.locatenew("W_r", zr * ground.y)
    pull_f = -(k_f * stretch_f + c_f * rate_f) * ground.y  # of the front suspension on the body
    pull_r = -(k_r * stretch_r + c_r * rate_r) * ground.y

    body = FreeBody(
        RigidBody("body", center, body_axes, m_s, (inertia(body_axes, 0, 0, J), center)),
        applied=[
            Force(front, pull_f),
            Force(rear, pull_r),
            Force(center, -m_s * g * ground.y),
            Force(center, F_z * ground.y),
        ],
    )
    wheel_f = FreeBody(
        Particle("front wheel", axle_f, m_f),
        applied=[
            Force(axle_f, -pull_f),
            Force(axle_f, -k_tf * (zf - yf) * ground.y),
            Force(axle_f, -m_f * g * ground.y),
        ],
    )
    wheel_r = FreeBody(
        Particle("rear wheel", axle_r, m_r),
        applied=[
            Force(axle_r, -pull_r),
            Force(axle_r, -k_tr * (zr - yr) * ground.y),
            Force(axle_r, -m_r * g * ground.y),
        ],
    )
    return [body, wheel_f, wheel_r]


def build() -> System:
    """The half car as a System."""
    springs = k_f * stretch_f**2 / 2 + k_r * stretch_r**2 / 2
    tires = k_tf * (zf - yf) ** 2 / 2 + k_tr * (zr - yr) ** 2 / 2
    weights = (m_s * z + m_f * zf + m_r * zr) * g
    return System(
        number=23,
        key="half_car",
        title="Half-car (pitch-plane) model on a rough road",
        field="vehicles",
        description=(
            "Side view of a car that drives to the right at constant speed. The body (mass m_s, pitch inertia J) heaves by z, "
            "positive up, and pitches by theta, counter-clockwise, nose up. The front suspension (k_f, c_f) acts "
            "vertically between the body point a ahead of the mass center G and the front wheel (mass m_f, height zf), the "
            "rear one (k_r, c_r) between the point b behind G and the rear wheel (m_r, zr). Tires k_tf, k_tr stand on the road "
            "heights yf, yr. Springs are relaxed at zero coordinates; F_z is an aerodynamic lift at G. Gravity acts down."
        ),
        measured="body and wheel accelerometers on a road of given roughness: ride comfort, wheelbase filtering",
        coordinates=(
            Coordinate(z, "m", "heave of the body, up", (-0.5, 0.5), "length"),
            Coordinate(theta, "rad", "pitch of the body, nose up", (-1.5, 1.5), "angle"),
            Coordinate(zf, "m", "height of the front wheel, up", (-0.5, 0.5), "length"),
            Coordinate(zr, "m", "height of the rear wheel, up", (-0.5, 0.5), "length"),
        ),
        parameters=PARAMETERS,
        inputs=(
            Input(yf, "m", "road height under the front wheel", "prescribed motion"),
            Input(yr, "m", "road height under the rear wheel", "prescribed motion"),
            Input(F_z, "N", "aerodynamic lift at the mass center, up"),
        ),
        kinetic_energy=(m_s * z_d**2 + J * theta_d**2 + m_f * zf_d**2 + m_r * zr_d**2) / 2,
        potential_energy=springs + tires + weights,
        dissipation=c_f * rate_f**2 / 2 + c_r * rate_r**2 / 2,
        generalized_forces={z: F_z},
        frame=ground,
        free_bodies=free_bodies,
    )
