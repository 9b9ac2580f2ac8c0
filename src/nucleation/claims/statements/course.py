"""Claims on the course of the simulations and on how they were made: Sects. 3, 5 and Text S2."""

import math
from typing import Any

import numpy as np

from ...configuration.roles import JUDGED, LONGER, PAPERS
from ..claim import Result
from ..evidence import Evidence, on_both
from ..said import Missing, Ours
from .simulations import INSET, SHOWN, relative_change

AFTER = 0.1  # s after its event, by which a run has seen the rupture


def slip_rate_blows_up(evidence: Evidence) -> Result:
    velocity = evidence.loading.velocity
    return on_both(
        evidence,
        lambda study: Ours.exactly(
            evidence.measured(evidence.row(study, "aging", INSET)).largest_rate / velocity
        ),
    )


def instability_faster_than_creep(evidence: Evidence) -> Result:
    def ours(study: str) -> Ours:
        ratios = [m.growth_time / m.acceleration_time for m in evidence.each_measured(study)]
        known = [ratio for ratio in ratios if not math.isnan(ratio)]
        return Ours.worst(known or ratios)  # a run may end with its drop, before 100 V

    return on_both(evidence, lambda study: _least(ours(study)))


def _least(ours: Ours) -> Ours:
    return Ours.between(ours.low, ours.low, ours.high)


def abrupt_drop(evidence: Evidence) -> Result:
    def ours(study: str) -> Ours:
        rows = evidence.rows(study)
        return Ours.worst([row["onset_time"] / evidence.measured(row).drop_time for row in rows])

    return on_both(evidence, lambda study: _least(ours(study)))


def rupture_duration(evidence: Evidence) -> Ours:
    row = evidence.row(PAPERS, "aging", SHOWN)
    return Ours.exactly(row["onset_time"] / evidence.measured(row).rupture_time)


def slow_creep(evidence: Evidence) -> Result:
    speed = evidence.material.shear_wave_speed

    def ours(study: str) -> Ours:
        runs = evidence.each_measured(study)
        return Ours.worst([run.front_speed / speed for run in runs])

    return on_both(evidence, ours, note="The density is an assumption (docs/assumptions.md).")


def no_radiation(evidence: Evidence) -> Result:
    material, interface = evidence.material, evidence.interface
    impedance = 0.5 * material.shear_modulus / material.shear_wave_speed
    scale = impedance / (interface.a * interface.normal_stress)

    def ours(study: str) -> Ours:
        runs = evidence.each_measured(study)
        return Ours.worst([scale * run.onset_rate for run in runs])

    return on_both(evidence, ours, note="The density is an assumption (docs/assumptions.md).")


def characteristic_slip_rate(evidence: Evidence) -> Result:
    velocity = evidence.loading.velocity

    def ours(study: str) -> Ours:
        rates = [evidence.measured(row).patch_rates for row in evidence.series(study)]
        middle, low, high = min(rates)
        return Ours.between(middle / velocity, low / velocity, high / velocity)

    return on_both(evidence, ours)


def contact_kept(evidence: Evidence) -> Result:
    stress, measures = evidence.loading.normal_stress, evidence.each_measured(PAPERS)
    creep = Ours.worst([m.largest_normal_stress / stress for m in measures], target=-1.0)
    ours = Ours.worst([m.largest_normal_stress_ever / stress for m in measures], target=-1.0)
    note = (
        f"Up to the onset it is {creep.value:.3g}. The runs that go on into the rupture have the "
        "aging law; a quiet one with the slip law on a finer mesh loses contact in its rupture "
        "(findings: Tension)."
    )
    return Result(ours, note=note)


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
    ours = max(changes, key=lambda change: abs(change.value))
    strength = evidence.interface.friction * evidence.loading.normal_stress
    shown = [run for study in (JUDGED, PAPERS) for run in evidence.each_measured(study)]
    beyond = max(run.middle_stress for run in shown) / strength
    note = (
        "In no run of Figure 3 does the shear stress half-way along the block at the onset exceed "
        f"{beyond:.1g} of the strength."
    )
    return Result(ours, note=note)


def mesh_along(evidence: Evidence) -> Ours:
    return Ours.worst([row["n_x"] for row in evidence.rows(PAPERS)], target=400.0)


def mesh_across(evidence: Evidence) -> Ours:
    return Ours.worst([row["n_y"] for row in evidence.rows(PAPERS)], target=150.0)


def usual_step(evidence: Evidence) -> Result:
    def ours(study: str) -> Ours:
        runs = evidence.each_measured(study)
        return Ours.worst([run.usual_step / 1e-3 for run in runs], target=1.0)

    return on_both(evidence, ours)


def shortest_step(evidence: Evidence) -> Ours:
    rows = [row for row in evidence.rows(PAPERS) if _goes_on(row)] or evidence.rows(PAPERS)
    steps = [evidence.measured(row).shortest_step / 1e-6 for row in rows]
    return Ours.between(float(np.median(steps)), min(steps), max(steps))


def _goes_on(row: dict[str, Any]) -> bool:
    """Whether a run goes on after its event."""
    return bool(row.get("simulated_time", 0.0) > row["onset_time_high"] + AFTER)
