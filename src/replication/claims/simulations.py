"""Claims on simulations: lengths at the drop, the onset, and the course of a run.

(Abstract, Sects. 3 and 5, Figs. 3 and S2, Text S2.)
"""

import dataclasses
import itertools
import math

import numpy as np

from nucleation.extraction.measures import BY_DEFINITION
from nucleation.theory.creep.thin import thin_limit

from ..configuration.roles import JUDGED, LONGER, PAPERS
from .evidence import Evidence, Row, of_runs, on_both
from .expected import Computation, Estimate, Missing, Result, between, number
from .friction import steady_extremes
from .phrases import span

_SHOWN = 0.005  # m: height of Fig. S2
_INSET = 0.1  # m: height of Fig. 3's inset
_ONSET = number("13")  # s, of Fig. S2
_RUPTURE = 0.1  # s after its event, by which a run contains the rupture
_WEAKENINGS = (0.1, 0.2, 0.3, 0.4, 0.5)  # zeta/a as measured for rocks


# -- lengths ------------------------------------------------------------------------------------


def _with_range(row: Row, column: str, unit: float = 1.0) -> Estimate:
    """A number of a row with the ends of its range, in a unit of the column."""
    return between(*(row[f"{column}{end}"] / unit for end in ("", "_low", "_high")))


def _of_figure_s2(column: str) -> Computation:
    """A number of the run of Fig. S2."""
    return on_both(
        lambda e, role: _with_range(
            e.row(
                role,
                "aging",
                _SHOWN,
            ),
            column,
        )
    )


def _onset_time(evidence: Evidence) -> Result:
    row = evidence.row(JUDGED, "aging", _SHOWN)
    distance = abs(_ONSET.high - row["onset_time"])
    runs = int(row["realisations"])
    mean = f"the mean of {runs} realisations" if runs > 1 else "one realisation"
    note = (
        f"The verdict depends on the kind of noise. This one is {row['kind']} of "
        f"{row['strength']:g}: {mean}, {distance:.2f} s from the bound. With a fluctuating "
        "state the force drops later than the bound (results: Onset and length for H = 0.005 m)."
    )
    return dataclasses.replace(_of_figure_s2("onset_time")(evidence), note=note)


def _length_shown(evidence: Evidence) -> Result:
    row = evidence.row(JUDGED, "aging", _SHOWN)
    lengths = [run["length"] for run in row["members"]]
    runs = f"all {len(lengths)} realisations are" if len(lengths) > 1 else "the one realisation is"
    note = (
        f"With one definition, the edge at 0.01 V, {runs} {span(lengths, '.4f')} m. "
        "The range over the definitions decides."
    )
    return dataclasses.replace(_of_figure_s2("length")(evidence), note=note)


@on_both
def _over_theory(evidence: Evidence, role: str) -> list[Estimate]:
    """Length over L_c of the theory at all heights."""
    return [
        _with_range(
            row,
            "length",
            row["critical_length"],
        )
        for row in evidence.series(role)
    ]


def _theory_agreement(evidence: Evidence) -> Result:
    rows = evidence.series(JUDGED)
    ratios = [row["length"] / row["critical_length"] for row in rows]
    wide = min(row["length_high_start"] / row["critical_length"] for row in rows)
    note = (
        f"Over the heights the ratio is {span(ratios, '.2f')}, with the edge at 0.5 V at least "
        f"{wide:.2f}. The paper's own 0.15 m is 0.64 of its theory."
    )
    return dataclasses.replace(_over_theory(evidence), note=note)


def _heights(evidence: Evidence, role: str) -> list[Row]:
    """The rows of all heights; raises Missing if there are fewer than two."""
    rows = evidence.series(role)
    return (
        rows
        if len(rows) > 1
        else [
            evidence.row(
                role,
                "aging",
                _SHOWN,
            ),
            *rows,
        ]
    )


@on_both
def _height_dependence(evidence: Evidence, role: str) -> list[float]:
    ratios = [row["length"] / row["critical_length"] for row in _heights(evidence, role)]
    return [higher / lower for lower, higher in itertools.combinations(ratios, 2)]


@on_both
def _length_increases(evidence: Evidence, role: str) -> float:
    lengths = [row["length"] for row in _heights(evidence, role)]
    return min(higher / lower for lower, higher in itertools.pairwise(lengths))


