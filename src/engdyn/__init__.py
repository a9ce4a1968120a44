"""engdyn: the practice of engineering dynamics, as a course that runs.

Every public name lives here at the top level and is loaded on first use, so ``import engdyn`` costs
little more than starting Python. ``engdyn.systems``, ``engdyn.plots``, ``engdyn.widgets`` and
``engdyn.course`` are namespaces of their own. The file ``__init__.pyi`` tells editors and type checkers
what the lazy names are; a test keeps the two in step.
"""

from __future__ import annotations

import sys
from importlib import import_module

import lazy_loader

__version__ = "0.1.0"

__getattr__, __dir__, __all__ = lazy_loader.attach(
    __name__,
    submodules=["course", "plots", "shapes", "solids", "systems", "widgets"],
    submod_attrs={
        "errors": [
            "EngdynError",
            "EngdynWarning",
            "OutsideRingError",
            "ParameterError",
            "RecordError",
            "UnknownSystemError",
        ],
        "quantities": ["Coordinate", "Input", "Parameter"],
        "system": ["System"],
        "modeling.equality": ["Proof", "prove_equal"],
        "modeling.equations": ["EquationsOfMotion"],
        "modeling.inertia": [
            "PrincipalAxes",
            "inertia_tensor",
            "parallel_axis",
            "principal_axes",
            "rotate_tensor",
        ],
        "modeling.instants": ["components", "motion_at", "rotation_matrix"],
        "modeling.kinematic_chain": ["KinematicChain"],
        "modeling.rotations": ["AngularMotion", "angular_motion"],
        "modeling.kinematics": [
            "AccelerationTerms",
            "VectorDerivative",
            "acceleration_terms",
            "vector_derivative",
        ],
        "modeling.euler": ["EulerEquations", "euler_equations"],
        "modeling.gyroscopes": [
            "FreePrecession",
            "SteadyPrecession",
            "free_precession",
            "steady_precession",
        ],
        "modeling.moments": ["MomentBalance", "angular_momentum", "moment_balance"],
        "modeling.definiteness": ["Definiteness"],
        "modeling.energies": [
            "damper_dissipation",
            "gravity_potential",
            "kinetic_energy",
            "spring_potential",
        ],
        "modeling.lagrange": ["lagrange"],
        "modeling.lagrange_steps": ["LagrangeSteps"],
        "modeling.potential": ["check_potential", "potential_of"],
        "modeling.standard_form": ["StandardForm", "standard_form"],
        "modeling.virtual_work": ["generalized_forces"],
        "modeling.newton": ["FreeBody", "newton_euler"],
        "analysis.branches": ["Branch", "BranchPoint", "BranchSet", "continue_equilibria"],
        "analysis.equilibrium": ["Equilibrium", "EquilibriumSet", "equilibria"],
        "analysis.linear": ["LinearSystem", "eigenvalues", "linearize"],
        "analysis.stability": ["Stability", "stability"],
    },
)

if "IPython" in sys.modules:  # by name: the package itself stands below all of its layers
    import_module("engdyn.display").register()
