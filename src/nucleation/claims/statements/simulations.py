"""Claims on the critical lengths of the simulations: Sect. 5, Figs. 3 and S2."""

import itertools
import math
from typing import Any

import numpy as np

from ...configuration.roles import JUDGED
from ..claim import Result
from ..evidence import Evidence, on_both
from ..said import Ours, number

SHOWN = 0.005  # m: the height of Fig. S2
INSET = 0.1  # m: the height of Fig. 3's inset
OLD = 1e3  # s
ONSET = number("13")  # s: of Fig. S2


def onset_time(evidence: Evidence) -> Result:
    row = evidence.row(JUDGED, "aging", SHOWN)
    note = (
        f"Under one kind of noise, {row['kind']} of {row['strength']:g}: the mean of "
        f"{row['realisations']} realisations, {abs(ONSET.high - row['onset_time']):.2f} s from the "
        "bound. Other kinds have other onsets (findings: Onset and length for H = 0.005 m)."
    )
    return on_both(evidence, lambda study: _onset(evidence.row(study, "aging", SHOWN)), note)


def _onset(row: dict[str, Any]) -> Ours:
    return Ours.between(row["onset_time"], row["onset_time_low"], row["onset_time_high"])


def length_shown(evidence: Evidence) -> Result:
    return on_both(evidence, lambda study: _length(evidence.row(study, "aging", SHOWN)))


def _length(row: dict[str, Any], over: float = 1.0) -> Ours:
    return Ours.between(row["length"] / over, row["length_low"] / over, row["length_high"] / over)


def theory_agreement(evidence: Evidence) -> Result:
    def ours(study: str) -> Ours:
        ratios = [_length(row, over=row["theory_length"]) for row in evidence.series(study)]
        if any(math.isnan(ratio.value) for ratio in ratios):
            return Ours.exactly(math.nan)
        return max(ratios, key=lambda ratio: abs(ratio.value - 1.0))

    return on_both(evidence, ours)


def height_dependence(evidence: Evidence) -> Result:
    def ours(study: str) -> Ours:
        rows = evidence.series(study)
        if len(rows) < 2:
            evidence.row(study, "aging", SHOWN)  # says what is missing
        ratios = [row["length"] / row["theory_length"] for row in rows]
        return Ours.worst((b / a for a, b in itertools.combinations(ratios, 2)), target=1.0)

    return on_both(evidence, ours)


def length_increases(evidence: Evidence) -> Result:
    def ours(study: str) -> Ours:
        lengths = [row["length"] for row in evidence.series(study)]
        if len(lengths) < 2:
            evidence.row(study, "aging", SHOWN)
        return Ours.exactly(min(b / a for a, b in itertools.pairwise(lengths)))

    return on_both(evidence, ours)


def relative_change(evidence: Evidence, varied: dict[str, Any], base: dict[str, Any]) -> Ours:
    """Relative change of L_c, its range that of the definitions, the same for both runs."""
    ratio = varied["length"] / base["length"] - 1.0
    one, other = (np.array(evidence.measured(row).lengths) for row in (varied, base))
    changes = one / other - 1.0
    return Ours.between(ratio, changes.min(), changes.max())


def _slip_law(evidence: Evidence, height: float) -> Result:
    return on_both(
        evidence,
        lambda study: relative_change(
            evidence, evidence.row(study, "slip", height), evidence.row(study, "aging", height)
        ),
    )


SLIP_LAW = r"exhibits only a small variation (less than $10\%$) compared to the results for the "


def slip_law_low(evidence: Evidence) -> Result:
    return _slip_law(evidence, 0.01)


def slip_law_high(evidence: Evidence) -> Result:
    return _slip_law(evidence, 0.05)


def old_interface(evidence: Evidence) -> Result:
    return on_both(
        evidence,
        lambda study: relative_change(
            evidence,
            evidence.row(study, "aging", INSET, OLD),
            evidence.row(study, "aging", INSET),
        ),
    )


def stability_lost_at_length(evidence: Evidence) -> Result:
    ratios = [
        float(evidence.patch(row)["stability_length"]) / row["theory_length"]
        for row in evidence.rows(JUDGED)
    ]
    ours = Ours.worst(ratios, target=1.0)
    note = (
        f"Over half of that wavelength it is {2.0 * ours.low:.2f} to {2.0 * ours.high:.2f} "
        "(findings: Where the patch becomes unstable)."
    )
    return Result(ours, note=note)


def linear_stage_generic(evidence: Evidence) -> Ours:
    varied = [
        row for row in evidence.rows(JUDGED) if row["evolution"] != "aging" or row["phi0"] != 1.0
    ] or [evidence.row(JUDGED, "slip", 0.01)]

    def unstable(row: dict[str, Any]) -> float:
        return float(evidence.patch(row)["stability_length"])

    return Ours.worst(
        [unstable(row) / unstable(evidence.row(JUDGED, "aging", row["height"])) - 1.0
         for row in varied]
    )  # fmt: skip
