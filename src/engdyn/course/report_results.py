"""What a report says of the results: reactions, equilibria, stability, as HTML."""

from __future__ import annotations

import html
import math
from collections.abc import Sequence
from typing import Any

import numpy as np
import sympy as sm
from sympy.physics.vector import dynamicsymbols

from engdyn.analysis.results import EquilibriumSet
from engdyn.analysis.stability import Stability
from engdyn.course.mathml import equation, formula
from engdyn.course.report_tables import number, paragraph, table, unit
from engdyn.errors import EngdynError
from engdyn.modeling.equations import EquationsOfMotion
from engdyn.modeling.numbers import input_values, parameter_values
from engdyn.system import System

__all__ = ["eigenvalue_tables", "equilibrium_table", "reactions"]


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
    single, empty, open_boxes = map(len, (certificate.accepted, certificate.rejected, certificate.undecided))
    each = "each of " if single > 1 else ""
    text = f"Interval arithmetic on the whole region: exactly one root in {each}{_boxes(single)}, "
    text += f"none in {_boxes(empty)}, {_boxes(open_boxes)} undecided."
    if single > len(certificate.roots):
        text += " A root on the seam of a whole turn lies in a box at either end."
    return text


def _boxes(count: int) -> str:
    return "1 box" if count == 1 else f"{count or 'no'} boxes"


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
