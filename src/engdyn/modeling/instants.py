"""Vectors and coordinates at one instant: numbers in place of everything symbolic.

Course sections 1.1 to 1.7: the numbers with which a derivation is checked, against finite differences.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import sympy as sm
from sympy.core.function import AppliedUndef
from sympy.physics.vector import ReferenceFrame, Vector, dynamicsymbols

from engdyn.algebra.expressions import as_expression
from engdyn.algebra.scan import derivative_key
from engdyn.errors import EngdynError

__all__ = ["components", "key_name", "motion_at", "number_at", "rotation_matrix"]


def motion_at(paths: Mapping[Any, Any], time: float) -> dict[str, float]:
    """Coordinates with their first two rates at one instant of a given motion.

    Parameters
    ----------
    paths : mapping of dynamicsymbol to expression
        Each coordinate as an expression of the time alone, ``dynamicsymbols._t``.
    time : float
        The instant [s].

    Returns
    -------
    dict of str to float
        ``theta``, ``theta_d``, ``theta_dd`` for a coordinate theta [SI], as :func:`components` takes them.

    Raises
    ------
    EngdynError
        A key that is no dynamicsymbol, a path with other symbols than the time, values that are not finite.

    Examples
    --------
    >>> import engdyn as ed
    >>> from sympy.physics.mechanics import dynamicsymbols
    >>> t, r = dynamicsymbols._t, dynamicsymbols("r")
    >>> ed.motion_at({r: 2 + t**2}, 3.0)
    {'r': 11.0, 'r_d': 6.0, 'r_dd': 2.0}
    """
    t, found = dynamicsymbols._t, {}
    for q, path in paths.items():
        key = derivative_key(q) if isinstance(q, sm.Expr) else None
        if key is None or key[2]:
            raise EngdynError(f"{q!r} is no coordinate: give dynamicsymbols and their paths over the time")
        path = as_expression(path, f"the path of {q}")
        if path.free_symbols - {t} or path.atoms(AppliedUndef):
            raise EngdynError(f"the path of {q} is {path}: write it with numbers and the time {t} alone")
        for k in range(3):
            found[key_name(q) + ("_" + "d" * k if k else "")] = number_at(path.diff(t, k), {str(t): time})
    return found


def components(vector: Vector, frame: ReferenceFrame, values: Mapping[Any, float]) -> np.ndarray:
    """Components of a vector in a frame, as numbers.

    Parameters
    ----------
    vector : Vector
    frame : ReferenceFrame
    values : mapping
        Symbols, dynamicsymbols and their derivatives (or their names, ``"theta"``, ``"theta_d"``,
        ``"theta_dd"``) → numbers [SI].

    Returns
    -------
    ndarray, shape (3,)

    Raises
    ------
    EngdynError
        A number is missing or not finite; what is given is no vector.
    """
    if not isinstance(vector, Vector):
        raise EngdynError(f"{vector!r} is no vector: give a Vector of sympy.physics.mechanics")
    total = np.zeros(3)
    for matrix, own in vector.args:
        part = np.array([number_at(entry, values) for entry in matrix])
        total += part if own is frame else rotation_matrix(own, frame, values) @ part
    return total


def rotation_matrix(frame: ReferenceFrame, ground: ReferenceFrame, values: Mapping[Any, float]) -> np.ndarray:
    """The matrix that turns components in `frame` into components in `ground`, as numbers.

    Parameters
    ----------
    frame, ground : ReferenceFrame
    values : mapping
        As for :func:`components`.

    Returns
    -------
    ndarray, shape (3, 3)
        Its columns are the unit vectors of `frame`, seen from the ground.
    """
    from engdyn.modeling.motion import rotation_steps

    product = np.eye(3)
    for step in rotation_steps(ground, frame):
        product = product @ np.array([[number_at(step[i, j], values) for j in range(3)] for i in range(3)])
    return product


def number_at(expression: sm.Expr, values: Mapping[Any, float]) -> float:
    """The value of an expression [SI]; an EngdynError names what is missing in `values`."""
    named = {key_name(key): value for key, value in values.items()}
    replaced = as_expression(expression)
    for atom in sorted(replaced.atoms(sm.Derivative), key=lambda d: -d.derivative_count):
        replaced = replaced.xreplace({atom: _value_of(atom, named)})
    functions = {f: _value_of(f, named) for f in replaced.atoms(AppliedUndef)}
    replaced = replaced.xreplace(functions)
    number = complex(replaced.xreplace({s: _value_of(s, named) for s in replaced.free_symbols}))
    if number.imag or not np.isfinite(number.real):
        raise EngdynError(f"{expression} is not a finite real number at the values given: check them")
    return number.real


def key_name(key: Any) -> str:
    """``theta_dd`` for the second derivative of theta, names as they are."""
    if isinstance(key, str):
        return key
    if isinstance(key, sm.Derivative):
        return f"{key.expr.func.__name__}_{'d' * int(key.derivative_count)}"
    return key.func.__name__ if isinstance(key, AppliedUndef) else str(key)


def _value_of(atom: sm.Expr, named: Mapping[str, float]) -> sm.Float:
    name = key_name(atom)
    if name not in named:
        raise EngdynError(f"values lacks {name}: give it a number")
    return sm.Float(float(named[name]))
