"""Exercise 4.15: a holding magnet that pulls its armature the stronger the nearer it comes."""

from __future__ import annotations

import numpy as np
import sympy as sm
from sympy.physics.vector import dynamicsymbols

from engdyn import shapes as sh
from engdyn.analysis.equilibrium import equilibria
from engdyn.course.case import Case, Setup
from engdyn.course.judging_equations import Equations
from engdyn.course.judging_expressions import Expression
from engdyn.course.judging_sets import RootSet
from engdyn.course.statics import steady_residuals
from engdyn.system import Coordinate, Parameter, System

__all__ = ["MAGNET", "MAGNET_CURRENT", "MAGNET_EQUATION", "MAGNET_ROOTS", "holding_magnet"]


def holding_magnet() -> System:
    """Exercise 4.15: an armature on a spring, attracted the stronger the nearer it comes."""
    parameters = (
        Parameter("m", "kg", 0.15, "mass of the armature"),
        Parameter("k", "N/m", 800.0, "spring stiffness"),
        Parameter("c", "N s/m", 2.0, "damping", "nonnegative"),
        Parameter("d", "m", 0.012, "air gap with the spring relaxed"),
        Parameter("C", "N m^2/A^2", 4.0e-5, "strength of the magnet"),
        Parameter("i", "A", 1.9, "coil current", "any"),
    )
    m, k, c, d, C, i = (p.symbol for p in parameters)
    x = dynamicsymbols("x")
    rate = x.diff(dynamicsymbols._t)
    return System(
        key="holding_magnet",
        title="Holding magnet and its armature",
        description=(
            "An armature of mass m slides without friction on a horizontal guide. A spring k, relaxed at "
            "x = 0, and a damper c "
            "join it to the frame on its left. A magnet on its right, across an air gap that is d wide at "
            "x = 0, "
            "attracts it with the force C*i^2/gap^2, where i is the coil current. x is the travel of the "
            "armature "
            "towards the magnet. The guide is horizontal, so gravity plays no part."
        ),
        coordinates=(Coordinate(x, "m", "travel of the armature towards the magnet", (0.0, 0.01), "length"),),
        parameters=parameters,
        kinetic_energy=m * rate**2 / 2,
        potential_energy=k * x**2 / 2 - C * i**2 / (d - x),
        dissipation=c * rate**2 / 2,
        shapes=_draw_magnet,
    )


def _draw_magnet(q: list[float], values: dict[str, float]) -> list:
    """Wall with spring and damper, armature on its guide, magnet."""
    (x,), d = q, values["d"]
    wall, width, height = -2.4 * d, 0.5 * d, 1.1 * d
    face = x  # right face of the armature; the magnet's face stays at d
    left, middle = face - width, face - width / 2
    return [
        sh.Ground((wall, -0.7 * d), (wall, 0.8 * d)),
        sh.Ground((1.7 * d, -0.6 * d), (wall, -0.6 * d)),
        sh.Spring((wall, 0.28 * d), (left, 0.28 * d), "$k$"),
        sh.Damper((wall, -0.25 * d), (left, -0.25 * d), "$c$"),
        sh.Box((middle, 0.0), (width, height), 0.0, "$m$"),
        sh.Box((1.3 * d, 0.0), (0.6 * d, height), 0.0, "$C, i$", role="ground"),
        sh.CenterLine((0.0, 0.55 * d), (0.0, 1.1 * d)),
        sh.CoordinateArrow((0.0, 0.75 * d), (face, 0.75 * d), "$x$", (1.0, 0.0)),
        sh.Dimension((0.0, 1.0 * d), (d, 1.0 * d), "$d$", 0.1 * d),
        sh.CenterLine((d, 0.55 * d), (d, 1.3 * d)),
    ]


def magnet_positions(case: Case) -> list[float]:
    """Equilibria between the relaxed spring and the magnet."""
    region = {"x": (0.0, 0.999 * case.values["d"])}
    return [float(e.q[0]) for e in equilibria(case.system.equations, case.values, region)]


def cubic_roots(case: Case) -> list[float]:
    """All real roots of the equation after it is multiplied by the square of the gap."""
    k, d, C, i = (case.values[name] for name in ("k", "d", "C", "i"))
    return sorted(float(root.real) for root in np.roots([k, -2 * k * d, k * d**2, -C * i**2]))


