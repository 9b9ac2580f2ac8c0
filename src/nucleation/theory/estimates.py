"""Estimates for a run from its parameters alone: process zone, time until nucleation."""

import math
from typing import NamedTuple

import numpy as np

from ..model.friction.law import Friction
from ..model.linearised import linearised
from ..model.material import ANTIPLANE
from ..model.parameters import Parameters
from .of_runs import pair_of
from .stiffness import SATURATION

THIN = 1e-3  # layer number k H at which a body is thin

FRESH = 1e-12  # Omega of an interface that has only just come to rest
NEAR_STEADY = 1e-9  # relative, of omega: round-off of D/V is no age
POINTS, WEIGHTS = np.polynomial.legendre.leggauss(64)  # on (-1, 1)


class _SlipStiffness(NamedTuple):
    """How bodies resist slip of wavenumber k: ``thick k`` if they are thick, ``thin k^2`` if thin.

    For a block on a rigid base these are the customary ``mu/(1 - nu)`` (Pa) and ``2 mu H/(1 - nu)``
    (Pa m), in antiplane shear ``mu`` and ``mu H``. For two blocks they are the limits of the
    theory's ``mu k G1``, which are mainly those of the softer one. Two thin blocks also bend, which
    makes them four times as compliant.
    """

    thick: float
    thin: float


def stiffness_of(parameters: Parameters) -> _SlipStiffness:
    """The limits of the stiffness of a run's bodies against slip."""
    if parameters.below is None:
        material = parameters.material
        thick = material.shear_modulus / (1.0 - material.in_plane_ratio)
        sides = 1.0 if material.plane == ANTIPLANE else 2.0
        return _SlipStiffness(thick, sides * parameters.geometry.height * thick)
    pair = pair_of([parameters])
    heights = parameters.geometry.height, parameters.below.geometry.height
    short = SATURATION / min(heights)
    long = THIN / max(heights)
    resistance = pair.modulus * pair.stiffness(np.array([short, long])).xx
    return _SlipStiffness(float(resistance[0]), float(resistance[1]) / long)


def steepness(
    friction: Friction,
    omega: float,
) -> float:
    """How much faster friction weakens with slip at a front than it does by its linearisation.

    Parameters
    ----------
    friction : Friction
        The law; only its state evolution ``g`` matters.
    omega : float
        ``phi V/D`` of the interface that the front reaches.

    Returns
    -------
    float
        At least 1; 1 for the aging law at every `omega`.

    Notes
    -----
    Slip at a constant rate reduces Omega from its first value to 1, by ``D dOmega/d delta = g``,
    and friction by ``b log(Omega)``. The fracture energy of this drop is ``b D`` times ``E = int u
    exp(u)/(-g(exp(u))) du`` from 0 to ``U = log(Omega)``. Friction weakens on average at ``(b/D)
    U^2/(2 E)``, and near steady sliding at ``b/D``; the larger of both counts. For the slip law ``E
    = U``; for ``g = (1 - Omega^2)/2`` E is never above pi^2/4.
    """
    if omega <= 1.0 + NEAR_STEADY:
        return 1.0
    drop = math.log(omega)
    u = 0.5 * drop * (1.0 + POINTS)
    rates = friction.evolution_law.growth(np.exp(u))
    integrand = u * np.exp(u) / -rates
    energy = 0.5 * drop * float(WEIGHTS @ integrand)
    return max(drop**2 / (2.0 * energy), 1.0)


def process_zone(
    parameters: Parameters,
    rest: float = 0.0,
) -> float:
    """Length (m) over which friction at the front weakens.

    Parameters
    ----------
    parameters : Parameters
        Of the run.
    rest : float
        Time (s) for which the interface has been at rest when the front reaches it; in many laws
        it ages meanwhile.

    Returns
    -------
    float
        Infinite if friction does not weaken.

    Notes
    -----
    The wavelength over 2 pi at which the body's stiffness equals friction's weakening with slip,
    ``s b sigma0/D``, with ``b = a + zeta`` and the :func:`steepness` s of the state evolution: in a
    thick body ``L_b/s``, ``L_b = mu D/((1 - nu) b sigma0)`` (Dieterich, 1992; Rubin and Ampuero,
    2005), in a thin block ``sqrt(2 H L_b/s)``. The smaller of both counts. Two blocks act by
    their joint stiffness (:func:`stiffness_of`).
    """
    friction, loading = parameters.friction, parameters.loading
    interface = linearised(friction, loading)
    weakening = (interface.a + interface.zeta) * loading.normal_stress
    if weakening <= 0.0:
        return math.inf
    age = loading.initial_state + rest * float(friction.evolution_law.growth(FRESH))
    weakening *= steepness(friction, age / parameters.memory_time)
    stiffness = stiffness_of(parameters)
    scale = friction.slip_distance / weakening
    in_thick_body = stiffness.thick * scale
    in_thin_body = math.sqrt(stiffness.thin * scale)
    return min(in_thick_body, in_thin_body)


def growth_time(
    parameters: Parameters,
    length: float,
) -> float:
    """Time until the creep patch has a length, roughly.

    Parameters
    ----------
    parameters : Parameters
        Of the run.
    length : float
        Length (m) of the patch.

    Returns
    -------
    float
        Time (s) from the start of the run.

    Notes
    -----
    The edge's displacement ``V t`` that moves a patch against ``f sigma0``: ``(1 - nu)/mu f sigma0
    [L^2/(4 H) + L]``. The first term compresses a thin block, the second a thick one; two blocks
    act by their joint stiffness (:func:`stiffness_of`). In the simulations of the paper's study the
    force drops at 0.5 to 0.8 of the time for the theory's critical length.
    """
    loading = parameters.loading
    if loading.kind != "edge":
        return _time_to_strength(parameters)
    stiffness = stiffness_of(parameters)
    strength = linearised(parameters.friction, loading).friction * loading.normal_stress
    moved = length**2 / (2.0 * stiffness.thin) + length / stiffness.thick
    return strength * moved / loading.velocity


def _time_to_strength(parameters: Parameters) -> float:
    """Time (s) until a remote load has brought the whole interface to its peak strength.

    The peak is the strength of sliding at V, plus that of the interface's greater age at the start.
    """
    loading = parameters.loading
    sliding = linearised(parameters.friction, loading)
    omega = loading.initial_state * loading.velocity / sliding.slip_length
    peak = sliding.friction + (sliding.a + sliding.zeta) * np.log1p(omega)
    missing = peak * loading.normal_stress - loading.initial_shear_stress
    return max(missing, 0.0) / loading.stress_rate
