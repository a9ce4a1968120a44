"""engdyn: the practice of engineering dynamics, as a course that runs.

Every public name lives here at the top level and is loaded on first use, so ``import engdyn`` costs
little more than starting Python. ``engdyn.systems``, ``engdyn.plots``, ``engdyn.widgets`` and
``engdyn.course`` are namespaces of their own. The file ``__init__.pyi`` tells editors and type checkers
what the lazy names are; a test keeps the two in step.
"""

from __future__ import annotations

import lazy_loader

__version__ = "0.1.0"

__getattr__, __dir__, __all__ = lazy_loader.attach(
    __name__,
    submodules=["course", "plots", "systems", "widgets"],
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
        "modeling.inertia": ["PrincipalAxes", "inertia_tensor", "parallel_axis", "principal_axes"],
        "modeling.kinematics": [
            "AccelerationTerms",
            "VectorDerivative",
            "acceleration_terms",
            "vector_derivative",
        ],
        "modeling.lagrange": ["lagrange"],
        "modeling.newton": ["FreeBody", "newton_euler"],
        "analysis.branches": ["Branch", "BranchPoint", "BranchSet", "continue_equilibria"],
        "analysis.equilibrium": ["Equilibrium", "EquilibriumSet", "equilibria"],
        "analysis.linear": ["LinearSystem", "eigenvalues", "linearize"],
        "analysis.stability": ["Stability", "stability"],
    },
)
