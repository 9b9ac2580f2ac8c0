"""Claims on the friction law: its constants at V, its branches, its perturbation (Text S2.1)."""

import math
from typing import Any

import numpy as np

from nucleation.model.friction.evolutions import aging, slip
from nucleation.types import Array

from ..tables.curves import logarithmic_friction
from . import printed
from .evidence import Evidence
from .verdicts import Computation, Missing

_SLIP_RATES = np.geomspace(1e-11, 10.0, 4801)  # m/s


def _logarithmic(evidence: Evidence) -> Array:
    """Logarithmic over full law around V and D/V."""
    law, velocity = evidence.friction, evidence.velocity
    factors = np.geomspace(0.1, 10.0, 41)
    v, phi = np.meshgrid(velocity * factors, law.steady_state(velocity) * factors)
    return logarithmic_friction(law, v, phi, velocity) / law.coefficient(v, phi)


def steady_extremes(evidence: Evidence) -> tuple[float, float]:
    """Slip rates (m/s) of the maximum and the minimum of steady-state friction around V."""
    velocity = evidence.velocity
    friction = evidence.friction.steady_coefficient(_SLIP_RATES)
    turns = np.diff(np.sign(np.diff(friction)))
    rates = _SLIP_RATES[1:-1]
    maxima = rates[(turns < 0) & (rates < velocity)]
    minima = rates[(turns > 0) & (rates > velocity)]
    if not maxima.size or not minima.size:
        raise Missing("Steady-state friction has no velocity-weakening branch around V")
    return float(maxima[-1]), float(minima[0])


def _decades_of_agreement(evidence: Evidence) -> float:
    """Decades of slip rate around V, within the branch, with a difference of less than 2 %."""
    law, velocity = evidence.friction, evidence.velocity
    first, after = np.searchsorted(_SLIP_RATES, steady_extremes(evidence))
    v = _SLIP_RATES[first:after]
    logarithmic = logarithmic_friction(law, v, law.slip_distance / v, velocity)
    off = np.flatnonzero(np.abs(logarithmic / law.steady_coefficient(v) - 1.0) >= 0.02)
    middle = int(np.abs(np.log(v / velocity)).argmin())
    lowest = off[off < middle].max(initial=-1) + 1
    highest = off[off > middle].min(initial=v.size) - 1
    return math.log10(v[highest] / v[lowest])


def _slopes(evidence: Evidence) -> list[Any]:
    """g'(1) of both evolution laws, by central differences."""
    step = 1e-5
    laws = aging.growth, slip.growth
    return [(g(1 + step) - g(1 - step)) / (2.0 * step) for g in laws]


def _friction_perturbation(evidence: Evidence) -> Array:
    """``|ratio - 1|`` of the linearised law and state over the printed formula, ell/V = 1."""
    _, a, zeta = evidence.at_v
    rate = np.array([0.3 + 1j, 0.1 + 2j, 1j])
    state = -rate / (rate + 1.0)  # relative change of phi for a change of slip rate
    ours = a * rate + (a + zeta) * state
    return np.abs(ours / printed.friction_perturbation(rate, a, zeta) - 1.0)


NUMBERS: dict[str, Computation] = {
    "f0-table": lambda e: e.at_v.f0,
    "f0-main": lambda e: e.at_v.f0,
    "a-table": lambda e: e.at_v.a,
    "a-main": lambda e: e.at_v.a,
    "zeta-table": lambda e: e.at_v.zeta,
    "zeta-main": lambda e: e.at_v.zeta,
    "weakening-at-v": lambda e: e.at_v.zeta,
    "slip-rate-over-v0": lambda e: math.log10(e.velocity / e.friction.regularisation_slip_rate),
    "friction-vanishes": lambda e: (
        e.friction.coefficient(1e-5 * e.friction.regularisation_slip_rate, 1.0) / e.at_v.f0
    ),
    "logarithmic-law": _logarithmic,
    "steady-agreement": _decades_of_agreement,
    "strengthening-branch": lambda e: steady_extremes(e)[1] / e.velocity,
    "weakening-branch": lambda e: e.velocity / steady_extremes(e)[0],
    "state-rate-at-v": lambda e: e.friction.slip_speed(e.velocity) / e.velocity,
    "evolution-slope": _slopes,
    "friction-perturbation": _friction_perturbation,
}
"""The function of each claim, by its id."""
