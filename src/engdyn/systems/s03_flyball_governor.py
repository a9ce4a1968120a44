"""S03 Flyball governor: two balls on a turning spindle lift a collar against a spring."""

from __future__ import annotations

from math import cos, pi, sin

import sympy as sm
from sympy.physics.mechanics import Force, Particle, Point, ReferenceFrame, dynamicsymbols

from engdyn import shapes as sh
from engdyn.modeling.newton import FreeBody
from engdyn.quantities import Coordinate, Input, Parameter
from engdyn.system import System

PARAMETERS = (
    Parameter("m", "kg", 1.2, "mass of one ball"),
    Parameter("M_c", "kg", 3.0, "collar mass"),
    Parameter("l", "m", 0.25, "arm and link length"),
    Parameter("k", "N/m", 200.0, "collar spring", "nonnegative"),
    Parameter("Omega", "rad/s", 18.0, "spindle speed", "any"),
    Parameter("c_p", "N m s/rad", 0.15, "pin damping", "nonnegative"),
    Parameter("c_c", "N s/m", 10.0, "collar damping", "nonnegative"),
    Parameter("g", "m/s^2", 9.81, "gravity", "any"),
)
m, M_c, l, k, Omega, c_p, c_c, g = (p.symbol for p in PARAMETERS)

theta, F, drive = dynamicsymbols("theta F drive")
theta_d, drive_d = dynamicsymbols("theta drive", 1)
T_1, T_2, N_a = sm.symbols("T_1 T_2 N_a")

ground = ReferenceFrame("N")  # Z up along the spindle
arms = ReferenceFrame("A")  # turns with the spindle; the arms move in its X-Z plane
arms.orient_axis(ground, drive, ground.z)


def free_bodies() -> list[FreeBody]:
    """One ball (the other is its mirror image) and the collar."""
    pivot = Point("P")
    pivot.set_vel(ground, 0)
    along_arm = sm.sin(theta) * arms.x - sm.cos(theta) * arms.z  # from P to the ball
    outward = sm.cos(theta) * arms.x + sm.sin(theta) * arms.z  # in which theta grows
    link = -sm.sin(theta) * arms.x - sm.cos(theta) * arms.z  # from the ball to the collar
    mirrored = sm.sin(theta) * arms.x - sm.cos(theta) * arms.z  # the same for the other ball
    center = pivot.locatenew("B", l * along_arm)
    sleeve = pivot.locatenew("C", -2 * l * sm.cos(theta) * ground.z)
    lift = 2 * l * (1 - sm.cos(theta))  # of the collar above its lowest place
    lift_d = 2 * l * sm.sin(theta) * theta_d

    ball = FreeBody(
        Particle("ball", center, m),
        applied=[
            Force(center, -m * g * ground.z),
            Force(center, -c_p * theta_d / (2 * l) * outward),  # half of the pin couple, over the arm
        ],
        reactions=[Force(center, -T_1 * along_arm), Force(center, T_2 * link), Force(center, N_a * arms.y)],
    )
    collar = FreeBody(
        Particle("collar", sleeve, M_c),
        applied=[
            Force(sleeve, -M_c * g * ground.z),
            Force(sleeve, -k * lift * ground.z),
            Force(sleeve, -c_c * lift_d * ground.z),
            Force(sleeve, F * ground.z),
        ],
        reactions=[Force(sleeve, -T_2 * link), Force(sleeve, -T_2 * mirrored)],
    )
    return [ball, collar]


