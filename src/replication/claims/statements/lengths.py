"""Claims on the lengths at the drop and on the onset (Abstract, Sects. 3 and 5, Figs. 3 and S2)."""

import dataclasses
import itertools
from collections.abc import Callable

import numpy as np

from nucleation.extraction.measures import BY_DEFINITION
from nucleation.theory.creep.thin import thin_limit

from ...configuration.roles import JUDGED, PAPERS
from ..claim import Computation, Result, Row
from ..evidence import Evidence, on_both
from ..expected import Estimate, holds, number, words
from ..phrases import span

HEIGHT_OF_FIGURE_S2 = 0.005  # m
_ONSET_OF_FIGURE_S2 = number("13")  # s
_OLD = 1e3  # s
_WEAKENINGS = (0.1, 0.2, 0.3, 0.4, 0.5)
"""zeta/a as measured for rocks."""


def with_range(
    row: Row,
    column: str,
    unit: float = 1.0,
) -> Estimate:
    """A number of a row of the table of lengths, with the ends of its range.

    Parameters
    ----------
    row : dict
        The row.
    column : str
        The number's column; ``_low`` and ``_high`` are appended for the ends.
    unit : float
        Unit of the result, in the column's unit.
    """
    return Estimate.between(
        row[column] / unit,
        row[f"{column}_low"] / unit,
        row[f"{column}_high"] / unit,
    )


def _of_figure_s2(column: str) -> Callable[[Evidence], Result]:
    """A number of the run of Fig. S2."""

    @on_both
    def numbers(
        evidence: Evidence,
        role: str,
    ) -> Estimate:
        row = evidence.row(role, "aging", HEIGHT_OF_FIGURE_S2)
        return with_range(row, column)

    return numbers


def onset_time(evidence: Evidence) -> Result:
    row = evidence.row(JUDGED, "aging", HEIGHT_OF_FIGURE_S2)
    distance = abs(_ONSET_OF_FIGURE_S2.high - row["onset_time"])
    runs = int(row["realisations"])
    mean = f"the mean of {runs} realisations" if runs > 1 else "one realisation"
    note = (
        f"The verdict depends on the kind of noise. This one is {row['kind']} of "
        f"{row['strength']:g}: {mean}, {distance:.2f} s from the bound. With a fluctuating "
        "state the force drops later than the bound (results: Onset and length for H = 0.005 m)."
    )
    result = _of_figure_s2("onset_time")(evidence)
    return dataclasses.replace(result, note=note)


def length_shown(evidence: Evidence) -> Result:
    row = evidence.row(JUDGED, "aging", HEIGHT_OF_FIGURE_S2)
    lengths = [run["length"] for run in row["members"]]
    runs = f"all {len(lengths)} realisations are" if len(lengths) > 1 else "the one realisation is"
    note = (
        f"With one definition, the edge at 0.01 V, {runs} {span(lengths, '.4f')} m. "
        "The range over the definitions decides."
    )
    result = _of_figure_s2("length")(evidence)
    return dataclasses.replace(result, note=note)


def _over_theory(evidence: Evidence, role: str) -> list[Estimate]:
    """Length over L_c of the theory at all heights."""
    rows = evidence.series(role)
    return [with_range(row, "length", row["critical_length"]) for row in rows]


def theory_agreement(evidence: Evidence) -> Result:
    result = on_both(_over_theory)(evidence)
    ratios = _over_theory(evidence, JUDGED)
    note = f"Over the heights the ratio is {_summary(ratios)}." if len(ratios) > 1 else ""
    if note and result.on_papers_mesh is not None:
        papers = _over_theory(evidence, PAPERS)
        note += f" On {result.mesh} it is {_summary(papers)}."
    return dataclasses.replace(result, note=note)


