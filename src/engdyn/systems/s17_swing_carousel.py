"""S17 Chain carousel: a seat that swings in two directions under a turning arm."""

from __future__ import annotations

from math import cos, pi, sin

import numpy as np
import sympy as sm
from sympy.physics.mechanics import Force, Particle, Point, ReferenceFrame, dynamicsymbols

from engdyn import shapes as sh
from engdyn.modeling.newton import FreeBody
from engdyn.quantities import Coordinate, Input, Parameter
from engdyn.system import System

PARAMETERS = (
    Parameter("m", "kg", 90.0, "seat and rider"),
    Parameter("R", "m", 5.0, "arm radius"),
    Parameter("L", "m", 4.0, "suspension length"),
    Parameter("Omega", "rad/s", 1.1, "rate of rotation", "any"),
    Parameter("c", "N s/m", 12.0, "damping", "nonnegative"),
    Parameter("g", "m/s^2", 9.81, "gravity", "any"),
)
m, R, L, Omega, c, g = (p.symbol for p in PARAMETERS)

alpha, beta, F_t, drive = dynamicsymbols("alpha beta F_t drive")
alpha_d, beta_d, drive_d = dynamicsymbols("alpha beta drive", 1)
S_t = sm.Symbol("S_t")

ground = ReferenceFrame("N")  # Z up
arm = ReferenceFrame("A")  # X outward along the arm, Y in the direction of travel
arm.orient_axis(ground, drive, ground.z)


def free_bodies() -> list[FreeBody]:
    """The seat: rod, weight, gust, and drag of the air that goes along with the ride."""
    axis = Point("O")
    axis.set_vel(ground, 0)
    along_rod = (
        sm.sin(alpha) * arm.x + sm.cos(alpha) * sm.sin(beta) * arm.y - sm.cos(alpha) * sm.cos(beta) * arm.z
    )
    place = axis.locatenew("P", R * arm.x + L * along_rod)
    seat = FreeBody(
        Particle("seat", place, m),
        applied=[
            Force(place, -m * g * ground.z),
            Force(place, -c * L * along_rod.dt(arm)),
            Force(place, F_t * arm.y),
        ],
        reactions=[Force(place, -S_t * along_rod)],
    )
    return [seat]


def shapes(q: list[float], values: dict[str, float]) -> list:
    """In space, the tip of the arm in the plane of X and Z; the ground where the ride would be built."""
    alpha, beta, R, L = q[0], q[1], values["R"], values["L"]
    ahead, top, foot = 0.45 * max(R, L), 0.35 * L, -1.45 * L
    outward, forward, up = np.eye(3)
    hanging = sin(beta) * forward - cos(beta) * up  # where the rod would be without alpha
    tip = R * outward
    seat = tip + L * (sin(alpha) * outward + cos(alpha) * hanging)
    turn = np.linspace(-0.42 * pi, 0.3 * pi, 40)[:, None]
    path = R * (np.cos(turn) * outward + np.sin(turn) * forward)
    at, mast = tuple, {"x_axis": tuple(outward), "y_axis": tuple(forward)}
    return [
        sh.Ground(at(foot * up - 0.4 * R * outward), at(foot * up + 0.4 * R * outward)),
        sh.Link(at(foot * up), at(top * up)),
        sh.CenterLine(at(top * up), at((top + ahead) * up), "$Z$", arrow=True),
        sh.MomentArrow(
            at((top + 0.45 * ahead) * up),
            0.3 * ahead,
            0.6 * pi,
            2.1 * pi,
            r"$\Omega$",
            **mast,
            role="reference",
        ),
        sh.Curve(tuple(map(at, path)), role="reference"),
        sh.Link(at(0 * up), at(tip)),
        sh.Link(at(top * up), at(tip)),
        sh.Dimension(at(0 * up), at(tip), "$R$", offset=-0.18 * R),
        sh.CenterLine(at(tip), at(tip + 1.1 * ahead * outward), "$x'$", arrow=True),
        sh.CenterLine(at(tip), at(tip + 1.3 * ahead * forward), "$y'$", arrow=True),
        sh.CenterLine(at(tip), at(tip - 1.1 * L * up)),
        sh.CenterLine(at(tip), at(tip + 0.95 * L * hanging)),
        sh.AngleArrow(at(tip), 0.85 * L, 0.0, beta, r"$\beta$", at(-up), at(forward)),
        sh.AngleArrow(at(tip), 0.62 * L, 0.0, alpha, r"$\alpha$", at(hanging), at(outward)),
        sh.Link(at(tip), at(seat)),
        sh.Label(at(tip + 0.72 * (seat - tip)), "$L$", (1.0, 0.4)),
        sh.Pin(at(tip)),
        sh.Particle(at(seat), "$m,\\ c$"),
        sh.ForceArrow(at(seat), at(seat + 0.9 * ahead * forward), "$F_t$"),
        sh.GravityArrow(at(-0.3 * tip - 0.8 * L * up), at(-0.3 * tip - 1.2 * L * up), "$g$"),
    ]


