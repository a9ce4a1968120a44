"""The whole sequence on one system, as one HTML file that needs nothing else: ``engdyn analyze KEY``."""

from __future__ import annotations

import html
from collections.abc import Callable
from pathlib import Path
from typing import Any

import engdyn
from engdyn.analysis.linear import linearize
from engdyn.analysis.results import EquilibriumSet
from engdyn.analysis.stability import Stability, stability
from engdyn.course import report_model as model
from engdyn.course import report_pictures as pictures
from engdyn.course import report_results as results
from engdyn.course.report_matrices import small_motion
from engdyn.course.report_page import checked_target, page, write_text
from engdyn.course.report_tables import paragraph
from engdyn.errors import EngdynError
from engdyn.modeling.equality import Proof, prove_equal
from engdyn.system import System

__all__ = ["report", "write_report"]

Progress = Callable[[str], Any]


def write_report(
    key: str | int | System,
    out: str | Path,
    force: bool = False,
    progress: Progress | None = None,
) -> Path:
    """Take a system through the whole sequence and write one self-contained HTML file.

    Parameters
    ----------
    key : str, int or System
        ``"gantry_crane"``, ``"S07"`` or ``7``; or a system of your own.
    out : str or Path
        The file to write, in a folder that exists.
    force : bool
        Replace the file where it exists.
    progress : callable, optional
        Called with a short message before each step.

    Returns
    -------
    Path
        Where the report is.

    Raises
    ------
    UnknownSystemError
        No such system.
    EngdynError
        The file exists and `force` is not given; its folder does not exist; it is a folder.

    Notes
    -----
    All parts of the course.  Nothing is left half-written: the file appears when it is complete.
    """
    system = key if isinstance(key, System) else engdyn.systems.load(key)
    target = checked_target(out, force)
    write_text(target, report(system, progress))
    return target


def report(system: System, progress: Progress | None = None) -> str:
    """The report as HTML text; the same text for the same system, whenever it is made.

    Parameters
    ----------
    system : System
    progress : callable, optional
        Called with a short message before each step.
    """
    tell = progress or (lambda message: None)
    parts: list[tuple[str, str]] = [
        ("The system", _description(system)),
        ("Quantities", model.parameters(system)),
    ]
    tell("deriving the equations of motion")
    lagrange = system.equations
    newton = _newton(system)
    if newton is not None:
        parts.append(("Free bodies", model.free_bodies(system.free_bodies(), system.frame)))
        counted = model.balances(newton) + model.equations(newton)
        parts.append(("Equations of motion from the free bodies (Newton–Euler)", counted))
    energies = model.energies(system) + paragraph("Lagrange's equations of these energies:")
    parts.append(("Equations of motion from the energies (Lagrange)", energies + model.equations(lagrange)))
    tell("proving that both derivations agree")
    proof = prove_equal(newton, lagrange) if newton is not None else None
    if proof is not None:
        parts.append(("Are both the same?", model.proof_verdict(proof)))
    tell("looking for all equilibria")
    found = system.equilibria()
    linear = [linearize(lagrange, e) for e in found]
    judged = [stability(item) for item in linear]
    if newton is not None and newton.reactions:
        parts.append(("Reactions", results.reactions(newton, found)))
    parts.append(("Equilibria and steady motions", _equilibria(system, found, judged, tell)))
    moving = small_motion(linear, judged) + results.eigenvalue_tables(judged)
    parts.append(("Small motion and its stability", moving))
    tell("following the equilibria over a parameter")
    parts.append(("Equilibria over a parameter", _branches(system)))
    return _page(system, [part for part in parts if part[1]], proof, found, judged)


def _newton(system: System) -> Any:
    """The equations from the free bodies; None where a system has none."""
    try:
        system.free_bodies()
    except EngdynError:
        return None
    return system.newton()


def _description(system: System) -> str:
    text = paragraph(system.description) if system.description else ""
    if system.measured:
        text += paragraph(f"What one would measure: {system.measured}.", note=True)
    return text + pictures.drawing_figure(system)


def _equilibria(system: System, found: EquilibriumSet, judged: list[Stability], tell: Progress) -> str:
    text = paragraph("Parameters as in the table; inputs zero, or as the system prescribes them.")
    text += results.equilibrium_table(system, found, judged)
    tell("drawing the equilibria")
    verdicts = [each.verdict for each in judged]
    return text + pictures.poses_figure(system, found, verdicts) + pictures.potential_figure(system, found)


def _branches(system: System) -> str:
    question = pictures.branch_question(system)
    if question is None:
        return ""
    parameter, changes = question
    name = f"<code>{html.escape(parameter.name)}</code>"
    if changes:
        text = f"{name} is the first parameter that changes number or stability of the equilibria."
    else:
        text = "No parameter, between half and twice its default, changes number or stability of the "
        text += f"equilibria; shown is {name}."
    figure = pictures.branch_figure(system, parameter)
    return f"<p>{text}</p>{figure}" if figure else ""


def _page(
    system: System,
    parts: list[tuple[str, str]],
    proof: Proof | None,
    found: EquilibriumSet,
    judged: list[Stability],
) -> str:
    entries = [("degrees of freedom", str(len(system.coordinates) - len(system.constraints)))]
    if proof is not None:
        entries.append(("Newton–Euler = Lagrange", proof.verdict))
    count = f"{len(found)}{', certified to be all' if found.certified else ', not certified'}"
    entries.append(("equilibria", count))
    entries.append(("of these stable", str(sum(each.stable for each in judged))))
    label = f"S{system.number:02d} · {system.key}" if system.number else system.key
    return page(
        parts,
        title=system.title,
        label=label,
        subtitle=system.field,
        summary=entries,
        command="engdyn analyze",
    )
