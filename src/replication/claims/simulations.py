"""Claims on simulations: lengths at the drop, the onset, and the course of a run.

(Abstract, Sects. 3 and 5, Figs. 3 and S2, Text S2.)
"""

import itertools
import math

import numpy as np

from nucleation.extraction.measures import BY_DEFINITION

from ..configuration.roles import JUDGED, LONGER, PAPERS
from ..tables.rows import Row
from .evidence import Evidence, of_runs, on_both
from .friction import steady_extremes
from .verdicts import Computation, Estimate, Missing, between

_SHOWN = 0.005  # m: height of Fig. S2
_INSET = 0.1  # m: height of Fig. 3's inset
_RUPTURE = 0.1  # s after its event, by which a run contains the rupture


# -- lengths ------------------------------------------------------------------------------------


def _with_range(row: Row, column: str, unit: float = 1.0) -> Estimate:
    """A number of a row with the ends of its range, in a unit of the column."""
    return between(*(row[f"{column}{end}"] / unit for end in ("", "_low", "_high")))


def _shown(column: str) -> Computation:
    """A number of the run in Figure S2, with its range."""
    return on_both(lambda e, role: _with_range(e.row(role, "aging", _SHOWN), column))


def _heights(evidence: Evidence, role: str) -> list[Row]:
    """The rows of all heights; raises Missing if there are fewer than two."""
    rows = evidence.series(role)
    if len(rows) < 2:
        raise Missing(f"The configuration has no such run: role {role}, another height")
    return rows


def _height_dependence(evidence: Evidence, role: str) -> list[float]:
    ratios = [row["length"] / row["critical_length"] for row in _heights(evidence, role)]
    return [higher / lower for lower, higher in itertools.combinations(ratios, 2)]


def _least_increase(evidence: Evidence, role: str) -> float:
    lengths = [row["length"] for row in _heights(evidence, role)]
    return min(higher / lower for lower, higher in itertools.pairwise(lengths))


def _relative_change(varied: Row, base: Row) -> Estimate:
    """Relative change of the length between two runs; its range is that of the definitions."""
    changes = [varied[column] / base[column] - 1.0 for column in ("length", *BY_DEFINITION)]
    return between(*changes)


def _change_from_aging(height: float, law: str, age: float = 1.0) -> Computation:
    """Relative change of the length by another law or age (s), at one height (m)."""
    return on_both(
        lambda e, role: _relative_change(
            e.row(role, law, height, age), e.row(role, "aging", height)
        )
    )


def _linear_stage(evidence: Evidence) -> list[float]:
    """Changes of the length at which the patch becomes unstable, by another law or age."""
    changes = []
    for varied in evidence.rows(JUDGED):
        if varied["evolution"] != "aging" or varied["initial_state"] != 1.0:
            base = evidence.row(JUDGED, "aging", varied["height"])
            ratio = evidence.stability_length(varied) / evidence.stability_length(base)
            changes.append(ratio - 1.0)
    if not changes:
        raise Missing(f"The configuration has no such run: role {JUDGED}, another law or age")
    return changes


# -- friction in simulations --------------------------------------------------------------------


def _healed_state(evidence: Evidence, run: Row) -> float:
    """State (s) by the slip law at a run's onset where nothing slips: log(phi v0/D) decays."""
    law = evidence.friction
    rate = law.regularisation_slip_rate / law.slip_distance
    initial = run["initial_state"] * rate
    return float(initial ** math.exp(-rate * run["onset_time"]) / rate)


def _strengthened(evidence: Evidence, role: str) -> list[float]:
    """Relative change of the strength by the healing that v0 alone causes without slip."""
    changes = []
    for run in evidence.each(role, evolution="slip"):
        states = np.array([run["initial_state"], _healed_state(evidence, run)])
        initial, healed = evidence.friction.coefficient(evidence.velocity, states)
        changes.append(float(healed / initial - 1.0))
    return changes


# -- the course of a run ------------------------------------------------------------------------


