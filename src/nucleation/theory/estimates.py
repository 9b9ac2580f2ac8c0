"""Rough measures of a run from its parameters alone: process zone, time until nucleation."""

import math
from typing import NamedTuple

import numpy as np

from ..model.friction.law import Friction
from ..model.linearised import linearised
from ..model.material import ANTIPLANE
from ..model.parameters import Parameters
from .stiffness import SATURATION, Pair
from .transfer import bodies_of

THIN = 1e-3  # layer number k H at which a body is thin

FRESH = 1e-12  # Omega of an interface that has only just come to rest
NEAR_STEADY = 1e-9  # relative, of omega: round-off of D/V is no age
POINTS, WEIGHTS = np.polynomial.legendre.leggauss(64)  # on (-1, 1)


class Stiffness(NamedTuple):
    """How bodies resist slip of wavenumber k: ``thick k`` if they are thick, ``thin k^2`` if thin.

    For a block on a rigid base the customary ``mu/(1 - nu)`` (Pa) and ``2 mu H/(1 - nu)`` (Pa m),
    in antiplane shear ``mu`` and ``mu H``;
    for two blocks ``mu k G1`` of the theory in both limits, the softer one's in the main. Thin
    blocks that slip on one another bend as well, which makes them four times as soft.
    """

    thick: float
    thin: float


def stiffness_of(parameters: Parameters) -> Stiffness:
    """That of a run's bodies."""
    if parameters.below is None:
        material = parameters.material
        thick = material.shear_modulus / (1.0 - material.in_plane_ratio)
        sides = 1.0 if material.plane == ANTIPLANE else 2.0
        return Stiffness(thick, sides * parameters.geometry.height * thick)
    pair = Pair(*(body.layers for body in bodies_of(parameters)))
    heights = parameters.geometry.height, parameters.below.geometry.height
    short, long = SATURATION / min(heights), THIN / max(heights)
    resistance = pair.modulus * pair.stiffness(np.array([short, long])).xx
    return Stiffness(float(resistance[0]), float(resistance[1]) / long)


def steepness(friction: Friction, omega: float) -> float:
    """How much faster friction weakens with slip at a front than it does by its linearisation.

    Parameters
    ----------
    friction : Friction
        Of which the state evolution ``g`` counts.
    omega : float
        ``phi V/D`` of the interface that the front reaches.

    Returns
    -------
    float
        At least 1; 1 for the aging law, whatever `omega` is.

    Notes
    -----
    Slip at a constant rate takes Omega from its first value down to 1, as ``D dOmega/d delta = g``,
    and friction falls by ``b log(Omega)``. Over the drop's fracture energy, which is ``b D`` times
    ``E = int u exp(u)/(-g(exp(u))) du`` from 0 to ``U = log(Omega)``, friction weakens on average
    at ``(b/D) U^2/(2 E)``, and near steady sliding at ``b/D``. The larger of both counts. For the
    slip law ``E = U``; for ``g = (1 - Omega^2)/2`` E is never above pi^2/4.
    """
    if omega <= 1.0 + NEAR_STEADY:
        return 1.0
    drop = math.log(omega)
    u = 0.5 * drop * (1.0 + POINTS)
    rates = friction.evolution_law.growth(np.exp(u))
    energy = 0.5 * drop * float(WEIGHTS @ (u * np.exp(u) / -rates))
    return max(drop**2 / (2.0 * energy), 1.0)


def process_zone(parameters: Parameters, rest: float = 0.0) -> float:
    """Length (m) over which friction at the front weakens.

    Parameters
    ----------
    parameters : Parameters
        Of the run.
    rest : float
        Time (s) for which the interface has been at rest when the front reaches it: in many laws
        it grows older meanwhile.

    Returns
    -------
    float
        Infinite if friction does not weaken.

    Notes
    -----
    The wavelength over 2 pi at which the body's stiffness equals friction's weakening with slip,
    ``s b sigma0/D``, with ``b = a + zeta`` and the :func:`steepness` s of the state evolution: in a
    thick body ``L_b/s``, ``L_b = mu D/((1 - nu) b sigma0)`` (Dieterich, 1992; Rubin and Ampuero,
    2005), in a thin block ``sqrt(2 H L_b/s)``. The smaller of both; of two blocks with the
    stiffness of both (:class:`Stiffness`).
    """
    friction, loading = parameters.friction, parameters.loading
    interface = linearised(friction, loading)
    weakening = (interface.a + interface.zeta) * loading.normal_stress
    if weakening <= 0.0:
        return math.inf
    age = loading.initial_state + rest * float(friction.evolution_law.growth(FRESH))
    weakening *= steepness(friction, age / parameters.memory_time)
    stiffness = stiffness_of(parameters)
    scale = friction.characteristic_slip_distance / weakening
    return min(stiffness.thick * scale, math.sqrt(stiffness.thin * scale))


def growth_time(parameters: Parameters, length: float) -> float:
    """Time (s) until the creep patch has a length (m), roughly.

    Notes
    -----
    The edge's displacement ``V t`` that moves a patch against ``f sigma0``: ``(1 - nu)/mu f sigma0
    [L^2/(4 H) + L]``, the first term compressing a thin block, the second a thick one; of two
    blocks with the stiffness of both (:class:`Stiffness`). In the
    simulations of the paper's study the force drops at 0.5 to 0.8 of the time for the theory's
    critical length.
    """
    loading, stiffness = parameters.loading, stiffness_of(parameters)
    if loading.kind != "edge":
        return _time_to_strength(parameters)
    strength = linearised(parameters.friction, loading).friction * loading.normal_stress
    moved = length**2 / (2.0 * stiffness.thin) + length / stiffness.thick
    return strength * moved / loading.velocity


def _time_to_strength(parameters: Parameters) -> float:
    """Time (s) until a load without an edge has brought the whole interface to its strength.

    That of sliding at V, and what the interface is older at the start than it is then.
    """
    loading = parameters.loading
    sliding = linearised(parameters.friction, loading)
    older = np.log1p(loading.initial_state * loading.velocity / sliding.slip_length)
    peak = sliding.friction + (sliding.a + sliding.zeta) * older
    missing = max(peak * loading.normal_stress - loading.initial_shear_stress, 0.0)
    return missing / loading_rate(parameters)


def loading_rate(parameters: Parameters) -> float:
    """Rise (Pa/s) of the shear stress on an interface that a top, or a far stress, loads."""
    loading, below = parameters.loading, parameters.below
    if loading.kind == "remote":
        return loading.stress_rate
    compliance = parameters.geometry.height / parameters.material.shear_modulus
    if below is not None:
        compliance += below.geometry.height / below.material.shear_modulus
    return loading.velocity / compliance
