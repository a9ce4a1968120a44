"""S01 Crank press: crank, connecting rod and a ram on a return spring, one closed loop."""

from __future__ import annotations

from math import asin, cos, pi, sin
from typing import Any

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
from engdyn.quantities import Coordinate, Input, Parameter
from engdyn.system import System

PARAMETERS = (
    Parameter("r", "m", 0.05, "crank length OA"),
    Parameter("L", "m", 0.18, "rod length AB"),
    Parameter("a_c", "m", 0.01, "bearing to crank mass center, toward A", "any"),
    Parameter("b_r", "m", 0.06, "crank pin A to rod mass center"),
    Parameter("m_c", "kg", 3.0, "crank mass"),
    Parameter("J_O", "kg m^2", 0.012, "crank inertia about O"),
    Parameter("m_r", "kg", 0.8, "rod mass"),
    Parameter("J_r", "kg m^2", 0.003, "rod inertia about its mass center"),
    Parameter("m_s", "kg", 1.5, "ram mass"),
    Parameter("k_s", "N/m", 20000.0, "return spring", "nonnegative"),
    Parameter("x_0", "m", 0.17, "ram position with relaxed spring", "any"),
    Parameter("c_g", "N s/m", 20.0, "guide damping", "nonnegative"),
    Parameter("c_b", "N m s/rad", 0.02, "bearing damping", "nonnegative"),
    Parameter("g", "m/s^2", 9.81, "gravity", "any"),
)
r, L, a_c, b_r, m_c, J_O, m_r, J_r, m_s, k_s, x_0, c_g, c_b, g = (p.symbol for p in PARAMETERS)

theta, M_m, F_p = dynamicsymbols("theta M_m F_p")
theta_d = dynamicsymbols("theta", 1)
O_x, O_y, A_x, A_y, B_x, B_y, N_g = sm.symbols("O_x O_y A_x A_y B_x B_y N_g")

# The loop closes: A is as high above the guide as the rod reaches down, L sin(phi) = r sin(theta).
sin_phi = r * sm.sin(theta) / L
cos_phi = sm.sqrt(1 - sin_phi**2)
phi_d = r * sm.cos(theta) * theta_d / (L * cos_phi)  # the loop equation differentiated
x_B = r * sm.cos(theta) + L * cos_phi
x_B_d = -r * sm.sin(theta) * theta_d - L * sin_phi * phi_d

ground = ReferenceFrame("N")  # X along the guide, Y up
crank_axes = ReferenceFrame("C")  # X from O to A
crank_axes.orient_axis(ground, theta, ground.z)
rod_axes = ReferenceFrame("R")  # X from A to B: turned by -phi
rod_axes.orient_explicit(ground, sm.Matrix([[cos_phi, sin_phi, 0], [-sin_phi, cos_phi, 0], [0, 0, 1]]))
rod_axes.set_ang_vel(ground, -phi_d * ground.z)


def free_bodies() -> list[FreeBody]:
    """Crank, rod and ram, cut at the bearing, at both pins and at the guide."""
    bearing = Point("O")
    bearing.set_vel(ground, 0)
    pin_a = bearing.locatenew("A", r * crank_axes.x)
    pin_b = pin_a.locatenew("B", L * rod_axes.x)
    center_c = bearing.locatenew("G_c", a_c * crank_axes.x)
    center_r = pin_a.locatenew("G_r", b_r * rod_axes.x)
    on_rod_a = A_x * ground.x + A_y * ground.y  # of the crank on the rod
    on_ram_b = B_x * ground.x + B_y * ground.y  # of the rod on the ram

    crank = FreeBody(
        RigidBody("crank", center_c, crank_axes, m_c, (inertia(crank_axes, 0, 0, J_O), bearing)),
        applied=[
            Torque(crank_axes, M_m * ground.z),
            Torque(crank_axes, -c_b * theta_d * ground.z),
            Force(center_c, -m_c * g * ground.y),
        ],
        reactions=[Force(bearing, O_x * ground.x + O_y * ground.y), Force(pin_a, -on_rod_a)],
    )
    rod = FreeBody(
        RigidBody("rod", center_r, rod_axes, m_r, (inertia(rod_axes, 0, 0, J_r), center_r)),
        applied=[Force(center_r, -m_r * g * ground.y)],
        reactions=[Force(pin_a, on_rod_a), Force(pin_b, -on_ram_b)],
    )
    ram = FreeBody(
        Particle("ram", pin_b, m_s),
        applied=[
            Force(pin_b, F_p * ground.x),
            Force(pin_b, -k_s * (x_B - x_0) * ground.x),
            Force(pin_b, -c_g * x_B_d * ground.x),
            Force(pin_b, -m_s * g * ground.y),
        ],
        reactions=[Force(pin_b, on_ram_b), Force(pin_b, N_g * ground.y)],
    )
    return [crank, rod, ram]


