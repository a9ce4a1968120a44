from . import course, plots, shapes, solids, systems, widgets
from .analysis.branches import Branch, BranchPoint, BranchSet, continue_equilibria
from .analysis.characteristic import characteristic_polynomial
from .analysis.convergence import Convergence, growth_factor, measure_order, stability_limit
from .analysis.damped_modes import DampedModes, damped_modes
from .analysis.energy_audit import EnergyAudit
from .analysis.ensemble import Ensemble, ensemble
from .analysis.equilibrium import Equilibrium, EquilibriumSet, equilibria
from .analysis.events import Event
from .analysis.integrators import Integration, integrate, step_table
from .analysis.linear import LinearSystem, eigenvalues, linearize
from .analysis.modal_comparison import ModeBranches, mac, track_modes
from .analysis.modes import Modes, modes
from .analysis.random_response import response_psd
from .analysis.response import FrequencyResponse, frequency_response
from .analysis.routh import RouthTable, routh_table
from .analysis.routh_limits import StabilityLimit, routh_limits
from .analysis.simulation import simulate
from .analysis.stability import Stability, stability
from .analysis.stability_map import StabilityMap, stability_map
from .analysis.sweeps import sweep
from .analysis.time_history import TimeHistory
from .analysis.transfer import transfer_function
from .analysis.transmissibility import transmissibility
from .analysis.undamped import natural_frequencies
from .dimensions import DimensionCheck, check_dimensions
from .errors import (
    EngdynError,
    EngdynWarning,
    OutsideRingError,
    ParameterError,
    RecordError,
    UnknownSystemError,
)
from .experiment.averaging import AveragedSpectrum, Spectrogram, averaged_spectrum, spectrogram
from .experiment.cross import CrossSpectrum, EstimatedResponse, cross_spectral_density, estimate_frf
from .experiment.decimation import DecimatedRecord, decimate
from .experiment.excitation import Excitation, chirp, impact, random_noise, sine
from .experiment.fitting import Fit, fit
from .experiment.fourier import (
    dft,
    dft_by_symmetry,
    fft,
    fft_recursive,
    fourier_coefficients,
    idft,
)
from .experiment.identification import Decrement, HalfPower, half_power, log_decrement
from .experiment.modal_fit import ModalFit, fit_modes
from .experiment.operations import operation_counts
from .experiment.reading import read_record
from .experiment.spectra import alias_frequency, amplitude_spectrum, motion_psd, power_spectral_density
from .experiment.virtual_test import Sensor, virtual_test
from .experiment.windows import amplitude_correction, energy_correction, equivalent_noise_bandwidth, window
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
from .record import Record
from .spectrum import (
    Spectrum,
    cumulative_mean_square,
    earthquake_spectrum,
    mean_square,
    road_spectrum,
    white_noise,
)
from .system import System

__version__: str
__all__ = [
    "AccelerationTerms",
    "AngularMotion",
    "AveragedSpectrum",
    "Branch",
    "BranchPoint",
    "BranchSet",
    "Convergence",
    "Coordinate",
    "CrossSpectrum",
    "DampedModes",
    "DecimatedRecord",
    "Decrement",
    "Definiteness",
    "DimensionCheck",
    "EnergyAudit",
    "EngdynError",
    "EngdynWarning",
    "Ensemble",
    "EquationsOfMotion",
    "Equilibrium",
    "EquilibriumSet",
    "EstimatedResponse",
    "EulerEquations",
    "Event",
    "Excitation",
    "Fit",
    "FreeBody",
    "FreePrecession",
    "FrequencyResponse",
    "HalfPower",
    "Input",
    "Integration",
    "KinematicChain",
    "LagrangeSteps",
    "LinearSystem",
    "ModalFit",
    "ModeBranches",
    "Modes",
    "MomentBalance",
    "OutsideRingError",
    "Parameter",
    "ParameterError",
    "PrincipalAxes",
    "Proof",
    "Record",
    "RecordError",
    "RouthTable",
    "Sensor",
    "Spectrogram",
    "Spectrum",
    "Stability",
    "StabilityLimit",
    "StabilityMap",
    "StandardForm",
    "SteadyPrecession",
    "System",
    "TimeHistory",
    "UnknownSystemError",
    "VectorDerivative",
    "acceleration_terms",
    "alias_frequency",
    "amplitude_correction",
    "amplitude_spectrum",
    "angular_momentum",
    "angular_motion",
    "averaged_spectrum",
    "characteristic_polynomial",
    "check_dimensions",
    "check_potential",
    "chirp",
    "components",
    "continue_equilibria",
    "course",
    "cross_spectral_density",
    "cumulative_mean_square",
    "damped_modes",
    "damper_dissipation",
    "decimate",
    "dft",
    "dft_by_symmetry",
    "earthquake_spectrum",
    "eigenvalues",
    "energy_correction",
    "ensemble",
    "equilibria",
    "equivalent_noise_bandwidth",
    "estimate_frf",
    "euler_equations",
    "fft",
    "fft_recursive",
    "fit",
    "fit_modes",
    "fourier_coefficients",
    "free_precession",
    "frequency_response",
    "generalized_forces",
    "gravity_potential",
    "growth_factor",
    "half_power",
    "idft",
    "impact",
    "inertia_tensor",
    "integrate",
    "kinetic_energy",
    "lagrange",
    "linearize",
    "log_decrement",
    "mac",
    "mean_square",
    "measure_order",
    "modes",
    "moment_balance",
    "motion_at",
    "motion_psd",
    "natural_frequencies",
    "newton_euler",
    "operation_counts",
    "parallel_axis",
    "plots",
    "potential_of",
    "power_spectral_density",
    "principal_axes",
    "prove_equal",
    "random_noise",
    "read_record",
    "response_psd",
    "road_spectrum",
    "rotate_tensor",
    "rotation_matrix",
    "routh_limits",
    "routh_table",
    "shapes",
    "simulate",
    "sine",
    "solids",
    "spectrogram",
    "spring_potential",
    "stability",
    "stability_limit",
    "stability_map",
    "standard_form",
    "steady_precession",
    "step_table",
    "sweep",
    "systems",
    "track_modes",
    "transfer_function",
    "transmissibility",
    "vector_derivative",
    "virtual_test",
    "white_noise",
    "widgets",
    "window",
]
