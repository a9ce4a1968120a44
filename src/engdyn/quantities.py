"""What a system is described by: parameters, coordinates and inputs.  Appendix A."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import sympy as sm

from engdyn.errors import ParameterError
from engdyn.units import to_si

__all__ = ["Coordinate", "Input", "Parameter"]


@dataclass(frozen=True)
class Parameter:
    """A constant of a system.

    Parameters
    ----------
    symbol : str or sympy.Symbol
        Name of the symbol, or the symbol itself.
    unit : str
        SI unit, "-" for none.
    default : float
        Default value [unit].
    meaning : str
        What it is, in words.
    admissible : {"positive", "nonnegative", "any"}
        Which values make sense.
    span : (float, float), optional
        Interval worth exploring [unit]: the range of its slider.
    """

    symbol: Any
    unit: str
    default: float
    meaning: str
    admissible: str = "positive"
    span: tuple[float, float] | None = None

    def __post_init__(self) -> None:
        assumptions = {
            "positive": {"positive": True},
            "nonnegative": {"nonnegative": True},
            "any": {"real": True},
        }
        if self.admissible not in assumptions:
            raise ParameterError(
                f"parameter {self.symbol}: admissible is {self.admissible!r}; choose one of {', '.join(assumptions)}"
            )
        if isinstance(self.symbol, str):
            object.__setattr__(self, "symbol", sm.Symbol(self.symbol, **assumptions[self.admissible]))

    @property
    def name(self) -> str:
        """Name of the symbol."""
        return self.symbol.name

    def check(self, value: Any) -> float:
        """The value as an SI float, or a ParameterError that says what is wrong with it."""
        number = to_si(value, self.unit, f"parameter {self.name} ({self.meaning})")
        bad = (self.admissible == "positive" and number <= 0) or (
            self.admissible == "nonnegative" and number < 0
        )
        if bad:
            wanted = "greater than zero" if self.admissible == "positive" else "zero or greater"
            raise ParameterError(
                f"parameter {self.name} ({self.meaning}) is {number:g} {self.unit}: it must be {wanted}"
            )
        return number


@dataclass(frozen=True)
class Coordinate:
    """A generalized coordinate.

    Parameters
    ----------
    symbol : dynamicsymbol
    unit : str
        "m" or "rad".
    meaning : str
        What it measures, with its positive sense.
    bounds : (float, float), optional
        Region in which equilibria are looked for; None for a coordinate that nothing depends on.
    kind : {"angle", "length", "ignorable"}
    """

    symbol: sm.Expr
    unit: str
    meaning: str
    bounds: tuple[float, float] | None = None
    kind: str = "angle"

    @property
    def name(self) -> str:
        """Name of the dynamicsymbol."""
        return self.symbol.func.__name__


@dataclass(frozen=True)
class Input:
    """What acts on a system from outside.

    Parameters
    ----------
    symbol : dynamicsymbol
    unit : str
    meaning : str
    kind : {"force", "couple", "prescribed motion", "drive angle"}
        A force is whatever acts by its value alone: a steering or a gust angle, too.
    default : (value, rate, acceleration), optional
        Expressions in the parameters and t that hold where the input is not given.
    """

    symbol: sm.Expr
    unit: str
    meaning: str
    kind: str = "force"
    default: tuple[Any, Any, Any] | None = None

    @property
    def name(self) -> str:
        """Name of the dynamicsymbol."""
        return self.symbol.func.__name__
