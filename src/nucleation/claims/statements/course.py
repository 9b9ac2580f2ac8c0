"""Claims on the course of the simulations and on how they were made: Sects. 3, 5 and Text S2."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from ...configuration.roles import JUDGED, LONGER, PAPERS
from ..claim import Claim, Result, claim
from ..evidence import Evidence, on_both
from ..said import Missing, Ours, below, number, words
from .simulations import INSET, SHOWN, relative_change

CLAIMS: list[Claim] = []

AFTER = 0.1  # s after its event, by which a run has seen the rupture


@claim(
    CLAIMS, id="slip-rate-blows-up", where="Sect. 5 and Fig. 3's inset",
    statement="The slip rate blows up when the patch has reached a certain length (H = 0.1 m).",
    quotation=r"where the slip velocity blows up when the creep patch reaches a certain length",
    method="largest slip rate over V", said=words("dramatically"),
)  # fmt: skip
def slip_rate_blows_up(evidence: Evidence) -> Result:
    velocity = evidence.loading.velocity
    return on_both(
        evidence,
        lambda study: Ours.exactly(
            evidence.measured(evidence.row(study, "aging", INSET)).largest_rate / velocity
        ),
    )


@claim(
    CLAIMS, id="instability-faster-than-creep", where="Text S2.2",
    statement="The instability evolves much faster than the expanding creep patch.",
    quotation=r"evolves much faster than the expanding creep patch",
    method="time in which the creeping patch grows by its own length, over that in which the "
    "fastest slip rate rises from 10 to 100 V; the least of the runs whose record goes on so far",
    said=words("much"),
)  # fmt: skip
def instability_faster(evidence: Evidence) -> Result:
    def ours(study: str) -> Ours:
        ratios = [m.growth_time / m.acceleration_time for m in evidence.each_measured(study)]
        known = [ratio for ratio in ratios if not math.isnan(ratio)]
        return Ours.worst(known or ratios)  # a run may end with its drop, before 100 V

    return on_both(evidence, lambda study: _least(ours(study)))


def _least(ours: Ours) -> Ours:
    return Ours.between(ours.low, ours.low, ours.high)


@claim(
    CLAIMS, id="abrupt-drop", where="Text S2.2",
    statement="The instability comes with an abrupt drop of the force.",
    quotation=r"it is accompanied by an abrupt drop in $f_d(t)$",
    method="onset time over the duration of the drop's steep part; the least of all runs",
    said=words("dramatically"),
)  # fmt: skip
def abrupt_drop(evidence: Evidence) -> Result:
    def ours(study: str) -> Ours:
        rows = evidence.rows(study)
        return Ours.worst([row["onset_time"] / evidence.measured(row).drop_time for row in rows])

    return on_both(evidence, lambda study: _least(ours(study)))


@claim(
    CLAIMS, id="rupture-duration", where="Fig. S2",
    statement="The rupture that follows takes a dramatically shorter time than the creep before.",
    quotation=r"dynamic rupture propagation that occurs on a dramatically shorter timescale",
    method="onset time over the time with slip rates above 1 mm/s, H = 0.005 m, study paper, "
    "whose runs go on after the event", said=words("dramatically"),
)  # fmt: skip
def rupture_duration(evidence: Evidence) -> Ours:
    row = evidence.row(PAPERS, "aging", SHOWN)
    return Ours.exactly(row["onset_time"] / evidence.measured(row).rupture_time)


@claim(
    CLAIMS, id="slow-creep", where="Sects. 3 and 5",
    statement="The creep patch expands slowly: nucleation is quasi-static.",
    quotation=r"because nucleation generically takes place in this regime",
    method="mean speed of the patch's edge before the onset over the shear wave speed; the worst",
    said=words("negligible"),
)  # fmt: skip
def slow_creep(evidence: Evidence) -> Result:
    speed = evidence.material.shear_wave_speed

    def ours(study: str) -> Ours:
        runs = evidence.each_measured(study)
        return Ours.worst([run.front_speed / speed for run in runs])

    return on_both(evidence, ours, note="The density is an assumption (docs/assumptions.md).")


@claim(
    CLAIMS, id="no-radiation", where="Sects. 2 and 3",
    statement="Acoustic radiation is negligible while the patch creeps.",
    quotation=r"in the quasi-static regime (where inertia and acoustic radiation are negligible)",
    method="radiation damping mu v/(2 c_s) of the fastest point at the onset, over a sigma0; the "
    "worst of all runs", said=words("negligible"),
)  # fmt: skip
def no_radiation(evidence: Evidence) -> Result:
    material, interface = evidence.material, evidence.interface
    impedance = 0.5 * material.shear_modulus / material.shear_wave_speed
    scale = impedance / (interface.a * interface.normal_stress)

    def ours(study: str) -> Ours:
        runs = evidence.each_measured(study)
        return Ours.worst([scale * run.onset_rate for run in runs])

    return on_both(evidence, ours, note="The density is an assumption (docs/assumptions.md).")


@claim(
    CLAIMS, id="characteristic-slip-rate", where="Sect. 3 and Text S2.1",
    statement="V is the typical slip rate within the creep patch.",
    quotation=r"replaced by a homogeneous (space-independent) characteristic slip velocity $V$",
    method="median slip rate within the patch over V, median over the second half of the creep; "
    "the worst of the aging law's runs with the range over time", said=words("typical"),
)  # fmt: skip
def characteristic_slip_rate(evidence: Evidence) -> Result:
    velocity = evidence.loading.velocity

    def ours(study: str) -> Ours:
        rates = [evidence.measured(row).patch_rates for row in evidence.series(study)]
        middle, low, high = min(rates)
        return Ours.between(middle / velocity, low / velocity, high / velocity)

    return on_both(evidence, ours)


@claim(
    CLAIMS, id="contact-kept", where="Sect. 3",
    statement="The fault stays closed.",
    quotation=r"Fault opening or interpenetration are excluded",
    method="largest normal stress sigma_yy at the interface over sigma0 (negative: compression), "
    "creep, event and, where a run goes on, rupture; the worst of all runs of the study "
    "paper", said=below(0.0),
)  # fmt: skip
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


@claim(
    CLAIMS, id="length-plays-no-role", where="Text S2",
    statement="The block's length plays no role.",
    quotation=r"such that it plays no role in the obtained results",
    method="relative change of L_c in runs with a longer block, elements as long, range over the "
    f"definitions, the same for both runs; the worst (study {LONGER})",
    said=words("negligible"),
)  # fmt: skip
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


@claim(
    CLAIMS, id="mesh-along", where="Text S2.2",
    statement="A typical mesh has 400 points along x.",
    quotation=r"typical number of $N_x=400$ and $N_y=150$ meshpoints",
    method="elements along x of the study paper", said=number("400"),
    input=True,
)  # fmt: skip
def mesh_along(evidence: Evidence) -> Ours:
    return Ours.worst([row["n_x"] for row in evidence.rows(PAPERS)], target=400.0)


@claim(
    CLAIMS, id="mesh-across", where="Text S2.2",
    statement="A typical mesh has 150 points along y.",
    quotation=r"typical number of $N_x=400$ and $N_y=150$ meshpoints",
    method="elements along y of the study paper", said=number("150"),
    input=True,
)  # fmt: skip
def mesh_across(evidence: Evidence) -> Ours:
    return Ours.worst([row["n_y"] for row in evidence.rows(PAPERS)], target=150.0)


@claim(
    CLAIMS, id="usual-step", where="Text S2.2",
    statement="Adaptive time steps are near 1e-3 s while the patch creeps.",
    quotation=r"varies typically between $dt=10^{-3}$ s and $dt=10^{-6}$ s",
    method="median time step over 1e-3 s, error-controlled, and bound by the longest step that the "
    "configuration allows, which is as long; the worst run",
    said=words("about"), input=True,
)  # fmt: skip
def usual_step(evidence: Evidence) -> Result:
    def ours(study: str) -> Ours:
        runs = evidence.each_measured(study)
        return Ours.worst([run.usual_step / 1e-3 for run in runs], target=1.0)

    return on_both(evidence, ours)


@claim(
    CLAIMS, id="shortest-step", where="Text S2.2",
    statement="Adaptive time steps fall to 1e-6 s in the rupture.",
    quotation=r"varies typically between $dt=10^{-3}$ s and $dt=10^{-6}$ s",
    method="shortest time step after the onset over 1e-6 s, error-controlled; the median of the "
    "runs of the study paper that go on after the event, with their range", said=words("about"),
)  # fmt: skip
def shortest_step(evidence: Evidence) -> Ours:
    rows = [row for row in evidence.rows(PAPERS) if _goes_on(row)] or evidence.rows(PAPERS)
    steps = [evidence.measured(row).shortest_step / 1e-6 for row in rows]
    return Ours.between(float(np.median(steps)), min(steps), max(steps))


def _goes_on(row: dict[str, Any]) -> bool:
    """Whether a run goes on after its event."""
    return bool(row.get("simulated_time", 0.0) > row["onset_time_high"] + AFTER)
