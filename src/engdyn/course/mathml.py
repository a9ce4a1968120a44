"""Formulas as MathML, which every present browser shows without any library or request.

What sympy prints as Leibniz' notation is printed here as engineers write it: θ̇ for a rate, sin θ without
parentheses, functions of time by their names alone.
"""

from __future__ import annotations

import html
from typing import Any

import sympy as sm
from sympy.core.function import AppliedUndef
from sympy.physics.vector import Dyadic, ReferenceFrame, Vector, dynamicsymbols
from sympy.physics.vector.printing import vlatex
from sympy.printing.mathml import MathMLPresentationPrinter

from engdyn.algebra.expressions import as_expression

__all__ = ["dyadic", "equation", "formula", "vector"]

LONGEST = 78
"""Room of one line, in letters."""

NAMES = {sm.atan: "arctan", sm.asin: "arcsin", sm.acos: "arccos", sm.log: "ln"}
DOTS = {1: "\u02d9", 2: "\u00a8"}
PLAIN = {"&InvisibleTimes;": "\u2062", "&dd;": "d", "<mo>-</mo>": "<mo>−</mo>"}


class _Printer(MathMLPresentationPrinter):
    """Presentation MathML in the notation of mechanics."""

    def _element(self, tag: str, *children: Any) -> Any:
        element = self.dom.createElement(tag)
        for child in children:
            element.appendChild(self.dom.createTextNode(child) if isinstance(child, str) else child)
        return element

    def parenthesize(self, item: Any, level: Any, strict: bool = False) -> Any:
        if isinstance(item, AppliedUndef | sm.Derivative | sm.Function):
            return self._print(item)
        return super().parenthesize(item, level, strict)

    def _print_Function(self, expr: Any) -> Any:
        if isinstance(expr, AppliedUndef):
            return self._print(sm.Symbol(subscripted(expr.func.__name__)))
        name = self._element("mi", NAMES.get(expr.func, expr.func.__name__))
        return self._element("mrow", self._space(), name, *self._argument(expr))

    def _argument(self, expr: Any) -> list[Any]:
        """What a function is applied to: a single letter without parentheses; a thin space behind."""
        (argument,) = expr.args if len(expr.args) == 1 else (None,)
        if argument is not None and (argument.is_Symbol or isinstance(argument, AppliedUndef)):
            return [self._element("mo", "\u2061"), self._space(), self._print(argument), self._space()]
        return [self._element("mo", "\u2061"), self._paren_comma_separated(*expr.args)]

    def _space(self) -> Any:
        space = self._element("mspace")
        space.setAttribute("width", "0.17em")
        return space

    def _print_Derivative(self, expr: Any) -> Any:
        order = expr.derivative_count
        if (
            not isinstance(expr.expr, AppliedUndef)
            or order not in DOTS
            or set(expr.variables) != {dynamicsymbols._t}
        ):
            return super()._print_Derivative(expr)
        name = self._print(expr.expr)
        if name.tagName == "msub":  # the dot belongs over the letter, not over its index
            letter, index = name.childNodes
            return self._element("msub", self._dotted(letter, order), index)
        return self._dotted(name, order)

    def _dotted(self, letter: Any, order: int) -> Any:
        accent = self._element("mover", letter, self._element("mo", DOTS[order]))
        accent.setAttribute("accent", "true")
        return accent

    def _print_Pow(self, expr: Any) -> Any:
        base, exponent = expr.as_base_exp()
        if exponent.is_Integer and exponent > 1:
            if isinstance(base, sm.sin | sm.cos | sm.tan):
                name = self._element("msup", self._element("mi", base.func.__name__), self._print(exponent))
                return self._element("mrow", self._space(), name, *self._argument(base))
            if isinstance(base, AppliedUndef | sm.Derivative):
                return self._element("msup", self._print(base), self._print(exponent))
        return super()._print_Pow(expr)


def subscripted(name: str) -> str:
    """Names of two plain letters, such as ``zf``, are a letter with a subscript."""
    return f"{name[0]}_{name[1]}" if len(name) == 2 and name.isalpha() else name


def markup(expr: Any) -> str:
    """MathML of an expression, without the surrounding element."""
    text = _Printer({"fold_short_frac": False}).doprint(as_expression(expr))
    for entity, letter in PLAIN.items():
        text = text.replace(entity, letter)
    return text


