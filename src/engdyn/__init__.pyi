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
from .modeling.inertia import PrincipalAxes, inertia_tensor, parallel_axis, principal_axes
from .modeling.kinematics import AccelerationTerms, VectorDerivative, acceleration_terms, vector_derivative
from .modeling.lagrange import lagrange
from .modeling.newton import FreeBody, newton_euler
from .quantities import Coordinate, Input, Parameter
from .system import System

__version__: str
__all__ = [
    "AccelerationTerms",
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
    "PrincipalAxes",
    "Proof",
    "RecordError",
    "Stability",
    "System",
    "UnknownSystemError",
    "VectorDerivative",
    "acceleration_terms",
    "continue_equilibria",
    "course",
    "eigenvalues",
    "equilibria",
    "inertia_tensor",
    "lagrange",
    "linearize",
    "newton_euler",
    "parallel_axis",
    "plots",
    "principal_axes",
    "prove_equal",
    "stability",
    "systems",
    "vector_derivative",
    "widgets",
]
