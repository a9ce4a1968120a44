"""The truth of the exercises of chapter 4, equilibrium solutions, and the hints for their known mistakes."""

from __future__ import annotations

from math import pi

import sympy as sm

from engdyn.course.bank.ch04_lamp import LAMP, LAMP_EQUATION, LAMP_ROOTS, LAMP_STIFFNESS
from engdyn.course.bank.ch04_magnet import MAGNET, MAGNET_CURRENT, MAGNET_EQUATION, MAGNET_ROOTS
from engdyn.course.case import Case, Setup
from engdyn.course.judging_choices import Choice
from engdyn.course.judging_expressions import Expression
from engdyn.course.judging_numbers import Number
from engdyn.course.judging_sets import RootSet
from engdyn.course.registry import Exercise
from engdyn.course.statics import linear_solution, small_angle, steady_residuals
from engdyn.system import System
from engdyn.systems.library import load

__all__ = ["EXERCISES"]

# 4.3: the flyball governor at constant speed (S03)


def governor_factor(system: System) -> sm.Poly:
    """What is left of the equilibrium equation, as a polynomial in cos(theta), once sin(theta) is taken out."""
    theta = system.coordinates[0].symbol
    sine, cosine = sm.symbols("sine cosine")
    (residual,) = steady_residuals(system)
    row = sm.expand(residual).xreplace({sm.sin(theta): sine, sm.cos(theta): cosine})
    return sm.Poly(sm.cancel(row / sine), cosine)


def governor_cosine(system: System) -> sm.Expr:
    """cos(theta) in the raised position."""
    slope, constant = governor_factor(system).all_coeffs()
    return sm.cancel(-constant / slope)


def governor_critical_speed(system: System) -> sm.Expr:
    """The speed at which cos(theta) of the raised position reaches 1."""
    (Omega,) = (p.symbol for p in system.parameters if p.name == "Omega")
    at_bottom = sm.Poly(governor_factor(system).eval(1), Omega)
    return sm.sqrt(sm.cancel(-at_bottom.nth(0) / at_bottom.nth(2)))


def governor_is_raised(values: dict[str, float]) -> bool:
    """Well above the critical speed, and the balls not near the top of their range."""
    lift = values["m"] * values["l"] * values["Omega"] ** 2
    return lift > 1.1 * (values["m"] + values["M_c"]) * values["g"]


GOVERNOR = Setup(lambda: load("S03"), ("m", "M_c", "l", "k", "Omega"), accepted=governor_is_raised)

GOVERNOR_COSINE = Expression(
    governor_cosine,
    unit="1",
    wrong=[
        ("1", "That is theta = 0, the root of the factor sin(theta). Asked for is the other factor's."),
        (
            "acos(((m + M_c)*g + 2*k*l)/(2*k*l + m*l*Omega**2))",
            "You give the angle itself. Asked for is its cosine: leave out the last step.",
        ),
        (
            "(2*(m + M_c)*g + k*l)/(k*l + 2*m*l*Omega**2)",
            "The spring is stretched by the travel of the collar, and the collar moves twice as far as a ball does downward.",
        ),
        (
            "((m + M_c)*g + k*l)/(k*l + m*l*Omega**2)",
            "The spring force is right, its lever is not: when theta grows, the collar rises by 2*l*sin(theta) per radian.",
        ),
        (
            "((2*m + M_c)*g + 4*k*l)/(4*k*l + 2*m*l*Omega**2)",
            "The collar hangs at the depth of two links below P, so its weight has twice the lever of a ball's weight.",
        ),
        ("(m*g + 2*k*l)/(2*k*l + m*l*Omega**2)", "The weight of the collar is left out; the links hand it on to the balls."),
        (
            "((m + 2*M_c)*g + 4*k*l)/(4*k*l + m*l*Omega**2)",
            "Only one ball is counted, but both carry the same collar and the same spring.",
        ),
        (
            "((m + M_c)*g + 2*k*l)/(2*k*l - m*l*Omega**2)",
            "The term with Omega has the wrong sign: turning faster must lift the balls. In L = T - V it enters through T.",
        ),
        (
            "((m + M_c)*g + 2*k*l)/(2*k*l + 2*m*l*Omega**2)",
            "The effect of the rotation is counted twice: it belongs to T, or to an effective potential, not to both.",
        ),
        ("(m + M_c)*g/(m*l*Omega**2)", "The spring is left out; this is a governor without one."),
    ],
    remark="Below the critical speed this would exceed 1: then the raised position does not exist.",
)

