"""Rough measures of a run from its parameters alone: process zone, time until nucleation."""

from __future__ import annotations

import math

from ..model.linearised import linearised
from ..model.parameters import Parameters


def process_zone(parameters: Parameters) -> float:
    """Length (m) over which friction at the front weakens.

    Notes
    -----
    The wavelength over 2 pi at which the body's stiffness equals friction's fastest weakening
    ``b sigma0/D``, ``b = a + zeta``: in a thick body ``L_b = mu D/((1 - nu) b sigma0)`` (Dieterich,
    1992; Rubin and Ampuero, 2005), in a thin block ``sqrt(2 H L_b)``. The smaller of both.
    """
    material, friction, loading = parameters.material, parameters.friction, parameters.loading
    interface = linearised(friction, loading)
    weakening = (interface.a + interface.zeta) * loading.normal_stress
    if weakening <= 0.0:
        return math.inf
    stiffness = material.shear_modulus / (1.0 - material.poisson_ratio)
    thick = stiffness * friction.characteristic_slip_distance / weakening
    return min(thick, math.sqrt(2.0 * parameters.geometry.height * thick))


def growth_time(parameters: Parameters, length: float) -> float:
    """Time (s) until the creep patch has a length (m), roughly.

    Notes
    -----
    The edge's displacement ``V t`` that moves a patch against ``f sigma0``: ``(1 - nu)/mu f sigma0
    [L^2/(4 H) + L]``, the first term compressing a thin block, the second a thick one. In the
    simulations of the paper's study the force drops at 0.5 to 0.8 of the time for the theory's
    critical length.
    """
    loading, material = parameters.loading, parameters.material
    strength = linearised(parameters.friction, loading).friction * loading.normal_stress
    reach = length**2 / (4.0 * parameters.geometry.height) + length
    compliance = (1.0 - material.poisson_ratio) / material.shear_modulus
    return compliance * strength * reach / loading.velocity
