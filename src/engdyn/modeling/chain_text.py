"""A kinematic chain as a table to read in a notebook: step by step, as course section 1.2 asks."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape
from typing import TYPE_CHECKING

import sympy as sm
from sympy.physics.vector.printing import vlatex

if TYPE_CHECKING:
    from engdyn.modeling.chain_steps import ChainStep, Steps

__all__ = ["as_html", "count_in_words"]


def count_in_words(chain: Steps) -> str:
    """The count of the degrees of freedom, for example ``2 coordinates - 0 constraints = 2``."""
    n, free = len(chain.coordinates), chain.degrees_of_freedom
    independent = n - free
    extra = len(chain.constraints) - independent
    note = f" (of {len(chain.constraints)}, {extra} dependent)" if extra else ""
    return f"{_plural(n, 'coordinate')} - {_plural(independent, 'constraint')}{note} = {free}"


def as_html(chain: Steps) -> str:
    """The steps of a chain, and the count of its degrees of freedom, as an HTML table."""
    rows = "".join(
        f"<tr>{_left(str(number), escape(step.kind), _definition(step, chain), escape(step.meaning))}</tr>"
        for number, step in enumerate(chain.steps, start=1)
    )
    coordinates = _listed(chain.coordinates) or "none"
    given = f"; prescribed: {_listed(chain.prescribed)}" if chain.prescribed else ""
    return (
        f"<table><thead><tr>{_left('step', 'kind', 'definition', 'meaning', tag='th')}</tr></thead>"
        f"<tbody>{rows}</tbody></table>"
        f"<p>Coordinates: {coordinates}{given}. "
        f"Degrees of freedom: {escape(count_in_words(chain))}.</p>"
    )


def _left(*cells: str, tag: str = "td") -> str:
    """Cells of a table of words: JupyterLab would set them flush right."""
    return "".join(f'<{tag} style="text-align:left">{cell}</{tag}>' for cell in cells)


def _definition(step: ChainStep, chain: Steps) -> str:
    value = vlatex(step.vector) if step.vector != 0 else "0"
    if step.kind == "frame":
        return rf"$\boldsymbol{{\omega}}_{{{step.name}/{step.start}}} = {value}$"
    if step.kind == "point":
        return rf"$\mathbf{{r}}_{{{step.start}{step.name}}} = {value}$"
    if step.kind == "constraint":
        return f"${value} = 0$"
    return rf"${step.name}$, $\mathbf{{v}}_{{{step.name}}} = {value}$ in ${chain.ground}$"


def _plural(count: int, noun: str) -> str:
    return f"{count} {noun}{'' if count == 1 else 's'}"


def _listed(coordinates: Sequence[sm.Expr]) -> str:
    return ", ".join(f"${vlatex(q)}$" for q in coordinates)