GOVERNOR_SPEED = Expression(
    governor_critical_speed,
    unit="rad/s",
    wrong=[
        ("(m + M_c)*g/(m*l)", "That is the square of the speed: check the unit."),
        ("sqrt(g/l)", "That is a ball alone on its arm. Here two balls also have to lift the collar."),
        (
            "sqrt(((m + M_c)*g + 2*k*l)/(m*l))",
            "The spring cannot matter yet: it is relaxed at theta = 0, and its moment is of third order in theta there.",
        ),
        (
            "sqrt((2*m + M_c)*g/(2*m*l))",
            "The weight of the collar has too small a lever: the collar travels twice as far as a ball.",
        ),
        ("sqrt((m + 2*M_c)*g/(m*l))", "One ball alone would have to lift the whole collar: count both."),
        ("sqrt((m + M_c)*g/(2*m*l))", "The rotation is counted twice, once in T and once in V."),
    ],
    remark="The spring decides how far the governor opens, not when it begins to.",
)

GOVERNOR_ROOTS = RootSet(
    lambda case: [e.q[0] for e in case.system.equilibria(case.values)],
    unit="rad",
    wrong=[
        (
            lambda case, roots: [x for x in roots if abs(x) > 1e-6],
            "The root theta = 0 is lost: dividing by sin(theta) is allowed only where it is not zero. Factor instead.",
        ),
        (
            lambda case, roots: [x for x in roots if x > -1e-6],
            "The mirror image is lost: a cosine belongs to two angles, and the exercise admits negative ones.",
        ),
        (
            lambda case, roots: [max(roots)],
            "Two roots are lost: the one of the factor you divided by, and the mirror image that acos does not return.",
        ),
        (
            lambda case, roots: [0.0],
            "The balls can also stay out: you kept the factor sin(theta) alone. Your speed is above the critical one.",
        ),
    ],
    region=lambda case: (-pi / 2, pi / 2),
    remark="All three are equilibria; chapter 5 decides which of them the governor can keep.",
)

# 4.7: the gantry crane under a constant drive force (S07)

DRIVE = 3700.0  # N


def crane_angle(case: Case) -> float:
    """The angle at which the container hangs below the trolley while that accelerates."""
    return min((float(e.q[1]) for e in case.system.equilibria(case.values, F=DRIVE)), key=abs)


CRANE = Setup(lambda: load("S07"), ("M_t", "m", "L", "J_G"), {"c_x": 0.0})

CRANE_ANGLE = Number(
    crane_angle,
    unit="rad",
    wrong=[
        (
            f"atan({DRIVE}/((M_t + m)*g))",
            "Only the sign is wrong. The trolley accelerates to the right and the container lags behind; theta counts "
            "counter-clockwise.",
        ),
        (
            f"-180/pi*atan({DRIVE}/((M_t + m)*g))",
            "These are degrees. Give radians, or write the unit: '... deg'.",
        ),
        (
            f"-atan({DRIVE}/(M_t*g))",
            "The force accelerates the trolley and the container together, not the trolley alone.",
        ),
        (f"-atan({DRIVE}/(m*g))", "The force accelerates the trolley as well, not only the container."),
        (f"-{DRIVE}/((M_t + m)*g)", "The tangent was taken for the angle (right for small angles only), or digits were lost: keep four."),
        (
            f"-asin({DRIVE}/((M_t + m)*g))",
            "Weight and inertia force are the two legs of the right triangle, so their ratio is a tangent, not a sine.",
        ),
        (
            "0",
            "That would be steady speed, the end of the story when c_x > 0. Here nothing brakes the trolley: it accelerates.",
        ),
        (
            f"pi - atan({DRIVE}/((M_t + m)*g))",
            "The container stands on its head above the trolley. That is an equilibrium, but not the hanging one.",
        ),
    ],
    remark="L and J_G do not matter: the container does not turn.",
)

