from . import course, plots, systems, widgets
from .analysis.branches import Branch, BranchPoint, BranchSet, continue_equilibria
from .analysis.equilibrium import Equilibrium, EquilibriumSet, equilibria
from .analysis.linear import LinearSystem, eigenvalues, linearize
from .analysis.stability import Stability, stability
from .errors import (
    EngdynError,
    EngdynWarning,
    OutsideRingError,
    ParameterError,
    RecordError,
    UnknownSystemError,
)
from .modeling.equality import Proof, prove_equal
from .modeling.equations import EquationsOfMotion
from .modeling.lagrange import lagrange
from .modeling.newton import FreeBody, newton_euler
from .quantities import Coordinate, Input, Parameter
from .system import System

__version__: str
__all__ = [
    "Branch",
    "BranchPoint",
    "BranchSet",
    "Coordinate",
    "EngdynError",
    "EngdynWarning",
    "EquationsOfMotion",
    "Equilibrium",
    "EquilibriumSet",
    "FreeBody",
    "Input",
    "LinearSystem",
    "OutsideRingError",
    "Parameter",
    "ParameterError",
    "Proof",
    "RecordError",
    "Stability",
    "System",
    "UnknownSystemError",
    "continue_equilibria",
    "course",
    "eigenvalues",
    "equilibria",
    "lagrange",
    "linearize",
    "newton_euler",
    "plots",
    "prove_equal",
    "stability",
    "systems",
    "widgets",
]
