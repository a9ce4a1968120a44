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
        "analysis.modal_comparison": ["ModeBranches", "mac", "track_modes"],
        "analysis.modes": ["Modes", "modes"],
        "analysis.undamped": ["natural_frequencies"],
        "analysis.damped_modes": ["DampedModes", "damped_modes"],
        "analysis.characteristic": ["characteristic_polynomial"],
        "analysis.routh": ["RouthTable", "routh_table"],
        "analysis.routh_limits": ["StabilityLimit", "routh_limits"],
        "analysis.stability": ["Stability", "stability"],
        "analysis.random_response": ["response_psd"],
        "analysis.response": ["FrequencyResponse", "frequency_response"],
        "analysis.transfer": ["transfer_function"],
        "analysis.transmissibility": ["transmissibility"],
        "spectrum": [
            "Spectrum",
            "cumulative_mean_square",
            "earthquake_spectrum",
            "mean_square",
            "road_spectrum",
            "white_noise",
        ],
        "analysis.stability_map": ["StabilityMap", "stability_map"],
        "record": ["Record"],
        "dimensions": ["DimensionCheck", "check_dimensions"],
        "experiment.excitation": ["Excitation", "chirp", "impact", "random_noise", "sine"],
        "experiment.fitting": ["Fit", "fit"],
        "experiment.identification": ["Decrement", "HalfPower", "half_power", "log_decrement"],
        "experiment.modal_fit": ["ModalFit", "fit_modes"],
        "experiment.reading": ["read_record"],
        "experiment.virtual_test": ["Sensor", "virtual_test"],
        "experiment.averaging": ["AveragedSpectrum", "Spectrogram", "averaged_spectrum", "spectrogram"],
        "experiment.cross": ["CrossSpectrum", "EstimatedResponse", "cross_spectral_density", "estimate_frf"],
        "experiment.decimation": ["DecimatedRecord", "decimate"],
        "experiment.fourier": [
            "dft",
            "dft_by_symmetry",
            "fft",
            "fft_recursive",
            "fourier_coefficients",
            "idft",
        ],
        "experiment.operations": ["operation_counts"],
        "experiment.spectra": [
            "alias_frequency",
            "amplitude_spectrum",
            "motion_psd",
            "power_spectral_density",
        ],
        "experiment.windows": [
            "amplitude_correction",
            "energy_correction",
            "equivalent_noise_bandwidth",
            "window",
        ],
        "analysis.convergence": ["Convergence", "growth_factor", "measure_order", "stability_limit"],
        "analysis.energy_audit": ["EnergyAudit"],
        "analysis.ensemble": ["Ensemble", "ensemble"],
        "analysis.events": ["Event"],
        "analysis.integrators": ["Integration", "integrate", "step_table"],
        "analysis.simulation": ["simulate"],
        "analysis.sweeps": ["sweep"],
        "analysis.time_history": ["TimeHistory"],
    },
)

if "IPython" in sys.modules:  # by name: the package itself stands below all of its layers
    import_module("engdyn.display").register()
