"""Transfer functions as formulas, rational in s.  Course section 7.1."""

from __future__ import annotations

import sympy as sm
from sympy.polys.matrices import DomainMatrix

from engdyn.analysis.harmonic import split
from engdyn.analysis.linear import LinearSystem
from engdyn.analysis.routh import exact
from engdyn.errors import EngdynError

__all__ = ["transfer_function"]


def transfer_function(linear: LinearSystem, input: str, output: str) -> sm.Expr:
    """Transfer function H(s) of a linear system with symbols; H(iω) is the frequency response.

    Parameters
    ----------
    linear : LinearSystem
        Made with ``symbolic=True``.
    input : str
        A prescribed motion acts with its rate and acceleration: H is per unit displacement.
    output : str
        A coordinate or one of the outputs, with one prime (``x'``) for the rate, two for the acceleration.

    Returns
    -------
    sympy.Expr
        A quotient of polynomials in the symbol s without common factors.

    Raises
    ------
    EngdynError
        A system with numbers (its transfer function is `frequency_response`), unknown names, an input whose
        direction turns in these coordinates.

    Notes
    -----
    Course section 7.1. Cramer's rule: H = Y (s − A)⁻¹ L + D is the quotient of two determinants.
    """
    if not isinstance(linear, LinearSystem) or not isinstance(linear.mass, sm.MatrixBase):
        raise EngdynError("transfer_function needs a LinearSystem with symbols: linearize with symbolic=True")
    if input not in linear.inputs or input in linear.changing_inputs:
        raise EngdynError(
            f"the input is {input!r}: choose one of {', '.join(linear.inputs) or '(none)'} with a fixed direction"
        )
    name, order = split(linear, output)
    s = sm.Symbol("s")
    n, m, j = len(linear.coordinates), linear.mass.rows, linear.inputs.index(input)
    drive = sm.Matrix([1, s, s**2])
    load = sm.zeros(n, 1).col_join(sm.Matrix.hstack(*(B[:, j] for B in linear.input_matrices)) * drive)
    row, through = (
        sm.eye(n + m)[linear.coordinates.index(name), :] if name in linear.coordinates else None,
        sm.S.Zero,
    )
    if row is None:
        Y0, Y1, Y2, *D = (matrix[linear.outputs.index(name), :] for matrix in linear.output_matrices)
        row, through = Y0.row_join(Y1 + s * Y2), (sm.Matrix([[d[j] for d in D]]) * drive)[0]
    above = (s * sm.eye(n) - linear.state_matrix[:n, :n]).row_join(-linear.state_matrix[:n, n:])
    system = above.col_join(linear.stiffness.row_join(s * linear.mass + linear.damping))
    bordered = system.row_join(-load).col_join(row.row_join(sm.Matrix([through])))
    return sm.cancel(s**order * _determinant(bordered) / _determinant(system))


def _determinant(matrix: sm.Matrix) -> sm.Expr:
    exactly = DomainMatrix.from_Matrix(matrix.applyfunc(exact))
    return exactly.domain.to_sympy(exactly.charpoly()[-1]) * (-1) ** matrix.rows
