"""Linear stability of homogeneous frictional sliding and the critical nucleation length.

For a pair of elastic bodies (:mod:`.transfer`) and a linearised rate-and-state interface
(:mod:`.spectrum`) the critical nucleation length is ``L_c = 2 pi / k_c`` with k_c the largest
marginally stable wavenumber (:mod:`.critical`). Special systems: :mod:`.closed_forms`; the
conventional approach: :mod:`.conventional`; other lengths: :mod:`nucleation.nucleation_lengths`.
"""

from .closed_forms import (
    bimaterial_contrast,
    bimaterial_length,
    bimaterial_length_ratio,
    bimaterial_modulus,
    half_spaces_length,
    thin_limit_length,
    uncoupled_angular_frequency,
    velocity_strengthening_threshold,
)
from .critical import CriticalPoint, NoInstability, critical_length, critical_wavenumber
from .spectrum import InterfaceState, growth_rates, spectrum_branches
from .transfer import RIGID, Body, RigidBody, response_matrix, transfer_functions

__all__ = [
    "RIGID",
    "Body",
    "CriticalPoint",
    "InterfaceState",
    "NoInstability",
    "RigidBody",
    "bimaterial_contrast",
    "bimaterial_length",
    "bimaterial_length_ratio",
    "bimaterial_modulus",
    "critical_length",
    "critical_wavenumber",
    "growth_rates",
    "half_spaces_length",
    "response_matrix",
    "spectrum_branches",
    "thin_limit_length",
    "transfer_functions",
    "uncoupled_angular_frequency",
    "velocity_strengthening_threshold",
]
