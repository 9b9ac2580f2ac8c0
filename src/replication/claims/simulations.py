"""Claims on simulations: lengths at the drop, the onset, and the course of a run.

(Abstract, Sects. 3 and 5, Figs. 3 and S2, Text S2.)
"""

import itertools
import math
from collections.abc import Callable

import numpy as np

from nucleation.extraction.measures import BY_DEFINITION
from nucleation.theory.closed_forms import thin_limit_length
from nucleation.types import Array

from ..configuration.roles import JUDGED, LONGER, PAPERS
from ..tables.rows import Row
from .evidence import Evidence, mesh, of_runs, on_both, span
from .friction import steady_extremes
from .theory import block
from .verdicts import Computation, Estimate, Expected, Missing, Result, between, near_one, read

LENGTHS = ("length", *BY_DEFINITION)
"""Columns of lengths at the drop."""

_SHOWN = 0.005  # m: height of Fig. S2
_PRINTED_LENGTH = "0.15"  # m: of the paper at that height
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


def _agreement(evidence: Evidence) -> Result:
    """L/L_c at the height of Figure S2 against the paper's own; those of all heights are counted.

    The paper's range is its printed length's, over L_c by Table S1 and by the main text's friction.
    """
    printed = read({"number": _PRINTED_LENGTH})
    by_text = block(evidence, _SHOWN)
    f0, a, zeta = evidence.at_v
    lengths = [
        float(fault.critical_length())
        for fault in (by_text, by_text.replace(friction=f0, a=a, zeta=zeta))
    ]
    value, low, high = (
        (printed.value or 0.0) / lengths[0],
        printed.low / max(lengths),
        printed.high / min(lengths),
    )
    text = f"{value:.3g} ({low:.3g} to {high:.3g})"
    expected = Expected("number", low, high, text, value)
    shown = on_both(
        lambda e, role: _with_range(e.row(role, "aging", _SHOWN), "length", lengths[0])
    )(evidence)
    return shown._replace(
        expected=expected, beside=_counted(evidence, r"$L/L_c$ at all heights", _ratios)
    )


def _ratios(evidence: Evidence, role: str) -> list[float]:
    """L/L_c at each height."""
    return [row["length"] / row["critical_length"] for row in evidence.series(role)]


def _of_heights(evidence: Evidence, role: str) -> list[float]:
    """L at a height over that at a smaller one, over the theory's ratio."""
    ratios = _ratios(evidence, role)
    return [higher / lower for lower, higher in itertools.combinations(ratios, 2)]


def _counted(evidence: Evidence, head: str, numbers: Callable[[Evidence, str], list[float]]) -> str:
    """A sentence on the numbers of each role, and on how many are near one."""

    def listed(role: str) -> str:
        found = numbers(evidence, role)
        return f"{span(found, '{:.3g}'.format)}, {near_one(found)}"

    sentence = f"{head}: {listed(JUDGED)}"
    try:
        papers = listed(PAPERS)
    except Missing:
        return f"{sentence}."
    return f"{sentence}; on {mesh(evidence.each(PAPERS))} {papers}."


def _miss(lengths: Array, curve: Array) -> float:
    """Standard deviation of log(length/curve): the miss of a curve times the best factor."""
    return float(np.std(np.log(lengths / curve)))


def misses(evidence: Evidence, role: str) -> dict[str, Array]:
    """By how much each curve misses the lengths over height, by each definition of the length."""
    rows = _heights(evidence, role)
    heights = np.array([row["height"] for row in rows])
    thin = thin_limit_length(heights, block(evidence, heights))
    high = block(evidence, math.inf).critical_length()
    curves = {
        "the theory": np.array([row["critical_length"] for row in rows]),
        "the square root of $H$": np.sqrt(heights),
        "a constant": np.ones(heights.size),
        "the shorter limit": np.minimum(thin, high),
    }
    by_definition = np.array([[row[name] for row in rows] for name in LENGTHS])
    return {
        name: np.array([_miss(lengths, curve) for lengths in by_definition])
        for name, curve in curves.items()
    }


def _miss_over_others(evidence: Evidence, role: str) -> Estimate:
    """The theory's miss over the least of the others."""
    own, *others = misses(evidence, role).values()
    return between(*own / np.min(others, axis=0))


def _height_dependence(evidence: Evidence) -> Result:
    result = on_both(_miss_over_others)(evidence)
    found = misses(evidence, JUDGED).items()
    listed = ", ".join(f"{name} by {100.0 * miss[0]:.2g} %" for name, miss in found)
    counted = _counted(
        evidence, r"$L/L_c$ at a height over that at a smaller one, all pairs", _of_heights
    )
    return result._replace(beside=f"Lengths are missed by {listed}. {counted}")


def _least_increase(evidence: Evidence, role: str) -> float:
    lengths = [row["length"] for row in _heights(evidence, role)]
    return min(higher / lower for lower, higher in itertools.pairwise(lengths))


def _relative_change(varied: Row, base: Row) -> Estimate:
    """Relative change of the length between two runs; its range is that of the definitions."""
    changes = [varied[column] / base[column] - 1.0 for column in LENGTHS]
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
    "theory-agreement": _agreement,
    "height-dependence": _height_dependence,
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
