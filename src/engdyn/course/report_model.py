"""What a report says of the model: quantities, free bodies, equations and the proof, as HTML."""

from __future__ import annotations

import html
from collections.abc import Sequence
from typing import Any

import sympy as sm
from sympy.physics.mechanics import Force, Particle
from sympy.physics.vector import dynamicsymbols

from engdyn.algebra.expressions import as_expression
from engdyn.course.mathml import dyadic, equation, formula, vector
from engdyn.course.report_tables import number, paragraph, part_of_pi, table, unit
from engdyn.modeling.equality import Proof
from engdyn.modeling.equations import EquationsOfMotion
from engdyn.modeling.free_body import FreeBody
from engdyn.system import System

__all__ = ["balances", "energies", "equations", "free_bodies", "parameters", "proof_verdict"]


def parameters(system: System) -> str:
    """Coordinates, inputs and parameters."""
    coordinates = [
        (
            formula(c.symbol),
            f"<code>{html.escape(c.name)}</code>",
            html.escape(c.meaning),
            unit(c.unit),
            _interval(c),
        )
        for c in system.coordinates
    ]
    inputs = [
        (
            formula(i.symbol),
            f"<code>{html.escape(i.name)}</code>",
            html.escape(i.meaning),
            unit(i.unit),
            i.kind,
        )
        for i in system.inputs
    ]
    constants = [
        (
            formula(p.symbol),
            f"<code>{html.escape(p.name)}</code>",
            html.escape(p.meaning),
            number(p.default),
            unit(p.unit),
        )
        for p in system.parameters
    ]
    text = table("Coordinates", ("symbol", "name", "meaning", "unit", "region searched"), coordinates)
    if inputs:
        text += table("Inputs", ("symbol", "name", "meaning", "unit", "kind"), inputs)
    return text + table("Parameters", ("symbol", "name", "meaning", "default", "unit"), constants, right=(3,))


def _interval(coordinate: Any) -> str:
    if coordinate.bounds is None:
        return "whole turn" if coordinate.kind == "angle" else "–"
    show = part_of_pi if coordinate.unit == "rad" else number
    return " … ".join(show(float(x)) for x in coordinate.bounds)


def free_bodies(bodies: Sequence[FreeBody], frame: Any) -> str:
    """Every free body with its mass and all loads."""
    text = paragraph(
        f"Unit vectors carry the letter of their frame: {frame.name.lower()} is the inertial frame "
        f"{frame.name}. Reactions have unknown magnitudes; every load is written as the body feels it."
    )
    for body in bodies:
        kind = "particle" if isinstance(body.body, Particle) else "rigid body"
        about = f"{kind}, mass {formula(as_expression(body.body.mass))}"
        if body.turns:
            about += f", inertia about its mass center {dyadic(body.body.central_inertia)}"
        rows = [_load(load, "known") for load in body.applied] + [
            _load(load, "reaction") for load in body.reactions
        ]
        head = ("acts", "load", "kind")
        text += f"<h3>{html.escape(body.name.capitalize())}</h3><p>{about}.</p>{table('', head, rows)}"
    return text


def _load(load: Any, kind: str) -> tuple[str, str, str]:
    if isinstance(load, Force):
        return f"force at {html.escape(load.point.name)}", vector(load.force), kind
    return "couple", vector(load.torque), kind


def balances(eom: EquationsOfMotion) -> str:
    """How the equations come about."""
    text = "Force balances of all bodies, and moment balances about the mass centers of those that turn"
    if not eom.reactions:
        return paragraph(f"{text}.")
    names = ", ".join(formula(name) for name in eom.reactions)
    return f"<p>{text}; the reactions {names} are eliminated.</p>"


def energies(system: System) -> str:
    """T, V, D and the generalized forces."""
    named = [("T", system.kinetic_energy), ("V", system.potential_energy), ("D", system.dissipation)]
    text = "".join(equation(sm.Symbol(letter), as_expression(e)) for letter, e in named)
    for q, force in system.generalized_forces.items():
        text += equation(sm.Symbol(f"Q_{q.func.__name__}"), as_expression(force))
    for constraint in system.constraints:
        text += equation(as_expression(constraint), sm.S.Zero)
    return text


def equations(eom: EquationsOfMotion) -> str:
    """M u̇ = f row by row, and the kinematics where they are not q̇ = u."""
    accelerations = [u.diff(dynamicsymbols._t) for u in eom.speeds]
    text = ""
    for i, force in enumerate(eom.forcing):
        left = sm.Add(*(eom.mass_matrix[i, j] * a for j, a in enumerate(accelerations)))
        text += equation(left, force)
    for q, rate in zip(eom.coordinates, eom.kinematics, strict=True):
        if rate != q.diff(dynamicsymbols._t):
            text += equation(q.diff(dynamicsymbols._t), rate)
    return text


def proof_verdict(proof: Proof) -> str:
    """The verdict on both derivations, with the witness and the differences where they are not equal."""
    sentence = {
        "proved": "Proved: both derivations give the same equations of motion.",
        "refuted": "Refuted: the derivations give different equations of motion.",
        "undecided": "Undecided: neither equality nor a difference could be proved.",
    }[proof.verdict]
    mark = {"proved": " good", "refuted": " bad"}.get(proof.verdict, "")
    more = [proof.method, *(str(d) for d in proof.differences)]
    more += [f"at {proof.witness}"] if proof.witness is not None else []
    lines = "".join(f"<div>{html.escape(line[0].upper() + line[1:])}.</div>" for line in more)
    return f'<div class="verdict{mark}"><strong>{sentence}</strong>{lines}</div>'
