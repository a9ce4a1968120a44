"""What a report says: tables, formulas and sentences of each section, as HTML."""

from __future__ import annotations

import html
import math
import re
from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np
import sympy as sm
from sympy.physics.mechanics import Force, Particle
from sympy.physics.vector import dynamicsymbols

from engdyn.analysis.results import EquilibriumSet
from engdyn.analysis.stability import Stability
from engdyn.course.mathml import dyadic, equation, formula, vector
from engdyn.errors import EngdynError
from engdyn.modeling.equality import Proof
from engdyn.modeling.equations import EquationsOfMotion
from engdyn.modeling.free_body import FreeBody
from engdyn.plots import words
from engdyn.system import System

__all__ = [
    "balances",
    "eigenvalue_tables",
    "energies",
    "equations",
    "equilibrium_table",
    "free_bodies",
    "parameters",
    "proof_verdict",
    "reactions",
]


def table(caption: str, head: Sequence[str], rows: Iterable[Sequence[str]], right: Sequence[int] = ()) -> str:
    """A table; the columns in `right` hold numbers."""
    marks = [' class="number"' if i in right else "" for i in range(len(head))]
    top = "".join(f'<th scope="col"{m}>{h}</th>' for m, h in zip(marks, head, strict=True))
    body = "".join(
        "<tr>" + "".join(f"<td{m}>{cell}</td>" for m, cell in zip(marks, row, strict=True)) + "</tr>"
        for row in rows
    )
    shown = f"<caption>{caption}</caption>" if caption else ""
    return f'<div class="wide"><table>{shown}<thead><tr>{top}</tr></thead><tbody>{body}</tbody></table></div>'


def paragraph(text: str, note: bool = False) -> str:
    """A paragraph of plain text."""
    return f"<p{' class=' + chr(34) + 'note' + chr(34) if note else ''}>{html.escape(text)}</p>"


def unit(text: str) -> str:
    """A unit for a table: powers raised, no unit is a dash."""
    return re.sub(r"\^(-?\d+)", r"<sup>\1</sup>", html.escape(text)) if text not in ("", "-") else "–"


def number(value: float) -> str:
    """Four significant digits, without a power of ten where that is readable."""
    size = abs(value)
    if size < 1e-12:
        return "0"
    if not 1e-4 <= size < 1e7:
        return words.number(value)
    digits = max(0, 3 - math.floor(math.log10(float(f"{size:.3e}"))))
    text = f"{value:.{digits}f}"
    return (text.rstrip("0").rstrip(".") if digits else text).replace("-", "−")


def part_of_pi(value: float) -> str:
    """An angle as a part of π where it is a simple one."""
    twelfths = round(12 * value / math.pi)
    if twelfths == 0 or abs(12 * value / math.pi - twelfths) > 1e-9:
        return number(value)
    divisor = math.gcd(twelfths, 12)
    above, below = abs(twelfths) // divisor, 12 // divisor
    return (
        ("−" if twelfths < 0 else "")
        + (f"{above}" if above > 1 else "")
        + "π"
        + (f"/{below}" if below > 1 else "")
    )


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
        about = f"{kind}, mass {formula(sm.sympify(body.body.mass))}"
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
    text = "".join(equation(sm.Symbol(letter), sm.sympify(e)) for letter, e in named)
    for q, force in system.generalized_forces.items():
        text += equation(sm.Symbol(f"Q_{q.func.__name__}"), sm.sympify(force))
    for constraint in system.constraints:
        text += equation(sm.sympify(constraint), sm.S.Zero)
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


def reactions(eom: EquationsOfMotion, found: EquilibriumSet) -> str:
    """Reactions as formulas, and their values in every equilibrium."""
    text = "".join(equation(name, sm.together(e)) for name, e in eom.reactions.items())
    if not len(found):
        return text
    head = ("reaction", *(f"equilibrium {i}" for i in range(1, len(found) + 1)))
    values = {name: [_reaction_value(eom, name, e) for e in found] for name in eom.reactions}
    largest = max((abs(x) for row in values.values() for x in row if x is not None), default=0.0)
    rows = []
    for name, row in values.items():
        shown = ["–" if x is None else number(0.0 if abs(x) < 1e-9 * largest else x) for x in row]
        rows.append((formula(name), *shown))
    return text + table("Values in the equilibria [N, N m]", head, rows, right=range(1, len(head)))


def _reaction_value(eom: EquationsOfMotion, name: sm.Symbol, at: Any) -> float | None:
    """A reaction in an equilibrium; where its formula is 0/0, the value on both sides where they agree."""
    here = _evaluate(eom, name, at, at.q)
    if here is not None:
        return here
    moved = [_evaluate(eom, name, at, at.q + step) for step in (1e-5, -1e-5)]
    if None in moved or abs(moved[0] - moved[1]) > 1e-3 * max(1e-6, *map(abs, moved)):
        return None
    return float(f"{0.5 * (moved[0] + moved[1]):.4g}")


