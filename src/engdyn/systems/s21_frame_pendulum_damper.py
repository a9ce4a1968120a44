"""S21 Two-storey frame: a pendulum under the roof takes the motion out of it."""

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
from engdyn.quantities import Coordinate, Input, Parameter
from engdyn.system import System

PARAMETERS = (
    Parameter("m_1", "kg", 40000.0, "floor 1"),
    Parameter("m_2", "kg", 35000.0, "floor 2"),
    Parameter("m_3", "kg", 2000.0, "pendulum bob"),
    Parameter("k_1", "N/m", 1200000.0, "stiffness of the lower storey", "nonnegative"),
    Parameter("k_2", "N/m", 1000000.0, "stiffness of the upper storey", "nonnegative"),
    Parameter("c_1", "N s/m", 6000.0, "damping of the lower storey", "nonnegative"),
    Parameter("c_2", "N s/m", 5000.0, "damping of the upper storey", "nonnegative"),
    Parameter("L", "m", 0.85, "pendulum length"),
    Parameter("c_3", "N m s/rad", 900.0, "hinge damping", "nonnegative"),
    Parameter("g", "m/s^2", 9.81, "gravity", "any"),
)
m_1, m_2, m_3, k_1, k_2, c_1, c_2, L, c_3, g = (p.symbol for p in PARAMETERS)

x1, x2, theta, xg, F_w = dynamicsymbols("x1 x2 theta xg F_w")
x1_d, x2_d, theta_d, xg_d = dynamicsymbols("x1 x2 theta xg", 1)
N_1, N_2, S_a, S_t = sm.symbols("N_1 N_2 S_a S_t")

ground = ReferenceFrame("N")  # X right, Y up
rod_axes = ReferenceFrame("B")  # Y from the bob to the hinge
rod_axes.orient_axis(ground, theta, ground.z)


def free_bodies() -> list[FreeBody]:
    """Both floors, cut at the columns, and the bob with its light rod, cut at the hinge."""
    origin = Point("O")
    origin.set_vel(ground, 0)
    lower = origin.locatenew("P_1", (x1 + xg) * ground.x)
    upper = origin.locatenew("P_2", (x2 + xg) * ground.x)
    place = upper.locatenew("P_3", -L * rod_axes.y)
    spring = -k_2 * (x2 - x1) * ground.x  # both of the upper storey on the upper floor
    damper = -c_2 * (x2_d - x1_d) * ground.x
    hinge_force = S_a * rod_axes.y + S_t * rod_axes.x  # of the floor on the rod: along and across it

    floor_1 = FreeBody(
        Particle("floor 1", lower, m_1),
        applied=[
            Force(lower, -k_1 * x1 * ground.x),
            Force(lower, -c_1 * x1_d * ground.x),
            Force(lower, -spring),
            Force(lower, -damper),
            Force(lower, -m_1 * g * ground.y),
        ],
        reactions=[Force(lower, N_1 * ground.y), Force(lower, -N_2 * ground.y)],
    )
    floor_2 = FreeBody(
        Particle("floor 2", upper, m_2),
        applied=[
            Force(upper, spring),
            Force(upper, damper),
            Force(upper, F_w * ground.x),
            Force(upper, -m_2 * g * ground.y),
        ],
        reactions=[Force(upper, N_2 * ground.y), Force(upper, -hinge_force)],
    )
    # Moments about the bob give the shear: its lever L balances the couple of the hinge damper.
    pendulum = FreeBody(
        RigidBody("pendulum", place, rod_axes, m_3, (inertia(rod_axes, 0, 0, 0), place)),
        applied=[Force(place, -m_3 * g * ground.y), Torque(rod_axes, -c_3 * theta_d * ground.z)],
        reactions=[Force(upper, hinge_force)],
    )
    return [floor_1, floor_2, pendulum]


RIGHT = (1.0, 0.0)