CRANE_STORY = Choice(
    "b",
    {
        "a": "The crane cannot accelerate for ever: what the trolley damper takes grows with the speed until it equals F.",
        "c": "Write the equation of theta at constant speed: is there anything left in it but the weight?",
        "d": "At rest the damper exerts no force, so the drive force would be without an opponent.",
    },
    1,
    {
        2: "The trolley damper is fixed to trolley and rail. It acts on the container only by way of an acceleration.",
        3: "The hinge damper ends the swing, but it cannot choose where: at rest its moment is zero at any angle.",
    },
    remark="With c_x = 0 the neutral coordinate x has a constant acceleration, with c_x > 0 a constant speed.",
)

# 4.13: static sag of the half car (S23)


def half_car_at_rest(system: System) -> dict[sm.Expr, sm.Expr]:
    """Coordinates of the half car at rest, for small pitch."""
    symbols = [c.symbol for c in system.coordinates]
    theta = symbols[1]
    return linear_solution([small_angle(row, theta) for row in steady_residuals(system)], symbols)


def front_tire_load(system: System) -> sm.Expr:
    """Force of the road on the front tire, upward."""
    height = {c.name: c.symbol for c in system.coordinates}["zf"]
    stiffness = {p.name: p.symbol for p in system.parameters}["k_tf"]
    return sm.cancel(-stiffness * half_car_at_rest(system)[height])


def pitch_at_rest(system: System) -> sm.Expr:
    """Pitch angle of the half car at rest, nose up."""
    return sm.cancel(half_car_at_rest(system)[system.coordinates[1].symbol])


HALF_CAR = Setup(lambda: load("S23"), ("m_s", "a", "b", "m_f", "m_r", "k_f", "k_r", "k_tf", "k_tr"))

TIRE_LOAD = Expression(
    front_tire_load,
    unit="N",
    wrong=[
        (
            "m_s*g*a/(a + b) + m_f*g",
            "The lever is the wrong one: take moments about the rear axle. The nearer axle carries more of the body.",
        ),
        ("m_s*g*b/(a + b)", "That is the force in the suspension. The tire also carries what is below the suspension."),
        ("m_s*g*a/(a + b)", "The lever is the wrong one, and the tire also carries what is below the suspension."),
        ("m_s*g/2 + m_f*g", "The body's weight is shared in halves only if G lies midway between the axles."),
        (
            "(m_s + m_f + m_r)*g*b/(a + b)",
            "The wheels' weights do not pass through the body: each goes straight into its own tire.",
        ),
        (
            "k_f/(k_f + k_r)*m_s*g + m_f*g",
            "Stiffness does not share the load here: the body tilts until the moments about G vanish. Use statics alone.",
        ),
        ("m_s*g*b/(a + b) - m_f*g", "The weight of the wheel presses on the tire too: check its sign."),
    ],
    remark="No stiffness in it: the structure is statically determinate, so loads come before deflections.",
)