def _evaluate(eom: EquationsOfMotion, name: sm.Symbol, at: Any, q: np.ndarray) -> float | None:
    """Value of a reaction at a state, with the accelerations that the equations of motion give there."""
    from engdyn.modeling.numbers import input_values, parameter_values

    t = dynamicsymbols._t
    try:
        udot = eom.accelerations(q, at.speeds, at.values, at.inputs)
    except EngdynError:
        return None
    known: dict[Any, float] = dict(zip(eom.parameters, parameter_values(eom, at.values), strict=True))
    inputs = iter(input_values(eom, at.inputs, at.values))
    known |= {sm.Derivative(w, (t, k)) if k else w: next(inputs) for w in eom.inputs for k in (0, 1, 2)}
    for u, speed, acceleration in zip(eom.speeds, at.speeds, udot, strict=True):
        known |= {u: float(speed), u.diff(t): float(acceleration)}
    known |= dict(zip(eom.coordinates, map(float, q), strict=True))
    value = eom.reactions[name].xreplace({**known, t: 0.0})
    for parameter in value.free_symbols:  # of reactions alone, absent from the equations of motion
        value = value.xreplace({parameter: at.values.get(parameter.name, sm.nan)})
    value = value.xreplace({f: 0 for f in value.atoms(sm.Derivative, sm.Function) if f.has(t)})
    return float(value) if value.is_number and value.is_finite else None


def equilibrium_table(system: System, found: EquilibriumSet, verdicts: Sequence[Stability]) -> str:
    """All equilibria and steady motions with their stability, and whether they are provably all."""
    claim = repr(found).splitlines()[0]
    mark = " good" if found.certified and not found.explanation else ""
    text = f'<div class="verdict{mark}"><strong>{html.escape(claim[0].upper() + claim[1:])}.</strong>'
    text += f"<div>{_certificate(found)}</div></div>"
    if not len(found):
        return text
    head = ["", *(formula(c.symbol) + f" [{unit(c.unit)}]" for c in system.coordinates)]
    moving = [
        (i, k) for k in (1, 2) for i in range(len(found[0].speeds)) if any(_motion(e, k)[i] for e in found)
    ]
    speeds = system.equations.speeds
    head += [formula(speeds[i] if k == 1 else speeds[i].diff(dynamicsymbols._t)) for i, k in moving]
    rows = []
    for i, (e, verdict) in enumerate(zip(found, verdicts, strict=True), 1):
        places = [_place(x, c) for x, c in zip(e.q, system.coordinates, strict=True)]
        motion = [number(float(_motion(e, k)[j])) for j, k in moving]
        rows.append((str(i), *places, *motion, f"{e.residual:.0e}" if e.residual else "0", _judged(verdict)))
    head += ["residual", "stability"]
    text += table("", head, rows, right=range(1, len(head) - 1))
    if found.neutral:
        named = ", ".join(found.neutral)
        text += paragraph(f"Nothing depends on {named}: every value of it is an equilibrium; reported as 0.")
    return text


def _certificate(found: EquilibriumSet) -> str:
    certificate = found.certificate
    if certificate is None:
        return "The equations were solved in closed form."
    boxes = (
        f"{len(certificate.accepted)} boxes hold exactly one root each, {len(certificate.rejected)} hold none"
    )
    return f"Interval arithmetic on the whole region: {boxes}, {len(certificate.undecided)} are undecided."


def _motion(e: Any, order: int) -> np.ndarray:
    return e.speeds if order == 1 else e.accelerations


def _place(x: float, coordinate: Any) -> str:
    if coordinate.unit != "rad" or abs(x) < 1e-12:
        return number(float(x))
    return f"{number(float(x))} ({number(round(math.degrees(x), 2))}°)"


def _judged(verdict: Stability) -> str:
    neutral = f" + {verdict.neutral} zero eigenvalue{'s' * (verdict.neutral > 1)}" if verdict.neutral else ""
    mark = "stable" if verdict.stable else ("unstable" if "unstable" in verdict.verdict else "")
    return f'<span class="{mark}">{verdict.verdict}</span>{neutral}'


def eigenvalue_tables(verdicts: Sequence[Stability]) -> str:
    """Eigenvalues of small motion about every equilibrium, with frequency and damping ratio."""
    text = ""
    for i, verdict in enumerate(verdicts, 1):
        rows = []
        for value, error in zip(verdict.eigenvalues, 10 * verdict.errors, strict=True):
            real, imaginary = (0.0 if abs(x) <= error else float(x) for x in (value.real, value.imag))
            if imaginary < 0:
                continue
            size = abs(complex(real, imaginary))
            oscillates = imaginary > 0
            shown = number(real) if not oscillates else f"{number(real)} ± {number(imaginary)} i"
            frequency = number(size / (2 * np.pi)) if oscillates else "–"
            rows.append((shown, frequency, number(-real / size) if oscillates else "–", _times(real)))
        head = ("eigenvalue [1/s]", "frequency [Hz]", "damping ratio", "time to halve or double [s]")
        text += f"<h3>Equilibrium {i}: {_judged(verdict)}</h3>{table('', head, rows, right=range(4))}"
    return text


def _times(real: float) -> str:
    return "–" if real == 0 else number(float(np.log(2) / abs(real)))