def _relative_change(varied: Row, base: Row) -> Estimate:
    """Relative change of the length between two runs; its range is that of the definitions."""
    changes = [varied[column] / base[column] - 1.0 for column in BY_DEFINITION]
    return between(
        varied["length"] / base["length"] - 1.0,
        min(changes),
        max(changes),
    )


def _change_from_aging(height: float, law: str, age: float = 1.0) -> Computation:
    """Relative change of the length by another law or age (s), at one height (m)."""
    return on_both(
        lambda e, role: _relative_change(
            e.row(
                role,
                law,
                height,
                age,
            ),
            e.row(
                role,
                "aging",
                height,
            ),
        )
    )


def _stability_lost(evidence: Evidence) -> Result:
    rows = evidence.rows(JUDGED)
    ratios = [evidence.stability_length(row) / row["critical_length"] for row in rows]
    halves = span((2.0 * ratio for ratio in ratios), ".2f")
    thin = ", ".join(f"{thin_limit(weakening).length_ratio:.2f}" for weakening in _WEAKENINGS)
    note = (
        f"Over half of that wavelength it is {halves} "
        "(results: Where the patch becomes unstable). It depends on the weakening: in a thin "
        f"layer the theory of the patch gives {thin} for "
        rf"$\zeta/a$ = {', '.join(map(str, _WEAKENINGS))}."
    )
    return Result(ratios, note=note)


def _linear_stage(evidence: Evidence) -> list[float]:
    """Changes of the length at which the patch becomes unstable, by another law or age."""
    rows = evidence.rows(JUDGED)
    others = [row for row in rows if row["evolution"] != "aging" or row["initial_state"] != 1.0]
    changes = []
    for varied in others or [evidence.row(JUDGED, "slip", 0.01)]:
        base = evidence.row(JUDGED, "aging", varied["height"])
        ratio = evidence.stability_length(varied) / evidence.stability_length(base)
        changes.append(ratio - 1.0)
    return changes


# -- friction in simulations --------------------------------------------------------------------


def _healed_state(evidence: Evidence, run: Row) -> float:
    """State (s) by the slip law at a run's onset where nothing slips: log(phi v0/D) decays."""
    law = evidence.friction
    rate = law.regularisation_slip_rate / law.slip_distance
    initial = run["initial_state"] * rate
    return float(initial ** math.exp(-rate * run["onset_time"]) / rate)


@on_both
def _strengthened(evidence: Evidence, role: str) -> list[float]:
    """Relative change of the strength by the healing that v0 alone causes without slip."""
    velocity = evidence.fault.velocity
    changes = []
    for run in evidence.each(role, evolution="slip"):
        states = np.array([run["initial_state"], _healed_state(evidence, run)])
        initial, healed = evidence.friction.coefficient(velocity, states)
        changes.append(float(healed / initial - 1.0))
    return changes


def _approximation_ahead(evidence: Evidence) -> Result:
    runs = evidence.each(JUDGED, evolution="slip")
    latest = max(runs, key=lambda run: run["onset_time"])
    share = min(run["state_rate_share"] for run in runs)
    note = (
        f"At the latest onset the state is {_healed_state(evidence, latest):.2f} s in the place of "
        f"{latest['initial_state']:.2f} s. Only the relative error of $\\dot\\phi$ is large there: "
        f"it is below 10 % in {share:.2g} of the interface "
        "(results: The slip law ahead of the front)."
    )
    return dataclasses.replace(_strengthened(evidence), note=note)


# -- the course of a run ------------------------------------------------------------------------


@on_both
def _blow_up(evidence: Evidence, role: str) -> float:
    row = evidence.row(role, "aging", _INSET)
    return row["largest_rate"] / evidence.fault.velocity


@on_both
def _instability_over_creep(evidence: Evidence, role: str) -> list[float]:
    ratios = [run["growth_time"] / run["acceleration_time"] for run in evidence.each(role)]
    return [ratio for ratio in ratios if not math.isnan(ratio)] or ratios  # some end before 100 V


@on_both
def _abrupt_drop(evidence: Evidence, role: str) -> list[float]:
    return [row["onset_time"] / row["drop_time"] for row in evidence.rows(role)]


