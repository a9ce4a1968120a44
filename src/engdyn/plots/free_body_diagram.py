"""Free-body diagrams: one body, cut free, with every load that acts on it (course section 2.4)."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
import sympy as sm
from matplotlib.axes import Axes
from numpy.typing import NDArray
from sympy.core.function import AppliedUndef
from sympy.physics.mechanics import Force
from sympy.physics.vector import ReferenceFrame, Vector, dynamicsymbols
from sympy.physics.vector.printing import VectorLatexPrinter

from engdyn import shapes as sh
from engdyn.errors import EngdynError
from engdyn.modeling.free_body import FreeBody, arm_of, load_vector
from engdyn.modeling.kinematics import key_name
from engdyn.modeling.state import State
from engdyn.plots.drawing import sketch
from engdyn.plots.outlines import outline_of
from engdyn.plots.projection import View

__all__ = ["free_body"]

LONGEST = 46
"""A formula whose LaTeX is longer does not fit beside an arrow: the load gets a letter, the words its formula."""

ARROW = 0.75
"""Length of an arrow in units of the size of the body: on a free-body diagram only directions count."""


@dataclass(frozen=True)
class _Arrow:
    """One component of a load: where, in which direction, what is written at it."""

    point: NDArray[np.float64]
    direction: NDArray[np.float64]
    label: str
    role: str
    turns: bool


def free_body(
    body: FreeBody,
    values: Mapping[Any, float] | None = None,
    ax: Axes | None = None,
    *,
    frame: ReferenceFrame | None = None,
    outline: Iterable[sh.Shape] | None = None,
    view: View | None = None,
) -> Axes:
    """Draw a free-body diagram: the body, the loads on it, and what they are called.

    All arrows are equally long: a diagram shows where loads act and which sense is counted positive.
    Applied loads and reactions differ in color.

    Parameters
    ----------
    body : FreeBody
    values : mapping, optional
        Symbols, coordinates or their names → numbers [SI], for the geometry; what is not given is 0.45 rad
        inside sines and cosines and 1 elsewhere; time is 0.
    ax : matplotlib.axes.Axes, optional
        Where to draw; default: new axes of a new figure.
    frame : ReferenceFrame, optional
        The frame that stands upright in the picture; default: the one that was made first.
    outline : iterable of Shape, optional
        The body, in meters from its mass center, along the axes of `frame`; default: a bar, a polygon or a
        disc through the points where forces act.
    view : View, optional
        From where a diagram in space is seen.

    Returns
    -------
    matplotlib.axes.Axes

    Raises
    ------
    EngdynError
        Not a FreeBody, a load on a point that is not placed, values that are not numbers.

    Notes
    -----
    Course section 2.4.
    """
    if not isinstance(body, FreeBody):
        raise EngdynError(f"{body!r} is no FreeBody: make one with engdyn.FreeBody(body, applied, reactions)")
    frame = _upright(body) if frame is None else frame
    arrows, legend = _arrows(body, frame, values or {})
    points = np.array([np.zeros(3), *(a.point for a in arrows)])
    planar = not np.any(abs(points[:, 2]) > 1e-9) and all(_in_plane(a) for a in arrows)
    size = float(np.max(np.linalg.norm(points, axis=1))) or 1.0
    drawn = list(outline_of(body, points, size, planar)) if outline is None else list(outline)
    aside = (view or View()).axes[0]
    loads = list(_placed(arrows, size, planar, aside))
    drawn += [*loads, _axes_of(loads, size, planar)]
    return sketch(drawn, _words(body, arrows, legend), ax, view=view)


def _upright(body: FreeBody) -> ReferenceFrame:
    """The oldest frame that is connected with the frames of the loads: the ground, as models are written."""
    frames = [f for vector in body.vectors() for _, f in vector.args] or [_frame_of(body)]
    seen, waiting = set(frames), list(frames)
    while waiting:
        for other in waiting.pop()._dcm_dict:
            if other not in seen:
                seen.add(other)
                waiting.append(other)
    return min((f for f in seen if f is not None), key=lambda f: f.index)


def _frame_of(body: FreeBody) -> ReferenceFrame:
    if not body.turns:
        raise EngdynError(f"the particle {body.name} carries no load: give frame=, the frame of the picture")
    return body.body.frame


def _arrows(
    body: FreeBody, frame: ReferenceFrame, values: Mapping[Any, float]
) -> tuple[list[_Arrow], dict[str, str]]:
    """One arrow for every component of every load, and the formulas that were too long to be written."""
    numbers = _Numbers(frame, values)
    legend: dict[str, str] = {}
    found = []
    for role, loads in (("force", body.applied), ("reaction", body.reactions)):
        for load in loads:
            turns = not isinstance(load, Force)
            point = np.zeros(3) if turns else numbers.vector(arm_of(load, body))
            for label, direction in _components(load_vector(load), numbers, legend, turns):
                found.append(_Arrow(point, direction, label, role, turns))
    return found, legend


def _components(
    vector: Vector, numbers: _Numbers, legend: dict[str, str], turns: bool
) -> Iterator[tuple[str, NDArray[np.float64]]]:
    """Label and unit direction of each component along a unit vector; one arrow where formulas are long."""
    parts = [(m, axis) for matrix, f in vector.args for m, axis in zip(matrix, (f.x, f.y, f.z), strict=True)]
    parts = [(m, axis) for m, axis in parts if m != 0]
    whole = numbers.vector(vector)
    length = float(np.linalg.norm(whole))
    if len(parts) > 1 and (magnitude := _magnitude([m for m, _ in parts])) is not None:
        positive = numbers.number(magnitude) >= 0
        yield f"${_text(magnitude)}$", whole / length if positive else -whole / length
        return
    letter = f"{'M' if turns else 'F'}_{{{len(legend) + 1}}}"
    if len(parts) > 1 and any(len(_text(m)) > LONGEST for m, _ in parts):
        legend[letter] = str(vector)
        yield rf"$\mathbf{{{letter}}}$", whole / length if length > 1e-12 else np.eye(3)[0]
        return
    for measure, axis in parts:
        negative = measure.could_extract_minus_sign()
        measure, direction = -measure if negative else measure, numbers.vector(axis)
        label = _text(measure)
        if len(label) > LONGEST:
            label = letter
            legend[letter] = str(measure)
        yield f"${label}$", -direction if negative else direction


def _magnitude(measures: list[sm.Expr]) -> sm.Expr | None:
    """The symbol T of components such as T sin θ and T cos θ, which together are one arrow."""
    for symbol in sorted(measures[0].free_symbols, key=str):
        shares = [m / symbol for m in measures]
        if not any(share.has(symbol) for share in shares):
            square = sum(share**2 for share in shares) - 1
            if State((), [square]).convert(square).is_zero():
                return symbol
    return None


def _text(measure: sm.Expr) -> str:
    """A formula in mathtext; the weight reads m g, as everybody writes it."""
    g = next((s for s in measure.free_symbols if s.name == "g"), None) if measure.is_Mul else None
    if g is not None and not (rest := measure / g).has(g) and rest.is_number is False:
        return rf"{_text(rest)}\,g"
    return _Printer({"mul_symbol": r"\,", "fold_short_frac": True}).doprint(measure)


class _Printer(VectorLatexPrinter):
    """Sums begin with a term that has no minus sign: r - l_0 and not -l_0 + r."""

    def _as_ordered_terms(self, expr: sm.Expr, order: Any = None) -> list[sm.Expr]:
        return sorted(super()._as_ordered_terms(expr, order), key=lambda t: t.could_extract_minus_sign())


class _Numbers:
    """Components of vectors along the axes of the picture."""

    def __init__(self, frame: ReferenceFrame, values: Mapping[Any, float]):
        self.frame = frame
        self.values = {key_name(key): value for key, value in values.items()}

    def vector(self, vector: Vector) -> NDArray[np.float64]:
        try:
            components = vector.to_matrix(self.frame)
        except ValueError as error:
            raise EngdynError(
                f"{vector} is not oriented with respect to {self.frame}: orient its frame"
            ) from error
        return np.array([self.number(c) for c in components])

    def number(self, component: sm.Expr) -> float:
        """A scalar with numbers for everything in it."""
        turning = {
            a for f in component.atoms(sm.sin, sm.cos, sm.tan) for a in f.free_symbols | f.atoms(AppliedUndef)
        }
        rates = sorted(component.atoms(sm.Derivative), key=lambda d: -d.derivative_count)
        for atom in (*rates, *component.atoms(AppliedUndef), *component.atoms(sm.Symbol)):
            usual = 0.0 if atom == dynamicsymbols._t else 0.45 if atom in turning else 1.0
            value = self.values.get(key_name(atom), usual)
            component = component.xreplace({atom: _finite(value, key_name(atom))})
        try:
            return float(component)
        except TypeError as error:
            raise EngdynError(
                f"the component {component} of a load has no real value here: give values"
            ) from error


def _finite(value: Any, name: str) -> sm.Float:
    try:
        number = float(value)
    except (TypeError, ValueError):
        number = math.nan
    if not math.isfinite(number):
        raise EngdynError(f"values: {name} = {value!r} is not a finite number")
    return sm.Float(number)


def _in_plane(arrow: _Arrow) -> bool:
    x, y, z = abs(arrow.direction)
    return bool(max(x, y) < 1e-9) if arrow.turns else bool(z < 1e-9)


def _placed(arrows: list[_Arrow], size: float, planar: bool, aside: NDArray) -> Iterator[sh.Shape]:
    """The arrows as shapes: no two on top of each other, none hidden in the body where it can be avoided."""
    taken: list[tuple[NDArray, NDArray]] = []
    couples = 0
    for arrow in arrows:
        if arrow.turns and planar:
            radius, sense = (0.3 + 0.13 * couples) * size, math.copysign(1.0, arrow.direction[2])
            start = 2.3 if sense > 0 else 0.8
            couples += 1
            yield sh.MomentArrow((0.0, 0.0), radius, start, start + 1.9 * sense, arrow.label, role=arrow.role)
            continue
        way = ARROW * size * arrow.direction
        outward = way if way @ arrow.point >= -1e-9 * size else -way
        # Along the way out of the body if nothing is there, else on the other side of the point, else beside.
        side = next((w for w in (outward, -outward) if not _met(taken, arrow.point, w)), None)
        shift = np.zeros(3)
        if side is None:
            across = np.array([-arrow.direction[1], arrow.direction[0], 0.0]) if planar else aside
            side, shift = outward, 0.16 * size * across
        taken.append((arrow.point, side))
        foot = arrow.point + shift
        start, end = (foot, foot + way) if side @ way > 0 else (foot - way, foot)
        cut = 2 if planar else 3
        yield sh.VectorArrow(tuple(start[:cut]), tuple(end[:cut]), arrow.label, arrow.turns, role=arrow.role)


def _met(taken: list[tuple[NDArray, NDArray]], point: NDArray, way: NDArray) -> bool:
    """Whether an arrow that leaves the same point lies within 15 degrees of this one."""
    near = 0.1 * np.linalg.norm(way)
    limit = 0.966 * float(way @ way)
    return any(np.linalg.norm(point - p) < near and way @ w > limit for p, w in taken)


def _axes_of(loads: list[sh.Shape], size: float, planar: bool) -> sh.Triad:
    """The axes of the picture, to the left of all loads."""
    ends = [p[0] for load in loads if isinstance(load, sh.VectorArrow) for p in (load.start, load.end)]
    left = min([-size, *ends]) - 0.6 * size
    labels = tuple(f"${name}$" for name in "XYZ")
    if planar:
        return sh.Triad((left, -size), labels=labels[:2], length=0.35 * size)
    axes = tuple(tuple(axis) for axis in np.eye(3))
    return sh.Triad((left, 0.0, -size), axes, labels, 0.35 * size)


def _words(body: FreeBody, arrows: list[_Arrow], legend: Mapping[str, str]) -> str:
    told = []
    for kind, role in (("applied", "force"), ("reaction", "reaction")):
        some = [a.label.strip("$") for a in arrows if a.role == role]
        told.append(f"{kind} loads: {', '.join(some) or 'none'}")
    formulas = "".join(f" {letter} is {formula}." for letter, formula in legend.items())
    return f"Free-body diagram of {body.name}; {'; '.join(told)}.{formulas}"
