"""Units at the boundary: text such as ``"30 ft"`` or ``"44 deg"`` becomes SI floats.  Appendix C."""

from __future__ import annotations

import math
import re
import reprlib
from functools import cache
from typing import Any

from engdyn.errors import ParameterError

__all__ = ["si_factor", "to_si"]

#: A number, then a unit: names with exponents of one digit, products and quotients.  Nothing else is
#: handed on, so there is nothing to compute with; the possessive ``++`` keeps long nonsense cheap.
NUMBER = r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d{1,4})?"
UNIT = r"(?:[A-Za-zµμΩ°%]++(?:\s*(?:\*\*|\^)\s*-?\d(?!\d)|[²³])?|\)\s*(?:\*\*|\^)\s*-?\d(?!\d)|[\s*·/()]|1(?=\s*/))*"
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
        in hertz where radians per second are wanted or the reverse.

    Notes
    -----
    Appendix C.  Text without a unit is a number already in `unit`, as it comes from a text field.
    """
    if isinstance(value, str):
        number = _from_text(value, unit, name)
    else:
        number = _from_number(value, unit, name)
    if not math.isfinite(number):
        raise ParameterError(f"{name} is {number}: give a finite number in {unit}")
    return number


def si_factor(unit: str) -> float | None:
    """How many SI units one of this unit is: 0.001 for "mm", 1 for "N m"; None where it is not known.

    Parameters
    ----------
    unit : str
        "-" for none.

    Notes
    -----
    Appendix C.  Of units with an offset, such as degC, the factor is that of differences.
    """
    if unit == "-":
        return 1.0
    if len(unit) > 100 or not re.fullmatch(UNIT, unit, re.ASCII) or not unit.strip():
        return None
    try:
        one, two = (_registry().Quantity(x, unit).to_base_units().magnitude for x in (1.0, 2.0))
        return float(two - one)
    except Exception:  # pint raises many kinds of errors on units it does not know
        return None


def _from_number(value: Any, unit: str, name: str) -> float:
    try:
        if value is None or type(value).__name__ in ("bool", "bool_"):
            raise TypeError
        return float(value)
    except (OverflowError, TypeError, ValueError) as error:
        raise ParameterError(
            f"{name} is {reprlib.repr(value)}: give a number in {unit} or text with a unit"
        ) from error


def _from_text(text: str, unit: str, name: str) -> float:
    import pint

    shown, example = reprlib.repr(text), "'3.5'" if unit == "-" else f"'3.5 {unit}'"
    found = TEXT.fullmatch(text) if len(text) <= 100 else None
    if found is None:
        raise ParameterError(f"{name} = {shown} is not a number with a unit: give something like {example}")
    number, given = float(found[1]), found[2].strip()
    if not given:
        return number
    try:
        quantity = _registry().Quantity(number, given)
        if unit.startswith("rad/s") and "hertz" in str(quantity.units):
            raise ParameterError(
                f"{name} = {shown} is a frequency, wanted is {unit}: write it in rad/s, rpm or turn/s "
                "(1 Hz = 2π rad/s)"
            )
        if unit.startswith("Hz") and re.search("radian|degree|turn|revolution", str(quantity.units)):
            raise ParameterError(
                f"{name} = {shown} is an angular rate, wanted is {unit}: write it in Hz (1 Hz = 60 rpm = 2π rad/s)"
            )
        return float(quantity.to("dimensionless" if unit == "-" else unit).magnitude)
    except pint.DimensionalityError as error:
        raise ParameterError(
            f"{name} = {shown} cannot be converted to {unit}: its unit measures something else"
        ) from error
    except ParameterError:
        raise
    except Exception as error:  # pint raises many kinds of errors on units it does not know
        raise ParameterError(
            f"{name} = {shown}: {given!r} is not a unit; give something like {example}"
        ) from error
