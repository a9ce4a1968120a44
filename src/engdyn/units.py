"""Units at the boundary: text such as ``"30 ft"`` or ``"44 deg"`` becomes SI floats.  Appendix C."""

from __future__ import annotations

import math
import re
import reprlib
from functools import cache
from typing import Any

from engdyn.errors import ParameterError

__all__ = ["to_si"]

#: A number, then a unit: letters (or a sign such as ° or %) with exponents of one digit, joined by
#: blanks, ``*``, ``·``, ``/`` and brackets.  Nothing else is handed on to be read.
NUMBER = r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d{1,4})?"
UNIT = r"(?:[A-Za-zµμΩ°%]++(?:\s*(?:\*\*|\^)\s*-?\d(?!\d)|[²³])?|[\s*·/()]|1(?=\s*/))*"
TEXT = re.compile(rf"\s*({NUMBER})\s*({UNIT})\s*", re.ASCII)


@cache
def _registry() -> Any:
    import pint

    return pint.UnitRegistry(autoconvert_offset_to_baseunit=True)


def to_si(value: Any, unit: str, name: str) -> float:
    """A number, or text with a unit, as a float in the given SI unit.

    Parameters
    ----------
    value : float or str
        A number already in `unit`, or text such as ``"30 ft"``.
    unit : str
        SI unit of the result, "-" for none.
    name : str
        What is converted (for the message).

    Returns
    -------
    float

    Raises
    ------
    ParameterError
        Not a finite number, text that is not a number with a unit, a unit that does not convert, a frequency
        in hertz where radians per second are wanted.

    Notes
    -----
    Appendix C.  The unit may be left out only where the result has none or is an angle in radians.
    """
    if isinstance(value, str):
        number = _from_text(value, unit, name)
    else:
        number = _from_number(value, unit, name)
    if not math.isfinite(number):
        raise ParameterError(f"{name} is {number}: give a finite number in {unit}")
    return number


def _from_number(value: Any, unit: str, name: str) -> float:
    try:
        if value is None or type(value).__name__ in ("bool", "bool_"):
            raise TypeError
        return float(value)
    except (OverflowError, TypeError, ValueError) as error:
        raise ParameterError(
            f"{name} is {reprlib.repr(value)}: give a number in {unit} or text with a unit"
        ) from error


#: A number, then a unit: names, products, quotients and one-digit powers; nothing to compute with.
NUMBER_AND_UNIT = re.compile(r"\s*([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d{1,3})?)\s*(.*?)\s*")
UNIT = re.compile(r"(?:1/)?(?:[A-Za-zµ°Ωμ]+|\*\*-?\d(?!\d)|\^-?\d(?!\d)|[*/ ]|²|³)*")


def _from_text(text: str, unit: str, name: str) -> float:
    import pint

    found = NUMBER_AND_UNIT.fullmatch(text[:200])
    if len(text) > 100 or found is None or UNIT.fullmatch(found[2]) is None:
        raise ParameterError(
            f"{name} = {text[:40]!r} is not a number with a unit: give something like '3.5 {unit}'"
        )
    if not found[2]:
        return float(found[1])
    target = "dimensionless" if unit == "-" else unit
    try:
        quantity = _registry().Quantity(float(found[1]), found[2])
        return float(quantity.to(target).magnitude)
    except pint.DimensionalityError as error:
        raise ParameterError(
            f"{name} = {text!r} cannot be converted to {unit}: its unit measures something else"
        ) from error
    except Exception as error:  # pint raises many kinds of errors on text it cannot read
        raise ParameterError(
            f"{name} = {text!r} is not a number with a unit: give something like '3.5 {unit}'"
        ) from error
