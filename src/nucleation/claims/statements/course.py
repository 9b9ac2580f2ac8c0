"""Claims on the course of the simulations and on how they were made: Sects. 3, 5 and Text S2."""

import math
from functools import partial
from typing import Any

import numpy as np

from ...configuration.roles import JUDGED, LONGER, PAPERS
from ..claim import Result
from ..evidence import Evidence, on_both
from ..said import Missing, Ours
from .simulations import INSET, SHOWN, relative_change

AFTER = 0.1  # s after its event, by which a run has seen the rupture


@on_both
def slip_rate_blows_up(evidence: Evidence, role: str) -> float:
    row = evidence.row(role, "aging", INSET)
    return evidence.measured(row).largest_rate / evidence.loading.velocity


@on_both
def instability_faster_than_creep(evidence: Evidence, role: str) -> list[float]:
    ratios = [run.growth_time / run.acceleration_time for run in evidence.each_measured(role)]
    known = [ratio for ratio in ratios if not math.isnan(ratio)]
    return known or ratios  # a run may end with its drop, before 100 V


@on_both
def abrupt_drop(evidence: Evidence, role: str) -> list[float]:
    rows = evidence.rows(role)
    return [row["onset_time"] / evidence.measured(row).drop_time for row in rows]


def rupture_duration(evidence: Evidence) -> float:
    row = evidence.row(PAPERS, "aging", SHOWN)
    return float(row["onset_time"] / evidence.measured(row).rupture_time)


@on_both
def slow_creep(evidence: Evidence, role: str) -> list[float]:
    speed = evidence.material.shear_wave_speed
    return [run.front_speed / speed for run in evidence.each_measured(role)]


@on_both
def no_radiation(evidence: Evidence, role: str) -> list[float]:
    material, interface = evidence.material, evidence.interface
    impedance = 0.5 * material.shear_modulus / material.shear_wave_speed
    scale = impedance / (interface.a * interface.normal_stress)
    return [scale * run.onset_rate for run in evidence.each_measured(role)]


@on_both
def characteristic_slip_rate(evidence: Evidence, role: str) -> list[Ours]:
    velocity = evidence.loading.velocity
    rates = [evidence.measured(row).patch_rates for row in evidence.series(role)]
    return [Ours.between(*(rate / velocity for rate in three)) for three in rates]


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


def _of_paper(column: str, evidence: Evidence) -> list[float]:
    return [row[column] for row in evidence.rows(PAPERS)]


mesh_along, mesh_across = partial(_of_paper, "n_x"), partial(_of_paper, "n_y")


@on_both
def usual_step(evidence: Evidence, role: str) -> list[float]:
    return [run.usual_step / 1e-3 for run in evidence.each_measured(role)]


def shortest_step(evidence: Evidence) -> Ours:
    rows = [row for row in evidence.rows(PAPERS) if _goes_on(row)] or evidence.rows(PAPERS)
    steps = [evidence.measured(row).shortest_step / 1e-6 for row in rows]
    return Ours.between(float(np.median(steps)), min(steps), max(steps))


def _goes_on(row: dict[str, Any]) -> bool:
    """Whether a run goes on after its event."""
    return bool(row.get("simulated_time", 0.0) > row["onset_time_high"] + AFTER)