def shapes(q: list[float], values: dict[str, float]) -> list:
    """Front view, ground at (0, 0); storeys are sized so that the pendulum hangs freely in the upper one."""
    x1, x2, theta, L = *q, values["L"]
    rise, half, slab = 1.65 * L, 1.5 * L, 0.09 * L
    hinge = (x2, 2.0 * rise - slab)
    bob = (x2 + L * sin(theta), hinge[1] - L * cos(theta))
    beside = half + 1.15 * L
    left = -half - 1.35 * L
    return [
        sh.Ground((left, 0.0), (half + 1.9 * L, 0.0)),
        *_storey(0.0, 0.0, x1, rise, half, slab, "1"),
        *_storey(x1, rise, x2, rise, half, slab, "2"),
        sh.CenterLine(hinge, (hinge[0], hinge[1] - 0.8 * L)),
        sh.TorsionalDamper(hinge, 0.36 * L, -pi / 2, theta - pi / 2, "$c_3$"),
        sh.Link(hinge, bob),
        sh.Disc(bob, 0.12 * L),
        sh.Label((bob[0], bob[1] - 0.12 * L), "$m_3$", (0.4, -1.0)),
        sh.AngleArrow(hinge, 0.66 * L, -pi / 2, theta - pi / 2, r"$\theta$"),
        sh.Dimension(hinge, bob, "$L$", offset=-0.45 * L if theta < 0.0 else 0.45 * L),
        sh.Pin(hinge),
        sh.CenterLine((beside, 0.0), (beside, 2.0 * rise + 0.2 * L), role="coordinate"),
        sh.CoordinateArrow((beside, rise), (beside + x1, rise), "$x_1$", positive=RIGHT),
        sh.CoordinateArrow((beside, 2.0 * rise), (beside + x2, 2.0 * rise), "$x_2$", positive=RIGHT),
        sh.ForceArrow((x2 - half - 0.75 * L, 2.0 * rise), (x2 - half, 2.0 * rise), "$F_w$"),
        sh.ForceArrow((left, -0.4 * L), (left + 0.7 * L, -0.4 * L), "$x_g$"),
        sh.GravityArrow((left + 0.3 * L, 1.5 * rise), (left + 0.3 * L, 1.5 * rise - 0.6 * L), "$g$"),
    ]


def _storey(
    below: float, foot: float, above: float, rise: float, half: float, slab: float, name: str
) -> list:
    """Two bent columns, a dashpot between them, and the floor they carry."""
    top = foot + rise - slab
    bottom = foot + slab * (foot > 0.0)

    def column(side: float) -> sh.Curve:
        steps = [i / 12 for i in range(13)]
        bend = [below + (above - below) * s * s * (3.0 - 2.0 * s) for s in steps]
        points = [(side + x, bottom + (top - bottom) * s) for x, s in zip(bend, steps, strict=True)]
        return sh.Curve(points, role="spring")

    edge, middle = 0.86 * half, 0.5 * (below + above)
    return [
        column(-edge),
        column(edge),
        sh.Label((middle - edge, 0.5 * (bottom + top)), f"$k_{name}$", (-1.0, 0.0)),
        sh.Damper((below - 0.8 * edge, bottom), (above - 0.35 * edge, top), f"$c_{name}$"),
        sh.Box((above, foot + rise), (2.0 * half, 2.0 * slab)),
        sh.Label((above + half, foot + rise), f"$m_{name}$", (1.0, 0.0)),
    ]


def build() -> System:
    """The frame as a System."""
    v_x = x2_d + xg_d + L * sm.cos(theta) * theta_d  # of the bob
    v_y = L * sm.sin(theta) * theta_d
    floors = m_1 * (x1_d + xg_d) ** 2 / 2 + m_2 * (x2_d + xg_d) ** 2 / 2
    return System(
        number=21,
        key="frame_pendulum_damper",
        title="Two-storey frame with a pendulum damper under earthquake and wind",
        field="civil, seismic",
        description=(
            "A frame of two storeys stands on ground that moves horizontally by xg, positive to the right. "
            "Its floors (masses m_1 and m_2) stay level, as their columns bend; x1 and x2 are their "
            "displacements relative to the ground. k_1 and k_2 are the stiffnesses of the lower and the "
            "upper storey, c_1 and c_2 the dampings in parallel. From the upper floor hangs a pendulum: a "
            "particle m_3 on a light rod of length L, theta counter-clockwise from the downward vertical; "
            "c_3 damps its hinge. Tuned well, the pendulum swings against the frame and calms it. Gravity "
            "acts down, but works on m_3 alone. A wind force F_w pushes the upper floor to the right."
        ),
        measured="accelerometers on the floors in a shaker test: shapes, half-power bandwidth, decrement",
        coordinates=(
            Coordinate(x1, "m", "floor 1 relative to the ground, to the right", (-1.0, 1.0), "length"),
            Coordinate(x2, "m", "floor 2 relative to the ground, to the right", (-1.0, 1.0), "length"),
            Coordinate(theta, "rad", "pendulum from below, counter-clockwise", (-pi, pi), "angle"),
        ),
        parameters=PARAMETERS,
        inputs=(
            Input(F_w, "N", "wind force on floor 2, positive to the right"),
            Input(xg, "m", "displacement of the ground, positive to the right", "prescribed motion"),
        ),
        kinetic_energy=floors + m_3 * (v_x**2 + v_y**2) / 2,
        potential_energy=k_1 * x1**2 / 2 + k_2 * (x2 - x1) ** 2 / 2 - m_3 * g * L * sm.cos(theta),
        dissipation=c_1 * x1_d**2 / 2 + c_2 * (x2_d - x1_d) ** 2 / 2 + c_3 * theta_d**2 / 2,
        generalized_forces={x2: F_w},
        frame=ground,
        free_bodies=free_bodies,
        unknowns=(N_1, N_2, S_a, S_t),
        shapes=shapes,
        pose=(0.25, 0.5, 0.45),
    )
