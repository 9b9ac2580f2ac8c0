"""Refinement of mesh and steps: how far onset and length at the drop still move.

Runs that differ in one numerical parameter alone are a sequence, ordered from coarse to fine. Each
run is compared with the finest one of its sequence.
"""

from collections.abc import Iterable

import pandas as pd
import xarray as xr

from nucleation.datasets.variables import Variable, some, table

from .lengths import COLUMNS as LENGTHS
from .lengths import join

REFINED = {"n_x": False, "n_y": False, "longest_step": True, "tolerance": True}
"""Parameters that are refined, and whether a smaller value is the finer one."""

FIXED = (
    *REFINED,
    "grading",
    "block_length",
    "fault",
    "kind",
    "strength",
    "correlation_length",
    "seed",
)
"""Columns in which the runs of a sequence agree, except for the refined parameter."""

LENGTH_OVER_THEORY = Variable("1", "length at the drop over that of the theory", "L/L_c")

COLUMNS = {
    "refinement": Variable("", "quantity that is refined from level to level"),
    **some(
        LENGTHS,
        "id evolution height initial_state kind strength seed n_x n_y grading "
        "block_length longest_step tolerance onset_time",
    ),
    "onset_difference": Variable("1", "relative difference of the onset from the finest run"),
    "length": LENGTHS["length"],
    "length_difference": Variable("1", "relative difference of L from the finest run"),
    "elements_difference": Variable("1", "the same in elements of the run along x"),
    "critical_length": LENGTHS["critical_length"],
    "length_over_theory": LENGTH_OVER_THEORY,
    **some(LENGTHS, "steps wall_seconds fault"),
}


def sequences(lengths: pd.DataFrame, refined: str) -> list[pd.DataFrame]:
    """Find the runs that differ in one numerical parameter alone."""
    fixed = [name for name in FIXED if name != refined]
    ascending = not REFINED[refined]
    found = []
    for _, own in lengths.groupby(fixed, sort=False, dropna=False):
        if len(own) > 1:
            found.append(own.sort_values(refined, ascending=ascending))
    return found


def refinement_table(tables: Iterable[xr.Dataset]) -> xr.Dataset:
    """The sequences found in tables of lengths, each run beside the finest one."""
    frame = join(tables).to_dataframe()
    rows = []
    for refined in REFINED:
        for own in sequences(frame, refined):
            finest = own.iloc[-1]
            difference = own["length"] - finest["length"]
            found = own.assign(
                refinement=refined,
                onset_difference=own["onset_time"] / finest["onset_time"] - 1.0,
                length_difference=own["length"] / finest["length"] - 1.0,
                elements_difference=difference / (own["block_length"] / own["n_x"]),
                length_over_theory=own["length"] / own["critical_length"],
            )
            rows += found.to_dict("records")
    return table(rows, COLUMNS)