def shapes(q: list[float], values: dict[str, float]) -> list:
    """Side view, bearing O at the origin; sizes of crank, rod and ram are fractions of the crank length."""
    theta, r, L = q[0], values["r"], values["L"]
    phi = asin(r * sin(theta) / L)

    def on_crank(along: float, across: float = 0.0) -> tuple[float, float]:
        return (along * cos(theta) - across * sin(theta), along * sin(theta) + across * cos(theta))

    def on_rod(along: float) -> tuple[float, float]:
        return (A[0] + along * cos(phi), A[1] - along * sin(phi))

    O, A = (0.0, 0.0), on_crank(r)
    B, G_c, G_r = on_rod(L), on_crank(values["a_c"]), on_rod(values["b_r"])
    up = r if A[1] >= 0.0 else -r
    # From the foot of the bearing the shorter way to the crank.
    to_crank = (theta + 1.5 * pi) % (2.0 * pi) - pi
    crank = [(-0.3 * r, 0.22 * r), (1.16 * r, 0.15 * r), (1.16 * r, -0.15 * r), (-0.3 * r, -0.22 * r)]
    return [
        *_frame_and_ram(B[0], r, L, values["x_0"]),
        sh.Box(on_rod(L / 2), (L + 0.2 * r, 0.2 * r), angle=-phi),
        sh.Polygon([on_crank(*point) for point in crank]),
        sh.CenterLine(O, (1.5 * r, 0.0), role="coordinate"),
        sh.AngleArrow(O, 1.3 * r, 0.0, theta, r"$\theta$"),
        sh.TorsionalDamper(O, 0.6 * r, -pi / 2, -pi / 2 + to_crank, "$c_b$"),
        sh.MomentArrow(O, 0.6 * r, theta + 0.7 * pi, theta + 1.25 * pi, "$M_m$"),
        sh.CenterOfMass(G_c),
        sh.CenterOfMass(G_r),
        sh.Label(on_rod(values["b_r"] + 0.12 * L), "$m_r,\\ J_r$", (-sin(phi), -cos(phi))),
        sh.Label((0.4 * r, -1.1 * r), "$m_c,\\ J_O$", (1.0, 0.0)),
        sh.Dimension(O, A, "$r$", offset=up),
        sh.Dimension(O, G_c, "$a_c$", offset=0.55 * up),
        sh.Dimension(A, B, "$L$", offset=1.3 * r),
        sh.Dimension(A, G_r, "$b_r$", offset=0.55 * up),
        *(sh.Pin(point) for point in (O, A, B)),
        sh.Label(O, "$O$", (-1.0, 0.2), role="reference"),
        sh.Label(A, "$A$", on_crank(1.0), role="reference"),
        sh.Label(B, "$B$", (0.0, -1.0), role="reference"),
    ]


