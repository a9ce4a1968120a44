"""S10 Instrument on a two-stage isolator: the sag under its own weight stiffens the mount."""

from __future__ import annotations

from sympy.physics.mechanics import Force, Particle, Point, ReferenceFrame, dynamicsymbols

from engdyn import shapes as sh
from engdyn.modeling.newton import FreeBody
from engdyn.quantities import Coordinate, Input, Parameter
from engdyn.system import System

PARAMETERS = (
    Parameter("m_1", "kg", 150.0, "raft"),
    Parameter("m_2", "kg", 400.0, "instrument"),
    Parameter("k_1", "N/m", 600000.0, "floor spring", "nonnegative"),
    Parameter("k_2", "N/m", 300000.0, "mount, linear stiffness", "nonnegative"),
    Parameter("k_3", "N/m^3", 300000000.0, "mount, cubic stiffness", "nonnegative"),
    Parameter("c_1", "N s/m", 3000.0, "floor damper", "nonnegative"),
    Parameter("c_2", "N s/m", 500.0, "mount damper", "nonnegative"),
    Parameter("g", "m/s^2", 9.81, "gravity", "any"),
)
m_1, m_2, k_1, k_2, k_3, c_1, c_2, g = (p.symbol for p in PARAMETERS)

y1, y2, yb, F = dynamicsymbols("y1 y2 yb F")
y1_d, y2_d, yb_d = dynamicsymbols("y1 y2 yb", 1)

ground = ReferenceFrame("N")  # Y up


def free_bodies() -> list[FreeBody]:
    """Raft and instrument; the forces of the mount act on both, with opposite signs."""
    origin = Point("O")
    origin.set_vel(ground, 0)
    raft_place, top_place = origin.locatenew("P_1", y1 * ground.y), origin.locatenew("P_2", y2 * ground.y)
    linear = -k_2 * (y2 - y1) * ground.y  # these three on the instrument
    cubic = -k_3 * (y2 - y1) ** 3 * ground.y
    damper = -c_2 * (y2_d - y1_d) * ground.y

    raft = FreeBody(
        Particle("raft", raft_place, m_1),
        applied=[
            Force(raft_place, -k_1 * (y1 - yb) * ground.y),
            Force(raft_place, -c_1 * (y1_d - yb_d) * ground.y),
            Force(raft_place, -linear),
            Force(raft_place, -cubic),
            Force(raft_place, -damper),
            Force(raft_place, -m_1 * g * ground.y),
        ],
    )
    instrument = FreeBody(
        Particle("instrument", top_place, m_2),
        applied=[
            Force(top_place, linear),
            Force(top_place, cubic),
            Force(top_place, damper),
            Force(top_place, -m_2 * g * ground.y),
            Force(top_place, F * ground.y),
        ],
    )
    return [raft, instrument]


UP = (0.0, 1.0)


def shapes(q: list[float], values: dict[str, float]) -> list:
    """Front view; relaxed springs are 0.25 m long, so that centimeters can be seen."""
    length, thick = 0.25, 0.08
    raft, table = length + q[0], 2.0 * length + thick + q[1]  # lower faces
    deck, top, beside = raft + thick, table + 1.4 * thick, 0.5
    return [
        sh.Ground((-0.45, 0.0), (0.6, 0.0)),
        sh.Box((0.0, raft + 0.5 * thick), (0.76, thick), label="$m_1$"),
        sh.Box((0.0, table + 0.7 * thick), (0.62, 1.4 * thick), label="$m_2$"),
        sh.Spring((-0.17, 0.0), (-0.17, raft)),
        sh.Label((-0.14, 0.5 * raft), "$k_1$", (1.0, 0.0)),
        sh.Damper((0.17, 0.0), (0.17, raft)),
        sh.Label((0.2, 0.5 * raft), "$c_1$", (1.0, 0.0)),
        sh.Spring((-0.17, deck), (-0.17, table), coils=4),
        sh.Label((-0.14, 0.5 * (deck + table)), "$k_2,\\ k_3$", (1.0, 0.0)),
        sh.Damper((0.17, deck), (0.17, table)),
        sh.Label((0.2, 0.5 * (deck + table)), "$c_2$", (1.0, 0.0)),
        sh.CenterLine((0.4, length), (0.58, length), role="coordinate"),
        sh.CoordinateArrow((beside, length), (beside, raft), "$y_1$", positive=UP),
        sh.CenterLine((0.33, 2.0 * length + thick), (0.58, 2.0 * length + thick), role="coordinate"),
        sh.CoordinateArrow((beside, 2.0 * length + thick), (beside, table), "$y_2$", positive=UP),
        sh.ForceArrow((0.5, -0.14), (0.5, 0.0), "$y_b$"),
        sh.ForceArrow((0.0, top), (0.0, top + 0.15), "$F$"),
        sh.GravityArrow((-0.5, top), (-0.5, top - 0.16), "$g$"),
    ]


def build() -> System:
    """The isolator as a System."""
    squeeze = y2 - y1
    mount = k_2 * squeeze**2 / 2 + k_3 * squeeze**4 / 4
    return System(
        number=10,
        key="two_stage_isolator",
        title="Instrument on a two-stage isolator with a stiffening mount",
        field="measurement, precision machines",
        description=(
            "A raft (mass m_1) stands on the floor on a spring k_1 and a damper c_1; an instrument (m_2) "
            "stands on the raft on a mount of linear stiffness k_2, cubic stiffness k_3 and damping c_2, "
            "which grows stiffer the more it is squeezed. y1 and y2 are the absolute displacements of raft "
            "and instrument, positive up; all springs are relaxed where y1 = y2 = yb = 0. Gravity acts "
            "down, so the working point lies lower, and the stiffness felt there is another one. The "
            "floor moves by yb, positive up; a force F pushes the instrument up."
        ),
        measured="accelerometers on floor and instrument: transmissibility, power spectral densities",
        coordinates=(
            Coordinate(y1, "m", "displacement of the raft, up", (-0.1, 0.1), "length"),
            Coordinate(y2, "m", "displacement of the instrument, up", (-0.1, 0.1), "length"),
        ),
        parameters=PARAMETERS,
        inputs=(
            Input(F, "N", "force on the instrument, positive up"),
            Input(yb, "m", "displacement of the floor, positive up", "prescribed motion"),
        ),
        kinetic_energy=m_1 * y1_d**2 / 2 + m_2 * y2_d**2 / 2,
        potential_energy=k_1 * (y1 - yb) ** 2 / 2 + mount + (m_1 * y1 + m_2 * y2) * g,
        dissipation=c_1 * (y1_d - yb_d) ** 2 / 2 + c_2 * (y2_d - y1_d) ** 2 / 2,
        generalized_forces={y2: F},
        frame=ground,
        free_bodies=free_bodies,
        shapes=shapes,
        pose=(0.07, 0.09),
    )
