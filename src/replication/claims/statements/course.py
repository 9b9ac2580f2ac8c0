"""Claims on the course of simulations (Sects. 3 and 5, Fig. 3's inset, Fig. S2, Text S2)."""

import itertools
import math

import numpy as np

from ...configuration.roles import JUDGED, LONGER, PAPERS
from ..claim import Computation, Result, Row
from ..evidence import Evidence, of_runs, on_both
from ..expected import Estimate, Missing
from .lengths import HEIGHT_OF_FIGURE_S2, relative_change, with_range

_HEIGHT_OF_INSET = 0.1  # m: of Fig. 3's inset
_RUPTURE = 0.1  # s after its event, by which a run contains the rupture


@on_both
def slip_rate_blows_up(
    evidence: Evidence,
    role: str,
) -> float:
    row = evidence.row(role, "aging", _HEIGHT_OF_INSET)
    return row["largest_rate"] / evidence.loading.velocity


@on_both
def instability_faster_than_creep(
    evidence: Evidence,
    role: str,
) -> list[float]:
    ratios = [run["growth_time"] / run["acceleration_time"] for run in evidence.each(role)]
    known = [ratio for ratio in ratios if not math.isnan(ratio)]
    return known or ratios  # a run may end with its drop, before 100 V


@on_both
def abrupt_drop(
    evidence: Evidence,
    role: str,
) -> list[float]:
    return [row["onset_time"] / row["drop_time"] for row in evidence.rows(role)]


def rupture_duration(evidence: Evidence) -> float:
    row = evidence.row(PAPERS, "aging", HEIGHT_OF_FIGURE_S2)
    return float(row["onset_time"] / row["rupture_time"])


def _shear_wave_speed(evidence: Evidence) -> float:
    return evidence.material.shear_wave_speed


def _damped_rate(evidence: Evidence) -> float:
    """The slip rate (m/s) at which radiation damping is a sigma0."""
    material = evidence.material
    interface = evidence.interface
    impedance = 0.5 * material.shear_modulus / material.shear_wave_speed
    return interface.a * interface.normal_stress / impedance


@on_both
def characteristic_slip_rate(
    evidence: Evidence,
    role: str,
) -> list[Estimate]:
    velocity = evidence.loading.velocity
    rows = evidence.series(role)
    return [with_range(row, "patch_rate", velocity) for row in rows]


def contact_kept(evidence: Evidence) -> Result:
    unit = evidence.loading.normal_stress
    runs = evidence.each(PAPERS)
    creep = max(run["largest_normal_stress"] / unit for run in runs)
    note = f"Up to the onset it is {creep:.3g}."
    if {run["evolution"] for run in runs if _has_rupture(run)} == {"aging"}:
        note += (
            " The runs that continue into the rupture have the aging law; a quiet one with the "
            "slip law on a finer mesh loses contact in its rupture (results: Tension)."
        )
    stresses = [run["largest_normal_stress_ever"] / unit for run in runs]
    return Result(stresses, note=note)


def length_plays_no_role(evidence: Evidence) -> Result:
    changes = _changes_by_length(evidence.rows(LONGER))
    if not changes:
        raise Missing(f"The role {LONGER} has no run with a longer block")
    strength = evidence.interface.friction * evidence.loading.normal_stress
    runs = evidence.each(JUDGED) + evidence.each(PAPERS)
    largest = max(run["middle_stress"] for run in runs) / strength
    note = (
        "In no run of Figure 3 does the shear stress half-way along the block at the onset exceed "
        f"{largest:.1g} of the strength."
    )
    return Result(changes, note=note)


def _changes_by_length(rows: list[Row]) -> list[Estimate]:
    """Relative changes of the length at the drop between blocks of one height."""
    return [
        relative_change(row, base)
        for base, row in itertools.product(rows, rows)
        if row["block_length"] > base["block_length"] and row["height"] == base["height"]
    ]


def _of_papers(column: str) -> Computation:
    """A column of the study with the role :data:`PAPERS`."""
    return lambda evidence: [row[column] for row in evidence.rows(PAPERS)]


def shortest_step(evidence: Evidence) -> Estimate:
    rows = evidence.rows(PAPERS)
    with_rupture = [row for row in rows if _has_rupture(row)]
    steps = [row["shortest_step"] / 1e-6 for row in with_rupture or rows]
    median = float(np.median(steps))
    return Estimate.between(median, min(steps), max(steps))


def _has_rupture(row: Row) -> bool:
    """Whether a run continues after its event."""
    simulated = row.get("simulated_time", 0.0)
    return bool(simulated > row["onset_time_high"] + _RUPTURE)


SHORT: dict[str, Computation] = {
    "mesh-along": _of_papers("n_x"),
    "mesh-across": _of_papers("n_y"),
    "slow-creep": of_runs("front_speed", _shear_wave_speed),
    "no-radiation": of_runs("onset_rate", _damped_rate),
    "usual-step": of_runs("usual_step", lambda evidence: 1e-3),
}
