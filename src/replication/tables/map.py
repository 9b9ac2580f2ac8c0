"""The map of a fault's lengths over its height and its weakening: a table, and on a grid.

Beside the theory's critical length are the two lengths of the simulated patch: the one at which it
turns unstable, and the one at which the force drops under a declared perturbation.
"""

from typing import Any

import numpy as np
import xarray as xr

from nucleation.datasets import DatasetError
from nucleation.datasets.variables import annotate, some, to_csv

from .lengths import COLUMNS as LENGTHS
from .rows import RATIO_COLUMNS, ratios
from .runs import STABILITY

COLUMNS = {
    **some(LENGTHS, "id height"),
    "zeta_over_a": RATIO_COLUMNS["zeta_over_a"],
    **some(LENGTHS, "kind strength seed onset_time length length_low length_high critical_length"),
    "length_ratio": RATIO_COLUMNS["length_ratio"],
    **STABILITY,
    "stability_ratio": RATIO_COLUMNS["stability_ratio"],
    **some(LENGTHS, "n_x steps wall_seconds status"),
}

AXES = ("height", "zeta_over_a", "strength", "seed")
"""Dimensions of the grid."""

ON_GRID = ("length", "length_ratio", "stability_length", "stability_ratio", "onset_time")

DIGITS = 6
"""Significant digits by which values of an axis are equal."""


def gather_map(lengths: xr.Dataset) -> xr.Dataset:
    """:data:`COLUMNS` on ``run``, of a table of lengths with the stability of each patch."""
    table = lengths.assign(ratios(lengths))
    rounded = [float(f"{value:.{DIGITS}g}") for value in table["zeta_over_a"].values]
    table = table.assign(zeta_over_a=("run", np.array(rounded)))
    return annotate(table[list(COLUMNS)].drop_attrs(), COLUMNS)


def on_grid(table: xr.Dataset) -> xr.Dataset:
    """The same over the dimensions :data:`AXES`; NaN where the study has no run.

    The theory's length depends on height and weakening alone.
    """
    frame = table.to_dataframe().set_index(list(AXES))
    if not frame.index.is_unique:
        raise DatasetError(f"runs of the map differ in more than {', '.join(AXES)}")
    grid = frame[list(ON_GRID)].to_xarray()
    theory = frame["critical_length"].groupby(level=AXES[:2]).first()
    return annotate(grid.assign(critical_length=theory.to_xarray()), COLUMNS)


def mean_over_seeds(grid: xr.Dataset, name: str) -> xr.DataArray:
    """The mean of a variable over realisations."""
    return grid[name].mean("seed", skipna=False)


def map_files(lengths: xr.Dataset) -> dict[str, Any]:
    """The table as CSV, and on its grid."""
    rows = gather_map(lengths)
    return {".nc": on_grid(rows), ".csv": to_csv(rows)}
