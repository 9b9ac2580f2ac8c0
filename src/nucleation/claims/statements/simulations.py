"""Claims on the simulations, their course and lengths: Sects. 3 and 5, Figs. 3 and S2, Text S2."""

import dataclasses
import itertools
import math
from collections.abc import Callable
from typing import Any

import numpy as np

from ...analysis.measures import BY_DEFINITION
from ...configuration.roles import JUDGED, LONGER, PAPERS
from ...theory.creep.thin import thin_limit
from ..claim import Computation, Result
from ..evidence import Evidence, of_runs, on_both
from ..said import Missing, Ours, holds, number, words

SHOWN = 0.005  # m: the height of Fig. S2
INSET = 0.1  # m: the height of Fig. 3's inset
OLD = 1e3  # s
ONSET = number("13")  # s: of Fig. S2
WEAKER = (0.1, 0.2, 0.3, 0.4, 0.5)  # zeta/a, as rocks have it


def _with_range(row: dict[str, Any], name: str, over: float = 1.0) -> Ours:
    """A number of a row of the table of lengths with the ends of its range."""
    return Ours.between(*(row[f"{name}{end}"] / over for end in ("", "_low", "_high")))


def shown(name: str) -> Callable[[Evidence], Result]:
    """A number of the run of Fig. S2."""
    return on_both(lambda e, role: _with_range(e.row(role, "aging", SHOWN), name))


def onset_time(evidence: Evidence) -> Result:
    row = evidence.row(JUDGED, "aging", SHOWN)
    note = (
        f"The verdict depends on the kind of noise. This one is {row['kind']} of "
        f"{row['strength']:g}: the mean of {row['realisations']} realisations, "
        f"{abs(ONSET.high - row['onset_time']):.2f} s from the bound. With a fluctuating state the "
        "force drops later than the bound (results: Onset and length for H = 0.005 m)."
    )
    return dataclasses.replace(shown("onset_time")(evidence), note=note)


def length_shown(evidence: Evidence) -> Result:
    row = evidence.row(JUDGED, "aging", SHOWN)
    lengths = [run["length"] for run in row["members"]]
    note = (
        f"With one definition, the edge at 0.01 V, all {len(lengths)} realisations are "
        f"{min(lengths):.4f} to {max(lengths):.4f} m. The range over the definitions decides."
    )
    return dataclasses.replace(shown("length")(evidence), note=note)


def over_theory(evidence: Evidence, role: str) -> list[Ours]:
    """L_c over that of the theory at all heights, with its range."""
    return [_with_range(row, "length", row["theory_length"]) for row in evidence.series(role)]


def theory_agreement(evidence: Evidence) -> Result:
    result = on_both(over_theory)(evidence)
    note = f"Over the heights the ratio is {_how_near(over_theory(evidence, JUDGED))}."
    if result.on_papers_mesh is not None:
        note += f" On the paper's mesh it is {_how_near(over_theory(evidence, PAPERS))}."
    return dataclasses.replace(result, note=note)


def _how_near(ratios: list[Ours]) -> str:
    """The least and the largest of some ratios, and how many are within 25 % of one."""
    values = [float(ratio) for ratio in ratios]
    near = [value for value in values if holds(words("expected"), Ours.exactly(value))]
    return f"{min(values):.2f} to {max(values):.2f}, {len(near)} of {len(values)} within 25 %"


def _heights(evidence: Evidence, role: str) -> list[dict[str, Any]]:
    """The rows of two heights at least; raises Missing, which says what is not there."""
    rows = evidence.series(role)
    return rows if len(rows) > 1 else [evidence.row(role, "aging", SHOWN), *rows]


@on_both
def height_dependence(evidence: Evidence, role: str) -> list[float]:
    ratios = [row["length"] / row["theory_length"] for row in _heights(evidence, role)]
    return [b / a for a, b in itertools.combinations(ratios, 2)]


@on_both
def length_increases(evidence: Evidence, role: str) -> float:
    lengths = [row["length"] for row in _heights(evidence, role)]
    return min(b / a for a, b in itertools.pairwise(lengths))


def relative_change(varied: dict[str, Any], base: dict[str, Any]) -> Ours:
    """Relative change of L_c, its range that of the definitions, the same for both runs."""
    one, other = (np.array([row[name] for name in BY_DEFINITION]) for row in (varied, base))
    changes = one / other - 1.0
    return Ours.between(varied["length"] / base["length"] - 1.0, changes.min(), changes.max())


def change_from_aging(height: float, law: str, age: float = 1.0) -> Computation:
    """Relative change of L_c by another law or age, at one height (m)."""

    @on_both
    def change(evidence: Evidence, role: str) -> Ours:
        varied, base = evidence.row(role, law, height, age), evidence.row(role, "aging", height)
        return relative_change(varied, base)

    return change


def _stability_length(evidence: Evidence, row: dict[str, Any]) -> float:
    return float(evidence.patch(row)["stability_length"])


