"""Claims on the friction law: Sect. 5's values, Table S1, Text S2.1 and Fig. S1."""

import math

import numpy as np

from ...configuration.roles import JUDGED, PAPERS
from ...model.friction.law import Expansion
from ...types import Array
from ..claim import Computation, Result
from ..evidence import Evidence, of_runs
from ..said import Missing

FINE = np.geomspace(1e-11, 10.0, 4801)  # m/s


def at_v(evidence: Evidence) -> Expansion:
    """Friction, a and zeta at V."""
    return evidence.friction.expansion(evidence.loading.velocity)


def logarithmic_law(evidence: Evidence) -> Array:
    law, velocity = evidence.friction, evidence.loading.velocity
    factors = np.geomspace(0.1, 10.0, 41)
    v, phi = np.meshgrid(velocity * factors, law.steady_state(velocity) * factors)
    return law.logarithmic(v, phi, velocity) / law.coefficient(v, phi)


def steady_extremes(evidence: Evidence) -> tuple[float, float]:
    """Slip rates (m/s) of the maximum and of the minimum of steady-state friction around V."""
    f = evidence.friction.steady_coefficient(FINE)
    turns = 1 + np.flatnonzero(np.diff(np.sign(np.diff(f))) != 0)
    lower = [i for i in turns if FINE[i] < evidence.loading.velocity and f[i] > f[i - 1]]
    upper = [i for i in turns if FINE[i] > evidence.loading.velocity and f[i] < f[i - 1]]
    if not lower or not upper:
        raise Missing("Steady-state friction has no velocity-weakening branch around V")
    return float(FINE[lower[-1]]), float(FINE[upper[0]])


def steady_agreement(evidence: Evidence) -> float:
    law, velocity = evidence.friction, evidence.loading.velocity
    low, high = steady_extremes(evidence)
    v = FINE[slice(*np.searchsorted(FINE, [low, high]))]
    state = law.characteristic_slip_distance / v
    difference = np.abs(law.logarithmic(v, state, velocity) / law.steady_coefficient(v) - 1.0)
    middle = int(np.abs(np.log(v / velocity)).argmin())
    off = np.flatnonzero(difference >= 0.02)
    first = off[off < middle].max(initial=-1) + 1
    last = off[off > middle].min(initial=v.size) - 1
    return math.log10(v[last] / v[first])


def well_approximated(evidence: Evidence, part: str) -> Result:
    """Where the slip law with v is good: the least of all its runs, of either study."""
    judged, papers = (
        [getattr(run, part) for run in evidence.each_measured(role, evolution="slip")]
        for role in (JUDGED, PAPERS)
    )
    return Result(judged, on_papers_mesh=papers)


OURS: dict[str, Computation] = {
    **{f"f0-{where}": lambda e: at_v(e).f0 for where in ("table", "main")},
    **{f"a-{where}": lambda e: at_v(e).a for where in ("table", "main")},
    **{f"zeta-{where}": lambda e: at_v(e).zeta for where in ("table", "main")},
    "weakening-at-v": lambda e: at_v(e).zeta,
    "slip-rate-over-v0": lambda e: math.log10(
        e.loading.velocity / e.friction.regularisation_slip_rate
    ),
    "friction-vanishes": lambda e: (
        e.friction.coefficient(1e-5 * e.friction.regularisation_slip_rate, 1.0) / at_v(e).f0
    ),
    "strengthening-branch": lambda e: steady_extremes(e)[1] / e.loading.velocity,
    "weakening-branch": lambda e: e.loading.velocity / steady_extremes(e)[0],
    "minimum-plays-no-role": of_runs("onset_rate", lambda e: steady_extremes(e)[1]),
    "regularisation-irrelevant": of_runs("regular_share"),
    "state-rate-at-v": lambda e: e.friction.slip_speed(e.loading.velocity) / e.loading.velocity,
    "slip-law-approximation": lambda e: well_approximated(e, "state_rate_share_patch"),
    "slip-law-approximation-ahead": lambda e: well_approximated(e, "state_rate_share"),
}
"""The claims whose numbers take a line; each of the others has a function with its name."""
