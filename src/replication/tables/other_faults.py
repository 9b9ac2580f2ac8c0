"""Simulated drops beside the expected ones, one row for each fault."""

from collections.abc import Iterable

import numpy as np
import xarray as xr

from nucleation.datasets.variables import Variable, some, table
from nucleation.model.identity import ensemble
from nucleation.model.parameters import Parameters

from .lengths import COLUMNS as LENGTHS
from .rows import RATIO_COLUMNS, Row, rows_of
from .weakening import EXPECTED, expected

GIVEN = some(
    LENGTHS,
    "friction_law",
    "evolution",
    "height",
    "below",
    "far_side",
    "shear_modulus",
    "second_shear_modulus",
    "kind",
    "strength",
    "critical_length",
)

SIMULATED = {
    "realisations": Variable("1", "number of realisations"),
    "length": LENGTHS["length"],  # the mean of the realisations
    "length_least": Variable("m", "least length at the drop of a realisation", "L"),
    "length_largest": Variable("m", "largest length at the drop of a realisation", "L"),
    "reached_length": LENGTHS["reached_length"],  # the largest of the realisations
    "inside": Variable("1", "number of realisations in the expected range"),
}

COLUMNS = {
    "zeta_over_a": RATIO_COLUMNS["zeta_over_a"],
    **GIVEN,
    **EXPECTED,
    **SIMULATED,
}


def gather_other_faults(
    drops: xr.Dataset,
    runs: Iterable[Row],
) -> xr.Dataset:
    """The simulated drops of each fault beside the theory."""
    rows = []
    for run in runs:
        parameters = Parameters.from_dict(run["parameters"])
        own = drops.isel(run=np.flatnonzero(drops["ensemble"].values == ensemble(parameters)))
        rows.append(_row(own, expected(parameters)))
    return table(rows, COLUMNS)


def _row(
    own: xr.Dataset,
    theory: Row,
) -> Row:
    """One fault's row, of the lengths (m) of its realisations and its :data:`EXPECTED`."""
    (row,) = rows_of(own, [0], (*GIVEN, "zeta", "a"))
    lengths = own["length"].values
    is_inside = (lengths >= theory["expected_low"]) & (lengths <= theory["expected_high"])
    simulated = {
        "zeta_over_a": row["zeta"] / row["a"],
        "realisations": lengths.size,
        "length": float(lengths.mean()),
        "length_least": float(lengths.min()),
        "length_largest": float(lengths.max()),
        "reached_length": float(own["reached_length"].max()),
        "inside": int(is_inside.sum()),
    }
    return row | theory | simulated
