"""Claims on the friction law (Text S2.1, Fig. S1) that need no run."""

import math
from collections.abc import Callable

import numpy as np

from nucleation.types import Array

from .evidence import Evidence
from .expected import Computation, Missing

_SLIP_RATES = np.geomspace(1e-11, 10.0, 4801)  # m/s


def at_v(name: str) -> Callable[[Evidence], float]:
    """Friction ``f0``, ``a`` or ``zeta`` at V."""
    return lambda e: float(getattr(e.friction.expansion(e.fault.velocity), name))


def _vanishing(evidence: Evidence) -> float:
    """Friction at a slip rate far below v0, over f0."""
    law = evidence.friction
    return float(law.coefficient(1e-5 * law.regularisation_slip_rate, 1.0)) / at_v("f0")(evidence)


def _logarithmic(evidence: Evidence) -> Array:
    """Logarithmic over full law around V and D/V."""
    law, velocity = evidence.friction, evidence.fault.velocity
    factors = np.geomspace(0.1, 10.0, 41)
    v, phi = np.meshgrid(velocity * factors, law.steady_state(velocity) * factors)
    return law.logarithmic(v, phi, velocity) / law.coefficient(v, phi)


def steady_extremes(evidence: Evidence) -> tuple[float, float]:
    """Slip rates (m/s) of the maximum and the minimum of steady-state friction around V."""
    velocity = evidence.fault.velocity
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
    law, velocity = evidence.friction, evidence.fault.velocity
    first, after = np.searchsorted(_SLIP_RATES, steady_extremes(evidence))
    v = _SLIP_RATES[first:after]
    logarithmic = law.logarithmic(v, law.slip_distance / v, velocity)
    off = np.flatnonzero(np.abs(logarithmic / law.steady_coefficient(v) - 1.0) >= 0.02)
    middle = int(np.abs(np.log(v / velocity)).argmin())
    lowest = off[off < middle].max(initial=-1) + 1
    highest = off[off > middle].min(initial=v.size) - 1
    return math.log10(v[highest] / v[lowest])


NUMBERS: dict[str, Computation] = {
    "f0-table": at_v("f0"),
    "f0-main": at_v("f0"),
    "a-table": at_v("a"),
    "a-main": at_v("a"),
    "zeta-table": at_v("zeta"),
    "zeta-main": at_v("zeta"),
    "weakening-at-v": at_v("zeta"),
    "slip-rate-over-v0": lambda e: math.log10(
        e.fault.velocity / e.friction.regularisation_slip_rate
    ),
    "friction-vanishes": _vanishing,
    "logarithmic-law": _logarithmic,
    "steady-agreement": _decades_of_agreement,
    "strengthening-branch": lambda e: steady_extremes(e)[1] / e.fault.velocity,
    "weakening-branch": lambda e: e.fault.velocity / steady_extremes(e)[0],
    "state-rate-at-v": lambda e: float(e.friction.slip_speed(e.fault.velocity) / e.fault.velocity),
}
"""The function of each claim, by its id."""