def shapes(q: list[float], values: dict[str, float]) -> list:
    """Side view with P at the origin; radii of balls and collar are fractions of the arm length."""
    theta, l = q[0], values["l"]
    right, left = (l * sin(theta), -l * cos(theta)), (-l * sin(theta), -l * cos(theta))
    collar = (0.0, -2.0 * l * cos(theta))
    top, foot = 0.45 * l, -2.75 * l
    under, flange = collar[1] - 0.09 * l, foot + 0.22 * l
    outward = 1.0 if theta >= 0.0 else -1.0
    return [
        sh.Ground((-0.3 * l, foot), (0.3 * l, foot)),
        sh.Link((0.0, foot), (0.0, top)),
        sh.MomentArrow(
            (0.0, 0.32 * l), 0.16 * l, 0.75 * pi, 2.25 * pi, r"$\Omega$", y_axis=(0.0, 0.4), role="reference"
        ),
        sh.Spring((0.0, 0.0), collar, coils=9, width=0.13 * l),
        sh.Label((-0.06 * l, 0.35 * collar[1]), "$k$", (-1.0, 0.0)),
        sh.Link((-0.13 * l, flange), (0.0, flange), role="damper"),
        sh.Damper((-0.13 * l, flange), (-0.13 * l, under), "$c_c$", width=0.1 * l),
        sh.Link((0.0, 0.0), right),
        sh.Link((0.0, 0.0), left),
        sh.Link(right, collar),
        sh.Link(left, collar),
        sh.Box(collar, (0.46 * l, 0.18 * l), label="$M_c$"),
        sh.Disc(right, 0.11 * l, label="$m$"),
        sh.Disc(left, 0.11 * l, label="$m$"),
        sh.TorsionalDamper((0.0, 0.0), 0.3 * l, -pi / 2, -pi / 2 - theta, "$c_p$"),
        sh.Pin((0.0, 0.0), "$P$"),
        sh.AngleArrow((0.0, 0.0), 0.42 * l, -pi / 2, theta - pi / 2, r"$\theta$"),
        sh.Dimension((0.0, 0.0), right, "$l$", offset=0.34 * l * outward),
        sh.Dimension(right, collar, "$l$", offset=0.34 * l * outward),
        sh.ForceArrow((0.17 * l, under - 0.36 * l), (0.17 * l, under), "$F$"),
        sh.GravityArrow((-1.15 * l, 0.3 * l), (-1.15 * l, -0.05 * l), "$g$"),
    ]


def build() -> System:
    """The flyball governor as a System."""
    lift = 2 * l * (1 - sm.cos(theta))
    lift_d = 2 * l * sm.sin(theta) * theta_d
    ball_speed_squared = l**2 * (theta_d**2 + drive_d**2 * sm.sin(theta) ** 2)
    return System(
        number=3,
        key="flyball_governor",
        title="Spring-loaded flyball governor at constant speed",
        field="machines, history of control",
        description=(
            "A vertical spindle turns at the rate Omega. Two arms of length l, pinned to the spindle axis "
            "at the fixed point P, carry one ball (mass m) each; two links of the same length join the "
            "balls to a collar (mass M_c) that slides on the spindle below P. theta is the angle of the "
            "arms from the downward vertical, positive outward; negative angles, the arms crossed, keep "
            "the symmetry visible. A spring k between P and the collar is relaxed at theta = 0; c_p lumps "
            "the damping of the pins, c_c acts between collar and spindle. F pushes the collar up."
        ),
        measured="collar position during a run-up: deflection over speed, the branch of a pitchfork",
        coordinates=(
            Coordinate(
                theta, "rad", "arm angle from the downward vertical, outward", (-pi / 2, pi / 2), "angle"
            ),
        ),
        parameters=PARAMETERS,
        inputs=(
            Input(F, "N", "force on the collar, positive up"),
            Input(
                drive, "rad", "spindle angle", "drive angle", (Omega * dynamicsymbols._t, Omega, sm.S.Zero)
            ),
        ),
        kinetic_energy=m * ball_speed_squared + M_c * lift_d**2 / 2,
        potential_energy=-2 * (m + M_c) * g * l * sm.cos(theta) + k * lift**2 / 2,
        dissipation=c_p * theta_d**2 / 2 + c_c * lift_d**2 / 2,
        generalized_forces={theta: 2 * F * l * sm.sin(theta)},
        frame=ground,
        free_bodies=free_bodies,
        unknowns=(T_1, T_2, N_a),
        shapes=shapes,
    )
