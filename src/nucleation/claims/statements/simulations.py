"""Claims on the critical lengths of the simulations: Sect. 5, Figs. 3 and S2."""

from __future__ import annotations

import itertools
import math
from typing import Any

import numpy as np

from ...configuration.roles import JUDGED
from ..claim import Claim, Result, claim
from ..evidence import Evidence, on_both
from ..said import Ours, above, number, words

CLAIMS: list[Claim] = []

SHOWN = 0.005  # m: the height of Fig. S2
INSET = 0.1  # m: the height of Fig. 3's inset
OLD = 1e3  # s
ONSET = number("13")  # s: of Fig. S2


@claim(
    CLAIMS, id="onset-time", where="Fig. S2", unit="s",
    statement="For H = 0.005 m the instability occurs at t = 13 s.",
    quotation=r"a distinct instability occurring at $t\simeq13$ s",
    method="start of the abrupt drop of the force, range over the definitions of the drop",
    said=ONSET,
)  # fmt: skip
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


@claim(
    CLAIMS, id="length-shown", where="Fig. S2", unit="m",
    statement="For H = 0.005 m the critical length is 0.15 m.",
    quotation=r"It corresponds to $L_c\simeq0.15$ m",
    method="extent of the creep patch at the onset, range over the definitions of edge and drop",
    said=number("0.15"),
)  # fmt: skip
def length_shown(evidence: Evidence) -> Result:
    return on_both(evidence, lambda study: _length(evidence.row(study, "aging", SHOWN)))


def _length(row: dict[str, Any], over: float = 1.0) -> Ours:
    return Ours.between(row["length"] / over, row["length_low"] / over, row["length_high"] / over)


@claim(
    CLAIMS, id="theory-agreement", where="Abstract, Sect. 5 and Fig. 3",
    statement="L_c of the simulations is within 25 % of the theory at every height; so we read "
    "reasonably good quantitative agreement. The length that the paper prints is a claim of its "
    "own (Fig. S2).",
    quotation=r"is in reasonably good quantitative agreement with the FEM results for the full "
    r"range of system heights $H$",
    method="L_c over that of the theory, aging law, all heights; the worst, with its range "
    "over the definitions of edge and drop", said=words("reasonably good"),
)  # fmt: skip
def theory_agreement(evidence: Evidence) -> Result:
    def ours(study: str) -> Ours:
        ratios = [_length(row, over=row["theory_length"]) for row in evidence.series(study)]
        if any(math.isnan(ratio.value) for ratio in ratios):
            return Ours.exactly(math.nan)
        return max(ratios, key=lambda ratio: abs(ratio.value - 1.0))

    return on_both(evidence, ours)


@claim(
    CLAIMS, id="height-dependence", where="Abstract and Fig. 3",
    statement="The dependence of L_c on the height agrees with the theory.",
    quotation=r"the theoretically predicted $L_c$ and its finite-size dependence are in reasonably "
    r"good quantitative agreement",
    method="L_c at a height over that at a smaller one, over the same of the theory; the worst of "
    "all pairs of heights, range over the pairs", said=words("reasonably good"),
)  # fmt: skip
def height_dependence(evidence: Evidence) -> Result:
    def ours(study: str) -> Ours:
        rows = evidence.series(study)
        if len(rows) < 2:
            evidence.row(study, "aging", SHOWN)  # says what is missing
        ratios = [row["length"] / row["theory_length"] for row in rows]
        return Ours.worst((b / a for a, b in itertools.combinations(ratios, 2)), target=1.0)

    return on_both(evidence, ours)


@claim(
    CLAIMS, id="length-increases", where="Fig. 3",
    statement="L_c increases with the height, as the theory's does.",
    quotation=r"is shown as a function of $H$ (red circles)",
    method="least ratio of L_c at neighbouring heights, larger over smaller", said=above(1.0),
)  # fmt: skip
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


@claim(
    CLAIMS, id="slip-law-low", where="Sect. 5 and Fig. 3",
    statement="With the slip law L_c changes by less than 10 % at H = 0.01 m.",
    quotation=SLIP_LAW + "aging law",
    method="relative change of L_c, range over the definitions, the same for both runs",
    said=words("small variation"),
)  # fmt: skip
def slip_law_low(evidence: Evidence) -> Result:
    return _slip_law(evidence, 0.01)


@claim(
    CLAIMS, id="slip-law-high", where="Sect. 5 and Fig. 3",
    statement="With the slip law L_c changes by less than 10 % at H = 0.05 m.",
    quotation=SLIP_LAW + "aging law",
    method="relative change of L_c, range over the definitions, the same for both runs",
    said=words("small variation"),
)  # fmt: skip
def slip_law_high(evidence: Evidence) -> Result:
    return _slip_law(evidence, 0.05)


@claim(
    CLAIMS, id="old-interface", where="Sect. 5 and Fig. 3",
    statement="With an initial age of 1000 s in the place of 1 s L_c changes by less than 10 % at "
    "H = 0.1 m.",
    quotation=r"exhibits only a small variation (less than $10\%$) compared to the result for "
    r"$\phi(t=0)=1$ s",
    method="relative change of L_c, range over the definitions, the same for both runs",
    said=words("small variation"),
)  # fmt: skip
def old_interface(evidence: Evidence) -> Result:
    return on_both(
        evidence,
        lambda study: relative_change(
            evidence,
            evidence.row(study, "aging", INSET, OLD),
            evidence.row(study, "aging", INSET),
        ),
    )


@claim(
    CLAIMS, id="stability-lost-at-length", where="Sects. 3 and 5",
    statement="The creep patch loses its stability when its length is L_c = 2 pi/k_c.",
    quotation=r"A loss of stability is expected when an unstable perturbation can {\em first} fit "
    r"into the creep patch",
    method="patch length at which the linearised patch itself begins to grow, over L_c of the "
    "theory; the worst run of the converged study (docs/patch_stability.md)",
    said=words("reasonably good"),
)  # fmt: skip
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


@claim(
    CLAIMS, id="linear-stage-generic", where="Sect. 3",
    statement="The linear stage is nearly independent of the evolution law and of the initial age.",
    quotation=r"nearly independent of the exact functional form of $g(\cdot)$",
    method="relative change of the patch length at which growth begins, slip law and age of "
    "1000 s; the worst (docs/patch_stability.md)", said=words("small variation"),
)  # fmt: skip
def linear_stage_generic(evidence: Evidence) -> Ours:
    varied = [
        row for row in evidence.rows(JUDGED) if row["law"] != "aging" or row["phi0"] != 1.0
    ] or [evidence.row(JUDGED, "slip", 0.01)]

    def unstable(row: dict[str, Any]) -> float:
        return float(evidence.patch(row)["stability_length"])

    return Ours.worst(
        [unstable(row) / unstable(evidence.row(JUDGED, "aging", row["height"])) - 1.0
         for row in varied]
    )  # fmt: skip
