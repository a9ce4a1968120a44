"""S23 Half car: heave and pitch of the body, two wheels on a rough road."""

from __future__ import annotations

from math import cos, sin

import sympy as sm
from sympy.physics.mechanics import Force, Particle, Point, ReferenceFrame, RigidBody, dynamicsymbols, inertia

from engdyn import shapes as sh
from engdyn.modeling.newton import FreeBody
from engdyn.quantities import Coordinate, Input, Parameter
from engdyn.system import System

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


UP = (0.0, 1.0)


def shapes(q: list[float], values: dict[str, float]) -> list:
    """Side view, X counts from G; wheel radius and relaxed ride height are fractions of the wheelbase."""
    z, theta, zf, zr = q
    a, b = values["a"], values["b"]
    base = a + b
    level = 0.48 * base

    def body(along, up):
        return (along * cos(theta) - up * sin(theta), level + z + along * sin(theta) + up * cos(theta))

    front, rear, G, roof = body(a, 0.0), body(-b, 0.0), body(0.0, 0.0), body(0.0, 0.27 * base)
    nose, tail, low = a + 0.2 * base, -b - 0.2 * base, -0.15 * base
    outline = [(nose, -0.03 * base), (nose, 0.08 * base), (a, 0.13 * base), (a - 0.16 * base, 0.26 * base)]
    outline += [(tail + 0.22 * base, 0.28 * base), (tail, 0.15 * base), (tail, -0.03 * base)]
    return [
        sh.Polygon([body(*point) for point in outline]),
        *_corner(front, zf, "f", base, 1.0),
        *_corner(rear, zr, "r", base, -1.0),
        sh.Link(rear, front),
        sh.CenterLine((-0.22 * base, level), (0.02 * base, level), role="coordinate"),
        sh.CenterLine(G, (G[0] + 0.36 * base, G[1]), role="coordinate"),
        sh.CenterOfMass(G, "$G$"),
        sh.Label(body(-0.12 * base, 0.17 * base), "$m_s,\\ J$"),
        sh.CoordinateArrow((-0.17 * base, level), (-0.17 * base, G[1]), "$z$", positive=UP),
        sh.AngleArrow(G, 0.3 * base, 0.0, theta, r"$\theta$"),
        sh.ForceArrow(roof, (roof[0], roof[1] + 0.17 * base), "$F_z$"),
        sh.Dimension((G[0], low), (front[0], low), "$a$"),
        sh.Dimension((rear[0], low), (G[0], low), "$b$"),
        sh.CenterLine(
            (a + 0.06 * base, level + 0.3 * base), (a + 0.24 * base, level + 0.3 * base), "$v_x$", arrow=True
        ),
        sh.GravityArrow((tail, level + 0.42 * base), (tail, level + 0.26 * base), "$g$"),
    ]


def _corner(attachment, rise, end, base, outward):
    """Suspension, wheel, tire and road of one axle; ``outward`` is +1 at the front, -1 at the rear."""
    radius, gap = 0.115 * base, 0.045 * base
    x, top, hub = *attachment, radius + rise
    bottom, beside = hub + 1.1 * radius, x + 0.18 * outward * base
    inner, outer = x - outward * gap, x + outward * gap
    return [
        sh.Ground((x - 0.16 * base, 0.0), (x + 0.16 * base, 0.0)),
        sh.Wheel((x, hub), radius, flat=0.0),
        sh.Label((x - 0.8 * outward * radius, 0.55 * hub), f"$k_{{t{end}}}$", (-outward, 0.0)),
        sh.Link((x, hub), (x, bottom)),
        sh.Link((inner, bottom), (outer, bottom)),
        sh.Spring((inner, bottom), (inner, top), coils=4, width=0.05 * base),
        sh.Label((x - outward * 0.07 * base, (bottom + top) / 2), f"$k_{end}$", (-outward, 0.0)),
        sh.Damper((outer, bottom), (outer, top), width=0.042 * base),
        sh.Label((x + outward * 0.066 * base, (bottom + top) / 2), f"$c_{end}$", (outward, 0.0)),
        sh.Pin(attachment),
        sh.Label((x, hub), f"$m_{end}$"),
        sh.CoordinateArrow((beside, radius), (beside, hub), f"$z_{end}$", positive=UP),
        sh.ForceArrow(
            (x + 0.1 * outward * base, -0.13 * base), (x + 0.1 * outward * base, 0.0), f"$y_{end}$"
        ),
    ]


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
            "Side view of a car that drives to the right at constant speed. The body (mass m_s, pitch "
            "inertia J) heaves by z, positive up, and pitches by theta, counter-clockwise, nose up. The "
            "front suspension (k_f, c_f) acts vertically between the body point a ahead of the mass center "
            "G and the front wheel (mass m_f, height zf), the rear one (k_r, c_r) between the point b "
            "behind G and the rear wheel (m_r, zr). Tires k_tf, k_tr stand on the road heights yf, yr. "
            "Springs are relaxed at zero coordinates; F_z is an aerodynamic lift at G. Gravity acts down."
        ),
        measured="body and wheel accelerometers on a rough road: ride comfort, wheelbase filtering",
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
        shapes=shapes,
        pose=(0.06, 0.09, 0.0, 0.0),
    )