def formula(expr: Any) -> str:
    """An expression as a formula in a line of text, with its LaTeX form as alternative."""
    return _math(markup(expr), vlatex(expr))


def _math(body: str, latex: str) -> str:
    alternative = html.escape(latex, quote=True)
    return f'<math alttext="{alternative}" title="{alternative}"><mrow>{body}</mrow></math>'


def equation(left: Any, right: Any) -> str:
    """left = right as a displayed formula; sums too long for a line go on in the next one."""
    rows = [["", "", line] for line in _lines(left)]
    rows += [["", "<mo>=</mo>" if i == 0 else "", line] for i, line in enumerate(_lines(right))]
    if len(rows) > 1 and len(_lines(left)) == 1:  # left side and equality sign share the first line
        rows = [[rows[0][2], "<mo>=</mo>", rows[1][2]], *rows[2:]]
    cells = "".join("<mtr>" + "".join(f"<mtd>{cell}</mtd>" for cell in row) + "</mtr>" for row in rows)
    latex = f"{vlatex(left)} = {vlatex(right)}"
    body = f'<mtable displaystyle="true">{cells}</mtable>'
    return f'<div class="formula">{_math(body, latex)}</div>'


def _lines(expr: Any) -> list[str]:
    """The terms of a sum, gathered into lines."""
    terms = sm.Add.make_args(as_expression(expr))
    terms = sm.Add(*terms).as_ordered_terms() if len(terms) > 1 else list(terms)
    lines, width = [""], 0
    for i, term in enumerate(terms):
        negative = term.could_extract_minus_sign()
        size = _width(term) + 3
        if width + size > LONGEST and width:
            lines, width = [*lines, ""], 0
        sign = "<mo>−</mo>" if negative else ("<mo>+</mo>" if i else "")
        shown = -term if negative else term
        inner = (
            f"<mrow><mo>(</mo>{markup(shown)}<mo>)</mo></mrow>"
            if negative and shown.is_Add
            else markup(shown)
        )
        lines[-1] += sign + inner
        width += size
    return lines


def _width(term: Any) -> int:
    """About how many letters a term fills: its leaves and its plus signs."""
    leaves = [a for a in sm.preorder_traversal(term) if not a.args or isinstance(a, AppliedUndef)]
    names = sum(
        3
        for a in sm.preorder_traversal(term)
        if isinstance(a, sm.Function) and not isinstance(a, AppliedUndef)
    )
    plus = sum(2 * (len(a.args) - 1) for a in sm.preorder_traversal(term) if a.is_Add)
    return len(leaves) + names + plus


def vector(value: Vector) -> str:
    """A vector by its components: unit vectors carry a hat and the letter of their frame."""
    parts: list[str] = []
    latex: list[str] = []
    for components, frame in value.args:
        for component, axis in zip(components, "xyz", strict=True):
            if component != 0:
                parts.append(_component(component, unit_vector(frame, axis), first=not parts))
                latex.append(
                    rf"\left({vlatex(component)}\right) \mathbf{{\hat{{{frame.name.lower()}}}}}_{axis}"
                )
    return _math("".join(parts) or "<mn>0</mn>", " + ".join(latex) or "0")


def unit_vector(frame: ReferenceFrame, axis: str) -> str:
    """MathML of a unit vector."""
    letter = f'<mi mathvariant="bold">{html.escape(frame.name.lower())}</mi>'
    return f'<msub><mover accent="true">{letter}<mo>^</mo></mover><mi>{axis}</mi></msub>'


def dyadic(value: Dyadic) -> str:
    """An inertia dyadic by its components."""
    parts, latex = [], []
    for measure, left, right in value.args:
        units = ""
        for side in (left, right):
            components, frame = side.args[0]
            axis = "xyz"[[bool(c) for c in components].index(True)]
            units += unit_vector(frame, axis)
        parts.append(_component(measure, units, first=not parts))
        latex.append(vlatex(measure))
    return _math("".join(parts) or "<mn>0</mn>", " + ".join(latex) or "0")


def _component(component: Any, unit: str, first: bool) -> str:
    negative = component.could_extract_minus_sign()
    size = -component if negative else component
    sign = "<mo>−</mo>" if negative else ("" if first else "<mo>+</mo>")
    if size == 1:
        return sign + unit
    shown = f"<mrow><mo>(</mo>{markup(size)}<mo>)</mo></mrow>" if size.is_Add else markup(size)
    return f"{sign}{shown}<mo>\u2062</mo>{unit}"
