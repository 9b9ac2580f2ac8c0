"""Claims on the course of the simulations and on how they were made: Sects. 3, 5 and Text S2."""

import math
from typing import Any

import numpy as np

from ...configuration.roles import JUDGED, LONGER, PAPERS
from ..claim import Computation, Result
from ..evidence import Evidence, of_runs, on_both
from ..said import Missing, Ours
from .simulations import INSET, SHOWN, relative_change

AFTER = 0.1  # s after its event, by which a run has seen the rupture


@on_both
def instability_faster_than_creep(evidence: Evidence, role: str) -> list[float]:
    ratios = [run.growth_time / run.acceleration_time for run in evidence.each_measured(role)]
    known = [ratio for ratio in ratios if not math.isnan(ratio)]
    return known or ratios  # a run may end with its drop, before 100 V


@on_both
def characteristic_slip_rate(evidence: Evidence, role: str) -> list[Ours]:
    velocity = evidence.loading.velocity
    rates = [evidence.measured(row).patch_rates for row in evidence.series(role)]
    return [Ours.between(*(rate / velocity for rate in three)) for three in rates]


def rupture_duration(evidence: Evidence) -> float:
    row = evidence.row(PAPERS, "aging", SHOWN)
    return float(row["onset_time"] / evidence.measured(row).rupture_time)


def damped_rate(evidence: Evidence) -> float:
    """The slip rate (m/s) at which radiation damping is a sigma0."""
    material, interface = evidence.material, evidence.interface
    impedance = 0.5 * material.shear_modulus / material.shear_wave_speed
    return interface.a * interface.normal_stress / impedance


def contact_kept(evidence: Evidence) -> Result:
    stress, measures = evidence.loading.normal_stress, evidence.each_measured(PAPERS)
    creep = max(run.largest_normal_stress / stress for run in measures)
    note = (
        f"Up to the onset it is {creep:.3g}. The runs that go on into the rupture have the "
        "aging law; a quiet one with the slip law on a finer mesh loses contact in its rupture "
        "(findings: Tension)."
    )
    return Result([run.largest_normal_stress_ever / stress for run in measures], note=note)


def length_plays_no_role(evidence: Evidence) -> Result:
    rows = evidence.rows(LONGER)
    changes = [
        relative_change(evidence, row, base)
        for base in rows
        for row in rows
        if row["height"] == base["height"] and row["block_length"] > base["block_length"]
    ]
    if not changes:
        raise Missing(f"The role {LONGER} has no run with a longer block")
    strength = evidence.interface.friction * evidence.loading.normal_stress
    shown = [run for study in (JUDGED, PAPERS) for run in evidence.each_measured(study)]
    beyond = max(run.middle_stress for run in shown) / strength
    note = (
        "In no run of Figure 3 does the shear stress half-way along the block at the onset exceed "
        f"{beyond:.1g} of the strength."
    )
    return Result(changes, note=note)


def shortest_step(evidence: Evidence) -> Ours:
    rows = [row for row in evidence.rows(PAPERS) if _goes_on(row)] or evidence.rows(PAPERS)
    steps = [evidence.measured(row).shortest_step / 1e-6 for row in rows]
    return Ours.between(float(np.median(steps)), min(steps), max(steps))


def _goes_on(row: dict[str, Any]) -> bool:
    """Whether a run goes on after its event."""
    return bool(row.get("simulated_time", 0.0) > row["onset_time_high"] + AFTER)


OURS: dict[str, Computation] = {
    "slip-rate-blows-up": on_both(
        lambda e, role: e.measured(e.row(role, "aging", INSET)).largest_rate / e.loading.velocity
    ),
    "abrupt-drop": on_both(
        lambda e, role: [row["onset_time"] / e.measured(row).drop_time for row in e.rows(role)]
    ),
    "slow-creep": of_runs("front_speed", lambda e: e.material.shear_wave_speed),
    "no-radiation": of_runs("onset_rate", damped_rate),
    "mesh-along": lambda e: [row["n_x"] for row in e.rows(PAPERS)],
    "mesh-across": lambda e: [row["n_y"] for row in e.rows(PAPERS)],
    "usual-step": of_runs("usual_step", lambda e: 1e-3),
}
"""The claims whose numbers take a line; each of the others has a function with its name."""
