"""What mistake a wrong term looks like, in the words of chapters 1 to 3.

A remark is made only where the form of the term admits it: the product of two rates for Coriolis, a
spring force whose free length is gone for a spring, a potential where there is none for a follower
force.  Where the form says nothing, nothing is said.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable
from fractions import Fraction

import sympy as sm

from engdyn.modeling import load_mistakes, mistakes
from engdyn.modeling.mistakes import HALF, TWO, WEIGHT, Finding, Rows, name_of

__all__ = ["nature", "remark"]

UNITS = {
    sm.pi / 180: "degrees and radians are mixed up",
    sm.pi / 30: "revolutions per minute and rad/s are mixed up",
    2 * sm.pi: "hertz (or revolutions per second) and rad/s are mixed up",
}


def remark(finding: Finding, rows: Rows) -> str:
    """The first mistake whose form a wrong term has, "" where it has none."""
    return next((text for look in LOOKS if (text := look(finding, rows))), "")


def _units(finding: Finding, rows: Rows) -> str:
    for ratio, text in UNITS.items():
        if finding.factor in (ratio, 1 / ratio, ratio**2, 1 / ratio**2):
            return text
        if finding.kind == "changed" and ratio == sm.pi / 180:
            for scale in (ratio, 1 / ratio):
                scaled = {f: f.func(scale * f.args[0]) for f in finding.expected.atoms(sm.sin, sm.cos)}
                if scaled and finding.expected.xreplace(scaled) == finding.given:
                    return f"{text} in the argument of a sine or cosine"
    if finding.factor in (Fraction(981, 100), Fraction(100, 981)):
        return "a factor 9.81: a mass and a weight are mixed up"
    return ""


def _angles(finding: Finding, rows: Rows) -> str:
    """Sum of two angles for their difference, sine for cosine."""
    if finding.kind != "changed":
        return ""
    waves = finding.expected.atoms(sm.sin, sm.cos)
    other = {f: (sm.cos if f.func is sm.sin else sm.sin)(f.args[0]) for f in waves}
    if waves and _plus_minus(finding, other):
        return "sine and cosine are interchanged"
    for wave in waves:
        parts = sm.Add.make_args(wave.args[0])
        flipped = parts[0] - parts[1] if len(parts) == 2 else wave.args[0]
        if len(parts) == 2 and _plus_minus(finding, {wave: wave.func(flipped)}):
            minus = any(part.could_extract_minus_sign() for part in parts)
            first, second = ("sum", "difference") if minus else ("difference", "sum")
            return f"the {first} of the angles stands where their {second} belongs"
    return ""


def _plus_minus(finding: Finding, images: dict) -> bool:
    changed = finding.expected.xreplace(images)
    return finding.given in (changed, -changed)


def _replaced(finding: Finding, rows: Rows) -> str:
    """One symbol in place of another, or one too many or too few."""
    if finding.kind != "changed":
        return ""
    powers = (finding.given / finding.expected).as_powers_dict()
    found = [(base, e) for base, e in powers.items() if not base.is_Number]
    if any(not (base.is_Symbol or base.is_Function or base.is_Derivative) for base, _ in found):
        return ""
    names = {base: name_of(base) for base, _ in found}
    if len(found) == 1:
        base, e = found[0]
        what = names[base] if abs(e) == 1 else f"{names[base]}^{abs(e)}"
        return f"a factor {what} is too many" if e > 0 else f"a factor {what} is missing"
    if len(found) == 2 and found[0][1] == -found[1][1]:
        (one, e), (two, _) = found
        first, second = (one, two) if e > 0 else (two, one)
        return f"{names[first]} stands where {names[second]} belongs"
    return ""


def _weight(finding: Finding, rows: Rows) -> str:
    g = [key for key in rows.symbols(finding.term) if key[1].name == WEIGHT]
    if not g or finding.motion != (0,) * len(finding.motion):
        return ""
    if finding.kind == "factor" and finding.factor == 2:
        return "twice as large as it should be: gravity counted twice, in V and once more as a force?"
    if finding.kind == "sign":
        return "gravity acts the other way: check the sign of the height in V, or of the weight"
    return ""


def _mirrored(finding: Finding, rows: Rows) -> str:
    """Every odd power of one parameter turned in all rows: a product of inertia, or a length counted the other way."""
    pairs = list(zip(rows.given, rows.wanted, strict=True))
    if finding.kind != "sign" or any(e.denominator is not None for pair in pairs for e in pair):
        return ""
    terms = [[dict(rows.ring.polynomials.terms(e.numerator)) for e in pair] for pair in pairs]
    for key in rows.symbols(finding.term):
        at, name = rows.ring.index[key], key[1].name
        if all(given == {e: -c if e[at] % 2 else c for e, c in wanted.items()} for given, wanted in terms):
            if re.fullmatch(r"[IJ]_?\{?([xyz]{2}|[123]{2})\}?", name) and name[-1] != name[-2]:
                return (
                    f"every term with {name} has its sign reversed: two conventions for products of inertia"
                )
            if rows.is_length(key):
                return f"every term with an odd power of {name} has its sign reversed: a length counted the other way?"
    return ""


def _nowhere(finding: Finding, rows: Rows) -> str:
    if finding.kind != "missing":
        return ""
    known = set(rows.symbols(*rows.given))
    names = [str(key[1]) for key in rows.symbols(finding.term) if key not in known]
    if not names:
        return ""
    return f"{' and '.join(names)} {'occurs' if len(names) == 1 else 'occur'} nowhere in your equations"


def _size(finding: Finding, rows: Rows) -> str:
    quarter, third = Fraction(1, 4), Fraction(2, 3)
    texts = {TWO: "twice as large as it should be", HALF: "half as large as it should be"}
    texts |= {quarter: "a quarter of what it should be: half the speed, squared?"}
    texts |= {
        1 / quarter: "four times what it should be: twice the speed, squared, or a diameter for a radius?"
    }
    if rows.rates(finding) == [(rows.owners[finding.row], 1)]:
        texts[third] = "two thirds of what it should be: the rotation of a rolling cylinder left out?"
    return texts.get(finding.factor, "") if finding.kind == "factor" else ""


#: Tried in this order: the most particular form first.
LOOKS: tuple[Callable[[Finding, Rows], str], ...] = (
    _units,
    _angles,
    _weight,
    load_mistakes.follower,
    load_mistakes.friction,
    load_mistakes.virtual_work,
    load_mistakes.reaction,
    _mirrored,
    mistakes.offset,
    mistakes.acceleration,
    mistakes.coriolis,
    mistakes.centripetal,
    mistakes.body_spin,
    load_mistakes.damping,
    mistakes.parallel_axis,
    load_mistakes.spring,
    load_mistakes.elongation,
    _replaced,
    _nowhere,
    _size,
)


def nature(term: sm.Expr, inputs: Iterable[sm.Expr] = ()) -> str:
    """What a term of an equation of motion is: inertia, centrifugal and Coriolis, damping, input, weight, stiffness.

    Parameters
    ----------
    term : sympy.Expr
    inputs : iterable of dynamicsymbols
        Forces and prescribed motions, to be named.
    """
    rates = {d for d in term.atoms(sm.Derivative) if d.variable_count[0][1] == 1}
    if any(d.variable_count[0][1] == 2 for d in term.atoms(sm.Derivative)):
        return "an inertia term (with an acceleration)"
    if rates:
        zero = term.xreplace(dict.fromkeys(rates, sm.S.Zero))
        doubled = term.xreplace({d: 2 * d for d in rates})
        quadratic = zero == 0 and sm.expand(doubled - 4 * term) == 0
        return "a term with squares or products of rates" if quadratic else "a term with rates (a damper?)"
    named = [name_of(i) for i in inputs if term.has(i)]
    if named:
        return f"a term with the input {' and '.join(named)}"
    names = sorted(s.name for s in term.free_symbols if s.name != "t")
    return (
        "a weight term (with g)"
        if WEIGHT in names
        else f"a static term (with {', '.join(names) or 'numbers only'})"
    )
