"""Two hinged bars with all their reactions: free bodies, energies, and the balances written out."""

from __future__ import annotations

import sympy as sm
from sympy.physics.mechanics import Force, Point, ReferenceFrame, RigidBody, dynamicsymbols, inertia

import engdyn as ed
from benchmarks.models import Model

ANGLES, t = dynamicsymbols("a b"), dynamicsymbols._t
LENGTHS, MASSES = sm.symbols("l1 l2", positive=True), sm.symbols("m1 m2", positive=True)
GRAVITY = sm.Symbol("g", positive=True)
REACTIONS = sm.symbols("O_x O_y A_x A_y")


def centers() -> list[list[sm.Expr]]:
    """Coordinates of both mass centers, y up."""
    (a, b), (p, q) = ANGLES, LENGTHS
    return [
        [p * sm.sin(a) / 2, -p * sm.cos(a) / 2],
        [p * sm.sin(a) + q * sm.sin(b) / 2, -p * sm.cos(a) - q * sm.cos(b) / 2],
    ]


def double_bar() -> Model:
    """The model for engdyn: two rigid bodies, four reactions."""
    N, O = ReferenceFrame("N"), Point("O")
    O.set_vel(N, 0)
    hinge, bodies, kinetic, potential = O, [], sm.S.Zero, sm.S.Zero
    across = [x * N.x + y * N.y for x, y in (REACTIONS[:2], REACTIONS[2:])]
    for i, (angle, length, mass) in enumerate(zip(ANGLES, LENGTHS, MASSES, strict=True)):
        B = N.orientnew(f"B{i}", "Axis", (angle, N.z))
        center = hinge.locatenew(f"G{i}", -length * B.y / 2)
        end = hinge.locatenew(f"E{i}", -length * B.y)
        moment = mass * length**2 / 12
        body = RigidBody(f"bar {i}", center, B, mass, (inertia(B, 0, 0, moment), center))
        reactions = [Force(hinge, across[i])] + ([Force(end, -across[1])] if i == 0 else [])
        bodies.append(ed.FreeBody(body, [Force(center, -mass * GRAVITY * N.y)], reactions))
        x, y = centers()[i]
        kinetic += mass * (x.diff(t) ** 2 + y.diff(t) ** 2) / 2 + moment * angle.diff() ** 2 / 2
        potential += mass * GRAVITY * y
        hinge = end
    return Model("two bars", list(ANGLES), N, bodies, list(REACTIONS), kinetic, potential)


def double_bar_accelerations() -> sm.Matrix:
    """The accelerations that the six balances give when sympy solves them for all six unknowns."""
    Ox, Oy, Ax, Ay = REACTIONS
    wanted = [angle.diff().diff() for angle in ANGLES]
    names = sm.symbols("alpha beta")
    loads = [(Ox - Ax, Oy - Ay), (Ax, Ay)]
    rows = []
    for i, (angle, length, mass) in enumerate(zip(ANGLES, LENGTHS, MASSES, strict=True)):
        x, y = (c.diff(t, 2).xreplace(dict(zip(wanted, names, strict=True))) for c in centers()[i])
        rows += [mass * x - loads[i][0], mass * y - loads[i][1] + mass * GRAVITY]
        up = [-length * sm.sin(angle) / 2, length * sm.cos(angle) / 2]  # from the center to the upper hinge
        start, end = REACTIONS[2 * i : 2 * i + 2], (-Ax, -Ay) if i == 0 else (0, 0)
        moment = up[0] * start[1] - up[1] * start[0] - up[0] * end[1] + up[1] * end[0]
        rows.append(mass * length**2 / 12 * names[i] - moment)
    matrix, right = sm.linear_eq_to_matrix(rows, [*names, *REACTIONS])
    return matrix.LUsolve(right)[:2, :]