def _instability_over_creep(evidence: Evidence, role: str) -> list[float]:
    ratios = [run["growth_time"] / run["acceleration_time"] for run in evidence.each(role)]
    return [ratio for ratio in ratios if not math.isnan(ratio)] or ratios  # some end before 100 V


def _rupture_duration(evidence: Evidence) -> float:
    row = evidence.row(PAPERS, "aging", _SHOWN)
    return row["onset_time"] / row["rupture_time"]


def _damped_rate(evidence: Evidence) -> float:
    """The slip rate (m/s) at which radiation damping is a sigma0."""
    impedance = 0.5 * evidence.material.shear_modulus / evidence.material.shear_wave_speed
    return evidence.interface.a * evidence.interface.normal_stress / impedance


def _longer_blocks(evidence: Evidence) -> list[Estimate]:
    """Relative changes of the length at the drop between blocks of one height."""
    changes = [
        _relative_change(row, base)
        for base, row in itertools.product(evidence.rows(LONGER), repeat=2)
        if row["block_length"] > base["block_length"] and row["height"] == base["height"]
    ]
    if not changes:
        raise Missing(f"The role {LONGER} has no run with a longer block")
    return changes


def _shortest_step(evidence: Evidence) -> Estimate:
    rows = evidence.rows(PAPERS)
    with_rupture = [
        row for row in rows if row.get("simulated_time", 0.0) > row["onset_time_high"] + _RUPTURE
    ]
    steps = [row["shortest_step"] / 1e-6 for row in with_rupture or rows]
    return between(float(np.median(steps)), *steps)


NUMBERS: dict[str, Computation] = {
    "onset-time": _shown("onset_time"),
    "length-shown": _shown("length"),
    "theory-agreement": on_both(
        lambda e, role: [
            _with_range(row, "length", row["critical_length"]) for row in e.series(role)
        ]
    ),
    "height-dependence": on_both(_height_dependence),
    "length-increases": on_both(_least_increase),
    "slip-law-low": _change_from_aging(0.01, "slip"),
    "slip-law-high": _change_from_aging(0.05, "slip"),
    "old-interface": _change_from_aging(0.1, "aging", 1e3),
    "stability-lost-at-length": lambda e: [
        e.stability_length(row) / row["critical_length"] for row in e.rows(JUDGED)
    ],
    "linear-stage-generic": _linear_stage,
    "minimum-plays-no-role": of_runs("onset_rate", lambda e: steady_extremes(e)[1]),
    "regularisation-irrelevant": of_runs("regular_share"),
    "slip-law-approximation": of_runs("state_rate_share_patch", evolution="slip"),
    "slip-law-approximation-ahead": on_both(_strengthened),
    "slip-rate-blows-up": on_both(
        lambda e, role: e.row(role, "aging", _INSET)["largest_rate"] / e.velocity
    ),
    "instability-faster-than-creep": on_both(_instability_over_creep),
    "abrupt-drop": on_both(
        lambda e, role: [row["onset_time"] / row["drop_time"] for row in e.rows(role)]
    ),
    "rupture-duration": _rupture_duration,
    "slow-creep": of_runs("front_speed", lambda e: e.material.shear_wave_speed),
    "no-radiation": of_runs("onset_rate", _damped_rate),
    "characteristic-slip-rate": on_both(
        lambda e, role: [_with_range(row, "patch_rate", e.velocity) for row in e.series(role)]
    ),
    "contact-kept": lambda e: [
        run["largest_normal_stress_ever"] / e.base.fault.normal_stress for run in e.each(PAPERS)
    ],
    "length-plays-no-role": _longer_blocks,
    "mesh-along": lambda e: [row["n_x"] for row in e.rows(PAPERS)],
    "mesh-across": lambda e: [row["n_y"] for row in e.rows(PAPERS)],
    "usual-step": of_runs("usual_step", lambda e: 1e-3),
    "shortest-step": _shortest_step,
}
"""The function of each claim, by its id."""
