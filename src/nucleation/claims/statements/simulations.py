"""Claims on the critical lengths of the simulations: Sect. 5, Figs. 3 and S2."""

import dataclasses
import itertools
from collections.abc import Callable
from typing import Any

import numpy as np

from ...configuration.roles import JUDGED
from ..claim import Computation, Result
from ..evidence import Evidence, on_both
from ..said import Ours, number

SHOWN = 0.005  # m: the height of Fig. S2
INSET = 0.1  # m: the height of Fig. 3's inset
OLD = 1e3  # s
ONSET = number("13")  # s: of Fig. S2


def _with_range(row: dict[str, Any], name: str, over: float = 1.0) -> Ours:
    """A number of a row of the table of lengths with the ends of its range."""
    return Ours.between(*(row[f"{name}{end}"] / over for end in ("", "_low", "_high")))


def shown(name: str) -> Callable[[Evidence], Result]:
    """A number of the run of Fig. S2."""
    return on_both(lambda e, role: _with_range(e.row(role, "aging", SHOWN), name))


def onset_time(evidence: Evidence) -> Result:
    row = evidence.row(JUDGED, "aging", SHOWN)
    note = (
        f"Under one kind of noise, {row['kind']} of {row['strength']:g}: the mean of "
        f"{row['realisations']} realisations, {abs(ONSET.high - row['onset_time']):.2f} s from the "
        "bound. Other kinds have other onsets (findings: Onset and length for H = 0.005 m)."
    )
    return dataclasses.replace(shown("onset_time")(evidence), note=note)


@on_both
def theory_agreement(evidence: Evidence, role: str) -> list[Ours]:
    return [_with_range(row, "length", row["theory_length"]) for row in evidence.series(role)]


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


def relative_change(evidence: Evidence, varied: dict[str, Any], base: dict[str, Any]) -> Ours:
    """Relative change of L_c, its range that of the definitions, the same for both runs."""
    one, other = (np.array(evidence.measured(row).lengths) for row in (varied, base))
    changes = one / other - 1.0
    return Ours.between(varied["length"] / base["length"] - 1.0, changes.min(), changes.max())


def change_from_aging(height: float, law: str, age: float = 1.0) -> Computation:
    """Relative change of L_c by another law or age, at one height (m)."""

    @on_both
    def change(evidence: Evidence, role: str) -> Ours:
        varied, base = evidence.row(role, law, height, age), evidence.row(role, "aging", height)
        return relative_change(evidence, varied, base)

    return change


def _stability_length(evidence: Evidence, row: dict[str, Any]) -> float:
    return float(evidence.patch(row)["stability_length"])


def stability_lost_at_length(evidence: Evidence) -> Result:
    ratios = [
        _stability_length(evidence, row) / row["theory_length"] for row in evidence.rows(JUDGED)
    ]
    note = (
        f"Over half of that wavelength it is {2.0 * min(ratios):.2f} to {2.0 * max(ratios):.2f} "
        "(findings: Where the patch becomes unstable)."
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


OURS: dict[str, Computation] = {
    "length-shown": shown("length"),
    "slip-law-low": change_from_aging(0.01, "slip"),
    "slip-law-high": change_from_aging(0.05, "slip"),
    "old-interface": change_from_aging(INSET, "aging", OLD),
}
"""The claims whose numbers take a line; each of the others has a function with its name."""