def _frame_and_ram(x_B: float, r: float, L: float, x_0: float) -> list:
    """Bearing, guide, ram, spring and damper; in front of the ram there is room for the stroke."""
    face, left, wall = x_B + 0.3 * r, L - 1.45 * r, L + 2.8 * r
    rail, foot, low, middle = 0.85 * r, -1.35 * r, -1.7 * r, 0.5 * (face + wall)
    return [
        sh.Polygon([(0.0, 0.0), (-0.42 * r, foot), (0.42 * r, foot)], role="ground"),
        sh.Ground((-0.65 * r, foot), (0.65 * r, foot)),
        sh.Ground((left, -rail), (wall, -rail)),
        sh.Ground((wall, rail), (left, rail)),
        sh.Ground((wall, rail), (wall, -rail)),
        sh.Box((x_B, 0.0), (0.6 * r, 1.55 * r)),
        sh.Label((x_B, 0.48 * r), "$m_s$"),
        sh.Spring((face, 0.34 * r), (wall, 0.34 * r), width=0.22 * r),
        sh.Damper((face, -0.34 * r), (wall, -0.34 * r), width=0.2 * r),
        sh.Label((middle, 0.46 * r), "$k_s$", (0.0, 1.0)),
        sh.Label((middle, -0.45 * r), "$c_g$", (0.0, -1.0)),
        sh.ForceArrow((face, 0.0), (face + 0.8 * r, 0.0), "$F_p$"),
        sh.Dimension((0.0, low), (x_0, low), "$x_0$"),
        sh.CenterLine((x_0, low - 0.2 * r), (x_0, -rail)),
        sh.GravityArrow((wall - 0.4 * r, 1.75 * r), (wall - 0.4 * r, 1.2 * r), "$g$"),
    ]


def _energies() -> dict[str, Any]:
    """Energies, dissipation and generalized forces, from the positions as functions of theta."""
    phi_slope = r * sm.cos(theta) / (L * cos_phi)  # dphi/dtheta
    x_slope = -r * sm.sin(theta) - L * sin_phi * phi_slope  # dx_B/dtheta
    v_x = (-r * sm.sin(theta) - b_r * sin_phi * phi_slope) * theta_d  # of the rod's mass center
    v_y = (1 - b_r / L) * r * sm.cos(theta) * theta_d
    rod = m_r * (v_x**2 + v_y**2) / 2 + J_r * (phi_slope * theta_d) ** 2 / 2
    return {
        "kinetic_energy": J_O * theta_d**2 / 2 + rod + m_s * (x_slope * theta_d) ** 2 / 2,
        "potential_energy": (
            m_c * g * a_c * sm.sin(theta)
            + m_r * g * (1 - b_r / L) * r * sm.sin(theta)
            + k_s * (x_B - x_0) ** 2 / 2
        ),
        "dissipation": c_b * theta_d**2 / 2 + c_g * (x_slope * theta_d) ** 2 / 2,
        "generalized_forces": {theta: M_m + F_p * x_slope},
    }


def build() -> System:
    """The crank press as a System."""
    return System(
        number=1,
        key="slider_crank_press",
        title="Crank press with a spring-returned ram",
        field="machines",
        description=(
            "A crank of length r turns in a vertical plane about the fixed bearing O; theta is its angle "
            "from the horizontal, counter-clockwise. A rod of length L joins the crank pin A to the pin B "
            "of a ram, which slides in a horizontal guide at the height of O and stays to the right: the "
            "rod slopes down by phi with L sin(phi) = r sin(theta). The mass center of the crank lies on "
            "OA at the distance a_c from O (the counterweight is not perfect), that of the rod on AB at "
            "b_r from A. A spring k_s between ram and frame is relaxed when B is at x_0; c_g damps the "
            "guide, c_b the bearing. The motor torque M_m acts counter-clockwise on the crank, the process "
            "force F_p pushes the ram to the right. Gravity acts down."
        ),
        measured="crank encoder and ram accelerometer while the press coasts down: harmonics of its speed",
        coordinates=(
            Coordinate(
                theta, "rad", "crank angle from the horizontal, counter-clockwise", (-pi, pi), "angle"
            ),
        ),
        parameters=PARAMETERS,
        inputs=(
            Input(M_m, "N m", "motor torque on the crank, counter-clockwise", "couple"),
            Input(F_p, "N", "process force on the ram, positive to the right"),
        ),
        **_energies(),
        frame=ground,
        free_bodies=free_bodies,
        unknowns=(O_x, O_y, A_x, A_y, B_x, B_y, N_g),
        shapes=shapes,
    )
