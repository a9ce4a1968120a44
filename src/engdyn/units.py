"""Units at the boundary: text such as ``"30 ft"`` or ``"44 deg"`` becomes SI floats.  Appendix C."""

from __future__ import annotations

import math
from functools import cache
from typing import Any

from engdyn.errors import ParameterError

__all__ = ["to_si"]


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

    Raises
    ------
    ParameterError
        Not a finite number, or a unit that does not convert.
    """
    if isinstance(value, str):
        number = _from_text(value, unit, name)
    else:
        if isinstance(value, bool) or value is None:
            raise ParameterError(f"{name} is {value!r}: give a number in {unit} or text with a unit")
        try:
            number = float(value)
        except (TypeError, ValueError) as error:
            raise ParameterError(f"{name} is {value!r}: give a number in {unit} or text with a unit") from error
    if not math.isfinite(number):
        raise ParameterError(f"{name} is {number}: give a finite number in {unit}")
    return number


def _from_text(text: str, unit: str, name: str) -> float:
    import pint

    if len(text) > 100:
        raise ParameterError(f"{name}: the text is {len(text)} characters long; give something like '3.5 {unit}'")
    registry = _registry()
    target = "dimensionless" if unit == "-" else unit
    try:
        quantity = registry.Quantity(text)
        return float(quantity.to(target).magnitude)
    except pint.DimensionalityError as error:
        raise ParameterError(f"{name} = {text!r} cannot be converted to {unit}: its unit measures something else") from error
    except Exception as error:  # pint raises many kinds of errors on text it cannot read
        raise ParameterError(f"{name} = {text!r} is not a number with a unit: give something like '3.5 {unit}'") from error
