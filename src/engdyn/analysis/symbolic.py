"""Linearized equations with the parameters as symbols.  Course section 5.3."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from numbers import Number
from typing import Any

import sympy as sm
from sympy.physics.vector import dynamicsymbols

from engdyn.algebra.expressions import as_expression
from engdyn.algebra.readable import to_sympy, tree
from engdyn.analysis.outputs import output_slopes
from engdyn.analysis.slopes import Products
from engdyn.analysis.small_motion import BLOCKS, block_shapes, motion_keys, small_motion
from engdyn.errors import EngdynError
from engdyn.modeling.equations import EquationsOfMotion

__all__ = ["symbolic_matrices", "symbolic_outputs"]


def symbolic_matrices(eom: EquationsOfMotion, state: list[Any], given: Mapping[str, Any]) -> tuple:
    """M, C, K, (B₀, B₁, B₂), A, and the inputs whose matrices depend on time.

    Parameters
    ----------
    eom : EquationsOfMotion
    state : list
        q, u and u̇ as numbers or expressions.
    given : mapping
        Inputs by name; defaults where not given.

    Raises
    ------
    EngdynError
        Text in place of a quantity, unknown inputs, coefficients that depend on time.
    """
    t, place = dynamicsymbols._t, _place(eom, state, given)

    def matrix(name: str) -> sm.Matrix:
        rows = small_motion(eom)[name]
        return sm.Matrix(*block_shapes(eom)[name], [_written(e, place) for row in rows for e in row])

    blocks = {name: matrix(name) for name in BLOCKS}
    left = [e for name, block in blocks.items() if name[0] != "B" for e in block if e.has(t)]
    if left:
        raise EngdynError(
            f"linearized coefficients depend on time: {left[0]}; linearize about a steady motion"
        )
    forces = [-blocks[name] for name in ("B0", "B1", "B2")]
    columns = [(w, force[:, j]) for force in forces for j, w in enumerate(eom.inputs)]
    changing = {w.func.__name__ for w, column in columns if column.has(t)}
    inverse = blocks["M"].LUsolve(blocks["K"].row_join(blocks["C"]))
    state_matrix = blocks["Gq"].row_join(blocks["G"]).col_join(-inverse)
    return blocks["M"], blocks["C"], blocks["K"], tuple(forces), state_matrix, tuple(sorted(changing))


def symbolic_outputs(
    eom: EquationsOfMotion, outputs: Mapping[str, Any], state: list[Any], given: Mapping[str, Any]
) -> tuple[sm.Matrix, ...]:
    """Output matrices on q, u, u̇ and value, rate and acceleration of the inputs."""
    place, widths = _place(eom, state, given), [len(keys) for keys in motion_keys(eom)]
    found = []
    for rows, width in zip(output_slopes(eom, outputs), [*widths, *[len(eom.inputs)] * 3], strict=True):
        found.append(sm.Matrix(len(outputs), width, [_written(e, place) for row in rows for e in row]))
        if found[-1].has(dynamicsymbols._t):
            raise EngdynError("the linearized outputs depend on time: choose outputs that are steady there")
    return tuple(found)


def _place(eom: EquationsOfMotion, state: list[Any], given: Mapping[str, Any]) -> dict[sm.Expr, sm.Expr]:
    """What stands for coordinates, speeds, accelerations and inputs, highest derivatives first."""
    t = dynamicsymbols._t
    replaced: dict[sm.Expr, sm.Expr] = {}
    for key, value in zip([key for part in motion_keys(eom) for key in part], state, strict=True):
        replaced[key[1] if key[2] == 0 else sm.Derivative(key[1], (t, key[2]))] = _expression(value)
    _check_inputs(eom, given)
    for w in eom.inputs:
        triple = given.get(w.func.__name__, eom.defaults.get(w, 0))
        triple = triple if isinstance(triple, Sequence) else (triple, 0, 0)
        for k, value in enumerate(triple):
            replaced[sm.Derivative(w, (t, k)) if k else w] = _expression(value)
    ordered = sorted(replaced, key=lambda e: -e.derivative_count if e.is_Derivative else 0)
    return {key: replaced[key] for key in ordered}


def _written(products: Products, place: Mapping[sm.Expr, sm.Expr]) -> sm.Expr:
    """A sum of products as an expression at a place."""
    total = sm.Add(*(sm.Mul(*(to_sympy(tree(factor)) for factor in product)) for product in products))
    return sm.factor_terms(total.xreplace(place))


def _check_inputs(eom: EquationsOfMotion, given: Mapping[str, Any]) -> None:
    known = [w.func.__name__ for w in eom.inputs]
    for name in given:
        if name not in known:
            raise EngdynError(f"unknown input {name!r}: the equations have {', '.join(known) or 'none'}")


def _expression(value: Any) -> sm.Expr:
    """A number or an expression, never text."""
    if isinstance(value, Number | sm.Expr) and not as_expression(value).has(sm.nan, sm.oo, -sm.oo, sm.zoo):
        return as_expression(value)
    raise EngdynError(f"{value!r} is not a quantity: give a finite number or a sympy expression")