def pull_in_current(system: System) -> sm.Expr:
    """The largest current for which the armature has an equilibrium."""
    x = sm.Dummy("x")
    (residual,) = steady_residuals(system)
    names = {p.name: p.symbol for p in system.parameters}
    current, gap = names["i"], names["d"]
    row = sm.Poly(sm.numer(sm.together(residual.xreplace({system.coordinates[0].symbol: x}))), current)
    squared = sm.cancel(-row.nth(0) / row.nth(2))  # the current squared that holds the armature at x
    turning = [
        place for place in sm.roots(sm.Poly(sm.numer(sm.together(squared.diff(x))), x)) if place != gap
    ]
    return sm.sqrt(sm.cancel(squared.xreplace({x: turning[0]})))


def below_pull_in(values: dict[str, float]) -> bool:
    """Both equilibria exist, neither merging nor at the ends of the gap."""
    k, d, C, i = (values[name] for name in ("k", "d", "C", "i"))
    return 0.5 < i / (4 * k * d**3 / (27 * C)) ** 0.5 < 0.95


MAGNET = Setup(holding_magnet, ("k", "d", "C", "i"), accepted=below_pull_in)

_MOTION = "m*x_dd + c*x_d + k*x"

MAGNET_EQUATION = Equations(
    wrong=[
        ([f"{_MOTION} + C*i**2/(d - x)**2"], "The magnet pushes: its force must act towards positive x."),
        (
            [f"{_MOTION} - C*i**2/(d + x)**2"],
            "The gap opens: when x grows, the armature comes nearer to the magnet.",
        ),
        (
            [f"{_MOTION} - C*i**2/d**2"],
            "The gap stays what it was: the force must grow as the armature comes nearer.",
        ),
        (
            [f"{_MOTION} - C*i**2/x**2"],
            "x is the travel, not the gap: it is zero where the spring is relaxed.",
        ),
        (
            [f"{_MOTION} - C*i**2/(d - x)"],
            "That is the energy of the magnet, or its force with one power of the gap lost.",
        ),
        ([f"{_MOTION} - C*i/(d - x)**2"], "The force grows with the square of the current."),
        (["m*x_dd - c*x_d + k*x - C*i**2/(d - x)**2"], "The damper feeds energy in: check its sign."),
        (["m*x_dd + c*x_d - k*x - C*i**2/(d - x)**2"], "The spring pushes the armature on: check its sign."),
    ],
)

MAGNET_ROOTS = RootSet(
    magnet_positions,
    unit="m",
    noun="position",
    periodic=False,
    wrong=[
        (
            lambda case, roots: cubic_roots(case),
            "One root lies beyond the magnet. It came in when the equation was multiplied by the gap "
            "squared.",
        ),
        (
            lambda case, roots: [min(roots)],
            "That is where an iteration from x = 0 ends. Draw both forces over x: the curves meet again.",
        ),
        (
            lambda case, roots: [max(roots)],
            "The position near the relaxed spring is missing: for a small current the armature hardly moves.",
        ),
        (
            lambda case, roots: [case.number("C*i**2/(k*d**2)")],
            "The gap was kept at d: this is the first step of an iteration, and it also loses a root.",
        ),
        (
            lambda case, roots: [case.values["d"] - x for x in roots],
            "These are the gaps. Asked for is the travel x of the armature.",
        ),
        (
            lambda case, roots: [max(cubic_roots(case))],
            "This root alone lies beyond the magnet: the armature cannot get there.",
        ),
    ],
    region=lambda case: (0.0, case.values["d"]),
    remark=(
        "Of the two, the nearer one to the magnet is a position in which nobody will ever see the "
        "armature rest."
    ),
)

MAGNET_CURRENT = Expression(
    pull_in_current,
    unit="A",
    wrong=[
        (
            "sqrt(k*d**3/(8*C))",
            "The armature was put halfway. The limit is where the two equilibria merge, not where the gap "
            "is halved.",
        ),
        (
            "sqrt(k*d**3/(27*C))",
            "Travel and gap are mixed up in one factor: if the travel is a third of d, the gap is the "
            "rest of it.",
        ),
        (
            "sqrt(2*k*d**3/(27*C))",
            "Travel and gap have changed places: at the limit the armature has not yet gone half the way.",
        ),
        ("4*k*d**3/(27*C)", "That is the square of the current: check the unit."),
        ("sqrt(4*k*d**2/(27*C))", "A power of d was lost on the way: check the unit."),
        (
            "sqrt(k*d**3/C)",
            "That current would hold the armature at x = d with the force of the open gap: the gap closes "
            "meanwhile.",
        ),
    ],
    remark="Beyond it the armature snaps to the magnet: two equilibria have met and vanished, a saddle-node.",
)