@on_both
def _characteristic_rate(evidence: Evidence, role: str) -> list[Estimate]:
    velocity = evidence.fault.velocity
    return [_with_range(row, "patch_rate", velocity) for row in evidence.series(role)]


def _rupture_duration(evidence: Evidence) -> float:
    row = evidence.row(PAPERS, "aging", _SHOWN)
    return row["onset_time"] / row["rupture_time"]


def _damped_rate(evidence: Evidence) -> float:
    """The slip rate (m/s) at which radiation damping is a sigma0."""
    impedance = 0.5 * evidence.material.shear_modulus / evidence.material.shear_wave_speed
    return evidence.interface.a * evidence.interface.normal_stress / impedance


def _contact_kept(evidence: Evidence) -> Result:
    unit = evidence.fault.normal_stress
    runs = evidence.each(PAPERS)
    creep = max(run["largest_normal_stress"] / unit for run in runs)
    note = f"Up to the onset it is {creep:.3g}."
    if {run["evolution"] for run in runs if _has_rupture(run)} == {"aging"}:
        note += (
            " The runs that continue into the rupture have the aging law; a quiet one with the "
            "slip law on a finer mesh loses contact in its rupture (results: Tension)."
        )
    return Result([run["largest_normal_stress_ever"] / unit for run in runs], note=note)


def _has_rupture(row: Row) -> bool:
    """Whether a run continues after its event."""
    return bool(row.get("simulated_time", 0.0) > row["onset_time_high"] + _RUPTURE)


def _longer_blocks(evidence: Evidence) -> Result:
    """Relative changes of the length at the drop between blocks of one height."""
    rows = evidence.rows(LONGER)
    changes = [
        _relative_change(row, base)
        for base, row in itertools.product(rows, rows)
        if row["block_length"] > base["block_length"] and row["height"] == base["height"]
    ]
    if not changes:
        raise Missing(f"The role {LONGER} has no run with a longer block")
    strength = evidence.interface.friction * evidence.fault.normal_stress
    runs = evidence.each(JUDGED) + evidence.each(PAPERS)
    largest = max(run["middle_stress"] for run in runs) / strength
    note = (
        "In no run of Figure 3 does the shear stress half-way along the block at the onset exceed "
        f"{largest:.1g} of the strength."
    )
    return Result(changes, note=note)


def _shortest_step(evidence: Evidence) -> Estimate:
    rows = evidence.rows(PAPERS)
    with_rupture = [row for row in rows if _has_rupture(row)]
    steps = [row["shortest_step"] / 1e-6 for row in with_rupture or rows]
    return between(
        float(np.median(steps)),
        min(steps),
        max(steps),
    )


NUMBERS: dict[str, Computation] = {
    "onset-time": _onset_time,
    "length-shown": _length_shown,
    "theory-agreement": _theory_agreement,
    "height-dependence": _height_dependence,
    "length-increases": _length_increases,
    "slip-law-low": _change_from_aging(0.01, "slip"),
    "slip-law-high": _change_from_aging(0.05, "slip"),
    "old-interface": _change_from_aging(0.1, "aging", 1e3),
    "stability-lost-at-length": _stability_lost,
    "linear-stage-generic": _linear_stage,
    "minimum-plays-no-role": of_runs("onset_rate", lambda e: steady_extremes(e)[1]),
    "regularisation-irrelevant": of_runs("regular_share"),
    "slip-law-approximation": of_runs("state_rate_share_patch", evolution="slip"),
    "slip-law-approximation-ahead": _approximation_ahead,
    "slip-rate-blows-up": _blow_up,
    "instability-faster-than-creep": _instability_over_creep,
    "abrupt-drop": _abrupt_drop,
    "rupture-duration": _rupture_duration,
    "slow-creep": of_runs("front_speed", lambda e: e.material.shear_wave_speed),
    "no-radiation": of_runs("onset_rate", _damped_rate),
    "characteristic-slip-rate": _characteristic_rate,
    "contact-kept": _contact_kept,
    "length-plays-no-role": _longer_blocks,
    "mesh-along": lambda e: [row["n_x"] for row in e.rows(PAPERS)],
    "mesh-across": lambda e: [row["n_y"] for row in e.rows(PAPERS)],
    "usual-step": of_runs("usual_step", lambda e: 1e-3),
    "shortest-step": _shortest_step,
}
"""The function of each claim, by its id."""