def _summary(ratios: list[Estimate]) -> str:
    """The smallest and largest ratio, and how many are within 25 % of one."""
    quarter = words("expected")
    values = [ratio.value for ratio in ratios]
    near = [value for value in values if holds(quarter, Estimate.exactly(value))]
    return f"{span(values, '.2f')}, {len(near)} of {len(values)} within 25 %"


def _heights(evidence: Evidence, role: str) -> list[Row]:
    """The rows of all heights; raises Missing if there are fewer than two."""
    rows = evidence.series(role)
    if len(rows) == 1:
        return [evidence.row(role, "aging", HEIGHT_OF_FIGURE_S2), *rows]
    return rows


@on_both
def height_dependence(
    evidence: Evidence,
    role: str,
) -> list[float]:
    rows = _heights(evidence, role)
    ratios = [row["length"] / row["critical_length"] for row in rows]
    return [higher / lower for lower, higher in itertools.combinations(ratios, 2)]


@on_both
def length_increases(
    evidence: Evidence,
    role: str,
) -> float:
    lengths = [row["length"] for row in _heights(evidence, role)]
    return min(higher / lower for lower, higher in itertools.pairwise(lengths))


def relative_change(
    varied: Row,
    base: Row,
) -> Estimate:
    """Relative change of the length between two runs.

    Parameters
    ----------
    varied, base : dict
        Rows of the table of lengths.

    Returns
    -------
    Estimate
        Its range is that of the definitions, each applied to both runs.
    """
    change = varied["length"] / base["length"] - 1.0
    by_definition = [varied[column] / base[column] - 1.0 for column in BY_DEFINITION]
    return Estimate.between(change, np.min(by_definition), np.max(by_definition))


def _change_from_aging(
    height: float,
    law: str,
    age: float = 1.0,
) -> Computation:
    """Relative change of the length by another law or age (s), at one height (m)."""

    @on_both
    def change(
        evidence: Evidence,
        role: str,
    ) -> Estimate:
        varied = evidence.row(role, law, height, age)
        base = evidence.row(role, "aging", height)
        return relative_change(varied, base)

    return change


def _stability_length(evidence: Evidence, row: Row) -> float:
    """The patch length (m) at which the patch becomes unstable."""
    return float(evidence.patch(row)["stability_length"])


def stability_lost_at_length(evidence: Evidence) -> Result:
    rows = evidence.rows(JUDGED)
    ratios = [_stability_length(evidence, row) / row["critical_length"] for row in rows]
    halves = span((2.0 * ratio for ratio in ratios), ".2f")
    thin = [f"{thin_limit(weakening).length_ratio:.2f}" for weakening in _WEAKENINGS]
    note = (
        f"Over half of that wavelength it is {halves} "
        "(results: Where the patch becomes unstable). It depends on the weakening: in a thin "
        f"layer the theory of the patch gives {', '.join(thin)} for "
        rf"$\zeta/a$ = {', '.join(map(str, _WEAKENINGS))}. So from 0.2 to 0.4 the whole wavelength "
        "is right within 25 %."
    )
    return Result(ratios, note=note)


def linear_stage_generic(evidence: Evidence) -> list[float]:
    changes = []
    for varied in _other_laws_and_ages(evidence):
        base = evidence.row(JUDGED, "aging", varied["height"])
        ratio = _stability_length(evidence, varied) / _stability_length(evidence, base)
        changes.append(ratio - 1.0)
    return changes


def _other_laws_and_ages(evidence: Evidence) -> list[Row]:
    """The rows with another law than aging or another age than 1 s; raises Missing without any."""
    rows = evidence.rows(JUDGED)
    others = [row for row in rows if row["evolution"] != "aging" or row["initial_state"] != 1.0]
    return others or [evidence.row(JUDGED, "slip", 0.01)]


SHORT: dict[str, Computation] = {
    "slip-law-low": _change_from_aging(0.01, "slip"),
    "slip-law-high": _change_from_aging(0.05, "slip"),
    "old-interface": _change_from_aging(0.1, "aging", _OLD),
}