def kinetic_energy() -> sm.Expr:
    """From the components of the velocity along x', y' and Z."""
    outward = L * sm.cos(alpha) * alpha_d - drive_d * L * sm.cos(alpha) * sm.sin(beta)
    forward = L * (sm.cos(alpha) * sm.cos(beta) * beta_d - sm.sin(alpha) * sm.sin(beta) * alpha_d)
    forward += drive_d * (R + L * sm.sin(alpha))
    upward = L * (sm.sin(alpha) * sm.cos(beta) * alpha_d + sm.cos(alpha) * sm.sin(beta) * beta_d)
    return m * (outward**2 + forward**2 + upward**2) / 2


def build() -> System:
    """The carousel as a System."""
    return System(
        number=17,
        key="swing_carousel",
        title="Chain carousel: seat on a rotating arm",
        field="amusement, slewing cranes",
        description=(
            "An arm of radius R turns about the vertical axis Z at the rate Omega; x' points along the arm, "
            "y' in the direction of travel. From its tip hangs a light rod of length L with a seat "
            "(particle, mass m). alpha swings the seat outward, beta forward: it is at L (sin(alpha), "
            "cos(alpha) sin(beta), -cos(alpha) cos(beta)) from the tip in (x', y', Z). The air goes along "
            "with the ride; it damps the motion relative to the arm with c times the relative velocity. A "
            "gust pushes the seat with the force F_t along y'. Gravity acts down. S_t is the tension of the "
            "rod. With a small rate the same model is a slewing crane."
        ),
        measured="three-axis accelerometer and gyro on the seat: decay of the two swing modes after the start",
        coordinates=(
            Coordinate(alpha, "rad", "swing outward", (-pi / 2, pi / 2), "angle"),
            Coordinate(beta, "rad", "swing forward", (-pi, pi), "angle"),
        ),
        parameters=PARAMETERS,
        inputs=(
            Input(F_t, "N", "gust on the seat, in the direction of travel"),
            Input(drive, "rad", "arm angle", "drive angle", (Omega * dynamicsymbols._t, Omega, 0)),
        ),
        kinetic_energy=kinetic_energy(),
        potential_energy=-m * g * L * sm.cos(alpha) * sm.cos(beta),
        dissipation=c * L**2 * (alpha_d**2 + sm.cos(alpha) ** 2 * beta_d**2) / 2,
        generalized_forces={
            alpha: -F_t * L * sm.sin(alpha) * sm.sin(beta),
            beta: F_t * L * sm.cos(alpha) * sm.cos(beta),
        },
        frame=ground,
        free_bodies=free_bodies,
        unknowns=(S_t,),
        shapes=shapes,
        pose=(0.55, 0.5),
    )
