"""The matrices of small motion in a report, as MathML."""

from __future__ import annotations

import html
from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from engdyn.analysis.linear import LinearSystem
from engdyn.analysis.stability import Stability
from engdyn.course.mathml import formula
from engdyn.course.report_tables import number

__all__ = ["matrix", "small_motion"]

RATES = "".join(
    f'<mi>{name}</mi><mover accent="true"><mi>ξ</mi><mo>{dots}</mo></mover><mo>+</mo>'
    for name, dots in (("M", "¨"), ("C", "˙"))
)
LAW = (
    '<math alttext="M \\ddot{\\xi} + C \\dot{\\xi} + K \\xi = 0">'
    f"{RATES}<mi>K</mi><mi>ξ</mi><mo>=</mo><mn>0</mn></math>"
)


def small_motion(linear: Sequence[LinearSystem], judged: Sequence[Stability]) -> str:
    """The linear equations about the first stable equilibrium, else about the first.  Course section 5.3.

    Parameters
    ----------
    linear : sequence of LinearSystem
        With numbers, one for each equilibrium.
    judged : sequence of Stability
        In the same order.
    """
    if not linear:
        return ""
    chosen = next((i for i, verdict in enumerate(judged) if verdict.stable), 0)
    which = "the first that is asymptotically stable" if judged[chosen].stable else "none is stable"
    system = linear[chosen]
    order = ", ".join(formula(q) for q in system.eom.coordinates)
    named = (("M", system.mass), ("C", system.damping), ("K", system.stiffness))
    shown = " ".join(matrix(name, entries) for name, entries in named)
    deviations = f'<math alttext="\\xi"><mi>ξ</mi></math> of ({order})'
    return (
        f"<p>Small deviations {deviations} from equilibrium {chosen + 1} ({which}) obey {LAW} with, in SI "
        f'units,</p><div class="matrices">{shown}</div>'
    )


def matrix(name: str, entries: ArrayLike) -> str:
    """A matrix of numbers with its name; what is zero but for rounding is 0.

    Parameters
    ----------
    name : str
    entries : array_like, shape (m, n)
    """
    entries = np.atleast_2d(np.asarray(entries, float))
    small = 1e-12 * np.max(np.abs(entries), initial=0.0)
    texts = [[number(x if abs(x) > small else 0.0) for x in row] for row in entries]
    rows = "".join(
        "<mtr>" + "".join(f"<mtd><mn>{text}</mn></mtd>" for text in row) + "</mtr>" for row in texts
    )
    words = html.escape(f"{name} = [{'; '.join(', '.join(row) for row in texts)}]")
    body = f"<mi>{html.escape(name)}</mi><mo>=</mo><mtable>{rows}</mtable>"
    return f'<math alttext="{words}" class="matrix">{body}</math>'
