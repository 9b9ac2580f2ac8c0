"""Claims on the friction law (Text S2.1, Fig. S1)."""

import math
from collections.abc import Callable

import numpy as np

from nucleation.types import Array

from ...configuration.roles import JUDGED, PAPERS
from ..claim import Computation, Result, Row
from ..evidence import Evidence, of_runs
from ..expected import Missing

_SLIP_RATES = np.geomspace(1e-11, 10.0, 4801)  # m/s


def _at_v(name: str) -> Callable[[Evidence], float]:
    """Friction ``f0``, ``a`` or ``zeta`` at V."""

    def value(evidence: Evidence) -> float:
        expansion = evidence.friction.expansion(evidence.loading.velocity)
        return float(getattr(expansion, name))

    return value


def slip_rate_over_v0(evidence: Evidence) -> float:
    v0 = evidence.friction.regularisation_slip_rate
    return math.log10(evidence.loading.velocity / v0)


def friction_vanishes(evidence: Evidence) -> float:
    law = evidence.friction
    slow = 1e-5 * law.regularisation_slip_rate
    friction = law.coefficient(slow, 1.0)
    return float(friction / _at_v("f0")(evidence))


def logarithmic_law(evidence: Evidence) -> Array:
    law = evidence.friction
    velocity = evidence.loading.velocity
    factors = np.geomspace(0.1, 10.0, 41)
    rates = velocity * factors
    states = law.steady_state(velocity) * factors
    v, phi = np.meshgrid(rates, states)
    logarithmic = law.logarithmic(v, phi, velocity)
    return logarithmic / law.coefficient(v, phi)


def _steady_extremes(evidence: Evidence) -> tuple[float, float]:
    """Slip rates (m/s) of the maximum and the minimum of steady-state friction around V."""
    velocity = evidence.loading.velocity
    friction = evidence.friction.steady_coefficient(_SLIP_RATES)
    slopes = np.sign(np.diff(friction))
    turns = np.diff(slopes) != 0
    extremes = 1 + np.flatnonzero(turns)
    rates = _SLIP_RATES[extremes]
    rising = friction[extremes] > friction[extremes - 1]
    below = rates < velocity
    above = rates > velocity
    maxima = rates[rising & below]
    minima = rates[~rising & above]
    if not maxima.size or not minima.size:
        raise Missing("Steady-state friction has no velocity-weakening branch around V")
    return float(maxima[-1]), float(minima[0])


def steady_agreement(evidence: Evidence) -> float:
    law = evidence.friction
    velocity = evidence.loading.velocity
    extremes = _steady_extremes(evidence)
    first, after = np.searchsorted(_SLIP_RATES, extremes)
    v = _SLIP_RATES[first:after]
    state = law.slip_distance / v
    full = law.steady_coefficient(v)
    logarithmic = law.logarithmic(v, state, velocity)
    difference = np.abs(logarithmic / full - 1.0)
    distance = np.abs(np.log(v / velocity))
    middle = int(distance.argmin())
    off = np.flatnonzero(difference >= 0.02)
    below = off[off < middle]
    above = off[off > middle]
    lowest = below.max(initial=-1) + 1
    highest = above.min(initial=v.size) - 1
    return math.log10(v[highest] / v[lowest])


def weakening_branch(evidence: Evidence) -> float:
    maximum, _ = _steady_extremes(evidence)
    return evidence.loading.velocity / maximum


def _minimum(evidence: Evidence) -> float:
    """The slip rate (m/s) of the minimum of steady-state friction."""
    _, minimum = _steady_extremes(evidence)
    return minimum


def strengthening_branch(evidence: Evidence) -> float:
    return _minimum(evidence) / evidence.loading.velocity


def state_rate_at_v(evidence: Evidence) -> float:
    velocity = evidence.loading.velocity
    regularised = evidence.friction.slip_speed(velocity)
    return float(regularised / velocity)


def _with_slip_law(evidence: Evidence) -> tuple[list[Row], list[Row]]:
    """The converged runs with the slip law, and those on the paper's mesh."""
    converged = evidence.each(JUDGED, evolution="slip")
    return converged, evidence.each(PAPERS, evolution="slip")


def slip_law_approximation(evidence: Evidence) -> Result:
    converged, papers = _with_slip_law(evidence)
    column = "state_rate_share_patch"
    return Result(
        [run[column] for run in converged],
        on_papers_mesh=[run[column] for run in papers],
        mesh=evidence.papers_mesh,
    )


def slip_law_approximation_ahead(evidence: Evidence) -> Result:
    """The relative change of the strength by the healing that v0 alone causes without slip."""
    converged, papers = _with_slip_law(evidence)
    latest = max(converged, key=lambda run: run["onset_time"])
    state = _healed_state(evidence, latest)
    share = min(run["state_rate_share"] for run in converged)
    note = (
        f"At the latest onset the state is {state:.2f} s in the place of "
        f"{latest['initial_state']:.2f} s. Only the relative error of $\\dot\\phi$ is large there: "
        f"it is below 10 % in {share:.2g} of the interface "
        "(results: The slip law ahead of the front)."
    )
    return Result(
        [_strengthened(evidence, run) for run in converged],
        on_papers_mesh=[_strengthened(evidence, run) for run in papers],
        mesh=evidence.papers_mesh,
        note=note,
    )


def _healed_state(evidence: Evidence, run: Row) -> float:
    """State (s) by the slip law at a run's onset where nothing slips: log(phi v0/D) decays."""
    law = evidence.friction
    rate = law.regularisation_slip_rate / law.slip_distance
    decay = math.exp(-rate * run["onset_time"])
    initial = run["initial_state"] * rate
    return float(initial**decay / rate)


def _strengthened(evidence: Evidence, run: Row) -> float:
    """Relative change of friction at V by the healing up to a run's onset."""
    law = evidence.friction
    velocity = evidence.loading.velocity
    state = _healed_state(evidence, run)
    healed = law.coefficient(velocity, state)
    initial = law.coefficient(velocity, run["initial_state"])
    return float(healed / initial - 1.0)


SHORT: dict[str, Computation] = {
    "f0-table": _at_v("f0"),
    "f0-main": _at_v("f0"),
    "a-table": _at_v("a"),
    "a-main": _at_v("a"),
    "zeta-table": _at_v("zeta"),
    "zeta-main": _at_v("zeta"),
    "weakening-at-v": _at_v("zeta"),
    "minimum-plays-no-role": of_runs("onset_rate", _minimum),
    "regularisation-irrelevant": of_runs("regular_share"),
}
