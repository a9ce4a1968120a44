from . import course, plots, shapes, solids, systems, widgets
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
from .modeling.definiteness import Definiteness
from .modeling.energies import damper_dissipation, gravity_potential, kinetic_energy, spring_potential
from .modeling.equality import Proof, prove_equal
from .modeling.equations import EquationsOfMotion
from .modeling.euler import EulerEquations, euler_equations
from .modeling.gyroscopes import FreePrecession, SteadyPrecession, free_precession, steady_precession
from .modeling.inertia import PrincipalAxes, inertia_tensor, parallel_axis, principal_axes, rotate_tensor
from .modeling.instants import components, motion_at, rotation_matrix
from .modeling.kinematic_chain import KinematicChain
from .modeling.kinematics import AccelerationTerms, VectorDerivative, acceleration_terms, vector_derivative
from .modeling.lagrange import lagrange
from .modeling.lagrange_steps import LagrangeSteps
from .modeling.moments import MomentBalance, angular_momentum, moment_balance
from .modeling.newton import FreeBody, newton_euler
from .modeling.potential import check_potential, potential_of
from .modeling.rotations import AngularMotion, angular_motion
from .modeling.standard_form import StandardForm, standard_form
from .modeling.virtual_work import generalized_forces
from .quantities import Coordinate, Input, Parameter
from .system import System

__version__: str
__all__ = [
    "AccelerationTerms",
    "AngularMotion",
    "Branch",
    "BranchPoint",
    "BranchSet",
    "Coordinate",
    "Definiteness",
    "EngdynError",
    "EngdynWarning",
    "EquationsOfMotion",
    "Equilibrium",
    "EquilibriumSet",
    "EulerEquations",
    "FreeBody",
    "FreePrecession",
    "Input",
    "KinematicChain",
    "LagrangeSteps",
    "LinearSystem",
    "MomentBalance",
    "OutsideRingError",
    "Parameter",
    "ParameterError",
    "PrincipalAxes",
    "Proof",
    "RecordError",
    "Stability",
    "StandardForm",
    "SteadyPrecession",
    "System",
    "UnknownSystemError",
    "VectorDerivative",
    "acceleration_terms",
    "angular_momentum",
    "angular_motion",
    "check_potential",
    "components",
    "continue_equilibria",
    "course",
    "damper_dissipation",
    "eigenvalues",
    "equilibria",
    "euler_equations",
    "free_precession",
    "generalized_forces",
    "gravity_potential",
    "inertia_tensor",
    "kinetic_energy",
    "lagrange",
    "linearize",
    "moment_balance",
    "motion_at",
    "newton_euler",
    "parallel_axis",
    "plots",
    "potential_of",
    "principal_axes",
    "prove_equal",
    "rotate_tensor",
    "rotation_matrix",
    "shapes",
    "solids",
    "spring_potential",
    "stability",
    "standard_form",
    "steady_precession",
    "systems",
    "vector_derivative",
    "widgets",
]
