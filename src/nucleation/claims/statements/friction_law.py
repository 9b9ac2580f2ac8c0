"""Claims on the friction law: Sect. 5's values, Table S1, Text S2.1 and Fig. S1."""

import math
from functools import partial

import numpy as np

from ...configuration.roles import JUDGED, PAPERS
from ...types import Array
from ..claim import Result
from ..evidence import Evidence, on_both
from ..said import Missing

FINE = np.geomspace(1e-11, 10.0, 4801)  # m/s


def _at_v(coefficient: int, evidence: Evidence) -> float:
    """A coefficient of the expansion (f, a, zeta) at V."""
    return evidence.friction.expansion(evidence.loading.velocity)[coefficient]


f0_table, a_table, zeta_table = f0_main, a_main, zeta_main = [partial(_at_v, i) for i in range(3)]
weakening_at_v = zeta_table


def slip_rate_over_v0(evidence: Evidence) -> float:
    return math.log10(evidence.loading.velocity / evidence.friction.regularisation_slip_rate)


def friction_vanishes(evidence: Evidence) -> float:
    law = evidence.friction
    f = law.coefficient(1e-5 * law.regularisation_slip_rate, 1.0)
    return float(f / law.expansion(evidence.loading.velocity).f0)


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


def strengthening_branch(evidence: Evidence) -> float:
    return steady_extremes(evidence)[1] / evidence.loading.velocity


def weakening_branch(evidence: Evidence) -> float:
    return evidence.loading.velocity / steady_extremes(evidence)[0]


@on_both
def minimum_plays_no_role(evidence: Evidence, role: str) -> list[float]:
    minimum = steady_extremes(evidence)[1]
    return [run.onset_rate / minimum for run in evidence.each_measured(role)]


@on_both
def regularisation_irrelevant(evidence: Evidence, role: str) -> list[float]:
    return [run.regular_share for run in evidence.each_measured(role)]


def state_rate_at_v(evidence: Evidence) -> float:
    velocity = evidence.loading.velocity
    return float(evidence.friction.slip_speed(velocity) / velocity)


def _well_approximated(part: str, evidence: Evidence) -> Result:
    """Where the slip law with v is good: the least of all its runs, of either study."""
    judged, papers = (
        [getattr(run, part) for run in evidence.each_measured(role, evolution="slip")]
        for role in (JUDGED, PAPERS)
    )
    return Result(judged, on_papers_mesh=papers)


slip_law_approximation = partial(_well_approximated, "state_rate_share_patch")
slip_law_approximation_ahead = partial(_well_approximated, "state_rate_share")