PITCH = Expression(
    pitch_at_rest,
    unit="rad",
    also=[
        "asin((m_s*g*a/(a + b)*(1/k_r + 1/k_tr) + m_r*g/k_tr - m_s*g*b/(a + b)*(1/k_f + 1/k_tf) - m_f*g/k_tf)/(a + b))"
    ],
    wrong=[
        (
            "-(m_s*g*a/(a + b)*(1/k_r + 1/k_tr) + m_r*g/k_tr - m_s*g*b/(a + b)*(1/k_f + 1/k_tf) - m_f*g/k_tf)/(a + b)",
            "Only the sign is wrong: theta is positive nose up, so a deeper sag in front makes it negative.",
        ),
        ("m_s*g*(a/k_r - b/k_f)/(a + b)**2", "The tires are left out: they deflect as well, in series with the springs."),
        (
            "m_s*g*(a*(1/k_r + 1/k_tr) - b*(1/k_f + 1/k_tf))/(a + b)**2",
            "The wheels' own weights are left out: they press on the tires too.",
        ),
        (
            "(m_s*g*b/(a + b)*(1/k_r + 1/k_tr) + m_r*g/k_tr - m_s*g*a/(a + b)*(1/k_f + 1/k_tf) - m_f*g/k_tf)/(a + b)",
            "The two loads are exchanged: the axle nearer to G carries more.",
        ),
        (
            "m_s*g*(a/(k_r + k_tr) - b/(k_f + k_tf))/(a + b)**2",
            "Spring and tire stand on top of each other: their deflections add, not their stiffnesses.",
        ),
        (
            "(m_s*g/2*(1/k_r + 1/k_tr) + m_r*g/k_tr - m_s*g/2*(1/k_f + 1/k_tf) - m_f*g/k_tf)/(a + b)",
            "The weight of the body is not shared in halves: G is nearer to one axle.",
        ),
        (
            "(m_s*g*a/(a + b)*(1/k_r + 1/k_tr) + m_r*g/k_tr + m_s*g*b/(a + b)*(1/k_f + 1/k_tf) + m_f*g/k_tf)/(a + b)",
            "The sags were added. A car that sags equally at both ends does not pitch: take the difference.",
        ),
    ],
    remark="z follows from one sag and this angle; no simultaneous equations were needed.",
)

EXERCISES = (
    Exercise("4.3", ("S03",), "How far does the governor open?", "4.3", 10, 2, GOVERNOR, GOVERNOR_COSINE),
    Exercise("4.3b", ("S03",), "When does the governor begin to open?", "4.3", 5, 2, GOVERNOR, GOVERNOR_SPEED),
    Exercise("4.3c", ("S03",), "All steady angles at your speed", "4.3", 5, 1, GOVERNOR, GOVERNOR_ROOTS),
    Exercise("4.7", ("S07",), "The container behind an accelerating trolley", "4.3", 10, 2, CRANE, CRANE_ANGLE),
    Exercise("4.7b", ("S07",), "The same force, but with a brake", "4.4", 5, 2, CRANE, CRANE_STORY),
    Exercise("4.13", ("S23",), "What the front tire carries", "4.2", 5, 1, HALF_CAR, TIRE_LOAD),
    Exercise("4.13b", ("S23",), "Nose up or nose down?", "4.2", 15, 2, HALF_CAR, PITCH),
    Exercise("4.14", (), "A desk lamp: your equation of motion", "4.1", 10, 2, LAMP, LAMP_EQUATION),
    Exercise("4.14b", (), "A desk lamp: every angle at which it rests", "4.1", 10, 2, LAMP, LAMP_ROOTS),
    Exercise("4.14c", (), "A desk lamp: the stiffness that holds it upright", "4.2", 10, 3, LAMP, LAMP_STIFFNESS),
    Exercise("4.15", (), "A holding magnet: your equation of motion", "4.1", 5, 1, MAGNET, MAGNET_EQUATION),
    Exercise("4.15b", (), "A holding magnet: where the armature can rest", "4.1", 10, 2, MAGNET, MAGNET_ROOTS),
    Exercise("4.15c", (), "A holding magnet: the pull-in current", "4.2", 10, 3, MAGNET, MAGNET_CURRENT),
)
