"""Outputs of small motion: what is observed, linearized exactly as the equations are; other speeds.

A spring force, the motion of a point or what an accelerometer reads is y(q, q̇, q̈, inputs); for small deviations
y = Y₀ q + Y₁ u + Y₂ u̇ + D₀ w + D₁ ẇ + D₂ ẅ.  Course sections 5.3 and 7.1.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np
import sympy as sm
from sympy.physics.vector import dynamicsymbols

from engdyn.algebra.conversion import Converter
from engdyn.algebra.expressions import as_expression
from engdyn.algebra.scan import derivative_key, independent_atoms
from engdyn.analysis.slopes import Products, compile_products, slopes
from engdyn.analysis.small_motion import motion_keys
from engdyn.errors import EngdynError
from engdyn.modeling.equations import EquationsOfMotion
from engdyn.modeling.numbers import input_values

if TYPE_CHECKING:
    from engdyn.analysis.linear import LinearSystem

__all__ = ["numeric_outputs", "output_slopes", "with_speeds"]

Key = tuple[Any, ...]


def output_slopes(eom: EquationsOfMotion, outputs: Mapping[str, Any]) -> list[list[list[Products]]]:
    """Exact slopes of the outputs with respect to q, u, u̇, w, ẇ and ẅ, one row for each output.

    Parameters
    ----------
    eom : EquationsOfMotion
    outputs : mapping of str to sympy.Expr
        In coordinates, speeds, accelerations, inputs, parameters; rates that constraints fix are replaced.

    Raises
    ------
    EngdynError
        Names that are taken, no expressions, or expressions in what the equations do not know.
    """
    names = {f.func.__name__ for f in (*eom.coordinates, *eom.inputs)}
    if not isinstance(outputs, Mapping) or any(not isinstance(k, str) or k in names for k in outputs):
        raise EngdynError(
            f"outputs is {outputs!r}: give a mapping of names, other than those of coordinates and inputs, to "
            "expressions"
        )
    expressions = [as_expression(e, f"the output {name}") for name, e in outputs.items()]
    q_keys, u_keys, a_keys = motion_keys(eom)
    fixed: dict[Key, sm.Expr] = {}
    for (kind, q, _), rate in zip(q_keys, eom.kinematics, strict=True):
        if (kind, q, 1) not in u_keys:
            fixed |= {(kind, q, 1): rate, (kind, q, 2): rate.diff(dynamicsymbols._t)}
    inputs = [[("function", w, k) for w in eom.inputs] for k in (0, 1, 2)]
    known = {*q_keys, *u_keys, *a_keys, *fixed, *(key for keys in inputs for key in keys)}
    for name, expression in zip(outputs, expressions, strict=True):
        strange = [a for a in independent_atoms(expression) if (derivative_key(a) or a) not in known]
        if strange := [str(a) for a in strange if derivative_key(a)]:
            raise EngdynError(
                f"the output {name} contains {', '.join(strange)}: the equations know the coordinates with two "
                f"derivatives and the inputs {', '.join(w.func.__name__ for w in eom.inputs) or '(none)'}"
            )
    converter = Converter(expressions, [*a_keys, *u_keys, *q_keys], fixed)
    rows = [converter.convert(e) for e in expressions]
    return [[slopes(converter.ring, row, keys) for row in rows] for keys in (q_keys, u_keys, a_keys, *inputs)]


def numeric_outputs(
    eom: EquationsOfMotion,
    outputs: Mapping[str, Any],
    state: Sequence[Any],
    values: Mapping[str, float],
    given: Mapping[str, Any],
    moments: Sequence[float],
) -> tuple[np.ndarray, ...]:
    """(Y₀, Y₁, Y₂, D₀, D₁, D₂) as arrays, the same at all the given times [s]."""
    groups = output_slopes(eom, outputs)
    t = dynamicsymbols._t
    found = {s for e in outputs.values() for s in as_expression(e).free_symbols} | {*eom.parameters}
    symbols = sorted(found - {t}, key=lambda s: s.name)
    if missing := [s.name for s in symbols if s.name not in values]:
        raise EngdynError(
            f"values lacks the parameters {', '.join(missing)} of the outputs: give each a number"
        )
    keys = [key for part in motion_keys(eom) for key in part] + [("symbol", s) for s in symbols]
    keys += [("function", w, k) for w in eom.inputs for k in (0, 1, 2)] + [("symbol", t)]
    function = compile_products([e for rows in groups for row in rows for e in row], keys, "math")
    numbers = [*(float(x) for x in state), *(float(values[s.name]) for s in symbols)]

    def at(moment: float) -> np.ndarray:
        try:
            flat = function(*numbers, *input_values(eom, given, values, moment), moment)
        except (ArithmeticError, ValueError):  # of Python's own mathematical functions
            flat = (np.nan,)
        return np.array(flat, dtype=float)

    flat = _steady(at, moments)
    widths = [len(rows[0]) if rows else 0 for rows in groups]
    ends = np.cumsum([len(outputs) * width for width in widths])
    return tuple(
        part.reshape(len(outputs), width)
        for part, width in zip(np.split(flat, ends[:-1]), widths, strict=True)
    )


def _steady(at: Callable[[float], np.ndarray], moments: Sequence[float]) -> np.ndarray:
    """Slopes that are finite and the same at all moments."""
    flat = at(moments[0])
    if not np.all(np.isfinite(flat)):
        raise EngdynError("the outputs have no derivatives there: a root or a quotient is not finite")
    least = 1e-13 * np.max(np.abs(flat), initial=0.0)
    if any(
        np.any(np.abs((now := at(m)) - flat) > 1e-9 * (np.abs(now) + np.abs(flat)) + least) for m in moments
    ):
        raise EngdynError(
            "the linearized outputs depend on time: choose outputs that are steady in these coordinates, or equations "
            "in axes in which they are"
        )
    return flat


def with_speeds(linear: LinearSystem, speeds: Sequence[Any]) -> LinearSystem:
    """The same small motion with the rates of other coordinates as speeds.

    Parameters
    ----------
    linear : LinearSystem
    speeds : sequence of str or of time derivatives of coordinates
        As many as there are; their rates must be independent.

    Raises
    ------
    EngdynError
        Unknown coordinates, another number, rates that depend on each other.
    """
    n, names = len(linear.coordinates), linear.coordinates
    wanted = [
        s if isinstance(s, str) else getattr(getattr(s, "expr", s), "func", type(s)).__name__ for s in speeds
    ]
    m = linear.mass.shape[0]
    if len(wanted) != m or not set(wanted) <= set(names):
        raise EngdynError(f"speeds names {wanted}: choose the rates of {m} of {', '.join(names)}")
    rows = [names.index(name) for name in wanted]
    Gq, G = linear.state_matrix[:n, :n], linear.state_matrix[:n, n:]
    Fv, Gv = Gq[rows, :], G[rows, :]
    try:
        S = np.linalg.inv(Gv) if isinstance(G, np.ndarray) else Gv.inv()
    except (np.linalg.LinAlgError, sm.matrices.exceptions.NonInvertibleMatrixError) as error:
        raise EngdynError(f"the rates of {', '.join(wanted)} are not independent: choose others") from error
    # v = Fv q + Gv u, so u = S v − N q and u̇ = S v̇ − N (Gq q + G u); rows are projected as motions are
    N, T = S @ Fv, S.T
    C = linear.damping - linear.mass @ N @ G
    K = linear.stiffness - linear.mass @ N @ Gq
    stack = np.block if isinstance(G, np.ndarray) else sm.Matrix
    eye, none = (np.eye(n), np.zeros((n, m))) if isinstance(G, np.ndarray) else (sm.eye(n), sm.zeros(n, m))
    back, forth = stack([[eye, none], [-N, S]]), stack([[eye, none], [Fv, Gv]])
    outputs = linear.output_matrices
    if outputs:
        Y0, Y1, Y2, *D = outputs
        Yu = Y1 - Y2 @ N @ G
        outputs = (Y0 - Y2 @ N @ Gq - Yu @ N, Yu @ S, Y2 @ S, *D)
    return replace(
        linear,
        mass=T @ linear.mass @ S,
        damping=T @ C @ S,
        stiffness=T @ (K - C @ N),
        input_matrices=tuple(T @ B for B in linear.input_matrices),
        state_matrix=forth @ linear.state_matrix @ back,
        output_matrices=outputs,
    )
