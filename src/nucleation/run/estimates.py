"""Estimates for a simulated fault: process zone, time until nucleation, sizes of elements."""

import math
from typing import NamedTuple

import numpy as np

from ..fault import Fault
from ..model.friction import Friction
from ..model.material import ANTIPLANE, in_plane_ratio
from ..model.settings import Start
from ..theory.evaluation import single_system
from ..theory.stiffness import SATURATION

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


def stiffness_of(fault: Fault) -> _SlipStiffness:
    """The limits of the stiffness of a fault's bodies against slip."""
    if math.isinf(fault.second_shear_modulus):
        thick = fault.shear_modulus / (1.0 - in_plane_ratio(fault.poisson_ratio, fault.plane))
        sides = 1.0 if fault.plane == ANTIPLANE else 2.0
        return _SlipStiffness(thick, sides * fault.height * thick)
    pair = single_system(fault).pair
    heights = fault.height, fault.second_height
    short = SATURATION / min(heights)
    long = THIN / max(heights)
    resistance = pair.modulus * pair.stiffness(np.array([short, long])).xx
    return _SlipStiffness(float(resistance[0]), float(resistance[1]) / long)


def steepness(friction: Friction, omega: float) -> float:
    """How much faster friction weakens with slip at a front than it does by its linearisation.

    `omega` is ``phi V/D`` of the interface that the front reaches; 1 for the aging law.

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


def process_zone(fault: Fault, law: Friction, rest: float = 0.0) -> float:
    """Length (m) over which friction at the front weakens; infinite if it does not weaken.

    The interface has been at rest for the time `rest` (s) when the front reaches it; in many laws
    it ages meanwhile.

    The wavelength over 2 pi at which the body's stiffness equals friction's weakening with slip,
    ``s b sigma0/D``, with ``b = a + zeta`` and the :func:`steepness` s of the state evolution: in a
    thick body ``L_b/s``, ``L_b = mu D/((1 - nu) b sigma0)`` (Dieterich, 1992; Rubin and Ampuero,
    2005), in a thin block ``sqrt(2 H L_b/s)``. The smaller of both counts. Two blocks act by
    their joint stiffness (:func:`stiffness_of`).
    """
    weakening = (fault.a + fault.zeta) * fault.normal_stress
    if weakening <= 0.0:
        return math.inf
    age = fault.initial_state + rest * float(law.evolution_law.growth(FRESH))
    weakening *= steepness(law, age * fault.velocity / law.slip_distance)
    stiffness = stiffness_of(fault)
    scale = law.slip_distance / weakening
    in_thick_body = stiffness.thick * scale
    in_thin_body = math.sqrt(stiffness.thin * scale)
    return min(in_thick_body, in_thin_body)


def growth_time(fault: Fault, start: Start, length: float) -> float:
    """Time (s) from the start until the creep patch has a length (m), roughly.

    The edge's displacement ``V t`` that moves a patch against ``f sigma0``: ``(1 - nu)/mu f sigma0
    [L^2/(4 H) + L]``. The first term compresses a thin block, the second a thick one; two blocks
    act by their joint stiffness (:func:`stiffness_of`). In the simulations of the paper's study the
    force drops at 0.5 to 0.8 of the time for the theory's critical length.
    """
    if fault.loading != "edge":
        return _time_to_strength(fault, start)
    stiffness = stiffness_of(fault)
    strength = fault.friction * fault.normal_stress
    moved = length**2 / (2.0 * stiffness.thin) + length / stiffness.thick
    return strength * moved / fault.velocity


def _time_to_strength(fault: Fault, start: Start) -> float:
    """Time (s) until a remote load has brought the whole interface to its peak strength.

    The peak is the strength of sliding at V, plus that of the interface's greater age at the start.
    """
    omega = fault.initial_state * fault.velocity / fault.slip_distance
    peak = fault.friction + (fault.a + fault.zeta) * np.log1p(omega)
    missing = peak * fault.normal_stress - start.initial_shear_stress
    return max(missing, 0.0) / start.stress_rate


def element_height(height: float, n_y: int, grading: float) -> float:
    """Height (m) of the elements at the interface of a body that is `height` (m) high."""
    growth = grading ** (1.0 / (n_y - 1))
    return height / sum(growth**row for row in range(n_y))