def stability_lost_at_length(evidence: Evidence) -> Result:
    ratios = [
        _stability_length(evidence, row) / row["theory_length"] for row in evidence.rows(JUDGED)
    ]
    weaker = [f"{thin_limit(weakening).length_ratio:.2f}" for weakening in WEAKER]
    note = (
        f"Over half of that wavelength it is {2.0 * min(ratios):.2f} to {2.0 * max(ratios):.2f} "
        "(results: Where the patch becomes unstable). It depends on the weakening: in a thin "
        f"layer the theory of the patch gives {', '.join(weaker)} for "
        rf"$\zeta/a$ = {', '.join(map(str, WEAKER))}. So from 0.2 to 0.4 the whole wavelength is "
        "right within 25 %."
    )
    return Result(ratios, note=note)


def linear_stage_generic(evidence: Evidence) -> list[float]:
    varied = [
        row for row in evidence.rows(JUDGED) if row["evolution"] != "aging" or row["phi0"] != 1.0
    ] or [evidence.row(JUDGED, "slip", 0.01)]
    base = [evidence.row(JUDGED, "aging", row["height"]) for row in varied]
    return [
        _stability_length(evidence, one) / _stability_length(evidence, other) - 1.0
        for one, other in zip(varied, base, strict=True)
    ]


AFTER = 0.1  # s after its event, by which a run has seen the rupture


@on_both
def instability_faster_than_creep(evidence: Evidence, role: str) -> list[float]:
    ratios = [run["growth_time"] / run["acceleration_time"] for run in evidence.each(role)]
    known = [ratio for ratio in ratios if not math.isnan(ratio)]
    return known or ratios  # a run may end with its drop, before 100 V


def rupture_duration(evidence: Evidence) -> float:
    row = evidence.row(PAPERS, "aging", SHOWN)
    return float(row["onset_time"] / row["rupture_time"])


def damped_rate(evidence: Evidence) -> float:
    """The slip rate (m/s) at which radiation damping is a sigma0."""
    material, interface = evidence.material, evidence.interface
    impedance = 0.5 * material.shear_modulus / material.shear_wave_speed
    return interface.a * interface.normal_stress / impedance


def contact_kept(evidence: Evidence) -> Result:
    stress, runs = evidence.loading.normal_stress, evidence.each(PAPERS)
    creep = max(run["largest_normal_stress"] / stress for run in runs)
    note = (
        f"Up to the onset it is {creep:.3g}. The runs that go on into the rupture have the "
        "aging law; a quiet one with the slip law on a finer mesh loses contact in its rupture "
        "(results: Tension)."
    )
    return Result([run["largest_normal_stress_ever"] / stress for run in runs], note=note)


def length_plays_no_role(evidence: Evidence) -> Result:
    rows = evidence.rows(LONGER)
    changes = [
        relative_change(row, base)
        for base in rows
        for row in rows
        if row["height"] == base["height"] and row["block_length"] > base["block_length"]
    ]
    if not changes:
        raise Missing(f"The role {LONGER} has no run with a longer block")
    strength = evidence.interface.friction * evidence.loading.normal_stress
    shown = [run for study in (JUDGED, PAPERS) for run in evidence.each(study)]
    beyond = max(run["middle_stress"] for run in shown) / strength
    note = (
        "In no run of Figure 3 does the shear stress half-way along the block at the onset exceed "
        f"{beyond:.1g} of the strength."
    )
    return Result(changes, note=note)


def shortest_step(evidence: Evidence) -> Ours:
    rows = [row for row in evidence.rows(PAPERS) if _goes_on(row)] or evidence.rows(PAPERS)
    steps = [row["shortest_step"] / 1e-6 for row in rows]
    return Ours.between(float(np.median(steps)), min(steps), max(steps))


def _goes_on(row: dict[str, Any]) -> bool:
    """Whether a run goes on after its event."""
    return bool(row.get("simulated_time", 0.0) > row["onset_time_high"] + AFTER)


OURS: dict[str, Computation] = {
    "slip-law-low": change_from_aging(0.01, "slip"),
    "slip-law-high": change_from_aging(0.05, "slip"),
    "old-interface": change_from_aging(INSET, "aging", OLD),
    "slip-rate-blows-up": on_both(
        lambda e, role: e.row(role, "aging", INSET)["largest_rate"] / e.loading.velocity
    ),
    "characteristic-slip-rate": on_both(
        lambda e, role: [
            _with_range(row, "patch_rate", e.loading.velocity) for row in e.series(role)
        ]
    ),
    "abrupt-drop": on_both(
        lambda e, role: [row["onset_time"] / row["drop_time"] for row in e.rows(role)]
    ),
    "slow-creep": of_runs("front_speed", lambda e: e.material.shear_wave_speed),
    "no-radiation": of_runs("onset_rate", damped_rate),
    "mesh-along": lambda e: [row["n_x"] for row in e.rows(PAPERS)],
    "mesh-across": lambda e: [row["n_y"] for row in e.rows(PAPERS)],
    "usual-step": of_runs("usual_step", lambda e: 1e-3),
}
"""The claims whose numbers take a line; each of the others has a function with its name."""
