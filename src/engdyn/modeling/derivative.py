"""State derivatives as code: ẋ = F(t, x, p) with the mass matrix solved in place.

One text serves Python and machine code.  x holds q and u; p holds parameters, the values of the inputs, and
the polynomials of sampled ones.  Course sections 8.1 and 8.9.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from math import perm
from typing import TYPE_CHECKING, Any

import numpy as np
import sympy as sm
from sympy.physics.vector import dynamicsymbols

from engdyn.algebra.codegen import Writer, compile_text, machine_code
from engdyn.algebra.plain import plain_tree
from engdyn.algebra.readable import Node, tree

if TYPE_CHECKING:
    from engdyn.modeling.equations import EquationsOfMotion

__all__ = ["Derivative", "derivative_of"]

Key = tuple[Any, ...]

#: Up to this many speeds M is factored in place, entry by entry.
SMALL = 10
#: Projected equations longer than this [characters] lose digits: numbers then come from what was projected.
LONG = 20_000


class Derivative:
    """The derivative of the state as Python function and, where it can be had, as machine code.

    Parameters
    ----------
    eom : EquationsOfMotion
    symbols : sequence of sympy.Symbol
        Parameters, those of the formulas included: the first entries of p.
    formulas : mapping of key to sympy.Expr
        Values, rates and accelerations of inputs as expressions in t and the symbols.
    sampled : mapping of input to int
        Inputs that are polynomials in t − p[j], and the degree of these: after the values, rates and
        accelerations of all inputs p holds the time and the coefficients, highest power first, of each.
    """

    def __init__(
        self,
        eom: EquationsOfMotion,
        symbols: Sequence[sm.Symbol],
        formulas: Mapping[Key, sm.Expr],
        sampled: Mapping[sm.Expr, int],
    ):
        self.eom, self._formulas, self._sampled = eom, formulas, sampled
        slots = [("symbol", s) for s in symbols]
        slots += [("function", w, k) for w in eom.inputs for k in (0, 1, 2)]
        #: Where p holds what: key of a parameter or an input → index.
        self.slots = {key: i for i, key in enumerate(slots)}
        n, rest = len(eom.coordinates), len(eom.coordinates) + len(eom.speeds)
        nodes = [tree(e) for e in (*eom.rates, *(e for row in eom.mass for e in row), *eom.force)]
        self.text = self._text(nodes, self._solved)
        #: Whether `text` may be used, rather than the equations in all rates.
        self.direct = eom.constrained is None or len(self.text) < LONG
        if not self.direct:
            self.text = self._text([("generator", key) for key in eom.arguments], self._copied)
        self._size, self._compiled, self._python = (n, rest), None, None

    def machine(self, signature: Any) -> Callable[..., None] | None:
        """Machine code of ``f(t, x, p, out)``, compiled once; None where it would not be accurate."""
        if self.direct and self._compiled is None:
            self._compiled = machine_code(self.text, signature)
        return self._compiled

    def python(self, p: list[float]) -> Callable[[float, np.ndarray], np.ndarray]:
        """``f(t, x)`` for the list p as it is when f is called; what has no value is NaN."""
        if self._python is None:
            self._python = compile_text(self.text)
        generated, (n, size) = self._python, self._size
        project = None if self.direct else self.eom.compiled("math")
        out = [0.0] * (size if self.direct else len(self.eom.arguments))

        def derivative(t: float, x: np.ndarray) -> np.ndarray:
            try:
                generated(t, x.tolist(), p, out)
                return (
                    np.array(out, dtype=float) if project is None else _projected(project(*out), n, size - n)
                )
            except (ArithmeticError, TypeError, ValueError, np.linalg.LinAlgError):
                return np.full(size, np.nan)  # outside the domain of a root, at a dead center, …

        return derivative

    # The text

    def _text(self, nodes: Sequence[Node], finish: Callable[[Writer, Sequence[Node]], None]) -> str:
        eom = self.eom
        size = len(eom.coordinates) + len(eom.speeds)
        names = {key: f"x{i}" for i, key in enumerate(eom.arguments[:size])}
        names |= {key: f"p{i}" for key, i in self.slots.items()} | {("symbol", dynamicsymbols._t): "t"}
        writer = Writer(names, False)
        formulas = {key: plain_tree(e) for key, e in self._formulas.items()}
        writer.count([*formulas.values(), *nodes])
        for i, node in enumerate(formulas.values()):
            writer.lines.append(f"w{i} = {writer.text(node)}")
        names |= {key: f"w{i}" for i, key in enumerate(formulas)}
        at = len(self.slots)
        for w, degree in self._sampled.items():
            writer.lines.append(f"s{at} = t - p[{at}]")
            for k in range(3):
                writer.lines.append(f"v{at}_{k} = {_horner(at, degree, k)}")
                names["function", w, k] = f"v{at}_{k}"
            at += degree + 2
        finish(writer, nodes)
        used = sorted(set(re.findall(r"\b[xp]\d+\b", "\n".join(writer.lines))))
        writer.lines[:0] = [f"{name} = {name[0]}[{name[1:]}]" for name in used]
        return writer.function(("t", "x", "p", "out"))

    @staticmethod
    def _copied(writer: Writer, nodes: Sequence[Node]) -> None:
        writer.lines += [f"out[{i}] = {writer.text(node)}" for i, node in enumerate(nodes)]

    def _solved(self, writer: Writer, nodes: Sequence[Node]) -> None:
        """q̇ and the solution u̇ of M u̇ = f."""
        n, m, mass = len(self.eom.coordinates), len(self.eom.speeds), self.eom.mass
        texts = ["" if node == ("number", 0) else writer.text(node) for node in nodes]
        M = [texts[n + i * m : n + (i + 1) * m] for i in range(m)]
        force = [text or "0.0" for text in texts[n + m * m :]]
        symmetric = all(mass[i][j] is mass[j][i] for i in range(m) for j in range(i))
        solve = _factored if symmetric and m <= SMALL else _eliminated
        lines, solution = solve(M, force)
        writer.lines += lines
        writer.lines += [f"out[{i}] = {text or '0.0'}" for i, text in enumerate([*texts[:n], *solution])]


def _horner(at: int, degree: int, order: int) -> str:
    """A derivative of the polynomial with coefficients p[at + 1], … in s = t − p[at]."""
    text = "0.0"
    for i in range(degree + 1 - order):
        factor = perm(degree - i, order)
        term = f"p[{at + 1 + i}]" if factor == 1 else f"{float(factor)}*p[{at + 1 + i}]"
        text = term if i == 0 else f"({text})*s{at} + {term}"
    return text


def _factored(M: list[list[str]], force: list[str]) -> tuple[list[str], list[str]]:
    """M = L D Lᵀ entry by entry, zeros left out; then L y = f, D Lᵀ u̇ = y."""
    m, lines = len(M), []
    L = [[""] * m for _ in M]
    for j in range(m):
        for i in range(j, m):
            terms = [f" - g{i}_{k}*{L[j][k]}" for k in range(j) if L[i][k] and L[j][k]]
            if not M[i][j] and not terms:
                continue
            lines.append(f"g{i}_{j} = {M[i][j] or '0.0'}{''.join(terms)}")
            if i > j:
                L[i][j] = f"l{i}_{j}"
                lines.append(f"{L[i][j]} = g{i}_{j}/g{j}_{j}")
    for i in range(m):
        known = "".join(f" - {L[i][k]}*y{k}" for k in range(i) if L[i][k])
        lines.append(f"y{i} = {force[i]}{known}")
    for i in reversed(range(m)):
        known = "".join(f" - {L[k][i]}*a{k}" for k in range(i + 1, m) if L[k][i])
        lines.append(f"a{i} = y{i}/g{i}_{i}{known}")
    return lines, [f"a{i}" for i in range(m)]


def _eliminated(M: list[list[str]], force: list[str]) -> tuple[list[str], list[str]]:
    """Gauss's elimination with row exchanges: for large or unsymmetric M."""
    m = len(M)
    lines = [f"A = zeros(({m}, {m + 1}))"]
    lines += [f"A[{i}, {j}] = {text}" for i, row in enumerate(M) for j, text in enumerate(row) if text]
    lines += [f"A[{i}, {m}] = {text}" for i, text in enumerate(force)]
    lines += [
        f"for k in range({m}):",
        "    r = k",
        f"    for i in range(k + 1, {m}):",
        "        if fabs(A[i, k]) > fabs(A[r, k]):",
        "            r = i",
        f"    for j in range(k, {m + 1}):",
        "        exchanged = A[k, j]",
        "        A[k, j] = A[r, j]",
        "        A[r, j] = exchanged",
        f"    for i in range({m}):",
        "        if i != k and A[i, k] != 0.0:",
        "            factor = A[i, k]/A[k, k]",
        f"            for j in range(k, {m + 1}):",
        "                A[i, j] = A[i, j] - factor*A[k, j]",
    ]
    return lines, [f"A[{i}, {m}]/A[{i}, {i}]" for i in range(m)]


def _projected(flat: Sequence[Any], n: int, m: int) -> np.ndarray:
    """ẋ from M, f and q̇."""
    flat = np.array(flat, dtype=float)
    udot = np.linalg.solve(flat[: m * m].reshape(m, m), flat[m * m : m * m + m])
    return np.concatenate([flat[m * m + m : m * m + m + n], udot])


def derivative_of(
    eom: EquationsOfMotion,
    symbols: Sequence[sm.Symbol] | None = None,
    formulas: Mapping[Key, sm.Expr] | None = None,
    sampled: Mapping[sm.Expr, int] | None = None,
) -> Derivative:
    """The :class:`Derivative` of equations of motion, written once for each kind of inputs."""
    symbols = eom.parameters if symbols is None else tuple(symbols)
    formulas, sampled = dict(formulas or {}), dict(sampled or {})
    cache = eom.__dict__.setdefault("_derivatives", {})
    key = symbols, tuple(formulas.items()), tuple(sampled.items())
    if key not in cache:
        cache[key] = Derivative(eom, symbols, formulas, sampled)
    return cache[key]
