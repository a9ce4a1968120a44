"""Trees of expressions as they stand: numbers on all targets, nothing expanded."""

from __future__ import annotations

import numpy as np
import pytest
import sympy as sm
from sympy.physics.mechanics import dynamicsymbols

from engdyn.algebra.codegen import compile_trees, has_numba
from engdyn.algebra.plain import plain_tree
from engdyn.errors import EngdynError, OutsideRingError

t, a = dynamicsymbols._t, sm.Symbol("a")
x = dynamicsymbols("x")
KEYS = [("symbol", t), ("symbol", a), ("function", x, 0), ("function", x, 1)]
AT = (0.7, -1.3, 0.4, 2.5)

EXPRESSIONS = [
    sm.sin(300.125 * t) * sm.cos(sm.pi * t / 7 - a) + sm.tan(t) / sm.sec(a) - sm.cot(t) * sm.csc(t),
    sm.exp(-((t - 5) ** 2)) * a**3 / (1 + t**2) - sm.E * sm.pi + sm.Rational(1, 3),
    sm.sqrt(t + 2) ** -3 + sm.Abs(a) * sm.atan2(t, a) + (t + 2) ** sm.Rational(2, 3),
    x.diff(t) * x + sm.tanh(x) - sm.log(t) + (x * a).diff(t) + sm.asin(t) * sm.acos(t / 2) * sm.atan(a),
    sm.Heaviside(t - 0.5) + 2 * sm.Heaviside(a) - sm.sign(a) * sm.sinh(t) + sm.sign(t) * sm.cosh(t),
]


@pytest.mark.parametrize("target", ["math", "numpy", "numba"])
@pytest.mark.parametrize("expr", EXPRESSIONS)
def test_numbers_are_those_of_sympy(expr, target):
    if target == "numba" and not has_numba():
        pytest.skip("numba is not installed")
    function = compile_trees([plain_tree(expr)], KEYS, target)
    known = dict(zip((t, a), AT, strict=False))
    expected = expr.doit().subs({x.diff(t): AT[3]}).subs({x: AT[2]}).subs(known)
    assert function(*AT)[0] == pytest.approx(float(expected), rel=1e-12)
    if target == "numpy":
        stacked = function(*(np.full(3, v) for v in AT))[0]
        np.testing.assert_allclose(stacked, [float(expected)] * 3, rtol=1e-12)


def test_a_jump_has_its_later_value_where_it_happens():
    for target, values in (("math", [0.5]), ("numpy", [np.array([0.5])])):
        function = compile_trees([plain_tree(sm.Heaviside(t - 0.5))], KEYS[:1], target)
        assert function(*values)[0] == 1.0


def test_sines_of_large_multiples_stay_as_they_are():
    tree = plain_tree(sm.sin(300.125 * t) + sm.cos(17.3 * t))
    assert str(tree).count("call") == 2


@pytest.mark.parametrize("expr", [sm.Piecewise((t, t > 0), (0, True)), sm.gamma(t), sm.oo, sm.Integral(t, t)])
def test_what_has_no_numbers(expr):
    with pytest.raises(OutsideRingError):
        plain_tree(expr)
    with pytest.raises(EngdynError, match="not text"):
        plain_tree("t")
