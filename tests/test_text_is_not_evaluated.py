"""No door of the package evaluates text: hostile text is refused, and nothing of it happens."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path

import pytest
import sympy as sm
from sympy.physics.mechanics import Particle, Point, ReferenceFrame, dynamicsymbols

import engdyn as ed

SOURCE = Path(ed.__file__).parent
theta, y, u = dynamicsymbols("theta y u")
m = sm.Symbol("m", positive=True)
T = m * theta.diff() ** 2 / 2


def block():
    """A particle that slides along x."""
    frame, origin = ReferenceFrame("N"), Point("O")
    origin.set_vel(frame, 0)
    return frame, [ed.FreeBody(Particle("block", origin.locatenew("P", theta * frame.x), m))]


def newton(**more):
    frame, bodies = block()
    return ed.newton_euler(bodies, [theta], frame, [], **more)


def crane():
    return ed.systems.load("S07")


def with_default(text):
    system = crane()
    eom = replace(system.equations, defaults={system.inputs[0].symbol: (text, 0, 0)})
    return eom.accelerations([0, 0], [0, 0], system.values())


DOORS = {
    "kinetic": lambda text: ed.lagrange(text, 0, [theta]),
    "potential": lambda text: ed.lagrange(T, text, [theta]),
    "dissipation": lambda text: ed.lagrange(T, 0, [theta], text),
    "forces": lambda text: ed.lagrange(T, 0, [theta], 0, {theta: text}),
    "constraints of Lagrange": lambda text: ed.lagrange(T, 0, [theta, y], 0, None, [text]),
    "constraints of Newton": lambda text: newton(constraints=[text]),
    "kinematics": lambda text: newton(speeds=[u], kinematics={theta: text}),
    "residuals": lambda text: ed.EquationsOfMotion.from_residuals([text], [theta]),
    "coordinates": lambda text: ed.lagrange(T, 0, [text]),
    "defaults": with_default,
    "place of linearization": lambda text: ed.linearize(crane().equations, {"theta": text}, symbolic=True),
    "inputs": lambda text: crane().equilibria(F=text),
    "parameters": lambda text: crane().values(m=text),
    "rates": lambda text: ed.equilibria(crane().equations, crane().values(), rates={"x": text}),
    "range": lambda text: crane().branches("m", (text, 2)),
    "inertia": lambda text: ed.inertia_tensor([text], [(1, 2, 3)]),
    "inputs over time": lambda text: crane().simulate(([0, 0], [0, 0]), [0, 1], inputs={"F": text}),
    "inputs of three parts": lambda text: crane().simulate(
        ([0, 0], [0, 0]), [0, 1], inputs={"F": (text, 0, 0)}
    ),
    "events": lambda text: crane().simulate(([0, 0], [0, 0]), [0, 1], events=[text]),
    "outputs": lambda text: crane().simulate(([0, 0], [0, 0]), [0, 1]).output(text),
    "names": lambda text: crane().simulate(([0, 0], [0, 0]), [0, 1])[text],
    "system": lambda text: ed.systems.load(text),
}


@pytest.mark.parametrize("door", DOORS)
def test_hostile_text_is_refused_and_does_nothing(door, tmp_path):
    proof = tmp_path / "evaluated"
    text = f"__import__('pathlib').Path({str(proof)!r}).touch()"
    with pytest.raises(ed.EngdynError):
        DOORS[door](text)
    assert not proof.exists()


@pytest.mark.parametrize("door", ["forces", "kinematics", "constraints of Lagrange", "defaults"])
def test_harmless_text_is_refused_as_well_with_a_way_out(door):
    with pytest.raises(ed.EngdynError, match="not text"):
        DOORS[door]("2*m")


def test_numbers_stand_for_expressions():
    with_force = ed.lagrange(T, 0, [theta], 0, {theta: 3})
    assert with_force.forcing[0] == 3


def test_sympify_is_called_in_one_place_and_strictly():
    calls = {
        (path.name, line.strip())
        for path in SOURCE.rglob("*.py")
        for line in path.read_text(encoding="utf-8").splitlines()
        if re.search(r"\b(sympify|parse_expr|lambdify)\(", line)
    }
    assert {name for name, _ in calls} == {"expressions.py"}
    assert all("strict=True" in line for _, line in calls)
